#ifndef MESH_FILES_WRITE_MESH_H
#define MESH_FILES_WRITE_MESH_H

#include "Output_file.h"
#include "Polygon_soup.h"

#include <boost/endian/conversion.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mesh_files {

/// Red, green and blue.
using Color = std::array<std::uint8_t, 3>;

/// Collects what is written and hands it on in large blocks.
class Buffer {
 public:
  explicit Buffer(Output_file& file) : file_(file) { bytes_.reserve(block + 1024); }

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

  /// The bytes of a number, the lowest first.
  template <class Number>
  void binary(Number value) {
    std::array<unsigned char, sizeof(Number)> bytes;
    boost::endian::endian_store<Number, sizeof(Number), boost::endian::order::little>(bytes.data(), value);
    *this << std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }

  void flush() {
    file_.write(bytes_);
    bytes_.clear();
  }

 private:
  static constexpr std::size_t block = 1 << 20;
  Output_file& file_;
  std::string bytes_;
};

/// Writes a text OFF file with a colour for each face.
inline void write_off(Output_file& file, const Polygon_soup& soup, const std::vector<Color>& face_colors) {
  Buffer out(file);
  out << "OFF\n";
  out.number(soup.points.size());
  out << " ";
  out.number(soup.number_of_faces());
  out << " 0\n";
  for (const auto& p : soup.points) {
    out.number(p.x());
    out << " ";
    out.number(p.y());
    out << " ";
    out.number(p.z());
    out << "\n";
  }
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    out.number(soup.face(f).size());
    for (const auto corner : soup.face(f)) {
      out << " ";
      out.number(corner);
    }
    for (const auto channel : face_colors[f]) {
      out << " ";
      out.number(channel);
    }
    out << "\n";
  }
  out.flush();
}

/// Writes a binary PLY file with a colour and a label ("segment") for each face.
inline void write_ply(Output_file& file, const Polygon_soup& soup, const std::vector<Color>& face_colors,
                      const std::vector<std::size_t>& face_labels) {
  std::size_t largest_degree = 0;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    largest_degree = std::max<std::size_t>(largest_degree, soup.face(f).size());
  const bool has_small_degrees = largest_degree < 256;  // readers expect one byte where it will do

  Buffer out(file);
  out << "ply\nformat binary_little_endian 1.0\nelement vertex ";
  out.number(soup.points.size());
  out << "\nproperty double x\nproperty double y\nproperty double z\nelement face ";
  out.number(soup.number_of_faces());
  out << (has_small_degrees ? "\nproperty list uchar int vertex_indices" : "\nproperty list uint int vertex_indices");
  out << "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uint segment\nend_header\n";
  for (const auto& p : soup.points) {
    out.binary(p.x());
    out.binary(p.y());
    out.binary(p.z());
  }
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const auto corners = soup.face(f);
    if (has_small_degrees)
      out.binary(static_cast<std::uint8_t>(corners.size()));
    else
      out.binary(static_cast<std::uint32_t>(corners.size()));
    for (const auto corner : corners) out.binary(static_cast<std::int32_t>(corner));
    for (const auto channel : face_colors[f]) out.binary(channel);
    out.binary(static_cast<std::uint32_t>(face_labels[f]));
  }
  out.flush();
}

/// Writes one label a line, as in the files `.seg` of the Princeton Segmentation Benchmark.
inline void write_labels(Output_file& file, const std::vector<std::size_t>& labels) {
  Buffer out(file);
  for (const std::size_t label : labels) {
    out.number(label);
    out << "\n";
  }
  out.flush();
}

/// Writes one line a face with one number a column, under a line of the columns' names that starts with `#`.
inline void write_columns(Output_file& file, const std::vector<std::string>& names,
                          const std::vector<std::vector<double>>& columns) {
  Buffer out(file);
  out << "#";
  for (const std::string& name : names) out << " " << name;
  out << "\n";
  const std::size_t rows = columns.empty() ? 0 : columns.front().size();
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns.size(); ++column) {
      if (column > 0) out << " ";
      out.number(columns[column][row]);
    }
    out << "\n";
  }
  out.flush();
}

}  // namespace mesh_files

#endif
