// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_CONDUCTANCE_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_CONDUCTANCE_H

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/threads.h>

#include <algorithm>
#include <cmath>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE void require_conductance_numbers(double sigma, double cap) {
  if (!(sigma > 0) || !std::isfinite(sigma)) throw argument_error("sigma", sigma, "positive and finite");
  if (!(cap > 0)) throw argument_error("cap", cap, "positive");
}

RW_SEGMENTATION_INLINE std::vector<double> conductances(const Dual_mesh& mesh, const std::vector<double>& differences,
                                                        double sigma, double cap) {
  // exp(-600) = 1e-261 times a length remains a normal number.
  constexpr double largest_exponent = 600;
  // An edge without length must not cut the graph.
  constexpr double shortest_length = 1e-6;

  require_conductance_numbers(sigma, cap);
  const std::vector<double>& length = mesh.edge_lengths();
  const double mean_length = mesh.mean_edge_length();
  const double shortest = mean_length > 0 ? shortest_length * mean_length : 1;

  const double limit = std::min(cap, largest_exponent);
  std::vector<double> w(differences.size());
  parallel_stretches(w.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e)
      w[e] = mesh.is_wall(static_cast<Dual_mesh::Index>(e))
                 ? 0
                 : std::max(length[e], shortest) * std::exp(-std::min(differences[e] / sigma, limit));
  });
  return w;
}

}  // namespace RW_segmentation::internal

#endif
