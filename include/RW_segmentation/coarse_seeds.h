// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_COARSE_SEEDS_H
#define RW_SEGMENTATION_COARSE_SEEDS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/threads.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// Ends coarse seeding at exactly so many seeds; a model of `SeedStopPredicate`.
class Seed_count_stop {
 public:
  /// \throws std::invalid_argument if `number_of_seeds` is 0
  explicit Seed_count_stop(std::size_t number_of_seeds) : number_of_seeds_(number_of_seeds) {
    if (number_of_seeds == 0) throw internal::argument_error("number_of_seeds", number_of_seeds, "at least 1");
  }

  /// Whether there are enough seeds without the candidate.
  bool operator()(const std::vector<double>& separation) const { return separation.size() > number_of_seeds_; }

 private:
  std::size_t number_of_seeds_;
};

/// Ends coarse seeding where the separation of the seeds falls below a threshold; a model of `SeedStopPredicate`.
///
/// The recommended one: on the meshes of the Princeton Segmentation Benchmark, segments grown from its seeds differ
/// less from those of people than with `Separation_decrease_stop` or any one count.
class Separation_threshold_stop {
 public:
  /// \param threshold the least separation of a seed, in the units of `coarse_seeds()`
  /// \throws std::invalid_argument unless `threshold` is finite and not negative
  explicit Separation_threshold_stop(double threshold = 0.4) : threshold_(threshold) {
    if (!(threshold >= 0 && std::isfinite(threshold)))
      throw internal::argument_error("threshold", threshold, "finite and not negative");
  }

  /// A candidate that no difference separates from the seeds is never a seed.
  bool operator()(const std::vector<double>& separation) const {
    return separation.back() == 0 || separation.back() < threshold_;
  }

 private:
  double threshold_;
};

/// Ends coarse seeding where the separation of the seeds has decreased significantly, as in section 4.1 of the paper; a
/// model of `SeedStopPredicate`.
///
/// The decrease is measured from the largest separation, that of the second seed of a component: on natural shapes
/// separations decline in many small steps, so that the step from one seed to the next tells little.
class Separation_decrease_stop {
 public:
  /// \param decrease the fraction of the largest separation that counts as a significant decrease
  /// \throws std::invalid_argument unless 0 < `decrease` <= 1
  explicit Separation_decrease_stop(double decrease = 0.6) : decrease_(decrease) {
    if (!(decrease > 0 && decrease <= 1)) throw internal::argument_error("decrease", decrease, "above 0 and at most 1");
  }

  /// A candidate that no difference separates from the seeds is never a seed.
  bool operator()(const std::vector<double>& separation) const {
    const double candidate = separation.back();
    const double largest =
        *std::find_if(separation.begin(), separation.end() - 1, [](double s) { return std::isfinite(s); });
    return candidate == 0 || candidate < (1 - decrease_) * largest;
  }

 private:
  double decrease_;
};

namespace internal {

/// The seeds that are added to the `given` ones.
/// \param differences in the order of the edges
/// \param stop see `coarse_seeds()`
std::vector<Dual_mesh::Index> coarse_seeds_of(const Dual_mesh& mesh, const std::vector<double>& differences,
                                              const std::vector<Dual_mesh::Index>& given,
                                              const std::function<bool(const std::vector<double>&)>& stop,
                                              const Progress& progress);

}  // namespace internal

/// Few seeds, one for each large structure, a seeding policy: a function object from a dual mesh, the difference of its
/// edges and the seeds that are given to the seeds that it adds. See `coarse_seeds()`; given seeds count as the first ones.
///
/// \tparam SeedStopPredicate a model of `SeedStopPredicate`
template <class SeedStopPredicate = Separation_threshold_stop>
struct Coarse_seeding {
  SeedStopPredicate stop;  ///< when to end

  /// \throws std::invalid_argument as `coarse_seeds()`
  /// \throws Cancelled
  std::vector<Dual_mesh::Index> operator()(const Dual_mesh& mesh, const std::vector<double>& difference,
                                           const std::vector<Dual_mesh::Index>& given,
                                           const Progress& progress = {}) const {
    return internal::coarse_seeds_of(mesh, difference, given, stop, progress);
  }
};

/// Finds few seeds, one for each large structure of a mesh (section 4.1 of the paper, Eq. 9).
///
/// The first seed is the face geodesically farthest from the face closest to the mesh's centroid. Each further one is
/// the face with the largest separation: with D(f, g) = the least sum of differences over all paths of faces from f to
/// g, the face that maximises min D(f, s) over the seeds s so far. Of faces equally separated, as on a flat mesh, it is
/// the one at the largest geodesic distance from the seeds, then the one that `Dual_mesh` numbers lowest. Geodesic
/// distance is the length of a path over the centroids of faces. It ends where `stop` finds the last separation too
/// small; that candidate is no seed.
///
/// Separations are told in units of the mean difference times the square root of the number of faces, which is about
/// the number of edges on a way across the mesh. So they depend neither on the resolution of the mesh nor on the scale
/// of the difference.
///
/// Each connected component gets a first seed of its own; these come first, and their separation is infinite.
///
/// A difference that sees convex edges, too, tells the parts of a shape apart best: the angle between smoothed normals
/// with a convex weight of 0.5, even where the walk afterwards heeds concave edges alone.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph` with faces of any degree
/// \tparam Difference a readable property map from `edge_descriptor` to a number >= 0: `Dihedral_difference`,
/// `Curvature_difference`, a stored map, a lambda in a `boost::function_property_map`; it is asked once for each edge
/// \tparam SeedStopPredicate a function from `const std::vector<double>&`, the separations of the seeds in their order
/// with that of the candidate at the end, to `bool`, whether seeding ends without the candidate: `Seed_count_stop`,
/// `Separation_threshold_stop`, `Separation_decrease_stop`, a lambda
/// \tparam OutputIterator accepts `face_descriptor`
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh; without faces it gets no seeds
/// \param difference how much the two faces beside an edge differ
/// \param stop when to end
/// \param seeds output, the seeds in the order in which they were found
/// \param np `vertex_point_map` (default: that of the mesh), `edge_is_constrained_map` (default: no edge is), `callback` (`std::function<bool(double)>`, `false` cancels)
/// \returns `seeds` after the last seed written
/// \throws std::invalid_argument if `stop` ends before each component has a seed or when all faces are seeds, if a
/// difference is negative or NaN, or a coordinate is not finite; nothing is written then
/// \throws Cancelled if the callback ends it; nothing is written then
///
/// Complexity: a run of Dijkstra's algorithm a seed, warm-started: it visits the faces that come closer only, so that
/// n faces and k seeds take O(n log n log k) on most meshes instead of O(k n log n), plus O(k n) comparisons.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class Difference,
          class SeedStopPredicate, class OutputIterator,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
OutputIterator coarse_seeds(const FaceListGraph& mesh, const Difference& difference, const SeedStopPredicate& stop,
                            OutputIterator seeds, const NamedParameters& np = CGAL::parameters::default_values()) {
  static_assert(std::is_invocable_r_v<bool, const SeedStopPredicate&, const std::vector<double>&>,
                "stop must be a function from std::vector<double>, the separations of the seeds, to bool.");
  static_assert(internal::has_only_names_of_stages<NamedParameters>,
                "coarse_seeds() takes the named parameters vertex_point_map, edge_is_constrained_map and callback.");
  return internal::with_threads<ConcurrencyTag>([&] {
    const auto& dual = internal::dual_mesh(mesh, np);
    const Coarse_seeding<SeedStopPredicate> seeding{stop};
    for (const auto f : seeding(dual, dual.read_edges(difference, "difference"), {}, internal::progress_of(np)))
      *seeds++ = dual.face(f);
    return seeds;
  });
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/coarse_seeds.h>
#endif

#endif
