// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_MINIMUM_CUT_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_MINIMUM_CUT_H

#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Parts nodes in two at the least cost: what each of them costs on its side, and what edges cost whose ends are on
/// different sides. By the maximum flow of Boykov and Kolmogorov (2004), Boost.Graph's.
class Minimum_cut {
 public:
  explicit Minimum_cut(std::size_t nodes) : first_(nodes), second_(nodes + 1) {}

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
    make_graph();
    boost::boykov_kolmogorov_max_flow(graph_, get(&Arc::capacity, graph_), get(&Arc::residual, graph_),
                                      get(&Arc::reverse, graph_), get(&Node::predecessor, graph_),
                                      get(&Node::color, graph_), get(&Node::distance, graph_),
                                      get(boost::vertex_index, graph_), first_, second_);
  }

  /// Which nodes are on the first side, and which on the second, in every cut that costs as little. After `run()`.
  bool is_on_first(std::size_t node) const { return graph_[node].color == boost::black_color; }
  bool is_on_second(std::size_t node) const { return graph_[node].color == boost::white_color; }

 private:
  using Descriptor = boost::graph_traits<boost::compressed_sparse_row_graph<boost::directedS>>::edge_descriptor;
  struct Arc {
    double capacity, residual;
    Descriptor reverse;
  };
  struct Node {
    Descriptor predecessor;
    boost::default_color_type color;
    long distance;
  };
  using Graph = boost::compressed_sparse_row_graph<boost::directedS, Node, Arc>;

  void connect(std::size_t from, std::size_t to, double there, double back) {
    if (there + back == 0) return;
    ends_.emplace_back(from, to);
    ends_.emplace_back(to, from);
    capacities_.push_back(there);
    capacities_.push_back(back);
  }

  /// The graph wants arcs in the order of the nodes that they begin at.
  void make_graph() {
    std::vector<std::size_t> order(ends_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return ends_[i].first < ends_[j].first; });
    std::vector<std::pair<std::size_t, std::size_t>> ends;
    for (const std::size_t arc : order) ends.push_back(ends_[arc]);
    graph_ = Graph(boost::edges_are_sorted, ends.begin(), ends.end(), second_ + 1);
    std::vector<Descriptor> descriptors(order.size());
    auto arc = order.begin();
    for (const Descriptor& descriptor : boost::make_iterator_range(edges(graph_))) descriptors[*arc++] = descriptor;
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
      const std::size_t reverse = i ^ 1;
      graph_[descriptors[i]] = {capacities_[i], 0, descriptors[reverse]};
    }
  }

  std::size_t first_, second_;
  std::vector<std::pair<std::size_t, std::size_t>> ends_;  // of arcs, each beside its reverse
  std::vector<double> capacities_;                         // of arcs
  Graph graph_;
};

}  // namespace RW_segmentation::internal

#endif
