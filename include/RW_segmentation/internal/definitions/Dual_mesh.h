// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_DUAL_MESH_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_DUAL_MESH_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/threads.h>
#include <RW_segmentation/internal/unit_vector.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

RW_SEGMENTATION_INLINE Unit_box::Unit_box(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  if (box.isEmpty()) return;
  origin = box.min() / 2 + box.max() / 2;
  const Eigen::Vector3d half = box.max() / 2 - box.min() / 2;
  const double diagonal = 2 * std::hypot(half.x(), half.y(), half.z());
  if (diagonal >= std::numeric_limits<double>::min()) unit = std::min(diagonal, std::numeric_limits<double>::max());
  const double largest_coordinate = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  rounding = std::numeric_limits<double>::epsilon() * (1 + largest_coordinate * (1 / unit));
}

RW_SEGMENTATION_INLINE std::size_t first_not_finite(const std::vector<Eigen::Vector3d>& vectors) {
  const auto bad =
      std::find_if(vectors.begin(), vectors.end(), [](const Eigen::Vector3d& vector) { return !vector.allFinite(); });
  return static_cast<std::size_t>(bad - vectors.begin());
}

RW_SEGMENTATION_INLINE std::invalid_argument point_error(std::size_t place) {
  return std::invalid_argument("vertex " + std::to_string(place) + " has a coordinate that is not finite");
}

RW_SEGMENTATION_INLINE std::invalid_argument normal_error(std::size_t place, const Eigen::Vector3d& normal) {
  return argument_error(("the normal of face " + std::to_string(place)).c_str(), normal.transpose(), "finite");
}

RW_SEGMENTATION_INLINE void normalize(std::vector<Eigen::Vector3d>& vectors) {
  for (Eigen::Vector3d& vector : vectors) vector = unit_vector(vector);
}

RW_SEGMENTATION_INLINE Face_measures measures_of(const std::vector<Eigen::Vector3d>& point,
                                                 const Face_corners::Range& corners, double rounding) {
  const Eigen::Vector3d& apex = point[corners[0]];
  Eigen::Vector3d area_vector = Eigen::Vector3d::Zero(), previous = area_vector;  // relative to the apex
  double squared_extent = 0;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Eigen::Vector3d corner = point[corners[k]] - apex;
    area_vector += previous.cross(corner) / 2;
    squared_extent = std::max(squared_extent, corner.squaredNorm());
    previous = corner;
  }
  const double area = area_vector.norm();
  // A face that is no higher than its corners are exact has no direction.
  const bool degenerate = !(area > 4 * rounding * std::sqrt(squared_extent));
  return {degenerate ? Eigen::Vector3d::Zero() : Eigen::Vector3d(area_vector / area), area};
}

RW_SEGMENTATION_INLINE Face_geometry::Face_geometry(const std::vector<Eigen::Vector3d>& point,
                                                    const Face_corners& corners,
                                                    const std::vector<std::array<std::uint32_t, 2>>& edge_ends,
                                                    double rounding)
    : area(corners.number_of_faces()), edge_length(edge_ends.size()) {
  std::atomic<std::size_t> degenerate = 0;
  parallel_stretches(area.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Face_measures measures = measures_of(point, corners[static_cast<std::uint32_t>(f)], rounding);
      area[f] = measures.area;
      if (measures.normal.isZero(0)) ++degenerate;
    }
  });
  degenerate_faces = degenerate;
  parallel_stretches(edge_length.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) edge_length[e] = (point[edge_ends[e][1]] - point[edge_ends[e][0]]).norm();
  });

  for (const double a : area) total_area += a;
  for (const double length : edge_length) mean_edge_length += length;
  if (!edge_length.empty()) mean_edge_length /= static_cast<double>(edge_length.size());
}

RW_SEGMENTATION_INLINE std::vector<Eigen::Vector3d> own_normals(const Dual_mesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.number_of_faces());
  parallel_stretches(normals.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) normals[f] = mesh.normal(static_cast<Dual_mesh::Index>(f));
  });
  return normals;
}

RW_SEGMENTATION_INLINE Dual_mesh in_box_of(const Dual_mesh& other, Dual_mesh::Arrays arrays,
                                           const std::vector<Dual_mesh::Index>& face) {
  Unit_box box;
  box.unit = other.unit();
  box.origin = other.origin();
  box.rounding = other.rounding();
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(face.size());
  for (const Dual_mesh::Index f : face) normals.push_back(other.shape_normal(f));
  return Dual_mesh(std::move(arrays), &box).with_shape_normals(std::move(normals));
}

RW_SEGMENTATION_INLINE Dual_mesh with_stored_normals(const Dual_mesh& mesh) {
  return mesh.has_shape_normals() ? mesh : mesh.with_shape_normals(own_normals(mesh));
}

/// Numbers for the vertices of a connected component, in the order in which they are asked for.
class Vertex_numbers {
 public:
  using Index = Dual_mesh::Index;

  Vertex_numbers(const Dual_mesh& mesh, const Mesh_stretch& component) {
    std::size_t corners = 0;
    Index last = 0;
    for (Index f = component.first_face; f < component.first_face + component.faces; ++f)
      for (const Index vertex : mesh.corners(f)) {
        ++corners;
        last = std::max(last, vertex);
      }
    const auto span = static_cast<Index>(std::min<std::size_t>(corners, last + std::size_t(1)));
    first_ = last - span + 1;
    number_.assign(span, none);
  }

  Index operator[](Index vertex) {
    Index& number =
        vertex >= first_ ? number_[vertex - first_] : number_of_shared_.try_emplace(vertex, none).first->second;
    if (number == none) {
      number = static_cast<Index>(vertices_.size());
      vertices_.push_back(vertex);
    }
    return number;
  }

  /// By number.
  const std::vector<Index>& vertices() const { return vertices_; }

 private:
  static constexpr Index none = std::numeric_limits<Index>::max();

  Index first_ = 0;
  std::vector<Index>
      number_;  // of the vertices from `first_` on: of all but those that an earlier component has as well
  std::unordered_map<Index, Index> number_of_shared_;
  std::vector<Index> vertices_;
};

}  // namespace internal

RW_SEGMENTATION_INLINE Dual_mesh::Dual_mesh(Arrays arrays, const internal::Unit_box* points_in_box) {
  box_ = points_in_box ? *points_in_box : internal::Unit_box(arrays.points);
  if (!points_in_box)
    for (Eigen::Vector3d& p : arrays.points) p = box_.scaled(p);
  geometry_ =
      std::make_shared<const internal::Face_geometry>(arrays.points, arrays.corners, arrays.edge_ends, box_.rounding);
  arrays_ = std::make_shared<const Arrays>(std::move(arrays));
  points_ = {arrays_, &arrays_->points};
  is_wall_ = {arrays_, &arrays_->is_wall};
}

RW_SEGMENTATION_INLINE Eigen::Vector3d Dual_mesh::normal(Index face) const {
  return internal::measures_of(*points_, corners(face), box_.rounding).normal;
}

RW_SEGMENTATION_INLINE Dual_mesh Dual_mesh::with_shape_normals(std::vector<Eigen::Vector3d> normals) const {
  Dual_mesh result = *this;
  result.shape_normals_ = std::make_shared<const std::vector<Eigen::Vector3d>>(std::move(normals));
  return result;
}

RW_SEGMENTATION_INLINE Dual_mesh Dual_mesh::with_shape_normals_of(const Dual_mesh& other) const {
  Dual_mesh result = *this;
  result.shape_normals_ = internal::with_stored_normals(other).shape_normals_;
  return result;
}

RW_SEGMENTATION_INLINE Dual_mesh Dual_mesh::with_points(std::vector<Eigen::Vector3d> points) const {
  Dual_mesh result = *this;
  result.points_ = std::make_shared<const std::vector<Eigen::Vector3d>>(std::move(points));
  result.geometry_ = std::make_shared<const internal::Face_geometry>(*result.points_, arrays_->corners,
                                                                     arrays_->edge_ends, box_.rounding);
  result.shape_normals_ = nullptr;
  return result;
}

RW_SEGMENTATION_INLINE Dual_mesh Dual_mesh::with_walls(std::vector<char> is_wall) const {
  Dual_mesh result = *this;
  result.is_wall_ = std::make_shared<const std::vector<char>>(std::move(is_wall));
  return result;
}

RW_SEGMENTATION_INLINE Dual_mesh Dual_mesh::as_part_of(double area_of_whole) const {
  Dual_mesh result = *this;
  result.is_part_ = true;
  result.area_of_whole_ = area_of_whole;
  return result;
}

RW_SEGMENTATION_INLINE Dual_mesh::Arrays Dual_mesh::arrays_of(const internal::Mesh_stretch& components) const {
  const auto& [first_face, faces, first_edge, edges] = components;
  Arrays arrays;
  internal::Vertex_numbers numbers(*this, components);
  arrays.corners.reserve(faces, std::size_t(3) * faces);
  for (Index f = first_face; f < first_face + faces; ++f) {
    for (const Index vertex : corners(f)) arrays.corners.add(numbers[vertex]);
    arrays.corners.end_face();
  }
  std::vector<std::array<Index, 2>> sides;
  sides.reserve(edges);
  arrays.edge_ends.reserve(edges);
  for (Index e = first_edge; e < first_edge + edges; ++e) {
    const auto& [f, g] = graph().faces_of(e);
    sides.push_back({f - first_face, g - first_face});
    arrays.edge_ends.push_back({numbers[ends(e)[0]], numbers[ends(e)[1]]});
  }
  for (const Index vertex : numbers.vertices()) arrays.points.push_back(point(vertex));
  arrays.graph = Dual_graph(faces, std::move(sides));
  if (has_walls()) arrays.is_wall.assign(is_wall_->begin() + first_edge, is_wall_->begin() + first_edge + edges);
  return arrays;
}

RW_SEGMENTATION_INLINE Dual_mesh Dual_mesh::with_shape_normals_of(const internal::Mesh_stretch& components,
                                                                  const Dual_mesh& whole) const {
  if (!whole.has_shape_normals()) return *this;
  const auto begin = whole.shape_normals_->begin() + components.first_face;
  return with_shape_normals({begin, begin + components.faces});
}

RW_SEGMENTATION_INLINE Dual_mesh Dual_mesh::component(const internal::Mesh_stretch& component) const {
  Arrays arrays = arrays_of(component);
  internal::Unit_box box(arrays.points);
  for (Eigen::Vector3d& p : arrays.points) p = box.scaled(p);
  box.rounding = std::max(box.rounding, box_.rounding / box.unit);
  box.origin = box_.origin + box_.unit * box.origin;
  box.unit *= box_.unit;
  return Dual_mesh(std::move(arrays), &box).with_shape_normals_of(component, *this);
}

RW_SEGMENTATION_INLINE Dual_mesh Dual_mesh::components_in_place(const internal::Mesh_stretch& components) const {
  return Dual_mesh(arrays_of(components), &box_).with_shape_normals_of(components, *this);
}

}  // namespace RW_segmentation

#endif
