// SPDX-License-Identifier: MIT

// A program that segments with CGAL's SDF package, and the same program with this one.
//
//   from_sdf MESH

// The maximum flow of CGAL 5.5.1 does not reset its flow between two cuts, which spoils the segmentations by SDF.
#define CGAL_DO_NOT_USE_BOYKOV_KOLMOGOROV_MAXFLOW_SOFTWARE

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // in Boost's maximum flow
#endif

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

//! [includes of CGAL]
#include <CGAL/mesh_segmentation.h>
//! [includes of CGAL]
//! [includes]
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
//! [includes]

#include <cstddef>
#include <ctime>
#include <exception>
#include <iostream>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Face = Mesh::Face_index;

//! [CGAL in one call]
std::size_t segments_by_cgal(const Mesh& mesh, Mesh::Property_map<Face, std::size_t> segment) {
  return CGAL::segmentation_via_sdf_values(mesh, segment);
}
//! [CGAL in one call]

//! [one call]
std::size_t segments_by_walks(const Mesh& mesh, Mesh::Property_map<Face, std::size_t> segment) {
  return RW_segmentation::segmentation_via_random_walks(mesh, segment);
}
//! [one call]

//! [CGAL with stored values]
void print_segments_by_cgal(const Mesh& mesh, Mesh::Property_map<Face, double> thickness,
                            Mesh::Property_map<Face, std::size_t> segment) {
  const double cone_angle = 2. / 3 * CGAL_PI;
  const std::size_t number_of_rays = 25;
  const auto [least, greatest] = CGAL::sdf_values(mesh, thickness, cone_angle, number_of_rays);
  std::cout << "CGAL: diameters from " << least << " to " << greatest << ", segments";
  for (const std::size_t clusters : {std::size_t(3), std::size_t(4), std::size_t(5)})
    std::cout << ' ' << CGAL::segmentation_from_sdf_values(mesh, thickness, segment, clusters);
  std::cout << '\n';
}
//! [CGAL with stored values]

namespace RW = RW_segmentation;

//! [stored values]
void print_segments_by_walks(const Mesh& mesh, Mesh::Property_map<Face, double> thickness,
                             Mesh::Property_map<Face, std::size_t> segment) {
  RW::Thickness_of_faces numbers;
  numbers.cone_angle = 2. / 3 * CGAL_PI / 2;  // of a ray to the normal: half of CGAL's angle
  numbers.rays = 25;
  numbers.is_smoothed = true;
  const RW::Thickness_report report = RW::thickness_of_all_faces(mesh, thickness, numbers);
  std::cout << "walks: diameters from " << report.least << " to " << report.greatest << ", segments";
  const auto hierarchy = RW::hierarchy_via_random_walks(
      mesh, RW::Automatic_segmentation().with_merge_cost(RW::Size_aware_cost(mesh, thickness)));
  for (const std::size_t segments : {std::size_t(3), std::size_t(4), std::size_t(5)})
    std::cout << ' ' << hierarchy.segments(RW::Segment_count_stop(segments), segment);
  std::cout << '\n';
}
//! [stored values]

// The processor time of one thread for the values of all faces, by both.
void print_times(const Mesh& mesh, Mesh::Property_map<Face, double> thickness) {
  const auto seconds = [](const auto& work) {
    const std::clock_t begin = std::clock();
    work();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  const double cgal = seconds([&] { CGAL::sdf_values(mesh, thickness); });
  const double ours = seconds([&] {
    RW::Thickness_of_faces numbers;
    numbers.is_smoothed = true;
    numbers.scale = RW::Thickness_scale::linear;
    RW::thickness_of_all_faces<CGAL::Sequential_tag>(mesh, thickness, numbers);
  });
  std::cout << "diameters took " << cgal << " s by CGAL, " << ours << " s here, ratio " << cgal / ours << '\n';
}

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 2 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: from_sdf MESH\n";
    return 1;
  }
  auto segment = mesh.add_property_map<Face, std::size_t>("f:segment").first;
  auto thickness = mesh.add_property_map<Face, double>("f:thickness").first;
  try {
    std::cout << "CGAL: " << segments_by_cgal(mesh, segment) << " segments\n";
    std::cout << "walks: " << segments_by_walks(mesh, segment) << " segments\n";
    print_times(mesh, thickness);
    print_segments_by_cgal(mesh, thickness, segment);
    print_segments_by_walks(mesh, thickness, segment);
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
