// SPDX-License-Identifier: MIT

// CGAL's Polyhedron_3 as it comes, without ids in its faces; segment ids in a map of the standard library.
//
//   polyhedron MESH

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Random_walk.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

#include <cstddef>
#include <iostream>
#include <iterator>
#include <map>
#include <unordered_map>
#include <vector>

using Mesh = CGAL::Polyhedron_3<CGAL::Simple_cartesian<double>>;
using Face = boost::graph_traits<Mesh>::face_descriptor;

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 2 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: polyhedron MESH\n";
    return 1;
  }

  // Two seeds: the first face and the one in the middle of the list.
  const std::vector<Face> seeds = {*faces(mesh).begin(),
                                   *std::next(faces(mesh).begin(), static_cast<std::ptrdiff_t>(num_faces(mesh) / 2))};
  std::unordered_map<Face, std::size_t> segment;
  const RW_segmentation::Dihedral_difference difference(mesh);
  const RW_segmentation::Conductance conductance(mesh, difference);
  RW_segmentation::segmentation_from_seeds(mesh, conductance, seeds, boost::make_assoc_property_map(segment));

  std::map<std::size_t, std::size_t> faces_of;
  for (const Face f : faces(mesh)) ++faces_of[segment.at(f)];
  for (const auto& [id, number] : faces_of) std::cout << "segment " << id << ": " << number << " faces\n";
}
