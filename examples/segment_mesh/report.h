// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_REPORT_H
#define SEGMENT_MESH_REPORT_H

#include "../mesh_files/Polygon_soup.h"
#include "Method.h"
#include "Options.h"
#include "Segmentation.h"
#include "close_parts.h"
#include "segments.h"

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/regular_surfaces.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace segment_mesh {

using Json = nlohmann::ordered_json;

/// The type of a surface and the numbers that it has with their standard errors, null where vertices do not tell them; in
/// the coordinates of the mesh; angles are in degrees.
inline Json surface_of(const RW_segmentation::Analytic_surface& surface) {
  using RW_segmentation::Surface_type;
  constexpr double degree = 3.14159265358979323846 / 180;
  const auto vector = [](const auto& v) { return Json{v.x(), v.y(), v.z()}; };
  const RW_segmentation::Surface_errors& errors = surface.errors;
  const double turn = errors.direction / degree;
  Json result, error;
  switch (surface.type) {
    case Surface_type::plane:
      result = {{"type", "plane"}, {"point", vector(surface.point)}, {"normal", vector(surface.direction)}};
      error = {{"point", errors.point}, {"normal", turn}};
      break;
    case Surface_type::sphere:
      result = {{"type", "sphere"}, {"centre", vector(surface.point)}, {"radius", surface.radius}};
      error = {{"centre", errors.point}, {"radius", errors.radius}};
      break;
    case Surface_type::cylinder:
      result = {{"type", "cylinder"}, {"point", vector(surface.point)}, {"axis", vector(surface.direction)}};
      result["radius"] = surface.radius;
      error = {{"point", errors.point}, {"axis", turn}, {"radius", errors.radius}};
      break;
    case Surface_type::cone:
      result = {{"type", "cone"}, {"apex", vector(surface.point)}, {"axis", vector(surface.direction)}};
      result["half_angle"] = surface.half_angle / degree;
      error = {{"apex", errors.point}, {"axis", turn}, {"half_angle", errors.half_angle / degree}};
      break;
    case Surface_type::torus:
      result = {{"type", "torus"}, {"centre", vector(surface.point)}, {"axis", vector(surface.direction)}};
      result["radius"] = surface.radius;
      result["tube_radius"] = surface.tube_radius;
      error = {{"centre", errors.point}, {"axis", turn}, {"radius", errors.radius}};
      error["tube_radius"] = errors.tube_radius;
      break;
    case Surface_type::free_form:
      return {{"type", "free form"}};
  }
  result["residual"] = surface.residual;
  result["errors"] = error;
  return result;
}

/// What two surfaces have in common; differences of directions are in degrees.
inline Json snap_of(const RW_segmentation::Surface_snap& snap) {
  using RW_segmentation::Regularity;
  constexpr double degree = 3.14159265358979323846 / 180;
  const bool is_angle = snap.regularity == Regularity::parallel || snap.regularity == Regularity::perpendicular ||
                        snap.regularity == Regularity::equal_half_angle;
  return {{"regularity", name_of(snap.regularity)},
          {"labels", {snap.first, snap.second}},
          {"difference", is_angle ? snap.difference / degree : snap.difference}};
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
  for (const RW_segmentation::Surface_snap& snap : result.snaps) report["regular"].push_back(snap_of(snap));
  return report;
}

}  // namespace segment_mesh

#endif
