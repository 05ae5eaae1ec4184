// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_ARGUMENT_ERROR_H
#define RW_SEGMENTATION_INTERNAL_ARGUMENT_ERROR_H

#include <sstream>
#include <stdexcept>

namespace RW_segmentation::internal {

/// What is thrown for an argument that a user got wrong, as in "sigma is -1, but must be positive".
template <class Value>
std::invalid_argument argument_error(const char* argument, const Value& value, const char* requirement) {
  std::ostringstream message;
  message << argument << " is " << value << ", but must be " << requirement;
  return std::invalid_argument(message.str());
}

}  // namespace RW_segmentation::internal

#endif
