// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_SURFACE_PLACEMENT_H
#define RW_SEGMENTATION_INTERNAL_BREP_SURFACE_PLACEMENT_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/internal/brep/Halfedge_triangles.h>
#include <RW_segmentation/internal/brep/Placed_surface.h>

#include <Eigen/Geometry>

#include <gp_Ax3.hxx>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace RW_segmentation::internal::brep {

/// A surface in a frame whose seam and poles lie outside a patch; or, if the patch goes round, where to cut it.
struct Surface_placement {
  std::shared_ptr<Placed_surface> surface;  ///< null if there is no such frame
  Point cut = Point::Zero();                ///< normal of a plane through the surface's point; zero if nothing helps
};

/// A gap in some directions round a point.
struct Angular_gap {
  double middle = 0, width = full_turn;
};

/// The widest gap.
/// \param angles in radians, one or more
inline Angular_gap widest_gap(std::vector<double> angles) {
  std::sort(angles.begin(), angles.end());
  Angular_gap gap;
  gap.width = full_turn - angles.back() + angles.front();
  gap.middle = angles.back() + gap.width / 2;
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (angles[i] - angles[i - 1] > gap.width) gap = {(angles[i] + angles[i - 1]) / 2, angles[i] - angles[i - 1]};
  return gap;
}

/// Places the surface of a patch.
class Surface_placing {
 public:
  Surface_placing(const Halfedge_triangles& mesh, const Analytic_surface& surface,
                  const std::vector<std::size_t>& triangles)
      : mesh_(mesh), surface_(surface), triangles_(triangles) {}

  Surface_placement operator()() const {
    if (surface_.type == Surface_type::plane)
      return {std::make_shared<Placed_surface>(surface_, mesh_.centre(triangles_[0])), Point::Zero()};
    const std::vector<Point> samples = samples_about_point();
    Point mean = Point::Zero();
    for (const Point& p : samples) mean += p / double(samples.size());
    Point axis = surface_.direction;
    if (surface_.type == Surface_type::sphere) {
      const double free = axis_without_poles(samples, axis);
      if (free < least_gap_at_pole) {
        const bool has_side = mean.norm() > 1e-9 * surface_.radius;
        return {nullptr, has_side ? mean.unitOrthogonal() : Point(Point::UnitX())};
      }
    }
    return place_about(axis, samples, mean);
  }

 private:
  static constexpr double least_gap_of_sphere = 0.2;  // radians
  static constexpr double least_gap = 0.5;            // radians; a cylinder's patch goes at most 330 degrees round
  static constexpr double least_gap_at_pole = 0.02;   // 1 - cosine of the angle between a pole and the patch
  static constexpr double tip = 1e-4;                 // of the diagonal: so close to the apex is the tip of a cone

  /// Corners and points on sides, so that long triangles do not look like gaps; seen from the surface's point.
  std::vector<Point> samples_about_point() const {
    constexpr int on_side = 4;
    std::vector<Point> samples;
    for (const std::size_t t : triangles_)
      for (std::size_t h = 3 * t; h < 3 * t + 3; ++h)
        for (int i = 0; i < on_side; ++i) {
          const double share = double(i) / on_side;
          samples.push_back((1 - share) * mesh_.point(mesh_.from(h)) + share * mesh_.point(mesh_.to(h)) -
                            surface_.point);
        }
    return samples;
  }

  /// The axis of a sphere whose poles are farthest from the patch, of directions that are spread by the golden angle.
  static double axis_without_poles(const std::vector<Point>& samples, Point& axis) {
    constexpr int directions = 200;
    constexpr double golden_angle = 2.399963;
    double best = -1;
    for (int i = 0; i < directions; ++i) {
      const double z = (i + 0.5) / directions, across = std::sqrt(1 - z * z);
      const Point direction(across * std::cos(golden_angle * i), across * std::sin(golden_angle * i), z);
      double free = 1;
      for (const Point& p : samples) {
        free = std::min(free, 1 - std::abs(direction.dot(p)) / std::max(p.norm(), std::numeric_limits<double>::min()));
        if (free <= best) break;
      }
      if (free <= best) continue;
      best = free;
      axis = direction;
    }
    return best;
  }

  Surface_placement place_about(const Point& axis, const std::vector<Point>& samples, const Point& mean) const {
    const Point x = axis.unitOrthogonal(), y = axis.cross(x);
    std::vector<double> around, tube;
    double height = 0, low = std::numeric_limits<double>::infinity();
    for (const Point& p : samples) {
      const double z = p.dot(axis), off_axis = std::hypot(p.dot(x), p.dot(y));
      height = std::max(height, z);
      low = std::min(low, z);
      if (off_axis > 1e-6 * mesh_.diagonal()) around.push_back(std::atan2(p.dot(y), p.dot(x)));
      tube.push_back(std::atan2(z, off_axis - surface_.radius));
    }
    if (around.empty()) return {};
    const bool is_sphere = surface_.type == Surface_type::sphere;
    const Angular_gap gap = widest_gap(std::move(around));
    if (gap.width < (is_sphere ? least_gap_of_sphere : least_gap)) {
      constexpr double aside = 0.1;  // radians, lest the cut runs along the edges of a regular mesh
      return {nullptr, is_sphere ? Point(mean.cross(axis)) : Point(-std::sin(aside) * x + std::cos(aside) * y)};
    }
    Angular_gap tube_gap;
    if (surface_.type == Surface_type::torus) {
      tube_gap = widest_gap(std::move(tube));
      if (tube_gap.width < least_gap) return {nullptr, axis};
    }
    if (surface_.type == Surface_type::cone && low < -1e-3 * height) return {};
    const double lift = surface_.type == Surface_type::cone ? height : 0;
    const gp_Ax3 frame(kernel_point(surface_.point + lift * axis), kernel_direction(axis),
                       kernel_direction(std::cos(gap.middle) * x + std::sin(gap.middle) * y));
    return {std::make_shared<Placed_surface>(surface_, frame, tube_gap.middle, lift, tip * mesh_.diagonal()),
            Point::Zero()};
  }

  const Halfedge_triangles& mesh_;
  const Analytic_surface& surface_;
  const std::vector<std::size_t>& triangles_;
};

}  // namespace RW_segmentation::internal::brep

#endif
