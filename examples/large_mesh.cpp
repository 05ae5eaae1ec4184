// SPDX-License-Identifier: MIT

// A large mesh in two ways: with the walk reduced to clusters of faces, as it is by itself above 100,000 faces, and by
// way of a simplified copy whose segments are carried back.
//
//   large_mesh MESH

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smoothed_face_normals.h>
#include <RW_segmentation/transfer_segments.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cstddef>
#include <exception>
#include <iostream>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using namespace RW_segmentation;

/// Stops at a quarter of the edges. CGAL's own predicate has another name in each of its versions 5 and 6.
struct Quarter_stop {
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile&, std::size_t initial, std::size_t current) const {
    return 4 * current <= initial;
  }
};

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 2 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: large_mesh MESH\n";
    return 1;
  }
  auto segment = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  try {
    // Clusters of faces, whatever the size of the mesh.
    Automatic_segmentation policies;
    policies.reduction.largest_direct = 0;
    std::cout << segmentation_via_random_walks(mesh, segment, policies) << " segments by clusters\n";

    // A copy with a quarter of the edges, and back.
    Mesh reduced = mesh;
    CGAL::Surface_mesh_simplification::edge_collapse(reduced, Quarter_stop());
    reduced.collect_garbage();
    auto reduced_segment = reduced.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
    segmentation_via_random_walks(reduced, reduced_segment);

    const Dual_mesh_of dual(mesh);
    const Dual_mesh_of shape = smoothed_shape(dual);
    const Conductance conductance(shape, Dihedral_difference(shape, smoothed_concavity()));
    std::cout << transfer_segments(reduced, reduced_segment, dual, conductance, segment)
              << " segments by a simplified copy of " << reduced.number_of_faces() << " faces\n";
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
