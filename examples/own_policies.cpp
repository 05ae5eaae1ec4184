// SPDX-License-Identifier: MIT

// Policies of one's own in the one call: each in the place of one of the library's, then all of them together.
//
//   own_policies MESH

#include <RW_segmentation/Eigen_walk_solver.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <iostream>
#include <numeric>
#include <vector>

namespace RW = RW_segmentation;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Edge = Mesh::Edge_index;
using Index = RW::Dual_mesh::Index;

//! [edge map]
// A difference as an edge map: how far two faces turn from each other, 1 at eight degrees, about an average edge.
auto turn_between_faces(const Mesh& mesh) {
  return boost::make_function_property_map<Edge>([&mesh](Edge edge) {
    const auto normal = [&](Mesh::Halfedge_index side) {
      return CGAL::Polygon_mesh_processing::compute_face_normal(mesh.face(side), mesh);
    };
    const auto side = mesh.halfedge(edge);
    return 100 * std::max(0., 1 - normal(side) * normal(mesh.opposite(side)));
  });
}
//! [edge map]

//! [difference]
// A difference as a function object: how deep the valley is between two faces of the smoothed shape, 1 on average.
struct Valley_depth {
  std::vector<double> operator()(const RW::Dual_mesh& mesh) const {
    std::vector<double> depth(mesh.number_of_edges());
    for (Index edge = 0; edge < depth.size(); ++edge) {
      const auto [i, j] = mesh.graph().faces_of(edge);
      const Eigen::Vector3d turn = mesh.shape_normal(j) - mesh.shape_normal(i);
      depth[edge] = std::max(0., turn.dot(mesh.centroid(i) - mesh.centroid(j)));
    }
    const double sum = std::accumulate(depth.begin(), depth.end(), 0.);
    if (sum > 0)
      for (double& d : depth) d *= static_cast<double>(depth.size()) / sum;
    return depth;
  }
};
//! [difference]

//! [seeding]
// A seeding: faces are numbered along the surface, and each stretch of the same area gets a seed in its middle.
struct Equal_area_seeding {
  std::size_t count;

  std::vector<Index> operator()(const RW::Dual_mesh& mesh, const std::vector<double>& /* difference */,
                                const std::vector<Index>& /* given */) const {
    std::vector<Index> seeds;
    const double share = mesh.total_area() / static_cast<double>(count);
    double area = 0;
    for (Index face = 0; face < mesh.number_of_faces(); ++face) {
      area += mesh.area(face);
      if (area > (static_cast<double>(seeds.size()) + 0.5) * share) seeds.push_back(face);
    }
    return seeds;
  }
};
//! [seeding]

//! [merge cost]
// A merge cost: the area of the smaller region, times how different the faces are along the common boundary.
struct Smallest_area_cost {
  struct Region {
    double area = 0;
  };

  Region region(const RW::Dual_mesh& mesh, Index face) const { return {mesh.area(face)}; }
  void join(Region& region, const Region& other) const { region.area += other.area; }
  double operator()(const Region& a, const Region& b, const RW::Region_boundary& boundary) const {
    return std::min(a.area, b.area) * boundary.common.difference / boundary.common.length;
  }
};
//! [merge cost]

//! [stop]
// A stop: where the cost grows most from one merge to the next.
std::size_t largest_gap(const RW::Merge_tree& tree) {
  std::size_t segments = tree.number_of_components();
  double largest = 0;
  const auto& merges = tree.merges();
  for (std::size_t m = 1; m < merges.size(); ++m) {
    const double gap = merges[m].cost - merges[m - 1].cost;
    if (gap <= largest) continue;
    largest = gap;
    segments = tree.number_of_fragments() - m;
  }
  return segments;
}
//! [stop]

//! [solver]
// A solver: one of Eigen's as it is, and another one by a function object that gives it its settings.
using Matrix = Eigen::SparseMatrix<double>;
using Cholesky = RW::Eigen_walk_solver<Eigen::SimplicialLDLT<Matrix, Eigen::Lower>>;

struct Factorisation {
  Eigen::SimplicialCholeskyMode mode;

  auto operator()() const {
    RW::Eigen_walk_solver<Eigen::SimplicialCholesky<Matrix, Eigen::Lower>> solver;
    solver.eigen_solver().setMode(mode);
    return solver;
  }
};
//! [solver]

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 2 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: own_policies MESH\n";
    return 1;
  }
  auto segment = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  const auto print_segments = [&](const char* policy, const auto& policies) {
    std::cout << policy << ": " << RW::segmentation_via_random_walks(mesh, segment, policies) << " segments\n";
  };
  try {
    //! [alone]
    const RW::Automatic_segmentation policies;
    print_segments("edge map", policies.with_difference(turn_between_faces(mesh)));
    print_segments("difference", policies.with_difference(Valley_depth()));
    print_segments("seeding", policies.with_seeding(Equal_area_seeding{60}));
    print_segments("merge cost", policies.with_merge_cost(Smallest_area_cost()).with_stop(RW::Segment_count_stop(8)));
    print_segments("stop", policies.with_stop(largest_gap));
    print_segments("solver", policies.with_solver(Cholesky()));
    print_segments("solver with settings", policies.with_solver(Factorisation{Eigen::SimplicialCholeskyLLT}));
    //! [alone]

    //! [together]
    const auto own = policies.with_difference(Valley_depth())
                         .with_seeding(Equal_area_seeding{60})
                         .with_solver(Cholesky())
                         .with_merge_cost(Smallest_area_cost())
                         .with_stop(largest_gap);
    print_segments("all", own);

    const auto hierarchy = RW::hierarchy_via_random_walks(mesh, own);
    const auto half = [](const RW::Merge_tree& tree) { return tree.number_of_fragments() / 2; };
    std::cout << hierarchy.segments(half, segment) << " segments, half of the fragments\n";
    //! [together]
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
