// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_REGION_BOUNDARIES_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_REGION_BOUNDARIES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/merging/Region_merging.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE std::vector<Crossing> region_crossings(const Dual_mesh& mesh,
                                                              const std::vector<std::size_t>& region_of_face) {
  using Index = Dual_mesh::Index;
  std::vector<Crossing> crossings;
  for (Index e = 0; e < mesh.number_of_edges(); ++e) {
    const auto [f, g] = mesh.graph().faces_of(e);
    const auto a = static_cast<Index>(region_of_face[f]), b = static_cast<Index>(region_of_face[g]);
    if (a != b && !mesh.is_wall(e)) crossings.push_back({{std::min(a, b), std::max(a, b)}, e});
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.regions, a.edge) < std::tie(b.regions, b.edge);
  });
  return crossings;
}

}  // namespace RW_segmentation::internal

#endif
