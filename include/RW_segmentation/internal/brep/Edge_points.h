// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_EDGE_POINTS_H
#define RW_SEGMENTATION_INTERNAL_BREP_EDGE_POINTS_H

#include <RW_segmentation/internal/brep/Edge_curve.h>
#include <RW_segmentation/internal/brep/Height_field.h>
#include <RW_segmentation/internal/brep/Patch.h>
#include <RW_segmentation/internal/brep/Patch_borders.h>
#include <RW_segmentation/internal/brep/Patch_surface.h>
#include <RW_segmentation/internal/brep/Placed_surface.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

namespace RW_segmentation::internal::brep {

/// The point close to another on all of some surfaces, by Gauss-Newton steps. They are damped, so that a point hardly moves
/// along surfaces that touch each other.
/// \param limit of the way; a point that would go farther stays where it is
inline Point projected(const Point& start, const std::vector<const Patch_surface*>& surfaces, double limit) {
  constexpr double damping = 1e-4;  // beside the squares of unit normals
  constexpr int most_steps = 20;
  if (surfaces.empty()) return start;
  Point p = start;
  for (int i = 0; i < most_steps; ++i) {
    Eigen::Matrix3d matrix = damping * Eigen::Matrix3d::Identity();
    Point right = Point::Zero();
    for (const Patch_surface* surface : surfaces) {
      const Point normal = surface->normal(p);
      matrix += normal * normal.transpose();
      right -= surface->distance(p) * normal;
    }
    const Point step = matrix.inverse() * right;
    p += step;
    if (step.norm() < 1e-12 * limit) break;
  }
  return (p - start).norm() <= limit ? p : start;
}

/// Where the vertices and edges of the boundary representation lie.
///
/// Surfaces that are known bind them; those of free forms are fitted to the edges afterwards.
class Edge_points {
 public:
  Edge_points(const Halfedge_triangles& mesh, const std::vector<Patch>& patches, const Patch_borders& borders)
      : mesh_(mesh), patches_(patches), positions_(mesh.points()) {
    std::vector<std::vector<const Patch_surface*>> surfaces(positions_.size());
    std::vector<double> shortest(positions_.size(), std::numeric_limits<double>::infinity());
    for (std::size_t h = 0; h < mesh.number_of_halfedges(); ++h) {
      for (const std::size_t v : {mesh.from(h), mesh.to(h)}) shortest[v] = std::min(shortest[v], mesh.length(h));
      if (!borders.is_branch(mesh.from(h))) continue;
      const Patch_surface* surface = binding(borders.patch_of(h / 3)).get();
      auto& at_vertex = surfaces[mesh.from(h)];
      if (surface && std::find(at_vertex.begin(), at_vertex.end(), surface) == at_vertex.end())
        at_vertex.push_back(surface);
    }
    constexpr double reach = 0.4;  // of the shortest edge at a vertex, lest vertices meet
    for (std::size_t v = 0; v < positions_.size(); ++v)
      if (borders.is_branch(v)) positions_[v] = projected(mesh.point(v), surfaces[v], reach * shortest[v]);
  }

  /// Of a vertex of the mesh.
  const Point& position(std::size_t vertex) const { return positions_[vertex]; }

  /// The surface of a patch if it is known; null for free forms, triangles and `none`.
  std::shared_ptr<const Patch_surface> binding(std::size_t patch) const {
    if (patch == none || dynamic_cast<const Height_field*>(patches_[patch].surface.get())) return nullptr;
    return patches_[patch].surface;
  }

  /// Points that the curve of a chain passes through, from its first to its last vertex. They depend on where these two are, on
  /// the vertices between them and on what binds the chain on either side.
  std::vector<Point> points_of(const Chain& chain) const {
    if (is_cut(chain) && !chain.is_closed()) {
      std::vector<Point> points = straight_in_parameters(chain);
      if (!points.empty()) return points;
    }
    std::vector<const Patch_surface*> surfaces;
    for (const std::size_t patch : {chain.left, chain.right})
      if (binding(patch)) surfaces.push_back(binding(patch).get());
    return surfaces.size() == 2 ? between_surfaces(chain, surfaces) : through_vertices(chain, surfaces);
  }

 private:
  /// Whether a chain lies within one segment's surface.
  bool is_cut(const Chain& chain) const {
    if (chain.right == none) return false;
    const Patch &a = patches_[chain.left], &b = patches_[chain.right];
    const auto lies_on_own_surface = [](const Patch& p) { return p.form <= Form::surface_with_chords; };
    return a.segment == b.segment && lies_on_own_surface(a) && lies_on_own_surface(b);
  }

  /// A line of a plane, cylinder or cone, an arc or a helix; nothing on a sphere.
  std::vector<Point> straight_in_parameters(const Chain& chain) const {
    constexpr int steps = 16;
    const auto& surface = static_cast<const Placed_surface&>(*patches_[chain.left].surface);
    if (surface.type() == Surface_type::sphere) return {};
    const Point &first = positions_[chain.vertices.front()], &last = positions_[chain.vertices.back()];
    Parameters a = surface.parameters(first), b = surface.parameters(last);
    if (surface.type() == Surface_type::torus) b = surface.parameters_near(last, a);
    if (surface.is_tip(first)) a[0] = b[0];
    if (surface.is_tip(last)) b[0] = a[0];
    std::vector<Point> points;
    for (int i = 0; i <= steps; ++i) points.push_back(surface.at(a + (b - a) * i / steps));
    return points;
  }

  /// On the one surface that is known, or on none, the mesh's vertices are all that is known of the edge, and that long
  /// sides beside short ones are straight.
  std::vector<Point> through_vertices(const Chain& chain, const std::vector<const Patch_surface*>& surfaces) const {
    std::vector<Point> points;
    for (const std::size_t v : chain.vertices) points.push_back(positions_[v]);
    if (!line_or_circle_through(points, mesh_.diagonal())) points = with_points_on_long_sides(points);
    for (Point& p : points) p = projected(p, surfaces, reach(chain));
    points.front() = positions_[chain.vertices.front()];
    points.back() = positions_[chain.vertices.back()];
    return points;
  }

  /// The chain with points in between, smoothed and projected on both surfaces in turn, which takes off the teeth where
  /// they touch each other.
  std::vector<Point> between_surfaces(const Chain& chain, const std::vector<const Patch_surface*>& surfaces) const {
    constexpr int rounds = 10;
    const std::size_t size = chain.vertices.size(), steps = size > 30 ? 1 : size > 8 ? 2 : 4;
    std::vector<Point> points;
    for (std::size_t i = 0; i + 1 < size; ++i)
      for (std::size_t k = 0; k < steps; ++k) {
        const double share = double(k) / double(steps);
        points.push_back((1 - share) * positions_[chain.vertices[i]] + share * positions_[chain.vertices[i + 1]]);
      }
    points.push_back(positions_[chain.vertices.back()]);
    for (int round = 0; round <= rounds; ++round) {
      const std::vector<Point> before = points;
      for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        if (round > 0) points[i] = (before[i - 1] + 2 * before[i] + before[i + 1]) / 4;
        points[i] = projected(points[i], surfaces, reach(chain));
      }
    }
    return points;
  }

  /// How far a curve may be from its chord: the arc that a triangle cuts off a circle is .29 of the side away.
  double reach(const Chain& chain) const {
    constexpr double largest_bulge = 0.3;  // of the longest side
    double longest = 0;
    for (std::size_t i = 0; i + 1 < chain.vertices.size(); ++i)
      longest = std::max(longest, (mesh_.point(chain.vertices[i]) - mesh_.point(chain.vertices[i + 1])).norm());
    return largest_bulge * longest;
  }

  const Halfedge_triangles& mesh_;
  const std::vector<Patch>& patches_;
  std::vector<Point> positions_;  // by vertex
};

}  // namespace RW_segmentation::internal::brep

#endif
