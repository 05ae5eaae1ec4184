// SPDX-License-Identifier: MIT

#include <RW_segmentation/Geodesic_joining.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/smooth_boundaries.h>

#include <gtest/gtest.h>
#include "boundaries.h"
#include "meshes.h"

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/iterator.h>

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace test_smooth_boundaries {

using namespace RW_segmentation;
using namespace boundaries;

namespace {

using meshes::Shape;
using meshes::Surface_mesh;

std::vector<Boundary_curve<Surface_mesh>> curves_of(const Surface_mesh& mesh, const Labels& labels,
                                                    const Boundary_smoothing& smoothing = {}) {
  Growing_face_labels<Surface_mesh> ids(mesh, labels);
  return smooth_boundaries(mesh, ids.map(), smoothing);
}

/// The curves before they are smoothed.
std::vector<Boundary_curve<Surface_mesh>> jagged_curves_of(const Surface_mesh& mesh, const Labels& labels) {
  Boundary_smoothing none;
  none.largest_displacement = 0;
  auto curves = curves_of(mesh, labels, none);
  for (const auto& curve : curves) EXPECT_FALSE(curve.is_smoothed);
  return curves;
}

/// Two halves whose boundary zigzags about the plane where the coordinate has the value.
Labels zigzag(const Shape& shape, int coordinate, double value, double amplitude,
              const std::function<int(double, double)>& row) {
  return labels_by_place(shape, [&](const Eigen::Vector3d& p) {
    const int side = row(p[(coordinate + 1) % 3], p[(coordinate + 2) % 3]) % 2 == 0 ? 1 : -1;
    return std::size_t(p[coordinate] > value + side * amplitude);
  });
}

/// The faces on which a point of a curve lies.
std::set<Surface_mesh::Face_index> faces_at(const Surface_mesh& mesh, const Boundary_point<Surface_mesh>& p) {
  if (p.position < 1) return {mesh.face(p.halfedge), mesh.face(mesh.opposite(p.halfedge))};
  const auto range = CGAL::faces_around_target(p.halfedge, mesh);
  return {range.begin(), range.end()};
}

Shape bumpy_torus() { return meshes::with_noise(meshes::torus(2, 1, 40, 24), 0.02); }

}  // namespace

// ---- Shapes whose smooth boundary is known ----

TEST(SmoothBoundaries, JaggedLineOnAPlaneBecomesStraight) {
  const Shape shape = meshes::plane(30);
  const double edge = 1. / 30;
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  const Labels labels = zigzag(shape, 0, 0.5, edge, [&](double y, double) { return static_cast<int>(y / edge); });
  const auto jagged = jagged_curves_of(mesh, labels), curves = curves_of(mesh, labels);
  ASSERT_EQ(curves.size(), 1u);
  ASSERT_TRUE(curves[0].is_smoothed);
  EXPECT_FALSE(curves[0].is_closed);
  EXPECT_LT(turning(points_of(curves[0]), false), turning(points_of(jagged[0]), false) / 10);
  for (const Eigen::Vector3d& p : points_of(curves[0]))
    EXPECT_TRUE(p.y() < 0.2 || p.y() > 0.8 || std::abs(p.x() - 0.5) < edge / 4) << p.transpose();
}

TEST(SmoothBoundaries, JaggedRingOnATubeBecomesACircle) {
  const Shape shape = meshes::tube(4, 40, 26);
  const double edge = 4. / 26;
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  const Labels labels = zigzag(shape, 2, 2, edge, [](double x, double y) {
    return static_cast<int>(std::floor((std::atan2(y, x) + meshes::pi) / (2 * meshes::pi) * 40));
  });
  const auto jagged = jagged_curves_of(mesh, labels), curves = curves_of(mesh, labels);
  ASSERT_EQ(curves.size(), 1u);
  ASSERT_TRUE(curves[0].is_smoothed);
  EXPECT_TRUE(curves[0].is_closed);
  double mean = 0, deviation = 0;
  const auto points = points_of(curves[0]);
  for (const Eigen::Vector3d& p : points) mean += p.z() / static_cast<double>(points.size());
  for (const Eigen::Vector3d& p : points) deviation = std::max(deviation, std::abs(p.z() - mean));
  EXPECT_NEAR(mean, 2, edge / 2);
  EXPECT_LT(deviation, edge / 5);
  EXPECT_NEAR(turning(points, true), 2 * meshes::pi, 0.3) << "a convex closed curve turns once";
  EXPECT_GT(turning(points_of(jagged[0]), true), 30) << "which is not how it began";
}

TEST(SmoothBoundaries, BoundariesOnTheEdgesOfACubeStayThere) {
  const Shape shape = meshes::cube(6);
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  Labels six, halves;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    six.push_back(f / 72);
    halves.push_back(f / 72 % 2);
  }
  for (const Labels& labels : {six, halves})
    for (const auto& curve : curves_of(mesh, labels))
      for (const Eigen::Vector3d& p : points_of(curve)) {
        int on_sides = 0;
        for (int i = 0; i < 3; ++i) on_sides += p[i] == 0 || p[i] == 1;
        EXPECT_GE(on_sides, 2) << p.transpose();
      }
}

TEST(SmoothBoundaries, RunOnAlongACreaseAndAreSmoothedElsewhereWhereverTheyBegin) {
  const Shape cube = meshes::cube(16);
  for (unsigned seed = 1; seed <= 20; ++seed) {  // a closed curve begins in the first face that it passes
    const Shape shape = meshes::with_faces_in_order(cube, meshes::random_order(cube.faces.size(), seed));
    const Surface_mesh mesh = meshes::surface_mesh(shape);
    const Labels half_disc = labels_by_place(shape, [](const Eigen::Vector3d& p) {
      return std::size_t(p.z() == 1 && (p - Eigen::Vector3d(0.5, 0, 1)).norm() < 0.35);
    });
    const auto jagged = jagged_curves_of(mesh, half_disc), curves = curves_of(mesh, half_disc);
    ASSERT_EQ(curves.size(), 1u);
    EXPECT_TRUE(curves[0].is_closed);
    EXPECT_TRUE(curves[0].is_smoothed);
    const auto points = points_of(curves[0]), corners = points_of(jagged[0]);
    EXPECT_LT(turning(points, true), turning(corners, true) / 2);
    for (const Eigen::Vector3d& p : corners)
      EXPECT_TRUE(p.y() > 0 || std::count(points.begin(), points.end(), p) == 1) << p.transpose();
  }
}

TEST(SmoothBoundaries, TurnsAThirdOfTheJaggedOnesAtMost) {
  const Shape shape = meshes::sphere(4);
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  const Labels labels =
      labels_by_place(shape, [](const Eigen::Vector3d& p) { return std::size_t(p.x() + 0.3 * p.y() > 0.2); });
  const auto jagged = jagged_curves_of(mesh, labels), curves = curves_of(mesh, labels);
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_LT(turning(points_of(curves[0]), true), turning(points_of(jagged[0]), true) / 3);
}

// ---- What curves keep to ----

TEST(SmoothBoundaries, NoPointLeavesItsBoundaryByMoreThanAllowed) {
  const Shape shape = bumpy_torus();
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  const Labels labels = random_cells(shape, 12);
  const auto jagged = jagged_curves_of(mesh, labels);
  for (const double displacement : {0.25, 1., 3.}) {
    Boundary_smoothing smoothing;
    smoothing.largest_displacement = displacement;
    const auto curves = curves_of(mesh, labels, smoothing);
    ASSERT_EQ(curves.size(), jagged.size());
    std::size_t smoothed = 0;
    for (std::size_t c = 0; c < curves.size(); ++c) {
      smoothed += curves[c].is_smoothed;
      const auto edges = points_of(jagged[c]);
      for (const Eigen::Vector3d& p : points_of(curves[c])) {
        double distance = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i + (jagged[c].is_closed ? 0 : 1) < edges.size(); ++i)
          distance = std::min(distance, distance_to_line(p, edges[i], edges[(i + 1) % edges.size()]));
        EXPECT_LE(distance, displacement * mean_edge_length(mesh) * (1 + 1e-9));
      }
    }
    EXPECT_GT(smoothed, 0u);
  }
}

TEST(SmoothBoundaries, AreSmoothedWithinTheirCorridorHoweverHugeTheNumbers) {
  const Shape shape = meshes::sphere(3);
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  Boundary_smoothing smoothing;
  smoothing.length = smoothing.tension = 1e100;
  const auto labels = random_cells(shape, 2);
  const auto jagged = jagged_curves_of(mesh, labels), curves = curves_of(mesh, labels, smoothing);
  ASSERT_EQ(curves.size(), jagged.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const auto corners = points_of(jagged[c]);
    EXPECT_TRUE(curves[c].is_smoothed);
    EXPECT_LT(turning(points_of(curves[c]), true), turning(corners, true) / 2);
    for (const Eigen::Vector3d& p : points_of(curves[c])) {
      double distance = distance_to_line(p, corners.back(), corners.front());
      for (std::size_t i = 1; i < corners.size(); ++i)
        distance = std::min(distance, distance_to_line(p, corners[i - 1], corners[i]));
      EXPECT_LE(distance, mean_edge_length(mesh));
    }
  }
}

TEST(SmoothBoundaries, CurvesThatWouldMeetAreDrawnCloserToTheirEdges) {
  const Shape shape = meshes::plane(16);
  const Labels labels = labels_by_place(shape, [](const Eigen::Vector3d& p) {
    // A strip that is wide, then pinched, and so on.
    const bool is_wide = static_cast<int>(16 * p.x()) % 4 < 2;
    const double below = is_wide ? 0.08 : -0.01, above = is_wide ? 0.005 : 0.095;
    return std::size_t(p.y() < 0.5 - below ? 0 : p.y() < 0.5 + above ? 1 : 2);
  });
  const auto curves = curves_of(meshes::surface_mesh(shape), labels);
  EXPECT_GT(curves.size(), 2u);
  for (const auto& curve : curves) EXPECT_TRUE(curve.is_smoothed);
}

TEST(SmoothBoundaries, BranchPointsStay) {
  const Shape shape = bumpy_torus();
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  const Labels labels = random_cells(shape, 12);
  const auto jagged = jagged_curves_of(mesh, labels), curves = curves_of(mesh, labels);
  std::size_t open = 0;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    ASSERT_EQ(curves[c].is_closed, jagged[c].is_closed);
    ASSERT_EQ(curves[c].segments, jagged[c].segments);
    if (curves[c].is_closed) continue;
    ++open;
    EXPECT_EQ(points_of(curves[c]).front(), points_of(jagged[c]).front());
    EXPECT_EQ(points_of(curves[c]).back(), points_of(jagged[c]).back());
  }
  EXPECT_GT(open, 10u);
}

TEST(SmoothBoundaries, ConsecutivePointsShareAFace) {
  const Shape shape = bumpy_torus();
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  for (const auto& curve : curves_of(mesh, random_cells(shape, 12)))
    for (std::size_t i = curve.is_closed ? 0 : 1; i < curve.points.size(); ++i) {
      const auto a = faces_at(mesh, curve.points[(i + curve.points.size() - 1) % curve.points.size()]);
      const auto b = faces_at(mesh, curve.points[i]);
      EXPECT_TRUE(std::any_of(a.begin(), a.end(), [&](auto f) { return b.count(f) > 0; }));
    }
}

TEST(SmoothBoundaries, FaceLocationIsThePoint) {
  const Shape shape = bumpy_torus();
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  for (const auto& curve : curves_of(mesh, random_cells(shape, 5)))
    for (const auto& p : curve.points) {
      const auto [f, weights] = face_location(p, mesh);
      const auto h = mesh.halfedge(f);
      const Eigen::Vector3d q = weights[0] * point(mesh, mesh.source(h)) + weights[1] * point(mesh, mesh.target(h)) +
                                weights[2] * point(mesh, mesh.target(mesh.next(h)));
      EXPECT_LT((q - vector(p.point)).norm(), 1e-12);
    }
}

TEST(SmoothBoundaries, SegmentsLieOnTheSidesTheyAreSaidTo) {
  const Shape shape = meshes::sphere(3);
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  const auto curves =
      curves_of(mesh, labels_by_place(shape, [](const Eigen::Vector3d& p) { return p.z() > 0 ? 7u : 3u; }));
  ASSERT_EQ(curves.size(), 1u);
  const auto points = points_of(curves[0]);
  Eigen::Vector3d area = Eigen::Vector3d::Zero();  // points up if the curve goes round counterclockwise
  for (std::size_t i = 0; i < points.size(); ++i) area += points[i].cross(points[(i + 1) % points.size()]);
  EXPECT_EQ(curves[0].segments[0], area.z() > 0 ? 7u : 3u);
  EXPECT_EQ(curves[0].segments[1], area.z() > 0 ? 3u : 7u);
}

// ---- Walls ----

namespace {

/// Closed loops of walls on a closed mesh, and segments of which some keep to their sides and others do not.
struct Walled {
  Shape shape;
  Surface_mesh mesh = meshes::surface_mesh(shape);
  Labels sides;
  Edge_marks walls = edges_between(mesh, sides);

  Walled(Shape closed, unsigned seed) : shape(std::move(closed)), sides(random_cells(shape, 3, seed)) {}

  template <class Joining = Traced_joining>
  std::vector<Boundary_curve<Surface_mesh>> curves(const Labels& labels, const Joining& joining = {}) {
    Growing_face_labels<Surface_mesh> ids(mesh, labels);
    return smooth_boundaries(mesh, ids.map(), {}, joining,
                             CGAL::parameters::edge_is_constrained_map(boost::make_assoc_property_map(walls)));
  }
};

}  // namespace

TEST(SmoothBoundaries, NoCurveCrossesAWall) {
  std::size_t smoothed = 0, crossed_without_walls = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    Walled walled(seed % 2 == 0 ? bumpy_torus() : meshes::with_noise(meshes::sphere(3), 0.01), seed);
    const Surface_mesh& mesh = walled.mesh;
    const Labels cells = random_cells(walled.shape, 8, seed + 100);
    const auto crosses = [&](const Boundary_curve<Surface_mesh>& curve) {
      std::set<std::size_t> sides;  // of the faces that the curve runs across
      for (std::size_t i = curve.is_closed ? 0 : 1; i < curve.points.size(); ++i) {
        const auto &p = curve.points[i], &q = curve.points[(i + curve.points.size() - 1) % curve.points.size()];
        if (p.position < 1 && walled.walls.at(mesh.edge(p.halfedge))) return true;
        if (p.position == 1 && q.position == 1) continue;
        for (const auto f : faces_at(mesh, p))
          if (faces_at(mesh, q).count(f)) sides.insert(walled.sides[f]);
      }
      return sides.size() > 1;
    };
    for (const Labels& labels : {cells, products(cells, walled.sides)}) {
      for (const auto& curves : {walled.curves(labels), walled.curves(labels, Geodesic_joining())})
        for (const auto& curve : curves) {
          smoothed += curve.is_smoothed;
          EXPECT_FALSE(crosses(curve)) << "seed " << seed;
        }
      for (const auto& curve : curves_of(mesh, labels)) crossed_without_walls += crosses(curve);
    }
  }
  EXPECT_GT(smoothed, 30u);
  EXPECT_GT(crossed_without_walls, 30u);
}

TEST(SmoothBoundaries, ABoundaryAlongWallsStays) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    Walled walled(bumpy_torus(), seed);
    const auto jagged = jagged_curves_of(walled.mesh, walled.sides), curves = walled.curves(walled.sides);
    ASSERT_EQ(curves.size(), jagged.size());
    for (std::size_t c = 0; c < curves.size(); ++c) {
      EXPECT_FALSE(curves[c].is_smoothed);
      EXPECT_EQ(points_of(curves[c]), points_of(jagged[c]));
    }
    const Labels finer = products(walled.sides, random_cells(walled.shape, 6, seed + 100));
    std::set<Surface_mesh::Edge_index> met;
    for (const auto& curve : walled.curves(finer))
      for (std::size_t i = curve.is_closed ? 0 : 1; i < curve.points.size(); ++i) {
        const auto &p = curve.points[(i + curve.points.size() - 1) % curve.points.size()], &q = curve.points[i];
        if (p.position < 1 || q.position < 1) continue;
        met.insert(
            walled.mesh.edge(walled.mesh.halfedge(walled.mesh.target(p.halfedge), walled.mesh.target(q.halfedge))));
      }
    for (const auto& [edge, is_wall] : walled.walls) EXPECT_TRUE(!is_wall || met.count(edge)) << edge;
  }
}

TEST(SmoothBoundaries, WallsFarFromBoundariesChangeNothing) {
  const Shape shape = meshes::sphere(3);
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  const auto above = [&](double height) {
    return labels_by_place(shape, [&](const Eigen::Vector3d& p) { return std::size_t(p.z() > height); });
  };
  Edge_marks walls = edges_between(mesh, above(-0.6));
  Growing_face_labels<Surface_mesh> ids(mesh, above(0.3));
  const auto np = CGAL::parameters::edge_is_constrained_map(boost::make_assoc_property_map(walls));
  Boundary_smoothing own_normals;
  own_normals.normals.radius = 0;
  const auto curves = smooth_boundaries(mesh, ids.map(), own_normals, np);
  const auto expected = smooth_boundaries(mesh, ids.map(), own_normals);
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(points_of(curves[0]), points_of(expected[0]));
}

TEST(SmoothBoundaries, ADualMeshHasItsWallsAndPoints) {
  Walled walled(bumpy_torus(), 3);
  const Labels labels = products(walled.sides, random_cells(walled.shape, 6));
  Growing_face_labels<Surface_mesh> ids(walled.mesh, labels);
  const Dual_mesh_of dual(walled.mesh,
                          CGAL::parameters::edge_is_constrained_map(boost::make_assoc_property_map(walled.walls)));
  const auto curves = smooth_boundaries(dual, ids.map()), expected = walled.curves(labels);
  ASSERT_EQ(curves.size(), expected.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    ASSERT_EQ(curves[c].points.size(), expected[c].points.size());
    for (std::size_t i = 0; i < curves[c].points.size(); ++i) {
      EXPECT_EQ(curves[c].points[i].halfedge, expected[c].points[i].halfedge);
      EXPECT_EQ(curves[c].points[i].position, expected[c].points[i].position);
      EXPECT_LT((vector(curves[c].points[i].point) - vector(expected[c].points[i].point)).norm(), 1e-14);
    }
  }
}

TEST(SmoothBoundaries, PointsAreThoseOfTheGivenMap) {
  using Wide_point = CGAL::Simple_cartesian<long double>::Point_3;
  const Shape shape = bumpy_torus();
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  Growing_face_labels<Surface_mesh> ids(mesh, random_cells(shape, 5));
  const auto doubled = boost::make_function_property_map<Surface_mesh::Vertex_index>(
      [&](auto v) { return Wide_point(2 * mesh.point(v).x(), 2 * mesh.point(v).y(), 2 * mesh.point(v).z()); });
  const auto np = CGAL::parameters::vertex_point_map(doubled);
  const auto curves = smooth_boundaries(mesh, ids.map(), {}, np);
  static_assert(std::is_same_v<decltype(curves[0].points[0].point), Wide_point>);
  const auto expected = curves_of(mesh, random_cells(shape, 5));
  ASSERT_EQ(curves.size(), expected.size());
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (std::size_t i = 0; i < curves[c].points.size(); ++i) {
      const auto& p = curves[c].points[i].point;
      EXPECT_LT(
          (Eigen::Vector3d(double(p[0]), double(p[1]), double(p[2])) - 2 * vector(expected[c].points[i].point)).norm(),
          1e-9);
    }
}

// ---- How points are joined ----

namespace {

using internal::Curve_joint;
using internal::Curve_node;

double length(const Curve_joint& joint, const std::vector<Curve_node>& nodes) {
  double sum = 0;
  Eigen::Vector3d last = point_of(joint.surface, joint.from);
  for (const Curve_node& node : nodes) {
    sum += (point_of(joint.surface, node) - last).norm();
    last = point_of(joint.surface, node);
  }
  return sum + (point_of(joint.surface, joint.to) - last).norm();
}

Joining_report sum_of_reports(const std::vector<Boundary_curve<Surface_mesh>>& curves) {
  Joining_report sum;
  for (const auto& curve : curves) {
    sum.joints += curve.joining.joints;
    sum.failures += curve.joining.failures;
    EXPECT_TRUE(curve.is_smoothed || curve.joining.joints == 0);
  }
  return sum;
}

}  // namespace

TEST(SmoothBoundaries, GeodesicsAreNoLongerThanTracedLines) {
  std::size_t joints = 0, shorter = 0;
  const double off_the_vertices = 2e-3 * mean_edge_length(meshes::surface_mesh(bumpy_torus()));
  const auto compare = [&](const Curve_joint& joint) {
    const auto nodes = Geodesic_joining()(joint);
    if (nodes) {
      const double traced = length(joint, joint.traced), geodesic = length(joint, *nodes);
      EXPECT_LE(geodesic, traced + off_the_vertices);
      ++joints;
      shorter += geodesic < traced * (1 - 1e-6);
    }
    return nodes;
  };
  for (const double noise : {0.02, 0.1, 0.3}) {
    const Shape shape = meshes::with_noise(meshes::torus(2, 1, 28, 16), noise);
    const Surface_mesh mesh = meshes::surface_mesh(shape);
    Growing_face_labels<Surface_mesh> ids(mesh, random_cells(shape, 12));
    const auto report = sum_of_reports(smooth_boundaries(mesh, ids.map(), {}, compare));
    EXPECT_LE(report.failures, report.joints / 50);
    EXPECT_GT(report.joints, 50u);
  }
  EXPECT_GT(shorter, joints / 10);
}

TEST(SmoothBoundaries, GeodesicsAreStraightWhereTheSurfaceIsLaidOutFlat) {
  for (const double angle : {0., 0.6, -0.6}) {
    const Shape shape = meshes::folded_strip(angle, 10);
    const Surface_mesh mesh = meshes::surface_mesh(shape);
    const Dual_mesh_of dual(mesh);
    std::size_t joints = 0;
    const auto flat = [&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d q = dual.origin() + dual.unit() * p;
      return Eigen::Vector2d(std::copysign(std::hypot(q.x(), q.z()), q.x()), q.y());
    };
    const auto compare = [&](const Curve_joint& joint) {
      auto nodes = Geodesic_joining()(joint);
      EXPECT_TRUE(nodes);
      const double expected =
          (flat(point_of(joint.surface, joint.to)) - flat(point_of(joint.surface, joint.from))).norm() / dual.unit();
      EXPECT_NEAR(length(joint, *nodes), expected, 1e-3 * dual.mean_edge_length()) << "off the vertices";
      ++joints;
      return nodes;
    };
    Boundary_smoothing smoothing;
    smoothing.crease_angle = meshes::pi;
    Growing_face_labels<Surface_mesh> ids(mesh, random_cells(shape, 5));
    smooth_boundaries(mesh, ids.map(), smoothing, compare);
    EXPECT_GT(joints, 20u);
  }
}

TEST(SmoothBoundaries, AJoiningThatFailsIsCountedAndTraced) {
  const Shape shape = bumpy_torus();
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  Growing_face_labels<Surface_mesh> ids(mesh, random_cells(shape, 9));
  const auto traced = smooth_boundaries(mesh, ids.map());
  const auto failed = smooth_boundaries(mesh, ids.map(), {},
                                        [](const Curve_joint&) { return std::optional<std::vector<Curve_node>>(); });
  ASSERT_EQ(traced.size(), failed.size());
  for (std::size_t c = 0; c < traced.size(); ++c) EXPECT_EQ(points_of(traced[c]), points_of(failed[c]));
  EXPECT_EQ(sum_of_reports(traced).failures, 0u);
  EXPECT_EQ(sum_of_reports(failed).failures, sum_of_reports(failed).joints);
  EXPECT_GT(sum_of_reports(traced).joints, 100u);
  EXPECT_EQ(sum_of_reports(traced).joints, sum_of_reports(failed).joints);
}

TEST(SmoothBoundaries, NamedParametersMayFollowAnyArgument) {
  const Shape shape = bumpy_torus();
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  Growing_face_labels<Surface_mesh> ids(mesh, random_cells(shape, 5));
  const auto points = CGAL::parameters::vertex_point_map(mesh.points());
  const auto expected = smooth_boundaries(mesh, ids.map());
  for (const auto& curves :
       {smooth_boundaries(mesh, ids.map(), points), smooth_boundaries(mesh, ids.map(), Boundary_smoothing(), points),
        smooth_boundaries(mesh, ids.map(), Boundary_smoothing(), Traced_joining(), points)}) {
    ASSERT_EQ(curves.size(), expected.size());
    for (std::size_t c = 0; c < curves.size(); ++c) EXPECT_EQ(points_of(curves[c]), points_of(expected[c]));
  }
}

// ---- What cannot be smoothed ----

TEST(SmoothBoundaries, OneSegmentHasNone) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::sphere(2));
  EXPECT_TRUE(curves_of(mesh, Labels(num_faces(mesh), 5)).empty());
  EXPECT_TRUE(curves_of(Surface_mesh(), {}).empty());
}

TEST(SmoothBoundaries, RingsRoundAFaceOrAVertexStay) {
  const Shape shape = meshes::sphere(3);
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  Labels labels(shape.faces.size(), 0);
  labels[100] = 1;
  for (const auto f : CGAL::faces_around_target(mesh.halfedge(Surface_mesh::Vertex_index(300)), mesh)) labels[f] = 2;
  const auto curves = curves_of(mesh, labels);
  ASSERT_EQ(curves.size(), 2u);
  for (const auto& curve : curves) {
    EXPECT_FALSE(curve.is_smoothed);
    for (const auto& p : curve.points) EXPECT_EQ(p.position, 1);
  }
}

TEST(SmoothBoundaries, RingsRoundAVertexOfManyFacesStayOnEitherSide) {
  const Shape shape = meshes::two_spheres_with_neck(3, 0.4, 24);  // with poles
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  for (const std::size_t at_poles : {0u, 1u}) {
    Labels labels(shape.faces.size(), 1 - at_poles);
    for (const auto v : mesh.vertices())
      if (mesh.degree(v) == 24)
        for (const auto f : CGAL::faces_around_target(mesh.halfedge(v), mesh)) labels[f] = at_poles;
    const auto curves = curves_of(mesh, labels);
    ASSERT_EQ(curves.size(), 2u);
    for (const auto& curve : curves) EXPECT_FALSE(curve.is_smoothed);
  }
}

TEST(SmoothBoundaries, BoundaryOfASingleEdgeStays) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::plane(1));
  const auto curves = curves_of(mesh, {0, 1});
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_FALSE(curves[0].is_smoothed);
  EXPECT_EQ(curves[0].points.size(), 2u);
}

TEST(SmoothBoundaries, RunAlongTheRightOneOfTwoEdgesBetweenTheSameVertices) {
  // Two squares that share two edges, and two triangles. Vertex 0, between the shared edges, is cut off from both squares.
  const Shape shape = {{{1, -0.3, -0.3}, {2, 0, 0}, {1, 2, 0}, {0, 0, 0}, {1, 0, 2}},
                       {{0, 1, 2, 3}, {0, 3, 4, 1}, {3, 2, 4}, {2, 1, 4}}};
  Surface_mesh mesh = meshes::surface_mesh(shape);
  const Surface_mesh::Vertex_index apex(0);
  const auto into_apex = CGAL::halfedges_around_target(apex, mesh);
  for (const auto h : std::vector(into_apex.begin(), into_apex.end()))
    CGAL::Euler::split_face(mesh.prev(h), mesh.next(h), mesh);
  const auto ears = CGAL::faces_around_target(mesh.halfedge(apex), mesh);
  for (const std::size_t number : {1U, 2U}) {
    Labels labels(mesh.number_of_faces(), 0);
    for (std::size_t i = 0; i < number; ++i) labels[*std::next(ears.begin(), static_cast<std::ptrdiff_t>(i))] = 1;
    const auto curves = curves_of(mesh, labels);
    ASSERT_EQ(curves.size(), 1U);
    EXPECT_TRUE(curves[0].is_closed);
    EXPECT_EQ(curves[0].points.size(), 4 - number) << "the two ends, and the vertex between them if one ear is left";
  }
}

TEST(SmoothBoundaries, SegmentsOfSingleFacesSurvive) {
  const Shape shape = meshes::sphere(3);
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  Labels labels(shape.faces.size());
  std::iota(labels.begin(), labels.end(), std::size_t(0));
  const auto curves = curves_of(mesh, labels);
  EXPECT_EQ(curves.size(), mesh.number_of_edges());
}

// ---- Meshes ----

template <class Holder>
class SmoothBoundariesOn : public testing::Test {};
TYPED_TEST_SUITE(SmoothBoundariesOn, meshes::Holders);

TYPED_TEST(SmoothBoundariesOn, EveryKindOfMeshGivesTheSame) {
  const Shape shape = bumpy_torus();
  const Labels labels = random_cells(shape, 8);
  const auto expected = curves_of(meshes::surface_mesh(shape), labels);
  const TypeParam held(shape);
  Growing_face_labels<typename TypeParam::Mesh> ids(held.mesh, labels);
  const auto curves = smooth_boundaries(held.mesh, ids.map());
  ASSERT_EQ(curves.size(), expected.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    ASSERT_EQ(curves[c].points.size(), expected[c].points.size());
    for (std::size_t i = 0; i < curves[c].points.size(); ++i)
      EXPECT_LT((vector(curves[c].points[i].point) - vector(expected[c].points[i].point)).norm(), 1e-5);
  }
}

TEST(SmoothBoundaries, MovesWithTheMesh) {
  const Shape shape = bumpy_torus();
  const Labels labels = random_cells(shape, 8);
  const auto curves = curves_of(meshes::surface_mesh(shape), labels);
  const Eigen::Affine3d map = Eigen::Translation3d(50, -20, 30) * Eigen::Scaling(1e3) * meshes::some_rotation();
  const auto moved = curves_of(meshes::surface_mesh(meshes::transformed(shape, map)), labels);
  ASSERT_EQ(curves.size(), moved.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    ASSERT_EQ(curves[c].points.size(), moved[c].points.size());
    for (std::size_t i = 0; i < curves[c].points.size(); ++i)
      EXPECT_LT((map * vector(curves[c].points[i].point) - vector(moved[c].points[i].point)).norm(), 1e3 * 1e-5);
  }
}

// ---- Bad input ----

TEST(SmoothBoundaries, QuadranglesAreRefused) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::cube_of_quads());
  EXPECT_THROW(curves_of(mesh, Labels(6, 0)), std::invalid_argument);
}

TEST(SmoothBoundaries, CoordinatesThatAreNotFiniteAreRefused) {
  Surface_mesh mesh = meshes::surface_mesh(meshes::sphere(1));
  meshes::set_point(mesh, Surface_mesh::Vertex_index(3), {0, std::nan(""), 0});
  EXPECT_THROW(curves_of(mesh, Labels(num_faces(mesh), 0)), std::invalid_argument);
}

TEST(SmoothBoundaries, NumbersOutOfRangeAreRefused) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::sphere(1));
  const Labels labels(num_faces(mesh), 0);
  for (double Boundary_smoothing::*number :
       {&Boundary_smoothing::length, &Boundary_smoothing::tension, &Boundary_smoothing::feature_weight,
        &Boundary_smoothing::crease_angle, &Boundary_smoothing::largest_displacement}) {
    Boundary_smoothing smoothing;
    smoothing.*number = -1;
    EXPECT_THROW(curves_of(mesh, labels, smoothing), std::invalid_argument);
    smoothing.*number = std::nan("");
    EXPECT_THROW(curves_of(mesh, labels, smoothing), std::invalid_argument);
  }
}

TEST(SmoothBoundaries, CallbackCancels) {
  const Shape shape = bumpy_torus();
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  Growing_face_labels<Surface_mesh> ids(mesh, random_cells(shape, 8));
  const std::function<bool(double)> stop = [](double done) { return done < 0.6; };
  EXPECT_THROW(smooth_boundaries(mesh, ids.map(), Boundary_smoothing(), CGAL::parameters::callback(stop)), Cancelled);
}

}  // namespace test_smooth_boundaries
