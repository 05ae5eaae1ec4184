// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_FACE_CLUSTERS_H
#define RW_SEGMENTATION_INTERNAL_WALK_FACE_CLUSTERS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Walk_reduction.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
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
  std::stable_sort(ways.begin(), ways.end(),
                   [](const Cluster_way& a, const Cluster_way& b) { return a.clusters < b.clusters; });
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

/// Connected clusters of faces with the network of conductances between them: a small stand-in for the dual graph of a
/// large mesh.
///
/// Roots are chosen one after the other, none within a few steps of an earlier one. Each floods the faces around it that
/// are nearer to it than to the earlier ones, so that in the end each face belongs to the root nearest in steps. No flood
/// crosses an edge over which a walk hardly goes. An edge between two clusters lies on a way from root to root, whose
/// resistances add up; ways between the same two are parallel.
struct Face_clusters {
  using Index = Dual_graph::Index;

  std::vector<Index> of_face;        ///< the cluster of each face
  std::vector<Index> root;           ///< the face each cluster has grown from
  Dual_graph graph;                  ///< of the clusters, with one edge between two neighbours
  std::vector<double> conductances;  ///< of the edges between clusters, in their order
  std::vector<double> resistance;    ///< by face: of the way to it from the root of its cluster

  /// \param graph of the faces
  /// \param conductances of its edges
  /// \param is_crossed by edge: whether clusters may reach over it
  /// \param steps how far a root keeps others off
  /// \param alone faces that are clusters by themselves, the first ones
  /// \param order of all faces, in which roots are chosen; empty: that of their numbers
  /// Complexity: O(m log m) for m faces.
  Face_clusters(const Dual_graph& faces, const std::vector<double>& face_conductances,
                const std::vector<char>& is_crossed, std::size_t steps, const std::vector<Index>& alone,
                const std::vector<Index>& order = {}) {
    grow(faces, face_conductances, is_crossed, steps, alone, order);
    join_clusters(faces, face_conductances);
  }

 private:
  static constexpr Index none = std::numeric_limits<Index>::max();

  /// Gives each face to the root nearest in steps, of several to the first one. Of the ways in as few steps, that of the
  /// least resistance counts, which does not depend on the order of the faces. Clusters of `alone` do not grow.
  void grow(const Dual_graph& faces, const std::vector<double>& face_conductances, const std::vector<char>& is_crossed,
            std::size_t steps, const std::vector<Index>& alone, const std::vector<Index>& order) {
    root = alone;
    of_face.assign(faces.number_of_faces(), none);
    resistance.assign(faces.number_of_faces(), 0.);
    std::vector<Index> step(faces.number_of_faces(), none);  // from the root of the cluster
    for (Index c = 0; c < root.size(); ++c) {
      of_face[root[c]] = c;
      step[root[c]] = 0;
    }
    std::vector<Index> flooded;
    for (Index i = 0; i < faces.number_of_faces(); ++i) {
      const Index face = order.empty() ? i : order[i];
      if (of_face[face] != none) continue;
      const auto cluster = static_cast<Index>(root.size());
      root.push_back(face);
      of_face[face] = cluster;
      step[face] = 0;
      flooded.assign(1, face);
      for (std::size_t next = 0; next < flooded.size() && step[flooded[next]] < steps; ++next) {
        const Index from = flooded[next], distance = step[from] + 1;
        for (const auto& [to, edge] : faces.neighbours(from)) {
          if (!is_crossed[edge] || distance > step[to]) continue;
          if (distance < step[to]) {  // What lies behind a face that keeps its cluster is nearer to that, too.
            of_face[to] = cluster;
            step[to] = distance;
            resistance[to] = resistance[from] + 1 / face_conductances[edge];
            flooded.push_back(to);
          } else if (of_face[to] == cluster) {
            resistance[to] = std::min(resistance[to], resistance[from] + 1 / face_conductances[edge]);
          }
        }
      }
    }
  }

  void join_clusters(const Dual_graph& faces, const std::vector<double>& face_conductances) {
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
  for (std::size_t step = 0; step < steps; ++step)
    for (const std::size_t end = nodes.size(); next < end; ++next)
      for (const auto& neighbour : graph.neighbours(nodes[next])) {
        if (is_reached[neighbour.face]) continue;
        is_reached[neighbour.face] = true;
        nodes.push_back(neighbour.face);
      }
}

/// The least distance between the roots of clusters. Clusters of larger meshes hold more faces, lest their number grow.
inline std::size_t cluster_steps(std::size_t faces, const Walk_reduction& reduction) {
  constexpr double large = 6e5;
  const double growth = std::sqrt(std::max(1., static_cast<double>(faces) / large));
  return static_cast<std::size_t>(std::llround(growth * static_cast<double>(reduction.cluster_steps)));
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
