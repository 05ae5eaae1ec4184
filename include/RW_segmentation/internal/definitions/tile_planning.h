// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILE_PLANNING_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILE_PLANNING_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/check_number.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/mesh/Face_choice.h>
#include <RW_segmentation/internal/tiles/Edge_set.h>
#include <RW_segmentation/internal/tiles/Joined_faces.h>
#include <RW_segmentation/tile_plan.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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
    std::map<std::array<double, 3>, std::vector<Index>> cells;  // of that size
    const auto cell_of = [&](const Eigen::Vector3d& p) {
      return std::array<double, 3>{std::floor(p[0] / tolerance), std::floor(p[1] / tolerance),
                                   std::floor(p[2] / tolerance)};
    };
    for (std::size_t v = 0; v < points_.size(); ++v) {
      const auto cell = cell_of(points_[v]);
      for (const double x : {-1., 0., 1.})
        for (const double y : {-1., 0., 1.})
          for (const double z : {-1., 0., 1.}) {
            const auto found = cells.find({cell[0] + x, cell[1] + y, cell[2] + z});
            if (found == cells.end()) continue;
            for (const Index other : found->second)
              if ((points_[other] - points_[v]).norm() <= tolerance) unite(static_cast<Index>(v), other);
          }
      cells[cell].push_back(static_cast<Index>(v));
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
    for (std::size_t i = begin; i < end; ++i) {
      tiles[places[i].tile].shared_vertices.push_back({places[i].vertex, id});
      for (std::size_t j = begin; j < end; ++j)
        if (are_apart(i, j)) tiles[places[i].tile].neighbours.push_back(places[j].tile);
    }
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

// ---- Parts ----

namespace internal {

/// The component of each face, over sides.
/// \throws std::invalid_argument if a wall is no side
inline Components components_over_sides(const Tile& tile) {
  Joined_faces joined(tile.corners, tile.points.size());
  check_walls(tile, joined);
  return {Dual_graph(tile.number_of_faces(), std::move(joined.sides)), [](Dual_mesh::Index) { return true; }};
}

/// Some faces of a tile as a tile of their own, without walls.
inline Tile tile_of_faces(const Tile& tile, const std::vector<Dual_mesh::Index>& faces, Face_choice& choice) {
  auto [corners, vertices] = choice([&](Dual_mesh::Index f) { return tile.corners[f]; }, faces);
  Tile piece;
  piece.corners = std::move(corners);
  for (const auto v : vertices) {
    piece.points.push_back(tile.points[v]);
    if (!tile.vertex_ids.empty()) piece.vertex_ids.push_back(tile.vertex_ids[v]);
  }
  return piece;
}

/// Gives each piece of a tile the walls that are sides of its faces.
inline void share_walls(const Tile& tile, std::vector<Tile_piece>& pieces) {
  if (tile.walls.empty()) return;
  using Index = Dual_mesh::Index;
  const Edge_set walls(tile.walls);
  for (auto& [piece, faces] : pieces) {
    for (Index f = 0; f < faces.size(); ++f) {
      const auto in_tile = tile.corners[faces[f]], in_piece = piece.corners[f];
      for (std::size_t k = 0; k < in_tile.size(); ++k) {
        const std::size_t next = k + 1 < in_tile.size() ? k + 1 : 0;
        if (walls.contains({in_tile[k], in_tile[next]}))
          piece.walls.push_back({std::min(in_piece[k], in_piece[next]), std::max(in_piece[k], in_piece[next])});
      }
    }
    std::sort(piece.walls.begin(), piece.walls.end());
    piece.walls.erase(std::unique(piece.walls.begin(), piece.walls.end()), piece.walls.end());
  }
}

/// By tile of a plan: the lowest of those that it is connected to, itself included.
inline std::vector<Dual_mesh::Index> lowest_connected(const Tile_plan& plan) {
  boost::disjoint_sets_with_storage<> sets(plan.tiles.size());
  for (std::size_t piece = 0; piece < plan.tiles.size(); ++piece)
    for (const auto neighbour : plan.tiles[piece].neighbours) sets.union_set(piece, std::size_t(neighbour));
  std::vector<Dual_mesh::Index> lowest(plan.tiles.size(), std::numeric_limits<Dual_mesh::Index>::max());
  std::vector<Dual_mesh::Index> connected;
  for (std::size_t piece = 0; piece < plan.tiles.size(); ++piece) {
    auto& first = lowest[sets.find_set(piece)];
    first = std::min(first, static_cast<Dual_mesh::Index>(piece));
    connected.push_back(first);
  }
  return connected;
}

/// Takes a box that is too small for the exactness of coordinates to a least one.
inline void widen_box(Tile_plan& plan, const Unit_box& whole) {
  constexpr double least_unit = 1e-2;  // that of `Parts_in_boxes`
  const double factor = std::max(least_unit * whole.unit / plan.box.unit, 1.);
  plan.box.unit *= factor;
  plan.box.rounding = std::max(plan.box.rounding, whole.rounding * whole.unit / plan.box.unit);
  plan.total_area /= factor * factor;
  for (Tile_plan::Of_tile& tile : plan.tiles) tile.area_before /= factor * factor;
}

/// Adds what has been found of another connected piece, whose vertices are numbered on.
inline void join_survey(Tile_survey& survey, const Tile_survey& other) {
  for (const Dual_mesh::Index vertex : other.border_vertices)
    survey.border_vertices.push_back(static_cast<Dual_mesh::Index>(survey.vertices + vertex));
  survey.border_points.insert(survey.border_points.end(), other.border_points.begin(), other.border_points.end());
  survey.border_ids.insert(survey.border_ids.end(), other.border_ids.begin(), other.border_ids.end());
  survey.faces += other.faces;
  survey.vertices += other.vertices;
  survey.area += other.area;
  survey.box.extend(other.box);
}

/// Connected pieces of a tile as one, their vertices one piece after the other.
inline Tile_piece joined_pieces(const std::vector<Tile_piece>& pieces) {
  using Index = Dual_mesh::Index;
  struct Source {
    Index face;         // of the tile
    std::size_t piece;  // its place
    Index face_of_piece;
  };
  Tile_piece joined;
  std::vector<Source> sources;
  std::vector<Index> first_vertex;  // by piece
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Tile& tile = pieces[p].tile;
    first_vertex.push_back(static_cast<Index>(joined.tile.points.size()));
    for (Index f = 0; f < tile.number_of_faces(); ++f) sources.push_back({pieces[p].faces[f], p, f});
    joined.tile.points.insert(joined.tile.points.end(), tile.points.begin(), tile.points.end());
    joined.tile.vertex_ids.insert(joined.tile.vertex_ids.end(), tile.vertex_ids.begin(), tile.vertex_ids.end());
    for (const auto& [u, v] : tile.walls) joined.tile.walls.push_back({first_vertex[p] + u, first_vertex[p] + v});
  }
  std::sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) { return a.face < b.face; });
  for (const auto& [face, p, face_of_piece] : sources) {
    joined.faces.push_back(face);
    for (const Index v : pieces[p].tile.corners[face_of_piece]) joined.tile.corners.add(first_vertex[p] + v);
    joined.tile.corners.end_face();
  }
  return joined;
}

}  // namespace internal

RW_SEGMENTATION_INLINE Tile_piece whole_tile(Tile tile) {
  std::vector<Dual_mesh::Index> faces(tile.number_of_faces());
  std::iota(faces.begin(), faces.end(), Dual_mesh::Index(0));
  return {std::move(tile), std::move(faces)};
}

RW_SEGMENTATION_INLINE std::vector<Tile_piece> connected_pieces(Tile tile) {
  using Index = Dual_mesh::Index;
  internal::check_tile(tile);
  if (tile.number_of_faces() == 0) return {};
  const internal::Components components = internal::components_over_sides(tile);
  std::vector<Tile_piece> pieces;
  if (components.count == 1) {
    pieces.push_back(whole_tile(std::move(tile)));
    return pieces;
  }
  pieces.resize(components.count);
  for (Index f = 0; f < tile.number_of_faces(); ++f) pieces[components.of[f]].faces.push_back(f);
  internal::Face_choice choice(tile.points.size());
  for (Tile_piece& piece : pieces) piece.tile = internal::tile_of_faces(tile, piece.faces, choice);
  internal::share_walls(tile, pieces);
  return pieces;
}

RW_SEGMENTATION_INLINE double Tile_parts::largest_area() const {
  double largest = 0;
  for (const Part& part : parts) largest = std::max(largest, part.area);
  return largest;
}

RW_SEGMENTATION_INLINE std::vector<Tile_parts::Piece> Tile_parts::neighbours(std::size_t tile,
                                                                             std::size_t place) const {
  const auto& [part, number] = places[tile][place];
  const auto& [plan, pieces, area] = parts[part];
  std::vector<Piece> result;
  for (const auto n : plan.tiles[number].neighbours) result.push_back(pieces[n]);
  return result;
}

namespace internal {

/// What is known of a part before it has a plan.
struct Surveyed_part {
  std::vector<Tile_survey> pieces;
  std::vector<std::size_t> faces_before;  // by piece, see `Tile_plan`
};

/// Takes the connected pieces of a part in each tile together.
/// \param surveys of the connected pieces of all tiles
/// \param tile_of these
/// \param lowest of those that each is connected to
/// \param[out] parts all but their plans
inline std::vector<Surveyed_part> join_connected_pieces(const std::vector<Tile_survey>& surveys,
                                                        const std::vector<Dual_mesh::Index>& tile_of,
                                                        const std::vector<Dual_mesh::Index>& lowest,
                                                        Tile_parts& parts) {
  using Index = Dual_mesh::Index;
  std::vector<Surveyed_part> surveyed;
  std::vector<Index> part_of(surveys.size());  // of the lowest pieces
  std::size_t faces_before = 0;
  for (std::size_t i = 0; i < surveys.size(); ++i) {
    if (lowest[i] == i) {
      part_of[i] = static_cast<Index>(parts.parts.size());
      parts.parts.emplace_back();
      surveyed.emplace_back();
    }
    const Index part = part_of[lowest[i]], tile = tile_of[i];
    auto& [plan, pieces, area] = parts.parts[part];
    if (pieces.empty() || pieces.back().tile != tile) {
      parts.places[tile].push_back({part, static_cast<Index>(pieces.size())});
      pieces.push_back({tile, static_cast<Index>(parts.places[tile].size() - 1)});
      surveyed[part].pieces.emplace_back();
      surveyed[part].faces_before.push_back(faces_before);
    }
    parts.piece_of_connected[tile].push_back(pieces.back().place);
    join_survey(surveyed[part].pieces.back(), surveys[i]);
    area += surveys[i].area;
    faces_before += surveys[i].faces;
  }
  return surveyed;
}

}  // namespace internal

RW_SEGMENTATION_INLINE Tile_parts parts_of_tiles(const std::vector<std::vector<Tile_survey>>& surveys, double tolerance,
                                                 bool by_component) {
  std::vector<Tile_survey> of_all;  // connected pieces, one tile after the other
  std::vector<Dual_mesh::Index> tile_of;
  for (std::size_t t = 0; t < surveys.size(); ++t) {
    of_all.insert(of_all.end(), surveys[t].begin(), surveys[t].end());
    tile_of.resize(of_all.size(), static_cast<Dual_mesh::Index>(t));
  }
  const Tile_plan all = internal::plan_tiles(of_all, tile_of, tolerance);
  const auto lowest = by_component ? internal::lowest_connected(all) : std::vector<Dual_mesh::Index>(of_all.size(), 0);
  Tile_parts result;
  result.box = all.box;
  result.places.resize(surveys.size());
  result.piece_of_connected.resize(surveys.size());
  const auto surveyed = internal::join_connected_pieces(of_all, tile_of, lowest, result);
  for (std::size_t p = 0; p < surveyed.size(); ++p) {
    Tile_plan& plan = result.parts[p].plan;
    plan = plan_tiles(surveyed[p].pieces, tolerance);
    plan.faces_of_mesh = all.faces_of_mesh;
    for (std::size_t i = 0; i < plan.tiles.size(); ++i) plan.tiles[i].faces_before = surveyed[p].faces_before[i];
    internal::widen_box(plan, result.box);
  }
  return result;
}

RW_SEGMENTATION_INLINE std::vector<Tile_piece> pieces_of_parts(std::vector<Tile_piece> connected,
                                                               const Tile_parts& parts, std::size_t tile) {
  std::vector<std::vector<Tile_piece>> of_pieces(parts.places[tile].size());
  for (std::size_t c = 0; c < connected.size(); ++c)
    of_pieces[parts.piece_of_connected[tile][c]].push_back(std::move(connected[c]));
  std::vector<Tile_piece> pieces;
  for (std::vector<Tile_piece>& together : of_pieces)
    pieces.push_back(together.size() == 1 ? std::move(together.front()) : internal::joined_pieces(together));
  return pieces;
}

}  // namespace RW_segmentation

#endif
