// SPDX-License-Identifier: MIT

// Conductances: the formula, its cap and floors, constraints, and what maps they accept.

#include "mesh_graph.h"
#include "meshes.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_graph.h>

#include <gtest/gtest.h>

#include <CGAL/boost/graph/helpers.h>

#include <boost/property_map/function_property_map.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace test_conductance {

namespace {

using meshes::Mesh_graph;
using RW_segmentation::Conductance;
using RW_segmentation::Dihedral_difference;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The interior edges of a mesh: their descriptors, lengths, and a difference for each, between 0 and 5.
template <class Mesh>
struct Edges {
  using edge_descriptor = typename boost::graph_traits<Mesh>::edge_descriptor;
  std::vector<edge_descriptor> edge;
  std::vector<double> length;
  std::map<edge_descriptor, double> difference;

  explicit Edges(const Mesh& mesh) {
    const Mesh_graph<Mesh> graph(mesh);
    edge = graph.edge_descriptors();
    const auto point = get(CGAL::vertex_point, mesh);
    for (const edge_descriptor e : edge) {
      const auto& p = get(point, source(e, mesh));
      const auto& q = get(point, target(e, mesh));
      length.push_back(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      difference[e] = 5 * static_cast<double>(difference.size() * 7 % 11) / 11;
    }
  }

  auto difference_map() const { return boost::make_assoc_property_map(difference); }

  template <class Map>
  std::vector<double> values(const Map& map) const {
    std::vector<double> result;
    for (const edge_descriptor e : edge) result.push_back(get(map, e));
    return result;
  }
};

/// Conductances are defined up to a common factor.
void expect_proportional(const std::vector<double>& values, const std::vector<double>& expected) {
  ASSERT_EQ(values.size(), expected.size());
  const double factor =
      std::accumulate(expected.begin(), expected.end(), 0.) / std::accumulate(values.begin(), values.end(), 0.);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(factor * values[i] / expected[i], 1, 1e-9) << "edge " << i;
}

template <class Function>
std::string message_of(const Function& function) {
  try {
    function();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

template <class Holder>
class Conductance_on : public testing::Test {};
TYPED_TEST_SUITE(Conductance_on, meshes::Holders);

TYPED_TEST(Conductance_on, IsTheLengthTimesTheExponentialOfTheDifference) {
  const TypeParam held(meshes::with_noise(meshes::tube(3, 8, 5), 0.1));
  const Edges interior(held.mesh);
  for (const double sigma : {0.5, 1., 2.}) {
    std::vector<double> expected;
    for (std::size_t i = 0; i < interior.edge.size(); ++i)
      expected.push_back(interior.length[i] * std::exp(-interior.difference.at(interior.edge[i]) / sigma));
    expect_proportional(interior.values(Conductance(held.mesh, interior.difference_map(), sigma)), expected);
  }
}

TYPED_TEST(Conductance_on, TakesAnyEdgeMap) {
  const TypeParam held(meshes::l_shape(2));
  using edge_descriptor = typename boost::graph_traits<typename TypeParam::Mesh>::edge_descriptor;
  const Edges interior(held.mesh);
  const Dihedral_difference difference(held.mesh);
  std::map<edge_descriptor, float> stored;
  for (const edge_descriptor e : interior.edge) stored[e] = static_cast<float>(get(difference, e));
  const auto computed =
      boost::make_function_property_map<edge_descriptor>([&](const edge_descriptor& e) { return stored.at(e); });

  const auto expected = interior.values(Conductance(held.mesh, difference));
  const auto of_stored = interior.values(Conductance(held.mesh, boost::make_assoc_property_map(stored)));
  const auto of_computed = interior.values(Conductance(held.mesh, computed));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(of_stored[i] / expected[i], 1, 1e-5);
    EXPECT_EQ(of_computed[i], of_stored[i]);
  }
}

TYPED_TEST(Conductance_on, IsZeroExactlyOnConstrainedAndBorderEdges) {
  const TypeParam held(meshes::plane(4));
  using edge_descriptor = typename boost::graph_traits<typename TypeParam::Mesh>::edge_descriptor;
  const Edges interior(held.mesh);
  std::map<edge_descriptor, bool> constrained;
  for (const edge_descriptor e : interior.edge) constrained[e] = constrained.size() % 3 == 0;
  const Conductance conductance(held.mesh, interior.difference_map(), 1, 20,
                                CGAL::parameters::edge_is_constrained_map(boost::make_assoc_property_map(constrained)));
  const Conductance without(held.mesh, interior.difference_map());
  for (const edge_descriptor e : interior.edge) EXPECT_EQ(get(conductance, e), constrained[e] ? 0 : get(without, e));
  for (const edge_descriptor e : edges(held.mesh))
    if (CGAL::is_border(e, held.mesh)) {
      EXPECT_EQ(get(conductance, e), 0);
    }
}

TYPED_TEST(Conductance_on, NamesTheFacesOfAnEdgeWithAnImpossibleDifference) {
  const TypeParam held(meshes::cube_of_quads());
  for (const double bad : {-1., -1e-300, nan}) {
    Edges interior(held.mesh);
    interior.difference[interior.edge[4]] = bad;
    const auto sides = Mesh_graph<typename TypeParam::Mesh>(held.mesh).faces_of(4);
    const auto [f, g] = std::minmax({sides[0], sides[1]});
    const std::string message = message_of([&] { Conductance(held.mesh, interior.difference_map()); });
    EXPECT_NE(message.find("faces " + std::to_string(f) + " and " + std::to_string(g)), std::string::npos) << message;
  }
}

class Conductance_of_a_sphere : public testing::Test {
 protected:
  const meshes::Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::sphere(1), 0.02));
  const Edges<meshes::Surface_mesh> interior{mesh};

  /// The conductances divided by the edges' lengths, on average 1 for differences of 0.
  template <class... Numbers>
  std::vector<double> factors(double difference, Numbers... numbers) const {
    const auto constant =
        boost::make_function_property_map<meshes::Surface_mesh::Edge_index>([=](const auto&) { return difference; });
    const auto zero =
        boost::make_function_property_map<meshes::Surface_mesh::Edge_index>([](const auto&) { return 0.; });
    std::vector<double> result = interior.values(Conductance(mesh, constant, numbers...));
    const std::vector<double> lengths = interior.values(Conductance(mesh, zero));
    for (std::size_t i = 0; i < result.size(); ++i) result[i] /= lengths[i];
    return result;
  }
};

TEST_F(Conductance_of_a_sphere, IsCapped) {
  for (const double value : factors(1000)) EXPECT_NEAR(value / std::exp(-20.), 1, 1e-12);
  for (const double value : factors(1000, 2., 7.)) EXPECT_NEAR(value / std::exp(-7.), 1, 1e-12);
  for (const double value : factors(12, 2., 7.)) EXPECT_NEAR(value / std::exp(-6.), 1, 1e-12);
  for (const double value : factors(1000, 5., infinity)) EXPECT_NEAR(value / std::exp(-200.), 1, 1e-12);
}

TEST_F(Conductance_of_a_sphere, NeverUnderflows) {
  for (const double difference : {1e4, 1e300, infinity})
    for (const double value : factors(difference, 1e-5, infinity)) EXPECT_NEAR(value / std::exp(-600.), 1, 1e-9);
}

TEST_F(Conductance_of_a_sphere, RefusesImpossibleNumbers) {
  for (const double sigma : {0., -1., nan, infinity})
    EXPECT_NE(message_of([&] { Conductance(mesh, interior.difference_map(), sigma); }).find("sigma"),
              std::string::npos);
  for (const double cap : {0., -1., nan})
    EXPECT_NE(message_of([&] { Conductance(mesh, interior.difference_map(), 1, cap); }).find("cap"), std::string::npos);
  EXPECT_EQ(message_of([&] { Conductance(mesh, interior.difference_map(), 1, infinity); }), "no error");
}

TEST_F(Conductance_of_a_sphere, AsksForEachInteriorEdgeOnce) {
  std::map<std::uint32_t, int> calls;
  const auto counting = boost::make_function_property_map<meshes::Surface_mesh::Edge_index>([&](const auto e) {
    ++calls[e.idx()];
    return 1.;
  });
  const Conductance conductance(mesh, counting);
  EXPECT_EQ(calls.size(), mesh.number_of_edges());
  for (const auto& [edge, number] : calls) EXPECT_EQ(number, 1) << "edge " << edge;
}

TEST(Conductance, OnlyRatiosDependOnTheMeshNotItsScale) {
  const meshes::Shape shape = meshes::with_noise(meshes::sphere(1), 0.02);
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape);
  const Edges interior(mesh);
  const auto expected = interior.values(Conductance(mesh, interior.difference_map()));
  for (const double factor : {1e150, 1e-160, 1e300, 77.7}) {
    const meshes::Surface_mesh scaled = meshes::surface_mesh(meshes::scaled(shape, factor));
    expect_proportional(interior.values(Conductance(scaled, interior.difference_map())), expected);
  }
}

TEST(Conductance, OfAnEdgeWithoutLengthHasAFloor) {
  // The two faces over the edge from vertex 4 to a copy of it at the same place hold together.
  meshes::Shape shape = meshes::plane(2);
  shape.points[5] = shape.points[4];
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape);
  const Edges interior(mesh);
  const double mean =
      std::accumulate(interior.length.begin(), interior.length.end(), 0.) / static_cast<double>(interior.length.size());
  std::vector<double> expected;
  std::size_t without_length = 0;
  for (std::size_t i = 0; i < interior.edge.size(); ++i) {
    without_length += interior.length[i] == 0;
    expected.push_back(std::max(interior.length[i], 1e-6 * mean) * std::exp(-interior.difference.at(interior.edge[i])));
  }
  EXPECT_EQ(without_length, 1U);
  expect_proportional(interior.values(Conductance(mesh, interior.difference_map())), expected);
}

TEST(Conductance, OfAMeshWithoutAnyLengthIsPositive) {
  meshes::Shape shape = meshes::plane(2);
  for (Eigen::Vector3d& p : shape.points) p.setConstant(3);
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape);
  const Edges interior(mesh);
  std::vector<double> expected;
  for (const auto e : interior.edge) expected.push_back(std::exp(-interior.difference.at(e)));
  expect_proportional(interior.values(Conductance(mesh, interior.difference_map())), expected);
}

TEST(Conductance, OfAPlaneIsTheLength) {
  const meshes::Surface_mesh mesh =
      meshes::surface_mesh(meshes::transformed(meshes::plane(5), meshes::some_rotation()));
  const Edges interior(mesh);
  expect_proportional(interior.values(Conductance(mesh, Dihedral_difference(mesh))), interior.length);
}

TEST(Conductance, NamesTheVertexThatIsNotFinite) {
  meshes::Surface_mesh mesh = meshes::surface_mesh(meshes::cube());
  const Dihedral_difference difference(mesh);
  mesh.point(meshes::Surface_mesh::Vertex_index(3)) = {0, nan, 0};
  EXPECT_NE(message_of([&] { Conductance(mesh, difference); }).find("vertex 3 "), std::string::npos);
}

TEST(Conductance, ReadsTheGivenPoints) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(meshes::sphere(1));
  const auto stretched = boost::make_function_property_map<meshes::Surface_mesh::Vertex_index>([&](const auto v) {
    const auto& p = mesh.point(v);
    return meshes::Kernel::Point_3(3 * p.x(), p.y(), p.z());
  });
  const meshes::Surface_mesh expected =
      meshes::surface_mesh(meshes::transformed(meshes::sphere(1), Eigen::Affine3d(Eigen::Scaling(3., 1., 1.))));
  const Edges interior(expected);
  expect_proportional(interior.values(Conductance(mesh, interior.difference_map(), 1, 20,
                                                  CGAL::parameters::vertex_point_map(stretched))),
                      interior.values(Conductance(expected, interior.difference_map())));
}

}  // namespace

}  // namespace test_conductance
