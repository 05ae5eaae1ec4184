#ifndef SEGMENT_MESH_SEGMENTATION_H
#define SEGMENT_MESH_SEGMENTATION_H

#include "Options.h"
#include "Oriented_mesh.h"
#include "Stages.h"
#include "seeds.h"

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Engineering_segmentation.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/Segment_hierarchy.h>
#include <RW_segmentation/coarse_seeds.h>
#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace segment_mesh {

/// What is known of the faces of the mesh at the end.
struct Segmentation {
  std::vector<std::size_t> label;                  ///< of each face
  std::vector<Face_label> labelled_seeds;          ///< empty where fragments were merged
  std::vector<std::size_t> seed_labels;            ///< in ascending order
  std::vector<std::vector<double>> probabilities;  ///< for each of them and each face, if asked for
  std::size_t seeds = 0, unseeded_components = 0, island_faces = 0, degenerate_faces = 0;
  bool has_heavy_noise = false;
  RW_segmentation::Merge_tree tree;                         ///< empty unless fragments were merged
  std::size_t suggested = 0;                                ///< segments by the shape, whatever was asked for; likewise
  std::vector<std::size_t> fragment;                        ///< of each face, likewise
  std::vector<RW_segmentation::Analytic_surface> surfaces;  ///< of each label; only for parts of machines
};

/// The numbers that agree best with people.
inline RW_segmentation::Automatic_segmentation default_policy(const Options& options) {
  RW_segmentation::Automatic_segmentation policy;
  // Seeds may also lie on the two sides of a convex crease, which a weight of 0 does not see. With one seed in the
  // middle of each part that people make of natural shapes, weights of 0, 0.02, 0.05, 0.1 and 0.2 give 87.7, 87.8,
  // 87.3, 85.6 and 81.8 % of the faces their part.
  if (options.has_seeds() && !options.merges()) policy.convex_weight = 0.02;
  return policy;
}

/// The numbers of a policy that every policy has, or the user's in their place.
template <class Policy>
Policy with_numbers_of(const Options& options, Policy policy) {
  policy.smoothing.radius = options.smoothing.value_or(policy.smoothing.radius);
  policy.convex_weight = options.convex_weight.value_or(policy.convex_weight);
  policy.measure = options.measure.value_or(policy.measure);
  policy.sigma = options.sigma.value_or(policy.sigma);
  policy.cap = options.cap.value_or(policy.cap);
  policy.number_of_segments = options.segments;
  return policy;
}

template <class Policy>
Policy policy_of(const Options& options, const Policy& numbers) {
  Policy policy = with_numbers_of(options, numbers);
  // Twice as many fragments as segments, so that there is something to choose from.
  policy.seeds = options.automatic_seeds.value_or(std::max(policy.seeds, 2 * options.segments.value_or(0)));
  return policy;
}

inline RW_segmentation::Engineering_segmentation policy_of(const Options& options,
                                                           const RW_segmentation::Engineering_segmentation& numbers) {
  return with_numbers_of(options, numbers);
}

inline std::size_t number_of_degenerate_faces(const Mesh& mesh) {
  RW_segmentation::Normal_smoothing none;
  none.radius = 0;
  std::vector<Mesh_vector> normals(mesh.num_faces());
  RW_segmentation::smoothed_face_normals(mesh, face_map(mesh, normals), none);
  return static_cast<std::size_t>(std::count(normals.begin(), normals.end(), CGAL::NULL_VECTOR));
}

/// What tells coarse seeds apart, and how little of it ends their placing: what agrees best with people, or as in the
/// paper.
inline double coarse_convex_weight(const RW_segmentation::Automatic_segmentation&) { return 0.5; }
inline double coarse_convex_weight(const RW_segmentation::Paper_segmentation& policy) { return policy.convex_weight; }
inline RW_segmentation::Separation_threshold_stop coarse_stop(const RW_segmentation::Automatic_segmentation&) {
  return RW_segmentation::Separation_threshold_stop();
}
inline RW_segmentation::Separation_decrease_stop coarse_stop(const RW_segmentation::Paper_segmentation&) {
  return RW_segmentation::Separation_decrease_stop();
}

/// A few seeds far apart, with the labels 0, 1, ...
template <class NormalMap, class Policy>
std::vector<Face_label> coarse_seeds(const Mesh& mesh, const NormalMap& normals, const Policy& policy, Stages& stages) {
  namespace RW = RW_segmentation;
  const auto callback = stages.start("seeds");
  const auto np = CGAL::parameters::callback(callback);
  const RW::Dihedral_difference difference(mesh, normals, coarse_convex_weight(policy), policy.measure);
  std::vector<Mesh::Face_index> faces;
  if (policy.number_of_segments)
    RW::coarse_seeds(mesh, difference, RW::Seed_count_stop(*policy.number_of_segments), std::back_inserter(faces), np);
  else
    RW::coarse_seeds(mesh, difference, coarse_stop(policy), std::back_inserter(faces), np);
  std::vector<Face_label> seeds;
  for (const Mesh::Face_index face : faces) seeds.emplace_back(face, seeds.size());
  return seeds;
}

/// Each label of a seed becomes a segment.
template <class Policy>
Segmentation segment_from_seeds(const Mesh& mesh, std::vector<Face_label> seeds, const Options& options,
                                const Policy& policy, Stages& stages) {
  namespace RW = RW_segmentation;
  stages.start("normals");
  std::vector<Mesh_vector> vectors(mesh.num_faces());
  const auto normals = face_map(mesh, vectors);
  RW::smoothed_face_normals(mesh, normals, policy.smoothing);
  if (options.is_coarse) seeds = coarse_seeds(mesh, normals, policy, stages);

  const auto callback = stages.start("walk");
  const RW::Dihedral_difference difference(mesh, normals, policy.convex_weight, policy.measure);
  const RW::Conductance conductance(mesh, difference, policy.sigma, policy.cap);
  RW::Random_walk walk(mesh, conductance, RW::Star_mesh_elimination(), CGAL::parameters::callback(callback));
  std::set<std::size_t> labels;
  for (const auto& [face, label] : seeds) {
    walk.add_seed(face, label);
    labels.insert(label);
  }
  Segmentation result;
  result.label.resize(mesh.num_faces());
  walk.segment(face_map(mesh, result.label));
  result.seed_labels.assign(labels.begin(), labels.end());
  if (!options.files.probabilities.empty())
    for (const std::size_t label : result.seed_labels) {
      result.probabilities.emplace_back(mesh.num_faces());
      walk.write_probabilities(label, face_map(mesh, result.probabilities.back()));
    }
  result.seeds = seeds.size();
  result.labelled_seeds = std::move(seeds);
  result.unseeded_components = walk.report().unseeded_components;
  result.island_faces = walk.report().island_faces;
  result.degenerate_faces = number_of_degenerate_faces(mesh);
  return result;
}

/// Seeds place themselves beside those that are given, and the fragments that they make are merged.
template <class Policy>
Segmentation segment_automatically(const Mesh& mesh, const std::vector<Face_label>& seeds, const Policy& policy,
                                   Stages& stages) {
  namespace RW = RW_segmentation;
  const auto callback = stages.start("segmentation");
  const auto hierarchy = RW::hierarchy_via_random_walks(mesh, policy, seeds, CGAL::parameters::callback(callback));
  stages.split(hierarchy.report().stages);

  Segmentation result;
  result.label.resize(mesh.num_faces());
  result.fragment.resize(mesh.num_faces());
  hierarchy.segments([&](const RW::Merge_tree& tree) { return policy.stop(tree); }, face_map(mesh, result.label));
  hierarchy.segments(RW::Segment_count_stop(hierarchy.number_of_fragments()), face_map(mesh, result.fragment));
  result.seeds = hierarchy.report().seeds;
  result.island_faces = hierarchy.report().island_faces;
  result.degenerate_faces = hierarchy.report().degenerate_faces;
  result.has_heavy_noise = hierarchy.report().has_heavy_noise;
  result.tree = hierarchy;
  Policy by_shape = policy;
  by_shape.number_of_segments.reset();
  result.suggested = by_shape.stop(hierarchy);
  return result;
}

template <class Policy>
Segmentation segment(const Mesh& mesh, const std::vector<Face_label>& seeds, const Options& options,
                     const Policy& policy, Stages& stages) {
  if (mesh.number_of_faces() == 0) return {};
  return options.merges() ? segment_automatically(mesh, seeds, policy, stages)
                          : segment_from_seeds(mesh, seeds, options, policy, stages);
}

/// The surfaces of the segments are fitted, too.
inline Segmentation segment(const Mesh& mesh, const std::vector<Face_label>& seeds, const Options&,
                            const RW_segmentation::Engineering_segmentation& policy, Stages& stages) {
  if (mesh.number_of_faces() == 0) return {};
  Segmentation result = segment_automatically(mesh, seeds, policy, stages);
  const std::size_t segments = *std::max_element(result.label.begin(), result.label.end()) + 1;
  result.surfaces = RW_segmentation::segment_surfaces(mesh, face_map(mesh, result.label), segments, policy.noise);
  return result;
}

}  // namespace segment_mesh

#endif
