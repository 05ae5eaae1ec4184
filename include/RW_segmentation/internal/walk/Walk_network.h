// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_WALK_NETWORK_H
#define RW_SEGMENTATION_INTERNAL_WALK_WALK_NETWORK_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/threads.h>

#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

/// What walks run on: the faces of a mesh, or clusters of them.
struct Walk_network {
  const Dual_graph& graph;
  const std::vector<double>& conductances;
  const Components& component;     ///< over edges that conduct
  bool all_edges_conduct = false;  ///< known to: conductances need not be read for it

  bool conducts(Dual_graph::Index edge) const { return all_edges_conduct || conductances[edge] > 0; }
};

/// Faces whose potentials are worked on together; those of a few labels stay in the cache.
constexpr std::size_t faces_at_a_time = 4096;

/// Calls `work(begin, end)` for stretches of faces, for several at the same time where there are threads.
template <class Work>
void for_stretches(const Walk_network& network, const Work& work) {
  parallel_stretches(network.graph.number_of_faces(), work, faces_at_a_time);
}

}  // namespace RW_segmentation::internal

#endif
