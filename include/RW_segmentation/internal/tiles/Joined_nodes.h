// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_TILES_JOINED_NODES_H
#define RW_SEGMENTATION_INTERNAL_TILES_JOINED_NODES_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/check_number.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The nodes of all tiles, numbered one tile after the other.
class Joined_nodes {
 public:
  using Index = Dual_graph::Index;

  /// \param number_of_nodes a function from what a tile gives to the number of its nodes
  template <class OfTile, class NumberOfNodes>
  Joined_nodes(const std::vector<OfTile>& tiles, const NumberOfNodes& number_of_nodes) {
    for (const OfTile& tile : tiles) first_.push_back(first_.back() + number_of_nodes(tile));
    check_number(first_.back(), "clusters");
  }

  std::size_t count() const { return first_.back(); }
  Index operator()(std::size_t tile, Index place) const { return static_cast<Index>(first_[tile] + place); }
  std::pair<Index, Index> tile_and_place(Index node) const {
    const auto behind = std::upper_bound(first_.begin(), first_.end(), std::size_t(node));
    const auto tile = static_cast<std::size_t>(behind - first_.begin()) - 1;
    return {static_cast<Index>(tile), static_cast<Index>(node - first_[tile])};
  }

  /// Calls `use(owner, node of it, other, node of it)` for each side between two tiles that both know, in the order of the
  /// sides.
  /// \param tiles with the `sides` of each
  template <class OfTile, class Use>
  void for_each_side(const std::vector<OfTile>& tiles, const Use& use) const {
    using Side = typename decltype(OfTile::sides)::value_type;
    struct Entry {
      const Side* side;
      Index tile;
    };
    std::vector<Entry> entries;
    for (std::size_t t = 0; t < tiles.size(); ++t)
      for (const Side& side : tiles[t].sides) entries.push_back({&side, static_cast<Index>(t)});
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return std::tuple(a.side->side, !a.side->is_owner, a.tile) < std::tuple(b.side->side, !b.side->is_owner, b.tile);
    });
    for (std::size_t i = 1; i < entries.size(); ++i) {
      const Entry &a = entries[i - 1], &b = entries[i];
      if (a.side->side != b.side->side || !a.side->is_owner || b.side->is_owner) continue;
      use(*a.side, (*this)(a.tile, a.side->node), *b.side, (*this)(b.tile, b.side->node));
    }
  }

 private:
  std::vector<std::size_t> first_ = {0};  // by tile
};

}  // namespace RW_segmentation::internal

#endif
