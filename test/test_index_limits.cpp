// SPDX-License-Identifier: MIT

// Meshes with more faces, edges or vertices than 32 bits can number, as they say of themselves.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/internal/check_number.h>
#include <RW_segmentation/internal/solver/Elimination_plan.h>
#include <RW_segmentation/smooth_boundaries.h>

#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>
#include "boundaries.h"
#include "meshes.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace test_index_limits {

using meshes::Surface_mesh;

namespace {

/// A mesh that says that it has more of everything than it has.
struct Boasting_mesh : Surface_mesh {
  explicit Boasting_mesh(const Surface_mesh& mesh) : Surface_mesh(mesh) {}
  std::size_t more_faces = 0, more_edges = 0, more_vertices = 0;
};

std::size_t num_faces(const Boasting_mesh& mesh) { return mesh.number_of_faces() + mesh.more_faces; }
std::size_t num_edges(const Boasting_mesh& mesh) { return mesh.number_of_edges() + mesh.more_edges; }
std::size_t num_vertices(const Boasting_mesh& mesh) { return mesh.number_of_vertices() + mesh.more_vertices; }

}  // namespace

}  // namespace test_index_limits

namespace boost {

template <>
struct graph_traits<test_index_limits::Boasting_mesh> : graph_traits<meshes::Surface_mesh> {};
template <class Tag>
struct property_map<test_index_limits::Boasting_mesh, Tag> : property_map<meshes::Surface_mesh, Tag> {};

}  // namespace boost

namespace CGAL {

template <class Tag>
struct graph_has_property<test_index_limits::Boasting_mesh, Tag> : graph_has_property<meshes::Surface_mesh, Tag> {};

}  // namespace CGAL

namespace test_index_limits {

namespace {

/// The message of the std::length_error that the work must end with.
std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::length_error& error) {
    return error.what();
  }
  ADD_FAILURE() << "is not refused";
  return {};
}

struct Index_limits : testing::Test {
  Boasting_mesh mesh{meshes::surface_mesh(meshes::cube(2))};
  const std::size_t four_billion = std::size_t(1) << 32;
  std::vector<std::size_t> label = std::vector<std::size_t>(mesh.number_of_faces(), 7);

  auto labels() { return boost::make_iterator_property_map(label.begin(), get(CGAL::face_index, mesh)); }
  void expect_untouched() const { EXPECT_EQ(label, std::vector<std::size_t>(label.size(), 7)); }
};

}  // namespace

TEST_F(Index_limits, AllNumbersButTheLastAreNumbers) {
  for (const std::size_t number : {std::size_t(0), four_billion - 2})
    EXPECT_NO_THROW(RW_segmentation::internal::check_number(number, "faces")) << number;
  EXPECT_EQ(refusal([&] { RW_segmentation::internal::check_number(four_billion - 1, "faces"); }),
            "4294967295 faces are more than 32 bits can number");
}

TEST_F(Index_limits, AGraphOfTooManyFacesIsRefusedBeforeMemoryIsTaken) {
  EXPECT_EQ(refusal([&] { RW_segmentation::Dual_graph(four_billion, {}); }),
            "4294967296 faces are more than 32 bits can number");
}

TEST_F(Index_limits, AMeshOfTooManyFacesOrHalfedgesIsRefused) {
  const auto read = [&] { RW_segmentation::Dual_mesh_of<Boasting_mesh>{mesh}; };
  EXPECT_NO_THROW(read());
  mesh.more_edges = four_billion / 2;
  EXPECT_NE(refusal(read).find("halfedges are more than 32 bits can number"), std::string::npos);
  mesh.more_faces = four_billion;
  EXPECT_NE(refusal(read).find("faces are more than 32 bits can number"), std::string::npos);
}

TEST_F(Index_limits, BoundariesOfAMeshOfTooManyVerticesAreRefused) {
  mesh.more_vertices = four_billion;
  EXPECT_NE(refusal([&] {
              RW_segmentation::smooth_boundaries(mesh, labels());
            }).find("vertices are more than 32 bits can number"),
            std::string::npos);
  expect_untouched();
}

TEST_F(Index_limits, TheOrderingOfTheEliminationHasALimitOfItsOwn) {
  using Plan = RW_segmentation::internal::Elimination_plan;
  EXPECT_NO_THROW(Plan::check_size(260000000, 390000000));  // a closed triangle mesh
  EXPECT_EQ(refusal([] { Plan::check_size(270000000, 405000000); }),
            "Star_mesh_elimination: 270000000 faces are too many for the minimum degree ordering");
}

}  // namespace test_index_limits
