// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TILE_H
#define RW_SEGMENTATION_TILE_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/mesh/Face_corners.h>
#include <RW_segmentation/internal/mesh/Mesh_reading.h>
#include <RW_segmentation/internal/named_parameters.h>

#include <CGAL/Named_function_parameters.h>

#include <Eigen/Core>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// A piece of a mesh that is too large for one machine, as plain arrays. Tiles meet where vertices on their borders are
/// the same: in the same place, or with the same id.
struct Tile {
  std::vector<Eigen::Vector3d> points;    ///< by vertex, finite, in the unit of the whole mesh
  internal::Face_corners corners;         ///< by face: its vertices, counterclockwise from outside
  std::vector<std::uint64_t> vertex_ids;  ///< by vertex: the same in all tiles; empty: places tell which are the same

  /// The number of faces.
  std::size_t number_of_faces() const { return corners.number_of_faces(); }
};

/// A tile together with the faces of the mesh that it was read from.
template <class FaceListGraph>
struct Tile_of : Tile {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  std::vector<face_descriptor> face_descriptors;  ///< by face

  /// Reads a mesh as a tile.
  ///
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh, its faces oriented outward
  /// \param np `vertex_point_map` (default: that of the mesh)
  /// \throws std::invalid_argument if a coordinate is not finite (names the vertex)
  /// \throws std::length_error if there are 2^32 - 1 faces, halfedges or vertices, or more
  /// Complexity: linear.
  template <class NamedParameters = CGAL::parameters::Default_named_parameters>
  explicit Tile_of(const FaceListGraph& mesh, const NamedParameters& np = CGAL::parameters::default_values()) {
    static_assert(internal::has_only<NamedParameters, internal::Vertex_point>,
                  "Tile_of takes the named parameter vertex_point_map.");
    internal::Mesh_reading<FaceListGraph> reading(mesh, true);
    points = internal::read_points(mesh, reading.vertex_descriptors, np);
    corners = std::move(reading.corners);
    face_descriptors = std::move(reading.descriptors.face_descriptors);
  }
};

}  // namespace RW_segmentation

#endif
