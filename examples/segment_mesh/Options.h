// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_OPTIONS_H
#define SEGMENT_MESH_OPTIONS_H

#include "../mesh_files/Format.h"
#include "Cad_format.h"
#include "Method.h"
#include "Oriented_mesh.h"

#include <RW_segmentation/version.h>

#include <algorithm>
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
  unsound_shape = 8,
  cancelled = 130,  // as shells report a program that Ctrl-C ended
};

/// Whether a pattern stands for another path for each mesh.
inline bool has_placeholder(std::string pattern) {
  for (std::size_t at = 0; (at = pattern.find("%%", at)) != std::string::npos;) pattern.erase(at, 2);
  return pattern.find('%') != std::string::npos || pattern.find("{folder}") != std::string::npos;
}

using mesh_files::Output_format;
using mesh_files::output_format_names;

/// The files that belong to a mesh. Those not asked for are empty.
struct Files {
  std::vector<std::string> outputs;
  std::string seeds, constraints, labels, left_out, split, probabilities, hierarchy, boundaries, html, report;
};

/// A number given to an option that is none of those it takes. The message names the option.
class Argument_out_of_range : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// What the user asks for. What is not given is left to the library's own numbers.
struct Options : Choices {
  std::vector<std::string> meshes;
  std::string list;
  std::optional<mesh_files::Format> format;    ///< of the meshes, whatever their names
  std::optional<Output_format> output_format;  ///< of outputs whose names tell none
  bool resumes = false;
  Repairs repairs;

  std::vector<std::string> seeds;  ///< see `seed_arguments()`
  bool is_engineering = false, is_regular = false;
  std::optional<double> noise;                          ///< standard deviation of the vertices, in the mesh's unit
  std::optional<double> regular_length, regular_angle;  ///< in the mesh's unit, in degrees
  std::optional<double> constraints_angle;              ///< in degrees

  bool is_smooth = false, is_refined = false;
  Files files;       ///< patterns of paths, see `path_for()`
  std::string page;  ///< of `files.html`; empty for the one that comes with the tool
  bool has_point_colors = false;
  bool are_parts_closed = false;       ///< those of `--split` and of 3MF files
  std::optional<Length_unit> unit;     ///< of the mesh's coordinates; without it millimetres
  bool keeps_invalid = false;          ///< whether CAD files are written that fail their checks
  std::optional<double> seconds;       ///< for each mesh
  std::optional<std::uint64_t> bytes;  ///< of memory
  bool is_quiet = false, is_man_page_wanted = false;

  bool is_tiled = false;               ///< the meshes are tiles of one mesh
  std::optional<std::size_t> workers;  ///< processes; without it as many as cores
  std::optional<double> tolerance;     ///< between vertices of tiles that are the same
  std::string tile_folder, tile_step;  ///< for what steps leave; the only step that is done
  std::optional<std::size_t> tile;     ///< of that step

  bool has_cad_files() const {
    return std::any_of(files.outputs.begin(), files.outputs.end(),
                       [](const std::string& path) { return cad_format_of(path).has_value(); });
  }
  bool has_seeds() const { return !seeds.empty() || !files.seeds.empty(); }
  /// Whether fragments are merged, instead of each label of a seed being a segment.
  bool merges() const { return !is_coarse && (!has_seeds() || segments || automatic_seeds); }
  /// How the segments are found, as a page names it.
  const char* mode() const { return !merges() ? "seeds" : is_engineering ? "engineering" : "graphical"; }
  /// Whether meshes are worked through one after the other, so that one that fails does not end the work.
  bool has_several_meshes() const { return meshes.size() > 1 || !list.empty(); }
};

/// What the files of `--split` end with.
inline std::string extension_of_parts(const Options& options) {
  const Output_format format = options.output_format.value_or(Output_format::ply);
  return "." + name_of(output_format_names, format == Output_format::text_stl ? Output_format::stl : format);
}

/// How segments are found: as agrees best with people or as in the paper, and otherwise as asked for.
/// \throws std::invalid_argument if no seeds are asked for
inline Method method_of(const Options& options) { return method_of(options, options.has_seeds() && !options.merges()); }

inline std::string version() {
  return std::to_string(RW_SEGMENTATION_VERSION_MAJOR) + "." + std::to_string(RW_SEGMENTATION_VERSION_MINOR) + "." +
         std::to_string(RW_SEGMENTATION_VERSION_PATCH);
}

}  // namespace segment_mesh

#endif
