// SPDX-License-Identifier: MIT

// The one call: what is no policy, no output, no name that it uses.

#include <RW_segmentation/segmentation_via_random_walks.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <vector>

using namespace RW_segmentation;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Ids = Mesh::Property_map<Mesh::Face_index, std::size_t>;

void arguments(const Mesh& mesh, Ids ids, std::vector<std::size_t> vector) {
  // error: Segmentation_policies are needed here, such as Automatic_segmentation(6) for six segments, or CGAL's named parameters.
  segmentation_via_random_walks(mesh, ids, 6);

  // error: Segmentation_policies are needed here, such as Automatic_segmentation(6) for six segments, or CGAL's named parameters.
  hierarchy_via_random_walks(mesh, Dihedral_difference(mesh));

  // error: segment_ids must be a writable property map from the mesh's face_descriptor to std::size_t.
  segmentation_via_random_walks(mesh, vector);

  // error: Segmentation via random walks takes the named parameters vertex_point_map, edge_is_constrained_map and callback.
  segmentation_via_random_walks(mesh, ids, CGAL::parameters::verbose(true));

  // error: Seeds are a range of faces of the mesh, or of pairs of a face and a label.
  segmentation_via_random_walks(mesh, ids, Automatic_segmentation(), 6);
}

struct Nothing {};

void policies(const Mesh& mesh, Ids ids) {
  // error: A difference is a readable property map from the mesh's edge_descriptor to double, or a function object from a Dual_mesh_of to one or to a std::vector<double> by edge.
  segmentation_via_random_walks(mesh, ids, Automatic_segmentation().with_difference(Nothing()));

  // error: A seeding is a function object from a Dual_mesh_of, its differences by edge and the given seeds to a range of numbers of faces.
  segmentation_via_random_walks(mesh, ids, Automatic_segmentation().with_seeding(Nothing()));

  // error: A solver is a model of WalkSolver, such as Star_mesh_elimination or Eigen_walk_solver, or a function object without arguments that returns one.
  segmentation_via_random_walks(mesh, ids, Automatic_segmentation().with_solver(Nothing()));

  // error: A merge cost has a type Region and the functions region(), join() and operator(), all of them const, or it is a function object from a Dual_mesh_of to such a one.
  segmentation_via_random_walks(mesh, ids, Automatic_segmentation().with_merge_cost(Nothing()));

  // error: stop must be a function from Merge_tree to the number of segments, such as Segment_count_stop(6) or Cost_threshold_stop(1).
  segmentation_via_random_walks(mesh, ids, Automatic_segmentation().with_stop(Nothing()));
}
