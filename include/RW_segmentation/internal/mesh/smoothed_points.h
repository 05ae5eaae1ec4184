// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_SMOOTHED_POINTS_H
#define RW_SEGMENTATION_INTERNAL_MESH_SMOOTHED_POINTS_H

#include <RW_segmentation/Dual_mesh.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

/// The points of the vertices, each of them off the border moved half-way to the mean of its neighbours, several times,
/// all at once.
inline std::vector<Eigen::Vector3d> smoothed_points(const Dual_mesh& mesh, int steps) {
  using Index = Dual_mesh::Index;
  std::vector<Eigen::Vector3d> point = mesh.points(), sum(point.size());
  std::vector<std::size_t> degree(point.size(), 0), faces(point.size(), 0);
  for (Index e = 0; e < mesh.number_of_edges(); ++e)
    for (const Index v : mesh.ends(e)) ++degree[v];
  for (Index f = 0; f < mesh.number_of_faces(); ++f)
    for (const Index v : mesh.corners(f)) ++faces[v];
  for (int step = 0; step < steps; ++step) {
    std::fill(sum.begin(), sum.end(), Eigen::Vector3d::Zero());
    for (Index e = 0; e < mesh.number_of_edges(); ++e) {
      const auto [a, b] = mesh.ends(e);
      sum[a] += point[b];
      sum[b] += point[a];
    }
    for (std::size_t v = 0; v < point.size(); ++v) {
      const bool is_on_border = degree[v] != faces[v];
      if (!is_on_border) point[v] = (point[v] + sum[v] / static_cast<double>(degree[v])) / 2;
    }
  }
  return point;
}

}  // namespace RW_segmentation::internal

#endif
