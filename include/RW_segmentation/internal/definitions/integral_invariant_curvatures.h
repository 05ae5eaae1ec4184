// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_INTEGRAL_INVARIANT_CURVATURES_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_INTEGRAL_INVARIANT_CURVATURES_H

#include <RW_segmentation/integral_invariant_curvatures.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/curvature/Ball_moments.h>
#include <RW_segmentation/internal/curvature/Ball_neighbourhood.h>
#include <RW_segmentation/internal/curvature/Triangulated_faces.h>
#include <RW_segmentation/internal/parallel_for.h>

namespace RW_segmentation::internal {

/// The curvatures of the surface through the centre of the unit ball, from what the solid and the ball have in common.
///
/// Eigenvalues M1, M2 of the covariance, along the surface, are to third order (Pottmann et al. 2007)
///   M1 = 2 pi/15 - pi/48 (3 k1 + k2),   M2 = 2 pi/15 - pi/48 (k1 + 3 k2),   and the volume is 2 pi/3 - pi/4 H.
inline Surface_curvatures curvatures_in_unit_ball(const Ball_moments& ball) {
  constexpr double nothing = 1e-9, pi = Ball_moments::pi;
  if (!(std::abs(ball.volume()) > nothing)) return {};  // a closed surface in the ball that encloses nothing
  const Eigen::Vector3d barycentre = ball.first() / ball.volume();
  const Eigen::Matrix3d covariance = ball.second() - ball.first() * barycentre.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);

  // The barycentre lies below the surface. Noise turns it less than a face's normal, and a crease to the bisector.
  Eigen::Index normal = 0;
  (axes.eigenvectors().transpose() * barycentre).cwiseAbs().maxCoeff(&normal);
  const Eigen::Index axis1 = normal == 0 ? 1 : 0, axis2 = normal == 2 ? 1 : 2;
  const double m1 = axes.eigenvalues()[axis1], m2 = axes.eigenvalues()[axis2];

  const double k1 = 6 / pi * (m2 - 3 * m1) + 8. / 5, k2 = 6 / pi * (m1 - 3 * m2) + 8. / 5;
  const double h = 4 / pi * (2 * pi / 3 - ball.volume());

  // If the smooth surface lies z above the centre, k1 and k2 are too small by 3 z, h by 4 z.
  constexpr double farthest = 0.1;
  Surface_curvatures result;
  result.offset = std::clamp((k1 + k2) / 2 - h, -farthest, farthest);
  result.max_curvature = k1 + 3 * result.offset;
  result.min_curvature = k2 + 3 * result.offset;
  result.mean_curvature_by_volume = h;
  result.max_direction = axes.eigenvectors().col(axis1);
  result.min_direction = axes.eigenvectors().col(axis2);
  result.normal = axes.eigenvectors().col(normal);
  if (result.normal.dot(barycentre) > 0) result.normal = -result.normal;
  return result;
}

RW_SEGMENTATION_INLINE double length_of(const Ball_radius& radius, const Dual_mesh& mesh) {
  if (!(radius.value() > 0) || !std::isfinite(radius.value()))
    throw argument_error("radius", radius.value(), "positive and finite");
  constexpr double smallest = 1e-12;  // so that rounding errors of points are smaller still
  constexpr double largest = 1e12;    // so that what is measured in it remains a number
  if (!radius.is_in_edge_lengths()) return std::clamp(radius.value() / mesh.unit(), smallest, largest);
  // A mesh without interior edges is a few planes.
  return std::clamp(radius.value() * (mesh.number_of_edges() == 0 ? 1 : mesh.mean_edge_length()), smallest, largest);
}

/// Gives each face without area the values of a face that is as few steps away as any.
inline void fill_faces_without_area(const Dual_mesh& mesh, std::vector<Surface_curvatures>& curvatures) {
  std::vector<Dual_mesh::Index> front;
  std::vector<bool> known(mesh.number_of_faces());
  for (Dual_mesh::Index f = 0; f < known.size(); ++f) {
    known[f] = !mesh.normal(f).isZero(0);
    if (known[f]) front.push_back(f);
  }
  for (std::size_t i = 0; i < front.size(); ++i)
    for (const auto& [next, edge] : mesh.graph().neighbours(front[i])) {
      if (known[next]) continue;
      known[next] = true;
      curvatures[next] = curvatures[front[i]];
      front.push_back(next);
    }
}

template <class ConcurrencyTag>
std::vector<std::vector<Surface_curvatures>> curvatures_of_faces(const Dual_mesh& mesh,
                                                                 const std::vector<double>& radii,
                                                                 std::vector<Curvature_report>& reports,
                                                                 const Progress& progress) {
  struct Counts {
    std::atomic<std::size_t> across_borders{0}, inside_a_face{0}, round_everything{0};
  };
  const std::size_t faces = mesh.number_of_faces();
  const Triangulated_faces surface(mesh);
  std::vector<std::vector<Surface_curvatures>> curvatures(radii.size(), std::vector<Surface_curvatures>(faces));
  std::vector<Counts> counts(radii.size());
  const auto measure = [&](Ball_neighbourhood& neighbourhood, Dual_mesh::Index f, std::size_t i) {
    const Ball_moments moments = neighbourhood.moments(f, radii[i]);
    Surface_curvatures& result = curvatures[i][f];
    result = curvatures_in_unit_ball(moments);
    result.max_curvature /= radii[i];
    result.min_curvature /= radii[i];
    result.mean_curvature_by_volume /= radii[i];
    result.offset *= radii[i];
    if (neighbourhood.meets_border()) ++counts[i].across_borders;
    if (!neighbourhood.leaves_face()) ++counts[i].inside_a_face;
    if (!neighbourhood.leaves_ball()) ++counts[i].round_everything;
  };
  const auto make_worker = [&] {
    return [&, neighbourhood = Ball_neighbourhood(surface, mesh)](std::size_t f) mutable {
      if (mesh.normal(static_cast<Dual_mesh::Index>(f)).isZero(0)) return;
      for (std::size_t i = 0; i < radii.size(); ++i) measure(neighbourhood, static_cast<Dual_mesh::Index>(f), i);
    };
  };
  parallel_for<ConcurrencyTag>(faces, make_worker, progress);

  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (mesh.number_of_degenerate_faces() > 0) fill_faces_without_area(mesh, curvatures[i]);
    reports.push_back({radii[i] * mesh.unit(), mesh.number_of_degenerate_faces(), counts[i].across_borders,
                       counts[i].inside_a_face, counts[i].round_everything});
  }
  return curvatures;
}

}  // namespace RW_segmentation::internal

#endif
