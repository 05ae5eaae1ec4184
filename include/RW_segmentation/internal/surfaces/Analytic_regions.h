// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_ANALYTIC_REGIONS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_ANALYTIC_REGIONS_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_graph.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// Faces that lie on one analytic surface each.
struct Analytic_regions {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  std::vector<std::size_t> region_of_face;  ///< `none` for the remainder
  std::vector<Analytic_surface> surfaces;   ///< of each region

  /// By region.
  std::vector<std::vector<Dual_graph::Index>> faces() const {
    std::vector<std::vector<Dual_graph::Index>> faces(surfaces.size());
    for (Dual_graph::Index f = 0; f < region_of_face.size(); ++f)
      if (region_of_face[f] != none) faces[region_of_face[f]].push_back(f);
    return faces;
  }
};

}  // namespace RW_segmentation::internal

#endif
