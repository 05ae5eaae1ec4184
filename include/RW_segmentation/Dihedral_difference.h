// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_DIHEDRAL_DIFFERENCE_H
#define RW_SEGMENTATION_DIHEDRAL_DIFFERENCE_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/Shared_edge_values.h>
#include <RW_segmentation/internal/named_parameters.h>
#include <RW_segmentation/internal/property_maps.h>

#include <CGAL/Named_function_parameters.h>

#include <Eigen/Core>

#include <boost/graph/graph_traits.hpp>

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace RW_segmentation {

/// How the angle theta between the unit normals Ni and Nj of two faces becomes a number.
enum class Dihedral_measure {
  one_minus_cosine,  ///< 1 - cos(theta) = |Ni - Nj|^2 / 2, as in Eq. 4: quadratic in small angles, between 0 and 2
  angle              ///< |Ni - Nj| = 2 sin(theta / 2): theta itself for small angles, between 0 and 2
};

/// How faces differ by the angle between the normals of the shape, see `Dihedral_difference`: a difference policy, a
/// function object from a dual mesh to the differences of its edges.
struct Dihedral_difference_policy {
  double convex_weight = 0.2;  ///< eta of convex edges, in [0, 1]; of concave ones it is 1
  Dihedral_measure measure = Dihedral_measure::one_minus_cosine;  ///< what is taken of the angle
  /// Differences up to so many times the mean count as none and larger ones lose it: sqrt(d^2 - x^2), divided by its mean
  /// once more. Slight concavities are everywhere on a living shape and tell nothing about where its parts meet.
  double ordinary_difference = 0;

  /// Eq. 4 and 5 for the `shape_normal()` of the faces of a mesh.
  /// \returns the difference of each edge
  /// \throws std::invalid_argument if a number is out of range
  /// Complexity: linear.
  std::vector<double> operator()(const Dual_mesh& mesh) const;
};

namespace internal {

/// How far the normals of the shape turn at each edge, in radians; times a weight at convex edges.
std::vector<double> turns(const Dual_mesh& mesh, double convex_weight);

/// The mean turn below which a mesh is flat, since its angles are the rounding of coordinates, in radians.
double flat_turn(double rounding, double mean_edge_length);

}  // namespace internal

/// The difference that agrees best with people on natural shapes, where normals are smoothed: the concavity in excess of
/// an ordinary one.
inline Dihedral_difference_policy smoothed_concavity() { return {0, Dihedral_measure::angle, 1}; }

/// The difference, by smoothed normals, for walks from seeds that are segments themselves. They heed slight concavities as
/// well, over which fragments are merged otherwise, and convex creases a little, on whose two sides seeds may lie, too. With
/// one seed in the middle of each part that people make of natural shapes, convex weights of 0, 0.02, 0.05, 0.1 and 0.2 give
/// 87.7, 87.8, 87.3, 85.6 and 81.8 % of the faces their part.
inline Dihedral_difference_policy seeded_concavity() { return {0.02, Dihedral_measure::angle, 0}; }

/// The difference of two faces by the angle between their normals (Eq. 4 and 5):
/// d1 = eta (1 - cos theta), divided by its mean over all interior edges, so that 1 is an average edge.
///
/// eta is 1 on concave edges and `convex_weight` on convex ones, after the minima rule: people cut shapes along concave
/// creases. An edge is concave where (Nj - Ni).(Cj - Ci) < 0, with the faces' centroids C; normals point outward.
/// Faces folded exactly onto each other count as convex.
///
/// A readable property map from `edge_descriptor` to `double`, computed once in the constructor. Copies share the
/// values; looking one up is O(1) and safe from several threads. 0 on border edges and beside faces without a normal,
/// such as faces without area; 0 everywhere on a flat mesh, whose angles are rounding errors (mean angle below 1e-6).
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph` with faces of any degree
template <class FaceListGraph>
class Dihedral_difference : public internal::Shared_edge_values<FaceListGraph> {
  using Base = internal::Shared_edge_values<FaceListGraph>;
  using Face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;

 public:
  using edge_descriptor = typename boost::graph_traits<FaceListGraph>::edge_descriptor;

  /// The difference by the normals of the shape: the faces' own, or those of `smoothed_shape()`. Complexity: linear.
  ///
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh; no reference to it is kept
  /// \param policy the numbers of the difference
  /// \param np `vertex_point_map` (default: that of the mesh)
  /// \throws std::invalid_argument if a number is out of range or a coordinate is not finite (names the vertex)
  template <class NamedParameters = CGAL::parameters::Default_named_parameters>
  explicit Dihedral_difference(const FaceListGraph& mesh, const Dihedral_difference_policy& policy,
                               const NamedParameters& np = CGAL::parameters::default_values())
      : Base(computed(internal::dual_mesh(mesh, np), policy)) {
    require_names<NamedParameters>();
  }

  /// As above, with the paper's numbers if none are given.
  template <class NamedParameters = CGAL::parameters::Default_named_parameters>
  explicit Dihedral_difference(const FaceListGraph& mesh, double convex_weight = 0.2,
                               Dihedral_measure measure = Dihedral_measure::one_minus_cosine,
                               const NamedParameters& np = CGAL::parameters::default_values())
      : Dihedral_difference(mesh, Dihedral_difference_policy{convex_weight, measure}, np) {}

  /// By the paper's numbers, with named parameters after the mesh.
  template <class T, class Tag, class Parameters>
  Dihedral_difference(const FaceListGraph& mesh, const CGAL::Named_function_parameters<T, Tag, Parameters>& np)
      : Dihedral_difference(mesh, Dihedral_difference_policy(), np) {}

  /// The difference by given normals, such as those of `smoothed_face_normals()`. Complexity: linear.
  ///
  /// \tparam FaceNormalMap a readable property map from `face_descriptor` to a vector with `operator[]`
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh; no reference to it is kept
  /// \param normals the faces' outward normals, of any length; a zero vector says that a face has none
  /// \param policy the numbers of the difference
  /// \param np `vertex_point_map` (default: that of the mesh)
  /// \throws std::invalid_argument if a number is out of range, or a normal or a coordinate is not finite
  template <class FaceNormalMap, class NamedParameters = CGAL::parameters::Default_named_parameters,
            std::enable_if_t<internal::is_readable_map<FaceNormalMap, Face_descriptor>, int> = 0>
  explicit Dihedral_difference(const FaceListGraph& mesh, const FaceNormalMap& normals,
                               const Dihedral_difference_policy& policy,
                               const NamedParameters& np = CGAL::parameters::default_values())
      : Base(computed(internal::dual_mesh(mesh, np), normals, policy)) {
    require_names<NamedParameters>();
  }

  /// As above, with the paper's numbers if none are given.
  template <class FaceNormalMap, class NamedParameters = CGAL::parameters::Default_named_parameters,
            std::enable_if_t<internal::is_readable_map<FaceNormalMap, Face_descriptor>, int> = 0>
  explicit Dihedral_difference(const FaceListGraph& mesh, const FaceNormalMap& normals, double convex_weight = 0.2,
                               Dihedral_measure measure = Dihedral_measure::one_minus_cosine,
                               const NamedParameters& np = CGAL::parameters::default_values())
      : Dihedral_difference(mesh, normals, Dihedral_difference_policy{convex_weight, measure}, np) {}

 private:
  template <class NamedParameters>
  static constexpr void require_names() {
    static_assert(internal::has_only<NamedParameters, internal::Vertex_point>,
                  "Dihedral_difference takes the named parameter vertex_point_map.");
  }
  template <class Mesh>
  static Base computed(const Dual_mesh_of<Mesh>& mesh, const Dihedral_difference_policy& policy) {
    return Base(mesh, policy(mesh));
  }
  template <class Mesh, class FaceNormalMap>
  static Base computed(const Dual_mesh_of<Mesh>& mesh, const FaceNormalMap& normals,
                       const Dihedral_difference_policy& policy) {
    return Base(mesh, policy(mesh.with_shape_normals(mesh.read_normals(normals))));
  }
};

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Dihedral_difference.h>
#endif

#endif
