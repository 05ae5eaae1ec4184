// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_FACE_CLUSTERS_H
#define RW_SEGMENTATION_INTERNAL_WALK_FACE_CLUSTERS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/mesh/Flooded_clusters.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// A way from the root of a cluster to that of a neighbouring one, which has a higher number.
struct Cluster_way {
  std::array<Dual_graph::Index, 2> clusters;
  double conductance;
};

/// The conductance of a way from one root to an edge, over it, and to the other root.
inline double conductance_of_way(double resistance, double edge_conductance, double other_resistance) {
  return edge_conductance > 0 ? 1 / (resistance + 1 / edge_conductance + other_resistance) : 0;
}

/// The graph of clusters with one edge for all ways between two of them, whose conductances add up.
inline Dual_graph parallel_ways(std::size_t number_of_clusters, std::vector<Cluster_way> ways,
                                std::vector<double>& conductances) {
  sort_by_clusters(ways, number_of_clusters);
  std::size_t edges = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) edges += i == 0 || ways[i].clusters != ways[i - 1].clusters;
  std::vector<std::array<Dual_graph::Index, 2>> ends;
  ends.reserve(edges);
  conductances.clear();
  conductances.reserve(edges);
  for (const auto& [clusters, conductance] : ways) {
    if (ends.empty() || ends.back() != clusters) {
      ends.push_back(clusters);
      conductances.push_back(0);
    }
    conductances.back() += conductance;
  }
  return Dual_graph(number_of_clusters, std::move(ends));
}

/// Clusters with the network of conductances between them. No cluster reaches over an edge over which a walk hardly goes. An
/// edge between two clusters lies on a way from root to root, whose resistances add up; ways between the same two are
/// parallel.
struct Face_clusters : Flooded_clusters {
  Dual_graph graph;                  ///< of the clusters, with one edge between two neighbours
  std::vector<double> conductances;  ///< of the edges between clusters, in their order

  /// See `Flooded_clusters`.
  /// \param graph of the faces
  /// \param conductances of its edges
  Face_clusters(const Dual_graph& faces, const std::vector<double>& face_conductances,
                const std::vector<char>& is_crossed, std::size_t steps, const std::vector<Index>& alone,
                const std::vector<Index>& order = {})
      : Flooded_clusters(
            faces, [&](Index e) { return 1 / face_conductances[e]; }, [&](Index e) { return is_crossed[e] != 0; },
            steps, alone, order) {
    std::vector<Cluster_way> ways;
    for (Index e = 0; e < faces.number_of_edges(); ++e) {
      const auto [f, g] = faces.faces_of(e);
      const auto [a, b] = std::minmax(of_face[f], of_face[g]);
      if (a == b) continue;
      ways.push_back({{a, b}, conductance_of_way(resistance[f], face_conductances[e], resistance[g])});
    }
    graph = parallel_ways(root.size(), std::move(ways), conductances);
  }
};

/// Adds what lies within so many steps of different nodes to them, in the order of the steps.
inline void add_surroundings(const Dual_graph& graph, std::size_t steps, std::vector<Dual_graph::Index>& nodes) {
  std::vector<char> is_reached(graph.number_of_faces(), false);
  for (const auto node : nodes) is_reached[node] = true;
  std::size_t next = 0;
  for (std::size_t step = 0; step < steps && next < nodes.size(); ++step)
    for (const std::size_t end = nodes.size(); next < end; ++next)
      for (const auto& neighbour : graph.neighbours(nodes[next])) {
        if (is_reached[neighbour.face]) continue;
        is_reached[neighbour.face] = true;
        nodes.push_back(neighbour.face);
      }
}

/// Clusters for a walk from seeds. They are fine where a walk begins, since a wide seed would be met too often: the faces
/// around a seed are clusters by themselves, those of the seeds the first ones.
/// \param steps the least distance between roots
inline Face_clusters clusters_around(const std::vector<Dual_graph::Index>& seeds, const Dual_graph& graph,
                                     const std::vector<double>& conductances, const std::vector<double>& edge_length,
                                     double largest_difference, std::size_t steps) {
  const double least = std::exp(-largest_difference);
  std::vector<char> is_crossed;
  is_crossed.reserve(conductances.size());
  for (std::size_t e = 0; e < conductances.size(); ++e)
    is_crossed.push_back(conductances[e] > 0 && conductances[e] >= least * edge_length[e]);
  std::vector<Dual_graph::Index> alone = seeds;
  add_surroundings(graph, steps, alone);
  return Face_clusters(graph, conductances, is_crossed, steps, alone);
}

}  // namespace RW_segmentation::internal

#endif
