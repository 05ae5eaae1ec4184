// SPDX-License-Identifier: MIT

// Curvatures of battered meshes with any radius: numbers, or a refusal.

#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/integral_invariant_curvatures.h>

#include "Fuzzed_input.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

using namespace RW_segmentation;
using fuzz::Mesh;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  const Mesh mesh = input.mesh(false);
  const Ball_radius radius =
      input.flip() ? Ball_radius::in_edge_lengths(input.number(false)) : Ball_radius::absolute(input.number(false));
  fuzz::accepts([&] {
    const Curvature_difference difference(mesh, radius);
    for (const auto e : mesh.edges()) fuzz::require(get(difference, e) >= 0, "a difference is a number from 0 on");
  });
  return 0;
}
