#ifndef RW_SEGMENTATION_ANALYTIC_SURFACE_COST_H
#define RW_SEGMENTATION_ANALYTIC_SURFACE_COST_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Region_boundary.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/Edge_values.h>
#include <RW_segmentation/internal/Face_corners.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/Surface_growing.h>

#include <CGAL/Named_function_parameters.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// A uniform sample of a set of numbers that does not depend on the order in which the set is put together: the numbers
/// that come first after scattering. Without duplicates, joined in linear time.
class Number_sample {
 public:
  using Number = std::uint32_t;

  void insert(Number number, std::size_t most) { join(Number_sample(number * scatter), most); }

  void join(const Number_sample& other, std::size_t most) {
    std::vector<Number> all;
    all.reserve(scattered_.size() + other.scattered_.size());
    std::set_union(scattered_.begin(), scattered_.end(), other.scattered_.begin(), other.scattered_.end(),
                   std::back_inserter(all));
    if (all.size() > most) all.resize(most);
    scattered_ = std::move(all);
  }

  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Number s : scattered_) visit(s * gather);
  }

  std::size_t size() const { return scattered_.size(); }

  Number_sample() = default;

 private:
  explicit Number_sample(Number scattered) : scattered_(1, scattered) {}

  // A permutation of all numbers (Knuth), and its inverse.
  static constexpr Number scatter = 2654435761U, gather = 244002641U;
  static_assert(scatter * gather == 1U, "the second undoes the first");

  std::vector<Number> scattered_;  // ascending
};

/// The formula of `Analytic_surface_cost`, in the coordinates of `Face_geometry`.
class Analytic_surface_formula {
 public:
  using Index = Dual_graph::Index;

  /// Some of the vertices and faces.
  struct Region {
    Number_sample vertices, faces;
    mutable std::optional<Analytic_surface> surface;  ///< that explains the region best, once asked for
  };

  /// \param most vertices and faces that a region keeps
  Analytic_surface_formula(std::shared_ptr<const Face_geometry> geometry, std::shared_ptr<const Face_corners> corners,
                           std::shared_ptr<const Surface_tolerance> tolerance, std::size_t most = 80)
      : geometry_(std::move(geometry)), corners_(std::move(corners)), tolerance_(std::move(tolerance)), most_(most) {}

  Region region_of(Index face) const {
    Region region;
    for (const Index v : (*corners_)[face]) region.vertices.insert(v, most_);
    if (!geometry_->normal[face].isZero()) region.faces.insert(face, most_);
    return region;
  }

  void join(Region& region, const Region& other) const {
    region.vertices.join(other.vertices, most_);
    region.faces.join(other.faces, most_);
    region.surface.reset();
  }

  double operator()(const Region& a, const Region& b, const Region_boundary& boundary) const {
    const double sharpness = boundary.common.difference / boundary.common.length;
    if (sharpness > 1) return impossible * sharpness;
    const double known = std::max(misfit_of_known(a, b), misfit_of_known(b, a));
    if (known > hopeless) return known * (1 + sharpness);
    Region whole = a;
    join(whole, b);
    return cost_of(whole);
  }

  /// The surface that explains a region best.
  const Analytic_surface& surface_of(const Region& region) const {
    if (!region.surface) region.surface = fit_analytic_surface(samples_of(region), tolerance_->distance);
    return *region.surface;
  }

 private:
  static constexpr double impossible = 1e12;
  static constexpr double hopeless = 100;   // squared deviations that no change of the surface makes good
  static constexpr double good_cost = 0.2;  // a more complex surface is not asked for

  /// How far a region is from the surface of another one that is beyond doubt, in squared expected deviations; 0 if it
  /// is in doubt. Spares most fits.
  double misfit_of_known(const Region& a, const Region& b) const {
    constexpr std::size_t doubtless_surplus = 8, doubtless_free_form = 30;
    const Analytic_surface& surface = surface_of(a);
    const auto freedom = static_cast<std::size_t>(degrees_of_freedom(surface.type));
    if (surface.type == Surface_type::free_form) return a.vertices.size() < doubtless_free_form ? 0 : impossible;
    if (a.vertices.size() < freedom + doubtless_surplus) return 0;
    double squares = 0;
    b.vertices.for_each([&](Index v) {
      const double d = surface.signed_distance(corners_->point(v)) / tolerance_->distance;
      squares += d * d;
    });
    return squares / static_cast<double>(b.vertices.size());
  }

  double cost_of(const Region& region) const {
    const Surface_samples samples = samples_of(region);
    const Surface_fit fit(samples);
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
    region.vertices.for_each([&](Index v) { samples.points.push_back(corners_->point(v)); });
    region.faces.for_each([&](Index f) {
      samples.normal_points.push_back(geometry_->centroid[f]);
      samples.normals.push_back(geometry_->normal[f]);
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
    double outward = 0, squares[2] = {0, 0}, count = 0;
    region.faces.for_each([&](Index f) {
      const Eigen::Vector3d n = surface.normal(geometry_->centroid[f]);
      outward += n.dot(geometry_->normal[f]);
      const double square = tolerance_->normal_angle[f] * tolerance_->normal_angle[f];
      squares[0] += (n + geometry_->normal[f]).squaredNorm() / square;
      squares[1] += (n - geometry_->normal[f]).squaredNorm() / square;
      ++count;
    });
    return count > 0 ? squares[outward > 0] / count : 0;
  }

  std::shared_ptr<const Face_geometry> geometry_;
  std::shared_ptr<const Face_corners> corners_;
  std::shared_ptr<const Surface_tolerance> tolerance_;
  std::size_t most_;
};

/// What fitting surfaces to a mesh needs.
struct Surface_data {
  std::shared_ptr<const Face_geometry> geometry;
  std::shared_ptr<const Face_corners> corners;
  std::shared_ptr<const Surface_tolerance> tolerance;

  Analytic_surface_formula formula(std::size_t most_samples) const {
    return {geometry, corners, tolerance, most_samples};
  }
};

/// The angle of each edge as a part of what makes it sharp.
inline std::vector<double> edge_sharpness(const Dual_graph& graph, const Face_geometry& geometry,
                                          const Surface_tolerance& tolerance) {
  std::vector<double> sharpness = edge_angles(graph, geometry);
  for (Dual_graph::Index e = 0; e < sharpness.size(); ++e) sharpness[e] /= tolerance.sharp_angle(graph.faces_of(e));
  return sharpness;
}

/// Vertices of CAD models written with six digits or so are that exact, in parts of the diagonal.
constexpr double cad_exactness = 1e-5;

/// \param noise standard deviation of the vertices as a part of the diagonal; negative: to be estimated
template <class FaceListGraph, class NamedParameters>
Surface_data surface_data(const FaceListGraph& mesh, const Mesh_dual_graph<FaceListGraph>& graph, double noise,
                          const NamedParameters& np) {
  if (std::isnan(noise) || std::isinf(noise)) throw argument_error("noise", noise, "finite");
  Surface_data data;
  data.geometry = std::make_shared<const Face_geometry>(face_geometry(mesh, graph, np));
  data.corners = std::make_shared<const Face_corners>(mesh, graph, np);
  const std::vector<char> no_barriers(graph.number_of_edges(), false);
  Surface_tolerance tolerance =
      noise >= 0 ? surface_tolerance(*data.geometry, *data.corners, cad_exactness, noise)
                 : Surface_growing(graph, *data.geometry, *data.corners, no_barriers).estimate_tolerance(cad_exactness);
  data.tolerance = std::make_shared<const Surface_tolerance>(std::move(tolerance));
  return data;
}

}  // namespace internal

/// The angle between the faces of each edge, as a part of 40 degrees or of what noise makes of it: edges above 1 are
/// sharp and no part of an analytic surface. A difference for `Analytic_surface_cost`: a readable property map from
/// `edge_descriptor` to `double`. Copies share the values. Complexity: linear.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
template <class FaceListGraph>
class Edge_sharpness : public internal::Shared_edge_values<FaceListGraph> {
  using Base = internal::Shared_edge_values<FaceListGraph>;

 public:
  /// Parameters and errors are those of `Analytic_surface_cost`.
  template <class NamedParameters = CGAL::parameters::Default_named_parameters>
  explicit Edge_sharpness(const FaceListGraph& mesh, double noise = -1,
                          const NamedParameters& np = CGAL::parameters::default_values())
      : Base(values(mesh, noise, np)) {}

 private:
  template <class NamedParameters>
  static Base values(const FaceListGraph& mesh, double noise, const NamedParameters& np) {
    const Mesh_dual_graph<FaceListGraph> graph(mesh);
    const internal::Surface_data data = internal::surface_data(mesh, graph, noise, np);
    return Base(graph, internal::edge_sharpness(graph, *data.geometry, *data.tolerance));
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
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
template <class FaceListGraph>
class Analytic_surface_cost : public internal::Analytic_surface_formula {
 public:
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;

  /// Complexity: linear.
  ///
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh; no reference to it is kept
  /// \param noise the standard deviation of the vertices from the surfaces, as a part of the diagonal of the bounding
  /// box; negative: estimated from the mesh
  /// \param np `vertex_point_map` (default: that of the mesh)
  /// \throws std::invalid_argument if a coordinate or the noise is not finite
  template <class NamedParameters = CGAL::parameters::Default_named_parameters>
  explicit Analytic_surface_cost(const FaceListGraph& mesh, double noise = -1,
                                 const NamedParameters& np = CGAL::parameters::default_values())
      : Analytic_surface_cost(std::make_shared<const Mesh_dual_graph<FaceListGraph>>(mesh), mesh, noise, np) {}

  /// The region of a single face.
  Region region(face_descriptor face) const { return region_of(graph_->index(face)); }

 private:
  template <class NamedParameters>
  Analytic_surface_cost(std::shared_ptr<const Mesh_dual_graph<FaceListGraph>> graph, const FaceListGraph& mesh,
                        double noise, const NamedParameters& np)
      : Analytic_surface_formula(internal::surface_data(mesh, *graph, noise, np).formula(80)),
        graph_(std::move(graph)) {}

  std::shared_ptr<const Mesh_dual_graph<FaceListGraph>> graph_;
};

}  // namespace RW_segmentation

#endif
