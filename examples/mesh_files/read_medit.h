// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_MEDIT_H
#define MESH_FILES_READ_MEDIT_H

#include "Numbers.h"
#include "Polygon_soup.h"
#include "Text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace mesh_files {
namespace medit {

constexpr std::string_view mark = "MeshVersionFormatted";

/// The keywords that count, with their numbers in binary files.
struct Keyword {
  std::string_view name;
  std::int64_t number;
  std::size_t corners;    ///< of faces
  std::size_t of_volume;  ///< corners of elements of volume
};

constexpr std::array<Keyword, 10> keywords = {{{"Vertices", 4, 0, 0},
                                               {"Triangles", 6, 3, 0},
                                               {"Quadrilaterals", 7, 4, 0},
                                               {"Tetrahedra", 8, 0, 4},
                                               {"Prisms", 9, 0, 6},
                                               {"Pyramids", 49, 0, 5},
                                               {"Hexahedra", 10, 0, 8},
                                               {"Hexaedra", 10, 0, 8},
                                               {"Dimension", 3, 0, 0},
                                               {"End", 54, 0, 0}}};

/// Whether a file is binary, in that order of bytes: it begins with 1 and its version, as 32 bits each.
inline bool is_binary(std::string_view content, Numbers::Order order) {
  if (content.size() < 8) return false;
  Text no_text("", "");
  Numbers numbers(no_text, content, order);
  if (numbers.integer(4, "") != 1) return false;
  const std::int64_t version = numbers.integer(4, "");
  return version >= 1 && version <= 4;
}

/// The numbers of a mesh, whose sections come from a text or a binary file.
class Sections {
 public:
  Sections(const std::string& path, std::int64_t version) : path_(path), version_(version) {}

  /// Reads what follows a keyword.
  /// \returns whether it is one that counts; if not, nothing was read
  bool read(const Keyword& keyword, Numbers& numbers) {
    if (keyword.name == "Vertices") return read_vertices(numbers), true;
    if (keyword.corners > 0) return read_faces(keyword.corners, numbers), true;
    if (keyword.of_volume == 0) return false;
    const std::uint64_t elements =
        numbers.count_with_room(size_of_count(), keyword.of_volume + 1, "elements of volume");
    numbers.skip(elements * (keyword.of_volume + 1), size_of_count());
    volumes_ += elements;
    return true;
  }

  void read_dimension(Numbers& numbers) {
    dimensions_ = numbers.count(4, "the dimension");
    if (dimensions_ != 2 && dimensions_ != 3) numbers.fail("the dimension is " + std::to_string(dimensions_));
  }

  std::size_t size_of_count() const { return version_ >= 4 ? 8 : 4; }
  std::size_t size_of_position() const { return version_ >= 3 ? 8 : 4; }

  /// \throws Unreadable_file if a face names a vertex that is not there
  Polygon_soup soup() && {
    if (largest_corner_ >= soup_.points.size() && !soup_.corners.empty())
      throw Unreadable_file(path_ + ": a face names vertex " + std::to_string(largest_corner_ + 1) + ", the file has " +
                            std::to_string(soup_.points.size()) + " (the first is vertex 1)");
    note_other_elements(path_, volumes_, 0, soup_);
    return std::move(soup_);
  }

 private:
  std::size_t size_of_coordinate() const { return version_ >= 2 ? 8 : 4; }

  void read_vertices(Numbers& numbers) {
    const std::uint64_t vertices = numbers.count_with_room(size_of_count(), dimensions_ + 1, "vertices");
    soup_.points.reserve(soup_.points.size() + vertices);
    for (std::uint64_t v = 0; v < vertices; ++v) {
      soup_.points.push_back(numbers.point(size_of_coordinate(), dimensions_));
      numbers.skip(1, size_of_count());
    }
  }

  void read_faces(std::size_t corners, Numbers& numbers) {
    const std::uint64_t faces = numbers.count_with_room(size_of_count(), corners + 1, "faces");
    for (std::uint64_t f = 0; f < faces; ++f) {
      for (std::size_t i = 0; i < corners; ++i) {
        const std::uint64_t corner = numbers.count(size_of_count(), "a corner of the face");
        if (corner == 0 || corner > std::numeric_limits<Polygon_soup::Index>::max())
          numbers.fail("the face names vertex " + std::to_string(corner) + " (the first is vertex 1)");
        largest_corner_ = std::max(largest_corner_, corner - 1);
        soup_.corners.push_back(static_cast<Polygon_soup::Index>(corner - 1));
      }
      soup_.end_face();
      numbers.skip(1, size_of_count());
    }
  }

  const std::string& path_;
  std::int64_t version_;
  std::uint64_t dimensions_ = 3, largest_corner_ = 0, volumes_ = 0;
  Polygon_soup soup_;
};

/// In texts a section that does not count goes on to the next word that is no number.
inline Polygon_soup read_text(const std::string& path, std::string_view content) {
  Text text(path, content);
  text.next_line();
  const std::string_view first = text.word();
  if (first != mark) text.fail("a Medit file starts with " + std::string(mark) + ", this one with " + printable(first));
  Numbers numbers(text);
  numbers.skip(1, 4);  // the version, which tells how exact numbers are
  Sections sections(path, 2);
  while (text.next_word()) {
    const std::string_view name = text.word();
    if (name == "End") break;
    if (name == "Dimension") {
      sections.read_dimension(numbers);
      continue;
    }
    const auto* const known =
        std::find_if(keywords.begin(), keywords.end(), [&](const Keyword& k) { return k.name == name; });
    if (known != keywords.end())
      sections.read(*known, numbers);
    else if (!std::isalpha(static_cast<unsigned char>(name[0])) && !number_in<double>(name))
      text.fail("a section starts with a word, this one with " + printable(name));
  }
  return std::move(sections).soup();
}

/// In binary files each section says where the next one is.
inline Polygon_soup read_binary(const std::string& path, std::string_view content, Numbers::Order order) {
  Text no_text(path, "");
  const auto numbers_at = [&](std::uint64_t position) { return Numbers(no_text, content.substr(position), order); };
  Numbers head = numbers_at(4);
  const std::int64_t version = head.integer(4, "the version");
  Sections sections(path, version);
  std::uint64_t position = 8;
  while (position < content.size()) {
    Numbers numbers = numbers_at(position);
    const std::int64_t code = numbers.integer(4, "the code of a section");
    const std::uint64_t next = numbers.count(sections.size_of_position(), "the place of the next section");
    const auto* const known =
        std::find_if(keywords.begin(), keywords.end(), [&](const Keyword& k) { return k.number == code; });
    if (known != keywords.end() && known->name == "End") break;
    if (known != keywords.end() && known->name == "Dimension")
      sections.read_dimension(numbers);
    else if (known != keywords.end())
      sections.read(*known, numbers);
    if (next == 0) break;
    if (next <= position) numbers.fail("a section is followed by one before it");
    position = next;
  }
  return std::move(sections).soup();
}

}  // namespace medit

/// Reads the triangles and quads of a Medit file (.mesh, or .meshb, which is binary), in the order of the file. All but
/// vertices and faces is passed over.
inline Polygon_soup read_medit(const std::string& path, std::string_view content) {
  for (const auto order : {Numbers::Order::little, Numbers::Order::big})
    if (medit::is_binary(content, order)) return medit::read_binary(path, content, order);
  return medit::read_text(path, content);
}

}  // namespace mesh_files

#endif
