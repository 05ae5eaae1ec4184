// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_RANK_LABELS_H
#define RW_SEGMENTATION_INTERNAL_RANK_LABELS_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

/// Numbers different labels from 0 in ascending order.
/// \param rank output, the number of each label
/// \returns the labels by their numbers
template <class Label>
std::vector<Label> rank_labels(const std::vector<Label>& labels, std::vector<std::size_t>& rank) {
  std::vector<Label> sorted = labels;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  rank.clear();
  for (const Label& label : labels)
    rank.push_back(static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), label) - sorted.begin()));
  return sorted;
}

}  // namespace RW_segmentation::internal

#endif
