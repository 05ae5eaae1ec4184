// SPDX-License-Identifier: MIT

#include "Hierarchy.h"

#include "Choices.h"
#include "definitions.h"
#include "without_lock.h"

#include <RW_segmentation/segmentation_via_random_walks.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <utility>

namespace rw_python {
namespace {

/// \param seeds faces to start walks from besides the automatic ones
Hierarchy hierarchy(const Mesh& mesh, const Choices& choices, const Integers& seeds,
                    const std::optional<Numbers>& difference, const std::optional<Pairs>& walls,
                    const nb::object& progress) {
  return without_lock(progress, [&](const auto& callback) -> Hierarchy {
    const segment_mesh::Method method = method_of(choices, false);
    std::vector<Face> given;
    for (std::size_t i = 0; i < seeds.shape(0); ++i) given.push_back(mesh.face(seeds(i), "seed"));
    const Dual dual = mesh.dual(walls);
    const std::vector<double> by_edge =
        difference ? mesh.by_edge(*difference, "the difference") : std::vector<double>();
    const auto levels =
        RW::hierarchy_via_random_walks(dual, policies_of(method, by_edge), given, CGAL::parameters::callback(callback));
    return hierarchy_of(mesh, levels, segment_mesh::stop_by_shape(method.merge_cost));
  });
}

/// The segment of each face at a number of segments.
Array<std::int64_t> labels(const Hierarchy& hierarchy, std::size_t number) {
  std::vector<std::int64_t> result;
  {
    const nb::gil_scoped_release release;
    const std::vector<std::size_t> segment = hierarchy.tree.segment_of_fragments(number);
    result.reserve(hierarchy.fragment_of_face.size());
    for (const std::int64_t fragment : hierarchy.fragment_of_face)
      result.push_back(static_cast<std::int64_t>(segment[static_cast<std::size_t>(fragment)]));
  }
  return array_of(std::move(result));
}

Table<std::int64_t> merges(const Hierarchy& hierarchy) {
  std::vector<std::int64_t> regions;
  for (const auto& merge : hierarchy.tree.merges()) {
    regions.push_back(static_cast<std::int64_t>(merge.first));
    regions.push_back(static_cast<std::int64_t>(merge.second));
  }
  return table_of(std::move(regions), 2);
}

Array<double> costs(const Hierarchy& hierarchy) {
  std::vector<double> values;
  for (const auto& merge : hierarchy.tree.merges()) values.push_back(merge.cost);
  return array_of(std::move(values));
}

nb::dict report(const Hierarchy& hierarchy) {
  const RW::Segmentation_report& known = hierarchy.report;
  nb::dict result, seconds;
  result["components"] = known.components;
  result["seeds"] = known.seeds;
  result["clusters"] = known.clusters;
  result["fragments"] = known.fragments;
  result["degenerate_faces"] = known.degenerate_faces;
  result["island_faces"] = known.island_faces;
  result["has_heavy_noise"] = known.has_heavy_noise;
  result["noise"] = known.noise;
  for (const auto& stage : known.stages) seconds[stage.name.c_str()] = stage.seconds;
  result["seconds"] = seconds;
  return result;
}

}  // namespace

void define_hierarchy(nb::module_& m) {
  nb::class_<Hierarchy>(m, "Hierarchy", "All levels of a segmentation.")
      .def_prop_ro("number_of_fragments", [](const Hierarchy& h) { return h.tree.number_of_fragments(); })
      .def_prop_ro("number_of_components", [](const Hierarchy& h) { return h.tree.number_of_components(); })
      .def_ro("suggested", &Hierarchy::suggested)
      .def_prop_ro("merges", &merges, nb::rv_policy::move)
      .def_prop_ro("costs", &costs, nb::rv_policy::move)
      .def_prop_ro(
          "fragment_of_face",
          [](const Hierarchy& h) { return array_of(std::vector<std::int64_t>(h.fragment_of_face)); },
          nb::rv_policy::move)
      .def_prop_ro("report", &report, nb::for_getter(nb::sig("def report(self, /) -> dict[str, typing.Any]")))
      .def("labels", &labels, nb::arg("number"))
      .def(
          "levels", [](const Hierarchy& h, std::size_t number) { return h.tree.levels(number); }, nb::arg("number"));
  m.def("hierarchy", &hierarchy, nb::arg("mesh"), nb::arg("choices"), nb::arg("seeds"), nb::arg("difference").none(),
        nb::arg("walls").none(), nb::arg("progress").none());
}

}  // namespace rw_python
