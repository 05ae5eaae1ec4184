// SPDX-License-Identifier: MIT

// A mesh of few polygons: CGAL's Variational Shape Approximation of each segment of a part of a machine.
//
//   approximate_segments MESH PROXIES_PER_SEGMENT [OUT.off]
//
// A segment that is a plane gets one proxy, all others get the given number. No proxy crosses a boundary between
// surfaces. The segments are approximated one by one, so that their borders do not fit together on curved joints.

#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_approximation/approximate_triangle_mesh.h>
#include <CGAL/boost/graph/Face_filtered_graph.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <iterator>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// A soup of triangles.
struct Triangles {
  std::vector<Kernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> corners;
};

/// Approximates a mesh by so many proxies and appends the triangles of the result.
void append_approximation(const Mesh& part, std::size_t proxies, Triangles& result) {
  Triangles triangles;
  CGAL::Surface_mesh_approximation::approximate_triangle_mesh(
      part, CGAL::parameters::seeding_method(CGAL::Surface_mesh_approximation::INCREMENTAL)
                .max_number_of_proxies(proxies)
                .number_of_iterations(10)
                .subdivision_ratio(1)
                .anchors(std::back_inserter(triangles.points))
                .triangles(std::back_inserter(triangles.corners)));
  const std::size_t first = result.points.size();
  result.points.insert(result.points.end(), triangles.points.begin(), triangles.points.end());
  for (const auto& [a, b, c] : triangles.corners) result.corners.push_back({a + first, b + first, c + first});
}

double area(const Triangles& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles.corners)
    sum += std::sqrt(CGAL::squared_area(triangles.points[a], triangles.points[b], triangles.points[c]));
  return sum;
}

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc < 3 || argc > 4 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: approximate_segments MESH PROXIES_PER_SEGMENT [OUT.off]\n";
    return 1;
  }
  CGAL::Polygon_mesh_processing::triangulate_faces(mesh);
  auto segment = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  try {
    const std::size_t segments = RW_segmentation::segmentation_into_surfaces(mesh, segment);
    const auto surfaces = RW_segmentation::segment_surfaces(mesh, segment, segments);
    Triangles result;
    for (std::size_t s = 0; s < segments; ++s) {
      Mesh part;
      CGAL::copy_face_graph(CGAL::Face_filtered_graph<Mesh>(mesh, s, segment), part);
      const bool is_plane = surfaces[s].type == RW_segmentation::Surface_type::plane;
      append_approximation(part, is_plane ? 1 : std::strtoul(argv[2], nullptr, 10), result);
    }
    std::cout << segments << " segments, " << mesh.number_of_faces() << " faces, approximated by "
              << result.corners.size() << " triangles with "
              << std::lround(100 * area(result) / CGAL::Polygon_mesh_processing::area(mesh)) << " % of the area\n";
    if (argc == 4 && !CGAL::IO::write_polygon_soup(argv[3], result.points, result.corners)) {
      std::cerr << argv[3] << " cannot be written\n";
      return 1;
    }
  } catch (const std::exception& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
