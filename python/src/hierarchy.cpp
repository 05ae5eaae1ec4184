// SPDX-License-Identifier: MIT

#include "Hierarchy.h"

#include "Choices.h"
#include "definitions.h"
#include "without_lock.h"

#include <RW_segmentation/segmentation_via_random_walks.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

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

/// The numbers of a report, and the names and seconds of its stages.
using Report_state = std::tuple<std::size_t, std::size_t, std::size_t, std::size_t, std::size_t, std::size_t, bool,
                                double, std::vector<std::pair<std::string, double>>>;

/// What a pickle holds: the number of fragments, the regions and costs of the merges, the fragment of each face, the number
/// of segments by the shape, and the report.
using State = std::tuple<std::size_t, Pairs, Numbers, Integers, std::size_t, Report_state>;

nb::tuple state_of(const Hierarchy& hierarchy) {
  const RW::Segmentation_report& known = hierarchy.report;
  Report_state report(known.components, known.seeds, known.clusters, known.fragments, known.degenerate_faces,
                      known.island_faces, known.has_heavy_noise, known.noise, {});
  for (const auto& stage : known.stages) std::get<8>(report).emplace_back(stage.name, stage.seconds);
  return nb::make_tuple(hierarchy.tree.number_of_fragments(), merges(hierarchy), costs(hierarchy),
                        array_of(std::vector<std::int64_t>(hierarchy.fragment_of_face)), hierarchy.suggested,
                        std::move(report));
}

/// \throws std::invalid_argument if a number is that of no region, as in a file that is broken
Hierarchy hierarchy_of_state(const State& state) {
  const auto& [fragments, regions, costs, fragment_of_face, suggested, report] = state;
  const auto region = [](std::int64_t number, std::size_t end) {
    if (number < 0 || static_cast<std::size_t>(number) >= end)
      throw std::invalid_argument("the hierarchy is broken: it has no region " + std::to_string(number));
    return static_cast<std::size_t>(number);
  };
  if (regions.shape(0) != costs.shape(0) || costs.shape(0) > fragments)
    throw std::invalid_argument("the hierarchy is broken: its numbers of merges and regions do not fit");
  std::vector<RW::Merge_tree::Merge> merges;
  merges.reserve(costs.shape(0));
  for (std::size_t i = 0; i < costs.shape(0); ++i)
    merges.push_back({region(regions(i, 0), fragments + i), region(regions(i, 1), fragments + i), costs(i)});
  Hierarchy result;
  result.tree = RW::Merge_tree(fragments, std::move(merges));
  result.fragment_of_face.reserve(fragment_of_face.shape(0));
  for (std::size_t f = 0; f < fragment_of_face.shape(0); ++f)
    result.fragment_of_face.push_back(static_cast<std::int64_t>(region(fragment_of_face(f), fragments)));
  result.suggested = suggested;
  RW::Segmentation_report& known = result.report;
  std::vector<std::pair<std::string, double>> stages;
  std::tie(known.components, known.seeds, known.clusters, known.fragments, known.degenerate_faces, known.island_faces,
           known.has_heavy_noise, known.noise, stages) = report;
  for (auto& [name, seconds] : stages) known.stages.push_back({std::move(name), seconds});
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
      .def("__getstate__", &state_of, nb::sig("def __getstate__(self) -> tuple[typing.Any, ...]"))
      .def(
          "__setstate__", [](Hierarchy& h, const State& state) { new (&h) Hierarchy(hierarchy_of_state(state)); },
          nb::sig("def __setstate__(self, state: tuple[typing.Any, ...], /) -> None"))
      .def(
          "levels", [](const Hierarchy& h, std::size_t number) { return h.tree.levels(number); }, nb::arg("number"));
  m.def("hierarchy", &hierarchy, nb::arg("mesh"), nb::arg("choices"), nb::arg("seeds"), nb::arg("difference").none(),
        nb::arg("walls").none(), nb::arg("progress").none());
}

}  // namespace rw_python
