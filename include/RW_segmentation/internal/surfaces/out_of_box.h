// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_OUT_OF_BOX_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_OUT_OF_BOX_H

#include <RW_segmentation/Analytic_surface.h>

#include <Eigen/Core>

namespace RW_segmentation::internal {

/// A surface in other coordinates.
/// \param unit the length there of what is 1 in a box
/// \param origin where the origin of the box is there
inline Analytic_surface out_of_box(Analytic_surface surface, double unit, const Eigen::Vector3d& origin) {
  surface.point = unit * surface.point + origin;
  surface.radius *= unit;
  surface.tube_radius *= unit;
  surface.residual *= unit;
  surface.errors.point *= unit;
  surface.errors.radius *= unit;
  surface.errors.tube_radius *= unit;
  surface.errors.axis *= unit;
  surface.errors.axis_height *= unit;
  return surface;
}

}  // namespace RW_segmentation::internal

#endif
