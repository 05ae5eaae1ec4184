// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_WORK_PROGRESS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_WORK_PROGRESS_H

#include <RW_segmentation/Progress.h>

#include <cstddef>

namespace RW_segmentation::internal {

/// Reports progress after some milliseconds of work, whose unit is the time in which a face is flooded.
class Work_progress {
 public:
  void begin(const Progress& progress) {
    progress_ = progress;
    progress_(0);
  }
  /// \param part that is done, to be reported after the next work
  void set_done(double part) { done_ = part; }
  void add(std::size_t faces) {
    constexpr std::size_t between_reports = 50000;
    work_ += faces;
    if (work_ < between_reports) return;
    work_ = 0;
    progress_(done_);
  }

 private:
  Progress progress_;
  double done_ = 0;
  std::size_t work_ = 0;
};

}  // namespace RW_segmentation::internal

#endif
