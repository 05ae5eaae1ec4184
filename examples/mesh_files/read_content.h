// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_CONTENT_H
#define MESH_FILES_READ_CONTENT_H

#include "Format.h"
#include "Polygon_soup.h"

// Windows has no such headers; files are read there.
#if __has_include(<sys/mman.h>)
#define MESH_FILES_MAPS_FILES
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#ifdef RW_SEGMENTATION_WITH_ZLIB
#include <zlib.h>
#endif

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

namespace mesh_files {

/// The path that stands for standard input.
constexpr const char* standard_input = "-";

/// All bytes of a file, a pipe or, for "-", of standard input.
/// \throws Unreadable_file if there is no such file
inline std::string read_content(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw Unreadable_file(path + ": this is a folder");
  const auto fail = [&] { return Unreadable_file(path + ": " + std::strerror(errno)); };
  const bool is_input = path == standard_input;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(is_input ? nullptr : std::fopen(path.c_str(), "rb"),
                                                               [](std::FILE* f) { return f ? std::fclose(f) : 0; });
  std::FILE* const file = is_input ? stdin : opened.get();
  if (!file) throw fail();
  // The size of a pipe is not known; that of a file spares copies.
  const std::uintmax_t size = is_input ? 0 : std::filesystem::file_size(path, ignored);
  constexpr std::size_t smallest_block = 1 << 16;
  std::string content(is_input || ignored ? smallest_block : static_cast<std::size_t>(size) + 1, '\0');
  std::size_t read = 0;
  for (;;) {
    read += std::fread(content.data() + read, 1, content.size() - read, file);
    if (read < content.size()) break;
    content.resize(2 * content.size());
  }
  if (std::ferror(file)) throw fail();
  content.resize(read);
  return content;
}

/// The bytes of a file as they stand on disk, without a copy where memory can be mapped to them; those of a pipe or, for
/// "-", of standard input are read.
///
/// Whoever shortens a mapped file takes its bytes away: reading them then ends the program (SIGBUS).
class File_content {
 public:
  /// \throws Unreadable_file if there is no such file
  explicit File_content(const std::string& path) {
    if (path != standard_input) map(path);
    if (!mapped_) read_ = read_content(path);
  }

  File_content(const File_content&) = delete;
  File_content& operator=(const File_content&) = delete;

  ~File_content() {
#ifdef MESH_FILES_MAPS_FILES
    if (mapped_) ::munmap(mapped_, size_);
#endif
  }

  std::string_view bytes() const {
    return mapped_ ? std::string_view(static_cast<const char*>(mapped_), size_) : read_;
  }

 private:
  void map([[maybe_unused]] const std::string& path) {
#ifdef MESH_FILES_MAPS_FILES
    struct stat status {};
    // Whoever writes to a pipe must not see it opened and closed again.
    if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return;
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    if (::fstat(file, &status) == 0 && status.st_size > 0) {
      size_ = static_cast<std::size_t>(status.st_size);
      void* const memory = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
      if (memory != MAP_FAILED) mapped_ = memory;
    }
    ::close(file);
    if (mapped_) ::madvise(mapped_, size_, MADV_WILLNEED);
#endif
  }

  void* mapped_ = nullptr;
  std::size_t size_ = 0;
  std::string read_;  // where nothing is mapped
};

inline bool is_gzip(std::string_view content) { return content.substr(0, 2) == "\x1f\x8b"; }

/// What a gzip file holds, which may be several parts one after the other.
/// \throws Unreadable_file if it is broken or cut off, or zlib is not compiled in
inline std::string unpacked(const std::string& path, [[maybe_unused]] std::string_view content) {
#ifdef RW_SEGMENTATION_WITH_ZLIB
  constexpr int any_window = 15, gzip_only = 16;
  z_stream stream{};
  if (inflateInit2(&stream, any_window + gzip_only) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, &inflateEnd);
  const auto fail = [&](const std::string& cause) { return Unreadable_file(path + ": the gzip file is " + cause); };
  const auto size_for_zlib = [](std::size_t size) {
    return static_cast<uInt>(std::min<std::size_t>(size, std::numeric_limits<uInt>::max()));
  };

  // Four times its size is common; the buffer grows with what is there, not with what is promised.
  std::string result(4 * content.size() + 1024, '\0');
  std::size_t taken = 0, given = 0;
  for (;;) {
    if (given == result.size()) result.resize(2 * result.size());
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data() + taken));
    stream.avail_in = size_for_zlib(content.size() - taken);
    stream.next_out = reinterpret_cast<Bytef*>(result.data() + given);
    stream.avail_out = size_for_zlib(result.size() - given);
    const int outcome = inflate(&stream, Z_NO_FLUSH);
    taken = static_cast<std::size_t>(reinterpret_cast<const char*>(stream.next_in) - content.data());
    given = static_cast<std::size_t>(reinterpret_cast<const char*>(stream.next_out) - result.data());
    if (outcome == Z_STREAM_END) {
      if (!is_gzip(content.substr(taken))) break;  // bytes behind the last part have no meaning
      inflateReset(&stream);
    } else if (outcome != Z_OK && outcome != Z_BUF_ERROR) {
      throw fail("broken");
    } else if (taken == content.size() && stream.avail_out > 0) {
      throw fail("cut off");
    }
  }
  result.resize(given);
  return result;
#else
  throw Unreadable_file(path + ": this is a gzip file, which is read only where zlib is; unpack it first");
#endif
}

/// Refuses what is no mesh, but often found where one is expected: each by its name.
/// \param content behind the first blanks
inline void refuse_other_content(const std::string& path, std::string_view content) {
  const auto starts_with = [&](std::string_view mark) {
    return std::equal(mark.begin(), mark.end(), content.begin(),
                      content.begin() + std::min(mark.size(), content.size()),
                      [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? char(b - 'A' + 'a') : b); });
  };
  if (starts_with("<!doctype html") || starts_with("<html"))
    throw Unreadable_file(path + ": this is a page of the web (HTML), not a mesh");
  if (starts_with("version https://git-lfs.github.com/"))
    throw Unreadable_file(path + ": this is a pointer of Git LFS, not the mesh, which `git lfs pull` fetches");
  // A mark of its own, or letters with zeros in between.
  bool has_zeros = content.size() >= 8;
  for (std::size_t i = 0; has_zeros && i < 8; i += 2)
    has_zeros = (content[i] == '\0') != (content[i + 1] == '\0') && (content[i] == '\0') == (content[0] == '\0');
  if (has_zeros || starts_with("\xff\xfe") || starts_with("\xfe\xff"))
    throw Unreadable_file(path + ": this is text in UTF-16; save it in UTF-8");
}

}  // namespace mesh_files

#endif
