// SPDX-License-Identifier: MIT

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Surface_samples.h>
#include <RW_segmentation/internal/surfaces/Principal_axes.h>

#include <gtest/gtest.h>
#include "solids.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace test_analytic_surface {

using namespace RW_segmentation;
using Eigen::Vector3d;

namespace {

constexpr double pi = 3.14159265358979323846;

/// A piece of a surface, by two parameters from 0 to 1: a point and the normal there.
struct Piece {
  Analytic_surface surface;
  std::function<Vector3d(double, double)> point;
};

Vector3d on_circle(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

/// Pieces in a position that is parallel to nothing; `part` of a full turn, and of the height or the other turn.
std::vector<Piece> pieces(double part) {
  const Eigen::Affine3d place =
      Eigen::Translation3d(0.4, -0.2, 0.3) * Eigen::AngleAxisd(0.7, Vector3d(0.3, -0.5, 0.8).normalized());
  const auto turn = [=](double u) { return 2 * pi * part * u; };
  std::vector<Piece> result(5);
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i].surface.type = analytic_types[i];
    result[i].surface.point = place.translation();
    result[i].surface.direction = place.linear().col(2);
  }
  result[0].point = [=](double u, double v) { return place * Vector3d(u, v, 0); };
  result[1].surface.radius = 0.7;
  result[1].point = [=](double u, double v) -> Vector3d {
    const double height = -0.5 + part * v;
    return place * Vector3d(0.7 * (std::sqrt(1 - height * height) * on_circle(turn(u)) + height * Vector3d::UnitZ()));
  };
  result[2].surface.radius = 0.5;
  result[2].point = [=](double u, double v) -> Vector3d {
    return place * Vector3d(0.5 * on_circle(turn(u)) + v * Vector3d::UnitZ());
  };
  result[3].surface.half_angle = 0.4;
  result[3].point = [=](double u, double v) -> Vector3d {
    const double height = 0.5 + v;
    return place * Vector3d(height * std::tan(0.4) * on_circle(turn(u)) + height * Vector3d::UnitZ());
  };
  result[4].surface.radius = 1;
  result[4].surface.tube_radius = 0.3;
  result[4].point = [=](double u, double v) -> Vector3d {
    const double across = turn(v);
    return place *
           Vector3d((1 + 0.3 * std::cos(across)) * on_circle(turn(u)) + 0.3 * std::sin(across) * Vector3d::UnitZ());
  };
  return result;
}

/// A grid of points on a piece, with its normals, displaced by normal deviates.
Surface_samples samples_of(const Piece& piece, double deviation = 0, std::size_t n = 12) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 1);
  const auto displaced = [&](Vector3d p, double by) {
    for (double& x : p) x += by * noise(random);
    return p;
  };
  Surface_samples samples;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double u = static_cast<double>(i) / static_cast<double>(n - 1);
      const double v = static_cast<double>(j) / static_cast<double>(n - 1);
      const Vector3d p = piece.point(u, v);
      samples.points.push_back(displaced(p, deviation));
      samples.normal_points.push_back(p);
      samples.normals.push_back(displaced(piece.surface.normal(p), 10 * deviation).normalized());
    }
  return samples;
}

void expect_same(const Analytic_surface& found, const Analytic_surface& truth, double tolerance) {
  ASSERT_EQ(found.type, truth.type);
  const Vector3d shift = found.point - truth.point;
  const double between_axes = found.direction.cross(truth.direction).norm();
  EXPECT_LT(truth.type == Surface_type::sphere ? 0 : between_axes, tolerance);
  switch (truth.type) {
    case Surface_type::plane:
      EXPECT_LT(std::abs(shift.dot(truth.direction)), tolerance);
      break;
    case Surface_type::cylinder:
      EXPECT_LT(shift.cross(truth.direction).norm(), tolerance);
      break;
    default:
      EXPECT_LT(shift.norm(), tolerance);
  }
  EXPECT_NEAR(found.radius, truth.radius, tolerance);
  EXPECT_NEAR(found.tube_radius, truth.tube_radius, tolerance);
  EXPECT_NEAR(found.half_angle, truth.half_angle, tolerance);
}

}  // namespace

// ---- Surfaces ----

TEST(PrincipalAxes, AreThoseOfEigen) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (Eigen::Index n = 1; n <= 7; ++n)
    for (const double least : {1., 1e-8, 0.}) {
      Eigen::MatrixXd factor(n, 3 * n);
      for (double& x : factor.reshaped()) x = normal(random);
      factor.row(0) *= least;
      const Eigen::MatrixXd matrix = factor * factor.transpose();
      const internal::Principal_axes axes(matrix);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> expected(matrix);
      const double rounding = 1e-14 * matrix.norm();
      EXPECT_LE((axes.values() - expected.eigenvalues()).cwiseAbs().maxCoeff(), rounding);
      EXPECT_TRUE(axes.vectors().isUnitary(1e-13));
      const Eigen::MatrixXd scaled = axes.vectors() * axes.values().asDiagonal();
      EXPECT_LE((matrix * axes.vectors() - scaled).cwiseAbs().maxCoeff(), rounding);
    }
}

TEST(AnalyticSurface, NormalIsTheGradientOfTheDistance) {
  for (const Piece& piece : pieces(0.3)) {
    const Vector3d p = piece.point(0.3, 0.6) + Vector3d(0.02, 0.03, -0.01);
    const double step = 1e-6;
    Vector3d gradient;
    for (int i = 0; i < 3; ++i)
      gradient[i] = (piece.surface.signed_distance(p + step * Vector3d::Unit(i)) -
                     piece.surface.signed_distance(p - step * Vector3d::Unit(i))) /
                    (2 * step);
    EXPECT_LT((gradient - piece.surface.normal(p)).norm(), 1e-8) << degrees_of_freedom(piece.surface.type);
  }
}

TEST(AnalyticSurface, DistanceVanishesOnTheSurfaceAndGrowsAlongTheNormal) {
  for (const Piece& piece : pieces(0.3)) {
    const Vector3d p = piece.point(0.4, 0.7);
    EXPECT_NEAR(piece.surface.signed_distance(p), 0, 1e-14);
    EXPECT_NEAR(piece.surface.signed_distance(p + 0.01 * piece.surface.normal(p)), 0.01, 1e-14);
  }
}

// ---- Fits of a known type ----

TEST(FitOfAType, RecoversTheSurfaceOfExactPoints) {
  for (const double part : {0.25, 0.9})
    for (const Piece& piece : pieces(part)) {
      SCOPED_TRACE(testing::Message() << degrees_of_freedom(piece.surface.type) << " numbers, part " << part);
      const auto found = fit_analytic_surface(piece.surface.type, samples_of(piece));
      ASSERT_TRUE(found);
      expect_same(*found, piece.surface, 1e-7);
      EXPECT_LT(found->residual, 1e-8);
    }
}

TEST(FitOfAType, RecoversTheSurfaceOfNoisyPoints) {
  const double deviation = 0.003;
  for (const Piece& piece : pieces(0.5)) {
    SCOPED_TRACE(testing::Message() << degrees_of_freedom(piece.surface.type) << " numbers");
    const auto found = fit_analytic_surface(piece.surface.type, samples_of(piece, deviation));
    ASSERT_TRUE(found);
    expect_same(*found, piece.surface, 5 * deviation);
    EXPECT_NEAR(found->residual, deviation, 0.2 * deviation);
  }
}

TEST(FitOfAType, IsTheLeastSquaresSurface) {
  const double step = 1e-4;
  for (const Piece& piece : pieces(0.5)) {
    const Surface_samples samples = samples_of(piece, 0.01);
    const auto found = fit_analytic_surface(piece.surface.type, samples);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->residual, root_mean_square_distance(*found, samples.points), 1e-12);
    const auto expect_no_better = [&](const std::function<void(Analytic_surface&)>& change) {
      Analytic_surface changed = *found;
      change(changed);
      EXPECT_GT(root_mean_square_distance(changed, samples.points), found->residual * (1 - 1e-6))
          << degrees_of_freedom(piece.surface.type) << " numbers";
    };
    for (const double by : {-step, step}) {
      for (int i = 0; i < 3; ++i) {
        expect_no_better([&](Analytic_surface& s) { s.point += by * Vector3d::Unit(i); });
        expect_no_better(
            [&](Analytic_surface& s) { s.direction = (s.direction + by * Vector3d::Unit(i)).normalized(); });
      }
      expect_no_better([&](Analytic_surface& s) { s.radius += by; });
      expect_no_better([&](Analytic_surface& s) { s.tube_radius += by; });
      expect_no_better([&](Analytic_surface& s) { s.half_angle += by; });
    }
  }
}

TEST(FitOfAType, ManagesAnEighthOfATurn) {
  for (const Piece& piece : pieces(0.125)) {
    SCOPED_TRACE(testing::Message() << degrees_of_freedom(piece.surface.type) << " numbers");
    const auto found = fit_analytic_surface(piece.surface.type, samples_of(piece));
    ASSERT_TRUE(found);
    expect_same(*found, piece.surface, 1e-5);
  }
}

TEST(FitOfAType, RefusesTooFewPointsAndFlatOnes) {
  const Piece flat = pieces(1)[0];
  for (const Surface_type type : analytic_types) {
    EXPECT_FALSE(fit_analytic_surface(type, {}));
    Surface_samples few = samples_of(flat);
    few.points.resize(static_cast<std::size_t>(degrees_of_freedom(type)) - 1);
    EXPECT_FALSE(fit_analytic_surface(type, few));
    if (type == Surface_type::plane) continue;
    const auto found = fit_analytic_surface(type, samples_of(flat));
    EXPECT_TRUE(!found || std::isfinite(found->residual));  // a huge or a degenerate one
  }
}

TEST(FitOfAType, IsTheSameWithinALargestResidualAndNoneBeyondIt) {
  for (const Piece& piece : pieces(0.5)) {
    const Surface_samples samples = samples_of(piece, 0.01);
    const auto found = fit_analytic_surface(piece.surface.type, samples);
    ASSERT_TRUE(found);
    const auto within = fit_analytic_surface(piece.surface.type, samples, 1.01 * found->residual);
    ASSERT_TRUE(within);
    expect_same(*within, *found, 1e-12);
    EXPECT_FALSE(fit_analytic_surface(piece.surface.type, samples, 0.99 * found->residual));
    EXPECT_FALSE(fit_analytic_surface(piece.surface.type, samples, 1e-6));
  }
}

TEST(FitOfAType, SurvivesPointsThatCoincideOrLieOnALine) {
  Surface_samples point, line;
  for (int i = 0; i < 20; ++i) {
    point.points.push_back(Vector3d::Zero());
    line.points.push_back(i * Vector3d::UnitX());
  }
  for (Surface_samples* samples : {&point, &line}) {
    samples->normal_points = samples->points;
    samples->normals.assign(20, Vector3d::UnitZ());
    for (const Surface_type type : analytic_types) {
      const auto found = fit_analytic_surface(type, *samples);
      EXPECT_TRUE(!found || (std::isfinite(found->residual) && found->point.allFinite()));
    }
  }
}

// ---- Fits of any type ----

TEST(FitOfAnyType, FindsTheType) {
  for (const double part : {0.25, 0.5})
    for (const Piece& piece : pieces(part)) {
      EXPECT_EQ(fit_analytic_surface(samples_of(piece), 1e-6).type, piece.surface.type);
      EXPECT_EQ(fit_analytic_surface(samples_of(piece, 0.001), 0.001).type, piece.surface.type);
    }
}

TEST(FitOfAnyType, CallsWhatNoneFitsAFreeForm) {
  Surface_samples saddle;
  for (int i = -6; i <= 6; ++i)
    for (int j = -6; j <= 6; ++j) {
      const double x = i / 6., y = j / 6.;
      saddle.points.emplace_back(x, y, x * x * x - y * y);
      saddle.normal_points.push_back(saddle.points.back());
      saddle.normals.push_back(Vector3d(-3 * x * x, 2 * y, 1).normalized());
    }
  EXPECT_EQ(fit_analytic_surface(saddle, 1e-3).type, Surface_type::free_form);
}

// ---- The solids that other tests rely on ----

TEST(Solids, AreClosedAndOrientedOutward) {
  for (const auto& meshing : {solids::even(0.15), solids::by_kernel()})
    for (const solids::Solid& solid : solids::all(meshing)) {
      SCOPED_TRACE(solid.name);
      std::map<std::pair<std::size_t, std::size_t>, int> sides;
      double volume = 0;
      for (const auto& face : solid.faces) {
        for (std::size_t k = 0; k < 3; ++k) ++sides[{face[k], face[(k + 1) % 3]}];
        volume += solid.points[face[0]].dot(solid.points[face[1]].cross(solid.points[face[2]])) / 6;
      }
      EXPECT_GT(volume, 1);
      for (const auto& [side, number] : sides) {
        ASSERT_EQ(number, 1);
        ASSERT_TRUE(sides.count({side.second, side.first}));
      }
    }
}

TEST(Solids, HaveTheirVerticesOnTheirSurfaces) {
  for (const auto& meshing : {solids::even(0.15), solids::by_kernel()})
    for (const solids::Solid& solid : solids::all(meshing))
      for (std::size_t f = 0; f < solid.faces.size(); ++f)
        for (const std::size_t v : solid.faces[f])
          ASSERT_LT(solid.surfaces[solid.label[f]].distance(solid.points[v]), 1e-12) << solid.name;
}

}  // namespace test_analytic_surface
