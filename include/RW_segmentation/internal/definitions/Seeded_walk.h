// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEEDED_WALK_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEEDED_WALK_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/threads.h>
#include <RW_segmentation/internal/walk/Label_islands.h>
#include <RW_segmentation/internal/walk/Seeded_walk.h>
#include <RW_segmentation/internal/walk/seeded_components.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE Seeded_walk::Seeded_walk(const Dual_graph& graph, std::vector<double> conductances,
                                                Any_walk_solver solver, Progress progress)
    : graph_(&graph),
      conductances_(std::move(conductances)),
      factor_(std::move(solver)),
      progress_(std::move(progress)) {
  normalise_conductances();
  all_edges_conduct_ = std::all_of(conductances_.begin(), conductances_.end(), [](double c) { return c > 0; });
  components_ = Components(graph, [&](Index edge) { return conductances_[edge] > 0; });
}

/// Potentials depend on ratios only: the largest conductance becomes about 1, exactly, by a power of two.
RW_SEGMENTATION_INLINE void Seeded_walk::normalise_conductances() {
  double largest = 0;
  for (const double c : conductances_) largest = std::max(largest, c);
  if (!(largest > 0)) return;
  const int exponent = std::ilogb(largest);
  parallel_stretches(conductances_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) conductances_[e] = std::scalbn(conductances_[e], -exponent);
  });
}

RW_SEGMENTATION_INLINE Walk_report Seeded_walk::report() const {
  Walk_report report;
  report.unseeded_components = unseeded_components_;
  report.island_faces = island_faces_;
  report.factorisations = factor_.count();
  return report;
}

RW_SEGMENTATION_INLINE bool Seeded_walk::is_solved() const {
  if (graph_->number_of_faces() == 0) return true;
  if (seeds_.empty()) throw std::invalid_argument("no seeds");
  return seeds_.changed_labels().empty();
}

RW_SEGMENTATION_INLINE void Seeded_walk::label_directly(Walk_labels& labels) {
  // A factor made for the same seeds serves again when only labels have changed.
  if (!factor_.is_for(seeds_)) factor_.factorise(network(), seeds_, progress_);
  std::vector<Index> ranks;
  for (const Index face : factor_.base()) ranks.push_back(labels.rank_of(seeds_.label_of(face)));
  const Progress progress = progress_.part(factor_.when_made, factor_.when_labelled);
  Largest_potentials largest = factor_.solver().largest_potentials(ranks, labels.number_of_seed_labels(), progress);
  if (largest.labels.empty())
    compare_potentials(labels, progress);
  else
    labels.take(std::move(largest));
}

/// Labels components without a seed, and takes the labels.
RW_SEGMENTATION_INLINE void Seeded_walk::settle(Walk_labels&& labels, const Walk_labels& before) {
  unseeded_components_ = labels.label_unseeded_components(network(), seeded_components(network(), seeds_));
  settle_islands(labels, before);
  labels_ = std::move(labels);
  seeds_.forget_changes();
  progress_(1);
}

RW_SEGMENTATION_INLINE void Seeded_walk::compare_potentials(Walk_labels& labels, const Progress& progress) {
  constexpr std::size_t block = 16;  // labels solved together
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

/// Labels that are known to be connected are not searched again. Where an island goes, potentials tell.
RW_SEGMENTATION_INLINE void Seeded_walk::settle_islands(Walk_labels& labels, const Walk_labels& before) {
  std::vector<Label> doubtful = seeds_.changed_labels();
  doubtful.insert(doubtful.end(), labels_of_islands_.begin(), labels_of_islands_.end());
  const Walk_network network = this->network();
  const Label_islands islands(network, labels, seeds_, labels.unchanged_since(before, doubtful));
  if (!islands.has_potentials_beside()) {
    Walk_labels compared = labels;
    compare_potentials(compared, progress_.part(factor_.when_labelled, 1));
    labels.take_potentials(std::move(compared));
  }
  labels_of_islands_ = islands.labels();
  island_faces_ = islands.number_of_faces();
  settled_ = labels.labels_of(islands.settled_ranks());
}

RW_SEGMENTATION_INLINE std::vector<std::size_t> walk_labels(const Dual_graph& graph, std::vector<double> conductances,
                                                            const std::vector<Dual_graph::Index>& seed_faces,
                                                            const std::vector<std::size_t>& seed_labels,
                                                            const Progress& progress, Any_walk_solver solver) {
  Seeded_walk walk(graph, std::move(conductances), std::move(solver), progress);
  for (std::size_t s = 0; s < seed_faces.size(); ++s) walk.add_seed(seed_faces[s], seed_labels[s]);
  return walk.labels();
}

}  // namespace RW_segmentation::internal

#endif
