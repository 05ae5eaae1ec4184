// SPDX-License-Identifier: MIT

#include "Choices.h"

#include "definitions.h"
#include "without_lock.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/smoothed_face_normals.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <stdexcept>
#include <utility>

namespace rw_python {
namespace {

template <class Choice>
std::optional<Choice> chosen(const segment_mesh::Names<Choice>& names, const std::optional<std::string>& name,
                             const std::string& argument) {
  if (!name) return {};
  try {
    return segment_mesh::choice_of(names, *name);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(argument + ": " + error.what());
  }
}

/// \throws std::invalid_argument
void check(const Choices& choices) {
  const bool is_by_curvature = choices.difference == "curvature";
  if (choices.seeds == std::size_t(0)) throw std::invalid_argument("number_of_seeds is 0, but must be at least 1");
  if (choices.radius && !is_by_curvature)
    throw std::invalid_argument("radius is that of curvatures: give difference=\"curvature\", too");
  if (choices.convex_weight && is_by_curvature)
    throw std::invalid_argument("convex_weight: curvatures have none, leave it out or give another difference");
  if (choices.measure && is_by_curvature)
    throw std::invalid_argument("measure: curvatures have none, leave it out or give another difference");
  if (choices.is_coarse && choices.seeding)
    throw std::invalid_argument("seeding: the coarse policies place their seeds by themselves, leave it out");
  if (choices.is_coarse && choices.merge_cost)
    throw std::invalid_argument("merge_cost: the coarse policies merge nothing, leave it out");
  if (choices.is_coarse && choices.seedings)
    throw std::invalid_argument("seedings: the coarse policies merge nothing, leave it out");
}

}  // namespace

segment_mesh::Method method_of(const Choices& choices, bool are_seeds_given) {
  using namespace segment_mesh;
  check(choices);
  segment_mesh::Choices said;
  said.is_coarse = choices.is_coarse;
  said.is_paper = choices.is_paper;
  said.seedings = choices.seedings;
  said.segments = choices.segments;
  said.automatic_seeds = choices.seeds;
  said.difference = chosen(difference_names, choices.difference, "difference");
  said.components = chosen(components_names, choices.components, "components");
  said.seeding = chosen(seeding_names, choices.seeding, "seeding");
  said.merge_cost = chosen(merge_cost_names, choices.merge_cost, "merge_cost");
  said.solver = chosen(solver_names, choices.solver, "solver");
  said.measure = chosen(measure_names, choices.measure, "measure");
  said.smoothing = choices.smoothing;
  said.convex_weight = choices.convex_weight;
  said.radius = choices.radius;
  said.sigma = choices.sigma;
  said.cap = choices.cap;
  return segment_mesh::method_of(said, are_seeds_given);
}

std::vector<double> Edge_difference::operator()(const Dual& mesh, const RW::Progress& progress) const {
  if (values_.empty()) return method_(mesh, progress);
  std::vector<double> values;
  values.reserve(mesh.number_of_edges());
  for (const Edge e : mesh.edge_descriptors()) values.push_back(values_[e.idx()]);
  return values;
}

Policies policies_of(const segment_mesh::Method& method, const std::vector<double>& difference) {
  const segment_mesh::Policies policies = segment_mesh::policies_of(method);
  return policies.with_difference(Edge_difference(policies.difference, difference));
}

Walk_ground walk_ground(const Mesh& mesh, const Dual& dual, const Policies& policies,
                        const std::vector<double>& conductance, bool needs_difference,
                        const std::function<bool(double)>& callback) {
  Walk_ground ground = {dual, dual, {}, conductance};
  if (!conductance.empty() && !needs_difference) return ground;
  const auto smoothed =
      RW::smoothed_shape(dual, policies.smoothing, CGAL::parameters::callback(part(callback, 0, 0.5)));
  ground.shape = Dual(dual.with_shape_normals_of(smoothed), dual);
  ground.difference = policies.difference(ground.shape, RW::Progress(part(callback, 0.5, 1)));
  if (!conductance.empty()) return ground;
  std::vector<double> by_edge(num_edges(mesh.halfedges()), 0.);
  for (Index e = 0; e < ground.difference.size(); ++e) by_edge[dual.edge(e).idx()] = ground.difference[e];
  const RW::Conductance known(ground.shape, map_over<Edge>(by_edge), policies.sigma, policies.cap);
  ground.conductance.assign(by_edge.size(), 0.);
  for (const Edge e : dual.edge_descriptors()) ground.conductance[e.idx()] = get(known, e);
  return ground;
}

void define_choices(nb::module_& m) {
  nb::class_<Choices>(m, "Choices", "How segments are found; None: the library's own choice.")
      .def(nb::init<>())
      .def_rw("is_paper", &Choices::is_paper)
      .def_rw("is_coarse", &Choices::is_coarse)
      .def_rw("seedings", &Choices::seedings, nb::arg().none())
      .def_rw("difference", &Choices::difference, nb::arg().none())
      .def_rw("components", &Choices::components, nb::arg().none())
      .def_rw("seeding", &Choices::seeding, nb::arg().none())
      .def_rw("merge_cost", &Choices::merge_cost, nb::arg().none())
      .def_rw("solver", &Choices::solver, nb::arg().none())
      .def_rw("measure", &Choices::measure, nb::arg().none())
      .def_rw("smoothing", &Choices::smoothing, nb::arg().none())
      .def_rw("convex_weight", &Choices::convex_weight, nb::arg().none())
      .def_rw("radius", &Choices::radius, nb::arg().none())
      .def_rw("sigma", &Choices::sigma, nb::arg().none())
      .def_rw("cap", &Choices::cap, nb::arg().none())
      .def_rw("seeds", &Choices::seeds, nb::arg().none())
      .def_rw("segments", &Choices::segments, nb::arg().none());
}

}  // namespace rw_python
