// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_POTENTIALS_H
#define RW_SEGMENTATION_POTENTIALS_H

#include <Eigen/Core>

namespace RW_segmentation {

/// Potentials of faces: one row a face, one column a label (or a seed), row by row in memory.
///
/// The potential of a label at a face is the probability that a walk from the face meets a seed of that label first.
using Potentials = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace RW_segmentation

#endif
