// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SOLVER_ELIMINATION_PLAN_H
#define RW_SEGMENTATION_INTERNAL_SOLVER_ELIMINATION_PLAN_H

#include <RW_segmentation/Dual_graph.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// In which order and in which groups the faces of a dual graph are eliminated, and which others each group meets.
///
/// Depends on the graph alone. Faces are renumbered by their place in the order, their *position*. A supernode is a
/// range of positions eliminated together; its *rows* are the later positions it is connected to by then, in
/// ascending order. Every supernode stands behind all of its children (postorder), the last child right before it, so
/// that what children leave for their parent can be kept on a stack, and every subtree is a range of supernodes.
class Elimination_plan {
 public:
  using Index = Dual_graph::Index;
  static constexpr Index none = std::numeric_limits<Index>::max();

  /// An edge seen from its earlier end.
  struct Later {
    Index position, edge;
  };

  struct Supernode {
    Index begin, end;        ///< positions
    Index parent;            ///< supernode, `none` for a root
    Index children;          ///< how many
    std::size_t rows_begin;  ///< into `rows`
    Index row_count;
    std::size_t factor_begin;  ///< into the packed columns of the factor

    Index column_count() const { return end - begin; }
    std::size_t front_size() const { return std::size_t(column_count()) + row_count; }
    /// Entries below the diagonal in the columns of the supernode.
    std::size_t factor_size() const {
      const std::size_t columns = column_count();
      return columns * (columns - 1) / 2 + columns * row_count;
    }
    /// Numbers left for the parent: entries on and below the diagonal of the rows, and one more for each row.
    std::size_t left_size() const { return std::size_t(row_count) * (row_count + std::size_t(3)) / 2; }
    /// Multiplications and additions, about.
    double work() const {
      const double columns = column_count(), front = static_cast<double>(front_size());
      return columns * front * front;
    }
  };

  /// A range of supernodes: all those below and with the last one.
  struct Subtree {
    Index first, root;
  };

  std::vector<Index> position;  ///< of each face
  std::vector<Index> face;      ///< at each position
  std::vector<std::size_t> later_begin;
  std::vector<Later> later;  ///< edges of position k to later ones: later[later_begin[k] .. later_begin[k + 1])
  std::vector<Supernode> supernodes;
  std::vector<Index> supernode_of;  ///< each position
  std::vector<Index> rows;
  std::size_t factor_size = 0;
  std::size_t largest_front = 0, largest_panel = 0, largest_row_count = 0;
  /// Subtrees that can be eliminated at the same time, each of them much less than all the work, in ascending order.
  std::vector<Subtree> subtrees;
  std::vector<Index> top;      ///< the supernodes above all subtrees, in ascending order
  std::size_t stack_size = 0;  ///< the largest of what waits for parents within a subtree

  Elimination_plan() = default;

  /// \throws std::length_error if the ordering cannot number so many faces and edges
  static void check_size(std::size_t faces, std::size_t edges);

  /// Complexity: that of the minimum degree ordering, nearly linear in practice.
  explicit Elimination_plan(const Dual_graph& graph) {
    number_faces(graph, minimum_degree_order(graph));
    const std::vector<Index> parent = number_in_postorder(graph, elimination_tree());
    group_columns(parent, row_counts(parent));
    collect_rows();
    measure();
    cut_off_subtrees();
    for (const Subtree& subtree : subtrees) stack_size = std::max(stack_size, stack_height(subtree));
  }

 private:
  /// The faces in the order of elimination: approximate minimum degree.
  static std::vector<Index> minimum_degree_order(const Dual_graph& graph);

  /// Sets positions from an order of the faces, and the later neighbours of each.
  void number_faces(const Dual_graph& graph, std::vector<Index> order) {
    face = std::move(order);
    position.resize(face.size());
    for (std::size_t k = 0; k < face.size(); ++k) position[face[k]] = static_cast<Index>(k);
    later_begin.assign(face.size() + 1, 0);
    later.clear();
    later.reserve(graph.number_of_edges());
    for (std::size_t k = 0; k < face.size(); ++k) {
      for (const auto& neighbour : graph.neighbours(face[k]))
        if (position[neighbour.face] > k) later.push_back({position[neighbour.face], neighbour.edge});
      later_begin[k + 1] = later.size();
    }
  }

  /// The parent of each position: the first later one it is connected to once the earlier ones are eliminated.
  std::vector<Index> elimination_tree() const;

  /// Renumbers the faces so that every subtree of the elimination tree is contiguous, and returns the tree renumbered.
  std::vector<Index> number_in_postorder(const Dual_graph& graph, const std::vector<Index>& parent);

  /// How many later positions each is connected to when its turn comes (Gilbert, Ng, Peyton 1994).
  std::vector<Index> row_counts(const std::vector<Index>& parent) const;

  void group_columns(const std::vector<Index>& parent, const std::vector<Index>& count);
  void collect_rows();
  void measure();
  void cut_off_subtrees();

  /// The largest of what waits for parents at any one time, and what the root leaves at last.
  std::size_t stack_height(const Subtree& subtree) const {
    std::size_t height = 0, largest = 0;
    std::vector<std::size_t> waiting;
    for (Index s = subtree.first; s <= subtree.root; ++s) {
      for (Index child = 0; child < supernodes[s].children; ++child, waiting.pop_back()) height -= waiting.back();
      waiting.push_back(supernodes[s].left_size());
      height += waiting.back();
      largest = std::max(largest, height);
    }
    return largest;
  }
};

inline void Elimination_plan::check_size(std::size_t faces, std::size_t edges) {
  if (faces + 2 * edges > std::size_t(std::numeric_limits<int>::max()) / 2)
    throw std::length_error("Star_mesh_elimination: " + std::to_string(faces) +
                            " faces are too many for the minimum degree ordering");
}

inline std::vector<Dual_graph::Index> Elimination_plan::minimum_degree_order(const Dual_graph& graph) {
  using Pattern = Eigen::SparseMatrix<signed char, Eigen::ColMajor, int>;
  const std::size_t n = graph.number_of_faces();
  check_size(n, graph.number_of_edges());
  // The lower triangle. The ordering takes a matrix without a stored diagonal for a dense one.
  Pattern pattern(static_cast<int>(n), static_cast<int>(n));
  pattern.resizeNonZeros(static_cast<int>(n + graph.number_of_edges()));
  int* inner = pattern.innerIndexPtr();
  std::fill_n(pattern.valuePtr(), pattern.nonZeros(), static_cast<signed char>(1));
  std::size_t entries = 0;
  for (std::size_t f = 0; f < n; ++f) {
    pattern.outerIndexPtr()[f] = static_cast<int>(entries);
    inner[entries++] = static_cast<int>(f);
    const std::size_t row = entries;
    for (const auto& neighbour : graph.neighbours(static_cast<Index>(f))) {
      const int g = static_cast<int>(neighbour.face);
      if (neighbour.face > f && std::find(inner + row, inner + entries, g) == inner + entries) inner[entries++] = g;
    }
  }
  pattern.outerIndexPtr()[n] = static_cast<int>(entries);
  pattern.resizeNonZeros(static_cast<int>(entries));

  Eigen::AMDOrdering<int>::PermutationType permutation;
  Eigen::AMDOrdering<int>()(pattern.selfadjointView<Eigen::Lower>(), permutation);
  std::vector<Index> order(n);
  for (std::size_t k = 0; k < n; ++k) order[k] = static_cast<Index>(permutation.indices()[static_cast<int>(k)]);
  return order;
}

inline std::vector<Dual_graph::Index> Elimination_plan::elimination_tree() const {
  // Every position finds the roots of its earlier neighbours' subtrees and becomes their parent (Liu 1990).
  const std::size_t n = face.size();
  std::vector<std::size_t> earlier_begin(n + 2, 0);
  for (const Later& edge : later) ++earlier_begin[edge.position + std::size_t(2)];
  std::partial_sum(earlier_begin.begin(), earlier_begin.end(), earlier_begin.begin());
  std::vector<Index> earlier(later.size());
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t q = later_begin[k]; q < later_begin[k + 1]; ++q)
      earlier[earlier_begin[later[q].position + std::size_t(1)]++] = static_cast<Index>(k);

  std::vector<Index> parent(n, none), ancestor(n, none);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t q = earlier_begin[i]; q < earlier_begin[i + 1]; ++q)
      for (Index k = earlier[q]; k != none && k < i;) {
        const Index above = std::exchange(ancestor[k], static_cast<Index>(i));
        if (above == none) parent[k] = static_cast<Index>(i);
        k = above;
      }
  return parent;
}

inline std::vector<Dual_graph::Index> Elimination_plan::number_in_postorder(const Dual_graph& graph,
                                                                            const std::vector<Index>& parent) {
  const std::size_t n = parent.size();
  std::vector<Index> first_child(n, none), sibling(n, none), order, path, number(n), renumbered(n, none);
  for (std::size_t k = n; k-- > 0;)
    if (parent[k] != none) sibling[k] = std::exchange(first_child[parent[k]], static_cast<Index>(k));
  order.reserve(n);
  for (std::size_t root = 0; root < n; ++root) {
    if (parent[root] != none) continue;
    path.push_back(static_cast<Index>(root));
    while (!path.empty()) {
      const Index last = path.back();
      if (const Index child = first_child[last]; child != none) {
        first_child[last] = sibling[child];
        path.push_back(child);
      } else {
        number[last] = static_cast<Index>(order.size());
        order.push_back(face[last]);
        path.pop_back();
      }
    }
  }
  for (std::size_t k = 0; k < n; ++k)
    if (parent[k] != none) renumbered[number[k]] = number[parent[k]];
  number_faces(graph, std::move(order));
  return renumbered;
}

inline std::vector<Dual_graph::Index> Elimination_plan::row_counts(const std::vector<Index>& parent) const {
  const std::size_t n = parent.size();
  std::vector<Index> first(n, none), largest_first(n, none), previous_leaf(n, none), ancestor(n);
  std::vector<std::int64_t> count(n);
  std::iota(ancestor.begin(), ancestor.end(), Index(0));
  for (std::size_t k = 0; k < n; ++k) {
    count[k] = first[k] == none;
    for (auto j = static_cast<Index>(k); j != none && first[j] == none; j = parent[j]) first[j] = static_cast<Index>(k);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const auto j = static_cast<Index>(k);
    if (parent[j] != none) --count[parent[j]];
    for (std::size_t q = later_begin[k]; q < later_begin[k + 1]; ++q) {
      const Index i = later[q].position;
      if (largest_first[i] != none && first[j] <= largest_first[i]) continue;  // j is no leaf of the subtree of row i
      largest_first[i] = first[j];
      ++count[j];
      if (const Index before = std::exchange(previous_leaf[i], j); before != none) {
        Index root = before;
        while (root != ancestor[root]) root = ancestor[root];
        for (Index s = before; s != root;) s = std::exchange(ancestor[s], root);
        --count[root];
      }
    }
    if (parent[j] != none) ancestor[j] = parent[j];
  }
  std::vector<Index> result(n);
  for (std::size_t k = 0; k < n; ++k) {
    if (parent[k] != none) count[parent[k]] += count[k];
    result[k] = static_cast<Index>(count[k] - 1);
  }
  return result;
}

/// Supernodes: first columns of equal structure, then a last child is taken into its parent where few explicit zeros
/// come of it (relaxed supernodes).
inline void Elimination_plan::group_columns(const std::vector<Index>& parent, const std::vector<Index>& count) {
  const std::size_t n = face.size();
  std::vector<double> zeros;  // explicit ones in each supernode
  const auto merge_last_two = [&] {
    const Supernode &child = supernodes[supernodes.size() - 2], &last = supernodes.back();
    const Index above = parent[child.end - 1];
    if (above == none || above < last.begin || above >= last.end) return false;
    const double below = child.column_count(), own = last.column_count(), columns = below + own;
    const double new_zeros = zeros[zeros.size() - 2] + zeros.back() + below * (own + last.row_count - child.row_count);
    const double share = new_zeros / (columns * (columns + 1) / 2 + columns * last.row_count);
    const bool worth = new_zeros == 0 || columns <= 4 || (columns <= 16 && share < 0.5) ||
                       (columns <= 48 && share < 0.15) || share < 0.05;
    if (!worth) return false;
    supernodes[supernodes.size() - 2] = {child.begin, last.end, none, 0, 0, last.row_count, 0};
    supernodes.pop_back();
    zeros.pop_back();
    zeros.back() = new_zeros;
    return true;
  };
  for (std::size_t k = 0; k < n;) {
    std::size_t end = k + 1;
    while (end < n && parent[end - 1] == end && count[end - 1] == count[end] + 1) ++end;
    supernodes.push_back({static_cast<Index>(k), static_cast<Index>(end), none, 0, 0, count[end - 1], 0});
    zeros.push_back(0);
    while (supernodes.size() > 1 && merge_last_two()) {
    }
    k = end;
  }
  supernode_of.resize(n);
  for (std::size_t s = 0; s < supernodes.size(); ++s)
    std::fill(supernode_of.begin() + supernodes[s].begin, supernode_of.begin() + supernodes[s].end,
              static_cast<Index>(s));
  for (Supernode& supernode : supernodes) {
    const Index above = parent[supernode.end - 1];
    if (above == none) continue;
    supernode.parent = supernode_of[above];
    ++supernodes[supernode.parent].children;
  }
}

inline void Elimination_plan::collect_rows() {
  std::vector<Index> seen(face.size(), none), waiting;  // waiting: supernodes not yet met by their parents
  for (std::size_t s = 0; s < supernodes.size(); ++s) {
    Supernode& supernode = supernodes[s];
    supernode.rows_begin = rows.size();
    const auto add = [&](Index row) {
      if (row >= supernode.end && std::exchange(seen[row], static_cast<Index>(s)) != s) rows.push_back(row);
    };
    for (std::size_t q = later_begin[supernode.begin]; q < later_begin[supernode.end]; ++q) add(later[q].position);
    for (Index child = 0; child < supernode.children; ++child, waiting.pop_back()) {
      const Supernode& below = supernodes[waiting.back()];
      for (std::size_t q = 0; q < below.row_count; ++q) add(rows[below.rows_begin + q]);
    }
    std::sort(rows.begin() + static_cast<std::ptrdiff_t>(supernode.rows_begin), rows.end());
    supernode.row_count = static_cast<Index>(rows.size() - supernode.rows_begin);
    if (supernode.parent != none) waiting.push_back(static_cast<Index>(s));
  }
}

inline void Elimination_plan::measure() {
  for (Supernode& supernode : supernodes) {
    supernode.factor_begin = factor_size;
    factor_size += supernode.factor_size();
    largest_front = std::max(largest_front, supernode.front_size());
    largest_panel = std::max(largest_panel, supernode.front_size() * supernode.column_count());
    largest_row_count = std::max<std::size_t>(largest_row_count, supernode.row_count);
  }
}

/// The cut depends on the graph alone, and with it the order of all sums: the number of threads changes no result.
inline void Elimination_plan::cut_off_subtrees() {
  constexpr double share_of_all = 1. / 32, smallest = 1e7;
  std::vector<double> work(supernodes.size(), 0.);  // of the subtree
  std::vector<Index> first(supernodes.size());
  double all = 0;
  for (std::size_t s = 0; s < supernodes.size(); ++s) first[s] = static_cast<Index>(s);
  for (std::size_t s = 0; s < supernodes.size(); ++s) {
    work[s] += supernodes[s].work();
    all += supernodes[s].work();
    if (const Index parent = supernodes[s].parent; parent != none) {
      work[parent] += work[s];
      first[parent] = std::min(first[parent], first[s]);
    }
  }
  const double largest = std::max(all * share_of_all, smallest);
  for (std::size_t s = 0; s < supernodes.size(); ++s) {
    const Index parent = supernodes[s].parent;
    if (work[s] > largest)
      top.push_back(static_cast<Index>(s));
    else if (parent == none || work[parent] > largest)
      subtrees.push_back({first[s], static_cast<Index>(s)});
  }
}

}  // namespace RW_segmentation::internal

#endif
