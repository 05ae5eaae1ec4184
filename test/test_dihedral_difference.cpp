// SPDX-License-Identifier: MIT

// The dihedral difference: closed forms, invariances, and what odd meshes get.

#include "mesh_graph.h"
#include "meshes.h"

#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_graph.h>

#include <gtest/gtest.h>

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <boost/property_map/function_property_map.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace test_dihedral_difference {

namespace {

using meshes::Mesh_graph;
using RW_segmentation::Dihedral_difference;
using RW_segmentation::Dihedral_measure;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<Dihedral_measure, 2> measures = {Dihedral_measure::one_minus_cosine, Dihedral_measure::angle};

/// The values on the interior edges, in the order of the mesh.
template <class Mesh, class Map>
std::vector<double> interior_values(const Mesh& mesh, const Map& map) {
  const Mesh_graph<Mesh> graph(mesh);
  std::vector<double> values;
  for (const auto e : graph.edge_descriptors()) values.push_back(get(map, e));
  return values;
}

std::vector<double> differences(const meshes::Shape& shape, double convex_weight = 0.2,
                                Dihedral_measure measure = Dihedral_measure::one_minus_cosine) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape);
  return interior_values(mesh, Dihedral_difference(mesh, convex_weight, measure));
}

void expect_near(const std::vector<double>& values, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], tolerance) << "edge " << i;
}

/// A strip along the y-axis that turns down by each of these angles (up by negative ones), a unit length apart.
meshes::Shape strip(const std::vector<double>& turns) {
  const std::size_t n = turns.size() + 1;
  meshes::Shape shape;
  Eigen::Vector3d p(0, 0, 0);
  double slope = 0.3;
  for (std::size_t i = 0; i <= n; ++i) {
    shape.points.push_back(p);
    shape.points.push_back(p + Eigen::Vector3d(0, 2, 0));
    if (i < turns.size() + 1 && i > 0) slope -= turns[i - 1];
    p += Eigen::Vector3d(std::cos(slope), 0, std::sin(slope));
  }
  for (std::size_t i = 0; i < n; ++i) shape.faces.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  return shape;
}

/// Coordinates rounded to multiples of 1/1024, so that adding an integer below 2^40 is exact.
meshes::Shape dyadic(meshes::Shape shape) {
  for (Eigen::Vector3d& p : shape.points)
    for (double& x : p) x = std::round(1024 * x) / 1024;
  return shape;
}

/// Two triangles over an edge, with a face of three collinear corners between them.
meshes::Shape with_face_without_area() {
  meshes::Shape shape;
  shape.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0.5}, {2, 1, 0.3}};
  shape.faces = {{0, 1, 3}, {1, 0, 2}, {2, 0, 4}, {1, 2, 4}, {1, 5, 3}};
  return shape;
}

template <class Holder>
class Dihedral_difference_on : public testing::Test {};
TYPED_TEST_SUITE(Dihedral_difference_on, meshes::Holders);

TYPED_TEST(Dihedral_difference_on, EveryEdgeOfACubeIsAverage) {
  const TypeParam held(meshes::cube_of_quads());
  for (const Dihedral_measure measure : measures)
    expect_near(interior_values(held.mesh, Dihedral_difference(held.mesh, 0.2, measure)), std::vector<double>(12, 1),
                1e-12);
}

TYPED_TEST(Dihedral_difference_on, FlatEdgesOfATriangulatedCubeHaveNone) {
  const TypeParam held(meshes::cube(2));
  const auto values = interior_values(held.mesh, Dihedral_difference(held.mesh));
  std::multiset<double> rounded;
  for (const double value : values) rounded.insert(std::round(1e9 * value) / 1e9);
  EXPECT_EQ(rounded.count(0), 48U);  // 4 diagonals and 4 sides a face
  EXPECT_EQ(rounded.count(3), 24U);
  EXPECT_EQ(values.size(), 72U);
}

TYPED_TEST(Dihedral_difference_on, FollowsTheAnglesOfFolds) {
  const std::vector<double> turns = {0.5, -0.3, 1.7, -1.1};
  const double weight = 0.2;
  const TypeParam held(strip(turns));
  for (const Dihedral_measure measure : measures) {
    std::vector<double> expected;
    for (const double turn : turns)
      expected.push_back((turn < 0 ? 1 : weight) *
                         (measure == Dihedral_measure::angle ? 2 * std::sin(std::abs(turn) / 2) : 1 - std::cos(turn)));
    const double mean = std::accumulate(expected.begin(), expected.end(), 0.) / 4;
    for (double& d : expected) d /= mean;

    std::multiset<double> values;
    const Dihedral_difference difference(held.mesh, weight, measure);
    for (const double value : interior_values(held.mesh, difference)) values.insert(value);
    const std::multiset<double> sorted(expected.begin(), expected.end());
    expect_near({values.begin(), values.end()}, {sorted.begin(), sorted.end()}, 1e-12);
  }
}

TYPED_TEST(Dihedral_difference_on, AConcaveEdgeExceedsAConvexOneByTheWeight) {
  const TypeParam held(meshes::l_shape(2));
  std::set<double> values;
  for (const double value : interior_values(held.mesh, Dihedral_difference(held.mesh, 0.25)))
    if (value > 1e-9) values.insert(std::round(1e9 * value) / 1e9);
  ASSERT_EQ(values.size(), 2U);
  EXPECT_NEAR(*values.rbegin() / *values.begin(), 4, 1e-6);
}

TYPED_TEST(Dihedral_difference_on, IsOneOnAverageAndZeroOnBorders) {
  const TypeParam held(meshes::with_noise(meshes::tube(3, 16, 8), 0.02));
  const Dihedral_difference difference(held.mesh);
  const auto values = interior_values(held.mesh, difference);
  EXPECT_NEAR(std::accumulate(values.begin(), values.end(), 0.), static_cast<double>(values.size()), 1e-9);
  std::size_t borders = 0;
  for (const auto e : edges(held.mesh))
    if (CGAL::is_border(e, held.mesh)) {
      EXPECT_EQ(get(difference, e), 0);
      ++borders;
    }
  EXPECT_EQ(borders, 32U);
}

TYPED_TEST(Dihedral_difference_on, NamesTheVertexThatIsNotFinite) {
  for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
    meshes::Shape shape = meshes::plane(2);
    shape.points[5].y() = bad;
    const TypeParam held(shape);
    try {
      const Dihedral_difference difference(held.mesh);
      FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("vertex 5 "), std::string::npos) << error.what();
    }
  }
}

TYPED_TEST(Dihedral_difference_on, TakesNormalsFromAnyFaceMap) {
  const TypeParam held(meshes::with_noise(meshes::torus(2, 0.7, 16, 8), 0.02));
  using Mesh = typename TypeParam::Mesh;
  using face_descriptor = typename boost::graph_traits<Mesh>::face_descriptor;
  const RW_segmentation::Dual_mesh_of dual(held.mesh);
  std::map<face_descriptor, Eigen::Vector3d> normals;
  std::size_t i = 0;
  for (const face_descriptor f : faces(held.mesh)) {
    normals[f] = (1 + static_cast<double>(i % 7)) * dual.normal(dual.index(f));  // of any length
    ++i;
  }
  const Dihedral_difference own(held.mesh, 0.2, Dihedral_measure::angle);
  const Dihedral_difference given(held.mesh, boost::make_assoc_property_map(normals), 0.2, Dihedral_measure::angle);
  expect_near(interior_values(held.mesh, given), interior_values(held.mesh, own), 1e-12);
}

TEST(Dihedral_difference, DoesNotDependOnScale) {
  const meshes::Shape shape = meshes::with_noise(meshes::l_shape(3), 0.05);
  for (const Dihedral_measure measure : measures) {
    const auto expected = differences(shape, 0.2, measure);
    for (const double factor : {1e150, 3e-160, 1e300, 12345.678, 1e-5})
      expect_near(differences(meshes::scaled(shape, factor), 0.2, measure), expected, 1e-9);
  }
}

TEST(Dihedral_difference, DoesNotDependOnRotation) {
  const meshes::Shape shape = meshes::with_noise(meshes::l_shape(3), 0.05);
  expect_near(differences(meshes::transformed(shape, meshes::some_rotation())), differences(shape), 1e-9);
}

TEST(Dihedral_difference, DoesNotDependOnPlace) {
  const meshes::Shape shape = dyadic(meshes::torus(2, 0.7, 20, 12));
  expect_near(differences(meshes::moved(shape, {1e8, -3e8, 2e9})), differences(shape), 1e-9);
}

TEST(Dihedral_difference, DoesNotDependOnTheOrderOfFaces) {
  const meshes::Shape shape = meshes::with_noise(meshes::sphere(2), 0.05);
  const auto by_ends = [](const meshes::Shape& s) {
    const meshes::Surface_mesh mesh = meshes::surface_mesh(s);
    const Dihedral_difference difference(mesh);
    std::map<std::set<std::size_t>, double> values;
    for (const auto e : mesh.edges()) values[{mesh.vertex(e, 0).idx(), mesh.vertex(e, 1).idx()}] = get(difference, e);
    return values;
  };
  const auto expected = by_ends(shape);
  const auto order = meshes::random_order(shape.faces.size());
  for (const auto& [ends, value] : by_ends(meshes::with_faces_in_order(shape, order)))
    EXPECT_NEAR(value, expected.at(ends), 1e-12);
}

TEST(Dihedral_difference, OfAPlaneIsZeroHoweverItLies) {
  const meshes::Shape plane = meshes::plane(10);
  const meshes::Shape rotated = meshes::transformed(plane, meshes::some_rotation());
  const std::vector<double> zero(differences(plane).size(), 0);
  for (const Dihedral_measure measure : measures)
    for (const double weight : {0., 0.2, 1.})
      for (const meshes::Shape& shape :
           {plane, rotated, meshes::scaled(rotated, 1e150), meshes::scaled(rotated, 1e-160),
            meshes::moved(rotated, {1e8, 2e8, -1e8}), meshes::moved(plane, {1e8, 0, 0})})
        EXPECT_EQ(differences(shape, weight, measure), zero);
}

TEST(Dihedral_difference, OfAConvexShapeIsZeroIfConvexEdgesDoNotCount) {
  for (const Dihedral_measure measure : measures) {
    // The squares of the cube are rotated: their diagonals turn by rounding errors, either way.
    const auto values = differences(meshes::transformed(meshes::cube(4), meshes::some_rotation()), 0, measure);
    EXPECT_EQ(values, std::vector<double>(values.size(), 0));
  }
}

TEST(Dihedral_difference, FacesWithoutAreaDoNotDifferFromTheirNeighbours) {
  for (const bool rotate : {false, true}) {
    meshes::Shape shape = with_face_without_area();
    if (rotate) shape = meshes::transformed(shape, meshes::some_rotation());
    const meshes::Surface_mesh mesh = meshes::surface_mesh(shape);
    const Dihedral_difference difference(mesh);
    const Mesh_graph graph(mesh);
    ASSERT_EQ(graph.number_of_edges(), 5U);
    for (std::uint32_t e = 0; e < 5; ++e) {
      const auto [f, g] = graph.faces_of(e);
      const double value = get(difference, graph.edge(e));
      if (f == 1 || g == 1)
        EXPECT_EQ(value, 0);
      else if (f + g == 4)
        EXPECT_GT(value, 0);  // the fold between faces 0 and 4
      else
        EXPECT_NEAR(value, 0, 1e-9);
    }
  }
}

TEST(Dihedral_difference, OfAMeshWithoutAnyAreaIsZero) {
  meshes::Shape shape = meshes::plane(2);
  for (Eigen::Vector3d& p : shape.points) p = Eigen::Vector3d::Constant(7);
  for (const double value : differences(shape)) EXPECT_EQ(value, 0);
}

TEST(Dihedral_difference, OfFoldedFacesIsFinite) {
  const auto values = differences(strip({meshes::pi, meshes::pi / 2}), 1);
  expect_near(values, {4. / 3, 2. / 3}, 1e-9);
}

TEST(Dihedral_difference, SmallAnglesKeepTheirDigits) {
  // 1 - cos(1e-4) = 5e-9 would keep half of the digits if computed as it is written.
  const auto values = differences(strip({-1e-4, -2e-4}), 1);
  EXPECT_NEAR(values[1] / values[0], 4, 1e-6);
}

TEST(Dihedral_difference, IgnoresIsolatedVertices) {
  meshes::Surface_mesh mesh = meshes::surface_mesh(meshes::l_shape());
  const auto expected = interior_values(mesh, Dihedral_difference(mesh));
  mesh.add_vertex({1e30, 0, 0});
  mesh.add_vertex({nan, 0, 0});
  expect_near(interior_values(mesh, Dihedral_difference(mesh)), expected, 1e-12);
}

TEST(Dihedral_difference, OfAnEmptyMeshExists) {
  const meshes::Surface_mesh mesh;
  const Dihedral_difference difference(mesh);
  EXPECT_EQ(get(difference, meshes::Surface_mesh::Edge_index(0)), 0);
}

TEST(Dihedral_difference, RefusesAWeightOutsideZeroToOne) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(meshes::cube());
  for (const double weight : {-0.1, 1.5, nan}) EXPECT_THROW(Dihedral_difference(mesh, weight), std::invalid_argument);
}

TEST(Dihedral_difference, NamesTheFaceWhoseGivenNormalIsNotFinite) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(meshes::cube());
  const auto normals = boost::make_function_property_map<meshes::Surface_mesh::Face_index>(
      [](const auto f) { return Eigen::Vector3d(0, 0, f.idx() == 7 ? nan : 1); });
  try {
    const Dihedral_difference difference(mesh, normals);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("face 7 "), std::string::npos) << error.what();
  }
}

TEST(Dihedral_difference, AGivenZeroVectorMeansNoNormal) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(meshes::cube_of_quads());
  const auto normals = boost::make_function_property_map<meshes::Surface_mesh::Face_index>([](const auto f) {
    return Eigen::Vector3d(f.idx() == 0 ? 0 : std::cos(f.idx()), 0, f.idx() == 0 ? 0 : std::sin(f.idx()));
  });
  const Dihedral_difference difference(mesh, normals, 1);
  for (const auto e : mesh.edges()) {
    const bool beside = mesh.face(mesh.halfedge(e, 0)).idx() == 0 || mesh.face(mesh.halfedge(e, 1)).idx() == 0;
    EXPECT_EQ(get(difference, e) == 0, beside);
  }
}

TEST(Dihedral_difference, WorksWithExactNumbers) {
  using Point = CGAL::Simple_cartesian<CGAL::Gmpq>::Point_3;
  CGAL::Surface_mesh<Point> exact;
  meshes::append(meshes::l_shape(2), exact);
  expect_near(interior_values(exact, Dihedral_difference(exact)), differences(meshes::l_shape(2)), 1e-12);
}

TEST(Dihedral_difference, IsAReadableMapThatCopiesShare) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(meshes::l_shape());
  using Map = Dihedral_difference<meshes::Surface_mesh>;
  static_assert(std::is_same_v<boost::property_traits<Map>::key_type, meshes::Surface_mesh::Edge_index>);
  static_assert(std::is_same_v<boost::property_traits<Map>::value_type, double>);
  static_assert(std::is_convertible_v<boost::property_traits<Map>::category, boost::readable_property_map_tag>);
  Map copy = Map(mesh, 1);
  const Map difference(mesh);
  copy = difference;
  EXPECT_EQ(interior_values(mesh, copy), interior_values(mesh, difference));
}

}  // namespace

}  // namespace test_dihedral_difference
