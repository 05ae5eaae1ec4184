// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_COMMON_REFINEMENT_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_COMMON_REFINEMENT_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/walk/Common_refinement.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE Common_refinement
common_refinement(const Dual_graph& graph, const std::vector<double>& conductance,
                  const std::vector<std::vector<std::size_t>>& fragment_of_face) {
  const Components piece(graph, [&](Dual_graph::Index edge) {
    const auto [f, g] = graph.faces_of(edge);
    return conductance[edge] > 0 &&
           std::all_of(fragment_of_face.begin(), fragment_of_face.end(),
                       [f = f, g = g](const std::vector<std::size_t>& of) { return of[f] == of[g]; });
  });
  std::vector<std::vector<std::size_t>> fragments_of(piece.count);
  for (std::size_t f = 0; f < piece.of.size(); ++f) {
    std::vector<std::size_t>& fragments = fragments_of[piece.of[f]];
    if (!fragments.empty()) continue;
    for (const std::vector<std::size_t>& of : fragment_of_face) fragments.push_back(of[f]);
  }

  // That order does not depend on the order of the faces but where a piece falls apart.
  std::vector<std::size_t> order(piece.count), rank(piece.count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return fragments_of[a] < fragments_of[b]; });
  Common_refinement refinement;
  for (std::size_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = i;
    refinement.fragments_of.push_back(std::move(fragments_of[order[i]]));
  }
  refinement.of_face.reserve(piece.of.size());
  for (const auto p : piece.of) refinement.of_face.push_back(rank[p]);
  return refinement;
}

}  // namespace RW_segmentation::internal

#endif
