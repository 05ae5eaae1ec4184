// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_VTP_H
#define MESH_FILES_WRITE_VTP_H

#include "Buffer.h"
#include "Output.h"
#include "Polygon_soup.h"
#include "Segmented_soup.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace mesh_files {

/// Writes a VTK file of polygons (VTP) with two arrays of cell data, the labels ("segment") and the colours ("color").
/// Polygons stay as they are.
inline void write_vtp(Output& file, const Segmented_soup& mesh) {
  const Polygon_soup& soup = mesh.soup;
  const std::size_t points = soup.points.size(), faces = soup.number_of_faces();
  Buffer out(file);
  std::uint64_t offset = 0;
  // Each array is written after the text, behind the number of its bytes.
  const auto array = [&](const char* type, const char* name, int components, std::uint64_t bytes) {
    out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
        << std::to_string(components) << "\" format=\"appended\" offset=\"" << std::to_string(offset) << "\"/>\n";
    offset += 8 + bytes;
  };
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\""
      << std::to_string(points) << "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\""
      << std::to_string(faces) << "\">\n<CellData Scalars=\"segment\">\n";
  array("Int64", "segment", 1, 8 * faces);
  array("UInt8", "color", 3, 3 * faces);
  out << "</CellData>\n<Points>\n";
  array("Float64", "Points", 3, 24 * points);
  out << "</Points>\n<Polys>\n";
  array("Int64", "connectivity", 1, 8 * soup.corners.size());
  array("Int64", "offsets", 1, 8 * faces);
  out << "</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  out.binary(std::uint64_t(8 * faces));
  for (const std::size_t label : mesh.face_labels) out.binary(static_cast<std::int64_t>(label));
  out.binary(std::uint64_t(3 * faces));
  for (const std::size_t label : mesh.face_labels)
    for (const std::uint8_t channel : mesh.color_of_label.at(label)) out.binary(channel);
  out.binary(std::uint64_t(24 * points));
  for (const auto& p : soup.points)
    for (int i = 0; i < 3; ++i) out.binary(double(p[i]));
  out.binary(std::uint64_t(8 * soup.corners.size()));
  for (const auto corner : soup.corners) out.binary(static_cast<std::int64_t>(corner));
  out.binary(std::uint64_t(8 * faces));
  for (std::size_t f = 0; f < faces; ++f) out.binary(static_cast<std::int64_t>(soup.first_corner[f + 1]));
  out << "\n</AppendedData>\n</VTKFile>\n";
  out.flush();
}

}  // namespace mesh_files

#endif
