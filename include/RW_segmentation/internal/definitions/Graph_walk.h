// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_GRAPH_WALK_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_GRAPH_WALK_H

#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/walk/Graph_walk.h>
#include <RW_segmentation/internal/walk/Walk_network.h>
#include <RW_segmentation/internal/walk/seeded_components.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE double Graph_walk::potential(Index face, Label label) {
  solve();
  auto known = known_potentials_.find(label);
  if (known == known_potentials_.end()) known = known_potentials_.emplace(label, potential(label)).first;
  return known->second[face];
}

RW_SEGMENTATION_INLINE Walk_report Graph_walk::report() const {
  Walk_report report = Seeded_walk::report();
  report.columns_added = columns_.number_added();
  return report;
}

RW_SEGMENTATION_INLINE void Graph_walk::solve() {
  if (!is_solved()) known_potentials_.clear();
  Seeded_walk::solve([&](Walk_labels& labels) {
    return edit_columns([&](const auto& prepare) { return compare_columns(labels, prepare); });
  });
}

/// Gives each face the label of the largest sum of its seeds' columns. False where digits were lost.
/// \param prepare brings the columns of a stretch of faces up to date
template <class Prepare>
bool Graph_walk::compare_columns(Walk_labels& labels, const Prepare& prepare) const {
  std::vector<std::vector<const double*>> columns_of(labels.number_of_seed_labels());
  for (const auto& column : columns_.columns())
    columns_of[labels.rank_of(seeds_.label_of(column.face))].push_back(column.potential.data());
  return labels.compare_sums(network(), columns_of, seeded_components(network(), seeds_),
                             10 * Seed_columns::accepted_error, prepare);
}

/// Brings the columns to the seeds. False where that is impossible, inaccurate or not worth it.
/// \param compare see `Seed_columns::update()`
template <class Compare>
bool Graph_walk::edit_columns(const Compare& compare) {
  try {
    if (columns_.update(network(), factor_, seeds_, compare)) return true;
  } catch (...) {  // some columns may know of an edit that others do not
    columns_.clear();
    throw;
  }
  columns_.clear();
  return false;
}

RW_SEGMENTATION_INLINE void Graph_walk::anticipate() {
  const std::vector<Seed_set::Seed>& seeds = seeds_.seeds();
  const auto has_another_label = [&](const Seed_set::Seed& seed) { return seed.label != seeds.front().label; };
  if (graph_->number_of_faces() == 0 || std::any_of(seeds.begin(), seeds.end(), has_another_label)) return;
  const auto only_prepare = [&](const auto& prepare) {
    for_stretches(network(), prepare);
    return true;
  };
  if (seeds.empty() || seeds.size() > Seed_columns::most_columns)
    factor_.analyse(network(), progress_);
  else if (!edit_columns(only_prepare) && !factor_.is_for(seeds_))
    factor_.factorise(network(), seeds_, progress_);
  progress_(1);
}

RW_SEGMENTATION_INLINE std::vector<double> Graph_walk::potential(Label label) {
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

}  // namespace RW_segmentation::internal

#endif
