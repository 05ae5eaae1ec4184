// SPDX-License-Identifier: MIT

#ifndef MESH_FILES_COLORS_H
#define MESH_FILES_COLORS_H

#include "Polygon_soup.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace mesh_files {

/// Red, green and blue.
using Color = std::array<std::uint8_t, 3>;

/// The colours of a mesh that is written. Those of faces are exact; viewers that know only those of points need these.
struct Colors {
  std::vector<Color> of_faces;   ///< one each, or none at all
  std::vector<Color> of_points;  ///< likewise
};

/// A colour for each face and none for points.
inline Colors colors_of_faces(std::vector<Color> face_colors) { return {std::move(face_colors), {}}; }

/// The colours of faces as colours of points, and none for faces. No point may belong to faces of several colours; see
/// `with_points_apart()`.
inline Colors colors_of_points(const Polygon_soup& soup, const std::vector<Color>& face_colors) {
  Colors colors;
  colors.of_points.resize(soup.points.size(), Color{128, 128, 128});
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for (const auto corner : soup.face(f)) colors.of_points[corner] = face_colors[f];
  return colors;
}

/// The same faces in the same order, with points between segments written once for each segment. Points without a face
/// are kept.
inline Polygon_soup with_points_apart(const Polygon_soup& soup, const std::vector<std::size_t>& face_labels) {
  using Index = Polygon_soup::Index;
  Polygon_soup apart = soup;
  std::vector<bool> is_taken(soup.points.size(), false);
  std::vector<std::size_t> first_label(soup.points.size());
  std::map<std::pair<Index, std::size_t>, Index> copy_for;  // of a point, for a further label
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for (std::size_t i = soup.first_corner[f]; i < soup.first_corner[f + 1]; ++i) {
      const Index point = soup.corners[i];
      if (!is_taken[point]) first_label[point] = face_labels[f];
      is_taken[point] = true;
      if (first_label[point] == face_labels[f]) continue;
      const auto [found, is_new] =
          copy_for.emplace(std::pair(point, face_labels[f]), static_cast<Index>(apart.points.size()));
      if (is_new) apart.points.push_back(soup.points[point]);
      apart.corners[i] = found->second;
    }
  return apart;
}

}  // namespace mesh_files

#endif
