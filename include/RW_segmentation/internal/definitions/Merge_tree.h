// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_MERGE_TREE_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_MERGE_TREE_H

#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace RW_segmentation {

RW_SEGMENTATION_INLINE std::vector<std::size_t> Merge_tree::segment_of_fragments(std::size_t number_of_segments) const {
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

RW_SEGMENTATION_INLINE std::vector<std::size_t> Merge_tree::levels(std::size_t chosen) const {
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

RW_SEGMENTATION_INLINE void Merge_tree::check_level(std::size_t number_of_segments) const {
  if (number_of_segments >= number_of_components() && number_of_segments <= number_of_fragments()) return;
  const std::string range = "from " + std::to_string(number_of_components()) + " (connected components) to " +
                            std::to_string(number_of_fragments()) + " (fragments); more seeds make more fragments";
  throw internal::argument_error("the number of segments", number_of_segments, range.c_str());
}

RW_SEGMENTATION_INLINE std::size_t Merge_tree::longest_level(std::size_t fewest, std::size_t most) const {
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

RW_SEGMENTATION_INLINE Cost_threshold_stop::Cost_threshold_stop(double threshold) : threshold_(threshold) {
  internal::require_cost("threshold", threshold);
}

RW_SEGMENTATION_INLINE std::size_t Cost_threshold_stop::operator()(const Merge_tree& tree) const {
  std::size_t segments = tree.number_of_fragments();
  for (const Merge_tree::Merge& merge : tree.merges()) {
    if (merge.cost > threshold_) break;
    --segments;
  }
  return segments;
}

RW_SEGMENTATION_INLINE Cost_jump_stop::Cost_jump_stop(double increase) : increase_(increase) {
  internal::require_cost("increase", increase);
}

RW_SEGMENTATION_INLINE std::size_t Cost_jump_stop::operator()(const Merge_tree& tree) const {
  std::size_t segments = tree.number_of_fragments();
  double highest = std::numeric_limits<double>::infinity();  // the first merge has none to jump from
  for (const Merge_tree::Merge& merge : tree.merges()) {
    if (merge.cost - highest >= increase_) break;
    highest = segments == tree.number_of_fragments() ? merge.cost : std::max(highest, merge.cost);
    --segments;
  }
  return segments;
}

namespace internal {

RW_SEGMENTATION_INLINE void require_cost(const char* argument, double cost) {
  if (std::isnan(cost)) throw argument_error(argument, cost, "a number");
}

RW_SEGMENTATION_INLINE Merge_tree side_by_side(const std::vector<Merge_tree>& trees) {
  struct Next {
    double dearest;           // of the merges of its tree up to this one
    std::size_t tree, merge;  // places
  };
  std::vector<Next> order;
  std::vector<std::size_t> first_fragment, first_merge;  // by tree
  std::size_t fragments = 0;
  for (std::size_t t = 0; t < trees.size(); ++t) {
    first_fragment.push_back(fragments);
    first_merge.push_back(order.size());
    fragments += trees[t].number_of_fragments();
    double dearest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < trees[t].merges().size(); ++i)
      order.push_back({dearest = std::max(dearest, trees[t].merges()[i].cost), t, i});
  }
  std::stable_sort(order.begin(), order.end(), [](const Next& a, const Next& b) { return a.dearest < b.dearest; });

  std::vector<std::size_t> region_of_merge(order.size());  // tree by tree
  std::vector<Merge_tree::Merge> merges;
  merges.reserve(order.size());
  for (const auto& [dearest, t, i] : order) {
    const auto region = [&, t = t](std::size_t of_tree) {
      const std::size_t own = trees[t].number_of_fragments();
      return of_tree < own ? first_fragment[t] + of_tree : region_of_merge[first_merge[t] + of_tree - own];
    };
    const auto& [first, second, cost] = trees[t].merges()[i];
    region_of_merge[first_merge[t] + i] = fragments + merges.size();
    merges.push_back({region(first), region(second), cost});
  }
  return {fragments, std::move(merges)};
}

}  // namespace internal
}  // namespace RW_segmentation

#endif
