// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_WALK_SEED_COLUMNS_H
#define RW_SEGMENTATION_INTERNAL_WALK_SEED_COLUMNS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/internal/solver/front_kernels.h>
#include <RW_segmentation/internal/walk/Seed_set.h>
#include <RW_segmentation/internal/walk/Walk_factor.h>
#include <RW_segmentation/internal/walk/Walk_network.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// A column of potentials for each seed face, brought up to date when seeds are edited.
///
/// - Adding s takes Green's function of s from the factor and takes out what reaches the present seeds j,
///   x_s ~ g_s - sum_j g_s(s_j) x_j, then x_j -= x_j(s) x_s.
/// - Removing s needs no solve: x_j += x_s c_sj / sum_i c_si. The conductances c that are left between the seeds when all
///   other faces are eliminated follow the edits by star-mesh transforms and their reverse. (Summing the currents round
///   s would give the same, but magnify rounding where s is joined to its neighbours much better than to other seeds.)
/// - The factor still absorbs at those seeds that it was made with and that are seeds no more, the released ones. There
///   it is given the values at which no current stays: between them a network of a few nodes is left, whose
///   conductances are the currents of the first columns.
///
/// Only the subtractions of an addition lose digits. The loss is estimated and passed on from edit to edit.
class Seed_columns {
 public:
  using Index = Dual_graph::Index;
  static constexpr std::size_t largest_edit = 8;   ///< seed faces changed at once; more are solved directly
  static constexpr std::size_t most_columns = 64;  ///< seed faces; more are solved directly
  static constexpr double accepted_error = 1e-9;   ///< absolute, of potentials after edits

  /// The potentials of one seed face, the others being at 0.
  struct Column {
    Index face;
    std::vector<double> potential;
    double error;  ///< absolute, an estimate of what edits have cost; fresh columns are right to a relative error
  };

  /// Where not empty: one for each seed face as of the last update.
  const std::vector<Column>& columns() const { return columns_; }
  bool empty() const { return columns_.empty(); }
  void clear() { columns_.clear(); }
  /// Columns that have been added without a factorisation.
  std::size_t number_added() const { return number_added_; }

  /// Brings the columns to the seeds.
  /// \param compare called as `compare(prepare)` when all is known but the potentials that the last edit leaves: these
  /// are there once `prepare(begin, end)` has been called for a stretch of faces, so that they are read while they are
  /// in the cache. Returns whether they are right.
  /// \returns false where that is impossible, inaccurate or not worth it; the columns are of no use then
  template <class Compare>
  bool update(const Walk_network& network, const Walk_factor& factor, const Seed_set& seeds, const Compare& compare);

 private:
  /// What is left between the seeds with a column when all other faces are eliminated, in the order of the columns.
  struct Between_seeds {
    Eigen::MatrixXd conductance, error;

    void append(const Eigen::VectorXd& to_others, const Eigen::VectorXd& to_others_error) {
      for (auto [matrix, row] : {std::pair(&conductance, &to_others), std::pair(&error, &to_others_error)}) {
        const Eigen::Index n = matrix->rows();
        matrix->conservativeResize(n + 1, n + 1);
        matrix->row(n).head(n) = matrix->col(n).head(n) = *row;
        (*matrix)(n, n) = 0;
      }
    }

    /// Takes out a seed; returns its row without itself, and the errors.
    std::pair<Eigen::VectorXd, Eigen::VectorXd> remove(Eigen::Index seed) {
      std::vector<Eigen::Index> others;
      for (Eigen::Index i = 0; i < conductance.rows(); ++i)
        if (i != seed) others.push_back(i);
      std::pair<Eigen::VectorXd, Eigen::VectorXd> row(conductance.col(seed)(others), error.col(seed)(others));
      conductance = Eigen::MatrixXd(conductance(others, others));
      error = Eigen::MatrixXd(error(others, others));
      return row;
    }
  };

  /// What one edit does to the potentials, face by face.
  struct Change {
    enum class Kind { none, addition, removal } kind = Kind::none;
    Eigen::VectorXd reaches;      ///< of an addition: what its source function has at the other seeds
    double resistance = 0;        ///< of an addition: between its face and the other seeds
    Eigen::VectorXd share;        ///< by column: of the column that is added, which is the last one, or that leaves
    std::vector<double> leaving;  ///< the column of a removal
  };

  bool has_column(Index face) const {
    return std::any_of(columns_.begin(), columns_.end(), [&](const Column& column) { return column.face == face; });
  }

  /// The current into `face`, which is at 0, when the others are at the given potentials.
  static double current_into(Index face, const Walk_network& network, const std::vector<double>& potential) {
    double current = 0;
    for (const auto& [next, edge] : network.graph.neighbours(face))
      current += network.conductances[edge] * potential[next];
    return current;
  }

  void fill(const Walk_network& network, const Walk_factor& factor);
  std::vector<double> source_function(Index s, const Walk_network& network, const Walk_factor& factor) const;
  std::vector<double> base_values(const std::vector<Index>& base, std::vector<double> current) const;
  bool add(Index s, std::vector<double> h, Change& change);
  bool remove(std::size_t place, const Walk_network& network, Change& change);
  void make(const Change& change, std::size_t begin, std::size_t end);
  void make_addition(const Change& change, std::size_t begin, std::size_t end);

  /// Makes a change at all faces.
  void finish(Change& change, const Walk_network& network) {
    if (change.kind == Change::Kind::none) return;
    for_stretches(network, [&](std::size_t begin, std::size_t end) { make(change, begin, end); });
    change = {};
  }

  std::vector<Column> columns_;
  Eigen::MatrixXd base_conductances_;  // between the seeds that the factor absorbs at, where there are columns
  Between_seeds between_seeds_;
  std::size_t number_added_ = 0;
};

// -------------------------------------------------------------------------------------------------------------------

template <class Compare>
bool Seed_columns::update(const Walk_network& network, const Walk_factor& factor, const Seed_set& seeds,
                          const Compare& compare) {
  if (!factor.is_made() || seeds.size() > most_columns) return false;
  std::vector<Index> present = factor.base(), added;
  if (!empty()) {
    present.clear();
    for (const Column& column : columns_) present.push_back(column.face);
  }
  for (const auto& seed : seeds.seeds())
    if (std::find(present.begin(), present.end(), seed.face) == present.end()) added.push_back(seed.face);
  const std::size_t removals = present.size() + added.size() - seeds.size();
  if (added.size() + removals > largest_edit || present.size() > most_columns) return false;
  if (empty()) {
    if (added.size() + removals == 0) return false;
    fill(network, factor);
  }
  // Additions first: a removal must leave a seed behind.
  Change change;
  for (const Index face : added) {
    finish(change, network);
    if (!add(face, source_function(face, network, factor), change)) return false;
  }
  for (std::size_t place = columns_.size(); place-- > 0;) {
    if (seeds.contains(columns_[place].face)) continue;
    finish(change, network);
    if (!remove(place, network, change)) return false;
  }
  return compare([&](std::size_t begin, std::size_t end) { make(change, begin, end); });
}

/// Makes the columns of the seeds that the factor absorbs at.
inline void Seed_columns::fill(const Walk_network& network, const Walk_factor& factor) {
  const std::vector<Index>& base = factor.base();
  const auto count = static_cast<Eigen::Index>(base.size());
  std::vector<std::vector<double>> potentials = factor.solver().columns(base.size());
  for (std::size_t b = 0; b < base.size(); ++b) columns_.push_back({base[b], std::move(potentials[b]), 0});
  base_conductances_.resize(count, count);
  for (Eigen::Index r = 0; r < count; ++r)
    for (Eigen::Index b = 0; b < count; ++b)
      base_conductances_(r, b) = r == b ? 0
                                        : current_into(base[static_cast<std::size_t>(r)], network,
                                                       columns_[static_cast<std::size_t>(b)].potential);
  between_seeds_ = {base_conductances_, Eigen::MatrixXd::Zero(count, count)};
}

/// A function that is 0 at the seeds left of those in the base and whose only other sources are s and later seeds. Empty
/// where there is none: no seed of the base is left in the component.
inline std::vector<double> Seed_columns::source_function(Index s, const Walk_network& network,
                                                         const Walk_factor& factor) const {
  const std::vector<Index>& base = factor.base();
  const bool grounded = std::any_of(base.begin(), base.end(), [&](Index b) {
    return network.component.of[b] == network.component.of[s] && has_column(b);
  });
  if (!grounded) return {};
  const auto at = std::find(base.begin(), base.end(), s);
  if (at == base.end()) {
    std::vector<double> h, values(base.size(), 0.);
    // While the whole base is held at 0, what reaches it need not be known.
    const bool all_are_seeds = std::all_of(base.begin(), base.end(), [&](Index b) { return has_column(b); });
    if (!all_are_seeds) values = base_values(base, factor.solver().absorbed_currents(s));
    if (!values.empty()) factor.solver().response(s, values, h);
    return h;
  }
  // The factor absorbs at s itself: a unit current enters there.
  std::vector<double> current(base.size(), 0.);
  current[static_cast<std::size_t>(at - base.begin())] = 1;
  const std::vector<double> values = base_values(base, current);
  if (values.empty()) return {};
  Potentials result;
  factor.solver().potentials(Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())),
                             result);
  return {result.data(), result.data() + result.size()};
}

/// The values that the seeds of the base must be held at in the factor so that, when the given currents enter at them,
/// the seeds that are left are at 0 and nothing stays at the released ones: star-mesh transforms of the latter. Empty
/// where current cannot leave.
inline std::vector<double> Seed_columns::base_values(const std::vector<Index>& base,
                                                     std::vector<double> current) const {
  Eigen::MatrixXd c = base_conductances_;
  std::vector<Eigen::Index> released;
  for (std::size_t r = 0; r < base.size(); ++r)
    if (!has_column(base[r])) released.push_back(static_cast<Eigen::Index>(r));
  std::vector<char> eliminated(base.size(), 0);
  std::vector<double> sum(base.size(), 0.), value(base.size(), 0.);
  for (const Eigen::Index k : released) {
    const double d = sum[static_cast<std::size_t>(k)] = c.row(k).sum();
    if (!(d > 0)) {
      if (current[static_cast<std::size_t>(k)] > 0) return {};
      continue;
    }
    eliminated[static_cast<std::size_t>(k)] = 1;
    c.row(k) /= d;
    for (Eigen::Index i = 0; i < c.rows(); ++i) {
      current[static_cast<std::size_t>(i)] += c(k, i) * current[static_cast<std::size_t>(k)];
      if (eliminated[static_cast<std::size_t>(i)]) continue;
      c.row(i) += c(i, k) * c.row(k);
      c(i, i) = c(i, k) = 0;
    }
  }
  for (auto k = released.rbegin(); k != released.rend(); ++k) {
    const auto row = static_cast<std::size_t>(*k);
    if (!(sum[row] > 0)) continue;
    value[row] = current[row] / sum[row];
    for (std::size_t i = 0; i < base.size(); ++i) value[row] += c(*k, static_cast<Eigen::Index>(i)) * value[i];
  }
  return value;
}

/// A column for s, to be taken out of the other columns. False where too many digits would be lost.
/// \param h the source function of s
inline bool Seed_columns::add(Index s, std::vector<double> h, Change& change) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  if (h.empty()) return false;
  double error = 4 * epsilon * h[s], resistance = h[s];
  const auto n = static_cast<Eigen::Index>(columns_.size());
  Eigen::VectorXd reaches(n);                // the present seeds; the column of one is 0 at the others
  Eigen::VectorXd share(n), share_error(n);  // what walks from s meet first
  for (Eigen::Index c = 0; c < n; ++c) {
    const Column& column = columns_[static_cast<std::size_t>(c)];
    reaches[c] = h[column.face];
    error += reaches[c] * column.error;
    share[c] = column.potential[s];
    share_error[c] = column.error;
    resistance -= reaches[c] * share[c];
  }
  if (!(resistance > 0 && error < accepted_error * resistance)) return false;
  error /= resistance;
  for (Eigen::Index c = 0; c < n; ++c) columns_[static_cast<std::size_t>(c)].error += share[c] * error;
  columns_.push_back({s, std::move(h), error});

  between_seeds_.error += epsilon * between_seeds_.conductance +
                          (share_error * share.transpose() + share * share_error.transpose()) / resistance;
  between_seeds_.conductance -= share * share.transpose() / resistance;
  between_seeds_.conductance = between_seeds_.conductance.cwiseMax(0);
  between_seeds_.append(share / resistance, share_error / resistance);
  ++number_added_;
  change = {Change::Kind::addition, std::move(reaches), resistance, std::move(share), {}};
  return true;
}

/// Shares the column of a seed among the seeds that walks meet after it. False where too many digits would be lost.
inline bool Seed_columns::remove(std::size_t place, const Walk_network& network, Change& change) {
  Column leaving = std::move(columns_[place]);
  columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(place));
  const auto [current, current_error] = between_seeds_.remove(static_cast<Eigen::Index>(place));
  const double outflow = current.sum();
  if (!(outflow > 0))  // right for the last seed of its component, to which no other column reaches
    return std::none_of(columns_.begin(), columns_.end(), [&](const Column& column) {
      return network.component.of[column.face] == network.component.of[leaving.face];
    });
  Eigen::VectorXd share = current / outflow;
  const Eigen::VectorXd share_error = (current_error + share * current_error.sum()) / outflow;
  between_seeds_.conductance += current * share.transpose();
  between_seeds_.conductance.diagonal().setZero();
  between_seeds_.error += current_error * share.transpose() + current * share_error.transpose();
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const auto i = static_cast<Eigen::Index>(c);
    if (share[i] == 0) continue;
    columns_[c].error += share[i] * leaving.error + share_error[i];
    if (!(columns_[c].error < accepted_error)) return false;
  }
  change = {Change::Kind::removal, {}, 0, std::move(share), std::move(leaving.potential)};
  return true;
}

/// Makes a change at the faces from `begin` to less than `end`.
inline void Seed_columns::make(const Change& change, std::size_t begin, std::size_t end) {
  if (change.kind == Change::Kind::addition) return make_addition(change, begin, end);
  if (change.kind == Change::Kind::none) return;
  const Instruction_set instructions = best_instruction_set();
  for (std::size_t c = 0; c < columns_.size(); ++c)
    if (const double share = change.share[static_cast<Eigen::Index>(c)]; share != 0)
      subtract_multiple(-share, &change.leaving[begin], end - begin, &columns_[c].potential[begin], instructions);
}

inline void Seed_columns::make_addition(const Change& change, std::size_t begin, std::size_t end) {
  const Instruction_set instructions = best_instruction_set();
  const std::size_t others = columns_.size() - 1, count = end - begin;
  Column& added = columns_.back();
  double* const x = &added.potential[begin];
  for (std::size_t c = 0; c < others; ++c)
    if (const double reaches = change.reaches[static_cast<Eigen::Index>(c)]; reaches != 0)
      subtract_multiple(reaches, &columns_[c].potential[begin], count, x, instructions);
  for (std::size_t i = 0; i < count; ++i) x[i] = std::clamp(x[i] / change.resistance, 0., 1.);
  const auto hold = [&](Index face, std::vector<double>& potential, double value) {  // whatever rounding has made of it
    if (face >= begin && face < end) potential[face] = value;
  };
  for (std::size_t c = 0; c < others; ++c) hold(columns_[c].face, added.potential, 0);
  for (std::size_t c = 0; c < others; ++c) {
    std::vector<double>& potential = columns_[c].potential;
    subtract_multiple(change.share[static_cast<Eigen::Index>(c)], x, count, &potential[begin], instructions);
    hold(added.face, potential, 0);
  }
  hold(added.face, added.potential, 1);
}

}  // namespace RW_segmentation::internal

#endif
