// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_SEGMENTATION_VIA_RANDOM_WALKS_H
#define RW_SEGMENTATION_SEGMENTATION_VIA_RANDOM_WALKS_H

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Segmentation_policies.h>
#include <RW_segmentation/Segmentation_report.h>
#include <RW_segmentation/internal/apply_policies.h>
#include <RW_segmentation/internal/long_tasks.h>
#include <RW_segmentation/internal/merging/Consensus_cost.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/seeds/read_seeds.h>
#include <RW_segmentation/internal/threads.h>
#include <RW_segmentation/internal/walk/further_seedings.h>
#include <RW_segmentation/internal/walk/make_solver.h>
#include <RW_segmentation/internal/walk/walk_fragments.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// What policies make of a mesh.
struct Merged_fragments {
  Merge_tree tree;
  std::vector<std::size_t> fragment_of_face;
  Segmentation_report report;

  Merged_fragments();
  Merged_fragments(Merged_fragments&&) noexcept;
  Merged_fragments& operator=(Merged_fragments&&) noexcept;
  ~Merged_fragments();
};

/// Refuses no seeding.
/// \throws std::invalid_argument
void require_seedings(std::size_t seedings);

/// Refuses what is no share of an area.
/// \throws std::invalid_argument if it is negative or NaN
void require_least_component(double share);

/// Segments a mesh that has been read: seeds, walk, merging.
/// \tparam Mesh a `Dual_mesh_of`, or `Dual_mesh` for policies that ask for no descriptors
/// \param begin when its reading began
template <class ConcurrencyTag, class Mesh, class Policies>
Merged_fragments segment_by_policies(const Mesh& mesh, const Policies& policies,
                                     const std::vector<Dual_mesh::Index>& given, const Progress& progress,
                                     Stage_clock::Time begin) {
  Merged_fragments merged;
  Segmentation_report& report = merged.report;
  Stage_clock clock(report.stages, begin);
  clock.note("mesh");
  Mesh shape = mesh;
  std::vector<double> difference, conductance;
  Components component;
  const auto prepare_walk = [&] {
    shape = with_descriptors(shape_of(mesh, policies.smoothing, progress.part(0, 0.25)), mesh);
    clock.note("normals");
    difference = differences_by(policies.difference, shape, progress.part(0.25, 0.3));  // Eq. 4-5, 7-8
    conductance = conductances(shape, difference, policies.sigma, policies.cap);        // Eq. 6
    component = Components(shape.graph(), [&](auto edge) { return conductance[edge] > 0; });
    report.components = component.count;
    clock.note("conductances");
  };
  // The order of elimination depends on none of these, nor the merge cost on seeds and walk. Of what is done at the same
  // time, the stages tell how long the rest of it was waited for.
  const bool is_reduced = mesh.number_of_faces() > policies.reduction.largest_direct;
  auto solver = make_solver(policies.solver);
  const auto order = [&] {
    if (!is_reduced) solver.analyze(mesh.graph());
  };
  at_the_same_time<ConcurrencyTag>(order, prepare_walk);
  clock.note("ordering");

  std::vector<Dual_mesh::Index> seeds;
  Fragments fragments;
  std::optional<Common_refinement> refinement;
  const auto new_solver = [&] { return make_solver(policies.solver); };
  const auto walk = [&] {
    seeds = seeds_by(policies.seeding, shape, difference, given, progress.part(0.3, 0.4));
    clock.note("seeds");
    const Walk_network network = {shape.graph(), conductance, component};
    const Progress part = progress.part(0.4, 0.8);
    fragments = is_reduced ? walk_fragments_over_clusters(network, shape.edge_lengths(), seeds, policies.reduction,
                                                          new_solver, part)
                           : walk_fragments(network, std::move(solver), seeds, part);
    clock.note("walk");
    if (policies.seedings == 1 || seeds.size() == given.size()) return;
    refinement = refine_by_further_seedings(shape, network, {seeds, given.size(), fragments.of_face, is_reduced},
                                            policies.seedings - 1, new_solver, progress.part(0.8, 0.9));
    clock.note("other seedings");
  };
  std::optional<Merge_cost_by<decltype(policies.merge_cost), Mesh>> cost;
  const auto walk_and_free = [&] {
    walk();
    std::vector<double>().swap(conductance);
    component = {};
  };
  at_the_same_time<ConcurrencyTag>([&] { cost.emplace(merge_cost_by(policies.merge_cost, shape)); }, walk_and_free);
  clock.note("thickness");

  report.seeds = seeds.size();
  report.clusters = fragments.clusters;
  report.degenerate_faces = shape.number_of_degenerate_faces();
  report.island_faces = fragments.island_faces;
  report.has_heavy_noise = &shape.points() != &mesh.points();
  if (refinement) {
    merged.tree = merge_by_consensus(shape, *refinement, difference, *cost, progress.part(0.9, 1));
    merged.fragment_of_face = std::move(refinement->of_face);
  } else {
    const std::size_t number_of_fragments = *std::max_element(fragments.of_face.begin(), fragments.of_face.end()) + 1;
    merged.tree =
        merge_fragments(shape, fragments.of_face, number_of_fragments, difference, *cost, progress.part(0.9, 1));
    merged.fragment_of_face = std::move(fragments.of_face);
  }
  report.fragments = merged.tree.number_of_fragments();
  clock.note("merging");
  progress(1);
  return merged;
}

/// The segmentation of a mesh from those of its connected components, in the order of the faces.
/// \param reading_seconds that the stage before took
/// \param seconds that all took, several at the same time perhaps: each of their stages has its share of it
Merged_fragments whole_of(std::vector<Merged_fragments> components, double reading_seconds, double seconds);

/// The seeds in each component, as numbers of its faces.
std::vector<std::vector<Dual_mesh::Index>> seeds_of_components(const std::vector<Mesh_stretch>& components,
                                                               const std::vector<Dual_mesh::Index>& seeds);

/// The area of each component.
std::vector<double> areas_of(const std::vector<Mesh_stretch>& components, const Dual_mesh& mesh);

/// Whether an edge of a component is a wall.
bool has_walls(const Mesh_stretch& component, const Dual_mesh& mesh);

/// A component that is one segment.
Merged_fragments one_segment(const Mesh_stretch& component, const Dual_mesh& mesh);

/// As above, each connected component as it is by itself where the policies say so.
template <class ConcurrencyTag, class Mesh, class Policies>
Merged_fragments segment_components_by_policies(const Mesh& mesh, const Policies& policies,
                                                const std::vector<Dual_mesh::Index>& given, const Progress& progress,
                                                Stage_clock::Time begin) {
  std::vector<Mesh_stretch> components;
  if (policies.by_component) components = connected_stretches(mesh.graph());
  if (components.size() <= 1) return segment_by_policies<ConcurrencyTag>(mesh, policies, given, progress, begin);

  const Stage_clock::Time begin_of_components = Stage_clock::now();
  const std::vector<double> area = areas_of(components, mesh);
  const double least_area = policies.least_component * *std::max_element(area.begin(), area.end());
  const auto seeds = seeds_of_components(components, given);
  std::vector<Merged_fragments> segmented(components.size());
  const auto segment = [&](std::size_t i, const Progress& part) {
    const bool is_large = area[i] >= least_area || !seeds[i].empty() || has_walls(components[i], mesh);
    segmented[i] = is_large ? segment_by_policies<ConcurrencyTag>(mesh.component(components[i]), policies, seeds[i],
                                                                  part, Stage_clock::now())
                            : one_segment(components[i], mesh);
    part(1);
  };
  long_tasks(sizes_of(components), progress, segment, policies.concurrent_components);
  return whole_of(std::move(segmented), Stage_clock::seconds(begin, begin_of_components),
                  Stage_clock::seconds(begin_of_components, Stage_clock::now()));
}

/// By the library's own policies, which ask for no descriptors.
template <class ConcurrencyTag>
Merged_fragments segment_by_automatic_policies(const Dual_mesh& mesh, const Automatic_policies& policies,
                                               const std::vector<Dual_mesh::Index>& given, const Progress& progress,
                                               Stage_clock::Time begin);

/// Segments a mesh that has been read by any policies; what a mesh without faces becomes is empty.
template <class ConcurrencyTag, class FaceListGraph, class Policies, class SeedRange>
Merged_fragments merged_fragments(const Dual_mesh_of<FaceListGraph>& mesh, const Policies& policies,
                                  const SeedRange& given_seeds, const Progress& progress, Stage_clock::Time begin) {
  const std::vector<Dual_mesh::Index> given = read_seeds(mesh, given_seeds);
  if (mesh.number_of_faces() == 0) return {};
  if constexpr (std::is_convertible_v<const Policies*, const Automatic_policies*>)
    return segment_by_automatic_policies<ConcurrencyTag>(mesh, policies, given, progress, begin);
  else
    return segment_components_by_policies<ConcurrencyTag>(mesh, policies, given, progress, begin);
}

/// The segment of each face where merging stops at a number of segments.
/// \throws std::invalid_argument if there are more components or fewer fragments than that
std::vector<std::size_t> segment_of_faces(const Merged_fragments& merged, std::size_t number_of_segments);

/// Whether policies and named parameters are such; says so where they are not.
template <class Policies, class NamedParameters>
constexpr bool are_arguments() {
  static_assert(
      is_segmentation_policies<Policies>,
      "Segmentation_policies are needed here, such as Automatic_segmentation(6) for six segments, or CGAL's named "
      "parameters.");
  static_assert(
      has_only_names_of_stages<NamedParameters>,
      "Segmentation via random walks takes the named parameters vertex_point_map, edge_is_constrained_map and "
      "callback.");
  return is_segmentation_policies<Policies> && has_only_names_of_stages<NamedParameters>;
}

}  // namespace internal

/// Segments a mesh into a hierarchy: seeds place themselves, walks from them make fragments, and fragments are merged
/// until each connected component is one segment (section 4.2 of the paper).
///
/// `hierarchy.segments(stop, ids)` then writes any level. Parameters, errors and complexity are those of
/// `segmentation_via_random_walks()`; the stop of the policies is not asked.
template <
    class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph,
    class Policies = Automatic_segmentation,
    class SeedRange = std::array<typename boost::graph_traits<FaceListGraph>::face_descriptor, 0>,
    class NamedParameters = CGAL::parameters::Default_named_parameters,
    std::enable_if_t<!internal::is_named_parameters<Policies> && !internal::is_named_parameters<SeedRange>, int> = 0>
Random_walk_hierarchy<typename internal::Mesh_type<FaceListGraph>::type> hierarchy_via_random_walks(
    const FaceListGraph& mesh, const Policies& policies = Policies(), const SeedRange& given_seeds = {},
    const NamedParameters& np = CGAL::parameters::default_values()) {
  using Hierarchy = Random_walk_hierarchy<typename internal::Mesh_type<FaceListGraph>::type>;
  static_assert(internal::are_arguments<Policies, NamedParameters>());
  internal::require_reduction_numbers(policies.reduction);
  internal::require_seedings(policies.seedings);
  internal::require_least_component(policies.least_component);
  return internal::with_threads<ConcurrencyTag>([&]() -> Hierarchy {
    const internal::Stage_clock::Time begin = internal::Stage_clock::now();
    const auto& dual = internal::dual_mesh(mesh, np);
    internal::Merged_fragments merged =
        internal::merged_fragments<ConcurrencyTag>(dual, policies, given_seeds, internal::progress_of(np), begin);
    return {{std::move(merged.tree), dual.face_descriptors(), std::move(merged.fragment_of_face)},
            std::move(merged.report)};
  });
}

/// As above, with named parameters after the mesh or the policies.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class NamedParameters,
          std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
auto hierarchy_via_random_walks(const FaceListGraph& mesh, const NamedParameters& np) {
  return hierarchy_via_random_walks<ConcurrencyTag>(mesh, Automatic_segmentation(), internal::no_seeds<FaceListGraph>,
                                                    np);
}

/// \overload
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class Policies,
          class NamedParameters, std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
auto hierarchy_via_random_walks(const FaceListGraph& mesh, const Policies& policies, const NamedParameters& np) {
  return hierarchy_via_random_walks<ConcurrencyTag>(mesh, policies, internal::no_seeds<FaceListGraph>, np);
}

/// Segments a mesh by itself: in one call, without seeds of the user, into as many segments as the shape suggests or as
/// many as asked for.
///
/// \code
/// std::size_t segments = segmentation_via_random_walks(mesh, ids);                  // as many as there are
/// segmentation_via_random_walks(mesh, ids, Automatic_segmentation(6));              // six
/// segmentation_via_random_walks(mesh, ids, Paper_segmentation());                   // see Paper_segmentation.h
/// segmentation_via_random_walks(mesh, ids, CGAL::parameters::edge_is_constrained_map(walls));
/// \endcode
///
/// Connected components are never joined: each is one segment or several, those that it has by itself unless the policies say
/// otherwise (`Segmentation_policies::by_component`). The result depends on the mesh alone, not on
/// chance or on the number of threads, and not on the mesh's position and size.
///
/// Complexity: that of the walk, O(m^1.3) time and O(m log m) memory for m faces in practice; see
/// `Star_mesh_elimination`. The walk of large meshes is reduced, which takes about O(m^1.1) time and O(m) memory; see
/// `Walk_reduction`. Where TBB is linked (`CGAL_LINKED_WITH_TBB`), its threads share the work; the map of a difference and
/// that of a merge cost may then be read from two threads, each map from one.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph` with faces of any degree, or a `Dual_mesh_of` one
/// \tparam SegmentIdMap a writable property map from `face_descriptor` to `std::size_t`
/// \tparam Policies one of `Segmentation_policies`: `Automatic_segmentation`, `Paper_segmentation`,
/// `Coarse_paper_segmentation`, or these with policies of one's own
/// \tparam SeedRange a range of faces, or of pairs of a face and anything
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh, its faces oriented outward
/// \param segment_ids output, contiguous ids from 0
/// \param policies difference, seeding, solver, merge cost and stop, with the number of segments if it is known
/// \param given_seeds faces of the user's to start walks from besides the automatic ones, where a part is too small to
/// get a seed by itself
/// \param np may follow `segment_ids` or `policies` directly
/// - `vertex_point_map` (default: that of the mesh)
/// - `edge_is_constrained_map` (readable map from `edge_descriptor` to `bool`, default: no edge is): walls. Seed distances,
/// walks and merging do not cross the marked edges; no segment lies on both sides, unless it reaches round their end
/// - `callback` (`std::function<bool(double)>`, default: none): receives the fraction done, returns `false` to cancel
/// \returns the number of segments
/// \throws std::invalid_argument if the number of segments asked for is less than that of the components or more than
/// that of the fragments, the map has values for fewer segments, a number of the policies is out of range, a value of the
/// difference negative or NaN, a coordinate not finite, or a seed is not a face of the mesh; nothing is written then
/// \throws Cancelled
template <
    class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap,
    class Policies = Automatic_segmentation,
    class SeedRange = std::array<typename boost::graph_traits<FaceListGraph>::face_descriptor, 0>,
    class NamedParameters = CGAL::parameters::Default_named_parameters,
    std::enable_if_t<!internal::is_named_parameters<Policies> && !internal::is_named_parameters<SeedRange>, int> = 0>
std::size_t segmentation_via_random_walks(const FaceListGraph& mesh, SegmentIdMap segment_ids,
                                          const Policies& policies = Policies(), const SeedRange& given_seeds = {},
                                          const NamedParameters& np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(internal::is_writable_map<SegmentIdMap, face_descriptor>,
                "segment_ids must be a writable property map from the mesh's face_descriptor to std::size_t.");
  if constexpr (internal::is_writable_map<SegmentIdMap, face_descriptor> &&
                internal::are_arguments<Policies, NamedParameters>()) {
    internal::require_reduction_numbers(policies.reduction);
    internal::require_seedings(policies.seedings);
    internal::require_least_component(policies.least_component);
    return internal::with_threads<ConcurrencyTag>([&] {
      const internal::Stage_clock::Time begin = internal::Stage_clock::now();
      const auto& dual = internal::dual_mesh(mesh, np);
      const internal::Merged_fragments merged =
          internal::merged_fragments<ConcurrencyTag>(dual, policies, given_seeds, internal::progress_of(np), begin);
      const std::size_t segments = internal::segments_at_stop(merged.tree, policies.stop);
      const std::vector<std::size_t> ids = internal::segment_of_faces(merged, segments);
      internal::require_ids_fit<SegmentIdMap>(ids);
      dual.write_faces(ids, segment_ids);
      return segments;
    });
  } else {
    return 0;
  }
}

/// As above, with named parameters after the output or the policies.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap,
          class NamedParameters, std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
std::size_t segmentation_via_random_walks(const FaceListGraph& mesh, SegmentIdMap segment_ids,
                                          const NamedParameters& np) {
  return segmentation_via_random_walks<ConcurrencyTag>(mesh, segment_ids, Automatic_segmentation(),
                                                       internal::no_seeds<FaceListGraph>, np);
}

/// \overload
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap,
          class Policies, class NamedParameters,
          std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
std::size_t segmentation_via_random_walks(const FaceListGraph& mesh, SegmentIdMap segment_ids, const Policies& policies,
                                          const NamedParameters& np) {
  return segmentation_via_random_walks<ConcurrencyTag>(mesh, segment_ids, policies, internal::no_seeds<FaceListGraph>,
                                                       np);
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/segmentation_via_random_walks.h>
#endif

#endif
