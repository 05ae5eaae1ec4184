// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILED_SEGMENTATION_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILED_SEGMENTATION_H

#include <RW_segmentation/internal/definitions/tile_merging.h>
#include <RW_segmentation/internal/definitions/tile_planning.h>
#include <RW_segmentation/internal/definitions/tile_shape.h>
#include <RW_segmentation/internal/definitions/tile_walk.h>

#endif
