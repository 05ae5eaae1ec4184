#ifndef RW_SEGMENTATION_INTERNAL_READ_SEGMENTS_H
#define RW_SEGMENTATION_INTERNAL_READ_SEGMENTS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/Edge_values.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

/// The segment ids of the faces, in their order.
template <class FaceListGraph, class SegmentIdMap>
std::vector<std::size_t> read_segments(const Mesh_dual_graph<FaceListGraph>& graph, const SegmentIdMap& segment_ids) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(is_readable_map<SegmentIdMap, face_descriptor>,
                "segment_ids must be a readable property map from the mesh's face_descriptor to an integer.");
  std::vector<std::size_t> segments;
  segments.reserve(graph.number_of_faces());
  for (const face_descriptor f : graph.face_descriptors())
    segments.push_back(static_cast<std::size_t>(get(segment_ids, f)));
  return segments;
}

/// Numbers different labels from 0 in ascending order.
/// \param rank output, the number of each label
/// \returns the labels by their numbers
template <class Label>
std::vector<Label> rank_labels(const std::vector<Label>& labels, std::vector<std::size_t>& rank) {
  std::vector<Label> sorted = labels;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  rank.clear();
  for (const Label& label : labels)
    rank.push_back(static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), label) - sorted.begin()));
  return sorted;
}

}  // namespace RW_segmentation::internal

#endif
