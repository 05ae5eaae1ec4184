// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_FACE_REFINEMENT_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_FACE_REFINEMENT_H

#include <RW_segmentation/Dual_mesh.h>

#include <Eigen/Core>

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
  using Index = Dual_mesh::Index;

  /// Faces of more than three sides are cut into fans first. Complexity: n log n for n triangles in the end.
  Face_refinement(const Dual_mesh& mesh, double longest_side) : longest_side_(longest_side), points_(mesh.points()) {
    for (Index f = 0; f < mesh.number_of_faces(); ++f) {
      const Dual_mesh::Corners corner = mesh.corners(f);
      for (std::size_t c = 2; c < corner.size(); ++c) add({corner[0], corner[c - 1], corner[c]}, f);
    }
    while (!too_long_.empty()) halve(std::prev(too_long_.end())->second);
    mesh_ = triangles_of(mesh);
  }

  /// The triangles, in the unit box of the mesh. They have the `shape_normal()` of their faces.
  const Dual_mesh& mesh() const { return mesh_; }

  /// The face that each triangle is part of.
  const std::vector<Index>& faces() const { return face_; }

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

  Dual_mesh triangles_of(const Dual_mesh& mesh) const {
    Dual_mesh::Arrays arrays;
    arrays.points = points_;
    arrays.corners.reserve(triangles_.size(), 3 * triangles_.size());
    for (const auto& triangle : triangles_) {
      for (const Index v : triangle) arrays.corners.add(v);
      arrays.corners.end_face();
    }
    add_edges(mesh, arrays);
    return in_box_of(mesh, std::move(arrays), face_);
  }

  /// Triangles of two faces that have a wall between them have one, too.
  void add_edges(const Dual_mesh& mesh, Dual_mesh::Arrays& arrays) const {
    std::set<std::pair<Index, Index>> apart;
    if (mesh.has_walls())
      for (Index e = 0; e < mesh.number_of_edges(); ++e)
        if (mesh.is_wall(e)) apart.insert(std::minmax(mesh.graph().faces_of(e)[0], mesh.graph().faces_of(e)[1]));
    std::vector<std::array<Index, 2>> sides;
    for (const auto& [s, triangles] : triangles_at_) {
      if (triangles.size() != 2) continue;
      sides.push_back({triangles[0], triangles[1]});
      arrays.edge_ends.push_back(is_before(s, triangles_[triangles[0]]) ? s : Side{s[1], s[0]});
      if (mesh.has_walls())
        arrays.is_wall.push_back(apart.count(std::minmax(face_[triangles[0]], face_[triangles[1]])) > 0);
    }
    arrays.graph = {triangles_.size(), std::move(sides)};
  }

  /// Whether a triangle has its side's ends in that order.
  static bool is_before(const Side& s, const std::array<Index, 3>& triangle) {
    const auto first = std::find(triangle.begin(), triangle.end(), s[0]);
    return triangle[static_cast<std::size_t>(first - triangle.begin() + 1) % 3] == s[1];
  }

  double longest_side_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<Index> face_;  // of each triangle
  std::map<Side, std::vector<Index>> triangles_at_;
  std::set<std::pair<double, Side>> too_long_;
  Dual_mesh mesh_;
};

}  // namespace RW_segmentation::internal

#endif
