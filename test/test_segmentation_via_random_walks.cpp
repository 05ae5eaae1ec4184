// SPDX-License-Identifier: MIT

#include <RW_segmentation/Paper_segmentation.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include <gtest/gtest.h>
#include "../benchmark/segmentation_measures.h"
#include "face_labels.h"
#include "meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

namespace test_segmentation_via_random_walks {

using namespace RW_segmentation;

namespace {

template <class Policy = Automatic_segmentation>
std::vector<std::size_t> segments_of(const meshes::Shape& shape, const Policy& policy = Policy()) {
  const auto mesh = meshes::surface_mesh(shape);
  Face_labels<meshes::Surface_mesh> ids(mesh);
  segmentation_via_random_walks(mesh, ids.map(), policy);
  return ids.values();
}

std::size_t number_of(const std::vector<std::size_t>& ids) {
  return std::set<std::size_t>(ids.begin(), ids.end()).size();
}

double rand_error(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
  return segmentation_measures::Overlaps(a, b).rand_index_error();
}

/// Two spheres joined by a neck.
meshes::Shape dumbbell(std::size_t around = 32) { return meshes::two_spheres_with_neck(2.4, 0.3, around); }

template <class Holder>
class Automatic : public testing::Test {};
TYPED_TEST_SUITE(Automatic, meshes::Holders);

}  // namespace

TYPED_TEST(Automatic, CutsTwoSpheresApartWhereTheyTouch) {
  const meshes::Shape shape = meshes::two_spheres_with_neck(2.0001, 0.1, 48);  // with a radius of 0.2, necks are rings
  const TypeParam held(shape);
  Face_labels<typename TypeParam::Mesh> ids(held.mesh);
  EXPECT_EQ(segmentation_via_random_walks(held.mesh, ids.map()), 2u);
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {  // faces come from the lowest to the highest
    const double z = shape.points[shape.faces[f][0]].z();
    if (std::abs(z) < 0.2) continue;
    EXPECT_EQ(ids.values()[f], z < 0 ? ids.values().front() : ids.values().back()) << z;
  }
}

TEST(AutomaticOfFewFaces, CutsSpheresApartAtTheSameCostAsOfMany) {
  // 1152 to 8192 faces. Relative to the mean of the mesh alone, costs of the coarsest are .75 of those of the finest.
  std::vector<double> costs;
  for (const std::size_t around : {24u, 32u, 40u, 48u, 56u, 64u}) {
    const meshes::Surface_mesh mesh = meshes::surface_mesh(meshes::two_spheres_with_neck(2.0001, 0.1, around));
    const auto hierarchy = hierarchy_via_random_walks(mesh);
    EXPECT_EQ(Cost_threshold_stop(1)(hierarchy), 2u) << around;
    costs.push_back(hierarchy.merges().back().cost);
  }
  const auto [least, most] = std::minmax_element(costs.begin(), costs.end());
  EXPECT_LT(*most, 1.1 * *least);
}

TYPED_TEST(Automatic, LeavesASphereAndAPlaneWhole) {
  for (const meshes::Shape& shape : {meshes::sphere(4), meshes::plane(20)}) {
    const TypeParam held(shape);
    Face_labels<typename TypeParam::Mesh> ids(held.mesh);
    EXPECT_EQ(segmentation_via_random_walks(held.mesh, ids.map()), 1u);
    EXPECT_EQ(number_of(ids.values()), 1u);
  }
}

TYPED_TEST(Automatic, NeverJoinsComponents) {
  const meshes::Shape one = meshes::sphere(2);
  const meshes::Shape shape = meshes::together(meshes::together(one, meshes::moved(one, {3, 0, 0})),
                                               meshes::moved(meshes::plane(3), {0, 0, 5}));
  const TypeParam held(shape);
  Face_labels<typename TypeParam::Mesh> ids(held.mesh);
  EXPECT_EQ(segmentation_via_random_walks(held.mesh, ids.map()), 3u);
  const auto& id = ids.values();
  for (std::size_t f = 0; f < id.size(); ++f) EXPECT_EQ(id[f], id[f < 320 ? 0 : f < 640 ? 320 : 640]);
  EXPECT_THROW(segmentation_via_random_walks(held.mesh, ids.map(), Automatic_segmentation(2)), std::invalid_argument);
  EXPECT_EQ(segmentation_via_random_walks(held.mesh, ids.map(), Automatic_segmentation(5)), 5u);
}

TYPED_TEST(Automatic, GivesEveryNumberOfSegmentsExactlyAndNested) {
  const TypeParam held(dumbbell(20));
  Face_labels<typename TypeParam::Mesh> ids(held.mesh), finer(held.mesh);
  std::vector<std::size_t> before;
  const auto hierarchy = hierarchy_via_random_walks(held.mesh);
  for (std::size_t n = 1; n <= hierarchy.number_of_fragments(); ++n) {
    EXPECT_EQ(hierarchy.segments(Segment_count_stop(n), finer.map()), n);
    EXPECT_EQ(number_of(finer.values()), n);
    if (n > 1) {
      std::unordered_map<std::size_t, std::size_t> coarse_of;
      for (std::size_t f = 0; f < finer.values().size(); ++f)
        EXPECT_EQ(coarse_of.emplace(finer.values()[f], before[f]).first->second, before[f]);
    }
    before = finer.values();
  }
  EXPECT_EQ(segmentation_via_random_walks(held.mesh, ids.map(), Automatic_segmentation(3)), 3u);
}

TYPED_TEST(Automatic, TakesTheUsersSeedsAmongItsOwn) {
  const TypeParam held(dumbbell(20));
  Face_labels<typename TypeParam::Mesh> ids(held.mesh);
  const std::vector<typename Face_labels<typename TypeParam::Mesh>::face_descriptor> given = {ids.face(100),
                                                                                              ids.face(105)};
  const auto hierarchy = hierarchy_via_random_walks(held.mesh, Automatic_segmentation(), given);
  EXPECT_EQ(hierarchy.report().seeds, 42u);
  hierarchy.segments(Segment_count_stop(hierarchy.number_of_fragments()), ids.map());
  EXPECT_NE(ids.values()[100], ids.values()[105]);
}

// ---- Invariance and robustness ----

TEST(AutomaticSegmentation, DoesNotDependOnScalePlaceOrRotation) {
  const meshes::Shape shape = meshes::with_noise(dumbbell(), 0.003);
  const auto expected = segments_of(shape, Automatic_segmentation(4));
  for (const auto& other : {meshes::scaled(shape, 1e100), meshes::scaled(shape, 1e-100),
                            meshes::transformed(shape, meshes::some_rotation()), meshes::moved(shape, {1e3, 0, -1e3})})
    EXPECT_LE(rand_error(segments_of(other, Automatic_segmentation(4)), expected), 0.01);
}

TEST(AutomaticSegmentation, HardlyDependsOnTheOrderOfFaces) {
  const meshes::Shape shape = meshes::with_noise(dumbbell(), 0.003);
  const auto order = meshes::random_order(shape.faces.size());
  const auto expected = segments_of(shape), shuffled = segments_of(meshes::with_faces_in_order(shape, order));
  std::vector<std::size_t> back(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) back[order[i]] = shuffled[i];
  EXPECT_LE(rand_error(back, expected), 0.02);
}

TEST(AutomaticSegmentation, AgreesWithItselfOverResolutions) {
  const meshes::Shape coarse = dumbbell(64), fine = meshes::subdivided(coarse);
  const auto of_coarse = segments_of(coarse), of_fine = segments_of(fine);
  std::vector<std::size_t> expected;  // each face makes four in a row
  for (const std::size_t id : of_coarse) expected.insert(expected.end(), 4, id);
  EXPECT_LE(rand_error(of_fine, expected), 0.05);
}

TEST(AutomaticSegmentation, BearsNoise) {
  const meshes::Shape shape = dumbbell(64);
  const auto clean = segments_of(shape);
  EXPECT_EQ(number_of(clean), 3u);  // two spheres and the neck
  const double diagonal = std::sqrt(4 + 4 + 4.4 * 4.4);
  for (const double noise : {0.001, 0.003, 0.005})
    EXPECT_LE(rand_error(segments_of(meshes::with_noise(shape, noise * diagonal)), clean), 0.03) << noise;
}

TEST(AutomaticSegmentation, TakesTheShapeFromSmoothedVerticesUnderHeavyNoiseAlone) {
  const meshes::Shape shape = dumbbell(64);
  const auto has_heavy_noise = [](const meshes::Shape& s) {
    return hierarchy_via_random_walks(meshes::surface_mesh(s)).report().has_heavy_noise;
  };
  EXPECT_FALSE(has_heavy_noise(shape));
  EXPECT_FALSE(has_heavy_noise(meshes::cube(8)));
  EXPECT_TRUE(has_heavy_noise(meshes::with_noise(shape, 0.02)));
}

TEST(AutomaticSegmentation, CutsTheArmsOfAnLApartWhenAskedForTwo) {
  for (const std::size_t n : {4u, 8u, 16u, 32u}) {
    const meshes::Shape shape = meshes::l_shape(n);
    const auto ids = segments_of(shape, Automatic_segmentation(2));
    std::set<std::size_t> of_one_arm, of_the_other;
    for (std::size_t f = 0; f < ids.size(); ++f) {
      const Eigen::Vector3d& corner = shape.points[shape.faces[f][0]];
      if (corner.x() > 1.5) of_one_arm.insert(ids[f]);
      if (corner.y() > 1.5) of_the_other.insert(ids[f]);
    }
    EXPECT_EQ(of_one_arm.size(), 1u);
    EXPECT_EQ(of_the_other.size(), 1u);
    EXPECT_NE(of_one_arm, of_the_other);
  }
}

TEST(AutomaticSegmentation, IsTheSameEveryTime) {
  const auto mesh = meshes::data_mesh("elephant.off");
  if (!mesh) GTEST_SKIP() << "CGAL's data meshes are not installed";
  Face_labels<meshes::Surface_mesh> first(*mesh), second(*mesh);
  const std::size_t segments = segmentation_via_random_walks(*mesh, first.map());
  segmentation_via_random_walks(*mesh, second.map());
  EXPECT_EQ(first.values(), second.values());
  EXPECT_GE(segments, 6u);
  EXPECT_LE(segments, 20u);
}

TEST(PaperSegmentation, CutsTwoSpheresApartWhenAskedForTwo) {
  const auto ids = segments_of(dumbbell(), Paper_segmentation(2));
  EXPECT_EQ(number_of(ids), 2u);
  EXPECT_NE(ids.front(), ids.back());
}

// ---- Bad and odd input ----

TEST(AutomaticPathologies, AnEmptyMeshHasNoSegments) {
  const meshes::Surface_mesh mesh;
  Face_labels<meshes::Surface_mesh> ids(mesh);
  EXPECT_EQ(segmentation_via_random_walks(mesh, ids.map()), 0u);
}

TEST(AutomaticPathologies, ASingleFaceIsOneSegment) {
  meshes::Shape shape = meshes::plane(1);
  shape.faces.resize(1);
  EXPECT_EQ(number_of(segments_of(shape)), 1u);
}

TEST(AutomaticPathologies, APlaneIsOneSegmentWhetherRotatedOrNot) {
  EXPECT_EQ(number_of(segments_of(meshes::transformed(meshes::plane(15), meshes::some_rotation()))), 1u);
}

TEST(AutomaticPathologies, FacesWithoutAreaJoinTheirNeighbours) {
  meshes::Shape shape = dumbbell();
  shape.points[shape.faces[50][0]] = shape.points[shape.faces[50][1]];
  const auto ids = segments_of(shape, Automatic_segmentation(2));
  EXPECT_EQ(number_of(ids), 2u);
  EXPECT_EQ(ids[50], ids[20]);
}

TEST(AutomaticPathologies, QuadsAreSegmentedLikeTriangles) {
  EXPECT_EQ(number_of(segments_of(meshes::cube_of_quads(), Automatic_segmentation(6))), 6u);
}

TEST(AutomaticPathologies, AWrongNumberOfSegmentsIsAnErrorThatWritesNothing) {
  const auto mesh = meshes::surface_mesh(meshes::sphere(1));
  Face_labels<meshes::Surface_mesh> ids(mesh);
  for (const std::size_t n : {std::size_t(0), num_faces(mesh) + std::size_t(1), std::size_t(1000000)})
    EXPECT_THROW(segmentation_via_random_walks(mesh, ids.map(), Automatic_segmentation(n)), std::invalid_argument);
  EXPECT_EQ(ids.values(), std::vector<std::size_t>(80, ids.untouched));
}

TEST(AutomaticPathologies, MoreSegmentsThanTheMapHasValuesForAreAnErrorThatWritesNothing) {
  auto mesh = meshes::surface_mesh(dumbbell());
  const auto ids = mesh.add_property_map<meshes::Surface_mesh::Face_index, signed char>("f:id", -7).first;
  EXPECT_THROW(segmentation_via_random_walks(mesh, ids, Automatic_segmentation(129)), std::invalid_argument);
  const auto hierarchy = hierarchy_via_random_walks(mesh, Automatic_segmentation(129));
  EXPECT_THROW(hierarchy.segments(Segment_count_stop(129), ids), std::invalid_argument);
  for (const auto face : faces(mesh)) EXPECT_EQ(ids[face], -7);
  EXPECT_EQ(hierarchy.segments(Segment_count_stop(128), ids), 128u);
}

TEST(AutomaticPathologies, ACoordinateThatIsNotFiniteIsAnErrorThatNamesTheVertex) {
  meshes::Shape shape = meshes::sphere(1);
  shape.points[7].y() = std::numeric_limits<double>::quiet_NaN();
  const auto mesh = meshes::surface_mesh(shape);
  Face_labels<meshes::Surface_mesh> ids(mesh);
  try {
    segmentation_via_random_walks(mesh, ids.map());
    ADD_FAILURE() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("vertex 7"), std::string::npos) << error.what();
  }
  EXPECT_EQ(ids.values().front(), ids.untouched);
}

TEST(AutomaticPathologies, NumbersOutOfRangeAreErrors) {
  const auto mesh = meshes::surface_mesh(meshes::sphere(1));
  Face_labels<meshes::Surface_mesh> ids(mesh);
  Automatic_segmentation policy;
  policy.sigma = 0;
  EXPECT_THROW(segmentation_via_random_walks(mesh, ids.map(), policy), std::invalid_argument);
  policy = Automatic_segmentation();
  policy.seeding.count = 0;
  EXPECT_THROW(segmentation_via_random_walks(mesh, ids.map(), policy), std::invalid_argument);
  policy = Automatic_segmentation();
  policy.difference.convex_weight = -1;
  EXPECT_THROW(segmentation_via_random_walks(mesh, ids.map(), policy), std::invalid_argument);
  for (const double share : {-0.5, std::numeric_limits<double>::quiet_NaN()}) {
    policy = Automatic_segmentation();
    policy.least_component = share;
    EXPECT_THROW(segmentation_via_random_walks(mesh, ids.map(), policy), std::invalid_argument);
    EXPECT_THROW(hierarchy_via_random_walks(mesh, policy), std::invalid_argument);
  }
  EXPECT_EQ(ids.values().front(), ids.untouched);
}

TEST(AutomaticPathologies, TheCallbackSeesProgressAndCancels) {
  // Large enough for the walk to report within its stages.
  const auto mesh = meshes::surface_mesh(meshes::two_spheres_with_neck(2.4, 0.3, 64));
  Face_labels<meshes::Surface_mesh> ids(mesh);
  std::vector<double> seen;
  const auto run = [&](double end) {
    const std::function<bool(double)> callback = [&seen, end](double fraction) {
      seen.push_back(fraction);
      return fraction < end;
    };
    const std::vector<Face_labels<meshes::Surface_mesh>::face_descriptor> none;
    segmentation_via_random_walks(mesh, ids.map(), Automatic_segmentation(), none,
                                  CGAL::parameters::callback(callback));
  };
  EXPECT_THROW(run(0.5), Cancelled);
  EXPECT_EQ(ids.values().front(), ids.untouched);
  seen.clear();
  run(2);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1);
}

TEST(AutomaticPathologies, OfNoFacesNothingIsReported) {
  const Segmentation_report report = hierarchy_via_random_walks(meshes::Surface_mesh()).report();
  EXPECT_EQ(report.components + report.seeds + report.clusters + report.fragments, 0u);
  EXPECT_EQ(report.degenerate_faces + report.island_faces, 0u);
  EXPECT_FALSE(report.has_heavy_noise);
}

}  // namespace test_segmentation_via_random_walks
