// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_GRAPH_WALK_H
#define RW_SEGMENTATION_INTERNAL_WALK_GRAPH_WALK_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/walk/Any_walk_solver.h>
#include <RW_segmentation/internal/walk/Seed_columns.h>
#include <RW_segmentation/internal/walk/Seed_set.h>
#include <RW_segmentation/internal/walk/Walk_factor.h>
#include <RW_segmentation/internal/walk/Walk_labels.h>
#include <RW_segmentation/internal/walk/Walk_network.h>

#include <cstddef>
#include <map>
#include <optional>
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

/// The walk on a dual graph: seeds in, labels and potentials out, edited seeds answered by single columns.
///
/// Two ways lead to the labels. *Directly*: factorise with the seeds absorbing and ask the solver for the label of the
/// largest potential, or solve for blocks of labels and keep the largest potential of each face only. *By columns*, once seeds are edited: a column of potentials for each seed face
/// is kept (8 bytes x faces x seed faces) and brought up to date, and a factorisation made anew when the loss of digits
/// nears the promised accuracy. See `Seed_columns`.
class Graph_walk {
 public:
  using Index = Dual_graph::Index;
  using Label = Seed_set::Label;

  /// Keeps a reference to the graph. Conductances are finite and >= 0.
  Graph_walk(const Dual_graph& graph, std::vector<double> conductances, Any_walk_solver solver = {},
             Progress progress = {});

  /// Takes the solver for one that has analysed the graph already; before the first solve.
  void solver_is_analysed() { factor_.solver_is_analysed(); }

  /// A face that is a seed already takes the new label.
  void add_seed(Index face, Label label) { seeds_.add(face, label); }
  bool remove_seed(Index face) { return seeds_.remove(face); }
  void clear_seeds() { seeds_.clear(); }

  /// In the order in which they were added.
  const std::vector<Seed_set::Seed>& seeds() const { return seeds_.seeds(); }
  std::optional<Label> label_of_seed(Index face) const { return seeds_.find_label_of(face); }

  /// The label of each face; where nothing but other labels' faces joins it to its seeds, that of the best supported
  /// neighbour. Components without a seed get the labels after the largest one.
  /// \throws std::invalid_argument if there is no seed, unless there is no face either
  const std::vector<Label>& labels() {
    solve();
    return settled_;
  }

  /// The label of the largest potential of each face, islands left where they are.
  std::vector<Label> raw_labels() {
    solve();
    return labels_.labels_of(labels_.ranks());
  }

  /// The potential of a label at all faces: 0 where no seed reaches.
  std::vector<double> potential(Label label);

  /// The potential of a label at one face. The first call after an edit solves for all faces.
  double potential(Index face, Label label);

  Walk_report report() const;

 private:
  Walk_network network() const { return {*graph_, conductances_, components_}; }

  void normalise_conductances();
  void solve();
  bool label_by_columns(Walk_labels& labels);
  void label_directly(Walk_labels& labels);
  void compare_potentials(Walk_labels& labels, const Progress& progress);
  void settle_islands(Walk_labels& labels, const Walk_labels& before);

  const Dual_graph* graph_;
  std::vector<double> conductances_;
  Components components_;
  Seed_set seeds_;
  Walk_factor factor_;
  Seed_columns columns_;
  Walk_labels labels_;                                     // as of the last solve; empty if it did not come to its end
  std::vector<Label> settled_;                             // by face: the label in the end
  std::vector<Label> labels_of_islands_;                   // as of the last solve
  std::map<Label, std::vector<double>> known_potentials_;  // those asked for since the last solve
  std::size_t unseeded_components_ = 0, island_faces_ = 0;
  Progress progress_;
};

/// The labels of a walk with the given seeds, for use once. Seed faces are all different.
std::vector<std::size_t> walk_labels(const Dual_graph& graph, std::vector<double> conductances,
                                     const std::vector<Dual_graph::Index>& seed_faces,
                                     const std::vector<std::size_t>& seed_labels, const Progress& progress = {},
                                     Any_walk_solver solver = {});

}  // namespace internal
}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Graph_walk.h>
#endif

#endif
