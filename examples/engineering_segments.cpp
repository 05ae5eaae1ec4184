// The plane, cylinder, cone, sphere or torus that each segment of a part of a machine lies on.
//
//   engineering_segments MESH

#include <RW_segmentation/Engineering_segmentation.h>
#include <RW_segmentation/segment_surfaces.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <exception>
#include <iostream>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

const char* const names[] = {"plane", "sphere", "cylinder", "cone", "torus", "free form"};  // as in Surface_type

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 2 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: engineering_segments MESH\n";
    return 1;
  }
  auto segment = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  try {
    const std::size_t segments =
        RW_segmentation::segmentation_via_random_walks(mesh, segment, RW_segmentation::Engineering_segmentation());
    for (const RW_segmentation::Analytic_surface& surface : RW_segmentation::segment_surfaces(mesh, segment, segments))
      std::cout << names[static_cast<std::size_t>(surface.type)] << '\n';
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
