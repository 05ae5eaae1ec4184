// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_POLYGON_SOUP_H
#define MESH_FILES_POLYGON_SOUP_H

#include <CGAL/Simple_cartesian.h>

#include <boost/range/iterator_range.hpp>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

namespace mesh_files {

/// What a mesh file holds: points, and faces in the order of the file, each a row of numbers of points.
///
/// Nothing is promised beyond finite coordinates and point numbers that exist: faces may have fewer than three
/// corners, repeat a corner, or meet in ways that no surface has.
struct Polygon_soup {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  using Index = std::uint32_t;  ///< number of a point

  std::vector<Point> points;
  std::vector<Index> corners;                   ///< of all faces, one face after the other
  std::vector<std::size_t> first_corner = {0};  ///< of each face, and the end of the last
  /// Some formats have several meshes, each with a name: where their faces begin.
  struct Part {
    std::string name;
    std::size_t first_face = 0;
  };
  std::vector<Part> parts;
  std::vector<std::string> remarks;  ///< what is odd about the file it was read from, a sentence each

  std::size_t number_of_faces() const { return first_corner.size() - 1; }

  /// The corners of a face.
  boost::iterator_range<const Index*> face(std::size_t i) const {
    return {corners.data() + first_corner[i], corners.data() + first_corner[i + 1]};
  }

  /// Makes a face of the corners added since the last one.
  void end_face() { first_corner.push_back(corners.size()); }
};

/// Some of the faces of a soup, in the given order, with the points that they need.
inline Polygon_soup part_of(const Polygon_soup& soup, const std::vector<std::size_t>& faces) {
  Polygon_soup part;
  std::unordered_map<Polygon_soup::Index, Polygon_soup::Index> number;
  for (const std::size_t f : faces) {
    for (const Polygon_soup::Index corner : soup.face(f)) {
      const auto [found, is_new] = number.emplace(corner, static_cast<Polygon_soup::Index>(number.size()));
      if (is_new) part.points.push_back(soup.points[corner]);
      part.corners.push_back(found->second);
    }
    part.end_face();
  }
  return part;
}

/// A mesh file that cannot be read. The message names the file, the line where it can be told, and the cause.
class Unreadable_file : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that cannot be written. The message names the file and the cause.
class Unwritable_file : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace mesh_files

#endif
