// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENT_SURFACES_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENT_SURFACES_H

#include <RW_segmentation/Analytic_surface_cost.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/merging/Region_merging.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/segment_surfaces.h>

namespace RW_segmentation::internal {

/// From the unit box to the mesh's coordinates.
inline Analytic_surface in_mesh_coordinates(Analytic_surface surface, const Dual_mesh& mesh) {
  surface.point = mesh.unit() * surface.point + mesh.origin();
  surface.radius *= mesh.unit();
  surface.tube_radius *= mesh.unit();
  surface.residual *= mesh.unit();
  return surface;
}

RW_SEGMENTATION_INLINE std::vector<Analytic_surface> surfaces_of_segments(
    const Dual_mesh& mesh, const std::vector<std::size_t>& segment_of_face, std::size_t number_of_segments,
    double noise) {
  constexpr std::size_t most_samples = 500;  // vertices of a segment
  const Analytic_surface_cost cost(mesh, surface_tolerance(mesh, noise), most_samples);
  const auto regions =
      join_faces(segment_of_face, number_of_segments, cost, [&](Dual_mesh::Index f) { return cost.region(mesh, f); });
  std::vector<Analytic_surface> surfaces;
  for (const auto& region : regions) surfaces.push_back(in_mesh_coordinates(cost.surface_of(region), mesh));
  return surfaces;
}

}  // namespace RW_segmentation::internal

#endif
