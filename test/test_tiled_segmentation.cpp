// SPDX-License-Identifier: MIT

// A mesh in tiles beside the same mesh as a whole, and the steps by themselves.

#include <RW_segmentation/tiled_segmentation.h>

#include <RW_segmentation/Conductance.h>
#include <RW_segmentation/Dihedral_difference.h>
#include <RW_segmentation/Random_walk.h>
#include <RW_segmentation/Tile.h>
#include <RW_segmentation/internal/tiles/Joined_faces.h>
#include <RW_segmentation/internal/tiles/Turn_histogram.h>
#include <RW_segmentation/internal/tiles/noise_sample.h>
#include <RW_segmentation/segmentation_via_random_walks.h>
#include <RW_segmentation/smoothed_face_normals.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <gtest/gtest.h>
#include "../benchmark/segmentation_measures.h"
#include "cut_into_tiles.h"
#include "meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace test_tiled_segmentation {

using namespace RW_segmentation;

namespace {

using Index = Dual_mesh::Index;
using Labels = std::vector<std::size_t>;
using meshes::Shape;
using namespace tiles;

/// Two balls with a neck between them.
Shape dumbbell() { return meshes::two_spheres_with_neck(2.6, 0.35, 40); }

double rand_error(const Labels& a, const Labels& b) { return segmentation_measures::Overlaps(a, b).rand_index_error(); }

/// Whether each edge of a mesh is a wall.
auto wall_map(const meshes::Surface_mesh& mesh, const Edges& walls) {
  return boost::make_function_property_map<meshes::Surface_mesh::Edge_index>(
      [&](const meshes::Surface_mesh::Edge_index& e) {
        const std::size_t u = mesh.vertex(e, 0), v = mesh.vertex(e, 1);
        return walls.count({std::min(u, v), std::max(u, v)}) > 0;
      });
}

Labels segments_of_whole(const Shape& shape, std::size_t segments, const Edges& walls = {}) {
  auto mesh = meshes::surface_mesh(shape);
  const auto ids = mesh.add_property_map<meshes::Surface_mesh::Face_index, std::size_t>("f:id").first;
  Automatic_segmentation policies(segments);
  policies.reduction = Tiled_segmentation().reduction;
  policies.reduction.largest_direct = 0;
  segmentation_via_random_walks(mesh, ids, policies, CGAL::parameters::edge_is_constrained_map(wall_map(mesh, walls)));
  return {ids.begin(), ids.end()};
}

Labels tiled_segments(const Cut_mesh& mesh, std::size_t segments) {
  return mesh.of_whole(hierarchy_of_tiles(mesh.tiles, Tiled_segmentation(segments)).segments(segments));
}

std::vector<Tile_survey> surveys_of(const std::vector<Tile>& tiles) {
  std::vector<Tile_survey> surveys;
  for (const Tile& tile : tiles) surveys.push_back(survey_tile(tile));
  return surveys;
}

// ---- Tiles beside the whole ----

TEST(TiledSegmentation, CutsWhereTheWholeIsCutHoweverItIsTiled) {
  const Shape shape = dumbbell();
  constexpr std::size_t segments = 3;  // of two, the neck might go with either ball
  const Labels whole = segments_of_whole(shape, segments);
  for (const Cut_mesh& mesh : {slices(shape, 1), slices(shape, 2), slices(shape, 5), octants(shape)}) {
    const Labels tiled = tiled_segments(mesh, segments);
    EXPECT_EQ(std::set<std::size_t>(tiled.begin(), tiled.end()).size(), segments);
    EXPECT_LE(rand_error(whole, tiled), 0.02);
  }
}

TEST(TiledSegmentation, KeepsTheBallsOfADumbbellApart) {
  constexpr double end_of_neck = 0.5;  // of which either ball may have any part
  const Shape shape = dumbbell();
  const Labels labels = tiled_segments(octants(shape), 2);
  std::set<std::size_t> lower, upper;
  for (std::size_t f = 0; f < labels.size(); ++f) {
    const double z = shape.points[shape.faces[f][0]][2];
    if (z < -end_of_neck) lower.insert(labels[f]);
    if (z > end_of_neck) upper.insert(labels[f]);
  }
  EXPECT_EQ(lower.size(), 1U);
  EXPECT_EQ(upper.size(), 1U);
  EXPECT_NE(lower, upper);
}

TEST(TiledSegmentation, DoesNotDependOnTheOrderInWhichTilesAreDone) {
  const Cut_mesh mesh = octants(dumbbell());
  const std::size_t count = mesh.tiles.size();
  const Tile_plan plan = plan_tiles(surveys_of(mesh.tiles));
  const auto of_neighbours = [&](const auto& of_tiles, std::size_t t) {
    std::decay_t<decltype(of_tiles)> result;
    for (const auto n : plan.tiles[t].neighbours) result.push_back(of_tiles[n]);
    return result;
  };
  std::vector<Tile_border> borders(count);
  std::vector<Tile_noise> noises(count);
  for (std::size_t t = count; t-- > 0;) borders[t] = border_of_tile(mesh.tiles[t], {t, plan}, noises[t]);
  std::vector<Tile_shape> shapes(count);
  std::vector<Tile_outline> outlines(count);
  for (std::size_t t = count; t-- > 0;) {
    Shaped_tile shaped = shape_of_tile(mesh.tiles[t], {t, plan}, of_neighbours(borders, t), noise_of_tiles(noises));
    shapes[t] = shaped.shape;
    outlines[t] = shaped.outline;
  }
  const Tile_seeds seeds = seeds_of_tiles(plan, outlines);
  std::vector<Tile_clusters> clusters(count);
  std::vector<Tile_network> networks(count);
  for (std::size_t t = count; t-- > 0;)
    clusters[t] = clusters_of_tile(shapes[t], {t, plan}, borders[t], seeds, networks[t]);
  const Tile_walk walk = walk_over_tiles(plan, seeds, networks);
  std::vector<std::vector<Index>> fragments(count);
  std::vector<Tile_regions> regions(count);
  for (std::size_t t = count; t-- > 0;)
    fragments[t] = fragments_of_tile(
        {{t, plan}, shapes[t], clusters[t], of_neighbours(borders, t), of_neighbours(networks, t), seeds, walk},
        regions[t]);
  const Merge_tree tree = merge_tiles(walk, regions);

  const Tiled_hierarchy in_order = hierarchy_of_tiles(mesh.tiles);
  EXPECT_EQ(fragments, in_order.fragment_of_face);
  ASSERT_EQ(tree.merges().size(), in_order.tree.merges().size());
  for (std::size_t i = 0; i < tree.merges().size(); ++i)
    EXPECT_EQ(tree.merges()[i].cost, in_order.tree.merges()[i].cost);
}

TEST(TiledSegmentation, NeverJoinsWhatHangsTogetherNowhere) {
  const Shape shape = meshes::together(meshes::sphere(4), meshes::moved(meshes::sphere(4), {2.5, 0.3, 0}));
  const Cut_mesh mesh = slices(shape, 3);
  const Tiled_hierarchy hierarchy = hierarchy_of_tiles(mesh.tiles);
  EXPECT_EQ(hierarchy.components, 2U);
  const Labels labels = mesh.of_whole(hierarchy.segments(2));
  for (std::size_t f = 0; f < labels.size(); ++f)
    EXPECT_EQ(labels[f], labels[f < labels.size() / 2 ? 0 : labels.size() - 1]);
  EXPECT_NE(labels.front(), labels.back());
  EXPECT_THROW(hierarchy.segments(1), std::invalid_argument);
}

TEST(TiledSegmentation, TakesEmptyTilesAndNoTiles) {
  std::vector<Tile> tiles = slices(dumbbell(), 2).tiles;
  const Tiled_hierarchy without = hierarchy_of_tiles(tiles);
  tiles.emplace_back();
  const Tiled_hierarchy with = hierarchy_of_tiles(tiles);
  EXPECT_TRUE(with.fragment_of_face[2].empty());
  EXPECT_EQ(with.fragment_of_face[0], without.fragment_of_face[0]);
  EXPECT_EQ(hierarchy_of_tiles({}).tree.number_of_fragments(), 0U);
  EXPECT_EQ(hierarchy_of_tiles({Tile(), Tile()}).tree.number_of_fragments(), 0U);
}

TEST(TiledSegmentation, ReadsAnyMeshAsATile) {
  const Shape shape = meshes::cube_of_quads();
  const auto mesh = meshes::surface_mesh(shape);
  const Tile_of tile(mesh);
  ASSERT_EQ(tile.number_of_faces(), shape.faces.size());
  for (Index f = 0; f < tile.number_of_faces(); ++f) {
    std::set<std::size_t> corners;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(tile.face_descriptors[f]))) corners.insert(v);
    std::set<std::size_t> places;
    for (const auto c : tile.corners[f])
      for (std::size_t v = 0; v < shape.points.size(); ++v)
        if (shape.points[v] == tile.points[c]) places.insert(v);
    EXPECT_EQ(places, corners);
  }
}

TEST(TiledSegmentation, TellsItsProgressAndMayBeCancelled) {
  const std::vector<Tile> tiles = slices(dumbbell(), 3).tiles;
  std::vector<double> told;
  hierarchy_of_tiles(tiles, {}, Progress([&](double fraction) {
                       told.push_back(fraction);
                       return true;
                     }));
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1);
  for (const double end : {0.1, 0.5, 0.8})
    EXPECT_THROW(hierarchy_of_tiles(tiles, {}, Progress([&](double fraction) { return fraction < end; })), Cancelled);
}

// ---- Seeds of the user ----

using Places = std::vector<std::vector<Tile_place>>;

/// Two seeds on one ball and one on the other, near the surface, and one on the neck between them.
std::vector<Seed_point> seeds_on_dumbbell() {
  return {{{1.1, 0.2, -1.3}, 4}, {{0, 0.4, 0}, 0}, {{-0.3, -0.9, 1.4}, 7}, {{-0.6, 0.5, -2}, 4}};
}

/// By the walk over the faces of the whole.
Labels segments_of_whole(const Shape& shape, const std::vector<Seed_point>& seeds, const Edges& walls = {}) {
  const auto mesh = meshes::surface_mesh(shape);
  const Dual_mesh_of smoothed =
      smoothed_shape(Dual_mesh_of(mesh, CGAL::parameters::edge_is_constrained_map(wall_map(mesh, walls))));
  Random_walk walk(mesh, Conductance(smoothed, Dihedral_difference(smoothed, seeded_concavity())));
  for (const auto& [point, label] : seeds) {
    std::vector<double> distance;
    for (const auto& face : shape.faces) {
      const auto corner = [&, &p = point](std::size_t k) -> Eigen::Vector3d { return shape.points[face[k]] - p; };
      distance.push_back((corner(0) + corner(1) + corner(2)).norm());
    }
    const auto closest = std::min_element(distance.begin(), distance.end()) - distance.begin();
    walk.add_seed(meshes::Surface_mesh::Face_index(static_cast<unsigned>(closest)), label);
  }
  Labels labels(shape.faces.size());
  walk.segment(boost::make_iterator_property_map(labels.begin(), get(boost::face_index, mesh)));
  return labels;
}

Labels tiled_segments(const Cut_mesh& mesh, const std::vector<Seed_point>& seeds) {
  std::vector<Labels> labels;
  for (const auto& of_tile : segments_of_tiles(mesh.tiles, seeds)) labels.emplace_back(of_tile.begin(), of_tile.end());
  return mesh.of_whole(labels);
}

TEST(TiledSegmentation, FromSeedsCutsWhereTheWholeIsCutHoweverItIsTiled) {
  const Shape shape = dumbbell();
  const std::vector<Seed_point> seeds = seeds_on_dumbbell();
  const Labels whole = segments_of_whole(shape, seeds);
  for (const Cut_mesh& mesh : {slices(shape, 1), slices(shape, 2), slices(shape, 5), octants(shape)}) {
    const Labels tiled = tiled_segments(mesh, seeds);
    EXPECT_EQ(std::set<std::size_t>(tiled.begin(), tiled.end()), (std::set<std::size_t>{0, 4, 7}));
    std::size_t different = 0;
    for (std::size_t f = 0; f < whole.size(); ++f) different += tiled[f] != whole[f];
    EXPECT_LE(static_cast<double>(different), 0.01 * static_cast<double>(whole.size()));
  }
}

TEST(TiledSegmentation, FromSeedsOnBothSidesOfAConvexCreaseCutsThere) {
  const Shape cube = meshes::moved(meshes::cube(20), {-0.5, -0.5, -0.5});
  // Much nearer to the crease on the one side than on the other.
  const std::vector<Seed_point> seeds = {{{0, 0.45, 0.5}, 0}, {{0, 0.5, -0.1}, 1}};
  const Labels whole = segments_of_whole(cube, seeds), tiled = tiled_segments(octants(cube), seeds);
  std::size_t different = 0;
  for (std::size_t f = 0; f < whole.size(); ++f) {
    different += tiled[f] != whole[f];
    const Eigen::Vector3d& p = cube.points[cube.faces[f][0]];
    if (p[1] == 0.5 && p[2] < 0.4 && std::abs(p[0]) < 0.2 && p[2] > -0.1) {
      EXPECT_EQ(tiled[f], 1U);
    }
  }
  EXPECT_LE(static_cast<double>(different), 0.02 * static_cast<double>(whole.size()));
}

TEST(TiledSegmentation, TakesTheFacesThatAreClosestToSeedsInAllTiles) {
  const Shape shape = dumbbell();
  const Cut_mesh mesh = octants(shape);
  const std::vector<Seed_point> seeds = seeds_on_dumbbell();
  const Tile_plan plan = plan_tiles(surveys_of(mesh.tiles));
  std::vector<Tile_outline> outlines;
  Places places;
  for (std::size_t t = 0; t < mesh.tiles.size(); ++t) {
    const Shaped_tile shaped = shape_of_tile(mesh.tiles[t], {t, plan}, {}, {});
    outlines.push_back(shaped.outline);
    places.push_back(places_in_tile(shaped.shape, plan, seeds));
  }
  const auto found = seeds_of_tiles(plan, outlines, seeds, places).seeds;
  ASSERT_EQ(found.size(), seeds.size());
  const auto squared_distance = [&](std::size_t s, std::size_t f) {
    using Kernel = CGAL::Simple_cartesian<double>;
    const auto point = [](const Eigen::Vector3d& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
    const auto& face = shape.faces[f];
    return CGAL::squared_distance(
        point(seeds[s].point),
        Kernel::Triangle_3(point(shape.points[face[0]]), point(shape.points[face[1]]), point(shape.points[face[2]])));
  };
  for (std::size_t s = 0; s < seeds.size(); ++s) {
    double least = std::numeric_limits<double>::infinity(), of_found = least;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
      least = std::min(least, squared_distance(s, f));
      if (mesh.place[f] == std::pair<std::size_t, std::size_t>(found[s].tile, found[s].face))
        of_found = squared_distance(s, f);
    }
    EXPECT_NEAR(of_found, least, 1e-12);
    EXPECT_EQ(found[s].label, seeds[s].label);
  }
}

TEST(TiledSegmentation, FromSeedsGivesPartsOutOfReachLabelsOfTheirOwn) {
  const Shape balls = meshes::together(meshes::sphere(3), meshes::moved(meshes::sphere(3), {2.5, 0.3, 0}));
  const Labels labels = tiled_segments(octants(balls), {{{0, 0, 1}, 3}});
  for (std::size_t f = 0; f < labels.size(); ++f) EXPECT_EQ(labels[f], f < labels.size() / 2 ? 3U : 4U);
}

TEST(TiledSegmentation, RefusesSeedsThatContradictEachOtherOrLieNowhere) {
  const std::vector<Tile> tiles = slices(dumbbell(), 2).tiles;
  const Eigen::Vector3d point(0, 0, 2);
  EXPECT_NO_THROW(segments_of_tiles(tiles, {{point, 0}, {point, 0}}));
  EXPECT_THROW(segments_of_tiles(tiles, {{point, 0}, {point, 1}}), std::invalid_argument);
  EXPECT_THROW(segments_of_tiles(tiles, {{point, 0x80000000U}}), std::invalid_argument);
  EXPECT_EQ(segments_of_tiles(tiles, {{point, 0x7fffffffU}})[0][0], 0x7fffffffU);
  EXPECT_THROW(segments_of_tiles(tiles, {}), std::invalid_argument);
  EXPECT_THROW(segments_of_tiles({}, {{point, 0}}), std::invalid_argument);
  EXPECT_THROW(segments_of_tiles({Tile()}, {{point, 0}}), std::invalid_argument);
}

// ---- Walls ----

/// A piece of the upper ball, where no crease is.
bool is_on_cap(const Eigen::Vector3d& p) { return (p - Eigen::Vector3d(0.7, 0.3, 1.7)).norm() < 0.6; }

Walled_part cap_of(const Shape& dumbbell) { return {dumbbell, is_on_cap}; }

/// Tiles whose borders cross the walls round the cap, and some whose border they are.
std::vector<Cut_mesh> cuts_through_cap(const Shape& dumbbell) {
  const Edges walls = cap_of(dumbbell).walls;
  std::vector<Cut_mesh> cuts = {slices(dumbbell, 1), slices(dumbbell, 5), octants(dumbbell),
                                cut(dumbbell, 2, [](const auto& p) { return std::size_t(is_on_cap(p)); }),
                                cut(dumbbell, 3, [](const auto& p) { return is_on_cap(p) ? 1 + (p[1] > 0.3) : 0; })};
  for (Cut_mesh& mesh : cuts) mesh = with_walls(std::move(mesh), dumbbell, walls);
  return cuts;
}

TEST(TiledSegmentation, WithWallsCutsWhereTheWholeIsCutHoweverItIsTiled) {
  constexpr std::size_t segments = 4;
  const Shape shape = dumbbell();
  const Walled_part cap = cap_of(shape);
  const Labels whole = segments_of_whole(shape, segments, cap.walls);
  for (const Cut_mesh& mesh : cuts_through_cap(shape)) {
    const Labels tiled = tiled_segments(mesh, segments);
    EXPECT_EQ(cap.on_both_sides(tiled), std::set<std::size_t>());
    EXPECT_LE(rand_error(whole, tiled), 0.02);
  }
}

TEST(TiledSegmentation, HasNoSegmentOnBothSidesOfWallsAtAnyLevel) {
  const Shape shape = dumbbell();
  const Walled_part cap = cap_of(shape);
  for (const Cut_mesh& mesh : cuts_through_cap(shape)) {
    const Tiled_hierarchy hierarchy = hierarchy_of_tiles(mesh.tiles);
    EXPECT_EQ(hierarchy.components, 2U);
    // Levels are nested, so that the last one speaks for all.
    EXPECT_EQ(cap.on_both_sides(mesh.of_whole(hierarchy.segments(2))), std::set<std::size_t>());
    EXPECT_THROW(hierarchy.segments(1), std::invalid_argument);
  }
}

TEST(TiledSegmentation, FromSeedsNeverCrossesWalls) {
  const Shape shape = dumbbell();
  const Walled_part cap = cap_of(shape);
  const std::vector<Seed_point> seeds = {
      {{0.8, 0.3, 1.9}, 3}, {{0, 0, -2.3}, 0}, {{-0.6, -0.5, 2}, 1}, {{0, 0.4, 0}, 2}};
  const Labels whole = segments_of_whole(shape, seeds, cap.walls);
  for (const Cut_mesh& mesh : cuts_through_cap(shape)) {
    const Labels tiled = tiled_segments(mesh, seeds);
    std::size_t different = 0;
    for (std::size_t f = 0; f < tiled.size(); ++f) {
      different += tiled[f] != whole[f];
      EXPECT_EQ(tiled[f] == 3, cap.contains[f] != 0) << f;
    }
    EXPECT_LE(static_cast<double>(different), 0.01 * static_cast<double>(whole.size()));
  }
}

/// A cube about the origin, and which of its six sides each face lies in.
struct Sided_cube {
  Shape shape = meshes::moved(meshes::cube(8), {-0.5, -0.5, -0.5});
  Labels side;

  Sided_cube() {
    for (const auto& face : shape.faces) side.push_back(side_at(middle_of(shape, face)));
  }
  static std::size_t side_at(const Eigen::Vector3d& p) {
    Eigen::Index axis = 0;
    p.cwiseAbs().maxCoeff(&axis);
    return static_cast<std::size_t>(2 * axis + (p[axis] > 0));
  }
  /// Tiles that cross the edges of the cube, that meet there, and that do both.
  std::vector<Cut_mesh> cuts() const {
    return {slices(shape, 1), slices(shape, 3), octants(shape), cut(shape, 6, side_at),
            cut(shape, 12, [](const auto& p) { return 2 * side_at(p) + (p[0] + p[1] + p[2] > 0.07); })};
  }
};

/// With sharp edges as walls.
Tiled_segmentation by_wall_angle() {
  Tiled_segmentation options;
  options.wall_angle = 0.7;
  return options;
}

TEST(TiledSegmentation, WithSharpEdgesAsWallsACubeHasItsSixSidesHoweverItIsTiled) {
  const Sided_cube cube;
  for (const Cut_mesh& mesh : cube.cuts()) {
    const Tiled_hierarchy hierarchy = hierarchy_of_tiles(mesh.tiles, by_wall_angle());
    EXPECT_EQ(hierarchy.components, 6U);
    EXPECT_EQ(rand_error(cube.side, mesh.of_whole(hierarchy.segments(6))), 0);
    EXPECT_THROW(hierarchy.segments(5), std::invalid_argument);
  }
}

/// Of each neighbour of a tile what there is of all tiles.
template <class Of_tile>
std::vector<Of_tile> of_neighbours(const std::vector<Of_tile>& of_tiles, const Tile_plan& plan, std::size_t tile) {
  std::vector<Of_tile> result;
  for (const auto n : plan.tiles[tile].neighbours) result.push_back(of_tiles[n]);
  return result;
}

/// Tiles joined with their neighbours' borders.
struct Shaped_tiles {
  Tile_plan plan;
  std::vector<Tile_border> borders;
  std::vector<Tile_shape> shapes;
  std::vector<Tile_outline> outlines;

  Shaped_tiles(const std::vector<Tile>& tiles, const Tiled_segmentation& options)
      : plan(plan_tiles(surveys_of(tiles), options.tolerance)) {
    std::vector<Tile_noise> noises(tiles.size());
    for (std::size_t t = 0; t < tiles.size(); ++t)
      borders.push_back(border_of_tile(tiles[t], {t, plan}, noises[t], options));
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      Shaped_tile shaped =
          shape_of_tile(tiles[t], {t, plan}, of_neighbours(borders, plan, t), noise_of_tiles(noises), options);
      shapes.push_back(std::move(shaped.shape));
      outlines.push_back(std::move(shaped.outline));
    }
  }
};

TEST(TiledSegmentation, PlacesASeedInEachPartThatWallsEnclose) {
  const Sided_cube cube;
  for (const Cut_mesh& mesh : cube.cuts()) {
    Tiled_segmentation options = by_wall_angle();
    options.seeds = 1;
    const Shaped_tiles tiles(mesh.tiles, options);
    std::multiset<std::size_t> sides;
    for (const auto& seed : seeds_of_tiles(tiles.plan, tiles.outlines, options).seeds)
      for (std::size_t f = 0; f < mesh.place.size(); ++f)
        if (mesh.place[f] == std::pair<std::size_t, std::size_t>(seed.tile, seed.face)) sides.insert(cube.side[f]);
    EXPECT_EQ(sides, (std::multiset<std::size_t>{0, 1, 2, 3, 4, 5}));
  }
}

/// What merging asks of tiles with seeds that place themselves.
std::vector<Tile_regions> regions_of(const std::vector<Tile>& tiles, const Tiled_segmentation& options) {
  const Shaped_tiles shaped(tiles, options);
  const auto& [plan, borders, shapes, outlines] = shaped;
  const Tile_seeds seeds = seeds_of_tiles(plan, outlines, options);
  std::vector<Tile_clusters> clusters;
  std::vector<Tile_network> networks(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t)
    clusters.push_back(clusters_of_tile(shapes[t], {t, plan}, borders[t], seeds, networks[t], options));
  const Tile_walk walk = walk_over_tiles(plan, seeds, networks, options);
  std::vector<Tile_regions> regions(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t)
    fragments_of_tile({{t, plan},
                       shapes[t],
                       clusters[t],
                       of_neighbours(borders, plan, t),
                       of_neighbours(networks, plan, t),
                       seeds,
                       walk},
                      regions[t]);
  return regions;
}

TEST(TiledSegmentation, TellsWhichFragmentsLieBesideEachOtherAtWalls) {
  const Sided_cube cube;
  for (const Cut_mesh& mesh : cube.cuts()) {
    Tiled_segmentation options = by_wall_angle();
    options.seeds = 1;
    std::set<std::array<Index, 2>> pairs;
    for (const Tile_regions& regions : regions_of(mesh.tiles, options)) {
      pairs.insert(regions.walls.begin(), regions.walls.end());
      EXPECT_TRUE(regions.boundaries.empty());
    }
    EXPECT_EQ(pairs.size(), 12U);  // the edges of a cube
  }
}

TEST(TiledSegmentation, TilesSeeTheWallsOfTheirNeighbours) {
  const Shape shape = dumbbell();
  const Edges walls = cap_of(shape).walls;
  for (const Cut_mesh& mesh : cuts_through_cap(shape)) {
    const Shaped_tiles tiles(mesh.tiles, {});
    const auto coordinates = [](const Eigen::Vector3d& p) { return std::array{p[0], p[1], p[2]}; };
    std::map<std::array<double, 3>, std::size_t> vertex_at;
    for (std::size_t v = 0; v < shape.points.size(); ++v)
      vertex_at[coordinates(tiles.plan.box.scaled(shape.points[v]))] = v;
    Edges seen;
    for (const Tile_shape& of_tile : tiles.shapes)
      for (Index e = 0; e < of_tile.mesh.number_of_edges(); ++e) {
        const auto [a, b] = of_tile.mesh.ends(e);
        const std::size_t u = vertex_at.at(coordinates(of_tile.mesh.point(a)));
        const std::size_t v = vertex_at.at(coordinates(of_tile.mesh.point(b)));
        const std::array edge = {std::min(u, v), std::max(u, v)};
        EXPECT_EQ(of_tile.mesh.is_wall(e), walls.count(edge) > 0);
        if (of_tile.mesh.is_wall(e)) seen.insert(edge);
      }
    EXPECT_EQ(seen, walls);
  }
}

TEST(TiledSegmentation, TilesAgreeWhichEdgesAreSharpWhereTheirVerticesLieApart) {
  Cut_mesh mesh = octants(meshes::with_noise(meshes::sphere(4), 0.01));
  Tiled_segmentation options;
  options.tolerance = 0.002;
  for (std::size_t t = 0; t < mesh.tiles.size(); ++t)
    for (Eigen::Vector3d& p : mesh.tiles[t].points) p[0] += 2e-4 * static_cast<double>(t);
  for (const double angle : {0.1, 0.2, 0.3, 0.4}) {
    options.wall_angle = angle;
    std::map<internal::Tile_side, std::set<bool>> answers;
    std::map<bool, std::size_t> count;
    const Shaped_tiles tiles(mesh.tiles, options);
    for (const Tile_shape& shape : tiles.shapes)
      for (const auto& shared : shape.shared_edges) {
        const bool is_wall = shape.mesh.is_wall(shared.edge);
        answers[shared.side].insert(is_wall);
        ++count[is_wall];
      }
    for (const auto& [side, of_tiles] : answers) EXPECT_EQ(of_tiles.size(), 1U);
    EXPECT_GT(count[true], 10U);
    EXPECT_GT(count[false], 10U);
  }
}

TEST(TiledSegmentation, ReadsConstrainedEdgesAsWallsAtTheBorderAsWell) {
  const Shape shape = meshes::plane(2);
  const auto mesh = meshes::surface_mesh(shape);
  Edges walls;
  for_each_side(shape, [&](std::size_t f, const auto& edge) {
    if (f == 0) walls.insert(edge);  // of which one or two lie on the border
  });
  const Tile_of tile(mesh, CGAL::parameters::edge_is_constrained_map(wall_map(mesh, walls)));
  Edges read;
  for (const auto& wall : tile.walls) {
    std::vector<std::size_t> ends;
    for (const Index end : wall)
      for (std::size_t v = 0; v < shape.points.size(); ++v)
        if (shape.points[v] == tile.points[end]) ends.push_back(v);
    read.insert({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])});
  }
  EXPECT_EQ(tile.walls.size(), read.size());
  EXPECT_EQ(read, walls);
}

TEST(TiledSegmentation, RefusesWallsThatAreNoEdgesAndAnglesThatAreNone) {
  Tile tile = as_tile(meshes::cube());
  tile.walls = {{tile.corners[0][0], tile.corners[0][1]}};
  EXPECT_NO_THROW(survey_tile(tile));
  tile.walls.push_back({tile.corners[0][0], tile.corners[0][0]});
  EXPECT_THROW(survey_tile(tile), std::invalid_argument);
  tile.walls.back() = {tile.corners[0][0], 1000};
  EXPECT_THROW(survey_tile(tile), std::invalid_argument);
  tile.walls.clear();
  Tiled_segmentation options;
  for (const double angle : {-0.1, std::nan("")}) {
    options.wall_angle = angle;
    EXPECT_THROW(hierarchy_of_tiles({tile}, options), std::invalid_argument);
  }
}

// ---- Measures of the whole ----

TEST(TiledSegmentation, MeasuresAreThoseOfTheWhole) {
  const Shape shape = dumbbell();
  const Tile_plan whole = plan_tiles({survey_tile(as_tile(shape))});
  const Tile_plan tiled = plan_tiles(surveys_of(octants(shape).tiles));
  EXPECT_DOUBLE_EQ(whole.box.unit, tiled.box.unit);
  EXPECT_EQ(whole.box.origin, tiled.box.origin);
  EXPECT_NEAR(whole.total_area, tiled.total_area, 1e-12 * whole.total_area);
  const auto mesh = meshes::surface_mesh(shape);
  EXPECT_NEAR(whole.total_area, Dual_mesh_of(mesh).total_area(), 1e-12 * whole.total_area);
}

TEST(TiledSegmentation, NormalsOfATileAreThoseOfTheWhole) {
  constexpr double largest_turn = 0.02;  // radians, of which e^-4 lies beyond the halo and 5e-4 is the solver's
  const Shape shape = dumbbell();
  const Cut_mesh mesh = octants(shape);
  const Tile_plan plan = plan_tiles(surveys_of(mesh.tiles));
  const auto surface = meshes::surface_mesh(shape);
  const Dual_mesh_of whole = smoothed_shape(Dual_mesh_of(surface));
  std::vector<Tile_border> borders;
  std::vector<Tile_noise> noises(mesh.tiles.size());
  for (std::size_t t = 0; t < mesh.tiles.size(); ++t)
    borders.push_back(border_of_tile(mesh.tiles[t], {t, plan}, noises[t]));
  for (std::size_t t = 0; t < mesh.tiles.size(); ++t) {
    std::vector<Tile_border> neighbours;
    for (const auto n : plan.tiles[t].neighbours) neighbours.push_back(borders[n]);
    const Tile_shape of_tile = shape_of_tile(mesh.tiles[t], {t, plan}, neighbours, noise_of_tiles(noises)).shape;
    EXPECT_GT(of_tile.halo.size(), 0U);
    for (std::size_t f = 0; f < mesh.place.size(); ++f) {
      if (mesh.place[f].first != t) continue;
      const Eigen::Vector3d tiled = of_tile.mesh.shape_normal(static_cast<Index>(mesh.place[f].second));
      const Index face = whole.index(meshes::Surface_mesh::Face_index(static_cast<unsigned>(f)));
      EXPECT_LE((tiled - whole.shape_normal(face)).norm(), largest_turn);
    }
  }
}

TEST(TiledSegmentation, NormalsUnderNoiseAreThoseOfTheWidenedRadius) {
  constexpr double widening = 2, largest_turn = 0.01;  // radians; 5e-4 is the solver's as a root of the mean square
  Normal_smoothing smoothing;
  const auto surface = meshes::surface_mesh(meshes::with_noise(dumbbell(), 0.01));
  const Dual_mesh_of mesh(surface);
  const Dual_mesh shape = internal::shape_of_part(mesh, smoothing, {widening * smoothing.noise_angle, 0});
  smoothing.radius *= widening;
  smoothing.noise_angle = std::numeric_limits<double>::infinity();
  const auto normals = internal::smooth_normals(mesh, smoothing);
  for (Index f = 0; f < normals.size(); ++f) EXPECT_LE((shape.shape_normal(f) - normals[f]).norm(), largest_turn);
}

TEST(TiledSegmentation, ThicknessIsMeasuredThroughOtherTiles) {
  const Shape shape = meshes::sphere(4);  // of radius 1
  const Cut_mesh mesh = octants(shape);
  const Tile_plan plan = plan_tiles(surveys_of(mesh.tiles));
  // Of the rays of a probe on a ball of radius 1, within half a radian of the normal, the middle one is 2 cos(a) long.
  Tiled_segmentation options;
  options.thickness.rays = 1;
  std::vector<Tile_shape> shapes;
  std::vector<Tile_outline> outlines(mesh.tiles.size());
  std::vector<Tile_border> borders;
  std::vector<Tile_noise> noises(mesh.tiles.size());
  for (std::size_t t = 0; t < mesh.tiles.size(); ++t)
    borders.push_back(border_of_tile(mesh.tiles[t], {t, plan}, noises[t]));
  for (std::size_t t = 0; t < mesh.tiles.size(); ++t) {
    Shaped_tile shaped = shape_of_tile(mesh.tiles[t], {t, plan}, {}, {}, options);
    shapes.push_back(shaped.shape);
    outlines[t] = shaped.outline;
  }
  const Tile_seeds seeds = seeds_of_tiles(plan, outlines, options);
  EXPECT_NEAR(static_cast<double>(seeds.probes.size()), 500, 5);
  std::vector<Tile_network> networks(mesh.tiles.size());
  for (std::size_t t = 0; t < mesh.tiles.size(); ++t)
    clusters_of_tile(shapes[t], {t, plan}, borders[t], seeds, networks[t], options);
  for (const double thickness : walk_over_tiles(plan, seeds, networks, options).thickness)
    EXPECT_NEAR(thickness * plan.box.unit, 2, 0.02);
}

TEST(TiledSegmentation, NoiseIsThatOfTheWhole) {
  const Shape shape = meshes::with_noise(meshes::sphere(4), 0.01);
  const auto noise_of = [](const std::vector<Tile>& tiles) {
    const Tile_plan plan = plan_tiles(surveys_of(tiles));
    std::vector<Tile_noise> noises(tiles.size());
    for (std::size_t t = 0; t < tiles.size(); ++t) border_of_tile(tiles[t], {t, plan}, noises[t]);
    return noise_of_tiles(noises).turn;
  };
  const double whole = noise_of({as_tile(shape)});
  EXPECT_GT(whole, 0.1);
  EXPECT_NEAR(noise_of(octants(shape).tiles), whole, 0.05 * whole);
}

/// A torus with noise that grows from one side of it to the other.
Shape half_noisy_torus(double deviation, std::size_t around, std::size_t across) {
  Shape shape = meshes::torus(1, 0.4, around, across);
  const Shape noisy = meshes::with_noise(shape, deviation);
  for (std::size_t v = 0; v < shape.points.size(); ++v) {
    const double share = std::clamp((1 + shape.points[v].x()) / 2, 0., 1.);
    shape.points[v] += share * (noisy.points[v] - shape.points[v]);
  }
  return shape;
}

TEST(TiledSegmentation, NoiseOfALargeTileIsThatOfAllOfItsFaces) {
  constexpr double edge = 0.007;  // about as long as edges are
  const std::vector<Tile> tiles = {as_tile(half_noisy_torus(0.1 * edge, 900, 360))};
  const Tile_plan plan = plan_tiles(surveys_of(tiles));
  std::vector<Tile_noise> noises(1);
  border_of_tile(tiles[0], {0, plan}, noises[0]);
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : tiles[0].points) points.push_back(plan.box.scaled(p));
  const Dual_mesh mesh = internal::part_of(plan, tiles[0].corners, points, {});
  const auto turns = internal::Turn_histogram::counts(internal::normal_turns(mesh, Normal_smoothing()).turn);
  const double of_all = internal::Turn_histogram::median(turns);
  EXPECT_NE(noises[0].turns, turns);
  EXPECT_NEAR(noise_of_tiles(noises).turn, of_all, 0.05 * of_all);
  // It weighs as much as all faces would, but for what rounding takes of each count.
  const auto sum = [](const internal::Turn_histogram::Counts& counts) {
    std::uint64_t total = 0;
    for (const auto& [bin, in_bin] : counts) total += in_bin;
    return total;
  };
  EXPECT_LE(sum(noises[0].turns), sum(turns));
  EXPECT_GE(sum(noises[0].turns) + turns.size(), sum(turns));
}

TEST(NoiseSample, IsSpreadOverAMeshInPatchesWithoutTheirRims) {
  constexpr std::size_t most = 4000;
  const auto surface = meshes::surface_mesh(meshes::sphere(5));
  const Dual_mesh_of mesh(surface);
  const double length = 0.01 * std::sqrt(mesh.total_area());
  const internal::Noise_sample sample = internal::noise_sample(mesh, length, most);
  EXPECT_GE(sample.faces.size(), most / 2);  // some are in several patches
  EXPECT_LE(sample.faces.size(), most + most / 4);
  EXPECT_TRUE(std::is_sorted(sample.faces.begin(), sample.faces.end()));
  std::set<std::array<bool, 3>> octants;
  const std::set<Index> faces(sample.faces.begin(), sample.faces.end());
  for (std::size_t i = 0; i < sample.faces.size(); ++i) {
    if (!sample.is_counted[i]) continue;
    const Eigen::Vector3d middle = mesh.centroid(sample.faces[i]);
    octants.insert({middle.x() < 0, middle.y() < 0, middle.z() < 0});
    for (const auto& neighbour : mesh.graph().neighbours(sample.faces[i]))
      EXPECT_TRUE(faces.count(neighbour.face) > 0) << "a face at the end of its patch counts";
  }
  EXPECT_EQ(octants.size(), 8U);
}

TEST(NoiseSample, IsAllOfASmallMeshAndWholeComponents) {
  const auto surface = meshes::surface_mesh(meshes::sphere(3));
  const Dual_mesh_of mesh(surface);
  const auto all = internal::noise_sample(mesh, 0.01, mesh.number_of_faces() / 2);
  EXPECT_EQ(all.faces.size(), mesh.number_of_faces());
  EXPECT_EQ(std::count(all.is_counted.begin(), all.is_counted.end(), true),
            static_cast<std::ptrdiff_t>(mesh.number_of_faces()));

  constexpr std::size_t most = 400;
  Shape cubes = meshes::cube();
  for (int i = 1; i < 100; ++i)
    cubes = meshes::together(std::move(cubes), meshes::moved(meshes::cube(), {10. * i, 0, 0}));
  const auto many = meshes::surface_mesh(cubes);
  const auto some = internal::noise_sample(Dual_mesh_of(many), 1, most);
  EXPECT_GE(some.faces.size(), most / 2);
  EXPECT_LT(some.faces.size(), most + meshes::cube().faces.size());
  EXPECT_EQ(std::count(some.is_counted.begin(), some.is_counted.end(), false), 0);
}

// ---- Where tiles meet ----

TEST(TiledSegmentation, TilesMeetByPlacesWithinAToleranceOrById) {
  Cut_mesh mesh = slices(meshes::sphere(3), 2);
  const auto shared = [&](double tolerance) {
    return plan_tiles(surveys_of(mesh.tiles), tolerance).tiles[0].shared_vertices.size();
  };
  const std::size_t all = shared(0);
  EXPECT_GT(all, 10U);
  for (Eigen::Vector3d& p : mesh.tiles[1].points) p += Eigen::Vector3d(3e-4, 0, 0);
  EXPECT_EQ(shared(0), 0U);
  EXPECT_EQ(shared(1e-4), 0U);
  EXPECT_EQ(shared(1e-3), all);
  for (std::size_t t = 0; t < 2; ++t) {
    Tile& tile = mesh.tiles[t];
    tile.vertex_ids.resize(tile.points.size());
    for (std::size_t v = 0; v < tile.points.size(); ++v)  // the place before it was moved, rounded
      tile.vertex_ids[v] = static_cast<std::uint64_t>(
          std::llround(1e3 * (5 + tile.points[v][0] - 3e-4 * static_cast<double>(t))) * 100000000 +
          std::llround(1e3 * (5 + tile.points[v][1])) * 10000 + std::llround(1e3 * (5 + tile.points[v][2])));
  }
  EXPECT_EQ(shared(0), all);
  mesh.tiles[1].vertex_ids.clear();
  EXPECT_THROW(shared(0), std::invalid_argument);
  mesh.tiles[0].vertex_ids.clear();
  EXPECT_THROW(shared(-1), std::invalid_argument);
  EXPECT_THROW(shared(std::nan("")), std::invalid_argument);
}

TEST(TiledSegmentation, NeighboursAreTilesThatShareAVertex) {
  const Cut_mesh mesh = slices(meshes::tube(10, 12, 40), 4);
  const Tile_plan plan = plan_tiles(surveys_of(mesh.tiles));
  ASSERT_EQ(plan.tiles.size(), 4U);
  for (std::size_t t = 0; t < 4; ++t) EXPECT_FALSE(plan.tiles[t].neighbours.empty());
  for (std::size_t t = 0; t < 4; ++t)
    for (const auto n : plan.tiles[t].neighbours) {  // sharing is mutual
      const auto& back = plan.tiles[n].neighbours;
      EXPECT_NE(n, t);
      EXPECT_TRUE(std::binary_search(back.begin(), back.end(), static_cast<Index>(t)));
    }
}

TEST(TiledSegmentation, TellsOfTilesThatAreNotOrientedAlike) {
  Cut_mesh mesh = slices(meshes::sphere(3), 2);
  EXPECT_EQ(hierarchy_of_tiles(mesh.tiles).turned_sides, 0U);
  Tile turned;
  turned.points = mesh.tiles[1].points;
  for (Index f = 0; f < mesh.tiles[1].number_of_faces(); ++f) {
    const auto corners = mesh.tiles[1].corners[f];
    for (std::size_t k = corners.size(); k-- > 0;) turned.corners.add(corners[k]);
    turned.corners.end_face();
  }
  mesh.tiles[1] = turned;
  const Tiled_hierarchy hierarchy = hierarchy_of_tiles(mesh.tiles);
  EXPECT_GT(hierarchy.turned_sides, 0U);
  EXPECT_EQ(hierarchy.components, 2U);
}

TEST(TiledSegmentation, RefusesTilesThatAreNoMeshes) {
  const Tile good = as_tile(meshes::cube());
  EXPECT_NO_THROW(survey_tile(good));
  Tile bad = good;
  bad.points[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(survey_tile(bad), std::invalid_argument);
  bad = good;
  bad.corners.add(0);
  bad.corners.add(1);
  bad.corners.end_face();
  EXPECT_THROW(survey_tile(bad), std::invalid_argument);
  bad = good;
  for (const Index v : {0U, 1U, 1000U}) bad.corners.add(v);
  bad.corners.end_face();
  EXPECT_THROW(survey_tile(bad), std::invalid_argument);
  bad = good;
  bad.vertex_ids = {1, 2};
  EXPECT_THROW(survey_tile(bad), std::invalid_argument);
  Tiled_segmentation no_seeds;
  no_seeds.seeds = 0;
  EXPECT_THROW(hierarchy_of_tiles({good}, no_seeds), std::invalid_argument);
}

// ---- Parts ----

TEST(JoinedFaces, AreThoseOfTheHalfedgeMesh) {
  for (const Shape& shape : {meshes::sphere(2), meshes::plane(5), meshes::cube_of_quads()}) {
    const Tile tile = as_tile(shape);
    const internal::Joined_faces joined(tile.corners, tile.points.size());
    const auto mesh = meshes::surface_mesh(shape);
    std::set<std::array<Index, 2>> expected;
    std::size_t border = 0;
    for (const auto e : mesh.edges()) {
      border += mesh.is_border(e);
      if (mesh.is_border(e)) continue;
      const Index f = mesh.face(mesh.halfedge(e, 0)), g = mesh.face(mesh.halfedge(e, 1));
      expected.insert({std::min(f, g), std::max(f, g)});
    }
    EXPECT_EQ(std::set(joined.sides.begin(), joined.sides.end()), expected);
    EXPECT_EQ(joined.open_ends.size(), border);
    EXPECT_EQ(joined.turned_sides, 0U);
    EXPECT_TRUE(std::is_sorted(joined.sides.begin(), joined.sides.end()));
  }
}

TEST(JoinedFaces, LeaveSidesOpenWhereMoreThanTwoFacesMeet) {
  Shape fan;  // three triangles at one edge
  fan.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}};
  fan.faces = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const Tile tile = as_tile(fan);
  const internal::Joined_faces joined(tile.corners, tile.points.size());
  EXPECT_TRUE(joined.sides.empty());
  EXPECT_EQ(joined.open_ends.size(), 9U);
}

TEST(TurnHistogram, KeepsMedianAndMeansWithinItsSteps) {
  using Histogram = internal::Turn_histogram;
  std::vector<double> turns;
  for (std::size_t i = 1; i <= 2001; ++i) turns.push_back(0.0007 * static_cast<double>(i));
  const auto half = turns.begin() + 1000;
  Histogram::Counts sum = Histogram::counts({half, turns.end()});
  Histogram::add(Histogram::counts({turns.begin(), half}), sum);
  EXPECT_EQ(sum, Histogram::counts(turns));
  EXPECT_NEAR(Histogram::median(sum), turns[1000], Histogram::step * turns[1000]);
  const double mean = std::accumulate(turns.begin(), turns.end(), 0.) / static_cast<double>(turns.size());
  EXPECT_NEAR(Histogram::mean(sum, [](double t) { return t; }), mean, 1e-3 * mean);
  EXPECT_EQ(Histogram::counts({0.1, 0.5, 0.1}).size(), 2U);  // no more than it has to hold
  EXPECT_EQ(Histogram::median({}), 0);
  EXPECT_EQ(Histogram::median(Histogram::counts({0, 0, 1e-9})), 0);
}

}  // namespace

}  // namespace test_tiled_segmentation
