// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_FACE_SAMPLE_H
#define SEGMENT_MESH_TILES_FACE_SAMPLE_H

#include <RW_segmentation/Tile.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace segment_mesh {

/// A number that looks random, the same for the same number.
inline std::uint64_t scrambled(std::uint64_t number) {  // the finalizer of MurmurHash3
  number = (number ^ (number >> 33)) * 0xff51afd7ed558ccd;
  number = (number ^ (number >> 33)) * 0xc4ceb9fe1a85ec53;
  return number ^ (number >> 33);
}

/// The least of the numbers that stand for the faces of a tile, by the places of their corners and their order: those of all
/// faces of a small tile. Of a large one so many that a row of faces along one side, which two tiles have both, is found
/// out: some of its faces are in the samples of both tiles.
/// Complexity: linear.
inline std::vector<std::uint64_t> face_sample(const RW_segmentation::Tile& tile) {
  constexpr std::size_t most = 16384;
  std::vector<std::uint64_t> of_vertex;
  of_vertex.reserve(tile.points.size());
  for (const Eigen::Vector3d& point : tile.points) {
    std::uint64_t place = 0;
    for (const double coordinate : {point[0] + 0., point[1] + 0., point[2] + 0.}) {  // zero has no sign
      std::uint64_t bits = 0;
      std::memcpy(&bits, &coordinate, sizeof bits);
      place = scrambled(place + bits);
    }
    of_vertex.push_back(place);
  }
  std::vector<std::uint64_t> sample;
  sample.reserve(tile.number_of_faces());
  for (std::size_t f = 0; f < tile.number_of_faces(); ++f) {
    const auto corners = tile.corners[static_cast<RW_segmentation::Dual_mesh::Index>(f)];
    std::uint64_t sum = 0, before = of_vertex[corners[corners.size() - 1]];
    for (const auto corner : corners) {
      sum += scrambled(before + 3 * of_vertex[corner]);
      before = of_vertex[corner];
    }
    sample.push_back(scrambled(sum));
  }
  if (sample.size() > most) {
    std::nth_element(sample.begin(), sample.begin() + most, sample.end());
    sample.resize(most);
    sample.shrink_to_fit();
  }
  return sample;
}

/// The pairs of tiles that have faces in common, as their samples tell; the lower one first, rising.
/// \param samples by tile
/// Complexity: O(n log n) for n numbers in all of them, and as many pairs as have the same.
inline std::vector<std::array<RW_segmentation::Dual_mesh::Index, 2>> overlapping_tiles(
    const std::vector<std::vector<std::uint64_t>>& samples) {
  using Index = RW_segmentation::Dual_mesh::Index;
  std::vector<std::pair<std::uint64_t, Index>> places;  // the number, the tile
  for (std::size_t t = 0; t < samples.size(); ++t)
    for (const std::uint64_t number : samples[t]) places.emplace_back(number, static_cast<Index>(t));
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<std::array<Index, 2>> pairs;
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i].first == places[i - 1].first) pairs.push_back({places[i - 1].second, places[i].second});
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace segment_mesh

#endif
