// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_WALK_FRAGMENTS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_WALK_FRAGMENTS_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/walk/Face_clusters.h>
#include <RW_segmentation/internal/walk/Seeded_walk.h>
#include <RW_segmentation/internal/walk/settle_band.h>
#include <RW_segmentation/internal/walk/walk_fragments.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE Fragments walk_from_seeds(const Walk_network& network, Any_walk_solver analysed,
                                                 const std::vector<Dual_graph::Index>& seeds,
                                                 const std::vector<std::size_t>& labels, const Progress& progress) {
  Seeded_walk walk(network.graph, network.conductances, std::move(analysed), progress);
  walk.solver_is_analysed();
  for (std::size_t s = 0; s < seeds.size(); ++s) walk.add_seed(seeds[s], labels[s]);
  return {walk.labels(), walk.report().island_faces};
}

RW_SEGMENTATION_INLINE Fragments walk_fragments(const Walk_network& network, Any_walk_solver analysed,
                                                const std::vector<Dual_graph::Index>& seeds, const Progress& progress) {
  const Components& component = network.component;
  std::vector<std::size_t> seeds_in(component.count, 0);
  for (const auto seed : seeds) ++seeds_in[component.of[seed]];
  std::vector<Dual_graph::Index> walked;
  for (const auto seed : seeds)
    if (seeds_in[component.of[seed]] > 1) walked.push_back(seed);
  if (walked.empty()) return {{component.of.begin(), component.of.end()}};
  std::vector<std::size_t> numbers(walked.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t(0));
  return walk_from_seeds(network, std::move(analysed), walked, numbers, progress);
}

RW_SEGMENTATION_INLINE Fragments walk_fragments_over_clusters(
    const Walk_network& network, const std::vector<double>& edge_length, const std::vector<Dual_graph::Index>& seeds,
    const Walk_reduction& reduction, const std::function<Any_walk_solver()>& make_solver, const Progress& progress) {
  Face_clusters clusters =
      clusters_around(seeds, network.graph, network.conductances, edge_length, reduction.largest_difference,
                      cluster_steps(network.graph.number_of_faces(), reduction.cluster_steps));
  std::vector<double>().swap(clusters.resistance);
  progress(0.2);
  Components component;
  component.count = network.component.count;
  for (const auto root : clusters.root) component.of.push_back(network.component.of[root]);
  std::vector<Dual_graph::Index> cluster_of_seed(seeds.size());
  std::iota(cluster_of_seed.begin(), cluster_of_seed.end(), Dual_graph::Index(0));
  auto solver = make_solver();
  solver.analyze(clusters.graph);
  const Fragments coarse = walk_fragments({clusters.graph, clusters.conductances, component}, std::move(solver),
                                          cluster_of_seed, progress.part(0.2, 0.7));

  std::vector<char> is_in_band(clusters.root.size(), false);
  for (const auto cluster : band_along_boundaries(clusters.graph, coarse.of_face, reduction.band))
    is_in_band[cluster] = true;
  Fragments fragments = {{}, coarse.island_faces, clusters.root.size()};
  std::vector<char> is_face_in_band;
  fragments.of_face.reserve(clusters.of_face.size());
  is_face_in_band.reserve(clusters.of_face.size());
  for (const auto cluster : clusters.of_face) {
    fragments.of_face.push_back(coarse.of_face[cluster]);
    is_face_in_band.push_back(is_in_band[cluster]);
  }
  settle_band(network.graph, network.conductances, {is_face_in_band, seeds}, fragments.of_face, progress.part(0.7, 1),
              make_solver());
  return fragments;
}

}  // namespace RW_segmentation::internal

#endif
