// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_CURVATURE_TRIANGULATED_FACES_H
#define RW_SEGMENTATION_INTERNAL_CURVATURE_TRIANGULATED_FACES_H

#include <RW_segmentation/Dual_mesh.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The faces of a mesh as triangles that know their neighbours. A face of more than three sides becomes the fan of
/// triangles round its centroid.
class Triangulated_faces {
 public:
  using Index = Dual_mesh::Index;
  static constexpr Index none = std::numeric_limits<Index>::max();

  struct Triangle {
    std::array<Eigen::Vector3d, 3> corner;  // counterclockwise from outside; in a fan the first one is the centroid
    Eigen::Vector3d normal;                 // unit length, or zero for a triangle without area
    std::array<Index, 3> neighbour;         // beyond the side from corner k to k + 1; `none` where the mesh ends
  };

  /// Complexity: linear.
  explicit Triangulated_faces(const Dual_mesh& mesh) {
    triangles_.reserve(mesh.number_of_faces());
    first_.reserve(mesh.number_of_faces() + 1);
    for (Index f = 0; f < mesh.number_of_faces(); ++f) {
      first_.push_back(static_cast<Index>(triangles_.size()));
      if (mesh.corners(f).size() == 3)
        add_triangle(mesh, f);
      else
        add_fan(mesh, f);
    }
    first_.push_back(static_cast<Index>(triangles_.size()));
    for (Index e = 0; e < mesh.number_of_edges(); ++e) {
      const auto [f, g] = mesh.graph().faces_of(e);
      const auto [v, w] = mesh.ends(e);
      const auto [i, side] = at_side(mesh, f, v, w);
      const auto [j, other_side] = at_side(mesh, g, w, v);
      triangles_[i].neighbour[side] = j;
      triangles_[j].neighbour[other_side] = i;
    }
  }

  std::size_t number_of_faces() const { return first_.size() - 1; }
  std::size_t number_of_triangles() const { return triangles_.size(); }
  const Triangle& triangle(Index i) const { return triangles_[i]; }

  /// The triangles of a face have the numbers from `first(face)` to less than `first(face + 1)`.
  Index first(Index face) const { return first_[face]; }

 private:
  /// The place of a corner among those of its triangle or fan, which begin with the last one of the face.
  static std::size_t place(const Dual_mesh::Corners& corners, std::size_t k) { return (k + 1) % corners.size(); }

  void add_triangle(const Dual_mesh& mesh, Index f) {
    const auto corners = mesh.corners(f);
    triangles_.push_back(
        {{mesh.point(corners[2]), mesh.point(corners[0]), mesh.point(corners[1])}, mesh.normal(f), {none, none, none}});
  }

  void add_fan(const Dual_mesh& mesh, Index f) {
    const auto corners = mesh.corners(f);
    const Index first = first_.back();
    const Eigen::Vector3d& a = mesh.centroid(f);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto i = static_cast<Index>(triangles_.size());
      const Eigen::Vector3d& b = mesh.point(corners[(k + corners.size() - 1) % corners.size()]);
      const Eigen::Vector3d& c = mesh.point(corners[k]);
      const Eigen::Vector3d area_vector = (b - a).cross(c - a) / 2;
      const bool degenerate = !(area_vector.norm() > 4 * mesh.rounding() * std::max((b - a).norm(), (c - a).norm()));
      const Eigen::Vector3d normal = degenerate ? Eigen::Vector3d::Zero() : area_vector.normalized();
      triangles_.push_back({{a, b, c}, normal, {i - 1, none, i + 1}});
    }
    triangles_[first].neighbour[0] = static_cast<Index>(triangles_.size() - 1);
    triangles_.back().neighbour[2] = first;
  }

  /// The triangle at the side of a face from a vertex to another, and the number of the side in the triangle.
  std::pair<Index, std::size_t> at_side(const Dual_mesh& mesh, Index f, Index from, Index to) const {
    const auto corners = mesh.corners(f);
    std::size_t k = 0;
    while (corners[k] != from || corners[(k + 1) % corners.size()] != to) ++k;
    const std::size_t side = place(corners, k);
    if (corners.size() == 3) return {first_[f], side};
    return {first_[f] + static_cast<Index>(side), 1};
  }

  std::vector<Triangle> triangles_;
  std::vector<Index> first_;
};

}  // namespace RW_segmentation::internal

#endif
