// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_COARSE_ARCS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_COARSE_ARCS_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Surface_samples.h>
#include <RW_segmentation/internal/surfaces/Face_patches.h>
#include <RW_segmentation/internal/surfaces/Region_growth.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/Work_progress.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Regions that are meshed so coarsely that faces beside each other turn as sharply as at an edge of the solid, as round a
/// hole of seven sides. Without noise their vertices are as exact as all others, and they are too many on one surface to
/// be there by chance.
///
/// The flat sides of a nut meet in vertices on a cylinder, too: regions of flat facets alone are none.
///
/// What comments tell of other values of a number was measured as in `Surface_growing`.
class Coarse_arcs {
 public:
  using Index = Dual_mesh::Index;
  using Region = Region_growth::Region;

  /// Keeps references to all.
  Coarse_arcs(const Dual_mesh& mesh, const Surface_tolerance& tolerance, Face_patches& patches, Work_progress& work)
      : mesh_(mesh),
        tolerance_(tolerance),
        patches_(patches),
        growth_(mesh, tolerance, patches, work, widest_turn / 2) {}

  /// The region about a face on a surface of one of some types that gains enough; none if there is none.
  Region region_about(Index seed, const std::vector<Surface_type>& types, double least_gain) {
    // Vertices of the neighbourhoods that it begins as; 7, 10, 12 and 36 are as good.
    constexpr std::array<std::size_t, 4> first_sizes = {8, 12, 18, 36};
    if (!turns_far(seed)) return {};
    const Patch about = patches_.neighbourhood_within(widest_turn, seed, first_sizes.back());
    for (const std::size_t size : first_sizes) {
      Region region = best_region(seed, patches_.beginning(about, size), types);
      if (region.gain >= least_gain) {
        if (is_faceted(region.patch)) return {};
        return region;
      }
      if (about.vertices.size() < size) break;
    }
    return {};
  }

 private:
  using Patch = Face_patches::Patch;

  /// The sides of a pentagon turn by 72 degrees, those of a box by 90. At 65 degrees, overlap .9868 in place of .9872
  /// (`_5k`); 85 are as good.
  static constexpr double widest_turn = radians(75);

  /// Whether a free face turns farther against one beside it than regions of fine arcs reach.
  bool turns_far(Index face) const {
    const auto neighbours = mesh_.graph().neighbours(face);
    return std::any_of(neighbours.begin(), neighbours.end(), [&](const Dual_graph::Neighbour& n) {
      const double fine = tolerance_.normal_angle[face] + tolerance_.normal_angle[n.face];
      return patches_.is_free(n.face) && !mesh_.is_wall(n.edge) && patches_.angle(n.edge) > fine &&
             patches_.angle(n.edge) <= widest_turn;
    });
  }

  Region best_region(Index seed, const Patch& start, const std::vector<Surface_type>& types) {
    // Vertices beyond those that determine a surface: overlap .9873 at 1, .9864 at 4 (`_5k`).
    constexpr std::size_t least_surplus = 2;
    Region best;
    start_samples_ = patches_.samples_of(start);
    const Surface_fit first_fit(start_samples_, growth_.largest_first_residual());
    for (const Surface_type type : types) {
      if (start.vertices.size() < static_cast<std::size_t>(degrees_of_freedom(type)) + least_surplus) continue;
      Region region = growth_.region_of_type(type, seed, start, first_fit);
      if (explains_noticeably_more(region, best)) best = std::move(region);
    }
    return best;
  }

  /// Whether a region has only flat facets. On round ones that are meshed as coarsely some triangles turn little against
  /// others.
  bool is_faceted(const Patch& patch) {
    constexpr double flat = radians(1);
    // Of the edges that turn: at 0, overlap .9687 (`_t`); at half, .9866 (`_5k`); a quarter is as good.
    constexpr double least_part = 0.1;
    std::size_t turning = 0, turning_little = 0;
    patches_.mark(patch);
    for (const Index f : patch.faces)
      for (const auto& [g, e] : mesh_.graph().neighbours(f)) {
        if (g < f || !patches_.is_marked(g) || patches_.angle(e) < flat) continue;
        ++turning;
        if (patches_.angle(e) <= tolerance_.sharp_angle({f, g})) ++turning_little;
      }
    return static_cast<double>(turning_little) < least_part * static_cast<double>(turning);
  }

  const Dual_mesh& mesh_;
  const Surface_tolerance& tolerance_;
  Face_patches& patches_;
  Region_growth growth_;
  Surface_samples start_samples_;  // of the present neighbourhood
};

}  // namespace RW_segmentation::internal

#endif
