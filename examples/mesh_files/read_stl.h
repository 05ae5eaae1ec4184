// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_STL_H
#define MESH_FILES_READ_STL_H

#include "Polygon_soup.h"
#include "Text.h"

#include <boost/endian/conversion.hpp>
#include <boost/functional/hash.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace mesh_files {

/// Collects the triangles of an STL file, which repeats the coordinates of every corner: corners with equal
/// coordinates become one point.
class Triangle_collector {
 public:
  void add_corner(const Polygon_soup::Point& p) {
    const std::array<double, 3> coordinates = {p.x() + 0., p.y() + 0., p.z() + 0.};  // -0 becomes 0
    const auto [found, is_new] = number_.emplace(coordinates, static_cast<Polygon_soup::Index>(number_.size()));
    if (is_new) soup_.points.push_back(p);
    soup_.corners.push_back(found->second);
    if (soup_.corners.size() % 3 == 0) soup_.end_face();
  }

  Polygon_soup soup() && { return std::move(soup_); }

 private:
  Polygon_soup soup_;
  std::unordered_map<std::array<double, 3>, Polygon_soup::Index, boost::hash<std::array<double, 3>>> number_;
};

namespace stl {

constexpr std::size_t size_of_header = 84;
constexpr std::size_t size_of_facet = 50;

inline std::uint64_t number_of_facets(std::string_view content) {
  return boost::endian::endian_load<std::uint32_t, 4, boost::endian::order::little>(
      reinterpret_cast<const unsigned char*>(content.data()) + 80);
}

/// Whether the content is a binary STL file to the byte. Some of them start with "solid" like a text.
inline bool is_binary(std::string_view content) {
  return content.size() >= size_of_header &&
         content.size() == size_of_header + size_of_facet * number_of_facets(content);
}

inline Polygon_soup read_binary(const std::string& path, std::string_view content) {
  if (content.size() < size_of_header)
    throw Unreadable_file(path + ": an STL file starts with \"solid\" or has a header of 84 bytes, this one has " +
                          std::to_string(content.size()) + " bytes");
  const std::uint64_t facets = number_of_facets(content);
  if (facets > (content.size() - size_of_header) / size_of_facet)
    throw Unreadable_file(path + ": the header promises " + std::to_string(facets) + " facets, which take " +
                          std::to_string(size_of_header + size_of_facet * facets) + " bytes; the file has " +
                          std::to_string(content.size()));
  Triangle_collector triangles;
  for (std::uint64_t f = 0; f < facets; ++f) {
    const auto* corner =
        reinterpret_cast<const unsigned char*>(content.data()) + size_of_header + size_of_facet * f + 12;
    for (int i = 0; i < 3; ++i, corner += 12) {
      std::array<double, 3> p;
      for (std::size_t j = 0; j < 3; ++j) {
        p[j] = double(boost::endian::endian_load<float, 4, boost::endian::order::little>(corner + 4 * j));
        if (!std::isfinite(p[j]))
          throw Unreadable_file(path + ": facet " + std::to_string(f) + " has a coordinate that is not finite");
      }
      triangles.add_corner({p[0], p[1], p[2]});
    }
  }
  return std::move(triangles).soup();
}

inline Polygon_soup read_text(const std::string& path, std::string_view content) {
  Text text(path, content);
  Triangle_collector triangles;
  int corners = 3;  // of the facet, 3 outside of one
  bool is_ended = false;
  while (text.next_line()) {
    const std::string_view keyword = text.word();
    is_ended = is_word(keyword, "endsolid");
    if (is_ended || is_word(keyword, "endfacet")) {
      if (corners != 3) text.fail("the facet has " + count_of(static_cast<std::uint64_t>(corners), 3, "vertices"));
    } else if (is_word(keyword, "vertex")) {
      if (corners == 3) text.fail("a vertex too many: a facet has three");
      triangles.add_corner(text.point());
      ++corners;
    } else if (is_word(keyword, "facet")) {
      if (corners != 3) text.fail("a facet within a facet");
      corners = 0;
    } else if (!is_word(keyword, "outer") && !is_word(keyword, "endloop") && !is_word(keyword, "solid")) {
      text.fail("no line of an STL file starts with " + printable(keyword));
    }
  }
  if (!is_ended) text.fail_at_end("a line that is not \"endsolid\"");
  return std::move(triangles).soup();
}

}  // namespace stl

/// Reads an STL file, binary or text.
inline Polygon_soup read_stl(const std::string& path, std::string_view content) {
  const bool is_text = is_word(content.substr(0, 5), "solid") && !stl::is_binary(content);
  return is_text ? stl::read_text(path, content) : stl::read_binary(path, content);
}

}  // namespace mesh_files

#endif
