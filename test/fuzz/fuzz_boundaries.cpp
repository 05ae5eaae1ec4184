// SPDX-License-Identifier: MIT

// Smooths and cuts the boundaries of any labels on battered meshes with any walls: the surface stays where it is, and so
// do the segments.

#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/split_along_boundaries.h>

#include "../boundaries.h"
#include "Fuzzed_input.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace RW_segmentation;
using fuzz::Mesh;

namespace {

/// By which new points are rounded.
double largest_coordinate(const Mesh& mesh) {
  double largest = 0;
  for (const auto v : mesh.vertices())
    for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(mesh.point(v)[i]));
  return largest;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  Mesh mesh = input.mesh(true);
  const std::vector<std::size_t> labels = input.labels(mesh, 1 + input.below(5));
  auto label = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  for (const auto f : mesh.faces()) label[f] = labels[f];
  Boundary_smoothing smoothing;
  if (input.below(4) == 0) smoothing.length = input.number(false);
  if (input.below(4) == 0) smoothing.tension = input.number(false);
  if (input.below(4) == 0) smoothing.feature_weight = input.number(false);
  if (input.below(4) == 0) smoothing.largest_displacement = input.number(false);
  if (input.below(4) == 0) smoothing.crease_angle = input.number(false);

  const auto np = CGAL::parameters::edge_is_constrained_map(input.walls(mesh));
  std::vector<Boundary_curve<Mesh>> curves;
  if (!fuzz::accepts([&] { curves = smooth_boundaries(mesh, label, smoothing, np); })) return 0;
  const auto before = boundaries::measures(mesh, label);
  if (!fuzz::accepts([&] { split_along_boundaries(mesh, curves, label); })) {
    fuzz::require(boundaries::measures(mesh, label).faces == before.faces, "a refusal leaves the mesh as it was");
    return 0;
  }
  const auto after = boundaries::measures(mesh, label);
  fuzz::require(mesh.is_valid(false) && CGAL::is_triangle_mesh(mesh), "the mesh is a valid triangle mesh");
  if (before.area > 1e-100 && before.area < 1e100)  // its square is a number
    fuzz::require(std::abs(after.area - before.area) <=
                      1e-9 * before.area + 1e-13 * largest_coordinate(mesh) * std::sqrt(before.area),
                  "the area stays");
  fuzz::require(after.border_edges >= before.border_edges, "the border stays");
  fuzz::require(after.regions == before.regions && after.labels == before.labels, "the segments stay");
  return 0;
}
