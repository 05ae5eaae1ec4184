// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_ANALYTIC_SURFACE_COST_H
#define RW_SEGMENTATION_ANALYTIC_SURFACE_COST_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Region_boundary.h>
#include <RW_segmentation/internal/Shared_edge_values.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/surfaces/Number_sample.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>

#include <CGAL/Named_function_parameters.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// The angle of each edge as a part of what makes it sharp.
std::vector<double> edge_sharpness(const Dual_mesh& mesh, const Surface_tolerance& tolerance);

}  // namespace internal

/// The angle between the faces of each edge, as a part of 40 degrees or of what noise makes of it: edges above 1 are
/// sharp and no part of an analytic surface. A difference for `Analytic_surface_cost`: a readable property map from
/// `edge_descriptor` to `double`. Copies share the values. Complexity: linear.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`, or a `Dual_mesh_of` one
template <class FaceListGraph>
class Edge_sharpness : public internal::Shared_edge_values<FaceListGraph> {
  using Base = internal::Shared_edge_values<FaceListGraph>;

 public:
  /// Parameters and errors are those of `Analytic_surface_cost`.
  template <class NamedParameters = CGAL::parameters::Default_named_parameters>
  explicit Edge_sharpness(const FaceListGraph& mesh, double noise = -1,
                          const NamedParameters& np = CGAL::parameters::default_values())
      : Base(values(internal::dual_mesh(mesh, np), noise)) {
    static_assert(internal::has_only<NamedParameters, internal::Vertex_point>,
                  "Edge_sharpness takes the named parameter vertex_point_map.");
  }

 private:
  template <class Mesh>
  static Base values(const Dual_mesh_of<Mesh>& mesh, double noise) {
    return Base(mesh, internal::edge_sharpness(mesh, internal::surface_tolerance(mesh, noise)));
  }
};

/// The merge cost for parts of machines, a model of `MergeCost`: does one plane, sphere, cylinder, cone or torus fit
/// both regions?
///
/// cost = min over the surfaces of (E + k) / (n - k) / 1.5^2 + E_n with n vertices, whose squared distances, in units
/// of the expected deviation squared, sum to E; k degrees of freedom; and the mean E_n of the squared deviations of the
/// faces' normals in units of 12 degrees, or of what noise makes of it. Merging is best stopped at cost 1. Regions of
/// so few vertices that any surface fits them cost more than regions that determine theirs. Does not depend on the
/// scale of the mesh.
///
/// The difference to merge with is `Edge_sharpness`: where it exceeds 1 in the mean, the cost is above 1e12.
///
/// Each cost fits surfaces to at most 80 vertices and 80 normals of the regions, in constant time (about 0.1 ms).
class Analytic_surface_cost {
 public:
  /// Some of the vertices and faces of a region.
  struct Region {
    internal::Number_sample vertices;                 ///< numbers in the dual mesh
    internal::Number_sample faces;                    ///< likewise, of those that have a normal
    mutable std::optional<Analytic_surface> surface;  ///< that explains the region best, once asked for
  };

  /// Complexity: linear.
  ///
  /// \tparam FaceListGraph a model of CGAL's `FaceListGraph`, or a `Dual_mesh_of` one
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh; no reference to it is kept
  /// \param noise the standard deviation of the vertices from the surfaces, as a part of the diagonal of the bounding
  /// box; negative: estimated from the mesh
  /// \param np `vertex_point_map` (default: that of the mesh)
  /// \throws std::invalid_argument if a coordinate or the noise is not finite
  template <class FaceListGraph, class NamedParameters = CGAL::parameters::Default_named_parameters>
  explicit Analytic_surface_cost(const FaceListGraph& mesh, double noise = -1,
                                 const NamedParameters& np = CGAL::parameters::default_values())
      : Analytic_surface_cost(static_cast<const Dual_mesh&>(internal::dual_mesh(mesh, np)), noise) {
    static_assert(internal::has_only<NamedParameters, internal::Vertex_point>,
                  "Analytic_surface_cost takes the named parameter vertex_point_map.");
  }

  /// As above, for a mesh that has been read.
  explicit Analytic_surface_cost(const Dual_mesh& mesh, double noise = -1)
      : Analytic_surface_cost(mesh, internal::surface_tolerance(mesh, noise)) {}

  /// \cond  For stages that know the tolerance
  Analytic_surface_cost(const Dual_mesh& mesh, internal::Surface_tolerance tolerance, std::size_t most_samples = 80)
      : mesh_(internal::with_stored_normals(mesh)),
        tolerance_(std::make_shared<const internal::Surface_tolerance>(std::move(tolerance))),
        most_samples_(most_samples) {}
  /// \endcond

  /// The region of a single face of the mesh that this was made for.
  Region region(const Dual_mesh& mesh, Dual_mesh::Index face) const;

  /// Adds the vertices and faces of another region.
  void join(Region& region, const Region& other) const;

  /// The cost of merging two regions.
  double operator()(const Region& a, const Region& b, const Region_boundary& boundary) const;

  /// The surface that explains a region best, in the unit box.
  const Analytic_surface& surface_of(const Region& region) const;

  /// The vertices and faces of a region, in the unit box.
  Surface_samples samples_of(const Region& region) const;

 private:
  static constexpr double impossible = 1e12;  // a cost above all others

  bool has_normal(Dual_mesh::Index face) const { return !mesh_.shape_normal(face).isZero(); }

  /// How far a region is from the surface of another one that is beyond doubt, in squared expected deviations; 0 if it
  /// is in doubt. Spares most fits.
  double misfit_of_known(const Region& a, const Region& b) const;

  double cost_of(const Region& region) const;

  /// 1 where the variance of the distances is that of one and a half of the expected deviation.
  double distance_term(const Analytic_surface& surface, const Surface_samples& samples, double surplus) const;

  /// The mean of the squared deviations of the normals, as parts of those allowed.
  double normal_term(const Analytic_surface& surface, const Region& region) const;

  Dual_mesh mesh_;
  std::shared_ptr<const internal::Surface_tolerance> tolerance_;
  std::size_t most_samples_;
};

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Analytic_surface_cost.h>
#endif

#endif
