// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_LONG_TASKS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_LONG_TASKS_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/long_tasks.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE Progress_of_tasks::Progress_of_tasks(const Progress& whole,
                                                            const std::vector<std::size_t>& sizes)
    : whole_(whole), fraction_(sizes.size(), 0) {
  const auto sum = static_cast<double>(std::accumulate(sizes.begin(), sizes.end(), std::size_t(0)));
  for (const std::size_t size : sizes) share_.push_back(static_cast<double>(size) / sum);
}

RW_SEGMENTATION_INLINE Progress Progress_of_tasks::of(std::size_t task) {
  return Progress([this, task](double fraction) {
    note(task, fraction);
    return true;
  });
}

RW_SEGMENTATION_INLINE void Progress_of_tasks::note(std::size_t task, double fraction) {
  double sum = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (error_) throw Cancelled();
    done_ += share_[task] * (fraction - fraction_[task]);
    fraction_[task] = fraction;
    sum = std::min(done_, 1.);
  }
  if (std::this_thread::get_id() == teller_) whole_(sum);
}

RW_SEGMENTATION_INLINE void Progress_of_tasks::end(std::exception_ptr error) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!error_) error_ = std::move(error);
}

RW_SEGMENTATION_INLINE void Progress_of_tasks::rethrow() const {
  if (error_) std::rethrow_exception(error_);
}

RW_SEGMENTATION_INLINE std::vector<std::size_t> largest_first(const std::vector<std::size_t>& sizes) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return sizes[i] > sizes[j]; });
  return order;
}

}  // namespace RW_segmentation::internal

#endif
