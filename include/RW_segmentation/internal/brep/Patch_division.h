// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_PATCH_DIVISION_H
#define RW_SEGMENTATION_INTERNAL_BREP_PATCH_DIVISION_H

#include <RW_segmentation/internal/brep/Height_field.h>
#include <RW_segmentation/internal/brep/Patch.h>
#include <RW_segmentation/internal/brep/Surface_placement.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal::brep {

/// Divides segments into patches that a surface can bear as one face: connected, without seam or pole, and, on a free
/// form, seen from one side as a whole. A full cylinder becomes two halves, as many CAD systems have it.
class Patch_division {
 public:
  Patch_division(const Halfedge_triangles& mesh, const std::vector<Analytic_surface>& surfaces)
      : mesh_(mesh), surfaces_(surfaces), key_(mesh.number_of_triangles(), 0) {}

  /// The patches that a connected part of a segment is divided into, in the given form or, where that cannot be, in one
  /// that follows it.
  std::vector<Patch> divided(std::size_t segment, std::vector<std::size_t> triangles, Form form) {
    if (form <= Form::surface_with_chords && !bears(surfaces_[segment], triangles)) form = Form::free_form;
    std::vector<Patch> result;
    std::vector<Item> open;
    open.push_back({std::move(triangles), 0, form});
    while (!open.empty()) {
      const Item item = std::move(open.back());
      open.pop_back();
      Patch patch;
      patch.segment = segment;
      patch.triangles = item.triangles;
      patch.form = item.form;
      if (patch.has_triangles()) {
        result.push_back(std::move(patch));
      } else if (patch.is_free_form()) {
        place_free_form(std::move(patch), item.depth, result, open);
      } else {
        place(std::move(patch), item.depth, result, open);
      }
    }
    return result;
  }

  /// A patch on a surface and, as free forms, its triangles that are far from it. One without such triangles becomes a
  /// free form.
  std::vector<Patch> without_far_triangles(const Patch& patch) {
    constexpr double near = 1e-3;  // of the diagonal
    for (const std::size_t t : patch.triangles) {
      const auto& corners = mesh_.corners(t);
      key_[t] = std::any_of(corners.begin(), corners.end(), [&](std::size_t v) {
        return std::abs(patch.surface->distance(mesh_.point(v))) > near * mesh_.diagonal();
      });
    }
    auto parts = mesh_.parts(patch.triangles, key_);
    if (parts.size() < 2) return divided(patch.segment, patch.triangles, Form::free_form);
    return divided_parts(patch.segment, std::move(parts),
                         [&](std::size_t t) { return key_[t] ? Form::free_form : patch.form; });
  }

  /// A patch in two or more, cut across its longest extent.
  std::vector<Patch> halved(const Patch& patch) {
    Point mean = Point::Zero();
    for (const std::size_t t : patch.triangles) mean += mesh_.centre(t) / double(patch.triangles.size());
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const std::size_t t : patch.triangles)
      moments += (mesh_.centre(t) - mean) * (mesh_.centre(t) - mean).transpose();
    const Point longest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors().col(2);
    for (const std::size_t t : patch.triangles) key_[t] = (mesh_.centre(t) - mean).dot(longest) > 0 ? 1 : 0;
    straighten_cut(patch.triangles);
    auto parts = mesh_.parts(patch.triangles, key_);
    if (parts.size() < 2) return divided(patch.segment, patch.triangles, Form::triangles);
    return divided_parts(patch.segment, std::move(parts), [](std::size_t) { return Form::free_form; });
  }

 private:
  /// \param form_of a function from the first triangle of a part to the part's form
  template <class Form_of>
  std::vector<Patch> divided_parts(std::size_t segment, std::vector<std::vector<std::size_t>> parts,
                                   const Form_of& form_of) {
    std::vector<Form> forms;  // before the keys change
    for (const auto& part : parts) forms.push_back(form_of(part[0]));
    std::vector<Patch> result;
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (Patch& patch : divided(segment, std::move(parts[i]), forms[i])) result.push_back(std::move(patch));
    return result;
  }

  /// So many triangles or fewer determine no cone and no torus: these pass through any corners.
  static constexpr std::size_t too_few_for_cone = 6;
  /// Of the diagonal: a surface so far from its triangles is not theirs, whatever their corners tell.
  static constexpr double largest_bulge = 0.03;
  /// Of the diagonal: corners so close to a plane are in it.
  static constexpr double flatness = 1e-5;
  /// The cosine of the largest angle between the normals of a height field and the vertical.
  static constexpr double least_rise = 0.5;
  /// The cosine of the largest angle between a triangle and the surface below its centre, and the share of the area that
  /// may be steeper.
  static constexpr double least_cosine = 0.75, largest_share_across = 0.1;
  static constexpr int most_cuts = 5, most_cuts_of_free_form = 8;

  struct Item {
    std::vector<std::size_t> triangles;
    int depth;
    Form form;
  };

  bool bears(const Analytic_surface& surface, const std::vector<std::size_t>& triangles) const {
    if (surface.type == Surface_type::free_form) return false;
    const bool is_cone_or_torus = surface.type == Surface_type::cone || surface.type == Surface_type::torus;
    if (is_cone_or_torus && triangles.size() <= too_few_for_cone) return false;
    if (surface.type == Surface_type::torus && surface.radius <= surface.tube_radius) return false;
    return bulge(mesh_, triangles, surface) < largest_bulge * mesh_.diagonal() && is_along(surface, triangles);
  }

  /// Whether the triangles lie along a surface, but for a few. Corners on some circles may lie on a torus that bulges
  /// far from the triangles between them.
  bool is_along(const Analytic_surface& surface, const std::vector<std::size_t>& triangles) const {
    double along = 0, against = 0, across = 0;  // areas
    for (const std::size_t t : triangles) {
      const Point normal = mesh_.area_vector(t);
      const double area = normal.norm(), cosine = surface.normal(mesh_.centre(t)).dot(normal);
      (std::abs(cosine) < least_cosine * area ? across : cosine > 0 ? along : against) += area;
    }
    return across + std::min(along, against) <= largest_share_across * (along + against + across);
  }

  void place(Patch patch, int depth, std::vector<Patch>& result, std::vector<Item>& open) {
    const Analytic_surface& surface = surfaces_[patch.segment];
    const Surface_placement placement = Surface_placing(mesh_, surface, patch.triangles)();
    if (placement.surface) {
      patch.surface = placement.surface;
      result.push_back(std::move(patch));
      return;
    }
    if (depth < most_cuts && !placement.cut.isZero()) {
      for (const std::size_t t : patch.triangles)
        key_[t] = (mesh_.centre(t) - surface.point).dot(placement.cut) > 0 ? 1 : 0;
      if (cut(patch, depth, open)) return;
    }
    open.push_back({std::move(patch.triangles), 0, Form::free_form});
  }

  void place_free_form(Patch patch, int depth, std::vector<Patch>& result, std::vector<Item>& open) {
    const std::vector<std::size_t> corners = corners_of(mesh_, patch.triangles);
    std::vector<Point> points;
    for (const std::size_t v : corners) points.push_back(mesh_.point(v));
    Point up = Point::Zero();
    for (const std::size_t t : patch.triangles) up += mesh_.area_vector(t);
    if (auto plane = plane_through(points, up)) {
      patch.surface = std::move(plane);
      result.push_back(std::move(patch));
      return;
    }
    if (rises(patch.triangles, up.normalized())) {
      patch.surface = std::make_shared<Height_field>(up.normalized(), points);
      result.push_back(std::move(patch));
      return;
    }
    if (depth < most_cuts_of_free_form && part_by_normals(patch.triangles) && cut(patch, depth, open)) return;
    open.push_back({std::move(patch.triangles), 0, Form::triangles});
  }

  /// The plane through points that lie in one.
  std::shared_ptr<Patch_surface> plane_through(const std::vector<Point>& points, const Point& up) const {
    Point mean = Point::Zero();
    for (const Point& p : points) mean += p / double(points.size());
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const Point& p : points) moments += (p - mean) * (p - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
    Analytic_surface plane;
    plane.type = Surface_type::plane;
    plane.point = mean;
    plane.direction = solver.eigenvectors().col(0);
    if (plane.direction.dot(up) < 0) plane.direction = -plane.direction;
    for (const Point& p : points)
      if (std::abs(plane.signed_distance(p)) > flatness * mesh_.diagonal()) return nullptr;
    return std::make_shared<Placed_surface>(plane, mean);
  }

  /// Whether all triangles look upward. Those without much area for their sides tell nothing.
  bool rises(const std::vector<std::size_t>& triangles, const Point& up) const {
    return std::all_of(triangles.begin(), triangles.end(), [&](std::size_t t) {
      const Point normal = mesh_.area_vector(t);
      return is_needle(t) || normal.dot(up) > least_rise * normal.norm();
    });
  }

  bool is_needle(std::size_t t) const {
    constexpr double least_height = 1e-3;  // of the longest side
    double longest = 0;
    for (std::size_t h = 3 * t; h < 3 * t + 3; ++h) longest = std::max(longest, mesh_.length(h));
    return 2 * mesh_.area_vector(t).norm() < least_height * longest * longest;
  }

  /// Gives each triangle to one of two whose normals differ much.
  bool part_by_normals(const std::vector<std::size_t>& triangles) {
    const auto normal = [&](std::size_t t) -> Point { return mesh_.area_vector(t).normalized(); };
    const auto farthest_from = [&](const Point& direction) {
      std::size_t farthest = none;
      double least = 2;
      for (const std::size_t t : triangles)
        if (const double cosine = normal(t).dot(direction); cosine < least && !is_needle(t)) {
          least = cosine;
          farthest = t;
        }
      return farthest;
    };
    const std::size_t first = farthest_from(normal(triangles[0]));
    if (first == none) return false;
    const Point a = normal(first), b = normal(farthest_from(a));
    for (const std::size_t t : triangles) key_[t] = normal(t).dot(a - b) > 0 ? 1 : 0;
    return true;
  }

  /// Cuts a patch between triangles of different keys.
  /// \returns whether there are any
  bool cut(const Patch& patch, int depth, std::vector<Item>& open) {
    straighten_cut(patch.triangles);
    auto parts = mesh_.parts(patch.triangles, key_);
    if (parts.size() < 2) return false;
    for (auto& part : parts) open.push_back({std::move(part), depth + 1, patch.form});
    return true;
  }

  /// Takes teeth off a cut: a triangle with neighbours on the other side alone changes sides.
  void straighten_cut(const std::vector<std::size_t>& triangles) {
    constexpr int passes = 3;
    std::vector<char> is_of_patch(mesh_.number_of_triangles(), false);
    for (const std::size_t t : triangles) is_of_patch[t] = true;
    for (int pass = 0; pass < passes; ++pass)
      for (const std::size_t t : triangles) {
        int same = 0, other = 0;
        for (std::size_t h = 3 * t; h < 3 * t + 3; ++h) {
          const std::size_t u = mesh_.neighbour(h);
          if (u != none && is_of_patch[u]) ++(key_[u] == key_[t] ? same : other);
        }
        if (same == 0 && other > 0) key_[t] ^= 1;
      }
  }

  const Halfedge_triangles& mesh_;
  const std::vector<Analytic_surface>& surfaces_;
  std::vector<char> key_;  // by triangle: its side of a cut
};

/// Gives slivers to the neighbour on whose surface they lie as well as its own triangles do. Kernels leave such triangles
/// between faces, and segmentations give them a surface of their own.
/// \param segment_of_triangle changed
inline void absorb_slivers(const Halfedge_triangles& mesh, const std::vector<Analytic_surface>& surfaces,
                           std::vector<std::size_t>& segment_of_triangle) {
  constexpr std::size_t most_triangles = 12;  // of a sliver
  constexpr double reach = 1e-5;              // of the diagonal
  std::vector<std::size_t> all(mesh.number_of_triangles());
  std::iota(all.begin(), all.end(), std::size_t(0));
  std::map<std::size_t, std::vector<std::size_t>> triangles_of;  // by surface
  for (const std::size_t t : all) triangles_of[segment_of_triangle[t]].push_back(t);
  const auto is_analytic = [&](std::size_t s) { return surfaces[s].type != Surface_type::free_form; };
  std::map<std::size_t, double> own_bulge;
  for (const auto& [s, triangles] : triangles_of)
    if (is_analytic(s)) own_bulge[s] = bulge(mesh, triangles, surfaces[s]);

  for (const auto& part : mesh.parts(all, segment_of_triangle)) {
    if (part.size() > most_triangles) continue;
    const std::size_t own = segment_of_triangle[part[0]];
    std::map<std::size_t, double> shared_length;
    for (const std::size_t t : part)
      for (std::size_t h = 3 * t; h < 3 * t + 3; ++h) {
        if (mesh.neighbour(h) == none) continue;
        const std::size_t other = segment_of_triangle[mesh.neighbour(h)];
        if (other != own && is_analytic(other) && triangles_of.at(other).size() > part.size())
          shared_length[other] += mesh.length(h);
      }
    std::size_t best = none;
    for (const auto& [other, length] : shared_length) {
      const Analytic_surface& surface = surfaces[other];
      const auto corners = corners_of(mesh, part);
      const bool is_near = std::all_of(corners.begin(), corners.end(), [&](std::size_t v) {
        return std::abs(surface.signed_distance(mesh.point(v))) < reach * mesh.diagonal();
      });
      if (!is_near || bulge(mesh, part, surface) >= 1.5 * own_bulge.at(other) + reach / 10 * mesh.diagonal()) continue;
      if (best == none || length > shared_length[best]) best = other;
    }
    if (best == none) continue;
    for (const std::size_t t : part) segment_of_triangle[t] = best;
  }
}

}  // namespace RW_segmentation::internal::brep

#endif
