// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_CAD_FORMAT_H
#define SEGMENT_MESH_CAD_FORMAT_H

#include "../mesh_files/Format.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace segment_mesh {

/// The formats of CAD systems that are written.
enum class Cad_format { step, iges, brep };

/// What files of a format end with.
inline const std::vector<std::pair<std::string, Cad_format>> cad_extensions = {{".step", Cad_format::step},
                                                                               {".stp", Cad_format::step},
                                                                               {".iges", Cad_format::iges},
                                                                               {".igs", Cad_format::iges},
                                                                               {".brep", Cad_format::brep}};

/// The format that the end of a name tells; none if that is no CAD system's.
inline std::optional<Cad_format> cad_format_of(const std::string& path) {
  for (const auto& [extension, format] : cad_extensions)
    if (mesh_files::extension_of(path) == extension) return format;
  return std::nullopt;
}

/// A unit of lengths.
struct Length_unit {
  const char* name;
  double millimetres;
  const char* kernel_name;  ///< as Open CASCADE calls it
};

inline const std::vector<Length_unit> length_units = {
    {"mm", 1, "MM"}, {"cm", 10, "CM"}, {"m", 1000, "M"}, {"inch", 25.4, "INCH"}, {"ft", 304.8, "FT"}};

/// Thrown for a shape that is not what the mesh is. The message tells why.
class Unsound_shape : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace segment_mesh

#endif
