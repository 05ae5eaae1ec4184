// SPDX-License-Identifier: MIT

/// \cgalConcept MergeCost
///
/// What it costs to make one segment of two neighbours; the cheapest pair is merged first.
///
/// A merge cost is copyable. All functions are const and do not depend on the order of their arguments. Costs are never NaN,
/// which is refused by an exception; they need not rise when regions grow, and infinite ones are merged last.
///
/// In `Segmentation_policies` a *function object* from the dual mesh of the smoothed shape to a merge cost may take its
/// place, for costs that compute something of the whole mesh first.
///
/// A cost that must know more of a boundary than `Region_boundary` tells has a type `Boundary` and a function `boundary()`
/// besides; both or neither. Its `operator()` is then given a `Region_boundary_of<Boundary>`.
///
/// \cgalHasModels
/// - `RW_segmentation::Size_aware_cost`, `RW_segmentation::Relative_boundary_cost` (Eq. 10),
///   `RW_segmentation::Analytic_surface_cost`
/// - With a `Boundary`: `RW_segmentation::Learned_cost`
/// - Function objects: `RW_segmentation::Learned_cost_policy`, `RW_segmentation::Size_aware_cost_policy`
/// - A user's own: `Smallest_area_cost` in `examples/own_policies.cpp`
class MergeCost {
 public:
  /// What the cost must know of a region: areas, thickness, curvature moments. Default-constructible and copyable.
  struct Region;

  /// The region of a single face.
  /// \param mesh a `Dual_mesh_of`, for costs that ask for descriptors; it converts to `const Dual_mesh&`
  /// \param face the number of the face
  Region region(const Dual_mesh& mesh, Dual_mesh::Index face) const;

  /// Makes `region` the union of both.
  void join(Region& region, const Region& other) const;

  /// The cost of merging two regions that meet in a boundary.
  double operator()(const Region& a, const Region& b, const Region_boundary& boundary) const;

  /// Optional: sums of one's own over the edges between two regions. Default-constructible (as the sums of no edge) and
  /// copyable, with `operator+=`. Sums must not depend on which of the two regions comes first.
  struct Boundary;

  /// Optional, with `Boundary`: the sums of a single edge that is no wall.
  /// \param mesh as above
  /// \param edge the number of the edge; it may be without length, but a cost is never asked for a boundary without
  /// \param difference of the two faces of the edge
  Boundary boundary(const Dual_mesh& mesh, Dual_mesh::Index edge, double difference) const;

  /// In place of the other one, with `Boundary`: the cost of merging two regions.
  double operator()(const Region& a, const Region& b, const Region_boundary_of<Boundary>& boundary) const;
};
