// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_MEDIT_H
#define MESH_FILES_WRITE_MEDIT_H

#include "Buffer.h"
#include "Output.h"
#include "Polygon_soup.h"
#include "Segmented_soup.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace mesh_files {

/// Writes a Medit file as text, for mmg and others: the label is the reference of each triangle, and the edges between
/// segments are ridges, which remeshers keep. They are not required edges, with which meshio reads no file. Polygons are cut into triangles.
inline void write_medit(Output& file, const Segmented_soup& mesh) {
  using Index = Polygon_soup::Index;
  const Small_faces triangles = small_faces(mesh, 3);
  std::vector<std::tuple<Index, Index, std::size_t>> sides;  // lower and higher corner, label
  sides.reserve(triangles.soup.corners.size());
  for (std::size_t f = 0; f < triangles.label.size(); ++f) {
    const auto corners = triangles.soup.face(f);
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(corners[i], corners[(i + 1) % 3]);
      sides.emplace_back(a, b, triangles.label[f]);
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::pair<Index, Index>> edges;
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const auto& [a, b, label] = sides[i];
    const auto& [next_a, next_b, next_label] = sides[i + 1];
    const std::pair edge(a, b);
    if (edge == std::pair(next_a, next_b) && label != next_label && (edges.empty() || edges.back() != edge))
      edges.push_back(edge);
  }

  Buffer out(file);
  const auto begin = [&](std::string_view keyword, std::size_t number) {
    out << keyword << "\n";
    out.number(number);
    out << "\n";
  };
  out << "MeshVersionFormatted 2\nDimension 3\n";
  begin("Vertices", mesh.soup.points.size());
  for (const auto& p : mesh.soup.points) {
    out.number(p.x());
    out.row(std::array{p.y(), p.z()});
    out << " 0\n";
  }
  begin("Triangles", triangles.label.size());
  for (std::size_t f = 0; f < triangles.label.size(); ++f) {
    for (const auto corner : triangles.soup.face(f)) {
      out.number(corner + std::size_t(1));
      out << " ";
    }
    out.number(triangles.label[f]);
    out << "\n";
  }
  if (!edges.empty()) {
    begin("Edges", edges.size());
    for (const auto& [a, b] : edges) {
      out.number(a + std::size_t(1));
      out.row(std::array{b + std::size_t(1), std::size_t(0)});
      out << "\n";
    }
    begin("Ridges", edges.size());
    for (std::size_t e = 1; e <= edges.size(); ++e) {
      out.number(e);
      out << "\n";
    }
  }
  out << "End\n";
  out.flush();
}

}  // namespace mesh_files

#endif
