// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_BENCHMARK_MESH_TILES_H
#define RW_SEGMENTATION_BENCHMARK_MESH_TILES_H

// Meshes that are cut into tiles.

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Tile.h>

#include <CGAL/subdivision_method_3.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "measurement.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace mesh_tiles {

using measurement::Mesh;
using Labels = std::vector<std::size_t>;

/// A file, or one of CGAL's data meshes, subdivided until it has as many faces as asked for, or up to half as many.
inline Mesh read_subdivided(const std::string& name, std::size_t faces) {
  Mesh mesh = measurement::read_mesh(std::filesystem::exists(name) ? name : measurement::data_mesh(name + ".off"));
  while (4 * mesh.number_of_faces() <= faces)
    CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(1));
  if (3 * mesh.number_of_faces() <= faces)
    CGAL::Subdivision_method_3::Sqrt3_subdivision(mesh, CGAL::parameters::number_of_iterations(1));
  mesh.collect_garbage();
  return mesh;
}

/// The tile of each face by its place: boxes of one size, whose longest side is halved, cut in three and so on until there
/// are enough.
inline Labels cut_by_grid(const RW_segmentation::Dual_mesh_of<Mesh>& mesh, std::size_t tiles) {
  Eigen::AlignedBox3d box;
  for (RW_segmentation::Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f) box.extend(mesh.centroid(f));
  Eigen::Array3d cells = Eigen::Array3d::Ones();
  while (cells.prod() < static_cast<double>(tiles)) {
    Eigen::Index longest = 0;
    (box.sizes().array() / cells).maxCoeff(&longest);
    cells[longest] += 1;
  }
  Labels tile(mesh.number_of_faces());
  for (RW_segmentation::Dual_mesh::Index f = 0; f < tile.size(); ++f) {
    const Eigen::Array3d place = ((mesh.centroid(f) - box.min()).array() / box.sizes().array() * cells).floor();
    const Eigen::Array3d cell = place.min(cells - 1).max(0);
    tile[mesh.face(f)] = static_cast<std::size_t>(cell[0] + cells[0] * (cell[1] + cells[1] * cell[2]));
  }
  return tile;
}

/// The tiles of a mesh, and by tile the faces of the mesh that it has.
inline std::vector<RW_segmentation::Tile> cut(const Mesh& mesh, Labels& tile_of_face,
                                              std::vector<std::vector<Mesh::Face_index>>& faces) {
  std::map<std::size_t, std::size_t> number;  // without gaps
  for (std::size_t& tile : tile_of_face) tile = number.emplace(tile, number.size()).first->second;
  std::vector<RW_segmentation::Tile> tiles(number.size());
  faces.assign(number.size(), {});
  std::vector<std::map<Mesh::Vertex_index, RW_segmentation::Dual_mesh::Index>> vertex(number.size());
  for (const Mesh::Face_index f : mesh.faces()) {
    const std::size_t t = tile_of_face[f];
    faces[t].push_back(f);
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      const auto [place, is_new] =
          vertex[t].emplace(v, static_cast<RW_segmentation::Dual_mesh::Index>(tiles[t].points.size()));
      const auto& p = mesh.point(v);
      if (is_new) tiles[t].points.emplace_back(p.x(), p.y(), p.z());
      tiles[t].corners.add(place->second);
    }
    tiles[t].corners.end_face();
  }
  return tiles;
}

/// Labels by tile and face, as those of the mesh.
template <class Label>
Labels of_whole(const std::vector<std::vector<Label>>& of_tiles,
                const std::vector<std::vector<Mesh::Face_index>>& faces) {
  std::size_t count = 0;
  for (const auto& of_tile : faces) count += of_tile.size();
  Labels labels(count);
  for (std::size_t t = 0; t < faces.size(); ++t)
    for (std::size_t f = 0; f < faces[t].size(); ++f) labels[faces[t][f]] = of_tiles[t][f];
  return labels;
}

}  // namespace mesh_tiles

#endif
