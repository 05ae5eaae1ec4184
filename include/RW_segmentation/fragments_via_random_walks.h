// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_FRAGMENTS_VIA_RANDOM_WALKS_H
#define RW_SEGMENTATION_FRAGMENTS_VIA_RANDOM_WALKS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/Walk_reduction.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/seeds/read_seeds.h>
#include <RW_segmentation/internal/threads.h>
#include <RW_segmentation/internal/walk/make_solver.h>
#include <RW_segmentation/internal/walk/read_conductances.h>
#include <RW_segmentation/internal/walk/walk_fragments.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// Makes a fragment of each seed: the faces from which a walk reaches that seed first (Eq. 1-3 of the paper). It is the stage
/// between seeding and `merge_segments()`, as `segmentation_via_random_walks()` has it.
///
/// On large meshes the walk is reduced, which `Random_walk` never does: that one keeps what edits and probabilities need,
/// this one only the fragments.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`, or a `Dual_mesh_of` one
/// \tparam ConductanceMap `Conductance`, or what `as_conductance()` makes of a map of one's own
/// \tparam SeedRange a range of face descriptors, or of pairs of a face descriptor and anything
/// \tparam FragmentIdMap a writable property map from `face_descriptor` to an integer
/// \tparam SolverPolicy a model of `WalkSolver`, which is copied, or a function object that returns one
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh; edge lengths are those of the shape where it is a `smoothed_shape()`
/// \param conductance how easily walks cross the edges
/// \param seeds where walks end; a face that is named twice counts once
/// \param fragment_ids output, from 0 on: by seed, for seeds that share their component with others, then a fragment for
/// each other component, with one seed or none
/// \param reduction from which size on the walk is reduced, and how far
/// \param solver what finds out where walks end
/// \param np `vertex_point_map` (default: that of the mesh), `edge_is_constrained_map` (default: no edge is), `callback`
/// (`std::function<bool(double)>`, `false` cancels)
/// \returns the number of fragments
/// \throws std::invalid_argument if a seed is not a face of the mesh, a conductance is negative or not finite, a coordinate
/// is not finite, or a number of `reduction` is out of range; nothing is written then
/// \throws Cancelled; nothing is written then
///
/// Complexity: that of the solver on the faces, or, reduced, on their clusters, and about O(n^1.1) for n faces.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class ConductanceMap,
          class SeedRange, class FragmentIdMap, class SolverPolicy = Star_mesh_elimination,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
std::size_t fragments_via_random_walks(const FaceListGraph& mesh, const ConductanceMap& conductance,
                                       const SeedRange& seeds, FragmentIdMap fragment_ids,
                                       const Walk_reduction& reduction = {},
                                       const SolverPolicy& solver = SolverPolicy(),
                                       const NamedParameters& np = CGAL::parameters::default_values()) {
  static_assert(internal::is_writable_map<FragmentIdMap, typename boost::graph_traits<FaceListGraph>::face_descriptor>,
                "fragment_ids must be a writable property map from the mesh's face_descriptor to an integer.");
  static_assert(
      internal::has_conductances<ConductanceMap>,
      "fragments_via_random_walks() needs conductances: Conductance(mesh, difference), or as_conductance(map) "
      "for values of your own.");
  static_assert(internal::has_only_names_of_stages<NamedParameters>,
                "fragments_via_random_walks() takes the named parameters vertex_point_map, edge_is_constrained_map and "
                "callback.");
  using Id = typename boost::property_traits<FragmentIdMap>::value_type;
  internal::require_reduction_numbers(reduction);
  return internal::with_threads<ConcurrencyTag>([&]() -> std::size_t {
    const Progress progress = internal::progress_of(np);
    progress(0);
    const auto& dual = internal::dual_mesh(mesh, np);
    const std::vector<Dual_mesh::Index> faces = internal::read_seeds(dual, seeds);
    const std::vector<double> conductances = internal::read_conductances(dual, conductance);
    if (dual.number_of_faces() == 0) return 0;
    const internal::Components component(dual.graph(), [&](auto edge) { return conductances[edge] > 0; });
    const internal::Walk_network network = {dual.graph(), conductances, component};
    const auto new_solver = [&] { return internal::make_solver(solver); };

    std::vector<std::size_t> fragment;
    if (dual.number_of_faces() > reduction.largest_direct) {
      fragment =
          internal::walk_fragments_over_clusters(network, dual.edge_lengths(), faces, reduction, new_solver, progress)
              .of_face;
    } else {
      auto analysed = new_solver();
      analysed.analyze(dual.graph());
      fragment = internal::walk_fragments(network, std::move(analysed), faces, progress).of_face;
    }
    // What may run out of memory comes before the first id is written.
    const std::size_t count = *std::max_element(fragment.begin(), fragment.end()) + 1;
    internal::require_ids_fit<FragmentIdMap>(fragment);
    dual.write_faces(std::vector<Id>(fragment.begin(), fragment.end()), fragment_ids);
    return count;
  });
}

/// As above, with named parameters after the output.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class ConductanceMap,
          class SeedRange, class FragmentIdMap, class NamedParameters,
          std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
std::size_t fragments_via_random_walks(const FaceListGraph& mesh, const ConductanceMap& conductance,
                                       const SeedRange& seeds, FragmentIdMap fragment_ids, const NamedParameters& np) {
  return fragments_via_random_walks<ConcurrencyTag>(mesh, conductance, seeds, fragment_ids, Walk_reduction(),
                                                    Star_mesh_elimination(), np);
}

}  // namespace RW_segmentation

#endif
