// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_WALK_STEPS_H
#define SEGMENT_MESH_TILES_WALK_STEPS_H

#include "../Options.h"
#include "../Oriented_mesh.h"
#include "../check_options.h"
#include "../seeds.h"
#include "../surfaces.h"
#include "../walls.h"
#include "Tile_folder.h"
#include "Tile_segments.h"
#include "Tile_step.h"

#include <RW_segmentation/tiled_segmentation.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace segment_mesh {

/// The steps of a walk over tiles, from their borders to the segments.
class Walk_steps {
 public:
  /// Keeps references to both.
  /// \throws CLI::ValidationError, mesh_files::Unreadable_file for seeds
  Walk_steps(const Tile_folder& folder, const Options& options) : folder_(folder), options_(options) {
    take_seeds();
    if (options.smoothing) method_.smoothing.radius = *options.smoothing;
    if (options.segments) method_.seeds = RW::Tiled_segmentation(*options.segments).seeds;
    if (options.automatic_seeds) method_.seeds = *options.automatic_seeds;
    method_.wall_angle = wall_angle_of(options);
  }

  std::vector<Tile_step> steps() const {
    return {{"border", true, {"border", "noise"}, [this](std::size_t tile) { border(tile); }},
            {"noise", false, {"noise_of_all"}, [this](std::size_t) { noise(); }},
            {"shape", true, {"shape", "outline"}, [this](std::size_t tile) { shape(tile); }},
            {"places", true, {"places"}, [this](std::size_t tile) { places(tile); }},
            {"seeds", false, {"seeds"}, [this](std::size_t) { seeds(); }},
            {"clusters", true, {"clusters", "network"}, [this](std::size_t tile) { clusters(tile); }},
            {"walk", false, {"walk"}, [this](std::size_t) { walk(); }},
            {"fragments", true, {"fragments", "regions"}, [this](std::size_t tile) { fragments(tile); }},
            {"merge", false, {"segments"}, [this](std::size_t) { merge(); }}};
  }

  /// The seeds of the user in words, which the steps from `places` on depend on.
  std::string seeds_in_words() const {
    Json seeds = Json::array();
    for (const auto& [point, label] : seeds_) seeds.push_back({point[0], point[1], point[2], labels_[label]});
    return seeds.dump();
  }

  /// What makes all steps what they are.
  Json parameters() const { return {{"smoothing", method_.smoothing.radius}, {"seeds", method_.seeds}}; }

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

  /// Adds what is known at the end.
  void complete(Json& report) const {
    const auto walk = folder_.read<RW::Tile_walk>("walk");
    report["clusters"] = walk.clusters;
    report["seeds"] = folder_.read<RW::Tile_seeds>("seeds").seeds.size();
    if (!labels_.empty()) report["unseeded_components"] = report["segments"].size() - labels_.size();
  }

 private:
  using Index = RW::Dual_mesh::Index;

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

  RW::Tile_plan read_plan() const { return folder_.read<RW::Tile_plan>("plan"); }

  void border(std::size_t tile) const {
    RW::Tile_noise noise;
    const auto border = RW::border_of_tile(folder_.read<RW::Tile>("tile", tile), {tile, read_plan()}, noise, method_);
    folder_.write_of_tile(tile, "border", border);
    folder_.write_of_tile(tile, "noise", noise);
  }

  void noise() const {
    const auto noise = RW::noise_of_tiles(folder_.read_all<RW::Tile_noise>("noise"));
    folder_.write("noise_of_all", noise.turn, noise.smoother_turn);
  }

  void shape(std::size_t tile) const {
    const auto plan = read_plan();
    RW::internal::Noise_of_mesh noise;
    folder_.read_into("noise_of_all", noise.turn, noise.smoother_turn);
    const auto [shape, outline] =
        RW::shape_of_tile(folder_.read<RW::Tile>("tile", tile), {tile, plan},
                          folder_.read_neighbours<RW::Tile_border>("border", plan, tile), noise, method_);
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
    folder_.write_of_tile(tile, "shape", corners, shape.mesh.points(), normals, is_wall, shape.own_faces, shape.halo,
                          shape.shared_edges);
    folder_.write_of_tile(tile, "outline", outline);
  }

  RW::Tile_shape read_shape(const RW::Tile_plan& plan, std::size_t tile) const {
    RW::Tile_shape shape;
    RW::internal::Face_corners corners;
    std::vector<Eigen::Vector3d> points, normals;
    std::vector<char> is_wall;
    folder_.read_of_tile_into(tile, "shape", corners, points, normals, is_wall, shape.own_faces, shape.halo,
                              shape.shared_edges);
    shape.mesh = RW::internal::part_of(plan, std::move(corners), std::move(points), std::move(is_wall))
                     .with_shape_normals(std::move(normals));
    return shape;
  }

  void places(std::size_t tile) const {
    std::vector<RW::Tile_place> places;
    if (!seeds_.empty()) {
      const auto plan = read_plan();
      places = RW::places_in_tile(read_shape(plan, tile), plan, seeds_);
    }
    folder_.write_of_tile(tile, "places", places);
  }

  void seeds() const {
    const auto plan = read_plan();
    const auto outlines = folder_.read_all<RW::Tile_outline>("outline");
    folder_.write("seeds", seeds_.empty()
                               ? RW::seeds_of_tiles(plan, outlines, method_)
                               : RW::seeds_of_tiles(plan, outlines, seeds_,
                                                    folder_.read_all<std::vector<RW::Tile_place>>("places")));
  }

  void clusters(std::size_t tile) const {
    const auto plan = read_plan();
    RW::Tile_network network;
    const auto clusters =
        RW::clusters_of_tile(read_shape(plan, tile), {tile, plan}, folder_.read<RW::Tile_border>("border", tile),
                             folder_.read<RW::Tile_seeds>("seeds"), network, method_);
    folder_.write_of_tile(tile, "clusters", clusters);
    folder_.write_of_tile(tile, "network", network);
  }

  void walk() const {
    folder_.write("walk", RW::walk_over_tiles(read_plan(), folder_.read<RW::Tile_seeds>("seeds"),
                                              folder_.read_all<RW::Tile_network>("network"), method_));
  }

  void fragments(std::size_t tile) const {
    const auto plan = read_plan();
    RW::Tile_regions regions;
    const auto fragments = RW::fragments_of_tile({{tile, plan},
                                                  read_shape(plan, tile),
                                                  folder_.read<RW::Tile_clusters>("clusters", tile),
                                                  folder_.read_neighbours<RW::Tile_border>("border", plan, tile),
                                                  folder_.read_neighbours<RW::Tile_network>("network", plan, tile),
                                                  folder_.read<RW::Tile_seeds>("seeds"),
                                                  folder_.read<RW::Tile_walk>("walk")},
                                                 regions);
    folder_.write_of_tile(tile, "fragments", fragments);
    folder_.write_of_tile(tile, "regions", regions);
  }

  void merge() const {
    const auto regions = folder_.read_all<RW::Tile_regions>("regions");
    const auto walk = folder_.read<RW::Tile_walk>("walk");
    const RW::Merge_tree tree =
        seeds_.empty() ? RW::merge_tiles(walk, regions) : RW::Merge_tree(walk.number_of_fragments, {});
    std::vector<double> areas(walk.number_of_fragments, 0.);
    for (const RW::Tile_regions& tile : regions)
      for (std::size_t i = 0; i < tile.fragments.size(); ++i) areas[tile.fragments[i]] += tile.regions[i].size.area;
    std::vector<std::array<Index, 2>> neighbours;  // across walls as well: their colours must differ
    for (const RW::Tile_regions& tile : regions)
      neighbours.insert(neighbours.end(), tile.walls.begin(), tile.walls.end());
    for (const auto& boundary : RW::internal::boundaries_of_tiles(regions)) neighbours.push_back(boundary.regions);
    const std::size_t suggested = seeds_.empty() ? RW::Cost_threshold_stop(1)(tree) : walk.number_of_fragments;
    Tile_segments segments = tile_segments(tree, options_.segments.value_or(suggested), areas, neighbours);
    segments.suggested = suggested;
    segments.components = walk.components;
    const auto seeds = folder_.read<RW::Tile_seeds>("seeds");
    segments.turned_sides = seeds.turned_sides;
    segments.walls = seeds.walls;
    folder_.write("segments", segments);
  }

  const Tile_folder& folder_;
  const Options& options_;
  RW::Tiled_segmentation method_;
  std::vector<RW::Seed_point> seeds_;  // of the user
  std::vector<std::size_t> labels_;    // of these, rising
};

}  // namespace segment_mesh

#endif
