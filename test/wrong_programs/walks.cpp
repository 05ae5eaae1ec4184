// SPDX-License-Identifier: MIT

// Walks from seeds: what is no conductance, no solver, no output.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Eigen_walk_solver.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/fragments_via_random_walks.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <vector>

using namespace RW_segmentation;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

void differences(const Mesh& mesh, Mesh::Property_map<Mesh::Face_index, std::size_t> ids,
                 const std::vector<Mesh::Face_index>& seeds) {
  const Dihedral_difference difference(mesh);

  // error: Random_walk needs conductances: Conductance(mesh, difference), or as_conductance(map) for values of your own.
  Random_walk walk(mesh, difference);

  // error: segmentation_from_seeds() needs conductances: Conductance(mesh, difference), or as_conductance(map) for values of your own.
  segmentation_from_seeds(mesh, difference, seeds, ids);

  // error: fragments_via_random_walks() needs conductances: Conductance(mesh, difference), or as_conductance(map) for values of your own.
  fragments_via_random_walks(mesh, difference, seeds, ids);
}

void solvers(const Mesh& mesh) {
  const Conductance conductance(mesh, Dihedral_difference(mesh));

  // error: The third argument of Random_walk is a solver, a model of WalkSolver such as Star_mesh_elimination or Eigen_walk_solver, or a sequence of named parameters.
  Random_walk walk(mesh, conductance, 6);

  // error: Eigen_walk_solver fills the lower triangle of the matrix: the solver needs Eigen::Lower, as Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> has it.
  Eigen_walk_solver<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Upper>> solver;
}

void names(const Mesh& mesh) {
  const Conductance conductance(mesh, Dihedral_difference(mesh));

  // error: Random_walk takes the named parameters vertex_point_map, edge_is_constrained_map and callback.
  Random_walk walk(mesh, conductance, CGAL::parameters::verbose(true));
}

void outputs(const Mesh& mesh, std::vector<std::size_t> ids) {
  Random_walk walk(mesh, Conductance(mesh, Dihedral_difference(mesh)));

  // error: segment_ids must be a writable property map from the mesh's face_descriptor to an integer.
  walk.segment(ids);

  // error: fragment_ids must be a writable property map from the mesh's face_descriptor to an integer.
  fragments_via_random_walks(mesh, Conductance(mesh, Dihedral_difference(mesh)), faces(mesh), ids);
}
