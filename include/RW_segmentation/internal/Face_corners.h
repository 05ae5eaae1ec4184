#ifndef RW_SEGMENTATION_INTERNAL_FACE_CORNERS_H
#define RW_SEGMENTATION_INTERNAL_FACE_CORNERS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/Descriptor_index.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/check_number.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The vertices of a mesh and the corners of its faces as compressed rows, in the coordinates of `Face_geometry`.
class Face_corners {
 public:
  using Index = Dual_graph::Index;

  /// The corners of a face, a contiguous range of numbers of vertices.
  struct Range {
    const Index *first, *last;
    const Index* begin() const { return first; }
    const Index* end() const { return last; }
  };

  /// Reads the mesh of which `graph` is the dual. Complexity: linear.
  template <class FaceListGraph, class NamedParameters>
  Face_corners(const FaceListGraph& mesh, const Mesh_dual_graph<FaceListGraph>& graph, const NamedParameters& np) {
    using vertex_descriptor = typename boost::graph_traits<FaceListGraph>::vertex_descriptor;
    const Unit_box_points<FaceListGraph, NamedParameters> point(mesh, np);
    Descriptor_index<vertex_descriptor> number;
    check_number(num_vertices(mesh), "vertices");
    number.reserve(num_vertices(mesh));
    for (const vertex_descriptor v : vertices(mesh)) {
      number.insert(v, static_cast<Index>(points_.size()));
      points_.push_back(point(v));
    }
    for (const auto f : graph.face_descriptors()) {
      const auto first = halfedge(f, mesh);
      auto h = first;
      do {
        corners_.push_back(number[target(h, mesh)]);
        h = next(h, mesh);
      } while (h != first);
      row_.push_back(corners_.size());
    }
  }

  /// Those of triangles.
  Face_corners(std::vector<Eigen::Vector3d> points, const std::vector<std::array<Index, 3>>& triangles)
      : points_(std::move(points)) {
    for (const auto& triangle : triangles) {
      corners_.insert(corners_.end(), triangle.begin(), triangle.end());
      row_.push_back(corners_.size());
    }
  }

  Range operator[](Index face) const {
    return {corners_.data() + row_[face], corners_.data() + row_[face + std::size_t(1)]};
  }
  const Eigen::Vector3d& point(Index vertex) const { return points_[vertex]; }
  std::size_t number_of_vertices() const { return points_.size(); }

  /// The longest distance between two corners of a face.
  double extent(Index face) const {
    double longest = 0;
    for (const Index v : (*this)[face])
      for (const Index w : (*this)[face]) longest = std::max(longest, (point(v) - point(w)).norm());
    return longest;
  }

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::size_t> row_ = {0};
  std::vector<Index> corners_;
};

}  // namespace RW_segmentation::internal

#endif
