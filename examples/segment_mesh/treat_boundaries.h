// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TREAT_BOUNDARIES_H
#define SEGMENT_MESH_TREAT_BOUNDARIES_H

#include "../mesh_files/Polygon_soup.h"
#include "Boundaries.h"
#include "Options.h"
#include "Oriented_mesh.h"
#include "Output_files.h"
#include "Segmentation.h"
#include "Stages.h"
#include "cut_polygons.h"
#include "walls.h"

#include <CGAL/boost/graph/helpers.h>

#include <cstddef>
#include <set>
#include <vector>

namespace segment_mesh {

/// Whether boundaries are written or cut into the mesh.
inline bool treats_boundaries(const Options& options) {
  return options.is_refined || !options.files.boundaries.empty();
}

/// Whether boundaries are smoothed before that.
inline bool smooths_boundaries(const Options& options) {
  return options.is_refined || (options.is_smooth && treats_boundaries(options));
}

/// Writes the boundaries and cuts them into the mesh, as far as asked for.
inline void use_boundaries(const Options& options, const Boundary_curves& curves, mesh_files::Polygon_soup& soup,
                           Oriented_mesh& input, Segmentation& result, Output_files& files) {
  files.write_boundaries(curves);
  if (!options.is_refined) return;
  cut_boundaries(input.mesh, curves, result);
  soup = soup_of(input.mesh);
  input.mesh_face.assign(input.mesh.faces_begin(), input.mesh.faces_end());
}

/// Smooths and writes the boundaries and cuts them into the mesh, as far as asked for. They are those of a mesh whose polygons
/// are cut into triangles; a mesh that nothing is cut into keeps its own.
/// \returns how many polygons of the mesh were cut
inline std::size_t treat_boundaries(const Options& options, mesh_files::Polygon_soup& soup, Oriented_mesh& input,
                                    const Wall_map& walls, Segmentation& result, Stages& stages, Output_files& files) {
  if (!treats_boundaries(options)) return 0;
  const auto callback = stages.start("boundaries");
  const auto curves_on = [&](const Mesh& mesh, const Wall_map& walls_of_mesh, std::vector<std::size_t>& label) {
    return boundary_curves(mesh, walls_of_mesh, label, smooths_boundaries(options), callback);
  };
  if (!options.is_refined && !CGAL::is_triangle_mesh(input.mesh)) {
    Mesh triangles = input.mesh;
    std::vector<std::size_t> label = result.label;
    inherit(label, cut_polygons(triangles));
    files.write_boundaries(curves_on(triangles, wall_map(triangles), label));
    return 0;
  }
  const std::vector<Mesh::Face_index> parent_of_new = cut_polygons(input.mesh);
  inherit(result, parent_of_new);
  use_boundaries(options, curves_on(input.mesh, walls, result.label), soup, input, result, files);
  return std::set(parent_of_new.begin(), parent_of_new.end()).size();
}

}  // namespace segment_mesh

#endif
