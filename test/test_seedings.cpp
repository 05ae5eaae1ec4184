// SPDX-License-Identifier: MIT

// What several seedings agree on.

#include <RW_segmentation/internal/merging/Consensus_cost.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include <gtest/gtest.h>
#include "face_labels.h"
#include "meshes.h"

#include <boost/property_map/function_property_map.hpp>

#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace test_seedings {

using namespace RW_segmentation;
using internal::Seeding_agreement;

namespace {

using Mesh = meshes::Surface_mesh;
using Index = Dual_mesh::Index;
using Labels = std::vector<std::size_t>;

Automatic_segmentation with_seedings(std::size_t seedings, Automatic_segmentation policies = Automatic_segmentation()) {
  policies.seedings = seedings;
  return policies;
}

template <class Policies>
Labels labels_of(const Mesh& mesh, const Policies& policies) {
  Face_labels<Mesh> ids(mesh);
  segmentation_via_random_walks(mesh, ids.map(), policies);
  return ids.values();
}

meshes::Shape dumbbell(std::size_t around = 40) { return meshes::two_spheres_with_neck(2.4, 0.3, around); }

std::size_t number_of_labels(const Labels& labels) {
  return std::set<std::size_t>(labels.begin(), labels.end()).size();
}

/// Labels by the order in which they come, so that equal partitions are equal.
Labels in_order(const Labels& labels) {
  std::map<std::size_t, std::size_t> number;
  Labels result;
  for (const std::size_t label : labels) result.push_back(number.emplace(label, number.size()).first->second);
  return result;
}

/// The number of connected parts that faces of one label make.
std::size_t number_of_parts(const Dual_mesh& mesh, const Labels& labels) {
  return internal::Components(mesh.graph(),
                              [&](Index e) {
                                const auto [f, g] = mesh.graph().faces_of(e);
                                return labels[f] == labels[g];
                              })
      .count;
}

}  // namespace

TEST(SeedingAgreement, IsOneOverOnePlusTheSquareOfTheCostThatJoins) {
  // Costs fall from the first merge to the second, which is not reached before the first is done.
  const std::vector<Merge_tree> trees = {Merge_tree(4, {{0, 1, 2.}, {2, 4, 1.}}), Merge_tree(2, {{0, 1, 0.5}})};
  const Seeding_agreement agreement(trees);
  const auto of = [&](const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
    return agreement(Seeding_agreement::region(a, 0.3), Seeding_agreement::region(b, 0.1));
  };
  EXPECT_NEAR(of({0, 0}, {0, 0}), 1, 1e-6);
  EXPECT_NEAR(of({0, 0}, {1, 0}), (1 / 5. + 1) / 2, 1e-6);
  EXPECT_NEAR(of({0, 0}, {2, 1}), (1 / 5. + 0.8) / 2, 1e-6);
  EXPECT_NEAR(of({3, 0}, {2, 1}), (0 + 0.8) / 2, 1e-6) << "nothing joins fragment 3";
}

TEST(SeedingAgreement, OfRegionsIsTheMeanOverPairsOfTheirParts) {
  const Seeding_agreement agreement(
      {Merge_tree(4, {{0, 1, 0.3}, {2, 3, 0.7}, {4, 5, 2.}}), Merge_tree(3, {{0, 2, 0.1}, {1, 3, 1.5}})});
  const std::vector<std::pair<std::vector<std::size_t>, double>> pieces = {
      {{0, 0}, 0.2}, {{1, 0}, 0.1}, {{1, 1}, 0.3}, {{2, 1}, 0.15}, {{3, 2}, 0.05}, {{0, 2}, 0.2}};
  const auto joined = [&](std::size_t begin, std::size_t end) {
    auto region = Seeding_agreement::region(pieces[begin].first, pieces[begin].second);
    for (std::size_t i = begin + 1; i < end; ++i)
      Seeding_agreement::join(region, Seeding_agreement::region(pieces[i].first, pieces[i].second));
    return region;
  };
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 3; j < 6; ++j) {
      const double both = pieces[i].second * pieces[j].second;
      sum += both * agreement(joined(i, i + 1), joined(j, j + 1));
      weight += both;
    }
  EXPECT_NEAR(agreement(joined(0, 3), joined(3, 6)), sum / weight, 1e-9);
  EXPECT_NEAR(agreement(joined(3, 6), joined(0, 3)), sum / weight, 1e-9);
}

TEST(CommonRefinement, HasConnectedPiecesInOneFragmentOfEverySeeding) {
  const Mesh mesh = meshes::surface_mesh(meshes::torus(1, 0.4, 24, 12));
  const Dual_mesh_of dual(mesh);
  // By the first seeding, one side without a slit, whose faces go with the other side; by the second one, two halves.
  std::vector<Labels> fragments(2);
  for (Index f = 0; f < dual.number_of_faces(); ++f) {
    const Eigen::Vector3d p = dual.unit() * dual.centroid(f) + Eigen::Vector3d(dual.origin().x(), dual.origin().y(), 0);
    fragments[0].push_back(p.x() > 0 && std::abs(p.y()) > 0.3);
    fragments[1].push_back(p.y() > 0);
  }
  ASSERT_EQ(std::set<std::size_t>(fragments[0].begin(), fragments[0].end()).size(), 2u);
  const std::vector<double> conductance(dual.number_of_edges(), 1);
  const auto refinement = internal::common_refinement(dual.graph(), conductance, fragments);
  EXPECT_EQ(number_of_parts(dual, refinement.of_face), refinement.fragments_of.size()) << "each is connected";
  for (Index f = 0; f < dual.number_of_faces(); ++f)
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(refinement.fragments_of[refinement.of_face[f]][k], fragments[k][f]);
  for (Index e = 0; e < dual.number_of_edges(); ++e) {
    const auto [f, g] = dual.graph().faces_of(e);
    EXPECT_EQ(refinement.of_face[f] == refinement.of_face[g],
              fragments[0][f] == fragments[0][g] && fragments[1][f] == fragments[1][g]);
  }
}

TEST(Seedings, AreTwoUnlessTheirPoliciesAreOthers) {
  const Mesh mesh = meshes::surface_mesh(meshes::with_noise(dumbbell(), 0.003));
  EXPECT_EQ(labels_of(mesh, with_seedings(2)), labels_of(mesh, Automatic_segmentation()));
  const auto with_other_stop = Automatic_segmentation().with_stop(Segment_count_stop(4));
  EXPECT_EQ(labels_of(mesh, with_other_stop), labels_of(mesh, Automatic_segmentation(4)));
  // Further seeds would not be placed by a seeding, and another cost may mean anything where several agree.
  const auto with_other_cost = Automatic_segmentation().with_merge_cost(Size_aware_cost_policy());
  EXPECT_EQ(hierarchy_via_random_walks(mesh, with_other_cost).number_of_fragments(), with_other_cost.seeding.count);
  const auto with_other_seeding =
      Automatic_segmentation().with_seeding(Feature_sensitive_seeding<Farthest_point_sampling>{12, {}});
  EXPECT_EQ(hierarchy_via_random_walks(mesh, with_other_seeding).number_of_fragments(), 12u);
}

TEST(Seedings, NoneAreRefused) {
  const Mesh mesh = meshes::surface_mesh(meshes::cube(3));
  EXPECT_THROW(hierarchy_via_random_walks(mesh, with_seedings(0)), std::invalid_argument);
}

TEST(Seedings, PartADumbbellAtItsNeck) {
  const Mesh mesh = meshes::surface_mesh(dumbbell());
  const Labels labels = labels_of(mesh, with_seedings(4, Automatic_segmentation(2)));
  std::size_t f = 0, wrong = 0;
  for (const auto face : faces(mesh)) {
    const double z = mesh.point(target(halfedge(face, mesh), mesh)).z();
    if (std::abs(z) > 0.5) wrong += labels[f] != labels[z < 0 ? 0 : labels.size() - 1];
    ++f;
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(number_of_labels(labels), 2u);
}

TEST(Seedings, GiveConnectedSegmentsAtEveryLevel) {
  const Mesh mesh = meshes::surface_mesh(meshes::with_noise(dumbbell(), 0.003));
  const Dual_mesh_of dual(mesh);
  const auto hierarchy = hierarchy_via_random_walks(mesh, with_seedings(4));
  for (const std::size_t segments :
       {std::size_t(2), std::size_t(5), std::size_t(20), hierarchy.number_of_fragments()}) {
    Face_labels<Mesh> ids(mesh);
    hierarchy.segments(Segment_count_stop(segments), ids.map());
    const Labels by_index = dual.read_faces(ids.map(), [](std::size_t label) { return label; });
    EXPECT_EQ(number_of_parts(dual, by_index), segments);
  }
}

TEST(Seedings, DoNotDependOnTheOrderOfTheFaces) {
  const meshes::Shape shape = meshes::with_noise(dumbbell(), 0.003);
  const auto order = meshes::random_order(shape.faces.size());
  const Labels labels = labels_of(meshes::surface_mesh(shape), with_seedings(4));
  const Labels permuted = labels_of(meshes::surface_mesh(meshes::with_faces_in_order(shape, order)), with_seedings(4));
  Labels expected;
  for (const std::size_t face : order) expected.push_back(labels[face]);
  EXPECT_EQ(in_order(permuted), in_order(expected));
}

TEST(Seedings, DoNotDependOnThreads) {
  const Mesh mesh = meshes::surface_mesh(dumbbell());
  Face_labels<Mesh> sequential(mesh);
  segmentation_via_random_walks<CGAL::Sequential_tag>(mesh, sequential.map(), with_seedings(4));
  EXPECT_EQ(labels_of(mesh, with_seedings(4)), sequential.values());
}

TEST(Seedings, CrossNoWallAndJoinNoComponents) {
  const Mesh mesh = meshes::surface_mesh(meshes::together(dumbbell(), meshes::moved(meshes::sphere(3), {5, 0, 0})));
  // A wall round the upper ball, which cuts it where no concavity is.
  const auto is_above = [&](Mesh::Face_index f) { return mesh.point(target(halfedge(f, mesh), mesh)).z() > 1.3; };
  const auto walls = boost::make_function_property_map<Mesh::Edge_index>([&](Mesh::Edge_index e) {
    const auto h = halfedge(e, mesh);
    return is_above(face(h, mesh)) != is_above(face(opposite(h, mesh), mesh));
  });
  for (const Automatic_segmentation& policies : {with_seedings(4), with_seedings(4, Automatic_segmentation(3))}) {
    Face_labels<Mesh> ids(mesh);
    segmentation_via_random_walks(mesh, ids.map(), policies, CGAL::parameters::edge_is_constrained_map(walls));
    std::set<std::size_t> above, below, ball;
    for (const auto f : faces(mesh))
      (mesh.point(target(halfedge(f, mesh), mesh)).x() > 3 ? ball
       : is_above(f)                                       ? above
                                                           : below)
          .insert(get(ids.map(), f));
    for (const std::size_t label : above) EXPECT_EQ(below.count(label) + ball.count(label), 0u);
    for (const std::size_t label : below) EXPECT_EQ(ball.count(label), 0u);
  }
}

TEST(Seedings, TakeEveryMeshThatOneSeedingTakes) {
  meshes::Shape folded;
  folded.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  folded.faces = {{0, 1, 2}, {0, 2, 1}};
  meshes::Shape point = meshes::cube(3);
  for (auto& p : point.points) p.setConstant(1);
  for (const meshes::Shape& shape : {folded, point, meshes::cube_of_quads(), meshes::cube(1), meshes::plane(12),
                                     meshes::folded_strip(-1, 12), meshes::tube(3, 30, 30)}) {
    const Mesh mesh = meshes::surface_mesh(shape);
    auto without_thickness = with_seedings(4);
    without_thickness.merge_cost.thickness.samples = 0;
    for (const Automatic_segmentation& policies : {with_seedings(4), without_thickness}) {
      const auto hierarchy = hierarchy_via_random_walks(mesh, policies);
      for (const auto& merge : hierarchy.merges()) EXPECT_GE(merge.cost, 0);
    }
  }
}

TEST(Seedings, KeepTheSeedsThatAreGiven) {
  const Mesh mesh = meshes::surface_mesh(dumbbell());
  const std::vector<Mesh::Face_index> given = {Mesh::Face_index(0), Mesh::Face_index(7)};
  const auto hierarchy = hierarchy_via_random_walks(mesh, with_seedings(4), given);
  Face_labels<Mesh> ids(mesh);
  hierarchy.segments(Segment_count_stop(hierarchy.number_of_fragments()), ids.map());
  EXPECT_NE(get(ids.map(), given[0]), get(ids.map(), given[1]));
}

TEST(Seedings, TakePoliciesOfAnyType) {
  const Mesh mesh = meshes::surface_mesh(dumbbell(24));
  // Seeds that nobody knows how to place anew, and a cost without sums of its own.
  const auto seeding = [](const Dual_mesh& dual, const std::vector<double>&, const std::vector<Index>&) {
    return std::vector<Index>{0, static_cast<Index>(dual.number_of_faces() / 2), 5};
  };
  auto policies = Automatic_segmentation().with_seeding(seeding).with_merge_cost(Size_aware_cost());
  policies.seedings = 3;
  const auto hierarchy = hierarchy_via_random_walks(mesh, policies);
  EXPECT_EQ(hierarchy.report().seeds, 3u);
  // Each piece lies in one of the three fragments that there are without further seedings.
  policies.seedings = 1;
  const auto alone = hierarchy_via_random_walks(mesh, policies);
  EXPECT_EQ(alone.number_of_fragments(), 3u);
  Face_labels<Mesh> pieces(mesh), fragments(mesh);
  hierarchy.segments(Segment_count_stop(hierarchy.number_of_fragments()), pieces.map());
  alone.segments(Segment_count_stop(3), fragments.map());
  std::map<std::size_t, std::set<std::size_t>> fragments_of;
  for (const auto f : faces(mesh)) fragments_of[get(pieces.map(), f)].insert(get(fragments.map(), f));
  for (const auto& [piece, of] : fragments_of) EXPECT_EQ(of.size(), 1u) << piece;
}

TEST(Seedings, GoByTheFirstOneForWhatNoOtherKnows) {
  // The second one begins at the last seed of the first one, and so parts the mesh elsewhere, but not across its creases.
  const Mesh mesh = meshes::surface_mesh(meshes::with_noise(dumbbell(), 0.003));
  const auto one = hierarchy_via_random_walks(mesh, with_seedings(1)),
             two = hierarchy_via_random_walks(mesh, with_seedings(2));
  EXPECT_EQ(one.report().seeds, two.report().seeds);
  EXPECT_GT(two.number_of_fragments(), one.number_of_fragments());
  EXPECT_EQ(two.number_of_fragments(), two.report().fragments);
}

TEST(Seedings, LeaveNoSmallPieceOfAFragment) {
  // Two beams at a right angle, with a crease along which the fragments of all seedings end.
  const Mesh mesh = meshes::surface_mesh(meshes::l_shape(16));
  const auto finest = [&](std::size_t seedings) {
    const auto hierarchy = hierarchy_via_random_walks(mesh, with_seedings(seedings));
    Face_labels<Mesh> ids(mesh);
    hierarchy.segments(Segment_count_stop(hierarchy.number_of_fragments()), ids.map());
    return ids.values();
  };
  const Dual_mesh_of dual(mesh);
  const Labels fragments = finest(1), pieces = finest(4);
  std::vector<double> area_of_fragment(number_of_labels(fragments)), area_of_piece(number_of_labels(pieces));
  std::map<std::size_t, std::size_t> fragment_of;
  for (Index f = 0; f < dual.number_of_faces(); ++f) {
    area_of_fragment[fragments[f]] += dual.area(f);
    area_of_piece[pieces[f]] += dual.area(f);
    fragment_of[pieces[f]] = fragments[f];
  }
  ASSERT_GT(area_of_piece.size(), area_of_fragment.size());
  const double least = 0.1 * dual.total_area() / static_cast<double>(area_of_fragment.size());
  for (const auto& [piece, fragment] : fragment_of)
    EXPECT_TRUE(area_of_piece[piece] >= least || area_of_piece[piece] >= area_of_fragment[fragment] * (1 - 1e-9));
}

}  // namespace test_seedings
