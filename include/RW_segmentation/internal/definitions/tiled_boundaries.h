// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILED_BOUNDARIES_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILED_BOUNDARIES_H

#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/boundary/Boundary_chain.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>
#include <RW_segmentation/internal/boundary/Walled_surface.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/definitions/tile_shape.h>
#include <RW_segmentation/internal/tiles/Crossing_search.h>
#include <RW_segmentation/internal/tiles/Joined_strips.h>
#include <RW_segmentation/tiled_boundaries.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// The faces of a tile round the shared vertices at which segments meet.
/// \param id by vertex
inline std::vector<Dual_mesh::Index> faces_where_boundaries_leave(const Dual_mesh& mesh,
                                                                  const std::vector<Dual_mesh::Index>& id,
                                                                  const std::vector<std::size_t>& segment_of_face) {
  std::unordered_map<Dual_mesh::Index, std::size_t> first;  // segment at a shared vertex
  std::vector<char> is_left(mesh.number_of_vertices(), false);
  const auto for_each_corner = [&](const auto& use) {
    for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f)
      for (const auto v : mesh.corners(f))
        if (id[v] != Tile_border::none) use(f, v);
  };
  for_each_corner([&](Dual_mesh::Index f, Dual_mesh::Index v) {
    if (first.emplace(v, segment_of_face[f]).first->second != segment_of_face[f]) is_left[v] = true;
  });
  std::vector<Dual_mesh::Index> faces;
  for_each_corner([&](Dual_mesh::Index f, Dual_mesh::Index v) {
    if (is_left[v]) faces.push_back(f);
  });
  return faces;
}

}  // namespace internal

RW_SEGMENTATION_INLINE Tile_strip strip_of_tile(const Tile& tile, const Tile_in_plan& place,
                                                const std::vector<std::size_t>& segment_of_face,
                                                const Boundary_smoothing& smoothing) {
  // Of the smoothing; what lies farther from the border moves a crossing by less than a thirtieth of what it moves itself.
  constexpr double lengths = 5;
  internal::require_boundary_smoothing_numbers(smoothing);
  if (segment_of_face.size() != tile.number_of_faces())
    throw internal::argument_error("the number of segments", segment_of_face.size(), "one for each face");
  for (Dual_mesh::Index f = 0; f < tile.number_of_faces(); ++f)
    if (tile.corners[f].size() != 3)
      throw std::invalid_argument("face " + std::to_string(f) +
                                  " is no triangle: boundaries are smoothed on these only");
  const auto& [number, plan] = place;
  const Dual_mesh mesh = internal::part_of(plan, tile.corners, internal::points_in_box(tile, plan.box), {});
  const auto id = internal::ids_of_vertices(mesh, plan.tiles[number].shared_vertices);
  Tile_strip strip;
  strip.faces.width = lengths * std::max(smoothing.length, 1.) * mesh.mean_edge_length();
  internal::take_border(mesh, internal::faces_where_boundaries_leave(mesh, id, segment_of_face), id, tile.walls,
                        strip.faces);
  for (const auto f : strip.faces.faces) strip.segments.push_back(segment_of_face[f]);
  return strip;
}

RW_SEGMENTATION_INLINE std::vector<Tile_crossing> internal::crossings_of_tile(
    const Tile_in_plan& place, const Tile_strip& strip, const std::vector<Tile_strip>& neighbours,
    const Boundary_smoothing& smoothing, double wall_angle, const Progress& progress) {
  require_boundary_smoothing_numbers(smoothing);
  if (!(wall_angle >= 0)) throw argument_error("wall_angle", wall_angle, "not negative");
  if (strip.segments.empty()) return {};
  const Joined_strips joined(place, strip, neighbours, wall_angle);
  const Walled_surface surface(joined.mesh);
  const std::vector<Surface_curve> curves =
      smoothed_curves(joined.mesh, surface, joined.segment, smoothing, Traced_joining(), {}, progress);
  return Crossing_search(joined, surface, place)(Boundary_chains(surface, joined.segment)(), curves);
}

RW_SEGMENTATION_INLINE std::vector<internal::Border_crossing> internal::border_crossings(
    const Dual_mesh& mesh, const Tile_in_plan& place, const std::vector<Tile_crossing>& crossings) {
  const auto& [number, plan] = place;
  std::unordered_map<Dual_mesh::Index, Dual_mesh::Index> vertex_of_id;
  for (const auto& [vertex, id] : plan.tiles[number].shared_vertices) vertex_of_id.emplace(id, vertex);
  std::unordered_map<Dual_mesh::Index, std::vector<std::size_t>> of_vertex;  // by the lower end of their sides
  std::vector<Border_crossing> result;
  std::vector<std::array<Dual_mesh::Index, 2>> ends;  // of the sides
  const double scale = plan.box.unit / mesh.unit();
  for (const Tile_crossing& crossing : crossings) {
    const auto of_tile = std::find(crossing.tiles.begin(), crossing.tiles.end(), number);
    if (of_tile == crossing.tiles.end()) continue;
    const auto i = static_cast<std::size_t>(of_tile - crossing.tiles.begin());
    result.push_back(
        {vertex_of_id.at(crossing.ends[i]), Triangle_surface::none, crossing.position, scale * crossing.beyond[i]});
    ends.push_back({vertex_of_id.at(crossing.side[0]), vertex_of_id.at(crossing.side[1])});
    of_vertex[std::min(ends.back()[0], ends.back()[1])].push_back(ends.size() - 1);
  }
  if (result.empty()) return result;
  for (Dual_mesh::Index h = 0; h < 3 * mesh.number_of_faces(); ++h) {
    const auto from = Triangle_surface::corner(mesh, h), to = Triangle_surface::corner(mesh, Triangle_surface::next(h));
    const auto found = of_vertex.find(std::min(from, to));
    if (found == of_vertex.end()) continue;
    for (const std::size_t c : found->second) {
      if (ends[c] != std::array{from, to} && ends[c] != std::array{to, from}) continue;
      result[c].side = h;
      if (ends[c][0] == to) result[c].position = 1 - result[c].position;
    }
  }
  return result;
}

RW_SEGMENTATION_INLINE Dual_mesh internal::as_part_of_whole(const Dual_mesh& mesh, const Tile_plan& plan) {
  const double scale = plan.box.unit / mesh.unit();
  return mesh.as_part_of(plan.total_area * scale * scale);
}

}  // namespace RW_segmentation

#endif
