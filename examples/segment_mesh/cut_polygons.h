// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_CUT_POLYGONS_H
#define SEGMENT_MESH_CUT_POLYGONS_H

#include "../mesh_files/Polygon_soup.h"
#include "../mesh_files/Segmented_soup.h"
#include "Oriented_mesh.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <cstddef>
#include <vector>

namespace segment_mesh {

/// Cuts the polygons of a mesh into triangles; new faces follow the old ones.
/// \returns the face that each new one was part of
inline std::vector<Mesh::Face_index> cut_polygons(Mesh& mesh) {
  using Vertex = Mesh::Vertex_index;
  std::vector<Mesh::Face_index> polygons, parent_of_new;
  for (const auto f : mesh.faces())
    if (mesh.degree(f) > 3) polygons.push_back(f);
  if (polygons.empty()) return {};
  const std::vector<Point> points(mesh.points().begin(), mesh.points().end());
  mesh_files::Ear_clipping cut_ears(points);
  std::vector<mesh_files::Polygon_soup::Index> corners;
  for (const auto f : polygons) {
    auto left = mesh.halfedge(f);  // an edge of what is left of the polygon
    corners.clear();
    for (const auto v : mesh.vertices_around_face(left)) corners.push_back(v);
    std::size_t corners_left = corners.size();
    const auto cut_off = [&](auto before, auto tip, auto after) {
      if (corners_left-- == 3) return;
      const auto goes_around_ear = [&] {
        return mesh.source(left) == Vertex(before) && mesh.target(left) == Vertex(tip) &&
               mesh.target(mesh.next(left)) == Vertex(after);
      };
      while (!goes_around_ear()) left = mesh.next(left);
      left = CGAL::Euler::split_face(mesh.prev(left), mesh.next(left), mesh);
      parent_of_new.push_back(f);
    };
    // Boundaries cannot be followed along two edges between the same vertices.
    const auto are_apart = [&](auto v, auto w) { return !CGAL::halfedge(Vertex(v), Vertex(w), mesh).second; };
    cut_ears(corners, cut_off, are_apart);
  }
  return parent_of_new;
}

/// Gives the new faces of a mesh the values of those that they were part of.
template <class Value>
void inherit(std::vector<Value>& values, const std::vector<Mesh::Face_index>& parent_of_new) {
  values.reserve(values.size() + parent_of_new.size());
  for (const auto f : parent_of_new) values.push_back(values[f]);
}

}  // namespace segment_mesh

#endif
