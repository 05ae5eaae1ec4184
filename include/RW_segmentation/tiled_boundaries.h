// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TILED_BOUNDARIES_H
#define RW_SEGMENTATION_TILED_BOUNDARIES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Tile.h>
#include <RW_segmentation/internal/boundary/Border_crossing.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/threads.h>
#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

/// \file
/// Smooth boundaries of a mesh that comes in tiles, after its segmentation by the steps in `tiled_segmentation.h` or
/// `tiled_surfaces.h`. A boundary that goes on from tile to tile is as smooth there as within tiles, and tiles that are cut along
/// it still meet vertex by vertex:
///
///     each tile   `strip_of_tile()`               what its neighbours must know where boundaries lead out of it
///     each tile   `crossings_of_tile()`           with its neighbours' strips: where they cross its border
///     each tile   `smooth_boundaries_of_tile()`   its boundaries, which end at these crossings
///
/// Of two tiles the one of the lower number finds the crossings on the border between them; both take these. As in the other
/// steps, results depend on nothing but what the functions are given.

namespace RW_segmentation {

/// What `strip_of_tile()` returns: the faces around the places where boundaries between segments lead out of a tile.
struct Tile_strip {
  Tile_border faces;                  ///< with their vertices and walls
  std::vector<std::size_t> segments;  ///< by face of the strip
};

/// Where a smooth boundary goes on from one tile to another.
struct Tile_crossing {
  std::array<Dual_mesh::Index, 2> tiles{};  ///< the one of the lower number first, which has found it
  std::array<Dual_mesh::Index, 2> ends{};   ///< by these: the shared vertex where the jagged boundary leaves the tile
  /// The side that is crossed, by its shared vertices, the lower one first; twice the same where it is that vertex.
  std::array<Dual_mesh::Index, 2> side{};
  double position = 0;  ///< from the first of these vertices, 0, to the second, 1
  /// By the tiles: from the crossing to where the boundary goes on in the other one, in the unit box.
  std::array<Eigen::Vector3d, 2> beyond{};
};

/// Takes what neighbours must see of a tile where boundaries between segments lead out of it: the faces up to five lengths of
/// the smoothing around.
/// \param segment_of_face the segment of each face of the tile, the same number in all tiles
/// \throws std::invalid_argument if a face is no triangle, or there are more or fewer segments than faces
/// Complexity: linear.
Tile_strip strip_of_tile(const Tile& tile, const Tile_in_plan& place, const std::vector<std::size_t>& segment_of_face,
                         const Boundary_smoothing& smoothing = {});

namespace internal {

// The step that may use threads, as it is without a tag of concurrency.
std::vector<Tile_crossing> crossings_of_tile(const Tile_in_plan& place, const Tile_strip& strip,
                                             const std::vector<Tile_strip>& neighbours,
                                             const Boundary_smoothing& smoothing, double wall_angle,
                                             const Progress& progress);

/// The crossings of a tile by its own vertices and sides.
/// \param mesh the tile
std::vector<Border_crossing> border_crossings(const Dual_mesh& mesh, const Tile_in_plan& place,
                                              const std::vector<Tile_crossing>& crossings);

/// A tile as a part of the whole.
Dual_mesh as_part_of_whole(const Dual_mesh& mesh, const Tile_plan& plan);

}  // namespace internal

/// Smooths boundaries where they lead from a tile to neighbours of higher numbers, and finds where they cross the border.
///
/// A boundary crosses the border of a tile where its smooth curve does, if both tiles can have it there whatever else they
/// smooth: it passes from one tile to one other, along six sides of the border at most; and where its curve crosses the border
/// there is no third tile, no other boundary, no wall and no sliver of a face. All others have no crossing and end where they
/// did before.
/// \param neighbours the strips of `plan.tiles[number].neighbours`, in their order
/// \param wall_angle see `Tiled_segmentation`
/// Complexity: that of `smooth_boundaries()` on the strips.
/// \throws Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
std::vector<Tile_crossing> crossings_of_tile(const Tile_in_plan& place, const Tile_strip& strip,
                                             const std::vector<Tile_strip>& neighbours,
                                             const Boundary_smoothing& smoothing = {},
                                             double wall_angle = std::numeric_limits<double>::infinity(),
                                             const Progress& progress = {}) {
  return internal::with_threads<ConcurrencyTag>(
      [&] { return internal::crossings_of_tile(place, strip, neighbours, smoothing, wall_angle, progress); });
}

/// Smooths the boundaries between the segments of a tile as `smooth_boundaries()` does. Those that lead to a crossing end there,
/// in the direction that they have on the whole. All others that lead to the border end in a vertex of it.
///
/// Cut into the tiles by `split_along_boundaries()`, boundaries meet: the new vertex on a side has the same coordinates in both
/// tiles, to the last bit, where those of the ends of the side are the same.
///
/// \tparam ConcurrencyTag, FaceListGraph, SegmentIdMap, NamedParameters see `smooth_boundaries()`
/// \param mesh the tile, as it was when `Tile_of` read it: its vertices are numbered so in the plan
/// \param segment_ids the segment of each face
/// \param place the tile
/// \param crossings those that this tile and its neighbours have found; those of other tiles are passed over
/// \param smoothing how smooth
/// \param np see `smooth_boundaries()`; the walls are those that strips were made with, sharp edges included
/// \returns a curve for each boundary, open ones first
/// \throws std::invalid_argument, Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
auto smooth_boundaries_of_tile(const FaceListGraph& mesh, const SegmentIdMap& segment_ids, const Tile_in_plan& place,
                               const std::vector<Tile_crossing>& crossings, const Boundary_smoothing& smoothing = {},
                               const NamedParameters& np = CGAL::parameters::default_values()) {
  static_assert(internal::has_only_names_of_stages<NamedParameters>,
                "smooth_boundaries_of_tile() takes the named parameters vertex_point_map, edge_is_constrained_map and "
                "callback.");
  internal::require_boundary_smoothing_numbers(smoothing);
  return internal::with_threads<ConcurrencyTag>([&] {
    const auto& dual = internal::dual_mesh(mesh, np);
    const Dual_mesh_of<typename internal::Mesh_type<FaceListGraph>::type> part(
        internal::as_part_of_whole(dual, place.plan), dual);
    return internal::smoothed_boundaries(mesh, part, segment_ids, smoothing, Traced_joining(),
                                         internal::border_crossings(part, place, crossings), np);
  });
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/tiled_boundaries.h>
#endif

#endif
