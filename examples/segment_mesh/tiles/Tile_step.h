// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_TILE_STEP_H
#define SEGMENT_MESH_TILES_TILE_STEP_H

#include <cstddef>
#include <functional>
#include <vector>

namespace segment_mesh {

/// A step of a segmentation of tiles.
struct Tile_step {
  const char* name;
  bool is_of_each_tile;
  std::vector<const char*> files;        ///< that it leaves, the last one at its end
  std::function<void(std::size_t)> run;  ///< for a tile, or for 0 if it is of all
};

}  // namespace segment_mesh

#endif
