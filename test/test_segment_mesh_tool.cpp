// SPDX-License-Identifier: MIT

// The command-line tool segment_mesh, run as a program.

#include <gtest/gtest.h>

#ifndef SEGMENT_MESH

TEST(Segment_mesh_tool, Runs) { GTEST_SKIP() << "the tool is not built"; }

#else

#include "../examples/mesh_files.h"

#include "segment_mesh_tool.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace test_segment_mesh_tool {

namespace {

using namespace segment_mesh_tool;

// ---- What it writes ----

TEST_F(Segment_mesh_tool, TheSidesOfACubeAreItsSegmentsInTheOrderOfTheFile) {
  write("cube.off", cube_of_separate_squares(5));
  const Result result = run(std::vector<std::string>{"cube.off"} + six_sides +
                            std::vector<std::string>{"--labels", "cube.seg", "--report", "cube.json"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.errors.find("cube.off: merged 448 vertices"), std::string::npos) << result.errors;
  std::vector<std::size_t> expected;
  for (std::size_t f = 0; f < 150; ++f) expected.push_back(f / 25);
  EXPECT_EQ(labels("cube.seg"), expected);

  const auto report = nlohmann::json::parse(content_of(path("cube.json")));
  EXPECT_EQ(number_of_lines(content_of(path("cube.json"))), 1U);
  EXPECT_EQ(report["faces"], 150);
  EXPECT_EQ(report["repairs"].size(), 1U);
  ASSERT_EQ(report["segments"].size(), 6U);
  std::set<nlohmann::json> colors;
  for (const auto& segment : report["segments"]) {
    EXPECT_EQ(segment["faces"], 25);
    EXPECT_NEAR(segment["area_share"].get<double>(), 1. / 6, 1e-12);
    colors.insert(segment["color"]);
  }
  EXPECT_EQ(colors.size(), 6U);
}

TEST_F(Segment_mesh_tool, FaceNumbersPointsAndFilesOfSeedsAreTheSame) {
  write("cube.off", cube_of_separate_squares(5));
  write("seeds.txt", "# one side each\n12\n0.5, 0.5, 1\n\n0.5 0 0.5 # in front\r\n  87=3\n112\n0,0.5,0.5=5\n");
  ASSERT_EQ(run(std::vector<std::string>{"cube.off", "--labels", "a.seg"} + six_sides).exit_code, 0);
  ASSERT_EQ(run({"cube.off", "--labels", "b.seg", "--seeds-file", "seeds.txt"}).exit_code, 0);
  ASSERT_EQ(run({"cube.off", "--labels", "c.seg", "--seed", "12", "--seed", "37", "--seed", "62", "--seed", "87",
                 "--seed", "112", "--seed", "137"})
                .exit_code,
            0);
  EXPECT_EQ(labels("a.seg").size(), 150U);
  EXPECT_EQ(labels("a.seg"), labels("b.seg"));
  EXPECT_EQ(labels("a.seg"), labels("c.seg"));
}

TEST_F(Segment_mesh_tool, SeveralSeedsShareALabelAndLabelsAreTheUsers) {
  write("cube.off", cube_of_separate_squares(4));
  ASSERT_EQ(run({"cube.off", "--labels", "cube.seg", "--seed", "5=1000000", "--seed", "21=7", "--seed", "37=7",
                 "--seed", "53=7", "--seed", "69=7", "--seed", "85=7"})
                .exit_code,
            0);
  std::vector<std::size_t> expected(16, 1000000);
  expected.resize(96, 7);
  EXPECT_EQ(labels("cube.seg"), expected);
}

TEST_F(Segment_mesh_tool, ColoredMeshesKeepThePointsAndFacesOfTheFile) {
  write("cube.off", cube_of_separate_squares(3));
  ASSERT_EQ(
      run(std::vector<std::string>{"cube.off", "-o", "out.off", "-o", "out.ply", "--output", "again.ply"} + six_sides)
          .exit_code,
      0);
  EXPECT_EQ(content_of(path("out.ply")), content_of(path("again.ply")));
  EXPECT_NE(content_of(path("out.ply")).find("element face 54\n"), std::string::npos);

  std::istringstream original(content_of(path("cube.off"))), colored(content_of(path("out.off")));
  std::map<std::string, std::size_t> faces_of_color;
  std::string line, with_color;
  for (std::size_t i = 0; std::getline(original, line) && std::getline(colored, with_color); ++i) {
    ASSERT_EQ(with_color.compare(0, line.size(), line), 0) << with_color;
    if (i >= 2 + 216) ++faces_of_color[with_color.substr(line.size())];
  }
  EXPECT_EQ(faces_of_color.size(), 6U);
  for (const auto& [color, faces] : faces_of_color) EXPECT_EQ(faces, 9U) << color;
}

TEST_F(Segment_mesh_tool, ProbabilitiesAddUpToOneAndDecideTheLabels) {
  write("strip.off", strip(30));
  ASSERT_EQ(run({"strip.off", "--seed", "0=5", "--seed", "31=2", "--seed", "59=9", "--labels", "s.seg",
                 "--probabilities", "p.txt"})
                .exit_code,
            0);
  std::istringstream file(content_of(path("p.txt")));
  std::string names;
  std::getline(file, names);
  EXPECT_EQ(names, "# 2 5 9");
  const std::vector<std::size_t> label_of_column = {2, 5, 9}, found = labels("s.seg");
  ASSERT_EQ(found.size(), 60U);
  for (const std::size_t label : found) {
    std::array<double, 3> p{};
    ASSERT_TRUE(file >> p[0] >> p[1] >> p[2]);
    EXPECT_NEAR(p[0] + p[1] + p[2], 1, 1e-12);
    EXPECT_EQ(label_of_column[static_cast<std::size_t>(std::max_element(p.begin(), p.end()) - p.begin())], label);
  }
}

TEST_F(Segment_mesh_tool, FacesLeftOutByARepairGetTheLabelOfTheClosestFace) {
  std::string file = strip(10);
  file.replace(file.find("22 20 0"), 7, "22 24 0");
  file += "3 0 1 1\n3 2 0 3\n3 20 21 20\n1 21\n";  // an edge, the first face again, an edge, a point
  write("strip.off", file);
  const Result result = run({"strip.off", "--seed", "0", "--seed", "19", "--labels", "s.seg"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.errors.find("4 faces of the file left out of the mesh"), std::string::npos) << result.errors;
  const auto found = labels("s.seg");
  ASSERT_EQ(found.size(), 24U);
  EXPECT_EQ(std::vector<std::size_t>(found.begin() + 20, found.end()), (std::vector<std::size_t>{0, 0, 1, 1}));
  expect_failure(3, "seed 20: this face was left out of the mesh", {"strip.off", "--seed", "20", "--quiet"});
}

TEST_F(Segment_mesh_tool, WhatIsOddButNotWrongIsSaid) {
  // Two strips apart from each other, and a triangle without area at the end of the first.
  write("odd.off",
        "OFF\n9 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0.5 0\n1 0.5 0\n5 0 0\n6 0 0\n5 1 0\n3 0 1 2\n3 0 2 3\n3 2 1 5\n"
        "3 6 7 8\n");
  const Result result = run({"odd.off", "--seed", "0", "--labels", "odd.seg"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.errors.find("1 face without area"), std::string::npos) << result.errors;
  EXPECT_NE(result.errors.find("1 component without a seed"), std::string::npos) << result.errors;
  EXPECT_EQ(labels("odd.seg"), (std::vector<std::size_t>{0, 0, 0, 1}));
  EXPECT_EQ(run({"odd.off", "--seed", "0", "--quiet"}).errors, "");
}

TEST_F(Segment_mesh_tool, AMeshInsideOutGivesTheSameSegmentsUnlessItIsKept) {
  // An L-shaped prism: its one concave edge cuts it in two.
  const std::string points =
      "OFF\n12 8 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n0 0 1\n2 0 1\n2 1 1\n1 1 1\n1 2 1\n0 2 1\n";
  write("l.off",
        points +
            "6 5 4 3 2 1 0\n6 6 7 8 9 10 11\n4 0 1 7 6\n4 1 2 8 7\n4 2 3 9 8\n4 3 4 10 9\n4 4 5 11 10\n4 5 0 6 11\n");
  write("inside_out.off",
        points +
            "6 0 1 2 3 4 5\n6 11 10 9 8 7 6\n4 6 7 1 0\n4 7 8 2 1\n4 8 9 3 2\n4 9 10 4 3\n4 10 11 5 4\n4 11 6 0 5\n");
  const std::vector<std::string> seeds = {"--smoothing", "0", "--convex-weight", "0.1", "--seed", "0",
                                          "--seed",      "3", "--probabilities"};
  ASSERT_EQ(run(std::vector<std::string>{"l.off"} + seeds + std::vector<std::string>{"a.txt"}).exit_code, 0);
  const Result turned = run(std::vector<std::string>{"inside_out.off"} + seeds + std::vector<std::string>{"b.txt"});
  ASSERT_EQ(turned.exit_code, 0);
  EXPECT_NE(turned.errors.find("inside_out.off: turned 1 closed part"), std::string::npos) << turned.errors;
  const Result kept =
      run(std::vector<std::string>{"inside_out.off", "--keep-orientation"} + seeds + std::vector<std::string>{"c.txt"});
  EXPECT_EQ(kept.errors, "");

  const auto numbers = [&](const std::string& name) {
    std::istringstream file(content_of(path(name)));
    std::string names;
    std::getline(file, names);
    return std::vector<double>{std::istream_iterator<double>(file), {}};
  };
  const auto largest_difference = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
  };
  ASSERT_EQ(numbers("a.txt").size(), 16U);
  EXPECT_LT(largest_difference(numbers("a.txt"), numbers("b.txt")), 1e-9);
  EXPECT_GT(largest_difference(numbers("a.txt"), numbers("c.txt")), 0.01);
}

// ---- Automatic segments ----

/// A tower of balls of different sizes: an open surface of revolution with deep necks.
std::string tower(int balls) {
  constexpr int around = 24, along = 16;
  std::ostringstream file;
  const int rings = balls * along + 1;
  file.precision(17);
  file << "OFF\n" << rings * around << ' ' << (rings - 1) * around << " 0\n";
  for (int ring = 0; ring < rings; ++ring) {
    const int ball = std::min(ring / along, balls - 1);
    const double size = 1 + 0.2 * (ball % 3), t = 3.14159265358979 * (ring - ball * along) / along;
    const double radius = 0.2 + size * std::sin(t), height = 3 * ball + 1.5 * (1 - std::cos(t));
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * 3.14159265358979 * i / around;
      file << radius * std::cos(angle) << ' ' << radius * std::sin(angle) << ' ' << height << '\n';
    }
  }
  for (int ring = 0; ring + 1 < rings; ++ring)
    for (int i = 0; i < around; ++i) {
      const int a = ring * around + i, b = ring * around + (i + 1) % around;
      file << "4 " << a << ' ' << b << ' ' << b + around << ' ' << a + around << '\n';
    }
  return file.str();
}

TEST_F(Segment_mesh_tool, WithoutSeedsItFindsThePartsByItself) {
  write("tower.off", tower(4));
  const Result result = run({"tower.off", "--labels", "t.seg", "--report", "t.json", "-o", "t.ply"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto found = labels("t.seg");
  ASSERT_EQ(found.size(), 4U * 16 * 24);
  std::set<std::size_t> middles;  // of the balls
  for (std::size_t ball = 0; ball < 4; ++ball) middles.insert(found[(ball * 16 + 8) * 24]);
  EXPECT_EQ(middles.size(), 4U);
  const auto report = nlohmann::json::parse(content_of(path("t.json")));
  EXPECT_EQ(report["segments"].size(), 4U);
  EXPECT_EQ(report["seeds"], 40);
  for (const char* stage : {"reading", "normals", "seeds", "walk", "merging", "writing"})
    EXPECT_TRUE(report["milliseconds"].contains(stage)) << stage;
}

TEST_F(Segment_mesh_tool, AnyNumberOfSegmentsIsExactAndReadOffTheHierarchy) {
  write("tower.off", tower(3));
  ASSERT_EQ(run({"tower.off", "--hierarchy", "h.json"}).exit_code, 0);
  const auto hierarchy = nlohmann::json::parse(content_of(path("h.json")));
  const std::size_t fragments = hierarchy["fragments"];
  EXPECT_GT(fragments, 40U) << "of two seedings, of 40 seeds each";
  EXPECT_EQ(hierarchy["merges"].size(), fragments - 1);
  ASSERT_EQ(run({"tower.off", "--seedings", "1", "--hierarchy", "one.json"}).exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(content_of(path("one.json")))["fragments"], 40U);
  for (const std::size_t number : {1U, 3U, 7U, 20U}) {
    ASSERT_EQ(run({"tower.off", "--segments", std::to_string(number), "--labels", "t.seg"}).exit_code, 0);
    const auto found = labels("t.seg");
    EXPECT_EQ(std::set<std::size_t>(found.begin(), found.end()).size(), number);

    std::vector<std::size_t> parent(fragments + hierarchy["merges"].size());
    std::iota(parent.begin(), parent.end(), std::size_t(0));
    for (std::size_t merge = 0; merge < fragments - number; ++merge)
      for (const std::size_t side : {0U, 1U})
        parent[hierarchy["merges"][merge][side].get<std::size_t>()] = fragments + merge;
    std::set<std::pair<std::size_t, std::size_t>> pairs;  // segment in the hierarchy, label
    for (std::size_t f = 0; f < found.size(); ++f) {
      std::size_t region = hierarchy["fragment_of_face"][f];
      while (parent[region] != region) region = parent[region];
      pairs.emplace(region, found[f]);
    }
    EXPECT_EQ(pairs.size(), number);
  }
  const Result many = run({"tower.off", "--segments", "100", "--labels", "t.seg", "--quiet"});
  EXPECT_EQ(many.exit_code, 0) << many.errors;
  const auto found = labels("t.seg");
  EXPECT_EQ(std::set<std::size_t>(found.begin(), found.end()).size(), 100U);
}

const std::string place_for_result = "<script type=\"application/json\" id=\"embedded-result\">";

/// The result in a page that was written about the place for one, with `before` and `after` around it.
nlohmann::json result_in_page(const std::string& page, const std::string& before, const std::string& after) {
  EXPECT_EQ(page.substr(0, before.size()), before);
  EXPECT_EQ(page.substr(page.size() - after.size()), after);
  const std::string text = page.substr(before.size(), page.size() - before.size() - after.size());
  EXPECT_EQ(text.find('<'), std::string::npos);
  return nlohmann::json::parse(text);
}

std::string bytes_of_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  EXPECT_EQ(text.size() % 4, 0U);
  std::string bytes;
  unsigned bits = 0, number = 0;
  for (const char c : text.substr(0, text.find('='))) {
    number = number << 6 | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(number >> bits & 0xff);
  }
  return bytes;
}

template <class Number>
std::vector<Number> numbers_of_base64(const nlohmann::json& text) {
  const std::string bytes = bytes_of_base64(text);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

TEST_F(Segment_mesh_tool, APageHoldsMeshLabelsAndLevels) {
  const std::string name = "a <script> of tower.off";
  const std::string before = "<html>" + place_for_result, after = "</script><p></html>\n";
  write(name, tower(3));
  write("page.html", before + "null" + after);
  const Result result =
      run({name, "--html", "result.html", "--page", "page.html", "--labels", "t.seg", "--hierarchy", "h.json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto page = result_in_page(content_of(path("result.html")), before, after);
  EXPECT_EQ(page["name"], name);
  EXPECT_EQ(page["mode"], "graphical");
  EXPECT_EQ(page["policies"]["difference"], "concavity");
  EXPECT_EQ(page["policies"]["seeding"], "farthest");
  EXPECT_EQ(page["policies"]["mergeCost"], "learned");
  EXPECT_EQ(page["seeds"].size(), 0U);
  EXPECT_EQ(page["segments"], 3);

  const auto found = labels("t.seg");
  const auto page_labels = numbers_of_base64<std::uint32_t>(page["labels"]);
  EXPECT_TRUE(std::equal(found.begin(), found.end(), page_labels.begin(), page_labels.end()));
  write("again.ply", bytes_of_base64(page["mesh"]));
  ASSERT_EQ(run({"again.ply", "--labels", "again.seg"}).exit_code, 0);
  EXPECT_EQ(labels("again.seg"), found);

  const auto hierarchy = nlohmann::json::parse(content_of(path("h.json")));
  EXPECT_EQ(page["hierarchy"]["fragments"], hierarchy["fragments"]);
  EXPECT_EQ(page["hierarchy"]["fewest"], hierarchy["components"]);
  EXPECT_EQ(page["hierarchy"]["suggested"], 3);
  ASSERT_EQ(run({name, "--html", "five.html", "--page", "page.html", "--segments", "5"}).exit_code, 0);
  const auto five = result_in_page(content_of(path("five.html")), before, after);
  EXPECT_EQ(five["segments"], 5);
  EXPECT_EQ(five["hierarchy"]["suggested"], 3);
  const auto fragments = numbers_of_base64<std::uint32_t>(page["hierarchy"]["fragmentOfFace"]);
  EXPECT_EQ(nlohmann::json(fragments), hierarchy["fragment_of_face"]);
  const auto regions = numbers_of_base64<std::uint32_t>(page["hierarchy"]["merges"]);
  const auto costs = numbers_of_base64<double>(page["hierarchy"]["costs"]);
  ASSERT_EQ(regions.size(), 2 * hierarchy["merges"].size());
  ASSERT_EQ(costs.size(), hierarchy["merges"].size());
  for (std::size_t i = 0; i < costs.size(); ++i)
    EXPECT_EQ(nlohmann::json({regions[2 * i], regions[2 * i + 1], costs[i]}), hierarchy["merges"][i]);
}

TEST_F(Segment_mesh_tool, APageHoldsSeedsAndTheirLabels) {
  write("strip.off", strip(6));
  write("page.html", place_for_result + "null</script>");
  ASSERT_EQ(run({"strip.off", "--seed", "1=4", "--seed", "5=2", "--html", "s.html", "--page", "page.html"}).exit_code,
            0);
  const auto page = result_in_page(content_of(path("s.html")), place_for_result, "</script>");
  EXPECT_EQ(page["mode"], "seeds");
  EXPECT_EQ(page["hierarchy"], nullptr);
  EXPECT_EQ(page["seeds"], nlohmann::json::parse(R"([{"face": 1, "label": 4}, {"face": 5, "label": 2}])"));
}

TEST_F(Segment_mesh_tool, APageHoldsTheNumbersByWhichSeedsWereToGrow) {
  write("strip.off", strip(6));
  write("page.html", place_for_result + "null</script>");
  const auto parameters = [&](std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"strip.off", "--seed", "1", "--seed", "5", "--html", "s.html", "--page", "page.html"});
    EXPECT_EQ(run(options).exit_code, 0);
    return result_in_page(content_of(path("s.html")), place_for_result, "</script>")["parameters"];
  };
  EXPECT_EQ(parameters({}), nlohmann::json({{"convexWeight", .02}, {"sigma", 1.}}));
  EXPECT_EQ(parameters({"--sigma", "0.25", "--convex-weight", "0.5"}),
            nlohmann::json({{"convexWeight", .5}, {"sigma", .25}}));
  EXPECT_EQ(parameters({"--difference", "curvature"}), nullptr);
}

TEST_F(Segment_mesh_tool, SplitWritesEachSegmentAsAMeshOfItsOwn) {
  write("tower.off", tower(2));
  ASSERT_EQ(run({"tower.off", "--segments", "3", "--labels", "t.seg", "--split", "parts"}).exit_code, 0);
  std::map<std::size_t, std::size_t> faces_of;
  for (const std::size_t label : labels("t.seg")) ++faces_of[label];
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("parts")), {}), 3);
  for (const auto& [label, faces] : faces_of) {
    const std::string file = content_of(path("parts/segment_" + std::to_string(label) + ".ply"));
    EXPECT_NE(file.find("element face " + std::to_string(faces) + "\n"), std::string::npos) << label;
  }
  // The parts are meshes that it reads itself.
  EXPECT_EQ(run({"parts/segment_0.ply", "--segments", "1", "--quiet"}).exit_code, 0);

  std::filesystem::create_directory(path("empty"));
  EXPECT_EQ(run({"tower.off", "--split", "empty"}).exit_code, 0);
  EXPECT_EQ(run({"tower.off", "--split", "parts"}).exit_code, 5);
  EXPECT_EQ(run({"tower.off", "--split", "new", "--segments", "0"}).exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(path("new")));
}

TEST_F(Segment_mesh_tool, RefineCutsAllOutputsAlongSmoothBoundaries) {
  const auto faces_of = [&](const std::string& name) {
    std::ifstream file(path(name));
    std::string off;
    std::size_t points = 0, faces = 0;
    file >> off >> points >> faces;
    return faces;
  };
  // A crumpled sheet, so that the boundary between the seeds is jagged.
  std::ostringstream sheet;
  const int n = 16;
  sheet << "OFF\n" << (n + 1) * (n + 1) << ' ' << 2 * n * n << " 0\n";
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x)
      sheet << x << ' ' << y << ' ' << 0.1 * ((31 * x * x + 17 * y * y + 7 * x * y) % 11) << '\n';
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x;
      sheet << "3 " << a << ' ' << a + 1 << ' ' << a + n + 2 << "\n3 " << a << ' ' << a + n + 2 << ' ' << a + n + 1
            << '\n';
    }
  write("sheet.off", sheet.str());
  const std::vector<std::string> seeds = {"sheet.off", "--seed", "0", "--seed", "511"};

  ASSERT_EQ(run(seeds + std::vector<std::string>{"--boundaries", "jagged.obj"}).exit_code, 0);
  ASSERT_EQ(run(seeds + std::vector<std::string>{"--smooth", "--boundaries", "smooth.obj"}).exit_code, 0);
  EXPECT_TRUE(content_of(path("jagged.obj")) != content_of(path("smooth.obj")));
  const Result result =
      run(seeds + std::vector<std::string>{"--refine", "--output", "r.off", "--labels", "r.seg", "--probabilities",
                                           "r.txt", "--boundaries", "r.obj", "--split", "parts"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(content_of(path("r.obj")), content_of(path("smooth.obj")));
  const std::size_t faces = faces_of("r.off");
  EXPECT_GT(faces, std::size_t(2 * n * n));
  EXPECT_EQ(labels("r.seg").size(), faces);
  EXPECT_EQ(number_of_lines(content_of(path("r.txt"))), faces + 1);
  EXPECT_TRUE(std::filesystem::exists(path("parts/segment_0.ply")) &&
              std::filesystem::exists(path("parts/segment_1.ply")));

  expect_failure(1, "--smooth", {"sheet.off", "--smooth"});
}

TEST_F(Segment_mesh_tool, PolygonsAreCutIntoTrianglesForBoundariesAlone) {
  // A tower of two storeys over an L.
  const std::vector<std::array<double, 2>> outline = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  std::string points, walls;
  for (int storey = 0; storey < 3; ++storey)
    for (int i = 0; i < 6; ++i) {
      const auto& [x, y] = outline[std::size_t(i)];
      points += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(storey) + "\n";
      const int a = 6 * storey + i, b = 6 * storey + (i + 1) % 6;
      if (storey < 2)
        walls += "4 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + 6) + " " +
                 std::to_string(a + 6) + "\n";
    }
  write("tower.off", "OFF\n18 14 0\n" + points + walls + "6 5 4 3 2 1 0\n6 12 13 14 15 16 17\n");
  const std::vector<std::string> seeds = {"tower.off", "--seed", "12", "--seed", "13"};

  ASSERT_EQ(run(seeds + std::vector<std::string>{"--labels", "whole.seg"}).exit_code, 0);
  const Result result =
      run(seeds + std::vector<std::string>{"--refine", "--output", "r.off", "--labels", "r.seg", "--probabilities",
                                           "r.txt", "--boundaries", "r.obj", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.errors.find("14 polygons cut into triangles"), std::string::npos) << result.errors;
  EXPECT_NE(content_of(path("r.json")).find("14 polygons cut into triangles"), std::string::npos);
  const auto refined = mesh_files::read_mesh(path("r.off"));
  double area = 0;
  for (std::size_t f = 0; f < refined.number_of_faces(); ++f) {
    const auto face = refined.face(f);
    ASSERT_EQ(face.size(), 3);
    area += std::sqrt(CGAL::squared_area(refined.points[face[0]], refined.points[face[1]], refined.points[face[2]]));
  }
  EXPECT_NEAR(area, 2 * 5 + 2 * 12, 1e-9) << "some triangle lies outside of its polygon";
  const auto before = labels("whole.seg"), after = labels("r.seg");
  ASSERT_EQ(after.size(), refined.number_of_faces());
  EXPECT_EQ(number_of_lines(content_of(path("r.txt"))), after.size() + 1);
  for (const std::size_t f : {12U, 13U}) EXPECT_EQ(after[f], before[f]) << "the first faces are those of the file";

  // Without --refine the mesh keeps its faces.
  ASSERT_EQ(run(seeds + std::vector<std::string>{"--output", "whole.off"}).exit_code, 0);
  for (const std::vector<std::string>& smooth : {std::vector<std::string>{}, {"--smooth"}}) {
    ASSERT_EQ(run(seeds + smooth + std::vector<std::string>{"--output", "b.off", "--boundaries", "b.obj"}).exit_code,
              0);
    EXPECT_EQ(content_of(path("b.off")), content_of(path("whole.off")));
    if (!smooth.empty()) {
      EXPECT_EQ(content_of(path("b.obj")), content_of(path("r.obj")));
    }
  }
}

TEST_F(Segment_mesh_tool, BoundariesOfPolygonsStayOnWalls) {
  write("grid.off", grid(4));
  write("stairs.txt", "1 6\n6 7\n7 12\n12 13\n13 18\n18 19\n");
  const std::vector<std::string> task = {"grid.off", "--seed", "0", "--seed", "3", "--constraints", "stairs.txt"};
  for (const std::vector<std::string>& smooth : {std::vector<std::string>{}, {"--smooth"}, {"--refine"}}) {
    ASSERT_EQ(run(task + smooth + std::vector<std::string>{"--boundaries", "b.obj"}).exit_code, 0);
    std::istringstream lines(content_of(path("b.obj")));
    std::size_t points = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line[0] != 'v') continue;
      ++points;
      std::istringstream coordinates(line.substr(1));
      for (double x; coordinates >> x;) EXPECT_EQ(x, std::round(x)) << "no corner of the stairs: " << line;
    }
    EXPECT_EQ(points, 7U);
  }
}

TEST_F(Segment_mesh_tool, PolygonsThatShareTwoEdgesAreCutWithoutASideInCommon) {
  // Both squares are convex where they bend around the vertex that they begin with.
  write("bent.off",
        "OFF\n5 4 0\n1 -0.3 -0.3\n2 0 0\n1 2 0\n0 0 0\n1 0 2\n"
        "4 0 1 2 3\n4 0 3 4 1\n3 3 2 4\n3 2 1 4\n");
  const Result result = run({"bent.off", "--seed", "0", "--seed", "2", "--refine", "--output", "r.off"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto refined = mesh_files::read_mesh(path("r.off"));
  std::set<std::pair<std::size_t, std::size_t>> sides;
  for (std::size_t f = 0; f < refined.number_of_faces(); ++f) {
    const auto face = refined.face(f);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(sides.insert({face[i], face[(i + 1) % 3]}).second);
  }
}

TEST_F(Segment_mesh_tool, SeedsOfTheUserJoinTheAutomaticOnes) {
  write("tower.off", tower(2));
  ASSERT_EQ(
      run({"tower.off", "--seeds", "10", "--seed", "5", "--seed", "100", "--seedings", "1", "--hierarchy", "h.json"})
          .exit_code,
      0);
  EXPECT_EQ(nlohmann::json::parse(content_of(path("h.json")))["fragments"], 12);
  const auto result = run({"tower.off", "--seed", "5", "--segments", "2", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(nlohmann::json::parse(content_of(path("r.json")))["seeds"], 41);
}

TEST_F(Segment_mesh_tool, CoarseSeedsAreSegmentsThemselves) {
  write("tower.off", tower(2));
  ASSERT_EQ(
      run({"tower.off", "--coarse", "--segments", "3", "--labels", "t.seg", "--probabilities", "p.txt"}).exit_code, 0);
  const auto found = labels("t.seg");
  EXPECT_EQ(std::set<std::size_t>(found.begin(), found.end()), (std::set<std::size_t>{0, 1, 2}));
  EXPECT_EQ(content_of(path("p.txt")).substr(0, 8), "# 0 1 2\n");
  EXPECT_EQ(run({"tower.off", "--coarse"}).exit_code, 0);
}

TEST_F(Segment_mesh_tool, ThePresetsNumbersHoldUnlessOthersAreGiven) {
  write("tower.off", tower(2));
  const auto parameters = [&](const std::vector<std::string>& arguments) {
    EXPECT_EQ(run(std::vector<std::string>{"tower.off", "--report", "r.json"} + arguments).exit_code, 0);
    return nlohmann::json::parse(content_of(path("r.json")))["parameters"];
  };
  EXPECT_EQ(parameters({})["convex_weight"], 0);
  EXPECT_EQ(parameters({})["measure"], "angle");
  EXPECT_EQ(parameters({"--seed", "0"})["convex_weight"], 0.02);
  EXPECT_EQ(parameters({"--paper"})["convex_weight"], 0.2);
  EXPECT_EQ(parameters({"--paper"})["measure"], "cosine");
  EXPECT_EQ(parameters({"--paper"})["smoothing"], 0);
  EXPECT_EQ(parameters({"--paper", "--convex-weight", "0.5", "--sigma", "2"})["convex_weight"], 0.5);
  EXPECT_EQ(parameters({"--measure", "cosine", "--cap", "7", "--smoothing", "0"})["cap"], 7);
}

TEST_F(Segment_mesh_tool, ComponentsAreNeverJoined) {
  write("two.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n3 0 1 2\n3 3 4 5\n");
  ASSERT_EQ(run({"two.off", "--labels", "two.seg"}).exit_code, 0);
  EXPECT_EQ(labels("two.seg"), (std::vector<std::size_t>{0, 1}));
  expect_failure(3, "--segments is 1, but must be from 2", {"two.off", "--segments", "1"});
}

TEST_F(Segment_mesh_tool, AMeshOfOneFaceIsOneSegment) {
  write("one.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  ASSERT_EQ(run({"one.off", "--labels", "one.seg"}).exit_code, 0);
  EXPECT_EQ(labels("one.seg"), (std::vector<std::size_t>{0}));
  ASSERT_EQ(run({"one.off", "--labels", "one.seg", "--seed", "0=4"}).exit_code, 0);
  EXPECT_EQ(labels("one.seg"), (std::vector<std::size_t>{4}));
}

// ---- Policies by name ----

struct Choice {
  std::string option;
  std::vector<std::string> names;
};

const std::vector<Choice> choices = {{"--difference", {"dihedral", "concavity", "curvature"}},
                                     {"--seeding", {"farthest", "particles", "coarse"}},
                                     {"--merge-cost", {"learned", "size", "boundary"}},
                                     {"--solver", {"star-mesh", "eigen"}}};

TEST_F(Segment_mesh_tool, EachChoiceGivesAsManySegmentsAsAskedForAndIsReported) {
  write("tower.off", tower(3));
  for (const auto& [option, names] : choices)
    for (const std::string& name : names) {
      const Result result =
          run({"tower.off", option, name, "--segments", "5", "--labels", "t.seg", "--report", "r.json"});
      ASSERT_EQ(result.exit_code, 0) << name << result.errors;
      const auto found = labels("t.seg");
      EXPECT_EQ(std::set<std::size_t>(found.begin(), found.end()).size(), 5U) << name;
      std::string key = option.substr(2);
      std::replace(key.begin(), key.end(), '-', '_');
      EXPECT_EQ(nlohmann::json::parse(content_of(path("r.json")))["parameters"][key], name);
    }
}

TEST_F(Segment_mesh_tool, OtherLevelsArePrintedAndReported) {
  write("tower.off", tower(3));
  const Result result = run({"tower.off", "--labels", "t.seg", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto report = nlohmann::json::parse(content_of(path("r.json")));
  const auto levels = report["levels"].get<std::vector<std::size_t>>();
  ASSERT_GT(levels.size(), 1U);
  const std::size_t suggested = report["segments"].size();
  EXPECT_EQ(std::count(levels.begin(), levels.end(), suggested), 1);
  std::string others;
  for (const std::size_t level : levels)
    if (level != suggested) others += (others.empty() ? "" : " or ") + std::to_string(level);
  EXPECT_NE(result.output.find("You may also try --segments " + others + ".\n"), std::string::npos) << result.output;

  const Result asked = run({"tower.off", "--labels", "t.seg", "--report", "r.json", "--segments", "5"});
  ASSERT_EQ(asked.exit_code, 0) << asked.errors;
  EXPECT_EQ(nlohmann::json::parse(content_of(path("r.json")))["levels"], report["levels"]);
  EXPECT_EQ(asked.output.find("try"), std::string::npos) << "who asks for a number is offered no other";

  const Result seeded = run({"tower.off", "--labels", "t.seg", "--report", "r.json", "--seed", "0"});
  ASSERT_EQ(seeded.exit_code, 0) << seeded.errors;
  EXPECT_FALSE(nlohmann::json::parse(content_of(path("r.json"))).contains("levels")) << "seeds make no hierarchy";
}

TEST_F(Segment_mesh_tool, ThePresetsAreChoices) {
  write("tower.off", tower(3));
  const auto outcome = [&](const std::vector<std::string>& arguments) {
    const Result result =
        run(std::vector<std::string>{"tower.off", "--labels", "t.seg", "--report", "r.json"} + arguments);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return std::pair(labels("t.seg"), nlohmann::json::parse(content_of(path("r.json")))["parameters"]);
  };
  EXPECT_EQ(outcome({}), outcome({"--difference", "concavity", "--seeding", "farthest", "--merge-cost", "learned",
                                  "--solver", "star-mesh"}));
  EXPECT_EQ(outcome({"--paper"}), outcome({"--difference", "dihedral", "--smoothing", "0", "--seeding", "particles",
                                           "--seeds", "60", "--merge-cost", "boundary"}));
  EXPECT_EQ(outcome({"--seed", "0", "--seed", "900", "--paper"}),
            outcome({"--seed", "0", "--seed", "900", "--difference", "dihedral", "--smoothing", "0"}));
}

TEST_F(Segment_mesh_tool, UnknownChoicesAreRefusedAndTheKnownOnesNamed) {
  write("strip.off", strip(3));
  for (const auto& [option, names] : choices) {
    std::string known;
    for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
    for (const char* wrong : {"other", "0"})
      expect_failure(1, option + ": " + wrong + " is none of " + known, {"strip.off", option + "=" + wrong});
    EXPECT_NE(run({"--help"}).output.find(option), std::string::npos);
  }
}

TEST_F(Segment_mesh_tool, ChoicesThatMakeNoSenseTogetherAreRefused) {
  write("strip.off", strip(3));
  const auto expect = [&](const std::string& text, const std::vector<std::string>& arguments) {
    expect_failure(1, text, std::vector<std::string>{"strip.off", "--labels", "l.seg"} + arguments);
  };
  for (const auto& [option, names] : choices)
    expect("leave out --engineering or " + option, {"--engineering", option, names[0]});
  for (const char* number : {"--smoothing", "--convex-weight", "--sigma", "--cap"})
    expect(std::string("leave out --engineering or ") + number, {"--engineering", number, "1"});
  expect("give --difference curvature", {"--radius", "2"});
  expect("give --difference curvature", {"--difference", "dihedral", "--radius", "2"});
  expect("--convex-weight", {"--difference", "curvature", "--convex-weight", "1"});
  expect("--measure", {"--difference", "curvature", "--measure", "angle"});
  expect("leave one of the two out", {"--coarse", "--seeding", "coarse"});
  expect("give --seeding coarse in its place", {"--coarse", "--merge-cost", "size"});
  expect("give --segments or --seeds", {"--seed", "0", "--seeding", "particles"});
  expect("give --segments or --seeds", {"--seed", "0", "--merge-cost", "size"});
  expect("give --seeding coarse in its place", {"--coarse", "--seedings", "2"});
  expect("give --segments or --seeds", {"--seed", "0", "--seedings", "2"});
  expect("leave out --engineering or --seedings", {"--engineering", "--seedings", "2"});
  for (const char* angle : {"0", "-1", "180", "nan"}) expect("--constraints-angle", {"--constraints-angle", angle});
}

TEST_F(Segment_mesh_tool, SeedsFollowTheNumberOfSegments) {
  write("tower.off", tower(2));
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {}, {"--paper"}, {"--seeding", "particles"}, {"--seeding", "coarse"}, {"--difference", "curvature"}}) {
    const Result result =
        run(std::vector<std::string>{"tower.off", "--segments", "70", "--labels", "t.seg", "--quiet"} + arguments);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const auto found = labels("t.seg");
    EXPECT_EQ(std::set<std::size_t>(found.begin(), found.end()).size(), 70U);
  }
  expect_failure(3, "more seeds make more", {"tower.off", "--segments", "70", "--seeds", "60", "--seedings", "1"});
}

TEST_F(Segment_mesh_tool, CoarseSeedsMayBeMerged) {
  write("tower.off", tower(3));
  ASSERT_EQ(run({"tower.off", "--seeding", "coarse", "--hierarchy", "h.json"}).exit_code, 0);
  const std::size_t fragments = nlohmann::json::parse(content_of(path("h.json")))["fragments"];
  EXPECT_GE(fragments, 3U);
  EXPECT_LT(fragments, 20U);
  ASSERT_EQ(run({"tower.off", "--seeding", "coarse", "--seeds", "7", "--hierarchy", "h.json"}).exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(content_of(path("h.json")))["fragments"], 7);
}

TEST_F(Segment_mesh_tool, BothSolversGiveTheSameProbabilities) {
  write("tower.off", tower(2));
  const std::vector<std::string> seeds = {"tower.off", "--seed", "100", "--seed", "300", "--seed", "600"};
  const auto probabilities = [&](const std::string& solver) {
    EXPECT_EQ(run(seeds + std::vector<std::string>{"--solver", solver, "--probabilities", "p.txt"}).exit_code, 0);
    std::istringstream file(content_of(path("p.txt")));
    std::string names;
    std::getline(file, names);
    return std::vector<double>{std::istream_iterator<double>(file), {}};
  };
  const auto first = probabilities("star-mesh"), second = probabilities("eigen");
  ASSERT_EQ(first.size(), 3U * 2 * 16 * 24);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_NEAR(first[i], second[i], 1e-6);
}

TEST_F(Segment_mesh_tool, TheRadiusOfCurvaturesIsTheUsers) {
  write("tower.off", tower(2));
  const auto found = [&](const std::vector<std::string>& radius) {
    const Result result = run(std::vector<std::string>{"tower.off", "--difference", "curvature", "--segments", "6",
                                                       "--labels", "t.seg", "--report", "r.json"} +
                              radius);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return labels("t.seg");
  };
  const auto usual = found({});
  EXPECT_EQ(nlohmann::json::parse(content_of(path("r.json")))["parameters"]["radius"], 3);
  EXPECT_EQ(found({"--radius", "3"}), usual);
  EXPECT_NE(found({"--radius", "8"}), usual);
  for (const char* radius : {"0", "-1", "nan", "inf"})
    expect_failure(3, "radius is ", {"tower.off", "--difference", "curvature", "--radius", radius, "--quiet"});
}

// ---- Walls ----

/// The edges of a file of squares that hold for a condition on their two points, as the tool takes walls.
std::string edges_where(const std::string& off,
                        const std::function<bool(const std::array<double, 3>&, const std::array<double, 3>&)>& holds) {
  std::istringstream file(off);
  std::string word;
  std::size_t points = 0, faces = 0, edges = 0;
  file >> word >> points >> faces >> edges;
  std::vector<std::array<double, 3>> point(points);
  for (auto& [x, y, z] : point) file >> x >> y >> z;
  std::ostringstream walls;
  walls << "# two vertices a line\n\n";
  for (std::size_t f = 0; f < faces; ++f) {
    std::size_t degree = 0;
    std::array<std::size_t, 4> v{};
    file >> degree >> v[0] >> v[1] >> v[2] >> v[3];
    for (std::size_t i = 0; i < 4; ++i)
      if (holds(point[v[i]], point[v[(i + 1) % 4]])) walls << v[i] << ' ' << v[(i + 1) % 4] << "  # of a face\n";
  }
  return walls.str();
}

TEST_F(Segment_mesh_tool, NoSegmentLiesOnBothSidesOfAClosedLoopOfWalls) {
  constexpr std::size_t n = 6;
  const std::string cube = cube_of_separate_squares(n);
  write("cube.off", cube);
  write("belt.txt", edges_where(cube, [](const auto& p, const auto& q) { return p[2] == 0.5 && q[2] == 0.5; }));
  // z grows with the columns of the sides y = 0 and x = 1 and with the rows of y = 1 and x = 0.
  const auto is_above = [](std::size_t f) {
    const std::size_t side = f / (n * n), row = f % (n * n) / n, column = f % n;
    return side == 1 || ((side == 2 || side == 3) && column >= n / 2) || (side > 3 && row >= n / 2);
  };
  for (const auto& arguments : std::vector<std::vector<std::string>>{{},
                                                                     {"--segments", "2"},
                                                                     {"--paper"},
                                                                     {"--coarse"},
                                                                     {"--engineering"},
                                                                     {"--engineering", "--segments", "2"},
                                                                     {"--difference", "curvature"},
                                                                     {"--seeding", "coarse", "--segments", "2"},
                                                                     {"--merge-cost", "boundary", "--segments", "3"},
                                                                     {"--solver", "eigen", "--segments", "2"},
                                                                     {"--seed", "0"},
                                                                     {"--seed", "0", "--solver", "eigen"},
                                                                     {"--seed", "0", "--segments", "2"}}) {
    const Result result = run(
        std::vector<std::string>{"cube.off", "--constraints", "belt.txt", "--labels", "c.seg", "--report", "c.json"} +
        arguments);
    const std::string shown = testing::PrintToString(arguments);
    ASSERT_EQ(result.exit_code, 0) << shown << result.errors;
    const auto found = labels("c.seg");
    ASSERT_EQ(found.size(), 6 * n * n);
    std::set<std::size_t> above, below, both;
    for (std::size_t f = 0; f < found.size(); ++f) (is_above(f) ? above : below).insert(found[f]);
    std::set_intersection(above.begin(), above.end(), below.begin(), below.end(), std::inserter(both, both.end()));
    EXPECT_TRUE(both.empty()) << shown;
    EXPECT_EQ(nlohmann::json::parse(content_of(path("c.json")))["walls"], 4 * n) << shown;
  }
  expect_failure(3, "--segments is 1, but must be from 2",
                 {"cube.off", "--constraints", "belt.txt", "--segments", "1", "--quiet"});
}

TEST_F(Segment_mesh_tool, ReportsTheErrorsOfSurfacesAndWhatIsMadeRegular) {
  write("cube.off", cube_of_separate_squares(4));
  ASSERT_EQ(run({"cube.off", "--engineering", "--regular", "--report", "c.json"}).exit_code, 0);
  const auto report = nlohmann::json::parse(content_of(path("c.json")));
  for (const auto& segment : report["segments"]) {
    EXPECT_LT(segment["surface"]["errors"]["point"], 1e-9);
    EXPECT_LT(segment["surface"]["errors"]["normal"], 1e-9);
  }
  std::map<std::string, int> snaps;
  for (const auto& snap : report["regular"]) ++snaps[snap["regularity"]];
  EXPECT_EQ(snaps, (std::map<std::string, int>{{"parallel", 3}, {"perpendicular", 3}}));
  expect_failure(1, "--engineering", {"cube.off", "--regular"});
  expect_failure(1, "give --regular, too", {"cube.off", "--engineering", "--regular-angle", "1"});
}

TEST_F(Segment_mesh_tool, ReckonsWithTheNoiseThatIsGivenAndReportsIt) {
  write("cube.off", cube_of_separate_squares(4));
  const auto noise_of = [&](const std::vector<std::string>& arguments) {
    EXPECT_EQ(run(std::vector<std::string>{"cube.off", "--engineering", "--report", "c.json"} + arguments).exit_code,
              0);
    return nlohmann::json::parse(content_of(path("c.json")))["noise"].get<double>();
  };
  EXPECT_EQ(noise_of({}), 0);
  EXPECT_EQ(noise_of({"--noise", "0"}), 0);
  EXPECT_NEAR(noise_of({"--noise", "0.01"}), 0.01, 1e-12);
  expect_failure(1, "--engineering", {"cube.off", "--noise", "0.01"});
  expect_failure(1, "--noise", {"cube.off", "--engineering", "--noise", "-1"});
}

TEST_F(Segment_mesh_tool, EdgesSharperThanAnAngleAreWalls) {
  constexpr std::size_t n = 5;
  write("cube.off", cube_of_separate_squares(n));
  ASSERT_EQ(run({"cube.off", "--constraints-angle", "45", "--segments", "6", "--labels", "c.seg", "--report", "c.json"})
                .exit_code,
            0);
  EXPECT_EQ(nlohmann::json::parse(content_of(path("c.json")))["walls"], 12 * n);
  std::set<std::pair<std::size_t, std::size_t>> pairs;  // side, label
  const auto found = labels("c.seg");
  for (std::size_t f = 0; f < found.size(); ++f) pairs.emplace(f / (n * n), found[f]);
  EXPECT_EQ(pairs.size(), 6U);
  ASSERT_EQ(run({"cube.off", "--constraints-angle", "91", "--labels", "c.seg", "--report", "c.json"}).exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(content_of(path("c.json")))["walls"], 0);
}

TEST_F(Segment_mesh_tool, AWallThatEndsIsWalkedRound) {
  write("strip.off", strip(10));
  write("whole.txt", "10 11\n");
  ASSERT_EQ(run({"strip.off", "--seed", "0", "--constraints", "whole.txt", "--labels", "s.seg"}).exit_code, 0);
  std::vector<std::size_t> expected(10, 0);
  expected.resize(20, 1);
  EXPECT_EQ(labels("s.seg"), expected);

  write("grid.off", grid(4));
  write("part.txt", "2 7\n7 12\n");
  ASSERT_EQ(run({"grid.off", "--seed", "0", "--constraints", "part.txt", "--labels", "g.seg"}).exit_code, 0);
  EXPECT_EQ(labels("g.seg"), std::vector<std::size_t>(16, 0));
}

TEST_F(Segment_mesh_tool, BoundariesOnWallsAreNotSmoothed) {
  const int n = 12;
  std::ostringstream sheet, stairs;
  sheet << "OFF\n" << (n + 1) * (n + 1) << ' ' << 2 * n * n << " 0\n";
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) sheet << x << ' ' << y << " 0\n";
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x;
      sheet << "3 " << a << ' ' << a + 1 << ' ' << a + n + 2 << "\n3 " << a << ' ' << a + n + 2 << ' ' << a + n + 1
            << '\n';
    }
  for (int y = 0; y < n; ++y) {  // up one step, and one to the side
    const int a = y * (n + 1) + 6 + y % 2, up = a + n + 1;
    stairs << a << ' ' << up << '\n';
    if (y + 1 < n) stairs << up << ' ' << (y % 2 == 0 ? up + 1 : up - 1) << '\n';
  }
  write("sheet.off", sheet.str());
  write("stairs.txt", stairs.str());
  const auto faces = [&](const std::vector<std::string>& arguments) {
    const Result result = run(std::vector<std::string>{"sheet.off", "--seed", "0", "--seed",
                                                       std::to_string(2 * n * n - 1), "--labels", "s.seg"} +
                              arguments);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return labels("s.seg").size();
  };
  EXPECT_EQ(faces({"--constraints", "stairs.txt", "--refine"}), std::size_t(2 * n * n));
  EXPECT_GT(faces({"--refine"}), std::size_t(2 * n * n));
}

TEST_F(Segment_mesh_tool, EachMeshHasItsOwnFileOfWalls) {
  write("a.off", strip(4));
  write("b.off", strip(4));
  write("a.txt", "2 3\n");
  write("b.txt", "6 7\n");
  ASSERT_EQ(run({"a.off", "b.off", "--seed", "0", "--constraints", "%.txt", "--labels", "%.seg"}).exit_code, 0);
  EXPECT_EQ(labels("a.seg"), (std::vector<std::size_t>{0, 0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(labels("b.seg"), (std::vector<std::size_t>{0, 0, 0, 0, 0, 0, 1, 1}));
}

TEST_F(Segment_mesh_tool, AWrongWallIsRefusedWithItsLine) {
  write("strip.off", strip(3));
  const auto expect = [&](int code, const std::string& text, const std::string& walls) {
    write("walls.txt", walls);
    expect_failure(code, text, {"strip.off", "--seed", "0", "--labels", "l.seg", "--constraints", "walls.txt"});
  };
  expect(3, "walls.txt:3: no edge of the mesh joins vertex 0 and vertex 5", "# walls\n2 3\n0 5\n");
  expect(3, "walls.txt:1: no edge of the mesh joins vertex 2 and vertex 2", "2 2\n");
  expect(3, "walls.txt:2: the file has 8 vertices, the first is vertex 0", "2 3\n2 8\n");
  expect(2, "walls.txt:2: the second vertex is missing", "2 3\n2\n");
  expect(2, "walls.txt:1: the first vertex is 'x', not a whole number", "x 3\n");
  expect(2, "walls.txt:1: the first vertex is negative: -1", "-1 3\n");
  expect(2, "walls.txt:1: an edge has two vertices, and here is more", "2 3 4\n");
  expect_failure(2, "missing.txt: No such file", {"strip.off", "--seed", "0", "--constraints", "missing.txt"});
  write("walls.txt", "# none\n");
  EXPECT_EQ(run({"strip.off", "--seed", "0", "--constraints", "walls.txt", "--quiet"}).exit_code, 0);
}

// ---- Other kinds of output ----

TEST_F(Segment_mesh_tool, AnObjFileHasAGroupAndAMaterialForEachSegment) {
  write("cube.off", cube_of_separate_squares(3));
  ASSERT_EQ(run(std::vector<std::string>{"cube.off", "-o", "out.obj", "--report", "r.json"} + six_sides).exit_code, 0);
  std::map<std::string, std::size_t> faces_of_group;
  std::istringstream obj(content_of(path("out.obj")));
  std::string line, group, material;
  EXPECT_TRUE(std::getline(obj, line) && line == "mtllib out.mtl");
  while (std::getline(obj, line)) {
    if (line.compare(0, 2, "g ") == 0) group = line.substr(2);
    if (line.compare(0, 7, "usemtl ") == 0) material = line.substr(7);
    if (line.compare(0, 2, "f ") != 0) continue;
    EXPECT_EQ(group, material);
    ++faces_of_group[group];
  }
  const std::string materials = content_of(path("out.mtl"));
  const nlohmann::json report = nlohmann::json::parse(content_of(path("r.json")));
  for (const auto& segment : report["segments"]) {
    const std::string name = "segment_" + std::to_string(segment["label"].get<int>());
    EXPECT_EQ(faces_of_group[name], 9U) << name;
    std::istringstream entry(materials.substr(std::min(materials.size(), materials.find("newmtl " + name + "\nKd "))));
    std::string word;
    entry >> word >> word >> word;
    for (const double channel : segment["color"]) {
      double written = -1;
      entry >> written;
      EXPECT_NEAR(255 * written, channel, 1e-3) << name;
    }
  }
  EXPECT_EQ(faces_of_group.size(), 6U);
  EXPECT_EQ(run({"out.obj", "--quiet", "--segments", "6"}).exit_code, 0);
}

TEST_F(Segment_mesh_tool, PointColorsAreThoseOfTheFaces) {
  const int n = 4;
  write("grid.off", grid(n));
  const std::vector<std::string> seeds = {"grid.off", "--seed", "0", "--seed", "15", "--output"};
  ASSERT_EQ(run(seeds + std::vector<std::string>{"faces.off"}).exit_code, 0);
  ASSERT_EQ(run(seeds + std::vector<std::string>{"points.off", "--point-colors"}).exit_code, 0);
  std::istringstream by_face(content_of(path("faces.off"))), by_point(content_of(path("points.off")));
  std::string header, rest;
  std::size_t points = 0, points_apart = 0, faces = 0, faces_apart = 0, edges = 0;
  by_face >> header >> points >> faces >> edges;
  by_point >> header >> points_apart >> faces_apart >> edges;
  EXPECT_EQ(header, "COFF");
  EXPECT_EQ(faces_apart, faces);
  EXPECT_GT(points_apart, points);  // those between the two segments
  std::vector<std::array<int, 3>> color_of_point(points_apart);
  for (std::size_t v = 0; v < points; ++v) std::getline(by_face >> std::ws, rest);
  double x = 0, y = 0, z = 0;
  int alpha = 0;
  for (auto& [red, green, blue] : color_of_point) ASSERT_TRUE(by_point >> x >> y >> z >> red >> green >> blue >> alpha);
  for (std::size_t f = 0; f < faces; ++f) {
    std::size_t degree = 0, corner = 0;
    std::array<int, 3> color{};
    by_face >> degree;
    for (std::size_t i = 0; i < degree; ++i) by_face >> corner;
    ASSERT_TRUE(by_face >> color[0] >> color[1] >> color[2]);
    by_point >> degree;
    for (std::size_t i = 0; i < degree; ++i) {
      ASSERT_TRUE(by_point >> corner);
      EXPECT_EQ(color_of_point.at(corner), color);
    }
  }
}

TEST_F(Segment_mesh_tool, PointColorsThatNoOutputHasAreRefused) {
  write("strip.off", strip(3));
  const std::vector<std::string> point_colors = {"strip.off", "--point-colors"};
  for (const std::vector<std::string>& outputs :
       std::vector<std::vector<std::string>>{{},
                                             {"--labels", "o.seg"},
                                             {"-o", "o.stl"},
                                             {"-o", "o.glb", "-o", "o.vtp"},
                                             {"--split", "parts", "--output-format", "stl"}})
    expect_failure(1, "--point-colors: only .ply, .off and .obj have them", point_colors + outputs);
  for (const std::vector<std::string>& outputs : std::vector<std::vector<std::string>>{
           {"-o", "o.stl", "-o", "o.obj"}, {"--split", "parts"}, {"--split", "texts", "--output-format", "off"}})
    EXPECT_EQ(run(point_colors + outputs).exit_code, 0) << testing::PrintToString(outputs);
}

// ---- Several meshes ----

TEST_F(Segment_mesh_tool, SeveralMeshesGetWhatEachGetsAlone) {
  write("a.off", tower(2));
  write("b.off", tower(3));
  std::filesystem::create_directory(path("out"));
  const Result result = run({"a.off", "b.off", "--labels", "out/%.seg", "--output", "out/%.ply", "--split", "parts_%",
                             "--report", "all.jsonl"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(number_of_lines(result.output), 2U) << result.output;
  std::istringstream report(content_of(path("all.jsonl")));
  for (const std::string name : {"a", "b"}) {
    ASSERT_EQ(run({name + ".off", "--labels", "alone.seg", "--output", "alone.ply"}).exit_code, 0);
    EXPECT_EQ(content_of(path("alone.seg")), content_of(path("out/" + name + ".seg")));
    EXPECT_EQ(content_of(path("alone.ply")), content_of(path("out/" + name + ".ply")));
    EXPECT_TRUE(std::filesystem::exists(path("parts_" + name + "/segment_0.ply")));
    std::string line;
    ASSERT_TRUE(std::getline(report, line));
    EXPECT_EQ(nlohmann::json::parse(line)["mesh"], name + ".off");
  }

  write("list.txt", "a.off\n\nb.off\r\n");
  ASSERT_EQ(run({"--list", "list.txt", "--labels", "%.seg", "--report", "%.json"}).exit_code, 0);
  EXPECT_EQ(content_of(path("a.seg")), content_of(path("out/a.seg")));
  EXPECT_EQ(content_of(path("b.seg")), content_of(path("out/b.seg")));
  EXPECT_EQ(nlohmann::json::parse(content_of(path("b.json")))["mesh"], "b.off");
}

TEST_F(Segment_mesh_tool, AMeshThatFailsDoesNotEndTheWork) {
  write("bad.off", "OFF\n3 1 0\n0 0 0\n");
  write("good.off", strip(3));
  const Result result = run({"bad.off", "missing.off", "good.off", "--labels", "%.seg", "--report", "all.jsonl"});
  EXPECT_EQ(result.exit_code, 6) << result.errors;
  EXPECT_NE(result.errors.find("2 of 3 meshes failed"), std::string::npos) << result.errors;
  EXPECT_EQ(labels("good.seg").size(), 6U);
  EXPECT_FALSE(std::filesystem::exists(path("bad.seg")));
  std::istringstream report(content_of(path("all.jsonl")));
  std::string line;
  for (const bool fails : {true, true, false}) {
    ASSERT_TRUE(std::getline(report, line));
    const auto entry = nlohmann::json::parse(line);
    EXPECT_EQ(entry.contains("error"), fails) << line;
    if (fails) {
      EXPECT_EQ(entry["exit_code"], 2) << line;
    }
  }
}

TEST_F(Segment_mesh_tool, ResumingDoesOnlyWhatIsMissingOrOlderThanTheMesh) {
  const std::vector<std::string> names = {"a", "b", "c", "d"};
  for (const std::string& name : names) write(name + ".off", strip(3));
  const std::vector<std::string> arguments = {"a.off",   "b.off",   "c.off",    "d.off",     "--labels", "%.seg",
                                              "--split", "parts_%", "--report", "all.jsonl", "--resume"};
  ASSERT_EQ(run(arguments).exit_code, 0);
  EXPECT_EQ(number_of_lines(content_of(path("all.jsonl"))), 4U);
  const auto second = run(arguments);
  EXPECT_EQ(second.exit_code, 0) << second.errors;
  EXPECT_EQ(number_of_lines(content_of(path("all.jsonl"))), 4U);

  using namespace std::chrono_literals;
  std::filesystem::remove(path("a.seg"));
  std::filesystem::remove_all(path("parts_a"));
  std::filesystem::remove_all(path("parts_b"));
  std::filesystem::remove_all(path("parts_d"));
  for (const char* file : {"d.seg", "parts_c/segment_0.ply"})
    std::filesystem::last_write_time(path(file), std::filesystem::last_write_time(path("d.off")) + 1h);
  std::filesystem::last_write_time(path("d.off"), std::filesystem::last_write_time(path("d.off")) + 2h);
  ASSERT_EQ(run(arguments).exit_code, 0);
  std::istringstream report(content_of(path("all.jsonl")));
  std::vector<std::string> done;
  for (std::string line; std::getline(report, line);) done.push_back(nlohmann::json::parse(line)["mesh"]);
  EXPECT_EQ(done, (std::vector<std::string>{"a.off", "b.off", "c.off", "d.off", "a.off", "b.off", "d.off"}));
  for (const std::string& name : names) EXPECT_EQ(labels(name + ".seg").size(), 6U);
}

TEST_F(Segment_mesh_tool, ResumingDoesAgainWhatIsOlderThanAnyOfItsInputs) {
  using namespace std::chrono_literals;
  for (const std::string name : {"a", "b"}) {
    write(name + ".off", strip(3));
    write(name + ".seeds", "0\n5\n");
    write(name + ".walls", "0 1\n");
  }
  write("page.html", "<html>" + place_for_result + "null</script></html>\n");
  const std::vector<std::string> arguments = {"a.off",    "b.off",     "--seeds-file", "%.seeds", "--constraints",
                                              "%.walls",  "--html",    "out_%.html",   "--page",  "page.html",
                                              "--report", "all.jsonl", "--resume"};
  ASSERT_EQ(run(arguments).exit_code, 0);
  const auto now = std::filesystem::last_write_time(path("page.html"));
  for (const auto& [changed, meshes] :
       {std::pair<std::string, std::size_t>("a.seeds", 1), {"b.walls", 1}, {"page.html", 2}}) {
    for (const auto& [name, content] : files()) std::filesystem::last_write_time(path(name), now - 2h);
    std::filesystem::last_write_time(path(changed), now - 1h);
    const std::size_t before = number_of_lines(content_of(path("all.jsonl")));
    ASSERT_EQ(run(arguments).exit_code, 0) << changed;
    EXPECT_EQ(number_of_lines(content_of(path("all.jsonl"))), before + meshes) << changed;
    ASSERT_EQ(run(arguments).exit_code, 0) << changed;
    EXPECT_EQ(number_of_lines(content_of(path("all.jsonl"))), before + meshes) << changed;
  }
}

TEST_F(Segment_mesh_tool, ResumingGoesOnAfterTheLastWholeLineOfTheReport) {
  write("a.off", strip(3));
  write("b.off", strip(3));
  const std::vector<std::string> arguments = {"a.off",    "b.off",     "--labels", "%.seg",
                                              "--report", "all.jsonl", "--resume"};
  write("all.jsonl", "{\"mesh\": \"z.off\"}\n{\"mesh\": \"a.of");
  ASSERT_EQ(run(arguments).exit_code, 0);
  std::istringstream report(content_of(path("all.jsonl")));
  std::vector<std::string> meshes;
  for (std::string line; std::getline(report, line);) meshes.push_back(nlohmann::json::parse(line)["mesh"]);
  EXPECT_EQ(meshes, (std::vector<std::string>{"z.off", "a.off", "b.off"}));
}

TEST_F(Segment_mesh_tool, ResumingWithOneMeshGoesOnWithTheReport) {
  write("a.off", strip(3));
  write("b.off", strip(3));
  ASSERT_EQ(run({"a.off", "b.off", "--labels", "%.seg", "--report", "all.jsonl", "--resume"}).exit_code, 0);
  write("c.off", strip(3));
  for (int i = 0; i < 2; ++i)
    ASSERT_EQ(run({"c.off", "--labels", "%.seg", "--report", "all.jsonl", "--resume"}).exit_code, 0);
  EXPECT_EQ(number_of_lines(content_of(path("all.jsonl"))), 3U);
}

TEST_F(Segment_mesh_tool, LinksToOneMeshAreMeshesOfTheirOwn) {
  write("a.off", strip(3));
  std::filesystem::create_symlink("a.off", path("b.off"));
  ASSERT_EQ(run({"a.off", "b.off", "--labels", "%.seg"}).exit_code, 0);
  EXPECT_EQ(labels("b.seg").size(), 6U);
  expect_failure(1, "b.off is an input or another output", {"a.off", "--labels", "b.off"});
}

TEST_F(Segment_mesh_tool, OutputsOverwriteNoInputOfAnyKind) {
  write("a.off", strip(3));
  write("seeds.txt", "0\n5\n");
  write("walls.txt", "0 1\n");
  write("list.txt", "a.off\n");
  write("page.html", "");
  expect_failure(1, "seeds.txt is an input", {"a.off", "--seeds-file", "seeds.txt", "--labels", "seeds.txt"});
  expect_failure(1, "walls.txt is an input", {"a.off", "--constraints", "walls.txt", "--labels", "./walls.txt"});
  expect_failure(1, "list.txt is an input", {"--list", "list.txt", "--labels", "%.seg", "--report", "list.txt"});
  expect_failure(1, "page.html is an input", {"a.off", "--page", "page.html", "--html", "page.html"});
}

TEST_F(Segment_mesh_tool, NamesThatAreNoUtf8AreReported) {
  write("caf\xe9.off", strip(3));
  const Result result = run({"caf\xe9.off", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(nlohmann::json::parse(content_of(path("r.json")))["mesh"], "caf\xef\xbf\xbd.off");
}

TEST_F(Segment_mesh_tool, OptionsWithNothingAreRefused) {
  write("a.off", strip(3));
  for (const char* option : {"--labels", "--seeds-file", "--constraints", "--split", "--report", "--list"})
    expect_failure(1, std::string(option) + ": nothing is given to it", {"a.off", option, ""});
  expect_failure(1, "nothing is given to it", {""});
}

TEST_F(Segment_mesh_tool, ClosedPartsMayHaveNoFaceOfTheFile) {
  // Two triangles on the two sides of a corner that a face has twice: two parts, of which the first speaks for the face.
  write("bow.off", "OFF\n7 2 0\n0 0 0\n1 0 0\n1 1 0\n-1 0 0\n-1 -1 0\n2 0 0\n2 1 0\n6 0 1 2 0 3 4\n3 1 5 2\n");
  const Result result = run({"bow.off", "--cap-parts", "--output", "bow.3mf", "--split", "parts", "--labels", "l.seg"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(labels("l.seg").size(), 2U);
}

TEST_F(Segment_mesh_tool, FilesOfSeveralMeshesNeverMeet) {
  write("a.off", strip(3));
  write("b.off", strip(3));
  std::filesystem::create_directory(path("more"));
  write("more/a.off", strip(3));
  expect_failure(1, "several meshes need a %", {"a.off", "b.off", "--labels", "l.seg"});
  expect_failure(1, "a.seg is an input or another output", {"a.off", "more/a.off", "--labels", "%.seg"});
  expect_failure(1, "./a.off is given twice", {"a.off", "b.off", "./a.off"});
  expect_failure(1, "a.off is an input or another output", {"a.off", "b.off", "--output", "%.off"});
  expect_failure(1, "b.off is an input or another output", {"a.off", "b.off", "--report", "b.off"});
  expect_failure(5, "no_such_folder/%.seg", {"a.off", "b.off", "--labels", "no_such_folder/%.seg"});
  expect_failure(1, "--resume", {"a.off", "b.off", "--report", "all.jsonl", "--resume"});
  expect_failure(2, "missing.txt", {"--list", "missing.txt"});
}

TEST_F(Segment_mesh_tool, CtrlCKeepsTheMeshesThatAreDone) {
  write("first.off", strip(3));
  write("second.off", grid(100 * longer_without_sanitizer));
  const pid_t process = start({"first.off", "second.off", "--labels", "%.seg", "--report", "all.jsonl", "--seed", "0"});
  const auto is_at_second = [&] {
    for (const auto& [name, content] : files())
      if (name.compare(0, 15, "second.seg.part") == 0) return true;
    return false;
  };
  for (int i = 0; i < 60000 && !is_at_second(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_TRUE(is_at_second());
  kill(process, SIGINT);
  EXPECT_EQ(wait(process).exit_code, 130);
  EXPECT_EQ(labels("first.seg").size(), 6U);
  EXPECT_EQ(number_of_lines(content_of(path("all.jsonl"))), 1U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("")), {}), 4);
}

// ---- What it refuses ----

TEST_F(Segment_mesh_tool, WrongUsageIsCodeOne) {
  write("strip.off", strip(3));
  expect_failure(1, "mesh is required", {});
  expect_failure(1, "--no-such-option", {"strip.off", "--no-such-option"});
  expect_failure(1, "--seed: 'x' is no seed", {"strip.off", "--seed", "x"});
  expect_failure(1, "--seed: '-1' is no seed", {"strip.off", "--seed", "-1"});
  expect_failure(1, "--seed: '1,2' is no seed", {"strip.off", "--seed", "1,2"});
  expect_failure(1, "--seed: '1=-1' is no seed", {"strip.off", "--seed", "1=-1"});
  expect_failure(1, "--sigma", {"strip.off", "--seed", "0", "--sigma", "wide"});
  expect_failure(1, "--measure", {"strip.off", "--seed", "0", "--measure", "tangent"});
  expect_failure(1, "--segments", {"strip.off", "--segments", "-1"});
  expect_failure(1, "--coarse", {"strip.off", "--coarse", "--seed", "1"});
  expect_failure(1, "--seed: '1=2': labels have no meaning", {"strip.off", "--segments", "2", "--seed", "1=2"});
  expect_failure(1, "--probabilities", {"strip.off", "--probabilities", "p.txt"});
  expect_failure(1, "--hierarchy", {"strip.off", "--seed", "1", "--hierarchy", "h.json"});
  expect_failure(1, "--page", {"strip.off", "--page", "page.html"});
  expect_failure(1, "out.xyz is none of .ply, .off, .obj, ", {"strip.off", "--seed", "0", "-o", "out.xyz"});
  expect_failure(1, "strip.off is an input or another output", {"strip.off", "--seed", "0", "-o", "./strip.off"});
  expect_failure(1, "a.off is an input or another output",
                 {"strip.off", "--seed", "0", "-o", "a.off", "--labels", "a.off"});
}

TEST_F(Segment_mesh_tool, UnreadableInputIsCodeTwo) {
  write("strip.off", strip(3));
  write("other.html", "<html></html>");
  for (const auto& [page, message] : {std::pair("missing.html", "missing.html: the page is not there"),
                                      {"other.html", "other.html: this page has no place for a result"}})
    expect_failure(2, message, {"strip.off", "--labels", "l.seg", "--html", "h.html", "--page", page});
  expect_failure(2, "missing.off: No such file or directory", {"missing.off", "--seed", "0", "--labels", "l.seg"});
  expect_failure(2, ".: this is a folder", {".", "--seed", "0"});
  for (const auto& [name, content, message] : std::vector<std::array<std::string, 3>>{
           {"empty.ply", "", "empty.ply: the file is empty"},
           {"cut.off", strip(5).substr(0, 60), "cut.off:"},
           {"garbage.stl", std::string(500, '\xaa'), "garbage.stl: the header promises"},
           {"lie.off", "OFF\n4000000000 4000000000 0\n", "lie.off:2: the header promises 4000000000 vertices"},
           {"nan.obj", "v 0 0 0\nv 1 nan 0\n", "nan.obj:2: the y coordinate is not finite"},
           {"point.off", "OFF\n3 1 0\n1 1 1\n1 1 1\n1 1 1\n3 0 1 2\n",
            "point.off: no face has three different corners"},
           {"flat.off", "OFF\n3 1 0\n0 0\n1 0\n1 1\n3 0 1 2\n", "flat.off:3: the z coordinate is missing"}}) {
    write(name, content);
    expect_failure(2, message, {name, "--seed", "0", "--labels", "l.seg", "-o", "l.ply"});
  }
  write("strip.off", strip(3));
  write("seeds.txt", "1\n# fine so far\n1;2\n");
  expect_failure(2, "seeds.txt:3: '1;2' is no seed", {"strip.off", "--seeds-file", "seeds.txt"});
  expect_failure(2, "missing.txt: No such file", {"strip.off", "--seeds-file", "missing.txt"});
}

TEST_F(Segment_mesh_tool, AnArgumentOutOfRangeIsCodeThree) {
  write("strip.off", strip(3));
  const auto expect = [&](const std::string& text, const std::vector<std::string>& arguments) {
    expect_failure(3, text, std::vector<std::string>{"strip.off", "--labels", "l.seg"} + arguments);
  };
  expect("strip.off: seed 6: the file has 6 faces, the first is face 0", {"--seed", "6"});
  expect("seed 18446744073709551615: the file has 6 faces", {"--seed", "18446744073709551615"});
  expect("seed 2=1: another seed gives the same face the label 0", {"--seed", "2=0", "--seed", "2=1"});
  expect("--segments is '0', but must be a whole number from 1", {"--segments", "0"});
  expect("strip.off: --segments is 7, but must be from 1", {"--segments", "7"});
  expect("--seeds is '0', but must be a whole number from 1", {"--seeds", "0"});
  for (const char* sigma : {"0", "-1", "nan", "inf"}) expect("--sigma is ", {"--seed", "0", "--sigma", sigma});
  for (const char* cap : {"0", "-1", "nan"}) expect("--cap is ", {"--seed", "0", "--cap", cap});
  for (const char* weight : {"-0.1", "1.1", "nan"})
    expect("--convex-weight is ", {"--seed", "0", "--convex-weight", weight});
  for (const char* radius : {"-1", "nan", "inf"}) expect("--smoothing is ", {"--seed", "0", "--smoothing", radius});
}

TEST_F(Segment_mesh_tool, AnOutputThatCannotBeWrittenIsCodeFive) {
  write("strip.off", strip(3));
  expect_failure(5, "no_such_folder/l.seg: No such file or directory",
                 {"strip.off", "--seed", "0", "--labels", "no_such_folder/l.seg"});
  expect_failure(5, "no_such_folder/l.ply: No such file or directory",
                 {"strip.off", "--seed", "0", "--labels", "l.seg", "-o", "no_such_folder/l.ply"});
}

TEST_F(Segment_mesh_tool, CtrlCEndsItCleanly) {
  write("grid.off", grid(100 * longer_without_sanitizer));  // keeps it busy for a while
  const pid_t process = start({"grid.off", "--labels", "l.seg", "-o", "l.ply", "--seed", "0", "--seed", "9999"});
  // The outputs are created, under other names, before the work begins.
  const auto is_at_work = [&] { return std::distance(std::filesystem::directory_iterator(path("")), {}) > 1; };
  for (int i = 0; i < 60000 && !is_at_work(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_TRUE(is_at_work());
  kill(process, SIGINT);
  const Result result = wait(process);
  EXPECT_EQ(result.exit_code, 130) << result.errors;
  EXPECT_NE(result.errors.find("cancelled, nothing was written\n"), std::string::npos) << result.errors;
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("")), {}), 1);
}

// ---- What ends it early ----

TEST_F(Segment_mesh_tool, KilledAtAnyMomentItLeavesTheOldOutputOrTheNewOne) {
  write("grid.off", grid(50));
  const std::vector<std::string> outputs = {"out.ply", "out.seg", "out.obj"},
                                 task = {"grid.off", "--output", outputs[0], "--labels",    outputs[1], "--output",
                                         outputs[2], "--seed",   "0",        "--smoothing", "0",        "--quiet"};
  ASSERT_EQ(run(task).exit_code, 0);
  const auto old = files();
  const std::vector<std::string> new_task = task + std::vector<std::string>{"--seed", "2480"};
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(run(new_task).exit_code, 0);
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - begin;
  const auto expected = files();
  for (const std::string& name : outputs) ASSERT_NE(old.at(name), expected.at(name));

  const auto is_writing = [&] {
    for (const auto& entry : std::filesystem::directory_iterator(path("")))
      if (entry.path().string().find(".part") != std::string::npos && entry.file_size() > 0) return true;
    return false;
  };
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    for (const auto& [name, content] : old) write(name, content);
    const pid_t process = start(new_task);
    if (round % 2 == 0)
      std::this_thread::sleep_for(std::uniform_real_distribution<>(0, 1)(random) * duration);
    else
      for (int i = 0; i < 100000 && !is_writing() && waitpid(process, nullptr, WNOHANG | WNOWAIT) == 0; ++i)
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    kill(process, SIGKILL);
    wait(process);
    const auto left = files();
    for (const std::string& name : outputs)
      EXPECT_TRUE(left.at(name) == old.at(name) || left.at(name) == expected.at(name)) << name;
  }
  EXPECT_EQ(run(new_task).exit_code, 0);  // whatever was left behind
  for (const std::string& name : outputs) EXPECT_EQ(content_of(path(name)), expected.at(name));
}

TEST_F(Segment_mesh_tool, AFullDiskIsCodeFiveAndTheOldOutputsStay) {
  write("grid.off", grid(30));
  for (const char* name : {"l.seg", "l.ply", "l.json"}) write(name, "old");
  expect_failure(5, "l.seg: File too large", {"grid.off", "--labels", "l.seg", "--seed", "0=1000000"}, [] {
    const rlimit size = {1000, 1000};
    setrlimit(RLIMIT_FSIZE, &size);
  });
  if (!std::filesystem::exists("/dev/full")) return;
  expect_failure(5, "/dev/full: No space left on device",
                 {"grid.off", "-o", "l.ply", "--report", "l.json", "--labels", "/dev/full"});
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(Segment_mesh_tool, PipesAreWrittenToAndLinksStayLinks) {
  write("strip.off", strip(3));
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  const pid_t process = start({"strip.off", "--seed", "0=4", "--labels", "pipe"});
  EXPECT_EQ(content_of(path("pipe")), "4\n4\n4\n4\n4\n4\n");
  EXPECT_EQ(wait(process).exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_fifo(path("pipe")));

  std::filesystem::create_directory(path("elsewhere"));
  write("elsewhere/old.seg", "old");
  std::filesystem::create_symlink("elsewhere/old.seg", path("link.seg"));
  ASSERT_EQ(run({"strip.off", "--seed", "0=4", "--labels", "link.seg"}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.seg")));
  EXPECT_EQ(content_of(path("elsewhere/old.seg")), "4\n4\n4\n4\n4\n4\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("elsewhere")), {}), 1);
}

TEST_F(Segment_mesh_tool, WithAnyTimeLimitItWritesAllOrNothing) {
  write("grid.off", grid(60));
  write("l.seg", "old");
  const std::vector<std::string> task = {"grid.off", "--labels", "l.seg", "--seed",
                                         "0",        "--seed",   "59",    "--time-limit"};
  const std::string text = "grid.off: the time limit is over, nothing was written";
  expect_failure(7, text, task + std::vector<std::string>{"1e-9"});
  for (double seconds = 1e-3; content_of(path("l.seg")) == "old"; seconds *= 1.5) {
    const Result result = run(task + std::vector<std::string>{std::to_string(seconds)});
    if (result.exit_code == 0) break;
    EXPECT_EQ(result.exit_code, 7);
    EXPECT_NE(result.errors.find(text), std::string::npos) << result.errors;
    ASSERT_EQ(content_of(path("l.seg")), "old");
    ASSERT_EQ(files().size(), 2U);
  }
  EXPECT_EQ(labels("l.seg").size(), 3600U);
}

TEST_F(Segment_mesh_tool, TheTimeLimitIsThatOfEachMesh) {
  write("a.off", strip(3));
  write("b.off", strip(3));
  const Result result = run({"a.off", "b.off", "--labels", "%.seg", "--report", "all.jsonl", "--time-limit", "1e-9"});
  EXPECT_EQ(result.exit_code, 6) << result.errors;
  std::istringstream report(content_of(path("all.jsonl")));
  for (std::string line; std::getline(report, line);) EXPECT_EQ(nlohmann::json::parse(line)["exit_code"], 7) << line;
  EXPECT_EQ(number_of_lines(report.str()), 2U);
  EXPECT_EQ(files().size(), 3U);
}

TEST_F(Segment_mesh_tool, LimitsAreCheckedBeforeAnythingIsDone) {
  write("strip.off", strip(3));
  for (const char* seconds : {"0", "-1", "nan", "soon"})
    expect_failure(1, "--time-limit", {"strip.off", "--seed", "0", "--labels", "l.seg", "--time-limit", seconds});
  for (const char* size : {"0", "-1", "63M", "1000", "2X", "much"})
    expect_failure(1, "--max-memory", {"strip.off", "--seed", "0", "--labels", "l.seg", "--max-memory", size});
}

#ifndef __SANITIZE_ADDRESS__  // which needs all the memory that there is

TEST_F(Segment_mesh_tool, AMeshThatNeedsMoreMemoryIsGivenUpAndTheNextOneDone) {
  write("big.off", grid(400));
  write("small.off", strip(3));
  const std::vector<std::string> limit = {"--seed", "0", "--seed", "5", "--max-memory", "64M"};
  write("l.seg", "old");
  expect_failure(7, "big.off: out of the memory that --max-memory allows",
                 std::vector<std::string>{"big.off", "--labels", "l.seg"} + limit);
  const Result result = run(std::vector<std::string>{"big.off", "small.off", "--labels", "%.seg", "--quiet"} + limit);
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_FALSE(std::filesystem::exists(path("big.seg")));
  EXPECT_EQ(labels("small.seg").size(), 6U);
  EXPECT_EQ(run({"big.off", "--quiet", "--seed", "0", "--seed", "5", "--max-memory", "4G"}).exit_code, 0);
}

TEST_F(Segment_mesh_tool, AHeaderThatPromisesBillionsTakesNoMemory) {
  const std::string ply =
      "element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4000000000\nproperty list uchar int vertex_indices\nend_header\n";
  write("lie.off", "OFF\n4000000000 4000000000 0\n");
  write("text.ply", "ply\nformat ascii 1.0\n" + ply);
  write("binary.ply", "ply\nformat binary_little_endian 1.0\n" + ply + std::string(100, '\0'));
  write("lie.stl", std::string(80, ' ') + "\xff\xff\xff\xff" + std::string(100, '\0'));
  write("degree.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n");
  write("far.obj", "v 0 0 0\nf 1 2 4000000000\n");
  for (const auto& [name, content] : files())
    expect_failure(2, name, {name, "--seed", "0", "--labels", "l.seg", "--max-memory", "64M"});
}

#endif

TEST_F(Segment_mesh_tool, HelpAndVersionGoToStandardOutput) {
  const Result help = run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.output.find("Exit codes"), std::string::npos);
  EXPECT_EQ(help.errors, "");
  const Result page = run({"--man"});
  EXPECT_EQ(page.exit_code, 0);
  EXPECT_EQ(page.errors, "");
  // Every option of the help stands in the manual page, and every exit code in both.
  std::istringstream words(help.output);
  std::size_t options = 0;
  for (std::string word; words >> word;) {
    if (word.compare(0, 2, "--") != 0) continue;
    std::string name = word.substr(2, word.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", 2) - 2);
    for (std::size_t at = 0; (at = name.find('-', at)) != std::string::npos; at += 2) name.insert(at, "\\");
    EXPECT_NE(page.output.find("\\-\\-" + name), std::string::npos) << word;
    ++options;
  }
  EXPECT_GT(options, 25U);
  for (const char* code : {"0  success", "6  one or more", "7  the limit", "130  cancelled"})
    for (const std::string* text : {&help.output, &page.output}) EXPECT_NE(text->find(code), std::string::npos) << code;
  const Result version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.output.find("segment_mesh "), 0U);
}

}  // namespace

}  // namespace test_segment_mesh_tool

#endif
