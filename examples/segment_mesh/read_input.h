// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_READ_INPUT_H
#define SEGMENT_MESH_READ_INPUT_H

#include "../mesh_files.h"
#include "Oriented_mesh.h"
#include "read_by_assimp.h"

#include <optional>
#include <string>

namespace segment_mesh {

/// Reads a mesh, by Assimp if it is of a format that nothing here reads.
/// \throws mesh_files::Unreadable_file
inline mesh_files::Polygon_soup read_input(const std::string& path, const std::optional<mesh_files::Format>& format) {
  const mesh_files::File_content content(path);
  const std::string extension = format ? "" : extension_for_assimp(path, content.bytes());
  return extension.empty() ? mesh_files::mesh_of_content(path, content.bytes(), format)
                           : read_by_assimp(path, content.bytes(), extension);
}

/// \throws mesh_files::Unreadable_file
inline void refuse_mesh_without_faces(const std::string& path, const mesh_files::Polygon_soup& soup) {
  if (soup.number_of_faces() > 0) return;
  throw mesh_files::Unreadable_file(path + ": the file has " + counted(soup.points.size(), "vertex", "vertices") +
                                    " and no faces, so that there is no surface to segment");
}

}  // namespace segment_mesh

#endif
