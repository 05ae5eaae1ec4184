// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_MAKE_SOLVER_H
#define RW_SEGMENTATION_INTERNAL_WALK_MAKE_SOLVER_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/Progress.h>

#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

template <class T, class = void>
struct Is_walk_solver : std::false_type {};
template <class T>
struct Is_walk_solver<
    T,
    std::void_t<
        decltype(std::declval<T&>().analyze(std::declval<const Dual_graph&>())),
        decltype(std::declval<T&>().factorize(std::declval<const std::vector<double>&>(),
                                              std::declval<const std::vector<Dual_graph::Index>&>(),
                                              std::declval<const Progress&>())),
        decltype(std::declval<const T&>().potentials(std::declval<const Potentials&>(), std::declval<Potentials&>())),
        decltype(std::declval<const T&>().response(Dual_graph::Index(), std::declval<const std::vector<double>&>(),
                                                   std::declval<std::vector<double>&>())),
        decltype(std::declval<const T&>().absorbed_currents(Dual_graph::Index()))>> : std::true_type {};

/// Whether it has the functions of a `WalkSolver`.
template <class T>
constexpr bool is_walk_solver = Is_walk_solver<T>::value;

template <class T, class = void>
struct Makes_walk_solver : std::false_type {};
template <class T>
struct Makes_walk_solver<T, std::void_t<decltype(std::declval<const T&>()())>>
    : Is_walk_solver<std::decay_t<decltype(std::declval<const T&>()())>> {};

/// A solver that has analysed nothing yet.
/// \param policy a `WalkSolver`, which is copied, or a function object without arguments that returns one, for solvers
/// that cannot be copied or that need settings of their own
template <class Policy>
auto make_solver(const Policy& policy) {
  static_assert(is_walk_solver<Policy> || Makes_walk_solver<Policy>::value,
                "A solver is a model of WalkSolver, such as Star_mesh_elimination or Eigen_walk_solver, or a function "
                "object without arguments that returns one.");
  if constexpr (is_walk_solver<Policy>)
    return policy;
  else
    return policy();
}

}  // namespace RW_segmentation::internal

#endif
