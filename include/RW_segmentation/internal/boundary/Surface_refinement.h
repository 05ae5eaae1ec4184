// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BOUNDARY_SURFACE_REFINEMENT_H
#define RW_SEGMENTATION_INTERNAL_BOUNDARY_SURFACE_REFINEMENT_H

#include <RW_segmentation/internal/boundary/Divided_triangle.h>
#include <RW_segmentation/internal/boundary/Surface_curve.h>
#include <RW_segmentation/internal/boundary/Triangle_surface.h>

#include <Eigen/Geometry>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace RW_segmentation::internal {

/// How a surface has to be cut so that curves become chains of edges: worked out beforehand, so that what cannot be
/// cut is known before anything has changed.
///
/// Curves may meet in their ends only. Where they do not keep to that, where a new triangle would be too low, or where
/// the curves do not bound the segments they should, the curves concerned are found by `faulty_curves()`.
class Surface_refinement {
 public:
  using Index = Triangle_surface::Index;

  /// The least height of a new triangle, in mean edge lengths: what is lower cannot be told from no triangle by floats.
  static constexpr double least_relative_height = 1e-6;

  /// A new vertex on an edge.
  struct Edge_cut {
    Index edge;
    double position;
    std::size_t curve;
    bool operator<(const Edge_cut& other) const {
      return std::tie(edge, position, curve) < std::tie(other.edge, other.position, other.curve);
    }
  };
  /// A face that new vertices lie on, or curves cross.
  struct Cut_face {
    Index face;
    std::vector<Index> corners;  ///< vertices, and `number_of_vertices()` + the number of a cut; counterclockwise
    Divided_triangle division;
    std::size_t first_piece;  ///< the number of the first of its triangles
  };

  /// \param least_height of a new triangle, in the unit box
  Surface_refinement(const Triangle_surface& surface, const std::vector<Surface_curve>& curves,
                     const std::vector<std::size_t>& segment_of_face, double least_height)
      : surface_(surface), curves_(curves), is_faulty_(curves.size(), false) {
    cut_edges();
    find_lines(segment_of_face);
    if (has_faults()) return;
    divide_faces(least_height);
    if (has_faults()) return;
    find_segments(segment_of_face);
  }

  const Triangle_surface& surface() const { return surface_; }
  /// Whether each curve is part of a fault; no one, if it is all of them that do not bound the segments.
  const std::vector<char>& faulty_curves() const { return is_faulty_; }
  bool has_faults() const { return has_faults_; }
  /// Along each edge from its source.
  const std::vector<Edge_cut>& edge_cuts() const { return cuts_; }
  const std::vector<Cut_face>& cut_faces() const { return cut_faces_; }
  /// The edges of the surface that curves run along.
  const std::vector<Index>& whole_edges() const { return whole_edges_; }
  /// Of a face that is not cut.
  std::size_t segment_of_face(Index face) const { return segment_of_piece_[face]; }
  /// Of the triangle with this number in a face that is cut.
  std::size_t segment_of_triangle(const Cut_face& face, std::size_t triangle) const {
    return segment_of_piece_[face.first_piece + triangle];
  }

 private:
  /// A line from node to node, as the numbers of the nodes.
  struct Line {
    Index from, to;
    std::size_t curve;
  };

  void blame(std::size_t curve) { is_faulty_[curve] = has_faults_ = true; }

  // ---- Nodes ----

  /// Orders the new vertices along the edges, and sees to it that no vertex belongs to two curves.
  void cut_edges() {
    std::vector<std::size_t> user(surface_.number_of_vertices(), no_curve);  // a curve through the vertex
    std::vector<char> is_end(surface_.number_of_vertices(), false);
    for (std::size_t c = 0; c < curves_.size(); ++c)
      for (std::size_t i = 0; i < curves_[c].nodes.size(); ++i) {
        const Curve_node& node = curves_[c].nodes[i];
        if (!node.is_vertex()) {
          cuts_.push_back({node.edge, node.position, c});
          continue;
        }
        const bool is_this_end = !curves_[c].is_closed && (i == 0 || i + 1 == curves_[c].nodes.size());
        std::size_t& first = user[node.vertex];
        if (first != no_curve && !(is_this_end && is_end[node.vertex])) {
          blame(first);
          blame(c);
        }
        first = c;
        is_end[node.vertex] = is_this_end;
      }
    std::sort(cuts_.begin(), cuts_.end());
    for (std::size_t k = 1; k < cuts_.size(); ++k)
      if (cuts_[k].edge == cuts_[k - 1].edge && cuts_[k].position == cuts_[k - 1].position) {
        blame(cuts_[k].curve);
        blame(cuts_[k - 1].curve);
      }
  }

  /// The first cut on an edge and the number of them.
  std::pair<std::size_t, std::size_t> cuts_on(Index edge) const {
    const auto begin =
        std::lower_bound(cuts_.begin(), cuts_.end(), edge, [](const Edge_cut& cut, Index e) { return cut.edge < e; });
    auto end = begin;
    while (end != cuts_.end() && end->edge == edge) ++end;
    return {static_cast<std::size_t>(begin - cuts_.begin()), static_cast<std::size_t>(end - begin)};
  }

  Index number_of(const Curve_node& node, std::size_t curve) const {
    if (node.is_vertex()) return node.vertex;
    const auto cut = std::lower_bound(cuts_.begin(), cuts_.end(), Edge_cut{node.edge, node.position, curve});
    return static_cast<Index>(surface_.number_of_vertices() + static_cast<std::size_t>(cut - cuts_.begin()));
  }

  // ---- Lines ----

  /// Tells lines along edges of the surface from those across faces.
  void find_lines(const std::vector<std::size_t>& segment_of_face) {
    for (std::size_t c = 0; c < curves_.size(); ++c)
      for (std::size_t i = 0; i < curves_[c].number_of_lines(); ++i) {
        const Curve_node &from = curves_[c].nodes[i], &to = curves_[c].end_of_line(i);
        const bool is_found = from.is_vertex() && to.is_vertex() ? add_edge(from.vertex, to.vertex, c, segment_of_face)
                                                                 : add_line(from, to, c);
        if (!is_found) blame(c);
      }
    std::vector<Index> edges;
    for (const auto& [h, curve] : edge_lines_) edges.push_back(surface_.edge(h));
    std::sort(edges.begin(), edges.end());
    if (std::adjacent_find(edges.begin(), edges.end()) != edges.end())
      for (const auto& [h, curve] : edge_lines_) blame(curve);
    for (const auto& [h, curve] : edge_lines_) {
      const auto [first, number] = cuts_on(surface_.edge(h));
      for (std::size_t k = first; k < first + number; ++k) {
        blame(curve);
        blame(cuts_[k].curve);
      }
    }
    whole_edges_ = std::move(edges);
  }

  /// A line along an edge between two faces: of several between the same vertices, one with the segments of the curve beside
  /// it.
  bool add_edge(Index from, Index to, std::size_t curve, const std::vector<std::size_t>& segment_of_face) {
    Index found = Triangle_surface::none;
    const auto segment_beside = [&](Index h) { return segment_of_face[Triangle_surface::face(h)]; };
    surface_.any_leaving(from, [&](Index h) {
      const Index previous = Triangle_surface::previous(h);
      if (surface_.target(h) == to && !surface_.is_border(h))
        found = h;
      else if (surface_.source(previous) == to && !surface_.is_border(previous))
        found = surface_.twin(previous);
      else
        return false;
      return std::array{segment_beside(found), segment_beside(surface_.twin(found))} == curves_[curve].segments;
    });
    if (found == Triangle_surface::none) return false;
    edge_lines_.emplace_back(found, curve);
    return true;
  }

  /// A line across the face that both nodes lie on.
  bool add_line(const Curve_node& from, const Curve_node& to, std::size_t curve) {
    const Curve_node& on_edge = from.is_vertex() ? to : from;
    const Curve_node& other = from.is_vertex() ? from : to;
    for (const Index h : {on_edge.edge, surface_.twin(on_edge.edge)}) {
      if (h == Triangle_surface::none) continue;
      const Index next = Triangle_surface::next(h), previous = Triangle_surface::previous(h);
      const bool is_opposite = other.is_vertex()
                                   ? other.vertex == surface_.source(previous)
                                   : other.edge == surface_.edge(next) || other.edge == surface_.edge(previous);
      if (!is_opposite) continue;
      lines_of_face_[Triangle_surface::face(h)].push_back({number_of(from, curve), number_of(to, curve), curve});
      return true;
    }
    return false;
  }

  // ---- Faces ----

  /// The vertices round a face, with the new ones.
  std::vector<Index> corners_of(Index face) const {
    std::vector<Index> corners;
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
      corners.push_back(surface_.source(h));
      const auto [first, number] = cuts_on(surface_.edge(h));
      for (std::size_t k = 0; k < number; ++k)
        corners.push_back(
            static_cast<Index>(surface_.number_of_vertices() + first + (surface_.edge(h) == h ? k : number - 1 - k)));
    }
    return corners;
  }

  Eigen::Vector3d point(Index number) const {
    if (number < surface_.number_of_vertices()) return surface_.point(number);
    const Edge_cut& cut = cuts_[number - surface_.number_of_vertices()];
    return surface_.point_on(cut.edge, cut.position);
  }

  void divide_faces(double least_height) {
    for (const Edge_cut& cut : cuts_)
      for (const Index h : {cut.edge, surface_.twin(cut.edge)})
        if (h != Triangle_surface::none) lines_of_face_[Triangle_surface::face(h)];
    place_in_cut_faces_.assign(surface_.number_of_faces(), Triangle_surface::none);
    std::size_t pieces = surface_.number_of_faces();
    for (const auto& [face, lines] : lines_of_face_) {
      const std::vector<Index> corners = corners_of(face);
      std::vector<Eigen::Vector3d> points;
      for (const Index corner : corners) points.push_back(point(corner));
      std::vector<Divided_triangle::Chord> chords;
      for (const Line& line : lines) {
        const auto place = [&](Index node) {
          return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), node) - corners.begin());
        };
        chords.push_back({place(line.from), place(line.to)});
      }
      Divided_triangle division(points, chords);
      // What is wrong in a face is laid to all curves in it.
      if (!(division.least_height() > least_height)) {
        for (const Line& line : lines) blame(line.curve);
        for (const Index corner : corners)
          if (corner >= surface_.number_of_vertices()) blame(cuts_[corner - surface_.number_of_vertices()].curve);
      }
      place_in_cut_faces_[face] = static_cast<Index>(cut_faces_.size());
      const std::size_t triangles = corners.size() - 2;
      cut_faces_.push_back({face, corners, std::move(division), pieces});
      pieces += triangles;
    }
    number_of_pieces_ = pieces;
  }

  // ---- Segments ----

  /// The piece at the k-th part of a side of a face.
  std::size_t piece_at(Index h, std::size_t k) const {
    const Index f = Triangle_surface::face(h);
    if (!is_cut(f)) return f;
    for (Index side = 3 * f; side < h; ++side) k += cuts_on(surface_.edge(side)).second + 1;
    const Cut_face& cut = cut_faces_[place_in_cut_faces_[f]];
    return cut.first_piece + cut.division.triangle_at_side(k);
  }

  bool is_cut(Index face) const { return place_in_cut_faces_[face] != Triangle_surface::none; }

  using Sets = boost::disjoint_sets_with_storage<>;

  /// Calls `visit(h)` for a halfedge of each edge between two faces.
  template <class Visitor>
  void for_each_inner_edge(const Visitor& visit) const {
    for (Index h = 0; h < surface_.number_of_halfedges(); ++h)
      if (surface_.edge(h) == h && !surface_.is_border(h)) visit(h);
  }

  /// The faces that hang together and have one segment.
  Sets connected_faces(const std::vector<std::size_t>& segment_of_face) const {
    Sets sets(surface_.number_of_faces());
    for_each_inner_edge([&](Index h) {
      const Index f = Triangle_surface::face(h), g = Triangle_surface::face(surface_.twin(h));
      if (segment_of_face[f] == segment_of_face[g]) sets.union_set(f, g);
    });
    return sets;
  }

  /// The pieces that hang together without a curve in between.
  Sets connected_pieces() const {
    std::vector<char> is_whole_edge(surface_.number_of_halfedges(), false);
    for (const Index h : whole_edges_) is_whole_edge[h] = true;
    Sets sets(number_of_pieces_);
    for_each_inner_edge([&](Index h) {
      if (is_whole_edge[h]) return;
      const Index twin = surface_.twin(h);
      const bool is_cut_through = is_cut(Triangle_surface::face(h)) && is_cut(Triangle_surface::face(twin));
      const std::size_t cuts = is_cut_through ? cuts_on(h).second : 0;
      for (std::size_t k = 0; k <= cuts; ++k) sets.union_set(piece_at(h, k), piece_at(twin, cuts - k));
    });
    for (const Cut_face& face : cut_faces_)
      for (const auto& [triangle, neighbour] : face.division.joined_triangles())
        sets.union_set(face.first_piece + triangle, face.first_piece + neighbour);
    return sets;
  }

  /// Calls `claim(piece, segment, curve)` for the pieces on both sides of all curves.
  template <class Claim>
  void for_each_side(const Claim& claim) const {
    for (const auto& [h, c] : edge_lines_) {
      claim(piece_at(h, 0), curves_[c].segments[0], c);
      claim(piece_at(surface_.twin(h), 0), curves_[c].segments[1], c);
    }
    for (const Cut_face& face : cut_faces_) {
      const auto& lines = lines_of_face_.at(face.face);
      for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto& [left, right] = face.division.triangles_beside(i);
        claim(face.first_piece + left, curves_[lines[i].curve].segments[0], lines[i].curve);
        claim(face.first_piece + right, curves_[lines[i].curve].segments[1], lines[i].curve);
      }
    }
  }

  /// Fills each piece with the segment that the curves around it say, and compares with the segments before.
  void find_segments(const std::vector<std::size_t>& segment_of_face) {
    Sets after = connected_pieces();
    std::vector<std::size_t> segment(number_of_pieces_), witness(number_of_pieces_, no_curve);
    for_each_side([&](std::size_t piece, std::size_t label, std::size_t curve) {
      const std::size_t set = after.find_set(piece);
      if (witness[set] == no_curve) {
        segment[set] = label;
        witness[set] = curve;
      } else if (segment[set] != label) {
        blame(curve);
        blame(witness[set]);
      }
    });
    if (has_faults()) return;

    Sets before = connected_faces(segment_of_face);
    const std::size_t faces = surface_.number_of_faces();
    std::size_t sets_before = 0, sets_after = 0;
    for (std::size_t f = 0; f < faces; ++f) sets_before += before.find_set(f) == f;
    segment_of_piece_.assign(number_of_pieces_, 0);
    std::vector<char> is_met(number_of_pieces_, false);  // by set: any number may be the id of a segment
    bool is_whole = true;
    for (std::size_t piece = 0; piece < number_of_pieces_; ++piece) {
      if (piece < faces && is_cut(static_cast<Index>(piece))) continue;
      const std::size_t set = after.find_set(piece);
      sets_after += set == piece;
      // A part of the surface without a curve keeps its segment, which must be one. Whole faces come first.
      if (witness[set] == no_curve && !std::exchange(is_met[set], true)) segment[set] = segment_of_face[piece];
      if (witness[set] == no_curve && piece < faces) is_whole = is_whole && segment[set] == segment_of_face[piece];
      segment_of_piece_[piece] = segment[set];
    }
    has_faults_ = !is_whole || sets_before != sets_after;
  }

  static constexpr std::size_t no_curve = std::numeric_limits<std::size_t>::max();

  const Triangle_surface& surface_;
  const std::vector<Surface_curve>& curves_;
  std::vector<char> is_faulty_;
  bool has_faults_ = false;
  std::vector<Edge_cut> cuts_;
  std::vector<std::pair<Index, std::size_t>> edge_lines_;  // a halfedge and its curve
  std::vector<Index> whole_edges_;
  std::map<Index, std::vector<Line>> lines_of_face_;
  std::vector<Cut_face> cut_faces_;
  std::vector<Index> place_in_cut_faces_;  // of each face
  std::size_t number_of_pieces_ = 0;
  std::vector<std::size_t> segment_of_piece_;
};

}  // namespace RW_segmentation::internal

#endif
