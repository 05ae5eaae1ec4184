// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_READ_INPUT_H
#define SEGMENT_MESH_READ_INPUT_H

#include "../mesh_files/Format.h"
#include "../mesh_files/Polygon_soup.h"

#include <optional>
#include <string>

namespace segment_mesh {

struct Oriented_mesh;

/// Reads a mesh, by Assimp if it is of a format that nothing here reads.
/// \throws mesh_files::Unreadable_file
mesh_files::Polygon_soup read_input(const std::string& path, const std::optional<mesh_files::Format>& format);

/// \throws mesh_files::Unreadable_file
void refuse_mesh_without_faces(const std::string& path, const mesh_files::Polygon_soup& soup);

/// Where no face of the file has come into the mesh.
/// \throws mesh_files::Unreadable_file
void refuse_mesh_without_faces(const std::string& path, const Oriented_mesh& input);

}  // namespace segment_mesh

#endif
