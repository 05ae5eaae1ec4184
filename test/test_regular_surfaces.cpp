// SPDX-License-Identifier: MIT

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/regular_surfaces.h>
#include <RW_segmentation/segment_surfaces.h>

#include <boost/property_map/property_map.hpp>

#include <gtest/gtest.h>
#include "meshes.h"
#include "solids.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace test_regular_surfaces {

using namespace RW_segmentation;
using Eigen::Vector3d;
using Surfaces = std::vector<Analytic_surface>;

namespace {

Analytic_surface plane(const Vector3d& point, const Vector3d& normal) {
  Analytic_surface surface;
  surface.type = Surface_type::plane;
  surface.point = point;
  surface.direction = normal.normalized();
  return surface;
}

Analytic_surface cylinder(const Vector3d& point, const Vector3d& axis, double radius) {
  Analytic_surface surface = plane(point, axis);
  surface.type = Surface_type::cylinder;
  surface.radius = radius;
  return surface;
}

/// The surfaces of a solid's own segments, of whose noise they are told: they need not estimate it.
Surfaces surfaces_of(const solids::Solid& solid, double noise_percent = 0) {
  const auto mesh = meshes::surface_mesh({solid.points, solid.faces});
  const auto ids = boost::make_iterator_property_map(solid.label.begin(), get(boost::face_index, mesh));
  return segment_surfaces(mesh, ids, solid.surfaces.size(), noise_percent / 100);
}

std::size_t number_of(const Regular_surfaces& regular, Regularity regularity) {
  return static_cast<std::size_t>(
      std::count_if(regular.snaps.begin(), regular.snaps.end(),
                    [&](const Surface_snap& snap) { return snap.regularity == regularity; }));
}

void expect_same(const Surfaces& a, const Surfaces& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t s = 0; s < a.size(); ++s) {
    SCOPED_TRACE(s);
    EXPECT_EQ(a[s].type, b[s].type);
    EXPECT_NEAR((a[s].point - b[s].point).norm(), 0, tolerance);
    EXPECT_NEAR((a[s].direction - b[s].direction).norm(), 0, tolerance);
    EXPECT_NEAR(a[s].radius, b[s].radius, tolerance);
    EXPECT_NEAR(a[s].tube_radius, b[s].tube_radius, tolerance);
    EXPECT_NEAR(a[s].half_angle, b[s].half_angle, tolerance);
  }
}

/// All solids, clean and displaced.
std::vector<Surfaces> parts() {
  std::vector<Surfaces> parts;
  for (const solids::Solid& solid : solids::all(solids::even(0.2)))
    for (const double noise : {0., 0.02}) parts.push_back(surfaces_of(solids::with_noise(solid, noise), noise));
  return parts;
}

constexpr double exact = 1e-9;
const Regularity_tolerance given = {1e-3, 1e-3, 0};

}  // namespace

TEST(RegularSurfaces, OfExactMeshesHaveTheNumbersOfTheDesign) {
  for (const auto& meshing : {solids::even(0.2), solids::by_kernel()})
    for (const solids::Solid& solid : solids::all(meshing)) {
      SCOPED_TRACE(solid.name);
      const Surfaces regular = regular_surfaces(surfaces_of(solid), {1e-7, 1e-7, 3}).surfaces;
      for (std::size_t s = 0; s < regular.size(); ++s) {
        const solids::Surface& design = solid.surfaces[s];
        EXPECT_NEAR(regular[s].radius, design.radius, exact);
        EXPECT_NEAR(regular[s].tube_radius, design.tube_radius, exact);
        EXPECT_NEAR(regular[s].half_angle, design.half_angle, exact);
        if (design.type == solids::Type::sphere) continue;
        EXPECT_NEAR(regular[s].direction.cross(design.direction).norm(), 0, exact);
      }
    }
}

TEST(RegularSurfaces, DoNotChangeTwice) {
  for (const Surfaces& part : parts())
    for (const Regularity_tolerance& tolerance : {Regularity_tolerance(), given}) {
      const Surfaces once = regular_surfaces(part, tolerance).surfaces;
      expect_same(regular_surfaces(once, tolerance).surfaces, once, 1e-12);
    }
}

TEST(RegularSurfaces, DoNotDependOnTheOrder) {
  for (const Surfaces& part : parts())
    for (const Regularity_tolerance& tolerance : {Regularity_tolerance(), given}) {
      const Regular_surfaces regular = regular_surfaces(part, tolerance);
      std::vector<std::size_t> order(part.size());
      std::iota(order.begin(), order.end(), std::size_t(0));
      std::shuffle(order.begin(), order.end(), std::mt19937(1));
      Surfaces shuffled, expected;
      for (const std::size_t s : order) {
        shuffled.push_back(part[s]);
        expected.push_back(regular.surfaces[s]);
      }
      const Regular_surfaces of_shuffled = regular_surfaces(shuffled, tolerance);
      expect_same(of_shuffled.surfaces, expected, 1e-12);
      EXPECT_EQ(of_shuffled.snaps.size(), regular.snaps.size());
    }
}

TEST(RegularSurfaces, NumbersMoveByNoMoreThanTheTolerance) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0, 0.02);  // so dense that many differ by less than the tolerance
  for (int trial = 0; trial < 20; ++trial) {
    Surfaces surfaces;
    for (int s = 0; s < 40; ++s)
      surfaces.push_back(
          cylinder({number(random), number(random), 0}, {number(random), number(random), 1}, 1 + number(random)));
    const Regular_surfaces regular = regular_surfaces(surfaces, given);
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      EXPECT_LE(std::abs(regular.surfaces[s].radius - surfaces[s].radius), given.length);
      EXPECT_LE((regular.surfaces[s].point - surfaces[s].point).norm(), given.length * (1 + exact));
      EXPECT_LE(regular.surfaces[s].direction.cross(surfaces[s].direction).norm(), given.angle);
    }
    for (const Surface_snap& snap : regular.snaps) EXPECT_LE(snap.difference, 1e-3);
  }
}

TEST(RegularSurfaces, DifferByMoreThanTheToleranceOrAreOne) {
  const Surfaces near = {plane({0, 0, 0}, {0, 0, 1}), plane({5, 0, 0.0009}, {0.0005, 0, 1})};
  const Regular_surfaces joined = regular_surfaces(near, given);
  EXPECT_EQ(joined.surfaces[0].direction, joined.surfaces[1].direction);
  EXPECT_EQ(number_of(joined, Regularity::parallel), 1U);

  const Surfaces far = {cylinder({0, 0, 0}, {0, 0, 1}, 1), cylinder({0, 0.0011, 0}, {0.0011, 0, 1}, 1.0011)};
  expect_same(regular_surfaces(far, given).surfaces, far, 0);
  EXPECT_TRUE(regular_surfaces(far, given).snaps.empty());
}

TEST(RegularSurfaces, LeaveChainsOfSmallDifferencesAlone) {
  Surfaces chain;
  for (int s = 0; s < 4; ++s) chain.push_back(cylinder({3. * s, 0, 0}, {0, 0, 1}, 1 + 0.0008 * s));
  const Regular_surfaces regular = regular_surfaces(chain, given);
  EXPECT_EQ(number_of(regular, Regularity::equal_radius), 0U);
  EXPECT_EQ(number_of(regular, Regularity::parallel), 3U);
  expect_same(regular.surfaces, chain, 1e-15);
}

TEST(RegularSurfaces, AreCoplanarCoaxialPerpendicularAndOfOneRadiusWithinErrors) {
  Surfaces surfaces = {plane({0, 0, 1e-5}, {1e-5, 0, 1}), plane({0, 3, 0}, {0, 1e-5, -1}),
                       cylinder({0, 0, 0}, {2e-5, 0, 1}, 0.5), cylinder({0, 1e-5, 4}, {0, 0, 1}, 0.50001),
                       plane({4, 0, 0}, {1, 2e-5, 3e-5})};
  for (Analytic_surface& surface : surfaces) {
    surface.errors.point = 1e-5;
    surface.errors.direction = 1e-5;
    surface.errors.radius = 1e-5;
  }
  const Regular_surfaces regular = regular_surfaces(surfaces);
  const Surfaces& s = regular.surfaces;
  EXPECT_NEAR(s[0].direction.cross(s[2].direction).norm(), 0, 1e-15);
  EXPECT_NEAR(s[0].signed_distance(s[1].point), 0, 1e-15);
  EXPECT_NEAR((s[2].point - s[3].point).cross(s[2].direction).norm(), 0, 1e-15);
  EXPECT_EQ(s[2].radius, s[3].radius);
  EXPECT_NEAR(s[4].direction.dot(s[0].direction), 0, 1e-15);
  EXPECT_LT(s[1].direction.z(), 0) << "orientations stay";
  for (const Regularity regularity :
       {Regularity::coplanar, Regularity::coaxial, Regularity::equal_radius, Regularity::perpendicular})
    EXPECT_EQ(number_of(regular, regularity), 1U) << name_of(regularity);
}

TEST(RegularSurfaces, MeetInTheMiddleWhereErrorsAreRounding) {
  Surfaces surfaces = {plane({0, 0, 0}, {0, 0, 1}), plane({3, 0, 0.08}, {0, 0, 1})};
  surfaces[0].errors.point = 1e-17;
  surfaces[1].errors.point = 3e-17;
  const Regular_surfaces regular = regular_surfaces(surfaces, {0.1, 0.01, 3});
  for (const Analytic_surface& surface : regular.surfaces) EXPECT_NEAR(surface.point.z(), 0.04, 1e-12);
  EXPECT_EQ(number_of(regular, Regularity::coplanar), 1u);
}

/// The surfaces of a slender cone round the axis of z, whose apex is far off, and a cylinder above it. Their vertices are noisy.
Surfaces slender_cone_and_cylinder(double offset, unsigned seed, meshes::Shape& shape) {
  constexpr std::size_t sides = 40, rows = 12;
  constexpr double noise = 0.03, height = 20, slope = 0.09;  // 5 degrees
  std::mt19937 random(seed);
  std::normal_distribution<double> deviation(0, noise);
  std::vector<std::size_t> ids;
  for (const bool is_cone : {true, false}) {
    const std::size_t first = shape.points.size();
    for (std::size_t row = 0; row <= rows; ++row)
      for (std::size_t i = 0; i < sides; ++i) {
        const double z = height * double(row) / double(rows), radius = is_cone ? 10 - slope * z : 6;
        const double angle = 2 * solids::half_turn * double(i) / double(sides);
        shape.points.emplace_back((is_cone ? 0 : offset) + radius * std::cos(angle), radius * std::sin(angle),
                                  is_cone ? z : z + 30);
        for (double& x : shape.points.back()) x += deviation(random);
      }
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t i = 0; i < sides; ++i) {
        const std::size_t a = first + row * sides + i, b = first + row * sides + (i + 1) % sides;
        shape.faces.push_back({a, b, b + sides});
        shape.faces.push_back({a, b + sides, a + sides});
        ids.insert(ids.end(), 2, is_cone ? 0 : 1);
      }
  }
  const auto mesh = meshes::surface_mesh(shape);
  return segment_surfaces(mesh, boost::make_iterator_property_map(ids.begin(), get(boost::face_index, mesh)), 2);
}

TEST(RegularSurfaces, OfASlenderConeKeepToItsVertices) {
  constexpr unsigned trials = 4;
  for (const double offset : {0., 0.2, 1.}) {
    SCOPED_TRACE(offset);
    unsigned cones = 0, coaxial = 0;
    for (unsigned seed = 1; seed <= trials; ++seed) {
      meshes::Shape shape;
      const Surfaces surfaces = slender_cone_and_cylinder(offset, seed, shape);
      if (surfaces[0].type != Surface_type::cone || surfaces[1].type != Surface_type::cylinder) continue;
      ++cones;
      const Regular_surfaces regular = regular_surfaces(surfaces);
      for (const Surface_snap& snap : regular.snaps) coaxial += snap.regularity == Regularity::coaxial;
      const std::vector<Vector3d> points(shape.points.begin(),
                                         shape.points.begin() + static_cast<std::ptrdiff_t>(shape.points.size() / 2));
      EXPECT_LE(root_mean_square_distance(regular.surfaces[0], points),
                1.1 * root_mean_square_distance(surfaces[0], points));
    }
    EXPECT_GE(cones, trials / 2);
    if (offset > 0)
      EXPECT_EQ(coaxial, 0U);
    else
      EXPECT_EQ(coaxial, cones);
  }
}

TEST(RegularSurfaces, OfUnknownErrorsAreLeftAlone) {
  Surfaces surfaces = {plane({0, 0, 0}, {0, 0, 1}), plane({0, 0, 1}, {0.1, 0, 1}), Analytic_surface()};
  for (Analytic_surface& surface : surfaces)
    surface.errors.point = surface.errors.direction = std::numeric_limits<double>::infinity();
  expect_same(regular_surfaces(surfaces).surfaces, surfaces, 0);
}

TEST(RegularSurfaces, RefuseTolerancesThatAreNone) {
  EXPECT_THROW(regular_surfaces({}, {-1, 0, 0}), std::invalid_argument);
  EXPECT_THROW(regular_surfaces({}, {0, std::numeric_limits<double>::infinity(), 0}), std::invalid_argument);
  EXPECT_TRUE(regular_surfaces({}).surfaces.empty());
}

TEST(RegularSurfaces, HaveANameForEachRegularity) {
  std::set<std::string> names;
  for (const Regularity regularity :
       {Regularity::parallel, Regularity::perpendicular, Regularity::coplanar, Regularity::coaxial,
        Regularity::equal_radius, Regularity::equal_ring, Regularity::equal_half_angle})
    names.insert(name_of(regularity));
  EXPECT_EQ(names.size(), 7U);
}

}  // namespace test_regular_surfaces
