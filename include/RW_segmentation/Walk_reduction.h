// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_WALK_REDUCTION_H
#define RW_SEGMENTATION_WALK_REDUCTION_H

#include <cstddef>

namespace RW_segmentation {

/// How the walk on a large mesh is reduced (section 3.2 of the paper): walks from the seeds run over clusters of faces, and
/// then once more over the faces along the boundaries.
///
/// Normals, differences, thickness and merging are those of the faces in any case. Clusters are fine around the seeds. Time
/// then grows with about the power 1.1 of the number of faces, and memory is half as much.
struct Walk_reduction {
  /// Walks run over the faces of meshes with up to so many; 0 reduces every walk. Reduced, all stages take .6 to .75 of the
  /// time at 153 and 612 thousand faces (`benchmark_scaling`), and agree with people about as well: .0922 for .0912
  /// (`benchmark_princeton --faces 4 --method direct clusters --folds category`).
  std::size_t largest_direct = 100000;
  /// The least distance between the roots of two clusters, in steps from face to face, on meshes of up to 600 thousand
  /// faces; grows with the square root of their number from there on, so that the number of clusters hardly does. With 6
  /// steps a cluster has about 20 triangles where nothing keeps it from growing.
  std::size_t cluster_steps = 6;
  /// The largest d / sigma of an edge within a cluster: no cluster reaches over a larger one.
  double largest_difference = 2;
  /// How wide the band along a boundary is that is walked on again, in clusters to either side; 0 leaves the boundaries
  /// on those of the clusters.
  std::size_t band = 1;
};

namespace internal {

void require_reduction_numbers(const Walk_reduction& reduction);

}  // namespace internal

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Walk_reduction.h>
#endif

#endif
