// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SIZE_AWARE_COST_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SIZE_AWARE_COST_H

#include <RW_segmentation/Size_aware_cost.h>
#include <RW_segmentation/internal/compiled.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace RW_segmentation {

RW_SEGMENTATION_INLINE double internal::crease_weight(std::size_t edges) {
  constexpr double width = 0.01;  // in units of R: the default of Normal_smoothing
  if (edges == 0) return 1;
  return std::max(1., std::sqrt(2 / (std::sqrt(3.) * static_cast<double>(edges))) / width);
}

RW_SEGMENTATION_INLINE Size_aware_cost::Size_aware_cost(std::vector<double> thickness, double crease_weight)
    : crease_weight_(crease_weight) {
  if (!thickness.empty()) thickness_ = std::make_shared<const std::vector<double>>(std::move(thickness));
}

}  // namespace RW_segmentation

#endif
