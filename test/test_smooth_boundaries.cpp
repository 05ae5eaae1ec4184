#include <RW_segmentation/Progress.h>
#include <RW_segmentation/smooth_boundaries.h>

#include <gtest/gtest.h>
#include "boundaries.h"
#include "meshes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>
#include <vector>

using namespace RW_segmentation;
using namespace boundaries;

namespace {

using meshes::Shape;
using meshes::Surface_mesh;

std::vector<Boundary_curve<Surface_mesh>> curves_of(const Surface_mesh& mesh, const Labels& labels,
                                                    const Boundary_smoothing& smoothing = {}) {
  Face_labels<Surface_mesh> ids(mesh, labels);
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
  const auto faces_at = [&](const Boundary_point<Surface_mesh>& p) {
    std::set<Surface_mesh::Face_index> result;
    if (p.position < 1)
      result = {mesh.face(p.halfedge), mesh.face(mesh.opposite(p.halfedge))};
    else
      for (const auto f : CGAL::faces_around_target(p.halfedge, mesh)) result.insert(f);
    return result;
  };
  for (const auto& curve : curves_of(mesh, random_cells(shape, 12)))
    for (std::size_t i = curve.is_closed ? 0 : 1; i < curve.points.size(); ++i) {
      const auto a = faces_at(curve.points[(i + curve.points.size() - 1) % curve.points.size()]);
      const auto b = faces_at(curve.points[i]);
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
  Face_labels<typename TypeParam::Mesh> ids(held.mesh, labels);
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
  Face_labels<Surface_mesh> ids(mesh, random_cells(shape, 8));
  const std::function<bool(double)> stop = [](double done) { return done < 0.6; };
  EXPECT_THROW(smooth_boundaries(mesh, ids.map(), Boundary_smoothing(), CGAL::parameters::callback(stop)), Cancelled);
}
