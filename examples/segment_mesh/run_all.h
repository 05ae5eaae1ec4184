// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_RUN_ALL_H
#define SEGMENT_MESH_RUN_ALL_H

#include "../mesh_files/Output_file.h"
#include "../mesh_files/Polygon_soup.h"
#include "../mesh_files/read_content.h"
#include "Options.h"
#include "Task.h"
#include "report.h"
#include "run.h"

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace segment_mesh {

/// Takes a last line away that was broken off when the program was killed or the disk was full.
inline void remove_partial_line(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return;
  const std::string content = mesh_files::read_content(path);
  const std::size_t whole_lines = content.rfind('\n') + 1;  // 0 if there is none
  if (whole_lines < content.size()) std::filesystem::resize_file(path, whole_lines, ignored);
}

/// A file that gets one line for each mesh as soon as it is done, so that what is in it remains whatever happens next.
class Journal {
 public:
  /// \param path none is written if it is empty
  /// \param continues whether lines that are there stay
  Journal(std::string path, bool continues) : path_(std::move(path)) {
    if (path_.empty()) return;
    if (continues) remove_partial_line(path_);
    const auto open = mesh_files::open_file_of(path_);
    file_.reset(open ? ::fdopen(::dup(*open), "wb") : std::fopen(path_.c_str(), continues ? "ab" : "wb"));
    if (!file_) fail();
  }

  void write(const Json& report) {
    if (!file_) return;
    const std::string line = line_of(report);
    if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0) fail();
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  [[noreturn]] void fail() const { throw mesh_files::Unwritable_file(path_ + ": " + std::strerror(errno)); }

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

/// Works through several meshes. One that fails does not end the work.
inline Exit_code run_all(const std::vector<Task>& tasks, const Options& options) {
  Journal journal(journal_of(options), options.resumes);
  const bool is_quiet = options.is_quiet || mesh_files::open_file_of(journal_of(options)) == STDOUT_FILENO;
  std::size_t done = 0, failed = 0;
  for (const Task& task : tasks) {
    const std::string title = std::to_string(++done) + " of " + std::to_string(tasks.size()) + ": ";
    if (options.resumes && is_done(task, options)) {
      if (!is_quiet) std::printf("%s: done before\n", task.mesh.c_str());
      continue;
    }
    try {
      const Json report = run(task, options, title);
      journal.write(report);
      failed += has_unsound_shape(report);
      if (!is_quiet) std::printf("%s: %s\n", task.mesh.c_str(), counted(report["segments"].size(), "segment").c_str());
    } catch (const std::exception&) {
      const Outcome outcome = failure(task.mesh, options);
      if (outcome.code == cancelled) throw;
      say(outcome.message);
      journal.write({{"mesh", task.mesh}, {"error", outcome.message}, {"exit_code", outcome.code}});
      ++failed;
    }
    std::fflush(stdout);
  }
  if (failed == 0) return success;
  say(std::to_string(failed) + " of " + counted(tasks.size(), "mesh", "meshes") + " failed");
  return some_meshes_failed;
}

}  // namespace segment_mesh

#endif
