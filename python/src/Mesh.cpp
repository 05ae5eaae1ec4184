// SPDX-License-Identifier: MIT

#include "Mesh.h"

#include "definitions.h"
#include "without_lock.h"

#include <RW_segmentation/internal/mesh/closest_face.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace rw_python {
namespace {

Coordinates coordinates_of(const Mesh::Any_array& vertices) {
  if (vertices.ndim() != 2 || vertices.shape(1) != 3) throw std::invalid_argument("vertices must be of shape (n, 3)");
  Coordinates coordinates;
  coordinates.number = vertices.shape(0);
  if (vertices.dtype() == nb::dtype<double>())
    coordinates.rows = static_cast<const double*>(vertices.data());
  else if (vertices.dtype() == nb::dtype<float>())
    coordinates.rows = static_cast<const float*>(vertices.data());
  else
    throw std::invalid_argument("vertices must be float32 or float64");
  return coordinates;
}

Polygons polygons_of(const Mesh::Any_array& corners, const std::optional<Integers>& offsets, std::size_t degree) {
  if (corners.ndim() != 1) throw std::invalid_argument("corners must be in one row");
  Polygons polygons;
  polygons.number_of_corners = corners.shape(0);
  polygons.degree = degree;
  if (offsets) {
    if (offsets->shape(0) == 0) throw std::invalid_argument("offsets must begin with 0");
    polygons.offsets = offsets->data();
    polygons.number_of_faces = offsets->shape(0) - 1;
  } else {
    polygons.number_of_faces = degree == 0 ? 0 : corners.shape(0) / degree;
  }
  if (corners.dtype() == nb::dtype<std::int32_t>())
    polygons.corners = static_cast<const std::int32_t*>(corners.data());
  else if (corners.dtype() == nb::dtype<std::int64_t>())
    polygons.corners = static_cast<const std::int64_t*>(corners.data());
  else if (corners.dtype() == nb::dtype<std::uint32_t>())
    polygons.corners = static_cast<const std::uint32_t*>(corners.data());
  else if (corners.dtype() == nb::dtype<std::uint64_t>())
    polygons.corners = static_cast<const std::uint64_t*>(corners.data());
  else
    throw std::invalid_argument("faces must be integers of 32 or 64 bits");
  return polygons;
}

using Ends = std::pair<Point, Point>;

/// The edges of a mesh by the places of their ends: repairs join vertices and take them apart, but move none.
class Edges_by_place {
 public:
  explicit Edges_by_place(const Array_mesh& mesh) {
    edges_.reserve(num_edges(mesh));
    for (const Edge e : edges(mesh))
      edges_.emplace_back(std::minmax({mesh.point(source(e, mesh).idx()), mesh.point(target(e, mesh).idx())}), e);
    std::sort(edges_.begin(), edges_.end());
  }

  /// Calls a function with each edge between two places; there are several where surfaces touch.
  /// \returns whether there is any
  template <class Visit>
  bool between(const Point& p, const Point& q, const Visit& visit) const {
    const Ends ends = std::minmax({p, q});
    auto entry = std::lower_bound(edges_.begin(), edges_.end(), ends,
                                  [](const auto& known, const Ends& wanted) { return known.first < wanted; });
    const bool is_any = entry != edges_.end() && entry->first == ends;
    for (; entry != edges_.end() && entry->first == ends; ++entry) visit(entry->second);
    return is_any;
  }

 private:
  std::vector<std::pair<Ends, Edge>> edges_;
};

/// The normal of a face, twice as long as its area in squares of `unit`.
CGAL::Simple_cartesian<double>::Vector_3 normal_of_twice_the_area(const Array_mesh& mesh, Face f, double unit) {
  const Index first = mesh.halfedge_of_face[f.idx()];
  const Point apex = mesh.point(mesh.source(first));
  CGAL::Simple_cartesian<double>::Vector_3 normal = CGAL::NULL_VECTOR;
  Index h = first;
  do {
    normal = normal + CGAL::cross_product((mesh.point(mesh.source(h)) - apex) / unit,
                                          (mesh.point(mesh.target[h]) - apex) / unit);
    h = mesh.next[h];
  } while (h != first);
  return normal;
}

/// The largest side of the box around a mesh.
double extent_of(const Array_mesh& mesh) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Index v : mesh.target) {
    const Point p = mesh.point(v);
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[static_cast<int>(i)]);
      high[i] = std::max(high[i], p[static_cast<int>(i)]);
    }
  }
  return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

/// The edges over which the normal turns by more than an angle, as pairs of vertices.
Table<std::int64_t> sharp_edges(const Mesh& mesh, double degrees) {
  if (!(degrees > 0 && degrees < 180)) throw std::invalid_argument("the angle must be between 0 and 180 degrees");
  constexpr double degree = 3.14159265358979323846 / 180;
  const Array_mesh& halfedges = mesh.halfedges();
  const double extent = extent_of(halfedges);
  std::vector<std::int64_t> pairs;
  if (extent > 0) {
    for (const Edge e : mesh.interior_edges()) {
      const Halfedge h = halfedge(e, halfedges);
      const auto a = normal_of_twice_the_area(halfedges, face(h, halfedges), extent);
      const auto b = normal_of_twice_the_area(halfedges, face(opposite(h, halfedges), halfedges), extent);
      const double sine = std::sqrt(CGAL::cross_product(a, b).squared_length()), cosine = a * b;
      if (!(std::atan2(sine, cosine) > degrees * degree)) continue;
      pairs.push_back(halfedges.vertex_of_user(source(h, halfedges).idx()));
      pairs.push_back(halfedges.vertex_of_user(target(h, halfedges).idx()));
    }
  }
  return table_of(std::move(pairs), 2);
}

/// The faces on both sides of each interior edge, and its two vertices.
nb::tuple interior_edges(const Mesh& mesh) {
  const Array_mesh& halfedges = mesh.halfedges();
  const std::vector<std::int64_t> user_face = mesh.user_faces();
  std::vector<std::int64_t> faces, vertices;
  for (const Edge e : mesh.interior_edges()) {
    const Halfedge h = halfedge(e, halfedges);
    for (const Halfedge side : {h, opposite(h, halfedges)}) {
      const Index f = face(side, halfedges).idx();
      faces.push_back(user_face.empty() ? f : user_face[f]);
    }
    vertices.push_back(halfedges.vertex_of_user(source(h, halfedges).idx()));
    vertices.push_back(halfedges.vertex_of_user(target(h, halfedges).idx()));
  }
  return nb::make_tuple(table_of(std::move(faces), 2), table_of(std::move(vertices), 2));
}

}  // namespace

Mesh::Mesh(Any_array vertices, Any_array corners, std::optional<Integers> offsets, std::size_t degree, bool is_repaired)
    : vertices_(std::move(vertices)), corners_(std::move(corners)), offsets_(std::move(offsets)) {
  const Coordinates coordinates = coordinates_of(vertices_);
  polygons_ = polygons_of(corners_, offsets_, degree);
  const nb::gil_scoped_release release;
  read_ = read_mesh(coordinates, polygons_, is_repaired);
  if (!read_.mesh_face.empty()) find_closest_of_left_out();
}

std::vector<std::int64_t> Mesh::user_faces() const {
  if (read_.mesh_face.empty()) return {};
  std::vector<std::int64_t> result(halfedges().number_of_faces());
  for (std::size_t f = 0; f < read_.mesh_face.size(); ++f)
    if (read_.mesh_face[f] != none) result[read_.mesh_face[f]] = static_cast<std::int64_t>(f);
  return result;
}

Face Mesh::face(std::int64_t number, const std::string& role) const {
  if (number < 0 || static_cast<std::size_t>(number) >= number_of_faces())
    throw std::invalid_argument(role + " " + std::to_string(number) + " is not a face of the mesh, which has " +
                                std::to_string(number_of_faces()));
  const auto f = static_cast<std::size_t>(number);
  const std::size_t place = read_.mesh_face.empty() ? f : read_.mesh_face[f];
  if (place == none) throw std::invalid_argument(role + " " + std::to_string(number) + " was left out of the mesh");
  return Face(place);
}

std::size_t Mesh::corner(std::int64_t face, std::size_t place) const {
  const auto f = static_cast<std::size_t>(face);
  const std::size_t begin = polygons_.offsets ? static_cast<std::size_t>(polygons_.offsets[f]) : f * polygons_.degree;
  return std::visit([&](const auto* corners) { return static_cast<std::size_t>(corners[begin + place]); },
                    polygons_.corners);
}

std::vector<Edge> Mesh::interior_edges() const {
  std::vector<Edge> interior;
  const Array_mesh& mesh = halfedges();
  interior.reserve(num_edges(mesh));
  for (const Edge e : edges(mesh)) {
    const Index h = 2 * e.idx();
    if (mesh.face[h + 1] != none && mesh.face[h] != mesh.face[h + 1]) interior.push_back(e);
  }
  return interior;
}

std::vector<char> Mesh::walls(const std::optional<Pairs>& pairs) const {
  if (!pairs || pairs->shape(0) == 0) return {};
  std::vector<char> is_wall(num_edges(halfedges()), false);
  const Edges_by_place known(halfedges());
  const Coordinates& coordinates = halfedges().coordinates;
  for (std::size_t i = 0; i < pairs->shape(0); ++i) {
    const std::array<std::int64_t, 2> ends = {(*pairs)(i, 0), (*pairs)(i, 1)};
    const auto fail = [&](const std::string& cause) {
      throw std::invalid_argument("wall " + std::to_string(i) + ": " + cause);
    };
    for (const std::int64_t v : ends)
      if (v < 0 || static_cast<std::size_t>(v) >= coordinates.number)
        fail("there is no vertex " + std::to_string(v) + ", but " + std::to_string(coordinates.number) +
             ", the first is vertex 0");
    const bool is_any =
        known.between(coordinates.point(static_cast<std::size_t>(ends[0])),
                      coordinates.point(static_cast<std::size_t>(ends[1])), [&](Edge e) { is_wall[e.idx()] = true; });
    if (!is_any)
      fail("no edge of the mesh joins vertex " + std::to_string(ends[0]) + " and vertex " + std::to_string(ends[1]));
  }
  return is_wall;
}

Dual Mesh::dual(const std::optional<Pairs>& pairs) const {
  std::vector<char> is_wall = walls(pairs);
  if (is_wall.empty()) return Dual(halfedges());
  return Dual(halfedges(), CGAL::parameters::edge_is_constrained_map(map_over<Edge>(is_wall)));
}

std::vector<double> Mesh::by_edge(const Numbers& values, const char* argument) const {
  const std::vector<Edge> interior = interior_edges();
  if (values.shape(0) != interior.size())
    throw std::invalid_argument(std::string(argument) + " has " + std::to_string(values.shape(0)) +
                                " values, but the mesh " + std::to_string(interior.size()) + " interior edges");
  std::vector<double> result(num_edges(halfedges()), 0.);
  for (std::size_t i = 0; i < interior.size(); ++i) result[interior[i].idx()] = values(i);
  return result;
}

void Mesh::find_closest_of_left_out() {
  if (halfedges().number_of_faces() == 0) throw std::invalid_argument("no face has three different corners");
  speaker_ = read_.mesh_face;
  const Dual dual(halfedges());
  const RW::internal::Triangle_tree tree(dual);
  std::visit(
      [&](const auto* corners) {
        for (std::size_t f = 0; f < speaker_.size(); ++f) {
          if (speaker_[f] != none) continue;
          const std::size_t begin =
              polygons_.offsets ? static_cast<std::size_t>(polygons_.offsets[f]) : f * polygons_.degree;
          const std::size_t end =
              polygons_.offsets ? static_cast<std::size_t>(polygons_.offsets[f + 1]) : begin + polygons_.degree;
          Eigen::Vector3d middle = Eigen::Vector3d::Zero();
          for (std::size_t c = begin; c < end; ++c) {
            const Point p = halfedges().coordinates.point(static_cast<std::size_t>(corners[c]));
            middle += Eigen::Vector3d(p.x(), p.y(), p.z()) / static_cast<double>(end - begin);
          }
          const auto closest = tree.closest_face((middle - dual.origin()) / dual.unit(), Eigen::Vector3d::Zero());
          speaker_[f] = closest ? dual.face(closest->face).idx() : 0;
        }
      },
      polygons_.corners);
}

std::vector<double> by_interior_edge(const Mesh& mesh, const Dual& dual, const std::vector<double>& values) {
  std::vector<double> by_edge(num_edges(mesh.halfedges()), 0.);
  for (Index e = 0; e < values.size(); ++e) by_edge[dual.edge(e).idx()] = values[e];
  std::vector<double> result;
  for (const Edge e : mesh.interior_edges()) result.push_back(by_edge[e.idx()]);
  return result;
}

void define_mesh(nb::module_& m) {
  nb::class_<Mesh>(m, "Mesh", "A mesh over arrays, repaired where that is needed and wished.")
      .def(nb::init<Mesh::Any_array, Mesh::Any_array, std::optional<Integers>, std::size_t, bool>(),
           nb::arg("vertices"), nb::arg("corners"), nb::arg("offsets").none(), nb::arg("degree"), nb::arg("repair"),
           nb::sig("def __init__(self, vertices: numpy.typing.NDArray[numpy.float32] | "
                   "numpy.typing.NDArray[numpy.float64], corners: numpy.typing.NDArray[typing.Any], "
                   "offsets: numpy.typing.NDArray[numpy.int64] | None, degree: int, repair: bool) -> None"))
      .def_prop_ro("number_of_faces", &Mesh::number_of_faces)
      .def_prop_ro("remarks", &Mesh::remarks)
      .def("interior_edges", &interior_edges,
           nb::sig("def interior_edges(self) -> tuple[numpy.typing.NDArray[numpy.int64], "
                   "numpy.typing.NDArray[numpy.int64]]"))
      .def("sharp_edges", &sharp_edges, nb::arg("degrees"));
}

}  // namespace rw_python
