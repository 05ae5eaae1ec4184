// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_SPHERE_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_SPHERE_H

#include <RW_segmentation/internal/surfaces/Scaled_samples.h>
#include <RW_segmentation/internal/surfaces/Surface_of_revolution.h>

#include <Eigen/Core>

#include <algorithm>
#include <limits>
#include <tuple>
#include <vector>

namespace RW_segmentation::internal {

/// At one distance from a point.
struct Sphere : Placed_surface {
  static constexpr const char* name = "sphere";
  static constexpr int degrees_of_freedom = 4;
  static constexpr int shifts = 3, turns = 0;

  double radius = 0;

  template <class Surface>
  static auto numbers(Surface& surface) {
    return std::tie(surface.radius);
  }

  double distance(const Eigen::Vector3d& p) const { return distance(coordinates(p)); }
  template <class Number>
  Number distance(const Coordinates<Number>& p) const {
    return square_root(p.minus(point).squared_norm()) - radius;
  }
  Eigen::Vector3d normal(const Eigen::Vector3d& p) const { return (p - point).normalized(); }

  template <class Number, class Row>
  Number derivatives(const Coordinates<Number>& p, const Frame&, Row& row) const {
    const Coordinates<Number> q = p.minus(point);
    const Number length = square_root(q.squared_norm());
    const Number unit = 1 / at_least(length, std::numeric_limits<double>::min());
    row[0] = -q.x * unit;
    row[1] = -q.y * unit;
    row[2] = -q.z * unit;
    row[3] = all<Number>(-1);
    return length - radius;
  }
  template <class Step>
  Sphere moved(const Step& step, const Frame&) const {
    Sphere result = *this;
    result.point += step.template head<3>();
    result.radius += step[3];
    return result;
  }

  static std::vector<Sphere> first_guesses(const Scaled_samples& samples) {
    const auto ball = samples.algebraic_ball<3>([&](const Eigen::Vector3d& p) { return samples.scaled(p); });
    if (!ball) return {};
    Sphere sphere;
    sphere.point = samples.unscaled(ball->head<3>());
    sphere.radius = samples.spread() * (*ball)[3];
    return {sphere};
  }
  bool is_sound(const Scaled_samples& samples) const { return samples.can_tell_radius(radius); }
};

}  // namespace RW_segmentation::internal

#endif
