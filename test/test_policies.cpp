// SPDX-License-Identifier: MIT

// The one call with policies that are written outside the library: each of the five alone, all together, in every form
// that their concepts allow.

#include <RW_segmentation/segmentation_via_random_walks.h>

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Eigen_walk_solver.h>
#include <RW_segmentation/Paper_segmentation.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/Segmentation_policies.h>
#include <RW_segmentation/Segmentation_report.h>

#include <gtest/gtest.h>
#include "face_labels.h"
#include "meshes.h"

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <list>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace test_policies {

using namespace RW_segmentation;

namespace {

using Mesh = meshes::Surface_mesh;
using Index = Dual_mesh::Index;
using Face = Mesh::Face_index;
using Edge = Mesh::Edge_index;
using Labels = std::vector<std::size_t>;

const std::vector<Face> no_seeds;

// ---- Five policies of one's own ----

/// The angle between the faces' own normals, on concave edges as on convex ones.
struct Own_difference {
  std::shared_ptr<int> calls = std::make_shared<int>(0);
  std::vector<double> operator()(const Dual_mesh& mesh) const {
    ++*calls;
    std::vector<double> difference;
    for (Index e = 0; e < mesh.number_of_edges(); ++e) {
      const auto [f, g] = mesh.graph().faces_of(e);
      difference.push_back((mesh.normal(f) - mesh.normal(g)).norm());
    }
    return difference;
  }
};

/// Every so-manieth face, as a list, some of them twice.
struct Own_seeding {
  std::size_t step = 50;
  std::shared_ptr<int> calls = std::make_shared<int>(0);
  std::list<std::size_t> operator()(const Dual_mesh& mesh, const std::vector<double>& difference,
                                    const std::vector<Index>& /* given */) const {
    ++*calls;
    EXPECT_EQ(difference.size(), mesh.number_of_edges());
    std::list<std::size_t> seeds = {0};
    for (std::size_t f = 0; f < mesh.number_of_faces(); f += step) seeds.push_back(f);
    return seeds;
  }
};

/// Star-mesh elimination that counts. It can be moved but not copied, so that it comes from a factory.
class Own_solver {
 public:
  explicit Own_solver(std::shared_ptr<int> factorisations) : factorisations_(std::move(factorisations)) {}
  void analyze(const Dual_graph& graph) { solver_->analyze(graph); }
  void factorize(const std::vector<double>& conductances, const std::vector<Index>& absorbing,
                 const Progress& progress) {
    ++*factorisations_;
    solver_->factorize(conductances, absorbing, progress);
  }
  void potentials(const Potentials& values, Potentials& result) const { solver_->potentials(values, result); }
  void response(Index face, const std::vector<double>& values, std::vector<double>& column) const {
    solver_->response(face, values, column);
  }
  std::vector<double> absorbed_currents(Index face) const { return solver_->absorbed_currents(face); }

 private:
  std::shared_ptr<int> factorisations_;
  std::unique_ptr<Star_mesh_elimination> solver_ = std::make_unique<Star_mesh_elimination>();
};

/// The smaller area of the two, as a fraction.
struct Own_cost {
  std::shared_ptr<int> calls = std::make_shared<int>(0);
  struct Region {
    double area = 0;
  };
  Region region(const Dual_mesh& mesh, Index face) const { return {mesh.area(face) / mesh.total_area()}; }
  void join(Region& region, const Region& other) const { region.area += other.area; }
  double operator()(const Region& a, const Region& b, const Region_boundary&) const {
    ++*calls;
    return std::min(a.area, b.area);
  }
};

/// One more segment than there are components.
struct Own_stop {
  std::shared_ptr<int> calls = std::make_shared<int>(0);
  std::size_t operator()(const Merge_tree& tree) const {
    ++*calls;
    return tree.number_of_components() + 1;
  }
};

// ---- What all tests do ----

/// Policies of any kind in one type, so that what is compiled once serves many tests.
using Any_difference = std::function<std::vector<double>(const Dual_mesh&)>;
using Any_seeding =
    std::function<std::vector<Index>(const Dual_mesh&, const std::vector<double>&, const std::vector<Index>&)>;

auto with_any(Any_difference difference, Any_seeding seeding, Any_stop stop = Segment_count_stop(4)) {
  return Automatic_segmentation()
      .with_difference(std::move(difference))
      .with_seeding(std::move(seeding))
      .with_stop(std::move(stop));
}
auto with_any(Any_difference difference) { return with_any(std::move(difference), Feature_sensitive_seeding<>()); }
auto with_any(Any_seeding seeding, Any_stop stop = Segment_count_stop(4)) {
  return with_any(smoothed_concavity(), std::move(seeding), std::move(stop));
}

Mesh some_mesh(std::size_t around = 24) {
  return meshes::surface_mesh(meshes::with_noise(meshes::two_spheres_with_neck(2.4, 0.3, around), 0.003));
}

template <class M, class Policies>
Labels labels_of(const M& mesh, const Policies& policies) {
  Face_labels<M> ids(mesh);
  const std::size_t segments = segmentation_via_random_walks(mesh, ids.map(), policies);
  EXPECT_EQ(std::set<std::size_t>(ids.values().begin(), ids.values().end()).size(), segments);
  return ids.values();
}

/// That the hierarchy of policies has at its level what the one call writes.
template <class Policies>
void expect_same_from_hierarchy(const Mesh& mesh, const Policies& policies, const Labels& labels) {
  Face_labels<Mesh> ids(mesh);
  hierarchy_via_random_walks(mesh, policies).segments(policies.stop, ids.map());
  EXPECT_EQ(ids.values(), labels);
}

/// That the one call refuses policies with an error that has the words, and writes nothing.
template <class Policies>
void expect_refused(const Mesh& mesh, const Policies& policies, const std::string& words) {
  Face_labels<Mesh> ids(mesh);
  try {
    segmentation_via_random_walks(mesh, ids.map(), policies);
    ADD_FAILURE() << "no error that says " << words;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
  EXPECT_EQ(ids.values(), Labels(ids.values().size(), ids.untouched));
}

}  // namespace

// ---- Each alone ----

TEST(OwnPolicy, MayBeTheDifference) {
  const Mesh mesh = some_mesh();
  const Own_difference own;
  const auto policies = Automatic_segmentation(4).with_difference(own);
  const Labels labels = labels_of(mesh, policies);
  EXPECT_EQ(*own.calls, 1);
  expect_same_from_hierarchy(mesh, policies, labels);
}

TEST(OwnPolicy, MayBeTheSeeding) {
  const Mesh mesh = some_mesh();
  const Own_seeding own;
  const auto policies = Automatic_segmentation(4).with_seeding(own);
  const Labels labels = labels_of(mesh, policies);
  EXPECT_EQ(*own.calls, 1);
  expect_same_from_hierarchy(mesh, policies, labels);
  const std::size_t places = (mesh.number_of_faces() + own.step - 1) / own.step;
  EXPECT_EQ(hierarchy_via_random_walks(mesh, policies).report().seeds, places);
}

TEST(OwnPolicy, MayBeTheLibrarysOwnThroughAUsersHands) {
  const Mesh mesh = some_mesh();
  EXPECT_EQ(labels_of(mesh, with_any(smoothed_concavity(), Feature_sensitive_seeding<>())), labels_of(mesh, [] {
              Automatic_segmentation four;
              four.stop = Segment_count_stop(4);
              return four;
            }()));
}

TEST(OwnPolicy, MayBeTheSolver) {
  const Mesh mesh = some_mesh();
  const Labels expected = labels_of(mesh, Automatic_segmentation());
  const auto factorisations = std::make_shared<int>(0);
  const auto factory = [factorisations] { return Own_solver(factorisations); };
  auto policies = Automatic_segmentation().with_solver(factory);
  EXPECT_EQ(labels_of(mesh, policies), expected);
  EXPECT_EQ(*factorisations, 2);  // of the faces, and of the clusters that further walks run over
  expect_same_from_hierarchy(mesh, policies, expected);

  auto reduced = Automatic_segmentation();
  reduced.reduction.largest_direct = policies.reduction.largest_direct = 0;
  *factorisations = 0;
  EXPECT_EQ(labels_of(mesh, policies), labels_of(mesh, reduced));  // one solver for the clusters, one for the bands
  EXPECT_GE(*factorisations, 2);
}

TEST(OwnPolicy, MayBeTheMergeCost) {
  const Mesh mesh = some_mesh();
  const Own_cost own;
  const auto policies = Automatic_segmentation(4).with_merge_cost(own);
  const Labels labels = labels_of(mesh, policies);
  EXPECT_GT(*own.calls, 0);
  expect_same_from_hierarchy(mesh, policies, labels);
}

namespace {

/// Merges within what a user knows about the faces of a mesh first.
struct Cost_of_descriptors {
  const Face_labels<Mesh>::Map& group;
  struct Region {
    std::set<std::size_t> groups;
  };
  Region region(const Dual_mesh_of<Mesh>& mesh, Index face) const { return {{get(group, mesh.face(face))}}; }
  void join(Region& region, const Region& other) const {
    region.groups.insert(other.groups.begin(), other.groups.end());
  }
  double operator()(const Region& a, const Region& b, const Region_boundary&) const {
    Region both = a;
    join(both, b);
    return static_cast<double>(both.groups.size());
  }
};

}  // namespace

TEST(OwnPolicy, MayBeAMergeCostThatAsksForFacesOfTheMesh) {
  const Mesh mesh = meshes::surface_mesh(meshes::cube(6));
  Face_labels<Mesh> side(mesh);
  std::size_t number = 0;
  for (const Face f : faces(mesh)) put(side.map(), f, number++ / 72);
  const auto map = side.map();
  // Seeds lie anywhere, so that fragments hold faces of one side if walks hardly cross the edges of the cube.
  auto policies = Paper_segmentation(6).with_merge_cost(Cost_of_descriptors{map});
  const Labels labels = labels_of(mesh, policies);
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t f = 0; f < labels.size(); ++f) pairs.insert({labels[f], side.values()[f]});
  EXPECT_EQ(pairs.size(), 6u);
}

TEST(OwnPolicy, MayBeTheStop) {
  const Mesh mesh = some_mesh();
  const Own_stop own;
  auto two = Automatic_segmentation();
  two.stop = Segment_count_stop(2);
  EXPECT_EQ(labels_of(mesh, Automatic_segmentation().with_stop(own)), labels_of(mesh, two));
  EXPECT_EQ(*own.calls, 1);
  // Chosen while the program runs, and of a type that is no std::size_t.
  auto policies = Automatic_segmentation();
  policies.stop = [](const Merge_tree&) { return 3; };
  EXPECT_EQ(hierarchy_via_random_walks(mesh, policies).segments(policies.stop, Face_labels<Mesh>(mesh).map()), 3u);
}

// ---- The forms that each may have ----

namespace {

/// What a difference returns as a map of the mesh's edges.
class Stored_difference {
 public:
  Stored_difference(const Mesh& mesh, const std::vector<double>& values) : of_edge_(num_edges(mesh), 0) {
    const Dual_mesh_of dual(mesh);
    for (Index e = 0; e < values.size(); ++e) of_edge_[dual.edge(e)] = values[e];
  }
  auto map() const {
    return boost::make_function_property_map<Edge>([this](const Edge& e) -> double { return of_edge_[e]; });
  }

 private:
  std::vector<double> of_edge_;
};

}  // namespace

TEST(FormsOfPolicies, AreAMapAFunctionWithProgressEigensSolverAndAMakerOfCosts) {
  const Mesh mesh = some_mesh();
  const Own_difference difference;
  const Own_seeding seeding;
  const Own_cost cost;
  const Labels labels = labels_of(
      mesh, Automatic_segmentation(4).with_difference(difference).with_seeding(seeding).with_merge_cost(cost));

  const Stored_difference stored(mesh, difference(Dual_mesh_of(mesh)));
  std::vector<double> told;
  const auto seeding_with_progress = [&](const Dual_mesh& m, const std::vector<double>& values,
                                         const std::vector<Index>& given, const Progress& progress) {
    progress(0.5);
    return seeding(m, values, given);
  };
  const auto cost_of_mesh = [&](const Dual_mesh_of<Mesh>&) { return cost; };
  const auto policies = Automatic_segmentation(4)
                            .with_difference(stored.map())
                            .with_seeding(seeding_with_progress)
                            .with_solver(Eigen_walk_solver<>())
                            .with_merge_cost(cost_of_mesh);
  EXPECT_EQ(labels_of(mesh, policies), labels);
  Face_labels<Mesh> ids(mesh);
  const std::function<bool(double)> callback = [&](double fraction) {
    told.push_back(fraction);
    return true;
  };
  segmentation_via_random_walks(mesh, ids.map(), policies, CGAL::parameters::callback(callback));
  EXPECT_EQ(ids.values(), labels);
  EXPECT_NE(std::find_if(told.begin(), told.end(), [](double x) { return std::abs(x - 0.35) < 1e-12; }), told.end());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
}

TEST(FormsOfPolicies, AreAFunctionThatReturnsAMapAndAFactoryOfSolvers) {
  const Mesh mesh = some_mesh();
  const Labels labels = labels_of(mesh, Paper_segmentation(4));
  const auto difference = [](const auto& dual, const Progress& progress) {
    progress(1);
    return Dihedral_difference(dual);
  };
  const auto solver = [] {
    Eigen_walk_solver<Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower>> with_settings;
    with_settings.eigen_solver().setTolerance(1e-13);
    return with_settings;
  };
  EXPECT_EQ(labels_of(mesh, Paper_segmentation(4).with_difference(difference).with_solver(solver)), labels);
  EXPECT_EQ(labels_of(mesh, Paper_segmentation(4).with_difference(Dihedral_difference(mesh))), labels);
}

// ---- All together ----

TEST(OwnPolicies, MayBeAllFive) {
  const Mesh mesh = some_mesh();
  const auto factorisations = std::make_shared<int>(0);
  const auto factory = [factorisations] { return Own_solver(factorisations); };
  const Own_difference difference;
  const Own_seeding seeding;
  const Own_cost cost;
  const Own_stop stop;
  auto policies = Automatic_segmentation()
                      .with_difference(difference)
                      .with_seeding(seeding)
                      .with_solver(factory)
                      .with_merge_cost(cost)
                      .with_stop(stop);
  const Labels labels = labels_of(mesh, policies);
  EXPECT_EQ(std::set<std::size_t>(labels.begin(), labels.end()).size(), 2u);
  EXPECT_EQ(*difference.calls, 1);
  EXPECT_EQ(*seeding.calls, 1);
  EXPECT_EQ(*factorisations, 1);
  EXPECT_GT(*cost.calls, 0);
  EXPECT_EQ(*stop.calls, 1);
  expect_same_from_hierarchy(mesh, policies, labels);

  // By hand it is the same.
  const Dual_mesh_of dual(mesh);
  const Dual_mesh_of shape = smoothed_shape(dual, policies.smoothing);
  const std::vector<double> values = difference(shape);
  const Stored_difference stored(mesh, values);
  const auto map = stored.map();
  Face_labels<Mesh> ids(mesh);
  std::vector<Face> seeds;
  for (const std::size_t f : seeding(shape, values, {}))
    if (std::count(seeds.begin(), seeds.end(), dual.face(static_cast<Index>(f))) == 0)
      seeds.push_back(dual.face(static_cast<Index>(f)));
  segmentation_from_seeds(shape, Conductance(shape, map), seeds, ids.map());
  merge_segments(shape, ids.map(), map, cost).segments(stop, ids.map());
  EXPECT_EQ(ids.values(), labels);
}

TEST(OwnPolicies, KeepTheNumbersOfTheChoiceTheyStartFrom) {
  Automatic_segmentation automatic(7);
  automatic.sigma = 0.5;
  automatic.cap = 9;
  automatic.smoothing.radius = 0.03;
  automatic.reduction.cluster_steps = 5;
  automatic.seeding.count = 11;
  automatic.merge_cost.thickness.samples = 0;
  const auto changed =
      automatic.with_difference(Own_difference()).with_stop(Own_stop()).with_solver(Eigen_walk_solver<>());
  EXPECT_EQ(changed.sigma, 0.5);
  EXPECT_EQ(changed.cap, 9);
  EXPECT_EQ(changed.smoothing.radius, 0.03);
  EXPECT_EQ(changed.reduction.cluster_steps, 5u);
  EXPECT_EQ(changed.seeding.count, 11u);
  EXPECT_EQ(changed.merge_cost.thickness.samples, 0u);
}

TEST(OwnPolicies, WorkOnAMeshThatHasBeenRead) {
  const Mesh mesh = some_mesh();
  const auto policies = Automatic_segmentation(4).with_difference(Own_difference());
  Face_labels<Mesh> ids(mesh);
  segmentation_via_random_walks(Dual_mesh_of(mesh), ids.map(), policies);
  EXPECT_EQ(ids.values(), labels_of(mesh, policies));
}

template <class Holder>
class OwnPoliciesOn : public testing::Test {};
TYPED_TEST_SUITE(OwnPoliciesOn, meshes::Holders);

TYPED_TEST(OwnPoliciesOn, EveryMeshGiveTheSame) {
  const meshes::Shape shape = meshes::l_shape(4);
  const auto policies = Automatic_segmentation(3)
                            .with_difference(Own_difference())
                            .with_seeding(Own_seeding{7})
                            .with_merge_cost(Own_cost());
  EXPECT_EQ(labels_of(TypeParam(shape).mesh, policies), labels_of(meshes::surface_mesh(shape), policies));
}

// ---- Seedings that are odd or wrong ----

TEST(OwnSeeding, MayReturnNothing) {
  const Mesh mesh =
      meshes::surface_mesh(meshes::together(meshes::sphere(1), meshes::moved(meshes::cube(2), {5, 0, 0})));
  const auto nothing = [](const Dual_mesh&, const std::vector<double>&, const std::vector<Index>&) {
    return std::vector<Index>();
  };
  for (const std::size_t largest_direct : {std::size_t(0), std::size_t(1000)}) {
    auto policies = with_any(nothing, Cost_threshold_stop(1));
    policies.reduction.largest_direct = largest_direct;
    const auto hierarchy = hierarchy_via_random_walks(mesh, policies);
    EXPECT_EQ(hierarchy.report().seeds, 0u);
    EXPECT_EQ(hierarchy.number_of_fragments(), 2u);  // a component without seed is a segment of its own
    const Labels labels = labels_of(mesh, policies);
    for (std::size_t f = 0; f < labels.size(); ++f) EXPECT_EQ(labels[f], f < 80 ? 0u : 1u);
  }
}

TEST(OwnSeeding, MayLeaveTheSeedsToTheUser) {
  const Mesh mesh = some_mesh();
  const auto nothing = [](const Dual_mesh&, const std::vector<double>&, const std::vector<Index>& given) {
    EXPECT_EQ(given.size(), 2u);  // each once
    return std::vector<Index>();
  };
  const std::vector<Face> given = {Face(3), Face(900), Face(3)};
  Face_labels<Mesh> ids(mesh);
  const auto policies = with_any(nothing, Segment_count_stop(2));
  EXPECT_EQ(segmentation_via_random_walks(mesh, ids.map(), policies, given), 2u);
  EXPECT_NE(ids.values()[3], ids.values()[900]);
}

TEST(OwnSeeding, MayReturnFacesTwiceOrThatAreGiven) {
  const Mesh mesh = some_mesh();
  const auto twice = [](const Dual_mesh&, const std::vector<double>&, const std::vector<Index>& given) {
    std::vector<Index> seeds = {5, 300, 5, 300, 700};
    seeds.insert(seeds.end(), given.begin(), given.end());
    return seeds;
  };
  const auto once = [](const Dual_mesh&, const std::vector<double>&, const std::vector<Index>&) {
    return std::vector<Index>{5, 300, 700};
  };
  const std::vector<Face> given = {Face(800)};
  Face_labels<Mesh> ids(mesh), expected(mesh);
  const auto policies = with_any(twice);
  EXPECT_EQ(hierarchy_via_random_walks(mesh, policies, given).report().seeds, 4u);
  segmentation_via_random_walks(mesh, ids.map(), policies, given);
  segmentation_via_random_walks(mesh, expected.map(), with_any(once), given);
  EXPECT_EQ(ids.values(), expected.values());
}

TEST(OwnSeeding, IsRefusedIfItReturnsWhatIsNoFace) {
  const Mesh mesh = some_mesh();
  const std::size_t faces = mesh.number_of_faces();
  const auto returns = [](Index seed) {
    return [seed](const Dual_mesh&, const std::vector<double>&, const std::vector<Index>&) {
      return std::vector<Index>{0, seed};
    };
  };
  expect_refused(mesh, with_any(returns(static_cast<Index>(faces))),
                 "seed " + std::to_string(faces) + " of the seeding policy is not a face");
  expect_refused(mesh, with_any(returns(std::numeric_limits<Index>::max())), "of the seeding policy is not a face");
  // Nor must a seed of a longer type be taken for another face.
  for (const long long seed : {-1LL, (1LL << 32) + 7}) {
    const auto longer = [seed](const Dual_mesh&, const std::vector<double>&, const std::vector<Index>&) {
      return std::vector<long long>{0, seed};
    };
    expect_refused(mesh, Automatic_segmentation().with_seeding(longer),
                   "seed " + std::to_string(seed) + " of the seeding policy is not a face");
  }
}

TEST(OwnSeeding, MayLeaveComponentsWithoutSeeds) {
  const meshes::Shape one = meshes::sphere(2);
  const Mesh mesh = meshes::surface_mesh(
      meshes::together(meshes::together(one, meshes::moved(one, {3, 0, 0})), meshes::moved(one, {6, 0, 0})));
  const auto in_one = [](const Dual_mesh&, const std::vector<double>&, const std::vector<Index>&) {
    return std::vector<Index>{330, 400, 500};
  };
  const auto hierarchy = hierarchy_via_random_walks(mesh, with_any(in_one));
  EXPECT_EQ(hierarchy.report().components, 3u);
  EXPECT_EQ(hierarchy.number_of_fragments(), 5u);
  EXPECT_EQ(hierarchy.number_of_components(), 3u);
  Face_labels<Mesh> ids(mesh);
  hierarchy.segments(Segment_count_stop(5), ids.map());
  for (std::size_t f = 0; f < 320; ++f) {
    EXPECT_EQ(ids.values()[f], ids.values()[0]);
    EXPECT_EQ(ids.values()[640 + f], ids.values()[640]);
  }
}

// ---- Differences that are wrong ----

TEST(OwnDifference, IsRefusedIfAValueIsNegativeOrNaN) {
  const Mesh mesh = some_mesh();
  const Dual_mesh_of dual(mesh);
  const auto with_value = [](double value) {
    return [value](const Dual_mesh& m) {
      std::vector<double> difference(m.number_of_edges(), 1);
      difference[10] = value;
      return difference;
    };
  };
  const auto [f, g] = dual.graph().faces_of(10);
  const std::string where = "the difference on the edge between faces " + std::to_string(dual.place(f)) + " and " +
                            std::to_string(dual.place(g));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused(mesh, with_any(Any_difference(with_value(-1))), where);
  expect_refused(mesh, with_any(Any_difference(with_value(nan))), where);
  std::vector<double> values(dual.number_of_edges(), 1);
  values[10] = nan;
  const Stored_difference stored(mesh, values);
  expect_refused(mesh, Automatic_segmentation().with_difference(stored.map()), where);
}

TEST(OwnDifference, MayBeInfiniteOrNone) {
  const Mesh mesh = some_mesh();
  for (const double value : {0., std::numeric_limits<double>::infinity()}) {
    const auto same = [value](const Dual_mesh& m) { return std::vector<double>(m.number_of_edges(), value); };
    const auto policies = with_any(same);
    EXPECT_EQ(hierarchy_via_random_walks(mesh, policies).report().components, 1u);
    labels_of(mesh, policies);
  }
}

TEST(OwnDifference, IsRefusedIfItHasAnotherNumberOfValuesThanTheMeshEdges) {
  const Mesh mesh = some_mesh();
  const std::size_t edges = Dual_mesh_of(mesh).number_of_edges();
  for (const std::size_t number : {std::size_t(0), edges - 1, edges + 1}) {
    const auto difference = [number](const Dual_mesh&) { return std::vector<double>(number, 1.); };
    expect_refused(mesh, with_any(Any_difference(difference)),
                   "the difference has " + std::to_string(number) + " values, but the mesh " + std::to_string(edges));
  }
}

TEST(OwnCost, IsRefusedIfItIsNaN) {
  struct No_number : Relative_boundary_cost {
    double operator()(const Region&, const Region&, const Region_boundary&) const { return std::nan(""); }
  };
  expect_refused(some_mesh(), Automatic_segmentation().with_merge_cost(No_number()), "NaN");
}

TEST(OwnStop, IsRefusedIfItIsOutOfRange) {
  const Mesh mesh = some_mesh();
  for (const std::size_t number : {std::size_t(0), std::size_t(41)})
    expect_refused(mesh, with_any(smoothed_concavity(), Feature_sensitive_seeding<>(), Segment_count_stop(number)),
                   "the number of segments");
}

TEST(OwnPolicies, MayThrowWhatTheyLike) {
  const Mesh mesh = some_mesh();
  Face_labels<Mesh> ids(mesh);
  const auto difference = [](const Dual_mesh&) -> std::vector<double> { throw std::logic_error("of the user"); };
  const auto stop = [](const Merge_tree&) -> std::size_t { throw std::logic_error("of the user"); };
  EXPECT_THROW(segmentation_via_random_walks(mesh, ids.map(), with_any(Any_difference(difference))), std::logic_error);
  EXPECT_THROW(segmentation_via_random_walks(mesh, ids.map(),
                                             with_any(smoothed_concavity(), Feature_sensitive_seeding<>(), stop)),
               std::logic_error);
  EXPECT_EQ(ids.values(), Labels(ids.values().size(), ids.untouched));
}

TEST(OwnPolicies, MayEndTheComputationByTheirProgress) {
  const Mesh mesh = some_mesh();
  Face_labels<Mesh> ids(mesh);
  double last = 0;
  const std::function<bool(double)> until_seeds = [&](double fraction) {
    last = fraction;
    return fraction < 0.35;
  };
  const auto seeding = [](const Dual_mesh&, const std::vector<double>&, const std::vector<Index>&,
                          const Progress& progress) {
    progress(0.75);
    ADD_FAILURE() << "not cancelled";
    return std::vector<Index>{0};
  };
  EXPECT_THROW(segmentation_via_random_walks(mesh, ids.map(), Automatic_segmentation().with_seeding(seeding),
                                             CGAL::parameters::callback(until_seeds)),
               Cancelled);
  EXPECT_NEAR(last, 0.375, 1e-12);
  EXPECT_EQ(ids.values(), Labels(ids.values().size(), ids.untouched));
}

// ---- The choices of the library ----

TEST(SegmentCount, BringsSeedsEnough) {
  const Mesh mesh = some_mesh();
  for (const std::size_t number : {1u, 20u, 21u, 100u, 300u}) {
    Face_labels<Mesh> ids(mesh);
    EXPECT_EQ(segmentation_via_random_walks(mesh, ids.map(), Automatic_segmentation(number)), number);
    EXPECT_EQ(std::set<std::size_t>(ids.values().begin(), ids.values().end()).size(), number);
  }
  EXPECT_EQ(Automatic_segmentation(5).seeding.count, 40u);
  EXPECT_EQ(Automatic_segmentation(100).seeding.count, 200u);
}

TEST(SegmentCount, OfThePapersPoliciesBringsSeedsEnough) {
  const Mesh mesh = some_mesh(32);
  Face_labels<Mesh> ids(mesh);
  EXPECT_EQ(segmentation_via_random_walks(mesh, ids.map(), Paper_segmentation(100)), 100u);
}

TEST(SegmentCount, BeyondTheSeedsIsAnErrorThatNamesTheCure) {
  Automatic_segmentation policies;
  policies.stop = Segment_count_stop(100);
  expect_refused(some_mesh(), policies, "more seeds");
}

TEST(PaperPolicies, TakeParticlesAndNothingElseByHand) {
  const Mesh mesh = some_mesh(32);
  const Paper_segmentation policies(5);
  const Dual_mesh_of dual(mesh);
  const Dihedral_difference difference(dual);
  std::vector<Face> seeds;
  feature_sensitive_seeds(dual, 60, std::back_inserter(seeds), no_seeds, Particle_sampling());
  Face_labels<Mesh> ids(mesh);
  segmentation_from_seeds(dual, Conductance(dual, difference), seeds, ids.map());
  merge_segments(dual, ids.map(), difference, Relative_boundary_cost()).segments(Segment_count_stop(5), ids.map());
  EXPECT_EQ(ids.values(), labels_of(mesh, policies));
  EXPECT_EQ(hierarchy_via_random_walks(mesh, policies).report().seeds, seeds.size());
}

TEST(PaperPolicies, MakeASegmentOfEachCoarseSeed) {
  for (const meshes::Shape& shape : {meshes::cube(6), meshes::l_shape(4), meshes::two_spheres_with_neck(2.4, 0.3, 24),
                                     meshes::together(meshes::cube(3), meshes::moved(meshes::cube(4), {3, 0, 0}))}) {
    const Mesh mesh = meshes::surface_mesh(shape);
    std::vector<Face> seeds;
    const Dihedral_difference difference(mesh);
    coarse_seeds(mesh, difference, Separation_decrease_stop(), std::back_inserter(seeds));
    Face_labels<Mesh> ids(mesh), by_hand(mesh);
    EXPECT_EQ(segmentation_via_random_walks(mesh, ids.map(), Coarse_paper_segmentation()), seeds.size());
    const std::set<std::size_t> of_seeds = [&] {
      std::set<std::size_t> labels;
      for (const Face seed : seeds) labels.insert(get(ids.map(), seed));
      return labels;
    }();
    EXPECT_EQ(of_seeds.size(), seeds.size());
    EXPECT_EQ(segmentation_from_seeds(mesh, Conductance(mesh, difference), seeds, by_hand.map()), seeds.size());
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t f = 0; f < ids.values().size(); ++f) pairs.insert({ids.values()[f], by_hand.values()[f]});
    EXPECT_EQ(pairs.size(), seeds.size());
  }
}

// ---- How they are called ----

TEST(NamedParameters, MayFollowTheOutputOrThePolicies) {
  const Mesh mesh = some_mesh();
  // A sphere, so that it shows whether the name counts.
  const auto sphere = boost::make_function_property_map<Mesh::Vertex_index>([&](const Mesh::Vertex_index& v) {
    const auto from_origin = mesh.point(v) - CGAL::ORIGIN;
    return CGAL::ORIGIN + from_origin / std::sqrt(from_origin.squared_length());
  });
  const auto np = CGAL::parameters::vertex_point_map(sphere);
  Face_labels<Mesh> expected(mesh), ids(mesh);
  segmentation_via_random_walks(mesh, expected.map(), Automatic_segmentation(), no_seeds, np);
  EXPECT_NE(expected.values(), labels_of(mesh, Automatic_segmentation()));
  segmentation_via_random_walks(mesh, ids.map(), np);
  EXPECT_EQ(ids.values(), expected.values());
  segmentation_via_random_walks(mesh, ids.map(), Automatic_segmentation(), np);
  EXPECT_EQ(ids.values(), expected.values());
  const Any_stop stop = Automatic_segmentation().stop;
  for (const auto& hierarchy :
       {hierarchy_via_random_walks(mesh, np), hierarchy_via_random_walks(mesh, Automatic_segmentation(), np),
        hierarchy_via_random_walks(mesh, Automatic_segmentation(), no_seeds, np)}) {
    hierarchy.segments(stop, ids.map());
    EXPECT_EQ(ids.values(), expected.values());
  }
  segmentation_via_random_walks(mesh, ids.map(), CGAL::parameters::default_values());
  EXPECT_EQ(ids.values(), labels_of(mesh, Automatic_segmentation()));
}

TEST(NamedParameters, MayFollowTheMeshOrTheDifference) {
  const Mesh mesh = some_mesh();
  const auto squeezed = boost::make_function_property_map<Mesh::Vertex_index>([&](const Mesh::Vertex_index& v) {
    const auto p = mesh.point(v);
    return Mesh::Point(p.x(), 2 * p.y(), 0.5 * p.z());
  });
  const auto np = CGAL::parameters::vertex_point_map(squeezed);
  const auto expect_equal = [&](const auto& shorter, const auto& longer) {
    for (const auto e : mesh.edges()) {
      if (mesh.is_border(e)) continue;
      EXPECT_EQ(get(shorter, e), get(longer, e));
    }
  };
  const Dihedral_difference difference(mesh, np);
  expect_equal(difference, Dihedral_difference(mesh, Dihedral_difference_policy(), np));
  EXPECT_NE(get(difference, Mesh::Edge_index(0)), get(Dihedral_difference(mesh), Mesh::Edge_index(0)));
  expect_equal(Curvature_difference(mesh, np), Curvature_difference(mesh, Curvature_difference_policy().radius, np));
  expect_equal(Conductance(mesh, difference, np), Conductance(mesh, difference, 1, 20, np));
}

TEST(ConcurrencyTag, DoesNotChangeTheResult) {
  for (const std::size_t largest_direct : {std::size_t(0), std::size_t(100000)}) {
    const Mesh mesh = some_mesh(48);
    Automatic_segmentation policies;
    policies.reduction.largest_direct = largest_direct;
    Face_labels<Mesh> ids(mesh);
    const Labels expected = labels_of(mesh, policies);
    segmentation_via_random_walks<CGAL::Sequential_tag>(mesh, ids.map(), policies);
    EXPECT_EQ(ids.values(), expected);
    hierarchy_via_random_walks<CGAL::Sequential_tag>(mesh, policies).segments(policies.stop, ids.map());
    EXPECT_EQ(ids.values(), expected);
  }
}

}  // namespace test_policies
