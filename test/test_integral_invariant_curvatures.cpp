// SPDX-License-Identifier: MIT

// Curvatures from balls: their moments against quadrature, surfaces in closed form, and what odd meshes get.

#include "meshes.h"

#include <RW_segmentation/integral_invariant_curvatures.h>
#include <RW_segmentation/internal/curvature/Ball_neighbourhood.h>
#include <RW_segmentation/internal/curvature/Triangulated_faces.h>

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/property_map/property_map.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace test_integral_invariant_curvatures {

namespace {

using namespace RW_segmentation;
using Eigen::Vector3d;
using meshes::pi;
using meshes::Surface_mesh;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- Curvatures of a shape ----

template <class Mesh>
struct Measured {
  std::vector<Surface_curvatures> faces;  // in the order of the mesh
  Curvature_report report;
};

template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Measured<Mesh> measured(const Mesh& mesh, Ball_radius radius,
                        const NamedParameters& np = CGAL::parameters::default_values()) {
  std::map<typename boost::graph_traits<Mesh>::face_descriptor, Surface_curvatures> curvatures;
  Measured<Mesh> result;
  result.report = integral_invariant_curvatures(mesh, boost::associative_property_map(curvatures), radius, np);
  for (const auto f : faces(mesh)) result.faces.push_back(curvatures.at(f));
  return result;
}

Measured<Surface_mesh> measured(const meshes::Shape& shape, Ball_radius radius) {
  return measured(meshes::surface_mesh(shape), radius);
}

Vector3d centre(const meshes::Shape& shape, std::size_t face) {
  Vector3d sum = Vector3d::Zero();
  for (const std::size_t corner : shape.faces[face]) sum += shape.points[corner];
  return sum / static_cast<double>(shape.faces[face].size());
}

meshes::Shape inside_out(meshes::Shape shape) {
  for (auto& face : shape.faces) std::reverse(face.begin(), face.end());
  return shape;
}

bool is_finite(const Surface_curvatures& c) {
  return std::isfinite(c.max_curvature) && std::isfinite(c.min_curvature) &&
         std::isfinite(c.mean_curvature_by_volume) && std::isfinite(c.offset) && c.max_direction.allFinite() &&
         c.min_direction.allFinite() && c.normal.allFinite();
}

void expect_all_finite(const Measured<Surface_mesh>& result) {
  for (std::size_t f = 0; f < result.faces.size(); ++f) EXPECT_TRUE(is_finite(result.faces[f])) << "face " << f;
}

// ---- Moments ----

/// Volume, first and second moments as one vector.
using Moments = Eigen::Matrix<double, 10, 1>;

Moments as_vector(double volume, const Vector3d& first, const Eigen::Matrix3d& second) {
  Moments m;
  m << volume, first, second(0, 0), second(1, 1), second(2, 2), second(0, 1), second(0, 2), second(1, 2);
  return m;
}

/// The moments of balls round the faces of a shape, in the unit of the radius.
class Balls {
 public:
  explicit Balls(const meshes::Shape& shape) : mesh_(meshes::surface_mesh(shape)) {}
  Moments operator()(std::size_t face, double radius) {
    const auto ball = neighbourhood_.moments(dual_.index(Surface_mesh::Face_index(static_cast<std::uint32_t>(face))),
                                             radius / dual_.unit());
    return as_vector(ball.volume(), ball.first(), ball.second());
  }

 private:
  Surface_mesh mesh_;
  Dual_mesh_of<Surface_mesh> dual_{mesh_};
  internal::Triangulated_faces surface_{dual_};
  internal::Ball_neighbourhood neighbourhood_{surface_, dual_};
};

Moments moments(const meshes::Shape& shape, std::size_t face, double radius) { return Balls(shape)(face, radius); }

/// The integral of f, which adds its value times a weight to a sum.
template <class Function>
void add_gauss(const Function& f, double begin, double end, double weight, Moments& sum) {
  using Rule = boost::math::quadrature::gauss<double, 20>;
  const double half = (end - begin) / 2;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
    for (const double side : {-1., 1.})
      f((begin + end) / 2 + side * half * Rule::abscissa()[i], weight * half * Rule::weights()[i], sum);
}

template <class Function>
Moments gauss(const Function& f, double begin, double end) {
  Moments sum = Moments::Zero();
  add_gauss(f, begin, end, 1, sum);
  return sum;
}

/// Halves of halves, until the halves give what the whole does.
template <class Function>
Moments adaptive_gauss(const Function& f, double begin, double end, const Moments& whole, int depth = 30) {
  const double middle = (begin + end) / 2;
  const Moments left = gauss(f, begin, middle), right = gauss(f, middle, end);
  if (depth == 0 || (whole - left - right).cwiseAbs().maxCoeff() < 1e-13) return left + right;
  return adaptive_gauss(f, begin, middle, left, depth - 1) + adaptive_gauss(f, middle, end, right, depth - 1);
}

/// Adds the moments of a thin cone about a ray of a length along a unit vector. Plain numbers, since it is called
/// millions of times, and builds with sanitizers call every function of a vector.
void add_ray(double solid_angle, const std::array<double, 3>& w, double length, Moments& sum) {
  const double volume = solid_angle * length * length * length / 3;
  const double first = volume * 3 / 4 * length, second = volume * 3 / 5 * length * length;
  const std::array<double, 10> ray = {volume,
                                      first * w[0],
                                      first * w[1],
                                      first * w[2],
                                      second * w[0] * w[0],
                                      second * w[1] * w[1],
                                      second * w[2] * w[2],
                                      second * w[0] * w[1],
                                      second * w[0] * w[2],
                                      second * w[1] * w[2]};
  double* const moments = sum.data();
  for (std::size_t i = 0; i < 10; ++i) moments[i] += ray[i];
}

/// The moments of a convex solid in the unit ball, along rays from the origin: a ray ends on the sphere or on the first
/// plane n.x = h that it meets. The origin lies in the first plane. No formula here is used by what is tested.
Moments quadrature(const std::vector<std::pair<Vector3d, double>>& planes) {
  const Vector3d axis = -planes.front().first, u = axis.unitOrthogonal(), v = axis.cross(u);
  std::vector<std::array<double, 4>> ends;  // of rays: n and h
  for (std::size_t i = 1; i < planes.size(); ++i) {
    const auto& [n, h] = planes[i];
    ends.push_back({n.x(), n.y(), n.z(), h});
  }
  const auto ray_end = [&](const std::array<double, 3>& w) {
    double end = 1;
    for (const std::array<double, 4>& plane : ends) {
      const double slope = plane[0] * w[0] + plane[1] * w[1] + plane[2] * w[2];
      if (slope > 0) end = std::min(end, plane[3] / slope);
    }
    return end;
  };
  const auto along_meridian = [&](double azimuth, double weight, Moments& sum) {
    const Vector3d side = std::cos(azimuth) * u + std::sin(azimuth) * v;
    // Where the ray's end passes from a plane to the sphere or to another plane, the integrand has a kink.
    std::vector<double> kinks = {0, pi / 2};
    const auto add_roots = [&](const Vector3d& n, double h) {  // of n.w = h
      const double a = n.dot(axis), b = n.dot(side), size = std::hypot(a, b);
      if (!(size > std::abs(h))) return;
      for (const double sign : {-1., 1.})
        for (const double turn : {-2 * pi, 0., 2 * pi}) {
          const double root = std::atan2(b, a) + sign * std::acos(h / size) + turn;
          if (root > 0 && root < pi / 2) kinks.push_back(root);
        }
    };
    for (std::size_t i = 1; i < planes.size(); ++i) {
      add_roots(planes[i].first, planes[i].second);
      for (std::size_t j = 1; j < i; ++j)
        add_roots(planes[i].second * planes[j].first - planes[j].second * planes[i].first, 0);
    }
    std::sort(kinks.begin(), kinks.end());
    const std::array<double, 3> up = {axis.x(), axis.y(), axis.z()}, aside = {side.x(), side.y(), side.z()};
    const auto along_ray = [&](double polar, double ray_weight, Moments& rays) {
      const double c = std::cos(polar), s = std::sin(polar);
      const std::array<double, 3> w = {c * up[0] + s * aside[0], c * up[1] + s * aside[1], c * up[2] + s * aside[2]};
      add_ray(s * ray_weight, w, ray_end(w), rays);
    };
    for (std::size_t i = 0; i + 1 < kinks.size(); ++i) add_gauss(along_ray, kinks[i], kinks[i + 1], weight, sum);
  };
  return adaptive_gauss(along_meridian, 0, 2 * pi, Moments::Constant(infinity));
}

/// The planes of a convex shape about the centre of a face, that face's own first, in the unit of the radius.
std::vector<std::pair<Vector3d, double>> planes_about(const meshes::Shape& shape, std::size_t face, double radius) {
  std::vector<std::pair<Vector3d, double>> planes(1);
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const auto& corners = shape.faces[f];
    const Vector3d a = shape.points[corners[0]], b = shape.points[corners[1]], c = shape.points[corners[2]];
    const Vector3d n = (b - a).cross(c - a).normalized();
    const double h = n.dot(a - centre(shape, face)) / radius;
    if (f == face)
      planes[0] = {n, 0};
    else if (h > 1e-12 && h < 1)
      planes.emplace_back(n, h);
  }
  return planes;
}

meshes::Shape tetrahedron() {
  meshes::Shape shape;
  shape.points = {{0, 0, 0}, {2, 0.1, 0}, {0.4, 1.5, 0.2}, {0.5, 0.3, 1.1}};
  shape.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return shape;
}

TEST(Ball_moments, AgreeWithQuadrature) {
  const meshes::Shape box = meshes::transformed(meshes::cube_of_quads(), meshes::some_rotation());
  const meshes::Shape wedge = meshes::transformed(meshes::cube(), meshes::some_rotation());
  const meshes::Shape ellipsoid = meshes::transformed(meshes::sphere(0), Eigen::Affine3d(Eigen::Scaling(1.3, 1., 0.7)));
  struct Case {  // all planes that the ball meets hang together in it
    meshes::Shape shape;
    double radius;
  };
  for (const auto& [shape, radius] : {Case{tetrahedron(), 0.7}, Case{tetrahedron(), 1.2}, Case{box, 0.7},
                                      Case{box, 1.15}, Case{wedge, 0.6}, Case{ellipsoid, 0.7}})
    for (const std::size_t face : {std::size_t(0), std::size_t(3)}) {
      const Moments exact = quadrature(planes_about(shape, face, radius));
      const Moments found = moments(shape, face, radius);
      const Eigen::Vector3d size(exact[0], exact.segment<3>(1).norm(), exact.segment<3>(4).maxCoeff());
      EXPECT_NEAR(found[0], exact[0], 1e-10 * size[0]) << "face " << face << ", radius " << radius;
      EXPECT_LE((found - exact).segment<3>(1).norm(), 1e-10 * size[1]) << "face " << face << ", radius " << radius;
      EXPECT_LE((found - exact).segment<6>(4).norm(), 1e-10 * size[2]) << "face " << face << ", radius " << radius;
    }
}

TEST(Ball_moments, OfASolidAndItsComplementAreThoseOfTheBall) {
  const Moments ball = as_vector(4 * pi / 3, Vector3d::Zero(), 4 * pi / 15 * Eigen::Matrix3d::Identity());
  const meshes::Shape bumpy = meshes::with_noise(meshes::torus(2, 1, 30, 20), 0.05);
  const meshes::Shape quads = meshes::with_noise(meshes::cube_of_quads(), 0.1);  // not plane
  for (const auto& shape : {bumpy, quads, meshes::l_shape(3)}) {
    Balls solid(shape), complement(inside_out(shape));
    for (const double radius : {0.05, 0.3, 1., 2.5})
      for (std::size_t f = 0; f < shape.faces.size(); f += 1 + shape.faces.size() / 20) {
        const Moments sum = solid(f, radius) + complement(f, radius);
        const bool everything = (sum - ball).norm() > 1;  // both solids end inside the ball
        EXPECT_LE(everything ? sum.norm() : (sum - ball).norm(), 1e-10) << "face " << f << ", radius " << radius;
      }
  }
}

TEST(Ball_moments, DoNotJumpWhereTheSphereTouchesAVertexOrAnEdge) {
  const meshes::Shape shape = meshes::with_noise(meshes::sphere(2), 0.01);
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  const std::size_t face = 17;
  const Vector3d p = centre(shape, face);
  std::vector<double> distances;
  for (std::size_t f = 0; f < shape.faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d a = shape.points[shape.faces[f][k]] - p, b = shape.points[shape.faces[f][(k + 1) % 3]] - p;
      const double t = std::clamp(-a.dot(b - a) / (b - a).squaredNorm(), 0., 1.);
      const double distance = (a + t * (b - a)).norm();
      if (distance < 0.6) distances.push_back(distance);
    }
  ASSERT_GT(distances.size(), 50U);
  Balls balls(shape);
  for (const double r : distances) {
    const Moments at = balls(face, r);
    EXPECT_LE((at - balls(face, r * (1 - 1e-10))).norm(), 1e-7) << r;
    EXPECT_LE((at - balls(face, r * (1 + 1e-10))).norm(), 1e-7) << r;
    for (int ulps = -8; ulps <= 8; ++ulps)
      EXPECT_LE((at - balls(face, r * (1 + ulps * std::numeric_limits<double>::epsilon()))).norm(), 1e-7) << r;
  }
}

TEST(Ball_moments, DoNotDependOnHowAPlaneIsDivided) {
  meshes::Shape coarse = meshes::l_shape(1), fine = meshes::l_shape(7);
  // The middle of a triangle of the coarse one is the middle of one of seven times seven.
  std::size_t same = fine.faces.size();
  for (std::size_t f = 0; f < fine.faces.size(); ++f)
    if ((centre(fine, f) - centre(coarse, 4)).norm() < 1e-12) same = f;
  ASSERT_LT(same, fine.faces.size());
  for (const double radius : {0.2, 0.7, 1.3, 1.8})
    EXPECT_LE((moments(coarse, 4, radius) - moments(fine, same, radius)).norm(), 1e-12) << radius;
}

// ---- Surfaces in closed form ----

TEST(Integral_invariant_curvatures, OfASphereAreRightWithinOnePercent) {
  const auto [curvatures, report] = measured(meshes::sphere(5), Ball_radius::in_edge_lengths(4));
  ASSERT_EQ(curvatures.size(), 20480U);
  for (const Surface_curvatures& c : curvatures) {
    EXPECT_NEAR(c.max_curvature, 1, 0.01);
    EXPECT_NEAR(c.min_curvature, 1, 0.01);
    EXPECT_NEAR(c.mean_curvature_by_volume, 1, 0.02);
    EXPECT_NEAR(c.gaussian_curvature(), 1, 0.02);
  }
  EXPECT_EQ(report.balls_across_borders + report.balls_inside_a_face + report.balls_round_everything, 0U);
}

TEST(Integral_invariant_curvatures, FindTheCentreOfAFaceBelowTheSphereByTheHeightOfItsChords) {
  const meshes::Shape shape = meshes::sphere(5);
  const auto curvatures = measured(shape, Ball_radius::in_edge_lengths(2)).faces;
  double offset = 0, depth = 0;
  for (std::size_t f = 0; f < curvatures.size(); ++f) {
    offset += curvatures[f].offset;
    depth += (1 - centre(shape, f).norm()) / 4;  // the centre is the deepest point: on average 3/4 of it is missing
  }
  EXPECT_NEAR(offset / depth, 1, 0.2);
}

TEST(Integral_invariant_curvatures, OfASurfaceSeenFromInsideAreNegative) {
  for (const Surface_curvatures& c : measured(inside_out(meshes::sphere(4)), Ball_radius::in_edge_lengths(3)).faces) {
    EXPECT_NEAR(c.max_curvature, -1, 0.02);
    EXPECT_NEAR(c.min_curvature, -1, 0.02);
  }
}

TEST(Integral_invariant_curvatures, OfACylinderAreThoseOfACircleAndALine) {
  const meshes::Shape shape = meshes::tube(3, 100, 48);
  const auto [curvatures, report] = measured(shape, Ball_radius::in_edge_lengths(4));
  std::size_t far_from_borders = 0;
  for (std::size_t f = 0; f < curvatures.size(); ++f) {
    const Vector3d p = centre(shape, f);
    if (p.z() < 0.4 || p.z() > 2.6) continue;
    ++far_from_borders;
    EXPECT_NEAR(curvatures[f].max_curvature, 1, 0.02);
    EXPECT_NEAR(curvatures[f].min_curvature, 0, 0.02);
    EXPECT_GT(std::abs(curvatures[f].min_direction.z()), 0.99);
    EXPECT_GT(std::abs(curvatures[f].max_direction.cross(Vector3d(p.x(), p.y(), 0).normalized()).z()), 0.99);
    EXPECT_GT(curvatures[f].normal.dot(Vector3d(p.x(), p.y(), 0).normalized()), 0.99);
  }
  EXPECT_GT(far_from_borders, 5000U);
  EXPECT_GT(report.balls_across_borders, 0U);
  EXPECT_LT(report.balls_across_borders, curvatures.size() / 3);
}

TEST(Integral_invariant_curvatures, OfATorusAreThoseOfItsClosedForm) {
  const meshes::Shape shape = meshes::torus(2, 1, 120, 60);
  const auto curvatures = measured(shape, Ball_radius::in_edge_lengths(3)).faces;
  for (std::size_t f = 0; f < curvatures.size(); ++f) {
    const Vector3d p = centre(shape, f);
    const double out = std::hypot(p.x(), p.y()) - 2, cosine = out / std::hypot(out, p.z());
    EXPECT_NEAR(curvatures[f].max_curvature, 1, 0.04);
    EXPECT_NEAR(curvatures[f].min_curvature, cosine / (2 + cosine), 0.04);
    if (std::abs(cosine) > 0.2) {
      EXPECT_EQ(curvatures[f].gaussian_curvature() > 0, cosine > 0);
    }
  }
}

TEST(Integral_invariant_curvatures, OfASaddleHaveBothSigns) {
  meshes::Shape shape = meshes::plane(40);
  for (Vector3d& p : shape.points) {
    p -= Vector3d(0.5, 0.5, 0);
    p.z() = (p.y() * p.y() - p.x() * p.x()) / 2;  // a ridge along the y-axis, a valley along the x-axis
  }
  const auto curvatures = measured(shape, Ball_radius::absolute(0.15)).faces;
  for (std::size_t f = 0; f < curvatures.size(); ++f) {
    const Vector3d p = centre(shape, f);
    if (p.head<2>().norm() > 0.1) continue;
    EXPECT_NEAR(curvatures[f].max_curvature, 1, 0.03);
    EXPECT_NEAR(curvatures[f].min_curvature, -1, 0.03);
    EXPECT_GT(std::abs(curvatures[f].max_direction.x()), 0.98);
    EXPECT_GT(std::abs(curvatures[f].min_direction.y()), 0.98);
    EXPECT_GT(curvatures[f].normal.z(), 0.98);
  }
}

TEST(Integral_invariant_curvatures, AreUnmovedByNoiseThatIsSmallBesideTheBall) {
  const meshes::Shape clean = meshes::torus(2, 1, 80, 40);
  const meshes::Shape noisy = meshes::with_noise(clean, 0.015);
  const auto change = [&](double radius) {
    const auto before = measured(clean, Ball_radius::in_edge_lengths(radius)).faces;
    const auto after = measured(noisy, Ball_radius::in_edge_lengths(radius)).faces;
    double sum = 0;
    for (std::size_t f = 0; f < before.size(); ++f) sum += std::abs(after[f].max_curvature - before[f].max_curvature);
    return sum / static_cast<double>(before.size());
  };
  const double small_ball = change(2.5), large_ball = change(5);
  EXPECT_LT(large_ball, 0.05);
  EXPECT_LT(large_ball, small_ball / 4);
}

// ---- Invariances ----

TEST(Integral_invariant_curvatures, ScaleInverselyWithTheMesh) {
  const meshes::Shape shape = meshes::with_noise(meshes::l_shape(4), 0.02);
  for (const double factor : {1e150, 1e-150, 1234.5}) {
    const auto expected = measured(shape, Ball_radius::in_edge_lengths(2.5));
    const auto scaled = measured(meshes::scaled(shape, factor), Ball_radius::in_edge_lengths(2.5));
    const auto absolute = measured(meshes::scaled(shape, factor), Ball_radius::absolute(scaled.report.radius));
    EXPECT_NEAR(scaled.report.radius / expected.report.radius / factor, 1, 1e-9);
    for (std::size_t f = 0; f < expected.faces.size(); ++f) {
      EXPECT_NEAR(scaled.faces[f].max_curvature * factor, expected.faces[f].max_curvature, 1e-7);
      EXPECT_NEAR(scaled.faces[f].min_curvature * factor, expected.faces[f].min_curvature, 1e-7);
      EXPECT_NEAR(scaled.faces[f].offset / factor, expected.faces[f].offset, 1e-9);
      EXPECT_NEAR(absolute.faces[f].max_curvature * factor, expected.faces[f].max_curvature, 1e-7);
    }
  }
}

TEST(Integral_invariant_curvatures, TurnWithTheMesh) {
  const meshes::Shape shape = meshes::with_noise(meshes::torus(2, 0.8, 24, 12), 0.02);
  const auto expected = measured(shape, Ball_radius::in_edge_lengths(3)).faces;
  const auto turned = measured(meshes::transformed(meshes::moved(shape, {3, -4, 5}), meshes::some_rotation()),
                               Ball_radius::in_edge_lengths(3))
                          .faces;
  for (std::size_t f = 0; f < expected.size(); ++f) {
    EXPECT_NEAR(turned[f].max_curvature, expected[f].max_curvature, 1e-8);
    EXPECT_NEAR(turned[f].min_curvature, expected[f].min_curvature, 1e-8);
    EXPECT_NEAR(turned[f].normal.dot(meshes::some_rotation().linear() * expected[f].normal), 1, 1e-8);
  }
}

template <class Holder>
class Integral_invariant_curvatures_on : public testing::Test {};
TYPED_TEST_SUITE(Integral_invariant_curvatures_on, meshes::Holders);

TYPED_TEST(Integral_invariant_curvatures_on, AreTheSame) {
  for (const meshes::Shape& shape : {meshes::with_noise(meshes::tube(2, 16, 10), 0.02), meshes::cube_of_quads()}) {
    const TypeParam held(shape);
    const auto expected = measured(shape, Ball_radius::absolute(0.6)).faces;
    const auto found = measured(held.mesh, Ball_radius::absolute(0.6)).faces;
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t f = 0; f < found.size(); ++f) {
      EXPECT_NEAR(found[f].max_curvature, expected[f].max_curvature, 1e-9);
      EXPECT_NEAR(found[f].min_curvature, expected[f].min_curvature, 1e-9);
    }
  }
}

TEST(Integral_invariant_curvatures, DoNotDependOnTheConcurrencyTag) {
  Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::torus(2, 1, 100, 50), 0.01));
  const auto parallel = mesh.add_property_map<Surface_mesh::Face_index, Surface_curvatures>("f:parallel").first;
  const auto sequential = mesh.add_property_map<Surface_mesh::Face_index, Surface_curvatures>("f:sequential").first;
  integral_invariant_curvatures<CGAL::Parallel_if_available_tag>(mesh, parallel);
  integral_invariant_curvatures<CGAL::Sequential_tag>(mesh, sequential);
  for (const auto f : mesh.faces()) {
    EXPECT_EQ(parallel[f].max_curvature, sequential[f].max_curvature);
    EXPECT_EQ(parallel[f].min_curvature, sequential[f].min_curvature);
  }
}

TEST(Integral_invariant_curvatures, OfSeveralRadiiAreThoseOfEach) {
  Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::torus(2, 1, 20, 10), 0.01));
  using Map = Surface_mesh::Property_map<Surface_mesh::Face_index, Surface_curvatures>;
  const std::vector<Ball_radius> radii = {Ball_radius::absolute(0.9), Ball_radius::in_edge_lengths(2),
                                          Ball_radius::absolute(0.5)};
  std::vector<Map> maps;
  for (const char* name : {"f:a", "f:b", "f:c"})
    maps.push_back(mesh.add_property_map<Surface_mesh::Face_index, Surface_curvatures>(name).first);
  const auto reports = integral_invariant_curvatures(mesh, maps, radii);
  ASSERT_EQ(reports.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto alone = measured(mesh, radii[i]);
    EXPECT_EQ(reports[i].radius, alone.report.radius);
    for (const auto f : mesh.faces()) EXPECT_EQ(maps[i][f].max_curvature, alone.faces[f].max_curvature);
  }
  maps.pop_back();
  EXPECT_THROW(integral_invariant_curvatures(mesh, maps, radii), std::invalid_argument);
}

// ---- Odd meshes ----

TEST(Integral_invariant_curvatures, OfAPlaneVanishUpToItsBorder) {
  const meshes::Shape plane = meshes::transformed(meshes::plane(8), meshes::some_rotation());
  for (const double radius : {0.01, 0.3, 5.}) {
    const auto [curvatures, report] = measured(plane, Ball_radius::absolute(radius));
    for (const Surface_curvatures& c : curvatures) {
      EXPECT_NEAR(c.max_curvature, 0, 1e-9 / radius);
      EXPECT_NEAR(c.min_curvature, 0, 1e-9 / radius);
      EXPECT_NEAR(c.mean_curvature_by_volume, 0, 1e-9 / radius);
    }
    EXPECT_EQ(report.balls_inside_a_face, radius < 0.02 ? curvatures.size() : 0);
    EXPECT_EQ(report.balls_across_borders == curvatures.size(), radius > 1);
  }
}

TEST(Integral_invariant_curvatures, KeepTheirSignAtABorder) {
  for (const Surface_curvatures& c : measured(meshes::tube(3, 60, 28), Ball_radius::in_edge_lengths(3)).faces) {
    EXPECT_GT(c.max_curvature, 0.4);
    EXPECT_LT(c.max_curvature, 1.05);
    EXPECT_NEAR(c.min_curvature, 0, 0.2);
  }
}

TEST(Integral_invariant_curvatures, OfAThinSheetDoNotSeeItsOtherSide) {
  meshes::Shape sheet = meshes::cube(16);
  for (Vector3d& p : sheet.points) p.z() *= 0.01;
  const auto curvatures = measured(sheet, Ball_radius::absolute(0.2)).faces;
  std::size_t inner = 0;
  for (std::size_t f = 0; f < curvatures.size(); ++f) {
    const Vector3d p = centre(sheet, f);
    if (std::abs(p.x() - 0.5) > 0.29 || std::abs(p.y() - 0.5) > 0.29) continue;
    ++inner;
    EXPECT_NEAR(curvatures[f].max_curvature, 0, 1e-9);
    EXPECT_NEAR(curvatures[f].min_curvature, 0, 1e-9);
  }
  EXPECT_GT(inner, 100U);
}

TEST(Integral_invariant_curvatures, OfBallsRoundEverythingAreCountedAndFinite) {
  for (const double radius : {3., 100., 1e6, 1e308}) {
    const auto result = measured(meshes::scaled(meshes::sphere(2), 0.1), Ball_radius::absolute(radius));
    expect_all_finite(result);
    EXPECT_EQ(result.report.balls_round_everything, result.faces.size());
  }
}

TEST(Integral_invariant_curvatures, OfBallsTooSmallForNumbersAreThoseOfPlanes) {
  const meshes::Shape sphere = meshes::sphere(1);
  for (const double least : {std::numeric_limits<double>::denorm_min(), 1e-200})
    for (const Ball_radius& radius : {Ball_radius::absolute(least), Ball_radius::in_edge_lengths(least)}) {
      const auto [curvatures, report] = measured(sphere, radius);
      EXPECT_EQ(report.balls_inside_a_face, curvatures.size());
      for (const Surface_curvatures& c : curvatures) EXPECT_LT(std::abs(c.max_curvature) * report.radius, 1e-9);
    }
}

TEST(Integral_invariant_curvatures, OfFacesWithoutAreaAreThoseOfAFaceNearby) {
  meshes::Shape shape = meshes::sphere(4);
  // The first edge of face 100 gets two points, and two faces without area one beside the other.
  const std::size_t a = shape.faces[100][0], b = shape.faces[100][1], c = shape.faces[100][2];
  const std::size_t first = shape.points.size(), second = first + 1;
  const Vector3d third = (shape.points[b] - shape.points[a]) / 3;
  shape.points.push_back(shape.points[a] + third);
  shape.points.push_back(shape.points[b] - third);
  shape.faces.push_back({a, b, first});
  shape.faces.push_back({first, b, second});
  shape.faces[100] = {a, first, c};
  shape.faces.push_back({first, second, c});
  shape.faces.push_back({second, b, c});
  const auto [curvatures, report] = measured(shape, Ball_radius::in_edge_lengths(3));
  EXPECT_EQ(report.faces_without_area, 2U);
  for (const Surface_curvatures& c : curvatures) {
    EXPECT_NEAR(c.max_curvature, 1, 0.03);
    EXPECT_NEAR(c.min_curvature, 1, 0.03);
  }
}

TEST(Integral_invariant_curvatures, OfOddMeshesAreFinite) {
  meshes::Shape point = meshes::plane(2), pillow, needles = meshes::sphere(2), folded = meshes::folded_strip(pi, 3);
  for (Vector3d& p : point.points) p = Vector3d::Constant(7);
  pillow.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  pillow.faces = {{0, 1, 2}, {0, 2, 1}};
  for (Vector3d& p : needles.points) p.z() *= 1e-8;
  const meshes::Shape crumpled = meshes::with_noise(meshes::sphere(2), 0.5);
  const meshes::Shape alone = meshes::Shape{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  for (const meshes::Shape& shape : {point, pillow, needles, folded, crumpled, alone})
    for (const double radius : {1e-9, 0.1, 0.5, 3., 1e9})
      for (const meshes::Shape& side : {shape, inside_out(shape)})
        expect_all_finite(measured(side, Ball_radius::absolute(radius)));
}

TEST(Integral_invariant_curvatures, OfAnEmptyMeshAreNone) {
  const auto result = measured(Surface_mesh(), Ball_radius::in_edge_lengths(3));
  EXPECT_TRUE(result.faces.empty());
}

TEST(Integral_invariant_curvatures, RefuseARadiusThatIsNotPositive) {
  for (const double bad : {0., -1., nan, infinity}) {
    EXPECT_THROW(measured(meshes::sphere(1), Ball_radius::absolute(bad)), std::invalid_argument);
    EXPECT_THROW(measured(meshes::sphere(1), Ball_radius::in_edge_lengths(bad)), std::invalid_argument);
  }
}

TEST(Integral_invariant_curvatures, NameTheVertexThatIsNotFinite) {
  meshes::Shape shape = meshes::sphere(1);
  shape.points[5].y() = nan;
  try {
    measured(shape, Ball_radius::in_edge_lengths(2));
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("vertex 5 "), std::string::npos) << error.what();
  }
}

TEST(Integral_invariant_curvatures, CanBeCancelledAndWriteNothingThen) {
  Surface_mesh mesh = meshes::surface_mesh(meshes::sphere(5));
  const auto map = mesh.add_property_map<Surface_mesh::Face_index, Surface_curvatures>("f:c").first;
  std::vector<double> fractions;
  const std::function<bool(double)> stop_half_way = [&](double fraction) {
    fractions.push_back(fraction);
    return fraction < 0.5;
  };
  EXPECT_THROW(integral_invariant_curvatures(mesh, map, Ball_radius::in_edge_lengths(1),
                                             CGAL::parameters::callback(stop_half_way)),
               Cancelled);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GT(fractions.size(), 2U);
  for (const auto f : mesh.faces()) EXPECT_TRUE(map[f].normal.isZero(0));
}

}  // namespace

}  // namespace test_integral_invariant_curvatures
