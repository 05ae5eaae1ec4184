// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_PATCH_BORDERS_H
#define RW_SEGMENTATION_INTERNAL_BREP_PATCH_BORDERS_H

#include <RW_segmentation/internal/brep/Halfedge_triangles.h>
#include <RW_segmentation/internal/brep/Patch.h>
#include <RW_segmentation/internal/brep/Patch_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace RW_segmentation::internal::brep {

/// A chain of mesh edges between two patches, which becomes an edge.
struct Chain {
  std::vector<std::size_t> vertices;  ///< of the mesh; the first is the last where it is closed
  std::size_t left = none;            ///< the patch that sees it forward
  std::size_t right = none;           ///< the other one; `none` at the mesh's border

  bool is_closed() const { return vertices.front() == vertices.back(); }
};

/// A chain on the way round a patch.
struct Directed_chain {
  std::size_t chain = none;
  bool is_forward = true;
};

/// What lies between patches: the topology of the boundary representation. Branch points become vertices, chains between
/// them edges. Corners of the mesh's border are branch points, too: a curve would swing out there.
class Patch_borders {
 public:
  /// Complexity: linear.
  Patch_borders(const Halfedge_triangles& mesh, const std::vector<Patch>& patches)
      : mesh_(mesh),
        patches_(patches),
        patch_of_(mesh.number_of_triangles(), none),
        is_branch_(mesh.points().size(), false),
        chain_of_(mesh.number_of_halfedges()) {
    for (std::size_t i = 0; i < patches.size(); ++i)
      for (const std::size_t t : patches[i].triangles) patch_of_[t] = i;
    find_branch_points();
    for (const bool starts_anywhere : {false, true})  // open chains, then closed ones
      for (std::size_t h = 0; h < mesh.number_of_halfedges(); ++h)
        if (is_border(h) && chain_of_[h].chain == none && (starts_anywhere || is_branch_[mesh.from(h)])) follow(h);
  }

  const std::vector<Chain>& chains() const { return chains_; }
  /// Whether a mesh vertex becomes a vertex.
  bool is_branch(std::size_t vertex) const { return is_branch_[vertex]; }
  std::size_t patch_of(std::size_t triangle) const { return patch_of_[triangle]; }

  /// The chains round a patch, which lies on their left, loop by loop.
  std::vector<std::vector<Directed_chain>> loops(std::size_t patch) const {
    std::vector<std::vector<Directed_chain>> result;
    std::vector<std::size_t> starts;
    for (const std::size_t t : patches_[patch].triangles)
      for (std::size_t h = 3 * t; h < 3 * t + 3; ++h)
        if (is_border_of(patch, h) && is_branch_[mesh_.from(h)]) starts.push_back(h);
    std::vector<char> is_done(starts.size(), false);
    std::map<std::size_t, std::size_t> place;
    for (std::size_t i = 0; i < starts.size(); ++i) place[starts[i]] = i;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      if (is_done[i]) continue;
      result.emplace_back();
      std::size_t h = starts[i];
      do {
        if (is_branch_[mesh_.from(h)]) {
          is_done[place[h]] = true;
          result.back().push_back(chain_of_[h]);
        }
        h = next_of_border(patch, h);
      } while (h != starts[i]);
    }
    return result;
  }

 private:
  bool is_border(std::size_t h) const {
    const std::size_t other = mesh_.neighbour(h);
    return other == none || patch_of_[other] != patch_of_[h / 3];
  }
  bool is_border_of(std::size_t patch, std::size_t h) const {
    const std::size_t other = mesh_.neighbour(h);
    return other == none || patch_of_[other] != patch;
  }
  /// The halfedge after one on the border of a patch.
  std::size_t next_of_border(std::size_t patch, std::size_t h) const {
    for (h = mesh_.next(h); !is_border_of(patch, h);) h = mesh_.next(mesh_.opposite(h));
    return h;
  }

  void find_branch_points() {
    std::vector<std::size_t> degree(mesh_.points().size(), 0);
    for (std::size_t h = 0; h < mesh_.number_of_halfedges(); ++h) {
      if (!is_border(h)) continue;
      ++degree[mesh_.from(h)];
      if (mesh_.opposite(h) == none) ++degree[mesh_.to(h)];
      const std::size_t other = mesh_.neighbour(h);
      if (patches_[patch_of_[h / 3]].has_chords() || (other != none && patches_[patch_of_[other]].has_chords()))
        is_branch_[mesh_.from(h)] = is_branch_[mesh_.to(h)] = true;
    }
    for (std::size_t v = 0; v < degree.size(); ++v)
      if (degree[v] > 0 && degree[v] != 2) is_branch_[v] = true;
    for (const Patch& patch : patches_)
      if (patch.surface)
        for (const std::size_t t : patch.triangles)
          for (const std::size_t v : mesh_.corners(t))
            if (degree[v] > 0 && patch.surface->is_tip(mesh_.point(v))) is_branch_[v] = true;
    find_corners();
  }

  /// The halfedge after one on the mesh's border.
  std::size_t next_of_mesh_border(std::size_t h) const {
    for (h = mesh_.next(h); mesh_.opposite(h) != none;) h = mesh_.next(mesh_.opposite(h));
    return h;
  }

  /// By how much a border turns from one halfedge to the next, in radians.
  double turn(std::size_t h, std::size_t next) const {
    const Point a = mesh_.point(mesh_.to(h)) - mesh_.point(mesh_.from(h)),
                b = mesh_.point(mesh_.to(next)) - mesh_.point(mesh_.from(next));
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }

  /// Arcs turn, too, but no more than the sides of a pentagon, and by as much at one vertex as at the next.
  void find_corners() {
    constexpr double widest_turn_of_arc = full_turn * 75 / 360, least_turn = full_turn * 25 / 360;
    constexpr double times_those_beside = 3;
    for (std::size_t h = 0; h < mesh_.number_of_halfedges(); ++h) {
      if (mesh_.opposite(h) != none) continue;
      const std::size_t second = next_of_mesh_border(h), third = next_of_mesh_border(second),
                        fourth = next_of_mesh_border(third);
      const double before = turn(h, second), here = turn(second, third), after = turn(third, fourth);
      if (here > widest_turn_of_arc || (here > least_turn && here > times_those_beside * std::max(before, after)))
        is_branch_[mesh_.to(second)] = true;
    }
  }

  void follow(std::size_t h) {
    Chain chain;
    chain.left = patch_of_[h / 3];
    if (mesh_.neighbour(h) != none) chain.right = patch_of_[mesh_.neighbour(h)];
    chain.vertices.push_back(mesh_.from(h));
    for (;;) {
      chain_of_[h] = {chains_.size(), true};
      if (mesh_.opposite(h) != none) chain_of_[mesh_.opposite(h)] = {chains_.size(), false};
      chain.vertices.push_back(mesh_.to(h));
      if (is_branch_[mesh_.to(h)] || mesh_.to(h) == chain.vertices.front()) break;
      h = next_of_border(chain.left, h);
    }
    is_branch_[chain.vertices.front()] = true;  // a closed chain has one vertex, too
    chains_.push_back(std::move(chain));
  }

  const Halfedge_triangles& mesh_;
  const std::vector<Patch>& patches_;
  std::vector<std::size_t> patch_of_;  // by triangle
  std::vector<char> is_branch_;        // by vertex
  std::vector<Chain> chains_;
  std::vector<Directed_chain> chain_of_;  // by halfedge
};

}  // namespace RW_segmentation::internal::brep

#endif
