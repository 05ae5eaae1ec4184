// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_GRAPH_WALK_H
#define RW_SEGMENTATION_INTERNAL_WALK_GRAPH_WALK_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/parallel_for.h>
#include <RW_segmentation/internal/walk/Label_islands.h>
#include <RW_segmentation/internal/walk/Seed_columns.h>
#include <RW_segmentation/internal/walk/Seed_set.h>
#include <RW_segmentation/internal/walk/Walk_factor.h>
#include <RW_segmentation/internal/walk/Walk_labels.h>
#include <RW_segmentation/internal/walk/Walk_network.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
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

/// The walk on a dual graph: seeds in, labels and potentials out, edited seeds answered by single columns.
///
/// Two ways lead to the labels. *Directly*: factorise with the seeds absorbing, solve for blocks of labels, keep the
/// largest potential of each face only. *By columns*, once seeds are edited: a column of potentials for each seed face
/// is kept (8 bytes x faces x seed faces) and brought up to date, and a factorisation made anew when the loss of digits
/// nears the promised accuracy. See `Seed_columns`.
template <class Solver = Star_mesh_elimination>
class Graph_walk {
 public:
  using Index = Dual_graph::Index;
  using Label = Seed_set::Label;

  /// Keeps a reference to the graph. Conductances are finite and >= 0.
  Graph_walk(const Dual_graph& graph, std::vector<double> conductances, Solver solver = Solver(),
             Progress progress = {})
      : graph_(&graph),
        conductances_(std::move(conductances)),
        factor_(std::move(solver)),
        progress_(std::move(progress)) {
    normalise_conductances();
    components_ = Components(graph, [&](Index edge) { return conductances_[edge] > 0; });
  }

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
  double potential(Index face, Label label) {
    solve();
    auto known = known_potentials_.find(label);
    if (known == known_potentials_.end()) known = known_potentials_.emplace(label, potential(label)).first;
    return known->second[face];
  }

  Walk_report report() const {
    Walk_report report;
    report.unseeded_components = unseeded_components_;
    report.island_faces = island_faces_;
    report.factorisations = factor_.count();
    report.columns_added = columns_.number_added();
    return report;
  }

 private:
  Walk_network network() const { return {*graph_, conductances_, components_}; }

  /// Potentials depend on ratios only: the largest conductance becomes about 1, exactly, by a power of two.
  void normalise_conductances() {
    double largest = 0;
    for (const double c : conductances_) largest = std::max(largest, c);
    if (!(largest > 0)) return;
    const int exponent = std::ilogb(largest);
    parallel_stretches(conductances_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e) conductances_[e] = std::scalbn(conductances_[e], -exponent);
    });
  }

  void solve();
  bool label_by_columns(Walk_labels& labels);
  void label_directly(Walk_labels& labels);
  void settle_islands(const Walk_labels& labels, const Walk_labels& before);

  const Dual_graph* graph_;
  std::vector<double> conductances_;
  Components components_;
  Seed_set seeds_;
  Walk_factor<Solver> factor_;
  Seed_columns columns_;
  Walk_labels labels_;                                     // as of the last solve; empty if it did not come to its end
  std::vector<Label> settled_;                             // by face: the label in the end
  std::vector<Label> labels_of_islands_;                   // as of the last solve
  std::map<Label, std::vector<double>> known_potentials_;  // those asked for since the last solve
  std::size_t unseeded_components_ = 0, island_faces_ = 0;
  Progress progress_;
};

// -------------------------------------------------------------------------------------------------------------------

template <class Solver>
void Graph_walk<Solver>::solve() {
  if (graph_->number_of_faces() == 0) return;
  if (seeds_.empty()) throw std::invalid_argument("no seeds");
  if (seeds_.changed_labels().empty()) return;
  known_potentials_.clear();
  Walk_labels before = std::exchange(labels_, Walk_labels());  // first: what follows may fail half-way
  Walk_labels labels(network(), seeds_, before);
  // A single label needs no solve; what is known of earlier seeds stays for later ones.
  if (labels.number_of_seed_labels() > 1 && !label_by_columns(labels)) label_directly(labels);
  unseeded_components_ = labels.label_unseeded_components(network(), seeded_components(network(), seeds_));
  settle_islands(labels, before);
  labels_ = std::move(labels);
  seeds_.forget_changes();
  progress_(1);
}

/// Answers edits. False where that is impossible, inaccurate or not worth it.
template <class Solver>
bool Graph_walk<Solver>::label_by_columns(Walk_labels& labels) {
  try {
    if (columns_.update(network(), factor_, seeds_) && labels.compare(network(), columns_.columns(), seeds_))
      return true;
  } catch (...) {  // some columns may know of an edit that others do not
    columns_.clear();
    throw;
  }
  columns_.clear();
  return false;
}

template <class Solver>
void Graph_walk<Solver>::label_directly(Walk_labels& labels) {
  constexpr std::size_t block = 16;  // labels solved together
  // A factor made for the same seeds serves again when only labels have changed.
  if (!factor_.is_for(seeds_)) factor_.factorise(network(), seeds_, progress_);
  const Progress progress = progress_.part(factor_.when_made, 1);
  const std::vector<Index>& base = factor_.base();
  Potentials boundary, potentials;
  labels.begin();
  const std::size_t count = labels.number_of_seed_labels();
  for (std::size_t first = 0; first < count; first += block) {
    const std::size_t width = std::min(block, count - first);
    boundary.setZero(static_cast<Eigen::Index>(base.size()), static_cast<Eigen::Index>(width));
    for (std::size_t r = 0; r < base.size(); ++r)
      if (const std::size_t rank = labels.rank_of(seeds_.label_of(base[r])); rank >= first && rank < first + width)
        boundary(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(rank - first)) = 1;
    factor_.solver().potentials(boundary, potentials);
    labels.compare(network(), potentials, first);
    progress(static_cast<double>(first + width) / static_cast<double>(count));
  }
}

/// Labels that are known to be connected are not searched again.
template <class Solver>
void Graph_walk<Solver>::settle_islands(const Walk_labels& labels, const Walk_labels& before) {
  std::vector<Label> doubtful = seeds_.changed_labels();
  doubtful.insert(doubtful.end(), labels_of_islands_.begin(), labels_of_islands_.end());
  const Walk_network network = this->network();
  const Label_islands islands(network, labels, seeds_, labels.unchanged_since(before, doubtful));
  labels_of_islands_ = islands.labels();
  island_faces_ = islands.number_of_faces();
  settled_ = labels.labels_of(islands.settled_ranks());
}

template <class Solver>
std::vector<double> Graph_walk<Solver>::potential(Label label) {
  solve();
  std::vector<double> sum(graph_->number_of_faces(), 0.);
  if (labels_.number_of_seed_labels() <= 1) {
    const std::vector<char> seeded = seeded_components(network(), seeds_);
    for (std::size_t f = 0; f < sum.size(); ++f) sum[f] = label == labels_.label(0) && seeded[components_.of[f]];
    return sum;
  }
  if (!columns_.empty()) {
    for (const auto& column : columns_.columns())
      if (seeds_.label_of(column.face) == label)
        for (std::size_t f = 0; f < sum.size(); ++f) sum[f] += column.potential[f];
  } else {
    const std::vector<Index>& base = factor_.base();
    Potentials boundary(static_cast<Eigen::Index>(base.size()), 1), result;
    for (std::size_t r = 0; r < base.size(); ++r)
      boundary(static_cast<Eigen::Index>(r), 0) = seeds_.label_of(base[r]) == label;
    factor_.solver().potentials(boundary, result);
    std::copy_n(result.data(), sum.size(), sum.begin());
  }
  for (double& p : sum) p = std::min(p, 1.);
  return sum;
}

/// The labels of a walk with the given seeds, for use once. Seed faces are all different.
template <class Solver = Star_mesh_elimination>
std::vector<std::size_t> walk_labels(const Dual_graph& graph, std::vector<double> conductances,
                                     const std::vector<Dual_graph::Index>& seed_faces,
                                     const std::vector<std::size_t>& seed_labels, const Progress& progress = {},
                                     Solver solver = Solver()) {
  Graph_walk<Solver> walk(graph, std::move(conductances), std::move(solver), progress);
  for (std::size_t s = 0; s < seed_faces.size(); ++s) walk.add_seed(seed_faces[s], seed_labels[s]);
  return walk.labels();
}

}  // namespace internal
}  // namespace RW_segmentation

#endif
