// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_FLAT_SIDES_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_FLAT_SIDES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/mesh/Mesh_stretch.h>
#include <RW_segmentation/internal/surfaces/edge_angles.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// Tells flat sides of a solid that turn little against what is beside them, such as drafted ones, from the facets of its
/// curved surfaces.
///
/// Kernels mesh all curved surfaces of a solid to one deflection: no facet is farther off its surface. Facets of width w
/// that turn by a small angle phi from one to the next are w phi / 8 off it. A face for which that is far more than for most
/// others lies on no curved surface. Faces that were meshed evenly tell nothing: none of them is wide.
///
/// What comments tell of other values of a number was measured with `benchmark_engineering --suffix _t` on two sets of CAD
/// solids, of 28 and of 118: overlaps of .9849 and .9463 without flat sides, of .9895 and .9618 with the numbers as they are,
/// and more than before in both halves of either set. Of their 292 even meshes one loses more than .002, from .995 to .983.
class Flat_sides {
 public:
  using Index = Dual_mesh::Index;
  enum class Crease : char { none, likely, certain };

  /// Keeps references to both.
  /// \param angles of all edges, in radians
  /// \param component whose curved surfaces are reckoned to have one deflection
  Flat_sides(const Dual_mesh& mesh, const std::vector<double>& angles, const Mesh_stretch& component)
      : mesh_(mesh), angles_(angles) {
    constexpr double most_widths = 0.75, most_deflections = 0.9, widespread_deflections = 0.75;  // of the edges
    // Where more than a tenth of the edges are creases, the deflection of nine tenths is a crease's. Without this, overlaps of
    // .9895 and .9693; with it, of .9895 and .9703, as at 3, and .9702 at 6. Of the edges of all 146 solids it tells 631 more,
    // none of them within a face.
    constexpr double times_the_widespread = 4;
    // At 1, overlaps of .9895 and .9613; at 2, of .9895 and .9570.
    constexpr double times_the_width = 1.5;
    // At 2, overlaps of .9895 and .9639; at 3, of .9895 and .9611.
    constexpr double times_the_deflection = 2.5;
    // Of the edges of all 146 solids 6603 are beyond it, none of them within a face; beyond five times, 74 of 10381 are. From
    // 3.5 to ten times the overlap is the same.
    constexpr double times_when_certain = 10;
    std::vector<double> widths, deflections;
    for (Index e = component.first_edge; e < component.first_edge + component.edges; ++e) {
      if (!may_be_smooth(e)) continue;
      const double width = widths_beside(e).wider;
      widths.push_back(width);
      deflections.push_back(deflection(width, e));
    }
    if (widths.empty()) return;
    largest_width_ = times_the_width * quantile(widths, most_widths);
    const double usual_deflection = std::min(quantile(deflections, most_deflections),
                                             times_the_widespread * quantile(deflections, widespread_deflections));
    largest_deflection_ = times_the_deflection * usual_deflection;
    certain_deflection_ = times_when_certain * usual_deflection;
  }

  /// How surely an edge is a crease between a flat side and another face.
  Crease crease_at(Index edge) const {
    // Steps of an arc are even, and on large ones wide. Without that, overlaps of .9872 and .9610; at .9, of .9895 and .9614.
    constexpr double even = 0.95;
    if (!may_be_smooth(edge)) return Crease::none;
    const Widths widths = widths_beside(edge);
    const double off = deflection(widths.wider, edge);
    if (widths.narrower >= even * widths.wider || widths.wider <= largest_width_ || off <= largest_deflection_)
      return Crease::none;
    return off > certain_deflection_ ? Crease::certain : Crease::likely;
  }

 private:
  /// Of the faces beside an edge, across it.
  struct Widths {
    double narrower, wider;
  };

  /// Whether faces turn at an edge, and so little that they could be facets of one surface.
  bool may_be_smooth(Index edge) const {
    // Beyond 40 degrees edges are creases anyway. Up to 25 alone, overlaps of .9885 and .9609.
    constexpr double least = radians(0.5), most = radians(40);
    return angles_[edge] >= least && angles_[edge] <= most && mesh_.edge_length(edge) > 0;
  }

  Widths widths_beside(Index edge) const {
    const auto [f, g] = mesh_.graph().faces_of(edge);
    const double a = width_of(f, edge), b = width_of(g, edge);
    return {std::min(a, b), std::max(a, b)};
  }

  /// Of the quadrilateral that a triangle is half of, as kernels cut them.
  double width_of(Index face, Index edge) const {
    return (mesh_.corners(face).size() == 3 ? 2 : 1) * mesh_.area(face) / mesh_.edge_length(edge);
  }

  double deflection(double width, Index edge) const { return width * angles_[edge] / 8; }

  static double quantile(std::vector<double>& values, double part) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size()));
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  const Dual_mesh& mesh_;
  const std::vector<double>& angles_;
  double largest_width_ = std::numeric_limits<double>::infinity();       // of facets of curved surfaces
  double largest_deflection_ = std::numeric_limits<double>::infinity();  // likewise
  double certain_deflection_ = std::numeric_limits<double>::infinity();  // of any facet of theirs, however odd
};

/// By edge, of a mesh without noise, which would turn flat sides as well.
/// \param angles of the edges, in radians
inline std::vector<Flat_sides::Crease> creases_of_flat_sides(const Dual_mesh& mesh, const std::vector<double>& angles) {
  std::vector<Flat_sides::Crease> creases(mesh.number_of_edges(), Flat_sides::Crease::none);
  for (const Mesh_stretch& component : connected_stretches(mesh.graph())) {
    const Flat_sides sides(mesh, angles, component);
    for (Dual_mesh::Index e = component.first_edge; e < component.first_edge + component.edges; ++e)
      creases[e] = sides.crease_at(e);
  }
  return creases;
}

}  // namespace RW_segmentation::internal

#endif
