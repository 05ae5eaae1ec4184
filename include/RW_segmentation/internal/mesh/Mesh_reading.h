// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_MESH_READING_H
#define RW_SEGMENTATION_INTERNAL_MESH_MESH_READING_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/check_number.h>
#include <RW_segmentation/internal/mesh/Descriptor_index.h>
#include <RW_segmentation/internal/mesh/Face_corners.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The descriptors of a mesh by their numbers, and back. Those of a component share the numbers of the whole mesh.
template <class FaceListGraph>
struct Descriptors {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  using edge_descriptor = typename boost::graph_traits<FaceListGraph>::edge_descriptor;

  std::vector<face_descriptor> face_descriptors;
  std::vector<edge_descriptor> edge_descriptors;
  std::shared_ptr<const Descriptor_index<face_descriptor>> index;  ///< of the whole mesh
  Dual_graph::Index first_face = 0;                                ///< the number of the first face in it
};

/// Reads a mesh in one breadth-first pass over its faces, which gives them their numbers.
///
/// Faces are numbered from the first one of each component on, in the order of the mesh's edges; edges by the lower one
/// of their faces; vertices as faces come to them. What passes over a large mesh finds most of what it needs in the
/// cache, whatever the order of the mesh.
template <class FaceListGraph>
class Mesh_reading {
 public:
  using Index = Dual_graph::Index;
  using Traits = boost::graph_traits<FaceListGraph>;
  using face_descriptor = typename Traits::face_descriptor;
  using edge_descriptor = typename Traits::edge_descriptor;
  using halfedge_descriptor = typename Traits::halfedge_descriptor;
  using vertex_descriptor = typename Traits::vertex_descriptor;

  /// What is read. Without vertices the last three are empty.
  Descriptors<FaceListGraph> descriptors;
  std::vector<std::array<Index, 2>> sides;  ///< by edge: its faces, that of `halfedge(edge, mesh)` first
  Face_corners corners;
  std::vector<std::array<Index, 2>> edge_ends;  ///< by edge: its vertices, in the direction of its first face
  std::vector<vertex_descriptor> vertex_descriptors;

  /// \throws std::length_error if there are 2^32 - 1 faces, halfedges or vertices, or more
  Mesh_reading(const FaceListGraph& mesh, bool with_vertices) : mesh_(mesh), with_vertices_(with_vertices) {
    reserve();
    std::size_t next = 0;
    for (const face_descriptor start : faces(mesh)) {
      if (face_index_[start] == none) number_face(start);
      while (next < descriptors.face_descriptors.size()) {
        const std::size_t count = std::min(batch_.size(), descriptors.face_descriptors.size() - next);
        read_batch(next, count);
        for (std::size_t k = 0; k < count; ++k) number_sides(static_cast<Index>(next + k), batch_[k]);
        next += count;
      }
    }
    descriptors.index = std::make_shared<const Descriptor_index<face_descriptor>>(std::move(face_index_));
  }

 private:
  static constexpr Index none = Descriptor_index<face_descriptor>::none;

  /// A side of a face: what lies behind it, and the number of that if it was known when the batch was read.
  struct Side {
    halfedge_descriptor halfedge;
    edge_descriptor edge;
    face_descriptor opposite_face;
    vertex_descriptor target;
    Index opposite_number = none, target_number = none;
    std::array<Index, 2> ends = {};
  };

  /// Faces that wait are read so many at a time, each step for all of them, so that the waits for memory overlap. The
  /// stage takes .36 to .5 of the time of reading step by step (`benchmark_scaling`, 612 and 153 thousand faces).
  static constexpr std::size_t faces_in_batch = 16;

  void reserve() {
    check_number(num_faces(mesh_), "faces");
    check_number(2 * std::size_t(num_edges(mesh_)), "halfedges");
    check_number(num_vertices(mesh_), "vertices");
    descriptors.face_descriptors.reserve(num_faces(mesh_));
    face_index_.reserve(num_faces(mesh_));
    descriptors.edge_descriptors.reserve(num_edges(mesh_));
    sides.reserve(num_edges(mesh_));
    if constexpr (!Has_integer<edge_descriptor>::value) {
      edge_place_.reserve(num_edges(mesh_));
      Index place = 0;
      for (const edge_descriptor edge : edges(mesh_)) edge_place_.insert(edge, place++);
    }
    if (!with_vertices_) return;
    corners.reserve(num_faces(mesh_), 3 * num_faces(mesh_));
    edge_ends.reserve(num_edges(mesh_));
    vertex_descriptors.reserve(num_vertices(mesh_));
    vertex_index_.reserve(num_vertices(mesh_));
  }

  Index number_face(face_descriptor face) {
    const auto number = static_cast<Index>(descriptors.face_descriptors.size());
    face_index_.insert(face, number);
    descriptors.face_descriptors.push_back(face);
    return number;
  }

  Index number_of_vertex(const Side& side) {
    if (side.target_number != none) return side.target_number;
    const Index known = vertex_index_[side.target];
    if (known != none) return known;
    const auto number = static_cast<Index>(vertex_descriptors.size());
    vertex_index_.insert(side.target, number);
    vertex_descriptors.push_back(side.target);
    return number;
  }

  void read_batch(std::size_t begin, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      batch_[k].clear();
      next_[k] = halfedge(descriptors.face_descriptors[begin + k], mesh_);
    }
    for (bool open = true; open;) {
      open = false;
      for (std::size_t k = 0; k < count; ++k) {
        if (!batch_[k].empty() && next_[k] == batch_[k].front().halfedge) continue;
        Side& side = batch_[k].emplace_back();
        side.halfedge = next_[k];
        side.edge = edge(next_[k], mesh_);
        next_[k] = next(next_[k], mesh_);
        open = true;
      }
    }
    for_each_side(count, [&](Side& side) {
      side.opposite_face = face(opposite(side.halfedge, mesh_), mesh_);
      if (with_vertices_) side.target = target(side.halfedge, mesh_);
    });
    for_each_side(count, [&](Side& side) {
      if (side.opposite_face != Traits::null_face()) side.opposite_number = face_index_[side.opposite_face];
      if (with_vertices_) side.target_number = vertex_index_[side.target];
    });
  }

  template <class Function>
  void for_each_side(std::size_t count, const Function& function) {
    for (std::size_t k = 0; k < count; ++k)
      for (Side& side : batch_[k]) function(side);
  }

  /// Numbers what a face is the first to come to.
  void number_sides(Index face, std::vector<Side>& sides_of_face) {
    if (with_vertices_) number_corners(sides_of_face);
    std::sort(sides_of_face.begin(), sides_of_face.end(),
              [&](const Side& a, const Side& b) { return place_of(a.edge) < place_of(b.edge); });
    for (const Side& side : sides_of_face) {
      if (side.opposite_face == Traits::null_face()) continue;
      Index other = side.opposite_number;
      if (other == none) other = face_index_[side.opposite_face];
      if (other == none) other = number_face(side.opposite_face);
      if (other > face) add_edge(face, other, side);
    }
  }

  /// Where an edge stands among those of the mesh.
  std::size_t place_of(edge_descriptor edge) const {
    if constexpr (Has_integer<edge_descriptor>::value)
      return static_cast<std::size_t>(edge.idx());
    else
      return edge_place_[edge];
  }

  void number_corners(std::vector<Side>& sides_of_face) {
    for (Side& side : sides_of_face) corners.add(side.ends[1] = number_of_vertex(side));
    corners.end_face();
    Index source = sides_of_face.back().ends[1];
    for (Side& side : sides_of_face) {
      side.ends[0] = source;
      source = side.ends[1];
    }
  }

  void add_edge(Index face, Index other, const Side& side) {
    const bool is_first = halfedge(side.edge, mesh_) == side.halfedge;
    descriptors.edge_descriptors.push_back(side.edge);
    sides.push_back(is_first ? std::array{face, other} : std::array{other, face});
    if (with_vertices_) edge_ends.push_back(is_first ? side.ends : std::array{side.ends[1], side.ends[0]});
  }

  const FaceListGraph& mesh_;
  bool with_vertices_;
  Descriptor_index<face_descriptor> face_index_;
  Descriptor_index<vertex_descriptor> vertex_index_;
  Descriptor_index<edge_descriptor> edge_place_;  // where edges hold no integer
  std::array<std::vector<Side>, faces_in_batch> batch_;
  std::array<halfedge_descriptor, faces_in_batch> next_;
};

}  // namespace RW_segmentation::internal

#endif
