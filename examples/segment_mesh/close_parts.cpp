// SPDX-License-Identifier: MIT

// Uses Triangulation_2 and Polygon_mesh_processing of CGAL, which are under the GPL.

#include "close_parts.h"

#include "../mesh_files/Segmented_soup.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

namespace segment_mesh {
namespace {

using Index = mesh_files::Polygon_soup::Index;
using Triangle = std::array<Index, 3>;
using Edge = std::pair<Index, Index>;
using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Flat = Exact::Point_2;

constexpr std::size_t no_label = std::numeric_limits<std::size_t>::max();  // beyond a border of the mesh

Edge edge_of(Index a, Index b) { return std::minmax(a, b); }

/// A closed curve of edges at which a segment ends, in the direction of the faces that close it.
struct Loop {
  std::vector<Index> corners;
  std::vector<std::size_t> neighbours;  ///< the label beyond the edge that starts at each corner
};

/// The plane of a loop, and the loop in it.
struct Frame {
  std::array<Mesh_vector, 3> axes;  ///< two in the plane and its normal, which sees the loop counterclockwise
  Point origin;
  double thickness = 0;  ///< how far corners are off the plane

  Flat flat(const Point& p) const { return {(p - origin) * axes[0], (p - origin) * axes[1]}; }
  double height(const Point& p) const { return (p - origin) * axes[2]; }
};

/// Takes a loop apart where it touches itself.
void add_simple_loops(const Loop& loop, std::vector<Loop>& simple) {
  Loop path;
  std::unordered_map<Index, std::size_t> place;  // of the corners of the path
  const auto cut = [&](std::size_t begin) {
    Loop part;
    part.corners.assign(path.corners.begin() + static_cast<std::ptrdiff_t>(begin), path.corners.end());
    part.neighbours.assign(path.neighbours.begin() + static_cast<std::ptrdiff_t>(begin), path.neighbours.end());
    if (part.corners.size() > 2) simple.push_back(std::move(part));
    for (std::size_t i = begin; i < path.corners.size(); ++i) place.erase(path.corners[i]);
    path.corners.resize(begin);
    path.neighbours.resize(begin);
  };
  for (std::size_t i = 0; i < loop.corners.size(); ++i) {
    if (const auto found = place.find(loop.corners[i]); found != place.end()) cut(std::size_t(found->second));
    place.emplace(loop.corners[i], path.corners.size());
    path.corners.push_back(loop.corners[i]);
    path.neighbours.push_back(loop.neighbours[i]);
  }
  cut(0);
}

/// The loops at which each segment ends.
std::map<std::size_t, std::vector<Loop>> loops_of_segments(const Mesh& mesh, const std::vector<std::size_t>& label) {
  const auto label_beyond = [&](Mesh::Halfedge_index h) {
    const auto face = mesh.face(mesh.opposite(h));
    return face == Mesh::null_face() ? no_label : label[face];
  };
  const auto is_end = [&](Mesh::Halfedge_index h) {
    return !mesh.is_border(h) && label_beyond(h) != label[mesh.face(h)];
  };
  std::map<std::size_t, std::vector<Loop>> loops;
  std::vector<bool> is_visited(mesh.num_halfedges(), false);
  for (const auto first : mesh.halfedges()) {
    if (is_visited[first] || !is_end(first)) continue;
    Loop loop;
    for (auto h = first; !is_visited[h];) {
      is_visited[h] = true;
      loop.corners.push_back(mesh.target(h));
      loop.neighbours.push_back(label_beyond(h));
      for (h = mesh.next(h); !is_end(h);) h = mesh.next(mesh.opposite(h));
    }
    std::reverse(loop.corners.begin(), loop.corners.end());
    std::reverse(loop.neighbours.begin(), loop.neighbours.end());
    add_simple_loops(loop, loops[label[mesh.face(first)]]);
  }
  return loops;
}

/// The loop from its lowest corner on towards the lower of that one's neighbours, so that it is the same from both sides.
/// \returns whether it was turned around
bool make_canonical(std::vector<Index>& corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  if (corners[1] < corners.back()) return false;
  std::reverse(corners.begin() + 1, corners.end());
  return true;
}

/// Makes triangles that close loops.
class Cap_builder {
 public:
  /// \param points of the loops; further ones may be added
  explicit Cap_builder(std::vector<Point>& points) : points_(points) {}

  Frame frame_of(const std::vector<Index>& loop) const {
    Frame frame;
    Mesh_vector sum = CGAL::NULL_VECTOR, normal = CGAL::NULL_VECTOR;
    const Point& first = points_[loop[0]];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Mesh_vector p = points_[loop[i]] - first, q = points_[loop[(i + 1) % loop.size()]] - first;
      sum = sum + p;
      normal = normal + CGAL::cross_product(p, q);
    }
    frame.origin = first + sum / double(loop.size());
    const double length = CGAL::approximate_sqrt(normal.squared_length());
    if (length > 0) {
      const Mesh_vector n = normal / length;
      const Mesh_vector least =
          std::abs(n.x()) <= std::abs(n.y()) && std::abs(n.x()) <= std::abs(n.z())
              ? Mesh_vector(1, 0, 0)
              : (std::abs(n.y()) <= std::abs(n.z()) ? Mesh_vector(0, 1, 0) : Mesh_vector(0, 0, 1));
      const Mesh_vector u = CGAL::cross_product(least, n);
      frame.axes[0] = u / CGAL::approximate_sqrt(u.squared_length());
      frame.axes[1] = CGAL::cross_product(n, frame.axes[0]);
      frame.axes[2] = n;
    } else {
      frame.axes.fill(CGAL::NULL_VECTOR);
    }
    for (const Index corner : loop)
      frame.thickness = std::max(frame.thickness, std::abs(frame.height(points_[corner])));
    return frame;
  }

  /// Whether a loop lies within another one and in its plane, as far as that one is flat.
  bool is_within(const std::vector<Index>& inner, const Frame& inner_frame, const std::vector<Index>& outer,
                 const Frame& outer_frame) const {
    constexpr double rounding = 1e-9;
    const Mesh_vector reach = points_[outer[0]] - outer_frame.origin;
    const double tolerance =
        outer_frame.thickness + inner_frame.thickness + rounding * CGAL::approximate_sqrt(reach.squared_length());
    if (std::abs(outer_frame.height(points_[inner[0]])) > tolerance) return false;
    std::vector<Flat> polygon;
    for (const Index corner : outer) polygon.push_back(outer_frame.flat(points_[corner]));
    return std::all_of(inner.begin(), inner.end(), [&](Index corner) {
      const Point& p = points_[corner];
      return std::abs(outer_frame.height(p)) <= tolerance &&
             CGAL::bounded_side_2(polygon.begin(), polygon.end(), outer_frame.flat(p), Exact()) ==
                 CGAL::ON_BOUNDED_SIDE;
    });
  }

  /// The triangles between a loop and those in its plane within it; none if they cross each other.
  std::vector<Triangle> cap(std::vector<Index> outer, std::vector<std::vector<Index>> holes) {
    const bool is_turned = make_canonical(outer);
    for (auto& hole : holes) make_canonical(hole);
    std::sort(holes.begin(), holes.end());
    std::vector<Triangle> triangles = flat_cap(outer, holes);
    if (triangles.empty() && holes.empty()) triangles = curved_cap(outer);
    if (triangles.empty() && holes.empty()) triangles = fan(outer);
    if (is_turned)
      for (auto& [a, b, c] : triangles) std::swap(a, b);
    return triangles;
  }

 private:
  using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<Index, Exact>;
  using Structure =
      CGAL::Triangulation_data_structure_2<Vertex_base, CGAL::Constrained_triangulation_face_base_2<Exact>>;
  using Triangulation =
      CGAL::Constrained_Delaunay_triangulation_2<Exact, Structure, CGAL::No_constraint_intersection_tag>;

  /// Those of the constrained Delaunay triangulation that lie between the loops; none if the loops cross or touch each other
  /// or themselves in the plane of the outer one.
  std::vector<Triangle> flat_cap(const std::vector<Index>& outer, const std::vector<std::vector<Index>>& holes) const {
    const Frame frame = frame_of(outer);
    if (frame.axes[2] == CGAL::NULL_VECTOR) return {};
    Triangulation plane;
    std::size_t corners = 0;
    std::vector<std::vector<Triangulation::Vertex_handle>> loops;
    const auto insert = [&](const std::vector<Index>& loop) {
      auto& vertices = loops.emplace_back();
      for (const Index corner : loop) {
        vertices.push_back(plane.insert(frame.flat(points_[corner])));
        vertices.back()->info() = corner;
      }
      corners += loop.size();
    };
    insert(outer);
    for (const auto& hole : holes) insert(hole);
    if (plane.number_of_vertices() != corners) return {};  // some fell onto each other
    try {
      for (const auto& vertices : loops)
        for (std::size_t i = 0; i < vertices.size(); ++i)
          plane.insert_constraint(vertices[i], vertices[(i + 1) % vertices.size()]);
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
      return {};
    }
    std::vector<Triangle> inside = inside_of(plane);
    // Each hole adds two triangles. Another number of them means that corners fell onto edges.
    return inside.size() + 2 == corners + 2 * holes.size() ? inside : std::vector<Triangle>();
  }

  /// The triangles that a path from outside reaches over an odd number of constraints.
  static std::vector<Triangle> inside_of(const Triangulation& plane) {
    std::map<Triangulation::Face_handle, bool> is_inside = {{plane.infinite_face(), false}};
    std::vector<Triangulation::Face_handle> open = {plane.infinite_face()};
    std::vector<Triangle> triangles;
    while (!open.empty()) {
      const auto face = open.back();
      open.pop_back();
      const bool is_here = is_inside[face];
      if (is_here) triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
      for (int i = 0; i < 3; ++i)
        if (is_inside.emplace(face->neighbor(i), is_here != face->is_constrained(i)).second)
          open.push_back(face->neighbor(i));
    }
    return triangles;
  }

  /// What CGAL's hole filling makes of a loop; nothing if it gives up.
  std::vector<Triangle> curved_cap(const std::vector<Index>& loop) const {
    constexpr std::size_t most_corners_for_all_triangles = 300;  // the time grows with their cube
    std::vector<Exact::Point_3> corners;
    for (const Index corner : loop) corners.emplace_back(points_[corner].x(), points_[corner].y(), points_[corner].z());
    std::vector<CGAL::Triple<int, int, int>> found;  // as CGAL makes them
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
        corners, std::back_inserter(found),
        CGAL::parameters::use_delaunay_triangulation(true).do_not_use_cubic_algorithm(corners.size() >
                                                                                      most_corners_for_all_triangles));
    std::vector<Triangle> triangles;
    for (const auto& t : found)
      triangles.push_back({loop[std::size_t(t.first)], loop[std::size_t(t.second)], loop[std::size_t(t.third)]});
    const bool turns_as_the_loop = std::any_of(triangles.begin(), triangles.end(),
                                               [&](const Triangle& t) { return has_side(t, loop[0], loop[1]); });
    if (!turns_as_the_loop)
      for (auto& [a, b, c] : triangles) std::swap(a, b);
    return triangles.size() + 2 == loop.size() ? triangles : std::vector<Triangle>();
  }

  /// A triangle from each edge to a new point in the middle.
  std::vector<Triangle> fan(const std::vector<Index>& loop) {
    const auto middle = static_cast<Index>(points_.size());
    points_.push_back(frame_of(loop).origin);
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < loop.size(); ++i) triangles.push_back({loop[i], loop[(i + 1) % loop.size()], middle});
    return triangles;
  }

  static bool has_side(const Triangle& t, Index from, Index to) {
    for (std::size_t i = 0; i < 3; ++i)
      if (t[i] == from && t[(i + 1) % 3] == to) return true;
    return false;
  }

  std::vector<Point>& points_;
};

/// Loops that get a cap together: one, and those that are holes of it.
struct Cap_outline {
  std::vector<Index> outer;
  std::vector<std::vector<Index>> holes;
};

/// The outlines of the caps between a segment and one neighbour, or of those towards several.
std::vector<Cap_outline> outlines_of(const std::vector<const Loop*>& loops, const Cap_builder& caps) {
  std::vector<Frame> frames;
  for (const Loop* loop : loops) frames.push_back(caps.frame_of(loop->corners));
  std::vector<std::vector<std::size_t>> around(loops.size());  // the loops within which each lies
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (std::size_t j = 0; j < loops.size(); ++j)
      if (i != j && caps.is_within(loops[i]->corners, frames[i], loops[j]->corners, frames[j])) around[i].push_back(j);

  std::vector<Cap_outline> outlines;
  std::map<std::size_t, std::size_t> outline_of;
  const auto is_outer = [&](std::size_t i) { return around[i].size() % 2 == 0; };
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (is_outer(i)) {
      outline_of[i] = outlines.size();
      outlines.push_back({loops[i]->corners, {}});
    }
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (is_outer(i)) continue;
    // The innermost of those around it lies within all others.
    const std::size_t next = *std::max_element(around[i].begin(), around[i].end(), [&](std::size_t a, std::size_t b) {
      return around[a].size() < around[b].size();
    });
    const bool is_hole = outline_of.count(next) > 0 && frames[i].axes[2] * frames[next].axes[2] < 0;
    if (is_hole)
      outlines[outline_of[next]].holes.push_back(loops[i]->corners);
    else
      outlines.push_back({loops[i]->corners, {}});
  }
  return outlines;
}

/// The edges of a part. Triangles of caps whose common edge is there already are divided at its middle, so that every edge
/// keeps two faces.
class Edges_of_part {
 public:
  explicit Edges_of_part(std::vector<Point>& points) : points_(points) {}

  template <class Corners>
  void add_face(const Corners& corners) {
    Index before = *(std::end(corners) - 1);
    for (const Index corner : corners) edges_.insert(edge_of(std::exchange(before, corner), corner));
  }

  void add_cap(std::vector<Triangle>& triangles) {
    std::map<Edge, int> sides;
    for (const Triangle& t : triangles)
      for (std::size_t i = 0; i < 3; ++i) ++sides[edge_of(t[i], t[(i + 1) % 3])];
    for (const auto& [edge, times] : sides)
      if (times == 2 && edges_.count(edge) > 0) divide(edge, triangles);
    for (const Triangle& t : triangles) add_face(t);
  }

 private:
  void divide(const Edge& edge, std::vector<Triangle>& triangles) {
    const auto middle = static_cast<Index>(points_.size());
    points_.push_back(CGAL::midpoint(points_[edge.first], points_[edge.second]));
    const std::size_t before = triangles.size();
    for (std::size_t k = 0; k < before; ++k)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [a, b, c] = Triangle{triangles[k][i], triangles[k][(i + 1) % 3], triangles[k][(i + 2) % 3]};
        if (edge_of(a, b) != edge) continue;
        triangles[k] = {a, middle, c};
        triangles.push_back({middle, b, c});
        break;
      }
  }

  std::vector<Point>& points_;
  std::set<Edge> edges_;
};

/// The volume between faces and a point, and their area.
struct Measures {
  double volume = 0, area = 0;

  template <class Corners>
  void add(const Corners& corners, const std::vector<Point>& points, const Point& origin) {
    const Mesh_vector a = points[*corners.begin()] - origin;
    Mesh_vector b = a;
    for (const Index corner : corners) {
      const Mesh_vector c = points[corner] - origin;
      volume += CGAL::determinant(a, b, c) / 6;
      area += CGAL::approximate_sqrt(CGAL::cross_product(b - a, c - a).squared_length()) / 2;
      b = c;
    }
  }
};

/// What the faces of each segment enclose, as seen from one of the points.
std::map<std::size_t, Measures> measures_of(const mesh_files::Polygon_soup& soup,
                                            const std::vector<std::size_t>& label) {
  std::map<std::size_t, Measures> measures;
  for (std::size_t f = 0; f < label.size(); ++f) measures[label[f]].add(soup.face(f), soup.points, soup.points[0]);
  return measures;
}

void add_remarks(Closed_parts& result, double volume_of_mesh, bool is_mesh_closed) {
  constexpr double rounding = 1e-9;
  std::size_t open = 0, flat = 0;
  double sum = 0;
  for (const auto& [label, part] : result.parts) {
    open += !part.is_closed;
    flat += part.is_flat;
    sum += part.volume;
  }
  if (open > 0)
    result.remarks.push_back(counted(open, "part is", "parts are") + " not closed, since the mesh has a border there");
  if (flat > 0)
    result.remarks.push_back(counted(flat, "closed part is", "closed parts are") + " flat, with nothing inside");
  if (is_mesh_closed && std::abs(sum - volume_of_mesh) > rounding * std::abs(volume_of_mesh))
    result.remarks.push_back(
        "the closed parts have " + std::to_string(100 * sum / volume_of_mesh) +
        " % of the volume of the mesh: where three or more meet, their caps leave gaps or overlap");
}

/// The outlines of all caps of a segment.
/// \param is_open set if a loop runs along the border of the mesh
std::vector<Cap_outline> outlines_of_segment(const std::vector<Loop>& loops, const Cap_builder& caps, bool& is_open) {
  std::map<std::size_t, std::vector<const Loop*>> loops_towards;  // each neighbour
  std::vector<Cap_outline> outlines;
  for (const Loop& loop : loops) {
    const auto& beyond = loop.neighbours;
    if (std::find(beyond.begin(), beyond.end(), no_label) != beyond.end())
      is_open = true;
    else if (std::all_of(beyond.begin(), beyond.end(), [&](std::size_t n) { return n == beyond[0]; }))
      loops_towards[beyond[0]].push_back(&loop);
    else
      outlines.push_back({loop.corners, {}});
  }
  for (const auto& [neighbour, together] : loops_towards)
    for (Cap_outline& outline : outlines_of(together, caps)) outlines.push_back(std::move(outline));
  return outlines;
}

/// Adds the caps of a segment to the soup.
/// \returns how many
std::size_t add_caps(std::size_t segment, const std::vector<std::size_t>& faces,
                     const std::vector<Cap_outline>& outlines, Cap_builder& caps, Closed_parts& result) {
  mesh_files::Polygon_soup& soup = result.soup;
  Edges_of_part edges(soup.points);
  for (const std::size_t f : faces) edges.add_face(soup.face(f));
  std::size_t number = 0;
  const auto close = [&](const std::vector<Index>& outer, const std::vector<std::vector<Index>>& holes) {
    std::vector<Triangle> cap = caps.cap(outer, holes);
    edges.add_cap(cap);
    for (const Triangle& t : cap) {
      soup.corners.insert(soup.corners.end(), t.begin(), t.end());
      soup.end_face();
      result.label.push_back(segment);
    }
    number += !cap.empty();
    return !cap.empty();
  };
  for (const auto& [outer, holes] : outlines) {
    if (close(outer, holes)) continue;
    close(outer, {});
    for (const auto& hole : holes) close(hole, {});
  }
  return number;
}

}  // namespace

Closed_parts closed_parts(const Mesh& mesh, const std::vector<std::size_t>& label) {
  Closed_parts result;
  result.soup = soup_of(mesh);
  result.label = label;
  if (label.empty()) return result;
  double volume_of_mesh = 0;
  for (const auto& [segment, measures] : measures_of(result.soup, label)) volume_of_mesh += measures.volume;

  auto loops = loops_of_segments(mesh, label);
  Cap_builder caps(result.soup.points);
  bool is_any_open = false;
  for (const auto& [segment, faces] : mesh_files::faces_of_labels(label)) {
    bool is_open = false;
    const std::vector<Cap_outline> outlines = outlines_of_segment(loops[segment], caps, is_open);
    result.parts[segment].caps = add_caps(segment, faces, outlines, caps, result);
    result.parts[segment].is_closed = !is_open;
    is_any_open = is_any_open || is_open;
  }

  constexpr double flat = 1e-9;  // a volume beside that of a cube of the same area
  for (const auto& [segment, measures] : measures_of(result.soup, result.label)) {
    Closed_part& part = result.parts[segment];
    if (!part.is_closed) continue;
    part.volume = measures.volume;
    part.is_flat = std::abs(measures.volume) <= flat * std::pow(measures.area / 6, 1.5);
  }
  add_remarks(result, volume_of_mesh, !is_any_open);
  return result;
}

}  // namespace segment_mesh
