// SPDX-License-Identifier: MIT

#include <RW_segmentation/internal/surfaces/Analytic_regions.h>
#include <RW_segmentation/internal/surfaces/Cut_facets.h>
#include <RW_segmentation/internal/surfaces/Face_refinement.h>
#include <RW_segmentation/internal/surfaces/Region_fragments.h>
#include <RW_segmentation/internal/surfaces/Surface_tolerance.h>
#include <RW_segmentation/segment_surfaces.h>
#include <RW_segmentation/segmentation_into_surfaces.h>

#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <gtest/gtest.h>
#include "../benchmark/segmentation_measures.h"
#include "meshes.h"
#include "solids.h"
#include "walls.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace test_segmentation_into_surfaces {

using namespace RW_segmentation;

namespace {

using Labels = std::vector<std::size_t>;  // in the order of the faces of a shape

meshes::Shape shape_of(const solids::Solid& solid) { return {solid.points, solid.faces}; }

/// Segments in the order of the faces of a mesh.
template <class Mesh>
Labels segments_of(const Mesh& mesh, const Surface_segmentation& numbers = {}) {
  std::map<typename boost::graph_traits<Mesh>::face_descriptor, std::size_t> ids;
  segmentation_into_surfaces(mesh, boost::make_assoc_property_map(ids), numbers);
  Labels labels;
  for (const auto f : faces(mesh)) labels.push_back(ids.at(f));
  return labels;
}

std::size_t number_of(const Labels& labels) { return std::set<std::size_t>(labels.begin(), labels.end()).size(); }

/// How many pieces faces of the same label form that hang together by edges.
std::size_t number_of_pieces(const meshes::Surface_mesh& mesh, const Labels& labels) {
  std::vector<bool> is_reached(labels.size(), false);
  std::size_t pieces = 0;
  for (const auto first : mesh.faces()) {
    if (is_reached[first]) continue;
    ++pieces;
    is_reached[first] = true;
    std::vector<meshes::Surface_mesh::Face_index> open = {first};
    while (!open.empty()) {
      const auto face = open.back();
      open.pop_back();
      for (const auto next : mesh.faces_around_face(mesh.halfedge(face))) {
        if (next == meshes::Surface_mesh::null_face() || is_reached[next] || labels[next] != labels[face]) continue;
        is_reached[next] = true;
        open.push_back(next);
      }
    }
  }
  return pieces;
}

/// Segments of a solid, each of which must hang together.
Labels segments_of(const solids::Solid& solid, const Surface_segmentation& numbers = {}) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape_of(solid));
  Labels labels = segments_of(mesh, numbers);
  EXPECT_EQ(number_of_pieces(mesh, labels), number_of(labels)) << solid.name;
  return labels;
}

double area_of(const solids::Solid& solid, std::size_t f) {
  const auto& face = solid.faces[f];
  const Eigen::Vector3d &a = solid.points[face[0]], &b = solid.points[face[1]], &c = solid.points[face[2]];
  return (b - a).cross(c - a).norm() / 2;
}

double rand_error(const Labels& a, const Labels& b) { return segmentation_measures::Overlaps(a, b).rand_index_error(); }

/// Of the analytic faces with at least a fiftieth of the area: the best intersection over union with a segment.
std::vector<double> best_overlaps(const solids::Solid& solid, const Labels& segments) {
  std::map<std::size_t, double> of_face, of_segment;
  std::map<std::pair<std::size_t, std::size_t>, double> common;
  double total = 0;
  for (std::size_t f = 0; f < segments.size(); ++f) {
    const double area = area_of(solid, f);
    of_face[solid.label[f]] += area;
    of_segment[segments[f]] += area;
    common[{solid.label[f], segments[f]}] += area;
    total += area;
  }
  std::map<std::size_t, double> best;
  for (const auto& [pair, area] : common) {
    const auto& [face, segment] = pair;
    best[face] = std::max(best[face], area / (of_face[face] + of_segment[segment] - area));
  }
  std::vector<double> overlaps;
  for (const auto& [face, area] : of_face)
    if (area >= 0.02 * total) overlaps.push_back(best[face]);
  return overlaps;
}

/// Some triangles cut in two at the middle of a side that lies on the surface, and a triangle without area between them
/// and their neighbour.
solids::Solid with_zero_area_faces(solids::Solid solid) {
  constexpr std::size_t step = 7;
  for (std::size_t f = 0, faces = solid.faces.size(); f < faces; f += step) {
    const std::vector<std::size_t> whole = solid.faces[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = whole[k], b = whole[(k + 1) % 3], c = whole[(k + 2) % 3], middle = solid.points.size();
      const solids::Point point = (solid.points[a] + solid.points[b]) / 2;
      if (solid.surfaces[solid.label[f]].distance(point) > 1e-9) continue;
      solid.points.push_back(point);
      solid.faces[f] = {a, middle, c};
      solid.faces.push_back({middle, b, c});
      solid.faces.push_back({a, b, middle});
      solid.label.insert(solid.label.end(), 2, solid.label[f]);
      break;
    }
  }
  return solid;
}

/// A horizontal face with a round stud on it, whose side is divided into so many steps.
void add_stud(solids::Builder& builder, std::vector<solids::Point> outline, std::size_t steps, double radius = 0.3) {
  constexpr double height = 0.5;
  const double z = outline.front().z();
  const std::vector<solids::Point> foot =
      solids::points_on(solids::arc({0, 0, z}, {radius, 0, 0}, {0, radius, 0}, 0, 2 * solids::half_turn), steps);
  outline.push_back(outline.front());
  builder.strip(builder.add(solids::plane({0, 0, z}, {0, 0, 1})), {0, 0, z}, foot, outline);
  solids::revolve(builder, builder.add(solids::cylinder({0, 0, 0}, {0, 0, 1}, radius)), steps, 1,
                  solids::line({radius, 0, z}, {radius, 0, z + height}));
  solids::flat_disc(builder, solids::by_kernel(), steps, radius, z + height, true);
}

/// A housing of two drafted halves, which meet in a rectangle, with a stud on it; 11 planes, 1 cylinder.
/// \param draft of each half, in radians
/// \param steps of the stud's side
solids::Solid drafted_housing(double draft, std::size_t steps, double radius_of_stud) {
  constexpr double lower = 0.6, upper = 0.4;  // height of either half
  const auto rectangle = [&](double z) -> std::vector<solids::Point> {
    const double in = std::abs(z) * std::tan(draft), x = 1 - in, y = 0.8 - in;
    return {{x, -y, z}, {x, y, z}, {-x, y, z}, {-x, -y, z}};
  };
  solids::Builder builder("drafted_housing");
  const std::vector<std::vector<solids::Point>> rings = {rectangle(-lower), rectangle(0), rectangle(upper)};
  builder.fan(builder.add(solids::plane({0, 0, -lower}, {0, 0, -1})), {rings[0].rbegin(), rings[0].rend()});
  for (std::size_t half = 0; half < 2; ++half)
    for (std::size_t i = 0; i < 4; ++i) {
      const solids::Point &a = rings[half][i], &b = rings[half][(i + 1) % 4], &c = rings[half + 1][(i + 1) % 4],
                          &d = rings[half + 1][i];
      builder.quadrangle(builder.add(solids::plane(a, (b - a).cross(d - a).normalized())), a, b, c, d);
    }
  add_stud(builder, rings[2], steps, radius_of_stud);
  return std::move(builder).solid();
}

/// A shaft with so many flats and a stud on it; between the flats its cylinder has steps of 6 degrees or less.
solids::Solid shaft_with_flats(std::size_t flats) {
  constexpr double half_flat = solids::half_turn / 6, widest_step = solids::half_turn / 30;
  constexpr std::size_t steps_of_stud = 60;
  solids::Builder builder("shaft_with_flats");
  std::vector<solids::Point> outline;
  const auto point = [](double angle) { return solids::Point(std::cos(angle), std::sin(angle), 1); };
  const auto below = [](const solids::Point& p) { return solids::Point(p.x(), p.y(), -1); };
  const auto side = [&](std::size_t surface, const solids::Point& a, const solids::Point& b) {
    builder.quadrangle(surface, below(a), below(b), b, a);
    outline.push_back(a);
  };
  const double part = 2 * solids::half_turn / static_cast<double>(flats), arc = part - 2 * half_flat;
  const auto steps = static_cast<std::size_t>(std::ceil(arc / widest_step));
  for (std::size_t i = 0; i < flats; ++i) {
    const double middle = part * static_cast<double>(i);
    const solids::Point normal(std::cos(middle), std::sin(middle), 0);
    side(builder.add(solids::plane(point(middle - half_flat), normal)), point(middle - half_flat),
         point(middle + half_flat));
    const std::size_t cylinder = builder.add(solids::cylinder({0, 0, 0}, {0, 0, 1}, 1));
    const auto step = [&](std::size_t j) {
      return point(middle + half_flat + arc * static_cast<double>(j) / static_cast<double>(steps));
    };
    for (std::size_t j = 0; j < steps; ++j)
      side(cylinder, step(j), j + 1 < steps ? step(j + 1) : point(middle + part - half_flat));
  }
  std::vector<solids::Point> bottom;
  for (const solids::Point& p : outline) bottom.insert(bottom.begin(), below(p));
  builder.fan(builder.add(solids::plane({0, 0, -1}, {0, 0, -1})), bottom);
  add_stud(builder, outline, steps_of_stud);
  return std::move(builder).solid();
}

/// A drum of few wide steps with a stud of many on it; 3 planes, 2 cylinders.
solids::Solid stud_on_wide_drum() {
  constexpr std::size_t wide_steps = 24, narrow_steps = 300;
  solids::Builder builder("stud_on_wide_drum");
  solids::flat_disc(builder, solids::by_kernel(), wide_steps, 1, -1, false);
  solids::revolve(builder, builder.add(solids::cylinder({0, 0, 0}, {0, 0, 1}, 1)), wide_steps, 1,
                  solids::line({1, 0, -1}, {1, 0, 0}));
  std::vector<solids::Point> rim =
      solids::points_on(solids::arc({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0, 2 * solids::half_turn), wide_steps);
  rim.pop_back();
  add_stud(builder, rim, narrow_steps);
  return std::move(builder).solid();
}

/// Of the edges between faces of the solid that are labelled differently.
double boundary_length(const solids::Solid& solid, const Labels& labels) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape_of(solid));
  double sum = 0;
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e), opposite = mesh.opposite(h);
    if (mesh.is_border(e) || labels[mesh.face(h)] == labels[mesh.face(opposite)]) continue;
    sum += (solid.points[mesh.source(h)] - solid.points[mesh.target(h)]).norm();
  }
  return sum;
}

void expect_every_face_found(const solids::Solid& solid) {
  SCOPED_TRACE(solid.name);
  const Labels segments = segments_of(solid);
  EXPECT_LE(rand_error(segments, solid.label), 0.02);
  for (const double overlap : best_overlaps(solid, segments)) EXPECT_GE(overlap, 0.9);
  EXPECT_EQ(number_of(segments), solid.surfaces.size());
}

}  // namespace

// ---- What is found ----

TEST(SegmentationIntoSurfaces, FindsTheFacesOfEvenlyMeshedSolids) {
  for (const solids::Solid& solid : solids::all(solids::even(0.1))) expect_every_face_found(solid);
}

TEST(SegmentationIntoSurfaces, FindsTheFacesOfSolidsAsAKernelMeshesThem) {
  for (const solids::Solid& solid : solids::all(solids::by_kernel())) expect_every_face_found(solid);
}

TEST(SegmentationIntoSurfaces, FindsTheFacesAmongTrianglesWithoutArea) {
  const solids::Meshing meshing = solids::even(0.15);
  for (const solids::Solid& solid : {solids::box(meshing), solids::flange(meshing), solids::cone_on_cylinder(meshing)})
    expect_every_face_found(with_zero_area_faces(solid));
}

TEST(SegmentationIntoSurfaces, FindsPlanesOneSquareWideBetweenFreeForms) {
  // No round neighbourhood of twelve vertices lies on one surface.
  solids::Builder builder("square tube with fillets of varying radius");
  constexpr double half = 0.45, length = 6;
  constexpr std::size_t around_fillet = 3, along = 20;
  const auto radius = [](double v) { return 0.3 + 0.04 * std::sin(9 * v) + 0.03 * std::sin(23 * v); };
  const solids::Point up = length * solids::Point::UnitZ();
  for (int side = 0; side < 4; ++side) {
    const double angle = side * solids::half_turn / 2;
    const solids::Point out(std::cos(angle), std::sin(angle), 0), left(-out.y(), out.x(), 0);
    builder.grid(builder.add(solids::plane(half * out, out)), 1, along, [=](double u, double v) -> solids::Point {
      return half * out + (2 * u - 1) * (half - radius(v)) * left + v * up;
    });
    builder.grid(builder.add({}), around_fillet, along, [=](double u, double v) -> solids::Point {
      const double r = radius(v), turn = u * solids::half_turn / 2;
      return (half - r) * (out + left) + r * (std::cos(turn) * out + std::sin(turn) * left) + v * up;
    });
  }
  const solids::Solid tube = std::move(builder).solid();
  const std::vector<double> overlaps = best_overlaps(tube, segments_of(tube));
  ASSERT_EQ(overlaps.size(), 8u);
  for (std::size_t plane = 0; plane < 8; plane += 2) EXPECT_GE(overlaps[plane], 0.9);
}

TEST(SegmentationIntoSurfaces, FindsACylinderThatBecomesAFreeFormByAndBy) {
  // The first vertices beyond it are near the cylinder, but not on it.
  constexpr std::size_t along = 8, along_flare = 16;
  constexpr double radius = 0.5, length = 2;
  for (const std::size_t around : {18U, 24U}) {
    solids::Builder builder("tube with a flare");
    const auto point = [](double u, double z) -> solids::Point {
      const double turn = 2 * solids::half_turn * u, beyond = std::max(z - length, 0.);
      const double r = radius + 1.2 * beyond * beyond * (1 + 0.3 * std::cos(3 * turn));
      return {r * std::cos(turn), r * std::sin(turn), z};
    };
    const auto axis = solids::Point::UnitZ();
    builder.grid(builder.add(solids::cylinder(solids::Point::Zero(), axis, radius)), around, along,
                 [&](double u, double v) { return point(u, v * length); });
    builder.grid(builder.add({}), around, along_flare,
                 [&](double u, double v) { return point(u, length + 0.5 * v * v); });
    const solids::Solid tube = std::move(builder).solid();
    EXPECT_GT(best_overlaps(tube, segments_of(tube)).at(0), 0.99) << around << " sides";
  }
}

/// A free form with creases along lines of constant x that end in it.
static solids::Solid roof_that_becomes_flat(const std::vector<double>& creases) {
  solids::Builder builder("roof that becomes flat");
  constexpr std::size_t n = 40;
  builder.grid(builder.add({}), n, n, [&](double u, double v) -> solids::Point {
    const double x = 2 * u - 1, y = 2 * v - 1, slope = std::clamp((y + 0.6) / 0.4, 0., 1.);
    double z = 0.15 * std::sin(2.3 * x + 0.4) * std::cos(1.7 * y);
    for (const double crease : creases) z -= slope * (std::abs(x - crease) - std::abs(crease));
    return {x, y, z};
  });
  return std::move(builder).solid();
}

TEST(SegmentationIntoSurfaces, CutsAFreeFormAlongCreasesThatEndInIt) {
  for (const std::vector<double>& creases : {std::vector<double>{0}, {-0.4, 0.4}}) {
    const solids::Solid roof = roof_that_becomes_flat(creases);
    const Labels segments = segments_of(roof);
    std::vector<std::set<std::size_t>> between(creases.size() + 1);
    for (std::size_t f = 0; f < roof.faces.size(); ++f) {
      const auto& face = roof.faces[f];
      const solids::Point centroid = (roof.points[face[0]] + roof.points[face[1]] + roof.points[face[2]]) / 3;
      if (centroid.y() < -0.2) continue;
      const auto right = std::upper_bound(creases.begin(), creases.end(), centroid.x());
      between[static_cast<std::size_t>(right - creases.begin())].insert(segments[f]);
    }
    std::set<std::size_t> all;
    for (const std::set<std::size_t>& one : between) {
      EXPECT_EQ(one.size(), 1u);
      all.insert(one.begin(), one.end());
    }
    EXPECT_EQ(all.size(), between.size());
    EXPECT_EQ(number_of(segments), between.size());
  }
}

/// For tests of something else than the estimate of noise, which takes half of the time on the smallest solids.
Surface_segmentation with_noise_of(double percent) {
  Surface_segmentation numbers;
  numbers.noise = percent / 100;
  return numbers;
}

/// How well the faces of solids are found.
struct Success {
  double error;  ///< of the Rand index, on average
  double found;  ///< the share of the faces that a segment matches at 0.75
};

static Success success_on(const std::vector<solids::Solid>& all, const Surface_segmentation& numbers = {}) {
  double error = 0, found = 0, faces = 0;
  for (const solids::Solid& solid : all) {
    const Labels segments = segments_of(solid, numbers);
    error += rand_error(segments, solid.label);
    for (const double overlap : best_overlaps(solid, segments)) {
      found += overlap >= 0.75;
      ++faces;
    }
  }
  return {error / static_cast<double>(all.size()), found / faces};
}

TEST(SegmentationIntoSurfaces, FindsMostFacesUnderNoise) {
  constexpr double percent = 0.1;
  for (const solids::Meshing& meshing : {solids::even(0.15), solids::by_kernel()}) {
    std::vector<solids::Solid> noisy;
    for (const solids::Solid& clean : solids::all(meshing)) noisy.push_back(solids::with_noise(clean, percent));
    SCOPED_TRACE(meshing.is_even ? "even" : "by a kernel");
    const Success success = success_on(noisy, with_noise_of(percent));
    EXPECT_LE(success.error, 0.06);
    EXPECT_GE(success.found, 0.8);
  }
}

static internal::Surface_tolerance tolerance_of(const solids::Solid& solid) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape_of(solid));
  const Dual_mesh_of<meshes::Surface_mesh> dual(mesh);
  return internal::surface_tolerance(dual, -1);
}

TEST(SegmentationIntoSurfaces, FindsTheSameFacesUnderNoiseThatHardlyTurnsThem) {
  // In few slender triangles it may be a free form as well, and is reckoned with as one.
  const std::set<std::string> too_few_triangles = {"box", "rounded_box"};
  for (const solids::Meshing& meshing : {solids::even(0.3), solids::by_kernel()})
    for (const solids::Solid& clean : solids::all(meshing)) {
      if (!meshing.is_even && too_few_triangles.count(clean.name) > 0) continue;
      const std::vector<double> without_noise = best_overlaps(clean, segments_of(clean));
      for (const double percent : {0.0005, 0.01}) {  // half of what counts as exact, and twenty times as much
        SCOPED_TRACE(testing::Message() << clean.name << (meshing.is_even ? ", even, " : ", by a kernel, ") << percent);
        const solids::Solid solid = solids::with_noise(clean, percent);
        const std::vector<double> overlaps = best_overlaps(solid, segments_of(solid));
        ASSERT_EQ(overlaps.size(), without_noise.size());
        for (std::size_t i = 0; i < overlaps.size(); ++i) EXPECT_GE(overlaps[i], 0.9 * without_noise[i]);
      }
    }
}

TEST(SegmentationIntoSurfaces, FindsTheFacesWhereCoordinatesAreRounded) {
  constexpr double percent = 0.01;  // four decimals of a solid whose diagonal is 1
  for (const solids::Solid& clean : solids::all(solids::even(0.1))) {
    SCOPED_TRACE(clean.name);
    const solids::Solid solid = solids::with_rounded_coordinates(clean, percent);
    for (const double overlap : best_overlaps(solid, segments_of(solid))) EXPECT_GE(overlap, 0.75);
  }
}

TEST(SegmentationIntoSurfaces, TakesNoFreeFormForSlightNoise) {
  solids::Builder builder("waves");
  builder.grid(builder.add({}), 40, 40, [&](double u, double v) -> solids::Point {
    return {u, v, 0.1 * (std::sin(7 * u + 2 * v) + std::cos(5 * v - 3 * u * v))};
  });
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape_of(std::move(builder).solid()));
  const Dual_mesh_of<meshes::Surface_mesh> dual(mesh);
  // What surfaces leave unexplained is small enough, but smooth: there would be hundreds of them.
  const internal::Surface_tolerance tolerance = internal::surface_tolerance(dual, -1);
  ASSERT_TRUE(tolerance.has_noise());
  EXPECT_TRUE(tolerance.is_noisy());
  EXPECT_FALSE(internal::Surface_tolerance(dual, tolerance.noise, internal::Noise_kind::independent).is_noisy());
}

TEST(SegmentationIntoSurfaces, TellsSlightNoiseByFewFacesBesideAFreeForm) {
  solids::Builder builder("waves and a plane");
  builder.grid(builder.add({}), 40, 40, [&](double u, double v) -> solids::Point {
    return {u, v, 0.1 * (std::sin(7 * u + 2 * v) + std::cos(5 * v - 3 * u * v))};
  });
  builder.grid(builder.add({}), 16, 16, [&](double u, double v) -> solids::Point { return {2 + u / 2, v / 2, 0}; });
  const solids::Solid clean = std::move(builder).solid();
  EXPECT_FALSE(tolerance_of(clean).has_noise());
  constexpr double percent = 0.001;
  const internal::Surface_tolerance tolerance = tolerance_of(solids::with_noise(clean, percent));
  EXPECT_TRUE(tolerance.has_noise());
  EXPECT_FALSE(tolerance.is_noisy());
  EXPECT_NEAR(100 * tolerance.noise, percent, 0.5 * percent);
}

TEST(SegmentationIntoSurfaces, FindsLongTrianglesOfPipesUnderNoise) {
  // Half of such a triangle lies near the torus that its pipe continues into.
  for (const unsigned seed : {1u, 2u, 3u}) {
    const solids::Solid elbow = solids::with_noise(solids::pipe_elbow(solids::by_kernel()), 0.3, seed);
    for (const double overlap : best_overlaps(elbow, segments_of(elbow))) EXPECT_GE(overlap, 0.75);
  }
}

TEST(SegmentationIntoSurfaces, FindsFilletsBesidePlanesUnderNoise) {
  // Noise of half the distance by which the first row of a fillet's triangles leaves the plane beside it.
  for (const unsigned seed : {1u, 2u, 3u}) {
    const solids::Solid solid = solids::with_noise(solids::rounded_box(solids::by_kernel()), 0.1, seed);
    EXPECT_LE(rand_error(segments_of(solid), solid.label), 0.025) << seed;
  }
}

/// A block whose top is in flat pleats of two by six squares each, which turn by 35 degrees against each other: less than at
/// sharp edges.
static solids::Solid pleated_block(std::size_t pleats) {
  constexpr double square = 0.1, slope = solids::half_turn * 17.5 / 180;
  constexpr std::size_t across = 6, down = 4;
  solids::Builder builder("pleated_block");
  const solids::Point y = across * square * solids::Point::UnitY(), z = down * square * solids::Point::UnitZ();
  const double run = 2 * square * std::cos(slope), length = run * static_cast<double>(pleats);
  // Rises and falls in turns.
  const auto top = [&](double x) -> solids::Point {
    const double part = std::fmod(x / run, 2);
    return {x, 0, run * std::tan(slope) * (part < 1 ? part : 2 - part)};
  };
  const auto ground = [&](double x) -> solids::Point { return x * solids::Point::UnitX() - z; };
  builder.grid(builder.add({}), across, 2 * pleats,
               [&](double u, double v) -> solids::Point { return ground(length * v) + u * y; });
  builder.grid(builder.add({}), down, across,
               [&](double u, double v) -> solids::Point { return u * top(0) + (u - 1) * z + v * y; });
  builder.grid(builder.add({}), across, down, [&](double u, double v) -> solids::Point {
    return ground(length) + u * y + v * (top(length) - ground(length));
  });
  builder.grid(builder.add({}), 2 * pleats, down,
               [&](double u, double v) -> solids::Point { return (1 - v) * ground(length * u) + v * top(length * u); });
  builder.grid(builder.add({}), down, 2 * pleats, [&](double u, double v) -> solids::Point {
    return (1 - u) * ground(length * v) + u * top(length * v) + y;
  });
  for (std::size_t i = 0; i < pleats; ++i)
    builder.grid(builder.add({}), 2, across,
                 [&](double u, double v) -> solids::Point { return top(run * (static_cast<double>(i) + u)) + v * y; });
  return std::move(builder).solid();
}

TEST(SegmentationIntoSurfaces, FindsFacesOfFewVerticesUnderNoise) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const solids::Solid solid = solids::with_noise(pleated_block(12), 0.1, seed);
    for (const double overlap : best_overlaps(solid, segments_of(solid))) EXPECT_GE(overlap, 0.75) << seed;
  }
}

TEST(SegmentationIntoSurfaces, JoinsThePiecesOfAFaceUnderNoise) {
  for (const unsigned seed : {1u, 3u, 4u}) {
    const solids::Solid solid = solids::with_noise(solids::stepped_shaft(solids::even(0.1)), 0.1, seed);
    EXPECT_LE(number_of(segments_of(solid)), number_of(solid.label) + 1) << seed;
  }
}

TEST(SegmentationIntoSurfaces, FindsMostFacesOfScans) {
  std::vector<solids::Solid> scans;
  for (const solids::Solid& clean : solids::all(solids::even(0.1))) scans.push_back(solids::scanned(clean, 0.1));
  const Success success = success_on(scans);
  EXPECT_LE(success.error, 0.03);
  EXPECT_GE(success.found, 0.8);
}

TEST(SegmentationIntoSurfaces, TellsNoiseOfScannersFromIndependentNoise) {
  using internal::Noise_kind;
  for (const solids::Solid& clean : solids::all(solids::even(0.1)))
    for (const double percent : {0.1, 0.3}) {
      EXPECT_TRUE(tolerance_of(solids::with_noise(clean, percent)).has_independent_noise()) << clean.name;
      const internal::Surface_tolerance of_scan = tolerance_of(solids::scanned(clean, percent));
      EXPECT_FALSE(of_scan.may_have_independent_noise()) << clean.name;
      // The rings of a flange are hardly wider than the neighbourhoods that tell: it is smooth or unclear by chance.
      if (clean.name != "flange") {
        EXPECT_EQ(of_scan.noise_kind, Noise_kind::smooth) << clean.name;
      }
    }
}

TEST(SegmentationIntoSurfaces, TellsTheNoiseOfASolidWithFewVertices) {
  constexpr double percent = 0.3;
  constexpr unsigned seeds = 5;
  double sum = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed)
    sum += tolerance_of(solids::with_noise(solids::cone_on_cylinder(solids::by_kernel()), percent, seed)).noise;
  const double mean = 100 * sum / seeds;
  EXPECT_GE(mean, percent / 2);
  EXPECT_LE(mean, 2 * percent);
}

TEST(SegmentationIntoSurfaces, TellsNoiseThatIsSmoothedOnceFromIndependentNoise) {
  for (const solids::Solid& clean : solids::all(solids::even(0.1))) {
    const solids::Solid noisy = solids::with_noise(clean, 0.1);
    EXPECT_TRUE(tolerance_of(noisy).has_independent_noise()) << clean.name;
    EXPECT_FALSE(tolerance_of(solids::smoothed(noisy, 1)).has_independent_noise()) << clean.name;
  }
}

TEST(SegmentationIntoSurfaces, TakesNoFreeFormForSmoothNoise) {
  for (const double waves : {2., 3., 4.}) {
    solids::Builder builder("waves");
    builder.grid(builder.add({}), 40, 40, [&](double u, double v) -> solids::Point {
      return {u, v, 0.1 / waves * (std::sin(waves * (7 * u + 2 * v)) + std::cos(waves * (5 * v - 3 * u * v)))};
    });
    const internal::Surface_tolerance tolerance = tolerance_of(std::move(builder).solid());
    // What analytic surfaces leave unexplained is taken for noise, but for no smooth one.
    ASSERT_TRUE(tolerance.is_noisy());
    EXPECT_EQ(tolerance.noise_kind, internal::Noise_kind::unclear) << waves;
  }
}

TEST(SegmentationIntoSurfaces, DrawsNoJaggedBoundariesUnderNoise) {
  const solids::Meshing meshing = solids::even(0.1);
  for (const solids::Solid& clean : {solids::capsule(meshing), solids::pipe_elbow(meshing)}) {
    const solids::Solid solid = solids::with_noise(clean, 0.3);
    EXPECT_LE(boundary_length(solid, segments_of(solid)), 1.3 * boundary_length(solid, solid.label)) << solid.name;
  }
}

TEST(SegmentationIntoSurfaces, TakesTheWholeSolidForOneSurfaceUnderNoiseThatHidesIt) {
  for (const solids::Meshing& meshing : {solids::even(0.2), solids::by_kernel()})
    for (const double noise : {10., 1e97}) {
      Surface_segmentation numbers;
      numbers.noise = noise;
      EXPECT_EQ(number_of(segments_of(meshes::surface_mesh(shape_of(solids::stepped_shaft(meshing))), numbers)), 1u);
    }
}

TEST(SegmentationIntoSurfaces, CutsACubeIntoSix) {
  for (const std::size_t n : {1u, 2u, 7u}) {
    const Labels segments = segments_of(meshes::surface_mesh(meshes::cube(n)));
    EXPECT_EQ(number_of(segments), 6u);
    for (std::size_t f = 0; f < segments.size(); ++f) EXPECT_EQ(segments[f], segments[f - f % (2 * n * n)]);
  }
  EXPECT_EQ(number_of(segments_of(meshes::surface_mesh(meshes::cube_of_quads()))), 6u);
}

TEST(SegmentationIntoSurfaces, CutsABoxIntoSixWhereATriangleWithoutAreaLiesOnAnEdge) {
  const meshes::Shape box = {
      {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}, {0, 0, 1}, {3, 0, 1}, {3, 2, 1}, {0, 2, 1}, {1, 0, 1}},
      {{3, 2, 1},
       {3, 1, 0},
       {4, 8, 7},
       {8, 5, 6},
       {8, 6, 7},
       {4, 5, 8},
       {5, 4, 0},
       {5, 0, 1},
       {1, 2, 6},
       {1, 6, 5},
       {2, 3, 7},
       {2, 7, 6},
       {3, 0, 4},
       {3, 4, 7}}};
  EXPECT_EQ(number_of(segments_of(meshes::surface_mesh(box))), 6u);
}

TEST(SegmentationIntoSurfaces, LeavesASphereATorusAndAPlaneWhole) {
  for (const meshes::Shape& shape : {meshes::sphere(3), meshes::torus(2, 0.6, 40, 20), meshes::plane(10)})
    EXPECT_EQ(number_of(segments_of(meshes::surface_mesh(shape))), 1u);
}

/// A cylinder or truncated cone of few sides between two flat ends. Each ring of vertices is turned against the one below it
/// by a part of a side: by none, all sides are flat.
static meshes::Shape drum(std::size_t sides, double turn, double top_radius) {
  constexpr std::size_t rows = 2;
  meshes::Shape shape;
  for (std::size_t row = 0; row <= rows; ++row)
    for (std::size_t i = 0; i < sides; ++i) {
      const double share = double(row) / double(rows), radius = 1 + share * (top_radius - 1);
      const double angle = 2 * solids::half_turn * (double(i) + turn * double(row)) / double(sides);
      shape.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 2 * share);
    }
  const auto corner = [&](std::size_t i, std::size_t row) { return row * sides + i % sides; };
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t i = 0; i < sides; ++i) {
      shape.faces.push_back({corner(i, row), corner(i + 1, row), corner(i, row + 1)});
      shape.faces.push_back({corner(i + 1, row), corner(i + 1, row + 1), corner(i, row + 1)});
    }
  const std::size_t bottom = shape.points.size(), top = bottom + 1;
  shape.points.emplace_back(0, 0, 0);
  shape.points.emplace_back(0, 0, 2);
  for (std::size_t i = 0; i < sides; ++i) {
    shape.faces.push_back({corner(i + 1, 0), corner(i, 0), bottom});
    shape.faces.push_back({corner(i, rows), corner(i + 1, rows), top});
  }
  return shape;
}

TEST(SegmentationIntoSurfaces, FindsRoundSurfacesOfFewSides) {
  for (const std::size_t sides : {5u, 6u, 7u, 8u})
    for (const double top_radius : {1., 0.7})
      EXPECT_EQ(number_of(segments_of(meshes::surface_mesh(drum(sides, 0.5, top_radius)))), 3u)
          << sides << " sides, radius at the top " << top_radius;
}

TEST(SegmentationIntoSurfaces, LeavesFlatSidesApartWhoseCornersLieOnARoundSurface) {
  for (const std::size_t sides : {5u, 6u, 7u, 8u})
    for (const double top_radius : {1., 0.7})
      EXPECT_EQ(number_of(segments_of(meshes::surface_mesh(drum(sides, 0, top_radius)))), sides + 2)
          << sides << " sides, radius at the top " << top_radius;
}

TEST(SegmentationIntoSurfaces, LeavesFlatSidesApartThatAreSinglePolygons) {
  for (const std::size_t sides : {5u, 6u, 7u, 8u})
    EXPECT_EQ(number_of(segments_of(meshes::surface_mesh(meshes::prism(sides)))), sides + 2) << sides << " sides";
}

TEST(SegmentationIntoSurfaces, TakesAPrismOfManySidesForACylinderBetweenTwoPolygons) {
  for (const std::size_t sides : {24u, 36u, 48u, 100u})
    EXPECT_EQ(number_of(segments_of(meshes::surface_mesh(meshes::prism(sides)))), 3u) << sides << " sides";
}

TEST(SegmentationIntoSurfaces, LeavesDraftedSidesApartThatTurnLessThanARoundSurface) {
  for (const double draft : {0.03, 0.06, 0.1}) expect_every_face_found(drafted_housing(draft, 60, 0.3));
}

TEST(SegmentationIntoSurfaces, LeavesDraftedSidesApartWhereManyEdgesAreTheirs) {
  for (const double draft : {0.05, 0.1})
    for (const std::size_t steps : {28U, 36U}) expect_every_face_found(drafted_housing(draft, steps, 0.1));
}

TEST(SegmentationIntoSurfaces, LeavesFlatsOfAShaftApartWhoseCornersLieOnItsCylinder) {
  for (const std::size_t flats : {1U, 2U, 3U, 4U}) expect_every_face_found(shaft_with_flats(flats));
}

TEST(SegmentationIntoSurfaces, LeavesAWideArcWholeBesideManyNarrowSteps) {
  expect_every_face_found(stud_on_wide_drum());
}

/// Also that the last triangle beside a pit is of a segment on a surface of that type and radius.
static void expect_round(const meshes::Shape& shape, std::size_t segments, Surface_type type, double radius) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape);
  const Labels labels = segments_of(mesh);
  EXPECT_EQ(number_of(labels), segments);
  const auto ids = boost::make_iterator_property_map(labels.begin(), get(boost::face_index, mesh));
  const Analytic_surface surface = segment_surfaces(mesh, ids, segments)[labels[labels.size() - 2]];
  EXPECT_EQ(surface.type, type);
  EXPECT_NEAR(surface.radius, radius, 1e-6);
}

TEST(SegmentationIntoSurfaces, FindsRoundSurfacesWhoseFacetsAreCut) {
  for (const std::size_t step : {1U, 2U, 3U}) {
    SCOPED_TRACE(step);
    for (const std::size_t sides : {24U, 48U}) {
      const std::size_t pits = (sides + step - 1) / step;  // of five planes each
      expect_round(meshes::with_pits(meshes::prism(sides), sides, step), 3 + 5 * pits, Surface_type::cylinder, 1);
    }
    const meshes::Shape ball = meshes::sphere(2);
    const std::size_t pits = (ball.faces.size() + step - 1) / step;  // of four
    expect_round(meshes::with_pits(ball, ball.faces.size(), step), 1 + 4 * pits, Surface_type::sphere, 1);
  }
}

static bool has_cut_facets(const meshes::Shape& shape) {
  const meshes::Surface_mesh mesh = meshes::surface_mesh(shape);
  return internal::Cut_facets(Dual_mesh_of(mesh), internal::Surface_tolerance::cad_exactness).are_any();
}

TEST(Cut_facets, AreNotSeenInMeshesOfMeshersAndKernels) {
  for (const solids::Meshing& meshing : {solids::even(0.1), solids::even(0.3), solids::by_kernel()})
    for (const solids::Solid& solid : solids::all(meshing)) EXPECT_FALSE(has_cut_facets(shape_of(solid))) << solid.name;
}

TEST(Cut_facets, AreNotThoseThatAMesherDividesWithinTheirPlanes) {
  for (const meshes::Shape& facets : {meshes::sphere(2), meshes::revolve({{0, 0}, {1, 0}, {1, 2}, {0, 2}}, 24)}) {
    const meshes::Shape divided = meshes::subdivided(facets);
    EXPECT_FALSE(has_cut_facets(divided));
    EXPECT_FALSE(has_cut_facets(meshes::subdivided(divided)));
  }
}

/// The segments of what a curve sweeps out between two flat ends.
Labels segments_of_turned(const std::vector<Eigen::Vector2d>& curve) {
  std::vector<Eigen::Vector2d> closed = curve;
  closed.emplace(closed.begin(), 0, curve.front()[1]);
  closed.emplace_back(0, curve.back()[1]);
  return segments_of(meshes::surface_mesh(meshes::revolve(closed, 60)));
}

TEST(SegmentationIntoSurfaces, FindsAFreeFormOfRevolutionWhole) {
  for (const std::size_t circles : {12U, 17U, 30U}) {
    SCOPED_TRACE(circles);
    std::vector<Eigen::Vector2d> vase;
    for (std::size_t i = 0; i < circles; ++i) {
      const double z = 3 * static_cast<double>(i) / static_cast<double>(circles - 1);
      vase.emplace_back(1 + 0.3 * std::sin(2 * z) + 0.05 * z * z, z);
    }
    EXPECT_EQ(number_of(segments_of_turned(vase)), 3U);
  }
}

TEST(SegmentationIntoSurfaces, LeavesAFewConesApartThatFollowEachOther) {
  std::vector<Eigen::Vector2d> barrel = {{1, 0}};
  for (const double slope : {0.3, 0.1, -0.1, -0.3})  // of four cones, 11 degrees and more from one to the next
    for (int i = 0; i < 2; ++i) barrel.emplace_back(barrel.back() + Eigen::Vector2d(0.4 * slope, 0.4));
  EXPECT_EQ(number_of(segments_of_turned(barrel)), 6U);
}

TEST(SegmentationIntoSurfaces, GivesAsManySegmentsAsAskedFor) {
  const auto mesh = meshes::surface_mesh(shape_of(solids::capsule(solids::even(0.2))));
  for (const std::size_t n : {1u, 2u, 3u}) EXPECT_EQ(number_of(segments_of(mesh, Surface_segmentation(n))), n);
}

TEST(SegmentationIntoSurfaces, NeverJoinsComponents) {
  const meshes::Shape left = meshes::cube(3), right = meshes::moved(meshes::cube(3), {2, 0, 0});
  const Labels segments = segments_of(meshes::surface_mesh(meshes::together(left, right)));
  EXPECT_EQ(number_of(segments), 12u);
  const auto half = segments.begin() + static_cast<std::ptrdiff_t>(segments.size() / 2);
  std::set<std::size_t> common;
  for (auto s = half; s != segments.end(); ++s)
    if (std::find(segments.begin(), half, *s) != half) common.insert(*s);
  EXPECT_TRUE(common.empty());
}

TEST(SegmentationIntoSurfaces, DoesNotDependOnPositionAndSize) {
  const solids::Solid solid = solids::stepped_shaft(solids::even(0.2));
  const Labels segments = segments_of(solid);
  for (const double size : {1e-6, 1e6}) {
    solids::Solid other = solid;
    for (auto& p : other.points) p = size * (meshes::some_rotation() * p + Eigen::Vector3d(3, 4, 5));
    EXPECT_LE(rand_error(segments_of(other), segments), 1e-3);
  }
}

/// Solids in a row on a plate.
/// \param plate its size in diagonals of the first one; by default so large that they are small beside it
/// \param growth of their diagonals from one to the next
solids::Solid assembly_of(const std::vector<solids::Solid>& parts, double plate = 200, double growth = 1) {
  solids::Solid assembly{"assembly", {{0, 0, -1}, {plate, 0, -1}, {plate, plate, -1}}, {{0, 1, 2}}, {0}, {}};
  assembly.surfaces.push_back(solids::plane({0, 0, -1}, solids::Point::UnitZ()));
  double place = 0, size = 1;
  for (const solids::Solid& part : parts) {
    const std::size_t points = assembly.points.size(), surfaces = assembly.surfaces.size();
    const double scale = size / part.diagonal();
    for (const solids::Point& p : part.points) assembly.points.push_back(p * scale + Eigen::Vector3d(place, 0, 1));
    for (auto face : part.faces) {
      for (std::size_t& v : face) v += points;
      assembly.faces.push_back(face);
    }
    for (const std::size_t label : part.label) assembly.label.push_back(label + surfaces);
    assembly.surfaces.insert(assembly.surfaces.end(), part.surfaces.begin(), part.surfaces.end());
    place += 2 * size;
    size *= growth;
  }
  return assembly;
}

/// Of the faces of an assembly that are those of a part, the first one of which has a number.
Labels of_part(const Labels& labels, std::size_t first, const solids::Solid& part) {
  const auto begin = labels.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(part.faces.size())};
}

TEST(SegmentationIntoSurfaces, OfASmallPartOfAnAssemblyIsThatOfThePartAlone) {
  const std::vector<solids::Solid> parts = solids::all(solids::even(0.15));
  const Labels segments = segments_of(assembly_of(parts));
  std::size_t first = 1;
  for (const solids::Solid& part : parts) {
    SCOPED_TRACE(part.name);
    const Labels alone = segments_of(part), found = of_part(segments, first, part);
    EXPECT_EQ(number_of(found), number_of(alone));
    EXPECT_LE(rand_error(found, alone), 1e-3);
    first += part.faces.size();
  }
}

TEST(SegmentationIntoSurfaces, FindsTheFacesOfAnAssemblyWhereCoordinatesAreRounded) {
  const std::vector<solids::Solid> parts = solids::all(solids::even(0.1));
  const solids::Solid clean = assembly_of(parts, 10, 0.8);
  // Of the whole: the former counts as exact there, but not in parts, which are a tenth as large and less.
  for (const double percent : {0.0003, 0.001}) {
    const Labels segments = segments_of(solids::with_rounded_coordinates(clean, percent));
    std::size_t first = 1;
    for (const solids::Solid& part : parts) {
      SCOPED_TRACE(testing::Message() << part.name << ", " << percent);
      for (const double overlap : best_overlaps(part, of_part(segments, first, part))) EXPECT_GE(overlap, 0.75);
      first += part.faces.size();
    }
  }
}

TEST(SegmentationIntoSurfaces, LeavesComponentsWholeThatTouchInAVertexUnderNoise) {
  // Of short triangles, enough to be looked at alone, and of long ones, which are cut.
  constexpr double percent = 0.1;
  solids::Builder builder("two plates");
  builder.grid(builder.add({}), 24, 24, [](double u, double v) -> solids::Point { return {u, v, 0}; });
  builder.grid(builder.add({}), 3, 3, [](double u, double v) -> solids::Point { return {-u, -v, u}; });
  const solids::Solid plates = solids::with_noise(std::move(builder).solid(), percent);
  ASSERT_EQ(plates.points.size(), 25u * 25u + 4u * 4u - 1u);
  EXPECT_EQ(rand_error(segments_of(plates, with_noise_of(percent)), plates.label), 0);
}

TEST(SegmentationIntoSurfaces, ReckonsWithTheNoiseOfAWholeAssembly) {
  constexpr double deviation = 2e-3;
  meshes::Shape spheres = meshes::sphere(4);
  for (int i = 1; i < 4; ++i)
    spheres = meshes::together(spheres, meshes::moved(meshes::sphere(4), Eigen::Vector3d(4. * i, 0, 0)));
  const double diagonal = Eigen::Vector3d(14, 2, 2).norm();
  const auto mesh = meshes::surface_mesh(meshes::with_noise(spheres, deviation));
  EXPECT_NEAR(hierarchy_of_surfaces(mesh).report().noise, deviation / diagonal, 0.3 * deviation / diagonal);
}

// ---- Walls ----

TEST(SegmentationIntoSurfaces, HasNoSegmentOnBothSidesOfAClosedLoopOfConstrainedEdges) {
  const auto cut = [](const solids::Solid& solid, unsigned random_seed, const Surface_segmentation& numbers) {
    SCOPED_TRACE(testing::Message() << solid.name << ", " << random_seed);
    const auto mesh = meshes::surface_mesh(shape_of(solid));
    const walls::Enclosure<meshes::Surface_mesh> enclosure(mesh, random_seed);
    Labels labels(num_faces(mesh));
    const auto ids = boost::make_iterator_property_map(labels.begin(), get(boost::face_index, mesh));
    const auto np = CGAL::parameters::edge_is_constrained_map(enclosure.constraints());
    const auto hierarchy = hierarchy_of_surfaces(mesh, numbers, np);
    const auto stop = [&](const Merge_tree& tree) { return numbers.stop(tree); };
    const std::size_t segments = hierarchy.segments(stop, ids);
    EXPECT_EQ(segments, number_of(labels));
    EXPECT_TRUE(enclosure.on_both_sides(ids).empty());
    EXPECT_EQ(hierarchy.report().components, hierarchy.number_of_components());
    // As few as there are.
    hierarchy.segments(Segment_count_stop(hierarchy.number_of_components()), ids);
    EXPECT_TRUE(enclosure.on_both_sides(ids).empty());
  };
  constexpr double percent = 0.2;
  unsigned random_seed = 0;
  for (const solids::Meshing& meshing : {solids::even(0.4), solids::by_kernel()})
    for (const solids::Solid& solid : solids::all(meshing)) {
      cut(solid, ++random_seed, {});
      cut(solids::with_noise(solid, percent), ++random_seed, with_noise_of(percent));
    }
}

TEST(SegmentationIntoSurfaces, CutsAPlaneAlongConstrainedEdges) {
  const auto mesh = meshes::surface_mesh(meshes::cube(6));
  const auto is_on_top = [&](meshes::Surface_mesh::Vertex_index v) { return mesh.point(v)[2] == 1; };
  using Edge = meshes::Surface_mesh::Edge_index;
  const auto middle = boost::make_function_property_map<Edge>([&](const Edge& e) {  // of a side, from edge to edge
    const auto v = mesh.vertex(e, 0), w = mesh.vertex(e, 1);
    return is_on_top(v) && is_on_top(w) && mesh.point(v)[0] == 0.5 && mesh.point(w)[0] == 0.5;
  });
  Labels labels(num_faces(mesh));
  const auto ids = boost::make_iterator_property_map(labels.begin(), get(boost::face_index, mesh));
  EXPECT_EQ(segmentation_into_surfaces(mesh, ids, CGAL::parameters::edge_is_constrained_map(middle)), 7u);
}

template <class Holder>
class SegmentationIntoSurfacesOfMeshes : public testing::Test {};
TYPED_TEST_SUITE(SegmentationIntoSurfacesOfMeshes, meshes::Holders);

TYPED_TEST(SegmentationIntoSurfacesOfMeshes, IsThatOfASurfaceMesh) {
  const solids::Solid solid = solids::cone_on_cylinder(solids::even(0.3));
  const TypeParam held(shape_of(solid));
  EXPECT_EQ(segments_of(held.mesh), segments_of(solid));
}

// ---- Faces that no surface explains ----

namespace {

struct Fragments {
  std::vector<std::size_t> of_face;
  std::vector<std::size_t> given_faces;
};

/// The fragments of a mesh without noise whose regions are given, all in the order of the faces of the shape.
Fragments fragments_of(const meshes::Shape& shape, const std::vector<std::size_t>& region_of_face) {
  const auto mesh = meshes::surface_mesh(shape);
  const Dual_mesh_of dual(mesh);
  const internal::Surface_tolerance tolerance(dual, 0);
  const std::vector<double> conductances(dual.number_of_edges(), 1);
  std::vector<std::size_t> regions;
  for (Dual_mesh::Index f = 0; f < dual.number_of_faces(); ++f) regions.push_back(region_of_face[dual.place(f)]);
  internal::Region_fragments fragments(dual, tolerance, conductances);
  const std::vector<std::size_t> fragment = fragments.fragments(regions, Progress());
  Fragments result{std::vector<std::size_t>(fragment.size()), {}};
  for (Dual_mesh::Index f = 0; f < fragment.size(); ++f) {
    result.of_face[dual.place(f)] = fragment[f];
    if (fragments.given()[f]) result.given_faces.push_back(dual.place(f));
  }
  return result;
}

constexpr std::size_t none = internal::Analytic_regions::none;

}  // namespace

TEST(RegionFragments, HoldTrianglesTogetherThatTurnByLessThanARightAngle) {
  meshes::Shape octahedron, tetrahedron;  // turn by 70.5 and by 109.5 degrees
  octahedron.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  octahedron.faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  tetrahedron.points = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  tetrahedron.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  EXPECT_EQ(number_of(fragments_of(octahedron, Labels(8, none)).of_face), 1u);
  EXPECT_EQ(number_of(fragments_of(tetrahedron, Labels(4, none)).of_face), 4u);
}

TEST(RegionFragments, GiveASingleFaceToTheRegionAboutIt) {
  Labels regions(2 * 4 * 4, 0);
  regions[13] = none;
  const Fragments fragments = fragments_of(meshes::plane(4), regions);
  EXPECT_EQ(number_of(fragments.of_face), 1u);
  EXPECT_EQ(fragments.given_faces, std::vector<std::size_t>{13});
}

// ---- Faces cut into small triangles ----

TEST(FaceRefinement, KeepsTheSurfaceAndEndsAtTheLongestSide) {
  constexpr double longest_side = 0.05;
  for (const solids::Solid& solid : solids::all(solids::by_kernel())) {
    SCOPED_TRACE(solid.name);
    const auto mesh = meshes::surface_mesh(shape_of(solid));
    const Dual_mesh_of dual(mesh);
    const internal::Face_refinement refinement(dual, longest_side);
    const Dual_mesh& refined = refinement.mesh();
    std::vector<double> area(dual.number_of_faces(), 0);
    for (Dual_mesh::Index t = 0; t < refined.number_of_faces(); ++t) {
      const auto corner = refined.corners(t);
      ASSERT_EQ(corner.size(), 3u);
      const Eigen::Vector3d &a = refined.point(corner[0]), &b = refined.point(corner[1]), &c = refined.point(corner[2]);
      for (const double side : {(b - a).norm(), (c - b).norm(), (a - c).norm()}) EXPECT_LE(side, longest_side);
      const Dual_mesh::Index f = refinement.faces()[t];
      area[f] += (b - a).cross(c - a).dot(dual.normal(f)) / 2;
      EXPECT_EQ(refined.shape_normal(t), dual.normal(f));
    }
    for (Dual_mesh::Index f = 0; f < area.size(); ++f) EXPECT_NEAR(area[f], dual.area(f), 1e-12);
    EXPECT_EQ(2 * refined.number_of_edges(), 3 * refined.number_of_faces());  // closed
  }
}

TEST(FaceRefinement, GivesEachEdgeItsEndsInTheDirectionOfItsFirstTriangle) {
  const auto mesh = meshes::surface_mesh(meshes::cube());
  const Dual_mesh_of dual(mesh);
  const internal::Face_refinement refinement(dual, 0.1);
  const Dual_mesh& refined = refinement.mesh();
  for (Dual_mesh::Index e = 0; e < refined.number_of_edges(); ++e) {
    const auto corner = refined.corners(refined.graph().faces_of(e)[0]);
    const auto [from, to] = refined.ends(e);
    const auto first = static_cast<std::size_t>(std::find(corner.begin(), corner.end(), from) - corner.begin());
    ASSERT_LT(first, 3u);
    EXPECT_EQ(corner[(first + 1) % 3], to);
  }
}

TEST(FaceRefinement, LeavesSmallFacesAlone) {
  const meshes::Shape shape = meshes::cube(3);
  const auto mesh = meshes::surface_mesh(shape);
  const Dual_mesh_of dual(mesh);
  const internal::Face_refinement refinement(dual, 1);
  EXPECT_EQ(refinement.mesh().number_of_vertices(), shape.points.size());
  EXPECT_EQ(refinement.mesh().number_of_faces(), shape.faces.size());
}

TEST(FaceRefinement, KeepsWallsBetweenTrianglesOfFacesThatHaveOne) {
  const auto mesh = meshes::surface_mesh(meshes::cube());
  for (unsigned random_seed = 1; random_seed < 10; ++random_seed) {
    const walls::Enclosure<meshes::Surface_mesh> enclosure(mesh, random_seed);
    const Dual_mesh_of dual(mesh, CGAL::parameters::edge_is_constrained_map(enclosure.constraints()));
    const internal::Face_refinement refinement(dual, 0.1);
    const Dual_mesh& refined = refinement.mesh();
    for (Dual_mesh::Index e = 0; e < refined.number_of_edges(); ++e) {
      const auto [t, u] = refined.graph().faces_of(e);
      const auto is_inside = [&](Dual_mesh::Index triangle) {
        return enclosure.is_inside(dual.face(refinement.faces()[triangle]));
      };
      EXPECT_EQ(refined.is_wall(e), is_inside(t) != is_inside(u));
    }
  }
}

// ---- The surfaces of the segments ----

/// The surfaces of a solid's own segments.
std::vector<Analytic_surface> surfaces_of(const solids::Solid& solid, double noise = -1) {
  const auto mesh = meshes::surface_mesh(shape_of(solid));
  const auto ids = boost::make_iterator_property_map(solid.label.begin(), get(boost::face_index, mesh));
  return segment_surfaces(mesh, ids, solid.surfaces.size(), noise);
}

TEST(SegmentSurfaces, AreThoseTheSolidWasMadeOf) {
  for (const auto& meshing : {solids::even(0.15), solids::by_kernel()})
    for (const solids::Solid& solid : solids::all(meshing)) {
      SCOPED_TRACE(solid.name);
      const auto mesh = meshes::surface_mesh(shape_of(solid));
      const auto ids = boost::make_iterator_property_map(solid.label.begin(), get(boost::face_index, mesh));
      const auto surfaces = segment_surfaces(mesh, ids, solid.surfaces.size());
      ASSERT_EQ(surfaces.size(), solid.surfaces.size());
      for (std::size_t s = 0; s < surfaces.size(); ++s) {
        ASSERT_EQ(surfaces[s].type, analytic_types[static_cast<std::size_t>(solid.surfaces[s].type)]);  // same order
        EXPECT_NEAR(surfaces[s].radius, solid.surfaces[s].radius, 1e-6);
        EXPECT_NEAR(surfaces[s].tube_radius, solid.surfaces[s].tube_radius, 1e-6);
        EXPECT_NEAR(surfaces[s].half_angle, solid.surfaces[s].half_angle, 1e-6);
        EXPECT_LT(surfaces[s].residual, 1e-6);
      }
    }
}

TEST(SegmentSurfaces, OfSmallPartsOfAnAssemblyAreThoseOfThePartsAlone) {
  const std::vector<solids::Solid> parts = solids::all(solids::by_kernel());
  const std::vector<Analytic_surface> surfaces = surfaces_of(assembly_of(parts));
  std::size_t first = 1;
  for (const solids::Solid& part : parts) {
    SCOPED_TRACE(part.name);
    const std::vector<Analytic_surface> alone = surfaces_of(part);
    for (std::size_t s = 0; s < alone.size(); ++s) {
      const Analytic_surface& found = surfaces[first + s];
      EXPECT_EQ(found.type, alone[s].type);
      EXPECT_NEAR(part.diagonal() * found.radius, alone[s].radius, 1e-6);
      EXPECT_NEAR(part.diagonal() * found.tube_radius, alone[s].tube_radius, 1e-6);
      EXPECT_LT(part.diagonal() * found.residual, 1e-6);
    }
    first += alone.size();
  }
}

TEST(SegmentSurfaces, OfASegmentInSeveralSmallPartsIsTheOneOfAllOfThem) {
  const meshes::Shape sphere = meshes::sphere(4);  // of radius 1
  meshes::Shape caps{sphere.points, {}};
  for (const auto& face : sphere.faces)
    if (std::abs(sphere.points[face[0]].z()) > 0.8) caps.faces.push_back(face);
  const auto mesh = meshes::surface_mesh(meshes::together(
      meshes::moved(caps, {7, 8, 9}), meshes::moved(meshes::scaled(meshes::plane(2), 200), {0, 0, -1})));
  std::vector<std::size_t> label(mesh.number_of_faces(), 1);
  std::fill_n(label.begin(), caps.faces.size(), 0);
  const auto ids = boost::make_iterator_property_map(label.begin(), get(boost::face_index, mesh));
  const Analytic_surface found = segment_surfaces(mesh, ids, 2)[0];
  EXPECT_EQ(found.type, Surface_type::sphere);
  EXPECT_NEAR(found.radius, 1, 1e-9);
  EXPECT_LT((found.point - Eigen::Vector3d(7, 8, 9)).norm(), 1e-9);
}

/// A plate with a drilled hole that has a chamfer: planes, cylinder and cone, whose vertices lie on circles.
solids::Solid plate_with_countersunk_hole() {
  using namespace solids;
  Builder builder("plate_with_countersunk_hole");
  const Point up = Point::UnitZ();
  const Meshing meshing = by_kernel();
  const std::size_t around = meshing.around(1);
  const auto add = [&](const Surface& surface, const Point& a, const Point& b) {
    revolve(builder, builder.add(surface), around, 1, line(a, b));
  };
  add(plane({0, 0, 0}, -up), {0.5, 0, 0}, {2, 0, 0});
  add(cylinder({0, 0, 0}, up, 2), {2, 0, 0}, {2, 0, 0.5});
  add(plane({0, 0, 0.5}, up), {2, 0, 0.5}, {0.6, 0, 0.5});
  add(cone({0, 0, -0.1}, up, half_turn / 4), {0.6, 0, 0.5}, {0.5, 0, 0.4});
  add(cylinder({0, 0, 0}, up, 0.5), {0.5, 0, 0.4}, {0.5, 0, 0});
  return std::move(builder).solid();
}

TEST(SegmentSurfaces, OfAChamferBetweenAPlaneAndACylinderIsACone) {
  const solids::Solid solid = plate_with_countersunk_hole();
  const auto surfaces = surfaces_of(solid);
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    EXPECT_EQ(surfaces[s].type, analytic_types[static_cast<std::size_t>(solid.surfaces[s].type)]) << s;
  EXPECT_NEAR(surfaces[3].half_angle, solids::half_turn / 4, 1e-9);
}

TEST(SegmentSurfaces, HaveStandardErrorsThatNoiseBearsOut) {
  // One number of each type is compared with the design, divided by its error: the squares have a mean of 1.
  constexpr unsigned trials = 15;
  constexpr double percent = 0.02;
  std::map<Surface_type, double> squares;
  std::map<Surface_type, double> numbers;
  for (const solids::Solid& solid : {solids::stepped_shaft(solids::even(0.1)), solids::capsule(solids::even(0.1))})
    for (unsigned seed = 1; seed <= trials; ++seed) {
      const auto surfaces = surfaces_of(solids::with_noise(solid, percent, seed), percent / 100);
      for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const auto& found = surfaces[s];
        const auto& design = solid.surfaces[s];
        if (static_cast<std::size_t>(found.type) != static_cast<std::size_t>(design.type)) continue;
        const auto add = [&](double a, double b, double error) {
          squares[found.type] += (a - b) * (a - b) / (error * error);
          ++numbers[found.type];
        };
        if (found.type == Surface_type::plane)
          add(std::sin(std::acos(std::min(1., std::abs(found.direction.dot(design.direction))))), 0,
              std::sqrt(2) * found.errors.direction);
        else if (found.type == Surface_type::cone)
          add(found.half_angle, design.half_angle, found.errors.half_angle);
        else
          add(found.radius, design.radius, found.errors.radius);
      }
    }
  ASSERT_EQ(squares.size(), analytic_types.size());
  for (const auto& [type, sum] : squares) {
    // Three hundred trials, which take too long here, give .95 to 1.07. Two in a thousand means of 15 squares are beyond these.
    EXPECT_GT(sum / numbers[type], 0.25) << name_of(type);
    EXPECT_LT(sum / numbers[type], 4) << name_of(type);
  }
}

TEST(SegmentSurfaces, AreFoundBesideAFewWrongFaces) {
  for (const auto& meshing : {solids::even(0.1), solids::by_kernel()}) {
    solids::Solid solid = solids::capsule(meshing);
    const solids::Solid right = solid;
    // A face of each hemisphere goes to the cylinder.
    for (const std::size_t label : {1U, 2U}) *std::find(solid.label.begin(), solid.label.end(), label) = 0;
    const auto surfaces = surfaces_of(solid);
    EXPECT_EQ(surfaces[0].type, Surface_type::cylinder);
    EXPECT_NEAR(surfaces[0].radius, right.surfaces[0].radius, 1e-9);
  }
}

TEST(SegmentSurfaces, OfFewVerticesHaveInfiniteErrors) {
  const auto mesh = meshes::surface_mesh(meshes::cube());
  Labels labels;
  for (std::size_t f = 0; f < mesh.number_of_faces(); ++f) labels.push_back(f);  // three vertices each
  const auto ids = boost::make_iterator_property_map(labels.begin(), get(boost::face_index, mesh));
  for (const Analytic_surface& surface : segment_surfaces(mesh, ids, labels.size())) {
    EXPECT_EQ(surface.type, Surface_type::plane);
    EXPECT_EQ(surface.errors.direction, std::numeric_limits<double>::infinity());
  }
}

TEST(SegmentSurfaces, RefusesIdsOutOfRange) {
  const auto mesh = meshes::surface_mesh(meshes::cube());
  const Labels labels(mesh.number_of_faces(), 3);
  const auto ids = boost::make_iterator_property_map(labels.begin(), get(boost::face_index, mesh));
  EXPECT_THROW(segment_surfaces(mesh, ids, 3), std::invalid_argument);
  EXPECT_NO_THROW(segment_surfaces(mesh, ids, 4));
}

// ---- Errors ----

TEST(SegmentationIntoSurfaces, RefusesNumbersOutOfRange) {
  const auto mesh = meshes::surface_mesh(meshes::cube());
  Surface_segmentation numbers;
  numbers.noise = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(segments_of(mesh, numbers), std::invalid_argument);
  numbers = Surface_segmentation();
  numbers.stop_cost = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(hierarchy_of_surfaces(mesh, numbers), std::invalid_argument);
  EXPECT_THROW(segments_of(mesh, Surface_segmentation(0)), std::invalid_argument);
}

TEST(SegmentationIntoSurfaces, OfNoFacesIsEmpty) { EXPECT_TRUE(segments_of(meshes::Surface_mesh()).empty()); }

TEST(SegmentationIntoSurfaces, TheCallbackSeesProgressAndCancels) {
  const auto mesh = meshes::surface_mesh(meshes::l_shape(3));
  const Labels untouched(mesh.number_of_faces(), 99);
  Labels labels = untouched;
  const auto ids = boost::make_iterator_property_map(labels.begin(), get(boost::face_index, mesh));
  std::vector<double> seen;
  const auto run = [&](double end) {
    const std::function<bool(double)> callback = [&seen, end](double fraction) {
      seen.push_back(fraction);
      return fraction < end;
    };
    segmentation_into_surfaces(mesh, ids, CGAL::parameters::callback(callback));
  };
  for (const double end : {0.01, 0.3, 0.82, 0.9}) {
    EXPECT_THROW(run(end), Cancelled);
    EXPECT_EQ(labels, untouched);
  }
  seen.clear();
  run(2);
  EXPECT_NE(labels, untouched);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_GE(seen.front(), 0);
  EXPECT_EQ(seen.back(), 1);
}

}  // namespace test_segmentation_into_surfaces
