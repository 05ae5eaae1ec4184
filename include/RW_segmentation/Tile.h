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

#include <algorithm>
#include <array>
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
  /// Edges that no stage crosses, each by its two vertices. One at the border between two tiles counts if either has it.
  std::vector<std::array<Dual_mesh::Index, 2>> walls;

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
  /// \param np `vertex_point_map` (default: that of the mesh), `edge_is_constrained_map` (readable map from
  /// `edge_descriptor` to `bool`, default: no edge is): the walls, those on the border of the mesh included
  /// \throws std::invalid_argument if a coordinate is not finite (names the vertex)
  /// \throws std::length_error if there are 2^32 - 1 faces, halfedges or vertices, or more
  /// Complexity: linear.
  template <class NamedParameters = CGAL::parameters::Default_named_parameters>
  explicit Tile_of(const FaceListGraph& mesh, const NamedParameters& np = CGAL::parameters::default_values()) {
    static_assert(internal::has_only<NamedParameters, internal::Vertex_point, internal::Edge_is_constrained>,
                  "Tile_of takes the named parameters vertex_point_map and edge_is_constrained_map.");
    internal::Mesh_reading<FaceListGraph> reading(mesh, true);
    points = internal::read_points(mesh, reading.vertex_descriptors, np);
    corners = std::move(reading.corners);
    face_descriptors = std::move(reading.descriptors.face_descriptors);
    if constexpr (internal::has_parameter<NamedParameters, internal::Edge_is_constrained>)
      read_walls(mesh, CGAL::parameters::get_parameter(np, CGAL::internal_np::edge_is_constrained));
  }

 private:
  /// An edge between two faces is read from both.
  template <class EdgeMap>
  void read_walls(const FaceListGraph& mesh, const EdgeMap& is_wall) {
    for (Dual_mesh::Index f = 0; f < number_of_faces(); ++f) {
      const auto vertices = corners[f];
      auto side = halfedge(face_descriptors[f], mesh);
      Dual_mesh::Index source = vertices[vertices.size() - 1];  // the first halfedge leads to the first corner
      for (const Dual_mesh::Index target : vertices) {
        if (get(is_wall, edge(side, mesh))) walls.push_back({std::min(source, target), std::max(source, target)});
        source = target;
        side = next(side, mesh);
      }
    }
    std::sort(walls.begin(), walls.end());
    walls.erase(std::unique(walls.begin(), walls.end()), walls.end());
  }
};

}  // namespace RW_segmentation

#endif
