// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_BOUNDARIES_OF_TILES_H
#define RW_SEGMENTATION_TEST_BOUNDARIES_OF_TILES_H

// How smooth boundaries go on from tile to tile, and whether tiles meet vertex by vertex.

#include <RW_segmentation/Boundary_curve.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

namespace boundaries_of_tiles {

using Place = std::array<double, 3>;
using Turns = std::map<Place, double>;  // in radians

template <class Point>
Place place_of(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

template <class Point>
Eigen::Vector3d vector_to(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

/// From a point of a curve to the first one that is as far away in one direction, or to the end.
template <class Mesh>
Eigen::Vector3d way_from(const RW_segmentation::Boundary_curve<Mesh>& curve, std::size_t start, bool is_forward,
                         double distance) {
  const std::size_t size = curve.points.size();
  const Eigen::Vector3d from = vector_to(curve.points[start].point);
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k < size && way.norm() < distance; ++k) {
    if (!curve.is_closed && (is_forward ? start + k >= size : k > start)) break;
    way = vector_to(curve.points[(is_forward ? start + k : start + size - k) % size].point) - from;
  }
  return way;
}

/// The turn of a curve between the way that it comes and the way that it goes, seen from the point in between.
inline double turn_between(const Eigen::Vector3d& back, const Eigen::Vector3d& forth) {
  return std::acos(std::clamp(-back.normalized().dot(forth.normalized()), -1., 1.));
}

/// The turns between points at a distance on both sides of the places where boundaries of two tiles end, and no third one.
/// \param curves by tile
template <class Mesh>
Turns turns_at_borders(const std::vector<std::vector<RW_segmentation::Boundary_curve<Mesh>>>& curves, double distance) {
  std::map<Place, std::vector<Eigen::Vector3d>> ways;
  for (const auto& of_tile : curves)
    for (const auto& curve : of_tile) {
      if (curve.is_closed) continue;
      for (const bool is_first : {true, false}) {
        const std::size_t end = is_first ? 0 : curve.points.size() - 1;
        ways[place_of(curve.points[end].point)].push_back(way_from(curve, end, is_first, distance));
      }
    }
  Turns turns;
  for (const auto& [place, directions] : ways)
    if (directions.size() == 2) turns[place] = turn_between(directions[0], directions[1]);
  return turns;
}

/// The open sides of all tiles, each in the direction of its open halfedge, that no tile has in the opposite direction.
template <class Mesh>
std::size_t open_sides(const std::vector<Mesh>& tiles) {
  std::map<std::array<Place, 2>, int> surplus;
  for (const Mesh& mesh : tiles)
    for (const auto h : mesh.halfedges()) {
      if (!mesh.is_border(h)) continue;
      const Place from = place_of(mesh.point(mesh.source(h))), to = place_of(mesh.point(mesh.target(h)));
      ++surplus[{from, to}];
      --surplus[{to, from}];
    }
  return static_cast<std::size_t>(
      std::count_if(surplus.begin(), surplus.end(), [](const auto& side) { return side.second > 0; }));
}

}  // namespace boundaries_of_tiles

#endif
