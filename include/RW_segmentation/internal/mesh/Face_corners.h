// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_FACE_CORNERS_H
#define RW_SEGMENTATION_INTERNAL_MESH_FACE_CORNERS_H

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The vertices at the corners of each face, counterclockwise from outside, as compressed rows.
class Face_corners {
 public:
  using Index = std::uint32_t;

  /// The corners of a face, a contiguous range of numbers of vertices.
  struct Range {
    const Index *first, *last;
    const Index* begin() const { return first; }
    const Index* end() const { return last; }
    std::size_t size() const { return static_cast<std::size_t>(last - first); }
    Index operator[](std::size_t corner) const { return first[corner]; }
  };

  /// Of no face.
  Face_corners() = default;

  void reserve(std::size_t faces, std::size_t corners) {
    row_.reserve(faces + 1);
    corner_.reserve(corners);
  }
  /// Adds a corner to the face that `end_face()` ends.
  void add(Index vertex) { corner_.push_back(vertex); }
  void end_face() { row_.push_back(corner_.size()); }

  Range operator[](Index face) const {
    return {corner_.data() + row_[face], corner_.data() + row_[face + std::size_t(1)]};
  }
  std::size_t number_of_faces() const { return row_.size() - 1; }
  std::size_t number_of_corners() const { return corner_.size(); }

 private:
  std::vector<std::size_t> row_ = {0};
  std::vector<Index> corner_;
};

}  // namespace RW_segmentation::internal

#endif
