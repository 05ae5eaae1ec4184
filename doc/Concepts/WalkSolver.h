// SPDX-License-Identifier: MIT

/// \cgalConcept WalkSolver
///
/// Solves the Dirichlet problem of a random walk on a `Dual_graph`: the potentials of all faces when some, the absorbing
/// ones, are held at given values and current is conserved at all others.
///
/// A solver is movable. `Segmentation_policies` copy it, and a copy has analysed nothing; where it cannot be copied, or needs
/// settings of its own, a *function object* without arguments that returns a solver takes its place. It is
/// default-constructible where `Random_walk` is given none.
///
/// The functions are called in the order below; each may be called again with other arguments. A solver that fails, or
/// cannot promise its accuracy, throws `std::runtime_error` with the reason; it never returns a wrong answer. A face from
/// which no absorbing face can be reached has the potential 0.
///
/// \cgalHasModels
/// - `RW_segmentation::Star_mesh_elimination`
/// - `RW_segmentation::Eigen_walk_solver` over any of Eigen's sparse solvers, its own or those that it wraps
/// - A user's own: `Factorisation` in `examples/own_policies.cpp`, a function object
class WalkSolver {
 public:
  /// Prepares for a graph: orderings and the like. The graph outlives the solver or the next `analyze`.
  void analyze(const Dual_graph& graph);

  /// Prepares for conductances, one an edge, finite and >= 0 (0 cuts the edge), and for the absorbing faces, all
  /// different. May report to `progress` from 0 to 1.
  void factorize(const std::vector<double>& conductances, const std::vector<Dual_graph::Index>& absorbing_faces,
                 const Progress& progress);

  /// The potentials of all faces (rows) for several right hand sides (columns): row r of `boundary_values` holds the
  /// values of the r-th absorbing face. Values are from 0 to 1 or any others; potentials stay in their range.
  void potentials(const Potentials& boundary_values, Potentials& potentials) const;

  /// The potentials of all faces when a unit current enters at `face` and the absorbing faces are held at
  /// `boundary_values`. Throws `std::invalid_argument` if the face absorbs or reaches no absorbing face.
  void response(Dual_graph::Index face, const std::vector<double>& boundary_values, std::vector<double>& column) const;

  /// The probabilities that a walk from `face` ends at each absorbing face. Throws as `response`.
  std::vector<double> absorbed_currents(Dual_graph::Index face) const;

  /// Optional: the label with the largest potential at each face, the lowest one on a tie, where that costs less than all
  /// potentials, and its potential where that is known. `labels` has one entry for each absorbing face; any label will do for a face that reaches none.
  Largest_potentials largest_potentials(const std::vector<Dual_graph::Index>& labels, std::size_t number_of_labels,
                                        const Progress& progress) const;

  /// Optional: the potentials when one absorbing face is held at 1 and the others at 0, a column for each of them, by face,
  /// where that costs less than `potentials`.
  std::vector<std::vector<double>> columns() const;
};
