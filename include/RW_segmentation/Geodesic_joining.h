// SPDX-License-Identifier: MIT
// Needs CGAL's package Surface_mesh_shortest_path, which is under the GPL: so is a program that includes this header.
#ifndef RW_SEGMENTATION_GEODESIC_JOINING_H
#define RW_SEGMENTATION_GEODESIC_JOINING_H

#include <RW_segmentation/internal/boundary/Curve_joint.h>
#include <RW_segmentation/internal/boundary/Surface_curve.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>
#include <CGAL/exceptions.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace RW_segmentation {
namespace internal {

/// The faces round a joint, a mesh by itself, and the shortest path over them.
class Geodesic_band {
 public:
  using Index = Triangle_surface::Index;

  explicit Geodesic_band(const Curve_joint& joint) : joint_(joint), surface_(joint.surface) {
    for (const Index f : with_neighbours(traced_faces()))
      if (is_proper(f)) add(f);
  }

  /// The crossings of the path; none where CGAL finds no path, or what is none.
  std::optional<std::vector<Curve_node>> path() const {
    const auto end = face_of_.find(joint_.to.place.face);
    if (!is_complete_ || end == face_of_.end()) return std::nullopt;
    Shortest_path shortest(mesh_);
    shortest.add_source_point(end->second, weights(joint_.to.place));
    Crossings crossings{*this, {}};
    if (joint_.from.is_fixed()) {
      const auto vertex = vertex_of_.find(joint_.from.vertex);
      if (vertex == vertex_of_.end()) return std::nullopt;
      shortest.shortest_path_sequence_to_source_points(vertex->second, crossings);
    } else {
      const auto face = face_of_.find(joint_.from.place.face);
      if (face == face_of_.end()) return std::nullopt;
      shortest.shortest_path_sequence_to_source_points(face->second, weights(joint_.from.place), crossings);
    }
    std::vector<Curve_node>& nodes = crossings.nodes;
    if (joint_.from.is_fixed() && !nodes.empty() && nodes.front().vertex == joint_.from.vertex)
      nodes.erase(nodes.begin());
    if (!is_path(nodes)) return std::nullopt;
    for (Curve_node& node : nodes)
      if (!node.is_vertex()) node = crossing(surface_, node.edge, node.position, joint_.from.origin);
    return std::move(nodes);
  }

 private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>;
  using Shortest_path = CGAL::Surface_mesh_shortest_path<Traits>;
  using Weights = Traits::Barycentric_coordinates;

  /// Receives a path from CGAL.
  struct Crossings {
    const Geodesic_band& band;
    std::vector<Curve_node> nodes;

    void operator()(Mesh::Halfedge_index h, double position) {
      const bool is_outside = band.mesh_.is_border(h);
      const Index number = band.number_of_.at(is_outside ? band.mesh_.opposite(h) : h);
      const Index edge = band.surface_.edge(number);
      const bool is_along = (edge == number) != is_outside;
      nodes.push_back({Triangle_surface::none, edge, is_along ? position : 1 - position, 0});
    }
    void operator()(Mesh::Vertex_index v) {
      nodes.push_back({band.vertices_[v], Triangle_surface::none, 0, band.joint_.from.origin});
    }
    void operator()(Mesh::Face_index, const Weights&) {}  // an end
  };

  // ---- The band ----

  std::set<Index> traced_faces() const {
    std::set<Index> faces = {joint_.to.place.face};
    for (const Curve_node& node : joint_.traced)
      for (const Index h : {node.edge, surface_.twin(node.edge)}) faces.insert(Triangle_surface::face(h));
    return faces;
  }

  /// The faces that share a vertex with one of them.
  std::set<Index> with_neighbours(const std::set<Index>& faces) const {
    std::set<Index> result;
    for (const Index f : faces)
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        surface_.any_leaving(surface_.source(h), [&](Index leaving) {
          result.insert(Triangle_surface::face(leaving));
          return false;
        });
    return result;
  }

  /// Whether a face can be laid out flat.
  bool is_proper(Index face) const {
    constexpr double least_height = 1e-10;  // relative to the longest side
    const Index h = 3 * face;
    const double side = std::max({surface_.length(h), surface_.length(h + 1), surface_.length(h + 2)});
    const Eigen::Vector3d& apex = surface_.point(surface_.source(h));
    const Eigen::Vector3d area =
        (surface_.point(surface_.source(h + 1)) - apex).cross(surface_.point(surface_.source(h + 2)) - apex);
    return area.norm() > least_height * side * side;
  }

  void add(Index face) {
    std::array<Mesh::Vertex_index, 3> corners;
    for (Index k = 0; k < 3; ++k) {
      const Index v = surface_.source(3 * face + k);
      const auto [place, is_new] = vertex_of_.try_emplace(v);
      if (is_new) {
        const Eigen::Vector3d& p = surface_.point(v);
        place->second = mesh_.add_vertex({p.x(), p.y(), p.z()});
        vertices_.push_back(v);
      }
      corners[k] = place->second;
    }
    const Mesh::Face_index f = mesh_.add_face(corners);
    is_complete_ = is_complete_ && f != Mesh::null_face();
    if (!is_complete_) return;
    face_of_[face] = f;
    for (Index k = 0; k < 3; ++k) number_of_[mesh_.halfedge(corners[k], corners[(k + 1) % 3])] = 3 * face + k;
  }

  // ---- The path ----

  /// As CGAL numbers corners: the source of a face's halfedge, its target, and the third one.
  Weights weights(const Surface_place& place) const {
    const Mesh::Halfedge_index first = mesh_.halfedge(face_of_.at(place.face));
    Weights result;
    auto h = first;
    for (double& weight : result) {
      weight = place.weight[number_of_.at(h) % 3];
      h = mesh_.next(h);
    }
    return result;
  }

  /// Whether consecutive nodes lie in one face, and the way is no longer than the traced one.
  bool is_path(const std::vector<Curve_node>& nodes) const {
    constexpr double rounding = 1e-9;
    if (nodes.empty()) return false;
    std::set<Index> here = faces_at(joint_.from);
    const auto shares_face = [&](const std::set<Index>& there) {
      const bool result = std::any_of(there.begin(), there.end(), [&](Index f) { return here.count(f) > 0; });
      here = there;
      return result;
    };
    for (const Curve_node& node : nodes)
      if (!shares_face(faces_at(node))) return false;
    return shares_face({joint_.to.place.face}) && length(nodes) <= length(joint_.traced) * (1 + rounding);
  }

  std::set<Index> faces_at(const Curve_point& point) const {
    return point.is_fixed() ? faces_round(point.vertex) : std::set<Index>{point.place.face};
  }
  std::set<Index> faces_at(const Curve_node& node) const {
    if (node.is_vertex()) return faces_round(node.vertex);
    return {Triangle_surface::face(node.edge), Triangle_surface::face(surface_.twin(node.edge))};
  }
  std::set<Index> faces_round(Index vertex) const {
    std::set<Index> faces;
    surface_.any_leaving(vertex, [&](Index h) {
      faces.insert(Triangle_surface::face(h));
      return false;
    });
    return faces;
  }

  double length(const std::vector<Curve_node>& nodes) const {
    double sum = 0;
    Eigen::Vector3d last = point_of(surface_, joint_.from);
    const auto go_to = [&](const Eigen::Vector3d& p) {
      sum += (p - last).norm();
      last = p;
    };
    for (const Curve_node& node : nodes) go_to(point_of(surface_, node));
    go_to(point_of(surface_, joint_.to));
    return sum;
  }

  const Curve_joint& joint_;
  const Triangle_surface& surface_;
  Mesh mesh_;
  bool is_complete_ = true;
  std::vector<Index> vertices_;  // by vertex of the band
  std::map<Index, Mesh::Vertex_index> vertex_of_;
  std::map<Index, Mesh::Face_index> face_of_;
  std::map<Mesh::Halfedge_index, Index> number_of_;  // a halfedge of the surface
};

}  // namespace internal

/// Joins consecutive points of a boundary by shortest paths over the surface: CGAL's `Surface_mesh_shortest_path` on a
/// band of faces, those that the traced line runs through and their neighbours. Where CGAL finds none, the line is traced
/// as by `Traced_joining`; `Boundary_curve::joining` counts how often.
///
/// \code
/// const auto curves = smooth_boundaries(mesh, ids, {}, Geodesic_joining());
/// \endcode
class Geodesic_joining {
 public:
  /// The crossings of the shortest path, none where CGAL fails.
  std::optional<std::vector<internal::Curve_node>> operator()(const internal::Curve_joint& joint) const {
    try {
      return internal::Geodesic_band(joint).path();
    } catch (const CGAL::Failure_exception&) {
      return std::nullopt;
    }
  }
};

}  // namespace RW_segmentation

#endif
