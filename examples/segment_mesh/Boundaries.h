// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_BOUNDARIES_H
#define SEGMENT_MESH_BOUNDARIES_H

#include "../mesh_files/Buffer.h"
#include "../mesh_files/Output_file.h"
#include "Oriented_mesh.h"
#include "Segmentation.h"
#include "walls.h"

#include <RW_segmentation/Boundary_curve.h>
#include <RW_segmentation/tiled_boundaries.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace segment_mesh {

using Boundary_curves = std::vector<RW_segmentation::Boundary_curve<Mesh>>;

/// The boundaries between the segments, smooth ones or as they run along the edges; those on walls stay there.
Boundary_curves boundary_curves(const Mesh& mesh, const Wall_map& walls, std::vector<std::size_t>& label,
                                bool is_smooth, const std::function<bool(double)>& callback);

/// The smooth boundaries of a tile.
/// \param crossings where they go on into other tiles
Boundary_curves boundary_curves_of_tile(const Mesh& mesh, const Wall_map& walls, std::vector<std::size_t>& label,
                                        const RW_segmentation::Tile_in_plan& place,
                                        const std::vector<RW_segmentation::Tile_crossing>& crossings,
                                        const std::function<bool(double)>& callback);

/// Gives the new faces of a mesh what is known of those that they were part of.
void inherit(Segmentation& result, const std::vector<Mesh::Face_index>& parent_of_new);

/// Cuts the curves into the mesh; new faces follow the old ones.
void cut_boundaries(Mesh& mesh, const Boundary_curves& curves, Segmentation& result);

/// Writes curves as an OBJ file: a group with the two labels, points and a polyline for each.
inline void write_curves(mesh_files::Output_file& file, const Boundary_curves& curves) {
  mesh_files::Buffer out(file);
  std::size_t number = 0;
  for (const auto& curve : curves) {
    out << "g boundary_";
    out.number(curve.segments[0]);
    out << "_";
    out.number(curve.segments[1]);
    out << "\n";
    for (const auto& [halfedge, position, point] : curve.points) {
      out << "v";
      for (int i = 0; i < 3; ++i) {
        out << " ";
        out.number(point[i]);
      }
      out << "\n";
    }
    out << "l";
    for (std::size_t i = 1; i <= curve.points.size(); ++i) {
      out << " ";
      out.number(number + i);
    }
    if (curve.is_closed) {
      out << " ";
      out.number(number + 1);
    }
    out << "\n";
    number += curve.points.size();
  }
  out.flush();
}

}  // namespace segment_mesh

#endif
