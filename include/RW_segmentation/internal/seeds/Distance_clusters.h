// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SEEDS_DISTANCE_CLUSTERS_H
#define RW_SEGMENTATION_INTERNAL_SEEDS_DISTANCE_CLUSTERS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/mesh/Flooded_clusters.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

/// Where farthest points are sought over clusters: the steps between their roots, and how many a seed must have. Seeds found so
/// agree as well with people as those of the faces: benchmark_princeton --faces 4 --method clusters, where a seed has about a
/// hundred.
constexpr std::size_t steps_of_seed_clusters = 6, least_clusters_per_seed = 50;

/// Clusters of faces with the shortest ways between their roots: a small stand-in for the distances on a large mesh. What
/// adds up as `resistance` are lengths here. No cluster and no way leads over an edge of infinite length.
struct Distance_clusters : Flooded_clusters {
  std::vector<std::array<Index, 2>> ends;  ///< of each way the two clusters, the lower number first; all different
  std::vector<double> lengths;             ///< of the ways

  /// \param edge_length of the edges of the dual graph, in their order
  /// \param steps the least distance between two roots
  /// Complexity: O(m log m) for m faces.
  Distance_clusters(const Dual_graph& faces, const std::vector<double>& edge_length, std::size_t steps)
      : Flooded_clusters(
            faces, [&](Index e) { return edge_length[e]; }, [&](Index e) { return std::isfinite(edge_length[e]); },
            steps) {
    struct Way {
      std::array<Index, 2> clusters;
      double length;
    };
    std::vector<Way> ways;
    for (Index e = 0; e < faces.number_of_edges(); ++e) {
      const auto [f, g] = faces.faces_of(e);
      const auto [a, b] = std::minmax(of_face[f], of_face[g]);
      if (a != b && std::isfinite(edge_length[e]))
        ways.push_back({{a, b}, resistance[f] + edge_length[e] + resistance[g]});
    }
    sort_by_clusters(ways, root.size());
    for (const auto& [clusters, length] : ways) {
      if (!ends.empty() && ends.back() == clusters) {
        lengths.back() = std::min(lengths.back(), length);
      } else {
        ends.push_back(clusters);
        lengths.push_back(length);
      }
    }
  }
};

}  // namespace RW_segmentation::internal

#endif
