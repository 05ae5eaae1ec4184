// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_ANY_WALK_SOLVER_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_ANY_WALK_SOLVER_H

#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/walk/Any_walk_solver.h>

namespace RW_segmentation::internal {

RW_SEGMENTATION_INLINE Any_walk_solver::Any_walk_solver() : Any_walk_solver(Star_mesh_elimination()) {}

}  // namespace RW_segmentation::internal

#endif
