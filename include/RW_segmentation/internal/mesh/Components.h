// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_COMPONENTS_H
#define RW_SEGMENTATION_INTERNAL_MESH_COMPONENTS_H

#include <RW_segmentation/Dual_graph.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// Connected components of a graph.
struct Components {
  std::vector<Dual_graph::Index> of;  ///< by face, numbered in the order of their first faces
  std::size_t count = 0;

  Components() = default;

  /// The components over those edges that join their faces.
  /// \param joins a function from an edge to `bool`
  /// Complexity: linear.
  template <class Joins>
  Components(const Dual_graph& graph, const Joins& joins) {
    using Index = Dual_graph::Index;
    constexpr Index none = std::numeric_limits<Index>::max();
    of.assign(graph.number_of_faces(), none);
    std::vector<Index> open;
    for (std::size_t f = 0; f < of.size(); ++f) {
      if (of[f] != none) continue;
      const auto component = static_cast<Index>(count++);
      of[f] = component;
      open.push_back(static_cast<Index>(f));
      while (!open.empty()) {
        const Index face = open.back();
        open.pop_back();
        for (const auto& [next, edge] : graph.neighbours(face))
          if (of[next] == none && joins(edge)) {
            of[next] = component;
            open.push_back(next);
          }
      }
    }
  }
};

}  // namespace RW_segmentation::internal

#endif
