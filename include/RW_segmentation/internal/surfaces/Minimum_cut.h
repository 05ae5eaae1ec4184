// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_MINIMUM_CUT_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_MINIMUM_CUT_H

#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/graph_traits.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Arcs between nodes as compressed rows: what Boost.Graph's maximum flow needs of a graph. Nodes and arcs are numbers. Its
/// `compressed_sparse_row_graph` hides a function from other parts of Boost, and g++ warns of its `adjacency_list`.
class Flow_network {
 public:
  using vertex_descriptor = std::size_t;
  using edge_descriptor = std::size_t;
  using vertex_iterator = boost::counting_iterator<std::size_t>;
  using edge_iterator = vertex_iterator;
  using out_edge_iterator = vertex_iterator;
  using vertices_size_type = std::size_t;
  using edges_size_type = std::size_t;
  using degree_size_type = std::size_t;
  using directed_category = boost::directed_tag;
  using edge_parallel_category = boost::allow_parallel_edge_tag;
  struct traversal_category : boost::vertex_list_graph_tag, boost::edge_list_graph_tag, boost::incidence_graph_tag {};

  static std::size_t null_vertex() { return std::numeric_limits<std::size_t>::max(); }

  /// \param edges from one node to another one; each becomes two arcs, there and back
  /// \param arc_of_edge where the numbers of these are written
  Flow_network(std::size_t nodes, const std::vector<std::array<std::size_t, 2>>& edges,
               std::vector<std::array<std::size_t, 2>>& arc_of_edge)
      : row_(nodes + 1, 0), source_(2 * edges.size()), target_(2 * edges.size()) {
    for (const auto& ends : edges)
      for (const std::size_t node : ends) ++row_[node + 1];
    for (std::size_t node = 0; node < nodes; ++node) row_[node + 1] += row_[node];
    std::vector<std::size_t> next(row_.begin(), row_.end() - 1);
    arc_of_edge.resize(edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e)
      for (std::size_t side = 0; side < 2; ++side) {
        const std::size_t arc = next[edges[e][side]]++;
        source_[arc] = edges[e][side];
        target_[arc] = edges[e][1 - side];
        arc_of_edge[e][side] = arc;
      }
  }

  friend std::size_t num_vertices(const Flow_network& network) { return network.row_.size() - 1; }
  friend std::size_t num_edges(const Flow_network& network) { return network.target_.size(); }
  friend std::pair<vertex_iterator, vertex_iterator> vertices(const Flow_network& network) {
    return {vertex_iterator(0), vertex_iterator(num_vertices(network))};
  }
  friend std::pair<edge_iterator, edge_iterator> edges(const Flow_network& network) {
    return {edge_iterator(0), edge_iterator(num_edges(network))};
  }
  friend std::pair<out_edge_iterator, out_edge_iterator> out_edges(std::size_t node, const Flow_network& network) {
    return {out_edge_iterator(network.row_[node]), out_edge_iterator(network.row_[node + 1])};
  }
  friend std::size_t out_degree(std::size_t node, const Flow_network& network) {
    return network.row_[node + 1] - network.row_[node];
  }
  friend std::size_t source(std::size_t arc, const Flow_network& network) { return network.source_[arc]; }
  friend std::size_t target(std::size_t arc, const Flow_network& network) { return network.target_[arc]; }

 private:
  std::vector<std::size_t> row_, source_, target_;
};

/// Parts nodes in two at the least cost: what each of them costs on its side, and what edges cost whose ends are on
/// different sides. By the maximum flow of Boykov and Kolmogorov (2004), Boost.Graph's.
class Minimum_cut {
 public:
  explicit Minimum_cut(std::size_t nodes) : first_(nodes), second_(nodes + 1), color_(nodes + 2) {}

  /// What a node costs on either side.
  void set_costs(std::size_t node, double on_first, double on_second) {
    const double common = std::min(on_first, on_second);
    connect(first_, node, on_second - common, 0);
    connect(node, second_, on_first - common, 0);
  }

  /// What it costs that two nodes are on different sides, at least 0.
  void set_cost_between(std::size_t node, std::size_t other, double cost) { connect(node, other, cost, cost); }

  /// Finds the cut, once.
  void run() {
    std::vector<std::array<std::size_t, 2>> arcs;
    const Flow_network network(color_.size(), ends_, arcs);
    std::vector<double> capacity(2 * arcs.size()), residual(2 * arcs.size());
    std::vector<std::size_t> reverse(2 * arcs.size());
    for (std::size_t e = 0; e < arcs.size(); ++e)
      for (std::size_t side = 0; side < 2; ++side) {
        capacity[arcs[e][side]] = capacities_[e][side];
        reverse[arcs[e][side]] = arcs[e][1 - side];
      }
    std::vector<std::size_t> predecessor(color_.size());
    std::vector<long> distance(color_.size());
    const boost::typed_identity_property_map<std::size_t> number;
    const auto map = [&](auto& values) { return boost::make_iterator_property_map(values.begin(), number); };
    boost::boykov_kolmogorov_max_flow(network, map(capacity), map(residual), map(reverse), map(predecessor),
                                      map(color_), map(distance), number, first_, second_);
  }

  /// Which nodes are on the first side, and which on the second, in every cut that costs as little. After `run()`.
  bool is_on_first(std::size_t node) const { return color_[node] == boost::black_color; }
  bool is_on_second(std::size_t node) const { return color_[node] == boost::white_color; }

 private:
  void connect(std::size_t from, std::size_t to, double there, double back) {
    if (there + back == 0) return;
    ends_.push_back({from, to});
    capacities_.push_back({there, back});
  }

  std::size_t first_, second_;
  std::vector<std::array<std::size_t, 2>> ends_;
  std::vector<std::array<double, 2>> capacities_;  // there and back
  std::vector<boost::default_color_type> color_;
};

}  // namespace RW_segmentation::internal

#endif
