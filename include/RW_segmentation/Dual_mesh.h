// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_DUAL_MESH_H
#define RW_SEGMENTATION_DUAL_MESH_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/mesh/Face_corners.h>
#include <RW_segmentation/internal/mesh/Face_geometry.h>
#include <RW_segmentation/internal/mesh/Mesh_reading.h>
#include <RW_segmentation/internal/mesh/Mesh_stretch.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// A mesh as the walk sees it: the dual graph, measured. All stages compute on it and on plain arrays by face, edge or
/// vertex.
///
/// It never changes, and copies share what it holds. Everything is measured in the unit box: the mesh is moved to the
/// origin and scaled to a bounding box of diagonal 1, so that neither far, huge nor tiny coordinates lose digits.
///
/// Faces, edges and vertices are numbered from 0. Edges are those between two different faces; the mesh's border is none.
/// Walls are edges that no stage crosses: no seed distance, walk, merge or surface.
///
/// Memory: about 100 bytes a triangle.
class Dual_mesh {
 public:
  /// Numbers of faces, edges and vertices.
  using Index = Dual_graph::Index;
  /// The corners of a face: a range of numbers of vertices with `size()` and `operator[]`, counterclockwise from outside.
  using Corners = internal::Face_corners::Range;

  /// What a mesh is made from.
  struct Arrays {
    Dual_graph graph;                             ///< of the faces
    internal::Face_corners corners;               ///< of the faces
    std::vector<std::array<Index, 2>> edge_ends;  ///< by edge, in the direction of the first of its faces
    std::vector<Eigen::Vector3d> points;          ///< by vertex, finite
    std::vector<char> is_wall;                    ///< by edge; empty: no edge is
  };

  /// A mesh without faces.
  Dual_mesh() : Dual_mesh(Arrays()) {}

  /// \param points_in_box the unit box that the points lie in already; without it they are moved and scaled
  /// Complexity: linear.
  explicit Dual_mesh(Arrays arrays, const internal::Unit_box* points_in_box = nullptr);

  /// The faces and their neighbours, a graph of Boost.Graph.
  const Dual_graph& graph() const { return arrays_->graph; }
  /// Faces are numbered from 0 to this - 1.
  std::size_t number_of_faces() const { return graph().number_of_faces(); }
  /// Edges are numbered from 0 to this - 1.
  std::size_t number_of_edges() const { return graph().number_of_edges(); }
  /// Vertices are numbered from 0 to this - 1. Those without a face are not counted.
  std::size_t number_of_vertices() const { return points_->size(); }

  /// The vertices of a face.
  Corners corners(Index face) const { return arrays_->corners[face]; }
  /// The two vertices of an edge, in the direction of the first of its faces.
  const std::array<Index, 2>& ends(Index edge) const { return arrays_->edge_ends[edge]; }
  /// Where a vertex is.
  const Eigen::Vector3d& point(Index vertex) const { return (*points_)[vertex]; }
  /// By vertex.
  const std::vector<Eigen::Vector3d>& points() const { return *points_; }

  /// By face.
  const std::vector<double>& areas() const { return geometry_->area; }
  /// By edge.
  const std::vector<double>& edge_lengths() const { return geometry_->edge_length; }
  /// The mean of the corners of a face.
  Eigen::Vector3d centroid(Index face) const { return internal::centroid_of(*points_, corners(face)); }
  /// The outward normal of a face, of unit length; zero if it has no area. It is not stored but computed.
  Eigen::Vector3d normal(Index face) const;
  /// The normal of the shape that the mesh stands for, as `smoothed_shape()` sees it; the face's own otherwise.
  Eigen::Vector3d shape_normal(Index face) const { return shape_normals_ ? (*shape_normals_)[face] : normal(face); }
  /// Whether the normals of the shape are stored: 24 bytes a face.
  bool has_shape_normals() const { return shape_normals_ != nullptr; }
  /// The area of a face.
  double area(Index face) const { return geometry_->area[face]; }
  /// The length of an edge.
  double edge_length(Index edge) const { return geometry_->edge_length[edge]; }
  /// Of all faces; of the whole where this is a part of it.
  double total_area() const { return is_part_ ? area_of_whole_ : geometry_->total_area; }
  /// 0 without edges.
  double mean_edge_length() const { return geometry_->mean_edge_length; }
  /// The length R in which boundaries of regions are measured: the root of the total area, 1 for a mesh without area.
  double length_unit() const { return total_area() > 0 ? std::sqrt(total_area()) : 1; }
  /// Faces without area.
  std::size_t number_of_degenerate_faces() const { return geometry_->degenerate_faces; }

  /// Whether any edge is a wall.
  bool has_walls() const { return !is_wall_->empty(); }
  /// Whether no stage crosses an edge.
  bool is_wall(Index edge) const { return has_walls() && (*is_wall_)[edge]; }

  /// The length of 1 in the unit of the mesh's coordinates.
  double unit() const { return box_.unit; }
  /// The centre of the unit box in the mesh's coordinates.
  const Eigen::Vector3d& origin() const { return box_.origin; }
  /// By how much the rounding of coordinates may displace a point.
  double rounding() const { return box_.rounding; }

  /// This mesh with other normals of its shape.
  /// \param normals by face, of unit length or zero
  Dual_mesh with_shape_normals(std::vector<Eigen::Vector3d> normals) const;
  /// This mesh with the normals of the shape of another one that has as many faces; they are shared.
  Dual_mesh with_shape_normals_of(const Dual_mesh& other) const;

  /// This mesh with its vertices elsewhere.
  /// \param points by vertex, in the unit box, which stays what it is
  Dual_mesh with_points(std::vector<Eigen::Vector3d> points) const;

  /// This mesh with other walls.
  /// \param is_wall by edge; empty: no edge is
  Dual_mesh with_walls(std::vector<char> is_wall) const;

  /// This mesh as a part of a larger one, whose total area it then tells for its own: lengths that are fractions of
  /// `length_unit()` are those of the whole.
  /// \param area_of_whole in the unit box
  Dual_mesh as_part_of(double area_of_whole) const;

  /// A connected component as a mesh of its own, measured in a unit box of its own.
  /// \param component one of `internal::connected_stretches()`
  /// Complexity: linear in its size.
  Dual_mesh component(const internal::Mesh_stretch& component) const;

  /// Connected components that follow each other as a mesh of their own, in the unit box of this one.
  /// \param components a stretch of whole ones
  /// Complexity: linear in their size.
  Dual_mesh components_in_place(const internal::Mesh_stretch& components) const;

 private:
  Arrays arrays_of(const internal::Mesh_stretch& components) const;
  Dual_mesh with_shape_normals_of(const internal::Mesh_stretch& components, const Dual_mesh& whole) const;

  internal::Unit_box box_;
  bool is_part_ = false;
  double area_of_whole_ = 0;
  std::shared_ptr<const Arrays> arrays_;
  std::shared_ptr<const internal::Face_geometry> geometry_;
  std::shared_ptr<const std::vector<Eigen::Vector3d>> points_, shape_normals_;  // without the latter: the faces' own
  std::shared_ptr<const std::vector<char>> is_wall_;
};

namespace internal {

/// The place of a descriptor in a range.
template <class Range, class Descriptor>
std::size_t place_in(const Range& range, const Descriptor& descriptor) {
  return static_cast<std::size_t>(std::distance(range.begin(), std::find(range.begin(), range.end(), descriptor)));
}

/// The first vector that has a coordinate that is not finite; their number if there is none.
std::size_t first_not_finite(const std::vector<Eigen::Vector3d>& vectors);

/// What is thrown for coordinates that are not finite, of the vertex or the normal of the face at a place.
std::invalid_argument point_error(std::size_t place);
std::invalid_argument normal_error(std::size_t place, const Eigen::Vector3d& normal);

/// The faces' own normals.
std::vector<Eigen::Vector3d> own_normals(const Dual_mesh& mesh);

/// A mesh with the normals of its shape stored, for work that asks for each of them many times.
Dual_mesh with_stored_normals(const Dual_mesh& mesh);

/// A mesh in the unit box of another one.
/// \param arrays what it is made from, its points in that box
/// \param face by face, one of the other mesh: that one's `shape_normal()` is its own
Dual_mesh in_box_of(const Dual_mesh& other, Dual_mesh::Arrays arrays, const std::vector<Dual_mesh::Index>& face);

/// Divides vectors by their lengths; zero vectors stay zero.
void normalize(std::vector<Eigen::Vector3d>& vectors);

/// The points of vertices.
/// \throws std::invalid_argument if a coordinate is not finite, naming the vertex by its place in the order of
/// `vertices(mesh)`
template <class FaceListGraph, class NamedParameters, class VertexDescriptors>
std::vector<Eigen::Vector3d> read_points(const FaceListGraph& mesh, const VertexDescriptors& descriptors,
                                         const NamedParameters& np) {
  const auto map =
      CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_point),
                                         CGAL::get_const_property_map(CGAL::vertex_point, mesh));
  std::vector<Eigen::Vector3d> points;
  points.reserve(descriptors.size());
  for (const auto v : descriptors) {
    const auto& p = get(map, v);
    points.emplace_back(CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2]));
  }
  const std::size_t bad = first_not_finite(points);
  if (bad < points.size()) throw point_error(place_in(vertices(mesh), descriptors[bad]));
  return points;
}

}  // namespace internal

/// The dual mesh of a mesh together with the mesh's own descriptors: reads a map into an array, writes an array into a map.
///
/// Every function of the library that takes a mesh takes this in its place and does not read the mesh again, but for
/// `split_along_boundaries()`, which changes the mesh:
/// \code
/// const Dual_mesh_of dual(mesh);
/// const Dual_mesh_of shape = smoothed_shape(dual);
/// const Conductance conductance(shape, Dihedral_difference(shape));
/// \endcode
///
/// Numbers depend on the mesh's connectivity alone. Ids that the mesh may hold are not used.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`: `Surface_mesh`, `Polyhedron_3` with or without ids, OpenMesh,
/// `Face_filtered_graph`, meshes with removed elements
template <class FaceListGraph>
class Dual_mesh_of : public Dual_mesh {
 public:
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  using edge_descriptor = typename boost::graph_traits<FaceListGraph>::edge_descriptor;
  /// The type of the mesh.
  using Mesh = FaceListGraph;

  /// The number of a descriptor that is not part of the mesh.
  static constexpr Index none = std::numeric_limits<Index>::max();

  /// Reads the mesh.
  ///
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh, its faces oriented outward; it must outlive this and keep its faces and edges
  /// \param np `vertex_point_map` (default: that of the mesh), `edge_is_constrained_map` (readable map from
  /// `edge_descriptor` to `bool`, default: no edge is): the walls
  /// \throws std::invalid_argument if a coordinate is not finite (names the vertex)
  /// \throws std::length_error if there are 2^32 - 1 faces, halfedges or vertices, or more
  /// Complexity: linear.
  template <class NamedParameters = CGAL::parameters::Default_named_parameters>
  explicit Dual_mesh_of(const FaceListGraph& mesh, const NamedParameters& np = CGAL::parameters::default_values())
      : Dual_mesh_of(mesh, np, std::make_shared<internal::Descriptors<FaceListGraph>>()) {}

  /// Reads the graph and the walls alone, for stages that measure nothing: there are no corners, points or normals.
  /// \param np as above
  template <class NamedParameters = CGAL::parameters::Default_named_parameters>
  static Dual_mesh_of without_points(const FaceListGraph& mesh,
                                     const NamedParameters& np = CGAL::parameters::default_values()) {
    const auto descriptors = std::make_shared<internal::Descriptors<FaceListGraph>>();
    Arrays arrays = arrays_of(internal::Mesh_reading<FaceListGraph>(mesh, false), mesh, np, *descriptors);
    return {Dual_mesh(std::move(arrays)), mesh, descriptors};
  }

  /// A dual mesh with the same graph as another one, and that one's descriptors.
  Dual_mesh_of(Dual_mesh mesh, const Dual_mesh_of& other)
      : Dual_mesh(std::move(mesh)), mesh_(other.mesh_), descriptors_(other.descriptors_) {}

  /// A connected component as a mesh of its own, as above.
  Dual_mesh_of component(const internal::Mesh_stretch& component) const {
    const auto descriptors = std::make_shared<Descriptors>();
    const auto stretch = [](const auto& of_all, Index first, Index count) {
      const auto begin = of_all.begin() + static_cast<std::ptrdiff_t>(first);
      return std::decay_t<decltype(of_all)>(begin, begin + static_cast<std::ptrdiff_t>(count));
    };
    descriptors->face_descriptors = stretch(face_descriptors(), component.first_face, component.faces);
    descriptors->edge_descriptors = stretch(edge_descriptors(), component.first_edge, component.edges);
    descriptors->index = descriptors_->index;
    descriptors->first_face = descriptors_->first_face + component.first_face;
    return {Dual_mesh::component(component), *mesh_, descriptors};
  }

  /// The mesh that was read.
  const FaceListGraph& mesh() const { return *mesh_; }

  /// The face of the mesh that has a number.
  face_descriptor face(Index i) const { return descriptors_->face_descriptors[i]; }
  /// By number.
  const std::vector<face_descriptor>& face_descriptors() const { return descriptors_->face_descriptors; }
  /// The mesh edge that has a number. Its first halfedge, `halfedge(edge(i), mesh)`, lies in `graph().faces_of(i)[0]`.
  edge_descriptor edge(Index i) const { return descriptors_->edge_descriptors[i]; }
  /// By number.
  const std::vector<edge_descriptor>& edge_descriptors() const { return descriptors_->edge_descriptors; }
  /// The number of a face, `none` if the mesh has no such face.
  Index index(face_descriptor f) const {
    const Index number = (*descriptors_->index)[f];  // of the whole mesh; less than the first one wraps round
    const auto place = static_cast<Index>(number - descriptors_->first_face);
    return number != none && place < number_of_faces() ? place : none;
  }
  /// The place of a face in the order of `faces(mesh)`, by which errors name it.
  /// Complexity: linear.
  Index place(Index face) const {
    return static_cast<Index>(internal::place_in(faces(mesh()), face_descriptors()[face]));
  }

  /// A map of faces as an array, each value converted by a function.
  /// \param convert from the map's value to the array's
  template <class FaceMap, class Convert>
  auto read_faces(const FaceMap& map, const Convert& convert) const {
    static_assert(internal::is_readable_map<FaceMap, face_descriptor>,
                  "A readable property map from the mesh's face_descriptor is needed here.");
    std::vector<std::decay_t<decltype(convert(get(map, face(0))))>> values;
    values.reserve(number_of_faces());
    for (const face_descriptor f : face_descriptors()) values.push_back(convert(get(map, f)));
    return values;
  }

  /// A map of segment ids as an array.
  template <class SegmentIdMap>
  std::vector<std::size_t> read_segments(const SegmentIdMap& segment_ids) const {
    static_assert(internal::is_readable_map<SegmentIdMap, face_descriptor>,
                  "segment_ids must be a readable property map from the mesh's face_descriptor to an integer.");
    return read_faces(segment_ids, [](const auto& id) { return static_cast<std::size_t>(id); });
  }

  /// A map of vectors as unit vectors; zero vectors stay zero.
  /// \throws std::invalid_argument if a vector is not finite, naming the face by its place
  template <class FaceNormalMap>
  std::vector<Eigen::Vector3d> read_normals(const FaceNormalMap& normals) const {
    std::vector<Eigen::Vector3d> vectors = read_faces(normals, [](const auto& n) {
      return Eigen::Vector3d(CGAL::to_double(n[0]), CGAL::to_double(n[1]), CGAL::to_double(n[2]));
    });
    const std::size_t bad = internal::first_not_finite(vectors);
    if (bad < vectors.size()) throw internal::normal_error(place(static_cast<Index>(bad)), vectors[bad]);
    internal::normalize(vectors);
    return vectors;
  }

  /// A map of edges, such as a difference, as an array; each edge is asked once.
  /// \param argument the name of the map in errors
  /// \throws std::invalid_argument if a value is negative or NaN, naming the edge by the places of its faces
  template <class EdgeMap>
  std::vector<double> read_edges(const EdgeMap& map, const char* argument) const {
    static_assert(internal::is_readable_map<EdgeMap, edge_descriptor>,
                  "A readable property map from the mesh's edge_descriptor to double is needed here.");
    static_assert(std::is_convertible_v<typename boost::property_traits<EdgeMap>::value_type, double>,
                  "The values of this edge map must be convertible to double.");
    std::vector<double> values;
    values.reserve(number_of_edges());
    for (const edge_descriptor e : edge_descriptors()) values.push_back(static_cast<double>(get(map, e)));
    check_edges(values, argument);
    return values;
  }

  /// \throws std::invalid_argument if a value by edge is negative or NaN, naming the edge by the places of its faces
  void check_edges(const std::vector<double>& values, const char* argument) const {
    for (std::size_t e = 0; e < values.size(); ++e) {
      if (values[e] >= 0) continue;
      const auto& sides = graph().faces_of(static_cast<Index>(e));
      const auto [first, second] = std::minmax({place(sides[0]), place(sides[1])});
      const std::string where =
          " on the edge between faces " + std::to_string(first) + " and " + std::to_string(second);
      throw internal::argument_error((argument + where).c_str(), values[e], "a number >= 0");
    }
  }

  /// Writes an array by face into a map.
  template <class FaceMap, class Value>
  void write_faces(const std::vector<Value>& values, FaceMap map) const {
    for (std::size_t f = 0; f < values.size(); ++f) put(map, descriptors_->face_descriptors[f], values[f]);
  }

 private:
  using Descriptors = internal::Descriptors<FaceListGraph>;

  Dual_mesh_of(Dual_mesh dual, const FaceListGraph& mesh, std::shared_ptr<const Descriptors> descriptors)
      : Dual_mesh(std::move(dual)), mesh_(&mesh), descriptors_(std::move(descriptors)) {}

  template <class NamedParameters>
  Dual_mesh_of(const FaceListGraph& mesh, const NamedParameters& np, const std::shared_ptr<Descriptors>& descriptors)
      : Dual_mesh_of(Dual_mesh(arrays_of(internal::Mesh_reading<FaceListGraph>(mesh, true), mesh, np, *descriptors)),
                     mesh, descriptors) {}

  template <class NamedParameters>
  static Arrays arrays_of(internal::Mesh_reading<FaceListGraph> reading, const FaceListGraph& mesh,
                          const NamedParameters& np, Descriptors& descriptors) {
    descriptors = std::move(reading.descriptors);
    Arrays arrays;
    arrays.graph = {descriptors.face_descriptors.size(), std::move(reading.sides)};
    arrays.corners = std::move(reading.corners);
    arrays.edge_ends = std::move(reading.edge_ends);
    arrays.points = internal::read_points(mesh, reading.vertex_descriptors, np);
    arrays.is_wall = walls_of(np, descriptors);
    return arrays;
  }

  /// By edge; empty if no edge is one.
  template <class NamedParameters>
  static std::vector<char> walls_of(const NamedParameters& np, const Descriptors& descriptors) {
    std::vector<char> is_wall;
    if constexpr (internal::has_parameter<NamedParameters, internal::Edge_is_constrained>) {
      const auto walls = CGAL::parameters::get_parameter(np, CGAL::internal_np::edge_is_constrained);
      is_wall.reserve(descriptors.edge_descriptors.size());
      bool is_any = false;
      for (const edge_descriptor e : descriptors.edge_descriptors) {
        is_wall.push_back(static_cast<bool>(get(walls, e)));
        is_any |= is_wall.back() != 0;
      }
      if (!is_any) is_wall.clear();
    }
    return is_wall;
  }

  const FaceListGraph* mesh_;
  std::shared_ptr<const Descriptors> descriptors_;
};

namespace internal {

/// What a function that takes a mesh begins with: reads it.
template <class FaceListGraph, class NamedParameters>
Dual_mesh_of<FaceListGraph> dual_mesh(const FaceListGraph& mesh, const NamedParameters& np) {
  return Dual_mesh_of<FaceListGraph>(mesh, np);
}

/// What has been read already is taken as it is.
template <class FaceListGraph, class NamedParameters>
const Dual_mesh_of<FaceListGraph>& dual_mesh(const Dual_mesh_of<FaceListGraph>& mesh, const NamedParameters&) {
  static_assert(!has_parameter<NamedParameters, Vertex_point> && !has_parameter<NamedParameters, Edge_is_constrained>,
                "A Dual_mesh_of has its points and constrained edges: give them to its constructor.");
  return mesh;
}

/// What a function that measures nothing begins with.
template <class FaceListGraph, class NamedParameters>
Dual_mesh_of<FaceListGraph> dual_mesh_without_points(const FaceListGraph& mesh, const NamedParameters& np) {
  return Dual_mesh_of<FaceListGraph>::without_points(mesh, np);
}
template <class FaceListGraph, class NamedParameters>
const Dual_mesh_of<FaceListGraph>& dual_mesh_without_points(const Dual_mesh_of<FaceListGraph>& mesh,
                                                            const NamedParameters& np) {
  return dual_mesh(mesh, np);
}

/// The type of mesh that a function was given, or that was read into the `Dual_mesh_of` that it was given.
template <class FaceListGraph>
struct Mesh_type {
  using type = FaceListGraph;
};
template <class FaceListGraph>
struct Mesh_type<Dual_mesh_of<FaceListGraph>> {
  using type = FaceListGraph;
};

}  // namespace internal
}  // namespace RW_segmentation

namespace boost {

/// A function of the library knows the descriptors of the mesh that was read.
template <class FaceListGraph>
struct graph_traits<RW_segmentation::Dual_mesh_of<FaceListGraph>> : graph_traits<FaceListGraph> {};

}  // namespace boost

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Dual_mesh.h>
#endif

#endif
