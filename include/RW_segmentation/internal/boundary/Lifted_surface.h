// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_LIFTED_SURFACE_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_LIFTED_SURFACE_H

#include <RW_segmentation/internal/boundary/Surface_curve.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>
#include <RW_segmentation/internal/unit_vector.h>

#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The surface in the feature-sensitive metric |dx|^2 + w^2 |dn|^2: each vertex stands at (x, w n) in R^6, and the
/// triangles between them are flat there, too.
class Lifted_surface {
 public:
  using Index = Triangle_surface::Index;
  using Point = Eigen::Matrix<double, 6, 1>;

  /// \param normals of the faces, unit vectors or zero
  /// \param w the length that a turn of one radian counts
  Lifted_surface(const Triangle_surface& surface, const std::vector<Eigen::Vector3d>& normals, double w)
      : surface_(surface), lifted_(surface.number_of_vertices(), Point::Zero()) {
    for (Index h = 0; h < surface.number_of_halfedges(); ++h) {
      const Index f = Triangle_surface::face(h);
      const Eigen::Vector3d area =
          (surface.point(surface.target(h)) - surface.point(surface.source(h)))
              .cross(surface.point(surface.source(Triangle_surface::previous(h))) - surface.point(surface.source(h)));
      lifted_[surface.source(h)].tail<3>() += area.norm() * normals[f];
    }
    for (Index v = 0; v < lifted_.size(); ++v) lifted_[v] << surface.point(v), w * unit_vector(lifted_[v].tail<3>());
  }

  const Point& at(Index vertex) const { return lifted_[vertex]; }

  Point at(const Surface_place& place) const {
    const auto [a, b, c] = corners(place.face);
    return place.weight[0] * a + place.weight[1] * b + place.weight[2] * c;
  }

  /// The point of the plane of the face that is closest to `q`.
  Point tangent_projection(Index face, const Point& q) const {
    const auto [a, b, c] = corners(face);
    const Point u = b - a, v = c - a, p = q - a;
    const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), pu = p.dot(u), pv = p.dot(v);
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 1e-12 * uu * vv)) return q;
    return a + ((pu * vv - pv * uv) * u + (pv * uu - pu * uv) * v) / determinant;
  }

  /// Walks from face to face as long as that leads closer to `q`: a local minimum of the distance, reached without a
  /// jump to another sheet of the surface.
  Surface_place closest(const Point& q, Index start) const {
    Surface_place best{start, closest_in(start, q)};
    double distance = (at(best) - q).squaredNorm();
    const auto try_face = [&](Index face, Surface_place& found, double& least) {
      const Surface_place place{face, closest_in(face, q)};
      const double d = (at(place) - q).squaredNorm();
      if (!(d < least * (1 - 1e-9))) return;
      found = place;
      least = d;
    };
    while (true) {
      Surface_place better = best;
      double least = distance;
      int zeros = 0, corner = 0;
      for (int k = 0; k < 3; ++k) {
        zeros += best.weight[k] == 0;
        if (best.weight[k] != 0) corner = k;
      }
      for (int k = 0; k < 3 && zeros == 1; ++k) {
        if (best.weight[k] != 0) continue;
        const Index side = 3 * best.face + static_cast<Index>((k + 1) % 3);  // opposite corner k
        if (!surface_.is_border(side)) try_face(Triangle_surface::face(surface_.twin(side)), better, least);
      }
      if (zeros == 2)
        surface_.any_leaving(surface_.source(3 * best.face + static_cast<Index>(corner)), [&](Index h) {
          try_face(Triangle_surface::face(h), better, least);
          return false;
        });
      if (better.face == best.face) return best;
      best = better;
      distance = least;
    }
  }

 private:
  std::array<Point, 3> corners(Index face) const {
    const Index h = 3 * face;
    return {lifted_[surface_.source(h)], lifted_[surface_.source(h + 1)], lifted_[surface_.source(h + 2)]};
  }

  /// Barycentric coordinates of the closest point of a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
  Eigen::Vector3d closest_in(Index face, const Point& q) const {
    const auto [a, b, c] = corners(face);
    const Point u = b - a, v = c - a;
    const auto ratio = [](double x, double y) { return y > 0 ? x / y : 0.; };
    const double d1 = u.dot(q - a), d2 = v.dot(q - a);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    const double d3 = u.dot(q - b), d4 = v.dot(q - b);
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
      const double t = ratio(d1, d1 - d3);
      return {1 - t, t, 0};
    }
    const double d5 = u.dot(q - c), d6 = v.dot(q - c);
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
      const double t = ratio(d2, d2 - d6);
      return {1 - t, 0, t};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6) {
      const double t = ratio(d4 - d3, (d4 - d3) + (d5 - d6));
      return {0, 1 - t, t};
    }
    const double sum = va + vb + vc;
    return {va / sum, vb / sum, vc / sum};
  }

  const Triangle_surface& surface_;
  std::vector<Point> lifted_;  // each vertex
};

}  // namespace RW_segmentation::internal

#endif
