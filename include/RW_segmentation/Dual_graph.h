// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_DUAL_GRAPH_H
#define RW_SEGMENTATION_DUAL_GRAPH_H

#include <boost/graph/graph_traits.hpp>
#include <boost/graph/properties.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/property_map/property_map.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// The dual of a mesh, as a graph and nothing else: a node for each face, an edge for each pair of faces that share a
/// mesh edge, stored as compressed rows.
///
/// Nodes are numbered 0 .. `number_of_faces()` - 1, edges 0 .. `number_of_edges()` - 1. Two faces that share several
/// mesh edges are joined by as many parallel edges; a mesh edge with the same face on both sides is no edge here.
/// Models Boost.Graph's `VertexListGraph` and `IncidenceGraph`, so that its Dijkstra runs on it; a weight map has
/// `Arc` as its key.
///
/// Memory: 4 bytes a face and 24 bytes an edge.
class Dual_graph {
 public:
  /// Numbers of faces and of edges.
  using Index = std::uint32_t;

  /// The way from a face to one of its neighbours.
  struct Neighbour {
    Index face;  ///< where it leads
    Index edge;  ///< over which edge
  };

  /// A directed edge, Boost.Graph's edge descriptor.
  struct Arc {
    Index source;  ///< the face it leaves
    Index target;  ///< the face it leads to
    Index edge;    ///< between the two
    friend bool operator==(const Arc& a, const Arc& b) { return a.source == b.source && a.edge == b.edge; }
    friend bool operator!=(const Arc& a, const Arc& b) { return !(a == b); }
  };

  /// The neighbours of a face, a contiguous range.
  class Neighbours {
   public:
    /// The neighbours from `begin` to `end`, which stay where they are.
    Neighbours(const Neighbour* begin, const Neighbour* end) : begin_(begin), end_(end) {}
    /// The first neighbour.
    const Neighbour* begin() const { return begin_; }
    /// Behind the last neighbour.
    const Neighbour* end() const { return end_; }
    /// The number of neighbours.
    std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }

   private:
    const Neighbour *begin_, *end_;
  };

  Dual_graph() = default;

  /// The graph with `number_of_faces` nodes and the given pairs of faces as edges.
  /// \throws std::length_error if there are 2^32 - 1 faces or more, or as many directed edges
  /// \throws std::invalid_argument if an edge names a face that is not there, or the same face twice
  /// Complexity: linear.
  Dual_graph(std::size_t number_of_faces, std::vector<std::array<Index, 2>> edges);

  /// Faces are numbered from 0 to this - 1.
  std::size_t number_of_faces() const { return row_.size() - 1; }
  /// Edges are numbered from 0 to this - 1.
  std::size_t number_of_edges() const { return ends_.size(); }

  /// The neighbours of a face in the order of the edges, one for each edge.
  Neighbours neighbours(Index face) const {
    return {neighbours_.data() + row_[face], neighbours_.data() + row_[face + std::size_t(1)]};
  }

  /// The two faces of an edge.
  const std::array<Index, 2>& faces_of(Index edge) const { return ends_[edge]; }

 private:
  std::vector<Index> row_ = {0};
  std::vector<Neighbour> neighbours_;
  std::vector<std::array<Index, 2>> ends_;
};

namespace internal {

/// Iterates over the arcs that leave a face.
class Arc_iterator {
 public:
  using iterator_category = std::forward_iterator_tag;
  using value_type = Dual_graph::Arc;
  using difference_type = std::ptrdiff_t;
  using pointer = const Dual_graph::Arc*;
  using reference = Dual_graph::Arc;

  Arc_iterator() = default;
  Arc_iterator(Dual_graph::Index source, const Dual_graph::Neighbour* neighbour)
      : source_(source), neighbour_(neighbour) {}

  Dual_graph::Arc operator*() const { return {source_, neighbour_->face, neighbour_->edge}; }
  Arc_iterator& operator++() {
    ++neighbour_;
    return *this;
  }
  Arc_iterator operator++(int) {
    Arc_iterator old = *this;
    ++neighbour_;
    return old;
  }
  friend bool operator==(const Arc_iterator& a, const Arc_iterator& b) { return a.neighbour_ == b.neighbour_; }
  friend bool operator!=(const Arc_iterator& a, const Arc_iterator& b) { return !(a == b); }

 private:
  Dual_graph::Index source_ = 0;
  const Dual_graph::Neighbour* neighbour_ = nullptr;
};

}  // namespace internal

/// \cond  Boost.Graph's own functions
inline std::pair<boost::counting_iterator<Dual_graph::Index>, boost::counting_iterator<Dual_graph::Index>> vertices(
    const Dual_graph& graph) {
  const auto end = static_cast<Dual_graph::Index>(graph.number_of_faces());
  return {boost::counting_iterator<Dual_graph::Index>(0), boost::counting_iterator<Dual_graph::Index>(end)};
}
inline std::size_t num_vertices(const Dual_graph& graph) { return graph.number_of_faces(); }
inline std::pair<internal::Arc_iterator, internal::Arc_iterator> out_edges(Dual_graph::Index face,
                                                                           const Dual_graph& graph) {
  const auto range = graph.neighbours(face);
  return {internal::Arc_iterator(face, range.begin()), internal::Arc_iterator(face, range.end())};
}
inline std::size_t out_degree(Dual_graph::Index face, const Dual_graph& graph) { return graph.neighbours(face).size(); }
inline Dual_graph::Index source(const Dual_graph::Arc& arc, const Dual_graph&) { return arc.source; }
inline Dual_graph::Index target(const Dual_graph::Arc& arc, const Dual_graph&) { return arc.target; }
inline boost::typed_identity_property_map<Dual_graph::Index> get(boost::vertex_index_t, const Dual_graph&) {
  return {};
}
/// \endcond

}  // namespace RW_segmentation

namespace boost {

template <>
struct graph_traits<RW_segmentation::Dual_graph> {
  struct traversal_category : virtual incidence_graph_tag, virtual vertex_list_graph_tag {};
  using vertex_descriptor = RW_segmentation::Dual_graph::Index;
  using edge_descriptor = RW_segmentation::Dual_graph::Arc;
  using directed_category = directed_tag;
  using edge_parallel_category = allow_parallel_edge_tag;
  using vertex_iterator = counting_iterator<vertex_descriptor>;
  using out_edge_iterator = RW_segmentation::internal::Arc_iterator;
  using in_edge_iterator = void;  // what Boost.Graph's adaptors name, this graph does not have
  using edge_iterator = void;
  using adjacency_iterator = void;
  using vertices_size_type = std::size_t;
  using edges_size_type = std::size_t;
  using degree_size_type = std::size_t;
  static vertex_descriptor null_vertex() { return std::numeric_limits<vertex_descriptor>::max(); }
};

template <>
struct property_map<RW_segmentation::Dual_graph, vertex_index_t> {
  using type = typed_identity_property_map<RW_segmentation::Dual_graph::Index>;
  using const_type = type;
};

}  // namespace boost

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Dual_graph.h>
#endif

#endif
