// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_DESIGNED_SURFACES_H
#define RW_SEGMENTATION_TEST_DESIGNED_SURFACES_H

#include <RW_segmentation/Analytic_surface.h>

#include <vector>

#include "solids.h"

/// The surfaces that a solid was made of, as the library has them.
inline std::vector<RW_segmentation::Analytic_surface> designed_surfaces(const solids::Solid& solid) {
  std::vector<RW_segmentation::Analytic_surface> surfaces;
  for (const solids::Surface& design : solid.surfaces) {
    RW_segmentation::Analytic_surface surface;
    surface.type = static_cast<RW_segmentation::Surface_type>(design.type);
    surface.point = design.point;
    surface.direction = design.direction;
    surface.radius = design.radius;
    surface.tube_radius = design.tube_radius;
    surface.half_angle = design.half_angle;
    surfaces.push_back(surface);
  }
  return surfaces;
}

#endif
