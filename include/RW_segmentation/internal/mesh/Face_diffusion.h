// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_FACE_DIFFUSION_H
#define RW_SEGMENTATION_INTERNAL_MESH_FACE_DIFFUSION_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/threads.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// One implicit step of diffusion of vectors over the faces: (diag(A) + t Lap) X = diag(A) X0, where Lap has the weight
/// |e| / l for each edge, l = 2/3 (Ai + Aj) / |e| being the distance of the faces' centres.
///
/// Solved by conjugate gradients for the three coordinates at once. The preconditioner is a multigrid cycle: a sweep of
/// Gauss-Seidel forward and one backward over the faces, between them the same for aggregates of about four faces, for
/// aggregates of those, and so on until mass outweighs diffusion. It is a W-cycle, which sees smooth errors on large
/// meshes, too. The number of iterations hardly grows with the mesh. Single precision will do, because the residual of the
/// start is computed in double precision and no link is stiffer than single precision can tell.
///
/// Large levels are swept in a few stretches at the same time. A stretch sees the nodes of others as they were before the
/// sweep; it is the same sweep whatever the number of threads.
class Face_diffusion {
 public:
  /// \param mesh with a face that has an area
  /// \param time the square of the length over which vectors are averaged, in the unit box
  /// \param shortest_stretch the least number of nodes that are swept beside others
  /// Complexity: linear.
  Face_diffusion(const Dual_mesh& mesh, double time, std::size_t shortest_stretch = 75000)
      : shortest_stretch_(shortest_stretch) {
    levels_.push_back(finest_level(mesh, time));
    levels_.back().part(shortest_stretch_);
    coarsen();
    if (bound_links()) coarsen();
  }

  /// Of the faces and of aggregates of them. Each level has half as many nodes as the one before or less.
  std::size_t number_of_levels() const { return levels_.size(); }

  /// Corrects `start`, which may be `x0` itself, until the root of the mean square over the faces of its error, relative
  /// to the length of each vector, is below `tolerance`, or as small as single precision makes it.
  /// \param x0, start functions from the number of a face to its vector, in double precision
  /// \throws Cancelled
  template <class Before, class Start>
  std::vector<Eigen::Vector3d> solve(const Before& x0, const Start& start, double tolerance, const Progress& progress) {
    constexpr int longest = 1000, longest_stall = 200;  // iterations
    // An error over what a cycle would change: up to 1.7 on a hand of 40 to 612 thousand faces, 2.6 on tubes of squares where
    // vectors are averaged over up to a tenth of the root of the area, and all waves are smooth.
    constexpr double overlooked = 3;
    Level& level = levels_.front();
    const std::size_t n = level.size();
    Block& residual = level.right;
    Block& preconditioned = level.solution;
    residual.resize(n);  // An earlier call has freed it.
    set_residual(x0, start, level);
    const bool is_from_zero = error_by_rounding() > tolerance;  // of differences across stiff links; zero has none
    const auto from = [&](Index i) -> Eigen::Vector3d { return is_from_zero ? Eigen::Vector3d::Zero() : start(i); };
    if (is_from_zero) set_residual(x0, from, level);
    Block x(n), direction(preconditioned.size(), Vector::Zero());
    for_stretches(level, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) x[i] = in_single_precision(from(static_cast<Index>(i)));
    });
    Sums previous = {1, 1, 1, 0};
    double first = 0, least = std::numeric_limits<double>::infinity();
    int last_gain = 0;
    for (int iteration = 0;; ++iteration) {
      cycle(0);
      const Sums energy = energy_and_change(level, x);
      const double error = overlooked * std::sqrt(energy[3] / static_cast<double>(n));
      if (error <= tolerance) break;
      if (iteration == 0) first = error;
      if (error < least) {
        least = error;
        last_gain = iteration;
      }
      if (iteration == longest || iteration - last_gain == longest_stall) break;
      progress(std::clamp(std::log(first / error) / std::log(first / tolerance), 0., 1.));

      const Vector beta = quotient(energy, previous, n);
      for_stretches(level, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          direction[i] = product(beta, direction[i]);
          direction[i] += preconditioned[i];
        }
      });
      copy_to_ghosts(level, direction);
      Block& image = preconditioned;  // which the next cycle makes anew
      const Vector alpha = quotient(energy, apply(level, direction, image), n);
      for_stretches(level, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          x[i] += product(alpha, direction[i]);
          residual[i] -= product(alpha, image[i]);
        }
      });
      previous = energy;
    }
    Block().swap(direction);  // The result takes their place.
    Block().swap(residual);
    std::vector<Eigen::Vector3d> result;
    result.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {  // What needs no correction keeps all digits.
      result.push_back(from(static_cast<Index>(i)));
      Vector correction = difference(x[i], in_single_precision(result.back()));
      correction += preconditioned[i];
      result.back() += in_double_precision(correction);
    }
    return result;
  }

 private:
  using Index = Dual_graph::Index;
  using Vector = Eigen::Vector4f;  // three coordinates, padded to a register
  using Block = std::vector<Vector>;
  using Sums = std::array<double, 4>;  // one of each coordinate, and one more

  // Few kinds of expressions, since each kind takes its time to compile.
  static Vector scaled(float factor, const Vector& v) { return factor * v; }
  static Vector product(const Vector& a, const Vector& b) { return a.cwiseProduct(b); }
  static Vector difference(const Vector& a, const Vector& b) { return a - b; }
  static Vector in_single_precision(const Eigen::Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), 0};
  }
  static Eigen::Vector3d in_double_precision(const Vector& v) { return v.head<3>().cast<double>(); }

  struct Link {
    Index to;
    float weight;
  };

  /// The faces, or aggregates of them, with their links as compressed rows.
  struct Level {
    std::vector<Index> row;
    std::vector<Link> links;
    std::vector<float> mass;
    std::vector<float> inverse_diagonal;  ///< 1 / (mass + sum of weights)
    std::vector<Index> aggregate;         ///< the node of the coarser level
    std::vector<std::size_t> begin;       ///< of each stretch; behind them the end of the last one
    std::vector<Index> ghosts;  ///< the nodes of other stretches that links lead to, numbered behind all nodes
    Block right, solution;      ///< the latter of the ghosts, too

    std::size_t size() const { return mass.size(); }
    std::size_t number_of_stretches() const { return begin.size() - 1; }

    /// The node that the end of a link stands for.
    Index node(Index to) const { return to < size() ? to : ghosts[to - size()]; }

    void resize(std::size_t nodes) {
      row.resize(nodes + 1);
      mass.resize(nodes);
      inverse_diagonal.resize(nodes);
    }

    /// Closes the row of a node, whose links are the last ones.
    void close_row(std::size_t node, float node_mass) {
      row[node + 1] = static_cast<Index>(links.size());
      mass[node] = node_mass;
      sum_up_row(node);
    }

    void sum_up_row(std::size_t node) {
      float diagonal = mass[node];
      for (std::size_t k = row[node]; k < row[node + 1]; ++k) diagonal += links[k].weight;
      inverse_diagonal[node] = 1 / diagonal;
    }

    /// Parts the nodes into stretches, whose links to other stretches lead to ghosts from now on.
    void part(std::size_t shortest) {
      // On a hand of 153 thousand to 2.4 million faces up to 4 take as many iterations as one, 8 one more, 16 up to four more.
      constexpr std::size_t most = 4;
      // Of the links, one in so many may leave its stretch: aggregates, which do not, would hardly grow otherwise. Along the
      // surface numbered, fewer than one in a hundred do.
      constexpr std::size_t links_for_one_that_leaves = 32;
      set_stretches(std::clamp(size() / shortest, std::size_t(1), most));
      std::size_t leaving = 0;
      for_links_that_leave([&](Index&) { ++leaving; });
      if (leaving > links.size() / links_for_one_that_leaves) set_stretches(1);
      for_links_that_leave([&](Index& to) {
        ghosts.push_back(to);
        to = static_cast<Index>(size() + ghosts.size() - 1);
      });
      right.resize(size());
      solution.resize(size() + ghosts.size());
    }

    void set_stretches(std::size_t number) {
      begin.clear();
      for (std::size_t s = 0; s <= number; ++s) begin.push_back(s * size() / number);
    }

    /// Calls `work(to)` with the end of each link to another stretch.
    template <class Work>
    void for_links_that_leave(const Work& work) {
      for (std::size_t s = 0; s < number_of_stretches(); ++s)
        for (std::size_t k = row[begin[s]]; k < row[begin[s + 1]]; ++k)
          if (links[k].to < begin[s] || links[k].to >= begin[s + 1]) work(links[k].to);
    }
  };

  /// Calls `work(begin, end)` for each stretch of nodes, for several at the same time if there are threads.
  template <class Work>
  static void for_stretches(const Level& level, const Work& work) {
    parallel_stretches(
        level.number_of_stretches(),
        [&](std::size_t stretch, std::size_t) { work(level.begin[stretch], level.begin[stretch + 1]); }, 1);
  }

  /// Adds up `term(i)` of all nodes, in double precision from block to block.
  template <class Term>
  static Sums sum(const Level& level, const Term& term) {
    std::vector<Sums> sums(level.number_of_stretches(), Sums{0, 0, 0, 0});
    const auto add_up = [&](std::size_t stretch, std::size_t) {
      constexpr std::size_t longest = 1024;
      for (std::size_t block = level.begin[stretch]; block < level.begin[stretch + 1]; block += longest) {
        const std::size_t end = std::min(block + longest, level.begin[stretch + 1]);
        Vector of_block = Vector::Zero();
        for (std::size_t i = block; i < end; ++i) of_block += term(i);
        add(of_block, sums[stretch]);
      }
    };
    parallel_stretches(sums.size(), add_up, 1);
    for (std::size_t s = 1; s < sums.size(); ++s)
      for (std::size_t c = 0; c < 4; ++c) sums[0][c] += sums[s][c];
    return sums[0];
  }
  static void add(const Vector& v, Sums& sums) {
    for (std::size_t c = 0; c < 4; ++c) sums[c] += static_cast<double>(v[static_cast<Eigen::Index>(c)]);
  }

  static void copy_to_ghosts(const Level& level, Block& x) {
    for (std::size_t g = 0; g < level.ghosts.size(); ++g) x[level.size() + g] = x[level.ghosts[g]];
  }

  /// The largest weight of a link, relative to what it can have to carry. The values at its ends differ by less than
  /// single precision tells then; with a heavier one, their rounding would count for more than all the rest.
  static constexpr float stiffest = 1 / std::numeric_limits<float>::epsilon();

  static Level finest_level(const Dual_mesh& mesh, double time) {
    const Dual_graph& graph = mesh.graph();
    const std::vector<double>& area = mesh.areas();
    const double mean_area = mesh.total_area() / static_cast<double>(area.size());
    // The floors keep the system positive definite, and slivers from tearing it apart.
    const double smallest_area = 1e-4 * mean_area;
    const double smallest_length = 1e-4 * std::sqrt(mean_area);

    // In units of the mean area. No link carries more than the whole mesh; this keeps sums of weights finite.
    const double heaviest = stiffest * static_cast<double>(area.size());
    std::vector<float> weight(graph.number_of_edges());
    parallel_stretches(weight.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e) {
        const auto [i, j] = graph.faces_of(static_cast<Index>(e));
        const double length = mesh.edge_lengths()[e];
        const double distance =
            std::max(2. / 3 * (area[i] + area[j]), smallest_area) / std::max(length, smallest_length);
        weight[e] = static_cast<float>(std::min(time / mean_area * length / distance, heaviest));
      }
    });
    Level level;
    level.resize(area.size());
    level.links.reserve(2 * weight.size());
    for (std::size_t i = 0; i < area.size(); ++i) {
      for (const auto [j, e] : graph.neighbours(static_cast<Index>(i))) level.links.push_back({j, weight[e]});
      level.close_row(i, static_cast<float>(std::max(area[i], smallest_area) / mean_area));
    }
    return level;
  }

  /// Makes the coarser levels of the finest one.
  void coarsen() {
    levels_.resize(1);
    while (is_diffusive(levels_.back())) {
      levels_.push_back(coarser_level(levels_.back()));
      levels_.back().part(shortest_stretch_);
    }
  }

  /// Bounds the weights of links between faces. What a link carries comes from the masses of an aggregate that holds both
  /// of its faces or over the links that leave that, and so is no more than the aggregate's diagonal.
  /// \returns whether a link was heavier
  bool bound_links() {
    std::vector<std::vector<float>> load(levels_.size());  // of an aggregate or one that holds it, the least
    float least = std::numeric_limits<float>::max();
    for (std::size_t depth = levels_.size(); depth-- > 1;) {
      const Level& level = levels_[depth];
      load[depth].resize(level.size());
      for (std::size_t i = 0; i < level.size(); ++i) {
        load[depth][i] = 1 / level.inverse_diagonal[i];
        if (depth + 1 < levels_.size()) load[depth][i] = std::min(load[depth][i], load[depth + 1][level.aggregate[i]]);
        least = std::min(least, load[depth][i]);
      }
    }

    bool is_bounded = false;
    Level& faces = levels_.front();
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (std::size_t k = faces.row[i]; k < faces.row[i + 1]; ++k) {
        auto& [to, weight] = faces.links[k];
        if (!(weight > stiffest * least)) continue;
        std::size_t a = i, b = faces.node(to), depth = 0;
        for (; a != b && depth + 1 < levels_.size(); ++depth) {
          a = levels_[depth].aggregate[a];
          b = levels_[depth].aggregate[b];
        }
        if (a != b || !(weight > stiffest * load[depth][a])) continue;
        weight = stiffest * load[depth][a];
        is_bounded = true;
      }
      if (is_bounded) faces.sum_up_row(i);
    }
    return is_bounded;
  }

  /// Whether two sweeps would leave much undone on some part of the mesh, however small.
  static bool is_diffusive(const Level& level) {
    for (std::size_t i = 0; i < level.size(); ++i)
      if (level.mass[i] * level.inverse_diagonal[i] < 0.3F) return true;
    return false;
  }

  /// Groups of strongly linked nodes: `members[begin[a]]` .. `members[begin[a + 1] - 1]`.
  struct Aggregates {
    std::vector<Index> members, begin;
  };

  /// Grows each aggregate within a stretch, from the first node that has none to five nodes at most. A node that finds none to
  /// grow by joins the aggregate of its strongest neighbour, lest a node with many weak links keeps them all on every level.
  static Aggregates aggregate(Level& level) {
    constexpr std::size_t largest = 5;
    constexpr float strong = 0.25F;  // relative to the strongest link of the first node
    constexpr Index none = std::numeric_limits<Index>::max();
    level.aggregate.assign(level.size(), none);
    Index number = 0;
    std::vector<Index> grown;
    for (std::size_t root = 0; root < level.size(); ++root) {
      if (level.aggregate[root] != none) continue;
      grown.assign(1, static_cast<Index>(root));
      level.aggregate[root] = number;
      Link strongest = {none, 0};  // links over edges without length have no weight
      for (std::size_t k = level.row[root]; k < level.row[root + 1]; ++k)
        if (level.links[k].to < level.size() && level.links[k].weight > strongest.weight) strongest = level.links[k];
      for (std::size_t m = 0; m < grown.size(); ++m)
        for (std::size_t k = level.row[grown[m]]; k < level.row[grown[m] + std::size_t(1)]; ++k) {
          const auto [to, weight] = level.links[k];
          if (grown.size() == largest || to >= level.size() || level.aggregate[to] != none) continue;
          if (!(weight > strong * strongest.weight)) continue;
          level.aggregate[to] = number;
          grown.push_back(to);
        }
      if (grown.size() == 1 && strongest.to != none)
        level.aggregate[root] = level.aggregate[strongest.to];
      else
        ++number;
    }
    return members_of(level.aggregate, number);
  }

  static Aggregates members_of(const std::vector<Index>& aggregate, std::size_t number) {
    Aggregates result;
    result.begin.assign(number + 1, 0);
    result.members.resize(aggregate.size());
    for (const Index a : aggregate) ++result.begin[a + std::size_t(1)];
    std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
    std::vector<Index> next = result.begin;
    for (std::size_t i = 0; i < aggregate.size(); ++i) result.members[next[aggregate[i]]++] = static_cast<Index>(i);
    return result;
  }

  /// The level whose nodes are aggregates of `fine`: masses and parallel links add up.
  static Level coarser_level(Level& fine) {
    const Aggregates aggregates = aggregate(fine);
    const std::size_t n = aggregates.begin.size() - 1;
    Level coarse;
    coarse.resize(n);
    coarse.links.reserve(fine.links.size() / 2);
    std::vector<std::size_t> behind(n, 0);  // the link to a node, if it lies in the row at hand
    for (std::size_t node = 0; node < n; ++node) {
      const std::size_t row = coarse.links.size();
      float mass = 0;
      for (std::size_t m = aggregates.begin[node]; m < aggregates.begin[node + 1]; ++m) {
        const std::size_t member = aggregates.members[m];
        mass += fine.mass[member];
        for (std::size_t k = fine.row[member]; k < fine.row[member + 1]; ++k) {
          const Index to = fine.aggregate[fine.node(fine.links[k].to)];
          if (to == node) continue;
          if (behind[to] <= row) {
            coarse.links.push_back({to, 0});
            behind[to] = coarse.links.size();
          }
          coarse.links[behind[to] - 1].weight += fine.links[k].weight;
        }
      }
      coarse.close_row(node, mass);
    }
    return coarse;
  }

  /// Sets the right side to the residual diag(A) (x0 - x) - t Lap x.
  template <class Before, class Start>
  static void set_residual(const Before& x0, const Start& start, Level& level) {
    std::vector<Eigen::Vector3d> x(level.size());
    for_stretches(level, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) x[i] = start(static_cast<Index>(i));
    });
    for_stretches(level, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto difference_to_x = [&](const Eigen::Vector3d& v) { return Eigen::Vector3d(v - x[i]); };
        Eigen::Vector3d sum = level.mass[i] * difference_to_x(x0(static_cast<Index>(i)));
        for (std::size_t k = level.row[i]; k < level.row[i + 1]; ++k)
          sum += level.links[k].weight * difference_to_x(x[level.node(level.links[k].to)]);
        level.right[i] = in_single_precision(sum);
      }
    });
  }

  /// By how much the rounding of the right side to single precision may change the solution, as a root mean square over
  /// the faces: that of an aggregate by the rounding of all its faces over its diagonal, on the level where this is worst.
  double error_by_rounding() const {
    struct Share {
      double squares, faces;
    };
    const Block& right = levels_.front().right;
    std::vector<Share> shares;
    shares.reserve(right.size());
    for (const Vector& value : right) shares.push_back({value.squaredNorm(), 1});
    double worst = 0;
    for (std::size_t depth = 0;; ++depth) {
      const Level& level = levels_[depth];
      double sum = 0;
      for (std::size_t i = 0; i < level.size(); ++i)
        sum += shares[i].faces * shares[i].squares * level.inverse_diagonal[i] * level.inverse_diagonal[i];
      worst = std::max(worst, sum);
      if (depth + 1 == levels_.size()) break;
      std::vector<Share> of_aggregates(levels_[depth + 1].size(), {0, 0});
      for (std::size_t i = 0; i < level.size(); ++i) {
        of_aggregates[level.aggregate[i]].squares += shares[i].squares;
        of_aggregates[level.aggregate[i]].faces += shares[i].faces;
      }
      shares = std::move(of_aggregates);
    }
    return std::numeric_limits<float>::epsilon() / 2 * std::sqrt(worst / static_cast<double>(right.size()));
  }

  /// `y` = (diag(A) + t Lap) `x`, by differences, so that no stiff link cancels what the others say.
  /// \returns the scalar products of the coordinates of `x` and `y`
  static Sums apply(const Level& level, const Block& x, Block& y) {
    return sum(level, [&](std::size_t i) {
      Vector row = scaled(level.mass[i], x[i]);
      for (std::size_t k = level.row[i]; k < level.row[i + 1]; ++k)
        row += scaled(level.links[k].weight, difference(x[i], x[level.links[k].to]));
      y[i] = row;
      return product(x[i], row);
    });
  }

  /// Approximately solves the system of a level for `right`, by an operation that is symmetric: sweeps forward and backward,
  /// and between them a correction by the coarser level; twice on coarser levels, where that is cheap.
  void cycle(std::size_t depth) {
    Level& level = levels_[depth];
    std::fill(level.solution.begin() + static_cast<std::ptrdiff_t>(level.size()), level.solution.end(), Vector::Zero());
    for_stretches(level, [&](std::size_t begin, std::size_t end) {
      std::fill(level.solution.begin() + static_cast<std::ptrdiff_t>(begin),
                level.solution.begin() + static_cast<std::ptrdiff_t>(end), Vector::Zero());
      for (std::size_t i = begin; i < end; ++i) relax(level, i);
    });
    if (depth + 1 < levels_.size()) {
      correct(depth);
      if (depth > 0) {
        sweep_backward(level);
        sweep_forward(level);
        correct(depth);
      }
    }
    sweep_backward(level);
  }

  /// Adds what the coarser level makes of the residual.
  void correct(std::size_t depth) {
    // An aggregate moves as one, which makes it too stiff: its corrections fall short. 1.2 to 1.6 take about as many
    // iterations, on a hand of 2 to 612 thousand faces. Braess (1995) takes 1.8 for other aggregates.
    constexpr float over_correction = 1.4F;
    Level &level = levels_[depth], &coarse = levels_[depth + 1];
    Block& x = level.solution;
    copy_to_ghosts(level, x);
    std::fill(coarse.right.begin(), coarse.right.end(), Vector::Zero());
    for_stretches(level, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Vector residual = difference(level.right[i], scaled(level.mass[i], x[i]));
        for (std::size_t k = level.row[i]; k < level.row[i + 1]; ++k)
          residual += scaled(level.links[k].weight, difference(x[level.links[k].to], x[i]));
        coarse.right[level.aggregate[i]] += residual;  // an aggregate lies in one stretch
      }
    });
    cycle(depth + 1);
    for_stretches(level, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) x[i] += scaled(over_correction, coarse.solution[level.aggregate[i]]);
    });
  }

  static void sweep_forward(Level& level) {
    copy_to_ghosts(level, level.solution);
    for_stretches(level, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) relax(level, i);
    });
  }
  static void sweep_backward(Level& level) {
    copy_to_ghosts(level, level.solution);
    for_stretches(level, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = end; i-- > begin;) relax(level, i);
    });
  }

  /// Solves the equation of a node, its neighbours being as they are.
  static void relax(Level& level, std::size_t i) {
    Vector sum = level.right[i];
    for (std::size_t k = level.row[i]; k < level.row[i + 1]; ++k)
      sum += scaled(level.links[k].weight, level.solution[level.links[k].to]);
    level.solution[i] = scaled(level.inverse_diagonal[i], sum);
  }

  /// The scalar products of the coordinates of `right` and `solution`, and the sum of the squares of |solution| / |x|, each
  /// at most 1.
  static Sums energy_and_change(const Level& level, const Block& x) {
    return sum(level, [&](std::size_t i) {
      const Vector& change = level.solution[i];
      Vector terms = product(level.right[i], change);
      terms[3] = std::min(1.F, change.squaredNorm() / std::max(x[i].squaredNorm(), 1e-30F));
      return terms;
    });
  }

  /// 0 for a coordinate that is solved exactly, or so well that products of numbers in single precision are too small to
  /// have digits: steps by such quotients lead away.
  /// \param denominator sums of `terms` products
  static Vector quotient(const Sums& numerator, const Sums& denominator, std::size_t terms) {
    const double smallest = 16. * std::numeric_limits<float>::denorm_min() * static_cast<double>(terms);
    Vector result = Vector::Zero();
    for (std::size_t c = 0; c < 3; ++c)
      if (denominator[c] > smallest)
        result[static_cast<Eigen::Index>(c)] = static_cast<float>(numerator[c] / denominator[c]);
    return result;
  }

  std::size_t shortest_stretch_;
  std::vector<Level> levels_;
};

}  // namespace RW_segmentation::internal

#endif
