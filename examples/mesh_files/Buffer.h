// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_BUFFER_H
#define MESH_FILES_BUFFER_H

#include "Output.h"

#include <boost/endian/conversion.hpp>

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace mesh_files {

#ifdef __cpp_lib_to_chars
/// Writes a number in the fewest digits that give it back exactly.
/// \returns where they end
template <class Number>
char* write_digits(char* begin, char* end, Number value) {
  return std::to_chars(begin, end, value).ptr;
}
#else
/// For standard libraries that lack `std::to_chars()` for `double`.
template <class Number>
char* write_digits(char* begin, char* end, Number value) {
  if constexpr (std::is_floating_point_v<Number>) {
    for (int digits = std::numeric_limits<Number>::digits10;; ++digits) {
      const int written = std::snprintf(begin, static_cast<std::size_t>(end - begin), "%.*g", digits, double(value));
      const bool is_float = std::is_same_v<Number, float>;
      const double read = is_float ? double(std::strtof(begin, nullptr)) : std::strtod(begin, nullptr);
      if (read == double(value) || digits >= std::numeric_limits<Number>::max_digits10) return begin + written;
    }
  } else {
    return std::to_chars(begin, end, value).ptr;
  }
}
#endif

/// Collects what is written and hands it on in large blocks.
class Buffer {
 public:
  explicit Buffer(std::function<void(std::string_view)> sink) : sink_(std::move(sink)) { bytes_.reserve(block + 1024); }
  explicit Buffer(Output& file) : Buffer([&file](std::string_view bytes) { file.write(bytes); }) {}

  Buffer& operator<<(std::string_view text) {
    bytes_ += text;
    if (bytes_.size() > block) flush();
    return *this;
  }

  /// A number in the fewest digits that give it back exactly.
  template <class Number>
  void number(Number value) {
    std::array<char, 32> digits;
    const char* const end = write_digits(digits.data(), digits.data() + digits.size(), value);
    *this << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
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
