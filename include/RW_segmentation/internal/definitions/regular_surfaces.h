// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_REGULAR_SURFACES_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_REGULAR_SURFACES_H

#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/Value_groups.h>
#include <RW_segmentation/regular_surfaces.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// Finds what surfaces have in common: directions first, then positions of those of one direction, then radii.
class Surface_regularities {
 public:
  Surface_regularities(const std::vector<Analytic_surface>& surfaces, const Regularity_tolerance& tolerance)
      : tolerance_(tolerance) {
    result_.surfaces = surfaces;
    for (const Analytic_surface& s : surfaces)
      if (s.type != Surface_type::free_form)
        exact_length_ = std::max({exact_length_, exactness_ * s.point.cwiseAbs().maxCoeff(), exactness_ * s.radius});
    tolerance_.length = std::max(tolerance_.length, exact_length_);
    tolerance_.angle = std::max(tolerance_.angle, exactness_);
  }

  Regular_surfaces result() {
    make_parallel();
    make_perpendicular();
    join_planes();
    join_axes();
    join_numbers(Regularity::equal_radius, curved_across(), largest_share_);
    join_numbers(Regularity::equal_ring,
                 numbers_of(Surface_type::torus, &Analytic_surface::radius, &Surface_errors::radius), largest_share_);
    join_numbers(Regularity::equal_half_angle,
                 numbers_of(Surface_type::cone, &Analytic_surface::half_angle, &Surface_errors::half_angle), 0);
    return std::move(result_);
  }

 private:
  using Vector = Eigen::Vector3d;
  using Numbers = std::vector<std::size_t>;

  /// A number of a surface, and how well it is known.
  struct Known_number {
    std::size_t surface;
    double* value;
    double error;
  };

  // Numbers are not told apart below that: files have nine digits or so. Of the largest coordinate or radius, and in
  // radians.
  static constexpr double exactness_ = 1e-9;

  // The most that errors excuse.
  static constexpr double largest_angle_ = radians(1);
  static constexpr double largest_share_ = 0.01;  // of a radius

  static double known(double error) { return std::isfinite(error) ? error : 0; }
  /// \param exact the error below which numbers are as good as exact: smaller errors are rounding
  static double weight(double error, double exact) {
    constexpr double least = 1e-30, none = 1e-60;  // whose ratio is a number, and so is its square
    if (!std::isfinite(error)) return none;
    const double counted = std::max({error, exact, least});
    return 1 / (counted * counted);
  }
  double excused(double a, double b, double most) const {
    return std::min(most, tolerance_.standard_errors * std::hypot(known(a), known(b)));
  }
  double angle_between(const Vector& a, const Vector& b) const { return std::asin(std::min(1., a.cross(b).norm())); }
  double largest_angle(double a, double b) const { return std::max(tolerance_.angle, excused(a, b, largest_angle_)); }

  bool has_direction(std::size_t s) const {
    const Surface_type type = result_.surfaces[s].type;
    return type != Surface_type::free_form && type != Surface_type::sphere;
  }
  bool has_axis(std::size_t s) const { return has_direction(s) && result_.surfaces[s].type != Surface_type::plane; }
  double turn_error(std::size_t s) const { return result_.surfaces[s].errors.direction; }

  /// Whether the place of an axis is known best elsewhere than at the surface's point, the apex of a cone.
  bool has_middle(std::size_t s) const {
    return result_.surfaces[s].type == Surface_type::cone && result_.surfaces[s].errors.axis_height != 0;
  }
  /// Where the place of an axis is known best.
  Vector middle_of_axis(std::size_t s) const {
    const Analytic_surface& surface = result_.surfaces[s];
    return has_middle(s) ? Vector(surface.point + surface.errors.axis_height * surface.direction) : surface.point;
  }
  /// The error there.
  double place_error(std::size_t s) const {
    const Surface_errors& errors = result_.surfaces[s].errors;
    return has_middle(s) ? errors.axis : errors.point;
  }

  template <class Predicate>
  Numbers surfaces_that(const Predicate& predicate) const {
    Numbers numbers;
    for (std::size_t s = 0; s < result_.surfaces.size(); ++s)
      if (predicate(s)) numbers.push_back(s);
    return numbers;
  }

  void note(Regularity regularity, std::size_t a, std::size_t b, double difference) {
    result_.snaps.push_back({regularity, std::min(a, b), std::max(a, b), difference});
  }

  void make_parallel() {
    const Numbers numbers = surfaces_that([&](std::size_t s) { return has_direction(s); });
    std::vector<Vector> directions;
    for (const std::size_t s : numbers) directions.push_back(result_.surfaces[s].direction);
    const std::vector<Vector> before = directions;
    const auto is_near = [&](const Vector& a, std::size_t i, const Vector& b, std::size_t j) {
      return angle_between(a, b) <= largest_angle(turn_error(numbers[i]), turn_error(numbers[j]));
    };
    const auto mean = [&](const Numbers& group) -> Vector {
      Vector sum = Vector::Zero();
      for (const std::size_t i : group)
        sum += (before[i].dot(before[group.front()]) < 0 ? -1 : 1) * weight(turn_error(numbers[i]), exactness_) /
               weight(turn_error(numbers[group.front()]), exactness_) * before[i];
      return sum.normalized();
    };
    for (const Numbers& group : join_near_values(directions, is_near, mean)) {
      for (std::size_t k = 1; k < group.size(); ++k)
        note(Regularity::parallel, numbers[group[0]], numbers[group[k]],
             angle_between(before[group[0]], before[group[k]]));
      directions_.push_back({directions[group.front()], {}});
      for (const std::size_t i : group) directions_.back().surfaces.push_back(numbers[i]);
    }
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (std::none_of(directions_.begin(), directions_.end(), [&](const Direction& d) {
            return std::find(d.surfaces.begin(), d.surfaces.end(), numbers[i]) != d.surfaces.end();
          }))
        directions_.push_back({directions[i], {numbers[i]}});
    for (const Direction& d : directions_) turn(d);
  }

  /// A direction that surfaces have in common.
  struct Direction {
    Vector vector;
    Numbers surfaces;
  };

  /// Turns the surfaces of a direction, each the shorter way.
  void turn(const Direction& d) {
    for (const std::size_t s : d.surfaces) {
      const Vector middle = middle_of_axis(s);
      Vector& direction = result_.surfaces[s].direction;
      direction = direction.dot(d.vector) < 0 ? Vector(-d.vector) : d.vector;
      if (has_middle(s)) result_.surfaces[s].point = middle - result_.surfaces[s].errors.axis_height * direction;
    }
  }

  double least_error(const Direction& d) const {
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t s : d.surfaces) least = std::min(least, turn_error(s));
    return least;
  }
  double largest_error(const Direction& d) const {
    double largest = 0;
    for (const std::size_t s : d.surfaces) largest = std::max(largest, known(turn_error(s)));
    return largest;
  }
  double tolerance_of(const Direction& a, const Direction& b) const {
    return largest_angle(least_error(a), least_error(b));
  }
  static double off_right_angle(const Vector& a, const Vector& b) {
    return std::abs(std::asin(std::clamp(a.dot(b), -1., 1.)));
  }

  /// Whether two directions are in doubt, neither the same nor clearly apart, or neither at a right angle nor clearly at
  /// another one. Both stay where they are then, lest a second turn follows from the first.
  bool are_in_doubt(const Direction& a, const Direction& b) const {
    constexpr double clearly = 4;  // tolerances: turns of both are less than three of them
    const double off = off_right_angle(a.vector, b.vector), tolerance = tolerance_of(a, b);
    return angle_between(a.vector, b.vector) <= clearly * largest_angle(largest_error(a), largest_error(b)) ||
           (off > tolerance && off <= clearly * tolerance);
  }

  /// Those that are known best stay, in their plane or line the others move.
  void make_perpendicular() {
    std::stable_sort(directions_.begin(), directions_.end(), [&](const Direction& a, const Direction& b) {
      const double of_a = least_error(a), of_b = least_error(b);
      return of_a != of_b ? of_a < of_b : is_first(a.vector, b.vector);
    });
    std::vector<bool> stays(directions_.size(), false);
    for (std::size_t i = 0; i < directions_.size(); ++i)
      for (std::size_t k = 0; k < directions_.size() && !stays[i]; ++k)
        stays[i] = i != k && are_in_doubt(directions_[i], directions_[k]);
    const std::vector<Direction> before = directions_;
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      if (stays[i]) continue;
      Numbers others;
      for (std::size_t k = 0; k < i && others.size() < 2; ++k)
        if (off_right_angle(before[i].vector, before[k].vector) <= tolerance_of(before[i], before[k]) &&
            (others.empty() || are_far_apart(directions_[others.front()].vector, directions_[k].vector)))
          others.push_back(k);
      if (others.empty()) continue;
      const Vector moved = across(before[i].vector, others);
      if (angle_between(moved, before[i].vector) > tolerance_of(before[i], before[others.back()])) continue;
      directions_[i].vector = moved;
      turn(directions_[i]);
      for (const std::size_t k : others)
        note(Regularity::perpendicular, least_of(before[i]), least_of(before[k]),
             off_right_angle(before[i].vector, before[k].vector));
    }
  }

  /// An order of directions that have no sign.
  static bool is_first(Vector a, Vector b) {
    for (Vector* v : {&a, &b}) {
      Eigen::Index largest = 0;
      v->cwiseAbs().maxCoeff(&largest);
      if ((*v)[largest] < 0) *v = -*v;
    }
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  }

  static bool are_far_apart(const Vector& a, const Vector& b) {
    constexpr double far = 0.5;  // the sine of the angle: their cross product has a direction
    return a.cross(b).norm() > far;
  }

  static std::size_t least_of(const Direction& d) { return *std::min_element(d.surfaces.begin(), d.surfaces.end()); }

  /// The unit vector closest to a direction that is perpendicular to one or two others.
  Vector across(const Vector& direction, const Numbers& others) const {
    const Vector& first = directions_[others.front()].vector;
    if (others.size() == 1) return (direction - direction.dot(first) * first).normalized();
    const Vector normal = first.cross(directions_[others.back()].vector).normalized();
    return normal.dot(direction) < 0 ? Vector(-normal) : normal;
  }

  /// What an error of a direction comes to between two surfaces.
  double lever(std::size_t a, std::size_t b, double distance) const {
    return distance * std::min(known(turn_error(a)), known(turn_error(b)));
  }

  bool are_placed_alike(std::size_t a, std::size_t b, double difference, double distance, double most) const {
    const double error = std::hypot(known(place_error(a)), lever(a, b, distance));
    return difference <= std::max(tolerance_.length, excused(error, place_error(b), most));
  }

  void join_planes() {
    for (const Direction& d : directions_) {
      Numbers planes;
      for (const std::size_t s : d.surfaces)
        if (result_.surfaces[s].type == Surface_type::plane) planes.push_back(s);
      const Vector n = d.vector;
      std::vector<double> offsets;
      for (const std::size_t s : planes) offsets.push_back(n.dot(result_.surfaces[s].point));
      const std::vector<double> before = offsets;
      const auto is_near = [&](double a, std::size_t i, double b, std::size_t j) {
        const Vector way = result_.surfaces[planes[i]].point - result_.surfaces[planes[j]].point;
        return are_placed_alike(planes[i], planes[j], std::abs(a - b), (way - way.dot(n) * n).norm(),
                                std::numeric_limits<double>::infinity());
      };
      const auto mean = [&](const Numbers& group) {
        return mean_of(before, group, exact_length_,
                       [&](std::size_t i) { return result_.surfaces[planes[i]].errors.point; });
      };
      for (const Numbers& group : join_near_values(offsets, is_near, mean))
        for (std::size_t k = 1; k < group.size(); ++k)
          note(Regularity::coplanar, planes[group[0]], planes[group[k]], std::abs(before[group[0]] - before[group[k]]));
      for (std::size_t i = 0; i < planes.size(); ++i) result_.surfaces[planes[i]].point += (offsets[i] - before[i]) * n;
    }
  }

  void join_axes() {
    for (const Direction& d : directions_) {
      Numbers axes;
      for (const std::size_t s : d.surfaces)
        if (has_axis(s)) axes.push_back(s);
      const Vector n = d.vector;
      std::vector<Vector> feet;
      for (const std::size_t s : axes) {
        const Vector& p = result_.surfaces[s].point;
        feet.push_back(p - p.dot(n) * n);
      }
      const std::vector<Vector> before = feet;
      const auto is_near = [&](const Vector& a, std::size_t i, const Vector& b, std::size_t j) {
        const double along = n.dot(middle_of_axis(axes[i]) - middle_of_axis(axes[j]));
        return are_placed_alike(axes[i], axes[j], (a - b).norm(), std::abs(along),
                                std::numeric_limits<double>::infinity());
      };
      const auto mean = [&](const Numbers& group) {
        return mean_of(before, group, exact_length_, [&](std::size_t i) { return place_error(axes[i]); });
      };
      for (const Numbers& group : join_near_values(feet, is_near, mean))
        for (std::size_t k = 1; k < group.size(); ++k)
          note(Regularity::coaxial, axes[group[0]], axes[group[k]], (before[group[0]] - before[group[k]]).norm());
      for (std::size_t i = 0; i < axes.size(); ++i) result_.surfaces[axes[i]].point += feet[i] - before[i];
    }
  }

  /// The mean of a group, weighted by the errors where these are more than `exact`.
  template <class Value, class Error>
  static Value mean_of(const std::vector<Value>& values, const Numbers& group, double exact, const Error& error) {
    const Value& origin = values[group.front()];  // lest large values cancel
    Value sum = 0 * origin;
    double weights = 0;
    for (const std::size_t i : group) {
      const double part = weight(error(i), exact) / weight(error(group.front()), exact);
      sum += part * (values[i] - origin);
      weights += part;
    }
    return origin + sum / weights;
  }

  std::vector<Known_number> numbers_of(Surface_type type, double Analytic_surface::*value,
                                       double Surface_errors::*error) {
    std::vector<Known_number> numbers;
    for (std::size_t s = 0; s < result_.surfaces.size(); ++s)
      if (result_.surfaces[s].type == type)
        numbers.push_back({s, &(result_.surfaces[s].*value), result_.surfaces[s].errors.*error});
    return numbers;
  }

  /// Radii that fillets and the balls in their corners have in common.
  std::vector<Known_number> curved_across() {
    std::vector<Known_number> all;
    for (const auto& numbers :
         {numbers_of(Surface_type::cylinder, &Analytic_surface::radius, &Surface_errors::radius),
          numbers_of(Surface_type::sphere, &Analytic_surface::radius, &Surface_errors::radius),
          numbers_of(Surface_type::torus, &Analytic_surface::tube_radius, &Surface_errors::tube_radius)})
      all.insert(all.end(), numbers.begin(), numbers.end());
    std::sort(all.begin(), all.end(),
              [](const Known_number& a, const Known_number& b) { return a.surface < b.surface; });
    return all;
  }

  /// \param largest_share that errors excuse; 0 for angles
  void join_numbers(Regularity regularity, const std::vector<Known_number>& numbers, double largest_share) {
    std::vector<double> values;
    for (const Known_number& number : numbers) values.push_back(*number.value);
    const std::vector<double> before = values;
    const auto is_near = [&](double a, std::size_t i, double b, std::size_t j) {
      const double most = largest_share > 0 ? largest_share * std::min(a, b) : largest_angle_;
      return std::abs(a - b) <= std::max(largest_share > 0 ? tolerance_.length : tolerance_.angle,
                                         excused(numbers[i].error, numbers[j].error, most));
    };
    const auto mean = [&](const Numbers& group) {
      const double exact = largest_share > 0 ? exact_length_ : exactness_;
      return mean_of(before, group, exact, [&](std::size_t i) { return numbers[i].error; });
    };
    for (const Numbers& group : join_near_values(values, is_near, mean))
      for (std::size_t k = 1; k < group.size(); ++k)
        note(regularity, numbers[group[0]].surface, numbers[group[k]].surface,
             std::abs(before[group[0]] - before[group[k]]));
    for (std::size_t i = 0; i < numbers.size(); ++i) *numbers[i].value = values[i];
  }

  Regularity_tolerance tolerance_;
  double exact_length_ = 0;
  Regular_surfaces result_;
  std::vector<Direction> directions_;
};

inline void require_tolerance(const char* name, double value) {
  if (!(value >= 0 && std::isfinite(value))) throw argument_error(name, value, "at least 0 and finite");
}

}  // namespace internal

RW_SEGMENTATION_INLINE const char* name_of(Regularity regularity) {
  switch (regularity) {
    case Regularity::parallel:
      return "parallel";
    case Regularity::perpendicular:
      return "perpendicular";
    case Regularity::coplanar:
      return "coplanar";
    case Regularity::coaxial:
      return "coaxial";
    case Regularity::equal_radius:
      return "equal radius";
    case Regularity::equal_ring:
      return "equal ring";
    case Regularity::equal_half_angle:
      break;
  }
  return "equal half angle";
}

RW_SEGMENTATION_INLINE Regular_surfaces regular_surfaces(const std::vector<Analytic_surface>& surfaces,
                                                         const Regularity_tolerance& tolerance) {
  internal::require_tolerance("the tolerance of lengths", tolerance.length);
  internal::require_tolerance("the tolerance of angles", tolerance.angle);
  internal::require_tolerance("the number of standard errors", tolerance.standard_errors);
  return internal::Surface_regularities(surfaces, tolerance).result();
}

}  // namespace RW_segmentation

#endif
