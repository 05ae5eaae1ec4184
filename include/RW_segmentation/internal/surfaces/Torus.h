// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_TORUS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_TORUS_H

#include <RW_segmentation/internal/surfaces/Principal_axes.h>
#include <RW_segmentation/internal/surfaces/Scaled_samples.h>
#include <RW_segmentation/internal/surfaces/Surface_of_revolution.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>
#include <vector>

namespace RW_segmentation::internal {

/// At one distance from a circle.
struct Torus : Surface_of_revolution<Torus> {
  static constexpr const char* name = "torus";
  static constexpr int degrees_of_freedom = 7;
  static constexpr int shifts = 3, turns = 2;
  static constexpr bool is_placed_along_axis = true;

  double radius = 0, tube_radius = 0;

  template <class Surface>
  static auto numbers(Surface& surface) {
    return std::tie(surface.radius, surface.tube_radius);
  }

  template <class Number>
  Meridian_distance<Number> meridian(const Number& s, const Number& h) const {
    const Number off_circle = s - radius;
    const Number from_circle = square_root(off_circle * off_circle + h * h);
    const Number unit = 1 / at_least(from_circle, std::numeric_limits<double>::min());
    return {from_circle - tube_radius, off_circle * unit, h * unit};
  }
  template <class Number>
  void shape_derivatives(const Number&, const Number&, const Meridian_distance<Number>& m, Number* row) const {
    row[0] = -m.off_axis;
    row[1] = all<Number>(-1);
  }

  /// All normals of a surface of revolution meet its axis: their Pluecker coordinates lie in the linear complex of the
  /// axis (Pottmann and Randrup 1998). The meridian is a circle then.
  static std::vector<Torus> first_guesses(const Scaled_samples& samples) {
    constexpr double least_axis = 1e-2;  // of a unit complex; one with less of it is a shift, and no rotation
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    using Matrix6 = Eigen::Matrix<double, 6, 6>;
    Matrix6 sum = Matrix6::Zero();
    for (std::size_t i = 0; i < samples.normals().size(); ++i) {
      Vector6 line;
      line << samples.scaled(samples.normal_points()[i]).cross(samples.normals()[i]), samples.normals()[i];
      sum += line * line.transpose();
    }
    const Small_matrix complexes = Principal_axes(sum).vectors();
    std::vector<Torus> guesses;
    for (int k = 0; k < 2; ++k) {  // the second one, too, where a piece is so small that it turns about two axes
      const Eigen::Vector3d axis = complexes.col(k).head<3>(), moment = complexes.col(k).tail<3>();
      if (axis.norm() >= least_axis)
        add_guess(samples, axis.normalized(), axis.cross(moment) / axis.squaredNorm(), guesses);
    }
    return guesses;
  }

  bool is_sound(const Scaled_samples& samples) const {
    constexpr double least_ratio = 0.05;  // of the radii; a thinner ring cannot be told from a sphere
    return samples.can_tell_radius(tube_radius) && samples.can_tell_radius(radius) &&
           radius > least_ratio * tube_radius;
  }

 private:
  /// \param foot a point of the axis, scaled
  static void add_guess(const Scaled_samples& samples, const Eigen::Vector3d& axis, const Eigen::Vector3d& foot,
                        std::vector<Torus>& guesses) {
    if (foot.norm() > Scaled_samples::largest_ratio) return;
    const auto circle = samples.algebraic_ball<2>([&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d q = samples.scaled(p) - foot;
      const double height = q.dot(axis);
      return Eigen::Vector2d((q - height * axis).norm(), height);
    });
    if (!circle) return;
    Torus torus;
    torus.direction = axis;
    torus.point = samples.unscaled(foot + (*circle)[1] * axis);
    torus.radius = samples.spread() * (*circle)[0];
    torus.tube_radius = samples.spread() * (*circle)[2];
    guesses.push_back(torus);
  }
};

}  // namespace RW_segmentation::internal

#endif
