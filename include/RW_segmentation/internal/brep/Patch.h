// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_PATCH_H
#define RW_SEGMENTATION_INTERNAL_BREP_PATCH_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/internal/brep/Halfedge_triangles.h>
#include <RW_segmentation/internal/brep/Patch_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace RW_segmentation::internal::brep {

/// How a patch becomes a face, the best first; a face that the kernel refuses is made in the next way.
enum class Form {
  surface,                ///< on the surface of its segment
  surface_with_chords,    ///< so, within the edges of the mesh
  free_form,              ///< on a fitted B-spline surface
  free_form_with_chords,  ///< so, within the edges of the mesh
  triangles,              ///< a plane for each triangle
};

/// A piece of a segment that becomes a face.
struct Patch {
  std::size_t segment = 0;
  std::vector<std::size_t> triangles;
  Form form = Form::surface;
  std::shared_ptr<Patch_surface> surface;  ///< null for triangles, whose planes their vertices tell

  bool has_triangles() const { return form == Form::triangles; }
  bool is_free_form() const { return form == Form::free_form || form == Form::free_form_with_chords; }
  /// Whether it is bounded by the edges of the mesh, as they are.
  bool has_chords() const {
    return has_triangles() || form == Form::surface_with_chords || form == Form::free_form_with_chords;
  }
};

/// How far the centres of triangles are from a surface that their corners may lie on.
inline double bulge(const Halfedge_triangles& mesh, const std::vector<std::size_t>& triangles,
                    const Analytic_surface& surface) {
  double largest = 0;
  for (const std::size_t t : triangles) largest = std::max(largest, std::abs(surface.signed_distance(mesh.centre(t))));
  return largest;
}

inline double area_of(const Halfedge_triangles& mesh, const std::vector<std::size_t>& triangles) {
  double area = 0;
  for (const std::size_t t : triangles) area += mesh.area_vector(t).norm();
  return area;
}

/// The corners of triangles, each once.
inline std::vector<std::size_t> corners_of(const Halfedge_triangles& mesh, const std::vector<std::size_t>& triangles) {
  std::vector<std::size_t> corners;
  for (const std::size_t t : triangles)
    for (const std::size_t v : mesh.corners(t)) corners.push_back(v);
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace RW_segmentation::internal::brep

#endif
