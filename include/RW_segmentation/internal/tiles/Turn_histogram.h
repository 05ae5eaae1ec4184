// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_TILES_TURN_HISTOGRAM_H
#define RW_SEGMENTATION_INTERNAL_TILES_TURN_HISTOGRAM_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Counts of turns of normals by their size, in steps of a hundredth of it, from a millionth of a radian to 2. Counts of
/// parts add up to those of the whole, in any order.
struct Turn_histogram {
  /// How many turns are in a bin that has any.
  struct Count {
    std::uint32_t bin;
    std::uint64_t turns;
    bool operator==(const Count& other) const { return bin == other.bin && turns == other.turns; }
  };
  /// By bin, rising. Pieces of a few faces, of which a tile may have many thousands, have few of the bins.
  using Counts = std::vector<Count>;

  static constexpr double least = 1e-6, step = 0.01;
  static constexpr std::size_t bins = 1453;  // up to 2; the first is for less

  static Counts counts(const std::vector<double>& turns) {
    std::vector<std::uint64_t> of_bin(bins, 0);
    for (const double turn : turns) ++of_bin[bin_of(turn)];
    Counts counts;
    for (std::uint32_t b = 0; b < bins; ++b)
      if (of_bin[b] > 0) counts.push_back({b, of_bin[b]});
    return counts;
  }

  static void add(const Counts& part, Counts& whole) {
    Counts sum;
    auto next = whole.begin();
    for (const Count& count : part) {
      while (next != whole.end() && next->bin < count.bin) sum.push_back(*next++);
      const bool have_both = next != whole.end() && next->bin == count.bin;
      sum.push_back({count.bin, count.turns + (have_both ? (next++)->turns : 0)});
    }
    sum.insert(sum.end(), next, whole.end());
    whole = std::move(sum);
  }

  /// Of a sample, as those of all that it stands for.
  /// \param sampled not 0
  static Counts scaled(Counts counts, std::uint64_t all, std::uint64_t sampled) {
    for (auto& [bin, turns] : counts) turns = turns * all / sampled;
    return counts;
  }

  /// The upper one of two; 0 of none.
  static double median(const Counts& counts) {
    std::uint64_t total = 0, sum = 0;
    for (const auto& [bin, turns] : counts) total += turns;
    for (const auto& [bin, turns] : counts)
      if ((sum += turns) > total / 2) return turn_of(bin);
    return 0;
  }

  /// The mean of a function of the turns.
  template <class Function>
  static double mean(const Counts& counts, const Function& function) {
    double sum = 0, total = 0;
    for (const auto& [bin, turns] : counts) {
      sum += static_cast<double>(turns) * function(turn_of(bin));
      total += static_cast<double>(turns);
    }
    return total > 0 ? sum / total : 0;
  }

 private:
  static std::size_t bin_of(double turn) {
    if (!(turn > least)) return 0;
    return std::min(bins - 1, 1 + static_cast<std::size_t>(std::log(turn / least) / step));
  }
  static double turn_of(std::uint32_t bin) {
    return bin == 0 ? 0 : least * std::exp((static_cast<double>(bin) - 0.5) * step);
  }
};

}  // namespace RW_segmentation::internal

#endif
