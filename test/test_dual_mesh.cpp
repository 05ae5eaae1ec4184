// SPDX-License-Identifier: MIT

// A `Dual_mesh_of` against the mesh that it was read from; and that all functions of the library do with it what they do
// with the mesh.

#include <RW_segmentation/Dual_mesh.h>

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Curvature_difference.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/coarse_seeds.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/integral_invariant_curvatures.h>
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <gtest/gtest.h>
#include "face_labels.h"
#include "meshes.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace test_dual_mesh {

using namespace RW_segmentation;

namespace {

using Index = Dual_mesh::Index;
using Labels = std::vector<std::size_t>;

template <class Mesh>
using Face_of = typename boost::graph_traits<Mesh>::face_descriptor;
template <class Mesh>
using Edge_of = typename boost::graph_traits<Mesh>::edge_descriptor;

/// Triangles and polygons, with and without border, of one component and several.
std::vector<meshes::Shape> shapes() {
  meshes::Shape mixed = meshes::cube_of_quads();  // quads and triangles
  const auto quad = mixed.faces.back();
  mixed.faces.back() = {quad[0], quad[1], quad[2]};
  mixed.faces.push_back({quad[0], quad[2], quad[3]});
  meshes::Shape unused = meshes::plane(2);  // a vertex without face
  unused.points.insert(unused.points.begin(), {7, 7, 7});
  for (auto& face : unused.faces)
    for (std::size_t& corner : face) ++corner;
  return {meshes::cube(2),
          meshes::plane(3),
          meshes::torus(1, 0.3, 8, 6),
          meshes::cube_of_quads(),
          mixed,
          unused,
          meshes::together(meshes::together(meshes::sphere(1), meshes::moved(meshes::plane(2), {4, 0, 0})),
                           meshes::moved(meshes::cube_of_quads(), {0, 5, 0}))};
}

Eigen::Vector3d in_coordinates_of_mesh(const Dual_mesh& dual, const Eigen::Vector3d& p) {
  return dual.origin() + dual.unit() * p;
}

/// Whether one range is the other one, begun elsewhere.
template <class T>
bool is_rotated(const std::vector<T>& a, const std::vector<T>& b) {
  std::vector<T> twice = b;
  twice.insert(twice.end(), b.begin(), b.end());
  return a.size() == b.size() && std::search(twice.begin(), twice.end(), a.begin(), a.end()) != twice.end();
}

/// The text of the std::invalid_argument that a call throws.
template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

template <class Holder>
class DualMesh : public testing::Test {};
TYPED_TEST_SUITE(DualMesh, meshes::Holders);

}  // namespace

// ---- Against the mesh ----

TYPED_TEST(DualMesh, HasTheFacesEdgesAndVerticesOfTheShape) {
  for (const meshes::Shape& shape : shapes()) {
    const TypeParam held(shape);
    const Dual_mesh_of dual(held.mesh);
    std::set<std::size_t> used;
    std::map<std::pair<std::size_t, std::size_t>, int> sides;
    for (const auto& face : shape.faces)
      for (std::size_t k = 0; k < face.size(); ++k) {
        used.insert(face[k]);
        ++sides[std::minmax(face[k], face[(k + 1) % face.size()])];
      }
    const auto inner = std::count_if(sides.begin(), sides.end(), [](const auto& side) { return side.second == 2; });
    EXPECT_EQ(dual.number_of_faces(), shape.faces.size());
    EXPECT_EQ(dual.number_of_edges(), static_cast<std::size_t>(inner));
    EXPECT_EQ(dual.number_of_vertices(), used.size());
    EXPECT_EQ(&dual.mesh(), &held.mesh);
  }
}

TYPED_TEST(DualMesh, KnowsThePlaceOfEachFaceInTheMesh) {
  for (const meshes::Shape& shape : shapes()) {
    const TypeParam held(shape);
    const Dual_mesh_of dual(held.mesh);
    std::size_t place = 0;
    for (const auto f : faces(held.mesh)) {
      const Index i = dual.index(f);
      ASSERT_LT(i, dual.number_of_faces());
      EXPECT_EQ(dual.place(i), place);
      EXPECT_EQ(dual.face(i), f);
      EXPECT_EQ(dual.face_descriptors()[i], f);
      ++place;
    }
    EXPECT_EQ(place, dual.number_of_faces());
  }
}

TYPED_TEST(DualMesh, HasTheNeighboursOfTheMesh) {
  for (const meshes::Shape& shape : shapes()) {
    const TypeParam held(shape);
    const auto& mesh = held.mesh;
    const Dual_mesh_of dual(mesh);
    for (Index f = 0; f < dual.number_of_faces(); ++f) {
      std::multiset<Index> expected, neighbours;
      for (const auto h : CGAL::halfedges_around_face(halfedge(dual.face(f), mesh), mesh))
        if (!CGAL::is_border(opposite(h, mesh), mesh)) expected.insert(dual.index(face(opposite(h, mesh), mesh)));
      for (const auto& [next, edge] : dual.graph().neighbours(f)) {
        neighbours.insert(next);
        const auto [a, b] = dual.graph().faces_of(edge);
        EXPECT_TRUE((a == f && b == next) || (a == next && b == f));
      }
      EXPECT_EQ(neighbours, expected);
    }
  }
}

TYPED_TEST(DualMesh, HasEdgesOfTheMeshBetweenTheirFacesAndVertices) {
  for (const meshes::Shape& shape : shapes()) {
    const TypeParam held(shape);
    const auto& mesh = held.mesh;
    const Dual_mesh_of dual(mesh);
    for (Index e = 0; e < dual.number_of_edges(); ++e) {
      const auto [f, g] = dual.graph().faces_of(e);
      const auto h = halfedge(dual.edge(e), mesh);
      EXPECT_EQ(dual.edge_descriptors()[e], dual.edge(e));
      EXPECT_EQ(dual.index(face(h, mesh)), f);
      EXPECT_EQ(dual.index(face(opposite(h, mesh), mesh)), g);

      // The ends are corners of both faces, one after the other, in opposite directions.
      const auto [from, to] = dual.ends(e);
      const auto follows = [&](Index face, Index a, Index b) {
        const auto corners = dual.corners(face);
        for (std::size_t k = 0; k < corners.size(); ++k)
          if (corners[k] == a && corners[(k + 1) % corners.size()] == b) return true;
        return false;
      };
      EXPECT_TRUE(follows(f, from, to));
      EXPECT_TRUE(follows(g, to, from));
      EXPECT_NEAR(dual.edge_length(e), (dual.point(from) - dual.point(to)).norm(), 1e-15);
      EXPECT_EQ(dual.edge_lengths()[e], dual.edge_length(e));
    }
  }
}

TYPED_TEST(DualMesh, HasTheCornersOfTheMeshWhereTheyAre) {
  for (const meshes::Shape& shape : shapes()) {
    const TypeParam held(shape);
    const auto& mesh = held.mesh;
    const Dual_mesh_of dual(mesh);
    std::map<typename boost::graph_traits<typename TypeParam::Mesh>::vertex_descriptor, Index> number;
    for (Index f = 0; f < dual.number_of_faces(); ++f) {
      const auto corners = dual.corners(f);
      const std::vector<std::size_t>& expected = shape.faces[dual.place(f)];
      ASSERT_EQ(corners.size(), expected.size());
      auto h = halfedge(dual.face(f), mesh);
      std::vector<std::size_t> in_shape;
      for (std::size_t k = 0; k < corners.size(); ++k) {
        EXPECT_EQ(number.emplace(target(h, mesh), corners[k]).first->second, corners[k]);
        const Eigen::Vector3d p = in_coordinates_of_mesh(dual, dual.point(corners[k]));
        for (const std::size_t v : expected)
          if ((shape.points[v] - p).norm() < 1e-12) in_shape.push_back(v);
        h = next(h, mesh);
      }
      EXPECT_TRUE(is_rotated(in_shape, expected));
    }
    EXPECT_EQ(number.size(), dual.number_of_vertices());
  }
}

TYPED_TEST(DualMesh, MeasuresAsCgalDoes) {
  namespace PMP = CGAL::Polygon_mesh_processing;
  for (const meshes::Shape& shape : {meshes::with_noise(meshes::sphere(2), 0.05), meshes::plane(4),
                                     meshes::with_noise(meshes::torus(5, 2, 12, 9), 0.1)}) {
    const TypeParam held(shape);
    const auto& mesh = held.mesh;
    const Dual_mesh_of dual(mesh);
    const double unit = dual.unit();
    double total = 0, edges = 0;
    for (Index f = 0; f < dual.number_of_faces(); ++f) {
      const double area = CGAL::to_double(PMP::face_area(dual.face(f), mesh));
      const auto n = PMP::compute_face_normal(dual.face(f), mesh);
      Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
      for (const std::size_t v : shape.faces[dual.place(f)]) centroid += shape.points[v] / 3;
      EXPECT_NEAR(dual.area(f) * unit * unit, area, 1e-12 * unit * unit);
      EXPECT_NEAR((dual.normal(f) - Eigen::Vector3d(n.x(), n.y(), n.z())).norm(), 0, 1e-10);
      EXPECT_NEAR((in_coordinates_of_mesh(dual, dual.centroid(f)) - centroid).norm(), 0, 1e-13 * unit);
      EXPECT_EQ(dual.areas()[f], dual.area(f));
      EXPECT_EQ(dual.shape_normal(f), dual.normal(f));
      total += area;
    }
    for (Index e = 0; e < dual.number_of_edges(); ++e) {
      EXPECT_NEAR(dual.edge_length(e) * unit, CGAL::to_double(PMP::edge_length(dual.edge(e), mesh)), 1e-12 * unit);
      edges += dual.edge_length(e);
    }
    EXPECT_NEAR(dual.total_area() * unit * unit, total, 1e-10 * total);
    EXPECT_NEAR(dual.length_unit() * unit, std::sqrt(total), 1e-10 * std::sqrt(total));
    EXPECT_NEAR(dual.mean_edge_length(), edges / static_cast<double>(dual.number_of_edges()), 1e-12);
    EXPECT_EQ(dual.number_of_degenerate_faces(), 0u);
  }
}

TYPED_TEST(DualMesh, MeasuresAPolygonAsItsTriangles) {
  const TypeParam quads(meshes::cube_of_quads());
  const Dual_mesh_of dual(quads.mesh);
  for (Index f = 0; f < 6; ++f) {
    EXPECT_NEAR(dual.area(f) * dual.unit() * dual.unit(), 1, 1e-12);
    const Eigen::Vector3d centre = in_coordinates_of_mesh(dual, dual.centroid(f));
    EXPECT_NEAR((centre - Eigen::Vector3d(0.5, 0.5, 0.5) - dual.normal(f) / 2).norm(), 0, 1e-12);
  }
}

TYPED_TEST(DualMesh, LiesInTheUnitBox) {
  for (const meshes::Shape& shape : shapes()) {
    const TypeParam held(meshes::moved(meshes::scaled(shape, 3), {10, -20, 30}));
    const Dual_mesh_of dual(held.mesh);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : dual.points()) box.extend(p);
    EXPECT_NEAR(box.diagonal().norm(), 1, 1e-12);
    EXPECT_NEAR(box.center().norm(), 0, 1e-12);
  }
}

// ---- Numbers ----

TYPED_TEST(DualMesh, NumbersFacesBreadthFirst) {
  for (const meshes::Shape& shape : shapes()) {
    const TypeParam held(shape);
    const Dual_mesh_of dual(held.mesh);
    // The neighbour of lowest number never falls from face to face; a face that has none begins a component, and is the
    // first one of it in the order of the mesh.
    std::optional<Index> last_parent;
    std::set<Index> known;
    for (Index f = 0; f < dual.number_of_faces(); ++f) {
      Index parent = f;
      for (const auto& neighbour : dual.graph().neighbours(f)) parent = std::min(parent, neighbour.face);
      if (parent == f) {
        for (Index place = 0; place < dual.place(f); ++place) EXPECT_TRUE(known.count(place));
      } else if (last_parent) {
        EXPECT_GE(parent, *last_parent);
      }
      last_parent = parent;
      known.insert(dual.place(f));
    }
    // Edges follow the lower one of their faces.
    Index last = 0;
    for (Index e = 0; e < dual.number_of_edges(); ++e) {
      const auto [f, g] = dual.graph().faces_of(e);
      EXPECT_GE(std::min(f, g), last);
      last = std::min(f, g);
    }
  }
}

TYPED_TEST(DualMesh, HasNumbersThatDependOnNeitherCoordinatesNorWalls) {
  using Mesh = typename TypeParam::Mesh;
  for (const meshes::Shape& shape : shapes()) {
    const TypeParam held(shape), other(meshes::with_noise(shape, 10));
    const auto walls =
        boost::make_function_property_map<Edge_of<Mesh>>([](const Edge_of<Mesh>&) -> bool { return true; });
    const Dual_mesh_of dual(held.mesh), moved(other.mesh),
        walled(held.mesh, CGAL::parameters::edge_is_constrained_map(walls));
    for (Index f = 0; f < dual.number_of_faces(); ++f) {
      EXPECT_EQ(moved.place(f), dual.place(f));
      EXPECT_EQ(walled.face(f), dual.face(f));
      ASSERT_EQ(moved.corners(f).size(), dual.corners(f).size());
      for (std::size_t k = 0; k < dual.corners(f).size(); ++k) EXPECT_EQ(moved.corners(f)[k], dual.corners(f)[k]);
    }
    for (Index e = 0; e < dual.number_of_edges(); ++e) {
      EXPECT_EQ(moved.graph().faces_of(e), dual.graph().faces_of(e));
      EXPECT_EQ(walled.edge(e), dual.edge(e));
      EXPECT_TRUE(walled.is_wall(e));
      EXPECT_FALSE(dual.is_wall(e));
    }
    EXPECT_FALSE(dual.has_walls());
  }
}

TYPED_TEST(DualMesh, HasTheWallsThatAMapMarks) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held(meshes::cube(2));
  const auto is_marked = [&](const Edge_of<Mesh>& e) -> bool {  // along the sides of the cube
    const auto& mesh = held.mesh;
    const auto points = get(CGAL::vertex_point, mesh);
    const auto p = get(points, source(halfedge(e, mesh), mesh)), q = get(points, target(halfedge(e, mesh), mesh));
    int on_sides = 0;
    for (int i = 0; i < 3; ++i) on_sides += p[i] == q[i] && (p[i] == 0 || p[i] == 1);
    return on_sides == 2;
  };
  const auto walls = boost::make_function_property_map<Edge_of<Mesh>>(is_marked);
  const Dual_mesh_of dual(held.mesh, CGAL::parameters::edge_is_constrained_map(walls));
  std::size_t marked = 0;
  for (Index e = 0; e < dual.number_of_edges(); ++e) {
    EXPECT_EQ(dual.is_wall(e), is_marked(dual.edge(e)));
    marked += dual.is_wall(e);
  }
  EXPECT_TRUE(dual.has_walls());
  EXPECT_EQ(marked, 24u);
  EXPECT_EQ(internal::Components(dual.graph(), [&](Index e) { return !dual.is_wall(e); }).count, 6u);
}

TYPED_TEST(DualMesh, WithoutPointsHasTheSameGraphAndWalls) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held(meshes::torus(3, 1, 12, 8));
  const Dual_mesh_of whole(held.mesh);
  std::vector<Edge_of<Mesh>> marked;
  for (Index e = 0; e < whole.number_of_edges(); e += 3) marked.push_back(whole.edge(e));
  for (const auto& walls : {marked, std::vector<Edge_of<Mesh>>()}) {
    const auto is_marked = boost::make_function_property_map<Edge_of<Mesh>>(
        [&](const Edge_of<Mesh>& e) -> bool { return std::find(walls.begin(), walls.end(), e) != walls.end(); });
    const auto np = CGAL::parameters::edge_is_constrained_map(is_marked);
    const auto without = Dual_mesh_of<Mesh>::without_points(held.mesh, np);
    const Dual_mesh_of with(held.mesh, np);
    EXPECT_EQ(without.has_walls(), !walls.empty());
    EXPECT_EQ(with.has_walls(), !walls.empty());
    EXPECT_TRUE(without.face_descriptors() == with.face_descriptors());
    EXPECT_EQ(without.number_of_vertices(), 0u);
    ASSERT_EQ(without.number_of_edges(), with.number_of_edges());
    for (Index e = 0; e < with.number_of_edges(); ++e) {
      EXPECT_EQ(without.graph().faces_of(e), with.graph().faces_of(e));
      EXPECT_EQ(without.is_wall(e), with.is_wall(e));
    }
  }
}

TEST(DualMeshOf, KnowsNoFaceThatIsRemovedOrHidden) {
  meshes::With_removed_faces held(meshes::cube(1));
  const Dual_mesh_of dual(held.mesh);
  EXPECT_EQ(dual.index(meshes::Surface_mesh::Face_index(12)), dual.none);
  EXPECT_EQ(dual.index(meshes::Surface_mesh::null_face()), dual.none);
  EXPECT_EQ(dual.index(meshes::Surface_mesh::Face_index(100000)), dual.none);

  const meshes::Filtered filtered(meshes::plane(2));
  const Dual_mesh_of part(filtered.mesh);
  EXPECT_EQ(part.index(meshes::Surface_mesh::Face_index(8)), part.none);
  EXPECT_EQ(part.number_of_edges(), 8u);
}

// ---- Maps ----

TYPED_TEST(DualMesh, ReadsAndWritesMaps) {
  using Mesh = typename TypeParam::Mesh;
  const TypeParam held(meshes::l_shape(2));
  const Dual_mesh_of dual(held.mesh);
  Face_labels<Mesh> labels(held.mesh);
  Labels numbers;
  for (std::size_t f = 0; f < dual.number_of_faces(); ++f) numbers.push_back(f);
  dual.write_faces(numbers, labels.map());
  EXPECT_EQ(dual.read_segments(labels.map()), numbers);
  EXPECT_EQ(dual.read_faces(labels.map(), [](std::size_t id) { return static_cast<double>(id) / 2; })[7], 3.5);
  for (Index f = 0; f < numbers.size(); ++f) EXPECT_EQ(labels.values()[dual.place(f)], f);

  std::size_t calls = 0;
  const auto map = boost::make_function_property_map<Edge_of<Mesh>>([&](const Edge_of<Mesh>& e) -> double {
    ++calls;
    return static_cast<double>(dual.index(face(halfedge(e, held.mesh), held.mesh)));
  });
  const std::vector<double> values = dual.read_edges(map, "the number");
  EXPECT_EQ(calls, dual.number_of_edges());
  for (Index e = 0; e < values.size(); ++e) EXPECT_EQ(values[e], static_cast<double>(dual.graph().faces_of(e)[0]));
}

TYPED_TEST(DualMesh, NamesWhatIsWrongByItsPlaceInTheMesh) {
  using Mesh = typename TypeParam::Mesh;
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const meshes::Shape shape = meshes::with_faces_in_order(meshes::cube(2), meshes::random_order(48));
  for (const double value : {nan, infinity, -infinity}) {
    meshes::Shape bad = shape;
    bad.points[13].z() = value;
    const TypeParam held(bad);
    EXPECT_TRUE(contains(error_of([&] { Dual_mesh_of dual(held.mesh); }), "vertex 13 has a coordinate")) << value;
  }
  const TypeParam held(shape);
  const Dual_mesh_of dual(held.mesh);
  for (const double value : {nan, -1e-9}) {
    const auto map = boost::make_function_property_map<Edge_of<Mesh>>(
        [&](const Edge_of<Mesh>& e) -> double { return e == dual.edge(40) ? value : 1; });
    const auto [f, g] = dual.graph().faces_of(40);
    const std::string error = error_of([&] { dual.read_edges(map, "the difference"); });
    const auto [first, second] = std::minmax({dual.place(f), dual.place(g)});
    EXPECT_TRUE(contains(
        error, "the difference on the edge between faces " + std::to_string(first) + " and " + std::to_string(second)))
        << error;
  }
  const Face_of<Mesh> bad_face = dual.face(dual.index(*std::next(faces(held.mesh).begin(), 21)));
  const auto normals = boost::make_function_property_map<Face_of<Mesh>>([&](const Face_of<Mesh>& f) -> Eigen::Vector3d {
    return f == bad_face ? Eigen::Vector3d(0, infinity, 0) : Eigen::Vector3d(0, 0, 2);
  });
  EXPECT_TRUE(contains(error_of([&] { dual.read_normals(normals); }), "the normal of face 21 is"));
}

// ---- Lifetime ----

TEST(DualMeshOf, DoesNotChangeWhenAnotherOneIsMadeOfIt) {
  const auto mesh = meshes::surface_mesh(meshes::sphere(1));
  const Dual_mesh_of dual(mesh);
  const std::vector<Eigen::Vector3d> normals = internal::own_normals(dual), points = dual.points();
  const std::vector<double> areas = dual.areas();

  const Dual_mesh_of turned(dual.with_shape_normals(std::vector<Eigen::Vector3d>(80, Eigen::Vector3d::UnitX())), dual);
  EXPECT_EQ(turned.shape_normal(5), Eigen::Vector3d::UnitX());
  EXPECT_EQ(internal::own_normals(turned), normals);
  EXPECT_EQ(turned.face(5), dual.face(5));
  EXPECT_EQ(dual.with_shape_normals_of(turned).shape_normal(5), Eigen::Vector3d::UnitX());
  EXPECT_EQ(turned.with_shape_normals_of(dual).shape_normal(5), normals[5]);

  std::vector<Eigen::Vector3d> halved = points;
  for (Eigen::Vector3d& p : halved) p /= 2;
  const Dual_mesh smaller = turned.with_points(halved);
  for (Index f = 0; f < 80; ++f) {
    EXPECT_NEAR(smaller.area(f), areas[f] / 4, 1e-15);
    EXPECT_NEAR((smaller.shape_normal(f) - normals[f]).norm(), 0, 1e-12);  // those of the faces
  }
  EXPECT_EQ(smaller.unit(), dual.unit());
  EXPECT_EQ(&smaller.graph(), &dual.graph());

  EXPECT_EQ(dual.points(), points);
  EXPECT_EQ(internal::own_normals(dual), normals);
  EXPECT_FALSE(dual.has_shape_normals());
  EXPECT_EQ(dual.areas(), areas);
}

TEST(DualMeshOf, SharesWhatItHoldsWithItsCopies) {
  const auto mesh = meshes::surface_mesh(meshes::sphere(1));
  auto dual = std::make_optional<Dual_mesh_of<meshes::Surface_mesh>>(mesh);
  const Dual_mesh_of copy = *dual;
  EXPECT_EQ(&copy.points(), &dual->points());
  EXPECT_EQ(&copy.graph(), &dual->graph());
  EXPECT_EQ(&copy.face_descriptors(), &dual->face_descriptors());
  const Eigen::Vector3d point = dual->point(3);
  dual.reset();
  EXPECT_EQ(copy.point(3), point);
  EXPECT_EQ(copy.graph().number_of_faces(), 80u);
}

TEST(DualMeshOf, MayBeEmptyOrOfOneFace) {
  const Dual_mesh none;
  EXPECT_EQ(none.number_of_faces() + none.number_of_edges() + none.number_of_vertices(), 0u);
  const meshes::Surface_mesh empty;
  const Dual_mesh_of dual(empty);
  EXPECT_EQ(dual.number_of_faces(), 0u);
  EXPECT_EQ(dual.total_area(), 0);
  EXPECT_EQ(dual.mean_edge_length(), 0);
  EXPECT_EQ(dual.length_unit(), 1);

  meshes::Shape triangle = meshes::plane(1);
  triangle.faces.resize(1);
  const auto one = meshes::surface_mesh(triangle);
  const Dual_mesh_of face(one);
  EXPECT_EQ(face.number_of_faces(), 1u);
  EXPECT_EQ(face.number_of_edges(), 0u);
  EXPECT_EQ(face.number_of_vertices(), 3u);
}

// ---- Coordinates ----

TEST(DualMeshOf, MeasuresTheSameHoweverHugeOrTiny) {
  const meshes::Shape shape = meshes::with_noise(meshes::l_shape(2), 0.01);
  const auto mesh = meshes::surface_mesh(shape);
  const Dual_mesh_of dual(mesh);
  for (const double factor : {1e-150, 1e-30, 1e30, 1e150}) {
    const auto scaled = meshes::surface_mesh(meshes::scaled(shape, factor));
    const Dual_mesh_of other(scaled);
    EXPECT_NEAR(other.unit() / dual.unit() / factor, 1, 1e-12);
    EXPECT_EQ(other.number_of_degenerate_faces(), 0u);
    for (Index f = 0; f < dual.number_of_faces(); ++f) {
      EXPECT_NEAR(other.area(f), dual.area(f), 1e-12);
      EXPECT_NEAR((other.normal(f) - dual.normal(f)).norm(), 0, 1e-10);
    }
  }
}

TEST(DualMeshOf, KnowsWhatRoundingFarAwayCosts) {
  const meshes::Shape shape = meshes::with_noise(meshes::l_shape(2), 0.01);
  const auto mesh = meshes::surface_mesh(shape);
  const Dual_mesh_of dual(mesh);
  double last = 0;
  for (const double distance : {0., 1e3, 1e6, 1e9}) {
    const auto moved = meshes::surface_mesh(meshes::moved(shape, {distance, -distance, distance}));
    const Dual_mesh_of other(moved);
    EXPECT_GE(other.rounding(), last);
    last = other.rounding();
    for (Index v = 0; v < dual.number_of_vertices(); ++v)
      EXPECT_LE((other.point(v) - dual.point(v)).norm(), 1e-12 + 10 * other.rounding());
  }
  EXPECT_GT(last, 1e-8);
  EXPECT_LT(last, 1e-5);
}

// ---- What is done with a mesh and with its dual mesh ----

namespace {

/// What the stages say about a mesh, or a mesh that has been read, by face in the order of the mesh or by edge in the
/// order of the dual mesh.
struct Findings {
  std::vector<double> numbers;
  Labels labels;
};

template <class Given, class Mesh>
Findings findings(const Given& given, const Mesh& mesh) {
  using Face = Face_of<Mesh>;
  Findings found;
  const Dual_mesh_of order(mesh);
  const auto add_edges = [&](const auto& map) {
    for (const auto e : order.edge_descriptors()) found.numbers.push_back(get(map, e));
  };
  std::map<Index, double> of_face;
  std::map<Index, Eigen::Vector3d> vector_of_face;
  std::map<Index, Surface_curvatures> curvatures_of_face;
  const auto stored_in = [&](auto& values) {
    return boost::make_function_property_map<Face>([&](const Face& f) -> auto& { return values[order.index(f)]; });
  };
  Face_labels<Mesh> ids(mesh);
  const auto add_labels = [&] { found.labels.insert(found.labels.end(), ids.values().begin(), ids.values().end()); };
  std::vector<Face> seeds;
  const auto add_seeds = [&] {
    for (const Face f : seeds) found.labels.push_back(order.index(f));
  };

  const Dihedral_difference difference(given, 0.5);
  const Conductance conductance(given, difference);
  add_edges(difference);
  add_edges(Dihedral_difference(given, smoothed_concavity()));
  add_edges(conductance);
  add_edges(Curvature_difference(given));
  smoothed_face_normals(given, stored_in(vector_of_face));
  for (const auto& [f, n] : vector_of_face) found.numbers.insert(found.numbers.end(), {n.x(), n.y(), n.z()});
  add_edges(Dihedral_difference(given, stored_in(vector_of_face)));
  local_thickness(given, stored_in(of_face));
  for (const auto& [f, thickness] : of_face) found.numbers.push_back(thickness);
  integral_invariant_curvatures(given, stored_in(curvatures_of_face), Ball_radius::in_edge_lengths(2));
  for (const auto& [f, curvatures] : curvatures_of_face) found.numbers.push_back(curvatures.mean_curvature());

  feature_sensitive_seeds(given, 6, std::back_inserter(seeds));
  add_seeds();
  seeds.clear();
  coarse_seeds(given, difference, Seed_count_stop(6), std::back_inserter(seeds));
  add_seeds();
  segmentation_from_seeds(given, conductance, seeds, ids.map());
  add_labels();
  Random_walk walk(given, conductance);
  for (const Face f : seeds) walk.add_seed(f, 100 + order.index(f));
  walk.segment(ids.map());
  add_labels();
  merge_segments(given, ids.map(), difference, Size_aware_cost(given, stored_in(of_face)))
      .segments(Segment_count_stop(4), ids.map());
  add_labels();
  segmentation_via_random_walks(given, ids.map());
  add_labels();
  hierarchy_via_random_walks(given).segments(Segment_count_stop(7), ids.map());
  add_labels();
  return found;
}

// Few kinds of mesh, since all functions are compiled twice for each.
template <class Holder>
struct Doors : testing::Test {};
using Meshes_at_doors = testing::Types<meshes::Plain<meshes::Polyhedron>, meshes::Filtered>;
TYPED_TEST_SUITE(Doors, Meshes_at_doors);

}  // namespace

TYPED_TEST(Doors, TakeADualMeshInPlaceOfTheMesh) {
  const TypeParam held(
      meshes::with_noise(meshes::together(meshes::l_shape(3), meshes::moved(meshes::cube(3), {0, 0, 3})), 0.01));
  const Findings of_mesh = findings(held.mesh, held.mesh), of_dual = findings(Dual_mesh_of(held.mesh), held.mesh);
  EXPECT_GT(of_mesh.numbers.size(), 5 * Dual_mesh_of(held.mesh).number_of_edges());
  EXPECT_EQ(of_mesh.numbers, of_dual.numbers);
  EXPECT_EQ(of_mesh.labels, of_dual.labels);
}

TYPED_TEST(Doors, TakeThePointsOfTheNamedParameter) {
  using Mesh = typename TypeParam::Mesh;
  using vertex_descriptor = typename boost::graph_traits<Mesh>::vertex_descriptor;
  const meshes::Shape shape = meshes::with_noise(meshes::l_shape(3), 0.01);
  Eigen::Affine3d wide = Eigen::Affine3d::Identity();
  wide.scale(Eigen::Vector3d(5, 1, 1));
  const TypeParam held(shape), other(meshes::transformed(shape, wide));
  const auto points = get(CGAL::vertex_point, held.mesh);
  const auto widened =
      boost::make_function_property_map<vertex_descriptor>([&](const vertex_descriptor& v) -> meshes::Kernel::Point_3 {
        const auto p = get(points, v);
        return {5. * p[0], double(p[1]), double(p[2])};
      });
  const auto np = CGAL::parameters::vertex_point_map(widened);
  Face_labels<Mesh> expected(other.mesh), by_name(held.mesh), of_dual(held.mesh);
  segmentation_via_random_walks(other.mesh, expected.map(), Automatic_segmentation(5));
  segmentation_via_random_walks(held.mesh, by_name.map(), Automatic_segmentation(5), np);
  segmentation_via_random_walks(Dual_mesh_of(held.mesh, np), of_dual.map(), Automatic_segmentation(5));
  EXPECT_EQ(by_name.values(), expected.values());
  EXPECT_EQ(of_dual.values(), expected.values());
}

// ---- Kernels ----

namespace {

template <class Kernel>
struct Kernels : testing::Test {};
using Kernel_types = testing::Types<CGAL::Exact_predicates_inexact_constructions_kernel,
                                    CGAL::Exact_predicates_exact_constructions_kernel, CGAL::Simple_cartesian<float>>;
TYPED_TEST_SUITE(Kernels, Kernel_types);

}  // namespace

TYPED_TEST(Kernels, GiveTheSameLabels) {
  meshes::Shape shape = meshes::with_noise(meshes::two_spheres_with_neck(2.4, 0.3, 20), 0.01);
  for (Eigen::Vector3d& p : shape.points) p = p.cast<float>().cast<double>();
  using Mesh = CGAL::Surface_mesh<typename TypeParam::Point_3>;
  Mesh mesh;
  for (const Eigen::Vector3d& p : shape.points)
    mesh.add_vertex({typename TypeParam::FT(p.x()), typename TypeParam::FT(p.y()), typename TypeParam::FT(p.z())});
  for (const auto& f : shape.faces)
    mesh.add_face(typename Mesh::Vertex_index(static_cast<unsigned>(f[0])),
                  typename Mesh::Vertex_index(static_cast<unsigned>(f[1])),
                  typename Mesh::Vertex_index(static_cast<unsigned>(f[2])));
  const auto of_doubles = meshes::surface_mesh(shape);
  Face_labels<meshes::Surface_mesh> expected(of_doubles);
  Face_labels<Mesh> ids(mesh), of_dual(mesh);
  const std::size_t segments = segmentation_via_random_walks(of_doubles, expected.map());
  EXPECT_EQ(segmentation_via_random_walks(mesh, ids.map()), segments);
  EXPECT_EQ(ids.values(), expected.values());
  segmentation_via_random_walks(Dual_mesh_of(mesh), of_dual.map());
  EXPECT_EQ(of_dual.values(), expected.values());
}

// ---- The one call by hand ----

namespace {

/// The automatic segmentation, put together from its stages.
template <class Mesh, class NamedParameters>
Labels automatic_by_hand(const Mesh& mesh, const NamedParameters& np) {
  using Face = Face_of<Mesh>;
  const Dual_mesh_of dual(mesh, np);
  const Dual_mesh_of shape = smoothed_shape(dual);
  const Dihedral_difference difference(shape, smoothed_concavity());
  const Conductance conductance(shape, difference);
  const std::size_t components = internal::Components(shape.graph(), [&](Index e) { return !shape.is_wall(e); }).count;
  std::vector<Face> seeds;
  feature_sensitive_seeds(shape, 40 + components - 1, std::back_inserter(seeds));
  Face_labels<Mesh> ids(mesh);
  Random_walk walk(shape, conductance);
  for (std::size_t i = 0; i < seeds.size(); ++i) walk.add_seed(seeds[i], i);
  walk.segment(ids.map());
  std::vector<double> thickness(shape.number_of_faces());
  const auto thickness_map =
      boost::make_function_property_map<Face>([&](const Face& f) -> double& { return thickness[shape.index(f)]; });
  local_thickness(shape, thickness_map);
  merge_segments(shape, ids.map(), difference, Learned_cost(shape, thickness_map))
      .segments(Cost_threshold_stop(1), ids.map());
  return ids.values();
}

/// The one call with one seeding, as by hand.
template <class Mesh, class NamedParameters>
Labels automatic_in_one_call(const Mesh& mesh, const NamedParameters& np) {
  Automatic_segmentation policies;
  policies.seedings = 1;
  policies.by_component = false;
  Face_labels<Mesh> ids(mesh);
  segmentation_via_random_walks(mesh, ids.map(), policies, np);
  return ids.values();
}

}  // namespace

TYPED_TEST(Doors, GiveByHandTheLabelsOfTheOneCall) {
  using Mesh = typename TypeParam::Mesh;
  for (const meshes::Shape& shape :
       {meshes::with_noise(meshes::two_spheres_with_neck(2.4, 0.3, 32), 0.003),
        meshes::with_noise(meshes::two_spheres_with_neck(2.4, 0.3, 32), 0.05),  // heavy
        meshes::together(meshes::l_shape(5), meshes::moved(meshes::with_noise(meshes::sphere(2), 0.01), {4, 0, 0}))}) {
    const TypeParam held(shape);
    const auto defaults = CGAL::parameters::default_values();
    EXPECT_EQ(automatic_by_hand(held.mesh, defaults), automatic_in_one_call(held.mesh, defaults));

    const auto& mesh = held.mesh;
    const auto points = get(CGAL::vertex_point, mesh);
    const auto is_low = [&](const auto& face) { return get(points, target(halfedge(face, mesh), mesh))[2] < 0.7; };
    const auto walls = boost::make_function_property_map<Edge_of<Mesh>>([&](const Edge_of<Mesh>& e) -> bool {
      const auto h = halfedge(e, mesh);
      return is_low(face(h, mesh)) != is_low(face(opposite(h, mesh), mesh));
    });
    const auto np = CGAL::parameters::edge_is_constrained_map(walls);
    EXPECT_EQ(automatic_by_hand(mesh, np), automatic_in_one_call(mesh, np));
  }
}

TEST(ByHand, GivesTheLabelsOfTheOneCallOnDataMeshes) {
  for (const char* name : {"elephant.off", "blobby.off", "fandisk.off"}) {
    const auto mesh = meshes::data_mesh(name);
    if (!mesh) GTEST_SKIP() << "CGAL's data meshes are not installed";
    const auto defaults = CGAL::parameters::default_values();
    EXPECT_EQ(automatic_by_hand(*mesh, defaults), automatic_in_one_call(*mesh, defaults)) << name;
  }
}

}  // namespace test_dual_mesh
