// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_PLY_H
#define MESH_FILES_WRITE_PLY_H

#include "Buffer.h"
#include "Colors.h"
#include "Output.h"
#include "Polygon_soup.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace mesh_files {

/// Writes a binary PLY file with a label ("segment") for each face, and the colours.
/// \param face_labels below 2^32
inline void write_ply(Buffer& out, const Polygon_soup& soup, const Colors& colors,
                      const std::vector<std::size_t>& face_labels) {
  constexpr std::string_view color_properties = "\nproperty uchar red\nproperty uchar green\nproperty uchar blue";
  const auto write = [](Buffer& out, const Color& color) {
    for (const auto channel : color) out.binary(channel);
  };
  std::size_t largest_degree = 0;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    largest_degree = std::max<std::size_t>(largest_degree, soup.face(f).size());
  const bool has_small_degrees = largest_degree < 256;  // readers expect one byte where it will do

  out << "ply\nformat binary_little_endian 1.0\nelement vertex ";
  out.number(soup.points.size());
  out << "\nproperty double x\nproperty double y\nproperty double z";
  if (!colors.of_points.empty()) out << color_properties;
  out << "\nelement face ";
  out.number(soup.number_of_faces());
  out << (has_small_degrees ? "\nproperty list uchar int vertex_indices" : "\nproperty list uint int vertex_indices");
  if (!colors.of_faces.empty()) out << color_properties;
  out << "\nproperty uint segment\nend_header\n";
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    for (int i = 0; i < 3; ++i) out.binary(soup.points[v][i]);
    if (!colors.of_points.empty()) write(out, colors.of_points[v]);
  }
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const auto corners = soup.face(f);
    if (has_small_degrees)
      out.binary(static_cast<std::uint8_t>(corners.size()));
    else
      out.binary(static_cast<std::uint32_t>(corners.size()));
    for (const auto corner : corners) out.binary(static_cast<std::int32_t>(corner));
    if (!colors.of_faces.empty()) write(out, colors.of_faces[f]);
    out.binary(static_cast<std::uint32_t>(face_labels[f]));
  }
  out.flush();
}

/// \throws Unwritable_file if a label is too large for the format
inline void write_ply(Output& file, const Polygon_soup& soup, const Colors& colors,
                      const std::vector<std::size_t>& face_labels) {
  for (const std::size_t label : face_labels)
    if (label > std::numeric_limits<std::uint32_t>::max())
      throw Unwritable_file(file.path() + ": the label " + std::to_string(label) + " is too large for this format");
  Buffer out(file);
  write_ply(out, soup, colors, face_labels);
}

}  // namespace mesh_files

#endif
