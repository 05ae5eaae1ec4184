// SPDX-License-Identifier: MIT

// A pipeline of CGAL: read, repair, segment, and one well-meshed part for each segment.
//
//   pipeline MESH EDGE_LENGTH [FOLDER]
//
// The mesh is cut along smooth boundaries. Each part is remeshed with edges of about the given length; its border stays,
// so that the parts fit together. With a folder they are written to it as part_0.off, ...

#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/split_along_boundaries.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Face_filtered_graph.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

namespace PMP = CGAL::Polygon_mesh_processing;
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

int main(int argc, char** argv) {
  Mesh mesh;
  // Joins and orients a soup of polygons, too.
  if (argc < 3 || argc > 4 || !PMP::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: pipeline MESH EDGE_LENGTH [FOLDER]\n";
    return 1;
  }
  PMP::triangulate_faces(mesh);
  auto segment = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  try {
    const std::size_t segments = RW_segmentation::segmentation_via_random_walks(mesh, segment);
    RW_segmentation::split_along_boundaries(mesh, RW_segmentation::smooth_boundaries(mesh, segment), segment);

    for (std::size_t s = 0; s < segments; ++s) {
      Mesh part;
      CGAL::copy_face_graph(CGAL::Face_filtered_graph<Mesh>(mesh, s, segment), part);
      auto is_border = part.add_property_map<Mesh::Edge_index, bool>("e:is_border", false).first;
      for (const auto e : part.edges()) is_border[e] = part.is_border(e);
      const std::size_t faces_before = part.number_of_faces();
      PMP::isotropic_remeshing(part.faces(), std::atof(argv[2]), part,
                               CGAL::parameters::number_of_iterations(3).edge_is_constrained_map(is_border));
      part.collect_garbage();
      std::cout << "part " << s << ": " << faces_before << " faces, remeshed " << part.number_of_faces() << '\n';
      if (argc == 4) {
        const std::string path = std::string(argv[3]) + "/part_" + std::to_string(s) + ".off";
        if (!CGAL::IO::write_polygon_mesh(path, part, CGAL::parameters::stream_precision(17))) {
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
