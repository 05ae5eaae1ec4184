// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_BOUNDARY_CURVE_H
#define RW_SEGMENTATION_BOUNDARY_CURVE_H

#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// The point type of a mesh.
template <class FaceListGraph>
using Mesh_point = typename boost::property_traits<
    typename boost::property_map<FaceListGraph, CGAL::vertex_point_t>::const_type>::value_type;

}  // namespace internal

/// A point on an edge of a mesh, or at one of its ends.
/// \tparam Point_ the point type of the `vertex_point_map` that the curve was made with (default: that of the mesh)
template <class TriangleMesh, class Point_ = internal::Mesh_point<TriangleMesh>>
struct Boundary_point {
  using halfedge_descriptor = typename boost::graph_traits<TriangleMesh>::halfedge_descriptor;
  /// That point type.
  using Point = Point_;

  halfedge_descriptor halfedge;  ///< of the edge
  double position = 1;           ///< from the source of the halfedge, 0, to its target, 1
  Point point;                   ///< where that is
};

/// How the points that a curve was smoothed in were joined.
struct Joining_report {
  std::size_t joints = 0;    ///< pairs of consecutive points in different faces
  std::size_t failures = 0;  ///< those of them where the joining failed, so that the line was traced
};

/// A curve on a mesh, the boundary between two segments: a polyline whose points lie on edges or at vertices and whose
/// lines run across faces or along edges. Two consecutive points always belong to one face.
/// \tparam Point see `Boundary_point`
template <class TriangleMesh, class Point = internal::Mesh_point<TriangleMesh>>
struct Boundary_curve {
  std::vector<Boundary_point<TriangleMesh, Point>> points;  ///< from one end to the other
  bool is_closed = false;                                   ///< whether the first point follows the last
  bool is_smoothed = false;               ///< false where it runs along the edges of the mesh, as it did before
  std::array<std::size_t, 2> segments{};  ///< the ids on the left and on the right, seen from outside
  Joining_report joining;                 ///< nothing where the curve is not smoothed
};

/// A point of a curve as a face and barycentric coordinates, which is a `Face_location` of CGAL's
/// Polygon_mesh_processing: the coordinates belong to the source and the target of `halfedge(face, mesh)` and to the
/// third corner.
/// \pre the halfedge has a face
template <class TriangleMesh, class Point>
std::pair<typename boost::graph_traits<TriangleMesh>::face_descriptor, std::array<double, 3>> face_location(
    const Boundary_point<TriangleMesh, Point>& point, const TriangleMesh& mesh) {
  const auto f = face(point.halfedge, mesh);
  std::size_t corner = 0;
  for (auto h = halfedge(f, mesh); h != point.halfedge; h = next(h, mesh)) ++corner;
  std::array<double, 3> coordinates = {0, 0, 0};
  coordinates[corner] = 1 - point.position;
  coordinates[(corner + 1) % 3] = point.position;
  return {f, coordinates};
}

}  // namespace RW_segmentation

#endif
