// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_FACE_LABELS_H
#define RW_SEGMENTATION_TEST_FACE_LABELS_H

#include "mesh_graph.h"

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <utility>
#include <vector>

/// The labels of a mesh's faces as a property map to hand over, and as a vector in the order of `faces(mesh)` to look
/// at, whatever the kind of mesh.
template <class Mesh>
class Face_labels {
 public:
  using face_descriptor = typename boost::graph_traits<Mesh>::face_descriptor;
  static constexpr std::size_t untouched = 12345;

  explicit Face_labels(const Mesh& mesh) : graph_(mesh), values_(graph_.number_of_faces(), untouched) {}
  Face_labels(const Mesh& mesh, std::vector<std::size_t> values) : graph_(mesh), values_(std::move(values)) {}

  struct Map {
    using key_type = face_descriptor;
    using value_type = std::size_t;
    using reference = std::size_t;
    using category = boost::read_write_property_map_tag;
    const meshes::Mesh_graph<Mesh>* graph;
    std::vector<std::size_t>* values;
    friend void put(const Map& map, face_descriptor f, std::size_t label) {
      (*map.values)[map.graph->index(f)] = label;
    }
    friend std::size_t get(const Map& map, face_descriptor f) { return (*map.values)[map.graph->index(f)]; }
  };
  Map map() { return {&graph_, &values_}; }
  face_descriptor face(std::size_t i) const {
    return graph_.face_at(static_cast<RW_segmentation::Dual_graph::Index>(i));
  }
  const std::vector<std::size_t>& values() const { return values_; }
  const meshes::Mesh_graph<Mesh>& graph() const { return graph_; }

 private:
  meshes::Mesh_graph<Mesh> graph_;
  std::vector<std::size_t> values_;
};

#endif
