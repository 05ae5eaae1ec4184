// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_SETTLE_BAND_H
#define RW_SEGMENTATION_INTERNAL_WALK_SETTLE_BAND_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/walk/Face_clusters.h>
#include <RW_segmentation/internal/walk/Seeded_walk.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The nodes along the boundaries between labels, up to a distance of `steps` nodes.
inline std::vector<Dual_graph::Index> band_along_boundaries(const Dual_graph& graph,
                                                            const std::vector<std::size_t>& labels, std::size_t steps) {
  std::vector<Dual_graph::Index> band;
  if (steps == 0) return band;
  for (Dual_graph::Index node = 0; node < graph.number_of_faces(); ++node) {
    const auto neighbours = graph.neighbours(node);
    if (std::any_of(neighbours.begin(), neighbours.end(),
                    [&](const auto& neighbour) { return labels[neighbour.face] != labels[node]; }))
      band.push_back(node);
  }
  add_surroundings(graph, steps - 1, band);
  return band;
}

/// Faces that are walked on once more.
struct Face_band {
  const std::vector<char>& contains;            ///< by face
  const std::vector<Dual_graph::Index>& seeds;  ///< faces that keep their labels wherever they lie
};

/// Labels the faces of a band anew: walks from them end at the faces around the band, which keep their labels, and at
/// the seeds. The walks run over the band alone.
///
/// \param labels of the faces; where a part of the band reaches neither, they stay as they are
inline void settle_band(const Dual_graph& graph, const std::vector<double>& conductances,
                        const Face_band& faces_of_band, std::vector<std::size_t>& labels, const Progress& progress,
                        Any_walk_solver solver = {}) {
  using Index = Dual_graph::Index;
  constexpr Index none = std::numeric_limits<Index>::max();
  const std::vector<char>& is_in_band = faces_of_band.contains;
  std::vector<Index> number(graph.number_of_faces(), none), faces;
  const auto number_of = [&](Index face) {
    if (number[face] == none) {
      number[face] = static_cast<Index>(faces.size());
      faces.push_back(face);
    }
    return number[face];
  };
  std::vector<std::array<Index, 2>> ends;
  std::vector<double> conductance;
  for (Index f = 0; f < graph.number_of_faces(); ++f) {
    if (!is_in_band[f]) continue;
    const Index own = number_of(f);
    for (const auto& [g, edge] : graph.neighbours(f)) {
      if (is_in_band[g] && g < f) continue;  // which has added the edge
      ends.push_back({own, number_of(g)});
      conductance.push_back(conductances[edge]);
    }
  }

  std::vector<char> keeps_label(faces.size());
  for (Index i = 0; i < faces.size(); ++i) keeps_label[i] = !is_in_band[faces[i]];
  for (const Index seed : faces_of_band.seeds)
    if (number[seed] != none) keeps_label[number[seed]] = true;
  std::vector<Index> absorbing;
  std::vector<std::size_t> absorbed_label;
  for (Index i = 0; i < faces.size(); ++i) {
    if (!keeps_label[i]) continue;
    absorbing.push_back(i);
    absorbed_label.push_back(labels[faces[i]]);
  }
  if (absorbing.empty()) return;

  const Dual_graph band(faces.size(), std::move(ends));
  const Components component(band, [&](Index edge) { return conductance[edge] > 0; });
  std::vector<char> is_settled(component.count, false);
  for (const Index i : absorbing) is_settled[component.of[i]] = true;
  const std::vector<std::size_t> settled =
      walk_labels(band, conductance, absorbing, absorbed_label, progress, std::move(solver));
  for (Index i = 0; i < faces.size(); ++i)
    if (is_settled[component.of[i]]) labels[faces[i]] = settled[i];
}

}  // namespace RW_segmentation::internal

#endif
