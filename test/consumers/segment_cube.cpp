// SPDX-License-Identifier: MIT

// A program of a user of the package: segments a cube from one seed on each of two opposite faces.
#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Random_walk.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>

#include <cstddef>
#include <cstdlib>

int main() {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  using Mesh = CGAL::Surface_mesh<Point>;
  Mesh cube;
  CGAL::make_hexahedron(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0), Point(0, 1, 1), Point(0, 0, 1),
                        Point(1, 0, 1), Point(1, 1, 1), cube);

  const RW_segmentation::Dihedral_difference difference(cube);
  RW_segmentation::Random_walk walk(cube, RW_segmentation::Conductance(cube, difference));
  const Mesh::Face_index bottom(0), top(5);
  walk.add_seed(bottom, 0);
  walk.add_seed(top, 1);

  const auto segment_ids = cube.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  const bool is_right = walk.segment(segment_ids) == 2 && segment_ids[bottom] == 0 && segment_ids[top] == 1;
  return is_right ? EXIT_SUCCESS : EXIT_FAILURE;
}
