#ifndef RW_SEGMENTATION_INTERNAL_REGION_FRAGMENTS_H
#define RW_SEGMENTATION_INTERNAL_REGION_FRAGMENTS_H

#include <RW_segmentation/Dual_graph.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/Face_corners.h>
#include <RW_segmentation/internal/Face_geometry.h>
#include <RW_segmentation/internal/Graph_walk.h>
#include <RW_segmentation/internal/Surface_growing.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Makes fragments of the regions that `Surface_growing` found and of the faces that no surface explains: these form
/// groups that are fragments themselves, or, where a group is too small to be a face of the solid and continues a
/// region smoothly, are given to the regions by a random walk from these. Triangles that turn sharply against each
/// other, as on coarse fillets and holes, are one group where they touch. A group with long creases inside, which end in
/// it, is cut along them: walks from either side share it out.
class Region_fragments {
 public:
  using Index = Dual_graph::Index;

  Region_fragments(const Dual_graph& graph, const Face_geometry& geometry, const Face_corners& corners,
                   const Surface_tolerance& tolerance, const std::vector<double>& angles,
                   const std::vector<double>& conductances)
      : graph_(graph),
        geometry_(geometry),
        corners_(corners),
        tolerance_(tolerance),
        angles_(angles),
        conductances_(conductances) {}

  /// \param region_of_face `Surface_growing::none` for the faces of no region
  /// \returns the fragment of each face, numbered from 0
  std::vector<std::size_t> fragments(const std::vector<std::size_t>& region_of_face, const Progress& progress) {
    fragment_of_face_.assign(graph_.number_of_faces(), none);
    for (Index f = 0; f < graph_.number_of_faces(); ++f)
      if (fragment_of_face_[f] == none && region_of_face[f] != none)
        collect(f, [&](Index from, Index to, Index) { return region_of_face[from] == region_of_face[to]; });
    constexpr double widest_angle = 90 * degrees;  // the faces of a tetrahedron stay apart
    const std::vector<char> is_lone = lone_faces(region_of_face);
    std::vector<Index> unexplained;
    for (Index f = 0; f < graph_.number_of_faces(); ++f) {
      if (fragment_of_face_[f] != none) continue;
      const std::vector<Index> group = collect(f, [&](Index from, Index to, Index edge) {
        return region_of_face[to] == none &&
               (is_smooth(edge) || (is_lone[from] && is_lone[to] && angles_[edge] < widest_angle));
      });
      if (continues_a_region(group, region_of_face))
        unexplained.insert(unexplained.end(), group.begin(), group.end());
      else if (tolerance_.noise == 0) {  // which would make creases of its own
        const double done = 0.5 * static_cast<double>(f) / static_cast<double>(graph_.number_of_faces());
        cut_along_creases(group, progress.part(done, done));
      }
    }
    is_given_.assign(graph_.number_of_faces(), false);
    for (const Index f : unexplained) is_given_[f] = true;
    if (!unexplained.empty()) walk(unexplained, 0, progress.part(0.5, 1));
    return renumbered();
  }

  /// Whether a face was given to its fragment by the walk: it tells nothing about the fragment's surface.
  bool is_given(std::size_t face) const { return is_given_[face]; }

 private:
  static constexpr std::size_t none = Surface_growing::none;

  bool is_smooth(Index edge) const {
    constexpr double smooth_angle = 25 * degrees;
    const auto [f, g] = graph_.faces_of(edge);
    const double noise = tolerance_.noise > 0 ? tolerance_.normal_angle[f] + tolerance_.normal_angle[g] : 0;
    return angles_[edge] < std::max(smooth_angle, noise);
  }

  /// Gives the next fragment to all faces that a predicate of two faces and their edge leads to.
  template <class Predicate>
  std::vector<Index> collect(Index first, const Predicate& leads) {
    std::vector<Index> group = {first};
    fragment_of_face_[first] = number_of_fragments_;
    for (std::size_t i = 0; i < group.size(); ++i)
      for (const auto& [g, e] : graph_.neighbours(group[i]))
        if (fragment_of_face_[g] == none && conductances_[e] > 0 && leads(group[i], g, e)) {
          fragment_of_face_[g] = number_of_fragments_;
          group.push_back(g);
        }
    ++number_of_fragments_;
    return group;
  }

  /// Which faces of the remainder continue smoothly into no other face of it.
  std::vector<char> lone_faces(const std::vector<std::size_t>& region_of_face) const {
    std::vector<char> is_lone;
    for (Index f = 0; f < graph_.number_of_faces(); ++f) {
      const auto neighbours = graph_.neighbours(f);
      is_lone.push_back(region_of_face[f] == none &&
                        std::none_of(neighbours.begin(), neighbours.end(), [&](const Dual_graph::Neighbour& n) {
                          return region_of_face[n.face] == none && conductances_[n.edge] > 0 && is_smooth(n.edge);
                        }));
    }
    return is_lone;
  }

  bool continues_a_region(const std::vector<Index>& group, const std::vector<std::size_t>& region_of_face) const {
    // Of a face of the solid that is no analytic surface.
    const std::size_t fewest_faces = tolerance_.noise > 0 ? 100 : 20;
    if (group.size() >= fewest_faces || (tolerance_.noise == 0 && is_flat(group))) return false;
    const bool is_single = group.size() == 1;  // too little to be a face of its own if any surface could hold it
    for (const Index f : group)
      for (const auto& [g, e] : graph_.neighbours(f)) {
        if (region_of_face[g] == none || !(conductances_[e] > 0)) continue;
        if (is_smooth(e) || (is_single && angles_[e] < tolerance_.sharp_angle(graph_.faces_of(e)))) return true;
      }
    return false;
  }

  /// A single face says nothing.
  bool is_flat(const std::vector<Index>& group) const {
    if (group.size() == 1) return false;
    const Eigen::Vector3d& normal = geometry_.normal[group.front()];
    const Eigen::Vector3d& origin = geometry_.centroid[group.front()];
    for (const Index f : group)
      for (const Index v : corners_[f])
        if (std::abs((corners_.point(v) - origin).dot(normal)) > tolerance_.largest_distance()) return false;
    return true;
  }

  // ---- Creases inside a group ----

  bool is_crease(Index edge) const { return angles_[edge] > tolerance_.sharp_angle(graph_.faces_of(edge)); }

  void cut_along_creases(const std::vector<Index>& group, const Progress& progress) {
    const std::vector<std::vector<Index>> sides = sides_of_creases(group);
    if (sides.size() < 2) return;
    const std::size_t first_side = number_of_fragments_;
    for (const std::vector<Index>& side : sides) {
      for (const Index f : side) fragment_of_face_[f] = number_of_fragments_;
      ++number_of_fragments_;
    }
    std::vector<Index> others;
    for (const Index f : group)
      if (fragment_of_face_[f] < first_side) others.push_back(f);
    if (!others.empty()) walk(others, first_side, progress);
    join_across_least_creases(group);
  }

  /// A boundary of two fragments: its length, and how much of it is crease.
  struct Boundary {
    double length = 0, crease = 0;
    double share() const { return length > 0 ? crease / length : 0; }
  };
  using Boundaries = std::map<std::pair<std::size_t, std::size_t>, Boundary>;  // the lower fragment first

  /// Joins fragments of a group across those boundaries first that have least of a crease, until all are half a crease.
  void join_across_least_creases(const std::vector<Index>& group) {
    Boundaries boundaries = boundaries_in(group);
    std::map<std::size_t, std::size_t> joined;  // a fragment, and the one that it has become part of
    while (!boundaries.empty()) {
      const auto least = std::min_element(boundaries.begin(), boundaries.end(), [](const auto& x, const auto& y) {
        return x.second.share() < y.second.share();
      });
      if (least->second.share() >= 0.5) break;
      const auto [a, b] = least->first;
      joined[b] = a;
      Boundaries left;
      for (const auto& [pair, boundary] : boundaries) {
        const std::size_t c = pair.first == b ? a : pair.first, d = pair.second == b ? a : pair.second;
        if (c == d) continue;
        Boundary& sum = left[std::minmax(c, d)];
        sum.length += boundary.length;
        sum.crease += boundary.crease;
      }
      boundaries = std::move(left);
    }
    for (const Index f : group)
      for (auto j = joined.find(fragment_of_face_[f]); j != joined.end(); j = joined.find(j->second))
        fragment_of_face_[f] = j->second;
  }

  Boundaries boundaries_in(const std::vector<Index>& group) const {
    const std::set<Index> inside(group.begin(), group.end());
    Boundaries boundaries;
    for (const Index f : group)
      for (const auto& [g, e] : graph_.neighbours(f)) {
        if (!(fragment_of_face_[f] < fragment_of_face_[g]) || inside.count(g) == 0 || !(conductances_[e] > 0)) continue;
        Boundary& boundary = boundaries[{fragment_of_face_[f], fragment_of_face_[g]}];
        boundary.length += geometry_.edge_length[e];
        if (is_crease(e)) boundary.crease += geometry_.edge_length[e];
      }
    return boundaries;
  }

  /// The faces of a group about the vertices that long creases pass, connected ones together.
  std::vector<std::vector<Index>> sides_of_creases(const std::vector<Index>& group) const {
    const std::set<Index> passed = passed_by_creases(group);
    if (passed.empty()) return {};
    const std::size_t own = fragment_of_face_[group.front()];
    const auto is_beside = [&](Index f) {
      return fragment_of_face_[f] == own &&
             std::any_of(corners_[f].begin(), corners_[f].end(), [&](Index v) { return passed.count(v) > 0; });
    };
    std::set<Index> reached;
    std::vector<std::vector<Index>> sides;
    for (const Index f : group) {
      if (!is_beside(f) || !reached.insert(f).second) continue;
      std::vector<Index> side = {f};
      for (std::size_t i = 0; i < side.size(); ++i)
        for (const auto& [g, e] : graph_.neighbours(side[i]))
          if (conductances_[e] > 0 && !is_crease(e) && is_beside(g) && reached.insert(g).second) side.push_back(g);
      sides.push_back(std::move(side));
    }
    return sides;
  }

  /// The vertices of a group where two edges or more of a crease meet, if it is long beside the group.
  std::set<Index> passed_by_creases(const std::vector<Index>& group) const {
    constexpr double least_length = 0.5;         // as a part of the square root of the area
    constexpr std::size_t fewest_vertices = 16;  // of a crease that is more than a detail of its mesh
    const std::size_t own = fragment_of_face_[group.front()];
    std::map<Index, std::vector<std::pair<Index, double>>> crease;  // by vertex: the other end of each edge, its length
    double area = 0;
    for (const Index f : group) {
      area += geometry_.area[f];
      for (const auto& [g, e] : graph_.neighbours(f))
        if (f < g && fragment_of_face_[g] == own && is_crease(e)) {
          const auto [v, w] = common_corners(f, g);
          crease[v].emplace_back(w, geometry_.edge_length[e]);
          crease[w].emplace_back(v, geometry_.edge_length[e]);
        }
    }
    std::set<Index> reached, passed;
    for (const auto& [first, edges] : crease) {
      if (!reached.insert(first).second) continue;
      std::vector<Index> vertices = {first};
      double length = 0;
      for (std::size_t i = 0; i < vertices.size(); ++i)
        for (const auto& [next, edge_length] : crease.at(vertices[i])) {
          length += edge_length / 2;
          if (reached.insert(next).second) vertices.push_back(next);
        }
      if (vertices.size() < fewest_vertices || length < least_length * std::sqrt(area)) continue;
      for (const Index v : vertices)
        if (crease.at(v).size() > 1) passed.insert(v);
    }
    return passed;
  }

  std::pair<Index, Index> common_corners(Index f, Index g) const {
    const auto other = corners_[g];
    std::vector<Index> common;
    for (const Index v : corners_[f])
      if (std::find(other.begin(), other.end(), v) != other.end()) common.push_back(v);
    return {common.front(), common.back()};
  }

  // ---- The walk ----

  /// Gives faces to the fragments about them. These are absorbing, so that each of them is one node.
  /// \param first_fragment fragments with lower numbers get none
  void walk(const std::vector<Index>& faces, std::size_t first_fragment, const Progress& progress) {
    constexpr Index no_node = std::numeric_limits<Index>::max();
    std::vector<Index> node_of_face(graph_.number_of_faces(), no_node), node_of_fragment(number_of_fragments_, no_node);
    for (std::size_t i = 0; i < faces.size(); ++i) node_of_face[faces[i]] = static_cast<Index>(i);
    std::vector<Index> seeds;
    std::vector<std::size_t> fragments;
    std::vector<std::array<Index, 2>> edges;
    std::vector<double> conductances;
    for (const Index f : faces)
      for (const auto& [g, e] : graph_.neighbours(f)) {
        Index other = node_of_face[g];
        if (other == no_node) {
          if (fragment_of_face_[g] < first_fragment) continue;
          Index& seed = node_of_fragment[fragment_of_face_[g]];
          if (seed == no_node) {
            seed = static_cast<Index>(faces.size() + seeds.size());
            seeds.push_back(seed);
            fragments.push_back(fragment_of_face_[g]);
          }
          other = seed;
        } else if (other < node_of_face[f]) {
          continue;  // seen from the other side
        }
        edges.push_back({node_of_face[f], other});
        conductances.push_back(conductances_[e]);
      }
    const Dual_graph graph(faces.size() + seeds.size(), std::move(edges));
    const std::vector<std::size_t> labels = walk_labels(graph, std::move(conductances), seeds, fragments, progress);
    for (std::size_t i = 0; i < faces.size(); ++i) fragment_of_face_[faces[i]] = labels[i];
  }

  std::vector<std::size_t> renumbered() const {
    std::vector<std::size_t> number(number_of_fragments_, none), result;
    std::size_t count = 0;
    for (const std::size_t fragment : fragment_of_face_) {
      if (number[fragment] == none) number[fragment] = count++;
      result.push_back(number[fragment]);
    }
    return result;
  }

  const Dual_graph& graph_;
  const Face_geometry& geometry_;
  const Face_corners& corners_;
  const Surface_tolerance& tolerance_;
  const std::vector<double>& angles_;
  const std::vector<double>& conductances_;
  std::vector<std::size_t> fragment_of_face_;
  std::vector<char> is_given_;  // whether a face
  std::size_t number_of_fragments_ = 0;
};

}  // namespace RW_segmentation::internal

#endif
