// SPDX-License-Identifier: MIT

// Smooth boundaries of a mesh in tiles, where they go on from tile to tile.

#include <RW_segmentation/tiled_boundaries.h>

#include <RW_segmentation/Tile.h>
#include <RW_segmentation/smooth_boundaries.h>
#include <RW_segmentation/split_along_boundaries.h>
#include <RW_segmentation/tiled_segmentation.h>

#include <gtest/gtest.h>
#include "boundaries.h"
#include "boundaries_of_tiles.h"
#include "cut_into_tiles.h"
#include "meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

namespace test_tiled_boundaries {

using namespace RW_segmentation;

namespace {

using Index = Dual_mesh::Index;
using Labels = std::vector<std::size_t>;
using Mesh = meshes::Surface_mesh;
using meshes::Shape;
using Curves = std::vector<Boundary_curve<Mesh>>;
using namespace boundaries_of_tiles;
using namespace tiles;

/// A mesh in tiles with smooth boundaries.
class Smooth_tiles {
 public:
  /// \param labels by face of the whole
  Smooth_tiles(const Cut_mesh& cut, const Labels& labels, double wall_angle = std::numeric_limits<double>::infinity())
      : labels_(cut.tiles.size()) {
    for (std::size_t f = 0; f < labels.size(); ++f) labels_[cut.place[f].first].push_back(labels[f]);
    std::vector<Tile_of<Mesh>> tiles;
    for (const Tile& tile : cut.tiles) {
      meshes.push_back(mesh_of(tile));
      tiles.emplace_back(meshes.back());
    }
    std::vector<Tile_survey> surveys;
    for (const auto& tile : tiles) surveys.push_back(survey_tile(tile));
    plan = plan_tiles(surveys);
    std::vector<Tile_strip> strips;
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      Labels by_face;
      for (const auto face : tiles[t].face_descriptors) by_face.push_back(labels_[t][face]);
      strips.push_back(strip_of_tile(tiles[t], {t, plan}, by_face));
    }
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      std::vector<Tile_strip> neighbours;
      for (const auto n : plan.tiles[t].neighbours) neighbours.push_back(strips[n]);
      for (const Tile_crossing& crossing : crossings_of_tile({t, plan}, strips[t], neighbours, {}, wall_angle))
        crossings.push_back(crossing);
    }
  }

  auto label_map(std::size_t tile) {
    auto map = meshes[tile].add_property_map<Mesh::Face_index, std::size_t>("f:label").first;
    for (std::size_t f = 0; f < labels_[tile].size(); ++f)
      map[Mesh::Face_index(static_cast<Index>(f))] = labels_[tile][f];
    return map;
  }

  Curves curves(std::size_t tile) {
    return smooth_boundaries_of_tile(meshes[tile], label_map(tile), {tile, plan}, crossings);
  }

  Tile_plan plan;
  std::vector<Tile_crossing> crossings;
  std::vector<Mesh> meshes;

 private:
  static Mesh mesh_of(const Tile& tile) {
    Shape shape;
    shape.points = tile.points;
    for (Index f = 0; f < tile.number_of_faces(); ++f)
      shape.faces.emplace_back(tile.corners[f].begin(), tile.corners[f].end());
    return meshes::surface_mesh(shape);
  }

  std::vector<Labels> labels_;
};

std::vector<Curves> curves_of(Smooth_tiles& tiles) {
  std::vector<Curves> curves;
  for (std::size_t t = 0; t < tiles.meshes.size(); ++t) curves.push_back(tiles.curves(t));
  return curves;
}

/// The sides of a mesh that one face has.
std::size_t sides_of_border(const Mesh& mesh) {
  const auto halfedges = mesh.halfedges();
  return static_cast<std::size_t>(
      std::count_if(halfedges.begin(), halfedges.end(), [&](auto h) { return mesh.is_border(h); }));
}

/// Cuts a sphere by two planes into four segments.
Labels quarters(const Shape& shape) {
  return boundaries::labels_by_place(shape, [](const Eigen::Vector3d& p) {
    return std::size_t(p.dot(Eigen::Vector3d(0.3, 0.9, 0.2)) > 0.1) +
           2 * std::size_t(p.dot(Eigen::Vector3d(0.2, -0.3, 1)) > 0.15);
  });
}

TEST(TiledBoundaries, CrossABorderWhereAStraightBoundaryDoes) {
  constexpr std::size_t n = 40;
  const Shape shape = meshes::plane(n);
  for (const double slope : {0., 0.27, -0.6, 1.1}) {
    const auto off_the_line = [&](const Eigen::Vector3d& p) {
      return (p.y() - 0.52 - slope * (p.x() - 0.5)) / std::hypot(1, slope);
    };
    const Labels labels =
        boundaries::labels_by_place(shape, [&](const Eigen::Vector3d& p) { return std::size_t(off_the_line(p) > 0); });
    Smooth_tiles tiles(slices(shape, 4), labels);
    EXPECT_EQ(tiles.crossings.size(), 3U) << slope;
    const std::vector<Curves> curves = curves_of(tiles);
    for (const Curves& of_tile : curves)
      for (const auto& curve : of_tile)
        for (const auto* end : {&curve.points.front(), &curve.points.back()}) {
          const Eigen::Vector3d p = boundaries::vector(end->point);
          const bool is_inside = p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1;
          EXPECT_TRUE(!is_inside || std::abs(off_the_line(p)) < 0.5 / n) << slope;
        }
    for (const auto& [place, turn] : turns_at_borders(curves, 2. / n)) EXPECT_LT(turn, 0.1) << slope;
  }
}

TEST(TiledBoundaries, TurnNoMoreAtBordersThanTheSphereDoes) {
  constexpr std::size_t levels = 5;
  constexpr double distance = 4. / (1 << levels);  // two edges
  const Shape shape = meshes::sphere(levels);
  for (const std::size_t count : {2U, 5U}) {
    Smooth_tiles tiles(slices(shape, count), quarters(shape));
    std::vector<double> turns;
    for (const auto& [place, turn] : turns_at_borders(curves_of(tiles), distance)) turns.push_back(turn);
    const double mean = std::accumulate(turns.begin(), turns.end(), 0.) / static_cast<double>(turns.size());
    EXPECT_GE(turns.size(), 4 * (count - 1));
    // Chords of so many edges turn by the distance; circles that are smaller than great ones turn by a little more.
    EXPECT_LT(mean, 1.2 * distance);
    EXPECT_LT(*std::max_element(turns.begin(), turns.end()), 1.5 * distance);
    tiles.crossings.clear();  // as boundaries are without
    EXPECT_LT(turns_at_borders(curves_of(tiles), distance).size(), turns.size());
  }
}

/// Some segments, and some tiles of them, each round points at random.
Labels parts_at_random(const Shape& shape, std::size_t number, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> coordinate;
  std::vector<Eigen::Vector3d> middles;
  for (std::size_t k = 0; k < number; ++k)
    middles.push_back(Eigen::Vector3d(coordinate(random), coordinate(random), coordinate(random)).normalized());
  return boundaries::labels_by_place(shape, [&](const Eigen::Vector3d& p) {
    const auto nearest = std::min_element(middles.begin(), middles.end(), [&](const auto& a, const auto& b) {
      return (p - a).squaredNorm() < (p - b).squaredNorm();
    });
    return static_cast<std::size_t>(nearest - middles.begin());
  });
}

TEST(TiledBoundaries, OfRefinedTilesMeetVertexByVertex) {
  const Shape shape = meshes::sphere(3);
  std::size_t crossings = 0, moved = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const std::size_t number = 2 + seed % 5;  // of tiles
    const Labels labels = parts_at_random(shape, 2 + seed % 12, seed);
    const Labels tile = seed % 4 == 0 ? boundaries::random_cells(shape, number, seed)  // as jagged as can be
                                      : parts_at_random(shape, number, 1000 + seed);
    std::size_t face = 0;
    Smooth_tiles tiles(cut(shape, number, [&](const Eigen::Vector3d&) { return tile[face++]; }), labels);
    std::size_t sides = 0, on_side = 0;
    for (const Mesh& mesh : tiles.meshes) sides += sides_of_border(mesh);
    for (const Tile_crossing& crossing : tiles.crossings) on_side += crossing.side[0] != crossing.side[1];
    std::size_t refined_sides = 0;
    for (std::size_t t = 0; t < tiles.meshes.size(); ++t) {
      const auto label = tiles.label_map(t);
      const auto before = boundaries::measures(tiles.meshes[t], label);
      split_along_boundaries(tiles.meshes[t], tiles.curves(t), label);
      const auto after = boundaries::measures(tiles.meshes[t], label);
      EXPECT_EQ(after.regions, before.regions);
      EXPECT_EQ(after.labels, before.labels);
      EXPECT_NEAR(after.area, before.area, 1e-12);
      refined_sides += sides_of_border(tiles.meshes[t]);
    }
    EXPECT_EQ(open_sides(tiles.meshes), 0U) << seed;
    EXPECT_EQ(refined_sides, sides + 2 * on_side) << seed;
    crossings += tiles.crossings.size();
    moved += on_side;
  }
  EXPECT_GT(crossings, 60U);
  EXPECT_GT(moved, 60U);
}

TEST(TiledBoundaries, CrossNoWallBetweenTiles) {
  const Shape shape = meshes::sphere(4);
  const Labels labels = quarters(shape);
  EXPECT_FALSE(Smooth_tiles(slices(shape, 2), labels).crossings.empty());
  EXPECT_TRUE(Smooth_tiles(slices(shape, 2), labels, 0.).crossings.empty());  // all edges are sharp
}

TEST(TiledBoundaries, AreTheSameWithAndWithoutThreads) {
  const Shape shape = meshes::sphere(4);
  const Cut_mesh cut = slices(shape, 2);
  const Tile_plan plan = plan_tiles({survey_tile(cut.tiles[0]), survey_tile(cut.tiles[1])});
  std::vector<Labels> labels(2);
  const Labels whole = quarters(shape);
  for (std::size_t f = 0; f < whole.size(); ++f) labels[cut.place[f].first].push_back(whole[f]);
  const Tile_strip first = strip_of_tile(cut.tiles[0], {0, plan}, labels[0]);
  const Tile_strip second = strip_of_tile(cut.tiles[1], {1, plan}, labels[1]);
  EXPECT_LT(first.segments.size(), labels[0].size());
  const auto with = crossings_of_tile({0, plan}, first, {second});
  const auto without = crossings_of_tile<CGAL::Sequential_tag>({0, plan}, first, {second});
  ASSERT_EQ(with.size(), without.size());
  EXPECT_EQ(with.size(), 4U);
  for (std::size_t c = 0; c < with.size(); ++c) {
    EXPECT_EQ(with[c].side, without[c].side);
    EXPECT_EQ(with[c].position, without[c].position);
    EXPECT_EQ(with[c].beyond[0], without[c].beyond[0]);
  }
  EXPECT_TRUE(crossings_of_tile({1, plan}, second, {first}).empty());  // they are the other tile's
}

TEST(TiledBoundaries, RefuseWhatTheyCannotHave) {
  const Tile triangles = as_tile(meshes::cube(2)), squares = as_tile(meshes::cube_of_quads());
  const Tile_plan plan = plan_tiles({survey_tile(triangles), survey_tile(squares)});
  EXPECT_THROW(strip_of_tile(triangles, {0, plan}, {1, 2, 3}), std::invalid_argument);
  EXPECT_THROW(strip_of_tile(squares, {1, plan}, Labels(6, 0)), std::invalid_argument);
  EXPECT_THROW(crossings_of_tile({0, plan}, {}, {}, {}, -1), std::invalid_argument);
  EXPECT_TRUE(crossings_of_tile({0, plan}, {}, {}).empty());
}

}  // namespace
}  // namespace test_tiled_boundaries
