// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_BORDER_CROSSING_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_BORDER_CROSSING_H

#include <RW_segmentation/internal/boundary/Triangle_surface.h>

#include <Eigen/Core>

namespace RW_segmentation::internal {

/// Where a smooth boundary crosses the border of a mesh that goes on there, which is a tile of another one.
struct Border_crossing {
  using Index = Triangle_surface::Index;

  Index vertex;     ///< on the border, where the one boundary that leads there ends within the mesh
  Index side;       ///< the side of the border that it is to end on; `none`: it ends in the vertex
  double position;  ///< from the source of the side, 0, to its target, 1
  Eigen::Vector3d
      beyond;  ///< from there to where the boundary goes on, as far as its points are apart; in the unit box
};

}  // namespace RW_segmentation::internal

#endif
