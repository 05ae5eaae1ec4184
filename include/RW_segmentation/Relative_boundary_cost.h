// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_RELATIVE_BOUNDARY_COST_H
#define RW_SEGMENTATION_RELATIVE_BOUNDARY_COST_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Region_boundary.h>

namespace RW_segmentation {

/// The paper's merge cost (Eq. 10): the mean difference along the common boundary of two regions, divided by that along
/// the whole of their boundaries. A model of `MergeCost`.
///
/// It has no sense of size: a sliver whose outline is alike all round is kept, and the last two regions always cost 1.
/// Where the whole boundary has difference 0 the cost is 0.
class Relative_boundary_cost {
 public:
  /// Nothing: the boundary says it all.
  struct Region {};

  /// The region of a single face.
  Region region(const Dual_mesh&, Dual_mesh::Index) const { return {}; }
  /// Does nothing.
  void join(Region&, const Region&) const {}

  /// Eq. 10.
  double operator()(const Region&, const Region&, const Region_boundary& boundary) const {
    const auto& [common, whole] = boundary;
    return whole.difference > 0 ? (common.difference / common.length) / (whole.difference / whole.length) : 0;
  }
};

}  // namespace RW_segmentation

#endif
