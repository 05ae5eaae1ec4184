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
#include "walls.h"

#include <cstddef>
#include <string>

namespace segment_mesh {

/// Whether boundaries are written or cut into the mesh.
inline bool treats_boundaries(const Options& options) {
  return options.is_refined || !options.files.boundaries.empty();
}

/// Whether boundaries are smoothed before that.
inline bool smooths_boundaries(const Options& options) {
  return options.is_refined || (options.is_smooth && treats_boundaries(options));
}

/// Refuses a mesh whose boundaries cannot be smoothed or cut, which only the stage after the segmentation would find out.
/// \throws Argument_out_of_range if boundaries are asked for and a face is no triangle
inline void check_triangles(const std::string& path, const Oriented_mesh& input, const Options& options) {
  if (!treats_boundaries(options)) return;
  for (std::size_t f = 0; f < input.mesh_face.size(); ++f)
    if (input.mesh_face[f] != Mesh::null_face() && input.mesh.degree(input.mesh_face[f]) != 3)
      throw Argument_out_of_range(path + ": face " + std::to_string(f) +
                                  " is no triangle: boundaries are smoothed and cut on triangle meshes only");
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

/// Smooths and writes the boundaries and cuts them into the mesh, as far as asked for.
inline void treat_boundaries(const Options& options, mesh_files::Polygon_soup& soup, Oriented_mesh& input,
                             const Wall_map& walls, Segmentation& result, Stages& stages, Output_files& files) {
  if (!treats_boundaries(options)) return;
  const auto callback = stages.start("boundaries");
  const Boundary_curves curves =
      boundary_curves(input.mesh, walls, result.label, smooths_boundaries(options), callback);
  use_boundaries(options, curves, soup, input, result, files);
}

}  // namespace segment_mesh

#endif
