// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SURFACES_CUT_FACETS_H
#define RW_SEGMENTATION_INTERNAL_SURFACES_CUT_FACETS_H

#include <RW_segmentation/Dual_mesh.h>
#include <RW_segmentation/internal/surfaces/edge_angles.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// From end to end of two edges on one line, in the direction of the first.
inline std::array<Dual_mesh::Index, 2> joined_edge(const Dual_mesh& mesh, const std::array<Dual_mesh::Index, 2>& a,
                                                   const std::array<Dual_mesh::Index, 2>& b) {
  using Index = Dual_mesh::Index;
  const Eigen::Vector3d along = mesh.point(a[1]) - mesh.point(a[0]);
  const auto is_before = [&](Index v, Index w) { return along.dot(mesh.point(w) - mesh.point(v)) > 0; };
  const auto [first, last] = std::minmax({a[0], a[1], b[0], b[1]}, is_before);
  return {first, last};
}

/// Which flat facets of round surfaces others have cut, and the corners that these facets had.
///
/// Meshes of kernels and of meshers have hardly any such facet: 438 meshes of 146 CAD solids, of 6.7 million faces, 54. What
/// comments tell of other values of a number is how many these have, and how many twenty made solids (cylinders and balls of 24
/// to 100 sides, cut by others), which have 1016.
class Cut_facet_search {
 public:
  using Index = Dual_mesh::Index;

  /// \param exactness that vertices are in one plane to, a length
  /// Complexity: n log n.
  Cut_facet_search(const Dual_mesh& mesh, double exactness) : mesh_(mesh), exactness_(exactness) {
    find_pieces();
    find_sides();
    for (const auto& [number, piece] : pieces_) {
      std::vector<Index> corners = corners_before_cuts(number, piece);
      if (!corners.empty()) corners_.emplace(number, std::move(corners));
    }
  }

  /// The largest face of the plane of each face.
  const std::vector<Index>& largest_in_plane() const { return piece_of_face_; }
  /// The corners of each facet that was cut, by its largest face.
  const std::map<Index, std::vector<Index>>& corners() const { return corners_; }

 private:
  using Edge = std::array<Index, 2>;  // its ends

  /// Connected faces in one plane, two or more.
  struct Piece {
    std::vector<Index> vertices;  // ascending
    std::vector<Index> hull;      // corners of the convex hull in the plane, counterclockwise
    double hull_area = 0;
  };

  /// Faces turn less within a plane.
  static constexpr double least_turn = radians(0.5);

  // ---- Pieces in planes ----

  /// A piece has the number of its largest face. A face by itself is one, too.
  void find_pieces() {
    constexpr Index none = std::numeric_limits<Index>::max();
    std::vector<Index> order(mesh_.number_of_faces());
    std::iota(order.begin(), order.end(), Index(0));
    std::stable_sort(order.begin(), order.end(), [&](Index f, Index g) { return mesh_.area(f) > mesh_.area(g); });
    piece_of_face_.assign(order.size(), none);
    for (const Index seed : order) {
      if (piece_of_face_[seed] != none) continue;
      std::vector<Index> faces = {seed};
      piece_of_face_[seed] = seed;
      for (std::size_t i = 0; i < faces.size(); ++i)
        for (const auto& [f, e] : mesh_.graph().neighbours(faces[i]))
          if (piece_of_face_[f] == none && !mesh_.is_wall(e) && is_in_plane_of(seed, f)) {
            piece_of_face_[f] = seed;
            faces.push_back(f);
          }
      if (faces.size() > 1) pieces_.emplace(seed, piece_of(seed, vertices_of(faces)));
    }
  }

  bool is_in_plane_of(Index seed, Index face) const {
    const Eigen::Vector3d normal = mesh_.normal(seed);
    const Eigen::Vector3d& origin = mesh_.point(mesh_.corners(seed)[0]);
    const auto corners = mesh_.corners(face);
    return !normal.isZero() && (normal.dot(mesh_.normal(face)) >= std::cos(least_turn) || is_sliver(face)) &&
           std::all_of(corners.begin(), corners.end(),
                       [&](Index v) { return std::abs(normal.dot(mesh_.point(v) - origin)) <= exactness_; });
  }

  /// Whether a face is so narrow that rounding may turn it anywhere.
  bool is_sliver(Index face) const {
    constexpr double heights = 10;  // times the exactness; at 3, 54 and 1016; at 30, 57 and 1016
    double longest = 0;
    for (const Index v : mesh_.corners(face))
      for (const Index w : mesh_.corners(face)) longest = std::max(longest, (mesh_.point(v) - mesh_.point(w)).norm());
    return 2 * mesh_.area(face) <= heights * exactness_ * longest;
  }

  std::vector<Index> vertices_of(const std::vector<Index>& faces) const {
    std::vector<Index> vertices;
    for (const Index f : faces) vertices.insert(vertices.end(), mesh_.corners(f).begin(), mesh_.corners(f).end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  struct Point_in_plane {
    Eigen::Vector2d place;
    Index vertex;
  };

  Piece piece_of(Index face, std::vector<Index> vertices) const {
    const Eigen::Vector3d normal = mesh_.normal(face), x = normal.unitOrthogonal(), y = normal.cross(x);
    std::vector<Point_in_plane> points;
    for (const Index v : vertices) points.push_back({{x.dot(mesh_.point(v)), y.dot(mesh_.point(v))}, v});
    const std::vector<Point_in_plane> hull = convex_hull(std::move(points));
    Piece piece;
    piece.vertices = std::move(vertices);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Eigen::Vector2d &a = hull[i].place, &b = hull[(i + 1) % hull.size()].place;
      piece.hull.push_back(hull[i].vertex);
      piece.hull_area += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    return piece;
  }

  /// By monotone chains (Andrew 1979). Points on a side are no corners, nor are those within the exactness of it.
  std::vector<Point_in_plane> convex_hull(std::vector<Point_in_plane> points) const {
    std::sort(points.begin(), points.end(), [](const Point_in_plane& p, const Point_in_plane& q) {
      return std::pair(p.place.x(), p.place.y()) < std::pair(q.place.x(), q.place.y());
    });
    std::vector<Point_in_plane> hull;
    const auto turns_left_to = [&](const Point_in_plane& p) {
      const Eigen::Vector2d& before = hull[hull.size() - 2].place;
      const Eigen::Vector2d side = hull.back().place - before, whole = p.place - before;
      return side.x() * whole.y() - side.y() * whole.x() > exactness_ * whole.norm();
    };
    for (int chain = 0; chain < 2; ++chain) {
      const std::size_t first = hull.size();
      for (const Point_in_plane& p : points) {
        while (hull.size() >= first + 2 && !turns_left_to(p)) hull.pop_back();
        hull.push_back(p);
      }
      hull.pop_back();
      std::reverse(points.begin(), points.end());
    }
    return hull;
  }

  // ---- Facets that were cut ----

  /// Nothing for a face by itself.
  const Piece* find_piece(Index number) const {
    const auto found = pieces_.find(number);
    return found == pieces_.end() ? nullptr : &found->second;
  }

  /// Whether a piece has vertices that its hull has not, and as few corners as facets have.
  bool may_be_cut(Index number) const {
    constexpr std::size_t most_corners = 16;  // four, and some of the cut; at 8, 53 and 1016; at 64 as many
    const Piece* piece = find_piece(number);
    return piece && piece->hull.size() >= 3 && piece->hull.size() <= most_corners &&
           piece->hull.size() < piece->vertices.size();
  }

  /// The sides at which pieces that may have been cut turn as facets of round surfaces do, and the vertices at which they end
  /// sharply.
  void find_sides() {
    constexpr double largest_turn = radians(40);  // see `Surface_tolerance::sharp_angle()`
    is_at_sharp_edge_.assign(mesh_.number_of_vertices(), false);
    for (Index e = 0; e < mesh_.number_of_edges(); ++e) {
      const Index a = piece_of_face_[mesh_.graph().faces_of(e)[0]], b = piece_of_face_[mesh_.graph().faces_of(e)[1]];
      if (a == b || (!may_be_cut(a) && !may_be_cut(b))) continue;
      const double cosine = mesh_.normal(a).dot(mesh_.normal(b));
      if (mesh_.is_wall(e) || cosine < std::cos(largest_turn)) {
        for (const Index v : mesh_.ends(e)) is_at_sharp_edge_[v] = true;
      } else if (cosine <= std::cos(least_turn)) {
        add_side(a, b, mesh_.ends(e));
        add_side(b, a, mesh_.ends(e));
      }
    }
  }

  void add_side(Index piece, Index beside, const Edge& edge) {
    const auto [side, is_new] = sides_.insert({{piece, beside}, edge});
    if (!is_new) side->second = joined_edge(mesh_, side->second, edge);
  }

  /// Nothing if a piece is no facet of a round surface, or was not cut.
  std::vector<Index> corners_before_cuts(Index number, const Piece& piece) const {
    std::vector<Index> corners;
    if (!may_be_cut(number)) return corners;
    const std::vector<Index> shared = shared_with_facets_beside(number, piece);
    if (shared.empty() || !is_cut(piece, shared)) return corners;
    std::copy_if(piece.hull.begin(), piece.hull.end(), std::back_inserter(corners),
                 [&](Index v) { return std::binary_search(shared.begin(), shared.end(), v); });
    if (corners.size() < 3) corners.clear();
    return corners;
  }

  /// The vertices that a piece shares with facets beside it.
  std::vector<Index> shared_with_facets_beside(Index number, const Piece& piece) const {
    std::vector<Index> shared;
    for (auto side = sides_.lower_bound({number, 0}); side != sides_.end() && side->first.first == number; ++side) {
      const Index next = side->first.second;
      if (!may_be_of_one_surface(number, next, side->second)) continue;
      const Piece* beside = find_piece(next);
      for (const Index v : beside ? beside->vertices : vertices_of({next}))
        if (std::binary_search(piece.vertices.begin(), piece.vertices.end(), v)) shared.push_back(v);
    }
    std::sort(shared.begin(), shared.end());
    return shared;
  }

  /// Whether the piece beside another one is about as wide across their side, as facets of one surface are, and chords of the
  /// other one would be off that surface.
  bool may_be_of_one_surface(Index piece, Index beside, const Edge& side) const {
    constexpr double times_as_wide = 2;  // at 1.3, 9 and 1004; at 4, 114 and 1060
    // Vertices on chords that are less off count as being on the surface. At 1, 126 and 1520, and overlap .9687 in place of
    // .9703 on 118 of the CAD solids (`benchmark_engineering --suffix _t`).
    constexpr double deviations = 3;  // times the exactness
    const double length = (mesh_.point(side[1]) - mesh_.point(side[0])).norm();
    if (!(length > 0)) return false;
    const double width = width_of(piece, length);
    const double angle = std::acos(std::min(1.0, mesh_.normal(piece).dot(mesh_.normal(beside))));
    return width <= times_as_wide * width_of(beside, length) && width * angle / 8 > deviations * exactness_;
  }

  /// The width of a piece across a side of some length.
  double width_of(Index number, double length) const {
    const Piece* piece = find_piece(number);
    const std::size_t corners = piece ? piece->hull.size() : mesh_.corners(number).size();
    return (corners == 3 ? 2 : 1) * (piece ? piece->hull_area : mesh_.area(number)) / length;
  }

  /// Whether a piece has vertices within its hull or on chords, and none of these where it ends smoothly, which are a mesher's:
  /// with them, 31558 and 1028.
  /// \param shared with facets beside the piece, ascending
  bool is_cut(const Piece& piece, const std::vector<Index>& shared) const {
    bool has_cuts = false;
    for (const Index v : piece.vertices) {
      if (std::find(piece.hull.begin(), piece.hull.end(), v) != piece.hull.end()) continue;
      if (!is_at_sharp_edge_[v]) return false;
      has_cuts |= !is_on_hull(piece, v) || std::binary_search(shared.begin(), shared.end(), v);
    }
    return has_cuts;
  }

  bool is_on_hull(const Piece& piece, Index vertex) const {
    for (std::size_t i = 0; i < piece.hull.size(); ++i) {
      const Eigen::Vector3d& begin = mesh_.point(piece.hull[i]);
      const Eigen::Vector3d side = mesh_.point(piece.hull[(i + 1) % piece.hull.size()]) - begin;
      if ((mesh_.point(vertex) - begin).cross(side).norm() <= exactness_ * side.norm()) return true;
    }
    return false;
  }

  const Dual_mesh& mesh_;
  double exactness_;
  std::vector<Index> piece_of_face_;
  std::vector<char> is_at_sharp_edge_;             // by vertex: of a piece that may have been cut
  std::map<Index, Piece> pieces_;                  // by number
  std::map<std::pair<Index, Index>, Edge> sides_;  // by the numbers of two pieces
  std::map<Index, std::vector<Index>> corners_;    // by number
};

/// A mesh with the flat facets of its round surfaces as they were before others cut them.
///
/// Modellers that compute with polygons, such as OpenSCAD, cut the facets of a cylinder or ball and not the cylinder or ball
/// itself: the vertices of a cut lie on chords. A facet that was cut becomes one polygon again, whose corners are those of its
/// convex hull that it shares with facets beside it. Faces of other kinds stay what they are. It takes .8 microseconds a face.
class Cut_facets {
 public:
  using Index = Dual_mesh::Index;

  /// The mesh as it is.
  explicit Cut_facets(const Dual_mesh& mesh) : mesh_(mesh) {}

  /// \param exactness that vertices are in one plane to, a length
  /// Complexity: n log n.
  Cut_facets(const Dual_mesh& mesh, double exactness) : Cut_facets(mesh) {
    const Cut_facet_search search(mesh, exactness);
    if (!search.corners().empty()) make_whole(search);
  }

  /// Whether there is such a facet. Without one the mesh stays what it is.
  bool are_any() const { return !whole_.empty(); }
  /// The mesh with these facets whole, in the same unit box.
  const Dual_mesh& mesh() const { return mesh_; }

  /// Values by face of `mesh()` as values by face of the mesh that there was.
  template <class Value>
  std::vector<Value> by_part(const std::vector<Value>& values) const {
    return are_any() ? picked(values, whole_) : values;
  }

  /// Values by face of the mesh that there was as values by face of `mesh()`: those of the largest parts.
  template <class Value>
  std::vector<Value> by_whole(const std::vector<Value>& values) const {
    return are_any() ? picked(values, largest_part_) : values;
  }

 private:
  template <class Value>
  static std::vector<Value> picked(const std::vector<Value>& values, const std::vector<Index>& places) {
    std::vector<Value> result;
    result.reserve(places.size());
    for (const Index place : places) result.push_back(values[place]);
    return result;
  }

  void make_whole(const Cut_facet_search& search) {
    Dual_mesh::Arrays arrays;
    arrays.points = mesh_.points();
    add_faces(search, arrays);
    add_edges(arrays);
    mesh_ = in_box_of(mesh_, std::move(arrays), largest_part_);
  }

  void add_faces(const Cut_facet_search& search, Dual_mesh::Arrays& arrays) {
    std::map<Index, Index> face_of_facet;  // by its largest part
    const auto add = [&](const auto& corners, Index largest_part) {
      for (const Index v : corners) arrays.corners.add(v);
      arrays.corners.end_face();
      largest_part_.push_back(largest_part);
    };
    for (Index f = 0; f < mesh_.number_of_faces(); ++f) {
      const auto next = static_cast<Index>(largest_part_.size());
      const auto facet = search.corners().find(search.largest_in_plane()[f]);
      if (facet == search.corners().end()) {
        add(mesh_.corners(f), f);
        whole_.push_back(next);
      } else {
        const auto [whole, is_new] = face_of_facet.insert({facet->first, next});
        if (is_new) add(facet->second, facet->first);
        whole_.push_back(whole->second);
      }
    }
  }

  /// Faces meet in one edge, or in two if one of them is a wall.
  void add_edges(Dual_mesh::Arrays& arrays) const {
    std::vector<std::array<Index, 2>> faces_of_edge;
    std::map<std::array<Index, 3>, std::size_t> edge_between;
    for (Index e = 0; e < mesh_.number_of_edges(); ++e) {
      const Index f = whole_[mesh_.graph().faces_of(e)[0]], g = whole_[mesh_.graph().faces_of(e)[1]];
      if (f == g) continue;
      const auto [edge, is_new] =
          edge_between.insert({{std::min(f, g), std::max(f, g), Index(mesh_.is_wall(e))}, faces_of_edge.size()});
      if (!is_new) {
        arrays.edge_ends[edge->second] = joined_edge(mesh_, arrays.edge_ends[edge->second], mesh_.ends(e));
        continue;
      }
      faces_of_edge.push_back({f, g});
      arrays.edge_ends.push_back(mesh_.ends(e));
      if (mesh_.has_walls()) arrays.is_wall.push_back(mesh_.is_wall(e));
    }
    arrays.graph = {largest_part_.size(), std::move(faces_of_edge)};
  }

  Dual_mesh mesh_;
  std::vector<Index> whole_;         // by face of the mesh that there was; empty if no facet was cut
  std::vector<Index> largest_part_;  // by face of the mesh with whole facets; likewise
};

}  // namespace RW_segmentation::internal

#endif
