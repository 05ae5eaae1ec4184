// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_REGION_BOUNDARY_H
#define RW_SEGMENTATION_REGION_BOUNDARY_H

namespace RW_segmentation {

/// Two sums over a set of mesh edges. Lengths are in units of R, the square root of the mesh's total area.
struct Edge_sums {
  double length = 0;      ///< L, the sum of the lengths |e|
  double difference = 0;  ///< D, the sum of |e| d_e

  /// Adds both sums.
  Edge_sums& operator+=(const Edge_sums& other) {
    length += other.length;
    difference += other.difference;
    return *this;
  }
};

/// What a merge cost learns of the boundaries of two neighbouring regions. Border edges of the mesh belong to none.
struct Region_boundary {
  Edge_sums common;  ///< the edges between the two regions
  Edge_sums whole;   ///< the edges round either region, those between the two counted once
};

/// What a merge cost that has a type `Boundary` of its own learns of the boundaries of two neighbouring regions. Border
/// edges of the mesh belong to none, nor do walls.
template <class Boundary>
struct Region_boundary_of {
  const Boundary& common;             ///< the edges between the two regions
  const Boundary& outline_of_first;   ///< the edges between the first region and all of its neighbours
  const Boundary& outline_of_second;  ///< the edges between the second region and all of its neighbours
};

}  // namespace RW_segmentation

#endif
