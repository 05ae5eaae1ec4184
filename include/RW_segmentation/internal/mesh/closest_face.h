// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_CLOSEST_FACE_H
#define RW_SEGMENTATION_INTERNAL_MESH_CLOSEST_FACE_H

#include <RW_segmentation/internal/mesh/Triangle_tree.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>

namespace RW_segmentation::internal {

inline std::optional<Triangle_tree::Near_face> Triangle_tree::closest_face(const Eigen::Vector3d& point,
                                                                           const Eigen::Vector3d& direction) const {
  using Kernel = CGAL::Simple_cartesian<double>;
  const auto kernel_point = [](const Eigen::Vector3d& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
  const Kernel::Point_3 from = kernel_point(point);
  std::optional<Near_face> closest;
  const auto squared_distances_to = [&](const Float_boxes& boxes) -> Floats {
    Floats sum = Floats::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto x = static_cast<float>(point[static_cast<Eigen::Index>(axis)]);
      sum += (boxes.least[axis] - x).max(x - boxes.greatest[axis]).max(0.f).square();
    }
    return sum;
  };
  // Boxes are wider than their triangles by more than the rounding of this.
  search(
      squared_distances_to,
      [&] { return closest ? closest->squared_distance : std::numeric_limits<double>::infinity(); },
      [&](const Fan_triangle& triangle) {
        const auto& [corner, first_side, second_side, face] = triangle;
        const Eigen::Vector3d area_vector = first_side.cross(second_side);
        if (area_vector.isZero(0) || (!direction.isZero(0) && !(area_vector.dot(direction) > 0))) return;
        const double distance =
            CGAL::squared_distance(from, Kernel::Triangle_3(kernel_point(corner), kernel_point(corner + first_side),
                                                            kernel_point(corner + second_side)));
        if (!closest || std::tie(distance, face) < std::tie(closest->squared_distance, closest->face))
          closest = {face, distance};
      });
  return closest;
}

}  // namespace RW_segmentation::internal

#endif
