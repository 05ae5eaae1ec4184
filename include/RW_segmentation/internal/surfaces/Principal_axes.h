// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_PRINCIPAL_AXES_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_PRINCIPAL_AXES_H

#include <Eigen/Core>
#include <Eigen/Jacobi>

#include <cmath>
#include <limits>
#include <utility>

namespace RW_segmentation::internal {

/// A square matrix of up to 7 rows, as many as a surface has unknowns.
using Small_matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 7, 7>;
using Small_vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 7, 1>;

/// The eigenvalues and eigenvectors of a symmetric matrix, the least first, by Jacobi's cyclic rotations (Golub and Van Loan,
/// Matrix Computations, 8.5).
///
/// 6 rows take 1.9 microseconds, by Eigen's solver for any number of rows 1.4; but that takes 4 s to compile, a twentieth of
/// which this takes.
class Principal_axes {
 public:
  using Index = Eigen::Index;

  /// \param symmetric its upper half is read
  explicit Principal_axes(const Small_matrix& symmetric)
      : matrix_(symmetric), vectors_(Small_matrix::Identity(symmetric.rows(), symmetric.rows())) {
    constexpr int most_sweeps = 30;  // random matrices of 6 rows take 5
    int sweeps = 0;
    while (sweeps < most_sweeps && rotate_all()) ++sweeps;
    sort();
  }

  Small_vector values() const { return matrix_.diagonal(); }
  /// One in each column.
  const Small_matrix& vectors() const { return vectors_; }

 private:
  /// \returns whether there was anything to do
  bool rotate_all() {
    const double least = std::numeric_limits<double>::epsilon() * matrix_.diagonal().cwiseAbs().maxCoeff();
    bool has_rotated = false;
    for (Index q = 1; q < matrix_.cols(); ++q)
      for (Index p = 0; p < q; ++p)
        if (std::abs(matrix_(p, q)) > least) {
          rotate(p, q);
          has_rotated = true;
        }
    return has_rotated;
  }

  /// Turns two axes so that the element between them vanishes.
  void rotate(Index p, Index q) {
    Eigen::JacobiRotation<double> rotation;
    rotation.makeJacobi(matrix_(p, p), matrix_(p, q), matrix_(q, q));
    const double cosine = rotation.c(), sine = rotation.s();
    const auto turn = [&](double& x, double& y) {
      const double before = x;
      x = cosine * before - sine * y;
      y = sine * before + cosine * y;
    };
    const double moved = sine / cosine * matrix_(p, q);
    matrix_(p, p) -= moved;
    matrix_(q, q) += moved;
    matrix_(p, q) = 0;
    for (Index k = 0; k < p; ++k) turn(matrix_(k, p), matrix_(k, q));
    for (Index k = p + 1; k < q; ++k) turn(matrix_(p, k), matrix_(k, q));
    for (Index k = q + 1; k < matrix_.cols(); ++k) turn(matrix_(p, k), matrix_(q, k));
    for (Index k = 0; k < vectors_.rows(); ++k) turn(vectors_(k, p), vectors_(k, q));
  }

  void sort() {
    for (Index i = 0; i < matrix_.cols(); ++i) {
      Index least = i;
      for (Index j = i + 1; j < matrix_.cols(); ++j)
        if (matrix_(j, j) < matrix_(least, least)) least = j;
      if (least == i) continue;
      std::swap(matrix_(i, i), matrix_(least, least));
      for (Index k = 0; k < vectors_.rows(); ++k) std::swap(vectors_(k, i), vectors_(k, least));
    }
  }

  Small_matrix matrix_;  // its upper half; diagonal in the end
  Small_matrix vectors_;
};

}  // namespace RW_segmentation::internal

#endif
