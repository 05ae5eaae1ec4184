#ifndef RW_SEGMENTATION_INTERNAL_TRIANGULATED_FACES_H
#define RW_SEGMENTATION_INTERNAL_TRIANGULATED_FACES_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/Descriptor_index.h>
#include <RW_segmentation/internal/Face_geometry.h>

#include <boost/graph/graph_traits.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The faces of a mesh as triangles that know their neighbours, in the coordinates of a `Face_geometry`. A face of more
/// than three sides becomes the fan of triangles round its centroid.
class Triangulated_faces {
 public:
  using Index = Dual_graph::Index;
  static constexpr Index none = Descriptor_index<int>::none;

  struct Triangle {
    std::array<Eigen::Vector3d, 3> corner;  // counterclockwise from outside; in a fan the first one is the centroid
    Eigen::Vector3d normal;                 // unit length, or zero for a triangle without area
    std::array<Index, 3> neighbour;         // beyond the side from corner k to k + 1; `none` where the mesh ends
  };

  template <class FaceListGraph, class NamedParameters>
  Triangulated_faces(const FaceListGraph& mesh, const Mesh_dual_graph<FaceListGraph>& graph,
                     const Face_geometry& geometry, const NamedParameters& np);

  std::size_t number_of_faces() const { return first_.size() - 1; }
  std::size_t number_of_triangles() const { return triangles_.size(); }
  const Triangle& triangle(Index i) const { return triangles_[i]; }

  /// The triangles of a face have the numbers from `first(face)` to less than `first(face + 1)`.
  Index first(Index face) const { return first_[face]; }

 private:
  std::vector<Triangle> triangles_;
  std::vector<Index> first_;
};

template <class FaceListGraph, class NamedParameters>
Triangulated_faces::Triangulated_faces(const FaceListGraph& mesh, const Mesh_dual_graph<FaceListGraph>& graph,
                                       const Face_geometry& geometry, const NamedParameters& np) {
  using halfedge_descriptor = typename boost::graph_traits<FaceListGraph>::halfedge_descriptor;
  struct Side {
    Index triangle;
    std::size_t number;
    halfedge_descriptor halfedge;
  };
  const Vertex_points<FaceListGraph, NamedParameters> point(mesh, np);
  const auto scaled = [&](auto v) -> Eigen::Vector3d { return (point(v) - geometry.origin) / geometry.unit; };
  Descriptor_index<halfedge_descriptor> triangle_of;
  std::vector<Side> sides;  // of the faces
  triangle_of.reserve(2 * num_edges(mesh));
  sides.reserve(3 * graph.number_of_faces());
  triangles_.reserve(graph.number_of_faces());
  first_.reserve(graph.number_of_faces() + 1);

  const auto add_side = [&](std::size_t number, halfedge_descriptor h) {
    const auto triangle = static_cast<Index>(triangles_.size());
    triangle_of.insert(h, triangle);
    sides.push_back({triangle, number, h});
  };
  for (Index f = 0; f < graph.number_of_faces(); ++f) {
    const auto last = halfedge(graph.face(f), mesh);
    const auto first_triangle = static_cast<Index>(triangles_.size());
    first_.push_back(first_triangle);
    if (next(next(next(last, mesh), mesh), mesh) == last) {
      std::array<Eigen::Vector3d, 3> corner;
      auto h = last;
      for (std::size_t k = 0; k < 3; ++k, h = next(h, mesh)) {
        corner[k] = scaled(source(h, mesh));
        add_side(k, h);
      }
      triangles_.push_back({corner, geometry.normal[f], {none, none, none}});
      continue;
    }
    auto h = last;
    do {
      const auto i = static_cast<Index>(triangles_.size());
      add_side(1, h);
      const Eigen::Vector3d a = geometry.centroid[f], b = scaled(source(h, mesh)), c = scaled(target(h, mesh));
      const Eigen::Vector3d area_vector = (b - a).cross(c - a) / 2;
      const bool degenerate = !(area_vector.norm() > 4 * geometry.rounding * std::max((b - a).norm(), (c - a).norm()));
      const Eigen::Vector3d normal = degenerate ? Eigen::Vector3d::Zero() : area_vector.normalized();
      triangles_.push_back({{a, b, c}, normal, {i - 1, none, i + 1}});
      h = next(h, mesh);
    } while (h != last);
    triangles_[first_triangle].neighbour[0] = static_cast<Index>(triangles_.size() - 1);
    triangles_.back().neighbour[2] = first_triangle;
  }
  first_.push_back(static_cast<Index>(triangles_.size()));
  for (const Side& side : sides)
    triangles_[side.triangle].neighbour[side.number] = triangle_of[opposite(side.halfedge, mesh)];
}

}  // namespace RW_segmentation::internal

#endif
