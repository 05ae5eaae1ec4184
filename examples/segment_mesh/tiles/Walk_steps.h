// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_WALK_STEPS_H
#define SEGMENT_MESH_TILES_WALK_STEPS_H

#include "../Options.h"
#include "../Oriented_mesh.h"
#include "../check_options.h"
#include "../seeds.h"
#include "../surfaces.h"
#include "../walls.h"
#include "Stored_shape.h"
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

  /// Whether connected parts are segmented each by itself. Seeds of the user are those of the whole.
  bool is_parted() const { return seeds_.empty() && options_.components != Components::whole; }

  std::vector<Tile_step> steps() const {
    return {{"border", true, {"piece_faces", "border", "noise"}, [this](std::size_t tile) { border(tile); }},
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

  /// How many seeds place themselves, which the steps from `shape` on depend on.
  std::size_t automatic_seeds() const { return method_.seeds; }

  /// What makes all steps what they are.
  Json parameters() const { return {{"smoothing", method_.smoothing.radius}}; }

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
    std::size_t clusters = 0, seeds = 0;
    for (const RW::Tile_walk& walk : folder_.read<std::vector<RW::Tile_walk>>("walk")) clusters += walk.clusters;
    for (const RW::Tile_seeds& of_part : folder_.read<std::vector<RW::Tile_seeds>>("seeds"))
      seeds += of_part.seeds.size();
    report["clusters"] = clusters;
    report["seeds"] = seeds;
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

  using Piece = RW::Tile_parts::Piece;

  RW::Tile_parts read_parts() const { return folder_.read<RW::Tile_parts>("parts"); }

  void border(std::size_t tile) const {
    const auto parts = read_parts();
    const auto pieces = folder_.read_pieces(parts, tile);
    std::vector<RW::Tile_border> borders;
    std::vector<RW::Tile_noise> noises(pieces.size());
    for (std::size_t p = 0; p < pieces.size(); ++p)
      borders.push_back(RW::border_of_tile(pieces[p].tile, parts.in_plan(tile, p), noises[p], method_));
    folder_.write_faces_of_pieces(tile, pieces);
    folder_.write_of_tile(tile, "border", borders);
    folder_.write_of_tile(tile, "noise", noises);
  }

  void noise() const {
    std::vector<RW::internal::Noise_of_mesh> noises;
    folder_.for_each_part<RW::Tile_noise>("noise", read_parts(), [&](std::size_t, const auto& of_part) {
      noises.push_back(RW::noise_of_tiles(of_part));
    });
    folder_.write("noise_of_all", noises);
  }

  void shape(std::size_t tile) const {
    const auto parts = read_parts();
    const auto noises = folder_.read<std::vector<RW::internal::Noise_of_mesh>>("noise_of_all");
    const auto pieces = folder_.read_pieces(parts, tile);
    const auto borders = folder_.read_neighbours_of_pieces<RW::Tile_border>("border", parts, tile);
    std::vector<Stored_shape> shapes;
    std::vector<RW::Tile_outline> outlines;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      RW::Shaped_tile shaped = RW::shape_of_tile(pieces[p].tile, parts.in_plan(tile, p), borders[p],
                                                 noises[parts.places[tile][p].part], method_);
      shapes.emplace_back(std::move(shaped.shape));
      outlines.push_back(std::move(shaped.outline));
    }
    folder_.write_of_tile(tile, "shape", shapes);
    folder_.write_of_tile(tile, "outline", outlines);
  }

  /// By piece.
  std::vector<RW::Tile_shape> read_shapes(const RW::Tile_parts& parts, std::size_t tile) const {
    std::vector<RW::Tile_shape> shapes;
    for (Stored_shape& stored : folder_.read<std::vector<Stored_shape>>("shape", tile))
      shapes.push_back(std::move(stored).restored(parts.in_plan(tile, shapes.size()).plan));
    return shapes;
  }

  /// Tiles are one piece each where there are seeds of the user.
  void places(std::size_t tile) const {
    std::vector<RW::Tile_place> places;
    if (!seeds_.empty()) {
      const auto parts = read_parts();
      places = RW::places_in_tile(read_shapes(parts, tile).front(), parts.parts.front().plan, seeds_);
    }
    folder_.write_of_tile(tile, "places", places);
  }

  void seeds() const {
    const auto parts = read_parts();
    const double largest_area = parts.largest_area();
    std::vector<RW::Tile_seeds> seeds;
    folder_.for_each_part<RW::Tile_outline>("outline", parts, [&](std::size_t p, const auto& outlines) {
      const auto& [plan, pieces, area] = parts.parts[p];
      seeds.push_back(seeds_.empty() ? RW::seeds_of_tiles(plan, outlines, method_.of_part(area, largest_area))
                                     : RW::seeds_of_tiles(plan, outlines, seeds_,
                                                          folder_.read_all<std::vector<RW::Tile_place>>("places")));
    });
    folder_.write("seeds", seeds);
  }

  void clusters(std::size_t tile) const {
    const auto parts = read_parts();
    const auto seeds = folder_.read<std::vector<RW::Tile_seeds>>("seeds");
    const auto borders = folder_.read<std::vector<RW::Tile_border>>("border", tile);
    const auto shapes = read_shapes(parts, tile);
    std::vector<RW::Tile_clusters> clusters;
    std::vector<RW::Tile_network> networks(shapes.size());
    for (std::size_t p = 0; p < shapes.size(); ++p)
      clusters.push_back(RW::clusters_of_tile(shapes[p], parts.in_plan(tile, p), borders[p],
                                              seeds[parts.places[tile][p].part], networks[p], method_));
    folder_.write_of_tile(tile, "clusters", clusters);
    folder_.write_of_tile(tile, "network", networks);
  }

  void walk() const {
    const auto parts = read_parts();
    const auto seeds = folder_.read<std::vector<RW::Tile_seeds>>("seeds");
    std::vector<RW::Tile_walk> walks;
    folder_.for_each_part<RW::Tile_network>("network", parts, [&](std::size_t p, const auto& networks) {
      walks.push_back(RW::walk_over_tiles(parts.parts[p].plan, seeds[p], networks, method_));
    });
    folder_.write("walk", walks);
  }

  void fragments(std::size_t tile) const {
    const auto parts = read_parts();
    const auto seeds = folder_.read<std::vector<RW::Tile_seeds>>("seeds");
    const auto walks = folder_.read<std::vector<RW::Tile_walk>>("walk");
    const auto clusters = folder_.read<std::vector<RW::Tile_clusters>>("clusters", tile);
    const auto borders = folder_.read_neighbours_of_pieces<RW::Tile_border>("border", parts, tile);
    const auto networks = folder_.read_neighbours_of_pieces<RW::Tile_network>("network", parts, tile);
    const auto shapes = read_shapes(parts, tile);
    std::vector<RW::Tile_regions> regions(shapes.size());
    std::vector<std::vector<Index>> fragments;  // by piece and face
    for (std::size_t p = 0; p < shapes.size(); ++p) {
      const std::size_t part = parts.places[tile][p].part;
      fragments.push_back(RW::fragments_of_tile(
          {parts.in_plan(tile, p), shapes[p], clusters[p], borders[p], networks[p], seeds[part], walks[part]},
          regions[p]));
    }
    folder_.write_of_tile(tile, "fragments", fragments);
    folder_.write_of_tile(tile, "regions", regions);
  }

  void merge() const {
    const auto parts = read_parts();
    const auto walks = folder_.read<std::vector<RW::Tile_walk>>("walk");
    Merged_parts merged(parts);
    folder_.for_each_part<RW::Tile_regions>("regions", parts, [&](std::size_t p, const auto& regions) {
      merged.add_part(seeds_.empty() ? RW::merge_tiles(walks[p], regions)
                                     : RW::Merge_tree(walks[p].number_of_fragments, {}));
      for (const RW::Tile_regions& piece : regions) {
        for (std::size_t i = 0; i < piece.fragments.size(); ++i)
          merged.add_area(piece.fragments[i], piece.regions[i].size.area);
        merged.add_neighbours(piece.walls);  // their colours must differ as well
      }
      for (const auto& boundary : RW::internal::boundaries_of_tiles(regions)) merged.add_neighbours({boundary.regions});
    });
    const RW::Merge_tree tree = merged.tree();
    const std::size_t suggested = seeds_.empty() ? RW::Cost_threshold_stop(1)(tree) : tree.number_of_fragments();
    Tile_segments segments = merged.segments(tree, options_.segments.value_or(suggested));
    segments.suggested = suggested;
    segments.components = 0;
    for (const RW::Tile_walk& walk : walks) segments.components += walk.components;
    for (const RW::Tile_seeds& seeds : folder_.read<std::vector<RW::Tile_seeds>>("seeds")) {
      segments.turned_sides += seeds.turned_sides;
      segments.walls += seeds.walls;
    }
    folder_.write("segments", segments, merging_in_words(options_));
  }

  const Tile_folder& folder_;
  const Options& options_;
  RW::Tiled_segmentation method_;
  std::vector<RW::Seed_point> seeds_;  // of the user
  std::vector<std::size_t> labels_;    // of these, rising
};

}  // namespace segment_mesh

#endif
