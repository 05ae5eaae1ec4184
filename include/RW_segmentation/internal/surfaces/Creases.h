// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_CREASES_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_CREASES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Region_boundary.h>
#include <RW_segmentation/internal/merging/Region_merging.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// A merge cost: how much of the boundary of two regions is crease, if the difference is 1 on creases and 0 elsewhere.
struct Share_of_crease {
  struct Region {};
  void join(Region&, const Region&) const {}
  double operator()(const Region&, const Region&, const Region_boundary& boundary) const {
    return boundary.common.difference / boundary.common.length;
  }
};

/// The creases inside a group of connected faces, along which it is cut where they are long.
///
/// What comments tell of other values of a number was measured as in `Surface_growing`.
class Creases {
 public:
  using Index = Dual_mesh::Index;

  /// Keeps references to all.
  /// \param angles of the edges
  Creases(const Dual_mesh& mesh, const Surface_tolerance& tolerance, const std::vector<double>& angles,
          const std::vector<Index>& group)
      : mesh_(mesh), tolerance_(tolerance), angles_(angles), group_(group), inside_(group.begin(), group.end()) {}

  /// The faces about the vertices that long creases pass, connected ones together.
  std::vector<std::vector<Index>> sides() const {
    const std::set<Index> passed = passed_vertices();
    if (passed.empty()) return {};
    const auto is_beside = [&](Index f) {
      const Dual_mesh::Corners corners = mesh_.corners(f);
      return inside_.count(f) > 0 &&
             std::any_of(corners.begin(), corners.end(), [&](Index v) { return passed.count(v) > 0; });
    };
    std::set<Index> reached;
    std::vector<std::vector<Index>> sides;
    for (const Index f : group_) {
      if (!is_beside(f) || !reached.insert(f).second) continue;
      std::vector<Index> side = {f};
      for (std::size_t i = 0; i < side.size(); ++i)
        for (const auto& [g, e] : mesh_.graph().neighbours(side[i]))
          if (!mesh_.is_wall(e) && !is_crease(e) && is_beside(g) && reached.insert(g).second) side.push_back(g);
      sides.push_back(std::move(side));
    }
    return sides;
  }

  /// Joins pieces of the group across those boundaries first that have least of a crease, until all are half a crease.
  /// \param piece_of_face from `first_piece` to `first_piece + pieces - 1` in the group
  /// \returns for each piece the number, from 0, of what it has become part of
  std::vector<std::size_t> joined(const std::vector<std::size_t>& piece_of_face, std::size_t first_piece,
                                  std::size_t pieces) const {
    constexpr double half = 0.5;                     // as good as at .3; at .7, overlap .9764 in place of .9766 (`_5k`)
    std::map<std::array<Index, 2>, Edge_sums> sums;  // of two pieces, the lower one first
    for (const Index f : group_)
      for (const auto& [g, e] : mesh_.graph().neighbours(f)) {
        if (!(piece_of_face[f] < piece_of_face[g]) || inside_.count(g) == 0 || mesh_.is_wall(e)) continue;
        const double length = mesh_.edge_length(e);
        const auto piece = [&](Index face) { return static_cast<Index>(piece_of_face[face] - first_piece); };
        sums[{piece(f), piece(g)}] += {length, is_crease(e) ? length : 0};
      }
    std::vector<Boundary_of_regions<Edge_sums>> boundaries;
    for (const auto& [regions, common] : sums) boundaries.push_back({regions, common});
    const Share_of_crease cost;
    const Merge_tree tree =
        Region_merging<Share_of_crease>(std::vector<Share_of_crease::Region>(pieces), std::move(boundaries), cost)
            .run(Progress());
    return tree.segment_of_fragments(Cost_threshold_stop(half)(tree));
  }

 private:
  bool is_crease(Index edge) const { return angles_[edge] > tolerance_.sharp_angle(mesh_.graph().faces_of(edge)); }

  /// Where two edges or more of a crease meet, if it is long beside the group.
  std::set<Index> passed_vertices() const {
    // As a part of the square root of the group's area: 0.25 and 1 cut the CAD solids alike.
    constexpr double least_length = 0.5;
    // Of a crease that is more than a detail of its mesh: at 8, a hundredth more segments (`_5k`); at 32, overlap .9762 in
    // place of .9766.
    constexpr std::size_t fewest_vertices = 16;
    std::map<Index, std::vector<std::pair<Index, double>>> crease;  // by vertex: the other end of each edge, its length
    double area = 0;
    for (const Index f : group_) {
      area += mesh_.area(f);
      for (const auto& [g, e] : mesh_.graph().neighbours(f))
        if (f < g && inside_.count(g) > 0 && is_crease(e)) {
          const auto [v, w] = mesh_.ends(e);
          crease[v].emplace_back(w, mesh_.edge_length(e));
          crease[w].emplace_back(v, mesh_.edge_length(e));
        }
    }
    std::set<Index> reached, passed;
    for (const auto& [first, edges] : crease) {
      if (!reached.insert(first).second) continue;
      std::vector<Index> vertices = {first};
      double length = 0;
      for (std::size_t i = 0; i < vertices.size(); ++i)
        for (const auto& [next, edge_length] : crease.at(vertices[i])) {
          length += edge_length / 2;
          if (reached.insert(next).second) vertices.push_back(next);
        }
      if (vertices.size() < fewest_vertices || length < least_length * std::sqrt(area)) continue;
      for (const Index v : vertices)
        if (crease.at(v).size() > 1) passed.insert(v);
    }
    return passed;
  }

  const Dual_mesh& mesh_;
  const Surface_tolerance& tolerance_;
  const std::vector<double>& angles_;  // of the edges
  const std::vector<Index>& group_;
  const std::set<Index> inside_;  // the group
};

}  // namespace RW_segmentation::internal

#endif
