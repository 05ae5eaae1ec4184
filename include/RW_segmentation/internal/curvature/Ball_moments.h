// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_CURVATURE_BALL_MOMENTS_H
#define RW_SEGMENTATION_INTERNAL_CURVATURE_BALL_MOMENTS_H

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace RW_segmentation::internal {

/// A sum of signed solid angles of triangles seen from the origin, positive where the corners are counterclockwise seen
/// from beyond; known up to multiples of 4 pi.
///
/// The tangent of half the solid angle of x, y, z is det(x, y, z) / (|x||y||z| + x.y |z| + y.z |x| + z.x |y|) (van Oosterom
/// and Strackee 1983). Numerator and denominator are those of a complex number, and a product needs one arctangent.
class Solid_angles {
 public:
  void add(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& z) {
    const double a = x.norm(), b = y.norm(), c = z.norm();
    const double im = x.dot(y.cross(z)), re = a * b * c + x.dot(y) * c + y.dot(z) * a + z.dot(x) * b;
    const double product_re = re_ * re - im_ * im, product_im = re_ * im + im_ * re;
    const double size = std::abs(product_re) + std::abs(product_im);
    if (!(size > 0)) return;  // seen from one of its corners
    const bool keep = size > 1e-100 && size < 1e100;
    re_ = keep ? product_re : product_re / size;
    im_ = keep ? product_im : product_im / size;
  }
  double sum() const { return 2 * std::atan2(im_, re_); }

 private:
  double re_ = 1, im_ = 0;
};

inline Eigen::Matrix3d symmetric_product(const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  const Eigen::Matrix3d product = x * y.transpose();
  return product + product.transpose();
}

/// Volume, first and second moments, about the centre, of what a solid and the unit ball round a point of its surface
/// have in common: in closed form, from the triangles of the surface.
///
/// The centre is the origin 0, B the ball, D the solid, S the part of the unit sphere inside D. A function f that is
/// homogeneous of degree k has div(f x) = (k + 3) f, so by Gauss, with the outward unit normal n of each triangle T and
/// d = n.x on it,
///
///   (k + 3) Int_{B n D} f = sum_T d Int_{T n B} f + Int_S f        for f = 1, x, x x'.
///
/// The first part are cones over T n B with their tips in 0: tetrahedra where T lies in the ball, and cones over sectors
/// of the disc in which the plane of T cuts B. The second part is again a boundary integral, along the arcs in which
/// the planes of the triangles cut the sphere: with w = d n + rho c(t) on an arc, c' = n x c and rho^2 + d^2 = 1,
///
///   |S|               = angle of D in 0 - sum_T solid angle of T n B
///   Int_S w           = -1/2 sum_arcs (n dt - d W),          W  = Int w dt
///   Int_S (w w' - I/3) = -1/6 sum_arcs (n W' + W n' - 2 d WW), WW = Int w w' dt.
class Ball_moments {
 public:
  static constexpr double pi = 3.14159265358979323846;

  /// \param angle the solid angle of D at the centre: 2 pi in the inside of a plane face
  explicit Ball_moments(double angle) : area_(angle) {}

  /// Adds a triangle that lies in the ball.
  void add_inner_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    add_tetrahedron(a, b, c);
    solid_angles_.add(a, b, c);
  }

  /// Adds the part in the ball of a triangle with the outward unit normal n, d = n.x on it. Returns for each of the sides
  /// ab, bc, ca whether it meets the ball. A triangle without area has n = 0 and d = 0, and adds nothing.
  std::array<bool, 3> add_cut_triangle(const std::array<Eigen::Vector3d, 3>& corner, const Eigen::Vector3d& n,
                                       double d);

  /// Where the surface ends in the side from a to b of a triangle: continues it, from the part of the side in the ball,
  /// straight along the rays from the centre. Cones with their tips in 0 have d = 0: only their arcs count.
  /// \pre the side meets the ball
  void add_border(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

  double volume() const { return cone_volume_ + area_on_sphere() / 3; }
  Eigen::Vector3d first() const { return cone_first_ + sphere_first_ / 4; }
  Eigen::Matrix3d second() const {
    return cone_second_ + (sphere_second_ + Eigen::Matrix3d::Identity() * (area_on_sphere() / 3)) / 5;
  }

  /// The area of the unit sphere inside the solid. Where the surface cuts itself round the centre, as noise makes it
  /// do, the solid may lie there twice or less than not at all: known but for whole spheres, it is what is right.
  double area_on_sphere() const {
    constexpr double none = 1e-9;
    const double area = area_ - solid_angles_.sum();
    return area - 4 * pi * std::floor((area + none) / (4 * pi));
  }

 private:
  /// The part of the line from a to b in the ball, as a + t (b - a) for t from `enter` to `leave`.
  struct Chord {
    double enter, leave;
    bool empty() const { return !(enter < leave); }
  };
  static bool inside(const Eigen::Vector3d& x) { return x.squaredNorm() <= 1; }
  static Chord chord(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

  /// Whether a triangle holds a point q of its plane.
  static bool holds(const std::array<Eigen::Vector3d, 3>& corner, const Eigen::Vector3d& n, const Eigen::Vector3d& q);

  void add_tetrahedron(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const double six_volumes = a.dot(b.cross(c));
    const Eigen::Vector3d s = a + b + c;
    cone_volume_ += six_volumes / 6;
    cone_first_ += six_volumes / 24 * s;
    cone_second_ += six_volumes / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }

  /// Sectors of one disc: integrals over their angles, of 1, c and c c'.
  struct Sectors {
    Eigen::Vector3d n;
    double angle = 0;
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();   // sum of c1 - c0
    Eigen::Matrix3d twist = Eigen::Matrix3d::Zero();  // sum of c1 (n x c1)' - c0 (n x c0)'

    /// Counterclockwise from the unit vector c0 to c1. A turn back by a rounding error is none.
    void add(const Eigen::Vector3d& c0, const Eigen::Vector3d& c1) {
      constexpr double rounding = 1e-9;
      const double step = std::atan2(n.dot(c0.cross(c1)), c0.dot(c1));
      angle += step < -rounding ? step + 2 * pi : step;
      turn += c1 - c0;
      twist += c1 * n.cross(c1).transpose() - c0 * n.cross(c0).transpose();
    }
    Eigen::Vector3d first() const { return turn.cross(n); }  // c = -n x c'
    Eigen::Matrix3d second() const {                         // (c c'')' = I - n n' - 2 c c', the prime in t
      return (angle * (Eigen::Matrix3d::Identity() - n * n.transpose()) - twist) / 2;
    }
  };

  /// The cones over sectors of the disc about d n with radius rho, their solid angle, and the arcs of the sectors.
  void add_sectors(const Sectors& sectors, double d, double rho) {
    const Eigen::Vector3d& n = sectors.n;
    const Eigen::Vector3d c = sectors.first();
    const Eigen::Matrix3d cc = sectors.second(), nc = symmetric_product(n, c), nn = n * n.transpose();
    const double angle = sectors.angle, d2 = d * d, rho2 = rho * rho, rho3 = rho2 * rho, area = rho2 / 2 * angle;
    cone_volume_ += d * area / 3;
    cone_first_ += d * (rho3 / 3 * c + d * area * n) / 4;
    cone_second_ += d * (rho2 * rho2 / 4 * cc + d * rho3 / 3 * nc + d2 * area * nn) / 5;
    if (d != 0) area_ -= std::copysign(1 - std::abs(d), d) * angle;

    // With W = d angle n + rho c, WW = d^2 angle n n' + d rho (n c' + c n') + rho^2 c c'.
    sphere_first_ -= (rho2 * angle * n - d * rho * c) / 2;
    sphere_second_ -= (2 * d * rho2 * angle * nn + (1 - 2 * d2) * rho * nc - 2 * d * rho2 * cc) / 6;
  }

  double cone_volume_ = 0;
  Eigen::Vector3d cone_first_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d cone_second_ = Eigen::Matrix3d::Zero();
  double area_;  // on the sphere, but for the solid angles
  Solid_angles solid_angles_;
  Eigen::Vector3d sphere_first_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d sphere_second_ = Eigen::Matrix3d::Zero();  // without its trace
};

inline Ball_moments::Chord Ball_moments::chord(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  // Whether an end lies in the ball is asked in the same way for all sides that meet there.
  constexpr double touches = 1e-12;
  const bool from_inside = inside(a), to_inside = inside(b);
  if (from_inside && to_inside) return {0, 1};
  const Eigen::Vector3d e = b - a;
  const double ee = e.squaredNorm();
  if (ee == 0) return {1, 0};
  const double middle = -a.dot(e) / ee, within = 1 - (a + middle * e).squaredNorm();
  const double half = std::sqrt(std::max(within, 0.) / ee);
  if (from_inside) return {0, std::clamp(middle + half, 0., 1.)};
  if (to_inside) return {std::clamp(middle - half, 0., 1.), 1};
  if (!(within > touches && middle > 0 && middle < 1)) return {1, 0};
  return {std::max(middle - half, 0.), std::min(middle + half, 1.)};
}

inline std::array<bool, 3> Ball_moments::add_cut_triangle(const std::array<Eigen::Vector3d, 3>& corner,
                                                          const Eigen::Vector3d& n, double d) {
  std::array<bool, 3> meets{};
  if (!(std::abs(d) < 1)) return meets;
  const Eigen::Vector3d q = d * n;  // the centre of the disc in which the plane cuts the ball
  const double rho = std::sqrt((1 - d) * (1 + d));

  // Round the triangle: triangles between q and the sides in the ball, and sectors between a point where the outline
  // leaves the ball and the next one where it enters.
  std::array<Eigen::Vector3d, 3> entry, exit;
  std::size_t entries = 0, exits = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d &a = corner[k], &b = corner[(k + 1) % 3];
    const Chord in_ball = chord(a, b);
    meets[k] = inside(a) || inside(b) || !in_ball.empty();
    if (!meets[k]) continue;
    const Eigen::Vector3d x = a + in_ball.enter * (b - a), y = a + in_ball.leave * (b - a);
    if (!inside(a)) entry[entries++] = (x - q) / rho;
    if (!inside(b)) exit[exits++] = (y - q) / rho;
    if (d != 0) add_inner_triangle(q, x, y);
  }
  Sectors sectors{n};
  const std::size_t shift = inside(corner[0]) ? 0 : 1;
  for (std::size_t k = 0; k < exits; ++k) sectors.add(exit[k], entry[(k + shift) % entries]);
  if (exits == 0 && holds(corner, n, q)) sectors.angle = 2 * pi;
  add_sectors(sectors, d, rho);
  return meets;
}

inline bool Ball_moments::holds(const std::array<Eigen::Vector3d, 3>& corner, const Eigen::Vector3d& n,
                                const Eigen::Vector3d& q) {
  for (std::size_t k = 0; k < 3; ++k)
    if (!(n.dot((corner[k] - q).cross(corner[(k + 1) % 3] - q)) > 0)) return false;
  return true;
}

inline void Ball_moments::add_border(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d normal = a.cross(b);
  if (normal.isZero(0)) return;
  const Chord in_ball = chord(a, b);
  Sectors sectors{normal.normalized()};
  sectors.add((a + in_ball.enter * (b - a)).normalized(), (a + in_ball.leave * (b - a)).normalized());
  add_sectors(sectors, 0, 1);
}

}  // namespace RW_segmentation::internal

#endif
