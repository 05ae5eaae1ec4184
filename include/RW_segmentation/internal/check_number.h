// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_CHECK_NUMBER_H
#define RW_SEGMENTATION_INTERNAL_CHECK_NUMBER_H

#include <cstddef>

namespace RW_segmentation::internal {

/// Refuses more faces, vertices or halfedges than 32 bits can number; the last number means none.
/// \throws std::length_error
void check_number(std::size_t number, const char* items);

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/check_number.h>
#endif

#endif
