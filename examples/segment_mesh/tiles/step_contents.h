// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_STEP_CONTENTS_H
#define SEGMENT_MESH_TILES_STEP_CONTENTS_H

#include "Step_file.h"

#include <RW_segmentation/Learned_cost.h>
#include <RW_segmentation/tiled_boundaries.h>
#include <RW_segmentation/tiled_segmentation.h>
#include <RW_segmentation/tiled_surfaces.h>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace segment_mesh {

// Sums of nothing but doubles, and a number.
template <>
struct Is_plain<RW_segmentation::internal::Noise_kind> : std::true_type {};
template <>
struct Is_plain<RW_segmentation::Learned_cost::Region> : std::true_type {};
template <>
struct Is_plain<RW_segmentation::Tile_regions::Boundary_sums> : std::true_type {};

}  // namespace segment_mesh

namespace RW_segmentation {

// For each type of a step its members, in their order; for readers and writers alike.

template <class Archive>
void transfer(Archive& a, Tile& x) {
  a(x.points);
  a(x.corners);
  a(x.vertex_ids);
  a(x.walls);
}

template <class Archive>
void transfer(Archive& a, Tile_survey& x) {
  a(x.faces);
  a(x.vertices);
  a(x.area);
  a(x.box.min());
  a(x.box.max());
  a(x.border_vertices);
  a(x.border_points);
  a(x.border_ids);
}

template <class Archive>
void transfer(Archive& a, Tile_plan::Shared_vertex& x) {
  a(x.vertex);
  a(x.id);
}
template <class Archive>
void transfer(Archive& a, Tile_plan::Of_tile& x) {
  a(x.area_before);
  a(x.faces_before);
  a(x.shared_vertices);
  a(x.neighbours);
}
template <class Archive>
void transfer(Archive& a, Tile_plan& x) {
  a(x.box.unit);
  a(x.box.origin);
  a(x.box.rounding);
  a(x.total_area);
  a(x.faces);
  a(x.faces_of_mesh);
  a(x.tiles);
}

template <class Archive>
void transfer(Archive& a, Tile_piece& x) {
  a(x.tile);
  a(x.faces);
}
template <class Archive>
void transfer(Archive& a, Tile_parts::Piece& x) {
  a(x.tile);
  a(x.place);
}
template <class Archive>
void transfer(Archive& a, Tile_parts::Part& x) {
  a(x.plan);
  a(x.pieces);
  a(x.area);
}
template <class Archive>
void transfer(Archive& a, Tile_parts::Place& x) {
  a(x.part);
  a(x.number);
}
template <class Archive>
void transfer(Archive& a, Tile_parts& x) {
  a(x.box.unit);
  a(x.box.origin);
  a(x.box.rounding);
  a(x.parts);
  a(x.places);
  a(x.piece_of_connected);
}

template <class Archive>
void transfer(Archive& a, Tile_border& x) {
  a(x.points);
  a(x.ids);
  a(x.corners);
  a(x.faces);
  a(x.width);
  a(x.walls);
}

template <class Archive>
void transfer(Archive& a, Tile_noise& x) {
  a(x.turns);
  a(x.smoother_turns);
}

template <class Archive>
void transfer(Archive& a, Tile_shape::Halo_face& x) {
  a(x.tile);
  a(x.place);
}
template <class Archive>
void transfer(Archive& a, Tile_shape::Shared_edge& x) {
  a(x.edge);
  a(x.side);
  a(x.neighbour);
}

template <class Archive>
void transfer(Archive& a, Tile_place& x) {
  a(x.face);
  a(x.squared_distance);
}
template <class Archive>
void transfer(Archive& a, Tile_seeds::Seed& x) {
  a(x.tile);
  a(x.face);
  a(x.label);
}
template <class Archive>
void transfer(Archive& a, Tile_seeds::Probe& x) {
  a(x.tile);
  a(x.probe);
}
template <class Archive>
void transfer(Archive& a, Tile_seeds& x) {
  a(x.seeds);
  a(x.probes);
  a(x.ordinary.turn);
  a(x.ordinary.excess);
  a(x.ordinary.crease_weight);
  a(x.turned_sides);
  a(x.walls);
  a(x.are_given);
  a(x.seeded_turn);
}

template <class Archive>
void transfer(Archive& a, Tile_outline& x) {
  a(x.turns);
  a(x.moment);
  a(x.faces);
  a(x.centroids);
  a(x.edges);
  a(x.lengths);
  a(x.sides);
  a(x.probes);
  a(x.turned_sides);
}

template <class Archive>
void transfer(Archive& a, Tile_network& x) {
  a(x.clusters);
  a(x.edges);
  a(x.conductances);
  a(x.sides);
  a(x.border);
  a(x.exits);
}

template <class Archive>
void transfer(Archive& a, Tile_walk& x) {
  a(x.fragments);
  a(x.bands);
  a(x.thickness);
  a(x.number_of_fragments);
  a(x.clusters);
  a(x.components);
  a(x.island_clusters);
  a(x.is_solid);
  a(x.crease_weight);
}

template <class Archive>
void transfer(Archive& a, Tile_regions& x) {
  a(x.fragments);
  a(x.regions);
  a(x.boundaries);
  a(x.sides);
  a(x.walls);
}

template <class Archive>
void transfer(Archive& a, Sampled_faces& x) {
  a(x.points);
  a(x.corners);
}

template <class Archive>
void transfer(Archive& a, Tile_neighbourhoods& x) {
  a(x.faces);
  a(x.middles);
}

template <class Archive>
void transfer(Archive& a, Surface_noise& x) {
  a(x.deviation);
  a(x.kind);
}

template <class Archive>
void transfer(Archive& a, Edge_sums& x) {
  a(x.length);
  a(x.difference);
}

template <class Archive>
void transfer(Archive& a, Tile_surfaces::Side_sums& x) {
  a(x.edge);
  a(x.is_smooth);
  a(x.is_wall);
}

template <class Archive>
void transfer(Archive& a, Tile_surfaces& x) {
  a(x.areas);
  a(x.samples);
  a(x.region_of);
  a(x.boundaries);
  a(x.sides);
  a(x.beside_walls);
  a(x.walls);
  a(x.turned_sides);
}

template <class Archive>
void transfer(Archive& a, Merge_tree::Merge& x) {
  a(x.first);
  a(x.second);
  a(x.cost);
}

template <class Archive>
void transfer(Archive& a, Tile_strip& x) {
  a(x.faces);
  a(x.segments);
}

template <class Archive>
void transfer(Archive& a, Tile_crossing& x) {
  a(x.tiles);
  a(x.ends);
  a(x.side);
  a(x.position);
  a(x.beyond);
}

namespace internal {

template <class Use>
void transfer(segment_mesh::Step_writer<Use>& writer, Face_corners& faces) {
  using Index = Face_corners::Index;
  std::vector<Index> sizes, corners;  // of each face; of all faces
  sizes.reserve(faces.number_of_faces());
  corners.reserve(faces.number_of_corners());
  for (Index f = 0; f < faces.number_of_faces(); ++f) {
    sizes.push_back(static_cast<Index>(faces[f].size()));
    corners.insert(corners.end(), faces[f].begin(), faces[f].end());
  }
  writer(sizes);
  writer(corners);
}
inline void transfer(segment_mesh::Step_reader& reader, Face_corners& faces) {
  std::vector<Face_corners::Index> sizes, corners;
  reader(sizes);
  reader(corners);
  faces = {};
  faces.reserve(sizes.size(), corners.size());
  std::size_t next = 0;
  for (const auto size : sizes) {
    for (std::size_t k = 0; k < size; ++k) faces.add(corners.at(next++));
    faces.end_face();
  }
}

template <class Archive>
void transfer(Archive& a, Turn_histogram::Count& x) {
  a(x.bin);
  a(x.turns);
}

template <class Archive>
void transfer(Archive& a, Noise_of_mesh& x) {
  a(x.turn);
  a(x.smoother_turn);
}

template <class Archive>
void transfer(Archive& a, Turn_sums& x) {
  a(x.edges);
  a(x.length);
  a(x.turn);
  a(x.seeded_turn);
  a(x.counts);
  a(x.walls);
}

template <class Archive, class Value>
void transfer(Archive& a, Side_value<Value>& x) {
  a(x.side);
  a(x.node);
  a(x.from_node);
  a(x.value);
  a(x.is_owner);
}

template <class Archive>
void transfer(Archive& a, Thickness_probe& x) {
  a(x.face);
  a(x.origin);
  a(x.axis);
}

template <class Archive, class Sums>
void transfer(Archive& a, Boundary_of_regions<Sums>& x) {
  a(x.regions);
  a(x.common);
}

}  // namespace internal
}  // namespace RW_segmentation

#endif
