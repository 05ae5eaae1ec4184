// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_LARGE_SHAPES_H
#define RW_SEGMENTATION_TEST_LARGE_SHAPES_H

// Meshes of the kinds that take longest, each by its name: a free form with details of all sizes, a thin instrument of
// many curved parts, bodies that run through each other.

#include "defects.h"

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace large_shapes {

using defects::Soup;

constexpr double pi = 3.14159265358979323846;

/// Adds a tube round a closed or open curve, `place(u, v)` for 0 <= u, v <= 1, around which v goes.
inline void add_tube(Soup& soup, std::size_t along, std::size_t around, bool is_closed,
                     const std::function<Eigen::Vector3d(double, double)>& place) {
  const std::size_t first = soup.points.size(), rows = is_closed ? along : along + 1;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < around; ++j)
      soup.points.push_back(place(double(i) / double(along), double(j) / double(around)));
  const auto corner = [&](std::size_t i, std::size_t j) { return first + i % rows * around + j % around; };
  for (std::size_t i = 0; i < along; ++i)
    for (std::size_t j = 0; j < around; ++j) {
      soup.faces.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      soup.faces.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
}

/// A body that is bent, with waves of every length on it, of 2 * along * around faces.
inline Soup free_form(std::size_t along, std::size_t around) {
  Soup soup;
  std::mt19937 random(5);
  std::uniform_real_distribution<> phase(0, 2 * pi);
  struct Wave {
    double u, v, phase, height;
  };
  std::vector<Wave> waves;
  for (int octave = 0; octave < 6; ++octave)
    for (int i = 0; i < 4; ++i)
      waves.push_back(
          {double(1U << octave) * (1 + i % 2), double(1U << octave) * (i / 2), phase(random), 0.25 / (1U << octave)});
  add_tube(soup, along, around, true, [&](double u, double v) -> Eigen::Vector3d {
    double radius = 1;
    for (const Wave& w : waves) radius += w.height * std::sin(2 * pi * (w.u * u + w.v * v) + w.phase);
    const double a = 2 * pi * u, b = 2 * pi * v, r = 3 + 0.5 * std::sin(3 * a) + radius * std::cos(b);
    return {r * std::cos(a), r * std::sin(a), std::sin(2 * a) + radius * std::sin(b)};
  });
  return soup;
}

/// Something like a violin: a flat hollow body with a waist, a neck and strings, all thin.
inline Soup instrument(std::size_t around) {
  Soup soup;
  const auto outline = [](double t, double inside) -> Eigen::Vector3d {
    const double r = (1 + 0.25 * std::cos(2 * t) + 0.1 * std::cos(t)) * inside;
    return {1.4 * r * std::cos(t), r * std::sin(t), 0};
  };
  // Belly, ribs and back, arched, and once more for the inner side of the wood.
  for (const double wood : {0., 0.03})
    add_tube(soup, 50, around, false, [&](double u, double v) {
      const double side = 2 * u - 1, inside = std::min(1., 1.25 * (1 - side * side)) - wood;
      Eigen::Vector3d p = outline(2 * pi * (wood > 0 ? 1 - v : v), inside);
      p.z() = (side > 0 ? 1 : -1) * (0.15 + 0.1 * (1 - inside * inside) - wood);
      return p;
    });
  add_tube(soup, 60, around / 4, false, [](double u, double v) -> Eigen::Vector3d {  // the neck
    return {1.3 + 1.5 * u, 0.1 * std::cos(2 * pi * v), 0.2 + 0.05 * std::sin(2 * pi * v) + 0.3 * std::pow(u, 8)};
  });
  for (int string = 0; string < 4; ++string)
    add_tube(soup, 100, 12, false, [&](double u, double v) -> Eigen::Vector3d {
      return {-1 + 3.7 * u, 0.03 * (string - 1.5) + 0.004 * std::cos(2 * pi * v), 0.4 + 0.004 * std::sin(2 * pi * v)};
    });
  return soup;
}

/// Rings and rods that run through each other and through themselves.
inline Soup intersecting_bodies(std::size_t bodies) {
  Soup soup;
  std::mt19937 random(9);
  std::uniform_real_distribution<> place(-1, 1);
  for (std::size_t body = 0; body < bodies; ++body) {
    const Eigen::Vector3d centre(place(random), place(random), place(random));
    const double knot = body % 3 == 0 ? 2.5 : 1, thickness = 0.2 + 0.1 * place(random);
    add_tube(soup, 48, 16, true, [&](double u, double v) -> Eigen::Vector3d {
      const double a = 2 * pi * u, b = 2 * pi * v, r = 0.6 + 0.3 * std::sin(knot * 2 * a) + thickness * std::cos(b);
      return centre +
             Eigen::Vector3d(r * std::cos(a), r * std::sin(a), 0.3 * std::cos(3 * a) + thickness * std::sin(b));
    });
  }
  return soup;
}

/// All of them, none with more than 60,000 faces.
inline std::vector<std::pair<std::string, std::function<Soup()>>> all() {
  return {{"free_form_60k", [] { return free_form(300, 100); }},
          {"free_form_15k", [] { return free_form(150, 50); }},
          {"instrument_59k", [] { return instrument(215); }},
          {"intersecting_bodies_17k", [] { return intersecting_bodies(11); }}};
}

}  // namespace large_shapes

#endif
