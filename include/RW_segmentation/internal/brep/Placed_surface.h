// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_PLACED_SURFACE_H
#define RW_SEGMENTATION_INTERNAL_BREP_PLACED_SURFACE_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/internal/brep/Patch_surface.h>

#include <Eigen/Geometry>

#include <ElSLib.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <gp_Ax3.hxx>

#include <algorithm>
#include <cmath>

namespace RW_segmentation::internal::brep {

/// A plane, sphere, cylinder, cone or torus in a frame.
class Placed_surface : public Patch_surface {
 public:
  /// \param frame its main direction is the axis; the seam lies in the direction of x
  /// \param first_v where the period of a torus's second parameter begins
  /// \param height of the frame's origin over the apex of a cone
  /// \param tip_radius within which a point is the tip of a cone
  Placed_surface(const Analytic_surface& surface, const gp_Ax3& frame, double first_v, double height, double tip_radius)
      : surface_(surface), frame_(frame), first_v_(first_v), height_(height), tip_radius_(tip_radius) {
    geometry_ = geometry_in_frame();
  }

  /// A plane.
  Placed_surface(const Analytic_surface& plane, const Point& origin)
      : Placed_surface(plane, gp_Ax3(kernel_point(origin), kernel_direction(plane.direction)), 0, 0, 0) {}

  Handle(Geom_Surface) geometry() const override { return geometry_; }
  double distance(const Point& p) const override { return surface_.signed_distance(p); }
  Point normal(const Point& p) const override { return surface_.normal(p); }

  Parameters parameters(const Point& p) const override {
    double u = 0, v = 0;
    const gp_Pnt q = kernel_point(p);
    switch (surface_.type) {
      case Surface_type::sphere:
        ElSLib::SphereParameters(frame_, surface_.radius, q, u, v);
        break;
      case Surface_type::cylinder:
        ElSLib::CylinderParameters(frame_, surface_.radius, q, u, v);
        break;
      case Surface_type::cone:
        ElSLib::ConeParameters(frame_, height_ * std::tan(surface_.half_angle), surface_.half_angle, q, u, v);
        break;
      case Surface_type::torus:
        ElSLib::TorusParameters(frame_, surface_.radius, surface_.tube_radius, q, u, v);
        break;
      case Surface_type::plane:
      case Surface_type::free_form:
        ElSLib::PlaneParameters(frame_, q, u, v);
        return {u, v};
    }
    u -= full_turn * std::floor(u / full_turn);
    if (surface_.type == Surface_type::torus) v -= full_turn * std::floor((v - first_v_) / full_turn);
    return {u, v};
  }

  Parameters periods() const override {
    if (surface_.type == Surface_type::plane) return {0, 0};
    return {full_turn, surface_.type == Surface_type::torus ? full_turn : 0};
  }

  Parameters speeds() const override {
    switch (surface_.type) {
      case Surface_type::sphere:
        return {surface_.radius, surface_.radius};
      case Surface_type::cylinder:
        return {surface_.radius, 1};
      case Surface_type::cone:
        return {2 * height_ * std::tan(surface_.half_angle), 1};
      case Surface_type::torus:
        return {surface_.radius + surface_.tube_radius, surface_.tube_radius};
      default:
        return {1, 1};
    }
  }

  bool has_flat_parameters() const override { return surface_.type == Surface_type::plane; }
  bool is_tip(const Point& p) const override {
    return surface_.type == Surface_type::cone && (p - surface_.point).norm() < tip_radius_;
  }
  /// The second parameter of the tip of a cone.
  double tip_parameter() const { return -height_ / std::cos(surface_.half_angle); }

  Surface_type type() const { return surface_.type; }

 private:
  Handle(Geom_Surface) geometry_in_frame() const {
    switch (surface_.type) {
      case Surface_type::sphere:
        return new Geom_SphericalSurface(frame_, surface_.radius);
      case Surface_type::cylinder:
        return new Geom_CylindricalSurface(frame_, surface_.radius);
      case Surface_type::cone:
        return new Geom_ConicalSurface(frame_, surface_.half_angle, height_ * std::tan(surface_.half_angle));
      case Surface_type::torus:
        return new Geom_ToroidalSurface(frame_, surface_.radius, surface_.tube_radius);
      case Surface_type::plane:
      case Surface_type::free_form:
        break;
    }
    return new Geom_Plane(frame_);
  }

  Analytic_surface surface_;
  gp_Ax3 frame_;
  double first_v_, height_, tip_radius_;
  Handle(Geom_Surface) geometry_;
};

}  // namespace RW_segmentation::internal::brep

#endif
