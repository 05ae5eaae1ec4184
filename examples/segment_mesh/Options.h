#ifndef SEGMENT_MESH_OPTIONS_H
#define SEGMENT_MESH_OPTIONS_H

#include "../mesh_files.h"
#include "Oriented_mesh.h"
#include "seeds.h"

#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/version.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
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
  cancelled = 130,  // as shells report a program that Ctrl-C ended
};

/// What the user asks for. What is not given is left to the library's own numbers.
struct Options {
  std::string mesh;
  Repairs repairs;

  std::vector<std::string> seeds;  ///< see `seed_argument()`
  std::string seeds_file;
  std::optional<std::size_t> segments, automatic_seeds;
  bool is_coarse = false, is_paper = false, is_engineering = false;

  std::optional<double> smoothing, convex_weight, sigma, cap;
  std::optional<RW_segmentation::Dihedral_measure> measure;

  bool is_smooth = false, is_refined = false;
  std::vector<std::string> outputs;
  std::string split, labels, probabilities, hierarchy, boundaries, report;
  bool is_quiet = false;

  bool has_seeds() const { return !seeds.empty() || !seeds_file.empty(); }
  /// Whether fragments are merged, instead of each label of a seed being a segment.
  bool merges() const { return !is_coarse && (!has_seeds() || segments || automatic_seeds); }
};

/// Refuses outputs of unknown kind, and paths that would overwrite each other or the input.
inline void check_paths(const Options& options) {
  std::set<std::string> taken = {std::filesystem::weakly_canonical(options.mesh).string()};
  const auto take = [&](const char* option, const std::string& path) {
    if (!path.empty() && !taken.insert(std::filesystem::weakly_canonical(path).string()).second)
      throw CLI::ValidationError(option, path + " is the input or another output");
  };
  for (const std::string& path : options.outputs) {
    const std::string extension = mesh_files::extension_of(path);
    if (extension != ".ply" && extension != ".off")
      throw CLI::ValidationError("--output", path + " is neither .ply nor .off");
    take("--output", path);
  }
  take("--labels", options.labels);
  take("--probabilities", options.probabilities);
  take("--hierarchy", options.hierarchy);
  take("--boundaries", options.boundaries);
  take("--report", options.report);
}

/// Refuses options that do not go together.
inline void check_combinations(const Options& options) {
  if (options.merges() && !options.probabilities.empty())
    throw CLI::ValidationError("--probabilities", "only segments of seeds have them: give --seed or --coarse alone");
  if (!options.merges() && !options.hierarchy.empty())
    throw CLI::ValidationError("--hierarchy", "seeds make no hierarchy: give no seeds, or --segments or --seeds, too");
  if (options.is_smooth && !options.is_refined && options.boundaries.empty())
    throw CLI::ValidationError("--smooth", "nothing would show it: give --refine or --boundaries, too");
}

inline std::string version() {
  return std::to_string(RW_SEGMENTATION_VERSION_MAJOR) + "." + std::to_string(RW_SEGMENTATION_VERSION_MINOR) + "." +
         std::to_string(RW_SEGMENTATION_VERSION_PATCH);
}

/// Makes the command line that fills the options.
inline void define_command_line(CLI::App& app, Options& options) {
  app.description("Cuts a surface mesh into segments by random walks: from seeds that you give, or all by itself.");
  app.set_version_flag("--version", "segment_mesh " + version());
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("segment_mesh: ") + error.what() + " (see segment_mesh --help)\n";
  });
  app.footer(
      "Faces are numbered from 0 in the order of the file, and every output keeps this order. Faces that a repair\n"
      "leaves out get the label of the closest face; with --refine, the mesh is written without them. Without an\n"
      "output, the segments are only listed.\n"
      "\n"
      "Exit codes: 0 success, 1 wrong usage, 2 unreadable input, 3 argument out of range, 4 failed computation,\n"
      "5 output that cannot be written, 130 cancelled. Outputs are written whole or not at all.\n"
      "\n"
      "Examples:\n"
      "  segment_mesh hand.off --output hand.ply\n"
      "  segment_mesh hand.off --segments 6 --split fingers\n"
      "  segment_mesh part.stl --engineering --output part.ply --report part.json\n"
      "  segment_mesh hand.off --seed 120 --seed 2303 --seed 77 --output hand.ply\n"
      "  segment_mesh part.stl --seed 0.1,2,3=5 --seed 812=5 --seed 44=9 --labels part.seg\n");

  app.add_option("mesh", options.mesh, "The mesh: OFF, PLY, OBJ or STL")->required()->option_text("MESH");

  auto* seed =
      app.add_option("--seed", options.seeds,
                     "A seed: the number of a face, or a point for the closest face. Repeatable. Seeds get the labels\n"
                     "0, 1, ... in their order, or the one after \"=\"; several seeds may share a label.")
          ->allow_extra_args(false)
          ->option_text("FACE|X,Y,Z[=LABEL]")
          ->group("Segments of your seeds");
  auto* seeds_file =
      app.add_option("--seeds-file", options.seeds_file, "A file with one seed a line; # starts a comment")
          ->option_text("FILE")
          ->group("Segments of your seeds");

  app.add_option("--segments", options.segments, "How many segments; without it as many as the shape suggests")
      ->check(CLI::NonNegativeNumber)
      ->option_text("N")
      ->group("Automatic segments");
  auto* automatic_seeds =
      app.add_option("--seeds", options.automatic_seeds,
                     "How many automatic seeds make the fragments that are merged (40; more for many --segments).\n"
                     "Seeds of your own make further fragments.")
          ->check(CLI::NonNegativeNumber)
          ->option_text("N")
          ->group("Automatic segments");
  auto* coarse =
      app.add_flag("--coarse", options.is_coarse, "A few seeds far apart, each a segment, instead of merged fragments")
          ->excludes(seed)
          ->excludes(seeds_file)
          ->excludes(automatic_seeds)
          ->group("Automatic segments");
  auto* paper =
      app.add_flag("--paper", options.is_paper, "The numbers of the paper instead of those that agree best with people")
          ->group("Automatic segments");
  app.add_flag("--engineering", options.is_engineering,
               "For parts of machines: each segment is a plane, sphere, cylinder, cone or torus, or a free form;\n"
               "--report tells which")
      ->excludes(seed)
      ->excludes(seeds_file)
      ->excludes(automatic_seeds)
      ->excludes(coarse)
      ->excludes(paper)
      ->group("Automatic segments");

  app.add_option("--convex-weight", options.convex_weight,
                 "How much convex creases count beside concave ones, 0 to 1: 0 for automatic segments and\n"
                 "0.02 for seeds suit natural shapes; 1 with --smoothing 0 suits parts of machines")
      ->option_text("NUMBER")
      ->group("Difference of faces");
  app.add_option("--measure", options.measure, "What is taken of the angle between faces: itself, or 1 - cosine")
      ->transform(CLI::CheckedTransformer(std::map<std::string, RW_segmentation::Dihedral_measure>{
          {"angle", RW_segmentation::Dihedral_measure::angle},
          {"cosine", RW_segmentation::Dihedral_measure::one_minus_cosine}}))
      ->option_text("angle|cosine")
      ->group("Difference of faces");
  app.add_option("--smoothing", options.smoothing,
                 "Smoothing length of the normals as a part of the square root of the area; 0 smooths nothing")
      ->option_text("NUMBER")
      ->group("Difference of faces");
  app.add_option("--sigma", options.sigma, "The difference that stops a walk; 1 is an average edge")
      ->option_text("NUMBER")
      ->group("Walk");
  app.add_option("--cap", options.cap, "The largest difference / sigma that counts, or inf")
      ->option_text("NUMBER")
      ->group("Walk");

  app.add_flag("--smooth", options.is_smooth, "Smooth the boundaries between segments; they keep to creases")
      ->group("Boundaries");
  app.add_flag("--refine", options.is_refined,
               "Cut the smooth boundaries into the mesh that is written; all faces must be triangles. The first faces\n"
               "are those of the mesh, or what is left of them, and new ones follow.")
      ->group("Boundaries");
  app.add_option("--boundaries", options.boundaries, "The boundaries as polylines, an OBJ file")
      ->option_text("FILE")
      ->group("Boundaries");

  app.add_flag_callback(
         "--no-stitch", [&] { options.repairs.stitch = false; }, "Leave borders apart that coincide")
      ->group("Repair");
  app.add_flag_callback(
         "--keep-orientation", [&] { options.repairs.orient = false; },
         "Leave closed parts inside out (convex and concave change places)")
      ->group("Repair");

  app.add_option("-o,--output", options.outputs,
                 "The coloured mesh, .ply or .off. Repeatable. A PLY file also holds the labels (\"segment\").")
      ->allow_extra_args(false)
      ->option_text("FILE")
      ->group("Output");
  app.add_option("--labels", options.labels, "One label a line for each face")->option_text("FILE")->group("Output");
  app.add_option("--split", options.split, "One mesh for each segment, in a new or empty folder: segment_LABEL.ply")
      ->option_text("FOLDER")
      ->group("Output");
  app.add_option("--probabilities", options.probabilities,
                 "One line for each face, one column for each label; the first line names the labels")
      ->option_text("FILE")
      ->group("Output");
  app.add_option("--hierarchy", options.hierarchy, "All merges, as JSON: any number of segments can be read off")
      ->option_text("FILE")
      ->group("Output");
  app.add_option("--report", options.report, "What was done, as one line of JSON")
      ->option_text("FILE")
      ->group("Output");
  app.add_flag("-q,--quiet", options.is_quiet, "Print nothing but errors")->group("Output");
}

/// The seeds of the command line, then those of the file.
/// \throws CLI::ValidationError, mesh_files::Unreadable_file
inline std::vector<Seed_argument> seed_arguments(const Options& options) {
  std::vector<Seed_argument> seeds;
  for (const std::string& text : options.seeds) {
    try {
      seeds.push_back(seed_argument(text));
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError("--seed", error.what());
    }
  }
  if (!options.seeds_file.empty())
    for (const Seed_argument& seed : read_seeds(options.seeds_file)) seeds.push_back(seed);
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
