// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_TILES_RUN_TILES_H
#define SEGMENT_MESH_TILES_RUN_TILES_H

#include "../Options.h"
#include "../Task.h"
#include "../report.h"

#include <vector>

namespace segment_mesh {

/// Segments tiles of one mesh, all steps with workers of its own, or the one step that is asked for.
/// \param report what was done; null after a single step
/// \throws what the steps throw, RW_segmentation::Cancelled
Exit_code run_tiles(std::vector<Task> tiles, const Options& options, Json& report);

}  // namespace segment_mesh

#endif
