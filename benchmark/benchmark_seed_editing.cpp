// SPDX-License-Identifier: MIT

// The time to answer an edit of the seeds, labels written each time, against a full redo and against plain passes over
// an array of as many potentials.

#include "measurement.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Random_walk.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <iostream>
#include <random>
#include <string>
#include <vector>

using namespace RW_segmentation;
using namespace measurement;

namespace {

using Conductances = Mesh::Property_map<Mesh::Edge_index, double>;
using Labels = Mesh::Property_map<Mesh::Face_index, std::size_t>;

struct Arguments {
  std::vector<std::string> sizes = {"40k", "160k", "640k"};
  std::string mesh;
  std::size_t seeds = 24;
  std::size_t edits = 20;
  double cap = 20;
};

/// The time of one read-modify-write sweep over an array of faces x seeds numbers.
double milliseconds_of_pass(std::size_t numbers) {
  std::vector<double> potentials(numbers, 0.5);
  std::vector<double> times;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const Stopwatch watch;
    for (double& p : potentials) p = 0.75 * p + 0.125;
    times.push_back(watch.milliseconds());
    if (potentials[numbers / 2] != 0.5) throw std::runtime_error("a pass changed what it must keep");
  }
  return median(times);
}

struct Times {
  std::vector<double> add, remove, redo;
  double first_edit = 0, equal_labels = 1;
  Walk_report report;
};

/// The time of the first answer of two labels.
/// \param anticipates whether the walk works ahead once it has the seed of the first one
double milliseconds_of_two_labels(const Mesh& mesh, const Conductances& conductances, Labels labels, bool anticipates) {
  Random_walk walk(mesh, as_conductance(conductances));
  const auto faces = random_faces(mesh, 2);
  walk.add_seed(faces[0], 0);
  walk.segment(labels);
  if (anticipates) walk.anticipate();
  const Stopwatch watch;
  walk.add_seed(faces[1], 1);
  walk.segment(labels);
  return watch.milliseconds();
}

/// Edits one walk: an added seed, then a removed one, so that the number of seeds stays; and redoes it all.
Times edit(const Mesh& mesh, const Conductances& conductances, Labels labels, Labels redone,
           const Arguments& arguments) {
  Times times;
  const auto faces = random_faces(mesh, arguments.seeds + arguments.edits + 1);
  Random_walk walk(mesh, as_conductance(conductances));
  for (std::size_t s = 0; s < arguments.seeds; ++s) walk.add_seed(faces[s], s);
  walk.segment(labels);

  const auto add = [&](std::size_t s) {
    const Stopwatch watch;
    walk.add_seed(faces[s], s);
    walk.segment(labels);
    return watch.milliseconds();
  };
  std::mt19937 random(2);
  const auto remove = [&] {
    const auto face = walk.seeds()[random() % walk.seeds().size()].first;
    const Stopwatch watch;
    walk.remove_seed(face);
    walk.segment(labels);
    return watch.milliseconds();
  };
  times.first_edit = add(arguments.seeds);
  remove();
  for (std::size_t k = 1; k <= arguments.edits; ++k) {
    times.add.push_back(add(arguments.seeds + k));
    times.remove.push_back(remove());
  }
  times.report = walk.report();

  for (int repeat = 0; repeat < 3; ++repeat) {
    const Stopwatch watch;
    Random_walk fresh(mesh, as_conductance(conductances));
    for (const auto& [face, label] : walk.seeds()) fresh.add_seed(face, label);
    fresh.segment(redone);
    times.redo.push_back(watch.milliseconds());
  }
  std::size_t equal = 0;
  for (const auto f : mesh.faces()) equal += labels[f] == redone[f];
  times.equal_labels = static_cast<double>(equal) / static_cast<double>(mesh.number_of_faces());
  return times;
}

Result measure(const std::string& size, Mesh mesh, const Arguments& arguments) {
  const std::size_t faces = mesh.number_of_faces();
  auto conductances = mesh.add_property_map<Mesh::Edge_index, double>("e:conductance").first;
  {
    const Conductance<Mesh> capped(mesh, Dihedral_difference<Mesh>(mesh), 1, arguments.cap);
    for (const auto e : edges(mesh)) conductances[e] = get(capped, e);
  }
  const auto labels = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:label").first;
  const auto redone = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:redone").first;

  const Outcome outcome = in_own_process([&] {
    const Times times = edit(mesh, conductances, labels, redone, arguments);
    return std::vector<double>{median(times.add),
                               maximum(times.add),
                               median(times.remove),
                               maximum(times.remove),
                               times.first_edit,
                               median(times.redo),
                               milliseconds_of_pass(faces * arguments.seeds),
                               times.equal_labels,
                               static_cast<double>(times.report.factorisations - 1),
                               peak_mb()};
  });
  // Apart, since the peak of the memory is that of the edits.
  const Outcome two_labels = in_own_process([&] {
    return std::vector<double>{milliseconds_of_two_labels(mesh, conductances, labels, false),
                               milliseconds_of_two_labels(mesh, conductances, labels, true)};
  });
  for (const Outcome* const measured : {&outcome, &two_labels})
    if (!measured->failure.empty()) throw std::runtime_error(size + ": " + measured->failure);
  const auto& n = outcome.numbers;
  const double from_nothing = two_labels.numbers[0], anticipated = two_labels.numbers[1];
  const double add = n[0], remove = n[2], redo = n[5], pass = n[6];

  std::printf("\n%s: %zu faces, %zu seeds, cap %g\n", size.c_str(), faces, arguments.seeds, arguments.cap);
  std::printf("  a full redo       %9.2f ms\n", redo);
  std::printf("  two labels        %9.2f ms from nothing, %.2f where it was anticipated\n", from_nothing, anticipated);
  std::printf("  the first edit    %9.2f ms, keeps a column a seed from then on\n", n[4]);
  std::printf("  a seed added      %9.2f ms, at most %.2f: a redo / %.1f\n", add, n[1], redo / add);
  std::printf("  a seed removed    %9.2f ms, at most %.2f: a redo / %.1f\n", remove, n[3], redo / remove);
  std::printf("  one pass          %9.2f ms, three %.2f\n", pass, 3 * pass);
  std::printf("  labels equal to those of the redo: %.4f %%; factorised anew %.0f times; peak %.0f MB\n", 100 * n[7],
              n[8], n[9]);

  Result result("seed_editing");
  result.add("size", size).add("faces", faces).add("seeds", arguments.seeds).add("edits", arguments.edits);
  result.add("add_ms", add).add("add_max_ms", n[1]).add("remove_ms", remove).add("remove_max_ms", n[3]);
  result.add("redo_ms", redo).add("first_edit_ms", n[4]).add("pass_ms", pass).add("three_passes_ms", 3 * pass);
  result.add("two_labels_ms", from_nothing).add("two_labels_anticipated_ms", anticipated);
  result.add("add_ratio", redo / add).add("remove_passes", remove / pass).add("equal_labels", n[7]);
  return result.add("refactorisations", n[8]).add("peak_mb", n[9]).add("cap", arguments.cap);
}

}  // namespace

int main(int argc, char** argv) try {
  Arguments arguments;
  CLI::App app(
      "Times edits of the seeds of a random walk: seeds are added and removed in turn and the labels written after "
      "each, against making the walk anew and against passes over an array of faces x seeds numbers.");
  app.add_option("--sizes", arguments.sizes, "Of the meshes")
      ->delimiter(',')
      ->check(CLI::IsMember(sizes()))
      ->capture_default_str();
  app.add_option("--mesh", arguments.mesh, "The file of a mesh to edit on, in place of those sizes")
      ->check(CLI::ExistingFile);
  app.add_option("--seeds", arguments.seeds, "Seeds at the start")->check(CLI::Range(2, 60))->capture_default_str();
  app.add_option("--edits", arguments.edits, "Additions, and as many removals")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--cap", arguments.cap, "Of d/sigma in the conductances; inf for none")->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::vector<Result> results;
  if (!arguments.mesh.empty())
    results.push_back(measure("file", read_mesh(arguments.mesh), arguments));
  else
    for (const std::string& size : arguments.sizes) results.push_back(measure(size, mesh_of_size(size), arguments));
  print(results);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "benchmark_seed_editing: " << error.what() << '\n';
  return 1;
}
