// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_CUT_INTO_TILES_H
#define RW_SEGMENTATION_TEST_CUT_INTO_TILES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Tile.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "meshes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace tiles {

/// The mesh as a single tile.
inline RW_segmentation::Tile as_tile(const meshes::Shape& shape) {
  RW_segmentation::Tile tile;
  tile.points = shape.points;
  for (const auto& face : shape.faces) {
    for (const auto v : face) tile.corners.add(static_cast<RW_segmentation::Dual_mesh::Index>(v));
    tile.corners.end_face();
  }
  return tile;
}

/// Edges by their two vertices, the lower one first.
using Edges = std::set<std::array<std::size_t, 2>>;

/// Calls `use(face, edge)` for each side of each face.
template <class Use>
void for_each_side(const meshes::Shape& shape, const Use& use) {
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    std::size_t from = shape.faces[f].back();
    for (const std::size_t to : shape.faces[f]) {
      use(f, std::array{std::min(from, to), std::max(from, to)});
      from = to;
    }
  }
}

/// The mean of the corners of a face.
inline Eigen::Vector3d middle_of(const meshes::Shape& shape, const std::vector<std::size_t>& face) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto v : face) middle += shape.points[v] / static_cast<double>(face.size());
  return middle;
}

/// A mesh in tiles, and where each of its faces has come to.
struct Cut_mesh {
  std::vector<RW_segmentation::Tile> tiles;
  std::vector<std::map<std::size_t, RW_segmentation::Dual_mesh::Index>> number;  // by tile, of vertices of the mesh
  std::vector<std::pair<std::size_t, std::size_t>> place;                        // by face: tile, and face of it

  /// What tiles say of their faces, in the order of the mesh.
  std::vector<std::size_t> of_whole(const std::vector<std::vector<std::size_t>>& of_tiles) const {
    std::vector<std::size_t> labels;
    for (const auto& [tile, face] : place) labels.push_back(of_tiles[tile][face]);
    return labels;
  }
};

/// Gives each face to the tile that a function of its middle tells.
inline Cut_mesh cut(const meshes::Shape& shape, std::size_t tiles,
                    const std::function<std::size_t(const Eigen::Vector3d&)>& tile_at) {
  Cut_mesh result;
  result.tiles.resize(tiles);
  result.number.resize(tiles);
  for (const auto& face : shape.faces) {
    const std::size_t t = tile_at(middle_of(shape, face));
    RW_segmentation::Tile& tile = result.tiles[t];
    result.place.emplace_back(t, tile.number_of_faces());
    for (const auto v : face) {
      const auto [place, is_new] =
          result.number[t].emplace(v, static_cast<RW_segmentation::Dual_mesh::Index>(tile.points.size()));
      if (is_new) {
        tile.points.push_back(shape.points[v]);
        tile.vertex_ids.push_back(1000 + v);
      }
      tile.corners.add(place->second);
    }
    tile.corners.end_face();
  }
  for (RW_segmentation::Tile& tile : result.tiles) tile.vertex_ids.clear();
  return result;
}

/// Slices along x.
inline Cut_mesh slices(const meshes::Shape& shape, std::size_t tiles) {
  Eigen::AlignedBox3d box;
  for (const auto& p : shape.points) box.extend(p);
  return cut(shape, tiles, [&](const Eigen::Vector3d& p) {
    const double along = (p[0] - box.min()[0]) / box.sizes()[0];
    return std::min(tiles - 1, static_cast<std::size_t>(along * static_cast<double>(tiles)));
  });
}

/// Octants round a point that is not in the middle.
inline Cut_mesh octants(const meshes::Shape& shape) {
  return cut(shape, 8, [](const Eigen::Vector3d& p) {
    return std::size_t(p[0] > 0.13) + 2 * std::size_t(p[1] > 0.07) + 4 * std::size_t(p[2] > -0.05);
  });
}

/// A copy of which one tile names each wall, even if it lies between two.
inline Cut_mesh with_walls(Cut_mesh mesh, const meshes::Shape& shape, Edges walls) {
  for_each_side(shape, [&](std::size_t f, const std::array<std::size_t, 2>& edge) {
    if (walls.erase(edge) == 0) return;
    const std::size_t t = mesh.place[f].first;
    mesh.tiles[t].walls.push_back({mesh.number[t].at(edge[0]), mesh.number[t].at(edge[1])});
  });
  return mesh;
}

/// A part of a mesh, and the closed loops of walls round it.
struct Walled_part {
  std::vector<char> contains;  // by face
  Edges walls;

  Walled_part(const meshes::Shape& shape, const std::function<bool(const Eigen::Vector3d&)>& is_inside) {
    for (const auto& face : shape.faces) contains.push_back(is_inside(middle_of(shape, face)));
    std::map<std::array<std::size_t, 2>, std::size_t> faces_inside;
    for_each_side(shape, [&](std::size_t f, const auto& edge) { faces_inside[edge] += contains[f] != 0; });
    for (const auto& [edge, faces] : faces_inside)
      if (faces == 1) walls.insert(edge);
  }

  /// The labels that there are on both sides.
  std::set<std::size_t> on_both_sides(const std::vector<std::size_t>& labels) const {
    std::set<std::size_t> inside, both;
    for (std::size_t f = 0; f < labels.size(); ++f)
      if (contains[f]) inside.insert(labels[f]);
    for (std::size_t f = 0; f < labels.size(); ++f)
      if (!contains[f] && inside.count(labels[f]) > 0) both.insert(labels[f]);
    return both;
  }
};

}  // namespace tiles

#endif
