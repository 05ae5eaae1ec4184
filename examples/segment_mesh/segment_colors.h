#ifndef SEGMENT_MESH_SEGMENT_COLORS_H
#define SEGMENT_MESH_SEGMENT_COLORS_H

#include "Oriented_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace segment_mesh {

/// A sequence of distinct colours: eight hues that people with a colour-vision deficiency can tell apart (Okabe and Ito
/// 2008, grey in the place of black), then lighter and darker shades of them.
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

/// A colour for each segment, such that neighbours never look alike: they differ in hue as long as eight hues will do,
/// and in shade beyond. Segments far apart differ, too, as long as there are distinct colours.
///
/// \param segment the segments of the faces, numbered from 0 without gaps
inline std::vector<mesh_files::Color> segment_colors(const Mesh& mesh, const std::vector<std::size_t>& segment,
                                                     std::size_t number_of_segments) {
  constexpr std::size_t hues = 8;
  constexpr std::size_t shades = 7;                    // more of them are too close to white or black
  using Choice = std::pair<std::size_t, std::size_t>;  // shade, hue
  const auto pairs = neighbouring_segments(mesh, segment);

  std::vector<Choice> choice(number_of_segments);
  std::array<std::array<std::size_t, hues>, shades> uses{};
  auto pair = pairs.begin();
  for (std::size_t s = 0; s < number_of_segments; ++s) {
    std::array<std::array<bool, hues>, shades> is_taken{};
    std::array<bool, hues> is_hue_taken{};
    for (; pair != pairs.end() && pair->first == s; ++pair) {
      if (pair->second > s) continue;  // has no colour yet
      const auto [shade, hue] = choice[pair->second];
      is_taken[shade][hue] = true;
      is_hue_taken[hue] = true;
    }
    const bool needs_shades = std::all_of(is_hue_taken.begin(), is_hue_taken.end(), [](bool taken) { return taken; });
    std::pair<std::size_t, Choice> best = {std::size_t(-1), {0, 0}};
    for (std::size_t shade = 0; shade < shades; ++shade)
      for (std::size_t hue = 0; hue < hues; ++hue)
        if (needs_shades ? !is_taken[shade][hue] : !is_hue_taken[hue])
          best = std::min(best, {uses[shade][hue], Choice(shade, hue)});
    choice[s] = best.second;
    ++uses[choice[s].first][choice[s].second];
  }

  std::vector<mesh_files::Color> colors;
  colors.reserve(number_of_segments);
  for (const auto& [shade, hue] : choice) colors.push_back(color(hue, shade));
  return colors;
}

}  // namespace segment_mesh

#endif
