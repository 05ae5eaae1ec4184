#ifndef RW_SEGMENTATION_INTERNAL_FACE_REFINEMENT_H
#define RW_SEGMENTATION_INTERNAL_FACE_REFINEMENT_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/Face_corners.h>
#include <RW_segmentation/internal/Face_geometry.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The faces of a mesh cut into triangles whose sides are not longer than a given length, which does not move the
/// surface. The longest side of all is halved until none is too long (Rivara 1984).
///
/// Sides that more than two faces share join none of them.
class Face_refinement {
 public:
  using Index = Dual_graph::Index;

  /// Faces of more than three sides are cut into fans first. Complexity: n log n for n triangles in the end.
  Face_refinement(const Dual_graph& graph, const Face_corners& corners, double longest_side)
      : longest_side_(longest_side) {
    for (Index v = 0; v < corners.number_of_vertices(); ++v) points_.push_back(corners.point(v));
    for (Index f = 0; f < graph.number_of_faces(); ++f) {
      const auto corner = corners[f].begin();
      for (auto c = corner + 2; c < corners[f].end(); ++c) add({corner[0], c[-1], c[0]}, f);
    }
    while (!too_long_.empty()) halve(std::prev(too_long_.end())->second);
  }

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  const std::vector<std::array<Index, 3>>& triangles() const { return triangles_; }

  /// The face that each triangle is part of.
  const std::vector<Index>& faces() const { return face_; }

  /// Pairs of triangles that have a side in common, and the lengths of the sides.
  std::pair<std::vector<std::array<Index, 2>>, std::vector<double>> edges() const {
    std::pair<std::vector<std::array<Index, 2>>, std::vector<double>> result;
    for (const auto& [side, triangles] : triangles_at_)
      if (triangles.size() == 2) {
        result.first.push_back({triangles[0], triangles[1]});
        result.second.push_back(length(side));
      }
    return result;
  }

 private:
  using Side = std::array<Index, 2>;  // the lower vertex first

  static Side side(const std::array<Index, 3>& triangle, std::size_t k) {
    const auto [a, b] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
    return {a, b};
  }
  double length(const Side& side) const { return (points_[side[0]] - points_[side[1]]).norm(); }

  void add(const std::array<Index, 3>& triangle, Index face) {
    triangles_.push_back(triangle);
    face_.push_back(face);
    put_at_sides(static_cast<Index>(triangles_.size() - 1));
  }

  void put_at_sides(Index t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Side s = side(triangles_[t], k);
      triangles_at_[s].push_back(t);
      if (length(s) > longest_side_) too_long_.insert({length(s), s});
    }
  }

  void take_from_sides(Index t) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<Index>& at = triangles_at_[side(triangles_[t], k)];
      at.erase(std::find(at.begin(), at.end(), t));
    }
  }

  void halve(const Side s) {
    too_long_.erase({length(s), s});
    const auto middle = static_cast<Index>(points_.size());
    points_.push_back((points_[s[0]] + points_[s[1]]) / 2);
    const std::vector<Index> halved = triangles_at_[s];
    for (const Index t : halved) {
      take_from_sides(t);
      std::array<Index, 3> other = triangles_[t];
      std::replace(triangles_[t].begin(), triangles_[t].end(), s[0], middle);
      std::replace(other.begin(), other.end(), s[1], middle);
      put_at_sides(t);
      add(other, face_[t]);
    }
    triangles_at_.erase(s);
  }

  double longest_side_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<Index> face_;
  std::map<Side, std::vector<Index>> triangles_at_;
  std::set<std::pair<double, Side>> too_long_;
};

/// Measures triangles as `face_geometry()` does.
inline Face_geometry refined_geometry(const Face_refinement& refinement, const Face_geometry& original,
                                      std::vector<double> edge_length) {
  Face_geometry geometry;
  geometry.unit = original.unit;
  geometry.origin = original.origin;
  geometry.rounding = original.rounding;
  geometry.total_area = original.total_area;
  geometry.degenerate_faces = original.degenerate_faces;
  geometry.edge_length = std::move(edge_length);
  for (std::size_t t = 0; t < refinement.triangles().size(); ++t) {
    const auto& [i, j, k] = refinement.triangles()[t];
    const Eigen::Vector3d &a = refinement.points()[i], &b = refinement.points()[j], &c = refinement.points()[k];
    geometry.centroid.push_back((a + b + c) / 3);
    geometry.normal.push_back(original.normal[refinement.faces()[t]]);
    geometry.area.push_back((b - a).cross(c - a).norm() / 2);
  }
  return geometry;
}

}  // namespace RW_segmentation::internal

#endif
