// SPDX-License-Identifier: MIT

#include "Segmentation.h"

#include "surfaces.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/Segment_hierarchy.h>
#include <RW_segmentation/regular_surfaces.h>
#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace segment_mesh {

namespace {

/// The seeds that a method places by itself, with the labels 0, 1, ...
std::vector<Face_label> placed_seeds(const Dual& shape, const std::vector<double>& difference, const Policies& policies,
                                     const RW_segmentation::Progress& progress) {
  std::vector<Face_label> seeds;
  for (const Face_number face : policies.seeding(shape, difference, {}, progress))
    seeds.emplace_back(shape.face(face), seeds.size());
  return seeds;
}

/// Each label of a seed becomes a segment.
Segmentation segment_from_seeds(const Dual& mesh, std::vector<Face_label> seeds, const Options& options,
                                const Policies& policies, Stages& stages) {
  namespace RW = RW_segmentation;
  const Dual smoothed =
      RW::smoothed_shape(mesh, policies.smoothing, CGAL::parameters::callback(stages.start("normals")));
  const Dual shape(mesh.with_shape_normals_of(smoothed), mesh);

  const RW::Progress progress(stages.start("conductances"));
  const std::vector<double> difference = policies.difference(shape, progress);
  std::vector<double> difference_of_edge(mesh.mesh().num_edges());
  for (Face_number e = 0; e < difference.size(); ++e) difference_of_edge[shape.edge(e)] = difference[e];
  const auto edge_map =
      boost::make_iterator_property_map(difference_of_edge.begin(), get(boost::edge_index, mesh.mesh()));
  const RW::Conductance conductance(shape, edge_map, policies.sigma, policies.cap);

  if (options.is_coarse) seeds = placed_seeds(shape, difference, policies, RW::Progress(stages.start("seeds")));

  RW::Random_walk walk(mesh, conductance, policies.solver, CGAL::parameters::callback(stages.start("walk")));
  std::set<std::size_t> labels;
  for (const auto& [face, label] : seeds) {
    walk.add_seed(face, label);
    labels.insert(label);
  }
  Segmentation result;
  result.label.resize(mesh.mesh().num_faces());
  walk.segment(face_map(mesh.mesh(), result.label));
  result.seed_labels.assign(labels.begin(), labels.end());
  if (!options.files.probabilities.empty())
    for (const std::size_t label : result.seed_labels) {
      result.probabilities.emplace_back(mesh.mesh().num_faces());
      walk.write_probabilities(label, face_map(mesh.mesh(), result.probabilities.back()));
    }
  result.seeds = seeds.size();
  result.labelled_seeds = std::move(seeds);
  result.unseeded_components = walk.report().unseeded_components;
  result.island_faces = walk.report().island_faces;
  result.degenerate_faces = mesh.number_of_degenerate_faces();
  return result;
}

/// A level of a hierarchy, and all of it.
/// \param by_shape the level that is looked for when no number of segments is asked for
Segmentation segmentation_of(const RW_segmentation::Random_walk_hierarchy<Mesh>& hierarchy, const Mesh& mesh,
                             const RW_segmentation::Any_stop& stop, const RW_segmentation::Any_stop& by_shape) {
  Segmentation result;
  result.label.resize(mesh.num_faces());
  result.fragment.resize(mesh.num_faces());
  hierarchy.segments(stop, face_map(mesh, result.label));
  hierarchy.segments(RW_segmentation::Any_stop(RW_segmentation::Segment_count_stop(hierarchy.number_of_fragments())),
                     face_map(mesh, result.fragment));
  result.seeds = hierarchy.report().seeds;
  result.island_faces = hierarchy.report().island_faces;
  result.degenerate_faces = hierarchy.report().degenerate_faces;
  result.has_heavy_noise = hierarchy.report().has_heavy_noise;
  result.tree = hierarchy;
  result.suggested = by_shape(hierarchy);
  return result;
}

/// Seeds place themselves beside those that are given, and the fragments that they make are merged.
Segmentation segment_automatically(const Dual& mesh, const std::vector<Face_label>& seeds, const Method& method,
                                   const Policies& policies, Stages& stages) {
  const auto callback = stages.start("segmentation");
  const auto hierarchy =
      RW_segmentation::hierarchy_via_random_walks(mesh, policies, seeds, CGAL::parameters::callback(callback));
  stages.split(hierarchy.report().stages);
  return segmentation_of(hierarchy, mesh.mesh(), policies.stop, stop_by_shape(method.merge_cost));
}

/// Each segment is a surface, which is fitted, too.
Segmentation segment_into_surfaces(const Dual& mesh, const Options& options, Stages& stages) {
  namespace RW = RW_segmentation;
  RW::Surface_segmentation numbers;
  const auto by_shape = [numbers](const RW::Merge_tree& tree) { return numbers.stop(tree); };
  numbers.number_of_segments = options.segments;
  if (options.noise) numbers.noise = *options.noise / mesh.unit();
  const auto stop = [numbers](const RW::Merge_tree& tree) { return numbers.stop(tree); };
  const auto callback = stages.start("segmentation");
  const auto hierarchy = RW::hierarchy_of_surfaces(mesh, numbers, CGAL::parameters::callback(callback));
  stages.split(hierarchy.report().stages);
  Segmentation result = segmentation_of(hierarchy, mesh.mesh(), stop, by_shape);
  result.noise = hierarchy.report().noise * mesh.unit();
  const std::size_t segments = *std::max_element(result.label.begin(), result.label.end()) + 1;
  result.surfaces = RW::segment_surfaces(mesh, face_map(mesh.mesh(), result.label), segments, numbers.noise);
  if (options.is_regular) {
    const auto tolerance = regularity_tolerance({options.regular_length, options.regular_angle}, mesh.unit());
    RW::Regular_surfaces regular = RW::regular_surfaces(result.surfaces, tolerance);
    result.surfaces = std::move(regular.surfaces);
    result.snaps = std::move(regular.snaps);
  }
  return result;
}

}  // namespace

Segmentation segment(const Mesh& mesh, const Wall_map& walls, const std::vector<Face_label>& seeds,
                     const Options& options, const Method& method, Stages& stages) {
  if (mesh.number_of_faces() == 0) return {};
  const Dual dual(mesh, CGAL::parameters::edge_is_constrained_map(walls));
  const Policies policies = policies_of(method);
  Segmentation result = options.is_engineering ? segment_into_surfaces(dual, options, stages)
                        : options.merges()     ? segment_automatically(dual, seeds, method, policies, stages)
                                               : segment_from_seeds(dual, seeds, options, policies, stages);
  for (Face_number e = 0; e < dual.number_of_edges(); ++e) result.walls += dual.is_wall(e);
  return result;
}

}  // namespace segment_mesh
