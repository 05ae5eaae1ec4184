// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_TRIANGLE_SURFACE_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_TRIANGLE_SURFACE_H

#include <RW_segmentation/Dual_mesh.h>

#include <Eigen/Core>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// A triangle mesh by its halfedges: what curves are moved on and cut by.
///
/// Faces are numbered as in the `Dual_mesh`. Halfedge 3 f + k runs along face f from its corner k to the next one; corner
/// 0 is the source of `halfedge(f, mesh)`. Where several fans of faces touch in a vertex, each has a vertex of its own:
/// going round one meets all its faces.
class Triangle_surface {
 public:
  using Index = Dual_mesh::Index;
  static constexpr Index none = std::numeric_limits<Index>::max();

  explicit Triangle_surface(const Dual_mesh& mesh) : Triangle_surface(mesh, [](Index) { return true; }) {}

  /// The mesh cut open along the edges that do not join their faces.
  /// \param mesh all faces triangles
  /// \param joins a function from an edge of the mesh to `bool`
  template <class Joins>
  Triangle_surface(const Dual_mesh& mesh, const Joins& joins)
      : Triangle_surface(mesh.points(), sources_of(mesh), twins_of(mesh, joins)) {}

  /// \param points in the unit box
  /// \param sources of the halfedges
  /// \param twins of the halfedges, `none` where the mesh ends
  Triangle_surface(std::vector<Eigen::Vector3d> points, std::vector<Index> sources, std::vector<Index> twins)
      : point_(std::move(points)),
        source_(std::move(sources)),
        twin_(std::move(twins)),
        outgoing_(point_.size(), none) {
    std::vector<char> is_met(number_of_halfedges(), false);
    for (Index h = 0; h < number_of_halfedges(); ++h) {
      if (is_met[h]) continue;
      const Index vertex = outgoing_[source(h)] == none ? source(h) : one_more_at(source(h));
      outgoing_[vertex] = h;
      any_leaving(vertex, [&](Index leaving) {
        is_met[leaving] = true;
        source_[leaving] = vertex;
        return false;
      });
    }
  }

  /// The vertex of a mesh of triangles that a halfedge leaves.
  static Index corner(const Dual_mesh& mesh, Index halfedge) {
    return mesh.corners(face(halfedge))[(halfedge + 2) % 3];
  }

  std::size_t number_of_faces() const { return source_.size() / 3; }
  std::size_t number_of_vertices() const { return point_.size(); }
  std::size_t number_of_halfedges() const { return source_.size(); }

  static Index face(Index h) { return h / 3; }
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index source(Index h) const { return source_[h]; }
  Index target(Index h) const { return source_[next(h)]; }
  Index twin(Index h) const { return twin_[h]; }
  bool is_border(Index h) const { return twin_[h] == none; }
  /// The lower of the two halfedges of an edge stands for it.
  Index edge(Index h) const { return std::min(h, twin_[h]); }

  const Eigen::Vector3d& point(Index vertex) const { return point_[vertex]; }
  /// The point at `position` of the way from the source to the target of a halfedge.
  Eigen::Vector3d point_on(Index h, double position) const {
    return (1 - position) * point(source(h)) + position * point(target(h));
  }
  double length(Index h) const { return (point(target(h)) - point(source(h))).norm(); }
  double mean_edge_length() const {
    double sum = 0, edges = 0;
    for (Index h = 0; h < number_of_halfedges(); ++h) {
      if (edge(h) != h) continue;
      sum += length(h);
      ++edges;
    }
    return edges == 0 ? 0 : sum / edges;
  }

  /// One of the halfedges that leave a vertex.
  Index leaving(Index vertex) const { return outgoing_[vertex]; }

  /// Calls `visit(h)` for the halfedges that leave a vertex, one in each face around it, until it returns true.
  /// \returns whether it did
  template <class Visitor>
  bool any_leaving(Index vertex, const Visitor& visit) const {
    const Index first = outgoing_[vertex];
    if (first == none) return false;
    Index h = first;
    do {
      if (visit(h)) return true;
      h = twin(previous(h));
    } while (h != none && h != first);
    if (h == first) return false;
    for (h = twin(first); h != none; h = twin(h)) {  // the mesh ends here: the other way round
      h = next(h);
      if (visit(h)) return true;
    }
    return false;
  }

  bool is_on_border(Index vertex) const {
    return any_leaving(vertex, [&](Index h) { return is_border(h) || is_border(previous(h)); });
  }

 private:
  static std::vector<Index> sources_of(const Dual_mesh& mesh) {
    std::vector<Index> sources;
    sources.reserve(3 * mesh.number_of_faces());
    for (Index h = 0; h < 3 * mesh.number_of_faces(); ++h) sources.push_back(corner(mesh, h));
    return sources;
  }

  template <class Joins>
  static std::vector<Index> twins_of(const Dual_mesh& mesh, const Joins& joins) {
    std::vector<Index> twins(3 * mesh.number_of_faces(), none);
    const auto side = [&](Index face, Index from, Index to) {
      Index h = 3 * face;
      while (corner(mesh, h) != from || corner(mesh, next(h)) != to) ++h;
      return h;
    };
    for (Index e = 0; e < mesh.number_of_edges(); ++e) {
      if (!joins(e)) continue;
      const auto [f, g] = mesh.graph().faces_of(e);
      const auto [a, b] = mesh.ends(e);
      const Index h = side(f, a, b), twin = side(g, b, a);
      twins[h] = twin;
      twins[twin] = h;
    }
    return twins;
  }

  Index one_more_at(Index vertex) {
    point_.push_back(Eigen::Vector3d(point_[vertex]));
    outgoing_.push_back(none);
    return static_cast<Index>(outgoing_.size() - 1);
  }

  std::vector<Eigen::Vector3d> point_;
  std::vector<Index> source_, twin_, outgoing_;
};

/// The halfedge of the mesh that a number stands for.
template <class FaceListGraph>
auto descriptor_of_halfedge(Triangle_surface::Index number, const Dual_mesh_of<FaceListGraph>& mesh) {
  auto h = halfedge(mesh.face(Triangle_surface::face(number)), mesh.mesh());
  for (auto k = number % 3; k > 0; --k) h = next(h, mesh.mesh());
  return h;
}

/// The number of a halfedge of the mesh, `none` where it has no face.
template <class FaceListGraph>
Triangle_surface::Index number_of_halfedge(typename boost::graph_traits<FaceListGraph>::halfedge_descriptor h,
                                           const Dual_mesh_of<FaceListGraph>& mesh) {
  const auto f = face(h, mesh.mesh());
  if (f == boost::graph_traits<FaceListGraph>::null_face()) return Triangle_surface::none;
  auto number = 3 * mesh.index(f);
  for (auto side = halfedge(f, mesh.mesh()); side != h; side = next(side, mesh.mesh())) ++number;
  return number;
}

/// \throws std::invalid_argument if a face is no triangle
template <class FaceListGraph>
void require_triangles(const Dual_mesh_of<FaceListGraph>& mesh) {
  for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f)
    if (mesh.corners(f).size() != 3)
      throw std::invalid_argument("face " + std::to_string(mesh.place(f)) +
                                  " is no triangle: boundaries are smoothed and cut on triangle meshes only");
}

}  // namespace RW_segmentation::internal

#endif
