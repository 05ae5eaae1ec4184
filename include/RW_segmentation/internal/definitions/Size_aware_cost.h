// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SIZE_AWARE_COST_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SIZE_AWARE_COST_H

#include <RW_segmentation/Size_aware_cost.h>
#include <RW_segmentation/internal/compiled.h>

#include <memory>
#include <utility>
#include <vector>

namespace RW_segmentation {

RW_SEGMENTATION_INLINE Size_aware_cost::Size_aware_cost(std::vector<double> thickness) {
  if (!thickness.empty()) thickness_ = std::make_shared<const std::vector<double>>(std::move(thickness));
}

}  // namespace RW_segmentation

#endif
