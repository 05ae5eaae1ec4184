// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_BOUNDARY_SMOOTHER_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_BOUNDARY_SMOOTHER_H

#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/boundary/Border_crossing.h>
#include <RW_segmentation/internal/boundary/Border_way.h>
#include <RW_segmentation/internal/boundary/Boundary_chain.h>
#include <RW_segmentation/internal/boundary/Curve_smoothing.h>
#include <RW_segmentation/internal/boundary/Curve_tracing.h>
#include <RW_segmentation/internal/boundary/Lifted_surface.h>
#include <RW_segmentation/internal/boundary/Surface_refinement.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>
#include <RW_segmentation/internal/boundary/Walled_surface.h>
#include <RW_segmentation/internal/unit_vector.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Smooths all boundaries of a segmentation, each as far as the others let it.
class Boundary_smoother {
 public:
  using Index = Triangle_surface::Index;

  /// \param lifted from `surface.open()`
  /// \param crossings of `surface.whole()`, where it is a tile
  Boundary_smoother(const Walled_surface& surface, const Lifted_surface& lifted,
                    const std::vector<std::size_t>& segment_of_face, const Curve_smoothing_numbers& numbers,
                    const Curve_joining& joining, const std::vector<Border_crossing>& crossings)
      : walled_(surface),
        surface_(surface.open()),
        lifted_(lifted),
        segment_of_face_(segment_of_face),
        numbers_(numbers),
        trace_(surface.open(), snap, joining) {
    for (const Border_crossing& crossing : crossings) crossing_at_.emplace(crossing.vertex, crossing);
  }

  /// \param is_sharp for each halfedge, whether its edge is sharp
  /// \returns curves on `surface.whole()`
  std::vector<Surface_curve> operator()(const std::vector<char>& is_sharp, const Progress& progress) const {
    std::vector<Boundary_chain> chains = Boundary_chains(walled_, segment_of_face_)();
    for (Boundary_chain& chain : chains) find_ends(chain);
    std::vector<Drawing> drawings;
    std::vector<Surface_curve> curves;
    for (const Boundary_chain& chain : chains) {
      progress(static_cast<double>(curves.size()) / static_cast<double>(chains.size()));
      drawings.push_back({chain, curve_points(surface_, chain, creases(chain, is_sharp)), 0});
      curves.emplace_back();
      draw(drawings.back(), curves.back());
    }
    const double least_height = Surface_refinement::least_relative_height * walled_.whole().mean_edge_length();
    while (true) {
      const Surface_refinement refinement(walled_.whole(), curves, segment_of_face_, least_height);
      if (!refinement.has_faults()) return curves;
      // A fault that no smoothed curve is charged with is one that all of them share.
      if (!redraw(refinement.faulty_curves(), drawings, curves) &&
          !redraw(std::vector<char>(curves.size(), true), drawings, curves))
        throw std::runtime_error("the boundaries of the segments cannot be followed along the edges of the mesh");
    }
  }

 private:
  static constexpr std::size_t most_attempts = 3;
  static constexpr double snap = 0.02;  ///< of an edge

  /// A boundary and how far the attempts to smooth it have come.
  struct Drawing {
    const Boundary_chain& chain;
    std::vector<Curve_point> points;  ///< before it is smoothed
    std::size_t attempts;             ///< that failed
  };

  /// Finds the crossings at which a chain is to end.
  void find_ends(Boundary_chain& chain) const {
    if (chain.is_closed || chain.is_wall) return;
    const std::array into = {surface_.twin(chain.halfedges.front()), chain.halfedges.back()};  // both ends
    for (std::size_t end = 0; end < 2; ++end) {
      const auto found = crossing_at_.find(walled_.whole().target(into[end]));
      if (found == crossing_at_.end()) continue;
      const Border_crossing& crossing = found->second;
      if (crossing.side == Triangle_surface::none)
        chain.ends[end] = {crossing, {}};
      else if (auto way = border_way(surface_, into[end], crossing.side))
        chain.ends[end] = {crossing, std::move(*way)};
    }
  }

  /// The edges of a chain that lie on a crease: sharp ones, several in a row that do not turn much. A boundary that
  /// zigzags over the ribs of a coarse mesh meets sharp edges, too, but turns from one to the next.
  std::vector<char> creases(const Boundary_chain& chain, const std::vector<char>& is_sharp) const {
    constexpr std::size_t least_run = 3;
    constexpr double least_cosine = 0.9;  // of about 25 degrees
    const std::size_t size = chain.halfedges.size();
    const auto direction = [&](std::size_t i) {
      const Index h = chain.halfedges[i % size];
      return unit_vector(surface_.point(surface_.target(h)) - surface_.point(surface_.source(h)));
    };
    const auto goes_on = [&](std::size_t i) {  // from an edge to the next
      return is_sharp[chain.halfedges[i % size]] && is_sharp[chain.halfedges[(i + 1) % size]] &&
             direction(i).dot(direction(i + 1)) > least_cosine;
    };
    // A run of a closed chain may pass its end.
    std::size_t first = 0;
    if (chain.is_closed)
      while (first < size && goes_on(first + size - 1)) ++first;
    std::vector<char> result(size, false);
    for (std::size_t k = 0; k < size;) {
      std::size_t run = 1;
      while (k + run < size && goes_on(first + k + run - 1)) ++run;
      const bool is_crease = is_sharp[chain.halfedges[(first + k) % size]] && run >= std::min(least_run, size);
      for (std::size_t i = k; i < k + run; ++i) result[(first + i) % size] = is_crease;
      k += run;
    }
    if (chain.ends_on_side(0)) result.front() = false;
    if (chain.ends_on_side(1)) result.back() = false;
    return result;
  }

  /// Whether all faces on one side of a closed chain meet in one point.
  bool is_ring(const Boundary_chain& chain) const {
    if (!chain.is_closed) return false;
    for (const bool is_left : {true, false}) {
      const auto apex = [&](Index h) {
        return surface_.source(Triangle_surface::previous(is_left ? h : surface_.twin(h)));
      };
      if (std::all_of(chain.halfedges.begin(), chain.halfedges.end(),
                      [&](Index h) { return apex(h) == apex(chain.halfedges[0]); }))
        return true;
    }
    return false;
  }

  /// Draws those of the curves again that can be moved less. Returns whether there were any.
  bool redraw(const std::vector<char>& is_faulty, std::vector<Drawing>& drawings,
              std::vector<Surface_curve>& curves) const {
    bool is_any = false;
    for (std::size_t c = 0; c < curves.size(); ++c) {
      if (!is_faulty[c] || !curves[c].is_smoothed) continue;
      ++drawings[c].attempts;
      draw(drawings[c], curves[c]);
      is_any = true;
    }
    return is_any;
  }

  /// Draws a curve: the more attempts have failed, the closer to the edges.
  void draw(Drawing& drawing, Surface_curve& curve) const {
    for (; drawing.attempts < most_attempts; ++drawing.attempts)
      if (auto smooth = smoothed(drawing)) {
        curve = std::move(*smooth);
        return;
      }
    const Boundary_chain& chain = drawing.chain;
    curve = {nodes_of(walled_.whole(), chain), chain.is_closed, chain.segments, false, {}};
  }

  bool can_be_smoothed(const Drawing& drawing) const {
    const Boundary_chain& chain = drawing.chain;
    const bool is_free =
        std::any_of(drawing.points.begin(), drawing.points.end(), [](const auto& point) { return point.is_free(); });
    return numbers_.corridor > 0 && is_free && !chain.is_wall && chain.halfedges.size() >= (chain.is_closed ? 5 : 2) &&
           !is_ring(chain);
  }

  std::optional<Surface_curve> smoothed(const Drawing& drawing) const {
    if (!can_be_smoothed(drawing)) return std::nullopt;

    // Between the points the curve may reach a little further out.
    constexpr double margin = 0.8;
    Curve_smoothing_numbers numbers = numbers_;
    numbers.corridor *= margin / static_cast<double>(std::size_t(1) << (2 * drawing.attempts));
    const Curve_smoothing smooth(surface_, lifted_, numbers);
    auto curve = trace_(smooth(drawing.chain, drawing.points), drawing.chain.is_closed, ends_of(drawing.chain));
    if (!curve || curve->nodes.size() < 3) return std::nullopt;
    for (Curve_node& node : curve->nodes) {
      if (distance_to_chain(surface_, drawing.chain, node.origin, point_of(surface_, node)) > numbers_.corridor)
        return std::nullopt;
      if (node.is_vertex()) node.vertex = walled_.whole_vertex(node.vertex);
    }
    curve->segments = drawing.chain.segments;
    curve->is_smoothed = true;
    return curve;
  }

  static Curve_tracing::Ends ends_of(const Boundary_chain& chain) {
    Curve_tracing::Ends ends;
    if (chain.ends_on_side(0)) ends[0] = chain.ends[0]->node(0);
    if (chain.ends_on_side(1)) ends[1] = chain.ends[1]->node(chain.halfedges.size() - 1);
    return ends;
  }

  const Walled_surface& walled_;
  const Triangle_surface& surface_;  // cut open along the walls
  const Lifted_surface& lifted_;
  const std::vector<std::size_t>& segment_of_face_;
  Curve_smoothing_numbers numbers_;
  Curve_tracing trace_;
  std::map<Index, Border_crossing> crossing_at_;  // by vertex
};

}  // namespace RW_segmentation::internal

#endif
