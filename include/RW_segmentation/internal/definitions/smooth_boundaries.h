// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SMOOTH_BOUNDARIES_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SMOOTH_BOUNDARIES_H

#include <RW_segmentation/internal/boundary/Boundary_smoother.h>
#include <RW_segmentation/internal/boundary/Lifted_surface.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/smooth_boundaries.h>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE void require_boundary_smoothing_numbers(const Boundary_smoothing& smoothing) {
  const auto require = [](const char* name, double value) {
    if (!(value >= 0) || !std::isfinite(value)) throw argument_error(name, value, "a finite number >= 0");
  };
  require("length", smoothing.length);
  require("tension", smoothing.tension);
  require("feature_weight", smoothing.feature_weight);
  require("largest_displacement", smoothing.largest_displacement);
  if (!(smoothing.crease_angle > 0)) throw argument_error("crease_angle", smoothing.crease_angle, "positive");
}

/// The numbers of the policy in the unit box.
inline Curve_smoothing_numbers curve_smoothing_numbers(const Boundary_smoothing& smoothing, double mean_edge_length) {
  constexpr double stiffest = 1e12;  // than which a spline cannot be told from a straight one
  const double steps = static_cast<double>(std::max<std::size_t>(smoothing.steps, 1));
  const double length = smoothing.length;
  Curve_smoothing_numbers numbers{};
  numbers.stiffness = std::min(std::pow(length, 4) / steps, stiffest);
  numbers.tension = std::min(smoothing.tension * length * length / steps, stiffest);
  numbers.steps = smoothing.steps;
  numbers.corridor = smoothing.largest_displacement * mean_edge_length;
  numbers.longest_step = mean_edge_length / 2;
  return numbers;
}

/// Whether the faces beside each halfedge turn by more than an angle.
inline std::vector<char> sharp_halfedges(const Triangle_surface& surface, const std::vector<Eigen::Vector3d>& normals,
                                         double angle) {
  const double least_turn = 2 * std::sin(std::min(angle, std::acos(-1.)) / 2);
  std::vector<char> is_sharp(surface.number_of_halfedges(), false);
  for (Triangle_surface::Index h = 0; h < surface.number_of_halfedges(); ++h)
    is_sharp[h] =
        !surface.is_border(h) &&
        (normals[Triangle_surface::face(h)] - normals[Triangle_surface::face(surface.twin(h))]).norm() > least_turn;
  return is_sharp;
}

RW_SEGMENTATION_INLINE std::vector<Surface_curve> smoothed_curves(const Dual_mesh& mesh, const Walled_surface& surface,
                                                                  const std::vector<std::size_t>& segment_of_face,
                                                                  const Boundary_smoothing& smoothing,
                                                                  const Curve_joining& joining,
                                                                  const std::vector<Border_crossing>& crossings,
                                                                  const Progress& progress) {
  const std::vector<Eigen::Vector3d> normals = smooth_normals(mesh, smoothing.normals, progress.part(0, 0.5));
  const Lifted_surface lifted(surface.open(), normals, smoothing.feature_weight * std::sqrt(mesh.total_area()));
  const Curve_smoothing_numbers numbers = curve_smoothing_numbers(smoothing, surface.whole().mean_edge_length());
  const Boundary_smoother smooth(surface, lifted, segment_of_face, numbers, joining, crossings);
  return smooth(sharp_halfedges(surface.open(), normals, smoothing.crease_angle), progress.part(0.5, 1));
}

}  // namespace RW_segmentation::internal

#endif
