// SPDX-License-Identifier: MIT

// What is measured on a mesh, and threads.

#include "for_each_concurrency.h"

#include <RW_segmentation/internal/definitions/Conductance.h>
#include <RW_segmentation/internal/definitions/Curvature_difference.h>
#include <RW_segmentation/internal/definitions/Dihedral_difference.h>
#include <RW_segmentation/internal/definitions/Dual_graph.h>
#include <RW_segmentation/internal/definitions/Dual_mesh.h>
#include <RW_segmentation/internal/definitions/check_number.h>
#include <RW_segmentation/internal/definitions/integral_invariant_curvatures.h>
#include <RW_segmentation/internal/definitions/local_thickness.h>
#include <RW_segmentation/internal/definitions/long_tasks.h>
#include <RW_segmentation/internal/definitions/smoothed_face_normals.h>
#include <RW_segmentation/internal/definitions/threads.h>

namespace RW_segmentation::internal {

#define RW_SEGMENTATION_INSTANTIATE(ConcurrencyTag)                                                           \
  template std::vector<double> thickness_by_face<ConcurrencyTag>(const Dual_mesh&, const Thickness_of_faces&, \
                                                                 Thickness_report&, const Progress&);         \
  template std::vector<std::vector<Surface_curvatures>> curvatures_of_faces<ConcurrencyTag>(                  \
      const Dual_mesh&, const std::vector<double>&, std::vector<Curvature_report>&, const Progress&);
RW_SEGMENTATION_FOR_EACH_CONCURRENCY(RW_SEGMENTATION_INSTANTIATE)
#undef RW_SEGMENTATION_INSTANTIATE

}  // namespace RW_segmentation::internal
