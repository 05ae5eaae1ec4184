#ifndef RW_SEGMENTATION_MERGE_SEGMENTS_H
#define RW_SEGMENTATION_MERGE_SEGMENTS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Region_boundary.h>
#include <RW_segmentation/Relative_boundary_cost.h>
#include <RW_segmentation/Segment_hierarchy.h>
#include <RW_segmentation/Size_aware_cost.h>
#include <RW_segmentation/internal/Edge_values.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/read_segments.h>

#include <CGAL/Named_function_parameters.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/heap/d_ary_heap.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

/// The edges between two neighbouring regions, the lower region first.
struct Boundary_of_regions {
  std::array<Dual_graph::Index, 2> regions;
  Edge_sums common;
};

/// The boundaries between neighbouring regions, sorted by their regions.
inline std::vector<Boundary_of_regions> region_boundaries(const Dual_graph& graph,
                                                          const std::vector<std::size_t>& region_of_face,
                                                          const std::vector<double>& edge_length,
                                                          const std::vector<double>& difference, double unit) {
  using Index = Dual_graph::Index;
  struct Crossing {
    std::array<Index, 2> regions;
    Index edge;
    bool operator<(const Crossing& other) const {
      return std::tie(regions, edge) < std::tie(other.regions, other.edge);
    }
  };
  std::vector<Crossing> crossings;
  for (Index e = 0; e < graph.number_of_edges(); ++e) {
    const auto [f, g] = graph.faces_of(e);
    const auto a = static_cast<Index>(region_of_face[f]), b = static_cast<Index>(region_of_face[g]);
    if (a != b) crossings.push_back({{std::min(a, b), std::max(a, b)}, e});
  }
  std::sort(crossings.begin(), crossings.end());

  std::vector<Boundary_of_regions> boundaries;
  for (const auto& [regions, e] : crossings) {
    if (boundaries.empty() || boundaries.back().regions != regions) boundaries.push_back({regions, {}});
    const double length = edge_length[e] / unit;
    boundaries.back().common += {length, length * difference[e]};
  }
  return boundaries;
}

/// Merges neighbouring regions, cheapest first, until no two neighbours are left.
///
/// Each merge visits the neighbours of the two regions and no others. With equal costs the pair that came first in the
/// order of the boundaries is merged first.
template <class MergeCost>
class Region_merging {
 public:
  using Index = Dual_graph::Index;
  using Region = typename MergeCost::Region;

  Region_merging(std::vector<Region> regions, std::vector<Boundary_of_regions> boundaries, const MergeCost& cost)
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
    place_.reserve(boundary_.size());
    for (Index b = 0; b < boundary_.size(); ++b) place_.push_back(queue_.push({cost_of(b), b}));
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

  struct Candidate {
    double cost;
    Index boundary;
    bool operator<(const Candidate& other) const {  // the heap's top is the largest
      return std::tie(other.cost, other.boundary) < std::tie(cost, boundary);
    }
  };
  using Queue = boost::heap::d_ary_heap<Candidate, boost::heap::arity<4>, boost::heap::mutable_<true>>;

  double cost_of(Index boundary) const {
    const auto& [regions, common] = boundary_[boundary];
    // Regions that touch only along edges without length come last, and no threshold joins them.
    if (!(common.length > 0)) return std::numeric_limits<double>::infinity();
    const Edge_sums &a = outline_[regions[0]], &b = outline_[regions[1]];
    const Edge_sums whole = {a.length + (b.length - common.length), a.difference + (b.difference - common.difference)};
    const double cost = cost_(region_[regions[0]], region_[regions[1]], Region_boundary{common, whole});
    if (std::isnan(cost)) throw std::invalid_argument("the merge cost of two regions is NaN");
    return cost;
  }

  Index neighbour_of(Index region, Index boundary) const {
    const auto [a, b] = boundary_[boundary].regions;
    return a == region ? b : a;
  }

  /// The lists of the two regions forget the boundary when they are next read.
  void remove(Index boundary) {
    queue_.erase(place_[boundary]);
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
      queue_.update(place_[b], {cost_of(b), b});
    }
    boundaries_of_[kept] = std::move(joined);
    boundaries_of_[absorbed].clear();
  }

  const MergeCost& cost_;
  std::vector<Region> region_;
  std::vector<Edge_sums> outline_;                 // of each region
  std::vector<std::vector<Index>> boundaries_of_;  // each region
  std::vector<Index> boundary_to_;                 // each neighbour of the region at hand
  std::vector<Boundary_of_regions> boundary_;
  Queue queue_;
  std::vector<typename Queue::handle_type> place_;  // of each boundary in the queue
};

/// The length R in which boundaries are measured.
inline double region_unit(const Face_geometry& geometry) {
  return geometry.total_area > 0 ? std::sqrt(geometry.total_area) : 1;
}

/// The core of `merge_segments()`.
///
/// \param fragment_of_face numbers from 0 to the number of `regions` - 1
/// \param regions of the fragments
/// \param unit the length R in the unit of `edge_length`
template <class MergeCost>
Merge_tree merge_fragments(const Dual_graph& graph, const std::vector<std::size_t>& fragment_of_face,
                           std::vector<typename MergeCost::Region> regions, const std::vector<double>& edge_length,
                           const std::vector<double>& difference, double unit, const MergeCost& cost,
                           const Progress& progress) {
  Region_merging<MergeCost> merging(std::move(regions),
                                    region_boundaries(graph, fragment_of_face, edge_length, difference, unit), cost);
  return merging.run(progress);
}

/// The regions of fragments, made by joining those of their faces.
template <class MergeCost, class RegionOfFace>
std::vector<typename MergeCost::Region> join_faces(const std::vector<std::size_t>& fragment_of_face,
                                                   std::size_t number_of_fragments, const MergeCost& cost,
                                                   const RegionOfFace& region_of_face) {
  std::vector<typename MergeCost::Region> regions(number_of_fragments);
  std::vector<char> is_begun(number_of_fragments, false);
  for (std::size_t f = 0; f < fragment_of_face.size(); ++f) {
    const std::size_t fragment = fragment_of_face[f];
    if (is_begun[fragment])
      cost.join(regions[fragment], region_of_face(f));
    else
      regions[fragment] = region_of_face(f);
    is_begun[fragment] = true;
  }
  return regions;
}

}  // namespace internal

/// Merges the segments of a mesh pairwise, always the two neighbours that cost least, until each connected component is
/// one segment, and records every merge (4.2.2).
///
/// When to stop is decided afterwards, by `Segment_hierarchy::segments()`, as often as wished:
/// \code
/// Segment_hierarchy hierarchy = merge_segments(mesh, ids, difference, Size_aware_cost(mesh));
/// hierarchy.segments(Segment_count_stop(6), ids);
/// \endcode
///
/// Segments are neighbours if they share a mesh edge. Those that share only edges without length are merged last, at
/// infinite cost. Equal costs: the pair with the lowest segment comes first. The result does not depend on the order of
/// the faces otherwise.
///
/// Complexity: O(m + b log b) for m faces and b edges between segments, and O(k log n) for each merge of two segments
/// with k neighbours out of n.
///
/// \tparam FaceListGraph a model of CGAL's `FaceListGraph`
/// \tparam SegmentIdMap a readable property map from `face_descriptor` to any integers; it may hold them with gaps
/// \tparam Difference a readable property map from `edge_descriptor` to a number >= 0, as for `Conductance`
/// \tparam MergeCost a model of `MergeCost`: a type `Region` (default-constructible, copyable), `region(face)` for a
/// region of one face, `join(region, other)` to enlarge a region, `operator()(region, region, Region_boundary)` for the
/// cost of merging two, symmetric, not NaN; all of them const
/// \tparam NamedParameters a sequence of CGAL's named parameters
/// \param mesh the mesh
/// \param segment_ids the segments to start from, the fragments
/// \param difference how different the two faces of an edge are
/// \param cost of merging two segments
/// \param np `vertex_point_map` (default: that of the mesh), `callback` (`std::function<bool(double)>`, default: none)
/// \returns the hierarchy; its fragments are numbered in the order of the given ids
/// \throws std::invalid_argument if a difference is negative or NaN (names the faces), a coordinate not finite (names
/// the vertex), or a cost NaN
/// \throws Cancelled
template <class FaceListGraph, class SegmentIdMap, class Difference, class MergeCost,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
Segment_hierarchy<FaceListGraph> merge_segments(const FaceListGraph& mesh, const SegmentIdMap& segment_ids,
                                                const Difference& difference, const MergeCost& cost,
                                                const NamedParameters& np = CGAL::parameters::default_values()) {
  using face_descriptor = typename boost::graph_traits<FaceListGraph>::face_descriptor;
  static_assert(internal::is_readable_map<SegmentIdMap, face_descriptor>,
                "segment_ids must be a readable property map from the mesh's face_descriptor to an integer.");

  const Mesh_dual_graph<FaceListGraph> graph(mesh);
  const internal::Face_geometry geometry = internal::face_geometry(mesh, graph, np);
  const std::vector<double> d = internal::read_edge_values(graph, difference, "the difference");

  std::vector<typename boost::property_traits<SegmentIdMap>::value_type> ids;
  ids.reserve(graph.number_of_faces());
  for (const face_descriptor f : graph.face_descriptors()) ids.push_back(get(segment_ids, f));
  std::vector<std::size_t> fragment_of_face;
  const std::size_t fragments = internal::rank_labels(ids, fragment_of_face).size();

  Merge_tree tree = internal::merge_fragments(
      graph, fragment_of_face,
      internal::join_faces(fragment_of_face, fragments, cost,
                           [&](std::size_t f) { return cost.region(graph.face_descriptors()[f]); }),
      geometry.edge_length, d, internal::region_unit(geometry), cost, internal::progress_of(np));
  return {std::move(tree), graph.face_descriptors(), std::move(fragment_of_face)};
}

}  // namespace RW_segmentation

#endif
