// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_MERGE_SEGMENTS_H
#define RW_SEGMENTATION_MERGE_SEGMENTS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Relative_boundary_cost.h>
#include <RW_segmentation/Segment_hierarchy.h>
#include <RW_segmentation/Size_aware_cost.h>
#include <RW_segmentation/internal/merging/Region_merging.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/rank_labels.h>
#include <RW_segmentation/internal/threads.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// Merges the segments of a mesh pairwise, always the two neighbours that cost least, until each connected component is
/// one segment, and records every merge (4.2.2).
///
/// When to stop is decided afterwards, by `Segment_hierarchy::segments()`, as often as wished:
/// \code
/// Segment_hierarchy hierarchy = merge_segments(mesh, ids, difference, Size_aware_cost());
/// hierarchy.segments(Segment_count_stop(6), ids);
/// \endcode
///
/// Segments are neighbours if they share a mesh edge. Those that share only edges without length are merged last, at
/// infinite cost. Equal costs: the pair with the lowest segment comes first. The result does not depend on the order of
/// the faces otherwise.
///
/// Complexity: O(m + b log b) for m faces and b edges between segments, and O(k log n) for each merge of two segments
/// with k neighbours out of n.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
/// \tparam SegmentIdMap a readable property map from `face_descriptor` to any integers; it may hold them with gaps
/// \tparam Difference a readable property map from `edge_descriptor` to a number >= 0, as for `Conductance`
/// \tparam MergeCost a model of `MergeCost`: a type `Region` (default-constructible, copyable), `region(mesh, face)` for
/// the region of one face of a `Dual_mesh`, `join(region, other)` to enlarge a region, `operator()(region, region,
/// Region_boundary)` for the cost of merging two, symmetric, not NaN; all of them const. With a type `Boundary` and
/// `boundary(mesh, edge, difference)` it has sums of its own along boundaries
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh
/// \param segment_ids the segments to start from, the fragments
/// \param difference how different the two faces of an edge are
/// \param cost of merging two segments; default: `Size_aware_cost` without thickness
/// \param np `vertex_point_map` (default: that of the mesh), `edge_is_constrained_map` (default: no edge is; no segments
/// are neighbours across the marked edges), `callback` (`std::function<bool(double)>`, default: none)
/// \returns the hierarchy; its fragments are numbered in the order of the given ids
/// \throws std::invalid_argument if a difference is negative or NaN (names the faces), a coordinate not finite (names
/// the vertex), or a cost NaN
/// \throws Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap,
          class Difference, class MergeCost = Size_aware_cost,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Segment_hierarchy<typename internal::Mesh_type<FaceListGraph>::type> merge_segments(
    const FaceListGraph& mesh, const SegmentIdMap& segment_ids, const Difference& difference,
    const MergeCost& cost = MergeCost(), const NamedParameters& np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(internal::is_readable_map<SegmentIdMap, face_descriptor>,
                "segment_ids must be a readable property map from the mesh's face_descriptor to an integer.");
  static_assert(
      internal::is_merge_cost<MergeCost, Dual_mesh_of<typename internal::Mesh_type<FaceListGraph>::type>>,
      "cost must be a model of MergeCost: a type Region, and the functions region(), join() and operator(), all of "
      "them const.");
  static_assert(internal::has_only_names_of_stages<NamedParameters>,
                "merge_segments() takes the named parameters vertex_point_map, edge_is_constrained_map and callback.");

  using Hierarchy = Segment_hierarchy<typename internal::Mesh_type<FaceListGraph>::type>;
  return internal::with_threads<ConcurrencyTag>([&]() -> Hierarchy {
    const auto& dual = internal::dual_mesh(mesh, np);
    const std::vector<double> differences = dual.read_edges(difference, "the difference");
    const auto ids = dual.read_faces(segment_ids, [](const auto& id) { return id; });
    std::vector<std::size_t> fragment_of_face;
    const std::size_t fragments = internal::rank_labels(ids, fragment_of_face).size();
    Merge_tree tree =
        internal::merge_fragments(dual, fragment_of_face, fragments, differences, cost, internal::progress_of(np));
    return {std::move(tree), dual.face_descriptors(), std::move(fragment_of_face)};
  });
}

/// As above, by `Size_aware_cost` without thickness, with named parameters after the difference.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap,
          class Difference, class T, class Tag, class Base>
auto merge_segments(const FaceListGraph& mesh, const SegmentIdMap& segment_ids, const Difference& difference,
                    const CGAL::Named_function_parameters<T, Tag, Base>& np) {
  return merge_segments<ConcurrencyTag>(mesh, segment_ids, difference, Size_aware_cost(), np);
}

}  // namespace RW_segmentation

#endif
