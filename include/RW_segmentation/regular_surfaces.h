// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_REGULAR_SURFACES_H
#define RW_SEGMENTATION_REGULAR_SURFACES_H

#include <RW_segmentation/Analytic_surface.h>

#include <cstddef>
#include <vector>

namespace RW_segmentation {

/// How far numbers of surfaces may differ that are meant to be the same.
struct Regularity_tolerance {
  double length = 0;           ///< of positions and radii, in the unit of the surfaces
  double angle = 0;            ///< of directions and half angles, in radians
  double standard_errors = 3;  ///< of the difference of two numbers; what is larger counts, this or the above
};

/// What two surfaces are made to have in common.
enum class Regularity {
  parallel,          ///< normals or axes of one direction
  perpendicular,     ///< normals or axes at a right angle
  coplanar,          ///< planes
  coaxial,           ///< cylinders, cones and tori
  equal_radius,      ///< of cylinders, spheres and tubes of tori
  equal_ring,        ///< radii of tori
  equal_half_angle,  ///< of cones
};

/// A regularity in words: "parallel", "equal radius", ...
const char* name_of(Regularity regularity);

/// A regularity of two surfaces.
struct Surface_snap {
  Regularity regularity = Regularity::parallel;  ///< what they have in common now
  std::size_t first = 0;                         ///< the number of one of the surfaces
  std::size_t second = 0;                        ///< that of the other one, which is larger
  double difference = 0;                         ///< that they had before, a length or an angle in radians
};

/// Surfaces and what they have in common.
struct Regular_surfaces {
  std::vector<Analytic_surface> surfaces;  ///< as many as were given
  std::vector<Surface_snap> snaps;         ///< for each group the surface of the lowest number with each other one
};

/// Makes nearly parallel normals and axes parallel and nearly perpendicular ones perpendicular, nearly coplanar planes one
/// plane, nearly coaxial surfaces coaxial, and nearly equal radii and angles equal.
///
/// Numbers become one, the mean weighted by their errors as far as these are more than rounding, if all of a group are within
/// the tolerance of each other and no other one is near: where a chain of small differences adds up to a large one, nothing
/// is changed. So the result does not depend on the order of the surfaces, and doing it again changes nothing. The most that
/// errors excuse is one degree, or a hundredth of a radius. Surfaces turn about their `point`, cones about where the place of
/// their axis is known best. Residuals and errors remain those of the fits, and free forms what they are. Complexity:
/// quadratic in the number of surfaces.
///
/// \param surfaces with their errors, as `segment_surfaces()` finds them
/// \param tolerance without standard errors, only differences up to the length and the angle are removed
/// \throws std::invalid_argument if a tolerance is negative or not finite
Regular_surfaces regular_surfaces(const std::vector<Analytic_surface>& surfaces,
                                  const Regularity_tolerance& tolerance = Regularity_tolerance());

}  // namespace RW_segmentation

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/regular_surfaces.h>
#endif

#endif
