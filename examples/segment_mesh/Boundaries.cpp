// SPDX-License-Identifier: MIT

#include "Boundaries.h"

#include "cut_polygons.h"

#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/split_along_boundaries.h>
#include <RW_segmentation/tiled_boundaries.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace segment_mesh {

Boundary_curves boundary_curves(const Mesh& mesh, const Wall_map& walls, std::vector<std::size_t>& label,
                                bool is_smooth, const std::function<bool(double)>& callback) {
  RW_segmentation::Boundary_smoothing smoothing;
  if (!is_smooth) smoothing.largest_displacement = 0;
  return RW_segmentation::smooth_boundaries(mesh, face_map(mesh, label), smoothing,
                                            CGAL::parameters::callback(callback).edge_is_constrained_map(walls));
}

Boundary_curves boundary_curves_of_tile(const Mesh& mesh, const Wall_map& walls, std::vector<std::size_t>& label,
                                        const RW_segmentation::Tile_in_plan& place,
                                        const std::vector<RW_segmentation::Tile_crossing>& crossings,
                                        const std::function<bool(double)>& callback) {
  return RW_segmentation::smooth_boundaries_of_tile(
      mesh, face_map(mesh, label), place, crossings, {},
      CGAL::parameters::callback(callback).edge_is_constrained_map(walls));
}

namespace {

/// Notes which face each new one was part of.
struct Parent_notes : RW_segmentation::Default_split_visitor<Mesh> {
  Mesh::Face_index divided;
  std::shared_ptr<std::vector<Mesh::Face_index>> parent_of_new =  // the library takes a copy of the visitor
      std::make_shared<std::vector<Mesh::Face_index>>();

  void before_subface_creations(Mesh::Face_index face, const Mesh&) { divided = face; }
  void after_subface_created(Mesh::Face_index, const Mesh&) { parent_of_new->push_back(divided); }
};

}  // namespace

void inherit(Segmentation& result, const std::vector<Mesh::Face_index>& parent_of_new) {
  inherit(result.label, parent_of_new);
  for (auto& probability : result.probabilities) inherit(probability, parent_of_new);
  if (!result.fragment.empty()) inherit(result.fragment, parent_of_new);
}

void cut_boundaries(Mesh& mesh, const Boundary_curves& curves, Segmentation& result) {
  const Parent_notes notes;
  const auto segment = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  for (const auto f : mesh.faces()) segment[f] = result.label[f];
  RW_segmentation::split_along_boundaries(mesh, curves, segment, CGAL::parameters::visitor(notes));
  inherit(result, *notes.parent_of_new);
  result.label.assign(segment.begin(), segment.end());
}

}  // namespace segment_mesh
