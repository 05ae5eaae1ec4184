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
};

namespace internal {

inline void require_smoothing_numbers(const Normal_smoothing& smoothing) {
  if (!(smoothing.radius >= 0) || !std::isfinite(smoothing.radius))
    throw argument_error("radius", smoothing.radius, "a finite number >= 0");
  if (!(smoothing.noise_angle > 0)) throw argument_error("noise_angle", smoothing.noise_angle, "positive");
  if (!(smoothing.largest_widening >= 1) || !std::isfinite(smoothing.largest_widening))
    throw argument_error("largest_widening", smoothing.largest_widening, "a finite number >= 1");
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

/// The core of `smoothed_face_normals()`: unit vectors in the order of the faces.
inline std::vector<Eigen::Vector3d> smooth_normals(const Dual_graph& graph, const Face_geometry& geometry,
                                                   const Normal_smoothing& smoothing, const Progress& progress = {}) {
  // Of the directions, in radians. On the 190 meshes of the tuning half of the Princeton benchmark, 99.3 % of the faces
  // get the label that they get by an exact solution, as with 1e-5; with 1e-3 it is 96 %.
  constexpr double tolerance = 1e-4;

  require_smoothing_numbers(smoothing);
  const std::vector<Eigen::Vector3d>& own = geometry.normal;
  if (smoothing.radius == 0 || geometry.degenerate_faces == own.size()) return own;
  std::vector<Eigen::Vector3d> diffused = own;
  const auto diffuse = [&](double radius, const Progress& part) {
    Face_diffusion(graph, geometry, radius * radius * geometry.total_area).solve(own, diffused, tolerance, part);
    return normalised(diffused, own);
  };

  std::vector<Eigen::Vector3d> smoothed = diffuse(smoothing.radius, progress.part(0, 0.5));
  const double widening = std::min(smoothing.largest_widening, median_turn(smoothed, own) / smoothing.noise_angle);
  if (widening > 1.1) smoothed = diffuse(widening * smoothing.radius, progress.part(0.5, 1));
  progress(1);
  return smoothed;
}

}  // namespace internal

/// Writes the normals of the faces after one implicit step of diffusion over the surface, so that they tell the shape
/// at the scale of a smoothing length and not that of single triangles.
///
/// With the faces' own normals N0, areas A and R = sqrt(sum of A), it solves (diag(A) + (radius R)^2 Lap) N = diag(A) N0,
/// where the Laplacian has a weight |e| / l for each interior edge e between faces i and j, l = 2/3 (Ai + Aj) / |e|
/// being the distance of their centres; then it scales each N to length 1. Noise is recognised by how far the normals
/// turn, and smoothed once more with a larger radius (see `Normal_smoothing`). Faces without area get the normal of
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
  const auto smoothed =
      internal::smooth_normals(graph, internal::face_geometry(mesh, graph, np), smoothing, internal::progress_of(np));
  for (std::size_t i = 0; i < smoothed.size(); ++i)
    put(normals, graph.face_descriptors()[i], Vector(smoothed[i][0], smoothed[i][1], smoothed[i][2]));
}

}  // namespace RW_segmentation

#endif
