// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_ANY_WALK_SOLVER_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_ANY_WALK_SOLVER_H

#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/walk/Any_walk_solver.h>

#include <algorithm>
#include <vector>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE Any_walk_solver::Any_walk_solver() : Any_walk_solver(Star_mesh_elimination()) {}

/// As `columns()`, of a solver that has no such function: a few right hand sides at a time, since all take much memory.
RW_SEGMENTATION_INLINE std::vector<std::vector<double>> Any_walk_solver::columns_of_potentials(
    const Concept& solver, Eigen::Index absorbing_faces) {
  constexpr Eigen::Index block = 8;
  std::vector<std::vector<double>> columns;
  for (Eigen::Index first = 0; first < absorbing_faces; first += block) {
    const Eigen::Index width = std::min(block, absorbing_faces - first);
    Potentials boundary = Potentials::Zero(absorbing_faces, width), result;
    boundary.middleRows(first, width).setIdentity();
    solver.potentials(boundary, result);
    for (Eigen::Index l = 0; l < width; ++l) columns.emplace_back(result.col(l).begin(), result.col(l).end());
  }
  return columns;
}

}  // namespace RW_segmentation::internal

#endif
