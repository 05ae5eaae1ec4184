// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_FEATURE_SENSITIVE_SEEDS_H
#define RW_SEGMENTATION_FEATURE_SENSITIVE_SEEDS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/mesh/Components.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/seeds/read_seeds.h>
#include <RW_segmentation/internal/threads.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <Eigen/Core>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// Places exactly as many seeds as asked for, each at the face farthest from the seeds before it; deterministic.
///
/// Distances are lengths of paths over neighbouring faces. The farthest face is at most twice as far from its seed as
/// with the best placement of so many seeds (Gonzalez 1985). On large meshes that holds but for the size of
/// clusters of some 20 faces, over which paths lead there; over faces after all where less than 50 clusters would be left for
/// each seed.
class Farthest_point_sampling {
 public:
  Farthest_point_sampling() = default;

  /// \param normal_weight w of the metric |dx|^2 + w^2 |dn|^2, as a fraction of the square root of the total area; 0.05
  /// if not given
  /// \param largest_direct up to so many faces paths lead over faces
  /// \throws std::invalid_argument unless `normal_weight` is finite and not negative
  explicit Farthest_point_sampling(double normal_weight, std::size_t largest_direct = default_largest_direct);

  /// w as a fraction of the square root of the total area.
  double normal_weight() const { return normal_weight_; }

  /// Up to so many faces paths lead over faces, and over clusters of faces on larger meshes.
  std::size_t largest_direct() const { return largest_direct_; }

  /// Finds seeds by the normals of the shape, none of them beyond a wall from its component.
  /// \param given seeds that are there already, all different
  /// \param count how many to find besides them, at most the number of other faces
  /// \throws std::invalid_argument if `count` is less than the number of components without a given seed
  /// \throws Cancelled
  std::vector<Dual_mesh::Index> operator()(const Dual_mesh& mesh, const std::vector<Dual_mesh::Index>& given,
                                           std::size_t count, const Progress& progress = {}) const;

 private:
  double normal_weight_ = 0.05;
  static constexpr std::size_t default_largest_direct = 100000;  // faces, as in Walk_reduction
  std::size_t largest_direct_ = default_largest_direct;
};

/// Seeds that lie evenly on the shape, a seeding policy: a function object from a dual mesh, the difference of its edges and
/// the seeds that are given to the seeds that it adds.
///
/// \tparam Sampling `Farthest_point_sampling`, or `Particle_sampling` as in the paper
template <class Sampling = Farthest_point_sampling>
struct Feature_sensitive_seeding {
  std::size_t count = 40;  ///< for a mesh besides the given ones, and one more for each further connected component
  Sampling sampling;       ///< how they are spread

  /// \throws std::invalid_argument if `count` is 0
  /// \throws Cancelled
  std::vector<Dual_mesh::Index> operator()(const Dual_mesh& mesh, const std::vector<double>& /* difference */,
                                           const std::vector<Dual_mesh::Index>& given,
                                           const Progress& progress = {}) const {
    if (count == 0) throw internal::argument_error("count", count, "at least 1");
    const internal::Components components(mesh.graph(), [&](Dual_mesh::Index e) { return !mesh.is_wall(e); });
    return sampling(mesh, given, std::min(count + components.count - 1, mesh.number_of_faces() - given.size()),
                    progress);
  }
};

/// Finds seeds that lie evenly on a mesh in the feature-sensitive metric |dx|^2 + w^2 |dn|^2 (section 4.2.1 of the
/// paper): the normals n count like places x, so that edges and curved parts get more seeds than flat ones.
///
/// The user's own seeds are kept: sampling goes on from the `given` ones, and writes only what it adds. Seeds that the
/// user adds afterwards need no word.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
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
/// \param np `vertex_point_map` (default: that of the mesh), `edge_is_constrained_map` (default: no edge is), `callback` (`std::function<bool(double)>`, `false` cancels)
/// \returns `seeds` after the last seed written
/// \throws std::invalid_argument if `count` is 0, more than the faces not given, or less than the number of connected
/// components without a given seed, since each component gets a seed; if a given seed is not a face of the mesh; if a
/// normal or a coordinate is not finite; nothing is written then
/// \throws Cancelled if the callback ends it; nothing is written then
///
/// Complexity with `Farthest_point_sampling`, for n faces and k seeds: about O(n log k) for the paths and k n
/// comparisons; 40 seeds take some 3 ms on 20K faces, 80 ms on 640K.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class FaceNormalMap,
          class OutputIterator,
          class SeedRange = std::array<typename boost::graph_traits<FaceListGraph>::face_descriptor, 0>,
          class Sampling = Farthest_point_sampling, class NamedParameters = CGAL::parameters::Default_named_parameters>
OutputIterator feature_sensitive_seeds(const FaceListGraph& mesh, const FaceNormalMap& normals, std::size_t count,
                                       OutputIterator seeds, const SeedRange& given = {},
                                       const Sampling& sampling = Sampling(),
                                       const NamedParameters& np = CGAL::parameters::default_values()) {
  return internal::with_threads<ConcurrencyTag>([&] {
    const auto& dual = internal::dual_mesh(mesh, np);
    const Dual_mesh_of shape(dual.with_shape_normals(dual.read_normals(normals)), dual);
    return feature_sensitive_seeds<ConcurrencyTag>(shape, count, seeds, given, sampling, internal::only_callback(np));
  });
}

/// As above, with the normals of the shape: the faces' own, or those of `smoothed_shape()`.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class OutputIterator,
          class SeedRange = std::array<typename boost::graph_traits<FaceListGraph>::face_descriptor, 0>,
          class Sampling = Farthest_point_sampling, class NamedParameters = CGAL::parameters::Default_named_parameters>
OutputIterator feature_sensitive_seeds(const FaceListGraph& mesh, std::size_t count, OutputIterator seeds,
                                       const SeedRange& given = {}, const Sampling& sampling = Sampling(),
                                       const NamedParameters& np = CGAL::parameters::default_values()) {
  static_assert(internal::has_only_names_of_stages<NamedParameters>,
                "feature_sensitive_seeds() takes the named parameters vertex_point_map, edge_is_constrained_map and "
                "callback.");
  if (count == 0) throw internal::argument_error("count", count, "at least 1");
  return internal::with_threads<ConcurrencyTag>([&] {
    const auto& dual = internal::dual_mesh(mesh, np);
    const std::vector<Dual_mesh::Index> given_faces = internal::read_seeds(dual, given);
    if (dual.number_of_faces() == 0) return seeds;
    const std::size_t free_faces = dual.number_of_faces() - given_faces.size();
    if (count > free_faces)
      throw internal::argument_error("count", count,
                                     ("at most " + std::to_string(free_faces) + ", the faces not given").c_str());
    for (const auto face : sampling(dual, given_faces, count, internal::progress_of(np))) *seeds++ = dual.face(face);
    return seeds;
  });
}

/// As above, with named parameters after the output.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class FaceNormalMap,
          class OutputIterator, class T, class Tag, class Base>
OutputIterator feature_sensitive_seeds(const FaceListGraph& mesh, const FaceNormalMap& normals, std::size_t count,
                                       OutputIterator seeds, const CGAL::Named_function_parameters<T, Tag, Base>& np) {
  return feature_sensitive_seeds<ConcurrencyTag>(mesh, normals, count, seeds, internal::no_seeds<FaceListGraph>,
                                                 Farthest_point_sampling(), np);
}

/// \overload
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class OutputIterator, class T,
          class Tag, class Base>
OutputIterator feature_sensitive_seeds(const FaceListGraph& mesh, std::size_t count, OutputIterator seeds,
                                       const CGAL::Named_function_parameters<T, Tag, Base>& np) {
  return feature_sensitive_seeds<ConcurrencyTag>(mesh, count, seeds, internal::no_seeds<FaceListGraph>,
                                                 Farthest_point_sampling(), np);
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/feature_sensitive_seeds.h>
#endif

#endif
