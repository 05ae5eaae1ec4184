// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_COARSE_SEEDS_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_COARSE_SEEDS_H

#include <RW_segmentation/coarse_seeds.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/seeds/Path_lengths.h>

#include <Eigen/Core>

#include <boost/iterator/counting_iterator.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace RW_segmentation::internal {

/// Coarse seeding as it goes on: farthest-first by the least sum of differences, ties by geodesic distance.
class Coarse_seeds {
 public:
  using Index = Dual_mesh::Index;

  /// Keeps references to the mesh and the differences, which are in the order of the edges.
  Coarse_seeds(const Dual_mesh& mesh, const std::vector<double>& differences)
      : mesh_(mesh),
        mean_(mean_difference(differences)),
        step_difference_(differences),
        step_length_(centroid_distances(mesh)),
        difference_(mesh.graph(), step_difference_),
        distance_(mesh.graph(), step_length_) {
    for (Index e = 0; e < mesh.number_of_edges(); ++e)
      if (mesh.is_wall(e)) step_difference_[e] = std::numeric_limits<double>::infinity();
  }

  /// Finds the seeds that are added to the `given` ones.
  std::vector<Index> operator()(const std::vector<Index>& given,
                                const std::function<bool(const std::vector<double>&)>& stop, const Progress& progress) {
    seeds_ = given;
    const std::vector<Index> first = first_seeds(given);
    seeds_.insert(seeds_.end(), first.begin(), first.end());
    std::vector<double> separation;
    while (separation.size() < seeds_.size()) {
      separation.push_back(std::numeric_limits<double>::infinity());
      if (stop(separation))
        throw argument_error("the number of seeds at which stop ends", separation.size() - 1,
                             ("at least " + std::to_string(seeds_.size()) + ", one for each component").c_str());
    }
    difference_.add_sources(seeds_);
    const double unit = mean_ * std::sqrt(static_cast<double>(mesh_.number_of_faces()));
    while (seeds_.size() < mesh_.number_of_faces()) {
      progress(1 - 1 / static_cast<double>(seeds_.size()));
      const Index next = most_separated();
      separation.push_back(difference_[next] > 0 ? difference_[next] / unit : 0);
      if (stop(separation)) return added(given);
      seeds_.push_back(next);
      difference_.add_sources({next});
    }
    separation.push_back(0);
    if (!seeds_.empty() && !stop(separation))
      throw argument_error("the number of seeds at which stop ends", "larger",
                           ("at most " + std::to_string(seeds_.size()) + ", the number of faces").c_str());
    return added(given);
  }

 private:
  /// In units of the mean difference, and of the bounding box's diagonal for distances: above the rounding of sums, far
  /// below what tells two places on a mesh apart.
  static constexpr double rounding = 1e-9;

  /// The mean of those differences that are finite.
  static double mean_difference(const std::vector<double>& differences) {
    double mean = 0;
    for (const double d : differences)
      if (std::isfinite(d)) mean += d / static_cast<double>(differences.size());
    return mean;
  }

  /// The distances between the centroids of neighbouring faces: geodesic distance is the length of a path over them.
  static std::vector<double> centroid_distances(const Dual_mesh& mesh) {
    std::vector<double> distance;
    distance.reserve(mesh.number_of_edges());
    for (Index e = 0; e < mesh.number_of_edges(); ++e) {
      const auto [f, g] = mesh.graph().faces_of(e);
      distance.push_back(mesh.is_wall(e) ? std::numeric_limits<double>::infinity()
                                         : (mesh.centroid(f) - mesh.centroid(g)).norm());
    }
    return distance;
  }

  /// The faces of a range with the greatest value but for rounding errors, in their order. Taking them for equal makes
  /// the seeds of a symmetric mesh the same in every position.
  template <class Faces, class Value>
  static std::vector<Index> with_greatest(const Faces& faces, const Value& value, double rounding_error) {
    double greatest = -std::numeric_limits<double>::infinity();
    for (const Index f : faces) greatest = std::max(greatest, value(f));
    std::vector<Index> result;
    for (const Index f : faces)
      if (value(f) >= greatest - rounding_error) result.push_back(f);
    return result;
  }

  /// The face of a component that is closest to the component's centroid, every point of the surface counting alike.
  Index face_closest_to_centroid(const std::vector<Index>& component) const {
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    double area = 0;
    for (const Index f : component) {
      moment += mesh_.area(f) * mesh_.centroid(f);
      area += mesh_.area(f);
    }
    if (!(area > 0)) return component.front();
    const Eigen::Vector3d centroid = moment / area;
    const auto closeness = [&](Index f) { return -(mesh_.centroid(f) - centroid).norm(); };
    return with_greatest(component, closeness, rounding).front();
  }

  /// The first seed of each component that has none: the face geodesically farthest from the face closest to the centroid.
  std::vector<Index> first_seeds(const std::vector<Index>& given) const {
    const Components components(mesh_.graph(), [&](Index e) { return !mesh_.is_wall(e); });
    std::vector<std::vector<Index>> faces(components.count);
    for (Index f = 0; f < mesh_.number_of_faces(); ++f) faces[components.of[f]].push_back(f);
    for (const Index seed : given) faces[components.of[seed]].clear();
    faces.erase(std::remove_if(faces.begin(), faces.end(), [](const auto& list) { return list.empty(); }), faces.end());

    std::vector<Index> seeds;
    for (const auto& component : faces) seeds.push_back(face_closest_to_centroid(component));
    Path_lengths from_centre(mesh_.graph(), step_length_);
    from_centre.add_sources(seeds);
    for (std::size_t i = 0; i < seeds.size(); ++i)
      seeds[i] = with_greatest(
                     faces[i], [&](Index f) { return from_centre[f]; }, rounding)
                     .front();
    return seeds;
  }

  Index most_separated() {
    const auto greatest = with_greatest(
        Numbers{static_cast<Index>(mesh_.number_of_faces())}, [&](Index f) { return difference_[f]; },
        rounding * mean_);
    if (greatest.size() == 1) return greatest.front();
    distance_.add_sources({seeds_.begin() + static_cast<std::ptrdiff_t>(seeds_in_distance_), seeds_.end()});
    seeds_in_distance_ = seeds_.size();
    return with_greatest(
               greatest, [&](Index f) { return difference_[f] < 0 ? -1 : distance_[f]; }, rounding)
        .front();
  }

  std::vector<Index> added(const std::vector<Index>& given) const {
    return {seeds_.begin() + static_cast<std::ptrdiff_t>(given.size()), seeds_.end()};
  }

  /// All numbers of faces.
  struct Numbers {
    Index count;
    boost::counting_iterator<Index> begin() const { return boost::counting_iterator<Index>(0); }
    boost::counting_iterator<Index> end() const { return boost::counting_iterator<Index>(count); }
  };

  const Dual_mesh& mesh_;
  double mean_;
  std::vector<double> step_difference_, step_length_;  // by edge, infinite over walls
  Path_lengths difference_, distance_;  // to the nearest seed, the latter brought up to date where it decides
  std::size_t seeds_in_distance_ = 0;
  std::vector<Index> seeds_;
};

RW_SEGMENTATION_INLINE std::vector<Dual_mesh::Index> coarse_seeds_of(
    const Dual_mesh& mesh, const std::vector<double>& differences, const std::vector<Dual_mesh::Index>& given,
    const std::function<bool(const std::vector<double>&)>& stop, const Progress& progress) {
  return Coarse_seeds(mesh, differences)(given, stop, progress);
}

}  // namespace RW_segmentation::internal

#endif
