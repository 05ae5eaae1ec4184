// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENT_SURFACES_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENT_SURFACES_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/surfaces/Parts_in_boxes.h>
#include <RW_segmentation/internal/surfaces/Surfaces_of_segments.h>
#include <RW_segmentation/internal/surfaces/out_of_box.h>
#include <RW_segmentation/segment_surfaces.h>

#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE std::vector<Analytic_surface> surfaces_in_unit_box(
    const Dual_mesh& mesh, const std::vector<std::size_t>& segment_of_face, std::size_t number_of_segments,
    const Surface_tolerance& tolerance) {
  return Surfaces_of_segments(mesh, segment_of_face, number_of_segments, tolerance).surfaces();
}

RW_SEGMENTATION_INLINE std::vector<Analytic_surface> surfaces_of_segments(
    const Dual_mesh& mesh, const std::vector<std::size_t>& segment_of_face, std::size_t number_of_segments,
    double noise) {
  const Dual_mesh shape = with_stored_normals(mesh);
  const Tolerated_mesh tolerated(shape, noise, segment_of_face);
  std::vector<Analytic_surface> surfaces = surfaces_in_unit_box(
      tolerated.mesh(), tolerated.facets.by_whole(segment_of_face), number_of_segments, tolerated.tolerance);
  std::vector<Dual_mesh::Index> vertex(number_of_segments, 0);
  for (Dual_mesh::Index f = 0; f < shape.number_of_faces(); ++f) vertex[segment_of_face[f]] = shape.corners(f)[0];
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    surfaces[s] = out_of_box(tolerated.parts.in_whole(surfaces[s], vertex[s]), shape.unit(), shape.origin());
  return surfaces;
}

}  // namespace RW_segmentation::internal

#endif
