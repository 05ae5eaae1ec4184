// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_NETWORKS_H
#define RW_SEGMENTATION_TEST_NETWORKS_H

// Graphs with conductances, and their potentials by dense arithmetic that shares nothing with the package's solvers.

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/internal/mesh/Components.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace networks {

using RW_segmentation::Dual_graph;
using Index = Dual_graph::Index;

struct Network {
  Dual_graph graph;
  std::vector<double> conductances;
};

/// Connected components over edges that conduct.
inline RW_segmentation::internal::Components components(const Dual_graph& graph,
                                                        const std::vector<double>& conductances) {
  return {graph, [&](Index e) { return conductances[e] > 0; }};
}

/// The dual of `n` by `n` squares cut into two triangles each, closed to a torus.
inline Dual_graph triangulated_torus(std::size_t n) {
  const auto triangle = [&](std::size_t x, std::size_t y, std::size_t half) {
    return static_cast<Index>(2 * ((y % n) * n + x % n) + half);
  };
  std::vector<std::array<Index, 2>> edges;
  for (std::size_t y = 0; y < n; ++y)
    for (std::size_t x = 0; x < n; ++x) {
      edges.push_back({triangle(x, y, 0), triangle(x, y, 1)});
      edges.push_back({triangle(x, y, 0), triangle(x + n - 1, y, 1)});
      edges.push_back({triangle(x, y, 0), triangle(x, y + n - 1, 1)});
    }
  return Dual_graph(2 * n * n, edges);
}

/// A connected graph of `faces` nodes: a random tree and as many more edges, parallel ones among them.
inline Dual_graph random_graph(std::size_t faces, std::mt19937& random) {
  std::vector<std::array<Index, 2>> edges;
  for (std::size_t f = 1; f < faces; ++f) edges.push_back({static_cast<Index>(f), static_cast<Index>(random() % f)});
  while (edges.size() < 2 * faces) {
    const auto f = static_cast<Index>(random() % faces), g = static_cast<Index>(random() % faces);
    if (f != g) edges.push_back({f, g});
  }
  return Dual_graph(faces, edges);
}

/// Conductances 10^-u, u even in [0, `decades`].
inline std::vector<double> spread_conductances(std::size_t number, double decades, std::mt19937& random) {
  std::uniform_real_distribution<double> exponent(-decades, 0);
  std::vector<double> result(number);
  for (double& c : result) c = std::pow(10., exponent(random));
  return result;
}

/// `number` different faces.
inline std::vector<Index> random_faces(const Dual_graph& graph, std::size_t number, std::mt19937& random) {
  std::vector<Index> faces;
  while (faces.size() < number) {
    const auto face = static_cast<Index>(random() % graph.number_of_faces());
    if (std::find(faces.begin(), faces.end(), face) == faces.end()) faces.push_back(face);
  }
  return faces;
}

/// The potential of each seed at each face by Gaussian elimination with pivoting on the full matrix.
template <class Number>
std::vector<std::vector<Number>> dense_potentials(const Network& network, const std::vector<Index>& seeds) {
  const std::size_t n = network.graph.number_of_faces(), columns = n + seeds.size();
  std::vector<std::vector<Number>> a(n, std::vector<Number>(columns, Number(0)));
  for (std::size_t e = 0; e < network.conductances.size(); ++e) {
    const auto [f, g] = network.graph.faces_of(static_cast<Index>(e));
    const Number c(network.conductances[e]);
    a[f][f] += c;
    a[g][g] += c;
    a[f][g] -= c;
    a[g][f] -= c;
  }
  for (std::size_t s = 0; s < seeds.size(); ++s) {
    std::fill(a[seeds[s]].begin(), a[seeds[s]].end(), Number(0));
    a[seeds[s]][seeds[s]] = 1;
    a[seeds[s]][n + s] = 1;
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (abs(a[i][k]) > abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      if (a[i][k] == 0) continue;
      const Number factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < columns; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  std::vector<std::vector<Number>> x(n, std::vector<Number>(seeds.size()));
  for (std::size_t k = n; k-- > 0;)
    for (std::size_t s = 0; s < seeds.size(); ++s) {
      Number sum = a[k][n + s];
      for (std::size_t j = k + 1; j < n; ++j) sum -= a[k][j] * x[j][s];
      x[k][s] = sum / a[k][k];
    }
  return x;
}

/// The shares of `walks` walks from a face that end at each seed.
inline std::vector<double> walked_shares(const Network& network, const std::vector<Index>& seeds, Index start,
                                         std::size_t walks, std::mt19937& random) {
  std::vector<double> shares(seeds.size(), 0.);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (std::size_t w = 0; w < walks; ++w) {
    Index face = start;
    auto end = std::find(seeds.begin(), seeds.end(), face);
    for (; end == seeds.end(); end = std::find(seeds.begin(), seeds.end(), face)) {
      double total = 0;
      for (const auto& [next, edge] : network.graph.neighbours(face)) total += network.conductances[edge];
      double at = uniform(random) * total;
      for (const auto& [next, edge] : network.graph.neighbours(face)) {
        face = next;
        if ((at -= network.conductances[edge]) < 0) break;
      }
    }
    shares[static_cast<std::size_t>(end - seeds.begin())] += 1. / static_cast<double>(walks);
  }
  return shares;
}

/// The potentials of each seed by a solver policy.
template <class Solver>
RW_segmentation::Potentials potentials(Solver& solver, const Network& network, const std::vector<Index>& seeds) {
  solver.analyze(network.graph);
  solver.factorize(network.conductances, seeds);
  RW_segmentation::Potentials boundary, result;
  boundary.setIdentity(static_cast<Eigen::Index>(seeds.size()), static_cast<Eigen::Index>(seeds.size()));
  solver.potentials(boundary, result);
  return result;
}

}  // namespace networks

#endif
