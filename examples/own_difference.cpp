// SPDX-License-Identifier: MIT

// A difference of one's own, in three ways: values stored in a property map, a lambda, and a class; and conductances of
// one's own.
//
//   own_difference CUBE
//
// The mesh is a finely triangulated cube with sides at -1 and 1. One seed lies on each side.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Random_walk.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <boost/property_map/function_property_map.hpp>

#include <cmath>
#include <cstddef>
#include <iostream>
#include <map>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Mesh::Face_index;
using Edge = Mesh::Edge_index;
namespace PMP = CGAL::Polygon_mesh_processing;

Kernel::Vector_3 normal_beside(const Mesh& mesh, Mesh::Halfedge_index h) {
  return PMP::compute_face_normal(mesh.face(h), mesh);
}

// How far two faces turn from each other: 0 in a plane, 1 at a right angle.
double turn(const Mesh& mesh, Edge e) {
  if (mesh.is_border(e)) return 0;
  return 1 - normal_beside(mesh, mesh.halfedge(e, 0)) * normal_beside(mesh, mesh.halfedge(e, 1));
}

// A class is a readable property map if it names its types and has a function get().
class Crease_difference {
 public:
  using key_type = Edge;
  using value_type = double;
  using reference = double;
  using category = boost::readable_property_map_tag;

  // Creases sharper than `angle`, in radians, are walls of the given height; all else is level.
  Crease_difference(const Mesh& mesh, double angle, double height)
      : mesh_(&mesh), threshold_(1 - std::cos(angle)), height_(height) {}

  friend double get(const Crease_difference& map, Edge e) {
    return turn(*map.mesh_, e) > map.threshold_ ? map.height_ : 0;
  }

 private:
  const Mesh* mesh_;
  double threshold_, height_;
};

// The face whose centre is closest to the centre of the cube's side in direction `axis`.
Face face_on_side(const Mesh& mesh, const Kernel::Vector_3& axis) {
  Face best = *mesh.faces_begin();
  const auto distance = [&](Face f) {
    return CGAL::squared_distance(mesh.point(mesh.target(mesh.halfedge(f))), CGAL::ORIGIN + axis) -
           0.1 * PMP::compute_face_normal(f, mesh) * axis;
  };
  for (const Face f : mesh.faces())
    if (distance(f) < distance(best)) best = f;
  return best;
}

template <class Conductance>
void print_walk(const char* name, const Mesh& mesh, const Conductance& conductance, const std::vector<Face>& seeds) {
  std::map<Face, std::size_t> segment;
  RW_segmentation::segmentation_from_seeds(mesh, conductance, seeds, boost::make_assoc_property_map(segment));
  std::map<std::size_t, std::size_t> faces_of;
  for (const auto& [face, id] : segment) ++faces_of[id];
  std::cout << name << ':';
  for (const auto& [id, faces] : faces_of) std::cout << ' ' << faces;
  std::cout << '\n';
}

template <class Difference>
void print_segments(const char* name, const Mesh& mesh, const Difference& difference, const std::vector<Face>& seeds) {
  print_walk(name, mesh, RW_segmentation::Conductance(mesh, difference), seeds);
}

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 2 || !PMP::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: own_difference CUBE\n";
    return 1;
  }
  std::vector<Face> seeds;
  for (const double sign : {1., -1.})
    for (int axis = 0; axis < 3; ++axis)
      seeds.push_back(face_on_side(mesh, {sign * (axis == 0), sign * (axis == 1), sign * (axis == 2)}));

  // 1. Values of any origin, stored with the mesh.
  auto stored = mesh.add_property_map<Edge, double>("e:difference", 0.).first;
  for (const Edge e : mesh.edges()) stored[e] = 10 * turn(mesh, e);
  print_segments("stored map", mesh, stored, seeds);

  // 2. A lambda.
  const auto lambda = boost::make_function_property_map<Edge>([&](Edge e) { return 10 * turn(mesh, e); });
  print_segments("lambda", mesh, lambda, seeds);

  // 3. A class.
  print_segments("class", mesh, Crease_difference(mesh, 0.5, 10), seeds);

  //! [conductance]
  // Conductances: how easily a walk crosses each edge.
  const auto ease = boost::make_function_property_map<Edge>([&](Edge e) { return std::exp(-10 * turn(mesh, e)); });
  print_walk("conductance", mesh, RW_segmentation::as_conductance(ease), seeds);
  //! [conductance]
}
