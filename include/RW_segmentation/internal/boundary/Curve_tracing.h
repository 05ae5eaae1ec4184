// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_CURVE_TRACING_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_CURVE_TRACING_H

#include <RW_segmentation/internal/boundary/Curve_joint.h>
#include <RW_segmentation/internal/boundary/Surface_curve.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>
#include <RW_segmentation/internal/unit_vector.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Joins the points of a curve by lines over the surface: each is cut out by the plane that holds both points and the
/// normal between them. What happens at an edge is decided by the sides of the plane on which its ends lie, so that the
/// faces passed always form a connected strip. Where the surface folds and the plane leads astray, the way over the fewest
/// faces is searched. A `Curve_joining` may put other lines in the place of these. Then the crossings move along their
/// edges until the curve runs straight from edge to edge.
class Curve_tracing {
 public:
  using Index = Triangle_surface::Index;

  /// \param snap a crossing that is closer to an end of its edge, as a fraction of the edge, moves to the vertex
  /// \param joining for lines other than the traced ones
  Curve_tracing(const Triangle_surface& surface, double snap, Curve_joining joining)
      : surface_(surface), snap_(snap), joining_(std::move(joining)) {}

  /// The nodes on the border that a curve begins and ends with, where it does so.
  using Ends = std::array<std::optional<Curve_node>, 2>;

  /// A curve through points, without its segments; none if they cannot be joined.
  std::optional<Surface_curve> operator()(const std::vector<Curve_point>& points, bool is_closed,
                                          const Ends& ends = {}) const {
    Surface_curve curve;
    curve.is_closed = is_closed;
    std::vector<Curve_node>& nodes = curve.nodes;
    if (ends[0]) nodes.push_back(*ends[0]);
    const std::size_t joints = is_closed ? points.size() : points.size() - 1;
    for (std::size_t i = 0; i < joints; ++i) {
      const Curve_point &from = points[i], &to = points[(i + 1) % points.size()];
      if (from.is_fixed()) append(nodes, {from.vertex, Triangle_surface::none, 0, from.origin});
      if (!join(from, to, curve)) return std::nullopt;
    }
    if (!is_closed)
      append(nodes,
             ends[1].value_or(Curve_node{points.back().vertex, Triangle_surface::none, 0, points.back().origin}));
    if (is_closed) close(nodes);
    straighten(nodes, is_closed);
    nodes = snapped(nodes, is_closed);
    for (const std::size_t end : {0U, 1U})  // near the border it may have run into a vertex, past its end
      if (ends[end] && !is_crossing(end == 0 ? nodes.front() : nodes.back(), *ends[end])) return std::nullopt;
    return curve;
  }

 private:
  /// Adds a node and removes what is not needed to get to it.
  void append(std::vector<Curve_node>& nodes, const Curve_node& node) const {
    nodes.push_back(node);
    while (nodes.size() > 1) {
      const Curve_node &a = nodes[nodes.size() - 2], &b = nodes.back();
      const bool is_there_and_back = a.is_vertex() || b.is_vertex() ? nodes.size() > 2 && b.is_vertex() &&
                                                                          nodes[nodes.size() - 3].vertex == b.vertex
                                                                    : a.edge == b.edge;
      if (is_there_and_back)
        nodes.resize(nodes.size() - 2);
      else if (a.is_vertex() && (b.is_vertex() ? a.vertex == b.vertex : is_end(a.vertex, b.edge)))
        nodes.pop_back();
      else if (!a.is_vertex() && b.is_vertex() && is_end(b.vertex, a.edge))
        nodes.erase(nodes.end() - 2);
      else
        return;
    }
  }

  static bool is_crossing(const Curve_node& node, const Curve_node& crossing) {
    return !node.is_vertex() && node.edge == crossing.edge && node.position == crossing.position;
  }

  /// Lets the end of a closed curve meet its beginning.
  void close(std::vector<Curve_node>& nodes) const {
    for (bool is_changed = true; is_changed && nodes.size() > 2;) {
      const std::size_t size = nodes.size();
      std::rotate(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(size / 2), nodes.end());
      std::vector<Curve_node> again;
      for (const Curve_node& node : nodes) append(again, node);
      nodes = std::move(again);
      is_changed = nodes.size() < size;
    }
  }

  /// Moves each crossing toward where the straight way between its neighbours crosses the edge, the two faces laid out
  /// flat.
  void straighten(std::vector<Curve_node>& nodes, bool is_closed) const {
    constexpr std::size_t sweeps = 5;  // few, so that only bends from edge to edge go
    const std::size_t size = nodes.size();
    for (std::size_t sweep = 0; sweep < sweeps; ++sweep)
      for (std::size_t i = is_closed ? 0 : 1; i + (is_closed ? 0 : 1) < size; ++i) {
        Curve_node& node = nodes[i];
        if (node.is_vertex()) continue;
        const Eigen::Vector3d a = surface_.point(surface_.source(node.edge));
        const Eigen::Vector3d along = surface_.point(surface_.target(node.edge)) - a;
        const double length = along.squaredNorm();
        if (!(length > 0)) continue;
        const auto place = [&](const Curve_node& other) {
          const Eigen::Vector3d p = point_of(surface_, other) - a;
          const double t = p.dot(along) / length;
          return std::make_pair(t, (p - t * along).norm());
        };
        const auto [t, d] = place(nodes[(i + size - 1) % size]);
        const auto [u, e] = place(nodes[(i + 1) % size]);
        if (d + e > 0) node = crossing(surface_, node.edge, (t * e + u * d) / (d + e), node.origin);
      }
  }

  /// The curve with crossings close to a vertex moved there.
  std::vector<Curve_node> snapped(const std::vector<Curve_node>& nodes, bool is_closed) const {
    std::vector<Curve_node> result;
    for (Curve_node node : nodes) {
      if (!node.is_vertex() && node.position < snap_) node.vertex = surface_.source(node.edge);
      if (!node.is_vertex() && node.position > 1 - snap_) node.vertex = surface_.target(node.edge);
      append(result, node);
    }
    if (is_closed) close(result);
    return result;
  }

  bool is_end(Index vertex, Index edge) const {
    return surface_.source(edge) == vertex || surface_.target(edge) == vertex;
  }

  Eigen::Vector3d area_vector(Index face) const {
    const Eigen::Vector3d a = surface_.point(surface_.source(3 * face));
    return (surface_.point(surface_.source(3 * face + 1)) - a).cross(surface_.point(surface_.source(3 * face + 2)) - a);
  }

  Eigen::Vector3d normal(const Curve_point& p) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    if (!p.is_fixed()) return unit_vector(area_vector(p.place.face));
    surface_.any_leaving(p.vertex, [&](Index h) {
      sum += area_vector(Triangle_surface::face(h));
      return false;
    });
    return unit_vector(sum);
  }

  bool is_at_corner(Index vertex, Index face) const {
    for (Index k = 0; k < 3; ++k)
      if (surface_.source(3 * face + k) == vertex) return true;
    return false;
  }

  /// The plane through two points.
  struct Cut {
    Eigen::Vector3d origin, across;
    double height(const Eigen::Vector3d& p) const { return across.dot(p - origin); }
  };

  /// Appends the crossings between two points. Returns whether they can be joined.
  bool join(const Curve_point& from, const Curve_point& to, Surface_curve& curve) const {
    if (from.is_fixed() && to.is_fixed()) return is_edge(from.vertex, to.vertex);
    const bool is_backward = to.is_fixed();  // a walk ends in a face
    const Curve_point &begin = is_backward ? to : from, &end = is_backward ? from : to;
    if (begin.is_fixed() ? is_at_corner(begin.vertex, end.place.face) : begin.place.face == end.place.face) return true;

    std::vector<Curve_node> line = traced(begin, end);
    if (line.empty()) return false;
    ++curve.joining.joints;
    if (auto joined = joining_({surface_, begin, end, line}))
      line = std::move(*joined);
    else
      ++curve.joining.failures;
    if (is_backward) std::reverse(line.begin(), line.end());
    for (const Curve_node& node : line) append(curve.nodes, node);
    return true;
  }

  /// The crossings between two points in different faces, the second of them free; none if there is no way.
  std::vector<Curve_node> traced(const Curve_point& from, const Curve_point& to) const {
    Cut cut;
    cut.origin = point_of(surface_, from);
    cut.across = (normal(from) + normal(to)).cross(point_of(surface_, to) - cut.origin);
    // The way begins on one of the sides that the plane crosses; in a deep valley the straight direction tells nothing.
    Walk shortest;
    const auto try_exit = [&](Index exit) {
      if (!is_crossed(exit, cut)) return;
      Walk walk = follow(exit, to.place.face, cut, from.origin, point_of(surface_, to));
      if (walk.length < shortest.length) shortest = std::move(walk);
    };
    if (from.is_fixed())
      surface_.any_leaving(from.vertex, [&](Index h) {
        try_exit(Triangle_surface::next(h));
        return false;
      });
    else
      for (Index h = 3 * from.place.face; h < 3 * from.place.face + 3; ++h) try_exit(h);
    // Where the surface folds, the plane leads astray.
    constexpr double longest_detour = 2;
    if (!(shortest.length < longest_detour * (point_of(surface_, to) - cut.origin).norm()))
      shortest.nodes = fewest_crossings(from, to);
    return shortest.nodes;
  }

  /// The way with the fewest faces, found by breadth-first search; empty if it is long.
  std::vector<Curve_node> fewest_crossings(const Curve_point& from, const Curve_point& to) const {
    constexpr std::size_t most_faces = 200;
    struct Step {
      Index face, entry;  // the halfedge in the face that it was entered by
      std::size_t before;
    };
    std::vector<Step> steps;
    const auto reach = [&](Index face, Index entry, std::size_t before) {
      if (std::none_of(steps.begin(), steps.end(), [&](const Step& step) { return step.face == face; }))
        steps.push_back({face, entry, before});
    };
    if (from.is_fixed())
      surface_.any_leaving(from.vertex, [&](Index h) {
        reach(Triangle_surface::face(h), Triangle_surface::none, 0);
        return false;
      });
    else
      reach(from.place.face, Triangle_surface::none, 0);
    std::size_t last = 0;
    for (; last < steps.size() && last < most_faces && steps[last].face != to.place.face; ++last) {
      const Index first = 3 * steps[last].face;
      for (Index h = first; h < first + 3; ++h)
        if (!surface_.is_border(h)) reach(Triangle_surface::face(surface_.twin(h)), surface_.twin(h), last);
    }
    if (last == steps.size() || steps[last].face != to.place.face) return {};

    const Eigen::Vector3d middle = (point_of(surface_, from) + point_of(surface_, to)) / 2;
    std::vector<Curve_node> nodes;
    for (; steps[last].entry != Triangle_surface::none; last = steps[last].before) {
      const Index h = steps[last].entry;
      const Eigen::Vector3d a = surface_.point(surface_.source(h)), along = surface_.point(surface_.target(h)) - a;
      const double length = along.squaredNorm();
      nodes.push_back(crossing(surface_, h, length > 0 ? (middle - a).dot(along) / length : 0.5, from.origin));
    }
    std::reverse(nodes.begin(), nodes.end());
    return nodes;
  }

  bool is_edge(Index a, Index b) const {
    return surface_.any_leaving(
        a, [&](Index h) { return surface_.target(h) == b || surface_.source(Triangle_surface::previous(h)) == b; });
  }

  bool is_above(Index vertex, const Cut& cut) const { return cut.height(surface_.point(vertex)) >= 0; }
  bool is_crossed(Index h, const Cut& cut) const {
    return is_above(surface_.source(h), cut) != is_above(surface_.target(h), cut);
  }
  double crossing_of(Index h, const Cut& cut) const {
    const double a = cut.height(surface_.point(surface_.source(h))), b = cut.height(surface_.point(surface_.target(h)));
    return a / (a - b);
  }

  /// Crossings in a row.
  struct Walk {
    std::vector<Curve_node> nodes;
    double length = std::numeric_limits<double>::infinity();
  };

  /// Follows the plane from face to face until the last one; an empty walk if that is not reached.
  Walk follow(Index exit, Index last_face, const Cut& cut, std::size_t origin, const Eigen::Vector3d& end) const {
    constexpr std::size_t longest_walk = 50;
    Walk walk;
    double length = 0;
    Eigen::Vector3d last = cut.origin;
    while (walk.nodes.size() < longest_walk && exit != Triangle_surface::none && !surface_.is_border(exit)) {
      const double position = crossing_of(exit, cut);
      const Eigen::Vector3d p = surface_.point_on(exit, position);
      length += (p - last).norm();
      last = p;
      walk.nodes.push_back(crossing(surface_, exit, position, origin));
      const Index entry = surface_.twin(exit);
      if (Triangle_surface::face(entry) == last_face) {
        walk.length = length + (end - last).norm();
        return walk;
      }
      const Index left = Triangle_surface::next(entry), right = Triangle_surface::previous(entry);
      exit = is_crossed(left, cut) ? left : is_crossed(right, cut) ? right : Triangle_surface::none;
    }
    return {};
  }

  const Triangle_surface& surface_;
  double snap_;
  Curve_joining joining_;
};

}  // namespace RW_segmentation::internal

#endif
