// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_WALK_FRAGMENTS_H
#define RW_SEGMENTATION_INTERNAL_WALK_WALK_FRAGMENTS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Walk_reduction.h>
#include <RW_segmentation/internal/walk/Face_clusters.h>
#include <RW_segmentation/internal/walk/Graph_walk.h>
#include <RW_segmentation/internal/walk/Walk_network.h>
#include <RW_segmentation/internal/walk/settle_band.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The regions that walks from seeds make, before they are merged.
struct Fragments {
  std::vector<std::size_t> of_face;  ///< numbered from 0: those of the seeds that walks begin at, then whole components
  std::size_t island_faces = 0;      ///< moved, see `Walk_report`
  std::size_t clusters = 0;          ///< that the walk ran over; 0 if it ran over faces
};

/// The fragments that walks from seeds make. A component with a single seed, or none, is one without a walk.
/// \param analysed a solver that has analysed the graph
/// \param seeds all different
template <class Solver>
Fragments walk_fragments(const Walk_network& network, Solver analysed, const std::vector<Dual_graph::Index>& seeds,
                         const Progress& progress) {
  const Components& component = network.component;
  std::vector<std::size_t> seeds_in(component.count, 0);
  for (const auto seed : seeds) ++seeds_in[component.of[seed]];
  std::vector<Dual_graph::Index> walked;
  for (const auto seed : seeds)
    if (seeds_in[component.of[seed]] > 1) walked.push_back(seed);
  if (walked.empty()) return {{component.of.begin(), component.of.end()}};

  Graph_walk<Solver> walk(network.graph, network.conductances, std::move(analysed), progress);
  walk.solver_is_analysed();
  for (std::size_t s = 0; s < walked.size(); ++s) walk.add_seed(walked[s], s);
  return {walk.labels(), walk.report().island_faces};
}

/// The least distance between the roots of clusters. Clusters of larger meshes hold more faces, lest their number grow.
inline std::size_t cluster_steps(std::size_t faces, const Walk_reduction& reduction) {
  constexpr double large = 2.5e6;
  const double growth = std::sqrt(std::max(1., static_cast<double>(faces) / large));
  return static_cast<std::size_t>(std::llround(growth * static_cast<double>(reduction.cluster_steps)));
}

/// Clusters for a walk from seeds. They are fine where a walk begins, since a wide seed would be met too often: the faces
/// around a seed are clusters by themselves, those of the seeds the first ones.
inline Face_clusters clusters_around(const std::vector<Dual_graph::Index>& seeds, const Walk_network& network,
                                     const std::vector<double>& edge_length, const Walk_reduction& reduction) {
  const double least = std::exp(-reduction.largest_difference);
  std::vector<char> is_crossed;
  is_crossed.reserve(network.conductances.size());
  for (std::size_t e = 0; e < network.conductances.size(); ++e) {
    const double conductance = network.conductances[e];
    is_crossed.push_back(conductance > 0 && conductance >= least * edge_length[e]);
  }
  std::vector<Dual_graph::Index> alone = seeds;
  const std::size_t steps = cluster_steps(network.graph.number_of_faces(), reduction);
  add_surroundings(network.graph, steps, alone);
  return Face_clusters(network.graph, network.conductances, is_crossed, steps, alone);
}

/// The fragments that walks over clusters of faces make, with the faces along their boundaries walked on again.
/// \param edge_length in the order of the edges
/// \param seeds all different
/// \param make_solver returns a solver that has analysed nothing yet
template <class MakeSolver>
Fragments walk_fragments_over_clusters(const Walk_network& network, const std::vector<double>& edge_length,
                                       const std::vector<Dual_graph::Index>& seeds, const Walk_reduction& reduction,
                                       const MakeSolver& make_solver, const Progress& progress) {
  const Face_clusters clusters = clusters_around(seeds, network, edge_length, reduction);
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
  settle_band(network.graph, network.conductances, is_face_in_band, seeds, fragments.of_face, progress.part(0.7, 1),
              make_solver());
  return fragments;
}

}  // namespace RW_segmentation::internal

#endif
