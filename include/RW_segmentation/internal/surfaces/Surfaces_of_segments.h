// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_SURFACES_OF_SEGMENTS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_SURFACES_OF_SEGMENTS_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Analytic_surface_cost.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Surface_samples.h>
#include <RW_segmentation/internal/merging/Region_merging.h>
#include <RW_segmentation/internal/surfaces/Measured_surface.h>
#include <RW_segmentation/internal/surfaces/Surface_choice.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The vertices of each segment in ascending order.
inline std::vector<std::vector<Dual_mesh::Index>> vertices_of_segments(
    const Dual_mesh& mesh, const std::vector<std::vector<Dual_mesh::Index>>& faces) {
  std::vector<std::vector<Dual_mesh::Index>> vertices;
  for (const auto& of_segment : faces) {
    std::vector<Dual_mesh::Index> corners;
    for (const Dual_mesh::Index f : of_segment)
      for (const Dual_mesh::Index v : mesh.corners(f)) corners.push_back(v);
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    vertices.push_back(std::move(corners));
  }
  return vertices;
}

inline std::vector<Eigen::Vector3d> points_at(const Dual_mesh& mesh, const std::vector<Dual_mesh::Index>& vertices) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(vertices.size());
  for (const Dual_mesh::Index v : vertices) points.push_back(mesh.point(v));
  return points;
}

/// Finds the surfaces of segments in the unit box.
class Surfaces_of_segments {
 public:
  Surfaces_of_segments(const Dual_mesh& mesh, const std::vector<std::size_t>& segment_of_face,
                       std::size_t number_of_segments, const Surface_tolerance& tolerance)
      : mesh_(mesh), tolerance_(tolerance), cost_(mesh, tolerance, most_samples), faces_(number_of_segments) {
    for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f) faces_[segment_of_face[f]].push_back(f);
    vertices_ = vertices_of_segments(mesh, faces_);
    const auto regions = join_faces(segment_of_face, number_of_segments, cost_,
                                    [&](Dual_mesh::Index f) { return cost_.region(mesh, f); });
    for (const auto& region : regions) {
      samples_.push_back(cost_.samples_of(region));
      surfaces_.push_back(cost_.surface_of(region));
    }
  }

  std::vector<Analytic_surface> surfaces() {
    for (std::size_t s = 0; s < surfaces_.size(); ++s)
      if (surfaces_[s].type == Surface_type::free_form) look_beside_strays(s);
    const std::vector<Analytic_surface> neighbours = surfaces_;
    for (std::size_t s = 0; s < surfaces_.size(); ++s)
      if (surfaces_[s].type == Surface_type::sphere) let_neighbours_decide(s, neighbours);
    for (std::size_t s = 0; s < surfaces_.size(); ++s)
      surfaces_[s] = measured_surface(surfaces_[s], points_at(mesh_, vertices_[s]));
    return surfaces_;
  }

 private:
  static constexpr std::size_t most_samples = 500;  // vertices of a segment

  void look_beside_strays(std::size_t segment) {
    constexpr std::size_t few_samples = 80;  // enough, and several fits of all are not cheap
    constexpr double share = 0.95;           // of the area
    const Analytic_surface surface = surface_beside_strays(few_of(samples_[segment], few_samples), tolerance_.distance);
    if (surface.type != Surface_type::free_form && area_on(surface, segment) >= share * area_of(segment))
      surfaces_[segment] = surface;
  }

  double area_of(std::size_t segment) const {
    double area = 0;
    for (const Dual_mesh::Index f : faces_[segment]) area += mesh_.area(f);
    return area;
  }

  /// Of the faces of a segment whose corners are all on a surface.
  double area_on(const Analytic_surface& surface, std::size_t segment) const {
    double area = 0;
    for (const Dual_mesh::Index f : faces_[segment]) {
      const auto corners = mesh_.corners(f);
      if (std::all_of(corners.begin(), corners.end(), [&](Dual_mesh::Index v) {
            return std::abs(surface.signed_distance(mesh_.point(v))) <= tolerance_.largest_distance();
          }))
        area += mesh_.area(f);
    }
    return area;
  }

  /// Chamfers and drilled holes have vertices on two circles, which a sphere passes through as well as a cylinder or a
  /// cone. A sphere is believed if it joins a neighbour smoothly.
  void let_neighbours_decide(std::size_t segment, const std::vector<Analytic_surface>& neighbours) {
    const auto straight = straight_alternative(samples_[segment], tolerance_.distance);
    if (!straight) return;
    for (std::size_t s = 0; s < neighbours.size(); ++s) {
      if (s == segment) continue;
      std::vector<Dual_mesh::Index> common;
      std::set_intersection(vertices_[s].begin(), vertices_[s].end(), vertices_[segment].begin(),
                            vertices_[segment].end(), std::back_inserter(common));
      if (are_smoothly_joined(surfaces_[segment], neighbours[s], points_at(mesh_, common))) return;
    }
    surfaces_[segment] = *straight;
  }

  static Surface_samples few_of(Surface_samples samples, std::size_t most) {
    samples.points.resize(std::min(samples.points.size(), most));
    samples.normals.resize(std::min(samples.normals.size(), most));
    samples.normal_points.resize(samples.normals.size());
    return samples;
  }

  const Dual_mesh& mesh_;
  const Surface_tolerance& tolerance_;
  const Analytic_surface_cost cost_;
  std::vector<std::vector<Dual_mesh::Index>> faces_, vertices_;  // of each segment
  std::vector<Surface_samples> samples_;
  std::vector<Analytic_surface> surfaces_;
};

}  // namespace RW_segmentation::internal

#endif
