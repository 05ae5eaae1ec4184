// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_MSH_H
#define MESH_FILES_WRITE_MSH_H

#include "Buffer.h"
#include "Output.h"
#include "Polygon_soup.h"
#include "Segmented_soup.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace mesh_files {

/// Writes a Gmsh file, version 4.1, as text: a surface and a physical group for each label, both with the tag label + 1,
/// since Gmsh counts from 1; the group is called `segment_<label>`. Polygons are cut into triangles, from which alone Gmsh
/// makes a geometry. Nodes have the numbers of the points, from 1; those between segments belong to the lowest label.
inline void write_msh(Output& file, const Segmented_soup& mesh) {
  const Small_faces triangles = small_faces(mesh, 3);
  const auto& points = triangles.soup.points;
  const auto segments = faces_of_labels(triangles.label);
  constexpr std::size_t no_label = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> label_of_point(points.size(), no_label);
  for (std::size_t f = 0; f < triangles.label.size(); ++f)
    for (const auto corner : triangles.soup.face(f))
      label_of_point[corner] = std::min(label_of_point[corner], triangles.label[f]);
  std::map<std::size_t, std::vector<std::size_t>> points_of;
  for (std::size_t v = 0; v < points.size(); ++v)  // a node must be on some surface
    points_of[label_of_point[v] == no_label && !segments.empty() ? segments.begin()->first : label_of_point[v]]
        .push_back(v);

  Buffer out(file);
  const auto line = [&](const auto& numbers) {
    bool is_first = true;
    for (const auto number : numbers) {
      if (!is_first) out << " ";
      is_first = false;
      out.number(number);
    }
    out << "\n";
  };
  const auto coordinates = [&](std::size_t v) { return std::array{points[v].x(), points[v].y(), points[v].z()}; };
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n";
  out.number(segments.size());
  out << "\n";
  for (const auto& [label, own] : segments)
    out << "2 " << std::to_string(label + 1) << " \"" << name_of_segment(label) << "\"\n";
  out << "$EndPhysicalNames\n$Entities\n";
  line(std::array<std::size_t, 4>{0, 0, segments.size(), 0});
  for (const auto& [label, own] : segments) {
    std::array<double, 6> box;
    std::fill(box.begin(), box.begin() + 3, std::numeric_limits<double>::max());
    std::fill(box.begin() + 3, box.end(), std::numeric_limits<double>::lowest());
    for (const std::size_t f : own)
      for (const auto corner : triangles.soup.face(f))
        for (std::size_t i = 0; i < 3; ++i) {
          box[i] = std::min(box[i], coordinates(corner)[i]);
          box[i + 3] = std::max(box[i + 3], coordinates(corner)[i]);
        }
    out.number(label + 1);
    out.row(box);
    out << " 1 " << std::to_string(label + 1) << " 0\n";
  }
  out << "$EndEntities\n$Nodes\n";
  line(std::array<std::size_t, 4>{points_of.size(), points.size(), 1, points.size()});
  for (const auto& [label, own] : points_of) {
    line(std::array<std::size_t, 4>{2, label + 1, 0, own.size()});
    for (const std::size_t v : own) line(std::array{v + 1});
    for (const std::size_t v : own) line(coordinates(v));
  }
  out << "$EndNodes\n$Elements\n";

  constexpr std::size_t triangle = 2;
  line(std::array<std::size_t, 4>{segments.size(), triangles.label.size(), 1, triangles.label.size()});
  for (const auto& [label, own] : segments) {
    line(std::array<std::size_t, 4>{2, label + 1, triangle, own.size()});
    for (const std::size_t f : own) {
      out.number(f + 1);
      for (const auto corner : triangles.soup.face(f)) {
        out << " ";
        out.number(corner + std::size_t(1));
      }
      out << "\n";
    }
  }
  out << "$EndElements\n";
  out.flush();
}

}  // namespace mesh_files

#endif
