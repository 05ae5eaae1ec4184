// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_LABEL_ISLANDS_H
#define RW_SEGMENTATION_INTERNAL_WALK_LABEL_ISLANDS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/walk/Seed_set.h>
#include <RW_segmentation/internal/walk/Walk_labels.h>
#include <RW_segmentation/internal/walk/Walk_network.h>

#include <cmath>
#include <cstddef>
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
      : network_(network), labels_(labels), unreached_(labels.ranks()) {
    for (Index& rank : unreached_)
      if (is_connected[rank]) rank = none;
    for (const auto& seed : seeds.seeds())
      if (unreached_[seed.face] != none) reached_from(seed.face);
    for (std::size_t f = 0; f < unreached_.size(); ++f) {
      if (unreached_[f] == none || unreached_[f] >= labels.number_of_seed_labels()) continue;
      islands_.push_back(reached_from(static_cast<Index>(f)));
      number_of_faces_ += islands_.back().size();
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
  /// The region of a face, whose faces count as reached from then on.
  std::vector<Index> reached_from(Index start) {
    const Index rank = std::exchange(unreached_[start], none);
    std::vector<Index> region = {start};
    for (std::size_t i = 0; i < region.size(); ++i)
      for (const auto& [next, edge] : network_.graph.neighbours(region[i]))
        if (unreached_[next] == rank && network_.conductances[edge] > 0) {
          unreached_[next] = none;
          region.push_back(next);
        }
    return region;
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
  std::vector<Index> unreached_;  // by face: the rank of its label, `none` once reached
  std::vector<std::vector<Index>> islands_;
  std::size_t number_of_faces_ = 0;
};

}  // namespace RW_segmentation::internal

#endif
