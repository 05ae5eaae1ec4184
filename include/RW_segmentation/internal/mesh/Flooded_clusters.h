// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_FLOODED_CLUSTERS_H
#define RW_SEGMENTATION_INTERNAL_MESH_FLOODED_CLUSTERS_H

#include <RW_segmentation/Dual_graph.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace RW_segmentation::internal {

/// Connected clusters of faces: a small stand-in for the faces of a large mesh.
///
/// Roots are chosen one after the other, none within a few steps of an earlier one. Each floods the faces around it that
/// are nearer to it than to the earlier ones, so that in the end each face belongs to the root nearest in steps.
struct Flooded_clusters {
  using Index = Dual_graph::Index;

  std::vector<Index> of_face;      ///< the cluster of each face
  std::vector<Index> root;         ///< the face each cluster has grown from
  std::vector<double> resistance;  ///< by face: of the way to it from the root of its cluster

  /// Of the ways in as few steps, that of the least resistance counts, which does not depend on the order of the faces.
  /// \param resistance_of of an edge, which adds up along ways
  /// \param is_crossed by edge: whether clusters may reach over it
  /// \param steps how far a root keeps others off
  /// \param alone faces that are clusters by themselves, the first ones
  /// \param order of all faces, in which roots are chosen; empty: that of their numbers
  /// Complexity: O(m log m) for m faces.
  template <class Resistance, class IsCrossed>
  Flooded_clusters(const Dual_graph& faces, const Resistance& resistance_of, const IsCrossed& is_crossed,
                   std::size_t steps, const std::vector<Index>& alone = {}, const std::vector<Index>& order = {})
      : of_face(faces.number_of_faces(), none), root(alone), resistance(faces.number_of_faces(), 0.) {
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
          if (!is_crossed(edge) || distance > step[to]) continue;
          if (distance < step[to]) {  // What lies behind a face that keeps its cluster is nearer to that, too.
            of_face[to] = cluster;
            step[to] = distance;
            resistance[to] = resistance[from] + resistance_of(edge);
            flooded.push_back(to);
          } else if (of_face[to] == cluster) {
            resistance[to] = std::min(resistance[to], resistance[from] + resistance_of(edge));
          }
        }
      }
    }
  }

 private:
  static constexpr Index none = std::numeric_limits<Index>::max();
};

/// Sorts ways by the clusters they lead to and from, which `clusters` of each names. Ways between the same two stay in order.
/// Complexity: linear.
template <class Way>
void sort_by_clusters(std::vector<Way>& ways, std::size_t number_of_clusters) {
  std::vector<Way> sorted(ways.size());
  for (const std::size_t end : {1u, 0u}) {
    std::vector<std::size_t> next(number_of_clusters + 1, 0);
    for (const Way& way : ways) ++next[way.clusters[end] + std::size_t(1)];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (const Way& way : ways) sorted[next[way.clusters[end]]++] = way;
    ways.swap(sorted);
  }
}

/// The least distance between the roots of clusters. Clusters of larger meshes hold more faces, lest their number grow.
/// \param steps on meshes that are not large
inline std::size_t cluster_steps(std::size_t faces, std::size_t steps) {
  constexpr double large = 6e5;
  const double growth = std::sqrt(std::max(1., static_cast<double>(faces) / large));
  return static_cast<std::size_t>(std::llround(growth * static_cast<double>(steps)));
}

}  // namespace RW_segmentation::internal

#endif
