// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_ANALYTIC_REGIONS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_ANALYTIC_REGIONS_H

#include <RW_segmentation/Analytic_surface.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// Faces that lie on one analytic surface each.
struct Analytic_regions {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  std::vector<std::size_t> region_of_face;  ///< `none` for the remainder
  std::vector<Analytic_surface> surfaces;   ///< of each region
};

}  // namespace RW_segmentation::internal

#endif
