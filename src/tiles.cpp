// SPDX-License-Identifier: MIT

// Boundaries of segments, and meshes that come in tiles, which share what moves them.

#include <RW_segmentation/internal/definitions/smooth_boundaries.h>
#include <RW_segmentation/internal/definitions/tiled_boundaries.h>
#include <RW_segmentation/internal/definitions/tiled_segmentation.h>
#include <RW_segmentation/internal/definitions/tiled_surfaces.h>
