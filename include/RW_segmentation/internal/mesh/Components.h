// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_COMPONENTS_H
#define RW_SEGMENTATION_INTERNAL_MESH_COMPONENTS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/threads.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Connected components of a graph.
struct Components {
  using Index = Dual_graph::Index;

  std::vector<Index> of;  ///< by face, numbered in the order of their first faces
  std::size_t count = 0;

  Components() = default;

  /// The components over those edges that join their faces.
  /// \param joins a function from an edge to `bool`, called from several threads
  /// Complexity: nearly linear.
  template <class Joins>
  Components(const Dual_graph& graph, const Joins& joins)
      : Components(over_neighbours(graph, [&](Index, Index, Index edge) { return joins(edge); })) {}

  /// As above, by a function of a face, a neighbour and the edge between them.
  template <class Joins>
  static Components over_neighbours(const Dual_graph& graph, const Joins& joins) {
    Components components;
    components.of.resize(graph.number_of_faces());
    components.join(graph, joins);
    components.number();
    return components;
  }

 private:
  using Crossings = std::vector<std::pair<Index, Index>>;  // faces that are joined over the ends of a stretch

  /// Leads each face to a lower one of its component, and the lowest one to itself: within stretches first.
  template <class Joins>
  void join(const Dual_graph& graph, const Joins& joins) {
    constexpr std::size_t stretch = 16384;  // faces
    std::vector<Crossings> crossings((of.size() + stretch - 1) / stretch);
    parallel_stretches(
        of.size(),
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t f = begin; f < end; ++f)
            join_before(graph, joins, static_cast<Index>(f), begin, crossings[begin / stretch]);
        },
        stretch);
    for (const Crossings& joined : crossings)
      for (const auto& [f, next] : joined) join_roots(root_of(f), root_of(next));
  }

  /// Joins a face to its neighbours from `begin` on that come before it, and notes those that come before `begin`.
  template <class Joins>
  void join_before(const Dual_graph& graph, const Joins& joins, Index face, std::size_t begin, Crossings& crossings) {
    of[face] = face;
    Index root = face;
    for (const auto& [next, edge] : graph.neighbours(face)) {
      if (next >= face || !joins(face, next, edge)) continue;
      if (next < begin)
        crossings.emplace_back(face, next);
      else
        root = join_roots(root, root_of(next));
    }
  }

  Index join_roots(Index a, Index b) { return of[std::max(a, b)] = std::min(a, b); }

  /// Follows a face to the lowest of its component, and halves the way.
  Index root_of(Index face) {
    while (of[face] != face) face = of[face] = of[of[face]];
    return face;
  }

  void number() {
    for (std::size_t f = 0; f < of.size(); ++f)
      of[f] = of[f] == f ? static_cast<Index>(count++) : of[of[f]];  // a lower face has its number by now
  }
};

}  // namespace RW_segmentation::internal

#endif
