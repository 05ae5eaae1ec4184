// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_OBJ_H
#define MESH_FILES_READ_OBJ_H

#include "Polygon_soup.h"
#include "Text.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

namespace mesh_files {

/// Reads the vertices and faces of a Wavefront OBJ file; everything else is passed over.
inline Polygon_soup read_obj(const std::string& path, std::string_view content) {
  Text text(path, content, Text::Backslash::joins_lines);
  Polygon_soup soup;
  // A face may name vertices that come later, so the largest number is held against their count at the end.
  std::int64_t largest = 0;
  std::size_t line_of_largest = 0;
  while (text.next_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "v") {
      soup.points.push_back(text.point());
    } else if (keyword == "f" || keyword == "fo") {  // the latter in files of the first years
      while (!text.at_end_of_line()) {
        // "7", "7/2", "7/2/5" or "7//5": vertex, texture, normal. Negative numbers count back from the last.
        const std::string_view corner = text.word();
        std::int64_t number = 0;
        const auto [end, error] = std::from_chars(corner.data(), corner.data() + corner.size(), number);
        const bool ends_well = end == corner.data() + corner.size() || *end == '/';
        if (error != std::errc() || !ends_well) text.fail("the corner of a face is " + printable(corner));
        const auto vertices = static_cast<std::int64_t>(soup.points.size());
        if (number == 0 || number < -vertices || number > std::numeric_limits<Polygon_soup::Index>::max())
          text.fail("the face names vertex " + std::to_string(number) + ", the file has " + std::to_string(vertices) +
                    " up to here (the first is vertex 1)");
        const std::int64_t vertex = number > 0 ? number : vertices + 1 + number;
        if (vertex > largest) {
          largest = vertex;
          line_of_largest = text.number_of_line();
        }
        soup.corners.push_back(static_cast<Polygon_soup::Index>(vertex - 1));
      }
      soup.end_face();
    }
  }
  if (soup.points.empty()) throw Unreadable_file(path + ": no line of the file is an OBJ vertex (\"v x y z\")");
  if (static_cast<std::size_t>(largest) > soup.points.size())
    text.fail_at_line(line_of_largest, "the face names vertex " + std::to_string(largest) + ", the file has " +
                                           std::to_string(soup.points.size()));
  return soup;
}

}  // namespace mesh_files

#endif
