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
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Faces that lie on one analytic surface each.
struct Analytic_regions {
  std::vector<std::size_t> region_of_face;  ///< `Surface_growing::none` for the remainder
  std::size_t count = 0;
};

/// The regions that `Surface_growing` finds on the faces themselves.
inline Analytic_regions regions_of_faces(const Dual_graph& graph, const Face_geometry& geometry,
                                         const Face_corners& corners, const Surface_tolerance& tolerance,
                                         const std::vector<char>& is_barrier, const Progress& progress) {
  Surface_growing growing(graph, geometry, corners, is_barrier);
  growing.grow(tolerance, progress);
  growing.settle_borders();
  return {growing.region_of_face(), growing.surfaces().size()};
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
  regions.count = refined.count;
  for (const auto& share : shares)
    regions.region_of_face.push_back(
        share.empty() ? Surface_growing::none
                      : std::max_element(share.begin(), share.end(), [](const auto& a, const auto& b) {
                          return a.second < b.second;
                        })->first);
  return regions;
}

/// The regions of a mesh that lie on one analytic surface each.
///
/// Noise of vertices hides the surfaces of a CAD kernel's large triangles, which have few of them, although their planes
/// are known well: such triangles are cut into small ones for it, so that surfaces are weighed by their area.
inline Analytic_regions analytic_regions(const Dual_graph& graph, const Face_geometry& geometry,
                                         const Face_corners& corners, const Surface_tolerance& tolerance,
                                         const std::vector<char>& is_barrier, const Progress& progress) {
  constexpr double longest_side = 0.05;  // as a part of the diagonal
  if (tolerance.noise == 0 || geometry.longest_edge() <= longest_side)
    return regions_of_faces(graph, geometry, corners, tolerance, is_barrier, progress);

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

}  // namespace RW_segmentation::internal

#endif
