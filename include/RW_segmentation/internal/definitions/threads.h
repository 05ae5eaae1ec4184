// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_THREADS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_THREADS_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/threads.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>
#endif

#include <algorithm>
#include <cstddef>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE void run_stretches(std::size_t number, std::size_t length,
                                          Task_reference<std::size_t, std::size_t> work) {
  const auto task = [&](std::size_t stretch) { work(stretch * length, std::min((stretch + 1) * length, number)); };
  const std::size_t stretches = (number + length - 1) / length;
  if (stretches <= 1) {
    if (stretches == 1) task(0);
    return;
  }
#ifdef CGAL_LINKED_WITH_TBB
  // An error that ends a loop around this one would end this one as well, without a word, and with half of its work done.
  tbb::task_group_context context(tbb::task_group_context::isolated);
  // The thread that waits for its own stretches must not begin with something long instead.
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(std::size_t(0), stretches, task, tbb::simple_partitioner(), context); });
#else
  for (std::size_t stretch = 0; stretch < stretches; ++stretch) task(stretch);
#endif
}

RW_SEGMENTATION_INLINE void run_at_the_same_time(Task_reference<> in_background, Task_reference<> here) {
#ifdef CGAL_LINKED_WITH_TBB
  bool has_begun = false;
  const auto background = [&] {
    has_begun = true;
    in_background();
  };
  tbb::this_task_arena::isolate([&] {  // as above
    tbb::task_group group;
    group.run(background);
    try {
      here();
    } catch (...) {
      group.cancel();
      group.wait();
      throw;
    }
    group.wait();
  });
  if (!has_begun) background();  // an error has ended a loop around this
#else
  here();
  in_background();
#endif
}

RW_SEGMENTATION_INLINE void run_by_calling_thread_alone(Task_reference<> work) {
#ifdef CGAL_LINKED_WITH_TBB
  tbb::task_arena calling_thread_alone(1);
  calling_thread_alone.execute(work);
#else
  work();
#endif
}

}  // namespace RW_segmentation::internal

#endif
