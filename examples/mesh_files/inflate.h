// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_INFLATE_H
#define MESH_FILES_INFLATE_H

#include <boost/beast/zlib/inflate_stream.hpp>
#include <boost/endian/conversion.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mesh_files {

/// The sum by which zlib checks what it has packed (RFC 1950).
inline std::uint32_t adler_32(std::string_view bytes) {
  constexpr std::uint32_t modulus = 65521;
  std::uint32_t a = 1, b = 0;
  for (const char byte : bytes) {
    a += static_cast<unsigned char>(byte);
    if (a >= modulus) a -= modulus;
    b += a;
    if (b >= modulus) b -= modulus;
  }
  return b << 16 | a;
}

/// What bytes hold that zlib has packed (RFC 1950). Boost unpacks them, whose headers are all it takes: a page in a browser
/// has no zlib.
/// \param size what they must hold
/// \returns nothing if they are broken, or hold more or less
inline std::optional<std::string> inflated(std::string_view packed, std::uint64_t size) {
  constexpr std::size_t size_of_header = 2, size_of_sum = 4;
  if (packed.size() < size_of_header + size_of_sum) return std::nullopt;
  const auto* const bytes = reinterpret_cast<const unsigned char*>(packed.data());
  const bool is_deflate = (bytes[0] & 15) == 8, has_dictionary = (bytes[1] & 32) != 0;
  if (!is_deflate || has_dictionary || (bytes[0] * 256 + bytes[1]) % 31 != 0) return std::nullopt;
  // Two bits stand for 258 bytes at most. No memory is taken for more.
  constexpr std::size_t largest_ratio = 4 * 258;
  std::string result;
  if (size / largest_ratio > packed.size() || size > result.max_size()) return std::nullopt;
  result.resize(static_cast<std::size_t>(size));
  boost::beast::zlib::z_params buffers;
  buffers.next_in = bytes + size_of_header;
  buffers.avail_in = packed.size() - size_of_header;
  buffers.next_out = result.data();
  buffers.avail_out = result.size();
  boost::beast::zlib::inflate_stream stream;
  boost::beast::error_code outcome;
  stream.write(buffers, boost::beast::zlib::Flush::finish, outcome);
  if (outcome != boost::beast::zlib::error::end_of_stream || buffers.avail_out > 0) return std::nullopt;
  // The stream may have looked at the sum, too: where it stopped says nothing.
  if (boost::endian::load_big_u32(bytes + packed.size() - size_of_sum) != adler_32(result)) return std::nullopt;
  return result;
}

}  // namespace mesh_files

#endif
