// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_GROWING_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_GROWING_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Surface_samples.h>
#include <RW_segmentation/internal/surfaces/Analytic_regions.h>
#include <RW_segmentation/internal/surfaces/Coarse_arcs.h>
#include <RW_segmentation/internal/surfaces/Face_patches.h>
#include <RW_segmentation/internal/surfaces/Region_growth.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/Work_progress.h>

#include <boost/container_hash/hash.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Cuts a mesh into connected regions of faces that lie on one analytic surface each, and the remainder.
///
/// Regions grow about faces; of all types of surfaces the one that explains most vertices is kept. Regions that explain
/// many vertices are taken first; `gain` is the number of vertices beyond those that determine the surface.
///
/// Failures teach: where nothing fits about a face, the faces round it are not tried, until a region is taken nearby. So
/// free forms cost little.
///
/// Where a number tells an overlap or Rand error, it was made smaller or larger alone and `benchmark_engineering` run:
/// without noise on CAD solids as kernels mesh them (`--suffix _t`, .9744 and .0099 with the numbers as they are), where
/// told on the same meshed evenly (`_5k`: .9766 and .0023, `_30k`: .9908 and .0013) or on made solids (1 and 0). That was
/// without `Coarse_arcs`, with which evenly meshed solids have .9872 and .0013, .9911 and .0012, and without the pass of
/// exact distances.
class Surface_growing {
 public:
  using Index = Dual_mesh::Index;

  /// Keeps references to both.
  Surface_growing(const Dual_mesh& mesh, const Surface_tolerance& tolerance)
      : mesh_(mesh),
        tolerance_(tolerance),
        patches_(mesh, crease_angles(mesh, tolerance),
                 [&](Index e) { return tolerance.sharp_angle(mesh.graph().faces_of(e)); }),
        growth_(mesh, tolerance, patches_, work_),
        coarse_arcs_(mesh, tolerance, patches_, work_),
        lessons_(mesh.number_of_faces()),
        lessons_of_others_(mesh.number_of_faces()),
        tries_(mesh.number_of_faces(), 0) {
    regions_.region_of_face.assign(mesh.number_of_faces(), Analytic_regions::none);
  }

  /// Grows all regions, once.
  Analytic_regions regions(const Progress& progress) {
    const std::vector<Index> order = largest_first();
    const std::vector<Pass> all = passes();
    const double whole =
        std::accumulate(all.begin(), all.end(), 0., [](double sum, const Pass& pass) { return sum + pass.part; });
    double begin = 0;
    for (const Pass& pass : all) {
      const double end = std::min(1., begin + pass.part / whole);
      run(pass, order, progress.part(begin, end));
      begin = end;
    }
    return std::move(regions_);
  }

 private:
  using Patch = Face_patches::Patch;
  using Region = Region_growth::Region;

  static constexpr double unknown_gain = std::numeric_limits<double>::infinity();

  /// What the regions about a face gained that were not taken.
  struct Failure {
    std::size_t neighbourhood = 0;  // a hash
    double gain = std::numeric_limits<double>::infinity();
  };

  /// What failures have taught, by face.
  struct Lessons {
    explicit Lessons(std::size_t faces) : failures(faces), possible_gain(faces, unknown_gain) {}

    std::vector<Failure> failures;      // without noise
    std::vector<double> possible_gain;  // of a region about each face, as far as is known
  };

  /// Which regions are taken: those that gain enough, about round neighbourhoods of so many vertices at least or along
  /// narrow ones, too.
  struct Pass {
    double part;  // of the time, beside those of the other passes
    double least_gain;
    std::size_t smallest_start = 0;  // smaller ones happen to lie on surfaces all over a free form
    bool along_strips = false;
    bool spreads_seeds = false;             // a failure beside a border speaks for the faces next to it, too
    std::vector<Surface_type> coarse = {};  // types of the surfaces of coarse arcs; none: regions of fine ones
    double distances = 1;                   // that vertices may be off, as a part of those of the tolerance
  };

  std::vector<Index> largest_first() const {
    std::vector<Index> order(mesh_.number_of_faces());
    std::iota(order.begin(), order.end(), Index(0));
    std::stable_sort(order.begin(), order.end(), [&](Index f, Index g) { return mesh_.area(f) > mesh_.area(g); });
    return order;
  }

  /// By chance, noisy vertices lie on a surface that was fitted to few of them, and pieces of a large surface on others:
  /// the largest come first, and the smallest only where noise is independent.
  std::vector<Pass> passes() const {
    // The first pass over fine arcs takes half to nine tenths of the time, for the meshes of benchmark/benchmark_defects.
    constexpr double first = 0.6, other = 0.1;
    if (tolerance_.is_noisy()) {
      std::vector<Pass> noisy = {{first, 1000}, {other, 400}, {other, 160}, {other, 64}, {other, 24}};
      // CAD solids (`_5k`) under noise of .1 %, all of it taken for independent: overlap .885; .879 without the last pass,
      // .855 without both.
      if (tolerance_.has_independent_noise()) noisy.insert(noisy.end(), {{other, 12}, {other, 6}});
      return noisy;
    }
    // 12 vertices: overlap .9749 at 6, with more segments that are none, .9700 at 24; 3: .9744 at 1.5, .9740 at 6.
    // Coarse arcs come first, lest fine ones take parts of them (overlap .9867 without, `_5k`; 6 and 24 vertices are as
    // good), and with fewer vertices again (.9862 at 8; 3 are as good). Any three circles round an axis are on a torus: with
    // spheres and tori already at first, overlap .9704 (`_t`); without them at all, Rand error .0017 (`_5k`).
    const std::vector<Surface_type> ruled = {Surface_type::cylinder, Surface_type::cone};
    const std::vector<Surface_type> curved = {Surface_type::sphere, Surface_type::cylinder, Surface_type::cone,
                                              Surface_type::torus};
    constexpr double coarse = other / 2;
    // Where a surface leads on smoothly into a free form, vertices of that are near the surface, too: fitted to them, it is
    // off its own. Those that are exact show it under smaller distances. With that pass, overlap .9849 and Rand error .0081
    // (`_t`), .9923 and .0012 (`_30k`), and `_5k` as before; a third, a 27th, 12 vertices, and the place before the narrow
    // regions are as good.
    constexpr double exact_distances = 1. / 9;
    constexpr double few = 2.9;  // six vertices of a plane gain 3, but for rounding
    return {{coarse, 12, 0, false, false, ruled},
            {first, 64, 0, false, true},
            {other, 12},
            {other, 12, 0, true},
            {other, 24, 0, false, true, {}, exact_distances},
            {coarse, 4, 0, false, false, curved},
            {other, few, 10}};
  }

  /// Numbers of vertices of the neighbourhoods that surfaces are fitted to first.
  /// The largest clean one costs most: overlap .9730 at 18 in .9 of the time, .9753 at 72 in 1.3 times the time. Without that of
  /// 9 vertices, which planes alone begin with, .878 in place of .885 under noise as in `passes()`.
  const std::vector<std::size_t>& first_sizes() const {
    static const std::vector<std::size_t> clean = {7, 10, 12, 36}, independent = {9, 18, 54, 162},
                                          noisy = {18, 54, 162};
    if (!tolerance_.is_noisy()) return clean;
    return tolerance_.has_independent_noise() ? independent : noisy;  // few vertices mislead
  }

  void run(const Pass& pass, const std::vector<Index>& order, const Progress& progress) {
    work_.begin(progress);
    set_distances(pass.distances);
    for (std::size_t i = 0; i < order.size(); ++i) {
      // Faces that a region takes are passed over soon: the work is done with those looked at and those taken.
      work_.set_done(static_cast<double>(i + taken_) / static_cast<double>(2 * order.size()));
      work_.add(1);
      const Index seed = order[i];
      if (!patches_.is_free(seed) || normal(seed).isZero()) continue;
      const Region region = pass.coarse.empty() ? region_about(seed, pass)
                                                : coarse_arcs_.region_about(seed, pass.coarse, pass.least_gain);
      if (region.gain >= pass.least_gain) take(region);
    }
  }

  /// Failures under other distances teach nothing.
  void set_distances(double part) {
    if (part == distances_) return;
    distances_ = part;
    growth_.set_part_of_distances(part);
    std::swap(lessons_, lessons_of_others_);
  }

  void take(const Region& region) {
    patches_.take(region.patch);
    taken_ += region.patch.faces.size();
    for (Lessons* lessons : {&lessons_, &lessons_of_others_}) expect_anything_beside(region.patch, *lessons);
    for (const Index f : region.patch.faces) regions_.region_of_face[f] = regions_.surfaces.size();
    regions_.surfaces.push_back(region.surface);
  }

  Eigen::Vector3d normal(Index face) const { return mesh_.shape_normal(face); }

  // ---- One region ----

  /// The region about a face, or what it competes with. One that gains too little teaches what not to try.
  Region region_about(Index seed, const Pass& pass) {
    if (lessons_.possible_gain[seed] < pass.least_gain) return {};
    Region region = best_region(seed, pass);
    if (region.gain < pass.least_gain)
      expect_no_more(seed, region, pass);
    else if (!tolerance_.is_noisy())
      prefer_rivals(region, pass);
    return region;
  }

  /// The region about a face that explains most.
  Region best_region(Index seed, const Pass& pass) {
    const std::vector<std::size_t>& sizes = first_sizes();
    Region best;
    farthest_ = Patch();
    const Patch about = patches_.neighbourhood(seed, size_about());
    growth_.set_in_sheet(is_part_of_sheet(about));
    if (distances_ < 1 && growth_.is_in_sheet()) return best;  // nothing but exact surfaces were looked for there
    const std::size_t largest = tolerance_.is_noisy() ? 0 : hash_of(about);
    if (tolerance_.is_noisy() || !has_failed(seed, largest, pass.least_gain)) {
      if (begins_well(best, seed, about, pass)) return best;
      lessons_.failures[seed] = {largest, best.gain};
    }
    if (pass.along_strips) improve(best, seed, patches_.flattest_neighbourhood(seed, sizes.front()), pass.least_gain);
    return best;
  }

  /// Tries the neighbourhoods of a seed. True if one gains enough so that others need not be tried.
  /// \param about the neighbourhood that the smaller ones are the beginning of
  bool begins_well(Region& best, Index seed, const Patch& about, const Pass& pass) {
    const bool is_noisy = tolerance_.is_noisy();  // all sizes are tried then
    for (const std::size_t size : first_sizes()) {
      if (size < pass.smallest_start) continue;
      const Patch start = size <= size_about() ? patches_.beginning(about, size) : patches_.neighbourhood(seed, size);
      improve(best, seed, start, pass.least_gain);
      if (best.gain >= pass.least_gain && !is_noisy) return true;
      if (start.vertices.size() < size) break;
    }
    return !is_noisy && growth_.is_in_sheet() &&
           (is_found_wider(best, seed, pass) || is_found_farther(best, seed, pass));
  }

  /// Widens a neighbourhood that is all but flat until its curvature shows.
  bool is_found_wider(Region& best, Index seed, const Pass& pass) {
    constexpr std::size_t widening = 4, most_vertices = 3000;  // 2 and 500 give the CAD solids the same segments
    Patch start = patches_.neighbourhood(seed, first_sizes().back());
    std::size_t size = first_sizes().back();
    while (start.vertices.size() >= size && widening * size <= most_vertices && is_all_but_flat(start)) {
      size *= widening;
      start = patches_.neighbourhood(seed, size);
      improve(best, seed, start, pass.least_gain);
      if (best.gain >= pass.least_gain) return true;
    }
    return false;
  }

  bool is_all_but_flat(const Patch& patch) {
    // Root mean square distance from a plane; 3 miss the sphere of a benchmark, 30 give the CAD solids the same segments.
    constexpr double deviations = 10;
    return fit_analytic_surface(Surface_type::plane, patches_.samples_of(patch), deviations * tolerance_.distance)
        .has_value();
  }

  /// Begins anew with most of a region that went astray, the largest one: a cylinder leads far on a slender cone, whose
  /// own numbers show then.
  bool is_found_farther(Region& best, Index seed, const Pass& pass) {
    // Once, .4 and .8 of the faces, and 80 of them at least give the CAD solids the same segments.
    constexpr int most_times = 3;
    constexpr double part = 0.6;              // of the faces, those that were reached first
    constexpr std::size_t least_growth = 2;   // from time to time
    constexpr std::size_t fewest_faces = 40;  // less than the largest neighbourhood has
    std::size_t least = fewest_faces;
    for (int time = 0; time < most_times; ++time) {
      const auto first = static_cast<std::ptrdiff_t>(part * static_cast<double>(farthest_.faces.size()));
      if (static_cast<std::size_t>(first) <= least) return false;
      least = least_growth * farthest_.faces.size();
      improve(best, seed, patches_.of({farthest_.faces.begin(), farthest_.faces.begin() + first}), pass.least_gain);
      if (best.gain >= pass.least_gain) return true;
    }
    return false;
  }

  /// Whether regions that begin as the same neighbourhood gained too little before.
  bool has_failed(Index seed, std::size_t neighbourhood, double least_gain) const {
    return lessons_.failures[seed].gain < least_gain && lessons_.failures[seed].neighbourhood == neighbourhood;
  }

  static std::size_t hash_of(const Patch& patch) { return boost::hash_range(patch.faces.begin(), patch.faces.end()); }

  /// Tries all surfaces that begin as a neighbourhood of the seed; a more complex one must explain noticeably more.
  void improve(Region& best, Index seed, const Patch& start, double least_gain) {
    // Vertices beyond those that determine a surface: overlap .9744 at 1, .9668 at 4. Under noise no torus is fitted to
    // the smallest neighbourhood: at 2 statues take 1.2 times the time, and no set of noisy solids gains .01 of overlap.
    constexpr std::size_t clean_surplus = 2, noisy_surplus = 12;
    const std::size_t least_surplus = tolerance_.is_noisy() ? noisy_surplus : clean_surplus;
    start_samples_ = patches_.samples_of(start);
    const Surface_fit first_fit(start_samples_, growth_.largest_first_residual());
    for (const Surface_type type : analytic_types) {
      const bool is_simplest = type == analytic_types.front();
      if (!is_simplest && start.vertices.size() < static_cast<std::size_t>(degrees_of_freedom(type)) + least_surplus)
        return;
      Region region = growth_.region_of_type(type, seed, start, first_fit);
      if (explains_noticeably_more(region, best))
        best = std::move(region);
      else if (!(region.gain > 0) && region.patch.faces.size() > farthest_.faces.size())
        farthest_ = std::move(region.patch);
      const auto ends_at_sharp_edges = [&] { return patches_.faces_beside(best.patch).empty(); };
      if (is_simplest && best.gain >= least_gain && ends_at_sharp_edges()) return;
    }
  }

  // ---- Regions that compete ----

  /// Where a region ends smoothly, one that begins beyond may hold a part of it and explain more: a ring beside a fillet
  /// and the first row of triangles of the fillet lie on one torus, too.
  void prefer_rivals(Region& region, const Pass& pass) {
    for (Region rival = rival_of(region, pass); rival.gain > region.gain; rival = rival_of(region, pass))
      region = std::move(rival);
  }

  /// A region with more gain that has faces in common with a given one; none if its gain is not larger.
  Region rival_of(const Region& region, const Pass& pass) {
    for (const Index seed : seeds_beyond(region.patch)) {
      Region rival = best_region(seed, pass);
      if (rival.gain <= region.gain) continue;
      patches_.mark(region.patch);
      const auto is_in_both = [&](Index f) { return patches_.is_marked(f); };
      if (std::any_of(rival.patch.faces.begin(), rival.patch.faces.end(), is_in_both)) return rival;
    }
    return {};
  }

  /// Some of the faces beside a patch, and for each of them one farther away.
  std::vector<Index> seeds_beyond(const Patch& patch) {
    constexpr std::size_t places = 4;  // round the patch; overlap .9738 at 2, .9741 at 8
    // Of the neighbourhood whose last face is one farther away: Rand error .0108 at 9, .0106 at 36.
    constexpr std::size_t vertices_away = 18;
    const std::vector<Index> beside = patches_.faces_beside(patch);
    std::vector<Index> seeds;
    for (std::size_t i = 0; i < std::min(places, beside.size()); ++i) {
      const Index near = beside[i * beside.size() / places];
      const std::vector<Index> about = patches_.neighbourhood(near, vertices_away).faces;
      patches_.mark(patch);
      const Index far = *std::find_if(about.rbegin(), about.rend(), [&](Index f) { return !patches_.is_marked(f); });
      seeds.push_back(near);
      if (far != near) seeds.push_back(far);
    }
    return seeds;
  }

  // ---- What failures teach ----

  /// The neighbourhood that tells whether a seed is part of a sheet, and whether it has changed since it failed.
  std::size_t size_about() const {
    constexpr std::size_t noisy = 54;  // one of the first sizes
    return tolerance_.is_noisy() ? noisy : first_sizes().back();
  }

  /// Whether a neighbourhood is part of one smooth sheet that is meshed finely, far from its border.
  bool is_part_of_sheet(const Patch& about) const {
    // Between the faces there. At 25 degrees, coarse fillets of the CAD solids that benchmark_engineering measures are lost.
    constexpr double clean_angle = radians(12), noisy_angle = radians(40);
    const double angle = tolerance_.is_noisy() ? noisy_angle : clean_angle;
    return about.vertices.size() >= size_about() &&
           std::all_of(about.faces.begin(), end_of(about, part_about),
                       [&](Index f) { return patches_.is_smooth_within(f, angle); });
  }

  /// Faces near a seed about which too little was gained are not tried.
  void expect_no_more(Index seed, const Region& region, const Pass& pass) {
    constexpr double doubt = 1.3;  // how many times as much may be gained about another face; overlap .9733 at 2
    constexpr double part_of_farthest = 0.25;  // at a half, overlap .9750; at a tenth .9744 in 1.03 times the time
    if (tolerance_.is_noisy()) expect_no_more_of(seed, region);
    if (pass.spreads_seeds && !growth_.is_in_sheet() && !(region.gain > 0)) expect_nothing_next_to(seed);
    if (!growth_.is_in_sheet() || (tolerance_.is_noisy() && region.gain > 0)) return;
    const double gain = doubt * std::max(region.gain, 0.);
    expect_no_more_in(patches_.neighbourhood(seed, size_about()), part_about, gain);
    if (!(region.gain > 0)) expect_no_more_in(farthest_, part_of_farthest, gain);
  }

  /// Beside the border of a sheet only faces next to a seed are like it, where the mesh is fine. In the first pass, which
  /// looks for regions that have seeds enough.
  void expect_nothing_next_to(Index seed) {
    // Next to it: at 5, `fandisk.off` takes 1.7 times the time; at 20, Rand error .00129 in place of .00128 on evenly
    // meshed solids (`_30k`) and overlap .9549 in place of .9744.
    constexpr std::size_t vertices_next = 10;
    // Between the faces there. At 6 degrees `fandisk.off` takes 1.1 times the time; at 8, overlap .9781 in place of .9785
    // on a solid with slender fillets (`_30k`).
    constexpr double fine_angle = radians(7);
    const Patch about = patches_.neighbourhood(seed, size_about());
    if (about.vertices.size() >= size_about() && patches_.is_smooth_inside(about, fine_angle))
      expect_no_more_in(patches_.beginning(about, vertices_next), 1, 0);
  }

  /// \param part of the faces, those that were reached first
  void expect_no_more_in(const Patch& patch, double part, double gain) {
    std::for_each(patch.faces.begin(), end_of(patch, part),
                  [&](Index f) { lessons_.possible_gain[f] = std::min(lessons_.possible_gain[f], gain); });
  }

  /// The end of the faces of a patch that were reached first.
  static std::vector<Index>::const_iterator end_of(const Patch& patch, double part) {
    return patch.faces.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(patch.faces.size()));
  }

  /// Other faces of a region that gained too little would hardly gain more, the less the more of them were tried.
  void expect_no_more_of(Index seed, const Region& region) {
    constexpr double first_doubt = 0.3;  // by how much more another face of the region may gain, as a part
    constexpr double next_doubt = 0.9;   // that each try leaves of the doubt
    const double hardly = 1 + first_doubt * std::pow(next_doubt, tries_[seed]);
    const double gain = hardly * std::max(region.gain, 0.);
    lessons_.possible_gain[seed] = gain;
    for (const Index f : region.patch.faces) {
      lessons_.possible_gain[f] = std::min(lessons_.possible_gain[f], gain);
      ++tries_[f];
    }
  }

  /// Where a region has been taken, neighbourhoods are others than before.
  void expect_anything_beside(const Patch& taken, Lessons& lessons) {
    constexpr int rings = 3;  // of faces; overlap .9749 with 1, .9755 with 6
    if (tolerance_.is_noisy()) return;
    std::vector<Index> ring = patches_.faces_beside(taken), next;
    for (int i = 0; i < rings; ++i, ring.swap(next)) {
      next.clear();
      for (const Index f : ring) {
        if (lessons.possible_gain[f] == unknown_gain) continue;
        lessons.possible_gain[f] = unknown_gain;
        for (const auto& [g, e] : mesh_.graph().neighbours(f))
          if (patches_.is_free(g)) next.push_back(g);
      }
    }
  }

  /// Of the neighbourhood of a seed, what is as deep in a sheet as it is: overlap .9761 at a quarter, .9753 at all.
  static constexpr double part_about = 0.5;

  const Dual_mesh& mesh_;
  const Surface_tolerance& tolerance_;
  Face_patches patches_;
  Work_progress work_;
  Region_growth growth_;
  Coarse_arcs coarse_arcs_;
  Analytic_regions regions_;
  Lessons lessons_, lessons_of_others_;  // from passes with the distances at hand, and with others
  std::vector<std::uint32_t> tries_;     // by face: regions with it that gained too little
  Surface_samples start_samples_;        // of the present neighbourhood
  Patch farthest_;                       // the largest of the regions about it that explained nothing
  std::size_t taken_ = 0;                // faces, by regions
  double distances_ = 1;                 // see `Pass`
};

}  // namespace RW_segmentation::internal

#endif
