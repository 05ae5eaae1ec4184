// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_SEEDED_COMPONENTS_H
#define RW_SEGMENTATION_INTERNAL_WALK_SEEDED_COMPONENTS_H

#include <RW_segmentation/internal/walk/Seed_set.h>
#include <RW_segmentation/internal/walk/Walk_network.h>

#include <vector>

namespace RW_segmentation::internal {

/// By component: whether it holds a seed.
inline std::vector<char> seeded_components(const Walk_network& network, const Seed_set& seeds) {
  std::vector<char> seeded(network.component.count, 0);
  for (const auto& seed : seeds.seeds()) seeded[network.component.of[seed.face]] = 1;
  return seeded;
}

}  // namespace RW_segmentation::internal

#endif
