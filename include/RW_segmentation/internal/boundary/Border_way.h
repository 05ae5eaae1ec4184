// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_BORDER_WAY_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_BORDER_WAY_H

#include <RW_segmentation/internal/boundary/Triangle_surface.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace RW_segmentation::internal {

/// The way from a boundary that leads to a vertex on the border of the mesh to a side of that border, over the faces along
/// the border in between.
struct Border_way {
  using Index = Triangle_surface::Index;

  /// Sides of the border on a way. Boundaries are moved by an edge or two; what is farther is another place.
  static constexpr std::size_t most_sides = 6;

  std::vector<Index> spokes;  ///< halfedges that are crossed, in this order; each leaves a vertex on the border
  std::vector<Index> sides;   ///< of the border that are passed; the last one is where the way ends
  bool is_leftward = false;   ///< whether it begins on the left of the boundary

  /// The number of spokes that lead to the vertex that the boundary comes from. They are the first ones, and need not be
  /// crossed from there.
  std::size_t spokes_to(Index vertex, const Triangle_surface& surface) const {
    std::size_t count = 0;
    while (count < spokes.size() && surface.target(spokes[count]) == vertex) ++count;
    return count;
  }
};

/// Follows the border from one side to the next, in one direction.
inline std::optional<Border_way> border_way(const Triangle_surface& surface, Triangle_surface::Index into,
                                            Triangle_surface::Index side, bool is_leftward) {
  constexpr std::size_t most_spokes = 1000;  // so that a vertex within the mesh is no trap
  Border_way way;
  way.is_leftward = is_leftward;
  const auto turn = [&](Triangle_surface::Index h) {  // to the next edge round the vertex
    return is_leftward ? Triangle_surface::next(h) : Triangle_surface::previous(h);
  };
  Triangle_surface::Index h = is_leftward ? into : surface.twin(into);
  while (way.sides.size() < Border_way::most_sides) {
    for (h = turn(h); !surface.is_border(h); h = turn(surface.twin(h))) {
      if (way.spokes.size() == most_spokes) return std::nullopt;
      way.spokes.push_back(is_leftward ? h : surface.twin(h));
    }
    way.sides.push_back(h);
    if (h == side) return way;
  }
  return std::nullopt;
}

/// \param into a halfedge between two faces that leads to a vertex on the border
/// \param side of the border
/// \returns nothing if the side is far
inline std::optional<Border_way> border_way(const Triangle_surface& surface, Triangle_surface::Index into,
                                            Triangle_surface::Index side) {
  auto left = border_way(surface, into, side, true), right = border_way(surface, into, side, false);
  if (!left || (right && right->sides.size() < left->sides.size())) return right;
  return left;
}

}  // namespace RW_segmentation::internal

#endif
