// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_MERGE_TREE_H
#define RW_SEGMENTATION_MERGE_TREE_H

#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// A sequence of merges, from fragments to one segment for each connected component.
///
/// Regions are numbered: first the fragments, 0 .. `number_of_fragments()` - 1, then each region that a merge makes.
class Merge_tree {
 public:
  /// Two regions that become one.
  struct Merge {
    std::size_t first;   ///< a region
    std::size_t second;  ///< the other region, of a higher number
    double cost;         ///< of this merge; costs need not rise from merge to merge
  };

  Merge_tree() = default;

  /// \param merges in their order; merge i makes region `number_of_fragments` + i
  Merge_tree(std::size_t number_of_fragments, std::vector<Merge> merges)
      : number_of_fragments_(number_of_fragments), merges_(std::move(merges)) {}

  /// Regions before the first merge.
  std::size_t number_of_fragments() const { return number_of_fragments_; }
  /// Regions after the last merge.
  std::size_t number_of_components() const { return number_of_fragments_ - merges_.size(); }
  /// All merges in their order.
  const std::vector<Merge>& merges() const { return merges_; }

  /// The segment of each fragment when merging stops at a number of segments. Segments are numbered from 0 in the
  /// order of their lowest fragments. Levels are nested: each segment is a union of segments of any level with more.
  /// Complexity: linear in the number of fragments.
  /// \throws std::invalid_argument if there are more components or fewer fragments than `number_of_segments`
  std::vector<std::size_t> segment_of_fragments(std::size_t number_of_segments) const;

  /// The numbers of segments that people may prefer: a given one, a coarser and a finer one. People agree on where to
  /// cut more than on how far to go. The coarser one has from half to 1 / 1.4 times as many segments, at least 2, the
  /// finer one from 1.4 times to twice as many: each is the one of these levels that lasts longest, whose next merge
  /// costs the most times what the merges before it did. Where there are none, that level is left out.
  /// Complexity: linear in the number of fragments.
  /// \param chosen a number of segments, such as that of a stop predicate
  /// \returns one to three numbers, rising
  /// \throws std::invalid_argument if there are more components or fewer fragments than `chosen`
  std::vector<std::size_t> levels(std::size_t chosen) const;

 private:
  /// \throws std::invalid_argument
  void check_level(std::size_t number_of_segments) const;

  /// Of the levels with `fewest` to `most` segments the one that lasts longest, see `levels()`. That of the connected
  /// components, which no merge ends, lasts for ever.
  std::size_t longest_level(std::size_t fewest, std::size_t most) const;

  std::size_t number_of_fragments_ = 0;
  std::vector<Merge> merges_;
};

namespace internal {

/// Refuses a cost that nothing is larger or smaller than.
/// \throws std::invalid_argument naming the argument
void require_cost(const char* argument, double cost);

}  // namespace internal

/// Stops at exactly so many segments; a model of `StopPredicate`.
class Segment_count_stop {
 public:
  /// Stops at `number_of_segments`.
  explicit Segment_count_stop(std::size_t number_of_segments) : number_of_segments_(number_of_segments) {}

  /// That number, whatever the tree.
  std::size_t operator()(const Merge_tree&) const { return number_of_segments_; }

 private:
  std::size_t number_of_segments_;
};

/// Stops before the first merge that costs more than a threshold; a model of `StopPredicate`.
class Cost_threshold_stop {
 public:
  /// \param threshold the largest cost of a merge
  /// \throws std::invalid_argument if it is NaN
  explicit Cost_threshold_stop(double threshold);

  /// The number of segments to stop at.
  std::size_t operator()(const Merge_tree& tree) const;

 private:
  double threshold_;
};

/// Stops before the first merge that costs significantly more than every merge before it; a model of `StopPredicate`.
class Cost_jump_stop {
 public:
  /// \param increase the least rise of the cost above the highest one so far that counts as a jump
  /// \throws std::invalid_argument if it is NaN
  explicit Cost_jump_stop(double increase);

  /// The number of segments to stop at.
  std::size_t operator()(const Merge_tree& tree) const;

 private:
  double increase_;
};

namespace internal {

/// The trees of several meshes as one, their fragments one mesh after the other. Merges of the least cost come first; one
/// that costs less than those before it in its own tree comes with the dearest of them. So whatever stops at a cost takes
/// from each tree what it takes from that alone.
/// Complexity: O(m log m) for m merges.
Merge_tree side_by_side(const std::vector<Merge_tree>& trees);

}  // namespace internal
}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Merge_tree.h>
#endif

#endif
