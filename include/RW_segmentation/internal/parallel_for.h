// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_PARALLEL_FOR_H
#define RW_SEGMENTATION_INTERNAL_PARALLEL_FOR_H

#include <RW_segmentation/Progress.h>

#include <CGAL/tags.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>
#endif

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace RW_segmentation::internal {

/// Whether a concurrency tag of CGAL's means threads, which it does where TBB is linked.
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
template <class ConcurrencyTag>
constexpr bool has_threads() {
  constexpr bool parallel = std::is_convertible_v<ConcurrencyTag, CGAL::Parallel_tag>;
#ifdef CGAL_LINKED_WITH_TBB
  return parallel;
#else
  static_assert(!parallel, "CGAL::Parallel_tag needs TBB: link with it and define CGAL_LINKED_WITH_TBB.");
  return false;
#endif
}

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
    tbb::parallel_for(std::size_t(0), number, task, tbb::simple_partitioner());
#endif
  } else {
    for (std::size_t i = 0; i < number; ++i) task(i);
  }
}

/// Calls `work(begin, end)` for stretches of 0 .. `number` - 1, of the same length each but the last; for several at the
/// same time where TBB is linked. The stretches do not depend on the number of threads.
template <class Work>
void parallel_stretches(std::size_t number, const Work& work, std::size_t length = 16384) {
  const auto task = [&](std::size_t stretch) { work(stretch * length, std::min((stretch + 1) * length, number)); };
  const std::size_t stretches = (number + length - 1) / length;
  if (stretches <= 1) {
    if (stretches == 1) task(0);
    return;
  }
#ifdef CGAL_LINKED_WITH_TBB
  // The thread that waits for its own stretches must not begin with something long instead.
  tbb::this_task_arena::isolate([&] { parallel_tasks<CGAL::Parallel_tag>(stretches, task); });
#else
  parallel_tasks<CGAL::Sequential_tag>(stretches, task);
#endif
}

/// Calls `here()`, from the calling thread, and `in_background()`, at the same time if there are threads.
template <class ConcurrencyTag, class Background, class Here>
void at_the_same_time(const Background& in_background, const Here& here) {
  if constexpr (has_threads<ConcurrencyTag>()) {
#ifdef CGAL_LINKED_WITH_TBB
    tbb::task_group group;
    group.run(in_background);
    try {
      here();
    } catch (...) {
      group.cancel();
      group.wait();
      throw;
    }
    group.wait();
#endif
  } else {
    here();
    in_background();
  }
}

/// Calls `work()`, whose parts use threads only where a concurrency tag says so.
template <class ConcurrencyTag, class Work>
auto with_threads(const Work& work) {
#ifdef CGAL_LINKED_WITH_TBB
  if constexpr (!has_threads<ConcurrencyTag>()) {
    tbb::task_arena calling_thread_alone(1);
    return calling_thread_alone.execute(work);
  }
#endif
  return work();
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
      tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end), [&](const auto& range) {
        auto& worker = workers.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i) worker(i);
      });
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
