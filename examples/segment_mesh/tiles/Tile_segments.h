// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_TILE_SEGMENTS_H
#define SEGMENT_MESH_TILES_TILE_SEGMENTS_H

#include "../Options.h"
#include "../report.h"
#include "../segment_colors.h"
#include "Tile_folder.h"

#include <RW_segmentation/Merge_tree.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace segment_mesh {

/// What the numbers of fragments of a piece stand for.
struct Piece_fragments {
  std::uint64_t first = 0;                 ///< fragment of its part
  std::vector<RW::Dual_mesh::Index> part;  ///< numbers in its part, by its own; empty where these are the same
};

/// What merging leaves: the segments of all tiles, and the levels that there are.
struct Tile_segments {
  std::vector<std::uint64_t> of_fragment;
  std::vector<double> area;                          ///< by segment, as a part of the whole
  std::vector<std::array<std::uint8_t, 3>> colors;   ///< likewise
  std::vector<std::vector<Piece_fragments>> pieces;  ///< by tile and piece
  std::vector<RW::Merge_tree::Merge> merges;
  std::uint64_t suggested = 0;   ///< segments by the shape
  std::uint64_t components = 0;  ///< connected parts of the whole
  std::uint64_t turned_sides = 0;
  std::uint64_t walls = 0;  ///< edges that are

  RW::Merge_tree tree() const { return {of_fragment.size(), merges}; }

  /// The segment of a fragment of a piece.
  std::size_t segment(std::size_t tile, std::size_t piece, RW::Dual_mesh::Index fragment) const {
    const auto& [first, part] = pieces.at(tile).at(piece);
    return of_fragment.at(first + (part.empty() ? fragment : part.at(fragment)));
  }
};

template <class Archive>
void transfer(Archive& a, Piece_fragments& x) {
  a(x.first);
  a(x.part);
}

template <class Archive>
void transfer(Archive& a, Tile_segments& x) {
  a(x.of_fragment);
  a(x.area);
  a(x.colors);
  a(x.pieces);
  a(x.merges);
  a(x.suggested);
  a(x.components);
  a(x.turned_sides);
  a(x.walls);
}

/// What the steps from `merge` on depend on, in words.
inline std::string merging_in_words(const Options& options) {
  const auto value = [](const auto& given) { return given ? Json(*given) : Json(nullptr); };
  return Json({{"segments", value(options.segments)},
               {"regular", options.is_regular},
               {"regular_length", value(options.regular_length)},
               {"regular_angle", value(options.regular_angle)}})
      .dump();
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

/// Puts the fragments of all parts together.
class Merged_parts {
 public:
  using Index = RW::Dual_mesh::Index;

  /// Keeps a reference to the parts.
  explicit Merged_parts(const RW::Tile_parts& parts) : parts_(parts) {
    for (const auto& part : parts.parts) area_ += part.area;
    for (const auto& of_tile : parts.places) pieces_.emplace_back(of_tile.size());
  }

  /// Begins with the next part.
  void add_part(RW::Merge_tree tree) {
    const auto& part = parts_.parts[trees_.size()];
    first_ = areas_.size();
    areas_.resize(first_ + tree.number_of_fragments(), 0.);
    share_ = area_ > 0 ? part.area / area_ : 0;
    for (const auto& [tile, place] : part.pieces) pieces_[tile][place].first = first_;
    trees_.push_back(std::move(tree));
  }

  /// \param share of the part
  void add_area(Index fragment, double share) { areas_[first_ + fragment] += share * share_; }

  /// \param neighbours pairs of fragments of the part
  void add_neighbours(const std::vector<std::array<Index, 2>>& neighbours) {
    for (const auto& [a, b] : neighbours)
      neighbours_.push_back({static_cast<Index>(first_ + a), static_cast<Index>(first_ + b)});
  }

  /// \param numbers of fragments in the part, by those of a piece
  void set_numbers(RW::Tile_parts::Piece piece, std::vector<Index> numbers) {
    pieces_[piece.tile][piece.place].part = std::move(numbers);
  }

  RW::Merge_tree tree() const { return RW::internal::side_by_side(trees_); }

  /// The segments at a level of that tree.
  Tile_segments segments(const RW::Merge_tree& tree, std::size_t number) const {
    Tile_segments result = tile_segments(tree, number, areas_, neighbours_);
    result.pieces = pieces_;
    return result;
  }

 private:
  const RW::Tile_parts& parts_;
  double area_ = 0;            // of all parts
  std::size_t first_ = 0;      // fragment of the part
  double share_ = 0;           // of the part
  std::vector<double> areas_;  // of fragments
  std::vector<RW::Merge_tree> trees_;
  std::vector<std::array<Index, 2>> neighbours_;
  std::vector<std::vector<Piece_fragments>> pieces_;
};

}  // namespace segment_mesh

#endif
