// SPDX-License-Identifier: MIT

// The random walk with priors: at each face a walk may also end, with the label that somebody believes the face to have.

#include "Choices.h"
#include "definitions.h"
#include "without_lock.h"

#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <nanobind/stl/optional.h>

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace rw_python {
namespace {

/// How strongly evidence counts: evidence fades over this length, as a part of the root of the area, across a flat
/// surface of even triangles with edges of length h. There the walk's Laplacian is h^3 / 4 times that of the surface and
/// a triangle has the area sqrt(3) / 4 h^2, so that both balance over a length l for h / (sqrt(3) l^2).
double weight_for(double reach, const Dual& mesh) {
  const double length = reach * mesh.length_unit();
  return mesh.mean_edge_length() / (std::sqrt(3.) * length * length);
}

/// The walk's network with one more node for each face that something is known of: walks that step there end.
struct Network_with_evidence {
  RW::Dual_graph graph;
  std::vector<double> conductance;
  std::vector<Index> absorbing, of_face;  ///< the nodes where walks end, and the faces that they belong to
};

Network_with_evidence network_of(const Walk_ground& ground, const std::vector<double>& evidence, double weight) {
  const Dual& mesh = ground.mesh;
  Network_with_evidence network;
  std::vector<std::array<Index, 2>> sides;
  for (Index e = 0; e < mesh.number_of_edges(); ++e) {
    sides.push_back(mesh.graph().faces_of(e));
    network.conductance.push_back(ground.conductance[mesh.edge(e).idx()]);
  }
  auto node = static_cast<Index>(mesh.number_of_faces());
  for (Index f = 0; f < mesh.number_of_faces(); ++f) {
    if (!(evidence[f] > 0) || !(mesh.area(f) > 0)) continue;
    sides.push_back({f, node});
    network.conductance.push_back(weight * mesh.area(f) * evidence[f]);
    network.absorbing.push_back(node++);
    network.of_face.push_back(f);
  }
  network.graph = RW::Dual_graph(node, std::move(sides));
  return network;
}

/// Labels by the highest probability, and for what no evidence reaches the next ones, one a component.
std::vector<std::int64_t> labels_of(const Walk_ground& ground, const RW::Potentials& potentials) {
  const Dual& mesh = ground.mesh;
  const RW::internal::Components components(mesh.graph(),
                                            [&](Index e) { return ground.conductance[mesh.edge(e).idx()] > 0; });
  std::vector<std::int64_t> next(components.count, -1), labels(mesh.number_of_faces());
  std::int64_t unused = potentials.cols();
  for (Index f = 0; f < labels.size(); ++f) {
    Eigen::Index best = 0;
    if (potentials.cols() > 0 && potentials.row(f).maxCoeff(&best) > 0) {
      labels[mesh.face(f).idx()] = best;
      continue;
    }
    std::int64_t& label = next[components.of[f]];
    if (label < 0) label = unused++;
    labels[mesh.face(f).idx()] = label;
  }
  return labels;
}

void require_probabilities(const Mesh& mesh, const Rows& rows) {
  if (rows.shape(0) != mesh.number_of_faces())
    throw std::invalid_argument("probabilities have " + std::to_string(rows.shape(0)) + " rows, but the mesh has " +
                                std::to_string(mesh.number_of_faces()) + " faces");
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!(rows.data()[i] >= 0 && std::isfinite(rows.data()[i])))
      throw std::invalid_argument("the probability of label " + std::to_string(i % rows.shape(1)) + " at face " +
                                  std::to_string(i / rows.shape(1)) + " is " + std::to_string(rows.data()[i]) +
                                  ", but must be a number >= 0");
}

/// \returns labels, and a row of probabilities for each face
nb::tuple refine(const Mesh& mesh, const Rows& probabilities, double reach, const Choices& choices,
                 const std::optional<Numbers>& difference, const std::optional<Pairs>& walls,
                 const nb::object& progress) {
  if (!(reach > 0 && std::isfinite(reach)))
    throw std::invalid_argument("reach is " + std::to_string(reach) + ", but must be positive");
  const std::size_t labels = probabilities.shape(1);
  std::vector<double> refined;
  std::vector<std::int64_t> label = without_lock(progress, [&](const auto& callback) {
    require_probabilities(mesh, probabilities);
    const Dual dual = mesh.dual(walls);
    const auto by_edge = difference ? mesh.by_edge(*difference, "the difference") : std::vector<double>();
    const Walk_ground ground =
        walk_ground(mesh, dual, policies_of(method_of(choices, true), by_edge), {}, false, part(callback, 0, 0.3));
    std::vector<const double*> row_of(num_faces(mesh.halfedges()));
    for (std::size_t f = 0; f < mesh.number_of_faces(); ++f)
      if (const auto face = mesh.known_face(f)) row_of[face->idx()] = probabilities.data() + f * labels;
    std::vector<double> evidence;
    for (const Face f : dual.face_descriptors()) {
      double sum = 0;
      for (std::size_t k = 0; k < labels; ++k) sum += row_of[f.idx()][k];
      evidence.push_back(sum);
    }
    const Network_with_evidence network = network_of(ground, evidence, weight_for(reach, dual));
    RW::Potentials beliefs(static_cast<Eigen::Index>(network.absorbing.size()), static_cast<Eigen::Index>(labels));
    for (std::size_t i = 0; i < network.of_face.size(); ++i)
      for (std::size_t k = 0; k < labels; ++k)
        beliefs(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
            row_of[dual.face(network.of_face[i]).idx()][k] / evidence[network.of_face[i]];
    RW::Star_mesh_elimination solver;
    solver.analyze(network.graph);
    solver.factorize(network.conductance, network.absorbing, RW::Progress(part(callback, 0.3, 0.9)));
    RW::Potentials potentials;
    solver.potentials(beliefs, potentials);
    std::vector<double> rows(num_faces(mesh.halfedges()) * labels);
    for (Index f = 0; f < dual.number_of_faces(); ++f)
      for (std::size_t k = 0; k < labels; ++k)
        rows[dual.face(f).idx() * labels + k] = potentials(f, static_cast<Eigen::Index>(k));
    refined = mesh.by_user_face<double>(rows, labels);
    return mesh.by_user_face<std::int64_t>(labels_of(ground, potentials));
  });
  return nb::make_tuple(array_of(std::move(label)), table_of(std::move(refined), labels, mesh.number_of_faces()));
}

}  // namespace

void define_priors(nb::module_& m) {
  m.def("refine", &refine, nb::arg("mesh"), nb::arg("probabilities"), nb::arg("reach"), nb::arg("choices"),
        nb::arg("difference").none(), nb::arg("walls").none(), nb::arg("progress").none(),
        nb::sig("def refine(mesh: Mesh, probabilities: numpy.typing.NDArray[numpy.float64], reach: float, "
                "choices: Choices, difference: numpy.typing.NDArray[numpy.float64] | None, "
                "walls: numpy.typing.NDArray[numpy.int64] | None, progress: object | None) -> "
                "tuple[numpy.typing.NDArray[numpy.int64], numpy.typing.NDArray[numpy.float64]]"));
}

}  // namespace rw_python
