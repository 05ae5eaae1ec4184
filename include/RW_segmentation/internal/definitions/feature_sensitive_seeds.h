// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_FEATURE_SENSITIVE_SEEDS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_FEATURE_SENSITIVE_SEEDS_H

#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/mesh/Flooded_clusters.h>
#include <RW_segmentation/internal/seeds/Distance_clusters.h>
#include <RW_segmentation/internal/seeds/Distances_to_sources.h>
#include <RW_segmentation/internal/seeds/Feature_sensitive_metric.h>
#include <RW_segmentation/internal/seeds/farthest_points.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// The face whose centroid is farthest from the centroid of the surface.
inline Dual_mesh::Index face_farthest_from_centroid(const Dual_mesh& mesh) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f) moment += mesh.area(f) * mesh.centroid(f);
  const Eigen::Vector3d centroid = mesh.total_area() > 0 ? moment / mesh.total_area() : moment;
  std::vector<double> distance;
  distance.reserve(mesh.number_of_faces());
  for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f)
    distance.push_back((mesh.centroid(f) - centroid).norm());
  return first_greatest(distance);
}

/// As `farthest_points()`, over clusters of faces: what is added are roots of clusters.
/// \param given faces that are sources
/// \param seeds at most one to begin with, which is no source yet
inline std::vector<Dual_mesh::Index> farthest_roots(const Distance_clusters& clusters,
                                                    const std::vector<Dual_mesh::Index>& given,
                                                    std::vector<Dual_mesh::Index> seeds, std::size_t count,
                                                    const Progress& progress) {
  const Dual_graph graph(clusters.root.size(), clusters.ends);
  Distances_to_sources distance(graph, clusters.lengths);
  for (const auto face : given) distance.add_source(clusters.of_face[face]);
  std::vector<Dual_mesh::Index> nodes;
  for (const auto face : seeds) nodes.push_back(clusters.of_face[face]);
  nodes = farthest_points(distance, std::move(nodes), count, progress);
  for (std::size_t i = seeds.size(); i < nodes.size(); ++i) seeds.push_back(clusters.root[nodes[i]]);
  return seeds;
}

}  // namespace internal

RW_SEGMENTATION_INLINE Farthest_point_sampling::Farthest_point_sampling(double normal_weight,
                                                                        std::size_t largest_direct)
    : normal_weight_(normal_weight), largest_direct_(largest_direct) {
  if (!(normal_weight >= 0 && std::isfinite(normal_weight)))
    throw internal::argument_error("normal_weight", normal_weight, "finite and not negative");
}

RW_SEGMENTATION_INLINE std::vector<Dual_mesh::Index> Farthest_point_sampling::operator()(
    const Dual_mesh& mesh, const std::vector<Dual_mesh::Index>& given, std::size_t count,
    const Progress& progress) const {
  std::vector<Dual_mesh::Index> seeds;
  if (given.empty()) seeds.push_back(internal::face_farthest_from_centroid(mesh));
  std::vector<double> lengths = internal::Feature_sensitive_metric(mesh, normal_weight_).edge_lengths();
  if (mesh.number_of_faces() > largest_direct_) {
    const internal::Distance_clusters clusters(
        mesh.graph(), lengths, internal::cluster_steps(mesh.number_of_faces(), internal::steps_of_seed_clusters));
    if (clusters.root.size() / internal::least_clusters_per_seed >= given.size() + count)
      return internal::farthest_roots(clusters, given, std::move(seeds), count, progress);
  }
  internal::Distances_to_sources distance(mesh.graph(), std::move(lengths));
  for (const auto face : given) distance.add_source(face);
  return internal::farthest_points(distance, std::move(seeds), count, progress);
}

}  // namespace RW_segmentation

#endif
