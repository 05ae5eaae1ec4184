// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_SHAPE_BUILDING_H
#define RW_SEGMENTATION_INTERNAL_BREP_SHAPE_BUILDING_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/brep/Halfedge_triangles.h>
#include <RW_segmentation/internal/brep/Height_field.h>
#include <RW_segmentation/internal/brep/Patch.h>
#include <RW_segmentation/internal/brep/Patch_division.h>
#include <RW_segmentation/internal/brep/Shape_attempt.h>

#include <TopoDS_Face.hxx>

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace RW_segmentation::internal::brep {

/// Makes the faces of a shape. Those that the kernel refuses are made once more in the next best way, with all others,
/// since they share edges.
class Shape_building {
 public:
  /// \param segment_of_triangle numbers of surfaces
  Shape_building(const Halfedge_triangles& mesh, const std::vector<Analytic_surface>& surfaces,
                 std::vector<std::size_t> segment_of_triangle, const Progress& progress)
      : mesh_(mesh),
        has_joined_(mesh.number_of_triangles()),
        has_taken_chords_(mesh.number_of_triangles()),
        division_(mesh, surfaces) {
    absorb_slivers(mesh, surfaces, segment_of_triangle);
    std::vector<std::size_t> all(mesh.number_of_triangles());
    std::iota(all.begin(), all.end(), std::size_t(0));
    for (auto& part : mesh.parts(all, segment_of_triangle)) {
      const std::size_t segment = segment_of_triangle[part[0]];
      for (Patch& patch : division_.divided(segment, std::move(part), Form::surface))
        bases_.push_back(std::move(patch));
    }
    // Each round takes one or more patches one way further, and most need none; the bar comes nearer to its end.
    double done = 0;
    do {
      progress(done);
      done += (1 - done) / 2;
    } while (!attempt());
    progress(1);
  }

  /// What became faces, with triangles one by one.
  const std::vector<Patch>& patches() const { return patches_; }
  /// By patch; null for a triangle of no area.
  const std::vector<TopoDS_Face>& faces() const { return faces_; }
  /// By patch; cones are from the middle of the mesh.
  const std::vector<Face_integrals>& integrals() const { return integrals_; }
  /// By patch.
  const std::vector<double>& tolerances() const { return tolerances_; }
  /// How many faces were refused, by the reasons.
  const std::map<std::string, std::size_t>& refusals() const { return refusals_; }
  std::size_t number_of_edges() const { return number_of_edges_; }

 private:
  /// \returns whether all is done
  bool attempt() {
    separate_triangles();
    const Shape_attempt attempt(mesh_, patches_, earlier_);
    std::map<std::size_t, Step> next;  // of bases
    for (const Rejection& rejection : attempt.rejections()) {
      const std::size_t base = base_of_[rejection.patch];
      if (bases_[base].has_triangles()) continue;
      const Step step = next_step(bases_[base], rejection);
      const auto [found, is_new] = next.emplace(base, step);
      if (is_new) ++refusals_[rejection.reason];
      found->second = std::max(found->second, step);
    }
    if (next.empty()) {
      faces_ = attempt.faces();
      faces_.resize(patches_.size());
      integrals_ = attempt.integrals();
      integrals_.resize(patches_.size());
      tolerances_ = attempt.tolerances();
      number_of_edges_ = attempt.borders().chains().size();
      return true;
    }
    remake(next);
    return false;
  }

  /// What helps a patch that was refused, the gentlest first.
  enum class Step { take_chords, leave_out_far_triangles, become_free_form, halve, join_free_form, become_triangles };

  Step next_step(const Patch& patch, const Rejection& rejection) const {
    constexpr std::size_t too_few_to_halve = 3;
    const bool is_far = rejection.cause == Rejection::Cause::edge_far_from_surface;
    const bool takes_chords = rejection.cause == Rejection::Cause::face_not_valid && patch.triangles.size() > 2;
    if (patch.form == Form::surface && takes_chords) return Step::take_chords;
    if (!patch.is_free_form()) return is_far ? Step::leave_out_far_triangles : Step::become_free_form;
    // Where chords did not help a free form, they do not help its halves: 28 CAD solids, as kernels mesh them, keep as many
    // triangles, in .95 of the time.
    if (patch.form == Form::free_form && takes_chords && !has_taken_chords_[patch.triangles[0]])
      return Step::take_chords;
    return patch.triangles.size() > too_few_to_halve ? Step::halve : Step::join_free_form;
  }

  void remake(std::map<std::size_t, Step>& next) {
    join_free_forms(next);
    std::vector<Patch> bases;
    for (std::size_t i = 0; i < bases_.size(); ++i) {
      const auto found = next.find(i);
      if (found == next.end())
        bases.push_back(std::move(bases_[i]));
      else
        for (Patch& patch : remade(bases_[i], found->second)) bases.push_back(std::move(patch));
    }
    bases_ = std::move(bases);
  }

  /// Gives each patch that is to join a free form to the one that it shares the longest border with. It becomes triangles
  /// if there is none, or if it has been given away before.
  void join_free_forms(std::map<std::size_t, Step>& next) {
    std::vector<std::size_t> base_of_triangle(mesh_.number_of_triangles(), none);
    for (std::size_t i = 0; i < bases_.size(); ++i)
      for (const std::size_t t : bases_[i].triangles) base_of_triangle[t] = i;
    for (auto& [base, step] : next) {
      if (step != Step::join_free_form) continue;
      step = Step::become_triangles;
      std::vector<std::size_t>& triangles = bases_[base].triangles;
      if (has_joined_[triangles[0]]) continue;
      const std::size_t other = free_form_beside(triangles, base_of_triangle, next);
      if (other == none) continue;
      for (const std::size_t t : triangles) has_joined_[t] = true;
      auto& joined = bases_[other].triangles;
      joined.insert(joined.end(), triangles.begin(), triangles.end());
      triangles.clear();
      next[other] = Step::become_free_form;
    }
  }

  /// The base of the free form that triangles share the longest border with, of those that were not refused.
  std::size_t free_form_beside(const std::vector<std::size_t>& triangles,
                               const std::vector<std::size_t>& base_of_triangle,
                               const std::map<std::size_t, Step>& next) const {
    std::map<std::size_t, double> shared_length;
    for (const std::size_t t : triangles)
      for (std::size_t h = 3 * t; h < 3 * t + 3; ++h) {
        if (mesh_.neighbour(h) == none) continue;
        const std::size_t other = base_of_triangle[mesh_.neighbour(h)];
        if (!dynamic_cast<const Height_field*>(bases_[other].surface.get())) continue;
        const auto refused = next.find(other);
        if (refused == next.end() || refused->second == Step::become_free_form) shared_length[other] += mesh_.length(h);
      }
    std::size_t best = none;
    for (const auto& [other, length] : shared_length)
      if (best == none || length > shared_length[best]) best = other;
    return best;
  }

  std::vector<Patch> remade(const Patch& patch, Step step) {
    if (patch.triangles.empty()) return {};  // given to another
    switch (step) {
      case Step::take_chords:
        if (patch.is_free_form())
          for (const std::size_t t : patch.triangles) has_taken_chords_[t] = true;
        return division_.divided(patch.segment, patch.triangles,
                                 patch.is_free_form() ? Form::free_form_with_chords : Form::surface_with_chords);
      case Step::leave_out_far_triangles:
        return division_.without_far_triangles(patch);
      case Step::become_free_form:
        return division_.divided(patch.segment, patch.triangles, Form::free_form);
      case Step::halve:
        return division_.halved(patch);
      case Step::join_free_form:
      case Step::become_triangles:
        break;
    }
    return division_.divided(patch.segment, patch.triangles, Form::triangles);
  }

  void separate_triangles() {
    patches_.clear();
    base_of_.clear();
    for (std::size_t i = 0; i < bases_.size(); ++i) {
      const Patch& base = bases_[i];
      if (!base.has_triangles()) {
        patches_.push_back(base);
        base_of_.push_back(i);
        continue;
      }
      for (const std::size_t t : base.triangles) {
        patches_.push_back({base.segment, {t}, base.form, nullptr});
        base_of_.push_back(i);
      }
    }
  }

  const Halfedge_triangles& mesh_;
  std::vector<char> has_joined_;        // by triangle: whether it was given to a free form
  std::vector<char> has_taken_chords_;  // by triangle: whether a free form with it was tried with chords
  Patch_division division_;
  std::vector<Patch> bases_, patches_;
  std::vector<std::size_t> base_of_;  // by patch
  Earlier_attempts earlier_;
  std::vector<TopoDS_Face> faces_;
  std::vector<Face_integrals> integrals_;
  std::vector<double> tolerances_;
  std::map<std::string, std::size_t> refusals_;
  std::size_t number_of_edges_ = 0;
};

/// A connected component of a mesh, and the faces that it becomes.
struct Shape_component {
  Halfedge_triangles mesh;
  Shape_building building;

  /// \param segment_of_face of the whole mesh
  Shape_component(const Dual_mesh& whole, double scale, const std::vector<Dual_mesh::Index>& faces,
                  const std::vector<std::size_t>& segment_of_face, const std::vector<Analytic_surface>& surfaces,
                  const Progress& progress)
      : mesh(whole, scale, faces), building(mesh, surfaces, segments_of_triangles(segment_of_face), progress) {}
  Shape_component(const Shape_component&) = delete;
  Shape_component& operator=(const Shape_component&) = delete;

 private:
  std::vector<std::size_t> segments_of_triangles(const std::vector<std::size_t>& segment_of_face) const {
    std::vector<std::size_t> segments;
    segments.reserve(mesh.number_of_triangles());
    for (std::size_t t = 0; t < mesh.number_of_triangles(); ++t) segments.push_back(segment_of_face[mesh.face(t)]);
    return segments;
  }
};

}  // namespace RW_segmentation::internal::brep

#endif
