// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_FACE_ENERGY_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_FACE_ENERGY_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/Surface_types.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace RW_segmentation::internal {

/// The terms of a Potts model of noisy faces on surfaces, in nats.
///
/// What comments tell of other values of a number was measured on made solids with noise of .3 % of the diagonal:
/// `benchmark_engineering --noise .3 --noise-seeds 4`.
class Face_energy {
 public:
  using Index = Dual_mesh::Index;

  /// Of a face that is no neighbour of its region. At 4 and at 16, Rand error .037 in place of .033.
  static constexpr double whole_border = 8;
  /// Of a face on no surface; at 3, Rand error .034 in place of .033, at 12 the same.
  static constexpr double unexplained = 6;

  /// Keeps references to both.
  Face_energy(const Dual_mesh& mesh, const Surface_tolerance& tolerance) : mesh_(mesh), tolerance_(tolerance) {}

  /// How unlikely it is that noise puts a face where it is: half the sum of squared deviations.
  /// \param sign 1 if the surface's normals point out of the solid, -1 if into it
  double operator()(const Analytic_surface& surface, double sign, Index f) const {
    return with_type_of(surface, [&](const auto& s) { return of_face(s, sign, f); });
  }

  /// Appends the energies of faces.
  /// \param energies of the first ones
  void append(const Analytic_surface& surface, double sign, const std::vector<Index>& faces,
              std::vector<double>& energies) const {
    with_type_of(surface, [&](const auto& s) {
      while (energies.size() < faces.size()) energies.push_back(of_face(s, sign, faces[energies.size()]));
    });
  }

  /// The angle between a face and a surface of a type, 0 if the face has no normal.
  template <class Surface>
  double angle(const Surface& surface, double sign, Index f) const {
    const Eigen::Vector3d normal = mesh_.shape_normal(f);
    if (normal.isZero()) return 0;
    return std::acos(std::clamp(sign * surface.normal(mesh_.centroid(f)).dot(normal), -1., 1.));
  }

  /// Of an edge between two regions: the mean of what it is to both faces.
  double of_border(Index f, Index g, Index edge) const {
    const double length = mesh_.edge_length(edge);
    return length > 0 ? whole_border * length * (1 / perimeter(f) + 1 / perimeter(g)) / 2 : 0;
  }

  double perimeter(Index f) const {
    double length = 0;
    for (const auto& [g, e] : mesh_.graph().neighbours(f)) length += mesh_.edge_length(e);
    return length;
  }

 private:
  template <class Surface>
  double of_face(const Surface& surface, double sign, Index f) const {
    constexpr double most_squares = 30;  // an outlier is no worse than that
    constexpr double allowed_angle = 3;  // in deviations; at 4, Rand error .034 in place of .033
    // A corner tells about its other faces as well. At 2, Rand error .033 in place of .031; at 6, as many as a vertex has,
    // .029, but up to twice the segments on CAD solids.
    constexpr double shared_corners = 4;
    double distances = 0;
    for (const Index v : mesh_.corners(f)) {
      const double distance = surface.distance(mesh_.point(v)) / tolerance_.distance;
      distances += distance * distance;
    }
    const double turn = allowed_angle * angle(surface, sign, f) / tolerance_.normal_angle[f];
    return (std::min(distances, most_squares) / shared_corners + std::min(turn * turn, most_squares)) / 2;
  }

  const Dual_mesh& mesh_;
  const Surface_tolerance& tolerance_;
};

}  // namespace RW_segmentation::internal

#endif
