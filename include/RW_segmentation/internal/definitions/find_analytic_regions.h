// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_FIND_ANALYTIC_REGIONS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_FIND_ANALYTIC_REGIONS_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/long_tasks.h>
#include <RW_segmentation/internal/mesh/Mesh_stretch.h>
#include <RW_segmentation/internal/surfaces/Face_refinement.h>
#include <RW_segmentation/internal/surfaces/Flat_sides.h>
#include <RW_segmentation/internal/surfaces/Free_forms_of_revolution.h>
#include <RW_segmentation/internal/surfaces/Region_borders.h>
#include <RW_segmentation/internal/surfaces/Surface_growing.h>
#include <RW_segmentation/internal/surfaces/Surface_proposals.h>
#include <RW_segmentation/internal/surfaces/edge_angles.h>
#include <RW_segmentation/internal/surfaces/find_analytic_regions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The regions that `Surface_growing` and `Surface_proposals` find on the faces themselves.
inline Analytic_regions regions_of_faces(const Dual_mesh& mesh, const Surface_tolerance& tolerance,
                                         const Progress& progress) {
  constexpr int most_proposals = 2;  // times: borders that have moved show others
  Analytic_regions regions = Surface_growing(mesh, tolerance).regions(progress);
  Region_borders(mesh, tolerance, regions).settle(progress);
  if (!tolerance.has_noise()) Free_forms_of_revolution(mesh, tolerance, regions).take_back();
  if (!tolerance.may_have_independent_noise()) return regions;
  const auto settle = [&] { Region_borders(mesh, tolerance, regions).settle(progress); };
  for (int i = 0; i < most_proposals && Surface_proposals(mesh, tolerance, regions).try_about_faces(progress); ++i)
    settle();
  if (Surface_proposals(mesh, tolerance, regions).try_for_regions(progress)) settle();
  return regions;
}

/// Stretches of whole components, each long enough to be worth a thread.
inline std::vector<Mesh_stretch> long_stretches(const std::vector<Mesh_stretch>& components) {
  constexpr Dual_mesh::Index least_faces = 1000;  // about 20 ms
  std::vector<Mesh_stretch> stretches;
  for (const Mesh_stretch& component : components) {
    if (stretches.empty() || stretches.back().faces >= least_faces) {
      stretches.push_back(component);
    } else {
      stretches.back().faces += component.faces;
      stretches.back().edges += component.edges;
    }
  }
  return stretches;
}

/// The regions of several components at the same time, which know nothing of each other.
/// \param regions_of_part a function of some components with their tolerance, and of the progress, that returns their regions
template <class Regions_of_part>
Analytic_regions regions_of_components(const Dual_mesh& mesh, const Surface_tolerance& tolerance,
                                       const Regions_of_part& regions_of_part, const Progress& progress) {
  const std::vector<Mesh_stretch> stretches = long_stretches(connected_stretches(mesh.graph()));
  if (stretches.size() <= 1) return regions_of_part(mesh, tolerance, progress);
  std::vector<Analytic_regions> found(stretches.size());
  const auto find = [&](std::size_t i, const Progress& part) {
    std::vector<Dual_mesh::Index> faces(stretches[i].faces);
    std::iota(faces.begin(), faces.end(), stretches[i].first_face);
    found[i] = regions_of_part(mesh.components_in_place(stretches[i]), tolerance.of_parts(faces), part);
  };
  constexpr bool concurrent = true;
  long_tasks(sizes_of(stretches), progress, find, concurrent);

  Analytic_regions all;
  for (const Analytic_regions& regions : found) {
    for (const std::size_t region : regions.region_of_face)
      all.region_of_face.push_back(region == Analytic_regions::none ? region : all.surfaces.size() + region);
    all.surfaces.insert(all.surfaces.end(), regions.surfaces.begin(), regions.surfaces.end());
  }
  return all;
}

/// The regions of the faces that triangles are part of: each takes the region that most of its area has.
inline Analytic_regions carried_back(const Analytic_regions& triangles, const Face_refinement& refinement,
                                     std::size_t number_of_faces) {
  std::vector<std::map<std::size_t, double>> areas(number_of_faces);
  for (std::size_t t = 0; t < refinement.faces().size(); ++t)
    areas[refinement.faces()[t]][triangles.region_of_face[t]] += refinement.mesh().areas()[t];
  const auto has_less = [](const auto& a, const auto& b) { return a.second < b.second; };
  Analytic_regions regions;
  regions.surfaces = triangles.surfaces;
  for (const auto& area : areas)
    regions.region_of_face.push_back(area.empty() ? Analytic_regions::none
                                                  : std::max_element(area.begin(), area.end(), has_less)->first);
  return regions;
}

/// The regions of the triangles that the faces are cut into, whose sides are not longer than a given length.
inline Analytic_regions regions_of_triangles(const Dual_mesh& mesh, const Surface_tolerance& tolerance,
                                             double longest_side, const Progress& progress) {
  const Face_refinement refinement(mesh, longest_side);
  return carried_back(regions_of_faces(refinement.mesh(), tolerance.of_parts(refinement.faces()), progress), refinement,
                      mesh.number_of_faces());
}

/// The length that triangles may have so that about `most` of them make up the faces, and at least `least`. Halved again
/// and again, a triangle has a quarter of the square of its longest side.
inline double side_of_triangles(const Dual_mesh& mesh, double least, double most) {
  return std::max(least, 2 * std::sqrt(mesh.total_area() / most));
}

/// The mesh with walls where flat sides certainly end, such as the flats of a shaft: their corners lie on its cylinder, and in
/// their middle they have its normal, so that it would grow over them.
inline Dual_mesh with_walls_at_flat_sides(const Dual_mesh& mesh) {
  const std::vector<Flat_sides::Crease> creases = creases_of_flat_sides(mesh, edge_angles(mesh));
  std::vector<char> is_wall;
  is_wall.reserve(creases.size());
  for (Dual_mesh::Index e = 0; e < creases.size(); ++e)
    is_wall.push_back(mesh.is_wall(e) || creases[e] == Flat_sides::Crease::certain);
  return mesh.with_walls(std::move(is_wall));
}

RW_SEGMENTATION_INLINE Analytic_regions find_analytic_regions(const Dual_mesh& mesh, const Surface_tolerance& tolerance,
                                                              const Progress& progress) {
  if (!tolerance.has_noise())
    return regions_of_components(with_walls_at_flat_sides(mesh), tolerance, regions_of_faces, progress);
  constexpr double longest_side = 0.05;     // in parts of the diagonal
  constexpr double most_triangles = 20000;  // solids have 5000 or so
  const double side = side_of_triangles(mesh, longest_side, most_triangles);
  const std::vector<double>& lengths = mesh.edge_lengths();
  const bool has_long_sides = std::any_of(lengths.begin(), lengths.end(), [&](double length) { return length > side; });
  if (!tolerance.is_noisy() || !has_long_sides)
    return regions_of_components(mesh, tolerance, regions_of_faces, progress);
  const auto refined = [&](const Dual_mesh& part, const Surface_tolerance& of_part, const Progress& of_progress) {
    return regions_of_triangles(part, of_part, side, of_progress);
  };
  Analytic_regions regions = regions_of_components(mesh, tolerance, refined, progress);
  Region_borders(mesh, tolerance, regions).settle(progress);
  return regions;
}

}  // namespace RW_segmentation::internal

#endif
