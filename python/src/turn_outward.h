// SPDX-License-Identifier: MIT

#ifndef RW_PYTHON_TURN_OUTWARD_H
#define RW_PYTHON_TURN_OUTWARD_H

#include "Array_mesh.h"

#include <cstddef>

namespace rw_python {

/// Turns closed components whose faces look inward, unless they may be cavities: a component whose bounding box lies
/// inside that of another closed one is left as it is.
/// \returns the number of components turned
/// Complexity: linear in the number of faces; components inside out are compared with the closed ones that begin
/// before them.
std::size_t turn_components_outward(Array_mesh& mesh);

}  // namespace rw_python

#endif
