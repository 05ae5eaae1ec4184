// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENTATION_POLICIES_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENTATION_POLICIES_H

#include <RW_segmentation/Segmentation_policies.h>
#include <RW_segmentation/internal/compiled.h>

#include <cstddef>
#include <vector>

namespace RW_segmentation {

RW_SEGMENTATION_INLINE Size_aware_cost Size_aware_cost_policy::operator()(const Dual_mesh& mesh) const {
  return Size_aware_cost(
      thickness.samples == 0 ? std::vector<double>() : internal::thickness_of_faces(mesh, thickness, {}),
      internal::crease_weight(mesh.number_of_edges()));
}

RW_SEGMENTATION_INLINE Learned_cost Learned_cost_policy::operator()(const Dual_mesh& mesh) const {
  return Learned_cost(
      mesh, thickness.samples == 0 ? std::vector<double>() : internal::thickness_of_faces(mesh, thickness, {}));
}

RW_SEGMENTATION_INLINE Automatic_segmentation::Automatic_segmentation()
    : internal::Automatic_policies{{}, smoothed_concavity(),   1, 20,  {40, {}}, {}, {},
                                   {}, Cost_threshold_stop(1), 2, true} {
  concurrent_components = true;
}

RW_SEGMENTATION_INLINE Automatic_segmentation::Automatic_segmentation(std::size_t segments) : Automatic_segmentation() {
  seeding.count = internal::seeds_for(segments, seeding.count);
  stop = Segment_count_stop(segments);
}

}  // namespace RW_segmentation

#endif
