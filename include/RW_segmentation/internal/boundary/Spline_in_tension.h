// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_SPLINE_IN_TENSION_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_SPLINE_IN_TENSION_H

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// One implicit step down the energy
///
///   E = stiffness sum |p(i+1) - 2 p(i) + p(i-1)|^2 + tension sum |p(i+1) - p(i)|^2
///
/// of a sequence of points: solves (I + grad E / 2) p_new = p_old by a band Cholesky factorisation, made once.
class Spline_in_tension {
 public:
  using Points = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

  /// \param is_fixed the points that stay where they are
  /// \param is_closed whether the last point is followed by the first; then there are at least three
  Spline_in_tension(const std::vector<char>& is_fixed, bool is_closed, double stiffness, double tension)
      : size_(is_fixed.size()), is_closed_(is_closed), row_(size_) {
    constexpr double hold = 1e9;
    const std::size_t joints = is_closed ? size_ : size_ - 1;
    for (std::size_t i = 0; i < size_; ++i) add({{i, 1}}, is_fixed[i] ? hold : 1);
    weight_.assign(size_, 1);
    for (std::size_t i = 0; i < size_; ++i)
      if (is_fixed[i]) weight_[i] = hold;
    for (std::size_t i = 0; i < joints; ++i) add({{i, -1}, {(i + 1) % size_, 1}}, tension);
    for (std::size_t i = is_closed ? 0 : 1; i < (is_closed ? size_ : size_ - 1); ++i)
      add({{(i + size_ - 1) % size_, 1}, {i, -2}, {(i + 1) % size_, 1}}, stiffness);
    factorize();
  }

  void step(Points& points) const {
    Points x(points.rows(), 6);
    for (std::size_t i = 0; i < size_; ++i) x.row(row(i)) = weight_[i] * points.row(static_cast<Eigen::Index>(i));
    for (std::size_t r = 0; r < size_; ++r) {
      for (std::size_t k = 1; k <= std::min(r, band); ++k) x.row(at(r)) -= row_[r][k] * x.row(at(r - k));
      x.row(at(r)) /= row_[r][0];
    }
    for (std::size_t r = size_; r-- > 0;) {
      x.row(at(r)) /= row_[r][0];
      for (std::size_t k = 1; k <= std::min(r, band); ++k) x.row(at(r - k)) -= row_[r][k] * x.row(at(r));
    }
    for (std::size_t i = 0; i < size_; ++i) points.row(static_cast<Eigen::Index>(i)) = x.row(row(i));
  }

 private:
  // In a closed sequence the second half is folded between the points of the first: 0, n-1, 1, n-2, ... Then points
  // two apart are at most four rows apart, round the end, too.
  static constexpr std::size_t band = 4;

  static Eigen::Index at(std::size_t r) { return static_cast<Eigen::Index>(r); }
  Eigen::Index row(std::size_t i) const {
    if (!is_closed_) return at(i);
    return at(2 * i < size_ ? 2 * i : 2 * (size_ - 1 - i) + 1);
  }

  /// Adds weight (sum of coefficient * point)^2 to the energy.
  void add(std::initializer_list<std::pair<std::size_t, double>> terms, double weight) {
    for (const auto& [i, a] : terms)
      for (const auto& [j, b] : terms) {
        const auto r = row(i), s = row(j);
        if (r >= s) row_[static_cast<std::size_t>(r)][static_cast<std::size_t>(r - s)] += weight * a * b;
      }
  }

  void factorize() {
    for (std::size_t r = 0; r < size_; ++r)
      for (std::size_t k = std::min(r, band) + 1; k-- > 0;) {
        double value = row_[r][k];
        for (std::size_t l = k + 1; l <= std::min(r, band); ++l)
          if (l - k <= band) value -= row_[r][l] * row_[r - k][l - k];
        row_[r][k] = k == 0 ? std::sqrt(value) : value / row_[r - k][0];
      }
  }

  std::size_t size_;
  bool is_closed_;
  std::vector<double> weight_;                     // of the old points
  std::vector<std::array<double, band + 1>> row_;  // of the lower triangle: the diagonal, then leftward
};

}  // namespace RW_segmentation::internal

#endif
