// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILE_PARTS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILE_PARTS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/definitions/tile_planning.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/mesh/Face_choice.h>
#include <RW_segmentation/internal/tiles/Edge_set.h>
#include <RW_segmentation/internal/tiles/Joined_faces.h>
#include <RW_segmentation/tile_plan.h>

#include <Eigen/Core>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation {

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

/// A vertex of the whole in a tile.
struct Vertex_in_tile {
  Dual_mesh::Index id, tile;
  bool has_several_places;  ///< a tolerance that is too large, or an id that is given twice, makes one vertex of them
};

/// The vertices that tiles of a plan share, by id and tile.
inline std::vector<Vertex_in_tile> vertices_in_tiles(const Tile_plan& plan, const std::vector<Tile_survey>& surveys) {
  struct Place {
    Vertex_in_tile vertex;
    const Eigen::Vector3d* point;
  };
  std::vector<Place> places;
  for (std::size_t t = 0; t < plan.tiles.size(); ++t) {
    std::size_t border = 0;  // whose vertices rise, as do those that are shared
    for (const auto& [vertex, id] : plan.tiles[t].shared_vertices) {
      while (surveys[t].border_vertices[border] != vertex) ++border;
      places.push_back({{id, static_cast<Dual_mesh::Index>(t), false}, &surveys[t].border_points[border]});
    }
  }
  const auto order = [](const Place& place) { return std::array{place.vertex.id, place.vertex.tile}; };
  std::sort(places.begin(), places.end(), [&](const Place& a, const Place& b) { return order(a) < order(b); });
  std::vector<Vertex_in_tile> vertices;
  for (std::size_t i = 0, first = 0; i < places.size(); ++i) {
    if (i == 0 || order(places[i]) != order(places[first])) {
      first = i;
      vertices.push_back(places[i].vertex);
    }
    if (*places[i].point != *places[first].point) vertices.back().has_several_places = true;
  }
  return vertices;
}

/// The pairs of tiles of a plan that have more than one vertex in common, as those have that share a side. What is one vertex,
/// but several places in both, counts as several, so that `border_of_tile()` sees the side between them and refuses it.
inline std::vector<std::array<Dual_mesh::Index, 2>> tiles_beside_each_other(const Tile_plan& plan,
                                                                            const std::vector<Tile_survey>& surveys) {
  using Index = Dual_mesh::Index;
  const std::vector<Vertex_in_tile> vertices = vertices_in_tiles(plan, surveys);
  std::vector<std::array<Index, 2>> pairs;  // once for each vertex
  for (std::size_t begin = 0, end = 0; begin < vertices.size(); begin = end) {
    while (end < vertices.size() && vertices[end].id == vertices[begin].id) ++end;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = i + 1; j < end; ++j) {
        const bool are_several = vertices[i].has_several_places && vertices[j].has_several_places;
        pairs.insert(pairs.end(), are_several ? 2U : 1U, {vertices[i].tile, vertices[j].tile});
      }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::array<Index, 2>> result;
  for (std::size_t i = 1; i < pairs.size(); ++i)
    if (pairs[i] == pairs[i - 1] && (result.empty() || result.back() != pairs[i])) result.push_back(pairs[i]);
  return result;
}

/// By tile of a plan: the lowest of those that it is connected to, itself included. To meet in one vertex connects nothing.
inline std::vector<Dual_mesh::Index> lowest_connected(const Tile_plan& plan, const std::vector<Tile_survey>& surveys) {
  boost::disjoint_sets_with_storage<> sets(plan.tiles.size());
  for (const auto& [a, b] : tiles_beside_each_other(plan, surveys)) sets.union_set(std::size_t(a), std::size_t(b));
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
  constexpr double least_unit = 1e-2;  // that of single precision in `Parts_in_boxes`
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
  const auto lowest =
      by_component ? internal::lowest_connected(all, of_all) : std::vector<Dual_mesh::Index>(of_all.size(), 0);
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
