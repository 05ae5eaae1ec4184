// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_DIVIDED_TRIANGLE_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_DIVIDED_TRIANGLE_H

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// A triangle with further points on its sides, divided into triangles along given chords such that the lowest height
/// of a triangle, relative to the longest side, is as large as can be.
///
/// Found by dynamic programming over the stretches of the outline: O(n^3) for n points.
class Divided_triangle {
 public:
  /// From a point to a point.
  using Chord = std::array<std::size_t, 2>;

  /// The points at which triangles are cut off, one after the other: what is left is a polygon that the next one sticks
  /// out of. Triangles are numbered in this order.
  using Ears = std::vector<std::size_t>;

  /// \param points in counterclockwise order
  Divided_triangle(const std::vector<Eigen::Vector3d>& points, const std::vector<Chord>& chords)
      : points_(points), size_(points.size()), chords_(chords) {
    if (!choose_apexes()) return;
    triangle_at_side_.resize(size_);
    beside_.resize(chords_.size());
    least_height_ = std::numeric_limits<double>::infinity();
    collect(0, size_ - 1);
    points_.clear();
    apex_.clear();
  }

  /// Of all triangles; 0 if the chords cross.
  double least_height() const { return least_height_; }

  /// The points that are cut off, one for each triangle but the last.
  const Ears& ears() const { return ears_; }
  /// The triangle at the side from point i to the next.
  std::size_t triangle_at_side(std::size_t i) const { return triangle_at_side_[i]; }
  bool is_chord(std::size_t i, std::size_t j) const {
    return std::any_of(chords_.begin(), chords_.end(), [&](const Chord& chord) {
      return chord == Chord{i, j} || chord == Chord{j, i};
    });
  }
  /// The triangles on the left and on the right of a chord.
  const std::array<std::size_t, 2>& triangles_beside(std::size_t chord) const { return beside_[chord]; }
  /// Pairs of triangles with a common side that is no chord.
  const std::vector<std::array<std::size_t, 2>>& joined_triangles() const { return joined_; }

 private:
  double longest_side(std::size_t i, std::size_t j, std::size_t k) const {
    return std::max(
        {(points_[i] - points_[j]).norm(), (points_[j] - points_[k]).norm(), (points_[k] - points_[i]).norm()});
  }

  double height(std::size_t i, std::size_t j, std::size_t k) const {
    const double side = longest_side(i, j, k);
    return side > 0 ? (points_[j] - points_[i]).cross(points_[k] - points_[i]).norm() / side : 0;
  }

  double relative_height(std::size_t i, std::size_t j, std::size_t k) const {
    const double side = longest_side(i, j, k);
    return side > 0 ? height(i, j, k) / side : 0;
  }

  bool crosses_chord(std::size_t i, std::size_t j) const {
    return std::any_of(chords_.begin(), chords_.end(), [&](const Chord& chord) {
      const auto [a, b] = std::minmax(chord[0], chord[1]);
      return (i < a && a < j && j < b) || (a < i && i < b && b < j);
    });
  }

  std::size_t& apex(std::size_t i, std::size_t j) { return apex_[i * size_ + j]; }

  /// For each stretch i .. j of the outline, the third corner of the triangle at the line from i to j.
  bool choose_apexes() {
    for (const auto& [a, b] : chords_)
      if (crosses_chord(std::min(a, b), std::max(a, b))) return false;
    apex_.assign(size_ * size_, 0);
    std::vector<double> best(size_ * size_, std::numeric_limits<double>::infinity());
    for (std::size_t length = 2; length < size_; ++length)
      for (std::size_t i = 0; i + length < size_; ++i) {
        const std::size_t j = i + length;
        double& quality = best[i * size_ + j];
        quality = -1;
        if (crosses_chord(i, j)) continue;
        for (std::size_t k = i + 1; k < j; ++k) {
          const double q = std::min({best[i * size_ + k], best[k * size_ + j], relative_height(i, k, j)});
          if (q > quality) {
            quality = q;
            apex(i, j) = k;
          }
        }
      }
    return best[size_ - 1] >= 0;
  }

  /// Notes the triangles of a stretch, those on the outside first. Returns the number of the one at its line.
  std::size_t collect(std::size_t i, std::size_t j) {
    const std::size_t k = apex(i, j);
    const std::size_t before = k == i + 1 ? none : collect(i, k), after = j == k + 1 ? none : collect(k, j);
    const std::size_t triangle = number_of_triangles_++;
    if (number_of_triangles_ + 2 < size_) ears_.push_back(k);
    least_height_ = std::min(least_height_, height(i, k, j));
    meet(i, k, triangle, before);
    meet(k, j, triangle, after);
    if (i == 0 && j == size_ - 1) triangle_at_side_[j] = triangle;
    return triangle;
  }

  /// The line from i to j, with a triangle on its left and another, if it is no side, on its right.
  void meet(std::size_t i, std::size_t j, std::size_t left, std::size_t right) {
    if (right == none) {
      triangle_at_side_[i] = left;
      return;
    }
    for (std::size_t c = 0; c < chords_.size(); ++c) {
      if (chords_[c] == Chord{i, j})
        beside_[c] = {left, right};
      else if (chords_[c] == Chord{j, i})
        beside_[c] = {right, left};
      else
        continue;
      return;
    }
    joined_.push_back({left, right});
  }

  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  std::vector<Eigen::Vector3d> points_;
  std::size_t size_;
  std::vector<Chord> chords_;
  std::vector<std::size_t> apex_;
  double least_height_ = 0;
  std::size_t number_of_triangles_ = 0;
  Ears ears_;
  std::vector<std::size_t> triangle_at_side_;
  std::vector<std::array<std::size_t, 2>> beside_;
  std::vector<std::array<std::size_t, 2>> joined_;
};

}  // namespace RW_segmentation::internal

#endif
