// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_MESH_FACE_DIFFUSION_H
#define RW_SEGMENTATION_INTERNAL_MESH_FACE_DIFFUSION_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>

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
/// meshes, too. The number of iterations hardly grows with the mesh. Single precision will do, because only the correction
/// to a start is computed and no link is stiffer than it can tell.
class Face_diffusion {
 public:
  /// \param mesh with a face that has an area
  /// \param time the square of the length over which vectors are averaged, in the unit box
  /// Complexity: linear.
  Face_diffusion(const Dual_mesh& mesh, double time) {
    levels_.push_back(finest_level(mesh, time));
    coarsen();
    if (bound_links()) coarsen();
  }

  /// Of the faces and of aggregates of them. Each level has half as many nodes as the one before or less.
  std::size_t number_of_levels() const { return levels_.size(); }

  /// Corrects `start`, which may be `x0` itself, until the root of the mean square over the faces of its error, relative
  /// to the length of each vector, is below `tolerance`, or as small as single precision makes it.
  /// \throws Cancelled
  std::vector<Eigen::Vector3d> solve(const std::vector<Eigen::Vector3d>& x0, const std::vector<Eigen::Vector3d>& start,
                                     double tolerance, const Progress& progress) {
    constexpr int longest = 1000, longest_stall = 200;  // iterations
    // An error over what a cycle would change: up to .65 on a hand of 2 to 612 thousand faces, 2.3 on tubes of squares where
    // vectors are averaged over up to a tenth of the root of the area, and all waves are smooth.
    constexpr double overlooked = 2.5;
    const std::size_t n = start.size();
    Level& level = levels_.front();
    Block& residual = level.right;
    Block& preconditioned = level.solution;
    residual.resize(n);
    set_residual(x0, start, level);
    std::vector<Eigen::Vector3d> zero;
    if (error_by_rounding() > tolerance) {  // of differences across stiff links; zero has none
      zero.assign(n, Eigen::Vector3d::Zero());
      set_residual(x0, zero, level);
    }
    const std::vector<Eigen::Vector3d>& x = zero.empty() ? start : zero;
    Block correction(n, Vector::Zero()), direction(n, Vector::Zero());
    Sums previous = {1, 1, 1};
    double first = 0, least = std::numeric_limits<double>::infinity();
    int last_gain = 0;
    for (int iteration = 0;; ++iteration) {
      cycle(0);
      const double error = overlooked * relative_change(x, correction, preconditioned);
      if (error <= tolerance) break;
      if (iteration == 0) first = error;
      if (error < least) {
        least = error;
        last_gain = iteration;
      }
      if (iteration == longest || iteration - last_gain == longest_stall) break;
      progress(std::clamp(std::log(first / error) / std::log(first / tolerance), 0., 1.));

      const Sums energy = dot(residual, preconditioned);
      const Vector beta = quotient(energy, previous, n);
      for (std::size_t i = 0; i < n; ++i) {
        direction[i] = product(beta, direction[i]);
        direction[i] += preconditioned[i];
      }
      Block& image = preconditioned;  // which the next cycle makes anew
      apply(level, direction, image);
      const Vector alpha = quotient(energy, dot(direction, image), n);
      for (std::size_t i = 0; i < n; ++i) {
        correction[i] += product(alpha, direction[i]);
        residual[i] -= product(alpha, image[i]);
      }
      previous = energy;
    }
    Block().swap(direction);  // The result takes their place.
    Block().swap(residual);
    std::vector<Eigen::Vector3d> result;
    result.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      correction[i] += preconditioned[i];
      result.push_back(x[i]);
      for (Eigen::Index c = 0; c < 3; ++c) result.back()[c] += static_cast<double>(correction[i][c]);
    }
    return result;
  }

 private:
  using Index = Dual_graph::Index;
  using Vector = Eigen::Vector4f;  // three coordinates, padded to a register
  using Block = std::vector<Vector>;
  using Sums = std::array<double, 3>;

  // Few kinds of expressions, since each kind takes its time to compile.
  static Vector scaled(float factor, const Vector& v) { return factor * v; }
  static Vector product(const Vector& a, const Vector& b) { return a.cwiseProduct(b); }
  static Vector difference(const Vector& a, const Vector& b) { return a - b; }
  static Vector in_single_precision(const Eigen::Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), 0};
  }

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
    Block right, solution;

    std::size_t size() const { return mass.size(); }

    void resize(std::size_t nodes) {
      row.resize(nodes + 1);
      mass.resize(nodes);
      inverse_diagonal.resize(nodes);
      right.resize(nodes);
      solution.resize(nodes);
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
  };

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
    for (std::size_t e = 0; e < weight.size(); ++e) {
      const auto [i, j] = graph.faces_of(static_cast<Index>(e));
      const double length = mesh.edge_length(static_cast<Dual_mesh::Index>(e));
      const double distance = std::max(2. / 3 * (area[i] + area[j]), smallest_area) / std::max(length, smallest_length);
      weight[e] = static_cast<float>(std::min(time / mean_area * length / distance, heaviest));
    }
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
    while (is_diffusive(levels_.back())) levels_.push_back(coarser_level(levels_.back()));
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
        std::size_t a = i, b = to, depth = 0;
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

  /// Grows each aggregate from the first node that has none to four nodes at most. A node that finds none to grow by
  /// joins the aggregate of its strongest neighbour, lest a node with many weak links keeps them all on every level.
  static Aggregates aggregate(Level& level) {
    constexpr std::size_t largest = 4;
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
        if (level.links[k].weight > strongest.weight) strongest = level.links[k];
      for (std::size_t m = 0; m < grown.size(); ++m)
        for (std::size_t k = level.row[grown[m]]; k < level.row[grown[m] + std::size_t(1)]; ++k) {
          const auto [to, weight] = level.links[k];
          if (grown.size() == largest || level.aggregate[to] != none || !(weight > strong * strongest.weight)) continue;
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
          const Index to = fine.aggregate[fine.links[k].to];
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
  static void set_residual(const std::vector<Eigen::Vector3d>& x0, const std::vector<Eigen::Vector3d>& x,
                           Level& level) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto difference_to_x = [&](const Eigen::Vector3d& v) { return Eigen::Vector3d(v - x[i]); };
      Eigen::Vector3d sum = level.mass[i] * difference_to_x(x0[i]);
      for (std::size_t k = level.row[i]; k < level.row[i + 1]; ++k)
        sum += level.links[k].weight * difference_to_x(x[level.links[k].to]);
      level.right[i] = in_single_precision(sum);
    }
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
  static void apply(const Level& level, const Block& x, Block& y) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      Vector sum = scaled(level.mass[i], x[i]);
      for (std::size_t k = level.row[i]; k < level.row[i + 1]; ++k)
        sum += scaled(level.links[k].weight, difference(x[i], x[level.links[k].to]));
      y[i] = sum;
    }
  }

  /// Approximately solves the system of a level for `right`, by an operation that is symmetric: sweeps forward and backward,
  /// and between them a correction by the coarser level; two corrections where that is cheap, from the third level on.
  void cycle(std::size_t depth) {
    Level& level = levels_[depth];
    std::fill(level.solution.begin(), level.solution.end(), Vector::Zero());
    sweep_forward(level);
    if (depth + 1 < levels_.size()) {
      correct(depth);
      if (depth > 1) {
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
    std::fill(coarse.right.begin(), coarse.right.end(), Vector::Zero());
    for (std::size_t i = 0; i < x.size(); ++i) {
      Vector residual = difference(level.right[i], scaled(level.mass[i], x[i]));
      for (std::size_t k = level.row[i]; k < level.row[i + 1]; ++k)
        residual += scaled(level.links[k].weight, difference(x[level.links[k].to], x[i]));
      coarse.right[level.aggregate[i]] += residual;
    }
    cycle(depth + 1);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += scaled(over_correction, coarse.solution[level.aggregate[i]]);
  }

  static void sweep_forward(Level& level) {
    for (std::size_t i = 0; i < level.size(); ++i) relax(level, i);
  }
  static void sweep_backward(Level& level) {
    for (std::size_t i = level.size(); i-- > 0;) relax(level, i);
  }

  /// Solves the equation of a node, its neighbours being as they are.
  static void relax(Level& level, std::size_t i) {
    Vector sum = level.right[i];
    for (std::size_t k = level.row[i]; k < level.row[i + 1]; ++k)
      sum += scaled(level.links[k].weight, level.solution[level.links[k].to]);
    level.solution[i] = scaled(level.inverse_diagonal[i], sum);
  }

  /// The root mean square of |change| / |x + correction|, each at most 1.
  static double relative_change(const std::vector<Eigen::Vector3d>& x, const Block& correction, const Block& change) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Eigen::Vector3f vector = x[i].cast<float>() + correction[i].head<3>();
      sum += std::min(1.F, change[i].squaredNorm() / std::max(vector.squaredNorm(), 1e-30F));
    }
    return std::sqrt(sum / static_cast<double>(x.size()));
  }

  /// The scalar products of the coordinates, in double precision from block to block.
  static Sums dot(const Block& x, const Block& y) {
    constexpr std::size_t block = 1024;
    Sums total = {0, 0, 0};
    for (std::size_t begin = 0; begin < x.size(); begin += block) {
      Vector sum = Vector::Zero();
      for (std::size_t i = begin; i < std::min(begin + block, x.size()); ++i) sum += product(x[i], y[i]);
      for (std::size_t c = 0; c < total.size(); ++c) total[c] += static_cast<double>(sum[static_cast<Eigen::Index>(c)]);
    }
    return total;
  }

  /// 0 for a coordinate that is solved exactly, or so well that products of numbers in single precision are too small to
  /// have digits: steps by such quotients lead away.
  /// \param denominator sums of `terms` products
  static Vector quotient(const Sums& numerator, const Sums& denominator, std::size_t terms) {
    const double smallest = 16. * std::numeric_limits<float>::denorm_min() * static_cast<double>(terms);
    Vector result = Vector::Zero();
    for (std::size_t c = 0; c < numerator.size(); ++c)
      if (denominator[c] > smallest)
        result[static_cast<Eigen::Index>(c)] = static_cast<float>(numerator[c] / denominator[c]);
    return result;
  }

  std::vector<Level> levels_;
};

}  // namespace RW_segmentation::internal

#endif
