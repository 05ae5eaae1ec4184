// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_WALLS_H
#define RW_SEGMENTATION_TEST_WALLS_H

#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/function_property_map.hpp>

#include <cstddef>
#include <iterator>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace walls {

/// Faces about a random one, and the closed loops of edges between them and the others as constrained edges.
template <class Mesh>
class Enclosure {
 public:
  using face_descriptor = typename boost::graph_traits<Mesh>::face_descriptor;
  using edge_descriptor = typename boost::graph_traits<Mesh>::edge_descriptor;

  /// Keeps a reference to the mesh, which is closed and in one piece.
  Enclosure(const Mesh& mesh, unsigned random_seed) : mesh_(mesh) {
    std::mt19937 random(random_seed);
    const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    const std::size_t size = 1 + below(num_faces(mesh) - 1);
    std::vector<face_descriptor> open = {
        *std::next(faces(mesh).begin(), static_cast<std::ptrdiff_t>(below(num_faces(mesh))))};
    while (inside_.size() < size && !open.empty()) {  // in a random order, for loops with many corners
      std::swap(open[below(open.size())], open.back());
      const face_descriptor f = open.back();
      open.pop_back();
      if (!inside_.insert(f).second) continue;
      for (const auto h : halfedges_around_face(halfedge(f, mesh), mesh)) open.push_back(face(opposite(h, mesh), mesh));
    }
  }

  bool is_inside(face_descriptor f) const { return inside_.count(f) > 0; }

  /// For `edge_is_constrained_map`, as long as this lives.
  auto constraints() const {
    return boost::make_function_property_map<edge_descriptor>([this](const edge_descriptor& e) {
      const auto h = halfedge(e, mesh_);
      return is_inside(face(h, mesh_)) != is_inside(face(opposite(h, mesh_), mesh_));
    });
  }

  /// The segments with faces on both sides.
  template <class SegmentIdMap>
  std::set<std::size_t> on_both_sides(const SegmentIdMap& segment_ids) const {
    std::set<std::size_t> inner, both;
    for (const auto f : faces(mesh_))
      if (is_inside(f)) inner.insert(get(segment_ids, f));
    for (const auto f : faces(mesh_))
      if (!is_inside(f) && inner.count(get(segment_ids, f)) > 0) both.insert(get(segment_ids, f));
    return both;
  }

 private:
  const Mesh& mesh_;
  std::set<face_descriptor> inside_;
};

}  // namespace walls

#endif
