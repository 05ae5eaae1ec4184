// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_STORED_SHAPE_H
#define SEGMENT_MESH_TILES_STORED_SHAPE_H

#include "Tile_folder.h"

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace segment_mesh {

/// A `Tile_shape` in a file.
struct Stored_shape {
  RW::internal::Face_corners corners;
  std::vector<Eigen::Vector3d> points, normals;
  std::vector<char> is_wall;
  RW::Tile_shape of_tile;  // but for the mesh

  explicit Stored_shape(RW::Tile_shape shape = {}) : of_tile(std::move(shape)) {
    const RW::Dual_mesh mesh = std::exchange(of_tile.mesh, {});
    for (RW::Dual_mesh::Index e = 0; mesh.has_walls() && e < mesh.number_of_edges(); ++e)
      is_wall.push_back(mesh.is_wall(e));
    for (RW::Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f) {
      for (const auto v : mesh.corners(f)) corners.add(v);
      corners.end_face();
      normals.push_back(mesh.shape_normal(f));
    }
    points = mesh.points();
  }

  RW::Tile_shape restored(const RW::Tile_plan& plan) && {
    of_tile.mesh = RW::internal::part_of(plan, std::move(corners), std::move(points), std::move(is_wall))
                       .with_shape_normals(std::move(normals));
    return std::move(of_tile);
  }

  template <class Archive>
  friend void transfer(Archive& a, Stored_shape& x) {
    a(x.corners);
    a(x.points);
    a(x.normals);
    a(x.is_wall);
    a(x.of_tile.own_faces);
    a(x.of_tile.halo);
    a(x.of_tile.shared_edges);
  }
};

}  // namespace segment_mesh

#endif
