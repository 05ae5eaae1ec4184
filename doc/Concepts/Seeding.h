// SPDX-License-Identifier: MIT

/// \cgalConcept Seeding
///
/// Where the walks of an automatic segmentation begin: one seed for each fragment, of which segments are merged.
///
/// A seeding is a function object. Equal arguments must give equal seeds if the segmentation is to be repeatable.
///
/// \cgalHasModels
/// - `RW_segmentation::Feature_sensitive_seeding` with `RW_segmentation::Farthest_point_sampling` or
///   `RW_segmentation::Particle_sampling`
/// - `RW_segmentation::Coarse_seeding` with any \ref SeedStopPredicate
/// - A user's own: `Equal_area_seeding` in `examples/own_policies.cpp`
class Seeding {
 public:
  /// \param mesh the dual mesh of the smoothed shape, a `Dual_mesh_of`, which converts to `const Dual_mesh&`
  /// \param difference of the faces beside each edge, in the order of the mesh's edges
  /// \param given the user's seeds, all different, which are seeds in any case
  /// \param progress may be left out of the signature; told from 0 to 1
  /// \returns a range of numbers of faces, the seeds that are added. Faces named twice and given ones count once; a number
  /// that is no face is refused. A component, as the walls leave it, that gets no seed becomes a fragment of its own.
  std::vector<Dual_mesh::Index> operator()(const Dual_mesh& mesh, const std::vector<double>& difference,
                                           const std::vector<Dual_mesh::Index>& given, const Progress& progress) const;
};
