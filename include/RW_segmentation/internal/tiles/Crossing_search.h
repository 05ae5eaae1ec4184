// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_TILES_CROSSING_SEARCH_H
#define RW_SEGMENTATION_INTERNAL_TILES_CROSSING_SEARCH_H

#include <RW_segmentation/internal/boundary/Border_way.h>
#include <RW_segmentation/internal/boundary/Boundary_chain.h>
#include <RW_segmentation/internal/boundary/Surface_curve.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>
#include <RW_segmentation/internal/boundary/Walled_surface.h>
#include <RW_segmentation/internal/tiles/Joined_strips.h>
#include <RW_segmentation/tiled_boundaries.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Finds where smooth boundaries cross the border of a tile.
///
/// A tile that is to end a boundary at a crossing must always be able to do so: where its smooth boundary cannot, it follows
/// the edges of the tile, and then a way over the faces along the border to the crossing (`Border_way`). So a crossing needs
/// such ways in both tiles that nothing else comes into.
class Crossing_search {
 public:
  using Index = Triangle_surface::Index;

  /// Keeps references to all but the place.
  /// \param surface of the strips
  Crossing_search(const Joined_strips& strips, const Walled_surface& surface, const Tile_in_plan& place)
      : strips_(strips),
        walled_(surface),
        surface_(surface.whole()),
        number_(static_cast<Index>(place.number)),
        tiles_(strips.mesh,
               [&](Index edge) {
                 const auto& [f, g] = strips.mesh.graph().faces_of(edge);
                 return strips.tile[f] == strips.tile[g] && !strips.mesh.is_wall(edge);
               }),
        least_height_(slimness * surface_.mean_edge_length()) {
    count_sides();
    count_owners(place);
  }

  /// \param curves of the chains, smoothed
  std::vector<Tile_crossing> operator()(const std::vector<Boundary_chain>& chains,
                                        const std::vector<Surface_curve>& curves) {
    std::vector<Found> found;
    for (std::size_t c = 0; c < chains.size(); ++c) {
      if (!curves[c].is_smoothed) continue;
      const std::vector<Passage> of_chain = passages(chains[c]);
      for (const Passage& passage : of_chain)
        if (auto crossing = crossing_at({passage, of_chain, chains[c], curves[c]}))
          found.push_back(std::move(*crossing));
    }
    return apart(found);
  }

 private:
  /// Of a face that a crossing needs, in mean edge lengths: pieces of it are then higher than what is refused
  /// (`Surface_refinement::least_relative_height`), even in a tile whose edges are a hundred times as long.
  static constexpr double slimness = 0.01;

  /// A part of a chain between two edges in different tiles; what lies between them runs along the border.
  struct Passage {
    std::size_t from, to;  ///< the edges, as numbers in the chain
    std::size_t sides;     ///< edges between them
  };

  /// A crossing, and what no other one may have.
  struct Found {
    Tile_crossing crossing;
    std::set<Index> vertices;   ///< that ways lead round
    std::optional<Index> edge;  ///< that it is on
  };

  // ---- The border ----

  /// Sides of the tiles at each vertex, by tile: those that leave it and those that lead there.
  void count_sides() {
    for (Index h = 0; h < tiles_.number_of_halfedges(); ++h) {
      if (!tiles_.is_border(h)) continue;
      const Index tile = strips_.tile[Triangle_surface::face(h)];
      ++sides_at_[{vertex(h), tile}][0];
      ++sides_at_[{vertex(Triangle_surface::next(h)), tile}][1];
    }
  }

  void count_owners(const Tile_in_plan& place) {
    const auto count = [&](std::size_t tile) {
      for (const auto& shared : place.plan.tiles[tile].shared_vertices) ++owners_[shared.id];
    };
    count(place.number);
    for (const auto neighbour : place.plan.tiles[place.number].neighbours) count(neighbour);
  }

  /// The vertex that a halfedge leaves. Unlike those of the surfaces it is one even where fans of faces touch.
  Index vertex(Index h) const { return Triangle_surface::corner(strips_.mesh, h); }
  Index id(Index h) const { return strips_.id[vertex(h)]; }

  std::array<Index, 2> tiles_of(Index h) const {
    const Index twin = surface_.twin(h);
    return {strips_.tile[Triangle_surface::face(h)], strips_.tile[Triangle_surface::face(twin)]};
  }
  bool is_within_tile(Index h) const { return tiles_of(h)[0] == tiles_of(h)[1]; }
  /// Whether a halfedge lies between two tiles, one of which is the other one's only neighbour there.
  bool is_between(Index h, const std::array<Index, 2>& tiles) const {
    return !surface_.is_border(h) && std::minmax(tiles_of(h)[0], tiles_of(h)[1]) == std::minmax(tiles[0], tiles[1]);
  }

  /// Whether the border between two tiles passes a vertex once, and there is no other tile and no wall.
  bool is_simple(Index at, const std::array<Index, 2>& tiles) const {
    const Index shared = strips_.id[at];
    if (shared == Tile_border::none || owners_.at(shared) != 2) return false;
    return std::all_of(tiles.begin(), tiles.end(), [&](Index tile) {
      const auto sides = sides_at_.find({at, tile});
      return sides != sides_at_.end() && sides->second == std::array<std::size_t, 2>{1, 1};
    });
  }

  // ---- Chains ----

  std::vector<Passage> passages(const Boundary_chain& chain) const {
    const std::size_t size = chain.halfedges.size();
    std::vector<std::size_t> within;  // tiles
    for (std::size_t i = 0; i < size; ++i)
      if (is_within_tile(chain.halfedges[i])) within.push_back(i);
    std::vector<Passage> result;
    for (std::size_t k = chain.is_closed ? 0 : 1; k < within.size(); ++k) {
      const std::size_t from = within[(k + within.size() - 1) % within.size()], to = within[k];
      const auto tile = [&](std::size_t i) { return tiles_of(chain.halfedges[i])[0]; };
      if (tile(from) != tile(to)) result.push_back({from, to, (to + size - from) % size - 1});
    }
    return result;
  }

  /// How far from a passage a node comes, in edges of the chain.
  static std::size_t distance(const Curve_node& node, const Passage& passage, const Boundary_chain& chain) {
    const std::size_t size = chain.halfedges.size(), at = node.origin;
    const auto steps = [&](std::size_t begin, std::size_t end) {  // forward
      if (end >= begin) return end - begin;
      return chain.is_closed ? end + size - begin : size;
    };
    if (steps(passage.from, at) <= passage.sides + 1) return 0;
    return std::min(steps(passage.to, at), steps(at, passage.from));
  }

  /// Whether a node comes from the edges of a passage or close to them.
  static bool is_near(const Curve_node& node, const Passage& passage, const Boundary_chain& chain) {
    constexpr std::size_t reach = 4;  // edges; a smooth boundary is off the jagged one by an edge or two
    return distance(node, passage, chain) <= reach;
  }

  // ---- Crossings ----

  /// A passage with all that belongs to it.
  struct Smooth_passage {
    const Passage& passage;
    const std::vector<Passage>& of_chain;  // this one and the others
    const Boundary_chain& chain;
    const Surface_curve& curve;
  };

  std::optional<Found> crossing_at(const Smooth_passage& smooth) const {
    const auto& [passage, of_chain, chain, curve] = smooth;
    const Index into_first = chain.halfedges[passage.from], into_second = surface_.twin(chain.halfedges[passage.to]);
    const std::array tiles = {tiles_of(into_first)[0], tiles_of(into_second)[0]};
    const std::array ends = {vertex(surface_.twin(into_first)), vertex(surface_.twin(into_second))};
    if (std::min(tiles[0], tiles[1]) != number_ || !is_along_border(passage, chain, tiles) ||
        !is_simple(ends[0], tiles) || !is_simple(ends[1], tiles))
      return std::nullopt;
    const auto place = border_node(smooth, tiles);
    if (!place) return std::nullopt;
    const auto beyond = ways_beyond(*place, smooth);
    const std::size_t low = tiles[0] < tiles[1] ? 0 : 1, high = 1 - low;
    Found found;
    Tile_crossing& crossing = found.crossing;
    crossing.tiles = {tiles[low], tiles[high]};
    crossing.ends = {strips_.id[ends[low]], strips_.id[ends[high]]};
    crossing.beyond = {beyond[high], beyond[low]};
    Curve_node node = curve.nodes[*place];
    if (node.is_vertex()) {
      const Index at = vertex(surface_.leaving(node.vertex));
      if (ends[0] == ends[1] && at == ends[0]) {
        crossing.side = {crossing.ends[0], crossing.ends[0]};
        found.vertices.insert(at);
        return found;
      }
      if (!is_simple(at, tiles) || is_at_vertices(*place, curve)) return std::nullopt;
      node = on_side(at, tiles[0]);
    }
    if (!is_between(node.edge, tiles)) return std::nullopt;
    set_side(node, crossing);
    found.edge = node.edge;
    for (const Index into : {into_first, into_second})
      if (!add_way(into, node.edge, tiles, found)) return std::nullopt;
    return found;
  }

  /// Whether all edges of a passage between its first and its last one lie between its two tiles.
  bool is_along_border(const Passage& passage, const Boundary_chain& chain, const std::array<Index, 2>& tiles) const {
    if (passage.sides > Border_way::most_sides) return false;
    for (std::size_t k = 1; k <= passage.sides; ++k)
      if (!is_between(chain.halfedges[(passage.from + k) % chain.halfedges.size()], tiles)) return false;
    return true;
  }

  /// The node on the border where a curve goes on from the one tile to the other, the closest to a passage and closer to it
  /// than to any other. The border is jagged: a curve may cross it back and forth.
  std::optional<std::size_t> border_node(const Smooth_passage& smooth, const std::array<Index, 2>& tiles) const {
    const auto& [passage, of_chain, chain, curve] = smooth;
    const std::size_t size = curve.nodes.size();
    std::optional<std::size_t> best;
    for (std::size_t i = curve.is_closed ? 0 : 1; i + (curve.is_closed ? 0 : 1) < size; ++i) {
      const Curve_node& node = curve.nodes[i];
      const bool is_on_border =
          node.is_vertex() ? id(surface_.leaving(node.vertex)) != Tile_border::none : !is_within_tile(node.edge);
      if (!is_on_border || !is_near(node, passage, chain)) continue;
      const std::size_t here = distance(node, passage, chain);
      const auto is_nearer = [&](const Passage& other) { return distance(node, other, smooth.chain) < here; };
      if (std::any_of(of_chain.begin(), of_chain.end(), is_nearer)) continue;
      if (tile_of_line(curve.nodes[(i + size - 1) % size], node) != tiles[0] ||
          tile_of_line(node, curve.nodes[(i + 1) % size]) != tiles[1])
        continue;
      if (!best || here < distance(curve.nodes[*best], passage, chain)) best = i;
    }
    return best;
  }

  /// The tile that a line between two consecutive nodes lies in; nothing along a side between tiles.
  std::optional<Index> tile_of_line(const Curve_node& from, const Curve_node& to) const {
    const Curve_node& on_edge = from.is_vertex() ? to : from;
    const Curve_node& other = from.is_vertex() ? from : to;
    const auto has_other = [&](Index h) {
      return other.is_vertex() ? surface_.source(h) == other.vertex : surface_.edge(h) == other.edge;
    };
    std::vector<Index> sides;
    if (on_edge.is_vertex())
      surface_.any_leaving(on_edge.vertex, [&](Index h) {
        sides.push_back(h);
        return false;
      });
    else
      sides = {on_edge.edge, surface_.twin(on_edge.edge)};
    std::optional<Index> tile;
    for (const Index h : sides) {
      if (h == Triangle_surface::none ||
          (!has_other(Triangle_surface::next(h)) && !has_other(Triangle_surface::previous(h))))
        continue;
      const Index of_face = strips_.tile[Triangle_surface::face(h)];
      if (tile && *tile != of_face) return std::nullopt;
      tile = of_face;
    }
    return tile;
  }

  /// Whether the nodes beside one are vertices, so that the curve runs along edges as on a crease.
  static bool is_at_vertices(std::size_t place, const Surface_curve& curve) {
    const std::size_t size = curve.nodes.size();
    return curve.nodes[(place + 1) % size].is_vertex() || curve.nodes[(place + size - 1) % size].is_vertex();
  }

  /// A node close to a vertex, on the side of a tile that leaves it.
  Curve_node on_side(Index at, Index tile) const {
    Index h = surface_.leaving(at);
    surface_.any_leaving(at, [&](Index leaving) {
      h = leaving;
      return strips_.tile[Triangle_surface::face(leaving)] == tile && !is_within_tile(leaving);
    });
    return crossing(surface_, h, 0, 0);
  }

  /// Where the curve comes from and where it goes on, as far as its points are apart. Vectors from the node.
  std::array<Eigen::Vector3d, 2> ways_beyond(std::size_t place, const Smooth_passage& smooth) const {
    const auto& [passage, of_chain, chain, curve] = smooth;
    double length = 0;
    std::set<std::size_t> origins;
    for (std::size_t i = 0; i < curve.number_of_lines(); ++i) {
      if (!is_near(curve.nodes[i], passage, chain) || !is_near(curve.end_of_line(i), passage, chain)) continue;
      length += (point_of(surface_, curve.end_of_line(i)) - point_of(surface_, curve.nodes[i])).norm();
      origins.insert(curve.nodes[i].origin);
    }
    const double spacing = origins.empty() ? 0 : length / static_cast<double>(origins.size());
    return {point_along(curve, place, false, spacing), point_along(curve, place, true, spacing)};
  }

  /// The vector from a node of a curve to the point at a distance along it, or to its end.
  Eigen::Vector3d point_along(const Surface_curve& curve, std::size_t place, bool is_forward, double distance) const {
    const std::size_t size = curve.nodes.size();
    const Eigen::Vector3d from = point_of(surface_, curve.nodes[place]);
    Eigen::Vector3d last = from;
    for (std::size_t k = 1; k < size; ++k) {
      if (!curve.is_closed && (is_forward ? place + k >= size : k > place)) break;
      const std::size_t i = (is_forward ? place + k : place + size - k) % size;
      const Eigen::Vector3d step = point_of(surface_, curve.nodes[i]) - last;
      const double length = step.norm();
      if (length >= distance) return last + (length > 0 ? distance / length : 0) * step - from;
      distance -= length;
      last += step;
    }
    return last - from;
  }

  /// Takes the side that a node is on, and a position that is the same number from either end.
  void set_side(const Curve_node& node, Tile_crossing& crossing) const {
    constexpr double off_the_ends = 0.03;  // of the side: farther than what moves to a vertex
    constexpr double steps = 4294967296;   // 2^32: 1 minus so rounded a number is exact
    const double position = std::clamp(node.position, off_the_ends, 1 - off_the_ends);
    crossing.position = std::round(position * steps) / steps;
    crossing.side = {id(node.edge), id(Triangle_surface::next(node.edge))};
    if (crossing.side[0] < crossing.side[1]) return;
    std::swap(crossing.side[0], crossing.side[1]);
    crossing.position = 1 - crossing.position;
  }

  /// Notes the way to a crossing within a tile.
  /// \param into leads to the border within the tile
  /// \returns whether it is there, and nothing comes into it
  bool add_way(Index into, Index edge, const std::array<Index, 2>& tiles, Found& found) const {
    if (walled_.is_wall(into) || tiles_.is_on_border(tiles_.source(into))) return false;
    const bool is_of_twin = tiles_of(edge)[0] != strips_.tile[Triangle_surface::face(into)];
    const auto way = border_way(tiles_, into, is_of_twin ? surface_.twin(edge) : edge);
    if (!way) return false;
    for (const Index side : way->sides) {
      const Index at = vertex(way->is_leftward ? side : Triangle_surface::next(side));
      if (!is_between(side, tiles) || walled_.is_wall(side) || !is_simple(at, tiles) || is_low(side)) return false;
      found.vertices.insert(at);
    }
    const Index from = tiles_.source(into);
    const auto leads_there = [&](Index spoke) { return tiles_.target(spoke) == from; };
    const auto crossed_first = way->spokes.begin() + static_cast<std::ptrdiff_t>(way->spokes_to(from, tiles_));
    if (std::any_of(crossed_first, way->spokes.end(), leads_there)) return false;
    std::set<Index> crossed;
    return !is_low(into) && !is_low(surface_.twin(into)) &&
           std::all_of(way->spokes.begin(), way->spokes.end(), [&](Index spoke) {
             const Index twin = surface_.twin(spoke);
             return crossed.insert(surface_.edge(spoke)).second && segment(spoke) == segment(twin) && !is_low(spoke) &&
                    !is_low(twin);
           });
  }

  std::size_t segment(Index h) const { return strips_.segment[Triangle_surface::face(h)]; }

  /// Whether the face of a halfedge is a sliver.
  bool is_low(Index h) const {
    const Index face = Triangle_surface::face(h);
    const double longest =
        std::max({surface_.length(3 * face), surface_.length(3 * face + 1), surface_.length(3 * face + 2)});
    return !(2 * strips_.mesh.area(face) > least_height_ * longest);
  }

  /// Those that are not in the way of another one.
  static std::vector<Tile_crossing> apart(const std::vector<Found>& found) {
    std::map<Index, std::size_t> at_vertex, on_edge;
    for (const Found& one : found) {
      for (const Index v : one.vertices) ++at_vertex[v];
      if (one.edge) ++on_edge[*one.edge];
    }
    std::vector<Tile_crossing> result;
    for (const Found& one : found)
      if (std::all_of(one.vertices.begin(), one.vertices.end(), [&](Index v) { return at_vertex.at(v) == 1; }) &&
          (!one.edge || on_edge.at(*one.edge) == 1))
        result.push_back(one.crossing);
    return result;
  }

  const Joined_strips& strips_;
  const Walled_surface& walled_;
  const Triangle_surface& surface_;
  Index number_;
  Triangle_surface tiles_;  // the surface cut open between tiles, and along walls
  double least_height_;
  std::map<std::array<Index, 2>, std::array<std::size_t, 2>> sides_at_;  // by vertex and tile
  std::unordered_map<Index, std::size_t> owners_;                        // tiles that have a shared vertex
};

}  // namespace RW_segmentation::internal

#endif
