// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_OFF_H
#define MESH_FILES_READ_OFF_H

#include "Polygon_soup.h"
#include "Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mesh_files {
namespace off {

/// How vertices and faces follow each other: each begins a line, behind which there may be more, such as colours; or
/// numbers run on wherever lines end, and there are none but those of the mesh.
enum class Layout { lines, free };

/// What the first lines of an OFF file tell.
struct Header {
  std::uint64_t vertices = 0, faces = 0;
  bool has_weights = false;  ///< a fourth coordinate, by which the others are divided
};

/// The letters that a file begins with, in capitals or not, and what they promise.
struct Mark {
  bool is_off = false, has_weights = false, has_dimensions = false;
};

inline Mark mark_of(std::string_view word) {
  Mark mark;
  const bool is_small = word.size() >= 3 && word.substr(word.size() - 3) == "off";
  const auto take = [&](std::string_view letters) {
    const bool is_there = word.substr(0, letters.size()) == letters;
    if (is_there) word.remove_prefix(letters.size());
    return is_there;
  };
  take(is_small ? "st" : "ST");
  take(is_small ? "c" : "C");
  take(is_small ? "n" : "N");  // normals; before "OFF", "n" is something else
  mark.has_weights = take("4");
  mark.has_dimensions = take("n");
  mark.is_off = word == "OFF" || word == "off";
  return mark;
}

/// Reads the header: "OFF 8 6 12", "OFF8 6 12" or no more than "8 6 12", on one line or several.
inline Header read_header(Text& text, std::size_t size_of_file) {
  Header header;
  const std::string_view word = text.word();
  const std::size_t letters = word.find_last_not_of("0123456789") + 1;
  std::optional<std::uint64_t> vertices = number_in<std::uint64_t>(word.substr(letters));
  if (letters > 0) {
    const Mark mark = mark_of(word.substr(0, letters));
    if (!mark.is_off) text.fail("an OFF file starts with OFF, this one with " + printable(word));
    header.has_weights = mark.has_weights;
    if (!vertices && !text.next_word()) text.fail_at_end("the header");
    if (mark.has_dimensions) {
      const std::uint64_t dimensions = text.count("the number of dimensions");
      if (dimensions != 3) text.fail("the mesh has " + std::to_string(dimensions) + " dimensions, and only 3 are read");
      if (!text.next_word()) text.fail_at_end("the number of dimensions");
    }
  }
  if (is_word(text.rest_of_line().substr(0, 6), "binary"))
    text.fail("this is a binary OFF file, which is not supported");
  header.vertices = vertices ? *vertices : text.count("the number of vertices");
  if (!text.next_word()) text.fail_at_end("the number of vertices");
  header.faces = text.count("the number of faces");
  // A vertex takes six bytes or more ("0 0 0" and a line end), a face two.
  if (header.vertices > size_of_file / 5 || header.faces > size_of_file / 2)
    text.fail("the header promises " + std::to_string(header.vertices) + " vertices and " +
              std::to_string(header.faces) + " faces, more than the file has room for");
  return header;
}

inline Polygon_soup::Point read_point(Text& text, bool has_weight, Layout layout) {
  if (layout == Layout::lines && !has_weight) return text.point();
  constexpr std::array<const char*, 4> names = {"the x coordinate", "the y coordinate", "the z coordinate",
                                                "the weight of the vertex"};
  std::array<double, 4> p = {0, 0, 0, 1};
  for (std::size_t i = 0; i < (has_weight ? 4U : 3U); ++i) {
    if (layout == Layout::free) text.next_word();
    p[i] = text.coordinate(names[i]);
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (p[3] == 0 || !std::isfinite(p[i] / p[3]))
      text.fail("a vertex at infinity: its weight is " + std::to_string(p[3]));
  return {p[0] / p[3], p[1] / p[3], p[2] / p[3]};
}

/// A face may go on over line ends. Where lines count, its last corner then ends its line, or a corner is missing.
inline void read_face(Text& text, std::uint64_t vertices, Layout layout, Polygon_soup& soup) {
  const std::size_t line = text.number_of_line();
  const std::uint64_t degree = text.count("the number of corners");
  bool is_wrapped = false;
  for (std::uint64_t i = 0; i < degree; ++i) {
    is_wrapped = is_wrapped || text.at_end_of_line();
    if (!text.next_word()) text.fail_at_line(line, "a corner of the face is missing");
    const std::uint64_t corner = text.count("a corner of the face");
    if (corner >= vertices)
      text.fail("the face names vertex " + std::to_string(corner) + ", the file has " + std::to_string(vertices) +
                " (the first is vertex 0)");
    soup.corners.push_back(static_cast<Polygon_soup::Index>(corner));
  }
  if (layout == Layout::lines && is_wrapped && !text.at_end_of_line())
    text.fail_at_line(line, "a corner of the face is missing");
  soup.end_face();
}

inline Polygon_soup read(const std::string& path, std::string_view content, Layout layout) {
  Text text(path, content);
  if (!text.next_line()) throw Unreadable_file(path + ": the file is empty");
  const Header header = read_header(text, content.size());
  if (layout == Layout::free && text.next_word()) text.count("the number of edges");
  const auto next_item = [&](std::uint64_t item, std::uint64_t items, const char* name) {
    if (layout == Layout::lines ? !text.next_line() : !text.next_word()) text.fail_at_end(count_of(item, items, name));
  };

  Polygon_soup soup;
  soup.points.reserve(header.vertices);
  for (std::uint64_t v = 0; v < header.vertices; ++v) {
    next_item(v, header.vertices, "vertices");
    soup.points.push_back(read_point(text, header.has_weights, layout));
  }
  soup.first_corner.reserve(header.faces + 1);
  soup.corners.reserve(3 * header.faces);
  for (std::uint64_t f = 0; f < header.faces; ++f) {
    next_item(f, header.faces, "faces");
    read_face(text, header.vertices, layout, soup);
  }
  if (layout == Layout::free && text.next_word()) text.fail("there is more than the header promises");
  return soup;
}

}  // namespace off

/// Reads an OFF file (http://www.geomview.org/docs/html/OFF.html) in text form. Normals, colours and texture coordinates
/// are passed over; they are known from the lines, of which each vertex and each face begins one. A file that is wrong
/// in that way is read as numbers that run on wherever lines end, if that leaves none over.
inline Polygon_soup read_off(const std::string& path, std::string_view content) {
  try {
    return off::read(path, content, off::Layout::lines);
  } catch (const Unreadable_file&) {
    try {
      return off::read(path, content, off::Layout::free);
    } catch (const Unreadable_file&) {
    }
    throw;
  }
}

}  // namespace mesh_files

#endif
