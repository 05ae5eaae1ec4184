// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_OFF_H
#define MESH_FILES_READ_OFF_H

#include "Polygon_soup.h"
#include "Text.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace mesh_files {

/// Reads an OFF file (http://www.geomview.org/docs/html/OFF.html) in text form: one vertex a line, then one face a
/// line. Normals, colours and texture coordinates are passed over.
inline Polygon_soup read_off(const std::string& path, std::string_view content) {
  Text text(path, content);
  if (!text.next_line()) throw Unreadable_file(path + ": the file is empty");

  std::string_view header = text.word();
  const std::string_view shown = header;
  for (const std::string_view prefix : {"ST", "C", "N"})
    if (header.substr(0, prefix.size()) == prefix) header.remove_prefix(prefix.size());
  if (header == "4OFF" || header == "nOFF" || header == "4nOFF")
    text.fail("the header " + printable(shown) + " is not that of a three-dimensional OFF file");
  if (header != "OFF") text.fail("an OFF file starts with OFF, this one with " + printable(shown));
  if (text.at_end_of_line() && !text.next_line()) text.fail_at_end("the header");
  Text after_header = text;
  if (after_header.word() == "BINARY") text.fail("this is a binary OFF file, which is not supported");

  const std::uint64_t vertices = text.count("the number of vertices");
  if (text.at_end_of_line() && !text.next_line()) text.fail_at_end("the number of vertices");
  const std::uint64_t faces = text.count("the number of faces");
  // A vertex takes six bytes or more ("0 0 0" and a line end), a face two.
  if (vertices > content.size() / 5 || faces > content.size() / 2)
    text.fail("the header promises " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
              " faces, more than the file has room for");

  Polygon_soup soup;
  soup.points.reserve(vertices);
  for (std::uint64_t v = 0; v < vertices; ++v) {
    text.next_item(v, vertices, "vertices");
    soup.points.push_back(text.point());
  }
  soup.first_corner.reserve(faces + 1);
  soup.corners.reserve(3 * faces);
  for (std::uint64_t f = 0; f < faces; ++f) {
    text.next_item(f, faces, "faces");
    const std::uint64_t degree = text.count("the number of corners");
    for (std::uint64_t i = 0; i < degree; ++i) {
      const std::uint64_t corner = text.count("a corner of the face");
      if (corner >= vertices)
        text.fail("the face names vertex " + std::to_string(corner) + ", the file has " + std::to_string(vertices) +
                  " (the first is vertex 0)");
      soup.corners.push_back(static_cast<Polygon_soup::Index>(corner));
    }
    soup.end_face();
  }
  return soup;
}

}  // namespace mesh_files

#endif
