// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_TILE_FOLDER_H
#define SEGMENT_MESH_TILES_TILE_FOLDER_H

#include "step_contents.h"

#include <RW_segmentation/tiled_segmentation.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace segment_mesh {

namespace RW = RW_segmentation;

/// The folder in which steps leave what later ones need: files of single tiles, and of all.
class Tile_folder {
 public:
  Tile_folder(std::string path, std::size_t tiles) : path_(std::move(path)), tiles_(tiles) {}

  std::size_t number_of_tiles() const { return tiles_; }
  std::string path(const std::string& file) const { return path_ + "/" + file; }
  std::string path(const std::string& file, std::size_t tile) const { return path(file) + "_" + std::to_string(tile); }

  template <class... Values>
  void write(const char* file, const Values&... values) const {
    write_step(path(file), file, values...);
  }
  template <class... Values>
  void write_of_tile(std::size_t tile, const char* file, const Values&... values) const {
    write_step(path(file, tile), file, values...);
  }

  /// Reads into several values. \throws mesh_files::Unreadable_file
  template <class... Values>
  void read_into(const char* file, Values&... values) const {
    read_step(path(file), file, values...);
  }
  template <class... Values>
  void read_of_tile_into(std::size_t tile, const char* file, Values&... values) const {
    read_step(path(file, tile), file, values...);
  }

  template <class Value>
  Value read(const char* file) const {
    Value value;
    read_into(file, value);
    return value;
  }
  template <class Value>
  Value read(const char* file, std::size_t tile) const {
    Value value;
    read_of_tile_into(tile, file, value);
    return value;
  }
  template <class Value>
  std::vector<Value> read_all(const char* file) const {
    std::vector<Value> values;
    for (std::size_t t = 0; t < tiles_; ++t) values.push_back(read<Value>(file, t));
    return values;
  }
  template <class Value>
  std::vector<Value> read_neighbours(const char* file, const RW::Tile_plan& plan, std::size_t tile) const {
    std::vector<Value> values;
    for (const auto neighbour : plan.tiles[tile].neighbours) values.push_back(read<Value>(file, neighbour));
    return values;
  }

 private:
  std::string path_;
  std::size_t tiles_;
};

}  // namespace segment_mesh

#endif
