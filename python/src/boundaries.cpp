// SPDX-License-Identifier: MIT

#include "Mesh.h"
#include "definitions.h"
#include "without_lock.h"

#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/split_along_boundaries.h>
#include <nanobind/stl/optional.h>

#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace rw_python {
namespace {

using Curve = RW::Boundary_curve<Array_mesh>;

/// The three halfedges of a face, the first of which `halfedge(face, mesh)` is.
std::array<Index, 3> sides_of(const Array_mesh& mesh, Index face) {
  const Index first = mesh.halfedge_of_face[face];
  return {first, mesh.next[first], mesh.next[mesh.next[first]]};
}

/// For the source of each of a face's three halfedges the user's corner that is in the same place.
std::array<std::size_t, 3> user_corners(const Mesh& mesh, Index face, std::int64_t user_face) {
  const auto sides = sides_of(mesh.halfedges(), face);
  std::array<std::size_t, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t corner = 0; corner < 3; ++corner)
      if (mesh.halfedges().coordinates.point(mesh.corner(user_face, corner)) ==
          mesh.halfedges().point(mesh.halfedges().source(sides[k])))
        corners[k] = corner;
  return corners;
}

/// Curves as arrays: points, faces that they lie in, and barycentric coordinates in the order of the faces' corners.
nb::dict arrays_of(const Mesh& mesh, const Curve& curve, const std::vector<std::int64_t>& user_face) {
  std::vector<double> points, barycentric;
  std::vector<std::int64_t> faces;
  for (const auto& point : curve.points) {
    const auto [face, coordinates] = RW::face_location(point, mesh.halfedges());
    const std::int64_t number = user_face.empty() ? face.idx() : user_face[face.idx()];
    const auto corners = user_corners(mesh, face.idx(), number);
    std::array<double, 3> by_user{};
    for (std::size_t k = 0; k < 3; ++k) by_user[corners[k]] = coordinates[k];
    faces.push_back(number);
    barycentric.insert(barycentric.end(), by_user.begin(), by_user.end());
    points.insert(points.end(), {point.point.x(), point.point.y(), point.point.z()});
  }
  nb::dict result;
  result["points"] = table_of(std::move(points), 3);
  result["faces"] = array_of(std::move(faces));
  result["barycentric"] = table_of(std::move(barycentric), 3);
  result["is_closed"] = curve.is_closed;
  result["is_smoothed"] = curve.is_smoothed;
  result["segments"] =
      nb::make_tuple(static_cast<std::int64_t>(curve.segments[0]), static_cast<std::int64_t>(curve.segments[1]));
  return result;
}

nb::list smooth_boundaries(const Mesh& mesh, const Integers& labels, const RW::Boundary_smoothing& smoothing,
                           const std::optional<Pairs>& walls, const nb::object& progress) {
  const std::vector<Curve> curves = without_lock(progress, [&](const auto& callback) {
    std::vector<std::size_t> label = mesh.by_mesh_face<std::size_t>(labels.data());
    return RW::smooth_boundaries(mesh.dual(walls), map_over<Face>(label), smoothing,
                                 CGAL::parameters::callback(callback));
  });
  const std::vector<std::int64_t> user_face = mesh.user_faces();
  nb::list result;
  for (const Curve& curve : curves) result.append(arrays_of(mesh, curve, user_face));
  return result;
}

/// A point of a curve, as a halfedge and the place on it.
/// \throws std::invalid_argument if it is on no edge
RW::Boundary_point<Array_mesh> point_of(const Mesh& mesh, std::int64_t user_face, const double* barycentric) {
  const Index face = mesh.face(user_face, "the face of a curve,").idx();
  const auto corners = user_corners(mesh, face, user_face);
  const auto sides = sides_of(mesh.halfedges(), face);
  for (std::size_t k = 0; k < 3; ++k) {
    if (barycentric[corners[k]] != 0) continue;
    const std::size_t side = (k + 1) % 3, end = (k + 2) % 3;
    return {Halfedge(sides[side]), barycentric[corners[end]], {}};
  }
  throw std::invalid_argument("a point of a curve is on no edge: one of its barycentric coordinates must be 0");
}

std::vector<Curve> curves_of(const Mesh& mesh, const nb::list& arrays) {
  std::vector<Curve> curves;
  for (const nb::handle entry : arrays) {
    const auto known = nb::cast<nb::dict>(entry);
    const auto faces = nb::cast<Integers>(known["faces"]);
    const auto barycentric = nb::cast<Rows>(known["barycentric"]);
    const auto segments = nb::cast<Integers>(known["segments"]);
    if (barycentric.shape(0) != faces.shape(0) || barycentric.shape(1) != 3 || segments.shape(0) != 2)
      throw std::invalid_argument(
          "a curve needs as many faces as rows of three barycentric coordinates, and two segments");
    Curve curve;
    curve.is_closed = nb::cast<bool>(known["is_closed"]);
    curve.segments = {static_cast<std::size_t>(segments(0)), static_cast<std::size_t>(segments(1))};
    for (std::size_t i = 0; i < faces.shape(0); ++i)
      curve.points.push_back(point_of(mesh, faces(i), barycentric.data() + 3 * i));
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// Notes which face each new one was part of.
struct Parent_notes : RW::Default_split_visitor<Array_mesh> {
  Face divided;
  std::shared_ptr<std::vector<Index>> parents =
      std::make_shared<std::vector<Index>>();  // the library copies the visitor

  void before_subface_creations(Face face, const Array_mesh&) { divided = face; }
  void after_subface_created(Face, const Array_mesh&) { parents->push_back((*parents)[divided.idx()]); }
};

/// A mesh cut along curves, and what has become of its parts.
struct Split {
  std::vector<double> points;
  std::vector<std::int64_t> faces, labels, parents, boundary;

  Split(const Array_mesh& mesh, const std::vector<std::size_t>& label, const std::vector<Index>& parent,
        const std::vector<std::int64_t>& user_face, const std::vector<char>& is_boundary) {
    for (std::size_t v = 0; v < mesh.coordinates.number; ++v)
      for (std::size_t i = 0; i < 3; ++i) points.push_back(mesh.coordinates(v, i));
    for (const Point& p : mesh.added_points) points.insert(points.end(), {p.x(), p.y(), p.z()});
    const auto number = [&](Index v) {
      const Index known = mesh.vertex_of_user(v);
      return static_cast<std::int64_t>(known != none ? known : v - mesh.copied_vertex.size());
    };
    for (Index f = 0; f < mesh.number_of_faces(); ++f) {
      for (const Index h : sides_of(mesh, f)) faces.push_back(number(mesh.target[h]));
      labels.push_back(static_cast<std::int64_t>(label[f]));
      parents.push_back(user_face.empty() ? parent[f] : user_face[parent[f]]);
    }
    for (Index e = 0; e < is_boundary.size(); ++e)
      if (is_boundary[e]) boundary.insert(boundary.end(), {number(mesh.source(2 * e)), number(mesh.target[2 * e])});
  }
};

nb::tuple split_along_boundaries(const Mesh& mesh, const Integers& labels, const nb::list& arrays) {
  const std::vector<Curve> curves = curves_of(mesh, arrays);
  Split split = [&] {
    const nb::gil_scoped_release release;
    Array_mesh halfedges = mesh.halfedges();
    halfedges.find_halfedges_of_vertices();
    std::vector<std::size_t> label = mesh.by_mesh_face<std::size_t>(labels.data());
    std::vector<char> is_boundary(num_edges(halfedges), false);
    const Parent_notes notes;
    for (Index f = 0; f < halfedges.number_of_faces(); ++f) notes.parents->push_back(f);
    RW::split_along_boundaries(halfedges, curves, map_over<Face>(label),
                               CGAL::parameters::visitor(notes).edge_is_constrained_map(map_over<Edge>(is_boundary)));
    return Split(halfedges, label, *notes.parents, mesh.user_faces(), is_boundary);
  }();
  return nb::make_tuple(table_of(std::move(split.points), 3), table_of(std::move(split.faces), 3),
                        array_of(std::move(split.labels)), array_of(std::move(split.parents)),
                        table_of(std::move(split.boundary), 2));
}

}  // namespace

void define_boundaries(nb::module_& m) {
  nb::class_<RW::Boundary_smoothing>(m, "BoundarySmoothing", "How smooth boundaries become.")
      .def(nb::init<>())
      .def_rw("length", &RW::Boundary_smoothing::length)
      .def_rw("tension", &RW::Boundary_smoothing::tension)
      .def_rw("feature_weight", &RW::Boundary_smoothing::feature_weight)
      .def_rw("crease_angle", &RW::Boundary_smoothing::crease_angle)
      .def_rw("largest_displacement", &RW::Boundary_smoothing::largest_displacement)
      .def_rw("steps", &RW::Boundary_smoothing::steps);
  m.def("smooth_boundaries", &smooth_boundaries, nb::arg("mesh"), nb::arg("labels"), nb::arg("smoothing"),
        nb::arg("walls").none(), nb::arg("progress").none(),
        nb::sig("def smooth_boundaries(mesh: Mesh, labels: numpy.typing.NDArray[numpy.int64], "
                "smoothing: BoundarySmoothing, walls: numpy.typing.NDArray[numpy.int64] | None, "
                "progress: object | None) -> list[dict[str, typing.Any]]"));
  m.def("split_along_boundaries", &split_along_boundaries, nb::arg("mesh"), nb::arg("labels"), nb::arg("curves"),
        nb::sig("def split_along_boundaries(mesh: Mesh, labels: numpy.typing.NDArray[numpy.int64], "
                "curves: list[dict[str, object]]) -> tuple[numpy.typing.NDArray[numpy.float64], "
                "numpy.typing.NDArray[numpy.int64], numpy.typing.NDArray[numpy.int64], "
                "numpy.typing.NDArray[numpy.int64], numpy.typing.NDArray[numpy.int64]]"));
}

}  // namespace rw_python
