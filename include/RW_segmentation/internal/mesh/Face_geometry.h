// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_FACE_GEOMETRY_H
#define RW_SEGMENTATION_INTERNAL_MESH_FACE_GEOMETRY_H

#include <RW_segmentation/internal/mesh/Face_corners.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

// Coordinates are written out where every program would compile Eigen's expressions for them.

namespace RW_segmentation::internal {

/// Where a mesh lies in its coordinates: it is moved to the origin and scaled to a bounding box of diagonal 1, so that
/// neither far, huge nor tiny coordinates lose digits. Ratios of lengths, which is all that the method uses, are the
/// mesh's own.
struct Unit_box {
  double unit = 1;                  ///< the diagonal, in the mesh's unit
  Eigen::Vector3d origin{0, 0, 0};  ///< the centre, in the mesh's coordinates
  double rounding = 0;              ///< by how much the rounding of coordinates may displace a point

  Unit_box() = default;

  /// \param points finite, in the mesh's coordinates
  explicit Unit_box(const std::vector<Eigen::Vector3d>& points);

  Eigen::Vector3d scaled(const Eigen::Vector3d& point) const {
    const double factor = 1 / unit;
    return {(point[0] - origin[0]) * factor, (point[1] - origin[1]) * factor, (point[2] - origin[2]) * factor};
  }
};

/// The mean of the corners of a face. It is not kept: no stage reads centroids so often that 24 bytes a face would pay.
/// \param point by vertex
inline Eigen::Vector3d centroid_of(const std::vector<Eigen::Vector3d>& point, const Face_corners::Range& corners) {
  const Eigen::Vector3d& apex = point[corners[0]];
  Eigen::Vector3d sum(0, 0, 0);
  for (std::size_t k = 1; k < corners.size(); ++k)
    for (int i = 0; i < 3; ++i) sum[i] += point[corners[k]][i] - apex[i];
  const auto size = static_cast<double>(corners.size());
  return {apex[0] + sum[0] / size, apex[1] + sum[1] / size, apex[2] + sum[2] / size};
}

/// The normal of a face, of unit length, or zero if it has no area, and that area.
struct Face_measures {
  Eigen::Vector3d normal;
  double area;
};

/// \param point by vertex, in the unit box
/// \param rounding see `Unit_box`
Face_measures measures_of(const std::vector<Eigen::Vector3d>& point, const Face_corners::Range& corners,
                          double rounding);

/// Areas by face, lengths by edge, in the unit box. Normals are not kept: they are read less often than 24 bytes a face
/// would be worth.
struct Face_geometry {
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
                const std::vector<std::array<std::uint32_t, 2>>& edge_ends, double rounding);
};

}  // namespace RW_segmentation::internal

#endif
