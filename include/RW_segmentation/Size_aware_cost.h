// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_SIZE_AWARE_COST_H
#define RW_SEGMENTATION_SIZE_AWARE_COST_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Region_boundary.h>
#include <RW_segmentation/internal/named_parameters.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// How many times differences count on a mesh with so many edges, at least 1.
///
/// Smoothed normals turn over a width of 0.01 R at a crease, however small faces are. Where the centroids of equilateral
/// triangles, l = sqrt(2 / (sqrt(3) |E|)) R apart, are farther from each other than that, one edge carries all of a
/// crease: that raises the mean, and beside it the crease has l / width times less.
double crease_weight(std::size_t edges);

}  // namespace internal

/// The merge cost that agrees best with people, a model of `MergeCost`: regions that are large, meet along a short and
/// concave boundary and differ in thickness stay apart longest.
///
/// cost = (w D/L + 0.1) * a b / (a + b) * R/L * (1 + 2 min(|s_a - s_b|, 2)) with the mean difference D/L along the common
/// boundary of length L, the areas a and b as fractions of the total area R^2, and the mean logarithms s of the
/// thickness. By the 0.1 sizes and lengths decide where there is no difference at all. The last factor is 1 unless both
/// regions hold three samples of the thickness or more. The weight w is 1 from 11 547 edges on, and l / 0.01 R below, since
/// no crease is narrower than the distance l of the centroids; a cost made without a mesh has 1. Does not depend on the scale
/// of the mesh. Where the difference is a concavity (`smoothed_concavity()`), merging is best stopped at cost 1.
class Size_aware_cost {
 public:
  /// What a region is: sums over its faces.
  struct Region {
    double area = 0;           ///< in units of R^2
    double log_thickness = 0;  ///< over the samples
    double samples = 0;        ///< faces whose thickness is known
  };

  /// Without thickness.
  Size_aware_cost() = default;

  /// With thickness.
  /// \param thickness by face of the dual mesh, how thick the solid is below it, in any unit; not positive where it is not
  /// known; empty: of no face
  /// \param crease_weight w, see above
  explicit Size_aware_cost(std::vector<double> thickness, double crease_weight = 1);

  /// With a stored thickness, as `local_thickness()` writes it.
  ///
  /// \tparam FaceListGraph a model of CGAL's `FaceListGraph`, or a `Dual_mesh_of` one
  /// \tparam ThicknessMap a readable property map from `face_descriptor` to `double`
  /// \param mesh the mesh; no reference to it is kept
  /// \param thickness in any unit; 0 where it is not known
  /// Complexity: linear.
  template <class FaceListGraph, class ThicknessMap,
            std::enable_if_t<!std::is_same_v<FaceListGraph, std::vector<double>>, int> = 0>
  Size_aware_cost(const FaceListGraph& mesh, const ThicknessMap& thickness)
      : Size_aware_cost(internal::dual_mesh(mesh, CGAL::parameters::default_values()), thickness, 0) {}

  /// The region of a single face.
  Region region(const Dual_mesh& mesh, Dual_mesh::Index face) const {
    Region region;
    if (mesh.total_area() > 0) region.area = mesh.area(face) / mesh.total_area();
    const double thickness = thickness_ ? (*thickness_)[face] : 0;
    if (thickness > 0 && std::isfinite(thickness)) {
      region.log_thickness = std::log(thickness);
      region.samples = 1;
    }
    return region;
  }

  /// Adds the sums of another region.
  void join(Region& region, const Region& other) const {
    region.area += other.area;
    region.log_thickness += other.log_thickness;
    region.samples += other.samples;
  }

  /// The cost of merging two regions.
  double operator()(const Region& a, const Region& b, const Region_boundary& boundary) const {
    const auto& [length, difference] = boundary.common;
    const double size = a.area + b.area > 0 ? a.area * b.area / (a.area + b.area) : 0;
    return (crease_weight_ * difference / length + least_difference) * size / length *
           (1 + thickness_weight * thickness_step(a, b));
  }

 private:
  template <class Mesh, class ThicknessMap>
  Size_aware_cost(const Dual_mesh_of<Mesh>& mesh, const ThicknessMap& thickness, int)
      : Size_aware_cost(mesh.read_faces(thickness, [](const auto& t) { return static_cast<double>(t); }),
                        internal::crease_weight(mesh.number_of_edges())) {}

  static constexpr double least_difference = 0.1;
  static constexpr double thickness_weight = 2;
  static constexpr double largest_thickness_step = 2;
  static constexpr double fewest_samples = 3;

  static double thickness_step(const Region& a, const Region& b) {
    if (a.samples < fewest_samples || b.samples < fewest_samples) return 0;
    return std::min(std::abs(a.log_thickness / a.samples - b.log_thickness / b.samples), largest_thickness_step);
  }

  std::shared_ptr<const std::vector<double>> thickness_;  // by face; null: of none
  double crease_weight_ = 1;
};

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Size_aware_cost.h>
#endif

#endif
