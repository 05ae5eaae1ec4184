// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_BENCHMARK_SEGMENTATION_MEASURES_H
#define RW_SEGMENTATION_BENCHMARK_SEGMENTATION_MEASURES_H

// How much two segmentations of one mesh differ, after X. Chen, A. Golovinskiy, T. Funkhouser, "A Benchmark for 3D Mesh
// Segmentation", ACM TOG 28(3), 2009. Every face counts alike. All measures lie in [0, 1]; 0 is agreement.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace segmentation_measures {

/// How many faces each segment of one segmentation shares with each of another. Labels are any integers.
class Overlaps {
 public:
  template <class LabelA, class LabelB>
  Overlaps(const std::vector<LabelA>& a, const std::vector<LabelB>& b) : faces_(static_cast<double>(a.size())) {
    if (a.size() != b.size())
      throw std::invalid_argument("segmentations of " + std::to_string(a.size()) + " and " + std::to_string(b.size()) +
                                  " faces cannot be compared");
    std::map<LabelA, std::size_t> row;
    std::map<LabelB, std::size_t> column;
    for (const auto& label : a) row.emplace(label, row.size());
    for (const auto& label : b) column.emplace(label, column.size());
    shared_.assign(row.size(), std::vector<double>(column.size(), 0.));
    size_a_.assign(row.size(), 0.);
    size_b_.assign(column.size(), 0.);
    for (std::size_t f = 0; f < a.size(); ++f) {
      const std::size_t i = row.at(a[f]), j = column.at(b[f]);
      shared_[i][j] += 1;
      size_a_[i] += 1;
      size_b_[j] += 1;
    }
  }

  /// The share of the pairs of faces that are together in one segmentation and apart in the other.
  double rand_index_error() const {
    const auto pairs = [](double n) { return n * (n - 1) / 2; };
    if (faces_ < 2) return 0;
    double together_in_a = 0, together_in_b = 0, together_in_both = 0;
    for (const double n : size_a_) together_in_a += pairs(n);
    for (const double n : size_b_) together_in_b += pairs(n);
    for (const auto& row : shared_)
      for (const double n : row) together_in_both += pairs(n);
    return (together_in_a + together_in_b - 2 * together_in_both) / pairs(faces_);
  }

  /// The Hamming distance: each segment is matched with the segment of the other segmentation that covers most of it;
  /// the share of faces that remain uncovered, averaged over both directions.
  double hamming_distance() const {
    double covered_of_a = 0, covered_of_b = 0;
    for (std::size_t i = 0; i < size_a_.size(); ++i)
      covered_of_a += *std::max_element(shared_[i].begin(), shared_[i].end());
    for (std::size_t j = 0; j < size_b_.size(); ++j) {
      double most = 0;
      for (std::size_t i = 0; i < size_a_.size(); ++i) most = std::max(most, shared_[i][j]);
      covered_of_b += most;
    }
    return faces_ == 0 ? 0 : 1 - (covered_of_a + covered_of_b) / (2 * faces_);
  }

  /// The global consistency error: how far one segmentation is from a refinement of the other, all over the mesh in the
  /// same direction.
  double global_consistency_error() const {
    double a_refines_b = 0, b_refines_a = 0;
    for_each_overlap([&](double n, double error_a, double error_b) {
      a_refines_b += n * error_a;
      b_refines_a += n * error_b;
    });
    return faces_ == 0 ? 0 : std::min(a_refines_b, b_refines_a) / faces_;
  }

  /// The local consistency error: as the global one, but each face may choose the direction.
  double local_consistency_error() const {
    double error = 0;
    for_each_overlap([&](double n, double error_a, double error_b) { error += n * std::min(error_a, error_b); });
    return faces_ == 0 ? 0 : error / faces_;
  }

 private:
  /// Calls `visit(faces, share of a's segment outside b's, share of b's segment outside a's)`.
  template <class Visit>
  void for_each_overlap(const Visit& visit) const {
    for (std::size_t i = 0; i < size_a_.size(); ++i)
      for (std::size_t j = 0; j < size_b_.size(); ++j)
        if (shared_[i][j] > 0) visit(shared_[i][j], 1 - shared_[i][j] / size_a_[i], 1 - shared_[i][j] / size_b_[j]);
  }

  double faces_;
  std::vector<std::vector<double>> shared_;
  std::vector<double> size_a_, size_b_;
};

/// The most frequent number, the one nearest the median among several.
inline std::size_t mode_nearest_median(std::vector<std::size_t> numbers) {
  if (numbers.empty()) throw std::invalid_argument("no numbers have no mode");
  std::sort(numbers.begin(), numbers.end());
  const std::size_t n = numbers.size();
  const double median = (static_cast<double>(numbers[(n - 1) / 2]) + static_cast<double>(numbers[n / 2])) / 2;
  const auto distance = [&](std::size_t x) { return std::abs(static_cast<double>(x) - median); };
  std::map<std::size_t, std::size_t> frequency;
  for (const std::size_t x : numbers) ++frequency[x];
  const auto better = [&](const auto& x, const auto& y) {
    return x.second != y.second ? x.second < y.second : distance(x.first) > distance(y.first);
  };
  return std::max_element(frequency.begin(), frequency.end(), better)->first;
}

}  // namespace segmentation_measures

#endif
