// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_APPLY_POLICIES_H
#define RW_SEGMENTATION_INTERNAL_APPLY_POLICIES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/merging/Region_merging.h>
#include <RW_segmentation/internal/property_maps.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Calls a policy, which may tell its progress or not.
template <class Policy, class... Arguments>
auto call_policy(const Policy& policy, const Progress& progress, const Arguments&... arguments) {
  if constexpr (std::is_invocable_v<const Policy&, const Arguments&..., const Progress&>)
    return policy(arguments..., progress);
  else
    return policy(arguments...);
}

/// A mesh made of another one, with that one's descriptors if it has any.
inline Dual_mesh with_descriptors(Dual_mesh made, const Dual_mesh&) { return made; }
template <class Mesh>
Dual_mesh_of<Mesh> with_descriptors(Dual_mesh made, const Dual_mesh_of<Mesh>& mesh) {
  return {std::move(made), mesh};
}

/// An edge map, or an array that a difference policy has made, in the order of the edges.
template <class Mesh, class Differences>
std::vector<double> read_differences(const Dual_mesh_of<Mesh>& mesh, Differences&& differences) {
  if constexpr (std::is_same_v<std::decay_t<Differences>, std::vector<double>>) {
    if (differences.size() != mesh.number_of_edges())
      throw std::invalid_argument("the difference has " + std::to_string(differences.size()) +
                                  " values, but the mesh " + std::to_string(mesh.number_of_edges()) +
                                  " interior edges");
    mesh.check_edges(differences, "the difference");
    return std::forward<Differences>(differences);
  } else {
    return mesh.read_edges(differences, "the difference");
  }
}

/// The difference of each edge by a policy.
/// \throws std::invalid_argument, Cancelled
template <class Policy, class Mesh>
std::vector<double> differences_by(const Policy& policy, const Dual_mesh_of<Mesh>& mesh, const Progress& progress) {
  constexpr bool is_map = is_readable_map<Policy, typename boost::graph_traits<Mesh>::edge_descriptor>;
  constexpr bool is_function = std::is_invocable_v<const Policy&, const Dual_mesh_of<Mesh>&> ||
                               std::is_invocable_v<const Policy&, const Dual_mesh_of<Mesh>&, const Progress&>;
  static_assert(
      is_map || is_function,
      "A difference is a readable property map from the mesh's edge_descriptor to double, or a function object "
      "from a Dual_mesh_of to one or to a std::vector<double> by edge.");
  if constexpr (is_map)
    return mesh.read_edges(policy, "the difference");
  else
    return read_differences(mesh, call_policy(policy, progress, mesh));
}

/// The differences of the library's own policies need no check.
template <class Policy>
std::vector<double> differences_by(const Policy& policy, const Dual_mesh& mesh, const Progress& progress) {
  return call_policy(policy, progress, mesh);
}

/// The given seeds and those that a policy adds, each once.
/// \tparam Mesh a `Dual_mesh_of`, or a `Dual_mesh`
/// \throws std::invalid_argument, Cancelled
template <class Policy, class Mesh>
std::vector<Dual_mesh::Index> seeds_by(const Policy& policy, const Mesh& mesh, const std::vector<double>& difference,
                                       const std::vector<Dual_mesh::Index>& given, const Progress& progress) {
  using Index = Dual_mesh::Index;
  static_assert(
      std::is_invocable_v<const Policy&, const Mesh&, const std::vector<double>&, const std::vector<Index>&> ||
          std::is_invocable_v<const Policy&, const Mesh&, const std::vector<double>&, const std::vector<Index>&,
                              const Progress&>,
      "A seeding is a function object from a Dual_mesh_of, its differences by edge and the given seeds to a "
      "range of numbers of faces.");
  std::vector<Index> seeds = given;
  std::vector<bool> is_seed(mesh.number_of_faces(), false);
  for (const Index face : given) is_seed[face] = true;
  for (const auto seed : call_policy(policy, progress, mesh, difference, given)) {
    // Whatever integer it is, it must not become another one that is a face.
    if (static_cast<std::size_t>(seed) >= mesh.number_of_faces())
      throw std::invalid_argument("seed " + std::to_string(seed) + " of the seeding policy is not a face of the mesh");
    const auto face = static_cast<Index>(seed);
    if (!is_seed[face]) seeds.push_back(face);
    is_seed[face] = true;
  }
  return seeds;
}

/// A merge cost, or the one that a policy makes of a mesh.
/// \tparam Mesh a `Dual_mesh_of`, or a `Dual_mesh`
template <class Policy, class Mesh>
auto merge_cost_by(const Policy& policy, const Mesh& mesh) {
  constexpr bool is_cost = is_merge_cost<Policy, Mesh>;
  static_assert(
      is_cost || std::is_invocable_v<const Policy&, const Mesh&>,
      "A merge cost has a type Region and the functions region(), join() and operator(), all of them const, or it "
      "is a function object from a Dual_mesh_of to such a one.");
  if constexpr (is_cost)
    return policy;
  else
    return policy(mesh);
}

/// The type of that merge cost.
template <class Policy, class Mesh>
using Merge_cost_by = decltype(merge_cost_by(std::declval<const Policy&>(), std::declval<const Mesh&>()));

}  // namespace RW_segmentation::internal

#endif
