// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_ORIENTED_MESH_H
#define SEGMENT_MESH_ORIENTED_MESH_H

#include "../mesh_files/Polygon_soup.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace segment_mesh {

using Point = mesh_files::Polygon_soup::Point;
using Mesh = CGAL::Surface_mesh<Point>;
using Mesh_vector = CGAL::Kernel_traits<Point>::Kernel::Vector_3;

/// A property map over values in the order of the mesh's faces.
template <class Value>
auto face_map(const Mesh& mesh, std::vector<Value>& values) {
  return boost::make_iterator_property_map(values.begin(), get(boost::face_index, mesh));
}

/// The normal of a face, twice as long as its area in squares of `unit`.
inline Mesh_vector normal_of_twice_the_area(const Mesh& mesh, Mesh::Face_index f, double unit) {
  const auto first = mesh.halfedge(f);
  const Point& apex = mesh.point(mesh.source(first));
  Mesh_vector normal = CGAL::NULL_VECTOR;
  for (const auto h : mesh.halfedges_around_face(first))
    normal = normal + CGAL::cross_product((mesh.point(mesh.source(h)) - apex) / unit,
                                          (mesh.point(mesh.target(h)) - apex) / unit);
  return normal;
}

/// The area of a face in squares of `unit`.
inline double face_area(const Mesh& mesh, Mesh::Face_index f, double unit) {
  return CGAL::approximate_sqrt(normal_of_twice_the_area(mesh, f, unit).squared_length()) / 2;
}

/// The faces of a mesh as they are written.
inline mesh_files::Polygon_soup soup_of(const Mesh& mesh) {
  mesh_files::Polygon_soup soup;
  for (const auto v : mesh.vertices()) soup.points.push_back(mesh.point(v));
  for (const auto f : mesh.faces()) {
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) soup.corners.push_back(v);
    soup.end_face();
  }
  return soup;
}

/// The largest side of the box around a mesh.
inline double extent_of(const Mesh& mesh) {
  const CGAL::Bbox_3 box = CGAL::bbox_3(mesh.points().begin(), mesh.points().end());
  return std::max({box.x_span(), box.y_span(), box.z_span()});
}

/// A halfedge mesh of the faces of a file.
struct Oriented_mesh {
  Mesh mesh;
  /// The face of the mesh for each face of the file; null for those that were left out.
  std::vector<Mesh::Face_index> mesh_face;
  /// What was changed, a sentence each.
  std::vector<std::string> remarks;
};

/// What `oriented_mesh()` may change.
struct Repairs {
  bool stitch = true;  ///< join border edges that coincide
  bool orient = true;  ///< turn closed parts that are inside out
};

/// "3 faces", "1 face"; an irregular plural is given.
inline std::string counted(std::size_t number, const std::string& singular, const std::string& plural = "") {
  return std::to_string(number) + " " + (number == 1 ? singular : plural.empty() ? singular + "s" : plural);
}

/// The numbers of the faces of the file that the mesh lacks.
inline std::vector<std::size_t> faces_left_out(const Oriented_mesh& input) {
  std::vector<std::size_t> left_out;
  for (std::size_t f = 0; f < input.mesh_face.size(); ++f)
    if (input.mesh_face[f] == Mesh::null_face()) left_out.push_back(f);
  return left_out;
}

/// The mesh of the faces of a file, repaired as far as needed: a file whose faces form an oriented surface without
/// coinciding borders is taken as it is.
Oriented_mesh oriented_mesh(const mesh_files::Polygon_soup& soup, const Repairs& repairs);

}  // namespace segment_mesh

#endif
