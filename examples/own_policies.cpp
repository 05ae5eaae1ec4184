// A solver, a merge cost and a stop of one's own, where the library's do not fit.
//
//   own_policies MESH
//
// Sixty farthest-point seeds make fragments by a solver of Eigen's; the smallest fragments are merged first, until the
// cost would grow most.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Eigen_walk_solver.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/merge_segments.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <iostream>
#include <iterator>
#include <vector>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Face = Mesh::Face_index;
using Cholesky = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

// A model of MergeCost: the area of the smaller region, times how different the regions are.
class Smallest_area_cost {
 public:
  struct Region {
    double area = 0;
  };

  explicit Smallest_area_cost(const Mesh& mesh) : mesh_(&mesh) {}

  Region region(Face face) const { return {CGAL::Polygon_mesh_processing::face_area(face, *mesh_)}; }
  void join(Region& region, const Region& other) const { region.area += other.area; }
  double operator()(const Region& a, const Region& b, const RW_segmentation::Region_boundary& boundary) const {
    return std::min(a.area, b.area) * boundary.common.difference / boundary.common.length;
  }

 private:
  const Mesh* mesh_;
};

// A model of StopPredicate: where the cost grows most from one merge to the next.
std::size_t largest_gap(const RW_segmentation::Merge_tree& tree) {
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

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 2 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: own_policies MESH\n";
    return 1;
  }
  auto segment = mesh.add_property_map<Face, std::size_t>("f:segment").first;
  try {
    std::vector<Face> seeds;
    RW_segmentation::feature_sensitive_seeds(mesh, 60, std::back_inserter(seeds));
    const RW_segmentation::Dihedral_difference difference(mesh);
    const RW_segmentation::Conductance conductance(mesh, difference);
    RW_segmentation::Random_walk<Mesh, RW_segmentation::Eigen_walk_solver<Cholesky>> walk(mesh, conductance);
    for (std::size_t i = 0; i < seeds.size(); ++i) walk.add_seed(seeds[i], i);
    walk.segment(segment);

    const auto hierarchy = RW_segmentation::merge_segments(mesh, segment, difference, Smallest_area_cost(mesh));
    std::cout << hierarchy.segments(largest_gap, segment) << " segments by the largest gap\n";
    const auto half = [](const RW_segmentation::Merge_tree& tree) { return tree.number_of_fragments() / 2; };
    std::cout << hierarchy.segments(half, segment) << " segments, half of the fragments\n";
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
