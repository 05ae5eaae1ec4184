// SPDX-License-Identifier: MIT

#include "Boundaries.h"

#include "../mesh_files/Segmented_soup.h"

#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/split_along_boundaries.h>
#include <RW_segmentation/tiled_boundaries.h>

#include <CGAL/boost/graph/Euler_operations.h>

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

/// Gives the new faces of a mesh the values of those that they were part of.
template <class Value>
void inherit(std::vector<Value>& values, const std::vector<Mesh::Face_index>& parent_of_new) {
  values.reserve(values.size() + parent_of_new.size());
  for (const auto f : parent_of_new) values.push_back(values[f]);
}

/// The same for what is known of faces besides their labels.
void inherit_besides_labels(Segmentation& result, const std::vector<Mesh::Face_index>& parent_of_new) {
  for (auto& probability : result.probabilities) inherit(probability, parent_of_new);
  if (!result.fragment.empty()) inherit(result.fragment, parent_of_new);
}

}  // namespace

std::size_t cut_polygons(Mesh& mesh, Segmentation& result) {
  std::vector<Mesh::Face_index> polygons, parent_of_new;
  for (const auto f : mesh.faces())
    if (mesh.degree(f) > 3) polygons.push_back(f);
  if (polygons.empty()) return 0;
  const std::vector<Point> points(mesh.points().begin(), mesh.points().end());
  mesh_files::Ear_clipping cut_ears(points);
  std::vector<mesh_files::Polygon_soup::Index> corners;
  for (const auto f : polygons) {
    auto left = mesh.halfedge(f);  // an edge of what is left of the polygon
    corners.clear();
    for (const auto v : mesh.vertices_around_face(left)) corners.push_back(v);
    std::size_t corners_left = corners.size();
    cut_ears(corners, [&](auto before, auto tip, auto after) {
      if (corners_left-- == 3) return;
      const auto goes_around_ear = [&] {
        return mesh.source(left) == Mesh::Vertex_index(before) && mesh.target(left) == Mesh::Vertex_index(tip) &&
               mesh.target(mesh.next(left)) == Mesh::Vertex_index(after);
      };
      while (!goes_around_ear()) left = mesh.next(left);
      left = CGAL::Euler::split_face(mesh.prev(left), mesh.next(left), mesh);
      parent_of_new.push_back(f);
    });
  }
  inherit(result.label, parent_of_new);
  inherit_besides_labels(result, parent_of_new);
  return polygons.size();
}

void cut_boundaries(Mesh& mesh, const Boundary_curves& curves, Segmentation& result) {
  const Parent_notes notes;
  const auto segment = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  for (const auto f : mesh.faces()) segment[f] = result.label[f];
  RW_segmentation::split_along_boundaries(mesh, curves, segment, CGAL::parameters::visitor(notes));
  result.label.assign(segment.begin(), segment.end());
  inherit_besides_labels(result, *notes.parent_of_new);
}

}  // namespace segment_mesh
