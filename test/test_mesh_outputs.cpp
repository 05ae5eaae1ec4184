// SPDX-License-Identifier: MIT

// What writers of meshes have in common. That other programs read their files, python/tests/test_files_of_tool.py shows.

#include "../examples/mesh_files.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace test_mesh_outputs {

namespace {

using mesh_files::Polygon_soup;
using mesh_files::Segmented_soup;
using Point = Polygon_soup::Point;
using Triangle = std::array<Polygon_soup::Index, 3>;

constexpr double pi = 3.14159265358979323846;

/// One polygon on the given corners.
std::vector<Triangle> triangles_of(const std::vector<Point>& corners) {
  std::vector<Polygon_soup::Index> face;
  for (std::size_t i = 0; i < corners.size(); ++i) face.push_back(static_cast<Polygon_soup::Index>(i));
  std::vector<Triangle> result;
  mesh_files::Ear_clipping clip(corners);
  clip(face, [&](auto a, auto b, auto c) { result.push_back({a, b, c}); });
  return result;
}

/// The sum of the areas seen along z, negative where a triangle is turned.
std::pair<double, double> areas(const std::vector<Point>& points, const std::vector<Triangle>& triangles) {
  double sum = 0, smallest = 0;
  for (const auto& [a, b, c] : triangles) {
    const auto u = points[b] - points[a], v = points[c] - points[a];
    const double area = (u.x() * v.y() - u.y() * v.x()) / 2;
    sum += area;
    smallest = std::min(smallest, area);
  }
  return {sum, smallest};
}

double area_of(const std::vector<Point>& polygon) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    area += (p.x() * q.y() - p.y() * q.x()) / 2;
  }
  return area;
}

std::string temporary_path(const std::string& name) {
  return (std::filesystem::temp_directory_path() / (std::to_string(std::random_device()()) + name)).string();
}

}  // namespace

TEST(Ear_clipping, TrianglesCoverPolygonsThatAreNotConvexOnceAndTurnAsTheyDo) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> radius(0.2, 1);
  for (const std::size_t corners : {4U, 5U, 8U, 30U, 300U})
    for (int round = 0; round < 20; ++round) {
      std::vector<Point> star;
      for (std::size_t i = 0; i < corners; ++i) {
        const double angle = 2 * pi * double(i) / double(corners), r = radius(random);
        star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.1 * r);
      }
      const auto triangles = triangles_of(star);
      EXPECT_EQ(triangles.size(), corners - 2);
      const auto [sum, smallest] = areas(star, triangles);
      EXPECT_NEAR(sum, area_of(star), 1e-12);
      EXPECT_GE(smallest, 0);
    }
}

TEST(Ear_clipping, EveryPolygonHasTwoTrianglesFewerThanCorners) {
  EXPECT_TRUE(triangles_of({}).empty());
  EXPECT_TRUE(triangles_of({{0, 0, 0}, {1, 0, 0}}).empty());
  EXPECT_EQ(triangles_of(std::vector<Point>(5, Point(1, 1, 1))).size(), 3U);
  EXPECT_EQ(triangles_of({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2U);  // crosses itself
  EXPECT_EQ(triangles_of({{0, 0, 0}, {1e200, 0, 0}, {1e200, 1e200, 0}, {0, 1e200, 0}}).size(), 2U);
  std::vector<Point> circle;
  for (int i = 0; i < 100000; ++i) circle.emplace_back(std::cos(i * pi / 50000), std::sin(i * pi / 50000), 0);
  EXPECT_EQ(triangles_of(circle).size(), 99998U);
}

TEST(Mesh_outputs, AnStlTextHasASolidForEachSegmentWithTheExactPoints) {
  Polygon_soup soup;
  soup.points = {{0.1, 0, 0}, {1. / 3, 0, 0}, {1, 1, 0}, {0, 1, 1e-300}};
  soup.corners = {0, 1, 2, 3, 0, 2, 3};
  soup.first_corner = {0, 4, 7};
  const std::vector<std::size_t> labels = {7, 2};
  const std::map<std::size_t, mesh_files::Color> colors = {{2, {1, 2, 3}}, {7, {4, 5, 6}}};
  const std::string path = temporary_path(".stl");
  mesh_files::Output_file file(path);
  mesh_files::write_text_stl(file, {soup, labels, colors});
  file.commit();
  const std::string content = mesh_files::read_content(path);
  EXPECT_EQ(content.find("solid segment_2\n"), 0U);
  EXPECT_NE(content.find("endsolid segment_2\nsolid segment_7\n"), std::string::npos);
  const Polygon_soup again = mesh_files::read_mesh(path);
  EXPECT_EQ(again.number_of_faces(), 3U);
  EXPECT_EQ(again.points.size(), 4U);
  for (const Point& p : again.points)
    EXPECT_NE(std::find(soup.points.begin(), soup.points.end(), p), soup.points.end());
  std::filesystem::remove(path);
}

TEST(Mesh_outputs, ShapesFarAwayAreKeptByGltf) {
  EXPECT_EQ(mesh_files::origin_for_floats({-1, 2, 3}, {1, 4, 250}), (std::array<double, 3>{0, 0, 0}));
  EXPECT_EQ(mesh_files::origin_for_floats({0, 0, 0}, {0, 0, 0}), (std::array<double, 3>{0, 0, 0}));
  Polygon_soup soup;
  soup.points = {{500000, 5400000, 0}, {500000.125, 5400000, 0}, {500000, 5400000.125, 0.125}};
  soup.corners = {0, 1, 2};
  soup.end_face();
  const std::vector<std::size_t> labels = {0};
  const std::map<std::size_t, mesh_files::Color> colors = {{0, {1, 2, 3}}};
  const std::string path = temporary_path(".glb");
  mesh_files::Output_file file(path);
  mesh_files::write_glb(file, {soup, labels, colors});
  file.commit();
  const std::string content = mesh_files::read_content(path);
  const auto value_of = [&](const std::string& name) {
    const std::size_t begin = content.find("\"" + name + "\":[") + name.size() + 4;
    return content.substr(begin, content.find(']', begin) - begin);
  };
  std::array<double, 3> middle;
  std::istringstream translation(value_of("translation"));
  char comma = 0;
  translation >> middle[0] >> comma >> middle[1] >> comma >> middle[2];
  std::istringstream most(value_of("max"));
  for (std::size_t i = 0; i < 3; ++i) {
    double largest = 0;
    most >> largest >> comma;
    const double expected = std::array{500000.125, 5400000.125, 0.125}[i];
    EXPECT_NEAR(middle[i] + largest, expected, 1e-7) << i;
  }
  std::filesystem::remove(path);
}

TEST(Mesh_outputs, CoordinatesTooLargeForAFormatAreRefused) {
  Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1e150, 0, 0}, {0, 1e150, 0}};
  soup.corners = {0, 1, 2};
  soup.end_face();
  const std::vector<std::size_t> labels = {0};
  const std::map<std::size_t, mesh_files::Color> colors = {{0, {1, 2, 3}}};
  const Segmented_soup mesh = {soup, labels, colors};
  const std::string path = temporary_path(".bin");
  mesh_files::Output_file file(path);
  EXPECT_THROW(mesh_files::write_binary_stl(file, mesh), mesh_files::Unwritable_file);
  EXPECT_THROW(mesh_files::write_glb(file, mesh), mesh_files::Unwritable_file);
}

}  // namespace test_mesh_outputs
