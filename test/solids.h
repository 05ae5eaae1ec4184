// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_SOLIDS_H
#define RW_SEGMENTATION_TEST_SOLIDS_H

// Triangulated solids as CAD systems make them, with the analytic surface of each triangle.
//
// Even meshes have triangles of about one size. Those of a CAD kernel have vertices only where the shape needs them:
// two triangles for a rectangle, fans and needles in planes with holes, strips from end to end on cylinders.
//
// All solids are closed, oriented outward, and have a diagonal between 3 and 5.

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace solids {

using Point = Eigen::Vector3d;

constexpr double half_turn = 3.14159265358979323846;  // in radians

// ---- Solids ----

enum class Type { plane, sphere, cylinder, cone, torus };

/// An unbounded analytic surface.
struct Surface {
  Type type = Type::plane;
  Point point = Point::Zero();       ///< of a plane or an axis; the centre of a sphere or torus, the apex of a cone
  Point direction = Point::UnitZ();  ///< unit normal or axis; that of a cone points into it
  double radius = 0;                 ///< of a torus: of the circle that the centre of the tube runs on
  double tube_radius = 0, half_angle = 0;  ///< of a torus, of a cone

  /// Distance of a point from the surface.
  double distance(const Point& p) const {
    const Point q = p - point;
    const double height = q.dot(direction), off_axis = (q - height * direction).norm();
    switch (type) {
      case Type::plane:
        return std::abs(height);
      case Type::sphere:
        return std::abs(q.norm() - radius);
      case Type::cylinder:
        return std::abs(off_axis - radius);
      case Type::cone:
        return std::abs(off_axis * std::cos(half_angle) - height * std::sin(half_angle));
      case Type::torus:
        break;
    }
    return std::abs(std::hypot(off_axis - radius, height) - tube_radius);
  }
};

inline Surface plane(const Point& point, const Point& normal) { return {Type::plane, point, normal, 0, 0, 0}; }
inline Surface sphere(const Point& centre, double radius) {
  return {Type::sphere, centre, Point::UnitZ(), radius, 0, 0};
}
inline Surface cylinder(const Point& point, const Point& axis, double radius) {
  return {Type::cylinder, point, axis, radius, 0, 0};
}
inline Surface cone(const Point& apex, const Point& axis, double half_angle) {
  return {Type::cone, apex, axis, 0, 0, half_angle};
}
inline Surface torus(const Point& centre, const Point& axis, double radius, double tube_radius) {
  return {Type::torus, centre, axis, radius, tube_radius, 0};
}

struct Solid {
  std::string name;
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces;  ///< triangles, counterclockwise seen from outside
  std::vector<std::size_t> label;               ///< of each face: the number of its surface
  std::vector<Surface> surfaces;

  double diagonal() const {
    Eigen::AlignedBox3d box;
    for (const Point& p : points) box.extend(p);
    return box.diagonal().norm();
  }
};

/// Every point displaced by a normal deviate in each coordinate, whose standard deviation is that many percent of the
/// diagonal.
inline Solid with_noise(Solid solid, double percent, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise;
  const double deviation = percent / 100 * solid.diagonal();
  for (Point& p : solid.points)
    for (double& x : p) x += deviation * noise(random);
  return solid;
}

/// Every coordinate rounded to a multiple of that many percent of the diagonal.
inline Solid with_rounded_coordinates(Solid solid, double percent) {
  const double step = percent / 100 * solid.diagonal();
  for (Point& p : solid.points)
    for (double& x : p) x = step * std::round(x / step);
  return solid;
}

// ---- Scans ----

using Edge_ends = std::array<std::size_t, 2>;

inline Edge_ends edge_between(std::size_t a, std::size_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Halves the edges that a predicate of their midpoint holds for, and cuts the triangles accordingly.
template <class Predicate>
Solid halved_where(const Solid& solid, const Predicate& is_halved) {
  Solid result = solid;
  result.faces.clear();
  result.label.clear();
  std::map<Edge_ends, std::size_t> middle;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    std::vector<std::size_t> outline, middles;  // corners and middles in turn; only what is there
    std::array<bool, 3> has_middle = {};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = solid.faces[f][k], b = solid.faces[f][(k + 1) % 3];
      outline.push_back(a);
      const Point point = (solid.points[a] + solid.points[b]) / 2;
      has_middle[k] = is_halved(point);
      if (!has_middle[k]) continue;
      const auto [place, is_new] = middle.try_emplace(edge_between(a, b), result.points.size());
      if (is_new) result.points.push_back(point);
      outline.push_back(place->second);
      middles.push_back(place->second);
    }
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      result.faces.push_back({a, b, c});
      result.label.push_back(solid.label[f]);
    };
    if (middles.size() == 3) {
      for (std::size_t k = 0; k < 3; ++k) add(outline[2 * k], middles[k], middles[(k + 2) % 3]);
      add(middles[0], middles[1], middles[2]);
    } else if (middles.empty()) {
      add(outline[0], outline[1], outline[2]);
    } else {  // a fan from a middle
      const auto first =
          static_cast<std::size_t>(std::find(outline.begin(), outline.end(), middles[0]) - outline.begin());
      for (std::size_t k = 1; k + 1 < outline.size(); ++k)
        add(middles[0], outline[(first + k) % outline.size()], outline[(first + k + 1) % outline.size()]);
    }
  }
  return result;
}

/// Moves each point half way to the mean of its neighbours, so many times.
inline Solid smoothed(Solid solid, int times) {
  std::vector<std::vector<std::size_t>> neighbours(solid.points.size());
  for (const auto& face : solid.faces)
    for (std::size_t k = 0; k < 3; ++k) neighbours[face[k]].push_back(face[(k + 1) % 3]);
  for (int time = 0; time < times; ++time) {
    const std::vector<Point> before = solid.points;
    for (std::size_t v = 0; v < before.size(); ++v) {
      if (neighbours[v].empty()) continue;
      Point sum = Point::Zero();
      for (const std::size_t w : neighbours[v]) sum += before[w];
      solid.points[v] = (before[v] + sum / static_cast<double>(neighbours[v].size())) / 2;
    }
  }
  return solid;
}

/// Leaves out the faces that a predicate of their number holds for.
template <class Predicate>
Solid without_faces(Solid solid, const Predicate& is_left_out) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    if (is_left_out(f)) continue;
    solid.faces[kept] = solid.faces[f];
    solid.label[kept++] = solid.label[f];
  }
  solid.faces.resize(kept);
  solid.label.resize(kept);
  return solid;
}

/// Which faces have an edge where the solid turns by more than an angle, in radians.
inline std::vector<bool> faces_at_sharp_edges(const Solid& solid, double angle) {
  const auto normal = [&](std::size_t f) {
    const auto& face = solid.faces[f];
    const Point& a = solid.points[face[0]];
    return Point((solid.points[face[1]] - a).cross(solid.points[face[2]] - a).normalized());
  };
  std::map<Edge_ends, std::vector<std::size_t>> faces_of_edge;
  for (std::size_t f = 0; f < solid.faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      faces_of_edge[edge_between(solid.faces[f][k], solid.faces[f][(k + 1) % 3])].push_back(f);
  std::vector<bool> is_sharp(solid.faces.size(), false);
  for (const auto& [edge, faces] : faces_of_edge)
    if (faces.size() == 2 && normal(faces[0]).dot(normal(faces[1])) < std::cos(angle))
      for (const std::size_t f : faces) is_sharp[f] = true;
  return is_sharp;
}

/// A solid as a scanner sees it: one half meshed twice as finely, every point displaced as by `with_noise()` and smoothed,
/// which rounds what is sharp; five holes of a twentieth of the diagonal, and a fifth of the triangles missing along sharp
/// edges.
inline Solid scanned(const Solid& solid, double percent, unsigned seed = 1) {
  constexpr int smoothing_steps = 2, holes = 5;
  constexpr double radius_of_holes = 0.025;       // of the diagonal
  constexpr double sharp = half_turn * 40 / 180;  // radians
  constexpr double missing = 0.2;                 // of the faces at sharp edges
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> chance;
  const Point centre = std::accumulate(solid.points.begin(), solid.points.end(), Point(Point::Zero())) /
                       static_cast<double>(solid.points.size());
  const Point side = Point(chance(random) - 0.5, chance(random) - 0.5, chance(random) - 0.5).normalized();
  const Solid uneven = halved_where(solid, [&](const Point& p) { return (p - centre).dot(side) > 0; });
  std::vector<Point> hole;
  for (int i = 0; i < holes; ++i) hole.push_back(uneven.points[random() % uneven.points.size()]);
  const std::vector<bool> is_sharp = faces_at_sharp_edges(uneven, sharp);
  const double radius = radius_of_holes * uneven.diagonal();
  return without_faces(smoothed(with_noise(uneven, percent, seed), smoothing_steps), [&](std::size_t f) {
    if (is_sharp[f] && chance(random) < missing) return true;
    return std::any_of(uneven.faces[f].begin(), uneven.faces[f].end(), [&](std::size_t v) {
      return std::any_of(hole.begin(), hole.end(),
                         [&](const Point& p) { return (uneven.points[v] - p).norm() < radius; });
    });
  });
}

// ---- Meshing ----

/// How finely curves are divided: evenly, or as by a CAD kernel.
struct Meshing {
  bool is_even;
  double step;  ///< length of an edge, or the angle in which an arc turns along an edge

  std::size_t along_line(double length) const { return is_even ? at_least_one(length / step) : 1; }
  std::size_t along_arc(double angle, double radius) const {
    return at_least_one(is_even ? angle * radius / step : angle / step);
  }
  /// A multiple of eight, so that a disc can be meshed evenly.
  std::size_t around(double radius) const { return 8 * along_arc(half_turn / 4, radius); }

 private:
  static std::size_t at_least_one(double ratio) {
    return static_cast<std::size_t>(std::max(1., std::ceil(ratio - 1e-9)));
  }
};

inline Meshing even(double edge_length) { return {true, edge_length}; }
inline Meshing by_kernel(double angle = half_turn / 12) { return {false, angle}; }

/// Puts patches together; points that coincide become one.
class Builder {
 public:
  explicit Builder(std::string name) { solid_.name = std::move(name); }

  std::size_t add(const Surface& surface) {
    solid_.surfaces.push_back(surface);
    return solid_.surfaces.size() - 1;
  }

  /// Leaves out a triangle with coinciding corners.
  void triangle(std::size_t label, const Point& a, const Point& b, const Point& c) {
    const std::size_t i = vertex(a), j = vertex(b), k = vertex(c);
    if (i == j || j == k || k == i) return;
    solid_.faces.push_back({i, j, k});
    solid_.label.push_back(label);
  }

  void quadrangle(std::size_t label, const Point& a, const Point& b, const Point& c, const Point& d) {
    const bool is_first_shorter = (a - c).norm() <= (b - d).norm() * (1 + 1e-9);
    triangle(label, a, b, is_first_shorter ? c : d);
    triangle(label, is_first_shorter ? a : b, c, d);
  }

  /// The image of the unit square, divided `n` by `m`. Seen from outside, the second parameter turns left from the
  /// first.
  void grid(std::size_t label, std::size_t n, std::size_t m, const std::function<Point(double, double)>& f) {
    const auto at = [&](std::size_t i, std::size_t j) {
      return f(static_cast<double>(i) / static_cast<double>(n), static_cast<double>(j) / static_cast<double>(m));
    };
    for (std::size_t j = 0; j < m; ++j)
      for (std::size_t i = 0; i < n; ++i) quadrangle(label, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }

  /// The horizontal strip between two polylines of any numbers of points that both run counterclockwise about a
  /// centre, `left` on the left of `right`; needles and fans. The apex of a triangle is about opposite to its base.
  void strip(std::size_t label, const Point& centre, const std::vector<Point>& left, const std::vector<Point>& right) {
    // From the direction of the strip's begin to the middle of each edge.
    const auto angles = [&](const std::vector<Point>& polyline) {
      std::vector<double> angles;
      double angle = angle_between(right[0] - centre, polyline[0] - centre);
      for (std::size_t i = 0; i + 1 < polyline.size(); ++i) {
        const double step = angle_between(polyline[i] - centre, polyline[i + 1] - centre);
        angles.push_back(angle + step / 2);
        angle += step;
      }
      return angles;
    };
    const std::vector<double> left_angle = angles(left), right_angle = angles(right);
    for (std::size_t i = 0, j = 0; i < left_angle.size() || j < right_angle.size();) {
      const bool on_left = j == right_angle.size() || (i < left_angle.size() && left_angle[i] < right_angle[j]);
      triangle(label, left[i], right[j], on_left ? left[i + 1] : right[j + 1]);
      ++(on_left ? i : j);
    }
  }

  /// A convex polygon as a fan about its first corner.
  void fan(std::size_t label, const std::vector<Point>& polygon) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) triangle(label, polygon[0], polygon[i], polygon[i + 1]);
  }

  Solid solid() && { return std::move(solid_); }

 private:
  /// Counterclockwise, seen from above.
  static double angle_between(const Point& a, const Point& b) {
    return std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
  }

  std::size_t vertex(const Point& p) {
    constexpr double cells = 1e7 / half_turn;  // a unit; irrational, lest a coordinate lies between two cells
    std::array<long long, 3> cell{};
    for (int i = 0; i < 3; ++i) cell[static_cast<std::size_t>(i)] = std::llround(p[i] * cells);
    const auto [found, is_new] = number_.emplace(cell, solid_.points.size());
    if (is_new) solid_.points.push_back(p);
    return found->second;
  }

  Solid solid_;
  std::map<std::array<long long, 3>, std::size_t> number_;
};

using Curve = std::function<Point(double)>;  // of a parameter from 0 to 1

inline Curve line(const Point& a, const Point& b) {
  return [=](double t) -> Point { return a + t * (b - a); };
}

/// From the angle `begin` to `end`, counted from `x` towards `y`, in radians.
inline Curve arc(const Point& centre, const Point& x, const Point& y, double begin, double end) {
  return [=](double t) -> Point {
    const double angle = begin + t * (end - begin);
    return centre + std::cos(angle) * x + std::sin(angle) * y;
  };
}

inline std::vector<Point> points_on(const Curve& curve, std::size_t n) {
  std::vector<Point> points;
  for (std::size_t i = 0; i <= n; ++i) points.push_back(curve(static_cast<double>(i) / static_cast<double>(n)));
  return points;
}

/// Appends a polyline that begins where the other ends.
inline void append(std::vector<Point>& polyline, const std::vector<Point>& more) {
  polyline.insert(polyline.end(), more.begin() + (polyline.empty() ? 0 : 1), more.end());
}

/// Maps the square [-1, 1]^2 to the unit disc such that even steps along its outline become even steps on the circle
/// (Shirley and Chiu 1997).
inline Eigen::Vector2d square_to_disc(double x, double y) {
  if (x == 0 && y == 0) return {0, 0};
  const bool is_wide = std::abs(x) > std::abs(y);
  const double radius = is_wide ? x : y,
               angle = is_wide ? half_turn / 4 * y / x : half_turn / 2 - half_turn / 4 * x / y;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// A disc, or a cap over it, with its centre on the z-axis: `f(x, y)` for points of the unit disc, its circle divided
/// into `around` steps.
inline void disc(Builder& builder, std::size_t label, const Meshing& meshing, std::size_t around, bool is_upward,
                 const std::function<Point(double, double)>& f) {
  if (meshing.is_even) {
    const std::size_t n = around / 4;
    const auto at = [&](std::size_t i, std::size_t j) {
      const double u = 2 * static_cast<double>(i) / static_cast<double>(n) - 1;
      const double v = 2 * static_cast<double>(j) / static_cast<double>(n) - 1;
      const Eigen::Vector2d p = is_upward ? square_to_disc(u, v) : square_to_disc(v, u);
      return f(p.x(), p.y());
    };
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        // Diagonals point to the centre, lest a triangle has all its corners on the circle.
        const bool is_first = (2 * i + 1 < n) == (2 * j + 1 < n);
        builder.triangle(label, at(i, j), at(i + 1, j), is_first ? at(i + 1, j + 1) : at(i, j + 1));
        builder.triangle(label, is_first ? at(i, j) : at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  } else {
    std::vector<Point> circle;
    for (std::size_t k = 0; k < around; ++k) {
      const double angle = 2 * half_turn * static_cast<double>(k) / static_cast<double>(around);
      circle.push_back(f(std::cos(angle), (is_upward ? 1 : -1) * std::sin(angle)));
    }
    builder.fan(label, circle);
  }
}

/// A flat disc about the z-axis.
inline void flat_disc(Builder& builder, const Meshing& meshing, std::size_t around, double radius, double z,
                      bool is_upward) {
  const std::size_t label = builder.add(plane({0, 0, z}, is_upward ? Point(0, 0, 1) : Point(0, 0, -1)));
  disc(builder, label, meshing, around, is_upward,
       [=](double x, double y) { return Point(radius * x, radius * y, z); });
}

/// The surface that a curve in the half plane (x = radius, z) sweeps out about the z-axis; the curve goes upward on an
/// outer surface.
inline void revolve(Builder& builder, std::size_t label, std::size_t around, std::size_t along, const Curve& curve) {
  builder.grid(label, around, along, [&](double u, double v) {
    const Point p = curve(v);
    return Point(p.x() * std::cos(2 * half_turn * u), p.x() * std::sin(2 * half_turn * u), p.z());
  });
}

// ---- The solids ----

/// A box; 6 planes.
inline Solid box(const Meshing& meshing) {
  Builder builder("box");
  const Point size(2, 3, 1);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1., 1.}) {
      const int i = (axis + (side > 0 ? 1 : 2)) % 3, j = (axis + (side > 0 ? 2 : 1)) % 3;
      const Point corner =
          side * size[axis] / 2 * Point::Unit(axis) - size[i] / 2 * Point::Unit(i) - size[j] / 2 * Point::Unit(j);
      const std::size_t label = builder.add(plane(corner, side * Point::Unit(axis)));
      builder.grid(label, meshing.along_line(size[i]), meshing.along_line(size[j]), [=](double u, double v) -> Point {
        return corner + u * size[i] * Point::Unit(i) + v * size[j] * Point::Unit(j);
      });
    }
  return std::move(builder).solid();
}

/// A box whose edges and corners are rounded; 6 planes, 12 cylinders, 8 spheres, all joined smoothly.
inline Solid rounded_box(const Meshing& meshing) {
  Builder builder("rounded_box");
  const Point half(1, 1.5, 0.75);  // of the box inside, which the radius is added to
  const double radius = 0.3;
  const std::size_t steps = meshing.along_arc(half_turn / 2, radius);
  // The unit vector from `a` towards `b`, at a part of a right angle.
  const auto turned = [](const Point& a, const Point& b, double t) -> Point {
    return std::cos(half_turn / 2 * t) * a + std::sin(half_turn / 2 * t) * b;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1., 1.}) {
      const int i = (axis + (side > 0 ? 1 : 2)) % 3, j = (axis + (side > 0 ? 2 : 1)) % 3;
      const Point x = half[i] * Point::Unit(i), y = half[j] * Point::Unit(j), out = side * Point::Unit(axis);
      const Point middle = (half[axis] + radius) * out;
      builder.grid(builder.add(plane(middle, out)), meshing.along_line(2 * half[i]), meshing.along_line(2 * half[j]),
                   [=](double u, double v) -> Point { return middle + (2 * u - 1) * x + (2 * v - 1) * y; });
    }
  for (int axis = 0; axis < 3; ++axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    for (const auto& [s, t] : {std::pair(1., 1.), {-1., 1.}, {-1., -1.}, {1., -1.}}) {
      const Point a = s * Point::Unit(i), b = t * Point::Unit(j);
      const Point middle = half[i] * a + half[j] * b;
      const bool is_ccw = s * t > 0;  // from a to b about the axis
      builder.grid(builder.add(cylinder(middle, Point::Unit(axis), radius)), steps, meshing.along_line(2 * half[axis]),
                   [&](double u, double v) -> Point {
                     const double turn = is_ccw ? u : 1 - u;
                     return middle + radius * turned(a, b, turn) + (2 * v - 1) * half[axis] * Point::Unit(axis);
                   });
    }
  }
  for (const double x : {-1., 1.})
    for (const double y : {-1., 1.})
      for (const double z : {-1., 1.}) {
        const Point centre(x * half.x(), y * half.y(), z * half.z());
        const bool is_ccw = x * y > 0;
        builder.grid(builder.add(sphere(centre, radius)), steps, steps, [&](double u, double v) -> Point {
          const Point equator = turned(x * Point::UnitX(), y * Point::UnitY(), is_ccw ? u : 1 - u);
          return centre + radius * turned(equator, z * Point::UnitZ(), z > 0 ? v : 1 - v);
        });
      }
  return std::move(builder).solid();
}

/// A shaft of three steps: a chamfer at the lower end, fillets in the inner corners; 4 planes, 3 cylinders, 1 cone,
/// 2 tori.
inline Solid stepped_shaft(const Meshing& meshing) {
  Builder builder("stepped_shaft");
  const std::size_t around = meshing.around(0.8);
  const Point up = Point::UnitZ(), out = Point::UnitX();
  const auto add_line = [&](const Surface& surface, double r0, double z0, double r1, double z1) {
    revolve(builder, builder.add(surface), around, meshing.along_line(std::hypot(r1 - r0, z1 - z0)),
            line({r0, 0, z0}, {r1, 0, z1}));
  };
  // A shoulder at the height z from the radius r0 in to a cylinder of radius r1 above it, with a fillet between them.
  const auto add_shoulder = [&](double r0, double r1, double z, double fillet) {
    add_line(plane({0, 0, z}, up), r0, z, r1 + fillet, z);
    const Point centre(r1 + fillet, 0, z + fillet);
    revolve(builder, builder.add(torus({0, 0, z + fillet}, up, r1 + fillet, fillet)), around,
            meshing.along_arc(half_turn / 2, fillet), arc(centre, -fillet * up, -fillet * out, 0, half_turn / 2));
  };
  const double chamfer = 0.2;
  flat_disc(builder, meshing, around, 1 - chamfer, 0, false);
  add_line(cone({0, 0, -(1 - chamfer)}, up, half_turn / 4), 1 - chamfer, 0, 1, chamfer);
  add_line(cylinder({0, 0, 0}, up, 1), 1, chamfer, 1, 1);
  add_shoulder(1, 0.7, 1, 0.2);
  add_line(cylinder({0, 0, 0}, up, 0.7), 0.7, 1.2, 0.7, 2);
  add_shoulder(0.7, 0.4, 2, 0.15);
  add_line(cylinder({0, 0, 0}, up, 0.4), 0.4, 2.15, 0.4, 3);
  flat_disc(builder, meshing, around, 0.4, 3, true);
  return std::move(builder).solid();
}

/// A cylinder with a hemisphere at each end, joined smoothly.
inline Solid capsule(const Meshing& meshing) {
  Builder builder("capsule");
  const double radius = 0.6, half_length = 1;
  const std::size_t around = meshing.around(radius);
  revolve(builder, builder.add(cylinder({0, 0, 0}, Point::UnitZ(), radius)), around,
          meshing.along_line(2 * half_length), line({radius, 0, -half_length}, {radius, 0, half_length}));
  for (const double side : {-1., 1.}) {
    const Point centre(0, 0, side * half_length);
    const std::size_t label = builder.add(sphere(centre, radius));
    if (meshing.is_even) {
      disc(builder, label, meshing, around, side > 0, [&](double x, double y) -> Point {
        const double r = std::hypot(x, y), out = r > 0 ? std::sin(half_turn / 2 * r) / r : 0;
        return centre + radius * Point(out * x, out * y, side * std::cos(half_turn / 2 * r));
      });
    } else {
      const double begin = side > 0 ? 0 : -half_turn / 2;
      const Curve quarter = arc(centre, radius * Point::UnitX(), radius * Point::UnitZ(), begin, begin + half_turn / 2);
      revolve(builder, label, around, meshing.along_arc(half_turn / 2, radius), [=](double t) -> Point {
        const Point p = quarter(t);
        return {std::abs(p.x()) < 1e-9 ? 0 : p.x(), 0, p.z()};
      });
    }
  }
  return std::move(builder).solid();
}

/// A bent pipe: two straight arms and a quarter of a torus between them, joined smoothly, outside and inside; 2 planes,
/// 4 cylinders, 2 tori.
inline Solid pipe_elbow(const Meshing& meshing) {
  Builder builder("pipe_elbow");
  const double outer = 0.5, inner = 0.35, bend = 1, arm = 1.2;
  const std::size_t around = meshing.around(outer);
  // The centre line comes down the first arm, along -y, turns about the z-axis, and leaves along +x.
  const Point start(-bend, arm, 0), middle(0, 0, 0), end(arm, -bend, 0);
  const auto section = [](const Point& centre, const Point& side, double radius, double u) -> Point {
    return centre + radius * (std::cos(2 * half_turn * u) * side + std::sin(2 * half_turn * u) * Point::UnitZ());
  };
  for (const double radius : {outer, inner}) {
    const auto sweep = [&](const Surface& surface, std::size_t along, const Curve& centre, const Curve& side) {
      builder.grid(builder.add(surface), around, along, [&](double u, double v) {
        return section(centre(v), side(v), radius, radius == outer ? 1 - u : u);
      });
    };
    sweep(cylinder(start, Point::UnitY(), radius), meshing.along_line(arm), line(start, {-bend, 0, 0}),
          [](double) { return Point(-1, 0, 0); });
    sweep(torus(middle, Point::UnitZ(), bend, radius), meshing.along_arc(half_turn / 2, bend),
          arc(middle, bend * Point::UnitX(), bend * Point::UnitY(), half_turn, 1.5 * half_turn),
          arc(middle, Point::UnitX(), Point::UnitY(), half_turn, 1.5 * half_turn));
    sweep(cylinder(end, Point::UnitX(), radius), meshing.along_line(arm), line({0, -bend, 0}, end),
          [](double) { return Point(0, -1, 0); });
  }
  const std::size_t across = meshing.along_line(outer - inner);
  const auto cap = [&](const Point& centre, const Point& side, const Point& out, bool is_inner_first) {
    builder.grid(builder.add(plane(centre, out)), around, across, [&](double u, double v) {
      const double t = is_inner_first ? 1 - v : v;
      return section(centre, side, inner + t * (outer - inner), u);
    });
  };
  cap(start, Point(-1, 0, 0), Point::UnitY(), true);
  cap(end, Point(0, -1, 0), Point::UnitX(), false);
  return std::move(builder).solid();
}

/// A round plate with a bore and six holes; 2 planes, 8 cylinders.
inline Solid flange(const Meshing& meshing) {
  Builder builder("flange");
  const double outer = 1.6, bore = 0.6, pitch = 1.1, hole = 0.2, half_height = 0.25;
  const std::size_t holes = 6;
  const double half_sector = half_turn / static_cast<double>(holes);
  const Point x = Point::UnitX(), y = Point::UnitY(), up = Point::UnitZ();
  const std::size_t along = meshing.along_line(2 * half_height);

  // The outline of a sector, counterclockwise, and the points of its hole, in the plane z = 0.
  const std::size_t n_outer = meshing.along_arc(2 * half_sector, outer);
  const std::size_t n_bore = meshing.along_arc(2 * half_sector, bore);
  const std::size_t n_side = meshing.along_line(outer - bore);
  const Curve outer_arc = arc({0, 0, 0}, outer * x, outer * y, -half_sector, half_sector);
  const Curve bore_arc = arc({0, 0, 0}, bore * x, bore * y, -half_sector, half_sector);
  const Point centre = pitch * x;
  std::vector<Point> outline;
  append(outline, points_on(outer_arc, n_outer));
  append(outline, points_on(line(outer_arc(1), bore_arc(1)), n_side));
  append(outline, points_on([&](double t) { return bore_arc(1 - t); }, n_bore));
  append(outline, points_on(line(bore_arc(0), outer_arc(0)), n_side));
  std::vector<Point> rim;
  if (meshing.is_even) {
    for (const Point& p : outline) rim.push_back(centre + hole * (p - centre).normalized());
  } else {
    const double begin = std::atan2(outline[0].y(), outline[0].x() - pitch);
    rim = points_on(arc(centre, hole * x, hole * y, begin, begin + 2 * half_turn), meshing.around(hole));
  }
  const std::size_t layers = meshing.along_line(pitch - hole - bore);

  const std::size_t top = builder.add(plane(half_height * up, up)), bottom = builder.add(plane(-half_height * up, -up));
  const std::size_t outside = builder.add(cylinder({0, 0, 0}, up, outer));
  const std::size_t inside = builder.add(cylinder({0, 0, 0}, up, bore));
  for (std::size_t k = 0; k < holes; ++k) {
    const Eigen::AngleAxisd turn(2 * half_sector * static_cast<double>(k), up);
    const auto at = [&](const Point& p, double v) -> Point { return turn * p + (2 * v - 1) * half_height * up; };
    builder.grid(outside, n_outer, along, [&](double u, double v) { return at(outer_arc(u), v); });
    builder.grid(inside, n_bore, along, [&](double u, double v) { return at(bore_arc(1 - u), v); });
    const std::size_t wall = builder.add(cylinder(turn * centre, up, hole));
    for (std::size_t i = 0; i + 1 < rim.size(); ++i)
      builder.grid(wall, 1, along, [&](double u, double v) { return at(u < 0.5 ? rim[i + 1] : rim[i], v); });
    for (const std::size_t label : {top, bottom}) {
      const bool is_top = label == top;
      const auto lifted = [&](const Point& p) { return at(p, is_top ? 1 : 0); };
      if (meshing.is_even) {
        for (std::size_t i = 0; i + 1 < rim.size(); ++i)
          builder.grid(label, 1, layers, [&](double u, double v) -> Point {
            const bool is_next = (u < 0.5) == is_top;
            return lifted((1 - v) * rim[i + is_next] + v * outline[i + is_next]);
          });
      } else {
        std::vector<Point> around_hole, around_sector;
        for (const Point& p : rim) around_hole.push_back(lifted(p));
        for (const Point& p : outline) around_sector.push_back(lifted(p));
        if (is_top)
          builder.strip(label, lifted(centre), around_hole, around_sector);
        else
          builder.strip(label, lifted(centre), around_sector, around_hole);
      }
    }
  }
  return std::move(builder).solid();
}

/// A frustum of a cone on a cylinder; 2 planes, 1 cylinder, 1 cone.
inline Solid cone_on_cylinder(const Meshing& meshing) {
  Builder builder("cone_on_cylinder");
  const double radius = 1, tip = 0.25, height = 1.2, cone_height = 1.5;
  const std::size_t around = meshing.around(radius);
  const double half_angle = std::atan2(radius - tip, cone_height);
  const Point apex(0, 0, height + radius / std::tan(half_angle));
  flat_disc(builder, meshing, around, radius, 0, false);
  revolve(builder, builder.add(cylinder({0, 0, 0}, Point::UnitZ(), radius)), around, meshing.along_line(height),
          line({radius, 0, 0}, {radius, 0, height}));
  revolve(builder, builder.add(cone(apex, -Point::UnitZ(), half_angle)), around,
          meshing.along_line(std::hypot(radius - tip, cone_height)),
          line({radius, 0, height}, {tip, 0, height + cone_height}));
  flat_disc(builder, meshing, around, tip, height + cone_height, true);
  return std::move(builder).solid();
}

/// A block with a pocket that has round ends and a fillet along its floor; 9 planes, 4 cylinders, 2 tori. All joints
/// inside the pocket are smooth.
inline Solid blended_slot(const Meshing& meshing) {
  Builder builder("blended_slot");
  const double half_straight = 0.8, half_width = 1.1, pocket = 0.6, fillet = 0.25, depth = 0.7, height = 1.2;
  const double half_length = half_straight + half_width;
  const double floor = height - depth, floor_radius = pocket - fillet;
  // An end of the pocket has as many steps as the three sides of the block about it: one, two and one times `quarter`.
  const std::size_t quarter = meshing.is_even ? meshing.along_line(half_width) : 1;
  const std::size_t around_end = meshing.is_even ? 4 * quarter : 2 * meshing.along_arc(half_turn / 2, pocket);
  const std::size_t along = meshing.along_line(2 * half_straight);
  const std::size_t down_wall = meshing.along_line(depth - fillet),
                    round_fillet = meshing.along_arc(half_turn / 2, fillet);
  const std::size_t across_rim = meshing.along_line(half_width - pocket), down_side = meshing.along_line(height);
  const Point x = Point::UnitX(), y = Point::UnitY(), up = Point::UnitZ();

  const std::size_t top = builder.add(plane(height * up, up)), ground = builder.add(plane({0, 0, 0}, -up));
  const std::size_t floor_label = builder.add(plane(floor * up, up));
  for (const double side : {1., -1.}) {
    // Half of the solid is the other half turned by 180 degrees.
    const auto at = [&](const Point& p) { return Point(side * p.x(), side * p.y(), p.z()); };
    const auto add_grid = [&](std::size_t label, std::size_t n, std::size_t m, const auto& f) {
      builder.grid(label, n, m, [&](double u, double v) { return at(f(u, v)); });
    };
    // An arc of a stadium about the pocket and the straight that follows it, counterclockwise.
    const auto end_arc = [&](double radius, double z) {
      return arc(half_straight * x + z * up, radius * x, radius * y, -half_turn / 2, half_turn / 2);
    };
    const auto straight = [&](double radius, double z) {
      return line(half_straight * x + radius * y + z * up, -half_straight * x + radius * y + z * up);
    };

    // The wall, the fillet and the floor.
    const auto profile = [&](double v) {  // radius and height of the fillet, upward
      return std::pair(floor_radius + fillet * std::sin(half_turn / 2 * v),
                       floor + fillet * (1 - std::cos(half_turn / 2 * v)));
    };
    const double above = floor + fillet;
    add_grid(builder.add(cylinder(at(half_straight * x), up, pocket)), around_end, down_wall,
             [&](double u, double v) { return end_arc(pocket, above + v * (height - above))(1 - u); });
    add_grid(builder.add(plane(at(pocket * y), side * -y)), along, down_wall,
             [&](double u, double v) { return straight(pocket, above + v * (height - above))(1 - u); });
    add_grid(builder.add(torus(at(half_straight * x + above * up), up, floor_radius, fillet)), around_end, round_fillet,
             [&](double u, double v) { return end_arc(profile(v).first, profile(v).second)(1 - u); });
    add_grid(builder.add(cylinder(at(floor_radius * y + above * up), x, fillet)), along, round_fillet,
             [&](double u, double v) { return straight(profile(v).first, profile(v).second)(1 - u); });
    if (meshing.is_even) {
      add_grid(floor_label, around_end / 4, around_end / 2, [&](double u, double v) -> Point {
        const Eigen::Vector2d p = floor_radius * square_to_disc(u, 2 * v - 1);
        return half_straight * x + p.x() * x + p.y() * y + floor * up;
      });
      add_grid(floor_label, along, around_end / 4, [&](double u, double v) -> Point {
        return (2 * u - 1) * half_straight * x + v * floor_radius * y + floor * up;
      });
    }

    // The outer sides, and the rim between them and the pocket.
    const Point b(half_straight, -half_width, 0), c(half_length, -half_width, 0), d(half_length, half_width, 0),
        e(half_straight, half_width, 0), f(-half_straight, half_width, 0);
    const std::size_t right = builder.add(plane(at(d), side * x));
    if (meshing.is_even) {
      std::vector<Point> outline;
      append(outline, points_on(line(b, c), quarter));
      append(outline, points_on(line(c, d), 2 * quarter));
      append(outline, points_on(line(d, e), quarter));
      append(outline, points_on(line(e, f), along));
      std::vector<Point> rim = points_on(end_arc(pocket, 0), around_end);
      append(rim, points_on(straight(pocket, 0), along));
      for (std::size_t i = 0; i + 1 < rim.size(); ++i)
        add_grid(top, 1, across_rim, [&](double u, double v) -> Point {
          const std::size_t k = u < 0.5 ? i + 1 : i;
          return (1 - v) * rim[k] + v * outline[k] + height * up;
        });
    }
    add_grid(right, meshing.is_even ? 2 * quarter : 1, down_side,
             [&](double u, double v) -> Point { return c + u * (d - c) + v * height * up; });
  }

  // What runs over both halves.
  const std::size_t back = builder.add(plane({0, half_width, 0}, y)),
                    front = builder.add(plane({0, -half_width, 0}, -y));
  if (meshing.is_even) {
    for (const double side : {1., -1.}) {
      const std::size_t label = side > 0 ? back : front;
      const std::array<double, 4> at = {-half_length, -half_straight, half_straight, half_length};
      const std::array<std::size_t, 3> steps = {quarter, along, quarter};
      for (std::size_t part = 0; part < 3; ++part) {
        const double begin = at[part], end = at[part + 1];
        builder.grid(label, steps[part], down_side, [&](double u, double v) {
          return Point(-side * (begin + u * (end - begin)), side * half_width, v * height);
        });
        if (side > 0)
          builder.grid(ground, steps[part], 2 * quarter, [&](double u, double v) {
            return Point(begin + u * (end - begin), -(2 * v - 1) * half_width, 0);
          });
      }
    }
  } else {
    const Point corner(half_length, half_width, 0);
    const Point a(-corner.x(), -corner.y(), 0), b(corner.x(), -corner.y(), 0), c = corner,
                                                                               d(-corner.x(), corner.y(), 0);
    builder.quadrangle(back, c, d, d + height * up, c + height * up);
    builder.quadrangle(front, a, b, b + height * up, a + height * up);
    builder.quadrangle(ground, a, d, c, b);
    const auto stadium = [&](double radius, double z) {
      std::vector<Point> points;
      for (const double side : {1., -1.}) {
        const std::vector<Point> end = points_on(
            arc(side * half_straight * x + z * up, side * radius * x, side * radius * y, -half_turn / 2, half_turn / 2),
            around_end);
        points.insert(points.end(), end.begin(), end.end());
      }
      return points;
    };
    builder.fan(floor_label, stadium(floor_radius, floor));
    std::vector<Point> rim = stadium(pocket, height);
    rim.push_back(rim.front());
    builder.strip(top, height * up, rim,
                  {b + height * up, c + height * up, d + height * up, a + height * up, b + height * up});
  }
  return std::move(builder).solid();
}

/// All of them.
inline std::vector<Solid> all(const Meshing& meshing) {
  return {box(meshing),        rounded_box(meshing), stepped_shaft(meshing),    capsule(meshing),
          pipe_elbow(meshing), flange(meshing),      cone_on_cylinder(meshing), blended_slot(meshing)};
}

}  // namespace solids

#endif
