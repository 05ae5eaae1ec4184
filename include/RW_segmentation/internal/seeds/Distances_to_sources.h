// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SEEDS_DISTANCES_TO_SOURCES_H
#define RW_SEGMENTATION_INTERNAL_SEEDS_DISTANCES_TO_SOURCES_H

#include <RW_segmentation/Dual_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The lengths of the shortest paths over a dual graph from a growing set of source faces; infinite where no path
/// leads, negative at the sources themselves.
///
/// Dijkstra's algorithm with buckets of faces for a queue: those of one bucket are visited in any order, and again if
/// a path to them turns out shorter (the delta-stepping of Meyer and Sanders 1998). A source added later visits those
/// faces only that come closer. Costs that are much alike, as distances between neighbouring faces are, make this 2
/// to 2.5 times as fast as a binary heap or Boost's Dijkstra, with the same result.
class Distances_to_sources {
 public:
  using Index = Dual_graph::Index;

  /// Keeps a reference to the graph. The costs are in the order of the edges and not negative; no path leads over an infinite one.
  Distances_to_sources(const Dual_graph& graph, std::vector<double> cost)
      : graph_(graph),
        cost_(std::move(cost)),
        distance_(graph.number_of_faces(), std::numeric_limits<double>::infinity()) {
    double sum = 0;
    std::size_t finite = 0;
    for (const double c : cost_) {
      if (!std::isfinite(c)) continue;
      sum += c;
      ++finite;
    }
    buckets_per_length_ = sum > 0 ? 4 * static_cast<double>(finite) / sum : 0;
  }

  const std::vector<double>& operator*() const { return distance_; }
  double operator[](Index face) const { return distance_[face]; }

  void add_source(Index source) {
    std::size_t current = 0, waiting = 0;
    const auto shorten_paths_over = [&](Index face, double distance) {
      for (const auto [next, edge] : graph_.neighbours(face)) {
        const double through_face = distance + cost_[edge];
        if (!(through_face < distance_[next])) continue;
        distance_[next] = through_face;
        bucket_[bucket_of(through_face, current) % buckets].push_back({through_face, next});
        ++waiting;
      }
    };

    distance_[source] = -1;
    shorten_paths_over(source, 0);
    for (; waiting > 0; ++current) {
      std::vector<Reached>& bucket = bucket_[current % buckets];
      for (std::size_t i = 0; i < bucket.size(); ++i) {  // NOLINT(modernize-loop-convert): it may grow on the way
        const Reached reached = bucket[i];
        if (reached.distance == distance_[reached.face]) shorten_paths_over(reached.face, reached.distance);
      }
      waiting -= bucket.size();
      bucket.clear();
    }
  }

 private:
  struct Reached {
    double distance;
    Index face;
  };

  static constexpr std::size_t buckets = 64;

  /// What lies beyond the last bucket is visited with it, too early at worst.
  std::size_t bucket_of(double distance, std::size_t current) const {
    const double last = static_cast<double>(current + buckets - 1);
    return static_cast<std::size_t>(std::min(distance * buckets_per_length_, last));
  }

  const Dual_graph& graph_;
  std::vector<double> cost_, distance_;
  double buckets_per_length_ = 0;
  std::array<std::vector<Reached>, buckets> bucket_;
};

/// Adds a source in each component that has none, its first face, and returns these faces.
inline std::vector<Dual_graph::Index> reach_all_components(Distances_to_sources& distance) {
  std::vector<Dual_graph::Index> added;
  for (std::size_t f = 0; f < (*distance).size(); ++f) {
    const auto face = static_cast<Dual_graph::Index>(f);
    if (!std::isinf(distance[face])) continue;
    distance.add_source(face);
    added.push_back(face);
  }
  return added;
}

}  // namespace RW_segmentation::internal

#endif
