// SPDX-License-Identifier: MIT

// How the automatic segmentation grows with the mesh: the time of each stage, the memory, and the exponents of both.

#include "measurement.h"

#include <RW_segmentation/segmentation_via_random_walks.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <CLI/CLI.hpp>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace RW_segmentation;
using namespace measurement;

namespace {

struct Arguments {
  std::vector<std::string> meshes;
  std::vector<std::string> sizes = {"10k", "40k", "160k", "640k", "1000k", "2500k"};
  std::vector<std::string> families = {"subdivided", "unstructured"};
  std::string path = "default";
  std::size_t repeats = 3;
  std::size_t threads = 1;
};

constexpr std::array stage_names = {"mesh", "normals",        "conductances", "ordering", "seeds",
                                    "walk", "other seedings", "thickness",    "merging"};

// ---- Meshes ----

/// Flips an edge where its two triangles make a convex quadrilateral and no edge joins the opposite corners already.
void flip_if_possible(Mesh& mesh, Mesh::Edge_index edge) {
  if (mesh.is_border(edge)) return;
  const auto h = mesh.halfedge(edge), g = mesh.opposite(h);
  const auto a = mesh.source(h), b = mesh.target(h), c = mesh.target(mesh.next(h)), d = mesh.target(mesh.next(g));
  if (c == d || mesh.halfedge(c, d).is_valid()) return;
  const auto area_vector = [&](auto u, auto v, auto w) {
    return CGAL::cross_product(mesh.point(v) - mesh.point(u), mesh.point(w) - mesh.point(u));
  };
  const auto own = area_vector(a, b, c);
  if (area_vector(a, d, c) * own > 0 && area_vector(b, c, d) * own > 0) CGAL::Euler::flip_edge(h, mesh);
}

/// The mesh without the regularity that subdivision leaves: vertices have slid towards a neighbour, a fifth of the edges
/// is flipped, and the order of the faces tells nothing about where they are.
Mesh unstructured(Mesh mesh) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 0.4);
  std::vector<Mesh::Point> moved;
  for (const auto v : mesh.vertices()) {
    auto h = mesh.halfedge(v);
    for (auto turns = random() % mesh.degree(v); turns > 0; --turns) h = mesh.opposite(mesh.next(h));
    const auto& p = mesh.point(v);
    moved.push_back(p + share(random) * (mesh.point(mesh.source(h)) - p));
  }
  for (const auto v : mesh.vertices()) mesh.point(v) = moved[v];
  for (const auto e : mesh.edges())
    if (random() % 5 == 0) flip_if_possible(mesh, e);

  Mesh shuffled;
  shuffled.reserve(mesh.number_of_vertices(), mesh.number_of_edges(), mesh.number_of_faces());
  for (const auto v : mesh.vertices()) shuffled.add_vertex(mesh.point(v));
  std::vector<Mesh::Face_index> order(mesh.faces_begin(), mesh.faces_end());
  std::shuffle(order.begin(), order.end(), random);
  for (const auto f : order) shuffled.add_face(mesh.vertices_around_face(mesh.halfedge(f)));
  return shuffled;
}

// ---- Measurements ----

struct Measurement {
  std::string family, path;
  double faces, milliseconds, megabytes;
};

/// With the walk over the faces, over clusters of them, or as large meshes have it by default.
Automatic_segmentation policy_of(const std::string& path) {
  Automatic_segmentation policy;
  if (path == "direct") policy.reduction.largest_direct = std::numeric_limits<std::size_t>::max();
  if (path == "reduced") policy.reduction.largest_direct = 0;
  return policy;
}

/// Segments, clusters, milliseconds, memory above the mesh in MB, and the milliseconds of the stages.
std::vector<double> run(Mesh& mesh, const Arguments& arguments) {
  constexpr double long_run = 5000;  // ms; is not repeated
#ifdef CGAL_LINKED_WITH_TBB
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, arguments.threads);
#endif
  const auto labels = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:segment").first;
  const double before = resident_mb();
  const Automatic_segmentation policy = policy_of(arguments.path);
  std::size_t segments = 0, clusters = 0;
  std::vector<double> total;
  std::array<std::vector<double>, stage_names.size()> stages;
  while (total.size() < arguments.repeats && (total.empty() || total.front() < long_run)) {
    const Stopwatch watch;
    const auto hierarchy = hierarchy_via_random_walks(mesh, policy);
    segments = hierarchy.segments([&](const Merge_tree& tree) { return policy.stop(tree); }, labels);
    total.push_back(watch.milliseconds());
    clusters = hierarchy.report().clusters;
    for (std::size_t s = 0; s < stages.size(); ++s) {
      const Segmentation_report::Stage& stage = hierarchy.report().stages.at(s);
      if (stage.name != stage_names[s]) throw std::logic_error("there is a new stage: " + stage.name);
      stages[s].push_back(1000 * stage.seconds);
    }
  }
  std::vector<double> numbers = {static_cast<double>(segments), static_cast<double>(clusters), median(total),
                                 peak_mb() - before};
  for (const auto& stage : stages) numbers.push_back(median(stage));
  return numbers;
}

/// Measures one mesh, tells about it, and appends the result.
void measure(const std::string& family, const std::string& size, Mesh& mesh, double read_ms, const Arguments& arguments,
             std::vector<Measurement>& measurements, std::vector<Result>& results) {
  const std::size_t faces = num_faces(mesh);
  const Outcome outcome = in_own_process([&] { return run(mesh, arguments); });
  if (!outcome.failure.empty()) throw std::runtime_error(family + ' ' + size + ": " + outcome.failure);
  const auto& n = outcome.numbers;
  const double segments = n[0], clusters = n[1], total_ms = n[2], above_mesh_mb = n[3];
  const char* path = clusters > 0 ? "reduced" : "direct";
  const double us_per_face = 1000 * total_ms / static_cast<double>(faces);
  measurements.push_back({family, path, static_cast<double>(faces), total_ms, above_mesh_mb});
  std::printf("%-13s %-7s %-7s %9zu %9.0f %9.0f %8.2f %8.0f %9.0f %9.0f ", family.c_str(), size.c_str(), path, faces,
              read_ms, total_ms, us_per_face, above_mesh_mb, 1e6 * above_mesh_mb / static_cast<double>(faces),
              segments);
  Result& result = results.emplace_back("scaling");
  result.add("family", family).add("size", size).add("faces", faces).add("path", path);
  result.add("threads", arguments.threads).add("read_ms", read_ms).add("total_ms", total_ms);
  result.add("us_per_face", us_per_face).add("above_mesh_mb", above_mesh_mb).add("segments", segments);
  if (clusters > 0) result.add("clusters", clusters);
  for (std::size_t s = 0; s < stage_names.size(); ++s) {
    std::printf(" %12.0f", n[4 + s]);
    result.add((std::string(stage_names[s]) + "_ms").c_str(), n[4 + s]);
  }
  std::printf("\n");
  std::fflush(stdout);
}

/// The slope of log y over log x by least squares.
double exponent(const std::vector<std::pair<double, double>>& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(points.size());
  for (const auto& [px, py] : points) {
    x += std::log(px) / n;
    y += std::log(py) / n;
  }
  for (const auto& [px, py] : points) {
    xx += (std::log(px) - x) * (std::log(px) - x);
    xy += (std::log(px) - x) * (std::log(py) - y);
  }
  return xy / xx;
}

/// Fits the growth of a family on a path from 100 000 faces on, where there are sizes enough.
void fit(const std::string& family, const std::string& path, const std::vector<Measurement>& measurements,
         std::vector<Result>& results) {
  std::vector<std::pair<double, double>> times, memories;
  for (const Measurement& m : measurements) {
    if (m.family != family || m.path != path || m.faces < 1e5) continue;
    times.emplace_back(m.faces, m.milliseconds);
    memories.emplace_back(m.faces, m.megabytes);
  }
  if (times.size() < 2) return;
  const double of_time = exponent(times), of_memory = exponent(memories);
  std::printf("%s, %s, from %.0f to %.0f faces: time grows with the power %.2f, memory with %.2f\n", family.c_str(),
              path.c_str(), times.front().first, times.back().first, of_time, of_memory);
  Result& result = results.emplace_back("scaling_exponent");
  result.add("family", family).add("path", path).add("from", times.front().first).add("to", times.back().first);
  result.add("time", of_time).add("memory", of_memory);
}

}  // namespace

int main(int argc, char** argv) try {
  Arguments arguments;
  CLI::App app(
      "Times the automatic segmentation on growing meshes, stage by stage, with the memory that it takes above the "
      "mesh, and fits the exponents of growth from 100 000 faces on. Each measurement has a process of its own.");
  app.add_option("MESH", arguments.meshes, "Mesh files of your own")->check(CLI::ExistingFile);
  app.add_option("--sizes", arguments.sizes, "Of the meshes to make")
      ->delimiter(',')
      ->check(CLI::IsMember(sizes()))
      ->capture_default_str()
      ->excludes("MESH");
  app.add_option("--families", arguments.families, "A subdivided mesh, or that mesh made irregular and shuffled")
      ->delimiter(',')
      ->check(CLI::IsMember({"subdivided", "unstructured"}))
      ->capture_default_str()
      ->excludes("MESH");
  app.add_option("--path", arguments.path, "Whether walks run over faces or over clusters of them")
      ->check(CLI::IsMember({"direct", "reduced", "default"}))
      ->capture_default_str();
  app.add_option("--repeats", arguments.repeats, "Runs whose median counts; those above 5 s are not repeated")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", arguments.threads, "Where TBB is linked")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::vector<Measurement> measurements;
  std::vector<Result> results;
  std::printf("%-13s %-7s %-7s %9s %9s %9s %8s %8s %9s %9s ", "family", "size", "path", "faces", "read ms", "total ms",
              "us/face", "MB", "byte/face", "segments");
  for (const char* stage : stage_names) std::printf(" %12s", stage);
  std::printf("\n");
  if (arguments.meshes.empty())
    for (const std::string& family : arguments.families) {
      for (const std::string& size : arguments.sizes) {
        Mesh mesh = family == "unstructured" ? unstructured(mesh_of_size(size)) : mesh_of_size(size);
        measure(family, size, mesh, milliseconds_to_read(mesh), arguments, measurements, results);
      }
      for (const char* path : {"direct", "reduced"}) fit(family, path, measurements, results);
    }
  for (const std::string& path : arguments.meshes) {
    const double read_ms = milliseconds_to_read(path);
    Mesh mesh = read_mesh(path);
    measure("own", std::filesystem::path(path).stem().string(), mesh, read_ms, arguments, measurements, results);
  }
  print(results);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "benchmark_scaling: " << error.what() << '\n';
  return 1;
}
