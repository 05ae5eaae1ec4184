// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_PARTICLE_SAMPLING_H
#define RW_SEGMENTATION_PARTICLE_SAMPLING_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/feature_sensitive_seeds.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// Places about as many seeds as asked for, to within a tenth on most meshes, by particles that repel one another in the
/// space of (x, w n), split where there is room and die in a crowd (Witkin and Heckbert 1994; section 4.2.1 of the
/// paper); deterministic.
///
/// The particles start from `Farthest_point_sampling` and end more even by straight distance in that space, but less
/// even by paths on the surface, at many times the cost.
class Particle_sampling {
 public:
  Particle_sampling() = default;

  /// \param normal_weight as for `Farthest_point_sampling`
  /// \throws std::invalid_argument unless `normal_weight` is finite and not negative
  explicit Particle_sampling(double normal_weight) : start_(normal_weight) {}

  /// w as a fraction of the square root of the total area.
  double normal_weight() const { return start_.normal_weight(); }

  /// As `Farthest_point_sampling`, but about as many as `count`.
  std::vector<Dual_mesh::Index> operator()(const Dual_mesh& mesh, const std::vector<Dual_mesh::Index>& given,
                                           std::size_t count, const Progress& progress = {}) const;

 private:
  Farthest_point_sampling start_;
};

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Particle_sampling.h>
#endif

#endif
