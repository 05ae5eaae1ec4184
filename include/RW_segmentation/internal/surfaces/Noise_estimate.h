// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_NOISE_ESTIMATE_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_NOISE_ESTIMATE_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/surfaces/Face_patches.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/noise_trials.h>
#include <RW_segmentation/internal/surfaces/rounding_step.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Estimates how far vertices are off their surfaces from what neighbourhoods of faces leave unexplained. Without noise
/// some small ones lie on a surface exactly, if they avoid edges, even on a coarse mesh. Under noise none does, and
/// larger ones vary less. Also tells what kind of noise it is.
class Noise_estimate {
 public:
  using Index = Dual_mesh::Index;

  /// Expects no noise.
  /// \param trials the faces that neighbourhoods are about
  Noise_estimate(const Dual_mesh& mesh, std::vector<Index> trials) : mesh_(mesh), trial_faces_(std::move(trials)) {
    expect(Surface_tolerance(mesh, 0));
    rounding_ = rounding_that_matters();
  }

  /// From now on, neighbourhoods end at edges that this does not explain. Those that stay what they were are not fitted again.
  void expect(const Surface_tolerance& expected) {
    constexpr double sharp = radians(60);  // what a little noise hardly makes of flat edges
    expects_noise_ = expected.has_noise();
    trials_.clear();
    patches_.emplace(mesh_, edge_angles(mesh_),
                     [&](Index e) { return std::max(sharp, expected.angle_of_noise(mesh_.graph().faces_of(e))); });
  }

  /// The standard deviation of the vertices in parts of the diagonal, 0 if they count as exact.
  double standard_deviation() {
    if (rounding_ > 0) return rounding_;
    const double closest = expects_noise_ ? std::numeric_limits<double>::infinity() : deviation_of_closest();
    if (closest <= Surface_tolerance::least_slight_noise) return 0;
    const Noise_kind its_kind = kind();
    if (may_be_independent(its_kind)) return independent_deviation(closest);
    // The patches of a smooth free form are that close to surfaces as well.
    if (closest <= Surface_tolerance::cad_exactness) return 0;
    return deviation_from(its_kind == Noise_kind::smooth ? *size_beyond_smooth_noise() : many_vertices);
  }

  /// Rounding is no noise, and smooth noise is told from a free form only on meshes with many neighbourhoods.
  Noise_kind kind() {
    constexpr std::size_t least_vertices = 1000;
    // Mean correlations of independent noise of .05 to .3 % on evenly meshed CAD solids (`_5k`): -.15 to -.08, and up to .05 in
    // 9 of 84 cases. After one step of smoothing: -.076 and more.
    constexpr double independent = -0.08;
    if (rounding_ > 0) return Noise_kind::seemingly_independent;
    if (deviation_of(many_vertices) <= Surface_tolerance::least_slight_noise) return Noise_kind::unclear;
    const double correlation = mean_correlation();
    if (correlation <= independent) return Noise_kind::independent;
    if (correlation <= 0 || is_independent_on_one_surface()) return Noise_kind::seemingly_independent;
    const bool is_smooth = mesh_.points().size() >= least_vertices && size_beyond_smooth_noise();
    return is_smooth ? Noise_kind::smooth : Noise_kind::unclear;
  }

 private:
  static constexpr std::size_t many_vertices = 30;

  /// How well a surface fits to a neighbourhood.
  struct Trial {
    double deviation;
    double correlation;  // of the deviations at the ends of an edge
  };

  /// A neighbourhood, and its trial, if it has enough vertices for one.
  struct Measured_faces {
    std::vector<Index> faces;
    std::optional<Trial> trial;
  };

  /// The standard deviation of coordinates that were rounded; 0 if they were not, or count as exact even so. Rounding leaves
  /// planes along the axes exact, and rounds vertices above each other alike, so that neither what neighbourhoods leave
  /// unexplained nor its correlation tell it as they tell noise.
  double rounding_that_matters() {
    const double deviation = deviation_of_rounding(mesh_.points());
    if (deviation <= Surface_tolerance::least_slight_noise || deviation > Surface_tolerance::largest_slight_noise)
      return 0;
    const bool is_rounding = leave_as_much_unexplained(trials_of(many_vertices / 2), deviation) ||
                             leave_as_much_unexplained(trials_of(many_vertices), deviation);
    return is_rounding ? deviation : 0;
  }

  /// Whether some neighbourhoods leave about as much unexplained as rounding does on every surface but planes along the axes. Of
  /// a free form on a grid few do: what they leave depends on their size.
  static bool leave_as_much_unexplained(const std::vector<Trial>& trials, double rounding) {
    constexpr double exact = 1e-9;  // of the diagonal
    constexpr double part = 0.02;
    // Of those within two deviations. In steps of .002 to .035 % it takes 194 of 210 meshes of CAD and made solids, and 32 of
    // 189 of the Princeton Segmentation Benchmark, mechanical parts and furniture; without it 67 of these, free forms as well.
    constexpr double part_within_one = 0.3;
    const auto first = first_above(exact, trials);
    const auto number_within = [&](double deviation) {
      return static_cast<double>(first_above(deviation, trials) - first);
    };
    const double close = number_within(2 * rounding), all = static_cast<double>(trials.end() - first);
    return close > 0 && close >= part * all && number_within(rounding) >= part_within_one * close;
  }

  static std::vector<Trial>::const_iterator first_above(double deviation, const std::vector<Trial>& trials) {
    return std::partition_point(trials.begin(), trials.end(),
                                [deviation](const Trial& trial) { return trial.deviation <= deviation; });
  }

  /// What some small neighbourhoods leave unexplained at most; 0 as soon as enough of them lie on a surface, or if there are
  /// none.
  double deviation_of_closest() {
    constexpr std::size_t few_vertices = 12;
    const double closest = deviation_of_closest([&](Index f) { return patches_->neighbourhood(f, few_vertices); });
    if (closest == 0) return 0;
    return std::min(closest,
                    deviation_of_closest([&](Index f) { return patches_->flattest_neighbourhood(f, few_vertices); }));
  }

  template <class Neighbourhood_of>
  double deviation_of_closest(const Neighbourhood_of& neighbourhood_of) {
    constexpr double part = 0.02;
    constexpr double correction = 2.5;  // from a low quantile of the best of five fits
    std::vector<double> deviations;
    std::size_t exact = 0;
    for (const Index f : trial_faces_) {
      const auto surface = closest_surface_of(neighbourhood_of(f));
      if (!surface) continue;
      deviations.push_back(correction * surface->residual);
      exact += deviations.back() <= Surface_tolerance::least_slight_noise;
      if (static_cast<double>(exact) > part * static_cast<double>(trial_faces_.size())) return 0;
    }
    if (deviations.empty()) return 0;
    const auto last = deviations.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(deviations.size()));
    std::nth_element(deviations.begin(), last, deviations.end());
    return *last;
  }

  /// What the deviations of neighbouring vertices have in common: those of scanners are alike, and what a fit leaves of
  /// independent ones is opposite rather than alike. Told by the quarter of the neighbourhoods that lie on one surface best.
  /// Mean correlations on the made solids of `benchmark_engineering` under noise of .3 %: -.17 to -.01 evenly meshed, up to .1
  /// on two of eight as kernels mesh them; as if scanned under noise of .1 % .06 to .17, on CAD solids .01 to .18.
  /// \returns 1 if there are no neighbourhoods
  double mean_correlation() {
    constexpr double part = 0.25;
    const std::vector<Trial>& trials = trials_of(many_vertices);
    if (trials.empty()) return 1;
    const auto best = 1 + static_cast<std::ptrdiff_t>(part * static_cast<double>(trials.size() - 1));
    return std::accumulate(trials.begin(), trials.begin() + best, 0.,
                           [](double sum, const Trial& trial) { return sum + trial.correlation; }) /
           static_cast<double>(best);
  }

  /// Whether noise is independent by those neighbourhoods alone that lie on one surface, where these are few.
  bool is_independent_on_one_surface() {
    // CAD solids under .0005 to .03 % whose mean correlation is above 0: -.08 and less. The free forms of the Princeton
    // Segmentation Benchmark: -.04 and more; CGAL's: -.053 and more.
    constexpr double strong = -0.065;
    // The same CAD solids: .9 to 1.32, but for one; the same free forms: 1.43 and more.
    constexpr double no_growth = 1.35;
    const double correlation = correlation_of_closest();
    return correlation <= strong || (correlation < 0 && growth_to(many_vertices) <= no_growth);
  }

  /// The mean correlation of the neighbourhoods that a low quantile is taken from, and of those that are hardly less close.
  /// \returns 1 if there are no neighbourhoods
  double correlation_of_closest() {
    constexpr double hardly_more = 1.3;
    double sum = 0, count = 0;
    for (const Trial& trial : trials_of(many_vertices)) {
      if (trial.deviation > hardly_more * deviation_of(many_vertices)) break;
      sum += trial.correlation;
      ++count;
    }
    return count > 0 ? sum / count : 1;
  }

  /// What neighbourhoods of so many vertices leave unexplained: a low quantile, since most of them lie on several surfaces
  /// on a coarse mesh; 0 if there are none.
  double deviation_of(std::size_t vertices) {
    constexpr double part = 0.05;
    const std::vector<Trial>& trials = trials_of(vertices);
    return trials.empty() ? 0 : trials[static_cast<std::size_t>(part * static_cast<double>(trials.size()))].deviation;
  }

  /// The standard deviation of independent noise.
  /// \param closest what some small neighbourhoods leave unexplained at most
  double independent_deviation(double closest) {
    constexpr double correction_of_half = 1.85;  // from a low quantile of the best of five fits
    // 1.2 to 1.9 on CAD and made solids, but 2.3 and more where nearly no face has as many vertices.
    constexpr double largest_growth = 2.1;
    // 1 to 4.5 times the closest on CAD solids under .001 to .3 %, but 7 to 90 times where hardly any neighbourhood lies on one
    // surface (`axom_boxed_sphere_5k`, up to .03 %).
    constexpr double most_of_closest = 6, usual_of_closest = 2;
    const bool are_too_large = growth_to(many_vertices) > largest_growth;
    const double deviation =
        are_too_large ? correction_of_half * deviation_of(many_vertices / 2) : deviation_from(many_vertices);
    return deviation > most_of_closest * closest ? usual_of_closest * closest : deviation;
  }

  /// What neighbourhoods of so many vertices tell, or wider ones if they leave more unexplained.
  double deviation_from(std::size_t vertices) {
    constexpr double correction = 1.25;  // from a low quantile of the best of five fits
    return std::max(correction * deviation_of(vertices), deviation_that_grows_no_more());
  }

  /// How many times as much that is as with half the vertices.
  double growth_to(std::size_t vertices) {
    return deviation_of(vertices) / std::max(deviation_of(vertices / 2), std::numeric_limits<double>::min());
  }

  /// Small neighbourhoods follow smooth noise: what wider ones leave unexplained grows less and less. On a free form, or
  /// where neighbourhoods reach beyond their surface, it does not cease to grow.
  /// \returns how many vertices neighbourhoods have that leave most of smooth noise unexplained; none if it is no such noise
  std::optional<std::size_t> size_beyond_smooth_noise() {
    // Made solids as if scanned, smoothed by two to four steps: 1.22 to 1.54 at one of the two sizes, but for a flange, which
    // is narrower, 1.43 and more. CGAL's statues: 1.58 to 2.7 at both, but for an armadillo, a bull, a femur and bones, 1.12
    // to 1.44.
    constexpr double largest_growth = 1.55;
    // Beyond its surface a neighbourhood leaves suddenly more; smooth noise, at most 1.03 times the growth of before.
    constexpr double largest_rise = 1.1;
    for (const std::size_t vertices : {2 * many_vertices, 4 * many_vertices}) {
      const double growth = growth_to(vertices);
      if (growth > largest_rise * growth_to(vertices / 2)) break;
      if (growth <= largest_growth) return vertices;
    }
    return std::nullopt;
  }

  /// The deviation of neighbourhoods so wide that wider ones leave no more unexplained; 0 if they always do.
  double deviation_that_grows_no_more() {
    constexpr double first_growth = 1.45;  // that twice the vertices may bring; 1.4 for noise smoothed by two steps
    constexpr double no_growth = 1.15;     // what it is for independent noise
    constexpr double correction = 1.15;    // from a low quantile of the best of five fits
    double last_growth = first_growth;
    for (std::size_t vertices = 2 * many_vertices; vertices < most_vertices_of_noise_trial; vertices *= 2) {
      const double growth = growth_to(vertices);
      if (growth <= no_growth) return correction * deviation_of(vertices);
      if (!(growth < last_growth)) break;
      last_growth = growth;
    }
    return 0;
  }

  /// Neighbourhoods of so many vertices all over the mesh, those that lie on one surface best first.
  const std::vector<Trial>& trials_of(std::size_t vertices) {
    const auto [place, is_new] = trials_.try_emplace(vertices);
    std::vector<Trial>& trials = place->second;
    if (!is_new) return trials;
    for (const Index f : trial_faces_)
      if (const std::optional<Trial> trial = trial_about(f, vertices)) trials.push_back(*trial);
    std::sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
      return std::pair(a.deviation, a.correlation) < std::pair(b.deviation, b.correlation);
    });
    return trials;
  }

  std::optional<Trial> trial_about(Index face, std::size_t vertices) {
    Face_patches::Patch patch = patches_->neighbourhood(face, vertices);
    Measured_faces& measured = measured_[{vertices, face}];
    if (measured.faces != patch.faces) {
      const auto surface = closest_surface_of(patch);
      measured.trial.reset();
      if (surface) measured.trial = Trial{surface->residual, correlation(*surface, patch)};
      measured.faces = std::move(patch.faces);
    }
    return measured.trial;
  }

  /// The surface that is closest to the vertices of a patch, of the first type that fits, as a rule the plane, and the others
  /// that turn as its faces do, with the deviation of these vertices as its residual; none if there are too few.
  std::optional<Analytic_surface> closest_surface_of(const Face_patches::Patch& patch) {
    constexpr double least_surplus = 4;  // vertices beyond those that determine a surface
    const Surface_samples& samples = patches_->samples_of(patch);
    const auto points = static_cast<double>(samples.points.size());
    const Surface_fit fit(samples);
    std::optional<Analytic_surface> closest;
    for (const Surface_type type : analytic_types) {
      const double surplus = points - degrees_of_freedom(type);
      if (surplus < least_surplus) break;
      auto surface = fit.fit(type);
      if (!surface || !std::isfinite(surface->residual)) continue;
      surface->residual *= std::sqrt(points / surplus);
      if (!closest || (surface->residual < closest->residual && turns_alike(*surface, samples))) closest = surface;
    }
    return closest;
  }

  /// Whether the faces are closer in direction to a surface than chance would have them. The vertices of a disc, as kernels
  /// mesh it, are a ring, and a torus about that ring, its tube as thin as the noise, explains half of the noise although it
  /// stands at right angles to the disc.
  static bool turns_alike(const Analytic_surface& surface, const Surface_samples& samples) {
    // Of n directions by chance the mean cosine is 0, with a standard error of 1 / sqrt(3 n). With three of them in place of
    // two, noise of .3 % is taken for dependent in two of eight cases of a flange as a kernel meshes it (the solids of
    // benchmark_engineering).
    constexpr double standard_errors = 2;
    const auto normals = static_cast<double>(samples.normals.size());
    const double mean_cosine = 1 - squared_turns(surface, samples) / (2 * normals);
    return mean_cosine > standard_errors / std::sqrt(3 * normals);
  }

  /// Of the distances of both ends of an edge in a patch from a surface.
  double correlation(const Analytic_surface& surface, const Face_patches::Patch& patch) const {
    double product = 0, square = 0;
    for (const Index f : patch.faces) {
      const auto corners = mesh_.corners(f);
      for (std::size_t c = 0; c < corners.size(); ++c) {
        const double a = surface.signed_distance(mesh_.point(corners[c]));
        const double b = surface.signed_distance(mesh_.point(corners[(c + 1) % corners.size()]));
        product += a * b;
        square += (a * a + b * b) / 2;
      }
    }
    return square > 0 ? product / square : 0;
  }

  const Dual_mesh& mesh_;
  std::vector<Index> trial_faces_;
  bool expects_noise_ = false;
  std::optional<Face_patches> patches_;
  std::map<std::size_t, std::vector<Trial>> trials_;  // by vertices of the neighbourhoods
  std::map<std::pair<std::size_t, Index>, Measured_faces>
      measured_;         // by vertices, and by the faces that they are about
  double rounding_ = 0;  // the standard deviation of coordinates that were rounded
};

}  // namespace RW_segmentation::internal

#endif
