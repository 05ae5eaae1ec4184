// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_METHOD_H
#define SEGMENT_MESH_METHOD_H

// The policies of segmentation_via_random_walks(), chosen while a program runs. All choices are of one type, so that the
// library is compiled once for all of them.

#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Eigen_walk_solver.h>
#include <RW_segmentation/Learned_cost.h>
#include <RW_segmentation/Paper_segmentation.h>
#include <RW_segmentation/Particle_sampling.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Region_boundary.h>
#include <RW_segmentation/Relative_boundary_cost.h>
#include <RW_segmentation/Segmentation_policies.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/coarse_seeds.h>
#include <RW_segmentation/feature_sensitive_seeds.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace segment_mesh {

/// What makes neighbouring faces differ: angles as in the paper, angles where smoothed normals turn inward, curvatures.
enum class Difference { dihedral, concavity, curvature };
/// Where walks begin: far apart, as evenly as particles, or once on each large structure.
enum class Seeding { farthest, particles, coarse };
/// Which fragments are merged first: those that people would have in one segment, small and alike ones, or those with the
/// weakest boundary as in the paper (Eq. 10).
enum class Merge_cost { learned, size, boundary };
/// What finds out where walks end.
enum class Solver { star_mesh, eigen };
/// What tells how large parts are and how many seeds there are: each connected component by itself, or the whole mesh.
enum class Components { each, whole };

/// Choices and what users call them.
template <class Choice>
using Names = std::vector<std::pair<std::string, Choice>>;

inline const Names<Difference> difference_names = {
    {"dihedral", Difference::dihedral}, {"concavity", Difference::concavity}, {"curvature", Difference::curvature}};
inline const Names<Seeding> seeding_names = {
    {"farthest", Seeding::farthest}, {"particles", Seeding::particles}, {"coarse", Seeding::coarse}};
inline const Names<Merge_cost> merge_cost_names = {
    {"learned", Merge_cost::learned}, {"size", Merge_cost::size}, {"boundary", Merge_cost::boundary}};
inline const Names<Solver> solver_names = {{"star-mesh", Solver::star_mesh}, {"eigen", Solver::eigen}};
inline const Names<Components> components_names = {{"each", Components::each}, {"whole", Components::whole}};
inline const Names<RW_segmentation::Dihedral_measure> measure_names = {
    {"angle", RW_segmentation::Dihedral_measure::angle},
    {"cosine", RW_segmentation::Dihedral_measure::one_minus_cosine}};

/// All names, with something between them.
template <class Choice>
std::string listed(const Names<Choice>& names, const std::string& separator) {
  std::string list;
  for (const auto& [name, choice] : names) list += (list.empty() ? "" : separator) + name;
  return list;
}

template <class Choice>
const std::string& name_of(const Names<Choice>& names, Choice choice) {
  return std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.second == choice; })->first;
}

/// \throws std::invalid_argument if there is no choice of that name
template <class Choice>
Choice choice_of(const Names<Choice>& names, const std::string& name) {
  for (const auto& [known, choice] : names)
    if (known == name) return choice;
  throw std::invalid_argument(name + " is none of " + listed(names, ", "));
}

using Face_number = RW_segmentation::Dual_mesh::Index;
using Difference_function =
    std::function<std::vector<double>(const RW_segmentation::Dual_mesh&, const RW_segmentation::Progress&)>;
using Seeding_function =
    std::function<std::vector<Face_number>(const RW_segmentation::Dual_mesh&, const std::vector<double>& difference,
                                           const std::vector<Face_number>& given, const RW_segmentation::Progress&)>;

/// One of the merge costs; a model of `MergeCost`.
class Chosen_merge_cost {
 public:
  using Region = RW_segmentation::Learned_cost::Region;  // the others need less
  using Boundary = RW_segmentation::Learned_cost::Boundary;

  /// \param all_sums a cost whose sums have all that the others are made of, too
  Chosen_merge_cost(Merge_cost choice, RW_segmentation::Learned_cost all_sums)
      : choice_(choice), learned_(std::move(all_sums)) {}

  Region region(const RW_segmentation::Dual_mesh& mesh, Face_number face) const { return learned_.region(mesh, face); }
  void join(Region& region, const Region& other) const { learned_.join(region, other); }
  Boundary boundary(const RW_segmentation::Dual_mesh& mesh, Face_number edge, double difference) const {
    return learned_.boundary(mesh, edge, difference);
  }
  double operator()(const Region& a, const Region& b,
                    const RW_segmentation::Region_boundary_of<Boundary>& boundary) const {
    if (choice_ == Merge_cost::learned) return learned_(a, b, boundary);
    if (choice_ == Merge_cost::size) return learned_.size_aware_cost(a, b, boundary);
    const auto& [common, first, second] = boundary;
    const RW_segmentation::Edge_sums whole = {
        first.difference.length + (second.difference.length - common.difference.length),
        first.difference.difference + (second.difference.difference - common.difference.difference)};
    return RW_segmentation::Relative_boundary_cost()({}, {}, {common.difference, whole});
  }

 private:
  Merge_cost choice_;
  RW_segmentation::Learned_cost learned_;
};

using Merge_cost_function = std::function<Chosen_merge_cost(const RW_segmentation::Dual_mesh&)>;

/// One of the solvers; a model of `WalkSolver`. A copy has analysed nothing.
class Chosen_solver {
 public:
  explicit Chosen_solver(Solver solver = Solver::star_mesh) {
    if (solver == Solver::eigen) solver_.emplace<RW_segmentation::Eigen_walk_solver<>>();
  }

  void analyze(const RW_segmentation::Dual_graph& graph) {
    std::visit([&](auto& solver) { solver.analyze(graph); }, solver_);
  }
  void factorize(const std::vector<double>& conductances, const std::vector<Face_number>& absorbing_faces,
                 const RW_segmentation::Progress& progress = {}) {
    std::visit([&](auto& solver) { solver.factorize(conductances, absorbing_faces, progress); }, solver_);
  }
  void potentials(const RW_segmentation::Potentials& boundary_values, RW_segmentation::Potentials& potentials) const {
    std::visit([&](const auto& solver) { solver.potentials(boundary_values, potentials); }, solver_);
  }
  void response(Face_number face, const std::vector<double>& boundary_values, std::vector<double>& column) const {
    std::visit([&](const auto& solver) { solver.response(face, boundary_values, column); }, solver_);
  }
  std::vector<double> absorbed_currents(Face_number face) const {
    return std::visit([&](const auto& solver) { return solver.absorbed_currents(face); }, solver_);
  }

 private:
  std::variant<RW_segmentation::Star_mesh_elimination, RW_segmentation::Eigen_walk_solver<>> solver_;
};

using Policies = RW_segmentation::Segmentation_policies<Difference_function, Seeding_function, Chosen_solver,
                                                        Merge_cost_function, RW_segmentation::Any_stop>;

/// How segments are found: the choices, and the numbers that go with them.
struct Method {
  Difference difference = Difference::concavity;
  Seeding seeding = Seeding::farthest;
  Merge_cost merge_cost = Merge_cost::learned;
  Solver solver = Solver::star_mesh;
  Components components = Components::each;

  RW_segmentation::Normal_smoothing smoothing;
  RW_segmentation::Dihedral_difference_policy angles = RW_segmentation::smoothed_concavity();   ///< unless by curvature
  RW_segmentation::Ball_radius radius = RW_segmentation::Curvature_difference_policy().radius;  ///< of curvatures
  double sigma = 1, cap = 20;                                                                   ///< of the conductance
  std::optional<std::size_t> seeds;     ///< for all, but coarse ones can do without a number
  bool are_seeds_exact = false;         ///< whether a number of coarse seeds that cannot be had is an error
  std::optional<std::size_t> segments;  ///< without it as many as the shape suggests
  std::size_t seedings = 1;             ///< whose consensus is taken
};

/// The angles that make faces differ where fragments are merged.
inline RW_segmentation::Dihedral_difference_policy angles_of(Difference difference) {
  return difference == Difference::concavity ? RW_segmentation::smoothed_concavity()
                                             : RW_segmentation::Dihedral_difference_policy();
}

/// Takes the numbers that belong to no single policy from one of the library's own methods.
template <class Preset>
void take_numbers(const Preset& preset, Method& method) {
  method.smoothing = preset.smoothing;
  method.sigma = preset.sigma;
  method.cap = preset.cap;
  if (method.seeding != Seeding::coarse) method.seeds = preset.seeding.count;
}

/// How often seeds are placed where the user does not tell: several times for a cost that is 1 where it is as well to merge as
/// not to, which tells what seedings agree on, and for seeds that are far apart, as those of all further seedings are.
inline std::size_t usual_seedings(Seeding seeding, Merge_cost merge_cost) {
  return merge_cost == Merge_cost::learned && seeding == Seeding::farthest
             ? RW_segmentation::Automatic_segmentation().seedings
             : 1;
}

/// What tells how large parts are where the user does not: other seedings are those of the whole, as in the library.
inline Components usual_components(Seeding seeding) {
  return seeding == Seeding::farthest ? Components::each : Components::whole;
}

/// How segments are found, as a user says it. What is not given is left to the library's own numbers.
struct Choices {
  bool is_coarse = false, is_paper = false;
  std::optional<std::size_t> segments, automatic_seeds, seedings;
  std::optional<Difference> difference;
  std::optional<Seeding> seeding;
  std::optional<Merge_cost> merge_cost;
  std::optional<Solver> solver;
  std::optional<Components> components;
  std::optional<double> smoothing, convex_weight, radius, sigma, cap;
  std::optional<RW_segmentation::Dihedral_measure> measure;
};

/// The angles that make faces differ, by the user's numbers where they are given.
/// \param are_seeds_segments whether each label of a seed of the user's is a segment
inline RW_segmentation::Dihedral_difference_policy angles_of(const Choices& choices, Difference difference,
                                                             bool are_seeds_segments) {
  RW_segmentation::Dihedral_difference_policy angles = angles_of(difference);
  if (difference == Difference::concavity) {
    if (are_seeds_segments) angles = RW_segmentation::seeded_concavity();
    if (choices.is_coarse) angles.ordinary_difference = 0;  // nothing is merged over slight concavities
  }
  angles.convex_weight = choices.convex_weight.value_or(angles.convex_weight);
  angles.measure = choices.measure.value_or(angles.measure);
  return angles;
}

/// One of the library's own ways of finding segments, with as many segments as asked for.
template <class Preset>
Preset preset_of(const Choices& choices) {
  return choices.segments ? Preset(*choices.segments) : Preset();
}

/// How segments are found: as agrees best with people or as in the paper, and otherwise as asked for.
/// \param are_seeds_segments whether each label of a seed of the user's is a segment
/// \throws std::invalid_argument if no seeds are asked for
inline Method method_of(const Choices& choices, bool are_seeds_segments) {
  if (choices.automatic_seeds == std::size_t(0)) throw std::invalid_argument("seeds is 0, but must be at least 1");
  Method method;
  method.seeding = choices.seeding.value_or(choices.is_coarse  ? Seeding::coarse
                                            : choices.is_paper ? Seeding::particles
                                                               : Seeding::farthest);
  method.difference = choices.difference.value_or(choices.is_paper ? Difference::dihedral : Difference::concavity);
  method.merge_cost = choices.merge_cost.value_or(choices.is_paper ? Merge_cost::boundary : Merge_cost::learned);
  method.solver = choices.solver.value_or(method.solver);
  if (choices.is_paper)
    take_numbers(preset_of<RW_segmentation::Paper_segmentation>(choices), method);
  else
    take_numbers(preset_of<RW_segmentation::Automatic_segmentation>(choices), method);

  method.smoothing.radius = choices.smoothing.value_or(method.smoothing.radius);
  method.angles = angles_of(choices, method.difference, are_seeds_segments);
  if (choices.radius) method.radius = RW_segmentation::Ball_radius::in_edge_lengths(*choices.radius);
  method.sigma = choices.sigma.value_or(method.sigma);
  method.cap = choices.cap.value_or(method.cap);
  method.segments = choices.segments;
  method.components = choices.components.value_or(usual_components(method.seeding));
  method.seedings = choices.seedings.value_or(usual_seedings(method.seeding, method.merge_cost));
  if (choices.automatic_seeds) {
    method.seeds = choices.automatic_seeds;
  } else if (choices.segments && method.seeding == Seeding::coarse) {
    // Of twice as many fragments as segments there is something to choose from.
    method.seeds = choices.is_coarse ? *choices.segments : 2 * *choices.segments;
  }
  method.are_seeds_exact = choices.is_coarse || choices.automatic_seeds;
  return method;
}

/// As many segments as the shape suggests: where merging stops by itself depends on what it costs.
inline RW_segmentation::Any_stop stop_by_shape(Merge_cost cost) {
  return cost == Merge_cost::boundary ? RW_segmentation::Paper_segmentation().stop
                                      : RW_segmentation::Automatic_segmentation().stop;
}

inline Difference_function difference_function(const Method& method) {
  if (method.difference == Difference::curvature)
    return [policy = RW_segmentation::Curvature_difference_policy{method.radius}](
               const auto& mesh, const auto& progress) { return policy(mesh, progress); };
  return [policy = method.angles](const auto& mesh, const auto&) { return policy(mesh); };
}

/// Where the placing of coarse seeds ends.
inline std::function<bool(const std::vector<double>&)> coarse_stop(const Method& method, std::size_t faces) {
  if (method.seeds && method.are_seeds_exact) return RW_segmentation::Seed_count_stop(*method.seeds);
  if (method.seeds)  // and one for each component, whose separation is infinite
    return [most = std::min(*method.seeds, faces)](const std::vector<double>& separation) {
      return separation.size() > most && std::isfinite(separation.back());
    };
  if (method.difference == Difference::concavity) return RW_segmentation::Separation_threshold_stop();
  return RW_segmentation::Separation_decrease_stop();
}

/// Coarse seeds for the difference of the walk, or where that is concavity for one that heeds convex creases, too, which
/// tells parts apart best.
inline std::vector<Face_number> coarse_seeds(const Method& method, const RW_segmentation::Dual_mesh& mesh,
                                             const std::vector<double>& difference,
                                             const std::vector<Face_number>& given,
                                             const RW_segmentation::Progress& progress) {
  constexpr double convex_weight = 0.5;
  const RW_segmentation::Coarse_seeding<std::function<bool(const std::vector<double>&)>> seeding = {
      coarse_stop(method, mesh.number_of_faces())};
  if (method.difference != Difference::concavity) return seeding(mesh, difference, given, progress);
  const RW_segmentation::Dihedral_difference_policy angles = {convex_weight, method.angles.measure};
  return seeding(mesh, angles(mesh), given, progress);
}

inline Seeding_function seeding_function(const Method& method) {
  namespace RW = RW_segmentation;
  switch (method.seeding) {
    case Seeding::farthest:
      return RW::Feature_sensitive_seeding<RW::Farthest_point_sampling>{method.seeds.value_or(0), {}};
    case Seeding::particles:
      return RW::Feature_sensitive_seeding<RW::Particle_sampling>{method.seeds.value_or(0), {}};
    case Seeding::coarse:
      break;
  }
  return [method](const auto& mesh, const auto& difference, const auto& given, const auto& progress) {
    return coarse_seeds(method, mesh, difference, given, progress);
  };
}

inline Merge_cost_function merge_cost_function(const Method& method) {
  RW_segmentation::Learned_cost_policy policy;
  if (method.merge_cost == Merge_cost::boundary) policy.thickness.samples = 0;
  return [policy, choice = method.merge_cost](const auto& mesh) { return Chosen_merge_cost(choice, policy(mesh)); };
}

/// The policies that a method stands for.
inline Policies policies_of(const Method& method) {
  Policies policies;
  policies.smoothing = method.smoothing;
  policies.difference = difference_function(method);
  policies.sigma = method.sigma;
  policies.cap = method.cap;
  policies.seeding = seeding_function(method);
  policies.solver = Chosen_solver(method.solver);
  policies.merge_cost = merge_cost_function(method);
  policies.seedings = method.seedings;
  policies.by_component = method.components == Components::each;
  policies.concurrent_components = true;
  policies.stop =
      method.segments ? RW_segmentation::Segment_count_stop(*method.segments) : stop_by_shape(method.merge_cost);
  return policies;
}

}  // namespace segment_mesh

#endif
