// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_WALK_FRAGMENTS_H
#define RW_SEGMENTATION_INTERNAL_WALK_WALK_FRAGMENTS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Walk_reduction.h>
#include <RW_segmentation/internal/walk/Any_walk_solver.h>
#include <RW_segmentation/internal/walk/Walk_network.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace RW_segmentation::internal {

/// The regions that walks from seeds make, before they are merged.
struct Fragments {
  std::vector<std::size_t> of_face;  ///< those of the seeds that walks begin at, then whole components
  std::size_t island_faces = 0;      ///< moved, see `Walk_report`
  std::size_t clusters = 0;          ///< that the walk ran over; 0 if it ran over faces
};

/// The labels that walks from seeds give; components without a seed get those after the largest one.
/// \param analysed a solver that has analysed the graph
/// \param seeds all different, at least one
/// \param labels of the seeds
Fragments walk_from_seeds(const Walk_network& network, Any_walk_solver analysed,
                          const std::vector<Dual_graph::Index>& seeds, const std::vector<std::size_t>& labels,
                          const Progress& progress);

/// The fragments that walks from seeds make. A component with a single seed, or none, is one without a walk.
/// \param analysed a solver that has analysed the graph
/// \param seeds all different
Fragments walk_fragments(const Walk_network& network, Any_walk_solver analysed,
                         const std::vector<Dual_graph::Index>& seeds, const Progress& progress);

/// The fragments that walks over clusters of faces make, with the faces along their boundaries walked on again.
/// \param edge_length in the order of the edges
/// \param seeds all different
/// \param make_solver returns a solver that has analysed nothing yet
Fragments walk_fragments_over_clusters(const Walk_network& network, const std::vector<double>& edge_length,
                                       const std::vector<Dual_graph::Index>& seeds, const Walk_reduction& reduction,
                                       const std::function<Any_walk_solver()>& make_solver, const Progress& progress);

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/walk_fragments.h>
#endif

#endif
