// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_SEGMENTATION_INTO_SURFACES_H
#define RW_SEGMENTATION_SEGMENTATION_INTO_SURFACES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Segmentation_report.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/threads.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// The numbers of `segmentation_into_surfaces()`.
struct Surface_segmentation {
  Surface_segmentation() = default;

  /// As many segments as that, at least one for each connected component.
  explicit Surface_segmentation(std::size_t segments) : number_of_segments(segments) {}

  std::optional<std::size_t> number_of_segments;  ///< without it, merging stops at `stop_cost`
  double stop_cost = 1;                           ///< the largest cost of a merge, see `Analytic_surface_cost`
  double noise = -1;  ///< standard deviation of the vertices, in parts of the diagonal; negative: estimated

  /// The number of segments to stop at.
  std::size_t stop(const Merge_tree& tree) const {
    return number_of_segments ? *number_of_segments : Cost_threshold_stop(stop_cost)(tree);
  }
};

namespace internal {

/// The segments of a mesh that has been read, from fragments to one for each component.
struct Segments_on_surfaces {
  Merge_tree tree;
  std::vector<std::size_t> fragment_of_face;
  std::vector<char> is_given;  ///< by face: whether it was left over, and tells nothing about its segment's surface
};

/// Surfaces, the walk between them, merging.
/// \param noise negative: estimated
Segments_on_surfaces segment_into_surfaces(const Dual_mesh& mesh, double noise, const Progress& progress,
                                           Segmentation_report& report, Stage_clock& clock);

/// The walk between surfaces that were found, and merging.
/// \param region_of_face see `Analytic_regions`
Segments_on_surfaces segments_of_regions(const Dual_mesh& mesh, const Surface_tolerance& tolerance,
                                         const std::vector<std::size_t>& region_of_face, const Progress& progress,
                                         Stage_clock& clock);

}  // namespace internal

/// Segments a mesh into a hierarchy of surfaces: the fragments are the regions of analytic surfaces, and the levels above
/// cost 1 join segments that no surface fits.
///
/// `hierarchy.segments(stop, ids)` then writes any level. Parameters, errors and complexity are those of
/// `segmentation_into_surfaces()`.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Random_walk_hierarchy<typename internal::Mesh_type<FaceListGraph>::type> hierarchy_of_surfaces(
    const FaceListGraph& mesh, const Surface_segmentation& numbers = Surface_segmentation(),
    const NamedParameters& np = CGAL::parameters::default_values()) {
  static_assert(
      internal::has_only_names_of_stages<NamedParameters>,
      "Segmentation into surfaces takes the named parameters vertex_point_map, edge_is_constrained_map and callback.");
  using Hierarchy = Random_walk_hierarchy<typename internal::Mesh_type<FaceListGraph>::type>;
  return internal::with_threads<ConcurrencyTag>([&]() -> Hierarchy {
    Segmentation_report report;
    internal::Stage_clock clock(report.stages);
    const auto& dual = internal::dual_mesh(mesh, np);
    clock.note("mesh");
    internal::require_noise(numbers.noise);
    internal::require_cost("stop_cost", numbers.stop_cost);
    if (dual.number_of_faces() == 0) return {};
    internal::Segments_on_surfaces segments =
        internal::segment_into_surfaces(dual, numbers.noise, internal::progress_of(np), report, clock);
    return {{std::move(segments.tree), dual.face_descriptors(), std::move(segments.fragment_of_face)},
            std::move(report)};
  });
}

/// As above, with named parameters after the mesh.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class NamedParameters,
          std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
auto hierarchy_of_surfaces(const FaceListGraph& mesh, const NamedParameters& np) {
  return hierarchy_of_surfaces<ConcurrencyTag>(mesh, Surface_segmentation(), np);
}

/// Segments a part of a machine in one call: each segment is a plane, sphere, cylinder, cone or torus, or a free form that
/// none of these fits. Joints may be sharp or smooth, the mesh even, noisy, or as CAD kernels make it.
///
/// \code
/// const std::size_t segments = segmentation_into_surfaces(mesh, ids);
/// for (const Analytic_surface& surface : segment_surfaces(mesh, ids, segments)) ...
/// \endcode
///
/// Surfaces are fitted to neighbourhoods of faces and grown as far as vertices and normals agree. What none of them
/// explains is given to its neighbours by a random walk from the regions found, or, where it is large, becomes a
/// segment. Regions are merged by `Analytic_surface_cost` while one surface fits both. The expected deviation of the
/// vertices is estimated from the mesh.
///
/// Connected components are never joined. The result depends on the mesh alone, not on chance or on the number of threads,
/// and not on the mesh's position and size. A mesh that has its own normals, such as `smoothed_shape()`, is seen by these.
///
/// Complexity: linear in the number of faces for meshes whose regions have several faces each; the time of a few fits, 0.1
/// to 0.2 ms, for each face that no region holds on coarse meshes, and less on fine ones. Where TBB is linked, its threads share the work that pays.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph` with faces of any degree, or a `Dual_mesh_of` one
/// \tparam SegmentIdMap a writable property map from `face_descriptor` to `std::size_t`
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh, its faces oriented outward
/// \param segment_ids output, contiguous ids from 0
/// \param numbers the number of segments and the noise, where they are known
/// \param np may follow `segment_ids` directly
/// - `vertex_point_map` (default: that of the mesh)
/// - `edge_is_constrained_map` (readable map from `edge_descriptor` to `bool`, default: no edge is): walls. No surface grows
/// across the marked edges, and no segment lies on both sides, unless it reaches round their end
/// - `callback` (`std::function<bool(double)>`, default: none): receives the fraction done, returns `false` to cancel
/// \returns the number of segments
/// \throws std::invalid_argument if the number of segments asked for is less than that of the components or more than
/// that of the fragments, the noise or a coordinate is not finite, or the cost to stop at is NaN; nothing is written then
/// \throws Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
std::size_t segmentation_into_surfaces(const FaceListGraph& mesh, SegmentIdMap segment_ids,
                                       const Surface_segmentation& numbers = Surface_segmentation(),
                                       const NamedParameters& np = CGAL::parameters::default_values()) {
  static_assert(internal::is_writable_map<SegmentIdMap, typename boost::graph_traits<FaceListGraph>::face_descriptor>,
                "segment_ids must be a writable property map from the mesh's face_descriptor to std::size_t.");
  return hierarchy_of_surfaces<ConcurrencyTag>(mesh, numbers, np)
      .segments([&](const Merge_tree& tree) { return numbers.stop(tree); }, segment_ids);
}

/// As above, with named parameters after the output.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap,
          class NamedParameters, std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
std::size_t segmentation_into_surfaces(const FaceListGraph& mesh, SegmentIdMap segment_ids, const NamedParameters& np) {
  return segmentation_into_surfaces<ConcurrencyTag>(mesh, segment_ids, Surface_segmentation(), np);
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/segmentation_into_surfaces.h>
#endif

#endif
