// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_MAKE_SOLVER_H
#define RW_SEGMENTATION_INTERNAL_WALK_MAKE_SOLVER_H

#include <RW_segmentation/internal/walk/Any_walk_solver.h>

#include <type_traits>
#include <utility>

namespace RW_segmentation::internal {

template <class T, class = void>
struct Makes_walk_solver : std::false_type {};
template <class T>
struct Makes_walk_solver<T, std::void_t<decltype(std::declval<const T&>()())>>
    : Is_walk_solver<std::decay_t<decltype(std::declval<const T&>()())>> {};

/// A solver that has analysed nothing yet.
/// \param policy a `WalkSolver`, which is copied, or a function object without arguments that returns one, for solvers
/// that cannot be copied or that need settings of their own
template <class Policy>
Any_walk_solver make_solver(const Policy& policy) {
  static_assert(is_walk_solver<Policy> || Makes_walk_solver<Policy>::value,
                "A solver is a model of WalkSolver, such as Star_mesh_elimination or Eigen_walk_solver, or a function "
                "object without arguments that returns one.");
  if constexpr (is_walk_solver<Policy>)
    return Any_walk_solver(policy);
  else
    return Any_walk_solver(policy());
}

}  // namespace RW_segmentation::internal

#endif
