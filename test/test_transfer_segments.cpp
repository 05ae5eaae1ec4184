// SPDX-License-Identifier: MIT

#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/mesh/closest_face.h>
#include <RW_segmentation/internal/walk/spurious_regions.h>
#include <RW_segmentation/transfer_segments.h>

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>

#include <boost/property_map/function_property_map.hpp>

#include <gtest/gtest.h>
#include "face_labels.h"
#include "meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

namespace test_transfer_segments {

using namespace RW_segmentation;

namespace {

using Mesh = meshes::Surface_mesh;

/// Ids by the centroid of a face.
Face_labels<Mesh> labelled(const Mesh& mesh, const std::function<std::size_t(const Eigen::Vector3d&)>& id) {
  Face_labels<Mesh> labels(mesh);
  for (const auto f : mesh.faces()) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      sum += Eigen::Vector3d(mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2]);
    put(labels.map(), f, id(sum / 3));
  }
  return labels;
}

/// All edges alike, so that walks are drawn to no feature.
auto even_conductance() {
  return as_conductance(boost::make_function_property_map<Mesh::Edge_index>([](Mesh::Edge_index) { return 1.; }));
}

template <class Conductances>
std::vector<std::size_t> transferred(const Mesh& reduced, Face_labels<Mesh> ids, const Mesh& mesh,
                                     const Conductances& conductance, std::size_t band) {
  Face_labels<Mesh> result(mesh);
  transfer_segments(reduced, ids.map(), mesh, conductance, result.map(), band);
  return result.values();
}

template <class Holder>
class Transfer : public testing::Test {};
TYPED_TEST_SUITE(Transfer, meshes::Holders);

}  // namespace

TYPED_TEST(Transfer, GivesASubdividedMeshTheIdsOfTheFacesItWasMadeOf) {
  const meshes::Shape coarse = meshes::sphere(2);
  const TypeParam reduced(coarse), full(meshes::subdivided(coarse));
  Face_labels<typename TypeParam::Mesh> ids(reduced.mesh), result(full.mesh);
  std::size_t number = 0;
  for (const auto f : faces(reduced.mesh)) put(ids.map(), f, number++);
  const auto conductance = as_conductance(
      boost::make_function_property_map<typename boost::graph_traits<typename TypeParam::Mesh>::edge_descriptor>(
          [](const auto&) { return 1.; }));
  EXPECT_EQ(transfer_segments(reduced.mesh, ids.map(), full.mesh, conductance, result.map(), 0), coarse.faces.size());
  for (const std::size_t id : ids.values())
    EXPECT_EQ(std::count(result.values().begin(), result.values().end(), id), 4) << id;
}

TEST(TransferSegments, TheSidesOfAThinSheetStayApart) {
  const auto sheet = [](std::size_t n) {
    const Eigen::Affine3d flat(Eigen::Scaling(1., 1., 1e-3));
    return meshes::surface_mesh(meshes::transformed(meshes::cube(n), flat));
  };
  const Mesh reduced = sheet(3), mesh = sheet(20);
  const auto side = [](const Eigen::Vector3d& p) -> std::size_t { return p[2] > 0.5e-3 ? 1 : 0; };
  const auto ids = transferred(reduced, labelled(reduced, side), mesh, even_conductance(), 0);
  const auto expected = labelled(mesh, side).values();
  for (const auto f : mesh.faces()) {
    const auto normal = CGAL::cross_product(
        mesh.point(mesh.target(mesh.halfedge(f))) - mesh.point(mesh.source(mesh.halfedge(f))),
        mesh.point(mesh.target(mesh.next(mesh.halfedge(f)))) - mesh.point(mesh.source(mesh.halfedge(f))));
    if (normal[2] * normal[2] < 0.5 * (normal * normal)) continue;  // the rim
    EXPECT_EQ(ids[f], expected[f]) << f;
  }
}

TEST(TransferSegments, ABoundaryMovesToTheCreaseOfTheFullMesh) {
  // The reduced mesh has its boundary beside the fold at x = 0.
  const Mesh mesh = meshes::surface_mesh(meshes::folded_strip(-1, 40));
  const auto crease = labelled(mesh, [](const Eigen::Vector3d& p) -> std::size_t { return p[0] > 0; });
  const auto beside = labelled(mesh, [](const Eigen::Vector3d& p) -> std::size_t { return p[0] > 0.07; });
  const Conductance<Mesh> conductance(mesh, Dihedral_difference<Mesh>(mesh));
  EXPECT_EQ(transferred(mesh, beside, mesh, conductance, 0), beside.values());
  EXPECT_EQ(transferred(mesh, beside, mesh, conductance, 16), crease.values());
  constexpr std::size_t beyond_the_mesh = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(transferred(mesh, beside, mesh, conductance, beyond_the_mesh),
            transferred(mesh, beside, mesh, conductance, mesh.number_of_faces()));
}

TEST(TransferSegments, ABandOfOneFaceTakesInATooth) {
  const Mesh mesh = meshes::surface_mesh(meshes::plane(11));
  auto ids = labelled(mesh, [](const Eigen::Vector3d& p) -> std::size_t { return p[0] > 0.501; });
  const auto tooth = [&] {  // in the middle, all but one of its neighbours on the other side
    for (const auto f : mesh.faces())
      for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
        const auto& p = mesh.point(mesh.source(h));
        const auto g = mesh.face(mesh.opposite(h));
        if (std::abs(p[1] - 0.5) < 0.1 && g != Mesh::null_face() && get(ids.map(), f) != get(ids.map(), g)) return f;
      }
    return Mesh::null_face();
  }();
  const std::size_t other = 1 - get(ids.map(), tooth);
  put(ids.map(), tooth, other);
  auto before = ids;
  for (const std::size_t band : {0u, 1u}) {
    Face_labels<Mesh> result(mesh);
    transfer_segments(mesh, before.map(), mesh, even_conductance(), result.map(), band);
    EXPECT_EQ(get(result.map(), tooth), band == 0 ? other : 1 - other);
  }
}

TEST(TransferSegments, SegmentsOfACoarserMeshStayInOnePiece) {
  const Mesh mesh = meshes::surface_mesh(meshes::sphere(4));
  const Mesh reduced = meshes::surface_mesh(meshes::sphere(2));
  Face_labels<Mesh> result(mesh);
  transfer_segments(reduced, labelled(reduced, [](const Eigen::Vector3d& p) -> std::size_t { return p[2] > 0; }).map(),
                    mesh, even_conductance(), result.map(), 3);
  const Dual_mesh_of dual(mesh);
  const internal::Components pieces(dual.graph(), [&](Dual_mesh::Index e) {
    const auto [f, g] = dual.graph().faces_of(e);
    return get(result.map(), dual.face(f)) == get(result.map(), dual.face(g));
  });
  EXPECT_EQ(pieces.count, 2u);
}

TEST(TransferSegments, OfEachLabelAsManyRegionsAreTrustedAsTheReducedMeshHas) {
  const Dual_graph row(7, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}});
  const std::vector<std::size_t> labels = {0, 0, 1, 0, 1, 1, 0};
  const auto spurious = [&](std::size_t regions_of_0, std::size_t regions_of_1) {
    const internal::Components regions(
        row, [&](Dual_graph::Index e) { return labels[row.faces_of(e)[0]] == labels[row.faces_of(e)[1]]; });
    return internal::faces_of_spurious_regions(regions, {1, 1, 9, 3, 1, 1, 4}, labels,
                                               {{0, regions_of_0}, {1, regions_of_1}});
  };
  EXPECT_EQ(spurious(3, 2), (std::vector<char>{0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(spurious(1, 1), (std::vector<char>{1, 1, 0, 1, 1, 1, 0}));
  EXPECT_EQ(spurious(2, 1), (std::vector<char>{1, 1, 0, 0, 1, 1, 0}));
}

TEST(TransferSegments, ASegmentNarrowerThanTheBandIsKept) {
  const Mesh mesh = meshes::surface_mesh(meshes::tube(1, 60, 60));
  const auto ring = labelled(mesh, [](const Eigen::Vector3d& p) -> std::size_t {
    return p[2] < 0.48 ? 10 : p[2] < 0.55 ? 20 : 30;
  });
  const auto ids = transferred(mesh, ring, mesh, even_conductance(), 20);
  EXPECT_EQ(std::set<std::size_t>(ids.begin(), ids.end()), (std::set<std::size_t>{10, 20, 30}));
}

TEST(TransferSegments, IdsAreWrittenAsTheyWere) {
  const Mesh mesh = meshes::surface_mesh(meshes::sphere(2));
  const std::size_t large = std::numeric_limits<std::size_t>::max();
  const auto halves = labelled(mesh, [&](const Eigen::Vector3d& p) -> std::size_t { return p[2] > 0 ? large : 5; });
  EXPECT_EQ(transferred(mesh, halves, mesh, even_conductance(), 0), halves.values());
  const auto ids = transferred(mesh, halves, mesh, even_conductance(), 2);
  EXPECT_EQ(std::set<std::size_t>(ids.begin(), ids.end()), (std::set<std::size_t>{5, large}));
}

TEST(TransferSegments, DoesNotDependOnPlaceAndScaleOfBothMeshes) {
  const meshes::Shape coarse = meshes::sphere(2), fine = meshes::sphere(4);
  const auto half = [](const Eigen::Vector3d& p) -> std::size_t { return p[2] > 0; };
  const Mesh reduced = meshes::surface_mesh(coarse), mesh = meshes::surface_mesh(fine);
  const auto ids = labelled(reduced, half);
  const auto here = transferred(reduced, ids, mesh, even_conductance(), 3);
  const auto away = [](const meshes::Shape& shape) {
    return meshes::surface_mesh(meshes::moved(meshes::scaled(shape, 1024), Eigen::Vector3d(4096, -8192, 2048)));
  };
  const Mesh moved = away(coarse), moved_full = away(fine);
  Face_labels<Mesh> moved_labels(moved);
  for (const auto f : moved.faces()) put(moved_labels.map(), f, ids.values()[f]);
  const auto there = transferred(moved, moved_labels, moved_full, even_conductance(), 3);
  std::size_t different = 0;
  for (std::size_t f = 0; f < here.size(); ++f) different += here[f] != there[f];
  EXPECT_LE(different, here.size() / 200);
}

TEST(TransferSegments, ClosestFacesAreThoseOfASearchThroughAll) {
  const Mesh mesh = meshes::surface_mesh(meshes::torus(1, 0.4, 30, 20));
  const Dual_mesh_of dual(mesh);
  std::vector<internal::Fan_triangle> triangles;
  for (Dual_mesh::Index f = 0; f < dual.number_of_faces(); ++f) {
    const auto [a, b, c] =
        std::array{dual.point(dual.corners(f)[0]), dual.point(dual.corners(f)[1]), dual.point(dual.corners(f)[2])};
    triangles.push_back({a, b - a, c - a, f});
  }
  const internal::Triangle_tree tree(dual);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-0.6, 0.6);
  using Kernel = CGAL::Simple_cartesian<double>;
  const auto kernel_point = [](const Eigen::Vector3d& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
  for (int trial = 0; trial < 500; ++trial) {
    const Eigen::Vector3d p(coordinate(random), coordinate(random), coordinate(random));
    const Eigen::Vector3d direction(coordinate(random), coordinate(random), coordinate(random));
    double least = std::numeric_limits<double>::infinity();
    const auto distance_to = [&](const internal::Fan_triangle& t) {
      return CGAL::squared_distance(kernel_point(p),
                                    Kernel::Triangle_3(kernel_point(t.corner), kernel_point(t.corner + t.first_side),
                                                       kernel_point(t.corner + t.second_side)));
    };
    for (const auto& t : triangles)
      if (t.first_side.cross(t.second_side).dot(direction) > 0) least = std::min(least, distance_to(t));
    const auto found = tree.closest_face(p, direction);
    ASSERT_TRUE(found);
    const internal::Fan_triangle& closest = triangles[found->face];
    EXPECT_DOUBLE_EQ(distance_to(closest), least);
    EXPECT_EQ(found->squared_distance, least);
    EXPECT_GT(closest.first_side.cross(closest.second_side).dot(direction), 0);
  }
}

TEST(TransferSegments, TakesMeshesThatHaveBeenRead) {
  const Mesh mesh = meshes::surface_mesh(meshes::sphere(4)), reduced = meshes::surface_mesh(meshes::sphere(2));
  const auto halves = labelled(reduced, [](const Eigen::Vector3d& p) -> std::size_t { return p[2] > 0; });
  Face_labels<Mesh> result(mesh);
  transfer_segments(Dual_mesh_of(reduced), Face_labels<Mesh>(halves).map(), Dual_mesh_of(mesh), even_conductance(),
                    result.map(), 3);
  EXPECT_EQ(result.values(), transferred(reduced, halves, mesh, even_conductance(), 3));
}

TEST(TransferSegments, ABoundaryDoesNotMoveOverConstrainedEdges) {
  // The reduced mesh has its boundary along the constrained edges, the walk alone would move it to the fold.
  const Mesh mesh = meshes::surface_mesh(meshes::folded_strip(-1, 40));
  const auto beside = labelled(mesh, [](const Eigen::Vector3d& p) -> std::size_t { return p[0] > 0.07; });
  const auto ids = Face_labels<Mesh>(beside).values();
  std::vector<bool> is_wall(mesh.num_edges());
  for (const auto e : mesh.edges())
    is_wall[e] =
        !mesh.is_border(e) && ids[mesh.face(mesh.halfedge(e))] != ids[mesh.face(mesh.opposite(mesh.halfedge(e)))];
  const auto walls = boost::make_function_property_map<Mesh::Edge_index>(
      [&](Mesh::Edge_index e) { return static_cast<bool>(is_wall[e]); });
  const Conductance<Mesh> conductance(mesh, Dihedral_difference<Mesh>(mesh));
  Face_labels<Mesh> result(mesh);
  transfer_segments(mesh, Face_labels<Mesh>(beside).map(), mesh, conductance, result.map(), 16,
                    CGAL::parameters::edge_is_constrained_map(walls));
  EXPECT_EQ(result.values(), ids);
}

TEST(TransferSegments, DoesNotDependOnThreads) {
  const Mesh reduced = meshes::surface_mesh(meshes::sphere(3)), full = meshes::surface_mesh(meshes::sphere(4));
  auto ids =
      labelled(reduced, [](const Eigen::Vector3d& p) { return std::size_t(p.x() > 0) + 2 * std::size_t(p.y() > 0); });
  Face_labels<Mesh> with_one(full), with_all(full);
  transfer_segments<CGAL::Sequential_tag>(reduced, ids.map(), full, even_conductance(), with_one.map());
  transfer_segments<CGAL::Parallel_if_available_tag>(reduced, ids.map(), full, even_conductance(), with_all.map());
  EXPECT_EQ(with_one.values(), with_all.values());
  EXPECT_EQ(std::set<std::size_t>(with_one.values().begin(), with_one.values().end()).size(), 4u);
}

TEST(TransferSegments, WithoutAFaceToTakeIdsFromNothingIsWritten) {
  const Mesh mesh = meshes::surface_mesh(meshes::sphere(1)), empty;
  Face_labels<Mesh> ids(empty), result(mesh);
  EXPECT_THROW(transfer_segments(empty, ids.map(), mesh, even_conductance(), result.map()), std::invalid_argument);
  EXPECT_EQ(result.values().front(), result.untouched);
  Face_labels<Mesh> from(mesh), none(empty);
  EXPECT_EQ(transfer_segments(mesh, from.map(), empty, even_conductance(), none.map()), 0u);
}

TEST(TransferSegments, TheCallbackSeesProgressAndCancels) {
  const Mesh mesh = meshes::surface_mesh(meshes::sphere(3));
  const auto halves = labelled(mesh, [](const Eigen::Vector3d& p) -> std::size_t { return p[2] > 0; });
  for (const double end : {0.2, 0.6}) {
    Face_labels<Mesh> result(mesh);
    const std::function<bool(double)> callback = [end](double fraction) { return fraction < end; };
    EXPECT_THROW(transfer_segments(mesh, Face_labels<Mesh>(halves).map(), mesh, even_conductance(), result.map(), 4,
                                   CGAL::parameters::callback(callback)),
                 Cancelled);
    EXPECT_EQ(result.values().front(), result.untouched);
  }
}

}  // namespace test_transfer_segments
