// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_ZIP_H
#define MESH_FILES_WRITE_ZIP_H

#include "Buffer.h"
#include "Output.h"

#include <boost/crc.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace mesh_files {

/// Writes a ZIP archive, whose files are stored as they are. Every archive of the same files is the same to the byte.
class Zip_archive {
 public:
  explicit Zip_archive(Output& file) : path_(file.path()), out_(file) {}

  /// \throws Unwritable_file if the archive becomes larger than 4 GiB
  void add(const std::string& name, std::string_view content) {
    boost::crc_32_type sum;
    sum.process_bytes(content.data(), content.size());
    const Entry entry = {name, number(content.size()), number(offset_), sum.checksum()};
    constexpr std::uint32_t signature = 0x04034b50;
    out_.binary(signature);
    write_description(entry);
    out_ << name << content;
    offset_ += size_of_local_header + name.size() + content.size();
    number(offset_);
    entries_.push_back(entry);
  }

  /// Writes the list of the files.
  void finish() {
    constexpr std::uint32_t signature = 0x02014b50, signature_of_end = 0x06054b50;
    std::size_t size = 0;
    for (const Entry& entry : entries_) {
      out_.binary(signature);
      out_.binary(version);  // by which it was made
      write_description(entry);
      zeros(2 + 2 + 2 + 4);  // comment, disk, attributes
      out_.binary(entry.offset);
      out_ << entry.name;
      size += size_of_central_header + entry.name.size();
    }
    out_.binary(signature_of_end);
    zeros(4);  // disks
    out_.binary(static_cast<std::uint16_t>(entries_.size()));
    out_.binary(static_cast<std::uint16_t>(entries_.size()));
    out_.binary(number(size));
    out_.binary(number(offset_));
    zeros(2);  // comment
    out_.flush();
  }

 private:
  struct Entry {
    std::string name;
    std::uint32_t size = 0, offset = 0, sum = 0;
  };
  static constexpr std::size_t size_of_local_header = 30, size_of_central_header = 46;
  static constexpr std::uint16_t version = 20;

  std::uint32_t number(std::size_t value) const {
    if (value > std::numeric_limits<std::uint32_t>::max())
      throw Unwritable_file(path_ + ": the archive would be larger than 4 GiB");
    return static_cast<std::uint32_t>(value);
  }

  void zeros(std::size_t number_of_bytes) { out_ << std::string(number_of_bytes, '\0'); }

  void write_description(const Entry& entry) {
    constexpr std::uint16_t first_day = 1 << 5 | 1;  // of 1980
    out_.binary(version);
    zeros(2 + 2 + 2);  // flags, stored, time
    out_.binary(first_day);
    out_.binary(entry.sum);
    out_.binary(entry.size);
    out_.binary(entry.size);
    out_.binary(static_cast<std::uint16_t>(entry.name.size()));
    zeros(2);  // extra field
  }

  std::string path_;
  Buffer out_;
  std::size_t offset_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace mesh_files

#endif
