// SPDX-License-Identifier: MIT

// The other stages: named parameters that are not used, and what is no property map.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/coarse_seeds.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

using namespace RW_segmentation;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Face = Mesh::Face_index;

void names(const Mesh& mesh, Mesh::Property_map<Mesh::Edge_index, bool> walls,
           Mesh::Property_map<Face, double> thickness, Mesh::Property_map<Face, std::size_t> ids,
           std::vector<Face>& seeds) {
  const auto np = CGAL::parameters::edge_is_constrained_map(walls);
  const auto unknown = CGAL::parameters::verbose(true);
  const Dual_mesh_of dual(mesh);

  // error: Dihedral_difference takes the named parameter vertex_point_map.
  const Dihedral_difference difference(mesh, 0.2, Dihedral_measure::angle, np);

  // error: Curvature_difference takes the named parameters vertex_point_map and callback.
  const Curvature_difference curvature(mesh, Ball_radius::in_edge_lengths(3), np);

  // error: Conductance takes the named parameters vertex_point_map and edge_is_constrained_map.
  const Conductance conductance(mesh, difference, 1, 20, unknown);

  // error: local_thickness() takes the named parameters vertex_point_map and callback.
  local_thickness(mesh, thickness, {}, np);

  // error: smoothed_shape() takes the named parameters vertex_point_map, edge_is_constrained_map and callback.
  smoothed_shape(mesh, {}, unknown);

  // error: feature_sensitive_seeds() takes the named parameters vertex_point_map, edge_is_constrained_map and callback.
  feature_sensitive_seeds(mesh, 40, std::back_inserter(seeds), seeds, Farthest_point_sampling(), unknown);

  // error: coarse_seeds() takes the named parameters vertex_point_map, edge_is_constrained_map and callback.
  coarse_seeds(mesh, difference, Seed_count_stop(4), std::back_inserter(seeds), unknown);

  // error: merge_segments() takes the named parameters vertex_point_map, edge_is_constrained_map and callback.
  merge_segments(mesh, ids, difference, unknown);

  // error: A Dual_mesh_of has its points and constrained edges: give them to its constructor.
  merge_segments(dual, ids, difference, np);
}

void maps(const Mesh& mesh, Mesh::Property_map<Face, std::size_t> ids, std::vector<double> values,
          Mesh::Property_map<Mesh::Edge_index, std::string> texts, std::vector<Face>& seeds) {
  const Dihedral_difference difference(mesh);

  // error: thickness must be a writable property map from the mesh's face_descriptor to double.
  local_thickness(mesh, values);

  // error: A writable property map from the mesh's face_descriptor to a vector is needed here.
  smoothed_face_normals(mesh, values);

  // error: segment_ids must be a readable property map from the mesh's face_descriptor to an integer.
  merge_segments(mesh, values, difference);

  // error: A readable property map from the mesh's edge_descriptor to double is needed here.
  const Conductance by_face(mesh, ids);

  // error: The values of this edge map must be convertible to double.
  const Conductance of_texts(mesh, texts);

  // error: stop must be a function from std::vector<double>, the separations of the seeds, to bool.
  coarse_seeds(mesh, difference, 6, std::back_inserter(seeds));
}

void stops(const Segment_hierarchy<Mesh>& hierarchy, Mesh::Property_map<Face, std::size_t> ids,
           std::vector<std::size_t> numbers) {
  // error: stop must be a function from Merge_tree to the number of segments, such as Segment_count_stop(6) or Cost_threshold_stop(1).
  hierarchy.segments(6, ids);

  // error: segment_ids must be a writable property map from the mesh's face_descriptor to std::size_t.
  hierarchy.segments(Segment_count_stop(6), numbers);
}

struct No_cost {};

void costs(const Mesh& mesh, Mesh::Property_map<Face, std::size_t> ids) {
  // error: cost must be a model of MergeCost: a type Region, and the functions region(), join() and operator(), all of them const.
  merge_segments(mesh, ids, Dihedral_difference(mesh), No_cost());
}
