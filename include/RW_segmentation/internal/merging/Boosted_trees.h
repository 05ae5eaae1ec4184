// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MERGING_BOOSTED_TREES_H
#define RW_SEGMENTATION_INTERNAL_MERGING_BOOSTED_TREES_H

#include <array>
#include <cstddef>
#include <cstdint>

namespace RW_segmentation::internal {

/// A decision tree with up to six leaves.
struct Decision_tree {
  static constexpr std::size_t most_leaves = 6;

  /// A question: is a feature at most the threshold? The root is the first one. A child -1 - k is leaf k.
  struct Split {
    std::uint8_t feature;
    double threshold;
    std::int16_t yes, no;
  };

  std::array<Split, most_leaves - 1> splits;
  std::array<double, most_leaves> leaves;

  template <class Features>
  double operator()(const Features& features) const {
    int node = 0;
    while (node >= 0) {
      const Split& split = splits[static_cast<std::size_t>(node)];
      node = features[split.feature] <= split.threshold ? split.yes : split.no;
    }
    return leaves[static_cast<std::size_t>(-1 - node)];
  }
};

/// A sum of decision trees, which are not copied.
struct Boosted_trees {
  const Decision_tree* trees;
  std::size_t number_of_trees;

  template <class Features>
  double operator()(const Features& features) const {
    double sum = 0;
    for (std::size_t t = 0; t < number_of_trees; ++t) sum += trees[t](features);
    return sum;
  }
};

/// The logarithm of the odds that people leave two regions in one segment, as learned from what people did.
const Boosted_trees& learned_trees();

}  // namespace RW_segmentation::internal

#endif
