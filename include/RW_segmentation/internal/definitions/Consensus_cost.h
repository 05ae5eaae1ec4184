// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_CONSENSUS_COST_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_CONSENSUS_COST_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/merging/Consensus_cost.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE Seeding_agreement::Seeding_agreement(const std::vector<Merge_tree>& trees) {
  for (const Merge_tree& tree : trees) {
    const std::size_t fragments = tree.number_of_fragments();
    std::vector<float> agreement(fragments * fragments, 0);  // of those that nothing joins
    std::vector<std::vector<std::size_t>> members(fragments);
    for (std::size_t i = 0; i < fragments; ++i) {
      members[i] = {i};
      agreement[i * fragments + i] = 1;
    }
    double highest = 0;  // cost so far: merging stops before the first one that is too high
    for (const Merge_tree::Merge& merge : tree.merges()) {
      highest = std::max(highest, merge.cost);
      const auto of_merge = static_cast<float>(1 / (1 + highest * highest));
      for (const std::size_t i : members[merge.first])
        for (const std::size_t j : members[merge.second])
          agreement[i * fragments + j] = agreement[j * fragments + i] = of_merge;
      std::vector<std::size_t> joined = std::move(members[merge.first]);
      joined.insert(joined.end(), members[merge.second].begin(), members[merge.second].end());
      members[merge.second].clear();
      members.push_back(std::move(joined));
    }
    agreement_.push_back(std::move(agreement));
    fragments_.push_back(fragments);
  }
}

RW_SEGMENTATION_INLINE Seeding_agreement::Region Seeding_agreement::region(const std::vector<std::size_t>& fragments,
                                                                           double weight) {
  Region region;
  region.reserve(fragments.size());
  for (const std::size_t fragment : fragments) region.push_back({{fragment, weight}});
  return region;
}

RW_SEGMENTATION_INLINE void Seeding_agreement::join(Region& region, const Region& other) {
  for (std::size_t k = 0; k < region.size(); ++k) {
    std::vector<Share> joined;
    joined.reserve(region[k].size() + other[k].size());
    std::merge(region[k].begin(), region[k].end(), other[k].begin(), other[k].end(), std::back_inserter(joined),
               [](const Share& a, const Share& b) { return a.fragment < b.fragment; });
    region[k].clear();
    for (const Share& share : joined) {
      if (!region[k].empty() && region[k].back().fragment == share.fragment)
        region[k].back().weight += share.weight;
      else
        region[k].push_back(share);
    }
  }
}

RW_SEGMENTATION_INLINE double Seeding_agreement::operator()(const Region& a, const Region& b) const {
  double sum = 0, weight_of_a = 0, weight_of_b = 0;
  for (const Share& share : a.front()) weight_of_a += share.weight;
  for (const Share& share : b.front()) weight_of_b += share.weight;
  for (std::size_t k = 0; k < agreement_.size(); ++k)
    for (const Share& in_a : a[k]) {
      const float* agreement = &agreement_[k][in_a.fragment * fragments_[k]];
      double of_share = 0;
      for (const Share& in_b : b[k]) of_share += in_b.weight * static_cast<double>(agreement[in_b.fragment]);
      sum += in_a.weight * of_share;
    }
  return sum / (weight_of_a * weight_of_b * static_cast<double>(agreement_.size()));
}

}  // namespace RW_segmentation::internal

#endif
