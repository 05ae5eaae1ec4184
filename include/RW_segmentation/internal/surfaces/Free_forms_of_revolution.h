// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_FREE_FORMS_OF_REVOLUTION_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_FREE_FORMS_OF_REVOLUTION_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/surfaces/Analytic_regions.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Takes back regions that are strips of free forms of revolution, such as the head of a screw or a vase.
///
/// Kernels mesh these in circles round their axis. Any two circles round an axis lie on a cone and on a sphere, any three on
/// a torus, whatever the profile is: one such region tells nothing. Many that go on smoothly from one to the next are a free
/// form, which the faces among them that no surface explains are part of.
///
/// What comments tell of other values of a number was measured with `benchmark_engineering --suffix _t` on two sets of CAD
/// solids: the 28 have the same overlap with all of them, the 118 one of .9693 with the numbers as they are.
class Free_forms_of_revolution {
 public:
  using Index = Dual_mesh::Index;

  /// Keeps references to all.
  Free_forms_of_revolution(const Dual_mesh& mesh, const Surface_tolerance& tolerance, Analytic_regions& regions)
      : mesh_(mesh), tolerance_(tolerance), regions_(regions), faces_(regions.faces()) {}

  void take_back() {
    for (const Axis& axis : axes()) {
      const std::vector<char> is_strip = strips_about(axis);
      if (std::count(is_strip.begin(), is_strip.end(), true) < fewest_strips) continue;
      if (angles_.empty()) angles_ = crease_angles(mesh_, tolerance_);
      take_back(is_strip);
    }
  }

 private:
  static constexpr std::size_t none = Analytic_regions::none;
  static constexpr std::ptrdiff_t fewest_strips = 5;  // at 3, .9693 as well; at 8, .9686

  struct Axis {
    Eigen::Vector3d point, direction;

    double distance(const Eigen::Vector3d& p) const { return (p - point).cross(direction).norm(); }
  };

  /// The different ones of all regions.
  std::vector<Axis> axes() const {
    std::vector<Axis> axes;
    for (std::size_t r = 0; r < faces_.size(); ++r) {
      const Analytic_surface& surface = regions_.surfaces[r];
      const bool has_axis = surface.type == Surface_type::cylinder || surface.type == Surface_type::cone ||
                            surface.type == Surface_type::torus;
      if (has_axis && !faces_[r].empty() &&
          std::none_of(axes.begin(), axes.end(), [&](const Axis& axis) { return is_about(surface, axis); }))
        axes.push_back({surface.point, surface.direction});
    }
    return axes;
  }

  static bool is_about(const Analytic_surface& surface, const Axis& axis) {
    // In parts of the diagonal, in radians: as short strips tell it. At a tenth of both .9702, at ten times .9693.
    constexpr double farthest = 1e-3, widest = 2e-3;
    if (axis.distance(surface.point) > farthest) return false;
    return surface.type == Surface_type::sphere || surface.direction.cross(axis.direction).norm() <= widest;
  }

  /// By region: whether it lies on a surface about the axis that its circles would lie on in any case.
  std::vector<char> strips_about(const Axis& axis) const {
    std::vector<char> is_strip;
    for (std::size_t r = 0; r < faces_.size(); ++r) {
      const std::size_t most = most_strips(regions_.surfaces[r].type);
      is_strip.push_back(most > 0 && !faces_[r].empty() && is_about(regions_.surfaces[r], axis) &&
                         number_of_strips(faces_[r], axis) <= most);
    }
    return is_strip;
  }

  /// Of a region that tells nothing, one more than a surface of its type has in any case: flat profiles look like that.
  static std::size_t most_strips(Surface_type type) {
    if (type == Surface_type::cone) return 2;
    return type == Surface_type::sphere || type == Surface_type::torus ? 3 : 0;
  }

  /// Of the strips between two circles that most of the area is in, without stray triangles.
  std::size_t number_of_strips(const std::vector<Index>& faces, const Axis& axis) const {
    constexpr double most_of_area = 0.8;      // at .65, .9690; at .95, .9683
    constexpr std::size_t most_circles = 64;  // more are vertices all over the surface
    std::vector<Eigen::Vector2d> circles;
    std::map<std::pair<std::size_t, std::size_t>, double> areas;
    double whole = 0;
    for (const Index f : faces) {
      std::pair<std::size_t, std::size_t> first_and_last(most_circles, 0);
      for (const Index v : mesh_.corners(f)) {
        const std::size_t circle = circle_of(mesh_.point(v), axis, circles);
        first_and_last = {std::min(first_and_last.first, circle), std::max(first_and_last.second, circle)};
      }
      if (circles.size() > most_circles) return most_circles;
      areas[first_and_last] += mesh_.area(f);
      whole += mesh_.area(f);
    }
    std::vector<double> largest;
    for (const auto& [strip, area] : areas) largest.push_back(area);
    std::sort(largest.begin(), largest.end(), std::greater<>());
    std::size_t strips = 0;
    for (double area = 0; strips < largest.size() && area < most_of_area * whole; ++strips) area += largest[strips];
    return strips;
  }

  /// The circle that a point is on, a new one if it is on none of those given.
  std::size_t circle_of(const Eigen::Vector3d& p, const Axis& axis, std::vector<Eigen::Vector2d>& circles) const {
    const Eigen::Vector2d place(axis.distance(p), (p - axis.point).dot(axis.direction));
    const auto found = std::find_if(circles.begin(), circles.end(), [&](const Eigen::Vector2d& circle) {
      return (circle - place).norm() <= tolerance_.largest_distance();
    });
    if (found != circles.end()) return static_cast<std::size_t>(found - circles.begin());
    circles.push_back(place);
    return circles.size() - 1;
  }

  /// Takes back the strips that go on smoothly in enough others, over faces of no region as well.
  void take_back(const std::vector<char>& is_strip) {
    const auto may_be_of_one = [&](Index f) {
      return regions_.region_of_face[f] == none || is_strip[regions_.region_of_face[f]];
    };
    std::vector<char> is_reached(mesh_.number_of_faces(), false);
    for (Index first = 0; first < mesh_.number_of_faces(); ++first) {
      if (is_reached[first] || !may_be_of_one(first)) continue;
      is_reached[first] = true;
      std::vector<Index> form = {first};
      std::set<std::size_t> strips;
      for (std::size_t i = 0; i < form.size(); ++i) {
        if (const std::size_t region = regions_.region_of_face[form[i]]; region != none) strips.insert(region);
        for (const auto& [g, e] : mesh_.graph().neighbours(form[i]))
          if (!is_reached[g] && may_be_of_one(g) && goes_on_over(e)) {
            is_reached[g] = true;
            form.push_back(g);
          }
      }
      if (static_cast<std::ptrdiff_t>(strips.size()) >= fewest_strips)
        for (const Index f : form) regions_.region_of_face[f] = none;
    }
  }

  bool goes_on_over(Index edge) const {
    return !mesh_.is_wall(edge) && angles_[edge] < tolerance_.smooth_angle(mesh_.graph().faces_of(edge));
  }

  const Dual_mesh& mesh_;
  const Surface_tolerance& tolerance_;
  Analytic_regions& regions_;
  std::vector<double> angles_;             // of the edges, once there are enough strips
  std::vector<std::vector<Index>> faces_;  // of the regions
};

}  // namespace RW_segmentation::internal

#endif
