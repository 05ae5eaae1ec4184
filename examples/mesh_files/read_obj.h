// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_OBJ_H
#define MESH_FILES_READ_OBJ_H

#include "Polygon_soup.h"
#include "Text.h"
#include "pieces.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace mesh_files {

namespace obj {

/// What reading a file, or a piece of one, has come to.
struct Contents {
  Polygon_soup soup;
  /// A face may name vertices that come later, so the largest number is held against their count at the end.
  std::int64_t largest = 0;
  std::size_t line_of_largest = 0;
};

/// Reads the corners that are left of a line: "7", "7/2", "7/2/5" or "7//5": vertex, texture, normal. Negative numbers count
/// back from the last vertex.
/// \param vertices that the lines before have
inline void read_face(Text& text, std::int64_t vertices, Contents& contents) {
  while (!text.at_end_of_line()) {
    const std::string_view corner = text.word();
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(corner.data(), corner.data() + corner.size(), number);
    const bool ends_well = end == corner.data() + corner.size() || *end == '/';
    if (error != std::errc() || !ends_well) text.fail("the corner of a face is " + printable(corner));
    if (number == 0 || number < -vertices || number > std::numeric_limits<Polygon_soup::Index>::max())
      text.fail("the face names vertex " + std::to_string(number) + ", the file has " + std::to_string(vertices) +
                " up to here (the first is vertex 1)");
    const std::int64_t vertex = number > 0 ? number : vertices + 1 + number;
    if (vertex > contents.largest) {
      contents.largest = vertex;
      contents.line_of_largest = text.number_of_line();
    }
    contents.soup.corners.push_back(static_cast<Polygon_soup::Index>(vertex - 1));
  }
  contents.soup.end_face();
}

/// \param counts_back whether faces may have negative numbers, which need all vertices before them
inline Contents read_lines(Text& text, bool counts_back) {
  Contents contents;
  while (text.next_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "v")
      contents.soup.points.push_back(text.point());
    else if (keyword == "f" || keyword == "fo")  // the latter in files of the first years
      read_face(text, counts_back ? static_cast<std::int64_t>(contents.soup.points.size()) : 0, contents);
  }
  return contents;
}

/// Reads pieces of the text at the same time.
/// \returns nothing if a number is negative or something is wrong, which reading one after the other tells
inline std::optional<Polygon_soup> read_pieces(std::string_view content, std::size_t size) {
  const std::vector<std::string_view> texts = pieces_of(content, size);
  std::vector<Polygon_soup> pieces(texts.size());
  std::vector<std::int64_t> largest(texts.size());
  try {
    for_each_piece(texts.size(), [&](std::size_t i) {
      Text text("", texts[i], Text::Backslash::joins_lines);
      Contents contents = read_lines(text, false);
      pieces[i] = std::move(contents.soup);
      largest[i] = contents.largest;
    });
  } catch (const Unreadable_file&) {
    return std::nullopt;
  }
  Polygon_soup soup;
  std::vector<std::size_t> first_point = {0};
  for (const Polygon_soup& piece : pieces) first_point.push_back(first_point.back() + piece.points.size());
  if (*std::max_element(largest.begin(), largest.end()) > static_cast<std::int64_t>(first_point.back()))
    return std::nullopt;
  soup.points.resize(first_point.back());
  for_each_piece(pieces.size(), [&](std::size_t i) {
    const std::vector<Polygon_soup::Point> points = std::move(pieces[i].points);
    std::copy(points.begin(), points.end(), soup.points.begin() + static_cast<std::ptrdiff_t>(first_point[i]));
  });
  append_faces(pieces, soup);
  return soup;
}

}  // namespace obj

/// Reads the vertices and faces of a Wavefront OBJ file; everything else is passed over.
/// \param size_of_a_piece what a thread reads at once, in bytes
inline Polygon_soup read_obj(const std::string& path, std::string_view content,
                             [[maybe_unused]] std::size_t size_of_a_piece = size_of_pieces) {
  if constexpr (reads_pieces)
    if (content.size() > size_of_a_piece)
      if (std::optional<Polygon_soup> soup = obj::read_pieces(content, size_of_a_piece); soup && !soup->points.empty())
        return std::move(*soup);
  Text text(path, content, Text::Backslash::joins_lines);
  obj::Contents contents = obj::read_lines(text, true);
  if (contents.soup.points.empty())
    throw Unreadable_file(path + ": no line of the file is an OBJ vertex (\"v x y z\")");
  if (static_cast<std::size_t>(contents.largest) > contents.soup.points.size())
    text.fail_at_line(contents.line_of_largest, "the face names vertex " + std::to_string(contents.largest) +
                                                    ", the file has " + std::to_string(contents.soup.points.size()));
  return std::move(contents.soup);
}

}  // namespace mesh_files

#endif
