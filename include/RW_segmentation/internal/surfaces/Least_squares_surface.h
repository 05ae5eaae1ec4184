// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_LEAST_SQUARES_SURFACE_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_LEAST_SQUARES_SURFACE_H

#include <RW_segmentation/internal/surfaces/Point_block.h>
#include <RW_segmentation/internal/surfaces/Principal_axes.h>
#include <RW_segmentation/internal/surfaces/solve_symmetric.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// The sum of the squared distances of points from a surface.
template <class Type>
double squared_distances(const Type& surface, const std::vector<Eigen::Vector3d>& points) {
  Block_numbers sums = Block_numbers::Zero();
  for (std::size_t i = 0; i < points.size(); i += points_of_block) {
    Block_numbers distances = surface.distance(block_of(points, i));
    clear_beyond(points.size() - i, distances);
    sums += distances * distances;
  }
  return sums.sum();
}

/// Moves a surface until the distances of points from it have the least squares: damped Gauss-Newton steps
/// (Levenberg-Marquardt) over the least number of unknowns.
///
/// \tparam Type a type of surface, see `Surface_types`
template <class Type>
class Least_squares_surface {
 public:
  /// \param largest_residual that is of use; what promises none near it is left where it is
  Least_squares_surface(const Type& surface, const std::vector<Eigen::Vector3d>& points,
                        double largest_residual = std::numeric_limits<double>::infinity())
      : surface_(surface), points_(points), sum_(squared_distances(surface, points)) {
    largest_squares_ = largest_residual * largest_residual * number_of_points();
    if constexpr (!Type::first_guess_is_closest) fit();
  }

  const Type& surface() const { return surface_; }
  /// Root mean square distance of the points.
  double residual() const { return std::sqrt(sum_ / number_of_points()); }

  /// The matrix of the normal equations, whose inverse times the variance of the distances is the covariance of the
  /// unknowns; see `Type::derivatives()`.
  Small_matrix normal_matrix() {
    linearise(typename Type::Frame(surface_));
    Small_matrix matrix(unknowns, unknowns);
    for (int i = 0; i < unknowns; ++i)
      for (int j = 0; j <= i; ++j) matrix(i, j) = matrix(j, i) = hessian_(i, j);
    return matrix;
  }

 private:
  static constexpr int unknowns = Type::degrees_of_freedom;
  static constexpr int points_at_once = 64;  // a multiple of those of a block
  using Matrix = Eigen::Matrix<double, unknowns, unknowns>;
  using Vector = Eigen::Matrix<double, unknowns, 1>;

  double number_of_points() const { return static_cast<double>(points_.size()); }

  void fit() {
    constexpr int most_steps = 20;
    constexpr double least_progress = 1e-3;  // of a step, as a part of the squares
    constexpr double least_far_off = 2e-2;   // likewise, of one beyond the largest residual: 20 such steps gain a third
    // Residuals below a ten-billionth of the mesh: nothing is left to gain.
    const double exact = 1e-20 * number_of_points();
    for (int step = 0; step < most_steps && sum_ > exact; ++step) {
      const double before = sum_;
      if (!descend() || before - sum_ < (sum_ > largest_squares_ ? least_far_off : least_progress) * before) break;
    }
  }

  /// Takes the step with the least damping that lessens the squares. False if there is none, or the linearised distances
  /// hardly lessen and stay too large.
  bool descend() {
    constexpr int most_trials = 4;
    constexpr double damping_factor = 10, hardly_less = 0.8;
    constexpr double out_of_reach = 10;  // largest residuals: linearised steps shrink residuals by less when they fail
    const double hopeless_squares = out_of_reach * out_of_reach * largest_squares_;
    constexpr double determined = 1e-12;  // of the largest diagonal element, lest flat points make the matrix singular
    const typename Type::Frame frame(surface_);
    linearise(frame);
    const double largest = hessian_.diagonal().maxCoeff();
    for (int trial = 0; trial < most_trials; ++trial, damping_ *= damping_factor) {
      Matrix damped = hessian_;
      damped.diagonal() *= 1 + damping_;
      damped.diagonal().array() += determined * largest;
      const Vector step = solve_symmetric<unknowns>(damped, -gradient_);
      if (const double linear = squares_after(step); linear > hopeless_squares && linear > hardly_less * sum_)
        return false;
      const Type moved = surface_.moved(step, frame);
      const double squares_there = squared_distances(moved, points_);
      if (squares_there < sum_) {
        surface_ = moved;
        sum_ = squares_there;
        damping_ /= damping_factor;
        return true;
      }
    }
    return false;
  }

  /// The normal equations at the present surface.
  void linearise(const typename Type::Frame& frame) {
    hessian_.setZero();
    gradient_.setZero();
    // The rows of many points, since a product of long columns is quick.
    Eigen::Array<double, points_at_once, unknowns> rows;
    Eigen::Array<double, points_at_once, 1> distances;
    for (std::size_t first = 0; first < points_.size(); first += points_at_once) {
      const std::size_t end = std::min(points_.size(), first + points_at_once);
      Eigen::Index count = 0;
      for (std::size_t i = first; i < end; i += points_of_block, count += points_of_block) {
        std::array<Block_numbers, unknowns> row;
        Block_numbers distance = surface_.derivatives(block_of(points_, i), frame, row);
        clear_beyond(end - i, distance);
        distances.template segment<points_of_block>(count) = distance;
        for (std::size_t k = 0; k < unknowns; ++k) {
          clear_beyond(end - i, row[k]);
          rows.template block<points_of_block, 1>(count, static_cast<Eigen::Index>(k)) = row[k];
        }
      }
      for (int j = 0; j < unknowns; ++j) {
        const auto column = rows.col(j).head(count);
        for (int i = j; i < unknowns; ++i) hessian_(i, j) += (column * rows.col(i).head(count)).sum();
        gradient_[j] += (column * distances.head(count)).sum();
      }
    }
  }

  /// The squares that the linearised distances have after a step.
  double squares_after(const Vector& step) const {
    double change = 0;
    for (int j = 0; j < unknowns; ++j) {
      double below = 0;
      for (int i = j + 1; i < unknowns; ++i) below += hessian_(i, j) * step[i];
      change += step[j] * (2 * gradient_[j] + hessian_(j, j) * step[j] + 2 * below);
    }
    return sum_ + change;
  }

  Type surface_;
  const std::vector<Eigen::Vector3d>& points_;
  double sum_;              // of the squared distances
  double largest_squares_;  // that are of use
  Matrix hessian_;          // its lower half
  Vector gradient_;
  double damping_ = 1e-4;  // of the first step, as a part of the diagonal: all but none
};

}  // namespace RW_segmentation::internal

#endif
