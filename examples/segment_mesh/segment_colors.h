// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_SEGMENT_COLORS_H
#define SEGMENT_MESH_SEGMENT_COLORS_H

#include "../mesh_files/Colors.h"
#include "Oriented_mesh.h"
#include "color_vision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace segment_mesh {

/// A sequence of distinct colours: eight hues that suit people with a colour-vision deficiency (Okabe and Ito 2008, grey
/// in the place of black), then lighter and darker shades of them.
inline mesh_files::Color color(std::size_t hue, std::size_t shade) {
  constexpr std::array<std::array<double, 3>, 8> hues = {{{0, 114, 178},      // blue
                                                          {230, 159, 0},      // orange
                                                          {0, 158, 115},      // bluish green
                                                          {204, 121, 167},    // reddish purple
                                                          {86, 180, 233},     // sky blue
                                                          {213, 94, 0},       // vermilion
                                                          {240, 228, 66},     // yellow
                                                          {153, 153, 153}}};  // grey
  const double end = shade % 2 == 1 ? 255 : 0;  // odd shades are lighter, even ones darker
  const double share = 1 - std::pow(0.6, static_cast<double>((shade + 1) / 2));
  mesh_files::Color result{};
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = static_cast<std::uint8_t>(std::lround(hues[hue][i] + share * (end - hues[hue][i])));
  return result;
}

/// The pairs of segments that share an edge, sorted, each in both orders.
inline std::vector<std::pair<std::size_t, std::size_t>> neighbouring_segments(const Mesh& mesh,
                                                                              const std::vector<std::size_t>& segment) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto e : mesh.edges()) {
    if (mesh.is_border(e)) continue;
    const std::size_t a = segment[mesh.face(mesh.halfedge(e, 0))], b = segment[mesh.face(mesh.halfedge(e, 1))];
    if (a == b) continue;
    pairs.emplace_back(a, b);
    pairs.emplace_back(b, a);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// The colours to choose from, and how far apart they look.
class Palette {
 public:
  static constexpr std::size_t size = std::size_t(8) * 7;  // more shades are too close to white or black

  Palette() {
    for (std::size_t i = 0; i < size; ++i) colors_[i] = color(i % 8, i / 8);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        distances_[i][j] = distances_[j][i] = apparent_distance(colors_[i], colors_[j]);
  }

  const mesh_files::Color& operator[](std::size_t i) const { return colors_[i]; }
  double distance(std::size_t i, std::size_t j) const { return distances_[i][j]; }

 private:
  std::array<mesh_files::Color, size> colors_{};
  std::array<std::array<double, size>, size> distances_{};
};

/// Where neighbouring segments are given colours at least so far apart, see `apparent_distance()`.
constexpr double distinct_colors = 0.1;

/// A colour for each segment, such that neighbours never look alike, also to people with a colour-vision deficiency.
/// Of the colours that are far enough from those of the neighbours the least used one is taken, so that segments far
/// apart differ, too, as long as there are distinct colours. A segment with so many neighbours that none is far enough
/// gets the one that is farthest.
///
/// \param neighbours of each segment
inline std::vector<mesh_files::Color> segment_colors(const std::vector<std::vector<std::size_t>>& neighbours) {
  const Palette palette;
  const std::size_t number_of_segments = neighbours.size();
  std::vector<std::size_t> order(number_of_segments);
  std::iota(order.begin(), order.end(), std::size_t(0));
  // Those with the most neighbours choose first (Welsh and Powell 1967).
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return neighbours[a].size() > neighbours[b].size(); });

  constexpr std::size_t none = Palette::size;
  std::vector<std::size_t> choice(number_of_segments, none);
  std::array<std::size_t, Palette::size> uses{};
  for (const std::size_t s : order) {
    const auto distance_to_neighbours = [&](std::size_t candidate) {
      double smallest = distinct_colors;
      for (const std::size_t neighbour : neighbours[s])
        if (choice[neighbour] != none) smallest = std::min(smallest, palette.distance(candidate, choice[neighbour]));
      return smallest;
    };
    std::tuple<double, std::size_t, std::size_t> best(1, 0, 0);  // distance as a loss, uses, colour
    for (std::size_t candidate = 0; candidate < Palette::size; ++candidate)
      best = std::min(best, std::tuple(-distance_to_neighbours(candidate), uses[candidate], candidate));
    choice[s] = std::get<2>(best);
    ++uses[choice[s]];
  }

  std::vector<mesh_files::Color> colors;
  colors.reserve(number_of_segments);
  for (const std::size_t c : choice) colors.push_back(palette[c]);
  return colors;
}

/// As above.
/// \param segment the segments of the faces, numbered from 0 without gaps
inline std::vector<mesh_files::Color> segment_colors(const Mesh& mesh, const std::vector<std::size_t>& segment,
                                                     std::size_t number_of_segments) {
  std::vector<std::vector<std::size_t>> neighbours(number_of_segments);
  for (const auto& [a, b] : neighbouring_segments(mesh, segment)) neighbours[a].push_back(b);
  return segment_colors(neighbours);
}

}  // namespace segment_mesh

#endif
