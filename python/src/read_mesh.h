// SPDX-License-Identifier: MIT

#ifndef RW_PYTHON_READ_MESH_H
#define RW_PYTHON_READ_MESH_H

#include "Array_mesh.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace rw_python {

/// Faces as the user holds them: the vertices at their corners, one face after the other.
struct Polygons {
  std::variant<const std::int32_t*, const std::int64_t*, const std::uint32_t*, const std::uint64_t*> corners;
  std::size_t number_of_corners = 0;
  const std::int64_t* offsets = nullptr;  ///< where each face begins, and the end of the last
  std::size_t number_of_faces = 0;
  std::size_t degree = 0;  ///< of all faces, where there are no offsets
};

/// A mesh of the user's faces.
struct Read_mesh {
  Array_mesh mesh;
  std::vector<Index> mesh_face;      ///< of each of the user's faces, `none` for those left out; empty: all as they are
  std::vector<std::string> remarks;  ///< what was repaired, a sentence each
};

/// Makes a mesh of faces that form an oriented surface. Others are repaired if that is wished, as the tool segment_mesh
/// does: vertices with equal coordinates are merged where borders coincide, faces without three different corners and
/// copies of others are left out, neighbours oriented alike, and the surface is cut where more than two faces meet at an
/// edge. Closed parts that are inside out are turned.
/// \throws std::invalid_argument if a corner is no vertex, a coordinate is not finite, or, without repair, the faces do
/// not form an oriented surface
/// Complexity: linear; O(m log m) for m faces that are repaired.
Read_mesh read_mesh(const Coordinates& coordinates, const Polygons& polygons, bool is_repaired);

}  // namespace rw_python

#endif
