// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SEEDS_FARTHEST_POINTS_H
#define RW_SEGMENTATION_INTERNAL_SEEDS_FARTHEST_POINTS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/seeds/Distances_to_sources.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace RW_segmentation::internal {

/// The first face whose value is the greatest but for rounding, so that a symmetric mesh gives the same answer in every
/// position.
template <class Values>
Dual_graph::Index first_greatest(const Values& values) {
  const double greatest = *std::max_element(values.begin(), values.end());
  const double limit = greatest - 1e-9 * std::abs(greatest);
  return static_cast<Dual_graph::Index>(
      std::find_if(values.begin(), values.end(), [&](double value) { return value >= limit; }) - values.begin());
}

/// Makes seeds sources, and adds one in each component that no source reaches.
inline void reach_all_components_from(std::vector<Dual_graph::Index>& seeds, Distances_to_sources& distance) {
  for (const auto face : seeds) distance.add_source(face);
  const auto out_of_reach = reach_all_components(distance);
  seeds.insert(seeds.end(), out_of_reach.begin(), out_of_reach.end());
}

/// Goes on from seeds, which are sources, to the farthest face again and again, up to a count.
/// \throws Cancelled
inline void add_farthest_points(std::vector<Dual_graph::Index>& seeds, Distances_to_sources& distance,
                                std::size_t count, const Progress& progress) {
  while (seeds.size() < count) {
    progress(static_cast<double>(seeds.size()) / static_cast<double>(count));
    seeds.push_back(first_greatest(*distance));
    distance.add_source(seeds.back());
  }
}

/// Goes on from a first seed, which is no source yet, to each component that no source reaches, and then to the farthest
/// face again and again, up to a count.
/// \throws std::invalid_argument if that is less than the number of components, Cancelled
inline std::vector<Dual_graph::Index> farthest_points(Distances_to_sources& distance,
                                                      std::vector<Dual_graph::Index> seeds, std::size_t count,
                                                      const Progress& progress) {
  reach_all_components_from(seeds, distance);
  if (seeds.size() > count) {
    const std::string components = std::to_string(seeds.size()) + ", the number of components without a given seed";
    throw argument_error("count", count, ("at least " + components).c_str());
  }
  add_farthest_points(seeds, distance, count, progress);
  return seeds;
}

}  // namespace RW_segmentation::internal

#endif
