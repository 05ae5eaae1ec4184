// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TILE_PLAN_H
#define RW_SEGMENTATION_TILE_PLAN_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Tile.h>
#include <RW_segmentation/internal/mesh/Face_geometry.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

/// \file
/// Where the tiles of a mesh meet, which all further steps go by:
///
///     each tile   `survey_tile()`     how large it is, and its border
///     all         `plan_tiles()`      which borders are the same
///
/// Each connected part of a mesh is a mesh of tiles of its own: what a tile has of a part takes the place of the tile, and what
/// is done for all tiles is done for all of these.
///
///     each tile   `connected_pieces()`  each of them is surveyed
///     all         `parts_of_tiles()`    which of them belong together, and a plan for each part
///     each tile   `pieces_of_parts()`   what the tile has of each part

namespace RW_segmentation {

/// What `survey_tile()` finds.
struct Tile_survey {
  std::size_t faces = 0;                          ///< how many
  std::size_t vertices = 0;                       ///< how many, those without faces included
  double area = 0;                                ///< of all faces
  Eigen::AlignedBox3d box;                        ///< of the vertices that have faces
  std::vector<Dual_mesh::Index> border_vertices;  ///< on open sides, rising
  std::vector<Eigen::Vector3d> border_points;     ///< of these
  std::vector<std::uint64_t> border_ids;          ///< of these, if the tile has ids
};

/// What `plan_tiles()` knows of the whole.
struct Tile_plan {
  /// A vertex on the border of a tile that other tiles have, too.
  struct Shared_vertex {
    Dual_mesh::Index vertex;  ///< of the tile
    Dual_mesh::Index id;      ///< the same in all tiles
  };
  /// What the plan knows of one tile.
  struct Of_tile {
    double area_before = 0;                      ///< of all tiles before this one, in the unit box
    std::size_t faces_before = 0;                ///< of the mesh, in all tiles or pieces before this one
    std::vector<Shared_vertex> shared_vertices;  ///< in the order of the vertices
    std::vector<Dual_mesh::Index> neighbours;    ///< tiles that share a vertex with it, rising
  };

  internal::Unit_box box;         ///< of the whole
  double total_area = 0;          ///< in the unit box
  std::size_t faces = 0;          ///< of all tiles
  std::size_t faces_of_mesh = 0;  ///< where the tiles are those of a part: of all parts
  std::vector<Of_tile> tiles;     ///< by tile
};

/// A tile by its place in a plan.
struct Tile_in_plan {
  std::size_t number;     ///< from 0
  const Tile_plan& plan;  ///< of all tiles
};

/// Looks at a tile by itself.
/// \throws std::invalid_argument if a point is not finite, a corner is no vertex, ids are not one for each vertex or a wall
/// is no side of a face
/// Complexity: linear; O(n log n) for n faces where there are walls.
Tile_survey survey_tile(const Tile& tile);

/// Finds out where tiles meet.
/// \param tolerance how far apart the same vertex may be in two tiles, in the unit of the coordinates
/// \throws std::invalid_argument if some tiles have ids and others have not, or the tolerance is negative
/// Complexity: O(b log b) for b vertices on the borders of all tiles.
Tile_plan plan_tiles(const std::vector<Tile_survey>& surveys, double tolerance = 0);

/// Some faces of a tile, as a tile.
struct Tile_piece {
  Tile tile;                            ///< the piece
  std::vector<Dual_mesh::Index> faces;  ///< by face of the piece: its number in the tile, rising
};

/// The pieces of a tile that are connected over sides, walls or not, in the order of their first faces.
/// \throws std::invalid_argument as `survey_tile()`
/// Complexity: linear; O(n log n) for n faces where there are walls.
std::vector<Tile_piece> connected_pieces(Tile tile);

/// A tile as a piece.
Tile_piece whole_tile(Tile tile);

/// The connected parts of a mesh that comes in tiles.
struct Tile_parts {
  /// What a tile has of a part.
  struct Piece {
    Dual_mesh::Index tile;   ///< from 0
    Dual_mesh::Index place;  ///< among the pieces of the tile, from 0
  };
  /// A part.
  struct Part {
    Tile_plan plan;             ///< in which its pieces are the tiles
    std::vector<Piece> pieces;  ///< in the order of the plan, which is that of the tiles
    double area = 0;            ///< in the square of the unit of the coordinates
  };
  /// Where a piece is.
  struct Place {
    Dual_mesh::Index part;    ///< from 0
    Dual_mesh::Index number;  ///< in the plan of the part
  };

  internal::Unit_box box;                  ///< of the whole
  std::vector<Part> parts;                 ///< in the order of their first faces
  std::vector<std::vector<Place>> places;  ///< by tile and piece
  /// By tile and connected piece of it: the place of the piece that it belongs to.
  std::vector<std::vector<Dual_mesh::Index>> piece_of_connected;

  /// That of the largest part; 0 if there is none.
  double largest_area() const;

  /// Where a piece of a tile is in the plan of its part.
  Tile_in_plan in_plan(std::size_t tile, std::size_t place) const {
    const auto& [part, number] = places[tile][place];
    return {number, parts[part].plan};
  }

  /// The pieces of other tiles that share a vertex with a piece, in the order of the plan of its part.
  std::vector<Piece> neighbours(std::size_t tile, std::size_t place) const;
};

/// Finds out which connected pieces belong together: those of different tiles that meet in more than one vertex. Each part
/// has a unit box of its own, of a hundredth of the whole at least: coordinates are hardly more exact.
/// \param surveys by tile, and by connected piece of it
/// \param tolerance see `plan_tiles()`; pieces of which it makes one vertex of two belong together, and `border_of_tile()`
/// refuses them
/// \param by_component otherwise all are one part
/// \throws std::invalid_argument as `plan_tiles()`
/// Complexity: that of `plan_tiles()`.
Tile_parts parts_of_tiles(const std::vector<std::vector<Tile_survey>>& surveys, double tolerance = 0,
                          bool by_component = true);

/// What a tile has of each part.
/// \param connected its connected pieces
/// Complexity: linear.
std::vector<Tile_piece> pieces_of_parts(std::vector<Tile_piece> connected, const Tile_parts& parts, std::size_t tile);

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/tile_parts.h>
#endif

#endif
