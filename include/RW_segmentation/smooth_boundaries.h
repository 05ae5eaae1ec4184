#ifndef RW_SEGMENTATION_SMOOTH_BOUNDARIES_H
#define RW_SEGMENTATION_SMOOTH_BOUNDARIES_H

#include <RW_segmentation/Boundary_curve.h>
#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/Boundary_smoother.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/Lifted_surface.h>
#include <RW_segmentation/internal/Triangle_surface.h>
#include <RW_segmentation/internal/read_segments.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <CGAL/Named_function_parameters.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// The spline in tension that boundaries become. All numbers are dimensionless.
struct Boundary_smoothing {
  /// Waves of the boundary shorter than 2 pi times this many edges are smoothed away, longer ones stay.
  double length = 3;
  /// How much the spline pulls together, compared with how much it resists bending. More of it makes boundaries
  /// shorter; with 0 they only become fair.
  double tension = 0.05;
  /// The length that a turn of the normal by one radian counts in the feature-sensitive metric, as a fraction of the
  /// square root of the area.
  double feature_weight = 0.02;
  /// Edges whose faces' smoothed normals differ by more, in radians, are creases; boundaries stay on them.
  double crease_angle = 0.5;
  /// How far a boundary may get from the edges it ran along, in mean edge lengths; with 0 all stay as they are.
  double largest_displacement = 1;
  /// Implicit steps in which the spline is reached; after each, it is put back on the surface.
  std::size_t steps = 64;
  Normal_smoothing normals;  ///< see `smoothed_face_normals()`
};

namespace internal {

/// \throws std::invalid_argument
inline void require_boundary_smoothing_numbers(const Boundary_smoothing& smoothing) {
  const auto require = [](const char* name, double value) {
    if (!(value >= 0) || !std::isfinite(value)) throw argument_error(name, value, "a finite number >= 0");
  };
  require("length", smoothing.length);
  require("tension", smoothing.tension);
  require("feature_weight", smoothing.feature_weight);
  require("largest_displacement", smoothing.largest_displacement);
  if (!(smoothing.crease_angle > 0)) throw argument_error("crease_angle", smoothing.crease_angle, "positive");
}

/// The numbers of the policy in the unit box.
inline Curve_smoothing_numbers curve_smoothing_numbers(const Boundary_smoothing& smoothing, double mean_edge_length) {
  constexpr double stiffest = 1e12;  // than which a spline cannot be told from a straight one
  const double steps = static_cast<double>(std::max<std::size_t>(smoothing.steps, 1));
  const double length = smoothing.length;
  Curve_smoothing_numbers numbers{};
  numbers.stiffness = std::min(std::pow(length, 4) / steps, stiffest);
  numbers.tension = std::min(smoothing.tension * length * length / steps, stiffest);
  numbers.steps = smoothing.steps;
  numbers.corridor = smoothing.largest_displacement * mean_edge_length;
  numbers.longest_step = mean_edge_length / 2;
  return numbers;
}

/// Whether the faces beside each halfedge turn by more than an angle.
inline std::vector<char> sharp_halfedges(const Triangle_surface& surface, const std::vector<Eigen::Vector3d>& normals,
                                         double angle) {
  const double least_turn = 2 * std::sin(std::min(angle, std::acos(-1.)) / 2);
  std::vector<char> is_sharp(surface.number_of_halfedges(), false);
  for (Triangle_surface::Index h = 0; h < surface.number_of_halfedges(); ++h)
    is_sharp[h] =
        !surface.is_border(h) &&
        (normals[Triangle_surface::face(h)] - normals[Triangle_surface::face(surface.twin(h))]).norm() > least_turn;
  return is_sharp;
}

/// A node as a halfedge of the mesh and a position.
template <class TriangleMesh, class NamedParameters>
Boundary_point<TriangleMesh> boundary_point(const Curve_node& node, const TriangleMesh& mesh,
                                            const Mesh_dual_graph<TriangleMesh>& graph, const Triangle_surface& surface,
                                            const NamedParameters& np) {
  using Index = Triangle_surface::Index;
  Index number = node.edge;
  if (node.is_vertex())
    surface.any_leaving(node.vertex, [&](Index h) {
      number = Triangle_surface::previous(h);
      return true;
    });
  Boundary_point<TriangleMesh> result;
  result.halfedge = descriptor_of_halfedge(number, mesh, graph);
  result.position = node.is_vertex() ? 1 : node.position;
  const Vertex_points<TriangleMesh, NamedParameters> point(mesh, np);
  const Eigen::Vector3d p = (1 - result.position) * point(source(result.halfedge, mesh)) +
                            result.position * point(target(result.halfedge, mesh));
  result.point = typename Boundary_point<TriangleMesh>::Point(p.x(), p.y(), p.z());
  return result;
}

}  // namespace internal

/// Smooths the boundaries between the segments of a mesh, which run along edges and are jagged therefore, and keeps
/// them on creases (3.2).
///
/// Boundaries are taken apart at their branch points: the vertices where more than two segments meet, or where a
/// boundary meets the border of the mesh. These stay where they are. Each boundary between two of them, and each closed
/// one, becomes a spline in tension: implicit steps down
///
///   E = sum |p(i+1) - 2 p(i) + p(i-1)|^2 + tension sum |p(i+1) - p(i)|^2,
///
/// with p in R^6, a point x of the surface and its smoothed normal n as (x, w n) (Lai et al. 2007, Hofer and Pottmann
/// 2004). After each step the points are put back on the surface by walking from face to face, so that they never get
/// to another sheet of it. Where a boundary follows a crease it keeps to its edges.
///
/// The curves do not cross each other or themselves, and each segment keeps its neighbours and stays in one piece if it
/// was: a curve that would break this is moved less, or stays as it was. So do curves of a single edge, those around a
/// single face or vertex, and those that lie on creases all along. No curve leaves its edges by more than the policy
/// allows: smoothness does not come from shrinking.
///
/// \code
/// const auto curves = smooth_boundaries(mesh, ids);
/// split_along_boundaries(mesh, curves, ids);  // if the mesh may be changed
/// \endcode
///
/// Complexity: O(m) for the normals of m faces, and O(k b) for k steps on b boundary edges.
///
/// \tparam TriangleMesh a model of CGAL's `FaceListGraph`, all faces triangles
/// \tparam SegmentIdMap a readable property map from `face_descriptor` to an integer
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh
/// \param segment_ids the segment of each face
/// \param smoothing how smooth
/// \param np `vertex_point_map` (default: that of the mesh), `callback` (`std::function<bool(double)>`, default: none)
/// \returns a curve for each boundary, open ones first
/// \throws std::invalid_argument if a face is no triangle, a coordinate is not finite, or a number of the policy is out
/// of range
/// \throws Cancelled
template <class TriangleMesh, class SegmentIdMap, class NamedParameters = CGAL::parameters::Default_named_parameters>
std::vector<Boundary_curve<TriangleMesh>> smooth_boundaries(
    const TriangleMesh& mesh, const SegmentIdMap& segment_ids, const Boundary_smoothing& smoothing = {},
    const NamedParameters& np = CGAL::parameters::default_values()) {
  internal::require_boundary_smoothing_numbers(smoothing);
  const Progress progress = internal::progress_of(np);
  const Mesh_dual_graph<TriangleMesh> graph(mesh);
  const std::vector<std::size_t> segment_of_face = internal::read_segments(graph, segment_ids);
  const internal::Triangle_surface surface = internal::triangle_surface(mesh, graph, np);
  const internal::Face_geometry geometry = internal::face_geometry(mesh, graph, np);
  const std::vector<Eigen::Vector3d> normals =
      internal::smooth_normals(graph, geometry, smoothing.normals, progress.part(0, 0.5));

  const internal::Lifted_surface lifted(surface, normals, smoothing.feature_weight * std::sqrt(geometry.total_area));
  internal::Boundary_smoother smooth(surface, lifted, segment_of_face,
                                     internal::curve_smoothing_numbers(smoothing, surface.mean_edge_length()));
  const std::vector<internal::Surface_curve> smoothed =
      smooth(internal::sharp_halfedges(surface, normals, smoothing.crease_angle), progress.part(0.5, 1));

  std::vector<Boundary_curve<TriangleMesh>> curves;
  for (const internal::Surface_curve& curve : smoothed) {
    Boundary_curve<TriangleMesh> result;
    result.is_closed = curve.is_closed;
    result.is_smoothed = smooth.is_smoothed()[curves.size()];
    result.segments = curve.segments;
    for (const internal::Curve_node& node : curve.nodes)
      result.points.push_back(internal::boundary_point(node, mesh, graph, surface, np));
    curves.push_back(std::move(result));
  }
  progress(1);
  return curves;
}

}  // namespace RW_segmentation

#endif
