// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENTATION_VIA_RANDOM_WALKS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENTATION_VIA_RANDOM_WALKS_H

#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE Merged_fragments::Merged_fragments() = default;
RW_SEGMENTATION_INLINE Merged_fragments::Merged_fragments(Merged_fragments&&) noexcept = default;
RW_SEGMENTATION_INLINE Merged_fragments& Merged_fragments::operator=(Merged_fragments&&) noexcept = default;
RW_SEGMENTATION_INLINE Merged_fragments::~Merged_fragments() = default;

RW_SEGMENTATION_INLINE std::vector<std::size_t> segment_of_faces(const Merged_fragments& merged,
                                                                 std::size_t number_of_segments) {
  const std::vector<std::size_t> segment_of_fragment = merged.tree.segment_of_fragments(number_of_segments);
  std::vector<std::size_t> segment_of_face;
  segment_of_face.reserve(merged.fragment_of_face.size());
  for (const std::size_t fragment : merged.fragment_of_face) segment_of_face.push_back(segment_of_fragment[fragment]);
  return segment_of_face;
}

RW_SEGMENTATION_INLINE void require_seedings(std::size_t seedings) {
  if (seedings == 0) throw argument_error("seedings", seedings, "at least 1");
}

template <class ConcurrencyTag>
Merged_fragments segment_by_automatic_policies(const Dual_mesh& mesh, const Automatic_policies& policies,
                                               const std::vector<Dual_mesh::Index>& given, const Progress& progress,
                                               Stage_clock::Time begin) {
  return segment_by_policies<ConcurrencyTag>(mesh, policies, given, progress, begin);
}

}  // namespace RW_segmentation::internal

#endif
