// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_DEGREE_H
#define SEGMENT_MESH_DEGREE_H

namespace segment_mesh {

/// A degree in radians.
constexpr double degree = 3.14159265358979323846 / 180;

}  // namespace segment_mesh

#endif
