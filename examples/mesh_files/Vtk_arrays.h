// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_VTK_ARRAYS_H
#define MESH_FILES_VTK_ARRAYS_H

#include "Byte_source.h"
#include "Text.h"
#include "Xml_tags.h"
#include "inflate.h"

#include <boost/endian/conversion.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace mesh_files::vtp {

/// An array of numbers in a file of VTK's: where it is and how it is written.
struct Array {
  const char* place = nullptr;  ///< of its tag
  std::string_view name, type;
  std::string_view text;  ///< what stands in it
  bool is_text = false, is_appended = false;
  std::uint64_t offset = 0;  ///< where it begins among what is appended
};

/// The arrays of a file, whose tags have been read.
class Arrays {
 public:
  explicit Arrays(const Xml_tags& tags) : tags_(tags) {}

  /// Takes from the first tag how numbers are written. Compression is looked at where there is something compressed, as
  /// texts are not.
  void read_file_tag() {
    const std::string_view order = tags_.attribute("byte_order").value_or("LittleEndian");
    if (order != "LittleEndian" && order != "BigEndian") tags_.fail("the order of bytes is " + printable(order));
    is_little_ = order == "LittleEndian";
    const std::string_view header = tags_.attribute("header_type").value_or("UInt32");
    if (header != "UInt32" && header != "UInt64") tags_.fail("the type of headers is " + printable(header));
    size_of_header_ = header == "UInt64" ? 8 : 4;
    compressor_ = tags_.attribute("compressor").value_or("");
  }

  /// Takes what follows the tag AppendedData.
  void read_appended() {
    const std::string_view encoding = tags_.attribute("encoding").value_or("base64");
    if (encoding != "raw" && encoding != "base64")
      tags_.fail("the appended data are encoded as " + printable(encoding));
    appended_is_base64_ = encoding == "base64";
    const std::string_view rest = tags_.rest();
    const std::size_t begin = rest.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos || rest[begin] != '_') tags_.fail("the appended data do not begin with \"_\"");
    appended_ = rest.substr(begin + 1);
  }

  /// The numbers of an array.
  /// \tparam Value double or std::int64_t
  template <class Value>
  std::vector<Value> numbers(const Array& array) {
    if (array.is_text) return numbers_in_text<Value>(array);
    const std::string bytes = bytes_of(array);
    if (array.type == "Int8") return loaded<std::int8_t, Value>(bytes, array);
    if (array.type == "UInt8") return loaded<std::uint8_t, Value>(bytes, array);
    if (array.type == "Int16") return loaded<std::int16_t, Value>(bytes, array);
    if (array.type == "UInt16") return loaded<std::uint16_t, Value>(bytes, array);
    if (array.type == "Int32") return loaded<std::int32_t, Value>(bytes, array);
    if (array.type == "UInt32") return loaded<std::uint32_t, Value>(bytes, array);
    if (array.type == "Int64") return loaded<std::int64_t, Value>(bytes, array);
    if (array.type == "UInt64") return loaded<std::uint64_t, Value>(bytes, array);
    if constexpr (std::is_floating_point_v<Value>) {
      if (array.type == "Float32") return loaded<float, Value>(bytes, array);
      if (array.type == "Float64") return loaded<double, Value>(bytes, array);
    }
    fail(array, "has numbers of the type " + printable(array.type));
  }

  [[noreturn]] void fail(const Array& array, const std::string& cause) const {
    tags_.fail_at(array.place, "the array " + printable(array.name) + " " + cause);
  }

 private:
  template <class Value>
  std::vector<Value> numbers_in_text(const Array& array) const {
    constexpr std::string_view blanks = " \t\r\n";
    std::vector<Value> result;
    std::string_view rest = array.text;
    for (;;) {
      rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
      if (rest.empty()) return result;
      const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
      const std::optional<Value> value = number_in<Value>(word);
      if (!value)
        tags_.fail_at(word.data(), "the array " + printable(array.name) + " has " + printable(word) +
                                       (std::is_floating_point_v<Value> ? ", not a number" : ", not a whole number"));
      result.push_back(*value);
      rest.remove_prefix(word.size());
    }
  }

  template <class Stored, class Value>
  std::vector<Value> loaded(const std::string& bytes, const Array& array) const {
    if (bytes.size() % sizeof(Stored) != 0)
      fail(array,
           "has " + std::to_string(bytes.size()) + " bytes, which are no whole number of " + std::string(array.type));
    std::vector<Value> result;
    result.reserve(bytes.size() / sizeof(Stored));
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(Stored)) {
      const Stored value = load<Stored>(bytes, i);
      if constexpr (std::is_same_v<Stored, std::uint64_t> && !std::is_floating_point_v<Value>) {
        if (value > std::uint64_t(std::numeric_limits<Value>::max()))
          fail(array, "has the number " + std::to_string(value));
      }
      result.push_back(static_cast<Value>(value));
    }
    return result;
  }

  template <class Number>
  Number load(const std::string& bytes, std::size_t at) const {
    using boost::endian::order;
    const auto* const first = reinterpret_cast<const unsigned char*>(bytes.data() + at);
    return is_little_ ? boost::endian::endian_load<Number, sizeof(Number), order::little>(first)
                      : boost::endian::endian_load<Number, sizeof(Number), order::big>(first);
  }

  /// The bytes of an array that is no text.
  std::string bytes_of(const Array& array) {
    if (array.is_appended && array.offset > appended_.size()) fail(array, "begins behind the end of the file");
    const std::string_view text = array.is_appended ? appended_.substr(array.offset) : array.text;
    Byte_source source(text, array.is_appended ? appended_is_base64_ : true);
    const std::uint64_t all = source.most_left();
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos && !array.is_appended) return {};
    std::string bytes =
        compressor_.empty() ? take(source, take_header(source, array), array) : take_blocks(source, array);
    // Otherwise a small file with many pieces that share an array could hold as much as it likes.
    appended_taken_ += array.is_appended ? all - source.most_left() : 0;
    if (appended_taken_ > appended_.size()) fail(array, "shares its data with others");
    return bytes;
  }

  std::string take(Byte_source& source, std::uint64_t size, const Array& array) const {
    std::optional<std::string> bytes = source.take(size);
    if (!bytes) fail(array, "is broken or cut off: " + std::to_string(size) + " bytes should follow");
    return std::move(*bytes);
  }

  std::uint64_t take_header(Byte_source& source, const Array& array) const {
    const std::string bytes = take(source, size_of_header_, array);
    return size_of_header_ == 8 ? load<std::uint64_t>(bytes, 0) : load<std::uint32_t>(bytes, 0);
  }

  /// Compressed data are blocks. Their number comes first, the size of each and that of the last one (or 0 if it is as the
  /// others) before they are compressed, and then the size that each has in the file.
  std::string take_blocks(Byte_source& source, const Array& array) const {
    if (compressor_ != "vtkZLibDataCompressor")
      fail(array,
           "is compressed by " + printable(compressor_) + ", which is not read: save it uncompressed or by zlib");
    const std::uint64_t blocks = take_header(source, array);
    if (blocks > source.most_left() / size_of_header_)
      fail(array, "promises " + std::to_string(blocks) + " blocks, more than there is room for");
    if (blocks == 0) return {};
    const std::uint64_t size = take_header(source, array), size_of_last = take_header(source, array);
    std::vector<std::uint64_t> packed_sizes;
    for (std::uint64_t i = 0; i < blocks; ++i) packed_sizes.push_back(take_header(source, array));
    std::string bytes;
    for (std::uint64_t i = 0; i < blocks; ++i) {
      const bool is_short = i + 1 == blocks && size_of_last > 0;
      const std::optional<std::string> block =
          inflated_by_zlib(take(source, packed_sizes[i], array), is_short ? size_of_last : size);
      if (!block) fail(array, "has a compressed block that is broken");
      bytes += *block;
    }
    return bytes;
  }

  const Xml_tags& tags_;
  bool is_little_ = true;
  std::size_t size_of_header_ = 4;
  std::string_view compressor_;
  std::string_view appended_;
  bool appended_is_base64_ = false;
  std::uint64_t appended_taken_ = 0;  // of its bytes, by all arrays
};

}  // namespace mesh_files::vtp

#endif
