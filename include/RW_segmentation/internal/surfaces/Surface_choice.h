// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_CHOICE_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_CHOICE_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Surface_samples.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

namespace RW_segmentation::internal {

/// A share of the numbers from 0 to a count: those of the least values, in ascending order.
template <class Value>
std::vector<std::size_t> least_of(std::size_t count, double share, const Value& value) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(value(i));
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  order.resize(static_cast<std::size_t>(std::ceil(share * static_cast<double>(count))));
  std::sort(order.begin(), order.end());
  return order;
}

/// The share of the samples that agrees best with a surface.
inline Surface_samples closest_samples(const Analytic_surface& surface, const Surface_samples& samples, double share) {
  return with_type_of(surface, [&](const auto& s) {
    Surface_samples closest;
    for (const std::size_t i :
         least_of(samples.points.size(), share, [&](std::size_t k) { return std::abs(s.distance(samples.points[k])); }))
      closest.points.push_back(samples.points[i]);
    for (const std::size_t i : least_of(samples.normals.size(), share, [&](std::size_t k) {
           return -std::abs(s.normal(samples.normal_points[k]).dot(samples.normals[k]));
         })) {
      closest.normal_points.push_back(samples.normal_points[i]);
      closest.normals.push_back(samples.normals[i]);
    }
    return closest;
  });
}

/// The surface that explains three quarters of the samples, where none explains all of them: least trimmed squares by
/// concentration steps (Rousseeuw and Van Driessen 2006). Faces that a segmentation got wrong are off the surface.
inline Analytic_surface surface_beside_strays(const Surface_samples& samples, double tolerance) {
  constexpr double share = 0.75;
  constexpr int steps = 4;
  const Surface_fit fit(samples);
  for (const Surface_type type : analytic_types) {
    std::optional<Analytic_surface> surface = fit.fit(type);
    Surface_samples closest;
    for (int step = 0; surface && step < steps; ++step) {
      closest = closest_samples(*surface, samples, share);
      surface = fitted_again(*surface, closest);
    }
    if (surface && surface->residual <= 2 * tolerance) return fit_analytic_surface(closest, tolerance);
  }
  return {};
}

/// Whether two surfaces touch in points that both have.
inline bool are_smoothly_joined(const Analytic_surface& a, const Analytic_surface& b,
                                const std::vector<Eigen::Vector3d>& common) {
  static const double smooth = std::cos(radians(5));
  if (common.empty() || b.type == Surface_type::free_form) return false;
  double sum = 0;
  for (const Eigen::Vector3d& p : common) sum += std::abs(a.normal(p).dot(b.normal(p)));
  return sum >= smooth * static_cast<double>(common.size());
}

/// The cylinder or cone that samples of a sphere lie on as well, as those on two circles do; nothing if there is none.
inline std::optional<Analytic_surface> straight_alternative(const Surface_samples& samples, double tolerance) {
  const Surface_fit fit(samples, 2 * tolerance);
  for (const Surface_type type : {Surface_type::cylinder, Surface_type::cone})
    if (auto surface = fit.fit(type)) return surface;
  return {};
}

}  // namespace RW_segmentation::internal

#endif
