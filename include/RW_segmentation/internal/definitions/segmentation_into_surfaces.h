// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENTATION_INTO_SURFACES_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENTATION_INTO_SURFACES_H

#include <RW_segmentation/Analytic_surface_cost.h>
#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/merging/Region_merging.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/surfaces/Parts_in_boxes.h>
#include <RW_segmentation/internal/surfaces/Region_fragments.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/find_analytic_regions.h>
#include <RW_segmentation/segmentation_into_surfaces.h>

#include <algorithm>

namespace RW_segmentation::internal {

/// The numbers of the walk that shares out what no surface explains. Caps of 10 and 40 share it out alike; at half the sigma
/// single triangles of the CAD solids change.
inline std::vector<double> conductances_beside_surfaces(const Dual_mesh& mesh) {
  constexpr double every_crease = 1, sigma = 1, cap = 20;
  return conductances(mesh, Dihedral_difference_policy{every_crease, Dihedral_measure::angle}(mesh), sigma, cap);
}

RW_SEGMENTATION_INLINE Segments_on_surfaces segments_of_regions(const Dual_mesh& mesh,
                                                                const Surface_tolerance& tolerance,
                                                                const std::vector<std::size_t>& region_of_face,
                                                                const Progress& progress, Stage_clock& clock) {
  const std::vector<double> conductance = conductances_beside_surfaces(mesh);
  Region_fragments fragments(mesh, tolerance, conductance);
  Segments_on_surfaces result;
  result.fragment_of_face = fragments.fragments(region_of_face, progress.part(0, 0.25));
  result.is_given = fragments.given();
  clock.note("walk");
  const std::size_t count = *std::max_element(result.fragment_of_face.begin(), result.fragment_of_face.end()) + 1;
  const Analytic_surface_cost cost(mesh, tolerance);
  auto region_of = [&](Dual_mesh::Index f) {
    return result.is_given[f] ? Analytic_surface_cost::Region() : cost.region(mesh, f);
  };
  result.tree = Region_merging<Analytic_surface_cost>(
                    join_faces(result.fragment_of_face, count, cost, region_of),
                    region_boundaries(mesh, result.fragment_of_face, edge_sharpness(mesh, tolerance), cost), cost)
                    .run(progress.part(0.25, 1));
  clock.note("merging");
  progress(1);
  return result;
}

RW_SEGMENTATION_INLINE Segments_on_surfaces segment_into_surfaces(const Dual_mesh& mesh, double noise,
                                                                  const Progress& progress, Segmentation_report& report,
                                                                  Stage_clock& clock) {
  const Tolerated_mesh tolerated(with_stored_normals(mesh), noise);
  const Dual_mesh& shape = tolerated.mesh();
  const Surface_tolerance& tolerance = tolerated.tolerance;
  clock.note("noise");
  const Analytic_regions regions = find_analytic_regions(shape, tolerance, progress.part(0, 0.8));
  clock.note("surfaces");
  Segments_on_surfaces result =
      segments_of_regions(shape, tolerance, regions.region_of_face, progress.part(0.8, 1), clock);
  result.fragment_of_face = tolerated.facets.by_part(result.fragment_of_face);
  result.is_given = tolerated.facets.by_part(result.is_given);
  report.components = Components(shape.graph(), [&](Dual_mesh::Index e) { return !shape.is_wall(e); }).count;
  report.noise = tolerance.noise;
  report.seeds = regions.surfaces.size();
  report.fragments = result.tree.number_of_fragments();
  report.degenerate_faces = mesh.number_of_degenerate_faces();
  return result;
}

}  // namespace RW_segmentation::internal

#endif
