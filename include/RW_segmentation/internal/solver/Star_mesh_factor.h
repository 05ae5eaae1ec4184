// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SOLVER_STAR_MESH_FACTOR_H
#define RW_SEGMENTATION_INTERNAL_SOLVER_STAR_MESH_FACTOR_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/parallel_for.h>
#include <RW_segmentation/internal/solver/Column_substitution.h>
#include <RW_segmentation/internal/solver/Elimination_plan.h>
#include <RW_segmentation/internal/solver/Label_currents.h>
#include <RW_segmentation/internal/solver/Pruned_substitution.h>
#include <RW_segmentation/internal/solver/front_kernels.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

namespace RW_segmentation::internal {

/// The elimination of `Star_mesh_elimination`, whose functions it has.
class Star_mesh_factor {
 public:
  using Index = Dual_graph::Index;

  void analyze(const Dual_graph& graph) {
    plan_ = Elimination_plan(graph);
    number_of_edges_ = graph.number_of_edges();
    absorbing_faces_.clear();
    transition_.reset();
  }
  void factorize(const std::vector<double>& conductances, const std::vector<Index>& absorbing_faces,
                 const Progress& progress = {});
  void potentials(const Potentials& boundary_values, Potentials& potentials) const;
  void response(Index face, const std::vector<double>& boundary_values, std::vector<double>& column) const;
  std::vector<double> absorbed_currents(Index face) const;
  std::vector<std::vector<double>> columns() const;
  Largest_potentials largest_potentials(const std::vector<Index>& labels, std::size_t number_of_labels,
                                        const Progress& progress = {}) const;

  /// Faces from which no absorbing face can be reached were met in the last factorisation.
  bool has_unreached_faces() const { return has_unreached_faces_; }

  /// Bytes held by the factor.
  std::size_t factor_memory() const { return (plan_.factor_size + sum_.size()) * sizeof(double); }

 private:
  using Supernode = Elimination_plan::Supernode;
  static constexpr Index none = Elimination_plan::none;

  /// Marks the supernodes that current from the faces passes through: the ways from them to the roots of the tree.
  std::vector<char> ways_to_roots(const std::vector<Index>& faces) const {
    std::vector<char> marked(plan_.supernodes.size(), 0);
    for (const Index face : faces)
      for (Index s = plan_.supernode_of[plan_.position[face]]; s != none && !marked[s]; s = plan_.supernodes[s].parent)
        marked[s] = 1;
    return marked;
  }

  /// Carries the sources in x (positions x labels) and the boundary values (one row an absorbing face) forward through
  /// the marked supernodes and scales them by 1/d_k. Absorbing faces are left with the current that arrived there.
  /// \returns whether all current that enters can leave
  template <std::size_t labels>
  bool forward(const std::vector<char>& marked, const std::vector<double>& boundary, std::vector<double>& x) const;

  /// Sets the boundary values and substitutes back through the marked supernodes, all if there are no marks.
  template <std::size_t labels>
  void backward(const std::vector<char>& marked, const std::vector<double>& boundary, std::vector<double>& x) const;

  template <std::size_t labels>
  void solve_columns(const Potentials& boundary_values, Eigen::Index first, Eigen::Index width,
                     Potentials& potentials) const;

  std::size_t position_of_source(Index face) const {
    const std::size_t k = plan_.position.at(face);
    if (!transition_ || absorbing_[k])
      throw std::invalid_argument("Star_mesh_elimination: face " + std::to_string(face) + " absorbs");
    return k;
  }

  [[noreturn]] static void refuse_source(Index face) {
    throw std::invalid_argument("Star_mesh_elimination: no walk from face " + std::to_string(face) + " is absorbed");
  }

  Factor_view view() const {
    return {plan_, transition_.get(), sum_, absorbing_, absorbing_faces_, carries_current_, instructions_};
  }

  using Concurrency_tag = CGAL::Parallel_if_available_tag;

  /// The numbers that a supernode leaves for its parent: conductances between its rows, column by column on and below
  /// the diagonal, then those from its rows to seeds eliminated.
  struct Left {
    Index supernode;
    const double* numbers;
  };

  /// Scratch memory of one thread.
  struct Workspace {
    explicit Workspace(const Elimination_plan& plan)
        : panel(plan.largest_panel),
          remainder(plan.largest_row_count * plan.largest_row_count),
          scaled(plan.largest_front * front_block),
          packed(kernel::packed_size(plan.largest_front)),
          ground(plan.largest_front),
          stack(plan.stack_size),
          row_in_front(plan.face.size()),
          child_rows(plan.largest_row_count) {}

    std::vector<double> panel, remainder, scaled, packed, ground, stack;
    std::vector<Index> row_in_front, child_rows;  // by position; of a child's rows
  };

  std::vector<double> eliminate_subtree(const Elimination_plan::Subtree& subtree,
                                        const std::vector<double>& conductances, Workspace& workspace);
  template <bool in_parallel>
  void eliminate_supernode(Index s, const std::vector<double>& conductances, const Left* children, Workspace& workspace,
                           double* left);
  void assemble(const Supernode& supernode, const std::vector<double>& conductances, const Left* children,
                Workspace& workspace) const;

  template <std::size_t labels>
  void substitute_back(Index s, std::vector<double>& front, std::vector<double>& x) const;

  Elimination_plan plan_;
  std::size_t number_of_edges_ = 0;
  std::vector<Index> absorbing_faces_;
  std::vector<Index> absorbing_;          // by position: 1 + place in absorbing_faces_, 0 for other faces
  std::vector<char> carries_current_;     // by supernode
  std::unique_ptr<double[]> transition_;  // p_ki, packed columns of each supernode
  std::vector<double> sum_;               // d_k by position
  bool has_unreached_faces_ = false;
  Instruction_set instructions_ = best_instruction_set();
};

// -------------------------------------------------------------------------------------------------------------------

inline void Star_mesh_factor::factorize(const std::vector<double>& conductances,
                                        const std::vector<Index>& absorbing_faces, const Progress& progress) {
  const std::size_t n = plan_.face.size();
  if (conductances.size() != number_of_edges_)
    throw std::invalid_argument("Star_mesh_elimination: " + std::to_string(conductances.size()) +
                                " conductances for a graph of " + std::to_string(number_of_edges_) + " edges");
  absorbing_faces_ = absorbing_faces;
  absorbing_.assign(n, 0);
  for (std::size_t r = 0; r < absorbing_faces.size(); ++r)
    absorbing_[plan_.position.at(absorbing_faces[r])] = static_cast<Index>(r + 1);
  carries_current_ = ways_to_roots(absorbing_faces);

  // Uninitialised on purpose: every entry is written once below.
  if (!transition_) transition_.reset(new double[plan_.factor_size]);
  sum_.assign(n, 0);

  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<std::size_t> supernodes_done = 0;
  const auto count = [&](std::size_t supernodes) {
    const std::size_t done = supernodes_done += supernodes;
    if (std::this_thread::get_id() == caller)
      progress(static_cast<double>(done) / static_cast<double>(plan_.supernodes.size()));
  };
  Workspaces<Workspace, Concurrency_tag> workspaces([&] { return Workspace(plan_); });
  std::vector<std::vector<double>> left_by_subtree(plan_.subtrees.size());
  parallel_tasks<Concurrency_tag>(plan_.subtrees.size(), [&](std::size_t t) {
    const auto& subtree = plan_.subtrees[t];
    left_by_subtree[t] = eliminate_subtree(subtree, conductances, workspaces.local());
    count(subtree.root + std::size_t(1) - subtree.first);
  });

  std::vector<Left> waiting;
  std::vector<std::vector<double>> numbers;  // of those waiting
  std::size_t next_subtree = 0;
  const auto wait_for_parent = [&](Index s, std::vector<double> left) {
    if (plan_.supernodes[s].parent == none) return;
    waiting.push_back({s, left.data()});
    numbers.push_back(std::move(left));
  };
  for (const Index s : plan_.top) {
    for (; next_subtree < plan_.subtrees.size() && plan_.subtrees[next_subtree].root < s; ++next_subtree)
      wait_for_parent(plan_.subtrees[next_subtree].root, std::move(left_by_subtree[next_subtree]));
    std::vector<double> left(plan_.supernodes[s].left_size());
    const std::size_t others = waiting.size() - plan_.supernodes[s].children;
    eliminate_supernode<true>(s, conductances, waiting.data() + others, workspaces.local(), left.data());
    waiting.resize(others);
    numbers.resize(others);
    wait_for_parent(s, std::move(left));
    count(1);
  }
  has_unreached_faces_ = false;
  for (std::size_t k = 0; k < n; ++k) has_unreached_faces_ |= !(sum_[k] > 0) && !absorbing_[k];
  progress(1);
}

/// \returns what the root leaves for its parent
inline std::vector<double> Star_mesh_factor::eliminate_subtree(const Elimination_plan::Subtree& subtree,
                                                               const std::vector<double>& conductances,
                                                               Workspace& workspace) {
  std::vector<Left> waiting;
  double* top = workspace.stack.data();
  for (Index s = subtree.first; s <= subtree.root; ++s) {
    const Supernode& supernode = plan_.supernodes[s];
    const std::size_t others = waiting.size() - supernode.children;
    for (std::size_t child = others; child < waiting.size(); ++child)
      top -= plan_.supernodes[waiting[child].supernode].left_size();
    eliminate_supernode<false>(s, conductances, waiting.data() + others, workspace, top);
    waiting.resize(others);
    waiting.push_back({s, top});
    top += supernode.left_size();
  }
  return {workspace.stack.data(), top};
}

/// \param left output, may lie where the numbers of the first child lie
template <bool in_parallel>
void Star_mesh_factor::eliminate_supernode(Index s, const std::vector<double>& conductances, const Left* children,
                                           Workspace& workspace, double* left) {
  const Supernode& supernode = plan_.supernodes[s];
  const std::size_t pivots = supernode.column_count(), rows = supernode.row_count;
  assemble(supernode, conductances, children, workspace);
  const Front front{pivots,
                    rows,
                    workspace.panel.data(),
                    workspace.remainder.data(),
                    absorbing_.data() + supernode.begin,
                    carries_current_[s] ? workspace.ground.data() : nullptr,
                    sum_.data() + supernode.begin,
                    transition_.get() + supernode.factor_begin,
                    workspace.scaled.data(),
                    workspace.packed.data()};
  if constexpr (in_parallel)
    eliminate_in_parallel<Concurrency_tag>(front, instructions_);
  else
    eliminate(front, instructions_);
  for (std::size_t j = 0; j < rows; ++j)
    left = std::copy(&front.remainder[j * rows + j], front.remainder + (j + 1) * rows, left);
  if (carries_current_[s]) std::copy_n(front.ground + pivots, rows, left);
}

/// Fills the front of a supernode with the conductances of the graph and what the children have left.
inline void Star_mesh_factor::assemble(const Supernode& supernode, const std::vector<double>& conductances,
                                       const Left* children, Workspace& workspace) const {
  const std::size_t pivots = supernode.column_count(), rows = supernode.row_count, size = pivots + rows;
  const Index* row = plan_.rows.data() + supernode.rows_begin;
  double *const panel = workspace.panel.data(), *const remainder = workspace.remainder.data();
  Index* const row_in_front = workspace.row_in_front.data();
  for (std::size_t j = 0; j < pivots; ++j) row_in_front[supernode.begin + j] = static_cast<Index>(j);
  for (std::size_t i = 0; i < rows; ++i) row_in_front[row[i]] = static_cast<Index>(pivots + i);

  std::fill_n(panel, size * pivots, 0.);
  std::fill_n(remainder, rows * rows, 0.);
  std::fill_n(workspace.ground.data(), size, 0.);
  for (std::size_t j = 0; j < pivots; ++j)
    for (std::size_t q = plan_.later_begin[supernode.begin + j]; q < plan_.later_begin[supernode.begin + j + 1]; ++q)
      panel[j * size + row_in_front[plan_.later[q].position]] += conductances[plan_.later[q].edge];
  for (Index c = supernode.children; c-- > 0;) {
    const auto& [child, numbers] = children[c];
    const Supernode& below = plan_.supernodes[child];
    const std::size_t count = below.row_count;
    Index* const child_rows = workspace.child_rows.data();
    for (std::size_t i = 0; i < count; ++i) child_rows[i] = row_in_front[plan_.rows[below.rows_begin + i]];
    const double* value = numbers;
    for (std::size_t j = 0; j < count; ++j) {
      const std::size_t column = child_rows[j];
      double* target = column < pivots ? panel + column * size : remainder + (column - pivots) * rows - pivots;
      for (std::size_t i = j; i < count; ++i) target[child_rows[i]] += *value++;
    }
    if (carries_current_[child])
      for (std::size_t i = 0; i < count; ++i) workspace.ground[child_rows[i]] += *value++;
  }
}

inline void Star_mesh_factor::potentials(const Potentials& boundary_values, Potentials& potentials) const {
  constexpr Eigen::Index block = 8;
  if (!transition_ || boundary_values.rows() != static_cast<Eigen::Index>(absorbing_faces_.size()))
    throw std::invalid_argument("Star_mesh_elimination: boundary values for " + std::to_string(boundary_values.rows()) +
                                " faces, factorised for " + std::to_string(absorbing_faces_.size()));
  potentials.resize(static_cast<Eigen::Index>(plan_.face.size()), boundary_values.cols());
  const auto blocks = static_cast<std::size_t>((boundary_values.cols() + block - 1) / block);
  parallel_tasks<Concurrency_tag>(blocks, [&](std::size_t task) {
    const Eigen::Index first = static_cast<Eigen::Index>(task) * block;
    const Eigen::Index width = std::min(block, boundary_values.cols() - first);
    if (width == 1)
      solve_columns<1>(boundary_values, first, width, potentials);
    else
      solve_columns<block>(boundary_values, first, width, potentials);
  });
}

template <std::size_t labels>
void Star_mesh_factor::solve_columns(const Potentials& boundary_values, Eigen::Index first, Eigen::Index width,
                                     Potentials& potentials) const {
  std::vector<double> boundary(absorbing_faces_.size() * labels, 0.);
  for (Eigen::Index r = 0; r < boundary_values.rows(); ++r)
    for (Eigen::Index l = 0; l < width; ++l)
      boundary[static_cast<std::size_t>(r) * labels + static_cast<std::size_t>(l)] = boundary_values(r, first + l);
  std::vector<double> x(plan_.face.size() * labels, 0.);
  forward<labels>(carries_current_, boundary, x);
  backward<labels>({}, boundary, x);
  const auto write = [&](auto number) {  // known when compiled where it can be: a call for each face costs more
    parallel_stretches(plan_.face.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t face = begin; face < end; ++face)
        std::copy_n(&x[plan_.position[face] * labels], number, &potentials(static_cast<Eigen::Index>(face), first));
    });
  };
  if (width == labels)
    write(std::integral_constant<Eigen::Index, labels>());
  else
    write(width);
}

inline void Star_mesh_factor::response(Index face, const std::vector<double>& boundary_values,
                                       std::vector<double>& column) const {
  std::vector<double> x(plan_.face.size(), 0.);
  x[position_of_source(face)] = 1;
  std::vector<Index> sources = absorbing_faces_;
  if (std::all_of(boundary_values.begin(), boundary_values.end(), [](double value) { return value == 0; }))
    sources.clear();
  sources.push_back(face);
  if (!forward<1>(ways_to_roots(sources), boundary_values, x)) refuse_source(face);
  backward<1>({}, boundary_values, x);
  column.resize(x.size());
  for (std::size_t f = 0; f < x.size(); ++f) column[f] = x[plan_.position[f]];
}

inline std::vector<double> Star_mesh_factor::absorbed_currents(Index face) const {
  std::vector<double> x(plan_.face.size(), 0.);
  x[position_of_source(face)] = 1;
  const std::vector<double> zero(absorbing_faces_.size(), 0.);
  if (!forward<1>(ways_to_roots({face}), zero, x)) refuse_source(face);
  std::vector<double> currents;  // what arrives from faces eliminated before, then from those after
  for (const Index absorbing : absorbing_faces_) currents.push_back(x[plan_.position[absorbing]]);
  std::vector<Index> ends = absorbing_faces_;
  ends.push_back(face);
  backward<1>(ways_to_roots(ends), zero, x);
  for (std::size_t r = 0; r < absorbing_faces_.size(); ++r) {
    const std::size_t k = plan_.position[absorbing_faces_[r]];
    const Supernode& supernode = plan_.supernodes[plan_.supernode_of[k]];
    const std::size_t size = supernode.front_size(), local = k - supernode.begin;
    const double* c = transition_.get() + supernode.factor_begin + local * (size - 1) - local * (local - 1) / 2;
    for (std::size_t i = k + 1; i < supernode.end; ++i) currents[r] += *c++ * x[i];
    for (std::size_t i = 0; i < supernode.row_count; ++i) currents[r] += *c++ * x[plan_.rows[supernode.rows_begin + i]];
  }
  return currents;
}

inline std::vector<std::vector<double>> Star_mesh_factor::columns() const {
  if (!transition_) throw std::invalid_argument("Star_mesh_elimination: columns of what is not factorised");
  return Column_substitution(view()).take();
}

inline Largest_potentials Star_mesh_factor::largest_potentials(const std::vector<Index>& labels,
                                                               std::size_t number_of_labels,
                                                               const Progress& progress) const {
  if (!transition_ || labels.size() != absorbing_faces_.size())
    throw std::invalid_argument("Star_mesh_elimination: labels for " + std::to_string(labels.size()) +
                                " faces, factorised for " + std::to_string(absorbing_faces_.size()));
  const Pruned_substitution solved(view(), labels, number_of_labels, progress);
  const std::size_t n = plan_.face.size();
  Largest_potentials result = {std::vector<Index>(n), std::vector<double>(n)};
  parallel_stretches(n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t face = begin; face < end; ++face) {
      result.labels[face] = solved.labels()[plan_.position[face]];
      result.potentials[face] = solved.potentials()[plan_.position[face]];
    }
  });
  return result;
}

template <std::size_t labels>
bool Star_mesh_factor::forward(const std::vector<char>& marked, const std::vector<double>& boundary,
                               std::vector<double>& x) const {
  bool conserved = true;
  for (std::size_t s = 0; s < plan_.supernodes.size(); ++s) {
    if (!marked[s]) continue;
    const Supernode& supernode = plan_.supernodes[s];
    const std::size_t pivots = supernode.column_count();
    const Index* row = plan_.rows.data() + supernode.rows_begin;
    const double* p = transition_.get() + supernode.factor_begin;
    for (std::size_t k = 0; k < pivots; ++k) {
      double* own = &x[(supernode.begin + k) * labels];
      const Index rank = absorbing_[supernode.begin + k];
      std::array<double, labels> value;
      std::copy_n(rank ? &boundary[(rank - 1) * labels] : own, labels, value.begin());
      const auto pass_on = [&](std::size_t position) {
        const double share = *p++;
        double* to = &x[position * labels];
        for (std::size_t l = 0; l < labels; ++l) to[l] += share * value[l];
      };
      for (std::size_t j = k + 1; j < pivots; ++j) pass_on(supernode.begin + j);
      for (std::size_t i = 0; i < supernode.row_count; ++i) pass_on(row[i]);
      if (rank) continue;  // keeps the current that arrived
      const double d = sum_[supernode.begin + k];
      for (std::size_t l = 0; l < labels; ++l) {
        conserved &= d > 0 || own[l] == 0;
        own[l] = d > 0 ? own[l] / d : 0;
      }
    }
  }
  return conserved;
}

template <std::size_t labels>
void Star_mesh_factor::backward(const std::vector<char>& marked, const std::vector<double>& boundary,
                                std::vector<double>& x) const {
  for (std::size_t r = 0; r < absorbing_faces_.size(); ++r)
    std::copy_n(&boundary[r * labels], labels, &x[plan_.position[absorbing_faces_[r]] * labels]);
  Workspaces<std::vector<double>, Concurrency_tag> fronts(
      [&] { return std::vector<double>(plan_.largest_front * labels); });
  const auto is_marked = [&](Index s) { return marked.empty() || marked[s]; };
  for (auto s = plan_.top.rbegin(); s != plan_.top.rend(); ++s)
    if (is_marked(*s)) substitute_back<labels>(*s, fronts.local(), x);
  parallel_tasks<Concurrency_tag>(plan_.subtrees.size(), [&](std::size_t t) {
    const auto& [first, root] = plan_.subtrees[t];
    if (!is_marked(root)) return;
    auto& front = fronts.local();
    for (Index s = root + 1; s-- > first;)
      if (is_marked(s)) substitute_back<labels>(s, front, x);
  });
}

template <std::size_t labels>
void Star_mesh_factor::substitute_back(Index s, std::vector<double>& front, std::vector<double>& x) const {
  const Supernode& supernode = plan_.supernodes[s];
  const std::size_t pivots = supernode.column_count();
  const Index* row = plan_.rows.data() + supernode.rows_begin;
  double* own = &x[supernode.begin * labels];
  std::memcpy(front.data(), own, pivots * labels * sizeof(double));
  for (std::size_t i = 0; i < supernode.row_count; ++i)
    std::memcpy(&front[(pivots + i) * labels], &x[row[i] * labels], labels * sizeof(double));
  substitute<labels>(transition_.get() + supernode.factor_begin, pivots, supernode.row_count,
                     absorbing_.data() + supernode.begin, front.data(), instructions_);
  std::memcpy(own, front.data(), pivots * labels * sizeof(double));
}

}  // namespace RW_segmentation::internal

#endif
