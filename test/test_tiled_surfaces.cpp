// SPDX-License-Identifier: MIT

// Surfaces of a mesh in tiles beside those of the same mesh as a whole, and beside what the solid is made of.

#include <RW_segmentation/tiled_surfaces.h>

#include <RW_segmentation/Analytic_surface.h>
#include <RW_segmentation/Tile.h>
#include <RW_segmentation/segmentation_into_surfaces.h>

#include <CGAL/tags.h>

#include <gtest/gtest.h>
#include "../benchmark/segmentation_measures.h"
#include "cut_into_tiles.h"
#include "meshes.h"
#include "solids.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace test_tiled_surfaces {

using namespace RW_segmentation;
using namespace tiles;

namespace {

using Index = Dual_mesh::Index;
using Labels = std::vector<std::size_t>;
using meshes::Shape;

constexpr double degree = solids::half_turn / 180;

Shape shape_of(const solids::Solid& solid) { return {solid.points, solid.faces}; }

double rand_error(const Labels& a, const Labels& b) { return segmentation_measures::Overlaps(a, b).rand_index_error(); }

std::size_t segments_by_shape(const Tiled_surface_hierarchy& hierarchy) {
  return Cost_threshold_stop(1)(hierarchy.tree);
}

/// The segments of a mesh in tiles, in the order of its faces.
Labels segments_of(const Cut_mesh& mesh, const Tiled_surfaces& options = {}) {
  const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces(mesh.tiles, options);
  return mesh.of_whole(hierarchy.segments(segments_by_shape(hierarchy)));
}

Labels segments_of_whole(const Shape& shape) {
  auto mesh = meshes::surface_mesh(shape);
  const auto ids = mesh.add_property_map<meshes::Surface_mesh::Face_index, std::size_t>("f:id").first;
  segmentation_into_surfaces(mesh, ids);
  return {ids.begin(), ids.end()};
}

// ---- Solids ----

TEST(TiledSurfaces, AreThoseThatASolidIsMadeOfHoweverItIsCut) {
  for (const solids::Solid& solid : solids::all(solids::even(0.15))) {
    const Shape shape = shape_of(solid);
    const double of_whole = rand_error(segments_of_whole(shape), solid.label);
    for (const Cut_mesh& mesh : {octants(shape), slices(shape, 3)})
      EXPECT_LE(rand_error(segments_of(mesh), solid.label), of_whole) << solid.name;
  }
}

TEST(TiledSurfaces, OfMeshesOfAKernelAreThoseOfTheWhole) {
  for (const solids::Solid& solid : solids::all(solids::by_kernel())) {
    const Shape shape = shape_of(solid);
    EXPECT_LE(rand_error(segments_of(octants(shape)), segments_of_whole(shape)), 0.002) << solid.name;
  }
}

TEST(TiledSurfaces, OfNoisyTilesAreNearlyThoseOfTheWhole) {
  // For a draw of the noise by chance; means over eight solids and three draws are .006 and .002.
  const solids::Meshing meshing = solids::even(0.2);
  for (const solids::Solid& clean : {solids::stepped_shaft(meshing), solids::pipe_elbow(meshing)}) {
    const solids::Solid solid = solids::with_noise(clean, 0.1);
    const double of_whole = rand_error(segments_of_whole(shape_of(solid)), solid.label);
    EXPECT_LE(rand_error(segments_of(octants(shape_of(solid))), solid.label), of_whole + 0.02) << solid.name;
  }
}

TEST(TiledSurfaces, OfOneTileAreThoseOfTheMesh) {
  const solids::Solid solid = solids::stepped_shaft(solids::even(0.15));
  Cut_mesh mesh = slices(shape_of(solid), 1);
  EXPECT_EQ(rand_error(segments_of(mesh), segments_of_whole(shape_of(solid))), 0);
}

/// A cylinder without ends, which is given in numbers.
struct Given_cylinder {
  Eigen::Vector3d point{3, -2, 1}, axis = Eigen::Vector3d(1, 2, -1).normalized();
  double radius = 0.7;

  Shape shape(double height = 6) const {
    const Shape along_z = meshes::scaled(meshes::tube(height / radius, 60, 80), radius);
    Eigen::Affine3d map = Eigen::Affine3d::Identity();
    map.translate(point);
    map.rotate(Eigen::AngleAxisd(solids::half_turn, (Eigen::Vector3d::UnitZ() + axis).normalized()));
    return meshes::transformed(along_z, map);
  }
};

TEST(TiledSurfaces, HaveTheNumbersOfTheWholeInTheCoordinatesOfTheTiles) {
  const Given_cylinder given;
  const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces(slices(given.shape(), 7).tiles);
  ASSERT_EQ(segments_by_shape(hierarchy), 1U);
  const Analytic_surface surface = hierarchy.surfaces(1)[0];
  ASSERT_EQ(surface.type, Surface_type::cylinder);
  EXPECT_NEAR(surface.radius, given.radius, 1e-6);
  EXPECT_NEAR(std::abs(surface.direction.dot(given.axis)), 1, 1e-9);
  EXPECT_NEAR((surface.point - given.point).cross(given.axis).norm(), 0, 1e-6);
}

TEST(TiledSurfaces, ThatAreCloseButNotTheSameStayApart) {
  // Two steps of a shaft whose radii differ by a hundredth, each in a tile of its own.
  const Shape shape = meshes::revolve({{1, 0}, {1, 1}, {1, 2}, {1.01, 2}, {1.01, 3}, {1.01, 4}}, 48);
  const Cut_mesh mesh = cut(shape, 2, [](const Eigen::Vector3d& p) { return std::size_t(p[2] > 2); });
  const Labels labels = segments_of(mesh);
  for (std::size_t f = 0; f < labels.size(); ++f)
    for (std::size_t g = 0; g < f; ++g)
      EXPECT_TRUE(mesh.place[f].first == mesh.place[g].first || labels[f] != labels[g]);
}

/// A sheet that no analytic surface fits.
Shape waves() {
  Shape shape = meshes::plane(60);
  for (Eigen::Vector3d& p : shape.points)
    p[2] = 0.06 * std::sin(7 * p[0]) * std::cos(5 * p[1]) + 0.05 * std::sin(9 * p[0] * p[1]);
  return shape;
}

TEST(TiledSurfaces, GoOnWhereAFreeFormDoes) {
  const Shape shape = waves();
  const Cut_mesh mesh = slices(shape, 4);
  const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces(mesh.tiles);
  const std::size_t segments = segments_by_shape(hierarchy);
  const auto labels = hierarchy.segments(segments);
  std::vector<std::size_t> faces(segments, 0);
  std::vector<std::set<std::size_t>> tiles(segments);
  for (std::size_t t = 0; t < mesh.tiles.size(); ++t)
    for (const std::size_t segment : labels[t]) {
      ++faces[segment];
      tiles[segment].insert(t);
    }
  const auto largest = static_cast<std::size_t>(std::max_element(faces.begin(), faces.end()) - faces.begin());
  EXPECT_EQ(hierarchy.surfaces(segments)[largest].type, Surface_type::free_form);
  EXPECT_EQ(tiles[largest].size(), 4U);
  EXPECT_GE(static_cast<double>(faces[largest]), 0.7 * static_cast<double>(shape.faces.size()));
}

// ---- Noise ----

std::vector<Tile_neighbourhoods> neighbourhoods_of(const std::vector<Tile>& tiles, Tile_plan& plan) {
  std::vector<Tile_survey> surveys;
  for (const Tile& tile : tiles) surveys.push_back(survey_tile(tile));
  plan = plan_tiles(surveys);
  std::vector<Tile_neighbourhoods> neighbourhoods(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t)
    border_of_tile(tiles[t], {t, plan}, neighbourhoods[t], Tiled_surfaces());
  return neighbourhoods;
}

Surface_noise noise_of(const std::vector<Tile>& tiles) {
  Tile_plan plan;
  const auto neighbourhoods = neighbourhoods_of(tiles, plan);
  return noise_of_tiles(plan, neighbourhoods);
}

TEST(TiledSurfaces, EstimateTheNoiseOfTheWhole) {
  const solids::Solid clean = solids::stepped_shaft(solids::even(0.15));
  EXPECT_EQ(noise_of(octants(shape_of(clean)).tiles).deviation, 0);
  for (const bool is_scanned : {false, true}) {
    const solids::Solid solid = is_scanned ? solids::scanned(clean, 0.2) : solids::with_noise(clean, 0.2);
    const auto mesh = meshes::surface_mesh(shape_of(solid));
    const internal::Surface_tolerance whole = internal::surface_tolerance(Dual_mesh_of<meshes::Surface_mesh>(mesh), -1);
    const Surface_noise tiled = noise_of(octants(shape_of(solid)).tiles);
    EXPECT_NEAR(tiled.deviation, whole.noise, 0.1 * whole.noise);
    EXPECT_EQ(internal::may_be_independent(tiled.kind), !is_scanned);
  }
}

TEST(TiledSurfaces, KnowHowFarCoordinatesWereRounded) {
  constexpr double percent = 0.01;
  const solids::Solid solid = solids::with_rounded_coordinates(solids::stepped_shaft(solids::even(0.15)), percent);
  const double deviation = percent / 100 / std::sqrt(12);  // of what is spread evenly over a step
  EXPECT_NEAR(noise_of(octants(shape_of(solid)).tiles).deviation, deviation, 0.02 * deviation);
}

TEST(TiledSurfaces, KnowHowFarCoordinatesOfSeveralPartsWereRounded) {
  constexpr double percent = 0.01;
  const Shape large = shape_of(solids::stepped_shaft(solids::even(0.15)));
  Shape small = large;
  for (Eigen::Vector3d& p : small.points) p = 0.37 * p + Eigen::Vector3d(6, 1, 2);
  const Shape both = meshes::together(large, small);
  solids::Solid solid;
  solid.points = both.points;
  solid.faces = both.faces;
  const Shape rounded = shape_of(solids::with_rounded_coordinates(solid, percent));
  const double deviation = percent / 100 / std::sqrt(12);
  EXPECT_NEAR(hierarchy_of_tiled_surfaces(octants(rounded).tiles).noise.deviation, deviation, 0.02 * deviation);
}

TEST(TiledSurfaces, LookAtAsManyNeighbourhoodsHoweverManyTilesThereAre) {
  const Shape shape = shape_of(solids::pipe_elbow(solids::even(0.1)));
  for (const std::size_t tiles : {1U, 8U, 200U}) {
    Tile_plan plan;
    std::size_t count = 0;
    for (const auto& of_tile : neighbourhoods_of(slices(shape, tiles).tiles, plan)) count += of_tile.middles.size();
    EXPECT_GE(count, 300U) << tiles;
    EXPECT_LE(count, 900U) << tiles;
  }
}

TEST(TiledSurfaces, ReckonWithTheNoiseThatIsGiven) {
  Tiled_surfaces options;
  options.noise = 0.01;
  const Shape shape = shape_of(solids::box(solids::even(0.3)));
  EXPECT_EQ(hierarchy_of_tiled_surfaces(slices(shape, 2).tiles, options).noise.deviation, 0.01);
}

// ---- Steps ----

TEST(TiledSurfaces, AreTheSameForTilesInAnotherOrder) {
  const Shape shape = shape_of(solids::blended_slot(solids::even(0.15)));
  const Cut_mesh mesh = octants(shape);
  Cut_mesh turned = mesh;
  std::reverse(turned.tiles.begin(), turned.tiles.end());
  for (auto& [tile, face] : turned.place) tile = turned.tiles.size() - 1 - tile;
  EXPECT_EQ(rand_error(segments_of(mesh), segments_of(turned)), 0);
}

TEST(TiledSurfaces, AreTheSameWithAndWithoutThreads) {
  const Cut_mesh mesh = octants(shape_of(solids::flange(solids::even(0.15))));
  const Tiled_surfaces options;
  const auto one = hierarchy_of_tiled_surfaces<CGAL::Sequential_tag>(mesh.tiles, options);
  const auto many = hierarchy_of_tiled_surfaces(mesh.tiles, options);
  EXPECT_EQ(one.fragment_of_face, many.fragment_of_face);
  EXPECT_EQ(segments_by_shape(one), segments_by_shape(many));
}

TEST(TiledSurfaces, KeepSamplesOfEachRegionAndNoMore) {
  const Cut_mesh mesh = octants(shape_of(solids::stepped_shaft(solids::even(0.05))));
  const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces(mesh.tiles);
  std::size_t most = 0;
  for (const Tile_surfaces& tile : hierarchy.of_parts.front().regions) {
    std::map<Index, std::size_t> samples;
    for (const Index region : tile.region_of) ++samples[region];
    EXPECT_EQ(samples.size(), tile.areas.size());
    for (const auto& [region, count] : samples) most = std::max(most, count);
  }
  EXPECT_EQ(most, 200U);
}

TEST(TiledSurfaces, HaveAreasThatAddUpToTheWhole) {
  const Cut_mesh mesh = octants(shape_of(solids::capsule(solids::even(0.15))));
  double sum = 0;
  const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces(mesh.tiles);
  for (const Tile_surfaces& tile : hierarchy.of_parts.front().regions)
    for (const double area : tile.areas) sum += area;
  EXPECT_NEAR(sum, 1, 1e-9);
}

TEST(TiledSurfaces, EndAtWalls) {
  // A cylinder whose upper half is walled off, by edges inside tiles and between them.
  const Given_cylinder given;
  const Shape shape = given.shape();
  const auto is_upper = [&](const Eigen::Vector3d& p) { return (p - given.point).dot(given.axis) > 3; };
  const Walled_part upper(shape, is_upper);
  for (const Cut_mesh& open : {octants(shape), slices(shape, 5), cut(shape, 2, is_upper)}) {
    const Cut_mesh mesh = with_walls(open, shape, upper.walls);
    const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces(mesh.tiles);
    EXPECT_EQ(hierarchy.components, 2U);
    EXPECT_EQ(hierarchy.walls, 60U);  // once round, the ends of the tube left out
    EXPECT_EQ(upper.on_both_sides(mesh.of_whole(hierarchy.segments(2))).size(), 0U);
    EXPECT_EQ(segments_by_shape(hierarchy), 2U);
    std::set<std::set<std::size_t>> beside_each_other;
    const std::vector<std::size_t> segment = hierarchy.tree.segment_of_fragments(2);
    for (const auto& [a, b] : hierarchy.of_parts.front().merged.neighbours)
      beside_each_other.insert({segment[a], segment[b]});
    EXPECT_EQ(beside_each_other.count({0, 1}), 1U);
  }
}

TEST(TiledSurfaces, EndAtSharpEdgesWhereTheseAreWalls) {
  Tiled_surfaces options;
  options.wall_angle = 5 * degree;  // below the 7.5 degrees that the tube turns along an edge
  const Shape shape = meshes::tube(2, 48, 3);
  for (const Cut_mesh& mesh : {slices(shape, 1), octants(shape)}) {
    const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces(mesh.tiles, options);
    EXPECT_EQ(hierarchy.components, 48U);
  }
}

TEST(TiledSurfaces, OfPolygonsOfEmptyTilesAndOfNoTilesAreFound) {
  Cut_mesh mesh = octants(meshes::cube_of_quads());
  mesh.tiles.emplace_back();
  const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces(mesh.tiles);
  ASSERT_EQ(segments_by_shape(hierarchy), 6U);
  for (const Analytic_surface& surface : hierarchy.surfaces(6)) EXPECT_EQ(surface.type, Surface_type::plane);
  EXPECT_TRUE(hierarchy.fragment_of_face.back().empty());
  EXPECT_EQ(hierarchy_of_tiled_surfaces({}).tree.number_of_fragments(), 0U);
  EXPECT_EQ(hierarchy_of_tiled_surfaces({Tile()}).tree.number_of_fragments(), 0U);
}

TEST(TiledSurfaces, OfTilesThatTouchNowhereStayApart) {
  const Shape shape = meshes::together(meshes::cube(4), meshes::moved(meshes::cube(4), {3, 0, 0}));
  const Cut_mesh mesh = slices(shape, 2);
  const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces(mesh.tiles);
  EXPECT_EQ(hierarchy.components, 2U);
  EXPECT_EQ(segments_by_shape(hierarchy), 12U);
}

TEST(TiledSurfaces, DoNotGoOnWhereATileIsInsideOut) {
  Cut_mesh mesh = slices(meshes::cube(6), 2);
  Tile& tile = mesh.tiles[1];
  internal::Face_corners turned;
  for (Index f = 0; f < tile.number_of_faces(); ++f) {
    const auto corners = tile.corners[f];
    for (std::size_t k = corners.size(); k-- > 0;) turned.add(corners[k]);
    turned.end_face();
  }
  tile.corners = turned;
  const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces(mesh.tiles);
  EXPECT_GT(hierarchy.turned_sides, 0U);
  EXPECT_EQ(hierarchy.components, 2U);
}

TEST(TiledSurfaces, RefuseNumbersOutOfRange) {
  const Cut_mesh mesh = slices(meshes::cube(2), 2);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& change : std::vector<void (*)(Tiled_surfaces&, double)>{
           [](Tiled_surfaces&o, double x) { o.noise = x; }, [](Tiled_surfaces&o, double x) { o.halo = x; },
           [](Tiled_surfaces&o, double x) { o.tolerance = x; }}) {
    Tiled_surfaces options;
    change(options, infinity);
    EXPECT_THROW(hierarchy_of_tiled_surfaces(mesh.tiles, options), std::invalid_argument);
  }
  Tiled_surfaces options;
  options.halo = -1;
  EXPECT_THROW(hierarchy_of_tiled_surfaces(mesh.tiles, options), std::invalid_argument);
  options = {};
  options.wall_angle = -1;
  EXPECT_THROW(hierarchy_of_tiled_surfaces(mesh.tiles, options), std::invalid_argument);
}

TEST(TiledSurfaces, ReportTheirProgressAndCanBeCancelled) {
  const Cut_mesh mesh = octants(shape_of(solids::box(solids::even(0.2))));
  std::vector<double> told;
  hierarchy_of_tiled_surfaces(mesh.tiles, Tiled_surfaces(), Progress([&](double done) {
                                told.push_back(done);
                                return true;
                              }));
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1);
  EXPECT_GE(std::set<double>(told.begin(), told.end()).size(), 10U);
  for (const std::size_t calls : {std::size_t(1), told.size() / 2, told.size()}) {
    std::size_t left = calls;
    const Progress progress([&](double) { return --left > 0; });
    EXPECT_THROW(hierarchy_of_tiled_surfaces(mesh.tiles, Tiled_surfaces(), progress), Cancelled);
  }
}

}  // namespace

}  // namespace test_tiled_surfaces
