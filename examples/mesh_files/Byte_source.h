// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_BYTE_SOURCE_H
#define MESH_FILES_BYTE_SOURCE_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mesh_files {

/// Takes bytes from where they stand in a file: as they are, or in base64.
///
/// Each stream of base64 may end with `=`, and others may follow: programs differ in what they put into one of them.
class Byte_source {
 public:
  Byte_source(std::string_view text, bool is_base64) : text_(text), is_base64_(is_base64) {}

  /// The next bytes; nothing if there are fewer, or what is there is no base64.
  std::optional<std::string> take(std::uint64_t size) {
    if (size > most_left()) return std::nullopt;
    std::string result;
    if (!is_base64_) {
      result = text_.substr(0, size);
      text_.remove_prefix(size);
      return result;
    }
    result.reserve(size);
    while (result.size() < size) {
      if (taken_ == decoded_.size() && !decode()) return std::nullopt;
      const std::size_t more = std::min<std::size_t>(size - result.size(), decoded_.size() - taken_);
      result += decoded_.substr(taken_, more);
      taken_ += more;
    }
    return result;
  }

  /// As many bytes as there may be, or more.
  std::uint64_t most_left() const {
    return is_base64_ ? text_.size() / 4 * 3 + decoded_.size() - taken_ : text_.size();
  }

 private:
  /// The value of a letter of base64; 64 for any other.
  static unsigned value_of(char letter) {
    if (letter >= 'A' && letter <= 'Z') return static_cast<unsigned>(letter - 'A');
    if (letter >= 'a' && letter <= 'z') return static_cast<unsigned>(letter - 'a') + 26;
    if (letter >= '0' && letter <= '9') return static_cast<unsigned>(letter - '0') + 52;
    return letter == '+' ? 62 : letter == '/' ? 63 : 64;
  }

  /// Decodes the next four letters; false if they are not there.
  bool decode() {
    text_.remove_prefix(std::min(text_.find_first_not_of(" \t\r\n"), text_.size()));
    const std::string_view letters = text_.substr(0, 4);
    if (letters.size() < 4) return false;
    text_.remove_prefix(4);
    const std::size_t used = letters[3] != '=' ? 4 : letters[2] != '=' ? 3 : 2;
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const unsigned value = i < used ? value_of(letters[i]) : 0;
      if (value > 63) return false;
      bits = bits << 6 | value;
    }
    decoded_ = {static_cast<char>(bits >> 16 & 255), static_cast<char>(bits >> 8 & 255), static_cast<char>(bits & 255)};
    decoded_.resize(used - 1);
    taken_ = 0;
    return true;
  }

  std::string_view text_;
  bool is_base64_;
  std::string decoded_;  // of four letters
  std::size_t taken_ = 0;
};

}  // namespace mesh_files

#endif
