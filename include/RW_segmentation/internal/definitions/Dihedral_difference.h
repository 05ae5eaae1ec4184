// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_DIHEDRAL_DIFFERENCE_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_DIHEDRAL_DIFFERENCE_H

#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/threads.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace RW_segmentation {

namespace internal {

/// \throws std::invalid_argument
inline void require_dihedral_numbers(const Dihedral_difference_policy& policy) {
  if (!(policy.convex_weight >= 0 && policy.convex_weight <= 1))
    throw argument_error("convex_weight", policy.convex_weight, "between 0 and 1");
  if (!(policy.ordinary_difference >= 0))
    throw argument_error("ordinary_difference", policy.ordinary_difference, "at least 0");
}

/// Divides numbers by their mean; all become 0 if it is below a limit.
inline void divide_by_mean(std::vector<double>& d, double least_mean) {
  const double mean = d.empty() ? 0 : std::accumulate(d.begin(), d.end(), 0.) / static_cast<double>(d.size());
  for (double& value : d) value = mean < least_mean ? 0 : value / mean;
}

/// Eq. 4.
inline std::vector<double> weighted_angles(const Dual_mesh& mesh, double convex_weight, Dihedral_measure measure) {
  // |Ni - Nj|^2 of faces folded onto each other, up to 1e-6 radians: there only rounding tells convex from concave.
  constexpr double folded = 4 - 1e-12;
  const Dual_mesh shape = with_stored_normals(mesh);
  std::vector<double> d(shape.number_of_edges());
  parallel_stretches(d.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto [i, j] = shape.graph().faces_of(static_cast<Dual_mesh::Index>(e));
      const Eigen::Vector3d ni = shape.shape_normal(i), nj = shape.shape_normal(j), turn = nj - ni;
      if (ni.isZero(0) || nj.isZero(0)) continue;
      const bool concave = turn.dot(shape.centroid(j) - shape.centroid(i)) < 0 && turn.squaredNorm() < folded;
      const double eta = concave ? 1 : convex_weight;
      // |Ni - Nj|^2 / 2, because 1 - Ni.Nj would lose all digits on flat edges.
      d[e] = eta * (measure == Dihedral_measure::angle ? turn.norm() : turn.squaredNorm() / 2);
    }
  });
  return d;
}

RW_SEGMENTATION_INLINE std::vector<double> turns(const Dual_mesh& mesh, double convex_weight) {
  return weighted_angles(mesh, convex_weight, Dihedral_measure::angle);
}

RW_SEGMENTATION_INLINE double flat_turn(double rounding, double mean_edge_length) {
  return std::max(1e-6, 2 * rounding / std::max(mean_edge_length, 1e-12));
}

}  // namespace internal

RW_SEGMENTATION_INLINE std::vector<double> Dihedral_difference_policy::operator()(const Dual_mesh& mesh) const {
  internal::require_dihedral_numbers(*this);
  std::vector<double> d = internal::weighted_angles(mesh, convex_weight, measure);
  const double flat_angle = internal::flat_turn(mesh.rounding(), mesh.mean_edge_length());
  internal::divide_by_mean(d, measure == Dihedral_measure::angle ? flat_angle : flat_angle * flat_angle);
  if (ordinary_difference > 0) {
    for (double& value : d)
      value = value > ordinary_difference ? std::sqrt(value * value - ordinary_difference * ordinary_difference) : 0;
    internal::divide_by_mean(d, std::numeric_limits<double>::min());
  }
  return d;
}

}  // namespace RW_segmentation

#endif
