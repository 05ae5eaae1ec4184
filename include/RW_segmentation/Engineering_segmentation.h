#ifndef RW_SEGMENTATION_ENGINEERING_SEGMENTATION_H
#define RW_SEGMENTATION_ENGINEERING_SEGMENTATION_H

#include <RW_segmentation/Analytic_surface_cost.h>
#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Segment_hierarchy.h>
#include <RW_segmentation/internal/Face_corners.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/Graph_walk.h>
#include <RW_segmentation/internal/Region_fragments.h>
#include <RW_segmentation/internal/Surface_growing.h>
#include <RW_segmentation/internal/analytic_regions.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <CGAL/Named_function_parameters.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// A policy of `segmentation_via_random_walks()` for parts of machines: each segment is a plane, sphere, cylinder, cone
/// or torus, or a free form that none of these fits. Joints may be sharp or smooth, the mesh even, noisy, or as CAD
/// kernels make it.
///
/// \code
/// const std::size_t segments = segmentation_via_random_walks(mesh, ids, Engineering_segmentation());
/// for (const Analytic_surface& surface : segment_surfaces(mesh, ids, segments)) ...
/// \endcode
///
/// Surfaces are fitted to neighbourhoods of faces and grown as far as vertices and normals agree. What none of them
/// explains is given to its neighbours by a random walk from the regions found, or, where it is large, becomes a
/// segment. Regions are merged by `Analytic_surface_cost` while one surface fits both. The expected deviation of the
/// vertices is estimated from the mesh.
struct Engineering_segmentation {
  Engineering_segmentation() = default;

  /// As many segments as that, at least one for each connected component.
  explicit Engineering_segmentation(std::size_t segments) : number_of_segments(segments) {}

  std::optional<std::size_t> number_of_segments;  ///< without it, merging stops at `stop_cost`
  double stop_cost = 1;                           ///< the largest cost of a merge, see `Analytic_surface_cost`
  double noise = -1;  ///< standard deviation of the vertices, in parts of the diagonal; negative: estimated
  Normal_smoothing smoothing = {0, 0.1, 4};            ///< of the normals that the walk sees: none
  double convex_weight = 1;                            ///< of the difference, see `Dihedral_difference`
  Dihedral_measure measure = Dihedral_measure::angle;  ///< of the difference
  double sigma = 1;                                    ///< of the conductance, see `Conductance`
  double cap = 20;                                     ///< of the conductance

  /// The number of segments to stop at.
  std::size_t stop(const Merge_tree& tree) const {
    return number_of_segments ? *number_of_segments : Cost_threshold_stop(stop_cost)(tree);
  }
};

/// The overload of `hierarchy_via_random_walks()` for `Engineering_segmentation`. The fragments are the regions of
/// analytic surfaces, and the levels above cost 1 join segments that no surface fits.
///
/// Given seeds are not used, and constrained edges are crossed by no fragment. Complexity: linear in the number of
/// faces for meshes whose regions have several faces each; the time of a few fits, 0.1 to 0.2 ms, for each face that no
/// region holds.
template <class FaceListGraph,
          class SeedRange = std::array<typename boost::graph_traits<FaceListGraph>::face_descriptor, 0>,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Random_walk_hierarchy<FaceListGraph> hierarchy_via_random_walks(
    const FaceListGraph& mesh, const Engineering_segmentation& policy, const SeedRange& given_seeds = {},
    const NamedParameters& np = CGAL::parameters::default_values()) {
  const Progress progress = internal::progress_of(np);
  Segmentation_report report;
  internal::Stage_clock clock(report.stages);

  const Mesh_dual_graph<FaceListGraph> graph(mesh);
  internal::read_seeds(graph, given_seeds);
  const internal::Surface_data data = internal::surface_data(mesh, graph, policy.noise, np);
  if (graph.number_of_faces() == 0) return {};
  clock.note("mesh");

  const std::vector<Eigen::Vector3d> normals =
      internal::smooth_normals(graph, *data.geometry, policy.smoothing, progress.part(0, 0.1));
  const std::vector<double> difference =  // Eq. 4-5
      internal::dihedral_difference(graph, *data.geometry, normals, policy.convex_weight, policy.measure);
  std::vector<double> conductances =  // Eq. 6
      internal::conductances(data.geometry->edge_length, difference, policy.sigma, policy.cap);
  internal::cut_constrained_edges(graph, np, conductances);
  clock.note("conductances");

  std::vector<char> is_barrier;
  for (const double conductance : conductances) is_barrier.push_back(conductance == 0);
  const internal::Analytic_regions regions = internal::analytic_regions(
      graph, *data.geometry, *data.corners, *data.tolerance, is_barrier, progress.part(0.1, 0.8));
  clock.note("surfaces");

  const std::vector<double> angles = internal::edge_angles(graph, *data.geometry);
  internal::Region_fragments fragments(graph, *data.geometry, *data.corners, *data.tolerance, angles, conductances);
  std::vector<std::size_t> fragment_of_face = fragments.fragments(regions.region_of_face, progress.part(0.8, 0.85));
  clock.note("walk");

  report.components = internal::components(graph, conductances).count;
  report.seeds = regions.surfaces.size();
  report.fragments = *std::max_element(fragment_of_face.begin(), fragment_of_face.end()) + 1;
  report.degenerate_faces = data.geometry->degenerate_faces;
  const auto cost = data.formula(80);
  const auto region_of = [&](std::size_t f) {
    using Region = internal::Analytic_surface_formula::Region;
    return fragments.is_given(f) ? Region() : cost.region_of(static_cast<Dual_graph::Index>(f));
  };
  Merge_tree tree = internal::merge_fragments(
      graph, fragment_of_face, internal::join_faces(fragment_of_face, report.fragments, cost, region_of),
      data.geometry->edge_length, internal::edge_sharpness(graph, *data.geometry, *data.tolerance),
      internal::region_unit(*data.geometry), cost, progress.part(0.85, 1));
  clock.note("merging");
  progress(1);
  return {{std::move(tree), graph.face_descriptors(), std::move(fragment_of_face)}, std::move(report)};
}

}  // namespace RW_segmentation

#endif
