// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_COLUMNS_H
#define MESH_FILES_WRITE_COLUMNS_H

#include "Buffer.h"
#include "Output.h"

#include <cstddef>
#include <string>
#include <vector>

namespace mesh_files {

/// Writes one label a line, as in the files `.seg` of the Princeton Segmentation Benchmark.
inline void write_labels(Output& file, const std::vector<std::size_t>& labels) {
  Buffer out(file);
  for (const std::size_t label : labels) {
    out.number(label);
    out << "\n";
  }
  out.flush();
}

/// Writes one line a face with one number a column, under a line of the columns' names that starts with `#`.
inline void write_columns(Output& file, const std::vector<std::string>& names,
                          const std::vector<std::vector<double>>& columns) {
  Buffer out(file);
  out << "#";
  for (const std::string& name : names) out << " " << name;
  out << "\n";
  const std::size_t rows = columns.empty() ? 0 : columns.front().size();
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns.size(); ++column) {
      if (column > 0) out << " ";
      out.number(columns[column][row]);
    }
    out << "\n";
  }
  out.flush();
}

}  // namespace mesh_files

#endif
