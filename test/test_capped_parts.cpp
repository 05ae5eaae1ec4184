// SPDX-License-Identifier: MIT

// segment_mesh --cap-parts: parts that are cut from closed meshes are solids.

#include <gtest/gtest.h>

#ifndef SEGMENT_MESH

TEST(Capped_parts, AreSolids) { GTEST_SKIP() << "the tool is not built"; }

#else

#include "../examples/mesh_files.h"

#include "segment_mesh_tool.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace test_capped_parts {

namespace {

using namespace segment_mesh_tool;
using mesh_files::Polygon_soup;
using Outline = std::vector<std::array<double, 2>>;

constexpr double pi = 3.14159265358979323846;

/// A tower over outlines, the first of which turns left and is its outer side, and any others right, with quads in so many
/// storeys. A slope moves its upper end aside. Its ends are closed: the triangles are numbered within one storey's corners.
struct Tower {
  std::vector<Outline> outlines;
  std::vector<std::array<int, 3>> floor;
  int storeys = 4;
  /// How far the corner of the outlines, at a storey, is moved up.
  double (*rise)(double x, double y, int storey) = [](double, double, int) { return 0.; };

  int corners() const {
    std::size_t sum = 0;
    for (const Outline& outline : outlines) sum += outline.size();
    return static_cast<int>(sum);
  }

  std::string off() const {
    std::ostringstream points, faces;
    points.precision(17);
    int number_of_faces = 0;
    for (int storey = 0; storey <= storeys; ++storey) {
      int first = storey * corners();
      for (const Outline& outline : outlines) {
        const int n = static_cast<int>(outline.size());
        for (int i = 0; i < n; ++i) {
          const auto& [x, y] = outline[static_cast<std::size_t>(i)];
          points << x << ' ' << y << ' ' << storey + rise(x, y, storey) << '\n';
          if (storey == storeys) continue;
          const int a = first + i, b = first + (i + 1) % n;
          faces << "4 " << a << ' ' << b << ' ' << b + corners() << ' ' << a + corners() << '\n';
          ++number_of_faces;
        }
        first += n;
      }
    }
    for (const auto& [a, b, c] : floor) {
      const int top = storeys * corners();
      faces << "3 " << c << ' ' << b << ' ' << a << "\n3 " << top + a << ' ' << top + b << ' ' << top + c << '\n';
      number_of_faces += 2;
    }
    return "OFF\n" + std::to_string((storeys + 1) * corners()) + " " + std::to_string(number_of_faces) + " 0\n" +
           points.str() + faces.str();
  }

  /// Walls all around at a storey.
  std::string walls(int storey) const {
    std::ostringstream lines;
    int first = storey * corners();
    for (const Outline& outline : outlines) {
      const int n = static_cast<int>(outline.size());
      for (int i = 0; i < n; ++i) lines << first + i << ' ' << first + (i + 1) % n << '\n';
      first += n;
    }
    return lines.str();
  }
};

const Outline l_shape = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
const std::vector<std::array<int, 3>> l_floor = {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}};

Outline circle(std::size_t corners, double radius, bool is_turned) {
  Outline outline;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = (is_turned ? -2 : 2) * pi * double(i) / double(corners);
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return outline;
}

/// A pipe with a wall between two circles.
Tower pipe() {
  constexpr int n = 24;
  Tower tower = {{circle(n, 1, false), circle(n, 0.6, true)}, {}};
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n, inner_i = n + (n - i) % n, inner_j = n + (n - j) % n;
    tower.floor.push_back({i, j, inner_j});
    tower.floor.push_back({i, inner_j, inner_i});
  }
  return tower;
}

double volume_of(const Polygon_soup& soup) {
  double volume = 0;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const auto face = soup.face(f);
    for (int i = 2; i < static_cast<int>(face.size()); ++i)
      volume += CGAL::determinant(soup.points[face[0]] - CGAL::ORIGIN, soup.points[face[i - 1]] - CGAL::ORIGIN,
                                  soup.points[face[i]] - CGAL::ORIGIN) /
                6;
  }
  return volume;
}

/// Whether every edge has two faces, which pass it in opposite directions.
bool is_closed_and_oriented(const Polygon_soup& soup) {
  std::map<std::pair<std::size_t, std::size_t>, int> passes;
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f) {
    const auto face = soup.face(f);
    const int n = static_cast<int>(face.size());
    for (int i = 0; i < n; ++i) ++passes[{face[i], face[(i + 1) % n]}];
  }
  for (const auto& [edge, times] : passes) {
    const auto back = passes.find({edge.second, edge.first});
    if (times != 1 || back == passes.end() || back->second != 1) return false;
  }
  return !passes.empty();
}

}  // namespace

class Capped_parts : public Segment_mesh_tool {
 protected:
  /// Cuts the mesh and reads its parts.
  std::map<std::size_t, Polygon_soup> parts(const std::string& mesh, const std::vector<std::string>& options) {
    write("mesh.off", mesh);
    result_ = run(std::vector<std::string>{"mesh.off", "--split", "parts", "--output-format", "off", "--cap-parts",
                                           "--report", "report.json"} +
                  options);
    EXPECT_EQ(result_.exit_code, 0) << result_.errors;
    std::map<std::size_t, Polygon_soup> found;
    report_ = nlohmann::json::parse(content_of(path("report.json")));
    for (const auto& segment : report_["segments"]) {
      const std::size_t label = segment["label"];
      found[label] = mesh_files::read_mesh(path("parts/segment_" + std::to_string(label) + ".off"));
    }
    return found;
  }

  /// Cuts a tower at some of its storeys, so that it falls apart.
  std::map<std::size_t, Polygon_soup> parts_of_tower(const Tower& tower, const std::vector<int>& storeys) {
    std::string walls;
    for (const int storey : storeys) walls += tower.walls(storey);
    write("walls.txt", walls);
    auto found = parts(tower.off(), {"--constraints", "walls.txt", "--segments", std::to_string(storeys.size() + 1)});
    EXPECT_EQ(found.size(), storeys.size() + 1);
    return found;
  }

  void expect_solids(const std::map<std::size_t, Polygon_soup>& parts, double volume) {
    double sum = 0;
    for (const auto& [label, part] : parts) {
      EXPECT_TRUE(is_closed_and_oriented(part)) << label;
      EXPECT_GT(volume_of(part), 0) << label;
      sum += volume_of(part);
    }
    EXPECT_NEAR(sum, volume, 1e-12 * volume);
    for (const auto& segment : report_["segments"]) {
      EXPECT_EQ(segment["closed"], true);
      const double reported = segment["volume"];
      EXPECT_NEAR(reported, volume_of(parts.at(segment["label"])), 1e-9);
    }
  }

  Result result_;
  nlohmann::json report_;
};

TEST_F(Capped_parts, OfAMeshCutInPlanesAreSolidsWithItsVolume) {
  const auto found = parts_of_tower({{l_shape}, l_floor}, {1, 3});
  expect_solids(found, 20);
  std::vector<double> volumes;
  for (const auto& [label, part] : found) volumes.push_back(volume_of(part));
  std::sort(volumes.begin(), volumes.end());
  EXPECT_NEAR(volumes[0], 5, 1e-12);
  EXPECT_NEAR(volumes[1], 5, 1e-12);
  EXPECT_NEAR(volumes[2], 10, 1e-12);
}

TEST_F(Capped_parts, OfAPipeKeepItsBore) {
  const Tower tower = pipe();
  const auto found = parts_of_tower(tower, {1});
  const double section = 12 * (1 - 0.36) * std::sin(2 * pi / 24);
  expect_solids(found, 4 * section);
  // Nothing lies in the bore: all triangles of a cap are between the two circles.
  for (const auto& [label, part] : found) {
    EXPECT_NEAR(volume_of(part), std::round(volume_of(part) / section) * section, 1e-12);
    for (std::size_t f = 0; f < part.number_of_faces(); ++f) {
      const auto face = part.face(f);
      double x = 0, y = 0;
      for (const auto corner : face) {
        x += part.points[corner].x() / double(face.size());
        y += part.points[corner].y() / double(face.size());
      }
      EXPECT_GT(std::hypot(x, y), 0.55);
    }
  }
}

TEST_F(Capped_parts, WhoseCutsAreNotFlatHaveTheVolumeOfTheMesh) {
  Tower tower = {{circle(40, 2, false)}, {}};
  for (int i = 2; i < 40; ++i) tower.floor.push_back({0, i - 1, i});
  tower.rise = [](double x, double y, int storey) { return storey == 1 || storey == 3 ? 0.4 * std::sin(x * y) : 0.; };
  const auto found = parts_of_tower(tower, {1, 3});
  write("again.off", tower.off());
  expect_solids(found, volume_of(mesh_files::read_mesh(path("again.off"))));
}

TEST_F(Capped_parts, WhoseCutCrossesItselfWhenSeenFromItsPlaneAreSolids) {
  // A band that overhangs: corners go out and in again as they go up.
  Tower tower = {{circle(40, 2, false)}, {}};
  for (int i = 2; i < 40; ++i) tower.floor.push_back({0, i - 1, i});
  std::string mesh = tower.off();
  write("walls.txt", tower.walls(2));
  // Corners of the middle storey change places in the plan, at different heights.
  std::istringstream lines(mesh);
  std::string turned, line;
  for (int number = -2; std::getline(lines, line); ++number) {
    const int corner = number - 2 * 40;
    if (corner >= 0 && corner < 40) {
      const double angle = 2 * pi * (corner + 8 * std::sin(2 * pi * corner / 8)) / 40;
      line = std::to_string(2 * std::cos(angle)) + " " + std::to_string(2 * std::sin(angle)) + " " +
             std::to_string(2 + 0.3 * std::cos(2 * pi * corner / 8));
    }
    turned += line + "\n";
  }
  write("again.off", turned);
  expect_solids(parts(turned, {"--constraints", "walls.txt", "--segments", "2", "--keep-orientation"}),
                volume_of(mesh_files::read_mesh(path("again.off"))));
}

TEST_F(Capped_parts, WhoseCutGoesStraightUpFromItsPlaneAreSolids) {
  // Each long side of the cut has a step up and one down, on edges that stand upright on the plane of the whole.
  Tower tower = {
      {{{0, 0}, {1, 0}, {1.25, 0}, {1.75, 0}, {2, 0}, {3, 0}, {3, 2}, {2, 2}, {1.75, 2}, {1.25, 2}, {1, 2}, {0, 2}}},
      {}};
  for (int i = 0; i < 5; ++i) {
    tower.floor.push_back({11, i, i + 1});
    tower.floor.push_back({5, i + 6, i + 7});
  }
  write("walls.txt", tower.walls(2));
  std::string mesh = tower.off();
  for (const auto& [before, after] : {std::pair("1.25 0 2\n", "1 0 2.5\n"),
                                      {"1.75 0 2\n", "2 0 2.5\n"},
                                      {"1.75 2 2\n", "2 2 2.5\n"},
                                      {"1.25 2 2\n", "1 2 2.5\n"}}) {
    const std::size_t place = mesh.find(before);
    ASSERT_NE(place, std::string::npos);
    mesh.replace(place, std::string(before).size(), after);
  }
  expect_solids(parts(mesh, {"--constraints", "walls.txt", "--segments", "2"}), 24);
}

TEST_F(Capped_parts, OfACubesSidesAreClosedAndFlatWhichIsSaid) {
  const auto found = parts(cube_of_separate_squares(3), six_sides);
  ASSERT_EQ(found.size(), 6U);
  for (const auto& [label, part] : found) {
    EXPECT_TRUE(is_closed_and_oriented(part)) << label;
    EXPECT_NEAR(volume_of(part), 0, 1e-12);
  }
  EXPECT_NE(result_.errors.find("6 closed parts are flat"), std::string::npos) << result_.errors;
}

TEST_F(Capped_parts, ThatMeetAtAPointSayHowMuchOfTheVolumeTheyHave) {
  const auto found =
      parts(cube_of_separate_squares(4), {"--seed", "0.4,0.4,0", "--seed", "1,0.4,0.6", "--seed", "0,0.4,0.6"});
  ASSERT_EQ(found.size(), 3U);
  for (const auto& [label, part] : found) EXPECT_TRUE(is_closed_and_oriented(part)) << label;
  EXPECT_NE(result_.errors.find("% of the volume of the mesh"), std::string::npos) << result_.errors;
}

TEST_F(Capped_parts, StayOpenOnlyWhereTheMeshHasABorder) {
  Tower tower = {{l_shape}, {}};
  const auto found = parts_of_tower(tower, {1, 3});
  std::size_t closed = 0;
  for (const auto& segment : report_["segments"]) {
    EXPECT_EQ(is_closed_and_oriented(found.at(segment["label"])), segment["closed"]);
    EXPECT_EQ(segment.contains("volume"), segment["closed"]);
    closed += segment["closed"] == true;
  }
  EXPECT_EQ(closed, 1U);
  EXPECT_NE(result_.errors.find("2 parts are not closed"), std::string::npos) << result_.errors;
}

TEST_F(Capped_parts, NeedParts) {
  write("mesh.off", cube_of_separate_squares(1));
  expect_failure(1, "--cap-parts: there are no parts", {"mesh.off", "--cap-parts"});
}

}  // namespace test_capped_parts

#endif
