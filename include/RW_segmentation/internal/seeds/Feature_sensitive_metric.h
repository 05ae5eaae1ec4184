// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SEEDS_FEATURE_SENSITIVE_METRIC_H
#define RW_SEGMENTATION_INTERNAL_SEEDS_FEATURE_SENSITIVE_METRIC_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/threads.h>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// The feature-sensitive metric |dx|^2 + w^2 |dn|^2 on the faces of a mesh, x being centroids and n normals of the shape.
class Feature_sensitive_metric {
 public:
  using Index = Dual_mesh::Index;
  using Point = Eigen::Matrix<double, 6, 1>;

  /// Keeps a reference to the mesh. `normal_weight` is w as a fraction of the square root of the total area.
  Feature_sensitive_metric(const Dual_mesh& mesh, double normal_weight)
      : mesh_(mesh), w_(normal_weight * std::sqrt(mesh.total_area())) {}

  /// The face in six-dimensional space, (x, w n).
  Point point(Index f) const {
    Point p;
    p << mesh_.centroid(f), w_ * mesh_.shape_normal(f);
    return p;
  }

  /// The distance of two points; a face without normal looks like the other one.
  double distance(Index f, Index g) const {
    const Eigen::Vector3d m = mesh_.shape_normal(f), n = mesh_.shape_normal(g);
    const double turn = m.isZero(0) || n.isZero(0) ? 0 : (m - n).squaredNorm();
    return std::sqrt((mesh_.centroid(f) - mesh_.centroid(g)).squaredNorm() + w_ * w_ * turn);
  }

  /// The distances over the edges, in their order; infinite over walls.
  std::vector<double> edge_lengths() const {
    std::vector<double> lengths(mesh_.number_of_edges());
    parallel_stretches(lengths.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto e = static_cast<Index>(i);
        const auto [f, g] = mesh_.graph().faces_of(e);
        lengths[i] = mesh_.is_wall(e) ? std::numeric_limits<double>::infinity() : distance(f, g);
      }
    });
    return lengths;
  }

 private:
  const Dual_mesh& mesh_;
  double w_;
};

}  // namespace RW_segmentation::internal

#endif
