// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENTATION_VIA_RANDOM_WALKS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_SEGMENTATION_VIA_RANDOM_WALKS_H

#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE Merged_fragments::Merged_fragments() = default;
RW_SEGMENTATION_INLINE Merged_fragments::Merged_fragments(Merged_fragments&&) noexcept = default;
RW_SEGMENTATION_INLINE Merged_fragments& Merged_fragments::operator=(Merged_fragments&&) noexcept = default;
RW_SEGMENTATION_INLINE Merged_fragments::~Merged_fragments() = default;

RW_SEGMENTATION_INLINE std::vector<std::size_t> segment_of_faces(const Merged_fragments& merged,
                                                                 std::size_t number_of_segments) {
  const std::vector<std::size_t> segment_of_fragment = merged.tree.segment_of_fragments(number_of_segments);
  std::vector<std::size_t> segment_of_face;
  segment_of_face.reserve(merged.fragment_of_face.size());
  for (const std::size_t fragment : merged.fragment_of_face) segment_of_face.push_back(segment_of_fragment[fragment]);
  return segment_of_face;
}

RW_SEGMENTATION_INLINE void require_seedings(std::size_t seedings) {
  if (seedings == 0) throw argument_error("seedings", seedings, "at least 1");
}

RW_SEGMENTATION_INLINE void require_least_component(double share) {
  if (!(share >= 0)) throw argument_error("least_component", share, "at least 0");
}

// ---- Components ----

inline void add_report(const Segmentation_report& component, Segmentation_report& report) {
  report.components += component.components;
  report.seeds += component.seeds;
  report.clusters += component.clusters;
  report.fragments += component.fragments;
  report.degenerate_faces += component.degenerate_faces;
  report.island_faces += component.island_faces;
  report.has_heavy_noise |= component.has_heavy_noise;
  for (const Segmentation_report::Stage& stage : component.stages) {
    const auto same = std::find_if(report.stages.begin(), report.stages.end(),
                                   [&](const Segmentation_report::Stage& s) { return s.name == stage.name; });
    if (same == report.stages.end())
      report.stages.push_back(stage);
    else
      same->seconds += stage.seconds;
  }
}

/// Makes stages take as long as they did together.
inline void share_out(double seconds, std::vector<Segmentation_report::Stage>& stages) {
  double sum = 0;
  for (const Segmentation_report::Stage& stage : stages) sum += stage.seconds;
  for (Segmentation_report::Stage& stage : stages) stage.seconds *= sum > seconds ? seconds / sum : 1;
}

RW_SEGMENTATION_INLINE Merged_fragments whole_of(std::vector<Merged_fragments> components, double reading_seconds,
                                                 double seconds) {
  Merged_fragments whole;
  std::vector<Merge_tree> trees;
  std::size_t fragments = 0;
  for (Merged_fragments& component : components) {
    for (const std::size_t fragment : component.fragment_of_face)
      whole.fragment_of_face.push_back(fragments + fragment);
    fragments += component.tree.number_of_fragments();
    trees.push_back(std::move(component.tree));
    add_report(component.report, whole.report);
    component = {};
  }
  share_out(seconds, whole.report.stages);
  whole.report.stages.front().seconds += reading_seconds;  // the largest component has stages
  whole.tree = side_by_side(trees);
  return whole;
}

RW_SEGMENTATION_INLINE std::vector<std::vector<Dual_mesh::Index>> seeds_of_components(
    const std::vector<Mesh_stretch>& components, const std::vector<Dual_mesh::Index>& seeds) {
  std::vector<std::vector<Dual_mesh::Index>> result(components.size());
  for (const Dual_mesh::Index seed : seeds) {
    const auto after =
        std::upper_bound(components.begin(), components.end(), seed,
                         [](Dual_mesh::Index face, const Mesh_stretch& c) { return face < c.first_face; });
    result[static_cast<std::size_t>(after - components.begin()) - 1].push_back(seed - (after - 1)->first_face);
  }
  return result;
}

RW_SEGMENTATION_INLINE std::vector<double> areas_of(const std::vector<Mesh_stretch>& components,
                                                    const Dual_mesh& mesh) {
  std::vector<double> areas;
  for (const Mesh_stretch& component : components) {
    const auto begin = mesh.areas().begin() + component.first_face;
    areas.push_back(std::accumulate(begin, begin + component.faces, 0.));
  }
  return areas;
}

RW_SEGMENTATION_INLINE bool has_walls(const Mesh_stretch& component, const Dual_mesh& mesh) {
  for (Dual_mesh::Index e = component.first_edge; e < component.first_edge + component.edges; ++e)
    if (mesh.is_wall(e)) return true;
  return false;
}

RW_SEGMENTATION_INLINE Merged_fragments one_segment(const Mesh_stretch& component, const Dual_mesh& mesh) {
  Merged_fragments merged;
  merged.tree = Merge_tree(1, {});
  merged.fragment_of_face.assign(component.faces, 0);
  merged.report.components = merged.report.fragments = 1;
  for (Dual_mesh::Index f = component.first_face; f < component.first_face + component.faces; ++f)
    if (mesh.normal(f).isZero(0)) ++merged.report.degenerate_faces;
  return merged;
}

template <class ConcurrencyTag>
Merged_fragments segment_by_automatic_policies(const Dual_mesh& mesh, const Automatic_policies& policies,
                                               const std::vector<Dual_mesh::Index>& given, const Progress& progress,
                                               Stage_clock::Time begin) {
  return segment_components_by_policies<ConcurrencyTag>(mesh, policies, given, progress, begin);
}

}  // namespace RW_segmentation::internal

#endif
