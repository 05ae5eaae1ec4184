#ifndef RW_SEGMENTATION_FEATURE_SENSITIVE_SEEDS_H
#define RW_SEGMENTATION_FEATURE_SENSITIVE_SEEDS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/read_normals.h>

#include <CGAL/Named_function_parameters.h>

#include <Eigen/Core>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// Places exactly as many seeds as asked for, each at the face farthest from the seeds before it; deterministic.
///
/// Distances are lengths of paths over neighbouring faces. The farthest face is at most twice as far from its seed as
/// with the best placement of so many seeds (Gonzalez 1985).
class Farthest_point_sampling {
 public:
  Farthest_point_sampling() = default;

  /// \param normal_weight w of the metric |dx|^2 + w^2 |dn|^2, as a fraction of the square root of the total area; 0.05
  /// if not given
  /// \throws std::invalid_argument unless `normal_weight` is finite and not negative
  explicit Farthest_point_sampling(double normal_weight) : normal_weight_(normal_weight) {
    if (!(normal_weight >= 0 && std::isfinite(normal_weight)))
      throw internal::argument_error("normal_weight", normal_weight, "finite and not negative");
  }

  /// w as a fraction of the square root of the total area.
  double normal_weight() const { return normal_weight_; }

 private:
  double normal_weight_ = 0.05;
};

namespace internal {

/// The feature-sensitive metric |dx|^2 + w^2 |dn|^2 on the faces of a mesh, x being centroids and n normals.
class Feature_sensitive_metric {
 public:
  using Index = Dual_graph::Index;
  using Point = Eigen::Matrix<double, 6, 1>;

  /// Keeps references to the arrays. `normal_weight` is w as a fraction of the square root of the total area.
  Feature_sensitive_metric(const Face_geometry& geometry, const std::vector<Eigen::Vector3d>& normals,
                           double normal_weight)
      : centroid_(geometry.centroid), normal_(normals), w_(normal_weight * std::sqrt(geometry.total_area)) {}

  /// The face in six-dimensional space, (x, w n).
  Point point(Index f) const {
    Point p;
    p << centroid_[f], w_ * normal_[f];
    return p;
  }

  /// The distance of two points; a face without normal looks like the other one.
  double distance(Index f, Index g) const {
    const bool both = !normal_[f].isZero(0) && !normal_[g].isZero(0);
    const double turn = both ? (normal_[f] - normal_[g]).squaredNorm() : 0;
    return std::sqrt((centroid_[f] - centroid_[g]).squaredNorm() + w_ * w_ * turn);
  }

  /// The distances over the edges of the dual graph, in their order.
  std::vector<double> edge_lengths(const Dual_graph& graph) const {
    std::vector<double> length;
    length.reserve(graph.number_of_edges());
    for (std::size_t e = 0; e < graph.number_of_edges(); ++e) {
      const auto [f, g] = graph.faces_of(static_cast<Index>(e));
      length.push_back(distance(f, g));
    }
    return length;
  }

 private:
  const std::vector<Eigen::Vector3d>&centroid_, &normal_;
  double w_;
};

/// The lengths of the shortest paths over a dual graph from a growing set of source faces; infinite where no path
/// leads, negative at the sources themselves.
///
/// Dijkstra's algorithm with buckets of faces for a queue: those of one bucket are visited in any order, and again if
/// a path to them turns out shorter (the delta-stepping of Meyer and Sanders 1998). A source added later visits those
/// faces only that come closer. Costs that are much alike, as distances between neighbouring faces are, make this 2
/// to 2.5 times as fast as a binary heap or Boost's Dijkstra, with the same result.
class Distances_to_sources {
 public:
  using Index = Dual_graph::Index;

  /// Keeps a reference to the graph. The costs are in the order of the edges, finite and not negative.
  Distances_to_sources(const Dual_graph& graph, std::vector<double> cost)
      : graph_(graph),
        cost_(std::move(cost)),
        distance_(graph.number_of_faces(), std::numeric_limits<double>::infinity()) {
    double sum = 0;
    for (const double c : cost_) sum += c;
    buckets_per_length_ = sum > 0 ? 4 * static_cast<double>(cost_.size()) / sum : 0;
  }

  const std::vector<double>& operator*() const { return distance_; }
  double operator[](Index face) const { return distance_[face]; }

  void add_source(Index source) {
    std::size_t current = 0, waiting = 0;
    const auto shorten_paths_over = [&](Index face, double distance) {
      for (const auto [next, edge] : graph_.neighbours(face)) {
        const double through_face = distance + cost_[edge];
        if (!(through_face < distance_[next])) continue;
        distance_[next] = through_face;
        bucket_[bucket_of(through_face, current) % buckets].push_back({through_face, next});
        ++waiting;
      }
    };

    distance_[source] = -1;
    shorten_paths_over(source, 0);
    for (; waiting > 0; ++current) {
      std::vector<Reached>& bucket = bucket_[current % buckets];
      for (std::size_t i = 0; i < bucket.size(); ++i) {  // NOLINT(modernize-loop-convert): it may grow on the way
        const Reached reached = bucket[i];
        if (reached.distance == distance_[reached.face]) shorten_paths_over(reached.face, reached.distance);
      }
      waiting -= bucket.size();
      bucket.clear();
    }
  }

 private:
  struct Reached {
    double distance;
    Index face;
  };

  static constexpr std::size_t buckets = 64;

  /// What lies beyond the last bucket is visited with it, too early at worst.
  std::size_t bucket_of(double distance, std::size_t current) const {
    const double last = static_cast<double>(current + buckets - 1);
    return static_cast<std::size_t>(std::min(distance * buckets_per_length_, last));
  }

  const Dual_graph& graph_;
  std::vector<double> cost_, distance_;
  double buckets_per_length_ = 0;
  std::array<std::vector<Reached>, buckets> bucket_;
};

/// The first face whose value is the greatest but for rounding, so that a symmetric mesh gives the same answer in every
/// position.
template <class Values>
Dual_graph::Index first_greatest(const Values& values) {
  const double greatest = *std::max_element(values.begin(), values.end());
  const double limit = greatest - 1e-9 * std::abs(greatest);
  return static_cast<Dual_graph::Index>(
      std::find_if(values.begin(), values.end(), [&](double value) { return value >= limit; }) - values.begin());
}

/// The face whose centroid is farthest from the centroid of the surface.
inline Dual_graph::Index face_farthest_from_centroid(const Face_geometry& geometry) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (std::size_t f = 0; f < geometry.area.size(); ++f) moment += geometry.area[f] * geometry.centroid[f];
  const Eigen::Vector3d centroid = geometry.total_area > 0 ? moment / geometry.total_area : moment;
  std::vector<double> distance;
  distance.reserve(geometry.area.size());
  for (const Eigen::Vector3d& x : geometry.centroid) distance.push_back((x - centroid).norm());
  return first_greatest(distance);
}

/// Adds a source in each component that has none, its first face, and returns these faces.
inline std::vector<Dual_graph::Index> reach_all_components(Distances_to_sources& distance) {
  std::vector<Dual_graph::Index> added;
  for (std::size_t f = 0; f < (*distance).size(); ++f) {
    const auto face = static_cast<Dual_graph::Index>(f);
    if (!std::isinf(distance[face])) continue;
    distance.add_source(face);
    added.push_back(face);
  }
  return added;
}

/// Farthest-point sampling from the `given` faces, which must differ: `count` others.
/// \throws std::invalid_argument if `count` is less than the number of components without a given face
inline std::vector<Dual_graph::Index> farthest_faces(const Dual_graph& graph, const Face_geometry& geometry,
                                                     const Feature_sensitive_metric& metric,
                                                     const std::vector<Dual_graph::Index>& given, std::size_t count,
                                                     const Progress& progress) {
  Distances_to_sources distance(graph, metric.edge_lengths(graph));
  std::vector<Dual_graph::Index> seeds;
  if (given.empty()) seeds.push_back(face_farthest_from_centroid(geometry));
  for (const auto face : given) distance.add_source(face);
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

/// The core of `feature_sensitive_seeds()`: `normals` in the order of the faces, no face given twice, at least as many
/// others as `count`.
inline std::vector<Dual_graph::Index> feature_sensitive_seeds(const Dual_graph& graph, const Face_geometry& geometry,
                                                              const std::vector<Eigen::Vector3d>& normals,
                                                              const std::vector<Dual_graph::Index>& given,
                                                              std::size_t count,
                                                              const Farthest_point_sampling& sampling,
                                                              const Progress& progress) {
  const Feature_sensitive_metric metric(geometry, normals, sampling.normal_weight());
  return farthest_faces(graph, geometry, metric, given, count, progress);
}

/// Seeds as numbers of faces, each once.
/// \throws std::invalid_argument if a seed is not a face of the mesh, naming its place
template <class FaceListGraph, class SeedRange>
std::vector<Dual_graph::Index> read_seeds(const Mesh_dual_graph<FaceListGraph>& graph, const SeedRange& seeds) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  std::vector<Dual_graph::Index> faces;
  std::vector<bool> known(graph.number_of_faces(), false);
  std::size_t place = 0;
  for (const auto& seed : seeds) {
    Dual_graph::Index face = 0;
    if constexpr (std::is_convertible_v<decltype(seed), face_descriptor>)
      face = graph.index(seed);
    else
      face = graph.index(seed.first);
    if (face == graph.none)
      throw std::invalid_argument("given seed " + std::to_string(place) + " is not a face of the mesh");
    if (!known[face]) faces.push_back(face);
    known[face] = true;
    ++place;
  }
  return faces;
}

/// Checks and chains the stages; `read_normals(graph, geometry)` gives the normals in the order of the faces.
template <class FaceListGraph, class ReadNormals, class OutputIterator, class SeedRange, class Sampling,
          class NamedParameters>
OutputIterator feature_sensitive_seeds_of_mesh(const FaceListGraph& mesh, const ReadNormals& read_normals,
                                               std::size_t count, OutputIterator seeds, const SeedRange& given,
                                               const Sampling& sampling, const NamedParameters& np) {
  if (count == 0) throw argument_error("count", count, "at least 1");
  const Mesh_dual_graph<FaceListGraph> graph(mesh);
  const std::vector<Dual_graph::Index> given_faces = read_seeds(graph, given);
  if (graph.number_of_faces() == 0) return seeds;
  const std::size_t free_faces = graph.number_of_faces() - given_faces.size();
  if (count > free_faces)
    throw argument_error("count", count, ("at most " + std::to_string(free_faces) + ", the faces not given").c_str());

  const Face_geometry geometry = face_geometry(mesh, graph, np);
  const std::vector<Eigen::Vector3d> normals = read_normals(graph, geometry);
  for (const auto face :
       feature_sensitive_seeds(graph, geometry, normals, given_faces, count, sampling, progress_of(np)))
    *seeds++ = graph.face(face);
  return seeds;
}

}  // namespace internal

/// Finds seeds that lie evenly on a mesh in the feature-sensitive metric |dx|^2 + w^2 |dn|^2 (section 4.2.1 of the
/// paper): the normals n count like places x, so that edges and curved parts get more seeds than flat ones.
///
/// The user's own seeds are kept: sampling goes on from the `given` ones, and writes only what it adds. Seeds that the
/// user adds afterwards need no word.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph` with faces of any degree
/// \tparam FaceNormalMap a readable property map from `face_descriptor` to a vector with `operator[]`
/// \tparam OutputIterator accepts `face_descriptor`
/// \tparam SeedRange a range of face descriptors, or of pairs of a face descriptor and anything
/// \tparam Sampling `Farthest_point_sampling`, exact and deterministic, or `Particle_sampling`, more even
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh; without faces it gets no seeds
/// \param normals the faces' outward normals of any length, such as those of `smoothed_face_normals()`; a zero vector
/// says that a face has none, and makes it look like its neighbours
/// \param count how many seeds to find besides the given ones
/// \param seeds output, the seeds found, in the order in which they were found
/// \param given seeds that are there already
/// \param sampling how seeds are spread, and w
/// \param np `vertex_point_map` (default: that of the mesh), `callback` (`std::function<bool(double)>`, `false` cancels)
/// \returns `seeds` after the last seed written
/// \throws std::invalid_argument if `count` is 0, more than the faces not given, or less than the number of connected
/// components without a given seed, since each component gets a seed; if a given seed is not a face of the mesh; if a
/// normal or a coordinate is not finite; nothing is written then
/// \throws Cancelled if the callback ends it; nothing is written then
///
/// Complexity with `Farthest_point_sampling`, for n faces and k seeds: about O(n log k) for the paths and k n
/// comparisons; 40 seeds take some 3 ms on 20K faces, 0.2 s on 640K.
template <class FaceListGraph, class FaceNormalMap, class OutputIterator,
          class SeedRange = std::array<typename boost::graph_traits<FaceListGraph>::face_descriptor, 0>,
          class Sampling = Farthest_point_sampling, class NamedParameters = CGAL::parameters::Default_named_parameters>
OutputIterator feature_sensitive_seeds(const FaceListGraph& mesh, const FaceNormalMap& normals, std::size_t count,
                                       OutputIterator seeds, const SeedRange& given = {},
                                       const Sampling& sampling = Sampling(),
                                       const NamedParameters& np = CGAL::parameters::default_values()) {
  return internal::feature_sensitive_seeds_of_mesh(
      mesh, [&](const auto& graph, const auto&) { return internal::read_normals(graph, normals); }, count, seeds, given,
      sampling, np);
}

/// As above, with the faces' own normals.
template <class FaceListGraph, class OutputIterator,
          class SeedRange = std::array<typename boost::graph_traits<FaceListGraph>::face_descriptor, 0>,
          class Sampling = Farthest_point_sampling, class NamedParameters = CGAL::parameters::Default_named_parameters>
OutputIterator feature_sensitive_seeds(const FaceListGraph& mesh, std::size_t count, OutputIterator seeds,
                                       const SeedRange& given = {}, const Sampling& sampling = Sampling(),
                                       const NamedParameters& np = CGAL::parameters::default_values()) {
  return internal::feature_sensitive_seeds_of_mesh(
      mesh, [](const auto&, const auto& geometry) { return geometry.normal; }, count, seeds, given, sampling, np);
}

}  // namespace RW_segmentation

#endif
