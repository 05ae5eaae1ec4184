// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_NUMBERS_H
#define MESH_FILES_NUMBERS_H

#include "Polygon_soup.h"
#include "Text.h"

#include <boost/endian/conversion.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace mesh_files {

/// Numbers one after the other, for formats that have them as words of a text or as bytes: words may be on any line.
class Numbers {
 public:
  using Order = boost::endian::order;

  /// The words of a text from where it stands.
  explicit Numbers(Text& text) : text_(&text) {}

  /// \param text names the file in errors
  Numbers(Text& text, std::string_view bytes, Order order)
      : text_(&text), is_binary_(true), order_(order), bytes_(bytes) {}

  /// A whole number, which bytes hold in 4 or 8 of them.
  std::int64_t integer(std::size_t size, const char* what) {
    if (!is_binary_) return next_word(what).integer(what);
    return size == 8 ? load<std::int64_t>(what) : load<std::int32_t>(what);
  }

  /// A whole number >= 0.
  std::uint64_t count(std::size_t size, const char* what) {
    const std::int64_t value = integer(size, what);
    if (value < 0) fail(std::string(what) + " is negative: " + std::to_string(value));
    return static_cast<std::uint64_t>(value);
  }

  /// A count of items, of which each takes so many numbers or more: no more than there is room for.
  std::uint64_t count_with_room(std::size_t size, std::uint64_t numbers, const std::string& items) {
    const std::uint64_t value = count(size, "a count");
    // A word takes two bytes, with the blank behind it.
    const std::size_t least = is_binary_ ? 4 : 2,
                      room = is_binary_ ? bytes_.size() : text_->rest_of_line().size() + text_->rest().size();
    if (value > (room + 2) / (least * numbers))
      fail("the file promises " + std::to_string(value) + " " + items + ", more than it has room for");
    return value;
  }

  /// A finite number, which bytes hold in 4 or 8 of them.
  double coordinate(std::size_t size) {
    if (!is_binary_) return next_word("a coordinate").coordinate("a coordinate");
    const double value = size == 8 ? load<double>("a coordinate") : double(load<float>("a coordinate"));
    if (!std::isfinite(value)) fail("a coordinate is not finite");
    return value;
  }

  Polygon_soup::Point point(std::size_t size, std::size_t dimensions = 3) {
    std::array<double, 3> p = {0, 0, 0};
    for (std::size_t i = 0; i < dimensions; ++i) p[i] = coordinate(size);
    return {p[0], p[1], p[2]};
  }

  /// Passes over numbers.
  void skip(std::uint64_t numbers, std::size_t size) {
    if (is_binary_) {
      if (numbers > bytes_.size() / size) fail_at_end("numbers");
      bytes_.remove_prefix(numbers * size);
    }
    for (std::uint64_t i = 0; !is_binary_ && i < numbers; ++i) next_word("a number").word();
  }

  /// The bytes that are left.
  std::string_view bytes() const { return bytes_; }
  bool is_binary() const { return is_binary_; }

  [[noreturn]] void fail(const std::string& cause) const { text_->fail(cause); }

 private:
  [[noreturn]] void fail_at_end(const char* what) const {
    fail("the file ends where " + std::string(what) + " should be");
  }

  Text& next_word(const char* what) {
    if (!text_->next_word()) fail_at_end(what);
    return *text_;
  }

  template <class Number>
  Number load(const char* what) {
    if (bytes_.size() < sizeof(Number)) fail_at_end(what);
    const auto* const first = reinterpret_cast<const unsigned char*>(bytes_.data());
    bytes_.remove_prefix(sizeof(Number));
    return order_ == Order::little ? boost::endian::endian_load<Number, sizeof(Number), Order::little>(first)
                                   : boost::endian::endian_load<Number, sizeof(Number), Order::big>(first);
  }

  Text* text_;
  bool is_binary_ = false;
  Order order_ = Order::little;
  std::string_view bytes_;
};

/// What is said of elements of a mesh of volumes or curves that are no faces.
/// \throws Unreadable_file if there is nothing but volumes
inline void note_other_elements(const std::string& path, std::uint64_t volumes, std::uint64_t curved,
                                Polygon_soup& soup) {
  if (volumes > 0 && soup.number_of_faces() == 0)
    throw Unreadable_file(path + ": the mesh has " + std::to_string(volumes) +
                          (volumes == 1 ? " element" : " elements") +
                          " of volume and no surface; save the faces of its surface, too");
  if (volumes > 0)
    soup.remarks.push_back("passed over " + std::to_string(volumes) +
                           (volumes == 1 ? " element of volume" : " elements of volume"));
  if (curved > 0)
    soup.remarks.push_back(curved == 1
                               ? "1 curved face was read as a flat one between its corners"
                               : std::to_string(curved) + " curved faces were read as flat ones between their corners");
}

}  // namespace mesh_files

#endif
