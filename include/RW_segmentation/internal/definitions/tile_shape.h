// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILE_SHAPE_H
#define RW_SEGMENTATION_INTERNAL_DEFINITIONS_TILE_SHAPE_H

#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/feature_sensitive_seeds.h>
#include <RW_segmentation/internal/Argument_error.h>
#include <RW_segmentation/internal/compiled.h>
#include <RW_segmentation/internal/mesh/Face_choice.h>
#include <RW_segmentation/internal/seeds/Distance_clusters.h>
#include <RW_segmentation/internal/seeds/Feature_sensitive_metric.h>
#include <RW_segmentation/internal/tiles/Edge_set.h>
#include <RW_segmentation/internal/tiles/Joined_faces.h>
#include <RW_segmentation/internal/tiles/Turn_histogram.h>
#include <RW_segmentation/internal/tiles/noise_sample.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

namespace RW_segmentation {

namespace internal {

// ---- Reading ----

/// The points of a tile in the unit box of the whole.
inline std::vector<Eigen::Vector3d> points_in_box(const Tile& tile, const Unit_box& box) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(tile.points.size());
  for (const Eigen::Vector3d& p : tile.points) points.push_back(box.scaled(p));
  return points;
}

/// As below, of faces that are joined already.
inline Dual_mesh part_of_joined_faces(const Tile_plan& plan, Face_corners corners, std::vector<Eigen::Vector3d> points,
                                      Joined_faces joined, std::vector<char> is_wall) {
  const std::size_t faces = corners.number_of_faces();
  return Dual_mesh({Dual_graph(faces, std::move(joined.sides)), std::move(corners), std::move(joined.ends),
                    std::move(points), std::move(is_wall)},
                   &plan.box)
      .as_part_of(plan.total_area);
}

RW_SEGMENTATION_INLINE Dual_mesh part_of(const Tile_plan& plan, Face_corners corners,
                                         std::vector<Eigen::Vector3d> points, std::vector<char> is_wall) {
  Joined_faces joined(corners, points.size());
  return part_of_joined_faces(plan, std::move(corners), std::move(points), std::move(joined), std::move(is_wall));
}

// ---- Noise ----

/// Some faces of a tile by themselves, without walls.
/// \param faces different ones
inline Dual_mesh part_of_faces(const Tile_plan& plan, const Dual_mesh& mesh,
                               const std::vector<Dual_mesh::Index>& faces) {
  auto [corners, vertices] =
      Face_choice(mesh.number_of_vertices())([&](Dual_mesh::Index f) { return mesh.corners(f); }, faces);
  std::vector<Eigen::Vector3d> points;
  for (const auto v : vertices) points.push_back(mesh.point(v));
  return part_of(plan, std::move(corners), std::move(points), {});
}

/// The noise of a tile. A large one is measured on a sample of its faces, which stand for all.
inline Tile_noise measured_noise(const Tile_plan& plan, const Dual_mesh& mesh, const Normal_smoothing& smoothing,
                                 const Progress& progress) {
  // Ten of CGAL's meshes of .8 to 2.5 million faces, clean and with noise of .01 to .1 % of the diagonal, have their widening
  // changed by 2 % in the mean and 9 % at most. Half as many faces change it by up to 53 %, twice as many by up to 5 %.
  constexpr std::size_t faces_of_patches = 250000;
  const Noise_sample sample = noise_sample(mesh, smoothing.radius * std::sqrt(plan.total_area), faces_of_patches);
  const bool is_whole = sample.faces.size() == mesh.number_of_faces();
  const Normal_turns turns =
      normal_turns(is_whole ? mesh : part_of_faces(plan, mesh, sample.faces), smoothing, progress);
  const auto of_all = [&](const std::vector<double>& turn) {
    std::vector<double> counted;
    for (std::size_t i = 0; i < turn.size(); ++i)
      if (sample.is_counted[i]) counted.push_back(turn[i]);
    return Turn_histogram::scaled(Turn_histogram::counts(counted), mesh.number_of_faces(), counted.size());
  };
  return {of_all(turns.turn), of_all(turns.smoother_turn)};
}

// ---- The border that neighbours see ----

/// Faces within a distance of some faces, along paths from centroid to centroid; those themselves first.
/// \param centroid by face
inline std::vector<Dual_graph::Index> faces_within(const Dual_graph& graph,
                                                   const std::vector<Dual_graph::Index>& sources, double distance,
                                                   const std::vector<Eigen::Vector3d>& centroid) {
  using Index = Dual_graph::Index;
  std::vector<float> reached(graph.number_of_faces(), std::numeric_limits<float>::infinity());
  std::vector<Index> within;
  for (const Index face : sources) {
    if (reached[face] == 0) continue;
    reached[face] = 0;
    within.push_back(face);
  }
  // A face is visited again when a shorter path to it is found.
  std::vector<Index> open = within, next;
  for (; !open.empty(); open.swap(next)) {
    next.clear();
    for (const Index f : open)
      for (const auto& [g, edge] : graph.neighbours(f)) {
        const auto through_f = static_cast<float>(reached[f] + (centroid[f] - centroid[g]).norm());
        if (!(through_f < reached[g]) || through_f > static_cast<float>(distance)) continue;
        if (std::isinf(reached[g])) within.push_back(g);
        reached[g] = through_f;
        next.push_back(g);
      }
  }
  return within;
}

/// How far a tile is seen by its neighbours, in the unit box.
inline double width_of_border(const Tile_plan& plan, const Normal_smoothing& smoothing, double widening) {
  // Smoothing lengths; what lies farther moves a normal by less than e^-4 of its turn.
  constexpr double smoothing_lengths = 4;
  return smoothing_lengths * widening * smoothing.radius * std::sqrt(plan.total_area);
}

/// By vertex of a tile: what it is to all tiles, or `Tile_border::none`.
inline std::vector<Dual_mesh::Index> ids_of_vertices(const Dual_mesh& mesh,
                                                     const std::vector<Tile_plan::Shared_vertex>& shared) {
  std::vector<Dual_mesh::Index> id(mesh.number_of_vertices(), Tile_border::none);
  for (const auto& [vertex, number] : shared) id[vertex] = number;
  return id;
}

/// Refuses a face of which two corners in different places are the same vertex to all tiles.
/// \throws std::invalid_argument
inline void check_corners_are_different(const Tile& tile, const std::vector<Tile_plan::Shared_vertex>& shared) {
  std::vector<Dual_mesh::Index> id(tile.points.size(), Tile_border::none);
  for (const auto& [vertex, number] : shared) id[vertex] = number;
  for (Dual_mesh::Index f = 0; f < tile.number_of_faces(); ++f) {
    const auto corners = tile.corners[f];
    for (std::size_t i = 0; i < corners.size(); ++i)
      for (std::size_t j = i + 1; j < corners.size() && id[corners[i]] != Tile_border::none; ++j) {
        const Eigen::Vector3d &p = tile.points[corners[i]], &q = tile.points[corners[j]];
        if (id[corners[i]] != id[corners[j]] || p == q) continue;
        std::ostringstream message;
        message << (tile.vertex_ids.empty() ? "the tolerance makes" : "equal ids make")
                << " one vertex of the corners (" << p[0] << ", " << p[1] << ", " << p[2] << ") and (" << q[0] << ", "
                << q[1] << ", " << q[2] << ") of a face";
        throw std::invalid_argument(message.str());
      }
  }
}

/// The faces of a tile up to a distance, the width of the border, from some faces, and the walls between them.
/// \param id by vertex
inline void take_border(const Dual_mesh& mesh, const std::vector<Dual_mesh::Index>& sources,
                        const std::vector<Dual_mesh::Index>& id,
                        const std::vector<std::array<Dual_mesh::Index, 2>>& walls, Tile_border& border) {
  using Index = Dual_mesh::Index;
  std::vector<Eigen::Vector3d> centroid;
  centroid.reserve(mesh.number_of_faces());
  for (Index f = 0; f < mesh.number_of_faces(); ++f) centroid.push_back(mesh.centroid(f));
  border.faces = faces_within(mesh.graph(), sources, border.width, centroid);
  std::sort(border.faces.begin(), border.faces.end());

  std::vector<Index> number(mesh.number_of_vertices(), Tile_border::none);
  for (const Index f : border.faces) {
    for (const Index v : mesh.corners(f)) {
      if (number[v] == Tile_border::none) {
        number[v] = static_cast<Index>(border.points.size());
        border.points.push_back(mesh.point(v));
        border.ids.push_back(id[v]);
      }
      border.corners.add(number[v]);
    }
    border.corners.end_face();
  }
  for (const auto& [u, v] : walls)
    if (number[u] != Tile_border::none && number[v] != Tile_border::none)
      border.walls.push_back({number[u], number[v]});
}

/// As above, from the vertices that the tile shares.
inline void take_border(const Dual_mesh& mesh, const std::vector<Tile_plan::Shared_vertex>& shared,
                        const std::vector<std::array<Dual_mesh::Index, 2>>& walls, Tile_border& border) {
  const std::vector<Dual_mesh::Index> id = ids_of_vertices(mesh, shared);
  std::vector<Dual_mesh::Index> at_border;
  for (Dual_mesh::Index f = 0; f < mesh.number_of_faces(); ++f)
    for (const auto v : mesh.corners(f))
      if (id[v] != Tile_border::none) at_border.push_back(f);
  take_border(mesh, at_border, id, walls, border);
}

}  // namespace internal

RW_SEGMENTATION_INLINE Tile_border internal::border_of_tile(const Tile& tile, const Tile_in_plan& place,
                                                            Tile_noise& noise, const Tiled_segmentation& options,
                                                            const Progress& progress) {
  const auto& [number, plan] = place;
  internal::check_corners_are_different(tile, plan.tiles[number].shared_vertices);
  const Dual_mesh mesh = internal::part_of(plan, tile.corners, internal::points_in_box(tile, plan.box), {});
  Tile_border border;
  double widening = 1;
  if (mesh.number_of_faces() > 0) {
    noise = internal::measured_noise(plan, mesh, options.smoothing, progress);
    widening = internal::widening_by_noise(noise_of_tiles({noise}), options.smoothing);
  }
  border.width = internal::width_of_border(plan, options.smoothing, std::max(widening, 1.));
  internal::take_border(mesh, plan.tiles[number].shared_vertices, tile.walls, border);
  return border;
}

RW_SEGMENTATION_INLINE internal::Noise_of_mesh noise_of_tiles(const std::vector<Tile_noise>& tiles) {
  Tile_noise whole;
  for (const Tile_noise& noise : tiles) {
    internal::Turn_histogram::add(noise.turns, whole.turns);
    internal::Turn_histogram::add(noise.smoother_turns, whole.smoother_turns);
  }
  return {internal::Turn_histogram::median(whole.turns), internal::Turn_histogram::median(whole.smoother_turns)};
}

namespace internal {

// ---- A tile with its halo ----

/// Collects the faces of a tile and those of its neighbours' borders that lie near enough, and the walls between all of
/// them.
class Tile_surroundings {
 public:
  using Index = Dual_mesh::Index;

  /// \param wall_angle see `Tiled_segmentation`
  /// \throws std::invalid_argument if it is negative or NaN
  Tile_surroundings(const Tile& tile, const Tile_in_plan& place, const std::vector<Tile_border>& neighbours,
                    double wall_angle)
      : plan_(place.plan),
        number_(place.number),
        wall_angle_(wall_angle),
        points_(points_in_box(tile, place.plan.box)) {
    if (!(wall_angle >= 0)) throw argument_error("wall_angle", wall_angle, "not negative");
    take_faces(tile);
    add_halo(glued(neighbours));
  }

  /// \param[out] turned_sides sides at which two tiles are not oriented alike
  Tile_shape shape(std::size_t& turned_sides) {
    Tile_shape shape;
    shape.own_faces = corners_.number_of_faces() - halo_.size();
    Joined_faces joined(corners_, points_.size());
    turned_sides = joined.turned_sides;
    std::vector<char> is_wall = walls_of(joined);
    shape.mesh =
        part_of_joined_faces(plan_, std::move(corners_), std::move(points_), std::move(joined), std::move(is_wall));
    shape.halo = std::move(halo_);
    std::unordered_map<Index, Index> id_of_vertex;
    for (const auto& [vertex, id] : plan_.tiles[number_].shared_vertices) id_of_vertex.emplace(vertex, id);
    for (Index e = 0; e < shape.mesh.number_of_edges(); ++e) {
      const auto [f, g] = shape.mesh.graph().faces_of(e);
      if ((f < shape.own_faces) == (g < shape.own_faces)) continue;
      const auto [u, v] = shape.mesh.ends(e);
      const auto [low, high] = std::minmax(id_of_vertex.at(u), id_of_vertex.at(v));
      shape.shared_edges.push_back({e, {low, high}, shape.halo[std::max(f, g) - shape.own_faces].tile});
    }
    return shape;
  }

 private:
  /// The faces of the tile. Vertices of it that are the same become one.
  void take_faces(const Tile& tile) {
    std::vector<Index> number(points_.size());
    std::iota(number.begin(), number.end(), Index(0));
    for (const auto& [vertex, id] : plan_.tiles[number_].shared_vertices)
      number[vertex] = vertex_of_id_.emplace(id, vertex).first->second;
    corners_.reserve(tile.number_of_faces(), tile.corners.number_of_corners());
    for (Index f = 0; f < tile.number_of_faces(); ++f) {
      for (const Index v : tile.corners[f]) corners_.add(number[v]);
      corners_.end_face();
    }
    for (const auto& [u, v] : tile.walls) walls_.push_back({number[u], number[v]});
    add_normals(tile.corners, points_, normals_);
  }

  /// All border faces of all neighbours, glued together.
  struct Glued_borders {
    Face_corners corners;
    std::vector<Eigen::Vector3d> points;  ///< those of the tile, then those of the borders
    std::vector<Tile_shape::Halo_face> faces;
    std::vector<Eigen::Vector3d> normals;     ///< by face, where sharp edges are walls
    std::vector<std::array<Index, 2>> walls;  ///< by their vertices
    std::vector<Index> sources;               ///< faces that touch the tile
    double width = 0;                         ///< of the widest border
  };

  Glued_borders glued(const std::vector<Tile_border>& neighbours) {
    Glued_borders borders;
    borders.points = points_;
    for (std::size_t n = 0; n < neighbours.size(); ++n) {
      const Tile_border& border = neighbours[n];
      borders.width = std::max(borders.width, border.width);
      std::vector<Index> vertex(border.points.size());
      for (std::size_t p = 0; p < vertex.size(); ++p) vertex[p] = vertex_of(border, p, borders.points);
      for (Index f = 0; f < border.corners.number_of_faces(); ++f) {
        for (const Index p : border.corners[f]) {
          borders.corners.add(vertex[p]);
          if (vertex[p] < points_.size()) borders.sources.push_back(static_cast<Index>(borders.faces.size()));
        }
        borders.corners.end_face();
        borders.faces.push_back({plan_.tiles[number_].neighbours[n], f});
      }
      for (const auto& [p, q] : border.walls) borders.walls.push_back({vertex[p], vertex[q]});
      add_normals(border.corners, border.points, borders.normals);
    }
    return borders;
  }

  /// The faces of the borders that lie near the tile, rising.
  static std::vector<Index> near_faces(const Glued_borders& borders) {
    Joined_faces joined(borders.corners, borders.points.size());
    const Dual_graph graph(borders.faces.size(), std::move(joined.sides));
    std::vector<Eigen::Vector3d> centroid;
    centroid.reserve(borders.faces.size());
    for (Index f = 0; f < borders.faces.size(); ++f) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const Index v : borders.corners[f]) sum += borders.points[v];
      centroid.push_back(sum / static_cast<double>(borders.corners[f].size()));
    }
    std::vector<Index> near = faces_within(graph, borders.sources, borders.width, centroid);
    std::sort(near.begin(), near.end());
    return near;
  }

  void add_halo(const Glued_borders& borders) {
    if (borders.sources.empty()) return;
    std::vector<Index> number(borders.points.size(), Tile_border::none);  // of the points that are taken
    std::iota(number.begin(), number.begin() + static_cast<std::ptrdiff_t>(points_.size()), Index(0));
    for (const Index f : near_faces(borders)) {
      for (const Index v : borders.corners[f]) {
        if (number[v] == Tile_border::none) {
          number[v] = static_cast<Index>(points_.size());
          points_.push_back(borders.points[v]);
        }
        corners_.add(number[v]);
      }
      corners_.end_face();
      halo_.push_back(borders.faces[f]);
      if (has_wall_angle()) normals_.push_back(borders.normals[f]);
    }
    for (const auto& [u, v] : borders.walls)
      if (number[u] != Tile_border::none && number[v] != Tile_border::none) walls_.push_back({number[u], number[v]});
  }

  // ---- Walls ----

  bool has_wall_angle() const { return std::isfinite(wall_angle_); }

  /// Adds the normals of faces, where sharp edges are walls. Each face is measured with the points of its own tile, which
  /// may lie apart from those of its neighbours: so all tiles find the same walls.
  void add_normals(const Face_corners& corners, const std::vector<Eigen::Vector3d>& points,
                   std::vector<Eigen::Vector3d>& normals) const {
    if (!has_wall_angle()) return;
    for (Index f = 0; f < corners.number_of_faces(); ++f)
      normals.push_back(measures_of(points, corners[f], plan_.box.rounding).normal);
  }

  /// Which edges are walls; empty if none can be.
  std::vector<char> walls_of(const Joined_faces& joined) const {
    std::vector<char> is_wall;
    if (walls_.empty() && !has_wall_angle()) return is_wall;
    const Edge_set given(walls_);
    is_wall.reserve(joined.sides.size());
    for (std::size_t e = 0; e < joined.sides.size(); ++e)
      is_wall.push_back(given.contains(joined.ends[e]) || (has_wall_angle() && is_sharp(joined.sides[e])));
    return is_wall;
  }

  /// Beside a face without area, whose normal is zero, no edge is.
  bool is_sharp(const std::array<Index, 2>& faces) const {
    const Eigen::Vector3d &a = normals_[faces[0]], &b = normals_[faces[1]];
    return std::atan2(a.cross(b).norm(), a.dot(b)) > wall_angle_;
  }

  /// The vertex that a point of a neighbour's border is: one of the tile, or a new one.
  Index vertex_of(const Tile_border& border, std::size_t point, std::vector<Eigen::Vector3d>& points) {
    const auto next = static_cast<Index>(points.size());
    if (border.ids[point] != Tile_border::none) {
      const auto [place, is_new] = vertex_of_id_.emplace(border.ids[point], next);
      if (!is_new) return place->second;
    }
    points.push_back(border.points[point]);
    return next;
  }

  const Tile_plan& plan_;
  std::size_t number_;
  double wall_angle_;
  Face_corners corners_;                  // of the tile, then of its halo
  std::vector<Eigen::Vector3d> normals_;  // by face, where sharp edges are walls
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<Index, 2>> walls_;  // those given, by their vertices
  std::vector<Tile_shape::Halo_face> halo_;
  std::unordered_map<Index, Index> vertex_of_id_;
};

// ---- What the whole must know ----

/// The faces of a tile without their halo, as a graph.
struct Own_graph {
  Dual_graph graph;
  std::vector<Dual_graph::Index> edges;  ///< by edge: its number with the halo

  explicit Own_graph(const Tile_shape& shape) {
    std::vector<std::array<Dual_graph::Index, 2>> ends;
    for (Dual_graph::Index e = 0; e < shape.mesh.number_of_edges(); ++e) {
      const auto& faces = shape.mesh.graph().faces_of(e);
      if (faces[0] >= shape.own_faces || faces[1] >= shape.own_faces) continue;
      ends.push_back(faces);
      edges.push_back(e);
    }
    graph = Dual_graph(shape.own_faces, std::move(ends));
  }

  /// Values by edge, of the tile's own edges alone.
  std::vector<double> own(const std::vector<double>& values) const {
    std::vector<double> result;
    result.reserve(edges.size());
    for (const auto e : edges) result.push_back(values[e]);
    return result;
  }
};

/// The face of a tile at one of its sides.
inline Dual_mesh::Index own_face(const Tile_shape& shape, const Tile_shape::Shared_edge& shared) {
  const auto& faces = shape.mesh.graph().faces_of(shared.edge);
  return std::min(faces[0], faces[1]);
}

inline Turn_sums turn_sums(const Tile_shape& shape, const Own_graph& own, std::size_t number) {
  const std::vector<double> signed_turns = turns(shape.mesh, -1);
  std::vector<Dual_mesh::Index> counted = own.edges;
  for (const auto& shared : shape.shared_edges)
    if (number < shared.neighbour) counted.push_back(shared.edge);
  Turn_sums sums;
  std::vector<double> values;
  for (const auto e : counted) {
    sums.edges += 1;
    sums.length += shape.mesh.edge_length(e);
    sums.walls += shape.mesh.is_wall(e);
    const double inward = std::max(signed_turns[e], 0.), outward = std::max(-signed_turns[e], 0.);
    sums.turn += inward;
    sums.seeded_turn += inward + seeded_concavity().convex_weight * outward;
    values.push_back(inward);
  }
  sums.counts = Turn_histogram::counts(values);
  return sums;
}

/// The least distance of the nodes of the coarse graph, in steps from face to face: 0, so that each face is a node, on
/// meshes of up to a million faces, and as many as keep the number of nodes there on larger ones.
inline std::size_t steps_of_coarse_graph(std::size_t faces) {
  constexpr double most_nodes = 1e6;             // some 100 bytes each, for all tiles together
  constexpr double faces_by_squared_step = 0.6;  // of a cluster: 5 or 6 triangles with 3 steps
  const double faces_of_node = static_cast<double>(faces) / most_nodes;
  if (faces_of_node <= 1) return 0;
  return static_cast<std::size_t>(std::ceil(std::sqrt(faces_of_node / faces_by_squared_step)));
}

/// That of a part of a mesh, whose other parts share the nodes: as on a large mesh as a whole at the most.
inline std::size_t steps_of_coarse_graph(const Tile_plan& plan, std::size_t seeds) {
  constexpr std::size_t faces_of_cluster = 20;  // 5/9 of the square of the steps
  const std::size_t alone = steps_of_coarse_graph(plan.faces);
  const bool are_clusters_enough = plan.faces / faces_of_cluster >= seeds * least_clusters_per_seed;
  if (plan.faces <= Farthest_point_sampling().largest_direct() || !are_clusters_enough) return alone;
  return std::max(alone, std::min(steps_of_seed_clusters, steps_of_coarse_graph(plan.faces_of_mesh)));
}

/// Clusters of faces as nodes, the lengths of ways between them in the feature-sensitive metric.
inline void add_coarse_graph(const Tile_shape& shape, const Own_graph& own, std::size_t number, std::size_t steps,
                             Tile_outline& outline) {
  const std::vector<double> lengths =
      Feature_sensitive_metric(shape.mesh, Farthest_point_sampling().normal_weight()).edge_lengths();
  Distance_clusters clusters(own.graph, own.own(lengths), steps);
  outline.faces = std::move(clusters.root);
  for (const auto face : outline.faces) outline.centroids.push_back(shape.mesh.centroid(face));
  outline.edges = std::move(clusters.ends);
  outline.lengths = std::move(clusters.lengths);
  for (const auto& shared : shape.shared_edges) {
    if (shape.mesh.is_wall(shared.edge)) continue;
    const auto f = own_face(shape, shared);
    const bool is_owner = number < shared.neighbour;
    outline.sides.push_back(
        {shared.side, clusters.of_face[f], clusters.resistance[f], is_owner ? lengths[shared.edge] : 0, is_owner});
  }
}

}  // namespace internal

RW_SEGMENTATION_INLINE Shaped_tile internal::shape_of_tile(const Tile& tile, const Tile_in_plan& place,
                                                           const std::vector<Tile_border>& neighbours,
                                                           const internal::Noise_of_mesh& noise,
                                                           const Tiled_segmentation& options,
                                                           const Progress& progress) {
  const auto& [number, plan] = place;
  Shaped_tile result;
  auto& [shape, outline] = result;
  shape = internal::Tile_surroundings(tile, place, neighbours, options.wall_angle).shape(outline.turned_sides);
  shape.mesh = internal::shape_of_part(shape.mesh, options.smoothing, noise, progress.part(0, 0.8));
  const internal::Own_graph own(shape);
  outline.turns = internal::turn_sums(shape, own, number);
  for (Dual_mesh::Index f = 0; f < shape.own_faces; ++f) outline.moment += shape.mesh.area(f) * shape.mesh.centroid(f);
  internal::add_coarse_graph(shape, own, number, internal::steps_of_coarse_graph(plan, options.seeds), outline);
  if (options.thickness.samples > 0)
    outline.probes = internal::thickness_probes(shape.mesh, shape.own_faces, options.thickness.samples,
                                                plan.tiles[number].area_before);
  progress(1);
  return result;
}

}  // namespace RW_segmentation

#endif
