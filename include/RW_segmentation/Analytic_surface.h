// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_ANALYTIC_SURFACE_H
#define RW_SEGMENTATION_ANALYTIC_SURFACE_H

#include <RW_segmentation/Surface_samples.h>
#include <RW_segmentation/internal/surfaces/Cone.h>
#include <RW_segmentation/internal/surfaces/Cylinder.h>
#include <RW_segmentation/internal/surfaces/Plane.h>
#include <RW_segmentation/internal/surfaces/Sphere.h>
#include <RW_segmentation/internal/surfaces/Torus.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <type_traits>
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

/// The types that can be fitted, in the order of `Surface_type`, the simplest first. Another type of surface is a file
/// of its own, its name in `Surface_type`, its place here, and its numbers in `Analytic_surface` if no other type has
/// them.
///
/// A type is a struct with
/// - `name`, and `degrees_of_freedom`: how many numbers determine such a surface;
/// - `point` and `direction`, and `numbers(surface)`, the numbers of the shape, in the struct itself and in an
///   `Analytic_surface`; `prepare()` is called when they have changed;
/// - `distance(p)`, signed, and `normal(p)`, the gradient of it;
/// - `first_guesses(samples)`, surfaces not far from `Scaled_samples`; `first_guess_is_closest` says that they are the
///   closest ones in the sense of least squares already;
/// - `derivatives(p, frame, row)`, unless they are: writes the derivatives of the distance by as many unknowns as there
///   are degrees of freedom, and returns the distance; `moved(step, frame)`, the surface after a step in these unknowns;
///   `Frame(surface)`, what the unknowns refer to;
/// - `is_sound(samples)`: whether the samples tell it from a simpler surface.
using Surface_types = std::tuple<Plane, Sphere, Cylinder, Cone, Torus>;
static_assert(std::tuple_size_v<Surface_types> == static_cast<std::size_t>(Surface_type::free_form),
              "Surface_type and Surface_types list the same types in the same order.");

/// A type as an argument.
template <class T>
struct Type_tag {
  using type = T;
};

/// Calls a function with the `Type_tag` of a type of surface.
/// \pre the type is no free form
template <std::size_t First = 0, class Function>
constexpr auto with_type(Surface_type type, const Function& function) {
  if constexpr (First + 1 < std::tuple_size_v<Surface_types>)
    if (type != static_cast<Surface_type>(First)) return with_type<First + 1>(type, function);
  return function(Type_tag<std::tuple_element_t<First, Surface_types>>());
}

template <std::size_t... Types>
constexpr auto all_types(std::index_sequence<Types...>) {
  return std::array<Surface_type, sizeof...(Types)>{static_cast<Surface_type>(Types)...};
}

}  // namespace internal

/// The types that can be fitted, the simplest first.
constexpr auto analytic_types =
    internal::all_types(std::make_index_sequence<std::tuple_size_v<internal::Surface_types>>());

/// How many numbers determine a surface of that type; 0 for a free form.
constexpr int degrees_of_freedom(Surface_type type) {
  if (type == Surface_type::free_form) return 0;
  return internal::with_type(type, [](auto tag) { return decltype(tag)::type::degrees_of_freedom; });
}

/// A type in words: "plane", "cylinder", ..., "free form".
constexpr const char* name_of(Surface_type type) {
  if (type == Surface_type::free_form) return "free form";
  return internal::with_type(type, [](auto tag) { return decltype(tag)::type::name; });
}

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

  /// Distance of a point, negative on the side that `normal()` points away from.
  /// \pre the surface is no free form
  double signed_distance(const Eigen::Vector3d& p) const;

  /// The gradient of the distance: a unit vector, away from the axis or the centre.
  /// \pre the surface is no free form
  Eigen::Vector3d normal(const Eigen::Vector3d& p) const;
};

namespace internal {

/// Calls a function with the struct of a surface's type. Cheaper than `Analytic_surface` for many points.
/// \pre the surface is no free form
template <class Function>
auto with_type_of(const Analytic_surface& surface, const Function& function) {
  return with_type(surface.type, [&](auto tag) {
    typename decltype(tag)::type typed;
    typed.point = surface.point;
    typed.direction = surface.direction;
    typed.numbers(typed) = typed.numbers(surface);
    typed.prepare();
    return function(std::as_const(typed));
  });
}

}  // namespace internal

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
