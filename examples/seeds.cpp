// SPDX-License-Identifier: MIT

// A segment for each seed, and the probabilities behind it.
//
//   seeds MESH FACE ...

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Random_walk.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Face = Mesh::Face_index;

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc < 3 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: seeds MESH FACE ...\n";
    return 1;
  }

  // How different two neighbouring faces are, how easily the walk passes between them, and the walk. The mesh is read once
  // for all three of them; each takes the mesh itself as well.
  const RW_segmentation::Dual_mesh_of dual(mesh);
  const RW_segmentation::Dihedral_difference difference(dual);
  const RW_segmentation::Conductance conductance(dual, difference);
  RW_segmentation::Random_walk walk(dual, conductance);

  for (int i = 2; i < argc; ++i)
    walk.add_seed(Face(static_cast<Mesh::size_type>(std::stoul(argv[i]))), static_cast<std::size_t>(i - 2));
  auto segment = mesh.add_property_map<Face, std::size_t>("f:segment").first;
  walk.segment(segment);

  // Where no seed gets half of the walks, one more seed may help.
  std::vector<std::size_t> number_of_faces(walk.seeds().size()), unsure(number_of_faces);
  for (const Face f : mesh.faces()) {
    ++number_of_faces[segment[f]];
    if (walk.probability(f, segment[f]) < 0.5) ++unsure[segment[f]];
  }
  for (std::size_t s = 0; s < number_of_faces.size(); ++s)
    std::cout << "segment " << s << ": " << number_of_faces[s] << " faces, " << unsure[s] << " unsure\n";
}
