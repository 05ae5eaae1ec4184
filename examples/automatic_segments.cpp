// SPDX-License-Identifier: MIT

// Segments without seeds: as many as the shape suggests, then every number from two to eight.
//
//   automatic_segments MESH

#include <RW_segmentation/segmentation_via_random_walks.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <exception>
#include <iostream>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 2 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: automatic_segments MESH\n";
    return 1;
  }
  auto segment = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  try {
    std::cout << RW_segmentation::segmentation_via_random_walks(mesh, segment) << " segments\n";

    // Fragments are merged once; any number of segments is read off.
    const auto hierarchy = RW_segmentation::hierarchy_via_random_walks(mesh);
    for (std::size_t n = 2; n <= 8; ++n)
      std::cout << hierarchy.segments(RW_segmentation::Segment_count_stop(n), segment) << " segments\n";
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
