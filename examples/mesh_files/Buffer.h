// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_BUFFER_H
#define MESH_FILES_BUFFER_H

#include "Output_file.h"

#include <boost/endian/conversion.hpp>

#include <array>
#include <charconv>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace mesh_files {

/// Collects what is written and hands it on in large blocks.
class Buffer {
 public:
  explicit Buffer(std::function<void(std::string_view)> sink) : sink_(std::move(sink)) { bytes_.reserve(block + 1024); }
  explicit Buffer(Output_file& file) : Buffer([&file](std::string_view bytes) { file.write(bytes); }) {}

  Buffer& operator<<(std::string_view text) {
    bytes_ += text;
    if (bytes_.size() > block) flush();
    return *this;
  }

  /// A number in the fewest digits that give it back exactly.
  template <class Number>
  void number(Number value) {
    std::array<char, 32> digits;
    *this << std::string_view(
        digits.data(), static_cast<std::size_t>(std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr -
                                                digits.data()));
  }

  /// Numbers with a blank before each.
  template <class Numbers>
  void row(const Numbers& values) {
    for (const auto value : values) {
      *this << " ";
      number(value);
    }
  }

  /// The bytes of a number, the lowest first.
  template <class Number>
  void binary(Number value) {
    std::array<unsigned char, sizeof(Number)> bytes;
    boost::endian::endian_store<Number, sizeof(Number), boost::endian::order::little>(bytes.data(), value);
    *this << std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }

  void flush() {
    sink_(bytes_);
    bytes_.clear();
  }

 private:
  static constexpr std::size_t block = 1 << 20;
  std::function<void(std::string_view)> sink_;
  std::string bytes_;
};

}  // namespace mesh_files

#endif
