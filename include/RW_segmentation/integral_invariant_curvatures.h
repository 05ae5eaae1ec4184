// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTEGRAL_INVARIANT_CURVATURES_H
#define RW_SEGMENTATION_INTEGRAL_INVARIANT_CURVATURES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/threads.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// The radius of the balls in which curvature is measured, from 1e-12 to 1e12 times the diagonal of the
/// mesh: less or more counts as these.
class Ball_radius {
 public:
  /// A multiple of the mean length of the interior edges. On clean, even meshes 2 to 3 serve; noise asks for more.
  static Ball_radius in_edge_lengths(double multiple) { return {multiple, true}; }
  /// In the unit of the mesh's coordinates.
  static Ball_radius absolute(double length) { return {length, false}; }

  /// The length, or the multiple.
  double value() const { return value_; }
  /// Whether the value is a multiple of the mean edge length.
  bool is_in_edge_lengths() const { return in_edge_lengths_; }

 private:
  Ball_radius(double value, bool in_edge_lengths) : value_(value), in_edge_lengths_(in_edge_lengths) {}
  double value_;
  bool in_edge_lengths_;
};

/// How a surface bends at a point, at the scale of a ball round it. Curvatures are positive where the solid is convex,
/// 1/R on a sphere of radius R; their unit is 1 over that of the mesh.
struct Surface_curvatures {
  double max_curvature = 0;  ///< the larger principal curvature
  double min_curvature = 0;  ///< the smaller principal curvature
  /// From the volume of the solid in the ball alone: a second estimate of the mean curvature. Where it is far from
  /// `mean_curvature()`, the surface is not smooth at the scale of the ball.
  double mean_curvature_by_volume = 0;
  /// How high the smooth surface lies above the centre of the face, in the unit of the mesh: the height of chords, and
  /// noise.
  double offset = 0;
  Eigen::Vector3d max_direction = Eigen::Vector3d::Zero();  ///< unit vector, zero where nothing was measured
  Eigen::Vector3d min_direction = Eigen::Vector3d::Zero();  ///< unit vector, zero where nothing was measured
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();         ///< outward, of the surface in the ball

  /// H, the mean of the principal curvatures.
  double mean_curvature() const { return (max_curvature + min_curvature) / 2; }
  /// K, the product of the principal curvatures.
  double gaussian_curvature() const { return max_curvature * min_curvature; }
};

/// What was odd about the balls of one radius, as numbers of faces.
struct Curvature_report {
  double radius = 0;                       ///< in the unit of the mesh's coordinates
  std::size_t faces_without_area = 0;      ///< they got the curvatures of a face nearby
  std::size_t balls_across_borders = 0;    ///< the mesh ends inside the ball
  std::size_t balls_inside_a_face = 0;     ///< too small to see anything but a plane
  std::size_t balls_round_everything = 0;  ///< the ball holds all of the component: its curvatures tell nothing
};

namespace internal {

/// \throws std::invalid_argument
double length_of(const Ball_radius& radius, const Dual_mesh& mesh);

/// For each radius the curvatures in the order of the faces, radii and curvatures in the unit box.
template <class ConcurrencyTag>
std::vector<std::vector<Surface_curvatures>> curvatures_of_faces(const Dual_mesh& mesh,
                                                                 const std::vector<double>& radii,
                                                                 std::vector<Curvature_report>& reports,
                                                                 const Progress& progress);

}  // namespace internal

/// Measures how the surface bends at the centre of each face, for several radii in one sweep: one map for each radius.
/// See the function for one radius.
///
/// \param curvatures output: as many maps as radii
/// \returns a report for each radius
/// \throws std::invalid_argument also if there are not as many maps as radii
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class CurvatureMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
std::vector<Curvature_report> integral_invariant_curvatures(
    const FaceListGraph& mesh, const std::vector<CurvatureMap>& curvatures, const std::vector<Ball_radius>& radii,
    const NamedParameters& np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(internal::is_writable_map<CurvatureMap, face_descriptor>,
                "curvatures must be writable property maps from the mesh's face_descriptor to Surface_curvatures.");
  if (curvatures.size() != radii.size())
    throw internal::argument_error("the number of curvature maps", curvatures.size(),
                                   ("that of radii, " + std::to_string(radii.size())).c_str());

  static_assert(internal::has_only<NamedParameters, internal::Vertex_point, internal::Callback>,
                "integral_invariant_curvatures() takes the named parameters vertex_point_map and callback.");

  return internal::with_threads<ConcurrencyTag>([&] {
    const auto& dual = internal::dual_mesh(mesh, np);
    std::vector<double> lengths;
    for (const Ball_radius& radius : radii) lengths.push_back(internal::length_of(radius, dual));
    std::vector<Curvature_report> reports;
    const auto measured =
        internal::curvatures_of_faces<ConcurrencyTag>(dual, lengths, reports, internal::progress_of(np));
    for (std::size_t i = 0; i < radii.size(); ++i) {
      const CurvatureMap& map = curvatures[i];
      for (std::size_t f = 0; f < measured[i].size(); ++f) {
        Surface_curvatures value = measured[i][f];
        value.max_curvature /= dual.unit();
        value.min_curvature /= dual.unit();
        value.mean_curvature_by_volume /= dual.unit();
        value.offset *= dual.unit();
        put(map, dual.face_descriptors()[f], value);
      }
    }
    return reports;
  });
}

/// Measures how the surface bends at the centre of each face, by integral invariants: principal curvatures and
/// directions from the covariance of what the solid inside the mesh and a ball round the centre have in common (Yang,
/// Lai, Hu, Pottmann 2006; Pottmann et al. 2007), as asked for by Eq. 7.
///
/// The moments of that body are computed in closed form from the triangles that the ball meets: no grid, no sampling.
/// They are integrals, so that noise, slivers and uneven triangles hardly matter where the ball is large enough. What
/// is near in space but does not hang together with the face inside the ball, such as the opposite side of a thin
/// sheet, does not count. Where the mesh ends inside the ball, the surface is taken to go on straight, along the rays
/// from the centre: a plane stays a plane up to its border, a curved surface seems flatter there. Faces of more
/// than three sides are covered by triangles round the mean of their corners.
///
/// Results do not depend on the number of threads. Complexity: the number of triangles that a ball meets, for each face.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
/// \tparam CurvatureMap a writable property map from `face_descriptor` to `Surface_curvatures`
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh, its faces oriented outward
/// \param curvatures output: the curvatures; of faces without area those of a face nearby
/// \param radius of the balls
/// \param np `vertex_point_map` (default: that of the mesh), `callback` (`std::function<bool(double)>`, default: none)
/// \returns how large the balls were, and how many were odd
/// \throws std::invalid_argument if the radius is not positive or a coordinate is not finite (names the vertex); nothing
/// is written then
/// \throws Cancelled
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class CurvatureMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Curvature_report integral_invariant_curvatures(const FaceListGraph& mesh, CurvatureMap curvatures,
                                               Ball_radius radius = Ball_radius::in_edge_lengths(3),
                                               const NamedParameters& np = CGAL::parameters::default_values()) {
  return integral_invariant_curvatures<ConcurrencyTag>(mesh, std::vector<CurvatureMap>{curvatures},
                                                       std::vector<Ball_radius>{radius}, np)
      .front();
}

/// As above, with named parameters after the output.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class CurvatureMap,
          class NamedParameters, std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
Curvature_report integral_invariant_curvatures(const FaceListGraph& mesh, CurvatureMap curvatures,
                                               const NamedParameters& np) {
  return integral_invariant_curvatures<ConcurrencyTag>(mesh, curvatures, Ball_radius::in_edge_lengths(3), np);
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/integral_invariant_curvatures.h>
#endif

#endif
