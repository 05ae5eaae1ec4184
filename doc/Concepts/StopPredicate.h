// SPDX-License-Identifier: MIT

/// \cgalConcept StopPredicate
///
/// Where to stop merging: chooses a level of a `Merge_tree` after all merges have been recorded.
///
/// \cgalHasModels
/// - `RW_segmentation::Segment_count_stop`, `RW_segmentation::Cost_threshold_stop`, `RW_segmentation::Cost_jump_stop`
/// - `RW_segmentation::Any_stop`, which holds any of them and is chosen while a program runs
/// - A user's own: the function `largest_gap` and a lambda in `examples/own_policies.cpp`
class StopPredicate {
 public:
  /// The number of segments to stop at, from `tree.number_of_components()` to `tree.number_of_fragments()`; any other is
  /// refused by an exception that names the range.
  std::size_t operator()(const Merge_tree& tree) const;
};
