// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_CURVED_TRIANGLE_H
#define RW_SEGMENTATION_INTERNAL_BREP_CURVED_TRIANGLE_H

#include <RW_segmentation/internal/brep/Halfedge_triangles.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace RW_segmentation::internal::brep {

/// A cubic Bezier triangle through three points, tangent to the planes of their normals: the curved PN triangle of
/// Vlachos, Peters, Boyd and Mitchell, 2001.
class Curved_triangle {
 public:
  /// \param normals of length 1
  Curved_triangle(const std::array<Point, 3>& corners, const std::array<Point, 3>& normals) : corners_(corners) {
    Point sum_on_sides = Point::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        const Point &p = corners[i], &q = corners[(i + 1 + k) % 3];
        on_sides_[i][k] = (2 * p + q - (q - p).dot(normals[i]) * normals[i]) / 3;
        sum_on_sides += on_sides_[i][k];
      }
    const Point centre = (corners[0] + corners[1] + corners[2]) / 3;
    middle_ = sum_on_sides / 6 + (sum_on_sides / 6 - centre) / 2;
  }

  /// At barycentric coordinates.
  Point at(double a, double b, double c) const {
    const std::array<double, 3> x = {a, b, c};
    Point p = 6 * a * b * c * middle_;
    for (std::size_t i = 0; i < 3; ++i) {
      p += x[i] * x[i] * x[i] * corners_[i];
      for (std::size_t k = 0; k < 2; ++k) p += 3 * x[i] * x[i] * x[(i + 1 + k) % 3] * on_sides_[i][k];
    }
    return p;
  }

 private:
  std::array<Point, 3> corners_;
  std::array<std::array<Point, 2>, 3> on_sides_;  // by corner, toward each of the two after it
  Point middle_;
};

/// Points on the curved triangles of a patch, between its vertices: rows along the longest side of each, no farther apart
/// than the knots of a spline surface, lest it waves within long triangles.
/// \param per_diagonal so many of the largest steps are as long as the diagonal of the patch
inline std::vector<Point> points_between_vertices(const Halfedge_triangles& mesh,
                                                  const std::vector<std::size_t>& triangles, std::size_t per_diagonal) {
  Eigen::AlignedBox3d box;
  std::map<std::size_t, Point>
      normals;  // by vertex; weighted by areas, so that large triangles stay as flat as they are
  for (const std::size_t t : triangles)
    for (const std::size_t v : mesh.corners(t)) {
      box.extend(mesh.point(v));
      normals.emplace(v, Point::Zero()).first->second += mesh.area_vector(t);
    }
  for (auto& [v, normal] : normals) normal.normalize();
  const double step = box.diagonal().norm() / double(per_diagonal);

  std::vector<Point> points;
  for (const std::size_t t : triangles) {
    std::size_t longest = 3 * t;
    for (std::size_t h = 3 * t + 1; h < 3 * t + 3; ++h)
      if (mesh.length(h) > mesh.length(longest)) longest = h;
    const double length = mesh.length(longest);
    if (!(length > 0)) continue;
    const std::size_t a = mesh.from(longest), b = mesh.to(longest), c = mesh.to(mesh.next(longest));
    const Curved_triangle triangle({mesh.point(a), mesh.point(b), mesh.point(c)}, {normals[a], normals[b], normals[c]});
    const int rows = 1 + static_cast<int>(2 * mesh.area_vector(t).norm() / length / step);
    for (int row = 0; row < rows; ++row) {
      const double up = (row + 0.5) / rows;
      const int columns = 1 + static_cast<int>((1 - up) * length / step);
      for (int column = 0; column < columns; ++column) {
        const double along = (column + 0.5) / columns;
        points.push_back(triangle.at((1 - up) * (1 - along), (1 - up) * along, up));
      }
    }
  }
  return points;
}

}  // namespace RW_segmentation::internal::brep

#endif
