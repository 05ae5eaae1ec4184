// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_TYPES_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_TYPES_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/internal/surfaces/Cone.h>
#include <RW_segmentation/internal/surfaces/Cylinder.h>
#include <RW_segmentation/internal/surfaces/Plane.h>
#include <RW_segmentation/internal/surfaces/Sphere.h>
#include <RW_segmentation/internal/surfaces/Torus.h>

#include <cstddef>
#include <tuple>
#include <utility>

namespace RW_segmentation::internal {

/// The types that can be fitted, in the order of `Surface_type`, the simplest first. Another type of surface is a file
/// of its own, its name in `Surface_type`, its place here, and its numbers in `Analytic_surface` if no other type has
/// them.
///
/// A type is a struct with
/// - `name`, and `degrees_of_freedom`: how many numbers determine such a surface;
/// - `point` and `direction`, and `numbers(surface)`, the numbers of the shape, in the struct itself and in an
///   `Analytic_surface`; `prepare()` is called when they have changed;
/// - `distance(p)`, signed, of a point or of the `Coordinates` of several at once, and `normal(p)`, the gradient of it;
/// - `first_guesses(samples)`, surfaces not far from `Scaled_samples`; `first_guess_is_closest` says that they are the
///   closest ones in the sense of least squares already;
/// - `derivatives(p, frame, row)`: writes the derivatives of the distance by as many unknowns as there are degrees of
///   freedom, `shifts` of the point, `turns` of the direction, and the numbers of the shape, and returns the distance,
///   all of them of `Coordinates`;
///   `moved(step, frame)`, unless first guesses are the closest: the surface after a step in these unknowns;
///   `Frame(surface)`, what the unknowns refer to;
/// - `is_sound(samples)`: whether the samples tell it from a simpler surface.
using Surface_types = std::tuple<Plane, Sphere, Cylinder, Cone, Torus>;
static_assert(std::tuple_size_v<Surface_types> == analytic_types.size(),
              "Surface_type and Surface_types list the same types in the same order.");

/// A type as an argument.
template <class T>
struct Type_tag {
  using type = T;
};

/// Calls a function with the `Type_tag` of a type of surface.
/// \pre the type is no free form
template <std::size_t First = 0, class Function>
auto with_type(Surface_type type, const Function& function) {
  if constexpr (First + 1 < std::tuple_size_v<Surface_types>)
    if (type != static_cast<Surface_type>(First)) return with_type<First + 1>(type, function);
  return function(Type_tag<std::tuple_element_t<First, Surface_types>>());
}

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

}  // namespace RW_segmentation::internal

#endif
