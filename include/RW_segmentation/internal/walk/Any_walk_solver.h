// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_ANY_WALK_SOLVER_H
#define RW_SEGMENTATION_INTERNAL_WALK_ANY_WALK_SOLVER_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/Progress.h>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

template <class T, class = void>
struct Is_walk_solver : std::false_type {};
template <class T>
struct Is_walk_solver<
    T,
    std::void_t<
        decltype(std::declval<T&>().analyze(std::declval<const Dual_graph&>())),
        decltype(std::declval<T&>().factorize(std::declval<const std::vector<double>&>(),
                                              std::declval<const std::vector<Dual_graph::Index>&>(),
                                              std::declval<const Progress&>())),
        decltype(std::declval<const T&>().potentials(std::declval<const Potentials&>(), std::declval<Potentials&>())),
        decltype(std::declval<const T&>().response(Dual_graph::Index(), std::declval<const std::vector<double>&>(),
                                                   std::declval<std::vector<double>&>())),
        decltype(std::declval<const T&>().absorbed_currents(Dual_graph::Index()))>> : std::true_type {};

/// Whether it has the functions of a `WalkSolver`.
template <class T>
constexpr bool is_walk_solver = Is_walk_solver<T>::value;

template <class T, class = void>
struct Finds_largest_potentials : std::false_type {};
template <class T>
struct Finds_largest_potentials<
    T, std::void_t<decltype(std::declval<const T&>().largest_potentials(
           std::declval<const std::vector<Dual_graph::Index>&>(), std::size_t(), std::declval<const Progress&>()))>>
    : std::true_type {};

template <class T, class = void>
struct Finds_columns : std::false_type {};
template <class T>
struct Finds_columns<T, std::void_t<decltype(std::declval<const T&>().columns())>> : std::true_type {};

/// A `WalkSolver` of any type, so that the walk is compiled once for all of them. A call solves for a whole mesh: that it
/// is a virtual one costs nothing.
class Any_walk_solver {
 public:
  using Index = Dual_graph::Index;

  Any_walk_solver();

  template <class Solver, class = std::enable_if_t<is_walk_solver<Solver>>>
  Any_walk_solver(Solver solver)  // NOLINT(google-explicit-constructor): as a std::function takes a function
      : solver_(std::make_unique<Model<Solver>>(std::move(solver))) {}

  void analyze(const Dual_graph& graph) { solver_->analyze(graph); }
  void factorize(const std::vector<double>& conductances, const std::vector<Index>& absorbing_faces,
                 const Progress& progress = {}) {
    solver_->factorize(conductances, absorbing_faces, progress);
  }
  void potentials(const Potentials& boundary_values, Potentials& potentials) const {
    solver_->potentials(boundary_values, potentials);
  }
  void response(Index face, const std::vector<double>& boundary_values, std::vector<double>& column) const {
    solver_->response(face, boundary_values, column);
  }
  std::vector<double> absorbed_currents(Index face) const { return solver_->absorbed_currents(face); }
  /// Of no face where the solver has no such function.
  Largest_potentials largest_potentials(const std::vector<Index>& labels, std::size_t number_of_labels,
                                        const Progress& progress) const {
    return solver_->largest_potentials(labels, number_of_labels, progress);
  }
  /// The potentials when one absorbing face is held at 1 and the others at 0: by absorbing face, then by face.
  /// \param absorbing_faces how many there are
  std::vector<std::vector<double>> columns(std::size_t absorbing_faces) const {
    return solver_->columns(absorbing_faces);
  }

 private:
  struct Concept {
    Concept() = default;
    Concept(const Concept&) = delete;
    Concept& operator=(const Concept&) = delete;
    virtual ~Concept() = default;
    virtual void analyze(const Dual_graph&) = 0;
    virtual void factorize(const std::vector<double>&, const std::vector<Index>&, const Progress&) = 0;
    virtual void potentials(const Potentials&, Potentials&) const = 0;
    virtual void response(Index, const std::vector<double>&, std::vector<double>&) const = 0;
    virtual std::vector<double> absorbed_currents(Index) const = 0;
    virtual Largest_potentials largest_potentials(const std::vector<Index>&, std::size_t, const Progress&) const = 0;
    virtual std::vector<std::vector<double>> columns(std::size_t) const = 0;
  };

  template <class Solver>
  struct Model final : Concept {
    explicit Model(Solver solver) : solver(std::move(solver)) {}
    void analyze(const Dual_graph& graph) override { solver.analyze(graph); }
    void factorize(const std::vector<double>& conductances, const std::vector<Index>& absorbing_faces,
                   const Progress& progress) override {
      solver.factorize(conductances, absorbing_faces, progress);
    }
    void potentials(const Potentials& boundary_values, Potentials& potentials) const override {
      solver.potentials(boundary_values, potentials);
    }
    void response(Index face, const std::vector<double>& boundary_values, std::vector<double>& column) const override {
      solver.response(face, boundary_values, column);
    }
    std::vector<double> absorbed_currents(Index face) const override { return solver.absorbed_currents(face); }
    Largest_potentials largest_potentials([[maybe_unused]] const std::vector<Index>& labels,
                                          [[maybe_unused]] std::size_t number_of_labels,
                                          [[maybe_unused]] const Progress& progress) const override {
      if constexpr (Finds_largest_potentials<Solver>::value)
        return solver.largest_potentials(labels, number_of_labels, progress);
      else
        return {};
    }
    std::vector<std::vector<double>> columns([[maybe_unused]] std::size_t absorbing_faces) const override {
      if constexpr (Finds_columns<Solver>::value)
        return solver.columns();
      else
        return columns_of_potentials(*this, static_cast<Eigen::Index>(absorbing_faces));
    }
    Solver solver;
  };

  static std::vector<std::vector<double>> columns_of_potentials(const Concept& solver, Eigen::Index absorbing_faces);

  std::unique_ptr<Concept> solver_;
};

}  // namespace RW_segmentation::internal

#ifndef RW_SEGMENTATION_COMPILED
#include <RW_segmentation/internal/definitions/Any_walk_solver.h>
#endif

#endif
