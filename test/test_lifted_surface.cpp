// SPDX-License-Identifier: MIT

// Closest points on a surface and on the surface in the metric of points and normals.

#include <RW_segmentation/internal/boundary/Lifted_surface.h>

#include <gtest/gtest.h>
#include "meshes.h"

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

namespace test_lifted_surface {

using namespace RW_segmentation::internal;
using Index = Triangle_surface::Index;
using Point = Lifted_surface::Point;

namespace {

struct Surface {
  meshes::Surface_mesh mesh;
  Triangle_surface triangles;
  std::vector<Eigen::Vector3d> normals;

  explicit Surface(const meshes::Shape& shape)
      : mesh(meshes::surface_mesh(shape)), triangles(RW_segmentation::Dual_mesh_of(mesh)) {
    for (Index f = 0; f < triangles.number_of_faces(); ++f) {
      const Eigen::Vector3d a = corner(f, 0);
      normals.push_back((corner(f, 1) - a).cross(corner(f, 2) - a).normalized());
    }
  }

  const Eigen::Vector3d& corner(Index face, Index k) const { return triangles.point(triangles.source(3 * face + k)); }
};

Point random_point(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  Point p;
  for (double& x : p) x = uniform(random);
  return p;
}

}  // namespace

TEST(LiftedSurface, FindsThePointOfATriangleFromWhichNoOtherIsCloser) {
  // A point p of a convex set is closest to q if and only if (q - p)(x - p) <= 0 for all x of it.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 2);
  const Surface surface(meshes::with_noise(meshes::sphere(0), 0.2));
  const auto none = Triangle_surface::none;
  for (const double w : {0., 0.7}) {
    int insides = 0, sides = 0, corners = 0;
    for (int trial = 0; trial < 3000; ++trial) {
      const auto face = static_cast<Index>(random() % surface.triangles.number_of_faces());
      const Triangle_surface triangle({surface.corner(face, 0), surface.corner(face, 1), surface.corner(face, 2)},
                                      {0, 1, 2}, {none, none, none});
      const Lifted_surface lifted(triangle, {surface.normals[face]}, w);
      const Point a = lifted.at(Index(0)), u = lifted.at(Index(1)) - a, v = lifted.at(Index(2)) - a;
      const Point q = a + uniform(random) * u + uniform(random) * v + random_point(random, 0.3);

      const Surface_place place = lifted.closest(q, 0);
      EXPECT_NEAR(place.weight.sum(), 1, 1e-12);
      EXPECT_GE(place.weight.minCoeff(), 0);
      const Point p = lifted.at(place);
      for (Index k = 0; k < 3; ++k) EXPECT_LE((q - p).dot(lifted.at(k) - p), 1e-12);
      const auto zeros = (place.weight.array() == 0).count();
      ++(zeros == 0 ? insides : zeros == 1 ? sides : corners);

      const Point foot = lifted.tangent_projection(0, q);
      EXPECT_NEAR((q - foot).dot(u), 0, 1e-12);
      EXPECT_NEAR((q - foot).dot(v), 0, 1e-12);
    }
    EXPECT_GT(std::min({insides, sides, corners}), 100);
  }
}

TEST(LiftedSurface, WalksToTheClosestPointOfAConvexSurface) {
  const Surface surface(meshes::sphere(3));
  const Lifted_surface lifted(surface.triangles, surface.normals, 0);
  Point centre = Point::Zero();
  for (Index v = 0; v < surface.triangles.number_of_vertices(); ++v)
    centre += lifted.at(v) / static_cast<double>(surface.triangles.number_of_vertices());
  const double radius = (lifted.at(Index(0)) - centre).norm();
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    Point q = random_point(random, 1);
    q.tail<3>().setZero();
    q = centre + 1.2 * radius * q.normalized();
    const auto start = static_cast<Index>(random() % surface.triangles.number_of_faces());
    const double found = (lifted.at(lifted.closest(q, start)) - q).norm();
    for (Index v = 0; v < surface.triangles.number_of_vertices(); ++v)
      ASSERT_LE(found, (lifted.at(v) - q).norm() * (1 + 1e-9));
    EXPECT_LE(found, 0.2 * radius * 1.05);  // that of the sphere, and a little for what triangles cut off
  }
}

}  // namespace test_lifted_surface
