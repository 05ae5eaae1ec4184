// SPDX-License-Identifier: MIT

// The automatic segmentation beside CGAL's segmentation by shape diameters, on the same meshes in the same run: time by
// stage, memory, and how both grow. One thread each.

// The maximum flow of CGAL 5.5.1 does not reset its flow between two cuts, which spoils the segmentations by SDF.
#define CGAL_DO_NOT_USE_BOYKOV_KOLMOGOROV_MAXFLOW_SOFTWARE

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // in Boost's maximum flow
#endif

#include "measurement.h"

#include <RW_segmentation/segmentation_via_random_walks.h>

#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/mesh_segmentation.h>
#include <CGAL/subdivision_method_3.h>

#include <CLI/CLI.hpp>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace RW_segmentation;
using namespace measurement;

namespace {

struct Arguments {
  std::vector<std::string> meshes;
  std::vector<std::string> data_meshes = {"armadillo", "camel", "man"};
  std::vector<std::string> sizes = {"10k", "40k", "160k", "640k"};
  std::size_t repeats = 3;
};

const std::map<std::string, unsigned int> subdivisions = {{"10k", 0}, {"40k", 1}, {"160k", 2}, {"640k", 3}};

// ---- Meshes ----

/// Ends an edge collapse at a number of edges. CGAL's own predicate changed its name between versions.
struct Edge_count_stop {
  std::size_t edges;
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile&, std::size_t, std::size_t current) const {
    return current <= edges;
  }
};

/// A data mesh simplified to 10 000 faces and subdivided from there.
Mesh data_mesh_of_size(const std::string& name, const std::string& size) {
  Mesh mesh = read_mesh(data_mesh(name + ".off"));
  CGAL::Surface_mesh_simplification::edge_collapse(mesh, Edge_count_stop{15000});
  mesh.collect_garbage();
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(subdivisions.at(size)));
  return mesh;
}

// ---- Measurements ----

using Labels = Mesh::Property_map<Mesh::Face_index, std::size_t>;
using Segments = std::size_t;

/// Milliseconds, memory above the mesh in MB, segments, and the milliseconds of two stages.
std::vector<double> repeated(Mesh& mesh, std::size_t repeats,
                             const std::function<Segments(Mesh&, Labels, double&, double&)>& segment) {
  constexpr double long_run = 5000;  // ms; is not repeated
  const Labels labels = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  const double before = resident_mb();
  Segments segments = 0;
  std::vector<double> total, first, second;
  while (total.size() < repeats && (total.empty() || total.front() < long_run)) {
    const Stopwatch watch;
    segments = segment(mesh, labels, first.emplace_back(), second.emplace_back());
    total.push_back(watch.milliseconds());
  }
  return {median(total), peak_mb() - before, static_cast<double>(segments), median(first), median(second)};
}

/// Ours; the stages are those up to the end of the walk, and the merging.
Segments by_walks(Mesh& mesh, Labels labels, double& walk_ms, double& merging_ms) {
#ifdef CGAL_LINKED_WITH_TBB
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
#endif
  const Automatic_segmentation policy;
  const auto hierarchy = hierarchy_via_random_walks(mesh, policy);
  double* stage_ms = &walk_ms;
  for (const auto& stage : hierarchy.report().stages) {
    *stage_ms += 1000 * stage.seconds;
    if (stage.name == "walk") stage_ms = &merging_ms;
  }
  return hierarchy.segments([&](const Merge_tree& tree) { return policy.stop(tree); }, labels);
}

/// CGAL's, with its own default parameters.
Segments by_shape_diameters(Mesh& mesh, Labels labels, double& diameters_ms, double& cut_ms) {
  const auto diameters = mesh.add_property_map<Mesh::Face_index, double>("f:diameter").first;
  const Stopwatch first;
  CGAL::sdf_values(mesh, diameters);
  diameters_ms = first.milliseconds();
  const Stopwatch second;
  const Segments segments = CGAL::segmentation_from_sdf_values(mesh, diameters, labels);
  cut_ms = second.milliseconds();
  return segments;
}

struct Comparison {
  double faces, ours_ms, sdf_ms;
};

/// Measures both on a mesh, tells about it, and appends the result.
Comparison compare(const std::string& name, const std::string& size, Mesh& mesh, const Arguments& arguments,
                   std::vector<Result>& results) {
  const auto faces = static_cast<double>(num_faces(mesh));
  const auto numbers_of = [&](const auto& segment) {
    const Outcome outcome = in_own_process([&] { return repeated(mesh, arguments.repeats, segment); });
    if (!outcome.failure.empty()) throw std::runtime_error(name + ' ' + size + ": " + outcome.failure);
    return outcome.numbers;
  };
  const auto ours = numbers_of(by_walks), sdf = numbers_of(by_shape_diameters);
  const double ratio = sdf[0] / ours[0];
  std::printf("%-12s %-6s %8.0f %9.0f %8.2f %8.0f %5.0f %10.0f %8.2f %8.0f %5.0f %8.1f\n", name.c_str(), size.c_str(),
              faces, ours[0], 1000 * ours[0] / faces, ours[1], ours[2], sdf[0], 1000 * sdf[0] / faces, sdf[1], sdf[2],
              ratio);
  std::fflush(stdout);
  Result& result = results.emplace_back("sdf");
  result.add("mesh", name).add("size", size).add("faces", faces).add("path", "direct");
  result.add("ours_ms", ours[0]).add("sdf_ms", sdf[0]).add("ratio", ratio);
  result.add("ours_us_per_face", 1000 * ours[0] / faces).add("sdf_us_per_face", 1000 * sdf[0] / faces);
  result.add("ours_walk_ms", ours[3]).add("ours_merging_ms", ours[4]);
  result.add("sdf_diameters_ms", sdf[3]).add("sdf_cut_ms", sdf[4]);
  result.add("ours_mb", ours[1]).add("sdf_mb", sdf[1]).add("ours_segments", ours[2]).add("sdf_segments", sdf[2]);
  return {faces, ours[0], sdf[0]};
}

/// The exponents with which the times grow from the smallest to the largest size of a mesh.
void add_growth(const std::string& name, const std::vector<Comparison>& sizes, std::vector<Result>& results) {
  if (sizes.size() < 2) return;
  const Comparison &small = sizes.front(), &large = sizes.back();
  const double factor = std::log(large.faces / small.faces);
  const double ours = std::log(large.ours_ms / small.ours_ms) / factor;
  const double sdf = std::log(large.sdf_ms / small.sdf_ms) / factor;
  std::printf("%-12s from %.0f to %.0f faces the time grows with the power %.2f, that of SDF with %.2f\n", name.c_str(),
              small.faces, large.faces, ours, sdf);
  results.emplace_back("sdf_growth").add("mesh", name).add("ours", ours).add("sdf", sdf);
}

}  // namespace

int main(int argc, char** argv) try {
  Arguments arguments;
  CLI::App app(
      "Times the automatic segmentation beside CGAL's segmentation by shape diameters (SDF) with default parameters, "
      "one thread each, on the same meshes. SDF takes minutes on 640k faces. Each measurement has a process of its "
      "own.");
  app.add_option("MESH", arguments.meshes, "Mesh files of your own")->check(CLI::ExistingFile);
  app.add_option("--data-meshes", arguments.data_meshes, "CGAL's meshes to take, simplified and subdivided to size")
      ->delimiter(',')
      ->capture_default_str()
      ->excludes("MESH");
  app.add_option("--sizes", arguments.sizes, "Of these")
      ->delimiter(',')
      ->check(CLI::IsMember({"10k", "40k", "160k", "640k"}))
      ->capture_default_str()
      ->excludes("MESH");
  app.add_option("--repeats", arguments.repeats, "Runs whose median counts; those above 5 s are not repeated")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::vector<Result> results;
  std::printf("%-12s %-6s %8s %9s %8s %8s %5s %10s %8s %8s %5s %8s\n", "mesh", "size", "faces", "ours ms", "us/face",
              "MB", "seg.", "SDF ms", "us/face", "MB", "seg.", "ratio");
  if (arguments.meshes.empty())
    for (const std::string& name : arguments.data_meshes) {
      std::vector<Comparison> comparisons;
      for (const std::string& size : arguments.sizes) {
        Mesh mesh = data_mesh_of_size(name, size);
        comparisons.push_back(compare(name, size, mesh, arguments, results));
      }
      add_growth(name, comparisons, results);
    }
  for (const std::string& path : arguments.meshes) {
    Mesh mesh = read_mesh(path);
    compare(std::filesystem::path(path).stem().string(), "own", mesh, arguments, results);
  }
  print(results);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "benchmark_against_sdf: " << error.what() << '\n';
  return 1;
}
