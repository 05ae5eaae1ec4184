// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_WALK_LABELS_H
#define RW_SEGMENTATION_INTERNAL_WALK_WALK_LABELS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/internal/solver/front_kernels.h>
#include <RW_segmentation/internal/walk/Seed_set.h>
#include <RW_segmentation/internal/walk/Walk_network.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Which label has the largest potential at each face, the lowest one on a tie.
///
/// Labels are known by their *ranks*: those of seeds ascending, then those of components without a seed.
class Walk_labels {
 public:
  using Index = Dual_graph::Index;
  using Label = Seed_set::Label;
  static constexpr Index none = std::numeric_limits<Index>::max();

  /// Of no face.
  Walk_labels() = default;

  /// Every face has the first label, at a potential of 1.
  /// \param former labels, whose memory is used again
  Walk_labels(const Walk_network& network, const Seed_set& seeds, Walk_labels& former)
      : labels_(seeds.labels()),
        number_of_seed_labels_(labels_.size()),
        rank_(network.graph.number_of_faces(), 0),
        largest_(std::move(former.largest_)) {
    largest_.assign(rank_.size(), 1.);
  }

  bool empty() const { return rank_.empty(); }
  std::size_t number_of_labels() const { return labels_.size(); }
  std::size_t number_of_seed_labels() const { return number_of_seed_labels_; }
  Label label(std::size_t rank) const { return labels_[rank]; }
  /// By face.
  const std::vector<Index>& ranks() const { return rank_; }
  /// By face: the potential of its label, NaN where that is not known.
  const std::vector<double>& largest() const { return largest_; }

  /// The rank of a label of seeds, `none` for another.
  Index rank_of(Label label) const {
    const auto end = labels_.begin() + static_cast<std::ptrdiff_t>(number_of_seed_labels_);
    const auto found = std::lower_bound(labels_.begin(), end, label);
    return found != end && *found == label ? static_cast<Index>(found - labels_.begin()) : none;
  }

  /// The labels of faces with given ranks.
  std::vector<Label> labels_of(const std::vector<Index>& ranks) const {
    std::vector<Label> result(ranks.size());
    for (std::size_t f = 0; f < result.size(); ++f) result[f] = labels_[ranks[f]];
    return result;
  }

  /// Takes what a solver has found.
  void take(Largest_potentials&& largest) {
    rank_ = std::move(largest.labels);
    largest_ = std::move(largest.potentials);
  }

  /// Takes the potentials that others have found, and leaves the ranks as they are.
  void take_potentials(Walk_labels&& others) { largest_ = std::move(others.largest_); }

  /// Before potentials are compared.
  void begin() { std::fill(largest_.begin(), largest_.end(), -1.); }

  /// Takes the potentials of labels with ranks from `first` on, one column a label; labels come in their order.
  void compare(const Walk_network& network, const Potentials& potentials, std::size_t first) {
    const auto width = static_cast<std::size_t>(potentials.cols());
    for_stretches(network, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const double* row = potentials.data() + f * width;
        for (std::size_t l = 0; l < width; ++l)
          if (row[l] > largest_[f]) {
            largest_[f] = row[l];
            rank_[f] = static_cast<Index>(first + l);
          }
      }
    });
  }

  /// Takes the potentials of all labels, each the sum of the columns of its seeds.
  /// \param columns_of by rank: potentials by face
  /// \param is_seeded by component
  /// \param prepare called as `prepare(begin, end)` before the potentials of a stretch of faces are read
  /// \returns false if those of some reached face do not add up to 1 within `tolerance`: digits were lost
  template <class Prepare>
  bool compare_sums(const Walk_network& network, const std::vector<std::vector<const double*>>& columns_of,
                    const std::vector<char>& is_seeded, double tolerance, const Prepare& prepare);

  /// Gives each component without a seed the next unused label.
  /// \returns how many there are
  std::size_t label_unseeded_components(const Walk_network& network, const std::vector<char>& is_seeded);

  /// By rank: whether a label has the faces that it had before, and is none of the doubtful ones.
  std::vector<char> unchanged_since(const Walk_labels& before, const std::vector<Label>& doubtful) const;

 private:
  std::vector<Label> labels_;              // by rank
  std::size_t number_of_seed_labels_ = 0;  // which come first
  std::vector<Index> rank_;                // by face
  std::vector<double> largest_;            // by face
};

template <class Prepare>
bool Walk_labels::compare_sums(const Walk_network& network, const std::vector<std::vector<const double*>>& columns_of,
                               const std::vector<char>& is_seeded, double tolerance, const Prepare& prepare) {
  const Instruction_set instructions = best_instruction_set();
  std::atomic<bool> sums_are_right = true;
  for_stretches(network, [&](std::size_t begin, std::size_t end) {
    prepare(begin, end);  // here, while they are in the cache
    const std::size_t count = end - begin;
    std::array<double, faces_at_a_time> sum, total, best;
    std::fill_n(&largest_[begin], count, -1.);
    total.fill(0);
    for (std::size_t l = 0; l < number_of_seed_labels_; ++l) {
      const double* potential = columns_of[l].front() + begin;
      if (columns_of[l].size() > 1) {
        sum.fill(0);
        for (const double* column : columns_of[l])
          for (std::size_t i = 0; i < count; ++i) sum[i] += column[begin + i];
        potential = sum.data();
      }
      select_largest(potential, static_cast<double>(l), count, {&largest_[begin], best.data(), total.data()},
                     instructions);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_seeded[network.component.of[begin + i]]) continue;
      if (!(std::abs(total[i] - 1) < tolerance)) sums_are_right = false;
      rank_[begin + i] = static_cast<Index>(best[i]);
    }
  });
  return sums_are_right;
}

inline std::size_t Walk_labels::label_unseeded_components(const Walk_network& network,
                                                          const std::vector<char>& is_seeded) {
  std::vector<Index> rank(network.component.count, 0);
  const std::vector<Label> in_use = labels_;
  Label next = labels_.back();
  for (std::size_t c = 0; c < rank.size(); ++c) {
    if (is_seeded[c]) continue;
    // Negative labels of a user are large numbers here, after which it begins again at 0.
    do ++next;
    while (std::binary_search(in_use.begin(), in_use.end(), next));
    rank[c] = static_cast<Index>(labels_.size());
    labels_.push_back(next);
  }
  const std::size_t unseeded = labels_.size() - in_use.size();
  if (unseeded == 0) return 0;
  for (std::size_t f = 0; f < rank_.size(); ++f)
    if (const Index c = network.component.of[f]; !is_seeded[c]) rank_[f] = rank[c];
  return unseeded;
}

inline std::vector<char> Walk_labels::unchanged_since(const Walk_labels& before,
                                                      const std::vector<Label>& doubtful) const {
  if (before.empty()) return std::vector<char>(labels_.size(), 0);
  std::vector<Index> rank_now(before.labels_.size());
  for (std::size_t l = 0; l < rank_now.size(); ++l) rank_now[l] = rank_of(before.labels_[l]);
  std::vector<char> unchanged(labels_.size(), 1);
  for (std::size_t f = 0; f < rank_.size(); ++f) {
    const Index was = rank_now[before.rank_[f]];
    if (was == rank_[f]) continue;
    unchanged[rank_[f]] = 0;
    if (was != none) unchanged[was] = 0;
  }
  for (const Label label : doubtful)
    if (const Index rank = rank_of(label); rank != none) unchanged[rank] = 0;
  return unchanged;
}

}  // namespace RW_segmentation::internal

#endif
