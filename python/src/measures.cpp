// SPDX-License-Identifier: MIT

#include "Choices.h"
#include "definitions.h"
#include "without_lock.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/integral_invariant_curvatures.h>
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/smoothed_face_normals.h>
#include <RW_segmentation/transfer_segments.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace rw_python {
namespace {

using Callback = std::function<bool(double)>;

RW::Ball_radius radius_of(double radius, bool is_in_edge_lengths) {
  return is_in_edge_lengths ? RW::Ball_radius::in_edge_lengths(radius) : RW::Ball_radius::absolute(radius);
}

RW::Normal_smoothing smoothing_of(double radius) {
  RW::Normal_smoothing smoothing;
  smoothing.radius = radius;
  return smoothing;
}

/// \returns curvatures, a row a face: largest, least, mean by volume, offset; and the directions of the first two and the
/// normal, three rows a face
nb::tuple curvatures(const Mesh& mesh, double radius, bool is_in_edge_lengths, const nb::object& progress) {
  std::vector<double> directions;
  RW::Curvature_report report;
  std::vector<double> numbers = without_lock(progress, [&](const Callback& callback) {
    std::vector<RW::Surface_curvatures> measured(num_faces(mesh.halfedges()));
    report =
        RW::integral_invariant_curvatures(mesh.halfedges(), map_over<Face>(measured),
                                          radius_of(radius, is_in_edge_lengths), CGAL::parameters::callback(callback));
    std::vector<double> rows, vectors;
    for (const RW::Surface_curvatures& c : measured) {
      rows.insert(rows.end(), {c.max_curvature, c.min_curvature, c.mean_curvature_by_volume, c.offset});
      for (const auto& vector : {c.max_direction, c.min_direction, c.normal})
        vectors.insert(vectors.end(), vector.data(), vector.data() + 3);
    }
    directions = mesh.by_user_face<double>(vectors, 9);
    return mesh.by_user_face<double>(rows, 4);
  });
  return nb::make_tuple(table_of(std::move(numbers), 4), table_of(std::move(directions), 9), report.radius);
}

Array<double> dihedral_difference(const Mesh& mesh, double convex_weight, const std::string& measure, double smoothing,
                                  double ordinary_difference, const nb::object& progress) {
  return array_of(without_lock(progress, [&](const Callback& callback) {
    const RW::Dihedral_difference_policy policy = {
        convex_weight, segment_mesh::choice_of(segment_mesh::measure_names, measure), ordinary_difference};
    const Dual shape = RW::smoothed_shape(mesh.dual(), smoothing_of(smoothing), CGAL::parameters::callback(callback));
    return by_interior_edge(mesh, shape, policy(shape));
  }));
}

Array<double> curvature_difference(const Mesh& mesh, double radius, bool is_in_edge_lengths,
                                   const nb::object& progress) {
  return array_of(without_lock(progress, [&](const Callback& callback) {
    const Dual dual = mesh.dual();
    const RW::Curvature_difference_policy policy = {radius_of(radius, is_in_edge_lengths)};
    return by_interior_edge(mesh, dual, policy(dual, RW::Progress(callback)));
  }));
}

std::vector<double> conductances(const Mesh& mesh, const Dual& dual, const Numbers& difference, double sigma,
                                 double cap) {
  std::vector<double> by_edge = mesh.by_edge(difference, "the difference");
  const RW::Conductance known(dual, map_over<Edge>(by_edge), sigma, cap);
  std::vector<double> result(by_edge.size());
  for (const Edge e : edges(mesh.halfedges())) result[e.idx()] = get(known, e);
  return result;
}

Array<double> conductance(const Mesh& mesh, const Numbers& difference, double sigma, double cap,
                          const std::optional<Pairs>& walls) {
  const nb::gil_scoped_release release;
  const std::vector<double> by_edge = conductances(mesh, mesh.dual(walls), difference, sigma, cap);
  std::vector<double> result;
  for (const Edge e : mesh.interior_edges()) result.push_back(by_edge[e.idx()]);
  const nb::gil_scoped_acquire lock;
  return array_of(std::move(result));
}

Array<double> thickness(const Mesh& mesh, std::size_t rays, double cone_angle, bool is_smoothed,
                        const std::string& scale, const nb::object& progress) {
  static const segment_mesh::Names<RW::Thickness_scale> scales = {{"length", RW::Thickness_scale::length},
                                                                  {"linear", RW::Thickness_scale::linear},
                                                                  {"logarithmic", RW::Thickness_scale::logarithmic}};
  return array_of(without_lock(progress, [&](const Callback& callback) {
    const RW::Thickness_of_faces numbers = {rays, cone_angle, is_smoothed, segment_mesh::choice_of(scales, scale)};
    std::vector<double> values(num_faces(mesh.halfedges()));
    RW::thickness_of_all_faces(mesh.halfedges(), map_over<Face>(values), numbers, CGAL::parameters::callback(callback));
    return mesh.by_user_face<double>(values);
  }));
}

Table<double> smoothed_normals(const Mesh& mesh, double smoothing, const nb::object& progress) {
  return table_of(without_lock(progress,
                               [&](const Callback& callback) {
                                 const Dual shape = RW::smoothed_shape(mesh.dual(), smoothing_of(smoothing),
                                                                       CGAL::parameters::callback(callback));
                                 std::vector<double> rows(3 * num_faces(mesh.halfedges()));
                                 for (Index f = 0; f < shape.number_of_faces(); ++f)
                                   for (int i = 0; i < 3; ++i)
                                     rows[3 * std::size_t(shape.face(f).idx()) + static_cast<std::size_t>(i)] =
                                         shape.shape_normal(f)[i];
                                 return mesh.by_user_face<double>(rows, 3);
                               }),
                  3);
}

Array<std::int64_t> transfer_labels(const Mesh& reduced, const Integers& reduced_labels, const Mesh& mesh,
                                    const Numbers& difference, double sigma, double cap, std::size_t band,
                                    const std::optional<Pairs>& walls, const nb::object& progress) {
  return array_of(without_lock(progress, [&](const Callback& callback) {
    std::vector<std::size_t> ids = reduced.by_mesh_face<std::size_t>(reduced_labels.data());
    const Dual dual = mesh.dual(walls);
    std::vector<double> by_edge = conductances(mesh, dual, difference, sigma, cap);
    std::vector<std::size_t> labels(num_faces(mesh.halfedges()));
    RW::transfer_segments(reduced.halfedges(), map_over<Face>(ids), dual, RW::as_conductance(map_over<Edge>(by_edge)),
                          map_over<Face>(labels), band, CGAL::parameters::callback(callback));
    return mesh.by_user_face<std::int64_t>(labels);
  }));
}

}  // namespace

void define_measures(nb::module_& m) {
  m.def("curvatures", &curvatures, nb::arg("mesh"), nb::arg("radius"), nb::arg("in_edge_lengths"),
        nb::arg("progress").none(),
        nb::sig("def curvatures(mesh: Mesh, radius: float, in_edge_lengths: bool, progress: object | None) -> "
                "tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64], float]"));
  m.def("dihedral_difference", &dihedral_difference, nb::arg("mesh"), nb::arg("convex_weight"), nb::arg("measure"),
        nb::arg("smoothing"), nb::arg("ordinary_difference"), nb::arg("progress").none());
  m.def("curvature_difference", &curvature_difference, nb::arg("mesh"), nb::arg("radius"), nb::arg("in_edge_lengths"),
        nb::arg("progress").none());
  m.def("conductance", &conductance, nb::arg("mesh"), nb::arg("difference"), nb::arg("sigma"), nb::arg("cap"),
        nb::arg("walls").none());
  m.def("thickness", &thickness, nb::arg("mesh"), nb::arg("rays"), nb::arg("cone_angle"), nb::arg("smoothed"),
        nb::arg("scale"), nb::arg("progress").none());
  m.def("smoothed_normals", &smoothed_normals, nb::arg("mesh"), nb::arg("smoothing"), nb::arg("progress").none());
  m.def("transfer_labels", &transfer_labels, nb::arg("reduced"), nb::arg("reduced_labels"), nb::arg("mesh"),
        nb::arg("difference"), nb::arg("sigma"), nb::arg("cap"), nb::arg("band"), nb::arg("walls").none(),
        nb::arg("progress").none());
}

}  // namespace rw_python
