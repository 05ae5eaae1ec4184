// SPDX-License-Identifier: MIT

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Eigen_walk_solver.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/internal/parallel_for.h>

#include <CGAL/tags.h>

#include <boost/property_map/function_property_map.hpp>

#include <gtest/gtest.h>
#include "face_labels.h"
#include "meshes.h"
#include "networks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace test_random_walk {

using namespace RW_segmentation;

namespace {

template <class Mesh>
auto equal_conductances() {
  using edge_descriptor = typename boost::graph_traits<Mesh>::edge_descriptor;
  return as_conductance(boost::make_function_property_map<edge_descriptor>([](const edge_descriptor&) { return 1.; }));
}

template <class Mesh>
Conductance<Mesh> dihedral_conductances(const Mesh& mesh) {
  return Conductance<Mesh>(mesh, Dihedral_difference<Mesh>(mesh));
}

template <class Holder>
class Walk : public testing::Test {};
TYPED_TEST_SUITE(Walk, meshes::Holders);

}  // namespace

TYPED_TEST(Walk, CutsTheLShapeAlongItsConcaveEdge) {
  const meshes::Shape shape = meshes::l_shape(4);
  const TypeParam held(shape);
  Face_labels<typename TypeParam::Mesh> labels(held.mesh);
  // One seed on the far end of each arm.
  std::size_t ends[2] = {0, 0};
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const auto centre = [&](std::size_t g, int axis) { return shape.points[shape.faces[g][0]][axis]; };
    if (centre(f, 0) > centre(ends[0], 0)) ends[0] = f;
    if (centre(f, 1) > centre(ends[1], 1)) ends[1] = f;
  }
  Random_walk walk(held.mesh, dihedral_conductances(held.mesh));
  walk.add_seed(labels.face(ends[0]), 0);
  walk.add_seed(labels.face(ends[1]), 1);
  EXPECT_EQ(walk.segment(labels.map()), 2u);
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const std::size_t v : shape.faces[f]) centre += shape.points[v] / 3;
    if (centre.x() > 1.01) {
      EXPECT_EQ(labels.values()[f], 0u) << centre.transpose();
    } else if (centre.y() > 1.01) {
      EXPECT_EQ(labels.values()[f], 1u) << centre.transpose();
    }
  }
}

TYPED_TEST(Walk, GivesTheSamePotentialsAsADenseSolve) {
  const TypeParam held(meshes::with_noise(meshes::sphere(2), 0.03));
  const auto conductance = dihedral_conductances(held.mesh);
  Face_labels<typename TypeParam::Mesh> labels(held.mesh);
  const Dual_mesh_of dual(held.mesh);
  networks::Network network{dual.graph(), {}};
  for (const auto& e : dual.edge_descriptors()) network.conductances.push_back(get(conductance, e));
  const std::vector<networks::Index> seeds = {3, 100, 200, 250};
  Random_walk walk(held.mesh, conductance);
  for (std::size_t l = 0; l < seeds.size(); ++l) walk.add_seed(dual.face(seeds[l]), 10 * l);
  const auto dense = networks::dense_potentials<long double>(network, seeds);
  for (std::size_t f = 0; f < dense.size(); ++f)
    for (std::size_t l = 0; l < seeds.size(); ++l)
      ASSERT_NEAR(walk.probability(dual.face(static_cast<networks::Index>(f)), 10 * l),
                  static_cast<double>(dense[f][l]), 1e-9);
  EXPECT_EQ(walk.probability(labels.face(0), 5), 0);
}

TYPED_TEST(Walk, GivesComponentsWithoutASeedTheNextUnusedLabels) {
  const TypeParam held(meshes::together(meshes::together(meshes::cube(), meshes::moved(meshes::cube(), {3, 0, 0})),
                                        meshes::moved(meshes::plane(1), {0, 0, 5})));
  Face_labels<typename TypeParam::Mesh> labels(held.mesh);
  Random_walk walk(held.mesh, equal_conductances<typename TypeParam::Mesh>());
  walk.add_seed(labels.face(15), 7);
  walk.add_seed(labels.face(18), 3);
  EXPECT_EQ(walk.segment(labels.map()), 4u);
  EXPECT_EQ(walk.report().unseeded_components, 2u);
  for (std::size_t f = 0; f < 12; ++f) EXPECT_EQ(labels.values()[f], 8u);
  for (std::size_t f = 24; f < 26; ++f) EXPECT_EQ(labels.values()[f], 9u);
  const std::set<std::size_t> middle(labels.values().begin() + 12, labels.values().begin() + 24);
  EXPECT_EQ(middle, (std::set<std::size_t>{3, 7}));
}

TYPED_TEST(Walk, ReturnsContiguousIdsFromTheFreeFunction) {
  const TypeParam held(meshes::torus(2, 0.7, 20, 10));
  Face_labels<typename TypeParam::Mesh> labels(held.mesh);
  using Face = typename Face_labels<typename TypeParam::Mesh>::face_descriptor;
  const std::vector<std::pair<Face, std::size_t>> seeds = {
      {labels.face(0), 1000000}, {labels.face(100), 4}, {labels.face(200), 4}, {labels.face(300), 17}};
  EXPECT_EQ(segmentation_from_seeds(held.mesh, dihedral_conductances(held.mesh), seeds, labels.map()), 3u);
  EXPECT_EQ(labels.values()[0], 2u);
  EXPECT_EQ(labels.values()[100], 0u);
  EXPECT_EQ(labels.values()[200], 0u);
  EXPECT_EQ(labels.values()[300], 1u);
  const std::vector<Face> faces = {labels.face(5), labels.face(105), labels.face(205)};
  EXPECT_EQ(segmentation_from_seeds(held.mesh, dihedral_conductances(held.mesh), faces, labels.map()), 3u);
  for (std::size_t s = 0; s < 3; ++s) EXPECT_EQ(labels.values()[5 + 100 * s], s);
}

TYPED_TEST(Walk, MakesConnectedSegmentsOfTwoLabels) {
  const TypeParam held(meshes::with_noise(meshes::torus(2, 0.8, 40, 20), 0.05));
  Face_labels<typename TypeParam::Mesh> labels(held.mesh);
  Random_walk walk(held.mesh, dihedral_conductances(held.mesh));
  walk.add_seed(labels.face(10), 0);
  walk.add_seed(labels.face(900), 1);
  walk.write_raw_labels(labels.map());
  EXPECT_EQ(walk.report().island_faces, 0u);
  const std::vector<std::size_t> raw = labels.values();
  walk.segment(labels.map());
  EXPECT_EQ(raw, labels.values());
}

TYPED_TEST(Walk, OnAMeshThatHasBeenReadIsTheWalkOnTheMesh) {
  const TypeParam held(meshes::with_noise(meshes::torus(2, 0.7, 20, 10), 0.02));
  using Mesh = typename TypeParam::Mesh;
  Face_labels<Mesh> expected(held.mesh), labels(held.mesh);
  const auto conductance = dihedral_conductances(held.mesh);
  const std::vector<typename Face_labels<Mesh>::face_descriptor> seeds = {expected.face(5), expected.face(105),
                                                                          expected.face(205)};
  segmentation_from_seeds(held.mesh, conductance, seeds, expected.map());
  const Dual_mesh_of<Mesh> dual(held.mesh);
  EXPECT_EQ(segmentation_from_seeds(dual, conductance, seeds, labels.map()), 3u);
  EXPECT_EQ(labels.values(), expected.values());
  Random_walk walk(Dual_mesh_of<Mesh>(held.mesh), conductance);  // keeps a copy
  for (std::size_t s = 0; s < seeds.size(); ++s) walk.add_seed(seeds[s], s);
  walk.segment(labels.map());
  EXPECT_EQ(labels.values(), expected.values());
}

TYPED_TEST(Walk, StepsOverNoConstrainedEdge) {
  const TypeParam held(meshes::cube(4));
  using Mesh = typename TypeParam::Mesh;
  using edge_descriptor = typename boost::graph_traits<Mesh>::edge_descriptor;
  const Dual_mesh_of<Mesh> dual(held.mesh);
  const auto is_wall = boost::make_function_property_map<edge_descriptor>([&](const edge_descriptor& e) {
    const auto index = [&](auto h) { return dual.index(face(h, held.mesh)); };
    return dual.normal(index(halfedge(e, held.mesh))) !=
           dual.normal(index(opposite(halfedge(e, held.mesh), held.mesh)));
  });
  Face_labels<Mesh> labels(held.mesh);
  Random_walk walk(held.mesh, equal_conductances<Mesh>(), CGAL::parameters::edge_is_constrained_map(is_wall));
  walk.add_seed(labels.face(0), 0);
  EXPECT_EQ(walk.segment(labels.map()), 6u);
  for (std::size_t f = 0; f < labels.values().size(); ++f)
    for (std::size_t g = 0; g < f; ++g)
      EXPECT_EQ(labels.values()[f] == labels.values()[g],
                dual.normal(dual.index(labels.face(f))) == dual.normal(dual.index(labels.face(g))));
}

// ---- Arguments ----

TEST(RandomWalk, TakesNamedParametersInThePlaceOfTheSolver) {
  const auto mesh = meshes::surface_mesh(meshes::sphere(2));
  Face_labels<meshes::Surface_mesh> labels(mesh);
  std::size_t calls = 0;
  const std::function<bool(double)> callback = [&](double) { return ++calls > 0; };
  Random_walk walk(mesh, dihedral_conductances(mesh), CGAL::parameters::callback(callback));
  static_assert(std::is_same_v<decltype(walk), Random_walk<meshes::Surface_mesh>>);
  walk.add_seed(labels.face(0), 0);
  walk.add_seed(labels.face(1), 1);
  walk.segment(labels.map());
  EXPECT_GT(calls, 0u);
}

TEST(RandomWalk, TellsWhichFaceIsNoneOfTheMesh) {
  const auto mesh = meshes::surface_mesh(meshes::sphere(1));
  const auto stranger = meshes::Surface_mesh::Face_index(1000);
  Random_walk walk(mesh, dihedral_conductances(mesh));
  const auto message = [&](const auto& work) -> std::string {
    try {
      work();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message([&] { walk.add_seed(stranger, 0); }), "the seed is not a face of the mesh");
  walk.add_seed(meshes::Surface_mesh::Face_index(0), 0);
  EXPECT_EQ(message([&] { walk.probability(stranger, 0); }), "the face is not a face of the mesh");
}

TEST(RandomWalk, CountsFacesWithoutArea) {
  auto mesh = meshes::surface_mesh(meshes::sphere(1));
  const auto h = mesh.halfedge(meshes::Surface_mesh::Face_index(0));
  mesh.point(mesh.source(h)) = CGAL::midpoint(mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))));
  const Random_walk walk(mesh, equal_conductances<meshes::Surface_mesh>());
  EXPECT_EQ(walk.report().degenerate_faces, 1u);
  const RW_segmentation::Dual_mesh_of dual(mesh);
  const Random_walk walk_on_dual(dual, equal_conductances<meshes::Surface_mesh>());
  EXPECT_EQ(walk_on_dual.report().degenerate_faces, 1u);
}

// ---- Invariance ----

TEST(RandomWalk, DoesNotDependOnScalePlaceRotationOrOrderOfFaces) {
  const meshes::Shape shape = meshes::with_noise(meshes::two_spheres_with_neck(3, 0.4, 24), 0.01);
  const std::vector<std::size_t> order = meshes::random_order(shape.faces.size());
  const auto segment = [](const meshes::Shape& s, std::size_t a, std::size_t b) {
    const auto mesh = meshes::surface_mesh(s);
    Face_labels<meshes::Surface_mesh> labels(mesh);
    Random_walk walk(mesh, dihedral_conductances(mesh));
    walk.add_seed(labels.face(a), 0);
    walk.add_seed(labels.face(b), 1);
    walk.segment(labels.map());
    return labels.values();
  };
  const std::size_t a = 5, b = shape.faces.size() - 5;
  const auto expected = segment(shape, a, b);
  const auto differences = [&](const std::vector<std::size_t>& labels) {
    std::size_t number = 0;
    for (std::size_t f = 0; f < labels.size(); ++f) number += labels[f] != expected[f];
    return number;
  };
  EXPECT_EQ(differences(segment(meshes::transformed(shape, meshes::some_rotation()), a, b)), 0u);
  EXPECT_EQ(differences(segment(meshes::scaled(shape, 1e150), a, b)), 0u);
  EXPECT_EQ(differences(segment(meshes::scaled(shape, 1e-150), a, b)), 0u);
  EXPECT_LE(differences(segment(meshes::moved(shape, {1e8, -1e8, 1e8}), a, b)), shape.faces.size() / 200);

  const auto place = [&](std::size_t face) {
    return static_cast<std::size_t>(std::find(order.begin(), order.end(), face) - order.begin());
  };
  const auto shuffled = segment(meshes::with_faces_in_order(shape, order), place(a), place(b));
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(shuffled[i], expected[order[i]]);
}

TEST(DualMesh, HasTheGraphOfTheMeshWithNeighboursClose) {
  const meshes::Shape sphere = meshes::sphere(4);
  const auto order = meshes::random_order(sphere.faces.size());
  const auto mesh = meshes::surface_mesh(meshes::with_faces_in_order(sphere, order));
  const Dual_mesh_of dual(mesh);
  const Dual_graph& graph = dual.graph();

  ASSERT_EQ(graph.number_of_faces(), mesh.number_of_faces());
  ASSERT_EQ(graph.number_of_edges(), mesh.number_of_edges());
  for (Dual_graph::Index f = 0; f < graph.number_of_faces(); ++f) EXPECT_EQ(dual.index(dual.face(f)), f);
  std::set<meshes::Surface_mesh::Edge_index> edges;
  double distance = 0, distance_before = 0;
  for (Dual_graph::Index e = 0; e < graph.number_of_edges(); ++e) {
    edges.insert(dual.edge(e));
    const auto h = halfedge(dual.edge(e), mesh);
    const auto [f, g] = graph.faces_of(e);
    EXPECT_EQ(dual.face(f), face(h, mesh));
    EXPECT_EQ(dual.face(g), face(opposite(h, mesh), mesh));
    distance = std::max(distance, std::abs(double(f) - double(g)));
    distance_before = std::max(distance_before, std::abs(double(dual.place(f)) - double(dual.place(g))));
  }
  EXPECT_EQ(edges.size(), graph.number_of_edges());
  EXPECT_LT(distance, distance_before / 10);
}

TEST(RandomWalk, SegmentsAPlaneByDistanceWhetherRotatedOrNot) {
  for (const bool rotated : {false, true}) {
    const meshes::Shape plane = meshes::plane(11);
    const auto mesh = meshes::surface_mesh(rotated ? meshes::transformed(plane, meshes::some_rotation()) : plane);
    Face_labels<meshes::Surface_mesh> labels(mesh);
    Random_walk walk(mesh, dihedral_conductances(mesh));
    walk.add_seed(labels.face(0), 0);
    walk.add_seed(labels.face(241), 1);
    walk.segment(labels.map());
    EXPECT_EQ(std::count(labels.values().begin(), labels.values().end(), 0u), 121);
  }
}

TEST(RandomWalk, DependsOnRatiosOfConductancesOnly) {
  std::mt19937 random(9);
  networks::Network network{networks::triangulated_torus(10), {}};
  network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 2, random);
  const auto potential_of = [&](int exponent) {
    std::vector<double> conductances = network.conductances;
    for (double& c : conductances) c = std::ldexp(c, exponent);
    internal::Graph_walk walk(network.graph, conductances);
    for (networks::Index l = 0; l < 3; ++l) walk.add_seed(60 * l, l);
    return walk.potential(1);
  };
  const std::vector<double> expected = potential_of(0);
  for (const int exponent : {-1000, 100, 1023}) EXPECT_EQ(potential_of(exponent), expected) << exponent;
}

/// What a walk of 100 labels tells of its progress, and how often once its solver has been prepared.
static void expect_progress_while_solving(std::size_t squares, internal::Any_walk_solver solver) {
  networks::Network network{networks::triangulated_torus(squares), {}};
  network.conductances.assign(network.graph.number_of_edges(), 1.);
  std::vector<double> told;
  const Progress progress{[&](double fraction) {
    told.push_back(fraction);
    return true;
  }};
  internal::Graph_walk walk(network.graph, network.conductances, std::move(solver), progress);
  for (networks::Index l = 0; l < 100; ++l) walk.add_seed(2 * l, l);
  walk.labels();
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1);
  const auto solving = std::count_if(told.begin(), told.end(), [](double fraction) { return fraction > 0.7; });
  const std::set<double> different(told.end() - solving, told.end());
  EXPECT_GE(different.size(), 4u);
}

TEST(RandomWalk, TellsOfItsProgressWhileManyLabelsAreSolved) {
  // By one thread: of several, the calling one alone tells of its progress, and others may do nearly all of the work.
  internal::with_threads<CGAL::Sequential_tag>([] {
    expect_progress_while_solving(120, {});
    expect_progress_while_solving(10, RW_segmentation::Eigen_walk_solver<>());
  });
}

// ---- Editing ----

namespace {

/// A graph walk under random edits is held against a fresh solve after each.
void edit_at_random(const networks::Network& network, std::size_t edits, unsigned seed, double accepted,
                    internal::Graph_walk& walk) {
  using networks::Index;
  std::mt19937 random(seed);
  const auto n = static_cast<Index>(network.graph.number_of_faces());
  walk.clear_seeds();
  for (std::size_t l = 0; l < 4; ++l) walk.add_seed(static_cast<Index>(random() % n), l);
  walk.labels();
  for (std::size_t edit = 0; edit < edits; ++edit) {
    const auto action = random() % 5;
    const std::size_t number = walk.seeds().size();
    if (action < 2 && number < 12) {
      walk.add_seed(static_cast<Index>(random() % n), random() % 6);
    } else if (action < 4 && number > 2) {
      walk.remove_seed(walk.seeds()[random() % number].face);
    } else {
      walk.add_seed(walk.seeds()[random() % number].face, random() % 6);
    }
    std::vector<Index> faces;
    std::map<std::size_t, std::vector<std::size_t>> columns;
    for (const auto& s : walk.seeds()) {
      columns[s.label].push_back(faces.size());
      faces.push_back(s.face);
    }
    Star_mesh_elimination fresh;
    const Potentials expected = networks::potentials(fresh, network, faces);
    std::vector<double> largest(n, -1), second(n, -1);
    std::vector<std::size_t> label(n, 0);
    for (const auto& [l, own] : columns) {
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
      for (const std::size_t c : own) sum += expected.col(static_cast<Eigen::Index>(c));
      const std::vector<double> potential = columns.size() > 1 ? walk.potential(l) : std::vector<double>(n, 1.);
      for (Index f = 0; f < n; ++f) {
        ASSERT_NEAR(potential[f], sum[f], accepted) << "edit " << edit << " face " << f << " label " << l;
        if (sum[f] > largest[f]) {
          second[f] = std::exchange(largest[f], sum[f]);
          label[f] = l;
        } else {
          second[f] = std::max(second[f], sum[f]);
        }
      }
    }
    const auto& raw = walk.raw_labels();
    for (Index f = 0; f < n; ++f) {
      if (largest[f] - second[f] <= accepted) continue;
      ASSERT_EQ(raw[f], label[f]) << "edit " << edit << " face " << f;
    }
  }
}

}  // namespace

TEST(SeedEditing, EqualsAFreshFactorisationAfterEachOfAThousandRandomEdits) {
  std::mt19937 random(1);
  networks::Network network{networks::triangulated_torus(16), {}};
  network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 9, random);
  internal::Graph_walk walk(network.graph, network.conductances);
  edit_at_random(network, 1000, 2, 1e-8, walk);
  EXPECT_GT(walk.report().columns_added, 300u);
  EXPECT_LT(walk.report().factorisations, 50u);
}

TEST(SeedEditing, StaysRightWithoutACap) {
  std::mt19937 random(3);
  networks::Network network{networks::triangulated_torus(12), {}};
  network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 200, random);
  internal::Graph_walk walk(network.graph, network.conductances);
  edit_at_random(network, 300, 4, 1e-8, walk);
}

TEST(SeedEditing, ChangesNothingWhenASeedIsAddedAndRemoved) {
  const auto mesh = meshes::surface_mesh(meshes::with_noise(meshes::sphere(4), 0.01));
  Face_labels<meshes::Surface_mesh> before(mesh), after(mesh);
  Random_walk walk(mesh, dihedral_conductances(mesh));
  for (std::size_t l = 0; l < 5; ++l) walk.add_seed(before.face(1000 * l), l);
  walk.segment(before.map());
  for (const std::size_t f : {500u, 1500u, 2500u}) {
    walk.add_seed(before.face(f), 9);
    walk.segment(after.map());
    EXPECT_NE(before.values(), after.values());
    EXPECT_TRUE(walk.remove_seed(before.face(f)));
    walk.segment(after.map());
    EXPECT_EQ(before.values(), after.values());
  }
  EXPECT_EQ(walk.report().factorisations, 1u);
}

namespace {

struct Counting_solver : Star_mesh_elimination {
  static int analyses;

  void analyze(const Dual_graph& graph) {
    ++analyses;
    Star_mesh_elimination::analyze(graph);
  }
};
int Counting_solver::analyses = 0;

}  // namespace

TEST(SeedEditing, AnalysesTheMeshOnceHoweverOftenItFactorises) {
  std::mt19937 random(4);
  networks::Network network{networks::triangulated_torus(10), {}};
  network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 2, random);
  Counting_solver::analyses = 0;
  internal::Graph_walk walk(network.graph, network.conductances, internal::Any_walk_solver(Counting_solver()));
  for (networks::Index shift = 0; shift < 3; ++shift) {
    walk.clear_seeds();
    for (networks::Index l = 0; l < 12; ++l) walk.add_seed(15 * l + shift, l);
    walk.labels();
  }
  EXPECT_EQ(walk.report().factorisations, 3u);
  EXPECT_EQ(Counting_solver::analyses, 1);
}

TEST(SeedEditing, AnalysesTheMeshBeforeThereIsASeedWhereItIsAnticipated) {
  networks::Network network{networks::triangulated_torus(10), {}};
  network.conductances.assign(network.graph.number_of_edges(), 1);
  Counting_solver::analyses = 0;
  internal::Graph_walk walk(network.graph, network.conductances, internal::Any_walk_solver(Counting_solver()));
  EXPECT_EQ(Counting_solver::analyses, 0);
  walk.anticipate();
  EXPECT_EQ(Counting_solver::analyses, 1);
  walk.add_seed(0, 0);
  walk.add_seed(100, 1);
  walk.labels();
  EXPECT_EQ(Counting_solver::analyses, 1);
}

TEST(SeedEditing, AnswersASecondLabelWithoutAFactorisationWhereItWasAnticipated) {
  std::mt19937 random(15);
  networks::Network network{networks::triangulated_torus(10), {}};
  network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 2, random);
  const auto faces = networks::random_faces(network.graph, 6, random);
  for (const std::size_t seeds : {0u, 1u, 4u}) {
    internal::Graph_walk walk(network.graph, network.conductances), fresh(network.graph, network.conductances);
    for (std::size_t s = 0; s < seeds; ++s) {
      walk.add_seed(faces[s], 7);
      fresh.add_seed(faces[s], 7);
      walk.anticipate();  // the first one factorises, the others are edits
    }
    walk.anticipate();
    EXPECT_EQ(walk.report().factorisations, seeds > 0 ? 1u : 0u);
    if (seeds > 0) {
      EXPECT_EQ(walk.labels(), std::vector<std::size_t>(network.graph.number_of_faces(), 7));
    }

    for (auto* const w : {&walk, &fresh}) {
      w->add_seed(faces[4], 2);
      w->add_seed(faces[5], 3);
    }
    EXPECT_EQ(walk.labels(), fresh.labels());
    const std::vector<double> potential = walk.potential(3), expected = fresh.potential(3);
    for (std::size_t f = 0; f < potential.size(); ++f) ASSERT_NEAR(potential[f], expected[f], 1e-9);
    walk.anticipate();
    EXPECT_EQ(walk.report().factorisations, 1u);
    EXPECT_EQ(walk.report().columns_added, seeds > 0 ? seeds + 1 : 0u);
  }
}

TEST(SeedEditing, MayBeCancelledWhileItIsAnticipated) {
  std::mt19937 random(16);
  networks::Network network{networks::triangulated_torus(10), {}};
  network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 2, random);
  bool goes_on = false;
  internal::Graph_walk walk(network.graph, network.conductances, {}, Progress([&](double) { return goes_on; }));
  EXPECT_THROW(walk.anticipate(), Cancelled);
  walk.add_seed(0, 0);
  EXPECT_THROW(walk.anticipate(), Cancelled);
  goes_on = true;
  walk.anticipate();
  walk.add_seed(100, 1);
  const std::vector<std::size_t> labels = walk.labels();
  EXPECT_EQ(labels, internal::walk_labels(network.graph, network.conductances, {0, 100}, {0, 1}));
}

TEST(SeedEditing, AddsBackASeedThatTheFactorWasMadeWith) {
  std::mt19937 random(5);
  networks::Network network{networks::triangulated_torus(10), {}};
  network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 2, random);
  internal::Graph_walk walk(network.graph, network.conductances);
  for (networks::Index l = 0; l < 4; ++l) walk.add_seed(50 * l, l);
  const auto before = walk.labels();
  const auto potential = walk.potential(2);
  for (const networks::Index l : {0u, 1u, 2u}) {  // all of them but one leave and come back
    walk.remove_seed(50 * l);
    walk.labels();
  }
  for (const networks::Index l : {1u, 2u, 0u}) {
    walk.add_seed(50 * l, l);
    walk.labels();
  }
  EXPECT_EQ(walk.labels(), before);
  EXPECT_EQ(walk.report().factorisations, 1u);
  const auto again = walk.potential(2);
  for (std::size_t f = 0; f < again.size(); ++f) ASSERT_NEAR(again[f], potential[f], 1e-9);
}

TEST(SeedEditing, StaysRightWhenSeedsOfTheFactorComeBackAfterOthers) {
  std::mt19937 random(8);
  networks::Network network{networks::triangulated_torus(10), {}};
  network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 2, random);
  internal::Graph_walk walk(network.graph, network.conductances);
  const std::vector<networks::Index> seeds = {30, 0, 50, 120};
  const auto add = [&](std::size_t l) {
    walk.add_seed(seeds[l], l);
    walk.labels();
  };
  walk.add_seed(seeds[1], 1);
  add(2);
  add(0);
  for (const std::size_t l : {1u, 2u}) {
    walk.remove_seed(seeds[l]);
    walk.labels();
    add(l);
  }
  add(3);
  EXPECT_EQ(walk.report().factorisations, 1u);
  Star_mesh_elimination fresh;
  const Potentials expected = networks::potentials(fresh, network, seeds);
  for (std::size_t l = 0; l < seeds.size(); ++l) {
    const std::vector<double> potential = walk.potential(l);
    for (std::size_t f = 0; f < potential.size(); ++f)
      ASSERT_NEAR(potential[f], expected(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(l)), 1e-9);
  }
}

TEST(SeedEditing, FollowsSeedsThroughSeveralComponents) {
  const auto mesh =
      meshes::surface_mesh(meshes::together(meshes::sphere(2), meshes::moved(meshes::sphere(2), {9, 0, 0})));
  Face_labels<meshes::Surface_mesh> labels(mesh), fresh(mesh);
  Random_walk walk(mesh, dihedral_conductances(mesh));
  const auto check = [&] {
    walk.segment(labels.map());
    Random_walk once(mesh, dihedral_conductances(mesh));
    for (const auto& [face, label] : walk.seeds()) once.add_seed(face, label);
    once.segment(fresh.map());
    EXPECT_EQ(labels.values(), fresh.values());
  };
  walk.add_seed(labels.face(1), 0);
  walk.add_seed(labels.face(100), 1);
  check();
  walk.add_seed(labels.face(350), 2);  // the first in the second component
  check();
  walk.add_seed(labels.face(450), 3);
  check();
  walk.remove_seed(labels.face(350));
  check();
  walk.remove_seed(labels.face(450));  // the last one there
  check();
  walk.add_seed(labels.face(500), 1);
  check();
  walk.remove_seed(labels.face(1));
  walk.remove_seed(labels.face(100));
  check();
}

TEST(SeedEditing, AnswersStrokesOfHundredsOfFaces) {
  const auto mesh = meshes::surface_mesh(meshes::with_noise(meshes::torus(2, 0.7, 60, 30), 0.02));
  Face_labels<meshes::Surface_mesh> labels(mesh), fresh(mesh);
  Random_walk walk(mesh, dihedral_conductances(mesh));
  for (std::size_t f = 0; f < 300; ++f) walk.add_seed(labels.face(f), 0);
  for (std::size_t f = 1500; f < 1800; ++f) walk.add_seed(labels.face(f), 1);
  walk.segment(labels.map());
  for (std::size_t f = 2800; f < 3000; ++f) walk.add_seed(labels.face(f), 2);
  EXPECT_EQ(walk.segment(labels.map()), 3u);
  for (const auto& [face, label] : walk.seeds()) EXPECT_EQ(get(labels.map(), face), label);
  double sum = 0;
  for (std::size_t l = 0; l < 3; ++l) sum += walk.probability(labels.face(1000), l);
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_EQ(walk.report().columns_added, 0u);
}

TEST(SeedEditing, GivesTheSamePotentialsForAnyNumberOfThreads) {
  std::mt19937 random(13);
  networks::Network network{networks::triangulated_torus(80), {}};
  network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 4, random);
  const auto faces = networks::random_faces(network.graph, 14, random);
  const auto edited = [&] {
    internal::Graph_walk walk(network.graph, network.conductances);
    for (std::size_t l = 0; l < 10; ++l) walk.add_seed(faces[l], l);
    walk.labels();
    for (std::size_t l = 10; l < 14; ++l) {
      walk.add_seed(faces[l], l);
      walk.labels();
      walk.remove_seed(faces[l - 10]);
      walk.labels();
    }
    walk.add_seed(faces[0], 0);  // and several at once
    walk.remove_seed(faces[8]);
    walk.remove_seed(faces[9]);
    std::vector<std::vector<double>> potentials;
    for (std::size_t l = 0; l < 14; ++l) potentials.push_back(walk.potential(l));
    EXPECT_EQ(walk.report().factorisations, 1u);
    return std::pair(walk.labels(), potentials);
  };
  EXPECT_EQ(internal::with_threads<CGAL::Sequential_tag>(edited), edited());
}

TEST(SeedEditing, WorksWithEigensSolvers) {
  std::mt19937 random(6);
  networks::Network network{networks::triangulated_torus(12), {}};
  network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 2, random);
  internal::Graph_walk walk(network.graph, network.conductances, internal::Any_walk_solver(Eigen_walk_solver<>()));
  internal::Graph_walk expected(network.graph, network.conductances);
  for (int edit = 0; edit < 30; ++edit) {
    if (edit % 3 == 2) {
      const auto face = walk.seeds()[random() % walk.seeds().size()].face;
      walk.remove_seed(face);
      expected.remove_seed(face);
    } else {
      const auto face = static_cast<networks::Index>(random() % network.graph.number_of_faces());
      walk.add_seed(face, static_cast<std::size_t>(edit));
      expected.add_seed(face, static_cast<std::size_t>(edit));
    }
    ASSERT_EQ(walk.labels(), expected.labels()) << "edit " << edit;
  }
}

// ---- Islands ----

TEST(Islands, GoToTheBestSupportedNeighbourAndAreCounted) {
  // On periodic grids some runs with six seeds have islands: found here by trying, then held to what is promised.
  std::size_t runs_with_islands = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    networks::Network network{networks::triangulated_torus(30), {}};
    network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 2, random);
    internal::Graph_walk walk(network.graph, network.conductances);
    const auto seeds = networks::random_faces(network.graph, 8, random);
    for (std::size_t l = 0; l < seeds.size(); ++l) walk.add_seed(seeds[l], l);
    const auto raw = walk.raw_labels();
    const auto& labels = walk.labels();
    std::size_t moved = 0;
    for (std::size_t f = 0; f < raw.size(); ++f) moved += raw[f] != labels[f];
    EXPECT_EQ(moved, walk.report().island_faces);
    runs_with_islands += moved > 0;
    // Now every segment is connected.
    std::vector<char> reached(labels.size(), 0);
    for (const auto start : seeds) {
      std::vector<networks::Index> open = {start};
      reached[start] = 1;
      while (!open.empty()) {
        const auto face = open.back();
        open.pop_back();
        for (const auto& [next, edge] : network.graph.neighbours(face))
          if (!reached[next] && labels[next] == labels[face]) {
            reached[next] = 1;
            open.push_back(next);
          }
      }
    }
    EXPECT_EQ(std::count(reached.begin(), reached.end(), 1), static_cast<std::ptrdiff_t>(labels.size()));
  }
  EXPECT_GT(runs_with_islands, 0u);
}

/// Faces in components with seeds that no seed of their label reaches over faces of the label.
static std::size_t number_cut_off(const networks::Network& network, const internal::Graph_walk& walk,
                                  const std::vector<std::size_t>& labels) {
  const auto reached_from_seeds = [&](const auto& may_go) {
    std::vector<char> reached(labels.size(), 0);
    std::vector<networks::Index> open;
    for (const auto& seed : walk.seeds()) open.push_back(seed.face);
    for (const auto face : open) reached[face] = 1;
    while (!open.empty()) {
      const auto face = open.back();
      open.pop_back();
      for (const auto& [next, edge] : network.graph.neighbours(face)) {
        if (reached[next] || !(network.conductances[edge] > 0) || !may_go(face, next)) continue;
        reached[next] = 1;
        open.push_back(next);
      }
    }
    return static_cast<std::size_t>(std::count(reached.begin(), reached.end(), 1));
  };
  return reached_from_seeds([](auto, auto) { return true; }) -
         reached_from_seeds([&](auto face, auto next) { return labels[face] == labels[next]; });
}

TEST(Islands, AreAllFacesThatNoSeedOfTheirLabelReaches) {
  // Of so many faces that they are not all joined at the same time.
  std::size_t answers_with_islands = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937 random(seed);
    networks::Network network{networks::triangulated_torus(130), {}};
    network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 12, random);
    if (seed % 2)  // walls
      for (double& c : network.conductances)
        if (random() % 5 == 0) c = 0;
    const auto faces = networks::random_faces(network.graph, 12, random);
    internal::Graph_walk walk(network.graph, network.conductances);
    for (std::size_t l = 0; l < 8; ++l) walk.add_seed(faces[l], l);
    for (std::size_t l = 8; l < 12; ++l) {
      const auto raw = walk.raw_labels();
      EXPECT_EQ(number_cut_off(network, walk, raw), walk.report().island_faces) << "seed " << seed;
      EXPECT_EQ(number_cut_off(network, walk, walk.labels()), 0u) << "seed " << seed;
      answers_with_islands += walk.report().island_faces > 0;
      walk.add_seed(faces[l], l % 3);
      if (l % 2) walk.remove_seed(faces[l - 4]);
    }
  }
  EXPECT_GT(answers_with_islands, 8u);
}

/// The default solver without its way to the largest potentials.
class Solver_of_all_potentials {
 public:
  using Index = networks::Index;
  void analyze(const Dual_graph& graph) { solver_.analyze(graph); }
  void factorize(const std::vector<double>& conductances, const std::vector<Index>& absorbing,
                 const Progress& progress) {
    solver_.factorize(conductances, absorbing, progress);
  }
  void potentials(const Potentials& boundary_values, Potentials& potentials) const {
    solver_.potentials(boundary_values, potentials);
  }
  void response(Index face, const std::vector<double>& boundary_values, std::vector<double>& column) const {
    solver_.response(face, boundary_values, column);
  }
  std::vector<double> absorbed_currents(Index face) const { return solver_.absorbed_currents(face); }

 private:
  Star_mesh_elimination solver_;
};

TEST(Islands, GoWhereAllPotentialsTellThemToWhateverTheSolverOffers) {
  std::size_t walks_with_islands = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    networks::Network network{networks::triangulated_torus(seed % 2 ? 30 : 60), {}};
    network.conductances = networks::spread_conductances(network.graph.number_of_edges(), seed % 2 ? 2 : 12, random);
    internal::Graph_walk walk(network.graph, network.conductances);
    internal::Graph_walk reference(network.graph, network.conductances, Solver_of_all_potentials());
    const auto seeds = networks::random_faces(network.graph, 12, random);
    for (std::size_t s = 0; s < seeds.size(); ++s) {
      walk.add_seed(seeds[s], s % 8);
      reference.add_seed(seeds[s], s % 8);
    }
    EXPECT_EQ(walk.labels(), reference.labels()) << "seed " << seed;
    EXPECT_EQ(walk.report().island_faces, reference.report().island_faces);
    walks_with_islands += walk.report().island_faces > 0;
  }
  EXPECT_GT(walks_with_islands, 10u);
}

TEST(Islands, AreTheSameAfterEditsAsInAWalkMadeAnew) {
  std::size_t walks_with_islands = 0;
  std::mt19937 random(1);
  for (int trial = 0; trial < 40; ++trial) {
    networks::Network network{networks::triangulated_torus(20), {}};
    network.conductances = networks::spread_conductances(network.graph.number_of_edges(), 2, random);
    const auto faces = networks::random_faces(network.graph, 16, random);
    internal::Graph_walk walk(network.graph, network.conductances);
    for (std::size_t l = 0; l < 8; ++l) walk.add_seed(faces[l], l);
    walk.labels();
    for (std::size_t l = 0; l < 8; ++l) {
      if (l % 2 == 0)
        walk.add_seed(faces[8 + l], l);
      else
        walk.remove_seed(faces[l]);
      internal::Graph_walk anew(network.graph, network.conductances);
      for (const auto& [face, label] : walk.seeds()) anew.add_seed(face, label);
      EXPECT_EQ(walk.labels(), anew.labels());
      EXPECT_EQ(walk.report().island_faces, anew.report().island_faces);
      walks_with_islands += anew.report().island_faces > 0;
    }
  }
  EXPECT_GT(walks_with_islands, 5u);
}

}  // namespace test_random_walk
