// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_TEXT_H
#define MESH_FILES_TEXT_H

#include "Polygon_soup.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

namespace mesh_files {

/// The word as it may be shown in an error message: short, and printable whatever the file holds.
inline std::string printable(std::string_view word) {
  constexpr std::size_t longest = 30;
  std::string shown = "'";
  for (const char c : word.substr(0, longest)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (word.size() > longest ? "...'" : "'");
}

/// "3 of 8 vertices" and the like.
inline std::string count_of(std::uint64_t part, std::uint64_t whole, const std::string& what) {
  return std::to_string(part) + " of " + std::to_string(whole) + " " + what;
}

/// Whether the word is `lower_case`, in whatever case.
inline bool is_word(std::string_view word, std::string_view lower_case) {
  return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? char(a - 'A' + 'a') : a) == b; });
}

#ifdef __cpp_lib_to_chars
/// Fails as `std::from_chars()` does, but gives what is too small or too large its limit, 0 or infinity.
inline bool parse(std::string_view word, double& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return false;
  // from_chars tells neither underflow from overflow nor their values.
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(word).c_str(), nullptr);
  return true;
}
#else
/// For standard libraries that lack `std::from_chars()` for `double`.
inline bool parse(std::string_view word, double& value) {
  if (word.empty() || word.front() == '+' || word.find_first_of("xX") != std::string_view::npos) return false;
  const std::string digits(word);
  char* end = nullptr;
  value = std::strtod(digits.c_str(), &end);
  return end == digits.c_str() + digits.size();
}
#endif

template <class Integer>
bool parse(std::string_view word, Integer& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return end == word.data() + word.size() && error == std::errc();
}

/// Reads the number that a text begins with.
/// \returns where it ends; null if there is none, or telling takes more than a look at its digits, see `number_in()`
template <class Number>
const char* read_number([[maybe_unused]] const char* begin, [[maybe_unused]] const char* end,
                        [[maybe_unused]] Number& value) {
#ifdef __cpp_lib_to_chars
  constexpr bool is_known = true;
#else
  constexpr bool is_known = !std::is_floating_point_v<Number>;
#endif
  if constexpr (is_known) {
    const auto [after, error] = std::from_chars(begin, end, value);
    return error == std::errc() ? after : nullptr;
  } else {
    return nullptr;
  }
}

/// The number that a word spells, if it spells one: a `double`, which may be infinite or NaN, or an integer.
template <class Number>
std::optional<Number> number_in(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  Number value = 0;
  return parse(word, value) ? std::optional<Number>(value) : std::nullopt;
}

/// A text read line by line and word by word, which knows its place when something is wrong.
///
/// Lines end with LF, CR LF or CR, whichever comes. Blank lines and what follows a `#` are passed over.
class Text {
 public:
  /// What a backslash at the end of a line means.
  enum class Backslash { is_a_character, joins_lines };

  Text(std::string path, std::string_view content, Backslash backslash = Backslash::is_a_character)
      : path_(std::move(path)),
        rest_(content),
        ends_with_carriage_return_(starts_with_carriage_return(content.substr(end_of_line()))),
        joins_lines_(backslash == Backslash::joins_lines) {}

  /// Goes to the next line that has a word in it; false at the end of the text.
  bool next_line() {
    while (!rest_.empty()) {
      number_of_line_ += lines_taken_;
      lines_taken_ = 1;
      line_ = take_line();
      while (is_continued() && !rest_.empty()) {
        const std::string_view more = take_line();
        line_ = {line_.data(), static_cast<std::size_t>(more.data() + more.size() - line_.data())};
        ++lines_taken_;
      }
      remove_comment();
      skip_blanks();
      if (!line_.empty()) return true;
    }
    return false;
  }

  /// Goes to the line of the next item, of which the text should still hold some.
  void next_item(std::uint64_t item, std::uint64_t number_of_items, const std::string& items) {
    if (!next_line()) fail_at_end(count_of(item, number_of_items, items));
  }

  bool at_end_of_line() const { return line_.empty(); }

  /// What is left of the line.
  std::string_view rest_of_line() const { return line_; }

  void skip_line() { line_ = {}; }

  /// Goes to the next word, which may be on a later line; false at the end of the text.
  bool next_word() { return !at_end_of_line() || next_line(); }

  /// The next word of the line, empty at its end.
  std::string_view word() {
    std::size_t size = 0;
    while (size < line_.size() && !is_blank(line_[size])) ++size;
    const std::string_view found = line_.substr(0, size);
    line_.remove_prefix(size);
    skip_blanks();
    return found;
  }

  /// The next word as a number; `what` it is supposed to be names it in the error.
  double number(const char* what) { return next_as<double>(what, "a number"); }

  /// The next word as a whole number.
  std::int64_t integer(const char* what) { return next_as<std::int64_t>(what, "a whole number"); }

  /// The next word as a whole number >= 0.
  std::uint64_t count(const char* what) {
    const std::int64_t value = integer(what);
    if (value < 0) fail(std::string(what) + " is negative: " + std::to_string(value));
    return static_cast<std::uint64_t>(value);
  }

  /// The next word as a number that is finite.
  double coordinate(const char* what) {
    const double value = number(what);
    if (!std::isfinite(value)) fail(std::string(what) + " is not finite");
    return value;
  }

  /// The next three words as a point.
  Polygon_soup::Point point() {
    const double x = coordinate("the x coordinate"), y = coordinate("the y coordinate");
    return {x, y, coordinate("the z coordinate")};
  }

  /// What follows the line.
  std::string_view rest() const { return rest_; }

  [[noreturn]] void fail(const std::string& cause) const { fail_at_line(number_of_line_, cause); }
  [[noreturn]] void fail_at_line(std::size_t line, const std::string& cause) const {
    throw Unreadable_file(path_ + ":" + std::to_string(line) + ": " + cause);
  }
  [[noreturn]] void fail_at_end(const std::string& what_there_is) const {
    throw Unreadable_file(path_ + ":" + std::to_string(number_of_line_) + ": the file ends here, after " +
                          what_there_is);
  }

  /// Counts from 1; 0 before the first line.
  std::size_t number_of_line() const { return number_of_line_; }

 private:
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == '\\'; }

  /// Whether it starts with a CR that is a line end by itself.
  static bool starts_with_carriage_return(std::string_view text) {
    return !text.empty() && text[0] == '\r' && text.substr(1, 1) != "\n";
  }

  /// Goes on to the next `wanted` from `begin` on, or `end` if there is none. Each of them is looked for once in the whole
  /// text, however far away it is.
  static void find_next(const char*& known, const char* begin, const char* end, char wanted) {
    if (known >= begin || begin == end) return;
    const void* const found = std::memchr(begin, wanted, static_cast<std::size_t>(end - begin));
    known = found ? static_cast<const char*>(found) : end;
  }

  /// Where the line ends that `rest_` begins with.
  std::size_t end_of_line() {
    const char* const begin = rest_.data();
    const char* const end = begin + rest_.size();
    find_next(next_line_feed_, begin, end, '\n');
    find_next(next_carriage_return_, begin, end, '\r');
    return begin == end ? 0 : static_cast<std::size_t>(std::min(next_line_feed_, next_carriage_return_) - begin);
  }

  std::string_view take_line() {
    const std::size_t size = end_of_line();
    const std::string_view line = rest_.substr(0, size);
    // After a header whose lines end with CR, binary data may begin with the byte LF.
    const bool is_pair = !ends_with_carriage_return_ && rest_.substr(size, 2) == "\r\n";
    rest_.remove_prefix(std::min(size + (is_pair ? 2 : 1), rest_.size()));
    return line;
  }

  bool is_continued() const {
    if (!joins_lines_) return false;
    const std::size_t last = line_.find_last_not_of(" \t\r");
    return last != std::string_view::npos && line_[last] == '\\' && line_.find('#') == std::string_view::npos;
  }

  /// Ends the line where a comment begins.
  void remove_comment() {
    if (line_.empty()) return;
    const char* const begin = line_.data();
    find_next(next_hash_, begin, rest_.data() + rest_.size(), '#');
    line_ = line_.substr(0, static_cast<std::size_t>(next_hash_ - begin));
  }

  void skip_blanks() {
    std::size_t size = 0;
    while (size < line_.size() && is_blank(line_[size])) ++size;
    line_.remove_prefix(size);
  }

  template <class Number>
  Number next_as(const char* what, const char* kind) {
    Number read = 0;
    const char* const end = line_.data() + line_.size();
    const char* const after = read_number(line_.data(), end, read);
    if (after && (after == end || is_blank(*after))) {
      line_.remove_prefix(static_cast<std::size_t>(after - line_.data()));
      skip_blanks();
      return read;
    }
    const std::string_view digits = word();
    if (digits.empty()) fail(std::string(what) + " is missing");
    const std::optional<Number> value = number_in<Number>(digits);
    if (!value) fail(std::string(what) + " is " + printable(digits) + ", not " + kind);
    return *value;
  }

  std::string path_;
  std::string_view rest_;
  std::string_view line_;
  const char* next_line_feed_ =
      nullptr;  // the first one in the rest, or the end of the text; known since it was needed
  const char* next_carriage_return_ = nullptr;
  const char* next_hash_ = nullptr;
  bool ends_with_carriage_return_;  // the first line
  bool joins_lines_;
  std::size_t number_of_line_ = 0;
  std::size_t lines_taken_ = 1;
};

}  // namespace mesh_files

#endif
