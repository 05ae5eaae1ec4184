// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_TILE_STEPS_H
#define SEGMENT_MESH_TILES_TILE_STEPS_H

#include "../Options.h"
#include "../Oriented_mesh.h"
#include "../Output_files.h"
#include "../Stages.h"
#include "../Task.h"
#include "../failure.h"
#include "../read_input.h"
#include "../report.h"
#include "../segments.h"
#include "../signals.h"
#include "../treat_boundaries.h"
#include "../walls.h"
#include "Face_sample.h"
#include "Surface_steps.h"
#include "Tile_folder.h"
#include "Tile_segments.h"
#include "Tile_step.h"
#include "Walk_steps.h"

#include <RW_segmentation/internal/tiles/Joined_faces.h>
#include <RW_segmentation/tiled_boundaries.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace segment_mesh {

/// The steps of a segmentation of tiles. What each of them leaves for later ones is in files of a folder, so that it may be
/// done by any process, on any machine that sees the folder, as soon as the steps before it are done.
class Tile_steps {
 public:
  /// \param folder for what the steps leave
  /// \throws CLI::ValidationError, mesh_files::Unreadable_file for seeds
  Tile_steps(const std::vector<Task>& tiles, const Options& options, std::string folder)
      : tasks_(tiles),
        options_(options),
        folder_(std::move(folder), names_of(tiles)),
        walk_(folder_, options),
        surfaces_(folder_, options) {
    steps_ = {{"survey", true, {"connected", "file_faces", "survey"}, [this](std::size_t tile) { survey(tile); }},
              {"plan", false, {"parts", "plan"}, [this](std::size_t) { plan(); }}};
    for (Tile_step& step : options.is_engineering ? surfaces_.steps() : walk_.steps())
      steps_.push_back(std::move(step));
    if (smooths_boundaries(options)) {
      steps_.push_back({"strips", true, {"strip"}, [this](std::size_t tile) { strip(tile); }});
      steps_.push_back({"crossings", true, {"crossings"}, [this](std::size_t tile) { crossings(tile); }});
    }
    steps_.push_back({"labels", true, {"labels"}, [this](std::size_t tile) { labels(tile); }});
    steps_.push_back({"report", false, {"report"}, [this](std::size_t) { report(); }});
  }
  Tile_steps(const Tile_steps&) = delete;
  Tile_steps& operator=(const Tile_steps&) = delete;

  /// In the order in which they are done.
  const std::vector<Tile_step>& all() const { return steps_; }

  /// \throws CLI::ValidationError if there is no such step
  const Tile_step& named(const std::string& name) const {
    for (const Tile_step& step : steps_)
      if (name == step.name) return step;
    throw CLI::ValidationError("--tile-step", name + " is no step of such a segmentation of tiles");
  }

  std::size_t number_of_tiles() const { return tasks_.size(); }

  const std::string& name_of(std::size_t tile) const { return tasks_[tile].mesh; }

  /// Whether the parts of a tile are in the folder of `--split` and nothing else is: from a call that is gone on with.
  bool has_left_parts(std::size_t tile) const {
    namespace fs = std::filesystem;
    const std::string& parts = tasks_[tile].files.split;
    if (!fs::exists(folder_.path(parts_file, tile))) return false;
    std::string path;
    folder_.read_of_tile_into(tile, parts_file, path);
    const auto is_part = [](const fs::path& file) {
      const std::string name = file.filename().string(), first = mesh_files::name_of_segment(0);
      const std::size_t number = first.size() - 1, behind = name.find_first_not_of("0123456789", number);
      const bool has_number = behind != std::string::npos && behind > number;
      return name.compare(0, number, first, 0, number) == 0 && has_number && name[behind] == '.';
    };
    return path == path_of_parts(tile) && std::all_of(fs::directory_iterator(parts), fs::directory_iterator(), is_part);
  }

  /// All files that steps leave.
  std::vector<std::string> files() const {
    std::vector<std::string> files;
    for (const Tile_step& step : steps_)
      for (const char* file : step.files)
        for (std::size_t t = 0; t < (step.is_of_each_tile ? tasks_.size() : 1); ++t)
          files.push_back(path(step, file, t));
    for (std::size_t t = 0; t < tasks_.size(); ++t)
      if (!tasks_[t].files.split.empty()) files.push_back(folder_.path(parts_file, t));
    return files;
  }

  /// Whether a step has left all of its files.
  bool is_done(const Tile_step& step, std::size_t tile) const {
    return std::all_of(step.files.begin(), step.files.end(),
                       [&](const char* file) { return std::filesystem::exists(path(step, file, tile)); });
  }

  /// Removes what a step has left.
  void forget(const Tile_step& step, std::size_t tile) const {
    for (const char* file : step.files) std::filesystem::remove(path(step, file, tile));
  }

  /// Whether a tile is not the file that was surveyed, or its walls are not, or whether it could not be read then.
  bool has_changed(std::size_t tile) const {
    if (!std::filesystem::exists(folder_.path("survey", tile))) return false;
    std::string failure, sources;
    folder_.read_of_tile_into(tile, "survey", failure, sources);
    return !failure.empty() || sources != sources_in_words(tile);
  }

  /// The seeds of the user in words, which the steps from `places` on depend on.
  std::string seeds_in_words() const { return walk_.seeds_in_words(); }

  /// How many seeds place themselves, in words, which the steps from `shape` on depend on.
  std::string seeding_in_words() const {
    return options_.is_engineering ? "no seeds" : counted(walk_.automatic_seeds(), "seed");
  }

  /// Whether connected parts are segmented each by itself, in words; all steps depend on it.
  std::string parting_in_words() const { return is_parted() ? "each part by itself" : "all parts as a whole"; }

  /// What makes all steps what they are, in words: files that other tiles or options have left are of no use.
  std::string parameters() const {
    Json parameters = {{"tiles", Json::array()},
                       {"tolerance", tolerance()},
                       {"walls", options_.files.constraints},
                       {"wall_angle", wall_angle_of(options_)},
                       {"stitch", options_.repairs.stitch},
                       {"orient", options_.repairs.orient},
                       {"version", version()}};
    parameters.update(options_.is_engineering ? surfaces_.parameters() : walk_.parameters());
    for (const Task& task : tasks_) parameters["tiles"].push_back(task.mesh);
    return line_of(parameters);
  }

  /// Refuses tiles whose boundaries cannot be smoothed, which only the last steps would find out.
  /// \throws Argument_out_of_range if smooth boundaries are asked for and a face that was surveyed is no triangle
  void check_triangles() const {
    if (!smooths_boundaries(options_)) return;
    for (std::size_t t = 0; t < tasks_.size(); ++t) {
      std::string failure, sources;
      Index polygon = no_face;
      folder_.read_of_tile_into(t, "survey", failure, sources, polygon);
      if (polygon != no_face)
        throw Argument_out_of_range(tasks_[t].mesh + ": face " + std::to_string(polygon) +
                                    " is no triangle: boundaries are smoothed from tile to tile on triangles only");
    }
  }

  /// The tiles that could not be read, each with the reason.
  std::vector<std::string> failures() const {
    std::vector<std::string> failures;
    for (std::size_t t = 0; t < tasks_.size(); ++t) {
      const std::string failure = failure_of(t);
      if (!failure.empty()) failures.push_back(failure);
    }
    return failures;
  }

  /// What the last step tells.
  Json read_report() const { return Json::parse(mesh_files::read_content(folder_.path("report"))); }

 private:
  using Index = RW::Dual_mesh::Index;
  using Sides = std::vector<std::array<Index, 2>>;  // by their vertices
  static constexpr Index no_face = std::numeric_limits<Index>::max();

  static std::vector<std::string> names_of(const std::vector<Task>& tiles) {
    std::vector<std::string> names;
    for (const Task& tile : tiles) names.push_back(tile.mesh);
    return names;
  }

  double tolerance() const { return options_.tolerance.value_or(0); }

  bool is_parted() const { return options_.is_engineering || walk_.is_parted(); }

  std::size_t label_of(std::size_t segment) const {
    return options_.is_engineering ? segment : walk_.label_of(segment);
  }

  /// The segment that has a label.
  std::size_t segment_of(std::size_t label) const { return options_.is_engineering ? label : walk_.segment_of(label); }

  static constexpr const char* parts_file = "parts_of_tile";  // tells in which folder the parts of a tile are

  std::string path_of_parts(std::size_t tile) const {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(tasks_[tile].files.split)).string();
  }

  /// Removes the parts of a tile that have been left in the folder of `--split`.
  void make_place_for_parts(std::size_t tile) const {
    namespace fs = std::filesystem;
    const std::string& parts = tasks_[tile].files.split;
    std::error_code error;  // it is not there
    if (parts.empty() || (!fs::is_empty(parts, error) && !error && !has_left_parts(tile))) return;
    if (!error)
      for (const fs::path& part : std::vector<fs::path>(fs::directory_iterator(parts), fs::directory_iterator()))
        fs::remove(part);
    folder_.write_of_tile(tile, parts_file, path_of_parts(tile));
  }

  std::string path(const Tile_step& step, const char* file, std::size_t tile) const {
    return step.is_of_each_tile ? folder_.path(file, tile) : folder_.path(file);
  }

  std::string failure_of(std::size_t tile) const {
    std::string failure;
    folder_.read_of_tile_into(tile, "survey", failure);
    return failure;
  }

  /// What tells files of a tile from others that take their place, whichever are newer: sizes and times.
  std::string sources_in_words(std::size_t tile) const {
    namespace fs = std::filesystem;
    Json sources = Json::array();
    for (const std::string& path : {tasks_[tile].mesh, tasks_[tile].files.constraints}) {
      std::error_code no_size, no_time;
      const auto size = fs::file_size(path, no_size);
      const auto time = fs::last_write_time(path, no_time).time_since_epoch().count();
      sources.push_back(no_size || no_time ? Json(nullptr) : Json::array({size, time}));
    }
    return sources.dump();
  }

  /// Refuses a tile that is not what was surveyed, after it has been read. \throws mesh_files::Unreadable_file
  void check_source(std::size_t tile, std::size_t faces, std::size_t surveyed) const {
    std::string failure, sources;
    folder_.read_of_tile_into(tile, "survey", failure, sources);
    if (faces != surveyed || sources != sources_in_words(tile))
      throw mesh_files::Unreadable_file(tasks_[tile].mesh + ": the file has changed since the step \"survey\" read it" +
                                        (tasks_[tile].files.constraints.empty() ? "" : ", or its walls have"));
  }

  /// The first face of a tile that is no triangle, if there is one.
  static Index first_polygon(const RW::Tile& tile) {
    for (Index f = 0; f < tile.number_of_faces(); ++f)
      if (tile.corners[f].size() != 3) return f;
    return no_face;
  }

  /// A tile as it is in its file, and repaired: each time in the same way.
  Oriented_mesh read_tile(std::size_t tile, mesh_files::Polygon_soup& soup) const {
    soup = read_input(tasks_[tile].mesh, options_.format);
    refuse_mesh_without_faces(tasks_[tile].mesh, soup);
    Oriented_mesh input = oriented_mesh(soup, options_.repairs);
    refuse_mesh_without_faces(tasks_[tile].mesh, input);
    return input;
  }

  /// The walls that a file names for a tile.
  Wall_map named_walls(std::size_t tile, const mesh_files::Polygon_soup& soup, Mesh& mesh) const {
    Wall_map walls = wall_map(mesh);
    const std::string& path = tasks_[tile].files.constraints;
    if (!path.empty()) mark_constraints(soup.points, read_constraints(path), mesh, walls);
    return walls;
  }

  void survey(std::size_t tile) const {
    RW::Tile arrays;
    std::vector<Index> tile_faces;      // by face of the file that is written
    std::vector<std::size_t> left_out;  // faces of the file
    std::string failure;
    const std::string sources = sources_in_words(tile);  // before they are read: what changes meanwhile is read again
    try {
      mesh_files::Polygon_soup soup;
      Oriented_mesh input = read_tile(tile, soup);
      const Wall_map walls = named_walls(tile, soup, input.mesh);
      RW::Tile_of<Mesh> tile_of_mesh(input.mesh, CGAL::parameters::edge_is_constrained_map(walls));
      std::vector<Index> number(input.mesh.number_of_faces());
      for (Index f = 0; f < number.size(); ++f) number[tile_of_mesh.face_descriptors[f]] = f;
      for (const auto face : faces_in_file_order(soup, input)) tile_faces.push_back(number[face]);
      left_out = faces_left_out(input);
      arrays = std::move(tile_of_mesh);
      if (!options_.is_quiet)
        for (const auto& remarks : {soup.remarks, input.remarks})
          for (const std::string& remark : remarks) say(tasks_[tile].mesh + ": " + remark);
    } catch (const mesh_files::Unreadable_file& error) {
      failure = error.what();  // leaves the other tiles their segments
      if (failure.find(tasks_[tile].mesh) == std::string::npos) failure = tasks_[tile].mesh + ": " + failure;
    }
    const RW::Tile_survey survey = RW::survey_tile(arrays);
    const Index polygon = first_polygon(arrays);
    const std::vector<std::uint64_t> sample = face_sample(arrays);
    Sides border;  // which no step asks for where vertices are the same in the same place alone
    if (tolerance() > 0) border = RW::internal::Joined_faces(arrays.corners, arrays.points.size()).open_ends;
    std::vector<RW::Tile_piece> pieces;
    if (is_parted())
      pieces = RW::connected_pieces(std::move(arrays));
    else
      pieces.push_back(RW::whole_tile(std::move(arrays)));
    std::vector<RW::Tile_survey> of_pieces;
    for (const RW::Tile_piece& piece : pieces)
      of_pieces.push_back(pieces.size() == 1 ? survey : RW::survey_tile(piece.tile));
    folder_.write_of_tile(tile, "connected", pieces);
    folder_.write_of_tile(tile, "file_faces", tile_faces, left_out);
    folder_.write_of_tile(tile, "survey", failure, sources, polygon, survey, of_pieces, sample, border);
  }

  void plan() const {
    check_triangles();
    std::vector<RW::Tile_survey> surveys(tasks_.size());
    std::vector<std::vector<RW::Tile_survey>> of_pieces(tasks_.size());
    std::vector<std::vector<std::uint64_t>> samples(tasks_.size());
    std::vector<Sides> borders(tasks_.size());
    for (std::size_t t = 0; t < tasks_.size(); ++t) {
      std::string failure, sources;
      Index polygon = no_face;
      folder_.read_of_tile_into(t, "survey", failure, sources, polygon, surveys[t], of_pieces[t], samples[t],
                                borders[t]);
    }
    const RW::Tile_plan plan = RW::plan_tiles(surveys, tolerance());
    for (std::size_t t = 0; t < tasks_.size(); ++t) check_tolerance(t, surveys[t], plan, borders[t]);
    folder_.write("parts", RW::parts_of_tiles(of_pieces, tolerance(), is_parted()));
    folder_.write("plan", plan, overlapping_tiles(samples), char(are_apart(surveys, plan)));
  }

  /// \param border the sides of the tile there
  /// \throws Argument_out_of_range if the ends of one of them, which lie apart, are the same vertex
  void check_tolerance(std::size_t tile, const RW::Tile_survey& survey, const RW::Tile_plan& plan,
                       const Sides& border) const {
    const std::vector<Index>& vertices = survey.border_vertices;  // rising
    std::vector<Index> id(vertices.size(), RW::Tile_border::none);
    const auto place_of = [&](Index vertex) {
      return static_cast<std::size_t>(std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin());
    };
    for (const auto& [vertex, number] : plan.tiles[tile].shared_vertices) id[place_of(vertex)] = number;
    for (const auto& [from, to] : border) {
      const std::size_t a = place_of(from), b = place_of(to);
      const Eigen::Vector3d &p = survey.border_points[a], &q = survey.border_points[b];
      if (id[a] == RW::Tile_border::none || id[a] != id[b] || p == q) continue;
      std::ostringstream message;
      message << tasks_[tile].mesh << ": --tolerance " << tolerance() << " makes one vertex of (" << p[0] << ", "
              << p[1] << ", " << p[2] << ") and (" << q[0] << ", " << q[1] << ", " << q[2]
              << "), the ends of an edge at the border: give a smaller one";
      throw Argument_out_of_range(message.str());
    }
  }

  /// Whether no tile meets another one, though open ones lie beside each other.
  static bool are_apart(const std::vector<RW::Tile_survey>& surveys, const RW::Tile_plan& plan) {
    constexpr double largest_gap = 1e-3;  // of the whole: coordinates of tiles are off by less
    for (const auto& tile : plan.tiles)
      if (!tile.neighbours.empty()) return false;
    const Eigen::Vector3d gap = Eigen::Vector3d::Constant(largest_gap * plan.box.unit);
    for (std::size_t t = 0; t < surveys.size(); ++t)
      for (std::size_t other = 0; other < t; ++other) {
        const bool are_open = !surveys[t].border_points.empty() && !surveys[other].border_points.empty();
        const Eigen::AlignedBox3d &a = surveys[t].box, &b = surveys[other].box;
        if (are_open && Eigen::AlignedBox3d(a.min() - gap, a.max() + gap).intersects(b)) return true;
      }
    return false;
  }

  /// The walls of a tile, sharp edges included.
  Wall_map all_walls(std::size_t tile, const mesh_files::Polygon_soup& soup, Mesh& mesh) const {
    const Wall_map walls = named_walls(tile, soup, mesh);
    if (options_.constraints_angle) mark_sharp_edges(mesh, *options_.constraints_angle, walls);
    return walls;
  }

  /// What merging has left.
  /// \throws Argument_out_of_range if it had other options
  Tile_segments read_segments() const {
    Tile_segments segments;
    std::string words;
    folder_.read_into("segments", segments, words);
    if (words != merging_in_words(options_))
      throw Argument_out_of_range(
          folder_.path("segments") +
          ": the step \"merge\" had another --segments or --regular: do it again, or give the same");
    return segments;
  }

  /// The label of each face of a tile.
  std::vector<std::size_t> labels_of(std::size_t tile, const Tile_segments& all) const {
    const auto faces = folder_.read<std::vector<std::vector<Index>>>("piece_faces", tile);
    const auto fragments = folder_.read<std::vector<std::vector<Index>>>("fragments", tile);
    std::size_t number_of_faces = 0;
    for (const auto& of_piece : faces) number_of_faces += of_piece.size();
    std::vector<std::size_t> label(number_of_faces);
    for (std::size_t p = 0; p < faces.size(); ++p)
      for (std::size_t f = 0; f < faces[p].size(); ++f)
        label[faces[p][f]] = label_of(all.segment(tile, p, fragments[p][f]));
    return label;
  }

  /// Each tile finds its sharp edges by itself, so that the boundaries of the last step keep to the same walls.
  void strip(std::size_t tile) const {
    RW::Tile_strip strip;
    if (failure_of(tile).empty()) {
      mesh_files::Polygon_soup soup;
      Oriented_mesh input = read_tile(tile, soup);
      const Wall_map walls = all_walls(tile, soup, input.mesh);
      const RW::Tile_of<Mesh> arrays(input.mesh, CGAL::parameters::edge_is_constrained_map(walls));
      const std::vector<std::size_t> label = labels_of(tile, read_segments());
      check_source(tile, arrays.number_of_faces(), label.size());
      strip = RW::strip_of_tile(arrays, {tile, folder_.read<RW::Tile_plan>("plan")}, label);
    }
    folder_.write_of_tile(tile, "strip", strip);
  }

  void crossings(std::size_t tile) const {
    const auto plan = folder_.read<RW::Tile_plan>("plan");
    folder_.write_of_tile(tile, "crossings",
                          RW::crossings_of_tile({tile, plan}, folder_.read<RW::Tile_strip>("strip", tile),
                                                folder_.read_neighbours<RW::Tile_strip>("strip", plan, tile), {},
                                                wall_angle_of(options_)));
  }

  /// The crossings that a tile and its neighbours have found.
  std::vector<RW::Tile_crossing> crossings_around(std::size_t tile, const RW::Tile_plan& plan) const {
    using Crossings = std::vector<RW::Tile_crossing>;
    auto all = folder_.read<Crossings>("crossings", tile);
    for (const Crossings& of_neighbour : folder_.read_neighbours<Crossings>("crossings", plan, tile))
      all.insert(all.end(), of_neighbour.begin(), of_neighbour.end());
    return all;
  }

  /// What is written of a tile.
  struct Labelled_tile {
    mesh_files::Polygon_soup soup;
    std::vector<Mesh::Face_index> faces;  ///< by face of the soup: that of the result which speaks for it
    Segmentation result;
  };

  /// A tile as it is in its file.
  /// \param tile_faces by face of the file: its number in the tile
  /// \param label by face of the tile
  Labelled_tile labelled_file(std::size_t tile, const std::vector<Index>& tile_faces,
                              std::vector<std::size_t> label) const {
    Labelled_tile labelled;
    labelled.soup = read_input(tasks_[tile].mesh, options_.format);
    check_source(tile, labelled.soup.number_of_faces(), tile_faces.size());
    for (const Index face : tile_faces) labelled.faces.emplace_back(face);
    labelled.result.label = std::move(label);
    return labelled;
  }

  /// A tile with its boundaries smoothed and cut into it, as far as asked for.
  /// \param label by face of the tile
  Labelled_tile with_boundaries(std::size_t tile, const std::vector<std::size_t>& label, Output_files& files) const {
    Labelled_tile labelled;
    Oriented_mesh input = read_tile(tile, labelled.soup);
    check_source(tile, input.mesh.number_of_faces(), label.size());
    const Wall_map walls = all_walls(tile, labelled.soup, input.mesh);
    labelled.result.label.resize(label.size());
    const RW::Tile_of<Mesh> numbered(input.mesh);
    for (Index f = 0; f < label.size(); ++f) labelled.result.label[numbered.face_descriptors[f]] = label[f];
    if (smooths_boundaries(options_)) {
      const auto plan = folder_.read<RW::Tile_plan>("plan");
      const auto go_on = [](double) { return is_interrupted == 0; };
      use_boundaries(options_,
                     boundary_curves_of_tile(input.mesh, walls, labelled.result.label, {tile, plan},
                                             crossings_around(tile, plan), go_on),
                     labelled.soup, input, labelled.result, files);
    } else {
      Stages without_bar(false, "", is_interrupted, Deadline({}));
      treat_boundaries(options_, labelled.soup, input, walls, labelled.result, without_bar, files);
    }
    labelled.faces = faces_in_file_order(labelled.soup, input);
    return labelled;
  }

  void labels(std::size_t tile) const {
    const auto all = read_segments();
    std::vector<std::uint64_t> faces_of_segment(all.area.size(), 0);
    if (failure_of(tile).empty()) {
      make_place_for_parts(tile);
      Output_files files(tasks_[tile].files, options_);
      std::vector<Index> tile_faces;
      std::vector<std::size_t> left_out;
      folder_.read_of_tile_into(tile, "file_faces", tile_faces, left_out);
      std::vector<std::size_t> label = labels_of(tile, all);
      const Labelled_tile labelled = treats_boundaries(options_) ? with_boundaries(tile, label, files)
                                                                 : labelled_file(tile, tile_faces, std::move(label));
      std::vector<Segment> segments;
      for (std::size_t s = 0; s < all.area.size(); ++s)
        segments.push_back({label_of(s), 0, all.area[s], all.colors[s]});
      segments = counted_in_file(std::move(segments), in_file_order(labelled.faces, labelled.result.label));
      for (const Segment& segment : segments) faces_of_segment[segment_of(segment.label)] = segment.faces;
      files.write(labelled.soup, nullptr, labelled.faces, labelled.result, segments);
      files.write_left_out(left_out);
      files.commit({});
    }
    folder_.write_of_tile(tile, "labels", faces_of_segment);
  }

  void report() const {
    const auto all = read_segments();
    std::vector<std::uint64_t> faces(all.area.size(), 0);
    for (const auto& of_tile : folder_.read_all<std::vector<std::uint64_t>>("labels"))
      for (std::size_t s = 0; s < faces.size(); ++s) faces[s] += of_tile[s];
    RW::Tile_plan plan;
    std::vector<std::array<Index, 2>> overlaps;
    char are_tiles_apart = 0;
    folder_.read_into("plan", plan, overlaps, are_tiles_apart);
    Json report = {{"tiles", tasks_.size()},
                   {"faces", plan.faces},
                   {"components", all.components},
                   {"fragments", all.of_fragment.size()},
                   {"overlaps", Json::array()},
                   {"tiles_apart", are_tiles_apart != 0},
                   {"turned_sides", all.turned_sides},
                   {"walls", all.walls},
                   {"segments", Json::array()},
                   {"failed", failures()},
                   {"version", version()}};
    for (const auto& [a, b] : overlaps) report["overlaps"].push_back({tasks_[a].mesh, tasks_[b].mesh});
    for (std::size_t s = 0; s < faces.size(); ++s)
      report["segments"].push_back(
          {{"label", label_of(s)}, {"faces", faces[s]}, {"area_share", all.area[s]}, {"color", all.colors[s]}});
    if (!faces.empty() && !options_.has_seeds() && !options_.is_engineering)
      report["levels"] = all.tree().levels(all.suggested);
    if (options_.is_engineering)
      surfaces_.complete(report);
    else
      walk_.complete(report);
    mesh_files::Output_file file(folder_.path("report"));
    file.write(line_of(report));
    file.commit();
  }

  const std::vector<Task>& tasks_;
  const Options& options_;
  Tile_folder folder_;
  Walk_steps walk_;
  Surface_steps surfaces_;
  std::vector<Tile_step> steps_;
};

}  // namespace segment_mesh

#endif
