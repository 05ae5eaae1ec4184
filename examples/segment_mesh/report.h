// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_REPORT_H
#define SEGMENT_MESH_REPORT_H

#include "../mesh_files/Polygon_soup.h"
#include "Method.h"
#include "Options.h"
#include "Segmentation.h"
#include "close_parts.h"
#include "segments.h"
#include "surfaces.h"

#include <RW_segmentation/regular_surfaces.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace segment_mesh {

/// JSON as one line. Bytes of names that are no UTF-8 become U+FFFD.
inline std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// The numbers and the names of what segments are made by. Surfaces have none.
inline Json parameters_of(const Options& options, const Method& method) {
  Json parameters = Json::object();
  if (options.is_engineering) return parameters;
  parameters["difference"] = name_of(difference_names, method.difference);
  if (method.difference == Difference::curvature) {
    parameters["radius"] = method.radius.value();
  } else {
    parameters["convex_weight"] = method.angles.convex_weight;
    parameters["measure"] = name_of(measure_names, method.angles.measure);
  }
  parameters["smoothing"] = method.smoothing.radius;
  parameters["sigma"] = method.sigma;
  parameters["cap"] = method.cap;
  if (options.merges() || options.is_coarse) parameters["components"] = name_of(components_names, method.components);
  if (options.merges() || options.is_coarse) parameters["seeding"] = name_of(seeding_names, method.seeding);
  parameters["solver"] = name_of(solver_names, method.solver);
  if (options.merges()) parameters["merge_cost"] = name_of(merge_cost_names, method.merge_cost);
  if (options.merges()) parameters["seedings"] = method.seedings;
  return parameters;
}

/// Adds what closing the parts has come to.
inline void add_closed_parts(Json& report, const Closed_parts& closed) {
  for (Json& segment : report["segments"]) {
    const Closed_part& part = closed.parts.at(segment["label"].get<std::size_t>());
    segment["caps"] = part.caps;
    segment["closed"] = part.is_closed;
    if (part.is_closed) segment["volume"] = part.volume;
  }
}

/// \param left_out_faces how many faces of the file the mesh lacks; they count in the segments whose labels they get
inline Json report_of(const std::string& mesh, const mesh_files::Polygon_soup& soup,
                      const std::vector<std::string>& remarks, std::size_t left_out_faces, Json parameters,
                      const Segmentation& result, const std::vector<Segment>& segments, const Json& milliseconds) {
  Json report = {{"mesh", mesh},
                 {"vertices", soup.points.size()},
                 {"faces", soup.number_of_faces()},
                 {"left_out_faces", left_out_faces},
                 {"repairs", remarks},
                 {"degenerate_faces", result.degenerate_faces},
                 {"walls", result.walls},
                 {"unseeded_components", result.unseeded_components},
                 {"island_faces", result.island_faces},
                 {"heavy_noise", result.has_heavy_noise},
                 {"seeds", result.seeds},
                 {"parameters", std::move(parameters)},
                 {"segments", Json::array()},
                 {"milliseconds", milliseconds},
                 {"version", version()}};
  for (std::size_t i = 0; i < soup.parts.size(); ++i) {
    const std::size_t first = soup.parts[i].first_face;
    const std::size_t end = i + 1 < soup.parts.size() ? soup.parts[i + 1].first_face : soup.number_of_faces();
    report["parts"].push_back({{"name", soup.parts[i].name}, {"first_face", first}, {"faces", end - first}});
  }
  for (const Segment& s : segments)
    report["segments"].push_back({{"label", s.label}, {"faces", s.faces}, {"area_share", s.area}, {"color", s.color}});
  if (!result.fragment.empty() && result.surfaces.empty()) report["levels"] = result.tree.levels(result.suggested);
  if (!result.surfaces.empty())
    for (Json& segment : report["segments"])
      segment["surface"] = surface_of(result.surfaces[segment["label"].get<std::size_t>()]);
  if (!result.surfaces.empty()) report["noise"] = result.noise;
  if (!result.snaps.empty()) report["regular"] = snaps_of(result.snaps);
  return report;
}

}  // namespace segment_mesh

#endif
