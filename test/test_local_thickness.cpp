// SPDX-License-Identifier: MIT

#include <RW_segmentation/local_thickness.h>

#include <CGAL/mesh_segmentation.h>

#include <boost/property_map/property_map.hpp>

#include <gtest/gtest.h>
#include "meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace test_local_thickness {

using namespace RW_segmentation;

namespace {

constexpr double untouched = -1;

/// The thickness of each face of a mesh, in the order of `faces(mesh)`, and how many were measured.
struct Measured {
  std::vector<double> thickness;
  std::size_t faces = 0;
};

template <class Mesh>
Measured measured(const Mesh& mesh, const Thickness_sampling& sampling = {}) {
  std::map<typename boost::graph_traits<Mesh>::face_descriptor, double> values;
  for (const auto f : faces(mesh)) values[f] = untouched;
  Measured result;
  result.faces = local_thickness(mesh, boost::make_assoc_property_map(values), sampling);
  for (const auto f : faces(mesh)) result.thickness.push_back(values.at(f));
  return result;
}
Measured measured(const meshes::Shape& shape, const Thickness_sampling& sampling = {}) {
  return measured(meshes::surface_mesh(shape), sampling);
}

/// As many samples as there are faces of equal area, and a single ray against the normal.
Thickness_sampling straight(std::size_t samples) { return {samples, 1, 0}; }

/// The thickness of all faces, in the order of `faces(mesh)`.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Mesh,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
std::vector<double> of_all_faces(const Mesh& mesh, const Thickness_of_faces& numbers = {},
                                 Thickness_report* report = nullptr,
                                 const NamedParameters& np = CGAL::parameters::default_values()) {
  std::map<typename boost::graph_traits<Mesh>::face_descriptor, double> values;
  const Thickness_report result =
      thickness_of_all_faces<ConcurrencyTag>(mesh, boost::make_assoc_property_map(values), numbers, np);
  if (report) *report = result;
  std::vector<double> thickness;
  for (const auto f : faces(mesh)) thickness.push_back(values.at(f));
  return thickness;
}

Thickness_of_faces straight_rays() {
  Thickness_of_faces numbers;
  numbers.rays = 1;
  numbers.cone_angle = 0;
  return numbers;
}

Thickness_of_faces smoothed(Thickness_scale scale) {
  Thickness_of_faces numbers;
  numbers.is_smoothed = true;
  numbers.scale = scale;
  return numbers;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.) / n,
               mean_b = std::accumulate(b.begin(), b.end(), 0.) / n;
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

/// A box without its top: rays from its bottom leave nowhere. Sides are 1 and 0.5 wide.
struct Open_box {
  Open_box() {
    const meshes::Shape box = meshes::cube(4);
    for (const Eigen::Vector3d& p : box.points) shape.points.emplace_back(p.x(), p.y() / 2, p.z());
    for (const auto& face : box.faces) {
      const auto is_at = [&](double z) {
        return std::all_of(face.begin(), face.end(), [&](std::size_t v) { return shape.points[v].z() == z; });
      };
      if (is_at(1)) continue;
      is_bottom.push_back(is_at(0));
      shape.faces.push_back(face);
    }
  }
  meshes::Shape shape;
  std::vector<bool> is_bottom;  // by face
};

template <class Holder>
class Local_thickness_of : public testing::Test {};
TYPED_TEST_SUITE(Local_thickness_of, meshes::Holders);

}  // namespace

TEST(LocalThickness, OfABoxIsItsExtentAlongTheNormal) {
  meshes::Shape box = meshes::cube(6);
  const Eigen::Vector3d extent(1, 0.5, 0.1);
  for (Eigen::Vector3d& p : box.points) p = p.cwiseProduct(extent);
  const Measured result = measured(box, straight(100000));  // every face
  ASSERT_EQ(result.faces, box.faces.size());
  for (std::size_t f = 0; f < box.faces.size(); ++f) {
    const auto& face = box.faces[f];
    const Eigen::Vector3d normal =
        (box.points[face[1]] - box.points[face[0]]).cross(box.points[face[2]] - box.points[face[0]]).normalized();
    EXPECT_NEAR(result.thickness[f], normal.cwiseAbs().dot(extent), 1e-12);
  }
}

TEST(LocalThickness, OfBodiesThatTouchIsThatOfEach) {
  const meshes::Shape bodies = meshes::together(meshes::cube(3), meshes::moved(meshes::cube(3), {1, 0, 0}));
  for (const double thickness : measured(bodies, straight(100000)).thickness) EXPECT_NEAR(thickness, 1, 1e-12);
}

TEST(LocalThickness, OfASphereIsTheMedianChordOfTheCone) {
  const Measured result = measured(meshes::sphere(5));
  const double middle_ray = 0.5 * std::sqrt(3. / 6);  // of seven that are spread evenly over the cone
  EXPECT_GT(result.faces, 450u);
  for (const double thickness : result.thickness)
    if (thickness > 0) {
      EXPECT_NEAR(thickness, 2 * std::cos(middle_ray), 0.01);
    }
}

TEST(LocalThickness, IsMeasuredOnFacesThatAreSpreadOverTheArea) {
  const meshes::Shape fine = meshes::sphere(5), coarse = meshes::moved(meshes::sphere(4), {3, 0, 0});
  const Measured result = measured(meshes::together(fine, coarse), {400, 1, 0});
  std::size_t on_fine = 0, on_both = 0;
  for (std::size_t f = 0; f < result.thickness.size(); ++f) {
    on_both += result.thickness[f] > 0;
    on_fine += f < fine.faces.size() && result.thickness[f] > 0;
  }
  EXPECT_EQ(on_both, result.faces);
  EXPECT_LE(on_both, 400u);
  EXPECT_GE(on_both, 360u);
  EXPECT_NEAR(static_cast<double>(on_fine), 200, 20);
}

TEST(LocalThickness, ScalesAndTurnsWithTheMesh) {
  const meshes::Shape shape = meshes::two_spheres_with_neck(2.4, 0.3, 24);
  const Measured expected = measured(shape, straight(2000));
  for (const double factor : {1e-100, 7., 1e100}) {
    const Measured result =
        measured(meshes::scaled(meshes::transformed(shape, meshes::some_rotation()), factor), straight(2000));
    double difference = 0;  // the order of the samples turns, too
    std::size_t both = 0;
    for (std::size_t f = 0; f < result.thickness.size(); ++f)
      if (result.thickness[f] > 0 && expected.thickness[f] > 0) {
        difference += std::abs(result.thickness[f] / factor - expected.thickness[f]);
        ++both;
      }
    EXPECT_GT(both, 500u);
    EXPECT_LT(difference / static_cast<double>(both), 1e-3);
  }
}

TEST(LocalThickness, IsUnknownWhereNoRayLeavesTheSolid) {
  const Measured result = measured(meshes::plane(5));
  EXPECT_EQ(result.faces, 0u);
  EXPECT_EQ(result.thickness, std::vector<double>(50, 0.));
}

TYPED_TEST(Local_thickness_of, AnyMeshIsThatOfASurfaceMesh) {
  const meshes::Shape shape = meshes::two_spheres_with_neck(2.4, 0.3, 20);
  const TypeParam held(shape);
  const Measured result = measured(held.mesh), expected = measured(shape);
  EXPECT_EQ(result.faces, expected.faces);
  for (std::size_t f = 0; f < shape.faces.size(); ++f) EXPECT_NEAR(result.thickness[f], expected.thickness[f], 1e-9);
}

TEST(LocalThickness, RefusesNumbersOutOfRangeAndWritesNothing) {
  const auto mesh = meshes::surface_mesh(meshes::cube(2));
  std::vector<double> values(mesh.number_of_faces(), untouched);
  const auto map = boost::make_iterator_property_map(values.begin(), get(boost::face_index, mesh));
  for (const Thickness_sampling& sampling :
       {Thickness_sampling{500, 0, 0.5}, Thickness_sampling{500, 7, -0.1}, Thickness_sampling{500, 7, meshes::pi / 2}})
    EXPECT_THROW(local_thickness(mesh, map, sampling), std::invalid_argument);
  meshes::Shape bad = meshes::cube(2);
  bad.points[3].z() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(local_thickness(meshes::surface_mesh(bad), map), std::invalid_argument);
  EXPECT_EQ(values, std::vector<double>(values.size(), untouched));
}

TEST(LocalThickness, CanBeCancelled) {
  const auto mesh = meshes::surface_mesh(meshes::sphere(4));
  std::vector<double> values(mesh.number_of_faces(), untouched);
  const auto map = boost::make_iterator_property_map(values.begin(), get(boost::face_index, mesh));
  const std::function<bool(double)> cancel = [](double) { return false; };
  EXPECT_THROW(local_thickness(mesh, map, {}, CGAL::parameters::callback(cancel)), Cancelled);
  EXPECT_EQ(values, std::vector<double>(values.size(), untouched));
}

TEST(ThicknessOfAllFaces, OfABoxIsItsExtentAlongTheNormal) {
  meshes::Shape box = meshes::cube(6);
  const Eigen::Vector3d extent(1, 0.5, 0.1);
  for (Eigen::Vector3d& p : box.points) p = p.cwiseProduct(extent);
  Thickness_report report;
  const std::vector<double> thickness = of_all_faces(meshes::surface_mesh(box), straight_rays(), &report);
  for (std::size_t f = 0; f < box.faces.size(); ++f) {
    const auto& face = box.faces[f];
    const Eigen::Vector3d normal =
        (box.points[face[1]] - box.points[face[0]]).cross(box.points[face[2]] - box.points[face[0]]).normalized();
    EXPECT_NEAR(thickness[f], normal.cwiseAbs().dot(extent), 1e-12);
  }
  EXPECT_NEAR(report.least, 0.1, 1e-12);
  EXPECT_NEAR(report.greatest, 1, 1e-12);
  EXPECT_EQ(report.gaps, 0u);
}

TEST(ThicknessOfAllFaces, OfACylinderIsTheDistanceOfOppositeSides) {
  constexpr std::size_t around = 32;
  for (const double thickness : of_all_faces(meshes::surface_mesh(meshes::tube(5, around, 20)), straight_rays()))
    EXPECT_NEAR(thickness, 2 * std::cos(meshes::pi / around), 1e-12);
}

TEST(ThicknessOfAllFaces, OfASphereIsTheMeanChordOfTheConeWithoutOutliers) {
  Thickness_of_faces numbers;
  numbers.rays = 3;
  // The slopes of the rays are 0, 1 and 2 thirds of that of the cone, sqrt(3), their chords 2, 2 cos(30 deg) = sqrt(3)
  // and 1.31. The last one is more than 1.5 times as far from the second as the first.
  for (const double thickness : of_all_faces(meshes::surface_mesh(meshes::sphere(5)), numbers))
    EXPECT_NEAR(thickness, (2 + std::sqrt(3.)) / 2, 0.01);
}

TEST(ThicknessOfAllFaces, FillsGapsFromNeighbours) {
  Open_box box;
  // A face without area beyond a border edge of the top.
  const auto on_top = [&](std::size_t v) { return box.shape.points[v].z() == 1; };
  for (const auto& face : box.shape.faces) {
    const auto side = std::find_if(face.begin(), face.end() - 1,
                                   [&](const std::size_t& v) { return on_top(v) && on_top(*(&v + 1)); });
    if (side == face.end() - 1) continue;
    const std::size_t a = *side, b = *(side + 1);
    box.shape.points.push_back((box.shape.points[a] + box.shape.points[b]) / 2);
    box.shape.faces.push_back({b, a, box.shape.points.size() - 1});
    break;
  }
  ASSERT_EQ(box.shape.faces.size(), box.is_bottom.size() + 1);
  Thickness_report report;
  const std::vector<double> thickness = of_all_faces(meshes::surface_mesh(box.shape), straight_rays(), &report);
  const auto bottom = static_cast<std::size_t>(std::count(box.is_bottom.begin(), box.is_bottom.end(), true));
  EXPECT_EQ(report.gaps, bottom + 1);
  EXPECT_NEAR(report.least, 0.5, 1e-12);
  EXPECT_NEAR(report.greatest, 1, 1e-12);
  bool has_mean = false;
  for (const double t : thickness) {
    EXPECT_GE(t, report.least);
    has_mean = has_mean || (t > 0.6 && t < 0.9);
  }
  EXPECT_TRUE(has_mean) << "between a narrow and a wide side";
  EXPECT_TRUE(std::abs(thickness.back() - 0.5) < 1e-12 || std::abs(thickness.back() - 1) < 1e-12);
}

TEST(ThicknessOfAllFaces, FillsALongStripFromItsEnd) {
  // A flat strip, with a triangle that looks at it below one end: as many rings as squares.
  constexpr std::size_t squares = 20000;
  meshes::Shape strip;
  for (std::size_t i = 0; i <= squares; ++i)
    for (const double y : {0., 1.}) strip.points.emplace_back(static_cast<double>(i), y, 0.);
  for (std::size_t i = 0; i < squares; ++i) {
    const std::size_t v = 2 * i;
    strip.faces.push_back({v, v + 2, v + 3});
    strip.faces.push_back({v, v + 3, v + 1});
  }
  const std::size_t first = strip.points.size();
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, -1, -1), {1, 3, -1}, {2, -1, -1}}) strip.points.push_back(p);
  strip.faces.push_back({first, first + 1, first + 2});
  Thickness_report report;
  const std::vector<double> thickness = of_all_faces(meshes::surface_mesh(strip), straight_rays(), &report);
  EXPECT_GT(report.gaps, strip.faces.size() - 10);
  for (const double t : thickness) ASSERT_NEAR(t, 1, 1e-6);
}

TEST(ThicknessOfAllFaces, FillsNoGapAcrossWalls) {
  const Open_box box;
  const auto mesh = meshes::surface_mesh(box.shape);
  const auto is_bottom = [&](auto f) { return box.is_bottom[static_cast<std::size_t>(f)]; };
  std::map<meshes::Surface_mesh::Edge_index, bool> walls;
  for (const auto e : edges(mesh))
    walls[e] = !is_border(e, mesh) &&
               is_bottom(face(halfedge(e, mesh), mesh)) != is_bottom(face(opposite(halfedge(e, mesh), mesh), mesh));
  const std::vector<double> thickness = of_all_faces(
      mesh, straight_rays(), nullptr, CGAL::parameters::edge_is_constrained_map(boost::make_assoc_property_map(walls)));
  for (std::size_t f = 0; f < thickness.size(); ++f)
    if (box.is_bottom[f]) {
      EXPECT_NEAR(thickness[f], 0.5, 1e-12);  // the least of all
    }
}

TEST(ThicknessOfAllFaces, SmoothsNothingAcrossWalls) {
  const auto mesh = meshes::surface_mesh(meshes::two_spheres_with_neck(2.4, 0.3, 24));
  std::map<meshes::Surface_mesh::Edge_index, bool> walls;
  for (const auto e : edges(mesh)) walls[e] = true;
  const Thickness_of_faces numbers = smoothed(Thickness_scale::length);
  const std::vector<double> raw = of_all_faces(mesh);
  EXPECT_EQ(of_all_faces(mesh, numbers, nullptr,
                         CGAL::parameters::edge_is_constrained_map(boost::make_assoc_property_map(walls))),
            raw);
  EXPECT_NE(of_all_faces(mesh, numbers), raw);
}

TEST(ThicknessOfAllFaces, IsScaledFromZeroToOne) {
  const auto mesh = meshes::surface_mesh(meshes::two_spheres_with_neck(2.4, 0.3, 24));
  Thickness_report report, linear_report;
  Thickness_of_faces numbers;
  const std::vector<double> length = of_all_faces(mesh, numbers, &report);
  numbers.scale = Thickness_scale::linear;
  const std::vector<double> linear = of_all_faces(mesh, numbers, &linear_report);
  numbers.scale = Thickness_scale::logarithmic;
  const std::vector<double> logarithmic = of_all_faces(mesh, numbers);
  EXPECT_EQ(linear_report.least, report.least);
  EXPECT_EQ(linear_report.greatest, report.greatest);
  EXPECT_EQ(*std::min_element(linear.begin(), linear.end()), 0);
  EXPECT_EQ(*std::max_element(linear.begin(), linear.end()), 1);
  for (std::size_t f = 0; f < length.size(); ++f) {
    EXPECT_NEAR(report.least + linear[f] * (report.greatest - report.least), length[f], 1e-12);
    EXPECT_NEAR(logarithmic[f], std::log(1 + 5 * linear[f]) / std::log(6.), 1e-12);
  }
}

TEST(ThicknessOfAllFaces, DoesNotDependOnThreads) {
  const auto mesh = meshes::surface_mesh(meshes::with_noise(meshes::sphere(4), 0.01));
  for (const Thickness_of_faces& numbers : {Thickness_of_faces(), smoothed(Thickness_scale::logarithmic)})
    EXPECT_EQ(of_all_faces(mesh, numbers), of_all_faces<CGAL::Sequential_tag>(mesh, numbers));
}

TEST(ThicknessOfAllFaces, AgreesWithTheShapeDiametersOfCgal) {
  for (const char* name : {"hand.off", "cactus.off"}) {
    const auto mesh = meshes::data_mesh(name);
    if (!mesh) GTEST_SKIP() << "CGAL's data meshes are not installed";
    std::map<meshes::Surface_mesh::Face_index, double> diameter;
    CGAL::sdf_values(*mesh, boost::make_assoc_property_map(diameter));
    std::vector<double> expected;
    for (const auto& [face, value] : diameter) expected.push_back(value);
    const double agreement = correlation(of_all_faces(*mesh, smoothed(Thickness_scale::linear)), expected);
    EXPECT_GE(agreement, 0.98) << name;
    RecordProperty(name, std::to_string(agreement));
  }
}

TEST(ThicknessOfAllFaces, IsSmoothedAndScaledAsByCgal) {
  const auto mesh = meshes::data_mesh("elephant.off");
  if (!mesh) GTEST_SKIP() << "CGAL's data meshes are not installed";
  std::map<meshes::Surface_mesh::Face_index, double> expected;
  const auto map = boost::make_assoc_property_map(expected);
  ASSERT_EQ(thickness_of_all_faces(*mesh, map).gaps, 0u);
  const auto [least, greatest] = CGAL::sdf_values_postprocessing(*mesh, map);
  Thickness_report report;
  const std::vector<double> thickness = of_all_faces(*mesh, smoothed(Thickness_scale::linear), &report);
  EXPECT_NEAR(report.least, least, 1e-12);
  EXPECT_NEAR(report.greatest, greatest, 1e-12);
  for (const auto f : faces(*mesh)) EXPECT_NEAR(thickness[f], expected.at(f), 1e-9);
}

TYPED_TEST(Local_thickness_of, AllFacesOfAnyMeshIsThatOfASurfaceMesh) {
  const meshes::Shape shape = meshes::two_spheres_with_neck(2.4, 0.3, 20);
  const TypeParam held(shape);
  const Thickness_of_faces numbers = smoothed(Thickness_scale::linear);
  const std::vector<double> result = of_all_faces(held.mesh, numbers);
  const std::vector<double> expected = of_all_faces(meshes::surface_mesh(shape), numbers);
  for (std::size_t f = 0; f < shape.faces.size(); ++f) EXPECT_NEAR(result[f], expected[f], 1e-9);
}

TEST(ThicknessOfAllFaces, IsZeroWhereNoRayLeavesAnywhere) {
  Thickness_report report;
  EXPECT_EQ(of_all_faces(meshes::surface_mesh(meshes::plane(5)), smoothed(Thickness_scale::logarithmic), &report),
            std::vector<double>(50, 0.));
  EXPECT_EQ(report.gaps, 50u);
  EXPECT_TRUE(of_all_faces(meshes::Surface_mesh()).empty());
}

TEST(ThicknessOfAllFaces, TakesNamedParametersAfterTheOutput) {
  const auto mesh = meshes::surface_mesh(meshes::cube(3));
  std::vector<double> values(mesh.number_of_faces(), untouched);
  const auto map = boost::make_iterator_property_map(values.begin(), get(boost::face_index, mesh));
  const std::function<bool(double)> cancel = [](double) { return false; };
  EXPECT_THROW(thickness_of_all_faces(mesh, map, CGAL::parameters::callback(cancel)), Cancelled);
  EXPECT_THROW(local_thickness(mesh, map, CGAL::parameters::callback(cancel)), Cancelled);
  EXPECT_EQ(values, std::vector<double>(values.size(), untouched));
}

TEST(ThicknessOfAllFaces, RefusesNumbersOutOfRangeAndWritesNothing) {
  const auto mesh = meshes::surface_mesh(meshes::cube(2));
  std::vector<double> values(mesh.number_of_faces(), untouched);
  const auto map = boost::make_iterator_property_map(values.begin(), get(boost::face_index, mesh));
  for (const auto& [rays, cone_angle] : {std::pair(std::size_t(0), 0.5), {7, -0.1}, {7, meshes::pi / 2}}) {
    Thickness_of_faces numbers;
    numbers.rays = rays;
    numbers.cone_angle = cone_angle;
    EXPECT_THROW(thickness_of_all_faces(mesh, map, numbers), std::invalid_argument);
  }
  EXPECT_EQ(values, std::vector<double>(values.size(), untouched));
}

TEST(LocalThickness, OfAFaceThatOverlapsItselfIsNotKnown) {
  // The halves of a bow tie have areas that cancel each other, the triangles that fan it out have not.
  meshes::Shape bow_tie;
  bow_tie.points = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  bow_tie.faces = {{0, 1, 2, 3}};
  EXPECT_EQ(measured(bow_tie).thickness, std::vector<double>{0});
}

}  // namespace test_local_thickness
