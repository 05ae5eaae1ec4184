#ifndef RW_SEGMENTATION_DUAL_GRAPH_H
#define RW_SEGMENTATION_DUAL_GRAPH_H

#include <RW_segmentation/internal/Descriptor_index.h>
#include <RW_segmentation/internal/check_number.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <boost/property_map/property_map.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
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
/// Memory: 8 bytes a face and 24 bytes an edge.
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
  Dual_graph(std::size_t number_of_faces, std::vector<std::array<Index, 2>> edges) : ends_(std::move(edges)) {
    internal::check_number(number_of_faces, "faces");
    internal::check_number(2 * ends_.size(), "directed edges");
    row_.assign(number_of_faces + 1, 0);
    for (const auto& [f, g] : ends_) {
      if (f >= number_of_faces || g >= number_of_faces || f == g)
        throw std::invalid_argument("Dual_graph: an edge must join two different faces of the graph");
      ++row_[f + 1];
      ++row_[g + 1];
    }
    for (std::size_t f = 0; f < number_of_faces; ++f) row_[f + 1] += row_[f];
    neighbours_.resize(2 * ends_.size());
    std::vector<std::size_t> next(row_.begin(), row_.end() - 1);
    for (std::size_t e = 0; e < ends_.size(); ++e) {
      const auto [f, g] = ends_[e];
      neighbours_[next[f]++] = {g, static_cast<Index>(e)};
      neighbours_[next[g]++] = {f, static_cast<Index>(e)};
    }
  }

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
  std::vector<std::size_t> row_ = {0};
  std::vector<Neighbour> neighbours_;
  std::vector<std::array<Index, 2>> ends_;
};

namespace internal {

/// The faces in breadth-first order, from the first one of each component.
inline std::vector<Dual_graph::Index> breadth_first_order(const Dual_graph& graph) {
  std::vector<Dual_graph::Index> order;
  std::vector<bool> reached(graph.number_of_faces(), false);
  order.reserve(reached.size());
  const auto reach = [&](std::size_t face) {
    if (reached[face]) return;
    reached[face] = true;
    order.push_back(static_cast<Dual_graph::Index>(face));
  };
  for (std::size_t f = 0; f < reached.size(); ++f) {
    std::size_t next = order.size();
    for (reach(f); next < order.size(); ++next)
      for (const auto& neighbour : graph.neighbours(order[next])) reach(neighbour.face);
  }
  return order;
}

/// The faces on both sides of a mesh edge, that of `halfedge(edge, mesh)` first; null where the mesh ends.
template <class FaceListGraph>
auto faces_beside(typename boost::graph_traits<FaceListGraph>::edge_descriptor edge, const FaceListGraph& mesh) {
  const auto h = halfedge(edge, mesh);
  return std::make_pair(face(h, mesh), face(opposite(h, mesh), mesh));
}

}  // namespace internal

/// The dual graph of a mesh together with the mesh's own descriptors.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`: `Surface_mesh`, `Polyhedron_3` with or without ids, OpenMesh,
/// `Face_filtered_graph`, meshes with removed elements. Faces are numbered in the order of `faces(mesh)`, edges in the
/// order of `edges(mesh)`, border edges left out, until they are renumbered. Ids that the mesh may hold are not used.
template <class FaceListGraph>
class Mesh_dual_graph : public Dual_graph {
 public:
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  using edge_descriptor = typename boost::graph_traits<FaceListGraph>::edge_descriptor;

  /// The index of a descriptor that is not part of the graph.
  static constexpr Index none = std::numeric_limits<Index>::max();

  /// Reads the connectivity of the mesh; keeps no reference to it.
  /// \throws std::length_error if there are 2^32 - 1 faces or more, or as many halfedges
  /// Complexity: linear.
  explicit Mesh_dual_graph(const FaceListGraph& mesh) {
    internal::check_number(num_faces(mesh), "faces");
    internal::check_number(2 * std::size_t(num_edges(mesh)), "halfedges");
    const auto null_face = boost::graph_traits<FaceListGraph>::null_face();
    faces_.reserve(num_faces(mesh));
    index_.reserve(num_faces(mesh));
    for (const face_descriptor f : faces(mesh)) {
      index_.insert(f, static_cast<Index>(faces_.size()));
      faces_.push_back(f);
    }
    std::vector<std::array<Index, 2>> ends;
    ends.reserve(num_edges(mesh));
    edges_.reserve(num_edges(mesh));
    for (const edge_descriptor e : edges(mesh)) {
      const auto [f, g] = internal::faces_beside(e, mesh);
      if (f == null_face || g == null_face || f == g) continue;
      ends.push_back({index_[f], index_[g]});
      edges_.push_back(e);
    }
    static_cast<Dual_graph&>(*this) = Dual_graph(faces_.size(), std::move(ends));
  }

  /// Numbers faces and edges anew, so that neighbours have numbers that are close to each other whatever the order in
  /// the mesh: faces breadth-first from the first one of each component, edges by the lower one of their faces. What
  /// passes over a large graph then finds most of what it needs in the cache.
  /// \returns the former number of each edge
  /// Complexity: linear.
  std::vector<Index> renumber_along_surface() {
    const std::vector<Index> face_order = internal::breadth_first_order(*this);
    std::vector<Index> number(face_order.size());
    for (std::size_t i = 0; i < face_order.size(); ++i) number[face_order[i]] = static_cast<Index>(i);

    std::vector<std::array<Index, 2>> ends;
    std::vector<edge_descriptor> edges;
    std::vector<Index> edge_order;
    ends.reserve(edges_.size());
    edges.reserve(edges_.size());
    edge_order.reserve(edges_.size());
    for (const Index f : face_order)
      for (const auto& [g, e] : neighbours(f)) {
        if (number[g] < number[f]) continue;
        const auto [first, second] = faces_of(e);
        ends.push_back({number[first], number[second]});
        edges.push_back(edges_[e]);
        edge_order.push_back(e);
      }
    std::vector<face_descriptor> faces;
    faces.reserve(faces_.size());
    for (const Index f : face_order) {
      index_.insert(faces_[f], static_cast<Index>(faces.size()));
      faces.push_back(faces_[f]);
    }
    faces_ = std::move(faces);
    edges_ = std::move(edges);
    static_cast<Dual_graph&>(*this) = Dual_graph(faces_.size(), std::move(ends));
    return edge_order;
  }

  /// The face of the mesh that has a number.
  face_descriptor face(Index i) const { return faces_[i]; }
  /// All faces in the order of their numbers.
  const std::vector<face_descriptor>& face_descriptors() const { return faces_; }

  /// The mesh edge of an edge of the graph. Its first halfedge, `halfedge(edge(i), mesh)`, lies in `faces_of(i)[0]`.
  edge_descriptor edge(Index i) const { return edges_[i]; }
  /// All edges in the order of their numbers.
  const std::vector<edge_descriptor>& edge_descriptors() const { return edges_; }

  /// The number of a face, `none` if the mesh had no such face.
  Index index(face_descriptor f) const { return index_[f]; }

 private:
  std::vector<face_descriptor> faces_;
  std::vector<edge_descriptor> edges_;
  internal::Descriptor_index<face_descriptor> index_;
};

namespace internal {

/// Iterates over the arcs that leave a face.
class Arc_iterator
    : public boost::iterator_facade<Arc_iterator, Dual_graph::Arc, boost::forward_traversal_tag, Dual_graph::Arc> {
 public:
  Arc_iterator() = default;
  Arc_iterator(Dual_graph::Index source, const Dual_graph::Neighbour* neighbour)
      : source_(source), neighbour_(neighbour) {}

 private:
  friend class boost::iterator_core_access;
  Dual_graph::Arc dereference() const { return {source_, neighbour_->face, neighbour_->edge}; }
  void increment() { ++neighbour_; }
  bool equal(const Arc_iterator& other) const { return neighbour_ == other.neighbour_; }

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

template <class FaceListGraph>
struct graph_traits<RW_segmentation::Mesh_dual_graph<FaceListGraph>> : graph_traits<RW_segmentation::Dual_graph> {};

template <>
struct property_map<RW_segmentation::Dual_graph, vertex_index_t> {
  using type = typed_identity_property_map<RW_segmentation::Dual_graph::Index>;
  using const_type = type;
};

}  // namespace boost

#endif
