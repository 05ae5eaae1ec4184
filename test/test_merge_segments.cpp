// SPDX-License-Identifier: MIT

#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/Region_boundary.h>
#include <RW_segmentation/Relative_boundary_cost.h>
#include <RW_segmentation/Segment_hierarchy.h>
#include <RW_segmentation/Segmentation_policies.h>
#include <RW_segmentation/Size_aware_cost.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <CGAL/Polygon_mesh_processing/measure.h>

#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <gtest/gtest.h>
#include "face_labels.h"
#include "mesh_graph.h"
#include "meshes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace test_merge_segments {

using namespace RW_segmentation;
using meshes::Mesh_graph;

namespace {

using meshes::Surface_mesh;
using Labels = std::vector<std::size_t>;  // in the order of the faces of a shape

/// Cells of faces around seeds that a generator draws: fragments as a walk might leave them.
Labels cells(const Dual_graph& graph, std::size_t number, unsigned random_seed = 1) {
  Labels labels(graph.number_of_faces(), number);
  std::vector<Dual_graph::Index> front;
  for (const std::size_t f : meshes::random_order(labels.size(), random_seed)) {
    if (front.size() == number) break;
    labels[f] = front.size();
    front.push_back(static_cast<Dual_graph::Index>(f));
  }
  for (std::size_t i = 0; i < front.size(); ++i)
    for (const auto& [next, edge] : graph.neighbours(front[i]))
      if (labels[next] == number) {
        labels[next] = labels[front[i]];
        front.push_back(next);
      }
  return labels;
}

/// Whether both give the same faces the same label, up to the labels' names.
bool same_partition(const Labels& a, const Labels& b) {
  std::map<std::size_t, std::size_t> to_b, to_a;
  for (std::size_t f = 0; f < a.size(); ++f)
    if (to_b.emplace(a[f], b[f]).first->second != b[f] || to_a.emplace(b[f], a[f]).first->second != a[f]) return false;
  return a.size() == b.size();
}

std::size_t number_of_labels(const Labels& labels) {
  return std::set<std::size_t>(labels.begin(), labels.end()).size();
}

template <class Mesh, class MergeCost>
Labels segments_of(const Mesh& mesh, const Labels& fragments, const MergeCost& cost, std::size_t number) {
  Face_labels<Mesh> ids(mesh, fragments);
  const auto hierarchy = merge_segments(mesh, ids.map(), Dihedral_difference<Mesh>(mesh), cost);
  EXPECT_EQ(hierarchy.segments(Segment_count_stop(number), ids.map()), number);
  return ids.values();
}

/// Merges as defined, measuring all boundaries anew for every merge.
template <class Difference, class Cost>
std::vector<double> costs_by_definition(const Surface_mesh& mesh, Labels labels, const Difference& difference,
                                        const Cost& cost) {
  namespace PMP = CGAL::Polygon_mesh_processing;
  const Mesh_graph<Surface_mesh> graph(mesh);
  const double total_area = PMP::area(mesh);
  std::vector<double> costs;
  while (true) {
    std::map<std::size_t, Edge_sums> outline;
    std::map<std::size_t, double> area;
    std::map<std::pair<std::size_t, std::size_t>, Edge_sums> common;
    for (std::size_t f = 0; f < labels.size(); ++f)
      area[labels[f]] += PMP::face_area(graph.face_descriptors()[f], mesh) / total_area;
    for (Dual_graph::Index e = 0; e < graph.number_of_edges(); ++e) {
      const auto [f, g] = graph.faces_of(e);
      if (labels[f] == labels[g]) continue;
      const double length = PMP::edge_length(graph.edge(e), mesh) / std::sqrt(total_area);
      const Edge_sums sums = {length, length * get(difference, graph.edge(e))};
      common[std::minmax(labels[f], labels[g])] += sums;
      outline[labels[f]] += sums;
      outline[labels[g]] += sums;
    }
    if (common.empty()) return costs;
    double cheapest = std::numeric_limits<double>::infinity();
    std::pair<std::size_t, std::size_t> pair;
    for (const auto& [regions, sums] : common) {
      const auto [a, b] = regions;
      Edge_sums whole = outline[a];
      whole += outline[b];
      whole.length -= sums.length;
      whole.difference -= sums.difference;
      const double c = cost(area[a], area[b], sums, whole);
      if (c < cheapest) std::tie(cheapest, pair) = std::make_tuple(c, regions);
    }
    costs.push_back(cheapest);
    std::replace(labels.begin(), labels.end(), pair.second, pair.first);
  }
}

Surface_mesh bumpy_torus() { return meshes::surface_mesh(meshes::with_noise(meshes::torus(2, 1, 30, 20), 0.03)); }

template <class Cost>
void expect_costs(const Surface_mesh& mesh, const Labels& fragments, const Cost& cost,
                  const std::vector<double>& expected) {
  Face_labels<Surface_mesh> ids(mesh, fragments);
  const auto hierarchy = merge_segments(mesh, ids.map(), Dihedral_difference<Surface_mesh>(mesh), cost);
  ASSERT_EQ(hierarchy.merges().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(hierarchy.merges()[i].cost, expected[i], 1e-9 * expected[i]) << "merge " << i;
}

/// The cost of a user: small regions first.
struct Number_of_faces {
  using Region = int;
  int region(const Dual_mesh&, Dual_mesh::Index) const { return 1; }
  void join(int& region, int other) const { region += other; }
  double operator()(int a, int b, const Region_boundary&) const { return a + b; }
};

}  // namespace

// ---- The merges ----

TEST(MergeSegments, RelativeBoundaryCostFollowsEquation10) {
  const Surface_mesh mesh = bumpy_torus();
  const Labels fragments = cells(Mesh_graph<Surface_mesh>(mesh), 60);
  const auto expected =
      costs_by_definition(mesh, fragments, Dihedral_difference<Surface_mesh>(mesh),
                          [](double, double, const Edge_sums& common, const Edge_sums& whole) {
                            return (common.difference / common.length) / (whole.difference / whole.length);
                          });
  ASSERT_EQ(expected.size(), 59u);
  expect_costs(mesh, fragments, Relative_boundary_cost(), expected);
  EXPECT_NEAR(expected.back(), 1, 1e-9) << "the last two segments are each other's whole boundary";
}

TEST(MergeSegments, SizeAwareCostFollowsItsFormula) {
  const Surface_mesh mesh = bumpy_torus();
  const Labels fragments = cells(Mesh_graph<Surface_mesh>(mesh), 60);
  const auto expected_with = [&](double weight) {
    return costs_by_definition(mesh, fragments, Dihedral_difference<Surface_mesh>(mesh),
                               [weight](double a, double b, const Edge_sums& common, const Edge_sums&) {
                                 return (weight * common.difference / common.length + 0.1) * (a * b / (a + b)) /
                                        common.length;
                               });
  };
  expect_costs(mesh, fragments, Size_aware_cost(), expected_with(1));
  expect_costs(mesh, fragments, Size_aware_cost({}, 2.5), expected_with(2.5));
  const double distance = std::sqrt(2 / (std::sqrt(3.) * static_cast<double>(num_edges(mesh))));  // of centroids
  ASSERT_GT(distance, 0.01);
  const Dual_mesh_of dual(mesh);
  Size_aware_cost_policy without_thickness;
  without_thickness.thickness.samples = 0;
  expect_costs(mesh, fragments, without_thickness(dual), expected_with(distance / 0.01));
}

TEST(MergeSegments, TheCostOfACreaseHardlyDependsOnTheNumberOfFaces) {
  // 112 to 28 672 faces. By the mean difference alone, the coarsest mesh would have a fifth of the finest one's cost.
  Size_aware_cost_policy without_thickness;
  without_thickness.thickness.samples = 0;
  std::vector<double> costs;
  for (const std::size_t n : {2u, 4u, 8u, 16u, 32u}) {
    const Surface_mesh mesh = meshes::surface_mesh(meshes::l_shape(n));
    Labels fragments;
    for (const auto f : faces(mesh)) {  // one arm, and the rest
      const auto corners = vertices_around_face(halfedge(f, mesh), mesh);
      fragments.push_back(std::any_of(corners.begin(), corners.end(), [&](auto v) { return mesh.point(v).x() > 1; }));
    }
    const Dual_mesh_of dual(mesh);
    const auto shape = smoothed_shape(dual);
    Face_labels<Surface_mesh> ids(mesh, fragments);
    const auto hierarchy =
        merge_segments(shape, ids.map(), Dihedral_difference(shape, smoothed_concavity()), without_thickness(shape));
    ASSERT_EQ(hierarchy.merges().size(), 1u);
    costs.push_back(hierarchy.merges()[0].cost);
  }
  const auto [least, most] = std::minmax_element(costs.begin(), costs.end());
  EXPECT_LT(*most / *least, 2.5);
}

TEST(MergeSegments, ThicknessRaisesTheSizeAwareCost) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::l_shape(2));
  Labels fragments(num_faces(mesh), 0);
  std::vector<double> thickness(num_faces(mesh), 0);
  for (const auto f : faces(mesh)) {
    const bool upper =
        mesh.point(target(halfedge(f, mesh), mesh)).x() > 1 || mesh.point(source(halfedge(f, mesh), mesh)).x() > 1;
    fragments[f] = upper;
    thickness[f] = upper ? std::exp(1.) : std::exp(0.25);
  }
  const auto cost_with = [&](const std::vector<double>& values) {
    const auto map = boost::make_function_property_map<Surface_mesh::Face_index>(
        [&](Surface_mesh::Face_index f) { return values[f]; });
    Face_labels<Surface_mesh> ids(mesh, fragments);
    return merge_segments(mesh, ids.map(), Dihedral_difference<Surface_mesh>(mesh), Size_aware_cost(mesh, map))
        .merges()
        .at(0)
        .cost;
  };
  const double without = cost_with(std::vector<double>(thickness.size(), 0));
  EXPECT_GT(without, 0);
  EXPECT_NEAR(cost_with(thickness), without * (1 + 2 * 0.75), 1e-9 * without);
  for (double& t : thickness) t = t > 2 ? 1e9 : 1;
  EXPECT_NEAR(cost_with(thickness), without * 5, 1e-9 * without) << "steps of the logarithm count up to 2";
}

TEST(MergeSegments, UserCostGetsRegionsJoined) {
  const Surface_mesh mesh = bumpy_torus();
  const Labels fragments = cells(Mesh_graph<Surface_mesh>(mesh), 40);
  Face_labels<Surface_mesh> ids(mesh, fragments);
  const auto hierarchy = merge_segments(mesh, ids.map(), Dihedral_difference<Surface_mesh>(mesh), Number_of_faces());
  EXPECT_EQ(hierarchy.merges().back().cost, static_cast<double>(num_faces(mesh)));
}

namespace {

/// Eq. 10 with sums of one's own.
struct Own_relative_boundary {
  struct Region {};
  struct Boundary {
    double length = 0, difference = 0;
    Boundary& operator+=(const Boundary& other) {
      length += other.length;
      difference += other.difference;
      return *this;
    }
  };
  Region region(const Dual_mesh&, Dual_mesh::Index) const { return {}; }
  void join(Region&, const Region&) const {}
  Boundary boundary(const Dual_mesh& mesh, Dual_mesh::Index edge, double difference) const {
    return {mesh.edge_length(edge), mesh.edge_length(edge) * difference};
  }
  double operator()(const Region&, const Region&, const Region_boundary_of<Boundary>& boundary) const {
    const auto& [common, a, b] = boundary;
    return common.difference / common.length * (a.length + b.length - common.length) /
           (a.difference + b.difference - common.difference);
  }
};

/// Holds all faces of regions and all edges of boundaries, and compares them with the mesh each time it is asked.
struct Cost_that_checks {
  using Region = std::set<Dual_mesh::Index>;
  struct Boundary {
    std::multiset<Dual_mesh::Index> edges;
    Boundary& operator+=(const Boundary& other) {
      edges.insert(other.edges.begin(), other.edges.end());
      return *this;
    }
  };
  Dual_mesh mesh;
  std::size_t* asked;

  Region region(const Dual_mesh&, Dual_mesh::Index face) const { return {face}; }
  void join(Region& region, const Region& other) const { region.insert(other.begin(), other.end()); }
  Boundary boundary(const Dual_mesh& given, Dual_mesh::Index edge, double difference) const {
    EXPECT_FALSE(given.is_wall(edge));
    EXPECT_EQ(difference, static_cast<double>(edge % 7));
    return {{edge}};
  }
  double operator()(const Region& a, const Region& b, const Region_boundary_of<Boundary>& boundary) const {
    ++*asked;
    std::multiset<Dual_mesh::Index> common, outline_of_a, outline_of_b;
    for (Dual_mesh::Index e = 0; e < mesh.number_of_edges(); ++e) {
      if (mesh.is_wall(e)) continue;
      const auto [f, g] = mesh.graph().faces_of(e);
      if (a.count(f) != a.count(g)) outline_of_a.insert(e);
      if (b.count(f) != b.count(g)) outline_of_b.insert(e);
      if ((a.count(f) && b.count(g)) || (b.count(f) && a.count(g))) common.insert(e);
    }
    EXPECT_EQ(boundary.common.edges, common);
    EXPECT_EQ(boundary.outline_of_first.edges, outline_of_a);
    EXPECT_EQ(boundary.outline_of_second.edges, outline_of_b);
    return static_cast<double>(a.size() + b.size());
  }
};

/// A cost of the older form with a type of that name, which means something else.
struct Cost_with_a_type_named_boundary : Number_of_faces {
  enum class Boundary { open, closed };
};

}  // namespace

TEST(MergeSegments, SumsOfACostsOwnAlongBoundariesAreAddedAsTheLibrarysAre) {
  const Surface_mesh mesh = bumpy_torus();
  Face_labels<Surface_mesh> ids(mesh, cells(Mesh_graph<Surface_mesh>(mesh), 60));
  const Dihedral_difference<Surface_mesh> difference(mesh);
  const auto expected = merge_segments(mesh, ids.map(), difference, Relative_boundary_cost()).merges();
  const auto merges = merge_segments(mesh, ids.map(), difference, Own_relative_boundary()).merges();
  ASSERT_EQ(merges.size(), expected.size());
  for (std::size_t i = 0; i < merges.size(); ++i) {
    EXPECT_EQ(merges[i].first, expected[i].first);
    EXPECT_EQ(merges[i].second, expected[i].second);
    EXPECT_NEAR(merges[i].cost, expected[i].cost, 1e-9 * expected[i].cost);
  }
}

TEST(MergeSegments, BoundariesOfACostsOwnHoldTheEdgesBetweenTheirRegionsAndNoWalls) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::torus(2, 1, 12, 8), 0.03));
  const auto walls = boost::make_function_property_map<Surface_mesh::Edge_index>(
      [](Surface_mesh::Edge_index e) { return e.idx() % 11 == 0; });
  const Dual_mesh_of dual(mesh, CGAL::parameters::edge_is_constrained_map(walls));
  std::map<Surface_mesh::Edge_index, double> number;
  for (Dual_mesh::Index e = 0; e < dual.number_of_edges(); ++e) number[dual.edge(e)] = static_cast<double>(e % 7);
  Face_labels<Surface_mesh> ids(mesh, cells(Mesh_graph<Surface_mesh>(mesh), 25));
  std::size_t asked = 0;
  const auto merges =
      merge_segments(dual, ids.map(), boost::make_assoc_property_map(number), Cost_that_checks{dual, &asked}).merges();
  EXPECT_EQ(merges.size(), 24u);
  EXPECT_EQ(merges.back().cost, static_cast<double>(num_faces(mesh)));
  EXPECT_GT(asked, 60u);
}

TEST(MergeSegments, ATypeNamedBoundaryAloneChangesNothing) {
  const Surface_mesh mesh = bumpy_torus();
  Face_labels<Surface_mesh> ids(mesh, cells(Mesh_graph<Surface_mesh>(mesh), 40));
  const Dihedral_difference<Surface_mesh> difference(mesh);
  const auto expected = merge_segments(mesh, ids.map(), difference, Number_of_faces()).merges();
  const auto merges = merge_segments(mesh, ids.map(), difference, Cost_with_a_type_named_boundary()).merges();
  ASSERT_EQ(merges.size(), expected.size());
  for (std::size_t i = 0; i < merges.size(); ++i) EXPECT_EQ(merges[i].cost, expected[i].cost);
}

TEST(MergeSegments, ThousandsOfFragmentsCostFewEvaluations) {
  struct Counting : Relative_boundary_cost {
    std::size_t* calls;
    double operator()(const Region& a, const Region& b, const Region_boundary& boundary) const {
      ++*calls;
      return Relative_boundary_cost::operator()(a, b, boundary);
    }
  };
  const Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::torus(2, 1, 200, 100), 0.005));
  const std::size_t fragments = 5000;
  Face_labels<Surface_mesh> ids(mesh, cells(Mesh_graph<Surface_mesh>(mesh), fragments));
  std::size_t calls = 0;
  Counting cost;
  cost.calls = &calls;
  const auto hierarchy = merge_segments(mesh, ids.map(), Dihedral_difference<Surface_mesh>(mesh), cost);
  EXPECT_EQ(hierarchy.number_of_fragments(), fragments);
  EXPECT_EQ(hierarchy.number_of_components(), 1u);
  EXPECT_LT(calls, 100 * fragments);
}

TEST(MergeSegments, FaceOrderDoesNotMatter) {
  const meshes::Shape shape = meshes::with_noise(meshes::torus(2, 1, 30, 20), 0.03);
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  const Labels fragments = cells(Mesh_graph<Surface_mesh>(mesh), 50);
  const std::vector<std::size_t> order = meshes::random_order(shape.faces.size());
  const Surface_mesh shuffled = meshes::surface_mesh(meshes::with_faces_in_order(shape, order));
  Labels shuffled_fragments;
  for (const std::size_t f : order) shuffled_fragments.push_back((fragments[f] * 7) % 50);

  for (const std::size_t number : {1u, 2u, 7u, 20u, 50u}) {
    const Labels segments = segments_of(mesh, fragments, Size_aware_cost(), number);
    Labels expected;
    for (const std::size_t f : order) expected.push_back(segments[f]);
    EXPECT_TRUE(same_partition(segments_of(shuffled, shuffled_fragments, Size_aware_cost(), number), expected))
        << number << " segments";
  }
}

TEST(MergeSegments, ScaleDoesNotMatter) {
  const meshes::Shape shape = meshes::with_noise(meshes::torus(2, 1, 30, 20), 0.03);
  const Labels fragments = cells(Mesh_graph<Surface_mesh>(meshes::surface_mesh(shape)), 50);
  Labels segments;
  for (const double scale : {1., 1e-150, 1e140}) {
    const Surface_mesh mesh = meshes::surface_mesh(meshes::scaled(shape, scale));
    const Labels scaled = segments_of(mesh, fragments, Size_aware_cost(), 8);
    if (segments.empty()) segments = scaled;
    EXPECT_EQ(scaled, segments) << "scale " << scale;
  }
}

TEST(MergeSegments, ComponentsAreNeverJoined) {
  const meshes::Shape shape = meshes::together(meshes::cube(2), meshes::moved(meshes::cube(2), {5, 0, 0}));
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  Labels fragments(num_faces(mesh));
  std::iota(fragments.begin(), fragments.end(), std::size_t(0));
  Face_labels<Surface_mesh> ids(mesh, fragments);
  const auto hierarchy = merge_segments(mesh, ids.map(), Dihedral_difference<Surface_mesh>(mesh), Size_aware_cost());
  EXPECT_EQ(hierarchy.number_of_components(), 2u);
  EXPECT_EQ(hierarchy.segments(Segment_count_stop(2), ids.map()), 2u);
  Labels expected(num_faces(mesh), 0);
  std::fill(expected.begin() + static_cast<std::ptrdiff_t>(num_faces(mesh) / 2), expected.end(), 1u);
  EXPECT_EQ(ids.values(), expected);
  EXPECT_THROW(hierarchy.segments(Segment_count_stop(1), ids.map()), std::invalid_argument);
  EXPECT_EQ(ids.values(), expected) << "an error must leave the output alone";
}

TEST(MergeSegments, FlatMeshMergesAtNoCost) {  // 0 / 0 in Eq. 10
  const Surface_mesh mesh = meshes::surface_mesh(meshes::plane(10));
  Face_labels<Surface_mesh> ids(mesh, cells(Mesh_graph<Surface_mesh>(mesh), 20));
  const auto hierarchy =
      merge_segments(mesh, ids.map(), Dihedral_difference<Surface_mesh>(mesh), Relative_boundary_cost());
  ASSERT_EQ(hierarchy.merges().size(), 19u);
  for (const auto& merge : hierarchy.merges()) EXPECT_EQ(merge.cost, 0);
}

TEST(MergeSegments, RegionsThatMeetInAnEdgeWithoutLengthAreMergedLast) {
  // Two triangles share the edge from (0, 0, 0) to itself, two others an ordinary one.
  meshes::Shape shape;
  shape.points = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {1, 1, 1}};
  shape.faces = {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}};
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  for (const bool relative : {true, false}) {
    Face_labels<Surface_mesh> ids(mesh, {0, 1, 2});
    const Dihedral_difference<Surface_mesh> difference(mesh);
    const auto hierarchy = relative ? merge_segments(mesh, ids.map(), difference, Relative_boundary_cost())
                                    : merge_segments(mesh, ids.map(), difference, Size_aware_cost());
    ASSERT_EQ(hierarchy.merges().size(), 2u);
    EXPECT_TRUE(std::isfinite(hierarchy.merges()[0].cost));
    EXPECT_EQ(hierarchy.merges()[1].cost, std::numeric_limits<double>::infinity());
    EXPECT_EQ(hierarchy.segments(Cost_threshold_stop(1e300), ids.map()), 2u);
    EXPECT_EQ(ids.values(), (Labels{0, 1, 0}));
  }
}

TEST(MergeSegments, RejectsACostThatIsNoNumber) {
  struct Not_a_number : Relative_boundary_cost {
    double operator()(Region, Region, const Region_boundary&) const { return std::nan(""); }
  };
  const Surface_mesh mesh = meshes::surface_mesh(meshes::cube());
  Face_labels<Surface_mesh> ids(mesh, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  EXPECT_THROW(merge_segments(mesh, ids.map(), Dihedral_difference<Surface_mesh>(mesh), Not_a_number()),
               std::invalid_argument);
}

TEST(MergeSegments, CallbackSeesProgressAndCancels) {
  const Surface_mesh mesh = bumpy_torus();
  Face_labels<Surface_mesh> ids(mesh, cells(Mesh_graph<Surface_mesh>(mesh), 500));
  const Dihedral_difference<Surface_mesh> difference(mesh);
  std::vector<double> seen;
  const std::function<bool(double)> watch = [&](double done) { return seen.push_back(done), true; };
  merge_segments(mesh, ids.map(), difference, Relative_boundary_cost(), CGAL::parameters::callback(watch));
  ASSERT_GT(seen.size(), 3u);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_GE(seen.front(), 0);
  EXPECT_LE(seen.back(), 1);
  const std::function<bool(double)> cancel = [](double done) { return done < 0.5; };
  EXPECT_THROW(
      merge_segments(mesh, ids.map(), difference, Relative_boundary_cost(), CGAL::parameters::callback(cancel)),
      Cancelled);
}

TEST(MergeSegments, LabelsMayBeAnyIntegers) {
  const Surface_mesh mesh = bumpy_torus();
  const Labels fragments = cells(Mesh_graph<Surface_mesh>(mesh), 20);
  std::map<Surface_mesh::Face_index, int> odd;
  for (const auto f : faces(mesh)) odd[f] = static_cast<int>(fragments[f]) * 1000000 - 5;
  Face_labels<Surface_mesh> ids(mesh);
  const auto hierarchy = merge_segments(mesh, boost::make_assoc_property_map(odd),
                                        Dihedral_difference<Surface_mesh>(mesh), Size_aware_cost());
  EXPECT_EQ(hierarchy.segments(Segment_count_stop(5), ids.map()), 5u);
  EXPECT_EQ(ids.values(), segments_of(mesh, fragments, Size_aware_cost(), 5));
}

TEST(MergeSegments, EmptyMeshHasAnEmptyHierarchy) {
  const Surface_mesh mesh;
  Face_labels<Surface_mesh> ids(mesh);
  const auto hierarchy = merge_segments(mesh, ids.map(), Dihedral_difference<Surface_mesh>(mesh), Size_aware_cost());
  EXPECT_EQ(hierarchy.segments(Cost_threshold_stop(1), ids.map()), 0u);
}

template <class Holder>
class MergeSegmentsOn : public testing::Test {};
TYPED_TEST_SUITE(MergeSegmentsOn, meshes::Holders);

TYPED_TEST(MergeSegmentsOn, EveryKindOfMesh) {
  const meshes::Shape shape = meshes::with_noise(meshes::torus(2, 1, 30, 20), 0.03);
  const Surface_mesh reference = meshes::surface_mesh(shape);
  const Labels fragments = cells(Mesh_graph<Surface_mesh>(reference), 50);
  const TypeParam held(shape);
  EXPECT_EQ(segments_of(held.mesh, fragments, Size_aware_cost(), 9),
            segments_of(reference, fragments, Size_aware_cost(), 9));
}

// ---- The hierarchy ----

TEST(SegmentHierarchy, LevelsAreNestedAndHaveEveryNumberOfSegments) {
  const Surface_mesh mesh = bumpy_torus();
  const Labels fragments = cells(Mesh_graph<Surface_mesh>(mesh), 40);
  Face_labels<Surface_mesh> ids(mesh, fragments);
  const Segment_hierarchy hierarchy =
      merge_segments(mesh, ids.map(), Dihedral_difference<Surface_mesh>(mesh), Size_aware_cost());
  Labels finer = fragments;
  for (std::size_t number = 40; number >= 1; --number) {
    ASSERT_EQ(hierarchy.segments(Segment_count_stop(number), ids.map()), number);
    const Labels segments = ids.values();
    EXPECT_EQ(number_of_labels(segments), number);
    EXPECT_EQ(*std::max_element(segments.begin(), segments.end()), number - 1) << "ids are contiguous";
    std::map<std::size_t, std::size_t> segment_of_finer;
    for (std::size_t f = 0; f < segments.size(); ++f)
      EXPECT_EQ(segment_of_finer.emplace(finer[f], segments[f]).first->second, segments[f]);
    finer = segments;
  }
}

TEST(SegmentHierarchy, FragmentsKeepTheirIdsAtTheFinestLevel) {
  const Surface_mesh mesh = bumpy_torus();
  const Labels fragments = cells(Mesh_graph<Surface_mesh>(mesh), 40);
  EXPECT_EQ(segments_of(mesh, fragments, Relative_boundary_cost(), 40), fragments);
}

TEST(SegmentHierarchy, NumberOfSegmentsOutOfReachIsAnError) {
  const Merge_tree tree(5, {{0, 1, 0.1}, {2, 5, 0.2}, {3, 4, 0.3}});  // two components
  EXPECT_THROW(tree.segment_of_fragments(1), std::invalid_argument);
  EXPECT_THROW(tree.segment_of_fragments(6), std::invalid_argument);
  EXPECT_EQ(tree.segment_of_fragments(5), (Labels{0, 1, 2, 3, 4}));
  EXPECT_EQ(tree.segment_of_fragments(3), (Labels{0, 0, 0, 1, 2}));
  EXPECT_EQ(tree.segment_of_fragments(2), (Labels{0, 0, 0, 1, 1}));
  try {
    tree.segment_of_fragments(0);
    FAIL() << "0 segments were accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("from 2 (connected components) to 5 (fragments)"), std::string::npos)
        << error.what();
  }
}

TEST(SegmentHierarchy, OffersTheLevelsThatLastLongest) {
  // Costs rise by a tenth from merge to merge, and jump at 14, at 8 and at 5 segments. That at 2 is too far away.
  std::vector<Merge_tree::Merge> merges;
  double cost = 0.01;
  for (std::size_t segments = 30; segments > 1; --segments) {
    cost *= segments == 14 || segments == 8 || segments == 5 || segments == 2 ? 2 : 1.1;
    merges.push_back({30 - segments, 59 - segments, cost});
  }
  const Merge_tree tree(30, merges);
  EXPECT_EQ(tree.levels(8), (Labels{5, 8, 14}));
  EXPECT_EQ(tree.levels(10), (Labels{5, 10, 14})) << "8 is too close to 10 to be another answer";
  for (std::size_t chosen = 1; chosen <= 30; ++chosen) {
    const Labels levels = tree.levels(chosen);
    EXPECT_TRUE(std::is_sorted(levels.begin(), levels.end()));
    EXPECT_EQ(std::count(levels.begin(), levels.end(), chosen), 1);
    for (const std::size_t level : levels) EXPECT_LE(tree.segment_of_fragments(level).size(), 30u);
    const double ratio = static_cast<double>(levels.back()) / static_cast<double>(levels.front());
    EXPECT_LE(ratio, 4) << chosen;
  }
  EXPECT_EQ(tree.levels(1), (Labels{1, 2}));
  EXPECT_EQ(tree.levels(30).back(), 30u) << "no level has more segments than there are fragments";
  EXPECT_THROW(tree.levels(31), std::invalid_argument);
}

TEST(SegmentHierarchy, OffersNoFewerSegmentsThanComponents) {
  const Merge_tree tree(8, {{0, 1, 0.1}, {2, 3, 0.2}, {4, 5, 0.3}, {6, 7, 0.4}});  // four components
  EXPECT_EQ(tree.levels(4), (Labels{4, 7}));
  EXPECT_EQ(tree.levels(6), (Labels{4, 6})) << "components are the level that lasts for ever";
  EXPECT_THROW(tree.levels(3), std::invalid_argument);
  EXPECT_EQ(Merge_tree().levels(0), Labels{0});
}

TEST(StopPredicates, StopWhereTheySay) {
  const Merge_tree tree(6, {{0, 1, 0.1}, {2, 3, 0.3}, {6, 7, 0.2}, {4, 5, 0.9}, {8, 9, 0.4}});
  EXPECT_EQ(Segment_count_stop(4)(tree), 4u);
  EXPECT_EQ(Cost_threshold_stop(0.05)(tree), 6u);
  EXPECT_EQ(Cost_threshold_stop(0.1)(tree), 5u) << "a cost equal to the threshold is merged";
  EXPECT_EQ(Cost_threshold_stop(0.25)(tree), 5u) << "a cheaper merge later does not count";
  EXPECT_EQ(Cost_threshold_stop(0.5)(tree), 3u);
  EXPECT_EQ(Cost_threshold_stop(1)(tree), 1u);
  EXPECT_EQ(Cost_jump_stop(0.5)(tree), 3u);
  EXPECT_EQ(Cost_jump_stop(0.15)(tree), 5u);
  EXPECT_EQ(Cost_jump_stop(1)(tree), 1u);
}

TEST(StopPredicates, RefuseCostsThatAreNoNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(Cost_threshold_stop{nan}, std::invalid_argument);
  EXPECT_THROW(Cost_jump_stop{nan}, std::invalid_argument);
  const Merge_tree tree(3, {{0, 1, 0.1}, {2, 3, 0.3}});
  EXPECT_EQ(Cost_threshold_stop(infinity)(tree), 1u);
  EXPECT_EQ(Cost_threshold_stop(-infinity)(tree), 3u);
  EXPECT_EQ(Cost_jump_stop(infinity)(tree), 1u);
}

TEST(StopPredicates, MayBeTheUsersOwn) {
  const Surface_mesh mesh = bumpy_torus();
  Face_labels<Surface_mesh> ids(mesh, cells(Mesh_graph<Surface_mesh>(mesh), 40));
  const auto hierarchy = merge_segments(mesh, ids.map(), Dihedral_difference<Surface_mesh>(mesh), Size_aware_cost());
  const auto half = [](const Merge_tree& tree) { return tree.number_of_fragments() / 2; };
  EXPECT_EQ(hierarchy.segments(half, ids.map()), 20u);
  EXPECT_EQ(number_of_labels(ids.values()), 20u);
}

}  // namespace test_merge_segments
