// SPDX-License-Identifier: MIT

// The plan of an elimination against the elimination itself, carried out on sets of neighbours.

#include <RW_segmentation/internal/solver/Elimination_plan.h>

#include <gtest/gtest.h>
#include "networks.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <random>
#include <set>
#include <vector>

namespace test_elimination_plan {

using RW_segmentation::Dual_graph;
using RW_segmentation::internal::Elimination_plan;
using Index = Dual_graph::Index;

namespace {

std::vector<Dual_graph> graphs() {
  std::mt19937 random(1);
  return {Dual_graph(0, {}),
          Dual_graph(1, {}),
          Dual_graph(5, {{0, 1}, {3, 4}, {4, 3}}),
          networks::triangulated_torus(4),
          networks::triangulated_torus(25),
          networks::random_graph(60, random),
          networks::random_graph(300, random)};
}

/// For each position the later ones that it is connected to when its turn comes.
std::vector<std::set<Index>> structure_of(const Elimination_plan& plan, const Dual_graph& graph) {
  std::vector<std::set<Index>> later(graph.number_of_faces());
  for (Index e = 0; e < graph.number_of_edges(); ++e) {
    const auto [f, g] = graph.faces_of(e);
    later[std::min(plan.position[f], plan.position[g])].insert(std::max(plan.position[f], plan.position[g]));
  }
  for (const std::set<Index>& met : later)  // which a pivot joins to each other
    for (auto i = met.begin(); i != met.end(); ++i) later[*i].insert(std::next(i), met.end());
  return later;
}

}  // namespace

TEST(EliminationPlan, NumbersAllFaces) {
  for (const Dual_graph& graph : graphs()) {
    const Elimination_plan plan(graph);
    ASSERT_EQ(plan.position.size(), graph.number_of_faces());
    ASSERT_EQ(plan.face.size(), graph.number_of_faces());
    for (Index f = 0; f < graph.number_of_faces(); ++f) EXPECT_EQ(plan.face[plan.position[f]], f);
  }
}

TEST(EliminationPlan, KnowsWhatEachGroupMeetsAndStoresFewZeros) {
  for (const Dual_graph& graph : graphs()) {
    const Elimination_plan plan(graph);
    const auto later = structure_of(plan, graph);
    std::size_t entries = 0, factor_size = 0, largest_front = 0, largest_panel = 0, largest_row_count = 0;
    for (const auto& met : later) entries += met.size();
    Index begin = 0;
    for (std::size_t s = 0; s < plan.supernodes.size(); ++s) {
      const Elimination_plan::Supernode& supernode = plan.supernodes[s];
      EXPECT_EQ(supernode.begin, begin);
      begin = supernode.end;
      std::set<Index> rows;
      for (Index k = supernode.begin; k < supernode.end; ++k) {
        EXPECT_EQ(plan.supernode_of[k], s);
        rows.insert(later[k].lower_bound(supernode.end), later[k].end());
      }
      const auto first_row = plan.rows.begin() + static_cast<std::ptrdiff_t>(supernode.rows_begin);
      EXPECT_EQ(std::vector<Index>(first_row, first_row + supernode.row_count),
                std::vector<Index>(rows.begin(), rows.end()));
      EXPECT_EQ(supernode.parent, rows.empty() ? Elimination_plan::none : plan.supernode_of[*rows.begin()]);
      EXPECT_EQ(supernode.factor_begin, factor_size);
      const std::size_t columns = supernode.end - supernode.begin;
      factor_size += columns * (columns - 1) / 2 + columns * rows.size();
      largest_front = std::max(largest_front, columns + rows.size());
      largest_panel = std::max(largest_panel, columns * (columns + rows.size()));
      largest_row_count = std::max(largest_row_count, rows.size());
    }
    EXPECT_EQ(begin, graph.number_of_faces());
    EXPECT_EQ(plan.factor_size, factor_size);
    EXPECT_EQ(plan.largest_front, largest_front);
    EXPECT_EQ(plan.largest_panel, largest_panel);
    EXPECT_EQ(plan.largest_row_count, largest_row_count);
    EXPECT_LE(factor_size, 2 * entries);
  }
}

TEST(EliminationPlan, PutsSubtreesInRangesAndKeepsRoomForWhatTheyLeave) {
  for (const Dual_graph& graph : graphs()) {
    const Elimination_plan plan(graph);
    std::vector<Index> children(plan.supernodes.size(), 0), first(plan.supernodes.size());
    for (Index s = 0; s < plan.supernodes.size(); ++s) {
      first[s] = s;
      for (Index c = 0; c < s; ++c)
        if (plan.supernodes[c].parent == s) {
          ++children[s];
          first[s] = std::min(first[s], first[c]);
        }
      EXPECT_EQ(plan.supernodes[s].children, children[s]);
      EXPECT_TRUE(children[s] == 0 || plan.supernodes[s - 1].parent == s) << "the last child is right before it";
    }
    std::vector<int> holders(plan.supernodes.size(), 0);
    for (const Index s : plan.top) ++holders[s];
    for (const auto& subtree : plan.subtrees) {
      EXPECT_EQ(subtree.first, first[subtree.root]);
      std::vector<Index> waiting;
      for (Index s = subtree.first; s <= subtree.root; ++s) {
        ++holders[s];
        waiting.erase(std::remove_if(waiting.begin(), waiting.end(),
                                     [&](Index child) { return plan.supernodes[child].parent == s; }),
                      waiting.end());
        waiting.push_back(s);
        std::size_t left = 0;
        for (const Index child : waiting) left += plan.supernodes[child].left_size();
        EXPECT_LE(left, plan.stack_size);
      }
      EXPECT_EQ(waiting, std::vector<Index>{subtree.root});
    }
    EXPECT_EQ(holders, std::vector<int>(holders.size(), 1));
  }
}

}  // namespace test_elimination_plan
