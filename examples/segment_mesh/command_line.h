// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_COMMAND_LINE_H
#define SEGMENT_MESH_COMMAND_LINE_H

#include "Method.h"
#include "Options.h"
#include "help_sections.h"

#include <CLI/CLI.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

namespace segment_mesh {

/// The formats of meshes, as their files end.
inline const Names<mesh_files::Format> format_names = {
    {"off", mesh_files::Format::off}, {"ply", mesh_files::Format::ply},     {"obj", mesh_files::Format::obj},
    {"stl", mesh_files::Format::stl}, {"msh", mesh_files::Format::msh},     {"mesh", mesh_files::Format::medit},
    {"vtp", mesh_files::Format::vtp}, {"3mf", mesh_files::Format::three_mf}};

/// Adds an option with a few named choices.
template <class Choice>
void add_choice(CLI::App& app, const std::string& option, std::optional<Choice>& chosen, const Names<Choice>& names,
                const std::string& description, const std::string& group) {
  const auto choose = [option, &chosen, &names](const std::string& name) {
    try {
      chosen = choice_of(names, name);
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError(option, error.what());
    }
  };
  app.add_option_function<std::string>(option, choose, description)->option_text(listed(names, "|"))->group(group);
}

/// The numbers that an option takes.
template <class Number>
struct Range {
  const char* words;
  bool (*holds)(Number);
};

constexpr Range<std::size_t> counts = {"a whole number from 1 to 4294967294",
                                       [](std::size_t n) { return n >= 1 && n <= 4294967294; }};
constexpr Range<std::size_t> places = {"a whole number from 0 to 4294967293",
                                       [](std::size_t n) { return n <= 4294967293; }};
constexpr Range<double> weights = {"from 0 to 1", [](double x) { return x >= 0 && x <= 1; }};
constexpr Range<double> finite_lengths = {"0 or larger, and finite",
                                          [](double x) { return x >= 0 && x <= std::numeric_limits<double>::max(); }};
constexpr Range<double> finite_positive = {"larger than 0 and finite",
                                           [](double x) { return x > 0 && x <= std::numeric_limits<double>::max(); }};
constexpr Range<double> positive = {"larger than 0; inf is allowed", [](double x) { return x > 0; }};
constexpr Range<double> angles = {"an angle in degrees between 0 and 180", [](double x) { return x > 0 && x < 180; }};
constexpr Range<double> small_angles = {"an angle from 0 to 45 degrees", [](double x) { return x >= 0 && x <= 45; }};

/// Adds an option that takes a number.
/// \tparam Error thrown for a number out of the range; what is no number is wrong usage
template <class Error = Argument_out_of_range, class Number>
CLI::Option* add_number(CLI::App& app, const std::string& option, std::optional<Number>& value,
                        const Range<Number>& range, const std::string& description) {
  const auto read = [option, &value, range](const std::string& text) {
    const std::string message = option + " is " + mesh_files::printable(text) + ", but must be " + range.words;
    value = mesh_files::number_in<Number>(text);
    if (!value) throw CLI::ValidationError(message);
    if (!range.holds(*value)) throw Error(message);
  };
  return app.add_option_function<std::string>(option, read, description);
}

/// Makes the command line that fills the options.
inline void define_command_line(CLI::App& app, Options& options) {
  app.description(summary);
  app.set_version_flag("--version", "segment_mesh " + version());
  app.add_flag("--man", options.is_man_page_wanted, "Print the manual page and exit: segment_mesh --man | man -l -");
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("segment_mesh: ") + error.what() + " (see segment_mesh --help)\n";
  });
  std::string footer;
  for (const auto& [title, text, is_preformatted] : help_sections) footer += std::string(title) + ":\n" + text + "\n";
  app.footer(footer);

  app.add_option(
         "mesh", options.meshes,
         "The mesh, or several: OFF, PLY, OBJ, STL, 3MF, Gmsh, Medit or VTP, also packed by gzip; glTF, COLLADA, FBX\n"
         "and others where Assimp is compiled in; - is standard input")
      ->option_text("MESH ...");
  add_choice(app, "--format", options.format, format_names,
             "What the meshes are, whatever their names and first bytes tell", "Input");
  app.add_option("--list", options.list,
                 "A file with the path of one mesh a line; - is standard input, and lines with # are comments")
      ->option_text("FILE")
      ->group("Several meshes");
  app.add_flag("--resume", options.resumes, "Pass over meshes whose outputs are there already")
      ->group("Several meshes");

  app.add_flag("--tiled", options.is_tiled,
               "The meshes are tiles of one mesh, which meet where vertices on their borders are in the same place.\n"
               "Segments go on from tile to tile, and their labels mean the same in all of them.")
      ->group("Tiles of one mesh");
  add_number(app, "--workers", options.workers, counts, "How many tiles are worked on at the same time (all cores)")
      ->option_text("N")
      ->group("Tiles of one mesh");
  add_number(app, "--tolerance", options.tolerance, finite_lengths,
             "How far apart the same vertex may be in two tiles, in the unit of the coordinates (0)")
      ->option_text("LENGTH")
      ->group("Tiles of one mesh");
  app.add_option(
         "--tile-folder", options.tile_folder,
         "Where steps leave what later ones need, some 150 bytes a face. It stays: run again, only what is not\n"
         "there is done; other seeds, or another --segments, take the last steps alone. (A temporary folder)")
      ->option_text("FOLDER")
      ->group("Tiles of one mesh");
  app.add_option("--tile-step", options.tile_step,
                 "Do one step only, for schedulers of many machines: survey, border, shape, places, clusters,\n"
                 "fragments and labels of one tile, plan, noise, seeds, walk, merge and report of all. With\n"
                 "--engineering surfaces of one tile take the place of shape to fragments. Smooth boundaries take\n"
                 "strips and crossings of one tile, after merge.")
      ->option_text("STEP")
      ->group("Tiles of one mesh");
  add_number(app, "--tile", options.tile, places, "The tile of that step, numbered from 0 in the order of the meshes")
      ->option_text("N")
      ->group("Tiles of one mesh");

  auto* seed =
      app.add_option("--seed", options.seeds,
                     "A seed: the number of a face, or a point for the closest face. Repeatable. Seeds get the labels\n"
                     "0, 1, ... in their order, or the one after \"=\"; several seeds may share a label.")
          ->allow_extra_args(false)
          ->option_text("FACE|X,Y,Z[=LABEL]")
          ->group("Segments of your seeds");
  auto* seeds_file =
      app.add_option("--seeds-file", options.files.seeds, "A file with one seed a line; # starts a comment")
          ->option_text("FILE")
          ->group("Segments of your seeds");

  add_number(app, "--segments", options.segments, counts, "How many segments; without it as many as the shape suggests")
      ->option_text("N")
      ->group("Automatic segments");
  auto* automatic_seeds =
      add_number(app, "--seeds", options.automatic_seeds, counts,
                 "How many automatic seeds make the fragments that are merged (40 for each connected component; more\n"
                 "for many --segments). "
                 "Seeds of your own make further fragments.")
          ->option_text("N")
          ->group("Automatic segments");
  auto* coarse =
      app.add_flag("--coarse", options.is_coarse, "A few seeds far apart, each a segment, instead of merged fragments")
          ->excludes(seed)
          ->excludes(seeds_file)
          ->excludes(automatic_seeds)
          ->group("Automatic segments");
  auto* paper =
      app.add_flag("--paper", options.is_paper,
                   "What the paper uses instead of what agrees best with people: --difference dihedral --smoothing 0\n"
                   "--seeding particles --merge-cost boundary, and 60 seeds")
          ->group("Automatic segments");
  add_number(app, "--seedings", options.seedings, counts,
             "How many times seeds are placed, to merge by what all agree on (2; 1 with another --seeding or\n"
             "--merge-cost)")
      ->option_text("N")
      ->group("Automatic segments");
  add_choice(app, "--components", options.components, components_names,
             "What tells how large parts are, and has so many seeds: each connected component by itself (default),\n"
             "though one of less than a hundredth of the largest one's area is one segment, or the whole mesh\n"
             "(default with another --seeding)",
             "Automatic segments");
  add_choice(app, "--seeding", options.seeding, seeding_names,
             "Where automatic seeds are placed: far apart (default), as evenly as particles that repel each other,\n"
             "or one on each large structure, as many as there are unless --seeds tells",
             "Automatic segments");
  add_choice(app, "--merge-cost", options.merge_cost, merge_cost_names,
             "Which fragments are merged first: small ones, those as thick as each other, and those that people would\n"
             "have in one segment (default); the same but for what was learned from people; or those with the\n"
             "weakest boundary, as in the paper",
             "Automatic segments");
  app.add_flag("--engineering", options.is_engineering,
               "For parts of machines: each segment is a plane, sphere, cylinder, cone or torus, or a free form;\n"
               "--report tells which")
      ->excludes(seed)
      ->excludes(seeds_file)
      ->excludes(automatic_seeds)
      ->excludes(coarse)
      ->excludes(paper)
      ->group("Automatic segments");
  add_number<CLI::ValidationError>(
      app, "--noise", options.noise, finite_lengths,
      "How far vertices are off their surfaces for --engineering: their standard deviation, in the mesh's unit,\n"
      "instead of an estimate; --report tells what was reckoned with")
      ->option_text("LENGTH")
      ->needs("--engineering")
      ->group("Automatic segments");
  app.add_flag(
         "--regular", options.is_regular,
         "Makes surfaces that are nearly parallel, perpendicular, coplanar, coaxial or equal in their radii exactly\n"
         "that, within three standard errors or the tolerances below; --report has each change")
      ->needs("--engineering")
      ->group("Automatic segments");
  add_number<CLI::ValidationError>(
      app, "--regular-length", options.regular_length, finite_lengths,
      "What positions and radii may differ by for --regular, in the mesh's unit, instead of standard errors")
      ->option_text("LENGTH")
      ->group("Automatic segments");
  add_number<CLI::ValidationError>(
      app, "--regular-angle", options.regular_angle, small_angles,
      "What directions may differ by for --regular, in degrees, instead of standard errors")
      ->option_text("DEGREES")
      ->group("Automatic segments");

  add_choice(app, "--difference", options.difference, difference_names,
             "What makes neighbouring faces differ: the angle between them as in the paper, its concavity (default),\n"
             "which counts convex creases less, or not at all, or the difference of curvatures, for parts of machines",
             "Difference of faces");
  add_number(app, "--convex-weight", options.convex_weight, weights,
             "How much convex creases count beside concave ones, 0 to 1: 0 for automatic segments and\n"
             "0.02 for seeds suit natural shapes; 1 with --smoothing 0 suits parts of machines")
      ->option_text("NUMBER")
      ->group("Difference of faces");
  add_choice(app, "--measure", options.measure, measure_names,
             "What is taken of the angle between faces: itself, or 1 - cosine", "Difference of faces");
  add_number(app, "--radius", options.radius, finite_positive,
             "Of the balls in which curvatures are measured, in mean edge lengths (3)")
      ->option_text("NUMBER")
      ->group("Difference of faces");
  add_number(app, "--smoothing", options.smoothing, finite_lengths,
             "Smoothing length of the normals as a part of the square root of the area; 0 smooths nothing")
      ->option_text("NUMBER")
      ->group("Difference of faces");
  add_number(app, "--sigma", options.sigma, finite_positive, "The difference that stops a walk; 1 is an average edge")
      ->option_text("NUMBER")
      ->group("Walk");
  add_number(app, "--cap", options.cap, positive,
             "The largest difference / sigma that counts, or inf; what closes parts is --cap-parts")
      ->option_text("NUMBER")
      ->group("Walk");

  add_choice(app, "--solver", options.solver, solver_names,
             "What computes the walk: the library's own elimination (default), or Eigen's Cholesky factorisation",
             "Walk");

  app.add_option(
         "--constraints", options.files.constraints,
         "A file of edges that are walls, which no walk, merge or surface crosses: two vertices a line, by their\n"
         "numbers in the file of the mesh, from 0; # starts a comment. After a repair they stand for all edges\n"
         "between the places of the two. With --tiled, each tile has a file: give a % in the path.")
      ->option_text("FILE")
      ->group("Walls");
  add_number<CLI::ValidationError>(app, "--constraints-angle", options.constraints_angle, angles,
                                   "Edges are walls, too, over which the surface turns by more than this angle")
      ->option_text("DEGREES")
      ->group("Walls");

  app.add_flag("--smooth", options.is_smooth, "Smooth the boundaries between segments; they keep to creases")
      ->group("Boundaries");
  app.add_flag(
         "--refine", options.is_refined,
         "Cut the smooth boundaries into the mesh that is written, and its polygons into triangles for that. The\n"
         "first faces are those of the mesh, or what is left of them, and new ones follow.")
      ->group("Boundaries");
  app.add_option("--boundaries", options.files.boundaries, "The boundaries as polylines, an OBJ file")
      ->option_text("FILE")
      ->group("Boundaries");

  app.add_flag_callback(
         "--no-stitch", [&] { options.repairs.stitch = false; }, "Leave borders apart that coincide")
      ->group("Repair");
  app.add_flag_callback(
         "--keep-orientation", [&] { options.repairs.orient = false; },
         "Leave closed parts inside out (convex and concave change places)")
      ->group("Repair");

  app.add_option(
         "-o,--output", options.files.outputs,
         "The coloured mesh, as the name ends. .ply and .vtp hold the labels (\"segment\"), .off colours; .obj (with "
         "a\n"
         "file .mtl beside it) and .glb have a group or primitive and a material for each segment, .3mf an object,\n"
         ".msh a physical group, .mesh references, and .stl colours of facets. With --engineering, .step, .iges and\n"
         ".brep are solids for CAD systems, whose faces lie on the surfaces found. Repeatable.")
      ->allow_extra_args(false)
      ->option_text("FILE")
      ->group("Output");
  add_choice(
      app, "--output-format", options.output_format, output_format_names,
      "What an --output is whose name does not tell, such as /dev/stdout, and the parts of --split (PLY). stl-text\n"
      "makes files .stl texts, with a solid for each segment.",
      "Output");
  const auto choose_unit = [&](const std::string& name) {
    for (const Length_unit& unit : length_units)
      if (name == unit.name) options.unit = unit;
    if (!options.unit) throw CLI::ValidationError("--unit", name + " is none of mm, cm, m, inch, ft");
  };
  app.add_option_function<std::string>("--unit", choose_unit, "The unit of the coordinates, for CAD files (mm)")
      ->option_text("mm|cm|m|inch|ft")
      ->group("Output");
  app.add_flag("--keep-invalid", options.keeps_invalid,
               "Write CAD files that fail their checks, too; the exit code tells")
      ->group("Output");
  app.add_flag("--point-colors", options.has_point_colors,
               "Colour points instead of faces in .ply, .off and .obj, for viewers that do not show colours of faces.\n"
               "Points between segments are written once for each segment.")
      ->group("Output");
  app.add_option("--labels", options.files.labels, "One label a line for each face; or NumPy's .npz, or .csv")
      ->option_text("FILE")
      ->group("Output");
  app.add_option("--left-out", options.files.left_out,
                 "The faces of the file that are no part of the surface, one number a line, from 0")
      ->option_text("FILE")
      ->group("Output");
  app.add_option("--split", options.files.split,
                 "One mesh for each segment, in a new or empty folder: segment_LABEL.ply, or as --output-format tells")
      ->option_text("FOLDER")
      ->group("Output");
  app.add_flag(
         "--cap-parts", options.are_parts_closed,
         "Close the parts of --split, and the objects of .3mf files, where they were cut from each other, so that\n"
         "they are solids. They are parts of the mesh after repair; --report tells their volumes.")
      ->group("Output");
  app.add_option("--probabilities", options.files.probabilities,
                 "One line for each face, one column for each label; the first line names the labels; or .npz, or .csv")
      ->option_text("FILE")
      ->group("Output");
  app.add_option("--hierarchy", options.files.hierarchy, "All merges, as JSON: any number of segments can be read off")
      ->option_text("FILE")
      ->group("Output");
  app.add_option("--html", options.files.html,
                 "A page to look at the segments in a browser, and to change them: one file that needs nothing else")
      ->option_text("FILE")
      ->group("Output");
  app.add_option("--page", options.page, "The page that --html fills in, instead of the one that comes with the tool")
      ->option_text("FILE")
      ->group("Output");
  app.add_option("--report", options.files.report, "What was done, as one line of JSON for each mesh")
      ->option_text("FILE")
      ->group("Output");
  add_number<CLI::ValidationError>(
      app, "--time-limit", options.seconds, finite_positive,
      "Give up a mesh after so many seconds. Reading, repair and writing are not broken off.")
      ->option_text("SECONDS")
      ->group("Limits");
  app.add_option("--max-memory", options.bytes,
                 "Give up a mesh rather than take more memory, in bytes or as 800M or 2G; 64M or more")
      ->transform(CLI::AsSizeValue(false))
      ->check(CLI::Range(std::uint64_t(64) << 20, std::uint64_t(1) << 62))
      ->option_text("SIZE")
      ->group("Limits");

  app.add_flag("-q,--quiet", options.is_quiet, "Print nothing but errors")->group("Output");

  // A variable of the shell that is not set would otherwise leave an option out without a word.
  const auto refuse_nothing = [](const std::string& text) {
    return text.empty() ? std::string("nothing is given to it") : std::string();
  };
  for (CLI::Option* option : app.get_options([](const CLI::Option*) { return true; }))
    if (option->get_items_expected_max() > 0) option->check(refuse_nothing);
}

}  // namespace segment_mesh

#endif
