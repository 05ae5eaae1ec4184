// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MERGING_CONSENSUS_COST_H
#define RW_SEGMENTATION_INTERNAL_MERGING_CONSENSUS_COST_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Region_boundary.h>
#include <RW_segmentation/internal/merging/Region_merging.h>
#include <RW_segmentation/internal/walk/Common_refinement.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// How far several seedings agree that two regions are one segment.
class Seeding_agreement {
 public:
  /// A part of a region.
  struct Share {
    std::size_t fragment;
    double weight;
  };
  /// The parts of a region in the fragments of every seeding, rising.
  using Region = std::vector<std::vector<Share>>;

  /// \param trees what merging made of the fragments of each seeding
  /// Complexity: O(k^2) time and memory for k fragments of each.
  explicit Seeding_agreement(const std::vector<Merge_tree>& trees);

  /// A region in one fragment of every seeding.
  static Region region(const std::vector<std::size_t>& fragments, double weight);

  /// Adds the parts of another region.
  static void join(Region& region, const Region& other);

  /// The mean over the seedings, and over pairs of points in the two regions, of 1 / (1 + h^2), where h is the cost at which
  /// merging joins the fragments of the two points: 1 for agreement that they are in one segment, 1/2 where it is as well to
  /// join them as not to.
  double operator()(const Region& a, const Region& b) const;

 private:
  std::vector<std::vector<float>> agreement_;  // of every seeding, by pair of fragments
  std::vector<std::size_t> fragments_;         // of every seeding
};

/// The merge cost of the pieces of a common refinement: sqrt(c exp(4 (1/2 - p))) with a cost c and the agreement p of
/// several seedings, each merged by c. The second factor is the odds that the seedings part two regions where these are
/// nearly even, and bounded where they are not. The cost is 1 where both say that it is as well to merge as not to.
///
/// Where fragments end is chance on smooth bodies, and it decides what is merged before what. Chance differs between seedings,
/// and so averages out.
template <class MergeCost, class Mesh>
class Consensus_cost {
 public:
  using Boundary = typename Boundaries_of_cost<MergeCost, Mesh>::Sums;
  struct Region {
    typename MergeCost::Region of_cost;
    Seeding_agreement::Region parts;
  };

  /// Keeps references to both.
  Consensus_cost(const MergeCost& cost, const Seeding_agreement& agreement) : cost_(cost), agreement_(agreement) {}

  void join(Region& region, const Region& other) const {
    cost_.join(region.of_cost, other.of_cost);
    Seeding_agreement::join(region.parts, other.parts);
  }

  Boundary boundary(const Mesh& mesh, Dual_mesh::Index edge, double difference) const {
    return Boundaries_of_cost<MergeCost, Mesh>::of_edge(cost_, mesh, edge, mesh.edge_length(edge) / mesh.length_unit(),
                                                        difference);
  }

  double operator()(const Region& a, const Region& b, const Region_boundary_of<Boundary>& boundary) const {
    // Of the Princeton meshes: 0.3 and 0.7 in place of the root agree as well with people where the number of segments is
    // found, and worse where it is given for 0.
    constexpr double slope_of_even_odds = 4;
    const auto cost = static_cast<double>(Boundaries_of_cost<MergeCost, Mesh>::ask(
        cost_, a.of_cost, b.of_cost, boundary.common, boundary.outline_of_first, boundary.outline_of_second));
    return std::sqrt(cost * std::exp(slope_of_even_odds * (0.5 - agreement_(a.parts, b.parts))));
  }

 private:
  const MergeCost& cost_;
  const Seeding_agreement& agreement_;
};

/// Merges the pieces of several seedings' common refinement to the end, after the fragments of each seeding by that cost
/// alone.
/// \param difference in the order of the edges
template <class Mesh, class MergeCost>
Merge_tree merge_by_consensus(const Mesh& mesh, const Common_refinement& refinement,
                              const std::vector<double>& difference, const MergeCost& cost, const Progress& progress) {
  using Consensus = Consensus_cost<MergeCost, Mesh>;
  constexpr double least_area = 1e-12;  // of a face, as a share of all: pieces without area have a weight, too
  const std::size_t pieces = refinement.fragments_of.size();
  auto of_cost = join_faces(refinement.of_face, pieces, cost, [&](Dual_mesh::Index f) { return cost.region(mesh, f); });
  const auto boundaries = region_boundaries(mesh, refinement.of_face, difference, cost);

  const std::size_t seedings = refinement.fragments_of.front().size();
  const auto share = [&](std::size_t done) { return static_cast<double>(done) / static_cast<double>(seedings + 1); };
  std::vector<Merge_tree> trees;
  for (std::size_t k = 0; k < seedings; ++k) {
    std::vector<std::size_t> fragment_of;
    fragment_of.reserve(pieces);
    for (const std::vector<std::size_t>& fragments : refinement.fragments_of) fragment_of.push_back(fragments[k]);
    const std::size_t fragments = *std::max_element(fragment_of.begin(), fragment_of.end()) + 1;
    auto of_fragments = join_faces(fragment_of, fragments, cost, [&](Dual_mesh::Index i) { return of_cost[i]; });
    trees.push_back(
        Region_merging<MergeCost, Mesh>(std::move(of_fragments), join_boundaries(boundaries, fragment_of), cost)
            .run(progress.part(share(k), share(k + 1))));
  }

  std::vector<double> weight(pieces, 0);
  for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f)
    weight[refinement.of_face[f]] += least_area + (mesh.total_area() > 0 ? mesh.area(f) / mesh.total_area() : 0);
  std::vector<typename Consensus::Region> regions;
  regions.reserve(pieces);
  for (std::size_t i = 0; i < pieces; ++i)
    regions.push_back({std::move(of_cost[i]), Seeding_agreement::region(refinement.fragments_of[i], weight[i])});
  const Seeding_agreement agreement(trees);
  const Consensus consensus(cost, agreement);
  typename Region_merging<Consensus, Mesh>::Boundaries of_consensus;
  of_consensus.reserve(boundaries.size());
  for (const auto& [neighbours, common] : boundaries) of_consensus.push_back({neighbours, {common.length, common}});
  return Region_merging<Consensus, Mesh>(std::move(regions), std::move(of_consensus), consensus)
      .run(progress.part(share(seedings), 1));
}

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Consensus_cost.h>
#endif

#endif
