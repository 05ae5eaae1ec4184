// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_NOISE_TRIALS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_NOISE_TRIALS_H

#include <RW_segmentation/Dual_mesh.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

/// The neighbourhoods whose noise is measured have at most so many vertices.
constexpr std::size_t most_vertices_of_noise_trial = 500;

/// Faces about which noise is measured: some in the order of the faces, evenly.
/// \param faces of a mesh or of a part of it
/// \param faces_of_whole that part included; 400 to 800 of them are taken
/// \param faces_before of the whole, before those of the part
inline std::vector<Dual_mesh::Index> noise_trials(std::size_t faces, std::size_t faces_of_whole,
                                                  std::size_t faces_before = 0) {
  constexpr std::size_t trials = 400;
  const std::size_t step = std::max<std::size_t>(1, faces_of_whole / trials);
  std::vector<Dual_mesh::Index> chosen;
  for (std::size_t f = (step - faces_before % step) % step; f < faces; f += step)
    chosen.push_back(static_cast<Dual_mesh::Index>(f));
  return chosen;
}

}  // namespace RW_segmentation::internal

#endif
