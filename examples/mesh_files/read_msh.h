// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_MSH_H
#define MESH_FILES_READ_MSH_H

#include "Numbers.h"
#include "Polygon_soup.h"
#include "Text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace mesh_files {
namespace msh {

/// What Gmsh calls a type of elements.
struct Element_type {
  std::int64_t number;
  std::size_t dimension, corners, nodes;
};

/// Curved elements have further nodes behind their corners.
constexpr std::array<Element_type, 37> element_types = {
    {{1, 1, 2, 2},   {2, 2, 3, 3},   {3, 2, 4, 4},   {4, 3, 4, 4},   {5, 3, 8, 8},   {6, 3, 6, 6},   {7, 3, 5, 5},
     {8, 1, 2, 3},   {9, 2, 3, 6},   {10, 2, 4, 9},  {11, 3, 4, 10}, {12, 3, 8, 27}, {13, 3, 6, 18}, {14, 3, 5, 14},
     {15, 0, 1, 1},  {16, 2, 4, 8},  {17, 3, 8, 20}, {18, 3, 6, 15}, {19, 3, 5, 13}, {20, 2, 3, 9},  {21, 2, 3, 10},
     {22, 2, 3, 12}, {23, 2, 3, 15}, {24, 2, 3, 15}, {25, 2, 3, 21}, {26, 1, 2, 4},  {27, 1, 2, 5},  {28, 1, 2, 6},
     {29, 3, 4, 20}, {30, 3, 4, 35}, {31, 3, 4, 56}, {36, 2, 4, 16}, {37, 2, 4, 25}, {38, 2, 4, 36}, {39, 2, 4, 12},
     {92, 3, 8, 64}, {93, 3, 8, 125}}};

/// Reads the sections of a file, of which those with nodes and elements count.
class Reader {
 public:
  Reader(const std::string& path, std::string_view content) : path_(path), text_(path, content) {}

  Polygon_soup soup() && {
    read_header();
    while (text_.next_line()) {
      const std::string name(text_.word());
      if (name.empty() || name[0] != '$') text_.fail("a section starts with $, this line with " + printable(name));
      if (name == "$ParametricNodes") text_.fail("nodes with parameters are not read in version 2: save without them");
      if (name == "$Nodes" && is_version_4_)
        read_section([&](Numbers& numbers) { read_blocks_of_nodes(numbers); });
      else if (name == "$Nodes")
        read_section([&](Numbers& numbers) { read_nodes(numbers); });
      else if (name == "$Elements" && is_version_4_)
        read_section([&](Numbers& numbers) { read_blocks_of_elements(numbers); });
      else if (name == "$Elements")
        read_section([&](Numbers& numbers) { read_elements(numbers); });
      else
        skip_to("$End" + name.substr(1));
    }
    note_other_elements(path_, volumes_, curved_, soup_);
    return std::move(soup_);
  }

 private:
  void read_header() {
    text_.next_line();
    if (text_.word() != "$MeshFormat" || !text_.next_line()) text_.fail("a Gmsh file starts with $MeshFormat");
    const std::string version(text_.word());
    is_version_4_ = version == "4.1";
    if (!is_version_4_ && version != "2.2" && version != "2.1" && version != "2")
      text_.fail("the version is " + printable(version) + ", and only 2.2 and 4.1 are read: save it as one of them");
    is_binary_ = text_.integer("the type of the file") == 1;
    size_of_count_ = is_version_4_ ? text_.count("the size of numbers") : 4;
    if (size_of_count_ != 4 && size_of_count_ != 8)
      text_.fail("numbers have " + std::to_string(size_of_count_) + " bytes, not 4 or 8");
    if (is_binary_) {
      const std::string_view one = text_.rest().substr(0, 4);
      order_ = one == std::string_view("\0\0\0\1", 4) ? Numbers::Order::big : Numbers::Order::little;
    }
    skip_to("$EndMeshFormat");
  }

  /// Goes behind a line, whatever is before it.
  void skip_to(const std::string& end) {
    if (is_binary_) {
      const std::size_t at = text_.rest().find(end);
      if (at == std::string_view::npos) text_.fail_at_end("a section without " + end);
      text_ = Text(path_, text_.rest().substr(at));
    }
    do {
      if (!text_.next_line()) text_.fail_at_end("a section without " + end);
    } while (text_.rest_of_line().substr(0, end.size()) != end);
    text_.skip_line();
  }

  template <class Read>
  void read_section(const Read& read) {
    if (!is_binary_) {
      Numbers numbers(text_);
      read(numbers);
    } else if (is_version_4_) {
      read_bytes(read);
    } else {  // the count is a word also where bytes follow
      if (!text_.next_line()) text_.fail_at_end("a section without a count");
      count_ = text_.count("a count");
      read_bytes(read);
    }
    text_.skip_line();
    if (!text_.next_line() || text_.word().substr(0, 4) != "$End")
      text_.fail("there is more in the section than it says");
  }

  template <class Read>
  void read_bytes(const Read& read) {
    Numbers numbers(text_, text_.rest(), order_);
    read(numbers);
    text_ = Text(path_, numbers.bytes());
  }

  /// The number at the beginning of a section of version 2.
  std::uint64_t count_of_section(Numbers& numbers, std::uint64_t least_numbers, const char* items) {
    if (!numbers.is_binary()) return numbers.count_with_room(4, least_numbers, items);
    if (count_ > numbers.bytes().size() / (4 * least_numbers))
      numbers.fail("the file promises " + std::to_string(count_) + " " + items + ", more than it has room for");
    return count_;
  }

  void add_node(std::uint64_t tag, const Polygon_soup::Point& point) {
    index_of_tag_[tag] = static_cast<Polygon_soup::Index>(soup_.points.size());
    soup_.points.push_back(point);
  }

  void read_nodes(Numbers& numbers) {
    const std::uint64_t nodes = count_of_section(numbers, 4, "nodes");
    for (std::uint64_t i = 0; i < nodes; ++i) {
      const std::uint64_t tag = numbers.count(4, "the number of a node");
      add_node(tag, numbers.point(8));
    }
  }

  void read_blocks_of_nodes(Numbers& numbers) {
    const std::uint64_t blocks = numbers.count_with_room(size_of_count_, 3, "blocks of nodes");
    numbers.skip(3, size_of_count_);
    for (std::uint64_t block = 0; block < blocks; ++block) {
      const std::uint64_t dimension = numbers.count(4, "the dimension of an entity");
      numbers.skip(1, 4);
      const bool has_parameters = numbers.integer(4, "whether nodes have parameters") != 0;
      const std::uint64_t nodes = numbers.count_with_room(size_of_count_, 4, "nodes");
      const std::size_t first = soup_.points.size();
      for (std::uint64_t i = 0; i < nodes; ++i)
        add_node(numbers.count(size_of_count_, "the number of a node"), {0, 0, 0});
      for (std::uint64_t i = 0; i < nodes; ++i) {
        soup_.points[first + i] = numbers.point(8);
        if (has_parameters) numbers.skip(std::min<std::uint64_t>(dimension, 3), 8);
      }
    }
  }

  void read_elements(Numbers& numbers) {
    const std::uint64_t elements = count_of_section(numbers, numbers.is_binary() ? 1 : 3, "elements");
    for (std::uint64_t i = 0; i < elements;) {
      // Bytes have a head for several elements.
      std::uint64_t in_block = 1;
      if (!numbers.is_binary()) numbers.skip(1, 4);
      const Element_type type = type_of(numbers);
      if (numbers.is_binary()) in_block = numbers.count_with_room(4, 1 + type.nodes, "elements");
      const std::uint64_t tags = numbers.count(4, "the number of tags");
      for (std::uint64_t j = 0; j < in_block; ++j) {
        numbers.skip(tags + (numbers.is_binary() ? 1 : 0), 4);
        read_element(type, 4, numbers);
      }
      i += std::max<std::uint64_t>(in_block, 1);
    }
  }

  void read_blocks_of_elements(Numbers& numbers) {
    const std::uint64_t blocks = numbers.count_with_room(size_of_count_, 3, "blocks of elements");
    numbers.skip(3, size_of_count_);
    for (std::uint64_t block = 0; block < blocks; ++block) {
      numbers.skip(2, 4);
      const Element_type type = type_of(numbers);
      const std::uint64_t elements = numbers.count_with_room(size_of_count_, 1 + type.nodes, "elements");
      for (std::uint64_t i = 0; i < elements; ++i) {
        numbers.skip(1, size_of_count_);
        read_element(type, size_of_count_, numbers);
      }
    }
  }

  static Element_type type_of(Numbers& numbers) {
    const std::int64_t number = numbers.integer(4, "the type of an element");
    const auto* const found = std::find_if(element_types.begin(), element_types.end(),
                                           [&](const Element_type& type) { return type.number == number; });
    if (found == element_types.end())
      numbers.fail("there are elements of type " + std::to_string(number) + ", which are not read");
    return *found;
  }

  void read_element(const Element_type& type, std::size_t size, Numbers& numbers) {
    volumes_ += type.dimension == 3;
    if (type.dimension != 2) return numbers.skip(type.nodes, size);
    curved_ += type.nodes > type.corners;
    for (std::size_t i = 0; i < type.corners; ++i) {
      const std::uint64_t tag = numbers.count(size, "a node of the element");
      const auto found = index_of_tag_.find(tag);
      if (found == index_of_tag_.end())
        numbers.fail("the element names node " + std::to_string(tag) + ", which is not there");
      soup_.corners.push_back(found->second);
    }
    soup_.end_face();
    numbers.skip(type.nodes - type.corners, size);
  }

  const std::string& path_;
  Text text_;
  bool is_version_4_ = false, is_binary_ = false;
  std::size_t size_of_count_ = 8;
  Numbers::Order order_ = Numbers::Order::little;
  std::uint64_t count_ = 0;  // of the section
  std::unordered_map<std::uint64_t, Polygon_soup::Index> index_of_tag_;
  std::uint64_t volumes_ = 0, curved_ = 0;
  Polygon_soup soup_;
};

}  // namespace msh

/// Reads the faces of a Gmsh file of version 2.2 or 4.1, text or binary (https://gmsh.info/doc/texinfo/gmsh.html): triangles
/// and quads, in the order of the file. Curved ones are read by their corners; points, lines and, beside faces, volumes are
/// passed over.
inline Polygon_soup read_msh(const std::string& path, std::string_view content) {
  return msh::Reader(path, content).soup();
}

}  // namespace mesh_files

#endif
