// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILE_PLANNING_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILE_PLANNING_H

#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/check_number.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/tiles/Edge_set.h>
#include <RW_segmentation/internal/tiles/Joined_faces.h>
#include <RW_segmentation/tile_plan.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// \throws std::invalid_argument
inline void check_tile(const Tile& tile) {
  const std::size_t vertices = tile.points.size();
  check_number(vertices, "vertices");
  check_number(tile.number_of_faces(), "faces");
  for (std::size_t v = 0; v < vertices; ++v)
    if (!tile.points[v].allFinite())
      throw std::invalid_argument("vertex " + std::to_string(v) + " has a coordinate that is not finite");
  for (Dual_mesh::Index f = 0; f < tile.number_of_faces(); ++f) {
    const auto corners = tile.corners[f];
    if (corners.size() < 3) throw std::invalid_argument("face " + std::to_string(f) + " has fewer than three corners");
    if (*std::max_element(corners.begin(), corners.end()) >= vertices)
      throw std::invalid_argument("face " + std::to_string(f) + " has a corner that is not a vertex");
  }
  if (!tile.vertex_ids.empty() && tile.vertex_ids.size() != vertices)
    throw std::invalid_argument("there are " + std::to_string(tile.vertex_ids.size()) + " vertex ids for " +
                                std::to_string(vertices) + " vertices");
}

/// \throws std::invalid_argument if a wall is no side of a face
inline void check_walls(const Tile& tile, const Joined_faces& joined) {
  if (tile.walls.empty()) return;
  std::vector<std::array<Dual_mesh::Index, 2>> ends = joined.ends;
  ends.insert(ends.end(), joined.open_ends.begin(), joined.open_ends.end());
  const Edge_set sides(std::move(ends));
  for (const auto& wall : tile.walls)
    if (!sides.contains(wall))
      throw std::invalid_argument("a wall joins vertices " + std::to_string(wall[0]) + " and " +
                                  std::to_string(wall[1]) + ", between which no face has a side");
}

/// The area of a face, as a fan about its first corner.
inline double area_of(const Face_corners::Range& corners, const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& apex = points[corners[0]];
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += (points[corners[k]] - apex).cross(points[corners[k + 1]] - apex) / 2;
  return sum.norm();
}

}  // namespace internal

RW_SEGMENTATION_INLINE Tile_survey survey_tile(const Tile& tile) {
  internal::check_tile(tile);
  Tile_survey survey;
  survey.faces = tile.number_of_faces();
  survey.vertices = tile.points.size();
  for (Dual_mesh::Index f = 0; f < survey.faces; ++f) {
    survey.area += internal::area_of(tile.corners[f], tile.points);
    for (const auto v : tile.corners[f]) survey.box.extend(tile.points[v]);
  }
  const internal::Joined_faces joined(tile.corners, tile.points.size());
  internal::check_walls(tile, joined);
  for (const auto& [from, to] : joined.open_ends) {
    survey.border_vertices.push_back(from);
    survey.border_vertices.push_back(to);
  }
  auto& border = survey.border_vertices;
  std::sort(border.begin(), border.end());
  border.erase(std::unique(border.begin(), border.end()), border.end());
  for (const auto v : border) {
    survey.border_points.push_back(tile.points[v]);
    if (!tile.vertex_ids.empty()) survey.border_ids.push_back(tile.vertex_ids[v]);
  }
  return survey;
}

namespace internal {

/// Border vertices of all tiles, one tile after the other, and which of them are the same.
class Border_matching {
 public:
  using Index = Dual_mesh::Index;

  explicit Border_matching(const std::vector<Tile_survey>& surveys) {
    for (const Tile_survey& survey : surveys) {
      points_.insert(points_.end(), survey.border_points.begin(), survey.border_points.end());
      ids_.insert(ids_.end(), survey.border_ids.begin(), survey.border_ids.end());
    }
    check_number(points_.size(), "vertices on the borders of tiles");
    rank_.resize(points_.size());
    parent_.resize(points_.size());
    for (std::size_t v = 0; v < parent_.size(); ++v) parent_[v] = static_cast<Index>(v);
  }

  /// Those with the same id.
  void match_ids() {
    match_equal(std::vector<std::uint64_t>(ids_), [](std::uint64_t a, std::uint64_t b) { return a < b; });
  }

  /// Those in exactly the same place.
  void match_places() {
    match_equal(std::vector<Eigen::Vector3d>(points_), [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    });
  }

  /// Those not farther from each other than a tolerance.
  void match_near(double tolerance) {
    // However many vertices a large tolerance brings together, each is compared with few: a cell has few groups, as their first
    // vertices are farther apart, and groups that the vertex belongs to already or whose boxes are too far away are passed over.
    struct Group {  // within the tolerance of the first one
      std::vector<Index> vertices;
      Eigen::AlignedBox3d box;
    };
    std::map<std::array<double, 3>, std::vector<Group>> cells;  // of the size of the tolerance
    const auto cell_of = [&](const Eigen::Vector3d& p) {
      return std::array<double, 3>{std::floor(p[0] / tolerance), std::floor(p[1] / tolerance),
                                   std::floor(p[2] / tolerance)};
    };
    for (std::size_t v = 0; v < points_.size(); ++v) {
      const auto vertex = static_cast<Index>(v);
      const Eigen::Vector3d& point = points_[v];
      const auto is_near = [&](Index other) { return (points_[other] - point).norm() <= tolerance; };
      const auto cell = cell_of(point);
      std::vector<Group>& groups = cells[cell];
      auto own =
          std::find_if(groups.begin(), groups.end(), [&](const Group& group) { return is_near(group.vertices[0]); });
      if (own == groups.end()) own = groups.emplace(own);
      own->vertices.push_back(vertex);
      own->box.extend(point);
      unite(vertex, own->vertices[0]);
      for (const double x : {-1., 0., 1.})
        for (const double y : {-1., 0., 1.})
          for (const double z : {-1., 0., 1.}) {
            const auto found = cells.find({cell[0] + x, cell[1] + y, cell[2] + z});
            if (found == cells.end()) continue;
            for (const auto& [vertices, box] : found->second)
              if (representative(vertex) != representative(vertices[0]) && box.exteriorDistance(point) <= tolerance &&
                  std::any_of(vertices.begin(), vertices.end(), is_near))
                unite(vertex, vertices[0]);
          }
    }
  }

  /// One for all vertices that are the same.
  Index representative(std::size_t vertex) { return sets().find_set(static_cast<Index>(vertex)); }

 private:
  boost::disjoint_sets<int*, Index*> sets() { return {rank_.data(), parent_.data()}; }
  void unite(Index a, Index b) { sets().union_set(a, b); }

  template <class Value, class Less>
  void match_equal(const std::vector<Value>& values, const Less& less) {
    std::vector<Index> order(parent_);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return less(values[a], values[b]); });
    for (std::size_t i = 1; i < order.size(); ++i)
      if (!less(values[order[i - 1]], values[order[i]])) unite(order[i - 1], order[i]);
  }

  std::vector<Eigen::Vector3d> points_;
  std::vector<std::uint64_t> ids_;
  std::vector<int> rank_;
  std::vector<Index> parent_;
};

/// Tells tiles which of their vertices others have, too.
/// \param together numbers of the tiles; those of the same number do not meet
inline void share_vertices(const std::vector<Tile_survey>& surveys, const std::vector<Dual_mesh::Index>& together,
                           Border_matching& matching, std::vector<Tile_plan::Of_tile>& tiles) {
  using Index = Dual_mesh::Index;
  struct Place {
    Index id, tile, vertex;
  };
  std::vector<Place> places;
  std::size_t number = 0;
  for (std::size_t t = 0; t < surveys.size(); ++t)
    for (const Index vertex : surveys[t].border_vertices)
      places.push_back({matching.representative(number++), static_cast<Index>(t), vertex});
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::tie(a.id, a.tile, a.vertex) < std::tie(b.id, b.tile, b.vertex);
  });

  Index id = 0;
  for (std::size_t begin = 0, end = 0; begin < places.size(); begin = end) {
    while (end < places.size() && places[end].id == places[begin].id) ++end;
    const auto are_apart = [&](std::size_t i, std::size_t j) {
      return together[places[i].tile] != together[places[j].tile];
    };
    if (!are_apart(begin, end - 1)) continue;  // numbers rise with the tiles
    std::vector<std::size_t> first_of_tiles;
    for (std::size_t i = begin; i < end; ++i) {
      tiles[places[i].tile].shared_vertices.push_back({places[i].vertex, id});
      if (i == begin || places[i].tile != places[i - 1].tile) first_of_tiles.push_back(i);
    }
    for (const std::size_t i : first_of_tiles)
      for (const std::size_t j : first_of_tiles)
        if (are_apart(i, j)) tiles[places[i].tile].neighbours.push_back(places[j].tile);
    ++id;
  }
  for (Tile_plan::Of_tile& tile : tiles) {
    std::sort(tile.shared_vertices.begin(), tile.shared_vertices.end(),
              [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
    auto& neighbours = tile.neighbours;
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  }
}

/// \param together rising numbers of the tiles; those of the same number do not meet
inline Tile_plan plan_tiles(const std::vector<Tile_survey>& surveys, const std::vector<Dual_mesh::Index>& together,
                            double tolerance) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance))
    throw internal::argument_error("tolerance", tolerance, "a finite number >= 0");
  Tile_plan plan;
  plan.tiles.resize(surveys.size());
  std::vector<Eigen::Vector3d> corners_of_boxes;
  std::size_t with_ids = 0, with_border = 0;
  for (const Tile_survey& survey : surveys) {
    plan.faces += survey.faces;
    if (!survey.box.isEmpty()) corners_of_boxes.insert(corners_of_boxes.end(), {survey.box.min(), survey.box.max()});
    with_border += !survey.border_points.empty();
    with_ids += !survey.border_ids.empty();
  }
  if (with_ids > 0 && with_ids < with_border)
    throw std::invalid_argument("some tiles have vertex ids and others have not");

  plan.box = internal::Unit_box(corners_of_boxes);
  for (std::size_t t = 0; t < surveys.size(); ++t) {
    plan.tiles[t].area_before = plan.total_area;
    plan.tiles[t].faces_before = plan.faces_of_mesh;
    plan.faces_of_mesh += surveys[t].faces;
    plan.total_area += surveys[t].area / (plan.box.unit * plan.box.unit);
  }
  internal::Border_matching matching(surveys);
  if (with_ids > 0)
    matching.match_ids();
  else if (tolerance > 0)
    matching.match_near(tolerance);
  else
    matching.match_places();
  internal::share_vertices(surveys, together, matching, plan.tiles);
  return plan;
}

}  // namespace internal

RW_SEGMENTATION_INLINE Tile_plan plan_tiles(const std::vector<Tile_survey>& surveys, double tolerance) {
  std::vector<Dual_mesh::Index> numbers(surveys.size());
  std::iota(numbers.begin(), numbers.end(), Dual_mesh::Index(0));
  return internal::plan_tiles(surveys, numbers, tolerance);
}

}  // namespace RW_segmentation

#endif
