/// \cgalConcept StopPredicate
///
/// Where to stop merging: chooses a level of a `Merge_tree` after all merges have been recorded.
///
/// \cgalModels `RW_segmentation::Segment_count_stop`, `RW_segmentation::Cost_threshold_stop`,
/// `RW_segmentation::Cost_jump_stop`; any lambda, for example one that stops at the largest gap between costs.
class StopPredicate {
 public:
  /// The number of segments to stop at, from `tree.number_of_components()` to `tree.number_of_fragments()`.
  std::size_t operator()(const Merge_tree& tree) const;
};
