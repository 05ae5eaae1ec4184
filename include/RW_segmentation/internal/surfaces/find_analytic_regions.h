// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_FIND_ANALYTIC_REGIONS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_FIND_ANALYTIC_REGIONS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/surfaces/Analytic_regions.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>

namespace RW_segmentation::internal {

/// The regions of a mesh that lie on one analytic surface each.
///
/// Noise of vertices hides the surfaces of a CAD kernel's large triangles, which have few of them, although their planes
/// are known well: such triangles are cut into small ones for it, so that surfaces are weighed by their area. Where
/// borders are, the faces themselves tell then: those that surfaces share belong to the one that holds all corners.
Analytic_regions find_analytic_regions(const Dual_mesh& mesh, const Surface_tolerance& tolerance,
                                       const Progress& progress);

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/find_analytic_regions.h>
#endif

#endif
