#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_CHAIN_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_CHAIN_H

#include <RW_segmentation/internal/Triangle_surface.h>

#include <array>
#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

/// A boundary between two segments as it runs along the edges of the mesh, with one segment on its left and one on its
/// right all the way.
struct Boundary_chain {
  std::vector<Triangle_surface::Index> halfedges;  ///< each begins where the one before ends; faces on the left
  bool is_closed = false;
  std::array<std::size_t, 2> segments{};  ///< on the left and on the right
};

/// Follows the boundaries between segments from branch point to branch point.
///
/// Branch points are vertices where one or more than two boundary edges end, and all where a boundary meets the mesh's
/// border.
class Boundary_chains {
 public:
  using Index = Triangle_surface::Index;

  Boundary_chains(const Triangle_surface& surface, const std::vector<std::size_t>& segment_of_face)
      : surface_(surface), segment_of_face_(segment_of_face), leaving_(surface.number_of_vertices()) {
    for (Index h = 0; h < surface.number_of_halfedges(); ++h)
      if (is_boundary(h)) note(surface.source(h), h);
    is_followed_.assign(surface.number_of_halfedges(), false);
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

  bool is_branch_point(Index vertex) const { return leaving_[vertex].number != 2 || surface_.is_on_border(vertex); }

  Boundary_chain follow(Index first) {
    Boundary_chain chain;
    chain.segments = {left(first), right(first)};
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

  const Triangle_surface& surface_;
  const std::vector<std::size_t>& segment_of_face_;
  std::vector<Leaving> leaving_;  // each vertex
  std::vector<char> is_followed_;
};

}  // namespace RW_segmentation::internal

#endif
