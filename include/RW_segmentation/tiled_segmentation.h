// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TILED_SEGMENTATION_H
#define RW_SEGMENTATION_TILED_SEGMENTATION_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Learned_cost.h>
#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Tile.h>
#include <RW_segmentation/Walk_reduction.h>
#include <RW_segmentation/internal/merging/Region_merging.h>
#include <RW_segmentation/internal/threads.h>
#include <RW_segmentation/internal/tiles/Turn_histogram.h>
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/smoothed_face_normals.h>
#include <RW_segmentation/tile_plan.h>

#include <CGAL/tags.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

/// \file
/// The segmentation of a mesh that comes in tiles, automatic or from seeds of the user, by steps that each see one tile, and
/// steps between them that see no mesh at all:
///
///     each tile   `survey_tile()`       how large it is, and its border (see `tile_plan.h`)
///     all         `plan_tiles()`        which borders are the same
///     each tile   `border_of_tile()`    what its neighbours must know of it, and its noise
///     all         `noise_of_tiles()`    how noisy the whole is
///     each tile   `shape_of_tile()`     with its neighbours' borders: normals; a coarse graph
///     each tile   `places_in_tile()`    where seeds of the user are, if there are any
///     all         `seeds_of_tiles()`    seeds, what is ordinary on the whole
///     each tile   `clusters_of_tile()`  a network of clusters of faces for the walk
///     all         `walk_over_tiles()`   the fragment of each cluster
///     each tile   `fragments_of_tile()` the fragment of each face; sums over regions and boundaries
///     all         `merge_tiles()`       the merge tree; seeds of the user need none
///
/// A step takes what earlier ones returned, in the order of the tiles, and depends on nothing else: not on where or in which
/// order the tiles are done. Whatever lies between two steps is plain data. Steps that may use threads take CGAL's tag of
/// concurrency as their template argument.
///
/// It is the segmentation that `segmentation_via_random_walks()` makes of large meshes, on the mesh as a whole: the same
/// seeds but for their place within a cluster, the same walk, the same merging. What differs: normals near a tile's border
/// see the surface only as far as its neighbours' borders reach. From seeds of the user it is that of `Random_walk`, but for
/// the clusters that walks run over, with normals of the smoothed shape and `seeded_concavity()`.
///
/// All of this is for one connected part of a mesh, or for a mesh as a whole. Where pieces of tiles take the place of tiles, each
/// part is segmented as it is by itself; see `tile_plan.h`. `hierarchy_of_tiles()` does so.
///
/// Walls are those of the tiles (`Tile::walls`) and, with `Tiled_segmentation::wall_angle`, sharp edges, within tiles and
/// between them. All steps heed them as `segmentation_via_random_walks()` does.

namespace RW_segmentation {

/// What a segmentation of tiles is made with; as in `Automatic_segmentation` with one seeding.
struct Tiled_segmentation {
  Normal_smoothing smoothing;    ///< of the shape
  std::size_t seeds = 40;        ///< of those tiles, and one more for each further connected component of them
  Walk_reduction reduction;      ///< how large clusters are; walks over tiles run over clusters in any case
  Thickness_sampling thickness;  ///< 0 samples: thickness does not count
  /// How far apart the same vertex may be in two tiles, in the unit of the coordinates.
  double tolerance = 0;
  /// Edges over which the surface turns by more are walls, beside those of the tiles; in radians, infinite: none is.
  double wall_angle = std::numeric_limits<double>::infinity();
  bool by_component = true;       ///< whether `hierarchy_of_tiles()` parts a mesh, see `Segmentation_policies`
  double least_component = 0.01;  ///< see `Segmentation_policies`; parts of less area have a seed in each component

  Tiled_segmentation() = default;
  /// For so many segments: with twice as many seeds, 40 at least.
  explicit Tiled_segmentation(std::size_t segments);

  /// The same for a part of a mesh.
  /// \param area of the part
  /// \param largest_area of a part
  Tiled_segmentation of_part(double area, double largest_area) const;
};

/// What `border_of_tile()` returns: the faces near a tile's border that its neighbours see.
struct Tile_border {
  /// The id of a vertex that no other tile has.
  static constexpr Dual_mesh::Index none = std::numeric_limits<Dual_mesh::Index>::max();

  std::vector<Eigen::Vector3d> points;                 ///< in the unit box
  std::vector<Dual_mesh::Index> ids;                   ///< by point: that of a shared vertex, or `none`
  internal::Face_corners corners;                      ///< by face of the border
  std::vector<Dual_mesh::Index> faces;                 ///< by face of the border: its number in the tile
  double width = 0;                                    ///< how far it reaches from the tile's border, in the unit box
  std::vector<std::array<Dual_mesh::Index, 2>> walls;  ///< those of the tile, by their points
};

/// How far smoothing turns the normals of a tile: counts, from which medians over all tiles are taken. Those of patches are
/// scaled up, so that each tile weighs as much as its faces.
struct Tile_noise {
  internal::Turn_histogram::Counts turns;           ///< by size
  internal::Turn_histogram::Counts smoother_turns;  ///< likewise, of the smoothed mesh, where there is heavy noise
};

namespace internal {

/// A side between faces of two tiles, by the ids of its vertices, the lower one first.
using Tile_side = std::array<Dual_mesh::Index, 2>;

/// What one tile gives to the sum over a side between two tiles. The tile of the lower number gives what the side itself
/// is; the other one leaves it 0.
template <class Value>
struct Side_value {
  Tile_side side;
  Dual_mesh::Index node;  ///< of the tile, on this side
  double from_node;       ///< what leads there from the node
  Value value;
  bool is_owner;
};

/// Sums over the edges of a tile, from which means over the whole are made. Edges between two tiles count for the lower
/// one.
struct Turn_sums {
  double edges = 0, length = 0;
  double turn = 0;                ///< inward
  double seeded_turn = 0;         ///< weighted as in `seeded_concavity()`
  Turn_histogram::Counts counts;  ///< of the inward turns
  std::size_t walls = 0;          ///< edges that are
};

}  // namespace internal

/// What `shape_of_tile()` makes and later steps of the same tile go on with. The largest of all: a `Dual_mesh` with normals.
struct Tile_shape {
  /// A face of another tile.
  struct Halo_face {
    Dual_mesh::Index tile;   ///< that has it
    Dual_mesh::Index place;  ///< in that tile's `Tile_border`
  };
  /// An edge between a face of the tile and one of the halo.
  struct Shared_edge {
    Dual_mesh::Index edge;       ///< of the mesh
    internal::Tile_side side;    ///< where it lies, the same from both tiles
    Dual_mesh::Index neighbour;  ///< the other tile
  };

  Dual_mesh mesh;                         ///< the faces of the tile, then those of the halo
  std::size_t own_faces = 0;              ///< faces of the tile
  std::vector<Halo_face> halo;            ///< by face of the halo
  std::vector<Shared_edge> shared_edges;  ///< all of them
};

/// What `seeds_of_tiles()` needs of a tile: a coarse graph of its surface, and samples of it.
struct Tile_outline {
  internal::Turn_sums turns;                           ///< how far normals turn inward
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();    ///< of the area
  std::vector<Dual_mesh::Index> faces;                 ///< by node: the face that stands for it
  std::vector<Eigen::Vector3d> centroids;              ///< of these
  std::vector<std::array<Dual_mesh::Index, 2>> edges;  ///< between nodes
  std::vector<double> lengths;                         ///< of these, in the feature-sensitive metric
  std::vector<internal::Side_value<double>> sides;     ///< lengths between nodes of different tiles
  std::vector<internal::Thickness_probe> probes;       ///< where the thickness is measured
  std::size_t turned_sides = 0;                        ///< sides between faces of which one must be turned inside out
};

/// What `shape_of_tile()` returns.
struct Shaped_tile {
  Tile_shape shape;      ///< for the tile itself
  Tile_outline outline;  ///< for the step of all tiles
};

/// A seed of the user: the face that is closest to a point, in whichever tile.
struct Seed_point {
  Eigen::Vector3d point;   ///< in the coordinates of the tiles
  Dual_mesh::Index label;  ///< of the segment, below 2^31; several seeds may have the same
};

/// What `places_in_tile()` finds for a point.
struct Tile_place {
  Dual_mesh::Index face;    ///< of the tile, the closest one
  double squared_distance;  ///< in the unit box; infinity if the tile has no face with an area
};

/// Seeds, and what is ordinary on the whole.
struct Tile_seeds {
  /// A seed.
  struct Seed {
    Dual_mesh::Index tile;   ///< where it is
    Dual_mesh::Index face;   ///< of the tile
    Dual_mesh::Index label;  ///< of a seed of the user; of others their number
  };
  /// Where the thickness is measured.
  struct Probe {
    Dual_mesh::Index tile;            ///< where it is
    internal::Thickness_probe probe;  ///< on a face of the tile
  };

  std::vector<Seed> seeds;            ///< in the order in which they were found
  std::vector<Probe> probes;          ///< tile by tile
  internal::Mean_concavity ordinary;  ///< means over the edges of all tiles
  std::size_t turned_sides = 0;       ///< sides at which two tiles are not oriented alike; no tile goes on there
  std::size_t walls = 0;              ///< edges of all tiles that are
  bool are_given = false;             ///< whether they are the user's: each label is a segment
  double seeded_turn = 0;  ///< mean over the edges of all tiles, weighted as in `seeded_concavity()`; 0: it is flat
};

/// What `clusters_of_tile()` keeps for the tile itself: the cluster of each face.
using Tile_clusters = std::vector<Dual_mesh::Index>;

/// What `walk_over_tiles()` needs of a tile: its clusters of faces as a network of conductances.
struct Tile_network {
  std::size_t clusters = 0;                            ///< those of the tile's seeds are the first ones
  std::vector<std::array<Dual_mesh::Index, 2>> edges;  ///< between clusters
  std::vector<double> conductances;                    ///< of these
  std::vector<internal::Side_value<double>> sides;     ///< conductances between clusters of different tiles
  std::vector<Dual_mesh::Index> border;                ///< by face of the tile's `Tile_border`: its cluster
  std::vector<double> exits;                           ///< of the rays of all probes through this tile
};

/// The fragments of the clusters of all tiles.
struct Tile_walk {
  /// By tile and cluster; for seeds of the user their labels, and those after the largest one where none is in reach.
  std::vector<std::vector<Dual_mesh::Index>> fragments;
  std::vector<std::vector<char>> bands;  ///< by tile and cluster: whether its faces are walked on once more
  std::vector<double> thickness;         ///< by probe, in the unit box; 0 where it could not be measured
  std::size_t number_of_fragments = 0;   ///< of the whole
  std::size_t clusters = 0;              ///< of all tiles
  std::size_t components = 0;            ///< connected parts of the whole mesh
  std::size_t island_clusters = 0;       ///< that the walk left apart from their fragment, moved to a neighbour
  bool is_solid = false;                 ///< whether enough of the whole has a thickness
  double crease_weight = 1;              ///< of the merge cost, by the number of edges of the whole
};

/// What `merge_tiles()` needs of a tile: sums over its regions and their boundaries.
struct Tile_regions {
  /// What `Learned_cost` asks about a boundary.
  using Boundary_sums = internal::Boundaries_of_cost<Learned_cost, Dual_mesh>::Sums;

  std::vector<Dual_mesh::Index> fragments;                               ///< that have faces in the tile, rising
  std::vector<Learned_cost::Region> regions;                             ///< of these
  std::vector<internal::Boundary_of_regions<Boundary_sums>> boundaries;  ///< between fragments, within the tile
  std::vector<internal::Side_value<Boundary_sums>> sides;                ///< those at its border
  /// Fragments on the two sides of a wall, which are no neighbours there; the lower one first, rising.
  std::vector<std::array<Dual_mesh::Index, 2>> walls;
};

namespace internal {

// The steps that may use threads, as they are without a tag of concurrency.
Tile_border border_of_tile(const Tile& tile, const Tile_in_plan& place, Tile_noise& noise,
                           const Tiled_segmentation& options, const Progress& progress);
Shaped_tile shape_of_tile(const Tile& tile, const Tile_in_plan& place, const std::vector<Tile_border>& neighbours,
                          const Noise_of_mesh& noise, const Tiled_segmentation& options, const Progress& progress);
Tile_clusters clusters_of_tile(const Tile_shape& shape, const Tile_in_plan& place, const Tile_border& border,
                               const Tile_seeds& seeds, Tile_network& network, const Tiled_segmentation& options);
Tile_walk walk_over_tiles(const Tile_plan& plan, const Tile_seeds& seeds, const std::vector<Tile_network>& networks,
                          const Tiled_segmentation& options, const Progress& progress);

}  // namespace internal

/// Takes what neighbours must see of a tile, and measures its noise: on all faces of a tile of up to 500 000, and on patches
/// of 250 000 faces together, spread over it, of a larger one.
/// \param[out] noise what `noise_of_tiles()` needs
/// Complexity: linear, beside that of `smoothed_face_normals()` for so many faces.
/// \throws std::invalid_argument if the plan makes one vertex of two corners of a face that lie apart, as a tolerance does
/// that is larger than edges at the border
/// \throws Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
Tile_border border_of_tile(const Tile& tile, const Tile_in_plan& place, Tile_noise& noise,
                           const Tiled_segmentation& options = {}, const Progress& progress = {}) {
  return internal::with_threads<ConcurrencyTag>(
      [&] { return internal::border_of_tile(tile, place, noise, options, progress); });
}

/// How noisy the whole is.
internal::Noise_of_mesh noise_of_tiles(const std::vector<Tile_noise>& tiles);

/// Joins a tile with its neighbours' borders, finds its walls, and smooths its normals.
/// \param neighbours the borders of `plan.tiles[number].neighbours`, in their order
/// Complexity: that of `smoothed_face_normals()`.
/// \throws std::invalid_argument, Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
Shaped_tile shape_of_tile(const Tile& tile, const Tile_in_plan& place, const std::vector<Tile_border>& neighbours,
                          const internal::Noise_of_mesh& noise, const Tiled_segmentation& options = {},
                          const Progress& progress = {}) {
  return internal::with_threads<ConcurrencyTag>(
      [&] { return internal::shape_of_tile(tile, place, neighbours, noise, options, progress); });
}

/// Places the seeds.
/// \throws std::invalid_argument, Cancelled
/// Complexity: that of `Farthest_point_sampling` on the coarse graph.
Tile_seeds seeds_of_tiles(const Tile_plan& plan, const std::vector<Tile_outline>& outlines,
                          const Tiled_segmentation& options = {}, const Progress& progress = {});

/// Finds the face of a tile that is closest to each point, the one of the lowest number where several are.
/// Complexity: O(n log n) for n faces, and O(log n) for most points.
std::vector<Tile_place> places_in_tile(const Tile_shape& shape, const Tile_plan& plan,
                                       const std::vector<Seed_point>& seeds);

/// Takes the user's seeds, each in the tile that is closest to it, the first one where several are.
/// \param places what `places_in_tile()` found, by tile
/// \throws std::invalid_argument if there is no seed or no face, a face gets two labels, or a label is 2^31 or more
/// Complexity: linear.
Tile_seeds seeds_of_tiles(const Tile_plan& plan, const std::vector<Tile_outline>& outlines,
                          const std::vector<Seed_point>& seeds, const std::vector<std::vector<Tile_place>>& places);

/// Makes the clusters of a tile that walks run over.
/// \param border of this tile
/// \param[out] network what the next step needs
/// Complexity: O(m log m) for m faces.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
Tile_clusters clusters_of_tile(const Tile_shape& shape, const Tile_in_plan& place, const Tile_border& border,
                               const Tile_seeds& seeds, Tile_network& network, const Tiled_segmentation& options = {}) {
  return internal::with_threads<ConcurrencyTag>(
      [&] { return internal::clusters_of_tile(shape, place, border, seeds, network, options); });
}

/// Walks over the clusters of all tiles.
/// \throws Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
Tile_walk walk_over_tiles(const Tile_plan& plan, const Tile_seeds& seeds, const std::vector<Tile_network>& networks,
                          const Tiled_segmentation& options = {}, const Progress& progress = {}) {
  return internal::with_threads<ConcurrencyTag>(
      [&] { return internal::walk_over_tiles(plan, seeds, networks, options, progress); });
}

/// What `fragments_of_tile()` takes of the steps before it.
struct Walked_tile {
  Tile_in_plan place;                           ///< of the tile
  const Tile_shape& shape;                      ///< of the tile
  const Tile_clusters& clusters;                ///< of the tile
  const std::vector<Tile_border>& borders;      ///< of `plan.tiles[number].neighbours`, in their order
  const std::vector<Tile_network>& neighbours;  ///< the networks of these
  const Tile_seeds& seeds;                      ///< of all tiles
  const Tile_walk& walk;                        ///< over all tiles
};

namespace internal {

std::vector<Dual_mesh::Index> fragments_of_tile(const Walked_tile& tile, Tile_regions& regions,
                                                const Progress& progress);

}  // namespace internal

/// Walks once more over the faces along the boundaries of fragments, and sums up what merging asks for.
/// \param[out] regions what the next step needs
/// \returns the fragment of each face of the tile
/// \throws Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
std::vector<Dual_mesh::Index> fragments_of_tile(const Walked_tile& tile, Tile_regions& regions,
                                                const Progress& progress = {}) {
  return internal::with_threads<ConcurrencyTag>([&] { return internal::fragments_of_tile(tile, regions, progress); });
}

namespace internal {

/// A part of the whole, measured as such.
/// \param points in the unit box
/// \param is_wall by edge, in the order of `Joined_faces`; empty: no edge is
Dual_mesh part_of(const Tile_plan& plan, Face_corners corners, std::vector<Eigen::Vector3d> points,
                  std::vector<char> is_wall);

/// The boundaries between all fragments, sorted by these.
std::vector<Boundary_of_regions<Tile_regions::Boundary_sums>> boundaries_of_tiles(
    const std::vector<Tile_regions>& tiles);

}  // namespace internal

/// Merges the fragments of all tiles, by `Learned_cost`.
/// \throws Cancelled
Merge_tree merge_tiles(const Tile_walk& walk, const std::vector<Tile_regions>& tiles, const Progress& progress = {});

/// All levels of a segmentation of tiles.
struct Tiled_hierarchy {
  Merge_tree tree;                                              ///< of the fragments
  std::vector<std::vector<Dual_mesh::Index>> fragment_of_face;  ///< by tile and face
  std::size_t components = 0;                                   ///< connected parts of the whole
  std::size_t clusters = 0;                                     ///< that the walk ran over
  std::size_t turned_sides = 0;                                 ///< see `Tile_seeds`

  /// The segment of each face of each tile at a level of the tree.
  /// \throws std::invalid_argument if there are more components or fewer fragments than `number_of_segments`
  std::vector<std::vector<std::size_t>> segments(std::size_t number_of_segments) const;
};

namespace internal {

Tiled_hierarchy hierarchy_of_tiles(const std::vector<Tile>& tiles, const Tiled_segmentation& options,
                                   const Progress& progress);
std::vector<std::vector<Dual_mesh::Index>> segments_of_tiles(const std::vector<Tile>& tiles,
                                                             const std::vector<Seed_point>& seeds,
                                                             const Tiled_segmentation& options,
                                                             const Progress& progress);

}  // namespace internal

/// Segments tiles that fit into memory together: all steps, one after the other.
///
/// \code
/// const Tiled_hierarchy hierarchy = hierarchy_of_tiles({Tile_of(north), Tile_of(south)});
/// const auto segments = hierarchy.segments(Cost_threshold_stop(1)(hierarchy.tree));
/// \endcode
/// \throws std::invalid_argument, Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
Tiled_hierarchy hierarchy_of_tiles(const std::vector<Tile>& tiles, const Tiled_segmentation& options = {},
                                   const Progress& progress = {}) {
  return internal::with_threads<ConcurrencyTag>([&] { return internal::hierarchy_of_tiles(tiles, options, progress); });
}

/// Segments tiles that fit into memory together from seeds of the user: all steps, one after the other.
///
/// \code
/// const auto labels = segments_of_tiles({Tile_of(north), Tile_of(south)}, {{on_tower, 0}, {on_ground, 1}});
/// \endcode
/// \returns the label of each face of each tile; parts that no seed can reach get the labels after the largest one
/// \throws std::invalid_argument, Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
std::vector<std::vector<Dual_mesh::Index>> segments_of_tiles(const std::vector<Tile>& tiles,
                                                             const std::vector<Seed_point>& seeds,
                                                             const Tiled_segmentation& options = {},
                                                             const Progress& progress = {}) {
  return internal::with_threads<ConcurrencyTag>(
      [&] { return internal::segments_of_tiles(tiles, seeds, options, progress); });
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/tiled_segmentation.h>
#endif

#endif
