// SPDX-License-Identifier: MIT

// What the command-line tool segment_mesh takes and how it ends: odd files, options, pipes and signals.

#include <gtest/gtest.h>

#ifndef SEGMENT_MESH

TEST(Segment_mesh_input, IsRead) { GTEST_SKIP() << "the tool is not built"; }

#else

#include "segment_mesh_tool.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace test_segment_mesh_input {

namespace {

using namespace segment_mesh_tool;
using nlohmann::json;

/// A folder with pipes of the shell, in which $TOOL is the tool.
class Segment_mesh_shell : public Segment_mesh_tool {
 protected:
  Result shell(const std::string& command) const {
    const std::string line = "cd '" + path("") + "' && TOOL='" SEGMENT_MESH "' && { " + command + "; }";
    const pid_t process = fork();
    if (process == 0) {
      if (!std::freopen(path("stdout").c_str(), "w", stdout) || !std::freopen(path("stderr").c_str(), "w", stderr))
        _exit(99);
      execlp("bash", "bash", "-o", "pipefail", "-c", line.c_str(), nullptr);
      _exit(99);
    }
    int status = 0;
    waitpid(process, &status, 0);
    Result result = {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), content_of(path("stdout")),
                     content_of(path("stderr"))};
    std::filesystem::remove(path("stdout"));
    std::filesystem::remove(path("stderr"));
    return result;
  }
};

const std::string six_labels = "0\n0\n0\n0\n0\n0\n";

TEST_F(Segment_mesh_tool, A3mfFileThatIsBrokenIsRefusedWithItsFault) {
  write("mesh.off", cube_of_separate_squares(2));
  ASSERT_EQ(run({"mesh.off", "--segments", "2", "--output", "whole.3mf"}).exit_code, 0);
  const Result whole = run({"whole.3mf", "--report", "report.json"});
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;

  const std::string content = content_of(path("whole.3mf"));
  write("cut.3mf", content.substr(0, content.size() / 2));
  std::string damaged = content;
  damaged.replace(damaged.find("<vertex "), 8, "<vortex ");
  write("damaged.3mf", damaged);
  const std::string name = "3D/3dmodel.model";
  std::string unnamed = content;
  for (std::size_t at = 0; (at = unnamed.find(name, at)) != std::string::npos; ++at)
    if (unnamed[at - 1] != '/') unnamed[at + name.size() - 1] = '_';  // not where another part points to it
  write("unnamed.3mf", unnamed);
  write("text.3mf", "a letter");
  write("empty.3mf", "");
  write("folder.zip", "PK\3\4 3D/part.off");
  expect_failure(2, "cut.3mf: the ZIP archive is cut off", {"cut.3mf"});
  expect_failure(2, "damaged.3mf: its part '3D/3dmodel.model' is damaged", {"damaged.3mf"});
  expect_failure(2, "unnamed.3mf: the 3MF file has no part '3D/3dmodel.model'", {"unnamed.3mf"});
  expect_failure(2, "text.3mf: this is no 3MF file", {"text.3mf"});
  expect_failure(2, "empty.3mf: the file is empty", {"empty.3mf"});
  expect_failure(2, "folder.zip: this is a ZIP archive; unpack it first", {"folder.zip"});
}

TEST_F(Segment_mesh_tool, AMeshWithoutFacesIsRefused) {
  write("points.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n");
  write("points.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
  write("solid.stl", "solid nothing\nendsolid nothing\n");
  write("zero.stl", std::string(84, '\0'));
  for (const auto& [name, vertices] : {std::pair<std::string, std::string>("points.off", "3 vertices"),
                                       {"points.obj", "2 vertices"},
                                       {"solid.stl", "0 vertices"},
                                       {"zero.stl", "0 vertices"}})
    for (const auto& options : std::vector<std::vector<std::string>>{{}, {"--segments", "5"}, {"--engineering"}})
      expect_failure(2, name + ": the file has " + vertices + " and no faces",
                     std::vector<std::string>{name, "--labels", "l.seg", "-o", "l.ply"} + options);
}

TEST_F(Segment_mesh_tool, WhatIsOddAboutAFileIsSaidAndReported) {
  write("endless.stl",
        "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n");
  const Result result = run({"endless.stl", "--report", "r.json"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.errors, "segment_mesh: endless.stl: the file ends without \"endsolid\"\n");
  EXPECT_EQ(json::parse(content_of(path("r.json")))["repairs"].size(), 1U);
}

/// The faces of each segment as the report tells and as the labels do.
void expect_agreement(const json& report, const std::vector<std::size_t>& labels) {
  std::map<std::size_t, std::size_t> reported, counted;
  for (const auto& segment : report["segments"]) reported[segment["label"]] = segment["faces"];
  for (const std::size_t label : labels) ++counted[label];
  EXPECT_EQ(reported, counted);
  EXPECT_EQ(report["faces"], labels.size());
}

TEST_F(Segment_mesh_tool, ReportAndLabelsAgreeWhateverIsLeftOut) {
  std::string file = strip(10);
  file.replace(file.find("22 20 0"), 7, "22 23 0");
  file += "3 0 1 1\n3 2 0 3\n2 20 21\n";  // an edge, the first face again, an edge
  write("strip.off", file);
  // A face that touches itself, of which one part hangs together with nothing.
  write("touching.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n1 1 0\n-1 0 0\n-1 -1 0\n0 0 1\n6 0 1 2 0 3 4\n3 1 0 5\n");
  for (const auto& options : std::vector<std::vector<std::string>>{
           {}, {"--segments", "2"}, {"--seed", "1"}, {"--coarse"}, {"--engineering"}, {"--smooth", "--refine"}})
    for (const auto& [name, left_out] :
         {std::pair<std::string, std::string>("strip.off", "20\n21\n22\n"), {"touching.off", ""}}) {
      const Result result =
          run(std::vector<std::string>{name, "--labels", "l.seg", "--report", "r.json", "--left-out", "left.txt"} +
              options);
      ASSERT_EQ(result.exit_code, 0) << result.errors;
      const json report = json::parse(content_of(path("r.json")));
      expect_agreement(report, labels("l.seg"));
      EXPECT_EQ(content_of(path("left.txt")), left_out) << name;
      EXPECT_EQ(report["left_out_faces"], number_of_lines(left_out)) << name;
      if (name == "touching.off") {
        EXPECT_NE(result.errors.find("split 1 face that touches itself"), std::string::npos) << result.errors;
      }
    }
}

TEST_F(Segment_mesh_tool, ErrorsNameTheOptionAndItsRange) {
  write("strip.off", strip(3));
  const auto expect = [&](int code, const std::string& option, const std::string& value, const std::string& range) {
    expect_failure(code, "segment_mesh: " + option + " is '" + value + "', but must be " + range,
                   {"strip.off", "--labels", "l.seg", option, value});
  };
  const std::string count = "a whole number from 1 to 4294967294";
  expect(1, "--segments", "99999999999999999999", count);
  expect(1, "--segments", "five", count);
  expect(1, "--segments", "2.5", count);
  expect(3, "--segments", "4294967295", count);
  expect(1, "--seeds", "-3", count);
  expect(3, "--smoothing", "nan", "0 or larger, and finite");
  expect(1, "--sigma", "wide", "larger than 0 and finite");
  expect(3, "--cap", "0", "larger than 0; inf is allowed");
  expect(3, "--convex-weight", "2", "from 0 to 1");
  expect(1, "--constraints-angle", "200", "an angle in degrees between 0 and 180");
  expect(1, "--time-limit", "soon", "larger than 0 and finite");
  expect(1, "--noise", "-1", "0 or larger, and finite");
  expect(1, "--regular-length", "nan", "0 or larger, and finite");
  expect(1, "--regular-angle", "50", "an angle from 0 to 45 degrees");
  expect_failure(1, "--measure: foo is none of angle, cosine", {"strip.off", "--measure", "foo"});
}

TEST_F(Segment_mesh_tool, AnOutputFormatThatNothingTakesIsRefused) {
  write("strip.off", strip(3));
  expect_failure(1, "--output-format: the name of each --output tells",
                 {"strip.off", "-o", "o.ply", "--output-format", "stl"});
  expect_failure(1, "--output-format: parts of --split are no OBJ",
                 {"strip.off", "--split", "p", "--output-format", "obj"});
  for (const char* output : {"o", "/dev/stdout"})
    expect_failure(1, "--output-format: OBJ files need others beside them",
                   {"strip.off", "-o", output, "--output-format", "obj"});
  for (const auto& [output, format] : {std::pair<std::string, std::string>("o.stl", "stl-text"), {"o", "vtp"}})
    EXPECT_EQ(run({"strip.off", "-o", output, "--output-format", format}).exit_code, 0) << output;
}

TEST_F(Segment_mesh_tool, ListsMayHaveComments) {
  write("a.off", strip(3));
  write("b.off", strip(3));
  write("list.txt", "# two meshes\n\na.off\r\n#c.off\nb.off\n");
  ASSERT_EQ(run({"--list", "list.txt", "--labels", "%.seg", "--segments", "1"}).exit_code, 0);
  EXPECT_EQ(content_of(path("a.seg")), six_labels);
  EXPECT_EQ(content_of(path("b.seg")), six_labels);
}

TEST_F(Segment_mesh_tool, FoldersTellMeshesOfTheSameNameApart) {
  for (const char* folder : {"one", "one/part", "two"}) {
    std::filesystem::create_directory(path(folder));
    write(std::string(folder) + "/m.off", strip(3));
  }
  const std::vector<std::string> meshes = {"one/m.off", "./one/part/m.off", "two/m.off"};
  ASSERT_EQ(run(meshes + std::vector<std::string>{"--labels", "{folder}_%.seg", "--quiet"}).exit_code, 0);
  for (const char* name : {"one_m.seg", "one_part_m.seg", "two_m.seg"}) EXPECT_EQ(labels(name).size(), 6U) << name;
  expect_failure(1, "m.seg is an input or another output", meshes + std::vector<std::string>{"--labels", "%.seg"});
}

TEST_F(Segment_mesh_tool, TwoPercentSignsAreOne) {
  write("m.off", strip(3));
  ASSERT_EQ(run({"m.off", "-o", "100%%.ply", "--labels", "%%%.seg"}).exit_code, 0);
  EXPECT_EQ(files().count("100%.ply"), 1U);
  EXPECT_EQ(files().count("%m.seg"), 1U);
  write("n.off", strip(3));
  expect_failure(1, "several meshes need a %", {"m.off", "n.off", "--labels", "100%%.seg"});
}

TEST_F(Segment_mesh_tool, SaysWhereAPercentageBecomesTheNameOfTheMesh) {
  write("m.off", grid(2));
  const Result percentage = run({"m.off", "-o", "100%.ply", "--labels", "out%.seg"});
  EXPECT_EQ(percentage.exit_code, 0);
  EXPECT_EQ(
      percentage.errors,
      "segment_mesh: --output 100%.ply is 100m.ply: % stands for the name of the mesh, and %% for a percent sign\n");
  EXPECT_TRUE(std::filesystem::exists(path("100m.ply")));
  EXPECT_TRUE(std::filesystem::exists(path("outm.seg")));
  for (const char* silent : {"out%.ply", "100%%.ply", "%1.ply"})
    EXPECT_EQ(run({"m.off", "-o", silent}).errors, "") << silent;
  EXPECT_TRUE(std::filesystem::exists(path("100%.ply")));
}

// ---- Pipes ----

TEST_F(Segment_mesh_shell, StandardInputIsAMesh) {
  write("m.off", strip(3));
  write("m.obj", "usemap no\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const char* command :
       {"cat m.off | $TOOL - --segments 1 --labels l.seg", "$TOOL /dev/stdin --segments 1 --labels l.seg <m.off",
        "cat m.off | $TOOL /dev/stdin --segments 1 --labels l.seg", "$TOOL <(cat m.off) --segments 1 --labels l.seg",
        "gzip -c m.off | $TOOL - --segments 1 --labels l.seg",
        "mkfifo p && { cat m.off >p & } && $TOOL p --segments 1 --labels l.seg && wait $! && rm p",
        "cat m.off | $TOOL --segments 1 --labels l.seg --report r.json - && grep -q 'mesh\":\"-\"' r.json"}) {
    const Result result = shell(command);
    EXPECT_EQ(result.exit_code, 0) << command << result.errors;
    EXPECT_EQ(content_of(path("l.seg")), six_labels) << command;
    std::filesystem::remove(path("l.seg"));
  }
  EXPECT_EQ(shell("$TOOL - --labels l.seg <m.obj").exit_code, 2);
  EXPECT_EQ(shell("$TOOL - --format obj --labels l.seg <m.obj").exit_code, 0);
  EXPECT_EQ(content_of(path("l.seg")), "0\n");
  EXPECT_EQ(shell("$TOOL - m.off --labels %.seg <m.off").exit_code, 0);
  EXPECT_EQ(labels("standard_input.seg").size(), 6U);
  EXPECT_EQ(shell("echo m.off | $TOOL - --list - --labels %.seg").exit_code, 1);
}

TEST_F(Segment_mesh_shell, StandardOutputHoldsTheOutputAndNothingElse) {
  write("m.off", strip(3));
  EXPECT_EQ(shell("$TOOL m.off --segments 1 --labels /dev/stdout").output, six_labels);
  EXPECT_EQ(shell("$TOOL m.off --segments 1 --labels /dev/stdout | cat").output, six_labels);
  EXPECT_EQ(shell("$TOOL m.off --segments 1 --labels /proc/self/fd/1 | cat").output, six_labels);
  EXPECT_EQ(shell("echo 7; $TOOL m.off --segments 1 --labels /dev/fd/1").output, "7\n" + six_labels);
  EXPECT_EQ(shell("$TOOL m.off --segments 1 --labels >(cat >l.seg); sleep .1").exit_code, 0);
  EXPECT_EQ(shell("while [ ! -s l.seg ]; do sleep .01; done; cat l.seg").output, six_labels);
  EXPECT_EQ(
      shell("$TOOL m.off --segments 1 -o /dev/stdout --output-format off | $TOOL - --labels /dev/stdout").output.size(),
      12U);
  EXPECT_EQ(json::parse(shell("$TOOL m.off --report /dev/stdout").output)["faces"], 6);
  EXPECT_EQ(shell("$TOOL m.off m.off -q --report /dev/stdout").exit_code, 1);
  const Result untold = shell("$TOOL m.off -o /dev/stdout");
  EXPECT_EQ(untold.exit_code, 1);
  EXPECT_NE(untold.errors.find("give --output-format, too"), std::string::npos) << untold.errors;
  EXPECT_EQ(shell("$TOOL m.off --labels /dev/stdout --report /dev/stdout").exit_code, 1);
}

// ---- Signals ----

class Segment_mesh_signals : public Segment_mesh_tool {
 protected:
  bool is_there(const std::string& begin) const {
    for (const auto& entry : std::filesystem::directory_iterator(path("")))
      if (entry.path().filename().string().compare(0, begin.size(), begin) == 0) return true;
    return false;
  }
  void wait_for(const std::string& begin) const {
    for (int i = 0; i < 60000 && !is_there(begin); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_TRUE(is_there(begin));
  }
};

TEST_F(Segment_mesh_signals, NoPartialFileSurvivesASignal) {
  write("grid.off", grid(40 * longer_without_sanitizer));
  for (const auto& [signal, mode] : std::vector<std::pair<int, std::vector<std::string>>>{
           {SIGINT, {}}, {SIGTERM, {}}, {SIGHUP, {}}, {SIGQUIT, {}}, {SIGXCPU, {}}, {SIGINT, {"--engineering"}}}) {
    const pid_t process = start(std::vector<std::string>{"grid.off", "--labels", "l.seg", "--split", "parts"} + mode,
                                [] { std::signal(SIGHUP, SIG_DFL); });  // who starts the tests may ignore it
    wait_for("parts");
    if (!mode.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    kill(process, signal);
    const Result result = wait(process);
    EXPECT_EQ(result.exit_code, 130) << signal << result.errors;
    EXPECT_NE(result.errors.find("cancelled, nothing was written\n"), std::string::npos) << signal << result.errors;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("")), {}), 1) << signal;
  }
}

TEST_F(Segment_mesh_signals, WhoIgnoresHangingUpGoesOn) {
  write("grid.off", grid(100));
  const pid_t process = start({"grid.off", "--labels", "l.seg"}, [] { std::signal(SIGHUP, SIG_IGN); });
  wait_for("l.seg");
  kill(process, SIGHUP);
  EXPECT_EQ(wait(process).exit_code, 0);
  EXPECT_EQ(labels("l.seg").size(), 10000U);
}

TEST_F(Segment_mesh_shell, APipeThatNobodyReadsIsAnOutputThatCannotBeWritten) {
  write("grid.off", grid(100));
  const Result result = shell(
      "$TOOL grid.off --seed 0 --labels l.seg -o /dev/stdout --output-format ply | true; "
      "echo ${PIPESTATUS[0]}");
  EXPECT_EQ(result.output, "5\n") << result.errors;
  EXPECT_EQ(files().size(), 1U);
}

}  // namespace

}  // namespace test_segment_mesh_input

#endif
