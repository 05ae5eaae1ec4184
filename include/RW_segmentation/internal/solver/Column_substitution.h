// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SOLVER_COLUMN_SUBSTITUTION_H
#define RW_SEGMENTATION_INTERNAL_SOLVER_COLUMN_SUBSTITUTION_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/parallel_for.h>
#include <RW_segmentation/internal/solver/Elimination_plan.h>
#include <RW_segmentation/internal/solver/Label_currents.h>
#include <RW_segmentation/internal/solver/front_kernels.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The potentials when one absorbing face is held at 1 and the others at 0, a column for each of them, from one pass over
/// the factor.
///
/// A supernode is solved for all columns while its part of the factor is in the cache. The potentials of a subtree stand
/// together, where those further down find them in the cache, and are written to the columns once.
class Column_substitution {
 public:
  using Index = Dual_graph::Index;

  explicit Column_substitution(const Factor_view& factor)
      : factor_(factor), currents_(factor_, labels_of(factor)), columns_(factor.absorbing_faces.size()) {
    const Elimination_plan& plan = factor_.plan;
    for (auto& column : columns_) column.resize(plan.face.size());
    Workspaces<Workspace, Concurrency_tag> workspaces([&] { return Workspace(plan); });
    solve_top(workspaces.local());
    parallel_tasks<Concurrency_tag>(plan.subtrees.size(),
                                    [&](std::size_t t) { solve_subtree(plan.subtrees[t], workspaces.local()); });
  }

  /// By absorbing face, then by face.
  std::vector<std::vector<double>> take() && { return std::move(columns_); }

 private:
  using Concurrency_tag = CGAL::Parallel_if_available_tag;
  using Supernode = Elimination_plan::Supernode;
  static constexpr std::size_t width = 8;  ///< columns that the kernel takes together: a block

  /// Potentials at some places, block by block.
  struct Kept {
    std::size_t places = 0;
    std::vector<double> potentials;

    void resize(std::size_t number, std::size_t blocks) {
      places = number;
      if (potentials.size() < number * blocks * width) potentials.resize(number * blocks * width);
    }
    double* at(std::size_t block, std::size_t place) { return &potentials[(block * places + place) * width]; }
  };

  /// Scratch memory of one thread.
  struct Workspace {
    explicit Workspace(const Elimination_plan& plan)
        : front(plan.largest_front * width), place_of_row(plan.largest_row_count) {}

    Kept kept;
    std::vector<double> front;
    std::vector<std::size_t> place_of_row;  // where the potentials at the rows of a supernode are kept
  };

  /// Each absorbing face has a label of its own.
  static std::vector<Index> labels_of(const Factor_view& factor) {
    std::vector<Index> labels(factor.absorbing_faces.size());
    std::iota(labels.begin(), labels.end(), Index(0));
    return labels;
  }

  std::size_t blocks() const { return (columns_.size() + width - 1) / width; }
  const Index* rows_of(const Supernode& supernode) const { return factor_.plan.rows.data() + supernode.rows_begin; }

  /// The supernodes above all subtrees, whose potentials stay for those below.
  void solve_top(Workspace& workspace) {
    const Elimination_plan& plan = factor_.plan;
    std::size_t places = 0;
    for (const Index s : plan.top) {
      top_begin_.push_back(places);
      places += plan.supernodes[s].column_count();
    }
    top_.resize(places, blocks());
    for (std::size_t t = plan.top.size(); t-- > 0;) {
      const Supernode& supernode = plan.supernodes[plan.top[t]];
      for (std::size_t i = 0; i < supernode.row_count; ++i)
        workspace.place_of_row[i] = place_in_top(rows_of(supernode)[i]);
      solve(plan.top[t], top_begin_[t], top_, workspace);
      write(supernode.begin, supernode.end, top_begin_[t], top_);
    }
  }

  std::size_t place_in_top(Index position) const {
    const Elimination_plan& plan = factor_.plan;
    const auto found = std::lower_bound(plan.top.begin(), plan.top.end(), plan.supernode_of[position]);
    return top_begin_[static_cast<std::size_t>(found - plan.top.begin())] + position - plan.supernodes[*found].begin;
  }

  /// The positions of the subtree are kept in their order, then those above it that its root is connected to.
  void solve_subtree(const Elimination_plan::Subtree& subtree, Workspace& workspace) {
    const Elimination_plan& plan = factor_.plan;
    const Supernode& root = plan.supernodes[subtree.root];
    const Index begin = plan.supernodes[subtree.first].begin;
    const std::size_t positions = root.end - begin;
    Kept& kept = workspace.kept;
    kept.resize(positions + root.row_count, blocks());
    const Index* above = rows_of(root);
    for (std::size_t i = 0; i < root.row_count; ++i) {
      const std::size_t place = place_in_top(above[i]);
      for (std::size_t block = 0; block < blocks(); ++block)
        std::copy_n(top_.at(block, place), width, kept.at(block, positions + i));
    }
    for (Index s = subtree.root + 1; s-- > subtree.first;) {
      const Supernode& supernode = plan.supernodes[s];
      const Index* row = rows_of(supernode);
      std::size_t place_above = 0;
      for (std::size_t i = 0; i < supernode.row_count; ++i) {
        if (row[i] < root.end) {
          workspace.place_of_row[i] = row[i] - begin;
          continue;
        }
        while (above[place_above] != row[i]) ++place_above;
        workspace.place_of_row[i] = positions + place_above;
      }
      solve(s, supernode.begin - begin, kept, workspace);
    }
    write(begin, root.end, 0, kept);
  }

  /// \param place where the first position of the supernode is kept
  void solve(Index s, std::size_t place, Kept& kept, Workspace& workspace) const {
    const Supernode& supernode = factor_.plan.supernodes[s];
    const std::size_t pivots = supernode.column_count(), rows = supernode.row_count;
    double* const front = workspace.front.data();
    for (std::size_t block = 0; block < blocks(); ++block) {
      std::fill_n(front, pivots * width, 0.);
      if (factor_.carries_current[s]) set_currents(s, block, front);
      for (std::size_t i = 0; i < rows; ++i)
        std::copy_n(kept.at(block, workspace.place_of_row[i]), width, front + (pivots + i) * width);
      substitute<width>(factor_.transition + supernode.factor_begin, pivots, rows,
                        factor_.absorbing.data() + supernode.begin, front, factor_.instructions);
      std::copy_n(front, pivots * width, kept.at(block, place));
    }
  }

  void set_currents(Index s, std::size_t block, double* front) const {
    const std::size_t pivots = factor_.plan.supernodes[s].column_count();
    const Index *begin = currents_.begin(s), *end = currents_.end(s);
    const Index* label = std::lower_bound(begin, end, static_cast<Index>(block * width));
    for (; label != end && *label < (block + 1) * width; ++label)
      for (std::size_t k = 0; k < pivots; ++k) front[k * width + *label % width] = currents_.at(s, k)[label - begin];
  }

  void write(Index begin, Index end, std::size_t place, Kept& kept) {
    for (std::size_t block = 0; block < blocks(); ++block) {
      const std::size_t first = block * width, count = std::min(width, columns_.size() - first);
      for (Index k = begin; k < end; ++k) {
        const double* potential = kept.at(block, place + k - begin);
        const Index face = factor_.plan.face[k];
        for (std::size_t l = 0; l < count; ++l) columns_[first + l][face] = potential[l];
      }
    }
  }

  const Factor_view factor_;
  const Label_currents currents_;
  std::vector<std::vector<double>> columns_;  // by absorbing face, then by face
  std::vector<std::size_t> top_begin_;        // in the order of `plan.top`: where the potentials are kept in `top_`
  Kept top_;
};

}  // namespace RW_segmentation::internal

#endif
