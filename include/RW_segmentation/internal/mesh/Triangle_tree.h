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

/// Four axis-parallel boxes in single precision, empty at first; an operation on one of them takes no longer than on all.
struct Float_boxes {
  using Floats = Eigen::Array4f;
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  std::array<Floats, 3> least = {Floats::Constant(infinity), Floats::Constant(infinity), Floats::Constant(infinity)};
  std::array<Floats, 3> greatest = {Floats::Constant(-infinity), Floats::Constant(-infinity),
                                    Floats::Constant(-infinity)};

  void extend(Eigen::Index box, const Eigen::Vector3d& point, float margin) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto x = static_cast<float>(point[static_cast<Eigen::Index>(axis)]);
      least[axis][box] = std::min(least[axis][box], x - margin);
      greatest[axis][box] = std::max(greatest[axis][box], x + margin);
    }
  }

  /// Extends one box by four.
  void extend(Eigen::Index box, const Float_boxes& others) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis][box] = std::min(least[axis][box], others.least[axis].minCoeff());
      greatest[axis][box] = std::max(greatest[axis][box], others.greatest[axis].maxCoeff());
    }
  }
};

/// A tree of boxes over triangles, in which rays find where they leave the solid.
///
/// Triangles are sorted along a Morton curve and quartered in that order again and again. Building it takes no more than
/// that sort and one pass, a third of the time of a tree that is split by position; for a few thousand rays this is
/// what counts. Boxes are held in single precision, a little too large, four side by side, which are met at once; hits are
/// computed in double precision.
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

  /// A face, and how far it is from a point.
  struct Near_face {
    Index face;
    double squared_distance;
  };

  /// Defined in `closest_face.h`. The face of the triangle that is closest to a point, the lowest on a tie, among those that
  /// look into a direction rather than away from it; nothing if there is none. Any triangle with an area will do for the
  /// zero vector.
  std::optional<Near_face> closest_face(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const;

 private:
  static constexpr std::size_t triangles_per_leaf = 4;
  using Floats = Float_boxes::Floats;

  /// A triangle by its vertices: a fifth of the memory of their coordinates, which are read where a ray comes near.
  struct Corners {
    std::array<Index, 3> vertices;
    Index face;
  };

  Triangle_tree() = default;

  void build(std::size_t number_of_faces) {
    points_ = mesh_.points().data();
    sort_along_curve(number_of_faces);
    while (leaves_ * triangles_per_leaf < triangles_.size()) leaves_ *= 4;
    boxes_.resize((leaves_ - 1) / 3);
    if (boxes_.empty()) return;
    for (std::size_t leaf = 0; leaf < leaves_; ++leaf) {
      const std::size_t node = boxes_.size() + leaf;
      for (std::size_t i = leaf_begin(leaf); i < leaf_begin(leaf + 1); ++i)
        extend_by_triangle(boxes_[parent(node)], child(node), triangle(i));
    }
    for (std::size_t node = boxes_.size(); node-- > 1;) boxes_[parent(node)].extend(child(node), boxes_[node]);
  }

  static std::size_t parent(std::size_t node) { return (node - 1) / 4; }
  static Eigen::Index child(std::size_t node) { return static_cast<Eigen::Index>((node - 1) % 4); }

  Fan_triangle triangle(const Corners& corners) const {
    const Eigen::Vector3d& apex = points_[corners.vertices[0]];
    return {scale_ * apex + shift_, scale_ * (points_[corners.vertices[1]] - apex),
            scale_ * (points_[corners.vertices[2]] - apex), corners.face};
  }

  std::size_t leaf_begin(std::size_t leaf) const { return leaf * triangles_.size() / leaves_; }

  /// By more than the triangle: by the rounding of its coordinates, which lie between -1 and 1.
  static void extend_by_triangle(Float_boxes& boxes, Eigen::Index box, const Fan_triangle& triangle) {
    constexpr float margin = 1e-6f;
    boxes.extend(box, triangle.corner, margin);
    boxes.extend(box, triangle.corner + triangle.first_side, margin);
    boxes.extend(box, triangle.corner + triangle.second_side, margin);
  }

  /// Calls `visit` with the triangles in boxes that are near enough, those of the nearest box first.
  /// \param distances_to returns for four boxes how far away each is; no number where what is sought is not in it
  /// \param limit returns the largest distance that is near enough, which may fall from visit to visit
  template <class Distances, class Limit, class Visit>
  void search(const Distances& distances_to, const Limit& limit, const Visit& visit) const {
    struct Node {
      std::size_t node;
      float distance;
    };
    std::array<Node, 64> open;  // at most three a level, and the nearest one; the nearest of a level last
    std::size_t number_open = 0;
    if (!triangles_.empty()) open[number_open++] = {0, 0};
    while (number_open > 0) {
      const auto [node, distance] = open[--number_open];
      if (!(static_cast<double>(distance) <= limit())) continue;
      if (node >= boxes_.size()) {
        const std::size_t leaf = node - boxes_.size();
        for (std::size_t i = leaf_begin(leaf); i < leaf_begin(leaf + 1); ++i) visit(triangle(i));
        continue;
      }
      const Floats distances = distances_to(boxes_[node]);
      const double farthest = limit();
      const std::size_t first = number_open;
      for (std::size_t c = 0; c < 4; ++c) {  // without a branch, which nobody could predict
        const float of_child = distances[static_cast<Eigen::Index>(c)];
        open[number_open] = {4 * node + 1 + c, of_child};
        number_open += static_cast<std::size_t>(static_cast<double>(of_child) <= farthest);
      }
      for (std::size_t last = first + 1; last < number_open; ++last)
        for (std::size_t k = last; k > first && open[k - 1].distance < open[k].distance; --k)
          std::swap(open[k - 1], open[k]);
    }
  }

  void sort_along_curve(std::size_t number_of_faces);

  Dual_mesh mesh_;
  const Eigen::Vector3d* points_ = nullptr;  // of the mesh, all copies of which share them
  double scale_ = 1;
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();
  std::vector<Corners> triangles_;
  std::size_t leaves_ = 1;
  // Of the children of each inner node i, which are the nodes 4 i + 1 to 4 i + 4; the leaves come after the inner nodes.
  std::vector<Float_boxes> boxes_;
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
  std::array<float, 3> start_of_ray, slope;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto along = static_cast<float>(direction[static_cast<Eigen::Index>(axis)]);
    start_of_ray[axis] = static_cast<float>(origin[static_cast<Eigen::Index>(axis)]);
    slope[axis] = 1 / (std::abs(along) < 1e-12f ? 1e-12f : along);
  }
  double exit = std::numeric_limits<double>::infinity();
  const auto entries = [&](const Float_boxes& boxes) -> Floats {
    Floats in = Floats::Zero(), out = Floats::Constant(Float_boxes::infinity);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Floats t0 = (boxes.least[axis] - start_of_ray[axis]) * slope[axis];
      const Floats t1 = (boxes.greatest[axis] - start_of_ray[axis]) * slope[axis];
      in = in.max(t0.min(t1));
      out = out.min(t0.max(t1));
    }
    return (in <= out).select(in, Floats::Constant(std::numeric_limits<float>::quiet_NaN()));
  };
  search(
      entries, [&] { return exit; },
      [&](const Fan_triangle& triangle) {
        // Moeller and Trumbore; the determinant is negative where the ray leaves.
        const Eigen::Vector3d p = direction.cross(triangle.second_side);
        const double determinant = triangle.first_side.dot(p);
        if (!(determinant < 0) || triangle.face == start) return;
        const Eigen::Vector3d to_origin = origin - triangle.corner;
        const double u = to_origin.dot(p);  // both coordinates times the determinant
        if (u > 0 || u < determinant) return;
        const Eigen::Vector3d q = to_origin.cross(triangle.first_side);
        const double v = direction.dot(q);
        if (v > 0 || u + v < determinant) return;
        const double t = triangle.second_side.dot(q) / determinant;
        if (t > nearest && t < exit) exit = t;
      });
  return exit;
}

}  // namespace RW_segmentation::internal

#endif
