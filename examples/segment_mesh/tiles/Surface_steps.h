// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_SURFACE_STEPS_H
#define SEGMENT_MESH_TILES_SURFACE_STEPS_H

#include "../Options.h"
#include "../surfaces.h"
#include "../walls.h"
#include "Tile_folder.h"
#include "Tile_segments.h"
#include "Tile_step.h"

#include <RW_segmentation/regular_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/tiled_surfaces.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace segment_mesh {

/// The steps that find the surfaces of tiles, from their borders to the segments.
class Surface_steps {
 public:
  /// Keeps references to both.
  Surface_steps(const Tile_folder& folder, const Options& options) : folder_(folder), options_(options) {}

  std::vector<Tile_step> steps() const {
    return {{"border", true, {"piece_faces", "border", "noise"}, [this](std::size_t tile) { border(tile); }},
            {"noise", false, {"noise_of_all"}, [this](std::size_t) { noise(); }},
            {"surfaces", true, {"fragments", "regions"}, [this](std::size_t tile) { surfaces(tile); }},
            {"merge", false, {"surfaces", "segments"}, [this](std::size_t) { merge(); }}};
  }

  /// What makes all steps what they are.
  Json parameters() const {
    return {{"engineering", true}, {"noise", options_.noise ? Json(*options_.noise) : Json(nullptr)}};
  }

  /// Adds what is known at the end.
  void complete(Json& report) const {
    const Json surfaces = Json::parse(folder_.read<std::string>("surfaces"));
    report["noise"] = surfaces["noise"];
    if (!surfaces["regular"].empty()) report["regular"] = surfaces["regular"];
    for (Json& segment : report["segments"])
      segment["surface"] = surfaces["surfaces"].at(segment["label"].get<std::size_t>());
  }

 private:
  using Index = RW::Dual_mesh::Index;

  RW::Tile_parts read_parts() const { return folder_.read<RW::Tile_parts>("parts"); }

  void border(std::size_t tile) const {
    const auto parts = read_parts();
    const auto pieces = folder_.read_pieces(parts, tile);
    std::vector<RW::Tile_border> borders;
    std::vector<RW::Tile_neighbourhoods> neighbourhoods(pieces.size());
    for (std::size_t p = 0; p < pieces.size(); ++p)
      borders.push_back(
          RW::border_of_tile(pieces[p].tile, parts.in_plan(tile, p), neighbourhoods[p], RW::Tiled_surfaces()));
    folder_.write_faces_of_pieces(tile, pieces);
    folder_.write_of_tile(tile, "border", borders);
    folder_.write_of_tile(tile, "noise", neighbourhoods);
  }

  void noise() const {
    const auto parts = read_parts();
    RW::Tiled_surfaces method;
    if (options_.noise) method.noise = *options_.noise / parts.box.unit;
    folder_.write("noise_of_all",
                  RW::noise_of_parts(parts, folder_.read_all<std::vector<RW::Tile_neighbourhoods>>("noise"), method));
  }

  void surfaces(std::size_t tile) const {
    const auto parts = read_parts();
    const auto noise = folder_.read<RW::Surface_noise>("noise_of_all");
    const auto pieces = folder_.read_pieces(parts, tile);
    const auto borders = folder_.read_neighbours_of_pieces<RW::Tile_border>("border", parts, tile);
    RW::Tiled_surfaces method;
    method.wall_angle = wall_angle_of(options_);
    std::vector<RW::Tile_surfaces> regions(pieces.size());
    std::vector<std::vector<Index>> fragments;  // by piece and face
    for (std::size_t p = 0; p < pieces.size(); ++p)
      fragments.push_back(RW::surfaces_of_tile(pieces[p].tile, parts.in_plan(tile, p), borders[p],
                                               noise.in_part(parts, parts.places[tile][p].part), regions[p], method));
    folder_.write_of_tile(tile, "fragments", fragments);
    folder_.write_of_tile(tile, "regions", regions);
  }

  void merge() const {
    const auto parts = read_parts();
    const auto noise = folder_.read<RW::Surface_noise>("noise_of_all");
    Merged_parts all(parts);
    std::vector<RW::Part_surfaces> surfaces;
    std::size_t turned_sides = 0, walls = 0;
    folder_.for_each_part<RW::Tile_surfaces>("regions", parts, [&](std::size_t p, auto of_part) {
      auto& [regions, merged] = surfaces.emplace_back();
      regions = std::move(of_part);
      merged = RW::merge_tiles(parts.parts[p].plan, noise.in_part(parts, p), regions);
      all.add_part(merged.tree);
      all.add_neighbours(merged.neighbours);
      for (std::size_t i = 0; i < regions.size(); ++i) {
        for (std::size_t r = 0; r < regions[i].areas.size(); ++r)
          all.add_area(merged.fragments[i][r], regions[i].areas[r]);
        all.set_numbers(parts.parts[p].pieces[i], merged.fragments[i]);
      }
      turned_sides += merged.turned_sides;
      walls += merged.walls;
    });
    const RW::Merge_tree tree = all.tree();
    const std::size_t suggested = RW::Cost_threshold_stop(RW::Surface_segmentation().stop_cost)(tree);
    Tile_segments segments = all.segments(tree, options_.segments.value_or(suggested));
    segments.suggested = suggested;
    segments.turned_sides = turned_sides;
    segments.walls = walls;
    folder_.write("surfaces", surfaces_in_words(parts, noise, surfaces, segments));
    folder_.write("segments", segments, merging_in_words(options_));
  }

  /// What the report tells of the surfaces.
  std::string surfaces_in_words(const RW::Tile_parts& parts, const RW::Surface_noise& noise,
                                const std::vector<RW::Part_surfaces>& of_parts, const Tile_segments& segments) const {
    const std::vector<std::size_t> segment(segments.of_fragment.begin(), segments.of_fragment.end());
    std::vector<RW::Analytic_surface> surfaces =
        RW::surfaces_of_parts(parts, noise, of_parts, segment, segments.area.size());
    Json result = {{"noise", noise.deviation * parts.box.unit}, {"regular", Json::array()}};
    if (options_.is_regular) {
      const auto tolerance = regularity_tolerance({options_.regular_length, options_.regular_angle}, parts.box.unit);
      RW::Regular_surfaces regular = RW::regular_surfaces(surfaces, tolerance);
      surfaces = std::move(regular.surfaces);
      result["regular"] = snaps_of(regular.snaps);
    }
    result["surfaces"] = surfaces_of(surfaces);
    return result.dump();
  }

  const Tile_folder& folder_;
  const Options& options_;
};

}  // namespace segment_mesh

#endif
