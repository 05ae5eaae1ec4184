// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_TILES_TURN_HISTOGRAM_H
#define RW_SEGMENTATION_INTERNAL_TILES_TURN_HISTOGRAM_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RW_segmentation::internal {

/// Counts of turns of normals by their size, in steps of a hundredth of it, from a millionth of a radian to 2. Counts of
/// parts add up to those of the whole, in any order.
struct Turn_histogram {
  using Counts = std::vector<std::uint64_t>;

  static constexpr double least = 1e-6, step = 0.01;
  static constexpr std::size_t bins = 1453;  // up to 2; the first is for less

  static Counts counts(const std::vector<double>& turns) {
    Counts counts;
    if (turns.empty()) return counts;
    counts.assign(bins, 0);
    for (const double turn : turns) ++counts[bin_of(turn)];
    return counts;
  }

  static void add(const Counts& part, Counts& whole) {
    whole.resize(std::max(whole.size(), part.size()), 0);
    for (std::size_t bin = 0; bin < part.size(); ++bin) whole[bin] += part[bin];
  }

  /// Of a sample, as those of all that it stands for.
  /// \param sampled not 0
  static Counts scaled(Counts counts, std::uint64_t all, std::uint64_t sampled) {
    for (auto& count : counts) count = count * all / sampled;
    return counts;
  }

  /// The upper one of two; 0 of none.
  static double median(const Counts& counts) {
    std::uint64_t total = 0, sum = 0;
    for (const auto count : counts) total += count;
    for (std::size_t bin = 0; bin < counts.size(); ++bin)
      if ((sum += counts[bin]) > total / 2) return turn_of(bin);
    return 0;
  }

  /// The mean of a function of the turns.
  template <class Function>
  static double mean(const Counts& counts, const Function& function) {
    double sum = 0, total = 0;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
      sum += static_cast<double>(counts[bin]) * function(turn_of(bin));
      total += static_cast<double>(counts[bin]);
    }
    return total > 0 ? sum / total : 0;
  }

 private:
  static std::size_t bin_of(double turn) {
    if (!(turn > least)) return 0;
    return std::min(bins - 1, 1 + static_cast<std::size_t>(std::log(turn / least) / step));
  }
  static double turn_of(std::size_t bin) {
    return bin == 0 ? 0 : least * std::exp((static_cast<double>(bin) - 0.5) * step);
  }
};

}  // namespace RW_segmentation::internal

#endif
