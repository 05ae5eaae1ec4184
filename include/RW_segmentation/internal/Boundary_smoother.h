#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_SMOOTHER_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_SMOOTHER_H

#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Boundary_chain.h>
#include <RW_segmentation/internal/Curve_smoothing.h>
#include <RW_segmentation/internal/Curve_tracing.h>
#include <RW_segmentation/internal/Lifted_surface.h>
#include <RW_segmentation/internal/Surface_refinement.h>
#include <RW_segmentation/internal/Triangle_surface.h>
#include <RW_segmentation/internal/unit_vector.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Smooths all boundaries of a segmentation, each as far as the others let it.
class Boundary_smoother {
 public:
  using Index = Triangle_surface::Index;

  Boundary_smoother(const Triangle_surface& surface, const Lifted_surface& lifted,
                    const std::vector<std::size_t>& segment_of_face, const Curve_smoothing_numbers& numbers)
      : surface_(surface),
        lifted_(lifted),
        segment_of_face_(segment_of_face),
        numbers_(numbers),
        chains_(Boundary_chains(surface, segment_of_face)()),
        attempts_(chains_.size(), 0),
        is_smoothed_(chains_.size(), false) {}

  /// \param is_sharp for each halfedge, whether its edge is sharp
  std::vector<Surface_curve> operator()(const std::vector<char>& is_sharp, const Progress& progress) {
    std::vector<Surface_curve> curves;
    for (const Boundary_chain& chain : chains_) {
      progress(static_cast<double>(curves.size()) / static_cast<double>(chains_.size()));
      points_.push_back(curve_points(surface_, chain, creases(chain, is_sharp)));
      curves.push_back({{}, chain.is_closed, chain.segments});
      draw(curves.size() - 1, curves.back());
    }
    const double least_height = least_relative_height * surface_.mean_edge_length();
    while (true) {
      const Surface_refinement refinement(surface_, curves, segment_of_face_, least_height);
      if (!refinement.has_faults()) return curves;
      // A fault that no smoothed curve is charged with is one that all of them share.
      if (!redraw(refinement.faulty_curves(), curves) && !redraw(std::vector<char>(curves.size(), true), curves))
        throw std::runtime_error("the boundaries of the segments cannot be followed along the edges of the mesh");
    }
  }

  /// Whether each curve differs from the edges it comes from.
  const std::vector<char>& is_smoothed() const { return is_smoothed_; }

 private:
  static constexpr std::size_t most_attempts = 3;
  static constexpr double snap = 0.02;  ///< of an edge

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
  bool redraw(const std::vector<char>& is_faulty, std::vector<Surface_curve>& curves) {
    bool is_any = false;
    for (std::size_t c = 0; c < curves.size(); ++c) {
      if (!is_faulty[c] || !is_smoothed_[c]) continue;
      ++attempts_[c];
      draw(c, curves[c]);
      is_any = true;
    }
    return is_any;
  }

  /// Draws a curve: the more attempts have failed, the closer to the edges.
  void draw(std::size_t c, Surface_curve& curve) {
    for (; attempts_[c] < most_attempts; ++attempts_[c])
      if (auto nodes = smoothed(c)) {
        curve.nodes = std::move(*nodes);
        is_smoothed_[c] = true;
        return;
      }
    curve.nodes = nodes_of(surface_, chains_[c]);
    is_smoothed_[c] = false;
  }

  std::optional<std::vector<Curve_node>> smoothed(std::size_t c) const {
    const Boundary_chain& chain = chains_[c];
    const std::vector<Curve_point>& points = points_[c];
    const bool is_free = std::any_of(points.begin(), points.end(), [](const auto& p) { return !p.is_fixed(); });
    if (!(numbers_.corridor > 0) || !is_free || chain.halfedges.size() < (chain.is_closed ? 5 : 2) || is_ring(chain))
      return std::nullopt;

    // Between the points the curve may reach a little further out.
    constexpr double margin = 0.8;
    Curve_smoothing_numbers numbers = numbers_;
    numbers.corridor *= margin / static_cast<double>(std::size_t(1) << (2 * attempts_[c]));
    const Curve_smoothing smooth(surface_, lifted_, numbers);
    auto nodes = Curve_tracing(surface_, snap)(smooth(chain, points), chain.is_closed);
    if (!nodes || nodes->size() < 3) return std::nullopt;
    for (const Curve_node& node : *nodes)
      if (distance_to_chain(surface_, chain, node.origin, point_of(surface_, node)) > numbers_.corridor)
        return std::nullopt;
    return nodes;
  }

  const Triangle_surface& surface_;
  const Lifted_surface& lifted_;
  const std::vector<std::size_t>& segment_of_face_;
  Curve_smoothing_numbers numbers_;
  std::vector<Boundary_chain> chains_;
  std::vector<std::vector<Curve_point>> points_;  // of each chain, before it is smoothed
  std::vector<std::size_t> attempts_;
  std::vector<char> is_smoothed_;
};

}  // namespace RW_segmentation::internal

#endif
