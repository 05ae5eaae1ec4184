// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_NPZ_H
#define MESH_FILES_WRITE_NPZ_H

#include "Buffer.h"
#include "Output.h"
#include "write_zip.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mesh_files {

/// The head of a file .npy.
/// \param type of the values, as NumPy writes it
/// \param shape as Python writes it
inline std::string npy_header(const std::string& type, const std::string& shape) {
  std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
  constexpr std::size_t size_before = 10, alignment = 64;
  text.resize((size_before + text.size() + alignment) / alignment * alignment - size_before - 1, ' ');
  text += '\n';
  std::string header = "\x93NUMPY";
  header += {'\1', '\0', static_cast<char>(text.size() % 256), static_cast<char>(text.size() / 256)};
  return header + text;
}

/// Labels as a file .npy.
inline std::string npy_of(const std::vector<std::size_t>& labels) {
  std::string bytes = npy_header("<i8", "(" + std::to_string(labels.size()) + ",)");
  Buffer out([&](std::string_view more) { bytes += more; });
  for (const std::size_t label : labels) out.binary(static_cast<std::int64_t>(label));
  out.flush();
  return bytes;
}

/// Writes labels as an archive of NumPy's with one array, "labels".
inline void write_labels_npz(Output& file, const std::vector<std::size_t>& labels) {
  Zip_archive archive(file);
  archive.add("labels.npy", npy_of(labels));
  archive.finish();
}

/// Writes probabilities as an archive of NumPy's with two arrays: "probabilities", a row for each face, and "labels", those
/// of the columns.
inline void write_probabilities_npz(Output& file, const std::vector<std::size_t>& labels,
                                    const std::vector<std::vector<double>>& columns) {
  const std::size_t rows = columns.empty() ? 0 : columns.front().size();
  std::string bytes = npy_header("<f8", "(" + std::to_string(rows) + ", " + std::to_string(columns.size()) + ")");
  Buffer out([&](std::string_view more) { bytes += more; });
  for (std::size_t row = 0; row < rows; ++row)
    for (const auto& column : columns) out.binary(column[row]);
  out.flush();
  Zip_archive archive(file);
  archive.add("probabilities.npy", bytes);
  archive.add("labels.npy", npy_of(labels));
  archive.finish();
}

/// Writes labels as CSV: two columns, "face" from 0 and "label".
inline void write_labels_csv(Output& file, const std::vector<std::size_t>& labels) {
  Buffer out(file);
  out << "face,label\n";
  for (std::size_t f = 0; f < labels.size(); ++f) {
    out.number(f);
    out << ",";
    out.number(labels[f]);
    out << "\n";
  }
  out.flush();
}

/// Writes probabilities as CSV: a column "face" from 0 and one for each label, by its name.
inline void write_probabilities_csv(Output& file, const std::vector<std::size_t>& labels,
                                    const std::vector<std::vector<double>>& columns) {
  Buffer out(file);
  out << "face";
  for (const std::size_t label : labels) {
    out << ",";
    out.number(label);
  }
  out << "\n";
  for (std::size_t row = 0; row < (columns.empty() ? 0 : columns.front().size()); ++row) {
    out.number(row);
    for (const auto& column : columns) {
      out << ",";
      out.number(column[row]);
    }
    out << "\n";
  }
  out.flush();
}

}  // namespace mesh_files

#endif
