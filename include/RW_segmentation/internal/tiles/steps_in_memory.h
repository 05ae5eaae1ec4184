// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_TILES_STEPS_IN_MEMORY_H
#define RW_SEGMENTATION_INTERNAL_TILES_STEPS_IN_MEMORY_H

#include <RW_segmentation/Progress.h>
#include <RW_segmentation/tile_plan.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

// What the steps share where all tiles are in memory.

/// The tiles of each part of a mesh.
struct Tiles_of_parts {
  Tile_parts parts;
  std::vector<std::vector<Tile>> tiles;                           ///< by part, and in the order of its plan
  std::vector<std::vector<std::vector<Dual_mesh::Index>>> faces;  ///< of these, by their numbers in the tile

  /// \param by_component otherwise all tiles are one part
  Tiles_of_parts(const std::vector<Tile>& whole, double tolerance, bool by_component) {
    std::vector<std::vector<Tile_piece>> pieces;
    std::vector<std::vector<Tile_survey>> surveys;
    for (const Tile& tile : whole) {
      if (by_component)
        pieces.push_back(connected_pieces(tile));
      else
        pieces.emplace_back().push_back(whole_tile(tile));
      surveys.emplace_back();
      for (const Tile_piece& piece : pieces.back()) surveys.back().push_back(survey_tile(piece.tile));
    }
    parts = parts_of_tiles(surveys, tolerance, by_component);
    for (std::size_t t = 0; t < pieces.size(); ++t) pieces[t] = pieces_of_parts(std::move(pieces[t]), parts, t);
    for (const Tile_parts::Part& part : parts.parts) {
      tiles.emplace_back();
      faces.emplace_back();
      for (const auto& [tile, place] : part.pieces) {
        tiles.back().push_back(std::move(pieces[tile][place].tile));
        faces.back().push_back(std::move(pieces[tile][place].faces));
      }
    }
  }

  /// Writes what is known by face of the tiles of a part into what is by face of the whole tiles.
  /// \param whole by tile and face, large enough
  template <class Value, class Convert>
  void scatter(std::size_t part, const std::vector<std::vector<Value>>& of_part, const Convert& convert,
               std::vector<std::vector<Value>>& whole) const {
    for (std::size_t i = 0; i < of_part.size(); ++i)
      for (std::size_t f = 0; f < of_part[i].size(); ++f)
        whole[parts.parts[part].pieces[i].tile][faces[part][i][f]] = convert(of_part[i][f]);
  }
};

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

/// The progress of each part, by its faces.
inline std::vector<Progress> progress_of_parts(const Progress& progress, const Tile_parts& parts) {
  std::size_t all = 0, before = 0;
  for (const Tile_parts::Part& part : parts.parts) all += part.plan.faces;
  const auto share = [&](std::size_t faces) { return static_cast<double>(faces) / static_cast<double>(all); };
  std::vector<Progress> of_parts;
  for (const Tile_parts::Part& part : parts.parts) {
    of_parts.push_back(progress.part(share(before), share(before + part.plan.faces)));
    before += part.plan.faces;
  }
  return of_parts;
}

}  // namespace RW_segmentation::internal

#endif
