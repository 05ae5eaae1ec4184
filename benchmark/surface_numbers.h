// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_BENCHMARK_SURFACE_NUMBERS_H
#define RW_SEGMENTATION_BENCHMARK_SURFACE_NUMBERS_H

// How well the numbers of surfaces are found, beside those that solids were designed with.

#include <RW_segmentation/Analytic_surface.h>

#ifdef RW_SEGMENTATION_WITH_NLOHMANN_JSON
#include <nlohmann/json.hpp>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace surface_numbers {

using RW_segmentation::Analytic_surface;
using RW_segmentation::Surface_type;

/// The surfaces of the segments in NAME.json; what is no analytic surface there is a free form.
inline std::vector<Analytic_surface> surfaces_of_design(const std::string& path) {
#ifdef RW_SEGMENTATION_WITH_NLOHMANN_JSON
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  const auto design = nlohmann::json::parse(file);
  std::vector<Analytic_surface> surfaces;
  for (const auto& segment : design.at("segments")) {
    Analytic_surface surface;
    for (const Surface_type type : RW_segmentation::analytic_types)
      if (segment["type"] == RW_segmentation::name_of(type)) surface.type = type;
    const auto vector = [&](const char* name, Eigen::Vector3d& v) {
      for (int i = 0; i < 3; ++i) v[i] = segment[name][static_cast<std::size_t>(i)];
    };
    if (segment.contains("p")) vector("p", surface.point);
    if (segment.contains("d")) vector("d", surface.direction);
    if (segment.contains("r")) (segment.contains("R") ? surface.tube_radius : surface.radius) = segment["r"];
    if (segment.contains("R")) surface.radius = segment["R"];
    if (segment.contains("semi_angle")) surface.half_angle = std::abs(segment["semi_angle"].get<double>());
    surfaces.push_back(surface);
  }
  return surfaces;
#else
  throw std::runtime_error(path + ": reading it needs nlohmann_json");
#endif
}

/// Of faces whose design has a radius: how many there are, how many are found with their type, how many of their
/// radii are right, and how many of these are within three standard errors.
struct Count {
  double faces = 0, of_type = 0, right = 0, within_errors = 0;

  double share(double number) const { return faces > 0 ? number / faces : 1; }
};

constexpr double largest_relative_error = 1e-4;

/// Designs are written with nine digits.
constexpr double rounding = 1e-9;

inline bool has_radius(const Analytic_surface& surface) { return surface.radius > 0 || surface.tube_radius > 0; }

/// The largest relative one.
inline double difference_of_radii(const Analytic_surface& found, const Analytic_surface& design) {
  const double radius = std::abs(found.radius - design.radius) / design.radius;
  return design.tube_radius > 0
             ? std::max(radius, std::abs(found.tube_radius - design.tube_radius) / design.tube_radius)
             : radius;
}

inline bool is_within_errors(const Analytic_surface& found, const Analytic_surface& design) {
  constexpr double most = 3;
  const auto is_within = [&](double a, double b, double error) {
    return std::abs(a - b) <= most * error + rounding * std::abs(b);
  };
  return is_within(found.radius, design.radius, found.errors.radius) &&
         is_within(found.tube_radius, design.tube_radius, found.errors.tube_radius);
}

inline void add(const Analytic_surface& found, const Analytic_surface& design, Count& count) {
  if (!has_radius(design)) return;
  ++count.faces;
  if (found.type != design.type) return;
  ++count.of_type;
  count.right += difference_of_radii(found, design) <= largest_relative_error;
  count.within_errors += is_within_errors(found, design);
}

}  // namespace surface_numbers

#endif
