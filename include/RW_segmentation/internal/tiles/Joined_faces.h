// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_TILES_JOINED_FACES_H
#define RW_SEGMENTATION_INTERNAL_TILES_JOINED_FACES_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/mesh/Face_corners.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
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
    std::vector<Joined_side> joined;
    joined.reserve(grouped.size() / 2);
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
    take_in_order(joined, corners.number_of_faces());
  }

 private:
  struct Side {
    Index from, to, face;
    std::array<Index, 2> vertices() const { return {std::min(from, to), std::max(from, to)}; }
  };
  using Joined_side = std::array<Index, 4>;  // faces, the one of the lower number first, then vertices

  /// Groups things by their keys, below `number_of_keys`, and sorts each group, which is small.
  /// \param for_each calls a function with each thing
  /// \param sorted of as many things
  template <class Thing, class For_each, class Key, class Less>
  static void sort_in_groups(const For_each& for_each, std::size_t number_of_keys, const Key& key, const Less& less,
                             std::vector<Thing>& sorted) {
    std::vector<std::size_t> next(number_of_keys + 1, 0);
    for_each([&](const Thing& thing) { ++next[key(thing) + std::size_t(1)]; });
    for (std::size_t k = 0; k < number_of_keys; ++k) next[k + 1] += next[k];
    for_each([&](const Thing& thing) { sorted[next[key(thing)]++] = thing; });
    // Each place in `next` has moved on to the end of its group.
    std::size_t begin = 0;
    for (std::size_t k = 0; k < number_of_keys; ++k) {
      std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin),
                sorted.begin() + static_cast<std::ptrdiff_t>(next[k]), less);
      begin = next[k];
    }
  }

  void take_in_order(const std::vector<Joined_side>& joined, std::size_t number_of_faces) {
    std::vector<Joined_side> sorted(joined.size());
    sort_in_groups(
        [&](const auto& use) {
          for (const Joined_side& side : joined) use(side);
        },
        number_of_faces, [](const Joined_side& side) { return side[0]; }, std::less<>(), sorted);
    sides.reserve(sorted.size());
    ends.reserve(sorted.size());
    for (const auto& [f, g, u, v] : sorted) {
      sides.push_back({f, g});
      ends.push_back({u, v});
    }
  }

  static std::vector<Side> sides_by_lower_vertex(const Face_corners& corners, std::size_t number_of_vertices) {
    const auto for_each_side = [&](const auto& use) {
      for (Index f = 0; f < corners.number_of_faces(); ++f) {
        const auto range = corners[f];
        for (std::size_t k = 0; k < range.size(); ++k) use(Side{range[k], range[k + 1 < range.size() ? k + 1 : 0], f});
      }
    };
    const auto is_before = [](const Side& a, const Side& b) {
      return std::tuple(a.vertices(), a.face, a.from) < std::tuple(b.vertices(), b.face, b.from);
    };
    std::vector<Side> grouped(corners.number_of_corners());
    sort_in_groups(
        for_each_side, number_of_vertices, [](const Side& side) { return side.vertices()[0]; }, is_before, grouped);
    return grouped;
  }
};

}  // namespace RW_segmentation::internal

#endif
