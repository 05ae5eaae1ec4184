// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_CURVE_JOINT_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_CURVE_JOINT_H

#include <RW_segmentation/internal/boundary/Surface_curve.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>

#include <functional>
#include <optional>
#include <vector>

namespace RW_segmentation::internal {

/// Two consecutive points of a curve in different faces, and how the curve was traced from one to the other.
struct Curve_joint {
  const Triangle_surface& surface;
  const Curve_point& from;
  const Curve_point& to;                  ///< not fixed
  const std::vector<Curve_node>& traced;  ///< the crossings, at least one
};

/// The crossings between the points of a joint; none if it knows no better than the traced ones.
using Curve_joining = std::function<std::optional<std::vector<Curve_node>>(const Curve_joint&)>;

}  // namespace RW_segmentation::internal

#endif
