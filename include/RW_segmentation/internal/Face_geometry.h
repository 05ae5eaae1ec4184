#ifndef RW_SEGMENTATION_INTERNAL_FACE_GEOMETRY_H
#define RW_SEGMENTATION_INTERNAL_FACE_GEOMETRY_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/Descriptor_index.h>
#include <RW_segmentation/internal/check_number.h>
#include <RW_segmentation/internal/parallel_for.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Centroids, normals, areas and edge lengths in the order of a `Mesh_dual_graph`.
///
/// The mesh is moved to the origin and scaled to a bounding box of diagonal 1 first, so that neither far, huge nor tiny
/// coordinates lose digits: 1 here is `unit` in the mesh. Ratios of lengths, which is all that the method uses, are
/// the mesh's own.
struct Face_geometry {
  std::vector<Eigen::Vector3d> centroid;  ///< mean of the corners
  std::vector<Eigen::Vector3d> normal;    ///< unit length, or zero for a face without area
  std::vector<double> area;
  std::vector<double> edge_length;  ///< of the interior edges, in the order of the graph
  double total_area = 0;
  double unit = 1;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< in the mesh's coordinates
  double rounding = 0;                               ///< by how much the rounding of coordinates may displace a point
  std::size_t degenerate_faces = 0;                  ///< faces without area

  double mean_edge_length() const {
    double sum = 0;
    for (const double length : edge_length) sum += length;
    return edge_length.empty() ? 0 : sum / static_cast<double>(edge_length.size());
  }
  double longest_edge() const {
    return edge_length.empty() ? 0 : *std::max_element(edge_length.begin(), edge_length.end());
  }
};

/// The vertex points of a mesh as Eigen vectors.
template <class FaceListGraph, class NamedParameters>
class Vertex_points {
 public:
  using Map = typename CGAL::GetVertexPointMap<FaceListGraph, NamedParameters>::const_type;
  using vertex_descriptor = typename boost::graph_traits<FaceListGraph>::vertex_descriptor;

  Vertex_points(const FaceListGraph& mesh, const NamedParameters& np)
      : map_(CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_point),
                                                CGAL::get_const_property_map(CGAL::vertex_point, mesh))) {}

  Eigen::Vector3d operator()(vertex_descriptor v) const {
    const auto& p = get(map_, v);
    return {CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2])};
  }

 private:
  Map map_;
};

/// The vertex points of a mesh, moved and scaled so that their bounding box has its centre at 0 and the diagonal 1.
/// Isolated vertices do not count.
template <class FaceListGraph, class NamedParameters>
class Unit_box_points {
 public:
  using vertex_descriptor = typename boost::graph_traits<FaceListGraph>::vertex_descriptor;

  /// \throws std::invalid_argument if a coordinate is not finite, naming the vertex by its place in the order of
  /// `vertices(mesh)`
  Unit_box_points(const FaceListGraph& mesh, const NamedParameters& np) : point_(mesh, np) {
    Eigen::AlignedBox3d box;
    std::size_t number = 0;
    for (const vertex_descriptor v : vertices(mesh)) {
      if (halfedge(v, mesh) != boost::graph_traits<FaceListGraph>::null_halfedge()) {
        const Eigen::Vector3d p = point_(v);
        if (!p.allFinite())
          throw std::invalid_argument("vertex " + std::to_string(number) + " has a coordinate that is not finite");
        box.extend(p);
      }
      ++number;
    }
    if (box.isEmpty()) return;
    origin_ = box.min() / 2 + box.max() / 2;
    const double diagonal = 2 * (box.max() / 2 - box.min() / 2).stableNorm();
    if (diagonal >= std::numeric_limits<double>::min()) unit_ = diagonal;
    scale_ = 1 / unit_;
    const double largest_coordinate = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    rounding_ = std::numeric_limits<double>::epsilon() * (1 + largest_coordinate * scale_);
  }

  Eigen::Vector3d operator()(vertex_descriptor v) const {
    return smoothed_ ? (*smoothed_)[v] : Eigen::Vector3d((point_(v) - origin_) * scale_);
  }

  /// Moves each vertex off the border half-way to the mean of its neighbours, several times, all at once. The mesh
  /// itself does not change.
  void smooth(const FaceListGraph& mesh, int steps);

  double unit() const { return unit_; }
  const Eigen::Vector3d& origin() const { return origin_; }
  /// By how much the rounding of the mesh's coordinates may have displaced a point.
  double rounding() const { return rounding_; }

 private:
  Vertex_points<FaceListGraph, NamedParameters> point_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double unit_ = 1;
  double scale_ = 1;
  double rounding_ = 0;
  std::optional<Descriptor_table<vertex_descriptor, Eigen::Vector3d>> smoothed_;
};

template <class FaceListGraph, class NamedParameters>
void Unit_box_points<FaceListGraph, NamedParameters>::smooth(const FaceListGraph& mesh, int steps) {
  using Index = typename Descriptor_index<vertex_descriptor>::Index;
  Descriptor_index<vertex_descriptor> index;
  std::vector<Eigen::Vector3d> position;
  check_number(num_vertices(mesh), "vertices");
  for (const vertex_descriptor v : vertices(mesh)) {
    if (halfedge(v, mesh) == boost::graph_traits<FaceListGraph>::null_halfedge()) continue;
    index.insert(v, static_cast<Index>(position.size()));
    position.push_back((*this)(v));
  }

  std::vector<std::pair<Index, Index>> edge_ends;
  std::vector<double> degree(position.size(), 0.);
  std::vector<char> is_on_border(position.size(), false);
  for (const auto e : edges(mesh)) {
    const Index a = index[source(e, mesh)], b = index[target(e, mesh)];
    edge_ends.emplace_back(a, b);
    for (const Index v : {a, b}) {
      ++degree[v];
      if (CGAL::is_border(e, mesh)) is_on_border[v] = true;
    }
  }

  std::vector<Eigen::Vector3d> sum(position.size());
  for (int step = 0; step < steps; ++step) {
    std::fill(sum.begin(), sum.end(), Eigen::Vector3d::Zero());
    for (const auto& [a, b] : edge_ends) {
      sum[a] += position[b];
      sum[b] += position[a];
    }
    for (std::size_t v = 0; v < position.size(); ++v)
      if (!is_on_border[v]) position[v] = (position[v] + sum[v] / degree[v]) / 2;
  }

  Descriptor_table<vertex_descriptor, Eigen::Vector3d> smoothed(Eigen::Vector3d::Zero());
  smoothed.reserve(position.size());
  for (const vertex_descriptor v : vertices(mesh))
    if (index[v] != index.none) smoothed.insert(v, position[index[v]]);
  smoothed_ = std::move(smoothed);
}

/// The lengths of the interior edges of `graph`, the dual of `mesh`.
template <class FaceListGraph, class NamedParameters>
std::vector<double> edge_lengths(const FaceListGraph& mesh, const Mesh_dual_graph<FaceListGraph>& graph,
                                 const Unit_box_points<FaceListGraph, NamedParameters>& point) {
  std::vector<double> lengths(graph.number_of_edges());
  parallel_stretches(lengths.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto h = halfedge(graph.edge_descriptors()[e], mesh);
      lengths[e] = (point(target(h, mesh)) - point(source(h, mesh))).norm();
    }
  });
  return lengths;
}

/// Measures the faces and interior edges of `graph`, the dual of `mesh`.
template <class FaceListGraph, class NamedParameters>
Face_geometry face_geometry(const FaceListGraph& mesh, const Mesh_dual_graph<FaceListGraph>& graph,
                            const Unit_box_points<FaceListGraph, NamedParameters>& point) {
  Face_geometry geometry;
  geometry.unit = point.unit();
  geometry.origin = point.origin();
  geometry.rounding = point.rounding();

  const std::size_t faces = graph.number_of_faces();
  geometry.centroid.resize(faces);
  geometry.normal.resize(faces);
  geometry.area.resize(faces);
  const auto measure = [&](std::size_t f) {
    const auto first = halfedge(graph.face_descriptors()[f], mesh);
    const Eigen::Vector3d apex = point(target(first, mesh));
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), area_vector = Eigen::Vector3d::Zero();
    Eigen::Vector3d previous = sum;  // relative to the apex
    double corners = 1, extent = 0;
    for (auto h = next(first, mesh); h != first; h = next(h, mesh), ++corners) {
      const Eigen::Vector3d corner = point(target(h, mesh)) - apex;
      area_vector += previous.cross(corner) / 2;
      sum += corner;
      extent = std::max(extent, corner.norm());
      previous = corner;
    }
    const double area = area_vector.norm();
    // A face that is no higher than its corners are exact has no direction.
    const bool degenerate = !(area > 4 * geometry.rounding * extent);
    geometry.centroid[f] = apex + sum / corners;
    geometry.normal[f] = degenerate ? Eigen::Vector3d::Zero() : Eigen::Vector3d(area_vector / area);
    geometry.area[f] = area;
  };
  parallel_stretches(faces, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) measure(f);
  });
  for (std::size_t f = 0; f < faces; ++f) {
    geometry.total_area += geometry.area[f];
    geometry.degenerate_faces += geometry.normal[f].isZero(0);
  }
  geometry.edge_length = edge_lengths(mesh, graph, point);
  return geometry;
}

/// \throws std::invalid_argument if a coordinate of a face's corner is not finite
template <class FaceListGraph, class NamedParameters>
Face_geometry face_geometry(const FaceListGraph& mesh, const Mesh_dual_graph<FaceListGraph>& graph,
                            const NamedParameters& np) {
  return face_geometry(mesh, graph, Unit_box_points<FaceListGraph, NamedParameters>(mesh, np));
}

}  // namespace RW_segmentation::internal

#endif
