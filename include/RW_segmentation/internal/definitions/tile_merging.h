// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILE_MERGING_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILE_MERGING_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/definitions/tile_walk.h>
#include <RW_segmentation/internal/tiles/Joined_nodes.h>
#include <RW_segmentation/internal/walk/settle_band.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// What the clusters say of the faces of a tile and its halo.
struct Coarse_labels {
  std::vector<std::size_t> fragment;
  std::vector<char> is_in_band;
  std::vector<Dual_mesh::Index> seeds;  ///< faces
};

inline Coarse_labels coarse_labels(const Walked_tile& walked) {
  using Index = Dual_mesh::Index;
  const Tile_shape& shape = walked.shape;
  const std::size_t number = walked.place.number;
  Coarse_labels labels;
  const auto append = [&](std::size_t tile, Index cluster) {
    labels.fragment.push_back(walked.walk.fragments[tile][cluster]);
    labels.is_in_band.push_back(walked.walk.bands[tile][cluster]);
  };
  for (const Index cluster : walked.clusters) append(number, cluster);
  labels.seeds = seeds_in(walked.seeds, number);
  std::set<std::pair<Index, Index>> is_seed;
  for (const auto& seed : walked.seeds.seeds) is_seed.emplace(seed.tile, seed.face);
  const std::vector<Index>& tiles = walked.place.plan.tiles[number].neighbours;
  for (std::size_t h = 0; h < shape.halo.size(); ++h) {
    const auto [tile, place] = shape.halo[h];
    const auto n = static_cast<std::size_t>(std::lower_bound(tiles.begin(), tiles.end(), tile) - tiles.begin());
    append(tile, walked.neighbours[n].border[place]);
    if (is_seed.count({tile, walked.borders[n].faces[place]}) > 0)
      labels.seeds.push_back(static_cast<Index>(shape.own_faces + h));
  }
  return labels;
}

/// The thickness of the faces of a tile and its halo, 0 where there is no probe.
inline std::vector<double> thickness_in(const Tile_shape& shape, std::size_t number, const Tile_seeds& seeds,
                                        const Tile_walk& walk) {
  std::vector<double> thickness(shape.mesh.number_of_faces(), 0.);
  for (std::size_t p = 0; p < seeds.probes.size(); ++p)
    if (seeds.probes[p].tile == number) thickness[seeds.probes[p].probe.face] = walk.thickness[p];
  return thickness;
}

/// The fragments on the two sides of the walls of a tile.
inline std::vector<std::array<Dual_mesh::Index, 2>> fragments_beside_walls(const Tile_shape& shape,
                                                                           const std::vector<std::size_t>& fragment) {
  using Index = Dual_mesh::Index;
  std::set<std::array<Index, 2>> pairs;
  for (Index e = 0; shape.mesh.has_walls() && e < shape.mesh.number_of_edges(); ++e) {
    const auto [f, g] = shape.mesh.graph().faces_of(e);
    if (!shape.mesh.is_wall(e) || std::min(f, g) >= shape.own_faces || fragment[f] == fragment[g]) continue;
    const auto [a, b] = std::minmax(fragment[f], fragment[g]);
    pairs.insert({static_cast<Index>(a), static_cast<Index>(b)});
  }
  return {pairs.begin(), pairs.end()};
}

/// Sums over the regions of a tile and the edges between them that are no walls.
inline Tile_regions sum_up(const Tile_shape& shape, std::size_t number, const std::vector<std::size_t>& fragment,
                           const Learned_cost& cost, const std::vector<double>& difference) {
  using Index = Dual_mesh::Index;
  using Asking = Boundaries_of_cost<Learned_cost, Dual_mesh>;
  const Dual_mesh& mesh = shape.mesh;
  Tile_regions result;
  std::map<Index, Learned_cost::Region> regions;
  for (Index f = 0; f < shape.own_faces; ++f) cost.join(regions[static_cast<Index>(fragment[f])], cost.region(mesh, f));
  for (const auto& [number_of_fragment, region] : regions) {
    result.fragments.push_back(number_of_fragment);
    result.regions.push_back(region);
  }

  const auto sums_of = [&](Index e) {
    return Asking::of_edge(cost, mesh, e, mesh.edge_length(e) / mesh.length_unit(), difference[e]);
  };
  std::map<std::array<Index, 2>, Tile_regions::Boundary_sums> boundaries;
  for (Index e = 0; e < mesh.number_of_edges(); ++e) {
    const auto [f, g] = mesh.graph().faces_of(e);
    if (f >= shape.own_faces || g >= shape.own_faces || fragment[f] == fragment[g] || mesh.is_wall(e)) continue;
    const auto [a, b] = std::minmax(fragment[f], fragment[g]);
    boundaries[{static_cast<Index>(a), static_cast<Index>(b)}] += sums_of(e);
  }
  for (const auto& [fragments, common] : boundaries) result.boundaries.push_back({fragments, common});
  for (const auto& shared : shape.shared_edges) {
    if (mesh.is_wall(shared.edge)) continue;
    const bool is_owner = number < shared.neighbour;
    result.sides.push_back({shared.side, static_cast<Index>(fragment[own_face(shape, shared)]), 0,
                            is_owner ? sums_of(shared.edge) : Tile_regions::Boundary_sums(), is_owner});
  }
  result.walls = fragments_beside_walls(shape, fragment);
  return result;
}

}  // namespace internal

RW_SEGMENTATION_INLINE std::vector<Dual_mesh::Index> internal::fragments_of_tile(const Walked_tile& tile,
                                                                                 Tile_regions& regions,
                                                                                 const Progress& progress) {
  const Tile_shape& shape = tile.shape;
  const std::size_t number = tile.place.number;
  internal::Coarse_labels labels = internal::coarse_labels(tile);
  const std::vector<double> difference = internal::differences_of(shape.mesh, tile.seeds);
  internal::settle_band(shape.mesh.graph(), internal::conductances_of(shape.mesh, difference),
                        {labels.is_in_band, labels.seeds}, labels.fragment, progress);
  const Learned_cost cost(shape.mesh, internal::thickness_in(shape, number, tile.seeds, tile.walk),
                          tile.seeds.ordinary);
  regions = internal::sum_up(shape, number, labels.fragment, cost, difference);
  const auto end_of_own = labels.fragment.begin() + static_cast<std::ptrdiff_t>(shape.own_faces);
  return {labels.fragment.begin(), end_of_own};
}

namespace internal {

RW_SEGMENTATION_INLINE std::vector<Boundary_of_regions<Tile_regions::Boundary_sums>> boundaries_of_tiles(
    const std::vector<Tile_regions>& tiles) {
  using Index = Dual_mesh::Index;
  std::map<std::array<Index, 2>, Tile_regions::Boundary_sums> sums;
  for (const Tile_regions& tile : tiles)
    for (const auto& [fragments, common] : tile.boundaries) sums[fragments] += common;
  // Fragments have the same numbers in all tiles.
  const Joined_nodes nodes(tiles, [](const Tile_regions&) { return std::size_t(0); });
  nodes.for_each_side(tiles, [&](const auto& owner, Index a, const auto&, Index b) {
    if (a != b) sums[{std::min(a, b), std::max(a, b)}] += owner.value;
  });
  std::vector<Boundary_of_regions<Tile_regions::Boundary_sums>> boundaries;
  for (const auto& [fragments, common] : sums) boundaries.push_back({fragments, common});
  return boundaries;
}

}  // namespace internal

RW_SEGMENTATION_INLINE Merge_tree merge_tiles(const Tile_walk& walk, const std::vector<Tile_regions>& tiles,
                                              const Progress& progress) {
  const Learned_cost cost(walk.is_solid, walk.crease_weight);
  std::vector<Learned_cost::Region> regions(walk.number_of_fragments);
  for (const Tile_regions& tile : tiles)
    for (std::size_t i = 0; i < tile.regions.size(); ++i) cost.join(regions[tile.fragments[i]], tile.regions[i]);
  return internal::Region_merging<Learned_cost>(std::move(regions), internal::boundaries_of_tiles(tiles), cost)
      .run(progress);
}

}  // namespace RW_segmentation

#endif
