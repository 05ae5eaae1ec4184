// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_THREADS_H
#define RW_SEGMENTATION_INTERNAL_THREADS_H

#include <CGAL/tags.h>

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

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

/// Calls a function object that outlives it. It hides the type of what is done from where threads are started, so that
/// programs need not compile TBB's headers.
template <class... Arguments>
class Task_reference {
 public:
  template <class Task, class = std::enable_if_t<!std::is_same_v<Task, Task_reference>>>
  explicit Task_reference(const Task& task)
      : task_(&task),
        call_([](const void* called, Arguments... arguments) { (*static_cast<const Task*>(called))(arguments...); }) {}

  void operator()(Arguments... arguments) const { call_(task_, arguments...); }

 private:
  const void* task_;
  void (*call_)(const void*, Arguments...);
};

/// See `parallel_stretches()`, `at_the_same_time()` and `with_threads()`.
void run_stretches(std::size_t number, std::size_t length, Task_reference<std::size_t, std::size_t> work);
void run_at_the_same_time(Task_reference<> in_background, Task_reference<> here);
void run_by_calling_thread_alone(Task_reference<> work);

/// Calls `work(begin, end)` for stretches of 0 .. `number` - 1, of the same length each but the last; for several at the
/// same time where TBB is linked. The stretches do not depend on the number of threads.
template <class Work>
void parallel_stretches(std::size_t number, const Work& work, std::size_t length = 16384) {
  run_stretches(number, length, Task_reference<std::size_t, std::size_t>(work));
}

/// Calls `here()`, from the calling thread, and `in_background()`, at the same time if there are threads.
template <class ConcurrencyTag, class Background, class Here>
void at_the_same_time(const Background& in_background, const Here& here) {
  if constexpr (has_threads<ConcurrencyTag>()) {
    run_at_the_same_time(Task_reference<>(in_background), Task_reference<>(here));
  } else {
    here();
    in_background();
  }
}

/// Calls `work()`, whose parts use threads only where a concurrency tag says so.
template <class ConcurrencyTag, class Work>
auto with_threads(const Work& work) {
#ifdef CGAL_LINKED_WITH_TBB
  if constexpr (has_threads<ConcurrencyTag>()) {
    return work();
  } else if constexpr (std::is_void_v<decltype(work())>) {
    run_by_calling_thread_alone(Task_reference<>(work));
  } else {
    std::optional<decltype(work())> result;
    const auto keep_result = [&] { result.emplace(work()); };
    run_by_calling_thread_alone(Task_reference<>(keep_result));
    return *std::move(result);
  }
#else
  return work();
#endif
}

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/threads.h>
#endif

#endif
