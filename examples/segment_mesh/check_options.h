// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_CHECK_OPTIONS_H
#define SEGMENT_MESH_CHECK_OPTIONS_H

// What options cannot have together and what their texts stand for, refused as CLI11 refuses what it does not take.

#include "../mesh_files/Format.h"
#include "../mesh_files/Output_file.h"
#include "../mesh_files/Text.h"
#include "../mesh_files/read_content.h"
#include "Cad_format.h"
#include "Cad_library.h"
#include "Method.h"
#include "Options.h"
#include "seeds.h"

#include <CLI/Error.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace segment_mesh {

/// Refuses what says how segments are found and does not go together.
inline void check_method(const Options& options) {
  const auto refuse = [](bool is_given, const char* option, const std::string& what_to_do) {
    if (is_given) throw CLI::ValidationError(option, what_to_do);
  };
  refuse((options.regular_length || options.regular_angle) && !options.is_regular, "--regular-length, --regular-angle",
         "they tell what is regular: give --regular, too");
  if (options.is_engineering) {
    const auto refuse_beside_surfaces = [&](bool is_given, const std::string& option) {
      refuse(is_given, option.c_str(), "surfaces are found without it: leave out --engineering or " + option);
    };
    refuse_beside_surfaces(options.difference.has_value(), "--difference");
    refuse_beside_surfaces(options.seeding.has_value(), "--seeding");
    refuse_beside_surfaces(options.merge_cost.has_value(), "--merge-cost");
    refuse_beside_surfaces(options.seedings.has_value(), "--seedings");
    refuse_beside_surfaces(options.components.has_value(), "--components");
    refuse_beside_surfaces(options.solver.has_value(), "--solver");
    refuse_beside_surfaces(options.smoothing.has_value(), "--smoothing");
    refuse_beside_surfaces(options.convex_weight.has_value(), "--convex-weight");
    refuse_beside_surfaces(options.measure.has_value(), "--measure");
    refuse_beside_surfaces(options.radius.has_value(), "--radius");
    refuse_beside_surfaces(options.sigma.has_value(), "--sigma");
    refuse_beside_surfaces(options.cap.has_value(), "--cap");
  }
  const bool is_by_curvature = options.difference == Difference::curvature;
  refuse(options.radius && !is_by_curvature, "--radius", "it is that of curvatures: give --difference curvature, too");
  refuse(options.convex_weight && is_by_curvature, "--convex-weight",
         "curvatures have none: leave it out, or give --difference dihedral");
  refuse(options.measure && is_by_curvature, "--measure",
         "curvatures have none: leave it out, or give --difference dihedral");
  refuse(options.seeding && options.is_coarse, "--seeding",
         "--coarse places its seeds by itself: leave one of the two out");
  refuse(options.seeding && !options.merges(), "--seeding",
         "there are no seeds but yours: give --segments or --seeds, too, or no seeds");
  refuse(options.merge_cost && options.is_coarse, "--merge-cost",
         "--coarse merges nothing: give --seeding coarse in its place");
  refuse(options.merge_cost && !options.merges(), "--merge-cost",
         "nothing is merged: give --segments or --seeds, too, or no seeds");
  refuse(options.components && !options.is_coarse && !options.merges(), "--components",
         "there are no seeds but yours: give --segments or --seeds, too, or no seeds");
  refuse(options.seedings && options.is_coarse, "--seedings",
         "--coarse merges nothing: give --seeding coarse in its place");
  refuse(options.seedings && !options.merges(), "--seedings",
         "nothing is merged: give --segments or --seeds, too, or no seeds");
}

/// Whether an output has a name that does not tell what it is.
inline bool tells_no_format(const std::string& path) {
  return mesh_files::extension_of(path).empty() || mesh_files::open_file_of(path);
}

/// The format of a coloured mesh that is written.
/// \throws CLI::ValidationError if neither the path nor an option tells
inline Output_format format_of_output(const std::string& path, const Options& options) {
  const std::string extension = mesh_files::extension_of(path);
  const bool tells_none = tells_no_format(path);
  if (tells_none && options.output_format) return *options.output_format;
  if (extension == ".stl" && options.output_format == Output_format::text_stl) return Output_format::text_stl;
  std::string known;
  for (const auto& [name, format] : output_format_names) {
    if (extension == "." + name) return format;
    if (format != Output_format::text_stl) known += (known.empty() ? "." : ", .") + name;
  }
  for (const auto& [name, format] : cad_extensions) known += ", " + name;
  throw CLI::ValidationError("--output",
                             path + " is none of " + known + (tells_none ? ": give --output-format, too" : ""));
}

/// Refuses CAD files that cannot be made.
inline void check_cad_files(const Options& options) {
  if (!options.has_cad_files()) {
    if (options.unit) throw CLI::ValidationError("--unit", "only CAD files have one: give --output part.step, too");
    if (options.keeps_invalid)
      throw CLI::ValidationError("--keep-invalid", "only CAD files are checked: give --output part.step, too");
    return;
  }
  if (!writes_cad_files)
    throw CLI::ValidationError("--output",
                               "CAD files need Open CASCADE, which this program was built without: install it "
                               "(Debian: libocct-data-exchange-dev) and build segment_mesh again");
  if (!options.is_engineering)
    throw CLI::ValidationError("--output", "the faces of CAD files lie on surfaces: give --engineering, too");
  try {
    cad_library();
  } catch (const std::runtime_error& error) {
    throw CLI::ValidationError("--output",
                               "CAD files need a library that cannot be loaded: " + std::string(error.what()));
  }
}

/// Refuses what tiles cannot have, and what only they can.
inline void check_tiles(const Options& options) {
  const auto refuse = [&](bool is_given, const char* option, const char* reason) {
    if (is_given) throw CLI::ValidationError(option, reason);
  };
  if (!options.is_tiled) {
    constexpr const char* reason = "it is for tiles of one mesh: give --tiled, too";
    refuse(options.workers.has_value(), "--workers", reason);
    refuse(options.tolerance.has_value(), "--tolerance", reason);
    refuse(!options.tile_folder.empty(), "--tile-folder", reason);
    refuse(!options.tile_step.empty(), "--tile-step", reason);
    refuse(options.tile.has_value(), "--tile", reason);
    return;
  }
  constexpr const char* reason = "tiles are segmented without it: leave it or --tiled out";
  const Files& files = options.files;
  refuse(options.has_seeds() && options.merges(), "--seed",
         "of tiles each label is a segment: leave --segments and --seeds out");
  refuse(has_placeholder(files.seeds), "--seeds-file", "seeds are those of all tiles: leave the % out");
  refuse(!files.probabilities.empty(), "--probabilities", reason);
  refuse(options.has_cad_files(), "--output", "CAD files are made of whole meshes: leave them or --tiled out");
  refuse(options.is_coarse, "--coarse", reason);
  refuse(options.is_paper, "--paper", reason);
  refuse(options.seeding.has_value(), "--seeding", reason);
  refuse(options.merge_cost.has_value(), "--merge-cost", reason);
  refuse(options.seedings.has_value(), "--seedings", reason);
  refuse(options.difference.has_value(), "--difference", reason);
  refuse(options.convex_weight.has_value(), "--convex-weight", reason);
  refuse(options.measure.has_value(), "--measure", reason);
  refuse(options.sigma.has_value(), "--sigma", reason);
  refuse(options.cap.has_value(), "--cap", reason);
  refuse(options.solver.has_value(), "--solver", reason);
  refuse(!files.constraints.empty() && !has_placeholder(files.constraints), "--constraints",
         "vertices have numbers in the file of each tile: give a file for each, with a % for its name");
  refuse(options.are_parts_closed, "--cap-parts", reason);
  refuse(!files.hierarchy.empty(), "--hierarchy", reason);
  refuse(!files.html.empty(), "--html", reason);
  refuse(options.seconds.has_value(), "--time-limit", reason);
  refuse(std::find(options.meshes.begin(), options.meshes.end(), mesh_files::standard_input) != options.meshes.end(),
         "--tiled", "tiles are read more than once, which standard input cannot be");
  refuse(options.resumes, "--resume", "give --tile-folder in its place: what is in it is not done again");
  refuse(has_placeholder(files.report), "--report", "there is one report of all tiles: leave the % out");
}

/// Refuses options that do not go together.
inline void check_combinations(const Options& options) {
  const Files& files = options.files;
  check_tiles(options);
  check_method(options);
  if (options.merges() && !files.probabilities.empty())
    throw CLI::ValidationError("--probabilities", "only segments of seeds have them: give --seed or --coarse alone");
  if (!options.merges() && !files.hierarchy.empty())
    throw CLI::ValidationError("--hierarchy", "seeds make no hierarchy: give no seeds, or --segments or --seeds, too");
  if (options.is_smooth && !options.is_refined && files.boundaries.empty())
    throw CLI::ValidationError("--smooth", "nothing would show it: give --refine or --boundaries, too");
  if (!options.page.empty() && files.html.empty())
    throw CLI::ValidationError("--page", "nothing would be written to it: give --html, too");
  check_cad_files(options);
  for (const std::string& path : files.outputs)
    if (!cad_format_of(path)) format_of_output(path, options);
  const auto has_output = [&](const auto& is_wanted) {
    return std::any_of(files.outputs.begin(), files.outputs.end(), [&](const std::string& path) {
      return !cad_format_of(path) && is_wanted(path, format_of_output(path, options));
    });
  };
  if (options.are_parts_closed && files.split.empty() &&
      !has_output([](const std::string&, Output_format format) { return format == Output_format::three_mf; }))
    throw CLI::ValidationError("--cap-parts", "there are no parts: give --split or an --output .3mf, too");
  if (options.has_point_colors) {
    const auto has_points = [](Output_format format) {
      return format == Output_format::ply || format == Output_format::off || format == Output_format::obj;
    };
    if (!has_output([&](const std::string&, Output_format format) { return has_points(format); }) &&
        (files.split.empty() || !has_points(options.output_format.value_or(Output_format::ply))))
      throw CLI::ValidationError("--point-colors",
                                 "only .ply, .off and .obj have them: give such an --output, or leave it out");
  }
  const bool takes_format = !files.split.empty() || has_output([](const std::string& path, Output_format format) {
    return format == Output_format::text_stl || tells_no_format(path);
  });
  if (options.output_format && !takes_format)
    throw CLI::ValidationError("--output-format", "the name of each --output tells its format: leave it out");
  if (!files.split.empty() && options.output_format == Output_format::obj)
    throw CLI::ValidationError("--output-format", "parts of --split are no OBJ files, which need others beside them");
  if (has_output([](const std::string& path, Output_format format) {
        return format == Output_format::obj && tells_no_format(path);
      }))
    throw CLI::ValidationError("--output-format",
                               "OBJ files need others beside them: give --output a name that ends with .obj");
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
