// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_MESH_H
#define MESH_FILES_WRITE_MESH_H

#include "Colors.h"
#include "Format.h"
#include "Output.h"
#include "Polygon_soup.h"
#include "Segmented_soup.h"
#include "write_3mf.h"
#include "write_columns.h"
#include "write_glb.h"
#include "write_medit.h"
#include "write_msh.h"
#include "write_npz.h"
#include "write_obj.h"
#include "write_off.h"
#include "write_ply.h"
#include "write_stl.h"
#include "write_vtp.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace mesh_files {

/// What concerns some formats only.
struct Output_choices {
  bool has_point_colors = false;  ///< in PLY, OFF and OBJ files, in place of the colours of faces
  std::string material_library;   ///< of OBJ files: the name of that file
};

/// Writes PLY, OFF or OBJ.
inline void write_colored_faces_or_points(Output& file, Output_format format, const Segmented_soup& mesh,
                                          const Output_choices& choices) {
  std::vector<Color> face_colors;
  face_colors.reserve(mesh.face_labels.size());
  for (const std::size_t label : mesh.face_labels) face_colors.push_back(mesh.color_of_label.at(label));
  const Polygon_soup apart = choices.has_point_colors ? with_points_apart(mesh.soup, mesh.face_labels) : Polygon_soup();
  const Polygon_soup& written = choices.has_point_colors ? apart : mesh.soup;
  const Colors colors =
      choices.has_point_colors ? colors_of_points(written, face_colors) : colors_of_faces(std::move(face_colors));
  if (format == Output_format::ply)
    write_ply(file, written, colors, mesh.face_labels);
  else if (format == Output_format::off)
    write_off(file, written, colors);
  else
    write_obj(file, choices.material_library, written, colors, mesh.face_labels);
}

/// Writes a mesh with its segments as the format has them.
inline void write_segments(Output& file, Output_format format, const Segmented_soup& mesh,
                           const Output_choices& choices) {
  switch (format) {
    case Output_format::stl:
      return write_binary_stl(file, mesh);
    case Output_format::text_stl:
      return write_text_stl(file, mesh);
    case Output_format::glb:
      return write_glb(file, mesh);
    case Output_format::three_mf:
      return write_3mf(file, mesh);
    case Output_format::msh:
      return write_msh(file, mesh);
    case Output_format::medit:
      return write_medit(file, mesh);
    case Output_format::vtp:
      return write_vtp(file, mesh);
    case Output_format::ply:
    case Output_format::off:
    case Output_format::obj:
      return write_colored_faces_or_points(file, format, mesh, choices);
  }
}

/// Writes the label of each face: an archive of NumPy's or CSV if the extension (with the dot) says so, else a label a line.
inline void write_labels_as(const std::string& extension, Output& file, const std::vector<std::size_t>& labels) {
  if (extension == ".npz") return write_labels_npz(file, labels);
  if (extension == ".csv") return write_labels_csv(file, labels);
  write_labels(file, labels);
}

}  // namespace mesh_files

#endif
