// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_BENCHMARK_MEASUREMENT_H
#define RW_SEGMENTATION_BENCHMARK_MEASUREMENT_H

// What the benchmark programs share: meshes of given sizes, clocks, measurements in processes of their own, and the
// lines for machines that start with RESULT. Needs POSIX.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace measurement {

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

// ---- Meshes ----

/// \throws std::runtime_error if the file holds no mesh.
Mesh read_mesh(const std::string& path);

/// The path of one of CGAL's data meshes.
std::string data_mesh(const std::string& name);

/// The names of the sizes in the order of growing meshes.
std::vector<std::string> sizes();

/// 9 560, 38 240, 152 960, 611 840, 1 032 480, 2 447 360 or 9 789 440 faces.
Mesh mesh_of_size(const std::string& name);

/// Different faces, always the same ones of a mesh; the first ones of more faces are those of fewer.
std::vector<Mesh::Face_index> random_faces(const Mesh& mesh, std::size_t number);

// ---- Time and memory ----

class Stopwatch {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The middle value, the larger one of two.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

inline double maximum(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

/// The memory that this process holds at the moment.
inline double resident_mb() {
  std::size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// The most memory that this process has ever held.
inline double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

/// What a measurement gave: its numbers, or the reason why there are none.
struct Outcome {
  std::vector<double> numbers;
  std::string failure;
};

/// Runs `measure()`, which returns a vector of numbers, in a process of its own that starts with what this one holds:
/// neither memory that others have used nor their crash touches it.
template <class Measure>
Outcome in_own_process(const Measure& measure) {
  std::fflush(stdout);
#ifdef __GLIBC__
  malloc_trim(0);  // what this process no longer needs would hide what the new one needs
#endif
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("cannot open a pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    close(ends[0]);
    FILE* out = fdopen(ends[1], "w");
    try {
      for (const double number : measure()) std::fprintf(out, "%.17g\n", number);
    } catch (const std::exception& error) {
      std::fprintf(out, "failure %s\n", error.what());
    }
    std::fclose(out);
    _exit(0);
  }
  close(ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t count = 0; (count = read(ends[0], buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(count));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);

  Outcome outcome;
  if (WIFSIGNALED(status)) outcome.failure = "ended by signal " + std::to_string(WTERMSIG(status));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("failure ", 0) == 0)
      outcome.failure = line.substr(8);
    else
      outcome.numbers.push_back(std::stod(line));
  }
  return outcome;
}

/// The time to read a mesh from a file, in a process of its own.
double milliseconds_to_read(const std::string& path);

/// The time to read a mesh that was made, from an OFF file in a temporary folder.
double milliseconds_to_read(const Mesh& mesh);

// ---- Results ----

/// A line for machines: RESULT bench=NAME key=value ... The lines are printed when the program ends.
class Result {
 public:
  explicit Result(const std::string& bench) : line_("RESULT bench=" + bench) {}

  template <class Value>
  Result& add(const char* key, const Value& value) {
    std::ostringstream text;
    text << ' ' << key << '=' << value;
    line_ += text.str();
    return *this;
  }

  /// A text that may hold spaces; the last thing on its line.
  Result& add_reason(const std::string& reason) { return add("reason", '"' + reason + '"'); }

  const std::string& line() const { return line_; }

 private:
  std::string line_;
};

inline void print(const std::vector<Result>& results) {
  std::cout << '\n';
  for (const Result& result : results) std::cout << result.line() << '\n';
  std::cout.flush();
}

}  // namespace measurement

#endif
