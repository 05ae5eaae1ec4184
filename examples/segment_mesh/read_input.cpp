// SPDX-License-Identifier: MIT

#include "read_input.h"

#include "../mesh_files/read_content.h"
#include "../mesh_files/read_mesh.h"
#include "Oriented_mesh.h"
#include "read_by_assimp.h"

#include <optional>
#include <string>

namespace segment_mesh {

mesh_files::Polygon_soup read_input(const std::string& path, const std::optional<mesh_files::Format>& format) {
  const mesh_files::File_content content(path);
  const std::string extension = format ? "" : extension_for_assimp(path, content.bytes());
  return extension.empty() ? mesh_files::mesh_of_content(path, content.bytes(), format)
                           : read_by_assimp(path, content.bytes(), extension);
}

void refuse_mesh_without_faces(const std::string& path, const mesh_files::Polygon_soup& soup) {
  if (soup.number_of_faces() > 0) return;
  throw mesh_files::Unreadable_file(path + ": the file has " + counted(soup.points.size(), "vertex", "vertices") +
                                    " and no faces, so that there is no surface to segment");
}

void refuse_mesh_without_faces(const std::string& path, const Oriented_mesh& input) {
  if (input.mesh.number_of_faces() == 0)
    throw mesh_files::Unreadable_file(path + ": no face has three different corners");
}

}  // namespace segment_mesh
