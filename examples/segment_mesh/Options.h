#ifndef SEGMENT_MESH_OPTIONS_H
#define SEGMENT_MESH_OPTIONS_H

#include "../mesh_files.h"
#include "Oriented_mesh.h"
#include "seeds.h"

#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/version.h>
#include <CLI/CLI.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace segment_mesh {

/// What the tool returns to the shell.
enum Exit_code {
  success = 0,
  wrong_usage = 1,
  unreadable_input = 2,
  wrong_argument = 3,
  failed_computation = 4,
  unwritable_output = 5,
  some_meshes_failed = 6,
  reached_limit = 7,
  cancelled = 130,  // as shells report a program that Ctrl-C ended
};

/// The files that belong to a mesh. Those not asked for are empty.
struct Files {
  std::vector<std::string> outputs;
  std::string seeds, labels, split, probabilities, hierarchy, boundaries, html, report;
};

/// What the user asks for. What is not given is left to the library's own numbers.
struct Options {
  std::vector<std::string> meshes;
  std::string list;
  bool resumes = false;
  Repairs repairs;

  std::vector<std::string> seeds;  ///< see `seed_argument()`
  std::optional<std::size_t> segments, automatic_seeds;
  bool is_coarse = false, is_paper = false, is_engineering = false;

  std::optional<double> smoothing, convex_weight, sigma, cap;
  std::optional<RW_segmentation::Dihedral_measure> measure;

  bool is_smooth = false, is_refined = false;
  Files files;       ///< a `%` in a path stands for the name of the mesh
  std::string page;  ///< of `files.html`; empty for the one that comes with the tool
  bool has_point_colors = false;
  std::optional<double> seconds;       ///< for each mesh
  std::optional<std::uint64_t> bytes;  ///< of memory
  bool is_quiet = false, is_man_page_wanted = false;

  bool has_seeds() const { return !seeds.empty() || !files.seeds.empty(); }
  /// Whether fragments are merged, instead of each label of a seed being a segment.
  bool merges() const { return !is_coarse && (!has_seeds() || segments || automatic_seeds); }
  /// How the segments are found, as a page names it.
  const char* mode() const { return !merges() ? "seeds" : is_engineering ? "engineering" : "graphical"; }
  /// Whether meshes are worked through one after the other, so that one that fails does not end the work.
  bool has_several_meshes() const { return meshes.size() > 1 || !list.empty(); }
  /// The path of the report with a line for each of several meshes; none where each mesh has a report of its own.
  std::string journal() const {
    return has_several_meshes() && files.report.find('%') == std::string::npos ? files.report : std::string();
  }
};

/// Refuses options that do not go together.
inline void check_combinations(const Options& options) {
  const Files& files = options.files;
  if (options.merges() && !files.probabilities.empty())
    throw CLI::ValidationError("--probabilities", "only segments of seeds have them: give --seed or --coarse alone");
  if (!options.merges() && !files.hierarchy.empty())
    throw CLI::ValidationError("--hierarchy", "seeds make no hierarchy: give no seeds, or --segments or --seeds, too");
  if (options.is_smooth && !options.is_refined && files.boundaries.empty())
    throw CLI::ValidationError("--smooth", "nothing would show it: give --refine or --boundaries, too");
  if (!options.page.empty() && files.html.empty())
    throw CLI::ValidationError("--page", "nothing would be written to it: give --html, too");
  if (options.seconds && !(*options.seconds > 0))
    throw CLI::ValidationError("--time-limit", "the number of seconds must be positive");
  for (const std::string& path : files.outputs) {
    const std::string extension = mesh_files::extension_of(path);
    if (extension != ".ply" && extension != ".off" && extension != ".obj")
      throw CLI::ValidationError("--output", path + " is neither .ply nor .off nor .obj");
  }
}

inline std::string version() {
  return std::to_string(RW_SEGMENTATION_VERSION_MAJOR) + "." + std::to_string(RW_SEGMENTATION_VERSION_MINOR) + "." +
         std::to_string(RW_SEGMENTATION_VERSION_PATCH);
}

/// The seeds of the command line, then those of a file if there is one.
/// \throws CLI::ValidationError, mesh_files::Unreadable_file
inline std::vector<Seed_argument> seed_arguments(const Options& options, const std::string& seeds_file) {
  std::vector<Seed_argument> seeds;
  for (const std::string& text : options.seeds) {
    try {
      seeds.push_back(seed_argument(text));
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError("--seed", error.what());
    }
  }
  if (!seeds_file.empty())
    for (const Seed_argument& seed : read_seeds(seeds_file)) seeds.push_back(seed);
  if (options.merges())
    for (const Seed_argument& seed : seeds)
      if (seed.label)
        throw CLI::ValidationError(
            "--seed", mesh_files::printable(seed.text) + ": labels have no meaning where fragments are merged");
  complete_labels(seeds);
  return seeds;
}

}  // namespace segment_mesh

#endif
