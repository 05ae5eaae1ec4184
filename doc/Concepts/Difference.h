// SPDX-License-Identifier: MIT

/// \cgalConcept Difference
///
/// How different the two faces of an edge are: what the walk should not cross, what distances between coarse seeds add
/// up, and what regions are kept apart by.
///
/// A difference is a readable property map from the mesh's `edge_descriptor` to a number >= 0 that converts to `double`,
/// infinity included. Only interior edges are asked, each of them once by every stage and from one thread, so that
/// `get()` may be slow. A negative number or NaN is refused by an exception that names the edge's faces. What matters are
/// ratios: `Conductance` divides by sigma, so a difference should average about 1 over the edges (Eq. 5).
///
/// In `Segmentation_policies` a difference may also be a *function object* that is called with the dual mesh of the
/// smoothed shape, see `operator()` below.
///
/// \cgalHasModels
/// - Maps: `RW_segmentation::Dihedral_difference`, `RW_segmentation::Curvature_difference`, a stored
///   `Surface_mesh::Property_map<Edge_index, double>`, a lambda in `boost::make_function_property_map<Edge_index>()`
/// - Function objects: `RW_segmentation::Dihedral_difference_policy`, `RW_segmentation::Curvature_difference_policy`
/// - A user's own: `Valley_depth` and an edge map in `examples/own_policies.cpp`, three maps in
///   `examples/own_difference.cpp`
class Difference {
 public:
  /// Of a function object only.
  /// \param mesh a `Dual_mesh_of`, which converts to `const Dual_mesh&`
  /// \param progress may be left out of the signature; told from 0 to 1
  /// \returns a `std::vector<double>` in the order of the mesh's edges, or an edge map
  std::vector<double> operator()(const Dual_mesh& mesh, const Progress& progress) const;
};
