// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_ANALYTIC_SURFACE_COST_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_ANALYTIC_SURFACE_COST_H

#include <RW_segmentation/Analytic_surface_cost.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/surfaces/Noise_estimate.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_types.h>
#include <RW_segmentation/internal/surfaces/noise_trials.h>

#include <algorithm>
#include <cmath>

namespace RW_segmentation {

namespace internal {

RW_SEGMENTATION_INLINE void require_noise(double noise) {
  if (!std::isfinite(noise)) throw argument_error("noise", noise, "finite");
}

RW_SEGMENTATION_INLINE Surface_tolerance surface_tolerance(const Dual_mesh& mesh, double noise,
                                                           const std::vector<Dual_mesh::Index>& trials) {
  require_noise(noise);
  // Where noise is large beside the edges, it hides in neighbourhoods that end at sharp ones: each estimate tells the next
  // how sharp an edge may be. Noise of a third of the edges takes three of them; one alone finds .4 of it.
  constexpr int most_estimates = 8;
  constexpr double least_growth = 1.05;
  const bool is_given = noise >= 0;
  if (is_given && noise <= Surface_tolerance::least_slight_noise) return Surface_tolerance(mesh, noise);
  Noise_estimate estimate(mesh, trials);
  double deviation = is_given ? noise : estimate.standard_deviation();
  if (deviation <= Surface_tolerance::least_slight_noise) return Surface_tolerance(mesh, deviation);
  // What reaches across edges has deviations in common: on CAD solids (`_5k`) under noise of .1 %, overlap .894 where the
  // last estimate tells the kind, .903 where the first does.
  const Noise_kind kind = estimate.kind();
  for (int i = 1; !is_given && Surface_tolerance(mesh, deviation, kind).is_noisy() && i < most_estimates; ++i) {
    estimate.expect(Surface_tolerance(mesh, deviation));
    const double next = estimate.standard_deviation();
    if (next <= least_growth * deviation) break;
    deviation = next;
  }
  return Surface_tolerance(mesh, deviation, kind);
}

RW_SEGMENTATION_INLINE Surface_tolerance surface_tolerance(const Dual_mesh& mesh, double noise) {
  return surface_tolerance(mesh, noise, noise_trials(mesh.number_of_faces(), mesh.number_of_faces()));
}

RW_SEGMENTATION_INLINE std::vector<double> edge_sharpness(const Dual_mesh& mesh, const Surface_tolerance& tolerance) {
  std::vector<double> sharpness = crease_angles(mesh, tolerance);
  for (Dual_mesh::Index e = 0; e < sharpness.size(); ++e)
    sharpness[e] /= tolerance.sharp_angle(mesh.graph().faces_of(e));
  return sharpness;
}

}  // namespace internal

RW_SEGMENTATION_INLINE Analytic_surface_cost::Region Analytic_surface_cost::region(const Dual_mesh&,
                                                                                   Dual_mesh::Index face) const {
  Region region;
  for (const Dual_mesh::Index v : mesh_.corners(face)) region.vertices.insert(v, most_samples_);
  if (has_normal(face)) region.faces.insert(face, most_samples_);
  return region;
}

RW_SEGMENTATION_INLINE void Analytic_surface_cost::join(Region& region, const Region& other) const {
  region.vertices.join(other.vertices, most_samples_);
  region.faces.join(other.faces, most_samples_);
  region.surface.reset();
}

RW_SEGMENTATION_INLINE double Analytic_surface_cost::operator()(const Region& a, const Region& b,
                                                                const Region_boundary& boundary) const {
  // Squared deviations that no change of the surface makes good: 30 and 300 give the same overlaps without noise.
  constexpr double hopeless = 100;
  const double sharpness = boundary.common.difference / boundary.common.length;
  if (sharpness > 1) return impossible * sharpness;
  const double known = std::max(misfit_of_known(a, b), misfit_of_known(b, a));
  if (known > hopeless) return known * (1 + sharpness);
  Region whole = a;
  join(whole, b);
  return cost_of(whole);
}

RW_SEGMENTATION_INLINE const Analytic_surface& Analytic_surface_cost::surface_of(const Region& region) const {
  if (!region.surface) region.surface = fit_analytic_surface(samples_of(region), tolerance_->distance);
  return *region.surface;
}

RW_SEGMENTATION_INLINE double Analytic_surface_cost::misfit_of_known(const Region& a, const Region& b) const {
  // Vertices beyond those that determine a surface, and vertices that lie on none: half and twice as many give the overlaps
  // of CAD solids that `Surface_growing` tells, within .0001.
  constexpr std::size_t doubtless_surplus = 8, doubtless_free_form = 30;
  const Analytic_surface& surface = surface_of(a);
  const auto freedom = static_cast<std::size_t>(degrees_of_freedom(surface.type));
  if (surface.type == Surface_type::free_form) return a.vertices.size() < doubtless_free_form ? 0 : impossible;
  if (a.vertices.size() < freedom + doubtless_surplus) return 0;
  return internal::with_type_of(surface, [&](const auto& s) {
    double squares = 0;
    b.vertices.for_each([&](Dual_mesh::Index v) {
      const double d = s.distance(mesh_.point(v)) / tolerance_->distance;
      squares += d * d;
    });
    return squares / static_cast<double>(b.vertices.size());
  });
}

RW_SEGMENTATION_INLINE double Analytic_surface_cost::cost_of(const Region& region) const {
  // A more complex surface is not asked for. At 0.1 the same solids take up to 8 times the time, and 0.4 saves nothing.
  constexpr double good_cost = 0.2;
  const Surface_samples samples = samples_of(region);
  const internal::Surface_fit fit(samples);
  double least = impossible;
  for (const Surface_type type : analytic_types) {
    const double surplus = static_cast<double>(samples.points.size()) - degrees_of_freedom(type);
    if (surplus < 1) break;
    const auto surface = fit.fit(type);
    if (surface) least = std::min(least, distance_term(*surface, samples, surplus) + normal_term(*surface, region));
    if (least < good_cost) break;
  }
  return least;
}

RW_SEGMENTATION_INLINE Surface_samples Analytic_surface_cost::samples_of(const Region& region) const {
  Surface_samples samples;
  region.vertices.for_each([&](Dual_mesh::Index v) { samples.points.push_back(mesh_.point(v)); });
  region.faces.for_each([&](Dual_mesh::Index f) {
    samples.normal_points.push_back(mesh_.centroid(f));
    samples.normals.push_back(mesh_.shape_normal(f));
  });
  return samples;
}

RW_SEGMENTATION_INLINE double Analytic_surface_cost::distance_term(const Analytic_surface& surface,
                                                                   const Surface_samples& samples,
                                                                   double surplus) const {
  constexpr double allowed = 1.5 * 1.5;
  const double ratio = surface.residual / tolerance_->distance;
  const double squares = static_cast<double>(samples.points.size()) * ratio * ratio;
  return std::min(impossible, (squares + degrees_of_freedom(surface.type)) / surplus / allowed);
}

RW_SEGMENTATION_INLINE double Analytic_surface_cost::normal_term(const Analytic_surface& surface,
                                                                 const Region& region) const {
  return internal::with_type_of(surface, [&](const auto& s) {
    double outward = 0, squares[2] = {0, 0}, count = 0;
    region.faces.for_each([&](Dual_mesh::Index f) {
      const Eigen::Vector3d n = s.normal(mesh_.centroid(f)), own = mesh_.shape_normal(f);
      outward += n.dot(own);
      const double square = tolerance_->normal_angle[f] * tolerance_->normal_angle[f];
      squares[0] += (n + own).squaredNorm() / square;
      squares[1] += (n - own).squaredNorm() / square;
      ++count;
    });
    return count > 0 ? squares[outward > 0] / count : 0;
  });
}

}  // namespace RW_segmentation

#endif
