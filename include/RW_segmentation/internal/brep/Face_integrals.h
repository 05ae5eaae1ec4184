// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_FACE_INTEGRALS_H
#define RW_SEGMENTATION_INTERNAL_BREP_FACE_INTEGRALS_H

#include <RW_segmentation/internal/brep/Halfedge_triangles.h>
#include <RW_segmentation/internal/brep/Patch_surface.h>

#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAbs_Shape.hxx>
#include <GeomAbs_SurfaceType.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopAbs_Orientation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Ax3.hxx>
#include <gp_Cone.hxx>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec.hxx>
#include <gp_Vec2d.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace RW_segmentation::internal::brep {

/// What is integrated over a face.
struct Face_integrals {
  double area = 0;
  double volume = 0;  ///< of the cone from a point to the face; negative where the face looks towards the point

  Face_integrals& operator+=(const Face_integrals& other) {
    area += other.area;
    volume += other.volume;
    return *this;
  }
  Face_integrals operator*(double factor) const { return {factor * area, factor * volume}; }
};

/// Integrates over a face along its border, by Green's theorem in the parameters of its surface:
///
///   double integral of f(u, v) du dv = integral of F(u, v) dv along the border, where dF/du = f.
///
/// The border is taken as it is, however many knots it has, which the kernel's own integrals miss or take 6 to 40 times as
/// long for. F is known on planes and surfaces of revolution, and integrated from knot to knot on B-splines.
class Face_integration {
 public:
  /// \param apex of the cones; best amid the shape, since gaps between faces count by their distance from it
  Face_integration(const TopoDS_Face& face, const Point& apex)
      : face_(TopoDS::Face(face.Oriented(TopAbs_FORWARD))),
        is_reversed_(face.Orientation() == TopAbs_REVERSED),
        apex_(apex),
        surface_(BRep_Tool::Surface(face)) {
    prepare();
  }

  Face_integrals operator()() const {
    Face_integrals sum;
    for (TopExp_Explorer edge(face_, TopAbs_EDGE); edge.More(); edge.Next()) sum += along(TopoDS::Edge(edge.Current()));
    if (is_reversed_) sum.volume = -sum.volume;
    return sum;
  }

 private:
  void prepare() {
    switch (surface_.GetType()) {
      case GeomAbs_Plane:
        return set_frame(surface_.Plane().Position());
      case GeomAbs_Cylinder:
        return set_frame(surface_.Cylinder().Position());
      case GeomAbs_Cone:
        return set_frame(surface_.Cone().Position());
      case GeomAbs_Sphere:
        return set_frame(surface_.Sphere().Position());
      case GeomAbs_Torus:
        return set_frame(surface_.Torus().Position());
      default:
        return set_knots();
    }
  }

  /// The place of the surface's frame, seen from the apex.
  void set_frame(const gp_Ax3& frame) {
    const gp_Vec place(kernel_point(apex_), frame.Location());
    origin_ = {place.Dot(frame.XDirection()), place.Dot(frame.YDirection()), place.Dot(frame.Direction())};
  }

  void set_knots() {
    constexpr int least_parts = 8;
    TColStd_Array1OfReal knots(1, surface_.NbUIntervals(GeomAbs_C3) + 1);
    surface_.UIntervals(knots, GeomAbs_C3);
    const int spans = knots.Size() - 1, parts = (least_parts + spans - 1) / spans;
    for (int i = knots.Lower(); i < knots.Upper(); ++i)
      for (int k = 0; k < parts; ++k) knots_.push_back(knots(i) + (knots(i + 1) - knots(i)) * k / parts);
    knots_.push_back(knots.Last());
    span_of_v_ = (surface_.LastVParameter() - surface_.FirstVParameter()) / surface_.NbVIntervals(GeomAbs_C3);
  }

  /// The integral of a function, exact to the fifth degree (Gauss).
  template <class Function>
  static Face_integrals integral(double begin, double end, const Function& function) {
    static constexpr std::array<double, 3> places = {-0.7745966692414834, 0, 0.7745966692414834};
    static constexpr std::array<double, 3> weights = {5 / 9., 8 / 9., 5 / 9.};
    const double half = (end - begin) / 2;
    Face_integrals sum;
    for (std::size_t i = 0; i < places.size(); ++i)
      sum += function(begin + half * (1 + places[i])) * (half * weights[i]);
    return sum;
  }

  Face_integrals along(const TopoDS_Edge& edge) const {
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) parameters = BRep_Tool::CurveOnSurface(edge, face_, first, last);
    const Geom2dAdaptor_Curve curve(parameters, first, last);
    TColStd_Array1OfReal knots(1, curve.NbIntervals(GeomAbs_C3) + 1);
    curve.Intervals(knots, GeomAbs_C3);
    Face_integrals sum;
    for (int i = knots.Lower(); i < knots.Upper(); ++i) sum += along(curve, knots(i), knots(i + 1), knots.Size() - 1);
    return edge.Orientation() == TopAbs_REVERSED ? sum * -1 : sum;
  }

  /// Along one of the spans of a curve, in so many parts that all is smooth within each.
  Face_integrals along(const Geom2dAdaptor_Curve& curve, double begin, double end, int spans) const {
    // With twice as many, areas of B-splines change by 2e-3 at most, those of whole shapes by 1e-6; other surfaces have 8
    // digits.
    constexpr double parts_of_curve = 8, parts_of_span = 4;
    const double rise = std::abs(curve.Value(end).Y() - curve.Value(begin).Y());
    const double parts = std::ceil(std::max(parts_of_curve / spans, parts_of_span * rise / span_of_v_));
    const double step = (end - begin) / parts;
    Face_integrals sum;
    for (int i = 0; i < static_cast<int>(parts); ++i)
      sum += integral(begin + i * step, begin + (i + 1) * step, [&](double t) {
        gp_Pnt2d uv;
        gp_Vec2d speed;
        curve.D1(t, uv, speed);
        return up_to(uv.X(), uv.Y()) * speed.Y();
      });
    return sum;
  }

  /// F: the integrals over u at a v.
  Face_integrals up_to(double u, double v) const {
    switch (surface_.GetType()) {
      case GeomAbs_Plane:
        return {u, origin_.z() * u / 3};
      case GeomAbs_Cylinder:
        return on_revolution(u, {surface_.Cylinder().Radius(), v, 0, 1});
      case GeomAbs_Cone: {
        const gp_Cone cone = surface_.Cone();
        const double sine = std::sin(cone.SemiAngle()), cosine = std::cos(cone.SemiAngle());
        return on_revolution(u, {cone.RefRadius() + v * sine, v * cosine, sine, cosine});
      }
      case GeomAbs_Sphere:
        return on_revolution(u, arc(0, surface_.Sphere().Radius(), v));
      case GeomAbs_Torus:
        return on_revolution(u, arc(surface_.Torus().MajorRadius(), surface_.Torus().MinorRadius(), v));
      default:
        return on_spline(u, v);
    }
  }

  /// A point of the curve that is turned about the axis, and its derivative.
  struct Profile {
    double radius, height;
    double radius_slope, height_slope;
  };

  static Profile arc(double middle, double radius, double angle) {
    const double across = radius * std::cos(angle), along = radius * std::sin(angle);
    return {middle + across, along, -along, across};
  }

  /// The surface is o + r (e cos u + f sin u) + z g in a right-handed frame (e, f, g); its normal, as long as the element of
  /// area, is r (z' (e cos u + f sin u) - r' g).
  Face_integrals on_revolution(double u, const Profile& p) const {
    const double across = origin_.x() * std::sin(u) - origin_.y() * std::cos(u) + p.radius * u;
    const double along = (origin_.z() + p.height) * u;
    return {u * std::abs(p.radius) * std::hypot(p.radius_slope, p.height_slope),
            p.radius * (p.height_slope * across - p.radius_slope * along) / 3};
  }

  /// From the middle of the surface, which most of a border is closer to than to its beginning: what depends on v alone adds
  /// nothing along a closed border.
  Face_integrals on_spline(double u, double v) const {
    const auto element = [&](double s) -> Face_integrals {
      gp_Pnt p;
      gp_Vec along_u, along_v;
      surface_.D1(s, v, p, along_u, along_v);
      const gp_Vec normal = along_u.Crossed(along_v);
      return {normal.Magnitude(), gp_Vec(kernel_point(apex_), p).Dot(normal) / 3};
    };
    const auto [begin, end] = std::minmax({knots_[knots_.size() / 2], u});
    Face_integrals sum;
    for (std::size_t i = 0; i + 1 < knots_.size() && knots_[i] < end; ++i)
      if (knots_[i + 1] > begin) sum += integral(std::max(begin, knots_[i]), std::min(end, knots_[i + 1]), element);
    return end == u ? sum : sum * -1;
  }

  TopoDS_Face face_;  // its surface's way round
  bool is_reversed_;
  Point apex_, origin_ = Point::Zero();
  GeomAdaptor_Surface surface_;
  std::vector<double> knots_;                                   // of u, of a B-spline, and some between them
  double span_of_v_ = std::numeric_limits<double>::infinity();  // likewise
};

/// The area of a face, and the volume of the cone from a point to it.
inline Face_integrals integrals_of(const TopoDS_Face& face, const Point& apex) {
  return Face_integration(face, apex)();
}

}  // namespace RW_segmentation::internal::brep

#endif
