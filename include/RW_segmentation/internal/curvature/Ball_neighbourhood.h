// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_CURVATURE_BALL_NEIGHBOURHOOD_H
#define RW_SEGMENTATION_INTERNAL_CURVATURE_BALL_NEIGHBOURHOOD_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/curvature/Ball_moments.h>
#include <RW_segmentation/internal/curvature/Triangulated_faces.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RW_segmentation::internal {

/// Gathers the surface round the centre of a face in a ball: the piece of the surface inside the ball that hangs
/// together with the face, found breadth first over the sides of triangles that meet the ball.
///
/// Other pieces in the ball, such as the opposite side of a thin sheet, are left out. As the piece ends on the sphere,
/// it divides the ball all the same. Holds working space for one thread.
class Ball_neighbourhood {
 public:
  using Index = Dual_mesh::Index;

  /// Keeps references.
  Ball_neighbourhood(const Triangulated_faces& surface, const Dual_mesh& mesh)
      : surface_(surface), mesh_(mesh), visited_(surface.number_of_triangles(), 0) {}

  /// The moments of the ball round the centroid of `face`, which has an area. Unit of length: `radius`.
  Ball_moments moments(Index face, double radius);

  // How the surface lies in the last ball.
  bool meets_border() const { return meets_border_; }        ///< the mesh ends inside the ball
  bool leaves_ball() const { return leaves_ball_; }          ///< else all of the component lies in the ball
  bool leaves_face() const { return queue_.size() > own_; }  ///< else the ball sees nothing but the face

 private:
  void visit(Index triangle) {
    if (visited_[triangle] == ball_) return;
    visited_[triangle] = ball_;
    queue_.push_back(triangle);
  }
  void start(Index face);
  /// The solid angle of the solid in the centre of a face.
  double angle_at_centre(Index face) const;

  const Triangulated_faces& surface_;
  const Dual_mesh& mesh_;
  std::vector<std::uint32_t> visited_;  // the last ball that each triangle was in
  std::uint32_t ball_ = 0;
  std::vector<Index> queue_;
  std::size_t own_ = 0;  // triangles of the face itself, first in the queue
  bool meets_border_ = false, leaves_ball_ = false;
};

inline void Ball_neighbourhood::start(Index face) {
  if (++ball_ == 0) {  // after 2^32 balls the numbers begin anew
    visited_.assign(visited_.size(), 0);
    ball_ = 1;
  }
  queue_.clear();
  for (Index i = surface_.first(face); i < surface_.first(face + 1); ++i) visit(i);
  own_ = queue_.size();
  meets_border_ = leaves_ball_ = false;
}

inline double Ball_neighbourhood::angle_at_centre(Index face) const {
  if (own_ == 1) return 2 * Ball_moments::pi;
  // The triangles of a face that is not plane meet in its centre like the sides of a pyramid.
  const Eigen::Vector3d inward = -mesh_.normal(face);
  Solid_angles angles;
  for (const Index i : queue_) {
    const auto& [centre, b, c] = surface_.triangle(i).corner;
    angles.add(inward, c - centre, b - centre);
  }
  return angles.sum();
}

inline Ball_moments Ball_neighbourhood::moments(Index face, double radius) {
  constexpr double through_centre = 1e-14;  // planes this close to the centre are seen from the side
  const Eigen::Vector3d centre = mesh_.centroid(face);
  const double scale = 1 / radius;
  start(face);
  Ball_moments moments(angle_at_centre(face));
  for (std::size_t next = 0; next < queue_.size(); ++next) {
    const Triangulated_faces::Triangle& triangle = surface_.triangle(queue_[next]);
    std::array<Eigen::Vector3d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = (triangle.corner[k] - centre) * scale;
    const double reach = std::max({corner[0].squaredNorm(), corner[1].squaredNorm(), corner[2].squaredNorm()});

    std::array<bool, 3> meets = {true, true, true};
    const bool own = next < own_;
    if (reach <= 1) {
      if (!own) moments.add_inner_triangle(corner[0], corner[1], corner[2]);
    } else {
      leaves_ball_ = true;
      const double height = own ? 0 : triangle.normal.dot(corner[0]);
      meets = moments.add_cut_triangle(corner, triangle.normal, std::abs(height) < through_centre ? 0 : height);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (!meets[k]) continue;
      if (triangle.neighbour[k] != Triangulated_faces::none) {
        visit(triangle.neighbour[k]);
      } else {
        meets_border_ = true;
        moments.add_border(corner[k], corner[(k + 1) % 3]);
      }
    }
  }
  return moments;
}

}  // namespace RW_segmentation::internal

#endif
