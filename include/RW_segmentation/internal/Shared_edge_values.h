// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SHARED_EDGE_VALUES_H
#define RW_SEGMENTATION_INTERNAL_SHARED_EDGE_VALUES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/mesh/Descriptor_index.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// A readable property map from the edges of a mesh to numbers that never change and that all copies share; 0 on
/// border edges. Looking a value up is O(1) and safe from several threads.
template <class FaceListGraph>
class Shared_edge_values {
 public:
  using key_type = typename boost::graph_traits<FaceListGraph>::edge_descriptor;
  using value_type = double;
  using reference = double;
  using category = boost::readable_property_map_tag;

  /// Takes the values in the order of the edges of the dual mesh.
  Shared_edge_values(const Dual_mesh_of<typename Mesh_type<FaceListGraph>::type>& mesh,
                     const std::vector<double>& values) {
    auto table = std::make_shared<Table>(0.);
    table->reserve(values.size());
    std::size_t i = 0;
    for (const key_type e : mesh.edge_descriptors()) table->insert(e, values[i++]);
    table_ = std::move(table);
  }

  friend double get(const Shared_edge_values& map, const key_type& edge) { return (*map.table_)[edge]; }

 private:
  using Table = Descriptor_table<key_type, double>;
  std::shared_ptr<const Table> table_;
};

}  // namespace RW_segmentation::internal

#endif
