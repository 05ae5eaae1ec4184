// SPDX-License-Identifier: MIT

// Connected parts of a mesh that comes in tiles, beside each part by itself.

#include <RW_segmentation/tile_plan.h>

#include <RW_segmentation/Merge_tree.h>
#include <RW_segmentation/Tile.h>
#include <RW_segmentation/tiled_segmentation.h>
#include <RW_segmentation/tiled_surfaces.h>

#include <Eigen/Core>

#include <gtest/gtest.h>
#include "../benchmark/segmentation_measures.h"
#include "cut_into_tiles.h"
#include "meshes.h"
#include "solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace test_tile_parts {

using namespace RW_segmentation;
using namespace tiles;

namespace {

using Index = Dual_mesh::Index;
using Labels = std::vector<std::size_t>;
using meshes::Shape;

Shape dumbbell(std::size_t around = 24) { return meshes::two_spheres_with_neck(2.0001, 0.1, around); }

/// Shapes in a row along x, a gap apart; tiles of half that size cut through most of them.
Shape in_a_row(const std::vector<Shape>& shapes) {
  constexpr double gap = 3;
  Shape row;
  double x = 0;
  for (const Shape& shape : shapes) row = meshes::together(row, meshes::moved(shape, {x += gap, 0, 0}));
  return row;
}

Cut_mesh in_cells(const Shape& shape, std::size_t tiles) {
  return cut(shape, tiles, [&](const Eigen::Vector3d& p) {
    const auto cell = static_cast<std::size_t>((p[0] + 1000) / 1.3) + static_cast<std::size_t>(p[2] > 0.2);
    return cell % tiles;
  });
}

std::size_t number_of(const Labels& labels) { return std::set<std::size_t>(labels.begin(), labels.end()).size(); }

/// The labels of one shape of a row.
Labels part_of(const Labels& labels, const std::vector<Shape>& shapes, std::size_t part) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < part; ++i) begin += shapes[i].faces.size();
  const auto at = [&](std::size_t face) { return labels.begin() + static_cast<std::ptrdiff_t>(face); };
  return {at(begin), at(begin + shapes[part].faces.size())};
}

template <class Hierarchy>
Labels by_shape(const Cut_mesh& mesh, const Hierarchy& hierarchy) {
  return mesh.of_whole(hierarchy.segments(Cost_threshold_stop(1)(hierarchy.tree)));
}

double rand_error(const Labels& a, const Labels& b) { return segmentation_measures::Overlaps(a, b).rand_index_error(); }

Tile_parts parts_of(const std::vector<Tile>& tiles, bool by_component = true) {
  std::vector<std::vector<Tile_survey>> surveys;
  for (const Tile& tile : tiles) {
    surveys.emplace_back();
    for (const Tile_piece& piece : connected_pieces(tile)) surveys.back().push_back(survey_tile(piece.tile));
  }
  return parts_of_tiles(surveys, 0, by_component);
}

/// Points in a box of size 1, some of them in rows, as borders of tiles.
std::vector<Tile_survey> scattered_borders(std::mt19937& random, std::size_t tiles, std::size_t points) {
  std::uniform_real_distribution<double> coordinate(0, 1);
  std::vector<Tile_survey> surveys(tiles);
  for (Tile_survey& survey : surveys) {
    survey.faces = points;
    for (std::size_t i = 0; i < points; ++i) {
      Eigen::Vector3d p(coordinate(random), coordinate(random), coordinate(random));
      if (i % 2 == 0) p = {std::round(8 * p[0]) / 8, 0.5, 0.5};
      survey.border_vertices.push_back(static_cast<Index>(i));
      survey.border_points.push_back(p);
      survey.box.extend(p);
    }
  }
  return surveys;
}

/// For each point on a border the first one that it is the same as, by comparing all.
std::vector<std::size_t> same_points(const std::vector<Eigen::Vector3d>& points, double tolerance) {
  std::vector<std::size_t> first(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    first[i] = i;
    for (std::size_t j = 0; j < i; ++j) {
      if ((points[i] - points[j]).norm() > tolerance || first[i] == first[j]) continue;
      const auto [low, high] = std::minmax({first[i], first[j]});
      std::replace(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(i + 1), std::size_t(high),
                   std::size_t(low));
    }
  }
  return first;
}

}  // namespace

// ---- Borders ----

TEST(BordersOfTiles, HaveTheSameVerticesWhateverTheTolerance) {
  constexpr std::size_t tiles = 3, points = 60;
  std::mt19937 random(3);
  for (const double tolerance : {1e-3, 0.02, 0.05, 0.1, 0.125, 0.2, 0.4, 1., 2., 1e9}) {
    const auto surveys = scattered_borders(random, tiles, points);
    std::vector<Eigen::Vector3d> all;
    for (const Tile_survey& survey : surveys)
      all.insert(all.end(), survey.border_points.begin(), survey.border_points.end());
    const std::vector<std::size_t> same = same_points(all, tolerance);
    std::vector<std::set<Index>> neighbours(tiles);
    std::set<std::pair<std::size_t, std::size_t>> shared;  // a point and the first one that it is the same as
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < all.size(); ++j)
        if (same[i] == same[j] && i / points != j / points) {
          neighbours[i / points].insert(static_cast<Index>(j / points));
          shared.emplace(i, same[i]);
        }
    const Tile_plan plan = plan_tiles(surveys, tolerance);
    std::set<std::pair<std::size_t, std::size_t>> planned;
    std::map<Index, std::size_t> first;
    for (std::size_t t = 0; t < tiles; ++t) {
      EXPECT_EQ(std::set<Index>(plan.tiles[t].neighbours.begin(), plan.tiles[t].neighbours.end()), neighbours[t]);
      for (const auto& [vertex, id] : plan.tiles[t].shared_vertices) {
        const std::size_t point = t * points + vertex;
        planned.emplace(point, first.try_emplace(id, same[point]).first->second);
      }
    }
    EXPECT_EQ(planned, shared) << tolerance;
  }
}

TEST(BordersOfTiles, AreNotComparedPairByPairUnderALargeTolerance) {
  constexpr std::size_t points = 200000;  // pair by pair the tests' time limit ends it
  const auto rows = [](double between) {
    std::vector<Tile_survey> surveys(2);
    for (std::size_t i = 0; i < points; ++i) {
      surveys[0].border_points.emplace_back(static_cast<double>(i), 0, 0);
      surveys[1].border_points.emplace_back(static_cast<double>(i), between, 0);
      for (Tile_survey& survey : surveys) survey.border_vertices.push_back(static_cast<Index>(i));
    }
    return surveys;
  };
  for (const double tolerance : {2., 1e4, 1e9}) {
    const Tile_plan plan = plan_tiles(rows(tolerance / 2), tolerance);
    EXPECT_EQ(plan.tiles[0].shared_vertices.size(), points);
    EXPECT_EQ(plan.tiles[1].shared_vertices.front().id, plan.tiles[0].shared_vertices.back().id);
    EXPECT_TRUE(plan_tiles(rows(1.5 * tolerance), tolerance).tiles[0].shared_vertices.empty());
  }
}

TEST(BordersOfTiles, RefuseATolerancePastTheirEdges) {
  const Cut_mesh mesh = octants(meshes::sphere(2));  // whose edges are .27 long at least
  std::vector<Tile_survey> surveys;
  for (const Tile& tile : mesh.tiles) surveys.push_back(survey_tile(tile));
  for (const double tolerance : {0.1, 0.4}) {
    const Tile_plan plan = plan_tiles(surveys, tolerance);
    for (std::size_t t = 0; t < mesh.tiles.size(); ++t) {
      Tile_noise noise;
      Tile_neighbourhoods neighbourhoods;
      const auto for_walks = [&] { border_of_tile(mesh.tiles[t], {t, plan}, noise); };
      const auto for_surfaces = [&] { border_of_tile(mesh.tiles[t], {t, plan}, neighbourhoods, Tiled_surfaces()); };
      if (tolerance < 0.2) {
        EXPECT_NO_THROW(for_walks());
        EXPECT_NO_THROW(for_surfaces());
      } else {
        EXPECT_THROW(for_walks(), std::invalid_argument);
        EXPECT_THROW(for_surfaces(), std::invalid_argument);
      }
    }
  }
}

TEST(BordersOfTiles, MayHaveFacesWithTwoCornersInOnePlace) {
  const Tile tile = as_tile({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}}, {{0, 1, 2}, {1, 3, 2}}});
  const Tile other = as_tile({{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  const Tile_plan plan = plan_tiles({survey_tile(tile), survey_tile(other)});
  EXPECT_EQ(plan.tiles[0].neighbours.size(), 1U);
  Tile_noise noise;
  EXPECT_NO_THROW(border_of_tile(tile, {0, plan}, noise));
}

// ---- Pieces ----

TEST(ConnectedPieces, AreFacesOfATileWithTheirVerticesIdsAndWalls) {
  Tile tile = as_tile(meshes::together(meshes::cube(2), meshes::moved(meshes::plane(3), {0, 0, 5})));
  for (std::uint64_t v = 0; v < tile.points.size(); ++v) tile.vertex_ids.push_back(100 + v);
  const auto last = static_cast<Index>(tile.number_of_faces() - 1);
  const auto side_of = [&](Index face) { return std::array{tile.corners[face][0], tile.corners[face][1]}; };
  tile.walls = {side_of(5), side_of(last)};
  const std::vector<Tile_piece> pieces = connected_pieces(tile);
  ASSERT_EQ(pieces.size(), 2U);
  std::vector<int> seen(tile.number_of_faces(), 0);
  for (const auto& [piece, faces] : pieces) {
    ASSERT_EQ(piece.number_of_faces(), faces.size());
    EXPECT_TRUE(std::is_sorted(faces.begin(), faces.end()));
    EXPECT_EQ(piece.walls.size(), 1U);
    for (Index f = 0; f < faces.size(); ++f) {
      ++seen[faces[f]];
      for (std::size_t k = 0; k < 3; ++k) {
        const Index of_piece = piece.corners[f][k], of_tile = tile.corners[faces[f]][k];
        EXPECT_EQ(piece.points[of_piece], tile.points[of_tile]);
        EXPECT_EQ(piece.vertex_ids[of_piece], tile.vertex_ids[of_tile]);
      }
    }
    EXPECT_NO_THROW(survey_tile(piece));  // which refuses walls that are no sides
  }
  EXPECT_EQ(seen, std::vector<int>(tile.number_of_faces(), 1));
  EXPECT_EQ(pieces[0].faces.size(), 48U);
}

TEST(ConnectedPieces, OfOneComponentAreTheTile) {
  const Tile tile = as_tile(meshes::cube(2));
  const auto pieces = connected_pieces(tile);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].tile.points, tile.points);
  EXPECT_EQ(pieces[0].faces.size(), tile.number_of_faces());
  EXPECT_TRUE(connected_pieces(Tile()).empty());
}

TEST(ConnectedPieces, AreNotMadeOfATileThatIsWrong) {
  Tile tile;
  tile.points = {{0, 0, 0}, {1, 0, 0}};
  for (const Index v : {0U, 1U, 2U}) tile.corners.add(v);
  tile.corners.end_face();
  EXPECT_THROW(connected_pieces(tile), std::invalid_argument);

  Tile two = as_tile(meshes::together(meshes::cube(1), meshes::moved(meshes::cube(1), {5, 0, 0})));
  two.walls = {{0, 15}};  // from one to the other
  EXPECT_THROW(connected_pieces(two), std::invalid_argument);
  EXPECT_THROW(hierarchy_of_tiles({two}), std::invalid_argument);
}

// ---- Parts ----

TEST(PartsOfTiles, AreThePiecesThatMeetEachWithThePlanThatItHasAlone) {
  const std::vector<Shape> shapes = {dumbbell(), meshes::scaled(meshes::cube(8), 1.2), meshes::sphere(2)};
  const Cut_mesh mesh = in_cells(in_a_row(shapes), 4);
  const Tile_parts parts = parts_of(mesh.tiles);
  ASSERT_EQ(parts.parts.size(), 3U);
  std::size_t faces = 0, pieces = 0;
  double area = 0;
  for (std::size_t p = 0; p < parts.parts.size(); ++p) {
    const auto& [plan, of_part, area_of_part] = parts.parts[p];
    faces += plan.faces;
    area += area_of_part;
    pieces += of_part.size();
    EXPECT_EQ(plan.tiles.size(), of_part.size());
    EXPECT_EQ(plan.faces_of_mesh, mesh.place.size());
    for (std::size_t i = 0; i < of_part.size(); ++i) {
      const auto& [part, number] = parts.places[of_part[i].tile][of_part[i].place];
      EXPECT_EQ(part, p);
      EXPECT_EQ(number, i);
      for (const auto& neighbour : parts.neighbours(of_part[i].tile, of_part[i].place)) {
        EXPECT_EQ(parts.places[neighbour.tile][neighbour.place].part, p);
        EXPECT_NE(neighbour.tile, of_part[i].tile);
      }
    }
  }
  EXPECT_GT(pieces, 2 * parts.parts.size());  // tiles do cut through parts
  EXPECT_EQ(faces, mesh.place.size());
  std::vector<Tile_survey> surveys;
  for (const Tile& tile : mesh.tiles) surveys.push_back(survey_tile(tile));
  const Tile_plan whole = plan_tiles(surveys);
  EXPECT_NEAR(area, whole.total_area * whole.box.unit * whole.box.unit, 1e-9);
  EXPECT_EQ(parts.box.unit, whole.box.unit);

  const Tile_parts together = parts_of(mesh.tiles, false);
  ASSERT_EQ(together.parts.size(), 1U);
  EXPECT_EQ(together.parts.front().plan.faces, mesh.place.size());
}

TEST(PartsOfTiles, MeetBetweenTilesButNotOverCracksWithinOne) {
  const Shape left = meshes::plane(2), right = meshes::moved(meshes::plane(2), {1, 0, 0});  // with vertices of its own
  EXPECT_EQ(parts_of({as_tile(meshes::together(left, right))}).parts.size(), 2U);
  EXPECT_EQ(parts_of({as_tile(left), as_tile(right)}).parts.size(), 1U);
}

TEST(PartsOfTiles, DoNotMeetInASingleVertex) {
  const Shape left = meshes::plane(2), right = meshes::moved(meshes::plane(2), {1, 1, 0});
  EXPECT_EQ(parts_of({as_tile(left), as_tile(right)}).parts.size(), 2U);
  EXPECT_EQ(parts_of({as_tile(left), as_tile(right)}, false).parts.size(), 1U);
}

TEST(PartsOfTiles, AreRefusedUnderATolerancePastTheirEdges) {
  const Cut_mesh mesh = octants(meshes::sphere(2));  // whose edges are .32 long at most
  for (const double tolerance : {0.4, 0.9, 5.}) {
    Tiled_segmentation by_walks;
    Tiled_surfaces by_surfaces;
    by_walks.tolerance = by_surfaces.tolerance = tolerance;
    EXPECT_THROW(hierarchy_of_tiles(mesh.tiles, by_walks), std::invalid_argument) << tolerance;
    EXPECT_THROW(hierarchy_of_tiled_surfaces(mesh.tiles, by_surfaces), std::invalid_argument) << tolerance;
  }
}

TEST(PartsOfTiles, DoNotMeetInASingleVertexThatATileHasSeveralTimes) {
  const Shape two_planes = meshes::together(meshes::plane(2), meshes::moved(meshes::plane(2), {-1, -1, 0}));
  std::vector<std::vector<Tile_survey>> surveys;  // two vertices of each are at the origin, no others meet
  for (const double scale : {1., 0.7}) surveys.push_back({survey_tile(as_tile(meshes::scaled(two_planes, scale)))});
  for (const double tolerance : {0., 0.01}) EXPECT_EQ(parts_of_tiles(surveys, tolerance).parts.size(), 2U) << tolerance;
}

TEST(PartsOfTiles, FarSmallerThanTheWholeHaveABoxOfAHundredth) {
  const Cut_mesh mesh =
      in_cells(meshes::together(meshes::scaled(meshes::cube(2), 1000), meshes::moved(meshes::cube(2), {-5, 0, 0})), 3);
  const Tile_parts parts = parts_of(mesh.tiles);
  ASSERT_EQ(parts.parts.size(), 2U);
  std::array<double, 2> units{}, areas{};
  for (std::size_t p = 0; p < 2; ++p) {
    const auto& plan = parts.parts[p].plan;
    units[p] = plan.box.unit;
    areas[p] = plan.total_area * plan.box.unit * plan.box.unit;
    EXPECT_NEAR(areas[p], parts.parts[p].area, 1e-9 * parts.parts[p].area);
  }
  EXPECT_NEAR(*std::min_element(units.begin(), units.end()), parts.box.unit / 100, 1e-12 * parts.box.unit);
  EXPECT_NEAR(*std::min_element(areas.begin(), areas.end()), 6, 1e-9);
}

// ---- Segments ----

TEST(TiledParts, HaveTheSegmentsThatEachHasByItself) {
  const std::vector<Shape> shapes = {dumbbell(), meshes::scaled(dumbbell(32), 0.4), meshes::sphere(3), dumbbell(20)};
  const Cut_mesh mesh = in_cells(in_a_row(shapes), 5);
  const Tiled_hierarchy hierarchy = hierarchy_of_tiles(mesh.tiles);
  EXPECT_EQ(hierarchy.components, 4U);
  EXPECT_EQ(hierarchy.tree.number_of_components(), 4U);
  const Labels labels = by_shape(mesh, hierarchy);
  for (std::size_t part = 0; part < shapes.size(); ++part) {
    // The same faces in the same tiles, and nothing else in them.
    Shape alone = in_a_row(shapes);
    std::vector<std::vector<std::size_t>> faces;
    std::size_t first = 0;
    for (std::size_t i = 0; i < part; ++i) first += shapes[i].faces.size();
    for (std::size_t f = 0; f < shapes[part].faces.size(); ++f) faces.push_back(alone.faces[first + f]);
    alone.faces = faces;
    const Cut_mesh cut_alone = in_cells(alone, 5);
    const Labels of_part = part_of(labels, shapes, part),
                 by_itself = by_shape(cut_alone, hierarchy_of_tiles(cut_alone.tiles));
    EXPECT_EQ(number_of(of_part), number_of(by_itself));
    EXPECT_EQ(rand_error(of_part, by_itself), 0);
  }
  EXPECT_EQ(number_of(part_of(labels, shapes, 1)), 2U);
}

TEST(TiledParts, AreTakenTogetherWhereTheOptionsSaySo) {
  const std::vector<Shape> shapes(20, dumbbell(16));
  const Cut_mesh mesh = in_cells(in_a_row(shapes), 3);
  EXPECT_EQ(number_of(by_shape(mesh, hierarchy_of_tiles(mesh.tiles))), 40U);
  Tiled_segmentation options;
  options.by_component = false;
  EXPECT_LT(number_of(by_shape(mesh, hierarchy_of_tiles(mesh.tiles, options))), 40U);
}

TEST(TiledParts, FarSmallerThanTheLargestAreOneSegment) {
  const std::vector<Shape> shapes = {meshes::scaled(dumbbell(), 1.2), meshes::scaled(dumbbell(), 0.11)};
  const Cut_mesh mesh = in_cells(in_a_row(shapes), 4);
  const Labels labels = by_shape(mesh, hierarchy_of_tiles(mesh.tiles));
  EXPECT_EQ(number_of(part_of(labels, shapes, 0)), 2U);
  EXPECT_EQ(number_of(part_of(labels, shapes, 1)), 1U);
  Tiled_segmentation options;
  options.least_component = 0;
  EXPECT_EQ(number_of(part_of(by_shape(mesh, hierarchy_of_tiles(mesh.tiles, options)), shapes, 1)), 2U);
}

TEST(TiledParts, GetEveryNumberOfSegmentsTogether) {
  const Cut_mesh mesh = in_cells(in_a_row({dumbbell(16), meshes::sphere(2), dumbbell(16)}), 3);
  const Tiled_hierarchy hierarchy = hierarchy_of_tiles(mesh.tiles);
  for (std::size_t n = 3; n <= hierarchy.tree.number_of_fragments(); n += 4)
    EXPECT_EQ(number_of(mesh.of_whole(hierarchy.segments(n))), n);
  EXPECT_THROW(hierarchy.segments(2), std::invalid_argument);
}

// ---- Surfaces ----

TEST(TiledPartsOfAnAssembly, AreAsExactAsByThemselves) {
  // A shaft and a copy of a thirtieth of its size, whose fillets are finer than what counts as exact on the whole.
  const solids::Solid solid = solids::stepped_shaft(solids::by_kernel());
  const Shape shape = {solid.points, solid.faces};
  const std::vector<Shape> shapes = {shape, meshes::scaled(shape, 1. / 30)};
  const Cut_mesh mesh = in_cells(meshes::together(shape, meshes::moved(shapes[1], {9, 9, 9})), 3);
  const Tiled_surface_hierarchy hierarchy = hierarchy_of_tiled_surfaces(mesh.tiles);
  const Labels labels = by_shape(mesh, hierarchy);
  EXPECT_EQ(hierarchy.noise.deviation, 0);
  for (std::size_t part = 0; part < 2; ++part) EXPECT_LE(rand_error(part_of(labels, shapes, part), solid.label), 0.002);
  // Their surfaces are told in the coordinates of the tiles.
  const std::size_t segments = Cost_threshold_stop(1)(hierarchy.tree);
  const auto surfaces = hierarchy.surfaces(segments);
  ASSERT_EQ(surfaces.size(), segments);
  std::array<double, 2> largest_radius{};
  for (std::size_t f = 0; f < labels.size(); ++f) {
    const Analytic_surface& surface = surfaces[labels[f]];
    double& largest = largest_radius[f < shape.faces.size() ? 0 : 1];
    if (surface.type == Surface_type::cylinder) largest = std::max(largest, surface.radius);
  }
  EXPECT_NEAR(30 * largest_radius[1], largest_radius[0], 1e-6 * largest_radius[0]);
}

TEST(TiledPartsOfAnAssembly, AreAsNoisyAsTheWhole) {
  const solids::Solid solid = solids::with_noise(solids::stepped_shaft(solids::even(0.2)), 0.1);
  const Shape shape = {solid.points, solid.faces};
  const Shape both = meshes::together(shape, meshes::moved(shape, {20, 0, 0}));
  const auto alone = hierarchy_of_tiled_surfaces(in_cells(shape, 3).tiles);
  const auto of_both = hierarchy_of_tiled_surfaces(in_cells(both, 3).tiles);
  const double of_one = alone.noise.deviation * alone.parts.box.unit,
               of_two = of_both.noise.deviation * of_both.parts.box.unit;
  EXPECT_GT(of_one, 0);
  EXPECT_NEAR(of_two, of_one, 0.1 * of_one);
  EXPECT_NEAR(of_both.noise.in_part(of_both.parts, 1).deviation * of_both.parts.parts[1].plan.box.unit, of_two,
              1e-12 * of_two);
}

}  // namespace test_tile_parts
