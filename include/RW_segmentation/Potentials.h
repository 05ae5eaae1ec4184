// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_POTENTIALS_H
#define RW_SEGMENTATION_POTENTIALS_H

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace RW_segmentation {

/// Potentials of faces: one row a face, one column a label (or a seed), row by row in memory.
///
/// The potential of a label at a face is the probability that a walk from the face meets a seed of that label first.
using Potentials = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What a solver finds where only the largest potential of each face is wanted.
struct Largest_potentials {
  /// By face: the label with the largest potential, the lowest one on a tie.
  std::vector<std::uint32_t> labels;
  /// By face: the potential of that label; NaN where it was not computed.
  std::vector<double> potentials;
};

}  // namespace RW_segmentation

#endif
