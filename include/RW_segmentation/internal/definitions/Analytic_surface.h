// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_ANALYTIC_SURFACE_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_ANALYTIC_SURFACE_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_types.h>

#include <algorithm>
#include <cmath>

namespace RW_segmentation {

RW_SEGMENTATION_INLINE int degrees_of_freedom(Surface_type type) {
  if (type == Surface_type::free_form) return 0;
  return internal::with_type(type, [](auto tag) { return decltype(tag)::type::degrees_of_freedom; });
}

RW_SEGMENTATION_INLINE const char* name_of(Surface_type type) {
  if (type == Surface_type::free_form) return "free form";
  return internal::with_type(type, [](auto tag) { return decltype(tag)::type::name; });
}

RW_SEGMENTATION_INLINE double Analytic_surface::signed_distance(const Eigen::Vector3d& p) const {
  return internal::with_type_of(*this, [&](const auto& surface) { return surface.distance(p); });
}

RW_SEGMENTATION_INLINE Eigen::Vector3d Analytic_surface::normal(const Eigen::Vector3d& p) const {
  return internal::with_type_of(*this, [&](const auto& surface) -> Eigen::Vector3d { return surface.normal(p); });
}

RW_SEGMENTATION_INLINE double root_mean_square_distance(const Analytic_surface& surface,
                                                        const std::vector<Eigen::Vector3d>& points) {
  if (points.empty()) return 0;
  const double squares =
      internal::with_type_of(surface, [&](const auto& s) { return internal::squared_distances(s, points); });
  return std::sqrt(squares / static_cast<double>(points.size()));
}

RW_SEGMENTATION_INLINE std::optional<Analytic_surface> fit_analytic_surface(Surface_type type,
                                                                            const Surface_samples& samples,
                                                                            double largest_residual) {
  return internal::Surface_fit(samples, largest_residual).fit(type);
}

RW_SEGMENTATION_INLINE Analytic_surface fit_analytic_surface(const Surface_samples& samples, double tolerance) {
  constexpr double turn_of_facets = 0.1;  // radians; 0.07 and 0.15 give the CAD solids the same segments
  const internal::Surface_fit fit(samples, 2 * tolerance);
  const auto n = static_cast<double>(samples.points.size());
  Analytic_surface best;
  double least = std::numeric_limits<double>::infinity();
  for (const Surface_type type : analytic_types) {
    const double penalty = degrees_of_freedom(type) * std::log(std::max(n, 2.));
    if (penalty >= least) break;
    const auto surface = fit.fit(type);
    if (!surface) continue;
    const double distances = surface->residual / tolerance;
    const double turns = internal::squared_turns(*surface, samples) / (turn_of_facets * turn_of_facets);
    const double criterion = n * distances * distances + turns + penalty;
    if (criterion < least) {
      least = criterion;
      best = *surface;
    }
  }
  return best;
}

}  // namespace RW_segmentation

#endif
