// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_STEP_FILE_H
#define SEGMENT_MESH_TILES_STEP_FILE_H

#include "../../mesh_files/Output_file.h"
#include "../../mesh_files/Polygon_soup.h"
#include "../../mesh_files/read_content.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace segment_mesh {

/// What is written byte by byte, as it lies in memory.
template <class T>
struct Is_plain : std::is_arithmetic<T> {};
template <class T, std::size_t size>
struct Is_plain<std::array<T, size>> : Is_plain<T> {};
template <int rows, int columns>
struct Is_plain<Eigen::Matrix<double, rows, columns>> : std::bool_constant<rows != Eigen::Dynamic> {};

// What one step of a segmentation of tiles leaves for later ones: a file of numbers as they lie in memory. It is for the
// same program on machines of the same kind. The first bytes tell the kind of the content and a checksum of the rest, so
// that a file that was broken off, changed or left by another version is found out.

/// Passes what a file is made of, byte by byte as it lies in memory, to a function of a pointer and a size.
template <class Use>
class Step_writer {
 public:
  explicit Step_writer(Use use) : use_(std::move(use)) {}

  template <class T>
  void operator()(const T& value) {
    if constexpr (Is_plain<T>::value)
      use_(reinterpret_cast<const char*>(&value), sizeof(T));
    else
      transfer(*this, const_cast<T&>(value));  // reads it
  }

  template <class T>
  void operator()(const std::vector<T>& values) {
    (*this)(std::uint64_t(values.size()));
    if constexpr (Is_plain<T>::value)
      use_(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    else
      for (const T& value : values) (*this)(value);
  }

  void operator()(const std::string& text) { (*this)(std::vector<char>(text.begin(), text.end())); }

 private:
  Use use_;
};

/// What a file is made of, in memory that is asked for once: it may be hundreds of megabytes.
template <class... Values>
std::string bytes_of(const Values&... values) {
  std::size_t size = 0;
  Step_writer count([&](const char*, std::size_t more) { size += more; });
  (count(values), ...);
  std::string bytes;
  bytes.reserve(size);
  Step_writer append([&](const char* data, std::size_t more) { bytes.append(data, more); });
  (append(values), ...);
  return bytes;
}

/// Takes the content of a file apart in the order in which it was written.
class Step_reader {
 public:
  /// \throws mesh_files::Unreadable_file later, where the content ends too early
  Step_reader(std::string_view bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {}

  template <class T>
  void operator()(T& value) {
    if constexpr (Is_plain<T>::value)
      take(&value, sizeof(T));
    else
      transfer(*this, value);
  }

  template <class T>
  void operator()(std::vector<T>& values) {
    std::uint64_t size = 0;
    (*this)(size);
    if (size > bytes_.size()) fail();
    values.resize(size);
    if constexpr (Is_plain<T>::value) {
      take(values.data(), size * sizeof(T));
    } else {
      for (T& value : values) (*this)(value);
    }
  }

  void operator()(std::string& text) {
    std::vector<char> characters;
    (*this)(characters);
    text.assign(characters.begin(), characters.end());
  }

 private:
  [[noreturn]] void fail() const { throw mesh_files::Unreadable_file(path_ + ": the file ends too early"); }

  void take(void* data, std::size_t size) {
    if (size > bytes_.size()) fail();
    if (size > 0) std::memcpy(data, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }

  std::string_view bytes_;
  std::string path_;
};

/// Names the content of a file and tells whether it is whole.
struct Step_header {
  std::array<char, 16> name{};
  std::uint64_t size = 0, checksum = 0, version = 8;

  Step_header() = default;
  Step_header(std::string_view kind, std::string_view content)
      : size(content.size()), checksum(std::hash<std::string_view>()(content)) {
    kind.copy(name.data(), name.size());
  }
  bool operator==(const Step_header& other) const {
    return name == other.name && size == other.size && checksum == other.checksum && version == other.version;
  }
};

template <class Archive>
void transfer(Archive& archive, Step_header& header) {
  archive(header.name);
  archive(header.size);
  archive(header.checksum);
  archive(header.version);
}

/// \param kind up to 16 characters
/// \throws mesh_files::Unwritable_file
template <class... Values>
void write_step(const std::string& path, std::string_view kind, const Values&... values) {
  const std::string content = bytes_of(values...);
  mesh_files::Output_file file(path);
  file.write(bytes_of(Step_header(kind, content)));
  file.write(content);
  file.commit();
}

/// \throws mesh_files::Unreadable_file if it is not there, not whole, or of another kind or version
template <class... Values>
void read_step(const std::string& path, std::string_view kind, Values&... values) {
  constexpr std::size_t size_of_header = 40;
  const mesh_files::File_content file(path);
  const std::string_view bytes = file.bytes();
  if (bytes.size() < size_of_header) throw mesh_files::Unreadable_file(path + ": the file ends too early");
  Step_header header;
  Step_reader(bytes, path)(header);
  const std::string_view content = bytes.substr(size_of_header);
  if (!(header == Step_header(kind, content)))
    throw mesh_files::Unreadable_file(
        path + ": not what the step \"" + std::string(kind) +
        "\" of this program has left here, or no more; remove it, and the step is done again");
  Step_reader reader(content, path);
  (reader(values), ...);
}

}  // namespace segment_mesh

#endif
