// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILED_SEGMENTATION_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILED_SEGMENTATION_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/definitions/tile_merging.h>
#include <RW_segmentation/internal/definitions/tile_parts.h>
#include <RW_segmentation/internal/definitions/tile_shape.h>
#include <RW_segmentation/internal/definitions/tile_walk.h>
#include <RW_segmentation/internal/tiles/steps_in_memory.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation {

RW_SEGMENTATION_INLINE Tiled_segmentation::Tiled_segmentation(std::size_t segments)
    : seeds(std::max(std::size_t(40), 2 * segments)) {}

RW_SEGMENTATION_INLINE Tiled_segmentation Tiled_segmentation::of_part(double area, double largest_area) const {
  Tiled_segmentation result = *this;
  if (area < least_component * largest_area) result.seeds = 1;
  return result;
}

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
Walked_tiles walk_over_tiles_in_memory(const std::vector<Tile>& tiles, const Tile_plan& plan,
                                       const Tiled_segmentation& options, const Place_seeds& place_seeds,
                                       const Progress& progress) {
  const std::size_t count = tiles.size();
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

inline Tiled_hierarchy hierarchy_of_part(const std::vector<Tile>& tiles, const Tile_plan& plan,
                                         const Tiled_segmentation& options, const Progress& progress) {
  Walked_tiles walked = walk_over_tiles_in_memory(
      tiles, plan, options,
      [&](const Tile_plan&, const std::vector<Tile_shape>&, const std::vector<Tile_outline>& outlines,
          const Progress& part) { return seeds_of_tiles(plan, outlines, options, part); },
      progress);
  Tiled_hierarchy hierarchy;
  hierarchy.tree = merge_tiles(walked.walk, walked.regions, progress.part(0.95, 1));
  hierarchy.fragment_of_face = std::move(walked.fragment_of_face);
  hierarchy.components = walked.walk.components;
  hierarchy.clusters = walked.walk.clusters;
  hierarchy.turned_sides = walked.seeds.turned_sides;
  return hierarchy;
}

}  // namespace internal

RW_SEGMENTATION_INLINE Tiled_hierarchy internal::hierarchy_of_tiles(const std::vector<Tile>& tiles,
                                                                    const Tiled_segmentation& options,
                                                                    const Progress& progress) {
  const internal::Tiles_of_parts whole(tiles, options.tolerance, options.by_component);
  const double largest_area = whole.parts.largest_area();
  Tiled_hierarchy hierarchy;
  for (const Tile& tile : tiles) hierarchy.fragment_of_face.emplace_back(tile.number_of_faces());
  const std::vector<Progress> of_parts = internal::progress_of_parts(progress, whole.parts);
  std::vector<Merge_tree> trees;
  std::size_t fragments = 0;
  for (std::size_t p = 0; p < whole.tiles.size(); ++p) {
    const auto& [plan, pieces, area] = whole.parts.parts[p];
    Tiled_hierarchy part =
        internal::hierarchy_of_part(whole.tiles[p], plan, options.of_part(area, largest_area), of_parts[p]);
    whole.scatter(
        p, part.fragment_of_face,
        [&](std::size_t of_part) { return static_cast<Dual_mesh::Index>(fragments + of_part); },
        hierarchy.fragment_of_face);
    hierarchy.components += part.components;
    hierarchy.clusters += part.clusters;
    hierarchy.turned_sides += part.turned_sides;
    fragments += part.tree.number_of_fragments();
    trees.push_back(std::move(part.tree));
  }
  hierarchy.tree = internal::side_by_side(trees);
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
  std::vector<Tile_survey> surveys;
  for (const Tile& tile : tiles) surveys.push_back(survey_tile(tile));
  const Tile_plan plan_of_all = plan_tiles(surveys, options.tolerance);
  internal::Walked_tiles walked = internal::walk_over_tiles_in_memory(tiles, plan_of_all, options, given, progress);
  progress(1);
  return std::move(walked.fragment_of_face);
}

}  // namespace RW_segmentation

#endif
