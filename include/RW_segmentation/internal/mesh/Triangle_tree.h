// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_TRIANGLE_TREE_H
#define RW_SEGMENTATION_INTERNAL_MESH_TRIANGLE_TREE_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Dual_mesh.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// A triangle of the fan that covers a face, in the unit box.
struct Fan_triangle {
  Eigen::Vector3d corner, first_side, second_side;
  Dual_graph::Index face;
};

/// An axis-parallel box in single precision, empty at first.
struct Float_box {
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  std::array<float, 3> least = {infinity, infinity, infinity};
  std::array<float, 3> greatest = {-infinity, -infinity, -infinity};

  void extend(const Eigen::Vector3d& point, float margin) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto x = static_cast<float>(point[static_cast<Eigen::Index>(axis)]);
      least[axis] = std::min(least[axis], x - margin);
      greatest[axis] = std::max(greatest[axis], x + margin);
    }
  }

  void extend(const Float_box& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], other.least[axis]);
      greatest[axis] = std::max(greatest[axis], other.greatest[axis]);
    }
  }
};

/// A tree of boxes over triangles, in which rays find where they leave the solid.
///
/// Triangles are sorted along a Morton curve and halved in that order again and again. Building it takes no more than
/// that sort and one pass, a third of the time of a tree that is split by position; for a few thousand rays this is
/// what counts. Boxes are held in single precision, a little too large; hits are computed in double precision.
class Triangle_tree {
 public:
  using Index = Dual_graph::Index;

  /// The first faces of a mesh, those of each face fanned out from its first corner.
  /// Complexity: O(n log n), 40 bytes a triangle.
  Triangle_tree(const Dual_mesh& mesh, std::size_t number_of_faces) : mesh_(mesh) { build(number_of_faces); }

  /// All faces of a mesh.
  explicit Triangle_tree(const Dual_mesh& mesh) : Triangle_tree(mesh, mesh.number_of_faces()) {}

  /// All faces of a mesh, in the coordinates of another one's unit box.
  static Triangle_tree in_frame(const Dual_mesh& mesh, const Dual_mesh& frame) {
    Triangle_tree tree;
    tree.mesh_ = mesh;
    tree.scale_ = mesh.unit() / frame.unit();
    tree.shift_ = (mesh.origin() - frame.origin()) / frame.unit();
    tree.build(mesh.number_of_faces());
    return tree;
  }

  std::size_t number_of_triangles() const { return triangles_.size(); }

  /// Along the Morton curve, in which neighbours in the order are mostly neighbours in space.
  Fan_triangle triangle(std::size_t i) const { return triangle(triangles_[i]); }

  /// The distance at which a ray first leaves the solid through a triangle that is not of the face `start`; infinity
  /// if it does not. Triangles that it meets from outside do not stop it.
  /// \param direction a unit vector
  double exit_distance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, Index start) const;

  /// Defined in `closest_face.h`. The face of the triangle that is closest to a point, the lowest on a tie, among those that look into a direction
  /// rather than away from it; nothing if there is none. Any triangle with an area will do for the zero vector.
  std::optional<Index> closest_face(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const;

 private:
  static constexpr std::size_t triangles_per_leaf = 4;

  /// A triangle by its vertices: a fifth of the memory of their coordinates, which are read where a ray comes near.
  struct Corners {
    std::array<Index, 3> vertices;
    Index face;
  };

  Triangle_tree() = default;

  void build(std::size_t number_of_faces) {
    points_ = mesh_.points().data();
    sort_along_curve(number_of_faces);
    while (leaves_ * triangles_per_leaf < triangles_.size()) leaves_ *= 2;
    boxes_.resize(2 * leaves_);
    for (std::size_t leaf = 0; leaf < leaves_; ++leaf)
      for (std::size_t i = leaf_begin(leaf); i < leaf_begin(leaf + 1); ++i)
        extend_by_triangle(boxes_[leaves_ + leaf], triangle(i));
    for (std::size_t node = leaves_; node-- > 1;) {
      boxes_[node] = boxes_[2 * node];
      boxes_[node].extend(boxes_[2 * node + 1]);
    }
  }

  Fan_triangle triangle(const Corners& corners) const {
    const Eigen::Vector3d& apex = points_[corners.vertices[0]];
    return {scale_ * apex + shift_, scale_ * (points_[corners.vertices[1]] - apex),
            scale_ * (points_[corners.vertices[2]] - apex), corners.face};
  }

  std::size_t leaf_begin(std::size_t leaf) const { return leaf * triangles_.size() / leaves_; }

  /// By more than the triangle: by the rounding of its coordinates, which lie between -1 and 1.
  static void extend_by_triangle(Float_box& box, const Fan_triangle& triangle) {
    constexpr float margin = 1e-6f;
    box.extend(triangle.corner, margin);
    box.extend(triangle.corner + triangle.first_side, margin);
    box.extend(triangle.corner + triangle.second_side, margin);
  }

  void sort_along_curve(std::size_t number_of_faces);

  Dual_mesh mesh_;
  const Eigen::Vector3d* points_ = nullptr;  // of the mesh, all copies of which share them
  double scale_ = 1;
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();
  std::vector<Corners> triangles_;
  std::size_t leaves_ = 1;
  std::vector<Float_box> boxes_;  // of node 1, the root; children of node i are 2 i and 2 i + 1
};

inline void Triangle_tree::sort_along_curve(std::size_t number_of_faces) {
  constexpr double cells = 1 << 20;          // a side of the box from -1 to 1
  const auto spread = [](std::uint64_t x) {  // writes two zeros before each of 20 bits
    x = (x | x << 32) & 0x1f00000000ffff;
    x = (x | x << 16) & 0x1f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
  };
  struct Place {
    std::uint64_t code;  // of the middle, along the curve
    Index face, corner;  // the second one of the triangle, counted in the face
  };
  std::vector<Place> order;
  order.reserve(number_of_faces);
  for (Index f = 0; f < number_of_faces; ++f) {
    const auto corners = mesh_.corners(f);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const Fan_triangle t = triangle(Corners{{corners[0], corners[k], corners[k + 1]}, f});
      const Eigen::Vector3d middle = t.corner + (t.first_side + t.second_side) / 3;
      std::uint64_t code = 0;
      for (int axis = 0; axis < 3; ++axis)
        code |= spread(static_cast<std::uint64_t>(std::clamp((middle[axis] + 1) / 2 * cells, 0., cells - 1))) << axis;
      order.push_back({code, f, static_cast<Index>(k)});
    }
  }
  std::sort(order.begin(), order.end(), [](const Place& a, const Place& b) {
    return std::tie(a.code, a.face, a.corner) < std::tie(b.code, b.face, b.corner);
  });
  triangles_.reserve(order.size());
  for (const auto& [code, f, k] : order) {
    const auto corners = mesh_.corners(f);
    triangles_.push_back({{corners[0], corners[k], corners[k + std::size_t(1)]}, f});
  }
}

inline double Triangle_tree::exit_distance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                           Index start) const {
  constexpr double nearest = 1e-9;  // of the box: the surface at the origin itself
  constexpr float none = std::numeric_limits<float>::infinity();
  std::array<float, 3> start_of_ray, slope;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto along = static_cast<float>(direction[static_cast<Eigen::Index>(axis)]);
    start_of_ray[axis] = static_cast<float>(origin[static_cast<Eigen::Index>(axis)]);
    slope[axis] = 1 / (std::abs(along) < 1e-12f ? 1e-12f : along);
  }
  double exit = std::numeric_limits<double>::infinity();
  const auto entry = [&](std::size_t node) {
    const Float_box& box = boxes_[node];
    float in = 0, out = none;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float t0 = (box.least[axis] - start_of_ray[axis]) * slope[axis];
      const float t1 = (box.greatest[axis] - start_of_ray[axis]) * slope[axis];
      in = std::max(in, std::min(t0, t1));
      out = std::min(out, std::max(t0, t1));
    }
    return in <= out && in <= static_cast<float>(exit) ? in : none;
  };

  struct Node {
    std::size_t node;
    float entry;
  };
  std::array<Node, 64> open;  // at most one a level
  std::size_t number_open = 0;
  if (entry(1) < none) open[number_open++] = {1, 0};
  while (number_open > 0) {
    const auto [node, in] = open[--number_open];
    if (in > static_cast<float>(exit)) continue;
    if (node < leaves_) {
      Node near = {2 * node, entry(2 * node)}, far = {2 * node + 1, entry(2 * node + 1)};
      if (far.entry < near.entry) std::swap(near, far);
      if (far.entry < none) open[number_open++] = far;
      if (near.entry < none) open[number_open++] = near;
      continue;
    }
    for (std::size_t i = leaf_begin(node - leaves_); i < leaf_begin(node - leaves_ + 1); ++i) {
      // Moeller and Trumbore; the determinant is negative where the ray leaves.
      const auto [corner, first_side, second_side, face] = triangle(i);
      const Eigen::Vector3d p = direction.cross(second_side);
      const double determinant = first_side.dot(p);
      if (!(determinant < 0) || face == start) continue;
      const Eigen::Vector3d to_origin = origin - corner;
      const double u = to_origin.dot(p) / determinant;
      if (u < 0 || u > 1) continue;
      const Eigen::Vector3d q = to_origin.cross(first_side);
      const double v = direction.dot(q) / determinant;
      if (v < 0 || u + v > 1) continue;
      const double t = second_side.dot(q) / determinant;
      if (t > nearest && t < exit) exit = t;
    }
  }
  return exit;
}

}  // namespace RW_segmentation::internal

#endif
