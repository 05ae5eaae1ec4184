// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SEEDS_DISTANCES_TO_SOURCES_H
#define RW_SEGMENTATION_INTERNAL_SEEDS_DISTANCES_TO_SOURCES_H

#include <RW_segmentation/Dual_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// A face to which a path has been found.
struct Reached_face {
  double distance;
  Dual_graph::Index face;
  friend bool operator<(const Reached_face& a, const Reached_face& b) { return a.distance > b.distance; }
};

/// Buckets of faces whose distances are about the same, a queue for Dijkstra's algorithm: those of one bucket are visited in
/// any order, and again if a path to them turns out shorter (the delta-stepping of Meyer and Sanders 1998).
class Bucket_queue {
 public:
  explicit Bucket_queue(double buckets_per_length) : buckets_per_length_(buckets_per_length) {}

  void push(const Reached_face& reached) {
    bucket_[bucket_of(reached.distance) % buckets].push_back(reached);
    ++waiting_;
  }

  /// Calls `visit(face)` for all, and for those that it pushes.
  template <class Visit>
  void visit_all(const Visit& visit) {
    for (; waiting_ > 0; ++current_) {
      std::vector<Reached_face>& bucket = bucket_[current_ % buckets];
      for (std::size_t i = 0; i < bucket.size(); ++i) {  // NOLINT(modernize-loop-convert): it may grow on the way
        const Reached_face reached = bucket[i];
        visit(reached);
      }
      waiting_ -= bucket.size();
      bucket.clear();
    }
    current_ = 0;
  }

 private:
  static constexpr std::size_t buckets = 64;

  /// What lies beyond the last bucket is visited with it, too early at worst.
  std::size_t bucket_of(double distance) const {
    const double last = static_cast<double>(current_ + buckets - 1);
    return static_cast<std::size_t>(std::min(distance * buckets_per_length_, last));
  }

  double buckets_per_length_;
  std::size_t current_ = 0, waiting_ = 0;
  std::array<std::vector<Reached_face>, buckets> bucket_;
};

/// The usual queue of Dijkstra's algorithm: the nearest face first.
class Heap_queue {
 public:
  void push(const Reached_face& reached) { heap_.push(reached); }

  /// Calls `visit(face)` for all, and for those that it pushes.
  template <class Visit>
  void visit_all(const Visit& visit) {
    while (!heap_.empty()) {
      const Reached_face reached = heap_.top();
      heap_.pop();
      visit(reached);
    }
  }

 private:
  std::priority_queue<Reached_face> heap_;
};

/// The lengths of the shortest paths over a dual graph from a growing set of source faces; infinite where no path
/// leads, negative at the sources themselves.
///
/// Dijkstra's algorithm. A source added later visits those faces only that come closer. Where costs are much alike, as
/// distances between neighbouring faces are, buckets of faces are its queue, 2 to 2.5 times as fast as a heap; where most
/// are far below their mean, as differences on flat faces are, a heap. The result is the same.
class Distances_to_sources {
 public:
  using Index = Dual_graph::Index;

  /// Keeps a reference to the graph. The costs are in the order of the edges and not negative; no path leads over an infinite one.
  Distances_to_sources(const Dual_graph& graph, std::vector<double> cost)
      : graph_(graph),
        cost_(std::move(cost)),
        distance_(graph.number_of_faces(), std::numeric_limits<double>::infinity()),
        bucket_width_(mean_of_finite(cost_) / 4),
        buckets_(bucket_width_ > 0 ? 1 / bucket_width_ : 0) {
    const auto is_far_below = [&](double c) { return c < bucket_width_ / 8; };
    costs_are_alike_ = 2 * std::count_if(cost_.begin(), cost_.end(), is_far_below) <= std::ptrdiff_t(cost_.size());
  }

  const std::vector<double>& operator*() const { return distance_; }
  double operator[](Index face) const { return distance_[face]; }

  void add_source(Index source) { add_sources(&source, &source + 1); }

  /// Adds several sources at once.
  template <class Iterator>
  void add_sources(Iterator begin, Iterator end) {
    std::for_each(begin, end, [&](Index source) { distance_[source] = -1; });
    if (costs_are_alike_)
      search(buckets_, begin, end);
    else
      search(heap_, begin, end);
  }

 private:
  static double mean_of_finite(const std::vector<double>& cost) {
    double sum = 0;
    std::size_t finite = 0;
    for (const double c : cost) {
      if (!std::isfinite(c)) continue;
      sum += c;
      ++finite;
    }
    return finite > 0 ? sum / static_cast<double>(finite) : 0;
  }

  template <class Queue, class Iterator>
  void search(Queue& queue, Iterator begin, Iterator end) {
    const auto shorten_paths_over = [&](Index face, double distance) {
      for (const auto [next, edge] : graph_.neighbours(face)) {
        const double through_face = distance + cost_[edge];
        if (!(through_face < distance_[next])) continue;
        distance_[next] = through_face;
        queue.push({through_face, next});
      }
    };
    std::for_each(begin, end, [&](Index source) { shorten_paths_over(source, 0); });
    queue.visit_all([&](const Reached_face& reached) {
      if (reached.distance == distance_[reached.face]) shorten_paths_over(reached.face, reached.distance);
    });
  }

  const Dual_graph& graph_;
  std::vector<double> cost_, distance_;
  double bucket_width_;
  bool costs_are_alike_;
  Bucket_queue buckets_;
  Heap_queue heap_;
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
