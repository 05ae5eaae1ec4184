// SPDX-License-Identifier: MIT

#include "../benchmark/segmentation_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <set>
#include <vector>

namespace test_segmentation_measures {

using namespace segmentation_measures;

namespace {

using Labels = std::vector<int>;

Labels random_labels(std::size_t faces, int labels, unsigned seed) {
  std::mt19937 random(seed);
  Labels result;
  for (std::size_t f = 0; f < faces; ++f) result.push_back(static_cast<int>(random() % static_cast<unsigned>(labels)));
  return result;
}

double rand_index_error_by_pairs(const Labels& a, const Labels& b) {
  double different = 0, pairs = 0;
  for (std::size_t f = 0; f < a.size(); ++f)
    for (std::size_t g = f + 1; g < a.size(); ++g) {
      different += (a[f] == a[g]) != (b[f] == b[g]);
      pairs += 1;
    }
  return different / pairs;
}

/// The share of faces of `a` that the best matching segments of `b` do not cover.
double directional_hamming(const Labels& a, const Labels& b) {
  double uncovered = 0;
  for (const int i : std::set<int>(a.begin(), a.end())) {
    std::size_t size = 0, most = 0;
    for (const int j : std::set<int>(b.begin(), b.end())) {
      std::size_t shared = 0;
      for (std::size_t f = 0; f < a.size(); ++f) shared += a[f] == i && b[f] == j;
      size += shared;
      most = std::max(most, shared);
    }
    uncovered += static_cast<double>(size - most);
  }
  return uncovered / static_cast<double>(a.size());
}

/// |R(a, f) \ R(b, f)| / |R(a, f)| for the segments R of face f.
double refinement_error(const Labels& a, const Labels& b, std::size_t f) {
  double outside = 0, size = 0;
  for (std::size_t g = 0; g < a.size(); ++g) {
    size += a[g] == a[f];
    outside += a[g] == a[f] && b[g] != b[f];
  }
  return outside / size;
}

}  // namespace

TEST(SegmentationMeasures, AgreeWithTheirDefinitions) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Labels a = random_labels(60, 1 + static_cast<int>(seed % 7), seed);
    const Labels b = random_labels(60, 1 + static_cast<int>(seed % 5), seed + 100);
    const Overlaps overlaps(a, b);
    EXPECT_NEAR(overlaps.rand_index_error(), rand_index_error_by_pairs(a, b), 1e-12);
    EXPECT_NEAR(overlaps.hamming_distance(), (directional_hamming(a, b) + directional_hamming(b, a)) / 2, 1e-12);
    double a_to_b = 0, b_to_a = 0, local = 0;
    for (std::size_t f = 0; f < a.size(); ++f) {
      const double x = refinement_error(a, b, f), y = refinement_error(b, a, f);
      a_to_b += x / 60;
      b_to_a += y / 60;
      local += std::min(x, y) / 60;
    }
    EXPECT_NEAR(overlaps.global_consistency_error(), std::min(a_to_b, b_to_a), 1e-12);
    EXPECT_NEAR(overlaps.local_consistency_error(), local, 1e-12);
  }
}

TEST(SegmentationMeasures, AreZeroForOneSegmentationUnderOtherNames) {
  const Labels a = random_labels(50, 5, 1);
  Labels b = a;
  for (int& label : b) label = 100 - 7 * label;
  const Overlaps overlaps(a, b);
  EXPECT_NEAR(overlaps.rand_index_error(), 0, 1e-15);
  EXPECT_NEAR(overlaps.hamming_distance(), 0, 1e-15);
  EXPECT_NEAR(overlaps.global_consistency_error(), 0, 1e-15);
}

TEST(SegmentationMeasures, ConsistencyErrorsForgiveRefinement) {
  const Overlaps overlaps(Labels{0, 0, 0, 0}, Labels{0, 0, 1, 2});
  EXPECT_EQ(overlaps.global_consistency_error(), 0);
  EXPECT_EQ(overlaps.local_consistency_error(), 0);
  EXPECT_NEAR(overlaps.rand_index_error(), 5. / 6, 1e-15);
  EXPECT_NEAR(overlaps.hamming_distance(), 0.25, 1e-15);
}

TEST(SegmentationMeasures, RejectDifferentNumbersOfFaces) {
  EXPECT_THROW(Overlaps(Labels{0, 1}, Labels{0}), std::invalid_argument);
}

TEST(SegmentationMeasures, ModeIsTheMostFrequentNumberNearestTheMedian) {
  EXPECT_EQ(mode_nearest_median({3}), 3u);
  EXPECT_EQ(mode_nearest_median({8, 2, 2, 9, 10}), 2u);
  EXPECT_EQ(mode_nearest_median({2, 2, 5, 6, 6}), 6u) << "median 5";
  EXPECT_EQ(mode_nearest_median({2, 2, 3, 6, 6}), 2u) << "median 3";
}

}  // namespace test_segmentation_measures
