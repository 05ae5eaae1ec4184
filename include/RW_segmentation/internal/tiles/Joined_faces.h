// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_TILES_JOINED_FACES_H
#define RW_SEGMENTATION_INTERNAL_TILES_JOINED_FACES_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/mesh/Face_corners.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <vector>

namespace RW_segmentation::internal {

/// Which faces lie beside each other, by their corners alone. Two faces are neighbours over a side that both have, in
/// opposite directions, and no third one has. All other sides are open.
struct Joined_faces {
  using Index = Dual_graph::Index;

  std::vector<std::array<Index, 2>> sides;      ///< by edge: its faces
  std::vector<std::array<Index, 2>> ends;       ///< by edge: its vertices, in the direction of its first face
  std::vector<std::array<Index, 2>> open_ends;  ///< of open sides, in the direction of their faces
  std::size_t turned_sides = 0;                 ///< open ones that two faces have in the same direction

  /// Edges are in the order of their first faces, which are those of the lower number.
  /// Complexity: linear for vertices of bounded degree.
  Joined_faces(const Face_corners& corners, std::size_t number_of_vertices) {
    const std::vector<Side> grouped = sides_by_lower_vertex(corners, number_of_vertices);
    std::vector<std::array<Index, 4>> joined;  // faces, then vertices
    for (std::size_t begin = 0, end = 0; begin < grouped.size(); begin = end) {
      while (end < grouped.size() && grouped[end].vertices() == grouped[begin].vertices()) ++end;
      const Side &a = grouped[begin], &b = grouped[end - 1];
      if (end == begin + 2 && a.face != b.face && a.from != b.from) {
        const Side &first = a.face < b.face ? a : b, &second = a.face < b.face ? b : a;
        joined.push_back({first.face, second.face, first.from, first.to});
        continue;
      }
      if (end == begin + 2 && a.face != b.face) turned_sides += 2;
      for (std::size_t i = begin; i < end; ++i) open_ends.push_back({grouped[i].from, grouped[i].to});
    }
    std::sort(joined.begin(), joined.end());
    sides.reserve(joined.size());
    ends.reserve(joined.size());
    for (const auto& [f, g, u, v] : joined) {
      sides.push_back({f, g});
      ends.push_back({u, v});
    }
  }

 private:
  struct Side {
    Index from, to, face;
    std::array<Index, 2> vertices() const { return {std::min(from, to), std::max(from, to)}; }
  };

  static std::vector<Side> sides_by_lower_vertex(const Face_corners& corners, std::size_t number_of_vertices) {
    const auto for_each_side = [&](const auto& use) {
      for (Index f = 0; f < corners.number_of_faces(); ++f) {
        const auto range = corners[f];
        for (std::size_t k = 0; k < range.size(); ++k) use(Side{range[k], range[k + 1 < range.size() ? k + 1 : 0], f});
      }
    };
    std::vector<std::size_t> next(number_of_vertices + 1, 0);
    for_each_side([&](const Side& side) { ++next[side.vertices()[0] + std::size_t(1)]; });
    for (std::size_t v = 0; v < number_of_vertices; ++v) next[v + 1] += next[v];
    std::vector<Side> grouped(corners.number_of_corners());
    for_each_side([&](const Side& side) { grouped[next[side.vertices()[0]]++] = side; });
    // Each place in `next` has moved on to the end of its group.
    std::size_t begin = 0;
    for (std::size_t v = 0; v < number_of_vertices; ++v) {
      const auto first = grouped.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto last = grouped.begin() + static_cast<std::ptrdiff_t>(next[v]);
      std::sort(first, last, [](const Side& a, const Side& b) {
        return std::tuple(a.vertices(), a.face, a.from) < std::tuple(b.vertices(), b.face, b.from);
      });
      begin = next[v];
    }
    return grouped;
  }
};

}  // namespace RW_segmentation::internal

#endif
