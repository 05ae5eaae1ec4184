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
#include <RW_segmentation/internal/surfaces/noise_of_vertices.h>

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
inline std::vector<double> edge_sharpness(const Dual_mesh& mesh, const Surface_tolerance& tolerance) {
  std::vector<double> sharpness = edge_angles(mesh);
  for (Dual_mesh::Index e = 0; e < sharpness.size(); ++e)
    sharpness[e] /= tolerance.sharp_angle(mesh.graph().faces_of(e));
  return sharpness;
}

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
      : mesh_(mesh),
        tolerance_(std::make_shared<const internal::Surface_tolerance>(std::move(tolerance))),
        most_samples_(most_samples) {}
  /// \endcond

  /// The region of a single face of the mesh that this was made for.
  Region region(const Dual_mesh&, Dual_mesh::Index face) const {
    Region region;
    for (const Dual_mesh::Index v : mesh_.corners(face)) region.vertices.insert(v, most_samples_);
    if (has_normal(face)) region.faces.insert(face, most_samples_);
    return region;
  }

  /// Adds the vertices and faces of another region.
  void join(Region& region, const Region& other) const {
    region.vertices.join(other.vertices, most_samples_);
    region.faces.join(other.faces, most_samples_);
    region.surface.reset();
  }

  /// The cost of merging two regions.
  double operator()(const Region& a, const Region& b, const Region_boundary& boundary) const {
    // Squared deviations that no change of the surface makes good.
    constexpr double hopeless = 100;
    const double sharpness = boundary.common.difference / boundary.common.length;
    if (sharpness > 1) return impossible * sharpness;
    const double known = std::max(misfit_of_known(a, b), misfit_of_known(b, a));
    if (known > hopeless) return known * (1 + sharpness);
    Region whole = a;
    join(whole, b);
    return cost_of(whole);
  }

  /// The surface that explains a region best, in the unit box.
  const Analytic_surface& surface_of(const Region& region) const {
    if (!region.surface) region.surface = fit_analytic_surface(samples_of(region), tolerance_->distance);
    return *region.surface;
  }

 private:
  static constexpr double impossible = 1e12;  // a cost above all others

  bool has_normal(Dual_mesh::Index face) const { return !mesh_.shape_normals()[face].isZero(); }

  /// How far a region is from the surface of another one that is beyond doubt, in squared expected deviations; 0 if it
  /// is in doubt. Spares most fits.
  double misfit_of_known(const Region& a, const Region& b) const {
    constexpr std::size_t doubtless_surplus = 8;     // vertices beyond those that determine a surface
    constexpr std::size_t doubtless_free_form = 30;  // vertices that lie on no surface
    const Analytic_surface& surface = surface_of(a);
    const auto freedom = static_cast<std::size_t>(degrees_of_freedom(surface.type));
    if (surface.type == Surface_type::free_form) return a.vertices.size() < doubtless_free_form ? 0 : impossible;
    if (a.vertices.size() < freedom + doubtless_surplus) return 0;
    return internal::with_type_of(surface, [&](const auto& s) {
      double squares = 0;
      b.vertices.for_each([&](Dual_mesh::Index v) {
        const double d = s.distance(mesh_.point(v)) / tolerance_->distance;
        squares += d * d;
      });
      return squares / static_cast<double>(b.vertices.size());
    });
  }

  double cost_of(const Region& region) const {
    constexpr double good_cost = 0.2;  // a more complex surface is not asked for
    const Surface_samples samples = samples_of(region);
    const internal::Surface_fit fit(samples);
    double least = impossible;
    for (const Surface_type type : analytic_types) {
      const double surplus = static_cast<double>(samples.points.size()) - degrees_of_freedom(type);
      if (surplus < 1) break;
      const auto surface = fit.fit(type);
      if (surface) least = std::min(least, distance_term(*surface, samples, surplus) + normal_term(*surface, region));
      if (least < good_cost) break;
    }
    return least;
  }

  Surface_samples samples_of(const Region& region) const {
    Surface_samples samples;
    region.vertices.for_each([&](Dual_mesh::Index v) { samples.points.push_back(mesh_.point(v)); });
    region.faces.for_each([&](Dual_mesh::Index f) {
      samples.normal_points.push_back(mesh_.centroid(f));
      samples.normals.push_back(mesh_.shape_normals()[f]);
    });
    return samples;
  }

  /// 1 where the variance of the distances is that of one and a half of the expected deviation.
  double distance_term(const Analytic_surface& surface, const Surface_samples& samples, double surplus) const {
    constexpr double allowed = 1.5 * 1.5;
    const double ratio = surface.residual / tolerance_->distance;
    const double squares = static_cast<double>(samples.points.size()) * ratio * ratio;
    return std::min(impossible, (squares + degrees_of_freedom(surface.type)) / surplus / allowed);
  }

  /// The mean of the squared deviations of the normals, as parts of those allowed.
  double normal_term(const Analytic_surface& surface, const Region& region) const {
    return internal::with_type_of(surface, [&](const auto& s) {
      double outward = 0, squares[2] = {0, 0}, count = 0;
      region.faces.for_each([&](Dual_mesh::Index f) {
        const Eigen::Vector3d n = s.normal(mesh_.centroid(f)), &own = mesh_.shape_normals()[f];
        outward += n.dot(own);
        const double square = tolerance_->normal_angle[f] * tolerance_->normal_angle[f];
        squares[0] += (n + own).squaredNorm() / square;
        squares[1] += (n - own).squaredNorm() / square;
        ++count;
      });
      return count > 0 ? squares[outward > 0] / count : 0;
    });
  }

  Dual_mesh mesh_;
  std::shared_ptr<const internal::Surface_tolerance> tolerance_;
  std::size_t most_samples_;
};

}  // namespace RW_segmentation

#endif
