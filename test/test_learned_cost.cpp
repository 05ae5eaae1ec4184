// SPDX-License-Identifier: MIT

// The merge cost that is learned from people: its sums and features, and that it leaves alone what it was not learned for.

#include <RW_segmentation/Learned_cost.h>
#include <RW_segmentation/internal/merging/trees_of_learned_cost.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include <gtest/gtest.h>
#include "face_labels.h"
#include "meshes.h"

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace test_learned_cost {

using namespace RW_segmentation;

namespace {

using Mesh = meshes::Surface_mesh;
using Index = Dual_mesh::Index;
using Features = internal::Merge_features;
using Labels = std::vector<std::size_t>;

constexpr double pi = 3.14159265358979324;

Labels labels_of(const Mesh& mesh, const Automatic_segmentation& policies = Automatic_segmentation()) {
  Face_labels<Mesh> ids(mesh);
  segmentation_via_random_walks(mesh, ids.map(), policies);
  return ids.values();
}

template <class Policies>
std::vector<Merge_tree::Merge> merges_of(const Mesh& mesh, const Policies& policies) {
  return hierarchy_via_random_walks(mesh, policies).merges();
}

/// The automatic segmentation but for its merge cost.
template <class MergeCost>
auto automatic_with_cost(MergeCost cost) {
  auto policies = Automatic_segmentation().with_merge_cost(std::move(cost));
  policies.seedings = Automatic_segmentation().seedings;
  return policies;
}

void expect_same_merges(const std::vector<Merge_tree::Merge>& a, const std::vector<Merge_tree::Merge>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].first, b[i].first) << "merge " << i;
    EXPECT_EQ(a[i].second, b[i].second) << "merge " << i;
    EXPECT_EQ(a[i].cost, b[i].cost) << "merge " << i;
  }
}

meshes::Shape bumpy_dumbbell(std::size_t around = 40) {
  return meshes::with_noise(meshes::two_spheres_with_neck(2.4, 0.3, around), 0.003);
}

/// The features of two regions of a mesh and their boundary, from sums over single faces and edges.
Features features_of(const Dual_mesh& shape, const std::vector<double>& thickness, const std::vector<bool>& is_first) {
  const Learned_cost cost(shape, thickness);
  std::array<Learned_cost::Region, 2> regions;
  Learned_cost::Boundary common;
  for (Index f = 0; f < shape.number_of_faces(); ++f) cost.join(regions[is_first[f]], cost.region(shape, f));
  for (Index e = 0; e < shape.number_of_edges(); ++e) {
    const auto [f, g] = shape.graph().faces_of(e);
    if (is_first[f] != is_first[g]) common += cost.boundary(shape, e, 0);
  }
  return {regions[0].shape, regions[1].shape, common.shape, common.shape, common.shape};
}

/// The features of the parts of a mesh above and below a plane of constant z.
Features features_at_height(const Mesh& mesh, double height) {
  const Dual_mesh shape = smoothed_shape(mesh);
  std::vector<bool> is_first(shape.number_of_faces());
  const double z = (height - shape.origin().z()) / shape.unit();
  for (Index f = 0; f < shape.number_of_faces(); ++f) is_first[f] = shape.centroid(f).z() > z;
  return features_of(shape, internal::thickness_of_faces(shape, Thickness_sampling(), {}), is_first);
}

/// A rotation about an axis that is parallel to nothing, a scale and a shift.
Eigen::Affine3d some_motion(double scale) {
  Eigen::Affine3d motion = meshes::some_rotation();
  motion.prescale(scale);
  motion.pretranslate(scale * Eigen::Vector3d(3, -5, 7));
  return motion;
}

Mesh dumbbell(std::size_t around = 64) { return meshes::surface_mesh(meshes::two_spheres_with_neck(2.4, 0.3, around)); }

}  // namespace

TEST(LearnedCost, TreesAskTheFeaturesThatThereAre) {
  ASSERT_EQ(internal::features_of_learned_cost.size(), std::size_t(Features::count));
  for (std::size_t i = 0; i < Features::count; ++i)
    EXPECT_EQ(std::string(internal::features_of_learned_cost[i]), Features::names[i]);
}

TEST(LearnedCost, EveryTreeEndsInALeaf) {
  for (const internal::Decision_tree& tree : internal::trees_of_learned_cost) {
    std::set<int> reached;
    std::vector<int> open = {0};
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      ASSERT_TRUE(reached.insert(node).second) << "a child of two splits";
      if (node < 0) {
        ASSERT_LT(static_cast<std::size_t>(-1 - node), tree.leaves.size());
        EXPECT_TRUE(std::isfinite(tree.leaves[static_cast<std::size_t>(-1 - node)]));
        continue;
      }
      ASSERT_LT(static_cast<std::size_t>(node), tree.splits.size());
      const auto& split = tree.splits[static_cast<std::size_t>(node)];
      EXPECT_LT(split.feature, std::size_t(Features::count));
      EXPECT_TRUE(std::isfinite(split.threshold));
      open.insert(open.end(), {split.yes, split.no});
    }
  }
}

TEST(DecisionTree, AsksItsQuestionsInTurn) {
  const internal::Decision_tree tree = {{{{1, 0.5, 1, -1}, {0, 2, -2, -3}}}, {{10, 20, 30}}};
  using Numbers = std::array<double, 2>;
  EXPECT_EQ(tree(Numbers{0, 1}), 10);
  EXPECT_EQ(tree(Numbers{2, 0.5}), 20);
  EXPECT_EQ(tree(Numbers{3, 0}), 30);
}

TEST(MergeFeatures, OfABallCutInHalfAreThoseOfItsCircle) {
  const Mesh mesh = meshes::surface_mesh(meshes::sphere(5));
  const Features x = features_at_height(mesh, 0);
  // A ball of radius r has R = r sqrt(4 pi), a half of it the area 1/2 R^2 and the vector area pi r^2.
  EXPECT_NEAR(x[Features::small_area], std::log(0.5), 0.02);
  EXPECT_NEAR(x[Features::size], std::log(0.25), 0.02);
  EXPECT_NEAR(x[Features::openness_of_small], 0.5, 0.02);
  EXPECT_NEAR(x[Features::openness_of_whole], 0, 1e-6);
  // The boundary goes in zigzag along edges, longer than the circle by no more than 4 / pi.
  EXPECT_GT(x[Features::length], std::log(2 * pi / std::sqrt(4 * pi)) - 0.01);
  EXPECT_LT(x[Features::length], std::log(8 / std::sqrt(4 * pi)));
  EXPECT_GT(x[Features::closure], -0.01);
  EXPECT_LT(x[Features::closure], 2 * std::log(4 / pi));
  EXPECT_NEAR(x[Features::roundness], 1, 0.06);  // edges of the zigzag are denser in some directions
  EXPECT_LT(x[Features::warp], 0.05);
  EXPECT_NEAR(x[Features::cross_section], std::log(0.5), 0.05);
  EXPECT_NEAR(x[Features::across], 1, 0.02);
  EXPECT_EQ(x[Features::share_of_small], 1);
  EXPECT_EQ(x[Features::share_of_large], 1);
  EXPECT_LT(std::abs(x[Features::thickness_ratio]), 0.05);
}

TEST(MergeFeatures, OfAStraightBoundaryTellThatItIsOpen) {
  const Features x =
      features_at_height(meshes::surface_mesh(meshes::transformed(
                             meshes::plane(60), Eigen::Affine3d(Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitX())))),
                         0.5);
  EXPECT_NEAR(x[Features::closure], std::log(12 / (4 * pi * pi)), 0.05);  // a straight line's moment is L^2 / 12
  EXPECT_LT(x[Features::roundness], 0.1);
  EXPECT_NEAR(x[Features::openness_of_small], 1, 1e-6);
}

TEST(MergeFeatures, DoNotDependOnPositionScaleDirectionOrOrder) {
  const meshes::Shape shape = bumpy_dumbbell();
  const Dual_mesh dual = smoothed_shape(meshes::surface_mesh(shape));
  // Rays leave in directions that depend on the axes: all take the thickness of the one mesh.
  const auto thickness = internal::thickness_of_faces(dual, Thickness_sampling(), {});
  std::vector<bool> is_first(dual.number_of_faces());
  for (Index f = 0; f < is_first.size(); ++f)
    is_first[f] = dual.centroid(f).z() > (0.9 - dual.origin().z()) / dual.unit();
  const Features expected = features_of(dual, thickness, is_first);
  for (const double scale : {1., 1e-3, 1e6}) {
    const auto move = some_motion(scale);
    const Dual_mesh moved = smoothed_shape(meshes::surface_mesh(meshes::transformed(shape, move)));
    std::vector<double> moved_thickness = thickness;
    for (double& t : moved_thickness) t *= dual.unit() * scale / moved.unit();
    for (const bool is_turned : {false, true}) {
      std::vector<bool> first = is_first;
      if (is_turned) first.flip();
      const Features x = features_of(moved, moved_thickness, first);
      for (std::size_t i = 0; i < Features::count; ++i)
        EXPECT_NEAR(x[i], expected[i], 0.005) << Features::names[i];  // as far as normals are smoothed
    }
  }
}

TEST(MergeFeatures, HardlyDependOnTheNumberOfFaces) {
  const Features coarse = features_at_height(dumbbell(48), 1.2), fine = features_at_height(dumbbell(192), 1.2);
  for (const auto name : {Features::length, Features::small_area, Features::openness_of_small, Features::closure,
                          Features::roundness, Features::cross_section, Features::small_girth, Features::across})
    EXPECT_NEAR(coarse[name], fine[name], 0.08) << Features::names[name];
  for (const auto name : {Features::inward_curvature, Features::outward_curvature})
    EXPECT_NEAR(coarse[name], fine[name], 0.4) << Features::names[name];  // 16 times as many faces
}

TEST(LearnedCost, IsThatOfItsFormula) {
  const Mesh mesh = meshes::surface_mesh(bumpy_dumbbell());
  const Dual_mesh shape = smoothed_shape(mesh);
  const auto thickness = internal::thickness_of_faces(shape, Thickness_sampling(), {});
  const internal::Decision_tree constant = {{{{0, 0, -1, -1}}}, {{std::log(3.)}}};
  const internal::Boosted_trees odds_of_three = {&constant, 1};
  const Learned_cost cost(shape, thickness, odds_of_three);
  const Size_aware_cost size_aware(thickness, internal::crease_weight(shape.number_of_edges()));
  const auto difference = smoothed_concavity()(shape);
  std::array<Learned_cost::Region, 2> regions;
  std::array<Size_aware_cost::Region, 2> sizes;
  Learned_cost::Boundary common;
  for (Index f = 0; f < shape.number_of_faces(); ++f) {
    const bool upper = shape.centroid(f).z() > 0;
    cost.join(regions[upper], cost.region(shape, f));
    size_aware.join(sizes[upper], size_aware.region(shape, f));
  }
  Edge_sums sums;
  for (Index e = 0; e < shape.number_of_edges(); ++e) {
    const auto [f, g] = shape.graph().faces_of(e);
    if ((shape.centroid(f).z() > 0) == (shape.centroid(g).z() > 0)) continue;
    common += cost.boundary(shape, e, difference[e]);
    sums += {shape.edge_length(e) / shape.length_unit(), shape.edge_length(e) / shape.length_unit() * difference[e]};
  }
  const Region_boundary_of<Learned_cost::Boundary> boundary = {common, common, common};
  const double c = size_aware(sizes[0], sizes[1], {sums, {}});
  EXPECT_NEAR(cost.size_aware_cost(regions[0], regions[1], boundary), c, 1e-12 * c);
  EXPECT_NEAR(cost(regions[0], regions[1], boundary), std::pow(c, 0.65) * std::pow(1 / 3., 0.35), 1e-9 * c);
  EXPECT_EQ(cost(regions[0], regions[1], boundary), cost(regions[1], regions[0], boundary));
}

TEST(LearnedCost, WithoutThicknessIsTheSizeAwareCost) {
  auto learned = Automatic_segmentation();
  learned.merge_cost.thickness.samples = 0;
  auto size_aware = automatic_with_cost(Size_aware_cost_policy());
  size_aware.merge_cost.thickness.samples = 0;
  const Mesh mesh = meshes::surface_mesh(bumpy_dumbbell());
  expect_same_merges(merges_of(mesh, learned), merges_of(mesh, size_aware));
}

TEST(LearnedCost, OfOpenAndFlatSurfacesIsTheSizeAwareCost) {
  for (const meshes::Shape& shape :
       {meshes::plane(20), meshes::with_noise(meshes::plane(30), 0.002), meshes::folded_strip(-1, 12)}) {
    const Mesh mesh = meshes::surface_mesh(shape);
    expect_same_merges(merges_of(mesh, Automatic_segmentation()),
                       merges_of(mesh, automatic_with_cost(Size_aware_cost_policy())));
  }
}

TEST(LearnedCost, IsNeverNaN) {
  // Faces without area or length, a point, closed polygons, two surfaces back to back: merging refuses a cost that is NaN.
  meshes::Shape folded;
  folded.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  folded.faces = {{0, 1, 2}, {0, 2, 1}};
  meshes::Shape point = meshes::cube(3);
  for (auto& p : point.points) p.setConstant(1);
  meshes::Shape thin = meshes::cube(6);
  for (auto& p : thin.points) p.z() *= 1e-12;
  for (const meshes::Shape& shape : {folded, point, thin, meshes::cube_of_quads(), meshes::cube(1), meshes::cube(12),
                                     meshes::with_noise(meshes::sphere(3), 0.3), meshes::tube(3, 30, 30)}) {
    const Mesh mesh = meshes::surface_mesh(shape);
    const auto merges = merges_of(mesh, Automatic_segmentation());
    EXPECT_EQ(merges.empty(), false);
    for (const auto& merge : merges) EXPECT_GE(merge.cost, 0);
  }
}

TEST(LearnedCost, HeedsAnInfiniteDifferenceAndNone) {
  const Mesh mesh = meshes::surface_mesh(bumpy_dumbbell());
  for (const double value : {0., std::numeric_limits<double>::infinity()}) {
    const auto policies = Automatic_segmentation().with_difference(
        [&](const Dual_mesh& dual) { return std::vector<double>(dual.number_of_edges(), value); });
    for (const auto& merge : merges_of(mesh, policies)) EXPECT_EQ(std::isinf(merge.cost), std::isinf(value));
  }
}

TEST(LearnedCost, PartsADumbbellAtItsNeck) {
  const Mesh mesh = dumbbell();
  const Labels labels = labels_of(mesh, Automatic_segmentation(2));
  std::size_t f = 0, wrong = 0;
  for (const auto face : faces(mesh)) {
    const double z = mesh.point(target(halfedge(face, mesh), mesh)).z();
    if (std::abs(z) > 0.5) wrong += labels[f] != labels[z < 0 ? 0 : labels.size() - 1];
    ++f;
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_NE(labels.front(), labels.back());
}

TEST(LearnedCost, TakesAStoredThicknessInTheMeshsUnit) {
  for (const double scale : {1., 1e4}) {
    const Mesh mesh = meshes::surface_mesh(meshes::scaled(bumpy_dumbbell(), scale));
    const Dual_mesh_of shape = smoothed_shape(mesh);
    std::vector<double> thickness(num_faces(mesh));
    const auto map = boost::make_function_property_map<Mesh::Face_index>(
        [&](Mesh::Face_index f) -> double& { return thickness[f]; });
    local_thickness(shape, map);
    const auto merges = merges_of(mesh, Automatic_segmentation());
    const auto stored = merges_of(mesh, automatic_with_cost(Learned_cost(shape, map)));
    ASSERT_EQ(merges.size(), stored.size());
    for (std::size_t i = 0; i < merges.size(); ++i) EXPECT_NEAR(merges[i].cost, stored[i].cost, 1e-9);
  }
}

}  // namespace test_learned_cost
