// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_MESH_H
#define MESH_FILES_READ_MESH_H

#include "Format.h"
#include "Polygon_soup.h"
#include "Text.h"
#include "read_3mf.h"
#include "read_content.h"
#include "read_medit.h"
#include "read_msh.h"
#include "read_obj.h"
#include "read_off.h"
#include "read_ply.h"
#include "read_stl.h"
#include "read_vtp.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace mesh_files {

/// The format whose mark a content has.
inline std::optional<Format> format_of_content(std::string_view content) {
  for (const auto order : {Numbers::Order::little, Numbers::Order::big})
    if (medit::is_binary(content, order)) return Format::medit;
  if (vtp::is_vtk_file(content)) return Format::vtp;
  if (is_3mf(content)) return Format::three_mf;
  Text text("", content.substr(0, 1 << 16));
  if (!text.next_line()) return std::nullopt;
  const std::string_view word = text.word();
  if (word == "ply") return Format::ply;
  if (word == "$MeshFormat") return Format::msh;
  if (word == medit::mark) return Format::medit;
  if (is_word(word, "solid")) return Format::stl;
  const bool is_off = off::mark_of(word.substr(0, word.find_last_not_of("0123456789") + 1)).is_off;
  return is_off ? std::optional(Format::off) : std::nullopt;
}

/// Whether a text begins as OBJ files do, which have no mark.
inline bool may_be_obj(std::string_view content) {
  Text text("", content.substr(0, 1 << 16));
  if (!text.next_line()) return false;
  const std::string_view word = text.word();
  for (const char* keyword : {"v", "vn", "vt", "f", "g", "o", "s", "mtllib", "usemtl"})
    if (word == keyword) return true;
  return false;
}

/// The mesh in a file that is not packed, see `mesh_of_content()`.
inline Polygon_soup mesh_of_unpacked(const std::string& path, std::string_view content,
                                     const std::optional<Format>& given) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (content.substr(0, byte_order_mark.size()) == byte_order_mark) content.remove_prefix(byte_order_mark.size());
  const std::size_t blanks = std::min(content.find_first_not_of(" \t\r\n\v\f"), content.size());
  if (blanks == content.size()) throw Unreadable_file(path + ": the file is empty");
  if (!is_zip(content) && stl::is_binary(content)) return read_stl(path, content);
  refuse_other_content(path, content.substr(blanks));

  // A mark tells more than a name.
  const std::optional<Format> marked = format_of_content(content);
  std::optional<Format> format = given ? given : marked ? marked : format_of_path(path);
  if (is_zip(content) && format != Format::three_mf)
    throw Unreadable_file(path + ": this is a ZIP archive; unpack it first");
  if (!format && may_be_obj(content)) format = Format::obj;
  if (!format) throw Unreadable_file(path + ": this is no OFF, PLY, OBJ, STL, 3MF, Gmsh, Medit or VTP file");
  switch (*format) {
    case Format::off:
      return read_off(path, content);
    case Format::obj:
      return read_obj(path, content);
    case Format::stl:
      return read_stl(path, content);
    case Format::msh:
      return read_msh(path, content);
    case Format::medit:
      return read_medit(path, content);
    case Format::vtp:
      return read_vtp(path, content);
    case Format::three_mf:
      return read_3mf(path, content);
    case Format::ply:
      break;
  }
  if (marked != Format::ply) throw Unreadable_file(path + ": a PLY file starts with \"ply\", this one does not");
  return read_ply(path, content);
}

/// The mesh in an OFF, PLY, OBJ, STL, 3MF, Gmsh, Medit or VTP file, which may be packed by gzip. The content decides which it
/// is; the extension does where the content has no mark of its own, as in OBJ files. Byte order marks and blanks at the beginning are
/// passed over.
/// \param path for the extension and messages; nothing is read from there
/// \param format in place of the one that the path names
/// \throws Unreadable_file if the content is broken, or promises more than it holds
inline Polygon_soup mesh_of_content(const std::string& path, std::string_view content,
                                    const std::optional<Format>& format = std::nullopt) {
  Polygon_soup soup = is_gzip(content) && !stl::is_binary(content)
                          ? mesh_of_unpacked(path, unpacked(path, content), format)
                          : mesh_of_unpacked(path, content, format);
  constexpr std::size_t limit = std::numeric_limits<Polygon_soup::Index>::max() / 2;
  if (soup.points.size() > limit || soup.corners.size() > limit)
    throw Unreadable_file(path + ": more vertices or corners of faces than 32 bits can number");
  return soup;
}

/// Reads an OFF, PLY, OBJ, STL, 3MF, Gmsh, Medit or VTP file, or standard input for "-", see `mesh_of_content()`.
/// \throws Unreadable_file if there is no such file, too
inline Polygon_soup read_mesh(const std::string& path, const std::optional<Format>& format = std::nullopt) {
  return mesh_of_content(path, File_content(path).bytes(), format);
}

}  // namespace mesh_files

#endif
