// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_SURFACES_H
#define SEGMENT_MESH_SURFACES_H

// The surfaces of a machine part's segments, as the report and the page have them.

#include "degree.h"

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/regular_surfaces.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <vector>

namespace segment_mesh {

using Json = nlohmann::ordered_json;

/// What `--regular` is given.
struct Regular_option {
  std::optional<double> length;   ///< in the mesh's unit
  std::optional<double> degrees;  ///< of directions
};

/// How far surfaces may be from being regular. Where the user does not tell, three standard errors, and what single
/// precision hides.
/// \param diagonal of the mesh's bounding box
inline RW_segmentation::Regularity_tolerance regularity_tolerance(const Regular_option& option, double diagonal) {
  constexpr double rounding = 1e-7;  // of the diagonal, and in radians
  RW_segmentation::Regularity_tolerance tolerance;
  tolerance.length = option.length.value_or(rounding * diagonal);
  tolerance.angle = option.degrees ? *option.degrees * degree : rounding;
  if (option.length || option.degrees) tolerance.standard_errors = 0;
  return tolerance;
}

/// The type of a surface and the numbers that it has with their standard errors, null where vertices do not tell them; in
/// the coordinates of the mesh; angles are in degrees.
inline Json surface_of(const RW_segmentation::Analytic_surface& surface) {
  using RW_segmentation::Surface_type;
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
  const bool is_angle = snap.regularity == Regularity::parallel || snap.regularity == Regularity::perpendicular ||
                        snap.regularity == Regularity::equal_half_angle;
  return {{"regularity", name_of(snap.regularity)},
          {"labels", {snap.first, snap.second}},
          {"difference", is_angle ? snap.difference / degree : snap.difference}};
}

/// The surfaces by their segments.
inline Json surfaces_of(const std::vector<RW_segmentation::Analytic_surface>& surfaces) {
  Json result = Json::array();
  for (const RW_segmentation::Analytic_surface& surface : surfaces) result.push_back(surface_of(surface));
  return result;
}

inline Json snaps_of(const std::vector<RW_segmentation::Surface_snap>& snaps) {
  Json result = Json::array();
  for (const RW_segmentation::Surface_snap& snap : snaps) result.push_back(snap_of(snap));
  return result;
}

}  // namespace segment_mesh

#endif
