// SPDX-License-Identifier: MIT

// Bad and odd input of the walk: one test for each kind, named for what it gets.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Eigen_walk_solver.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/smoothed_face_normals.h>
#ifdef RW_SEGMENTATION_WITH_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include <CGAL/Polyhedron_items_with_id_3.h>

#include <boost/multiprecision/mpfr.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/range/adaptor/filtered.hpp>
#include <boost/range/adaptor/transformed.hpp>

#include <gtest/gtest.h>
#include "mesh_graph.h"
#include "meshes.h"
#include "networks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace test_pathologies {

using namespace RW_segmentation;
using meshes::Shape;
using meshes::Surface_mesh;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

using Matrix = Eigen::SparseMatrix<double>;
using Cholesky = Eigen_walk_solver<Eigen::SimplicialLDLT<Matrix, Eigen::Lower>>;
using Conjugate_gradient = Eigen_walk_solver<Eigen::ConjugateGradient<Matrix, Eigen::Lower>>;

template <class Test>
void for_each_solver(const Test& test) {
  test(Star_mesh_elimination());
  test(Cholesky());
  test(Conjugate_gradient());
#ifdef RW_SEGMENTATION_WITH_CHOLMOD
  test(Eigen_walk_solver<Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower>>());
#endif
}

template <class Mesh>
using Face = typename boost::graph_traits<Mesh>::face_descriptor;
template <class Mesh>
using Edge = typename boost::graph_traits<Mesh>::edge_descriptor;

/// The faces of a mesh in its order, which is that of the shape it was made of.
template <class Mesh>
std::vector<Face<Mesh>> faces_of(const Mesh& mesh) {
  std::vector<Face<Mesh>> all;
  for (const Face<Mesh> face : faces(mesh)) all.push_back(face);
  return all;
}

/// A map from faces to labels that knows which faces have been written.
template <class Mesh, class Label = std::size_t>
class Written {
 public:
  auto map() { return boost::associative_property_map<std::map<Face<Mesh>, Label>>(labels_); }
  bool nothing() const { return labels_.empty(); }
  std::size_t faces() const { return labels_.size(); }
  Label operator[](const Face<Mesh>& face) const { return labels_.at(face); }
  std::vector<Label> in_order_of(const Mesh& mesh) const {
    std::vector<Label> labels;
    for (const auto& face : faces_of(mesh)) labels.push_back(labels_.at(face));
    return labels;
  }

 private:
  std::map<Face<Mesh>, Label> labels_;
};

template <class Mesh>
auto equal_conductances(const Mesh&) {
  return as_conductance(boost::make_function_property_map<Edge<Mesh>>([](const Edge<Mesh>&) { return 1.; }));
}

template <class Mesh>
Conductance<Mesh> dihedral_conductances(const Mesh& mesh, double sigma = 1, double cap = 20) {
  return Conductance<Mesh>(mesh, Dihedral_difference<Mesh>(mesh), sigma, cap);
}

template <class Mesh, class ConductanceMap>
networks::Network network_of(const Mesh& mesh, const ConductanceMap& conductance) {
  const meshes::Mesh_graph<Mesh> graph(mesh);
  networks::Network network{graph, {}};
  for (const auto& e : graph.edge_descriptors()) network.conductances.push_back(get(conductance, e));
  return network;
}

/// The largest relative error of the probabilities of a walk with the given seeds, labels 0, 1, ..., against a dense
/// solve with 500 digits. Probabilities below 1e-290 are left out: a double cannot tell them.
template <class Solver, class Mesh, class ConductanceMap>
double largest_relative_error(const Mesh& mesh, const ConductanceMap& conductance, Solver solver,
                              const std::vector<networks::Index>& seeds) {
  using Exact = boost::multiprecision::mpfr_float_500;
  const auto exact = networks::dense_potentials<Exact>(network_of(mesh, conductance), seeds);
  const auto face = faces_of(mesh);
  Random_walk walk(mesh, conductance, std::move(solver));
  for (std::size_t l = 0; l < seeds.size(); ++l) walk.add_seed(face[seeds[l]], l);
  double largest = 0;
  for (std::size_t f = 0; f < face.size(); ++f)
    for (std::size_t l = 0; l < seeds.size(); ++l)
      if (exact[f][l] > 1e-290) {
        const double error = static_cast<double>(walk.probability(face[f], l) / exact[f][l] - 1);
        largest = std::max(largest, std::abs(error));
      }
  return largest;
}

/// The message of the exception that `action` must throw.
template <class Exception, class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "no exception of the expected type";
  return {};
}

void expect_named(const std::string& message, const std::string& name) {
  EXPECT_NE(message.find(name), std::string::npos) << "does not name " << name << ": " << message;
}

/// Two triangles in the order of a strip that share `n` - 1 edges: a row of `n` triangles along the x-axis.
Shape strip(std::size_t n) {
  Shape shape;
  for (std::size_t i = 0; i < n + 2; ++i) shape.points.emplace_back(static_cast<double>(i) / 2, i % 2, 0);
  for (std::size_t i = 0; i < n; ++i)
    shape.faces.push_back(i % 2 ? std::vector<std::size_t>{i + 1, i, i + 2}
                                : std::vector<std::size_t>{i, i + 1, i + 2});
  for (auto& face : shape.faces) std::swap(face[0], face[1]);
  return shape;
}

/// All faces of the shape with corners of their own, as in an STL file.
Shape soup(const Shape& shape) {
  Shape result;
  for (const auto& face : shape.faces) {
    result.faces.emplace_back();
    for (const std::size_t corner : face) {
      result.faces.back().push_back(result.points.size());
      result.points.push_back(shape.points[corner]);
    }
  }
  return result;
}

/// The surface seen from the other side.
Shape inside_out(Shape shape) {
  for (auto& face : shape.faces) std::reverse(face.begin(), face.end());
  return shape;
}

template <class Holder>
class MeshPathologies : public testing::Test {};
TYPED_TEST_SUITE(MeshPathologies, meshes::Holders);

}  // namespace

// ---- Few faces, few seeds ----

TYPED_TEST(MeshPathologies, EmptyMeshHasNoSegments) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held((Shape()));
  Written<Mesh> labels;
  const auto conductance = dihedral_conductances(held.mesh);
  EXPECT_EQ(segmentation_from_seeds(held.mesh, conductance, std::vector<Face<Mesh>>(), labels.map()), 0u);
  Random_walk walk(held.mesh, conductance);
  EXPECT_EQ(walk.segment(labels.map()), 0u);
  EXPECT_EQ(walk.write_raw_labels(labels.map()), 0u);
  EXPECT_TRUE(labels.nothing());
  std::map<Face<Mesh>, double> probabilities;
  walk.write_probabilities(0, boost::associative_property_map<decltype(probabilities)>(probabilities));
  EXPECT_TRUE(probabilities.empty());
}

TYPED_TEST(MeshPathologies, SingleFaceTakesTheLabelOfItsSeed) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held(strip(1));
  const auto face = faces_of(held.mesh);
  Written<Mesh> labels;
  Random_walk walk(held.mesh, dihedral_conductances(held.mesh));
  walk.add_seed(face[0], 7);
  EXPECT_EQ(walk.segment(labels.map()), 1u);
  EXPECT_EQ(labels[face[0]], 7u);
  EXPECT_EQ(walk.probability(face[0], 7), 1);
}

TEST(Pathologies, NoSeedsIsAnErrorThatLeavesOutputsUntouched) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::cube(2));
  Written<Surface_mesh> labels;
  const auto conductance = equal_conductances(mesh);
  Random_walk walk(mesh, conductance);
  expect_named(message_of<std::invalid_argument>([&] { walk.segment(labels.map()); }), "no seeds");
  EXPECT_THROW(walk.probability(*faces(mesh).begin(), 0), std::invalid_argument);
  const std::vector<Face<Surface_mesh>> none;
  expect_named(
      message_of<std::invalid_argument>([&] { segmentation_from_seeds(mesh, conductance, none, labels.map()); }),
      "no seeds");
  EXPECT_TRUE(labels.nothing());
}

TYPED_TEST(MeshPathologies, SingleLabelTakesAllFacesItReachesWithoutASolve) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held(meshes::together(meshes::cube(), meshes::moved(meshes::cube(), {5, 0, 0})));
  const auto face = faces_of(held.mesh);
  Written<Mesh> labels;
  Random_walk walk(held.mesh, dihedral_conductances(held.mesh));
  walk.add_seed(face[3], 4);
  walk.add_seed(face[5], 4);
  EXPECT_EQ(walk.segment(labels.map()), 2u);
  for (std::size_t f = 0; f < 24; ++f) {
    EXPECT_EQ(labels[face[f]], f < 12 ? 4u : 5u);
    EXPECT_EQ(walk.probability(face[f], 4), f < 12 ? 1 : 0);
  }
  EXPECT_EQ(walk.report().factorisations, 0u);
}

TEST(Pathologies, AllFacesAsSeedsKeepTheirLabels) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::cube());
  for_each_solver([&](auto solver) {
    Written<Surface_mesh> labels;
    Random_walk walk(mesh, dihedral_conductances(mesh), std::move(solver));
    std::size_t label = 0;
    for (const auto f : faces(mesh)) walk.add_seed(f, 3 * (label++ / 2));
    EXPECT_EQ(walk.segment(labels.map()), 6u);
    for (const auto& [f, l] : walk.seeds()) EXPECT_EQ(labels[f], l);
    EXPECT_EQ(walk.probability(*faces(mesh).begin(), 0), 1);
    EXPECT_EQ(walk.probability(*faces(mesh).begin(), 3), 0);
  });
}

TYPED_TEST(MeshPathologies, SameSeedTwiceWithTheSameLabelIsOneSeed) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held(meshes::cube(2));
  const auto face = faces_of(held.mesh);
  Written<Mesh> once, twice;
  const auto conductance = dihedral_conductances(held.mesh);
  using Seeds = std::vector<std::pair<Face<Mesh>, std::size_t>>;
  segmentation_from_seeds(held.mesh, conductance, Seeds{{face[0], 2}, {face[30], 6}}, once.map());
  EXPECT_EQ(
      segmentation_from_seeds(held.mesh, conductance, Seeds{{face[0], 2}, {face[30], 6}, {face[0], 2}}, twice.map()),
      2u);
  EXPECT_EQ(once.in_order_of(held.mesh), twice.in_order_of(held.mesh));
  Random_walk walk(held.mesh, conductance);
  walk.add_seed(face[0], 2);
  walk.add_seed(face[0], 2);
  EXPECT_EQ(walk.seeds().size(), 1u);
}

TYPED_TEST(MeshPathologies, FaceWithTwoLabelsIsAnErrorOfTheFunctionAndTheLastOneWinsInTheObject) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held(meshes::cube(2));
  const auto face = faces_of(held.mesh);
  Written<Mesh> labels;
  const auto conductance = dihedral_conductances(held.mesh);
  const std::vector<std::pair<Face<Mesh>, std::size_t>> seeds = {{face[0], 2}, {face[30], 6}, {face[0], 6}};
  expect_named(
      message_of<std::invalid_argument>([&] { segmentation_from_seeds(held.mesh, conductance, seeds, labels.map()); }),
      "seed 2");
  const std::vector<Face<Mesh>> faces_twice = {face[0], face[30], face[0]};  // their places are their labels
  EXPECT_THROW(segmentation_from_seeds(held.mesh, conductance, faces_twice, labels.map()), std::invalid_argument);
  EXPECT_TRUE(labels.nothing());

  Random_walk walk(held.mesh, conductance);
  for (const auto& [f, label] : seeds) walk.add_seed(f, label);
  EXPECT_EQ(walk.seeds().size(), 2u);
  EXPECT_EQ(walk.label_of_seed(face[0]), 6u);
  EXPECT_EQ(walk.segment(labels.map()), 1u);
}

// ---- Seeds that are no faces ----

TYPED_TEST(MeshPathologies, SeedThatIsNoFaceIsAnErrorThatNamesTheSeed) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held(meshes::cube());
  const auto face = faces_of(held.mesh);
  const auto null_face = boost::graph_traits<Mesh>::null_face();
  Written<Mesh> labels;
  const auto conductance = equal_conductances(held.mesh);
  Random_walk walk(held.mesh, conductance);
  EXPECT_THROW(walk.add_seed(null_face, 0), std::invalid_argument);
  EXPECT_THROW(walk.remove_seed(null_face), std::invalid_argument);
  EXPECT_TRUE(walk.seeds().empty());
  const std::vector<Face<Mesh>> seeds = {face[0], null_face};
  expect_named(
      message_of<std::invalid_argument>([&] { segmentation_from_seeds(held.mesh, conductance, seeds, labels.map()); }),
      "seed 1");
  EXPECT_TRUE(labels.nothing());
}

TEST(Pathologies, FaceOfAnotherMeshIsNoSeed) {
  const Surface_mesh small = meshes::surface_mesh(meshes::cube()), large = meshes::surface_mesh(meshes::cube(2));
  Random_walk walk(small, equal_conductances(small));
  EXPECT_THROW(walk.add_seed(faces_of(large).back(), 0), std::invalid_argument);
  const auto one = meshes::Plain<meshes::Polyhedron>(meshes::cube()),
             other = meshes::Plain<meshes::Polyhedron>(meshes::cube());
  Random_walk walk_on_one(one.mesh, equal_conductances(one.mesh));
  EXPECT_THROW(walk_on_one.add_seed(faces_of(other.mesh).front(), 0), std::invalid_argument);
}

TEST(Pathologies, RemovedOrHiddenFaceIsNoSeed) {
  Surface_mesh mesh = meshes::surface_mesh(meshes::plane(3));
  const auto removed = faces_of(mesh)[4];
  CGAL::Euler::remove_face(halfedge(removed, mesh), mesh);
  Random_walk walk(mesh, equal_conductances(mesh));
  EXPECT_THROW(walk.add_seed(removed, 0), std::invalid_argument);

  const meshes::Filtered held(meshes::cube());
  Random_walk on_part(held.mesh, equal_conductances(held.mesh));
  EXPECT_THROW(on_part.add_seed(faces_of(held.whole).back(), 0), std::invalid_argument);
}

TEST(Pathologies, RemovedFacesLeaveGapsThatAreNotWritten) {
  Surface_mesh mesh = meshes::surface_mesh(meshes::plane(6));
  const auto all = faces_of(mesh);
  std::set<Face<Surface_mesh>> removed = {all[0], all[17], all[18], all[71]};
  for (const auto f : removed) CGAL::Euler::remove_face(halfedge(f, mesh), mesh);
  auto ids = mesh.add_property_map<Surface_mesh::Face_index, std::size_t>("f:id", 99).first;
  const std::vector<Face<Surface_mesh>> seeds = {all[5], all[60]};
  EXPECT_EQ(segmentation_from_seeds(mesh, dihedral_conductances(mesh), seeds, ids), 2u);
  for (const auto f : all) {
    if (removed.count(f)) {
      EXPECT_EQ(ids[f], 99u);
    } else {
      EXPECT_LE(ids[f], 1u);
    }
  }
}

TEST(Pathologies, IdsStoredInAPolyhedronAreNotUsed) {
  using With_ids = CGAL::Polyhedron_3<meshes::Kernel, CGAL::Polyhedron_items_with_id_3>;
  const Shape shape = meshes::with_noise(meshes::sphere(2), 0.02);
  meshes::Plain<With_ids> wrong_ids(shape);
  for (auto f = wrong_ids.mesh.facets_begin(); f != wrong_ids.mesh.facets_end(); ++f) f->id() = 7;
  const meshes::Plain<meshes::Polyhedron> no_ids(shape);
  const auto labels_of = [](const auto& mesh) {
    Written<std::decay_t<decltype(mesh)>> labels;
    const auto face = faces_of(mesh);
    const std::vector seeds = {face[0], face[100], face[200]};
    segmentation_from_seeds(mesh, dihedral_conductances(mesh), seeds, labels.map());
    return labels.in_order_of(mesh);
  };
  const auto expected = labels_of(meshes::surface_mesh(shape));
  EXPECT_EQ(labels_of(wrong_ids.mesh), expected);
  EXPECT_EQ(labels_of(no_ids.mesh), expected);
}

// ---- Degenerate elements ----

TYPED_TEST(MeshPathologies, FaceWithoutAreaIsTransparent) {
  using Mesh = typename TypeParam::Mesh;
  // Below the segment from (0, 0) to (2, 0) one triangle, above it two that lean back; between them one without area.
  Shape shape;
  shape.points = {{0, 0, 0}, {1, -1, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 1}};
  shape.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {3, 2, 4}};
  const TypeParam held(shape);
  const auto face = faces_of(held.mesh);
  const Dihedral_difference<Mesh> difference(held.mesh);
  for (const auto e : edges(held.mesh)) EXPECT_TRUE(std::isfinite(get(difference, e)));
  const meshes::Mesh_graph<Mesh> graph(held.mesh);
  for (const auto& [next, edge] : graph.neighbours(1)) EXPECT_EQ(get(difference, graph.edge(edge)), 0) << next;
  EXPECT_EQ(Dual_mesh_of<Mesh>(held.mesh).number_of_degenerate_faces(), 1u);

  // It keeps its neighbours: with seeds below and above, walks cross it both ways.
  EXPECT_LE(largest_relative_error(held.mesh, dihedral_conductances(held.mesh), Star_mesh_elimination(), {0, 2}),
            1e-12);
  Random_walk walk(held.mesh, dihedral_conductances(held.mesh));
  walk.add_seed(face[0], 0);
  walk.add_seed(face[2], 1);
  EXPECT_GT(walk.probability(face[1], 0), 0.1);
  EXPECT_GT(walk.probability(face[1], 1), 0.1);
}

TYPED_TEST(MeshPathologies, EdgeWithoutLengthDoesNotCutTheGraph) {
  using Mesh = typename TypeParam::Mesh;
  // Two trapezoids that touch in the point (0, 0), which is an edge of both.
  Shape shape;
  shape.points = {{-1, -1, 0}, {0, 0, 0}, {0, 0, 0}, {-1, 1, 0}, {1, -1, 0.3}, {1, 1, 0.3}};
  shape.faces = {{0, 1, 2, 3}, {2, 1, 4, 5}};
  const TypeParam held(shape);
  const auto face = faces_of(held.mesh);
  const auto conductance = dihedral_conductances(held.mesh);
  const meshes::Mesh_graph<Mesh> graph(held.mesh);
  ASSERT_EQ(graph.number_of_edges(), 1u);
  EXPECT_GT(get(conductance, graph.edge(0)), 0);
  Written<Mesh> labels;
  EXPECT_EQ(segmentation_from_seeds(held.mesh, conductance, std::vector<Face<Mesh>>{face[0]}, labels.map()), 1u);
}

TEST(Pathologies, TriangleSoupHasASegmentForEachFace) {
  const Surface_mesh mesh = meshes::surface_mesh(soup(meshes::cube()));
  Written<Surface_mesh> labels;
  Random_walk walk(mesh, dihedral_conductances(mesh));
  walk.add_seed(faces_of(mesh)[4], 3);
  EXPECT_EQ(walk.segment(labels.map()), 12u);
  EXPECT_EQ(walk.report().unseeded_components, 11u);
  const auto ids = labels.in_order_of(mesh);
  EXPECT_EQ(ids, (std::vector<std::size_t>{4, 5, 6, 7, 3, 8, 9, 10, 11, 12, 13, 14}));
}

TEST(Pathologies, IsolatedVerticesAreIgnored) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::l_shape(2));
  Surface_mesh with_vertices = mesh;
  with_vertices.add_vertex({1e30, -1e30, 5});
  with_vertices.add_vertex({not_a_number, infinity, 0});
  const auto expected = dihedral_conductances(mesh), found = dihedral_conductances(with_vertices);
  for (const auto e : edges(mesh)) EXPECT_EQ(get(found, e), get(expected, e));
}

TYPED_TEST(MeshPathologies, PinchedVertexJoinsNothing) {
  using Mesh = typename TypeParam::Mesh;
  // Two squares that touch in a corner.
  Shape shape;
  shape.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  shape.faces = {{0, 1, 2}, {0, 2, 3}, {2, 4, 5}, {2, 5, 6}};
  const TypeParam held(shape);
  Written<Mesh> labels;
  Random_walk walk(held.mesh, dihedral_conductances(held.mesh));
  walk.add_seed(faces_of(held.mesh)[0], 0);
  EXPECT_EQ(walk.segment(labels.map()), 2u);
  EXPECT_EQ(labels.in_order_of(held.mesh), (std::vector<std::size_t>{0, 0, 1, 1}));
}

TYPED_TEST(MeshPathologies, InsideOutMeshHasConvexAndConcaveSwapped) {
  using Mesh = typename TypeParam::Mesh;
  const Shape shape = meshes::l_shape();
  const TypeParam held(shape), reversed(inside_out(shape));
  const Dihedral_difference<Mesh> difference(held.mesh, 0), swapped(reversed.mesh, 0);
  std::size_t concave = 0, convex = 0;
  for (const auto e : edges(held.mesh)) concave += get(difference, e) > 0;
  for (const auto e : edges(reversed.mesh)) convex += get(swapped, e) > 0;
  EXPECT_EQ(concave, 1u);  // at x = y = 1; all other creases of the L are convex
  EXPECT_EQ(convex, 21u);
}

// ---- Components and borders ----

TYPED_TEST(MeshPathologies, BorderEdgeLeadsNowhere) {
  const TypeParam held(meshes::with_noise(meshes::plane(4), 0.02));
  const auto conductance = dihedral_conductances(held.mesh);
  const networks::Network network = network_of(held.mesh, conductance);
  const auto face = faces_of(held.mesh);
  Random_walk walk(held.mesh, conductance);
  const std::size_t a = 3, b = 28;
  walk.add_seed(face[a], 0);
  walk.add_seed(face[b], 1);
  std::size_t border_faces = 0;
  for (std::size_t f = 0; f < face.size(); ++f) {
    const auto neighbours = network.graph.neighbours(static_cast<networks::Index>(f));
    border_faces += neighbours.size() < 3;
    if (f == a || f == b) continue;
    double sum = 0, total = 0;
    for (const auto& [next, edge] : neighbours) {
      sum += network.conductances[edge] * walk.probability(face[next], 0);
      total += network.conductances[edge];
    }
    EXPECT_NEAR(walk.probability(face[f], 0), sum / total, 1e-12);
    EXPECT_NEAR(walk.probability(face[f], 0) + walk.probability(face[f], 1), 1, 1e-12);
  }
  EXPECT_EQ(border_faces, 14u);
}

TYPED_TEST(MeshPathologies, IsolatedFaceIsASegmentOfItsOwn) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held(meshes::together(meshes::moved(strip(1), {0, 0, 9}), meshes::cube()));
  const auto face = faces_of(held.mesh);
  Written<Mesh> labels;
  const std::vector<Face<Mesh>> seeds = {face[3], face[10]};
  EXPECT_EQ(segmentation_from_seeds(held.mesh, dihedral_conductances(held.mesh), seeds, labels.map()), 3u);
  EXPECT_EQ(labels[face[0]], 2u);
}

TYPED_TEST(MeshPathologies, ComponentsWithoutASeedFollowTheSeededSegments) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held(meshes::together(meshes::together(meshes::cube(), meshes::moved(meshes::cube(), {3, 0, 0})),
                                        meshes::moved(strip(5), {0, 0, 9})));
  const auto face = faces_of(held.mesh);
  Written<Mesh> labels;
  const std::vector<std::pair<Face<Mesh>, std::size_t>> seeds = {{face[14], 9}, {face[20], 4}};
  EXPECT_EQ(segmentation_from_seeds(held.mesh, dihedral_conductances(held.mesh), seeds, labels.map()), 4u);
  EXPECT_EQ(labels[face[14]], 1u);
  EXPECT_EQ(labels[face[20]], 0u);
  for (std::size_t f = 0; f < 12; ++f) EXPECT_EQ(labels[face[f]], 2u);
  for (std::size_t f = 24; f < 29; ++f) EXPECT_EQ(labels[face[f]], 3u);
}

TEST(Pathologies, ComponentsWithoutASeedNeverTakeALabelInUse) {
  const Surface_mesh mesh = meshes::surface_mesh(soup(strip(5)));
  const auto face = faces_of(mesh);
  Written<Surface_mesh> labels;
  Random_walk walk(mesh, equal_conductances(mesh));
  walk.add_seed(face[0], std::numeric_limits<std::size_t>::max() - 1);
  walk.add_seed(face[1], 0);
  EXPECT_EQ(walk.segment(labels.map()), 5u);
  EXPECT_EQ(labels[face[0]], std::numeric_limits<std::size_t>::max() - 1);
  EXPECT_EQ(labels[face[1]], 0u);
  walk.add_seed(face[2], std::numeric_limits<std::size_t>::max());
  EXPECT_EQ(walk.segment(labels.map()), 5u);
  EXPECT_EQ(labels[face[2]], std::numeric_limits<std::size_t>::max());
  EXPECT_EQ(std::set<std::size_t>({labels[face[3]], labels[face[4]]}), std::set<std::size_t>({1, 2}));
}

TEST(Pathologies, SelfIntersectionJoinsNothing) {
  const Surface_mesh mesh =
      meshes::surface_mesh(meshes::together(meshes::cube(3), meshes::moved(meshes::cube(3), {0.5, 0.4, 0.3})));
  const auto face = faces_of(mesh);
  Written<Surface_mesh> labels;
  const std::vector<Face<Surface_mesh>> seeds = {face[0], face[90]};
  EXPECT_EQ(segmentation_from_seeds(mesh, dihedral_conductances(mesh), seeds, labels.map()), 3u);
  for (std::size_t f = 0; f < face.size(); ++f) EXPECT_EQ(labels[face[f]] == 2, f >= 108);
}

// ---- Flat, folded and extreme shapes ----

TYPED_TEST(MeshPathologies, FlatMeshHasNoDifferences) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held(meshes::plane(4));
  for (const auto measure : {Dihedral_measure::one_minus_cosine, Dihedral_measure::angle}) {
    const Dihedral_difference<Mesh> difference(held.mesh, 0.2, measure);
    for (const auto e : edges(held.mesh)) EXPECT_EQ(get(difference, e), 0);
  }
}

TEST(Pathologies, RoundingOfAFlatMeshIsNoDifference) {
  for (const double far : {0., 1e3, 1e6}) {
    const Shape flat = meshes::transformed(meshes::plane(7), meshes::some_rotation());
    const Surface_mesh mesh = meshes::surface_mesh(meshes::moved(flat, {far, -far, far}));
    for (const auto measure : {Dihedral_measure::one_minus_cosine, Dihedral_measure::angle}) {
      const Dihedral_difference<Surface_mesh> difference(mesh, 0.2, measure);
      for (const auto e : edges(mesh)) EXPECT_EQ(get(difference, e), 0) << "moved by " << far;
    }
  }
  // Bumps of a ten-thousandth of an edge are shape.
  const Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::plane(7), 1e-5));
  const Dihedral_difference<Surface_mesh> difference(mesh);
  std::size_t different = 0;
  for (const auto e : edges(mesh)) different += get(difference, e) > 0;
  EXPECT_GT(different, 50u);
}

TEST(Pathologies, ExtremeCreaseIsCappedOrSolvedExactlyOrRefused) {
  // Both seeds lie on one side of a crease over which hardly any walk goes.
  const Surface_mesh mesh = meshes::surface_mesh(meshes::folded_strip(-2, 3));
  const std::vector<networks::Index> seeds = {0, 60};
  const auto face = faces_of(mesh);
  const auto capped = dihedral_conductances(mesh, 0.01), uncapped = dihedral_conductances(mesh, 0.01, infinity);
  const auto least = [&](const auto& conductance) {
    const auto network = network_of(mesh, conductance);
    return *std::min_element(network.conductances.begin(), network.conductances.end());
  };
  EXPECT_LT(least(uncapped), 1e-200);
  EXPECT_GT(least(uncapped), 0);
  EXPECT_GT(least(capped), 1e-12);

  EXPECT_LE(largest_relative_error(mesh, capped, Star_mesh_elimination(), seeds), 1e-12);
  EXPECT_LE(largest_relative_error(mesh, uncapped, Star_mesh_elimination(), seeds), 1e-12);
  const auto refuses = [&](auto solver) {
    Written<Surface_mesh> labels;
    Random_walk walk(mesh, uncapped, std::move(solver));
    for (std::size_t l = 0; l < seeds.size(); ++l) walk.add_seed(face[seeds[l]], l);
    EXPECT_THROW(walk.segment(labels.map()), std::runtime_error);
    EXPECT_TRUE(labels.nothing());
  };
  refuses(Cholesky());
  refuses(Conjugate_gradient());
#ifdef RW_SEGMENTATION_WITH_CHOLMOD
  refuses(Eigen_walk_solver<Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower>>());
#endif
}

TEST(Pathologies, NumberOutOfRangeIsAnErrorThatNamesIt) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::cube());
  const Dihedral_difference<Surface_mesh> difference(mesh);
  using Invalid = std::invalid_argument;
  for (const double sigma : {0., -1., not_a_number, infinity})
    expect_named(message_of<Invalid>([&] { Conductance<Surface_mesh>(mesh, difference, sigma); }), "sigma");
  for (const double cap : {0., -1., not_a_number})
    expect_named(message_of<Invalid>([&] { Conductance<Surface_mesh>(mesh, difference, 1, cap); }), "cap");
  for (const double weight : {-0.1, 1.1, not_a_number, infinity})
    expect_named(message_of<Invalid>([&] { Dihedral_difference<Surface_mesh>(mesh, weight); }), "convex_weight");
  std::map<Face<Surface_mesh>, meshes::Kernel::Vector_3> normals;
  const boost::associative_property_map<decltype(normals)> normal_map(normals);
  for (const double radius : {-0.1, not_a_number, infinity})
    expect_named(message_of<Invalid>([&] { smoothed_face_normals(mesh, normal_map, Normal_smoothing{radius}); }),
                 "radius");
  EXPECT_TRUE(normals.empty());

  for (const double value : {-1., not_a_number}) {
    const auto map =
        boost::make_function_property_map<Edge<Surface_mesh>>([value](const Edge<Surface_mesh>&) { return value; });
    expect_named(message_of<Invalid>([&] { Conductance<Surface_mesh>(mesh, map); }), "difference");
    expect_named(message_of<Invalid>([&] { Random_walk(mesh, as_conductance(map)); }), "conductance");
  }
  const auto infinite =
      boost::make_function_property_map<Edge<Surface_mesh>>([](const Edge<Surface_mesh>&) { return infinity; });
  expect_named(message_of<Invalid>([&] { Random_walk(mesh, as_conductance(infinite)); }), "conductance");
  EXPECT_NO_THROW(Conductance<Surface_mesh>(mesh, infinite));
}

TYPED_TEST(MeshPathologies, CoordinateThatIsNotFiniteIsAnErrorThatNamesTheVertex) {
  using Mesh = typename TypeParam::Mesh;
  for (const double bad : {not_a_number, infinity, -infinity}) {
    Shape shape = meshes::cube(2);
    shape.points[13].y() = bad;
    const TypeParam held(shape);
    expect_named(message_of<std::invalid_argument>([&] { Dihedral_difference<Mesh>(held.mesh); }), "vertex 13");
    expect_named(
        message_of<std::invalid_argument>([&] { Conductance<Mesh>(held.mesh, equal_conductances(held.mesh)); }),
        "vertex 13");
  }
}

TEST(Pathologies, HugeAndTinyCoordinatesGiveTheSameSegments) {
  const Shape shape = meshes::with_noise(meshes::l_shape(4), 0.01);
  const auto segment = [](const Shape& s) {
    const Surface_mesh mesh = meshes::surface_mesh(s);
    const auto face = faces_of(mesh);
    Written<Surface_mesh> labels;
    const std::vector<Face<Surface_mesh>> seeds = {face[10], face[200], face[400]};
    segmentation_from_seeds(mesh, dihedral_conductances(mesh), seeds, labels.map());
    return labels.in_order_of(mesh);
  };
  const auto expected = segment(shape);
  for (const double scale : {1e150, 1e300, 8e307, 1e-160, 1e-290})
    EXPECT_EQ(segment(meshes::scaled(shape, scale)), expected) << "scaled by " << scale;
}

TEST(Pathologies, MeshFarFromTheOriginHasTheDifferencesOfTheSameMeshAtIt) {
  const Shape shape = meshes::transformed(meshes::l_shape(3), meshes::some_rotation());
  const Surface_mesh near = meshes::surface_mesh(shape),
                     far = meshes::surface_mesh(meshes::moved(shape, {1e8, -2e8, 3e8}));
  const Dihedral_difference<Surface_mesh> expected(near), found(far);
  for (const auto e : edges(near)) EXPECT_NEAR(get(found, e), get(expected, e), 1e-4);
}

TEST(Pathologies, NeedlesAreSolvedExactlyOrRefused) {
  const Eigen::Affine3d stretch(Eigen::AlignedScaling3d(1e8, 1, 1));
  Shape shape = meshes::with_noise(meshes::plane(6), 0.02);
  for (std::size_t p = 0; p < shape.points.size(); ++p)
    if (p % 3 == 0) shape.points[p] = stretch * shape.points[p];
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  const std::vector<networks::Index> seeds = {0, 40, 70};
  const auto conductance = dihedral_conductances(mesh, 1, infinity);
  EXPECT_LE(largest_relative_error(mesh, conductance, Star_mesh_elimination(), seeds), 1e-12);

  const auto face = faces_of(mesh);
  Random_walk right(mesh, conductance);
  for (std::size_t l = 0; l < seeds.size(); ++l) right.add_seed(face[seeds[l]], l);
  const auto refuses_or_is_right = [&](auto solver) {
    Random_walk walk(mesh, conductance, std::move(solver));
    for (std::size_t l = 0; l < seeds.size(); ++l) walk.add_seed(face[seeds[l]], l);
    try {
      for (const auto f : face) EXPECT_NEAR(walk.probability(f, 1), right.probability(f, 1), 1e-5);
    } catch (const std::runtime_error&) {
    }
  };
  refuses_or_is_right(Cholesky());
  refuses_or_is_right(Conjugate_gradient());
}

TEST(Pathologies, FaceOfNearlyTheWholeAreaIsAFaceLikeOthers) {
  // A triangle of side 100 whose border is continued by a strip of small ones.
  Shape shape;
  shape.points = {{0, -90, 0}, {-50, 0, 0}, {50, 0, 0}};
  shape.faces = {{0, 2, 1}};
  const Shape small = meshes::moved(meshes::with_noise(meshes::plane(3), 0.05), {-0.5, 0, 0});
  const std::size_t first = shape.points.size();
  shape = meshes::together(shape, small);
  shape.faces.push_back({1, 2, first + 1});  // joins the large triangle to a bottom edge of the small ones
  shape.faces.push_back({2, first + 2, first + 1});
  const Surface_mesh mesh = meshes::surface_mesh(shape);
  EXPECT_LE(largest_relative_error(mesh, dihedral_conductances(mesh), Star_mesh_elimination(), {0, 18}), 1e-12);
}

TYPED_TEST(MeshPathologies, FacesMayHaveAnyDegree) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held(meshes::cube_of_quads());
  const auto face = faces_of(held.mesh);
  Random_walk walk(held.mesh, dihedral_conductances(held.mesh));
  walk.add_seed(face[0], 0);
  walk.add_seed(face[1], 1);
  for (std::size_t f = 2; f < 6; ++f) EXPECT_NEAR(walk.probability(face[f], 0), 0.5, 1e-12);

  // A prism over a hexagon: two hexagons and six squares.
  Shape prism;
  for (const double z : {0., 1.})
    for (int k = 0; k < 6; ++k)
      prism.points.emplace_back(std::cos(k * meshes::pi / 3), std::sin(k * meshes::pi / 3), z);
  prism.faces = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (std::size_t k = 0; k < 6; ++k) prism.faces.push_back({k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k});
  const TypeParam of_hexagons(prism);
  EXPECT_LE(largest_relative_error(of_hexagons.mesh, dihedral_conductances(of_hexagons.mesh), Star_mesh_elimination(),
                                   {0, 1, 4}),
            1e-12);
  Written<Mesh> labels;
  EXPECT_EQ(segmentation_from_seeds(of_hexagons.mesh, dihedral_conductances(of_hexagons.mesh),
                                    faces_of(of_hexagons.mesh), labels.map()),
            8u);
}

TYPED_TEST(MeshPathologies, SeveralEdgesBetweenTwoFacesAddUp) {
  using Mesh = typename TypeParam::Mesh;
  // The quadrilaterals 0 and 1 share two edges, which meet in (1, 0); the triangle 2 lies beside 1.
  Shape shape;
  shape.points = {{0, 0, 0}, {1, 0, 0}, {2, 0.5, 0}, {1, -1, 0}, {1, 1, 0}, {0, 1, 0}};
  shape.faces = {{0, 3, 2, 1}, {0, 1, 2, 4}, {0, 4, 5}};
  const TypeParam held(shape);
  const auto face = faces_of(held.mesh);
  const meshes::Mesh_graph<Mesh> graph(held.mesh);
  ASSERT_EQ(graph.number_of_edges(), 3u);
  Random_walk walk(held.mesh, equal_conductances(held.mesh));
  walk.add_seed(face[0], 0);
  walk.add_seed(face[2], 1);
  EXPECT_NEAR(walk.probability(face[1], 0), 2. / 3, 1e-12);
}

TEST(Pathologies, PillowOfTwoFacesIsSegmented) {
  Shape pillow;
  pillow.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  pillow.faces = {{0, 1, 2}, {2, 1, 0}};
  const Surface_mesh mesh = meshes::surface_mesh(pillow);
  const auto face = faces_of(mesh);
  const auto conductance = dihedral_conductances(mesh);
  Written<Surface_mesh> labels;
  EXPECT_EQ(segmentation_from_seeds(mesh, conductance, face, labels.map()), 2u);
  EXPECT_EQ(segmentation_from_seeds(mesh, conductance, std::vector<Face<Surface_mesh>>{face[1]}, labels.map()), 1u);
  for (const auto e : edges(mesh)) EXPECT_TRUE(std::isfinite(get(conductance, e)) && get(conductance, e) > 0);
}

TEST(Pathologies, FacesFoldedOntoEachOtherDifferByAFixedRule) {
  // A ridge, continued by a triangle that is folded back exactly onto its neighbour: neither convex nor concave.
  Shape shape;
  shape.points = {{0, 0, 0}, {1, 0, 0}, {0.4, 0.9, 0}, {0.3, -0.8, -0.5}, {0.9, 0.8, 0}};
  shape.faces = {{0, 1, 2}, {1, 0, 3}, {2, 1, 4}};
  for (const std::size_t apex : {std::size_t(0), std::size_t(4)}) {
    Shape folded = shape;
    folded.points[4] = apex == 0 ? shape.points[0] : Eigen::Vector3d(0.5, 0.3, 0);  // onto all of it or a part
    std::vector<double> found;
    for (int k = 0; k < 20; ++k) {
      const Eigen::AngleAxisd turn(k * 0.37, Eigen::Vector3d(1, k, 2 - k).normalized());
      Shape turned = meshes::transformed(folded, Eigen::Affine3d(turn));
      const Surface_mesh mesh = meshes::surface_mesh(turned);
      const meshes::Mesh_graph<Surface_mesh> graph(mesh);
      const Dihedral_difference<Surface_mesh> difference(mesh);
      for (std::size_t e = 0; e < 2; ++e) {
        const auto [f, g] = graph.faces_of(static_cast<Dual_graph::Index>(e));
        if (f + g == 2) found.push_back(get(difference, graph.edge(static_cast<Dual_graph::Index>(e))));
      }
    }
    ASSERT_EQ(found.size(), 20u);
    for (const double d : found) ASSERT_NEAR(d, found.front(), 1e-9);
  }
}

// ---- Answers ----

TEST(Pathologies, TiesGoToTheLowestLabel) {
  const Surface_mesh mesh = meshes::surface_mesh(strip(3));
  const auto face = faces_of(mesh);
  for_each_solver([&](auto solver) {
    Random_walk walk(mesh, equal_conductances(mesh), std::move(solver));
    Written<Surface_mesh> labels;
    walk.add_seed(face[2], 8);
    walk.add_seed(face[0], 5);
    walk.segment(labels.map());
    EXPECT_EQ(labels[face[1]], 5u);
    walk.add_seed(face[0], 9);  // the other one has the lowest label now
    walk.segment(labels.map());
    EXPECT_EQ(labels[face[1]], 8u);
    walk.remove_seed(face[0]);  // an answer from columns
    walk.add_seed(face[0], 2);
    walk.segment(labels.map());
    EXPECT_EQ(labels[face[1]], 2u);
  });
}

TEST(Pathologies, ProbabilitiesLieBetweenZeroAndOneAndAddUpToOne) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::torus(2, 0.6, 30, 15), 0.05));
  const auto face = faces_of(mesh);
  const auto check = [&](auto solver, double cap, double accepted_error) {
    Random_walk walk(mesh, dihedral_conductances(mesh, 1, cap), std::move(solver));
    for (std::size_t s = 0; s < 50; ++s) walk.add_seed(face[17 * s], s % 5);
    for (const auto f : face) {
      double sum = 0;
      for (std::size_t l = 0; l < 5; ++l) {
        const double p = walk.probability(f, l);
        EXPECT_GE(p, 0);
        EXPECT_LE(p, 1);
        sum += p;
      }
      EXPECT_NEAR(sum, 1, accepted_error);
    }
  };
  check(Star_mesh_elimination(), infinity, 1e-13);
  for_each_solver([&](auto solver) { check(std::move(solver), 20, 1e-9); });
}

TEST(Pathologies, SolverThatDoesNotConvergeSaysSo) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::sphere(3), 0.02));
  const auto face = faces_of(mesh);
  Conjugate_gradient impatient;
  impatient.eigen_solver().setMaxIterations(3);
  Written<Surface_mesh> labels;
  Random_walk walk(mesh, dihedral_conductances(mesh), std::move(impatient));
  walk.add_seed(face[0], 0);
  walk.add_seed(face[500], 1);
  expect_named(message_of<std::runtime_error>([&] { walk.segment(labels.map()); }), "converge");
  EXPECT_TRUE(labels.nothing());
  EXPECT_THROW(walk.probability(face[100], 0), std::runtime_error);
}

namespace {

/// The default solver, which notes the largest number of labels solved for at once.
class Noting_solver : public Star_mesh_elimination {
 public:
  explicit Noting_solver(Eigen::Index& most_labels) : most_labels_(&most_labels) {}
  void potentials(const Potentials& boundary_values, Potentials& result) const {
    *most_labels_ = std::max(*most_labels_, boundary_values.cols());
    Star_mesh_elimination::potentials(boundary_values, result);
  }

 private:
  Eigen::Index* most_labels_;
};

}  // namespace

TEST(Pathologies, ThousandLabelsAreSolvedInBlocks) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::sphere(4), 0.01));
  const auto conductance = dihedral_conductances(mesh);
  const auto face = faces_of(mesh);
  Eigen::Index most_labels = 0;
  Random_walk walk(mesh, conductance, Noting_solver(most_labels));
  std::vector<networks::Index> seeds;
  for (std::size_t l = 0; l < 1000; ++l) {
    seeds.push_back(static_cast<networks::Index>(5 * l + 2));
    walk.add_seed(face[seeds.back()], l);
  }
  Written<Surface_mesh> labels;
  EXPECT_EQ(walk.write_raw_labels(labels.map()), 1000u);
  EXPECT_LE(most_labels, 16);

  Star_mesh_elimination solver;
  const Potentials all_at_once = networks::potentials(solver, network_of(mesh, conductance), seeds);
  for (std::size_t f = 0; f < face.size(); ++f) {
    Eigen::Index label = 0;
    all_at_once.row(static_cast<Eigen::Index>(f)).maxCoeff(&label);
    ASSERT_EQ(labels[face[f]], static_cast<std::size_t>(label));
  }
}

TEST(Pathologies, LabelSeededInSeveralPlacesMayHaveSeveralRegions) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::tube(9, 12, 27));
  const auto face = faces_of(mesh);
  Written<Surface_mesh> labels, raw;
  Random_walk walk(mesh, dihedral_conductances(mesh));
  walk.add_seed(face.front(), 0);
  walk.add_seed(face.back(), 0);
  walk.add_seed(face[face.size() / 2], 1);
  EXPECT_EQ(walk.segment(labels.map()), 2u);
  EXPECT_EQ(labels[face.front()], 0u);
  EXPECT_EQ(labels[face[face.size() / 2]], 1u);
  EXPECT_EQ(labels[face.back()], 0u);
  EXPECT_EQ(walk.report().island_faces, 0u);
  walk.write_raw_labels(raw.map());
  EXPECT_EQ(labels.in_order_of(mesh), raw.in_order_of(mesh));
}

// ---- Cancelling and changing ----

TEST(Pathologies, CancelledWalkLeavesOutputsUntouchedAndGoesOnLater) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::sphere(4), 0.01));
  const auto face = faces_of(mesh);
  const auto conductance = dihedral_conductances(mesh);
  std::size_t calls = 0, last_call = 0;  // 0: never cancel
  double fraction = 0;
  const std::function<bool(double)> callback = [&](double done) {
    EXPECT_GE(done, 0);
    EXPECT_LE(done, 1);
    fraction = done;
    return ++calls != last_call;
  };
  const auto first_seeds = [&](auto& walk) {
    for (std::size_t l = 0; l < 20; ++l) walk.add_seed(face[250 * l], l);
  };
  Written<Surface_mesh> expected, expected_after_edit;
  Random_walk undisturbed(mesh, conductance, Star_mesh_elimination(), CGAL::parameters::callback(callback));
  first_seeds(undisturbed);
  undisturbed.segment(expected.map());
  EXPECT_EQ(fraction, 1);
  const std::size_t calls_of_first = calls;
  undisturbed.add_seed(face[77], 3);
  undisturbed.segment(expected_after_edit.map());
  const std::size_t calls_of_both = calls;
  EXPECT_GT(calls_of_first, 3u);
  EXPECT_GT(calls_of_both, calls_of_first);

  for (std::size_t k = 1; k <= calls_of_both; ++k) {
    Written<Surface_mesh> labels;
    calls = 0;
    last_call = k;
    Random_walk walk(mesh, conductance, Star_mesh_elimination(), CGAL::parameters::callback(callback));
    first_seeds(walk);
    if (k <= calls_of_first) {
      EXPECT_THROW(walk.segment(labels.map()), Cancelled) << "call " << k;
      EXPECT_TRUE(labels.nothing());
      last_call = 0;
      walk.segment(labels.map());
      EXPECT_EQ(labels.in_order_of(mesh), expected.in_order_of(mesh)) << "call " << k;
    } else {
      walk.segment(labels.map());
      walk.add_seed(face[77], 3);
      Written<Surface_mesh> edited;
      EXPECT_THROW(walk.segment(edited.map()), Cancelled) << "call " << k;
      EXPECT_TRUE(edited.nothing());
      last_call = 0;
      walk.segment(edited.map());
      EXPECT_EQ(edited.in_order_of(mesh), expected_after_edit.in_order_of(mesh)) << "call " << k;
    }
  }
}

TEST(Pathologies, ExceptionOfTheCallbackPassesThrough) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::sphere(3));
  const auto face = faces_of(mesh);
  const std::function<bool(double)> callback = [](double) -> bool { throw std::domain_error("of the user"); };
  Written<Surface_mesh> labels;
  const std::vector<Face<Surface_mesh>> seeds = {face[0], face[300]};
  EXPECT_THROW(segmentation_from_seeds(mesh, equal_conductances(mesh), seeds, labels.map(),
                                       CGAL::parameters::callback(callback)),
               std::domain_error);
  EXPECT_TRUE(labels.nothing());
}

TYPED_TEST(MeshPathologies, MeshWithMoreFacesThanItHadIsAnError) {
  using Mesh = typename TypeParam::Mesh;
  TypeParam held(meshes::plane(5));
  const auto face = faces_of(held.mesh);
  Random_walk walk(held.mesh, equal_conductances(held.mesh));
  walk.add_seed(face[0], 0);
  walk.add_seed(face[40], 1);
  if constexpr (std::is_same_v<TypeParam, meshes::Filtered>)
    held.mesh.set_selected_faces(faces_of(held.whole));
  else
    meshes::append(strip(1), held.mesh);
  Written<Mesh> labels;
  std::map<Face<Mesh>, double> probabilities;
  const boost::associative_property_map<decltype(probabilities)> map(probabilities);
  EXPECT_THROW(walk.segment(labels.map()), std::runtime_error);
  EXPECT_THROW(walk.write_raw_labels(labels.map()), std::runtime_error);
  EXPECT_THROW(walk.write_probabilities(0, map), std::runtime_error);
  if constexpr (!std::is_same_v<TypeParam,
                                meshes::With_removed_faces>) {  // where new faces take the removed ones' place
    EXPECT_THROW(walk.probability(face[1], 0), std::runtime_error);
  }
  EXPECT_TRUE(labels.nothing());
  EXPECT_TRUE(probabilities.empty());
}

TEST(Pathologies, MeshWithFacesRemovedIsAnError) {
  // A Surface_mesh counts removed faces until its garbage is collected.
  Surface_mesh mesh = meshes::surface_mesh(meshes::plane(5));
  const auto face = faces_of(mesh);
  Random_walk walk(mesh, equal_conductances(mesh));
  walk.add_seed(face[0], 0);
  walk.add_seed(face[40], 1);
  CGAL::Euler::remove_face(halfedge(face[10], mesh), mesh);
  Written<Surface_mesh> labels;
  std::map<Face<Surface_mesh>, double> probabilities;
  const boost::associative_property_map<decltype(probabilities)> map(probabilities);
  EXPECT_THROW(walk.segment(labels.map()), std::runtime_error);
  EXPECT_THROW(walk.write_raw_labels(labels.map()), std::runtime_error);
  EXPECT_THROW(walk.write_probabilities(0, map), std::runtime_error);
  EXPECT_TRUE(labels.nothing());
  EXPECT_TRUE(probabilities.empty());
}

// ---- Labels of other kinds ----

TEST(Pathologies, SeedsMayBeReadFromTheMapThatIsWritten) {
  Surface_mesh mesh = meshes::surface_mesh(meshes::with_noise(meshes::sphere(3), 0.02));
  const auto face = faces_of(mesh);
  constexpr std::size_t unknown = 1000;
  auto labels = mesh.add_property_map<Surface_mesh::Face_index, std::size_t>("f:label", unknown).first;
  const std::vector<std::pair<Face<Surface_mesh>, std::size_t>> strokes = {
      {face[3], 0}, {face[4], 0}, {face[400], 1}, {face[401], 1}, {face[900], 2}};
  Written<Surface_mesh> expected;
  const auto conductance = dihedral_conductances(mesh);
  segmentation_from_seeds(mesh, conductance, strokes, expected.map());
  for (const auto& [f, label] : strokes) labels[f] = label;
  const auto seeds = faces(mesh) |
                     boost::adaptors::filtered([&](Face<Surface_mesh> f) { return labels[f] != unknown; }) |
                     boost::adaptors::transformed([&](Face<Surface_mesh> f) { return std::make_pair(f, labels[f]); });
  EXPECT_EQ(segmentation_from_seeds(mesh, conductance, seeds, labels), 3u);
  for (const auto f : face) EXPECT_EQ(labels[f], expected[f]);
}

TEST(Pathologies, LabelsMayBeNegativeFarApartBoolOrStrings) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::cube(2));
  const auto face = faces_of(mesh);
  const auto conductance = dihedral_conductances(mesh);
  Written<Surface_mesh> ids;
  const std::vector<std::pair<Face<Surface_mesh>, int>> seeds = {{face[3], 1000000}, {face[20], -5}, {face[40], -5}};
  EXPECT_EQ(segmentation_from_seeds(mesh, conductance, seeds, ids.map()), 2u);
  EXPECT_EQ(ids[face[20]], 0u);  // ids follow the order of the labels
  EXPECT_EQ(ids[face[40]], 0u);
  EXPECT_EQ(ids[face[3]], 1u);
  const std::vector<std::pair<Face<Surface_mesh>, bool>> sides = {{face[3], true}, {face[20], false}};
  EXPECT_EQ(segmentation_from_seeds(mesh, conductance, sides, ids.map()), 2u);
  EXPECT_EQ(ids[face[3]], 1u);
  EXPECT_EQ(ids[face[20]], 0u);

  const std::vector<std::pair<Face<Surface_mesh>, std::string>> names = {
      {face[3], "top"}, {face[20], "side"}, {face[40], "side"}};
  EXPECT_EQ(segmentation_from_seeds(mesh, conductance, names, ids.map()), 2u);
  EXPECT_EQ(ids[face[20]], 0u);
  EXPECT_EQ(ids[face[3]], 1u);

  const char texts[] = "top\0side\0side";  // in another order than that of the texts
  const std::vector<std::pair<Face<Surface_mesh>, const char*>> words = {
      {face[3], texts}, {face[20], texts + 4}, {face[40], texts + 9}};
  EXPECT_EQ(segmentation_from_seeds(mesh, conductance, words, ids.map()), 2u);
  EXPECT_EQ(ids[face[20]], 0u);
  EXPECT_EQ(ids[face[40]], 0u);
  EXPECT_EQ(ids[face[3]], 1u);

  // The object gives the user's own labels back.
  Written<Surface_mesh, int> labels;
  Random_walk walk(mesh, conductance);
  for (const auto& [f, label] : seeds) walk.add_seed(f, static_cast<std::size_t>(label));
  EXPECT_EQ(walk.segment(labels.map()), 2u);
  for (const auto& [f, label] : seeds) EXPECT_EQ(labels[f], label);
  walk.add_seed(face[20], static_cast<std::size_t>(-1));
  EXPECT_EQ(walk.segment(labels.map()), 3u);
  EXPECT_EQ(labels[face[20]], -1);
}

TEST(Pathologies, LabelThatTheMapCannotHoldIsAnErrorThatNamesIt) {
  const Surface_mesh mesh = meshes::surface_mesh(meshes::cube(2));
  const auto face = faces_of(mesh);
  Random_walk walk(mesh, dihedral_conductances(mesh));
  walk.add_seed(face[3], 0);
  walk.add_seed(face[20], 255);
  Written<Surface_mesh, unsigned char> labels;
  EXPECT_EQ(walk.segment(labels.map()), 2u);
  EXPECT_EQ(labels[face[20]], 255);
  Written<Surface_mesh, unsigned char> none;
  walk.add_seed(face[20], 256);  // would be 0
  try {
    walk.segment(none.map());
    ADD_FAILURE() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("256"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(none.nothing());
}

}  // namespace test_pathologies
