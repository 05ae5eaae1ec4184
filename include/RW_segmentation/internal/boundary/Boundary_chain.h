// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_BOUNDARY_CHAIN_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_BOUNDARY_CHAIN_H

#include <RW_segmentation/internal/boundary/Border_crossing.h>
#include <RW_segmentation/internal/boundary/Border_way.h>
#include <RW_segmentation/internal/boundary/Surface_curve.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>
#include <RW_segmentation/internal/boundary/Walled_surface.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace RW_segmentation::internal {

/// An end of a chain at a crossing.
struct Chain_end {
  Border_crossing crossing;
  Border_way way;  ///< to its side, if it has one

  bool is_on_side() const { return crossing.side != Triangle_surface::none; }
  Curve_node node(std::size_t origin) const {
    return {Triangle_surface::none, crossing.side, crossing.position, origin};
  }
  Curve_point point(std::size_t origin) const {
    const Triangle_surface::Index corner = crossing.side % 3;
    Curve_point point{Triangle_surface::none, {Triangle_surface::face(crossing.side), {0, 0, 0}}, origin, true};
    point.place.weight[corner] = 1 - crossing.position;
    point.place.weight[(corner + 1) % 3] = crossing.position;
    return point;
  }
};

/// A boundary between two segments as it runs along the edges of the mesh, with one segment on its left and one on its
/// right all the way.
struct Boundary_chain {
  std::vector<Triangle_surface::Index> halfedges;  ///< each begins where the one before ends; faces on the left
  bool is_closed = false;
  bool is_wall = false;                            ///< all along; otherwise walls are met in the ends only
  std::array<std::size_t, 2> segments{};           ///< on the left and on the right
  std::array<std::optional<Chain_end>, 2> ends{};  ///< the first and the last one, where they are at crossings

  bool ends_on_side(std::size_t end) const { return ends[end] && ends[end]->is_on_side(); }
};

/// The nodes from the end of a chain to the crossing on a side, close to the border.
/// \param last vertex of the chain within the mesh
inline std::vector<Curve_node> nodes_to_crossing(const Triangle_surface& surface, const Chain_end& end,
                                                 Triangle_surface::Index last, std::size_t origin) {
  constexpr double close = 1. / 3;  // of a spoke: less than half, so that ways at both ends of it pass each other
  std::vector<Curve_node> nodes;
  for (std::size_t k = end.way.spokes_to(last, surface); k < end.way.spokes.size(); ++k)
    nodes.push_back(crossing(surface, end.way.spokes[k], close, origin));
  nodes.push_back(end.node(origin));
  return nodes;
}

/// A chain as a curve, not smoothed: its vertices, and the ways to the crossings on sides at its ends. The first node of a
/// closed chain follows the last.
inline std::vector<Curve_node> nodes_of(const Triangle_surface& surface, const Boundary_chain& chain) {
  const std::size_t last = chain.halfedges.size() - 1;
  std::vector<Curve_node> nodes;
  if (chain.ends_on_side(0)) {
    nodes = nodes_to_crossing(surface, *chain.ends[0], surface.target(chain.halfedges[0]), 0);
    std::reverse(nodes.begin(), nodes.end());
  }
  for (std::size_t i = chain.ends_on_side(0) ? 1 : 0; i <= last; ++i)
    nodes.push_back({surface.source(chain.halfedges[i]), Triangle_surface::none, 0, i});
  if (chain.ends_on_side(1)) {
    const auto way = nodes_to_crossing(surface, *chain.ends[1], surface.source(chain.halfedges[last]), last);
    nodes.insert(nodes.end(), way.begin(), way.end());
  } else if (!chain.is_closed) {
    nodes.push_back({surface.target(chain.halfedges[last]), Triangle_surface::none, 0, last});
  }
  return nodes;
}

/// Follows the boundaries between segments from branch point to branch point.
///
/// Branch points are vertices where one or more than two boundary edges end, and all where a boundary meets the mesh's
/// border, or a wall that it does not run along.
class Boundary_chains {
 public:
  using Index = Triangle_surface::Index;

  Boundary_chains(const Walled_surface& surface, const std::vector<std::size_t>& segment_of_face)
      : walled_(surface),
        surface_(surface.whole()),
        segment_of_face_(segment_of_face),
        leaving_(surface_.number_of_vertices()) {
    for (Index h = 0; h < surface_.number_of_halfedges(); ++h) {
      leaving_[surface_.source(h)].is_at_wall |= surface.is_wall(h);
      if (is_boundary(h)) note(surface_.source(h), h);
    }
    is_followed_.assign(surface_.number_of_halfedges(), false);
  }

  /// All chains, in the order of their first halfedges, the open ones first.
  std::vector<Boundary_chain> operator()() {
    std::vector<Boundary_chain> chains;
    for (const bool from_branch_points : {true, false})
      for (Index h = 0; h < surface_.number_of_halfedges(); ++h)
        if (is_boundary(h) && !is_followed_[h] && (!from_branch_points || is_branch_point(surface_.source(h))))
          chains.push_back(follow(h));
    return chains;
  }

 private:
  /// The boundary edges at a vertex: how many, and those two that a chain passes through.
  struct Leaving {
    std::size_t number = 0;
    bool is_at_wall = false;
    std::array<Index, 2> halfedges{};
  };

  std::size_t left(Index h) const { return segment_of_face_[Triangle_surface::face(h)]; }
  std::size_t right(Index h) const { return left(surface_.twin(h)); }
  bool is_boundary(Index h) const { return !surface_.is_border(h) && left(h) != right(h); }

  void note(Index vertex, Index h) {
    Leaving& leaving = leaving_[vertex];
    if (leaving.number < 2) leaving.halfedges[leaving.number] = h;
    ++leaving.number;
  }

  bool is_branch_point(Index vertex) const {
    const Leaving& leaving = leaving_[vertex];
    if (leaving.number != 2 || surface_.is_on_border(vertex)) return true;
    const auto [a, b] = leaving.halfedges;
    return leaving.is_at_wall && !(walled_.is_wall(a) && walled_.is_wall(b));
  }

  Boundary_chain follow(Index first) {
    Boundary_chain chain;
    chain.segments = {left(first), right(first)};
    chain.is_wall = walled_.is_wall(first);
    for (Index h = first;;) {
      chain.halfedges.push_back(h);
      is_followed_[h] = is_followed_[surface_.twin(h)] = true;
      const Index end = surface_.target(h);
      if (is_branch_point(end)) break;
      const auto [a, b] = leaving_[end].halfedges;
      h = a == surface_.twin(h) ? b : a;
      chain.is_closed = h == first;
      // The parts of a surface that touch in a vertex may change sides there.
      if (is_followed_[h] || left(h) != chain.segments[0] || right(h) != chain.segments[1]) break;
    }
    return chain;
  }

  const Walled_surface& walled_;
  const Triangle_surface& surface_;
  const std::vector<std::size_t>& segment_of_face_;
  std::vector<Leaving> leaving_;  // each vertex
  std::vector<char> is_followed_;
};

}  // namespace RW_segmentation::internal

#endif
