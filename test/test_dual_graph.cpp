// The dual graph as a graph: of pairs of faces, of a mesh, and as Boost.Graph sees it.

#include <RW_segmentation/Dual_graph.h>

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

using RW_segmentation::Dual_graph;
using RW_segmentation::Mesh_dual_graph;
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
  const Mesh_dual_graph<meshes::Surface_mesh> graph(mesh);
  EXPECT_EQ(graph.number_of_faces(), 18U);
  std::size_t interior = 0;
  for (const auto e : mesh.edges()) interior += !mesh.is_border(e);
  EXPECT_EQ(graph.number_of_edges(), interior);
  for (Index e = 0; e < graph.number_of_edges(); ++e) {
    const auto h = mesh.halfedge(graph.edge(e));
    EXPECT_EQ(graph.face(graph.faces_of(e)[0]), mesh.face(h));
    EXPECT_EQ(graph.face(graph.faces_of(e)[1]), mesh.face(mesh.opposite(h)));
  }
  EXPECT_EQ(graph.index(meshes::Surface_mesh::null_face()), (Mesh_dual_graph<meshes::Surface_mesh>::none));
}

TEST(Dual_graph, RenumberedAlongTheSurfaceHasTheSameEdgesAndNeighboursCloseBy) {
  const auto shape = meshes::together(meshes::torus(1, 0.3, 12, 8), meshes::moved(meshes::plane(3), {5, 0, 0}));
  const auto mesh = meshes::surface_mesh(meshes::with_faces_in_order(shape, meshes::random_order(shape.faces.size())));
  const Mesh_dual_graph<meshes::Surface_mesh> before(mesh);
  auto graph = before;
  const std::vector<Index> former = graph.renumber_along_surface();
  ASSERT_EQ(former.size(), before.number_of_edges());
  EXPECT_EQ(std::set<Index>(former.begin(), former.end()).size(), former.size());
  std::size_t sum_before = 0, sum = 0;
  const auto length = [](const std::array<Index, 2>& ends) {
    return std::max(ends[0], ends[1]) - std::min(ends[0], ends[1]);
  };
  for (Index e = 0; e < former.size(); ++e) {
    EXPECT_EQ(graph.edge(e), before.edge(former[e]));
    for (const std::size_t side : {0U, 1U})
      EXPECT_EQ(graph.face(graph.faces_of(e)[side]), before.face(before.faces_of(former[e])[side]));
    sum += length(graph.faces_of(e));
    sum_before += length(before.faces_of(e));
  }
  EXPECT_LT(sum, sum_before / 2);
  for (const auto f : mesh.faces()) EXPECT_EQ(graph.face(graph.index(f)), f);
}
