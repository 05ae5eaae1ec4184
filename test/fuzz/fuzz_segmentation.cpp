// SPDX-License-Identifier: MIT

// All policies with any numbers on battered meshes with any walls: connected segments, as many as said, or a refusal that
// writes nothing.

#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/Paper_segmentation.h>
#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include "Fuzzed_input.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

using namespace RW_segmentation;
using fuzz::Mesh;

namespace {

constexpr std::size_t untouched = 1000000;

/// \param segment writes ids into a map and returns how many there are
/// \param wanted the number of segments asked for
template <class Segment>
void check(const Mesh& mesh, const fuzz::Walls& walls, std::optional<std::size_t> wanted, fuzz::Input& input,
           const Segment& segment) {
  std::vector<std::size_t> label(mesh.num_faces(), untouched);
  const auto map = boost::make_iterator_property_map(label.begin(), get(CGAL::face_index, mesh));
  std::size_t segments = 0;
  if (!fuzz::accepts([&] { segments = segment(map); })) {
    for (const std::size_t l : label) fuzz::require(l == untouched, "a refusal writes nothing");
    return;
  }
  fuzz::require(fuzz::are_connected_segments(mesh, walls, label, segments),
                "segments are connected, not over walls, and numbered from 0");
  if (wanted && mesh.number_of_faces() > 0)
    fuzz::require(segments == *wanted, "there are as many segments as asked for");
  if (input.below(4) == 0)
    fuzz::require(segment_surfaces(mesh, map, segments).size() == segments, "each segment has a surface");
}

/// The segments of policies with other numbers.
template <class Policies>
void check_policies(const Mesh& mesh, const fuzz::Walls& walls, Policies policies, fuzz::Input& input) {
  std::optional<std::size_t> wanted;
  if (input.flip()) policies.stop = Segment_count_stop(*(wanted = input.below(12)));
  if (!wanted && input.flip()) fuzz::accepts([&] { policies.stop = Cost_threshold_stop(input.number(false)); });
  if (input.below(4) == 0) policies.sigma = input.number(false);
  if (input.below(4) == 0) policies.cap = input.number(false);
  if (input.below(4) == 0) policies.smoothing.radius = input.number(false);
  if (input.below(4) == 0) policies.smoothing.noise_angle = input.number(false);
  std::vector<Mesh::Face_index> seeds;
  if (mesh.number_of_faces() > 0)
    for (std::size_t n = input.below(4); n > 0; --n) seeds.push_back(input.face_of(mesh));
  check(mesh, walls, wanted, input, [&](auto map) {
    return segmentation_via_random_walks(mesh, map, policies, seeds, CGAL::parameters::edge_is_constrained_map(walls));
  });
}

/// Differences of angles with any numbers.
Dihedral_difference_policy angles(Dihedral_difference_policy difference, fuzz::Input& input) {
  if (input.below(4) == 0) difference.convex_weight = input.number(false);
  if (input.below(4) == 0) difference.ordinary_difference = input.number(false);
  return difference;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  const std::size_t kind = input.below(5);
  Mesh mesh = input.mesh(kind == 4);
  const fuzz::Walls walls = input.walls(mesh);
  if (kind == 0) {
    Automatic_segmentation policies;
    if (input.below(4) == 0) policies.seeding.count = input.below(300);
    policies.difference = angles(policies.difference, input);
    check_policies(mesh, walls, policies, input);
  } else if (kind == 1) {
    Paper_segmentation policies;
    policies.difference = angles(policies.difference, input);
    check_policies(mesh, walls, policies, input);
  } else if (kind == 2) {
    Coarse_paper_segmentation policies;
    policies.difference = angles(policies.difference, input);
    check_policies(mesh, walls, policies, input);
  } else if (kind == 3) {
    check_policies(mesh, walls, Automatic_segmentation().with_difference(Curvature_difference_policy()), input);
  } else {
    Surface_segmentation numbers;
    if (input.flip()) numbers.number_of_segments = input.below(12);
    if (input.below(4) == 0) numbers.stop_cost = input.number(false);
    if (input.below(4) == 0) numbers.noise = input.number(false);
    check(mesh, walls, numbers.number_of_segments, input, [&](auto map) {
      return segmentation_into_surfaces(mesh, map, numbers, CGAL::parameters::edge_is_constrained_map(walls));
    });
  }
  return 0;
}
