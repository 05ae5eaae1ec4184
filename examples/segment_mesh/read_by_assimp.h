// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_READ_BY_ASSIMP_H
#define SEGMENT_MESH_READ_BY_ASSIMP_H

#include "../mesh_files/Polygon_soup.h"

#include <string>
#include <string_view>

namespace segment_mesh {

/// What files that Assimp reads begin with or are called, without the dot: "glb" and the like; empty for all others. Files of
/// the formats that are read without it are none of them.
std::string extension_for_assimp(const std::string& path, std::string_view content);

/// Reads the faces of a file by the library Assimp (https://assimp.org), with the places that the nodes of its scene give
/// them. Each mesh of a node is a part of the soup; within it, corners in equal places become one point.
/// \param path of the file, where its textures and buffers may be; for "-" and pipes they cannot be
/// \param extension see `extension_for_assimp()`
/// \throws mesh_files::Unreadable_file with what Assimp says, or if this program was built without it
mesh_files::Polygon_soup read_by_assimp(const std::string& path, std::string_view content,
                                        const std::string& extension);

}  // namespace segment_mesh

#endif
