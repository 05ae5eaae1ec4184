// SPDX-License-Identifier: MIT

// The dual graph as a graph: of pairs of faces, of a mesh, and as Boost.Graph sees it.

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Dual_mesh.h>

#include <boost/concept/assert.hpp>
#include <boost/graph/graph_concepts.hpp>

#include <gtest/gtest.h>
#include "meshes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace test_dual_graph {

using RW_segmentation::Dual_graph;
using RW_segmentation::Dual_mesh_of;
using Index = Dual_graph::Index;

namespace {

BOOST_CONCEPT_ASSERT((boost::VertexListGraphConcept<Dual_graph>));
BOOST_CONCEPT_ASSERT((boost::IncidenceGraphConcept<Dual_graph>));

using Edges = std::vector<std::array<Index, 2>>;

/// Faces 1 and 2 share two edges; face 4 has no neighbour.
const Edges edges = {{0, 1}, {1, 2}, {2, 1}, {3, 0}};

}  // namespace

TEST(Dual_graph, HasTheGivenEdgesOnBothSidesInTheirOrder) {
  const Dual_graph graph(5, edges);
  EXPECT_EQ(graph.number_of_faces(), 5U);
  EXPECT_EQ(graph.number_of_edges(), 4U);
  for (Index f = 0; f < 5; ++f) {
    std::vector<std::pair<Index, Index>> expected, found;
    for (Index e = 0; e < edges.size(); ++e)
      for (const std::size_t side : {0U, 1U})
        if (edges[e][side] == f) expected.emplace_back(edges[e][1 - side], e);
    for (const auto& neighbour : graph.neighbours(f)) found.emplace_back(neighbour.face, neighbour.edge);
    EXPECT_EQ(found, expected) << f;
    EXPECT_EQ(graph.neighbours(f).size(), expected.size());
  }
  for (Index e = 0; e < edges.size(); ++e) EXPECT_EQ(graph.faces_of(e), edges[e]);
}

TEST(Dual_graph, RefusesEdgesThatJoinNoTwoOfItsFaces) {
  for (const Edges& wrong : {Edges{{0, 3}}, Edges{{3, 0}}, Edges{{1, 1}}, Edges{{0, 1}, {1, 4000000000}}})
    EXPECT_THROW(Dual_graph(3, wrong), std::invalid_argument);
}

TEST(Dual_graph, HasArcsThatAreEqualOnlyIfTheyLeaveOneFaceOverOneEdge) {
  const Dual_graph graph(5, edges);
  std::vector<Dual_graph::Arc> arcs;
  const auto [first, last] = vertices(graph);
  EXPECT_EQ(std::distance(first, last), 5);
  EXPECT_EQ(num_vertices(graph), 5U);
  for (auto f = first; f != last; ++f) {
    const auto [begin, end] = out_edges(*f, graph);
    EXPECT_EQ(static_cast<std::size_t>(std::distance(begin, end)), out_degree(*f, graph));
    for (auto arc = begin; arc != end; ++arc) {
      EXPECT_EQ(source(*arc, graph), *f);
      const auto& ends = edges[(*arc).edge];
      EXPECT_EQ((std::set<Index>{*f, target(*arc, graph)}), (std::set<Index>{ends[0], ends[1]}));
      arcs.push_back(*arc);
    }
  }
  ASSERT_EQ(arcs.size(), 2 * edges.size());
  for (std::size_t i = 0; i < arcs.size(); ++i)
    for (std::size_t j = 0; j < arcs.size(); ++j) {
      EXPECT_EQ(arcs[i] == arcs[j], i == j);
      EXPECT_EQ(arcs[i] != arcs[j], i != j);
    }
}

TEST(Dual_graph, OfAMeshJoinsFacesThatShareAnEdge) {
  const auto mesh = meshes::surface_mesh(meshes::plane(3));
  const Dual_mesh_of dual(mesh);
  EXPECT_EQ(dual.graph().number_of_faces(), 18U);
  std::size_t interior = 0;
  for (const auto e : mesh.edges()) interior += !mesh.is_border(e);
  EXPECT_EQ(dual.graph().number_of_edges(), interior);
  for (Index e = 0; e < dual.graph().number_of_edges(); ++e) {
    const auto h = mesh.halfedge(dual.edge(e));
    EXPECT_EQ(dual.face(dual.graph().faces_of(e)[0]), mesh.face(h));
    EXPECT_EQ(dual.face(dual.graph().faces_of(e)[1]), mesh.face(mesh.opposite(h)));
  }
  EXPECT_EQ(dual.index(meshes::Surface_mesh::null_face()), dual.none);
}

TEST(Dual_graph, OfAMeshNumbersNeighboursCloseByWhateverTheOrderOfTheMesh) {
  const auto shape = meshes::together(meshes::torus(1, 0.3, 12, 8), meshes::moved(meshes::plane(3), {5, 0, 0}));
  const auto mesh = meshes::surface_mesh(meshes::with_faces_in_order(shape, meshes::random_order(shape.faces.size())));
  const Dual_mesh_of dual(mesh);
  const Dual_graph& graph = dual.graph();
  const auto length = [](Index f, Index g) { return std::max(f, g) - std::min(f, g); };
  std::set<meshes::Surface_mesh::Edge_index> edges_of_mesh;
  std::size_t sum_before = 0, sum = 0;
  for (Index e = 0; e < graph.number_of_edges(); ++e) {
    edges_of_mesh.insert(dual.edge(e));
    const auto [f, g] = graph.faces_of(e);
    sum += length(f, g);
    sum_before += length(dual.place(f), dual.place(g));
  }
  EXPECT_EQ(edges_of_mesh.size(), graph.number_of_edges());
  EXPECT_LT(sum, sum_before / 2);
  Index place = 0;
  for (const auto f : mesh.faces()) {
    EXPECT_EQ(dual.face(dual.index(f)), f);
    EXPECT_EQ(dual.place(dual.index(f)), place++);
  }
}

}  // namespace test_dual_graph
