// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_PIECES_H
#define MESH_FILES_PIECES_H

#include "Polygon_soup.h"

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#endif

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace mesh_files {

/// The bytes of a piece that are worth a thread: a millisecond or more, against some microseconds to hand it over.
constexpr std::size_t size_of_pieces = std::size_t(1) << 20;

/// Whether texts are cut into pieces: a page in a browser has one thread, and its size counts.
#ifdef __EMSCRIPTEN__
constexpr bool reads_pieces = false;
#else
constexpr bool reads_pieces = true;
#endif

/// Calls `work(i)` for i = 0 .. `number` - 1, for several at the same time where TBB is linked.
template <class Work>
void for_each_piece(std::size_t number, const Work& work) {
#ifdef CGAL_LINKED_WITH_TBB
  if (number > 1) return tbb::parallel_for(std::size_t(0), number, work, tbb::simple_partitioner());
#endif
  for (std::size_t i = 0; i < number; ++i) work(i);
}

/// Cuts a text behind line feeds, but not where a backslash joins two lines.
/// \param size of a piece in bytes, or a line more
inline std::vector<std::string_view> pieces_of(std::string_view text, std::size_t size) {
  std::vector<std::string_view> pieces;
  while (!text.empty()) {
    std::size_t end = std::min(size, text.size()) - 1;
    for (;; ++end) {
      end = text.find('\n', end);
      if (end == std::string_view::npos) break;
      const std::size_t last = text.find_last_not_of(" \t\r\n", end);
      if (last == std::string_view::npos || text[last] != '\\') break;
    }
    pieces.push_back(text.substr(0, end == std::string_view::npos ? end : end + 1));
    text.remove_prefix(pieces.back().size());
  }
  return pieces;
}

/// Adds the faces of several soups to one, and leaves them without.
inline void append_faces(std::vector<Polygon_soup>& pieces, Polygon_soup& soup) {
  std::vector<std::pair<std::size_t, std::size_t>> begin(pieces.size());  // the first face and corner of each piece
  std::size_t faces = soup.first_corner.size(), corners = soup.corners.size();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    begin[i] = {faces, corners};
    faces += pieces[i].number_of_faces();
    corners += pieces[i].corners.size();
  }
  soup.first_corner.resize(faces);
  soup.corners.resize(corners);
  for_each_piece(pieces.size(), [&](std::size_t i) {
    const Polygon_soup piece = std::move(pieces[i]);
    const auto [first_face, first_corner] = begin[i];
    std::copy(piece.corners.begin(), piece.corners.end(),
              soup.corners.begin() + static_cast<std::ptrdiff_t>(first_corner));
    for (std::size_t f = 0; f < piece.number_of_faces(); ++f)
      soup.first_corner[first_face + f] = first_corner + piece.first_corner[f + 1];
  });
}

}  // namespace mesh_files

#endif
