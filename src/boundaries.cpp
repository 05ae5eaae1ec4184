// SPDX-License-Identifier: MIT

// Boundaries of segments.

#include <RW_segmentation/internal/definitions/smooth_boundaries.h>
