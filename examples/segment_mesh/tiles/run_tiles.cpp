// SPDX-License-Identifier: MIT

#include "run_tiles.h"

#include "../Progress_bar.h"
#include "../failure.h"
#include "../signals.h"
#include "Tile_steps.h"
#include "Worker_pool.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <filesystem>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace segment_mesh {
namespace {

namespace fs = std::filesystem;

constexpr const char* parameters_file = "parameters.json";
constexpr const char* seeds_file = "seeds.json";
constexpr const char* parting_file = "parting";
constexpr const char* seeding_file = "seeding";

/// The folder for what steps leave: the user's, which stays once it is claimed, or one for the time of the work.
class Work_folder {
 public:
  explicit Work_folder(std::string path) : path_(std::move(path)) {
    std::error_code error;
    if (path_.empty()) {
      path_ = (fs::temp_directory_path(error) / ("segment_mesh_" + std::to_string(std::random_device()()))).string();
      if (error) throw mesh_files::Unwritable_file("the folder for temporary files (TMPDIR): " + error.message());
      is_temporary_ = fs::create_directory(path_, error);
      if (!is_temporary_) throw mesh_files::Unwritable_file(path_ + ": cannot be made");
    } else {
      is_made_ = fs::create_directories(path_, error);
      if (error) throw mesh_files::Unwritable_file(path_ + ": " + error.message());
    }
  }
  Work_folder(const Work_folder&) = delete;
  Work_folder& operator=(const Work_folder&) = delete;
  ~Work_folder() {
    std::error_code ignored;
    if (is_temporary_) fs::remove_all(path_, ignored);
    if (is_made_ && !is_claimed_) fs::remove(path_, ignored);  // if it is empty
  }

  const std::string& path() const { return path_; }

  /// Whether no call has done a step in it.
  bool is_unclaimed() const { return !fs::exists(path_ + "/" + parameters_file); }

  /// Refuses a folder that other tiles or options have left their files in, or where others would be taken for such files.
  /// \param files that steps leave
  void claim(const std::string& parameters, const std::vector<std::string>& files) {
    is_new_ = is_unclaimed();
    if (is_new_)
      for (const std::string& of_step : files)
        if (fs::exists(of_step))
          throw Argument_out_of_range("--tile-folder " + path_ + " holds " + of_step +
                                      ", which no step has left there: give another folder");
    if (holds_other(parameters_file, parameters))
      throw Argument_out_of_range("--tile-folder " + path_ +
                                  " holds the work on other tiles or with other options: give another folder, or "
                                  "remove it");
    is_claimed_ = true;
    keep(parameters_file, parameters);
  }

  /// Leaves the folder as it was before it was claimed, if tiles have been surveyed since and nothing else; one that was claimed
  /// before stays so.
  void give_up(const Tile_steps& steps) {
    if (!is_new_) return;
    for (std::size_t t = 0; t < steps.number_of_tiles(); ++t) steps.forget(steps.named("survey"), t);
    for (const char* file : {parameters_file, parting_file, seeding_file, seeds_file}) fs::remove(path_ + "/" + file);
    is_claimed_ = false;
  }

  /// Whether there is a file of that name with another content.
  bool holds_other(const char* name, const std::string& content) const {
    const std::string path = path_ + "/" + name;
    return fs::exists(path) && mesh_files::read_content(path) != content;
  }

  /// Writes a file, over the one that is there.
  void keep(const char* name, const std::string& content) const {
    mesh_files::Output_file file(path_ + "/" + name);
    file.write(content);
    file.commit();
  }

 private:
  std::string path_;
  bool is_temporary_ = false, is_made_ = false;
  bool is_claimed_ = false, is_new_ = false;  // by this call
};

/// Refuses outputs that would take the places of what steps leave.
void check_outputs(const std::vector<Task>& tiles, const std::string& report, const Tile_steps& steps,
                   const std::string& folder) {
  std::set<fs::path> taken;
  for (const std::string& file : steps.files()) taken.insert(fs::path(file).filename());
  const fs::path folder_of_steps = fs::canonical(folder);
  const auto check = [&](const char* option, const std::string& path) {
    std::error_code error;  // of pipes, which have names that lead nowhere
    const fs::path place = fs::weakly_canonical(fs::absolute(path), error);
    if (place.parent_path() == folder_of_steps && taken.count(place.filename()) > 0)
      throw CLI::ValidationError(option, path + " is what a step leaves in --tile-folder: give another name");
  };
  for (const Task& tile : tiles) {
    for (const auto& [option, path] : written_files(tile.files)) check(option, path);
    if (!tile.files.split.empty()) check("--split", tile.files.split);
  }
  if (!report.empty()) check("--report", report);
}

/// Forgets what has been left by all steps, if parts are taken together that were not or the other way round; by those from
/// the second one on, if a tile has changed; by those that seeds matter to, if there are more or fewer or the user gives others;
/// and in any case by those that tell of levels.
void forget_old_work(const Tile_steps& steps, const Work_folder& folder) {
  bool is_any_new = false;
  for (std::size_t t = 0; t < steps.number_of_tiles(); ++t) {
    if (steps.has_changed(t)) steps.forget(steps.named("survey"), t);
    is_any_new = is_any_new || !steps.is_done(steps.named("survey"), t);
  }
  const bool has_other_seeds = folder.holds_other(seeds_file, steps.seeds_in_words());
  const bool is_parted_otherwise = folder.holds_other(parting_file, steps.parting_in_words());
  const bool is_seeded_otherwise = folder.holds_other(seeding_file, steps.seeding_in_words());
  const std::string first = is_parted_otherwise   ? "survey"
                            : is_any_new          ? "plan"
                            : is_seeded_otherwise ? "shape"
                            : has_other_seeds     ? "places"
                                                  : "merge";
  bool is_old = false;
  for (const Tile_step& step : steps.all()) {
    is_old = is_old || step.name == first;
    for (std::size_t t = 0; is_old && t < (step.is_of_each_tile ? steps.number_of_tiles() : 1); ++t)
      steps.forget(step, t);
  }
  folder.keep(parting_file, steps.parting_in_words());
  folder.keep(seeding_file, steps.seeding_in_words());
  folder.keep(seeds_file, steps.seeds_in_words());  // last: a call that is broken off before it begins anew
}

/// Forgets what has been left for other segments.
void forget_steps_after(const Tile_steps& steps, const Tile_step& step) {
  bool is_after = false;
  for (const Tile_step& later : steps.all()) {
    for (std::size_t t = 0; is_after && t < (later.is_of_each_tile ? steps.number_of_tiles() : 1); ++t)
      steps.forget(later, t);
    is_after = is_after || &later == &step;
  }
}

/// Refuses outputs that cannot be written, before the work.
void check_folders(const std::vector<Task>& tiles, const std::string& report, const Tile_steps& steps) {
  const auto check = [](const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    if (!folder.empty() && !fs::is_directory(folder))
      throw mesh_files::Unwritable_file(path + ": there is no such folder");
  };
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const Task& tile = tiles[t];
    for (const auto& [option, path] : written_files(tile.files)) check(path);
    if (tile.files.split.empty()) continue;
    check(tile.files.split);
    std::error_code error;  // it is not there
    if (!fs::is_empty(tile.files.split, error) && !error && !steps.has_left_parts(t))
      throw mesh_files::Unwritable_file(tile.files.split + ": the folder is not empty");
  }
  if (!report.empty()) check(report);
}

/// Refuses tiles none of which is there: of wrong paths, or on a disk that is not mounted, where work on them is not lost then.
void check_tiles_are_there(const std::vector<Task>& tiles) {
  const auto is_there = [](const Task& tile) {
    std::error_code error;
    return fs::exists(tile.mesh, error);
  };
  if (std::none_of(tiles.begin(), tiles.end(), is_there))
    throw mesh_files::Unreadable_file(tiles[0].mesh + ": no such file" +
                                      (tiles.size() > 1 ? ", nor any of the other tiles" : ""));
}

/// Refuses a single step that there is none of, and one that would find nothing that it could begin with.
void check_step(const Tile_steps& steps, const std::vector<Task>& tiles, const Work_folder& folder,
                const Options& options) {
  const Tile_step& step = steps.named(options.tile_step);
  if (step.is_of_each_tile != options.tile.has_value())
    throw CLI::ValidationError("--tile", step.is_of_each_tile ? "this step is done for one tile: tell which"
                                                              : "this step is for all tiles: leave it out");
  if (options.tile && *options.tile >= steps.number_of_tiles())
    throw Argument_out_of_range("--tile is " + std::to_string(*options.tile) + ", but there are " +
                                counted(steps.number_of_tiles(), "tile") + ", numbered from 0");
  if (step.name == std::string("survey"))
    check_tiles_are_there(tiles);
  else if (folder.is_unclaimed())
    throw mesh_files::Unreadable_file("--tile-folder " + folder.path() +
                                      ": no step has been done in it; the first one is --tile-step survey");
}

/// Lets memory that is freed be used again in this process, which ends after a step: to give it back and to get it anew takes
/// a tenth of the time of a tile with 2.5 million faces.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int asked_for_at_a_time = 1 << 26;  // bytes; a step takes hundreds of megabytes
  ::mallopt(M_MMAP_MAX, 0);
  ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  ::mallopt(M_TOP_PAD, asked_for_at_a_time);
#endif
}

/// Does a step in this process.
Exit_code do_step(const Tile_steps& steps, const Tile_step& step, std::size_t tile, const Options& options) {
  keep_freed_memory();
  try {
    step.run(tile);
    return success;
  } catch (const std::exception&) {
    auto [code, message] = failure("step " + std::string(step.name), options);
    const bool is_tile_named = !step.is_of_each_tile || message.find(steps.name_of(tile)) != std::string::npos;
    say(is_tile_named ? message : steps.name_of(tile) + ": " + message);
    return code;
  }
}

Exit_code do_all_steps(const Tile_steps& steps, Work_folder& folder, const Options& options, Json& report) {
  Worker_pool pool(options.workers.value_or(std::max(1U, std::thread::hardware_concurrency())));
  Progress_bar bar(!options.is_quiet);
  Json costs = Json::object();
  forget_old_work(steps, folder);
  for (const Tile_step& step : steps.all()) {
    std::vector<std::size_t> jobs;
    for (std::size_t t = 0; t < (step.is_of_each_tile ? steps.number_of_tiles() : 1); ++t)
      if (!steps.is_done(step, t)) jobs.push_back(t);
    bar.start(step.name);
    Job_costs of_step;
    const Exit_code code = pool.run(
        jobs, [&](std::size_t tile) { return do_step(steps, step, tile, options); },
        [&](std::size_t done) { bar.show(static_cast<double>(done) / static_cast<double>(jobs.size())); }, of_step);
    bar.clear();
    if (of_step.again > 0 && !options.is_quiet)
      say("step " + std::string(step.name) + ": " + counted(of_step.again, "job was lost", "jobs were lost") +
          " and done again");
    for (const std::size_t lost : of_step.lost)
      say((step.is_of_each_tile ? steps.name_of(lost) + ": " : "") + "step " + step.name +
          ": the job was lost each time, as its worker was killed");
    if (code == wrong_argument && step.name == std::string("plan")) folder.give_up(steps);  // to other options
    if (code != success) return code;
    costs[step.name] = {{"jobs", jobs.size()}, {"seconds", of_step.seconds}, {"largest_job_mb", of_step.megabytes}};
    if (step.name != std::string("survey")) continue;
    if (steps.failures().size() == steps.number_of_tiles()) {
      for (const std::string& failure : steps.failures()) say(failure);
      folder.give_up(steps);  // to the right paths, if these are wrong
      return unreadable_input;
    }
    try {
      steps.check_triangles();
    } catch (const Argument_out_of_range&) {
      folder.give_up(steps);
      throw;
    }
  }
  report = steps.read_report();
  report["steps"] = std::move(costs);
  return success;
}

/// The path of the report of all tiles; empty if none is asked for.
std::string path_of_report(const Options& options) { return path_for("", options.files.report); }

/// Writes the report and tells of what is odd or failed.
Exit_code tell(const Json& report, const Options& options) {
  if (const std::string path = path_of_report(options); !path.empty()) {
    mesh_files::Output_file file(path);
    file.write(line_of(report));
    file.commit();
  }
  if (const Json& overlaps = report["overlaps"]; !overlaps.empty() && !options.is_quiet) {
    const std::size_t others = overlaps.size() - 1;
    say(overlaps[0][0].get<std::string>() + " and " + overlaps[0][1].get<std::string>() +
        (others > 0 ? " and " + counted(others, "other pair") + " of tiles" : "") +
        " have faces in common: tiles must not overlap, and no segment goes on there");
  } else if (report["turned_sides"].get<std::size_t>() > 0 && !options.is_quiet) {
    say("some tiles are not oriented alike where they meet, and no segment goes on there");
  } else if (report["tiles_apart"].get<bool>() && !options.is_quiet) {
    say("no tile meets another one: the vertices on their borders are not in the same places (see --tolerance)");
  }
  if (const auto components = report.value("unseeded_components", std::size_t(0)); components > 0 && !options.is_quiet)
    say(counted(components, "component") + " without a seed, each a segment of its own");
  for (const Json& failed : report["failed"]) say(failed.get<std::string>());
  if (report["failed"].empty()) return success;
  if (report["failed"].size() == report["tiles"]) return unreadable_input;
  say(std::to_string(report["failed"].size()) + " of " + counted(report["tiles"].get<std::size_t>(), "tile") +
      " could not be read; the others have their segments");
  return some_meshes_failed;
}

}  // namespace

Exit_code run_tiles(std::vector<Task> tiles, const Options& options, Json& report) {
  if (tiles.empty()) throw CLI::RequiredError("a tile");  // of an empty list
  for (Task& tile : tiles) tile.files.report.clear();     // there is one for all tiles
  if (!options.tile_step.empty() && options.tile_folder.empty())
    throw CLI::ValidationError("--tile-step",
                               "it finds what other steps have left in a folder: give --tile-folder, too");
  Work_folder folder(options.tile_folder);
  const Tile_steps steps(tiles, options, folder.path());
  check_outputs(tiles, path_of_report(options), steps, folder.path());
  if (options.tile_step.empty()) {
    check_tiles_are_there(tiles);
    check_folders(tiles, path_of_report(options), steps);
  } else {
    check_step(steps, tiles, folder, options);
  }
  folder.claim(steps.parameters(), steps.files());
  survive_signals(options.tile_step.empty() ? ask_to_end : interrupt);
  if (!options.tile_step.empty()) {
    if (folder.holds_other(seeds_file, steps.seeds_in_words()) ||
        folder.holds_other(parting_file, steps.parting_in_words()) ||
        folder.holds_other(seeding_file, steps.seeding_in_words()))
      throw Argument_out_of_range("--tile-folder " + folder.path() +
                                  " holds the work from other seeds: give another folder, or leave --tile-step out");
    folder.keep(parting_file, steps.parting_in_words());
    folder.keep(seeding_file, steps.seeding_in_words());
    folder.keep(seeds_file, steps.seeds_in_words());
    const Tile_step& step = steps.named(options.tile_step);
    if (step.name == std::string("merge")) forget_steps_after(steps, step);
    const Exit_code code = do_step(steps, step, options.tile.value_or(0), options);
    return code == success && options.tile_step == "report" ? tell(steps.read_report(), options) : code;
  }
  const Exit_code code = do_all_steps(steps, folder, options, report);
  return code == success ? tell(report, options) : code;
}

}  // namespace segment_mesh
