#ifndef RW_SEGMENTATION_INTERNAL_WALK_FRAGMENTS_H
#define RW_SEGMENTATION_INTERNAL_WALK_FRAGMENTS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/Walk_reduction.h>
#include <RW_segmentation/internal/Face_clusters.h>
#include <RW_segmentation/internal/Graph_walk.h>
#include <RW_segmentation/internal/settle_band.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// What walks run on: the faces of a mesh, or clusters of them.
struct Walk_network {
  const Dual_graph& graph;
  const std::vector<double>& conductances;
  const Components& component;
};

/// The regions that walks from seeds make, before they are merged.
struct Fragments {
  std::vector<std::size_t> of_face;  ///< numbered from 0 in the order of the seeds
  std::size_t island_faces = 0;      ///< moved, see `Walk_report`
  std::size_t clusters = 0;          ///< that the walk ran over; 0 if it ran over faces
};

/// The fragments that walks from seeds make. A component with a single seed needs no walk.
inline Fragments walk_fragments(const Walk_network& network, Star_mesh_elimination analysed,
                                const std::vector<Dual_graph::Index>& seeds, const Progress& progress) {
  const Components& component = network.component;
  std::vector<std::size_t> seeds_in(component.count, 0);
  for (const auto seed : seeds) ++seeds_in[component.of[seed]];
  std::vector<Dual_graph::Index> walked;
  for (const auto seed : seeds)
    if (seeds_in[component.of[seed]] > 1) walked.push_back(seed);
  if (walked.empty()) return {{component.of.begin(), component.of.end()}};

  std::vector<std::size_t> labels(walked.size());
  std::iota(labels.begin(), labels.end(), std::size_t(0));
  Walk_report report;
  labels = walk_labels(network.graph, network.conductances, walked, labels, progress, &report,
                       std::optional(std::move(analysed)));
  return {std::move(labels), report.island_faces};
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
inline Fragments walk_fragments_over_clusters(const Walk_network& network, const std::vector<double>& edge_length,
                                              const std::vector<Dual_graph::Index>& seeds,
                                              const Walk_reduction& reduction, const Progress& progress) {
  const Face_clusters clusters = clusters_around(seeds, network, edge_length, reduction);
  progress(0.2);
  Components component = {{}, network.component.count};
  for (const auto root : clusters.root) component.of.push_back(network.component.of[root]);
  std::vector<Dual_graph::Index> cluster_of_seed(seeds.size());
  std::iota(cluster_of_seed.begin(), cluster_of_seed.end(), Dual_graph::Index(0));
  Star_mesh_elimination solver;
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
  settle_band(network.graph, network.conductances, is_face_in_band, seeds, fragments.of_face, progress.part(0.7, 1));
  return fragments;
}

}  // namespace RW_segmentation::internal

#endif
