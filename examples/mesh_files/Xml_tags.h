// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_XML_TAGS_H
#define MESH_FILES_XML_TAGS_H

#include "Polygon_soup.h"
#include "Text.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mesh_files {

/// The tags of a file one after the other, and what is between them, as they stand there: no entity is replaced.
///
/// Any parser of XML reads the models of 3MF files. None does for VTK's files: what follows their tags may be any bytes, which
/// makes the file no XML; the texts are as large as the mesh and need no copy; and that of Boost, which a page in a browser
/// could be built with, calls itself for each element within another, so that a small file of nothing but `<a>` overflows its
/// stack.
class Xml_tags {
 public:
  Xml_tags(const std::string& path, std::string_view content) : path_(path), content_(content) {}

  /// Goes to the next tag, past comments, instructions and declarations; false at the end of the file.
  bool next() {
    for (;;) {
      const std::size_t begin = content_.find('<', position_);
      if (begin == std::string_view::npos) return false;
      text_before_ = content_.substr(position_, begin - position_);
      begin_ = begin;
      const std::string_view after = content_.substr(begin + 1);
      if (after.substr(0, 3) == "!--")
        skip_to("-->", "a comment");
      else if (after.substr(0, 1) == "?")
        skip_to("?>", "an instruction");
      else if (after.substr(0, 1) == "!")
        skip_to(">", "a declaration");
      else
        return read_tag(), true;
    }
  }

  std::string_view name() const { return name_; }
  /// Whether it is `</name>`.
  bool is_closing() const { return is_closing_; }
  /// Whether it is `<name/>`, which has no text and no closing tag.
  bool is_empty() const { return is_empty_; }

  std::optional<std::string_view> attribute(std::string_view wanted) const {
    for (const auto& [name, value] : attributes_)
      if (name == wanted) return value;
    return std::nullopt;
  }

  /// The names and values of all of them.
  const std::vector<std::pair<std::string_view, std::string_view>>& attributes() const { return attributes_; }

  /// What stands between the tag before and this one.
  std::string_view text_before() const { return text_before_; }

  /// What stands behind the tag.
  std::string_view rest() const { return content_.substr(position_); }

  /// A place in the file, for errors: where the tag begins.
  const char* place() const { return content_.data() + begin_; }

  /// \param cause is said of the line of the tag
  [[noreturn]] void fail(const std::string& cause) const { fail_at(place(), cause); }
  [[noreturn]] void fail_at(const char* place, const std::string& cause) const {
    const auto line = 1 + std::count(content_.data(), place, '\n');
    throw Unreadable_file(path_ + ":" + std::to_string(line) + ": " + cause);
  }

 private:
  static constexpr std::string_view blanks = " \t\r\n";

  void skip_to(std::string_view end, const char* what) {
    const std::size_t found = content_.find(end, begin_);
    if (found == std::string_view::npos) fail(std::string("the file ends within ") + what);
    position_ = found + end.size();
  }

  void read_tag() {
    attributes_.clear();
    position_ = begin_ + 1;
    is_closing_ = take("/");
    name_ = take_word();
    if (name_.empty()) fail("a tag has no name");
    for (;;) {
      skip_blanks();
      is_empty_ = take("/");
      if (take(">")) return;
      if (is_empty_) fail("the tag " + printable(name_) + " is broken");
      const std::string_view attribute = take_word();
      skip_blanks();
      const bool has_value = !attribute.empty() && take("=");
      skip_blanks();
      if (!has_value || position_ >= content_.size()) fail("the tag " + printable(name_) + " is broken");
      attributes_.emplace_back(attribute, take_quoted());
    }
  }

  bool take(std::string_view wanted) {
    const bool is_there = content_.substr(position_, wanted.size()) == wanted;
    if (is_there) position_ += wanted.size();
    return is_there;
  }

  void skip_blanks() { position_ = std::min(content_.find_first_not_of(blanks, position_), content_.size()); }

  std::string_view take_word() {
    const std::size_t end = std::min(content_.find_first_of(" \t\r\n/>=<\"'", position_), content_.size());
    const std::string_view word = content_.substr(position_, end - position_);
    position_ = end;
    return word;
  }

  std::string_view take_quoted() {
    const char quote = content_[position_];
    const std::size_t end = content_.find(quote, position_ + 1);
    if ((quote != '"' && quote != '\'') || end == std::string_view::npos)
      fail("the tag " + printable(name_) + " is broken");
    const std::string_view value = content_.substr(position_ + 1, end - position_ - 1);
    position_ = end + 1;
    return value;
  }

  const std::string& path_;
  std::string_view content_, text_before_, name_;
  std::size_t begin_ = 0, position_ = 0;  // of the tag, and behind it
  bool is_closing_ = false, is_empty_ = false;
  std::vector<std::pair<std::string_view, std::string_view>> attributes_;
};

}  // namespace mesh_files

#endif
