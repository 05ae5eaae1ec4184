// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_WRITE_3MF_H
#define MESH_FILES_WRITE_3MF_H

#include "Buffer.h"
#include "Output.h"
#include "Polygon_soup.h"
#include "Segmented_soup.h"
#include "write_zip.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace mesh_files {

/// "#RRGGBB"
inline std::string hexadecimal(const Color& color) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string text = "#";
  for (const auto channel : color) (text += digits[channel / 16]) += digits[channel % 16];
  return text;
}

/// Writes a 3MF file for slicers: an object and a base material `segment_<label>` for each label, in millimetres. Polygons
/// are cut into triangles.
inline void write_3mf(Output& file, const Segmented_soup& mesh) {
  const Small_faces triangles = small_faces(mesh, 3);
  const auto segments = faces_of_labels(triangles.label);
  std::string model;
  Buffer out([&](std::string_view bytes) { model += bytes; });
  const auto attribute = [&](const char* name, auto value) {
    out << " " << name << "=\"";
    out.number(value);
    out << "\"";
  };
  constexpr std::size_t materials = 1;  // their id; those of objects follow
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" "
         "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<resources>\n<basematerials "
         "id=\"1\">\n";
  for (const auto& [label, faces] : segments)
    out << "<base name=\"" << name_of_segment(label) << "\" displaycolor=\""
        << hexadecimal(mesh.color_of_label.at(label)) << "\"/>\n";
  out << "</basematerials>\n";
  std::size_t number = 0;
  for (const auto& [label, faces] : segments) {
    const Polygon_soup part = part_of(triangles.soup, faces);
    out << "<object";
    attribute("id", materials + 1 + number);
    out << " type=\"model\" name=\"" << name_of_segment(label) << "\" pid=\"1\"";
    attribute("pindex", number++);
    out << ">\n<mesh>\n<vertices>\n";
    for (const auto& p : part.points) {
      out << "<vertex";
      attribute("x", p.x());
      attribute("y", p.y());
      attribute("z", p.z());
      out << "/>\n";
    }
    out << "</vertices>\n<triangles>\n";
    for (std::size_t f = 0; f < part.number_of_faces(); ++f) {
      out << "<triangle";
      attribute("v1", part.face(f)[0]);
      attribute("v2", part.face(f)[1]);
      attribute("v3", part.face(f)[2]);
      out << "/>\n";
    }
    out << "</triangles>\n</mesh>\n</object>\n";
  }
  out << "</resources>\n<build>\n";
  for (std::size_t i = 0; i < segments.size(); ++i) {
    out << "<item";
    attribute("objectid", materials + 1 + i);
    out << "/>\n";
  }
  out << "</build>\n</model>\n";
  out.flush();

  Zip_archive archive(file);
  archive.add("[Content_Types].xml",
              "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
              "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
              "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
              "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>"
              "</Types>\n");
  archive.add("_rels/.rels",
              "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
              "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
              "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
              "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n");
  archive.add("3D/3dmodel.model", model);
  archive.finish();
}

}  // namespace mesh_files

#endif
