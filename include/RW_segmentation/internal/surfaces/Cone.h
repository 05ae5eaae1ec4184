// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_CONE_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_CONE_H

#include <RW_segmentation/internal/surfaces/Scaled_samples.h>
#include <RW_segmentation/internal/surfaces/Surface_of_revolution.h>
#include <RW_segmentation/internal/surfaces/solve_symmetric.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

namespace RW_segmentation::internal {

/// Lines through an apex, at one angle to an axis.
struct Cone : Surface_of_revolution<Cone> {
  static constexpr const char* name = "cone";
  static constexpr int degrees_of_freedom = 6;
  static constexpr int shifts = 3, turns = 2;
  static constexpr bool is_placed_along_axis = true;

  double half_angle = 0;
  double cosine = 1, sine = 0;  ///< of it

  template <class Surface>
  static auto numbers(Surface& surface) {
    return std::tie(surface.half_angle);
  }
  void prepare() {
    cosine = std::cos(half_angle);
    sine = std::sin(half_angle);
  }

  template <class Number>
  Meridian_distance<Number> meridian(const Number& s, const Number& h) const {
    return {s * cosine - h * sine, all<Number>(cosine), all<Number>(-sine)};
  }
  template <class Number>
  void shape_derivatives(const Number& s, const Number& h, const Meridian_distance<Number>&, Number* row) const {
    row[0] = -s * sine - h * cosine;
  }

  /// All normals make one angle with the axis, and all tangent planes meet in the apex.
  static std::vector<Cone> first_guesses(const Scaled_samples& samples) {
    constexpr double determined = 1e-9;  // added to the matrix, lest normals in a plane make it singular
    const auto count = static_cast<double>(samples.normals().size());
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    Eigen::Vector3d mean_normal = Eigen::Vector3d::Zero(), right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < samples.normals().size(); ++i) {
      const Eigen::Vector3d& n = samples.normals()[i];
      sum += n * n.transpose();
      right += n * n.dot(samples.scaled(samples.normal_points()[i]));
      mean_normal += n / count;
    }
    const Eigen::Vector3d apex = solve_symmetric<3>(sum + determined * Eigen::Matrix3d::Identity(), right);
    if (!(apex.norm() < 2 * Scaled_samples::largest_ratio)) return {};
    Cone cone;
    cone.point = samples.unscaled(apex);
    cone.direction = Scaled_samples::eigenvector_of_least(sum / count - mean_normal * mean_normal.transpose());
    if ((samples.mean() - cone.point).dot(cone.direction) < 0) cone.direction = -cone.direction;
    cone.half_angle = cone.mean_angle(samples.points());
    cone.prepare();
    return {cone};
  }

  bool is_sound(const Scaled_samples& samples) const {
    constexpr double smallest_half_angle = 0.02, largest_half_angle = 1.55;  // radians: a needle, and all but a plane
    constexpr double behind_apex = 1e-3;                                     // in spreads of the points: rounding
    return half_angle > smallest_half_angle && half_angle < largest_half_angle &&
           std::all_of(samples.points().begin(), samples.points().end(), [&](const Eigen::Vector3d& p) {
             return (p - point).dot(direction) > -behind_apex * samples.spread();  // one nappe
           });
  }

 private:
  /// The mean of the angles between the axis and the ways from the apex to points.
  double mean_angle(const std::vector<Eigen::Vector3d>& points) const {
    double sum = 0;
    for (const Eigen::Vector3d& p : points) {
      const Eigen::Vector3d q = p - point;
      const double height = q.dot(direction);
      sum += std::atan2((q - height * direction).norm(), height);
    }
    return sum / static_cast<double>(points.size());
  }
};

}  // namespace RW_segmentation::internal

#endif
