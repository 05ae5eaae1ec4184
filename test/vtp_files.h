// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_VTP_FILES_H
#define RW_SEGMENTATION_TEST_VTP_FILES_H

// Polygons as VTP files in all their forms, written by code of its own, which knows nothing of what reads them.

#include "mesh_bytes.h"
#include "packed_bytes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace vtp_files {

using mesh_bytes::bytes;
using mesh_bytes::Order;

enum class Data { text, base64, appended, appended_base64 };
enum class Packing { none, stored, zlib };

/// How a file is written.
struct Form {
  Data data = Data::text;
  Packing packing = Packing::none;
  Order order = Order::little;
  bool has_wide_headers = false;  ///< of 64 bits
  bool has_strips = false;        ///< each triangle is one
  std::size_t pieces = 1;
  std::string coordinate = "Float32", corner = "Int64";  ///< the types of numbers

  std::string name() const {
    const char* const data_names[] = {"text", "base64", "appended", "appended_base64"};
    const char* const packing_names[] = {"", ".stored", ".zlib"};
    return std::string(data_names[int(data)]) + packing_names[int(packing)] +
           (order == Order::big ? ".big_endian" : "") + (has_wide_headers ? ".wide" : "") +
           (has_strips ? ".strips" : "") + (pieces > 1 ? ".pieces" : "") + "." + coordinate + "." + corner;
  }
};

inline std::string base64(const std::string& content) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < content.size(); i += 3) {
    std::size_t bits = 0;
    for (std::size_t j = 0; j < 3; ++j)
      bits = bits << 8 | (i + j < content.size() ? static_cast<unsigned char>(content[i + j]) : 0U);
    const std::size_t used = std::min<std::size_t>(content.size() - i, 3) + 1;
    for (std::size_t j = 0; j < 4; ++j) text += j < used ? letters[bits >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

/// Bytes as zlib packs those that do not become smaller: as they are, between its marks.
inline std::string stored(const std::string& content) {
  std::uint32_t a = 1, b = 0;
  for (const char c : content) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint16_t>(content.size());
  return "\x78\1\1" + bytes<std::uint16_t>({size, static_cast<std::uint16_t>(~size)}) + content +
         bytes<std::uint32_t>({b << 16 | a}, Order::big);
}

inline std::string packed(const std::string& content, [[maybe_unused]] Packing packing) {
#ifdef RW_SEGMENTATION_WITH_ZLIB
  if (packing == Packing::zlib) return packed_bytes::packed(content, packed_bytes::Wrapping::zlib);
#endif
  return stored(content);
}

/// Writes a file, array by array.
class Writer {
 public:
  explicit Writer(const Form& form) : form_(form) {}

  /// \param points have coordinates 0, 1 and 2, \param faces are rows of their numbers
  template <class Points, class Faces>
  std::string file(const Points& points, const Faces& faces) && {
    text_ << "<?xml version=\"1.0\"?>\n<!-- no <Piece> -->\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order='"
          << (form_.order == Order::little ? "LittleEndian" : "BigEndian") << "'";
    if (form_.has_wide_headers) text_ << " header_type=\"UInt64\"";
    if (form_.packing != Packing::none) text_ << "\n  compressor=\"vtkZLibDataCompressor\"";
    text_ << ">\n<PolyData>\n";
    for (std::size_t i = 0; i < form_.pieces; ++i) {
      const auto begin = faces.begin() + std::ptrdiff_t(i * faces.size() / form_.pieces),
                 end = faces.begin() + std::ptrdiff_t((i + 1) * faces.size() / form_.pieces);
      write_piece(points, std::vector<std::vector<std::size_t>>(begin, end));
    }
    text_ << "</PolyData>\n";
    if (form_.data == Data::appended || form_.data == Data::appended_base64)
      text_ << "<AppendedData encoding=\"" << (form_.data == Data::appended ? "raw" : "base64") << "\">\n  _"
            << appended_ << "\n</AppendedData>\n";
    text_ << "</VTKFile>\n";
    return text_.str();
  }

 private:
  template <class Points>
  void write_piece(const Points& points, const std::vector<std::vector<std::size_t>>& faces) {
    const std::size_t strips = form_.has_strips ? faces.size() : 0;
    text_ << "<Piece NumberOfPoints=\"" << points.size() << "\" NumberOfVerts=\"1\" NumberOfLines=\"0\" "
          << "NumberOfStrips=\"" << strips << "\" NumberOfPolys=\"" << faces.size() - strips << "\">\n<PointData/>\n"
          << "<CellData Scalars=\"offsets\">\n";
    write_array("offsets", "Int32", 1, std::vector<double>(faces.size() + 1, 7));
    text_ << "</CellData>\n<Points>\n";
    std::vector<double> coordinates;
    for (const auto& p : points)
      for (int i = 0; i < 3; ++i) coordinates.push_back(p[i]);
    write_array("Points", form_.coordinate, 3, coordinates);
    text_ << "</Points>\n";
    write_cells("Verts", {{0}});
    write_cells("Lines", {});
    write_cells("Strips", form_.has_strips ? faces : std::vector<std::vector<std::size_t>>());
    write_cells("Polys", form_.has_strips ? std::vector<std::vector<std::size_t>>() : faces);
    text_ << "</Piece>\n";
  }

  void write_cells(const char* section, const std::vector<std::vector<std::size_t>>& cells) {
    std::vector<double> corners, ends;
    for (const auto& cell : cells) {
      for (const std::size_t corner : cell) corners.push_back(double(corner));
      ends.push_back(double(corners.size()));
    }
    text_ << "<" << section << ">\n";
    write_array("connectivity", form_.corner, 1, corners);
    write_array("offsets", form_.corner, 1, ends);
    text_ << "</" << section << ">\n";
  }

  void write_array(const char* name, const std::string& type, int components, const std::vector<double>& values) {
    text_ << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
          << "\" format=\""
          << (form_.data == Data::text     ? "ascii"
              : form_.data == Data::base64 ? "binary"
                                           : "appended")
          << "\"";
    if (form_.data == Data::appended || form_.data == Data::appended_base64) {
      text_ << " offset=\"" << appended_.size() << "\"/>\n";
      const std::string content = with_headers(bytes_of(values, type), form_.data == Data::appended_base64);
      appended_ += content;
      return;
    }
    text_ << " RangeMin=\"0\">\n  ";
    if (form_.data == Data::text) {
      text_.precision(17);
      for (const double value : values) text_ << (type == "Float32" ? double(float(value)) : value) << " ";
    } else {
      text_ << with_headers(bytes_of(values, type), true);
    }
    text_ << "\n  <InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"1\">\n"
          << "    <Value index=\"0\">\n 0.5 </Value>\n  </InformationKey>\n</DataArray>\n";
  }

  template <class Number>
  std::string bytes_as(const std::vector<double>& values) const {
    std::string result;
    for (const double value : values) result += bytes<Number>({static_cast<Number>(value)}, form_.order);
    return result;
  }

  std::string bytes_of(const std::vector<double>& values, const std::string& type) const {
    return type == "Float32"   ? bytes_as<float>(values)
           : type == "Float64" ? bytes_as<double>(values)
           : type == "Int8"    ? bytes_as<std::int8_t>(values)
           : type == "UInt8"   ? bytes_as<std::uint8_t>(values)
           : type == "Int16"   ? bytes_as<std::int16_t>(values)
           : type == "UInt16"  ? bytes_as<std::uint16_t>(values)
           : type == "Int32"   ? bytes_as<std::int32_t>(values)
           : type == "UInt32"  ? bytes_as<std::uint32_t>(values)
           : type == "Int64"   ? bytes_as<std::int64_t>(values)
                               : bytes_as<std::uint64_t>(values);
  }

  std::string header(std::size_t number) const {
    return form_.has_wide_headers ? bytes<std::uint64_t>({number}, form_.order)
                                  : bytes<std::uint32_t>({static_cast<std::uint32_t>(number)}, form_.order);
  }

  std::string with_headers(const std::string& content, bool is_base64) const {
    const auto written = [&](const std::string& part) { return is_base64 ? base64(part) : part; };
    if (form_.packing == Packing::none) return written(header(content.size()) + content);
    constexpr std::size_t size = 40;  // of blocks: small, so that there are several, and a smaller one at the end
    std::string sizes, blocks;
    std::size_t number = 0;
    for (; number * size < content.size(); ++number) {
      const std::string block = packed(content.substr(number * size, size), form_.packing);
      sizes += header(block.size());
      blocks += block;
    }
    return written(header(number) + header(size) + header(content.size() % size) + sizes) + written(blocks);
  }

  const Form form_;
  std::ostringstream text_;
  std::string appended_;
};

template <class Points, class Faces>
std::string file(const Points& points, const Faces& faces, const Form& form) {
  return Writer(form).file(points, faces);
}

/// All forms, of which each is met with each of the others that it may be told from by the reader.
inline std::vector<Form> all_forms() {
  std::vector<Form> forms;
  for (const Data data : {Data::text, Data::base64, Data::appended, Data::appended_base64})
    for (const bool has_strips : {false, true}) {
      Form form;
      form.data = data;
      form.has_strips = has_strips;
      forms.push_back(form);
      form.coordinate = "Float64";
      form.corner = "Int32";
      if (data == Data::text) {
        forms.push_back(form);
        continue;
      }
      for (const Order order : {Order::little, Order::big})
        for (const bool has_wide_headers : {false, true})
          for (const Packing packing : {Packing::none, Packing::stored, Packing::zlib}) {
#ifndef RW_SEGMENTATION_WITH_ZLIB
            if (packing == Packing::zlib) continue;
#endif
            form.order = order;
            form.has_wide_headers = has_wide_headers;
            form.packing = packing;
            forms.push_back(form);
          }
    }
  return forms;
}

}  // namespace vtp_files

#endif
