// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_FURTHER_SEEDINGS_H
#define RW_SEGMENTATION_INTERNAL_WALK_FURTHER_SEEDINGS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/walk/Any_walk_solver.h>
#include <RW_segmentation/internal/walk/Common_refinement.h>
#include <RW_segmentation/internal/walk/Walk_network.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace RW_segmentation::internal {

/// What a first seeding has made of a mesh.
struct First_seeding {
  const std::vector<Dual_mesh::Index>& seeds;        ///< those that were given come first
  std::size_t given;                                 ///< how many of them these are
  const std::vector<std::size_t>& fragment_of_face;  ///< numbered from 0
  bool is_reduced;                                   ///< whether its walk ran over clusters of faces
};

/// The common refinement of the fragments of a first seeding and further ones. Each has as many seeds as the first one, and
/// begins at those that are given and the last one of the seeding before.
///
/// What is sought is where other seeds would have parted the mesh, and that a coarse walk tells as well: these walks run over
/// about a thousand clusters of faces, which all of them share. A cluster lies in one fragment of the first seeding. Unless
/// the first walk was reduced, and so depends on the order of the faces, nothing does but where two faces are equally far from
/// the first seed.
/// \param shape the mesh, with the normals that seeds see
/// \param network that of its faces
/// \param first with a seed at least that is not given
/// \param count how many further seedings
/// \param make_solver returns a solver that has analysed nothing yet
/// Complexity: O(m log m) for m faces.
Common_refinement refine_by_further_seedings(const Dual_mesh& shape, const Walk_network& network,
                                             const First_seeding& first, std::size_t count,
                                             const std::function<Any_walk_solver()>& make_solver,
                                             const Progress& progress);

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/further_seedings.h>
#endif

#endif
