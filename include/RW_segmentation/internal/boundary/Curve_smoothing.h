// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_CURVE_SMOOTHING_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_CURVE_SMOOTHING_H

#include <RW_segmentation/internal/boundary/Boundary_chain.h>
#include <RW_segmentation/internal/boundary/Lifted_surface.h>
#include <RW_segmentation/internal/boundary/Spline_in_tension.h>
#include <RW_segmentation/internal/boundary/Surface_curve.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// What a boundary is smoothed by, in the unit box.
struct Curve_smoothing_numbers {
  double stiffness, tension;  ///< of one step
  std::size_t steps;
  double corridor;      ///< how far a point may get from the jagged boundary
  double longest_step;  ///< of a point
};

/// The points that stand for a boundary before it is smoothed: the middles of its edges, and all vertices of edges on a
/// crease, where they are fixed, as are the ends.
/// \param is_on_crease by edge; none at an end on a side of the border
inline std::vector<Curve_point> curve_points(const Triangle_surface& surface, const Boundary_chain& chain,
                                             const std::vector<char>& is_on_crease) {
  std::vector<Curve_point> points;
  const auto fix = [&](Triangle_surface::Index vertex, std::size_t origin) {
    if (points.empty() || points.back().vertex != vertex) points.push_back({vertex, {}, origin});
  };
  const std::size_t last = chain.halfedges.size() - 1;
  if (chain.ends_on_side(0)) points.push_back(chain.ends[0]->point(0));
  for (std::size_t i = 0; i <= last; ++i) {
    const auto h = chain.halfedges[i];
    if (is_on_crease[i] || (i == 0 && !chain.is_closed && !chain.ends_on_side(0))) fix(surface.source(h), i);
    if (!is_on_crease[i]) {
      Surface_place middle{Triangle_surface::face(h), {0.5, 0.5, 0.5}};
      middle.weight[(h + 2) % 3] = 0;  // halfedge 3 f + k lies opposite corner k + 2
      points.push_back({Triangle_surface::none, middle, i});
    }
    if (is_on_crease[i] || (i == last && !chain.is_closed && !chain.ends_on_side(1))) fix(surface.target(h), i);
  }
  if (chain.ends_on_side(1)) points.push_back(chain.ends[1]->point(last));
  if (chain.is_closed && points.size() > 1 && points.front().is_fixed() &&
      points.front().vertex == points.back().vertex)
    points.pop_back();
  return points;
}

/// The distance of a point to that part of a chain that is close to one of its edges, the origin. Where the chain ends on a
/// side of the border, the sides on the way there are part of it.
inline double distance_to_chain(const Triangle_surface& surface, const Boundary_chain& chain, std::size_t origin,
                                const Eigen::Vector3d& p) {
  constexpr std::ptrdiff_t reach = 8;
  const auto edges = static_cast<std::ptrdiff_t>(chain.halfedges.size());
  double least = std::numeric_limits<double>::infinity();
  const auto measure = [&](Triangle_surface::Index h) {
    const Eigen::Vector3d& a = surface.point(surface.source(h));
    const Eigen::Vector3d u = surface.point(surface.target(h)) - a;
    const double uu = u.squaredNorm();
    const double t = uu > 0 ? std::clamp((p - a).dot(u) / uu, 0., 1.) : 0;
    least = std::min(least, (a + t * u - p).squaredNorm());
  };
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    std::ptrdiff_t i = static_cast<std::ptrdiff_t>(origin) + k;
    if (chain.is_closed) i = (i + reach * edges) % edges;
    if (i >= 0 && i < edges) measure(chain.halfedges[static_cast<std::size_t>(i)]);
  }
  const std::array distances = {origin, chain.halfedges.size() - 1 - origin};  // from the ends, in edges
  for (std::size_t end = 0; end < 2; ++end)
    if (chain.ends_on_side(end) && distances[end] <= static_cast<std::size_t>(reach))
      for (const auto side : chain.ends[end]->way.sides) measure(side);
  return std::sqrt(least);
}

/// Moves the points of one boundary.
class Curve_smoothing {
 public:
  Curve_smoothing(const Triangle_surface& surface, const Lifted_surface& lifted, const Curve_smoothing_numbers& numbers)
      : surface_(surface), lifted_(lifted), numbers_(numbers) {}

  /// Points of the chain, as `curve_points()` makes them, after all steps. Beyond a crossing at its end there is one more, which
  /// stays where it is and tells in which direction the boundary goes on.
  std::vector<Curve_point> operator()(const Boundary_chain& chain, std::vector<Curve_point> points) const {
    const Eigen::Index before = chain.ends[0] ? 1 : 0, behind = chain.ends[1] ? 1 : 0;
    const auto size = static_cast<Eigen::Index>(points.size());
    std::vector<char> is_fixed(static_cast<std::size_t>(before), true);
    for (const Curve_point& point : points) is_fixed.push_back(!point.is_free());
    if (behind > 0) is_fixed.push_back(true);
    const Spline_in_tension spline(is_fixed, chain.is_closed, numbers_.stiffness, numbers_.tension);

    Spline_in_tension::Points position(before + size + behind, 6);
    for (Eigen::Index i = 0; i < size; ++i)
      position.row(before + i) = at(points[static_cast<std::size_t>(i)]).transpose();
    if (before > 0) position.row(0) = beyond(points.front(), *chain.ends[0]).transpose();
    if (behind > 0) position.row(before + size) = beyond(points.back(), *chain.ends[1]).transpose();
    for (std::size_t step = 0; step < numbers_.steps; ++step) {
      Spline_in_tension::Points target = position;
      spline.step(target);
      for (Eigen::Index i = 0; i < size; ++i) {
        Curve_point& point = points[static_cast<std::size_t>(i)];
        if (!point.is_free()) continue;
        const Eigen::Index row = before + i;
        move(chain, point, position.row(row).transpose(), target.row(row).transpose());
        position.row(row) = at(point).transpose();
      }
    }
    for (Curve_point& point : points)  // off the edges, so that the way on is clear
      point.place.weight = ((1 - 3 * inset) * point.place.weight.array() + inset).matrix();
    return points;
  }

 private:
  static constexpr double inset = 1e-3;
  using Point = Lifted_surface::Point;

  Point at(const Curve_point& point) const {
    return point.is_fixed() ? lifted_.at(point.vertex) : lifted_.at(point.place);
  }

  /// Beyond the border the normal is taken to be what it is there.
  Point beyond(const Curve_point& last, const Chain_end& end) const {
    Point point = at(last);
    point.head<3>() += end.crossing.beyond;
    return point;
  }

  /// Moves a point along the surface toward the target, no further than the corridor allows.
  void move(const Boundary_chain& chain, Curve_point& point, const Point& from, const Point& to) const {
    Point step = lifted_.tangent_projection(point.place.face, to) - from;
    const double length = step.norm();
    if (length > numbers_.longest_step) step *= numbers_.longest_step / length;
    const Surface_place place = lifted_.closest(from + step, point.place.face);
    if (distance_to_chain(surface_, chain, point.origin, lifted_.at(place).head<3>()) <= numbers_.corridor)
      point.place = place;
  }

  const Triangle_surface& surface_;
  const Lifted_surface& lifted_;
  Curve_smoothing_numbers numbers_;
};

}  // namespace RW_segmentation::internal

#endif
