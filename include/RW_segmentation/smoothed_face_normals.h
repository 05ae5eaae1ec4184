#ifndef RW_SEGMENTATION_SMOOTHED_FACE_NORMALS_H
#define RW_SEGMENTATION_SMOOTHED_FACE_NORMALS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/Edge_values.h>
#include <RW_segmentation/internal/Face_diffusion.h>
#include <RW_segmentation/internal/Face_geometry.h>

#include <CGAL/Named_function_parameters.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace RW_segmentation {

/// How far normals are smoothed; all numbers are dimensionless.
struct Normal_smoothing {
  /// The smoothing length, as a fraction of the square root of the total area; 0 leaves the faces' own normals.
  double radius = 0.01;
  /// The median turn |N - N0| of a face's normal under the first smoothing, in radians, up to which a mesh counts as
  /// free of noise. Above it the radius is widened by the same ratio; infinity never widens.
  double noise_angle = 0.1;
  /// The largest factor by which noise widens the radius, >= 1.
  double largest_widening = 4;
  /// The multiple of `noise_angle` from which on the vertices are smoothed before the normals: so much noise hides the
  /// shape from the normals of faces, however they are averaged. Infinity never smooths vertices.
  double heavy_noise = 2.5;
};

namespace internal {

inline void require_smoothing_numbers(const Normal_smoothing& smoothing) {
  if (!(smoothing.radius >= 0) || !std::isfinite(smoothing.radius))
    throw argument_error("radius", smoothing.radius, "a finite number >= 0");
  if (!(smoothing.noise_angle > 0)) throw argument_error("noise_angle", smoothing.noise_angle, "positive");
  if (!(smoothing.largest_widening >= 1) || !std::isfinite(smoothing.largest_widening))
    throw argument_error("largest_widening", smoothing.largest_widening, "a finite number >= 1");
  if (!(smoothing.heavy_noise > 0)) throw argument_error("heavy_noise", smoothing.heavy_noise, "positive");
}

/// Unit vectors; the face's own where nothing is left, on parts much smaller than the smoothing length.
inline std::vector<Eigen::Vector3d> normalised(const std::vector<Eigen::Vector3d>& vectors,
                                               const std::vector<Eigen::Vector3d>& own) {
  std::vector<Eigen::Vector3d> result(vectors.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double length = vectors[i].norm();
    result[i] = length > 1e-3 ? Eigen::Vector3d(vectors[i] / length) : own[i];
  }
  return result;
}

/// The median of |Ni - N0i|, the upper one of two.
inline double median_turn(const std::vector<Eigen::Vector3d>& normals, const std::vector<Eigen::Vector3d>& own) {
  std::vector<double> turn(own.size());
  for (std::size_t i = 0; i < turn.size(); ++i) turn[i] = (normals[i] - own[i]).squaredNorm();
  const auto middle = turn.begin() + static_cast<std::ptrdiff_t>(turn.size() / 2);
  std::nth_element(turn.begin(), middle, turn.end());
  return std::sqrt(*middle);
}

/// The faces' own normals diffused to a radius.
struct Diffused_normals {
  std::vector<Eigen::Vector3d> vector;  ///< as the diffusion leaves them
  std::vector<Eigen::Vector3d> unit;
  double turn;  ///< the median of the angles between `unit` and the faces' own
};

/// \param start for the iteration
inline Diffused_normals diffused_normals(const Dual_graph& graph, const Face_geometry& geometry, double radius,
                                         std::vector<Eigen::Vector3d> start, const Progress& progress) {
  // Of the directions, in radians. On the 190 meshes of the tuning half of the Princeton benchmark, 99.3 % of the faces
  // get the label that they get by an exact solution, as with 1e-5; with 1e-3 it is 96 %.
  constexpr double tolerance = 1e-4;
  constexpr double widest = 100;  // by then all faces of a component share one direction
  radius = std::min(radius, widest);
  Face_diffusion(graph, geometry, radius * radius * geometry.total_area)
      .solve(geometry.normal, start, tolerance, progress);
  std::vector<Eigen::Vector3d> unit = normalised(start, geometry.normal);
  const double turn = median_turn(unit, geometry.normal);
  return {std::move(start), std::move(unit), turn};
}

/// The unit normals, diffused once more to a larger radius if they have noise.
inline std::vector<Eigen::Vector3d> widened(const Dual_graph& graph, const Face_geometry& geometry,
                                            const Normal_smoothing& smoothing, Diffused_normals normals,
                                            const Progress& progress) {
  const double widening = std::min(smoothing.largest_widening, normals.turn / smoothing.noise_angle);
  if (widening > 1.1)
    normals = diffused_normals(graph, geometry, widening * smoothing.radius, std::move(normals.vector), progress);
  progress(1);
  return std::move(normals.unit);
}

/// Smoothed normals for a shape that is given by its faces alone: vertices stay where they are.
inline std::vector<Eigen::Vector3d> smooth_normals(const Dual_graph& graph, const Face_geometry& geometry,
                                                   const Normal_smoothing& smoothing, const Progress& progress = {}) {
  require_smoothing_numbers(smoothing);
  const std::vector<Eigen::Vector3d>& own = geometry.normal;
  if (smoothing.radius == 0 || geometry.degenerate_faces == own.size()) return own;
  return widened(graph, geometry, smoothing,
                 diffused_normals(graph, geometry, smoothing.radius, own, progress.part(0, 0.5)),
                 progress.part(0.5, 1));
}

/// The core of `smoothed_face_normals()`: unit vectors in the order of the faces. On a mesh with heavy noise `point` and
/// `geometry` become those of the shape with its vertices smoothed.
/// \returns the normals, and whether the vertices were smoothed
template <class FaceListGraph, class NamedParameters>
std::pair<std::vector<Eigen::Vector3d>, bool> smooth_normals_and_vertices(
    const FaceListGraph& mesh, const Mesh_dual_graph<FaceListGraph>& graph,
    Unit_box_points<FaceListGraph, NamedParameters>& point, Face_geometry& geometry, const Normal_smoothing& smoothing,
    const Progress& progress) {
  // Half as many leave noise of 0.3 % of the diagonal with 0.5 % more error on the Princeton benchmark, twice as many
  // change nothing.
  constexpr int vertex_steps = 4;

  require_smoothing_numbers(smoothing);
  if (smoothing.radius == 0 || geometry.degenerate_faces == geometry.normal.size()) return {geometry.normal, false};
  Diffused_normals normals =
      diffused_normals(graph, geometry, smoothing.radius, geometry.normal, progress.part(0, 0.4));
  const bool is_noise_heavy = normals.turn / smoothing.noise_angle > smoothing.heavy_noise;
  if (is_noise_heavy) {
    point.smooth(mesh, vertex_steps);
    geometry = face_geometry(mesh, graph, point);
    normals = diffused_normals(graph, geometry, smoothing.radius, std::move(normals.vector), progress.part(0.4, 0.6));
  }
  return {widened(graph, geometry, smoothing, std::move(normals), progress.part(0.6, 1)), is_noise_heavy};
}

}  // namespace internal

/// Writes the normals of the faces after one implicit step of diffusion over the surface, so that they tell the shape
/// at the scale of a smoothing length and not that of single triangles.
///
/// With the faces' own normals N0, areas A and R = sqrt(sum of A), it solves (diag(A) + (radius R)^2 Lap) N = diag(A) N0,
/// where the Laplacian has a weight |e| / l for each interior edge e between faces i and j, l = 2/3 (Ai + Aj) / |e|
/// being the distance of their centres; then it scales each N to length 1. Noise is recognised by how far the normals
/// turn, and smoothed once more with a larger radius; under heavy noise N0 is that of the mesh with its vertices smoothed,
/// each moved four times half-way to the mean of its neighbours (see `Normal_smoothing`). Faces without area get the normal of
/// their surroundings, and the zero vector if they have none.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph` with faces of any degree
/// \tparam FaceNormalMap a writable property map from `face_descriptor` to a vector that can be made of three `double`s
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh
/// \param normals where the unit vectors are written
/// \param smoothing how far to smooth
/// \param np `vertex_point_map` (default: that of the mesh), `callback` (`std::function<bool(double)>`, false cancels)
/// \throws Cancelled if the callback returns `false`
/// \throws std::invalid_argument if a number of `smoothing` is out of range or a coordinate is not finite (names the
/// vertex); nothing is written then
///
/// Complexity: a few dozen passes over the faces.
template <class FaceListGraph, class FaceNormalMap, class NamedParameters = CGAL::parameters::Default_named_parameters>
void smoothed_face_normals(const FaceListGraph& mesh, FaceNormalMap normals, const Normal_smoothing& smoothing = {},
                           const NamedParameters& np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(internal::is_writable_map<FaceNormalMap, face_descriptor>,
                "A writable property map from the mesh's face_descriptor to a vector is needed here.");
  using Vector = typename boost::property_traits<FaceNormalMap>::value_type;

  const Mesh_dual_graph<FaceListGraph> graph(mesh);
  internal::Unit_box_points<FaceListGraph, NamedParameters> point(mesh, np);
  internal::Face_geometry geometry = internal::face_geometry(mesh, graph, point);
  const auto smoothed =
      internal::smooth_normals_and_vertices(mesh, graph, point, geometry, smoothing, internal::progress_of(np)).first;
  for (std::size_t i = 0; i < smoothed.size(); ++i)
    put(normals, graph.face_descriptors()[i], Vector(smoothed[i][0], smoothed[i][1], smoothed[i][2]));
}

}  // namespace RW_segmentation

#endif
