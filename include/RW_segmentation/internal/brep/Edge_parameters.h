// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_EDGE_PARAMETERS_H
#define RW_SEGMENTATION_INTERNAL_BREP_EDGE_PARAMETERS_H

#include <RW_segmentation/internal/brep/Edge_curve.h>
#include <RW_segmentation/internal/brep/Patch_surface.h>

#include <Geom2dAPI_Interpolate.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomAPI.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_HArray1OfPnt2d.hxx>
#include <gp_Pln.hxx>
#include <gp_Pnt2d.hxx>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace RW_segmentation::internal::brep {

inline gp_Pnt2d kernel_parameters(const Parameters& uv) { return {uv[0], uv[1]}; }

/// The straight way between two pairs of parameters, passed between two parameters of an edge.
inline Handle(Geom2d_Curve) straight_parameters(const Parameters& a, const Parameters& b, double first, double last) {
  TColgp_Array1OfPnt2d poles(1, 2);
  poles(1) = kernel_parameters(a);
  poles(2) = kernel_parameters(b);
  TColStd_Array1OfReal knots(1, 2);
  knots(1) = first;
  knots(2) = last;
  TColStd_Array1OfInteger times(1, 2);
  times.Init(2);
  return new Geom2d_BSplineCurve(poles, knots, times, 1);
}

/// An edge in the parameters of a surface, at the same parameters as in space.
class Edge_parameters {
 public:
  Edge_parameters(const Edge_curve& edge, const Patch_surface& surface, double diagonal)
      : edge_(edge), surface_(surface) {
    if (set_exactly()) return;
    sample();
    if (is_straight(1e-6 * diagonal))
      curve_ = straight_parameters(samples_.front(), samples_.back(), edge.first, edge.last);
    else
      interpolate();
  }

  const Handle(Geom2d_Curve) & curve() const { return curve_; }

  Point on_surface(double parameter) const {
    const gp_Pnt2d uv = curve_->Value(parameter);
    return surface_.at({uv.X(), uv.Y()});
  }

  /// How far the edge in parameters is from that in space.
  double deviation() const {
    double largest = 0;
    const int steps = 2 * number_of_steps();
    for (int i = 0; i <= steps; ++i) {
      const double t = edge_.first + (edge_.last - edge_.first) * i / steps;
      largest = std::max(largest, (on_surface(t) - edge_.at(t)).norm());
    }
    return largest;
  }

 private:
  int number_of_steps() const {
    const Handle(Geom_BSplineCurve) spline = Handle(Geom_BSplineCurve)::DownCast(edge_.curve);
    return spline.IsNull() ? 32 : std::clamp(4 * spline->NbPoles(), 24, 400);
  }

  /// What lines, splines and circles are in a plane is not sampled.
  bool set_exactly() {
    if (!surface_.has_flat_parameters()) return false;
    if (edge_.curve->IsKind(STANDARD_TYPE(Geom_Line))) {
      curve_ = straight_parameters(surface_.parameters(edge_.at(edge_.first)),
                                   surface_.parameters(edge_.at(edge_.last)), edge_.first, edge_.last);
      return true;
    }
    if (const Handle(Geom_BSplineCurve) spline = Handle(Geom_BSplineCurve)::DownCast(edge_.curve); !spline.IsNull()) {
      curve_ = flat_spline(*spline);
      return true;
    }
    const Handle(Geom_Plane) plane = Handle(Geom_Plane)::DownCast(surface_.geometry());
    if (plane.IsNull()) return false;
    curve_ = GeomAPI::To2d(edge_.curve, plane->Pln());
    return !curve_.IsNull();
  }

  Handle(Geom2d_Curve) flat_spline(const Geom_BSplineCurve& spline) const {
    TColgp_Array1OfPnt2d poles(1, spline.NbPoles());
    for (int i = 1; i <= spline.NbPoles(); ++i)
      poles(i) = kernel_parameters(surface_.parameters(point_of(spline.Pole(i))));
    return new Geom2d_BSplineCurve(poles, spline.Knots(), spline.Multiplicities(), spline.Degree());
  }

  void sample() {
    const int steps = number_of_steps();
    for (int i = 0; i <= steps; ++i) {
      const Point p = edge_.at(edge_.first + (edge_.last - edge_.first) * i / steps);
      samples_.push_back(i == 0 ? surface_.parameters(p) : surface_.parameters_near(p, samples_.back()));
      if (i == 1 && surface_.is_tip(edge_.at(edge_.first))) {
        samples_[1] = surface_.parameters(p);
        samples_[0][0] = samples_[1][0];
      }
    }
    if (surface_.is_tip(edge_.at(edge_.last))) samples_.back()[0] = samples_[samples_.size() - 2][0];
  }

  bool is_straight(double tolerance) const {
    const Parameters speeds = surface_.speeds();
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const double share = double(i) / double(samples_.size() - 1);
      const Parameters straight = (1 - share) * samples_.front() + share * samples_.back();
      if (((samples_[i] - straight).array() * speeds.array()).abs().maxCoeff() > tolerance) return false;
    }
    return true;
  }

  /// \throws Standard_Failure if there is no such curve
  void interpolate() {
    const int size = static_cast<int>(samples_.size());
    const Handle(TColgp_HArray1OfPnt2d) values = new TColgp_HArray1OfPnt2d(1, size);
    const Handle(TColStd_HArray1OfReal) parameters = new TColStd_HArray1OfReal(1, size);
    for (int i = 0; i < size; ++i) {
      values->SetValue(i + 1, kernel_parameters(samples_[static_cast<std::size_t>(i)]));
      parameters->SetValue(i + 1, edge_.first + (edge_.last - edge_.first) * i / (size - 1));
    }
    Geom2dAPI_Interpolate interpolation(values, parameters, false, 1e-12);
    interpolation.Perform();
    if (!interpolation.IsDone()) throw Standard_Failure("no edge in the parameters of its surface");
    curve_ = interpolation.Curve();
  }

  const Edge_curve& edge_;
  const Patch_surface& surface_;
  std::vector<Parameters> samples_;
  Handle(Geom2d_Curve) curve_;
};

}  // namespace RW_segmentation::internal::brep

#endif
