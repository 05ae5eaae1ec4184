// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_CHECK_NUMBER_H
#define RW_SEGMENTATION_INTERNAL_CHECK_NUMBER_H

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace RW_segmentation::internal {

/// Refuses more faces, vertices or halfedges than 32 bits can number; the last number means none.
/// \throws std::length_error
inline void check_number(std::size_t number, const char* items) {
  if (number >= std::numeric_limits<std::uint32_t>::max())
    throw std::length_error(std::to_string(number) + " " + items + " are more than 32 bits can number");
}

}  // namespace RW_segmentation::internal

#endif
