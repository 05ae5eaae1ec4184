// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_SEGMENTATION_H
#define SEGMENT_MESH_SEGMENTATION_H

#include "Method.h"
#include "Options.h"
#include "Oriented_mesh.h"
#include "Stages.h"
#include "seeds.h"
#include "walls.h"

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/regular_surfaces.h>

#include <cstddef>
#include <vector>

namespace segment_mesh {

/// What is known of the faces of the mesh at the end.
struct Segmentation {
  std::vector<std::size_t> label;                  ///< of each face
  std::vector<Face_label> labelled_seeds;          ///< empty where fragments were merged
  std::vector<std::size_t> seed_labels;            ///< in ascending order
  std::vector<std::vector<double>> probabilities;  ///< for each of them and each face, if asked for
  std::size_t seeds = 0, walls = 0, unseeded_components = 0, island_faces = 0, degenerate_faces = 0;
  bool has_heavy_noise = false;
  double noise = 0;                   ///< of the vertices, in the mesh's unit; only for parts of machines
  RW_segmentation::Merge_tree tree;   ///< empty unless fragments were merged
  std::size_t suggested = 0;          ///< segments by the shape, whatever was asked for; likewise
  std::vector<std::size_t> fragment;  ///< of each face, likewise
  std::vector<RW_segmentation::Analytic_surface> surfaces;  ///< of each label; only for parts of machines
  std::vector<RW_segmentation::Surface_snap> snaps;         ///< what was made regular, if that was asked for
};

/// The mesh as the library sees it.
using Dual = RW_segmentation::Dual_mesh_of<Mesh>;

/// Segments a mesh as the options tell.
/// \param walls edges that nothing crosses
/// \throws RW_segmentation::Cancelled, std::invalid_argument
Segmentation segment(const Mesh& mesh, const Wall_map& walls, const std::vector<Face_label>& seeds,
                     const Options& options, const Method& method, Stages& stages);

}  // namespace segment_mesh

#endif
