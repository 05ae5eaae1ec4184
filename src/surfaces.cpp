// SPDX-License-Identifier: MIT

// Surfaces of machine parts.

#include <RW_segmentation/internal/definitions/Analytic_surface.h>
#include <RW_segmentation/internal/definitions/Analytic_surface_cost.h>
#include <RW_segmentation/internal/definitions/find_analytic_regions.h>
#include <RW_segmentation/internal/definitions/regular_surfaces.h>
#include <RW_segmentation/internal/definitions/segment_surfaces.h>
#include <RW_segmentation/internal/definitions/segmentation_into_surfaces.h>
