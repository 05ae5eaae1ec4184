// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_REGION_BOUNDARIES_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_REGION_BOUNDARIES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/merging/Region_merging.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE std::vector<Boundary_of_regions> region_boundaries(
    const Dual_mesh& mesh, const std::vector<std::size_t>& region_of_face, const std::vector<double>& difference) {
  using Index = Dual_mesh::Index;
  struct Crossing {
    std::array<Index, 2> regions;
    Index edge;
    bool operator<(const Crossing& other) const {
      return std::tie(regions, edge) < std::tie(other.regions, other.edge);
    }
  };
  std::vector<Crossing> crossings;
  for (Index e = 0; e < mesh.number_of_edges(); ++e) {
    const auto [f, g] = mesh.graph().faces_of(e);
    const auto a = static_cast<Index>(region_of_face[f]), b = static_cast<Index>(region_of_face[g]);
    if (a != b && !mesh.is_wall(e)) crossings.push_back({{std::min(a, b), std::max(a, b)}, e});
  }
  std::sort(crossings.begin(), crossings.end());

  const double unit = mesh.length_unit();
  std::vector<Boundary_of_regions> boundaries;
  for (const auto& [regions, e] : crossings) {
    if (boundaries.empty() || boundaries.back().regions != regions) boundaries.push_back({regions, {}});
    const double length = mesh.edge_length(e) / unit;
    boundaries.back().common += {length, length * difference[e]};
  }
  return boundaries;
}

}  // namespace RW_segmentation::internal

#endif
