// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_BENCHMARK_BOUNDARY_MEASURES_H
#define RW_SEGMENTATION_BENCHMARK_BOUNDARY_MEASURES_H

// How smooth the boundaries of segments are, and how far they lie from where they should.

#include "measurement.h"

#include <CGAL/AABB_tree.h>
#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/version.h>

#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_segment_primitive_3.h>
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace measurement {

using Kernel = CGAL::Kernel_traits<Mesh::Point>::Kernel;
using Segments = std::vector<Kernel::Segment_3>;
using Labels = Mesh::Property_map<Mesh::Face_index, std::size_t>;

inline double angle_between(const Kernel::Vector_3& a, const Kernel::Vector_3& b) {
  return std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b);
}

/// Whether each edge lies between two segments.
inline std::vector<bool> boundary_edges(const Mesh& mesh, const Labels& label) {
  std::vector<bool> result(mesh.num_edges(), false);
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e);
    result[e] = !mesh.is_border(e) && label[mesh.face(h)] != label[mesh.face(mesh.opposite(h))];
  }
  return result;
}

inline Segments segments_of(const Mesh& mesh, const std::vector<bool>& is_chosen) {
  Segments segments;
  for (const auto e : mesh.edges())
    if (is_chosen[e]) segments.emplace_back(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)));
  return segments;
}

/// How much boundaries turn at the vertices where exactly two of their edges meet.
struct Turning {
  double length = 0;
  double in_space = 0;    ///< sum of the angles between consecutive edges
  double on_surface = 0;  ///< sum of pi |l - r| / (l + r), l and r being the angles of the faces on the left and right:
                          ///< what is left when the bending of the surface itself is taken away
};

inline Turning turning(const Mesh& mesh, const std::vector<bool>& is_boundary) {
  Turning result;
  for (const auto& segment : segments_of(mesh, is_boundary)) result.length += std::sqrt(segment.squared_length());
  for (const auto v : mesh.vertices()) {
    if (mesh.is_isolated(v) || mesh.is_border(v)) continue;
    std::vector<double> sectors;  // between boundary edges; the first one is continued by the last
    std::vector<Kernel::Vector_3> directions;
    double angle = 0;
    for (const auto h : CGAL::halfedges_around_target(v, mesh)) {
      const Kernel::Vector_3 a = mesh.point(mesh.source(h)) - mesh.point(v);
      if (is_boundary[mesh.edge(h)]) {
        sectors.push_back(angle);
        directions.push_back(a);
        angle = 0;
      }
      angle += angle_between(a, mesh.point(mesh.target(mesh.next(h))) - mesh.point(v));
    }
    if (sectors.size() != 2) continue;
    const double left = sectors[1], right = sectors[0] + angle;
    result.on_surface += CGAL_PI * std::abs(left - right) / (left + right);
    result.in_space += CGAL_PI - angle_between(directions[0], directions[1]);
  }
  return result;
}

/// The value that a share of the values lies below; 0 if there are none.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Points spread over segments, each for an equal part of the length.
inline std::vector<Mesh::Point> points_on(const Segments& segments, double spacing) {
  std::vector<Mesh::Point> points;
  double rest = spacing / 2;  // to the next point
  for (const auto& segment : segments) {
    const double length = std::sqrt(segment.squared_length());
    for (; rest < length; rest += spacing) points.push_back(segment.source() + rest / length * segment.to_vector());
    rest -= length;
  }
  return points;
}

/// Distances from the nearest of the segments.
inline std::vector<double> distances(const std::vector<Mesh::Point>& points, const Segments& segments) {
#if CGAL_VERSION_NR >= 1060000000
  using Traits = CGAL::AABB_traits_3<Kernel, CGAL::AABB_segment_primitive_3<Kernel, Segments::const_iterator>>;
#else
  using Traits = CGAL::AABB_traits<Kernel, CGAL::AABB_segment_primitive<Kernel, Segments::const_iterator>>;
#endif
  CGAL::AABB_tree<Traits> tree(segments.begin(), segments.end());
  tree.accelerate_distance_queries();
  std::vector<double> result;
  for (const auto& p : points) result.push_back(std::sqrt(tree.squared_distance(p)));
  return result;
}

inline double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

inline double mean_edge_length(const Mesh& mesh) {
  double sum = 0;
  for (const auto& segment : segments_of(mesh, std::vector<bool>(mesh.num_edges(), true)))
    sum += std::sqrt(segment.squared_length());
  return sum / static_cast<double>(std::max<std::size_t>(mesh.number_of_edges(), 1));
}

inline double diagonal(const Mesh& mesh) {
  const CGAL::Bbox_3 box = CGAL::bbox_3(mesh.points().begin(), mesh.points().end());
  return std::sqrt(CGAL::square(box.x_span()) + CGAL::square(box.y_span()) + CGAL::square(box.z_span()));
}

/// The smallest angle of each face from a number on, in degrees.
inline std::vector<double> smallest_angles(const Mesh& mesh, std::size_t first_face) {
  std::vector<double> angles;
  for (const auto f : mesh.faces()) {
    if (static_cast<std::size_t>(f) < first_face) continue;
    double least = 180;
    for (const auto h : CGAL::halfedges_around_face(mesh.halfedge(f), mesh)) {
      const auto& p = mesh.point(mesh.target(h));
      least =
          std::min(least, 180 / CGAL_PI *
                              angle_between(mesh.point(mesh.source(h)) - p, mesh.point(mesh.target(mesh.next(h))) - p));
    }
    angles.push_back(least);
  }
  return angles;
}

}  // namespace measurement

#endif
