// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_READ_SEEDS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_READ_SEEDS_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/seeds/read_seeds.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE std::vector<Dual_mesh::Index> each_once(std::vector<Dual_mesh::Index> seeds,
                                                               std::size_t number_of_faces) {
  std::vector<bool> is_known(number_of_faces, false);
  std::size_t kept = 0;
  for (std::size_t place = 0; place < seeds.size(); ++place) {
    const Dual_mesh::Index face = seeds[place];
    if (face >= number_of_faces)
      throw std::invalid_argument("given seed " + std::to_string(place) + " is not a face of the mesh");
    if (!is_known[face]) seeds[kept++] = face;
    is_known[face] = true;
  }
  seeds.resize(kept);
  return seeds;
}

}  // namespace RW_segmentation::internal

#endif
