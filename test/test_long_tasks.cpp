// SPDX-License-Identifier: MIT

// Tasks that are worth a thread each.

#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/long_tasks.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace test_long_tasks {

using namespace RW_segmentation;
using internal::long_tasks;

TEST(LongTasks, AreDoneOnceEachTheLargestFirst) {
  std::vector<std::size_t> order;
  const std::vector<std::size_t> sizes = {3, 1, 7, 7, 2};
  long_tasks(
      sizes, Progress(), [&](std::size_t task, const Progress&) { order.push_back(task); }, false);
  EXPECT_EQ(order, (std::vector<std::size_t>{2, 3, 0, 4, 1}));
  std::vector<std::atomic<int>> times(100);
  long_tasks(
      std::vector<std::size_t>(100, 5), Progress(), [&](std::size_t task, const Progress&) { ++times[task]; }, true);
  for (const auto& t : times) EXPECT_EQ(t, 1);
}

TEST(LongTasks, HaveSharesOfTheProgressByTheirSizes) {
  std::vector<double> seen;
  const Progress progress([&](double fraction) {
    seen.push_back(fraction);
    return true;
  });
  long_tasks(
      {1, 3}, progress,
      [](std::size_t, const Progress& part) {
        part(0.5);
        part(1);
      },
      false);
  EXPECT_EQ(seen, (std::vector<double>{0.375, 0.75, 0.875, 1, 1}));
}

TEST(LongTasks, EndTheOthersByWhatOneOfThemThrows) {
  for (const bool concurrent : {false, true}) {
    std::atomic<int> ended = 0;
    const auto work = [&](std::size_t task, const Progress& part) {
      if (task == 0) throw std::domain_error("the first one");
      try {
        for (;;) part(0.5);
      } catch (const Cancelled&) {
        ++ended;
        throw;
      }
    };
    EXPECT_THROW(long_tasks({2, 1}, Progress(), work, concurrent), std::domain_error);
    EXPECT_LE(ended, 1);
  }
}

}  // namespace test_long_tasks
