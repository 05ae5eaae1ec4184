// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_SPLINE_IN_TENSION_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_SPLINE_IN_TENSION_H

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// One implicit step down the energy
///
///   E = stiffness sum |p(i+1) - 2 p(i) + p(i-1)|^2 + tension sum |p(i+1) - p(i)|^2
///
/// of a sequence of points: solves (I + grad E / 2) p_new = p_old by a Cholesky factorisation, made once.
class Spline_in_tension {
 public:
  using Points = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

  /// \param is_fixed the points that stay where they are
  /// \param is_closed whether the last point is followed by the first; then there are at least three
  Spline_in_tension(const std::vector<char>& is_fixed, bool is_closed, double stiffness, double tension)
      : weight_(static_cast<Eigen::Index>(is_fixed.size())) {
    constexpr double hold = 1e9;  // beside 1 of the points that are free
    const auto size = static_cast<int>(is_fixed.size());
    for (int i = 0; i < size; ++i) {
      weight_[i] = is_fixed[static_cast<std::size_t>(i)] ? hold : 1;
      add({{i, 1}}, weight_[i]);
    }
    for (int i = 0; i < (is_closed ? size : size - 1); ++i) add({{i, -1}, {(i + 1) % size, 1}}, tension);
    for (int i = is_closed ? 0 : 1; i < (is_closed ? size : size - 1); ++i)
      add({{(i + size - 1) % size, 1}, {i, -2}, {(i + 1) % size, 1}}, stiffness);
    Matrix matrix(size, size);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    factor_.compute(matrix);
    entries_ = {};
  }

  void step(Points& points) const {
    const Points weighted = weight_.asDiagonal() * points;
    points = factor_.solve(weighted);
  }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  /// Adds weight (sum of coefficient * point)^2 to the energy.
  void add(std::initializer_list<std::pair<int, double>> terms, double weight) {
    for (const auto& [i, a] : terms)
      for (const auto& [j, b] : terms)
        if (i >= j) entries_.emplace_back(i, j, weight * a * b);
  }

  Eigen::VectorXd weight_;                       // of the old points
  std::vector<Eigen::Triplet<double>> entries_;  // of the lower triangle, until it is factorised
  Eigen::SimplicialLLT<Matrix, Eigen::Lower> factor_;
};

}  // namespace RW_segmentation::internal

#endif
