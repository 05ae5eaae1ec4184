// SPDX-License-Identifier: MIT

#include "meshes.h"

#include <RW_segmentation/Particle_sampling.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/internal/seeds/Distance_clusters.h>
#include <RW_segmentation/internal/seeds/Distances_to_sources.h>
#include <RW_segmentation/internal/seeds/Feature_sensitive_metric.h>

#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace test_feature_sensitive_seeds {

namespace {

using namespace RW_segmentation;
using meshes::Shape;
using Mesh = meshes::Surface_mesh;
using Face = Mesh::Face_index;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Seeds as places of faces in the order of `faces(mesh)`.
template <class Mesh_, class Sampling>
std::vector<std::size_t> seeds_of(const Mesh_& mesh, std::size_t count, const Sampling& sampling,
                                  const std::vector<std::size_t>& given = {}) {
  using face_descriptor = typename boost::graph_traits<Mesh_>::face_descriptor;
  std::vector<face_descriptor> all(faces(mesh).begin(), faces(mesh).end()), given_faces, found;
  for (const std::size_t f : given) given_faces.push_back(all[f]);
  feature_sensitive_seeds(mesh, count, std::back_inserter(found), given_faces, sampling);
  std::map<face_descriptor, std::size_t> place;
  for (const auto f : all) place.emplace(f, place.size());
  std::vector<std::size_t> result;
  for (const auto f : found) result.push_back(place.at(f));
  return result;
}

template <class Sampling = Farthest_point_sampling>
std::vector<std::size_t> seeds_of(const Shape& shape, std::size_t count, const Sampling& sampling = Sampling(),
                                  const std::vector<std::size_t>& given = {}) {
  return seeds_of(meshes::surface_mesh(shape), count, sampling, given);
}

/// The feature-sensitive metric of a shape, computed from its points alone.
class Metric {
 public:
  explicit Metric(const Shape& shape, double normal_weight = 0.05) {
    double total = 0;
    for (const auto& face : shape.faces) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero(), area = sum;
      for (std::size_t k = 0; k < face.size(); ++k) {
        sum += shape.points[face[k]];
        area += shape.points[face[k]].cross(shape.points[face[(k + 1) % face.size()]]) / 2;
      }
      centroid.push_back(sum / static_cast<double>(face.size()));
      normal.push_back(area.normalized());
      total += area.norm();
      moment += area.norm() * centroid.back();
    }
    moment /= total;
    w = normal_weight * std::sqrt(total);

    std::map<std::pair<std::size_t, std::size_t>, std::size_t> face_of_side;
    for (std::size_t f = 0; f < shape.faces.size(); ++f)
      for (std::size_t k = 0; k < shape.faces[f].size(); ++k)
        face_of_side[{shape.faces[f][k], shape.faces[f][(k + 1) % shape.faces[f].size()]}] = f;
    steps.resize(shape.faces.size());
    for (const auto& [side, f] : face_of_side) {
      const auto other = face_of_side.find({side.second, side.first});
      if (other != face_of_side.end()) steps[f].emplace_back(other->second, straight(f, other->second));
    }
  }

  double straight(std::size_t f, std::size_t g) const {
    return std::hypot((centroid[f] - centroid[g]).norm(), w * (normal[f] - normal[g]).norm());
  }

  /// The lengths of the shortest paths from a face, by relaxing all edges until nothing changes.
  std::vector<double> paths_from(std::size_t source) const {
    std::vector<double> length(centroid.size(), infinity);
    length[source] = 0;
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t f = 0; f < length.size(); ++f)
        for (const auto& [g, step] : steps[f])
          if (length[f] + step < length[g]) {
            length[g] = length[f] + step;
            changed = true;
          }
    }
    return length;
  }

  std::vector<double> paths_to_nearest(const std::vector<std::size_t>& seeds) const {
    std::vector<double> nearest(centroid.size(), infinity);
    for (const std::size_t seed : seeds) {
      const auto length = paths_from(seed);
      for (std::size_t f = 0; f < nearest.size(); ++f) nearest[f] = std::min(nearest[f], length[f]);
    }
    return nearest;
  }

  double covering_radius(const std::vector<std::size_t>& seeds) const {
    const auto nearest = paths_to_nearest(seeds);
    return *std::max_element(nearest.begin(), nearest.end());
  }

  /// The standard deviation of the straight distances to the nearest other seed, over their mean.
  double unevenness(const std::vector<std::size_t>& seeds) const {
    std::vector<double> nearest;
    for (const std::size_t f : seeds) {
      double least = infinity;
      for (const std::size_t g : seeds)
        if (f != g) least = std::min(least, straight(f, g));
      nearest.push_back(least);
    }
    const double n = static_cast<double>(nearest.size());
    const double mean = std::accumulate(nearest.begin(), nearest.end(), 0.) / n;
    double sum = 0;
    for (const double d : nearest) sum += (d - mean) * (d - mean);
    return std::sqrt(sum / n) / mean;
  }

  std::vector<Eigen::Vector3d> centroid, normal;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // the area's centroid in the end
  double w = 0;
  std::vector<std::vector<std::pair<std::size_t, double>>> steps;  // to each neighbour, and how far it is
};

std::vector<std::size_t> first(const std::vector<std::size_t>& seeds, std::size_t number) {
  return {seeds.begin(), seeds.begin() + static_cast<std::ptrdiff_t>(number)};
}

std::set<std::size_t> as_set(const std::vector<std::size_t>& seeds) { return {seeds.begin(), seeds.end()}; }

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Shape bumpy_sphere(std::size_t levels = 1) {
  return meshes::with_noise(meshes::sphere(levels), 0.1 / static_cast<double>(1u << levels));
}

Shape three_components() {
  const Shape two = meshes::together(bumpy_sphere(), meshes::moved(meshes::cube(2), {5, 0, 0}));
  return meshes::together(two, meshes::moved(meshes::plane(2), {0, 5, 0}));
}

std::size_t component_of(std::size_t face) { return face < 80 ? 0 : face < 80 + 48 ? 1 : 2; }

// ---- Farthest points ----

template <class Holder>
class Feature_sensitive_seeds_on : public testing::Test {};
TYPED_TEST_SUITE(Feature_sensitive_seeds_on, meshes::Holders);

TYPED_TEST(Feature_sensitive_seeds_on, LieAtTheFarthestFaces) {
  const Shape shape = bumpy_sphere();
  const TypeParam held(shape);
  const auto seeds = seeds_of(held.mesh, 15, Farthest_point_sampling());
  ASSERT_EQ(seeds.size(), 15u);
  const Metric metric(shape);
  for (std::size_t k = 1; k < seeds.size(); ++k) {
    const auto nearest = metric.paths_to_nearest(first(seeds, k));
    const auto farthest = std::max_element(nearest.begin(), nearest.end()) - nearest.begin();
    EXPECT_EQ(seeds[k], static_cast<std::size_t>(farthest));
  }
}

TYPED_TEST(Feature_sensitive_seeds_on, TakePolygons) {
  const TypeParam held(meshes::cube_of_quads());
  EXPECT_EQ(as_set(seeds_of(held.mesh, 6, Farthest_point_sampling())).size(), 6u);
}

TEST(Farthest_point_seeds, StartAtTheFaceFarthestFromTheCentroid) {
  const Shape shape = bumpy_sphere();
  const Metric metric(shape);
  const auto closer = [&](const auto& x, const auto& y) {
    return (x - metric.moment).norm() < (y - metric.moment).norm();
  };
  const auto farthest =
      std::max_element(metric.centroid.begin(), metric.centroid.end(), closer) - metric.centroid.begin();
  EXPECT_EQ(seeds_of(shape, 1), std::vector<std::size_t>{static_cast<std::size_t>(farthest)});
}

TEST(Farthest_point_seeds, CoverTheMeshHalfAsWellAsTheBestSeedsAtLeast) {
  const Shape shape = meshes::with_noise(meshes::sphere(0), 0.3);
  const Metric metric(shape);
  const std::size_t n = shape.faces.size();
  double best = infinity;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      for (std::size_t c = b + 1; c < n; ++c) best = std::min(best, metric.covering_radius({a, b, c}));
  const double covered = metric.covering_radius(seeds_of(shape, 3));
  EXPECT_LE(covered, 2 * best);
  EXPECT_GE(covered, best);
}

TEST(Farthest_point_seeds, AreNoCloserToEachOtherThanTheFarthestFaceIsToThem) {
  const Shape shape = meshes::l_shape(6);
  const Metric metric(shape);
  const auto seeds = seeds_of(shape, 30);
  const double covering_radius = metric.covering_radius(seeds);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const auto paths = metric.paths_from(seeds[i]);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE(paths[seeds[j]], covering_radius * (1 - 1e-9));
  }
}

TEST(Farthest_point_seeds, OfFewerAreTheFirstOfMore) {
  const auto more = seeds_of(bumpy_sphere(), 20);
  EXPECT_EQ(seeds_of(bumpy_sphere(), 7), first(more, 7));
}

TEST(Farthest_point_seeds, OfNormalsAloneAreOneForEachSideOfACube) {
  constexpr std::size_t n = 4;
  std::set<std::size_t> sides;
  for (const std::size_t f : seeds_of(meshes::cube(n), 6, Farthest_point_sampling(100))) sides.insert(f / (2 * n * n));
  EXPECT_EQ(sides.size(), 6u);
}

TEST(Farthest_point_seeds, OfPlacesAloneDoNotSeeNormals) {
  const Shape shape = bumpy_sphere(2);
  const auto mesh = meshes::surface_mesh(shape);
  const auto up = boost::make_function_property_map<Face>([](Face) { return meshes::Kernel::Vector_3(0, 0, 1); });
  std::vector<Face> places, upward;
  feature_sensitive_seeds(mesh, 12, std::back_inserter(places), std::vector<Face>(), Farthest_point_sampling(0));
  feature_sensitive_seeds(mesh, up, 12, std::back_inserter(upward));
  EXPECT_EQ(places, upward);
  std::vector<Face> by_default;
  feature_sensitive_seeds(mesh, 12, std::back_inserter(by_default));
  EXPECT_NE(places, by_default);
}

TEST(Farthest_point_seeds, TakeNormalsOfAnyLength) {
  const Shape shape = bumpy_sphere();
  const auto mesh = meshes::surface_mesh(shape);
  const Metric metric(shape);
  const auto normals = boost::make_function_property_map<Face>([&](Face f) {
    const Eigen::Vector3d n = metric.normal[f] * (1. + static_cast<double>(std::size_t(f)));
    return meshes::Kernel::Vector_3(n.x(), n.y(), n.z());
  });
  std::vector<Face> seeds, expected;
  feature_sensitive_seeds(mesh, normals, 12, std::back_inserter(seeds));
  feature_sensitive_seeds(mesh, 12, std::back_inserter(expected));
  EXPECT_EQ(seeds, expected);
}

TEST(Farthest_point_seeds, SeeNoCreaseAtAFaceWithoutNormal) {
  const auto mesh = meshes::surface_mesh(meshes::cube(3));
  const auto none = boost::make_function_property_map<Face>([](Face) { return meshes::Kernel::Vector_3(0, 0, 0); });
  std::vector<Face> seeds, expected;
  feature_sensitive_seeds(mesh, none, 12, std::back_inserter(seeds));
  feature_sensitive_seeds(mesh, 12, std::back_inserter(expected), std::vector<Face>(), Farthest_point_sampling(0));
  EXPECT_EQ(seeds, expected);
}

TEST(Farthest_point_seeds, AreTheSameInEveryPositionAndSize) {
  for (const Shape& shape : {bumpy_sphere(2), meshes::cube(4), meshes::sphere(2)}) {
    const auto seeds = seeds_of(shape, 20);
    EXPECT_EQ(seeds_of(meshes::transformed(shape, meshes::some_rotation()), 20), seeds);
    EXPECT_EQ(seeds_of(meshes::scaled(shape, 1e-6), 20), seeds);
    EXPECT_EQ(seeds_of(meshes::scaled(shape, 3e100), 20), seeds);
    EXPECT_EQ(seeds_of(meshes::moved(shape, {1000, -2000, 500}), 20), seeds);
  }
}

TEST(Farthest_point_seeds, AreTheSameFacesInAnyOrderOfTheFaces) {
  const Shape shape = bumpy_sphere(2);
  const auto order = meshes::random_order(shape.faces.size());
  auto seeds = seeds_of(meshes::with_faces_in_order(shape, order), 20);
  for (std::size_t& f : seeds) f = order[f];
  EXPECT_EQ(seeds, seeds_of(shape, 20));
}

TEST(Farthest_point_seeds, GoOnFromGivenOnes) {
  const auto all = seeds_of(bumpy_sphere(), 20);
  const std::vector<std::size_t> rest(all.begin() + 6, all.end());
  EXPECT_EQ(seeds_of(bumpy_sphere(), 14, Farthest_point_sampling(), first(all, 6)), rest);
}

TEST(Distance_clusters, HaveAWayForAnyTwoThatTouchWhichIsThatOfShortestPathsIfFacesAreClusters) {
  const Shape shape = bumpy_sphere(2);
  const Mesh mesh = meshes::surface_mesh(shape);
  const Dual_mesh_of dual(mesh);
  const Metric metric(shape);
  std::vector<Dual_graph::Index> number(shape.faces.size());  // in the dual mesh, of each face of the shape
  for (Dual_graph::Index i = 0; i < number.size(); ++i) number[dual.face(i)] = i;
  const std::vector<double> lengths = internal::Feature_sensitive_metric(dual, 0.05).edge_lengths();
  for (const std::size_t steps : {0u, 1u, 3u}) {
    const internal::Distance_clusters clusters(dual.graph(), lengths, steps);
    std::set<std::array<Dual_graph::Index, 2>> touching;
    for (std::size_t f = 0; f < number.size(); ++f)
      for (const auto& [g, step] : metric.steps[f]) {
        const auto a = clusters.of_face[number[f]], b = clusters.of_face[number[g]];
        if (a < b) touching.insert({a, b});
      }
    EXPECT_EQ(std::vector(touching.begin(), touching.end()), clusters.ends);

    const Dual_graph graph(clusters.root.size(), clusters.ends);
    internal::Distances_to_sources distance(graph, clusters.lengths);
    const Dual_graph::Index source = clusters.of_face[number[7]];
    distance.add_source(source);
    const std::vector<double> path = metric.paths_from(dual.face(clusters.root[source]));
    for (Dual_graph::Index c = 0; c < clusters.root.size(); ++c) {
      const double over_clusters = dual.unit() * std::max(0., distance[c]);
      const double over_faces = path[dual.face(clusters.root[c])];
      EXPECT_GE(over_clusters, over_faces * (1 - 1e-9));
      EXPECT_LE(over_clusters, over_faces * (steps == 0 ? 1 + 1e-9 : 2));
    }
  }
}

TEST(Distance_clusters, DoNotReachOverInfiniteEdges) {
  const Dual_graph row(4, {{0, 1}, {1, 2}, {2, 3}});
  const internal::Distance_clusters clusters(row, {1., infinity, 1.}, 5);
  EXPECT_EQ(clusters.root, (std::vector<Dual_graph::Index>{0, 2}));
  EXPECT_EQ(clusters.of_face, (std::vector<Dual_graph::Index>{0, 0, 1, 1}));
  EXPECT_TRUE(clusters.ends.empty());
}

TEST(Farthest_point_seeds, OverClustersCoverAMeshAboutAsWell) {
  const Farthest_point_sampling over_clusters(0.05, 0);
  for (const Shape& shape : {bumpy_sphere(4), meshes::torus(1, 0.4, 80, 34), meshes::cube(21)}) {
    ASSERT_GT(shape.faces.size(), 5000u);  // some 250 clusters, as many as five seeds need
    const Metric metric(shape);
    const double directly = metric.covering_radius(seeds_of(shape, 4));
    const auto seeds = seeds_of(shape, 4, over_clusters);
    EXPECT_EQ(as_set(seeds).size(), 4u);
    EXPECT_NE(seeds, seeds_of(shape, 4));
    EXPECT_LE(metric.covering_radius(seeds), 1.2 * directly);

    const auto added = seeds_of(shape, 2, over_clusters, first(seeds, 2));
    EXPECT_EQ(added, std::vector<std::size_t>(seeds.begin() + 2, seeds.end()));
  }
}

TEST(Farthest_point_seeds, AreDirectUpToTheirLargestMeshAndWhereClustersAreFewForThem) {
  const Shape shape = bumpy_sphere(4);
  const std::size_t faces = shape.faces.size();
  EXPECT_EQ(Farthest_point_sampling().largest_direct(), 100000u);
  const Farthest_point_sampling direct(0.05, faces), over_clusters(0.05, faces - 1);
  EXPECT_EQ(over_clusters.largest_direct(), faces - 1);
  EXPECT_EQ(seeds_of(shape, 4, direct), seeds_of(shape, 4));
  EXPECT_NE(seeds_of(shape, 4, over_clusters), seeds_of(shape, 4));
  EXPECT_EQ(seeds_of(shape, 40, over_clusters), seeds_of(shape, 40));
}

TEST(Farthest_point_seeds, OfCostsThatDifferWidelyAreThoseOfShortestPaths) {
  // Slivers and large triangles: the queue of the search meets lengths from 1e-5 to 1.
  Shape shape = meshes::plane(14);
  for (Eigen::Vector3d& p : shape.points) p = {std::pow(p.x(), 5), std::pow(p.y(), 3), 0.1 * std::sin(20 * p.x())};
  const Metric metric(shape);
  const auto seeds = seeds_of(shape, 25);
  for (std::size_t k = 1; k < seeds.size(); ++k) {
    const auto nearest = metric.paths_to_nearest(first(seeds, k));
    const double largest = *std::max_element(nearest.begin(), nearest.end());
    EXPECT_NEAR(nearest[seeds[k]], largest, 1e-8 * largest);
  }
}

// ---- Particles ----

TEST(Particle_seeds, AreMoreEvenByStraightDistanceThanFarthestPoints) {
  for (const Shape& shape : {meshes::torus(2, 0.6, 80, 32), meshes::two_spheres_with_neck(2.6, 0.3, 48)}) {
    const Metric metric(shape);
    EXPECT_LT(metric.unevenness(seeds_of(shape, 40, Particle_sampling())),
              0.8 * metric.unevenness(seeds_of(shape, 40, Farthest_point_sampling())));
  }
}

TEST(Particle_seeds, AreAboutAsManyAsAskedFor) {
  const Shape torus = meshes::torus(2, 0.6, 80, 32);
  for (const std::size_t count : {2u, 5u, 12u, 40u, 150u}) {
    const double found = static_cast<double>(seeds_of(torus, count, Particle_sampling()).size());
    EXPECT_NEAR(found, static_cast<double>(count), std::max(1., 0.15 * static_cast<double>(count)));
  }
}

TEST(Particle_seeds, LeaveCrowdsAndFillGaps) {
  // Given seeds crowd one end of a tube: particles keep away from them, and spread evenly over the rest.
  const Shape tube = meshes::tube(6, 24, 60);
  std::vector<std::size_t> given;
  for (std::size_t f = 0; f < 48 * 6; f += 7) given.push_back(f);
  const auto seeds = seeds_of(tube, 20, Particle_sampling(), given);
  const Metric metric(tube);
  for (const std::size_t f : seeds) EXPECT_GT(metric.centroid[f].z(), 0.6);
  const double highest = metric.centroid[*std::max_element(seeds.begin(), seeds.end())].z();
  EXPECT_GT(highest, 5);
}

TEST(Particle_seeds, AreTheSameInEverySize) {
  const auto seeds = seeds_of(bumpy_sphere(2), 20, Particle_sampling());
  EXPECT_EQ(seeds_of(meshes::scaled(bumpy_sphere(2), 0x1p-40), 20, Particle_sampling()), seeds);
}

// ---- Both ----

template <class Sampling>
class Feature_sensitive_seeds_by : public testing::Test {};
using Samplings = testing::Types<Farthest_point_sampling, Particle_sampling>;
TYPED_TEST_SUITE(Feature_sensitive_seeds_by, Samplings);

TYPED_TEST(Feature_sensitive_seeds_by, AreDifferentFaces) {
  const auto seeds = seeds_of(bumpy_sphere(2), 60, TypeParam());
  EXPECT_EQ(as_set(seeds).size(), seeds.size());
}

TYPED_TEST(Feature_sensitive_seeds_by, AreTheSameEachTime) {
  EXPECT_EQ(seeds_of(bumpy_sphere(2), 30, TypeParam()), seeds_of(bumpy_sphere(2), 30, TypeParam()));
}

TYPED_TEST(Feature_sensitive_seeds_by, LieInEachComponent) {
  for (const std::size_t count : {3u, 4u, 20u}) {
    std::set<std::size_t> components;
    for (const std::size_t f : seeds_of(three_components(), count, TypeParam())) components.insert(component_of(f));
    EXPECT_EQ(components.size(), 3u);
  }
}

TYPED_TEST(Feature_sensitive_seeds_by, DoNotRepeatGivenOnes) {
  const std::vector<std::size_t> given = {0, 5, 17, 5};
  for (const std::size_t f : seeds_of(bumpy_sphere(), 20, TypeParam(), given))
    EXPECT_EQ(std::count(given.begin(), given.end(), f), 0);
}

TYPED_TEST(Feature_sensitive_seeds_by, MayBeAllFaces) {
  for (const Shape& shape : {meshes::cube(1), bumpy_sphere(0)}) {
    const auto seeds = seeds_of(shape, shape.faces.size(), TypeParam());
    EXPECT_LE(as_set(seeds).size(), shape.faces.size());
    EXPECT_EQ(as_set(seeds).size(), seeds.size());
    if (std::is_same_v<TypeParam, Farthest_point_sampling>) {
      EXPECT_EQ(seeds.size(), shape.faces.size());
    }
  }
}

TYPED_TEST(Feature_sensitive_seeds_by, LieOnOpenMeshes) {
  const auto seeds = seeds_of(meshes::plane(8), 10, TypeParam());
  EXPECT_NEAR(static_cast<double>(seeds.size()), 10, 2);
}

TYPED_TEST(Feature_sensitive_seeds_by, LieOnMeshesWithoutArea) {
  Shape flat = meshes::plane(4);
  for (Eigen::Vector3d& p : flat.points) p.y() = 0;
  EXPECT_GE(seeds_of(flat, 5, TypeParam()).size(), 1u);
  for (Eigen::Vector3d& p : flat.points) p.setZero();
  EXPECT_GE(seeds_of(flat, 5, TypeParam()).size(), 1u);
}

TYPED_TEST(Feature_sensitive_seeds_by, OfAnEmptyMeshAreNone) { EXPECT_TRUE(seeds_of(Mesh(), 5, TypeParam()).empty()); }

TYPED_TEST(Feature_sensitive_seeds_by, OfOneFaceAreThatFace) {
  EXPECT_EQ(seeds_of(Shape{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, 1, TypeParam()),
            std::vector<std::size_t>{0});
}

TYPED_TEST(Feature_sensitive_seeds_by, AreCancelledByTheCallback) {
  const auto mesh = meshes::surface_mesh(bumpy_sphere(2));
  std::vector<Face> seeds;
  std::vector<double> fractions;
  std::function<bool(double)> callback = [&](double fraction) {
    fractions.push_back(fraction);
    return fractions.size() < 25;
  };
  EXPECT_THROW(feature_sensitive_seeds(mesh, 40, std::back_inserter(seeds), {}, TypeParam(),
                                       CGAL::parameters::callback(callback)),
               Cancelled);
  EXPECT_TRUE(seeds.empty());
  EXPECT_EQ(fractions.size(), 25u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0);
  EXPECT_LE(fractions.back(), 1);
}

TEST(Feature_sensitive_seeds, TakeGivenSeedsWithLabels) {
  const auto mesh = meshes::surface_mesh(bumpy_sphere());
  const std::vector<Face> plain = {Face(3), Face(40)};
  const std::vector<std::pair<Face, std::size_t>> labelled = {{Face(3), 7}, {Face(40), 7}};
  std::vector<Face> seeds, expected;
  feature_sensitive_seeds(mesh, 8, std::back_inserter(seeds), labelled);
  feature_sensitive_seeds(mesh, 8, std::back_inserter(expected), plain);
  EXPECT_EQ(seeds, expected);
}

TEST(Feature_sensitive_seeds, ReadTheUsersPoints) {
  const Shape shape = bumpy_sphere();
  Shape collapsed = shape;
  for (Eigen::Vector3d& p : collapsed.points) p.setZero();
  const auto mesh = meshes::surface_mesh(collapsed), original = meshes::surface_mesh(shape);
  std::vector<Face> seeds, expected;
  feature_sensitive_seeds(mesh, 8, std::back_inserter(seeds), {}, {},
                          CGAL::parameters::vertex_point_map(original.points()));
  feature_sensitive_seeds(original, 8, std::back_inserter(expected));
  EXPECT_EQ(seeds, expected);
}

// ---- Errors ----

/// What is thrown, and that nothing has been written then.
template <class Seed>
std::string error_of(const Shape& shape, std::size_t count, const std::vector<Seed>& given) {
  const auto mesh = meshes::surface_mesh(shape);
  std::vector<Face> seeds;
  try {
    feature_sensitive_seeds(mesh, count, std::back_inserter(seeds), given);
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(seeds.empty());
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

std::string error_of(const Shape& shape, std::size_t count) { return error_of(shape, count, std::vector<Face>()); }

TEST(Feature_sensitive_seeds_refuse, ACountOfZero) {
  const auto what = error_of(meshes::cube(), 0);
  EXPECT_TRUE(holds(what, "count is 0")) << what;
}

TEST(Feature_sensitive_seeds_refuse, MoreSeedsThanFaces) {
  const auto what = error_of(meshes::cube(), 13);
  EXPECT_TRUE(holds(what, "13") && holds(what, "12")) << what;
  const auto with_given = error_of(meshes::cube(), 12, std::vector<Face>{Face(4), Face(5), Face(4)});
  EXPECT_TRUE(holds(with_given, "12") && holds(with_given, "10")) << with_given;
}

TEST(Feature_sensitive_seeds_refuse, FewerSeedsThanComponents) {
  const auto what = error_of(three_components(), 2);
  EXPECT_TRUE(holds(what, "2") && holds(what, "3")) << what;
  EXPECT_EQ(seeds_of(three_components(), 2, Farthest_point_sampling(), {0}).size(), 2u);
}

TEST(Feature_sensitive_seeds_refuse, AGivenSeedThatIsNoFace) {
  const auto null = error_of(meshes::cube(), 2, std::vector<Face>{Face(1), Mesh::null_face()});
  EXPECT_TRUE(holds(null, "given seed 1")) << null;
  const auto beyond = error_of(meshes::cube(), 2, std::vector<Face>{Face(12)});
  EXPECT_TRUE(holds(beyond, "given seed 0")) << beyond;
}

TEST(Feature_sensitive_seeds_refuse, AGivenSeedThatHasBeenRemoved) {
  auto mesh = meshes::surface_mesh(meshes::cube(2));
  CGAL::Euler::remove_face(mesh.halfedge(Face(7)), mesh);
  std::vector<Face> seeds;
  EXPECT_THROW(feature_sensitive_seeds(mesh, 3, std::back_inserter(seeds), std::vector<Face>{Face(7)}),
               std::invalid_argument);
}

TEST(Feature_sensitive_seeds_refuse, ANormalWeightBelowZeroOrNotFinite) {
  for (const double weight : {-1., infinity, std::nan("")}) {
    EXPECT_THROW(Farthest_point_sampling{weight}, std::invalid_argument);
    EXPECT_THROW(Particle_sampling{weight}, std::invalid_argument);
  }
}

TEST(Feature_sensitive_seeds_refuse, ANormalThatIsNotFinite) {
  const auto mesh = meshes::surface_mesh(meshes::cube());
  const auto normals = boost::make_function_property_map<Face>(
      [](Face f) { return meshes::Kernel::Vector_3(0, 0, f == Face(5) ? std::nan("") : 1.); });
  std::vector<Face> seeds;
  EXPECT_THROW(feature_sensitive_seeds(mesh, normals, 3, std::back_inserter(seeds)), std::invalid_argument);
  EXPECT_TRUE(seeds.empty());
}

TEST(Feature_sensitive_seeds_refuse, ACoordinateThatIsNotFinite) {
  Shape shape = meshes::cube();
  shape.points[3].y() = infinity;
  EXPECT_TRUE(holds(error_of(shape, 3), "vertex 3"));
}

}  // namespace

}  // namespace test_feature_sensitive_seeds
