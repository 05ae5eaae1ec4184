// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_EIGEN_WALK_SOLVER_H
#define RW_SEGMENTATION_EIGEN_WALK_SOLVER_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/mesh/Components.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// Which triangle of a matrix one of Eigen's solvers reads, as `Eigen::Lower` or `Eigen::Upper`, or both. Solvers for
/// matrices that need not be symmetric do not say, and read the whole matrix.
template <class EigenSolver, class = void>
struct Triangles_read : std::integral_constant<int, int(Eigen::Lower) | int(Eigen::Upper)> {};
template <class EigenSolver>
struct Triangles_read<EigenSolver, std::void_t<decltype(EigenSolver::UpLo)>>
    : std::integral_constant<int, int(EigenSolver::UpLo)> {};

template <class EigenSolver>
constexpr bool reads_lower_triangle = (Triangles_read<EigenSolver>::value & int(Eigen::Lower)) != 0;
template <class EigenSolver>
constexpr bool reads_upper_triangle = (Triangles_read<EigenSolver>::value & int(Eigen::Upper)) != 0;

}  // namespace internal

/// Solves the walk with any of Eigen's sparse solvers, a model of `WalkSolver`.
///
/// The unknowns are the faces that do not absorb and that reach an absorbing face; the matrix is the graph Laplacian
/// restricted to them, symmetric and positive definite. Solvers that read one triangle of it, which must be the lower one, get
/// that; others, such as `Eigen::SparseLU`, get the whole.
///
/// Subtractions make these solvers lose digits where conductances differ by many orders of magnitude, and neither a
/// residual nor `info()` tells (see \ref own_policies, "A solver"). So each solve carries one more right
/// hand side whose solution is known: with boundary values of 1 everywhere all potentials are 1. When that column, or
/// the range [0, 1] of the others, is missed by more than `accepted_error`, the solve is refused.
///
/// A copy is a fresh solver with the same accepted error; what was set in the solver inside stays behind. A function object
/// that returns a solver gives each of them its settings.
///
/// \tparam EigenSolver a class with Eigen's `compute`, `solve` and `info` on `Eigen::SparseMatrix<double>`:
/// `Eigen::SimplicialLDLT<...>`, `Eigen::CholmodSupernodalLLT<...>`, `Eigen::ConjugateGradient<...>`, `Eigen::SparseLU<...>`
template <class EigenSolver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower>>
class Eigen_walk_solver {
  static_assert(internal::reads_lower_triangle<EigenSolver>,
                "Eigen_walk_solver fills the lower triangle of the matrix: the solver needs Eigen::Lower, as "
                "Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> has it.");

 public:
  /// Numbers faces and edges.
  using Index = Dual_graph::Index;

  /// \param accepted_error absolute, of a potential; a solve that is worse throws
  explicit Eigen_walk_solver(double accepted_error = 1e-6) : accepted_error_(accepted_error) {}
  /// Takes another solver with all that it has computed.
  Eigen_walk_solver(Eigen_walk_solver&&) noexcept = default;
  /// Takes another solver with all that it has computed.
  Eigen_walk_solver& operator=(Eigen_walk_solver&&) noexcept = default;
  /// A fresh solver with the same accepted error.
  Eigen_walk_solver(const Eigen_walk_solver& other) : Eigen_walk_solver(other.accepted_error_) {}
  /// Becomes a fresh solver with the same accepted error.
  Eigen_walk_solver& operator=(const Eigen_walk_solver& other) {
    if (this != &other) *this = Eigen_walk_solver(other);
    return *this;
  }

  /// The solver inside, to set what it offers (tolerances, iterations).
  EigenSolver& eigen_solver() { return *solver_; }

  /// \throws std::length_error for more faces than a 32-bit signed index numbers
  void analyze(const Dual_graph& graph) {
    if (graph.number_of_faces() + graph.number_of_edges() > std::size_t(std::numeric_limits<int>::max()))
      throw std::length_error("Eigen_walk_solver: too many faces for the index type of the matrix");
    graph_ = &graph;
    absorbing_faces_.clear();
  }

  /// \copydoc Star_mesh_elimination::factorize
  /// \throws std::runtime_error if the factorisation fails
  void factorize(const std::vector<double>& conductances, const std::vector<Index>& absorbing_faces,
                 const Progress& progress = {});

  /// \copydoc Star_mesh_elimination::potentials
  /// \throws std::runtime_error if the solver fails or is not accurate
  void potentials(const Potentials& boundary_values, Potentials& potentials) const;

  /// \copydoc Star_mesh_elimination::response
  /// \throws std::runtime_error if the solver fails or is not accurate
  void response(Index face, const std::vector<double>& boundary_values, std::vector<double>& column) const;

  /// \copydoc Star_mesh_elimination::absorbed_currents
  /// \throws std::runtime_error if the solver fails or is not accurate
  std::vector<double> absorbed_currents(Index face) const;

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  static constexpr Index none = std::numeric_limits<Index>::max();

  void number_unknowns();
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

  /// The current that flows from the absorbing faces at the given values into the unknowns.
  Eigen::MatrixXd currents(const Potentials& boundary_values) const;

  double accepted_error_;
  const Dual_graph* graph_ = nullptr;
  std::vector<double> conductances_;
  std::vector<Index> absorbing_faces_;
  std::vector<Index> row_;  // by face: its unknown, `none` for absorbing and for unreached faces
  std::unique_ptr<Matrix> matrix_ = std::make_unique<Matrix>();  // stays where iterative solvers of Eigen refer to it
  std::unique_ptr<EigenSolver> solver_ = std::make_unique<EigenSolver>();
};

// -------------------------------------------------------------------------------------------------------------------

template <class EigenSolver>
void Eigen_walk_solver<EigenSolver>::factorize(const std::vector<double>& conductances,
                                               const std::vector<Index>& absorbing_faces, const Progress& progress) {
  if (!graph_ || conductances.size() != graph_->number_of_edges())
    throw std::invalid_argument("Eigen_walk_solver: the number of conductances is not that of the graph's edges");
  conductances_ = conductances;
  absorbing_faces_ = absorbing_faces;
  number_unknowns();

  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> diagonal(row_.size(), 0.);
  std::size_t unknowns = 0;
  for (std::size_t e = 0; e < conductances_.size(); ++e) {
    const auto [f, g] = graph_->faces_of(static_cast<Index>(e));
    diagonal[f] += conductances_[e];
    diagonal[g] += conductances_[e];
    if (row_[f] != none && row_[g] != none && conductances_[e] > 0) {
      const auto [low, high] = std::minmax({static_cast<int>(row_[f]), static_cast<int>(row_[g])});
      entries.emplace_back(high, low, -conductances_[e]);
      if constexpr (internal::reads_upper_triangle<EigenSolver>) entries.emplace_back(low, high, -conductances_[e]);
    }
  }
  for (std::size_t f = 0; f < row_.size(); ++f) {
    if (row_[f] == none) continue;
    entries.emplace_back(static_cast<int>(row_[f]), static_cast<int>(row_[f]), diagonal[f]);
    ++unknowns;
  }
  matrix_->resize(static_cast<int>(unknowns), static_cast<int>(unknowns));
  matrix_->setFromTriplets(entries.begin(), entries.end());
  progress(0.3);
  if (unknowns > 0) {
    solver_->compute(*matrix_);
    if (solver_->info() != Eigen::Success)
      throw std::runtime_error(
          "Eigen_walk_solver: the factorisation failed (conductances differ too much; a smaller cap "
          "of the difference or Star_mesh_elimination helps)");
  }
  progress(1);
}

/// Numbers the faces from which a walk can be absorbed and that do not absorb themselves.
template <class EigenSolver>
void Eigen_walk_solver<EigenSolver>::number_unknowns() {
  const internal::Components component(*graph_, [&](Index edge) { return conductances_[edge] > 0; });
  std::vector<char> is_reached(component.count, false);
  for (const Index face : absorbing_faces_) is_reached[component.of.at(face)] = true;
  std::vector<char> is_unknown(component.of.size());
  for (std::size_t f = 0; f < is_unknown.size(); ++f) is_unknown[f] = is_reached[component.of[f]];
  for (const Index face : absorbing_faces_) is_unknown[face] = false;
  row_.assign(is_unknown.size(), none);
  Index next = 0;
  for (std::size_t f = 0; f < row_.size(); ++f)
    if (is_unknown[f]) row_[f] = next++;
}

template <class EigenSolver>
Eigen::MatrixXd Eigen_walk_solver<EigenSolver>::currents(const Potentials& boundary_values) const {
  // One more column: all boundary values 1, of which the solution is known.
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(matrix_->rows(), boundary_values.cols() + 1);
  for (std::size_t r = 0; r < absorbing_faces_.size(); ++r)
    for (const auto& [next, edge] : graph_->neighbours(absorbing_faces_[r])) {
      if (row_[next] == none) continue;
      right.row(row_[next]).head(boundary_values.cols()) +=
          conductances_[edge] * boundary_values.row(static_cast<Eigen::Index>(r));
      right(row_[next], boundary_values.cols()) += conductances_[edge];
    }
  return right;
}

template <class EigenSolver>
Eigen::MatrixXd Eigen_walk_solver<EigenSolver>::solve(const Eigen::MatrixXd& right) const {
  if (matrix_->rows() == 0) return right;
  Eigen::MatrixXd solution = solver_->solve(right);
  if (solver_->info() != Eigen::Success)
    throw std::runtime_error("Eigen_walk_solver: the solver did not converge to its tolerance");
  const double error = (solution.rightCols(1).array() - 1).abs().maxCoeff();
  if (!(error <= accepted_error_))
    throw std::runtime_error("Eigen_walk_solver: potentials are wrong by " + std::to_string(error) +
                             " (conductances differ too much; a smaller cap of the difference or "
                             "Star_mesh_elimination helps)");
  return solution;
}

template <class EigenSolver>
void Eigen_walk_solver<EigenSolver>::potentials(const Potentials& boundary_values, Potentials& potentials) const {
  if (boundary_values.rows() != static_cast<Eigen::Index>(absorbing_faces_.size()))
    throw std::invalid_argument("Eigen_walk_solver: boundary values do not fit the absorbing faces");
  const Eigen::MatrixXd solution = solve(currents(boundary_values));
  potentials.setZero(static_cast<Eigen::Index>(row_.size()), boundary_values.cols());
  const double low = boundary_values.minCoeff(), high = boundary_values.maxCoeff();
  for (std::size_t f = 0; f < row_.size(); ++f) {
    if (row_[f] == none) continue;
    const auto row = solution.row(row_[f]).head(boundary_values.cols()).array();
    if (!(row.minCoeff() >= low - accepted_error_ && row.maxCoeff() <= high + accepted_error_))
      throw std::runtime_error("Eigen_walk_solver: a potential leaves the range of the boundary values");
    potentials.row(static_cast<Eigen::Index>(f)) = row.max(low).min(high);
  }
  for (std::size_t r = 0; r < absorbing_faces_.size(); ++r)
    potentials.row(absorbing_faces_[r]) = boundary_values.row(static_cast<Eigen::Index>(r));
}

template <class EigenSolver>
void Eigen_walk_solver<EigenSolver>::response(Index face, const std::vector<double>& boundary_values,
                                              std::vector<double>& column) const {
  if (row_.at(face) == none)
    throw std::invalid_argument("Eigen_walk_solver: face " + std::to_string(face) + " absorbs or reaches no seed");
  const Eigen::Map<const Eigen::VectorXd> values(boundary_values.data(),
                                                 static_cast<Eigen::Index>(boundary_values.size()));
  Eigen::MatrixXd right = currents(values);
  right(row_[face], 0) += 1;
  const Eigen::MatrixXd solution = solve(right);
  column.assign(row_.size(), 0.);
  for (std::size_t f = 0; f < row_.size(); ++f)
    if (row_[f] != none) column[f] = std::max(0., solution(row_[f], 0));
  for (std::size_t r = 0; r < absorbing_faces_.size(); ++r) column[absorbing_faces_[r]] = boundary_values[r];
}

template <class EigenSolver>
std::vector<double> Eigen_walk_solver<EigenSolver>::absorbed_currents(Index face) const {
  std::vector<double> column, absorbed(absorbing_faces_.size(), 0.);
  response(face, absorbed, column);
  for (std::size_t r = 0; r < absorbed.size(); ++r)
    for (const auto& [next, edge] : graph_->neighbours(absorbing_faces_[r]))
      absorbed[r] += conductances_[edge] * column[next];
  return absorbed;
}

}  // namespace RW_segmentation

#endif
