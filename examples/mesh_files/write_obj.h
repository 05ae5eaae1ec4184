// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_OBJ_H
#define MESH_FILES_WRITE_OBJ_H

#include "Buffer.h"
#include "Colors.h"
#include "Output.h"
#include "Polygon_soup.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace mesh_files {

/// Writes a Wavefront OBJ file: a group and a material `segment_<label>` for each label, and the colours of points
/// behind their coordinates. Faces come segment by segment, in their order within each.
/// \param material_library name of the file with the materials
inline void write_obj(Output& file, const std::string& material_library, const Polygon_soup& soup, const Colors& colors,
                      const std::vector<std::size_t>& face_labels) {
  std::vector<std::size_t> faces(soup.number_of_faces());
  std::iota(faces.begin(), faces.end(), std::size_t(0));
  std::stable_sort(faces.begin(), faces.end(),
                   [&](std::size_t a, std::size_t b) { return face_labels[a] < face_labels[b]; });

  Buffer out(file);
  out << "mtllib " << material_library << "\n";
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const auto& p = soup.points[v];
    out << "v";
    out.row(std::vector{p.x(), p.y(), p.z()});
    if (!colors.of_points.empty())
      for (const auto channel : colors.of_points[v]) {
        out << " ";
        out.number(channel / 255.F);
      }
    out << "\n";
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const std::size_t label = face_labels[faces[i]];
    if (i == 0 || label != face_labels[faces[i - 1]]) {
      const std::string name = "segment_" + std::to_string(label);
      out << "g " << name << "\nusemtl " << name << "\n";
    }
    out << "f";
    for (const auto corner : soup.face(faces[i])) {
      out << " ";
      out.number(corner + std::size_t(1));
    }
    out << "\n";
  }
  out.flush();
}

/// Writes the materials of an OBJ file: `segment_<label>` for each label.
inline void write_materials(Output& file, const std::map<std::size_t, Color>& color_of_label) {
  Buffer out(file);
  for (const auto& [label, color] : color_of_label) {
    out << "newmtl segment_" << std::to_string(label) << "\nKd";
    for (const auto channel : color) {
      out << " ";
      out.number(channel / 255.F);
    }
    out << "\n";
  }
  out.flush();
}

}  // namespace mesh_files

#endif
