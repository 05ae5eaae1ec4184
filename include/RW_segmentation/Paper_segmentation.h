// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_PAPER_SEGMENTATION_H
#define RW_SEGMENTATION_PAPER_SEGMENTATION_H

#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/Particle_sampling.h>
#include <RW_segmentation/Relative_boundary_cost.h>
#include <RW_segmentation/Segmentation_policies.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/coarse_seeds.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <cstddef>

namespace RW_segmentation {

namespace internal {

using Paper_policies = Segmentation_policies<Dihedral_difference_policy, Feature_sensitive_seeding<Particle_sampling>,
                                             Star_mesh_elimination, Relative_boundary_cost, Any_stop>;
using Coarse_paper_policies =
    Segmentation_policies<Dihedral_difference_policy, Coarse_seeding<Separation_decrease_stop>, Star_mesh_elimination,
                          Relative_boundary_cost, Any_stop>;

/// Normals as they are.
inline Normal_smoothing no_smoothing() {
  Normal_smoothing none;
  none.radius = 0;
  return none;
}

}  // namespace internal

/// The paper's own policies: the difference of the faces' own normals with convex weight 0.2 (Eq. 4-5), conductances with
/// sigma 1 (Eq. 6), seeds by particles in the feature-sensitive metric (4.2.1), and merging by `Relative_boundary_cost`
/// (Eq. 10) until the cost exceeds 0.5.
struct Paper_segmentation : internal::Paper_policies {
  /// As many segments as Eq. 10 leaves.
  Paper_segmentation()
      : internal::Paper_policies{internal::no_smoothing(), {}, 1, 20, {60, {}}, {}, {}, {}, Cost_threshold_stop(0.5)} {}

  /// As many segments as that, at least one for each connected component.
  explicit Paper_segmentation(std::size_t segments) : Paper_segmentation() {
    seeding.count = internal::seeds_for(segments, seeding.count);
    stop = Segment_count_stop(segments);
  }
};

/// The paper's coarse variant (4.1): a seed for each large structure by Dijkstra's algorithm (Eq. 9), each of them a
/// segment.
struct Coarse_paper_segmentation : internal::Coarse_paper_policies {
  /// As many segments as seeds.
  Coarse_paper_segmentation()
      : internal::Coarse_paper_policies{
            internal::no_smoothing(), {}, 1, 20, {Separation_decrease_stop()}, {}, {}, {}, [](const Merge_tree& tree) {
              return tree.number_of_fragments();
            }} {}
};

}  // namespace RW_segmentation

#endif
