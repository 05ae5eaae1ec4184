// SPDX-License-Identifier: MIT

// Meshes that come in tiles.

#include <RW_segmentation/internal/definitions/tiled_boundaries.h>
#include <RW_segmentation/internal/definitions/tiled_segmentation.h>
#include <RW_segmentation/internal/definitions/tiled_surfaces.h>
