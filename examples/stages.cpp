// SPDX-License-Identifier: MIT

// The stages of the one call by hand: each can be left out, replaced, or looked at. The mesh is read once.
//
//   stages MESH

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Learned_cost.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/fragments_via_random_walks.h>
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <exception>
#include <iostream>
#include <iterator>
#include <vector>

namespace RW = RW_segmentation;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Face = Mesh::Face_index;

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 2 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: stages MESH\n";
    return 1;
  }
  auto segment = mesh.add_property_map<Face, std::size_t>("f:segment").first;
  auto thickness = mesh.add_property_map<Face, double>("f:thickness").first;
  try {
    //! [stages]
    const RW::Dual_mesh_of dual(mesh);
    const RW::Dual_mesh_of shape = RW::smoothed_shape(dual);
    const RW::Dihedral_difference difference(shape, RW::smoothed_concavity());
    const RW::Conductance conductance(shape, difference);

    std::vector<Face> seeds;
    RW::feature_sensitive_seeds(shape, 40, std::back_inserter(seeds));
    RW::fragments_via_random_walks(shape, conductance, seeds, segment);

    RW::local_thickness(shape, thickness);
    const RW::Learned_cost cost(shape, thickness);
    const auto hierarchy = RW::merge_segments(shape, segment, difference, cost);
    hierarchy.segments(RW::Cost_threshold_stop(1), segment);
    //! [stages]

    auto in_one_call = mesh.add_property_map<Face, std::size_t>("f:in_one_call").first;
    RW::Automatic_segmentation policies;
    policies.seedings = 1;
    RW::segmentation_via_random_walks(mesh, in_one_call, policies);
    std::size_t others = 0;
    for (const Face face : mesh.faces()) others += segment[face] != in_one_call[face];
    std::cout << others << " faces have another label than by the one call\n";
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
