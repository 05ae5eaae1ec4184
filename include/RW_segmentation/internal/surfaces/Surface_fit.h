// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_FIT_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_FIT_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Surface_samples.h>
#include <RW_segmentation/internal/surfaces/Least_squares_surface.h>
#include <RW_segmentation/internal/surfaces/Scaled_samples.h>
#include <RW_segmentation/internal/surfaces/Surface_types.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>

namespace RW_segmentation::internal {

template <class Type>
Analytic_surface as_analytic_surface(const Least_squares_surface<Type>& fit, Surface_type type) {
  Analytic_surface surface;
  surface.type = type;
  surface.point = fit.surface().point;
  surface.direction = fit.surface().direction;
  Type::numbers(surface) = Type::numbers(fit.surface());
  surface.residual = fit.residual();
  return surface;
}

/// Fits surfaces of each type to the same samples.
class Surface_fit {
 public:
  /// \param largest_residual that is of use; surfaces farther off may be given up early
  explicit Surface_fit(const Surface_samples& samples,
                       double largest_residual = std::numeric_limits<double>::infinity())
      : samples_(samples), largest_residual_(largest_residual) {}

  /// The surface of a type; nothing if its residual is too large.
  std::optional<Analytic_surface> fit(Surface_type type) const {
    if (type == Surface_type::free_form ||
        samples_.points().size() < static_cast<std::size_t>(degrees_of_freedom(type)) || samples_.normals().empty() ||
        !(samples_.spread() > 0))
      return {};
    return with_type(type, [&](auto tag) {
      std::optional<Analytic_surface> closest;
      for (const auto& guess : decltype(tag)::type::first_guesses(samples_)) {
        const Least_squares_surface fit(guess, samples_.points(), largest_residual_);
        const bool is_closer = closest ? fit.residual() < closest->residual : fit.residual() <= largest_residual_;
        if (is_closer && fit.surface().is_sound(samples_)) closest = as_analytic_surface(fit, type);
      }
      return closest;
    });
  }

 private:
  const Scaled_samples samples_;
  const double largest_residual_;
};

/// A surface moved to where it is closest to other points, not far from those that it was fitted to.
/// \pre the surface is no free form
inline std::optional<Analytic_surface> fitted_again(const Analytic_surface& surface, const Surface_samples& samples) {
  return with_type_of(surface, [&](const auto& from) {
    if constexpr (std::decay_t<decltype(from)>::first_guess_is_closest)
      return Surface_fit(samples).fit(surface.type);
    else
      return std::optional(as_analytic_surface(Least_squares_surface(from, samples.points), surface.type));
  });
}

/// How far normals are off those of a surface, squared and summed.
/// \pre the surface is no free form
inline double squared_turns(const Analytic_surface& surface, const Surface_samples& samples) {
  return with_type_of(surface, [&](const auto& s) {
    double same = 0, opposite = 0;
    for (std::size_t i = 0; i < samples.normals.size(); ++i) {
      const Eigen::Vector3d n = s.normal(samples.normal_points[i]);
      same += (samples.normals[i] - n).squaredNorm();
      opposite += (samples.normals[i] + n).squaredNorm();
    }
    return std::min(same, opposite);
  });
}

}  // namespace RW_segmentation::internal

#endif
