// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_SURFACE_CURVE_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_SURFACE_CURVE_H

#include <RW_segmentation/Boundary_curve.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

/// A point of a surface: a face and barycentric coordinates.
struct Surface_place {
  Triangle_surface::Index face = Triangle_surface::none;
  Eigen::Vector3d weight = Eigen::Vector3d::Zero();  ///< of the corners
};

/// A point of a boundary on its way: at a vertex, where it stays, or anywhere.
struct Curve_point {
  Triangle_surface::Index vertex = Triangle_surface::none;
  Surface_place place;     ///< of a point that is at no vertex
  std::size_t origin = 0;  ///< the edge of the chain that it comes from
  bool is_held = false;    ///< whether it stays at its place: the end of a boundary, on a side of the border

  bool is_fixed() const { return vertex != Triangle_surface::none; }
  bool is_free() const { return !is_fixed() && !is_held; }
};

/// Where a curve passes: through a vertex or across an edge. Consecutive nodes of a curve lie in one face.
struct Curve_node {
  /// Of a crossing from the ends of its edge, as a fraction of it, so that its side of the vertex counts.
  static constexpr double least_position = 1e-3;

  Triangle_surface::Index vertex = Triangle_surface::none;
  Triangle_surface::Index edge = Triangle_surface::none;  ///< in the sense of `Triangle_surface::edge()`
  double position = 0;                                    ///< from its source, 0, to its target, 1
  std::size_t origin = 0;                                 ///< the edge of the chain that it comes from

  bool is_vertex() const { return vertex != Triangle_surface::none; }
};

/// The point at `t` of the way from `a` to `b`. It is the same to the last bit from either end, where 1 - t has no more digits
/// than t: so tiles cut the side that they share in one point.
inline Eigen::Vector3d point_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double t) {
  if (std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end())) return t * b + (1 - t) * a;
  return (1 - t) * a + t * b;
}

/// Where a curve crosses a halfedge, kept off its ends.
inline Curve_node crossing(const Triangle_surface& surface, Triangle_surface::Index h, double position,
                           std::size_t origin) {
  constexpr double least = Curve_node::least_position;
  const auto edge = surface.edge(h);
  return {Triangle_surface::none, edge, std::clamp(edge == h ? position : 1 - position, least, 1 - least), origin};
}

inline Eigen::Vector3d point_of(const Triangle_surface& surface, const Curve_point& point) {
  if (point.is_fixed()) return surface.point(point.vertex);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Triangle_surface::Index k = 0; k < 3; ++k)
    sum += point.place.weight[k] * surface.point(surface.source(3 * point.place.face + k));
  return sum;
}

inline Eigen::Vector3d point_of(const Triangle_surface& surface, const Curve_node& node) {
  return node.is_vertex() ? surface.point(node.vertex) : surface.point_on(node.edge, node.position);
}

/// A curve over the surface between two segments.
struct Surface_curve {
  std::vector<Curve_node> nodes;
  bool is_closed = false;
  std::array<std::size_t, 2> segments{};  ///< on the left and on the right
  bool is_smoothed = false;
  Joining_report joining;

  std::size_t number_of_lines() const { return is_closed ? nodes.size() : nodes.size() - 1; }
  const Curve_node& end_of_line(std::size_t i) const { return nodes[(i + 1) % nodes.size()]; }
};

}  // namespace RW_segmentation::internal

#endif
