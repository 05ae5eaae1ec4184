// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_STL_H
#define MESH_FILES_WRITE_STL_H

#include "Buffer.h"
#include "Output.h"
#include "Polygon_soup.h"
#include "Segmented_soup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace mesh_files {

/// A number as formats have it that know no larger ones.
/// \throws Unwritable_file if it is too large
inline float float_of(double value, const std::string& path) {
  if (std::abs(value) > double(std::numeric_limits<float>::max()))
    throw Unwritable_file(path + ": the coordinate " + std::to_string(value) + " is too large for this format");
  return static_cast<float>(value);
}

/// The normal of a triangle, of length 1, or 0 where it has no area.
inline std::array<double, 3> unit_normal(const Polygon_soup::Point& a, const Polygon_soup::Point& b,
                                         const Polygon_soup::Point& c) {
  std::array<double, 3> u, v;
  double scale = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = b[static_cast<int>(i)] - a[static_cast<int>(i)];
    v[i] = c[static_cast<int>(i)] - a[static_cast<int>(i)];
    scale = std::max({scale, std::abs(u[i]), std::abs(v[i])});
  }
  if (!(scale > 0)) return {0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] /= scale;
    v[i] /= scale;
  }
  const std::array<double, 3> n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double length = std::hypot(n[0], n[1], n[2]);
  if (!(length > 0)) return {0, 0, 0};
  return {n[0] / length, n[1] / length, n[2] / length};
}

/// Writes a binary STL file. The two bytes after each facet hold its colour as most programs read it: five bits each of
/// blue, green and red from the lowest on, and the highest bit for that there is one. Facets are in the order of the
/// faces, which are cut into triangles.
inline void write_binary_stl(Output& file, const Segmented_soup& mesh) {
  const Small_faces triangles = small_faces(mesh, 3);
  const std::size_t facets = triangles.label.size();
  if (facets > std::numeric_limits<std::uint32_t>::max())
    throw Unwritable_file(file.path() + ": more facets than an STL file can count");
  Buffer out(file);
  std::string header = "colours of segments: 5 bits each of blue, green and red";  // must not begin with "solid"
  header.resize(80, ' ');
  out << header;
  out.binary(static_cast<std::uint32_t>(facets));
  const auto& points = triangles.soup.points;
  for (std::size_t f = 0; f < facets; ++f) {
    const auto corners = triangles.soup.face(f);
    for (const double x : unit_normal(points[corners[0]], points[corners[1]], points[corners[2]]))
      out.binary(static_cast<float>(x));
    for (const auto corner : corners)
      for (int i = 0; i < 3; ++i) out.binary(float_of(points[corner][i], file.path()));
    const Color& color = mesh.color_of_label.at(triangles.label[f]);
    constexpr unsigned has_color = 1U << 15;
    out.binary(static_cast<std::uint16_t>(has_color | unsigned(color[0]) >> 3 << 10 | unsigned(color[1]) >> 3 << 5 |
                                          unsigned(color[2]) >> 3));
  }
  out.flush();
}

/// Writes an STL file as text: a solid `segment_<label>` for each label, one after the other.
inline void write_text_stl(Output& file, const Segmented_soup& mesh) {
  const Small_faces triangles = small_faces(mesh, 3);
  const auto& points = triangles.soup.points;
  Buffer out(file);
  for (const auto& [label, faces] : faces_of_labels(triangles.label)) {
    const std::string name = name_of_segment(label);
    out << "solid " << name << "\n";
    for (const std::size_t f : faces) {
      const auto corners = triangles.soup.face(f);
      out << "facet normal";
      out.row(unit_normal(points[corners[0]], points[corners[1]], points[corners[2]]));
      out << "\nouter loop\n";
      for (const auto corner : corners) {
        out << "vertex";
        out.row(std::array{points[corner].x(), points[corner].y(), points[corner].z()});
        out << "\n";
      }
      out << "endloop\nendfacet\n";
    }
    out << "endsolid " << name << "\n";
  }
  out.flush();
}

}  // namespace mesh_files

#endif
