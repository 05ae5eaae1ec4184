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

/// A point on an edge of a mesh, or at one of its ends.
template <class TriangleMesh>
struct Boundary_point {
  using halfedge_descriptor = typename boost::graph_traits<TriangleMesh>::halfedge_descriptor;
  /// The point type of the mesh.
  using Point = typename boost::property_traits<
      typename boost::property_map<TriangleMesh, CGAL::vertex_point_t>::const_type>::value_type;

  halfedge_descriptor halfedge;  ///< of the edge
  double position = 1;           ///< from the source of the halfedge, 0, to its target, 1
  Point point;                   ///< where that is
};

/// A curve on a mesh, the boundary between two segments: a polyline whose points lie on edges or at vertices and whose
/// lines run across faces or along edges. Two consecutive points always belong to one face.
template <class TriangleMesh>
struct Boundary_curve {
  std::vector<Boundary_point<TriangleMesh>> points;  ///< from one end to the other
  bool is_closed = false;                            ///< whether the first point follows the last
  bool is_smoothed = false;               ///< false where it runs along the edges of the mesh, as it did before
  std::array<std::size_t, 2> segments{};  ///< the ids on the left and on the right, seen from outside
};

/// A point of a curve as a face and barycentric coordinates, which is a `Face_location` of CGAL's
/// Polygon_mesh_processing: the coordinates belong to the source and the target of `halfedge(face, mesh)` and to the
/// third corner.
/// \pre the halfedge has a face
template <class TriangleMesh>
std::pair<typename boost::graph_traits<TriangleMesh>::face_descriptor, std::array<double, 3>> face_location(
    const Boundary_point<TriangleMesh>& point, const TriangleMesh& mesh) {
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
