// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_OFF_H
#define MESH_FILES_READ_OFF_H

#include "Polygon_soup.h"
#include "Text.h"
#include "pieces.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// How many lines of a piece have a word in them.
inline std::uint64_t number_of_items(std::string_view piece) {
  // Most files have nothing but lines that begin with a number. Their ends are counted in bytes, many at a time.
  const auto is_odd = [](char c) {
    return static_cast<std::uint8_t>(static_cast<std::uint8_t>(c) <= ' ') | static_cast<std::uint8_t>(c == '#') |
           static_cast<std::uint8_t>(c == '\\');
  };
  constexpr std::size_t block = 128;  // less than a byte can count
  const std::size_t last = piece.size() - 1;
  std::uint64_t ends = 1;  // the last line's
  bool has_odd = is_odd(piece[0]) != 0 || piece.find('\r') != std::string_view::npos;
  for (std::size_t begin = 0; begin < last && !has_odd; begin += block) {
    std::uint8_t ends_here = 0, odd_here = 0;
    for (std::size_t i = begin, end = std::min(begin + block, last); i < end; ++i) {
      const auto is_end = static_cast<std::uint8_t>(piece[i] == '\n');
      ends_here = static_cast<std::uint8_t>(ends_here + is_end);
      odd_here = static_cast<std::uint8_t>(odd_here | (is_end & is_odd(piece[i + 1])));
    }
    ends += ends_here;
    has_odd = odd_here != 0;
  }
  if (!has_odd) return ends;
  std::uint64_t items = 0;
  for (Text text("", piece); text.next_line();) ++items;
  return items;
}

/// Reads vertices and faces, each on a line of its own, in pieces of the text at the same time.
/// \returns nothing if one takes several lines or is wrong, which reading one after the other tells
inline std::optional<Polygon_soup> read_pieces(const Header& header, std::string_view content, std::size_t size) {
  const std::vector<std::string_view> texts = pieces_of(content, size);
  std::vector<std::uint64_t> first_item(texts.size() + 1, 0);
  for_each_piece(texts.size(), [&](std::size_t i) { first_item[i + 1] = number_of_items(texts[i]); });
  std::partial_sum(first_item.begin(), first_item.end(), first_item.begin());
  const std::uint64_t items = header.vertices + header.faces;
  if (first_item.back() < items) return std::nullopt;

  Polygon_soup soup;
  soup.points.resize(header.vertices);
  std::vector<Polygon_soup> faces(texts.size());
  std::atomic<bool> is_wrapped = false;
  const auto read_piece = [&](std::size_t i) {
    Text text("", texts[i]);
    const std::uint64_t end = std::min(first_item[i + 1], items);
    if (end > header.vertices && end > first_item[i]) {
      faces[i].first_corner.reserve(end - first_item[i] + 1);
      faces[i].corners.reserve(3 * (end - first_item[i]));
    }
    for (std::uint64_t item = first_item[i]; item < end && !is_wrapped; ++item) {
      text.next_line();
      const std::size_t line = text.number_of_line();
      if (item < header.vertices)
        soup.points[item] = read_point(text, header.has_weights, Layout::lines);
      else
        read_face(text, header.vertices, Layout::lines, faces[i]);
      if (text.number_of_line() != line) is_wrapped = true;
    }
  };
  try {
    for_each_piece(texts.size(), read_piece);
  } catch (const Unreadable_file&) {
    return std::nullopt;
  }
  if (is_wrapped) return std::nullopt;
  append_faces(faces, soup);
  return soup;
}

inline Polygon_soup read(const std::string& path, std::string_view content, Layout layout,
                         [[maybe_unused]] std::size_t size_of_a_piece) {
  Text text(path, content);
  if (!text.next_line()) throw Unreadable_file(path + ": the file is empty");
  const Header header = read_header(text, content.size());
  if (layout == Layout::free && text.next_word()) text.count("the number of edges");
  if constexpr (reads_pieces)
    if (layout == Layout::lines && text.rest().size() > size_of_a_piece)
      if (std::optional<Polygon_soup> soup = read_pieces(header, text.rest(), size_of_a_piece)) return std::move(*soup);
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
/// \param size_of_a_piece what a thread reads at once, in bytes
inline Polygon_soup read_off(const std::string& path, std::string_view content,
                             std::size_t size_of_a_piece = size_of_pieces) {
  try {
    return off::read(path, content, off::Layout::lines, size_of_a_piece);
  } catch (const Unreadable_file&) {
    try {
      return off::read(path, content, off::Layout::free, size_of_a_piece);
    } catch (const Unreadable_file&) {
    }
    throw;
  }
}

}  // namespace mesh_files

#endif
