#ifndef RW_SEGMENTATION_ANALYTIC_SURFACE_H
#define RW_SEGMENTATION_ANALYTIC_SURFACE_H

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
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

/// The types that can be fitted, the simplest first.
constexpr std::array<Surface_type, 5> analytic_types = {
    Surface_type::plane, Surface_type::sphere, Surface_type::cylinder, Surface_type::cone, Surface_type::torus};

/// How many numbers determine a surface of that type; 0 for a free form.
constexpr int degrees_of_freedom(Surface_type type) {
  constexpr std::array<int, 6> numbers = {3, 4, 5, 6, 7, 0};
  return numbers[static_cast<std::size_t>(type)];
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
  double signed_distance(const Eigen::Vector3d& p) const {
    const bool is_cone = type == Surface_type::cone;
    return signed_distance(p, is_cone ? std::cos(half_angle) : 1, is_cone ? std::sin(half_angle) : 0);
  }

  /// As above, for many points of a cone whose angle's cosine and sine are known.
  double signed_distance(const Eigen::Vector3d& p, double cosine, double sine) const {
    const Eigen::Vector3d q = p - point;
    if (type == Surface_type::sphere) return q.norm() - radius;
    const double height = q.dot(direction);
    if (type == Surface_type::plane) return height;
    const double off_axis = (q - height * direction).norm();
    if (type == Surface_type::cylinder) return off_axis - radius;
    if (type == Surface_type::cone) return off_axis * cosine - height * sine;
    return Eigen::Vector2d(off_axis - radius, height).norm() - tube_radius;
  }

  /// The gradient of the distance: a unit vector, away from the axis or the centre.
  /// \pre the surface is no free form
  Eigen::Vector3d normal(const Eigen::Vector3d& p) const {
    if (type == Surface_type::plane) return direction;
    const Eigen::Vector3d q = p - point;
    if (type == Surface_type::sphere) return q.normalized();
    const double height = q.dot(direction);
    Eigen::Vector3d outward = (q - height * direction).normalized();
    if (type == Surface_type::cylinder) return outward;
    if (type == Surface_type::cone) return std::cos(half_angle) * outward - std::sin(half_angle) * direction;
    return (q - radius * outward).normalized();
  }
};

/// What a surface is fitted to: points on it, and unit normals at further points close to it.
struct Surface_samples {
  std::vector<Eigen::Vector3d> points;         ///< on the surface
  std::vector<Eigen::Vector3d> normal_points;  ///< where normals are known
  std::vector<Eigen::Vector3d> normals;        ///< at these points

  /// Removes all samples.
  void clear() {
    points.clear();
    normal_points.clear();
    normals.clear();
  }
};

namespace internal {

/// The sum of the squared distances of points from a surface.
inline double squared_distances(const Analytic_surface& surface, const std::vector<Eigen::Vector3d>& points) {
  const double cosine = std::cos(surface.half_angle), sine = std::sin(surface.half_angle);
  double sum = 0;
  for (const Eigen::Vector3d& p : points) {
    const double d = surface.signed_distance(p, cosine, sine);
    sum += d * d;
  }
  return sum;
}

}  // namespace internal

/// The root mean square distance of points from a surface.
inline double root_mean_square_distance(const Analytic_surface& surface, const std::vector<Eigen::Vector3d>& points) {
  return points.empty() ? 0
                        : std::sqrt(internal::squared_distances(surface, points) / static_cast<double>(points.size()));
}

namespace internal {

/// Moves the numbers of a surface until the distances of points from it have the least squares: damped Gauss-Newton
/// steps (Levenberg-Marquardt) over the least number of parameters.
class Least_squares_surface {
 public:
  static constexpr int most_steps = 20;

  /// \param largest_residual that is of use; what promises none near it is left where it is
  Least_squares_surface(const Analytic_surface& surface, const std::vector<Eigen::Vector3d>& points,
                        double largest_residual = std::numeric_limits<double>::infinity())
      : surface_(surface),
        points_(points),
        hopeless_squares_(100 * largest_residual * largest_residual * static_cast<double>(points.size())) {}

  Analytic_surface fit(int steps = most_steps) {
    if (surface_.type == Surface_type::plane) return surface_;  // the eigenvector is the least already
    double sum = squares(surface_);
    // Below a ten-billionth of the mesh nothing is left to gain.
    const double exact = 1e-20 * static_cast<double>(points_.size());
    for (int step = 0; step < steps && sum > exact; ++step) {
      linearise();
      const double before = sum;
      if (!descend(sum) || before - sum < 1e-3 * before) break;
    }
    surface_.residual = std::sqrt(sum / static_cast<double>(points_.size()));
    return surface_;
  }

 private:
  // Up to 7 unknowns, on the stack: the shift, the turn of the axis, the radii or the angle.
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 7, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 7, 7>;

  double squares(const Analytic_surface& surface) const { return squared_distances(surface, points_); }

  /// The normal equations at the present surface.
  void linearise() {
    const int n = degrees_of_freedom(surface_.type);
    first_ = surface_.direction.unitOrthogonal();
    second_ = surface_.direction.cross(first_);
    hessian_.setZero(n, n);
    gradient_.setZero(n);
    Vector row(n);
    cosine_ = std::cos(surface_.half_angle);
    sine_ = std::sin(surface_.half_angle);
    for (const Eigen::Vector3d& p : points_) {
      const double distance = derivatives(p, row);
      for (int j = 0; j < n; ++j)
        for (int i = j; i < n; ++i) hessian_(i, j) += row[i] * row[j];
      gradient_ += distance * row;
    }
  }

  /// The distance of a point, and its derivatives.
  double derivatives(const Eigen::Vector3d& p, Vector& row) const {
    const Eigen::Vector3d q = p - surface_.point;
    if (surface_.type == Surface_type::sphere) {
      const double length = q.norm();
      row << -q / std::max(length, tiny), -1;
      return length - surface_.radius;
    }
    const double h = q.dot(surface_.direction);
    const Eigen::Vector3d across = q - h * surface_.direction;
    const double s = across.norm();
    const double x = across.dot(first_) / std::max(s, tiny), y = across.dot(second_) / std::max(s, tiny);
    if (surface_.type == Surface_type::cylinder) {
      row << -x, -y, -h * x, -h * y, -1;
      return s - surface_.radius;
    }
    if (surface_.type == Surface_type::cone) {
      const double c = cosine_, d = sine_, along = h * c + s * d;
      row << -c * x, -c * y, d, -along * x, -along * y, -s * d - h * c;
      return s * c - h * d;
    }
    const double from_centre = Eigen::Vector2d(s - surface_.radius, h).norm();
    const double c = (s - surface_.radius) / std::max(from_centre, tiny), d = h / std::max(from_centre, tiny);
    const double turn = s * d - h * c;
    row << -c * x, -c * y, -d, turn * x, turn * y, -c, -1;
    return from_centre - surface_.tube_radius;
  }

  /// Takes the step with the least damping that lessens the squares. False if there is none, or the linearised distances
  /// hardly lessen and stay too large.
  bool descend(double& sum) {
    const double largest = hessian_.diagonal().maxCoeff();
    for (int trial = 0; trial < 4; ++trial, damping_ *= 10) {
      Matrix damped = hessian_;
      damped.diagonal() *= 1 + damping_;
      damped.diagonal().array() += 1e-12 * largest;
      const Vector step = damped.selfadjointView<Eigen::Lower>().ldlt().solve(-gradient_);
      if (const double linear = squares_after(step, sum); linear > hopeless_squares_ && linear > 0.8 * sum)
        return false;
      const Analytic_surface moved = surface_after(step);
      const double squares_there = squares(moved);
      if (squares_there < sum) {
        surface_ = moved;
        sum = squares_there;
        damping_ /= 10;
        return true;
      }
    }
    return false;
  }

  /// The squares that the linearised distances have after a step.
  double squares_after(const Vector& step, double sum) const {
    const Vector change = hessian_.selfadjointView<Eigen::Lower>() * step;
    return sum + step.dot(2 * gradient_ + change);
  }

  Analytic_surface surface_after(const Vector& step) const {
    Analytic_surface moved = surface_;
    if (surface_.type == Surface_type::sphere) {
      moved.point += step.head<3>();
      moved.radius += step[3];
      return moved;
    }
    moved.point += step[0] * first_ + step[1] * second_;
    int k = 2;
    if (surface_.type != Surface_type::cylinder) moved.point += step[k++] * surface_.direction;
    moved.direction = (surface_.direction + step[k] * first_ + step[k + 1] * second_).normalized();
    (surface_.type == Surface_type::cone ? moved.half_angle : moved.radius) += step[k + 2];
    if (surface_.type == Surface_type::torus) moved.tube_radius += step[k + 3];
    return moved;
  }

  static constexpr double tiny = std::numeric_limits<double>::min();

  Analytic_surface surface_;
  const std::vector<Eigen::Vector3d>& points_;
  const double hopeless_squares_;
  Eigen::Vector3d first_, second_;  // orthogonal to the axis
  double cosine_ = 1, sine_ = 0;    // of the cone's angle
  Matrix hessian_;                  // its lower half
  Vector gradient_;
  double damping_ = 1e-4;
};

/// Fits surfaces of each type. Positions are relative to the mean of the points, and lengths to their spread, while the
/// first approximation is sought.
class Surface_fit {
 public:
  /// \param largest_residual that is of use; surfaces farther off may be given up early
  explicit Surface_fit(const Surface_samples& samples,
                       double largest_residual = std::numeric_limits<double>::infinity())
      : samples_(samples), largest_residual_(largest_residual) {
    for (const Eigen::Vector3d& p : samples.points) mean_ += p;
    mean_ /= static_cast<double>(samples.points.size());
    for (const Eigen::Vector3d& p : samples.points) covariance_ += (p - mean_) * (p - mean_).transpose();
    spread_ = std::sqrt(covariance_.trace() / static_cast<double>(samples.points.size()));
  }

  /// The surface of a type; nothing if its residual is too large.
  std::optional<Analytic_surface> fit(Surface_type type) const {
    const auto surface = closest(type);
    return surface && surface->residual <= largest_residual_ ? surface : std::nullopt;
  }

 private:
  std::optional<Analytic_surface> closest(Surface_type type) const {
    const auto needed = static_cast<std::size_t>(degrees_of_freedom(type));
    if (samples_.points.size() < needed || samples_.normals.empty() || !(spread_ > 0)) return {};
    switch (type) {
      case Surface_type::plane:
        return plane();
      case Surface_type::sphere:
        return refined(sphere());
      case Surface_type::cylinder:
        return refined(cylinder());
      case Surface_type::cone:
        return refined(cone());
      case Surface_type::torus:
        return torus();
      case Surface_type::free_form:
        break;
    }
    return {};
  }

  using Approximation = std::optional<Analytic_surface>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  // A surface whose radius is that many times the spread of the points cannot be told from a simpler one.
  static constexpr double largest_ratio = 50;
  static constexpr double smallest_half_angle = 0.02, largest_half_angle = 1.55;

  Eigen::Vector3d scaled(const Eigen::Vector3d& p) const { return (p - mean_) / spread_; }

  Approximation plane() const {
    Analytic_surface plane;
    plane.type = Surface_type::plane;
    plane.point = mean_;
    plane.direction = eigenvector_of_least(covariance_ / covariance_.trace());
    plane.residual = root_mean_square_distance(plane, samples_.points);
    return plane;
  }

  static Eigen::Vector3d eigenvector_of_least(const Eigen::Matrix3d& m) {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvectors().col(0);
  }

  /// The circle or sphere |p - c|^2 = r^2 that is linear in c and r^2 - |c|^2; returns the centre and the radius.
  template <int Dimension, class Coordinates>
  std::optional<Eigen::Matrix<double, Dimension + 1, 1>> algebraic_sphere(const Coordinates& coordinates) const {
    using Vector = Eigen::Matrix<double, Dimension + 1, 1>;
    Eigen::Matrix<double, Dimension + 1, Dimension + 1> matrix;
    matrix.setZero();
    Vector right = Vector::Zero();
    for (const Eigen::Vector3d& p : samples_.points) {
      const Eigen::Matrix<double, Dimension, 1> x = coordinates(p);
      Vector row;
      row << 2 * x, 1;
      matrix += row * row.transpose();
      right += row * x.squaredNorm();
    }
    matrix.diagonal().array() += 1e-12;
    Vector solution = matrix.ldlt().solve(right);
    const double square = solution[Dimension] + solution.template head<Dimension>().squaredNorm();
    if (!(square > 0) || square > 4 * largest_ratio * largest_ratio) return {};
    solution[Dimension] = std::sqrt(square);
    return solution;
  }

  Approximation sphere() const {
    const auto solution = algebraic_sphere<3>([&](const Eigen::Vector3d& p) { return scaled(p); });
    if (!solution) return {};
    Analytic_surface sphere;
    sphere.type = Surface_type::sphere;
    sphere.point = mean_ + spread_ * solution->head<3>();
    sphere.radius = spread_ * (*solution)[3];
    return sphere;
  }

  /// The axis is what all normals are orthogonal to.
  Approximation cylinder() const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& n : samples_.normals) sum += n * n.transpose();
    Analytic_surface cylinder;
    cylinder.type = Surface_type::cylinder;
    cylinder.direction = eigenvector_of_least(sum);
    const Eigen::Vector3d u = cylinder.direction.unitOrthogonal(), v = cylinder.direction.cross(u);
    const auto solution = algebraic_sphere<2>(
        [&](const Eigen::Vector3d& p) { return Eigen::Vector2d(scaled(p).dot(u), scaled(p).dot(v)); });
    if (!solution) return {};
    cylinder.point = mean_ + spread_ * ((*solution)[0] * u + (*solution)[1] * v);
    cylinder.radius = spread_ * (*solution)[2];
    return cylinder;
  }

  /// All normals make one angle with the axis, and all tangent planes meet in the apex.
  Approximation cone() const {
    const auto count = static_cast<double>(samples_.normals.size());
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    Eigen::Vector3d mean_normal = Eigen::Vector3d::Zero(), right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < samples_.normals.size(); ++i) {
      const Eigen::Vector3d& n = samples_.normals[i];
      sum += n * n.transpose();
      right += n * n.dot(scaled(samples_.normal_points[i]));
      mean_normal += n / count;
    }
    Analytic_surface cone;
    cone.type = Surface_type::cone;
    cone.direction = eigenvector_of_least(sum / count - mean_normal * mean_normal.transpose());
    const Eigen::Vector3d apex = (sum + 1e-9 * Eigen::Matrix3d::Identity()).ldlt().solve(right);
    if (!(apex.norm() < 2 * largest_ratio)) return {};
    cone.point = mean_ + spread_ * apex;
    if ((mean_ - cone.point).dot(cone.direction) < 0) cone.direction = -cone.direction;
    for (const Eigen::Vector3d& p : samples_.points) {
      const Eigen::Vector3d q = p - cone.point;
      const double height = q.dot(cone.direction);
      cone.half_angle += std::atan2((q - height * cone.direction).norm(), height);
    }
    cone.half_angle /= static_cast<double>(samples_.points.size());
    return cone;
  }

  /// All normals of a surface of revolution meet its axis: their Pluecker coordinates lie in the linear complex of the
  /// axis (Pottmann and Randrup 1998). The meridian is a circle then.
  Approximation torus() const {
    Matrix6 sum = Matrix6::Zero();
    for (std::size_t i = 0; i < samples_.normals.size(); ++i) {
      Vector6 line;
      line << scaled(samples_.normal_points[i]).cross(samples_.normals[i]), samples_.normals[i];
      sum += line * line.transpose();
    }
    const Matrix6 complexes = Eigen::SelfAdjointEigenSolver<Matrix6>(sum).eigenvectors();
    Approximation best;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector3d axis = complexes.col(k).head<3>(), moment = complexes.col(k).tail<3>();
      if (axis.norm() < 1e-2) continue;
      const Approximation torus = refined(torus_about(axis.normalized(), axis.cross(moment) / axis.squaredNorm()));
      if (torus && (!best || torus->residual < best->residual)) best = torus;
    }
    return best;
  }

  Approximation torus_about(const Eigen::Vector3d& axis, const Eigen::Vector3d& foot) const {
    if (foot.norm() > largest_ratio) return {};
    const auto circle = algebraic_sphere<2>([&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d q = scaled(p) - foot;
      const double height = q.dot(axis);
      return Eigen::Vector2d((q - height * axis).norm(), height);
    });
    if (!circle) return {};
    Analytic_surface torus;
    torus.type = Surface_type::torus;
    torus.direction = axis;
    torus.radius = spread_ * (*circle)[0];
    torus.tube_radius = spread_ * (*circle)[2];
    torus.point = mean_ + spread_ * (foot + (*circle)[1] * axis);
    return torus;
  }

  Approximation refined(const Approximation& approximation) const {
    if (!approximation) return {};
    Analytic_surface surface = Least_squares_surface(*approximation, samples_.points, largest_residual_).fit();
    return is_sound(surface) ? Approximation(surface) : std::nullopt;
  }

  bool is_sound(const Analytic_surface& surface) const {
    const double largest = largest_ratio * spread_;
    switch (surface.type) {
      case Surface_type::sphere:
      case Surface_type::cylinder:
        return surface.radius > 0 && surface.radius < largest;
      case Surface_type::torus:
        return surface.tube_radius > 0 && surface.tube_radius < largest && surface.radius < largest &&
               surface.radius > 0.05 * surface.tube_radius;
      case Surface_type::cone:
        return surface.half_angle > smallest_half_angle && surface.half_angle < largest_half_angle &&
               std::all_of(samples_.points.begin(), samples_.points.end(), [&](const Eigen::Vector3d& p) {
                 return (p - surface.point).dot(surface.direction) > -1e-3 * spread_;  // one nappe
               });
      default:
        return true;
    }
  }

  const Surface_samples& samples_;
  const double largest_residual_;
  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();  // times the number of points
  double spread_ = 0;                                     // root mean square distance from the mean
};

/// How far normals are off those of a surface, squared and summed, in units of 0.1: what facets are off it at most.
inline double squared_turns(const Analytic_surface& surface, const Surface_samples& samples) {
  constexpr double unit = 0.1;
  double same = 0, opposite = 0;
  for (std::size_t i = 0; i < samples.normals.size(); ++i) {
    const Eigen::Vector3d n = surface.normal(samples.normal_points[i]);
    same += (samples.normals[i] - n).squaredNorm();
    opposite += (samples.normals[i] + n).squaredNorm();
  }
  return std::min(same, opposite) / (unit * unit);
}

}  // namespace internal

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
inline std::optional<Analytic_surface> fit_analytic_surface(
    Surface_type type, const Surface_samples& samples,
    double largest_residual = std::numeric_limits<double>::infinity()) {
  return internal::Surface_fit(samples, largest_residual).fit(type);
}

/// The surface that explains points best: the number of degrees of freedom counts against closeness, each as much as
/// log(n) squared deviations by the tolerance (the Bayesian information criterion of n points with Gaussian errors).
/// Normals count, too: vertices on two circles lie on a cylinder, a cone and a sphere.
///
/// \param samples see above
/// \param tolerance the root mean square distance that points on a surface are expected to have; in units of the points
/// \returns a free form if no surface lies within twice the tolerance, in the root mean square, of the points
inline Analytic_surface fit_analytic_surface(const Surface_samples& samples, double tolerance) {
  const internal::Surface_fit fit(samples, 2 * tolerance);
  const auto n = static_cast<double>(samples.points.size());
  Analytic_surface best;
  double least = std::numeric_limits<double>::infinity();
  for (const Surface_type type : analytic_types) {
    const double penalty = degrees_of_freedom(type) * std::log(std::max(n, 2.));
    if (penalty >= least) break;
    const auto surface = fit.fit(type);
    if (!surface) continue;
    const double ratio = surface->residual / tolerance;
    const double criterion = n * ratio * ratio + internal::squared_turns(*surface, samples) + penalty;
    if (criterion < least) {
      least = criterion;
      best = *surface;
    }
  }
  return best;
}

}  // namespace RW_segmentation

#endif
