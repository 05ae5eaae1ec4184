// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_STL_H
#define MESH_FILES_READ_STL_H

#include "Polygon_soup.h"
#include "Text.h"

#include <boost/endian/conversion.hpp>
#include <boost/functional/hash.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

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

/// Whether the content can be text: the beginnings of binary files have bytes that no text has. Names may have letters
/// beyond ASCII.
inline bool may_be_text(std::string_view content) {
  const std::string_view begin = content.substr(0, size_of_header + size_of_facet);
  const auto is_ascii = [](unsigned char c) { return (c >= ' ' && c <= '~') || (c >= '\t' && c <= '\r'); };
  const auto is_control = [&](unsigned char c) { return c <= '~' + 1 && !is_ascii(c); };
  return std::none_of(begin.begin(), begin.end(), is_control) &&
         2 * static_cast<std::size_t>(std::count_if(begin.begin(), begin.end(), is_ascii)) >= begin.size();
}

/// How many facets to read: as many as the header promises, but where it promises none or no more than the two bytes
/// without a meaning at the end are missing, as many as there are. What was odd is remarked.
inline std::uint64_t facets_to_read(const std::string& path, std::string_view content,
                                    std::vector<std::string>& remarks) {
  constexpr std::size_t size_of_attributes = 2;
  const std::uint64_t promised = number_of_facets(content), rest = content.size() - size_of_header,
                      there = (rest + size_of_attributes) / size_of_facet;
  if (promised == 0 && rest >= size_of_facet) {
    if (rest % size_of_facet != 0)
      throw Unreadable_file(path + ": the header counts no facets, but " + std::to_string(rest) + " bytes follow it");
    remarks.push_back("the header counts no facets, but " + std::to_string(there) + " follow it and were read");
    return there;
  }
  if (promised > there)
    throw Unreadable_file(path + ": the header promises " + std::to_string(promised) + " facets, which take " +
                          std::to_string(size_of_header + size_of_facet * promised) + " bytes; the file has " +
                          std::to_string(content.size()));
  if (rest < size_of_facet * promised)
    remarks.push_back("the last facet lacks " + std::to_string(size_of_facet * promised - rest) +
                      " of its two bytes of attributes");
  if (rest > size_of_facet * promised)
    remarks.push_back("passed over " + std::to_string(rest - size_of_facet * promised) + " bytes after the last facet");
  return promised;
}

inline Polygon_soup read_binary(const std::string& path, std::string_view content) {
  if (content.size() < size_of_header)
    throw Unreadable_file(path + ": an STL file starts with \"solid\" or has a header of 84 bytes, this one has " +
                          std::to_string(content.size()) + " bytes");
  std::vector<std::string> remarks;
  const std::uint64_t facets = facets_to_read(path, content, remarks);
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
  Polygon_soup soup = std::move(triangles).soup();
  soup.remarks = std::move(remarks);
  return soup;
}

/// Goes on behind the name of a solid, which may hold any words: to the first facet of the line, or to its end.
inline void skip_name(Text& text) {
  const auto is_facet = [&] {
    Text next = text;
    return is_word(next.word(), "facet") && is_word(next.word(), "normal");
  };
  if (text.rest_of_line().size() < size_of_facet) text.skip_line();  // no room for a facet
  while (!text.at_end_of_line() && !is_facet()) text.word();
}

/// What reading has come to in a text.
class Facets {
 public:
  explicit Facets(const Text& text) : text_(text) {}

  void begin() {
    if (is_open_) text_.fail("a facet within a facet");
    is_open_ = true;
    corners_ = 0;
  }
  void add_corner(const Polygon_soup::Point& p) {
    if (!is_open_ || corners_ == 3) text_.fail("a vertex too many: a facet has three");
    triangles_.add_corner(p);
    ++corners_;
  }
  void end() {
    if (is_open_ && corners_ != 3) text_.fail("the facet has " + count_of(corners_, 3, "vertices"));
    is_open_ = false;
  }
  bool is_open() const { return is_open_; }

  Polygon_soup soup() && { return std::move(triangles_).soup(); }

 private:
  const Text& text_;
  Triangle_collector triangles_;
  std::uint64_t corners_ = 0;  // of the facet
  bool is_open_ = false;
};

inline bool is_passed_over(std::string_view keyword) {
  for (const char* known : {"normal", "outer", "loop", "endloop"})
    if (is_word(keyword, known)) return true;
  return false;
}

/// Words may be on lines of their own or all on one. At the beginning of a line there is none but those of STL.
inline Polygon_soup read_text(const std::string& path, std::string_view content) {
  Text text(path, content);
  Facets facets(text);
  bool is_ended = true;
  while (text.next_line()) {
    for (bool is_first = true; !text.at_end_of_line(); is_first = false) {
      const std::string_view keyword = text.word();
      if (is_word(keyword, "vertex")) {
        facets.add_corner(text.point());
      } else if (is_word(keyword, "facet")) {
        facets.begin();
        is_ended = false;
      } else if (is_word(keyword, "endfacet")) {
        facets.end();
      } else if (is_word(keyword, "endsolid") || is_word(keyword, "solid")) {
        facets.end();
        is_ended = true;
        skip_name(text);
      } else if (is_first && !is_passed_over(keyword)) {
        text.fail("no line of an STL file starts with " + printable(keyword));
      }
    }
  }
  if (facets.is_open()) text.fail_at_end("part of a facet");
  Polygon_soup soup = std::move(facets).soup();
  if (!is_ended) soup.remarks.emplace_back("the file ends without \"endsolid\"");
  return soup;
}

}  // namespace stl

/// Reads an STL file, binary or text. A text starts with "solid", or with "facet" where that line is missing; binary files
/// may start with "solid", too.
inline Polygon_soup read_stl(const std::string& path, std::string_view content) {
  if (stl::is_binary(content) || !stl::may_be_text(content)) return stl::read_binary(path, content);
  Text text(path, content);
  if (!text.next_line()) throw Unreadable_file(path + ": the file is empty");
  const std::string_view first = text.word();
  if (!is_word(first.substr(0, 5), "solid") && !is_word(first, "facet"))
    text.fail("an STL text starts with \"solid\", this one with " + printable(first));
  return stl::read_text(path, content);
}

}  // namespace mesh_files

#endif
