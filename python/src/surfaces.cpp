// SPDX-License-Identifier: MIT

#include "Hierarchy.h"
#include "definitions.h"
#include "without_lock.h"

#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <nanobind/stl/optional.h>

#include <optional>
#include <utility>

namespace rw_python {
namespace {

RW::Surface_segmentation numbers_of(double noise, double stop_cost) {
  RW::Surface_segmentation numbers;
  numbers.noise = noise;
  numbers.stop_cost = stop_cost;
  return numbers;
}

Hierarchy hierarchy_of_surfaces(const Mesh& mesh, double noise, double stop_cost, const std::optional<Pairs>& walls,
                                const nb::object& progress) {
  return without_lock(progress, [&](const auto& callback) {
    const RW::Surface_segmentation numbers = numbers_of(noise, stop_cost);
    const auto levels = RW::hierarchy_of_surfaces(mesh.dual(walls), numbers, CGAL::parameters::callback(callback));
    return hierarchy_of(mesh, levels, [&](const RW::Merge_tree& tree) { return numbers.stop(tree); });
  });
}

nb::dict numbers_of(const RW::Analytic_surface& surface) {
  nb::dict result;
  result["type"] = RW::name_of(surface.type);
  result["point"] = nb::make_tuple(surface.point.x(), surface.point.y(), surface.point.z());
  result["direction"] = nb::make_tuple(surface.direction.x(), surface.direction.y(), surface.direction.z());
  result["radius"] = surface.radius;
  result["tube_radius"] = surface.tube_radius;
  result["half_angle"] = surface.half_angle;
  result["residual"] = surface.residual;
  result["point_error"] = surface.errors.point;
  result["direction_error"] = surface.errors.direction;
  result["radius_error"] = surface.errors.radius;
  result["tube_radius_error"] = surface.errors.tube_radius;
  result["half_angle_error"] = surface.errors.half_angle;
  return result;
}

/// The surface of each segment.
/// \param labels by the user's faces, from 0 without gaps
nb::list surfaces_of_segments(const Mesh& mesh, const Integers& labels, std::size_t segments, double noise,
                              const nb::object& progress) {
  const auto surfaces = without_lock(progress, [&](const auto& callback) {
    std::vector<std::size_t> segment = mesh.by_mesh_face<std::size_t>(labels.data());
    RW::Progress progress_of_call(callback);
    progress_of_call(0);
    auto found = RW::segment_surfaces(mesh.halfedges(), map_over<Face>(segment), segments, noise);
    progress_of_call(1);
    return found;
  });
  nb::list result;
  for (const RW::Analytic_surface& surface : surfaces) result.append(numbers_of(surface));
  return result;
}

}  // namespace

void define_surfaces(nb::module_& m) {
  m.def("hierarchy_of_surfaces", &hierarchy_of_surfaces, nb::arg("mesh"), nb::arg("noise"), nb::arg("stop_cost"),
        nb::arg("walls").none(), nb::arg("progress").none());
  m.def("surfaces_of_segments", &surfaces_of_segments, nb::arg("mesh"), nb::arg("labels"), nb::arg("segments"),
        nb::arg("noise"), nb::arg("progress").none(),
        nb::sig("def surfaces_of_segments(mesh: Mesh, labels: numpy.typing.NDArray[numpy.int64], segments: int, "
                "noise: float, progress: object | None) -> list[dict[str, typing.Any]]"));
}

}  // namespace rw_python
