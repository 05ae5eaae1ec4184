// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_CURVED_TRIANGLE_H
#define RW_SEGMENTATION_INTERNAL_BREP_CURVED_TRIANGLE_H

#include <RW_segmentation/internal/brep/Halfedge_triangles.h>

#include <array>
#include <cstddef>

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

}  // namespace RW_segmentation::internal::brep

#endif
