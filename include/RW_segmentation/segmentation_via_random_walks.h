#ifndef RW_SEGMENTATION_SEGMENTATION_VIA_RANDOM_WALKS_H
#define RW_SEGMENTATION_SEGMENTATION_VIA_RANDOM_WALKS_H

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Relative_boundary_cost.h>
#include <RW_segmentation/Segment_hierarchy.h>
#include <RW_segmentation/Size_aware_cost.h>
#include <RW_segmentation/Walk_reduction.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/parallel_for.h>
#include <RW_segmentation/internal/walk_fragments.h>
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// The numbers of the automatic segmentation that agrees best with people. All are dimensionless.
///
/// Segments are cut where smoothed normals turn inward. Walks from a few dozen seeds make the fragments, and fragments
/// are merged by `Size_aware_cost` with `local_thickness()`.
struct Automatic_segmentation {
  Automatic_segmentation() = default;

  /// As many segments as that, at least one for each connected component.
  explicit Automatic_segmentation(std::size_t segments) : number_of_segments(segments) {}

  std::optional<std::size_t> number_of_segments;       ///< without it, merging stops at `stop_cost`
  double stop_cost = 1;                                ///< the largest cost of a merge
  Normal_smoothing smoothing;                          ///< of the normals, see `smoothed_face_normals()`
  double convex_weight = 0;                            ///< of the difference, see `Dihedral_difference`
  Dihedral_measure measure = Dihedral_measure::angle;  ///< of the difference
  /// Differences up to so many times the mean count as none and larger ones lose it: sqrt(d^2 - x^2).
  double ordinary_difference = 1;
  double sigma = 1;                  ///< of the conductance, see `Conductance`
  double cap = 20;                   ///< of the conductance
  std::size_t seeds = 40;            ///< for each mesh, and one more for each further connected component
  Farthest_point_sampling sampling;  ///< how the seeds are spread
  Walk_reduction reduction;          ///< of the walk on large meshes
  Thickness_sampling thickness;      ///< 0 samples: thickness does not count

  /// The number of segments to stop at.
  std::size_t stop(const Merge_tree& tree) const {
    return number_of_segments ? *number_of_segments : Cost_threshold_stop(stop_cost)(tree);
  }
};

/// The paper's own parameters: the difference of the faces' own normals with convex weight 0.2 (Eq. 4-5), conductances
/// with sigma 1 (Eq. 6), and merging by `Relative_boundary_cost` (Eq. 10) until the cost exceeds 0.5.
struct Paper_segmentation {
  Paper_segmentation() = default;

  /// As many segments as that, at least one for each connected component.
  explicit Paper_segmentation(std::size_t segments) : number_of_segments(segments) {}

  std::optional<std::size_t> number_of_segments;                  ///< without it, merging stops at `stop_cost`
  double stop_cost = 0.5;                                         ///< the largest cost of a merge
  Normal_smoothing smoothing = {0, 0.1, 4};                       ///< none
  double convex_weight = 0.2;                                     ///< of the difference, see `Dihedral_difference`
  Dihedral_measure measure = Dihedral_measure::one_minus_cosine;  ///< of the difference
  double ordinary_difference = 0;                                 ///< every difference counts
  double sigma = 1;                                               ///< of the conductance, see `Conductance`
  double cap = 20;                                                ///< of the conductance
  std::size_t seeds = 60;            ///< for each mesh, and one more for each further connected component
  Farthest_point_sampling sampling;  ///< how the seeds are spread
  Walk_reduction reduction;          ///< of the walk on large meshes

  /// The number of segments to stop at.
  std::size_t stop(const Merge_tree& tree) const {
    return number_of_segments ? *number_of_segments : Cost_threshold_stop(stop_cost)(tree);
  }
};

/// What happened in a segmentation, and how long it took.
struct Segmentation_report {
  std::size_t components = 0;        ///< connected components of the mesh
  std::size_t seeds = 0;             ///< given and automatic ones
  std::size_t clusters = 0;          ///< that the walk was reduced to; 0 if it ran over the faces
  std::size_t fragments = 0;         ///< before merging
  std::size_t degenerate_faces = 0;  ///< faces without area
  std::size_t island_faces = 0;      ///< faces that the walk left apart from their fragment, moved to a neighbour
  bool has_heavy_noise = false;      ///< the vertices were smoothed to see the shape, see `Normal_smoothing`

  /// A stage of the computation.
  struct Stage {
    std::string name;  ///< what is done
    double seconds;    ///< how long it took, or was waited for where others were done at the same time
  };
  std::vector<Stage> stages;  ///< in the order in which they happen
};

/// All levels of a segmentation, and a report of how it was made.
template <class FaceListGraph>
class Random_walk_hierarchy : public Segment_hierarchy<FaceListGraph> {
 public:
  Random_walk_hierarchy() = default;
  /// Puts the two together.
  Random_walk_hierarchy(Segment_hierarchy<FaceListGraph> hierarchy, Segmentation_report report)
      : Segment_hierarchy<FaceListGraph>(std::move(hierarchy)), report_(std::move(report)) {}

  /// How the segmentation was made.
  const Segmentation_report& report() const { return report_; }

 private:
  Segmentation_report report_;
};

namespace internal {

/// Notes how long the stages of a computation take.
class Stage_clock {
 public:
  explicit Stage_clock(std::vector<Segmentation_report::Stage>& stages) : stages_(stages) {}

  /// Ends a stage, which began where the one before it ended.
  void note(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    stages_.push_back({stage, std::chrono::duration<double>(now - last_).count()});
    last_ = now;
  }

 private:
  std::vector<Segmentation_report::Stage>& stages_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// What the difference has in excess of an ordinary one: sqrt(d^2 - ordinary^2), or 0, divided by its mean. Slight
/// concavities are everywhere on a living shape and tell nothing about where its parts meet.
inline std::vector<double> excess(std::vector<double> difference, double ordinary) {
  if (ordinary == 0) return difference;
  double sum = 0;
  for (double& d : difference) {
    d = d > ordinary ? std::sqrt(d * d - ordinary * ordinary) : 0;
    sum += d;
  }
  if (sum > 0) {
    const double mean = sum / static_cast<double>(difference.size());
    for (double& d : difference) d /= mean;
  }
  return difference;
}

/// Faces from which walks make the fragments: those of the policy, spread away from the given ones, and the given ones.
template <class Policy>
std::vector<Dual_graph::Index> fragment_seeds(const Dual_graph& graph, const Face_geometry& geometry,
                                              const std::vector<Eigen::Vector3d>& normals,
                                              const std::vector<Dual_graph::Index>& given, const Components& component,
                                              const Policy& policy, const Progress& progress) {
  const std::size_t count = std::min(policy.seeds + component.count - 1, graph.number_of_faces() - given.size());
  std::vector<Dual_graph::Index> seeds =
      feature_sensitive_seeds(graph, geometry, normals, given, count, policy.sampling, progress);
  seeds.insert(seeds.begin(), given.begin(), given.end());
  return seeds;
}

/// The thickness that `Automatic_segmentation` merges by, in the order of the faces; empty if it does not count.
template <class FaceListGraph, class NamedParameters>
std::vector<double> thickness_for(const Automatic_segmentation& policy, const FaceListGraph& mesh,
                                  const Mesh_dual_graph<FaceListGraph>& graph,
                                  const Unit_box_points<FaceListGraph, NamedParameters>& point,
                                  const Face_geometry& geometry) {
  if (policy.thickness.samples == 0) return {};
  const Triangle_tree tree(fan_triangles(mesh, graph, point));
  return thickness_of_faces(geometry, tree, policy.thickness, {});
}

/// `Paper_segmentation` does not ask for it.
template <class FaceListGraph, class NamedParameters>
std::vector<double> thickness_for(const Paper_segmentation&, const FaceListGraph&,
                                  const Mesh_dual_graph<FaceListGraph>&,
                                  const Unit_box_points<FaceListGraph, NamedParameters>&, const Face_geometry&) {
  return {};
}

/// Merges fragments as `Automatic_segmentation` says.
inline Merge_tree merge_by_policy(const Automatic_segmentation&, const Dual_graph& graph, const Face_geometry& geometry,
                                  const std::vector<double>& thickness, const std::vector<double>& difference,
                                  const std::vector<std::size_t>& fragment_of_face, std::size_t fragments,
                                  const Progress& progress) {
  const Size_aware_formula cost;
  const auto regions = size_aware_regions(geometry, thickness);
  return merge_fragments(graph, fragment_of_face,
                         join_faces(fragment_of_face, fragments, cost, [&](std::size_t f) { return regions[f]; }),
                         geometry.edge_length, difference, region_unit(geometry), cost, progress);
}

/// Merges fragments as `Paper_segmentation` says.
inline Merge_tree merge_by_policy(const Paper_segmentation&, const Dual_graph& graph, const Face_geometry& geometry,
                                  const std::vector<double>&, const std::vector<double>& difference,
                                  const std::vector<std::size_t>& fragment_of_face, std::size_t fragments,
                                  const Progress& progress) {
  return merge_fragments(graph, fragment_of_face, std::vector<Relative_boundary_cost::Region>(fragments),
                         geometry.edge_length, difference, region_unit(geometry), Relative_boundary_cost(), progress);
}

}  // namespace internal

/// Segments a mesh into a hierarchy: seeds place themselves, walks from them make fragments, and fragments are merged
/// until each connected component is one segment (section 4.2 of the paper).
///
/// `hierarchy.segments(stop, ids)` then writes any level. Parameters, errors and complexity are those of
/// `segmentation_via_random_walks()`.
template <class FaceListGraph, class Policy = Automatic_segmentation,
          class SeedRange = std::array<typename boost::graph_traits<FaceListGraph>::face_descriptor, 0>,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Random_walk_hierarchy<FaceListGraph> hierarchy_via_random_walks(
    const FaceListGraph& mesh, const Policy& policy = Policy(), const SeedRange& given_seeds = {},
    const NamedParameters& np = CGAL::parameters::default_values()) {
  if (policy.seeds == 0) throw internal::argument_error("seeds", policy.seeds, "at least 1");
  if (!(policy.ordinary_difference >= 0))
    throw internal::argument_error("ordinary_difference", policy.ordinary_difference, "at least 0");
  internal::require_reduction_numbers(policy.reduction);
  const Progress progress = internal::progress_of(np);
  Segmentation_report report;
  internal::Stage_clock clock(report.stages);

  Mesh_dual_graph<FaceListGraph> graph(mesh);
  graph.renumber_along_surface();
  internal::Unit_box_points<FaceListGraph, NamedParameters> point(mesh, np);
  internal::Face_geometry geometry = internal::face_geometry(mesh, graph, point);
  const std::vector<Dual_graph::Index> given = internal::read_seeds(graph, given_seeds);
  if (graph.number_of_faces() == 0) return {};
  clock.note("mesh");

  std::vector<Eigen::Vector3d> normals;
  std::vector<double> difference, conductances;
  internal::Components component;
  const auto prepare_walk = [&] {
    std::tie(normals, report.has_heavy_noise) =
        internal::smooth_normals_and_vertices(mesh, graph, point, geometry, policy.smoothing, progress.part(0, 0.3));
    clock.note("normals");
    difference = internal::excess(  // Eq. 4-5
        internal::dihedral_difference(graph, geometry, normals, policy.convex_weight, policy.measure),
        policy.ordinary_difference);
    conductances = internal::conductances(geometry.edge_length, difference, policy.sigma, policy.cap);  // Eq. 6
    internal::cut_constrained_edges(graph, np, conductances);
    component = internal::components(graph, conductances);
    clock.note("conductances");
  };
  // The order of elimination depends on none of these, nor thickness on seeds and walk. Of what is done at the same
  // time, the stages tell how long the rest of it was waited for.
  const bool is_reduced = graph.number_of_faces() > policy.reduction.largest_direct;
  Star_mesh_elimination solver;
  const auto order = [&] {
    if (!is_reduced) solver.analyze(graph);
  };
  internal::at_the_same_time<CGAL::Parallel_if_available_tag>(order, prepare_walk);
  clock.note("ordering");
  std::vector<double> thickness;
  std::vector<Dual_graph::Index> seeds;
  internal::Fragments fragments;
  const auto walk = [&] {
    seeds = internal::fragment_seeds(graph, geometry, normals, given, component, policy, progress.part(0.3, 0.4));
    clock.note("seeds");
    const internal::Walk_network network = {graph, conductances, component};
    const Progress part = progress.part(0.4, 0.9);
    fragments = is_reduced ? internal::walk_fragments_over_clusters(network, geometry.edge_length, seeds,
                                                                    policy.reduction, part)
                           : internal::walk_fragments(network, std::move(solver), seeds, part);
    clock.note("walk");
  };
  internal::at_the_same_time<CGAL::Parallel_if_available_tag>(
      [&] { thickness = internal::thickness_for(policy, mesh, graph, point, geometry); }, walk);
  clock.note("thickness");

  report.components = component.count;
  report.seeds = seeds.size();
  report.clusters = fragments.clusters;
  report.fragments = *std::max_element(fragments.of_face.begin(), fragments.of_face.end()) + 1;
  report.degenerate_faces = geometry.degenerate_faces;
  report.island_faces = fragments.island_faces;
  Merge_tree tree = internal::merge_by_policy(policy, graph, geometry, thickness, difference, fragments.of_face,
                                              report.fragments, progress.part(0.9, 1));
  clock.note("merging");
  progress(1);
  return {{std::move(tree), graph.face_descriptors(), std::move(fragments.of_face)}, std::move(report)};
}

/// Segments a mesh by itself: in one call, without seeds of the user, into as many segments as the shape suggests or as
/// many as asked for.
///
/// \code
/// std::size_t segments = segmentation_via_random_walks(mesh, ids);                  // as many as there are
/// segmentation_via_random_walks(mesh, ids, Automatic_segmentation(6));              // six
/// segmentation_via_random_walks(mesh, ids, Paper_segmentation());                   // the paper's parameters
/// \endcode
///
/// Connected components are never joined: each is one segment or several. The result depends on the mesh alone, not on
/// chance or on the number of threads, and not on the mesh's position and size.
///
/// Complexity: that of the walk, O(m^1.3) time and O(m log m) memory for m faces in practice; see
/// `Star_mesh_elimination`. The walk of large meshes is reduced, which takes about O(m^1.1) time and O(m) memory; see
/// `Walk_reduction`. Where TBB is linked (`CGAL_LINKED_WITH_TBB`), its threads share the work, and read the property maps
/// at the same time.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph` with faces of any degree
/// \tparam SegmentIdMap a writable property map from `face_descriptor` to `std::size_t`
/// \tparam Policy `Automatic_segmentation` or `Paper_segmentation`
/// \tparam SeedRange a range of faces, or of pairs of a face and anything
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh, its faces oriented outward
/// \param segment_ids output, contiguous ids from 0
/// \param policy the numbers of all stages, with the number of segments if it is known
/// \param given_seeds faces of the user's to start walks from besides the automatic ones, where a part is too small to
/// get a seed by itself
/// \param np
/// - `vertex_point_map` (default: that of the mesh)
/// - `edge_is_constrained_map` (readable map from `edge_descriptor` to `bool`, default: no edge is): walks do not cross
/// the marked edges
/// - `callback` (`std::function<bool(double)>`, default: none): receives the fraction done, returns `false` to cancel
/// \returns the number of segments
/// \throws std::invalid_argument if the number of segments asked for is less than that of the components or more than
/// that of the fragments, a number of the policy is out of range, a coordinate is not finite, or a given seed is not a
/// face of the mesh; nothing is written then
/// \throws Cancelled
template <class FaceListGraph, class SegmentIdMap, class Policy = Automatic_segmentation,
          class SeedRange = std::array<typename boost::graph_traits<FaceListGraph>::face_descriptor, 0>,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
std::size_t segmentation_via_random_walks(const FaceListGraph& mesh, SegmentIdMap segment_ids,
                                          const Policy& policy = Policy(), const SeedRange& given_seeds = {},
                                          const NamedParameters& np = CGAL::parameters::default_values()) {
  const auto hierarchy = hierarchy_via_random_walks(mesh, policy, given_seeds, np);
  return hierarchy.segments([&](const Merge_tree& tree) { return policy.stop(tree); }, segment_ids);
}

}  // namespace RW_segmentation

#endif
