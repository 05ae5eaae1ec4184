// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_PLANE_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_PLANE_H

#include <RW_segmentation/internal/surfaces/Scaled_samples.h>
#include <RW_segmentation/internal/surfaces/Surface_of_revolution.h>

#include <Eigen/Core>

#include <tuple>
#include <vector>

namespace RW_segmentation::internal {

/// Flat, through a point and orthogonal to a direction.
struct Plane : Placed_surface {
  static constexpr const char* name = "plane";
  static constexpr int degrees_of_freedom = 3;
  static constexpr int shifts = 1, turns = 2;
  static constexpr bool first_guess_is_closest = true;

  template <class Surface>
  static auto numbers(Surface&) {
    return std::tie();
  }

  double distance(const Eigen::Vector3d& p) const { return distance(coordinates(p)); }
  template <class Number>
  Number distance(const Coordinates<Number>& p) const {
    return p.minus(point).dot(direction);
  }
  Eigen::Vector3d normal(const Eigen::Vector3d&) const { return direction; }

  template <class Number, class Row>
  Number derivatives(const Coordinates<Number>& p, const Frame& frame, Row& row) const {
    const Coordinates<Number> q = p.minus(point);
    row[0] = all<Number>(-1);
    row[1] = q.dot(frame.first);
    row[2] = q.dot(frame.second);
    return q.dot(direction);
  }

  static std::vector<Plane> first_guesses(const Scaled_samples& samples) {
    Plane plane;
    plane.point = samples.mean();
    plane.direction = samples.flattest_direction();
    return {plane};
  }
  bool is_sound(const Scaled_samples&) const { return true; }
};

}  // namespace RW_segmentation::internal

#endif
