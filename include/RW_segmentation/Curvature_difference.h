// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_CURVATURE_DIFFERENCE_H
#define RW_SEGMENTATION_CURVATURE_DIFFERENCE_H

#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/integral_invariant_curvatures.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/Shared_edge_values.h>
#include <RW_segmentation/internal/named_parameters.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

namespace RW_segmentation {
namespace internal {

/// Eq. 7 and 8 for curvatures in the order of the faces, in the unit box.
std::vector<double> curvature_difference(const Dual_mesh& mesh, const std::vector<Surface_curvatures>& curvatures);

/// A face map of curvatures, in the order of the faces and in the unit box.
/// \throws std::invalid_argument if a curvature is not finite, naming the face by its place
template <class Mesh, class CurvatureMap>
std::vector<Surface_curvatures> read_curvatures(const Dual_mesh_of<Mesh>& mesh, const CurvatureMap& map) {
  std::vector<Surface_curvatures> curvatures =
      mesh.read_faces(map, [](const auto& value) { return Surface_curvatures(value); });
  for (std::size_t f = 0; f < curvatures.size(); ++f) {
    curvatures[f].max_curvature *= mesh.unit();
    curvatures[f].min_curvature *= mesh.unit();
    if (!std::isfinite(curvatures[f].gaussian_curvature()))
      throw argument_error(
          ("the curvature of face " + std::to_string(mesh.place(static_cast<Dual_mesh::Index>(f)))).c_str(),
          curvatures[f].gaussian_curvature(), "finite");
  }
  return curvatures;
}

}  // namespace internal

/// How faces differ for engineering models, see `Curvature_difference`: a difference policy, a function object from a
/// dual mesh to the differences of its edges.
struct Curvature_difference_policy {
  Ball_radius radius = Ball_radius::in_edge_lengths(3);  ///< of the balls in which curvatures are measured

  /// Eq. 7 and 8. Complexity: that of `integral_invariant_curvatures()`.
  /// \returns the difference of each edge
  /// \throws std::invalid_argument if the radius is not positive
  /// \throws Cancelled
  template <class ConcurrencyTag = CGAL::Parallel_if_available_tag>
  std::vector<double> operator()(const Dual_mesh& mesh, const Progress& progress = {}) const {
    std::vector<Curvature_report> reports;
    const auto curvatures =
        internal::curvatures_of_faces<ConcurrencyTag>(mesh, {internal::length_of(radius, mesh)}, reports, progress);
    return internal::curvature_difference(mesh, curvatures.front());
  }
};

/// The difference of two faces for engineering models (Eq. 7 and 8): the largest of
///
///   d1 = 1 - cos theta between their normals, on convex edges as on concave ones,
///   d2 = |K - K'| of the Gaussian curvatures,
///   d3 = |H - H'| of the mean curvatures,
///
/// each divided by its mean over all interior edges. d1 finds sharp edges, d2 and d3 smooth joints, such as the one
/// between a plane and the fillet beside it. A term whose mean vanishes is left out, as d2 and d3 on a plane.
///
/// The mean of d1 is the arithmetic one, as in `Dihedral_difference`. At a crease d3 exceeds that of smooth joints ten
/// times and d2 a hundred times: in an arithmetic mean one crease would hide all joints. The means of d2 and d3 are
/// squares of the mean of square roots, weighted with the edges' lengths.
///
/// A readable property map from `edge_descriptor` to `double`, computed once in the constructor. Copies share the
/// values; looking one up is O(1) and safe from several threads. 0 on border edges and beside faces without area.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
template <class FaceListGraph>
class Curvature_difference : public internal::Shared_edge_values<FaceListGraph> {
 public:
  using edge_descriptor = typename boost::graph_traits<FaceListGraph>::edge_descriptor;

  /// The difference by curvatures that are measured in balls of a radius, see `integral_invariant_curvatures()`.
  ///
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh, its faces oriented outward; no reference to it is kept
  /// \param radius of the balls: as small as noise and triangles allow, as joints blur to twice this width
  /// \param np `vertex_point_map` (default: that of the mesh), `callback` (`std::function<bool(double)>`, default: none)
  /// \throws std::invalid_argument if the radius is not positive or a coordinate is not finite (names the vertex)
  /// \throws Cancelled
  template <class NamedParameters = CGAL::parameters::Default_named_parameters>
  explicit Curvature_difference(const FaceListGraph& mesh, Ball_radius radius = Ball_radius::in_edge_lengths(3),
                                const NamedParameters& np = CGAL::parameters::default_values())
      : Base(computed(internal::dual_mesh(mesh, np), [&](const auto& dual) {
          return Curvature_difference_policy{radius}(dual, internal::progress_of(np));
        })) {
    static_assert(internal::has_only<NamedParameters, internal::Vertex_point, internal::Callback>,
                  "Curvature_difference takes the named parameters vertex_point_map and callback.");
  }

  /// By balls of the usual radius, with named parameters after the mesh.
  template <class T, class Tag, class Parameters>
  Curvature_difference(const FaceListGraph& mesh, const CGAL::Named_function_parameters<T, Tag, Parameters>& np)
      : Curvature_difference(mesh, Curvature_difference_policy().radius, np) {}

  /// The difference by given curvatures. Complexity: linear.
  ///
  /// \tparam CurvatureMap a readable property map from `face_descriptor` to `Surface_curvatures`
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh; no reference to it is kept
  /// \param curvatures the faces' principal curvatures
  /// \param np `vertex_point_map` (default: that of the mesh)
  /// \throws std::invalid_argument if a curvature or a coordinate is not finite
  template <class CurvatureMap, class NamedParameters = CGAL::parameters::Default_named_parameters,
            std::enable_if_t<!std::is_same_v<CurvatureMap, Ball_radius>, int> = 0>
  explicit Curvature_difference(const FaceListGraph& mesh, const CurvatureMap& curvatures,
                                const NamedParameters& np = CGAL::parameters::default_values())
      : Base(computed(internal::dual_mesh(mesh, np), [&](const auto& dual) {
          return internal::curvature_difference(dual, internal::read_curvatures(dual, curvatures));
        })) {
    static_assert(internal::has_only<NamedParameters, internal::Vertex_point>,
                  "Curvature_difference of given curvatures takes the named parameter vertex_point_map.");
  }

 private:
  using Base = internal::Shared_edge_values<FaceListGraph>;

  template <class Mesh, class Difference>
  static Base computed(const Dual_mesh_of<Mesh>& mesh, const Difference& difference) {
    return Base(mesh, difference(mesh));
  }
};

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Curvature_difference.h>
#endif

#endif
