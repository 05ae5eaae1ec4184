// SPDX-License-Identifier: MIT

// Whether segment_mesh bears any mesh with any defect in any of its modes, and reads it in any dialect of its formats.

#include "../examples/mesh_files.h"
#include "../test/defects.h"
#include "../test/dialects.h"
#include "../test/large_shapes.h"
#include "measurement.h"

#include <CLI/CLI.hpp>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace measurement;

namespace {

/// What the tool is asked to do.
const std::vector<std::pair<std::string, std::vector<std::string>>> modes = {{"seeds", {"--seed", "0", "--seed", "1"}},
                                                                             {"automatic", {}},
                                                                             {"five", {"--segments", "5"}},
                                                                             {"coarse", {"--coarse"}},
                                                                             {"machine", {"--engineering"}},
                                                                             {"refined", {"--smooth", "--refine"}}};

struct Arguments {
  std::string tool;
  std::vector<std::string> meshes = {
      "bear",     "blobby",          "bones",     "bull",     "camel",   "cow",       "cross_quad",
      "cube",     "cube_quad",       "eight",     "elephant", "fandisk", "hand",      "joint",
      "mushroom", "oblong-shuffled", "open_cube", "pipe",     "rotor",   "torus_quad"};
  std::vector<std::string> dialect_meshes = {"cube", "hand"};
  std::vector<std::string> defects;
  bool are_shapes_large = false;
  unsigned seconds = 120, megabytes = 4000;
};

defects::Soup read_soup(const std::string& path) {
  const mesh_files::Polygon_soup file = mesh_files::read_mesh(path);
  defects::Soup soup;
  for (const auto& p : file.points) soup.points.emplace_back(p.x(), p.y(), p.z());
  for (std::size_t f = 0; f < file.number_of_faces(); ++f)
    soup.faces.emplace_back(file.face(f).begin(), file.face(f).end());
  return soup;
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder that the tool is run in.
class Workplace {
 public:
  explicit Workplace(const Arguments& arguments)
      : arguments_(arguments),
        folder_(std::filesystem::temp_directory_path() / ("defects_" + std::to_string(std::random_device()()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Workplace() { std::filesystem::remove_all(folder_); }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  void write(const std::string& content, const std::string& file = "mesh.off") const {
    std::ofstream(folder_ / file, std::ios::binary) << content;
  }

  /// Runs the tool on a dialect of a mesh. What is wrong with what it does; "" if it is right.
  std::string fault(const dialects::Dialect& dialect, const defects::Soup& soup) const {
    const auto [code, errors] = run({"--seed", "0"}, dialect.file);
    std::string fault;
    if (code < 0)
      fault = "ended by signal " + std::to_string(-code);
    else if (dialect.refusal.empty())
      fault = code == 0 ? fault_of_geometry(soup) : "refuses: " + errors;
    else if (code != 2)
      fault = "exit code " + std::to_string(code);
    else if (errors.find(dialect.refusal) == std::string::npos)
      fault = "does not say \"" + dialect.refusal + "\" but " + errors;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) std::filesystem::remove_all(entry.path());
    return fault;
  }

  /// Runs the tool on the mesh. What is wrong with what it does; "" if it is right, "refused" if it tells why not.
  std::string fault(const std::vector<std::string>& mode) const {
    const auto [code, errors] = run(mode);
    if (code < 0) return "ended by signal " + std::to_string(-code);
    std::string fault = "refused";
    if (code == 0)
      fault = fault_of_outputs();
    else if (code > 5)
      fault = "exit code " + std::to_string(code);
    else if (!names_the_file(errors))
      fault = "says " + errors;
    else if (std::distance(std::filesystem::directory_iterator(folder_), {}) != 1)
      fault = "leaves files although it refuses";
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      if (entry.path().filename() != "mesh.off") std::filesystem::remove_all(entry.path());
    return fault;
  }

 private:
  /// The exit code, or minus the signal that ended the tool, and its errors.
  std::pair<int, std::string> run(const std::vector<std::string>& mode, const std::string& file = "mesh.off") const {
    const std::string errors = folder_.string() + ".err";
    std::fflush(stdout);
    const pid_t process = fork();
    if (process == 0) {
      const rlimit time = {arguments_.seconds, arguments_.seconds},
                   memory = {rlim_t(arguments_.megabytes) << 20, rlim_t(arguments_.megabytes) << 20};
      setrlimit(RLIMIT_CPU, &time);
      setrlimit(RLIMIT_AS, &memory);
      if (chdir(folder_.c_str()) != 0 || !std::freopen("/dev/null", "w", stdout) ||
          !std::freopen(errors.c_str(), "w", stderr))
        _exit(99);
      std::vector<std::string> words = {"segment_mesh", file, "--output", "out.ply", "--labels", "out.seg"};
      words.insert(words.end(), mode.begin(), mode.end());
      std::vector<char*> pointers;
      for (std::string& word : words) pointers.push_back(word.data());
      pointers.push_back(nullptr);
      execv(arguments_.tool.c_str(), pointers.data());
      _exit(99);
    }
    int status = 0;
    waitpid(process, &status, 0);
    const std::string said = content_of(errors);
    std::filesystem::remove(errors);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), said};
  }

  /// Whether there is a line, and each says which file it is about: what was repaired, and what is wrong.
  static bool names_the_file(const std::string& errors) {
    std::istringstream lines(errors);
    std::string line;
    bool is_any = false;
    while (std::getline(lines, line)) {
      if (line.rfind("segment_mesh: mesh.off", 0) != 0) return false;
      is_any = true;
    }
    return is_any;
  }

  std::string fault_of_outputs() const {
    const std::size_t faces = mesh_files::read_mesh((folder_ / "out.ply").string()).number_of_faces();
    std::istringstream lines(content_of(folder_ / "out.seg"));
    const std::vector<std::size_t> labels{std::istream_iterator<std::size_t>(lines), {}};
    if (!lines.eof()) return "labels are no numbers";
    if (labels.size() != faces) return "there is not a label for each face";
    for (const std::size_t label : labels)
      if (label >= faces) return "a label is out of range";
    return "";
  }

  /// Whether the mesh that was written has the triangles of the one that was read, in their order.
  std::string fault_of_geometry(const defects::Soup& soup) const {
    if (const std::string fault = fault_of_outputs(); !fault.empty()) return fault;
    const mesh_files::Polygon_soup written = mesh_files::read_mesh((folder_ / "out.ply").string());
    if (written.number_of_faces() != soup.faces.size()) return "there are other numbers of faces";
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
      std::vector<Eigen::Vector3f> expected, found;
      for (const std::size_t corner : soup.faces[f]) expected.push_back(soup.points[corner].cast<float>());
      for (const auto corner : written.face(f)) {
        const auto& p = written.points[corner];
        found.emplace_back(float(p.x()), float(p.y()), float(p.z()));
      }
      const auto first = std::find(found.begin(), found.end(), expected[0]);
      if (first != found.end()) std::rotate(found.begin(), first, found.end());
      if (found != expected) return "face " + std::to_string(f) + " is another";
    }
    return "";
  }

  const Arguments& arguments_;
  std::filesystem::path folder_;
};

/// The mesh with its polygons cut into triangles, which all formats have.
defects::Soup triangulated(const defects::Soup& soup) {
  defects::Soup result = {soup.points, {}};
  for (const auto& face : soup.faces)
    for (std::size_t i = 2; i < face.size(); ++i) result.faces.push_back({face[0], face[i - 1], face[i]});
  return result;
}

bool is_asked_for(const std::string& name, const std::vector<std::string>& names) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

/// Counts right and wrong answers to all dialects of a few meshes.
Result dialect_result(const Workplace& workplace, const Arguments& arguments) {
  std::size_t runs = 0, wrong = 0, tried = 0;
  for (const dialects::Dialect& dialect : dialects::all()) {
    if (!is_asked_for(dialect.name, arguments.defects)) continue;
    ++tried;
    for (const std::string& mesh : arguments.dialect_meshes) {
      const defects::Soup soup = triangulated(read_soup(data_mesh(mesh + ".off")));
      const std::string content = dialect.content(soup);
      if (content.empty()) continue;
      workplace.write(content, dialect.file);
      const std::string fault = workplace.fault(dialect, soup);
      ++runs;
      wrong += !fault.empty();
      if (!fault.empty()) std::printf("WRONG: %s, %s: %s\n", mesh.c_str(), dialect.name.c_str(), fault.c_str());
    }
  }
  Result result("dialects");
  result.add("dialects", tried).add("correct", runs - wrong).add("wrong", wrong);
  return result;
}

/// How long the tool takes for the meshes of the kinds that take longest, in each mode.
void measure_large_shapes(const Workplace& workplace) {
  for (const auto& [name, make] : large_shapes::all()) {
    const defects::Soup soup = make();
    workplace.write(defects::off_text(soup));
    for (const auto& [mode, options] : modes) {
      const Stopwatch watch;
      const std::string fault = workplace.fault(options);
      const double milliseconds = watch.milliseconds();
      Result result("large_shapes");
      result.add("mesh", name).add("faces", soup.faces.size()).add("mode", mode).add("ms", milliseconds);
      result.add("outcome", fault.empty() ? "correct" : fault == "refused" ? fault : "wrong");
      print({result});
    }
  }
}

}  // namespace

int main(int argc, char** argv) try {
  Arguments arguments;
  CLI::App app(
      "Runs the tool segment_mesh on meshes with defects, in all its modes. Right is an answer for every face, or a "
      "refusal that names the file and its cause and leaves no file behind. A crash, too much time or memory, or "
      "anything else is wrong. Then the same meshes in dialects of OFF, OBJ, PLY, STL and VTP: right is the same "
      "geometry, "
      "or for "
      "files that are no meshes a refusal that calls them by their name.");
  app.add_option("TOOL", arguments.tool, "The path of segment_mesh")->required()->check(CLI::ExistingFile);
  app.add_option("--meshes", arguments.meshes, "Data meshes of CGAL")->delimiter(',')->capture_default_str();
  app.add_option("--dialect-meshes", arguments.dialect_meshes, "Those that are written in all dialects")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--defects", arguments.defects, "Defects and dialects by their names; all by default")->delimiter(',');
  app.add_flag("--large-shapes", arguments.are_shapes_large,
               "In place of all that, the time that each mode takes for meshes of the kinds that take longest");
  app.add_option("--seconds", arguments.seconds, "Of a run at most")->capture_default_str();
  app.add_option("--megabytes", arguments.megabytes, "Of a run at most")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  arguments.tool = std::filesystem::absolute(arguments.tool).string();

  const Workplace workplace(arguments);
  if (arguments.are_shapes_large) {
    measure_large_shapes(workplace);
    return 0;
  }
  std::map<std::string, std::size_t> totals;
  std::printf("%-30s %8s %8s %8s\n", "defect", "correct", "refused", "wrong");
  for (const defects::Defect& defect : defects::all()) {
    if (!is_asked_for(defect.name, arguments.defects)) continue;
    std::map<std::string, std::size_t> counts;
    for (const std::string& mesh : arguments.meshes) {
      workplace.write(defects::damaged_off(read_soup(data_mesh(mesh + ".off")), defect));
      for (const auto& [mode, options] : modes) {
        const std::string fault = workplace.fault(options);
        const std::string outcome = fault.empty() ? "correct" : fault == "refused" ? fault : "wrong";
        ++counts[outcome];
        ++totals[outcome];
        if (outcome == "wrong")
          std::printf("WRONG: %s, %s, %s: %s\n", mesh.c_str(), defect.name.c_str(), mode.c_str(), fault.c_str());
      }
    }
    std::printf("%-30s %8zu %8zu %8zu\n", defect.name.c_str(), counts["correct"], counts["refused"], counts["wrong"]);
    std::fflush(stdout);
  }
  std::vector<Result> results(1, Result("defects"));
  results[0].add("meshes", arguments.meshes.size()).add("modes", modes.size());
  for (const char* outcome : {"correct", "refused", "wrong"}) results[0].add(outcome, totals[outcome]);
  results.push_back(dialect_result(workplace, arguments));
  print(results);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "benchmark_defects: " << error.what() << '\n';
  return 1;
}
