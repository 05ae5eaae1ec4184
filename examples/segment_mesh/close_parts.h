// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_CLOSE_PARTS_H
#define SEGMENT_MESH_CLOSE_PARTS_H

#include "../mesh_files/Polygon_soup.h"
#include "Oriented_mesh.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace segment_mesh {

/// What closing a segment has come to.
struct Closed_part {
  std::size_t caps = 0;
  bool is_closed = true;  ///< false where the mesh itself has a border
  double volume = 0;      ///< in cubes of the mesh's unit; of closed parts only
  bool is_flat = false;   ///< closed, but with nothing inside
};

/// The segments of a mesh, each closed where it was cut from the others.
struct Closed_parts {
  mesh_files::Polygon_soup soup;   ///< the faces of the mesh, and then the caps
  std::vector<std::size_t> label;  ///< of each face of the soup
  std::map<std::size_t, Closed_part> parts;
  std::vector<std::string> remarks;  ///< what users who print the parts should know, a sentence each
};

/// Closes segments where they are cut off. Each loop of edges between segments gets a cap of triangles that turn as the
/// segment does: the constrained Delaunay triangulation in the plane of the loop, or, where the loop crosses itself when it
/// is seen from there, the triangles of least area and angles that CGAL's hole filling finds. Loops in one plane of which
/// one lies within the other, such as those of a pipe that is cut across, get one cap with a hole.
///
/// Every edge of a closed part has two faces. Two segments that share a loop share its cap, so that their volumes add up to
/// that of the whole exactly; where three or more meet at a point, each has a cap of its own, and the volumes add up nearly.
/// Loops that run along a border of the mesh stay open.
/// \param label of each face
/// Complexity: O(n log n) for n faces, but O(l^2) for the l loops between two segments.
Closed_parts closed_parts(const Mesh& mesh, const std::vector<std::size_t>& label);

}  // namespace segment_mesh

#endif
