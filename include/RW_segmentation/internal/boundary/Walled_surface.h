// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_WALLED_SURFACE_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_WALLED_SURFACE_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>

#include <optional>

namespace RW_segmentation::internal {

/// A surface whose walls no curve crosses, though it may run along them.
class Walled_surface {
 public:
  using Index = Triangle_surface::Index;

  explicit Walled_surface(const Dual_mesh& mesh) : whole_(mesh) {
    if (mesh.has_walls()) open_.emplace(mesh, [&](Index edge) { return !mesh.is_wall(edge); });
  }

  /// What curves are cut into.
  const Triangle_surface& whole() const { return whole_; }
  /// The surface cut open along its walls, which curves move on. Faces, halfedges, and edges that are no walls have the
  /// same numbers on both. Vertices have not: one on a wall becomes several.
  const Triangle_surface& open() const { return open_ ? *open_ : whole_; }

  bool is_wall(Index halfedge) const { return open().is_border(halfedge) && !whole_.is_border(halfedge); }
  Index whole_vertex(Index open_vertex) const { return whole_.source(open().leaving(open_vertex)); }

 private:
  Triangle_surface whole_;
  std::optional<Triangle_surface> open_;  // if there are walls
};

}  // namespace RW_segmentation::internal

#endif
