// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_HALFEDGE_TRIANGLES_H
#define RW_SEGMENTATION_INTERNAL_BREP_HALFEDGE_TRIANGLES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/brep/Polygon_triangles.h>

#include <Eigen/Geometry>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

/// From a mesh and the surfaces of its segments to a boundary representation. Only `boundary_representation.h` includes
/// this floor, which needs Open CASCADE.
namespace RW_segmentation::internal::brep {

using Point = Eigen::Vector3d;

/// The number of what is not there: the other side of a mesh's border, for example.
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// A connected component of the mesh as triangles and halfedges, in the coordinates of the shape. Halfedges 3 f, 3 f + 1 and 3 f + 2 go round
/// triangle f. A face of more than three sides is cut into triangles, see `Polygon_triangles`.
///
/// Both ends of an edge that the kernel takes for a point, as rounded coordinates have them, are one vertex, and faces that are
/// left with fewer than three corners are dropped; unless more than two faces would meet in an edge then.
class Halfedge_triangles {
 public:
  /// \param scale of the shape beside the mesh
  /// \param faces of the mesh, those of a connected component
  /// \throws std::invalid_argument if two faces pass the same edge in the same direction
  /// Complexity: O(n log n) for n faces.
  Halfedge_triangles(const Dual_mesh& mesh, double scale, const std::vector<Dual_mesh::Index>& faces) {
    std::unordered_map<Dual_mesh::Index, std::size_t> number;
    Eigen::AlignedBox3d box;
    const auto number_of = [&](Dual_mesh::Index v) {
      const auto [place, is_new] = number.try_emplace(v, points_.size());
      if (is_new) {
        points_.push_back(scale * (mesh.unit() * mesh.point(v) + mesh.origin()));
        box.extend(points_.back());
      }
      return place->second;
    };
    std::vector<Polygon> polygons;
    for (const Dual_mesh::Index f : faces) {
      polygons.emplace_back();
      for (const Dual_mesh::Index v : mesh.corners(f)) polygons.back().push_back(number_of(v));
    }
    if (!make_triangles(faces, without_short_edges(polygons)) && !make_triangles(faces, polygons))
      throw std::invalid_argument("the mesh has several edges between the same two vertices");
    diagonal_ = box.diagonal().norm();
    middle_ = box.center();
  }

  std::size_t number_of_triangles() const { return corners_.size(); }
  std::size_t number_of_halfedges() const { return 3 * corners_.size(); }
  const std::vector<Point>& points() const { return points_; }
  /// Of the box around the component.
  double diagonal() const { return diagonal_; }
  /// Likewise.
  const Point& middle() const { return middle_; }

  static std::size_t next(std::size_t halfedge) { return halfedge % 3 == 2 ? halfedge - 2 : halfedge + 1; }
  std::size_t from(std::size_t halfedge) const { return corners_[halfedge / 3][halfedge % 3]; }
  std::size_t to(std::size_t halfedge) const { return from(next(halfedge)); }
  /// `none` at the mesh's border.
  std::size_t opposite(std::size_t halfedge) const { return opposite_[halfedge]; }
  /// The triangle on the other side, `none` at the mesh's border.
  std::size_t neighbour(std::size_t halfedge) const {
    return opposite_[halfedge] == none ? none : opposite_[halfedge] / 3;
  }
  double length(std::size_t halfedge) const { return (point(from(halfedge)) - point(to(halfedge))).norm(); }

  const std::array<std::size_t, 3>& corners(std::size_t triangle) const { return corners_[triangle]; }
  const Point& point(std::size_t vertex) const { return points_[vertex]; }
  /// The face of the mesh that a triangle is a part of.
  Dual_mesh::Index face(std::size_t triangle) const { return face_[triangle]; }

  Point centre(std::size_t triangle) const {
    const auto [a, b, c] = corners_[triangle];
    return (point(a) + point(b) + point(c)) / 3;
  }
  /// Outward, as long as the area.
  Point area_vector(std::size_t triangle) const {
    const auto [a, b, c] = corners_[triangle];
    return (point(b) - point(a)).cross(point(c) - point(a)) / 2;
  }

  /// The connected parts of some triangles, each of one key; their order and that of their triangles follows `triangles`.
  /// \param key by triangle
  template <class Key>
  std::vector<std::vector<std::size_t>> parts(const std::vector<std::size_t>& triangles,
                                              const std::vector<Key>& key) const {
    std::vector<std::vector<std::size_t>> result;
    std::vector<char> is_open(number_of_triangles(), false);
    for (const std::size_t t : triangles) is_open[t] = true;
    for (const std::size_t seed : triangles) {
      if (!is_open[seed]) continue;
      is_open[seed] = false;
      std::vector<std::size_t> part = {seed};
      for (std::size_t i = 0; i < part.size(); ++i)
        for (std::size_t h = 3 * part[i]; h < 3 * part[i] + 3; ++h) {
          const std::size_t t = neighbour(h);
          if (t == none || !is_open[t] || key[t] != key[seed]) continue;
          is_open[t] = false;
          part.push_back(t);
        }
      result.push_back(std::move(part));
    }
    return result;
  }

 private:
  using Polygon = std::vector<std::size_t>;

  /// The polygons with both ends of each edge that the kernel takes for a point as one vertex.
  std::vector<Polygon> without_short_edges(std::vector<Polygon> polygons) const {
    constexpr double shortest_edge = 1e-7;  // `Precision::Confusion()`
    boost::disjoint_sets_with_storage<> vertices(points_.size());
    bool are_any = false;
    for (const Polygon& polygon : polygons)
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t v = polygon[i], w = polygon[(i + 1) % polygon.size()];
        if ((point(v) - point(w)).norm() > shortest_edge) continue;
        vertices.union_set(v, w);
        are_any = true;
      }
    if (!are_any) return polygons;
    for (Polygon& polygon : polygons) {
      for (std::size_t& v : polygon) v = vertices.find_set(v);
      polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
      while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
    }
    return polygons;
  }

  /// \returns whether there are any, and at most two at each edge, in opposite directions
  bool make_triangles(const std::vector<Dual_mesh::Index>& faces, const std::vector<Polygon>& polygons) {
    corners_.clear();
    face_.clear();
    Polygon_triangles triangles(points_, polygons);
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (const auto& corners : triangles.of(polygons[i])) {
        corners_.push_back(corners);
        face_.push_back(faces[i]);
      }
    return !corners_.empty() && pair_halfedges();
  }

  /// \returns whether there are at most two at each edge, in opposite directions
  bool pair_halfedges() {
    opposite_.assign(number_of_halfedges(), none);
    struct Entry {
      std::size_t low, high, halfedge;
      bool operator<(const Entry& other) const {
        return std::tie(low, high, halfedge) < std::tie(other.low, other.high, other.halfedge);
      }
    };
    std::vector<Entry> entries;
    entries.reserve(number_of_halfedges());
    for (std::size_t h = 0; h < number_of_halfedges(); ++h)
      entries.push_back({std::min(from(h), to(h)), std::max(from(h), to(h)), h});
    std::sort(entries.begin(), entries.end());
    for (std::size_t i = 0; i + 1 < entries.size(); ++i) {
      const Entry &a = entries[i], &b = entries[i + 1];
      if (a.low != b.low || a.high != b.high) continue;
      if (from(a.halfedge) == from(b.halfedge) || opposite_[a.halfedge] != none) return false;
      opposite_[a.halfedge] = b.halfedge;
      opposite_[b.halfedge] = a.halfedge;
    }
    return true;
  }

  std::vector<Point> points_;
  std::vector<std::array<std::size_t, 3>> corners_;
  std::vector<Dual_mesh::Index> face_;
  std::vector<std::size_t> opposite_;
  double diagonal_ = 0;
  Point middle_;
};

}  // namespace RW_segmentation::internal::brep

#endif
