// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_SEGMENTATION_POLICIES_H
#define RW_SEGMENTATION_SEGMENTATION_POLICIES_H

#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Learned_cost.h>
#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/Size_aware_cost.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/Walk_reduction.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// What `segmentation_via_random_walks()` is made of: five policies, and the numbers of what lies between them.
///
/// Each policy may be of any type that models its concept, written by anybody:
/// \code
/// segmentation_via_random_walks(mesh, ids, Automatic_segmentation().with_difference(my_difference)
///                                                                  .with_merge_cost(My_cost()));
/// \endcode
///
/// \tparam DifferencePolicy a model of `Difference`: a readable property map from `edge_descriptor` to a number >= 0, or a
/// function object from a `Dual_mesh_of` to one, or to a `std::vector<double>` in the order of its edges
/// \tparam SeedingPolicy a model of `Seeding`: a function object from a `Dual_mesh_of`, the difference of its edges and the
/// seeds that are given, as numbers of faces, to the seeds that it adds
/// \tparam SolverPolicy a model of `WalkSolver`, which is copied, or a function object that returns one
/// \tparam MergeCostPolicy a model of `MergeCost`, or a function object from a `Dual_mesh_of` to one
/// \tparam StopPolicy a model of `StopPredicate`
template <class DifferencePolicy, class SeedingPolicy, class SolverPolicy, class MergeCostPolicy, class StopPolicy>
struct Segmentation_policies {
  Normal_smoothing smoothing;   ///< of the shape that all policies see, see `smoothed_shape()`
  DifferencePolicy difference;  ///< how different the two faces of an edge are
  double sigma = 1;             ///< of the conductance, see `Conductance`
  double cap = 20;              ///< of the conductance
  SeedingPolicy seeding;        ///< where walks begin
  SolverPolicy solver;          ///< what finds out where they end
  Walk_reduction reduction;     ///< of the walk on large meshes
  MergeCostPolicy merge_cost;   ///< which segments are joined first
  StopPolicy stop;              ///< and when no more are
  /// How many times seeds are placed, each time from the last seed of the time before on. With several, fragments of each
  /// are merged, and then the pieces of their common refinement by what the seedings agree on, which suits a merge cost that
  /// is 1 where it is as well to merge as not to. Walks run over the faces once, then over about a thousand clusters of faces.
  /// Memory grows with the square of the number of seeds. Policies with another seeding or merge cost have 1 again.
  std::size_t seedings = 1;
  /// Whether each connected component, across walls, is segmented as it is by itself: policies see nothing else, it alone
  /// tells what is large, and all seeds are placed in each. Otherwise the whole mesh tells, and all seeds are placed in it,
  /// with one more for each further component. Policies with another seeding are of the whole again.
  bool by_component = false;
  /// The area below which a component is one segment by that, as a share of that of the largest one; unless it holds walls
  /// or given seeds. 0: none is. The debris of a scan, of less than a hundredth, would be cut into pieces of a few faces.
  double least_component = 0.01;
  /// Whether several components may be segmented at the same time by that, where TBB is linked: policies are called from
  /// several threads then. The result is the same. Policies with a difference, seeding, solver or merge cost of one's own may
  /// not be, unless it is said again.
  bool concurrent_components = false;

  /// These policies with another difference.
  template <class Other>
  auto with_difference(Other other) const {
    return with(std::move(other), seeding, solver, merge_cost, stop);
  }
  /// These policies with another seeding, which is the only one, since further ones would not be placed by it, and that of
  /// the whole mesh.
  template <class Other>
  auto with_seeding(Other other) const {
    auto policies = with(difference, std::move(other), solver, merge_cost, stop);
    policies.seedings = 1;
    policies.by_component = false;
    return policies;
  }
  /// These policies with another solver.
  template <class Other>
  auto with_solver(Other other) const {
    return with(difference, seeding, std::move(other), merge_cost, stop);
  }
  /// These policies with another merge cost, and one seeding: a cost may mean anything where several agree.
  template <class Other>
  auto with_merge_cost(Other other) const {
    auto policies = with(difference, seeding, solver, std::move(other), stop);
    policies.seedings = 1;
    return policies;
  }
  /// These policies with another stop.
  template <class Other>
  auto with_stop(Other other) const {
    auto policies = with(difference, seeding, solver, merge_cost, std::move(other));
    policies.concurrent_components = concurrent_components;
    return policies;
  }

 private:
  template <class D, class S, class W, class M, class P>
  Segmentation_policies<D, S, W, M, P> with(D d, S s, W w, M m, P p) const {
    return {smoothing, std::move(d), sigma,        cap,      std::move(s), std::move(w),
            reduction, std::move(m), std::move(p), seedings, by_component, least_component};
  }
};

/// Any stop, so that it may be chosen while a program runs.
using Any_stop = std::function<std::size_t(const Merge_tree&)>;

/// `Size_aware_cost` with the thickness of the solid, measured on the shape: a function object from a dual mesh to a merge
/// cost.
struct Size_aware_cost_policy {
  Thickness_sampling thickness;  ///< 0 samples: thickness does not count

  /// \throws std::invalid_argument if a number of `thickness` is out of range
  Size_aware_cost operator()(const Dual_mesh& mesh) const;
};

/// `Learned_cost` with the thickness of the solid, measured on the shape: a function object from a dual mesh to a merge cost.
struct Learned_cost_policy {
  Thickness_sampling thickness;  ///< 0 samples: neither thickness nor what was learned counts

  /// \throws std::invalid_argument if a number of `thickness` is out of range
  Learned_cost operator()(const Dual_mesh& mesh) const;
};

namespace internal {

using Automatic_policies =
    Segmentation_policies<Dihedral_difference_policy, Feature_sensitive_seeding<Farthest_point_sampling>,
                          Star_mesh_elimination, Learned_cost_policy, Any_stop>;
/// Twice as many seeds as segments are asked for, so that there is something to choose from.
inline std::size_t seeds_for(std::size_t segments, std::size_t least) { return std::max(least, 2 * segments); }

}  // namespace internal

/// The policies that agree best with people: segments are cut where smoothed normals turn inward. Walks from a few dozen
/// seeds make the fragments, twice, and fragments are merged by their size, their thickness and what was learned from people.
///
/// `Automatic_segmentation().with_merge_cost(Size_aware_cost_policy())` leaves out what was learned, and the second seeding.
struct Automatic_segmentation : internal::Automatic_policies {
  /// As many segments as the shape suggests: merging stops at cost 1.
  Automatic_segmentation();

  /// As many segments as that, at least one for each connected component.
  explicit Automatic_segmentation(std::size_t segments);
};

namespace internal {

template <class D, class S, class W, class M, class P>
std::true_type derives_from_policies(const Segmentation_policies<D, S, W, M, P>*);
std::false_type derives_from_policies(const void*);

/// Whether it is one of `Segmentation_policies`.
template <class T>
constexpr bool is_segmentation_policies = decltype(derives_from_policies(std::declval<const T*>()))::value;

}  // namespace internal
}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Segmentation_policies.h>
#endif

#endif
