// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_PARTICLE_SAMPLING_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_PARTICLE_SAMPLING_H

#include <RW_segmentation/Particle_sampling.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/seeds/Distances_to_sources.h>
#include <RW_segmentation/internal/seeds/Feature_sensitive_metric.h>

#include <Eigen/Core>

#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace RW_segmentation {

namespace internal {

/// Particles on the faces of a mesh, at the points (x, w n) of six-dimensional space.
///
/// The energy of particle i from particle j at distance r is E_ij = exp(-r^2 / (2 s_i^2)) with a radius of repulsion
/// s_i of its own, which grows or shrinks until the sum of E_ij over all j is 0.8. (The paper's energies are 6 times as
/// large.) A particle moves to neighbouring faces while that lowers the sum of E_ij + E_ji: it goes downhill on the
/// surface itself, so that nothing has to be projected and faces may be polygons of any degree. Its radius tells how
/// much room it has: if larger than the common radius it splits, if much smaller it dies.
class Particles {
 public:
  using Index = Dual_mesh::Index;

  /// Keeps references to its arguments.
  Particles(const Dual_mesh& mesh, const Feature_sensitive_metric& metric)
      : mesh_(mesh), metric_(metric), occupied_(mesh.number_of_faces(), false) {}

  /// A particle that stays where it is for good, or one that moves, splits and dies.
  void add(Index face, bool fixed) {
    particles_.push_back({face, metric_.point(face), 0, fixed});
    occupied_[face] = true;
  }

  /// Lets about `count` movable particles come to rest.
  void settle(std::size_t count, const Progress& progress) {
    constexpr std::size_t most_rounds = 100, rounds_per_generation = 5;
    const std::size_t most = 2 * count;  // thin parts, round which few neighbours repel, would fill up with particles
    choose_radius();
    if (radius_ == 0) return;  // all are in one place
    for (std::size_t round = 1; round <= most_rounds; ++round) {
      progress(static_cast<double>(round) / most_rounds);
      update_tree();
      bool at_rest = true;
      for (std::size_t i = 0; i < particles_.size(); ++i)
        if (!particles_[i].fixed) at_rest = relax(i) && at_rest;
      if (round % rounds_per_generation != 0) continue;
      const double crowd = static_cast<double>(number_of_movable()) / static_cast<double>(count);
      const bool as_many_as_wanted = std::abs(crowd - 1) <= 0.1;
      if (!as_many_as_wanted) radius_ *= std::clamp(std::sqrt(crowd), 0.9, 1.1);
      if (!next_generation(most) && at_rest && as_many_as_wanted) return;
    }
  }

  std::vector<Index> faces_of_movable() const {
    std::vector<Index> faces;
    for (const Particle& p : particles_)
      if (!p.fixed) faces.push_back(p.face);
    return faces;
  }

 private:
  using Point = Feature_sensitive_metric::Point;
  using Tree_point = boost::geometry::model::point<double, 6, boost::geometry::cs::cartesian>;
  using Tree_box = boost::geometry::model::box<Tree_point>;
  using Tree_entry = std::pair<Tree_point, std::size_t>;
  using Tree = boost::geometry::index::rtree<Tree_entry, boost::geometry::index::quadratic<16>>;

  struct Particle {
    Index face;
    Point place;
    double radius;
    bool fixed;
  };

  static constexpr double wanted_energy = 0.8;

  static double energy(double squared_distance, double radius) {
    if (squared_distance == 0) return 1;  // also of particles without a radius, on a mesh without area
    return radius > 0 ? std::exp(-squared_distance / (2 * radius * radius)) : 0;
  }

  static Tree_point tree_point(const Point& p) {
    Tree_point result;
    boost::geometry::set<0>(result, p[0]);
    boost::geometry::set<1>(result, p[1]);
    boost::geometry::set<2>(result, p[2]);
    boost::geometry::set<3>(result, p[3]);
    boost::geometry::set<4>(result, p[4]);
    boost::geometry::set<5>(result, p[5]);
    return result;
  }

  std::size_t number_of_movable() const {
    return static_cast<std::size_t>(
        std::count_if(particles_.begin(), particles_.end(), [](const Particle& p) { return !p.fixed; }));
  }

  void update_tree() {
    std::vector<Tree_entry> entries;
    for (std::size_t i = 0; i < particles_.size(); ++i) entries.emplace_back(tree_point(particles_[i].place), i);
    tree_ = Tree(entries);
  }

  /// Starts from the radius at which the movable particles, as they are, have the wanted energy on average. In the end
  /// their radii lie between those at which particles die and split.
  void choose_radius() {
    constexpr unsigned nearest = 20;
    constexpr double radius_in_the_end = 0.85;
    update_tree();
    std::vector<double> squared_distances;
    for (const Particle& p : particles_) {
      if (p.fixed) continue;
      const auto around = boost::geometry::index::nearest(tree_point(p.place), nearest);
      for (auto entry = tree_.qbegin(around); entry != tree_.qend(); ++entry)
        if (particles_[entry->second].face != p.face)
          squared_distances.push_back((particles_[entry->second].place - p.place).squaredNorm());
    }

    const double wanted = wanted_energy * static_cast<double>(number_of_movable());
    double low = 0, high = 0;
    for (const double d : squared_distances) high = std::max(high, 4 * std::sqrt(d));
    for (int halving = 0; halving < 50; ++halving) {
      const double middle = (low + high) / 2;
      double sum = 0;
      for (const double d : squared_distances) sum += energy(d, middle);
      (sum > wanted ? high : low) = middle;
    }
    for (Particle& p : particles_) p.radius = high;
    radius_ = high / radius_in_the_end;
  }

  /// Finds the particles that matter to one, in the order of their numbers.
  void find_neighbours(std::size_t number) {
    const Point& place = particles_[number].place;
    const Point reach = Point::Constant(4 * radius_);
    const Tree_box box(tree_point(place - reach), tree_point(place + reach));
    neighbours_.clear();
    for (auto entry = tree_.qbegin(boost::geometry::index::intersects(box)); entry != tree_.qend(); ++entry)
      if (entry->second != number) neighbours_.push_back(entry->second);
    std::sort(neighbours_.begin(), neighbours_.end());
  }

  /// The sum of E_ij over the neighbours j and its derivative by the logarithm of the radius.
  std::pair<double, double> own_energy(const Particle& p) const {
    double sum = 0, slope = 0;
    for (const std::size_t j : neighbours_) {
      const double d = (particles_[j].place - p.place).squaredNorm();
      sum += energy(d, p.radius);
      slope += energy(d, p.radius) * d / (p.radius * p.radius);
    }
    return {sum, slope};
  }

  /// The sum of E_ij + E_ji over the neighbours j of a particle at a place.
  double mutual_energy(const Point& place, double radius) const {
    double sum = 0;
    for (const std::size_t j : neighbours_) {
      const double d = (particles_[j].place - place).squaredNorm();
      sum += energy(d, radius) + energy(d, particles_[j].radius);
    }
    return sum;
  }

  /// Moves a particle downhill and adapts its radius. Returns whether it was at rest already.
  bool relax(std::size_t number) {
    Particle& p = particles_[number];
    const Index start = p.face;
    find_neighbours(number);
    while (step_downhill(p)) {
    }

    constexpr double rate = 15 * 0.03, damping = 10. / 6;  // Witkin and Heckbert's rho dt, and beta in our units
    const auto [sum, slope] = own_energy(p);
    const double growth = rate * (wanted_energy - sum) / (slope + damping);
    p.radius = std::clamp(p.radius * std::exp(growth), radius_ / 2, radius_ * 2);
    return p.face == start;
  }

  /// Moves a particle to the free neighbouring face of least energy, if that is less than here.
  bool step_downhill(Particle& p) {
    double least = mutual_energy(p.place, p.radius) * (1 - 1e-9);
    Index best = p.face;
    for (const auto [next, edge] : mesh_.graph().neighbours(p.face)) {
      if (occupied_[next] || mesh_.is_wall(edge)) continue;
      const double there = mutual_energy(metric_.point(next), p.radius);
      if (!(there < least)) continue;
      least = there;
      best = next;
    }
    if (best == p.face) return false;
    occupied_[p.face] = false;
    occupied_[best] = true;
    p.face = best;
    p.place = metric_.point(best);
    return true;
  }

  /// Whether the radius of a movable particle comes before those of its movable neighbours.
  template <class Order>
  bool leads(std::size_t number, const Order& before) const {
    const Particle& p = particles_[number];
    return std::all_of(neighbours_.begin(), neighbours_.end(), [&](std::size_t j) {
      const Particle& q = particles_[j];
      return q.fixed || before(p.radius, q.radius) || (p.radius == q.radius && number < j);
    });
  }

  bool has_room_for_two(const Particle& p) const {
    constexpr double room = 1, too_much_room = 1.5, least_energy = 0.2 * wanted_energy;
    return p.radius > too_much_room * radius_ || (p.radius > room * radius_ && own_energy(p).first > least_energy);
  }

  bool is_crowded(const Particle& p) const { return p.radius < 0.7 * radius_; }

  /// Splits particles, as long as there are no more than so many movable ones, and lets them die, one in a neighbourhood at
  /// a time. Returns whether there were any.
  bool next_generation(std::size_t most) {
    update_tree();
    std::size_t movable = number_of_movable();
    std::vector<Particle> next;
    bool changed = false;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      next.push_back(particles_[i]);
      if (particles_[i].fixed) continue;
      Particle& parent = next.back();
      find_neighbours(i);
      if (is_crowded(parent) && leads(i, std::less<>())) {
        occupied_[parent.face] = false;
        next.pop_back();
        --movable;
        changed = true;
      } else if (movable < most && has_room_for_two(parent) && leads(i, std::greater<>())) {
        const auto around = mesh_.graph().neighbours(parent.face);
        const auto place = std::find_if(around.begin(), around.end(),
                                        [&](auto n) { return !occupied_[n.face] && !mesh_.is_wall(n.edge); });
        if (place == around.end()) continue;
        parent.radius /= std::sqrt(2.);
        const double radius = parent.radius;
        next.push_back({place->face, metric_.point(place->face), radius, false});
        occupied_[place->face] = true;
        ++movable;
        changed = true;
      }
    }
    particles_ = std::move(next);
    return changed;
  }

  const Dual_mesh& mesh_;
  const Feature_sensitive_metric& metric_;
  std::vector<bool> occupied_;
  std::vector<Particle> particles_;
  double radius_ = 0;  // the common one
  Tree tree_;
  std::vector<std::size_t> neighbours_;
};

}  // namespace internal

RW_SEGMENTATION_INLINE std::vector<Dual_mesh::Index> Particle_sampling::operator()(
    const Dual_mesh& mesh, const std::vector<Dual_mesh::Index>& given, std::size_t count,
    const Progress& progress) const {
  std::vector<Dual_mesh::Index> start = start_(mesh, given, count, progress.part(0, 0.1));
  if (start.size() + given.size() < 2) return start;
  const internal::Feature_sensitive_metric metric(mesh, normal_weight());
  internal::Particles particles(mesh, metric);
  for (const auto face : given) particles.add(face, true);
  for (const auto face : start) particles.add(face, false);
  particles.settle(count, progress.part(0.1, 1));

  std::vector<Dual_mesh::Index> seeds = particles.faces_of_movable();
  internal::Distances_to_sources distance(mesh.graph(), metric.edge_lengths());
  for (const auto face : given) distance.add_source(face);
  for (const auto face : seeds) distance.add_source(face);
  const auto out_of_reach = internal::reach_all_components(distance);  // where the last particle died
  seeds.insert(seeds.end(), out_of_reach.begin(), out_of_reach.end());
  return seeds;
}

}  // namespace RW_segmentation

#endif
