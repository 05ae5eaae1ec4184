// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_LEARNED_COST_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_LEARNED_COST_H

#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Learned_cost.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/merging/trees_of_learned_cost.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

// ---- Sums ----

RW_SEGMENTATION_INLINE Edge_concavity::Edge_concavity(const Dual_mesh& mesh)
    : inward_turn_(Dihedral_difference_policy{0, Dihedral_measure::angle, 0}(mesh)) {
  for (Dual_mesh::Index e = 0; e < inward_turn_.size(); ++e) mean_excess_ += excess_of(e);
  if (mean_excess_ > 0) mean_excess_ /= static_cast<double>(inward_turn_.size());
}

RW_SEGMENTATION_INLINE Edge_concavity::Edge_concavity(const Dual_mesh& part, const Mean_concavity& whole)
    : inward_turn_(turns(part, 0)), mean_excess_(whole.excess) {
  for (double& turn : inward_turn_) turn = whole.turn > 0 ? turn / whole.turn : 0;
}

RW_SEGMENTATION_INLINE double Edge_concavity::excess_of(Dual_mesh::Index edge) const {
  const double turn = inward_turn_[edge];
  return turn > 1 ? std::sqrt(turn * turn - 1) : 0;
}

RW_SEGMENTATION_INLINE Region_shape::Region_shape()
    : centroid(Eigen::Vector3d::Zero()), normal(Eigen::Vector3d::Zero()) {}

RW_SEGMENTATION_INLINE Boundary_shape::Boundary_shape()
    : middle(Eigen::Vector3d::Zero()), moment(Eigen::Matrix3d::Zero()) {}

RW_SEGMENTATION_INLINE Region_shape& Region_shape::operator+=(const Region_shape& other) {
  area += other.area;
  samples += other.samples;
  log_thickness += other.log_thickness;
  squared_log_thickness += other.squared_log_thickness;
  edge_length += other.edge_length;
  excess += other.excess;
  centroid += other.centroid;
  normal += other.normal;
  return *this;
}

RW_SEGMENTATION_INLINE Boundary_shape& Boundary_shape::operator+=(const Boundary_shape& other) {
  length += other.length;
  excess += other.excess;
  root += other.root;
  fourth_root += other.fourth_root;
  permeability += other.permeability;
  concave += other.concave;
  distinct += other.distinct;
  strong += other.strong;
  inward_curvature += other.inward_curvature;
  outward_curvature += other.outward_curvature;
  middle += other.middle;
  moment += other.moment;
  return *this;
}

inline Region_shape shape_of_face(const Dual_mesh& mesh, const Edge_concavity& concavity, Dual_mesh::Index face,
                                  const Size_aware_cost::Region& size) {
  const double unit = mesh.length_unit();
  Region_shape shape;
  shape.area = size.area;
  shape.samples = size.samples;
  if (size.samples > 0) {
    shape.log_thickness = size.log_thickness - std::log(unit);
    shape.squared_log_thickness = shape.log_thickness * shape.log_thickness;
  }
  shape.centroid = size.area / unit * mesh.centroid(face);
  shape.normal = size.area * mesh.normal(face);
  for (const auto& [next, edge] : mesh.graph().neighbours(face)) {
    if (mesh.is_wall(edge)) continue;
    const double half = mesh.edge_length(edge) / unit / 2;
    shape.edge_length += half;
    shape.excess += half * concavity.excess(edge);
  }
  return shape;
}

/// How strongly the smoothed shape is bent across an edge, times R: the turn of the normals, divided by the distance of
/// the faces' centres.
inline double curvature_across(const Dual_mesh& mesh, Dual_mesh::Index edge, double turn) {
  constexpr double largest = 100;  // sharper than any crease of normals smoothed over R / 100; slivers have no limit
  const auto [i, j] = mesh.graph().faces_of(edge);
  const double distance = 2. / 3 * (mesh.area(i) + mesh.area(j)) / mesh.length_unit();  // times |e| / R
  return turn * mesh.edge_length(edge) < largest * distance ? turn * mesh.edge_length(edge) / distance : largest;
}

inline Boundary_shape shape_of_edge(const Dual_mesh& mesh, const Edge_concavity& concavity, Dual_mesh::Index edge) {
  constexpr double most_resistance = 20;  // the cap of the conductance
  constexpr double concave_excess = 0.5, distinct_turn = 1.5, strong_turn = 3;
  const double length = mesh.edge_length(edge) / mesh.length_unit();
  const double excess = concavity.excess(edge), inward = concavity.inward_turn(edge);
  const auto [i, j] = mesh.graph().faces_of(edge);
  const Eigen::Vector3d turn = mesh.shape_normal(j) - mesh.shape_normal(i);
  const auto [p, q] = mesh.ends(edge);
  const Eigen::Vector3d middle = (mesh.point(p) + mesh.point(q)) / (2 * mesh.length_unit());

  Boundary_shape shape;
  shape.length = length;
  shape.excess = length * excess;
  shape.root = length * std::sqrt(inward);
  shape.fourth_root = length * std::sqrt(std::sqrt(inward));
  shape.permeability = length * std::exp(-std::min(excess, most_resistance));
  if (excess > concave_excess) shape.concave = length;
  if (inward > distinct_turn) (inward > strong_turn ? shape.strong : shape.distinct) = length;
  (turn.dot(mesh.centroid(j) - mesh.centroid(i)) < 0 ? shape.inward_curvature : shape.outward_curvature) =
      length * curvature_across(mesh, edge, turn.norm());
  shape.middle = length * middle;
  shape.moment = length * middle * middle.transpose();
  return shape;
}

RW_SEGMENTATION_INLINE bool is_solid(const std::vector<double>& thickness) {
  const auto known = static_cast<std::size_t>(
      std::count_if(thickness.begin(), thickness.end(), [](double t) { return t > 0 && std::isfinite(t); }));
  return is_solid(known, thickness.size());
}

RW_SEGMENTATION_INLINE bool is_solid(std::size_t faces_with_thickness, std::size_t faces) {
  constexpr std::size_t enough = 250;  // half of Thickness_sampling::samples
  return faces_with_thickness > 0 && (faces_with_thickness >= enough || 2 * faces_with_thickness >= faces);
}

// ---- Features ----

constexpr double fewest_thickness_samples = 3;  // of which the mean is told, as for Size_aware_cost
// What keeps logarithms and quotients of nothing finite.
constexpr double least_feature_length = 1e-9;
constexpr double least_feature_area = 1e-9;
constexpr double least_excess = 0.1;  // that of Size_aware_cost

inline double log_excess(double excess, double length) {
  return std::log(std::max(excess, 0.) / std::max(length, least_feature_length) + least_excess);
}

RW_SEGMENTATION_INLINE Merge_features::Merge_features(const Region_shape& first, const Region_shape& second,
                                                      const Boundary_shape& common,
                                                      const Boundary_shape& outline_of_first,
                                                      const Boundary_shape& outline_of_second) {
  const bool is_in_order = first.area <= second.area;
  const Region_shape &small = is_in_order ? first : second, &large = is_in_order ? second : first;
  const Boundary_shape& outline_of_small = is_in_order ? outline_of_first : outline_of_second;
  const Boundary_shape& outline_of_large = is_in_order ? outline_of_second : outline_of_first;

  const double a = std::max(small.area, least_feature_area), b = std::max(large.area, least_feature_area);
  value_[size] = std::log(a * b / (a + b));
  value_[length] = std::log(std::max(common.length, least_feature_length));
  value_[small_area] = std::log(a);
  value_[large_area] = std::log(b);
  value_[whole_area] = std::log(a + b);
  value_[openness_of_small] = small.normal.norm() / a;
  value_[openness_of_large] = large.normal.norm() / b;
  value_[openness_of_whole] = (small.normal + large.normal).norm() / (a + b);
  value_[small_neck] = value_[length] - value_[small_area] / 2;
  set_concavity(small, large, common, outline_of_small, outline_of_large);
  set_thickness(small, large);
  set_curve(small, large, common);
  value_[size_aware] = value_[excess] + value_[size] - value_[length] + value_[thickness_step];
}

RW_SEGMENTATION_INLINE void Merge_features::set_concavity(const Region_shape& small, const Region_shape& large,
                                                          const Boundary_shape& common,
                                                          const Boundary_shape& outline_of_small,
                                                          const Boundary_shape& outline_of_large) {
  constexpr double least_turn_of_order_half = 0.05, least_turn_of_order_fourth = 0.02, least_permeability = 0.02;
  constexpr double least_curvature = 0.3;
  const double l = std::max(common.length, least_feature_length);
  const double root = common.root / l, fourth_root = common.fourth_root / l;
  value_[excess] = log_excess(common.excess, l);
  value_[turn_of_order_half] = std::log(root * root + least_turn_of_order_half);
  value_[turn_of_order_fourth] =
      std::log(fourth_root * fourth_root * fourth_root * fourth_root + least_turn_of_order_fourth);
  value_[concave_share] = common.concave / l;
  value_[distinct_share] = common.distinct / l;
  value_[strong_share] = common.strong / l;
  value_[permeability] = std::log(common.permeability / l + least_permeability);
  value_[inward_curvature] = std::log(common.inward_curvature / l + least_curvature);
  value_[outward_curvature] = std::log(common.outward_curvature / l + least_curvature);

  const auto set_outline = [&](const Boundary_shape& outline, Name share, Name rest) {
    constexpr double least_rest = 1e-6;
    const double length_of_rest = outline.length - common.length;
    value_[share] = l / std::max(outline.length, l);
    value_[rest] =
        length_of_rest > least_rest ? log_excess(outline.excess - common.excess, length_of_rest) - value_[excess] : 0;
  };
  set_outline(outline_of_small, share_of_small, rest_of_small);
  set_outline(outline_of_large, share_of_large, rest_of_large);
  const auto inside = [](const Region_shape& region, const Boundary_shape& outline) {
    return log_excess(region.excess - outline.excess / 2, region.edge_length - outline.length / 2);
  };
  value_[inside_small] = inside(small, outline_of_small);
  value_[inside_large] = inside(large, outline_of_large);
}

RW_SEGMENTATION_INLINE void Merge_features::set_thickness(const Region_shape& small, const Region_shape& large) {
  constexpr double weight = 2, largest_step = 2;  // those of Size_aware_cost
  if (small.samples < fewest_thickness_samples || large.samples < fewest_thickness_samples) return;
  const auto taper = [](const Region_shape& region) {
    const double mean = region.log_thickness / region.samples;
    return std::sqrt(std::max(0., region.squared_log_thickness / region.samples - mean * mean));
  };
  const double of_small = small.log_thickness / small.samples, of_large = large.log_thickness / large.samples;
  value_[thickness_step] = std::log(1 + weight * std::min(std::abs(of_small - of_large), largest_step));
  value_[small_girth] = value_[length] - of_small;
  value_[large_girth] = value_[length] - of_large;
  value_[thickness_ratio] = std::clamp(of_small - of_large, -largest_step, largest_step);
  value_[small_taper] = taper(small);
  value_[large_taper] = taper(large);
}

RW_SEGMENTATION_INLINE void Merge_features::set_curve(const Region_shape& small, const Region_shape& large,
                                                      const Boundary_shape& common) {
  constexpr double pi = 3.14159265358979324;
  constexpr double least_moment = 1e-12, least_cross_section = 0.003;
  const double l = std::max(common.length, least_feature_length);
  const double a = std::max(small.area, least_feature_area), b = std::max(large.area, least_feature_area);
  const Eigen::Vector3d middle = common.middle / l, between = large.centroid / b - small.centroid / a;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(common.moment / l - middle * middle.transpose());
  const Eigen::Array3d moments = axes.eigenvalues().array().max(least_moment);
  value_[closure] = std::log(l * l / (4 * pi * pi * moments.sum()));
  value_[warp] = std::sqrt(moments[0] / moments[2]);
  value_[roundness] = std::sqrt(moments[1] / moments[2]);
  // That of an ellipse with these moments.
  value_[cross_section] = std::log(2 * pi * std::sqrt(moments[1] * moments[2]) / a + least_cross_section);
  value_[across] = std::abs(axes.eigenvectors().col(0).dot(between)) / std::max(between.norm(), least_feature_length);
}

RW_SEGMENTATION_INLINE const Boosted_trees& learned_trees() {
  static constexpr Boosted_trees trees = {trees_of_learned_cost.data(), trees_of_learned_cost.size()};
  return trees;
}

}  // namespace internal

// ---- The cost ----

RW_SEGMENTATION_INLINE Learned_cost::Learned_cost(const Dual_mesh& shape, std::vector<double> thickness,
                                                  const internal::Boosted_trees& trees)
    : is_solid_(internal::is_solid(thickness)),
      size_aware_(std::move(thickness), internal::crease_weight(shape.number_of_edges())),
      concavity_(std::make_shared<const internal::Edge_concavity>(shape)),
      trees_(&trees) {}

RW_SEGMENTATION_INLINE Learned_cost::Learned_cost(const Dual_mesh& part, std::vector<double> thickness,
                                                  const internal::Mean_concavity& whole)
    : is_solid_(internal::is_solid(thickness)),
      size_aware_(std::move(thickness)),
      concavity_(std::make_shared<const internal::Edge_concavity>(part, whole)),
      trees_(&internal::learned_trees()) {}

RW_SEGMENTATION_INLINE Learned_cost::Region Learned_cost::region(const Dual_mesh& mesh, Dual_mesh::Index face) const {
  const Size_aware_cost::Region size = size_aware_.region(mesh, face);
  return {size, internal::shape_of_face(mesh, *concavity_, face, size)};
}

RW_SEGMENTATION_INLINE Learned_cost::Boundary Learned_cost::boundary(const Dual_mesh& mesh, Dual_mesh::Index edge,
                                                                     double difference) const {
  const double length = mesh.edge_length(edge) / mesh.length_unit();
  return {{length, length * difference}, internal::shape_of_edge(mesh, *concavity_, edge)};
}

RW_SEGMENTATION_INLINE bool Learned_cost::knows_thickness(const Region& a, const Region& b) const {
  return is_solid_ && std::max(a.size.samples, b.size.samples) >= internal::fewest_thickness_samples;
}

RW_SEGMENTATION_INLINE double Learned_cost::operator()(const Region& a, const Region& b,
                                                       const Region_boundary_of<Boundary>& boundary) const {
  constexpr double share = 0.35;  // of the learned factor; 0.25 to 0.5 agree as well with people
  const double size_aware = size_aware_cost(a, b, boundary);
  if (!knows_thickness(a, b)) return size_aware;
  const internal::Merge_features features(a.shape, b.shape, boundary.common.shape, boundary.outline_of_first.shape,
                                          boundary.outline_of_second.shape);
  return std::pow(size_aware, 1 - share) * std::exp(-share * (*trees_)(features));
}

}  // namespace RW_segmentation

#endif
