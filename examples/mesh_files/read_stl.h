// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_STL_H
#define MESH_FILES_READ_STL_H

#include "Polygon_soup.h"
#include "Text.h"

#include <boost/endian/conversion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace mesh_files {

/// Numbers points in the order in which they first come; those with equal coordinates are one. A hash table with open
/// addressing, which looks places up some steps before they are needed: memory answers while the program goes on.
/// Complexity: O(1) a point, with 16 to 32 bytes for each different one.
class Point_numbers {
 public:
  using Point = Polygon_soup::Point;
  using Index = Polygon_soup::Index;

  /// Of some points, or of as many more as there turn out to be.
  explicit Point_numbers(std::size_t expected) {
    while (places_.size() < 2 * expected + 2) places_.resize(2 * places_.size());
  }

  /// What a point is looked up by: 0 and -0 are equal.
  static std::uint32_t hash_of(const Point& p) {
    constexpr std::array<std::uint64_t, 3> factor = {0x9e3779b97f4a7c15, 0xd1b54a32d192ed03, 0x8cb92ba72f3d8dd7};
    std::uint64_t hash = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double coordinate = p[static_cast<int>(i)] + 0.;
      std::uint64_t bits;
      std::memcpy(&bits, &coordinate, sizeof bits);
      hash += bits * factor[i];
    }
    // Most coordinates differ in their upper bits, of which products keep no more than the upper ones.
    return static_cast<std::uint32_t>((hash ^ hash >> 32) * factor[0] >> 32);
  }

  /// Fetches the place in the table where a point will be looked up soon.
  void expect(std::uint32_t hash) const { fetch(&places_[hash & (places_.size() - 1)]); }

  /// Fetches the point that is likely to be found there; some steps after the place itself.
  void expect_point(std::uint32_t hash, const std::vector<Point>& points) const {
    const Place& place = places_[hash & (places_.size() - 1)];
    if (place.hash == hash && place.number != none) fetch(&points[place.number]);
  }

  /// The number of a point, which is added if it is new.
  Index operator()(const Point& p, std::uint32_t hash, std::vector<Point>& points) {
    std::size_t i = hash & (places_.size() - 1);
    for (; places_[i].number != none; i = (i + 1) & (places_.size() - 1))
      if (places_[i].hash == hash && points[places_[i].number] == p) return places_[i].number;
    const auto number = static_cast<Index>(points.size());
    places_[i] = {hash, number};
    points.push_back(p);
    if (2 * points.size() > places_.size()) grow();
    return number;
  }

 private:
  static constexpr Index none = std::numeric_limits<Index>::max();
  struct Place {
    std::uint32_t hash = 0;
    Index number = none;
  };

  static void fetch([[maybe_unused]] const void* memory) {
#ifdef __GNUC__
    __builtin_prefetch(memory);
#endif
  }

  void grow() {
    std::vector<Place> larger(2 * places_.size());
    for (const Place& place : places_) {
      if (place.number == none) continue;
      std::size_t i = place.hash & (larger.size() - 1);
      while (larger[i].number != none) i = (i + 1) & (larger.size() - 1);
      larger[i] = place;
    }
    places_ = std::move(larger);
  }

  std::vector<Place> places_ = std::vector<Place>(64);  // a power of two, at most half of them taken
};

/// Collects the triangles of an STL file, which repeats the coordinates of every corner: corners with equal
/// coordinates become one point.
class Triangle_collector {
 public:
  /// \param facets that are expected
  explicit Triangle_collector(std::size_t facets) : number_(facets / 2) {  // of a closed surface
    soup_.points.reserve(facets / 2);
    soup_.corners.reserve(3 * facets);
    soup_.first_corner.reserve(facets + 1);
  }

  template <class Points>
  void add_corners(const Points& points) {
    std::array<std::uint32_t, std::tuple_size_v<Points>> hash;
    for (std::size_t i = 0; i < points.size(); ++i) {
      hash[i] = Point_numbers::hash_of(points[i]);
      number_.expect(hash[i]);
    }
    for (const std::uint32_t h : hash) number_.expect_point(h, soup_.points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      soup_.corners.push_back(number_(points[i], hash[i], soup_.points));
      if (soup_.corners.size() % 3 == 0) soup_.end_face();
    }
  }

  Polygon_soup soup() && { return std::move(soup_); }

 private:
  Polygon_soup soup_;
  Point_numbers number_;
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

inline std::array<Polygon_soup::Point, 3> corners_of_facet(std::string_view content, std::uint64_t facet) {
  constexpr std::size_t size_of_vector = 12;
  const auto* const normal =
      reinterpret_cast<const unsigned char*>(content.data()) + size_of_header + size_of_facet * facet;
  const auto coordinate = [&](std::size_t corner, std::size_t axis) {
    return double(boost::endian::endian_load<float, 4, boost::endian::order::little>(
        normal + size_of_vector * (corner + 1) + sizeof(float) * axis));
  };
  const auto point = [&](std::size_t corner) {
    return Polygon_soup::Point(coordinate(corner, 0), coordinate(corner, 1), coordinate(corner, 2));
  };
  return {point(0), point(1), point(2)};
}

inline Polygon_soup read_binary(const std::string& path, std::string_view content) {
  if (content.size() < size_of_header)
    throw Unreadable_file(path + ": an STL file starts with \"solid\" or has a header of 84 bytes, this one has " +
                          std::to_string(content.size()) + " bytes");
  std::vector<std::string> remarks;
  const std::uint64_t facets = facets_to_read(path, content, remarks);
  Triangle_collector triangles(facets);
  constexpr std::size_t facets_at_once = 32;  // 96 corners: .25 s for 2.4M facets, 16 facets at once .32
  std::array<Polygon_soup::Point, 3 * facets_at_once> corners;
  for (std::uint64_t f = 0; f < facets; ++f) {
    const std::size_t place = f % facets_at_once;
    std::array<Polygon_soup::Point, 3> facet = corners_of_facet(content, f);
    for (const Polygon_soup::Point& p : facet)
      if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
        throw Unreadable_file(path + ": facet " + std::to_string(f) + " has a coordinate that is not finite");
    if (f - place + facets_at_once > facets) {  // the last ones
      triangles.add_corners(facet);
      continue;
    }
    std::copy(facet.begin(), facet.end(), corners.begin() + static_cast<std::ptrdiff_t>(3 * place));
    if (place + 1 == facets_at_once) triangles.add_corners(corners);
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
  explicit Facets(const Text& text) : text_(text), triangles_(0) {}

  void begin() {
    if (is_open_) text_.fail("a facet within a facet");
    is_open_ = true;
    corners_ = 0;
  }
  void add_corner(const Polygon_soup::Point& p) {
    if (!is_open_ || corners_ == 3) text_.fail("a vertex too many: a facet has three");
    triangles_.add_corners(std::array{p});
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
