// SPDX-License-Identifier: MIT

// Seeds, walks and what is merged.

#include "for_each_concurrency.h"

#include <RW_segmentation/internal/definitions/Any_walk_solver.h>
#include <RW_segmentation/internal/definitions/Common_refinement.h>
#include <RW_segmentation/internal/definitions/Consensus_cost.h>
#include <RW_segmentation/internal/definitions/Graph_walk.h>
#include <RW_segmentation/internal/definitions/Learned_cost.h>
#include <RW_segmentation/internal/definitions/Merge_queue.h>
#include <RW_segmentation/internal/definitions/Merge_tree.h>
#include <RW_segmentation/internal/definitions/Particle_sampling.h>
#include <RW_segmentation/internal/definitions/Seeded_walk.h>
#include <RW_segmentation/internal/definitions/Segmentation_policies.h>
#include <RW_segmentation/internal/definitions/Segmentation_report.h>
#include <RW_segmentation/internal/definitions/Size_aware_cost.h>
#include <RW_segmentation/internal/definitions/Star_mesh_elimination.h>
#include <RW_segmentation/internal/definitions/Walk_reduction.h>
#include <RW_segmentation/internal/definitions/coarse_seeds.h>
#include <RW_segmentation/internal/definitions/feature_sensitive_seeds.h>
#include <RW_segmentation/internal/definitions/further_seedings.h>
#include <RW_segmentation/internal/definitions/read_seeds.h>
#include <RW_segmentation/internal/definitions/region_boundaries.h>
#include <RW_segmentation/internal/definitions/segmentation_via_random_walks.h>
#include <RW_segmentation/internal/definitions/transfer_segments.h>
#include <RW_segmentation/internal/definitions/walk_fragments.h>

namespace RW_segmentation::internal {

#define RW_SEGMENTATION_INSTANTIATE(ConcurrencyTag)                                                                    \
  template Merged_fragments segment_by_automatic_policies<ConcurrencyTag>(const Dual_mesh&, const Automatic_policies&, \
                                                                          const std::vector<Dual_mesh::Index>&,        \
                                                                          const Progress&, Stage_clock::Time);
RW_SEGMENTATION_FOR_EACH_CONCURRENCY(RW_SEGMENTATION_INSTANTIATE)
#undef RW_SEGMENTATION_INSTANTIATE

}  // namespace RW_segmentation::internal
