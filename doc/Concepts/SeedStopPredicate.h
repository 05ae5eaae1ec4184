// SPDX-License-Identifier: MIT

/// \cgalConcept SeedStopPredicate
///
/// Where coarse seeding ends, for `coarse_seeds()` and `Coarse_seeding`.
///
/// \cgalHasModels
/// - `RW_segmentation::Seed_count_stop`, `RW_segmentation::Separation_threshold_stop`,
///   `RW_segmentation::Separation_decrease_stop`
/// - A user's own: any lambda from the separations to `bool`
class SeedStopPredicate {
 public:
  /// \param separation of the seeds in their order, infinite for the first one of each component, and last that of the
  /// candidate
  /// \returns whether seeding ends without the candidate. It must not end before each component has a seed, and must end
  /// by the time that all faces are seeds and the separation is 0; otherwise an exception is thrown.
  bool operator()(const std::vector<double>& separation) const;
};
