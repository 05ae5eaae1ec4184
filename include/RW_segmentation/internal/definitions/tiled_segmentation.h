// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILED_SEGMENTATION_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILED_SEGMENTATION_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/definitions/tile_merging.h>
#include <RW_segmentation/internal/definitions/tile_planning.h>
#include <RW_segmentation/internal/definitions/tile_shape.h>
#include <RW_segmentation/internal/definitions/tile_walk.h>
#include <RW_segmentation/internal/tiles/steps_in_memory.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation {

RW_SEGMENTATION_INLINE std::vector<std::vector<std::size_t>> Tiled_hierarchy::segments(
    std::size_t number_of_segments) const {
  const std::vector<std::size_t> segment = tree.segment_of_fragments(number_of_segments);
  std::vector<std::vector<std::size_t>> result;
  for (const auto& fragments : fragment_of_face) {
    result.emplace_back();
    for (const auto fragment : fragments) result.back().push_back(segment[fragment]);
  }
  return result;
}

namespace internal {

/// What the steps up to the fragments leave of tiles that are in memory together.
struct Walked_tiles {
  Tile_seeds seeds;
  Tile_walk walk;
  std::vector<Tile_regions> regions;                            // by tile
  std::vector<std::vector<Dual_mesh::Index>> fragment_of_face;  // by tile and face
};

/// \param place_seeds a function from the plan, shapes and outlines of the tiles to their seeds
template <class Place_seeds>
Walked_tiles walk_over_tiles_in_memory(const std::vector<Tile>& tiles, const Tiled_segmentation& options,
                                       const Place_seeds& place_seeds, const Progress& progress) {
  const std::size_t count = tiles.size();
  const Tile_plan plan = plan_in_memory(tiles, options.tolerance);
  const auto part = [&](double begin, double end, std::size_t t) {
    return progress_of_tile(progress, begin, end, t, count);
  };

  std::vector<Tile_border> borders;
  std::vector<Tile_noise> noises(count);
  for (std::size_t t = 0; t < count; ++t)
    borders.push_back(border_of_tile(tiles[t], {t, plan}, noises[t], options, part(0, 0.3, t)));
  const internal::Noise_of_mesh noise = noise_of_tiles(noises);
  std::vector<Tile_shape> shapes;
  std::vector<Tile_outline> outlines(count);
  for (std::size_t t = 0; t < count; ++t) {
    Shaped_tile shaped =
        shape_of_tile(tiles[t], {t, plan}, of_neighbours(plan, borders, t), noise, options, part(0.3, 0.6, t));
    shapes.push_back(std::move(shaped.shape));
    outlines[t] = std::move(shaped.outline);
  }
  Walked_tiles walked;
  walked.seeds = place_seeds(plan, shapes, outlines, progress.part(0.6, 0.65));
  std::vector<Tile_clusters> clusters;
  std::vector<Tile_network> networks(count);
  for (std::size_t t = 0; t < count; ++t) {
    part(0.65, 0.75, t)(0);
    clusters.push_back(clusters_of_tile(shapes[t], {t, plan}, borders[t], walked.seeds, networks[t], options));
  }
  walked.walk = walk_over_tiles(plan, walked.seeds, networks, options, progress.part(0.75, 0.85));
  walked.regions.resize(count);
  for (std::size_t t = 0; t < count; ++t)
    walked.fragment_of_face.push_back(fragments_of_tile({{t, plan},
                                                         shapes[t],
                                                         clusters[t],
                                                         of_neighbours(plan, borders, t),
                                                         of_neighbours(plan, networks, t),
                                                         walked.seeds,
                                                         walked.walk},
                                                        walked.regions[t], part(0.85, 0.95, t)));
  return walked;
}

}  // namespace internal

RW_SEGMENTATION_INLINE Tiled_hierarchy internal::hierarchy_of_tiles(const std::vector<Tile>& tiles,
                                                                    const Tiled_segmentation& options,
                                                                    const Progress& progress) {
  internal::Walked_tiles walked = internal::walk_over_tiles_in_memory(
      tiles, options,
      [&](const Tile_plan& plan, const std::vector<Tile_shape>&, const std::vector<Tile_outline>& outlines,
          const Progress& part) { return seeds_of_tiles(plan, outlines, options, part); },
      progress);
  Tiled_hierarchy hierarchy;
  hierarchy.tree = merge_tiles(walked.walk, walked.regions, progress.part(0.95, 1));
  hierarchy.fragment_of_face = std::move(walked.fragment_of_face);
  hierarchy.components = walked.walk.components;
  hierarchy.clusters = walked.walk.clusters;
  hierarchy.turned_sides = walked.seeds.turned_sides;
  progress(1);
  return hierarchy;
}

RW_SEGMENTATION_INLINE std::vector<std::vector<Dual_mesh::Index>> internal::segments_of_tiles(
    const std::vector<Tile>& tiles, const std::vector<Seed_point>& seeds, const Tiled_segmentation& options,
    const Progress& progress) {
  const auto given = [&](const Tile_plan& plan, const std::vector<Tile_shape>& shapes,
                         const std::vector<Tile_outline>& outlines, const Progress&) {
    std::vector<std::vector<Tile_place>> places;
    for (const Tile_shape& shape : shapes) places.push_back(places_in_tile(shape, plan, seeds));
    return seeds_of_tiles(plan, outlines, seeds, places);
  };
  internal::Walked_tiles walked = internal::walk_over_tiles_in_memory(tiles, options, given, progress);
  progress(1);
  return std::move(walked.fragment_of_face);
}

}  // namespace RW_segmentation

#endif
