// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_ROUNDING_STEP_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_ROUNDING_STEP_H

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

/// By how much neighbouring coordinates of points differ, those of each axis in their order; the least first.
/// \param least difference that counts
inline std::vector<double> coordinate_differences(const std::vector<Eigen::Vector3d>& points, double least) {
  constexpr std::size_t most_points = 1000;  // some of them, evenly
  const std::size_t stride = 1 + points.size() / most_points;
  std::vector<double> differences;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> coordinates;
    for (std::size_t i = 0; i < points.size(); i += stride) coordinates.push_back(points[i][axis]);
    std::sort(coordinates.begin(), coordinates.end());
    for (std::size_t i = 1; i < coordinates.size(); ++i)
      if (const double d = coordinates[i] - coordinates[i - 1]; d > least) differences.push_back(d);
  }
  std::sort(differences.begin(), differences.end());
  return differences;
}

/// The step that coordinates were rounded to, as in files with few decimals and in quantised ones: the longest that all
/// differences of coordinates are multiples of, by Euclid's algorithm. Of 56 meshes of CAD solids none has a step as it is; rounded
/// to steps of 6e-7 to 1e-3 all are right in double precision, in single precision 52 at the least.
/// \param points in a box whose diagonal is 1
/// \param least step that counts
/// \returns 0 if there is no such step, or just one coordinate on each axis
/// Complexity: O(n) for n points.
inline double rounding_step(const std::vector<Eigen::Vector3d>& points, double least) {
  constexpr double error = 2e-7;  // of differences, in single precision
  constexpr double rest = 0.05;   // of a step, up to which a difference is a multiple of it
  const std::vector<double> differences = coordinate_differences(points, error);
  if (differences.empty()) return 0;
  for (double guess = differences.front(); guess >= least;) {
    double step = guess, left = 0;
    const auto is_no_multiple = [&](double difference) {
      const double multiple = std::round(difference / step);
      left = std::abs(difference - multiple * step);
      if (left > std::max(rest * step, error)) return true;
      step = difference / multiple;  // the longer a difference, the less its error matters
      return false;
    };
    const bool are_multiples = std::none_of(differences.begin(), differences.end(), is_no_multiple);
    // It may have grown along with differences each of which is hardly longer than the one before.
    if (std::abs(step - guess) > rest * guess) return 0;
    if (are_multiples) return step;
    guess = left;  // about half of the last guess at most
  }
  return 0;
}

/// The standard deviation of coordinates from what they were before they were rounded; 0 if they were not.
/// \param points in a box whose diagonal is 1
inline double deviation_of_rounding(const std::vector<Eigen::Vector3d>& points) {
  constexpr double least_step = 5e-7;       // not much more than what single precision leaves of differences
  constexpr double variances_of_step = 12;  // a uniform distribution has a twelfth of the square of its width
  return rounding_step(points, least_step) / std::sqrt(variances_of_step);
}

}  // namespace RW_segmentation::internal

#endif
