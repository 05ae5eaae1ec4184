// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_LEARNED_COST_H
#define RW_SEGMENTATION_LEARNED_COST_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Region_boundary.h>
#include <RW_segmentation/Size_aware_cost.h>
#include <RW_segmentation/internal/merging/Boosted_trees.h>
#include <RW_segmentation/internal/merging/Merge_features.h>
#include <RW_segmentation/internal/named_parameters.h>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// Whether enough of a mesh has a thickness to call it a solid: half of the faces, or half of the samples that are taken
/// by default.
/// \param thickness by face, not positive where it is not known
bool is_solid(const std::vector<double>& thickness);
bool is_solid(std::size_t faces_with_thickness, std::size_t faces);

}  // namespace internal

/// The merge cost that is learned from the segments that people make, a model of `MergeCost`.
///
/// cost = c^0.65 q^0.35, with the cost c of `Size_aware_cost` and the odds q that people part two such regions. The odds
/// come from boosted decision trees over features of the two regions and their boundary: sums that are added as regions
/// are joined, none of which depends on the number of faces. Both factors are 1 where it is as well to merge as not to,
/// so that merging is best stopped at cost 1.
///
/// The trees know solids. Where the thickness of neither region is known, of three samples at least, the cost is c. So it
/// is on the whole mesh where less than half of its faces and less than 250 have a thickness: on flat and open meshes, and
/// without thickness, this is `Size_aware_cost`. They see the concavity of the
/// smoothed shape, whatever difference fragments are merged with; c heeds that difference.
///
/// Learned on 190 meshes of the Princeton Segmentation Benchmark, by `benchmark/train_merge_cost.py`; the manual tells how
/// well it does on categories of shapes that were left out. Each cost takes constant time, a few microseconds.
class Learned_cost {
 public:
  /// Sums over the faces of a region.
  struct Region {
    Size_aware_cost::Region size;  ///< for the size-aware factor
    internal::Region_shape shape;  ///< for the learned one
  };

  /// Sums over the edges between regions.
  struct Boundary {
    Edge_sums difference;            ///< for the size-aware factor
    internal::Boundary_shape shape;  ///< for the learned one

    /// Adds all sums.
    Boundary& operator+=(const Boundary& other) {
      difference += other.difference;
      shape += other.shape;
      return *this;
    }
  };

  /// \param shape the mesh, with the normals of `smoothed_shape()`
  /// \param thickness by face, in the unit box; not positive where it is not known; empty: of no face
  /// \param trees others than the library's; they must outlive this
  /// Complexity: linear.
  explicit Learned_cost(const Dual_mesh& shape, std::vector<double> thickness = {},
                        const internal::Boosted_trees& trees = internal::learned_trees());

  /// For the sums of a part of a mesh: its regions and boundaries are told by what is ordinary on the whole.
  /// \param part of the mesh, with the normals of `smoothed_shape()`
  /// \param thickness by face of the part, as above
  Learned_cost(const Dual_mesh& part, std::vector<double> thickness, const internal::Mean_concavity& whole);

  /// For regions and boundaries that are there already; it can make none.
  /// \param is_solid whether enough of the whole mesh has a thickness
  /// \param crease_weight w of the `Size_aware_cost` of the whole mesh
  Learned_cost(bool is_solid, double crease_weight)
      : is_solid_(is_solid), size_aware_({}, crease_weight), trees_(&internal::learned_trees()) {}

  /// With a stored thickness, as `local_thickness()` writes it.
  ///
  /// \tparam FaceListGraph a model of CGAL's `FaceListGraph`, or a `Dual_mesh_of` one
  /// \tparam ThicknessMap a readable property map from `face_descriptor` to `double`
  /// \param shape the mesh, best one that `smoothed_shape()` returned; no reference to it is kept
  /// \param thickness in the mesh's unit of length; 0 where it is not known
  /// Complexity: linear.
  template <class FaceListGraph, class ThicknessMap,
            std::enable_if_t<!std::is_same_v<ThicknessMap, std::vector<double>>, int> = 0>
  Learned_cost(const FaceListGraph& shape, const ThicknessMap& thickness)
      : Learned_cost(internal::dual_mesh(shape, CGAL::parameters::default_values()), thickness, 0) {}

  /// The region of a single face of the mesh that this was made for.
  Region region(const Dual_mesh& mesh, Dual_mesh::Index face) const;

  /// Adds the sums of another region.
  void join(Region& region, const Region& other) const {
    size_aware_.join(region.size, other.size);
    region.shape += other.shape;
  }

  /// The boundary of a single edge of the mesh that this was made for.
  Boundary boundary(const Dual_mesh& mesh, Dual_mesh::Index edge, double difference) const;

  /// The cost of merging two regions.
  double operator()(const Region& a, const Region& b, const Region_boundary_of<Boundary>& boundary) const;

  /// Whether the learned factor counts for two regions: the mesh is a solid, and the thickness of one of them is known.
  bool knows_thickness(const Region& a, const Region& b) const;

  /// The cost of `Size_aware_cost`.
  double size_aware_cost(const Region& a, const Region& b, const Region_boundary_of<Boundary>& boundary) const {
    return size_aware_(a.size, b.size, Region_boundary{boundary.common.difference, {}});
  }

 private:
  template <class Mesh, class ThicknessMap>
  Learned_cost(const Dual_mesh_of<Mesh>& shape, const ThicknessMap& thickness, int)
      : Learned_cost(static_cast<const Dual_mesh&>(shape), shape.read_faces(thickness, [&](const auto& t) {
          return static_cast<double>(t) / shape.unit();
        })) {}

  bool is_solid_;
  Size_aware_cost size_aware_;
  std::shared_ptr<const internal::Edge_concavity> concavity_;
  const internal::Boosted_trees* trees_;
};

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Learned_cost.h>
#endif

#endif
