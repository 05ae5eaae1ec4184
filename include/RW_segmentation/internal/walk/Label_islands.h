// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_LABEL_ISLANDS_H
#define RW_SEGMENTATION_INTERNAL_WALK_LABEL_ISLANDS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/walk/Seed_set.h>
#include <RW_segmentation/internal/walk/Walk_labels.h>
#include <RW_segmentation/internal/walk/Walk_network.h>

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
      : network_(network), labels_(labels) {
    const std::vector<Index>& rank = labels.ranks();
    std::vector<char> is_searched(labels.number_of_labels(), 0);
    for (std::size_t l = 0; l < labels.number_of_seed_labels(); ++l) is_searched[l] = !is_connected[l];
    const auto regions = Components::over_neighbours(network.graph, [&](Index face, Index next, Index edge) {
      return is_searched[rank[face]] && rank[next] == rank[face] && network.conducts(edge);
    });
    std::vector<char> has_seed(regions.count, 0);
    for (const auto& seed : seeds.seeds()) has_seed[regions.of[seed.face]] = 1;
    std::unordered_map<Index, std::size_t> island_of;  // by region
    for (std::size_t f = 0; f < rank.size(); ++f) {
      if (!is_searched[rank[f]] || has_seed[regions.of[f]]) continue;
      const auto [known, is_new] = island_of.try_emplace(regions.of[f], islands_.size());
      if (is_new) islands_.emplace_back();
      islands_[known->second].push_back(static_cast<Index>(f));
      ++number_of_faces_;
    }
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
  Index best_supported_neighbour(const std::vector<Index>& island, const std::vector<Index>& settled) const {
    double support = -1;
    Index rank = none;
    for (const Index face : island)
      for (const auto& [next, edge] : network_.graph.neighbours(face)) {
        if (settled[next] == none || !network_.conducts(edge)) continue;
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
  std::vector<std::vector<Index>> islands_;
  std::size_t number_of_faces_ = 0;
};

}  // namespace RW_segmentation::internal

#endif
