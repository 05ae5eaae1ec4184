// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_UNIT_VECTOR_H
#define RW_SEGMENTATION_INTERNAL_UNIT_VECTOR_H

#include <Eigen/Core>

namespace RW_segmentation::internal {

/// A vector divided by its length, however large or small that is; the zero vector stays as it is.
inline Eigen::Vector3d unit_vector(const Eigen::Vector3d& v) {
  return v.isZero(0) ? v : Eigen::Vector3d(v.stableNormalized());
}

}  // namespace RW_segmentation::internal

#endif
