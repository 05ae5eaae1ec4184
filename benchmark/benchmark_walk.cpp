// SPDX-License-Identifier: MIT

// The time and memory that the walk takes, solver by solver: from a mesh and a stored map of conductances to a written
// map of labels.

#include "measurement.h"

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Eigen_walk_solver.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/Star_mesh_elimination.h>

#include <CLI/CLI.hpp>

#ifdef RW_SEGMENTATION_WITH_CHOLMOD
#include <Eigen/CholmodSupport>
#endif
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace RW_segmentation;
using namespace measurement;

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Conductances = Mesh::Property_map<Mesh::Edge_index, double>;
using Labels = Mesh::Property_map<Mesh::Face_index, std::size_t>;
using Faces = std::vector<Mesh::Face_index>;
constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- Solvers that tell the time of their stages ----

struct Stages {
  double order = 0, factor = 0, solve = 0;  // ms
};

/// A walk solver that times another one.
template <class Solver>
class Timed_solver {
 public:
  using Index = Dual_graph::Index;

  Timed_solver(Solver solver, Stages& stages) : solver_(std::move(solver)), stages_(&stages) {}

  void analyze(const Dual_graph& graph) {
    const Stopwatch watch;
    solver_.analyze(graph);
    stages_->order += watch.milliseconds();
  }
  void factorize(const std::vector<double>& conductances, const std::vector<Index>& faces, const Progress& progress) {
    const Stopwatch watch;
    const double order_before = stages_->order;
    solver_.factorize(conductances, faces, progress);
    stages_->factor += watch.milliseconds() - (stages_->order - order_before);
  }
  void potentials(const Potentials& boundary_values, Potentials& result) const {
    const Stopwatch watch;
    solver_.potentials(boundary_values, result);
    stages_->solve += watch.milliseconds();
  }
  void response(Index face, const std::vector<double>& boundary_values, std::vector<double>& column) const {
    solver_.response(face, boundary_values, column);
  }
  std::vector<double> absorbed_currents(Index face) const { return solver_.absorbed_currents(face); }

 private:
  Solver solver_;
  Stages* stages_;
};

/// One of Eigen's solvers that times its ordering, which `compute` hides.
template <class EigenSolver>
class Timed_eigen_solver : public EigenSolver {
 public:
  void tell(Stages& stages) { stages_ = &stages; }

  Timed_eigen_solver& compute(const Matrix& matrix) {
    const Stopwatch watch;
    this->analyzePattern(matrix);
    stages_->order += watch.milliseconds();
    this->factorize(matrix);
    return *this;
  }

 private:
  Stages* stages_ = nullptr;
};

// ---- Measurements ----

/// One run, in this process: order, factor, solve, total in ms, the largest memory, and the memory before in MB.
template <class Solver>
std::vector<double> run(const Mesh& mesh, const Conductances& conductances, const Faces& seeds, Labels labels,
                        std::size_t repeats, const std::function<Solver(Stages&)>& make_solver) {
  constexpr double long_run = 5000;  // ms; is not repeated
  const double before = resident_mb();
  std::vector<double> order, factor, solve, total;
  while (total.size() < repeats && (total.empty() || total.front() < long_run)) {
    Stages stages;
    const Stopwatch watch;
    Random_walk walk(mesh, as_conductance(conductances), Timed_solver<Solver>(make_solver(stages), stages));
    for (std::size_t s = 0; s < seeds.size(); ++s) walk.add_seed(seeds[s], s);
    walk.segment(labels);
    total.push_back(watch.milliseconds());
    order.push_back(stages.order);
    factor.push_back(stages.factor);
    solve.push_back(stages.solve);
  }
  return {median(order), median(factor), median(solve), median(total), peak_mb(), before};
}

struct Measured_solver {
  std::string name;
  double cap;            // of d / sigma
  double most_unknowns;  // faces times seeds; larger measurements run only where the solver is named
  std::function<std::vector<double>(const Mesh&, const Conductances&, const Faces&, Labels, std::size_t)> run;
};

template <class EigenSolver>
Measured_solver eigen_solver(const std::string& name, double most_unknowns = infinity) {
  using Solver = Eigen_walk_solver<Timed_eigen_solver<EigenSolver>>;
  return {name, 20, most_unknowns, [](const auto&... arguments) {
            return run<Solver>(arguments..., [](Stages& stages) {
              Solver solver;
              solver.eigen_solver().tell(stages);
              return solver;
            });
          }};
}

std::vector<Measured_solver> all_solvers() {
  std::vector<Measured_solver> solvers;
  solvers.push_back({"star_mesh", infinity, infinity, [](const auto&... arguments) {
                       return run<Star_mesh_elimination>(arguments..., [](Stages&) { return Star_mesh_elimination(); });
                     }});
  solvers.push_back(eigen_solver<Eigen::SimplicialLDLT<Matrix, Eigen::Lower>>("simplicial_ldlt", 3e7));
#ifdef RW_SEGMENTATION_WITH_CHOLMOD
  solvers.push_back(eigen_solver<Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower>>("cholmod"));
#endif
  solvers.push_back(eigen_solver<Eigen::ConjugateGradient<Matrix, Eigen::Lower>>("cg", 2.4e5));
  return solvers;
}

struct Arguments {
  std::vector<std::string> meshes, solvers;
  std::vector<std::string> sizes = {"10k", "40k", "160k", "640k", "2500k"};
  std::vector<std::size_t> seeds = {6, 12, 24, 48};
  std::size_t repeats = 3;
};

/// Measures all solvers on a mesh, tells about it as it goes, and appends the results.
void measure(const std::string& size, Mesh& mesh, double read_ms, const Arguments& arguments,
             std::vector<Result>& results) {
  const std::size_t faces = num_faces(mesh);
  std::printf("\n%s: %zu faces, read in %.0f ms\n", size.c_str(), faces, read_ms);
  std::printf("%-16s %5s %9s %9s %9s %9s %8s %8s %11s\n", "solver", "seeds", "order ms", "factor ms", "solve ms",
              "total ms", "ns/face", "peak MB", "above mesh");
  auto conductances = mesh.add_property_map<Mesh::Edge_index, double>("e:conductance").first;
  auto labels = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:label").first;
  for (const Measured_solver& solver : all_solvers()) {
    const bool named = std::count(arguments.solvers.begin(), arguments.solvers.end(), solver.name) > 0;
    if (!named && !arguments.solvers.empty()) continue;
    {
      const Conductance<Mesh> capped(mesh, Dihedral_difference<Mesh>(mesh), 1, solver.cap);
      for (const auto e : edges(mesh)) conductances[e] = get(capped, e);
    }
    for (const std::size_t number : arguments.seeds) {
      std::printf("%-16s %5zu ", solver.name.c_str(), number);
      if (!named && static_cast<double>(faces * number) > solver.most_unknowns) {
        std::printf("left out, takes long; --solvers %s runs it\n", solver.name.c_str());
        continue;
      }
      const Faces seeds = random_faces(mesh, number);
      const Outcome outcome =
          in_own_process([&] { return solver.run(mesh, conductances, seeds, labels, arguments.repeats); });
      Result& result = results.emplace_back("walk");
      result.add("size", size).add("faces", faces).add("solver", solver.name).add("seeds", number);
      if (!outcome.failure.empty()) {
        std::printf("refused: %s\n", outcome.failure.c_str());
        result.add("status", "refused").add_reason(outcome.failure);
        continue;
      }
      const auto& n = outcome.numbers;
      const double ns_per_face = n[3] * 1e6 / static_cast<double>(faces), above_mesh = n[4] - n[5];
      std::printf("%9.1f %9.1f %9.1f %9.1f %8.0f %8.0f %11.0f\n", n[0], n[1], n[2], n[3], ns_per_face, n[4],
                  above_mesh);
      result.add("order_ms", n[0]).add("factor_ms", n[1]).add("solve_ms", n[2]).add("total_ms", n[3]);
      result.add("peak_mb", n[4]).add("above_mesh_mb", above_mesh).add("ns_per_face", ns_per_face);
      result.add("read_ms", read_ms).add("cap", solver.cap).add("status", "ok");
    }
  }
}

}  // namespace

int main(int argc, char** argv) try {
  Arguments arguments;
  std::vector<std::string> solver_names;
  for (const Measured_solver& solver : all_solvers()) solver_names.push_back(solver.name);

  CLI::App app(
      "Times the random walk on meshes, from a mesh and stored conductances to written labels. Without a mesh it makes "
      "some. star_mesh runs uncapped, the other solvers with d/sigma capped at 20. What takes long is left out unless "
      "its solver is named: simplicial_ldlt above 3e7 and cg above 2.4e5 faces times seeds. Each measurement has a "
      "process of its own.");
  app.add_option("MESH", arguments.meshes, "Mesh files of your own")->check(CLI::ExistingFile);
  app.add_option("--sizes", arguments.sizes, "Of the meshes to make")
      ->delimiter(',')
      ->check(CLI::IsMember(sizes()))
      ->capture_default_str()
      ->excludes("MESH");
  app.add_option("--solvers", arguments.solvers, "All by default")->delimiter(',')->check(CLI::IsMember(solver_names));
  app.add_option("--seeds", arguments.seeds, "Numbers of seeds")->delimiter(',')->capture_default_str();
  app.add_option("--repeats", arguments.repeats, "Runs whose median counts; those above 5 s are not repeated")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::vector<Result> results;
  if (arguments.meshes.empty()) {
    for (const std::string& size : arguments.sizes) {
      Mesh mesh = mesh_of_size(size);
      const double read_ms = milliseconds_to_read(mesh);
      measure(size, mesh, read_ms, arguments, results);
    }
  }
  for (const std::string& path : arguments.meshes) {
    const double read_ms = milliseconds_to_read(path);
    Mesh mesh = read_mesh(path);
    measure(std::filesystem::path(path).stem().string(), mesh, read_ms, arguments, results);
  }
  print(results);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "benchmark_walk: " << error.what() << '\n';
  return 1;
}
