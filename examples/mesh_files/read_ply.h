// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_PLY_H
#define MESH_FILES_READ_PLY_H

#include "Polygon_soup.h"
#include "Strips.h"
#include "Text.h"
#include "pieces.h"

#include <boost/endian/conversion.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace mesh_files {
namespace ply {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

inline std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 10> sizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

/// What a property means to us.
enum class Meaning { x, y, z, corners, strips, other };

struct Property {
  std::string name;
  Meaning meaning = Meaning::other;
  Scalar type = Scalar::float32;
  bool is_list = false;
  Scalar type_of_size = Scalar::uint8;  ///< of a list
};

struct Element {
  std::string name;
  std::uint64_t number = 0;
  std::vector<Property> properties;
};

enum class Encoding { text, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
};

inline Scalar scalar_type(Text& text) {
  constexpr std::array<std::array<const char*, 2>, 10> names = {{{"char", "int8"},
                                                                 {"uchar", "uint8"},
                                                                 {"short", "int16"},
                                                                 {"ushort", "uint16"},
                                                                 {"int", "int32"},
                                                                 {"uint", "uint32"},
                                                                 {"long", "int64"},
                                                                 {"ulong", "uint64"},
                                                                 {"float", "float32"},
                                                                 {"double", "float64"}}};
  const std::string_view word = text.word();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (word == names[i][0] || word == names[i][1]) return static_cast<Scalar>(i);
  text.fail("no scalar type of PLY is called " + printable(word));
}

inline Meaning meaning_of(const Element& element, const Property& property) {
  if (element.name == "vertex" && !property.is_list) {
    if (property.name == "x") return Meaning::x;
    if (property.name == "y") return Meaning::y;
    if (property.name == "z") return Meaning::z;
  }
  if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index")) {
    if (element.name == "face") return Meaning::corners;
    if (element.name == "tristrips") return Meaning::strips;
  }
  return Meaning::other;
}

inline Property read_property(Text& text, const Element& element) {
  Property property;
  const Text before = text;
  property.is_list = text.word() == "list";
  if (property.is_list)
    property.type_of_size = scalar_type(text);
  else
    text = before;
  property.type = scalar_type(text);
  property.name = text.word();
  property.meaning = meaning_of(element, property);
  return property;
}

/// Reads the header up to and with the line "end_header". Lines that PLY does not know count as comments, as in the
/// files of programs that sign their work.
inline Header read_header(Text& text) {
  Header header;
  bool has_format = false;
  text.next_line();  // "ply"
  for (;;) {
    if (!text.next_line()) text.fail_at_end("part of the header");
    const std::string_view keyword = text.word();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      const std::string_view format = text.word();
      has_format = true;
      if (format == "ascii")
        header.encoding = Encoding::text;
      else if (format == "binary_little_endian")
        header.encoding = Encoding::little_endian;
      else if (format == "binary_big_endian")
        header.encoding = Encoding::big_endian;
      else
        text.fail("no format of PLY is called " + printable(format));
    } else if (keyword == "element") {
      Element element;
      element.name = text.word();
      element.number = text.count("the number of elements");
      header.elements.push_back(element);
    } else if (keyword == "property") {
      if (header.elements.empty()) text.fail("a property before the first element");
      Element& element = header.elements.back();
      const Property property = read_property(text, element);
      for (const Property& other : element.properties)
        if (other.meaning == property.meaning && property.meaning != Meaning::other)
          text.fail("a second property " + printable(property.name));
      element.properties.push_back(property);
    }
  }
  if (!has_format) text.fail("the header has no line \"format\"");
  return header;
}

/// The element of a name, null if there is none.
inline const Element* element_called(const std::string& name, const Header& header) {
  for (const Element& element : header.elements)
    if (element.name == name) return &element;
  return nullptr;
}

inline void require(Meaning meaning, const char* name, const Element& element, const Text& text) {
  for (const Property& property : element.properties)
    if (property.meaning == meaning) return;
  text.fail("element \"" + element.name + "\" has no property \"" + name + "\"");
}

/// Refuses a header without what a mesh needs, or that promises more than the file has room for.
inline void check_header(const Header& header, const Text& text) {
  const Element* const vertices = element_called("vertex", header);
  if (!vertices) text.fail("the header has no element \"vertex\"");
  require(Meaning::x, "x", *vertices, text);
  require(Meaning::y, "y", *vertices, text);
  require(Meaning::z, "z", *vertices, text);
  const Element* const faces = element_called("face", header);
  const Element* const strips = element_called("tristrips", header);
  if (!faces && !strips) text.fail("the header has no element \"face\"");
  if (faces && faces->number > 0) require(Meaning::corners, "vertex_indices", *faces, text);
  if (strips && strips->number > 0) require(Meaning::strips, "vertex_indices", *strips, text);
  for (const Element& element : header.elements) {
    std::size_t smallest_size = 0;
    for (const Property& property : element.properties)
      smallest_size += header.encoding == Encoding::text ? 2
                       : property.is_list                ? size_of(property.type_of_size)
                                                         : size_of(property.type);
    if (!element.properties.empty() && element.number > (text.rest().size() + 1) / smallest_size)
      text.fail("the header promises " + std::to_string(element.number) + " elements \"" + element.name +
                "\", more than the file has room for");
  }
}

/// The values of a PLY file in text form, one element a line.
class Text_values {
 public:
  explicit Text_values(Text& text) : text_(text) {}
  void next_element(std::uint64_t number, const Element& element) {
    text_.next_item(number, element.number, "elements \"" + element.name + "\"");
  }
  double next(Scalar) { return text_.number("a value"); }
  [[noreturn]] void fail(const std::string& cause) const { text_.fail(cause); }

 private:
  Text& text_;
};

/// The values of a binary PLY file.
template <boost::endian::order Order>
class Binary_values {
 public:
  Binary_values(std::string path, std::string_view rest) : path_(std::move(path)), rest_(rest) {}

  void next_element(std::uint64_t number, const Element& element) {
    number_ = number;
    element_ = &element;
  }

  double next(Scalar type) {
    const std::size_t size = size_of(type);
    if (size > rest_.size())
      throw Unreadable_file(path_ + ": the file ends after " +
                            count_of(number_, element_->number, "elements \"" + element_->name + "\""));
    const auto* bytes = reinterpret_cast<const unsigned char*>(rest_.data());
    rest_.remove_prefix(size);
    switch (type) {
      case Scalar::int8:
        return load<std::int8_t>(bytes);
      case Scalar::uint8:
        return load<std::uint8_t>(bytes);
      case Scalar::int16:
        return load<std::int16_t>(bytes);
      case Scalar::uint16:
        return load<std::uint16_t>(bytes);
      case Scalar::int32:
        return load<std::int32_t>(bytes);
      case Scalar::uint32:
        return load<std::uint32_t>(bytes);
      case Scalar::int64:
        return load<std::int64_t>(bytes);
      case Scalar::uint64:
        return load<std::uint64_t>(bytes);
      case Scalar::float32:
        return load<float>(bytes);
      case Scalar::float64:
        return load<double>(bytes);
    }
    return 0;
  }

  [[noreturn]] void fail(const std::string& cause) const {
    throw Unreadable_file(path_ + ": " + element_->name + " " + std::to_string(number_) + ": " + cause);
  }

 private:
  template <class Value>
  static double load(const unsigned char* bytes) {
    return static_cast<double>(boost::endian::endian_load<Value, sizeof(Value), Order>(bytes));
  }

  std::string path_;
  std::string_view rest_;
  std::uint64_t number_ = 0;
  const Element* element_ = nullptr;
};

template <class Values>
std::uint64_t whole_number(double value, const Values& values, const char* what) {
  if (!(value >= 0 && value <= double(std::numeric_limits<std::uint32_t>::max()) && value == std::floor(value)))
    values.fail(std::string(what) + " is " + std::to_string(value));
  return static_cast<std::uint64_t>(value);
}

/// The number of a vertex that a face has for a corner.
template <class Values>
Polygon_soup::Index corner_of(double value, std::uint64_t number_of_vertices, const Values& values) {
  const std::uint64_t corner = whole_number(value, values, "a corner of the face");
  if (corner >= number_of_vertices)
    values.fail("the face names vertex " + std::to_string(corner) + ", the file has " +
                std::to_string(number_of_vertices) + " (the first is vertex 0)");
  return static_cast<Polygon_soup::Index>(corner);
}

template <class Values>
void read_list(const Property& property, std::uint64_t number_of_vertices, Values& values, Polygon_soup& soup,
               Strips& strips) {
  const std::uint64_t size = whole_number(values.next(property.type_of_size), values, "the size of a list");
  for (std::uint64_t i = 0; i < size; ++i) {
    const double value = values.next(property.type);
    if (property.meaning == Meaning::corners)
      soup.corners.push_back(corner_of(value, number_of_vertices, values));
    else if (property.meaning == Meaning::strips && value == -1)
      strips.end_strip();
    else if (property.meaning == Meaning::strips)
      strips.add(corner_of(value, number_of_vertices, values));
  }
  if (property.meaning == Meaning::corners) soup.end_face();
  if (property.meaning == Meaning::strips) strips.end_strip();
}

template <class Values>
Polygon_soup read_elements(const Header& header, std::uint64_t number_of_vertices, Values values) {
  Polygon_soup soup;
  Strips strips;
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    if (element.name == "vertex") soup.points.reserve(element.number);
    for (std::uint64_t number = 0; number < element.number; ++number) {
      values.next_element(number, element);
      std::array<double, 3> point = {0, 0, 0};
      for (const Property& property : element.properties) {
        if (property.is_list) {
          read_list(property, number_of_vertices, values, soup, strips);
          continue;
        }
        const double value = values.next(property.type);
        if (property.meaning == Meaning::other) continue;
        if (!std::isfinite(value)) values.fail("the " + property.name + " coordinate is not finite");
        point[static_cast<std::size_t>(property.meaning)] = value;
      }
      if (element.name == "vertex") soup.points.emplace_back(point[0], point[1], point[2]);
    }
  }
  strips.append_to(soup);
  return soup;
}

// ---- Binary files as most programs write them, many elements at once ----

/// A number of a binary file.
/// \param is_swapped whether its bytes are in the other order than those of this machine
template <class Number>
Number load_number(const char* bytes, bool is_swapped) {
  Number number;
  if constexpr (std::is_floating_point_v<Number>) {
    const auto bits =
        load_number<std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>>(bytes, is_swapped);
    std::memcpy(&number, &bits, sizeof number);
    return number;
  } else {
    std::memcpy(&number, bytes, sizeof number);
    return is_swapped ? boost::endian::endian_reverse(number) : number;
  }
}

/// The bytes of an element without lists; nothing if it has some.
inline std::optional<std::size_t> fixed_size_of(const Element& element) {
  std::size_t size = 0;
  for (const Property& property : element.properties) {
    if (property.is_list) return std::nullopt;
    size += size_of(property.type);
  }
  return size;
}

/// How many elements a thread reads at once: some hundred kilobytes of them.
constexpr std::size_t elements_at_once = 1 << 14;

/// Reads points whose coordinates are numbers of one type.
/// \param offset of the coordinates in an element
/// \returns false if one is not finite
template <class Coordinate>
bool read_points(const char* bytes, bool is_swapped, std::size_t size_of_element,
                 const std::array<std::size_t, 3>& offset, std::vector<Polygon_soup::Point>& points) {
  std::atomic<bool> are_finite = true;
  for_each_piece((points.size() + elements_at_once - 1) / elements_at_once, [&](std::size_t piece) {
    bool are_these_finite = true;
    const std::size_t end = std::min((piece + 1) * elements_at_once, points.size());
    for (std::size_t i = piece * elements_at_once; i < end; ++i) {
      std::array<double, 3> p;
      for (std::size_t j = 0; j < 3; ++j) {
        p[j] = double(load_number<Coordinate>(bytes + i * size_of_element + offset[j], is_swapped));
        are_these_finite = are_these_finite && std::isfinite(p[j]);
      }
      points[i] = {p[0], p[1], p[2]};
    }
    if (!are_these_finite) are_finite = false;
  });
  return are_finite;
}

/// \returns the bytes that it took; nothing if only reading one by one tells what they mean
inline std::optional<std::size_t> read_vertices(const Element& element, std::string_view rest, bool is_swapped,
                                                Polygon_soup& soup) {
  const std::optional<std::size_t> size = fixed_size_of(element);
  if (!size || element.number > rest.size() / *size || !soup.points.empty()) return std::nullopt;
  std::array<std::size_t, 3> offset{};
  std::array<Scalar, 3> type{};
  std::size_t before = 0;
  for (const Property& property : element.properties) {
    if (property.meaning != Meaning::other) {
      offset[static_cast<std::size_t>(property.meaning)] = before;
      type[static_cast<std::size_t>(property.meaning)] = property.type;
    }
    before += size_of(property.type);
  }
  const auto is = [&](Scalar wanted) { return type == std::array{wanted, wanted, wanted}; };
  if (!is(Scalar::float32) && !is(Scalar::float64)) return std::nullopt;
  soup.points.resize(element.number);
  const bool are_finite = is(Scalar::float32)
                              ? read_points<float>(rest.data(), is_swapped, *size, offset, soup.points)
                              : read_points<double>(rest.data(), is_swapped, *size, offset, soup.points);
  return are_finite ? std::optional(element.number * *size) : std::nullopt;
}

/// Faces with one list and numbers of 32 bits in it.
struct Face_layout {
  std::size_t before = 0, after = 0;  ///< bytes beside the list
  std::size_t size_of_size = 0;
  std::uint32_t largest_size = 0;  ///< that the type of the size can hold
  bool is_swapped = false;

  std::uint32_t number_of_corners(const char* bytes) const {
    if (size_of_size == 1) return load_number<std::uint8_t>(bytes, false);
    return size_of_size == 2 ? load_number<std::uint16_t>(bytes, is_swapped)
                             : load_number<std::uint32_t>(bytes, is_swapped);
  }
};

/// \returns nothing for other faces
inline std::optional<Face_layout> layout_of_faces(const Element& element, bool is_swapped) {
  Face_layout layout;
  layout.is_swapped = is_swapped;
  for (const Property& property : element.properties) {
    if (!property.is_list) {
      (layout.size_of_size == 0 ? layout.before : layout.after) += size_of(property.type);
      continue;
    }
    const Scalar type = property.type_of_size;
    const bool is_signed = type == Scalar::int8 || type == Scalar::int16 || type == Scalar::int32;
    const bool is_32_bits = property.type == Scalar::int32 || property.type == Scalar::uint32;
    if (property.meaning != Meaning::corners || !is_32_bits || type > Scalar::uint32) return std::nullopt;
    layout.size_of_size = size_of(type);
    layout.largest_size = 0xffffffffU >> (32 - 8 * layout.size_of_size) >> (is_signed ? 1 : 0);
  }
  return layout.size_of_size > 0 ? std::optional(layout) : std::nullopt;
}

/// Some faces one after the other: where their bytes and their corners begin.
struct Run_of_faces {
  std::size_t byte = 0, corner = 0;
};

/// Goes from face to face, and notes where runs of `elements_at_once` of them begin, and the end.
/// \returns nothing if there are not as many
inline std::vector<Run_of_faces> runs_of_faces(const Face_layout& layout, std::uint64_t faces, std::string_view rest) {
  std::vector<Run_of_faces> runs;
  Run_of_faces here;
  const std::size_t size_without_corners = layout.before + layout.size_of_size + layout.after;
  for (std::uint64_t f = 0; f < faces; ++f) {
    if (f % elements_at_once == 0) runs.push_back(here);
    if (size_without_corners > rest.size() - here.byte) return {};
    const std::uint32_t corners = layout.number_of_corners(rest.data() + here.byte + layout.before);
    here.byte += size_without_corners;
    if (corners > layout.largest_size || corners > (rest.size() - here.byte) / sizeof(std::uint32_t)) return {};
    here.byte += corners * sizeof(std::uint32_t);
    here.corner += corners;
  }
  runs.push_back(here);
  return runs;
}

/// \returns the bytes that it took; nothing if only reading one by one tells what they mean
inline std::optional<std::size_t> read_faces(const Element& element, std::string_view rest, bool is_swapped,
                                             std::uint64_t number_of_vertices, Polygon_soup& soup) {
  constexpr std::uint64_t signed_vertices = std::numeric_limits<std::int32_t>::max();
  const std::optional<Face_layout> layout = layout_of_faces(element, is_swapped);
  if (!layout || number_of_vertices > signed_vertices || soup.number_of_faces() > 0) return std::nullopt;
  const std::vector<Run_of_faces> runs = runs_of_faces(*layout, element.number, rest);
  if (runs.empty()) return std::nullopt;
  soup.corners.resize(runs.back().corner);
  soup.first_corner.resize(element.number + 1);
  std::atomic<bool> are_vertices = true;
  for_each_piece(runs.size() - 1, [&](std::size_t i) {
    const char* byte = rest.data() + runs[i].byte;
    std::size_t corner = runs[i].corner;
    std::uint32_t largest = 0;
    const std::size_t end = std::min<std::size_t>((i + 1) * elements_at_once, element.number);
    for (std::size_t f = i * elements_at_once; f < end; ++f) {
      byte += layout->before;
      const std::uint32_t corners = layout->number_of_corners(byte);
      byte += layout->size_of_size;
      for (std::uint32_t j = 0; j < corners; ++j, ++corner, byte += sizeof(std::uint32_t)) {
        soup.corners[corner] = load_number<std::uint32_t>(byte, is_swapped);
        largest = std::max(largest, soup.corners[corner]);
      }
      byte += layout->after;
      soup.first_corner[f + 1] = corner;
    }
    if (runs[i + 1].corner > runs[i].corner && largest >= number_of_vertices) are_vertices = false;
  });
  return are_vertices ? std::optional(runs.back().byte) : std::nullopt;
}

/// Reads the elements of a binary file whose types are the usual ones.
/// \returns nothing for other files, and for those in which something is wrong, which reading one by one tells
inline std::optional<Polygon_soup> read_usual_elements(const Header& header, std::uint64_t number_of_vertices,
                                                       std::string_view rest) {
  const bool is_swapped =
      (header.encoding == Encoding::big_endian) != (boost::endian::order::native == boost::endian::order::big);
  Polygon_soup soup;
  for (const Element& element : header.elements) {
    if (element.properties.empty() || element.number == 0) continue;
    std::optional<std::size_t> bytes;
    if (element.name == "vertex")
      bytes = read_vertices(element, rest, is_swapped, soup);
    else if (element.name == "face")
      bytes = read_faces(element, rest, is_swapped, number_of_vertices, soup);
    else if (const auto size = fixed_size_of(element); size && element.number <= rest.size() / *size)
      bytes = element.number * *size;
    if (!bytes) return std::nullopt;
    rest.remove_prefix(*bytes);
  }
  return soup;
}

}  // namespace ply

/// Reads a PLY file, text or binary; strips of triangles come after the faces. Properties other than the points and the corners of the faces are passed over.
inline Polygon_soup read_ply(const std::string& path, std::string_view content) {
  Text text(path, content);
  const ply::Header header = ply::read_header(text);
  ply::check_header(header, text);
  const std::uint64_t vertices = ply::element_called("vertex", header)->number;
  if (header.encoding != ply::Encoding::text)
    if (std::optional<Polygon_soup> soup = ply::read_usual_elements(header, vertices, text.rest()))
      return std::move(*soup);
  switch (header.encoding) {
    case ply::Encoding::little_endian:
      return ply::read_elements(header, vertices, ply::Binary_values<boost::endian::order::little>(path, text.rest()));
    case ply::Encoding::big_endian:
      return ply::read_elements(header, vertices, ply::Binary_values<boost::endian::order::big>(path, text.rest()));
    case ply::Encoding::text:
      break;
  }
  return ply::read_elements(header, vertices, ply::Text_values(text));
}

}  // namespace mesh_files

#endif
