// SPDX-License-Identifier: MIT

#include <RW_segmentation/Eigen_walk_solver.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/internal/solver/Elimination_plan.h>
#include <RW_segmentation/internal/walk/make_solver.h>
#ifdef RW_SEGMENTATION_WITH_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include <Eigen/SparseLU>

#include <boost/multiprecision/mpfr.hpp>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <gtest/gtest.h>
#include "networks.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <random>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace test_walk_solvers {

using namespace networks;
using RW_segmentation::Eigen_walk_solver;
using RW_segmentation::Potentials;
using RW_segmentation::Star_mesh_elimination;
namespace internal = RW_segmentation::internal;

namespace {

using Matrix = Eigen::SparseMatrix<double>;

// 500 decimal digits. Long double would not do: weak links between clusters cost it all of its own.
using Exact = boost::multiprecision::mpfr_float_500;

template <class Solver>
class Walk_solver : public testing::Test {};

#ifdef RW_SEGMENTATION_WITH_CHOLMOD
using Solvers = testing::Types<
    Star_mesh_elimination, Eigen_walk_solver<>, Eigen_walk_solver<Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower>>,
    Eigen_walk_solver<Eigen::ConjugateGradient<Matrix, Eigen::Lower>>, Eigen_walk_solver<Eigen::SparseLU<Matrix>>>;
#else
using Solvers = testing::Types<Star_mesh_elimination, Eigen_walk_solver<>,
                               Eigen_walk_solver<Eigen::ConjugateGradient<Matrix, Eigen::Lower>>,
                               Eigen_walk_solver<Eigen::SparseLU<Matrix>>>;
#endif
TYPED_TEST_SUITE(Walk_solver, Solvers);

double largest_relative_error(const Potentials& potentials, const std::vector<std::vector<Exact>>& exact) {
  double largest = 0;
  for (std::size_t f = 0; f < exact.size(); ++f)
    for (std::size_t l = 0; l < exact[f].size(); ++l) {
      const double computed = potentials(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(l));
      if (exact[f][l] < 1e-290) continue;
      largest = std::max(largest, static_cast<double>(abs(computed / exact[f][l] - 1)));
    }
  return largest;
}

}  // namespace

TEST(StarMeshElimination, IsRightToRelative1e12WithConductancesSpreadOver200Decades) {
  std::mt19937 random(1);
  for (const double decades : {0., 20., 200.})
    for (int trial = 0; trial < 4; ++trial) {
      Network network{trial % 2 ? random_graph(60, random) : triangulated_torus(6), {}};
      network.conductances = spread_conductances(network.graph.number_of_edges(), decades, random);
      const std::vector<Index> seeds = random_faces(network.graph, 4, random);
      Star_mesh_elimination solver;
      const Potentials potentials = networks::potentials(solver, network, seeds);
      EXPECT_LE(largest_relative_error(potentials, dense_potentials<Exact>(network, seeds)), 1e-12)
          << decades << " decades, trial " << trial;
    }
}

TEST(StarMeshElimination, IsRightWhereWeakLinksJoinClusters) {
  // Four strongly connected clusters joined by links of 1e-100: double Cholesky loses everything here.
  std::mt19937 random(2);
  std::vector<std::array<Index, 2>> edges;
  std::vector<double> conductances;
  for (Index cluster = 0; cluster < 4; ++cluster) {
    for (int k = 0; k < 40; ++k) {
      const auto f = static_cast<Index>(random() % 12), g = static_cast<Index>(random() % 12);
      if (f != g) edges.push_back({12 * cluster + f, 12 * cluster + g});
    }
    for (Index f = 1; f < 12; ++f) edges.push_back({12 * cluster + f, 12 * cluster + f - 1});
  }
  conductances.assign(edges.size(), 1.);
  for (Index cluster = 1; cluster < 4; ++cluster)
    for (Index k = 0; k < 3; ++k) {
      edges.push_back({12 * cluster + k, 12 * (cluster - 1) + 3 * k});
      conductances.push_back(std::pow(10., -100. - k));
    }
  const Network network{Dual_graph(48, edges), conductances};
  const std::vector<Index> seeds = {0, 40};
  Star_mesh_elimination solver;
  const Potentials potentials = networks::potentials(solver, network, seeds);
  EXPECT_LE(largest_relative_error(potentials, dense_potentials<Exact>(network, seeds)), 1e-12);
}

/// A graph whose elimination is cut into many subtrees.
static Network network_of_many_subtrees() {
  std::mt19937 random(6);
  Network network{triangulated_torus(120), {}};
  network.conductances = spread_conductances(network.graph.number_of_edges(), 3, random);
  return network;
}

TEST(StarMeshElimination, BalancesCurrentsAtEachFaceWhereSubtreesAreEliminatedApart) {
  const Network network = network_of_many_subtrees();
  const internal::Elimination_plan plan(network.graph);
  ASSERT_GT(plan.subtrees.size(), 4u);
  ASSERT_GT(plan.top.size(), 4u);
  std::mt19937 random(7);
  std::vector<Index> seeds = random_faces(network.graph, 6, random);
  if (std::find(seeds.begin(), seeds.end(), plan.face.back()) == seeds.end()) seeds.push_back(plan.face.back());
  Star_mesh_elimination solver;
  const Potentials x = potentials(solver, network, seeds);
  for (Index f = 0; f < network.graph.number_of_faces(); ++f) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(x.cols());
    double total = 0;
    for (const auto& [g, e] : network.graph.neighbours(f)) {
      sum += network.conductances[e] * x.row(g);
      total += network.conductances[e];
    }
    const auto seed = std::find(seeds.begin(), seeds.end(), f);
    if (seed != seeds.end()) sum = total * Eigen::RowVectorXd::Unit(x.cols(), seed - seeds.begin());
    ASSERT_LE((sum / total - x.row(f)).cwiseAbs().maxCoeff(), 1e-12) << f;
    ASSERT_NEAR(x.row(f).sum(), 1, 1e-12) << f;
  }
}

/// Each face's label has a potential that no other label's exceeds by more than rounding, and is mostly the very one that
/// all potentials name.
static void expect_largest(const Network& network, const std::vector<Index>& seeds, std::size_t labels) {
  std::vector<Index> label_of_seed;
  for (std::size_t s = 0; s < seeds.size(); ++s) label_of_seed.push_back(static_cast<Index>(s % labels));
  Potentials boundary(static_cast<Eigen::Index>(seeds.size()), static_cast<Eigen::Index>(labels)), all;
  boundary.setZero();
  for (std::size_t s = 0; s < seeds.size(); ++s) boundary(static_cast<Eigen::Index>(s), label_of_seed[s]) = 1;
  Star_mesh_elimination solver;
  solver.analyze(network.graph);
  solver.factorize(network.conductances, seeds);
  solver.potentials(boundary, all);
  const auto [found, potential_found] = solver.largest_potentials(label_of_seed, labels);
  ASSERT_EQ(found.size(), network.graph.number_of_faces());
  std::size_t different = 0;
  for (Eigen::Index f = 0; f < all.rows(); ++f) {
    Eigen::Index best = 0;
    const double largest = all.row(f).maxCoeff(&best);
    EXPECT_GE(all(f, found[static_cast<std::size_t>(f)]), largest * (1 - 1e-11)) << "face " << f;
    const double known = potential_found[static_cast<std::size_t>(f)];
    EXPECT_TRUE(std::isnan(known) || std::abs(known - largest) <= 1e-11 * largest) << "face " << f;
    different += found[static_cast<std::size_t>(f)] != static_cast<Index>(best);
  }
  EXPECT_LE(different, network.graph.number_of_faces() / 100);
}

TEST(StarMeshElimination, FindsTheLargestPotentialsAmongAllThatItSolvesFor) {
  std::mt19937 random(11);
  for (const double decades : {0., 3., 30.})
    for (const std::size_t labels : {2u, 5u, 40u})
      for (const std::size_t seeds_a_label : {1u, 3u}) {
        SCOPED_TRACE(testing::Message() << decades << " decades, " << labels << " labels, " << seeds_a_label
                                        << " seeds");
        Network torus{triangulated_torus(20), {}}, graph{random_graph(300, random), {}};
        for (Network* network : {&torus, &graph}) {
          network->conductances = spread_conductances(network->graph.number_of_edges(), decades, random);
          expect_largest(*network, random_faces(network->graph, labels * seeds_a_label, random), labels);
        }
      }
}

TEST(StarMeshElimination, FindsTheLargestPotentialsWhereSubtreesAreEliminatedApart) {
  const Network network = network_of_many_subtrees();
  std::mt19937 random(12);
  for (const std::size_t labels : {2u, 9u, 300u})
    expect_largest(network, random_faces(network.graph, 2 * labels, random), labels);
}

TEST(StarMeshElimination, FindsAColumnForEachSeedAmongAllPotentials) {
  std::mt19937 random(13);
  Network graph{random_graph(300, random), {}}, parts{Dual_graph(5, {{0, 1}, {1, 2}, {3, 4}}), {1, 2, 0}};
  graph.conductances = spread_conductances(graph.graph.number_of_edges(), 30, random);
  const Network many_subtrees = network_of_many_subtrees();
  for (const Network* network : std::initializer_list<const Network*>{&graph, &parts, &many_subtrees})
    for (const std::size_t seeds : {1u, 2u, 21u}) {
      if (seeds > network->graph.number_of_faces()) continue;
      const std::vector<Index> faces = random_faces(network->graph, seeds, random);
      Star_mesh_elimination solver;
      const Potentials all = potentials(solver, *network, faces);
      const std::vector<std::vector<double>> columns = solver.columns();
      ASSERT_EQ(columns.size(), seeds);
      for (std::size_t s = 0; s < seeds; ++s) {
        const Eigen::Map<const Eigen::VectorXd> column(columns[s].data(), static_cast<Eigen::Index>(columns[s].size()));
        ASSERT_EQ(column.size(), all.rows());
        const auto expected = all.col(static_cast<Eigen::Index>(s));
        EXPECT_TRUE(((column - expected).array().abs() <= 1e-11 * expected.array()).all())
            << seeds << " seeds, seed " << s << " of " << network->graph.number_of_faces() << " faces";
      }
    }
  EXPECT_THROW(Star_mesh_elimination().columns(), std::invalid_argument);
}

TEST(StarMeshElimination, FindsTheLargestPotentialsInEachPartThatASeedReaches) {
  const Network network{Dual_graph(7, {{0, 1}, {1, 2}, {2, 3}, {4, 5}, {5, 6}}), {1, 1, 1, 1, 0}};
  Star_mesh_elimination solver;
  solver.analyze(network.graph);
  solver.factorize(network.conductances, {0, 3, 4});
  std::vector<Index> found = solver.largest_potentials({2, 1, 1}, 3).labels;
  EXPECT_LT(found.back(), 3u);  // is reached by none
  found.pop_back();
  EXPECT_EQ(found, std::vector<Index>({2, 2, 1, 1, 1, 1}));
  EXPECT_THROW(solver.largest_potentials({2, 1}, 3), std::invalid_argument);
  EXPECT_THROW(Star_mesh_elimination().largest_potentials({}, 1), std::invalid_argument);
}

TYPED_TEST(Walk_solver, MayBeMovedAfterItHasFactorised) {
  std::mt19937 random(8);
  const Network network{triangulated_torus(6), std::vector<double>(108, 1.)};
  const std::vector<Index> seeds = random_faces(network.graph, 3, random);
  auto solver = std::make_unique<TypeParam>();
  const Potentials expected = potentials(*solver, network, seeds);
  TypeParam moved = std::move(*solver);
  solver = nullptr;
  Potentials again;
  moved.potentials(Potentials::Identity(3, 3), again);
  EXPECT_TRUE((again.array() == expected.array()).all());
}

TEST(StarMeshElimination, IsTheSameToTheLastBitWithAnyNumberOfThreads) {
#ifdef CGAL_LINKED_WITH_TBB
  const Network network = network_of_many_subtrees();
  std::mt19937 random(8);
  const std::vector<Index> seeds = random_faces(network.graph, 10, random);
  const auto potentials_with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Star_mesh_elimination solver;
    Potentials all = potentials(solver, network, seeds);
    return std::pair(std::move(all), solver.columns());
  };
  const auto [expected, expected_columns] = potentials_with(1);
  for (const std::size_t threads : {2u, 4u}) {
    const auto [all, columns] = potentials_with(threads);
    EXPECT_TRUE((all.array() == expected.array()).all());
    EXPECT_EQ(columns, expected_columns);
  }
#else
  GTEST_SKIP() << "TBB is not linked";
#endif
}

TEST(StarMeshElimination, FindsFacesThatNoSeedReaches) {
  Network network{Dual_graph(6, {{0, 1}, {1, 2}, {3, 4}, {4, 5}, {2, 3}}), {1, 1, 1, 1, 0}};
  Star_mesh_elimination solver;
  const Potentials potentials = networks::potentials(solver, network, {0});
  EXPECT_TRUE(solver.has_unreached_faces());
  for (Eigen::Index f = 0; f < 6; ++f) EXPECT_EQ(potentials(f, 0), f < 3 ? 1 : 0);
  std::vector<double> column;
  EXPECT_THROW(solver.response(4, {0}, column), std::invalid_argument);
  network.conductances.back() = 1e-300;
  EXPECT_EQ(networks::potentials(solver, network, {0}).minCoeff(), 1);
  EXPECT_FALSE(solver.has_unreached_faces());
}

TYPED_TEST(Walk_solver, AgreesWithADenseSolve) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 6; ++trial) {
    Network network{trial % 2 ? random_graph(150, random) : triangulated_torus(9), {}};
    network.conductances = spread_conductances(network.graph.number_of_edges(), 3, random);
    const std::vector<Index> seeds = random_faces(network.graph, 11, random);
    TypeParam solver;
    const Potentials potentials = networks::potentials(solver, network, seeds);
    const auto dense = dense_potentials<long double>(network, seeds);
    for (std::size_t f = 0; f < dense.size(); ++f)
      for (std::size_t l = 0; l < seeds.size(); ++l)
        ASSERT_NEAR(potentials(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(l)),
                    static_cast<double>(dense[f][l]), 1e-9);
  }
}

TYPED_TEST(Walk_solver, AgreesWithWalksThatAreWalked) {
  std::mt19937 random(6);
  Network network{triangulated_torus(5), {}};
  network.conductances = spread_conductances(network.graph.number_of_edges(), 1, random);
  const std::vector<Index> seeds = random_faces(network.graph, 3, random);
  TypeParam solver;
  const Potentials potentials = networks::potentials(solver, network, seeds);
  for (const Index start : {Index(1), Index(17), Index(30)}) {
    const std::size_t walks = 40000;
    const std::vector<double> shares = walked_shares(network, seeds, start, walks, random);
    for (std::size_t l = 0; l < seeds.size(); ++l)  // within four standard deviations
      EXPECT_NEAR(potentials(start, static_cast<Eigen::Index>(l)), shares[l], 4 * 0.5 / std::sqrt(1. * walks));
  }
}

TYPED_TEST(Walk_solver, GivesPotentialsInTheUnitIntervalThatAddUpToOne) {
  std::mt19937 random(7);
  Network network{triangulated_torus(16), {}};
  network.conductances = spread_conductances(network.graph.number_of_edges(), 4, random);
  const std::vector<Index> seeds = random_faces(network.graph, 19, random);
  TypeParam solver;
  const Potentials potentials = networks::potentials(solver, network, seeds);
  EXPECT_GE(potentials.minCoeff(), 0);
  EXPECT_LE(potentials.maxCoeff(), 1 + 1e-14);
  EXPECT_LE((potentials.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-8);
}

TYPED_TEST(Walk_solver, SatisfiesTheMaximumPrinciple) {
  std::mt19937 random(8);
  Network network{triangulated_torus(12), {}};
  network.conductances = spread_conductances(network.graph.number_of_edges(), 2, random);
  const std::vector<Index> seeds = random_faces(network.graph, 3, random);
  TypeParam solver;
  const Potentials potentials = networks::potentials(solver, network, seeds);
  for (Index f = 0; f < network.graph.number_of_faces(); ++f) {
    if (std::find(seeds.begin(), seeds.end(), f) != seeds.end()) continue;
    for (Eigen::Index l = 0; l < potentials.cols(); ++l) {
      double low = 1, high = 0;
      for (const auto& [next, edge] : network.graph.neighbours(f)) {
        low = std::min(low, potentials(next, l));
        high = std::max(high, potentials(next, l));
      }
      ASSERT_GE(potentials(f, l), low - 1e-9);
      ASSERT_LE(potentials(f, l), high + 1e-9);
    }
  }
}

TYPED_TEST(Walk_solver, RespondsToACurrentBetweenFacesHeldAtGivenValues) {
  // By definition: a unit current enters at the source, none anywhere else but at the faces that are held.
  std::mt19937 random(9);
  Network network{triangulated_torus(8), {}};
  network.conductances = spread_conductances(network.graph.number_of_edges(), 2, random);
  const std::vector<Index> faces = random_faces(network.graph, 5, random);
  const std::vector<Index> seeds(faces.begin(), faces.begin() + 3);
  TypeParam solver;
  solver.analyze(network.graph);
  solver.factorize(network.conductances, seeds);
  for (const std::vector<double>& held : {std::vector<double>{0.5, 0, 2}, {1, 3, 2}, {0, 0, 0}}) {
    std::vector<double> a;
    solver.response(faces[3], held, a);
    for (Index f = 0; f < network.graph.number_of_faces(); ++f) {
      double outflow = 0;
      for (const auto& [next, edge] : network.graph.neighbours(f))
        outflow += network.conductances[edge] * (a[f] - a[next]);
      const auto seed = std::find(seeds.begin(), seeds.end(), f);
      if (seed != seeds.end()) {
        EXPECT_EQ(a[f], held[static_cast<std::size_t>(seed - seeds.begin())]);
      } else {
        EXPECT_NEAR(outflow, f == faces[3], 1e-9);
      }
    }
  }
}

TYPED_TEST(Walk_solver, AbsorbsTheCurrentOfAFaceAsItsWalksEnd) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 5; ++trial) {
    Network network{trial % 2 ? random_graph(80, random) : triangulated_torus(9), {}};
    network.conductances = spread_conductances(network.graph.number_of_edges(), 2, random);
    const std::vector<Index> faces = random_faces(network.graph, 10, random);
    const std::vector<Index> seeds(faces.begin(), faces.begin() + 7);
    TypeParam solver;
    const Potentials potentials = networks::potentials(solver, network, seeds);
    for (std::size_t f = 7; f < 10; ++f) {
      const std::vector<double> absorbed = solver.absorbed_currents(faces[f]);
      for (std::size_t r = 0; r < seeds.size(); ++r)
        EXPECT_NEAR(absorbed[r], potentials(faces[f], static_cast<Eigen::Index>(r)), 1e-9);
    }
  }
}

TYPED_TEST(Walk_solver, TakesSeveralFactorisationsAfterOneAnalysis) {
  std::mt19937 random(10);
  Network network{triangulated_torus(7), {}};
  TypeParam solver;
  solver.analyze(network.graph);
  for (int trial = 0; trial < 3; ++trial) {
    network.conductances = spread_conductances(network.graph.number_of_edges(), 1, random);
    const std::vector<Index> seeds = random_faces(network.graph, 2, random);
    solver.factorize(network.conductances, seeds);
    Potentials result;
    solver.potentials(Potentials::Identity(2, 2), result);
    const auto dense = dense_potentials<double>(network, seeds);
    for (std::size_t f = 0; f < dense.size(); ++f)
      ASSERT_NEAR(result(static_cast<Eigen::Index>(f), 0), dense[f][0], 1e-9);
  }
}

TYPED_TEST(Walk_solver, RefusesConductancesOfAnotherGraph) {
  const Dual_graph path(3, {{0, 1}, {1, 2}});
  TypeParam solver;
  solver.analyze(path);
  EXPECT_THROW(solver.factorize({1.}, {0}), std::invalid_argument);
}

TYPED_TEST(Walk_solver, CopiedIsAFreshSolver) {
  const Network network{triangulated_torus(7), std::vector<double>(3 * 49, 1.)};
  const std::vector<Index> seeds = {0, 40};
  TypeParam solver;
  const Potentials expected = networks::potentials(solver, network, seeds);
  TypeParam copy = solver;
  internal::Any_walk_solver made = internal::make_solver(solver);
  EXPECT_THROW(copy.factorize(network.conductances, seeds), std::invalid_argument);
  EXPECT_EQ(networks::potentials(copy, network, seeds), expected);
  EXPECT_EQ(networks::potentials(made, network, seeds), expected);
  copy = solver;
  EXPECT_THROW(copy.factorize(network.conductances, seeds), std::invalid_argument);
  Potentials again;
  solver.potentials(Potentials::Identity(2, 2), again);
  EXPECT_EQ(again, expected);
}

TEST(EigenWalkSolver, CopiedPromisesTheSameAccuracy) {
  std::mt19937 random(13);
  Network network{triangulated_torus(12), {}};
  network.conductances = spread_conductances(network.graph.number_of_edges(), 3, random);
  const auto is_refused = [&](auto solver) {
    try {
      networks::potentials(solver, network, {0, 100});
    } catch (const std::runtime_error&) {
      return true;
    }
    return false;
  };
  const Eigen_walk_solver<> lenient, strict(0);
  EXPECT_FALSE(is_refused(Eigen_walk_solver<>(lenient)));
  EXPECT_TRUE(is_refused(Eigen_walk_solver<>(strict)));
}

TEST(MakeSolver, CallsAFunctionObjectForASolverThatHasSettings) {
  const Network network{triangulated_torus(7), std::vector<double>(3 * 49, 1.)};
  const auto with_iterations = [](int most) {
    return [most] {
      Eigen_walk_solver<Eigen::ConjugateGradient<Matrix, Eigen::Lower>> solver;
      solver.eigen_solver().setMaxIterations(most);
      return solver;
    };
  };
  internal::Any_walk_solver hasty = internal::make_solver(with_iterations(1));
  internal::Any_walk_solver patient = internal::make_solver(with_iterations(1000));
  EXPECT_THROW(networks::potentials(hasty, network, {0, 40}), std::runtime_error);
  EXPECT_NO_THROW(networks::potentials(patient, network, {0, 40}));
}

TEST(EigenWalkSolver, GivesTheWholeMatrixToSolversThatReadIt) {
  std::mt19937 random(17);
  Network network{triangulated_torus(8), {}};
  network.conductances = spread_conductances(network.graph.number_of_edges(), 1, random);
  const std::vector<Index> seeds = random_faces(network.graph, 4, random);
  Star_mesh_elimination exact;
  const Potentials expected = networks::potentials(exact, network, seeds);
  Eigen_walk_solver<Eigen::BiCGSTAB<Matrix>> of_any_matrix;
  EXPECT_LE((networks::potentials(of_any_matrix, network, seeds) - expected).cwiseAbs().maxCoeff(), 1e-9);
  Eigen_walk_solver<Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper>> of_both_triangles;
  EXPECT_LE((networks::potentials(of_both_triangles, network, seeds) - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(EigenWalkSolver, RefusesToAnswerWhereDigitsAreLost) {
  std::mt19937 random(11);
  Network network{triangulated_torus(16), {}};
  network.conductances = spread_conductances(network.graph.number_of_edges(), 60, random);
  const std::vector<Index> seeds = random_faces(network.graph, 8, random);
  Eigen_walk_solver<> cholesky;
  EXPECT_THROW(networks::potentials(cholesky, network, seeds), std::runtime_error);
  Eigen_walk_solver<Eigen::ConjugateGradient<Matrix, Eigen::Lower>> conjugate_gradient;
  EXPECT_THROW(networks::potentials(conjugate_gradient, network, seeds), std::runtime_error);
  Star_mesh_elimination star_mesh;
  EXPECT_LE((networks::potentials(star_mesh, network, seeds).rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
}

}  // namespace test_walk_solvers
