// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_STAGES_H
#define SEGMENT_MESH_STAGES_H

#include "Progress_bar.h"
#include "limits.h"

#include <RW_segmentation/Progress.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace segment_mesh {

/// The stages of the work: a progress bar that Ctrl-C and the deadline stop, and a clock for each.
class Stages {
 public:
  /// \param title stands before the names of stages beside the bar
  /// \param is_interrupted is looked at now and then; once true, it ends the work
  Stages(bool is_bar_wanted, std::string title, const volatile std::sig_atomic_t& is_interrupted,
         const Deadline& deadline)
      : bar_(is_bar_wanted), title_(std::move(title)), is_interrupted_(is_interrupted), deadline_(deadline) {}

  /// Ends the stage before and begins one. The result is the `callback` of a computation.
  std::function<bool(double)> start(const std::string& name) {
    end();
    if (is_interrupted_) throw RW_segmentation::Cancelled();
    deadline_.check();
    bar_.start(title_ + name);
    name_ = name;
    begin_ = Clock::now();
    return [this](double fraction) {
      bar_.show(fraction);
      deadline_.check();
      return !is_interrupted_;
    };
  }

  void end() {
    if (!name_.empty()) milliseconds_[name_] = std::chrono::duration<double, std::milli>(Clock::now() - begin_).count();
    name_.clear();
    bar_.clear();
  }

  /// Ends a stage that kept times of its own.
  void split(const std::vector<RW_segmentation::Segmentation_report::Stage>& parts) {
    for (const auto& [name, seconds] : parts) milliseconds_[name] = 1000 * seconds;
    name_.clear();
    bar_.clear();
  }

  const nlohmann::ordered_json& milliseconds() const { return milliseconds_; }

 private:
  using Clock = std::chrono::steady_clock;
  Progress_bar bar_;
  std::string title_;
  const volatile std::sig_atomic_t& is_interrupted_;
  Deadline deadline_;
  std::string name_;
  Clock::time_point begin_;
  nlohmann::ordered_json milliseconds_ = nlohmann::ordered_json::object();
};

}  // namespace segment_mesh

#endif
