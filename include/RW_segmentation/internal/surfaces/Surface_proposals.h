// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_PROPOSALS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_SURFACE_PROPOSALS_H

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/surfaces/Analytic_regions.h>
#include <RW_segmentation/internal/surfaces/Face_energy.h>
#include <RW_segmentation/internal/surfaces/Face_patches.h>
#include <RW_segmentation/internal/surfaces/Minimum_cut.h>
#include <RW_segmentation/internal/surfaces/Region_borders.h>
#include <RW_segmentation/internal/surfaces/Surface_fit.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/surfaces/Surface_types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Finds surfaces that growing has missed under noise: it takes what explains most, such as a cone that holds a plane and
/// the beginning of a fillet, and leaves too little of the fillet.
///
/// Where regions explain their faces badly, surfaces are fitted to neighbourhoods, across the borders of regions, and to all
/// that is explained badly in one piece. One surface is tried for each two regions that meet, and surfaces of other types for
/// each region: noise that ended a region early leaves one face of the solid in pieces, and few faces tell the wrong type.
/// Each surface takes what it explains better from the regions about it by a minimum cut, an expansion move of Boykov, Veksler
/// and Zabih (2001); all of them are fitted to what they have become, in turns. The surface stays if the energy falls by more
/// than its numbers are worth by the Bayesian information criterion (Schwarz 1978): PEARL of Isack and Boykov (2012), but
/// beginning with regions in place of chance.
///
/// The energies are those of independent noise: smooth noise would be explained by surfaces of its own.
class Surface_proposals {
 public:
  using Index = Dual_mesh::Index;

  /// Keeps references to all.
  Surface_proposals(const Dual_mesh& mesh, const Surface_tolerance& tolerance, Analytic_regions& regions)
      : mesh_(mesh),
        tolerance_(tolerance),
        energy_(mesh, tolerance),
        regions_(regions),
        patches_(mesh, edge_angles(mesh), [&](Index e) { return tolerance.sharp_angle(mesh.graph().faces_of(e)); }),
        signs_(signs_of(mesh, regions)),
        faces_(regions.faces()),
        node_of_face_(mesh.number_of_faces(), no_node) {
    for (Index e = 0; e < mesh.number_of_edges(); ++e) {
      const auto [f, g] = mesh.graph().faces_of(e);
      border_energy_.push_back(energy_.of_border(f, g, e));
    }
    for (Index f = 0; f < mesh.number_of_faces(); ++f) {
      const std::size_t region = regions.region_of_face[f];
      own_energy_.push_back(region == none ? Face_energy::unexplained
                                           : energy_(regions.surfaces[region], signs_[region], f));
    }
  }

  /// Tries a surface about each face that is explained badly, once.
  /// \returns whether one stayed
  bool try_about_faces(const Progress& progress) {
    // From one that stays to the next. Free forms have no end of faces explained badly: with no limit, and with surfaces that
    // explain their own faces badly until they are fitted again, a CAD solid of free forms takes 15 times the time, and
    // the Rand error of made solids under noise of .3 %, two seeds, is .022 in place of .023.
    constexpr int most_failures = 50;
    constexpr int rings = 4, narrow_rings = 1;
    const std::vector<double> badness = mean_energies(rings);
    narrow_badness_ = mean_energies(narrow_rings);
    std::vector<Index> order(mesh_.number_of_faces());
    std::iota(order.begin(), order.end(), Index(0));
    std::stable_sort(order.begin(), order.end(), [&](Index f, Index g) { return badness[f] > badness[g]; });
    std::vector<char> is_done(mesh_.number_of_faces(), false);
    bool has_stayed = false;
    int failures = 0;  // since one stayed
    for (const Index seed : order) {
      if (badness[seed] < explained || failures > most_failures) break;
      if (is_done[seed] || regions_.region_of_face[seed] == none) continue;
      progress(1);
      for (const Index f : patches_.neighbourhood(seed, start_sizes.front()).faces) is_done[f] = true;
      const std::vector<Index> taken = taken_about(seed);
      for (const Index f : taken) is_done[f] = true;
      has_stayed |= !taken.empty();
      failures = taken.empty() ? failures + 1 : 0;
    }
    return has_stayed;
  }

  /// Tries one surface for each two regions that meet and other types for each region, and again for those that come of it.
  /// Without it .944 of the faces of made solids are matched at .9 under noise of .1 %, in place of .951 (four seeds).
  /// \returns whether one stayed
  bool try_for_regions(const Progress& progress) {
    constexpr int most_rounds = 4;
    bool has_stayed = false;
    std::set<Pair> pairs = pairs_of_regions();
    for (int round = 0; round < most_rounds && !pairs.empty(); ++round) {
      const std::size_t first_fresh = regions_.surfaces.size();
      for (const Pair& pair : pairs) {
        progress(1);
        has_stayed |= is_replaced(pair);
      }
      pairs.clear();
      for (const Pair& pair : pairs_of_regions())
        if (pair[1] >= first_fresh) pairs.insert(pair);
    }
    return has_stayed;
  }

 private:
  using Patch = Face_patches::Patch;
  using Pair = std::array<std::size_t, 2>;  // of regions that meet, in ascending order, or twice the same one

  static constexpr std::size_t none = Analytic_regions::none, no_node = none;
  static constexpr std::array<std::size_t, 3> start_sizes = {18, 54, 162};  // vertices, those of `Surface_growing`
  static constexpr std::size_t fewest_vertices = 12;                        // that a surface is fitted to
  /// Mean energy, in nats, of faces on their surface: a little more than the half that noise is expected to make.
  static constexpr double explained = 0.7;

  /// A surface as it is in a trial.
  struct Oriented_surface {
    Analytic_surface surface;
    double sign;
  };

  struct Proposal {
    double gain;
    Oriented_surface fitted;
    std::vector<Index> faces;  // that it was fitted to
  };

  /// What a face and so many rings about it cost where they are, on average.
  std::vector<double> mean_energies(int rings) const {
    std::vector<double> mean, next(mesh_.number_of_faces());
    mean.reserve(mesh_.number_of_faces());
    for (Index f = 0; f < mesh_.number_of_faces(); ++f)
      mean.push_back(regions_.region_of_face[f] == none ? 0 : own_energy_[f]);
    for (int ring = 0; ring < rings; ++ring, mean.swap(next))
      for (Index f = 0; f < mesh_.number_of_faces(); ++f) {
        double sum = 2 * mean[f], weight = 2;
        for (const auto& [g, e] : mesh_.graph().neighbours(f)) {
          sum += mean[g];
          ++weight;
        }
        next[f] = sum / weight;
      }
    return mean;
  }

  /// What the numbers of a surface of so many faces are worth, in nats.
  static double worth(Surface_type type, std::size_t faces) {
    return degrees_of_freedom(type) / 2. * std::log(static_cast<double>(std::max<std::size_t>(faces, 2)));
  }

  /// What surfaces about a face are fitted to: neighbourhoods, and the faces about it that are explained badly.
  std::vector<Patch> patches_about(Index seed) {
    // Of these faces. Without them overlap .879 in place of .885 under noise as in `Surface_growing::passes()`.
    constexpr std::size_t most_vertices = 400;
    std::vector<Patch> patches;
    for (const std::size_t size : start_sizes) {
      Patch patch = patches_.neighbourhood(seed, size);
      if (patch.vertices.size() < size) break;
      patches.push_back(std::move(patch));
    }
    const auto is_bad = [&](Index f) { return narrow_badness_[f] >= explained && regions_.region_of_face[f] != none; };
    Patch badly_explained;
    patches_.flood(seed, is_bad, most_vertices, badly_explained);
    if (badly_explained.vertices.size() >= fewest_vertices) patches.push_back(std::move(badly_explained));
    return patches;
  }

  /// Appends the surfaces of all types that fit to a patch and gain more than so many nats if borders are left aside.
  void add_proposals(const Patch& patch, double least_gain, std::vector<Proposal>& proposals) {
    constexpr std::size_t least_surplus = 12;  // vertices, as in `Surface_growing`
    constexpr double largest_residual = 1.5;   // deviations
    const Surface_fit fit(patches_.samples_of(patch), largest_residual * tolerance_.distance);
    for (const Surface_type type : analytic_types) {
      if (patch.vertices.size() < static_cast<std::size_t>(degrees_of_freedom(type)) + least_surplus) continue;
      const auto surface = fit.fit(type);
      if (!surface) continue;
      const double sign = sign_of(*surface, patch.faces);
      double gain = -worth(type, patch.faces.size());
      for (const Index f : patch.faces) gain += own_energy_[f] - energy_(*surface, sign, f);
      if (gain > least_gain) proposals.push_back({gain, {*surface, sign}, patch.faces});
    }
  }

  /// The faces that the first surface about a face takes that is worth it.
  std::vector<Index> taken_about(Index seed) {
    constexpr std::size_t most_tried = 2;  // those that gain most
    std::vector<Proposal> proposals;
    for (const Patch& patch : patches_about(seed)) add_proposals(patch, 0, proposals);
    std::stable_sort(proposals.begin(), proposals.end(),
                     [](const Proposal& a, const Proposal& b) { return a.gain > b.gain; });
    std::vector<Index> taken;
    for (std::size_t i = 0; i < std::min(most_tried, proposals.size()) && taken.empty(); ++i)
      taken = taken_by(proposals[i]);
    return taken;
  }

  /// The regions that there are, alone and with each of those that they meet.
  std::set<Pair> pairs_of_regions() const {
    std::set<Pair> pairs;
    for (Index f = 0; f < mesh_.number_of_faces(); ++f) {
      const std::size_t region = regions_.region_of_face[f];
      if (region == none) continue;
      pairs.insert({region, region});
      for (const auto& [g, e] : mesh_.graph().neighbours(f))
        if (const std::size_t other = regions_.region_of_face[g]; region < other && other != none && !mesh_.is_wall(e))
          pairs.insert({region, other});
    }
    return pairs;
  }

  /// Whether one surface has taken the place of two regions, or one of another type that of one. There is no cut: where the
  /// border is, `Region_borders` tells.
  bool is_replaced(const Pair& pair) {
    const std::size_t a = pair[0], b = pair[1];
    if (faces_[a].empty() || faces_[b].empty()) return false;  // replaced since
    std::vector<Index> faces;
    std::set_union(faces_[a].begin(), faces_[a].end(), faces_[b].begin(), faces_[b].end(), std::back_inserter(faces));
    std::vector<Proposal> proposals;
    add_proposals(patches_.of(faces), -std::numeric_limits<double>::infinity(), proposals);
    const auto is_there = [&](const Proposal& p) {
      return a == b && p.fitted.surface.type == regions_.surfaces[a].type;
    };
    proposals.erase(std::remove_if(proposals.begin(), proposals.end(), is_there), proposals.end());
    if (proposals.empty()) return false;
    const auto best = std::max_element(proposals.begin(), proposals.end(),
                                       [](const Proposal& p, const Proposal& q) { return p.gain < q.gain; });
    Trial trial = {std::move(faces), best->fitted, {}, {}};
    for (const std::size_t region : pair) {
      trial.losers[region] = {regions_.surfaces[region], signs_[region]};
      trial.left[region] = {};
    }
    if (explains_badly(trial) || !(gain_of(trial) > 0)) return false;
    accept(trial);
    return true;
  }

  /// What a proposal takes from each region, and the surfaces that the regions have then.
  struct Trial {
    std::vector<Index> taken;
    Oriented_surface fresh;
    std::map<std::size_t, Oriented_surface> losers;
    std::map<std::size_t, std::vector<Index>> left;  // the faces of these
  };

  /// Lets a proposal take faces, if it is worth it.
  /// \returns the faces
  std::vector<Index> taken_by(const Proposal& proposal) {
    constexpr int rounds = 3;
    Trial trial = {{}, proposal.fitted, {}, {}};
    std::vector<Index> from = proposal.faces;
    for (int round = 0; round < rounds; ++round) {
      std::vector<Index> taken = expansion(trial, from);
      if (taken.size() < fewest_vertices) return {};
      std::sort(taken.begin(), taken.end());
      if (taken == trial.taken) break;
      trial.taken = from = std::move(taken);
      if (explains_badly(trial)) return {};
      fit_again(trial);
    }
    if (explains_badly(trial) || !(gain_of(trial) > 0)) return {};
    accept(trial);
    return trial.taken;
  }

  /// Whether the new surface is not on its faces either: pieces of a free form replace each other without end.
  bool explains_badly(const Trial& trial) const {
    double sum = 0;
    for (const Index f : trial.taken) sum += energy_(trial.fresh.surface, trial.fresh.sign, f);
    return sum > explained * static_cast<double>(trial.taken.size());
  }

  /// Fits the surfaces of a trial to the faces that they have.
  void fit_again(Trial& trial) {
    trial.left.clear();
    for (const Index f : trial.taken)
      if (const std::size_t region = regions_.region_of_face[f]; region != none) trial.left[region];
    trial.losers.clear();
    for (auto& [region, left] : trial.left) {
      std::set_difference(faces_[region].begin(), faces_[region].end(), trial.taken.begin(), trial.taken.end(),
                          std::back_inserter(left));
      trial.losers[region] = fitted_to({regions_.surfaces[region], signs_[region]}, left);
    }
    trial.fresh = fitted_to(trial.fresh, trial.taken);
  }

  Oriented_surface fitted_to(const Oriented_surface& surface, const std::vector<Index>& faces) {
    const Patch patch = patches_.of(faces);
    if (patch.vertices.size() < fewest_vertices) return surface;
    const auto fitted = fitted_again(surface.surface, patches_.samples_of(patch));
    return fitted ? Oriented_surface{*fitted, sign_of(*fitted, faces)} : surface;
  }

  double sign_of(const Analytic_surface& surface, const std::vector<Index>& faces) const {
    return with_type_of(surface, [&](const auto& s) {
      double sum = 0;
      for (const Index f : faces) sum += mesh_.area(f) * s.normal(mesh_.centroid(f)).dot(mesh_.shape_normal(f));
      return sum < 0 ? -1. : 1.;
    });
  }

  /// By how much the energy falls beyond what the new surface is worth.
  double gain_of(const Trial& trial) {
    double gain = -worth(trial.fresh.surface.type, trial.taken.size());
    for (const Index f : trial.taken) {
      gain += own_energy_[f] - energy_(trial.fresh.surface, trial.fresh.sign, f);
      node_of_face_[f] = 0;
    }
    for (const Index f : trial.taken)
      for (const auto& [g, e] : mesh_.graph().neighbours(f)) {
        const bool is_inside = node_of_face_[g] != no_node, was_border = is_border(f, g);
        if (is_inside && g < f) continue;
        if (is_inside == was_border) gain += (was_border ? 1 : -1) * border_energy_[e];
      }
    for (const Index f : trial.taken) node_of_face_[f] = no_node;
    for (const auto& [region, left] : trial.left) {
      const Oriented_surface& surface = trial.losers.at(region);
      if (left.empty()) gain += worth(surface.surface.type, faces_[region].size());
      for (const Index f : left) gain += own_energy_[f] - energy_(surface.surface, surface.sign, f);
    }
    return gain;
  }

  bool is_border(Index f, Index g) const { return regions_.region_of_face[f] != regions_.region_of_face[g]; }

  void accept(const Trial& trial) {
    const std::size_t fresh = regions_.surfaces.size();
    regions_.surfaces.emplace_back();
    signs_.push_back(1);
    faces_.emplace_back();
    for (const auto& [region, left] : trial.left) set_region(region, trial.losers.at(region), left);
    set_region(fresh, trial.fresh, trial.taken);
  }

  void set_region(std::size_t region, const Oriented_surface& surface, const std::vector<Index>& faces) {
    regions_.surfaces[region] = surface.surface;
    signs_[region] = surface.sign;
    faces_[region] = faces;
    for (const Index f : faces) {
      regions_.region_of_face[f] = region;
      own_energy_[f] = energy_(surface.surface, surface.sign, f);
    }
  }

  double energy_in_region(const Trial& trial, Index f) const {
    const auto loser = trial.losers.find(regions_.region_of_face[f]);
    return loser == trial.losers.end() ? own_energy_[f] : energy_(loser->second.surface, loser->second.sign, f);
  }

  /// The largest connected part of the faces that the new surface of a trial gets by a minimum cut between it and what is
  /// there. Faces beyond those that the cut reaches stay where they are.
  /// \param from faces that the cut begins at
  std::vector<Index> expansion(const Trial& trial, const std::vector<Index>& from) {
    // Cuts reach far where noise hides the shape. Without a limit a solid of 2264 slender triangles takes 5 times the time
    // under noise of .3 %; at 2000 the made solids lose .0003 of overlap.
    constexpr std::size_t most_faces = 4000;
    std::vector<Index> faces;
    std::vector<double> stays, moves;  // what each of the faces costs
    const auto add = [&](Index f) {
      if (node_of_face_[f] != no_node) return;
      node_of_face_[f] = faces.size();
      faces.push_back(f);
      stays.push_back(energy_in_region(trial, f));
      moves.push_back(energy_(trial.fresh.surface, trial.fresh.sign, f));
    };
    std::for_each(from.begin(), from.end(), add);
    for (std::size_t i = 0; i < faces.size() && faces.size() < most_faces; ++i) {
      if (moves[i] - stays[i] >= Face_energy::whole_border) continue;  // no border is worth more
      for (const auto& [g, e] : mesh_.graph().neighbours(faces[i]))
        if (!mesh_.is_wall(e)) add(g);
    }
    Minimum_cut cut(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (const auto& [g, e] : mesh_.graph().neighbours(faces[i])) {
        const double cost = border_energy_[e];
        const bool was_border = is_border(faces[i], g);
        if (node_of_face_[g] == no_node) {
          moves[i] += cost;
          if (was_border) stays[i] += cost;
        } else {
          if (was_border) stays[i] += cost / 2;  // a border costs as much if either stays, and nothing if none does
          if (faces[i] < g) cut.set_cost_between(i, node_of_face_[g], was_border ? cost / 2 : cost);
        }
      }
      cut.set_costs(i, stays[i], moves[i]);
    }
    cut.run();
    for (std::size_t i = 0; i < faces.size(); ++i)
      if (!cut.is_on_second(i)) node_of_face_[faces[i]] = no_node;
    return largest_part(faces);
  }

  /// Of faces with a node, which they lose.
  std::vector<Index> largest_part(const std::vector<Index>& faces) {
    std::vector<Index> largest;
    for (const Index first : faces) {
      if (node_of_face_[first] == no_node) continue;
      std::vector<Index> part = {first};
      node_of_face_[first] = no_node;
      for (std::size_t i = 0; i < part.size(); ++i)
        for (const auto& [g, e] : mesh_.graph().neighbours(part[i]))
          if (node_of_face_[g] != no_node && !mesh_.is_wall(e)) {
            node_of_face_[g] = no_node;
            part.push_back(g);
          }
      if (part.size() > largest.size()) largest.swap(part);
    }
    return largest;
  }

  const Dual_mesh& mesh_;
  const Surface_tolerance& tolerance_;
  const Face_energy energy_;
  Analytic_regions& regions_;
  Face_patches patches_;
  std::vector<double> signs_;              // of each region
  std::vector<std::vector<Index>> faces_;  // of each region, in ascending order
  std::vector<double> border_energy_;      // of each edge, should it be one
  std::vector<double> own_energy_;         // of each face where it is
  std::vector<double> narrow_badness_;     // of each face: the mean energy of it and its neighbours, before a run
  std::vector<std::size_t> node_of_face_;  // the number of each face in the present cut
};

}  // namespace RW_segmentation::internal

#endif
