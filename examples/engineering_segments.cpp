// SPDX-License-Identifier: MIT

// Parts of machines in two ways: into planes, cylinders, cones, spheres and tori, and by the paper's difference of
// curvatures in the one call.
//
//   engineering_segments MESH

#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <exception>
#include <iostream>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
namespace RW = RW_segmentation;

const char* const names[] = {"plane", "sphere", "cylinder", "cone", "torus", "free form"};  // as in Surface_type

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 2 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: engineering_segments MESH\n";
    return 1;
  }
  auto segment = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  try {
    //! [surfaces]
    const std::size_t segments = RW::segmentation_into_surfaces(mesh, segment);
    for (const RW::Analytic_surface& surface : RW::segment_surfaces(mesh, segment, segments))
      std::cout << names[static_cast<std::size_t>(surface.type)] << '\n';
    //! [surfaces]

    //! [paper]
    const auto policies = RW::Automatic_segmentation().with_difference(RW::Curvature_difference_policy());
    const std::size_t parts = RW::segmentation_via_random_walks(mesh, segment, policies);
    //! [paper]
    std::cout << parts << " parts by the difference of curvatures\n";
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
