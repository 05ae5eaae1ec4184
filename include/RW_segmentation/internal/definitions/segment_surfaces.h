// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENT_SURFACES_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENT_SURFACES_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/Surfaces_of_segments.h>
#include <RW_segmentation/segment_surfaces.h>

#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE std::vector<Analytic_surface> surfaces_of_segments(
    const Dual_mesh& mesh, const std::vector<std::size_t>& segment_of_face, std::size_t number_of_segments,
    double noise) {
  const Dual_mesh shape = with_stored_normals(mesh);
  const Surface_tolerance tolerance = surface_tolerance(shape, noise);
  std::vector<Analytic_surface> surfaces =
      Surfaces_of_segments(shape, segment_of_face, number_of_segments, tolerance).surfaces();
  for (Analytic_surface& surface : surfaces) surface = in_mesh_coordinates(surface, shape);
  return surfaces;
}

}  // namespace RW_segmentation::internal

#endif
