// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_POINT_BLOCK_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_POINT_BLOCK_H

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace RW_segmentation::internal {

/// The coordinates of one point, or of several that the same is computed for at once.
/// \tparam Number `double`, or an array of Eigen's
template <class Number>
struct Coordinates {
  Number x, y, z;

  Number dot(const Eigen::Vector3d& v) const { return x * v.x() + y * v.y() + z * v.z(); }
  Number squared_norm() const { return x * x + y * y + z * z; }
  Coordinates minus(const Eigen::Vector3d& v) const { return {x - v.x(), y - v.y(), z - v.z()}; }
  /// This less so many times a vector.
  Coordinates minus(const Number& times, const Eigen::Vector3d& v) const {
    return {x - times * v.x(), y - times * v.y(), z - times * v.z()};
  }
};

inline Coordinates<double> coordinates(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

/// One number, or several that are equal.
template <class Number>
Number all(double x) {
  if constexpr (std::is_same_v<Number, double>)
    return x;
  else
    return Number::Constant(x);
}

inline double square_root(double x) { return std::sqrt(x); }
inline double at_least(double x, double least) { return std::max(x, least); }

/// A few points at once, whose number fits the registers of all processors.
constexpr int points_of_block = 4;
using Block_numbers = Eigen::Array<double, points_of_block, 1>;
using Point_block = Coordinates<Block_numbers>;

inline Block_numbers square_root(const Block_numbers& x) { return x.sqrt(); }
inline Block_numbers at_least(const Block_numbers& x, double least) { return x.max(least); }

/// The points from a place on, the last one again where there are too few.
inline Point_block block_of(const std::vector<Eigen::Vector3d>& points, std::size_t first) {
  Point_block block;
  for (int k = 0; k < points_of_block; ++k) {
    const Eigen::Vector3d& p = points[std::min(first + static_cast<std::size_t>(k), points.size() - 1)];
    block.x[k] = p.x();
    block.y[k] = p.y();
    block.z[k] = p.z();
  }
  return block;
}

/// Sets the numbers of points to 0 that are none, after those that `block_of()` began with.
inline void clear_beyond(std::size_t points, Block_numbers& numbers) {
  for (int k = points_of_block; static_cast<std::size_t>(k--) > points;) numbers[k] = 0;
}

}  // namespace RW_segmentation::internal

#endif
