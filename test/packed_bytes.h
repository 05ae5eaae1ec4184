// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_PACKED_BYTES_H
#define RW_SEGMENTATION_TEST_PACKED_BYTES_H

#ifdef RW_SEGMENTATION_WITH_ZLIB

#include <zlib.h>

#include <string>

/// Bytes as zlib packs them.
namespace packed_bytes {

/// What stands around them, as zlib calls it.
enum class Wrapping { none = -MAX_WBITS, zlib = MAX_WBITS, gzip = MAX_WBITS + 16 };

inline std::string packed(const std::string& content, Wrapping wrapping) {
  constexpr int usual_memory = 8;
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, static_cast<int>(wrapping), usual_memory, Z_DEFAULT_STRATEGY);
  std::string result(deflateBound(&stream, static_cast<uLong>(content.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

}  // namespace packed_bytes

#endif

#endif
