// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_NOISE_ESTIMATE_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_NOISE_ESTIMATE_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/surfaces/Face_patches.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace RW_segmentation::internal {

/// Estimates how far vertices are off their surfaces from what neighbourhoods of faces leave unexplained. Without noise
/// some small ones lie on a surface exactly, if they avoid edges, even on a coarse mesh. Under noise none does, and
/// larger ones vary less.
class Noise_estimate {
 public:
  using Index = Dual_mesh::Index;

  /// \param expected what neighbourhoods are to reckon with: they end at edges that it does not explain
  Noise_estimate(const Dual_mesh& mesh, const Surface_tolerance& expected)
      : mesh_(mesh),
        number_of_faces_(mesh.number_of_faces()),
        expects_noise_(expected.is_noisy()),
        patches_(mesh, edge_angles(mesh), [&](Index e) {
          constexpr double sharp = radians(60);  // what a little noise hardly makes of flat edges
          return std::max(sharp, expected.angle_of_noise(mesh.graph().faces_of(e)));
        }) {}

  /// The standard deviation of the vertices in parts of the diagonal, 0 if it is below `Surface_tolerance::cad_exactness`.
  double standard_deviation() {
    if (!expects_noise_ && is_exact()) return 0;
    const double deviation = deviation_of_many(many_vertices);
    return std::max(correction * deviation, deviation_of_smooth_noise(many_vertices, deviation));
  }

  /// Whether the deviations of neighbouring vertices are independent; those of scanners are alike. What a fit leaves of
  /// independent ones is opposite rather than alike. Told by the quarter of the neighbourhoods that lie on one surface best.
  /// Mean correlations on the made solids of `benchmark_engineering` under noise of .1 and .3 %: -.15 to .01, but .05 on a
  /// kernel's cone; as if scanned .04 to .17.
  bool is_independent() {
    constexpr double part = 0.25;
    std::vector<std::array<double, 2>> fits;  // deviation and correlation
    for_each_trial([&](Index f) {
      const Face_patches::Patch patch = patches_.neighbourhood(f, many_vertices);
      if (const auto surface = closest_surface_of(patch))
        fits.push_back({surface->residual, correlation(*surface, patch)});
      return true;
    });
    if (fits.empty()) return false;
    std::sort(fits.begin(), fits.end());
    fits.resize(1 + static_cast<std::size_t>(part * static_cast<double>(fits.size() - 1)));
    double sum = 0;
    for (const auto& fit : fits) sum += fit[1];
    return sum <= 0;
  }

 private:
  static constexpr std::size_t many_vertices = 30;
  static constexpr double correction = 1.25;  // from the low quantile of the best of five fits

  /// Whether some small neighbourhoods lie on a surface: known as soon as enough of them do.
  bool is_exact() {
    constexpr std::size_t few_vertices = 12;
    constexpr double part = 0.02;
    const auto are_some_exact = [&](const auto& neighbourhood_of) {
      constexpr double correction = 2.5;  // likewise
      std::size_t measured = 0, exact = 0;
      for_each_trial([&](Index f) {
        const auto surface = closest_surface_of(neighbourhood_of(f));
        measured += surface.has_value();
        exact += surface && correction * surface->residual <= Surface_tolerance::cad_exactness;
        return static_cast<double>(exact) <= part * static_cast<double>(number_of_trials());
      });
      return measured == 0 || static_cast<double>(exact) > part * static_cast<double>(measured);
    };
    return are_some_exact([&](Index f) { return patches_.neighbourhood(f, few_vertices); }) ||
           are_some_exact([&](Index f) { return patches_.flattest_neighbourhood(f, few_vertices); });
  }

  /// Of neighbourhoods of so many vertices.
  double deviation_of_many(std::size_t vertices) {
    constexpr double part = 0.05;
    return quantile(part, [&](Index f) { return patches_.neighbourhood(f, vertices); });
  }

  /// A scanner's noise is smooth: small neighbourhoods follow it. What wider ones leave unexplained grows less and less until
  /// it is all of the noise. On a free form, or where neighbourhoods reach beyond their surface, it does not cease to grow:
  /// 0 then.
  double deviation_of_smooth_noise(std::size_t vertices, double deviation) {
    constexpr std::size_t most_vertices = 500;
    constexpr double first_growth = 1.45;  // that twice the vertices may bring; 1.4 for noise smoothed by two steps
    constexpr double no_growth = 1.15;     // what it is for independent noise
    constexpr double correction = 1.15;    // as for many vertices
    double last_growth = first_growth;
    for (vertices *= 2; vertices < most_vertices; vertices *= 2) {
      const double wider = deviation_of_many(vertices);
      const double growth = wider / std::max(deviation, std::numeric_limits<double>::min());
      if (growth <= no_growth) return correction * wider;
      if (!(growth < last_growth)) break;
      last_growth = growth;
      deviation = wider;
    }
    return 0;
  }

  /// A quantile of the least deviations of neighbourhoods, most of which lie on several surfaces on a coarse mesh; 0 if
  /// there are none.
  template <class Neighbourhood>
  double quantile(double part, const Neighbourhood& neighbourhood_of) {
    std::vector<double> deviations;
    for_each_trial([&](Index f) {
      if (const auto surface = closest_surface_of(neighbourhood_of(f))) deviations.push_back(surface->residual);
      return true;
    });
    if (deviations.empty()) return 0;
    const auto place = deviations.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(deviations.size()));
    std::nth_element(deviations.begin(), place, deviations.end());
    return *place;
  }

  /// Calls a function with some faces, evenly in their order, as long as it returns true.
  template <class Function>
  void for_each_trial(const Function& function) {
    for (std::size_t f = 0; f < number_of_faces_; f += trial_step())
      if (!function(static_cast<Index>(f))) return;
  }
  std::size_t number_of_trials() const { return (number_of_faces_ + trial_step() - 1) / trial_step(); }
  std::size_t trial_step() const {
    constexpr std::size_t trials = 400;  // up to twice as many
    return std::max<std::size_t>(1, number_of_faces_ / trials);
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
  std::size_t number_of_faces_;
  bool expects_noise_;
  Face_patches patches_;
};

}  // namespace RW_segmentation::internal

#endif
