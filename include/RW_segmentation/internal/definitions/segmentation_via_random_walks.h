// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENTATION_VIA_RANDOM_WALKS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENTATION_VIA_RANDOM_WALKS_H

#include <RW_segmentation/segmentation_via_random_walks.h>

#include <utility>
#include <vector>

namespace RW_segmentation::internal {

template <class ConcurrencyTag>
Merged_fragments segment_by_automatic_policies(const Dual_mesh& mesh, const Automatic_policies& policies,
                                               const std::vector<Dual_mesh::Index>& given, const Progress& progress,
                                               Segmentation_report report) {
  return segment_by_policies<ConcurrencyTag>(mesh, policies, given, progress, std::move(report));
}

}  // namespace RW_segmentation::internal

#endif
