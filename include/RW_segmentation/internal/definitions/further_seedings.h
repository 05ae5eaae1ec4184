// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_FURTHER_SEEDINGS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_FURTHER_SEEDINGS_H

#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/seeds/Distances_to_sources.h>
#include <RW_segmentation/internal/seeds/Feature_sensitive_metric.h>
#include <RW_segmentation/internal/seeds/farthest_points.h>
#include <RW_segmentation/internal/walk/Face_clusters.h>
#include <RW_segmentation/internal/walk/further_seedings.h>
#include <RW_segmentation/internal/walk/walk_fragments.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The faces by their distance from one of them, which is the same in every order of the faces. Distances that are equal but
/// for rounding count as equal.
inline std::vector<Dual_mesh::Index> by_distance_from(Dual_mesh::Index start, const Dual_mesh& mesh) {
  constexpr double steps_of_squared_distance = 1e7, last_step = std::numeric_limits<std::uint32_t>::max();
  constexpr std::uint64_t least_step = std::uint64_t(1) << 32U;
  const double scale = steps_of_squared_distance / (mesh.length_unit() * mesh.length_unit());
  std::vector<std::uint64_t> keys;  // the distance, then the face
  keys.reserve(mesh.number_of_faces());
  for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f) {
    const double distance = scale * (mesh.centroid(f) - mesh.centroid(start)).squaredNorm();
    // Not so where there is no length at all.
    const double step = distance < last_step ? distance : last_step;
    keys.push_back(static_cast<std::uint64_t>(step) * least_step + f);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Dual_mesh::Index> order;
  order.reserve(keys.size());
  for (const std::uint64_t key : keys) order.push_back(static_cast<Dual_mesh::Index>(key % least_step));
  return order;
}

/// Clusters that lie in one fragment each.
inline Face_clusters clusters_in_fragments(const Dual_mesh& shape, const Walk_network& network,
                                           const First_seeding& first) {
  // Creases make three times as many of it. Of the Princeton meshes: 125 to 4000 agree as well with people.
  constexpr double clusters = 500, largest_difference = 2;
  // With roots k steps apart a cluster holds about 5/9 k^2 faces.
  const auto steps = static_cast<std::size_t>(
      std::max(1LL, std::llround(std::sqrt(static_cast<double>(shape.number_of_faces()) / clusters * 9 / 5))));
  const double least = std::exp(-largest_difference);
  std::vector<char> is_crossed;
  is_crossed.reserve(shape.number_of_edges());
  for (Dual_mesh::Index e = 0; e < shape.number_of_edges(); ++e) {
    const auto [f, g] = shape.graph().faces_of(e);
    const double conductance = network.conductances[e];
    is_crossed.push_back(first.fragment_of_face[f] == first.fragment_of_face[g] && conductance > 0 &&
                         conductance >= least * shape.edge_length(e));
  }
  // In their own order, faces that are looked at one after the other lie close in memory.
  const auto order = first.is_reduced ? std::vector<Dual_mesh::Index>() : by_distance_from(first.seeds.front(), shape);
  return {shape.graph(), network.conductances, is_crossed, steps, {}, order};
}

/// The lengths of the ways between clusters; infinite where no walk leads.
inline std::vector<double> lengths_of_ways(const Dual_mesh& shape, const Face_clusters& clusters) {
  const Feature_sensitive_metric metric(shape, Farthest_point_sampling().normal_weight());
  std::vector<double> lengths;
  for (Dual_graph::Index e = 0; e < clusters.graph.number_of_edges(); ++e) {
    const auto [a, b] = clusters.graph.faces_of(e);
    lengths.push_back(clusters.conductances[e] > 0 ? metric.distance(clusters.root[a], clusters.root[b])
                                                   : std::numeric_limits<double>::infinity());
  }
  return lengths;
}

/// So many clusters as seeds, or all of them: those that are given, one in each component, and the farthest ones.
inline std::vector<Dual_graph::Index> seed_clusters(const Face_clusters& clusters, const std::vector<double>& lengths,
                                                    std::vector<Dual_graph::Index> seeds, std::size_t count) {
  Distances_to_sources distance(clusters.graph, lengths);
  reach_all_components_from(seeds, distance);
  add_farthest_points(seeds, distance, std::min(count, clusters.root.size()), {});
  return seeds;
}

/// The area of each piece of clusters.
inline std::vector<double> areas_of_pieces(const Common_refinement& pieces, const Face_clusters& clusters,
                                           const Dual_mesh& shape) {
  std::vector<double> area(pieces.fragments_of.size(), 0);
  for (Dual_mesh::Index f = 0; f < shape.number_of_faces(); ++f)
    area[pieces.of_face[clusters.of_face[f]]] += shape.area(f);
  return area;
}

/// The graph of the pieces, whose edges stay within a fragment of the first seeding.
inline Dual_graph graph_in_first_fragments(const Common_refinement& pieces, const Face_clusters& clusters,
                                           std::vector<double>& conductances) {
  std::vector<Cluster_way> ways;
  for (Dual_graph::Index e = 0; e < clusters.graph.number_of_edges(); ++e) {
    const auto [c, d] = clusters.graph.faces_of(e);
    const auto [a, b] = std::minmax(pieces.of_face[c], pieces.of_face[d]);
    if (a != b && pieces.fragments_of[a][0] == pieces.fragments_of[b][0])
      ways.push_back(
          {{static_cast<Dual_graph::Index>(a), static_cast<Dual_graph::Index>(b)}, clusters.conductances[e]});
  }
  return parallel_ways(pieces.fragments_of.size(), std::move(ways), conductances);
}

/// Joins each small piece, and each small set of joined ones, to the neighbour in the same fragment of the first seeding to
/// which most conductance leads. Returns for each piece the largest one of its set.
/// \param area of each piece
/// \param least what is smaller is joined
inline std::vector<std::size_t> join_small_pieces(const Dual_graph& graph, const std::vector<double>& conductances,
                                                  const std::vector<double>& area, double least) {
  std::vector<std::size_t> by_area(area.size());
  std::iota(by_area.begin(), by_area.end(), std::size_t(0));
  std::stable_sort(by_area.begin(), by_area.end(), [&](std::size_t a, std::size_t b) { return area[a] < area[b]; });
  std::vector<double> area_of_set = area;
  std::vector<std::vector<std::size_t>> pieces_of_set(area.size());
  for (const std::size_t piece : by_area) pieces_of_set[piece].push_back(piece);
  boost::disjoint_sets_with_storage<> sets(area.size());
  for (const std::size_t piece : by_area) {
    const std::size_t set = sets.find_set(piece);
    if (area_of_set[set] >= least) continue;
    double most = 0;
    std::size_t best = set;
    for (const std::size_t member : pieces_of_set[set])
      for (const auto& [neighbour, edge] : graph.neighbours(static_cast<Dual_graph::Index>(member))) {
        const std::size_t other = sets.find_set(neighbour);
        if (other == set || conductances[edge] <= most) continue;
        most = conductances[edge];
        best = other;
      }
    if (best == set) continue;
    sets.link(set, best);
    const std::size_t joined = sets.find_set(set), added = joined == set ? best : set;
    area_of_set[joined] += area_of_set[added];
    pieces_of_set[joined].insert(pieces_of_set[joined].end(), pieces_of_set[added].begin(), pieces_of_set[added].end());
  }
  std::vector<std::size_t> largest_of_set(area.size()), largest(area.size());
  for (const std::size_t piece : by_area) largest_of_set[sets.find_set(piece)] = piece;
  for (const std::size_t piece : by_area) largest[piece] = largest_of_set[sets.find_set(piece)];
  return largest;
}

/// Takes the clusters of small pieces to the fragments of a neighbouring piece.
///
/// Where fragments of several seedings end at about the same crease they leave small pieces along it. Smoothed normals hardly
/// differ within the crease, so that merging would begin with these pieces and cross it.
/// \param fragment_of_cluster of every seeding; the first one stays as it is
inline void dissolve_small_pieces(const Dual_mesh& shape, const Face_clusters& clusters,
                                  std::vector<std::vector<std::size_t>>& fragment_of_cluster) {
  // On the Princeton meshes, with noise as without, 0 to 0.2 agree as well with people. The arms of an L, meshed finely, are
  // parted from 0.05 on by two seedings and from 0.1 on by four.
  constexpr double least_share_of_mean_fragment = 0.1;
  const auto& first = fragment_of_cluster.front();
  const auto fragments = static_cast<double>(*std::max_element(first.begin(), first.end()) + 1);
  const Common_refinement pieces = common_refinement(clusters.graph, clusters.conductances, fragment_of_cluster);
  std::vector<double> conductances;
  const Dual_graph graph = graph_in_first_fragments(pieces, clusters, conductances);
  const auto largest = join_small_pieces(graph, conductances, areas_of_pieces(pieces, clusters, shape),
                                         least_share_of_mean_fragment * shape.total_area() / fragments);
  for (std::size_t c = 0; c < pieces.of_face.size(); ++c)
    for (std::size_t k = 1; k < fragment_of_cluster.size(); ++k)
      fragment_of_cluster[k][c] = pieces.fragments_of[largest[pieces.of_face[c]]][k];
}

RW_SEGMENTATION_INLINE Common_refinement refine_by_further_seedings(const Dual_mesh& shape, const Walk_network& network,
                                                                    const First_seeding& first, std::size_t count,
                                                                    const std::function<Any_walk_solver()>& make_solver,
                                                                    const Progress& progress) {
  const Face_clusters clusters = clusters_in_fragments(shape, network, first);
  const std::vector<double> lengths = lengths_of_ways(shape, clusters);
  Components component;
  component.count = network.component.count;
  for (const auto root : clusters.root) component.of.push_back(network.component.of[root]);
  std::vector<std::vector<std::size_t>> fragment_of_cluster(1);  // of every seeding
  for (const auto root : clusters.root) fragment_of_cluster[0].push_back(first.fragment_of_face[root]);

  const auto add = [](std::vector<Dual_graph::Index>& different, Dual_graph::Index cluster) {
    if (std::find(different.begin(), different.end(), cluster) == different.end()) different.push_back(cluster);
  };
  std::vector<Dual_graph::Index> given;
  for (std::size_t i = 0; i < first.given; ++i) add(given, clusters.of_face[first.seeds[i]]);
  Dual_graph::Index last = clusters.of_face[first.seeds.back()];
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<Dual_graph::Index> start = given;
    add(start, last);
    const auto seeds = seed_clusters(clusters, lengths, std::move(start), first.seeds.size());
    last = seeds.back();
    auto solver = make_solver();
    solver.analyze(clusters.graph);
    const auto share = [&](std::size_t done) { return static_cast<double>(done) / static_cast<double>(count); };
    fragment_of_cluster.push_back(walk_fragments({clusters.graph, clusters.conductances, component}, std::move(solver),
                                                 seeds, progress.part(share(k), share(k + 1)))
                                      .of_face);
  }
  dissolve_small_pieces(shape, clusters, fragment_of_cluster);
  Common_refinement refinement = common_refinement(clusters.graph, clusters.conductances, fragment_of_cluster);
  std::vector<std::size_t> of_face;
  of_face.reserve(clusters.of_face.size());
  for (const auto cluster : clusters.of_face) of_face.push_back(refinement.of_face[cluster]);
  refinement.of_face = std::move(of_face);
  return refinement;
}

}  // namespace RW_segmentation::internal

#endif
