// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_TBB_OF_THREADS_H
#define RW_SEGMENTATION_TEST_TBB_OF_THREADS_H

// What the library uses of TBB, made of std::thread, for ThreadSanitizer: it knows all of what these wait for, while
// TBB's own library is compiled without it and would be blamed for races that are none.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace tbb {

class global_control {
 public:
  enum parameter { max_allowed_parallelism };

  global_control(parameter, std::size_t threads) : before_(number_of_threads().exchange(threads)) {}
  ~global_control() { number_of_threads() = before_; }
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;

  static std::atomic<std::size_t>& number_of_threads() {
    static std::atomic<std::size_t> number{4};
    return number;
  }

 private:
  std::size_t before_;
};

/// An error ends nothing but what threw it.
class task_group_context {
 public:
  enum kind_type { isolated };

  explicit task_group_context(kind_type) {}
};

/// Tasks, each in a thread of its own.
class task_group {
 public:
  task_group() = default;
  task_group(const task_group&) = delete;
  task_group& operator=(const task_group&) = delete;
  ~task_group() { join(); }

  template <class Task>
  void run(const Task& task) {
    threads_.emplace_back([this, task] {
      try {
        task();
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        error_ = std::current_exception();
      }
    });
  }

  void cancel() {}

  void wait() {
    join();
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

 private:
  void join() {
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::exception_ptr error_;
};

struct simple_partitioner {};

template <class Index, class Task>
void parallel_for(Index begin, Index end, const Task& task, simple_partitioner, task_group_context&) {
  std::atomic<Index> next{begin};
  const auto work = [&] {
    for (Index i = next++; i < end; i = next++) task(i);
  };
  task_group group;
  const std::size_t others = std::min<std::size_t>(global_control::number_of_threads(), end - begin) - (begin < end);
  for (std::size_t i = 0; i < others; ++i) group.run(work);
  work();
  group.wait();
}

template <class Index>
class blocked_range {
 public:
  blocked_range(Index begin, Index end) : begin_(begin), end_(end) {}
  Index begin() const { return begin_; }
  Index end() const { return end_; }

 private:
  Index begin_, end_;
};

template <class Index, class Work>
void parallel_for(const blocked_range<Index>& range, const Work& work, task_group_context& context) {
  constexpr Index length = 64;
  const Index number = range.end() - range.begin();
  const auto stretch = [&](Index i) {
    work(blocked_range<Index>(range.begin() + i * length, range.begin() + std::min((i + 1) * length, number)));
  };
  parallel_for(Index(0), (number + length - 1) / length, stretch, simple_partitioner(), context);
}

template <class Value>
class enumerable_thread_specific {
 public:
  explicit enumerable_thread_specific(std::function<Value()> make) : make_(std::move(make)) {}

  Value& local() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::unique_ptr<Value>& value = values_[std::this_thread::get_id()];
    if (!value) value = std::make_unique<Value>(make_());
    return *value;
  }

 private:
  std::function<Value()> make_;
  std::mutex mutex_;
  std::map<std::thread::id, std::unique_ptr<Value>> values_;
};

namespace this_task_arena {

template <class Work>
void isolate(const Work& work) {
  work();
}

}  // namespace this_task_arena

class task_arena {
 public:
  explicit task_arena(int /* threads */) {}
  template <class Work>
  auto execute(const Work& work) {
    return work();
  }
};

}  // namespace tbb

#endif
