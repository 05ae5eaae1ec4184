// SPDX-License-Identifier: MIT

#include <RW_segmentation/Geodesic_joining.h>
#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/split_along_boundaries.h>

#include <gtest/gtest.h>
#include "boundaries.h"
#include "meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace test_split_along_boundaries {

using namespace RW_segmentation;
using namespace boundaries;

namespace {

using meshes::Shape;
using meshes::Surface_mesh;
using Curves = std::vector<Boundary_curve<Surface_mesh>>;

Shape bumpy_torus() { return meshes::with_noise(meshes::torus(2, 1, 40, 24), 0.02); }

/// Smooths and splits, and sees to it that the surface and the segments are what they were.
/// \param np of `smooth_boundaries()`
template <class Mesh, class Joining = Traced_joining,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Split_report refine(Mesh& mesh, Growing_face_labels<Mesh>& labels, const Joining& joining = {},
                    const NamedParameters& np = CGAL::parameters::default_values()) {
  const Surface_measures before = measures(mesh, labels);
  const double edge = mean_edge_length(mesh);
  std::map<typename boost::graph_traits<Mesh>::edge_descriptor, bool> marks;
  const auto constrained = boost::make_assoc_property_map(marks);
  const auto curves = smooth_boundaries(mesh, labels.map(), {}, joining, np);
  const Split_report report =
      split_along_boundaries(mesh, curves, labels.map(), CGAL::parameters::edge_is_constrained_map(constrained));

  EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
  EXPECT_TRUE(CGAL::is_triangle_mesh(mesh));
  const Surface_measures after = measures(mesh, labels);
  EXPECT_EQ(after.faces, before.faces + report.faces_added);
  EXPECT_NEAR(after.area, before.area, 1e-12 * before.area);
  EXPECT_NEAR(after.volume, before.volume, 1e-12 * std::max(std::abs(before.volume), std::pow(before.area, 1.5)));
  EXPECT_EQ(after.regions, before.regions);
  EXPECT_EQ(after.labels, before.labels);
  EXPECT_GT(after.least_height, std::min(1e-6 * edge, before.least_height * (1 - 1e-9)));
  for (const auto e : edges(mesh)) {
    const auto h = halfedge(e, mesh);
    const bool is_boundary =
        !CGAL::is_border_edge(h, mesh) && labels[face(h, mesh)] != labels[face(opposite(h, mesh), mesh)];
    EXPECT_EQ(marks[e], is_boundary);
  }
  return report;
}

/// Everything that can be seen of a mesh with segments.
std::string description(const Surface_mesh& mesh, Growing_face_labels<Surface_mesh>& labels) {
  std::ostringstream text;
  text.precision(17);
  text << mesh;
  for (const auto f : mesh.faces()) text << labels[f] << ' ';
  return text.str();
}

/// \param cause what the text of the error must tell
void expect_refused(Surface_mesh& mesh, const Curves& curves, Growing_face_labels<Surface_mesh>& labels,
                    const std::string& cause = "") {
  const std::string before = description(mesh, labels);
  try {
    split_along_boundaries(mesh, curves, labels.map());
    ADD_FAILURE() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(cause), std::string::npos) << error.what();
  }
  EXPECT_TRUE(description(mesh, labels) == before) << "something has changed";
}

/// A plane in two halves and the curve between them.
struct Two_halves {
  Shape shape = meshes::plane(20);
  Surface_mesh mesh = meshes::surface_mesh(shape);
  Growing_face_labels<Surface_mesh> labels{
      mesh, labels_by_place(shape, [](const Eigen::Vector3d& p) { return std::size_t(p.x() + 0.4 * p.y() > 0.7); })};
  Curves curves = smooth_boundaries(mesh, labels.map());
};

template <class Holder>
class SplitAlongBoundaries : public testing::Test {};
using Mutable_holders =
    testing::Types<meshes::Plain<Surface_mesh>, meshes::Plain<meshes::Polyhedron>, meshes::With_removed_faces>;
TYPED_TEST_SUITE(SplitAlongBoundaries, Mutable_holders);

}  // namespace

// ---- What stays ----

TYPED_TEST(SplitAlongBoundaries, SurfaceAndSegmentsStayWhatTheyWere) {
  for (const Shape& shape : {bumpy_torus(), meshes::sphere(3), meshes::two_spheres_with_neck(3, 0.3, 24)})
    for (const std::size_t segments : {2u, 9u, 40u}) {
      TypeParam held(shape);
      Growing_face_labels<typename TypeParam::Mesh> labels(held.mesh, random_cells(shape, segments));
      const Split_report report = refine(held.mesh, labels);
      EXPECT_GT(report.faces_added, 0u);
    }
}

TYPED_TEST(SplitAlongBoundaries, OpenMeshesKeepTheirBorder) {
  const Shape shape = meshes::with_noise(meshes::plane(20), 0.004);
  TypeParam held(shape);
  Growing_face_labels<typename TypeParam::Mesh> labels(held.mesh, random_cells(shape, 6));
  const std::size_t before = measures(held.mesh, labels).border_edges;
  refine(held.mesh, labels);
  EXPECT_EQ(measures(held.mesh, labels).border_edges, before);
}

TYPED_TEST(SplitAlongBoundaries, EachComponentIsCutByItself) {
  const Shape shape = meshes::together(bumpy_torus(), meshes::moved(meshes::sphere(3), {9, 0, 0}));
  TypeParam held(shape);
  Growing_face_labels<typename TypeParam::Mesh> labels(
      held.mesh, labels_by_place(shape, [](const Eigen::Vector3d& p) { return std::size_t(p.z() > 0.1 * p.x()); }));
  EXPECT_GT(refine(held.mesh, labels).faces_added, 0u);
}

TYPED_TEST(SplitAlongBoundaries, LabelsWithoutAnyOrderSurvive) {
  const Shape shape = meshes::sphere(3);
  for (const std::size_t number : {2u, 3u, 20u}) {
    TypeParam held(shape);
    std::mt19937 random(5);
    Labels chaos;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) chaos.push_back(random() % number);
    Growing_face_labels<typename TypeParam::Mesh> labels(held.mesh, chaos);
    refine(held.mesh, labels);
  }
}

TEST(SplitAlongBoundariesOf, AnyNumberMayBeTheIdOfASegment) {
  const Shape shape = meshes::plane(30);
  const auto disc = [&](std::size_t id) {
    Surface_mesh mesh = meshes::surface_mesh(shape);
    Growing_face_labels<Surface_mesh> labels(mesh, labels_by_place(shape, [&](const Eigen::Vector3d& p) {
                                               const bool is_inside = std::hypot(p.x() - 0.5, p.y() - 0.5) < 0.28;
                                               return is_inside ? id : std::size_t(p.x() > 0.5);
                                             }));
    EXPECT_GT(refine(mesh, labels).faces_relabelled, 0u);
    std::vector<bool> is_inside;
    for (const auto f : mesh.faces()) is_inside.push_back(labels[f] == id);
    return is_inside;
  };
  EXPECT_EQ(disc(std::numeric_limits<std::size_t>::max()), disc(2));
}

TEST(SplitAlongBoundariesOf, TatteredMeshesKeepSurfaceAndSegments) {
  for (unsigned seed = 0; seed < 60; ++seed)
    for (const Shape& shape : {meshes::plane(5), meshes::sphere(1)}) {
      std::mt19937 random(seed);
      Surface_mesh mesh = meshes::surface_mesh(shape);
      for (std::size_t f = 0; f < shape.faces.size(); ++f)
        if (random() % 5 == 0)  // some vertices are left with several fans of faces
          CGAL::Euler::remove_face(mesh.halfedge(Surface_mesh::Face_index(static_cast<Surface_mesh::size_type>(f))),
                                   mesh);
      Labels chaos;
      for (std::size_t f = 0; f < mesh.number_of_faces(); ++f) chaos.push_back(random() % 3);
      Growing_face_labels<Surface_mesh> labels(mesh, chaos);
      refine(mesh, labels);
    }
}

// Where faces fold onto each other, no plane leads from one point of a curve to the next.
TEST(SplitAlongBoundariesOf, CrumpledMeshesKeepSurfaceAndSegments) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Shape shape = meshes::with_noise(meshes::torus(2, 1, 40, 24), 0.3, seed);
    Surface_mesh mesh = meshes::surface_mesh(shape);
    Growing_face_labels<Surface_mesh> labels(mesh, random_cells(shape, 12, seed));
    refine(mesh, labels);
  }
}

TEST(SplitAlongBoundariesOf, CurvesOfGeodesicsKeepSurfaceAndSegments) {
  for (unsigned seed = 1; seed <= 2; ++seed)
    for (const double noise : {0.02, 0.3}) {
      const Shape shape = meshes::with_noise(meshes::torus(2, 1, 40, 24), noise, seed);
      Surface_mesh mesh = meshes::surface_mesh(shape);
      Growing_face_labels<Surface_mesh> labels(mesh, random_cells(shape, 12, seed));
      EXPECT_GT(refine(mesh, labels, Geodesic_joining()).faces_added, 100u);
    }
}

TEST(SplitAlongBoundariesOf, GeodesicsPassFacesWithoutArea) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    Shape shape = bumpy_torus();
    std::mt19937 random(seed);
    for (int i = 0; i < 30; ++i) {  // a corner moves onto another one, or onto the line through two
      const auto& face = shape.faces[random() % shape.faces.size()];
      shape.points[face[0]] = random() % 2 == 0 ? shape.points[face[1]]
                                                : Eigen::Vector3d((shape.points[face[1]] + shape.points[face[2]]) / 2);
    }
    Surface_mesh mesh = meshes::surface_mesh(shape);
    Growing_face_labels<Surface_mesh> labels(mesh, random_cells(shape, 12, seed));
    const Surface_measures before = measures(mesh, labels);
    const auto curves = smooth_boundaries(mesh, labels.map(), {}, Geodesic_joining());
    split_along_boundaries(mesh, curves, labels.map());
    const Surface_measures after = measures(mesh, labels);
    EXPECT_NEAR(after.area, before.area, 1e-12 * before.area);
    EXPECT_EQ(after.regions, before.regions);
  }
}

TEST(SplitAlongBoundariesOf, NewVerticesLieOnOldEdges) {
  const Shape shape = bumpy_torus();
  const Surface_mesh before = meshes::surface_mesh(shape);
  Surface_mesh mesh = before;
  Growing_face_labels<Surface_mesh> labels(mesh, random_cells(shape, 9));
  const Split_report report = refine(mesh, labels);
  ASSERT_EQ(mesh.number_of_vertices(), before.number_of_vertices() + report.vertices_added);
  for (const auto v : before.vertices()) EXPECT_EQ(mesh.point(v), before.point(v));
  for (std::size_t i = before.number_of_vertices(); i < mesh.number_of_vertices(); ++i) {
    const Eigen::Vector3d p = point(mesh, Surface_mesh::Vertex_index(static_cast<Surface_mesh::size_type>(i)));
    double distance = std::numeric_limits<double>::infinity();
    for (const auto e : before.edges())
      distance = std::min(distance,
                          distance_to_line(p, point(before, before.vertex(e, 0)), point(before, before.vertex(e, 1))));
    EXPECT_LT(distance, 1e-14);
  }
}

TEST(SplitAlongBoundariesOf, MeshesOfCgalKeepSurfaceAndSegments) {
  for (const char* name : {"elephant.off", "fandisk.off"}) {
    auto mesh = meshes::data_mesh(name);
    if (!mesh) GTEST_SKIP() << "CGAL's data meshes are not installed";
    const Eigen::Vector3d origin = point(*mesh, *mesh->vertices_begin());
    Labels by_place;
    for (const auto f : mesh->faces()) {
      const Eigen::Vector3d p = 10 * (point(*mesh, mesh->target(mesh->halfedge(f))) - origin);
      by_place.push_back(static_cast<std::size_t>(static_cast<long>(std::floor(p.x()) + 2 * std::floor(p.y())) & 3));
    }
    Growing_face_labels<Surface_mesh> labels(*mesh, by_place);
    EXPECT_GT(refine(*mesh, labels).faces_added, 100u);
  }
}

TEST(SplitAlongBoundariesOf, NoSegmentGetsToTheOtherSideOfAWall) {
  std::size_t added = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const Shape shape = seed % 2 == 0 ? bumpy_torus() : meshes::with_noise(meshes::sphere(3), 0.01);
    Surface_mesh mesh = meshes::surface_mesh(shape);
    const Labels sides = random_cells(shape, 3, seed), cells = random_cells(shape, 8, seed + 100);
    const Labels segments = products(sides, cells);
    std::map<std::size_t, std::size_t> side_of;  // a segment
    for (std::size_t f = 0; f < sides.size(); ++f) side_of[segments[f]] = sides[f];
    Edge_marks walls = edges_between(mesh, sides);
    Growing_face_labels<Surface_mesh> labels(mesh, segments);
    const auto areas = [&] {
      std::map<std::size_t, double> area;  // of a side
      for (const auto f : mesh.faces()) {
        const auto h = mesh.halfedge(f);
        const Eigen::Vector3d a = point(mesh, mesh.source(h));
        area[side_of.at(labels[f])] +=
            (point(mesh, mesh.target(h)) - a).cross(point(mesh, mesh.target(mesh.next(h))) - a).norm() / 2;
      }
      return area;
    };
    const auto before = areas();
    const auto is_wall = boost::make_assoc_property_map(walls);
    added += refine(mesh, labels, Traced_joining(), CGAL::parameters::edge_is_constrained_map(is_wall)).faces_added;
    for (const auto& [side, area] : areas()) EXPECT_NEAR(area, before.at(side), 1e-12);
    for (const auto e : mesh.edges()) {
      const auto f = mesh.face(mesh.halfedge(e, 0)), g = mesh.face(mesh.halfedge(e, 1));
      EXPECT_EQ(walls[e], side_of.at(labels[f]) != side_of.at(labels[g])) << "walls are whole";
    }
  }
  EXPECT_GT(added, 1000u);
}

TEST(SplitAlongBoundariesOf, WallsThatEndInSegmentsStayWhole) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Shape shape = seed % 2 == 0 ? bumpy_torus() : meshes::with_noise(meshes::plane(20), 0.004);
    Surface_mesh mesh = meshes::surface_mesh(shape);
    std::mt19937 random(seed);
    Edge_marks walls;
    for (const auto e : mesh.edges()) walls[e] = random() % 12 == 0;
    const auto is_wall = boost::make_assoc_property_map(walls);
    Growing_face_labels<Surface_mesh> labels(mesh, random_cells(shape, 6, seed));
    const auto curves = smooth_boundaries(mesh, labels.map(), {}, CGAL::parameters::edge_is_constrained_map(is_wall));
    for (const auto& curve : curves)
      for (const auto& p : curve.points) EXPECT_TRUE(p.position == 1 || !walls.at(mesh.edge(p.halfedge)));
    EXPECT_GT(refine(mesh, labels, Geodesic_joining(), CGAL::parameters::edge_is_constrained_map(is_wall)).faces_added,
              0u);
  }
}

TEST(SplitAlongBoundariesOf, CurvesAlongEdgesAddNothing) {
  const Shape shape = meshes::cube(6);
  Surface_mesh mesh = meshes::surface_mesh(shape);
  Labels six;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) six.push_back(f / 72);
  Growing_face_labels<Surface_mesh> labels(mesh, six);
  const Split_report report = refine(mesh, labels);
  EXPECT_EQ(report.faces_added, 0u);
  EXPECT_EQ(report.faces_relabelled, 0u);
}

TEST(SplitAlongBoundariesOf, WithoutCurvesNothingHappens) {
  Surface_mesh mesh = meshes::surface_mesh(meshes::sphere(2));
  Growing_face_labels<Surface_mesh> labels(mesh, Labels(num_faces(mesh), 4));
  const std::string before = description(mesh, labels);
  split_along_boundaries(mesh, Curves(), labels.map());
  EXPECT_TRUE(description(mesh, labels) == before) << "something has changed";
}

TEST(SplitAlongBoundariesOf, SecondRoundFindsTheCurvesOfTheFirst) {
  Two_halves halves;
  split_along_boundaries(halves.mesh, halves.curves, halves.labels.map());
  Boundary_smoothing none;
  none.largest_displacement = 0;
  const Curves again = smooth_boundaries(halves.mesh, halves.labels.map(), none);
  ASSERT_EQ(again.size(), 1u);
  auto expected = points_of(halves.curves[0]), points = points_of(again[0]);
  if ((points.front() - expected.front()).norm() > 1e-9) std::reverse(points.begin(), points.end());
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((points[i] - expected[i]).norm(), 1e-12);
}

TEST(SplitAlongBoundariesOf, ACurveMayTouchAnEdgeAndTurnBack) {
  Two_halves halves;
  Surface_mesh& mesh = halves.mesh;
  auto& points = halves.curves[0].points;
  bool is_touched = false;
  for (std::size_t i = 1; i < points.size() && !is_touched; ++i) {
    if (points[i - 1].position == 1 || points[i].position == 1) continue;
    for (const auto h : mesh.halfedges()) {  // the third edge of the face that is crossed
      const std::set<Surface_mesh::Edge_index> others = {mesh.edge(mesh.next(h)), mesh.edge(mesh.prev(h))};
      if (mesh.is_border(mesh.edge(h)) ||
          others != std::set{mesh.edge(points[i - 1].halfedge), mesh.edge(points[i].halfedge)})
        continue;
      points.insert(points.begin() + static_cast<std::ptrdiff_t>(i),
                    {h, 0.5, CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)))});
      is_touched = true;
      break;
    }
  }
  ASSERT_TRUE(is_touched);
  const auto vertices = static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [](const auto& p) { return p.position < 1; }));
  const Surface_measures before = measures(mesh, halves.labels);
  const Split_report report = split_along_boundaries(mesh, halves.curves, halves.labels.map());
  EXPECT_EQ(report.vertices_added, vertices);
  EXPECT_TRUE(CGAL::is_valid_polygon_mesh(mesh));
  EXPECT_TRUE(CGAL::is_triangle_mesh(mesh)) << "the face beyond is cut, too";
  const Surface_measures after = measures(mesh, halves.labels);
  EXPECT_NEAR(after.area, before.area, 1e-12);
  EXPECT_EQ(after.regions, before.regions);
}

// ---- The visitor ----

namespace {

/// Carries to each face the face it was part of, and to each new vertex its place by interpolation.
struct Origin_visitor : Default_split_visitor<Surface_mesh> {
  struct State {
    std::map<Surface_mesh::Face_index, Surface_mesh::Face_index> parent;
    Surface_mesh::Face_index divided;
    std::vector<Eigen::Vector3d> expected_vertices;
    Eigen::Vector3d next_vertex;
    std::size_t edges = 0, faces = 0;
  };
  std::shared_ptr<State> state = std::make_shared<State>();

  void before_edge_split(Surface_mesh::Halfedge_index h, double position, const Surface_mesh& mesh) {
    state->next_vertex = (1 - position) * point(mesh, mesh.source(h)) + position * point(mesh, mesh.target(h));
  }
  void edge_split(Surface_mesh::Halfedge_index h, const Surface_mesh& mesh) {
    ++state->edges;
    EXPECT_LT((point(mesh, mesh.target(h)) - state->next_vertex).norm(), 1e-14);
  }
  void before_subface_creations(Surface_mesh::Face_index f, const Surface_mesh&) { state->divided = f; }
  void after_subface_created(Surface_mesh::Face_index f, const Surface_mesh&) {
    EXPECT_TRUE(state->parent.emplace(f, state->divided).second);
    ++state->faces;
  }
};

}  // namespace

TEST(SplitAlongBoundariesOf, VisitorCanCarryAttributes) {
  const Shape shape = bumpy_torus();
  const Surface_mesh before = meshes::surface_mesh(shape);
  Surface_mesh mesh = before;
  Growing_face_labels<Surface_mesh> labels(mesh, random_cells(shape, 9));
  const Origin_visitor visitor;
  const Split_report report = split_along_boundaries(mesh, smooth_boundaries(mesh, labels.map()), labels.map(),
                                                     CGAL::parameters::visitor(visitor));
  EXPECT_EQ(visitor.state->edges, report.vertices_added);
  EXPECT_EQ(visitor.state->faces, report.faces_added);

  const auto area = [](const Surface_mesh& m, Surface_mesh::Face_index f) {
    const auto h = m.halfedge(f);
    const Eigen::Vector3d a = point(m, m.source(h));
    return (point(m, m.target(h)) - a).cross(point(m, m.target(m.next(h))) - a).norm() / 2;
  };
  std::vector<double> sum(before.number_of_faces(), 0.);
  for (const auto f : mesh.faces()) {
    const auto found = visitor.state->parent.find(f);
    sum[found == visitor.state->parent.end() ? f : found->second] += area(mesh, f);
  }
  for (const auto f : before.faces()) EXPECT_NEAR(sum[f], area(before, f), 1e-12);
}

TYPED_TEST(SplitAlongBoundaries, BothPartsOfAMarkedEdgeAreMarked) {
  const Shape shape = meshes::plane(20);
  auto mesh = TypeParam(shape).mesh;
  using Mesh = decltype(mesh);
  Growing_face_labels<Mesh> labels(
      mesh, labels_by_place(shape, [](const Eigen::Vector3d& p) { return std::size_t(p.x() + 0.4 * p.y() > 0.72); }));
  const auto lies_on_line = [&](const auto& e) {
    return std::abs(point(mesh, source(e, mesh)).y() - 0.5) + std::abs(point(mesh, target(e, mesh)).y() - 0.5) < 1e-9;
  };
  std::map<typename boost::graph_traits<Mesh>::edge_descriptor, bool> marks;
  for (const auto e : edges(mesh)) marks[e] = lies_on_line(e);
  split_along_boundaries(mesh, smooth_boundaries(mesh, labels.map()), labels.map(),
                         CGAL::parameters::edge_is_constrained_map(boost::make_assoc_property_map(marks)));
  std::size_t on_line = 0;
  for (const auto e : edges(mesh)) {
    if (!lies_on_line(e)) continue;
    ++on_line;
    EXPECT_TRUE(marks[e]);
  }
  EXPECT_EQ(on_line, 21U);
}

// ---- What is refused, with nothing changed ----

TEST(SplitAlongBoundariesOf, CrossingCurvesAreRefused) {
  Two_halves halves;
  Curves curves = halves.curves;
  // The mirror image of the curve crosses it in the middle.
  const auto mirrored =
      labels_by_place(halves.shape, [](const Eigen::Vector3d& p) { return std::size_t(p.x() - 0.4 * p.y() > 0.3); });
  Growing_face_labels<Surface_mesh> other(halves.mesh, mirrored);
  curves.push_back(smooth_boundaries(halves.mesh, other.map()).at(0));
  expect_refused(halves.mesh, curves, halves.labels, "curve 0 crosses another one");
  curves[1] = curves[0];
  expect_refused(halves.mesh, curves, halves.labels);
}

TEST(SplitAlongBoundariesOf, CurvesThatDoNotBoundTheSegmentsAreRefused) {
  Two_halves halves;
  expect_refused(halves.mesh, {}, halves.labels, "the curves do not bound the segments");
  halves.curves[0].segments[0] = halves.curves[0].segments[1];
  expect_refused(halves.mesh, halves.curves, halves.labels);
}

TEST(SplitAlongBoundariesOf, CurvesWithGapsAreRefused) {
  Two_halves halves;
  Curves curves = halves.curves;
  auto& points = curves[0].points;
  points.erase(points.begin() + 5, points.begin() + 9);
  expect_refused(halves.mesh, curves, halves.labels);
  curves = halves.curves;
  curves[0].points.resize(1);
  expect_refused(halves.mesh, curves, halves.labels);
}

TEST(SplitAlongBoundariesOf, PositionsOffTheirEdgeAreRefused) {
  for (const double position : {-0.1, 1.1, std::nan("")}) {
    Two_halves halves;
    halves.curves[0].points[4].position = position;
    expect_refused(halves.mesh, halves.curves, halves.labels);
  }
}

TEST(SplitAlongBoundariesOf, TooLowTrianglesAreRefused) {
  Two_halves halves;
  auto& points = halves.curves[0].points;
  const auto crossing = std::find_if(points.begin(), points.end(), [](const auto& p) { return p.position < 1; });
  ASSERT_NE(crossing, points.end());
  crossing->position = 1e-9;
  expect_refused(halves.mesh, halves.curves, halves.labels);
}

TEST(SplitAlongBoundariesOf, QuadranglesAreRefused) {
  Surface_mesh mesh = meshes::surface_mesh(meshes::cube_of_quads());
  Growing_face_labels<Surface_mesh> labels(mesh, Labels(6, 0));
  expect_refused(mesh, {}, labels);
}

}  // namespace test_split_along_boundaries
