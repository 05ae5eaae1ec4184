// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SEEDS_READ_SEEDS_H
#define RW_SEGMENTATION_INTERNAL_SEEDS_READ_SEEDS_H

#include <RW_segmentation/Dual_mesh.h>

#include <boost/graph/graph_traits.hpp>

#include <array>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// No seeds of the user's.
template <class FaceListGraph>
constexpr std::array<typename boost::graph_traits<FaceListGraph>::face_descriptor, 0> no_seeds = {};

template <class Seed, class Face, class = void>
struct Is_seed : std::is_convertible<Seed, Face> {};
template <class Seed, class Face>
struct Is_seed<Seed, Face, std::void_t<decltype(std::declval<Seed>().first)>>
    : std::disjunction<std::is_convertible<Seed, Face>,
                       std::is_convertible<decltype(std::declval<Seed>().first), Face>> {};

template <class SeedRange, class Face, class = void>
struct Is_seed_range : std::false_type {};
template <class SeedRange, class Face>
struct Is_seed_range<SeedRange, Face, std::void_t<decltype(*std::begin(std::declval<const SeedRange&>()))>>
    : Is_seed<decltype(*std::begin(std::declval<const SeedRange&>())), Face> {};

/// Seeds as numbers of faces, each once.
/// \throws std::invalid_argument if a seed is not a face of the mesh, naming its place
template <class FaceListGraph, class SeedRange>
std::vector<Dual_mesh::Index> read_seeds(const Dual_mesh_of<FaceListGraph>& mesh, const SeedRange& seeds) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(Is_seed_range<SeedRange, face_descriptor>::value,
                "Seeds are a range of faces of the mesh, or of pairs of a face and a label.");
  std::vector<Dual_mesh::Index> faces;
  std::vector<bool> known(mesh.number_of_faces(), false);
  std::size_t place = 0;
  for (const auto& seed : seeds) {
    Dual_mesh::Index face = 0;
    if constexpr (std::is_convertible_v<decltype(seed), face_descriptor>)
      face = mesh.index(seed);
    else
      face = mesh.index(seed.first);
    if (face == mesh.none)
      throw std::invalid_argument("given seed " + std::to_string(place) + " is not a face of the mesh");
    if (!known[face]) faces.push_back(face);
    known[face] = true;
    ++place;
  }
  return faces;
}

}  // namespace RW_segmentation::internal

#endif
