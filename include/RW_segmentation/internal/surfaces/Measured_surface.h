// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_MEASURED_SURFACE_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_MEASURED_SURFACE_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Surface_samples.h>
#include <RW_segmentation/internal/surfaces/Least_squares_surface.h>
#include <RW_segmentation/internal/surfaces/Principal_axes.h>
#include <RW_segmentation/internal/surfaces/Scaled_samples.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_types.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The inverse of a matrix of normal equations; infinite where it is singular.
inline Small_matrix covariance_of(const Small_matrix& normal_matrix) {
  constexpr double determined = 1e-14;  // of the largest eigenvalue: beyond it, rounding alone tells an unknown
  const Eigen::Index n = normal_matrix.rows();
  Small_matrix covariance = Small_matrix::Constant(n, n, std::numeric_limits<double>::infinity());
  const Small_matrix scale = normal_matrix.diagonal().cwiseSqrt();
  if (!(scale.minCoeff() > 0)) return covariance;
  Small_matrix scaled = normal_matrix;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) scaled(i, j) /= scale(i) * scale(j);
  const Principal_axes axes(scaled);
  const auto values = axes.values();
  const Small_matrix& vectors = axes.vectors();
  if (!(values[0] > determined * values[n - 1])) return covariance;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      double inverse = 0;
      for (Eigen::Index k = 0; k < n; ++k) inverse += vectors(i, k) * vectors(j, k) / values[k];
      covariance(i, j) = inverse / (scale(i) * scale(j));
    }
  return covariance;
}

inline double standard_deviation(double variance) {
  return std::isfinite(variance) ? std::sqrt(std::max(0., variance)) : std::numeric_limits<double>::infinity();
}

/// The standard deviation in the direction in which some unknowns are known least.
inline double largest_error(const Small_matrix& covariance, Eigen::Index first, Eigen::Index count) {
  if (count == 0) return 0;
  const Small_matrix block = covariance.block(first, first, count, count);
  if (!block.allFinite()) return std::numeric_limits<double>::infinity();
  return standard_deviation(Principal_axes(block).values()[count - 1]);
}

/// Sets where a cone's axis is known best, and its error there: not apart from its turn, the apex is known less.
inline void set_axis_errors(const Small_matrix& covariance, Surface_errors& errors) {
  constexpr Eigen::Index turn = Cone::shifts;  // the turns that move the axis in the directions of the first two shifts
  const double turns = covariance(turn, turn) + covariance(turn + 1, turn + 1);
  errors.axis = std::numeric_limits<double>::infinity();
  if (!covariance.allFinite() || !(turns > 0)) return;
  const double height = -(covariance(0, turn) + covariance(1, turn + 1)) / turns;
  Small_matrix place(2, 2);
  for (Eigen::Index i = 0; i < 2; ++i)
    for (Eigen::Index j = 0; j < 2; ++j)
      place(i, j) = covariance(i, j) + height * (covariance(i, turn + j) + covariance(turn + i, j)) +
                    height * height * covariance(turn + i, turn + j);
  errors.axis = largest_error(place, 0, 2);
  errors.axis_height = height;
}

/// The errors of the numbers of a surface from their covariance.
template <class Type>
Surface_errors surface_errors(const Small_matrix& covariance) {
  Surface_errors errors;
  errors.point = largest_error(covariance, 0, Type::shifts);
  errors.direction = largest_error(covariance, Type::shifts, Type::turns);
  int k = Type::shifts + Type::turns;
  std::apply([&](auto&... number) { ((number = standard_deviation(covariance(k, k)), ++k), ...); },
             Type::numbers(errors));
  if constexpr (std::is_same_v<Type, Cone>) set_axis_errors(covariance, errors);
  return errors;
}

/// The points that are not much farther from a surface than most: faces that a segmentation got wrong have vertices off it.
template <class Type>
std::vector<Eigen::Vector3d> without_strays(const Type& surface, const std::vector<Eigen::Vector3d>& points) {
  constexpr double most = 0.75;   // of the points; as many Gaussian ones are within 1.15 standard deviations
  constexpr double farther = 7;   // eight standard deviations
  constexpr double exact = 1e-7;  // of the diagonal: single precision
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const Eigen::Vector3d& p : points) distances.push_back(std::abs(surface.distance(p)));
  std::vector<double> sorted = distances;
  const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(most * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), place, sorted.end());
  const double largest = farther * *place + exact;
  std::vector<Eigen::Vector3d> kept;
  kept.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (distances[i] <= largest) kept.push_back(points[i]);
  return kept;
}

/// A surface moved to where it is closest to points.
template <class Type>
Least_squares_surface<Type> closest_surface(Type surface, const Surface_samples& samples) {
  const Scaled_samples scaled(samples);
  if constexpr (Type::first_guess_is_closest) surface = Type::first_guesses(scaled).front();
  // Far from the points the place of an axis is told less well, and not apart from its direction.
  if constexpr (std::is_same_v<Type, Cylinder>)
    surface.point += (scaled.mean() - surface.point).dot(surface.direction) * surface.direction;
  return {surface, samples.points};
}

/// A surface moved to where it is closest to points, all but a few of which are close to it, with the errors that its
/// numbers have if the distances of these points are independent and of one variance: the covariance is
/// (J^T J)^-1 sum d^2 / (n - k) with the derivatives J of n distances d by k unknowns.
inline Analytic_surface measured_surface(const Analytic_surface& surface, const std::vector<Eigen::Vector3d>& points) {
  constexpr int rounds = 3;
  if (surface.type == Surface_type::free_form) return surface;
  return with_type_of(surface, [&](auto typed) {
    using Type = std::decay_t<decltype(typed)>;
    Surface_samples kept = {without_strays(typed, points), {}, {}};
    for (int round = 1; round < rounds; ++round) {
      typed = closest_surface(typed, kept).surface();
      std::vector<Eigen::Vector3d> closer = without_strays(typed, points);
      if (closer.size() == kept.points.size()) break;
      kept.points = std::move(closer);
    }
    Least_squares_surface<Type> fit = closest_surface(typed, kept);
    Analytic_surface result = as_analytic_surface(fit, surface.type);
    const auto n = static_cast<double>(kept.points.size());
    constexpr double freedom = Type::degrees_of_freedom;
    const double variance =
        n > freedom ? result.residual * result.residual * n / (n - freedom) : std::numeric_limits<double>::infinity();
    result.errors = surface_errors<Type>(variance * covariance_of(fit.normal_matrix()));
    return result;
  });
}

}  // namespace RW_segmentation::internal

#endif
