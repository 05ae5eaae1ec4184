// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILED_SURFACES_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILED_SURFACES_H

#include <RW_segmentation/Analytic_surface_cost.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/definitions/tile_shape.h>
#include <RW_segmentation/internal/surfaces/Face_patches.h>
#include <RW_segmentation/internal/surfaces/Number_sample.h>
#include <RW_segmentation/internal/surfaces/find_analytic_regions.h>
#include <RW_segmentation/internal/surfaces/noise_trials.h>
#include <RW_segmentation/internal/surfaces/out_of_box.h>
#include <RW_segmentation/internal/surfaces/rounding_step.h>
#include <RW_segmentation/internal/tiles/Joined_nodes.h>
#include <RW_segmentation/internal/tiles/steps_in_memory.h>
#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/tiled_surfaces.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

// ---- Borders and noise ----

/// Copies faces of a mesh, each vertex once.
class Face_sampling {
 public:
  using Index = Dual_mesh::Index;

  /// Keeps references to both.
  Face_sampling(const Dual_mesh& mesh, Sampled_faces& samples) : mesh_(mesh), samples_(samples) {}

  /// \returns the number of the copy
  Index add(Index face) {
    for (const Index v : mesh_.corners(face)) {
      const auto [place, is_new] = number_.emplace(v, static_cast<Index>(samples_.points.size()));
      if (is_new) samples_.points.push_back(mesh_.point(v));
      samples_.corners.add(place->second);
    }
    samples_.corners.end_face();
    return static_cast<Index>(samples_.corners.number_of_faces() - 1);
  }

 private:
  const Dual_mesh& mesh_;
  Sampled_faces& samples_;
  std::unordered_map<Index, Index> number_;  // of each vertex among the points
};

/// The samples of all tiles as one mesh: each lies apart from those of other tiles.
/// \param samples_of a function from what a tile gives to its samples
template <class OfTile, class SamplesOf>
Dual_mesh mesh_of_samples(const Tile_plan& plan, const std::vector<OfTile>& tiles, const SamplesOf& samples_of) {
  Face_corners corners;
  std::vector<Eigen::Vector3d> points;
  for (const OfTile& tile : tiles) {
    const Sampled_faces& samples = samples_of(tile);
    for (Dual_mesh::Index f = 0; f < samples.corners.number_of_faces(); ++f) {
      for (const auto v : samples.corners[f]) corners.add(static_cast<Dual_mesh::Index>(points.size() + v));
      corners.end_face();
    }
    points.insert(points.end(), samples.points.begin(), samples.points.end());
    check_number(points.size(), "samples of surfaces");
  }
  return part_of(plan, std::move(corners), std::move(points), {});
}

/// Takes the faces that an estimate of the noise looks at.
inline Tile_neighbourhoods neighbourhoods_in(const Dual_mesh& mesh, const Tile_in_plan& place) {
  using Index = Dual_mesh::Index;
  // Neighbourhoods end at sharp edges, but not here: they reach farther where they are narrow.
  constexpr std::size_t vertices = 2 * most_vertices_of_noise_trial;
  Tile_neighbourhoods result;
  Face_sampling sampling(mesh, result.faces);
  Face_patches patches(mesh);
  std::unordered_map<Index, Index> number;
  const auto copy = [&](Index f) {
    const auto [known, is_new] = number.emplace(f, Index(0));
    if (is_new) known->second = sampling.add(f);
    return known->second;
  };
  const auto& [tile, plan] = place;
  for (const Index f : noise_trials(mesh.number_of_faces(), plan.faces_of_mesh, plan.tiles[tile].faces_before)) {
    for (const Index g : patches.neighbourhood(f, vertices).faces) copy(g);
    result.middles.push_back(copy(f));
  }
  return result;
}

}  // namespace internal

RW_SEGMENTATION_INLINE Tile_border internal::border_of_tile(const Tile& tile, const Tile_in_plan& place,
                                                            Tile_neighbourhoods& neighbourhoods,
                                                            const Tiled_surfaces& options, const Progress& progress) {
  if (!(options.halo >= 0) || !std::isfinite(options.halo))
    throw internal::argument_error("halo", options.halo, "a finite number >= 0");
  const auto& [number, plan] = place;
  internal::check_corners_are_different(tile, plan.tiles[number].shared_vertices);
  const Dual_mesh mesh = internal::part_of(plan, tile.corners, internal::points_in_box(tile, plan.box), {});
  neighbourhoods = internal::neighbourhoods_in(mesh, place);
  Tile_border border;
  border.width = options.halo * mesh.mean_edge_length();
  internal::take_border(mesh, plan.tiles[number].shared_vertices, tile.walls, border);
  progress(1);
  return border;
}

RW_SEGMENTATION_INLINE Surface_noise noise_of_tiles(const Tile_plan& plan,
                                                    const std::vector<Tile_neighbourhoods>& tiles,
                                                    const Tiled_surfaces& options) {
  std::vector<Dual_mesh::Index> middles;
  std::size_t faces_before = 0;
  for (const Tile_neighbourhoods& tile : tiles) {
    for (const auto f : tile.middles) middles.push_back(static_cast<Dual_mesh::Index>(faces_before + f));
    faces_before += tile.faces.corners.number_of_faces();
  }
  const Dual_mesh mesh = internal::mesh_of_samples(
      plan, tiles, [](const Tile_neighbourhoods& tile) -> const Sampled_faces& { return tile.faces; });
  const internal::Surface_tolerance tolerance = internal::surface_tolerance(mesh, options.noise, middles);
  return {tolerance.noise, tolerance.noise_kind};
}

RW_SEGMENTATION_INLINE Surface_noise noise_of_parts(const Tile_parts& parts,
                                                    const std::vector<std::vector<Tile_neighbourhoods>>& pieces,
                                                    const Tiled_surfaces& options) {
  std::vector<Tile_neighbourhoods> all;
  Tile_plan plan;  // of nothing but a box
  for (const auto& of_tile : pieces) all.insert(all.end(), of_tile.begin(), of_tile.end());
  for (const Tile_parts::Part& part : parts.parts)
    plan.box.rounding = std::max(plan.box.rounding, part.plan.box.rounding);
  const bool is_given = options.noise >= 0;
  const Surface_noise by_part = is_given ? Surface_noise() : noise_of_tiles(plan, all, options);
  if (!is_given && parts.parts.size() == 1) return by_part;
  plan.box = parts.box;
  std::vector<Eigen::Vector3d> points;
  auto neighbourhoods = all.begin();
  for (const auto& of_tile : parts.places)
    for (const auto& place : of_tile) {
      const internal::Unit_box& box = parts.parts[place.part].plan.box;
      std::vector<Eigen::Vector3d>& of_piece = (neighbourhoods++)->faces.points;
      for (Eigen::Vector3d& p : of_piece) p = (p * box.unit + (box.origin - parts.box.origin)) / parts.box.unit;
      points.insert(points.end(), of_piece.begin(), of_piece.end());
    }
  // That coordinates were rounded does not show in parts whose units differ.
  const bool counts_as_exact = !is_given && by_part.deviation == 0;
  if (counts_as_exact && internal::deviation_of_rounding(points) <= internal::Surface_tolerance::least_slight_noise)
    return by_part;
  return noise_of_tiles(plan, all, options);
}

RW_SEGMENTATION_INLINE Surface_noise Surface_noise::in_part(const Tile_parts& parts, std::size_t part) const {
  return {deviation * parts.box.unit / parts.parts[part].plan.box.unit, kind};
}

namespace internal {

// ---- The surfaces of a tile ----

/// The regions of a tile and its halo, those of the tile numbered from 0.
struct Regions_of_part {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  std::vector<std::size_t> region_of_face;  ///< `none` where a region has no face in the tile
  std::vector<char> tells;                  ///< by face: whether it tells about its region's surface
  std::size_t count = 0;
};

/// Faces at the rim of the halo that no surface explains, and those beside them, up to the tile: they may be part of a
/// surface that goes on where the tile does not see it.
inline std::vector<char> unclear_halo(const Tile_shape& shape, const std::vector<std::size_t>& region_of_face) {
  using Index = Dual_mesh::Index;
  const Dual_graph& graph = shape.mesh.graph();
  std::vector<char> is_beside_tile(graph.number_of_faces(), false), is_unclear(graph.number_of_faces(), false);
  for (const auto& shared : shape.shared_edges)
    for (const Index f : graph.faces_of(shared.edge)) is_beside_tile[f] = true;
  std::vector<Index> open;
  const auto reach = [&](Index f) {
    if (f < shape.own_faces || is_unclear[f] || is_beside_tile[f] || region_of_face[f] != Analytic_regions::none)
      return;
    is_unclear[f] = true;
    open.push_back(f);
  };
  for (auto f = static_cast<Index>(shape.own_faces); f < graph.number_of_faces(); ++f)
    if (graph.neighbours(f).size() < shape.mesh.corners(f).size()) reach(f);
  while (!open.empty()) {
    const Index f = open.back();
    open.pop_back();
    for (const auto& neighbour : graph.neighbours(f)) reach(neighbour.face);
  }
  return is_unclear;
}

/// The part for what is done with the surfaces found: on a clean mesh a few flat triangles may be a face of the solid, and
/// walls keep apart from them what is unclear.
inline Dual_mesh without_unclear_halo(const Tile_shape& shape, const Surface_tolerance& tolerance,
                                      const std::vector<std::size_t>& region_of_face) {
  const Dual_mesh& mesh = shape.mesh;
  if (tolerance.is_noisy()) return mesh;
  const std::vector<char> is_unclear = unclear_halo(shape, region_of_face);
  std::vector<char> is_wall;
  is_wall.reserve(mesh.number_of_edges());
  for (Dual_mesh::Index e = 0; e < mesh.number_of_edges(); ++e) {
    const auto [f, g] = mesh.graph().faces_of(e);
    is_wall.push_back(mesh.is_wall(e) || is_unclear[f] != is_unclear[g]);
  }
  return mesh.with_walls(std::move(is_wall));
}

inline Regions_of_part regions_of_part(const Tile_shape& shape, const Surface_tolerance& tolerance,
                                       const Progress& progress) {
  std::vector<Segmentation_report::Stage> stages;
  Stage_clock clock(stages);
  const Analytic_regions surfaces = find_analytic_regions(shape.mesh, tolerance, progress.part(0, 0.8));
  const Segments_on_surfaces found =
      segments_of_regions(without_unclear_halo(shape, tolerance, surfaces.region_of_face), tolerance,
                          surfaces.region_of_face, progress.part(0.8, 1), clock);
  const std::vector<std::size_t> segment =
      found.tree.segment_of_fragments(Cost_threshold_stop(Surface_segmentation().stop_cost)(found.tree));
  Regions_of_part regions;
  std::vector<std::size_t> number(segment.size(), Regions_of_part::none);
  for (std::size_t f = 0; f < found.fragment_of_face.size(); ++f) {
    std::size_t& region = number[segment[found.fragment_of_face[f]]];
    if (region == Regions_of_part::none && f < shape.own_faces) region = regions.count++;
    regions.region_of_face.push_back(region);
    regions.tells.push_back(!found.is_given[f]);
  }
  return regions;
}

/// The most samples of a region in one tile. With 80 and 500, `benchmark_engineering --method tiles` has the overlaps .973 and
/// .973 on CAD solids (`_5k`), .871 and .873 under noise of .1 %; with 200 .973 and .873.
constexpr std::size_t samples_of_region = 200;

/// Takes samples of the regions, from the halo as well.
inline void take_samples(const Dual_mesh& mesh, const Regions_of_part& regions, Tile_surfaces& surfaces) {
  using Index = Dual_mesh::Index;
  std::vector<Number_sample> samples(regions.count);
  for (Index f = 0; f < mesh.number_of_faces(); ++f)
    if (regions.region_of_face[f] != Regions_of_part::none && regions.tells[f])
      samples[regions.region_of_face[f]].insert(f, samples_of_region);
  Face_sampling sampling(mesh, surfaces.samples);
  for (std::size_t region = 0; region < samples.size(); ++region)
    samples[region].for_each([&](Index f) {
      sampling.add(f);
      surfaces.region_of.push_back(static_cast<Index>(region));
    });
}

/// Takes the boundaries between the regions, and the sides of the tile.
inline void take_boundaries(const Tile_shape& shape, std::size_t number, const Regions_of_part& regions,
                            const Surface_tolerance& tolerance, Tile_surfaces& surfaces) {
  using Index = Dual_mesh::Index;
  const Dual_mesh& mesh = shape.mesh;
  const std::vector<double> sharpness = edge_sharpness(mesh, tolerance);
  const auto sums_of = [&](Index e) -> Edge_sums {
    const double length = mesh.edge_length(e) / mesh.length_unit();
    return {length, length * sharpness[e]};
  };
  std::map<std::array<Index, 2>, Edge_sums> boundaries;
  std::set<std::array<Index, 2>> beside_walls;
  for (Index e = 0; e < mesh.number_of_edges(); ++e) {
    const auto [f, g] = mesh.graph().faces_of(e);
    if (f >= shape.own_faces || g >= shape.own_faces) continue;
    surfaces.walls += mesh.is_wall(e);
    const auto [a, b] = std::minmax(regions.region_of_face[f], regions.region_of_face[g]);
    if (a == b) continue;
    const std::array<Index, 2> pair = {static_cast<Index>(a), static_cast<Index>(b)};
    if (mesh.is_wall(e))
      beside_walls.insert(pair);
    else
      boundaries[pair] += sums_of(e);
  }
  surfaces.beside_walls.assign(beside_walls.begin(), beside_walls.end());
  for (const auto& [pair, sums] : boundaries) surfaces.boundaries.push_back({pair, sums});
  for (const auto& shared : shape.shared_edges) {
    const Index e = shared.edge;
    const bool is_owner = number < shared.neighbour;
    surfaces.walls += is_owner && mesh.is_wall(e);
    const auto& faces = mesh.graph().faces_of(e);
    const bool is_smooth = sharpness[e] * tolerance.sharp_angle(faces) < tolerance.smooth_angle(faces);
    const Tile_surfaces::Side_sums sums = {sums_of(e), is_smooth, mesh.is_wall(e)};
    surfaces.sides.push_back({shared.side, static_cast<Index>(regions.region_of_face[own_face(shape, shared)]), 0,
                              is_owner ? sums : Tile_surfaces::Side_sums(), is_owner});
  }
}

}  // namespace internal

RW_SEGMENTATION_INLINE std::vector<Dual_mesh::Index> internal::surfaces_of_tile(
    const Tile& tile, const Tile_in_plan& place, const std::vector<Tile_border>& neighbours, const Surface_noise& noise,
    Tile_surfaces& surfaces, const Tiled_surfaces& options, const Progress& progress) {
  const auto& [number, plan] = place;
  surfaces = {};
  Tile_shape shape =
      internal::Tile_surroundings(tile, place, neighbours, options.wall_angle).shape(surfaces.turned_sides);
  if (shape.own_faces == 0) return {};
  shape.mesh = internal::with_stored_normals(shape.mesh);
  const internal::Surface_tolerance tolerance(shape.mesh, noise.deviation, noise.kind);
  const internal::Regions_of_part regions = internal::regions_of_part(shape, tolerance, progress);
  internal::take_samples(shape.mesh, regions, surfaces);
  internal::take_boundaries(shape, number, regions, tolerance, surfaces);
  surfaces.areas.resize(regions.count);
  std::vector<Dual_mesh::Index> region_of_face;
  for (Dual_mesh::Index f = 0; f < shape.own_faces; ++f) {
    region_of_face.push_back(static_cast<Dual_mesh::Index>(regions.region_of_face[f]));
    if (plan.total_area > 0) surfaces.areas[region_of_face.back()] += shape.mesh.area(f) / plan.total_area;
  }
  return region_of_face;
}

namespace internal {

// ---- All tiles ----

/// The samples of all tiles and the region of each.
struct Sampled_surfaces {
  Dual_mesh mesh;
  Surface_tolerance tolerance;
  std::vector<std::size_t> region_of_face;

  Sampled_surfaces(const Tile_plan& plan, const Surface_noise& noise, const std::vector<Tile_surfaces>& tiles,
                   const Joined_nodes& nodes)
      : mesh(mesh_of_samples(plan, tiles,
                             [](const Tile_surfaces& tile) -> const Sampled_faces& { return tile.samples; })),
        tolerance(mesh, noise.deviation, noise.kind) {
    for (std::size_t t = 0; t < tiles.size(); ++t)
      for (const auto region : tiles[t].region_of) region_of_face.push_back(nodes(t, region));
  }
};

inline Joined_nodes regions_of_tiles(const std::vector<Tile_surfaces>& tiles) {
  return Joined_nodes(tiles, [](const Tile_surfaces& tile) { return tile.areas.size(); });
}

/// The fragment of each region: free forms that meet smoothly at a side between two tiles are one.
inline std::vector<std::size_t> fragments_of_regions(const std::vector<Tile_surfaces>& tiles, const Joined_nodes& nodes,
                                                     const Analytic_surface_cost& cost,
                                                     const std::vector<Analytic_surface_cost::Region>& regions,
                                                     std::size_t& count) {
  using Index = Dual_mesh::Index;
  std::vector<int> rank(nodes.count());
  std::vector<Index> parent(nodes.count());
  std::iota(parent.begin(), parent.end(), Index(0));
  boost::disjoint_sets<int*, Index*> sets(rank.data(), parent.data());
  const auto is_free_form = [&](Index region) {
    return cost.surface_of(regions[region]).type == Surface_type::free_form;
  };
  nodes.for_each_side(tiles, [&](const auto& owner, Index a, const auto&, Index b) {
    if (owner.value.is_smooth && !owner.value.is_wall && is_free_form(a) && is_free_form(b)) sets.union_set(a, b);
  });
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> number(nodes.count(), none), fragment;
  count = 0;
  for (Index region = 0; region < nodes.count(); ++region) {
    std::size_t& of_set = number[sets.find_set(region)];
    if (of_set == none) of_set = count++;
    fragment.push_back(of_set);
  }
  return fragment;
}

/// The boundaries between the regions of all tiles, in no order.
/// \param[out] beside_walls regions on the two sides of a wall
inline std::vector<Boundary_of_regions<Edge_sums>> boundaries_of_regions(
    const std::vector<Tile_surfaces>& tiles, const Joined_nodes& nodes,
    std::vector<std::array<Dual_mesh::Index, 2>>& beside_walls) {
  using Index = Dual_mesh::Index;
  std::vector<Boundary_of_regions<Edge_sums>> boundaries;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    for (const auto& [regions, sums] : tiles[t].boundaries)
      boundaries.push_back({{nodes(t, regions[0]), nodes(t, regions[1])}, sums});
    for (const auto& regions : tiles[t].beside_walls)
      beside_walls.push_back({nodes(t, regions[0]), nodes(t, regions[1])});
  }
  nodes.for_each_side(tiles, [&](const auto& owner, Index a, const auto&, Index b) {
    if (owner.value.is_wall)
      beside_walls.push_back({a, b});
    else
      boundaries.push_back({{std::min(a, b), std::max(a, b)}, owner.value.edge});
  });
  return boundaries;
}

}  // namespace internal

RW_SEGMENTATION_INLINE Merged_surfaces merge_tiles(const Tile_plan& plan, const Surface_noise& noise,
                                                   const std::vector<Tile_surfaces>& tiles, const Progress& progress) {
  const internal::Joined_nodes nodes = internal::regions_of_tiles(tiles);
  const internal::Sampled_surfaces samples(plan, noise, tiles, nodes);
  const Analytic_surface_cost cost(samples.mesh, samples.tolerance, internal::samples_of_region);
  const std::vector<Analytic_surface_cost::Region> regions = internal::join_faces(
      samples.region_of_face, nodes.count(), cost, [&](Dual_mesh::Index f) { return cost.region(samples.mesh, f); });
  std::size_t count = 0;
  const std::vector<std::size_t> fragment = internal::fragments_of_regions(tiles, nodes, cost, regions, count);
  Merged_surfaces merged;
  std::vector<Analytic_surface_cost::Region> of_fragment(count);
  for (std::size_t r = 0; r < regions.size(); ++r) cost.join(of_fragment[fragment[r]], regions[r]);
  std::vector<std::array<Dual_mesh::Index, 2>> beside_walls;
  auto boundaries = internal::join_boundaries(internal::boundaries_of_regions(tiles, nodes, beside_walls), fragment);
  for (const auto& boundary : boundaries) merged.neighbours.push_back(boundary.regions);
  for (const auto& [a, b] : beside_walls)
    merged.neighbours.push_back(
        {static_cast<Dual_mesh::Index>(fragment[a]), static_cast<Dual_mesh::Index>(fragment[b])});
  merged.tree = internal::Region_merging<Analytic_surface_cost>(std::move(of_fragment), std::move(boundaries), cost)
                    .run(progress);
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    merged.fragments.emplace_back();
    for (Dual_mesh::Index r = 0; r < tiles[t].areas.size(); ++r)
      merged.fragments[t].push_back(static_cast<Dual_mesh::Index>(fragment[nodes(t, r)]));
    merged.turned_sides += tiles[t].turned_sides;
    merged.walls += tiles[t].walls;
  }
  progress(1);
  return merged;
}

RW_SEGMENTATION_INLINE std::vector<Analytic_surface> surfaces_of_tiles(
    const Tile_plan& plan, const Surface_noise& noise, const std::vector<Tile_surfaces>& tiles,
    const Merged_surfaces& merged, const std::vector<std::size_t>& segment_of_fragment,
    std::size_t number_of_segments) {
  const internal::Joined_nodes nodes = internal::regions_of_tiles(tiles);
  const internal::Sampled_surfaces samples(plan, noise, tiles, nodes);
  std::vector<std::size_t> segment_of_face;
  for (const std::size_t region : samples.region_of_face) {
    const auto [tile, of_tile] = nodes.tile_and_place(static_cast<Dual_mesh::Index>(region));
    segment_of_face.push_back(segment_of_fragment.at(merged.fragments[tile][of_tile]));
  }
  std::vector<Analytic_surface> surfaces =
      internal::surfaces_in_unit_box(samples.mesh, segment_of_face, number_of_segments, samples.tolerance);
  for (Analytic_surface& surface : surfaces)
    surface = internal::out_of_box(surface, samples.mesh.unit(), samples.mesh.origin());
  return surfaces;
}

// ---- Parts ----

RW_SEGMENTATION_INLINE Merge_tree tree_of_parts(const std::vector<Part_surfaces>& parts) {
  std::vector<Merge_tree> trees;
  for (const Part_surfaces& part : parts) trees.push_back(part.merged.tree);
  return internal::side_by_side(trees);
}

RW_SEGMENTATION_INLINE std::vector<Analytic_surface> surfaces_of_parts(
    const Tile_parts& parts, const Surface_noise& noise, const std::vector<Part_surfaces>& surfaces,
    const std::vector<std::size_t>& segment_of_fragment, std::size_t number_of_segments) {
  std::vector<Analytic_surface> result(number_of_segments);
  std::size_t begin = 0;  // of the fragments of a part
  for (std::size_t p = 0; p < surfaces.size(); ++p) {
    const auto& [regions, merged] = surfaces[p];
    std::vector<std::size_t> segments;  // of the part
    std::unordered_map<std::size_t, std::size_t> number;
    std::vector<std::size_t> segment_in_part;
    for (std::size_t i = 0; i < merged.tree.number_of_fragments(); ++i) {
      const std::size_t segment = segment_of_fragment.at(begin + i);
      const auto [place, is_new] = number.emplace(segment, segments.size());
      if (is_new) segments.push_back(segment);
      segment_in_part.push_back(place->second);
    }
    const auto of_part = surfaces_of_tiles(parts.parts[p].plan, noise.in_part(parts, p), regions, merged,
                                           segment_in_part, segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i) result[segments[i]] = of_part[i];
    begin += merged.tree.number_of_fragments();
  }
  return result;
}

// ---- All steps ----

RW_SEGMENTATION_INLINE std::vector<Analytic_surface> Tiled_surface_hierarchy::surfaces(
    std::size_t number_of_segments) const {
  return surfaces_of_parts(parts, noise, of_parts, tree.segment_of_fragments(number_of_segments), number_of_segments);
}

RW_SEGMENTATION_INLINE Tiled_surface_hierarchy internal::hierarchy_of_tiled_surfaces(const std::vector<Tile>& tiles,
                                                                                     const Tiled_surfaces& options,
                                                                                     const Progress& progress) {
  Tiles_of_parts whole(tiles, options.tolerance, true);
  const Tile_parts& parts = whole.parts;
  Tiled_surface_hierarchy result;
  std::vector<std::vector<Tile_border>> borders;                 // by part and piece
  std::vector<std::vector<Tile_neighbourhoods>> neighbourhoods;  // by tile and piece
  for (const auto& of_tile : parts.places) neighbourhoods.emplace_back(of_tile.size());
  for (std::size_t p = 0; p < parts.parts.size(); ++p) {
    progress(0.1 * static_cast<double>(p) / static_cast<double>(parts.parts.size()));
    borders.emplace_back();
    for (std::size_t i = 0; i < whole.tiles[p].size(); ++i) {
      const auto& [tile, place] = parts.parts[p].pieces[i];
      borders.back().push_back(
          border_of_tile(whole.tiles[p][i], {i, parts.parts[p].plan}, neighbourhoods[tile][place], options, {}));
    }
  }
  result.noise = noise_of_parts(parts, neighbourhoods, options);
  for (const Tile& tile : tiles) result.fragment_of_face.emplace_back(tile.number_of_faces());
  const std::vector<Progress> progresses = progress_of_parts(progress.part(0.1, 1), parts);
  std::size_t fragments = 0;
  for (std::size_t p = 0; p < parts.parts.size(); ++p) {
    const Tile_plan& plan = parts.parts[p].plan;
    const Progress& of_part = progresses[p];
    const Surface_noise noise = result.noise.in_part(parts, p);
    auto& [regions, merged] = result.of_parts.emplace_back();
    regions.resize(whole.tiles[p].size());
    std::vector<std::vector<Dual_mesh::Index>> region_of_face;
    for (std::size_t i = 0; i < whole.tiles[p].size(); ++i)
      region_of_face.push_back(surfaces_of_tile(whole.tiles[p][i], {i, plan}, of_neighbours(plan, borders[p], i), noise,
                                                regions[i], options,
                                                progress_of_tile(of_part, 0, 0.95, i, regions.size())));
    merged = merge_tiles(plan, noise, regions, of_part.part(0.95, 1));
    for (std::size_t i = 0; i < region_of_face.size(); ++i)
      for (Dual_mesh::Index& region : region_of_face[i]) region = merged.fragments[i][region];
    whole.scatter(
        p, region_of_face, [&](std::size_t f) { return static_cast<Dual_mesh::Index>(fragments + f); },
        result.fragment_of_face);
    fragments += merged.tree.number_of_fragments();
    result.turned_sides += merged.turned_sides;
    result.walls += merged.walls;
  }
  result.parts = std::move(whole.parts);
  result.tree = tree_of_parts(result.of_parts);
  result.components = result.tree.number_of_components();
  progress(1);
  return result;
}

}  // namespace RW_segmentation

#endif
