/// \cgalConcept MergeCost
///
/// What it costs to make one segment of two neighbours; `merge_segments()` merges the cheapest pair first.
///
/// All functions are const and do not depend on the order of their arguments. Costs are never NaN; they need not rise
/// when regions grow.
///
/// \cgalModels `RW_segmentation::Size_aware_cost`, `RW_segmentation::Relative_boundary_cost` (Eq. 10).
class MergeCost {
 public:
  /// What the cost must know of a region: areas, thickness, curvature moments. Default-constructible and copyable.
  struct Region;

  /// The region of a single face.
  Region region(face_descriptor face) const;

  /// Makes `region` the union of both.
  void join(Region& region, const Region& other) const;

  /// The cost of merging two regions that meet in a boundary.
  double operator()(const Region& a, const Region& b, const Region_boundary& boundary) const;
};
