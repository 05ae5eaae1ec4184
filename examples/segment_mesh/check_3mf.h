// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_CHECK_3MF_H
#define SEGMENT_MESH_CHECK_3MF_H

#include "../mesh_files/Polygon_soup.h"

#include <boost/beast/zlib/inflate_stream.hpp>
#include <boost/crc.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace segment_mesh {

/// A ZIP archive as far as it is needed to tell whether its files are what was packed.
class Packed_archive {
 public:
  /// \param content stays in use
  explicit Packed_archive(std::string_view content) : content_(content), end_(content.rfind("PK\5\6")) {
    if (part(end_, size_of_end).empty()) end_ = std::string_view::npos;
  }

  /// Whether its end is there, without which it has no directory.
  bool has_end() const { return end_ != std::string_view::npos; }

  /// Calls `use(name, is_whole)` for each file of the directory. Files of more than 4 GiB and those that are packed in other
  /// ways than usual count as whole.
  /// \returns whether the directory is whole
  /// \pre `has_end()`
  template <class Use>
  bool for_each_file(const Use& use) const {
    std::size_t at = number(end_ + 16, 4);
    for (std::size_t files = number(end_ + 10, 2); files > 0; --files) {
      const std::string_view entry = part(at, size_of_entry);
      if (entry.substr(0, 4) != "PK\1\2") return at == too_large;
      const std::size_t size_of_name = number(at + 28, 2);
      use(part(at + size_of_entry, size_of_name), is_whole(at));
      at += size_of_entry + size_of_name + number(at + 30, 2) + number(at + 32, 2);
    }
    return true;
  }

 private:
  static constexpr std::size_t size_of_end = 22, size_of_entry = 46, size_of_header = 30;
  static constexpr std::size_t too_large = 0xffffffff;  // where the number is elsewhere

  /// Empty where the content ends before.
  std::string_view part(std::size_t begin, std::size_t size) const {
    return begin <= content_.size() && size <= content_.size() - begin ? content_.substr(begin, size)
                                                                       : std::string_view();
  }

  /// A number whose lowest byte is the first.
  std::size_t number(std::size_t at, std::size_t bytes) const {
    std::size_t value = 0;
    for (std::size_t i = bytes; i-- > 0;) value = value << 8 | static_cast<unsigned char>(content_[at + i]);
    return value;
  }

  bool is_whole(std::size_t entry) const {
    const std::size_t method = number(entry + 10, 2), sum = number(entry + 16, 4), size = number(entry + 20, 4),
                      header = number(entry + 42, 4);
    if (size == too_large || header == too_large) return true;
    if (part(header, size_of_header).empty()) return false;
    const std::size_t begin = header + size_of_header + number(header + 26, 2) + number(header + 28, 2);
    const std::string_view packed = part(begin, size);
    if (packed.size() < size) return false;
    constexpr std::size_t stored = 0, deflated = 8;
    boost::crc_32_type found;
    if (method == stored) found.process_bytes(packed.data(), packed.size());
    return method == stored     ? found.checksum() == sum
           : method == deflated ? unpack(packed, found) && found.checksum() == sum
                                : true;
  }

  /// Sums up what bytes hold that are packed by Deflate (RFC 1951).
  /// \returns whether they can be unpacked
  static bool unpack(std::string_view packed, boost::crc_32_type& sum) {
    namespace zlib = boost::beast::zlib;
    std::array<char, 1 << 15> block;
    zlib::inflate_stream stream;
    zlib::z_params buffers;
    buffers.next_in = packed.data();
    buffers.avail_in = packed.size();
    boost::beast::error_code outcome;
    while (!outcome) {
      buffers.next_out = block.data();
      buffers.avail_out = block.size();
      stream.write(buffers, zlib::Flush::none, outcome);
      sum.process_bytes(block.data(), block.size() - buffers.avail_out);
    }
    return outcome == zlib::error::end_of_stream;
  }

  std::string_view content_;
  std::size_t end_;
};

/// Refuses a 3MF file that is damaged or holds no model. Assimp, as Debian builds it, ends the program there.
/// \throws mesh_files::Unreadable_file
inline void refuse_broken_3mf(const std::string& path, std::string_view content) {
  const auto refuse = [&](const std::string& cause) { throw mesh_files::Unreadable_file(path + ": " + cause); };
  if (content.empty()) refuse("the file is empty");
  if (content.substr(0, 4) != "PK\3\4") refuse("this is no 3MF file, which is a ZIP archive");
  const Packed_archive archive(content);
  if (!archive.has_end()) refuse("the 3MF file is cut off");
  bool has_model = false;
  const bool has_directory = archive.for_each_file([&](std::string_view name, bool is_whole) {
    if (!is_whole) refuse("the 3MF file is damaged: its part " + std::string(name) + " is not what was packed");
    constexpr std::string_view ending = ".model";
    has_model = has_model || (name.size() > ending.size() && name.substr(name.size() - ending.size()) == ending);
  });
  if (!has_directory) refuse("the 3MF file is damaged: the list of its parts is broken");
  if (!has_model) refuse("the 3MF file holds no model");
}

}  // namespace segment_mesh

#endif
