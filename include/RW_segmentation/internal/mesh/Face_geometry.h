// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_FACE_GEOMETRY_H
#define RW_SEGMENTATION_INTERNAL_MESH_FACE_GEOMETRY_H

#include <RW_segmentation/internal/mesh/Face_corners.h>
#include <RW_segmentation/internal/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// Where a mesh lies in its coordinates: it is moved to the origin and scaled to a bounding box of diagonal 1, so that
/// neither far, huge nor tiny coordinates lose digits. Ratios of lengths, which is all that the method uses, are the
/// mesh's own.
struct Unit_box {
  double unit = 1;                                   ///< the diagonal, in the mesh's unit
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< the centre, in the mesh's coordinates
  double rounding = 0;                               ///< by how much the rounding of coordinates may displace a point

  Unit_box() = default;

  /// \param points finite, in the mesh's coordinates
  explicit Unit_box(const std::vector<Eigen::Vector3d>& points) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : points) box.extend(p);
    if (box.isEmpty()) return;
    origin = box.min() / 2 + box.max() / 2;
    const double diagonal = 2 * (box.max() / 2 - box.min() / 2).stableNorm();
    if (diagonal >= std::numeric_limits<double>::min()) unit = diagonal;
    const double largest_coordinate = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    rounding = std::numeric_limits<double>::epsilon() * (1 + largest_coordinate * (1 / unit));
  }

  Eigen::Vector3d scaled(const Eigen::Vector3d& point) const { return (point - origin) * (1 / unit); }
};

/// Centroids, normals and areas by face, lengths by edge, in the unit box.
struct Face_geometry {
  std::vector<Eigen::Vector3d> centroid;  ///< mean of the corners
  std::vector<Eigen::Vector3d> normal;    ///< unit length, or zero for a face without area
  std::vector<double> area;
  std::vector<double> edge_length;
  double total_area = 0;
  double mean_edge_length = 0;
  std::size_t degenerate_faces = 0;  ///< faces without area

  Face_geometry() = default;

  /// \param point by vertex, in the unit box
  /// \param edge_ends the two vertices of each edge
  /// \param rounding see `Unit_box`
  Face_geometry(const std::vector<Eigen::Vector3d>& point, const Face_corners& corners,
                const std::vector<std::array<std::uint32_t, 2>>& edge_ends, double rounding)
      : centroid(corners.number_of_faces()),
        normal(corners.number_of_faces()),
        area(corners.number_of_faces()),
        edge_length(edge_ends.size()) {
    parallel_stretches(centroid.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) measure(f, point, corners[static_cast<std::uint32_t>(f)], rounding);
    });
    parallel_stretches(edge_length.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e)
        edge_length[e] = (point[edge_ends[e][1]] - point[edge_ends[e][0]]).norm();
    });
    sum_up();
  }

  /// Brings the sums to the values of faces and edges.
  void sum_up() {
    total_area = mean_edge_length = 0;
    degenerate_faces = 0;
    for (std::size_t f = 0; f < area.size(); ++f) {
      total_area += area[f];
      degenerate_faces += normal[f].isZero(0);
    }
    for (const double length : edge_length) mean_edge_length += length;
    if (!edge_length.empty()) mean_edge_length /= static_cast<double>(edge_length.size());
  }

 private:
  void measure(std::size_t f, const std::vector<Eigen::Vector3d>& point, const Face_corners::Range& corners,
               double rounding) {
    const Eigen::Vector3d& apex = point[corners[0]];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), area_vector = Eigen::Vector3d::Zero();
    Eigen::Vector3d previous = sum;  // relative to the apex
    double extent = 0;
    for (std::size_t k = 1; k < corners.size(); ++k) {
      const Eigen::Vector3d corner = point[corners[k]] - apex;
      area_vector += previous.cross(corner) / 2;
      sum += corner;
      extent = std::max(extent, corner.norm());
      previous = corner;
    }
    area[f] = area_vector.norm();
    // A face that is no higher than its corners are exact has no direction.
    const bool degenerate = !(area[f] > 4 * rounding * extent);
    centroid[f] = apex + sum / static_cast<double>(corners.size());
    normal[f] = degenerate ? Eigen::Vector3d::Zero() : Eigen::Vector3d(area_vector / area[f]);
  }
};

}  // namespace RW_segmentation::internal

#endif
