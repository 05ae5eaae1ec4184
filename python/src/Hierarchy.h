// SPDX-License-Identifier: MIT

#ifndef RW_PYTHON_HIERARCHY_H
#define RW_PYTHON_HIERARCHY_H

#include "Mesh.h"

#include <RW_segmentation/Segmentation_report.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rw_python {

/// All levels of a segmentation, by the user's faces.
struct Hierarchy {
  RW::Merge_tree tree;
  std::vector<std::int64_t> fragment_of_face;
  std::size_t suggested = 0;  ///< segments by the shape
  RW::Segmentation_report report;
};

/// \param levels of the mesh
/// \param stop where merging stops by itself
template <class Stop>
Hierarchy hierarchy_of(const Mesh& mesh, const RW::Random_walk_hierarchy<Array_mesh>& levels, const Stop& stop) {
  Hierarchy result;
  result.tree = levels;
  result.report = levels.report();
  if (mesh.halfedges().number_of_faces() == 0) return result;
  std::vector<std::size_t> fragment(mesh.halfedges().number_of_faces());
  levels.segments(RW::Segment_count_stop(levels.number_of_fragments()), map_over<Face>(fragment));
  result.fragment_of_face = mesh.by_user_face<std::int64_t>(fragment);
  result.suggested = stop(levels);
  return result;
}

}  // namespace rw_python

#endif
