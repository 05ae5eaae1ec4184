// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MERGING_REGION_MERGING_H
#define RW_SEGMENTATION_INTERNAL_MERGING_REGION_MERGING_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Region_boundary.h>
#include <RW_segmentation/internal/merging/Merge_queue.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// The sums along boundaries that a merge cost is asked with, and how it is asked: `Edge_sums` unless it has a type
/// `Boundary` and a function `boundary()`.
template <class Cost, class Mesh, class = void>
struct Boundaries_of_cost {
  static constexpr bool are_its_own = false;
  using Sums = Edge_sums;

  static Sums of_edge(const Cost&, const Mesh&, Dual_mesh::Index, double length, double difference) {
    return {length, length * difference};
  }

  template <class Region>
  static auto ask(const Cost& cost, const Region& a, const Region& b, const Sums& common, const Sums& outline_of_a,
                  const Sums& outline_of_b) -> decltype(cost(a, b, std::declval<const Region_boundary&>())) {
    const Edge_sums whole = {outline_of_a.length + (outline_of_b.length - common.length),
                             outline_of_a.difference + (outline_of_b.difference - common.difference)};
    return cost(a, b, Region_boundary{common, whole});
  }
};
template <class Cost, class Mesh>
struct Boundaries_of_cost<Cost, Mesh,
                          std::void_t<decltype(typename Cost::Boundary(std::declval<const Cost&>().boundary(
                              std::declval<const Mesh&>(), Dual_mesh::Index(), double())))>> {
  static constexpr bool are_its_own = true;
  struct Sums {
    double length = 0;
    typename Cost::Boundary own = {};
    Sums& operator+=(const Sums& other) {
      length += other.length;
      own += other.own;
      return *this;
    }
  };

  static Sums of_edge(const Cost& cost, const Mesh& mesh, Dual_mesh::Index edge, double length, double difference) {
    return {length, cost.boundary(mesh, edge, difference)};
  }

  template <class Region>
  static auto ask(const Cost& cost, const Region& a, const Region& b, const Sums& common, const Sums& outline_of_a,
                  const Sums& outline_of_b)
      -> decltype(cost(a, b, std::declval<const Region_boundary_of<typename Cost::Boundary>&>())) {
    return cost(a, b, Region_boundary_of<typename Cost::Boundary>{common.own, outline_of_a.own, outline_of_b.own});
  }
};

template <class Cost, class Mesh, class = void>
struct Is_merge_cost : std::false_type {};
template <class Cost, class Mesh>
struct Is_merge_cost<
    Cost, Mesh,
    std::void_t<typename Cost::Region,
                decltype(typename Cost::Region(
                    std::declval<const Cost&>().region(std::declval<const Mesh&>(), Dual_mesh::Index()))),
                decltype(std::declval<const Cost&>().join(std::declval<typename Cost::Region&>(),
                                                          std::declval<const typename Cost::Region&>())),
                decltype(static_cast<double>(Boundaries_of_cost<Cost, Mesh>::ask(
                    std::declval<const Cost&>(), std::declval<const typename Cost::Region&>(),
                    std::declval<const typename Cost::Region&>(),
                    std::declval<const typename Boundaries_of_cost<Cost, Mesh>::Sums&>(),
                    std::declval<const typename Boundaries_of_cost<Cost, Mesh>::Sums&>(),
                    std::declval<const typename Boundaries_of_cost<Cost, Mesh>::Sums&>())))>> : std::true_type {};

/// Whether it is a `MergeCost` for a kind of mesh.
template <class Cost, class Mesh>
constexpr bool is_merge_cost = Is_merge_cost<Cost, Mesh>::value;

/// The edges between two neighbouring regions, the lower region first.
template <class Sums>
struct Boundary_of_regions {
  std::array<Dual_mesh::Index, 2> regions;
  Sums common;
};

/// An edge between two neighbouring regions, the lower region first.
struct Crossing {
  std::array<Dual_mesh::Index, 2> regions;
  Dual_mesh::Index edge;
};

/// The edges between neighbouring regions, sorted by their regions, then by edge.
/// Regions are no neighbours across a wall, which counts as little as the border of the mesh.
std::vector<Crossing> region_crossings(const Dual_mesh& mesh, const std::vector<std::size_t>& region_of_face);

/// The boundaries between neighbouring regions, sorted by their regions.
template <class MergeCost, class Mesh>
auto region_boundaries(const Mesh& mesh, const std::vector<std::size_t>& region_of_face,
                       const std::vector<double>& difference, const MergeCost& cost) {
  using Asking = Boundaries_of_cost<MergeCost, Mesh>;
  const double unit = mesh.length_unit();
  std::vector<Boundary_of_regions<typename Asking::Sums>> boundaries;
  for (const auto& [regions, e] : region_crossings(mesh, region_of_face)) {
    if (boundaries.empty() || boundaries.back().regions != regions) boundaries.push_back({regions, {}});
    boundaries.back().common += Asking::of_edge(cost, mesh, e, mesh.edge_length(e) / unit, difference[e]);
  }
  return boundaries;
}

/// The boundaries between regions that are joined from others.
/// \param boundaries between the others
/// \param region_of the region that each of them goes to
template <class Sums>
std::vector<Boundary_of_regions<Sums>> join_boundaries(const std::vector<Boundary_of_regions<Sums>>& boundaries,
                                                       const std::vector<std::size_t>& region_of) {
  std::vector<std::pair<std::array<Dual_mesh::Index, 2>, std::size_t>> remaining;
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    const auto [i, j] = boundaries[b].regions;
    const auto [low, high] = std::minmax(region_of[i], region_of[j]);
    if (low != high)
      remaining.push_back({{static_cast<Dual_mesh::Index>(low), static_cast<Dual_mesh::Index>(high)}, b});
  }
  std::sort(remaining.begin(), remaining.end());
  std::vector<Boundary_of_regions<Sums>> joined;
  for (const auto& [regions, b] : remaining) {
    if (joined.empty() || joined.back().regions != regions) joined.push_back({regions, {}});
    joined.back().common += boundaries[b].common;
  }
  return joined;
}

/// Merges neighbouring regions, cheapest first, until no two neighbours are left.
///
/// Each merge visits the neighbours of the two regions and no others. With equal costs the pair that came first in the
/// order of the boundaries is merged first.
template <class MergeCost, class Mesh = Dual_mesh>
class Region_merging {
 public:
  using Index = Dual_mesh::Index;
  using Region = typename MergeCost::Region;
  using Boundary_sums = typename Boundaries_of_cost<MergeCost, Mesh>::Sums;
  using Boundaries = std::vector<Boundary_of_regions<Boundary_sums>>;

  Region_merging(std::vector<Region> regions, Boundaries boundaries, const MergeCost& cost)
      : cost_(cost),
        region_(std::move(regions)),
        outline_(region_.size()),
        boundaries_of_(region_.size()),
        boundary_to_(region_.size(), none),
        boundary_(std::move(boundaries)) {
    for (Index b = 0; b < boundary_.size(); ++b)
      for (const Index r : boundary_[b].regions) {
        outline_[r] += boundary_[b].common;
        boundaries_of_[r].push_back(b);
      }
    std::vector<double> costs(boundary_.size());
    for (Index b = 0; b < boundary_.size(); ++b) costs[b] = cost_of(b);
    queue_ = Merge_queue(costs);
  }

  /// Merges to the end, once.
  Merge_tree run(const Progress& progress) {
    constexpr std::size_t merges_between_reports = 100;
    std::vector<std::size_t> number(region_.size());  // of each region in the tree
    std::iota(number.begin(), number.end(), std::size_t(0));
    std::vector<Merge_tree::Merge> merges;
    while (!queue_.empty()) {
      if (merges.size() % merges_between_reports == 0)
        progress(static_cast<double>(merges.size()) / static_cast<double>(region_.size()));
      const auto [cost, boundary] = queue_.top();
      const auto [kept, absorbed] = boundary_[boundary].regions;
      const auto [first, second] = std::minmax(number[kept], number[absorbed]);
      merges.push_back({first, second, cost});
      number[kept] = number.size() - 1 + merges.size();
      join(boundary);
    }
    return Merge_tree(region_.size(), std::move(merges));
  }

 private:
  static constexpr Index none = std::numeric_limits<Index>::max();

  double cost_of(Index boundary) const {
    const auto& [regions, common] = boundary_[boundary];
    // Regions that touch only along edges without length come last, and no threshold joins them.
    if (!(common.length > 0)) return std::numeric_limits<double>::infinity();
    const auto [a, b] = regions;
    const double cost = static_cast<double>(
        Boundaries_of_cost<MergeCost, Mesh>::ask(cost_, region_[a], region_[b], common, outline_[a], outline_[b]));
    if (std::isnan(cost)) throw std::invalid_argument("the merge cost of two regions is NaN");
    return cost;
  }

  Index neighbour_of(Index region, Index boundary) const {
    const auto [a, b] = boundary_[boundary].regions;
    return a == region ? b : a;
  }

  /// The lists of the two regions forget the boundary when they are next read.
  void remove(Index boundary) {
    queue_.erase(boundary);
    boundary_[boundary].regions = {none, none};
  }
  bool is_removed(Index boundary) const { return boundary_[boundary].regions[0] == none; }

  /// Makes one region of the two beside a boundary.
  void join(Index joint) {
    const auto [kept, absorbed] = boundary_[joint].regions;
    remove(joint);
    cost_.join(region_[kept], region_[absorbed]);

    std::vector<Index> joined;
    for (const Index b : boundaries_of_[kept]) {
      if (is_removed(b)) continue;
      boundary_to_[neighbour_of(kept, b)] = b;
      joined.push_back(b);
    }
    for (const Index b : boundaries_of_[absorbed]) {
      if (is_removed(b)) continue;
      const Index neighbour = neighbour_of(absorbed, b), parallel = boundary_to_[neighbour];
      if (parallel != none) {
        boundary_[parallel].common += boundary_[b].common;
        remove(b);
      } else {
        boundary_[b].regions = {std::min(kept, neighbour), std::max(kept, neighbour)};
        joined.push_back(b);
      }
    }

    outline_[kept] = {};
    for (const Index b : joined) outline_[kept] += boundary_[b].common;
    for (const Index b : joined) {
      boundary_to_[neighbour_of(kept, b)] = none;
      queue_.update(b, cost_of(b));
    }
    boundaries_of_[kept] = std::move(joined);
    boundaries_of_[absorbed].clear();
  }

  const MergeCost& cost_;
  std::vector<Region> region_;
  std::vector<Boundary_sums> outline_;             // of each region
  std::vector<std::vector<Index>> boundaries_of_;  // each region
  std::vector<Index> boundary_to_;                 // each neighbour of the region at hand
  Boundaries boundary_;
  Merge_queue queue_;
};

/// The regions of fragments, made by joining those of their faces.
/// \param region_of_face a function from a face to its region
template <class MergeCost, class RegionOfFace>
std::vector<typename MergeCost::Region> join_faces(const std::vector<std::size_t>& fragment_of_face,
                                                   std::size_t number_of_fragments, const MergeCost& cost,
                                                   const RegionOfFace& region_of_face) {
  std::vector<typename MergeCost::Region> regions(number_of_fragments);
  std::vector<char> is_begun(number_of_fragments, false);
  for (std::size_t f = 0; f < fragment_of_face.size(); ++f) {
    const std::size_t fragment = fragment_of_face[f];
    if (is_begun[fragment])
      cost.join(regions[fragment], region_of_face(static_cast<Dual_mesh::Index>(f)));
    else
      regions[fragment] = region_of_face(static_cast<Dual_mesh::Index>(f));
    is_begun[fragment] = true;
  }
  return regions;
}

/// Merges fragments to the end.
///
/// \param mesh a `Dual_mesh`, or a `Dual_mesh_of` for costs that ask for descriptors
/// \param fragment_of_face numbers from 0 to `number_of_fragments` - 1
/// \param difference in the order of the edges
template <class Mesh, class MergeCost>
Merge_tree merge_fragments(const Mesh& mesh, const std::vector<std::size_t>& fragment_of_face,
                           std::size_t number_of_fragments, const std::vector<double>& difference,
                           const MergeCost& cost, const Progress& progress) {
  auto regions =
      join_faces(fragment_of_face, number_of_fragments, cost, [&](Dual_mesh::Index f) { return cost.region(mesh, f); });
  return Region_merging<MergeCost, Mesh>(std::move(regions),
                                         region_boundaries(mesh, fragment_of_face, difference, cost), cost)
      .run(progress);
}

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/region_boundaries.h>
#endif

#endif
