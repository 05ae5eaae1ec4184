// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_SCALED_SAMPLES_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_SCALED_SAMPLES_H

#include <RW_segmentation/Surface_samples.h>
#include <RW_segmentation/internal/surfaces/solve_symmetric.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace RW_segmentation::internal {

/// Samples of a surface, and where they lie: first guesses of surfaces are made relative to the mean of the points, in
/// units of their spread.
class Scaled_samples {
 public:
  /// A surface whose radius is that many times the spread of its points cannot be told from a simpler one.
  static constexpr double largest_ratio = 50;

  /// Keeps a reference to the samples.
  explicit Scaled_samples(const Surface_samples& samples) : samples_(samples) {
    const auto count = static_cast<double>(std::max<std::size_t>(samples.points.size(), 1));
    for (const Eigen::Vector3d& p : samples.points) mean_ += p;
    mean_ /= count;
    for (const Eigen::Vector3d& p : samples.points) {
      const Eigen::Vector3d offset = p - mean_;
      covariance_ += offset * offset.transpose();
    }
    spread_ = std::sqrt(covariance_.trace() / count);
  }

  const std::vector<Eigen::Vector3d>& points() const { return samples_.points; }
  const std::vector<Eigen::Vector3d>& normals() const { return samples_.normals; }
  const std::vector<Eigen::Vector3d>& normal_points() const { return samples_.normal_points; }
  const Eigen::Vector3d& mean() const { return mean_; }
  /// The root mean square distance of the points from their mean.
  double spread() const { return spread_; }

  /// Whether a surface with that radius can be told from a simpler one.
  bool can_tell_radius(double radius) const { return radius > 0 && radius < largest_ratio * spread_; }

  Eigen::Vector3d scaled(const Eigen::Vector3d& p) const { return (p - mean_) / spread_; }
  Eigen::Vector3d unscaled(const Eigen::Vector3d& p) const { return mean_ + spread_ * p; }

  /// The direction in which the points vary least.
  Eigen::Vector3d flattest_direction() const { return eigenvector_of_least(covariance_ / covariance_.trace()); }

  static Eigen::Vector3d eigenvector_of_least(const Eigen::Matrix3d& m) {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvectors().col(0);
  }

  /// A circle or sphere: its centre, then its radius.
  template <int Dimension>
  using Ball = Eigen::Matrix<double, Dimension + 1, 1>;

  /// The circle or sphere |x - c|^2 = r^2 that is linear in c and r^2 - |c|^2; nothing if it is all but flat.
  /// \param coordinates from a point to those in which the circle is sought
  template <int Dimension, class Coordinates>
  std::optional<Ball<Dimension>> algebraic_ball(const Coordinates& coordinates) const {
    constexpr double determined = 1e-12;  // added to the matrix, lest points on a line or plane make it singular
    Eigen::Matrix<double, Dimension + 1, Dimension + 1> matrix;
    matrix.setZero();
    Ball<Dimension> right = Ball<Dimension>::Zero();
    for (const Eigen::Vector3d& p : points()) {
      const Eigen::Matrix<double, Dimension, 1> x = coordinates(p);
      Ball<Dimension> row;
      row << 2 * x, 1;
      matrix += row * row.transpose();
      right += row * x.squaredNorm();
    }
    matrix.diagonal().array() += determined;
    Ball<Dimension> solution = solve_symmetric<Dimension + 1>(matrix, right);
    const double square = solution[Dimension] + solution.template head<Dimension>().squaredNorm();
    if (!(square > 0) || square > 4 * largest_ratio * largest_ratio) return {};  // least squares may shrink it to half
    solution[Dimension] = std::sqrt(square);
    return solution;
  }

 private:
  const Surface_samples& samples_;
  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();  // times the number of points
  double spread_ = 0;
};

}  // namespace RW_segmentation::internal

#endif
