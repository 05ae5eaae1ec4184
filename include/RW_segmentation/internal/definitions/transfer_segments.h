// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_TRANSFER_SEGMENTS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_TRANSFER_SEGMENTS_H

#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/mesh/closest_face.h>
#include <RW_segmentation/internal/rank_labels.h>
#include <RW_segmentation/internal/threads.h>
#include <RW_segmentation/internal/walk/settle_band.h>
#include <RW_segmentation/internal/walk/spurious_regions.h>
#include <RW_segmentation/transfer_segments.h>

#include <algorithm>

namespace RW_segmentation::internal {

/// For each face the one of the reduced mesh that is closest to its centroid and looks the same way; the closest of all
/// where none does.
inline std::vector<Dual_mesh::Index> closest_faces(const Dual_mesh& mesh, const Triangle_tree& reduced) {
  std::vector<Dual_mesh::Index> closest(mesh.number_of_faces());
  parallel_stretches(closest.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Eigen::Vector3d centroid = mesh.centroid(static_cast<Dual_mesh::Index>(f));
      auto found = reduced.closest_face(centroid, mesh.normal(static_cast<Dual_mesh::Index>(f)));
      if (!found) found = reduced.closest_face(centroid, Eigen::Vector3d::Zero());
      if (!found) throw std::invalid_argument("the reduced mesh has no face with an area");
      closest[f] = found->face;
    }
  });
  return closest;
}

/// For each label whose faces all lie in the band, the one that is deepest in its segment: last in the order in which
/// the band was reached.
inline std::vector<Dual_mesh::Index> cores_within(const std::vector<Dual_mesh::Index>& band,
                                                  const std::vector<char>& is_in_band,
                                                  const std::vector<std::size_t>& labels) {
  std::map<std::size_t, Dual_mesh::Index> deepest;
  for (const auto face : band) deepest[labels[face]] = face;
  for (std::size_t f = 0; f < labels.size(); ++f)
    if (!is_in_band[f]) deepest.erase(labels[f]);
  std::vector<Dual_mesh::Index> cores;
  for (const auto& [label, face] : deepest) cores.push_back(face);
  return cores;
}

RW_SEGMENTATION_INLINE std::vector<std::size_t> transferred(const Dual_mesh& reduced,
                                                            const std::vector<std::size_t>& reduced_ids,
                                                            const Dual_mesh& mesh,
                                                            const std::vector<double>& conductances, std::size_t band,
                                                            const Progress& progress) {
  std::vector<std::size_t> reduced_labels;  // any number may be an id
  const std::vector<std::size_t> id_of_label = rank_labels(reduced_ids, reduced_labels);
  const Triangle_tree tree = Triangle_tree::in_frame(reduced, mesh);
  std::vector<std::size_t> labels;
  labels.reserve(mesh.number_of_faces());
  for (const auto closest : closest_faces(mesh, tree)) labels.push_back(reduced_labels[closest]);
  progress(0.5);
  if (band > 0) {
    const std::vector<Dual_mesh::Index> along = band_along_boundaries(mesh.graph(), labels, band);
    std::vector<char> is_in_band =
        faces_of_spurious_regions(regions_of(mesh, labels), mesh.areas(), labels,
                                  regions_of_labels(regions_of(reduced, reduced_labels), reduced_labels));
    for (const auto face : along) is_in_band[face] = true;
    settle_band(mesh.graph(), conductances, {is_in_band, cores_within(along, is_in_band, labels)}, labels,
                progress.part(0.5, 1));
  }
  progress(1);
  for (std::size_t& label : labels) label = id_of_label[label];
  return labels;
}

}  // namespace RW_segmentation::internal

#endif
