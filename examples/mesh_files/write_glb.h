// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_GLB_H
#define MESH_FILES_WRITE_GLB_H

#include "Buffer.h"
#include "Output.h"
#include "Polygon_soup.h"
#include "Segmented_soup.h"
#include "write_stl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace mesh_files {

/// A channel of a colour, of light as it is and not as screens take it (sRGB).
inline double linear_light(std::uint8_t channel) {
  const double c = channel / 255.;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// From where the points of a mesh are stored in single precision: the origin, unless the mesh is so far away, as maps are,
/// that its shape would be lost. Then it is the middle of the box around it, in single precision, too.
/// \param least, most the corners of that box
inline std::array<double, 3> origin_for_floats(const std::array<double, 3>& least, const std::array<double, 3>& most) {
  constexpr double far = 256;  // boxes: 16 bits are left for the coordinates within it
  double extent = 0, distance = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    extent = std::max(extent, most[i] - least[i]);
    distance = std::max({distance, std::abs(least[i]), std::abs(most[i])});
  }
  std::array<double, 3> origin = {0, 0, 0};
  if (!(distance > far * extent)) return origin;
  for (std::size_t i = 0; i < 3; ++i) origin[i] = double(static_cast<float>(least[i] / 2 + most[i] / 2));
  return origin;
}

/// Writes a binary glTF 2.0 file: a mesh with a primitive and a material `segment_<label>` for each label, with "label"
/// among the extras of the primitive. All share the points, which are single precision, from `origin_for_floats()`, to where
/// the node moves them; polygons are cut into triangles.
inline void write_glb(Output& file, const Segmented_soup& mesh) {
  const Small_faces triangles = small_faces(mesh, 3);
  const auto& points = triangles.soup.points;
  const auto segments = faces_of_labels(triangles.label);
  const std::size_t size_of_points = 12 * points.size(), size_of_corners = 4 * triangles.soup.corners.size(),
                    size = size_of_points + size_of_corners;

  std::array<double, 3> lowest, highest;
  lowest.fill(std::numeric_limits<double>::max());
  highest.fill(std::numeric_limits<double>::lowest());
  for (const auto& p : points)
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = p[static_cast<int>(i)];
      float_of(x, file.path());
      lowest[i] = std::min(lowest[i], x);
      highest[i] = std::max(highest[i], x);
    }
  const std::array<double, 3> origin = origin_for_floats(lowest, highest);
  std::array<float, 3> least, most;
  for (std::size_t i = 0; i < 3; ++i) {
    least[i] = static_cast<float>(lowest[i] - origin[i]);
    most[i] = static_cast<float>(highest[i] - origin[i]);
  }

  std::string json;
  Buffer text([&](std::string_view bytes) { json += bytes; });
  const auto list = [&](const auto& values) {
    text << "[";
    bool is_first = true;
    for (const auto value : values) {
      if (!is_first) text << ",";
      is_first = false;
      text.number(value);
    }
    text << "]";
  };
  const auto comma = [&](std::size_t i) { text << (i > 0 ? "," : ""); };
  text << R"({"asset":{"version":"2.0","generator":"RW_segmentation"},"scene":0,"scenes":[{"nodes":[0]}],)"
       << R"("nodes":[{"mesh":0)";
  if (origin != std::array<double, 3>{0, 0, 0}) {
    text << R"(,"translation":)";
    list(origin);
  }
  text << R"(}],"meshes":[{"primitives":[)";
  std::size_t number = 0;
  for (const auto& [label, faces] : segments) {
    comma(number);
    text << R"({"attributes":{"POSITION":0},"indices":)" << std::to_string(number + 1) << R"(,"material":)"
         << std::to_string(number) << R"(,"extras":{"label":)" << std::to_string(label) << "}}";
    ++number;
  }
  text << R"(]}],"materials":[)";
  number = 0;
  for (const auto& [label, faces] : segments) {
    const Color& color = mesh.color_of_label.at(label);
    comma(number++);
    text << R"({"name":")" << name_of_segment(label) << R"(","doubleSided":true,"pbrMetallicRoughness":)"
         << R"({"metallicFactor":0,"baseColorFactor":)";
    list(std::array{linear_light(color[0]), linear_light(color[1]), linear_light(color[2]), 1.});
    text << "}}";
  }
  text << R"(],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)"
       << std::to_string(points.size()) << R"(,"min":)";
  list(least);
  text << R"(,"max":)";
  list(most);
  text << "}";
  std::size_t offset = 0;
  for (const auto& [label, faces] : segments) {
    text << R"(,{"bufferView":1,"byteOffset":)" << std::to_string(offset)
         << R"(,"componentType":5125,"type":"SCALAR","count":)" << std::to_string(3 * faces.size()) << "}";
    offset += 12 * faces.size();
  }
  text << R"(],"bufferViews":[{"buffer":0,"byteLength":)" << std::to_string(size_of_points)
       << R"(,"target":34962},{"buffer":0,"byteOffset":)" << std::to_string(size_of_points) << R"(,"byteLength":)"
       << std::to_string(size_of_corners) << R"(,"target":34963}],"buffers":[{"byteLength":)" << std::to_string(size)
       << "}]}";
  text.flush();
  json.resize((json.size() + 3) / 4 * 4, ' ');

  constexpr std::size_t size_of_headers = 12 + 8 + 8;
  const std::size_t total = size_of_headers + json.size() + size;
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw Unwritable_file(file.path() + ": a binary glTF file holds 4 GiB at most");
  constexpr std::uint32_t magic = 0x46546C67, version = 2, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
  Buffer out(file);
  for (const std::uint32_t word :
       {magic, version, static_cast<std::uint32_t>(total), static_cast<std::uint32_t>(json.size()), json_chunk})
    out.binary(word);
  out << json;
  out.binary(static_cast<std::uint32_t>(size));
  out.binary(binary_chunk);
  for (const auto& p : points)
    for (std::size_t i = 0; i < 3; ++i) out.binary(static_cast<float>(p[static_cast<int>(i)] - origin[i]));
  for (const auto& [label, faces] : segments)
    for (const std::size_t f : faces)
      for (const auto corner : triangles.soup.face(f)) out.binary(static_cast<std::uint32_t>(corner));
  out.flush();
}

}  // namespace mesh_files

#endif
