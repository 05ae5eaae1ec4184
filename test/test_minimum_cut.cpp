// SPDX-License-Identifier: MIT

#include <RW_segmentation/internal/surfaces/Minimum_cut.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace test_minimum_cut {

using RW_segmentation::internal::Minimum_cut;

namespace {

/// Nodes, what they cost on either side, and edges among them.
struct Network {
  struct Node {
    double on_first, on_second;
  };
  struct Edge {
    std::size_t node, other;
    double cost;
  };
  std::vector<Node> nodes;
  std::vector<Edge> edges;

  /// \param second the nodes on the second side, as bits
  double cost(unsigned second) const {
    const auto is_on_second = [&](std::size_t node) { return (second >> node & 1u) != 0; };
    double sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) sum += is_on_second(i) ? nodes[i].on_second : nodes[i].on_first;
    for (const Edge& edge : edges) sum += is_on_second(edge.node) != is_on_second(edge.other) ? edge.cost : 0;
    return sum;
  }

  Minimum_cut cut() const {
    Minimum_cut cut(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) cut.set_costs(i, nodes[i].on_first, nodes[i].on_second);
    for (const Edge& edge : edges) cut.set_cost_between(edge.node, edge.other, edge.cost);
    cut.run();
    return cut;
  }
};

/// Costs are small whole numbers, so that many partitions cost the same, and sums are exact.
Network random_network(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](unsigned n) { return random() % n; };
  Network network;
  const std::size_t nodes = 1 + below(9);
  for (std::size_t i = 0; i < nodes; ++i) {
    network.nodes.push_back({static_cast<double>(below(8)), static_cast<double>(below(8))});
    for (std::size_t j = 0; j < i; ++j)
      if (below(3) > 0) network.edges.push_back({i, j, static_cast<double>(below(5))});
  }
  return network;
}

}  // namespace

TEST(MinimumCut, CostsTheLeastOfAllPartitions) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Network network = random_network(seed);
    const Minimum_cut cut = network.cut();
    unsigned not_first = 0, second = 0;
    for (std::size_t i = 0; i < network.nodes.size(); ++i) {
      if (!cut.is_on_first(i)) not_first |= 1u << i;
      if (cut.is_on_second(i)) second |= 1u << i;
    }
    double least = std::numeric_limits<double>::infinity();
    for (unsigned partition = 0; partition < 1u << network.nodes.size(); ++partition)
      least = std::min(least, network.cost(partition));
    EXPECT_EQ(network.cost(not_first), least);
    EXPECT_EQ(network.cost(second), least);
  }
}

TEST(MinimumCut, PutsANodeOnASideOnlyIfEveryCheapestPartitionDoes) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Network network = random_network(seed);
    const Minimum_cut cut = network.cut();
    double least = std::numeric_limits<double>::infinity();
    unsigned in_all = 0, in_any = 0;  // of the cheapest partitions: what is on the second side
    for (unsigned partition = 0; partition < 1u << network.nodes.size(); ++partition) {
      const double cost = network.cost(partition);
      if (cost > least) continue;
      in_all = cost < least ? partition : in_all & partition;
      in_any = cost < least ? partition : in_any | partition;
      least = cost;
    }
    for (std::size_t i = 0; i < network.nodes.size(); ++i) {
      EXPECT_TRUE(!cut.is_on_second(i) || (in_all >> i & 1u) != 0) << i;
      EXPECT_TRUE(!cut.is_on_first(i) || (in_any >> i & 1u) == 0) << i;
    }
  }
}

TEST(MinimumCut, LeavesNodesThatCostTheSameOnBothSidesOnNeither) {
  const Network network = {{{2, 2}, {1, 1}, {0, 3}}, {{0, 1, 1}}};
  const Minimum_cut cut = network.cut();
  EXPECT_FALSE(cut.is_on_first(0) || cut.is_on_second(0) || cut.is_on_first(1) || cut.is_on_second(1));
  EXPECT_TRUE(cut.is_on_first(2));
}

}  // namespace test_minimum_cut
