// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SOLVER_LABEL_CURRENTS_H
#define RW_SEGMENTATION_INTERNAL_SOLVER_LABEL_CURRENTS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/solver/Elimination_plan.h>
#include <RW_segmentation/internal/solver/front_kernels.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The factor of a `Star_mesh_factor`, for reading.
struct Factor_view {
  const Elimination_plan& plan;
  const double* transition;                         ///< p_ki, packed columns of each supernode
  const std::vector<double>& sum;                   ///< d_k by position
  const std::vector<Dual_graph::Index>& absorbing;  ///< by position: 1 + place in `absorbing_faces`, 0 for others
  const std::vector<Dual_graph::Index>& absorbing_faces;
  const std::vector<char>& carries_current;  ///< by supernode: an absorbing face lies in its subtree
  Instruction_set instructions;
};

/// The current that arrives at positions from the seeds eliminated before them, label by label, divided by d_k.
///
/// Only the supernodes on the ways from seeds to the roots get any, each that of the labels with a seed below or in it.
class Label_currents {
 public:
  using Index = Dual_graph::Index;
  static constexpr Index none = Elimination_plan::none;

  /// Keeps a reference to the factor.
  /// \param labels by absorbing face
  Label_currents(const Factor_view& factor, const std::vector<Index>& labels) : factor_(factor) {
    collect_labels(labels);
    for (std::size_t s = 0; s < factor.plan.supernodes.size(); ++s)
      if (factor.carries_current[s]) pass_on(static_cast<Index>(s), labels);
  }

  /// The labels with a seed in the subtree of a supernode, ascending.
  const Index* begin(Index s) const { return labels_.data() + first_label_[s]; }
  const Index* end(Index s) const { return labels_.data() + first_label_[s + std::size_t(1)]; }
  std::size_t number_of_labels(Index s) const { return first_label_[s + std::size_t(1)] - first_label_[s]; }

  /// The currents at a column of a supernode, in the order of its labels.
  const double* at(Index s, std::size_t column) const {
    return current_.data() + first_current_[s] + column * number_of_labels(s);
  }

 private:
  void collect_labels(const std::vector<Index>& labels) {
    const Elimination_plan& plan = factor_.plan;
    std::vector<std::size_t> by_label(labels.size());
    std::iota(by_label.begin(), by_label.end(), std::size_t(0));
    std::stable_sort(by_label.begin(), by_label.end(), [&](auto a, auto b) { return labels[a] < labels[b]; });
    // Where a label has come by already, it has come by all the way up to the root.
    std::vector<Index> last_label(plan.supernodes.size(), none);
    std::vector<std::pair<Index, Index>> below;  // supernode, label
    first_label_.assign(plan.supernodes.size() + 1, 0);
    for (const std::size_t r : by_label)
      for (Index s = plan.supernode_of[plan.position[factor_.absorbing_faces[r]]];
           s != none && last_label[s] != labels[r]; s = plan.supernodes[s].parent) {
        last_label[s] = labels[r];
        below.emplace_back(s, labels[r]);
        ++first_label_[s + std::size_t(1)];
      }
    std::partial_sum(first_label_.begin(), first_label_.end(), first_label_.begin());
    labels_.resize(below.size());
    std::vector<std::size_t> next = first_label_;
    for (const auto& [s, label] : below) labels_[next[s]++] = label;
    first_current_.assign(plan.supernodes.size(), 0);
    std::size_t currents = 0;
    for (std::size_t s = 0; s < plan.supernodes.size(); ++s) {
      first_current_[s] = currents;
      currents += plan.supernodes[s].column_count() * number_of_labels(static_cast<Index>(s));
    }
    current_.assign(currents, 0.);
  }

  /// Where the labels of one supernode stand among those of another, which has them all.
  void match_labels(Index from, Index to, std::vector<std::size_t>& place) const {
    place.clear();
    const Index* other = begin(to);
    for (const Index* label = begin(from); label != end(from); ++label) {
      while (*other != *label) ++other;
      place.push_back(static_cast<std::size_t>(other - begin(to)));
    }
  }

  /// Sends what has arrived at the columns of a supernode on to later ones and to its rows: each column of the factor is
  /// read once and as it lies.
  void pass_on(Index s, const std::vector<Index>& labels) {
    const auto& supernode = factor_.plan.supernodes[s];
    const std::size_t pivots = supernode.column_count(), size = supernode.front_size(), count = number_of_labels(s);
    front_.assign(count * size, 0.);
    for (std::size_t k = 0; k < pivots; ++k)
      for (std::size_t l = 0; l < count; ++l) front_[l * size + k] = column(s, k)[l];
    const double* p = factor_.transition + supernode.factor_begin;
    for (std::size_t k = 0; k < pivots; ++k) {
      if (const Index absorbing = factor_.absorbing[supernode.begin + k]) set_to_seed(s, k, labels[absorbing - 1]);
      const std::size_t later = size - k - 1;
      for (std::size_t l = 0; l < count; ++l) {
        double* const own = &front_[l * size + k];
        add(*own, p, later, own + 1);
      }
      p += later;
    }
    pass_to_rows(s);
    for (std::size_t k = 0; k < pivots; ++k) {
      const double d = factor_.absorbing[supernode.begin + k] ? 1 : factor_.sum[supernode.begin + k];
      for (std::size_t l = 0; l < count; ++l) column(s, k)[l] = d > 0 ? front_[l * size + k] / d : 0;
    }
  }

  void pass_to_rows(Index s) {
    const Elimination_plan& plan = factor_.plan;
    const auto& supernode = plan.supernodes[s];
    const std::size_t pivots = supernode.column_count(), size = supernode.front_size();
    const Index* rows = plan.rows.data() + supernode.rows_begin;
    for (std::size_t i = 0; i < supernode.row_count;) {
      const Index ancestor = plan.supernode_of[rows[i]];
      match_labels(s, ancestor, place_);
      for (; i < supernode.row_count && rows[i] < plan.supernodes[ancestor].end; ++i) {
        double* const to = column(ancestor, rows[i] - plan.supernodes[ancestor].begin);
        for (std::size_t l = 0; l < place_.size(); ++l) to[place_[l]] += front_[l * size + pivots + i];
      }
    }
  }

  /// A seed sends on what it is held at, whatever arrives.
  void set_to_seed(Index s, std::size_t k, Index label) {
    const std::size_t size = factor_.plan.supernodes[s].front_size(), count = number_of_labels(s);
    for (std::size_t l = 0; l < count; ++l) front_[l * size + k] = begin(s)[l] == label;
  }

  static void add(double share, const double* from, std::size_t count, double* to) {
    if (share == 0) return;
    for (std::size_t i = 0; i < count; ++i) to[i] += share * from[i];
  }

  double* column(Index s, std::size_t k) { return current_.data() + first_current_[s] + k * number_of_labels(s); }

  const Factor_view& factor_;
  std::vector<std::size_t> first_label_, first_current_, place_;
  std::vector<Index> labels_;
  std::vector<double> current_;
  std::vector<double> front_;  // scratch: what arrives at the columns and rows of one supernode, label by label
};

}  // namespace RW_segmentation::internal

#endif
