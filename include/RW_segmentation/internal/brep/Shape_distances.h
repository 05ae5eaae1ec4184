// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_SHAPE_DISTANCES_H
#define RW_SEGMENTATION_INTERNAL_BREP_SHAPE_DISTANCES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/brep/Halfedge_triangles.h>
#include <RW_segmentation/internal/brep/Patch.h>
#include <RW_segmentation/internal/mesh/closest_face.h>

#include <BRepAdaptor_Curve.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace RW_segmentation::internal::brep {

/// How far the corners of a patch's triangles are from its surface, at most.
inline double distance_of_corners(const Halfedge_triangles& mesh, const Patch& patch) {
  if (!patch.surface) return 0;
  double largest = 0;
  for (const std::size_t t : patch.triangles)
    for (const std::size_t v : mesh.corners(t))
      largest = std::max(largest, std::abs(patch.surface->distance(mesh.point(v))));
  return largest;
}

/// How far faces are from the mesh.
class Distance_to_mesh {
 public:
  Distance_to_mesh(const Dual_mesh& mesh, double scale) : mesh_(mesh), scale_(scale), tree_(mesh) {}

  /// The largest distance of points of a face, on its edges and on a grid inside it.
  double of_face(const TopoDS_Face& face) const {
    double largest = 0;
    for (TopExp_Explorer edge(face, TopAbs_EDGE); edge.More(); edge.Next())
      largest = std::max(largest, of_edge(TopoDS::Edge(edge.Current())));
    constexpr int steps = 4;
    double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
    BRepTools::UVBounds(face, u0, u1, v0, v1);
    BRepTopAdaptor_FClass2d inside(face, 1e-7);
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j) {
        const gp_Pnt2d uv(u0 + (u1 - u0) * (i + 0.5) / steps, v0 + (v1 - v0) * (j + 0.5) / steps);
        if (inside.Perform(uv) == TopAbs_IN) largest = std::max(largest, of_point(surface->Value(uv.X(), uv.Y())));
      }
    return largest;
  }

 private:
  double of_edge(const TopoDS_Edge& edge) const {
    constexpr int steps = 8;
    if (BRep_Tool::Degenerated(edge)) return 0;
    const BRepAdaptor_Curve curve(edge);
    double largest = 0;
    for (int i = 0; i <= steps; ++i) {
      const double share = double(i) / steps;
      largest = std::max(largest,
                         of_point(curve.Value((1 - share) * curve.FirstParameter() + share * curve.LastParameter())));
    }
    return largest;
  }

  double of_point(const gp_Pnt& point) const {
    const Point p = (point_of(point) / scale_ - mesh_.origin()) / mesh_.unit();
    const auto closest = tree_.closest_face(p, Point::Zero());
    return closest ? scale_ * mesh_.unit() * std::sqrt(closest->squared_distance) : 0;
  }

  const Dual_mesh& mesh_;
  double scale_;
  Triangle_tree tree_;
};

}  // namespace RW_segmentation::internal::brep

#endif
