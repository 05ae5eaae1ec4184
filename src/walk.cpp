// SPDX-License-Identifier: MIT

// Seeds, walks and what is merged.

#include <RW_segmentation/internal/definitions/Graph_walk.h>
#include <RW_segmentation/internal/definitions/Learned_cost.h>
#include <RW_segmentation/internal/definitions/Particle_sampling.h>
#include <RW_segmentation/internal/definitions/Star_mesh_elimination.h>
#include <RW_segmentation/internal/definitions/coarse_seeds.h>
#include <RW_segmentation/internal/definitions/feature_sensitive_seeds.h>
#include <RW_segmentation/internal/definitions/region_boundaries.h>
#include <RW_segmentation/internal/definitions/transfer_segments.h>
#include <RW_segmentation/internal/definitions/walk_fragments.h>
