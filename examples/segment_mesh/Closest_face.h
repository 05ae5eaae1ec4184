// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_CLOSEST_FACE_H
#define SEGMENT_MESH_CLOSEST_FACE_H

#include "Oriented_mesh.h"

#include <memory>

namespace segment_mesh {

/// Finds the face of a mesh that is closest to a point, the first one where several are.
class Closest_face {
 public:
  /// Polygons with more than three corners count as fans of triangles. Complexity: O(n log n).
  explicit Closest_face(const Mesh& mesh);
  ~Closest_face();
  Closest_face(const Closest_face&) = delete;
  Closest_face& operator=(const Closest_face&) = delete;

  /// \pre the mesh has a face
  Mesh::Face_index operator()(const Point& p) const;

 private:
  class Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace segment_mesh

#endif
