// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_STRIPS_H
#define MESH_FILES_STRIPS_H

#include "Polygon_soup.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace mesh_files {

/// Strips of triangles: each corner after the second makes a triangle with the two before it.
class Strips {
 public:
  void add(Polygon_soup::Index corner) { corners_.push_back(corner); }
  void end_strip() { add(end); }

  /// Adds the triangles, in the order of the strips. Those with a corner twice only lead on to the next ones.
  void append_to(Polygon_soup& soup) const {
    std::size_t triangles = 0;
    for_each_triangle([&](auto, auto, auto) { ++triangles; });
    soup.corners.reserve(soup.corners.size() + 3 * triangles);
    soup.first_corner.reserve(soup.first_corner.size() + triangles);
    for_each_triangle([&](Polygon_soup::Index a, Polygon_soup::Index b, Polygon_soup::Index c) {
      soup.corners.insert(soup.corners.end(), {a, b, c});
      soup.end_face();
    });
  }

 private:
  static constexpr Polygon_soup::Index end = std::numeric_limits<Polygon_soup::Index>::max();

  template <class Function>
  void for_each_triangle(const Function& function) const {
    std::size_t begin = 0;  // of the strip
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i] == end) begin = i + 1;
      if (i < begin + 2) continue;
      const bool is_turned = (i - begin) % 2 == 1;
      const auto a = corners_[i - 2 + is_turned], b = corners_[i - 1 - is_turned], c = corners_[i];
      if (a != b && b != c && c != a) function(a, b, c);
    }
  }

  std::vector<Polygon_soup::Index> corners_;  // of all strips, with `end` after each
};

}  // namespace mesh_files

#endif
