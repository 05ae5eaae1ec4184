// SPDX-License-Identifier: MIT

#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Paper_segmentation.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/threads.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <gtest/gtest.h>
#include <boost/property_map/function_property_map.hpp>
#include "../benchmark/segmentation_measures.h"
#include "face_labels.h"
#include "meshes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace test_components {

using namespace RW_segmentation;

namespace {

using Labels = std::vector<std::size_t>;
using Mesh = meshes::Surface_mesh;

/// A body with a limb each way: nothing about it is symmetric.
meshes::Shape cross(std::size_t n) {
  return meshes::cubes({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 0, 1}}, n);
}

/// Two spheres joined by a neck.
meshes::Shape dumbbell(std::size_t around) { return meshes::two_spheres_with_neck(2.0001, 0.1, around); }

/// Shapes far apart, each of its own size.
meshes::Shape side_by_side(const std::vector<meshes::Shape>& shapes) {
  meshes::Shape all;
  double x = 0;
  for (const meshes::Shape& shape : shapes) all = meshes::together(all, meshes::moved(shape, {x += 20, 0, 0}));
  return all;
}

template <class Policy = Automatic_segmentation>
Labels segments_of(const meshes::Shape& shape, const Policy& policy = Policy()) {
  const Mesh mesh = meshes::surface_mesh(shape);
  Face_labels<Mesh> ids(mesh);
  segmentation_via_random_walks(mesh, ids.map(), policy);
  return ids.values();
}

std::size_t number_of(const Labels& ids) { return std::set<std::size_t>(ids.begin(), ids.end()).size(); }

/// The labels of one shape after the other.
std::vector<Labels> parts_of(const Labels& ids, const std::vector<meshes::Shape>& shapes) {
  std::vector<Labels> parts;
  auto begin = ids.begin();
  for (const meshes::Shape& shape : shapes) {
    parts.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(shape.faces.size()));
    begin += static_cast<std::ptrdiff_t>(shape.faces.size());
  }
  return parts;
}

void expect_same_segments(const Labels& a, const Labels& b) {
  EXPECT_EQ(number_of(a), number_of(b));
  EXPECT_EQ(segmentation_measures::Overlaps(a, b).rand_index_error(), 0);
}

template <class Holder>
class Component : public testing::Test {};
TYPED_TEST_SUITE(Component, meshes::Holders);

}  // namespace

// ---- Components as meshes of their own ----

TYPED_TEST(Component, IsMeasuredAsItIsByItself) {
  const std::vector<meshes::Shape> shapes = {dumbbell(12), meshes::scaled(cross(2), 0.01), meshes::plane(3)};
  const TypeParam held(side_by_side(shapes));
  const Dual_mesh_of whole(held.mesh);
  const auto stretches = internal::connected_stretches(whole.graph());
  ASSERT_EQ(stretches.size(), 3u);
  std::size_t first = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const TypeParam held_alone(shapes[i]);
    const Dual_mesh_of alone(held_alone.mesh);
    const auto component = whole.component(stretches[i]);
    ASSERT_EQ(component.number_of_faces(), alone.number_of_faces());
    ASSERT_EQ(component.number_of_edges(), alone.number_of_edges());
    EXPECT_EQ(component.number_of_vertices(), alone.number_of_vertices());
    EXPECT_NEAR(component.unit(), alone.unit(), 1e-12 * alone.unit());
    EXPECT_LT((component.origin() - alone.origin() - Eigen::Vector3d(20. * static_cast<double>(i + 1), 0, 0)).norm(),
              1e-12);
    EXPECT_NEAR(component.total_area(), alone.total_area(), 1e-10);
    for (Dual_mesh::Index f = 0; f < alone.number_of_faces(); ++f) {
      EXPECT_EQ(component.face(f), whole.face(static_cast<Dual_mesh::Index>(first + f)));
      EXPECT_EQ(component.index(component.face(f)), f);
      EXPECT_NEAR(component.area(f), alone.area(f), 1e-10);
      EXPECT_LT((component.normal(f) - alone.normal(f)).norm(), 1e-9);
      EXPECT_LT((component.centroid(f) - alone.centroid(f)).norm(), 1e-9);
    }
    for (Dual_mesh::Index e = 0; e < alone.number_of_edges(); ++e) {
      EXPECT_EQ(component.graph().faces_of(e), alone.graph().faces_of(e));
      EXPECT_NEAR(component.edge_length(e), alone.edge_length(e), 1e-10);
    }
    first += component.number_of_faces();
  }
}

TYPED_TEST(Component, KnowsNoFacesButItsOwn) {
  const TypeParam held(side_by_side({meshes::cube(1), meshes::cube(2), meshes::plane(1)}));
  const Dual_mesh_of whole(held.mesh);
  const auto stretches = internal::connected_stretches(whole.graph());
  const auto middle = whole.component(stretches[1]);
  for (Dual_mesh::Index f = 0; f < whole.number_of_faces(); ++f) {
    const bool is_inside = f >= 12 && f < 60;
    EXPECT_EQ(middle.index(whole.face(f)), is_inside ? f - 12 : middle.none);
  }
  EXPECT_EQ(middle.index(boost::graph_traits<typename TypeParam::Mesh>::null_face()), middle.none);
}

TEST(ComponentOfADualMesh, SharesVerticesWithAnother) {
  // Two tetrahedra that touch in vertex 0, the second one after a vertex of the first one in its own numbers.
  Dual_mesh::Arrays arrays;
  arrays.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-2, 0, 0}, {0, -2, 0}, {0, 0, -2}};
  std::vector<std::array<Dual_mesh::Index, 2>> sides;
  const std::vector<std::array<Dual_mesh::Index, 3>> faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3},
                                                              {4, 5, 6}, {0, 4, 6}, {0, 5, 4}, {0, 6, 5}};
  for (const auto& face : faces) {
    for (const auto vertex : face) arrays.corners.add(vertex);
    arrays.corners.end_face();
  }
  for (Dual_mesh::Index f = 0; f < 8; ++f)
    for (Dual_mesh::Index g = f + 1; g < 8; ++g)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          if (faces[f][i] == faces[g][(j + 1) % 3] && faces[f][(i + 1) % 3] == faces[g][j]) {
            sides.push_back({f, g});
            arrays.edge_ends.push_back({faces[f][i], faces[f][(i + 1) % 3]});
          }
  ASSERT_EQ(sides.size(), 12u);
  arrays.graph = Dual_graph(8, sides);
  arrays.is_wall.assign(12, 0);
  arrays.is_wall[8] = 1;
  const Dual_mesh whole(std::move(arrays));
  const auto stretches = internal::connected_stretches(whole.graph());
  ASSERT_EQ(stretches.size(), 2u);
  const Dual_mesh second = whole.component(stretches[1]);
  ASSERT_EQ(second.number_of_vertices(), 4u);
  for (Dual_mesh::Index f = 0; f < 4; ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d point = second.origin() + second.unit() * second.point(second.corners(f)[k]);
      const Eigen::Vector3d expected = whole.origin() + whole.unit() * whole.point(whole.corners(f + 4)[k]);
      EXPECT_LT((point - expected).norm(), 1e-14);
    }
  for (Dual_mesh::Index e = 0; e < 6; ++e) EXPECT_EQ(second.is_wall(e), e == 2);
}

TEST(ComponentsOfADualMesh, StayWhereTheyAre) {
  const Mesh mesh = meshes::surface_mesh(side_by_side({dumbbell(12), cross(2), meshes::plane(3), meshes::cube(1)}));
  const Dual_mesh_of measured(mesh);
  const Dual_mesh whole = measured.with_shape_normals_of(smoothed_shape(measured));
  const auto stretches = internal::connected_stretches(whole.graph());
  ASSERT_EQ(stretches.size(), 4u);
  internal::Mesh_stretch middle = stretches[1];
  middle.faces += stretches[2].faces;
  middle.edges += stretches[2].edges;
  const Dual_mesh part = whole.components_in_place(middle);
  ASSERT_EQ(part.number_of_faces(), middle.faces);
  ASSERT_EQ(part.number_of_edges(), middle.edges);
  EXPECT_EQ(part.unit(), whole.unit());
  EXPECT_EQ(part.origin(), whole.origin());
  for (Dual_mesh::Index f = 0; f < part.number_of_faces(); ++f) {
    EXPECT_EQ(part.centroid(f), whole.centroid(middle.first_face + f));
    EXPECT_EQ(part.area(f), whole.area(middle.first_face + f));
    EXPECT_EQ(part.shape_normal(f), whole.shape_normal(middle.first_face + f));
  }
  for (Dual_mesh::Index e = 0; e < part.number_of_edges(); ++e)
    EXPECT_EQ(part.edge_length(e), whole.edge_length(middle.first_edge + e));
}

// ---- Segments ----

TYPED_TEST(Component, HasTheSegmentsThatItHasByItself) {
  const std::vector<meshes::Shape> shapes = {meshes::scaled(dumbbell(32), 0.5), cross(6),
                                             meshes::scaled(meshes::sphere(3), 0.3), meshes::scaled(cross(8), 0.2)};
  const TypeParam held(side_by_side(shapes));
  Face_labels<typename TypeParam::Mesh> ids(held.mesh);
  const std::size_t segments = segmentation_via_random_walks(held.mesh, ids.map());
  EXPECT_EQ(segments, number_of(ids.values()));
  const auto parts = parts_of(ids.values(), shapes);
  for (std::size_t i = 0; i < shapes.size(); ++i) expect_same_segments(parts[i], segments_of(shapes[i]));
  EXPECT_GT(number_of(parts[0]), 1u);
  EXPECT_GT(number_of(parts[3]), 1u);
}

TEST(Components, AreSegmentedByTheWholeWhereThePoliciesSaySo) {
  const std::vector<meshes::Shape> shapes(30, dumbbell(16));
  auto policies = Automatic_segmentation();
  EXPECT_EQ(number_of(segments_of(side_by_side(shapes), policies)), 60u);
  policies.by_component = false;
  EXPECT_LT(number_of(segments_of(side_by_side(shapes), policies)), 60u);
  const auto hierarchy = hierarchy_via_random_walks(meshes::surface_mesh(side_by_side(shapes)), policies);
  EXPECT_EQ(hierarchy.report().seeds, 69u) << "40, and one for each further component";
  EXPECT_EQ(hierarchy.report().components, 30u);
}

TEST(Components, GetEveryNumberOfSegmentsTogether) {
  const Mesh mesh = meshes::surface_mesh(side_by_side({dumbbell(16), cross(3), meshes::sphere(2)}));
  const auto hierarchy = hierarchy_via_random_walks(mesh);
  EXPECT_EQ(hierarchy.number_of_components(), 3u);
  EXPECT_EQ(hierarchy.report().components, 3u);
  EXPECT_EQ(hierarchy.report().seeds, 120u);
  EXPECT_EQ(hierarchy.report().fragments, hierarchy.number_of_fragments());
  Face_labels<Mesh> ids(mesh);
  for (std::size_t n = 3; n <= hierarchy.number_of_fragments(); ++n) {
    EXPECT_EQ(hierarchy.segments(Segment_count_stop(n), ids.map()), n);
    EXPECT_EQ(number_of(ids.values()), n);
  }
  EXPECT_THROW(hierarchy.segments(Segment_count_stop(2), ids.map()), std::invalid_argument);
}

TEST(Components, FarSmallerThanTheLargestAreOneSegment) {
  const std::vector<meshes::Shape> shapes = {meshes::scaled(dumbbell(24), 10), dumbbell(24), dumbbell(24)};
  const Mesh mesh = meshes::surface_mesh(side_by_side(shapes));
  Face_labels<Mesh> ids(mesh);
  auto policies = Automatic_segmentation();
  const auto count = [&](std::size_t part) { return number_of(parts_of(ids.values(), shapes)[part]); };
  policies.least_component = 0.0101;
  segmentation_via_random_walks(mesh, ids.map(), policies);
  EXPECT_EQ(count(0), 2u);
  EXPECT_EQ(count(1), 1u);
  EXPECT_EQ(count(2), 1u);
  policies.least_component = 0.0099;
  segmentation_via_random_walks(mesh, ids.map(), policies);
  EXPECT_EQ(count(1), 2u);

  // Not where the user says what is in them.
  policies.least_component = 0.5;
  const std::size_t first = shapes[0].faces.size(), second = shapes[1].faces.size();
  const std::vector<Mesh::Face_index> given = {ids.face(first), ids.face(first + second - 1)};
  const auto hierarchy = hierarchy_via_random_walks(mesh, policies, given);
  hierarchy.segments(Segment_count_stop(hierarchy.number_of_fragments()), ids.map());
  EXPECT_GT(count(1), 1u);
  EXPECT_EQ(count(2), 1u);
  const auto z = [&](Mesh::Face_index f) {
    double sum = 0;
    for (const auto v : vertices_around_face(halfedge(f, mesh), mesh)) sum += mesh.point(v).z();
    return sum;
  };
  const auto walls = boost::make_function_property_map<Mesh::Edge_index>([&](const Mesh::Edge_index& e) {
    const auto h = halfedge(e, mesh);
    return mesh.point(target(h, mesh)).x() > 50 && (z(face(h, mesh)) > 0) != (z(face(opposite(h, mesh), mesh)) > 0);
  });
  segmentation_via_random_walks(mesh, ids.map(), policies, CGAL::parameters::edge_is_constrained_map(walls));
  EXPECT_EQ(count(1), 1u);
  EXPECT_EQ(count(2), 2u) << "a wall goes round it";
}

TEST(Components, TakeSeedsOfTheUsersEachItsOwn) {
  const std::vector<meshes::Shape> shapes = {cross(3), dumbbell(16)};
  const Mesh mesh = meshes::surface_mesh(side_by_side(shapes));
  Face_labels<Mesh> ids(mesh);
  const std::size_t first = shapes[0].faces.size();
  const std::vector<Mesh::Face_index> given = {ids.face(first + 7), ids.face(3), ids.face(first + 9)};
  const auto hierarchy = hierarchy_via_random_walks(mesh, Automatic_segmentation(), given);
  EXPECT_EQ(hierarchy.report().seeds, 83u);
  hierarchy.segments(Segment_count_stop(hierarchy.number_of_fragments()), ids.map());
  EXPECT_NE(ids.values()[first + 7], ids.values()[first + 9]);
}

TYPED_TEST(Component, IsAskedForByItsOwnDescriptors) {
  using Graph = typename TypeParam::Mesh;
  const std::vector<meshes::Shape> shapes = {dumbbell(24), cross(4)};
  const TypeParam held(side_by_side(shapes));
  Face_labels<Graph> ids(held.mesh), by_map(held.mesh);
  segmentation_via_random_walks(held.mesh, ids.map());
  // The same differences, by the edges of the mesh.
  std::size_t meshes_seen = 0;
  const auto difference = [&](const Dual_mesh_of<Graph>& part) {
    ++meshes_seen;
    return smoothed_concavity()(part);
  };
  segmentation_via_random_walks(held.mesh, by_map.map(), Automatic_segmentation().with_difference(difference));
  EXPECT_EQ(meshes_seen, 2u);
  EXPECT_EQ(by_map.values(), ids.values());
}

TEST(Components, ReportProgressThatRisesAndCanBeCancelled) {
  const Mesh mesh = meshes::surface_mesh(side_by_side({cross(4), dumbbell(24), meshes::scaled(meshes::cube(1), 0.01)}));
  Face_labels<Mesh> ids(mesh);
  std::vector<double> seen;
  double end = 2;
  const std::function<bool(double)> callback = [&](double fraction) {
    seen.push_back(fraction);
    return fraction < end;
  };
  segmentation_via_random_walks(mesh, ids.map(), CGAL::parameters::callback(callback));
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1);
  Face_labels<Mesh> untouched(mesh);
  end = 0.9;  // in the second component
  EXPECT_THROW(segmentation_via_random_walks(mesh, untouched.map(), CGAL::parameters::callback(callback)), Cancelled);
  EXPECT_EQ(untouched.values().front(), untouched.untouched);
}

TEST(Components, TellProgressAndCallPoliciesOfTheUserFromTheCallingThread) {
  const Mesh mesh = meshes::surface_mesh(side_by_side({cross(4), dumbbell(24), cross(3), dumbbell(16)}));
  const auto caller = std::this_thread::get_id();
  const std::function<bool(double)> callback = [&](double) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    return true;
  };
  Face_labels<Mesh> ids(mesh), by_own(mesh);
  segmentation_via_random_walks(mesh, ids.map(), CGAL::parameters::callback(callback));
  bool is_busy = false;  // a policy of the user's need not allow for several threads
  const auto difference = [&](const Dual_mesh_of<Mesh>& part) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_FALSE(std::exchange(is_busy, true));
    auto differences = smoothed_concavity()(part);
    is_busy = false;
    return differences;
  };
  segmentation_via_random_walks(mesh, by_own.map(), Automatic_segmentation().with_difference(difference));
  EXPECT_EQ(by_own.values(), ids.values());
}

TEST(Components, AreSegmentedAtTheSameTimeWhereThePoliciesAllowIt) {
  auto policies = Automatic_segmentation().with_difference(smoothed_concavity());
  EXPECT_FALSE(policies.concurrent_components);
  policies.concurrent_components = true;
  EXPECT_TRUE(policies.with_stop(Segment_count_stop(9)).concurrent_components);
  EXPECT_FALSE(policies.with_seeding(policies.seeding).concurrent_components);
  EXPECT_FALSE(policies.with_solver(policies.solver).concurrent_components);
  EXPECT_FALSE(policies.with_merge_cost(policies.merge_cost).concurrent_components);
  const meshes::Shape row = side_by_side({cross(4), dumbbell(24), cross(3)});
  EXPECT_EQ(segments_of(row, policies), segments_of(row));
}

TEST(Components, HaveStagesThatTakeNoLongerThanAllOfThem) {
  const Mesh mesh = meshes::surface_mesh(side_by_side({cross(6), dumbbell(48), cross(5), dumbbell(40)}));
  const auto begin = std::chrono::steady_clock::now();
  const auto hierarchy = hierarchy_via_random_walks(mesh);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  double sum = 0;
  std::set<std::string> names;
  for (const auto& stage : hierarchy.report().stages) {
    EXPECT_TRUE(names.insert(stage.name).second) << stage.name;
    EXPECT_GE(stage.seconds, 0);
    sum += stage.seconds;
  }
  EXPECT_GT(sum, 0);
  EXPECT_LE(sum, seconds);
}

TEST(Components, PassOnWhatACallbackThrows) {
  struct Enough : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  const Mesh mesh = meshes::surface_mesh(side_by_side({cross(4), dumbbell(24), cross(3)}));
  const std::function<bool(double)> callback = [](double fraction) -> bool {
    if (fraction > 0.3) throw Enough("enough");
    return true;
  };
  Face_labels<Mesh> ids(mesh);
  EXPECT_THROW(segmentation_via_random_walks(mesh, ids.map(), CGAL::parameters::callback(callback)), Enough);
  EXPECT_EQ(ids.values().front(), ids.untouched);
}

TEST(ParallelLoops, DoAllOfTheirWorkInsideOneThatAnErrorEnds) {
  constexpr std::size_t number = 1000;
  std::atomic<bool> has_begun = false, has_failed = false;
  std::atomic<std::size_t> done = 0;
  const auto wait_for = [](const std::atomic<bool>& event) {
    for (int i = 0; i < 100 && !event; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  };
  const auto task = [&](std::size_t begin, std::size_t) {
    if (begin == 0) {
      wait_for(has_begun);
      has_failed = true;
      throw std::runtime_error("enough");
    }
    has_begun = true;
    wait_for(has_failed);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // until the error is known
    internal::parallel_stretches(
        number, [&](std::size_t from, std::size_t to) { done += to - from; }, 1);
  };
  EXPECT_THROW(internal::parallel_stretches(2, task, 1), std::runtime_error);
  EXPECT_TRUE(!has_begun || done == number) << done;
}

TEST(Components, OfThePaperAreThoseOfTheWhole) {
  EXPECT_FALSE(Paper_segmentation().by_component);
  EXPECT_FALSE(Coarse_paper_segmentation().by_component);
  EXPECT_FALSE(Automatic_segmentation().with_seeding(Paper_segmentation().seeding).by_component);
}

// ---- Trees ----

TEST(TreesSideBySide, StopAtACostWhereEachStopsByItself) {
  const std::vector<Merge_tree> trees = {
      {4, {{0, 1, 0.2}, {2, 4, 0.9}, {3, 5, 0.3}}}, {1, {}}, {3, {{1, 2, 0.5}, {0, 3, 0.4}}}, {2, {{0, 1, 0.1}}}};
  const Merge_tree all = internal::side_by_side(trees);
  EXPECT_EQ(all.number_of_fragments(), 10u);
  EXPECT_EQ(all.number_of_components(), 4u);
  for (const double cost : {0., 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.9, 1.}) {
    const Cost_threshold_stop stop(cost);
    const Labels together = all.segment_of_fragments(stop(all));
    std::size_t first = 0, segments = 0;
    for (const Merge_tree& tree : trees) {
      const Labels alone = tree.segment_of_fragments(stop(tree));
      for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(together[first + i], segments + alone[i]) << cost;
      segments += stop(tree);
      first += alone.size();
    }
    EXPECT_EQ(stop(all), segments) << cost;
  }
}

}  // namespace test_components
