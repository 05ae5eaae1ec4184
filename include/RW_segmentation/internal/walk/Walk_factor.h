// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_WALK_FACTOR_H
#define RW_SEGMENTATION_INTERNAL_WALK_WALK_FACTOR_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/walk/Any_walk_solver.h>
#include <RW_segmentation/internal/walk/Seed_set.h>
#include <RW_segmentation/internal/walk/Walk_network.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// A solver and the seeds that its factor absorbs at.
class Walk_factor {
 public:
  using Index = Dual_graph::Index;
  /// Of the time of a walk, as its progress tells it.
  static constexpr double when_analysed = 0.3, when_made = 0.7, when_labelled = 0.9;

  explicit Walk_factor(Any_walk_solver solver) : solver_(std::move(solver)) {}

  /// Takes the solver for one that has analysed the graph already.
  void solver_is_analysed() { analysed_ = true; }

  /// Analyses the graph, the first time.
  /// \param progress of the whole walk
  void analyse(const Walk_network& network, const Progress& progress) {
    if (analysed_) return;
    solver_.analyze(network.graph);
    analysed_ = true;
    progress(when_analysed);
  }

  /// Factorises with the seeds absorbing. Analyses the graph before the first time.
  /// \param progress of the whole walk
  void factorise(const Walk_network& network, const Seed_set& seeds, const Progress& progress) {
    made_ = false;
    analyse(network, progress);
    base_ = seeds.faces();
    solver_.factorize(network.conductances, base_, progress.part(when_analysed, when_made));
    made_ = true;
    ++count_;
  }

  /// Whether there is a factor.
  bool is_made() const { return made_; }
  /// Whether the factor absorbs at these seeds and no others.
  bool is_for(const Seed_set& seeds) const {
    return made_ && base_.size() == seeds.size() &&
           std::all_of(base_.begin(), base_.end(), [&](Index face) { return seeds.contains(face); });
  }
  /// Where the factor absorbs.
  const std::vector<Index>& base() const { return base_; }
  const Any_walk_solver& solver() const { return solver_; }
  /// Factorisations that have been made.
  std::size_t count() const { return count_; }

 private:
  Any_walk_solver solver_;
  std::vector<Index> base_;
  bool analysed_ = false, made_ = false;
  std::size_t count_ = 0;
};

}  // namespace RW_segmentation::internal

#endif
