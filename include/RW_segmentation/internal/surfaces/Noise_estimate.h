// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_NOISE_ESTIMATE_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_NOISE_ESTIMATE_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/surfaces/Face_patches.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/noise_trials.h>

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

  /// \param expected what neighbourhoods are to reckon with: they end at edges that it does not explain
  /// \param trials the faces that they are about
  Noise_estimate(const Dual_mesh& mesh, const Surface_tolerance& expected, std::vector<Index> trials)
      : mesh_(mesh),
        trial_faces_(std::move(trials)),
        expects_noise_(expected.has_noise()),
        patches_(mesh, edge_angles(mesh), [&](Index e) {
          constexpr double sharp = radians(60);  // what a little noise hardly makes of flat edges
          return std::max(sharp, expected.angle_of_noise(mesh.graph().faces_of(e)));
        }) {}

  /// The standard deviation of the vertices in parts of the diagonal, 0 if it is below `Surface_tolerance::cad_exactness`.
  double standard_deviation() {
    constexpr double correction = 1.25, correction_of_half = 1.85;  // from a low quantile of the best of five fits
    // Independent noise on CAD and made solids: 1.2 to 1.9, but 2.3 and more where nearly no face has as many vertices.
    constexpr double largest_growth = 2.1;
    if (!expects_noise_ && is_exact()) return 0;
    const Noise_kind its_kind = kind();
    if (may_be_independent(its_kind) && growth_to(many_vertices) > largest_growth)
      return correction_of_half * deviation_of(many_vertices / 2);
    const std::size_t vertices = its_kind == Noise_kind::smooth ? *size_beyond_smooth_noise() : many_vertices;
    return std::max(correction * deviation_of(vertices), deviation_that_grows_no_more());
  }

  /// Rounding is no noise, and smooth noise is told from a free form only on meshes with many neighbourhoods.
  Noise_kind kind() {
    constexpr std::size_t least_vertices = 1000;
    // Mean correlations of independent noise of .05 to .3 % on evenly meshed CAD solids (`_5k`): -.15 to -.08, and up to .05 in
    // 9 of 84 cases. After one step of smoothing: -.076 and more.
    constexpr double independent = -0.08;
    if (deviation_of(many_vertices) <= Surface_tolerance::cad_exactness) return Noise_kind::unclear;
    const double correlation = mean_correlation();
    if (correlation <= independent) return Noise_kind::independent;
    if (correlation <= 0) return Noise_kind::seemingly_independent;
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

  /// Whether some small neighbourhoods lie on a surface: known as soon as enough of them do.
  bool is_exact() {
    constexpr std::size_t few_vertices = 12;
    constexpr double part = 0.02;
    const auto are_some_exact = [&](const auto& neighbourhood_of) {
      constexpr double correction = 2.5;  // from a low quantile of the best of five fits
      std::size_t measured = 0, exact = 0;
      for_each_trial([&](Index f) {
        const auto surface = closest_surface_of(neighbourhood_of(f));
        measured += surface.has_value();
        exact += surface && correction * surface->residual <= Surface_tolerance::cad_exactness;
        return static_cast<double>(exact) <= part * static_cast<double>(trial_faces_.size());
      });
      return measured == 0 || static_cast<double>(exact) > part * static_cast<double>(measured);
    };
    return are_some_exact([&](Index f) { return patches_.neighbourhood(f, few_vertices); }) ||
           are_some_exact([&](Index f) { return patches_.flattest_neighbourhood(f, few_vertices); });
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

  /// What neighbourhoods of so many vertices leave unexplained: a low quantile, since most of them lie on several surfaces
  /// on a coarse mesh; 0 if there are none.
  double deviation_of(std::size_t vertices) {
    constexpr double part = 0.05;
    const std::vector<Trial>& trials = trials_of(vertices);
    return trials.empty() ? 0 : trials[static_cast<std::size_t>(part * static_cast<double>(trials.size()))].deviation;
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
    for_each_trial([&](Index f) {
      const Face_patches::Patch patch = patches_.neighbourhood(f, vertices);
      if (const auto surface = closest_surface_of(patch))
        trials.push_back({surface->residual, correlation(*surface, patch)});
      return true;
    });
    std::sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
      return std::pair(a.deviation, a.correlation) < std::pair(b.deviation, b.correlation);
    });
    return trials;
  }

  /// Calls a function with the faces of the trials, as long as it returns true.
  template <class Function>
  void for_each_trial(const Function& function) {
    for (const Index f : trial_faces_)
      if (!function(f)) return;
  }

  /// The surface that is closest to the vertices of a patch, of the first type that fits, as a rule the plane, and the others
  /// that turn as its faces do, with the deviation of these vertices as its residual; none if there are too few.
  std::optional<Analytic_surface> closest_surface_of(const Face_patches::Patch& patch) {
    constexpr double least_surplus = 4;  // vertices beyond those that determine a surface
    const Surface_samples& samples = patches_.samples_of(patch);
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
  bool expects_noise_;
  Face_patches patches_;
  std::map<std::size_t, std::vector<Trial>> trials_;  // by vertices of the neighbourhoods
};

}  // namespace RW_segmentation::internal

#endif
