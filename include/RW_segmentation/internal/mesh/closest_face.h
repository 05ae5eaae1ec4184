// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_CLOSEST_FACE_H
#define RW_SEGMENTATION_INTERNAL_MESH_CLOSEST_FACE_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/mesh/Triangle_tree.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace RW_segmentation::internal {

inline std::optional<Dual_graph::Index> Triangle_tree::closest_face(const Eigen::Vector3d& point,
                                                                    const Eigen::Vector3d& direction) const {
  using Kernel = CGAL::Simple_cartesian<double>;
  const auto kernel_point = [](const Eigen::Vector3d& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
  const Kernel::Point_3 from = kernel_point(point);
  std::optional<Index> closest;
  double least = std::numeric_limits<double>::infinity();
  const auto squared_distance_to = [&](const Float_box& box) {
    float sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto x = static_cast<float>(point[static_cast<Eigen::Index>(axis)]);
      const float outside = std::max(0.f, std::max(box.least[axis] - x, x - box.greatest[axis]));
      sum += outside * outside;
    }
    return sum;
  };
  // Boxes are wider than their triangles by more than the rounding of this.
  const auto is_near = [&](float squared_distance) { return static_cast<double>(squared_distance) <= least; };

  struct Node {
    std::size_t node;
    float squared_distance;
  };
  std::array<Node, 64> open;  // at most one a level
  std::size_t number_open = 0;
  if (!triangles_.empty()) open[number_open++] = {1, 0};
  while (number_open > 0) {
    const auto [node, squared_distance] = open[--number_open];
    if (!is_near(squared_distance)) continue;
    if (node < leaves_) {
      Node near = {2 * node, squared_distance_to(boxes_[2 * node])};
      Node far = {2 * node + 1, squared_distance_to(boxes_[2 * node + 1])};
      if (far.squared_distance < near.squared_distance) std::swap(near, far);
      if (is_near(far.squared_distance)) open[number_open++] = far;
      if (is_near(near.squared_distance)) open[number_open++] = near;
      continue;
    }
    for (std::size_t i = leaf_begin(node - leaves_); i < leaf_begin(node - leaves_ + 1); ++i) {
      const auto [corner, first_side, second_side, face] = triangle(i);
      const Eigen::Vector3d area_vector = first_side.cross(second_side);
      if (area_vector.isZero(0) || (!direction.isZero(0) && !(area_vector.dot(direction) > 0))) continue;
      const double distance =
          CGAL::squared_distance(from, Kernel::Triangle_3(kernel_point(corner), kernel_point(corner + first_side),
                                                          kernel_point(corner + second_side)));
      if (distance < least || (distance == least && closest && face < *closest)) {
        least = distance;
        closest = face;
      }
    }
  }
  return closest;
}

}  // namespace RW_segmentation::internal

#endif
