// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENTATION_REPORT_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENTATION_REPORT_H

#include <RW_segmentation/Segmentation_report.h>
#include <RW_segmentation/internal/compiled.h>

#include <chrono>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE void Stage_clock::note(const char* stage) {
  const Time time = now();
  stages_.push_back({stage, seconds(last_, time)});
  last_ = time;
}

}  // namespace RW_segmentation::internal

#endif
