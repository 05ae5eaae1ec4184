// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_TILE_SEGMENTS_H
#define SEGMENT_MESH_TILES_TILE_SEGMENTS_H

#include "../segment_colors.h"
#include "Tile_folder.h"

#include <RW_segmentation/Merge_tree.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace segment_mesh {

/// What merging leaves: the segments of all tiles, and the levels that there are.
struct Tile_segments {
  std::vector<std::uint64_t> of_fragment;
  std::vector<double> area;                                ///< by segment, as a part of the whole
  std::vector<std::array<std::uint8_t, 3>> colors;         ///< likewise
  std::vector<std::vector<RW::Dual_mesh::Index>> numbers;  ///< of fragments, by tile and what it calls them; or empty
  std::vector<RW::Merge_tree::Merge> merges;
  std::uint64_t suggested = 0;   ///< segments by the shape
  std::uint64_t components = 0;  ///< connected parts of the whole
  std::uint64_t turned_sides = 0;
  std::uint64_t walls = 0;  ///< edges that are

  RW::Merge_tree tree() const { return {of_fragment.size(), merges}; }

  /// The segment of a face.
  std::size_t segment(std::size_t tile, RW::Dual_mesh::Index fragment) const {
    return of_fragment.at(numbers.empty() ? fragment : numbers.at(tile).at(fragment));
  }
};

template <class Archive>
void transfer(Archive& a, Tile_segments& x) {
  a(x.of_fragment);
  a(x.area);
  a(x.colors);
  a(x.numbers);
  a(x.merges);
  a(x.suggested);
  a(x.components);
  a(x.turned_sides);
  a(x.walls);
}

/// The segments at a level of a tree.
/// \param areas of the fragments
/// \param neighbours pairs of fragments
inline Tile_segments tile_segments(const RW::Merge_tree& tree, std::size_t number, const std::vector<double>& areas,
                                   const std::vector<std::array<RW::Dual_mesh::Index, 2>>& neighbours) {
  const std::vector<std::size_t> segment = tree.segment_of_fragments(number);
  Tile_segments result;
  result.of_fragment.assign(segment.begin(), segment.end());
  result.merges = tree.merges();
  result.components = tree.number_of_components();
  result.area.resize(number, 0.);
  for (std::size_t fragment = 0; fragment < areas.size(); ++fragment) result.area[segment[fragment]] += areas[fragment];
  std::vector<std::set<std::size_t>> around(number);
  for (const auto& [a, b] : neighbours) {
    if (segment[a] == segment[b]) continue;
    around[segment[a]].insert(segment[b]);
    around[segment[b]].insert(segment[a]);
  }
  std::vector<std::vector<std::size_t>> lists;
  for (const auto& of_segment : around) lists.emplace_back(of_segment.begin(), of_segment.end());
  result.colors = segment_colors(lists);
  return result;
}

}  // namespace segment_mesh

#endif
