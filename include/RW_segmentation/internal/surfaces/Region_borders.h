// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_REGION_BORDERS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_REGION_BORDERS_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/surfaces/Analytic_regions.h>
#include <RW_segmentation/internal/surfaces/Face_patches.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/Surface_types.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// Moves faces at the borders of regions to the neighbour whose surface they fit best, and lets faces of the remainder
/// join a region that they fit. Under noise a face alone cannot tell: short borders count, too, and surfaces are fitted
/// again to what they have become.
class Region_borders {
 public:
  using Index = Dual_mesh::Index;

  /// Keeps references to all.
  Region_borders(const Dual_mesh& mesh, const Surface_tolerance& tolerance, Analytic_regions& regions)
      : mesh_(mesh), tolerance_(tolerance), regions_(regions) {}

  /// Reports that all is done, again and again, so that it can be cancelled.
  void settle(const Progress& progress) {
    progress_ = progress;
    if (tolerance_.is_noisy())
      settle_noisy();
    else
      settle_exact();
  }

 private:
  static constexpr std::size_t none = Analytic_regions::none;

  void settle_exact() {
    constexpr int most_sweeps = 4;
    constexpr double unexplained = 2;  // all of the distance and all of the angle that are allowed
    const std::vector<double> sign = signs();
    move_faces(most_sweeps, [&](Index f, std::size_t region) {
      return region == none ? unexplained : misfit(region, sign[region], f);
    });
  }

  void settle_noisy() {
    constexpr int most_rounds = 4, most_sweeps = 6;
    constexpr double unexplained = 3;  // nats, as `energy()`
    for (int round = 0; round < most_rounds; ++round) {
      fit_again();
      const std::vector<double> sign = signs();
      const bool has_moved = move_faces(most_sweeps, [&](Index f, std::size_t region) {
        return border_energy(region, f) + (region == none ? unexplained : energy(region, sign[region], f));
      });
      if (!has_moved) break;
    }
  }

  /// Moves each face to the region of a neighbour where it costs least, again and again.
  /// \param cost of a face, in a region or none
  template <class Cost>
  bool move_faces(int most_sweeps, const Cost& cost) {
    constexpr Index between_reports = 10000;  // faces, some milliseconds
    constexpr double least_gain = 1e-3;       // of a move, lest rounding errors move faces to and fro
    constexpr double unknown_cost = std::numeric_limits<double>::infinity();
    std::vector<std::size_t>& region_of_face = regions_.region_of_face;
    bool has_moved = false;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      bool moves = false;
      for (Index f = 0; f < mesh_.number_of_faces(); ++f) {
        if (f % between_reports == 0) progress_(1);
        const std::size_t own = region_of_face[f];
        std::size_t best = own;
        double least = unknown_cost;  // within a region nothing is to be compared
        for (const auto& [g, e] : mesh_.graph().neighbours(f)) {
          const std::size_t other = region_of_face[g];
          if (other == none || other == own || other == best || mesh_.is_wall(e)) continue;
          if (least == unknown_cost) least = cost(f, own);
          const double d = cost(f, other);
          if (d < least - least_gain) {
            least = d;
            best = other;
          }
        }
        moves |= best != own;
        region_of_face[f] = best;
      }
      if (!moves) break;
      has_moved = true;
    }
    return has_moved;
  }

  /// Fits each surface to its region.
  void fit_again() {
    constexpr std::size_t fewest_vertices = 12;
    std::vector<std::vector<Index>> faces(regions_.surfaces.size());
    for (Index f = 0; f < mesh_.number_of_faces(); ++f)
      if (regions_.region_of_face[f] != none) faces[regions_.region_of_face[f]].push_back(f);
    Face_patches patches(mesh_);
    for (std::size_t region = 0; region < faces.size(); ++region) {
      const Face_patches::Patch patch = patches.of(faces[region]);
      if (patch.vertices.size() < fewest_vertices) continue;
      if (const auto fitted = fitted_again(regions_.surfaces[region], patches.samples_of(patch)))
        regions_.surfaces[region] = *fitted;
    }
  }

  /// Of each region: 1 if its surface's normals point out of the solid, -1 if into it.
  std::vector<double> signs() const {
    std::vector<double> sums(regions_.surfaces.size(), 0);
    for (Index f = 0; f < mesh_.number_of_faces(); ++f)
      if (const std::size_t region = regions_.region_of_face[f]; region != none)
        sums[region] += mesh_.area(f) * regions_.surfaces[region].normal(mesh_.centroid(f)).dot(normal(f));
    for (double& sum : sums) sum = sum < 0 ? -1 : 1;
    return sums;
  }

  /// Distance and angle, as parts of what is allowed.
  double misfit(std::size_t region, double sign, Index f) const {
    return with_type_of(regions_.surfaces[region], [&](const auto& surface) {
      double farthest = 0;
      for (const Index v : mesh_.corners(f)) farthest = std::max(farthest, std::abs(surface.distance(mesh_.point(v))));
      return farthest / tolerance_.largest_distance() + angle(surface, sign, f) / tolerance_.normal_angle[f];
    });
  }

  /// How unlikely it is that noise puts a face where it is: the data term of a Potts model, half the sum of squared
  /// deviations.
  double energy(std::size_t region, double sign, Index f) const {
    constexpr double most_squares = 30;   // an outlier is no worse than that
    constexpr double allowed_angle = 3;   // deviations of the normal, as in `Surface_tolerance`
    constexpr double shared_corners = 2;  // a corner tells about its other faces as well
    return with_type_of(regions_.surfaces[region], [&](const auto& surface) {
      double distances = 0;
      for (const Index v : mesh_.corners(f)) {
        const double distance = surface.distance(mesh_.point(v)) / tolerance_.distance;
        distances += distance * distance;
      }
      const double turn = allowed_angle * angle(surface, sign, f) / tolerance_.normal_angle[f];
      return (std::min(distances, most_squares) / shared_corners + std::min(turn * turn, most_squares)) / 2;
    });
  }

  /// The angle between a face and a surface, 0 if the face has no normal.
  template <class Surface>
  double angle(const Surface& surface, double sign, Index f) const {
    if (normal(f).isZero()) return 0;
    const double cosine = sign * surface.normal(mesh_.centroid(f)).dot(normal(f));
    return std::acos(std::clamp(cosine, -1., 1.));
  }

  /// The length of the border of a face in a region, as a part of its edges.
  double border_energy(std::size_t region, Index f) const {
    constexpr double whole_border = 3;  // nats, as `energy()`, of a face that is no neighbour of its region
    double border = 0, all = 0;
    for (const auto& [g, e] : mesh_.graph().neighbours(f)) {
      all += mesh_.edge_length(e);
      if (regions_.region_of_face[g] != region) border += mesh_.edge_length(e);
    }
    return all > 0 ? whole_border * border / all : 0;
  }

  const Eigen::Vector3d& normal(Index face) const { return mesh_.shape_normals()[face]; }

  const Dual_mesh& mesh_;
  const Surface_tolerance& tolerance_;
  Analytic_regions& regions_;
  Progress progress_;
};

}  // namespace RW_segmentation::internal

#endif
