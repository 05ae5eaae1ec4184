// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_SMOOTHED_FACE_NORMALS_H
#define RW_SEGMENTATION_SMOOTHED_FACE_NORMALS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>
#include <RW_segmentation/internal/threads.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <type_traits>
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

/// Smoothed normals for a shape that is given by its faces alone: vertices stay where they are.
std::vector<Eigen::Vector3d> smooth_normals(const Dual_mesh& mesh, const Normal_smoothing& smoothing,
                                            const Progress& progress = {});

/// How noisy a mesh is: medians of the turn of a face's normal under smoothing, in radians.
struct Noise_of_mesh {
  double turn = 0;           ///< with the vertices where they are
  double smoother_turn = 0;  ///< with the vertices smoothed; known where `turn` tells of heavy noise
};

/// How far smoothing turns the normal of each face, from which the medians are taken.
struct Normal_turns {
  std::vector<double> turn;           ///< in radians
  std::vector<double> smoother_turn;  ///< with the vertices smoothed; empty where there is no heavy noise
};
Normal_turns normal_turns(const Dual_mesh& mesh, const Normal_smoothing& smoothing, const Progress& progress = {});

/// By how much noise widens the radius.
double widening_by_noise(const Noise_of_mesh& noise, const Normal_smoothing& smoothing);

/// The shape of a part of a mesh, smoothed as far as the noise of the whole asks for.
Dual_mesh shape_of_part(const Dual_mesh& part, const Normal_smoothing& smoothing, const Noise_of_mesh& whole,
                        const Progress& progress = {});

/// The core of `smoothed_shape()`.
Dual_mesh shape_of(const Dual_mesh& mesh, const Normal_smoothing& smoothing, const Progress& progress);

}  // namespace internal

/// The shape that a mesh stands for, as the automatic segmentation sees it: its `shape_normal()` is smoothed, and under
/// heavy noise its points as well. What `smoothed_face_normals()` writes, as a mesh for the stages that follow.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`, or a `Dual_mesh_of` one
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh, which does not change
/// \param smoothing how far to smooth
/// \param np `vertex_point_map` (default: that of the mesh), `edge_is_constrained_map` (default: no edge is), `callback`
/// (`std::function<bool(double)>`, false cancels)
/// \throws Cancelled if the callback returns `false`
/// \throws std::invalid_argument if a number of `smoothing` is out of range or a coordinate is not finite (names the
/// vertex)
///
/// Complexity: a few dozen passes over the faces.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Dual_mesh_of<typename internal::Mesh_type<FaceListGraph>::type> smoothed_shape(
    const FaceListGraph& mesh, const Normal_smoothing& smoothing = {},
    const NamedParameters& np = CGAL::parameters::default_values()) {
  static_assert(internal::has_only_names_of_stages<NamedParameters>,
                "smoothed_shape() takes the named parameters vertex_point_map, edge_is_constrained_map and callback.");
  using Shape = Dual_mesh_of<typename internal::Mesh_type<FaceListGraph>::type>;
  return internal::with_threads<ConcurrencyTag>([&]() -> Shape {
    const auto& dual = internal::dual_mesh(mesh, np);
    return {internal::shape_of(dual, smoothing, internal::progress_of(np)), dual};
  });
}

/// As above, with named parameters after the mesh.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class NamedParameters,
          std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
auto smoothed_shape(const FaceListGraph& mesh, const NamedParameters& np) {
  return smoothed_shape<ConcurrencyTag>(mesh, Normal_smoothing(), np);
}

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
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (needs TBB) or `CGAL::Parallel_if_available_tag`
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
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class FaceNormalMap,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
void smoothed_face_normals(const FaceListGraph& mesh, FaceNormalMap normals, const Normal_smoothing& smoothing = {},
                           const NamedParameters& np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(internal::is_writable_map<FaceNormalMap, face_descriptor>,
                "A writable property map from the mesh's face_descriptor to a vector is needed here.");
  using Vector = typename boost::property_traits<FaceNormalMap>::value_type;

  const auto shape = smoothed_shape<ConcurrencyTag>(mesh, smoothing, np);
  for (Dual_mesh::Index f = 0; f < shape.number_of_faces(); ++f) {
    const Eigen::Vector3d n = shape.shape_normal(f);
    put(normals, shape.face_descriptors()[f], Vector(n[0], n[1], n[2]));
  }
}

/// As above, with named parameters after the output.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class FaceListGraph, class FaceNormalMap,
          class NamedParameters, std::enable_if_t<internal::is_named_parameters<NamedParameters>, int> = 0>
void smoothed_face_normals(const FaceListGraph& mesh, FaceNormalMap normals, const NamedParameters& np) {
  smoothed_face_normals<ConcurrencyTag>(mesh, normals, Normal_smoothing(), np);
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/smoothed_face_normals.h>
#endif

#endif
