// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_MESH_STRETCH_H
#define RW_SEGMENTATION_INTERNAL_MESH_MESH_STRETCH_H

#include <RW_segmentation/Dual_graph.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

/// Faces and edges of a mesh that follow each other in their numbers.
struct Mesh_stretch {
  Dual_graph::Index first_face = 0, faces = 0;
  Dual_graph::Index first_edge = 0, edges = 0;
};

/// The connected components of a mesh, across walls; several in one stretch where their faces are not one after the other.
/// \pre the edges of a stretch come after those of the one before, as where edges are numbered by the lower one of their faces
/// (`Mesh_reading`, `Joined_faces`)
/// Complexity: linear.
inline std::vector<Mesh_stretch> connected_stretches(const Dual_graph& graph) {
  std::vector<Mesh_stretch> stretches;
  Mesh_stretch open;
  Dual_graph::Index last = 0;  // of the faces that those of the open stretch lead to
  for (Dual_graph::Index f = 0; f < graph.number_of_faces(); ++f) {
    ++open.faces;
    last = std::max(last, f);
    for (const auto& [next, edge] : graph.neighbours(f)) {
      if (next > f) ++open.edges;
      last = std::max(last, next);
    }
    if (last > f) continue;
    stretches.push_back(open);
    open = {open.first_face + open.faces, 0, open.first_edge + open.edges, 0};
  }
  return stretches;
}

/// The number of faces of each.
inline std::vector<std::size_t> sizes_of(const std::vector<Mesh_stretch>& stretches) {
  std::vector<std::size_t> sizes;
  sizes.reserve(stretches.size());
  for (const Mesh_stretch& stretch : stretches) sizes.push_back(stretch.faces);
  return sizes;
}

}  // namespace RW_segmentation::internal

#endif
