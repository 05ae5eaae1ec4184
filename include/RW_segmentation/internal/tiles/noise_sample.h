// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_TILES_NOISE_SAMPLE_H
#define RW_SEGMENTATION_INTERNAL_TILES_NOISE_SAMPLE_H

#include <RW_segmentation/Dual_mesh.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace RW_segmentation::internal {

/// Faces on which the noise of a mesh is measured.
struct Noise_sample {
  std::vector<Dual_mesh::Index> faces;  ///< rising
  std::vector<char> is_counted;  ///< by these; along the rims of patches normals are not smoothed as on the whole
};

/// Takes patches of a mesh, all over it, until they have so many faces together. Those of several patches count for each of
/// them, so that it ends soon on any mesh.
class Noise_patches {
 public:
  using Index = Dual_mesh::Index;

  /// \param most faces of all patches, fewer than the mesh has
  /// \param largest number of faces of a patch, at least 1
  Noise_patches(const Dual_graph& graph, std::size_t most, std::size_t largest)
      : graph_(graph),
        largest_(largest),
        patch_(graph.number_of_faces(), 0),
        is_taken_(patch_.size(), false),
        is_counted_(patch_.size(), false) {
    // Parts of the golden ratio: however many there are, they lie evenly in the unit interval.
    constexpr double spread = 0.6180339887498949;
    const auto faces = static_cast<double>(graph.number_of_faces());
    std::size_t taken = 0;
    for (Index p = 1; taken < most; ++p) {
      const double place = p * spread;
      taken +=
          grow(std::min(static_cast<Index>((place - std::floor(place)) * faces), static_cast<Index>(faces) - 1), p);
    }
  }

  Noise_sample sample() const {
    Noise_sample sample;
    for (Index f = 0; f < is_taken_.size(); ++f) {
      if (!is_taken_[f]) continue;
      sample.faces.push_back(f);
      sample.is_counted.push_back(is_counted_[f]);
    }
    return sample;
  }

 private:
  /// Grows a patch in steps from face to face. One that has taken all of its component has no rim.
  /// \returns the number of its faces
  std::size_t grow(Index first, Index patch) {
    constexpr double inside = 2. / 3;  // of the radius of a patch
    std::vector<Index> faces = {first};
    std::vector<std::size_t> begin = {0};  // of the faces of each step
    patch_[first] = patch;
    while (begin.back() < faces.size() && faces.size() < largest_) {
      const std::size_t end = faces.size();
      for (std::size_t i = begin.back(); i < end; ++i)
        for (const auto& neighbour : graph_.neighbours(faces[i]))
          if (patch_[neighbour.face] != patch) {
            patch_[neighbour.face] = patch;
            faces.push_back(neighbour.face);
          }
      begin.push_back(end);
    }
    const bool is_component = faces.size() < largest_;
    const auto steps_inside = static_cast<std::size_t>(std::ceil(inside * static_cast<double>(begin.size())));
    const std::size_t inner = is_component || steps_inside >= begin.size() ? faces.size() : begin[steps_inside];
    for (std::size_t i = 0; i < faces.size(); ++i) {
      is_taken_[faces[i]] = true;
      if (i < inner) is_counted_[faces[i]] = true;
    }
    return faces.size();
  }

  const Dual_graph& graph_;
  std::size_t largest_;
  std::vector<Index> patch_;  // by face: the last one that has taken it
  std::vector<char> is_taken_, is_counted_;
};

/// All faces of a small mesh, and patches of a large one.
/// \param smoothing_length of the normals, in the unit box
/// \param of_patches faces that they have together, or little more; a mesh is large that has more than twice as many
inline Noise_sample noise_sample(const Dual_mesh& mesh, double smoothing_length, std::size_t of_patches) {
  const std::size_t faces = mesh.number_of_faces();
  if (faces <= 2 * of_patches) {
    Noise_sample sample;
    sample.faces.resize(faces);
    std::iota(sample.faces.begin(), sample.faces.end(), Dual_mesh::Index(0));
    sample.is_counted.assign(faces, true);
    return sample;
  }
  constexpr double pi = 3.141592653589793;
  // Of a patch, in smoothing lengths: a third of it is rim. If rims count, clean meshes seem to have 1.1 to 2.2 times the noise.
  constexpr double radius = 3;
  // Patches, where the smoothing length is that of a whole of more than 100 million faces.
  constexpr std::size_t fewest = 4;
  const double area = std::accumulate(mesh.areas().begin(), mesh.areas().end(), 0.);
  const double faces_of_disc = pi * std::pow(radius * smoothing_length, 2) * static_cast<double>(faces) / area;
  const double largest =
      std::min(static_cast<double>(of_patches) / static_cast<double>(fewest), std::max(faces_of_disc, 1.));
  return Noise_patches(mesh.graph(), of_patches, static_cast<std::size_t>(largest)).sample();
}

}  // namespace RW_segmentation::internal

#endif
