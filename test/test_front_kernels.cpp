// SPDX-License-Identifier: MIT

// The dense arithmetic of the elimination against its definition, on each instruction set that this machine has.

#include <RW_segmentation/internal/solver/front_kernels.h>

#include <CGAL/tags.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace test_front_kernels {

using namespace RW_segmentation::internal;

namespace {

std::vector<Instruction_set> instruction_sets() {
  std::vector<Instruction_set> sets;
  for (const Instruction_set set : {Instruction_set::portable, Instruction_set::avx2, Instruction_set::avx512})
    if (set <= best_instruction_set()) sets.push_back(set);
  return sets;
}

std::vector<double> random_numbers(std::size_t number, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> numbers(number);
  for (double& x : numbers) x = uniform(random);
  return numbers;
}

/// The numbers that a front points to.
struct Numbers {
  std::size_t pivots = 0, rows = 0;
  std::vector<double> panel, remainder, ground, sum, transition;
  std::vector<std::uint32_t> absorbing;

  std::size_t size() const { return pivots + rows; }
};

Numbers random_front(std::size_t pivots, std::size_t rows, bool has_ground, std::mt19937& random) {
  Numbers front;
  front.pivots = pivots;
  front.rows = rows;
  front.panel = random_numbers((pivots + rows) * pivots, random);
  front.remainder.assign(rows * rows, 0.);
  if (has_ground) front.ground = random_numbers(pivots + rows, random);
  front.sum.resize(pivots);
  front.transition.resize(pivots * (pivots - 1) / 2 + pivots * rows);
  for (std::size_t k = 0; k < pivots; ++k) front.absorbing.push_back(k % 20 == 10);
  return front;
}

template <class Eliminate>
void run(Numbers& numbers, const Eliminate& eliminate) {
  std::vector<double> scaled(numbers.size() * front_block), packed(kernel::packed_size(numbers.size()));
  eliminate(Front{numbers.pivots, numbers.rows, numbers.panel.data(), numbers.remainder.data(),
                  numbers.absorbing.data(), numbers.ground.empty() ? nullptr : numbers.ground.data(),
                  numbers.sum.data(), numbers.transition.data(), scaled.data(), packed.data()});
}

/// Pivot by pivot, each joined to all that come later: c_ij += c_ik c_jk / d_k.
void eliminate_by_definition(Numbers& numbers) {
  const std::size_t size = numbers.size();
  std::vector<long double> c(size * size, 0);
  for (std::size_t k = 0; k < numbers.pivots; ++k)
    for (std::size_t i = k + 1; i < size; ++i) c[k * size + i] = numbers.panel[k * size + i];
  std::vector<long double> ground(numbers.ground.begin(), numbers.ground.end());
  auto transition = numbers.transition.begin();
  for (std::size_t k = 0; k < numbers.pivots; ++k) {
    long double d = ground.empty() ? 0 : ground[k];
    for (std::size_t i = k + 1; i < size; ++i) d += c[k * size + i];
    numbers.sum[k] = numbers.absorbing[k] ? 0 : static_cast<double>(d);
    for (std::size_t i = k + 1; i < size; ++i) {
      const long double share = d > 0 ? c[k * size + i] / d : 0;
      *transition++ = static_cast<double>(numbers.absorbing[k] ? c[k * size + i] : share);
      if (!ground.empty()) ground[i] += numbers.absorbing[k] ? c[k * size + i] : share * ground[k];
      if (!numbers.absorbing[k])
        for (std::size_t j = k + 1; j < i; ++j) c[j * size + i] += share * c[k * size + j];
    }
  }
  for (std::size_t i = 0; i < ground.size(); ++i) numbers.ground[i] = static_cast<double>(ground[i]);
  for (std::size_t j = 0; j < numbers.rows; ++j)
    for (std::size_t i = j + 1; i < numbers.rows; ++i)
      numbers.remainder[j * numbers.rows + i] =
          static_cast<double>(c[(numbers.pivots + j) * size + numbers.pivots + i]);
}

void expect_close(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_NEAR(found[i], expected[i], 1e-13 * expected[i]) << i;
}

void expect_same_result(Numbers found, const Numbers& expected) {
  for (std::size_t j = 0; j < found.rows; ++j)  // nothing is promised on and above the diagonal
    for (std::size_t i = 0; i <= j; ++i) found.remainder[j * found.rows + i] = 0;
  expect_close(found.sum, expected.sum);
  expect_close(found.transition, expected.transition);
  expect_close(found.remainder, expected.remainder);
  expect_close(found.ground, expected.ground);
}

// Smaller and larger than a tile, a block and the rows of a task, and not multiples of them.
const std::vector<std::pair<std::size_t, std::size_t>> sizes = {{1, 0},  {1, 1},   {3, 5},  {32, 2},  {33, 25},
                                                                {70, 0}, {75, 61}, {4, 40}, {40, 300}};

}  // namespace

TEST(FrontKernels, EliminateAsTheStarMeshTransformIsDefined) {
  std::mt19937 random(1);
  for (const auto& [pivots, rows] : sizes)
    for (const bool has_ground : {false, true}) {
      const Numbers front = random_front(pivots, rows, has_ground, random);
      Numbers expected = front;
      eliminate_by_definition(expected);
      for (const Instruction_set set : instruction_sets()) {
        SCOPED_TRACE(testing::Message() << pivots << " pivots, " << rows << " rows, set " << static_cast<int>(set));
        Numbers alone = front, shared = front, in_turn = front;
        run(alone, [set = set](const Front& f) { eliminate(f, set); });
        run(shared, [set = set](const Front& f) { eliminate_in_parallel<CGAL::Parallel_if_available_tag>(f, set); });
        run(in_turn, [set = set](const Front& f) { eliminate_in_parallel<CGAL::Sequential_tag>(f, set); });
        expect_same_result(alone, expected);
        expect_same_result(shared, expected);
        expect_same_result(in_turn, expected);
      }
    }
}

TEST(FrontKernels, LeaveNothingOfPivotsThatAreCutOffAndKeepTheSharesOfTheFaintest) {
  std::mt19937 random(2);
  Numbers front = random_front(6, 30, true, random);
  for (std::size_t i = 0; i < front.size(); ++i) {
    front.panel[2 * front.size() + i] = 0;
    front.panel[4 * front.size() + i] *= 1e-300;
    for (const std::size_t k : {0u, 1u, 3u}) front.panel[k * front.size() + 2] = front.panel[k * front.size() + 4] = 0;
  }
  front.ground[2] = front.ground[4] = 0;
  Numbers expected = front;
  eliminate_by_definition(expected);
  double faintest = 0;
  for (std::size_t i = 0; i < 31; ++i) faintest += expected.transition[35 + 34 + 33 + 32 + i];
  ASSERT_NEAR(faintest, 1, 1e-14);
  for (const Instruction_set set : instruction_sets()) {
    Numbers found = front;
    run(found, [set = set](const Front& f) { eliminate(f, set); });
    expect_same_result(found, expected);
  }
}

namespace {

template <std::size_t labels>
void expect_substitutes_as_defined() {
  std::mt19937 random(3);
  for (const auto& [pivots, rows] : sizes) {
    const std::size_t size = pivots + rows;
    auto shares = random_numbers(pivots * (pivots - 1) / 2 + pivots * rows, random);
    for (double& share : shares) share /= static_cast<double>(size);  // so that nothing grows
    const auto start = random_numbers(size * labels, random);
    std::vector<std::uint32_t> absorbing;
    for (std::size_t k = 0; k < pivots; ++k) absorbing.push_back(k % 7 == 2);
    std::vector<long double> expected(start.begin(), start.end());
    std::size_t column = shares.size();
    for (std::size_t k = pivots; k-- > 0;) {
      column -= size - k - 1;
      for (std::size_t l = 0; l < labels && !absorbing[k]; ++l)
        for (std::size_t i = k + 1; i < size; ++i)
          expected[k * labels + l] += shares[column + i - k - 1] * expected[i * labels + l];
    }
    for (const Instruction_set set : instruction_sets()) {
      std::vector<double> x = start;
      substitute<labels>(shares.data(), pivots, rows, absorbing.data(), x.data(), set);
      expect_close(x, std::vector<double>(expected.begin(), expected.end()));
    }
  }
}

}  // namespace

TEST(FrontKernels, SubstituteEachFaceByTheSharesOfLaterOnes) {
  expect_substitutes_as_defined<1>();
  expect_substitutes_as_defined<2>();
  expect_substitutes_as_defined<4>();
  expect_substitutes_as_defined<8>();
  expect_substitutes_as_defined<16>();
}

TEST(FrontKernels, SubtractMultiplesAndLeaveNothingNegative) {
  std::mt19937 random(7);
  const std::size_t count = 1003;
  const auto from = random_numbers(count, random), start = random_numbers(count, random);
  for (const double factor : {0.75, -0.75})
    for (const Instruction_set set : instruction_sets()) {
      std::vector<double> to = start;
      subtract_multiple(factor, from.data(), count, to.data(), set);
      for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR(to[i], std::max(0., start[i] - factor * from[i]), 1e-15);
    }
}

TEST(FrontKernels, SelectTheLargestPotentialAndTheFirstOfEqualOnes) {
  const std::size_t count = 1003, ranks = 5;
  std::mt19937 random(4);
  std::vector<std::vector<double>> potential(ranks, std::vector<double>(count));
  for (auto& values : potential)
    for (double& p : values) p = static_cast<double>(random() % 4) / 4;
  for (const Instruction_set set : instruction_sets()) {
    std::vector<double> largest(count, -1.), best(count, -1.), total(count, 0.);
    for (std::size_t l = 0; l < ranks; ++l)
      select_largest(potential[l].data(), static_cast<double>(l), count, {largest.data(), best.data(), total.data()},
                     set);
    for (std::size_t i = 0; i < count; ++i) {
      double sum = 0, first = 0;
      for (std::size_t l = 0; l < ranks; ++l) {
        sum += potential[l][i];
        EXPECT_LE(potential[l][i], largest[i]);
        if (potential[l][i] < largest[i] && first == static_cast<double>(l)) ++first;
      }
      EXPECT_EQ(total[i], sum);
      EXPECT_EQ(best[i], first);
      EXPECT_EQ(potential[static_cast<std::size_t>(best[i])][i], largest[i]);
    }
  }
}

}  // namespace test_front_kernels
