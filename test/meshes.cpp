// SPDX-License-Identifier: MIT

#include "meshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <utility>

namespace meshes {

Shape plane(std::size_t n) {
  Shape shape;
  const double size = static_cast<double>(n);
  for (std::size_t y = 0; y <= n; ++y)
    for (std::size_t x = 0; x <= n; ++x)
      shape.points.emplace_back(static_cast<double>(x) / size, static_cast<double>(y) / size, 0);
  for (std::size_t y = 0; y < n; ++y)
    for (std::size_t x = 0; x < n; ++x) {
      const std::size_t a = y * (n + 1) + x, b = a + 1, c = b + n + 1, d = a + n + 1;
      shape.faces.push_back({a, b, c});
      shape.faces.push_back({a, c, d});
    }
  return shape;
}

Shape cubes(const std::vector<std::array<int, 3>>& corners, std::size_t n) {
  Shape shape;
  const int size = static_cast<int>(n);
  std::map<std::array<int, 3>, std::size_t> numbers;  // of lattice points
  const auto number = [&](const std::array<int, 3>& p) {
    const auto [found, fresh] = numbers.emplace(p, shape.points.size());
    if (fresh) shape.points.push_back(Eigen::Vector3d(p[0], p[1], p[2]) / static_cast<double>(n));
    return found->second;
  };
  for (const auto& corner : corners)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        std::array<int, 3> beyond = corner;
        beyond[axis] += 2 * side - 1;
        if (std::find(corners.begin(), corners.end(), beyond) != corners.end()) continue;
        // u x v points along the axis, outward for side 1.
        const std::size_t u = (axis + 1 + (side == 0)) % 3, v = (axis + 2 - (side == 0)) % 3;
        for (int j = 0; j < size; ++j)
          for (int i = 0; i < size; ++i) {
            std::array<int, 3> p = {corner[0] * size, corner[1] * size, corner[2] * size};
            p[axis] += side * size;
            p[u] += i;
            p[v] += j;
            const std::size_t a = number(p);
            ++p[u];
            const std::size_t b = number(p);
            ++p[v];
            const std::size_t c = number(p);
            --p[u];
            const std::size_t d = number(p);
            shape.faces.push_back({a, b, c});
            shape.faces.push_back({a, c, d});
          }
      }
  return shape;
}

Shape cube(std::size_t n) { return cubes({{0, 0, 0}}, n); }

Shape l_shape(std::size_t n) { return cubes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, n); }

Shape cube_of_quads() {
  Shape shape = cube();
  std::vector<std::vector<std::size_t>> quads;
  for (std::size_t f = 0; f < shape.faces.size(); f += 2) {
    std::vector<std::size_t> quad = shape.faces[f];
    quad.push_back(shape.faces[f + 1].back());
    quads.push_back(quad);
  }
  shape.faces = quads;
  return shape;
}

Shape folded_strip(double angle, std::size_t n) {
  Shape shape = plane(2 * n);
  for (Eigen::Vector3d& p : shape.points) {
    p.x() -= 0.5;
    const double side = p.x() < 0 ? -1 : 1;
    p = {p.x() * std::cos(angle / 2), p.y(), -side * p.x() * std::sin(angle / 2)};
  }
  return shape;
}

Shape revolve(const std::vector<Eigen::Vector2d>& curve, std::size_t around, bool closed) {
  Shape shape;
  std::vector<std::size_t> ring;  // number of the first point
  for (const Eigen::Vector2d& p : curve) {
    ring.push_back(shape.points.size());
    for (std::size_t k = 0; k < (p[0] > 0 ? around : 1); ++k) {
      const double angle = 2 * pi * static_cast<double>(k) / static_cast<double>(around);
      shape.points.emplace_back(p[0] * std::cos(angle), p[0] * std::sin(angle), p[1]);
    }
  }
  const auto point = [&](std::size_t i, std::size_t k) { return ring[i] + (curve[i][0] > 0 ? k % around : 0); };
  const std::size_t last = curve.size() - (closed ? 0 : 1);
  for (std::size_t i = 0; i < last; ++i)
    for (std::size_t k = 0; k < around; ++k) {
      const std::size_t j = (i + 1) % curve.size();
      const std::size_t a = point(i, k), b = point(i, k + 1), c = point(j, k + 1), d = point(j, k);
      if (a != b) shape.faces.push_back({a, b, c});
      if (c != d) shape.faces.push_back({a, c, d});
    }
  return shape;
}

Shape tube(double height, std::size_t around, std::size_t along) {
  std::vector<Eigen::Vector2d> curve;
  for (std::size_t i = 0; i <= along; ++i)
    curve.emplace_back(1, height * static_cast<double>(i) / static_cast<double>(along));
  return revolve(curve, around);
}

Shape prism(std::size_t sides) {
  Shape shape;
  std::vector<std::size_t> bottom, top;
  for (std::size_t i = 0; i < sides; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(sides);
    for (const double z : {0., 2.}) shape.points.emplace_back(std::cos(angle), std::sin(angle), z);
    const std::size_t next = (i + 1) % sides;
    shape.faces.push_back({2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
    bottom.insert(bottom.begin(), 2 * i);
    top.push_back(2 * i + 1);
  }
  shape.faces.push_back(bottom);
  shape.faces.push_back(top);
  return shape;
}

Shape torus(double radius, double tube_radius, std::size_t around, std::size_t across) {
  std::vector<Eigen::Vector2d> curve;
  for (std::size_t i = 0; i < across; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(across);
    curve.emplace_back(radius + tube_radius * std::cos(angle), tube_radius * std::sin(angle));
  }
  return revolve(curve, around, true);
}

Shape two_spheres_with_neck(double distance, double neck, std::size_t around) {
  const std::size_t steps = around / 2;
  const double end = pi - std::asin(neck);
  std::vector<Eigen::Vector2d> lower;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double angle = end * static_cast<double>(i) / static_cast<double>(steps);
    lower.emplace_back(i == 0 ? 0 : std::sin(angle), -std::cos(angle) - distance / 2);
  }
  std::vector<Eigen::Vector2d> curve = lower;
  const double gap = -2 * lower.back()[1];
  const std::size_t along = std::max<std::size_t>(1, static_cast<std::size_t>(gap * static_cast<double>(steps) / pi));
  for (std::size_t i = 1; i < along; ++i)
    curve.emplace_back(neck, gap * (static_cast<double>(i) / static_cast<double>(along) - 0.5));
  for (auto p = lower.rbegin(); p != lower.rend(); ++p) curve.emplace_back((*p)[0], -(*p)[1]);
  return revolve(curve, around);
}

Shape subdivided(const Shape& coarse) {
  Shape fine;
  fine.points = coarse.points;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
  const auto middle = [&](std::size_t a, std::size_t b) {
    const auto [found, fresh] = middles.emplace(std::minmax(a, b), fine.points.size());
    if (fresh) fine.points.push_back((coarse.points[a] + coarse.points[b]) / 2);
    return found->second;
  };
  for (const auto& f : coarse.faces) {
    const std::size_t a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
    fine.faces.insert(fine.faces.end(), {{f[0], a, c}, {a, f[1], b}, {c, b, f[2]}, {a, b, c}});
  }
  return fine;
}

Shape sphere(std::size_t levels) {
  const double g = (1 + std::sqrt(5.)) / 2;
  Shape shape;
  shape.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  shape.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (std::size_t level = 0; level < levels; ++level) shape = subdivided(shape);
  for (Eigen::Vector3d& p : shape.points) p.normalize();
  return shape;
}

Shape transformed(Shape shape, const Eigen::Affine3d& map) {
  for (Eigen::Vector3d& p : shape.points) p = map * p;
  return shape;
}

Shape with_pits(Shape shape, std::size_t first_faces, std::size_t step) {
  constexpr double depth = 0.05;
  for (std::size_t f = 0; f < first_faces; f += step) {
    const std::vector<std::size_t> outline = shape.faces[f];
    const auto point = [&](std::size_t corner) { return shape.points[outline[corner % outline.size()]]; };
    const std::size_t corners = outline.size(), first = shape.points.size();
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < corners; ++i) middle += point(i) / static_cast<double>(corners);
    const Eigen::Vector3d inward = depth * (point(2) - point(1)).cross(point(1) - point(0)).normalized();
    for (const Eigen::Vector3d& down : {Eigen::Vector3d(0, 0, 0), inward})
      for (std::size_t i = 0; i < corners; ++i) shape.points.push_back((point(i) + middle) / 2 + down);
    std::vector<std::size_t> floor;
    for (std::size_t i = 0; i < corners; ++i) {
      const std::size_t next = (i + 1) % corners, rim = first + i, next_rim = first + next;
      shape.faces.push_back({outline[i], outline[next], next_rim});
      shape.faces.push_back({outline[i], next_rim, rim});
      shape.faces.push_back({rim, next_rim, next_rim + corners, rim + corners});
      floor.push_back(rim + corners);
    }
    shape.faces[f] = floor;
  }
  return shape;
}

Shape scaled(Shape shape, double factor) {
  for (Eigen::Vector3d& p : shape.points) p *= factor;
  return shape;
}

Shape moved(Shape shape, const Eigen::Vector3d& by) {
  for (Eigen::Vector3d& p : shape.points) p += by;
  return shape;
}

Eigen::Affine3d some_rotation() {
  return Eigen::Affine3d(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()));
}

Shape together(Shape first, const Shape& second) {
  const std::size_t shift = first.points.size();
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  for (std::vector<std::size_t> face : second.faces) {
    for (std::size_t& corner : face) corner += shift;
    first.faces.push_back(face);
  }
  return first;
}

Shape with_noise(Shape shape, double deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise;
  for (Eigen::Vector3d& p : shape.points)
    for (double& x : p) x += deviation * noise(random);
  return shape;
}

std::vector<std::size_t> random_order(std::size_t number, unsigned seed) {
  std::vector<std::size_t> order(number);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::mt19937 random(seed);
  for (std::size_t i = number; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

Shape with_faces_in_order(const Shape& shape, const std::vector<std::size_t>& order) {
  Shape result;
  result.points = shape.points;
  for (const std::size_t f : order) result.faces.push_back(shape.faces[f]);
  return result;
}

Shape with_clutter(const Shape& shape) {
  std::map<std::pair<std::size_t, std::size_t>, int> sides;
  for (const auto& face : shape.faces)
    for (std::size_t k = 0; k < face.size(); ++k) ++sides[{face[k], face[(k + 1) % face.size()]}];
  Shape result = shape;
  for (const auto& [side, number] : sides) {
    const auto [a, b] = side;
    if (sides.count({b, a})) continue;
    result.faces.push_back({b, a, result.points.size()});
    result.points.push_back((shape.points[a] + shape.points[b]) / 2 + Eigen::Vector3d(0, 0, 100));
  }
  Shape tetrahedron;
  tetrahedron.points = {{1000, 0, 0}, {1001, 0, 0}, {1000, 1, 0}, {1000, 0, 1}};
  tetrahedron.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return together(result, tetrahedron);
}

Surface_mesh surface_mesh(const Shape& shape) { return Plain<Surface_mesh>(shape).mesh; }

With_removed_faces::With_removed_faces(const Shape& shape) {
  const auto faces = append(with_clutter(shape), mesh);
  const auto patch = append(plane(2), mesh);
  for (const auto f : patch) CGAL::Euler::remove_face(halfedge(f, mesh), mesh);
  for (std::size_t f = shape.faces.size(); f < faces.size(); ++f)
    CGAL::Euler::remove_face(halfedge(faces[f], mesh), mesh);
}

Filtered::Filtered(const Shape& shape) : mesh(whole) {
  auto faces = append(with_clutter(shape), whole);
  faces.resize(shape.faces.size());
  mesh.set_selected_faces(faces);
}

template std::vector<Surface_mesh::Face_index> append(const Shape&, Surface_mesh&);
template std::vector<boost::graph_traits<Polyhedron>::face_descriptor> append(const Shape&, Polyhedron&);
#ifdef RW_SEGMENTATION_WITH_OPENMESH
template std::vector<boost::graph_traits<Open_mesh>::face_descriptor> append(const Shape&, Open_mesh&);
#endif
template std::optional<Surface_mesh> data_mesh(const std::string&);

}  // namespace meshes
