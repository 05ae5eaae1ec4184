// SPDX-License-Identifier: MIT

// Smoothed normals against a dense solution of the same system, and on shapes whose normals are known.

#include "meshes.h"

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/mesh/Face_corners.h>
#include <RW_segmentation/internal/mesh/Face_diffusion.h>
#include <RW_segmentation/internal/mesh/smoothed_points.h>
#include <RW_segmentation/smoothed_face_normals.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <gtest/gtest.h>

#include <boost/property_map/function_property_map.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace test_smoothed_face_normals {

namespace {

using RW_segmentation::Dual_mesh_of;
using RW_segmentation::Normal_smoothing;
using RW_segmentation::smoothed_face_normals;
using Normals = std::vector<Eigen::Vector3d>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Normal_smoothing without_widening(double radius) { return {radius, infinity, 4}; }

/// The smoothed normals in the order of the faces.
template <class Mesh>
Normals smoothed(const Mesh& mesh, const Normal_smoothing& smoothing = {}) {
  std::map<typename boost::graph_traits<Mesh>::face_descriptor, Eigen::Vector3d> normals;
  smoothed_face_normals(mesh, boost::make_assoc_property_map(normals), smoothing);
  Normals result;
  for (const auto f : faces(mesh)) result.push_back(normals.at(f));
  return result;
}

Normals smoothed(const meshes::Shape& shape, const Normal_smoothing& smoothing = {}) {
  return smoothed(meshes::surface_mesh(shape), smoothing);
}

/// The measures of triangles as the documentation defines them.
struct Triangles {
  std::vector<double> area;
  Normals normal;
  std::map<std::pair<std::size_t, std::size_t>, std::pair<std::size_t, double>> edge;  // ends -> one face, length
  std::vector<std::array<std::size_t, 2>> neighbours;
  std::vector<double> length;
  double total_area = 0;

  explicit Triangles(const meshes::Shape& shape) {
    for (std::size_t i = 0; i < shape.faces.size(); ++i) {
      const auto& f = shape.faces[i];
      const Eigen::Vector3d p = shape.points[f[0]], q = shape.points[f[1]], r = shape.points[f[2]];
      const Eigen::Vector3d cross = (q - p).cross(r - p);
      area.push_back(cross.norm() / 2);
      normal.push_back(cross.normalized());
      total_area += area.back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::pair<std::size_t, std::size_t> ends = std::minmax(f[k], f[(k + 1) % 3]);
        const double l = (shape.points[ends.first] - shape.points[ends.second]).norm();
        const auto [found, fresh] = edge.insert({ends, {i, l}});
        if (fresh) continue;
        neighbours.push_back({found->second.first, i});
        length.push_back(l);
      }
    }
  }
};

/// The solution of (diag(A) + (radius R)^2 Lap) N = diag(A) N0, densely, with more digits and by an elimination that
/// never subtracts: masses keep their digits beside weights of any size. Plain arrays, since builds with sanitizers call
/// every function of a matrix.
Normals dense_solution(const Triangles& t, double radius) {
  const std::size_t n = t.area.size();
  const double mean = t.total_area / static_cast<double>(n);
  std::vector<std::vector<long double>> weights(n, std::vector<long double>(n, 0));
  std::vector<std::array<long double, 3>> solution(n);
  std::vector<long double> mass(n), diagonal(n);
  for (std::size_t i = 0; i < n; ++i) {
    mass[i] = std::max(t.area[i], 1e-4 * mean);
    for (std::size_t x = 0; x < 3; ++x) solution[i][x] = mass[i] * t.normal[i][static_cast<Eigen::Index>(x)];
  }
  for (std::size_t e = 0; e < t.length.size(); ++e) {
    const auto [i, j] = t.neighbours[e];
    const double areas = t.area[i] + t.area[j];
    const double distance = std::max(2. / 3 * areas, 1e-4 * mean) / std::max(t.length[e], 1e-4 * std::sqrt(mean));
    const long double weight = radius * radius * t.total_area * t.length[e] / distance;
    weights[i][j] += weight;
    weights[j][i] += weight;
  }
  for (std::size_t i = 0; i < n; ++i) {  // what i says goes to the rest of its neighbours
    const long double* const link = weights[i].data();
    diagonal[i] = std::accumulate(link + i + 1, link + n, mass[i]);
    for (std::size_t j = i + 1; j < n; ++j) {
      if (link[j] == 0) continue;
      const long double share = link[j] / diagonal[i];
      mass[j] += share * mass[i];
      for (std::size_t x = 0; x < 3; ++x) solution[j][x] += share * solution[i][x];
      long double* const row = weights[j].data();
      for (std::size_t k = j + 1; k < n; ++k) row[k] += share * link[k];  // those above the diagonal are read
    }
  }
  for (std::size_t i = n; i-- > 0;)
    for (std::size_t x = 0; x < 3; ++x) {
      for (std::size_t j = i + 1; j < n; ++j) solution[i][x] += weights[i][j] * solution[j][x];
      solution[i][x] /= diagonal[i];
    }
  Normals result;
  for (const auto& [x, y, z] : solution)
    result.emplace_back(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
  return result;
}

/// The root mean square of the angles between two sets of vectors.
double mean_angle(const Normals& a, const Normals& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i].normalized() - b[i].normalized()).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// The root mean square of the differences of two sets of vectors.
double mean_difference(const Normals& a, const Normals& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// What the solver makes of the faces' own normals.
struct Solution {
  Normals vectors;  ///< in the order of the faces
  std::size_t iterations = 0;
};

Solution solution(const meshes::Shape& shape, double radius, double tolerance, std::size_t shortest_stretch = 75000) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape);
  const Dual_mesh_of dual(mesh);
  Solution result;
  const auto own = [&](std::uint32_t f) { return dual.normal(f); };
  const Normals numbered =
      RW_segmentation::internal::Face_diffusion(dual, radius * radius * dual.total_area(), shortest_stretch)
          .solve(own, own, tolerance, RW_segmentation::Progress([&](double) {
                   ++result.iterations;
                   return true;
                 }));
  result.vectors.resize(numbered.size());
  for (std::uint32_t f = 0; f < numbered.size(); ++f) result.vectors[dual.place(f)] = numbered[f];
  return result;
}

/// A sphere with triangles of every kind: large ones, needles, and caps flatter than a millionth.
meshes::Shape sphere_with_slivers() {
  meshes::Shape shape = meshes::with_noise(meshes::sphere(2), 0.01);
  for (std::size_t f = 0; f < shape.faces.size(); f += 29) {
    const auto& corners = shape.faces[f];
    const Eigen::Vector3d& p = shape.points[corners[0]];
    const Eigen::Vector3d& q = shape.points[corners[1]];
    if (f % 2 == 0)
      shape.points[corners[2]] = (p + q) / 2 + 1e-7 * (shape.points[corners[2]] - (p + q) / 2);
    else
      shape.points[corners[2]] = p + 1e-6 * (shape.points[corners[2]] - p);
  }
  return shape;
}

/// A cube, a closed part of four faces much longer than wide, and three faces like that which hang on the cube by an edge
/// no longer than they are wide.
meshes::Shape cube_with_needles(double width) {
  meshes::Shape needle;
  needle.points = {{0, 0, 0}, {9, 2, 1}, {3, 1, 0}, {6, 1, 1}};
  needle.points[2] = needle.points[1] / 3 + width * needle.points[2];
  needle.points[3] = needle.points[1] / 2 + width * needle.points[3];
  needle.faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  meshes::Shape shape = meshes::together(meshes::cube(3), meshes::moved(needle, {2, 0, 0}));
  const std::vector<std::size_t> corners = shape.faces.front();
  const Eigen::Vector3d root = shape.points[corners[0]];
  const std::size_t beside = shape.points.size(), tip = beside + 1, middle = beside + 2;
  shape.points.push_back(root + width * Eigen::Vector3d(0, 1, 1));
  shape.points.push_back(root + Eigen::Vector3d(-9, 1, 2));
  shape.points.push_back(root + Eigen::Vector3d(-4, 0.5, 1) + width * Eigen::Vector3d(0, 1, 0));
  shape.faces.front() = {beside, corners[1], corners[2]};
  shape.faces.push_back({corners[0], beside, corners[2]});
  shape.faces.push_back({beside, corners[0], tip});
  shape.faces.push_back({beside, tip, middle});
  shape.faces.push_back({tip, corners[0], middle});
  return shape;
}

/// Meshes on which the solver is held against the dense solution.
std::vector<meshes::Shape> various_shapes() {
  return {meshes::with_noise(meshes::sphere(2), 0.02),
          meshes::l_shape(4),
          meshes::with_noise(meshes::tube(4, 12, 14), 0.02),  // with borders
          meshes::together(meshes::cube(3), meshes::moved(meshes::scaled(meshes::sphere(1), 0.1), {5, 0, 0})),
          meshes::together(meshes::cube(3), meshes::moved(meshes::scaled(meshes::folded_strip(1), 1e-3), {5, 0, 0})),
          sphere_with_slivers()};
}

TEST(Smoothed_face_normals, AreTheDenseSolution) {
  for (const meshes::Shape& shape : various_shapes())
    for (const double radius : {0.0005, 0.01, 0.04, 0.1})
      EXPECT_LT(mean_angle(smoothed(shape, without_widening(radius)), dense_solution(Triangles(shape), radius)), 1e-3)
          << shape.faces.size() << " faces, radius " << radius;
}

TEST(Smoothed_face_normals, ComeFromASolverThatConvergesToTheDenseSolution) {
  for (const meshes::Shape& shape : various_shapes())
    for (const double radius : {0.01, 0.1}) {
      const Normals expected = dense_solution(Triangles(shape), radius);
      for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5})
        EXPECT_LT(mean_angle(solution(shape, radius, tolerance).vectors, expected), 5 * tolerance)
            << shape.faces.size() << " faces, radius " << radius;
    }
}

/// A tube of `n` by `n` equal squares, and vectors on it that are sums of waves: diffusion lessens each wave by a factor that
/// has a closed form, since squares round a tube are coupled as the points of a ring, and those along it as those of a path.
struct Waves {
  meshes::Shape tube;
  Normals before, after;  // by square

  Waves(std::size_t n, double radius) {
    const double side = 2 * std::sin(meshes::pi / static_cast<double>(n));
    for (std::size_t along = 0; along <= n; ++along)
      for (std::size_t around = 0; around < n; ++around) {
        const double angle = 2 * meshes::pi * static_cast<double>(around) / static_cast<double>(n);
        tube.points.emplace_back(std::cos(angle), std::sin(angle), side * static_cast<double>(along));
      }
    for (std::size_t along = 0; along < n; ++along)
      for (std::size_t around = 0; around < n; ++around) {
        const std::size_t next = (around + 1) % n, row = n * along;
        tube.faces.push_back({row + around, row + next, row + n + next, row + n + around});
      }
    // The weight |e|^2 / (4/3 A) of the edge of a square of area A = |e|^2, times the square of the length of diffusion.
    const double weight = radius * radius * static_cast<double>(n * n) * 3 / 4;
    before.assign(n * n, Eigen::Vector3d(4, 4, 4));
    after = before;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> phase(0, 2 * meshes::pi);
    for (std::size_t wave = 0; wave < 24; ++wave) {
      const std::size_t most = std::size_t(2) << (wave / 4), around = random() % most, along = random() % most;
      const double turn = 2 * meshes::pi * static_cast<double>(around) / static_cast<double>(n), begin = phase(random);
      const double step = meshes::pi * static_cast<double>(along) / static_cast<double>(n);
      const double factor = 1 / (1 + weight * (4 - 2 * std::cos(turn) - 2 * std::cos(step)));
      for (std::size_t f = 0; f < n * n; ++f) {
        const double height =
            std::cos(step * (static_cast<double>(f / n) + 0.5)) * std::cos(turn * static_cast<double>(f % n) + begin);
        before[f][static_cast<Eigen::Index>(wave % 3)] += height / 3;
        after[f][static_cast<Eigen::Index>(wave % 3)] += factor * height / 3;
      }
    }
  }
};

TEST(Smoothed_face_normals, ComeFromASolverThatKeepsItsToleranceHoweverFarItDiffuses) {
  for (const std::size_t n : {30U, 60U})
    for (const double radius : {0.02, 0.1}) {
      const Waves waves(n, radius);
      const meshes::Surface_mesh mesh = meshes::surface_mesh(waves.tube);
      const Dual_mesh_of dual(mesh);
      Normals before(n * n), after(n * n);
      for (std::uint32_t f = 0; f < n * n; ++f) {
        const std::size_t place = dual.place(f);
        before[f] = waves.before[place];
        after[f] = waves.after[place];
      }
      RW_segmentation::internal::Face_diffusion diffusion(dual, radius * radius * dual.total_area());
      const auto start = [&](std::uint32_t f) { return before[f]; };
      for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
        const Normals found = diffusion.solve(start, start, tolerance, RW_segmentation::Progress());
        double sum = 0;
        for (std::uint32_t f = 0; f < n * n; ++f) sum += (found[f] - after[f]).squaredNorm() / after[f].squaredNorm();
        EXPECT_LE(std::sqrt(sum / static_cast<double>(n * n)), tolerance) << n << " x " << n << ", radius " << radius;
      }
    }
}

TEST(Smoothed_face_normals, ComeFromASolverThatConvergesAsWellWhereStretchesAreSweptAtTheSameTime) {
  std::vector<meshes::Shape> shapes = various_shapes();
  shapes.push_back(meshes::with_noise(meshes::sphere(3), 0.01));
  for (const meshes::Shape& shape : shapes)
    for (const double radius : {0.01, 0.1}) {
      const Solution together = solution(shape, radius, 1e-5), apart = solution(shape, radius, 1e-5, 20);
      EXPECT_LT(mean_angle(apart.vectors, together.vectors), 1e-4) << shape.faces.size() << " faces, radius " << radius;
      EXPECT_LE(apart.iterations, 2 * together.iterations + 4) << shape.faces.size() << " faces, radius " << radius;
    }
}

TEST(Smoothed_face_normals, ComeFromLevelsThatHalveEvenWhereNeighboursAreNumberedFarApart) {
  meshes::Shape sphere = meshes::sphere(4);
  std::shuffle(sphere.faces.begin(), sphere.faces.end(), std::mt19937(3));
  RW_segmentation::internal::Face_corners corners;
  for (const auto& face : sphere.faces) {
    for (const std::size_t corner : face) corners.add(static_cast<std::uint32_t>(corner));
    corners.end_face();
  }
  RW_segmentation::Tile_plan plan;
  plan.total_area = 1;
  const RW_segmentation::Dual_mesh mesh =
      RW_segmentation::internal::part_of(plan, std::move(corners), sphere.points, {});
  const auto own = [&](std::uint32_t f) { return mesh.normal(f); };
  const auto diffused = [&](std::size_t shortest_stretch) {
    RW_segmentation::internal::Face_diffusion diffusion(mesh, 1, shortest_stretch);
    EXPECT_LT(diffusion.number_of_levels(), 10U);
    return diffusion.solve(own, own, 1e-5, RW_segmentation::Progress());
  };
  EXPECT_LT(mean_angle(diffused(100), diffused(1000000)), 1e-4);
}

TEST(Smoothed_face_normals, ComeFromASolverThatSoonConvergesBesideNeedlesOfAnyWidth) {
  for (const double width : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const meshes::Shape shape = cube_with_needles(width);
    for (const double radius : {0.01, 0.04, 1., 100.}) {
      const Solution found = solution(shape, radius, 1e-4);
      EXPECT_LT(mean_difference(found.vectors, dense_solution(Triangles(shape), radius)), 1e-4)
          << "width " << width << ", radius " << radius;
      EXPECT_LT(found.iterations, 40U) << "width " << width << ", radius " << radius;
    }
  }
}

TEST(Smoothed_face_normals, ComeFromASolverThatEndsWhereSinglePrecisionDoes) {
  std::vector<meshes::Shape> shapes = various_shapes();
  meshes::Shape strip = meshes::tube(1, 100, 1);
  for (Eigen::Vector3d& p : strip.points) p = {1e-9 * p.x(), 1e-9 * p.y(), p.z()};
  shapes.push_back(meshes::together(meshes::cube(3), strip));
  for (const meshes::Shape& shape : shapes) {
    const Solution found = solution(shape, 0.04, 1e-30);
    EXPECT_LT(mean_difference(found.vectors, dense_solution(Triangles(shape), 0.04)), 1e-6)
        << shape.faces.size() << " faces";
    EXPECT_LT(found.iterations, 500U) << shape.faces.size() << " faces";
  }
}

TEST(Smoothed_face_normals, ComeFromLevelsThatHalveEvenRoundAFaceWithManyNeighbours) {
  constexpr std::size_t sides = 3000;
  meshes::Shape cone;
  cone.faces.emplace_back();
  for (std::size_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::acos(-1.) * static_cast<double>(i) / sides;
    cone.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    cone.faces.front().push_back(sides - 1 - i);
    cone.faces.push_back({i, (i + 1) % sides, sides});
  }
  cone.points.emplace_back(0, 0, 1);
  for (const meshes::Shape& shape : {cone, meshes::sphere(4)}) {
    const meshes::Surface_mesh mesh = meshes::surface_mesh(shape);
    const Dual_mesh_of dual(mesh);
    const RW_segmentation::internal::Face_diffusion diffusion(dual, 100 * dual.total_area());
    EXPECT_LE(static_cast<double>(diffusion.number_of_levels()), 1 + std::log2(dual.number_of_faces()));
    EXPECT_GE(diffusion.number_of_levels(), 3u);
  }
}

TEST(Smoothed_face_normals, OfAPlaneStayAsTheyAre) {
  const meshes::Shape plane = meshes::transformed(meshes::plane(8), meshes::some_rotation());
  const Eigen::Vector3d up = meshes::some_rotation().linear() * Eigen::Vector3d::UnitZ();
  for (const Eigen::Vector3d& n : smoothed(plane)) EXPECT_LT((n - up).norm(), 1e-12);
}

TEST(Smoothed_face_normals, OfASphereStayRadial) {
  const meshes::Shape sphere = meshes::sphere(4);
  for (const double radius : {0.01, 0.05}) {
    const Normals normals = smoothed(sphere, without_widening(radius));
    for (std::size_t f = 0; f < normals.size(); ++f) {
      Eigen::Vector3d radial = Eigen::Vector3d::Zero();
      for (const std::size_t corner : sphere.faces[f]) radial += sphere.points[corner];
      EXPECT_LT((normals[f] - radial.normalized()).norm(), 1e-2);
    }
  }
}

TEST(Smoothed_face_normals, LoseNoise) {
  const meshes::Shape sphere = meshes::sphere(4), noisy = meshes::with_noise(sphere, 0.01);
  const Triangles clean(sphere), rough(noisy);
  EXPECT_LT(mean_angle(smoothed(noisy), clean.normal), mean_angle(rough.normal, clean.normal) / 3);
}

TEST(Smoothed_face_normals, RecogniseNoiseAndWiden) {
  const meshes::Shape noisy = meshes::with_noise(meshes::sphere(4), 0.01);
  const Normals own = smoothed(noisy, without_widening(0));
  const Normals first = smoothed(noisy, without_widening(0.01));
  std::vector<double> turn;
  for (std::size_t f = 0; f < own.size(); ++f) turn.push_back((first[f] - own[f]).norm());
  std::nth_element(turn.begin(), turn.begin() + 2560, turn.end());
  const double widening = turn[2560] / 0.1;
  ASSERT_GT(widening, 1.2);
  ASSERT_LT(widening, 4);

  EXPECT_LT(mean_angle(smoothed(noisy), smoothed(noisy, without_widening(0.01 * widening))), 1e-3);
  EXPECT_LT(mean_angle(smoothed(noisy, {0.01, 0.01, 3, infinity}), smoothed(noisy, without_widening(0.03))), 1e-3);
}

TEST(Smoothed_face_normals, TellTheShapeUnderHeavyNoiseByItsVertices) {
  const meshes::Shape torus = meshes::torus(2, 0.7, 80, 40), rough = meshes::with_noise(torus, 0.03);
  const Normals truth = Triangles(torus).normal;
  Normal_smoothing by_normals_alone;
  by_normals_alone.heavy_noise = infinity;
  EXPECT_LT(mean_angle(smoothed(rough), truth), 0.9 * mean_angle(smoothed(rough, by_normals_alone), truth));
}

TEST(Smoothed_face_normals, KeepTheBorderInPlaceUnderHeavyNoise) {
  const meshes::Shape rough = meshes::with_noise(meshes::plane(20), 0.02);
  const meshes::Surface_mesh mesh = meshes::surface_mesh(rough);
  const Dual_mesh_of dual(mesh);
  const Normals smoothed_points = RW_segmentation::internal::smoothed_points(dual, 3);
  std::size_t moved = 0;
  for (std::uint32_t f = 0; f < dual.number_of_faces(); ++f) {
    auto h = mesh.halfedge(dual.face(f));
    for (const auto v : dual.corners(f)) {
      if (mesh.is_border(mesh.target(h))) {
        EXPECT_EQ(smoothed_points[v], dual.point(v));
      }
      h = mesh.next(h);
    }
  }
  for (std::uint32_t v = 0; v < dual.number_of_vertices(); ++v) moved += smoothed_points[v] != dual.point(v);
  EXPECT_EQ(moved, 19u * 19u);
}

TEST(Smoothed_face_normals, DoNotWidenWithoutNoise) {
  const meshes::Shape torus = meshes::torus(2, 0.7, 80, 40);
  EXPECT_EQ(smoothed(torus), smoothed(torus, without_widening(0.01)));
}

TEST(Smoothed_face_normals, WithRadiusZeroAreTheFacesOwn) {
  const meshes::Shape shape = meshes::with_noise(meshes::l_shape(2), 0.05);
  const Triangles triangles(shape);
  const Normals result = smoothed(shape, {0, 0.01, 4});
  for (std::size_t f = 0; f < result.size(); ++f) EXPECT_LT((result[f] - triangles.normal[f]).norm(), 1e-12);
}

TEST(Smoothed_face_normals, DoNotDependOnScaleOrPlace) {
  meshes::Shape shape = meshes::with_noise(meshes::torus(2, 0.7, 24, 12), 0.01);
  for (Eigen::Vector3d& p : shape.points)
    for (double& x : p) x = std::round(1024 * x) / 1024;  // so that moving is exact
  const Normals expected = smoothed(shape);
  for (const double factor : {1e150, 1e-160, 3e-5})
    EXPECT_LT(mean_angle(smoothed(meshes::scaled(shape, factor)), expected), 1e-6);
  EXPECT_LT(mean_angle(smoothed(meshes::moved(shape, {1e8, -2e8, 0})), expected), 1e-6);
}

TEST(Smoothed_face_normals, TurnWithTheShape) {
  const meshes::Shape shape = meshes::with_noise(meshes::l_shape(4), 0.02);
  Normals expected = smoothed(shape);
  for (Eigen::Vector3d& n : expected) n = meshes::some_rotation().linear() * n;
  EXPECT_LT(mean_angle(smoothed(meshes::transformed(shape, meshes::some_rotation())), expected), 1e-4);
}

TEST(Smoothed_face_normals, OfFacesWithoutAreaAreThoseOfTheirSurroundings) {
  meshes::Shape shape = meshes::transformed(meshes::plane(3), meshes::some_rotation());
  shape.points[5] = shape.points[6];  // between two inner vertices
  const Eigen::Vector3d up = meshes::some_rotation().linear() * Eigen::Vector3d::UnitZ();
  const Triangles triangles(shape);
  EXPECT_LT(*std::min_element(triangles.area.begin(), triangles.area.end()), 1e-15);
  for (const Eigen::Vector3d& n : smoothed(shape)) EXPECT_LT((n - up).norm(), 1e-3);
}

TEST(Smoothed_face_normals, OfAFlatMeshAreNotChangedByFacesThatArePoints) {
  meshes::Shape shape = meshes::plane(4);
  for (const std::size_t v : {7u, 11u, 12u}) shape.points[v] = shape.points[6];  // a square
  for (unsigned order = 1; order <= 10; ++order) {
    const auto faces_in_order = meshes::random_order(shape.faces.size(), order);
    std::size_t unknown = 0;
    for (const Eigen::Vector3d& n : smoothed(meshes::with_faces_in_order(shape, faces_in_order))) {
      if (n.norm() == 0)
        ++unknown;
      else
        EXPECT_LT((n - Eigen::Vector3d::UnitZ()).norm(), 1e-6);
    }
    EXPECT_LE(unknown, 2U);
  }
}

TEST(Smoothed_face_normals, OfAFaceAloneAreItsOwnOrZero) {
  meshes::Shape shape;
  shape.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {7, 0, 0}};
  shape.faces = {{0, 1, 2}, {3, 4, 5}};
  const Normals normals = smoothed(shape);
  EXPECT_LT((normals[0] - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_EQ(normals[1].norm(), 0);
}

TEST(Smoothed_face_normals, OfAPartMuchSmallerThanTheRadiusAreItsOwn) {
  const meshes::Shape speck = meshes::moved(meshes::scaled(meshes::l_shape(), 0.01), {2, 0, 0});
  const Normals normals = smoothed(meshes::together(speck, meshes::cube(4)), without_widening(0.3));
  const Normals own = Triangles(speck).normal;
  for (std::size_t f = 0; f < own.size(); ++f) EXPECT_LT((normals[f] - own[f]).norm(), 1e-9);
}

TEST(Smoothed_face_normals, AreOneDirectionForEachComponentWhereTheRadiusIsHuge) {
  const Normals normals = smoothed(meshes::folded_strip(1, 4), without_widening(1e100));
  for (const Eigen::Vector3d& n : normals) EXPECT_LT((n - normals[0]).norm(), 1e-2);
}

TEST(Smoothed_face_normals, OfAMeshWithoutFacesAreNone) { EXPECT_TRUE(smoothed(meshes::Surface_mesh()).empty()); }

TEST(Smoothed_face_normals, OfAMeshWithoutAreaAreZero) {
  meshes::Shape shape = meshes::plane(2);
  for (Eigen::Vector3d& p : shape.points) p.setConstant(2);
  for (const Eigen::Vector3d& n : smoothed(shape)) EXPECT_EQ(n.norm(), 0);
}

TEST(Smoothed_face_normals, AreNotWrittenWhenANumberIsImpossible) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(meshes::cube());
  std::map<meshes::Surface_mesh::Face_index, Eigen::Vector3d> normals;
  const auto map = boost::make_assoc_property_map(normals);
  for (const Normal_smoothing& smoothing :
       {Normal_smoothing{-0.1, 0.1, 4}, Normal_smoothing{nan, 0.1, 4}, Normal_smoothing{infinity, 0.1, 4},
        Normal_smoothing{0.01, 0, 4}, Normal_smoothing{0.01, nan, 4}, Normal_smoothing{0.01, 0.1, 0.9},
        Normal_smoothing{0.01, 0.1, nan}})
    EXPECT_THROW(smoothed_face_normals(mesh, map, smoothing), std::invalid_argument);
  EXPECT_TRUE(normals.empty());
}

TEST(Smoothed_face_normals, CanBeCancelled) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::sphere(3), 0.02));
  std::map<meshes::Surface_mesh::Face_index, Eigen::Vector3d> normals;
  std::vector<double> fractions;
  const std::function<bool(double)> watch = [&](double fraction) {
    fractions.push_back(fraction);
    return true;
  };
  smoothed_face_normals(mesh, boost::make_assoc_property_map(normals), {}, CGAL::parameters::callback(watch));
  ASSERT_FALSE(fractions.empty());
  for (const double fraction : fractions) {
    EXPECT_GE(fraction, 0);
    EXPECT_LE(fraction, 1);
  }
  EXPECT_EQ(fractions.back(), 1);

  normals.clear();
  const std::function<bool(double)> cancel = [](double) { return false; };
  EXPECT_THROW(
      smoothed_face_normals(mesh, boost::make_assoc_property_map(normals), {}, CGAL::parameters::callback(cancel)),
      RW_segmentation::Cancelled);
  EXPECT_TRUE(normals.empty());
}

template <class Holder>
class Smoothed_face_normals_of : public testing::Test {};
TYPED_TEST_SUITE(Smoothed_face_normals_of, meshes::Holders);

TYPED_TEST(Smoothed_face_normals_of, AnyMeshAreTheSameUnitVectors) {
  for (const meshes::Shape& shape : {meshes::with_noise(meshes::tube(4, 12, 14), 0.02), meshes::l_shape(3)}) {
    const TypeParam held(shape);
    const Normals normals = smoothed(held.mesh);
    const Normals expected = smoothed(shape);
    ASSERT_EQ(normals.size(), expected.size());
    for (std::size_t f = 0; f < normals.size(); ++f) {
      EXPECT_NEAR(normals[f].norm(), 1, 1e-12);
      EXPECT_LT((normals[f] - expected[f]).norm(), 1e-3);
    }
  }
}

TYPED_TEST(Smoothed_face_normals_of, AnyMeshNameAVertexThatIsNotFinite) {
  meshes::Shape shape = meshes::plane(2);
  shape.points[4].z() = nan;
  const TypeParam held(shape);
  try {
    smoothed(held.mesh);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("vertex 4 "), std::string::npos) << error.what();
  }
}

TEST(Smoothed_face_normals, AreWrittenAsVectorsOfTheKernel) {
  meshes::Surface_mesh mesh = meshes::surface_mesh(meshes::cube(2));
  const auto normals = mesh.add_property_map<meshes::Surface_mesh::Face_index, meshes::Kernel::Vector_3>("f:n").first;
  smoothed_face_normals(mesh, normals);
  for (const auto f : mesh.faces()) EXPECT_NEAR(normals[f].squared_length(), 1, 1e-12);
}

}  // namespace

}  // namespace test_smoothed_face_normals
