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
#include <utility>

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

/// What bytes hold that are packed by Deflate (RFC 1951). Boost unpacks them, whose headers are all it takes: a page in a
/// browser has no zlib.
/// \param size what they must hold
/// \returns nothing if they are broken or hold less; who has a sum of what was packed must check it, since bytes may be
/// damaged without being broken, or hold more
inline std::optional<std::string> inflated(std::string_view packed, std::uint64_t size) {
  namespace zlib = boost::beast::zlib;
  // Two bits stand for 258 bytes at most. No memory is taken for more.
  constexpr std::size_t largest_ratio = 4 * 258;
  std::string result;
  if (size / largest_ratio > packed.size() || size > result.max_size()) return std::nullopt;
  result.resize(static_cast<std::size_t>(size));
  zlib::z_params buffers;
  buffers.next_in = packed.data();
  buffers.avail_in = packed.size();
  buffers.next_out = result.data();
  buffers.avail_out = result.size();
  zlib::inflate_stream stream;
  boost::beast::error_code outcome;
  stream.write(buffers, zlib::Flush::finish, outcome);
  // Where the input ends with the stream, Boost asks for more of it although all is there.
  const bool is_sound = outcome == zlib::error::end_of_stream || outcome == zlib::error::need_buffers;
  if (!is_sound || buffers.avail_out > 0) return std::nullopt;
  return result;
}

/// What bytes hold that zlib has packed (RFC 1950).
/// \param size what they must hold
/// \returns nothing if they are broken, or hold more or less
inline std::optional<std::string> inflated_by_zlib(std::string_view packed, std::uint64_t size) {
  constexpr std::size_t size_of_header = 2, size_of_sum = 4;
  if (packed.size() < size_of_header + size_of_sum) return std::nullopt;
  const auto* const bytes = reinterpret_cast<const unsigned char*>(packed.data());
  const bool is_deflate = (bytes[0] & 15) == 8, has_dictionary = (bytes[1] & 32) != 0;
  if (!is_deflate || has_dictionary || (bytes[0] * 256 + bytes[1]) % 31 != 0) return std::nullopt;
  std::optional<std::string> result =
      inflated(packed.substr(size_of_header, packed.size() - size_of_header - size_of_sum), size);
  const bool is_whole = result && boost::endian::load_big_u32(bytes + packed.size() - size_of_sum) == adler_32(*result);
  return is_whole ? std::move(result) : std::nullopt;
}

}  // namespace mesh_files

#endif
