// SPDX-License-Identifier: MIT

// A pipeline composed by hand of stages that share one Dual_mesh_of, beside the one call: its time, and whether the labels
// are the same.

#include "measurement.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/fragments_via_random_walks.h>
#include <RW_segmentation/local_thickness.h>
#include <RW_segmentation/merge_segments.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include <CLI/CLI.hpp>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <cstddef>
#include <cstdio>
#include <exception>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

using namespace RW_segmentation;
using namespace measurement;

namespace {

using Labels = Mesh::Property_map<Mesh::Face_index, std::size_t>;

void segment_by_hand(Mesh& mesh, Labels labels) {
  const Dual_mesh_of dual(mesh);
  const Dual_mesh_of shape = smoothed_shape(dual);
  const Dihedral_difference difference(shape, smoothed_concavity());
  std::vector<Mesh::Face_index> seeds;
  feature_sensitive_seeds(shape, Automatic_segmentation().seeding.count, std::back_inserter(seeds));
  fragments_via_random_walks(shape, Conductance(shape, difference), seeds, labels);
  const auto thickness = mesh.add_property_map<Mesh::Face_index, double>("f:thickness").first;
  local_thickness(shape, thickness);
  const auto hierarchy = merge_segments(shape, labels, difference, Learned_cost(shape, thickness));
  hierarchy.segments(Cost_threshold_stop(1), labels);
}

}  // namespace

int main(int argc, char** argv) try {
  std::string size = "160k";
  std::size_t pairs = 3, threads = 1;
  CLI::App app("A pipeline by hand beside the one call, in turn.");
  app.add_option("--size", size, "Faces of the mesh")->check(CLI::IsMember(sizes()))->capture_default_str();
  app.add_option("--pairs", pairs, "Runs of both whose medians count")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", threads, "Where TBB is linked")->check(CLI::PositiveNumber)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
#ifdef CGAL_LINKED_WITH_TBB
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
#endif

  Mesh mesh = mesh_of_size(size);
  const auto by_hand = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:by_hand").first;
  const auto in_one_call = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:in_one_call").first;
  Automatic_segmentation with_one_seeding;  // as by hand
  with_one_seeding.seedings = 1;
  std::vector<double> hand_ms, call_ms;
  for (std::size_t pair = 0; pair <= pairs; ++pair) {  // the first one warms up
    const Stopwatch hand;
    segment_by_hand(mesh, by_hand);
    const double hand_time = hand.milliseconds();
    const Stopwatch call;
    segmentation_via_random_walks(mesh, in_one_call, with_one_seeding);
    if (pair == 0) continue;
    hand_ms.push_back(hand_time);
    call_ms.push_back(call.milliseconds());
  }
  bool are_equal = true;
  for (const auto f : mesh.faces()) are_equal = are_equal && by_hand[f] == in_one_call[f];

  std::vector<Result> results;
  Result& result = results.emplace_back("pipeline");
  result.add("size", size).add("faces", num_faces(mesh)).add("threads", threads);
  result.add("by_hand_ms", median(hand_ms)).add("one_call_ms", median(call_ms));
  result.add("ratio", median(hand_ms) / median(call_ms)).add("equal_labels", are_equal);
  print(results);
  return are_equal ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "benchmark_pipeline: " << error.what() << '\n';
  return 1;
}
