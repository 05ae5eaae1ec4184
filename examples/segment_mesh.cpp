// SPDX-License-Identifier: MIT

// The command-line tool: mesh files in, coloured meshes, labels and probabilities out.

#include "segment_mesh/Options.h"
#include "segment_mesh/Task.h"
#include "segment_mesh/check_options.h"
#include "segment_mesh/command_line.h"
#include "segment_mesh/limits.h"
#include "segment_mesh/man_page.h"
#include "segment_mesh/report.h"
#include "segment_mesh/run.h"
#include "segment_mesh/run_all.h"
#include "segment_mesh/signals.h"
#include "segment_mesh/tiles/run_tiles.h"

#include <CLI/CLI.hpp>

#include <csignal>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace {

using namespace segment_mesh;

void list(const Json& segments) {
  std::printf("label     faces    area\n");
  for (const Json& s : segments)
    std::printf("%5zu %9zu %6.2f %%\n", s["label"].get<std::size_t>(), s["faces"].get<std::size_t>(),
                100 * s["area_share"].get<double>());
}

/// Names the levels that people may prefer to the one that the shape suggests.
void offer_other_levels(const Json& report) {
  std::string others;
  for (const auto& level : report.value("levels", std::vector<std::size_t>()))
    if (level != report["segments"].size()) others += (others.empty() ? "" : " or ") + std::to_string(level);
  if (!others.empty()) std::printf("You may also try --segments %s.\n", others.c_str());
}

Exit_code run_tiles(const std::vector<Task>& tiles, const Options& options) {
  Json report;
  const Exit_code code = run_tiles(tiles, options, report);
  if (options.is_quiet || report.is_null()) return code;
  list(report["segments"]);
  if (!options.segments) offer_other_levels(report);
  return code;
}

Exit_code run_one(const Task& task, const Options& options) {
  if (options.resumes && is_done(task, options)) {
    if (!options.is_quiet) std::printf("%s: done before\n", task.mesh.c_str());
    return success;
  }
  const std::string percentage = remark_on_percentage(options.files, task.mesh);
  if (!options.is_quiet && !percentage.empty()) say(percentage);
  Journal journal(journal_of(options), options.resumes);
  const Json report = run(task, options, "");
  journal.write(report);
  const Exit_code code = has_unsound_shape(report) ? unsound_shape : success;
  if (options.is_quiet || writes_to_standard_output(task.files) ||
      mesh_files::open_file_of(journal_of(options)) == STDOUT_FILENO)
    return code;
  list(report["segments"]);
  if (!options.segments) offer_other_levels(report);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app;
  Options options;
  define_command_line(app, options);
  try {
    app.parse(argc, argv);
    if (options.is_man_page_wanted) return std::fputs(man_page(app).c_str(), stdout) >= 0 ? success : unwritable_output;
    check_combinations(options);
    survive_full_disks();
    std::signal(SIGBUS, end_for_lost_file);
    if (options.bytes) limit_memory(*options.bytes);
    const std::vector<Task> tasks = tasks_of(options);
    if (options.is_tiled) return run_tiles(tasks, options);
    return options.has_several_meshes() ? run_all(tasks, options) : run_one(tasks[0], options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? success : wrong_usage;
  } catch (const std::exception&) {
    const Outcome outcome = failure(options.meshes.empty() ? options.list : options.meshes[0], options);
    say(outcome.message);
    return outcome.code;
  }
}
