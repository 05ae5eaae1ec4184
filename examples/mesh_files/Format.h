// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_FORMAT_H
#define MESH_FILES_FORMAT_H

#include <array>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mesh_files {

/// The extension of a path in lower case, with the dot.
inline std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

/// The formats that are read.
enum class Format { off, ply, obj, stl, msh, medit, vtp, three_mf };

/// What files of a format end with, without the dot.
inline const std::array<std::pair<const char*, Format>, 9> format_names = {{{"off", Format::off},
                                                                            {"ply", Format::ply},
                                                                            {"obj", Format::obj},
                                                                            {"stl", Format::stl},
                                                                            {"msh", Format::msh},
                                                                            {"mesh", Format::medit},
                                                                            {"meshb", Format::medit},
                                                                            {"vtp", Format::vtp},
                                                                            {"3mf", Format::three_mf}}};

/// The format that a path names, before ".gz" if that is there.
inline std::optional<Format> format_of_path(const std::string& path) {
  std::string extension = extension_of(path);
  if (extension == ".gz") extension = extension_of(std::filesystem::path(path).stem().string());
  for (const auto& [name, format] : format_names)
    if (extension == std::string(".") + name) return format;
  return std::nullopt;
}

/// The formats of meshes that are written.
enum class Output_format { ply, off, obj, stl, text_stl, glb, three_mf, msh, medit, vtp };

/// What files of a format end with, without the dot; the last one is told from the other STL by its name only.
inline const std::vector<std::pair<std::string, Output_format>> output_format_names = {
    {"ply", Output_format::ply},          {"off", Output_format::off},    {"obj", Output_format::obj},
    {"stl", Output_format::stl},          {"glb", Output_format::glb},    {"3mf", Output_format::three_mf},
    {"msh", Output_format::msh},          {"mesh", Output_format::medit}, {"vtp", Output_format::vtp},
    {"stl-text", Output_format::text_stl}};

}  // namespace mesh_files

#endif
