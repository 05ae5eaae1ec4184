// SPDX-License-Identifier: MIT

// The difference of engineering models: Eq. 7 and 8, smooth joints beside creases, and what odd meshes get.

#include "mesh_graph.h"
#include "meshes.h"

#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/Dihedral_difference.h>

#include <gtest/gtest.h>

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace test_curvature_difference {

namespace {

using namespace RW_segmentation;
using Eigen::Vector2d;
using Eigen::Vector3d;
using meshes::pi;
using meshes::Surface_mesh;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The values on the interior edges, in the order of the mesh.
template <class Mesh, class Map>
std::vector<double> interior_values(const Mesh& mesh, const Map& map) {
  const meshes::Mesh_graph<Mesh> graph(mesh);
  std::vector<double> values;
  for (const auto e : graph.edge_descriptors()) values.push_back(get(map, e));
  return values;
}

std::vector<double> differences(const meshes::Shape& shape, Ball_radius radius = Ball_radius::in_edge_lengths(3)) {
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  return interior_values(mesh, Curvature_difference(mesh, radius));
}

void expect_near(const std::vector<double>& values, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], expected[i], tolerance * (1 + expected[i])) << "edge " << i;
}

/// The curvatures k1 and k2 of each face of a `Surface_mesh`, as a map.
template <class K1, class K2>
auto curvature_map(const K1& k1, const K2& k2) {
  return boost::make_function_property_map<Surface_mesh::Face_index>([=](Surface_mesh::Face_index f) {
    Surface_curvatures c;
    c.max_curvature = k1(f.idx());
    c.min_curvature = k2(f.idx());
    return c;
  });
}

// ---- A pin: below a plane with a crease round it or a hemisphere, a cylinder, above a hemisphere ----

constexpr std::size_t around = 80;
const double step = 2 * pi / static_cast<double>(around);
constexpr double joint_height = 2;

meshes::Shape pin(bool with_crease) {
  std::vector<Vector2d> curve;
  const std::size_t quarter = around / 4;
  for (std::size_t i = 0; i <= quarter; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(quarter), angle = t * pi / 2;
    if (with_crease)
      curve.emplace_back(t, 0);
    else
      curve.emplace_back(i == 0 ? 0 : std::sin(angle), -std::cos(angle));
  }
  const auto rows = static_cast<std::size_t>(joint_height / step);
  for (std::size_t i = 1; i <= rows; ++i)
    curve.emplace_back(1, joint_height * static_cast<double>(i) / static_cast<double>(rows));
  for (std::size_t i = 1; i <= quarter; ++i) {
    const double angle = pi / 2 * static_cast<double>(i) / static_cast<double>(quarter);
    curve.emplace_back(i == quarter ? 0 : std::cos(angle), joint_height + std::sin(angle));
  }
  return meshes::revolve(curve, around);
}

/// Means of a map over the edges of the pin's joint, and over those well inside the cylinder and the upper hemisphere.
struct Pin_means {
  double joint = 0, cylinder = 0, hemisphere = 0;

  template <class Map>
  Pin_means(const Surface_mesh& mesh, const Map& map) {
    std::array<double, 3> sums{}, numbers{};
    for (const auto e : mesh.edges()) {
      const double a = mesh.point(mesh.vertex(e, 0)).z(), b = mesh.point(mesh.vertex(e, 1)).z();
      const double far = 6 * step, middle = (a + b) / 2 - joint_height;
      std::size_t place = 3;
      if (std::abs(middle) < 1e-9 && std::abs(a - b) < 1e-9) place = 0;
      if (middle < -far && middle > far - joint_height) place = 1;
      if (middle > far && middle < 0.7) place = 2;
      if (place == 3) continue;
      sums[place] += get(map, e);
      ++numbers[place];
    }
    joint = sums[0] / numbers[0];
    cylinder = sums[1] / numbers[1];
    hemisphere = sums[2] / numbers[2];
  }
};

/// |H - H'| on the edges, divided by the arithmetic mean.
auto by_arithmetic_mean(const Surface_mesh& mesh) {
  std::map<Surface_mesh::Face_index, Surface_curvatures> curvatures;
  integral_invariant_curvatures(mesh, boost::associative_property_map(curvatures));
  std::map<Surface_mesh::Edge_index, double> d;
  double sum = 0;
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e);
    d[e] =
        std::abs(curvatures[mesh.face(h)].mean_curvature() - curvatures[mesh.face(mesh.opposite(h))].mean_curvature());
    sum += d[e];
  }
  for (auto& [e, value] : d) value *= mesh.number_of_edges() / sum;
  return d;
}

TEST(Curvature_difference, SeesASmoothJoint) {
  const Surface_mesh mesh = meshes::surface_mesh(pin(false));
  const Pin_means means(mesh, Curvature_difference(mesh));
  EXPECT_GT(means.joint, 10 * means.hemisphere);
  EXPECT_GT(means.joint, 10);
  EXPECT_LT(means.cylinder, 2);
  // The dihedral difference does not.
  const Pin_means dihedral(mesh, Dihedral_difference(mesh, 1));
  EXPECT_LT(dihedral.joint, 2 * dihedral.hemisphere);
}

TEST(Curvature_difference, SeesASmoothJointBesideACrease) {
  const Surface_mesh mesh = meshes::surface_mesh(pin(true));
  const Pin_means means(mesh, Curvature_difference(mesh));
  EXPECT_GT(means.joint, 10);
  EXPECT_GT(means.joint, 10 * means.hemisphere);
  EXPECT_LT(means.hemisphere, 2);
  EXPECT_LT(means.cylinder, 2);
  // With arithmetic means it would hardly stand out.
  auto plain = by_arithmetic_mean(mesh);
  EXPECT_LT(Pin_means(mesh, boost::make_assoc_property_map(plain)).joint, 4);
}

// ---- Eq. 8 ----

TEST(Curvature_difference, IsTheLargestOfThreeTermsByTheirMeans) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::torus(2, 1, 12, 8), 0.05));
  const auto k1 = [](std::size_t f) { return std::cos(static_cast<double>(f * f)); };
  const auto k2 = [](std::size_t f) { return std::sin(static_cast<double>(3 * f)); };
  const auto values = interior_values(mesh, Curvature_difference(mesh, curvature_map(k1, k2)));

  std::vector<double> expected = interior_values(mesh, Dihedral_difference(mesh, 1));
  std::vector<double> d2, d3;
  double length = 0, sum2 = 0, sum3 = 0;
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e);
    const std::size_t i = mesh.face(h).idx(), j = mesh.face(mesh.opposite(h)).idx();
    d2.push_back(std::abs(k1(i) * k2(i) - k1(j) * k2(j)));
    d3.push_back(std::abs((k1(i) + k2(i)) / 2 - (k1(j) + k2(j)) / 2));
    const double l = std::sqrt(CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
    length += l;
    sum2 += l * std::sqrt(d2.back());
    sum3 += l * std::sqrt(d3.back());
  }
  for (std::size_t e = 0; e < expected.size(); ++e)
    expected[e] = std::max({expected[e], d2[e] / std::pow(sum2 / length, 2), d3[e] / std::pow(sum3 / length, 2)});
  expect_near(values, expected, 1e-9);
}

TEST(Curvature_difference, LeavesOutTermsThatVanish) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::torus(2, 1, 12, 8), 0.05));
  const auto one = [](std::size_t) { return 1.; };
  const auto zero = [](std::size_t) { return 0.; };
  const auto wavy = [](std::size_t f) { return std::cos(static_cast<double>(f * f)); };
  const auto dihedral = interior_values(mesh, Dihedral_difference(mesh, 1));
  expect_near(interior_values(mesh, Curvature_difference(mesh, curvature_map(one, one))), dihedral, 1e-12);
  const auto almost_one = [](std::size_t f) { return 1 + 1e-9 * std::cos(static_cast<double>(f * f)); };
  expect_near(interior_values(mesh, Curvature_difference(mesh, curvature_map(almost_one, one))), dihedral, 1e-12);
  // K is 0 everywhere, H is not.
  const auto values = interior_values(mesh, Curvature_difference(mesh, curvature_map(wavy, zero)));
  EXPECT_TRUE(std::all_of(values.begin(), values.end(), [](double d) { return std::isfinite(d); }));
  EXPECT_NE(values, dihedral);
}

TEST(Curvature_difference, TreatsConvexEdgesAsConcaveOnes) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::l_shape(3));
  const auto flat = [](std::size_t) { return 0.; };
  std::map<double, int> numbers;
  for (const double d : interior_values(mesh, Curvature_difference(mesh, curvature_map(flat, flat))))
    ++numbers[std::round(1e9 * d) / 1e9];
  EXPECT_EQ(numbers.size(), 2U);  // flat edges and those of right angles
}

TEST(Curvature_difference, OfAPlaneIsZero) {
  const meshes::Shape plane = meshes::transformed(meshes::plane(10), meshes::some_rotation());
  for (const meshes::Shape& shape : {plane, meshes::moved(plane, {1e8, -2e8, 1e8}), meshes::scaled(plane, 1e-150)})
    for (const double d : differences(shape)) EXPECT_EQ(d, 0);
}

TEST(Curvature_difference, DoesNotDependOnScaleOrRotation) {
  const meshes::Shape shape = meshes::with_noise(meshes::l_shape(3), 0.02);
  const auto expected = differences(shape);
  for (const double factor : {1e100, 1e-100, 123.4})
    expect_near(differences(meshes::scaled(shape, factor)), expected, 1e-6);
  expect_near(differences(meshes::transformed(shape, meshes::some_rotation())), expected, 1e-6);
}

template <class Holder>
class Curvature_difference_on : public testing::Test {};
TYPED_TEST_SUITE(Curvature_difference_on, meshes::Holders);

TYPED_TEST(Curvature_difference_on, EveryEdgeOfACubeIsAverage) {
  const TypeParam held(meshes::cube_of_quads());
  expect_near(interior_values(held.mesh, Curvature_difference(held.mesh)), std::vector<double>(12, 1), 1e-9);
}

TYPED_TEST(Curvature_difference_on, IsTheSameAndZeroOnBorders) {
  const meshes::Shape shape = meshes::with_noise(meshes::tube(3, 16, 8), 0.02);
  const TypeParam held(shape);
  const Curvature_difference difference(held.mesh, Ball_radius::absolute(0.8));
  auto values = interior_values(held.mesh, difference), expected = differences(shape, Ball_radius::absolute(0.8));
  std::sort(values.begin(), values.end());
  std::sort(expected.begin(), expected.end());
  expect_near(values, expected, 1e-8);
  for (const auto e : edges(held.mesh))
    if (CGAL::is_border(e, held.mesh)) {
      EXPECT_EQ(get(difference, e), 0);
    }
}

// ---- Odd input ----

TEST(Curvature_difference, FacesWithoutAreaDoNotDifferFromTheirNeighbours) {
  meshes::Shape shape;
  shape.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0.5}, {2, 1, 0.3}};
  shape.faces = {{0, 1, 3}, {1, 0, 2}, {2, 0, 4}, {1, 2, 4}, {1, 5, 3}};
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  const Curvature_difference difference(mesh);
  const meshes::Mesh_graph graph(mesh);
  for (Dual_graph::Index e = 0; e < graph.number_of_edges(); ++e) {
    const auto [f, g] = graph.faces_of(e);
    const double value = get(difference, graph.edge(e));
    EXPECT_TRUE(std::isfinite(value));
    if (f == 1 || g == 1) {
      EXPECT_EQ(value, 0);
    }
  }
}

TEST(Curvature_difference, OfAnEmptyMeshExists) {
  const Surface_mesh mesh;
  EXPECT_EQ(get(Curvature_difference(mesh), Surface_mesh::Edge_index(0)), 0);
}

TEST(Curvature_difference, RefusesARadiusThatIsNotPositive) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::cube());
  for (const double bad : {0., -1., nan})
    EXPECT_THROW(Curvature_difference(mesh, Ball_radius::absolute(bad)), std::invalid_argument);
}

TEST(Curvature_difference, NamesTheFaceWhoseGivenCurvatureIsNotFinite) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::cube());
  const auto k = [](std::size_t f) { return f == 7 ? nan : 1; };
  try {
    const Curvature_difference difference(mesh, curvature_map(k, k));
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("face 7 "), std::string::npos) << error.what();
  }
}

TEST(Curvature_difference, CanBeCancelled) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::sphere(3));
  const auto np = CGAL::parameters::callback(std::function<bool(double)>([](double) { return false; }));
  EXPECT_THROW(Curvature_difference(mesh, Ball_radius::in_edge_lengths(2), np), Cancelled);
}

TEST(Curvature_difference, IsAReadableMapThatCopiesShare) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::l_shape(2));
  using Map = Curvature_difference<Surface_mesh>;
  static_assert(std::is_same_v<boost::property_traits<Map>::key_type, Surface_mesh::Edge_index>);
  static_assert(std::is_same_v<boost::property_traits<Map>::value_type, double>);
  static_assert(std::is_convertible_v<boost::property_traits<Map>::category, boost::readable_property_map_tag>);
  Map copy = Map(mesh, Ball_radius::in_edge_lengths(1));
  const Map difference(mesh);
  copy = difference;
  EXPECT_EQ(interior_values(mesh, copy), interior_values(mesh, difference));
}

}  // namespace

}  // namespace test_curvature_difference
