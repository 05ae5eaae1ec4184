// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_TOLERANCE_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_TOLERANCE_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/surfaces/Flat_sides.h>
#include <RW_segmentation/internal/surfaces/edge_angles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// What the deviations of neighbouring vertices from their surfaces have in common.
enum class Noise_kind {
  independent,            ///< nothing
  seemingly_independent,  ///< nothing that shows: on coarse meshes, or after one step of smoothing
  smooth,                 ///< most: noise of a scanner, or smoothed noise
  unclear,                ///< a free form may be all there is
};

constexpr bool may_be_independent(Noise_kind kind) {
  return kind == Noise_kind::independent || kind == Noise_kind::seemingly_independent;
}

/// How far a mesh may be from the surfaces it approximates. Lengths are parts of the diagonal of its bounding box.
///
/// What comments tell of other values of a number was measured as in `Surface_growing`.
struct Surface_tolerance {
  using Index = Dual_mesh::Index;

  /// Vertices of CAD models are that exact or nearly always much more so. At half of it, overlap .9705 in place of .9744
  /// (`_t`); at twice, .9756, but .9742 in place of .9766 (`_5k`).
  static constexpr double cad_exactness = 1e-5;
  /// Deviations of the vertices that are reckoned with under slight noise. A third of it is what whole regions may be off
  /// (`Region_growth`): 1.2 deviations. At 1.1 and 1.3, the same overlaps (`_5k`, noise of .005 and .01 %).
  static constexpr double slight_distances = 3.6;
  /// Slight noise of at most so much is within what counts as exact.
  static constexpr double least_slight_noise = cad_exactness / slight_distances;
  /// Overlaps looked for as under noise and as without it: .86 and .99 on made solids under .03 %, .989 and .972 under .06 %;
  /// .918 and .929, .923 and .917 on CAD solids (`_5k`).
  static constexpr double largest_slight_noise = 4e-4;

  double noise = 0;                             ///< standard deviation of the vertices, 0 if they count as exact
  Noise_kind noise_kind = Noise_kind::unclear;  ///< where there is noise
  double distance = 0;                          ///< the standard deviation that is reckoned with
  std::vector<double> normal_angle;             ///< between a face and the surface that it is part of, in radians

  Surface_tolerance() = default;

  /// \param deviation standard deviation of the vertices
  /// \param kind of their noise, if they have any
  Surface_tolerance(const Dual_mesh& mesh, double deviation, Noise_kind kind = Noise_kind::unclear) : noise_kind(kind) {
    // Half of what kernels let an arc turn along an edge. At 9 degrees, overlap .9737 in place of .9766 (`_5k`); at 16,
    // .9807, and .9749 in place of .9744 (`_t`).
    constexpr double tessellation = radians(12);
    // Deviations of a normal, of which one in 16,000 is beyond. Rand error .033 on made solids under noise of .3 %; .036 at
    // 3 and at 5.
    constexpr double tilts = 4;
    constexpr double any_angle = 3;  // radians, a little less than a half turn
    // Smooth noise puts whole patches of vertices beside their surface, which are not to be cut out of it, and turns faces
    // less than its size tells. With 2.5 and a half, overlaps of .948 and .951 on made solids as if scanned under noise of .1
    // and .3 %, .781 and .748 on CAD solids (`_5k`); at 2 .936, .948, .776, .751; at 3 .954, .945, .775, .743. With whole
    // tilts, made solids have .013 less.
    constexpr double smooth_distances = 2.5, smooth_tilts = 0.5;
    const bool is_smooth = kind == Noise_kind::smooth;
    const std::vector<double> tilt = tilts_of_faces(mesh, deviation);
    is_slight_ = may_be_independent(kind) && is_slight(deviation, tilt);
    noise = deviation > (is_slight_ ? least_slight_noise : cad_exactness) ? deviation : 0;
    distance = std::max((is_smooth ? smooth_distances : is_slight_ ? slight_distances : 1) * deviation, cad_exactness);
    const double tilts_of_noise = has_noise() ? (is_smooth ? smooth_tilts : 1) * tilts : 0;
    normal_angle.reserve(tilt.size());
    for (const double t : tilt) normal_angle.push_back(std::min(tessellation + tilts_of_noise * t, any_angle));
  }

  bool has_noise() const { return noise > 0; }
  /// Whether there is noise that a few faces tell nothing under. Slight noise hardly turns them: regions are looked for as
  /// without noise then, but under larger distances.
  bool is_noisy() const { return has_noise() && !is_slight_; }
  bool has_independent_noise() const { return is_noisy() && noise_kind == Noise_kind::independent; }
  bool may_have_independent_noise() const { return is_noisy() && may_be_independent(noise_kind); }

  /// What a vertex is allowed: three deviations, or less under noise, which would hide smooth joints otherwise.
  double largest_distance() const {
    // Clean: at 2, overlap .9955 in place of 1 (made solids); at 4.5, .9623 in place of .9744 (`_t`). Noisy: at 1.75, Rand
    // error .028 in place of .031 on made solids, but overlap .56 in place of .68 on CAD solids (`_30k`, noise of .3 %); at
    // 3, .042 on made ones.
    // Slight: four deviations of the vertices; with ten, overlap .933 in place of .960 (`_5k`, noise of .01 %).
    constexpr double clean_deviations = 3, noisy_deviations = 2.25, slight_deviations = 10. / 9;
    if (!has_noise()) return clean_deviations * distance;
    return (is_noisy() ? noisy_deviations : slight_deviations) * distance;
  }

  /// The angle between two faces that noise explains.
  double angle_of_noise(const std::array<Index, 2>& faces) const {
    return has_noise() ? normal_angle[faces[0]] + normal_angle[faces[1]] : 0;
  }

  /// The angle between two faces that no noise explains and no analytic surface, but for those of `Coarse_arcs`.
  double sharp_angle(const std::array<Index, 2>& faces) const {
    constexpr double sharp = radians(40);  // at 32, 1.4 times the segments (`_5k`); at 50, overlap .9737 (`_t`)
    return std::max(sharp, angle_of_noise(faces));
  }

  /// The angle between two faces up to which a free form goes on from one to the other.
  double smooth_angle(const std::array<Index, 2>& faces) const {
    // A little more than kernels let an arc turn along an edge. At 18 degrees, a tenth more segments (`_5k`); at 32, Rand
    // error .0020 in place of .0013 (`_30k`).
    constexpr double smooth = radians(25);
    return std::max(smooth, angle_of_noise(faces));
  }

  /// The tolerance of a mesh whose faces are parts of faces of this one.
  /// \param face that each of them is part of
  Surface_tolerance of_parts(const std::vector<Index>& face) const {
    Surface_tolerance parts;
    parts.noise = noise;
    parts.noise_kind = noise_kind;
    parts.is_slight_ = is_slight_;
    parts.distance = distance;
    parts.normal_angle.reserve(face.size());
    for (const Index f : face) parts.normal_angle.push_back(normal_angle[f]);
    return parts;
  }

 private:
  /// How far noise turns the normal of each face, in radians.
  static std::vector<double> tilts_of_faces(const Dual_mesh& mesh, double deviation) {
    constexpr double least_height = 0.1;  // of a face, in deviations; lower ones have any normal
    std::vector<double> tilts(mesh.number_of_faces(), 0);
    for (Index f = 0; deviation > 0 && f < mesh.number_of_faces(); ++f) {
      const double height = 2 * mesh.area(f) / std::max(extent(mesh, f), std::numeric_limits<double>::min());
      tilts[f] = deviation / std::max(height, least_height * deviation);
    }
    return tilts;
  }

  /// Whether noise is small beside details of the shape, and turns half of the faces by little.
  static bool is_slight(double deviation, std::vector<double> tilts) {
    // Likewise, by the turn of half of the faces: .90 and .99 up to .015, .95 and .97 from there to .03, .97 and .97 to .045,
    // .95 and .93 to .07, less beyond (made solids, `_5k`, `_30k` and `_t`, noise of .01 to .06 %).
    constexpr double slight_turn = 0.03;  // radians
    if (deviation > largest_slight_noise || tilts.empty()) return false;
    const auto middle = tilts.begin() + static_cast<std::ptrdiff_t>(tilts.size() / 2);
    std::nth_element(tilts.begin(), middle, tilts.end());
    return *middle <= slight_turn;
  }

  /// The longest distance between two corners of a face.
  static double extent(const Dual_mesh& mesh, Index face) {
    double longest = 0;
    for (const Index v : mesh.corners(face))
      for (const Index w : mesh.corners(face)) longest = std::max(longest, (mesh.point(v) - mesh.point(w)).norm());
    return longest;
  }

  bool is_slight_ = false;  // the noise, if there is any
};

/// The angle between the faces of each edge, and a right one at creases between flat sides that meet at less. Under noise,
/// which turns all faces, none is known to be flat.
inline std::vector<double> crease_angles(const Dual_mesh& mesh, const Surface_tolerance& tolerance) {
  constexpr double right_angle = radians(90);
  std::vector<double> angles = edge_angles(mesh);
  if (tolerance.has_noise()) return angles;
  const std::vector<Flat_sides::Crease> creases = creases_of_flat_sides(mesh, angles);
  for (Dual_mesh::Index e = 0; e < angles.size(); ++e)
    if (creases[e] != Flat_sides::Crease::none) angles[e] = right_angle;
  return angles;
}

/// \throws std::invalid_argument
void require_noise(double noise);

/// The tolerance of a mesh.
/// \param noise standard deviation of the vertices in parts of the diagonal; negative: to be estimated
/// \throws std::invalid_argument if the noise is not finite
Surface_tolerance surface_tolerance(const Dual_mesh& mesh, double noise);

/// As above.
/// \param trials the faces about which noise is measured, where it is not given
Surface_tolerance surface_tolerance(const Dual_mesh& mesh, double noise, const std::vector<Dual_mesh::Index>& trials);

}  // namespace RW_segmentation::internal

#endif
