// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_HEIGHT_FIELD_H
#define RW_SEGMENTATION_INTERNAL_BREP_HEIGHT_FIELD_H

#include <RW_segmentation/internal/brep/Patch_surface.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation::internal::brep {

/// Uniform cubic B-splines on an interval, clamped at its ends.
class Uniform_cubic {
 public:
  Uniform_cubic(double begin, double end, std::size_t spans) : begin_(begin), step_((end - begin) / double(spans)) {
    for (std::size_t i = 0; i < 4; ++i) knots_.push_back(begin);
    for (std::size_t i = 1; i < spans; ++i) knots_.push_back(begin + step_ * double(i));
    for (std::size_t i = 0; i < 4; ++i) knots_.push_back(end);
  }

  std::size_t spans() const { return knots_.size() - 7; }
  std::size_t number() const { return knots_.size() - 4; }
  double step() const { return step_; }
  double begin() const { return begin_; }
  double knot(std::size_t i) const { return knots_[i + 3]; }  // the i-th different one

  /// The mean of three knots: where a coefficient stands, so that a linear function is its own coefficients.
  double place(std::size_t i) const { return (knots_[i + 1] + knots_[i + 2] + knots_[i + 3]) / 3; }

  /// The first of the four splines that are not 0 at x.
  std::size_t first(double x) const {
    const double span = std::floor((x - begin_) / step_);
    return static_cast<std::size_t>(std::clamp(span, 0., double(spans() - 1)));
  }

  /// The values of the splines from `first(x)` on, by de Boor's recursion; or of their derivatives.
  std::array<double, 4> values(double x, int derivative = 0) const {
    const std::size_t span = first(x) + 3;  // knots_[span] <= x < knots_[span + 1]
    std::array<double, 4> value = {0, 0, 0, 1};
    for (std::size_t degree = 1; degree <= 3; ++degree) {
      const bool is_derived = degree + static_cast<std::size_t>(derivative) > 3;
      std::array<double, 4> next = {0, 0, 0, 0};
      for (std::size_t k = 3 - degree; k < 4; ++k) {  // spline span - 3 + k of this degree
        const std::size_t i = span + k - 3;
        const auto share = [&](std::size_t lower, double numerator, double sign) {
          const double width = knots_[lower + degree] - knots_[lower];
          if (!(width > 0)) return 0.;
          return (is_derived ? sign * double(degree) : numerator) / width;
        };
        if (k > 3 - degree) next[k] += share(i, x - knots_[i], 1) * value[k];
        if (k < 3) next[k] += share(i + 1, knots_[i + degree + 1] - x, -1) * value[k + 1];
      }
      value = next;
    }
    return value;
  }

 private:
  double begin_, step_;
  std::vector<double> knots_;
};

/// A free form over a plane: a bicubic B-spline that gives the height over each point of a rectangle.
///
/// Parameters are the coordinates in the plane, so that the parameters of a point and those of an edge are exact whatever
/// the heights are.
class Height_field : public Patch_surface {
 public:
  /// Along the longer side. The coefficients of the largest fit take 10 MB and a quarter of a second.
  static constexpr std::size_t most_spans = 32;

  /// \param up away from the plane
  /// \param points about where it will lie
  Height_field(const Point& up, const std::vector<Point>& points) {
    origin_ = Point::Zero();
    for (const Point& p : points) origin_ += p / double(points.size());
    axes_.col(2) = up;
    axes_.col(0) = longest_direction(up, points);
    axes_.col(1) = up.cross(axes_.col(0));
  }

  /// Fits the heights to points, with as few splines as bring all of them within a distance, or as many as there are
  /// points.
  /// \param points of the free form
  /// \param between points about where the free form is between them, which decide where nothing else does
  /// \returns the largest distance in the direction of the height
  double fit(const std::vector<Point>& points, const std::vector<Point>& between, double distance) {
    if (points == fitted_points_) return largest_distance_;
    fitted_points_ = points;
    std::vector<Point> places;
    rectangle_.setEmpty();
    for (const Point& p : points) {
      places.push_back(local(p));
      rectangle_.extend(places.back().head<2>());
    }
    std::vector<Point> places_between;
    for (const Point& p : between) {
      places_between.push_back(local(p));
      rectangle_.extend(places_between.back().head<2>());
    }
    constexpr double margin = 0.05;  // of the rectangle's diagonal: curves may pass beyond their points
    const double width = margin * rectangle_.diagonal().norm();
    rectangle_.min().array() -= width;
    rectangle_.max().array() += width;
    double& largest = largest_distance_;
    for (std::size_t longer = 1; longer <= most_spans; longer *= 2) {
      const Eigen::Vector2d size = rectangle_.sizes();
      const double ratio = std::min(1., size.minCoeff() / size.maxCoeff());
      const auto shorter = static_cast<std::size_t>(std::ceil(double(longer) * ratio));
      const bool is_wide = size.x() >= size.y();
      if (longer > 1 && (longer + 3) * (shorter + 3) > places.size()) break;
      solve(places, places_between, is_wide ? longer : shorter, is_wide ? shorter : longer);
      largest = 0;
      for (const Point& p : places) largest = std::max(largest, std::abs(height(p.head<2>()) - p.z()));
      if (largest <= distance) break;
    }
    make_geometry();
    return largest;
  }

  Handle(Geom_Surface) geometry() const override { return geometry_; }

  double distance(const Point& p) const override {
    const Point q = local(p);
    return (q.z() - height(q.head<2>())) / std::sqrt(1 + slope(q.head<2>()).squaredNorm());
  }
  Point normal(const Point& p) const override {
    const Eigen::Vector2d down = -slope(local(p).head<2>());
    return axes_ * Point(down.x(), down.y(), 1).normalized();
  }
  Parameters parameters(const Point& p) const override { return local(p).head<2>(); }
  bool has_flat_parameters() const override { return true; }

 private:
  /// The weight of the bending beside the mean square of the distances, where the rectangle's diagonal is 1. It decides
  /// where points are too few, and moves points of an even mesh by about 1e-6 of the diagonal, those on its border by 1e-5.
  static constexpr double bending_weight = 1e-10;

  /// The weight of the mean square of the distances from points between the vertices, which are guessed, beside that from
  /// vertices. Of .001, .01 and .1 it gives areas closest to those of 28 CAD solids (`benchmark_brep`).
  static constexpr double weight_between = 1e-2;

  static Point longest_direction(const Point& up, const std::vector<Point>& points) {
    const Point x = up.unitOrthogonal(), y = up.cross(x);
    Point mean = Point::Zero();
    for (const Point& p : points) mean += p / double(points.size());
    Eigen::Matrix2d flat = Eigen::Matrix2d::Zero();
    for (const Point& p : points) {
      const Eigen::Vector2d q((p - mean).dot(x), (p - mean).dot(y));
      flat += q * q.transpose();
    }
    const double angle = std::atan2(2 * flat(0, 1), flat(0, 0) - flat(1, 1)) / 2;
    return std::cos(angle) * x + std::sin(angle) * y;
  }

  Point local(const Point& p) const { return axes_.transpose() * (p - origin_); }

  struct Basis {
    std::size_t i, j;  // of the first splines
    std::array<double, 4> u, v;
  };
  Basis basis(const Eigen::Vector2d& q, int derivative_u = 0, int derivative_v = 0) const {
    const Eigen::Vector2d inside = q.cwiseMax(rectangle_.min()).cwiseMin(rectangle_.max());
    return {u_.first(inside.x()), v_.first(inside.y()), u_.values(inside.x(), derivative_u),
            v_.values(inside.y(), derivative_v)};
  }

  double sum(const Basis& b) const {
    double result = 0;
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l < 4; ++l) result += b.u[k] * b.v[l] * coefficient(b.i + k, b.j + l);
    return result;
  }
  double height(const Eigen::Vector2d& q) const { return sum(basis(q)); }
  Eigen::Vector2d slope(const Eigen::Vector2d& q) const { return {sum(basis(q, 1, 0)), sum(basis(q, 0, 1))}; }

  double coefficient(std::size_t i, std::size_t j) const {
    return coefficients_[static_cast<Eigen::Index>(i * v_.number() + j)];
  }

  /// Least squares of the heights and of the bending.
  void solve(const std::vector<Point>& places, const std::vector<Point>& places_between, std::size_t spans_u,
             std::size_t spans_v) {
    u_ = {rectangle_.min().x(), rectangle_.max().x(), spans_u};
    v_ = {rectangle_.min().y(), rectangle_.max().y(), spans_v};
    const auto n = static_cast<Eigen::Index>(u_.number() * v_.number());
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    const auto add = [&](const Basis& b, double value, double weight) {
      for (std::size_t k = 0; k < 16; ++k) {
        const auto row = static_cast<Eigen::Index>((b.i + k / 4) * v_.number() + b.j + k % 4);
        const double factor = weight * b.u[k / 4] * b.v[k % 4];
        right[row] += factor * value;
        for (std::size_t l = 0; l < 16; ++l) {
          const auto column = static_cast<Eigen::Index>((b.i + l / 4) * v_.number() + b.j + l % 4);
          if (column <= row) normal(row, column) += factor * b.u[l / 4] * b.v[l % 4];
        }
      }
    };
    for (const Point& p : places) add(basis(p.head<2>()), p.z(), 1 / double(places.size()));
    for (const Point& p : places_between)
      add(basis(p.head<2>()), p.z(), weight_between / double(places_between.size()));
    const double length = rectangle_.diagonal().norm();
    const double weight = bending_weight * length * length * length * length / double(4 * spans_u * spans_v);
    for (std::size_t i = 0; i < 2 * spans_u; ++i)
      for (std::size_t j = 0; j < 2 * spans_v; ++j) {
        const Eigen::Vector2d q(u_.begin() + (double(i) + 0.5) / 2 * u_.step(),
                                v_.begin() + (double(j) + 0.5) / 2 * v_.step());
        add(basis(q, 2, 0), 0, weight);
        add(basis(q, 1, 1), 0, 2 * weight);
        add(basis(q, 0, 2), 0, weight);
      }
    coefficients_ = normal.selfadjointView<Eigen::Lower>().llt().solve(right);
  }

  void make_geometry() {
    const auto knots = [](const Uniform_cubic& splines, TColStd_Array1OfReal& values, TColStd_Array1OfInteger& times) {
      for (std::size_t i = 0; i <= splines.spans(); ++i) {
        values(static_cast<int>(i) + 1) = splines.knot(i);
        times(static_cast<int>(i) + 1) = i == 0 || i == splines.spans() ? 4 : 1;
      }
    };
    const int spans_u = static_cast<int>(u_.spans()), spans_v = static_cast<int>(v_.spans());
    TColStd_Array1OfReal knots_u(1, spans_u + 1), knots_v(1, spans_v + 1);
    TColStd_Array1OfInteger times_u(1, spans_u + 1), times_v(1, spans_v + 1);
    knots(u_, knots_u, times_u);
    knots(v_, knots_v, times_v);
    TColgp_Array2OfPnt poles(1, spans_u + 3, 1, spans_v + 3);
    for (std::size_t i = 0; i < u_.number(); ++i)
      for (std::size_t j = 0; j < v_.number(); ++j)
        poles(static_cast<int>(i) + 1, static_cast<int>(j) + 1) =
            kernel_point(origin_ + axes_ * Point(u_.place(i), v_.place(j), coefficient(i, j)));
    geometry_ = new Geom_BSplineSurface(poles, knots_u, knots_v, times_u, times_v, 3, 3);
  }

  Point origin_;
  Eigen::Matrix3d axes_;
  Eigen::AlignedBox2d rectangle_;
  Uniform_cubic u_{0, 1, 1}, v_{0, 1, 1};
  Eigen::VectorXd coefficients_;
  std::vector<Point> fitted_points_;
  double largest_distance_ = 0;
  Handle(Geom_Surface) geometry_;
};

}  // namespace RW_segmentation::internal::brep

#endif
