// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_TILES_EDGE_SET_H
#define RW_SEGMENTATION_INTERNAL_TILES_EDGE_SET_H

#include <RW_segmentation/Dual_graph.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Edges, each known by its two vertices in either order.
class Edge_set {
 public:
  using Index = Dual_graph::Index;
  using Ends = std::array<Index, 2>;

  /// Complexity: O(n log n).
  explicit Edge_set(std::vector<Ends> edges) : edges_(std::move(edges)) {
    for (Ends& ends : edges_) std::sort(ends.begin(), ends.end());
    std::sort(edges_.begin(), edges_.end());
  }

  /// Complexity: O(log n).
  bool contains(Ends ends) const {
    std::sort(ends.begin(), ends.end());
    return std::binary_search(edges_.begin(), edges_.end(), ends);
  }

 private:
  std::vector<Ends> edges_;  // each with its lower vertex first, rising
};

}  // namespace RW_segmentation::internal

#endif
