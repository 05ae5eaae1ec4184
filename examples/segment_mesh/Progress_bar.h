// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_PROGRESS_BAR_H
#define SEGMENT_MESH_PROGRESS_BAR_H

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

namespace segment_mesh {

/// A bar on the last line of a terminal; nothing where standard error is a file or a pipe.
class Progress_bar {
 public:
  explicit Progress_bar(bool is_wanted) : is_shown_(is_wanted && isatty(STDERR_FILENO) != 0) {}
  Progress_bar(const Progress_bar&) = delete;
  Progress_bar& operator=(const Progress_bar&) = delete;
  ~Progress_bar() { clear(); }

  /// Begins a stage.
  void start(std::string stage) {
    stage_ = std::move(stage);
    last_ = {};
    show(0);
  }

  /// Shows a fraction in [0, 1], not more often than the eye can follow.
  void show(double fraction) {
    using namespace std::chrono_literals;
    const auto now = std::chrono::steady_clock::now();
    if (!is_shown_ || now - last_ < 50ms) return;
    last_ = now;
    constexpr double width = 30;
    std::string bar(static_cast<std::size_t>(std::lround(width * fraction)), '#');
    bar.resize(static_cast<std::size_t>(width), '.');
    std::fprintf(stderr, "\r\033[K[%s] %3.0f %%  %s", bar.c_str(), 100 * fraction, stage_.c_str());
    std::fflush(stderr);
  }

  /// Takes the bar away, so that a message can be printed.
  void clear() {
    if (is_shown_) std::fputs("\r\033[K", stderr);
  }

 private:
  bool is_shown_;
  std::string stage_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace segment_mesh

#endif
