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
    return {{"border", true, {"border", "noise"}, [this](std::size_t tile) { border(tile); }},
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

  RW::Tile_plan read_plan() const { return folder_.read<RW::Tile_plan>("plan"); }

  void border(std::size_t tile) const {
    RW::Tile_neighbourhoods neighbourhoods;
    const auto border = RW::border_of_tile(folder_.read<RW::Tile>("tile", tile), {tile, read_plan()}, neighbourhoods,
                                           RW::Tiled_surfaces());
    folder_.write_of_tile(tile, "border", border);
    folder_.write_of_tile(tile, "noise", neighbourhoods);
  }

  void noise() const {
    const auto plan = read_plan();
    RW::Tiled_surfaces method;
    if (options_.noise) method.noise = *options_.noise / plan.box.unit;
    folder_.write("noise_of_all", RW::noise_of_tiles(plan, folder_.read_all<RW::Tile_neighbourhoods>("noise"), method));
  }

  void surfaces(std::size_t tile) const {
    const auto plan = read_plan();
    RW::Tile_surfaces regions;
    RW::Tiled_surfaces method;
    method.wall_angle = wall_angle_of(options_);
    const auto fragments = RW::surfaces_of_tile(folder_.read<RW::Tile>("tile", tile), {tile, plan},
                                                folder_.read_neighbours<RW::Tile_border>("border", plan, tile),
                                                folder_.read<RW::Surface_noise>("noise_of_all"), regions, method);
    folder_.write_of_tile(tile, "fragments", fragments);
    folder_.write_of_tile(tile, "regions", regions);
  }

  void merge() const {
    const auto plan = read_plan();
    const auto noise = folder_.read<RW::Surface_noise>("noise_of_all");
    const auto regions = folder_.read_all<RW::Tile_surfaces>("regions");
    const RW::Merged_surfaces merged = RW::merge_tiles(plan, noise, regions);
    std::vector<double> areas(merged.tree.number_of_fragments(), 0.);
    for (std::size_t t = 0; t < regions.size(); ++t)
      for (std::size_t r = 0; r < regions[t].areas.size(); ++r) areas[merged.fragments[t][r]] += regions[t].areas[r];
    const std::size_t suggested = RW::Cost_threshold_stop(RW::Surface_segmentation().stop_cost)(merged.tree);
    Tile_segments segments =
        tile_segments(merged.tree, options_.segments.value_or(suggested), areas, merged.neighbours);
    segments.suggested = suggested;
    segments.numbers = merged.fragments;
    segments.turned_sides = merged.turned_sides;
    segments.walls = merged.walls;
    folder_.write("surfaces", surfaces_in_words(plan, noise, regions, merged, segments));
    folder_.write("segments", segments);
  }

  /// What the report tells of the surfaces.
  std::string surfaces_in_words(const RW::Tile_plan& plan, const RW::Surface_noise& noise,
                                const std::vector<RW::Tile_surfaces>& regions, const RW::Merged_surfaces& merged,
                                const Tile_segments& segments) const {
    const std::vector<std::size_t> segment(segments.of_fragment.begin(), segments.of_fragment.end());
    std::vector<RW::Analytic_surface> surfaces =
        RW::surfaces_of_tiles(plan, noise, regions, merged, segment, segments.area.size());
    Json result = {{"noise", noise.deviation * plan.box.unit}, {"regular", Json::array()}};
    if (options_.is_regular) {
      const auto tolerance = regularity_tolerance({options_.regular_length, options_.regular_angle}, plan.box.unit);
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
