// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SEEDS_READ_SEEDS_H
#define RW_SEGMENTATION_INTERNAL_SEEDS_READ_SEEDS_H

#include <RW_segmentation/Dual_mesh.h>

#include <boost/graph/graph_traits.hpp>

#include <array>
#include <cstddef>
#include <iterator>
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

/// Given seeds without those that are there already.
/// \throws std::invalid_argument if a seed is none of the `number_of_faces`, naming it by its place
std::vector<Dual_mesh::Index> each_once(std::vector<Dual_mesh::Index> seeds, std::size_t number_of_faces);

/// Seeds as numbers of faces, each once.
/// \throws std::invalid_argument if a seed is not a face of the mesh, naming its place
template <class FaceListGraph, class SeedRange>
std::vector<Dual_mesh::Index> read_seeds(const Dual_mesh_of<FaceListGraph>& mesh, const SeedRange& seeds) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(Is_seed_range<SeedRange, face_descriptor>::value,
                "Seeds are a range of faces of the mesh, or of pairs of a face and a label.");
  std::vector<Dual_mesh::Index> faces;
  for (const auto& seed : seeds) {
    if constexpr (std::is_convertible_v<decltype(seed), face_descriptor>)
      faces.push_back(mesh.index(seed));
    else
      faces.push_back(mesh.index(seed.first));
  }
  return each_once(std::move(faces), mesh.number_of_faces());
}

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/read_seeds.h>
#endif

#endif
