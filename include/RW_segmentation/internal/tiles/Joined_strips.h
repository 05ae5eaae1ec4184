// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_TILES_JOINED_STRIPS_H
#define RW_SEGMENTATION_INTERNAL_TILES_JOINED_STRIPS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/mesh/Face_corners.h>
#include <RW_segmentation/internal/mesh/Face_geometry.h>
#include <RW_segmentation/internal/tiles/Edge_set.h>
#include <RW_segmentation/internal/tiles/Joined_faces.h>
#include <RW_segmentation/tiled_boundaries.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <vector>

namespace RW_segmentation::internal {

/// The strips of a tile and its neighbours, glued together.
struct Joined_strips {
  using Index = Dual_mesh::Index;

  Dual_mesh mesh;
  std::vector<Index> tile;           ///< by face
  std::vector<std::size_t> segment;  ///< by face
  std::vector<Index> id;             ///< by vertex: the same in all tiles, or `Tile_border::none`

  /// \param neighbours of the tile, in the order of the plan
  Joined_strips(const Tile_in_plan& place, const Tile_strip& strip, const std::vector<Tile_strip>& neighbours,
                double wall_angle) {
    add(static_cast<Index>(place.number), strip);
    for (std::size_t n = 0; n < neighbours.size(); ++n)
      add(place.plan.tiles[place.number].neighbours[n], neighbours[n]);
    std::vector<char> is_wall = walls_of(Joined_faces(corners_, points_.size()), wall_angle, place.plan.box.rounding);
    mesh = part_of(place.plan, std::move(corners_), std::move(points_), std::move(is_wall));
  }

 private:
  void add(Index number, const Tile_strip& strip) {
    const Tile_border& faces = strip.faces;
    std::vector<Index> vertex;
    for (std::size_t p = 0; p < faces.points.size(); ++p) vertex.push_back(vertex_of(faces, p));
    for (Index f = 0; f < faces.corners.number_of_faces(); ++f) {
      for (const Index p : faces.corners[f]) corners_.add(vertex[p]);
      corners_.end_face();
    }
    tile.insert(tile.end(), faces.corners.number_of_faces(), number);
    segment.insert(segment.end(), strip.segments.begin(), strip.segments.end());
    for (const auto& [p, q] : faces.walls) walls_.push_back({vertex[p], vertex[q]});
  }

  Index vertex_of(const Tile_border& faces, std::size_t point) {
    const auto next = static_cast<Index>(points_.size());
    if (faces.ids[point] != Tile_border::none) {
      const auto [place, is_new] = vertex_of_id_.emplace(faces.ids[point], next);
      if (!is_new) return place->second;
    }
    points_.push_back(faces.points[point]);
    id.push_back(faces.ids[point]);
    return next;
  }

  /// Those given, and sharp edges; empty if none can be.
  std::vector<char> walls_of(const Joined_faces& joined, double wall_angle, double rounding) const {
    std::vector<char> is_wall;
    if (walls_.empty() && !std::isfinite(wall_angle)) return is_wall;
    const auto is_sharp = [&](const std::array<Index, 2>& faces) {
      const Eigen::Vector3d a = measures_of(points_, corners_[faces[0]], rounding).normal;
      const Eigen::Vector3d b = measures_of(points_, corners_[faces[1]], rounding).normal;
      return std::atan2(a.cross(b).norm(), a.dot(b)) > wall_angle;
    };
    const Edge_set given(walls_);
    for (std::size_t e = 0; e < joined.sides.size(); ++e)
      is_wall.push_back(given.contains(joined.ends[e]) || is_sharp(joined.sides[e]));
    return is_wall;
  }

  Face_corners corners_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<Index, 2>> walls_;
  std::unordered_map<Index, Index> vertex_of_id_;
};

}  // namespace RW_segmentation::internal

#endif
