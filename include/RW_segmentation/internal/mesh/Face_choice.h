// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_FACE_CHOICE_H
#define RW_SEGMENTATION_INTERNAL_MESH_FACE_CHOICE_H

#include <RW_segmentation/internal/mesh/Face_corners.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// Takes faces of a mesh by themselves, for one choice of them after the other.
class Face_choice {
 public:
  using Index = Face_corners::Index;

  /// The corners of some faces.
  struct Faces {
    Face_corners corners;
    std::vector<Index> vertices;  ///< by their numbers in these corners: those of the mesh
  };

  explicit Face_choice(std::size_t number_of_vertices) : number_(number_of_vertices, none) {}

  /// \param corners a function from a face of the mesh to its corners
  /// \param faces different ones
  /// Complexity: linear in their number.
  template <class Corners>
  Faces operator()(const Corners& corners, const std::vector<Index>& faces) {
    Faces chosen;
    for (const Index f : faces) {
      for (const Index v : corners(f)) {
        if (number_[v] == none) {
          number_[v] = static_cast<Index>(chosen.vertices.size());
          chosen.vertices.push_back(v);
        }
        chosen.corners.add(number_[v]);
      }
      chosen.corners.end_face();
    }
    for (const Index v : chosen.vertices) number_[v] = none;
    return chosen;
  }

 private:
  static constexpr Index none = std::numeric_limits<Index>::max();

  std::vector<Index> number_;  // by vertex of the mesh, `none` between two choices
};

}  // namespace RW_segmentation::internal

#endif
