// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_COLOR_VISION_H
#define SEGMENT_MESH_COLOR_VISION_H

#include "../mesh_files/Colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace segment_mesh {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

inline Triple product(const Matrix& m, const Triple& v) {
  Triple result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return result;
}

/// Red, green and blue as amounts of light in [0, 1].
inline Triple linear(const mesh_files::Color& color) {
  Triple light{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = color[i] / 255.;
    light[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return light;
}

/// A point of the colour space OKLab (Ottosson 2020), in which distances are about as large as they look.
inline Triple oklab(const Triple& light) {
  constexpr Matrix to_cones = {{{0.4122214708, 0.5363325363, 0.0514459929},
                                {0.2119034982, 0.6806995451, 0.1073969566},
                                {0.0883024619, 0.2817188376, 0.6299787005}}};
  constexpr Matrix to_lab = {{{0.2104542553, 0.7936177850, -0.0040720468},
                              {1.9779984951, -2.4285922050, 0.4505937099},
                              {0.0259040371, 0.7827717662, -0.8086757660}}};
  Triple cones = product(to_cones, light);
  for (double& c : cones) c = std::cbrt(c);
  return product(to_lab, cones);
}

/// A colour as people see it: those with all cones, and those without the ones for red, green or blue (Machado, Oliveira
/// and Fernandes 2009).
inline std::array<Triple, 4> appearances(const mesh_files::Color& color) {
  constexpr std::array<Matrix, 4> visions = {{
      {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
      {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
      {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}},
  }};
  std::array<Triple, 4> result{};
  for (std::size_t i = 0; i < visions.size(); ++i) {
    Triple light = product(visions[i], linear(color));
    for (double& c : light) c = std::clamp(c, 0., 1.);
    result[i] = oklab(light);
  }
  return result;
}

/// How far apart two colours look to those who can tell them apart least. Black and white are at a distance of 1, and
/// 0.02 can just be seen.
inline double apparent_distance(const mesh_files::Color& a, const mesh_files::Color& b) {
  const auto seen_a = appearances(a), seen_b = appearances(b);
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < seen_a.size(); ++i)
    smallest = std::min(
        smallest, std::hypot(seen_a[i][0] - seen_b[i][0], seen_a[i][1] - seen_b[i][1], seen_a[i][2] - seen_b[i][2]));
  return smallest;
}

}  // namespace segment_mesh

#endif
