// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_REGION_BORDERS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_REGION_BORDERS_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/surfaces/Analytic_regions.h>
#include <RW_segmentation/internal/surfaces/Face_energy.h>
#include <RW_segmentation/internal/surfaces/Face_patches.h>
#include <RW_segmentation/internal/surfaces/Minimum_cut.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/Surface_types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

namespace RW_segmentation::internal {

/// Of each region: 1 if its surface's normals point out of the solid, -1 if into it.
inline std::vector<double> signs_of(const Dual_mesh& mesh, const Analytic_regions& regions) {
  std::vector<double> sums(regions.surfaces.size(), 0);
  for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f)
    if (const std::size_t region = regions.region_of_face[f]; region != Analytic_regions::none)
      sums[region] += mesh.area(f) * regions.surfaces[region].normal(mesh.centroid(f)).dot(mesh.shape_normal(f));
  for (double& sum : sums) sum = sum < 0 ? -1 : 1;
  return sums;
}

/// Moves faces at the borders of regions to the neighbour whose surface they fit best, and lets faces of the remainder
/// join a region that they fit. Under noise a face alone cannot tell: short borders count, too, and surfaces are fitted
/// again to what they have become.
class Region_borders {
 public:
  using Index = Dual_mesh::Index;

  /// Keeps references to all.
  Region_borders(const Dual_mesh& mesh, const Surface_tolerance& tolerance, Analytic_regions& regions)
      : mesh_(mesh), tolerance_(tolerance), energy_(mesh, tolerance), regions_(regions) {}

  /// Reports that all is done, again and again, so that it can be cancelled.
  void settle(const Progress& progress) {
    progress_ = progress;
    if (tolerance_.is_noisy())
      settle_noisy();
    else
      settle_exact();
  }

 private:
  static constexpr std::size_t none = Analytic_regions::none, no_node = none;

  void settle_exact() {
    constexpr int most_sweeps = 4;
    constexpr double unexplained = 2;  // all of the distance and all of the angle that are allowed
    const std::vector<double> sign = signs_of(mesh_, regions_);
    const auto any = [](std::size_t) { return true; };
    move_faces(most_sweeps, any, [&](Index f, std::size_t region) {
      return region == none ? unexplained : misfit(region, sign[region], f);
    });
  }

  /// Lowers the energy of a Potts model by a minimum cut for each two regions that meet (the swaps of Boykov, Veksler and
  /// Zabih 2001), and fits the surfaces to what the regions have become, in turns.
  void settle_noisy() {
    constexpr int most_rounds = 4, most_sweeps = 6;
    const auto has_none = [](std::size_t region) { return region == none; };
    std::vector<char> is_new(regions_.surfaces.size(), true);
    node_of_face_.assign(mesh_.number_of_faces(), no_node);
    for (int round = 0; round < most_rounds; ++round) {
      const std::vector<std::size_t> before = regions_.region_of_face;
      fit_again(is_new);
      const std::vector<double> sign = signs_of(mesh_, regions_);
      move_faces(most_sweeps, has_none, [&](Index f, std::size_t region) {
        return border_energy(region, f) +
               (region == none ? Face_energy::unexplained : energy_(regions_.surfaces[region], sign[region], f));
      });
      cut_between_neighbours(sign, is_new);
      if (regions_.region_of_face == before) break;
      is_new = regions_unlike(before);
    }
  }

  /// Moves each face to the region of a neighbour where it costs least, again and again.
  /// \param moves whether the faces of a region, or of none, do
  /// \param cost of a face, in a region or none
  template <class Predicate, class Cost>
  void move_faces(int most_sweeps, const Predicate& moves, const Cost& cost) {
    constexpr Index between_reports = 10000;  // faces, some milliseconds
    constexpr double least_gain = 1e-3;       // of a move, lest rounding errors move faces to and fro
    constexpr double unknown_cost = std::numeric_limits<double>::infinity();
    std::vector<std::size_t>& region_of_face = regions_.region_of_face;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      bool has_moved = false;
      for (Index f = 0; f < mesh_.number_of_faces(); ++f) {
        if (f % between_reports == 0) progress_(1);
        const std::size_t own = region_of_face[f];
        if (!moves(own)) continue;
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
        has_moved |= best != own;
        region_of_face[f] = best;
      }
      if (!has_moved) break;
    }
  }

  /// Which regions have gained or lost faces.
  std::vector<char> regions_unlike(const std::vector<std::size_t>& before) const {
    std::vector<char> is_other(regions_.surfaces.size(), false);
    for (Index f = 0; f < mesh_.number_of_faces(); ++f)
      if (before[f] != regions_.region_of_face[f])
        for (const std::size_t region : {before[f], regions_.region_of_face[f]})
          if (region != none) is_other[region] = true;
    return is_other;
  }

  /// Two regions that meet, and the faces that either may get, those of their border first.
  struct Contest {
    std::array<std::size_t, 2> regions;
    std::vector<Index> faces;
    std::array<std::vector<double>, 2> costs;  // of each face in either region
  };

  /// \param sign of each region, see `signs_of()`
  /// \param is_new each region: between two that are not, nothing has changed since they were cut
  void cut_between_neighbours(const std::vector<double>& sign, const std::vector<char>& is_new) {
    std::map<std::array<std::size_t, 2>, std::vector<Index>> borders;  // the faces on both sides
    for (Index f = 0; f < mesh_.number_of_faces(); ++f) {
      const std::size_t own = regions_.region_of_face[f];
      if (own == none) continue;
      for (const auto& [g, e] : mesh_.graph().neighbours(f))
        if (const std::size_t other = regions_.region_of_face[g];
            own < other && other != none && !mesh_.is_wall(e) && (is_new[own] || is_new[other])) {
          std::vector<Index>& border = borders[{own, other}];
          border.push_back(f);
          border.push_back(g);
        }
    }
    for (const auto& [regions, border] : borders) {
      progress_(1);
      Contest contest = contest_between(regions, border, sign);
      share_out(contest);
    }
  }

  /// The faces on the border of two regions and, on from these, those that do not cost so much less where they are that no
  /// border would be worth it.
  Contest contest_between(const std::array<std::size_t, 2>& regions, const std::vector<Index>& border,
                          const std::vector<double>& sign) {
    Contest contest = {regions, {}, {}};
    const auto add = [&](Index f) {
      if (!is_in(contest, f) || node_of_face_[f] != no_node) return;
      node_of_face_[f] = contest.faces.size();
      contest.faces.push_back(f);
    };
    std::for_each(border.begin(), border.end(), add);
    for (std::size_t first = 0; first < contest.faces.size();) {  // a ring farther from the border each time
      const std::size_t end = contest.faces.size();
      for (std::size_t side = 0; side < 2; ++side)
        energy_.append(regions_.surfaces[regions[side]], sign[regions[side]], contest.faces, contest.costs[side]);
      for (; first < end; ++first) {
        const Index f = contest.faces[first];
        const std::size_t own = side_of(contest, f);
        if (contest.costs[1 - own][first] - contest.costs[own][first] >= Face_energy::whole_border) continue;
        for (const auto& [g, e] : mesh_.graph().neighbours(f))
          if (!mesh_.is_wall(e)) add(g);
      }
    }
    return contest;
  }

  /// Cuts between two regions where it costs least; the faces beyond stay where they are.
  void share_out(Contest& contest) {
    const std::vector<Index>& faces = contest.faces;
    Minimum_cut cut(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (const auto& [g, e] : mesh_.graph().neighbours(faces[i])) {
        if (!is_in(contest, g) || mesh_.is_wall(e)) continue;
        const double cost = energy_.of_border(faces[i], g, e);
        if (node_of_face_[g] == no_node)
          contest.costs[1 - side_of(contest, g)][i] += cost;
        else if (faces[i] < g)
          cut.set_cost_between(i, node_of_face_[g], cost);
      }
      cut.set_costs(i, contest.costs[0][i], contest.costs[1][i]);
    }
    cut.run();
    for (std::size_t i = 0; i < faces.size(); ++i) {
      node_of_face_[faces[i]] = no_node;
      if (cut.is_on_first(i)) regions_.region_of_face[faces[i]] = contest.regions[0];
      if (cut.is_on_second(i)) regions_.region_of_face[faces[i]] = contest.regions[1];
    }
  }

  bool is_in(const Contest& contest, Index f) const {
    const std::size_t region = regions_.region_of_face[f];
    return region == contest.regions[0] || region == contest.regions[1];
  }

  std::size_t side_of(const Contest& contest, Index f) const {
    return regions_.region_of_face[f] == contest.regions[0] ? 0 : 1;
  }

  /// Fits the surfaces of new regions to them.
  void fit_again(const std::vector<char>& is_new) {
    constexpr std::size_t fewest_vertices = 12;
    const std::vector<std::vector<Index>> faces = regions_.faces();
    Face_patches patches(mesh_);
    for (std::size_t region = 0; region < faces.size(); ++region) {
      if (!is_new[region]) continue;
      const Face_patches::Patch patch = patches.of(faces[region]);
      if (patch.vertices.size() < fewest_vertices) continue;
      if (const auto fitted = fitted_again(regions_.surfaces[region], patches.samples_of(patch)))
        regions_.surfaces[region] = *fitted;
    }
  }

  /// Distance and angle, as parts of what is allowed.
  double misfit(std::size_t region, double sign, Index f) const {
    return with_type_of(regions_.surfaces[region], [&](const auto& surface) {
      double farthest = 0;
      for (const Index v : mesh_.corners(f)) farthest = std::max(farthest, std::abs(surface.distance(mesh_.point(v))));
      return farthest / tolerance_.largest_distance() + energy_.angle(surface, sign, f) / tolerance_.normal_angle[f];
    });
  }

  /// Of a face on its border: the length of the edges to other regions, as a part of all.
  double border_energy(std::size_t region, Index f) const {
    double border = 0;
    for (const auto& [g, e] : mesh_.graph().neighbours(f))
      if (regions_.region_of_face[g] != region) border += mesh_.edge_length(e);
    return border > 0 ? Face_energy::whole_border * border / energy_.perimeter(f) : 0;
  }

  const Dual_mesh& mesh_;
  const Surface_tolerance& tolerance_;
  const Face_energy energy_;
  Analytic_regions& regions_;
  Progress progress_;
  std::vector<std::size_t> node_of_face_;  // under noise: the number of each face in the present `Contest`
};

}  // namespace RW_segmentation::internal

#endif
