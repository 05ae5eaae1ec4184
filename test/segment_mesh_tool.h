// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_SEGMENT_MESH_TOOL_H
#define RW_SEGMENTATION_TEST_SEGMENT_MESH_TOOL_H

// The command-line tool segment_mesh, run as a program in a folder of its own. SEGMENT_MESH is its path.

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace segment_mesh_tool {

inline std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::size_t number_of_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

struct Result {
  int exit_code;
  std::string output, errors;
};

/// A folder of its own for each test, and the tool to be run in it.
class Segment_mesh_tool : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
  }

  /// The names of the files in the folder and their contents.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      if (entry.is_regular_file()) result[entry.path().filename().string()] = content_of(entry.path().string());
    return result;
  }

  /// Starts the tool in the folder; standard output and errors go to two files elsewhere.
  /// \param prepare is called in the new process
  pid_t start(
      const std::vector<std::string>& arguments, void (*prepare)() = [] {}) const {
    const pid_t process = fork();
    if (process == 0) {
      prepare();
      std::filesystem::current_path(folder_);
      if (!std::freopen(output_.c_str(), "w", stdout) || !std::freopen(errors_.c_str(), "w", stderr)) _exit(99);
      std::vector<char*> pointers = {const_cast<char*>("segment_mesh")};
      for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
      pointers.push_back(nullptr);
      execv(program_.c_str(), pointers.data());
      _exit(99);
    }
    return process;
  }

  Result wait(pid_t process) const {
    int status = 0;
    waitpid(process, &status, 0);
    Result result = {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), content_of(output_),
                     content_of(errors_)};
    std::filesystem::remove(output_);
    std::filesystem::remove(errors_);
    return result;
  }

  Result run(const std::vector<std::string>& arguments) const { return wait(start(arguments)); }

  /// Runs the tool, which must fail with the code and one line that has the text in it, and change no file.
  void expect_failure(
      int exit_code, const std::string& text, const std::vector<std::string>& arguments,
      void (*prepare)() = [] {}) const {
    const auto before = files();
    const Result result = wait(start(arguments, prepare));
    const std::string shown = testing::PrintToString(arguments) + "\n" + result.errors;
    EXPECT_EQ(result.exit_code, exit_code) << shown;
    EXPECT_NE(result.errors.find(text), std::string::npos) << shown << "does not say " << text;
    EXPECT_EQ(number_of_lines(result.errors), 1U) << shown;
    EXPECT_EQ(result.output, "") << shown;
    EXPECT_EQ(files(), before) << shown;
  }

  std::vector<std::size_t> labels(const std::string& name) const {
    std::ifstream file(path(name));
    return {std::istream_iterator<std::size_t>(file), {}};
  }

  std::string program_ = SEGMENT_MESH;

 private:
  const std::string number_ = std::to_string(std::random_device()());
  const std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("rw_tool_" + number_);
  const std::string output_ = folder_.string() + ".out", errors_ = folder_.string() + ".err";
};

/// A cube with sides at 0 and 1, in the order z = 0, z = 1, y = 0, x = 1, y = 1, x = 0, each of n by n squares. The
/// corners are written as many times as there are squares: nothing is shared.
inline std::string cube_of_separate_squares(int n) {
  std::ostringstream points, faces;
  const std::vector<std::function<std::array<double, 3>(double, double)>> sides = {
      [](double u, double v) {
        return std::array<double, 3>{v, u, 0};
      },
      [](double u, double v) {
        return std::array<double, 3>{u, v, 1};
      },
      [](double u, double v) {
        return std::array<double, 3>{u, 0, v};
      },
      [](double u, double v) {
        return std::array<double, 3>{1, u, v};
      },
      [](double u, double v) {
        return std::array<double, 3>{v, 1, u};
      },
      [](double u, double v) {
        return std::array<double, 3>{0, v, u};
      }};
  int number = 0;
  for (const auto& side : sides)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        for (const auto& [u, v] : {std::pair(i, j), {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
          const auto p = side(double(u) / n, double(v) / n);
          points << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
        }
        faces << "4 " << number << ' ' << number + 1 << ' ' << number + 2 << ' ' << number + 3 << '\n';
        number += 4;
      }
  return "OFF\n" + std::to_string(number) + " " + std::to_string(number / 4) + " 0\n" + points.str() + faces.str();
}

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__  // as g++ says it
#endif
#endif
/// How much longer the side of a grid has to be that keeps the tool at work than one under AddressSanitizer, where all of the
/// tool takes ten times as long.
#ifdef __SANITIZE_ADDRESS__
constexpr int longer_without_sanitizer = 1;
#else
constexpr int longer_without_sanitizer = 3;
#endif

/// The square of n by n unit squares.
inline std::string grid(int n) {
  std::ostringstream file;
  file << "OFF\n" << (n + 1) * (n + 1) << ' ' << n * n << " 0\n";
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) file << x << ' ' << y << ' ' << x * y % 2 << '\n';
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x;
      file << "4 " << a << ' ' << a + 1 << ' ' << a + n + 2 << ' ' << a + n + 1 << '\n';
    }
  return file.str();
}

/// An open strip of 2 n triangles along x, a square each 0 <= x < n.
inline std::string strip(int n) {
  std::ostringstream file;
  file << "OFF\n" << 2 * (n + 1) << ' ' << 2 * n << " 0\n";
  for (int x = 0; x <= n; ++x) file << x << " 0 0\n" << x << " 1 0\n";
  for (int x = 0; x < n; ++x)
    file << "3 " << 2 * x << ' ' << 2 * x + 2 << ' ' << 2 * x + 3 << "\n3 " << 2 * x << ' ' << 2 * x + 3 << ' '
         << 2 * x + 1 << '\n';
  return file.str();
}

inline const std::vector<std::string> six_sides = {"--seed", "0.4,0.4,0", "--seed", "0.4,0.4,1", "--seed", "0.4,0,0.4",
                                                   "--seed", "1,0.4,0.4", "--seed", "0.4,1,0.4", "--seed", "0,0.4,0.4"};

inline std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace segment_mesh_tool

#endif
