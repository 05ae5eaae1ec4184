// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_CYLINDER_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_CYLINDER_H

#include <RW_segmentation/internal/surfaces/Scaled_samples.h>
#include <RW_segmentation/internal/surfaces/Surface_of_revolution.h>

#include <Eigen/Core>

#include <tuple>
#include <vector>

namespace RW_segmentation::internal {

/// At one distance from a line.
struct Cylinder : Surface_of_revolution<Cylinder> {
  static constexpr const char* name = "cylinder";
  static constexpr int degrees_of_freedom = 5;
  static constexpr int shifts = 2, turns = 2;
  static constexpr bool is_placed_along_axis = false;

  double radius = 0;

  template <class Surface>
  static auto numbers(Surface& surface) {
    return std::tie(surface.radius);
  }

  template <class Number>
  Meridian_distance<Number> meridian(const Number& s, const Number&) const {
    return {s - radius, all<Number>(1), all<Number>(0)};
  }
  template <class Number>
  void shape_derivatives(const Number&, const Number&, const Meridian_distance<Number>&, Number* row) const {
    row[0] = all<Number>(-1);
  }

  /// All normals are orthogonal to the axis.
  static std::vector<Cylinder> first_guesses(const Scaled_samples& samples) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& n : samples.normals()) sum += n * n.transpose();
    Cylinder cylinder;
    cylinder.direction = Scaled_samples::eigenvector_of_least(sum);
    const Frame across(cylinder);
    const auto circle = samples.algebraic_ball<2>([&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d q = samples.scaled(p);
      return Eigen::Vector2d(q.dot(across.first), q.dot(across.second));
    });
    if (!circle) return {};
    cylinder.point = samples.unscaled((*circle)[0] * across.first + (*circle)[1] * across.second);
    cylinder.radius = samples.spread() * (*circle)[2];
    return {cylinder};
  }
  bool is_sound(const Scaled_samples& samples) const { return samples.can_tell_radius(radius); }
};

}  // namespace RW_segmentation::internal

#endif
