// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_FEATURE_SENSITIVE_SEEDS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_FEATURE_SENSITIVE_SEEDS_H

#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/seeds/Distances_to_sources.h>
#include <RW_segmentation/internal/seeds/Feature_sensitive_metric.h>

namespace RW_segmentation {

namespace internal {

/// The first face whose value is the greatest but for rounding, so that a symmetric mesh gives the same answer in every
/// position.
template <class Values>
Dual_mesh::Index first_greatest(const Values& values) {
  const double greatest = *std::max_element(values.begin(), values.end());
  const double limit = greatest - 1e-9 * std::abs(greatest);
  return static_cast<Dual_mesh::Index>(
      std::find_if(values.begin(), values.end(), [&](double value) { return value >= limit; }) - values.begin());
}

/// The face whose centroid is farthest from the centroid of the surface.
inline Dual_mesh::Index face_farthest_from_centroid(const Dual_mesh& mesh) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (std::size_t f = 0; f < mesh.number_of_faces(); ++f) moment += mesh.areas()[f] * mesh.centroids()[f];
  const Eigen::Vector3d centroid = mesh.total_area() > 0 ? moment / mesh.total_area() : moment;
  std::vector<double> distance;
  distance.reserve(mesh.number_of_faces());
  for (const Eigen::Vector3d& x : mesh.centroids()) distance.push_back((x - centroid).norm());
  return first_greatest(distance);
}

/// Goes on from a first seed, which is no source yet, to each component that no source reaches, and then to the farthest
/// face again and again, up to a count.
/// \throws std::invalid_argument if that is less than the number of components, Cancelled
inline std::vector<Dual_mesh::Index> farthest_points(Distances_to_sources& distance, std::vector<Dual_mesh::Index> seeds,
                                                     std::size_t count, const Progress& progress) {
  for (const auto face : seeds) distance.add_source(face);
  const auto out_of_reach = reach_all_components(distance);
  seeds.insert(seeds.end(), out_of_reach.begin(), out_of_reach.end());
  if (seeds.size() > count) {
    const std::string components = std::to_string(seeds.size()) + ", the number of components without a given seed";
    throw argument_error("count", count, ("at least " + components).c_str());
  }
  while (seeds.size() < count) {
    progress(static_cast<double>(seeds.size()) / static_cast<double>(count));
    seeds.push_back(first_greatest(*distance));
    distance.add_source(seeds.back());
  }
  return seeds;
}

}  // namespace internal

RW_SEGMENTATION_INLINE std::vector<Dual_mesh::Index> Farthest_point_sampling::operator()(
    const Dual_mesh& mesh, const std::vector<Dual_mesh::Index>& given, std::size_t count,
    const Progress& progress) const {
  internal::Distances_to_sources distance(mesh.graph(),
                                          internal::Feature_sensitive_metric(mesh, normal_weight_).edge_lengths());
  std::vector<Dual_mesh::Index> seeds;
  if (given.empty()) seeds.push_back(internal::face_farthest_from_centroid(mesh));
  for (const auto face : given) distance.add_source(face);
  return internal::farthest_points(distance, std::move(seeds), count, progress);
}

}  // namespace RW_segmentation

#endif
