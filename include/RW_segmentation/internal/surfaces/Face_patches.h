// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_FACE_PATCHES_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_FACE_PATCHES_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/Surface_samples.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// Collects connected faces of a mesh that are free, which are all at first.
class Face_patches {
 public:
  using Index = Dual_mesh::Index;

  /// Connected faces, and their vertices, in the order in which they were reached.
  struct Patch {
    std::vector<Index> faces, vertices;
  };

  /// Keeps a reference to the mesh. Neighbourhoods end at no edge but walls.
  explicit Face_patches(const Dual_mesh& mesh)
      : Face_patches(mesh, std::vector<double>(mesh.number_of_edges(), 0), [](Index) { return 0; }) {}

  /// As above, but neighbourhoods end at sharp edges.
  /// \param angles of the edges
  /// \param sharp_angle a function from an edge to the angle above which it is sharp
  template <class Sharp_angle>
  Face_patches(const Dual_mesh& mesh, std::vector<double> angles, const Sharp_angle& sharp_angle)
      : mesh_(mesh),
        angle_(std::move(angles)),
        is_taken_(mesh.number_of_faces(), false),
        face_mark_(mesh.number_of_faces(), 0),
        vertex_mark_(mesh.number_of_vertices(), 0) {
    is_sharp_.reserve(angle_.size());
    for (Index e = 0; e < angle_.size(); ++e) is_sharp_.push_back(mesh.is_wall(e) || angle_[e] > sharp_angle(e));
  }

  double angle(Index edge) const { return angle_[edge]; }
  bool is_free(Index face) const { return !is_taken_[face]; }
  void take(const Patch& patch) {
    for (const Index f : patch.faces) is_taken_[f] = true;
  }

  /// Free faces about a face, breadth first, not across sharp edges, until they have so many vertices.
  Patch neighbourhood(Index seed, std::size_t vertices) {
    return collected(seed, vertices, [&](Index g, Index e) { return leads_on(g, e); });
  }

  /// As above, but across all edges up to an angle.
  Patch neighbourhood_within(double angle, Index seed, std::size_t vertices) {
    return collected(seed, vertices, [&](Index g, Index e) { return is_open(g, e) && angle_[e] <= angle; });
  }

  /// As above, but across the flattest edges first: the way with the smallest angle leads on (Prim), whatever lies behind it,
  /// so that no sum of lengths, and none of the engines for shortest paths, orders the faces.
  Patch flattest_neighbourhood(Index seed, std::size_t vertices) {
    using Way = std::pair<double, Index>;  // its edge's angle, and where it leads
    std::priority_queue<Way, std::vector<Way>, std::greater<>> ways;
    Patch patch;
    start(patch);
    ways.emplace(0, seed);
    while (!ways.empty() && patch.vertices.size() < vertices) {
      const Index f = ways.top().second;
      ways.pop();
      if (is_marked(f)) continue;
      add(patch, f);
      for (const auto& [g, e] : mesh_.graph().neighbours(f))
        if (leads_on(g, e)) ways.emplace(angle_[e], g);
    }
    return patch;
  }

  /// The free faces that a predicate holds for and that are connected with the seed by such, sharp edges or not, until
  /// they have so many vertices.
  template <class Predicate>
  void flood(Index seed, const Predicate& holds, std::size_t most_vertices, Patch& patch) {
    start(patch);
    if (!holds(seed)) return;
    add(patch, seed);
    for (std::size_t i = 0; i < patch.faces.size() && patch.vertices.size() < most_vertices; ++i)
      for (const auto& [g, e] : mesh_.graph().neighbours(patch.faces[i]))
        if (is_open(g, e) && holds(g)) add(patch, g);
  }

  /// The patch of given faces.
  Patch of(const std::vector<Index>& faces) {
    Patch patch;
    start(patch);
    for (const Index f : faces) add(patch, f);
    return patch;
  }

  /// The faces of a patch that were reached first, until they have so many vertices: of a neighbourhood, the smaller one.
  Patch beginning(const Patch& patch, std::size_t vertices) {
    Patch first;
    start(first);
    for (std::size_t i = 0; i < patch.faces.size() && first.vertices.size() < vertices; ++i) add(first, patch.faces[i]);
    return first;
  }

  /// The free faces that a patch continues into across edges that are not sharp, once for each of these edges.
  std::vector<Index> faces_beside(const Patch& patch) {
    mark(patch);
    std::vector<Index> beside;
    for (const Index f : patch.faces)
      for (const auto& [g, e] : mesh_.graph().neighbours(f))
        if (leads_on(g, e)) beside.push_back(g);
    return beside;
  }

  /// Whether all neighbours of a face are free and turn by less than an angle against it.
  bool is_smooth_within(Index face, double angle) const {
    const auto neighbours = mesh_.graph().neighbours(face);
    return std::all_of(neighbours.begin(), neighbours.end(), [&](const Dual_graph::Neighbour& n) {
      return is_free(n.face) && !is_sharp_[n.edge] && angle_[n.edge] < angle;
    });
  }

  /// Whether the faces of a patch turn by less than an angle against each other, whatever lies about it.
  bool is_smooth_inside(const Patch& patch, double angle) {
    mark(patch);
    return std::all_of(patch.faces.begin(), patch.faces.end(), [&](Index f) {
      const auto neighbours = mesh_.graph().neighbours(f);
      return std::none_of(neighbours.begin(), neighbours.end(),
                          [&](const Dual_graph::Neighbour& n) { return is_marked(n.face) && angle_[n.edge] >= angle; });
    });
  }

  /// Marks the faces of a patch, until the next patch is marked or collected.
  void mark(const Patch& patch) {
    ++mark_;
    for (const Index f : patch.faces) face_mark_[f] = mark_;
  }
  bool is_marked(Index face) const { return face_mark_[face] == mark_; }

  /// Some of the vertices of a patch, and of its faces' normals. They stay until the next call.
  const Surface_samples& samples_of(const Patch& patch) {
    samples_.clear();
    for (std::size_t i = 0, step = step_of(patch.vertices); i < patch.vertices.size(); i += step)
      samples_.points.push_back(mesh_.point(patch.vertices[i]));
    for (std::size_t i = 0, step = step_of(patch.faces); i < patch.faces.size(); i += step) {
      const Index f = patch.faces[i];
      if (mesh_.shape_normal(f).isZero()) continue;
      samples_.normal_points.push_back(mesh_.centroid(f));
      samples_.normals.push_back(mesh_.shape_normal(f));
    }
    return samples_;
  }

 private:
  void start(Patch& patch) {
    ++mark_;
    patch.faces.clear();
    patch.vertices.clear();
  }
  void add(Patch& patch, Index f) {
    face_mark_[f] = mark_;
    patch.faces.push_back(f);
    for (const Index v : mesh_.corners(f))
      if (vertex_mark_[v] != mark_) {
        vertex_mark_[v] = mark_;
        patch.vertices.push_back(v);
      }
  }
  /// Whether a free face that is not in the patch yet lies behind an edge that is no wall.
  bool is_open(Index face, Index edge) const { return !is_marked(face) && is_free(face) && !mesh_.is_wall(edge); }
  bool leads_on(Index face, Index edge) const { return !is_marked(face) && is_free(face) && !is_sharp_[edge]; }

  /// \param leads a predicate of a face and the edge that leads to it
  template <class Predicate>
  Patch collected(Index seed, std::size_t vertices, const Predicate& leads) {
    Patch patch;
    start(patch);
    add(patch, seed);
    for (std::size_t i = 0; i < patch.faces.size(); ++i)
      for (const auto& [g, e] : mesh_.graph().neighbours(patch.faces[i])) {
        if (patch.vertices.size() >= vertices) return patch;
        if (leads(g, e)) add(patch, g);
      }
    return patch;
  }

  static std::size_t step_of(const std::vector<Index>& all) {
    constexpr std::size_t samples = 80;  // up to twice as many; 40 and 160 give benchmark_engineering the same overlap
    return std::max<std::size_t>(1, all.size() / samples);
  }

  const Dual_mesh& mesh_;
  std::vector<double> angle_;   // of each edge
  std::vector<char> is_sharp_;  // each edge
  std::vector<char> is_taken_;  // each face
  std::vector<std::uint32_t> face_mark_, vertex_mark_;
  std::uint32_t mark_ = 0;  // of the patch at hand
  Surface_samples samples_;
};

}  // namespace RW_segmentation::internal

#endif
