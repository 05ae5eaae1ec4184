#ifndef RW_SEGMENTATION_INTERNAL_ANALYTIC_REGIONS_H
#define RW_SEGMENTATION_INTERNAL_ANALYTIC_REGIONS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Face_corners.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/Face_refinement.h>
#include <RW_segmentation/internal/Surface_growing.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Faces that lie on one analytic surface each.
struct Analytic_regions {
  std::vector<std::size_t> region_of_face;  ///< `Surface_growing::none` for the remainder
  std::vector<Analytic_surface> surfaces;   ///< of each region
};

/// The regions that `Surface_growing` finds on the faces themselves.
inline Analytic_regions regions_of_faces(const Dual_graph& graph, const Face_geometry& geometry,
                                         const Face_corners& corners, const Surface_tolerance& tolerance,
                                         const std::vector<char>& is_barrier, const Progress& progress) {
  Surface_growing growing(graph, geometry, corners, is_barrier);
  growing.grow(tolerance, progress);
  growing.settle_borders();
  return {growing.region_of_face(), growing.surfaces()};
}

/// Between triangles of faces that have a barrier between them.
inline std::vector<char> refined_barriers(const Dual_graph& graph, const std::vector<char>& is_barrier,
                                          const Dual_graph& refined, const std::vector<Dual_graph::Index>& face) {
  using Index = Dual_graph::Index;
  std::set<std::pair<Index, Index>> apart;
  for (Index e = 0; e < graph.number_of_edges(); ++e)
    if (is_barrier[e]) apart.insert(std::minmax(graph.faces_of(e)[0], graph.faces_of(e)[1]));
  std::vector<char> result;
  for (Index e = 0; e < refined.number_of_edges(); ++e)
    result.push_back(apart.count(std::minmax(face[refined.faces_of(e)[0]], face[refined.faces_of(e)[1]])) > 0);
  return result;
}

/// The regions of faces, each of which takes the region that most of its area has.
inline Analytic_regions carried_back(const Analytic_regions& refined, const std::vector<Dual_graph::Index>& face,
                                     const std::vector<double>& area, std::size_t number_of_faces) {
  std::vector<std::map<std::size_t, double>> shares(number_of_faces);
  for (std::size_t t = 0; t < face.size(); ++t) shares[face[t]][refined.region_of_face[t]] += area[t];
  Analytic_regions regions;
  regions.surfaces = refined.surfaces;
  for (const auto& share : shares)
    regions.region_of_face.push_back(
        share.empty() ? Surface_growing::none
                      : std::max_element(share.begin(), share.end(), [](const auto& a, const auto& b) {
                          return a.second < b.second;
                        })->first);
  return regions;
}

/// The regions of triangles that the faces are cut into, whose sides are not longer than a given length.
inline Analytic_regions regions_of_triangles(const Dual_graph& graph, const Face_geometry& geometry,
                                             const Face_corners& corners, const Surface_tolerance& tolerance,
                                             const std::vector<char>& is_barrier, double longest_side,
                                             const Progress& progress) {
  const Face_refinement refinement(graph, corners, longest_side);
  auto [edges, edge_length] = refinement.edges();
  const std::vector<Dual_graph::Index>& face = refinement.faces();
  const Dual_graph refined(face.size(), std::move(edges));
  const Face_geometry refined_faces = refined_geometry(refinement, geometry, std::move(edge_length));
  const Face_corners refined_corners(refinement.points(), refinement.triangles());
  Surface_tolerance refined_tolerance = tolerance;
  refined_tolerance.normal_angle.clear();
  for (const Dual_graph::Index f : face) refined_tolerance.normal_angle.push_back(tolerance.normal_angle[f]);
  return carried_back(regions_of_faces(refined, refined_faces, refined_corners, refined_tolerance,
                                       refined_barriers(graph, is_barrier, refined, face), progress),
                      face, refined_faces.area, graph.number_of_faces());
}

/// The length that triangles may have so that about `most` of them make up the faces, and at least `least`. Halved again
/// and again, a triangle has a quarter of the square of its longest side.
inline double side_of_triangles(const Face_geometry& geometry, double least, double most) {
  return std::max(least, 2 * std::sqrt(geometry.total_area / most));
}

/// The regions of a mesh that lie on one analytic surface each.
///
/// Noise of vertices hides the surfaces of a CAD kernel's large triangles, which have few of them, although their planes
/// are known well: such triangles are cut into small ones for it, so that surfaces are weighed by their area. Where
/// borders are, the faces themselves tell then: those that surfaces share belong to the one that holds all corners.
inline Analytic_regions analytic_regions(const Dual_graph& graph, const Face_geometry& geometry,
                                         const Face_corners& corners, const Surface_tolerance& tolerance,
                                         const std::vector<char>& is_barrier, const Progress& progress) {
  constexpr double longest_side = 0.05, most_triangles = 20000;  // solids have 5000 or so
  const double side = side_of_triangles(geometry, longest_side, most_triangles);
  if (tolerance.noise == 0 || geometry.longest_edge() <= side)
    return regions_of_faces(graph, geometry, corners, tolerance, is_barrier, progress);
  Analytic_regions regions = regions_of_triangles(graph, geometry, corners, tolerance, is_barrier, side, progress);
  Surface_growing growing(graph, geometry, corners, is_barrier);
  growing.adopt(tolerance, std::move(regions.region_of_face), std::move(regions.surfaces));
  growing.settle_borders();
  return {growing.region_of_face(), growing.surfaces()};
}

}  // namespace RW_segmentation::internal

#endif
