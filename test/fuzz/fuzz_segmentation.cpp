// All policies with any numbers on battered meshes: connected segments, as many as said, or a refusal that writes
// nothing.

#include <RW_segmentation/Engineering_segmentation.h>
#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include "Fuzzed_input.h"

#include <cstddef>
#include <cstdint>
#include <vector>

using namespace RW_segmentation;
using fuzz::Mesh;

namespace {

constexpr std::size_t untouched = 1000000;

template <class Policy>
void segment(const Mesh& mesh, const Policy& policy, fuzz::Input& input) {
  std::vector<std::size_t> label(mesh.num_faces(), untouched);
  const auto map = boost::make_iterator_property_map(label.begin(), get(CGAL::face_index, mesh));
  std::vector<Mesh::Face_index> seeds;
  if (mesh.number_of_faces() > 0)
    for (std::size_t n = input.below(4); n > 0; --n) seeds.push_back(input.face_of(mesh));
  std::size_t segments = 0;
  if (!fuzz::accepts([&] { segments = segmentation_via_random_walks(mesh, map, policy, seeds); })) {
    for (const std::size_t l : label) fuzz::require(l == untouched, "a refusal writes nothing");
    return;
  }
  fuzz::require(fuzz::are_connected_segments(mesh, label, segments), "segments are connected and numbered from 0");
  if (policy.number_of_segments && mesh.number_of_faces() > 0)
    fuzz::require(segments == *policy.number_of_segments, "there are as many segments as asked for");
  if (input.below(4) == 0)
    fuzz::require(segment_surfaces(mesh, map, segments).size() == segments, "each segment has a surface");
}

template <class Policy>
void set_common_numbers(Policy& policy, fuzz::Input& input) {
  if (input.flip()) policy.number_of_segments = input.below(12);
  if (input.below(4) == 0) policy.stop_cost = input.number(false);
  if (input.below(4) == 0) policy.sigma = input.number(false);
  if (input.below(4) == 0) policy.cap = input.number(false);
  if (input.below(4) == 0) policy.convex_weight = input.number(false);
  if (input.below(4) == 0) policy.smoothing.radius = input.number(false);
  if (input.below(4) == 0) policy.smoothing.noise_angle = input.number(false);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  const std::size_t kind = input.below(3);
  const Mesh mesh = input.mesh(kind == 2);
  if (kind == 0) {
    Automatic_segmentation policy;
    set_common_numbers(policy, input);
    if (input.below(4) == 0) policy.seeds = input.below(300);
    if (input.below(4) == 0) policy.ordinary_difference = input.number(false);
    segment(mesh, policy, input);
  } else if (kind == 1) {
    Paper_segmentation policy;
    set_common_numbers(policy, input);
    segment(mesh, policy, input);
  } else {
    Engineering_segmentation policy;
    set_common_numbers(policy, input);
    if (input.below(4) == 0) policy.noise = input.number(false);
    segment(mesh, policy, input);
  }
  return 0;
}
