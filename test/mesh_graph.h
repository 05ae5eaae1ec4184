// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_MESH_GRAPH_H
#define RW_SEGMENTATION_TEST_MESH_GRAPH_H

// The faces of a mesh as a graph in the order of the mesh itself, read without the library's own numbering.

#include <RW_segmentation/Dual_graph.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>

#include <array>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace meshes {

/// Faces are numbered in the order of `faces(mesh)`, interior edges in the order of `edges(mesh)`.
template <class Mesh>
class Mesh_graph : public RW_segmentation::Dual_graph {
 public:
  using face_descriptor = typename boost::graph_traits<Mesh>::face_descriptor;
  using edge_descriptor = typename boost::graph_traits<Mesh>::edge_descriptor;

  explicit Mesh_graph(const Mesh& mesh) {
    for (const face_descriptor f : faces(mesh)) {
      index_.emplace(f, static_cast<Index>(faces_.size()));
      faces_.push_back(f);
    }
    std::vector<std::array<Index, 2>> ends;
    for (const edge_descriptor e : edges(mesh)) {
      const auto h = halfedge(e, mesh);
      const auto f = face(h, mesh), g = face(opposite(h, mesh), mesh);
      if (CGAL::is_border(e, mesh) || f == g) continue;
      ends.push_back({index_.at(f), index_.at(g)});
      edges_.push_back(e);
    }
    static_cast<Dual_graph&>(*this) = Dual_graph(faces_.size(), std::move(ends));
  }

  face_descriptor face_at(Index i) const { return faces_[i]; }
  const std::vector<face_descriptor>& face_descriptors() const { return faces_; }
  edge_descriptor edge(Index i) const { return edges_[i]; }
  const std::vector<edge_descriptor>& edge_descriptors() const { return edges_; }
  Index index(face_descriptor f) const { return index_.at(f); }

 private:
  std::vector<face_descriptor> faces_;
  std::vector<edge_descriptor> edges_;
  std::map<face_descriptor, Index> index_;
};

}  // namespace meshes

#endif
