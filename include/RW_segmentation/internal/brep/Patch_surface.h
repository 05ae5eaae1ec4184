// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_PATCH_SURFACE_H
#define RW_SEGMENTATION_INTERNAL_BREP_PATCH_SURFACE_H

#include <RW_segmentation/internal/brep/Halfedge_triangles.h>

#include <Eigen/Core>

#include <Geom_Surface.hxx>
#include <gp_Dir.hxx>
#include <gp_Pnt.hxx>

#include <cmath>

namespace RW_segmentation::internal::brep {

constexpr double full_turn = 6.283185307179586;  // in radians

inline gp_Pnt kernel_point(const Point& p) { return {p.x(), p.y(), p.z()}; }
inline gp_Dir kernel_direction(const Point& v) { return {v.x(), v.y(), v.z()}; }
inline Point point_of(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

/// A pair of parameters of a surface.
using Parameters = Eigen::Vector2d;

/// The surface that a face lies on, with a frame in which the face meets neither seam nor pole.
class Patch_surface {
 public:
  Patch_surface() = default;
  Patch_surface(const Patch_surface&) = delete;
  Patch_surface& operator=(const Patch_surface&) = delete;
  virtual ~Patch_surface() = default;

  /// As the kernel knows it.
  virtual Handle(Geom_Surface) geometry() const = 0;

  /// Signed.
  virtual double distance(const Point& p) const = 0;
  /// The gradient of the distance.
  virtual Point normal(const Point& p) const = 0;

  /// Of the foot of a point. Periodic ones lie in the period in which the face does not meet its ends.
  virtual Parameters parameters(const Point& p) const = 0;
  /// Of each parameter; 0 where it has none.
  virtual Parameters periods() const { return {0, 0}; }
  /// How far the surface goes, at most, when a parameter grows by 1.
  virtual Parameters speeds() const { return {1, 1}; }
  /// Whether parameters are coordinates in a plane, so that those of a spline's poles are the poles of its parameters.
  virtual bool has_flat_parameters() const { return false; }
  /// Whether a point is the tip of a cone, where the first parameter tells nothing.
  virtual bool is_tip(const Point&) const { return false; }

  /// The parameters that are closest to others where there is a period.
  Parameters parameters_near(const Point& p, const Parameters& other) const {
    Parameters result = parameters(p);
    for (int i = 0; i < 2; ++i)
      if (periods()[i] > 0) result[i] += periods()[i] * std::round((other[i] - result[i]) / periods()[i]);
    return result;
  }

  Point at(const Parameters& uv) const { return point_of(geometry()->Value(uv[0], uv[1])); }
};

}  // namespace RW_segmentation::internal::brep

#endif
