// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_READ_CONDUCTANCES_H
#define RW_SEGMENTATION_INTERNAL_WALK_READ_CONDUCTANCES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/Argument_error.h>

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace RW_segmentation::internal {

template <class Map, class = void>
struct Has_conductances : std::false_type {};
template <class Map>
struct Has_conductances<Map, std::void_t<typename Map::is_conductance>> : Map::is_conductance {};

/// Whether an edge map says that its values are conductances and not, say, differences, which look the same.
template <class Map>
constexpr bool has_conductances = Has_conductances<Map>::value;

/// The conductances of the edges by number, 0 on walls.
/// \throws std::invalid_argument if one is negative or not finite
template <class FaceListGraph, class ConductanceMap>
std::vector<double> read_conductances(const Dual_mesh_of<FaceListGraph>& mesh, const ConductanceMap& conductance) {
  std::vector<double> values = mesh.read_edges(conductance, "the conductance");
  for (std::size_t e = 0; e < values.size(); ++e) {
    if (!std::isfinite(values[e])) throw argument_error("a conductance", values[e], "finite");
    if (mesh.is_wall(static_cast<Dual_mesh::Index>(e))) values[e] = 0;
  }
  return values;
}

}  // namespace RW_segmentation::internal

#endif
