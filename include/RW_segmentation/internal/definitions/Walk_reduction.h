// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_WALK_REDUCTION_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_WALK_REDUCTION_H

#include <RW_segmentation/Walk_reduction.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE void require_reduction_numbers(const Walk_reduction& reduction) {
  if (reduction.cluster_steps == 0) throw argument_error("cluster_steps", reduction.cluster_steps, "at least 1");
  if (!(reduction.largest_difference > 0))
    throw argument_error("largest_difference", reduction.largest_difference, "positive");
}

}  // namespace RW_segmentation::internal

#endif
