#include <RW_segmentation/local_thickness.h>

#include <boost/property_map/property_map.hpp>

#include <gtest/gtest.h>
#include "meshes.h"

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

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
