// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TILED_SURFACES_H
#define RW_SEGMENTATION_TILED_SURFACES_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Region_boundary.h>
#include <RW_segmentation/Tile.h>
#include <RW_segmentation/internal/merging/Region_merging.h>
#include <RW_segmentation/internal/mesh/Face_corners.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/threads.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <CGAL/tags.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

/// \file
/// The segmentation into surfaces of a mesh that comes in tiles. Tiles are surveyed and planned as in
/// `tiled_segmentation.h`; then
///
///     each tile   `border_of_tile()`    what its neighbours must know of it, and neighbourhoods all over it
///     all         `noise_of_tiles()`    how noisy the whole is
///     each tile   `surfaces_of_tile()`  with its neighbours' borders: the surface of each face; samples of surfaces
///     all         `merge_tiles()`       which surfaces go on from tile to tile, by fits to samples of both
///
/// As there, all of this is for one connected part or for a mesh as a whole, but for the noise: that is of the whole,
/// `noise_of_parts()`. Each part counts as exact by its own size where pieces take the place of tiles.
///
/// Each tile is segmented as `segmentation_into_surfaces()` segments a mesh. What differs from the mesh as a whole: a
/// surface near a tile's border is found by what reaches into the halo alone.

namespace RW_segmentation {

/// What surfaces of tiles are found with.
struct Tiled_surfaces {
  /// Standard deviation of the vertices, as a part of the diagonal of the whole; negative: estimated.
  double noise = -1;
  /// How far a tile sees of its neighbours, in mean edge lengths of these. At 6, 12 and 25, 1.07 times the true segments on
  /// CAD solids in eight boxes (`benchmark_engineering --method tiles`, `_5k`) and the same Rand error.
  double halo = 8;
  /// How far apart the same vertex may be in two tiles, in the unit of the coordinates.
  double tolerance = 0;
  /// Edges over which the surface turns by more are walls, beside those of the tiles; in radians, infinite: none is.
  double wall_angle = std::numeric_limits<double>::infinity();
};

/// Faces of a tile or its halo by themselves.
struct Sampled_faces {
  std::vector<Eigen::Vector3d> points;  ///< in the unit box
  internal::Face_corners corners;       ///< by face
};

/// What `noise_of_tiles()` needs of a tile: neighbourhoods all over it.
struct Tile_neighbourhoods {
  Sampled_faces faces;                    ///< of all neighbourhoods
  std::vector<Dual_mesh::Index> middles;  ///< those of these that neighbourhoods are about
};

/// How far the vertices of the whole are off their surfaces.
struct Surface_noise {
  double deviation = 0;                                       ///< standard deviation, in the unit box
  internal::Noise_kind kind = internal::Noise_kind::unclear;  ///< where there is noise

  /// That of a mesh in the unit box of a part.
  Surface_noise in_part(const Tile_parts& parts, std::size_t part) const;
};

/// What `merge_tiles()` needs of a tile: samples of its regions, and their boundaries.
struct Tile_surfaces {
  /// An edge between two tiles.
  struct Side_sums {
    Edge_sums edge;          ///< as merging sums it up
    bool is_smooth = false;  ///< whether a free form goes on there
    bool is_wall = false;    ///< whether nothing does
  };

  std::vector<double> areas;                ///< by region: of its faces in the tile, as a part of the whole
  Sampled_faces samples;                    ///< of the regions
  std::vector<Dual_mesh::Index> region_of;  ///< by sample
  std::vector<internal::Boundary_of_regions<Edge_sums>> boundaries;  ///< between regions, within the tile
  std::vector<internal::Side_value<Side_sums>> sides;                ///< those at its border
  /// Regions on the two sides of a wall in the tile; the lower one first, rising.
  std::vector<std::array<Dual_mesh::Index, 2>> beside_walls;
  std::size_t walls = 0;         ///< edges that are, those between tiles counted once
  std::size_t turned_sides = 0;  ///< sides between faces of which one must be turned inside out
};

/// The regions of all tiles, joined where the same surface goes on.
struct Merged_surfaces {
  std::vector<std::vector<Dual_mesh::Index>> fragments;     ///< by tile and region of it
  std::vector<std::array<Dual_mesh::Index, 2>> neighbours;  ///< fragments that meet, or have a wall between them
  Merge_tree tree;                                          ///< of the fragments
  std::size_t turned_sides = 0;                             ///< sides at which two tiles are not oriented alike
  std::size_t walls = 0;                                    ///< edges of all tiles that are
};

namespace internal {

// The steps that may use threads, as they are without a tag of concurrency.
Tile_border border_of_tile(const Tile& tile, const Tile_in_plan& place, Tile_neighbourhoods& neighbourhoods,
                           const Tiled_surfaces& options, const Progress& progress);
std::vector<Dual_mesh::Index> surfaces_of_tile(const Tile& tile, const Tile_in_plan& place,
                                               const std::vector<Tile_border>& neighbours, const Surface_noise& noise,
                                               Tile_surfaces& surfaces, const Tiled_surfaces& options,
                                               const Progress& progress);

}  // namespace internal

/// Takes what neighbours must see of a tile, and what tells how noisy the whole is.
/// \param[out] neighbourhoods what `noise_of_tiles()` needs
/// Complexity: linear.
/// \throws std::invalid_argument if a number of the options is not finite, the halo is negative, or the plan makes one vertex
/// of two corners of a face that lie apart, as a tolerance does that is larger than edges at the border
/// \throws Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
Tile_border border_of_tile(const Tile& tile, const Tile_in_plan& place, Tile_neighbourhoods& neighbourhoods,
                           const Tiled_surfaces& options, const Progress& progress = {}) {
  return internal::with_threads<ConcurrencyTag>(
      [&] { return internal::border_of_tile(tile, place, neighbourhoods, options, progress); });
}

/// How noisy the whole is, estimated as on a mesh.
/// \throws std::invalid_argument if the noise is not finite
/// Complexity: that of some thousand fits.
Surface_noise noise_of_tiles(const Tile_plan& plan, const std::vector<Tile_neighbourhoods>& tiles,
                             const Tiled_surfaces& options = {});

/// How noisy a mesh of several parts is. A mesh is clean where each part is by its own size, and otherwise as noisy as the whole.
/// \param pieces by tile, and by piece of it
/// \returns the noise in the unit box of the whole; see `Surface_noise::in_part()`
/// \throws std::invalid_argument if the noise is not finite
/// Complexity: that of `noise_of_tiles()`.
Surface_noise noise_of_parts(const Tile_parts& parts, const std::vector<std::vector<Tile_neighbourhoods>>& pieces,
                             const Tiled_surfaces& options = {});

/// Joins a tile with its neighbours' borders, and finds the surfaces of its faces.
/// \param neighbours the borders of `plan.tiles[number].neighbours`, in their order
/// \param noise of the whole
/// \param[out] surfaces what the next step needs
/// \param options its `wall_angle`
/// \returns the region of each face of the tile, numbered from 0
/// Complexity: that of `segmentation_into_surfaces()`.
/// \throws std::invalid_argument, Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
std::vector<Dual_mesh::Index> surfaces_of_tile(const Tile& tile, const Tile_in_plan& place,
                                               const std::vector<Tile_border>& neighbours, const Surface_noise& noise,
                                               Tile_surfaces& surfaces, const Tiled_surfaces& options = {},
                                               const Progress& progress = {}) {
  return internal::with_threads<ConcurrencyTag>(
      [&] { return internal::surfaces_of_tile(tile, place, neighbours, noise, surfaces, options, progress); });
}

/// Joins the free forms that meet smoothly between tiles, and merges all regions by `Analytic_surface_cost`. Merging is best
/// stopped at cost 1.
/// Complexity: O(r log r) for r regions, and a few fits for each.
/// \throws Cancelled
Merged_surfaces merge_tiles(const Tile_plan& plan, const Surface_noise& noise, const std::vector<Tile_surfaces>& tiles,
                            const Progress& progress = {});

/// The surface that each segment lies on, by samples of at most 200 faces in each tile; see `segment_surfaces()`.
/// \param segment_of_fragment from 0 to `number_of_segments` - 1
/// \returns the surfaces, in the coordinates of the tiles; a free form where none fits
std::vector<Analytic_surface> surfaces_of_tiles(const Tile_plan& plan, const Surface_noise& noise,
                                                const std::vector<Tile_surfaces>& tiles, const Merged_surfaces& merged,
                                                const std::vector<std::size_t>& segment_of_fragment,
                                                std::size_t number_of_segments);

/// The surfaces of a connected part.
struct Part_surfaces {
  std::vector<Tile_surfaces> regions;  ///< by piece, in the order of the part's plan
  Merged_surfaces merged;              ///< from these
};

/// The trees of all parts as one, their fragments one part after the other.
Merge_tree tree_of_parts(const std::vector<Part_surfaces>& parts);

/// As `surfaces_of_tiles()`, of all parts.
/// \param noise in the unit box of the whole
/// \param segment_of_fragment for the fragments of `tree_of_parts()`
std::vector<Analytic_surface> surfaces_of_parts(const Tile_parts& parts, const Surface_noise& noise,
                                                const std::vector<Part_surfaces>& surfaces,
                                                const std::vector<std::size_t>& segment_of_fragment,
                                                std::size_t number_of_segments);

/// All levels of a segmentation of tiles into surfaces.
struct Tiled_surface_hierarchy : Tiled_hierarchy {
  Tile_parts parts;                     ///< connected ones
  Surface_noise noise;                  ///< of the whole, in its unit box
  std::vector<Part_surfaces> of_parts;  ///< their surfaces
  std::size_t walls = 0;                ///< edges of all tiles that are

  /// The surface of each segment at a level of the tree, in the coordinates of the tiles.
  /// \throws std::invalid_argument if there are more components or fewer fragments than `number_of_segments`
  std::vector<Analytic_surface> surfaces(std::size_t number_of_segments) const;
};

namespace internal {

Tiled_surface_hierarchy hierarchy_of_tiled_surfaces(const std::vector<Tile>& tiles, const Tiled_surfaces& options,
                                                    const Progress& progress);

}  // namespace internal

/// Segments tiles that fit into memory together into surfaces: all steps, one after the other.
///
/// \code
/// const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces({Tile_of(north), Tile_of(south)});
/// const std::size_t segments = Cost_threshold_stop(1)(hierarchy.tree);
/// const auto labels = hierarchy.segments(segments);  // by tile and face
/// for (const Analytic_surface& surface : hierarchy.surfaces(segments)) ...
/// \endcode
/// \throws std::invalid_argument, Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
Tiled_surface_hierarchy hierarchy_of_tiled_surfaces(const std::vector<Tile>& tiles, const Tiled_surfaces& options = {},
                                                    const Progress& progress = {}) {
  return internal::with_threads<ConcurrencyTag>(
      [&] { return internal::hierarchy_of_tiled_surfaces(tiles, options, progress); });
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/tiled_surfaces.h>
#endif

#endif
