// SPDX-License-Identifier: MIT

#include <RW_segmentation/Analytic_surface_cost.h>
#include <RW_segmentation/internal/surfaces/rounding_step.h>
#include <RW_segmentation/merge_segments.h>

#include <gtest/gtest.h>
#include "../benchmark/segmentation_measures.h"
#include "face_labels.h"
#include "meshes.h"
#include "solids.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace test_analytic_surface_cost {

using namespace RW_segmentation;
using meshes::Surface_mesh;

namespace {

using Labels = std::vector<std::size_t>;  // in the order of the faces of a shape

meshes::Shape shape_of(const solids::Solid& solid) { return {solid.points, solid.faces}; }

/// The faces of a solid, each cut in two halfway along its longest extent.
Labels halves_of_faces(const solids::Solid& solid) {
  std::vector<Eigen::AlignedBox3d> box(solid.surfaces.size());
  const auto centroid = [&](std::size_t f) {
    const auto& face = solid.faces[f];
    return Eigen::Vector3d((solid.points[face[0]] + solid.points[face[1]] + solid.points[face[2]]) / 3);
  };
  for (std::size_t f = 0; f < solid.faces.size(); ++f) box[solid.label[f]].extend(centroid(f));
  Labels halves;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    Eigen::Index axis = 0;
    const Eigen::AlignedBox3d& whole = box[solid.label[f]];
    whole.sizes().maxCoeff(&axis);
    halves.push_back(2 * solid.label[f] + (centroid(f)[axis] > whole.center()[axis]));
  }
  return halves;
}

Labels merged(const solids::Solid& solid, const Labels& fragments) {
  const Surface_mesh mesh = meshes::surface_mesh(shape_of(solid));
  Face_labels<Surface_mesh> labels(mesh, fragments);
  const auto hierarchy = merge_segments(mesh, labels.map(), Edge_sharpness(mesh), Analytic_surface_cost(mesh));
  hierarchy.segments(Cost_threshold_stop(1), labels.map());
  return labels.values();
}

}  // namespace

TEST(AnalyticSurfaceCost, MergesTheHalvesOfEveryFaceAndNothingElse) {
  const solids::Meshing meshing = solids::even(0.1);
  for (const solids::Solid& solid : {solids::box(meshing), solids::capsule(meshing), solids::pipe_elbow(meshing),
                                     solids::cone_on_cylinder(meshing), solids::blended_slot(meshing)}) {
    const Labels result = merged(solid, halves_of_faces(solid));
    EXPECT_LE(segmentation_measures::Overlaps(result, solid.label).rand_index_error(), 1e-12) << solid.name;
  }
}

TEST(AnalyticSurfaceCost, MergesTheHalvesOfEveryFaceUnderNoise) {
  for (const double edge_length : {0.1, 0.2}) {
    const solids::Solid box = solids::box(solids::even(edge_length));
    EXPECT_EQ(segmentation_measures::Overlaps(merged(solids::with_noise(box, 0.3), halves_of_faces(box)), box.label)
                  .rand_index_error(),
              0);
  }
}

TEST(AnalyticSurfaceCost, OfPartsOfAPlaneIsWhatTheNumberOfTheirVerticesProves) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::plane(6));
  const Dual_mesh_of dual(mesh);
  const Analytic_surface_cost cost(dual, 0);
  const auto region_of = [&](std::size_t f) {
    return cost.region(dual, dual.index(Surface_mesh::Face_index(static_cast<unsigned>(f))));
  };
  const auto region = [&](std::size_t first, std::size_t faces) {
    auto whole = region_of(first);
    for (std::size_t f = first + 1; f < first + faces; ++f) cost.join(whole, region_of(f));
    return whole;
  };
  const Region_boundary boundary = {{1, 0}, {1, 0}};
  for (const std::size_t pairs : {1u, 2u, 3u, 5u}) {  // of triangles along a row
    const double vertices = 2. * static_cast<double>(pairs) + 2;
    const double expected = 3 / (vertices - 3) / (1.5 * 1.5);
    EXPECT_NEAR(cost(region(0, 1), region(1, 2 * pairs - 1), boundary), expected, 1e-6) << pairs;
  }
}

TEST(EdgeSharpness, IsTheAngleAsAPartOf40Degrees) {
  for (const double size : {1., 1e-6, 1e6}) {
    meshes::Shape cube = meshes::cube(2);
    for (auto& p : cube.points) p *= size;
    const Surface_mesh mesh = meshes::surface_mesh(cube);
    const Edge_sharpness sharpness(mesh);
    for (const auto e : mesh.edges()) {
      const auto h = mesh.halfedge(e);
      const auto f = mesh.face(h), g = mesh.face(mesh.opposite(h));
      const bool is_crease = f.idx() / 8 != g.idx() / 8;  // eight faces a side
      EXPECT_NEAR(get(sharpness, e), is_crease ? 90. / 40 : 0, 1e-6);
    }
  }
}

TEST(EdgeSharpness, RefusesNoiseThatIsNoNumber) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::cube());
  for (const double noise : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(Edge_sharpness(mesh, noise), std::invalid_argument);
    EXPECT_THROW(Analytic_surface_cost(mesh, noise), std::invalid_argument);
  }
}

// ---- The noise of the vertices ----

TEST(SurfaceTolerance, EstimatesTheNoiseOfTheVertices) {
  for (const solids::Solid& clean : solids::all(solids::even(0.1)))
    for (const double percent : {0., 0.0005, 0.1, 0.3}) {
      SCOPED_TRACE(clean.name);
      const Surface_mesh mesh = meshes::surface_mesh(shape_of(solids::with_noise(clean, percent)));
      EXPECT_NEAR(internal::surface_tolerance(Dual_mesh_of(mesh), -1).noise, percent / 100, 0.25 * percent / 100);
    }
}

TEST(SurfaceTolerance, EstimatesMostOfNoiseThatMakesFineFacesSharp) {
  constexpr double percent = 0.3;  // an eighth of the edges, so that many of a plane's turn by 60 degrees and more
  const solids::Meshing fine = solids::even(0.05);
  for (const solids::Solid& clean : {solids::flange(fine), solids::capsule(fine)}) {
    const Surface_mesh mesh = meshes::surface_mesh(shape_of(solids::with_noise(clean, percent)));
    const double part = 100 / percent * internal::surface_tolerance(Dual_mesh_of(mesh), -1).noise;
    EXPECT_GE(part, 0.75) << clean.name;
    EXPECT_LE(part, 1.1) << clean.name;
  }
}

TEST(SurfaceTolerance, EstimatesMostOfNoiseThatIsAlikeFromVertexToVertex) {
  const solids::Meshing fine = solids::even(0.05);
  for (const solids::Solid& clean : {solids::box(fine), solids::capsule(fine), solids::cone_on_cylinder(fine)}) {
    const solids::Solid solid = solids::smoothed(solids::with_noise(clean, 0.3), 2);
    std::vector<double> distances;
    for (std::size_t f = 0; f < solid.faces.size(); ++f)
      distances.push_back(solid.surfaces[solid.label[f]].distance(solid.points[solid.faces[f][0]]));
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    const double deviation = *middle / 0.6745 / solid.diagonal();  // of a normal distribution
    const Surface_mesh mesh = meshes::surface_mesh(shape_of(solid));
    EXPECT_NEAR(internal::surface_tolerance(Dual_mesh_of(mesh), -1).noise, deviation, 0.3 * deviation) << clean.name;
  }
}

TEST(SurfaceTolerance, EstimatesMostOfTheNoiseOfDiscsWhoseVerticesAreARing) {
  constexpr double percent = 0.1;
  const solids::Solid clean = solids::cone_on_cylinder(solids::by_kernel());
  for (unsigned seed = 1; seed <= 8; ++seed) {  // with some of them tori about the ring leave half of the noise
    const Surface_mesh mesh = meshes::surface_mesh(shape_of(solids::with_noise(clean, percent, seed)));
    EXPECT_GE(100 / percent * internal::surface_tolerance(Dual_mesh_of(mesh), -1).noise, 0.75) << seed;
  }
}

TEST(SurfaceTolerance, SeesNoNoiseInWhatAKernelMeshes) {
  for (const solids::Solid& solid : solids::all(solids::by_kernel())) {
    const Surface_mesh mesh = meshes::surface_mesh(shape_of(solid));
    EXPECT_EQ(internal::surface_tolerance(Dual_mesh_of(mesh), -1).noise, 0) << solid.name;
  }
}

TEST(SurfaceTolerance, KnowsHowFarCoordinatesWereRounded) {
  for (const solids::Solid& clean : solids::all(solids::even(0.1)))
    for (const double percent : {0.002, 0.01}) {
      SCOPED_TRACE(clean.name);
      const Surface_mesh mesh = meshes::surface_mesh(shape_of(solids::with_rounded_coordinates(clean, percent)));
      // What is spread evenly over a step has a twelfth of its square as variance. Planes along the axes stay exact.
      const double deviation = clean.name == "box" ? 0 : percent / 100 / std::sqrt(12);
      const internal::Surface_tolerance tolerance = internal::surface_tolerance(Dual_mesh_of(mesh), -1);
      EXPECT_NEAR(tolerance.noise, deviation, 0.01 * deviation);
      EXPECT_FALSE(tolerance.is_noisy());
    }
}

TEST(SurfaceTolerance, TakesNoFreeFormOnAGridForARoundedSurface) {
  solids::Builder builder("waves");
  builder.grid(builder.add({}), 40, 40, [](double u, double v) -> solids::Point {
    return {u, v, 0.1 * (std::sin(7 * u + 2 * v) + std::cos(5 * v - 3 * u * v))};
  });
  const solids::Solid waves = std::move(builder).solid();
  const auto noise_of = [](const solids::Solid& solid) {
    const Surface_mesh mesh = meshes::surface_mesh(shape_of(solid));
    return internal::surface_tolerance(Dual_mesh_of(mesh), -1).noise;
  };
  const double before = noise_of(waves);
  for (const double percent : {0.002, 0.01})
    EXPECT_NEAR(noise_of(solids::with_rounded_coordinates(waves, percent)), before, 0.05 * before);
}

// ---- Coordinates that were rounded ----

namespace {

/// In a box whose diagonal is 1, away from the origin.
std::vector<Eigen::Vector3d> points_by_chance(std::size_t number) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(7, 7 + 1 / std::sqrt(3));
  std::vector<Eigen::Vector3d> points(number);
  for (Eigen::Vector3d& p : points)
    for (double& x : p) x = coordinate(random);
  return points;
}

}  // namespace

TEST(RoundingStep, IsTheLongestThatCoordinatesAreMultiplesOf) {
  for (const double step : {2e-5, 1e-4, 3e-3})
    for (const bool is_single : {false, true}) {  // as many formats store it
      std::vector<Eigen::Vector3d> points = points_by_chance(5000);
      for (Eigen::Vector3d& p : points)
        for (double& x : p) {
          const double from_origin = step * std::round((x - 7) / step);
          x = 7 + (is_single ? static_cast<double>(static_cast<float>(from_origin)) : from_origin);
        }
      EXPECT_NEAR(internal::rounding_step(points, 1e-5), step, 0.01 * step) << is_single;
      EXPECT_EQ(internal::rounding_step(points, 2 * step), 0);
    }
}

TEST(RoundingStep, IsNoneWhereCoordinatesAreAny) {
  EXPECT_EQ(internal::rounding_step(points_by_chance(5000), 1e-5), 0);
  EXPECT_EQ(internal::rounding_step(points_by_chance(50), 1e-5), 0);
}

TEST(RoundingStep, IsNoneWhereDifferencesGrowByLittle) {
  std::vector<Eigen::Vector3d> points;
  double x = 0;
  for (double difference = 1e-4; x < 0.5; difference *= 1.03) points.emplace_back(x += difference, 0, 0);
  EXPECT_EQ(internal::rounding_step(points, 1e-5), 0);
}

TEST(RoundingStep, DividesAllDifferencesOfAnyPoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-6.5, -1), number(1, 40);
  for (int i = 0; i < 3000; ++i) {
    std::vector<Eigen::Vector3d> points;
    double x = 0;
    for (const double end = number(random); static_cast<double>(points.size()) < end;)
      points.emplace_back(x += std::pow(10, exponent(random)), 0, 0);
    const double step = internal::rounding_step(points, 5e-7);
    if (step == 0) continue;
    for (std::size_t p = 1; p < points.size(); ++p) {
      const double multiple = (points[p] - points[p - 1]).x() / step;
      if (multiple * step <= 2e-7) continue;  // as good as none
      EXPECT_NEAR(multiple, std::round(multiple), std::max(0.1, 2.1e-7 / step)) << i;
    }
  }
}

TEST(RoundingStep, IsNoneWithoutDifferences) {
  EXPECT_EQ(internal::rounding_step({}, 1e-5), 0);
  EXPECT_EQ(internal::rounding_step({{1, 2, 3}, {1, 2, 3}}, 1e-5), 0);
}

}  // namespace test_analytic_surface_cost
