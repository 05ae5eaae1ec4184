// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_FACE_CORNERS_H
#define RW_SEGMENTATION_INTERNAL_MESH_FACE_CORNERS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The vertices at the corners of each face, counterclockwise from outside, as rows of one length, or as compressed rows
/// where faces differ in their numbers of corners.
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
    expected_faces_ = faces;
    corner_.reserve(corners);
  }
  /// Adds a corner to the face that `end_face()` ends.
  void add(Index vertex) { corner_.push_back(vertex); }
  void end_face() {
    const std::size_t degree = corner_.size() - begin_of(faces_);
    if (faces_ == 0) degree_ = degree;
    if (row_.empty() && degree != degree_) begin_rows();
    ++faces_;
    if (!row_.empty()) row_.push_back(corner_.size());
  }

  Range operator[](Index face) const {
    return {corner_.data() + begin_of(face), corner_.data() + begin_of(face + std::size_t(1))};
  }
  std::size_t number_of_faces() const { return faces_; }
  std::size_t number_of_corners() const { return corner_.size(); }

 private:
  std::size_t begin_of(std::size_t face) const { return row_.empty() ? degree_ * face : row_[face]; }

  /// Those of the faces so far, which all have the same length.
  void begin_rows() {
    row_.reserve(std::max(expected_faces_, faces_) + 1);
    for (std::size_t face = 0; face <= faces_; ++face) row_.push_back(degree_ * face);
  }

  std::size_t faces_ = 0, degree_ = 0, expected_faces_ = 0;
  std::vector<std::size_t> row_;  // empty while all faces have `degree_` corners
  std::vector<Index> corner_;
};

}  // namespace RW_segmentation::internal

#endif
