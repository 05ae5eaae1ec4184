// SPDX-License-Identifier: MIT

#include "read_mesh.h"

#include "turn_outward.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace rw_python {
namespace {

/// Faces by the vertices at their corners.
struct Faces {
  std::vector<Index> corners;
  std::vector<Index> begin = {0};  ///< the first corner of each face, and the end of the last

  std::size_t size() const { return begin.size() - 1; }
  Index following(std::size_t face, Index corner) const {
    return corner + 1 == begin[face + 1] ? begin[face] : corner + 1;
  }
};

std::string text(std::size_t number) { return std::to_string(number); }

/// "3 faces", "1 face"; an irregular plural is given.
std::string counted(std::size_t number, const std::string& singular, const std::string& plural = "") {
  return text(number) + " " + (number == 1 ? singular : plural.empty() ? singular + "s" : plural);
}

void require_number(std::size_t number, const char* what) {
  if (number >= none / 2) throw std::invalid_argument("there are too many " + std::string(what) + ": " + text(number));
}

/// \throws std::invalid_argument if the offsets do not rise from 0 to the number of corners
std::vector<Index> begins_of(const Polygons& polygons) {
  std::vector<Index> begin;
  begin.reserve(polygons.number_of_faces + 1);
  for (std::size_t f = 0; f <= polygons.number_of_faces; ++f) {
    if (!polygons.offsets) {
      begin.push_back(static_cast<Index>(f * polygons.degree));
      continue;
    }
    const std::int64_t offset = polygons.offsets[f];
    const std::int64_t least = f == 0 ? 0 : polygons.offsets[f - 1];
    if (offset < least || offset > static_cast<std::int64_t>(polygons.number_of_corners) || (f == 0 && offset != 0))
      throw std::invalid_argument("offset " + text(f) + " is " + std::to_string(offset) +
                                  ", but offsets must rise from 0 to the number of corners, " +
                                  text(polygons.number_of_corners));
    begin.push_back(static_cast<Index>(offset));
  }
  if (begin.back() != polygons.number_of_corners)
    throw std::invalid_argument("the last offset is " + text(begin.back()) + ", but must be the number of corners, " +
                                text(polygons.number_of_corners));
  return begin;
}

/// \throws std::invalid_argument if a corner is no vertex
Faces faces_of(const Polygons& polygons, std::size_t number_of_vertices) {
  require_number(polygons.number_of_corners, "corners");
  require_number(number_of_vertices, "vertices");
  Faces faces;
  faces.begin = begins_of(polygons);
  faces.corners.resize(polygons.number_of_corners);
  std::visit(
      [&](const auto* corners) {
        for (std::size_t c = 0; c < faces.corners.size(); ++c) {
          // A negative number becomes an enormous one.
          if (static_cast<std::uint64_t>(corners[c]) >= number_of_vertices) {
            const auto face = std::upper_bound(faces.begin.begin(), faces.begin.end(), c) - faces.begin.begin() - 1;
            throw std::invalid_argument("face " + std::to_string(face) + " has a corner at vertex " +
                                        std::to_string(corners[c]) + ", but there are " +
                                        counted(number_of_vertices, "vertex", "vertices") + ", the first is vertex 0");
          }
          faces.corners[c] = static_cast<Index>(corners[c]);
        }
      },
      polygons.corners);
  return faces;
}

/// \throws std::invalid_argument if a coordinate of a corner is not finite
void require_finite(const Coordinates& coordinates, const Faces& faces) {
  std::vector<char> is_used(coordinates.number, false);
  for (const Index v : faces.corners) is_used[v] = true;
  std::visit(
      [&](const auto* rows) {
        for (std::size_t v = 0; v < is_used.size(); ++v)
          if (is_used[v] &&
              !(std::isfinite(rows[3 * v]) && std::isfinite(rows[3 * v + 1]) && std::isfinite(rows[3 * v + 2])))
            throw std::invalid_argument("vertex " + text(v) + " has a coordinate that is not finite");
      },
      coordinates.rows);
}

bool has_distinct_corners(const Index* first, const Index* last) {
  if (last - first < 3) return false;
  if (last - first == 3) return first[0] != first[1] && first[1] != first[2] && first[2] != first[0];
  std::vector<Index> sorted(first, last);
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

/// Calls `visit(first, last)` with the corners from which the edges between two vertices run, for each pair of vertices
/// that an edge joins.
template <class Visit>
void for_each_edge(const Faces& faces, std::size_t number_of_vertices, const Visit& visit) {
  std::vector<Index> begin(number_of_vertices + 1, 0);
  const auto for_each_corner = [&](const auto& act) {
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (Index c = faces.begin[f]; c < faces.begin[f + 1]; ++c) {
        const auto [low, high] = std::minmax(faces.corners[c], faces.corners[faces.following(f, c)]);
        act(low, high, c);
      }
  };
  for_each_corner([&](Index low, Index, Index) { ++begin[low + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::pair<Index, Index>> edges(faces.corners.size());  // the higher vertex and the corner
  std::vector<Index> end(begin.begin(), begin.end() - 1);
  for_each_corner([&](Index low, Index high, Index corner) { edges[end[low]++] = {high, corner}; });
  std::vector<Index> alike;
  for (std::size_t v = 0; v < number_of_vertices; ++v) {
    std::sort(edges.begin() + begin[v], edges.begin() + begin[v + 1]);
    for (std::size_t i = begin[v]; i < begin[v + 1];) {
      alike.clear();
      const Index high = edges[i].first;
      for (; i < begin[v + 1] && edges[i].first == high; ++i) alike.push_back(edges[i].second);
      visit(alike.data(), alike.data() + alike.size());
    }
  }
}

/// How corners find the corner on the other side of the edge that runs from them.
struct Twins {
  std::vector<Index> of_corner;  ///< `none` on the border
  std::string fault;             ///< why the faces do not form an oriented surface; empty if they do
};

Twins twins_of(const Faces& faces, std::size_t number_of_vertices) {
  Twins twins;
  twins.of_corner.assign(faces.corners.size(), none);
  for (std::size_t f = 0; f < faces.size() && twins.fault.empty(); ++f)
    if (!has_distinct_corners(&faces.corners[faces.begin[f]], faces.corners.data() + faces.begin[f + 1]))
      twins.fault = "face " + text(f) + " has no three different corners, or one of them twice";
  for_each_edge(faces, number_of_vertices, [&](const Index* first, const Index* last) {
    if (last - first == 1) return;
    if (last - first == 2 && faces.corners[first[0]] != faces.corners[first[1]]) {
      twins.of_corner[first[0]] = first[1];
      twins.of_corner[first[1]] = first[0];
    } else if (twins.fault.empty()) {
      twins.fault = last - first == 2 ? "two neighbouring faces at vertex " + text(faces.corners[first[0]]) +
                                            " look to opposite sides"
                                      : text(static_cast<std::size_t>(last - first)) +
                                            " faces meet at an edge of vertex " + text(faces.corners[first[0]]);
    }
  });
  return twins;
}

using Position = std::array<double, 3>;

Position position(const Coordinates& coordinates, Index v) {
  // Negative zero is zero.
  return {coordinates(v, 0) + 0., coordinates(v, 1) + 0., coordinates(v, 2) + 0.};
}

/// Whether two border edges lie between the same two points.
bool has_coinciding_border_edges(const Coordinates& coordinates, const Faces& faces, const std::vector<Index>& twins) {
  std::vector<std::pair<Position, Position>> border;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (Index c = faces.begin[f]; c < faces.begin[f + 1]; ++c)
      if (twins[c] == none)
        border.push_back(std::minmax(position(coordinates, faces.corners[c]),
                                     position(coordinates, faces.corners[faces.following(f, c)])));
  std::sort(border.begin(), border.end());
  return std::adjacent_find(border.begin(), border.end()) != border.end();
}

/// Names vertices with equal coordinates by the first of them.
/// \returns how many were merged into others
std::size_t merge_vertices(const Coordinates& coordinates, std::vector<Index>& corners) {
  std::vector<Index> order = corners;
  std::sort(order.begin(), order.end());
  order.erase(std::unique(order.begin(), order.end()), order.end());
  std::sort(order.begin(), order.end(), [&](Index v, Index w) {
    return std::tuple(position(coordinates, v), v) < std::tuple(position(coordinates, w), w);
  });
  std::vector<Index> representative(coordinates.number, none);
  std::size_t merged = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_first = i == 0 || position(coordinates, order[i]) != position(coordinates, order[i - 1]);
    representative[order[i]] = is_first ? order[i] : representative[order[i - 1]];
    merged += !is_first;
  }
  for (Index& v : corners) v = representative[v];
  return merged;
}

/// The corners of a face from the lowest vertex on, towards its lower neighbour: the same for all copies of a face.
std::vector<Index> canonical(const Index* first, const Index* last) {
  std::vector<Index> corners(first, last);
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  if (corners[1] > corners.back()) std::reverse(corners.begin() + 1, corners.end());
  return corners;
}

/// The faces that can be part of a surface, without copies of others.
/// \param kept output, the number of each of them among all
Faces sound_faces(const Faces& all, std::vector<Index>& kept) {
  std::vector<std::pair<std::vector<Index>, Index>> keys;
  for (std::size_t f = 0; f < all.size(); ++f) {
    std::vector<Index> corners;
    for (Index c = all.begin[f]; c < all.begin[f + 1]; ++c)
      if (corners.empty() || corners.back() != all.corners[c]) corners.push_back(all.corners[c]);
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (has_distinct_corners(corners.data(), corners.data() + corners.size()))
      keys.emplace_back(canonical(corners.data(), corners.data() + corners.size()), static_cast<Index>(f));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<char> is_kept(all.size(), false);
  for (std::size_t i = 0; i < keys.size(); ++i) is_kept[keys[i].second] = i == 0 || keys[i].first != keys[i - 1].first;
  Faces sound;
  for (std::size_t f = 0; f < all.size(); ++f) {
    if (!is_kept[f]) continue;
    kept.push_back(static_cast<Index>(f));
    const std::size_t begin = sound.corners.size();
    for (Index c = all.begin[f]; c < all.begin[f + 1]; ++c)
      if (sound.corners.size() == begin || sound.corners.back() != all.corners[c])
        sound.corners.push_back(all.corners[c]);
    while (sound.corners.back() == sound.corners[begin] && sound.corners.size() > begin + 1) sound.corners.pop_back();
    sound.begin.push_back(static_cast<Index>(sound.corners.size()));
  }
  return sound;
}

/// Where two faces meet at an edge.
struct Neighbour {
  Index face;
  bool looks_opposite;  ///< the two run along the edge in the same direction
};

/// Turns faces so that neighbours look to the same side, as far as that can be; the first face of each part stays.
/// \returns how many were turned, and at how many edges more than two faces meet
std::pair<std::size_t, std::size_t> orient_alike(Faces& faces, std::size_t number_of_vertices) {
  std::vector<Index> face_of(faces.corners.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    std::fill(face_of.begin() + faces.begin[f], face_of.begin() + faces.begin[f + 1], static_cast<Index>(f));
  std::vector<std::vector<Neighbour>> neighbours(faces.size());
  std::size_t crowded_edges = 0;
  for_each_edge(faces, number_of_vertices, [&](const Index* first, const Index* last) {
    crowded_edges += last - first > 2;
    if (last - first != 2) return;
    const bool looks_opposite = faces.corners[first[0]] == faces.corners[first[1]];
    neighbours[face_of[first[0]]].push_back({face_of[first[1]], looks_opposite});
    neighbours[face_of[first[1]]].push_back({face_of[first[0]], looks_opposite});
  });
  std::vector<char> is_met(faces.size(), false), is_turned(faces.size(), false);
  std::vector<Index> open;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (is_met[f]) continue;
    is_met[f] = true;
    for (open.push_back(static_cast<Index>(f)); !open.empty();) {
      const Index face = open.back();
      open.pop_back();
      for (const Neighbour& neighbour : neighbours[face]) {
        if (is_met[neighbour.face]) continue;
        is_met[neighbour.face] = true;
        is_turned[neighbour.face] = static_cast<char>(is_turned[face] != neighbour.looks_opposite);
        open.push_back(neighbour.face);
      }
    }
  }
  std::size_t turned = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!is_turned[f]) continue;
    ++turned;
    std::reverse(faces.corners.begin() + faces.begin[f], faces.corners.begin() + faces.begin[f + 1]);
  }
  return {turned, crowded_edges};
}

/// Makes faces into such that form an oriented surface.
Faces repaired(const Coordinates& coordinates, Faces faces, Read_mesh& result) {
  const std::size_t number_of_faces = faces.size();
  const std::size_t merged = merge_vertices(coordinates, faces.corners);
  if (merged > 0)
    result.remarks.push_back("merged " + counted(merged, "vertex", "vertices") + " into others with equal coordinates");
  std::vector<Index> kept;
  faces = sound_faces(faces, kept);
  const auto [turned, crowded_edges] = orient_alike(faces, coordinates.number);
  if (crowded_edges > 0)
    result.remarks.push_back("cut the surface along " + counted(crowded_edges, "edge") +
                             " where more than two faces meet");
  if (turned > 0) result.remarks.push_back("turned " + counted(turned, "face") + " to match the neighbours");
  const std::size_t left_out = number_of_faces - kept.size();
  if (left_out > 0) {
    result.mesh_face.assign(number_of_faces, none);
    for (std::size_t f = 0; f < kept.size(); ++f) result.mesh_face[kept[f]] = static_cast<Index>(f);
    result.remarks.push_back("left " + counted(left_out, "face") +
                             " out, without three different corners or equal to another one: such a face gets what the "
                             "closest face has");
  }
  return faces;
}

/// Numbers halfedges by edges, and these in the order in which the faces come to them, as Surface_mesh does.
void join(const Faces& faces, const std::vector<Index>& twins, Array_mesh& mesh) {
  std::vector<Index> halfedge(faces.corners.size());
  std::size_t halfedges = 0;
  for (Index c = 0; c < halfedge.size(); ++c) {
    if (twins[c] != none && twins[c] < c) continue;
    halfedge[c] = static_cast<Index>(halfedges);
    if (twins[c] != none) halfedge[twins[c]] = static_cast<Index>(halfedges + 1);
    halfedges += 2;
    require_number(halfedges / 2, "edges");
  }
  for (auto* values : {&mesh.next, &mesh.target, &mesh.face}) values->assign(halfedges, none);
  mesh.halfedge_of_face.reserve(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (Index c = faces.begin[f]; c < faces.begin[f + 1]; ++c) {
      const Index following = faces.following(f, c);
      mesh.next[halfedge[c]] = halfedge[following];
      mesh.target[halfedge[c]] = faces.corners[following];
      mesh.face[halfedge[c]] = static_cast<Index>(f);
    }
    mesh.halfedge_of_face.push_back(halfedge[faces.begin[f + 1] - 1]);
  }
}

/// The halfedges with a face that end where a given one does and hang together with it by edges.
void find_fan(const Array_mesh& mesh, Index halfedge, std::vector<Index>& fan) {
  fan = {halfedge};
  for (Index h = mesh.next[halfedge] ^ 1; h != halfedge; h = mesh.next[h] ^ 1) {
    if (mesh.face[h] == none) {  // the rest is on the other side
      for (Index g = halfedge; mesh.face[g ^ 1] != none;) fan.push_back(g = mesh.previous(g ^ 1));
      return;
    }
    fan.push_back(h);
  }
}

/// Gives each fan of faces round a vertex a vertex of its own.
void part_fans(Array_mesh& mesh) {
  std::vector<char> is_met(mesh.number_of_halfedges(), false), is_taken(mesh.coordinates.number, false);
  std::vector<Index> fan;
  for (Index h = 0; h < mesh.number_of_halfedges(); ++h) {
    if (is_met[h] || mesh.face[h] == none) continue;
    find_fan(mesh, h, fan);
    const Index vertex = mesh.target[h];
    for (const Index g : fan) is_met[g] = true;
    if (!is_taken[vertex]) {
      is_taken[vertex] = true;
      continue;
    }
    const auto copy = static_cast<Index>(mesh.number_of_vertices());
    mesh.copied_vertex.push_back(vertex);
    for (const Index g : fan) mesh.target[g] = copy;
  }
}

/// Leads the halfedges without a face along the border.
void join_border(Array_mesh& mesh) {
  for (Index b = 0; b < mesh.number_of_halfedges(); ++b) {
    if (mesh.face[b] != none) continue;
    Index h = mesh.previous(b ^ 1);
    mesh.target[b] = mesh.target[h];
    while (mesh.face[h ^ 1] != none) h = mesh.previous(h ^ 1);
    mesh.next[b] = h ^ 1;
  }
}

}  // namespace

Read_mesh read_mesh(const Coordinates& coordinates, const Polygons& polygons, bool is_repaired) {
  Read_mesh result;
  result.mesh.coordinates = coordinates;
  Faces faces = faces_of(polygons, coordinates.number);
  require_finite(coordinates, faces);
  Twins twins = twins_of(faces, coordinates.number);
  if (!is_repaired && !twins.fault.empty())
    throw std::invalid_argument("the faces do not form an oriented surface: " + twins.fault);
  if (is_repaired && (!twins.fault.empty() || has_coinciding_border_edges(coordinates, faces, twins.of_corner))) {
    faces = repaired(coordinates, std::move(faces), result);
    twins = twins_of(faces, coordinates.number);
  }
  join(faces, twins.of_corner, result.mesh);
  part_fans(result.mesh);
  join_border(result.mesh);
  if (is_repaired) {
    const std::size_t turned = turn_components_outward(result.mesh);
    if (turned > 0) result.remarks.push_back("turned " + counted(turned, "closed part") + " whose faces looked inward");
  }
  return result;
}

}  // namespace rw_python
