// SPDX-License-Identifier: MIT

// The paper's Tables 1 and 2 (seconds over faces and over seeds) and its test of stability against shifted seeds
// (Fig. 6), beside the paper's own figures.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/internal/walk/Graph_walk.h>
#include <RW_segmentation/segmentation_via_random_walks.h>

#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <CLI/CLI.hpp>

#include "measurement.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <limits>
#include <queue>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using measurement::Mesh;
using measurement::Result;
using RW_segmentation::Dual_graph;
using Index = Dual_graph::Index;

// ---- Tables 1 and 2 ----

/// Collapses edges until so many faces are left.
class Face_number_stop {
 public:
  explicit Face_number_stop(std::size_t faces) : edges_(3 * faces / 2) {}
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile&, std::size_t, std::size_t edges) const {
    return edges <= edges_;
  }

 private:
  std::size_t edges_;
};

Mesh hand_of(std::size_t faces) {
  Mesh mesh = measurement::mesh_of_size("160k");
  CGAL::Surface_mesh_simplification::edge_collapse(mesh, Face_number_stop(faces));
  mesh.collect_garbage();
  return mesh;
}

/// From the mesh to labels: difference, conductances and walk. The median of several runs.
double segmentation_milliseconds(const Mesh& mesh, std::size_t seeds, std::size_t repeats) {
  const std::vector<Mesh::Face_index> faces = measurement::random_faces(mesh, seeds);
  std::vector<std::size_t> ids(mesh.number_of_faces());
  std::vector<double> times;
  for (std::size_t r = 0; r < repeats; ++r) {
    const measurement::Stopwatch watch;
    const RW_segmentation::Dihedral_difference<Mesh> difference(mesh);
    RW_segmentation::segmentation_from_seeds(
        mesh, RW_segmentation::Conductance<Mesh>(mesh, difference), faces,
        boost::make_iterator_property_map(ids.begin(), get(boost::face_index, mesh)));
    times.push_back(watch.milliseconds());
  }
  return measurement::median(times);
}

void tables(std::size_t repeats, std::vector<Result>& results) {
  const auto row = [&](int table, std::size_t faces, const Mesh& mesh, std::size_t seeds, double paper_seconds) {
    const double ms = segmentation_milliseconds(mesh, seeds, repeats);
    std::printf("%5zuK faces %3zu seeds %9.2f ms   paper %6.0f ms   %5.0f times\n", faces, seeds, ms,
                1000 * paper_seconds, 1000 * paper_seconds / ms);
    std::fflush(stdout);
    results.push_back(
        Result("paper").add("table", table).add("faces", std::to_string(faces) + "k").add("seeds", seeds));
    results.back().add("ms", ms).add("paper_ms", 1000 * paper_seconds).add("ratio", 1000 * paper_seconds / ms);
  };
  std::puts("Tables 1 and 2: mesh to labels, one core (the paper: MATLAB on a Core2Duo of 2 GHz)");
  const std::pair<std::size_t, double> table_1[] = {{10, 0.34}, {15, 0.47}, {20, 0.64}, {30, 1.00}, {40, 1.34}};
  const std::pair<std::size_t, double> table_2[] = {{6, 1.3}, {12, 2.1}, {24, 3.4}, {48, 6.5}};
  for (const auto& [faces, seconds] : table_1) row(1, faces, hand_of(1000 * faces), 6, seconds);
  const Mesh mesh = hand_of(40000);
  for (const auto& [seeds, seconds] : table_2) row(2, 40, mesh, seeds, seconds);
}

// ---- Fig. 6 ----

struct Model {
  std::string name;
  std::string file;
  std::size_t segments;
  bool is_engineering;  // then convex edges count as much as concave ones
  std::string paper;    // the figure of a model of that kind at 30 %
};

/// Geodesic distances from some faces, the lengths of paths over centroids, as far as `radius`.
std::vector<double> distances(const Dual_graph& graph, const std::vector<double>& length,
                              const std::vector<Index>& sources, double radius) {
  std::vector<double> distance(graph.number_of_faces(), radius);
  std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>, std::greater<>> open;
  for (const Index face : sources) open.push({distance[face] = 0, face});
  while (!open.empty()) {
    const auto [way, face] = open.top();
    open.pop();
    if (way > distance[face]) continue;
    for (const auto& [next, edge] : graph.neighbours(face))
      if (way + length[edge] < distance[next]) open.push({distance[next] = way + length[edge], next});
  }
  return distance;
}

/// One seed in each segment, as a user would click: the face farthest from the segment's boundary.
std::vector<Index> innermost_faces(const Dual_graph& graph, const std::vector<double>& length,
                                   const std::vector<std::size_t>& segment, std::size_t segments) {
  std::vector<Index> border;
  for (Index e = 0; e < graph.number_of_edges(); ++e) {
    const auto [f, g] = graph.faces_of(e);
    if (segment[f] != segment[g]) border.insert(border.end(), {f, g});
  }
  const std::vector<double> depth = distances(graph, length, border, std::numeric_limits<double>::infinity());
  std::vector<Index> innermost(segments, static_cast<Index>(graph.number_of_faces()));
  for (Index f = 0; f < graph.number_of_faces(); ++f) {
    Index& best = innermost[segment[f]];
    if (best == graph.number_of_faces() || depth[f] > depth[best]) best = f;
  }
  return innermost;
}

/// The mean share of faces that keep their label when every seed moves at random within a distance and its segment.
void stability(const Model& model, std::size_t trials, std::vector<Result>& results) {
  const Mesh mesh = measurement::read_mesh(measurement::data_mesh(model.file));
  const RW_segmentation::Dual_mesh_of<Mesh> dual(mesh);
  const RW_segmentation::Dual_graph& graph = dual.graph();
  const double convex_weight = model.is_engineering ? 1 : 0.2;
  const RW_segmentation::Conductance conductance(dual, RW_segmentation::Dihedral_difference(dual, convex_weight));
  std::vector<double> conductances, length;
  for (Index e = 0; e < graph.number_of_edges(); ++e) {
    const auto [f, g] = graph.faces_of(e);
    conductances.push_back(get(conductance, dual.edge(e)));
    length.push_back((dual.centroid(f) - dual.centroid(g)).norm());
  }

  RW_segmentation::Automatic_segmentation policy(model.segments);
  if (model.is_engineering) policy.difference.convex_weight = 1;
  std::vector<std::size_t> segment_of_face(mesh.number_of_faces());
  const auto segment_map = boost::make_iterator_property_map(segment_of_face.begin(), get(boost::face_index, mesh));
  RW_segmentation::segmentation_via_random_walks(dual, segment_map, policy);
  const std::vector<std::size_t> segment = dual.read_segments(segment_map);
  const std::vector<Index> seeds = innermost_faces(graph, length, segment, model.segments);
  RW_segmentation::internal::Graph_walk walk(graph, conductances);
  const auto labels_from = [&](const std::vector<Index>& from) -> const std::vector<std::size_t>& {
    walk.clear_seeds();
    for (std::size_t l = 0; l < from.size(); ++l) walk.add_seed(from[l], l);
    return walk.labels();
  };
  const std::vector<std::size_t> reference = labels_from(seeds);

  std::printf("%-12s %6zu faces %3zu seeds  ", model.name.c_str(), graph.number_of_faces(), seeds.size());
  std::mt19937 random(1);
  for (int percent = 3; percent <= 30; percent += 3) {
    std::vector<std::vector<Index>> near;
    for (const Index seed : seeds) {
      const std::vector<double> distance = distances(graph, length, {seed}, percent / 100.);
      near.emplace_back();
      for (Index f = 0; f < distance.size(); ++f)
        if (distance[f] < percent / 100. && reference[f] == reference[seed]) near.back().push_back(f);
    }
    double coverage = 0;
    for (std::size_t trial = 0; trial < trials; ++trial) {
      std::vector<Index> moved;
      for (const auto& candidates : near) moved.push_back(candidates[random() % candidates.size()]);
      const auto& labels = labels_from(moved);
      std::size_t equal = 0;
      for (std::size_t f = 0; f < labels.size(); ++f) equal += labels[f] == reference[f];
      coverage += static_cast<double>(equal) / static_cast<double>(labels.size() * trials);
    }
    std::printf(" %5.1f", 100 * coverage);
    std::fflush(stdout);
    results.push_back(Result("stability").add("mesh", model.name).add("seeds", seeds.size()).add("shift", percent));
    results.back().add("coverage", coverage);
  }
  std::printf("   %s\n", model.paper.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("The paper's Tables 1 and 2 and its stability test (Fig. 6), beside its own figures");
  std::size_t repeats = 5, trials = 100;
  bool no_tables = false, no_stability = false;
  app.add_option("--repeats", repeats, "runs of each timing, of which the median counts")->check(CLI::PositiveNumber);
  app.add_option("--trials", trials, "random shifts for each distance")->check(CLI::PositiveNumber);
  app.add_flag("--no-tables", no_tables, "leave out Tables 1 and 2");
  app.add_flag("--no-stability", no_stability, "leave out Fig. 6");
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<Result> results;
    if (!no_tables) tables(repeats, results);
    if (!no_stability) {
      std::puts("\nFig. 6: % of the faces with the same label, seeds shifted by up to 3, 6, ... 30 % of the diagonal");
      for (const Model& model :
           {Model{"anchor", "anchor_dense.off", 10, true, "(strong creases; paper, hand skeleton: above 99.6)"},
            Model{"hand", "hand.off", 6, false, "(paper, hand: above 96.5)"},
            Model{"fandisk", "fandisk.off", 25, true, "(paper: above 91)"},
            Model{"bull", "bull.off", 7, false, "(paper, horse: above 84)"},
            Model{"elephant", "elephant.off", 8, false, ""}, Model{"camel", "camel.off", 7, false, ""}})
        stability(model, trials, results);
    }
    measurement::print(results);
  } catch (const std::exception& error) {
    std::cerr << "benchmark_paper: " << error.what() << '\n';
    return 1;
  }
}
