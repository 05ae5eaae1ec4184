// SPDX-License-Identifier: MIT

#ifndef BROWSER_ENGINE_GENERATED_MODELS_H
#define BROWSER_ENGINE_GENERATED_MODELS_H

// Meshes to try the page on without a file: limbs that flow into one another, and a turned part of a machine.

#include "../../mesh_files/Polygon_soup.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace browser_engine {

using Position = Eigen::Vector3d;
using Signed_distance = std::function<double(const Position&)>;

/// A ball that moves along a line and changes its radius.
struct Limb {
  Position from, to;
  double from_radius, to_radius;

  double distance(const Position& p) const {
    const Position axis = to - from;
    const double along = std::clamp((p - from).dot(axis) / axis.squaredNorm(), 0., 1.);
    return (p - from - along * axis).norm() - (from_radius + along * (to_radius - from_radius));
  }
};

/// The distance from the union of limbs, with fillets where they meet.
inline Signed_distance union_of(std::vector<Limb> limbs, double fillet) {
  return [limbs = std::move(limbs), fillet](const Position& p) {
    double distance = std::numeric_limits<double>::max();
    for (const Limb& limb : limbs) {
      const double next = limb.distance(p), overlap = std::max(0., 1 - std::abs(distance - next) / fillet);
      distance = std::min(distance, next) - fillet * overlap * overlap / 4;
    }
    return distance;
  };
}

/// The surface where a function is 0, by surface nets: a vertex in each cell of a grid that the surface crosses, and two
/// triangles for each edge of the grid.
class Surface_nets {
 public:
  /// The function is positive on the border of the cube from (-1, -1, -1) to (1, 1, 1), and changes by at most `steepest`
  /// times the way.
  Surface_nets(const Signed_distance& distance, std::size_t cells)
      : distance_(distance), points_(cells + 1), values_(points_ * points_ * points_) {
    for (std::size_t z = 0; z < points_; z += block_size)
      for (std::size_t y = 0; y < points_; y += block_size)
        for (std::size_t x = 0; x < points_; x += block_size) evaluate_block({x, y, z});
  }

  mesh_files::Polygon_soup mesh() {
    for (std::size_t i = 0; i < values_.size(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        if (grid_point(i)[static_cast<std::size_t>(axis)] + 1 < points_) add_faces_around(i, axis);
    return std::move(soup_);
  }

 private:
  using Grid_point = std::array<std::size_t, 3>;

  Grid_point grid_point(std::size_t index) const {
    return {index % points_, index / points_ % points_, index / points_ / points_};
  }

  /// Where the surface crosses no edge of the grid at a block of points, one value tells their sign, and no more is asked of
  /// them.
  void evaluate_block(const Grid_point& lowest) {
    Grid_point highest;
    for (std::size_t i = 0; i < 3; ++i) highest[i] = std::min(lowest[i] + block_size, points_) - 1;
    const Position low = position(lowest), high = position(highest);
    const double in_the_middle = distance_((low + high) / 2);
    const double edge = 2 / static_cast<double>(points_ - 1);
    const bool is_far = std::abs(in_the_middle) > steepest * ((high - low).norm() / 2 + edge);
    for (std::size_t z = lowest[2]; z <= highest[2]; ++z)
      for (std::size_t y = lowest[1]; y <= highest[1]; ++y)
        for (std::size_t x = lowest[0]; x <= highest[0]; ++x)
          values_[x + y * step(1) + z * step(2)] = is_far ? in_the_middle : distance_(position({x, y, z}));
  }

  std::size_t step(int axis) const { return axis == 0 ? 1 : axis == 1 ? points_ : points_ * points_; }
  Position position(const Grid_point& p) const {
    const auto on_axis = [&](int i) {
      return 2 * static_cast<double>(p[static_cast<std::size_t>(i)]) / static_cast<double>(points_ - 1) - 1;
    };
    return {on_axis(0), on_axis(1), on_axis(2)};
  }

  /// Two triangles across the edge of the grid from a point along an axis, if the surface crosses it.
  void add_faces_around(std::size_t point, int axis) {
    const bool is_outward = values_[point] < 0;
    if (is_outward == (values_[point + step(axis)] < 0)) return;
    const std::size_t u = step((axis + 1) % 3), v = step((axis + 2) % 3);
    std::array corner = {vertex(point - u - v), vertex(point - v), vertex(point), vertex(point - u)};
    if (!is_outward) std::swap(corner[1], corner[3]);
    // The shorter diagonal.
    const auto length = [&](std::size_t a, std::size_t b) {
      return CGAL::squared_distance(soup_.points[corner[a]], soup_.points[corner[b]]);
    };
    const std::size_t first = length(0, 2) <= length(1, 3) ? 0 : 1;
    for (const std::size_t middle : {first + 1, first + 3}) {
      for (const std::size_t i : {middle + 3, middle, middle + 1}) soup_.corners.push_back(corner[i % 4]);
      soup_.end_face();
    }
  }

  /// The vertex of the cell whose lowest point is given, in the middle of where the surface crosses the cell's edges and
  /// then moved onto the surface.
  mesh_files::Polygon_soup::Index vertex(std::size_t cell) {
    const auto [found, is_new] =
        vertex_of_cell_.emplace(cell, static_cast<mesh_files::Polygon_soup::Index>(soup_.points.size()));
    if (!is_new) return found->second;
    Position sum = Position::Zero();
    int crossings = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (const std::size_t side : {std::size_t(0), step((axis + 1) % 3)})
        for (const std::size_t other : {std::size_t(0), step((axis + 2) % 3)}) {
          const std::size_t from = cell + side + other, to = from + step(axis);
          if ((values_[from] < 0) == (values_[to] < 0)) continue;
          const double share = values_[from] / (values_[from] - values_[to]);
          sum += (1 - share) * position(grid_point(from)) + share * position(grid_point(to));
          ++crossings;
        }
    Position p = sum / crossings;
    for (int i = 0; i < 3; ++i) p -= distance_(p) * gradient(p);
    soup_.points.emplace_back(p.x(), p.y(), p.z());
    return found->second;
  }

  Position gradient(const Position& p) const {
    constexpr double step = 1e-5;
    Position result;
    for (int i = 0; i < 3; ++i)
      result[i] = (distance_(p + step * Position::Unit(i)) - distance_(p - step * Position::Unit(i))) / (2 * step);
    return result.squaredNorm() > 0 ? Position(result / result.squaredNorm()) : result;
  }

  static constexpr double steepest = 1.1;       // radii of limbs change by at most .22 a length, which makes it 1.03
  static constexpr std::size_t block_size = 4;  // points along each axis: the fastest of 2 to 16

  const Signed_distance& distance_;
  std::size_t points_;  // along each axis
  std::vector<double> values_;
  std::unordered_map<std::size_t, mesh_files::Polygon_soup::Index> vertex_of_cell_;
  mesh_files::Polygon_soup soup_;
};

inline mesh_files::Polygon_soup surface_of(const Signed_distance& distance, std::size_t cells) {
  return Surface_nets(distance, cells).mesh();
}

inline mesh_files::Polygon_soup hand() {
  std::vector<Limb> limbs = {{{-.10, -.85, 0}, {-.06, -.45, 0}, .15, .17},    // wrist
                             {{-.06, -.40, 0}, {-.18, -.02, .02}, .19, .14},  // palm, four times
                             {{-.06, -.40, 0}, {-.05, .00, .03}, .19, .14},
                             {{-.06, -.40, 0}, {.08, -.02, .02}, .19, .14},
                             {{-.06, -.40, 0}, {.18, -.08, 0}, .19, .12}};
  const auto add_finger = [&](const Position& from, const Position& middle, const Position& to, double radius) {
    limbs.push_back({from, middle, radius, .92 * radius});
    limbs.push_back({middle, to, .92 * radius, .8 * radius});
  };
  add_finger({-.22, .02, .02}, {-.30, .34, .03}, {-.34, .62, .00}, .085);
  add_finger({-.07, .08, .03}, {-.09, .44, .05}, {-.10, .76, .01}, .088);
  add_finger({.09, .06, .02}, {.13, .40, .04}, {.15, .68, .00}, .085);
  add_finger({.23, -.04, .00}, {.32, .22, .01}, {.37, .44, -.02}, .075);
  add_finger({-.18, -.42, .04}, {-.44, -.22, .10}, {-.56, .04, .10}, .095);
  return surface_of(union_of(std::move(limbs), .07), 120);
}

inline mesh_files::Polygon_soup quadruped() {
  std::vector<Limb> limbs = {{{-.45, 0, 0}, {.35, .02, 0}, .21, .24},       // trunk
                             {{.42, .08, 0}, {.62, .42, 0}, .14, .10},      // neck
                             {{.62, .44, 0}, {.84, .36, 0}, .12, .07},      // head
                             {{-.58, .06, 0}, {-.88, .26, 0}, .06, .035}};  // tail
  for (const double side : {-1., 1.}) {
    limbs.push_back({{.34, -.08, .15 * side}, {.38, -.75, .19 * side}, .10, .065});
    limbs.push_back({{-.42, -.08, .14 * side}, {-.46, -.75, .19 * side}, .11, .065});
    limbs.push_back({{.58, .52, .06 * side}, {.54, .66, .10 * side}, .045, .025});  // ears
  }
  return surface_of(union_of(std::move(limbs), .08), 110);
}

/// A shaft with steps, a groove, chamfers and a fillet, turned about the x axis.
inline mesh_files::Polygon_soup turned_shaft() {
  std::vector<Eigen::Vector2d> profile;  // position along the axis, radius
  const auto line_to = [&](double x, double radius, int pieces) {
    const Eigen::Vector2d from = profile.back(), to(x, radius);
    for (int i = 1; i <= pieces; ++i) profile.emplace_back(from + (to - from) * i / pieces);
  };
  profile.emplace_back(-.9, .05);
  line_to(-.9, .20, 5);
  line_to(-.86, .24, 2);
  line_to(-.35, .24, 16);
  line_to(-.35, .40, 5);
  line_to(-.12, .40, 7);
  line_to(-.12, .34, 2);
  line_to(-.04, .34, 3);
  line_to(-.04, .40, 2);
  line_to(.16, .40, 7);
  constexpr int fillet_pieces = 10;
  line_to(.16, .30, 3);
  for (int i = 1; i <= fillet_pieces; ++i) {
    const double angle = i * 1.5707963267948966 / fillet_pieces;
    profile.emplace_back(.16 + .12 * (1 - std::cos(angle)), .30 - .12 * std::sin(angle));
  }
  line_to(.85, .18, 18);
  line_to(.9, .13, 2);
  line_to(.9, .05, 3);

  constexpr std::size_t around = 96;
  mesh_files::Polygon_soup soup;
  for (const Eigen::Vector2d& p : profile)
    for (std::size_t i = 0; i < around; ++i) {
      const double angle = 6.283185307179586 * static_cast<double>(i) / around;
      soup.points.emplace_back(p.x(), p.y() * std::cos(angle), p.y() * std::sin(angle));
    }
  const auto corner = [&](std::size_t ring, std::size_t i) {
    return static_cast<mesh_files::Polygon_soup::Index>(ring % profile.size() * around + i % around);
  };
  // From the last ring back to the first: the bore.
  for (std::size_t ring = 0; ring < profile.size(); ++ring)
    for (std::size_t i = 0; i < around; ++i)
      for (const auto& triangle : {std::array{corner(ring, i), corner(ring, i + 1), corner(ring + 1, i + 1)},
                                   std::array{corner(ring, i), corner(ring + 1, i + 1), corner(ring + 1, i)}}) {
        soup.corners.insert(soup.corners.end(), triangle.begin(), triangle.end());
        soup.end_face();
      }
  return soup;
}

/// A mesh that is made when asked for.
struct Model {
  std::string name;
  mesh_files::Polygon_soup (*generate)();
};

inline const std::vector<Model>& models() {
  static const std::vector<Model> all = {{"hand", hand}, {"quadruped", quadruped}, {"turned shaft", turned_shaft}};
  return all;
}

/// \throws std::invalid_argument if there is no model of that name
inline mesh_files::Polygon_soup generated(const std::string& name) {
  for (const Model& model : models())
    if (model.name == name) return model.generate();
  throw std::invalid_argument("there is no model " + name);
}

}  // namespace browser_engine

#endif
