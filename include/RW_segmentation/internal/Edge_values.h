#ifndef RW_SEGMENTATION_INTERNAL_EDGE_VALUES_H
#define RW_SEGMENTATION_INTERNAL_EDGE_VALUES_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/Descriptor_index.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Whether `get(map, key)` may be called for keys of the type `Key`.
template <class Map, class Key>
constexpr bool is_readable_map =
    std::is_convertible_v<typename boost::property_traits<Map>::category, boost::readable_property_map_tag>&&
        std::is_convertible_v<Key, typename boost::property_traits<Map>::key_type>;

/// Whether `put(map, key, value)` may be called for keys of the type `Key`.
template <class Map, class Key>
constexpr bool is_writable_map =
    std::is_convertible_v<typename boost::property_traits<Map>::category, boost::writable_property_map_tag>&&
        std::is_convertible_v<Key, typename boost::property_traits<Map>::key_type>;

/// A readable property map from the edges of a mesh to numbers that never change and that all copies share; 0 on
/// border edges. Looking a value up is O(1) and safe from several threads.
template <class FaceListGraph>
class Shared_edge_values {
 public:
  using key_type = typename boost::graph_traits<FaceListGraph>::edge_descriptor;
  using value_type = double;
  using reference = double;
  using category = boost::readable_property_map_tag;

  /// Takes the values in the order of the edges of `graph`.
  Shared_edge_values(const Mesh_dual_graph<FaceListGraph>& graph, const std::vector<double>& values) {
    auto table = std::make_shared<Table>(0.);
    table->reserve(values.size());
    std::size_t i = 0;
    for (const key_type e : graph.edge_descriptors()) table->insert(e, values[i++]);
    table_ = std::move(table);
  }

  friend double get(const Shared_edge_values& map, const key_type& edge) { return (*map.table_)[edge]; }

 private:
  using Table = Descriptor_table<key_type, double>;
  std::shared_ptr<const Table> table_;
};

/// A difference, or any other edge map of a user, as an array in the order of the edges of `graph`; each edge is asked
/// once.
/// \throws std::invalid_argument if a value is negative or NaN, naming the edge by the numbers of its faces
template <class FaceListGraph, class EdgeMap>
std::vector<double> read_edge_values(const Mesh_dual_graph<FaceListGraph>& graph, const EdgeMap& map,
                                     const std::string& argument) {
  using edge_descriptor = typename boost::graph_traits<FaceListGraph>::edge_descriptor;
  static_assert(is_readable_map<EdgeMap, edge_descriptor>,
                "A readable property map from the mesh's edge_descriptor to double is needed here.");
  static_assert(std::is_convertible_v<typename boost::property_traits<EdgeMap>::value_type, double>,
                "The values of this edge map must be convertible to double.");

  std::vector<double> values;
  values.reserve(graph.number_of_edges());
  for (const edge_descriptor e : graph.edge_descriptors()) {
    const double value = static_cast<double>(get(map, e));
    if (!(value >= 0)) {
      const auto [f, g] = graph.faces_of(static_cast<Dual_graph::Index>(values.size()));
      const std::string where = " on the edge between faces " + std::to_string(f) + " and " + std::to_string(g);
      throw argument_error((argument + where).c_str(), value, "a number >= 0");
    }
    values.push_back(value);
  }
  return values;
}

}  // namespace RW_segmentation::internal

#endif
