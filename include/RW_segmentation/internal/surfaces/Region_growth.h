// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_REGION_GROWTH_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_REGION_GROWTH_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/surfaces/Face_patches.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/Surface_types.h>
#include <RW_segmentation/internal/surfaces/Work_progress.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// Grows one region on one surface: the surface is fitted to the neighbourhood of a face, flooded as far as vertices and
/// normals agree, fitted to what was flooded, and so on, until it grows no more.
///
/// What comments tell of other values of a number was measured as in `Surface_growing`.
class Region_growth {
 public:
  using Index = Dual_mesh::Index;
  using Patch = Face_patches::Patch;

  struct Region {
    Patch patch;
    Analytic_surface surface;
    double gain = -std::numeric_limits<double>::infinity();  ///< vertices beyond those that determine the surface
  };

  /// Keeps references to all.
  /// \param turn of a face against its surface that is allowed in any case, in radians
  Region_growth(const Dual_mesh& mesh, const Surface_tolerance& tolerance, Face_patches& patches, Work_progress& work,
                double turn = 0)
      : mesh_(mesh), tolerance_(tolerance), patches_(patches), work_(work), seen_(mesh.number_of_vertices(), 0) {
    least_cosine_.reserve(tolerance.normal_angle.size());
    for (const double angle : tolerance.normal_angle) least_cosine_.push_back(std::cos(std::max(angle, turn)));
  }

  /// Sets whether regions are parts of a sheet, where all but exact surfaces are those of a free form.
  void set_in_sheet(bool is_in_sheet) { is_in_sheet_ = is_in_sheet; }
  bool is_in_sheet() const { return is_in_sheet_; }

  /// Sets by which part of the distances of the tolerance vertices may be off their surface.
  void set_part_of_distances(double part) { part_of_distances_ = part; }

  /// Of the surfaces that regions begin with. Outside of sheets they may have begun across a border.
  double largest_first_residual() const {
    const bool is_strict = !tolerance_.is_noisy() && is_in_sheet_;
    return is_strict ? exact * deviation() : largest_distance();
  }

  /// The region of a surface of that type which begins as a given neighbourhood of the seed.
  /// \param first_fit to the samples of the neighbourhood
  Region region_of_type(Surface_type type, Index seed, const Patch& start, const Surface_fit& first_fit) {
    constexpr int most_rounds = 30;
    // A surface is fitted again each time it has this many times the vertices, until it has grown by 2 % or less: one
    // that is flooded at once as far as a fit to few vertices leads goes astray. From 1.5 to 4 times at first, 2 to 6
    // times then, and 1 to 4 % the overlap stays within .001.
    constexpr std::size_t first_growth = 2, growth = 3;
    constexpr double little_growth = 1.02;
    constexpr std::size_t everything = std::numeric_limits<std::size_t>::max();
    const auto needed = static_cast<std::size_t>(degrees_of_freedom(type)) + 1;
    Region region;
    constexpr std::size_t work_of_fit = 100;  // see `Work_progress`
    if (start.vertices.size() < needed) return region;
    work_.add(work_of_fit);
    auto surface = first_fit.fit(type);
    if (!surface) return region;
    const Patch* last = &start;
    std::size_t last_size = start.vertices.size(), limit = first_growth * last_size;
    for (int round = 0; round < most_rounds; ++round) {
      flood(seed, *surface, sign_of(*surface, *last), limit, region.patch);
      last = &region.patch;
      const std::size_t size = region.patch.vertices.size();
      if (size < needed) return region;
      const bool is_whole = size < limit;
      if (is_whole && static_cast<double>(size) <= little_growth * static_cast<double>(last_size)) break;
      limit = is_whole ? everything : growth * std::max(limit, size);
      last_size = size;
      surface = fitted_again(*surface, patches_.samples_of(region.patch));
      if (!surface || (round > 0 && has_gone_astray(*surface))) return region;
    }
    region.surface = *surface;
    if (!is_piece_of_free_form(*surface)) region.gain = gain(region);
    return region;
  }

 private:
  double deviation() const { return part_of_distances_ * tolerance_.distance; }
  double largest_distance() const { return part_of_distances_ * tolerance_.largest_distance(); }

  /// 1 if the surface's normals point out of the solid, -1 if into it.
  double sign_of(const Analytic_surface& surface, const Patch& patch) const {
    constexpr std::size_t enough_faces = 50;
    return with_type_of(surface, [&](const auto& s) {
      double sum = 0;
      for (std::size_t i = 0; i < patch.faces.size() && i < enough_faces; ++i) {
        const Index f = patch.faces[i];
        sum += mesh_.area(f) * s.normal(mesh_.centroid(f)).dot(mesh_.shape_normal(f));
      }
      return sum < 0 ? -1. : 1.;
    });
  }

  template <class Predicate>
  bool all_of_corners(Index face, const Predicate& holds) const {
    const auto corners = mesh_.corners(face);
    return std::all_of(corners.begin(), corners.end(), holds);
  }

  /// The free faces on a surface that are connected with the seed, until they have so many vertices.
  /// The polygon at the end of a cylinder has its corners on a sphere through both ends, and the sphere's normal in its middle.
  void flood(Index seed, const Analytic_surface& surface, double sign, std::size_t most_vertices, Patch& patch) {
    unseen_ += 2;
    with_type_of(surface, [&](const auto& s) {
      const auto is_near = [&](Index v) {  // asked for each face about a vertex, and computed once
        if (seen_[v] < unseen_)
          seen_[v] = unseen_ + (std::abs(s.distance(mesh_.point(v))) <= largest_distance() ? 1 : 0);
        return seen_[v] > unseen_;
      };
      const auto lies_on = [&](Index f) {
        work_.add(1);
        if (!all_of_corners(f, is_near)) return false;
        const auto has_normal_at = [&](const Eigen::Vector3d& p) {
          return sign * s.normal(p).dot(mesh_.shape_normal(f)) > least_cosine_[f];
        };
        if (mesh_.shape_normal(f).isZero()) return true;
        return has_normal_at(mesh_.centroid(f)) &&
               (mesh_.corners(f).size() <= most_corners_of_facet ||
                all_of_corners(f, [&](Index v) { return has_normal_at(mesh_.point(v)); }));
      };
      patches_.flood(seed, lies_on, most_vertices, patch);
    });
  }

  /// A surface grown on a free form ends where the distance becomes too large; vertices of a true one are exact, unless
  /// there is noise.
  bool is_piece_of_free_form(const Analytic_surface& surface) const {
    return !tolerance_.is_noisy() && surface.residual > exact * deviation();
  }

  /// Whether a region that is still growing will be such a piece.
  bool has_gone_astray(const Analytic_surface& surface) const {
    constexpr double astray = 2. / 3;  // of the expected deviation; overlap .9733 at a third, .9749 at all of it
    return !tolerance_.is_noisy() && is_in_sheet_ && surface.residual > astray * deviation();
  }

  /// The number of vertices explained, each the less the farther it is off, beyond those that determine the surface.
  double gain(const Region& region) const {
    return with_type_of(region.surface, [&](const auto& s) {
      double sum = -s.degrees_of_freedom;
      for (const Index v : region.patch.vertices) {
        const double d = s.distance(mesh_.point(v)) / largest_distance();
        sum += 1 - d * d;
      }
      return sum;
    });
  }

  /// Of a curved surface. Polygons with more are flat faces, but for what has that normal at all corners.
  static constexpr std::size_t most_corners_of_facet = 4;

  /// Of the expected deviation: vertices of clean surfaces are no farther off. Overlap .9614 at a sixth. At two thirds
  /// .9856, but .973 in place of .977 and .989 in place of .991 on the same solids meshed evenly (`_5k`, `_30k`), and
  /// an eighth more segments than there are.
  static constexpr double exact = 1. / 3;

  const Dual_mesh& mesh_;
  const Surface_tolerance& tolerance_;
  Face_patches& patches_;
  Work_progress& work_;
  std::vector<double> least_cosine_;  // by face, of the angle to its surface
  std::vector<std::uint32_t> seen_;   // by vertex: `unseen_` if it is off the surface that is flooded, 1 more if on it
  std::uint32_t unseen_ = 0;          // even, and larger from flood to flood
  bool is_in_sheet_ = false;
  double part_of_distances_ = 1;
};

/// Whether a region explains so much more than another that a more complex surface is worth it.
inline bool explains_noticeably_more(const Region_growth::Region& region, const Region_growth::Region& other) {
  // Ratios of 1 and 1.1 give the same overlap, and so do 1 and 4 vertices.
  constexpr double noticeable_ratio = 1.05, noticeable_vertices = 2;
  return region.gain > (other.gain > 0 ? noticeable_ratio * other.gain + noticeable_vertices : other.gain);
}

}  // namespace RW_segmentation::internal

#endif
