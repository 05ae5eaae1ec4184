// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_REGION_FRAGMENTS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_REGION_FRAGMENTS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Progress.h>
#include <RW_segmentation/internal/surfaces/Analytic_regions.h>
#include <RW_segmentation/internal/surfaces/Creases.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/internal/walk/Seeded_walk.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Makes fragments of the regions that `Surface_growing` found and of the faces that no surface explains: these form
/// groups that are fragments themselves, or, where a group is too small to be a face of the solid and continues a
/// region smoothly, are given to the regions by a random walk from these. Triangles that turn sharply against each
/// other, as on coarse fillets and holes, are one group where they touch; faces of more sides are as flat as the triangles
/// that they could be cut into, and stay apart. A group with long creases inside, which end in
/// it, is cut along them: walks from either side share it out.
///
/// What comments tell of other values of a number was measured as in `Surface_growing`.
class Region_fragments {
 public:
  using Index = Dual_mesh::Index;

  /// Keeps references to all.
  /// \param conductances of the edges, for the walks
  Region_fragments(const Dual_mesh& mesh, const Surface_tolerance& tolerance, const std::vector<double>& conductances)
      : mesh_(mesh), tolerance_(tolerance), conductances_(conductances), angles_(crease_angles(mesh, tolerance)) {}

  /// \param region_of_face `Analytic_regions::none` for the faces of no region
  /// \returns the fragment of each face, numbered from 0
  std::vector<std::size_t> fragments(const std::vector<std::size_t>& region_of_face, const Progress& progress) {
    fragment_of_face_.assign(mesh_.number_of_faces(), none);
    for (Index f = 0; f < mesh_.number_of_faces(); ++f)
      if (fragment_of_face_[f] == none && region_of_face[f] != none)
        collect(f, [&](Index from, Index to, Index) { return region_of_face[from] == region_of_face[to]; });
    const std::vector<std::vector<Index>> all = groups(region_of_face);
    std::vector<Index> unexplained;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (continues_a_region(all[i], region_of_face)) {
        unexplained.insert(unexplained.end(), all[i].begin(), all[i].end());
      } else if (!tolerance_.is_noisy()) {  // noise would make creases of its own
        const double done = 0.5 * static_cast<double>(i) / static_cast<double>(all.size());
        cut_along_creases(all[i], progress.part(done, done));
      }
    is_given_.assign(mesh_.number_of_faces(), false);
    for (const Index f : unexplained) is_given_[f] = true;
    if (!unexplained.empty()) walk(unexplained, 0, progress.part(0.5, 1));
    return renumbered();
  }

  /// By face: whether the walk gave it to its fragment. It tells nothing about the fragment's surface.
  const std::vector<char>& given() const { return is_given_; }

 private:
  static constexpr std::size_t none = Analytic_regions::none;

  bool is_smooth(Index edge) const { return angles_[edge] < tolerance_.smooth_angle(mesh_.graph().faces_of(edge)); }

  /// Gives the next fragment to all faces that a predicate of two faces and their edge leads to.
  template <class Predicate>
  std::vector<Index> collect(Index first, const Predicate& leads) {
    std::vector<Index> group = {first};
    fragment_of_face_[first] = number_of_fragments_;
    for (std::size_t i = 0; i < group.size(); ++i)
      for (const auto& [g, e] : mesh_.graph().neighbours(group[i]))
        if (fragment_of_face_[g] == none && !mesh_.is_wall(e) && leads(group[i], g, e)) {
          fragment_of_face_[g] = number_of_fragments_;
          group.push_back(g);
        }
    ++number_of_fragments_;
    return group;
  }

  /// The groups of faces without a region, each a fragment.
  std::vector<std::vector<Index>> groups(const std::vector<std::size_t>& region_of_face) {
    // The faces of a tetrahedron stay apart. At 60 degrees, a fortieth more segments (`_5k`).
    constexpr double widest_angle = radians(90);
    const std::vector<char> is_lone = lone_faces(region_of_face);
    std::vector<std::vector<Index>> groups;
    for (Index f = 0; f < mesh_.number_of_faces(); ++f)
      if (fragment_of_face_[f] == none)
        groups.push_back(collect(f, [&](Index from, Index to, Index edge) {
          return region_of_face[to] == none &&
                 (is_smooth(edge) || (is_lone[from] && is_lone[to] && angles_[edge] < widest_angle));
        }));
    return groups;
  }

  /// Which triangles of the remainder continue smoothly into no other face of it.
  std::vector<char> lone_faces(const std::vector<std::size_t>& region_of_face) const {
    std::vector<char> is_lone;
    for (Index f = 0; f < mesh_.number_of_faces(); ++f) {
      const auto neighbours = mesh_.graph().neighbours(f);
      is_lone.push_back(region_of_face[f] == none && mesh_.corners(f).size() == 3 &&
                        std::none_of(neighbours.begin(), neighbours.end(), [&](const Dual_graph::Neighbour& n) {
                          return region_of_face[n.face] == none && !mesh_.is_wall(n.edge) && is_smooth(n.edge);
                        }));
    }
    return is_lone;
  }

  bool continues_a_region(const std::vector<Index>& group, const std::vector<std::size_t>& region_of_face) const {
    // The fewest of a face of the solid that no surface fits. Clean: at 10, a thirtieth more segments (`_5k`); at 40,
    // overlap .9760 in place of .9766. Under noise 50 and 200 are as good.
    constexpr std::size_t clean_faces = 20, noisy_faces = 100;
    if (group.size() >= (tolerance_.is_noisy() ? noisy_faces : clean_faces)) return false;
    if (!tolerance_.is_noisy() && is_flat(group)) return false;
    const bool is_single = group.size() == 1;  // too little to be a face of its own if any surface could hold it
    for (const Index f : group)
      for (const auto& [g, e] : mesh_.graph().neighbours(f)) {
        if (region_of_face[g] == none || mesh_.is_wall(e)) continue;
        if (is_smooth(e) || (is_single && angles_[e] < tolerance_.sharp_angle(mesh_.graph().faces_of(e)))) return true;
      }
    return false;
  }

  /// A single face says nothing.
  bool is_flat(const std::vector<Index>& group) const {
    if (group.size() == 1) return false;
    const Eigen::Vector3d normal = mesh_.shape_normal(group.front());
    const Eigen::Vector3d& origin = mesh_.centroid(group.front());
    for (const Index f : group)
      for (const Index v : mesh_.corners(f))
        if (std::abs((mesh_.point(v) - origin).dot(normal)) > tolerance_.largest_distance()) return false;
    return true;
  }

  void cut_along_creases(const std::vector<Index>& group, const Progress& progress) {
    const Creases creases(mesh_, tolerance_, angles_, group);
    const std::vector<std::vector<Index>> sides = creases.sides();
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
    const std::vector<std::size_t> joined = creases.joined(fragment_of_face_, first_side, sides.size());
    for (const Index f : group) fragment_of_face_[f] = first_side + joined[fragment_of_face_[f] - first_side];
  }

  /// Gives faces to the fragments about them. These are absorbing, so that each of them is one node.
  /// \param first_fragment fragments with lower numbers get none
  void walk(const std::vector<Index>& faces, std::size_t first_fragment, const Progress& progress) {
    constexpr Index no_node = std::numeric_limits<Index>::max();
    std::vector<Index> node_of_face(mesh_.number_of_faces(), no_node), node_of_fragment(number_of_fragments_, no_node);
    for (std::size_t i = 0; i < faces.size(); ++i) node_of_face[faces[i]] = static_cast<Index>(i);
    std::vector<Index> seeds;
    std::vector<std::size_t> fragments;
    std::vector<std::array<Index, 2>> edges;
    std::vector<double> conductances;
    for (const Index f : faces)
      for (const auto& [g, e] : mesh_.graph().neighbours(f)) {
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

  const Dual_mesh& mesh_;
  const Surface_tolerance& tolerance_;
  const std::vector<double>& conductances_;
  std::vector<double> angles_;  // of the edges
  std::vector<std::size_t> fragment_of_face_;
  std::vector<char> is_given_;  // whether a face
  std::size_t number_of_fragments_ = 0;
};

}  // namespace RW_segmentation::internal

#endif
