// SPDX-License-Identifier: MIT

// The surfaces of a machine part from a seed on each of them, across smooth joints, where curvatures differ.
//
//   curvature_seeds MESH FACE ...

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/Random_walk.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Face = Mesh::Face_index;

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc < 3 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: curvature_seeds MESH FACE ...\n";
    return 1;
  }
  auto segment = mesh.add_property_map<Face, std::size_t>("f:segment").first;
  try {
    const RW_segmentation::Curvature_difference difference(mesh);
    const RW_segmentation::Conductance conductance(mesh, difference);
    RW_segmentation::Random_walk walk(mesh, conductance);

    std::size_t seeds = 0;
    for (int i = 2; i < argc; ++i) walk.add_seed(Face(static_cast<Mesh::size_type>(std::stoul(argv[i]))), seeds++);
    walk.segment(segment);

    std::vector<std::size_t> number_of_faces(seeds);
    for (const Face f : mesh.faces()) ++number_of_faces[segment[f]];
    for (std::size_t s = 0; s < seeds; ++s) std::cout << "segment " << s << ": " << number_of_faces[s] << " faces\n";
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
