// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_SPURIOUS_REGIONS_H
#define RW_SEGMENTATION_INTERNAL_WALK_SPURIOUS_REGIONS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/mesh/Components.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Connected regions of faces with one label.
inline Components regions_of(const Dual_mesh& mesh, const std::vector<std::size_t>& labels) {
  return {mesh.graph(), [&](Dual_mesh::Index e) {
            const auto [f, g] = mesh.graph().faces_of(e);
            return labels[f] == labels[g] && !mesh.is_wall(e);
          }};
}

/// How many regions each label has.
inline std::map<std::size_t, std::size_t> regions_of_labels(const Components& regions,
                                                            const std::vector<std::size_t>& labels) {
  std::map<std::size_t, std::size_t> count;
  std::vector<char> is_counted(regions.count, false);
  for (std::size_t f = 0; f < labels.size(); ++f)
    if (!std::exchange(is_counted[regions.of[f]], true)) ++count[labels[f]];
  return count;
}

/// Marks the faces of all regions but the largest ones of each label, of which there are as many as `expected`.
inline std::vector<char> faces_of_spurious_regions(const Components& regions, const std::vector<double>& area,
                                                   const std::vector<std::size_t>& labels,
                                                   std::map<std::size_t, std::size_t> expected) {
  struct Region {
    double area;
    std::size_t label, number;
  };
  std::vector<Region> by_size(regions.count);
  for (std::size_t f = 0; f < labels.size(); ++f) {
    Region& region = by_size[regions.of[f]];
    region = {region.area + area[f], labels[f], regions.of[f]};
  }
  std::stable_sort(by_size.begin(), by_size.end(), [](const Region& a, const Region& b) { return a.area > b.area; });
  std::vector<char> is_spurious(regions.count, false);
  for (const Region& region : by_size) {
    std::size_t& left = expected[region.label];
    is_spurious[region.number] = left == 0;
    if (left > 0) --left;
  }
  std::vector<char> result;
  for (const auto region : regions.of) result.push_back(is_spurious[region]);
  return result;
}

}  // namespace RW_segmentation::internal

#endif
