// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_PARTS_IN_BOXES_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_PARTS_IN_BOXES_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/mesh/Face_geometry.h>
#include <RW_segmentation/internal/surfaces/Cut_facets.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/out_of_box.h>
#include <RW_segmentation/internal/surfaces/rounding_step.h>

#include <Eigen/Geometry>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// A mesh with its small parts in unit boxes of their own, so that each is segmented as if it was alone: what is exact
/// enough for an assembly is not exact enough for its screws.
///
/// Parts are connected, by a vertex at the least, or by a segment.
class Parts_in_boxes {
 public:
  using Index = Dual_mesh::Index;

  /// The mesh as it is.
  explicit Parts_in_boxes(const Dual_mesh& mesh) : mesh_(mesh) {}

  /// \param segment_of_face empty if there are none
  /// Complexity: linear, but for the inverse of Ackermann's function.
  Parts_in_boxes(const Dual_mesh& mesh, const std::vector<std::size_t>& segment_of_face) : mesh_(mesh) {
    std::vector<Index> part = parts_of_vertices(mesh, segment_of_face);
    std::vector<Unit_box> boxes = boxes_of_parts(mesh, part);
    if (std::all_of(boxes.begin(), boxes.end(), [](const Unit_box& box) { return box.unit == 1; })) return;
    part_ = std::move(part);
    boxes_ = std::move(boxes);
    std::vector<Eigen::Vector3d> points = mesh.points();
    for (Index v = 0; v < part_.size(); ++v) points[v] = box(v).scaled(points[v]);
    mesh_ = mesh.with_points(std::move(points)).with_shape_normals_of(mesh);
  }

  bool has_small_parts() const { return !boxes_.empty(); }
  const Dual_mesh& mesh() const { return mesh_; }

  /// A surface of this mesh as one of the mesh that this was made of.
  /// \param vertex of its faces
  Analytic_surface in_whole(const Analytic_surface& surface, Index vertex) const {
    return has_small_parts() ? out_of_box(surface, box(vertex).unit, box(vertex).origin) : surface;
  }

 private:
  /// The lowest vertex of the part of each.
  static std::vector<Index> parts_of_vertices(const Dual_mesh& mesh, const std::vector<std::size_t>& segment_of_face) {
    constexpr Index none = std::numeric_limits<Index>::max();
    boost::disjoint_sets_with_storage<> parts(mesh.number_of_vertices());
    std::vector<Index> vertex_of_segment;
    for (Index f = 0; f < mesh.number_of_faces(); ++f) {
      const auto corners = mesh.corners(f);
      for (const Index v : corners) parts.union_set(corners[0], v);
      if (segment_of_face.empty()) continue;
      const std::size_t segment = segment_of_face[f];
      if (segment >= vertex_of_segment.size()) vertex_of_segment.resize(segment + 1, none);
      if (vertex_of_segment[segment] == none) vertex_of_segment[segment] = corners[0];
      parts.union_set(corners[0], vertex_of_segment[segment]);
    }
    std::vector<Index> lowest(mesh.number_of_vertices(), none), part(mesh.number_of_vertices());
    for (Index v = 0; v < part.size(); ++v) {
      Index& first = lowest[parts.find_set(v)];
      first = std::min(first, v);
      part[v] = first;
    }
    return part;
  }

  /// By the lowest vertex. The box of a large part is that of the whole, and none is so small that coordinates which were
  /// rounded would not count as exact in it.
  static std::vector<Unit_box> boxes_of_parts(const Dual_mesh& mesh, const std::vector<Index>& part) {
    constexpr double large = 0.5;                   // the diagonal
    constexpr double single_precision_unit = 1e-2;  // coordinates are exact to 1e-7 of the whole
    const double least_unit =
        std::max(single_precision_unit, deviation_of_rounding(mesh.points()) / Surface_tolerance::least_slight_noise);
    std::vector<Eigen::AlignedBox3d> around(part.size());
    for (Index f = 0; f < mesh.number_of_faces(); ++f)
      for (const Index v : mesh.corners(f)) around[part[v]].extend(mesh.point(v));
    std::vector<Unit_box> boxes(part.size());
    for (std::size_t v = 0; v < part.size(); ++v) {
      if (around[v].isEmpty()) continue;
      const double unit = std::max(around[v].diagonal().norm(), least_unit);
      if (unit >= large) continue;
      boxes[v].unit = unit;
      boxes[v].origin = around[v].center();
    }
    return boxes;
  }

  const Unit_box& box(Index vertex) const { return boxes_[part_[vertex]]; }

  Dual_mesh mesh_;
  std::vector<Index> part_;      // by vertex; empty if no part is small
  std::vector<Unit_box> boxes_;  // by the lowest vertex of a part; likewise
};

/// The mesh with walls between its segments.
inline Dual_mesh with_walls_between(const Dual_mesh& mesh, const std::vector<std::size_t>& segment_of_face) {
  std::vector<char> is_wall;
  is_wall.reserve(mesh.number_of_edges());
  for (Dual_mesh::Index e = 0; e < mesh.number_of_edges(); ++e) {
    const auto& [f, g] = mesh.graph().faces_of(e);
    is_wall.push_back(segment_of_face[f] != segment_of_face[g]);
  }
  return mesh.with_walls(std::move(is_wall));
}

/// A mesh with its tolerance: if it is clean, its parts in boxes of their own, and facets that were cut whole. Noise is that of
/// all its faces.
struct Tolerated_mesh {
  Parts_in_boxes parts;
  Cut_facets facets;            ///< of the mesh of the parts
  Surface_tolerance tolerance;  ///< of the mesh of the facets

  /// \param noise see `surface_tolerance()`
  /// \param segment_of_face each segment is kept in one box, and facets end where it does; empty if there are none
  Tolerated_mesh(const Dual_mesh& whole, double noise, const std::vector<std::size_t>& segment_of_face = {})
      : parts(whole, segment_of_face),
        facets(segment_of_face.empty() ? parts.mesh() : with_walls_between(parts.mesh(), segment_of_face),
               Surface_tolerance::cad_exactness),
        tolerance(surface_tolerance(facets.mesh(), noise)) {
    if (!tolerance.has_noise() || (!parts.has_small_parts() && !facets.are_any())) return;
    parts = Parts_in_boxes(whole);
    facets = Cut_facets(whole);
    tolerance = surface_tolerance(whole, noise);
  }

  const Dual_mesh& mesh() const { return facets.mesh(); }
};

}  // namespace RW_segmentation::internal

#endif
