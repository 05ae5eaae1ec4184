#ifndef RW_SEGMENTATION_INTERNAL_TRIANGLE_SURFACE_H
#define RW_SEGMENTATION_INTERNAL_TRIANGLE_SURFACE_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/Descriptor_index.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/check_number.h>

#include <CGAL/boost/graph/helpers.h>

#include <Eigen/Core>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// A triangle mesh in arrays: what curves are moved on and cut by.
///
/// Faces are numbered as in a `Mesh_dual_graph`. Halfedge 3 f + k runs along face f from its corner k to the next one;
/// corner 0 is the source of `halfedge(f, mesh)`. Where several fans of faces touch in a vertex, each has a vertex of its
/// own: going round one meets all its faces.
class Triangle_surface {
 public:
  using Index = std::uint32_t;
  static constexpr Index none = std::numeric_limits<Index>::max();

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
auto descriptor_of_halfedge(Triangle_surface::Index number, const FaceListGraph& mesh,
                            const Mesh_dual_graph<FaceListGraph>& graph) {
  auto h = halfedge(graph.face(number / 3), mesh);
  for (auto k = number % 3; k > 0; --k) h = next(h, mesh);
  return h;
}

/// Numbers the halfedges of the mesh's faces.
template <class FaceListGraph>
class Halfedge_numbers {
 public:
  using halfedge_descriptor = typename boost::graph_traits<FaceListGraph>::halfedge_descriptor;

  Halfedge_numbers(const FaceListGraph& mesh, const Mesh_dual_graph<FaceListGraph>& graph)
      : mesh_(mesh), graph_(graph) {}

  /// `none` for a halfedge without a face.
  Triangle_surface::Index operator[](halfedge_descriptor h) const {
    const auto f = face(h, mesh_);
    if (f == boost::graph_traits<FaceListGraph>::null_face()) return Triangle_surface::none;
    auto number = 3 * graph_.index(f);
    for (auto side = halfedge(f, mesh_); side != h; side = next(side, mesh_)) ++number;
    return number;
  }

 private:
  const FaceListGraph& mesh_;
  const Mesh_dual_graph<FaceListGraph>& graph_;
};

/// Reads a mesh.
/// \throws std::invalid_argument if a face is no triangle or a coordinate not finite
template <class FaceListGraph, class NamedParameters>
Triangle_surface triangle_surface(const FaceListGraph& mesh, const Mesh_dual_graph<FaceListGraph>& graph,
                                  const NamedParameters& np) {
  using Index = Triangle_surface::Index;
  using Traits = boost::graph_traits<FaceListGraph>;
  check_number(3 * graph.number_of_faces(), "halfedges");
  check_number(num_vertices(mesh), "vertices");

  const Unit_box_points<FaceListGraph, NamedParameters> point(mesh, np);
  Descriptor_index<typename Traits::vertex_descriptor> number;
  number.reserve(num_vertices(mesh));
  std::vector<Eigen::Vector3d> points;
  points.reserve(num_vertices(mesh));
  for (const auto v : vertices(mesh)) {
    number.insert(v, static_cast<Index>(points.size()));
    points.push_back(point(v));
  }

  const Halfedge_numbers<FaceListGraph> number_of(mesh, graph);
  std::vector<Index> sources, twins;
  sources.reserve(3 * graph.number_of_faces());
  twins.reserve(3 * graph.number_of_faces());
  for (const auto f : graph.face_descriptors()) {
    auto h = halfedge(f, mesh);
    if (!CGAL::is_triangle(h, mesh))
      throw std::invalid_argument("face " + std::to_string(sources.size() / 3) +
                                  " is no triangle: boundaries are smoothed and cut on triangle meshes only");
    for (int k = 0; k < 3; ++k, h = next(h, mesh)) {
      sources.push_back(number[source(h, mesh)]);
      twins.push_back(number_of[opposite(h, mesh)]);
    }
  }
  return {std::move(points), std::move(sources), std::move(twins)};
}

}  // namespace RW_segmentation::internal

#endif
