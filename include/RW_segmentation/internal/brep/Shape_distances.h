// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_SHAPE_DISTANCES_H
#define RW_SEGMENTATION_INTERNAL_BREP_SHAPE_DISTANCES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/brep/Halfedge_triangles.h>
#include <RW_segmentation/internal/brep/Patch.h>
#include <RW_segmentation/internal/brep/Patch_surface.h>
#include <RW_segmentation/internal/mesh/closest_face.h>

#include <Eigen/Geometry>

#include <BRepAdaptor_Curve.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAbs_Shape.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_TShape.hxx>
#include <gp_Pnt2d.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_map>
#include <vector>

namespace RW_segmentation::internal::brep {

/// How far each vertex is from the closest of the surfaces round it; 0 beside triangles, which are what they were.
///
/// Edges of the shape cut off teeth in the border between two segments. The corners of these are far from one of the surfaces,
/// but not from the shape.
/// \param faces by patch; null where there is none
inline std::vector<double> distances_of_vertices(const Halfedge_triangles& mesh, const std::vector<Patch>& patches,
                                                 const std::vector<TopoDS_Face>& faces) {
  std::vector<double> distances(mesh.points().size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (faces[i].IsNull()) continue;
    const auto& surface = patches[i].surface;
    for (const std::size_t t : patches[i].triangles)
      for (const std::size_t v : mesh.corners(t))
        distances[v] = std::min(distances[v], surface ? std::abs(surface->distance(mesh.point(v))) : 0);
  }
  return distances;
}

/// The border of a face in the parameters of its surface, as sides of polygons.
class Border_polygon {
 public:
  explicit Border_polygon(const TopoDS_Face& face) {
    constexpr int least_sides = 8, sides_of_span = 2;
    for (TopExp_Explorer edge(face, TopAbs_EDGE); edge.More(); edge.Next()) {
      double first = 0, last = 0;
      const Handle(Geom2d_Curve) parameters =
          BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Current()), face, first, last);
      const Geom2dAdaptor_Curve curve(parameters, first, last);
      const int sides = std::max(least_sides, sides_of_span * curve.NbIntervals(GeomAbs_C3));
      Parameters from = point(curve, first);
      for (int i = 1; i <= sides; ++i) {
        const Parameters to = point(curve, first + (last - first) * i / sides);
        sides_.push_back({from, to});
        box_.extend(to);
        from = to;
      }
    }
  }

  const Eigen::AlignedBox2d& box() const { return box_; }

  /// Whether a ray from a point crosses an odd number of sides.
  bool contains(const Parameters& p) const {
    bool is_inside = false;
    for (const auto& [from, to] : sides_) {
      if ((from.y() > p.y()) == (to.y() > p.y())) continue;
      const double share = (p.y() - from.y()) / (to.y() - from.y());
      if (from.x() + share * (to.x() - from.x()) > p.x()) is_inside = !is_inside;
    }
    return is_inside;
  }

 private:
  static Parameters point(const Geom2dAdaptor_Curve& curve, double parameter) {
    const gp_Pnt2d uv = curve.Value(parameter);
    return {uv.X(), uv.Y()};
  }

  std::vector<std::array<Parameters, 2>> sides_;
  Eigen::AlignedBox2d box_;
};

/// How far faces are from the mesh.
class Distance_to_mesh {
 public:
  Distance_to_mesh(const Dual_mesh& mesh, double scale) : mesh_(mesh), scale_(scale), tree_(mesh) {}

  /// The largest distance of points of a face, on its edges and on a grid inside it.
  double of_face(const TopoDS_Face& face) {
    double largest = 0;
    for (TopExp_Explorer edge(face, TopAbs_EDGE); edge.More(); edge.Next())
      largest = std::max(largest, of_edge(TopoDS::Edge(edge.Current())));
    constexpr int steps = 4;
    const Border_polygon border(face);
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    for (int i = 0; i < steps; ++i)
      for (int j = 0; j < steps; ++j) {
        const Parameters share((i + 0.5) / steps, (j + 0.5) / steps);
        const Parameters uv = border.box().min() + share.cwiseProduct(border.box().sizes());
        if (border.contains(uv)) largest = std::max(largest, of_point(surface->Value(uv.x(), uv.y())));
      }
    return largest;
  }

 private:
  /// Measured once for both of its faces.
  double of_edge(const TopoDS_Edge& edge) {
    const auto [known, is_new] = of_edges_.try_emplace(edge.TShape().get(), 0.);
    if (is_new) known->second = of_points_along(edge);
    return known->second;
  }

  double of_points_along(const TopoDS_Edge& edge) const {
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
  std::unordered_map<const TopoDS_TShape*, double> of_edges_;
};

}  // namespace RW_segmentation::internal::brep

#endif
