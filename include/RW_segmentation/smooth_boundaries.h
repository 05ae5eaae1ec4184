// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_SMOOTH_BOUNDARIES_H
#define RW_SEGMENTATION_SMOOTH_BOUNDARIES_H

#include <RW_segmentation/Boundary_curve.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/boundary/Border_crossing.h>
#include <RW_segmentation/internal/boundary/Curve_joint.h>
#include <RW_segmentation/internal/boundary/Surface_curve.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>
#include <RW_segmentation/internal/boundary/Walled_surface.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/threads.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>
#include <CGAL/tags.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
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
void require_boundary_smoothing_numbers(const Boundary_smoothing& smoothing);

/// The boundaries in the unit box.
/// \param crossings where boundaries end in place of vertices on the border
std::vector<Surface_curve> smoothed_curves(const Dual_mesh& mesh, const Walled_surface& surface,
                                           const std::vector<std::size_t>& segment_of_face,
                                           const Boundary_smoothing& smoothing, const Curve_joining& joining,
                                           const std::vector<Border_crossing>& crossings, const Progress& progress);

/// Tells where a halfedge begins, in the mesh's coordinates.
template <class FaceListGraph, class NamedParameters>
auto source_points(const FaceListGraph& mesh, const Dual_mesh_of<FaceListGraph>& dual, const NamedParameters& np) {
  const auto points =
      CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_point),
                                         CGAL::get_const_property_map(CGAL::vertex_point, mesh));
  return [points, &mesh, &dual](Triangle_surface::Index h) {
    const auto& p = get(points, source(descriptor_of_halfedge(h, dual), mesh));
    return Eigen::Vector3d(CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2]));
  };
}

/// A dual mesh has no other points than those in the unit box.
template <class FaceListGraph, class NamedParameters>
auto source_points(const Dual_mesh_of<FaceListGraph>& mesh, const Dual_mesh_of<FaceListGraph>&,
                   const NamedParameters&) {
  return [&mesh](Triangle_surface::Index h) -> Eigen::Vector3d {
    return mesh.origin() + mesh.unit() * mesh.point(Triangle_surface::corner(mesh, h));
  };
}

/// The curves as polylines on the mesh.
/// \param source_point from the number of a halfedge to the point where it begins
template <class Point, class Mesh, class SourcePoint>
std::vector<Boundary_curve<Mesh, Point>> boundary_curves(const std::vector<Surface_curve>& curves,
                                                         const Dual_mesh_of<Mesh>& mesh,
                                                         const Triangle_surface& surface,
                                                         const SourcePoint& source_point) {
  std::vector<Boundary_curve<Mesh, Point>> result;
  for (const Surface_curve& curve : curves) {
    result.push_back({{}, curve.is_closed, curve.is_smoothed, curve.segments, curve.joining});
    for (const Curve_node& node : curve.nodes) {
      const auto h = node.is_vertex() ? Triangle_surface::previous(surface.leaving(node.vertex)) : node.edge;
      const double t = node.is_vertex() ? 1 : node.position;
      const Eigen::Vector3d p = point_between(source_point(h), source_point(Triangle_surface::next(h)), t);
      result.back().points.push_back({descriptor_of_halfedge(h, mesh), t, Point(p.x(), p.y(), p.z())});
    }
  }
  return result;
}

/// Smooths the boundaries of a mesh that has been read.
/// \param mesh what `dual` was read from, or `dual` itself
template <class FaceListGraph, class SegmentIdMap, class NamedParameters>
auto smoothed_boundaries(const FaceListGraph& mesh, const Dual_mesh_of<typename Mesh_type<FaceListGraph>::type>& dual,
                         const SegmentIdMap& segment_ids, const Boundary_smoothing& smoothing,
                         const Curve_joining& joining, const std::vector<Border_crossing>& crossings,
                         const NamedParameters& np) {
  using Mesh = typename Mesh_type<FaceListGraph>::type;
  using Vertex_points = typename CGAL::GetVertexPointMap<Mesh, NamedParameters>::const_type;
  using Point = typename boost::property_traits<Vertex_points>::value_type;
  const Progress progress = progress_of(np);
  require_triangles(dual);
  const auto segment_of_face = dual.read_faces(segment_ids, [](auto id) { return static_cast<std::size_t>(id); });
  const Walled_surface surface(dual);
  const std::vector<Surface_curve> curves =
      smoothed_curves(dual, surface, segment_of_face, smoothing, joining, crossings, progress);
  auto result = boundary_curves<Point>(curves, dual, surface.whole(), source_points(mesh, dual, np));
  progress(1);
  return result;
}

}  // namespace internal

/// Joins consecutive points of a boundary by the plane that holds both of them and the normal between them; where the
/// surface folds, over as few faces as can be. `smooth_boundaries()` takes this or a `Geodesic_joining`.
struct Traced_joining {
  /// What was traced.
  std::vector<internal::Curve_node> operator()(const internal::Curve_joint& joint) const { return joint.traced; }
};

/// Smooths the boundaries between the segments of a mesh, which run along edges and are jagged therefore, and keeps
/// them on creases (3.2).
///
/// Boundaries are taken apart at their branch points: the vertices where more than two segments meet, where a boundary
/// meets the border of the mesh, or where it comes to a wall or leaves it. These stay where they are, and so do boundaries
/// along walls. Each other boundary between two of them, and each closed one, becomes a spline in tension: implicit steps
/// down
///
///   E = sum |p(i+1) - 2 p(i) + p(i-1)|^2 + tension sum |p(i+1) - p(i)|^2,
///
/// with p in R^6, a point x of the surface and its smoothed normal n as (x, w n) (Lai et al. 2007, Hofer and Pottmann
/// 2004). After each step the points are put back on the surface by walking from face to face, so that they never get
/// to another sheet of it. Where a boundary follows a crease it keeps to its edges.
///
/// The curves do not cross each other or themselves, and each segment keeps its neighbours and stays in one piece if it
/// was; no curve crosses a wall. A curve that would break this is moved less, or stays as it was. So do curves of a single
/// edge, those around a single face or vertex, and those that lie on creases all along. No curve leaves its edges by more
/// than the policy allows: smoothness does not come from shrinking.
///
/// \code
/// const auto curves = smooth_boundaries(mesh, ids);
/// split_along_boundaries(mesh, curves, ids);  // if the mesh may be changed
/// \endcode
///
/// Complexity: O(m) for the normals of m faces, and O(k b) for k steps on b boundary edges.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`, all faces triangles, or a `Dual_mesh_of` one
/// \tparam SegmentIdMap a readable property map from `face_descriptor` to an integer
/// \tparam Joining `Traced_joining` or `Geodesic_joining`
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh
/// \param segment_ids the segment of each face
/// \param smoothing how smooth
/// \param joining how consecutive points of a boundary are joined
/// \param np `vertex_point_map` (default: that of the mesh), `edge_is_constrained_map` (readable map from
/// `edge_descriptor` to `bool`, default: no edge is): the walls, `callback` (`std::function<bool(double)>`, default: none)
/// \returns a curve for each boundary, open ones first
/// \throws std::runtime_error if a boundary runs along two edges between the same two vertices
/// \throws std::invalid_argument if a face is no triangle, a coordinate is not finite, or a number of the policy is out
/// of range
/// \throws Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap,
          class Joining = Traced_joining, class NamedParameters = CGAL::parameters::Default_named_parameters>
auto smooth_boundaries(const FaceListGraph& mesh, const SegmentIdMap& segment_ids,
                       const Boundary_smoothing& smoothing = {}, const Joining& joining = {},
                       const NamedParameters& np = CGAL::parameters::default_values()) {
  static_assert(
      internal::has_only_names_of_stages<NamedParameters>,
      "smooth_boundaries() takes the named parameters vertex_point_map, edge_is_constrained_map and callback.");
  static_assert(std::is_constructible_v<internal::Curve_joining, const Joining&>,
                "joining must be a Traced_joining or a Geodesic_joining.");
  internal::require_boundary_smoothing_numbers(smoothing);
  return internal::with_threads<ConcurrencyTag>([&] {
    const auto& dual = internal::dual_mesh(mesh, np);
    return internal::smoothed_boundaries(mesh, dual, segment_ids, smoothing, joining, {}, np);
  });
}

/// Named parameters may follow the numbers directly.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap, class T,
          class Tag, class Base>
auto smooth_boundaries(const FaceListGraph& mesh, const SegmentIdMap& segment_ids, const Boundary_smoothing& smoothing,
                       const CGAL::Named_function_parameters<T, Tag, Base>& np) {
  return smooth_boundaries<ConcurrencyTag>(mesh, segment_ids, smoothing, Traced_joining(), np);
}

/// Named parameters may follow the segments directly.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class SegmentIdMap, class T,
          class Tag, class Base>
auto smooth_boundaries(const FaceListGraph& mesh, const SegmentIdMap& segment_ids,
                       const CGAL::Named_function_parameters<T, Tag, Base>& np) {
  return smooth_boundaries<ConcurrencyTag>(mesh, segment_ids, Boundary_smoothing(), Traced_joining(), np);
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/smooth_boundaries.h>
#endif

#endif
