// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_CHECK_NUMBER_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_CHECK_NUMBER_H

#include <RW_segmentation/internal/check_number.h>
#include <RW_segmentation/internal/compiled.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE void check_number(std::size_t number, const char* items) {
  if (number >= std::numeric_limits<std::uint32_t>::max())
    throw std::length_error(std::to_string(number) + " " + items + " are more than 32 bits can number");
}

}  // namespace RW_segmentation::internal

#endif
