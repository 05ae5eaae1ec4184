// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TRANSFER_SEGMENTS_H
#define RW_SEGMENTATION_TRANSFER_SEGMENTS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/threads.h>
#include <RW_segmentation/internal/walk/read_conductances.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// The ids that the faces of the full mesh get from those of the reduced one, by face.
std::vector<std::size_t> transferred(const Dual_mesh& reduced, const std::vector<std::size_t>& reduced_ids,
                                     const Dual_mesh& mesh, const std::vector<double>& conductances, std::size_t band,
                                     const Progress& progress);

constexpr std::size_t usual_transfer_band = 6;  // faces

}  // namespace internal

/// Carries the segments of a reduced mesh to the mesh that it was made of (section 3.2 of the paper).
///
/// Each face takes the segment of the closest face of the reduced mesh that looks the same way, so that the two sides of a
/// thin sheet stay apart. Then the faces along the boundaries are walked on by their own conductances: boundaries move
/// to the features of the full resolution. Patches that only the projection has cut off from their segments are walked
/// on, too. No segment gets lost while a face of it is found.
///
/// The meshes need not share vertices or connectivity: any simplification or remeshing will do, such as CGAL's edge collapse.
/// For large meshes `segmentation_via_random_walks()` reduces the walk by itself, which is faster than to make a reduced
/// mesh.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam ReducedMesh a model of CGAL's `FaceListGraph`, or a `Dual_mesh_of` one
/// \tparam ReducedIdMap a readable property map from its face descriptors to an integer
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`, or a `Dual_mesh_of` one
/// \tparam ConductanceMap `Conductance`, or what `as_conductance()` makes of a map of one's own
/// \tparam SegmentIdMap a writable property map from its face descriptors to an integer
/// \tparam ReducedNamedParameters, NamedParameters sequences of CGAL's named parameters
/// \param reduced the reduced mesh, in the place of the full one
/// \param reduced_ids its segments
/// \param mesh the full mesh
/// \param conductance how easily walks cross the edges of the full mesh
/// \param segment_ids output, the ids of the reduced mesh
/// \param band how many faces on either side of a boundary are walked on; about the length of a reduced edge in full
/// ones. 0 leaves what the closest faces say
/// \param np `vertex_point_map` and `edge_is_constrained_map` of the full mesh, `callback`
/// (`std::function<bool(double)>`, `false` cancels)
/// \param reduced_np `vertex_point_map` and `edge_is_constrained_map` of the reduced mesh
/// \returns the number of different ids written
/// \throws std::invalid_argument if the reduced mesh has no face with an area while the full one has faces, a conductance
/// is negative or not finite, or a coordinate not finite; nothing is written then
/// \throws Cancelled; nothing is written then
///
/// Complexity: O(m log n) for m faces and n of the reduced mesh, and that of the walk on the bands.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class ReducedMesh, class ReducedIdMap,
          class FaceListGraph, class ConductanceMap, class SegmentIdMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters,
          class ReducedNamedParameters = CGAL::parameters::Default_named_parameters>
std::size_t transfer_segments(const ReducedMesh& reduced, const ReducedIdMap& reduced_ids, const FaceListGraph& mesh,
                              const ConductanceMap& conductance, SegmentIdMap segment_ids,
                              std::size_t band = internal::usual_transfer_band,
                              const NamedParameters& np = CGAL::parameters::default_values(),
                              const ReducedNamedParameters& reduced_np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(internal::is_writable_map<SegmentIdMap, face_descriptor>,
                "segment_ids must be a writable property map from the mesh's face_descriptor to an integer.");
  static_assert(internal::is_readable_map<ReducedIdMap, typename boost::graph_traits<ReducedMesh>::face_descriptor>,
                "reduced_ids must be a readable property map from the reduced mesh's face_descriptor to an integer.");
  using Id = typename boost::property_traits<SegmentIdMap>::value_type;
  static_assert(internal::has_conductances<ConductanceMap>,
                "transfer_segments() needs conductances: Conductance(mesh, difference), or as_conductance(map) for "
                "values of your own.");
  static_assert(
      internal::has_only_names_of_stages<NamedParameters>,
      "transfer_segments() takes the named parameters vertex_point_map, edge_is_constrained_map and callback.");
  static_assert(internal::has_only<ReducedNamedParameters, internal::Vertex_point, internal::Edge_is_constrained>,
                "transfer_segments() takes the named parameters vertex_point_map and edge_is_constrained_map of the "
                "reduced mesh.");
  return internal::with_threads<ConcurrencyTag>([&] {
    const Progress progress = internal::progress_of(np);
    progress(0);
    const auto& full = internal::dual_mesh(mesh, np);
    const std::vector<double> conductances = internal::read_conductances(full, conductance);
    const auto& coarse = internal::dual_mesh(reduced, reduced_np);
    const auto ids = coarse.read_faces(reduced_ids, [](const auto& id) { return static_cast<std::size_t>(id); });
    const auto transferred = internal::transferred(coarse, ids, full, conductances, band, progress);
    // What may run out of memory comes before the first id is written.
    const std::size_t segments = std::set<std::size_t>(transferred.begin(), transferred.end()).size();
    internal::require_ids_fit<SegmentIdMap>(transferred);
    full.write_faces(std::vector<Id>(transferred.begin(), transferred.end()), segment_ids);
    return segments;
  });
}

/// As above, with named parameters after the output.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class ReducedMesh, class ReducedIdMap,
          class FaceListGraph, class ConductanceMap, class SegmentIdMap, class NamedParameters,
          std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
std::size_t transfer_segments(const ReducedMesh& reduced, const ReducedIdMap& reduced_ids, const FaceListGraph& mesh,
                              const ConductanceMap& conductance, SegmentIdMap segment_ids, const NamedParameters& np) {
  return transfer_segments<ConcurrencyTag>(reduced, reduced_ids, mesh, conductance, segment_ids,
                                           internal::usual_transfer_band, np);
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/transfer_segments.h>
#endif

#endif
