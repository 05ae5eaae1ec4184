// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_PARALLEL_FOR_H
#define RW_SEGMENTATION_INTERNAL_PARALLEL_FOR_H

#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/threads.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>
#endif

#include <algorithm>
#include <cstddef>
#include <type_traits>

// For definitions alone: programs that link the compiled library must not compile TBB's headers.

namespace RW_segmentation::internal {

/// A workspace for each thread, made when first asked for.
template <class Workspace, class ConcurrencyTag>
class Workspaces {
 public:
  template <class Make>
  explicit Workspaces(const Make& make) : workspaces_(make) {}

  /// That of the calling thread.
  Workspace& local() { return workspaces_.local(); }

 private:
#ifdef CGAL_LINKED_WITH_TBB
  using For_threads = tbb::enumerable_thread_specific<Workspace>;
#else
  using For_threads = Workspace;
#endif
  struct For_one {
    template <class Make>
    explicit For_one(const Make& make) : workspace(make()) {}
    Workspace& local() { return workspace; }
    Workspace workspace;
  };
  std::conditional_t<has_threads<ConcurrencyTag>(), For_threads, For_one> workspaces_;
};

/// Calls `task(i)` for i = 0 .. `number` - 1, each of which is worth a thread.
template <class ConcurrencyTag, class Task>
void parallel_tasks(std::size_t number, const Task& task) {
  if constexpr (has_threads<ConcurrencyTag>()) {
#ifdef CGAL_LINKED_WITH_TBB
    tbb::task_group_context context(tbb::task_group_context::isolated);  // as in `run_stretches()`
    tbb::parallel_for(std::size_t(0), number, task, tbb::simple_partitioner(), context);
#endif
  } else {
    for (std::size_t i = 0; i < number; ++i) task(i);
  }
}

/// Calls `worker(i)` for i = 0 .. `number` - 1, with a worker of its own for each thread, made by `make_worker()`.
/// Reports progress from the calling thread.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \throws Cancelled
template <class ConcurrencyTag, class MakeWorker>
void parallel_for(std::size_t number, const MakeWorker& make_worker, const Progress& progress) {
  constexpr std::size_t between_reports = 4096;
  const auto in_stretches = [&](const auto& run) {
    for (std::size_t begin = 0; begin < number; begin += between_reports) {
      progress(static_cast<double>(begin) / static_cast<double>(number));
      run(begin, std::min(begin + between_reports, number));
    }
    progress(1);
  };
  if constexpr (has_threads<ConcurrencyTag>()) {
#ifdef CGAL_LINKED_WITH_TBB
    tbb::enumerable_thread_specific<decltype(make_worker())> workers(make_worker);
    in_stretches([&](std::size_t begin, std::size_t end) {
      const auto work = [&](const tbb::blocked_range<std::size_t>& range) {
        auto& worker = workers.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i) worker(i);
      };
      tbb::task_group_context context(tbb::task_group_context::isolated);  // as in `run_stretches()`
      tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end), work, context);
    });
#endif
  } else {
    auto worker = make_worker();
    in_stretches([&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) worker(i);
    });
  }
}

}  // namespace RW_segmentation::internal

#endif
