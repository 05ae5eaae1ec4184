// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_OFF_H
#define MESH_FILES_WRITE_OFF_H

#include "Buffer.h"
#include "Colors.h"
#include "Output.h"
#include "Polygon_soup.h"

#include <cstddef>

namespace mesh_files {

/// Writes a text OFF file, or COFF where points have colours.
inline void write_off(Output& file, const Polygon_soup& soup, const Colors& colors) {
  Buffer out(file);
  out << (colors.of_points.empty() ? "OFF\n" : "COFF\n");
  out.number(soup.points.size());
  out << " ";
  out.number(soup.number_of_faces());
  out << " 0\n";
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const auto& p = soup.points[v];
    out.number(p.x());
    out << " ";
    out.number(p.y());
    out << " ";
    out.number(p.z());
    if (!colors.of_points.empty()) {
      out.row(colors.of_points[v]);
      out << " 255";  // opaque
    }
    out << "\n";
  }
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    out.number(soup.face(f).size());
    out.row(soup.face(f));
    if (!colors.of_faces.empty()) out.row(colors.of_faces[f]);
    out << "\n";
  }
  out.flush();
}

}  // namespace mesh_files

#endif
