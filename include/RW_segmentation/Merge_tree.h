// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_MERGE_TREE_H
#define RW_SEGMENTATION_MERGE_TREE_H

#include <RW_segmentation/internal/Argument_error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
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
  std::vector<std::size_t> segment_of_fragments(std::size_t number_of_segments) const {
    check_level(number_of_segments);
    std::vector<std::size_t> root(2 * number_of_fragments() - number_of_segments);
    std::iota(root.begin(), root.end(), std::size_t(0));
    for (std::size_t region = root.size(); region-- > number_of_fragments();) {
      const Merge& merge = merges_[region - number_of_fragments()];
      root[merge.first] = root[merge.second] = root[region];
    }

    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> segment_of_root(root.size(), none), segment(number_of_fragments());
    std::size_t segments = 0;
    for (std::size_t fragment = 0; fragment < segment.size(); ++fragment) {
      std::size_t& id = segment_of_root[root[fragment]];
      if (id == none) id = segments++;
      segment[fragment] = id;
    }
    return segment;
  }

  /// The numbers of segments that people may prefer: a given one, a coarser and a finer one. People agree on where to
  /// cut more than on how far to go. The coarser one has from half to 1 / 1.4 times as many segments, at least 2, the
  /// finer one from 1.4 times to twice as many: each is the one of these levels that lasts longest, whose next merge
  /// costs the most times what the merges before it did. Where there are none, that level is left out.
  /// Complexity: linear in the number of fragments.
  /// \param chosen a number of segments, such as that of a stop predicate
  /// \returns one to three numbers, rising
  /// \throws std::invalid_argument if there are more components or fewer fragments than `chosen`
  std::vector<std::size_t> levels(std::size_t chosen) const {
    check_level(chosen);
    // Of `benchmark_princeton --method levels`: the best of three levels for each person disagrees with it by .077, the
    // chosen one alone by .094; farthest / nearest of 1.6 to 3 / 1 to 1.6 give .077 to .088.
    constexpr double farthest = 2, nearest = 1.4;  // times the number
    const auto number = static_cast<double>(chosen);
    const auto rounded = [](double x) { return static_cast<std::size_t>(x); };
    std::vector<std::size_t> numbers;
    const auto append = [&](std::size_t fewest, std::size_t most) {
      fewest = std::max({fewest, number_of_components(), std::size_t(2)});
      most = std::min(most, number_of_fragments());
      if (fewest <= most) numbers.push_back(longest_level(fewest, most));
    };
    append(rounded(std::ceil(number / farthest)), rounded(number / nearest));
    numbers.push_back(chosen);
    append(rounded(std::ceil(number * nearest)), rounded(number * farthest));
    return numbers;
  }

 private:
  /// \throws std::invalid_argument
  void check_level(std::size_t number_of_segments) const {
    if (number_of_segments >= number_of_components() && number_of_segments <= number_of_fragments()) return;
    const std::string range = "from " + std::to_string(number_of_components()) + " (connected components) to " +
                              std::to_string(number_of_fragments()) + " (fragments); more seeds make more fragments";
    throw internal::argument_error("the number of segments", number_of_segments, range.c_str());
  }

  /// Of the levels with `fewest` to `most` segments the one that lasts longest, see `levels()`. That of the connected
  /// components, which no merge ends, lasts for ever.
  std::size_t longest_level(std::size_t fewest, std::size_t most) const {
    double highest = std::numeric_limits<double>::min(), longest = -1;
    if (!merges_.empty()) highest = std::max(highest, merges_.front().cost);
    std::size_t level = most;
    for (std::size_t n = number_of_fragments(); n >= fewest; --n) {
      const std::size_t next = number_of_fragments() - n;
      const double duration =
          next < merges_.size() ? merges_[next].cost / highest : std::numeric_limits<double>::infinity();
      if (n <= most && duration > longest) {
        longest = duration;
        level = n;
      }
      if (next < merges_.size()) highest = std::max(highest, merges_[next].cost);
    }
    return level;
  }

  std::size_t number_of_fragments_ = 0;
  std::vector<Merge> merges_;
};

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
  explicit Cost_threshold_stop(double threshold) : threshold_(threshold) {}

  /// The number of segments to stop at.
  std::size_t operator()(const Merge_tree& tree) const {
    std::size_t segments = tree.number_of_fragments();
    for (const Merge_tree::Merge& merge : tree.merges()) {
      if (merge.cost > threshold_) break;
      --segments;
    }
    return segments;
  }

 private:
  double threshold_;
};

/// Stops before the first merge that costs significantly more than every merge before it; a model of `StopPredicate`.
class Cost_jump_stop {
 public:
  /// \param increase the least rise of the cost above the highest one so far that counts as a jump
  explicit Cost_jump_stop(double increase) : increase_(increase) {}

  /// The number of segments to stop at.
  std::size_t operator()(const Merge_tree& tree) const {
    std::size_t segments = tree.number_of_fragments();
    double highest = std::numeric_limits<double>::infinity();  // the first merge has none to jump from
    for (const Merge_tree::Merge& merge : tree.merges()) {
      if (merge.cost - highest >= increase_) break;
      highest = segments == tree.number_of_fragments() ? merge.cost : std::max(highest, merge.cost);
      --segments;
    }
    return segments;
  }

 private:
  double increase_;
};

}  // namespace RW_segmentation

#endif
