// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_OUTPUT_H
#define MESH_FILES_OUTPUT_H

#include <string>
#include <string_view>

namespace mesh_files {

/// What files are written to: a file on disk, or bytes that are kept.
class Output {
 public:
  Output() = default;
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  virtual ~Output() = default;

  /// Names the file in errors.
  virtual const std::string& path() const = 0;
  virtual void write(std::string_view bytes) = 0;
};

}  // namespace mesh_files

#endif
