// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_OF_REVOLUTION_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_OF_REVOLUTION_H

#include <RW_segmentation/internal/surfaces/Point_block.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <limits>
#include <tuple>

namespace RW_segmentation::internal {

/// Where a surface is.
struct Placed_surface {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< of unit length

  static constexpr bool first_guess_is_closest = false;
  /// Does what is to be done when numbers of the shape have changed.
  void prepare() {}

  /// Two unit vectors across the direction, along which a surface is shifted and turned.
  struct Frame {
    explicit Frame(const Placed_surface& s) : first(s.direction.unitOrthogonal()), second(s.direction.cross(first)) {}
    Eigen::Vector3d first, second;
  };
};

/// The distance from a curve in the half plane beside an axis, and its gradient.
template <class Number>
struct Meridian_distance {
  Number distance, off_axis, along_axis;
};

/// The part of a type of surface that all surfaces of revolution have in common: distance, normal and derivatives by
/// place and direction follow from the meridian.
///
/// \tparam Type the type, derived from this. It has `is_placed_along_axis`, false where a shift along the axis changes
/// nothing; `Meridian_distance meridian(s, h)` at the distance s from the axis and the height h; and
/// `shape_derivatives(s, h, meridian, row)`, by the numbers of the shape. Both take one number or several at once.
template <class Type>
struct Surface_of_revolution : Placed_surface {
  double distance(const Eigen::Vector3d& p) const { return distance(coordinates(p)); }

  template <class Number>
  Number distance(const Coordinates<Number>& p) const {
    const Place<Number> at(*this, p);
    return type().meridian(at.s, at.h).distance;
  }

  Eigen::Vector3d normal(const Eigen::Vector3d& p) const {
    const Place<double> at(*this, coordinates(p));
    const Meridian_distance<double> m = type().meridian(at.s, at.h);
    const double outward = m.off_axis / at_least(at.s, std::numeric_limits<double>::min());
    return outward * Eigen::Vector3d(at.across.x, at.across.y, at.across.z) + m.along_axis * direction;
  }

  /// By shifts of the point, turns of the direction, and the numbers of the shape.
  template <class Number, class Row>
  Number derivatives(const Coordinates<Number>& p, const Frame& frame, Row& row) const {
    const Place<Number> at(*this, p);
    const Meridian_distance<Number> m = type().meridian(at.s, at.h);
    const Number unit = 1 / at_least(at.s, std::numeric_limits<double>::min());
    const Number x = at.across.dot(frame.first) * unit, y = at.across.dot(frame.second) * unit;
    const Number turn = at.s * m.along_axis - at.h * m.off_axis;
    std::size_t k = 0;
    row[k++] = -m.off_axis * x;
    row[k++] = -m.off_axis * y;
    if constexpr (Type::is_placed_along_axis) row[k++] = -m.along_axis;
    row[k++] = turn * x;
    row[k++] = turn * y;
    type().shape_derivatives(at.s, at.h, m, row.data() + k);
    return m.distance;
  }

  /// The surface after a step in the unknowns of `derivatives()`.
  template <class Step>
  Type moved(const Step& step, const Frame& frame) const {
    Type result = type();
    int k = 0;
    result.point += step[0] * frame.first + step[1] * frame.second;
    k += 2;
    if constexpr (Type::is_placed_along_axis) result.point += step[k++] * direction;
    result.direction = (direction + step[k] * frame.first + step[k + 1] * frame.second).normalized();
    k += 2;
    std::apply([&](auto&... number) { ((number += step[k++]), ...); }, Type::numbers(result));
    result.prepare();
    return result;
  }

 private:
  /// Where a point lies beside the axis.
  template <class Number>
  struct Place {
    Place(const Placed_surface& surface, const Coordinates<Number>& p) : across(p.minus(surface.point)) {
      h = across.dot(surface.direction);
      across = across.minus(h, surface.direction);
      s = square_root(across.squared_norm());
    }

    Coordinates<Number> across;
    Number s, h;
  };

  const Type& type() const { return static_cast<const Type&>(*this); }
};

}  // namespace RW_segmentation::internal

#endif
