// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_LABEL_ISLANDS_H
#define RW_SEGMENTATION_INTERNAL_WALK_LABEL_ISLANDS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/parallel_for.h>
#include <RW_segmentation/internal/walk/Seed_set.h>
#include <RW_segmentation/internal/walk/Walk_labels.h>
#include <RW_segmentation/internal/walk/Walk_network.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The islands of labels: connected regions of faces with the label of a seed that none of its seeds lies in.
class Label_islands {
 public:
  using Index = Dual_graph::Index;
  static constexpr Index none = Walk_labels::none;

  /// \param is_connected by rank: labels that are known to have no islands. Their faces are passed over, which is what an
  /// edit owes its speed to.
  Label_islands(const Walk_network& network, const Walk_labels& labels, const Seed_set& seeds,
                const std::vector<char>& is_connected)
      : network_(network), labels_(labels), root_(labels.ranks().size()) {
    std::vector<char> is_searched(labels.number_of_labels(), 0);
    for (std::size_t l = 0; l < labels.number_of_seed_labels(); ++l) is_searched[l] = !is_connected[l];
    find_regions(is_searched);
    for (const auto& seed : seeds.seeds())
      if (const Index root = root_of(seed.face); root != none) root_[root] = none;
    collect_islands();
  }

  std::size_t number_of_faces() const { return number_of_faces_; }

  /// Of each island.
  std::vector<Seed_set::Label> labels() const {
    std::vector<Seed_set::Label> result;
    for (const auto& island : islands_) result.push_back(labels_.label(labels_.ranks()[island.front()]));
    return result;
  }

  /// Whether the potentials that `settled_ranks()` asks for are known: those of the faces beside islands.
  bool has_potentials_beside() const {
    for (const auto& island : islands_)
      for (const Index face : island)
        for (const auto& [next, edge] : network_.graph.neighbours(face))
          if (std::isnan(labels_.largest()[next])) return false;
    return true;
  }

  /// By face: the rank of its label when each island has gone to the label of the neighbour with the largest potential
  /// along its border.
  std::vector<Index> settled_ranks() const {
    std::vector<Index> settled = labels_.ranks();
    for (const auto& island : islands_)
      for (const Index face : island) settled[face] = none;
    std::vector<const std::vector<Index>*> open;
    for (const auto& island : islands_) open.push_back(&island);
    while (!open.empty()) {  // an island among islands waits for one of them
      std::vector<const std::vector<Index>*> waiting;
      for (const auto* island : open) {
        const Index rank = best_supported_neighbour(*island, settled);
        for (const Index face : *island) settled[face] = rank;
        if (rank == none) waiting.push_back(island);
      }
      open = std::move(waiting);
    }
    return settled;
  }

 private:
  static constexpr std::size_t stretch = 16384;  // faces whose regions are found together

  /// Sets the roots of the faces of given labels: the lowest face of the region of each, or another face on the way to it.
  void find_regions(const std::vector<char>& is_searched) {
    const std::size_t n = root_.size();
    std::vector<std::vector<std::pair<Index, Index>>> crossings((n + stretch - 1) / stretch);
    parallel_stretches(
        n,
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t f = begin; f < end; ++f)
            root_[f] = is_searched[labels_.ranks()[f]] ? join_before(f, begin, crossings[begin / stretch]) : none;
        },
        stretch);
    for (const auto& joined : crossings)
      for (const auto& [f, next] : joined) {
        const Index a = root_of(f), b = root_of(next);
        root_[std::max(a, b)] = std::min(a, b);
      }
  }

  /// Joins the regions of the neighbours of a face from `begin` on that come before it and have its label.
  /// \param crossings gets the neighbours before `begin`
  /// \returns the root of what was joined
  Index join_before(std::size_t face, std::size_t begin, std::vector<std::pair<Index, Index>>& crossings) {
    const std::vector<Index>& rank = labels_.ranks();
    const auto own = static_cast<Index>(face);
    Index root = own;
    for (const auto& [next, edge] : network_.graph.neighbours(own)) {
      if (next > own || rank[next] != rank[own] || !(network_.conductances[edge] > 0)) continue;
      if (next < begin) {
        crossings.emplace_back(own, next);
        continue;
      }
      const Index other = root_of(next);
      if (other == root) continue;
      if (root != own) root_[std::max(root, other)] = std::min(root, other);
      root = std::min(root, other);
    }
    return root;
  }

  /// Follows a face to the lowest of its region, and halves the way.
  Index root_of(Index face) {
    while (root_[face] != face && root_[face] != none) {
      if (const Index next = root_[root_[face]]; next != none) root_[face] = next;
      face = root_[face];
    }
    return root_[face] == none ? none : face;
  }

  /// The regions whose roots no seed has taken away, each with its faces ascending, the one with the lowest face first.
  void collect_islands() {
    std::unordered_map<Index, std::size_t> island_of;
    for (std::size_t f = 0; f < root_.size(); ++f) {
      if (root_[f] == none) continue;
      const Index root = root_[f] = root_[root_[f]];  // that of a lower face, which has been brought to its end
      if (root == none) continue;
      const auto [known, is_new] = island_of.try_emplace(root, islands_.size());
      if (is_new) islands_.emplace_back();
      islands_[known->second].push_back(static_cast<Index>(f));
      ++number_of_faces_;
    }
  }

  Index best_supported_neighbour(const std::vector<Index>& island, const std::vector<Index>& settled) const {
    double support = -1;
    Index rank = none;
    for (const Index face : island)
      for (const auto& [next, edge] : network_.graph.neighbours(face)) {
        if (settled[next] == none || !(network_.conductances[edge] > 0)) continue;
        const double largest = labels_.largest()[next];
        if (largest > support || (largest == support && settled[next] < rank)) {
          support = largest;
          rank = settled[next];
        }
      }
    return rank;
  }

  const Walk_network& network_;
  const Walk_labels& labels_;
  std::vector<Index> root_;  // by face: a lower one of its region, itself for the lowest, `none` where no island is
  std::vector<std::vector<Index>> islands_;
  std::size_t number_of_faces_ = 0;
};

}  // namespace RW_segmentation::internal

#endif
