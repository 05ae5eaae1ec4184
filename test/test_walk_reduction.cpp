// SPDX-License-Identifier: MIT

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Eigen_walk_solver.h>
#include <RW_segmentation/Learned_cost.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/Walk_reduction.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/fragments_via_random_walks.h>
#include <RW_segmentation/internal/walk/settle_band.h>
#include <RW_segmentation/internal/walk/walk_fragments.h>
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <boost/property_map/function_property_map.hpp>

#include <gtest/gtest.h>
#include "../benchmark/segmentation_measures.h"
#include "face_labels.h"
#include "meshes.h"
#include "networks.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace test_walk_reduction {

using namespace RW_segmentation;
using internal::Face_clusters;
using networks::Index;
using Face = meshes::Surface_mesh::Face_index;

namespace {

std::vector<char> all_crossed(const Dual_graph& graph) { return std::vector<char>(graph.number_of_edges(), true); }

std::vector<double> random_conductances(const Dual_graph& graph) {
  std::mt19937 random(1);
  return networks::spread_conductances(graph.number_of_edges(), 2, random);
}

/// Faces in a row.
Dual_graph path(std::size_t faces) {
  std::vector<std::array<Index, 2>> edges;
  for (Index f = 1; f < faces; ++f) edges.push_back({f - 1, f});
  return Dual_graph(faces, edges);
}

Automatic_segmentation reduced(std::size_t segments) {
  Automatic_segmentation policy(segments);
  policy.reduction.largest_direct = 0;
  return policy;
}

struct Result {
  std::vector<std::size_t> ids;
  Segmentation_report report;
};

template <class Np = CGAL::parameters::Default_named_parameters>
Result segmented(const meshes::Surface_mesh& mesh, const Automatic_segmentation& policy,
                 const std::vector<meshes::Surface_mesh::Face_index>& given = {},
                 const Np& np = CGAL::parameters::default_values()) {
  Face_labels<meshes::Surface_mesh> ids(mesh);
  const auto hierarchy = hierarchy_via_random_walks(mesh, policy, given, np);
  hierarchy.segments([&](const Merge_tree& tree) { return policy.stop(tree); }, ids.map());
  return {ids.values(), hierarchy.report()};
}

}  // namespace

TEST(FaceClusters, EachIsConnectedAndCrossesNoForbiddenEdge) {
  const Dual_graph graph = networks::triangulated_torus(20);
  std::vector<char> is_crossed = all_crossed(graph);
  std::mt19937 random(1);
  for (char& crossed : is_crossed) crossed = random() % 4 != 0;
  const Face_clusters clusters(graph, random_conductances(graph), is_crossed, 3, {});
  // Joined over edges that may be crossed within a cluster, faces make as many components as there are clusters.
  std::vector<double> within(graph.number_of_edges());
  for (Index e = 0; e < within.size(); ++e) {
    const auto [f, g] = graph.faces_of(e);
    within[e] = is_crossed[e] && clusters.of_face[f] == clusters.of_face[g];
  }
  EXPECT_EQ(networks::components(graph, within).count, clusters.root.size());
  for (std::size_t c = 0; c < clusters.root.size(); ++c) EXPECT_EQ(clusters.of_face[clusters.root[c]], c);
}

TEST(FaceClusters, RootsKeepTheirDistanceAndLeaveNoFaceFartherOff) {
  const Dual_graph graph = networks::triangulated_torus(20);
  constexpr std::size_t steps = 4;
  const Face_clusters clusters(graph, random_conductances(graph), all_crossed(graph), steps, {});
  for (const Index root : clusters.root) {
    std::vector<Index> near = {root};
    internal::add_surroundings(graph, steps, near);
    EXPECT_EQ(std::count_if(near.begin(), near.end(), [&](Index f) { return clusters.root[clusters.of_face[f]] == f; }),
              1)
        << root;
  }
  std::vector<Index> reached = clusters.root;
  internal::add_surroundings(graph, steps, reached);
  EXPECT_EQ(reached.size(), graph.number_of_faces());
}

/// How many steps over edges that may be crossed lead from a face to each other one; -1 where none do.
std::vector<int> steps_from(Index face, const Dual_graph& graph, const std::vector<char>& is_crossed) {
  std::vector<int> steps(graph.number_of_faces(), -1);
  steps[face] = 0;
  std::vector<Index> reached = {face};
  for (std::size_t next = 0; next < reached.size(); ++next)
    for (const auto& [neighbour, edge] : graph.neighbours(reached[next])) {
      if (!is_crossed[edge] || steps[neighbour] >= 0) continue;
      steps[neighbour] = steps[reached[next]] + 1;
      reached.push_back(neighbour);
    }
  return steps;
}

/// The least resistance of ways from a face that take as few steps as can be, by face.
std::vector<double> resistances_from(Index face, const std::vector<int>& steps, const Dual_graph& graph,
                                     const std::vector<char>& is_crossed, const std::vector<double>& conductances) {
  std::vector<double> least(graph.number_of_faces(), std::numeric_limits<double>::infinity());
  least[face] = 0;
  for (int step = 1; step <= *std::max_element(steps.begin(), steps.end()); ++step)
    for (Index f = 0; f < least.size(); ++f) {
      if (steps[f] != step) continue;
      for (const auto& [neighbour, edge] : graph.neighbours(f))
        if (is_crossed[edge] && steps[neighbour] == step - 1)
          least[f] = std::min(least[f], least[neighbour] + 1 / conductances[edge]);
    }
  return least;
}

TEST(FaceClusters, AFaceBelongsToTheNearestRootOverTheLeastResistance) {
  const Dual_graph graph = networks::triangulated_torus(16);
  const std::vector<double> conductances = random_conductances(graph);
  std::vector<char> is_crossed = all_crossed(graph);
  std::mt19937 random(2);
  for (char& crossed : is_crossed) crossed = random() % 6 != 0;
  for (const std::size_t steps : {1U, 3U, 8U, 50U}) {
    const Face_clusters clusters(graph, conductances, is_crossed, steps, {});
    std::vector<int> fewest(graph.number_of_faces(), -1);
    std::vector<Index> nearest(graph.number_of_faces());  // the first of several
    std::vector<double> resistance(graph.number_of_faces());
    for (Index c = 0; c < clusters.root.size(); ++c) {
      const std::vector<int> from_root = steps_from(clusters.root[c], graph, is_crossed);
      const auto resistances = resistances_from(clusters.root[c], from_root, graph, is_crossed, conductances);
      for (Index f = 0; f < graph.number_of_faces(); ++f) {
        if (from_root[f] < 0 || (fewest[f] >= 0 && fewest[f] <= from_root[f])) continue;
        fewest[f] = from_root[f];
        nearest[f] = c;
        resistance[f] = resistances[f];
      }
    }
    EXPECT_EQ(clusters.of_face, nearest) << steps << " steps";
    for (Index f = 0; f < graph.number_of_faces(); ++f) EXPECT_NEAR(clusters.resistance[f], resistance[f], 1e-12);
  }
}

TEST(FaceClusters, FacesToBeLeftAloneAreTheFirstClusters) {
  const Dual_graph graph = networks::triangulated_torus(10);
  const std::vector<Index> alone = {17, 3, 18, 150};
  const Face_clusters clusters(graph, random_conductances(graph), all_crossed(graph), 3, alone);
  for (std::size_t c = 0; c < alone.size(); ++c) {
    EXPECT_EQ(clusters.root[c], alone[c]);
    EXPECT_EQ(std::count(clusters.of_face.begin(), clusters.of_face.end(), c), 1);
  }
}

TEST(FaceClusters, ResistancesInARowAddUpToThoseOfTheFaces) {
  const Dual_graph graph = path(200);
  const std::vector<double> conductances = random_conductances(graph);
  const Face_clusters clusters(graph, conductances, all_crossed(graph), 5, {0, 199});
  ASSERT_EQ(clusters.graph.number_of_edges() + 1, clusters.root.size());
  const auto resistance = [](const std::vector<double>& c) {
    return std::accumulate(c.begin(), c.end(), 0., [](double sum, double value) { return sum + 1 / value; });
  };
  EXPECT_NEAR(resistance(clusters.conductances) / resistance(conductances), 1, 1e-12);
}

TEST(FaceClusters, AnEdgeThatDoesNotConductCutsTheirNetwork) {
  const Dual_graph graph = path(20);
  std::vector<double> conductances(19, 1.);
  std::vector<char> is_crossed = all_crossed(graph);
  conductances[9] = 0;
  is_crossed[9] = false;
  const Face_clusters clusters(graph, conductances, is_crossed, 3, {});
  EXPECT_EQ(networks::components(clusters.graph, clusters.conductances).count, 2u);
}

TEST(SettleBand, OverTheWholeGraphItIsTheWalkFromTheSeeds) {
  const Dual_graph graph = networks::triangulated_torus(16);
  const std::vector<double> conductances = random_conductances(graph);
  const std::vector<Index> seeds = {5, 100, 300};
  const std::vector<std::size_t> walked = internal::walk_labels(graph, conductances, seeds, {0, 1, 2});
  std::vector<std::size_t> labels(graph.number_of_faces(), 7);
  for (std::size_t s = 0; s < seeds.size(); ++s) labels[seeds[s]] = s;
  internal::settle_band(graph, conductances, {std::vector<char>(graph.number_of_faces(), true), seeds}, labels, {});
  EXPECT_EQ(labels, walked);
}

TEST(SettleBand, FacesOutsideAndPartsWithoutAnyKeepTheirLabels) {
  const Dual_graph graph(8, {{0, 1}, {1, 2}, {2, 3}, {4, 5}, {6, 7}});
  std::vector<std::size_t> labels = {0, 0, 1, 1, 2, 3, 4, 5};
  internal::settle_band(graph, {1, 10, 1, 1, 1}, {{false, true, true, true, true, true, false, false}, {}}, labels, {});
  EXPECT_EQ(labels, (std::vector<std::size_t>{0, 0, 0, 0, 2, 3, 4, 5}));
}

TEST(SettleBand, ABandReachesSoManyNodesFromABoundary) {
  EXPECT_EQ(internal::band_along_boundaries(path(10), {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}, 0).size(), 0u);
  EXPECT_EQ(internal::band_along_boundaries(path(10), {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}, 1).size(), 2u);
  EXPECT_EQ(internal::band_along_boundaries(path(10), {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}, 3).size(), 6u);
  EXPECT_EQ(internal::band_along_boundaries(path(10), std::vector<std::size_t>(10, 4), 3).size(), 0u);
}

TEST(SettleBand, FragmentsAreUnionsOfClustersWithoutABandAndThoseOfTheFacesWithOneOverAll) {
  const Dual_graph graph = networks::triangulated_torus(24);
  const std::vector<double> conductances = random_conductances(graph), lengths(graph.number_of_edges(), 1.);
  const std::vector<Index> seeds = {5, 300, 700, 1000};
  const internal::Components component = networks::components(graph, conductances);
  const internal::Walk_network network{graph, conductances, component};
  Walk_reduction reduction;
  reduction.band = 0;
  const auto make_solver = [] { return Star_mesh_elimination(); };
  const auto fragments = [&] {
    return internal::walk_fragments_over_clusters(network, lengths, seeds, reduction, make_solver, {}).of_face;
  };
  const std::vector<std::size_t> unions = fragments();
  const Face_clusters clusters = internal::clusters_around(seeds, graph, conductances, lengths,
                                                           reduction.largest_difference, reduction.cluster_steps);
  for (Index f = 0; f < unions.size(); ++f) EXPECT_EQ(unions[f], unions[clusters.root[clusters.of_face[f]]]);

  const auto walked = internal::walk_labels(graph, conductances, seeds, {0, 1, 2, 3});
  EXPECT_NE(unions, walked);
  reduction.band = clusters.root.size();
  EXPECT_EQ(fragments(), walked);
}

TEST(WalkReduction, FindsTheSegmentsOfTheDirectWalk) {
  // A neck between two balls is a segment of its own: it might go with either of them.
  for (const auto& [shape, segments] : {std::pair(meshes::two_spheres_with_neck(2.4, 0.3, 96), std::size_t(3)),
                                        std::pair(meshes::two_spheres_with_neck(2.0001, 0.2, 64), std::size_t(2))}) {
    const auto mesh = meshes::surface_mesh(shape);
    Automatic_segmentation over_clusters = reduced(segments);
    over_clusters.reduction.cluster_steps = 3;  // The faces around seeds that are clusters by themselves are few then.
    const Result direct = segmented(mesh, Automatic_segmentation(segments)),
                 by_clusters = segmented(mesh, over_clusters);
    EXPECT_EQ(direct.report.clusters, 0u);
    EXPECT_GT(by_clusters.report.clusters, by_clusters.report.fragments);
    EXPECT_LT(by_clusters.report.clusters, num_faces(mesh) / 3);
    EXPECT_LT(segmentation_measures::Overlaps(direct.ids, by_clusters.ids).hamming_distance(), 0.02);
  }
}

TEST(WalkReduction, TakesHoldAboveTheLargestMeshThatIsWalkedOnDirectly) {
  const auto mesh = meshes::surface_mesh(meshes::sphere(3));
  Automatic_segmentation policy;
  policy.reduction.largest_direct = num_faces(mesh);
  EXPECT_EQ(segmented(mesh, policy).report.clusters, 0u);
  --policy.reduction.largest_direct;
  EXPECT_GT(segmented(mesh, policy).report.clusters, 0u);
}

TEST(WalkReduction, KeepsGivenSeedsComponentsAndConstrainedEdges) {
  const auto mesh = meshes::surface_mesh(
      meshes::together(meshes::tube(2, 48, 48), meshes::moved(meshes::sphere(2), Eigen::Vector3d(5, 0, 0))));
  const auto is_seam = [&](meshes::Surface_mesh::Edge_index e) {
    const auto above = [&](auto v) { return mesh.point(v)[2] > 1.01; };
    return mesh.point(mesh.vertex(e, 0))[0] < 2 && above(mesh.vertex(e, 0)) != above(mesh.vertex(e, 1));
  };
  std::vector<bool> constrained(mesh.num_edges());
  for (const auto e : mesh.edges()) constrained[e] = is_seam(e);
  const auto map = boost::make_function_property_map<meshes::Surface_mesh::Edge_index>(
      [&](meshes::Surface_mesh::Edge_index e) { return static_cast<bool>(constrained[e]); });
  const std::vector<meshes::Surface_mesh::Face_index> given = {meshes::Surface_mesh::Face_index(0),
                                                               meshes::Surface_mesh::Face_index(1)};
  const auto hierarchy =
      hierarchy_via_random_walks(mesh, reduced(3), given, CGAL::parameters::edge_is_constrained_map(map));
  Face_labels<meshes::Surface_mesh> ids(mesh);
  hierarchy.segments(Segment_count_stop(hierarchy.number_of_fragments()), ids.map());
  EXPECT_NE(ids.values()[0], ids.values()[1]);
  EXPECT_GE(hierarchy.report().components, 2u);
  for (const auto e : mesh.edges()) {
    if (!constrained[e] || mesh.is_border(e)) continue;
    EXPECT_NE(ids.values()[mesh.face(mesh.halfedge(e))], ids.values()[mesh.face(mesh.opposite(mesh.halfedge(e)))]);
  }
}

namespace {

/// Two rows of faces that no edge joins.
struct Two_rows {
  Dual_graph graph = Dual_graph(8, {{0, 1}, {1, 2}, {2, 3}, {4, 5}, {5, 6}, {6, 7}});
  std::vector<double> conductances = std::vector<double>(6, 1.);
  internal::Components component = networks::components(graph, conductances);
  internal::Walk_network network = {graph, conductances, component};

  template <class Solver>
  std::vector<std::size_t> fragments(const std::vector<Index>& seeds) const {
    Solver solver;
    solver.analyze(graph);
    return internal::walk_fragments(network, std::move(solver), seeds, {}).of_face;
  }
  std::vector<std::size_t> fragments_over_clusters(const std::vector<Index>& seeds) const {
    return internal::walk_fragments_over_clusters(network, std::vector<double>(6, 1.), seeds, Walk_reduction(),
                                                  [] { return Eigen_walk_solver<>(); }, {})
        .of_face;
  }
};

}  // namespace

TEST(WalkFragments, AComponentWithoutASeedIsAFragmentOfItsOwn) {
  const Two_rows rows;
  const std::vector<std::size_t> whole = {0, 0, 0, 0, 1, 1, 1, 1}, halved = {0, 0, 1, 1, 2, 2, 2, 2};
  for (const std::vector<Index>& seeds : {std::vector<Index>{}, {2}, {6}, {2, 5}}) {
    EXPECT_EQ(rows.fragments<Star_mesh_elimination>(seeds), whole);
    EXPECT_EQ(rows.fragments_over_clusters(seeds), whole);
  }
  EXPECT_EQ(rows.fragments<Star_mesh_elimination>({0, 3}), halved);
  EXPECT_EQ(rows.fragments_over_clusters({0, 3}), halved);
}

TEST(WalkFragments, AreMadeByAnySolver) {
  const Two_rows rows;
  EXPECT_EQ(rows.fragments<Eigen_walk_solver<>>({0, 3, 5, 7}), rows.fragments<Star_mesh_elimination>({0, 3, 5, 7}));
}

TEST(WalkReduction, ClustersGrowWithLargeMeshesAlone) {
  const Walk_reduction reduction;
  EXPECT_EQ(internal::cluster_steps(10, reduction.cluster_steps), reduction.cluster_steps);
  EXPECT_EQ(internal::cluster_steps(600000, reduction.cluster_steps), reduction.cluster_steps);
  EXPECT_EQ(internal::cluster_steps(2400000, reduction.cluster_steps), 2 * reduction.cluster_steps);
}

TEST(WalkReduction, AMeshOfFewFacesIsSegmentedToo) {
  const auto mesh = meshes::surface_mesh(meshes::cube());
  EXPECT_EQ(segmented(mesh, reduced(1)).ids.size(), 12u);
}

TEST(WalkReduction, NumbersOutOfRangeAreErrors) {
  const auto mesh = meshes::surface_mesh(meshes::sphere(1));
  Automatic_segmentation policy;
  policy.reduction.cluster_steps = 0;
  EXPECT_THROW(segmented(mesh, policy), std::invalid_argument);
  policy.reduction = Walk_reduction();
  policy.reduction.largest_difference = 0;
  EXPECT_THROW(segmented(mesh, policy), std::invalid_argument);
}

TEST(FragmentsViaRandomWalks, MergedTheyAreTheLabelsOfTheOneCallWhetherReducedOrNot) {
  auto mesh = meshes::surface_mesh(meshes::two_spheres_with_neck(2.4, 0.3, 96));
  const auto thickness = mesh.add_property_map<Face, double>("f:thickness").first;
  for (const std::size_t largest_direct : {std::size_t(0), std::size_t(num_faces(mesh))}) {
    Automatic_segmentation policy;
    policy.reduction.largest_direct = largest_direct;
    const Dual_mesh_of shape = smoothed_shape(Dual_mesh_of(mesh));
    const Dihedral_difference difference(shape, smoothed_concavity());
    std::vector<Face> seeds;
    feature_sensitive_seeds(shape, policy.seeding.count, std::back_inserter(seeds));
    Face_labels<meshes::Surface_mesh> ids(mesh);
    EXPECT_EQ(fragments_via_random_walks(shape, Conductance(shape, difference), seeds, ids.map(), policy.reduction),
              seeds.size());
    local_thickness(shape, thickness);
    const auto hierarchy = merge_segments(shape, ids.map(), difference, Learned_cost(shape, thickness));
    hierarchy.segments(policy.stop, ids.map());
    EXPECT_EQ(ids.values(), segmented(mesh, policy).ids);
  }
}

TEST(FragmentsViaRandomWalks, AreTheLabelsOfRandomWalkFromTheSameSeeds) {
  const auto mesh = meshes::surface_mesh(meshes::two_spheres_with_neck(2.4, 0.3, 24));
  const Dual_mesh_of dual(mesh);
  const Conductance conductance(dual, Dihedral_difference(dual));
  const std::vector<Face> seeds = {Face(3), Face(400), Face(1000)};
  Random_walk walk(dual, conductance);
  for (std::size_t s = 0; s < seeds.size(); ++s) walk.add_seed(seeds[s], s);
  Face_labels<meshes::Surface_mesh> walked(mesh), ids(mesh);
  walk.segment(walked.map());
  EXPECT_EQ(fragments_via_random_walks(dual, conductance, seeds, ids.map()), 3u);
  EXPECT_EQ(ids.values(), walked.values());
  Face_labels<meshes::Surface_mesh> by_eigen(mesh);
  fragments_via_random_walks(mesh, conductance, seeds, by_eigen.map(), {}, Eigen_walk_solver<>());
  EXPECT_EQ(by_eigen.values(), walked.values());
}

TEST(FragmentsViaRandomWalks, WriteNothingWhereTheyCannotAnswer) {
  const auto mesh = meshes::surface_mesh(meshes::sphere(1));
  const Dual_mesh_of dual(mesh);
  const Conductance conductance(dual, Dihedral_difference(dual));
  using Faces = std::vector<Face>;
  Face_labels<meshes::Surface_mesh> ids(mesh);
  const auto untouched = ids.values();
  EXPECT_THROW(
      fragments_via_random_walks(dual, conductance, Faces{Face(static_cast<Index>(num_faces(mesh)))}, ids.map()),
      std::invalid_argument);
  Walk_reduction reduction;
  reduction.cluster_steps = 0;
  EXPECT_THROW(fragments_via_random_walks(dual, conductance, Faces{}, ids.map(), reduction), std::invalid_argument);
  EXPECT_THROW(
      fragments_via_random_walks(dual, conductance, Faces{Face(0), Face(5)}, ids.map(), {}, Star_mesh_elimination(),
                                 CGAL::parameters::callback([](double) { return false; })),
      Cancelled);
  EXPECT_EQ(ids.values(), untouched);
  EXPECT_EQ(fragments_via_random_walks(dual, conductance, Faces{}, ids.map()), 1u);  // a component without a seed
}

}  // namespace test_walk_reduction
