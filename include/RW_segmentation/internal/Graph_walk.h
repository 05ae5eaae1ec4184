#ifndef RW_SEGMENTATION_INTERNAL_GRAPH_WALK_H
#define RW_SEGMENTATION_INTERNAL_GRAPH_WALK_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Potentials.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/Star_mesh_elimination.h>
#include <RW_segmentation/internal/front_kernels.h>
#include <RW_segmentation/internal/parallel_for.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace RW_segmentation {

/// What a walk met that is odd but not wrong, and what it did.
struct Walk_report {
  std::size_t unseeded_components = 0;  ///< parts that no seed can reach, each a segment of its own
  std::size_t island_faces = 0;         ///< faces moved because their label's region was cut off from its seeds
  std::size_t factorisations = 0;       ///< since the walk was made
  std::size_t columns_added = 0;        ///< edits answered by one column instead of a factorisation
};

namespace internal {

/// Connected components of a graph over edges that conduct.
struct Components {
  std::vector<Dual_graph::Index> of;  ///< by face, numbered in the order of their first faces
  std::size_t count = 0;
};

inline Components components(const Dual_graph& graph, const std::vector<double>& conductances) {
  using Index = Dual_graph::Index;
  constexpr Index none = std::numeric_limits<Index>::max();
  Components result;
  result.of.assign(graph.number_of_faces(), none);
  std::vector<Index> open;
  for (std::size_t f = 0; f < graph.number_of_faces(); ++f) {
    if (result.of[f] != none) continue;
    const auto component = static_cast<Index>(result.count++);
    result.of[f] = component;
    open.push_back(static_cast<Index>(f));
    while (!open.empty()) {
      const Index face = open.back();
      open.pop_back();
      for (const auto& [next, edge] : graph.neighbours(face))
        if (result.of[next] == none && conductances[edge] > 0) {
          result.of[next] = component;
          open.push_back(next);
        }
    }
  }
  return result;
}

/// The walk on a dual graph: seeds in, labels and potentials out, edited seeds answered by single columns.
///
/// Two ways lead to the labels. *Directly*: factorise with the seeds absorbing, solve for blocks of labels, keep the
/// largest potential of each face only. *By columns*, once seeds are edited: a column of potentials for each seed face
/// is kept (8 bytes x faces x seed faces) and brought up to date:
/// - Adding s takes Green's function of s from the factor and takes out what reaches the present seeds j,
///   x_s ~ g_s - sum_j g_s(s_j) x_j, then x_j -= x_j(s) x_s.
/// - Removing s needs no solve: x_j += x_s c_sj / sum_i c_si. The conductances c that are left between the seeds when all
///   other faces are eliminated follow the edits by star-mesh transforms and their reverse. (Summing the currents round
///   s would give the same, but magnify rounding where s is joined to its neighbours much better than to other seeds.)
/// - The factor still absorbs at those seeds that it was made with and that are seeds no more, the released ones. There
///   it is given the values at which no current stays: between them a network of a few nodes is left, whose
///   conductances are the currents of the first columns.
/// Only the subtractions of an addition lose digits. The loss is estimated and passed on from edit to edit, and a
/// factorisation made anew when it nears the promised accuracy.
template <class Solver = Star_mesh_elimination>
class Graph_walk {
 public:
  using Index = Dual_graph::Index;
  using Label = std::size_t;
  struct Seed {
    Index face;
    Label label;
  };

  static constexpr std::size_t largest_edit = 8;   ///< seed faces changed at once; more are solved directly
  static constexpr std::size_t most_columns = 64;  ///< seed faces; more are solved directly
  static constexpr std::size_t chunk = 4096;       ///< faces whose potentials are worked on together
  static constexpr double accepted_error = 1e-9;   ///< absolute, of potentials after edits

  /// Keeps a reference to the graph. Conductances are finite and >= 0.
  Graph_walk(const Dual_graph& graph, std::vector<double> conductances, Solver solver = Solver(),
             Progress progress = {})
      : graph_(&graph),
        conductances_(std::move(conductances)),
        solver_(std::move(solver)),
        progress_(std::move(progress)) {
    normalise_conductances();
    components_ = components(graph, conductances_);
  }

  /// Takes a solver that has analysed the graph; before the first solve.
  void use_analysed(Solver solver) {
    solver_ = std::move(solver);
    analysed_ = true;
  }

  /// A face that is a seed already takes the new label.
  void add_seed(Index face, Label label) {
    if (label == std::numeric_limits<Label>::max())
      throw std::invalid_argument("label " + std::to_string(label) + " is too large");
    // Whatever needs memory comes first. A label that is doubted for nothing does no harm.
    doubtful_labels_.push_back(label);
    if (const auto known = label_of_.find(face); known != label_of_.end()) {
      doubtful_labels_.push_back(known->second);
      known->second = find(face)->label = label;
    } else {
      if (seeds_.size() == seeds_.capacity()) seeds_.reserve(2 * seeds_.size() + 1);
      label_of_.emplace(face, label);
      seeds_.push_back({face, label});
    }
    solved_ = false;
  }

  bool remove_seed(Index face) {
    if (!is_seed(face)) return false;
    doubtful_labels_.push_back(label_of_[face]);
    label_of_.erase(face);
    seeds_.erase(find(face));
    solved_ = false;
    return true;
  }

  void clear_seeds() {
    for (const Seed& seed : seeds_) doubtful_labels_.push_back(seed.label);
    seeds_.clear();
    label_of_.clear();
    solved_ = false;
  }

  /// In the order in which they were added.
  const std::vector<Seed>& seeds() const { return seeds_; }
  bool is_seed(Index face) const { return label_of_.count(face) > 0; }
  std::optional<Label> label_of_seed(Index face) const {
    const auto found = label_of_.find(face);
    return found == label_of_.end() ? std::nullopt : std::optional<Label>(found->second);
  }

  /// The label of each face; where nothing but other labels' faces joins it to its seeds, that of the best supported
  /// neighbour. Components without a seed get the labels after the largest one.
  /// \throws std::invalid_argument if there is no seed, unless there is no face either
  const std::vector<Label>& labels() {
    solve();
    return settled_;
  }

  /// The label of the largest potential of each face, islands left where they are.
  std::vector<Label> raw_labels() {
    solve();
    std::vector<Label> raw(rank_.size());
    for (std::size_t f = 0; f < raw.size(); ++f) raw[f] = labels_[rank_[f]];
    return raw;
  }

  /// The potential of a label at all faces: 0 where no seed reaches.
  std::vector<double> potential(Label label) {
    solve();
    std::vector<double> sum(graph_->number_of_faces(), 0.);
    if (number_of_labels_ <= 1) {
      const std::vector<char> seeded = seeded_components();
      for (std::size_t f = 0; f < sum.size(); ++f) sum[f] = label == labels_.front() && seeded[components_.of[f]];
      return sum;
    }
    if (has_columns_) {
      for (const Column& column : columns_)
        if (label_of_.at(column.face) == label)
          for (std::size_t f = 0; f < sum.size(); ++f) sum[f] += column.potential[f];
    } else {
      Potentials boundary(static_cast<Eigen::Index>(base_.size()), 1), result;
      for (std::size_t r = 0; r < base_.size(); ++r)
        boundary(static_cast<Eigen::Index>(r), 0) = label_of_.at(base_[r]) == label;
      solver_.potentials(boundary, result);
      std::copy_n(result.data(), sum.size(), sum.begin());
    }
    for (double& p : sum) p = std::min(p, 1.);
    return sum;
  }

  /// The potential of a label at one face. The first call after an edit solves for all faces.
  double potential(Index face, Label label) {
    solve();
    auto known = known_potentials_.find(label);
    if (known == known_potentials_.end()) known = known_potentials_.emplace(label, potential(label)).first;
    return known->second[face];
  }

  const Walk_report& report() const { return report_; }

 private:
  /// The potentials of one seed face, the others being at 0.
  struct Column {
    Index face;
    std::vector<double> potential;
    double error;  // absolute, an estimate of what edits have cost; fresh columns are right to a relative error
  };
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

  typename std::vector<Seed>::iterator find(Index face) {
    return std::find_if(seeds_.begin(), seeds_.end(), [&](const Seed& seed) { return seed.face == face; });
  }

  /// Potentials depend on ratios only: the largest conductance becomes about 1, exactly, by a power of two.
  void normalise_conductances() {
    double largest = 0;
    for (const double c : conductances_) largest = std::max(largest, c);
    if (!(largest > 0)) return;
    const int exponent = std::ilogb(largest);
    parallel_stretches(conductances_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e) conductances_[e] = std::scalbn(conductances_[e], -exponent);
    });
  }

  std::vector<char> seeded_components() const {
    std::vector<char> seeded(components_.count, 0);
    for (const Seed& seed : seeds_) seeded[components_.of[seed.face]] = 1;
    return seeded;
  }

  void solve();
  void factorise();
  bool label_by_columns();
  bool update_columns();
  void fill_columns();
  std::vector<double> base_values(std::vector<double> current) const;
  std::vector<double> source_function(Index s);
  bool add_column(Index s);
  bool remove_column(std::size_t place);
  void label_directly();
  bool label_from_columns();
  void label_unseeded_components();
  std::vector<char> labels_as_before(const std::vector<Index>& rank_before,
                                     const std::vector<Label>& labels_before) const;
  void settle_islands(const std::vector<char>& is_connected);

  /// Sets the labels in use, ascending, each once.
  void collect_labels() {
    labels_.clear();
    for (const Seed& seed : seeds_) labels_.push_back(seed.label);
    std::sort(labels_.begin(), labels_.end());
    labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
    number_of_labels_ = labels_.size();
  }

  /// The place of a seed's label among the labels in use.
  std::size_t rank_of_seed(Index face) const {
    return static_cast<std::size_t>(std::lower_bound(labels_.begin(), labels_.end(), label_of_.at(face)) -
                                    labels_.begin());
  }

  /// Calls `work(begin, end)` for stretches of faces, for several at the same time where there are threads.
  template <class Work>
  void for_stretches(const Work& work) const {
    parallel_stretches(graph_->number_of_faces(), work, chunk);
  }

  bool has_column(Index face) const {
    return std::any_of(columns_.begin(), columns_.end(), [&](const Column& column) { return column.face == face; });
  }

  /// The current into `face`, which is at 0, when the others are at the given potentials.
  double current_into(Index face, const std::vector<double>& potential) const {
    double current = 0;
    for (const auto& [next, edge] : graph_->neighbours(face)) current += conductances_[edge] * potential[next];
    return current;
  }

  const Dual_graph* graph_;
  std::vector<double> conductances_;
  Solver solver_;
  Progress progress_;
  Components components_;
  std::vector<Seed> seeds_;
  std::unordered_map<Index, Label> label_of_;

  std::vector<Label> doubtful_labels_;  // those of islands, and those whose seeds have changed since the last solve
  bool comparable_ = false;             // the last solve came to its end
  bool analysed_ = false, factorised_ = false, has_columns_ = false, solved_ = false;
  std::vector<Index> base_;            // the seeds that the factor absorbs at
  std::vector<Column> columns_;        // where `has_columns_`: one for each seed face as of the last solve
  Eigen::MatrixXd base_conductances_;  // between the seeds of base_; where `has_columns_`
  Between_seeds between_seeds_;        // as are these
  std::map<Label, std::vector<double>> known_potentials_;
  std::vector<Label> labels_;         // in use, ascending; those of components without a seed behind them
  std::size_t number_of_labels_ = 0;  // in use
  std::vector<Index> rank_;           // by face: place in labels_ of the label with the largest potential
  std::vector<double> largest_;       // by face: that potential
  std::vector<Label> settled_;        // by face: the label in the end
  Walk_report report_;
};

// -------------------------------------------------------------------------------------------------------------------

template <class Solver>
void Graph_walk<Solver>::solve() {
  if (graph_->number_of_faces() == 0) return;
  if (seeds_.empty()) throw std::invalid_argument("no seeds");
  if (solved_) return;
  known_potentials_.clear();
  const bool comparable = std::exchange(comparable_, false);  // first: what follows may fail half-way
  const std::vector<Index> rank_before = std::move(rank_);
  const std::vector<Label> labels_before = labels_;
  collect_labels();
  rank_.assign(graph_->number_of_faces(), 0);
  largest_.assign(graph_->number_of_faces(), 1.);
  // A single label needs no solve; what is known of earlier seeds stays for later ones.
  if (number_of_labels_ > 1 && !label_by_columns()) label_directly();
  label_unseeded_components();
  const std::vector<char> connected =
      comparable ? labels_as_before(rank_before, labels_before) : std::vector<char>(labels_.size(), 0);
  doubtful_labels_.clear();
  settle_islands(connected);
  comparable_ = solved_ = true;
  progress_(1);
}

/// Answers edits. False where that is impossible, inaccurate or not worth it.
template <class Solver>
bool Graph_walk<Solver>::label_by_columns() {
  try {
    return update_columns() && label_from_columns();
  } catch (...) {  // some columns may know of an edit that others do not
    has_columns_ = false;
    throw;
  }
}

/// Which labels have the same faces and the same seeds as before, when all their faces were joined to the seeds.
template <class Solver>
std::vector<char> Graph_walk<Solver>::labels_as_before(const std::vector<Index>& rank_before,
                                                       const std::vector<Label>& labels_before) const {
  constexpr Index none = std::numeric_limits<Index>::max();
  const auto place = [&](Label label) {
    const auto end = labels_.begin() + static_cast<std::ptrdiff_t>(number_of_labels_);
    const auto found = std::lower_bound(labels_.begin(), end, label);
    return found != end && *found == label ? static_cast<Index>(found - labels_.begin()) : none;
  };
  std::vector<Index> rank_now(labels_before.size());
  for (std::size_t l = 0; l < labels_before.size(); ++l) rank_now[l] = place(labels_before[l]);
  std::vector<char> same(labels_.size(), 1);
  for (std::size_t f = 0; f < rank_.size(); ++f) {
    const Index was = rank_now[rank_before[f]];
    if (was == rank_[f]) continue;
    same[rank_[f]] = 0;
    if (was != none) same[was] = 0;
  }
  for (const Label label : doubtful_labels_)
    if (const Index rank = place(label); rank != none) same[rank] = 0;
  return same;
}

template <class Solver>
void Graph_walk<Solver>::factorise() {
  factorised_ = false;
  if (!analysed_) {
    solver_.analyze(*graph_);
    analysed_ = true;
    progress_(0.3);
  }
  base_.clear();
  for (const Seed& seed : seeds_) base_.push_back(seed.face);
  solver_.factorize(conductances_, base_, progress_.part(0.3, 0.7));
  factorised_ = true;
  ++report_.factorisations;
}

/// Brings the columns to the present seeds. False where that is impossible, inaccurate or not worth it.
template <class Solver>
bool Graph_walk<Solver>::update_columns() {
  if (!factorised_ || seeds_.size() > most_columns) return false;
  std::vector<Index> present = base_, added;
  if (has_columns_) {
    present.clear();
    for (const Column& column : columns_) present.push_back(column.face);
  }
  for (const Seed& seed : seeds_)
    if (std::find(present.begin(), present.end(), seed.face) == present.end()) added.push_back(seed.face);
  const std::size_t removals = present.size() + added.size() - seeds_.size();
  if (added.size() + removals > largest_edit || present.size() > most_columns) return false;
  if (!has_columns_) {
    if (added.size() + removals == 0) return false;
    fill_columns();
  }
  // Additions first: a removal must leave a seed behind.
  for (const Index face : added)
    if (!add_column(face)) return false;
  for (std::size_t place = columns_.size(); place-- > 0;)
    if (!is_seed(columns_[place].face) && !remove_column(place)) return false;
  return true;
}

template <class Solver>
void Graph_walk<Solver>::fill_columns() {
  const auto count = static_cast<Eigen::Index>(base_.size());
  columns_.clear();
  constexpr Eigen::Index block = 8;
  for (Eigen::Index first = 0; first < count; first += block) {
    const Eigen::Index width = std::min(block, count - first);
    Potentials boundary = Potentials::Zero(count, width), result;
    boundary.middleRows(first, width).setIdentity();
    solver_.potentials(boundary, result);
    for (Eigen::Index l = 0; l < width; ++l) {
      columns_.push_back({base_[static_cast<std::size_t>(first + l)], {}, 0});
      columns_.back().potential.resize(graph_->number_of_faces());
    }
    Column* const filled = &columns_.back() + 1 - width;
    for_stretches([&](std::size_t begin, std::size_t end) {
      for (Eigen::Index l = 0; l < width; ++l)
        for (std::size_t f = begin; f < end; ++f) filled[l].potential[f] = result(static_cast<Eigen::Index>(f), l);
    });
  }
  base_conductances_.resize(count, count);
  for (Eigen::Index r = 0; r < count; ++r)
    for (Eigen::Index b = 0; b < count; ++b)
      base_conductances_(r, b) =
          r == b ? 0
                 : current_into(base_[static_cast<std::size_t>(r)], columns_[static_cast<std::size_t>(b)].potential);
  between_seeds_ = {base_conductances_, Eigen::MatrixXd::Zero(count, count)};
  has_columns_ = true;
}

/// The values that the seeds of base_ must be held at in the factor so that, when the given currents enter at them, the
/// seeds that are left are at 0 and nothing stays at the released ones: star-mesh transforms of the latter.
/// Empty where current cannot leave.
template <class Solver>
std::vector<double> Graph_walk<Solver>::base_values(std::vector<double> current) const {
  Eigen::MatrixXd c = base_conductances_;
  std::vector<Eigen::Index> released;
  for (std::size_t r = 0; r < base_.size(); ++r)
    if (!has_column(base_[r])) released.push_back(static_cast<Eigen::Index>(r));
  std::vector<char> eliminated(base_.size(), 0);
  std::vector<double> sum(base_.size(), 0.), value(base_.size(), 0.);
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
    for (std::size_t i = 0; i < base_.size(); ++i) value[row] += c(*k, static_cast<Eigen::Index>(i)) * value[i];
  }
  return value;
}

/// A function that is 0 at the seeds left of those in base_ and whose only other sources are s and later seeds. Empty
/// where there is none: no seed of base_ is left in the component.
template <class Solver>
std::vector<double> Graph_walk<Solver>::source_function(Index s) {
  const auto at = std::find(base_.begin(), base_.end(), s);
  const bool grounded = std::any_of(base_.begin(), base_.end(),
                                    [&](Index b) { return components_.of[b] == components_.of[s] && has_column(b); });
  if (!grounded) return {};
  std::vector<double> h;
  if (at == base_.end()) {
    const std::vector<double> values = base_values(solver_.absorbed_currents(s));
    if (!values.empty()) solver_.response(s, values, h);
    return h;
  }
  // The factor absorbs at s itself: a unit current enters there.
  std::vector<double> current(base_.size(), 0.);
  current[static_cast<std::size_t>(at - base_.begin())] = 1;
  const std::vector<double> values = base_values(current);
  if (values.empty()) return h;
  Potentials result;
  solver_.potentials(Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())),
                     result);
  return {result.data(), result.data() + result.size()};
}

/// A column for s from its Green's function, taken out of the other columns. False where too many digits would be lost.
template <class Solver>
bool Graph_walk<Solver>::add_column(Index s) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  std::vector<double> h = source_function(s);
  if (h.empty()) return false;
  double error = 4 * epsilon * h[s];
  const auto n = static_cast<Eigen::Index>(columns_.size());
  Eigen::VectorXd reaches(n);  // the present seeds; the column of one is 0 at the others
  for (Eigen::Index c = 0; c < n; ++c) {
    const Column& column = columns_[static_cast<std::size_t>(c)];
    reaches[c] = h[column.face];
    error += reaches[c] * column.error;
  }
  for_stretches([&](std::size_t begin, std::size_t end) {
    for (Eigen::Index c = 0; c < n; ++c) {
      if (reaches[c] == 0) continue;
      const double* potential = columns_[static_cast<std::size_t>(c)].potential.data();
      for (std::size_t f = begin; f < end; ++f) h[f] -= reaches[c] * potential[f];
    }
  });
  const double resistance = h[s];  // between s and the seeds
  if (!(resistance > 0 && error < accepted_error * resistance)) return false;
  error /= resistance;

  Eigen::VectorXd share(n), share_error(n);  // what walks from s meet first
  for (Eigen::Index c = 0; c < n; ++c) {
    Column& column = columns_[static_cast<std::size_t>(c)];
    share[c] = column.potential[s];
    share_error[c] = column.error;
    h[column.face] = 0;
    column.error += share[c] * error;
  }
  for_stretches([&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) h[f] = std::clamp(h[f] / resistance, 0., 1.);
    for (Eigen::Index c = 0; c < n; ++c) {
      double* potential = columns_[static_cast<std::size_t>(c)].potential.data();
      for (std::size_t f = begin; f < end; ++f) potential[f] = std::max(0., potential[f] - share[c] * h[f]);
    }
  });
  for (Column& column : columns_) column.potential[s] = 0;
  h[s] = 1;
  columns_.push_back({s, std::move(h), error});

  between_seeds_.error += epsilon * between_seeds_.conductance +
                          (share_error * share.transpose() + share * share_error.transpose()) / resistance;
  between_seeds_.conductance -= share * share.transpose() / resistance;
  between_seeds_.conductance = between_seeds_.conductance.cwiseMax(0);
  between_seeds_.append(share / resistance, share_error / resistance);
  ++report_.columns_added;
  return true;
}

/// Shares the column of a seed among the seeds that walks meet after it. False where too many digits would be lost.
template <class Solver>
bool Graph_walk<Solver>::remove_column(std::size_t place) {
  const Column leaving = std::move(columns_[place]);
  columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(place));
  const auto [current, current_error] = between_seeds_.remove(static_cast<Eigen::Index>(place));
  const double outflow = current.sum();
  if (!(outflow > 0))  // right for the last seed of its component, to which no other column reaches
    return std::none_of(columns_.begin(), columns_.end(), [&](const Column& column) {
      return components_.of[column.face] == components_.of[leaving.face];
    });
  const Eigen::VectorXd share = current / outflow;
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
  for_stretches([&](std::size_t begin, std::size_t end) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const double part = share[static_cast<Eigen::Index>(c)];
      if (part == 0) continue;
      double* potential = columns_[c].potential.data();
      for (std::size_t f = begin; f < end; ++f) potential[f] += part * leaving.potential[f];
    }
  });
  return true;
}

template <class Solver>
void Graph_walk<Solver>::label_directly() {
  // A factor made for the same seeds serves again when only labels have changed.
  const bool same_seeds = factorised_ && base_.size() == seeds_.size() &&
                          std::all_of(base_.begin(), base_.end(), [&](Index face) { return is_seed(face); });
  if (!same_seeds) factorise();
  has_columns_ = false;
  columns_.clear();
  constexpr std::size_t block = 16;
  Potentials boundary, potentials;
  std::fill(largest_.begin(), largest_.end(), -1.);
  for (std::size_t first = 0; first < number_of_labels_; first += block) {
    const std::size_t width = std::min(block, number_of_labels_ - first);
    boundary.setZero(static_cast<Eigen::Index>(base_.size()), static_cast<Eigen::Index>(width));
    for (std::size_t r = 0; r < base_.size(); ++r)
      if (const std::size_t rank = rank_of_seed(base_[r]); rank >= first && rank < first + width)
        boundary(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(rank - first)) = 1;
    solver_.potentials(boundary, potentials);
    for_stretches([&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const double* row = potentials.data() + f * width;
        for (std::size_t l = 0; l < width; ++l)
          if (row[l] > largest_[f]) {
            largest_[f] = row[l];
            rank_[f] = static_cast<Index>(first + l);
          }
      }
    });
    progress_(0.7 + 0.3 * static_cast<double>(first + width) / static_cast<double>(number_of_labels_));
  }
}

/// False if the potentials of some reached face do not add up to 1: digits were lost after all.
template <class Solver>
bool Graph_walk<Solver>::label_from_columns() {
  std::vector<std::vector<const double*>> columns_of(number_of_labels_);
  const std::vector<char> seeded = seeded_components();
  for (const Column& column : columns_) columns_of[rank_of_seed(column.face)].push_back(column.potential.data());
  const Instruction_set instructions = best_instruction_set();
  std::atomic<bool> sums_are_right = true;
  for_stretches([&](std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    std::array<double, chunk> sum, total, best;  // stays in the cache
    std::fill_n(&largest_[begin], count, -1.);
    total.fill(0);
    for (std::size_t l = 0; l < number_of_labels_; ++l) {
      const double* potential = columns_of[l].front() + begin;
      if (columns_of[l].size() > 1) {
        sum.fill(0);
        for (const double* column : columns_of[l])
          for (std::size_t i = 0; i < count; ++i) sum[i] += column[begin + i];
        potential = sum.data();
      }
      select_largest(potential, static_cast<double>(l), count, &largest_[begin], best.data(), total.data(),
                     instructions);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (!seeded[components_.of[begin + i]]) continue;
      if (!(std::abs(total[i] - 1) < 10 * accepted_error)) sums_are_right = false;
      rank_[begin + i] = static_cast<Index>(best[i]);
    }
  });
  return sums_are_right;
}

template <class Solver>
void Graph_walk<Solver>::label_unseeded_components() {
  const std::vector<char> seeded = seeded_components();
  report_.unseeded_components = 0;
  std::vector<Index> rank(components_.count, 0);
  const std::vector<Label> in_use = labels_;
  Label next = labels_.back();
  for (std::size_t c = 0; c < components_.count; ++c) {
    if (seeded[c]) continue;
    // Negative labels of a user are large numbers here, after which it begins again at 0.
    do ++next;
    while (std::binary_search(in_use.begin(), in_use.end(), next));
    rank[c] = static_cast<Index>(labels_.size());
    labels_.push_back(next);
    ++report_.unseeded_components;
  }
  if (report_.unseeded_components == 0) return;
  for (std::size_t f = 0; f < rank_.size(); ++f)
    if (!seeded[components_.of[f]]) rank_[f] = rank[components_.of[f]];
}

/// Faces whose label's region holds no seed of that label go, region by region, to the label of the neighbour with the
/// largest potential along the region's border. Labels that are known to be connected are not searched again.
template <class Solver>
void Graph_walk<Solver>::settle_islands(const std::vector<char>& is_connected) {
  constexpr Index none = std::numeric_limits<Index>::max();
  std::vector<Index> unreached(rank_.size());  // `none` once reached
  for (std::size_t f = 0; f < rank_.size(); ++f) unreached[f] = is_connected[rank_[f]] ? none : rank_[f];
  std::vector<Index> region;
  const auto flood = [&](Index start) {
    const Index rank = std::exchange(unreached[start], none);
    region.assign(1, start);
    for (std::size_t i = 0; i < region.size(); ++i)
      for (const auto& [next, edge] : graph_->neighbours(region[i]))
        if (unreached[next] == rank && conductances_[edge] > 0) {
          unreached[next] = none;
          region.push_back(next);
        }
  };
  for (const Seed& seed : seeds_)
    if (unreached[seed.face] != none) flood(seed.face);

  std::vector<std::vector<Index>> islands;
  report_.island_faces = 0;
  for (std::size_t f = 0; f < rank_.size(); ++f) {
    if (unreached[f] == none || unreached[f] >= number_of_labels_) continue;
    flood(static_cast<Index>(f));
    report_.island_faces += region.size();
    islands.push_back(region);
    doubtful_labels_.push_back(labels_[rank_[f]]);
  }

  std::vector<Index> settled = rank_;
  for (const auto& island : islands)
    for (const Index face : island) settled[face] = none;
  while (!islands.empty()) {  // an island among islands waits for one of them
    std::vector<std::vector<Index>> waiting;
    for (auto& island : islands) {
      double support = -1;
      Index rank = none;
      for (const Index face : island)
        for (const auto& [next, edge] : graph_->neighbours(face))
          if (settled[next] != none && conductances_[edge] > 0 &&
              (largest_[next] > support || (largest_[next] == support && settled[next] < rank))) {
            support = largest_[next];
            rank = settled[next];
          }
      for (const Index face : island) settled[face] = rank;
      if (rank == none) waiting.push_back(std::move(island));
    }
    islands = std::move(waiting);
  }
  settled_.resize(settled.size());
  for (std::size_t f = 0; f < settled.size(); ++f) settled_[f] = labels_[settled[f]];
}

/// The labels of a walk with the given seeds, for use once. Seed faces are all different.
/// \param analysed a solver that has analysed the graph; without it that is done here
template <class Solver = Star_mesh_elimination>
std::vector<std::size_t> walk_labels(const Dual_graph& graph, std::vector<double> conductances,
                                     const std::vector<Dual_graph::Index>& seed_faces,
                                     const std::vector<std::size_t>& seed_labels, const Progress& progress = {},
                                     Walk_report* report = nullptr, std::optional<Solver> analysed = std::nullopt) {
  Graph_walk<Solver> walk(graph, std::move(conductances), Solver(), progress);
  if (analysed) walk.use_analysed(std::move(*analysed));
  for (std::size_t s = 0; s < seed_faces.size(); ++s) walk.add_seed(seed_faces[s], seed_labels[s]);
  std::vector<std::size_t> labels = walk.labels();
  if (report) *report = walk.report();
  return labels;
}

}  // namespace internal
}  // namespace RW_segmentation

#endif
