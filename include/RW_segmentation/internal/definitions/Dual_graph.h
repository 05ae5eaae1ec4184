// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_DUAL_GRAPH_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_DUAL_GRAPH_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/check_number.h>
#include <RW_segmentation/internal/compiled.h>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace RW_segmentation {

RW_SEGMENTATION_INLINE Dual_graph::Dual_graph(std::size_t number_of_faces, std::vector<std::array<Index, 2>> edges)
    : ends_(std::move(edges)) {
  internal::check_number(number_of_faces, "faces");
  internal::check_number(2 * ends_.size(), "directed edges");
  row_.assign(number_of_faces + 1, 0);
  for (const auto& [f, g] : ends_) {
    if (f >= number_of_faces || g >= number_of_faces || f == g)
      throw std::invalid_argument("Dual_graph: an edge must join two different faces of the graph");
    ++row_[f + 1];
    ++row_[g + 1];
  }
  for (std::size_t f = 0; f < number_of_faces; ++f) row_[f + 1] += row_[f];
  neighbours_.resize(2 * ends_.size());
  std::vector<Index> next(row_.begin(), row_.end() - 1);
  for (std::size_t e = 0; e < ends_.size(); ++e) {
    const auto [f, g] = ends_[e];
    neighbours_[next[f]++] = {g, static_cast<Index>(e)};
    neighbours_[next[g]++] = {f, static_cast<Index>(e)};
  }
}

}  // namespace RW_segmentation

#endif
