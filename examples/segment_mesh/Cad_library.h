// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_CAD_LIBRARY_H
#define SEGMENT_MESH_CAD_LIBRARY_H

#include "Cad_shape.h"

#ifdef SEGMENT_MESH_CAD_LIBRARY
#include <dlfcn.h>
#endif

#include <stdexcept>

namespace segment_mesh {

/// Whether this program was built with Open CASCADE.
#ifdef SEGMENT_MESH_CAD_LIBRARY
constexpr bool writes_cad_files = true;
#else
constexpr bool writes_cad_files = false;
#endif

/// The function `segment_mesh_new_cad_shape()` of the library beside the program that is linked with Open CASCADE. The
/// library is loaded by the first call: Open CASCADE is some thirty libraries, which take nine times as long to load as the
/// program takes to start.
/// \throws std::runtime_error if it cannot be loaded
inline auto cad_library() {
  using New_cad_shape = decltype(&segment_mesh_new_cad_shape);
#ifdef SEGMENT_MESH_CAD_LIBRARY
  static const New_cad_shape function = [] {
    void* const library = dlopen(SEGMENT_MESH_CAD_LIBRARY, RTLD_NOW | RTLD_LOCAL);  // for as long as the program runs
    void* const symbol = library ? dlsym(library, "segment_mesh_new_cad_shape") : nullptr;
    if (!symbol) throw std::runtime_error(dlerror());
    return reinterpret_cast<New_cad_shape>(symbol);
  }();
  return function;
#else
  return New_cad_shape{};
#endif
}

}  // namespace segment_mesh

#endif
