// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_TILE_STEPS_H
#define SEGMENT_MESH_TILES_TILE_STEPS_H

#include "../Options.h"
#include "../Oriented_mesh.h"
#include "../Output_files.h"
#include "../Stages.h"
#include "../Task.h"
#include "../check_options.h"
#include "../failure.h"
#include "../read_input.h"
#include "../report.h"
#include "../seeds.h"
#include "../segment_colors.h"
#include "../segments.h"
#include "../signals.h"
#include "../treat_boundaries.h"
#include "../walls.h"
#include "step_contents.h"

#include <RW_segmentation/tiled_segmentation.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace segment_mesh {

namespace RW = RW_segmentation;

/// The steps of a segmentation of tiles. What each of them leaves for later ones is in files of a folder, so that it may be
/// done by any process, on any machine that sees the folder, as soon as the steps before it are done.
class Tile_steps {
 public:
  /// A step, in the order in which they are done.
  struct Step {
    const char* name;
    bool is_of_each_tile;
    void (Tile_steps::*run)(std::size_t tile) const;
    std::vector<const char*> files;  ///< that it leaves, the last one at its end
  };

  /// \param folder for what the steps leave
  /// \throws CLI::ValidationError, mesh_files::Unreadable_file for seeds
  Tile_steps(const std::vector<Task>& tiles, const Options& options, std::string folder)
      : tasks_(tiles), options_(options), folder_(std::move(folder)) {
    take_seeds();
    if (options.smoothing) method_.smoothing.radius = *options.smoothing;
    if (options.segments) method_.seeds = RW::Tiled_segmentation(*options.segments).seeds;
    if (options.automatic_seeds) method_.seeds = *options.automatic_seeds;
    method_.tolerance = options.tolerance.value_or(0);
    if (options.constraints_angle) method_.wall_angle = *options.constraints_angle * degree;
  }

  static const std::vector<Step>& all() {
    static const std::vector<Step> steps = {
        {"survey", true, &Tile_steps::survey, {"tile", "file_faces", "survey"}},
        {"plan", false, &Tile_steps::plan, {"plan"}},
        {"border", true, &Tile_steps::border, {"border", "noise"}},
        {"noise", false, &Tile_steps::noise, {"noise_of_all"}},
        {"shape", true, &Tile_steps::shape, {"shape", "outline"}},
        {"places", true, &Tile_steps::places, {"places"}},
        {"seeds", false, &Tile_steps::seeds, {"seeds"}},
        {"clusters", true, &Tile_steps::clusters, {"clusters", "network"}},
        {"walk", false, &Tile_steps::walk, {"walk"}},
        {"fragments", true, &Tile_steps::fragments, {"fragments", "regions"}},
        {"merge", false, &Tile_steps::merge, {"segments"}},
        {"labels", true, &Tile_steps::labels, {"labels"}},
        {"report", false, &Tile_steps::report, {"report"}},
    };
    return steps;
  }

  /// \throws CLI::ValidationError if there is no such step
  static const Step& named(const std::string& name) {
    for (const Step& step : all())
      if (name == step.name) return step;
    throw CLI::ValidationError("--tile-step", name + " is no step of a segmentation of tiles");
  }

  std::size_t number_of_tiles() const { return tasks_.size(); }

  /// Whether a step has left all of its files.
  bool is_done(const Step& step, std::size_t tile) const {
    return std::all_of(step.files.begin(), step.files.end(),
                       [&](const char* file) { return std::filesystem::exists(path(step, file, tile)); });
  }

  /// Removes what a step has left.
  void forget(const Step& step, std::size_t tile) const {
    for (const char* file : step.files) std::filesystem::remove(path(step, file, tile));
  }

  /// Whether a tile has changed since it was surveyed, or its walls.
  bool has_changed(std::size_t tile) const {
    namespace fs = std::filesystem;
    std::error_code error;
    const auto of_survey = fs::last_write_time(path_of_tile("survey", tile), error);
    if (error) return false;
    const auto is_newer = [&](const std::string& path) {
      const auto time = fs::last_write_time(path, error);
      return error || time > of_survey;
    };
    const std::string& walls = tasks_[tile].files.constraints;
    return is_newer(tasks_[tile].mesh) || (!walls.empty() && is_newer(walls));
  }

  /// The seeds of the user in words, which the steps from `places` on depend on.
  std::string seeds_in_words() const {
    Json seeds = Json::array();
    for (const auto& [point, label] : seeds_) seeds.push_back({point[0], point[1], point[2], labels_[label]});
    return seeds.dump();
  }

  /// What makes all steps what they are, in words: files that other tiles or options have left are of no use.
  std::string parameters() const {
    Json parameters = {{"tiles", Json::array()},
                       {"smoothing", method_.smoothing.radius},
                       {"seeds", method_.seeds},
                       {"tolerance", method_.tolerance},
                       {"walls", options_.files.constraints},
                       {"wall_angle", method_.wall_angle},
                       {"stitch", options_.repairs.stitch},
                       {"orient", options_.repairs.orient},
                       {"version", version()}};
    for (const Task& task : tasks_) parameters["tiles"].push_back(task.mesh);
    return parameters.dump();
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
  Json read_report() const { return Json::parse(mesh_files::read_content(folder_ + "/report")); }

 private:
  using Index = RW::Dual_mesh::Index;
  using Colors = std::vector<std::array<std::uint8_t, 3>>;

  /// Takes the user's seeds, their labels numbered from 0.
  void take_seeds() {
    std::set<std::size_t> labels;
    const std::vector<Seed_argument> arguments = seed_arguments(options_, options_.files.seeds);
    for (const Seed_argument& seed : arguments) labels.insert(*seed.label);
    labels_.assign(labels.begin(), labels.end());
    for (const Seed_argument& seed : arguments) {
      const Point* point = std::get_if<Point>(&seed.place);
      if (!point)
        throw CLI::ValidationError("--seed",
                                   seed.text + " is the number of a face, in whichever tile: give a point, X,Y,Z");
      const auto label = std::lower_bound(labels_.begin(), labels_.end(), *seed.label) - labels_.begin();
      seeds_.push_back({{point->x(), point->y(), point->z()}, static_cast<Index>(label)});
    }
  }

  /// The label of a segment: where seeds are the user's theirs, and those after the largest one for parts out of reach.
  std::size_t label_of(std::size_t segment) const {
    if (labels_.empty()) return segment;
    return segment < labels_.size() ? labels_[segment] : labels_.back() + 1 + segment - labels_.size();
  }

  /// The segment that has a label.
  std::size_t segment_of(std::size_t label) const {
    if (labels_.empty()) return label;
    if (label > labels_.back()) return labels_.size() + label - labels_.back() - 1;
    return static_cast<std::size_t>(std::lower_bound(labels_.begin(), labels_.end(), label) - labels_.begin());
  }

  std::string path(const Step& step, const char* file, std::size_t tile) const {
    return step.is_of_each_tile ? path_of_tile(file, tile) : folder_ + "/" + file;
  }
  std::string path_of_tile(const char* file, std::size_t tile) const {
    return folder_ + "/" + file + "_" + std::to_string(tile);
  }

  template <class Value>
  Value read(const char* file) const {
    Value value;
    read_step(folder_ + "/" + file, file, value);
    return value;
  }
  template <class Value>
  Value read(const char* file, std::size_t tile) const {
    Value value;
    read_step(path_of_tile(file, tile), file, value);
    return value;
  }
  template <class Value>
  std::vector<Value> read_all(const char* file) const {
    std::vector<Value> values;
    for (std::size_t t = 0; t < tasks_.size(); ++t) values.push_back(read<Value>(file, t));
    return values;
  }
  template <class Value>
  std::vector<Value> read_neighbours(const char* file, const RW::Tile_plan& plan, std::size_t tile) const {
    std::vector<Value> values;
    for (const auto neighbour : plan.tiles[tile].neighbours) values.push_back(read<Value>(file, neighbour));
    return values;
  }

  std::string failure_of(std::size_t tile) const {
    RW::Tile_survey survey;
    std::string failure;
    read_step(path_of_tile("survey", tile), "survey", survey, failure);
    return failure;
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
    Wall_map walls = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_wall", false).first;
    const std::string& path = tasks_[tile].files.constraints;
    if (!path.empty()) mark_constraints(soup.points, read_constraints(path), mesh, walls);
    return walls;
  }

  // ---- The steps ----

  void survey(std::size_t tile) const {
    RW::Tile arrays;
    std::vector<Index> tile_faces;      // by face of the file that is written
    std::vector<std::size_t> left_out;  // faces of the file
    std::string failure;
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
        for (const std::string& remark : input.remarks) say(tasks_[tile].mesh + ": " + remark);
    } catch (const mesh_files::Unreadable_file& error) {
      failure = error.what();  // leaves the other tiles their segments
    }
    write_step(path_of_tile("tile", tile), "tile", arrays);
    write_step(path_of_tile("file_faces", tile), "file_faces", tile_faces, left_out);
    write_step(path_of_tile("survey", tile), "survey", RW::survey_tile(arrays), failure);
  }

  void plan(std::size_t) const {
    write_step(folder_ + "/plan", "plan", RW::plan_tiles(read_all<RW::Tile_survey>("survey"), method_));
  }

  void border(std::size_t tile) const {
    RW::Tile_noise noise;
    const auto border =
        RW::border_of_tile(read<RW::Tile>("tile", tile), {tile, read<RW::Tile_plan>("plan")}, noise, method_);
    write_step(path_of_tile("border", tile), "border", border);
    write_step(path_of_tile("noise", tile), "noise", noise);
  }

  void noise(std::size_t) const {
    const auto noise = RW::noise_of_tiles(read_all<RW::Tile_noise>("noise"));
    write_step(folder_ + "/noise_of_all", "noise_of_all", noise.turn, noise.smoother_turn);
  }

  void shape(std::size_t tile) const {
    const auto plan = read<RW::Tile_plan>("plan");
    RW::internal::Noise_of_mesh noise;
    read_step(folder_ + "/noise_of_all", "noise_of_all", noise.turn, noise.smoother_turn);
    const auto [shape, outline] =
        RW::shape_of_tile(read<RW::Tile>("tile", tile), {tile, plan},
                          read_neighbours<RW::Tile_border>("border", plan, tile), noise, method_);
    RW::internal::Face_corners corners;
    std::vector<Eigen::Vector3d> normals;
    std::vector<char> is_wall;
    for (Index e = 0; shape.mesh.has_walls() && e < shape.mesh.number_of_edges(); ++e)
      is_wall.push_back(shape.mesh.is_wall(e));
    for (Index f = 0; f < shape.mesh.number_of_faces(); ++f) {
      for (const auto v : shape.mesh.corners(f)) corners.add(v);
      corners.end_face();
      normals.push_back(shape.mesh.shape_normal(f));
    }
    write_step(path_of_tile("shape", tile), "shape", corners, shape.mesh.points(), normals, is_wall, shape.own_faces,
               shape.halo, shape.shared_edges);
    write_step(path_of_tile("outline", tile), "outline", outline);
  }

  RW::Tile_shape read_shape(const RW::Tile_plan& plan, std::size_t tile) const {
    RW::Tile_shape shape;
    RW::internal::Face_corners corners;
    std::vector<Eigen::Vector3d> points, normals;
    std::vector<char> is_wall;
    read_step(path_of_tile("shape", tile), "shape", corners, points, normals, is_wall, shape.own_faces, shape.halo,
              shape.shared_edges);
    shape.mesh = RW::internal::part_of(plan, std::move(corners), std::move(points), std::move(is_wall))
                     .with_shape_normals(std::move(normals));
    return shape;
  }

  void places(std::size_t tile) const {
    std::vector<RW::Tile_place> places;
    if (!seeds_.empty()) {
      const auto plan = read<RW::Tile_plan>("plan");
      places = RW::places_in_tile(read_shape(plan, tile), plan, seeds_);
    }
    write_step(path_of_tile("places", tile), "places", places);
  }

  void seeds(std::size_t) const {
    const auto plan = read<RW::Tile_plan>("plan");
    const auto outlines = read_all<RW::Tile_outline>("outline");
    write_step(folder_ + "/seeds", "seeds",
               seeds_.empty()
                   ? RW::seeds_of_tiles(plan, outlines, method_)
                   : RW::seeds_of_tiles(plan, outlines, seeds_, read_all<std::vector<RW::Tile_place>>("places")));
  }

  void clusters(std::size_t tile) const {
    const auto plan = read<RW::Tile_plan>("plan");
    RW::Tile_network network;
    const auto clusters =
        RW::clusters_of_tile(read_shape(plan, tile), {tile, plan}, read<RW::Tile_border>("border", tile),
                             read<RW::Tile_seeds>("seeds"), network, method_);
    write_step(path_of_tile("clusters", tile), "clusters", clusters);
    write_step(path_of_tile("network", tile), "network", network);
  }

  void walk(std::size_t) const {
    write_step(folder_ + "/walk", "walk",
               RW::walk_over_tiles(read<RW::Tile_plan>("plan"), read<RW::Tile_seeds>("seeds"),
                                   read_all<RW::Tile_network>("network"), method_));
  }

  void fragments(std::size_t tile) const {
    const auto plan = read<RW::Tile_plan>("plan");
    RW::Tile_regions regions;
    const auto fragments = RW::fragments_of_tile({{tile, plan},
                                                  read_shape(plan, tile),
                                                  read<RW::Tile_clusters>("clusters", tile),
                                                  read_neighbours<RW::Tile_border>("border", plan, tile),
                                                  read_neighbours<RW::Tile_network>("network", plan, tile),
                                                  read<RW::Tile_seeds>("seeds"),
                                                  read<RW::Tile_walk>("walk")},
                                                 regions);
    write_step(path_of_tile("fragments", tile), "fragments", fragments);
    write_step(path_of_tile("regions", tile), "regions", regions);
  }

  /// The segments of fragments, with the share of the area and the colour of each.
  void merge(std::size_t) const {
    const auto regions = read_all<RW::Tile_regions>("regions");
    const auto walk = read<RW::Tile_walk>("walk");
    const RW::Merge_tree tree =
        seeds_.empty() ? RW::merge_tiles(walk, regions) : RW::Merge_tree(walk.number_of_fragments, {});
    const std::size_t suggested = seeds_.empty() ? RW::Cost_threshold_stop(1)(tree) : walk.number_of_fragments;
    const std::vector<std::size_t> segment = tree.segment_of_fragments(options_.segments.value_or(suggested));
    const std::size_t segments = segment.empty() ? 0 : *std::max_element(segment.begin(), segment.end()) + 1;

    std::vector<double> area(segments, 0.);
    std::vector<std::set<std::size_t>> neighbours(segments);
    const auto add_neighbours = [&](const std::array<Index, 2>& fragments) {
      const std::size_t a = segment[fragments[0]], b = segment[fragments[1]];
      if (a == b) return;
      neighbours[a].insert(b);
      neighbours[b].insert(a);
    };
    for (const RW::Tile_regions& tile : regions) {
      for (std::size_t i = 0; i < tile.fragments.size(); ++i)
        area[segment[tile.fragments[i]]] += tile.regions[i].size.area;
      for (const auto& fragments : tile.walls) add_neighbours(fragments);  // whose colours must differ, too
    }
    for (const auto& boundary : RW::internal::boundaries_of_tiles(regions)) add_neighbours(boundary.regions);
    std::vector<std::vector<std::size_t>> lists;
    for (const auto& of_segment : neighbours) lists.emplace_back(of_segment.begin(), of_segment.end());
    std::vector<double> costs;
    std::vector<std::array<std::uint64_t, 2>> merges;
    for (const auto& merge : tree.merges()) {
      merges.push_back({merge.first, merge.second});
      costs.push_back(merge.cost);
    }
    write_step(folder_ + "/segments", "segments", std::vector<std::uint64_t>(segment.begin(), segment.end()), area,
               Colors(segment_colors(lists)), merges, costs, std::uint64_t(suggested));
  }

  struct Segments {
    std::vector<std::uint64_t> of_fragment;
    std::vector<double> area;  ///< as a part of the whole
    Colors colors;
    std::vector<std::array<std::uint64_t, 2>> merges;
    std::vector<double> costs;  ///< of these
    std::uint64_t suggested = 0;

    RW::Merge_tree tree() const {
      std::vector<RW::Merge_tree::Merge> list;
      for (std::size_t i = 0; i < merges.size(); ++i) list.push_back({merges[i][0], merges[i][1], costs[i]});
      return {of_fragment.size(), std::move(list)};
    }
  };
  Segments read_segments() const {
    Segments s;
    read_step(folder_ + "/segments", "segments", s.of_fragment, s.area, s.colors, s.merges, s.costs, s.suggested);
    return s;
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
    for (const Index face : tile_faces) labelled.faces.emplace_back(face);
    labelled.result.label = std::move(label);
    return labelled;
  }

  /// A tile with its boundaries smoothed and cut into it, as far as asked for.
  /// \param label by face of the tile
  Labelled_tile with_boundaries(std::size_t tile, const std::vector<std::size_t>& label, Output_files& files) const {
    Labelled_tile labelled;
    Oriented_mesh input = read_tile(tile, labelled.soup);
    const Wall_map walls = named_walls(tile, labelled.soup, input.mesh);
    if (options_.constraints_angle) mark_sharp_edges(input.mesh, *options_.constraints_angle, walls);
    labelled.result.label.resize(label.size());
    const RW::Tile_of<Mesh> numbered(input.mesh);
    for (Index f = 0; f < label.size(); ++f) labelled.result.label[numbered.face_descriptors[f]] = label[f];
    Stages without_bar(false, "", is_interrupted, Deadline({}));
    treat_boundaries(options_, labelled.soup, input, walls, labelled.result, without_bar, files);
    labelled.faces = faces_in_file_order(labelled.soup, input);
    return labelled;
  }

  void labels(std::size_t tile) const {
    const Segments all = read_segments();
    std::vector<std::uint64_t> faces_of_segment(all.area.size(), 0);
    if (failure_of(tile).empty()) {
      Output_files files(tasks_[tile].files, options_);
      std::vector<Index> tile_faces;
      std::vector<std::size_t> left_out, label;
      read_step(path_of_tile("file_faces", tile), "file_faces", tile_faces, left_out);
      for (const Index fragment : read<std::vector<Index>>("fragments", tile))
        label.push_back(label_of(all.of_fragment.at(fragment)));
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
    write_step(path_of_tile("labels", tile), "labels", faces_of_segment);
  }

  void report(std::size_t) const {
    const Segments all = read_segments();
    std::vector<std::uint64_t> faces(all.area.size(), 0);
    for (std::size_t t = 0; t < tasks_.size(); ++t) {
      const auto of_tile = read<std::vector<std::uint64_t>>("labels", t);
      for (std::size_t s = 0; s < faces.size(); ++s) faces[s] += of_tile[s];
    }
    const auto plan = read<RW::Tile_plan>("plan");
    const auto walk = read<RW::Tile_walk>("walk");
    const auto seeds = read<RW::Tile_seeds>("seeds");
    Json report = {{"tiles", tasks_.size()},
                   {"faces", plan.faces},
                   {"components", walk.components},
                   {"clusters", walk.clusters},
                   {"seeds", seeds.seeds.size()},
                   {"fragments", all.of_fragment.size()},
                   {"turned_sides", seeds.turned_sides},
                   {"walls", seeds.walls},
                   {"segments", Json::array()},
                   {"failed", failures()},
                   {"version", version()}};
    for (std::size_t s = 0; s < faces.size(); ++s)
      report["segments"].push_back(
          {{"label", label_of(s)}, {"faces", faces[s]}, {"area_share", all.area[s]}, {"color", all.colors[s]}});
    if (!labels_.empty())
      report["unseeded_components"] = faces.size() - labels_.size();
    else if (!faces.empty())
      report["levels"] = all.tree().levels(all.suggested);
    mesh_files::Output_file file(folder_ + "/report");
    file.write(report.dump() + "\n");
    file.commit();
  }

  const std::vector<Task>& tasks_;
  const Options& options_;
  std::string folder_;
  RW::Tiled_segmentation method_;
  std::vector<RW::Seed_point> seeds_;  ///< of the user
  std::vector<std::size_t> labels_;    ///< of these, rising
};

}  // namespace segment_mesh

#endif
