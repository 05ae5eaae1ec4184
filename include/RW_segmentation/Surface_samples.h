// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_SURFACE_SAMPLES_H
#define RW_SEGMENTATION_SURFACE_SAMPLES_H

#include <Eigen/Core>

#include <vector>

namespace RW_segmentation {

/// What a surface is fitted to: points on it, and unit normals at further points close to it.
struct Surface_samples {
  std::vector<Eigen::Vector3d> points;         ///< on the surface
  std::vector<Eigen::Vector3d> normal_points;  ///< where normals are known
  std::vector<Eigen::Vector3d> normals;        ///< at these points

  /// Removes all samples.
  void clear() {
    points.clear();
    normal_points.clear();
    normals.clear();
  }
};

}  // namespace RW_segmentation

#endif
