// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_EDGE_CURVE_H
#define RW_SEGMENTATION_INTERNAL_BREP_EDGE_CURVE_H

#include <RW_segmentation/internal/brep/Patch_surface.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Line.hxx>
#include <Standard_Failure.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <gp_Ax2.hxx>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace RW_segmentation::internal::brep {

/// The curve of an edge between two parameters.
struct Edge_curve {
  Handle(Geom_Curve) curve;
  double first = 0, last = 0;

  Point at(double parameter) const { return point_of(curve->Value(parameter)); }
  /// At a part of the way, from 0 to 1.
  Point at_share(double share) const { return at(first + share * (last - first)); }
};

/// The straight line from the first to the last of some points, if all of them are close to it.
inline std::optional<Edge_curve> line_through(const std::vector<Point>& points, double tolerance) {
  const Point along = points.back() - points.front();
  const double length = along.norm();
  if (!(length > tolerance)) return std::nullopt;
  for (const Point& p : points)
    if ((p - points.front()).cross(along).norm() > tolerance * length) return std::nullopt;
  return Edge_curve{new Geom_Line(kernel_point(points.front()), kernel_direction(along)), 0, length};
}

/// The circle or arc from the first to the last of some points, if all of them are close to it. It begins and ends at
/// these two.
inline std::optional<Edge_curve> circle_through(const std::vector<Point>& points, double tolerance, double diagonal) {
  constexpr double largest_radius = 20;  // diagonals
  if (points.size() < 5) return std::nullopt;
  const bool is_closed = (points.front() - points.back()).norm() <= tolerance;
  const std::size_t size = points.size();
  const Point &a = points.front(), &b = points[is_closed ? size / 3 : size / 2],
              &c = is_closed ? points[2 * size / 3] : points.back();
  Point axis = (b - a).cross(c - a);
  if (axis.norm() < 1e-12 * diagonal * diagonal) return std::nullopt;
  axis.normalize();
  Eigen::Matrix3d planes;  // the two in the middle of chords, and that of the circle
  planes << (b - a).transpose(), (c - a).transpose(), axis.transpose();
  const Point heights((b - a).dot(b - a) / 2, (c - a).dot(c - a) / 2, 0);
  const Point from_centre = -planes.inverse() * heights, centre = a - from_centre;
  const double radius = from_centre.norm();
  if (!(radius < largest_radius * diagonal)) return std::nullopt;
  for (const Point& p : points) {
    const double height = axis.dot(p - centre);
    if (std::hypot(height, (p - centre - height * axis).norm() - radius) > tolerance) return std::nullopt;
  }
  const gp_Ax2 frame(kernel_point(centre), kernel_direction(axis), kernel_direction(from_centre));
  double angle = full_turn;
  if (!is_closed) {
    const Point x = from_centre / radius, y = axis.cross(x);
    const double turn = std::atan2((c - centre).dot(y), (c - centre).dot(x));
    angle = turn > 0 ? turn : turn + angle;
  }
  return Edge_curve{new Geom_Circle(frame, radius), 0, angle};
}

/// Where points lie on a side: from either end as far as the side beside it is long, and twice as far each time.
inline std::vector<double> ways_along_side(double length, double before, double after) {
  std::vector<double> ways;
  for (const auto& [first, is_from_end] : {std::pair(before, false), std::pair(after, true)}) {
    double way = first;
    while (way < length / 2) {
      ways.push_back(is_from_end ? length - way : way);
      way *= 2;
    }
  }
  std::sort(ways.begin(), ways.end());
  return ways;
}

/// Points, and more of them on sides that are much longer than one beside them. Kernels leave such where a line goes over
/// into an arc, and a spline through the ends alone would swing out.
inline std::vector<Point> with_points_on_long_sides(const std::vector<Point>& points) {
  constexpr double long_side = 3;  // times the one beside it; arcs of kernels have even sides (`benchmark_brep`)
  const std::size_t sides = points.size() - 1;
  const auto length = [&](std::size_t i) { return (points[i + 1] - points[i]).norm(); };
  std::vector<Point> result;
  for (std::size_t i = 0; i < sides; ++i) {
    result.push_back(points[i]);
    const double own = length(i), before = i > 0 ? length(i - 1) : own, after = i + 1 < sides ? length(i + 1) : own;
    if (!(std::min(before, after) > 0) || own < long_side * std::min(before, after)) continue;
    for (const double way : ways_along_side(own, before, after))
      result.push_back(points[i] + way / own * (points[i + 1] - points[i]));
  }
  result.push_back(points.back());
  return result;
}

/// The spline through some points.
/// \throws Standard_Failure if there are no two different points
inline Edge_curve spline_through(const std::vector<Point>& points, double diagonal) {
  constexpr double least_step = 1e-6;  // of the diagonal
  std::vector<Point> apart = {points.front()};
  for (const Point& p : points)
    if ((p - apart.back()).norm() > least_step * diagonal) apart.push_back(p);
  if (apart.size() < 2) throw Standard_Failure("edge of no length");
  apart.back() = points.back();
  const Handle(TColgp_HArray1OfPnt) values = new TColgp_HArray1OfPnt(1, static_cast<int>(apart.size()));
  for (std::size_t i = 0; i < apart.size(); ++i) values->SetValue(static_cast<int>(i) + 1, kernel_point(apart[i]));
  GeomAPI_Interpolate interpolation(values, false, 1e-9 * diagonal);
  interpolation.Perform();
  if (!interpolation.IsDone()) throw Standard_Failure("no spline");
  Handle(Geom_Curve) curve;
  curve = interpolation.Curve();
  return {curve, curve->FirstParameter(), curve->LastParameter()};
}

/// The line or circle through points, if there is one.
inline std::optional<Edge_curve> line_or_circle_through(const std::vector<Point>& points, double diagonal) {
  constexpr double tolerance = 2e-5;  // of the diagonal; vertices of files in single precision are as exact
  if (auto line = line_through(points, tolerance * diagonal)) return line;
  return circle_through(points, tolerance * diagonal, diagonal);
}

/// The simplest curve through points: a line, a circle or a spline.
/// \throws Standard_Failure if there are no two different points
inline Edge_curve curve_through(const std::vector<Point>& points, double diagonal) {
  if (const auto simple = line_or_circle_through(points, diagonal)) return *simple;
  return spline_through(points, diagonal);
}

/// The straight line between two points.
/// \throws Standard_Failure if they are one
inline Edge_curve segment_between(const Point& a, const Point& b) {
  const double length = (b - a).norm();
  if (!(length > 1e-7)) throw Standard_Failure("edge of no length");
  return {new Geom_Line(kernel_point(a), kernel_direction(b - a)), 0, length};
}

}  // namespace RW_segmentation::internal::brep

#endif
