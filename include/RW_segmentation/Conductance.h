// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_CONDUCTANCE_H
#define RW_SEGMENTATION_CONDUCTANCE_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/Shared_edge_values.h>
#include <RW_segmentation/internal/named_parameters.h>

#include <CGAL/Named_function_parameters.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// \throws std::invalid_argument unless `sigma` is positive and finite and `cap` positive
void require_conductance_numbers(double sigma, double cap);

/// Eq. 6.
std::vector<double> conductances(const Dual_mesh& mesh, const std::vector<double>& differences, double sigma,
                                 double cap);

}  // namespace internal

/// The conductance of each edge of a mesh, how easily a random walk crosses it (Eq. 6):
/// w = |e| exp(-min(d / sigma, cap)), with the length |e| of the edge and the difference d of its two faces.
///
/// A readable property map from `edge_descriptor` to `double`, computed once in the constructor. Copies share the
/// values; looking one up is O(1) and safe from several threads. Lengths are measured in the diagonal of the mesh's
/// bounding box: only ratios of conductances matter. Border edges have 0.
///
/// All conductances are positive, so that the graph stays connected, except on the edges that
/// `edge_is_constrained_map` marks, which have exactly 0. An edge shorter than 1e-6 times the mean length counts as
/// that long.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
template <class FaceListGraph>
class Conductance : public internal::Shared_edge_values<FaceListGraph> {
 public:
  using edge_descriptor = typename boost::graph_traits<FaceListGraph>::edge_descriptor;
  /// What functions that take conductances ask for, so that no difference is mistaken for one.
  using is_conductance = std::true_type;

  static constexpr double usual_sigma = 1;  ///< the paper's value
  static constexpr double usual_cap = 20;   ///< see the constructor

  /// Computes all conductances. Complexity: linear, plus one call of `get(difference, edge)` for each interior edge.
  ///
  /// \tparam Difference a readable property map from `edge_descriptor` to a number >= 0 (infinity included):
  /// `Dihedral_difference`, `Curvature_difference`, a stored map, a function wrapped by
  /// `boost::make_function_property_map`
  /// \tparam NamedParameters a sequence of CGAL's named parameters
  /// \param mesh the mesh; no reference to it is kept
  /// \param difference how different the two faces of an edge are, 1 on average
  /// \param sigma the difference that divides the conductance by e, > 0
  /// \param cap the largest exponent, > 0, infinity allowed. Under refinement the mean difference falls while creases
  /// stay, so that d / sigma reaches thousands and conductances leave the range of a double. With `usual_cap` they
  /// span at most nine decades for edges of one length; on 380 meshes of people's segmentations 99.91 % or more of the
  /// faces get the label of the uncapped walk (99.5 % with 10, 85 % to 98 % with 5). Exponents above 600 count as 600
  /// even if the cap is infinite: no conductance underflows.
  /// \param np `vertex_point_map` (default: that of the mesh), `edge_is_constrained_map` (readable map from
  /// `edge_descriptor` to `bool`, default: no edge is)
  /// \throws std::invalid_argument if `sigma` or `cap` is not positive, a difference negative or NaN (names the edge's
  /// faces), or a coordinate not finite (names the vertex)
  template <class Difference, class NamedParameters = CGAL::parameters::Default_named_parameters>
  Conductance(const FaceListGraph& mesh, const Difference& difference, double sigma = usual_sigma,
              double cap = usual_cap, const NamedParameters& np = CGAL::parameters::default_values())
      : Base(computed(internal::dual_mesh(mesh, np), difference, sigma, cap)) {
    static_assert(internal::has_only<NamedParameters, internal::Vertex_point, internal::Edge_is_constrained>,
                  "Conductance takes the named parameters vertex_point_map and edge_is_constrained_map.");
  }

  /// By the usual numbers, with named parameters after the difference.
  template <class Difference, class T, class Tag, class Parameters>
  Conductance(const FaceListGraph& mesh, const Difference& difference,
              const CGAL::Named_function_parameters<T, Tag, Parameters>& np)
      : Conductance(mesh, difference, usual_sigma, usual_cap, np) {}

 private:
  using Base = internal::Shared_edge_values<FaceListGraph>;

  template <class Mesh, class Difference>
  static Base computed(const Dual_mesh_of<Mesh>& mesh, const Difference& difference, double sigma, double cap) {
    internal::require_conductance_numbers(sigma, cap);
    return Base(mesh, internal::conductances(mesh, mesh.read_edges(difference, "the difference"), sigma, cap));
  }
};

/// A user's own edge map, taken for conductances; made by `as_conductance()`.
///
/// \tparam EdgeMap a readable property map from `edge_descriptor` to a number >= 0
template <class EdgeMap>
class Conductance_map {
 public:
  /// \cond  what a property map names
  using key_type = typename boost::property_traits<EdgeMap>::key_type;
  using value_type = typename boost::property_traits<EdgeMap>::value_type;
  using reference = typename boost::property_traits<EdgeMap>::reference;
  using category = boost::readable_property_map_tag;
  /// \endcond
  /// What functions that take conductances ask for.
  using is_conductance = std::true_type;

  /// Keeps a copy of the map.
  explicit Conductance_map(const EdgeMap& values) : values_(values) {}

  friend reference get(const Conductance_map& map, const key_type& edge) { return get(map.values_, edge); }

 private:
  EdgeMap values_;
};

/// Says that the values of a map are conductances, where `Conductance` would compute them otherwise than wanted: how
/// easily a walk crosses each edge, finite and not negative, 0 where it cannot.
///
/// \tparam EdgeMap a readable property map from `edge_descriptor` to a number
template <class EdgeMap>
Conductance_map<EdgeMap> as_conductance(const EdgeMap& values) {
  return Conductance_map<EdgeMap>(values);
}

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Conductance.h>
#endif

#endif
