// SPDX-License-Identifier: MIT

// The tool on tiles of one mesh: steps in files, workers that are killed, work that goes on where it stopped.

#include <gtest/gtest.h>

#ifndef SEGMENT_MESH

TEST(Tiles_tool, Runs) { GTEST_SKIP() << "the tool is not built"; }

#else

#include "meshes.h"
#include "segment_mesh_tool.h"

#include <nlohmann/json.hpp>

#include <signal.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace test_tiles_tool {

using namespace segment_mesh_tool;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::vector<const char*> step_names = {"survey",   "plan", "border",    "noise", "shape",  "places", "seeds",
                                             "clusters", "walk", "fragments", "merge", "labels", "report"};
bool is_of_each_tile(const std::string& step) {
  return std::set<std::string>{"survey", "border", "shape", "places", "clusters", "fragments", "labels"}.count(step) >
         0;
}

/// An OFF file.
std::string off_of(const meshes::Shape& shape) {
  std::ostringstream off;
  off.precision(17);
  off << "OFF\n" << shape.points.size() << ' ' << shape.faces.size() << " 0\n";
  for (const Eigen::Vector3d& point : shape.points) off << point.transpose() << '\n';
  for (const auto& face : shape.faces) {
    off << face.size();
    for (const auto v : face) off << ' ' << v;
    off << '\n';
  }
  return off.str();
}

/// Four tiles of a dumbbell: quarters round its axis.
class Tiles : public Segment_mesh_tool {
 protected:
  void SetUp() override {
    Segment_mesh_tool::SetUp();
    write_tiles(meshes::two_spheres_with_neck(2.6, 0.35, 40));
  }

  static Eigen::Vector3d middle_of(const meshes::Shape& shape, std::size_t face) {
    const auto& corners = shape.faces[face];
    return (shape.points[corners[0]] + shape.points[corners[1]] + shape.points[corners[2]]) / 3;
  }

  void write_tiles(const meshes::Shape& shape) {
    for (std::size_t t = 0; t < 4; ++t) {
      auto& number = vertex_number_[t];
      number.clear();
      faces_of_tile_[t].clear();
      std::ostringstream points, faces;
      points.precision(17);
      for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        const auto& face = shape.faces[f];
        const Eigen::Vector3d middle = middle_of(shape, f);
        if (std::size_t(middle[0] > 0.1) + 2 * std::size_t(middle[2] > 0.9) != t) continue;
        faces_of_tile_[t].push_back(f);
        faces << face.size();
        for (const auto v : face) {
          const auto [place, is_new] = number.emplace(v, number.size());
          if (is_new) points << shape.points[v].transpose() << '\n';
          faces << ' ' << place->second;
        }
        faces << '\n';
      }
      faces_[t] = faces_of_tile_[t].size();
      std::ostringstream off;
      off << "OFF\n" << number.size() << ' ' << faces_[t] << " 0\n" << points.str() << faces.str();
      write(name(t), off.str());
    }
  }

  static std::string name(std::size_t tile) { return "tile_" + std::to_string(tile) + ".off"; }

  static std::vector<std::string> command(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {name(0), name(1), name(2), name(3), "--tiled", "--labels", "%.seg"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  /// The labels of all tiles, which are taken away.
  std::vector<std::vector<std::size_t>> take_labels() const {
    std::vector<std::vector<std::size_t>> all;
    for (std::size_t t = 0; t < 4; ++t) {
      const std::string file = "tile_" + std::to_string(t) + ".seg";
      all.push_back(labels(file));
      fs::remove(path(file));
    }
    return all;
  }

  std::size_t faces_[4] = {};
  std::vector<std::size_t> faces_of_tile_[4];                 // of the shape
  std::map<std::size_t, std::size_t> vertex_number_[4] = {};  // in the file, by vertex of the shape
};

TEST_F(Tiles, HaveOneLabelWhereverASegmentGoesOn) {
  const Result result = run(command({"--segments", "2", "--report", "report.json", "--output", "%.ply"}));
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  const auto all = take_labels();
  const Json report = Json::parse(content_of(path("report.json")));
  ASSERT_EQ(report["segments"].size(), 2U);
  std::vector<std::size_t> faces(2, 0);
  for (std::size_t t = 0; t < 4; ++t) {
    EXPECT_EQ(all[t].size(), faces_[t]);
    for (const std::size_t label : all[t]) ++faces.at(label);
    EXPECT_TRUE(fs::exists(path("tile_" + std::to_string(t) + ".ply")));
  }
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_EQ(report["segments"][s]["faces"], faces[s]);
    EXPECT_NEAR(report["segments"][s]["area_share"].get<double>(), 0.5, 0.1);
  }
  EXPECT_EQ(report["components"], 1);
  EXPECT_EQ(report["tiles"], 4);
  // The two tiles above 0.9 have the upper ball alone.
  EXPECT_EQ(std::set<std::size_t>(all[2].begin(), all[2].end()), std::set<std::size_t>(all[3].begin(), all[3].end()));
}

/// Two dumbbells and a ball, which the tiles cut through, and crumbs beside them.
class Tiles_of_parts : public Tiles {
 protected:
  void SetUp() override {
    Segment_mesh_tool::SetUp();
    shape_ = meshes::two_spheres_with_neck(2.0001, 0.1, 24);
    const auto add = [&](const meshes::Shape& part, const Eigen::Vector3d& by) {
      shape_ = meshes::together(shape_, meshes::moved(part, by));
    };
    add(meshes::scaled(shape_, 0.5), {0, 3, 0.5});
    add(meshes::sphere(3), {0, -3, 0.5});
    for (const double x : {2., -2., 4.}) add(meshes::scaled(meshes::cube(1), 0.05), {x, 0, 0});
    write_tiles(shape_);
  }

  meshes::Shape shape_;
};

TEST_F(Tiles_of_parts, HaveTheSegmentsOfEachPartByItself) {
  ASSERT_EQ(run(command({"--report", "report.json", "--tile-folder", "work"})).exit_code, 0);
  const Json report = Json::parse(content_of(path("report.json")));
  EXPECT_EQ(report["components"], 6);
  EXPECT_EQ(report["segments"].size(), 8U);  // two of each dumbbell
  EXPECT_EQ(report["seeds"], 123);           // one in each crumb
  double shares = 0;
  for (const Json& segment : report["segments"]) shares += segment["area_share"].get<double>();
  EXPECT_NEAR(shares, 1, 1e-9);
  const auto by_part = take_labels();
  std::vector<std::size_t> label(shape_.faces.size());
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t f = 0; f < faces_[t]; ++f) label[faces_of_tile_[t][f]] = by_part[t][f];
  EXPECT_EQ(std::set<std::size_t>(label.begin(), label.end()).size(), 8U);
  const std::size_t crumbs = label.size() - 36;
  for (std::size_t f = 0; f < 36; ++f) EXPECT_EQ(label[crumbs + f], label[crumbs + f - f % 12]) << "of one crumb";

  // Taken together, in the same folder or anew, and each by itself again.
  ASSERT_EQ(run(command({"--components", "whole", "--tile-folder", "work"})).exit_code, 0);
  const auto together = take_labels();
  EXPECT_NE(together, by_part);
  ASSERT_EQ(run(command({"--components", "whole"})).exit_code, 0);
  EXPECT_EQ(take_labels(), together);
  expect_failure(3, "holds the work", command({"--tile-folder", "work", "--tile-step", "merge"}));
  ASSERT_EQ(run(command({"--tile-folder", "work"})).exit_code, 0);
  EXPECT_EQ(take_labels(), by_part);
}

TEST_F(Tiles_of_parts, HaveTheSurfacesOfEachPart) {
  ASSERT_EQ(run(command({"--engineering", "--report", "report.json", "--output", "%.ply"})).exit_code, 0);
  const Json report = Json::parse(content_of(path("report.json")));
  EXPECT_EQ(report["components"], 6);
  std::map<std::string, std::vector<double>> radii;
  std::size_t planes = 0;
  for (const Json& segment : report["segments"]) {
    const Json& surface = segment["surface"];
    if (surface["type"] == "sphere") radii["sphere"].push_back(surface["radius"].get<double>());
    planes += surface["type"] == "plane";
  }
  EXPECT_EQ(planes, 18U);  // of three cubes
  std::sort(radii["sphere"].begin(), radii["sphere"].end());
  ASSERT_EQ(radii["sphere"].size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(radii["sphere"][i], i < 2 ? 0.5 : 1, 0.01);
}

TEST_F(Tiles, GetTheSameLabelsByOneWorkerManyOrStepByStep) {
  ASSERT_EQ(run(command({"--workers", "1"})).exit_code, 0);
  const auto by_one = take_labels();
  ASSERT_EQ(run(command({"--workers", "4"})).exit_code, 0);
  EXPECT_EQ(take_labels(), by_one);
  for (const std::string step : step_names)
    for (std::size_t t = is_of_each_tile(step) ? 4 : 1; t-- > 0;) {  // the last tile first
      std::vector<std::string> more = {"--tile-folder", "work", "--tile-step", step};
      if (is_of_each_tile(step)) more.insert(more.end(), {"--tile", std::to_string(t)});
      const Result result = run(command(more));
      ASSERT_EQ(result.exit_code, 0) << step << result.errors;
    }
  EXPECT_EQ(take_labels(), by_one);
}

TEST_F(Tiles, GetTheSameLabelsWhenWorkersAndTheProgramAreKilled) {
  write_tiles(meshes::subdivided(meshes::two_spheres_with_neck(2.6, 0.35, 40)));
  ASSERT_EQ(run(command({})).exit_code, 0);
  const auto undisturbed = take_labels();

  using namespace std::chrono_literals;
  for (const int signal : {SIGKILL, SIGTERM}) {
    fs::remove_all(path("work"));
    const pid_t program = start(command({"--tile-folder", "work", "--workers", "2"}));
    std::this_thread::sleep_for(150ms);
    std::ifstream children("/proc/" + std::to_string(program) + "/task/" + std::to_string(program) + "/children");
    pid_t worker = 0;
    if (children >> worker) kill(worker, signal);
    const Result result = wait(program);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(take_labels(), undisturbed);
  }

  fs::remove_all(path("work"));
  for (const auto pause : {50ms, 150ms, 250ms}) {
    const pid_t killed = start(command({"--tile-folder", "work", "--workers", "2"}));
    std::this_thread::sleep_for(pause);
    kill(killed, SIGKILL);
    wait(killed);
  }
  ASSERT_EQ(run(command({"--tile-folder", "work"})).exit_code, 0);
  EXPECT_EQ(take_labels(), undisturbed);
}

TEST_F(Tiles, OfWhichOneCannotBeReadLeaveTheOthersTheirSegments) {
  write("tile_1.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
  const Result result = run(command({"--quiet", "--report", "report.json"}));
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_NE(result.errors.find("tile_1.off"), std::string::npos) << result.errors;
  EXPECT_FALSE(fs::exists(path("tile_1.seg")));
  for (const std::size_t t : {std::size_t(0), std::size_t(2), std::size_t(3)})
    EXPECT_EQ(labels("tile_" + std::to_string(t) + ".seg").size(), faces_[t]);
  EXPECT_EQ(Json::parse(content_of(path("report.json")))["failed"].size(), 1U);
  write("tile_1.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 0 1\n");
  const Result without_faces = run(command({"--quiet"}));
  EXPECT_EQ(without_faces.exit_code, 6);
  EXPECT_NE(without_faces.errors.find("tile_1.off: no face has three different corners"), std::string::npos);
  for (std::size_t t = 0; t < 4; ++t) write(name(t), "nothing");
  EXPECT_EQ(run(command({"--quiet"})).exit_code, 2);
}

TEST_F(Tiles, OfWhichOneCannotBeReadAreToldByTheStepThatReports) {
  write("tile_1.off", "nothing");
  ASSERT_EQ(run(command({"--quiet", "--tile-folder", "work"})).exit_code, 6);
  const Result result =
      run(command({"--quiet", "--tile-folder", "work", "--tile-step", "report", "--report", "report.json"}));
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_NE(result.errors.find("tile_1.off"), std::string::npos) << result.errors;
  EXPECT_EQ(Json::parse(content_of(path("report.json")))["tiles"], 4);
}

TEST_F(Tiles, OfWhichNoneCanBeReadFailStepByStepAsInOneCall) {
  for (std::size_t t = 0; t < 4; ++t) write(name(t), "nothing");
  const Result in_one_call = run(command({"--quiet"}));
  EXPECT_EQ(in_one_call.exit_code, 2);
  Result last;
  for (const std::string step : step_names)
    for (std::size_t t = 0; t < (is_of_each_tile(step) ? 4 : 1); ++t) {
      std::vector<std::string> more = {"--quiet", "--tile-folder", "work", "--tile-step", step};
      if (is_of_each_tile(step)) more.insert(more.end(), {"--tile", std::to_string(t)});
      last = run(command(more));
    }
  EXPECT_EQ(last.exit_code, 2);
  EXPECT_EQ(last.errors, in_one_call.errors);
}

TEST_F(Tiles, RefuseOutputsThatCannotBeWrittenBeforeTheWork) {
  expect_failure(5, "there is no such folder", command({"--tile-folder", "work", "--report", "none/report.json"}));
  expect_failure(5, "there is no such folder",
                 {name(0), name(1), "--tiled", "--tile-folder", "work", "--labels", "%/a.seg"});
  fs::create_directory(path("tile_2"));
  write("tile_2/mine", "");
  expect_failure(5, "the folder is not empty", command({"--tile-folder", "work", "--split", "%"}));
  EXPECT_FALSE(fs::exists(path("work/survey_0")));
}

TEST_F(Tiles, OtherNumbersOfSegmentsTakeTheLastStepsAlone) {
  ASSERT_EQ(run(command({"--tile-folder", "work", "--segments", "2"})).exit_code, 0);
  const auto shape_of = [&] { return fs::last_write_time(path("work/shape_0")); };
  const auto before = shape_of();
  const auto two = take_labels();
  ASSERT_EQ(run(command({"--tile-folder", "work", "--segments", "5", "--report", "report.json"})).exit_code, 0);
  EXPECT_EQ(shape_of(), before);
  EXPECT_EQ(Json::parse(content_of(path("report.json")))["segments"].size(), 5U);
  const auto five = take_labels();
  std::map<std::size_t, std::set<std::size_t>> coarser;  // levels are nested
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t f = 0; f < faces_[t]; ++f) coarser[five[t][f]].insert(two[t][f]);
  for (const auto& [segment, segments] : coarser) EXPECT_EQ(segments.size(), 1U);

  ASSERT_EQ(run(command({"--tile-folder", "work", "--segments", "30"})).exit_code, 0);  // with more seeds
  const auto many = take_labels();
  ASSERT_EQ(run(command({"--segments", "30"})).exit_code, 0);
  EXPECT_EQ(take_labels(), many);

  write(name(0), content_of(path(name(0))) + "# changed\n");
  fs::last_write_time(path(name(0)), fs::file_time_type::clock::now() + std::chrono::seconds(5));
  ASSERT_EQ(run(command({"--tile-folder", "work", "--segments", "2"})).exit_code, 0);
  EXPECT_NE(shape_of(), before);
  EXPECT_EQ(take_labels(), two);
}

TEST_F(Tiles, AreSegmentedAnewWhereOlderFilesTakeTheirPlaces) {
  ASSERT_EQ(run(command({"--tile-folder", "work"})).exit_code, 0);
  write_tiles(meshes::subdivided(meshes::two_spheres_with_neck(2.6, 0.35, 40)));
  for (std::size_t t = 0; t < 4; ++t)
    fs::last_write_time(path(name(t)), fs::file_time_type::clock::now() - std::chrono::hours(99));
  const Result step = run(command({"--tile-folder", "work", "--tile-step", "labels", "--tile", "1"}));
  EXPECT_EQ(step.exit_code, 2);
  EXPECT_NE(step.errors.find("tile_1.off: the file has changed"), std::string::npos) << step.errors;
  ASSERT_EQ(run(command({"--tile-folder", "work"})).exit_code, 0);
  EXPECT_EQ(labels("tile_1.seg").size(), faces_[1]);
}

TEST_F(Tiles, ThatChangeBetweenStepsAreRefusedHoweverOldTheyAre) {
  ASSERT_EQ(run(command({"--tile-folder", "work"})).exit_code, 0);
  meshes::Shape other = meshes::two_spheres_with_neck(2.6, 0.35, 40);
  for (std::size_t v = 0; v < other.points.size(); v += 2) other.points[v] *= 1.001;
  const std::size_t faces = faces_[1];
  write_tiles(other);
  ASSERT_EQ(faces_[1], faces);
  fs::last_write_time(path(name(1)), fs::file_time_type::clock::now() - std::chrono::hours(99));
  const std::vector<std::vector<std::string>> steps = {{"--tile-step", "labels"},
                                                       {"--tile-step", "labels", "--boundaries", "%.obj"},
                                                       {"--tile-step", "strips", "--refine"}};
  for (std::vector<std::string> step : steps) {
    step.insert(step.end(), {"--tile", "1", "--tile-folder", "work"});
    expect_failure(2, "tile_1.off: the file has changed", command(step));
  }
  ASSERT_EQ(run(command({"--tile-folder", "work"})).exit_code, 0);
  const auto again = take_labels();
  ASSERT_EQ(run(command({})).exit_code, 0);
  EXPECT_EQ(take_labels(), again);
}

TEST_F(Tiles, WithPolygonsRefuseSmoothBoundariesBeforeTheWork) {
  write(name(2), "OFF\n4 1 0\n9 0 0\n10 0 0\n10 1 0\n9 1 0\n4 0 1 2 3\n");
  constexpr const char* refusal = "tile_2.off: face 0 is no triangle";
  const auto in_folder = [](std::vector<std::string> more) {
    more.insert(more.end(), {"--tile-folder", "work"});
    return command(more);
  };
  const std::vector<std::vector<std::string>> all_options = {
      {"--refine"}, {"--smooth", "--boundaries", "%.obj"}, {"--refine", "--engineering"}};
  for (const std::vector<std::string>& options : all_options) {
    expect_failure(3, refusal, in_folder(options));
    EXPECT_FALSE(fs::exists(path("work")));
  }
  const std::vector<std::string> surfaces = {"--refine", "--engineering", "--tile-step"};
  for (std::size_t t = 0; t < 4; ++t)
    ASSERT_EQ(run(in_folder(surfaces + std::vector<std::string>{"survey", "--tile", std::to_string(t)})).exit_code, 0);
  expect_failure(3, refusal, in_folder(surfaces + std::vector<std::string>{"plan"}));

  fs::remove_all(path("work"));
  EXPECT_EQ(run(in_folder({})).exit_code, 0);
  const auto labels = take_labels();
  expect_failure(3, refusal, in_folder({"--refine"}));
  EXPECT_EQ(run(in_folder({"--boundaries", "%.obj"})).exit_code, 0);
  EXPECT_EQ(run(in_folder({})).exit_code, 0);
  EXPECT_EQ(take_labels(), labels);
}

TEST_F(Tiles, LeaveNothingOfCallsThatAreWrong) {
  write("seeds.txt", "0,0,0=zero\n");
  write("list.txt", "# none\n");
  const auto elsewhere = [](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"none/0.off", "none/1.off", "--tiled", "--labels", "%.seg"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const std::vector<std::vector<std::string>> wrong_calls = {elsewhere({}),
                                                             elsewhere({"--tile-step", "survey", "--tile", "0"}),
                                                             elsewhere({"--tile-step", "plan"}),
                                                             command({"--tile-step", "shape", "--tile", "1"}),
                                                             command({"--tolerance", "0.5"}),
                                                             command({"--tolerance", "0.5", "--engineering"}),
                                                             {"--list", "list.txt", "--tiled", "--labels", "%.seg"},
                                                             command({"--constraints", "none/%.walls"}),
                                                             command({"--report", "none/report.json"}),
                                                             command({"--split", "none/%"}),
                                                             command({"--report", "work/survey_0"}),
                                                             command({"--seeds-file", "none"}),
                                                             command({"--seeds-file", "seeds.txt"}),
                                                             command({"--seed", "3=1"}),
                                                             command({"--tile-step", "sing"}),
                                                             command({"--tile-step", "survey"}),
                                                             command({"--tile-step", "survey", "--tile", "4"}),
                                                             command({"--tile-step", "plan", "--tile", "0"})};
  for (std::vector<std::string> call : wrong_calls) {
    call.insert(call.end(), {"--tile-folder", "work"});
    const Result result = run(call);
    EXPECT_NE(result.exit_code, 0) << testing::PrintToString(call);
    EXPECT_NE(result.errors, "") << testing::PrintToString(call);
    EXPECT_FALSE(fs::exists(path("work"))) << testing::PrintToString(call);
    fs::remove_all(path("work"));
    fs::create_directory(path("work"));
    EXPECT_NE(run(call).exit_code, 0) << testing::PrintToString(call);
    EXPECT_TRUE(fs::is_empty(path("work"))) << testing::PrintToString(call);  // it was there before
    fs::remove_all(path("work"));
  }
}

TEST_F(Tiles, ThatAreOutOfReachForATimeKeepTheWorkOnThem) {
  ASSERT_EQ(run(command({"--tile-folder", "work"})).exit_code, 0);
  const auto before = fs::last_write_time(path("work/shape_0"));
  const auto labels = take_labels();
  for (std::size_t t = 0; t < 4; ++t) fs::rename(path(name(t)), path(name(t) + ".away"));
  constexpr const char* refusal = "tile_0.off: no such file, nor any of the other tiles";
  expect_failure(2, refusal, command({"--tile-folder", "work"}));
  expect_failure(2, refusal, command({"--tile-folder", "work", "--tile-step", "survey", "--tile", "0"}));
  for (std::size_t t = 0; t < 4; ++t) fs::rename(path(name(t) + ".away"), path(name(t)));
  ASSERT_EQ(run(command({"--tile-folder", "work"})).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(path("work/shape_0")), before);
  EXPECT_EQ(take_labels(), labels);
}

TEST_F(Tiles, ThatCouldNotBeReadAreReadAgain) {
  const std::string content = content_of(path(name(1)));
  write(name(1), "nothing");
  const auto time = fs::file_time_type::clock::now() - std::chrono::hours(99);
  ASSERT_EQ(run(command({"--quiet", "--tile-folder", "work"})).exit_code, 6);
  write(name(1), content);
  fs::last_write_time(path(name(1)), time);
  EXPECT_EQ(run(command({"--quiet", "--tile-folder", "work"})).exit_code, 0);
  EXPECT_EQ(labels("tile_1.seg").size(), faces_[1]);
}

TEST_F(Tiles, HaveTheirPartsWrittenAgainInTheSameFolders) {
  const auto parts_of = [&](std::size_t tile) {
    std::set<std::string> parts;
    for (const auto& entry : fs::directory_iterator(path("parts_tile_" + std::to_string(tile))))
      parts.insert(entry.path().filename().string());
    return parts;
  };
  const std::vector<std::string> split = {"--split", "parts_%", "--segments"};
  const auto with = [&](const char* segments, const char* folder) {
    std::vector<std::string> more = split;
    more.insert(more.end(), {segments, "--tile-folder", folder});
    return command(more);
  };
  ASSERT_EQ(run(with("5", "work")).exit_code, 0);
  write("parts_tile_0/segment_7.ply.part123", "of a worker that was killed");
  fs::remove(path("work/labels_0"));
  const Result result = run(with("2", "work"));
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  const auto all = take_labels();
  for (std::size_t t = 0; t < 4; ++t) {
    std::set<std::string> parts;
    for (const std::size_t label : all[t]) parts.insert("segment_" + std::to_string(label) + ".ply");
    EXPECT_EQ(parts_of(t), parts);
  }

  // What is not of this work stays.
  expect_failure(5, "the folder is not empty", with("2", "other_work"));
  write("parts_tile_1/segment_mine.ply", "");
  expect_failure(5, "parts_tile_1: the folder is not empty", with("2", "work"));
}

TEST_F(Tiles, RefuseLaterStepsWithOtherSegmentsThanTheMergedOnes) {
  ASSERT_EQ(run(command({"--tile-folder", "work", "--segments", "2"})).exit_code, 0);
  take_labels();
  const std::vector<std::string> labels = {"--tile-folder", "work", "--tile-step", "labels", "--tile", "0"};
  const auto with = [](std::vector<std::string> options, const std::vector<std::string>& more) {
    options.insert(options.end(), more.begin(), more.end());
    return options;
  };
  expect_failure(3, "another --segments", command(labels));
  expect_failure(3, "another --segments", command(with(labels, {"--segments", "3"})));
  expect_failure(3, "another --segments",
                 command({"--tile-folder", "work", "--tile-step", "report", "--segments", "3"}));
  EXPECT_EQ(run(command(with(labels, {"--segments", "2"}))).exit_code, 0);

  // Other segments take the steps after them.
  ASSERT_EQ(run(command({"--tile-folder", "work", "--tile-step", "merge", "--segments", "3"})).exit_code, 0);
  expect_failure(2, "tile_0.off: work/labels_0",
                 command({"--tile-folder", "work", "--tile-step", "report", "--segments", "3"}));
  EXPECT_EQ(run(command(with(labels, {"--segments", "3"}))).exit_code, 0);
}

TEST_F(Tiles, AreNamedWhereTheWorkOnThemFails) {
  ASSERT_EQ(run(command({"--tile-folder", "work"})).exit_code, 0);
  for (const char* file : {"shape_1", "outline_2", "network_3", "fragments_0"})
    write(std::string("work/") + file, "nothing");
  expect_failure(2, "tile_1.off: work/shape_1: the file ends too early",
                 command({"--tile-folder", "work", "--tile-step", "clusters", "--tile", "1"}));
  expect_failure(2, "tile_2.off: work/outline_2", command({"--tile-folder", "work", "--tile-step", "seeds"}));
  expect_failure(2, "tile_3.off: work/network_3", command({"--tile-folder", "work", "--tile-step", "walk"}));
  expect_failure(2, "tile_0.off: work/fragments_0",
                 command({"--tile-folder", "work", "--tile-step", "labels", "--tile", "0"}));
  fs::remove(path("work/plan"));
  fs::remove(path("work/parts"));
  expect_failure(2, "tile_2.off: work/parts",
                 command({"--tile-folder", "work", "--tile-step", "border", "--tile", "2"}));
  write("0.walls", "0 1\n");
  fs::rename(path(name(0)), path("0.off"));
  fs::rename(path(name(1)), path("1.off"));
  const Result without_walls = run({"0.off", "1.off", "--tiled", "--constraints", "%.walls", "--labels", "%.seg"});
  EXPECT_EQ(without_walls.exit_code, 6);
  EXPECT_NE(without_walls.errors.find("1.off: 1.walls: "), std::string::npos) << without_walls.errors;
}

TEST_F(Tiles, RefuseATolerancePastTheEdgesOfABorder) {
  for (const std::vector<std::string>& method : {std::vector<std::string>{}, {"--engineering"}}) {
    std::vector<std::string> more = {"--tolerance", "0.5"};
    more.insert(more.end(), method.begin(), method.end());
    const Result result = run(command(more));
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_EQ(result.errors.find("segment_mesh: tile_"), 0U) << result.errors;
    EXPECT_NE(result.errors.find(".off: --tolerance 0.5 makes one vertex of"), std::string::npos) << result.errors;
    for (std::size_t t = 0; t < 4; ++t) EXPECT_FALSE(fs::exists(path("tile_" + std::to_string(t) + ".seg")));
  }
  EXPECT_EQ(run(command({"--tolerance", "0.01"})).exit_code, 0);
}

TEST_F(Tiles, ThatOverlapAreNamed) {
  const meshes::Shape ball = meshes::sphere(3);
  const auto write_part = [&](const std::string& name, const auto& is_in_it) {
    meshes::Shape part = ball;
    part.faces.clear();
    for (std::size_t f = 0; f < ball.faces.size(); ++f)
      if (is_in_it(middle_of(ball, f).z())) part.faces.push_back(ball.faces[f]);
    write(name, off_of(part));
  };
  write_part("low.off", [](double z) { return z < 0.1; });
  write_part("high.off", [](double z) { return z > -0.1; });
  write_part("cap.off", [](double z) { return z > 0.1; });
  const Result result = run({"low.off", "high.off", "--tiled", "--labels", "%.seg", "--report", "report.json"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.errors.find("low.off and high.off have faces in common"), std::string::npos) << result.errors;
  EXPECT_EQ(Json::parse(content_of(path("report.json")))["overlaps"],
            Json::array({Json::array({"low.off", "high.off"})}));
  EXPECT_EQ(run({"low.off", "cap.off", "--tiled", "--labels", "%.seg"}).errors, "");

  // Solids whose sides touch have no faces in common.
  write("left.off", off_of(meshes::cube(2)));
  write("right.off", off_of(meshes::moved(meshes::cube(2), {1, 0, 0})));
  EXPECT_EQ(run({"left.off", "right.off", "--tiled", "--labels", "%.seg"}).errors, "");
}

TEST_F(Tiles, ThatNowhereMeetAreTold) {
  constexpr const char* remark = "no tile meets another one";
  EXPECT_EQ(run(command({"--segments", "2"})).errors, "");
  for (std::size_t t = 0; t < 4; ++t) {
    std::istringstream off(content_of(path(name(t))));
    std::ostringstream moved;  // by some millionths, as coordinates are that were written in other precisions
    moved.precision(17);
    std::string line;
    for (std::size_t number = 0; std::getline(off, line); ++number) {
      double x = 0, y = 0, z = 0;
      std::istringstream numbers(line);
      if (number >= 2 && number < 2 + vertex_number_[t].size() && numbers >> x >> y >> z)
        moved << x + 1e-6 * static_cast<double>(t) << ' ' << y << ' ' << z << '\n';
      else
        moved << line << '\n';
    }
    write(name(t), moved.str());
  }
  const Result result = run(command({"--segments", "4"}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.errors.find(remark), std::string::npos) << result.errors;
  EXPECT_EQ(run(command({"--segments", "2", "--tolerance", "1e-5"})).errors, "");
}

TEST_F(Tiles, TellWhatIsOddAboutTheirFiles) {
  write("cut_off.stl",
        "solid\nfacet normal 0 0 1\nouter loop\nvertex 9 0 0\nvertex 9 1 0\nvertex 9 0 1\nendloop\nendfacet\n");
  const Result result = run({"cut_off.stl", name(0), "--tiled", "--labels", "%.seg"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.errors.find("cut_off.stl: the file ends without"), std::string::npos) << result.errors;
}

TEST_F(Tiles, FromSeedsHaveTheirLabels) {
  const std::vector<std::string> seeds = {"--seed", "0,0,-2.5=9", "--seed", "0,0.4,0=4", "--seed", "0.5,0,2=70"};
  std::vector<std::string> arguments = command({"--report", "report.json", "--tile-folder", "work"});
  arguments.insert(arguments.end(), seeds.begin(), seeds.end());
  const Result result = run(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  const auto all = take_labels();
  std::map<std::size_t, std::size_t> faces;
  for (const auto& of_tile : all)
    for (const std::size_t label : of_tile) ++faces[label];
  const Json report = Json::parse(content_of(path("report.json")));
  ASSERT_EQ(report["segments"].size(), 3U);
  EXPECT_EQ(report["unseeded_components"], 0);
  for (const Json& segment : report["segments"])
    EXPECT_EQ(segment["faces"], faces[segment["label"].get<std::size_t>()]);
  EXPECT_EQ(faces.size(), 3U);
  // The upper ball lies in tiles 2 and 3.
  for (const std::size_t t : {2U, 3U}) EXPECT_EQ(std::set<std::size_t>(all[t].begin(), all[t].end()).size(), 1U);
  EXPECT_EQ(all[2].front(), 70U);

  // Other seeds take the steps from them on alone, step by step as well.
  const auto shape_of = [&] { return fs::last_write_time(path("work/shape_0")); };
  const auto before = shape_of();
  write("seeds.txt", "0 0 -2.5 = 9  # below\n0.5 0 2 = 70\n");
  ASSERT_EQ(run(command({"--seeds-file", "seeds.txt", "--tile-folder", "work"})).exit_code, 0);
  EXPECT_EQ(shape_of(), before);
  std::set<std::size_t> two;
  const auto of_two_seeds = take_labels();
  for (const auto& of_tile : of_two_seeds) two.insert(of_tile.begin(), of_tile.end());
  EXPECT_EQ(two, (std::set<std::size_t>{9, 70}));
  expect_failure(3, "holds the work from other seeds", command({"--tile-folder", "work", "--tile-step", "plan"}));
  for (const std::string step : step_names)
    for (std::size_t t = 0; t < (is_of_each_tile(step) ? 4 : 1); ++t) {
      std::vector<std::string> more = {"--seeds-file", "seeds.txt", "--tile-folder", "steps", "--tile-step", step};
      if (is_of_each_tile(step)) more.insert(more.end(), {"--tile", std::to_string(t)});
      ASSERT_EQ(run(command(more)).exit_code, 0) << step;
    }
  EXPECT_EQ(take_labels(), of_two_seeds);

  // Without seeds they place themselves again.
  ASSERT_EQ(run(command({"--tile-folder", "work", "--segments", "2"})).exit_code, 0);
  const auto automatic = take_labels();
  ASSERT_EQ(run(command({"--segments", "2"})).exit_code, 0);
  EXPECT_EQ(take_labels(), automatic);
}

TEST_F(Tiles, TellOfPartsThatNoSeedCanReach) {
  write_tiles(meshes::together(meshes::sphere(3), meshes::moved(meshes::sphere(3), {3, 0, 0})));
  const Result result = run(command({"--seed", "-1,0,0=5", "--report", "report.json"}));
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.errors.find("1 component without a seed, each a segment of its own"), std::string::npos);
  const Json report = Json::parse(content_of(path("report.json")));
  EXPECT_EQ(report["unseeded_components"], 1);
  EXPECT_EQ(report["segments"][0]["label"], 5);
  EXPECT_EQ(report["segments"][1]["label"], 6);
}

TEST_F(Tiles, GiveFacesThatAreLeftOutTheLabelsOfTheClosestOnes) {
  const std::string off = content_of(path(name(0)));
  const std::size_t counts = off.find('\n') + 1, rest = off.find('\n', counts);
  std::istringstream line(off.substr(counts, rest - counts));
  std::size_t points = 0, faces = 0;
  line >> points >> faces;
  ASSERT_EQ(run(command({"--segments", "2"})).exit_code, 0);
  const auto before = take_labels();
  write(name(0),
        "OFF\n" + std::to_string(points) + ' ' + std::to_string(faces + 1) + " 0" + off.substr(rest) + "3 0 0 1\n");
  const Result result = run(command({"--segments", "2", "--left-out", "%.txt"}));
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  auto after = take_labels();
  ASSERT_EQ(after[0].size(), faces + 1);
  EXPECT_EQ(after[0].back(), after[0].front());  // the first face has the point 0
  after[0].pop_back();
  EXPECT_EQ(after, before);
  EXPECT_EQ(content_of(path("tile_0.txt")), std::to_string(faces) + '\n');
}

// ---- Walls ----

/// Four tiles of a dumbbell with walls round a piece of one of its balls, across a border between tiles.
class Walled_tiles : public Tiles {
 protected:
  using Edge = std::array<std::size_t, 2>;

  void SetUp() override {
    Tiles::SetUp();
    std::map<Edge, std::vector<std::size_t>> faces;
    for (std::size_t f = 0; f < shape_.faces.size(); ++f) {
      std::size_t from = shape_.faces[f].back();
      for (const std::size_t to : shape_.faces[f]) {
        faces[{std::min(from, to), std::max(from, to)}].push_back(f);
        from = to;
      }
    }
    for (const auto& [edge, beside] : faces)
      if (is_on_cap(beside[0]) != is_on_cap(beside[1])) walls_.push_back(edge);
    write_walls();
  }

  bool is_on_cap(std::size_t face) const {
    return (middle_of(shape_, face) - Eigen::Vector3d(0.3, 0.3, 2.1)).norm() < 0.6;
  }

  bool has(std::size_t tile, const Edge& edge) const {
    return vertex_number_[tile].count(edge[0]) > 0 && vertex_number_[tile].count(edge[1]) > 0;
  }

  /// Each wall in the file of one tile.
  void write_walls() const {
    for (std::size_t t = 0; t < 4; ++t) {
      std::ostringstream lines;
      for (const Edge& edge : walls_)
        if (has(t, edge) && (t == 0 || !has(t - 1, edge)))
          lines << vertex_number_[t].at(edge[0]) << ' ' << vertex_number_[t].at(edge[1]) << '\n';
      write("tile_" + std::to_string(t) + ".walls", lines.str());
    }
  }

  /// The labels that there are on both sides of the walls.
  std::set<std::size_t> on_both_sides(const std::vector<std::vector<std::size_t>>& labels) const {
    std::set<std::size_t> inside, outside, both;
    for (std::size_t t = 0; t < 4; ++t)
      for (std::size_t f = 0; f < faces_[t]; ++f)
        (is_on_cap(faces_of_tile_[t][f]) ? inside : outside).insert(labels[t][f]);
    for (const std::size_t label : inside)
      if (outside.count(label) > 0) both.insert(label);
    return both;
  }

  const meshes::Shape shape_ = meshes::two_spheres_with_neck(2.6, 0.35, 40);
  std::vector<Edge> walls_;
};

TEST_F(Walled_tiles, HaveNoSegmentOnBothSides) {
  ASSERT_EQ(run(command({"--segments", "2"})).exit_code, 0);
  EXPECT_NE(on_both_sides(take_labels()), std::set<std::size_t>());
  const Result result = run(command({"--segments", "2", "--constraints", "%.walls", "--report", "report.json"}));
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(on_both_sides(take_labels()), std::set<std::size_t>());
  const Json report = Json::parse(content_of(path("report.json")));
  EXPECT_EQ(report["components"], 2);
  EXPECT_EQ(report["walls"], walls_.size());
  ASSERT_EQ(run(command({"--seed", "0.3,0.3,2.3=4", "--seed", "0,0,-2.3=0", "--constraints", "%.walls"})).exit_code, 0);
  const auto from_seeds = take_labels();
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t f = 0; f < faces_[t]; ++f) EXPECT_EQ(from_seeds[t][f] == 4, is_on_cap(faces_of_tile_[t][f]));
}

TEST_F(Walled_tiles, AreSegmentedAnewWhereWallsHaveChanged) {
  const std::vector<std::string> walled = {"--segments", "2", "--constraints", "%.walls", "--tile-folder", "work"};
  ASSERT_EQ(run(command(walled)).exit_code, 0);
  const auto first = take_labels();
  for (std::size_t t = 0; t < 4; ++t) {
    const std::string file = "tile_" + std::to_string(t) + ".walls";
    write(file, "# none\n");
    fs::last_write_time(path(file), fs::file_time_type::clock::now() + std::chrono::seconds(5));
  }
  ASSERT_EQ(run(command(walled)).exit_code, 0);
  EXPECT_NE(take_labels(), first);
  constexpr const char* other = "holds the work on other tiles or with other options";
  expect_failure(3, other, command({"--segments", "2", "--tile-folder", "work"}));
  expect_failure(3, other, command({"--constraints", "%.walls", "--constraints-angle", "40", "--tile-folder", "work"}));
}

TEST_F(Walled_tiles, RefuseWallsThatAreNone) {
  expect_failure(1, "give a file for each", command({"--constraints", "tile_0.walls"}));
  write("tile_2.walls", "0 1\n\n5 100000\n");
  expect_failure(3, "tile_2.walls:3: the file has", command({"--constraints", "%.walls"}));
  write("tile_2.walls", "0 zero\n");
  const Result result = run(command({"--constraints", "%.walls"}));
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_NE(result.errors.find("tile_2.walls:1"), std::string::npos) << result.errors;
  EXPECT_FALSE(fs::exists(path("tile_2.seg")));
}

TEST_F(Tiles, WithSharpEdgesAsWallsHaveTheSidesOfAPolyhedron) {
  const meshes::Shape polyhedron = meshes::sphere(2);  // over whose edges normals turn by more than 5 degrees
  const std::size_t sides = polyhedron.faces.size();
  constexpr std::size_t faces_of_side = 4;
  write_tiles(meshes::subdivided(polyhedron));
  const Result result = run(command({"--constraints-angle", "5", "--report", "report.json"}));
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  const auto all = take_labels();
  std::vector<std::set<std::size_t>> labels(sides);
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t f = 0; f < faces_[t]; ++f) labels[faces_of_tile_[t][f] / faces_of_side].insert(all[t][f]);
  std::set<std::size_t> different;
  for (const auto& of_side : labels) {
    ASSERT_EQ(of_side.size(), 1U);
    different.insert(*of_side.begin());
  }
  EXPECT_EQ(different.size(), sides);

  // There are fewer colours than sides, but those of neighbours differ.
  const Json segments = Json::parse(content_of(path("report.json")))["segments"];
  ASSERT_EQ(segments.size(), sides);
  std::map<std::array<std::size_t, 2>, std::size_t> side_at;  // by edge
  for (std::size_t side = 0; side < sides; ++side) {
    std::size_t from = polyhedron.faces[side].back();
    for (const std::size_t to : polyhedron.faces[side]) {
      const auto [place, is_first] = side_at.emplace(std::array{std::min(from, to), std::max(from, to)}, side);
      from = to;
      if (is_first) continue;
      EXPECT_NE(segments[*labels[side].begin()]["color"], segments[*labels[place->second].begin()]["color"]);
    }
  }
}

// ---- Boundaries ----

using Place = std::array<double, 3>;

double distance(const Place& p, const Place& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

/// The triangles of an OFF file.
std::vector<std::array<Place, 3>> triangles_in(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::size_t points = 0, faces = 0;
  file >> line >> points >> faces;
  std::getline(file, line);
  std::vector<Place> place(points);
  for (Place& p : place) file >> p[0] >> p[1] >> p[2];
  std::vector<std::array<Place, 3>> triangles(faces);
  for (auto& triangle : triangles) {
    std::size_t corner = 0;
    file >> corner;
    for (Place& p : triangle) {
      file >> corner;
      p = place.at(corner);
    }
    std::getline(file, line);  // the colour
  }
  return triangles;
}

/// The sides that no other triangle has.
std::set<std::array<Place, 2>> border_of(const std::vector<std::array<Place, 3>>& triangles) {
  std::set<std::array<Place, 2>> border;
  for (const auto& triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      std::array side = {triangle[k], triangle[(k + 1) % 3]};
      std::sort(side.begin(), side.end());
      if (!border.insert(side).second) border.erase(side);
    }
  return border;
}

double area_of(const std::vector<std::array<Place, 3>>& triangles) {
  double area = 0;
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3d u(b[0] - a[0], b[1] - a[1], b[2] - a[2]), v(c[0] - a[0], c[1] - a[1], c[2] - a[2]);
    area += u.cross(v).norm() / 2;
  }
  return area;
}

/// The polylines of an OBJ file; closed ones end where they begin.
std::vector<std::vector<Place>> lines_in(const std::string& path) {
  std::vector<std::vector<Place>> lines;
  std::vector<Place> points;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Place& p = points.emplace_back();
      words >> p[0] >> p[1] >> p[2];
    } else if (kind == "l") {
      lines.emplace_back();
      for (std::size_t number = 0; words >> number;) lines.back().push_back(points.at(number - 1));
    }
  }
  return lines;
}

double length_of(const std::vector<std::vector<Place>>& lines) {
  double length = 0;
  for (const auto& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i) length += distance(line[i - 1], line[i]);
  return length;
}

/// Four tiles of a ball with segments of seeds, whose boundaries cross the borders between tiles and are jagged: no crease
/// tells where they belong.
class Tiles_of_ball : public Tiles {
 protected:
  void SetUp() override {
    Tiles::SetUp();
    write_tiles(meshes::sphere(4));
  }

  void segment(std::vector<std::string> options) const {
    for (const char* seed : {"1,0,0", "-1,0.2,0", "0,1,0.2", "0,-1,0", "0,0,-1", "0.4,0.1,0.9", "-0.3,-0.1,0.9"})
      options.insert(options.end(), {"--seed", seed});
    const Result result = run(command(options));
    EXPECT_EQ(result.exit_code, 0) << result.errors;
  }

  std::vector<std::array<Place, 3>> triangles_of(std::size_t tile) const { return triangles_in(path(name(tile))); }
};

TEST_F(Tiles_of_ball, StillMeetVertexByVertexWhenRefined) {
  segment({"--refine", "--output", "%_refined.off"});
  std::size_t added = 0, sides = 0, refined_sides = 0;
  std::map<std::array<Place, 2>, std::size_t> tiles;  // by side at their borders
  for (std::size_t t = 0; t < 4; ++t) {
    const auto whole = triangles_of(t), refined = triangles_in(path("tile_" + std::to_string(t) + "_refined.off"));
    added += refined.size() - whole.size();
    sides += border_of(whole).size();
    refined_sides += border_of(refined).size();
    for (const auto& side : border_of(refined)) ++tiles[side];
    EXPECT_NEAR(area_of(refined), area_of(whole), 1e-9);
  }
  for (const auto& [side, count] : tiles) EXPECT_EQ(count, 2U);
  EXPECT_GT(added, 100U);
  EXPECT_GT(refined_sides, sides);  // where boundaries cross them
}

TEST_F(Tiles_of_ball, AreRefinedInTheSameWayByOneWorkerManyOrStepByStep) {
  const std::vector<std::string> refine = {"--refine", "--output", "%_refined.off"};
  const auto take_files = [&] {
    std::vector<std::string> contents;
    for (std::size_t t = 0; t < 4; ++t) {
      const std::string file = path("tile_" + std::to_string(t) + "_refined.off");
      contents.push_back(content_of(file));
      fs::remove(file);
    }
    return contents;
  };
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), refine.begin(), refine.end());
    return more;
  };
  segment(with({"--workers", "1"}));
  const auto by_one = take_files();
  segment(with({"--workers", "4"}));
  EXPECT_EQ(take_files(), by_one);
  for (const char* name : {"survey", "plan", "border", "noise", "shape", "places", "seeds", "clusters", "walk",
                           "fragments", "merge", "strips", "crossings", "labels", "report"}) {
    const std::string step = name;
    const bool is_one_of_each = is_of_each_tile(step) || step == "strips" || step == "crossings";
    for (std::size_t t = is_one_of_each ? 4 : 1; t-- > 0;) {  // the last tile first
      std::vector<std::string> more = {"--tile-folder", "work", "--tile-step", step};
      if (is_one_of_each) more.insert(more.end(), {"--tile", std::to_string(t)});
      segment(with(more));
    }
  }
  EXPECT_EQ(take_files(), by_one);
  fs::remove(path("work/crossings_1"));
  fs::remove(path("work/labels_2"));
  segment(with({"--tile-folder", "work"}));
  EXPECT_EQ(take_files(), by_one);
}

TEST_F(Tiles_of_ball, HaveTheLabelsOfFacesAroundWhenRefined) {
  segment({});
  const auto before = take_labels();
  segment({"--refine", "--output", "%_refined.off", "--report", "report.json"});
  const auto after = take_labels();
  std::map<std::size_t, std::size_t> faces;
  std::size_t cut = 0;
  for (std::size_t t = 0; t < 4; ++t) {
    const auto whole = triangles_of(t), refined = triangles_in(path("tile_" + std::to_string(t) + "_refined.off"));
    ASSERT_EQ(after[t].size(), refined.size());
    for (const std::size_t label : after[t]) ++faces[label];
    std::map<Place, std::set<std::size_t>> around;  // a smooth boundary stays within an edge's length of the jagged one
    for (std::size_t f = 0; f < whole.size(); ++f)
      for (const Place& corner : whole[f]) around[corner].insert(before[t][f]);
    for (std::size_t f = 0; f < whole.size(); ++f) {
      cut += refined[f] != whole[f];
      if (refined[f] != whole[f]) continue;
      std::set<std::size_t> labels;
      for (const Place& corner : whole[f]) labels.insert(around[corner].begin(), around[corner].end());
      EXPECT_EQ(labels.count(after[t][f]), 1U);
    }
  }
  EXPECT_GT(cut, 100U);
  const Json report = Json::parse(content_of(path("report.json")));
  for (const Json& segment : report["segments"])
    EXPECT_EQ(segment["faces"], faces[segment["label"].get<std::size_t>()]);
}

TEST_F(Tiles_of_ball, HaveBoundariesThatEndAtBordersWhereTheyGoOnOrWhereSegmentsMeet) {
  segment({"--boundaries", "%_jagged.obj"});
  const auto labels = take_labels();
  segment({"--smooth", "--boundaries", "%_smooth.obj"});
  EXPECT_EQ(take_labels(), labels);
  double jagged_length = 0, smooth_length = 0;
  std::map<Place, std::size_t> tiles_with_end;  // within a side of the border
  for (std::size_t t = 0; t < 4; ++t) {
    const std::string tile = path("tile_" + std::to_string(t));
    const auto jagged = lines_in(tile + "_jagged.obj"), smooth = lines_in(tile + "_smooth.obj");
    jagged_length += length_of(jagged);
    smooth_length += length_of(smooth);
    std::set<Place> on_border;
    for (const auto& side : border_of(triangles_of(t))) on_border.insert(side.begin(), side.end());
    for (const bool is_smooth : {false, true}) {
      std::map<Place, std::size_t> ends;
      for (const auto& line : is_smooth ? smooth : jagged)
        if (line.front() != line.back())
          for (const Place& end : {line.front(), line.back()}) ++ends[end];
      for (const auto& [end, count] : ends) {
        const bool is_at_vertex = count > 2 || on_border.count(end) > 0;
        EXPECT_TRUE(is_at_vertex || is_smooth) << t;
        if (!is_at_vertex) ++tiles_with_end[end];
      }
    }
  }
  EXPECT_GT(tiles_with_end.size(), 2U);
  for (const auto& [end, count] : tiles_with_end) EXPECT_EQ(count, 2U);
  EXPECT_GT(smooth_length, 0.5 * jagged_length);
  EXPECT_LT(smooth_length, 0.95 * jagged_length);
}

TEST_F(Walled_tiles, HaveSmoothBoundariesThatKeepToTheWalls) {
  ASSERT_EQ(
      run(command({"--segments", "4", "--constraints", "%.walls", "--smooth", "--boundaries", "%.obj"})).exit_code, 0);
  std::size_t within_tiles = 0;
  for (std::size_t t = 0; t < 4; ++t) {
    std::set<Place> points;
    for (const auto& line : lines_in(path("tile_" + std::to_string(t) + ".obj")))
      points.insert(line.begin(), line.end());
    for (const Edge& edge : walls_) {
      bool is_at_border = false;
      for (std::size_t other = 0; other < 4; ++other) is_at_border |= other != t && has(other, edge);
      if (is_at_border || !has(t, edge)) continue;
      ++within_tiles;
      for (const std::size_t v : edge) {
        const Eigen::Vector3d& p = shape_.points[v];
        EXPECT_EQ(points.count({p[0], p[1], p[2]}), 1U);
      }
    }
  }
  EXPECT_GT(within_tiles, 10U);
}

TEST_F(Tiles, RefuseTheWorkOfOthers) {
  ASSERT_EQ(run(command({"--tile-folder", "work"})).exit_code, 0);
  expect_failure(3, "holds the work on other tiles or with other options",
                 command({"--tile-folder", "work", "--smoothing", "0.02"}));
  for (const char* file : {"walk", "parts", "segments"}) {
    const std::string content = content_of(path(std::string("work/") + file));
    for (const std::string& broken : {content.substr(0, content.size() / 2), content + "x", std::string(), [&] {
                                        std::string changed = content;
                                        changed[changed.size() - 3] ^= 1;
                                        return changed;
                                      }()}) {
      write(std::string("work/") + file, broken);
      expect_failure(
          2, file,
          command({"--tile-folder", "work", "--tile-step", file == std::string("parts") ? "seeds" : "report"}));
    }
    write(std::string("work/") + file, content);
  }
}

TEST_F(Tiles, LeaveFilesOfOthersAlone) {
  fs::create_directory(path("work"));
  write("work/plan", "mine");
  expect_failure(3, "which no step has left there", command({"--tile-folder", "work"}));
  EXPECT_EQ(content_of(path("work/plan")), "mine");
  fs::remove(path("work/plan"));
  expect_failure(1, "is what a step leaves", command({"--tile-folder", "work", "--report", "work/report"}));
  fs::rename(path(name(0)), path("0.off"));
  fs::rename(path(name(1)), path("1.off"));
  expect_failure(1, "is what a step leaves",
                 {"0.off", "1.off", "--tiled", "--tile-folder", ".", "--labels", "labels_%"});
}

TEST_F(Tiles, MayHaveOutputsInFoldersWithPercentSigns) {
  fs::create_directory(path("5%"));
  ASSERT_EQ(run({name(0), name(1), "--tiled", "--labels", "5%%/%.seg", "--report", "5%%/report.json"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(path("5%/report.json")));
  EXPECT_EQ(labels("5%/tile_1.seg").size(), faces_[1]);
}

TEST_F(Tiles, MayHaveNamesThatAreNotUtf8) {
  const std::string latin = "caf\xe9.off";
  fs::rename(path(name(1)), path(latin));
  ASSERT_EQ(run({name(0), latin, "--tiled", "--labels", "%.seg", "--report", "report.json"}).exit_code, 0);
  EXPECT_EQ(labels("caf\xe9.seg").size(), faces_[1]);
}

TEST_F(Tiles, RefuseWhatTheyCannotHave) {
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--coarse"},
                                                  {"--seed", "3"},
                                                  {"--seed", "1,2,3", "--segments", "2"},
                                                  {"--seed", "1,2,3", "--probabilities", "%.txt"},
                                                  {"--seeds-file", "%.txt"},
                                                  {"--html", "a.html"},
                                                  {"--paper"},
                                                  {"--resume"},
                                                  {"--report", "%.json"},
                                                  {"--tile-step", "survey"},
                                                  {"--tile-step", "sing", "--tile-folder", "w"},
                                                  {"--tile-step", "plan", "--tile", "0", "--tile-folder", "w"},
                                                  {"--tile-step", "shape", "--tile-folder", "w"},
                                                  {"--workers", "none"},
                                                  {"--smooth"},
                                                  {"--time-limit", "3"}}) {
    const Result result = run(command(options));
    EXPECT_EQ(result.exit_code, 1) << testing::PrintToString(options) << result.errors;
    EXPECT_EQ(number_of_lines(result.errors), 1U);
  }
  EXPECT_EQ(run(command({"--tile-step", "shape", "--tile", "4", "--tile-folder", "w"})).exit_code, 3);
  EXPECT_EQ(run(command({"--tolerance", "-1"})).exit_code, 3);
  EXPECT_EQ(run(command({"--segments", "1000000"})).exit_code, 3);
  expect_failure(3, "seeds 0 and 1, counted from 0, have different labels and the same closest face",
                 command({"--seed", "0,0,2=1", "--seed", "0,0,2=2"}));
  EXPECT_EQ(run({name(0), name(1), "--labels", "%.seg", "--workers", "2"}).exit_code, 1);
  expect_failure(5, "TMPDIR", command({}), [] { setenv("TMPDIR", "none", 1); });
  EXPECT_EQ(run({"-", name(1), "--tiled", "--labels", "%.seg"}).exit_code, 1);
  for (std::size_t t = 0; t < 4; ++t) EXPECT_FALSE(fs::exists(path("tile_" + std::to_string(t) + ".seg")));
}

TEST_F(Tiles, LeaveNoTemporaryFolderWhenStopped) {
  using namespace std::chrono_literals;
  write_tiles(meshes::subdivided(meshes::two_spheres_with_neck(2.6, 0.35, 40)));
  for (const auto pause : {20ms, 100ms}) {
    const pid_t program = start(command({}), [] { setenv("TMPDIR", ".", 1); });
    std::this_thread::sleep_for(pause);
    kill(program, SIGTERM);
    kill(program, SIGINT);
    wait(program);
    for (const auto& entry : fs::directory_iterator(path(""))) EXPECT_FALSE(entry.is_directory()) << entry.path();
  }
}

TEST_F(Tiles, StopWhenAskedTo) {
  const pid_t program = start(command({"--tile-folder", "work"}));
  using namespace std::chrono_literals;
  std::this_thread::sleep_for(30ms);
  kill(program, SIGTERM);
  const Result result = wait(program);
  EXPECT_TRUE(result.exit_code == 130 || result.exit_code == 0 || result.exit_code == -SIGTERM) << result.errors;
  fs::create_directories(path("work"));
  for (const auto& entry : fs::directory_iterator(path("work")))
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos);
}

// ---- Surfaces ----

/// Four tiles of a shaft with three steps.
class Tiles_of_shaft : public Tiles {
 protected:
  void SetUp() override {
    Tiles::SetUp();
    write_tiles(meshes::revolve({{0, -1},
                                 {0.25, -1},
                                 {0.5, -1},
                                 {0.5, -0.5},
                                 {0.5, 0},
                                 {0.8, 0},
                                 {0.8, 0.5},
                                 {0.8, 1},
                                 {0.4, 1},
                                 {0.4, 1.5},
                                 {0.4, 2},
                                 {0.2, 2},
                                 {0, 2}},
                                48));
  }
};

TEST_F(Tiles_of_shaft, HaveTheSurfacesThatTheShaftIsMadeOf) {
  const Result result = run(command({"--engineering", "--report", "report.json"}));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const Json report = Json::parse(content_of(path("report.json")));
  std::multiset<std::string> types;
  std::multiset<int> radii;  // in hundredths
  for (const Json& segment : report["segments"]) {
    types.insert(segment["surface"]["type"].get<std::string>());
    if (segment["surface"].contains("radius"))
      radii.insert(static_cast<int>(std::lround(100 * segment["surface"]["radius"].get<double>())));
  }
  EXPECT_EQ(types,
            (std::multiset<std::string>{"cylinder", "cylinder", "cylinder", "plane", "plane", "plane", "plane"}));
  EXPECT_EQ(radii, (std::multiset<int>{40, 50, 80}));
  EXPECT_EQ(report["noise"], 0);
  EXPECT_EQ(report["components"], 1);
  EXPECT_FALSE(report.contains("regular"));
}

TEST_F(Tiles_of_shaft, HaveTheSameSurfacesStepByStep) {
  ASSERT_EQ(run(command({"--engineering"})).exit_code, 0);
  const auto by_one_call = take_labels();
  const std::set<std::string> of_each_tile = {"survey", "border", "surfaces", "labels"};
  for (const std::string step : {"survey", "plan", "border", "noise", "surfaces", "merge", "labels", "report"})
    for (int tile = 3; tile >= (of_each_tile.count(step) > 0 ? 0 : 3); --tile) {
      std::vector<std::string> more = {"--engineering", "--tile-folder", "work", "--tile-step", step};
      if (of_each_tile.count(step) > 0) more.insert(more.end(), {"--tile", std::to_string(tile)});
      const Result result = run(command(more));
      ASSERT_EQ(result.exit_code, 0) << step << result.errors;
    }
  EXPECT_EQ(take_labels(), by_one_call);
}

TEST_F(Tiles_of_shaft, AreMadeRegularAndMergedFurther) {
  ASSERT_EQ(run(command({"--engineering", "--regular", "--segments", "3", "--report", "report.json"})).exit_code, 0);
  const Json report = Json::parse(content_of(path("report.json")));
  EXPECT_EQ(report["segments"].size(), 3U);
  ASSERT_EQ(run(command({"--engineering", "--regular", "--report", "report.json"})).exit_code, 0);
  const Json regular = Json::parse(content_of(path("report.json")));
  std::set<std::string> kinds;
  for (const Json& snap : regular["regular"]) kinds.insert(snap["regularity"].get<std::string>());
  EXPECT_EQ(kinds.count("coaxial"), 1U);
}

TEST_F(Tiles_of_shaft, AreReckonedWithTheNoiseThatIsGivenInTheUnitOfTheTiles) {
  ASSERT_EQ(run(command({"--engineering", "--noise", "0.001", "--report", "report.json"})).exit_code, 0);
  EXPECT_NEAR(Json::parse(content_of(path("report.json")))["noise"].get<double>(), 0.001, 1e-12);
}

TEST_F(Tiles_of_shaft, RefuseWhatSurfacesOfTilesLack) {
  const Result cad = run(command({"--engineering", "--output", "%.step"}));
  EXPECT_EQ(cad.exit_code, 1);
  EXPECT_NE(cad.errors.find("CAD files are made of whole meshes"), std::string::npos);
  const Result step = run(command({"--engineering", "--tile-folder", "work", "--tile-step", "walk"}));
  EXPECT_EQ(step.exit_code, 1);
  EXPECT_NE(step.errors.find("walk is no step"), std::string::npos);
  ASSERT_EQ(run(command({"--engineering", "--tile-folder", "work"})).exit_code, 0);
  for (const std::vector<std::string>& others : {std::vector<std::string>{}, {"--engineering", "--noise", "0.01"}}) {
    std::vector<std::string> more = {"--tile-folder", "work"};
    more.insert(more.end(), others.begin(), others.end());
    const Result result = run(command(more));
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_NE(result.errors.find("with other options"), std::string::npos);
  }
}

}  // namespace

}  // namespace test_tiles_tool

#endif
