// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_LONG_TASKS_H
#define RW_SEGMENTATION_INTERNAL_LONG_TASKS_H

#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/threads.h>

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace RW_segmentation::internal {

/// The progress of tasks that are done at the same time: their sum, told to the user by the thread that made this.
class Progress_of_tasks {
 public:
  /// \param sizes of the tasks, which their shares of the progress are by
  Progress_of_tasks(const Progress& whole, const std::vector<std::size_t>& sizes);
  Progress_of_tasks(const Progress_of_tasks&) = delete;
  Progress_of_tasks& operator=(const Progress_of_tasks&) = delete;

  /// That of one task; this must outlive it.
  Progress of(std::size_t task);

  /// Ends all tasks when they tell their progress next.
  /// \param error why; the first one counts
  void end(std::exception_ptr error);

  /// Throws why tasks were ended, if they were.
  void rethrow() const;

 private:
  void note(std::size_t task, double fraction);

  const Progress& whole_;
  const std::thread::id teller_ = std::this_thread::get_id();
  std::vector<double> share_, fraction_;  // by task
  double done_ = 0;
  std::exception_ptr error_;
  std::mutex mutex_;  // of fraction_, done_ and error_
};

/// Numbers from the largest size to the smallest.
std::vector<std::size_t> largest_first(const std::vector<std::size_t>& sizes);

/// Calls `work(task, progress)` for tasks that are worth a thread each, the largest first. What one of them throws ends the
/// others and passes through.
/// \param sizes of the tasks: how long they take, about
/// \param concurrent whether several are done at the same time where TBB is linked
/// \throws Cancelled
template <class Work>
void long_tasks(const std::vector<std::size_t>& sizes, const Progress& progress, const Work& work, bool concurrent) {
  Progress_of_tasks shared(progress, sizes);
  const std::vector<std::size_t> order = largest_first(sizes);
  std::atomic<std::size_t> next = 0;
  const auto run_next = [&](std::size_t, std::size_t) {
    const std::size_t task = order[next++];
    try {
      work(task, shared.of(task));
    } catch (...) {
      shared.end(std::current_exception());
      throw;
    }
  };
  try {
    if (concurrent)
      parallel_stretches(sizes.size(), run_next, 1);
    else
      for (std::size_t i = 0; i < sizes.size(); ++i) run_next(i, i + 1);
  } catch (...) {
    shared.rethrow();
    throw;
  }
  progress(1);
}

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/long_tasks.h>
#endif

#endif
