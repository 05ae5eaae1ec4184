// SPDX-License-Identifier: MIT

#ifndef SEGMENT_MESH_WALLS_H
#define SEGMENT_MESH_WALLS_H

#include "../mesh_files/Text.h"
#include "../mesh_files/read_content.h"
#include "Options.h"
#include "Oriented_mesh.h"
#include "degree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace segment_mesh {

/// The angle of `--constraints-angle` in radians; infinite without it.
inline double wall_angle_of(const Options& options) {
  return options.constraints_angle ? *options.constraints_angle * degree : std::numeric_limits<double>::infinity();
}

/// An edge that nothing is to cross, as the user gives it.
struct Constraint {
  std::array<std::uint64_t, 2> vertices;  ///< by their numbers in the file of the mesh
  std::string place;                      ///< where it is given: file and line
};

/// The edges of a file with two vertices a line; blank lines and what follows a `#` are passed over.
/// \param path names the file in errors
inline std::vector<Constraint> constraints_in(const std::string& path, std::string_view content) {
  mesh_files::Text text(path, content);
  std::vector<Constraint> constraints;
  while (text.next_line()) {
    const std::uint64_t first = text.count("the first vertex"), second = text.count("the second vertex");
    if (!text.at_end_of_line()) text.fail("an edge has two vertices, and here is more");
    constraints.push_back({{first, second}, path + ":" + std::to_string(text.number_of_line())});
  }
  return constraints;
}

inline std::vector<Constraint> read_constraints(const std::string& path) {
  return constraints_in(path, mesh_files::read_content(path));
}

/// Which edges of a mesh are walls.
using Wall_map = Mesh::Property_map<Mesh::Edge_index, bool>;

/// The walls of a mesh: none at first, and those of the other one where it is a copy.
inline Wall_map wall_map(Mesh& mesh) { return mesh.add_property_map<Mesh::Edge_index, bool>("e:is_wall", false).first; }

/// The edges of a mesh by the places of their ends: repairs join vertices and take them apart, but move none.
class Edges_by_place {
 public:
  explicit Edges_by_place(const Mesh& mesh) {
    edges_.reserve(mesh.number_of_edges());
    for (const auto e : mesh.edges())
      edges_.emplace_back(std::minmax({mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))}), e);
    std::sort(edges_.begin(), edges_.end());
  }

  /// All edges between two places; there are several where surfaces touch.
  std::vector<Mesh::Edge_index> between(const Point& p, const Point& q) const {
    const Ends ends = std::minmax({p, q});
    std::vector<Mesh::Edge_index> found;
    const auto first = std::lower_bound(edges_.begin(), edges_.end(), ends,
                                        [](const auto& entry, const Ends& wanted) { return entry.first < wanted; });
    for (auto entry = first; entry != edges_.end() && entry->first == ends; ++entry) found.push_back(entry->second);
    return found;
  }

 private:
  using Ends = std::pair<Point, Point>;
  std::vector<std::pair<Ends, Mesh::Edge_index>> edges_;
};

/// Marks the edges that the user gives.
/// \param points the vertices of the file
/// \throws std::invalid_argument if there is no such vertex or edge, naming the line
inline void mark_constraints(const std::vector<Point>& points, const std::vector<Constraint>& constraints,
                             const Mesh& mesh, Wall_map walls) {
  if (constraints.empty()) return;
  const Edges_by_place edges(mesh);
  for (const auto& [vertices, place] : constraints) {
    for (const std::uint64_t v : vertices)
      if (v >= points.size())
        throw std::invalid_argument(place + ": the file has " + counted(points.size(), "vertex", "vertices") +
                                    ", the first is vertex 0");
    const auto found = edges.between(points[vertices[0]], points[vertices[1]]);
    if (found.empty())
      throw std::invalid_argument(place + ": no edge of the mesh joins vertex " + std::to_string(vertices[0]) +
                                  " and vertex " + std::to_string(vertices[1]));
    for (const auto e : found) walls[e] = true;
  }
}

/// Marks the edges over which the normal turns by more than an angle. Beside a face without area none is known.
inline void mark_sharp_edges(const Mesh& mesh, double degrees, Wall_map walls) {
  const double extent = extent_of(mesh);
  if (!(extent > 0)) return;
  std::vector<Mesh_vector> normal;
  normal.reserve(mesh.number_of_faces());
  for (const auto f : mesh.faces()) normal.push_back(normal_of_twice_the_area(mesh, f, extent));
  for (const auto e : mesh.edges()) {
    if (mesh.is_border(e)) continue;
    const Mesh_vector &a = normal[mesh.face(mesh.halfedge(e, 0))], &b = normal[mesh.face(mesh.halfedge(e, 1))];
    const double sine = std::sqrt(CGAL::cross_product(a, b).squared_length()), cosine = a * b;
    if (std::atan2(sine, cosine) > degrees * degree) walls[e] = true;
  }
}

}  // namespace segment_mesh

#endif
