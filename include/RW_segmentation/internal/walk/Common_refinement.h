// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_COMMON_REFINEMENT_H
#define RW_SEGMENTATION_INTERNAL_WALK_COMMON_REFINEMENT_H

#include <RW_segmentation/Dual_graph.h>

#include <cstddef>
#include <vector>

namespace RW_segmentation::internal {

/// Fragments of the same faces, made from several seedings.
struct Common_refinement {
  std::vector<std::size_t> of_face;                    ///< the piece of each face
  std::vector<std::vector<std::size_t>> fragments_of;  ///< each piece, one of every seeding
};

/// The connected pieces of faces that lie in one fragment by every seeding. They are numbered in the order of their
/// fragments, then of their first faces.
/// \param fragment_of_face of every seeding, by face
/// \param conductance by edge; pieces end where it is 0
/// Complexity: O(n log n) for n pieces, and linear in the number of faces.
Common_refinement common_refinement(const Dual_graph& graph, const std::vector<double>& conductance,
                                    const std::vector<std::vector<std::size_t>>& fragment_of_face);

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Common_refinement.h>
#endif

#endif
