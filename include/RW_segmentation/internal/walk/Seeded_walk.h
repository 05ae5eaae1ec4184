// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_SEEDED_WALK_H
#define RW_SEGMENTATION_INTERNAL_WALK_SEEDED_WALK_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/walk/Any_walk_solver.h>
#include <RW_segmentation/internal/walk/Seed_set.h>
#include <RW_segmentation/internal/walk/Walk_factor.h>
#include <RW_segmentation/internal/walk/Walk_labels.h>
#include <RW_segmentation/internal/walk/Walk_network.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// What a walk met that is odd but not wrong, and what it did.
struct Walk_report {
  std::size_t unseeded_components = 0;  ///< parts that no seed can reach, each a segment of its own
  std::size_t island_faces = 0;         ///< faces moved because their label's region was cut off from its seeds
  std::size_t factorisations = 0;       ///< since the walk was made
  std::size_t columns_added = 0;        ///< edits answered by one column instead of a factorisation
  std::size_t degenerate_faces = 0;     ///< faces of the mesh without area
};

namespace internal {

/// The walk on a dual graph from seeds to labels: factorise with the seeds absorbing, and ask the solver for the label of
/// the largest potential, or solve for blocks of labels and keep the largest potential of each face only.
///
/// A walk whose seeds are edited is a `Graph_walk`; this one is for those that are not.
class Seeded_walk {
 public:
  using Index = Dual_graph::Index;
  using Label = Seed_set::Label;

  /// Keeps a reference to the graph. Conductances are finite and >= 0.
  Seeded_walk(const Dual_graph& graph, std::vector<double> conductances, Any_walk_solver solver = {},
              Progress progress = {});

  /// Takes the solver for one that has analysed the graph already; before the first solve.
  void solver_is_analysed() { factor_.solver_is_analysed(); }

  /// A face that is a seed already takes the new label.
  void add_seed(Index face, Label label) { seeds_.add(face, label); }

  /// The label of each face; where nothing but other labels' faces joins it to its seeds, that of the best supported
  /// neighbour. Components without a seed get the labels after the largest one.
  /// \throws std::invalid_argument if there is no seed, unless there is no face either
  const std::vector<Label>& labels() {
    solve([](Walk_labels&) { return false; });
    return settled_;
  }

  /// Of the last answer.
  Walk_report report() const;

 protected:
  Walk_network network() const { return {*graph_, conductances_, components_, all_edges_conduct_}; }

  /// Brings the labels to the seeds.
  /// \param label_edited sets labels by what is known of earlier seeds; returns false where that is no use
  /// \throws std::invalid_argument if there is no seed, unless there is no face either
  template <class Label_edited>
  void solve(const Label_edited& label_edited) {
    if (is_solved()) return;
    Walk_labels before = std::exchange(labels_, Walk_labels());  // first: what follows may fail half-way
    Walk_labels labels(network(), seeds_, before);
    // A single label needs no solve; what is known of earlier seeds stays for later ones.
    if (labels.number_of_seed_labels() > 1 && !label_edited(labels)) label_directly(labels);
    settle(std::move(labels), before);
  }

  /// Whether the labels are those of the seeds.
  bool is_solved() const;

  const Dual_graph* graph_;
  std::vector<double> conductances_;
  bool all_edges_conduct_;
  Components components_;
  Seed_set seeds_;
  Walk_factor factor_;
  Walk_labels labels_;  // as of the last solve; empty if it did not come to its end
  Progress progress_;

 private:
  void normalise_conductances();
  void label_directly(Walk_labels& labels);
  void compare_potentials(Walk_labels& labels, const Progress& progress);
  void settle(Walk_labels&& labels, const Walk_labels& before);
  void settle_islands(Walk_labels& labels, const Walk_labels& before);

  std::vector<Label> settled_;            // by face: the label in the end
  std::vector<Label> labels_of_islands_;  // as of the last solve
  std::size_t unseeded_components_ = 0, island_faces_ = 0;
};

/// The labels of a walk with the given seeds. Seed faces are all different.
std::vector<std::size_t> walk_labels(const Dual_graph& graph, std::vector<double> conductances,
                                     const std::vector<Dual_graph::Index>& seed_faces,
                                     const std::vector<std::size_t>& seed_labels, const Progress& progress = {},
                                     Any_walk_solver solver = {});

}  // namespace internal
}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Seeded_walk.h>
#endif

#endif
