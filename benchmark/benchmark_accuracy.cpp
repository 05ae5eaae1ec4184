// SPDX-License-Identifier: MIT

// How right the default solver is: against a dense solve with 500 digits, and after random edits of the seeds against a
// factorisation made afresh.

#include "../test/networks.h"
#include "measurement.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Random_walk.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <CLI/CLI.hpp>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace RW_segmentation;
using networks::Index;
using networks::Network;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The dual of a data mesh with its conductances.
Network mesh_network(const std::string& name, double cap) {
  const measurement::Mesh mesh = measurement::read_mesh(measurement::data_mesh(name));
  const Dual_mesh_of dual(mesh);
  const Conductance conductance(dual, Dihedral_difference(dual), 1, cap);
  Network network{dual.graph(), {}};
  for (const auto e : dual.edge_descriptors()) network.conductances.push_back(get(conductance, e));
  return network;
}

// ---- Against 500 digits ----

using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<500>>;

struct Exactness {
  double largest_relative_error = 0;  // potentials below 1e-290 left out: a double cannot tell them
  std::size_t labels = 0, equal_labels = 0;

  void add(const Network& network, const std::vector<Index>& seeds) {
    Star_mesh_elimination solver;
    const Potentials potentials = networks::potentials(solver, network, seeds);
    const auto exact = networks::dense_potentials<Exact>(network, seeds);
    for (std::size_t f = 0; f < exact.size(); ++f) {
      for (std::size_t l = 0; l < seeds.size(); ++l) {
        if (exact[f][l] < 1e-290) continue;
        const double computed = potentials(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(l));
        const auto error = static_cast<double>(abs(computed / exact[f][l] - 1));
        largest_relative_error = std::max(largest_relative_error, error);
      }
      Eigen::Index label = 0;
      potentials.row(static_cast<Eigen::Index>(f)).maxCoeff(&label);
      const auto exact_label = std::max_element(exact[f].begin(), exact[f].end()) - exact[f].begin();
      ++labels;
      equal_labels += label == exact_label;
    }
  }

  double share_of_equal_labels() const { return static_cast<double>(equal_labels) / static_cast<double>(labels); }
};

Exactness random_networks(double decades, std::size_t networks, std::size_t faces) {
  Exactness exactness;
  std::mt19937 random(1);
  for (std::size_t k = 0; k < networks; ++k) {
    const auto width = static_cast<std::size_t>(std::sqrt(static_cast<double>(faces) / 2));
    Network network{k % 2 ? networks::random_graph(faces, random) : networks::triangulated_torus(width), {}};
    network.conductances = networks::spread_conductances(network.graph.number_of_edges(), decades, random);
    exactness.add(network, networks::random_faces(network.graph, 4, random));
  }
  return exactness;
}

// ---- After edits ----

struct Edits {
  double largest_error = 0;
  std::size_t wrong_labels = 0;  // where the two largest potentials differ by more than `label_margin`
  std::size_t factorisations = 0, columns_added = 0;
};
constexpr double label_margin = 1e-8;

/// Adds a seed, removes one or changes the label of one.
void edit_at_random(internal::Graph_walk& walk, Index faces, std::mt19937& random) {
  constexpr std::size_t fewest_seeds = 3, most_seeds = 16, labels = 8;
  const auto action = random() % 5;
  const std::size_t seeds = walk.seeds().size();
  if (seeds < fewest_seeds || (action < 2 && seeds < most_seeds))
    walk.add_seed(static_cast<Index>(random() % faces), random() % labels);
  else if (action < 4)
    walk.remove_seed(walk.seeds()[random() % seeds].face);
  else
    walk.add_seed(walk.seeds()[random() % seeds].face, random() % labels);
}

/// Holds the potentials and labels of a walk against those of a factorisation with its seeds.
void compare(internal::Graph_walk& walk, const Network& network, Edits& edits) {
  std::vector<Index> faces;
  std::map<std::size_t, std::vector<Eigen::Index>> columns;
  for (const auto& seed : walk.seeds()) {
    columns[seed.label].push_back(static_cast<Eigen::Index>(faces.size()));
    faces.push_back(seed.face);
  }
  Star_mesh_elimination fresh;
  const Potentials expected = networks::potentials(fresh, network, faces);
  const Eigen::Index n = expected.rows();
  Eigen::ArrayXd largest = Eigen::ArrayXd::Constant(n, -1), second = largest;
  std::vector<std::size_t> label(static_cast<std::size_t>(n), 0);
  for (const auto& [l, own] : columns) {
    const Eigen::VectorXd sum = expected(Eigen::all, own).rowwise().sum();
    const std::vector<double> potential = walk.potential(l);
    for (Eigen::Index f = 0; f < n; ++f) {
      const auto face = static_cast<std::size_t>(f);
      edits.largest_error = std::max(edits.largest_error, std::abs(potential[face] - sum[f]));
      second[f] = std::max(second[f], std::min(sum[f], largest[f]));
      if (sum[f] > largest[f]) {
        largest[f] = sum[f];
        label[face] = l;
      }
    }
  }
  const std::vector<std::size_t>& raw = walk.raw_labels();
  for (std::size_t f = 0; f < raw.size(); ++f) {
    const auto row = static_cast<Eigen::Index>(f);
    edits.wrong_labels += largest[row] - second[row] > label_margin && raw[f] != label[f];
  }
}

Edits random_edits(const Network& network, std::size_t number) {
  Edits edits;
  std::mt19937 random(2);
  const auto faces = static_cast<Index>(network.graph.number_of_faces());
  internal::Graph_walk walk(network.graph, network.conductances);
  for (std::size_t l = 0; l < 6; ++l) walk.add_seed(static_cast<Index>(random() % faces), l);
  walk.labels();
  for (std::size_t edit = 0; edit < number; ++edit) {
    edit_at_random(walk, faces, random);
    compare(walk, network, edits);
  }
  edits.factorisations = walk.report().factorisations;
  edits.columns_added = walk.report().columns_added;
  return edits;
}

Network spread_torus(std::size_t width, double decades) {
  std::mt19937 random(3);
  Network network{networks::triangulated_torus(width), {}};
  network.conductances = networks::spread_conductances(network.graph.number_of_edges(), decades, random);
  return network;
}

}  // namespace

int main(int argc, char** argv) try {
  std::size_t networks = 40, faces = 72, edits = 1000;
  std::string small_mesh = "patch-23.off", mesh = "fandisk.off";
  CLI::App app(
      "Holds the potentials of the default solver against a dense solve with 500 digits, and those after random edits "
      "of the seeds against a factorisation made afresh.");
  app.add_option("--networks", networks, "To compare with 500 digits, for each spread")->capture_default_str();
  app.add_option("--faces", faces, "Of each network")->check(CLI::Range(8, 400))->capture_default_str();
  app.add_option("--small-mesh", small_mesh, "To compare with 500 digits, of CGAL's data")->capture_default_str();
  app.add_option("--edits", edits, "On each network and mesh")->capture_default_str();
  app.add_option("--mesh", mesh, "To edit on, of CGAL's data")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::vector<measurement::Result> results;
  double largest_relative_error = 0, equal_labels = 1, largest_edit_error = 0;
  std::size_t wrong_labels = 0;
  std::printf("Against 500 digits\n%-28s %22s %14s\n", "", "largest relative error", "equal labels");
  const auto tell_exactness = [&](const std::string& input, const Exactness& e) {
    const double share = e.share_of_equal_labels();
    std::printf("%-28s %22.2g %12.4f %%\n", input.c_str(), e.largest_relative_error, 100 * share);
    std::fflush(stdout);
    largest_relative_error = std::max(largest_relative_error, e.largest_relative_error);
    equal_labels = std::min(equal_labels, share);
    results.emplace_back("accuracy").add("part", "exact").add("input", input);
    results.back().add("max_relative_error", e.largest_relative_error).add("equal_labels", share);
  };
  for (const int decades : {1, 9, 20, 100, 200})
    tell_exactness("networks_1e-" + std::to_string(decades) + "..1", random_networks(decades, networks, faces));
  for (const double cap : {20., infinity}) {
    const Network network = mesh_network(small_mesh, cap);
    std::mt19937 random(4);
    Exactness exactness;
    exactness.add(network, networks::random_faces(network.graph, 6, random));
    tell_exactness(small_mesh + (cap < infinity ? "_capped" : "_uncapped"), exactness);
  }

  std::printf("\nAfter each of %zu random edits\n%-28s %22s %14s %15s\n", edits, "", "largest absolute error",
              "wrong labels", "factorisations");
  const auto tell_edits = [&](const std::string& input, const Edits& e) {
    std::printf("%-28s %22.2g %14zu %15zu\n", input.c_str(), e.largest_error, e.wrong_labels, e.factorisations);
    std::fflush(stdout);
    largest_edit_error = std::max(largest_edit_error, e.largest_error);
    wrong_labels += e.wrong_labels;
    results.emplace_back("accuracy").add("part", "edits").add("input", input).add("edits", edits);
    results.back().add("max_absolute_error", e.largest_error).add("wrong_labels", e.wrong_labels);
    results.back().add("factorisations", e.factorisations).add("columns_added", e.columns_added);
  };
  tell_edits("torus_1e-9..1", random_edits(spread_torus(24, 9), edits));
  tell_edits("torus_1e-200..1", random_edits(spread_torus(24, 200), edits));
  tell_edits(mesh + "_capped", random_edits(mesh_network(mesh, 20), edits));
  tell_edits(mesh + "_uncapped", random_edits(mesh_network(mesh, infinity), edits));

  results.emplace_back("accuracy").add("part", "all").add("max_relative_error", largest_relative_error);
  results.back().add("equal_labels", equal_labels).add("edits", edits);
  results.back()
      .add("max_absolute_error_after_edits", largest_edit_error)
      .add("wrong_labels_after_edits", wrong_labels);
  measurement::print(results);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "benchmark_accuracy: " << error.what() << '\n';
  return 1;
}
