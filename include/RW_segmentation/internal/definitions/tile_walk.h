// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILE_WALK_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILE_WALK_H

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/definitions/tile_shape.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/mesh/closest_face.h>
#include <RW_segmentation/internal/seeds/Distances_to_sources.h>
#include <RW_segmentation/internal/seeds/farthest_points.h>
#include <RW_segmentation/internal/tiles/Joined_nodes.h>
#include <RW_segmentation/internal/tiles/Turn_histogram.h>
#include <RW_segmentation/internal/walk/Face_clusters.h>
#include <RW_segmentation/internal/walk/settle_band.h>
#include <RW_segmentation/internal/walk/walk_fragments.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

// ---- Seeds ----

/// What both kinds of seeds need: the means over all tiles.
inline Tile_seeds seeds_without_places(const Tile_plan& plan, const std::vector<Tile_outline>& outlines) {
  Tile_seeds seeds;
  Turn_sums sums;
  for (const Tile_outline& outline : outlines) {
    sums.edges += outline.turns.edges;
    sums.length += outline.turns.length;
    sums.turn += outline.turns.turn;
    sums.seeded_turn += outline.turns.seeded_turn;
    Turn_histogram::add(outline.turns.counts, sums.counts);
    seeds.turned_sides += outline.turned_sides;
    seeds.walls += outline.turns.walls;
  }
  if (sums.edges == 0) return seeds;
  const auto mean_of = [&](double sum) {  // 0 where all is flat
    const double mean = sum / sums.edges;
    return mean < flat_turn(plan.box.rounding, sums.length / sums.edges) ? 0 : mean;
  };
  seeds.seeded_turn = mean_of(sums.seeded_turn);
  const double mean = mean_of(sums.turn);
  if (mean == 0) return seeds;
  const auto excess = [&](double t) { return t > mean ? std::sqrt(t * t / (mean * mean) - 1) : 0; };
  seeds.ordinary = {mean, Turn_histogram::mean(sums.counts, excess),
                    crease_weight(static_cast<std::size_t>(sums.edges))};
  return seeds;
}

/// The coarse graph of the whole, with the lengths of its edges.
inline Dual_graph coarse_graph(const std::vector<Tile_outline>& outlines, std::vector<double>& lengths) {
  const Joined_nodes nodes(outlines, [](const Tile_outline& outline) { return outline.faces.size(); });
  std::vector<std::array<Dual_graph::Index, 2>> edges;
  for (std::size_t t = 0; t < outlines.size(); ++t) {
    for (const auto& [a, b] : outlines[t].edges) edges.push_back({nodes(t, a), nodes(t, b)});
    lengths.insert(lengths.end(), outlines[t].lengths.begin(), outlines[t].lengths.end());
  }
  nodes.for_each_side(outlines, [&](const auto& owner, Dual_graph::Index a, const auto& other, Dual_graph::Index b) {
    edges.push_back({a, b});
    lengths.push_back(owner.from_node + owner.value + other.from_node);
  });
  return Dual_graph(nodes.count(), std::move(edges));
}

/// The node that is farthest from the centroid of the surface.
inline Dual_graph::Index node_farthest_from_centroid(const Tile_plan& plan, const std::vector<Tile_outline>& outlines) {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const Tile_outline& outline : outlines) centroid += outline.moment;
  if (plan.total_area > 0) centroid /= plan.total_area;
  std::vector<double> distance;
  for (const Tile_outline& outline : outlines)
    for (const Eigen::Vector3d& x : outline.centroids) distance.push_back((x - centroid).norm());
  return first_greatest(distance);
}

}  // namespace internal

RW_SEGMENTATION_INLINE Tile_seeds seeds_of_tiles(const Tile_plan& plan, const std::vector<Tile_outline>& outlines,
                                                 const Tiled_segmentation& options, const Progress& progress) {
  using Index = Dual_graph::Index;
  if (options.seeds == 0) throw internal::argument_error("seeds", options.seeds, "at least 1");
  Tile_seeds result = internal::seeds_without_places(plan, outlines);
  for (std::size_t t = 0; t < outlines.size(); ++t)
    for (const internal::Thickness_probe& probe : outlines[t].probes)
      result.probes.push_back({static_cast<Index>(t), probe});
  std::vector<double> lengths;
  const Dual_graph graph = internal::coarse_graph(outlines, lengths);
  if (graph.number_of_faces() == 0) return result;

  const internal::Components components(graph, [](Index) { return true; });
  internal::Distances_to_sources distance(graph, std::move(lengths));
  const std::vector<Index> nodes =
      internal::farthest_points(distance, {internal::node_farthest_from_centroid(plan, outlines)},
                                std::min(options.seeds + components.count - 1, graph.number_of_faces()), progress);
  const internal::Joined_nodes numbers(outlines, [](const Tile_outline& outline) { return outline.faces.size(); });
  for (const Index node : nodes) {
    const auto [tile, place] = numbers.tile_and_place(node);
    result.seeds.push_back({tile, outlines[tile].faces[place], static_cast<Index>(result.seeds.size())});
  }
  return result;
}

RW_SEGMENTATION_INLINE std::vector<Tile_place> places_in_tile(const Tile_shape& shape, const Tile_plan& plan,
                                                              const std::vector<Seed_point>& seeds) {
  std::vector<Tile_place> places(seeds.size(), {0, std::numeric_limits<double>::infinity()});
  if (seeds.empty()) return places;
  const internal::Triangle_tree triangles(shape.mesh, shape.own_faces);
  for (std::size_t s = 0; s < seeds.size(); ++s)
    if (const auto closest = triangles.closest_face(plan.box.scaled(seeds[s].point), Eigen::Vector3d::Zero()))
      places[s] = {closest->face, closest->squared_distance};
  return places;
}

RW_SEGMENTATION_INLINE Tile_seeds seeds_of_tiles(const Tile_plan& plan, const std::vector<Tile_outline>& outlines,
                                                 const std::vector<Seed_point>& seeds,
                                                 const std::vector<std::vector<Tile_place>>& places) {
  using Index = Dual_mesh::Index;
  if (seeds.empty()) throw std::invalid_argument("no seeds");
  Tile_seeds result = internal::seeds_without_places(plan, outlines);
  result.are_given = true;
  constexpr Index largest_label = std::numeric_limits<Index>::max() / 2;  // parts out of reach get larger ones
  std::map<std::pair<Index, Index>, std::size_t> seed_on;
  for (std::size_t s = 0; s < seeds.size(); ++s) {
    if (seeds[s].label > largest_label) throw internal::argument_error("label", seeds[s].label, "below 2^31");
    std::vector<double> distance;
    for (const std::vector<Tile_place>& of_tile : places) distance.push_back(of_tile.at(s).squared_distance);
    const auto closest = std::min_element(distance.begin(), distance.end());
    if (closest == distance.end() || std::isinf(*closest)) throw std::invalid_argument("no tile has a face");
    const auto tile = static_cast<Index>(closest - distance.begin());
    const Tile_seeds::Seed seed = {tile, places[tile][s].face, seeds[s].label};
    const auto [before, is_new] = seed_on.emplace(std::pair(seed.tile, seed.face), s);
    if (seeds[before->second].label != seed.label)
      throw std::invalid_argument("seeds " + std::to_string(before->second) + " and " + std::to_string(s) +
                                  ", counted from 0, have different labels and the same closest face");
    if (is_new) result.seeds.push_back(seed);
  }
  return result;
}

namespace internal {

// ---- Clusters ----

/// The difference of each edge of a tile and its halo: that of `smoothed_concavity()` on the whole, or of
/// `seeded_concavity()` where seeds are the user's.
inline std::vector<double> differences_of(const Dual_mesh& part, const Tile_seeds& seeds) {
  if (seeds.are_given) {
    std::vector<double> difference = turns(part, seeded_concavity().convex_weight);
    for (double& d : difference) d = seeds.seeded_turn > 0 ? d / seeds.seeded_turn : 0;
    return difference;
  }
  const Edge_concavity concavity(part, seeds.ordinary);
  std::vector<double> difference(part.number_of_edges());
  for (Dual_mesh::Index e = 0; e < difference.size(); ++e) difference[e] = concavity.excess(e);
  return difference;
}

/// The paper's sigma, and the cap of `Conductance`.
inline std::vector<double> conductances_of(const Dual_mesh& part, const std::vector<double>& difference) {
  return conductances(part, difference, 1, 20);
}

/// Faces of a tile that are seeds.
inline std::vector<Dual_mesh::Index> seeds_in(const Tile_seeds& seeds, std::size_t tile) {
  std::vector<Dual_mesh::Index> faces;
  for (const auto& seed : seeds.seeds)
    if (seed.tile == tile) faces.push_back(seed.face);
  return faces;
}

/// The probes as one tile sees them: those on other tiles stand on no face of it.
inline std::vector<Thickness_probe> probes_from(const Tile_seeds& seeds, std::size_t tile) {
  std::vector<Thickness_probe> probes;
  for (const auto& [from, probe] : seeds.probes) {
    probes.push_back(probe);
    if (from != tile) probes.back().face = std::numeric_limits<Dual_mesh::Index>::max();
  }
  return probes;
}

}  // namespace internal

RW_SEGMENTATION_INLINE Tile_clusters internal::clusters_of_tile(const Tile_shape& shape, const Tile_in_plan& place,
                                                                const Tile_border& border, const Tile_seeds& seeds,
                                                                Tile_network& network,
                                                                const Tiled_segmentation& options) {
  const auto& [number, plan] = place;
  internal::require_reduction_numbers(options.reduction);
  const internal::Own_graph own(shape);
  const std::vector<double> conductances =
      internal::conductances_of(shape.mesh, internal::differences_of(shape.mesh, seeds));
  const internal::Face_clusters clusters = internal::clusters_around(
      internal::seeds_in(seeds, number), own.graph, own.own(conductances), own.own(shape.mesh.edge_lengths()),
      options.reduction.largest_difference, internal::cluster_steps(plan.faces, options.reduction.cluster_steps));
  network.clusters = clusters.root.size();
  for (Dual_mesh::Index e = 0; e < clusters.graph.number_of_edges(); ++e)
    network.edges.push_back(clusters.graph.faces_of(e));
  network.conductances = clusters.conductances;
  for (const auto& shared : shape.shared_edges) {
    const auto f = internal::own_face(shape, shared);
    const bool is_owner = number < shared.neighbour;
    network.sides.push_back(
        {shared.side, clusters.of_face[f], clusters.resistance[f], is_owner ? conductances[shared.edge] : 0, is_owner});
  }
  for (const auto face : border.faces) network.border.push_back(clusters.of_face[face]);
  if (!seeds.probes.empty())
    network.exits =
        internal::probe_exits(shape.mesh, shape.own_faces, internal::probes_from(seeds, number), options.thickness);
  return clusters.of_face;
}

namespace internal {

// ---- The walk ----

/// The thickness at each probe: its rays end where they leave the solid first, through whichever tile.
inline std::vector<double> thickness_at_probes(const std::vector<Tile_network>& networks, std::size_t probes,
                                               std::size_t rays) {
  std::vector<double> thickness(probes);
  for (std::size_t p = 0; p < probes; ++p) {
    std::vector<double> exits(rays, std::numeric_limits<double>::infinity());
    for (const Tile_network& network : networks)
      for (std::size_t ray = 0; ray < rays; ++ray) exits[ray] = std::min(exits[ray], network.exits[p * rays + ray]);
    thickness[p] = thickness_by_exits(std::move(exits));
  }
  return thickness;
}

/// The network of all clusters.
inline Dual_graph network_of_tiles(const std::vector<Tile_network>& networks, const Joined_nodes& nodes,
                                   std::vector<double>& conductances) {
  std::vector<Cluster_way> ways;
  for (std::size_t t = 0; t < networks.size(); ++t)
    for (std::size_t e = 0; e < networks[t].edges.size(); ++e) {
      const auto [a, b] = networks[t].edges[e];
      ways.push_back({{nodes(t, a), nodes(t, b)}, networks[t].conductances[e]});
    }
  nodes.for_each_side(networks, [&](const auto& owner, Dual_graph::Index a, const auto& other, Dual_graph::Index b) {
    ways.push_back(
        {{std::min(a, b), std::max(a, b)}, conductance_of_way(owner.from_node, owner.value, other.from_node)});
  });
  return parallel_ways(nodes.count(), std::move(ways), conductances);
}

}  // namespace internal

RW_SEGMENTATION_INLINE Tile_walk internal::walk_over_tiles(const Tile_plan& plan, const Tile_seeds& seeds,
                                                           const std::vector<Tile_network>& networks,
                                                           const Tiled_segmentation& options,
                                                           const Progress& progress) {
  using Index = Dual_graph::Index;
  Tile_walk walk;
  walk.thickness = internal::thickness_at_probes(networks, seeds.probes.size(), options.thickness.rays);
  const auto known = static_cast<std::size_t>(
      std::count_if(walk.thickness.begin(), walk.thickness.end(), [](double t) { return t > 0; }));
  walk.is_solid = internal::is_solid(known, plan.faces);
  walk.crease_weight = seeds.ordinary.crease_weight;

  const internal::Joined_nodes nodes(networks, [](const Tile_network& network) { return network.clusters; });
  std::vector<double> conductances;
  const Dual_graph graph = internal::network_of_tiles(networks, nodes, conductances);
  walk.clusters = graph.number_of_faces();
  walk.fragments.resize(networks.size());
  walk.bands.resize(networks.size());
  if (walk.clusters == 0) return walk;
  const internal::Components components(graph, [&](Index edge) { return conductances[edge] > 0; });
  walk.components = components.count;
  std::vector<Index> seeds_before(networks.size(), 0), seed_nodes;  // a tile's seeds are its first clusters
  std::vector<std::size_t> labels;
  for (const auto& [tile, face, label] : seeds.seeds) {
    seed_nodes.push_back(nodes(tile, seeds_before[tile]++));
    labels.push_back(label);
  }
  internal::Any_walk_solver solver{Star_mesh_elimination()};
  solver.analyze(graph);
  const internal::Walk_network network = {graph, conductances, components};
  const internal::Fragments fragments =
      seeds.are_given ? internal::walk_from_seeds(network, std::move(solver), seed_nodes, labels, progress)
                      : internal::walk_fragments(network, std::move(solver), seed_nodes, progress);
  walk.island_clusters = fragments.island_faces;

  std::vector<char> is_in_band(walk.clusters, false);
  for (const Index node : internal::band_along_boundaries(graph, fragments.of_face, options.reduction.band))
    is_in_band[node] = true;
  for (std::size_t t = 0; t < networks.size(); ++t) {
    for (Index cluster = 0; cluster < networks[t].clusters; ++cluster) {
      const std::size_t fragment = fragments.of_face[nodes(t, cluster)];
      walk.number_of_fragments = std::max(walk.number_of_fragments, fragment + 1);
      walk.fragments[t].push_back(static_cast<Index>(fragment));
      walk.bands[t].push_back(is_in_band[nodes(t, cluster)]);
    }
  }
  return walk;
}

}  // namespace RW_segmentation

#endif
