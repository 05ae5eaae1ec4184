// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_BOUNDARIES_H
#define RW_SEGMENTATION_TEST_BOUNDARIES_H

// Segments with boundaries to smooth, and what is measured before and after.

#include <RW_segmentation/Boundary_curve.h>
#include <RW_segmentation/Dual_graph.h>

#include <CGAL/boost/graph/helpers.h>
#include <boost/pending/disjoint_sets.hpp>
#include <boost/property_map/property_map.hpp>

#include "mesh_graph.h"
#include "meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace boundaries {

using Labels = std::vector<std::size_t>;  // in the order of the faces of a shape

/// Labels of faces, those that will be added, too.
template <class Mesh>
class Growing_face_labels {
 public:
  using face_descriptor = typename boost::graph_traits<Mesh>::face_descriptor;

  Growing_face_labels(const Mesh& mesh, const Labels& labels) {
    std::size_t i = 0;
    for (const face_descriptor f : faces(mesh)) label_[f] = labels[i++];
  }
  auto map() { return boost::make_assoc_property_map(label_); }
  std::size_t operator[](face_descriptor f) const { return label_.at(f); }

 private:
  std::map<face_descriptor, std::size_t> label_;
};

/// The label of each face, computed from its centroid.
inline Labels labels_by_place(const meshes::Shape& shape, const std::function<std::size_t(Eigen::Vector3d)>& label) {
  Labels labels;
  for (const auto& face : shape.faces) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::size_t corner : face) sum += shape.points[corner];
    labels.push_back(label(sum / static_cast<double>(face.size())));
  }
  return labels;
}

/// Cells of faces around random ones, as jagged as chance makes them.
inline Labels random_cells(const meshes::Shape& shape, std::size_t number, unsigned random_seed = 1) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape);
  const meshes::Mesh_graph graph(mesh);
  std::mt19937 random(random_seed);
  Labels labels(graph.number_of_faces(), number);
  std::vector<RW_segmentation::Dual_graph::Index> front;
  for (const std::size_t f : meshes::random_order(labels.size(), random_seed)) {
    if (front.size() == number) break;
    labels[f] = front.size();
    front.push_back(static_cast<RW_segmentation::Dual_graph::Index>(f));
  }
  while (!front.empty()) {
    std::swap(front[random() % front.size()], front.back());
    const auto f = front.back();
    front.pop_back();
    for (const auto& [next, edge] : graph.neighbours(f))
      if (labels[next] == number) {
        labels[next] = labels[f];
        front.push_back(next);
      }
  }
  return labels;
}

using Edge_marks = std::map<meshes::Surface_mesh::Edge_index, bool>;

/// Closed loops of edges: all those between faces of different labels.
inline Edge_marks edges_between(const meshes::Surface_mesh& mesh, const Labels& labels) {
  Edge_marks marks;
  for (const auto e : mesh.edges())
    marks[e] = !mesh.is_border(e) && labels[mesh.face(mesh.halfedge(e, 0))] != labels[mesh.face(mesh.halfedge(e, 1))];
  return marks;
}

/// A label for each pair of labels.
inline Labels products(const Labels& a, const Labels& b) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> number;
  Labels result;
  for (std::size_t f = 0; f < a.size(); ++f)
    result.push_back(number.emplace(std::pair{a[f], b[f]}, number.size()).first->second);
  return result;
}

template <class Mesh>
Eigen::Vector3d point(const Mesh& mesh, typename boost::graph_traits<Mesh>::vertex_descriptor v) {
  const auto& p = get(get(CGAL::vertex_point, mesh), v);
  return {p[0], p[1], p[2]};
}

template <class Point>
Eigen::Vector3d vector(const Point& p) {
  return {p[0], p[1], p[2]};
}

template <class Mesh>
double mean_edge_length(const Mesh& mesh) {
  double sum = 0, number = 0;
  for (const auto e : edges(mesh)) {
    sum += (point(mesh, source(e, mesh)) - point(mesh, target(e, mesh))).norm();
    ++number;
  }
  return sum / number;
}

/// What a refinement must keep.
struct Surface_measures {
  double area = 0, volume = 0;
  double least_height = std::numeric_limits<double>::infinity();
  std::size_t faces = 0, border_edges = 0, regions = 0;
  std::set<std::size_t> labels;
};

template <class Mesh, class LabelOfFace>
Surface_measures measures(const Mesh& mesh, const LabelOfFace& label) {
  Surface_measures result;
  std::map<typename boost::graph_traits<Mesh>::face_descriptor, std::size_t> number;
  std::vector<double> areas, volumes;  // summed in ascending order
  for (const auto f : faces(mesh)) {
    number.emplace(f, number.size());
    result.labels.insert(label[f]);
    const auto h = halfedge(f, mesh);
    const Eigen::Vector3d a = point(mesh, source(h, mesh)), b = point(mesh, target(h, mesh)),
                          c = point(mesh, target(next(h, mesh), mesh));
    const double doubled_area = (b - a).cross(c - a).norm();
    areas.push_back(doubled_area / 2);
    volumes.push_back(a.dot(b.cross(c)) / 6);
    const double longest_side = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    result.least_height = std::min(result.least_height, longest_side > 0 ? doubled_area / longest_side : 0);
  }
  for (std::vector<double>* values : {&areas, &volumes})
    std::sort(values->begin(), values->end(), [](double x, double y) { return std::abs(x) < std::abs(y); });
  result.area = std::accumulate(areas.begin(), areas.end(), 0.);
  result.volume = std::accumulate(volumes.begin(), volumes.end(), 0.);

  boost::disjoint_sets_with_storage<> regions(number.size());
  for (const auto e : edges(mesh)) {
    const auto h = halfedge(e, mesh);
    if (CGAL::is_border_edge(h, mesh)) {
      ++result.border_edges;
      continue;
    }
    const auto f = face(h, mesh), g = face(opposite(h, mesh), mesh);
    if (label[f] == label[g]) regions.union_set(number[f], number[g]);
  }
  result.faces = number.size();
  for (std::size_t i = 0; i < number.size(); ++i) result.regions += regions.find_set(i) == i;
  return result;
}

/// Sum of the angles between consecutive lines of a polyline.
inline double turning(const std::vector<Eigen::Vector3d>& points, bool is_closed) {
  const std::size_t n = points.size();
  double sum = 0;
  for (std::size_t i = is_closed ? 0 : 1; i + (is_closed ? 0 : 1) < n; ++i) {
    const Eigen::Vector3d a = points[i] - points[(i + n - 1) % n], b = points[(i + 1) % n] - points[i];
    sum += std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return sum;
}

template <class Mesh>
std::vector<Eigen::Vector3d> points_of(const RW_segmentation::Boundary_curve<Mesh>& curve) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& p : curve.points) points.push_back(vector(p.point));
  return points;
}

inline double distance_to_line(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0., 1.);
  return (a + t * (b - a) - p).norm();
}

}  // namespace boundaries

#endif
