// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_ZIP_H
#define MESH_FILES_READ_ZIP_H

#include "Polygon_soup.h"
#include "Text.h"
#include "inflate.h"

#include <boost/crc.hpp>
#include <boost/endian/conversion.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mesh_files {

inline bool is_zip(std::string_view content) { return content.substr(0, 4) == "PK\3\4"; }

/// The files in a ZIP archive (PKWARE's APPNOTE.TXT), stored or packed by Deflate; with the wider numbers of ZIP64, too.
class Zip_files {
 public:
  /// Where a file is in the archive.
  struct Entry {
    std::string name;
    std::uint64_t packed_size = 0, size = 0, header = 0;
    std::uint32_t sum = 0;
    std::uint16_t method = 0;
    bool is_encrypted = false;
  };

  /// \param path of the archive, for messages
  /// \param content stays in use
  /// \throws Unreadable_file if the archive is cut off, or the list of its files is broken
  Zip_files(std::string path, std::string_view content) : path_(std::move(path)), content_(content) {
    const std::size_t end = content_.rfind("PK\5\6");
    if (!has(end, size_of_end)) fail("the ZIP archive is cut off");
    std::uint64_t number = number_at<std::uint16_t>(end + 10), at = number_at<std::uint32_t>(end + 16);
    if (const std::optional<std::uint64_t> wide = wide_end(end)) {
      number = number_at<std::uint64_t>(*wide + 32);
      at = number_at<std::uint64_t>(*wide + 48);
    }
    for (; number > 0; --number) at = read_entry(at);
  }

  const std::vector<Entry>& entries() const { return entries_; }

  /// The file of a name, in whatever case; null if there is none.
  const Entry* find(std::string_view name) const {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
      return std::equal(entry.name.begin(), entry.name.end(), name.begin(), name.end(),
                        [&](char a, char b) { return lower(a) == lower(b); });
    });
    return found == entries_.end() ? nullptr : &*found;
  }

  /// What a file held when it was packed.
  /// \throws Unreadable_file if that cannot be had
  std::string bytes(const Entry& entry) const {
    const auto fail_for = [&](const std::string& cause) { fail("its part " + printable(entry.name) + " " + cause); };
    constexpr std::uint16_t stored = 0, deflated = 8;
    if (entry.is_encrypted) fail_for("is encrypted");
    if (entry.method != stored && entry.method != deflated)
      fail_for("is packed by method " + std::to_string(entry.method) + ", not by Deflate");
    std::optional<std::string> result;
    if (has(entry.header, size_of_header)) {
      const std::uint64_t begin = entry.header + size_of_header + number_at<std::uint16_t>(entry.header + 26) +
                                  number_at<std::uint16_t>(entry.header + 28);
      if (has(begin, entry.packed_size)) {
        const std::string_view packed = content_.substr(begin, entry.packed_size);
        result = entry.method == stored ? std::string(packed) : inflated(packed, entry.size);
      }
    }
    boost::crc_32_type sum;
    if (result) sum.process_bytes(result->data(), result->size());
    if (!result || sum.checksum() != entry.sum) fail_for("is damaged: it is not what was packed");
    return *std::move(result);
  }

  [[noreturn]] void fail(const std::string& cause) const { throw Unreadable_file(path_ + ": " + cause); }

 private:
  // Of the records that are read, without what follows in them at any length.
  static constexpr std::size_t size_of_end = 22, size_of_wide_end = 56, size_of_locator = 20, size_of_entry = 46,
                               size_of_header = 30;

  bool has(std::uint64_t begin, std::uint64_t size) const {
    return begin <= content_.size() && size <= content_.size() - begin;
  }

  /// \pre it is there
  template <class Integer>
  Integer number_at(std::uint64_t at) const {
    return boost::endian::endian_load<Integer, sizeof(Integer), boost::endian::order::little>(
        reinterpret_cast<const unsigned char*>(content_.data() + at));
  }

  /// Where the end of an archive of ZIP64 is, if it is one.
  std::optional<std::uint64_t> wide_end(std::uint64_t end) const {
    if (end < size_of_locator || content_.substr(end - size_of_locator, 4) != "PK\6\7") return std::nullopt;
    const auto found = number_at<std::uint64_t>(end - size_of_locator + 8);
    if (!has(found, size_of_wide_end) || content_.substr(found, 4) != "PK\6\6") fail_at_list();
    return found;
  }

  /// \returns where the next one begins
  std::uint64_t read_entry(std::uint64_t at) {
    if (!has(at, size_of_entry) || content_.substr(at, 4) != "PK\1\2") fail_at_list();
    const std::uint64_t name = at + size_of_entry, extra = name + number_at<std::uint16_t>(at + 28),
                        comment = extra + number_at<std::uint16_t>(at + 30);
    if (!has(name, comment - name)) fail_at_list();
    Entry entry;
    entry.name = content_.substr(name, extra - name);
    entry.is_encrypted = (number_at<std::uint16_t>(at + 8) & 1) != 0;
    entry.method = number_at<std::uint16_t>(at + 10);
    entry.sum = number_at<std::uint32_t>(at + 16);
    entry.packed_size = number_at<std::uint32_t>(at + 20);
    entry.size = number_at<std::uint32_t>(at + 24);
    entry.header = number_at<std::uint32_t>(at + 42);
    read_wide_numbers(entry, extra, comment);
    entries_.push_back(std::move(entry));
    return comment + number_at<std::uint16_t>(at + 32);
  }

  /// Takes the numbers of an entry that 32 bits cannot hold from its extra field.
  void read_wide_numbers(Entry& entry, std::uint64_t field, std::uint64_t end) const {
    constexpr std::uint64_t elsewhere = 0xffffffff, size_of_head = 4;
    constexpr std::uint16_t wide_numbers = 1;
    while (end - field >= size_of_head) {
      const auto kind = number_at<std::uint16_t>(field), size = number_at<std::uint16_t>(field + 2);
      field += size_of_head;
      if (size > end - field) return;
      std::uint64_t at = field;
      field += size;
      if (kind != wide_numbers) continue;
      for (std::uint64_t* const number : {&entry.size, &entry.packed_size, &entry.header})
        if (*number == elsewhere && field - at >= sizeof(std::uint64_t)) {
          *number = number_at<std::uint64_t>(at);
          at += sizeof(std::uint64_t);
        }
    }
  }

  [[noreturn]] void fail_at_list() const { fail("the ZIP archive is damaged: the list of its files is broken"); }

  std::string path_;
  std::string_view content_;
  std::vector<Entry> entries_;
};

}  // namespace mesh_files

#endif
