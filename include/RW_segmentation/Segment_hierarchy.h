// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_SEGMENT_HIERARCHY_H
#define RW_SEGMENTATION_SEGMENT_HIERARCHY_H

#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/internal/property_maps.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// The number of segments that a stop predicate chooses.
template <class StopPredicate>
std::size_t segments_at_stop(const Merge_tree& tree, const StopPredicate& stop) {
  static_assert(std::is_invocable_r_v<std::size_t, const StopPredicate&, const Merge_tree&>,
                "stop must be a function from Merge_tree to the number of segments, such as Segment_count_stop(6) or "
                "Cost_threshold_stop(1).");
  return stop(tree);
}

}  // namespace internal

/// All levels of a segmentation, from the fragments it was made of to one segment for each connected component.
///
/// Made by `merge_segments()`. Holds the merges and the fragment of each face, so that any number of segments is read
/// off without merging again: 16 bytes a face.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`; no reference to the mesh is kept
template <class FaceListGraph>
class Segment_hierarchy : public Merge_tree {
 public:
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;

  Segment_hierarchy() = default;

  /// \param fragment_of_face the fragment of each of the `faces`, in their order
  Segment_hierarchy(Merge_tree tree, std::vector<face_descriptor> faces, std::vector<std::size_t> fragment_of_face)
      : Merge_tree(std::move(tree)), faces_(std::move(faces)), fragment_of_face_(std::move(fragment_of_face)) {}

  /// Writes the segment of each face at the level that a stop predicate chooses.
  ///
  /// \tparam StopPredicate a function from `const Merge_tree&` to the number of segments to stop at:
  /// `Segment_count_stop`, `Cost_threshold_stop`, `Cost_jump_stop`, a lambda
  /// \tparam SegmentIdMap a writable property map from `face_descriptor` to `std::size_t`
  /// \param stop when merging stops
  /// \param segment_ids output, ids from 0 in the order of the segments' lowest fragments
  /// \returns the number of segments
  /// \throws std::invalid_argument if `stop` returns fewer segments than components or more than fragments, or more than
  /// the map has values for; no id is written then
  template <class StopPredicate, class SegmentIdMap>
  std::size_t segments(const StopPredicate& stop, SegmentIdMap segment_ids) const {
    static_assert(internal::is_writable_map<SegmentIdMap, face_descriptor>,
                  "segment_ids must be a writable property map from the mesh's face_descriptor to std::size_t.");
    const std::size_t number_of_segments = internal::segments_at_stop(*this, stop);
    const std::vector<std::size_t> segment = segment_of_fragments(number_of_segments);
    internal::require_ids_fit<SegmentIdMap>(segment);
    for (std::size_t i = 0; i < faces_.size(); ++i) put(segment_ids, faces_[i], segment[fragment_of_face_[i]]);
    return number_of_segments;
  }

 private:
  std::vector<face_descriptor> faces_;
  std::vector<std::size_t> fragment_of_face_;
};

}  // namespace RW_segmentation

#endif
