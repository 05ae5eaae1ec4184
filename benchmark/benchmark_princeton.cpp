// SPDX-License-Identifier: MIT

// How well segmentations agree with people's, on the meshes of the Princeton Segmentation Benchmark, and how long they
// take. The data are not part of this package; --data names a folder with the benchmark's own layout:
// data/off/N.off and data/seg/Benchmark/N/N_k.seg.

// The maximum flow of CGAL 5.5.1 does not reset its flow between two cuts, which spoils the segmentations by SDF.
#define CGAL_DO_NOT_USE_BOYKOV_KOLMOGOROV_MAXFLOW_SOFTWARE

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // in Boost's maximum flow
#endif

#include "measurement.h"
#include "princeton_data.h"
#include "segmentation_measures.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Learned_cost.h>
#include <RW_segmentation/Paper_segmentation.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/coarse_seeds.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smoothed_face_normals.h>
#include <RW_segmentation/transfer_segments.h>

#include <CGAL/Surface_mesh_approximation/approximate_triangle_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/mesh_segmentation.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#if __has_include(<CGAL/Polygon_mesh_processing/region_growing.h>)
#include <CGAL/Polygon_mesh_processing/region_growing.h>
#else
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_polygon_mesh.h>
#endif

using namespace RW_segmentation;
using namespace measurement;
using namespace princeton;
using segmentation_measures::Overlaps;

namespace {

// ---- Methods ----

struct Outcome_of_method {
  Labels labels;                     // by face of the mesh that was segmented
  std::vector<Labels> other_levels;  // of which each person may take the best
  std::vector<Segmentation_report::Stage> stages;
};
using Method = std::function<Outcome_of_method(const Subject&)>;
using Label_map =
    boost::iterator_property_map<std::size_t*, boost::property_map<Mesh, boost::face_index_t>::const_type>;

std::size_t number_of_segments(const Labels& labels) {
  return std::set<std::size_t>(labels.begin(), labels.end()).size();
}

std::size_t typical_number_of_segments(const Subject& subject) {
  std::vector<std::size_t> numbers;
  for (const Labels& labels : subject.people) numbers.push_back(number_of_segments(labels));
  return segmentation_measures::mode_nearest_median(numbers);
}

/// \param are_levels_offered whether the person may choose among the levels of the tree that it offers
template <class Policy>
Outcome_of_method by_walks(const Subject& subject, const Policy& policy, bool are_levels_offered = false) {
  Outcome_of_method outcome;
  const auto hierarchy = hierarchy_via_random_walks(subject.mesh, policy);
  const auto labels_at = [&](std::size_t segments) {
    Labels labels(num_faces(subject.mesh));
    hierarchy.segments(Segment_count_stop(segments), Label_map(labels.data(), get(boost::face_index, subject.mesh)));
    return labels;
  };
  const std::size_t segments =
      std::clamp(policy.stop(hierarchy), hierarchy.number_of_components(), hierarchy.number_of_fragments());
  outcome.labels = labels_at(segments);
  if (are_levels_offered)
    for (const std::size_t level : hierarchy.levels(segments)) outcome.other_levels.push_back(labels_at(level));
  outcome.stages = hierarchy.report().stages;
  return outcome;
}

/// Few seeds by Eq. 9, and the walk from them, with no merging. Seeds are told apart by convex edges, too; the walk heeds
/// concave ones alone.
Outcome_of_method by_coarse_seeds(const Subject& subject) {
  Outcome_of_method outcome;
  outcome.labels.resize(num_faces(subject.mesh));
  auto stage = [&, watch = Stopwatch(), before = 0.](const char* name) mutable {
    const double now = watch.milliseconds();
    outcome.stages.push_back({name, (now - before) / 1000});
    before = now;
  };
  const Mesh& mesh = subject.mesh;
  std::vector<CGAL::Simple_cartesian<double>::Vector_3> vectors(num_faces(mesh));
  const auto normals = boost::make_iterator_property_map(vectors.begin(), get(boost::face_index, mesh));
  smoothed_face_normals(mesh, normals);
  stage("normals");
  const Dihedral_difference<Mesh> turn(mesh, normals, 0.5, Dihedral_measure::angle);
  const Dihedral_difference<Mesh> concavity(mesh, normals, 0, Dihedral_measure::angle);
  stage("difference");
  std::vector<Face> seeds;
  coarse_seeds(mesh, turn, Separation_threshold_stop(), std::back_inserter(seeds));
  stage("seeds");
  segmentation_from_seeds(mesh, Conductance<Mesh>(mesh, concavity), seeds,
                          Label_map(outcome.labels.data(), get(boost::face_index, mesh)));
  stage("walk");
  return outcome;
}

/// The segments of a copy with a quarter of the edges, carried back.
template <class NamedParameters = CGAL::parameters::Default_named_parameters>
Outcome_of_method by_simplified_copy(const Subject& subject, Mesh& copy,
                                     const NamedParameters& np = CGAL::parameters::default_values()) {
  const Mesh& mesh = subject.mesh;
  Outcome_of_method outcome;
  outcome.labels.resize(num_faces(mesh));
  const Stopwatch collapse;
  CGAL::Surface_mesh_simplification::edge_collapse(copy, Edge_ratio_stop{0.25}, np);
  copy.collect_garbage();
  outcome.stages.push_back({"collapse", collapse.milliseconds() / 1000});

  const auto segments = copy.add_property_map<Face, std::size_t>("f:segment").first;
  const Stopwatch segmentation;
  segmentation_via_random_walks(copy, segments);
  outcome.stages.push_back({"segmentation", segmentation.milliseconds() / 1000});

  const Stopwatch transfer;
  const auto index = get(boost::face_index, mesh);
  std::vector<CGAL::Simple_cartesian<double>::Vector_3> vectors(num_faces(mesh));
  const auto normals = boost::make_iterator_property_map(vectors.begin(), index);
  smoothed_face_normals(mesh, normals);
  const Dihedral_difference<Mesh> concavity(mesh, normals, 0, Dihedral_measure::angle);
  transfer_segments(copy, segments, mesh, Conductance<Mesh>(mesh, concavity), Label_map(outcome.labels.data(), index));
  outcome.stages.push_back({"transfer", transfer.milliseconds() / 1000});
  return outcome;
}

/// Collapses by the quadrics of Garland and Heckbert.
Outcome_of_method by_quadrics(const Subject& subject) {
  Mesh copy = subject.mesh;
  const CGAL::Surface_mesh_simplification::GarlandHeckbert_plane_policies<Mesh, CGAL::Simple_cartesian<double>>
      policies(copy);
  return by_simplified_copy(subject, copy,
                            CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
}

/// Collapses the shortest edges to their middles.
Outcome_of_method by_edge_lengths(const Subject& subject) {
  namespace Simplification = CGAL::Surface_mesh_simplification;
  Mesh copy = subject.mesh;
  return by_simplified_copy(subject, copy,
                            CGAL::parameters::get_cost(Simplification::Edge_length_cost<Mesh>())
                                .get_placement(Simplification::Midpoint_placement<Mesh>()));
}

/// CGAL's segmentation by shape diameters, with its own default parameters.
Outcome_of_method by_shape_diameter(const Subject& subject) {
  Outcome_of_method outcome;
  outcome.labels.resize(num_faces(subject.mesh));
  const auto index = get(boost::face_index, subject.mesh);
  std::vector<double> values(num_faces(subject.mesh));
  const auto value_map = boost::make_iterator_property_map(values.begin(), index);
  Stopwatch diameters;
  CGAL::sdf_values(subject.mesh, value_map);
  outcome.stages.push_back({"diameters", diameters.milliseconds() / 1000});
  Stopwatch cut;
  CGAL::segmentation_from_sdf_values(subject.mesh, value_map, Label_map(outcome.labels.data(), index));
  outcome.stages.push_back({"graph cut", cut.milliseconds() / 1000});
  return outcome;
}

/// CGAL's variational shape approximation with its own default parameters: as many proxies as people make segments.
Outcome_of_method by_shape_approximation(const Subject& subject) {
  Outcome_of_method outcome;
  outcome.labels.resize(num_faces(subject.mesh));
  const Stopwatch watch;
  CGAL::Surface_mesh_approximation::approximate_triangle_mesh(
      subject.mesh, CGAL::parameters::max_number_of_proxies(typical_number_of_segments(subject))
                        .face_proxy_map(Label_map(outcome.labels.data(), get(boost::face_index, subject.mesh))));
  outcome.stages.push_back({"approximation", watch.milliseconds() / 1000});
  return outcome;
}

/// Planes that CGAL grows from faces, with its own default angle and a hundredth of the diagonal as distance, which has no
/// default that heeds the size of a mesh.
Outcome_of_method by_region_growing(const Subject& subject) {
  const Mesh& mesh = subject.mesh;
  const double distance = diagonal_of(mesh) / 100, degrees = 25;
  Outcome_of_method outcome;
  outcome.labels.resize(num_faces(mesh));
  const Stopwatch watch;
#if __has_include(<CGAL/Polygon_mesh_processing/region_growing.h>)
  CGAL::Polygon_mesh_processing::region_growing_of_planes_on_faces(
      mesh, Label_map(outcome.labels.data(), get(boost::face_index, mesh)),
      CGAL::parameters::maximum_distance(distance).maximum_angle(degrees));
#else
  using Kernel = CGAL::Simple_cartesian<double>;
  using Neighbors = CGAL::Shape_detection::Polygon_mesh::One_ring_neighbor_query<Mesh>;
  using Plane = CGAL::Shape_detection::Polygon_mesh::Least_squares_plane_fit_region<Kernel, Mesh>;
  using Order = CGAL::Shape_detection::Polygon_mesh::Least_squares_plane_fit_sorting<Kernel, Mesh, Neighbors>;
  const auto points = get(CGAL::vertex_point, mesh);
  Neighbors neighbors(mesh);
  Plane plane(mesh, distance, degrees, 1, points);
  Order order(mesh, neighbors, points);
  order.sort();
  const auto range = faces(mesh);
  CGAL::Shape_detection::Region_growing growing(range, neighbors, plane, order.seed_map());
  std::vector<std::vector<std::size_t>> regions;
  growing.detect(std::back_inserter(regions));
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (const std::size_t f : regions[r]) outcome.labels[f] = r;
#endif
  outcome.stages.push_back({"growing", watch.milliseconds() / 1000});
  return outcome;
}

Automatic_segmentation with_seedings(std::size_t seedings, Automatic_segmentation policy) {
  policy.seedings = seedings;
  return policy;
}

/// \param largest_direct 0 places seeds and runs walks over clusters on every mesh
Automatic_segmentation with_largest_direct(std::size_t largest_direct) {
  Automatic_segmentation policy;
  policy.seeding.sampling = Farthest_point_sampling(policy.seeding.sampling.normal_weight(), largest_direct);
  policy.reduction.largest_direct = largest_direct;
  return policy;
}

/// The trees of the learned merge cost that know nothing of a category, for each of the categories: what
/// train_merge_cost.py writes to --folds.
class Trees_without_category {
 public:
  /// \throws std::runtime_error
  explicit Trees_without_category(const std::string& path) {
    std::ifstream file(path);
    std::size_t category = 0, number = 0;
    while (file >> category >> number) {
      std::vector<internal::Decision_tree>& trees = trees_[category];
      trees.resize(number);
      for (internal::Decision_tree& tree : trees) read(file, tree);
    }
    if (!file.eof() || trees_.empty()) throw std::runtime_error(path + ": no trees as train_merge_cost.py writes them");
    for (const auto& [without, trees] : trees_) boosted_[without] = {trees.data(), trees.size()};
  }

  /// \throws std::runtime_error if there are none for the category of a mesh
  const internal::Boosted_trees& for_mesh(std::size_t number) const {
    const auto found = boosted_.find((number - 1) / meshes_of_a_category);
    if (found == boosted_.end()) throw std::runtime_error("no trees that know nothing of " + category_of(number));
    return found->second;
  }

 private:
  static void read(std::ifstream& file, internal::Decision_tree& tree) {
    for (internal::Decision_tree::Split& split : tree.splits) {
      int feature = 0, yes = 0, no = 0;
      file >> feature >> split.threshold >> yes >> no;
      split.feature = static_cast<std::uint8_t>(feature);
      split.yes = static_cast<std::int16_t>(yes);
      split.no = static_cast<std::int16_t>(no);
    }
    for (double& leaf : tree.leaves) file >> leaf;
  }

  std::map<std::size_t, std::vector<internal::Decision_tree>> trees_;
  std::map<std::size_t, internal::Boosted_trees> boosted_;
};

/// The automatic segmentation, by trees that know nothing of the category of the mesh if such are given.
Outcome_of_method automatically(const Subject& subject, const Automatic_segmentation& policy,
                                const Trees_without_category* folds, bool are_levels_offered = false) {
  if (!folds) return by_walks(subject, policy, are_levels_offered);
  const internal::Boosted_trees& trees = folds->for_mesh(subject.number);
  const auto without_category = [&](const Dual_mesh& mesh) {
    return Learned_cost(mesh, internal::thickness_of_faces(mesh, policy.merge_cost.thickness, {}), trees);
  };
  auto of_fold = policy.with_merge_cost(without_category);
  of_fold.seedings = policy.seedings;
  return by_walks(subject, of_fold, are_levels_offered);
}

/// The segments of a mesh beside seven copies of it in the same file, which are as large and two, four and eight times as large.
Outcome_of_method among_copies(const Subject& subject, bool by_component, const Trees_without_category* folds) {
  Subject row;
  row.number = subject.number;
  const double gap = 2 * diagonal_of(subject.mesh);
  double x = 0;
  for (const double size : {1., 2., 4., 8., 1., 2., 4., 8.}) {
    Mesh copy = subject.mesh;
    for (const auto v : copy.vertices()) {
      const auto& p = subject.mesh.point(v);
      copy.point(v) = {x + size * p.x(), size * p.y(), size * p.z()};
    }
    row.mesh += copy;
    x += size * gap;
  }
  Automatic_segmentation policy;
  policy.by_component = by_component;
  Outcome_of_method outcome = automatically(row, policy, folds);
  outcome.labels.resize(num_faces(subject.mesh));
  return outcome;
}

/// \param folds null: the library's own trees
std::vector<std::pair<std::string, Method>> methods(const Trees_without_category* folds = nullptr) {
  return {
      {"automatic", [=](const Subject& s) { return automatically(s, Automatic_segmentation(), folds); }},
      {"count",
       [=](const Subject& s) {
         return automatically(s, Automatic_segmentation(typical_number_of_segments(s)), folds);
       }},
      {"four_seedings",
       [=](const Subject& s) { return automatically(s, with_seedings(4, Automatic_segmentation()), folds); }},
      {"four_seedings_count",
       [=](const Subject& s) {
         return automatically(s, with_seedings(4, Automatic_segmentation(typical_number_of_segments(s))), folds);
       }},
      {"one_seeding",
       [=](const Subject& s) { return automatically(s, with_seedings(1, Automatic_segmentation()), folds); }},
      {"one_seeding_count",
       [=](const Subject& s) {
         return automatically(s, with_seedings(1, Automatic_segmentation(typical_number_of_segments(s))), folds);
       }},
      {"among_copies", [=](const Subject& s) { return among_copies(s, true, folds); }},
      {"among_copies_as_a_whole", [=](const Subject& s) { return among_copies(s, false, folds); }},
      {"levels", [=](const Subject& s) { return automatically(s, Automatic_segmentation(), folds, true); }},
      {"size_aware",
       [](const Subject& s) {
         return by_walks(s, Automatic_segmentation().with_merge_cost(Size_aware_cost_policy()));
       }},
      {"size_aware_count",
       [](const Subject& s) {
         return by_walks(
             s, Automatic_segmentation(typical_number_of_segments(s)).with_merge_cost(Size_aware_cost_policy()));
       }},
      {"size_aware_levels",
       [](const Subject& s) {
         return by_walks(s, Automatic_segmentation().with_merge_cost(Size_aware_cost_policy()), true);
       }},
      {"paper", [](const Subject& s) { return by_walks(s, Paper_segmentation()); }},
      {"paper_count", [](const Subject& s) { return by_walks(s, Paper_segmentation(typical_number_of_segments(s))); }},
      {"coarse", by_coarse_seeds},
      {"clusters", [=](const Subject& s) { return automatically(s, with_largest_direct(0), folds); }},
      {"direct", [=](const Subject& s) { return automatically(s, with_largest_direct(num_faces(s.mesh)), folds); }},
      {"collapse",
       [](const Subject& s) {
         Mesh copy = s.mesh;
         return by_simplified_copy(s, copy);
       }},
      {"collapse_quadrics", by_quadrics},
      {"collapse_lengths", by_edge_lengths},
      {"sdf", by_shape_diameter},
      {"vsa", by_shape_approximation},
      {"region_growing", by_region_growing},
  };
}

// ---- Measures ----

/// What a method reached on a mesh, averaged over the people who segmented it.
struct Score {
  std::size_t number = 0;
  double error = 0, hamming = 0, global_consistency = 0, local_consistency = 0, segments = 0, milliseconds = 0;
  double overlap = 0;  // of the segments with those of the direct automatic segmentation
  std::vector<Segmentation_report::Stage> stages;

  static constexpr std::array names = {"error", "hamming", "GCE", "LCE", "segments", "ms", "overlap"};
  std::array<double, names.size()> numbers() const {
    return {error, hamming, global_consistency, local_consistency, segments, milliseconds, overlap};
  }
};

void add_comparison(Score& score, const Labels& a, const Labels& b, double weight) {
  const Overlaps overlaps(a, b);
  score.error += weight * overlaps.rand_index_error();
  score.hamming += weight * overlaps.hamming_distance();
  score.global_consistency += weight * overlaps.global_consistency_error();
  score.local_consistency += weight * overlaps.local_consistency_error();
}

/// \param labels by face of the mesh that was segmented
Labels on_original(const Subject& subject, const Labels& labels) {
  Labels result;
  for (const Face f : subject.nearest) result.push_back(labels[f]);
  return result;
}

/// \param automatic the labels of the direct automatic segmentation
Score score_of(const Subject& subject, const Method& method, const Labels& automatic) {
  Outcome_of_method outcome = method(subject);
  std::vector<Labels> levels = {on_original(subject, outcome.labels)};
  for (const Labels& level : outcome.other_levels) levels.push_back(on_original(subject, level));
  Score score;
  score.number = subject.number;
  for (const Labels& person : subject.people) {
    const auto error = [&](const Labels& labels) { return Overlaps(labels, person).rand_index_error(); };
    const auto& best = *std::min_element(levels.begin(), levels.end(),
                                         [&](const Labels& a, const Labels& b) { return error(a) < error(b); });
    add_comparison(score, best, person, 1 / static_cast<double>(subject.people.size()));
  }
  score.segments = static_cast<double>(number_of_segments(outcome.labels));
  score.overlap = 1 - Overlaps(outcome.labels, automatic).hamming_distance();
  for (const auto& stage : outcome.stages) score.milliseconds += 1000 * stage.seconds;
  score.stages = std::move(outcome.stages);
  return score;
}

/// People against one another, every two of them.
Score score_of_people(const Subject& subject) {
  const auto people = static_cast<double>(subject.people.size());
  Score score;
  score.number = subject.number;
  for (std::size_t i = 0; i < subject.people.size(); ++i) {
    score.segments += static_cast<double>(number_of_segments(subject.people[i])) / people;
    for (std::size_t j = 0; j < i; ++j)
      add_comparison(score, subject.people[i], subject.people[j], 2 / (people * (people - 1)));
  }
  return score;
}

/// Calls `work(i)` for i from 0 to `number` - 1 in several threads; rethrows the first exception.
void in_parallel(std::size_t number, std::size_t threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto run = [&] {
    try {
      for (std::size_t i = next++; i < number; i = next++) work(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      next = number;
    }
  };
  std::vector<std::thread> others;
  for (std::size_t t = 1; t < threads; ++t) others.emplace_back(run);
  run();
  for (std::thread& thread : others) thread.join();
  if (failure) std::rethrow_exception(failure);
}

// ---- Output ----

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

double standard_error(const std::vector<double>& values) {
  const double m = mean(values), n = static_cast<double>(values.size());
  double squares = 0;
  for (const double x : values) squares += (x - m) * (x - m);
  return n > 1 ? std::sqrt(squares / (n - 1) / n) : 0;
}

/// One of the numbers of all scores.
std::vector<double> column(const std::vector<Score>& scores, std::size_t number) {
  std::vector<double> values;
  for (const Score& score : scores) values.push_back(score.numbers()[number]);
  return values;
}

void print_row(const std::string& name, const std::vector<Score>& scores) {
  std::printf("%-10s %6zu", name.c_str(), scores.size());
  const std::vector<double> error = column(scores, 0);
  std::printf(" %9.4f +- %.4f", mean(error), standard_error(error));
  for (const std::size_t i : {1, 2, 3}) std::printf(" %8.4f", mean(column(scores, i)));
  std::printf(" %8.1f %9.1f %8.4f\n", mean(column(scores, 4)), mean(column(scores, 5)), mean(column(scores, 6)));
}

void print_table(const std::string& method, const std::vector<Score>& scores) {
  std::printf("\n%-10s %6s %19s %8s %8s %8s %8s %9s %8s\n", method.c_str(), "meshes", "Rand error", "Hamming", "GCE",
              "LCE", "segments", "ms", "overlap");
  std::vector<std::pair<std::string, std::vector<Score>>> categories;
  for (const Score& score : scores) {
    const std::string category = category_of(score.number);
    if (categories.empty() || categories.back().first != category) categories.push_back({category, {}});
    categories.back().second.push_back(score);
  }
  for (const auto& [category, of_category] : categories) print_row(category, of_category);
  print_row("all", scores);

  std::printf("ms a stage:");
  for (std::size_t i = 0; i < scores.front().stages.size(); ++i) {
    std::vector<double> ms;
    for (const Score& score : scores) ms.push_back(1000 * score.stages[i].seconds);
    std::printf("  %s %.1f", scores.front().stages[i].name.c_str(), mean(ms));
  }
  std::printf("\n");
  std::fflush(stdout);
}

/// How much less people disagree with a method than with another one, mesh by mesh.
std::vector<double> gains(const std::vector<Score>& scores, const std::vector<Score>& others) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < scores.size(); ++i) differences.push_back(scores[i].error - others[i].error);
  return differences;
}

void print_comparison(const std::string& method, const std::vector<Score>& scores, const std::string& other,
                      const std::vector<Score>& others) {
  std::printf("\nRand error %s %-6s %10s %10s %18s\n", "of        ", "meshes", method.c_str(), other.c_str(),
              "difference");
  const auto print_row = [](const std::string& name, const std::vector<Score>& a, const std::vector<Score>& b) {
    const std::vector<double> difference = gains(a, b);
    std::printf("%-20s %6zu %10.4f %10.4f %+9.4f +- %.4f\n", name.c_str(), a.size(), mean(column(a, 0)),
                mean(column(b, 0)), mean(difference), standard_error(difference));
  };
  for (std::size_t begin = 0, end = 0; begin < scores.size(); begin = end) {
    const std::string category = category_of(scores[begin].number);
    while (end < scores.size() && category_of(scores[end].number) == category) ++end;
    const auto part = [&](const std::vector<Score>& all) {
      return std::vector<Score>(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                all.begin() + static_cast<std::ptrdiff_t>(end));
    };
    print_row(category, part(scores), part(others));
  }
  print_row("all", scores, others);
}

void write_scores(const std::string& path, const std::vector<std::string>& methods,
                  const std::vector<std::vector<Score>>& scores) {
  std::ofstream file(path);
  file << "method,mesh";
  for (const char* name : Score::names) file << ',' << name;
  file << '\n';
  for (std::size_t m = 0; m < methods.size(); ++m)
    for (const Score& score : scores[m]) {
      file << methods[m] << ',' << score.number;
      for (const double x : score.numbers()) file << ',' << x;
      file << '\n';
    }
  if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

Result result_of(const std::string& method, const Changes& changes, const std::vector<Score>& scores) {
  Result result("princeton");
  result.add("method", method).add("meshes", scores.size());
  if (changes.noise > 0) result.add("noise", changes.noise);
  if (changes.faces != 1) result.add("faces", changes.faces);
  result.add("error", mean(column(scores, 0))).add("standard_error", standard_error(column(scores, 0)));
  result.add("hamming", mean(column(scores, 1)))
      .add("gce", mean(column(scores, 2)))
      .add("lce", mean(column(scores, 3)));
  result.add("segments", mean(column(scores, 4))).add("ms_per_mesh", mean(column(scores, 5)));
  result.add("overlap", mean(column(scores, 6)));
  return result;
}

}  // namespace

int main(int argc, char* argv[]) {
  CLI::App app("Agreement with people on the Princeton Segmentation Benchmark");
  std::string data, meshes, csv, folds, trees;
  std::vector<std::string> chosen = {"automatic", "count"};
  Changes changes;
  std::size_t threads = 1;
  std::vector<std::string> names = {"people"};
  for (const auto& [name, method] : methods()) names.push_back(name);
  const std::vector<std::pair<std::string, std::string>> comparisons = {
      {"automatic", "size_aware"},    {"count", "size_aware_count"},    {"levels", "size_aware_levels"},
      {"four_seedings", "automatic"}, {"four_seedings_count", "count"}, {"automatic", "one_seeding"},
      {"count", "one_seeding_count"}};
  app.add_option("--data", data, "folder with data/off and data/seg/Benchmark")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--meshes", meshes, "file with the numbers of the meshes; default: all in the folder");
  auto* method_option = app.add_option("--method", chosen, "what segments, one or several")
                            ->check(CLI::IsMember(names))
                            ->capture_default_str();
  app.add_option("--noise", changes.noise, "displace the vertices, in percent of the diagonal")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--faces", changes.faces, "factor for the number of faces: a power of 4, or less than 1")
      ->check(CLI::Range(0.01, 256.));
  app.add_option("--threads", threads, "meshes at once; times are then those of a busy machine")
      ->check(CLI::Range(1, 1024));
  auto* fold_option =
      app.add_option("--folds", folds,
                     "what the trees of the learned merge cost know nothing of: the mesh's category;\n"
                     "compares with the size-aware cost, and numbers of seedings, unless --method tells others")
          ->check(CLI::IsMember({"category"}));
  app.add_option("--trees", trees, "file of such trees, as train_merge_cost.py writes it to its --folds")
      ->check(CLI::ExistingFile)
      ->needs(fold_option);
  app.add_option("--csv", csv, "write the scores of each mesh to this file");
  CLI11_PARSE(app, argc, argv);

  try {
    const auto numbers =
        meshes.empty() ? numbers_in_folder(std::filesystem::path(data) / "data" / "off") : numbers_in_file(meshes);
    if (numbers.empty()) throw std::runtime_error(data + ": no meshes");
    std::optional<Trees_without_category> trees_of_folds;
    if (!folds.empty()) {
      if (trees.empty()) throw std::invalid_argument("--folds needs --trees");
      trees_of_folds.emplace(trees);
      if (method_option->count() == 0)
        for (const auto& [method, other] : comparisons)
          for (const std::string& name : {method, other})
            if (std::find(chosen.begin(), chosen.end(), name) == chosen.end()) chosen.push_back(name);
    }
    const auto all_methods = methods(trees_of_folds ? &*trees_of_folds : nullptr);

    std::vector<std::vector<Score>> scores(chosen.size(), std::vector<Score>(numbers.size()));
    in_parallel(numbers.size(), threads, [&](std::size_t i) {
      const Subject subject = read_subject(data, numbers[i], changes);
      const Labels automatic = by_walks(subject, Automatic_segmentation()).labels;
      for (std::size_t m = 0; m < chosen.size(); ++m) {
        const auto method = std::find_if(all_methods.begin(), all_methods.end(),
                                         [&](const auto& named) { return named.first == chosen[m]; });
        scores[m][i] =
            method == all_methods.end() ? score_of_people(subject) : score_of(subject, method->second, automatic);
      }
    });

    std::vector<Result> results;
    for (std::size_t m = 0; m < chosen.size(); ++m) {
      print_table(chosen[m], scores[m]);
      results.push_back(result_of(chosen[m], changes, scores[m]));
    }
    const auto place = [&](const std::string& name) {
      return static_cast<std::size_t>(std::find(chosen.begin(), chosen.end(), name) - chosen.begin());
    };
    for (const auto& [method, with] : comparisons) {
      const std::size_t m = place(method), other = place(with);
      if (!trees_of_folds || m == chosen.size() || other == chosen.size()) continue;
      print_comparison(chosen[m], scores[m], chosen[other], scores[other]);
      const std::vector<double> difference = gains(scores[m], scores[other]);
      results[m].add("folds", folds).add("difference", mean(difference));
      results[m].add("standard_error_of_difference", standard_error(difference));
    }
    if (!csv.empty()) write_scores(csv, chosen, scores);
    print(results);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_princeton: %s\n", error.what());
    return 1;
  }
}
