// SPDX-License-Identifier: MIT

// One mesh for each segment, cut out along smooth boundaries.
//
//   split_and_extract MESH [FOLDER]
//
// The mesh is segmented, the boundaries are smoothed and cut into it, and each segment is copied out as a mesh of its
// own, with smooth borders where it met its neighbours. With a folder they are written to it as segment_0.off, ...

#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/split_along_boundaries.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Face_filtered_graph.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#if __has_include(<CGAL/boost/graph/border.h>)  // CGAL 6.2 or newer
#include <CGAL/boost/graph/border.h>
using CGAL::extract_boundary_cycles;
#else
#include <CGAL/Polygon_mesh_processing/border.h>
using CGAL::Polygon_mesh_processing::extract_boundary_cycles;
#endif

#include <cstddef>
#include <exception>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc < 2 || argc > 3 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: split_and_extract MESH [FOLDER]\n";
    return 1;
  }
  auto segment = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  auto is_boundary = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_boundary", false).first;
  try {
    const std::size_t segments = RW_segmentation::segmentation_via_random_walks(mesh, segment);
    const auto curves = RW_segmentation::smooth_boundaries(mesh, segment);
    const auto report = RW_segmentation::split_along_boundaries(mesh, curves, segment,
                                                                CGAL::parameters::edge_is_constrained_map(is_boundary));
    std::cout << curves.size() << " boundaries, " << report.faces_added << " faces added\n";

    for (std::size_t s = 0; s < segments; ++s) {
      const CGAL::Face_filtered_graph<Mesh> selected(mesh, s, segment);
      Mesh part;
      CGAL::copy_face_graph(selected, part);
      std::vector<Mesh::Halfedge_index> borders;  // one halfedge of each
      extract_boundary_cycles(part, std::back_inserter(borders));
      std::cout << "segment " << s << ": " << part.number_of_faces() << " faces, " << borders.size() << " borders\n";
      if (argc == 3) {
        const auto path = std::filesystem::path(argv[2]) / ("segment_" + std::to_string(s) + ".off");
        if (!CGAL::IO::write_polygon_mesh(path.string(), part, CGAL::parameters::stream_precision(17))) {
          std::cerr << path << " cannot be written\n";
          return 1;
        }
      }
    }
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
