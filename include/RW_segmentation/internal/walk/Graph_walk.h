// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_GRAPH_WALK_H
#define RW_SEGMENTATION_INTERNAL_WALK_GRAPH_WALK_H

#include <RW_segmentation/internal/walk/Seed_columns.h>
#include <RW_segmentation/internal/walk/Seeded_walk.h>

#include <map>
#include <optional>
#include <vector>

namespace RW_segmentation::internal {

/// A walk whose seeds may be edited, and whose potentials may be asked for.
///
/// Once seeds are edited, a column of potentials for each seed face is kept (8 bytes x faces x seed faces) and brought up
/// to date, and a factorisation made anew when the loss of digits nears the promised accuracy. See `Seed_columns`.
class Graph_walk : private Seeded_walk {
 public:
  using Seeded_walk::Index;
  using Seeded_walk::Label;
  using Seeded_walk::Seeded_walk;

  using Seeded_walk::add_seed;
  using Seeded_walk::solver_is_analysed;
  bool remove_seed(Index face) { return seeds_.remove(face); }
  void clear_seeds() { seeds_.clear(); }

  /// In the order in which they were added.
  const std::vector<Seed_set::Seed>& seeds() const { return seeds_.seeds(); }
  std::optional<Label> label_of_seed(Index face) const { return seeds_.find_label_of(face); }

  /// While there are no two labels, does what the first answer of two needs and is known already: analyses the graph, and
  /// factorises for the seeds that there are.
  void anticipate();

  /// As those of a `Seeded_walk`.
  const std::vector<Label>& labels() {
    solve();
    return Seeded_walk::labels();
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
  void solve();
  template <class Compare>
  bool edit_columns(const Compare& compare);
  template <class Prepare>
  bool compare_columns(Walk_labels& labels, const Prepare& prepare) const;

  Seed_columns columns_;
  std::map<Label, std::vector<double>> known_potentials_;  // those asked for since the last solve
};

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Graph_walk.h>
#endif

#endif
