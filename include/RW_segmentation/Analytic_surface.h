// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_ANALYTIC_SURFACE_H
#define RW_SEGMENTATION_ANALYTIC_SURFACE_H

#include <RW_segmentation/Surface_samples.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// What a piece of a solid's surface is.
enum class Surface_type {
  plane,      ///< flat
  sphere,     ///< at one distance from a point
  cylinder,   ///< at one distance from a line
  cone,       ///< lines through an apex, at one angle to an axis
  torus,      ///< at one distance from a circle
  free_form,  ///< none of these
};

namespace internal {

template <std::size_t... Types>
constexpr auto all_types(std::index_sequence<Types...>) {
  return std::array<Surface_type, sizeof...(Types)>{static_cast<Surface_type>(Types)...};
}

}  // namespace internal

/// The types that can be fitted, the simplest first.
constexpr auto analytic_types =
    internal::all_types(std::make_index_sequence<static_cast<std::size_t>(Surface_type::free_form)>());

/// How many numbers determine a surface of that type; 0 for a free form.
int degrees_of_freedom(Surface_type type);

/// A type in words: "plane", "cylinder", ..., "free form".
const char* name_of(Surface_type type);

/// The standard deviations of a surface's numbers. Infinite where points do not tell a number, 0 of what the surface has
/// not.
struct Surface_errors {
  /// Of the point, in the direction in which it is known least; along a plane or a cylinder's axis it may be anywhere.
  double point = 0;
  double direction = 0;    ///< of the direction's turn, in radians, likewise
  double radius = 0;       ///< of the radius
  double tube_radius = 0;  ///< of the torus
  double half_angle = 0;   ///< of the cone, in radians
  /// Of the place of a cone's axis across itself, where it is known best: a slender cone's apex is known much less.
  double axis = 0;
  double axis_height = 0;  ///< where that is, from the apex along the axis: no error, but a length
};

/// An unbounded plane, sphere, cylinder, cone or torus. A free form has none of the numbers.
struct Analytic_surface {
  Surface_type type = Surface_type::free_form;  ///< which of them it is
  /// A point of the plane or of the cylinder's axis, the centre of the sphere or torus, the apex of the cone.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /// Of unit length: the plane's normal, or the axis; a cone opens along it.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  double radius = 0;       ///< of the sphere, the cylinder, or the circle that the torus's tube is centred on
  double tube_radius = 0;  ///< of the torus
  double half_angle = 0;   ///< of the cone, between axis and surface, in radians
  double residual = 0;     ///< root mean square distance of what it was fitted to
  Surface_errors errors;   ///< as `segment_surfaces()` estimates them, 0 otherwise

  /// Distance of a point, negative on the side that `normal()` points away from.
  /// \pre the surface is no free form
  double signed_distance(const Eigen::Vector3d& p) const;

  /// The gradient of the distance: a unit vector, away from the axis or the centre.
  /// \pre the surface is no free form
  Eigen::Vector3d normal(const Eigen::Vector3d& p) const;
};

/// The root mean square distance of points from a surface.
/// \pre the surface is no free form
double root_mean_square_distance(const Analytic_surface& surface, const std::vector<Eigen::Vector3d>& points);

/// The surface of a type that is closest to points, in the sense of least squares of the true distances.
///
/// The normals give the first approximation: the axis of a cylinder is orthogonal to them, the tangent planes of a cone
/// meet in its apex, the normals of a torus meet its axis. Levenberg-Marquardt steps follow. Complexity: linear in the
/// number of samples.
///
/// \param type what to fit
/// \param samples at least as many points as the surface has degrees of freedom, and one normal. Accuracy suffers when
/// coordinates are far from 0 or huge.
/// \param largest_residual the largest root mean square distance that is of use: what cannot come near it is given up
/// after a step or two
/// \returns nothing if there are too few samples, they are too flat to tell the surface from a simpler one, or its
/// residual is larger than that
std::optional<Analytic_surface> fit_analytic_surface(Surface_type type, const Surface_samples& samples,
                                                     double largest_residual = std::numeric_limits<double>::infinity());

/// The surface that explains points best: the number of degrees of freedom counts against closeness, each as much as
/// log(n) squared deviations by the tolerance (the Bayesian information criterion of n points with Gaussian errors).
/// Normals count, too: vertices on two circles lie on a cylinder, a cone and a sphere. A deviation of a normal is 0.1,
/// by which facets are off their surface at most.
///
/// \param samples see above
/// \param tolerance the root mean square distance that points on a surface are expected to have; in units of the points
/// \returns a free form if no surface lies within twice the tolerance, in the root mean square, of the points
Analytic_surface fit_analytic_surface(const Surface_samples& samples, double tolerance);

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Analytic_surface.h>
#endif

#endif
