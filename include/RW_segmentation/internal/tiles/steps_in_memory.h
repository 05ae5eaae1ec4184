// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_TILES_STEPS_IN_MEMORY_H
#define RW_SEGMENTATION_INTERNAL_TILES_STEPS_IN_MEMORY_H

#include <RW_segmentation/Progress.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

// What the steps share where all tiles are in memory.

inline Tile_plan plan_in_memory(const std::vector<Tile>& tiles, double tolerance) {
  std::vector<Tile_survey> surveys;
  for (const Tile& tile : tiles) surveys.push_back(survey_tile(tile));
  return plan_tiles(surveys, tolerance);
}

/// What a tile's neighbours left, in their order.
template <class OfTile>
std::vector<OfTile> of_neighbours(const Tile_plan& plan, const std::vector<OfTile>& of_tiles, std::size_t tile) {
  std::vector<OfTile> result;
  for (const auto n : plan.tiles[tile].neighbours) result.push_back(of_tiles[n]);
  return result;
}

/// The progress of a step of one tile.
/// \param begin, end of the step over all tiles, as parts of the work
inline Progress progress_of_tile(const Progress& progress, double begin, double end, std::size_t tile,
                                 std::size_t tiles) {
  const double share = (end - begin) / static_cast<double>(tiles);
  return progress.part(begin + static_cast<double>(tile) * share, begin + static_cast<double>(tile + 1) * share);
}

}  // namespace RW_segmentation::internal

#endif
