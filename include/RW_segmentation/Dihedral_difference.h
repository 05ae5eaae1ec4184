#ifndef RW_SEGMENTATION_DIHEDRAL_DIFFERENCE_H
#define RW_SEGMENTATION_DIHEDRAL_DIFFERENCE_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/Edge_values.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/parallel_for.h>
#include <RW_segmentation/internal/read_normals.h>

#include <CGAL/Named_function_parameters.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <type_traits>
#include <vector>

namespace RW_segmentation {

/// How the angle theta between the unit normals Ni and Nj of two faces becomes a number.
enum class Dihedral_measure {
  one_minus_cosine,  ///< 1 - cos(theta) = |Ni - Nj|^2 / 2, as in Eq. 4: quadratic in small angles, between 0 and 2
  angle              ///< |Ni - Nj| = 2 sin(theta / 2): theta itself for small angles, between 0 and 2
};

namespace internal {

/// The core of `Dihedral_difference`: Eq. 4 and 5 for normals in the order of the faces; values in the order of the
/// edges. A zero vector is no normal.
inline std::vector<double> dihedral_difference(const Dual_graph& graph, const Face_geometry& geometry,
                                               const std::vector<Eigen::Vector3d>& normals, double convex_weight,
                                               Dihedral_measure measure) {
  if (!(convex_weight >= 0 && convex_weight <= 1))
    throw argument_error("convex_weight", convex_weight, "between 0 and 1");

  // |Ni - Nj|^2 of faces folded onto each other, up to 1e-6 radians: there only rounding tells convex from concave.
  constexpr double folded = 4 - 1e-12;
  const std::size_t edges = graph.number_of_edges();
  std::vector<double> d(edges);
  parallel_stretches(edges, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const auto [i, j] = graph.faces_of(static_cast<Dual_graph::Index>(e));
      const Eigen::Vector3d turn = normals[j] - normals[i];
      if (normals[i].isZero(0) || normals[j].isZero(0)) continue;
      const bool concave = turn.dot(geometry.centroid[j] - geometry.centroid[i]) < 0 && turn.squaredNorm() < folded;
      const double eta = concave ? 1 : convex_weight;
      // |Ni - Nj|^2 / 2, because 1 - Ni.Nj would lose all digits on flat edges.
      d[e] = eta * (measure == Dihedral_measure::angle ? turn.norm() : turn.squaredNorm() / 2);
    }
  });
  const double sum = std::accumulate(d.begin(), d.end(), 0.);

  // Below these means the mesh is flat, and its angles are the rounding of coordinates.
  const double flat_angle = std::max(1e-6, 2 * geometry.rounding / std::max(geometry.mean_edge_length(), 1e-12));
  const double flat = measure == Dihedral_measure::angle ? flat_angle : flat_angle * flat_angle;
  const double mean = edges == 0 ? 0 : sum / static_cast<double>(edges);
  for (double& value : d) value = mean < flat ? 0 : value / mean;
  return d;
}

}  // namespace internal

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
 public:
  using edge_descriptor = typename boost::graph_traits<FaceListGraph>::edge_descriptor;

  /// The difference by the faces' own normals. Complexity: linear.
  ///
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh; no reference to it is kept
  /// \param convex_weight eta of convex edges, in [0, 1]; the paper's value is 0.2
  /// \param measure what is taken of the angle
  /// \param np `vertex_point_map` (default: that of the mesh)
  /// \throws std::invalid_argument if `convex_weight` lies outside [0, 1] or a coordinate is not finite (names the
  /// vertex)
  template <class NamedParameters = CGAL::parameters::Default_named_parameters>
  explicit Dihedral_difference(const FaceListGraph& mesh, double convex_weight = 0.2,
                               Dihedral_measure measure = Dihedral_measure::one_minus_cosine,
                               const NamedParameters& np = CGAL::parameters::default_values())
      : Base(computed(mesh, convex_weight, measure, np,
                      [](const auto&, const auto& geometry) { return geometry.normal; })) {}

  /// The difference by given normals, such as those of `smoothed_face_normals()`. Complexity: linear.
  ///
  /// \tparam FaceNormalMap a readable property map from `face_descriptor` to a vector with `operator[]`
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh; no reference to it is kept
  /// \param normals the faces' outward normals, of any length; a zero vector says that a face has none
  /// \param convex_weight eta of convex edges, in [0, 1]; the paper's value is 0.2
  /// \param measure what is taken of the angle
  /// \param np `vertex_point_map` (default: that of the mesh)
  /// \throws std::invalid_argument if `convex_weight` lies outside [0, 1], or a normal or a coordinate is not finite
  template <class FaceNormalMap, class NamedParameters = CGAL::parameters::Default_named_parameters,
            std::enable_if_t<!std::is_arithmetic_v<FaceNormalMap>, int> = 0>
  explicit Dihedral_difference(const FaceListGraph& mesh, const FaceNormalMap& normals, double convex_weight = 0.2,
                               Dihedral_measure measure = Dihedral_measure::one_minus_cosine,
                               const NamedParameters& np = CGAL::parameters::default_values())
      : Base(computed(mesh, convex_weight, measure, np,
                      [&](const auto& graph, const auto&) { return internal::read_normals(graph, normals); })) {}

 private:
  using Base = internal::Shared_edge_values<FaceListGraph>;

  template <class NamedParameters, class Normals>
  static Base computed(const FaceListGraph& mesh, double convex_weight, Dihedral_measure measure,
                       const NamedParameters& np, const Normals& normals) {
    const Mesh_dual_graph<FaceListGraph> graph(mesh);
    const internal::Face_geometry geometry = internal::face_geometry(mesh, graph, np);
    return Base(graph,
                internal::dihedral_difference(graph, geometry, normals(graph, geometry), convex_weight, measure));
  }
};

}  // namespace RW_segmentation

#endif
