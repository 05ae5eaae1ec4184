// SPDX-License-Identifier: MIT

// Walks with any conductances on battered meshes: probabilities add up to one, and after any edits of the seeds the
// answer is that of a walk that began with them.

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Random_walk.h>

#include "Fuzzed_input.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

using namespace RW_segmentation;
using fuzz::Mesh;

namespace {

constexpr std::size_t labels = 4;

/// Conductances of one size or of many, some of them 0.
Mesh::Property_map<Mesh::Edge_index, double> conductances(Mesh& mesh, fuzz::Input& input) {
  auto map = mesh.add_property_map<Mesh::Edge_index, double>("e:conductance", 1).first;
  std::mt19937 random(static_cast<unsigned>(input.below(1u << 16)));
  const double decades = static_cast<double>(input.below(20));
  const std::size_t zeros = input.below(4);
  for (const auto e : mesh.edges())
    map[e] = random() % 16 < zeros ? 0 : std::pow(10., -decades * static_cast<double>(random()) / 4294967296.);
  return map;
}

std::vector<double> probabilities(Random_walk<Mesh>& walk, const Mesh& mesh) {
  std::vector<double> result;
  for (const auto f : mesh.faces())
    for (std::size_t label = 0; label < labels; ++label) result.push_back(walk.probability(f, label));
  return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  Mesh mesh = input.mesh(false);
  const auto conductance = as_conductance(conductances(mesh, input));
  if (mesh.number_of_faces() == 0) return 0;

  auto label = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:label", labels).first;
  Random_walk walk(mesh, conductance);
  for (std::size_t edits = 1 + input.below(12); edits > 0; --edits) {
    for (std::size_t n = 1 + input.below(4); n > 0; --n) {
      if (input.below(3) > 0)
        walk.add_seed(input.face_of(mesh), input.below(labels));
      else
        walk.remove_seed(input.face_of(mesh));
    }
    const bool has_answer = fuzz::accepts([&] { walk.segment(label); });
    fuzz::require(has_answer == !walk.seeds().empty(), "there is an answer exactly if there are seeds");
    if (!has_answer) continue;
    if (input.flip()) probabilities(walk, mesh);
  }
  if (walk.seeds().empty()) return 0;

  Random_walk fresh(mesh, conductance);
  for (const auto& [face, seed_label] : walk.seeds()) fresh.add_seed(face, seed_label);
  walk.segment(label);
  auto fresh_label = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:fresh", labels).first;
  fresh.segment(fresh_label);

  const std::vector<double> edited = probabilities(walk, mesh), anew = probabilities(fresh, mesh);
  const bool has_islands = walk.report().island_faces + fresh.report().island_faces > 0;
  auto p = edited.begin(), q = anew.begin();
  for (const auto f : mesh.faces()) {
    double sum = 0, largest_difference = 0;
    for (std::size_t k = 0; k < labels; ++k) {
      fuzz::require(p[static_cast<std::ptrdiff_t>(k)] >= 0 && p[static_cast<std::ptrdiff_t>(k)] <= 1,
                    "a probability lies between 0 and 1");
      sum += p[static_cast<std::ptrdiff_t>(k)];
      largest_difference =
          std::max(largest_difference, std::abs(p[static_cast<std::ptrdiff_t>(k)] - q[static_cast<std::ptrdiff_t>(k)]));
    }
    fuzz::require(std::abs(sum - 1) < 1e-6 || std::abs(sum) < 1e-6, "probabilities add up to one, or no seed is met");
    fuzz::require(largest_difference < 1e-5, "edits lead to the answer of a new walk");
    if (label[f] < labels && !has_islands)
      fuzz::require(label[f] == fresh_label[f] || std::abs(q[static_cast<std::ptrdiff_t>(label[f])] -
                                                           q[static_cast<std::ptrdiff_t>(fresh_label[f])]) < 1e-5,
                    "labels differ where probabilities tie only");
    p += labels;
    q += labels;
  }
  return 0;
}
