// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_READ_VTP_H
#define MESH_FILES_READ_VTP_H

#include "Polygon_soup.h"
#include "Strips.h"
#include "Text.h"
#include "Vtk_arrays.h"
#include "Xml_tags.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mesh_files {
namespace vtp {

constexpr std::string_view mark = "VTKFile";

/// Whether a content is one of VTK's XML files, of whatever kind. Comments may stand before the tag that tells.
inline bool is_vtk_file(std::string_view content) {
  constexpr std::size_t beginning = 4096;
  const std::size_t first = content.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && content[first] == '<' &&
         content.substr(0, beginning).find("<" + std::string(mark)) != std::string_view::npos;
}

/// Polygons or strips: `connectivity` has the corners of all, `offsets` where each ends.
struct Cells {
  std::uint64_t number = 0;
  std::optional<Array> connectivity, offsets;
};

struct Piece {
  const char* place = nullptr;
  std::uint64_t number_of_points = 0;
  std::size_t first_point = 0;  ///< among those of all pieces
  std::optional<Array> points;
  Cells polygons, strips;
};

/// Reads a file: first its tags, then the arrays, which may stand behind them.
class Reader {
 public:
  Reader(const std::string& path, std::string_view content) : tags_(path, content), arrays_(tags_) {}

  Polygon_soup soup() && {
    read_file_tag();
    read_tags();
    for (Piece& piece : pieces_) read_points(piece);
    // As VTK numbers the cells of a file: first the polygons of all pieces.
    for (const Piece& piece : pieces_)
      read_cells(
          piece, piece.polygons, "Polys", [&](auto corner) { soup_.corners.push_back(corner); },
          [&] { soup_.end_face(); });
    Strips strips;
    for (const Piece& piece : pieces_)
      read_cells(
          piece, piece.strips, "Strips", [&](auto corner) { strips.add(corner); }, [&] { strips.end_strip(); });
    strips.append_to(soup_);
    return std::move(soup_);
  }

 private:
  void read_file_tag() {
    if (!tags_.next() || tags_.name() != mark || tags_.is_closing())
      tags_.fail("a VTP file starts with <VTKFile>, this one does not");
    const std::string_view type = tags_.attribute("type").value_or("");
    if (type == "PPolyData") tags_.fail("this file only names those with the pieces of a mesh: read them one by one");
    if (type != "PolyData")
      tags_.fail("this file of VTK's holds " + printable(type) + ", not 'PolyData': save its surface as .vtp");
    arrays_.read_file_tag();
  }

  /// Reads all tags, the last of which is that of what is appended: that is no XML.
  void read_tags() {
    for (;;) {
      if (!tags_.next()) tags_.fail("the file ends without </VTKFile>");
      const std::string_view name = tags_.name();
      if (tags_.is_closing()) {
        if (name == mark) return;
        if (name == section_) section_ = {};
      } else if (name == "Piece") {
        read_piece();
      } else if (name == "DataArray") {
        if (is_in_piece_ && !section_.empty()) read_array();
      } else if (name == "AppendedData") {
        return arrays_.read_appended();
      } else if (!tags_.is_empty() && section_.empty() && (name == "Points" || name == "Polys" || name == "Strips")) {
        section_ = name;
      }
    }
  }

  void read_piece() {
    Piece piece;
    piece.place = tags_.place();
    piece.number_of_points = count("NumberOfPoints");
    piece.polygons.number = count("NumberOfPolys");
    piece.strips.number = count("NumberOfStrips");
    section_ = {};
    // Nothing is kept of one that is empty, or a file of empty ones would take many times its size.
    is_in_piece_ = piece.number_of_points + piece.polygons.number + piece.strips.number > 0;
    if (is_in_piece_) pieces_.push_back(piece);
  }

  /// A number among the attributes of the tag; 0 without it.
  std::uint64_t count(const char* attribute) const {
    const std::string_view written = tags_.attribute(attribute).value_or("0");
    const std::optional<std::uint64_t> number = number_in<std::uint64_t>(written);
    if (!number) tags_.fail(std::string(attribute) + " is " + printable(written));
    return *number;
  }

  /// Keeps where an array is, if it is one of a mesh. Of several steps in time the first one counts.
  void read_array() {
    Piece& piece = pieces_.back();
    Array array;
    array.place = tags_.place();
    array.name = tags_.attribute("Name").value_or(section_);
    array.type = tags_.attribute("type").value_or("");
    const std::string_view format = tags_.attribute("format").value_or("ascii");
    array.is_appended = format == "appended";
    array.is_text = !array.is_appended && format != "binary";
    if (array.is_appended) array.offset = count("offset");
    Cells& cells = section_ == "Polys" ? piece.polygons : piece.strips;
    std::optional<Array>* const wanted = section_ == "Points"           ? &piece.points
                                         : array.name == "connectivity" ? &cells.connectivity
                                         : array.name == "offsets"      ? &cells.offsets
                                                                        : nullptr;
    if (!wanted || *wanted) return;
    if (wanted == &piece.points && tags_.attribute("NumberOfComponents").value_or("3") != "3")
      arrays_.fail(array, "has points that are not of three coordinates");
    if (!tags_.is_empty()) array.text = text_of_element();
    *wanted = array;
  }

  /// What stands in the element whose tag was read, outside those in it, as VTK puts keys around its numbers.
  std::string_view text_of_element() {
    const std::string element(tags_.name());
    const char* const place = tags_.place();
    std::string_view text;
    for (std::size_t depth = 1; depth > 0;) {
      if (!tags_.next()) tags_.fail_at(place, "the file ends within a " + element);
      const bool is_blank = tags_.text_before().find_first_not_of(" \t\r\n") == std::string_view::npos;
      if (depth == 1 && !is_blank) text = tags_.text_before();
      if (tags_.is_closing())
        --depth;
      else if (!tags_.is_empty())
        ++depth;
    }
    return text;
  }

  void read_points(Piece& piece) {
    piece.first_point = soup_.points.size();
    if (piece.number_of_points == 0) return;
    if (!piece.points) tags_.fail_at(piece.place, "the piece has no points");
    const std::vector<double> coordinates = arrays_.numbers<double>(*piece.points);
    if (coordinates.size() / 3 != piece.number_of_points || coordinates.size() % 3 != 0)
      arrays_.fail(*piece.points, "has " + std::to_string(coordinates.size()) + " coordinates, the piece promises " +
                                      std::to_string(piece.number_of_points) + " points");
    soup_.points.reserve(soup_.points.size() + coordinates.size() / 3);
    for (std::size_t i = 0; i < coordinates.size(); i += 3) {
      for (std::size_t j = i; j < i + 3; ++j)
        if (!std::isfinite(coordinates[j])) arrays_.fail(*piece.points, "has a coordinate that is not finite");
      soup_.points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
    }
  }

  /// \param section the name of the tag around them
  /// \param add_corner called with the number of each corner, \param end_cell after the last one of each cell
  template <class Add_corner, class End_cell>
  void read_cells(const Piece& piece, const Cells& cells, const std::string& section, const Add_corner& add_corner,
                  const End_cell& end_cell) {
    if (cells.number == 0) return;
    if (!cells.connectivity || !cells.offsets)
      tags_.fail_at(piece.place,
                    section + " of the piece have no " + (cells.connectivity ? "offsets" : "connectivity"));
    const auto ends = arrays_.numbers<std::int64_t>(*cells.offsets);
    if (ends.size() != cells.number)
      arrays_.fail(*cells.offsets, "has " + std::to_string(ends.size()) + " numbers, the piece promises " +
                                       std::to_string(cells.number) + " " + section);
    const auto corners = arrays_.numbers<std::int64_t>(*cells.connectivity);
    std::size_t corner = 0;
    for (const std::int64_t end : ends) {
      if (end < static_cast<std::int64_t>(corner) || end > static_cast<std::int64_t>(corners.size()))
        arrays_.fail(*cells.offsets, "has " + std::to_string(end) + " behind " + std::to_string(corner) +
                                         ", where there are " + std::to_string(corners.size()) + " corners");
      for (; corner < static_cast<std::size_t>(end); ++corner) {
        const std::int64_t point = corners[corner];
        if (point < 0 || static_cast<std::uint64_t>(point) >= piece.number_of_points)
          arrays_.fail(*cells.connectivity, "names point " + std::to_string(point) + ", the piece has " +
                                                std::to_string(piece.number_of_points) + " (the first is point 0)");
        add_corner(static_cast<Polygon_soup::Index>(piece.first_point + static_cast<std::size_t>(point)));
      }
      end_cell();
    }
  }

  Xml_tags tags_;
  Arrays arrays_;
  bool is_in_piece_ = false;  // one that is not empty
  std::string_view section_;  // with arrays that count; empty outside of one
  std::deque<Piece> pieces_;  // which are large
  Polygon_soup soup_;
};

}  // namespace vtp

/// Reads the polygons of a file of VTK's for polygons (VTP, https://docs.vtk.org/en/latest/vtk_file_formats/index.html), of all
/// pieces, and behind them the triangles of its strips: numbers of any type as text, as base64 or appended, the bytes in either order,
/// compressed by zlib or not. Points and lines that are cells, and data of points and cells, are passed over.
inline Polygon_soup read_vtp(const std::string& path, std::string_view content) {
  return vtp::Reader(path, content).soup();
}

}  // namespace mesh_files

#endif
