// SPDX-License-Identifier: MIT

// What a computation tells of how far it has come.

#include <RW_segmentation/Progress.h>

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <vector>

namespace test_progress {

using namespace RW_segmentation;

namespace {

struct Told_progress : testing::Test {
  std::vector<double> told;
  const Progress progress{[this](double fraction) {
    told.push_back(fraction);
    return true;
  }};
};

}  // namespace

TEST_F(Told_progress, IsTheFractionThatIsDone) {
  for (const double fraction : {0., 0.25, 1.}) progress(fraction);
  EXPECT_EQ(told, (std::vector<double>{0, 0.25, 1}));
}

TEST_F(Told_progress, OfAPartIsThatOfTheWhole) {
  const Progress second_half = progress.part(0.5, 1);
  for (const double fraction : {0., 0.5, 1.}) second_half(fraction);
  const Progress its_first_half = second_half.part(0, 0.5);
  for (const double fraction : {0., 0.5, 1.}) its_first_half(fraction);
  progress.part(0.25, 0.5).part(0.5, 1)(0.5);
  EXPECT_EQ(told, (std::vector<double>{0.5, 0.75, 1, 0.5, 0.625, 0.75, 0.4375}));
}

TEST(Progress, CancelsOrPassesOnWhatTheCallbackThrows) {
  const Progress cancelled{[](double fraction) { return fraction < 0.5; }};
  EXPECT_NO_THROW(cancelled(0.4));
  EXPECT_THROW(cancelled(0.5), Cancelled);
  EXPECT_THROW(cancelled.part(0.4, 0.6)(0.5), Cancelled);
  const Progress thrown{[](double) -> bool { throw std::domain_error("of the user"); }};
  EXPECT_THROW(thrown(0), std::domain_error);
}

TEST(Progress, MayBeToldToNobody) {
  EXPECT_NO_THROW(Progress()(1));
  EXPECT_NO_THROW(Progress(std::function<bool(double)>()).part(0, 0.5)(1));
}

}  // namespace test_progress
