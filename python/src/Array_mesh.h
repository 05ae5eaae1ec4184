// SPDX-License-Identifier: MIT

#ifndef RW_PYTHON_ARRAY_MESH_H
#define RW_PYTHON_ARRAY_MESH_H

// A halfedge mesh over arrays of the user's: a model of CGAL's FaceListGraph and MutableFaceGraph. CGAL's own
// (Surface_mesh, Polyhedron_3) are under the GPL, this needs its LGPL parts alone.

#include <CGAL/Iterator_range.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/tags.h>

#include <boost/functional/hash.hpp>
#include <boost/graph/graph_traits.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
#include <variant>
#include <vector>

namespace rw_python {

using Index = std::uint32_t;
constexpr Index none = std::numeric_limits<Index>::max();

/// A vertex, halfedge, edge or face by its number.
template <int Kind>
class Descriptor {
 public:
  constexpr Descriptor() = default;
  constexpr explicit Descriptor(std::size_t number) : number_(static_cast<Index>(number)) {}
  constexpr Index idx() const { return number_; }

  friend bool operator==(Descriptor a, Descriptor b) { return a.number_ == b.number_; }
  friend bool operator!=(Descriptor a, Descriptor b) { return a.number_ != b.number_; }
  friend bool operator<(Descriptor a, Descriptor b) { return a.number_ < b.number_; }
  friend std::size_t hash_value(Descriptor d) { return d.number_; }
  friend std::ostream& operator<<(std::ostream& out, Descriptor d) { return out << d.number_; }

 private:
  Index number_ = none;
};

using Vertex = Descriptor<0>;
using Halfedge = Descriptor<1>;
using Edge = Descriptor<2>;
using Face = Descriptor<3>;

/// Passes over the numbers 0, 1, ...
template <class D>
class Descriptor_iterator
    : public boost::iterator_facade<Descriptor_iterator<D>, D, boost::random_access_traversal_tag, D> {
 public:
  Descriptor_iterator() = default;
  explicit Descriptor_iterator(std::size_t number) : number_(number) {}

 private:
  friend class boost::iterator_core_access;
  D dereference() const { return D(number_); }
  bool equal(const Descriptor_iterator& other) const { return number_ == other.number_; }
  void increment() { ++number_; }
  void decrement() { --number_; }
  void advance(std::ptrdiff_t steps) { number_ += static_cast<std::size_t>(steps); }
  std::ptrdiff_t distance_to(const Descriptor_iterator& other) const {
    return static_cast<std::ptrdiff_t>(other.number_ - number_);
  }
  std::size_t number_ = 0;
};

using Point = CGAL::Simple_cartesian<double>::Point_3;

/// The coordinates of vertices where the user holds them: one row of three after the other.
struct Coordinates {
  std::variant<const float*, const double*> rows;
  std::size_t number = 0;

  double operator()(std::size_t row, std::size_t column) const {
    return std::visit([&](const auto* values) { return static_cast<double>(values[3 * row + column]); }, rows);
  }
  Point point(std::size_t row) const { return {(*this)(row, 0), (*this)(row, 1), (*this)(row, 2)}; }
};

/// The halfedges of a mesh by arrays. Vertices have the user's numbers; those that take the place of a vertex where
/// several fans of faces meet, and new ones, follow.
///
/// The halfedges of edge e are 2 e and 2 e + 1, the first of which has a face. Memory: 40 bytes a triangle; coordinates
/// stay where the user holds them.
class Array_mesh {
 public:
  Coordinates coordinates;                ///< of the user's vertices; they must outlive the mesh
  std::vector<Index> copied_vertex;       ///< the user's vertex of each that follows the user's
  std::vector<Point> added_points;        ///< of vertices that follow these
  std::vector<Index> next, target, face;  ///< by halfedge; the border has no face
  std::vector<Index> halfedge_of_face;
  std::vector<Index> halfedge_of_vertex;  ///< one that ends there; filled by `find_halfedges_of_vertices()`

  std::size_t number_of_vertices() const { return coordinates.number + copied_vertex.size() + added_points.size(); }
  std::size_t number_of_halfedges() const { return next.size(); }
  std::size_t number_of_faces() const { return halfedge_of_face.size(); }

  Index source(Index halfedge) const { return target[halfedge ^ 1]; }
  Index previous(Index halfedge) const {
    Index h = halfedge;
    while (next[h] != halfedge) h = next[h];
    return h;
  }

  /// The user's vertex that a vertex stands for, `none` for one that was added.
  Index vertex_of_user(Index vertex) const {
    if (vertex < coordinates.number) return vertex;
    const std::size_t copy = vertex - coordinates.number;
    return copy < copied_vertex.size() ? copied_vertex[copy] : none;
  }
  Point point(Index vertex) const {
    const Index known = vertex_of_user(vertex);
    return known != none ? coordinates.point(known) : added_points[vertex - coordinates.number - copied_vertex.size()];
  }

  /// What changes a mesh asks for.
  void find_halfedges_of_vertices() {
    halfedge_of_vertex.assign(number_of_vertices(), none);
    for (Index h = 0; h < number_of_halfedges(); ++h) halfedge_of_vertex[target[h]] = h;
  }
};

/// Where vertices are, a property map. Points are written to added vertices alone.
struct Point_map {
  using key_type = Vertex;
  using value_type = Point;
  using reference = Point;
  using category = boost::read_write_property_map_tag;

  Array_mesh* mesh = nullptr;

  friend Point get(const Point_map& map, Vertex v) { return map.mesh->point(v.idx()); }
  friend void put(const Point_map& map, Vertex v, const Point& p) {
    map.mesh->added_points[v.idx() - map.mesh->coordinates.number - map.mesh->copied_vertex.size()] = p;
  }
};

/// A property map over values in the order of the faces or edges.
template <class D, class Value>
struct Value_map {
  using key_type = D;
  using value_type = Value;
  using reference = Value;
  using category = boost::read_write_property_map_tag;

  std::vector<Value>* values = nullptr;

  friend Value get(const Value_map& map, D d) { return (*map.values)[d.idx()]; }
  friend void put(const Value_map& map, D d, const Value& value) {
    if (d.idx() >= map.values->size()) map.values->resize(d.idx() + 1);
    (*map.values)[d.idx()] = value;
  }
};

template <class D, class Value>
Value_map<D, Value> map_over(std::vector<Value>& values) {
  return {&values};
}

// The functions of CGAL's HalfedgeListGraph and FaceListGraph.

template <class D>
CGAL::Iterator_range<Descriptor_iterator<D>> range_of(std::size_t number) {
  return {Descriptor_iterator<D>(0), Descriptor_iterator<D>(number)};
}
inline auto vertices(const Array_mesh& mesh) { return range_of<Vertex>(mesh.number_of_vertices()); }
inline auto halfedges(const Array_mesh& mesh) { return range_of<Halfedge>(mesh.number_of_halfedges()); }
inline auto edges(const Array_mesh& mesh) { return range_of<Edge>(mesh.number_of_halfedges() / 2); }
inline auto faces(const Array_mesh& mesh) { return range_of<Face>(mesh.number_of_faces()); }
inline std::size_t num_vertices(const Array_mesh& mesh) { return mesh.number_of_vertices(); }
inline std::size_t num_halfedges(const Array_mesh& mesh) { return mesh.number_of_halfedges(); }
inline std::size_t num_edges(const Array_mesh& mesh) { return mesh.number_of_halfedges() / 2; }
inline std::size_t num_faces(const Array_mesh& mesh) { return mesh.number_of_faces(); }

inline Halfedge halfedge(Edge e, const Array_mesh&) { return Halfedge(2 * std::size_t(e.idx())); }
inline Halfedge halfedge(Face f, const Array_mesh& mesh) { return Halfedge(mesh.halfedge_of_face[f.idx()]); }
inline Halfedge halfedge(Vertex v, const Array_mesh& mesh) { return Halfedge(mesh.halfedge_of_vertex[v.idx()]); }
inline Halfedge opposite(Halfedge h, const Array_mesh&) { return Halfedge(h.idx() ^ 1); }
inline Halfedge next(Halfedge h, const Array_mesh& mesh) { return Halfedge(mesh.next[h.idx()]); }
inline Halfedge prev(Halfedge h, const Array_mesh& mesh) { return Halfedge(mesh.previous(h.idx())); }
inline Vertex target(Halfedge h, const Array_mesh& mesh) { return Vertex(mesh.target[h.idx()]); }
inline Vertex source(Halfedge h, const Array_mesh& mesh) { return Vertex(mesh.source(h.idx())); }
inline Edge edge(Halfedge h, const Array_mesh&) { return Edge(h.idx() / 2); }
inline Face face(Halfedge h, const Array_mesh& mesh) { return Face(mesh.face[h.idx()]); }
inline Vertex source(Edge e, const Array_mesh& mesh) { return source(halfedge(e, mesh), mesh); }
inline Vertex target(Edge e, const Array_mesh& mesh) { return target(halfedge(e, mesh), mesh); }

// And those of MutableFaceGraph that splitting edges and faces needs.

inline Vertex add_vertex(Array_mesh& mesh) {
  mesh.added_points.emplace_back();
  mesh.halfedge_of_vertex.push_back(none);
  return Vertex(mesh.number_of_vertices() - 1);
}
inline Edge add_edge(Array_mesh& mesh) {
  for (auto* values : {&mesh.next, &mesh.target, &mesh.face}) values->resize(values->size() + 2, none);
  return Edge(mesh.number_of_halfedges() / 2 - 1);
}
inline Face add_face(Array_mesh& mesh) {
  mesh.halfedge_of_face.push_back(none);
  return Face(mesh.number_of_faces() - 1);
}
inline void set_next(Halfedge h, Halfedge next, Array_mesh& mesh) { mesh.next[h.idx()] = next.idx(); }
inline void set_target(Halfedge h, Vertex v, Array_mesh& mesh) { mesh.target[h.idx()] = v.idx(); }
inline void set_face(Halfedge h, Face f, Array_mesh& mesh) { mesh.face[h.idx()] = f.idx(); }
inline void set_halfedge(Vertex v, Halfedge h, Array_mesh& mesh) { mesh.halfedge_of_vertex[v.idx()] = h.idx(); }
inline void set_halfedge(Face f, Halfedge h, Array_mesh& mesh) { mesh.halfedge_of_face[f.idx()] = h.idx(); }
inline void reserve(Array_mesh& mesh, std::size_t vertices, std::size_t edges, std::size_t faces) {
  mesh.added_points.reserve(vertices - mesh.coordinates.number - mesh.copied_vertex.size());
  mesh.halfedge_of_vertex.reserve(vertices);
  for (auto* values : {&mesh.next, &mesh.target, &mesh.face}) values->reserve(2 * edges);
  mesh.halfedge_of_face.reserve(faces);
}

inline Point_map get(CGAL::vertex_point_t, Array_mesh& mesh) { return {&mesh}; }
/// CGAL asks for the points of a mesh that may not be changed by another map; this one is read alone then.
inline Point_map get(CGAL::vertex_point_t, const Array_mesh& mesh) { return {const_cast<Array_mesh*>(&mesh)}; }

}  // namespace rw_python

namespace boost {

template <>
struct graph_traits<rw_python::Array_mesh> {
  struct traversal_category : virtual bidirectional_graph_tag,
                              virtual vertex_list_graph_tag,
                              virtual edge_list_graph_tag {};
  using directed_category = undirected_tag;
  using edge_parallel_category = disallow_parallel_edge_tag;
  using vertex_descriptor = rw_python::Vertex;
  using halfedge_descriptor = rw_python::Halfedge;
  using edge_descriptor = rw_python::Edge;
  using face_descriptor = rw_python::Face;
  using vertex_iterator = rw_python::Descriptor_iterator<vertex_descriptor>;
  using halfedge_iterator = rw_python::Descriptor_iterator<halfedge_descriptor>;
  using edge_iterator = rw_python::Descriptor_iterator<edge_descriptor>;
  using face_iterator = rw_python::Descriptor_iterator<face_descriptor>;
  using vertices_size_type = std::size_t;
  using halfedges_size_type = std::size_t;
  using edges_size_type = std::size_t;
  using faces_size_type = std::size_t;
  using degree_size_type = std::size_t;
  static vertex_descriptor null_vertex() { return {}; }
  static halfedge_descriptor null_halfedge() { return {}; }
  static face_descriptor null_face() { return {}; }
};

template <>
struct property_map<rw_python::Array_mesh, CGAL::vertex_point_t> {
  using type = rw_python::Point_map;
  using const_type = rw_python::Point_map;
};

}  // namespace boost

namespace CGAL {

template <>
struct graph_has_property<rw_python::Array_mesh, CGAL::vertex_point_t> : CGAL::Tag_true {};

}  // namespace CGAL

#endif
