// SPDX-License-Identifier: MIT

#include "meshes.h"

#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/coarse_seeds.h>

#include <boost/property_map/function_property_map.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace test_coarse_seeds {

namespace {

using namespace RW_segmentation;
using meshes::Shape;

constexpr double infinity = std::numeric_limits<double>::infinity();

using Matrix = std::vector<std::vector<double>>;

/// The places of faces in the order of `faces(mesh)`.
template <class Mesh, class Faces>
std::vector<std::size_t> places(const Mesh& mesh, const Faces& descriptors) {
  std::map<typename boost::graph_traits<Mesh>::face_descriptor, std::size_t> place;
  for (const auto f : faces(mesh)) place.emplace(f, place.size());
  std::vector<std::size_t> result;
  for (const auto f : descriptors) result.push_back(place.at(f));
  return result;
}

/// Coarse seeds as places of faces, with their separations.
struct Seeds {
  std::vector<std::size_t> faces;
  std::vector<double> separations;
};

template <class Mesh, class Difference, class Stop>
Seeds seeds_of(const Mesh& mesh, const Difference& difference, const Stop& stop) {
  Seeds seeds;
  std::vector<typename boost::graph_traits<Mesh>::face_descriptor> found;
  const auto observe = [&](const std::vector<double>& separations) {
    seeds.separations = separations;
    return stop(separations);
  };
  coarse_seeds(mesh, difference, observe, std::back_inserter(found));
  seeds.faces = places(mesh, found);
  seeds.separations.resize(found.size());  // without that of the discarded candidate
  return seeds;
}

template <class Mesh, class Stop>
Seeds seeds_of(const Mesh& mesh, const Stop& stop) {
  return seeds_of(mesh, Dihedral_difference(mesh), stop);
}

std::vector<std::size_t> seeds_of_shape(const Shape& shape, std::size_t count) {
  return seeds_of(meshes::surface_mesh(shape), Seed_count_stop(count)).faces;
}

/// Two faces with a common edge, and what it costs to go from one to the other.
struct Step {
  std::size_t f, g;
  double cost;
};

/// The least sums of costs over all paths between all pairs of faces (Floyd and Warshall).
Matrix all_path_sums(std::size_t faces, const std::vector<Step>& steps) {
  Matrix sum(faces, std::vector<double>(faces, infinity));
  for (std::size_t i = 0; i < faces; ++i) sum[i][i] = 0;
  for (const auto& [f, g, cost] : steps) sum[f][g] = sum[g][f] = std::min(sum[f][g], cost);
  for (std::size_t k = 0; k < faces; ++k)
    for (std::size_t i = 0; i < faces; ++i)
      for (std::size_t j = 0; j < faces; ++j) sum[i][j] = std::min(sum[i][j], sum[i][k] + sum[k][j]);
  return sum;
}

template <class Mesh, class Difference>
Matrix all_differences(const Mesh& mesh, const Difference& difference) {
  std::vector<Step> steps;
  for (const auto e : edges(mesh)) {
    const auto h = halfedge(e, mesh);
    if (CGAL::is_border_edge(h, mesh)) continue;
    const auto ends = places(mesh, std::vector{face(h, mesh), face(opposite(h, mesh), mesh)});
    steps.push_back({ends[0], ends[1], get(difference, e)});
  }
  return all_path_sums(num_faces(mesh), steps);
}

std::vector<Eigen::Vector3d> centroids(const Shape& shape) {
  std::vector<Eigen::Vector3d> result;
  for (const auto& face : shape.faces) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::size_t corner : face) sum += shape.points[corner];
    result.push_back(sum / static_cast<double>(face.size()));
  }
  return result;
}

/// The lengths of the shortest paths over centroids.
Matrix geodesic_distances(const Shape& shape) {
  const auto centroid = centroids(shape);
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> face_of_side;
  for (std::size_t f = 0; f < shape.faces.size(); ++f)
    for (std::size_t k = 0; k < shape.faces[f].size(); ++k)
      face_of_side[{shape.faces[f][k], shape.faces[f][(k + 1) % shape.faces[f].size()]}] = f;
  std::vector<Step> steps;
  for (const auto& [side, f] : face_of_side) {
    const auto other = face_of_side.find({side.second, side.first});
    if (other != face_of_side.end())
      steps.push_back({f, other->second, (centroid[f] - centroid[other->second]).norm()});
  }
  return all_path_sums(shape.faces.size(), steps);
}

double least_to(const Matrix& sums, std::size_t face, const std::vector<std::size_t>& seeds) {
  double least = infinity;
  for (const std::size_t seed : seeds) least = std::min(least, sums[face][seed]);
  return least;
}

double largest_least(const Matrix& sums, const std::vector<std::size_t>& seeds) {
  double largest = 0;
  for (std::size_t f = 0; f < sums.size(); ++f) largest = std::max(largest, least_to(sums, f, seeds));
  return largest;
}

std::vector<std::size_t> first(const std::vector<std::size_t>& seeds, std::size_t number) {
  return {seeds.begin(), seeds.begin() + static_cast<std::ptrdiff_t>(number)};
}

/// A sphere whose bumps make all differences and distances unlike.
Shape bumpy_sphere() { return meshes::with_noise(meshes::sphere(1), 0.05); }

/// A difference of the same value on all edges.
auto constant_difference(double value) {
  return boost::make_function_property_map<meshes::Surface_mesh::Edge_index>(
      [value](meshes::Surface_mesh::Edge_index) { return value; });
}

template <class Holder>
class Coarse_seeds_on : public testing::Test {};
TYPED_TEST_SUITE(Coarse_seeds_on, meshes::Holders);

TYPED_TEST(Coarse_seeds_on, AgreeWithAllPairsOfFaces) {
  const TypeParam held(bumpy_sphere());
  const Dihedral_difference difference(held.mesh);
  const Seeds seeds = seeds_of(held.mesh, difference, Seed_count_stop(12));
  ASSERT_EQ(seeds.faces.size(), 12u);
  const Matrix sums = all_differences(held.mesh, difference);
  const double unit = std::sqrt(static_cast<double>(sums.size()));  // the mean of this difference is 1
  for (std::size_t k = 1; k < seeds.faces.size(); ++k) {
    const auto earlier = first(seeds.faces, k);
    const double largest = largest_least(sums, earlier);
    EXPECT_NEAR(least_to(sums, seeds.faces[k], earlier), largest, 1e-9 * largest);
    EXPECT_NEAR(seeds.separations[k] * unit, largest, 1e-9 * largest);
  }
}

TYPED_TEST(Coarse_seeds_on, AreThoseOfOtherKindsOfMesh) {
  const TypeParam held(bumpy_sphere());
  EXPECT_EQ(seeds_of(held.mesh, Seed_count_stop(9)).faces, seeds_of_shape(bumpy_sphere(), 9));
}

TYPED_TEST(Coarse_seeds_on, TakePolygons) {
  const TypeParam held(meshes::cube_of_quads());
  auto seeds = seeds_of(held.mesh, Separation_decrease_stop()).faces;
  std::sort(seeds.begin(), seeds.end());
  EXPECT_EQ(seeds, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
}

TEST(Coarse_seeds, StartAtTheFaceGeodesicallyFarthestFromTheFaceAtTheCentroid) {
  const Shape shape = bumpy_sphere();
  const auto centroid = centroids(shape);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double sum = 0;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const auto& corner = shape.faces[f];
    const Eigen::Vector3d a = shape.points[corner[1]] - shape.points[corner[0]];
    const Eigen::Vector3d b = shape.points[corner[2]] - shape.points[corner[0]];
    moment += a.cross(b).norm() * centroid[f];
    sum += a.cross(b).norm();
  }
  const auto closer = [&](const auto& x, const auto& y) {
    return (x - moment / sum).norm() < (y - moment / sum).norm();
  };
  const auto middle = std::min_element(centroid.begin(), centroid.end(), closer) - centroid.begin();
  const auto distance = geodesic_distances(shape)[static_cast<std::size_t>(middle)];
  const auto farthest = std::max_element(distance.begin(), distance.end()) - distance.begin();
  EXPECT_EQ(seeds_of_shape(shape, 1), std::vector<std::size_t>{static_cast<std::size_t>(farthest)});
}

TEST(Coarse_seeds, OfEqualDifferencesAreThoseOfGeodesicDistance) {
  Shape uneven = meshes::plane(6);
  for (Eigen::Vector3d& p : uneven.points) p.x() += 0.3 * p.x() * p.y() + 0.1 * p.x() * p.x();
  const Seeds seeds = seeds_of(meshes::surface_mesh(uneven), Seed_count_stop(8));
  const Matrix distances = geodesic_distances(uneven);
  for (std::size_t k = 1; k < 8; ++k) {
    const auto earlier = first(seeds.faces, k);
    EXPECT_NEAR(least_to(distances, seeds.faces[k], earlier), largest_least(distances, earlier), 1e-9);
    EXPECT_EQ(seeds.separations[k], 0);
  }
}

TEST(Coarse_seeds, SeparationsNeverIncrease) {
  const auto mesh = meshes::surface_mesh(meshes::with_noise(meshes::torus(2, 0.7, 40, 20), 0.02));
  const Seeds seeds = seeds_of(mesh, Seed_count_stop(60));
  ASSERT_EQ(seeds.separations.size(), 60u);
  for (std::size_t k = 2; k < 60; ++k) {
    EXPECT_LE(seeds.separations[k], seeds.separations[k - 1]);
    EXPECT_GT(seeds.separations[k], 0);
  }
}

TEST(Coarse_seeds, OfFewerAreTheFirstOfMore) {
  const auto more = seeds_of_shape(bumpy_sphere(), 20);
  EXPECT_EQ(seeds_of_shape(bumpy_sphere(), 7), first(more, 7));
}

TEST(Coarse_seeds, GiveEachSideOfACubeOne) {
  constexpr std::size_t n = 5;
  const auto mesh = meshes::surface_mesh(meshes::cube(n));
  for (const auto& seeds : {seeds_of(mesh, Separation_decrease_stop()), seeds_of(mesh, Separation_threshold_stop())}) {
    std::set<std::size_t> sides;
    for (const std::size_t f : seeds.faces) sides.insert(f / (2 * n * n));
    EXPECT_EQ(seeds.faces.size(), 6u);
    EXPECT_EQ(sides.size(), 6u);
  }
}

TEST(Coarse_seeds, GiveEachOfTwoSpheresOne) {
  const auto mesh = meshes::surface_mesh(meshes::two_spheres_with_neck(2.4, 0.2, 32));
  const auto seeds = seeds_of(mesh, Seed_count_stop(2)).faces;
  ASSERT_EQ(seeds.size(), 2u);
  EXPECT_LT(std::min(seeds[0], seeds[1]), mesh.number_of_faces() / 3);
  EXPECT_GT(std::max(seeds[0], seeds[1]), 2 * mesh.number_of_faces() / 3);
}

TEST(Coarse_seeds, OfAFlatMeshEndWithTheFirst) {
  EXPECT_EQ(seeds_of(meshes::surface_mesh(meshes::plane(5)), Separation_decrease_stop()).faces.size(), 1u);
}

TEST(Coarse_seeds, EndWithoutTheFaceWhoseSeparationHasDecreased) {
  const auto mesh = meshes::surface_mesh(bumpy_sphere());
  const auto all = seeds_of(mesh, Seed_count_stop(40)).separations;
  for (const double decrease : {0.2, 0.5, 0.8}) {
    const std::size_t number = seeds_of(mesh, Separation_decrease_stop(decrease)).faces.size();
    ASSERT_LT(number, all.size());
    EXPECT_LT(all[number], (1 - decrease) * all[1]);
    EXPECT_GE(all[number - 1], number == 2 ? 0 : (1 - decrease) * all[1]);
  }
}

TEST(Coarse_seeds, EndWithoutTheFaceWhoseSeparationIsBelowTheThreshold) {
  const auto mesh = meshes::surface_mesh(bumpy_sphere());
  const auto all = seeds_of(mesh, Seed_count_stop(40)).separations;
  for (const double threshold : {0.2, 0.3, 0.5}) {
    const std::size_t number = seeds_of(mesh, Separation_threshold_stop(threshold)).faces.size();
    ASSERT_LT(number, all.size());
    EXPECT_LT(all[number], threshold);
    EXPECT_GE(all[number - 1], threshold);
  }
}

TEST(Coarse_seeds, AreSeparatedAlikeOnCoarseAndFineMeshesAndForScaledDifferences) {
  const auto separations = [](std::size_t around, double scale) {
    const auto mesh = meshes::surface_mesh(meshes::two_spheres_with_neck(2.4, 0.2, around));
    const Dihedral_difference difference(mesh, 1, Dihedral_measure::angle);
    const auto scaled = boost::make_function_property_map<meshes::Surface_mesh::Edge_index>(
        [&](auto e) { return scale * get(difference, e); });
    return seeds_of(mesh, scaled, Seed_count_stop(6)).separations;
  };
  const auto coarse = separations(24, 1), fine = separations(96, 1), scaled = separations(24, 1e-6);
  for (std::size_t k = 1; k < 6; ++k) {
    EXPECT_NEAR(fine[k], coarse[k], 0.15 * coarse[k]);
    EXPECT_NEAR(scaled[k], coarse[k], 1e-9 * coarse[k]);
  }
}

TEST(Coarse_seeds, TakeAStopPredicateOfTheUsers) {
  const auto mesh = meshes::surface_mesh(bumpy_sphere());
  const auto small_step = [](const std::vector<double>& separations) {
    const std::size_t last = separations.size() - 1;
    return last > 1 && separations[last] < 0.99 * separations[last - 1];
  };
  EXPECT_GE(seeds_of(mesh, small_step).faces.size(), 2u);
}

TEST(Coarse_seeds, AskADifferenceOnceForEachInteriorEdge) {
  const auto mesh = meshes::surface_mesh(meshes::plane(4));
  std::map<std::size_t, int> asked;
  const auto difference = boost::make_function_property_map<meshes::Surface_mesh::Edge_index>([&](auto e) {
    ++asked[e];
    return 1.;
  });
  seeds_of(mesh, difference, Seed_count_stop(6));
  std::size_t interior = 0;
  for (const auto e : mesh.edges()) {
    interior += !mesh.is_border(e);
    EXPECT_EQ(asked[e], mesh.is_border(e) ? 0 : 1);
  }
  EXPECT_GT(interior, 0u);
}

TEST(Coarse_seeds, CrossNoEdgeOfInfiniteDifference) {
  // The two halves of a strip, cut in the middle: the second seed lies beyond the cut.
  const auto mesh = meshes::surface_mesh(meshes::plane(4));
  const auto side = [&](auto f) { return centroids(meshes::plane(4))[f].x() < 0.5; };
  const auto difference = boost::make_function_property_map<meshes::Surface_mesh::Edge_index>([&](auto e) {
    const auto h = mesh.halfedge(e);
    return side(mesh.face(h)) != side(mesh.face(mesh.opposite(h))) ? infinity : 1.;
  });
  const Seeds seeds = seeds_of(mesh, difference, Seed_count_stop(3));
  EXPECT_NE(centroids(meshes::plane(4))[seeds.faces[0]].x() < 0.5,
            centroids(meshes::plane(4))[seeds.faces[1]].x() < 0.5);
  EXPECT_EQ(seeds.separations[1], infinity);
  EXPECT_LT(seeds.separations[2], infinity);
}

TEST(Coarse_seeds, AreTheSameInEveryPositionAndSize) {
  for (const Shape& shape : {bumpy_sphere(), meshes::cube(4), meshes::l_shape(3), meshes::sphere(2)}) {
    const auto seeds = seeds_of_shape(shape, 10);
    EXPECT_EQ(seeds_of_shape(meshes::transformed(shape, meshes::some_rotation()), 10), seeds);
    EXPECT_EQ(seeds_of_shape(meshes::scaled(shape, 1e-6), 10), seeds);
    EXPECT_EQ(seeds_of_shape(meshes::scaled(shape, 3e100), 10), seeds);
    EXPECT_EQ(seeds_of_shape(meshes::moved(shape, {1000, -2000, 500}), 10), seeds);
  }
}

TEST(Coarse_seeds, AreTheSameFacesInAnyOrderOfTheFaces) {
  const Shape shape = bumpy_sphere();
  const auto order = meshes::random_order(shape.faces.size());
  auto seeds = seeds_of_shape(meshes::with_faces_in_order(shape, order), 10);
  for (std::size_t& f : seeds) f = order[f];
  EXPECT_EQ(seeds, seeds_of_shape(shape, 10));
}

TEST(Coarse_seeds, StartInEachComponent) {
  const Shape two = meshes::together(bumpy_sphere(), meshes::moved(meshes::cube(3), {5, 0, 0}));
  const Shape three = meshes::together(two, meshes::moved(meshes::plane(2), {0, 5, 0}));
  const Seeds seeds = seeds_of(meshes::surface_mesh(three), Seed_count_stop(8));
  const std::size_t ends[] = {bumpy_sphere().faces.size(), two.faces.size(), three.faces.size()};
  ASSERT_EQ(seeds.faces.size(), 8u);
  for (std::size_t component = 0; component < 3; ++component) {
    EXPECT_LT(seeds.faces[component], ends[component]);
    EXPECT_GE(seeds.faces[component], component == 0 ? 0 : ends[component - 1]);
    EXPECT_EQ(seeds.separations[component], infinity);
  }
  EXPECT_LT(seeds.separations[3], infinity);
  EXPECT_GE(seeds_of(meshes::surface_mesh(three), Separation_decrease_stop()).faces.size(), 3u);
}

TEST(Coarse_seeds, AreAllFacesOfASoup) {
  Shape soup;
  for (int i = 0; i < 50; ++i)
    soup = meshes::together(soup, meshes::moved({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {2. * i, 0, 0}));
  EXPECT_EQ(seeds_of(meshes::surface_mesh(soup), Separation_decrease_stop()).faces.size(), 50u);
}

TEST(Coarse_seeds, MayBeAllFaces) {
  for (const Shape& shape : {meshes::cube(1), meshes::plane(1), bumpy_sphere()}) {
    auto seeds = seeds_of_shape(shape, shape.faces.size());
    std::sort(seeds.begin(), seeds.end());
    for (std::size_t f = 0; f < seeds.size(); ++f) EXPECT_EQ(seeds[f], f);
  }
}

TEST(Coarse_seeds, OfAnEmptyMeshAreNone) {
  EXPECT_TRUE(seeds_of(meshes::Surface_mesh(), constant_difference(1), Seed_count_stop(4)).faces.empty());
  EXPECT_TRUE(seeds_of(meshes::Surface_mesh(), constant_difference(1), Separation_decrease_stop()).faces.empty());
}

TEST(Coarse_seeds, OfOneFaceAreThatFace) {
  const auto mesh = meshes::surface_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  EXPECT_EQ(seeds_of(mesh, Seed_count_stop(1)).faces, std::vector<std::size_t>{0});
  EXPECT_EQ(seeds_of(mesh, Separation_decrease_stop()).faces, std::vector<std::size_t>{0});
}

TEST(Coarse_seeds, TellTheSidesOfAPillowApart) {
  // Two faces with the same corners: their centroids coincide, and they share three edges.
  const auto mesh = meshes::surface_mesh({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}});
  EXPECT_EQ(seeds_of(mesh, Seed_count_stop(2)).faces.size(), 2u);
}

TEST(Coarse_seeds, PassOverFacesWithoutArea) {
  // A face without area on the diagonal of a square; its number is the last.
  Shape shape = meshes::cube(3);
  const std::size_t faces = shape.faces.size(), a = shape.faces[0][0], b = shape.faces[0][1], c = shape.faces[0][2];
  shape.points.push_back((shape.points[a] + shape.points[c]) / 2);
  const std::size_t middle = shape.points.size() - 1;
  shape.faces[0] = {a, b, middle};
  shape.faces.push_back({middle, b, c});
  shape.faces.push_back({a, middle, c});
  const auto seeds = seeds_of(meshes::surface_mesh(shape), Separation_decrease_stop()).faces;
  std::set<std::size_t> sides;
  for (const std::size_t f : seeds) sides.insert(f < faces ? f / 18 : 0);
  EXPECT_EQ(seeds.size(), 6u);
  EXPECT_EQ(sides.size(), 6u);
}

TEST(Coarse_seeds, OfAMeshWithoutAreaAreAsManyAsAskedFor) {
  Shape flat = meshes::plane(3);
  for (Eigen::Vector3d& p : flat.points) p.y() = 0;
  EXPECT_EQ(seeds_of_shape(flat, 5).size(), 5u);
  for (Eigen::Vector3d& p : flat.points) p.setZero();
  EXPECT_EQ(seeds_of_shape(flat, 5).size(), 5u);
}

// ---- Errors ----

/// What is thrown, and that nothing has been written then.
template <class Error, class Stop, class Difference>
std::string error_of(const Shape& shape, const Difference& difference, const Stop& stop) {
  const auto mesh = meshes::surface_mesh(shape);
  std::vector<meshes::Surface_mesh::Face_index> seeds;
  try {
    coarse_seeds(mesh, difference, stop, std::back_inserter(seeds));
  } catch (const Error& error) {
    EXPECT_TRUE(seeds.empty());
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Coarse_seeds_refuse, ACountOfZero) { EXPECT_THROW(Seed_count_stop(0), std::invalid_argument); }

TEST(Coarse_seeds_refuse, ADecreaseOutsideZeroToOne) {
  for (const double decrease : {0., -1., 1.5, std::nan("")})
    EXPECT_THROW(Separation_decrease_stop{decrease}, std::invalid_argument);
}

TEST(Coarse_seeds_refuse, AThresholdBelowZeroOrNotFinite) {
  for (const double threshold : {-1., infinity, std::nan("")})
    EXPECT_THROW(Separation_threshold_stop{threshold}, std::invalid_argument);
}

TEST(Coarse_seeds_refuse, FewerSeedsThanComponents) {
  const Shape two = meshes::together(meshes::cube(), meshes::moved(meshes::cube(), {5, 0, 0}));
  const Shape three = meshes::together(two, meshes::moved(meshes::cube(), {0, 5, 0}));
  const auto what = error_of<std::invalid_argument>(three, constant_difference(1), Seed_count_stop(2));
  EXPECT_TRUE(holds(what, "2") && holds(what, "3")) << what;
}

TEST(Coarse_seeds_refuse, MoreSeedsThanFaces) {
  const auto what = error_of<std::invalid_argument>(meshes::cube(), constant_difference(1), Seed_count_stop(13));
  EXPECT_TRUE(holds(what, "12")) << what;
  const auto never = [](const std::vector<double>&) { return false; };
  error_of<std::invalid_argument>(meshes::cube(), constant_difference(1), never);
}

TEST(Coarse_seeds_refuse, ADifferenceBelowZeroOrNaN) {
  for (const double value : {-1., std::nan("")}) {
    const auto what = error_of<std::invalid_argument>(meshes::cube(), constant_difference(value), Seed_count_stop(2));
    EXPECT_TRUE(holds(what, "difference")) << what;
  }
}

TEST(Coarse_seeds_refuse, ACoordinateThatIsNotFinite) {
  Shape shape = meshes::cube();
  shape.points[3].y() = std::nan("");
  const auto what = error_of<std::invalid_argument>(shape, constant_difference(1), Seed_count_stop(2));
  EXPECT_TRUE(holds(what, "vertex 3")) << what;
}

TEST(Coarse_seeds, AreCancelledByTheCallback) {
  const auto mesh = meshes::surface_mesh(bumpy_sphere());
  std::vector<meshes::Surface_mesh::Face_index> seeds;
  std::vector<double> fractions;
  std::function<bool(double)> callback = [&](double fraction) {
    fractions.push_back(fraction);
    return fractions.size() < 5;
  };
  EXPECT_THROW(coarse_seeds(mesh, Dihedral_difference(mesh), Seed_count_stop(20), std::back_inserter(seeds),
                            CGAL::parameters::callback(callback)),
               Cancelled);
  EXPECT_TRUE(seeds.empty());
  EXPECT_EQ(fractions.size(), 5u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0);
  EXPECT_LE(fractions.back(), 1);
}

TEST(Coarse_seeds, ReadTheUsersPoints) {
  // The points of the mesh itself are all the same.
  const Shape shape = bumpy_sphere();
  Shape collapsed = shape;
  for (Eigen::Vector3d& p : collapsed.points) p.setZero();
  const auto mesh = meshes::surface_mesh(collapsed), original = meshes::surface_mesh(shape);
  const auto difference = constant_difference(1);
  std::vector<meshes::Surface_mesh::Face_index> seeds, expected;
  coarse_seeds(mesh, difference, Seed_count_stop(5), std::back_inserter(seeds),
               CGAL::parameters::vertex_point_map(original.points()));
  coarse_seeds(original, difference, Seed_count_stop(5), std::back_inserter(expected));
  EXPECT_EQ(seeds, expected);
}

}  // namespace

}  // namespace test_coarse_seeds
