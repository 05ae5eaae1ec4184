// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_TILE_FOLDER_H
#define SEGMENT_MESH_TILES_TILE_FOLDER_H

#include "step_contents.h"

#include <RW_segmentation/tiled_segmentation.h>

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace segment_mesh {

namespace RW = RW_segmentation;

/// The folder in which steps leave what later ones need: files of single tiles, and of all.
class Tile_folder {
 public:
  /// \param tiles their names, for messages
  Tile_folder(std::string path, std::vector<std::string> tiles) : path_(std::move(path)), tiles_(std::move(tiles)) {}

  std::size_t number_of_tiles() const { return tiles_.size(); }
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
    try {
      read_step(path(file, tile), file, values...);
    } catch (const mesh_files::Unreadable_file& error) {
      throw mesh_files::Unreadable_file(tiles_[tile] + ": " + error.what());
    }
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
    for (std::size_t t = 0; t < tiles_.size(); ++t) values.push_back(read<Value>(file, t));
    return values;
  }
  template <class Value>
  std::vector<Value> read_neighbours(const char* file, const RW::Tile_plan& plan, std::size_t tile) const {
    std::vector<Value> values;
    for (const auto neighbour : plan.tiles[tile].neighbours) values.push_back(read<Value>(file, neighbour));
    return values;
  }

  /// What a tile has of each part.
  std::vector<RW::Tile_piece> read_pieces(const RW::Tile_parts& parts, std::size_t tile) const {
    return RW::pieces_of_parts(read<std::vector<RW::Tile_piece>>("connected", tile), parts, tile);
  }

  /// Leaves the faces of these to the step that tells their labels.
  void write_faces_of_pieces(std::size_t tile, const std::vector<RW::Tile_piece>& pieces) const {
    std::vector<std::vector<RW::Dual_mesh::Index>> faces;
    for (const RW::Tile_piece& piece : pieces) faces.push_back(piece.faces);
    write_of_tile(tile, "piece_faces", faces);
  }

  /// Passes what a step has left of each part, part by part, to a function of the part's number and a vector by piece in its
  /// plan. No more tiles are in memory than have parts in common with those before.
  template <class Value, class Use>
  void for_each_part(const char* file, const RW::Tile_parts& parts, const Use& use) const {
    struct Tile {
      std::vector<Value> pieces;
      std::size_t left;  // pieces to come
    };
    std::map<std::size_t, Tile> tiles;
    for (std::size_t p = 0; p < parts.parts.size(); ++p) {
      std::vector<Value> of_part;
      for (const auto& [tile, place] : parts.parts[p].pieces) {
        if (tiles.count(tile) == 0) tiles[tile] = {read<std::vector<Value>>(file, tile), parts.places[tile].size()};
        of_part.push_back(std::move(tiles[tile].pieces[place]));
        if (--tiles[tile].left == 0) tiles.erase(tile);
      }
      use(p, std::move(of_part));
    }
  }

  /// What a step has left of the neighbours of each piece of a tile.
  /// \returns by piece, in the order of its neighbours in the plan of its part
  template <class Value>
  std::vector<std::vector<Value>> read_neighbours_of_pieces(const char* file, const RW::Tile_parts& parts,
                                                            std::size_t tile) const {
    std::map<std::size_t, std::vector<Value>> of_tiles;
    std::vector<std::vector<Value>> of_pieces;
    for (std::size_t p = 0; p < parts.places[tile].size(); ++p) {
      of_pieces.emplace_back();
      for (const auto& [other, place] : parts.neighbours(tile, p)) {
        if (of_tiles.count(other) == 0) of_tiles[other] = read<std::vector<Value>>(file, other);
        of_pieces.back().push_back(of_tiles[other][place]);
      }
    }
    return of_pieces;
  }

 private:
  std::string path_;
  std::vector<std::string> tiles_;
};

}  // namespace segment_mesh

#endif
