// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_TILES_JOINED_FACES_H
#define RW_SEGMENTATION_INTERNAL_TILES_JOINED_FACES_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/check_number.h>
#include <RW_segmentation/internal/mesh/Face_corners.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
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
  /// \throws std::length_error if there are 2^32 - 1 corners or more
  /// Complexity: linear for vertices of bounded degree.
  Joined_faces(const Face_corners& corners, std::size_t number_of_vertices) {
    check_number(corners.number_of_corners(), "corners");
    std::vector<Index> beyond(corners.number_of_corners(),
                              none);  // by side: the face there, from that of the lower number
    std::size_t begin = 0;
    std::vector<std::size_t> end;  // of the sides of each lower vertex
    std::vector<Side> sides_of = sides_by_lower_vertex(corners, number_of_vertices, end);
    for (Index low = 0; low < number_of_vertices; begin = end[low], ++low) {
      const auto place = [&](std::size_t at) { return sides_of.begin() + static_cast<std::ptrdiff_t>(at); };
      std::sort(place(begin), place(end[low]));
      for (std::size_t first = begin, last = begin; first < end[low]; first = last) {
        while (last < end[low] && sides_of[last].high == sides_of[first].high) ++last;
        join(low, sides_of.data() + first, sides_of.data() + last, beyond);
      }
    }
    take_in_order(corners, beyond);
  }

 private:
  static constexpr Index none = std::numeric_limits<Index>::max();

  /// A side of a face, kept with the lower one of its two vertices.
  struct Side {
    Index high;
    Index face_and_direction;  // twice the face, and one more where it leads from the higher vertex to the lower one
    Index corner;              // that the side begins at, counted over all faces
    Index face() const { return face_and_direction / 2; }
    bool from_lower() const { return face_and_direction % 2 == 0; }
    bool operator<(const Side& other) const {
      return high != other.high ? high < other.high : face_and_direction < other.face_and_direction;
    }
  };

  /// Calls `use(lower vertex, side)` for all sides.
  template <class Use>
  static void for_each_side(const Face_corners& corners, const Use& use) {
    Index corner = 0;
    for (Index f = 0; f < corners.number_of_faces(); ++f) {
      const auto range = corners[f];
      for (std::size_t k = 0; k < range.size(); ++k, ++corner) {
        const Index from = range[k], to = range[k + 1 < range.size() ? k + 1 : 0];
        use(std::min(from, to), Side{std::max(from, to), 2 * f + Index(from > to), corner});
      }
    }
  }

  /// \param[out] end of those of each vertex
  static std::vector<Side> sides_by_lower_vertex(const Face_corners& corners, std::size_t number_of_vertices,
                                                 std::vector<std::size_t>& end) {
    end.assign(number_of_vertices + 1, 0);
    for_each_side(corners, [&](Index low, const Side&) { ++end[low + std::size_t(1)]; });
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<Side> sides(corners.number_of_corners());
    for_each_side(corners, [&](Index low, const Side& side) { sides[end[low]++] = side; });
    return sides;  // Each place in `end` has moved on.
  }

  /// Joins the faces that have a side between the same two vertices, if they are two.
  void join(Index low, const Side* first, const Side* last, std::vector<Index>& beyond) {
    const bool are_two = last == first + 2 && first[0].face() != first[1].face();
    if (are_two && first[0].from_lower() != first[1].from_lower()) {
      beyond[first[0].corner] = first[1].face();
      return;
    }
    if (are_two) turned_sides += 2;
    for (; first != last; ++first)
      open_ends.push_back(first->from_lower() ? std::array{low, first->high} : std::array{first->high, low});
  }

  /// The edges of a face rise by its neighbours.
  void take_in_order(const Face_corners& corners, const std::vector<Index>& beyond) {
    const std::size_t edges = beyond.size() - static_cast<std::size_t>(std::count(beyond.begin(), beyond.end(), none));
    sides.reserve(edges);
    ends.reserve(edges);
    std::vector<std::array<Index, 3>> of_face;  // the neighbour, the vertices
    std::size_t corner = 0;
    for (Index f = 0; f < corners.number_of_faces(); ++f) {
      const auto range = corners[f];
      of_face.clear();
      for (std::size_t k = 0; k < range.size(); ++k, ++corner)
        if (beyond[corner] != none)
          of_face.push_back({beyond[corner], range[k], range[k + 1 < range.size() ? k + 1 : 0]});
      std::sort(of_face.begin(), of_face.end());
      for (const auto& [g, u, v] : of_face) {
        sides.push_back({f, g});
        ends.push_back({u, v});
      }
    }
  }
};

}  // namespace RW_segmentation::internal

#endif
