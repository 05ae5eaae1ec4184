// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_CURVATURE_DIFFERENCE_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_CURVATURE_DIFFERENCE_H

#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/internal/compiled.h>

namespace RW_segmentation::internal {

/// The square of the mean of sqrt(d), edges weighted with their lengths: a mean that few large values hardly move.
///
/// If d is 1 on most edges and D on a fraction q, the arithmetic mean is near 1 + q D, this near (1 + q sqrt(D))^2. It
/// vanishes only where all d do; a median or a trimmed mean would do so on any solid of planes.
inline double robust_mean(const std::vector<double>& d, const std::vector<double>& edge_length) {
  double sum = 0, length = 0;
  for (std::size_t e = 0; e < d.size(); ++e) {
    sum += edge_length[e] * std::sqrt(d[e]);
    length += edge_length[e];
  }
  const double mean = length > 0 ? sum / length : 0;
  return mean * mean;
}

RW_SEGMENTATION_INLINE std::vector<double> curvature_difference(const Dual_mesh& mesh,
                                                                const std::vector<Surface_curvatures>& curvatures) {
  const std::size_t edges = mesh.number_of_edges();
  // Below this angle in an edge's length a surface is flat, and its curvatures are the rounding of coordinates.
  const double edge = std::max(mesh.mean_edge_length(), 1e-12);
  const double flat = std::max(1e-6, 2 * mesh.rounding() / edge);

  std::vector<double> d2(edges), d3(edges);
  for (std::size_t e = 0; e < edges; ++e) {
    const auto [i, j] = mesh.graph().faces_of(static_cast<Dual_mesh::Index>(e));
    if (mesh.normal(i).isZero(0) || mesh.normal(j).isZero(0)) continue;
    d2[e] = std::abs(curvatures[i].gaussian_curvature() - curvatures[j].gaussian_curvature());
    d3[e] = std::abs(curvatures[i].mean_curvature() - curvatures[j].mean_curvature());
  }

  constexpr double convex_weight = 1;
  std::vector<double> d = Dihedral_difference_policy{convex_weight}(mesh.with_shape_normals(own_normals(mesh)));
  const auto raise = [&](const std::vector<double>& term, double smallest_mean) {
    const double mean = robust_mean(term, mesh.edge_lengths());
    if (!(mean > smallest_mean)) return;
    for (std::size_t e = 0; e < edges; ++e) d[e] = std::max(d[e], term[e] / mean);
  };
  raise(d2, flat / (edge * edge));
  raise(d3, flat / edge);
  return d;
}

}  // namespace RW_segmentation::internal

#endif
