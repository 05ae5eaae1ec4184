// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MERGING_MERGE_FEATURES_H
#define RW_SEGMENTATION_INTERNAL_MERGING_MERGE_FEATURES_H

#include <RW_segmentation/Dual_mesh.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RW_segmentation::internal {

/// What is ordinary on a mesh: means over its edges, and what follows from their number.
struct Mean_concavity {
  double turn = 0;           ///< of the inward turns, in radians; 0: the mesh is flat
  double excess = 0;         ///< of sqrt(t^2 - 1) over the turns t > 1, as multiples of the mean turn
  double crease_weight = 1;  ///< of the merge cost, see `crease_weight()`
};

/// How concave the edges of the smoothed shape are: a measure of the shape, whatever difference fragments are merged with.
class Edge_concavity {
 public:
  explicit Edge_concavity(const Dual_mesh& mesh);

  /// Of a part of a mesh, by the means of the whole.
  Edge_concavity(const Dual_mesh& part, const Mean_concavity& whole);

  /// How far the normals of the shape turn inward, 1 on average.
  double inward_turn(Dual_mesh::Index edge) const { return inward_turn_[edge]; }
  /// What exceeds an ordinary turn, 1 on average: the difference of `smoothed_concavity()`.
  double excess(Dual_mesh::Index edge) const { return mean_excess_ > 0 ? excess_of(edge) / mean_excess_ : 0; }

 private:
  double excess_of(Dual_mesh::Index edge) const;

  std::vector<double> inward_turn_;  // by edge
  double mean_excess_ = 0;
};

/// Sums over a region that tell its shape. Lengths are in units of R, areas in units of R^2.
struct Region_shape {
  double area = 0;                   ///< of the faces
  double samples = 0;                ///< faces whose thickness is known
  double log_thickness = 0;          ///< over the samples
  double squared_log_thickness = 0;  ///< over the samples
  double edge_length = 0;            ///< half of each side of a face that is no wall
  double excess = 0;                 ///< of the concavity, times that
  Eigen::Vector3d centroid;          ///< times area
  Eigen::Vector3d normal;            ///< times area

  Region_shape();  ///< of nothing
  Region_shape& operator+=(const Region_shape& other);
};

/// Sums over the edges of a boundary: of their lengths |e|, and of |e| times what they are.
struct Boundary_shape {
  double length = 0;             ///< in units of R
  double excess = 0;             ///< of the concavity
  double root = 0;               ///< of the inward turn
  double fourth_root = 0;        ///< of the inward turn
  double permeability = 0;       ///< exp(-excess), what walks see
  double concave = 0;            ///< 1 where the excess is above a half
  double distinct = 0;           ///< 1 where the inward turn is 1.5 to 3 times the average
  double strong = 0;             ///< 1 where it is more
  double inward_curvature = 0;   ///< of the smoothed shape across the edge, times R
  double outward_curvature = 0;  ///< likewise
  Eigen::Vector3d middle;        ///< in units of R
  Eigen::Matrix3d moment;        ///< of the middles

  Boundary_shape();  ///< of nothing
  Boundary_shape& operator+=(const Boundary_shape& other);
};

/// What a learned cost asks about two neighbouring regions. None of it depends on position, direction or size of the mesh,
/// on the order of the regions, or on how many faces and edges there are.
class Merge_features {
 public:
  /// "small" is the region with the smaller area, "large" the other one; L is the length of the boundary.
  enum Name : std::uint8_t {
    excess,                ///< log of the mean excess of concavity along the boundary
    size,                  ///< log of a b / (a + b) with the areas a and b
    length,                ///< log L
    thickness_step,        ///< log(1 + 2 step) as in `Size_aware_cost`
    size_aware,            ///< the sum of these as in log `Size_aware_cost`
    small_area,            ///< log
    large_area,            ///< log
    whole_area,            ///< log
    turn_of_order_half,    ///< log of the mean of order 1/2 of the inward turn along the boundary
    turn_of_order_fourth,  ///< log of the mean of order 1/4
    concave_share,         ///< of L
    distinct_share,        ///< of L
    strong_share,          ///< of L
    permeability,          ///< log of the mean along the boundary
    share_of_small,        ///< L as a share of the outline of the small region
    share_of_large,        ///< L as a share of the outline of the large region
    rest_of_small,         ///< log of the mean excess along the rest of that outline, minus `excess`
    rest_of_large,         ///< likewise
    inside_small,          ///< log of the mean excess of the edges inside
    inside_large,          ///< likewise
    openness_of_small,     ///< |sum of area times normal| / area: 0 for a closed surface, 1 for a flat one
    openness_of_large,     ///< likewise
    openness_of_whole,     ///< of both together
    closure,            ///< log of L^2 / (4 pi^2 x the curve's second moment): 0 for a circle, -1.2 for a straight line
    warp,               ///< least to largest extent of the boundary, 0 where it lies in a plane
    roundness,          ///< middle to largest extent of the boundary, 1 for a circle
    cross_section,      ///< log of the area that the boundary goes round, as a share of that of the small region
    small_girth,        ///< log of L / thickness
    large_girth,        ///< likewise
    thickness_ratio,    ///< log, small to large
    small_taper,        ///< standard deviation of the logarithm of the thickness
    large_taper,        ///< likewise
    across,             ///< |cos| between the boundary's plane's normal and the way between the centroids
    small_neck,         ///< log of L / sqrt(area)
    inward_curvature,   ///< log of the mean along the boundary
    outward_curvature,  ///< likewise
    count
  };
  /// By name, what the samples of the training call it.
  static constexpr std::array<const char*, count> names = {"excess",
                                                           "size",
                                                           "length",
                                                           "thickness_step",
                                                           "size_aware",
                                                           "small_area",
                                                           "large_area",
                                                           "whole_area",
                                                           "turn_of_order_half",
                                                           "turn_of_order_fourth",
                                                           "concave_share",
                                                           "distinct_share",
                                                           "strong_share",
                                                           "permeability",
                                                           "share_of_small",
                                                           "share_of_large",
                                                           "rest_of_small",
                                                           "rest_of_large",
                                                           "inside_small",
                                                           "inside_large",
                                                           "openness_of_small",
                                                           "openness_of_large",
                                                           "openness_of_whole",
                                                           "closure",
                                                           "warp",
                                                           "roundness",
                                                           "cross_section",
                                                           "small_girth",
                                                           "large_girth",
                                                           "thickness_ratio",
                                                           "small_taper",
                                                           "large_taper",
                                                           "across",
                                                           "small_neck",
                                                           "inward_curvature",
                                                           "outward_curvature"};

  /// \param outline_of_first the edges between the first region and all of its neighbours
  Merge_features(const Region_shape& first, const Region_shape& second, const Boundary_shape& common,
                 const Boundary_shape& outline_of_first, const Boundary_shape& outline_of_second);

  double operator[](std::size_t name) const { return value_[name]; }

 private:
  void set_concavity(const Region_shape& small, const Region_shape& large, const Boundary_shape& common,
                     const Boundary_shape& outline_of_small, const Boundary_shape& outline_of_large);
  void set_thickness(const Region_shape& small, const Region_shape& large);
  void set_curve(const Region_shape& small, const Region_shape& large, const Boundary_shape& common);

  std::array<double, count> value_{};
};

}  // namespace RW_segmentation::internal

#endif
