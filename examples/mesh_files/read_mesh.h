// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_MESH_H
#define MESH_FILES_READ_MESH_H

#include "Polygon_soup.h"
#include "read_obj.h"
#include "read_off.h"
#include "read_ply.h"
#include "read_stl.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

namespace mesh_files {

/// The extension of a path in lower case, with the dot.
inline std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

/// All bytes of a file.
inline std::string read_content(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw Unreadable_file(path + ": this is a folder");
  const auto fail = [&] { return Unreadable_file(path + ": " + std::strerror(errno)); };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw fail();
  // The size of a pipe is not known; that of a file spares copies.
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  constexpr std::size_t smallest_block = 1 << 16;
  std::string content(ignored ? smallest_block : static_cast<std::size_t>(size) + 1, '\0');
  std::size_t read = 0;
  for (;;) {
    read += std::fread(content.data() + read, 1, content.size() - read, file.get());
    if (read < content.size()) break;
    content.resize(2 * content.size());
  }
  if (std::ferror(file.get())) throw fail();
  content.resize(read);
  return content;
}

/// The mesh in an OFF, PLY, OBJ or STL file. The content decides which it is; the extension does where the content has
/// no mark of its own, as in OBJ files.
/// \param path for the extension and messages; nothing is read from there
/// \throws Unreadable_file if the content is broken, or promises more than it holds
inline Polygon_soup mesh_of_content(const std::string& path, const std::string& content) {
  const std::string extension = extension_of(path);
  if (std::all_of(content.begin(), content.end(), [](unsigned char c) { return std::isspace(c); }))
    throw Unreadable_file(path + ": the file is empty");
  const auto starts_with = [&](std::string_view mark) { return content.compare(0, mark.size(), mark) == 0; };

  Polygon_soup soup;
  if (starts_with("ply") && content.size() > 3 && std::isspace(static_cast<unsigned char>(content[3])))
    soup = read_ply(path, content);
  else if (extension == ".stl" || starts_with("solid ") || stl::is_binary(content))
    soup = read_stl(path, content);
  else if (extension == ".obj")
    soup = read_obj(path, content);
  else if (extension == ".off" || content.substr(0, content.find_first_of(" \t\r\n")).find("OFF") != std::string::npos)
    soup = read_off(path, content);
  else if (extension == ".ply")
    throw Unreadable_file(path + ": a PLY file starts with \"ply\", this one does not");
  else
    throw Unreadable_file(path + ": this is no OFF, PLY, OBJ or STL file");

  constexpr std::size_t limit = std::numeric_limits<Polygon_soup::Index>::max() / 2;
  if (soup.points.size() > limit || soup.corners.size() > limit)
    throw Unreadable_file(path + ": more vertices or corners of faces than 32 bits can number");
  return soup;
}

/// Reads an OFF, PLY, OBJ or STL file, see `mesh_of_content()`.
/// \throws Unreadable_file if there is no such file, too
inline Polygon_soup read_mesh(const std::string& path) { return mesh_of_content(path, read_content(path)); }

}  // namespace mesh_files

#endif
