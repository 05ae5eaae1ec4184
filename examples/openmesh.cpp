// SPDX-License-Identifier: MIT

// A mesh of OpenMesh; segment ids in a property of the mesh.
//
//   openmesh MESH

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Random_walk.h>

#include <boost/property_map/function_property_map.hpp>

#include <cstddef>
#include <iostream>
#include <map>
#include <vector>

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Face = boost::graph_traits<Mesh>::face_descriptor;

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 2 || !OpenMesh::IO::read_mesh(mesh, argv[1])) {
    std::cerr << "usage: openmesh MESH\n";
    return 1;
  }
  auto segment = get(CGAL::dynamic_face_property_t<std::size_t>(), mesh);

  // Two seeds: the first face and the one in the middle.
  const std::vector<Face> seeds = {mesh.face_handle(0), mesh.face_handle(static_cast<unsigned>(mesh.n_faces() / 2))};
  const RW_segmentation::Dihedral_difference difference(mesh);
  const RW_segmentation::Conductance conductance(mesh, difference);
  RW_segmentation::segmentation_from_seeds(mesh, conductance, seeds, segment);

  std::map<std::size_t, std::size_t> faces_of;
  for (const Face f : faces(mesh)) ++faces_of[get(segment, f)];
  for (const auto& [id, number] : faces_of) std::cout << "segment " << id << ": " << number << " faces\n";
}
