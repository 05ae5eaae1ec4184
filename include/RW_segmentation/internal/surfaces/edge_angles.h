// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_EDGE_ANGLES_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_EDGE_ANGLES_H

#include <RW_segmentation/Dual_mesh.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

constexpr double radians(double degrees) { return degrees * (3.14159265358979323846 / 180); }

/// The normals of the shape, and where a face has none that of the face across its longest edge: a triangle without area
/// at an edge of the solid is part of one side, and no way from one to the other.
inline std::vector<Eigen::Vector3d> normals_of_all_faces(const Dual_mesh& mesh) {
  constexpr int most_rounds = 8;  // triangles without area beside each other
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(mesh.number_of_faces());
  std::vector<Dual_mesh::Index> without;
  for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f) {
    normals.push_back(mesh.shape_normal(f));
    if (normals.back().isZero()) without.push_back(f);
  }
  for (int round = 0; round < most_rounds && !without.empty(); ++round) {
    const std::vector<Eigen::Vector3d> before = normals;
    std::vector<Dual_mesh::Index> still_without;
    for (const Dual_mesh::Index f : without) {
      double longest = -1;
      for (const auto& [g, e] : mesh.graph().neighbours(f))
        if (!before[g].isZero() && mesh.edge_lengths()[e] > longest) {
          longest = mesh.edge_lengths()[e];
          normals[f] = before[g];
        }
      if (longest < 0) still_without.push_back(f);
    }
    without = std::move(still_without);
  }
  return normals;
}

/// The angle between the faces of each edge by the normals of the shape, 0 where one of them has none nor a face beside it.
inline std::vector<double> edge_angles(const Dual_mesh& mesh) {
  const std::vector<Eigen::Vector3d> normals = normals_of_all_faces(mesh);
  std::vector<double> angles;
  angles.reserve(mesh.number_of_edges());
  for (Dual_mesh::Index e = 0; e < mesh.number_of_edges(); ++e) {
    const auto [f, g] = mesh.graph().faces_of(e);
    const Eigen::Vector3d &m = normals[f], &n = normals[g];
    const bool has_angle = !m.isZero() && !n.isZero();
    angles.push_back(has_angle ? 2 * std::asin(std::min(1., (m - n).norm() / 2)) : 0);
  }
  return angles;
}

}  // namespace RW_segmentation::internal

#endif
